//! Points without a normal: a code that no encoder gives stands for them, if the caller asks.

use bytemuck::Zeroable;
use unitpack::{
    AngularCube16, Axis, AxisOrder, Codec, Cube16, Float16x3, Format, HemiOct24, Icosphere162,
    LatLong32, Oct8, Oct10, Oct16, Oct20, Oct24, Oct32, OctUnorm8x2, OrNone, SignedOct23, Snorm8x3,
    Snorm10x3, Snorm16x3, Soa, SoaMut, Strided, StridedMut, XyOnly16,
};
use unitpack_test::AnyCodec;
use unitpack_test::codes::integer;
use unitpack_test::random::{Rng, mixed_vectors};
use unitpack_test::tasks::check_all;

const LENGTHS: [usize; 6] = [0, 1, 15, 64, 300, 2500];

/// Vectors of which every few have no direction.
fn vectors(len: usize) -> Vec<[f32; 3]> {
    let mut rng = Rng::new(len as u64);
    let mut vectors = mixed_vectors(9, 2500);
    vectors.truncate(len);
    for v in &mut vectors {
        match rng.below(12) {
            0 => *v = [0.0, -0.0, 0.0],
            1 => v[rng.below(3) as usize] = f32::NAN,
            2 => *v = [f32::NAN, f32::INFINITY, 0.0],
            3 => *v = [0.0, f32::from_bits(1), -0.0],
            4 => *v = [f32::NEG_INFINITY, 1.0, f32::INFINITY],
            5 => *v = [0.0, -0.0, rng.pick(&[-1.0, -1e-30, -f32::INFINITY])],
            _ => {}
        }
    }
    vectors
}

/// As a point cloud's reader would write it.
fn is_missing(v: [f32; 3]) -> bool {
    v == [0.0; 3] || v.iter().any(|c| c.is_nan())
}

#[test]
fn a_format_that_has_none_never_encodes_to_it() {
    let mut without = Vec::new();
    for &format in Format::ALL {
        let codec = AnyCodec::of(format);
        let Some(none) = format.none() else {
            without.push(format.name());
            continue;
        };
        assert_eq!(none.len(), format.code_size());
        let code = none.iter().rev().fold(0, |code, &byte| code << 8 | u128::from(byte));
        assert!(code < 1 << format.bits(), "{format}");
        // What encoders give is canonical, as other tests see.
        assert_ne!((codec.canonical)(code), code, "{format}");
        assert_ne!((codec.encode_precise)((codec.decode)(code)), code, "{format}");
    }
    assert_eq!(without, ["float32x3", "latlong16D", "latlong24D", "fibonacci16", "fibonacci24"]);
    // Encoders give all their codes.
    for name in &without[1..] {
        let format: Format = name.parse().unwrap();
        let codec = AnyCodec::of(format);
        for i in 0..1u128 << 16 {
            let code = (i * 0x1_0001) & ((1 << format.bits()) - 1);
            assert_eq!((codec.canonical)(code), code, "{name} {code:x}");
        }
    }
}

#[test]
fn native_codes_are_those_of_the_format() {
    fn check<C: Codec>() {
        let Some(mut code) = C::NONE else { panic!("{}", C::FORMAT) };
        // Little-endian integers of the code's alignment.
        let bytes = bytemuck::bytes_of_mut(&mut code);
        if cfg!(target_endian = "big") {
            bytes.chunks_mut(align_of::<C::Code>()).for_each(<[u8]>::reverse);
        }
        assert_eq!(Some(&*bytes), C::FORMAT.none());
    }
    check::<Oct8>();
    check::<Oct16>();
    check::<Oct24>();
    check::<Oct32>();
    check::<Snorm16x3>();
    assert_eq!(Oct24::NONE, Some([0xFF; 3]));
    assert_eq!(Snorm16x3::NONE, Some([0, 0, 0x8000]));
    assert_eq!(OctUnorm8x2::NONE, Some(0));
    assert_eq!(LatLong32::NONE, Some(u32::MAX));
}

