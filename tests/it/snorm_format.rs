//! Snorm of any width against `f64`, with its own reading of the bits.

use unitpack::{
    Codec, Snorm5x3, Snorm10x3, Snorm12x3, Snorm16x3, SnormFormat, Soa, SoaMut, StrideMismatch,
    Strided, StridedMut,
};
use unitpack_test::codes::integer;
use unitpack_test::elements::FILL;
use unitpack_test::random::{Rng, mixed_vectors, special_vectors};
use unitpack_test::vectors::{angle, normalize, widen};

fn formats() -> impl Iterator<Item = SnormFormat> {
    assert_eq!([SnormFormat::new(3), SnormFormat::new(17)], [None; 2]);
    (4..=16).map(|bits| SnormFormat::new(bits).unwrap())
}

/// What a code means.
fn meaning(format: SnormFormat, code: u64) -> [f64; 3] {
    let bits = format.component_bits();
    let (apart, m) = (if bits <= 10 { bits } else { 16 }, (1i64 << (bits - 1)) - 1);
    let fields = [0, 1, 2].map(|i| {
        let field = (code >> (i * apart)) as i64 & (2 * m + 1);
        (if field > m { field - 2 * m - 2 } else { field }).max(-m) as f64
    });
    if fields == [0.0; 3] { [0.0, 0.0, 1.0] } else { normalize(fields) }
}

#[test]
fn codes_mean_what_their_bits_say() {
    for format in formats() {
        let mut rng = Rng::new(1);
        for i in 0..30_000 {
            let code = if i < 4096 { i } else { rng.bits() >> (64 - 8 * format.code_size()) };
            let off = angle(widen(format.decode(code)), meaning(format, code));
            assert!(off < 2e-7, "{format:?} {code:x}: {off}");
        }
    }
}

#[test]
fn encoders_keep_their_bounds_and_the_precise_is_nearest_and_stable() {
    for format in formats() {
        let m = (1i64 << (format.component_bits() - 1)) - 1;
        let count = if format.component_bits() <= 10 { 2000 } else { 24 };
        let directions = mixed_vectors(2, 20_000).into_iter().filter(|v| {
            let largest = v.iter().fold(0.0, |most: f32, c| most.max(c.abs()));
            (1e-9..1e9).contains(&largest) && v.iter().all(|c| c.is_finite())
        });
        for (i, v) in directions.enumerate() {
            let of = normalize(widen(v));
            let code = format.encode(v);
            let off = angle(of, meaning(format, code));
            assert!(off.to_degrees() <= format.max_error_degrees(), "{format:?} {v:?}: {off}");
            if i >= count {
                continue;
            }
            let precise = format.encode_precise(v);
            let nearest = angle(of, meaning(format, precise));
            assert!(nearest.to_degrees() <= format.max_error_precise_degrees(), "{format:?} {v:?}");
            assert_eq!(format.encode_precise(format.decode(precise)), precise, "{format:?} {v:?}");
            // Of the corners around the line at every length.
            let largest = of.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
            let mut least = f64::INFINITY;
            for n in 1..=m {
                let ideal = of.map(|c| c / largest * n as f64);
                for corner in 0..8 {
                    let point = [0, 1, 2].map(|i| ideal[i].floor() + f64::from(corner >> i & 1));
                    if point.iter().all(|c| c.abs() <= m as f64) && point != [0.0; 3] {
                        least = least.min(angle(of, normalize(point)));
                    }
                }
            }
            assert!(nearest <= least + 3e-7, "{format:?} {v:?}: {nearest}, not {least}");
        }
    }
}

#[test]
fn widths_of_the_table_are_its_codecs() {
    fn check<C: Codec>(bits: u32) {
        let format = SnormFormat::new(bits).unwrap();
        for v in special_vectors().into_iter().chain(mixed_vectors(4, 500)) {
            let code = integer(C::encode(v)) as u64;
            // Codes of 15 bits have no room for more.
            assert_eq!(format.encode(v), code, "{format:?} {v:?}");
            assert_eq!(
                format.decode(code).map(f32::to_bits),
                C::decode(C::encode(v)).map(f32::to_bits)
            );
        }
        for v in mixed_vectors(5, 10) {
            assert_eq!(u128::from(format.encode_precise(v)), integer(C::encode_precise(v)));
        }
    }
    check::<Snorm5x3>(5);
    check::<Snorm10x3>(10);
    check::<Snorm12x3>(12);
    check::<Snorm16x3>(16);
}

#[test]
fn batches_give_the_bits_of_single_vectors() {
    for format in formats() {
        let size = format.code_size();
        for len in [0, 1, 17, 300] {
            let v = &mixed_vectors(6, 300)[..len];
            let [x, y, z] = [0, 1, 2].map(|i| v.iter().map(|v| v[i]).collect::<Vec<_>>());
            let soa = Soa { x: &x, y: &y, z: &z };
            let bytes = |encode: &dyn Fn([f32; 3]) -> u64| -> Vec<u8> {
                v.iter().flat_map(|&v| encode(v).to_le_bytes()[..size].to_vec()).collect()
            };
            let fast = bytes(&|v| format.encode(v));
            let mut out = vec![FILL; size * len];
            format.encode_soa(soa, &mut out).unwrap();
            assert_eq!(out, fast, "{format:?}");
            let to = StridedMut { bytes: &mut out, offset: 0, stride: size, len };
            if size == 4 || len <= 17 {
                format.encode_strided_precise(Strided::of(v, 0), to).unwrap();
                assert_eq!(out, bytes(&|v| format.encode_precise(v)), "{format:?}");
                format.encode_soa_precise(soa, &mut out).unwrap();
                assert_eq!(out, bytes(&|v| format.encode_precise(v)), "{format:?}");
            }
            let stride = size + 5;
            let mut apart = vec![FILL; 3 + stride * len];
            let to = StridedMut { bytes: &mut apart, offset: 3, stride, len };
            format.encode_strided(Strided::of(v, 0), to).unwrap();
            for (i, code) in fast.chunks(size).enumerate() {
                let element = &apart[3 + i * stride..][..stride];
                assert_eq!((&element[..size], &element[size..]), (code, &[FILL; 5][..]));
            }
            let expected: Vec<[f32; 3]> =
                v.iter().map(|&v| format.decode(format.encode(v))).collect();
            let mut decoded = vec![[7.0f32; 3]; len];
            let from = Strided { bytes: &apart, offset: 3, stride, len };
            format.decode_strided(from, StridedMut::of(&mut decoded, 0)).unwrap();
            assert_eq!(decoded, expected);
            let [mut x, mut y, mut z] = [0; 3].map(|_| vec![7.0; len]);
            format.decode_soa(&fast, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
            assert!((0..len).all(|i| [x[i], y[i], z[i]] == expected[i]));
        }
    }
    let format = SnormFormat::new(11).unwrap();
    let mut bytes = [FILL; 12];
    assert!(format.encode_soa(Soa { x: &[1.0], y: &[1.0], z: &[1.0] }, &mut bytes[..4]).is_err());
    let to = StridedMut { bytes: &mut bytes, offset: 0, stride: 5, len: 2 };
    let error = StrideMismatch::Stride { offset: 0, stride: 5, len: 2, size: 6, bytes: 12 };
    assert_eq!(format.encode_strided(Strided::of(&[[1.0f32; 3]; 2], 0), to), Err(error));
    assert_eq!(bytes, [FILL; 12]);
}
