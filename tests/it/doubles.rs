//! Vectors of `f64`: of any length, by their direction.

use unitpack::{
    Codec, Float32x3, Format, HemiOct24, LengthMismatch, Oct16, Oct32, Snorm8x3, Strided,
    StridedMut, Visitor,
};
use unitpack_test::codes::integer;
use unitpack_test::random::{Rng, mixed_vectors, special_vectors};
use unitpack_test::tasks::check_all;
use unitpack_test::vectors::{angle, normalize, widen};
use unitpack_test::{AnyCodec, representatives};

/// Both encoders of a type, of one vector.
struct Singles;

impl Visitor for Singles {
    type Output = [fn([f64; 3]) -> u128; 2];
    fn visit<C: Codec>(self) -> Self::Output {
        [|v| integer(C::encode_f64(v)), |v| integer(C::encode_precise_f64(v))]
    }
}

#[test]
fn floats_and_their_multiples_are_what_they_are_as_f32() {
    let formats: Vec<_> = Format::ALL.iter().copied().filter(|&f| f != Format::Float32x3).collect();
    check_all(&formats, |&format| {
        let codec = AnyCodec::of(format);
        let [fast, precise] = format.visit(Singles);
        let every = if codec.is_finer_than_f32() { 97 } else { 3 };
        let all = special_vectors().into_iter().chain(mixed_vectors(3, 1000));
        for (i, v) in all.step_by(every).enumerate() {
            let power = [0, 200, -200, 700, -700][i % 5];
            let w = v.map(|c| f64::from(c) * 2f64.powi(power));
            let wanted = [(codec.encode)(v), (codec.encode_precise)(v)];
            let got = [fast(w), precise(w)];
            if got != wanted {
                return Err(format!("{format}: {v:?} times 2^{power}: {got:x?}, not {wanted:x?}"));
            }
        }
        Ok(())
    });
    // It keeps lengths, and what is no direction.
    for v in special_vectors().into_iter().chain(mixed_vectors(3, 1000)) {
        let mut code = [[0; 3]];
        Float32x3::encode_aos_f64(&[v.map(f64::from)], &mut code).unwrap();
        let kept = [Float32x3::encode_f64(v.map(f64::from)), code[0]];
        if v.iter().all(|c| !c.is_nan()) {
            assert_eq!(kept, [Float32x3::encode(v); 2], "{v:?}");
        }
    }
}

/// Doubles that no `f32` is, of any length.
#[test]
fn the_direction_is_that_of_the_doubles() {
    let mut rng = Rng::new(21);
    for i in 0..20_000 {
        let power = (rng.unit() * 1900.0 - 950.0) as i32;
        // Components of any ratio.
        let v: [f64; 3] = core::array::from_fn(|_| {
            let small = if i % 3 == 0 { 2f64.powi(-(rng.below(60) as i32)) } else { 1.0 };
            (2.0 * rng.unit() - 1.0) * small * 2f64.powi(power)
        });
        let greatest = v.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        let target = normalize(v.map(|c| c / greatest));
        let code = Oct32::encode_precise_f64(v);
        let off = angle(widen(Oct32::decode(code)), target).to_degrees();
        assert!(off < Format::Oct32.max_error_precise_degrees() + 1e-5, "{v:?}: {off}");
    }
    // 39 degrees off as f32.
    let v = [1e40, 1e39, 0.0];
    assert_eq!(Oct32::encode_f64(v), Oct32::encode([10.0, 1.0, 0.0]));
    assert_eq!(Oct16::encode_f64([1e-300, -1e-300, 0.0]), Oct16::encode([1.0, -1.0, 0.0]));
    assert_eq!(Oct16::encode_f64([f64::INFINITY, 1e300, 0.0]), Oct16::encode([1.0, 0.0, 0.0]));
    assert_eq!(Oct16::encode_f64([f64::NAN, 1.0, 0.0]), Oct16::encode([0.0, 0.0, 1.0]));
    // Below a hemisphere only x and y count, however small they are.
    let v = [3e-200, -4e-200, -1e200];
    assert_eq!(HemiOct24::encode_f64(v), HemiOct24::encode([3.0, -4.0, 0.0]));
    assert_eq!(Snorm8x3::encode_f64([0.0; 3]), Snorm8x3::encode([0.0, 0.0, 1.0]));
}