/// All layouts of a codec against its own functions of one vector.
fn check<C: Codec + Default>() {
    let none = C::NONE.unwrap();
    let is_none = |code| {
        let used = (1 << C::FORMAT.bits()) - 1;
        integer(code) & used == integer(none)
    };
    let mut rng = Rng::new(4);
    for len in LENGTHS {
        let finer = AnyCodec::of(C::FORMAT).is_finer_than_f32();
        let v = vectors(if finer { len.min(70) } else { len });
        let expected = |encode: fn([f32; 3]) -> C::Code| -> Vec<C::Code> {
            v.iter().map(|&v| if is_missing(v) { none } else { encode(v) }).collect()
        };
        let [fast, precise] = [expected(C::encode), expected(C::encode_precise)];
        for (i, &v) in v.iter().enumerate() {
            let got = [OrNone::<C>::encode(v), OrNone::<C>::encode_precise(v)];
            assert_eq!(got, [fast[i], precise[i]], "{} {v:?}", C::FORMAT);
        }
        let [mut a, mut b] = [0; 2].map(|_| vec![C::Code::zeroed(); v.len()]);
        OrNone::<C>::encode_aos(&v, &mut a).unwrap();
        OrNone::<C>::encode_aos_precise(&v, &mut b).unwrap();
        assert_eq!([&a, &b], [&fast, &precise], "{}", C::FORMAT);
        let [x, y, z] = [0, 1, 2].map(|i| v.iter().map(|v| v[i]).collect::<Vec<_>>());
        let soa = Soa { x: &x, y: &y, z: &z };
        OrNone::<C>::encode_soa(soa, &mut a).unwrap();
        OrNone::<C>::encode_soa_precise(soa, &mut b).unwrap();
        assert_eq!([&a, &b], [&fast, &precise], "{}", C::FORMAT);
        assert!(OrNone::<C>::encode_iter(v.iter().copied()).eq(fast.iter().copied()));
        let order = AxisOrder::Zxy;
        let turned: Vec<_> = v.iter().map(|&v| order.undo(v)).collect();
        let to = StridedMut::of(&mut a, 0);
        order.encode_strided(OrNone::new(C::default()), Strided::of(&turned, 0), to).unwrap();
        assert_eq!(a, fast, "{}", C::FORMAT);

        // Doubles have a direction where floats have one.
        let doubles: Vec<[f64; 3]> = v.iter().map(|v| v.map(f64::from)).collect();
        OrNone::<C>::encode_aos_f64(&doubles, &mut a).unwrap();
        for ((&a, &v), &doubles) in a.iter().zip(&v).zip(&doubles) {
            assert_eq!(a == none, is_missing(v), "{} {v:?}", C::FORMAT);
            assert_eq!(a, OrNone::<C>::encode_f64(doubles), "{} {v:?}", C::FORMAT);
        }

        // Bits that say nothing do not hide it.
        let mut spare = none;
        let bytes = bytemuck::bytes_of_mut(&mut spare);
        if !C::FORMAT.bits().is_multiple_of(8) {
            let last = if cfg!(target_endian = "little") { bytes.len() - 1 } else { 0 };
            bytes[last] |= 0xFF << (C::FORMAT.bits() % 8);
        }
        assert_eq!(OrNone::<C>::decode(spare), [0.0; 3]);
        assert_eq!(OrNone::<C>::canonical(spare), none);
        assert_eq!(OrNone::<C>::mirror(spare, Axis::X), none);
        let mut back = [[7.0; 3]; 5];
        OrNone::<C>::decode_aos(&[spare; 5], &mut back).unwrap();
        assert_eq!(back, [[0.0; 3]; 5]);
        let mut mirrored = [spare; 5];
        OrNone::<C>::negate_slice(&mut mirrored);
        assert_eq!(mirrored, [none; 5]);

        // Any bits, and some codes that are none.
        let mut codes = fast;
        bytemuck::cast_slice_mut(&mut codes)
            .iter_mut()
            .for_each(|b: &mut u8| *b = rng.bits() as u8);
        codes.iter_mut().for_each(|c| *c = if rng.below(4) == 0 { none } else { *c });
        let bits = |v: [f32; 3]| v.map(f32::to_bits);
        let expected: Vec<_> =
            codes.iter().map(|&c| bits(if is_none(c) { [0.0; 3] } else { C::decode(c) })).collect();
        assert!(codes.iter().map(|&c| bits(OrNone::<C>::decode(c))).eq(expected.iter().copied()));
        let mut aos = vec![[7.0; 3]; codes.len()];
        OrNone::<C>::decode_aos(&codes, &mut aos).unwrap();
        assert!(aos.iter().map(|&v| bits(v)).eq(expected.iter().copied()), "{}", C::FORMAT);
        let [mut x, mut y, mut z] = [0; 3].map(|_| vec![7.0; codes.len()]);
        OrNone::<C>::decode_soa(&codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
        for (i, &expected) in expected.iter().enumerate() {
            assert_eq!(bits([x[i], y[i], z[i]]), expected, "{}", C::FORMAT);
        }

        let mirrored: Vec<_> =
            codes.iter().map(|&c| if is_none(c) { none } else { C::mirror(c, Axis::Y) }).collect();
        assert!(
            codes.iter().map(|&c| OrNone::<C>::mirror(c, Axis::Y)).eq(mirrored.iter().copied())
        );
        OrNone::<C>::mirror_slice(&mut codes, Axis::Y);
        assert_eq!(codes, mirrored, "{}", C::FORMAT);
        for &code in &codes {
            let same =
                if is_none(code) { [none; 2] } else { [C::canonical(code), C::negate(code)] };
            assert_eq!([OrNone::<C>::canonical(code), OrNone::<C>::negate(code)], same);
        }
    }
}

#[test]
fn every_layout_gives_none_where_one_vector_does() {
    check::<Oct8>();
    check::<Oct10>();
    check::<Oct16>();
    check::<Oct20>();
    check::<Oct24>();
    check::<Oct32>();
    check::<SignedOct23>();
    check::<Snorm8x3>();
    check::<Snorm10x3>();
    check::<Snorm16x3>();
    check::<Float16x3>();
    check::<HemiOct24>();
    check::<XyOnly16>();
    check::<Cube16>();
    check::<AngularCube16>();
    check::<Icosphere162>();
}

#[test]
fn formats_chosen_at_run_time_have_it_too() {
    check_all(Format::ALL, |&format| {
        let Some(or_none) = format.or_none() else {
            assert!(format.none().is_none());
            return Ok(());
        };
        let (none, size) = (format.none().unwrap(), format.code_size());
        let v = vectors(if AnyCodec::of(format).is_finer_than_f32() { 64 } else { 300 });
        let mut plain = vec![0; size * v.len()];
        let mut bytes = plain.clone();
        for precise in [false, true] {
            let to = StridedMut { bytes: &mut bytes, offset: 0, stride: size, len: v.len() };
            if precise {
                format.encode_aos_precise(&v, &mut plain).unwrap();
                AxisOrder::Xyz.encode_strided_precise(or_none, Strided::of(&v, 0), to).unwrap();
            } else {
                format.encode_aos(&v, &mut plain).unwrap();
                AxisOrder::Xyz.encode_strided(or_none, Strided::of(&v, 0), to).unwrap();
            }
            for ((&v, plain), code) in v.iter().zip(plain.chunks(size)).zip(bytes.chunks(size)) {
                let expected = if is_missing(v) { none } else { plain };
                if code != expected {
                    return Err(format!("{format} {v:?}: {code:x?}, not {expected:x?}"));
                }
            }
        }
        let mut decoded = vec![[7.0f32; 3]; v.len()];
        let codes = Strided { bytes: &bytes, offset: 0, stride: size, len: v.len() };
        AxisOrder::Xyz.decode_strided(or_none, codes, StridedMut::of(&mut decoded, 0)).unwrap();
        format.decode_aos(&bytes, &mut vec![[0.0; 3]; v.len()]).unwrap();
        for (code, &decoded) in bytes.chunks(size).zip(&decoded) {
            let mut expected = [[7.0; 3]];
            format.decode_aos(code, &mut expected).unwrap();
            let expected = if code == none { [0.0; 3] } else { expected[0] };
            if decoded.map(f32::to_bits) != expected.map(f32::to_bits) {
                return Err(format!("{format} {code:x?}: {decoded:?}, not {expected:?}"));
            }
        }
        Ok(())
    });
}
