//! Angles against f64, signs against a model; slices give what single ones give.
#![no_main]

use std::f64::consts::{PI, TAU};

use libfuzzer_sys::fuzz_target;
use unitpack::low_dimensions::{Angle, Sign};
use unitpack::{CodeInt, LengthMismatch};
use unitpack_fuzz::Bytes;
use unitpack_test::codes::{natives, write_codes};
use unitpack_test::{Code, UNWRITTEN};

/// How far off the nearest code rounding to f32 may lead, in radians.
const ROUNDING: f64 = 1.3e-7;

/// Codes of one integer type.
struct Soa {
    encode: Encode,
    decode: Decode,
}

type Encode = fn(&[f32], &[f32], &mut [Code]) -> Result<(), LengthMismatch>;
type Decode = fn(&[Code], &mut [f32], &mut [f32]) -> Result<(), LengthMismatch>;

struct Width {
    bits: u32,
    encode: fn([f32; 2]) -> u32,
    decode: fn(u32) -> [f32; 2],
    narrow: Soa,
    wide: Soa,
}

const fn soa<const BITS: u32, T: CodeInt>() -> Soa {
    Soa {
        encode: |x, y, codes| {
            write_codes::<T, _>(codes, &mut |codes| Angle::<BITS>::encode_soa(x, y, codes))
        },
        decode: |codes, x, y| Angle::<BITS>::decode_soa(&natives::<T>(codes), x, y),
    }
}

/// Each width, with the narrowest integer that holds it beside u32.
macro_rules! angles {
    ($($code:ty: $($bits:literal)*;)*) => {
        [$($(Width {
            bits: $bits,
            encode: Angle::<$bits>::encode,
            decode: Angle::<$bits>::decode,
            narrow: soa::<$bits, $code>(),
            wide: soa::<$bits, u32>(),
        },)*)*]
    };
}

static ANGLES: [Width; 24] = angles! {
    u8: 1 2 3 4 5 6 7 8;
    u16: 9 10 11 12 13 14 15 16;
    u32: 17 18 19 20 21 22 23 24;
};

/// The direction that an input stands for.
fn target(v: [f32; 2]) -> [f64; 2] {
    let v = v.map(f64::from);
    if v.iter().any(|c| c.is_nan()) || v == [0.0; 2] {
        [1.0, 0.0]
    } else if v.iter().any(|c| c.is_infinite()) {
        v.map(|c| if c.is_infinite() { c.signum() } else { 0.0 })
    } else {
        v
    }
}

fn exact(code: u32, bits: u32) -> [f64; 2] {
    let (sin, cos) = (TAU * f64::from(code) / f64::from(1u32 << bits)).sin_cos();
    [cos, sin]
}

/// Radians between vectors of any length.
fn angle(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs()
}

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let width = bytes.choose(&ANGLES);
    let power = i32::from(bytes.byte() as i8);
    let pairs = bytes.rest::<8>();
    let vectors: Vec<[f32; 2]> = pairs.iter().map(|p| bytemuck::pod_read_unaligned(p)).collect();
    let given: Vec<u32> = pairs.iter().map(|p| bytemuck::pod_read_unaligned(&p[2..6])).collect();
    angles(width, power, &vectors, &given);
    signs(&vectors);
});

fn angles(width: &Width, power: i32, vectors: &[[f32; 2]], given: &[u32]) {
    let bits = width.bits;
    let limit = PI / f64::from(1u32 << bits) + ROUNDING;
    let codes: Vec<u32> = vectors.iter().map(|&v| (width.encode)(v)).collect();
    for (&v, &code) in vectors.iter().zip(&codes) {
        let of = format!("{bits} bits: {v:?} is {code:x}");
        assert!(code < 1 << bits, "{of}");
        let off = angle(target(v), exact(code, bits));
        assert!(off <= limit, "{of}, off by {off}");
        let scaled = v.map(|c| (f64::from(c) * 2f64.powi(power)) as f32);
        if (0..2).all(|i| f64::from(scaled[i]) == f64::from(v[i]) * 2f64.powi(power)) {
            assert_eq!((width.encode)(scaled), code, "{of}, and {scaled:?}");
        }
    }
    let decoded: Vec<[f32; 2]> = given.iter().map(|&code| (width.decode)(code)).collect();
    for (&code, &v) in given.iter().zip(&decoded) {
        let low = code & ((1 << bits) - 1);
        let of = format!("{bits} bits: {code:x} is {v:?}");
        let (expected, wide) = (exact(low, bits), v.map(f64::from));
        assert!((0..2).all(|i| (wide[i] - expected[i]).abs() < 1.2e-7), "{of}, not {expected:?}");
        assert!((wide[0].hypot(wide[1]) - 1.0).abs() <= 2.5e-7, "{of}");
        assert_eq!((width.encode)(v), low, "{of}");
        // The axes, on whole quarters of a turn.
        let axis = expected.map(f64::round);
        if (0..2).all(|i| (expected[i] - axis[i]).abs() < 1e-12) {
            assert_eq!(wide, axis, "{of}");
        }
    }

    let [x, y] = [0, 1].map(|i| vectors.iter().map(|v| v[i]).collect::<Vec<_>>());
    for (soa, mask) in [(&width.narrow, narrow_mask(bits)), (&width.wide, u32::MAX)] {
        let mut written = vec![!0; codes.len()];
        (soa.encode)(&x, &y, &mut written).unwrap();
        let expected: Vec<Code> = codes.iter().copied().map(Code::from).collect();
        assert_eq!(written, expected, "{bits} bits");
        let given: Vec<Code> = given.iter().map(|&code| Code::from(code & mask)).collect();
        let (mut x, mut y) = (vec![UNWRITTEN; given.len()], vec![UNWRITTEN; given.len()]);
        (soa.decode)(&given, &mut x, &mut y).unwrap();
        for (i, v) in decoded.iter().enumerate() {
            assert_eq!([x[i], y[i]].map(f32::to_bits), v.map(f32::to_bits), "{bits} bits");
        }
    }
}

fn narrow_mask(bits: u32) -> u32 {
    if bits <= 8 {
        0xFF
    } else if bits <= 16 {
        0xFFFF
    } else {
        u32::MAX
    }
}

fn signs(vectors: &[[f32; 2]]) {
    let x = vectors.as_flattened();
    let mut bytes = vec![0xA5; x.len().div_ceil(8)];
    Sign::encode_slice(x, &mut bytes).unwrap();
    for i in 0..8 * bytes.len() {
        let below = x.get(i).is_some_and(|&x| x < 0.0);
        assert_eq!(bytes[i / 8] >> (i % 8) & 1, u8::from(below), "{x:?}");
    }
    for byte in &mut bytes {
        *byte ^= vectors.len() as u8;
    }
    let mut decoded = vec![UNWRITTEN; x.len()];
    Sign::decode_slice(&bytes, &mut decoded).unwrap();
    for (i, (&x, &decoded)) in x.iter().zip(&decoded).enumerate() {
        let code = bytes[i / 8] >> (i % 8);
        assert_eq!(decoded, if code & 1 == 1 { -1.0 } else { 1.0 });
        assert_eq!(Sign::decode(code), decoded);
        assert_eq!(Sign::encode(x), u8::from(x < 0.0));
    }
}