#[test]
fn batches_give_what_single_vectors_do() {
    fn check<C: Codec>() {
        let mut rng = Rng::new(22);
        for len in [0, 1, 9, 64, 65, 300, 1500] {
            let vectors: Vec<[f64; 4]> =
                (0..len).map(|_| [(); 4].map(|()| f64::from_bits(rng.bits()))).collect();
            let three = |v: &[f64; 4]| [v[0], v[1], v[2]];
            let fast: Vec<C::Code> = vectors.iter().map(|v| C::encode_f64(three(v))).collect();
            let mut codes = vec![bytemuck::Zeroable::zeroed(); len];
            C::encode_aos_f64(&vectors, &mut codes).unwrap();
            assert_eq!(codes, fast, "{}", C::FORMAT);
            codes.fill(bytemuck::Zeroable::zeroed());
            C::encode_strided_f64(Strided::of(&vectors, 0), StridedMut::of(&mut codes, 0)).unwrap();
            assert_eq!(codes, fast, "{}", C::FORMAT);
            // The second to the fourth.
            let later: Vec<C::Code> =
                vectors.iter().map(|v| C::encode_precise_f64([v[1], v[2], v[3]])).collect();
            let to = StridedMut::of(&mut codes, 0);
            C::encode_strided_f64_precise(Strided::of(&vectors, 8), to).unwrap();
            assert_eq!(codes, later, "{}", C::FORMAT);
            let packed: Vec<[f64; 3]> = vectors.iter().map(three).collect();
            let precise: Vec<C::Code> = packed.iter().map(|&v| C::encode_precise_f64(v)).collect();
            C::encode_aos_f64_precise(&packed, &mut codes).unwrap();
            assert_eq!(codes, precise, "{}", C::FORMAT);
        }
    }
    check::<Oct16>();
    check::<Oct32>();
    check::<Snorm8x3>();
    check::<HemiOct24>();
}

#[test]
fn formats_take_doubles() {
    let mut rng = Rng::new(23);
    let vectors: Vec<[f64; 3]> =
        (0..70).map(|_| [(); 3].map(|()| f64::from_bits(rng.bits()))).collect();
    for format in representatives::all() {
        let [fast, precise] = format.visit(Singles);
        let size = format.code_size();
        let bytes = |single: fn([f64; 3]) -> u128| -> Vec<u8> {
            vectors.iter().flat_map(|&v| single(v).to_le_bytes()[..size].to_vec()).collect()
        };
        let mut out = vec![0; size * vectors.len()];
        fn all(bytes: &mut [u8], stride: usize) -> StridedMut<'_> {
            let len = bytes.len() / stride;
            StridedMut { bytes, offset: 0, stride, len }
        }
        format.encode_aos_f64(&vectors, &mut out).unwrap();
        assert_eq!(out, bytes(fast), "{format}");
        format.encode_aos_f64_precise(&vectors, &mut out).unwrap();
        assert_eq!(out, bytes(precise), "{format}");
        format.encode_strided_f64(Strided::of(&vectors, 0), all(&mut out, size)).unwrap();
        assert_eq!(out, bytes(fast), "{format}");
        format.encode_strided_f64_precise(Strided::of(&vectors, 0), all(&mut out, size)).unwrap();
        assert_eq!(out, bytes(precise), "{format}");
    }
    let error = LengthMismatch::Aos { vectors: 70, codes: 2 };
    assert_eq!(Oct16::encode_aos_f64(&vectors, &mut [0; 2]), Err(error));
}
