//! Signs in a bit and angles in 1 to 24 bits, against `f64` angles.

use std::f64::consts::{PI, TAU};

use unitpack::CodeInt;
use unitpack::LengthMismatch;
use unitpack::low_dimensions::{Angle, Sign};
use unitpack_test::random::Rng;

/// How far off the nearest code rounding to `f32` may lead, in radians.
const ROUNDING: f64 = 1.3e-7;

/// Calls a function of a width for several.
macro_rules! widths {
    ($check:ident: $($bits:literal)*) => { $($check::<$bits>();)* };
    ($check:ident) => {
        widths!($check: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24);
    };
}

fn direction_of(code: u32, bits: u32) -> [f64; 2] {
    let (sin, cos) = (TAU * f64::from(code) / f64::from(1 << bits)).sin_cos();
    [cos, sin]
}

/// Radians between vectors of any length.
fn angle(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs()
}

/// Checks the code of a finite vector that is not zero, and gives its error in radians.
fn check_nearest<const BITS: u32>(v: [f32; 2]) -> f64 {
    let code = Angle::<BITS>::encode(v);
    assert!(code < 1 << BITS, "{BITS} bits: {v:?} = {code}");
    let wide = v.map(f64::from);
    let limit = PI / f64::from(1 << BITS);
    let error = angle(wide, direction_of(code, BITS));
    assert!(error <= limit + ROUNDING, "{BITS} bits: {v:?} = {code}, off by {error:e}");
    let error = angle(wide, Angle::<BITS>::decode(code).map(f64::from));
    assert!(error <= limit + ROUNDING, "{BITS} bits: {v:?} = {code}, off by {error:e}");
    error
}

fn every_code_comes_back<const BITS: u32>() {
    const BLOCK: u32 = 1 << 16;
    for first in (0..1 << BITS).step_by(BLOCK as usize) {
        let codes: Vec<u32> = (first..(first + BLOCK).min(1 << BITS)).collect();
        let (mut x, mut y) = (vec![0.0; codes.len()], vec![0.0; codes.len()]);
        Angle::<BITS>::decode_soa(&codes, &mut x, &mut y).unwrap();
        let mut again = vec![0u32; codes.len()];
        Angle::<BITS>::encode_soa(&x, &y, &mut again).unwrap();
        let moved = codes.iter().zip(&again).find(|(code, again)| code != again);
        assert_eq!(moved, None, "{BITS} bits");
    }
}

#[test]
fn every_code_of_every_width_comes_back() {
    widths!(every_code_comes_back);
}

fn codes_decode_accurately<const BITS: u32>() {
    let stride = if BITS <= 20 { 1 } else { 31 };
    for code in (0u32..1 << BITS).step_by(stride) {
        let [x, y] = Angle::<BITS>::decode(code).map(f64::from);
        let [cos, sin] = direction_of(code, BITS);
        let error = (x - cos).abs().max((y - sin).abs());
        assert!(error < 1.2e-7, "{BITS} bits: {code} = {x}, {y}, off by {error:e}");
        let length = x.hypot(y);
        assert!((length - 1.0).abs() <= 2.5e-7, "{BITS} bits: {code} has length {length}");
    }
}

#[test]
fn codes_decode_to_their_angles() {
    widths!(codes_decode_accurately);
}

fn axes_survive<const BITS: u32>() {
    let quarters: u32 = if BITS == 1 { 2 } else { 4 };
    let axes = [[1.0f32, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    for quarter in 0..quarters {
        let axis = axes[(quarter * 4 / quarters) as usize];
        let code = quarter << BITS >> quarters.ilog2();
        assert_eq!(Angle::<BITS>::encode(axis), code);
        // No zero has a sign.
        assert_eq!(Angle::<BITS>::decode(code).map(f32::to_bits), axis.map(f32::to_bits));
        assert_eq!(Angle::<BITS>::encode(axis.map(|c| if c == 0.0 { -0.0 } else { c })), code);
    }
}

#[test]
fn axes_survive_exactly() {
    widths!(axes_survive);
}

fn the_nearest_is_chosen<const BITS: u32>() {
    let mut rng = Rng::new(u64::from(BITS));
    let mut greatest = 0.0f64;
    for i in 0..60_000 {
        // In turn anywhere, and half way between two codes, a few units in the last place off.
        let turns = match i % 3 {
            0 => rng.unit(),
            _ => (rng.below(1 << BITS) as f64 + 0.5) / f64::from(1 << BITS),
        };
        let (sin, cos) = (TAU * turns).sin_cos();
        let scale = rng.pick(&[1.0, 1.0, 3.0, 1e-3, 1e25, 1e-25]);
        let mut v = [cos * scale, sin * scale].map(|c| c as f32);
        if i % 3 == 2 {
            let c = &mut v[rng.below(2) as usize];
            *c = f32::from_bits(c.to_bits().wrapping_add(rng.below(5) as u32).wrapping_sub(2));
        }
        greatest = greatest.max(check_nearest::<BITS>(v));
    }
    let step = TAU / f64::from(1 << BITS);
    assert!(greatest > 0.49 * step, "{BITS} bits: the ties were missed");
    eprintln!("{BITS} bits: half a step {:+.2e} radians", greatest - 0.5 * step);
}

#[test]
fn the_nearest_code_is_chosen_up_to_rounding() {
    widths!(the_nearest_is_chosen);
}

#[test]
fn of_two_equally_near_codes_the_even_one_is_chosen() {
    for (v, code) in [([1.0, 1.0], 0), ([-1.0, 1.0], 2), ([-1.0, -1.0], 2), ([1.0, -1.0], 0)] {
        assert_eq!(Angle::<2>::encode(v), code, "{v:?}");
    }
    for v in [[0.0, 1.0], [0.0, -1.0], [-0.0, 5.0]] {
        assert_eq!(Angle::<1>::encode(v), 0, "{v:?}");
    }
}

/// In eighths of a turn.
#[test]
fn any_input_has_a_code() {
    let (inf, nan) = (f32::INFINITY, f32::NAN);
    let (least, greatest) = (f32::from_bits(1), f32::MAX);
    for (v, eighths) in [
        ([0.0, 0.0], 0),
        ([-0.0, -0.0], 0),
        ([-0.0, 0.0], 0),
        ([nan, 0.0], 0),
        ([-1.0, nan], 0),
        ([nan, -inf], 0),
        ([inf, 3.0], 0),
        ([greatest, inf], 2),
        ([-inf, 3.0], 4),
        ([-inf, -greatest], 4),
        ([5.0, -inf], 6),
        ([inf, inf], 1),
        ([-inf, inf], 3),
        ([-inf, -inf], 5),
        ([inf, -inf], 7),
        ([greatest, greatest], 1),
        ([-greatest, 1.0], 4),
        ([-least, least], 3),
        ([0.0, -least], 6),
        ([least, 0.0], 0),
        ([least, -greatest], 6),
    ] {
        assert_eq!(Angle::<3>::encode(v), eighths, "{v:?}");
        assert_eq!(Angle::<8>::encode(v), eighths << 5, "{v:?}");
        assert_eq!(Angle::<24>::encode(v), eighths << 21, "{v:?}");
    }
    // Subnormal and huge vectors have few digits, but a direction.
    for v in [[3e-45, 7e-45], [-1e-40, 3e-41], [3e38, -1e38], [1e-30, 2e-32]] {
        check_nearest::<24>(v);
        check_nearest::<5>(v);
    }
}

#[test]
fn only_the_direction_matters() {
    let mut rng = Rng::new(7);
    for _ in 0..10_000 {
        let [x, y, _] = rng.direction();
        let code = Angle::<24>::encode([x, y]);
        for scale in [-90, -30, 30, 90].map(|e| 2f32.powi(e)) {
            assert_eq!(Angle::<24>::encode([x * scale, y * scale]), code);
        }
    }
}

fn unused_bits_are_ignored<const BITS: u32>() {
    let mut rng = Rng::new(3);
    for _ in 0..100 {
        let code = rng.bits() as u32;
        let used = code & ((1 << BITS) - 1);
        assert_eq!(Angle::<BITS>::decode(code), Angle::<BITS>::decode(used));
    }
}

#[test]
fn bits_above_the_width_are_ignored() {
    widths!(unused_bits_are_ignored);
}

/// Every length about a block of eight, in one type of integer.
fn check_batches<const BITS: u32, T>()
where
    T: CodeInt + Into<u32> + TryFrom<u32, Error: std::fmt::Debug> + PartialEq,
{
    let mut rng = Rng::new(11);
    let special = [0.0, -0.0, 1.0, f32::NAN, f32::INFINITY, -1e-42, f32::MAX];
    for len in 0..40 {
        let mut component = |_| {
            let [c, special] = [rng.direction()[0], rng.pick(&special)];
            if rng.below(4) == 0 { special } else { c }
        };
        let x: Vec<f32> = (0..len).map(&mut component).collect();
        let y: Vec<f32> = (0..len).map(&mut component).collect();
        let zero = || T::try_from(0u32).unwrap();
        let mut codes: Vec<T> = (0..len).map(|_| zero()).collect();
        Angle::<BITS>::encode_soa(&x, &y, &mut codes).unwrap();
        for i in 0..len {
            assert_eq!(codes[i].into(), Angle::<BITS>::encode([x[i], y[i]]));
        }
        let patterns: Vec<T> =
            (0..len).map(|_| T::try_from(rng.bits() as u32 % (1 << BITS)).unwrap()).collect();
        let (mut x, mut y) = (vec![0.0; len], vec![0.0; len]);
        Angle::<BITS>::decode_soa(&patterns, &mut x, &mut y).unwrap();
        for i in 0..len {
            let v = Angle::<BITS>::decode(patterns[i].into());
            assert_eq!([x[i], y[i]].map(f32::to_bits), v.map(f32::to_bits));
        }
    }
}

#[test]
fn batches_give_the_bits_of_single_values() {
    check_batches::<1, u8>();
    check_batches::<2, u8>();
    check_batches::<8, u8>();
    check_batches::<8, u16>();
    check_batches::<12, u16>();
    check_batches::<16, u16>();
    check_batches::<3, u32>();
    check_batches::<24, u32>();
}

#[test]
fn angles_of_other_lengths_are_refused() {
    let codes = &mut [7u8; 3];
    let error = |x, y, codes| Err(LengthMismatch::Angles { x, y, codes });
    assert_eq!(Angle::<8>::encode_soa(&[0.0; 2], &[1.0; 3], codes), error(2, 3, 3));
    assert_eq!(Angle::<8>::encode_soa(&[0.0; 3], &[1.0; 4], codes), error(3, 4, 3));
    assert_eq!(*codes, [7; 3]);
    let (x, y) = (&mut [7.0; 3], &mut [7.0; 4]);
    assert_eq!(Angle::<8>::decode_soa(&[0u8; 3], x, y), error(3, 4, 3));
    assert_eq!((*x, *y), ([7.0; 3], [7.0; 4]));
}

#[test]
fn a_sign_is_one_bit() {
    let positive = [0.0, -0.0, 1.0, 1e-45, f32::MAX, f32::INFINITY, f32::NAN, -f32::NAN];
    let negative = [-1.0, -1e-45, -f32::MIN_POSITIVE, f32::MIN, f32::NEG_INFINITY];
    for x in positive {
        assert_eq!((Sign::encode(x), Sign::decode(Sign::encode(x))), (0, 1.0), "{x}");
    }
    for x in negative {
        assert_eq!((Sign::encode(x), Sign::decode(Sign::encode(x))), (1, -1.0), "{x}");
    }
    assert_eq!([0xFE, 0xFF].map(Sign::decode), [1.0, -1.0]);
}

#[test]
fn signs_are_packed_eight_to_a_byte() {
    let x = [-1.0, 2.0, -0.0, -3e-45, 0.0, f32::NAN, 1.0, f32::NEG_INFINITY, 5.0, -5.0];
    let mut bytes = [0xFF; 2];
    Sign::encode_slice(&x, &mut bytes).unwrap();
    assert_eq!(bytes, [0b1000_1001, 0b10]);
    let mut rng = Rng::new(5);
    for len in 0..70usize {
        let x: Vec<f32> = (0..len).map(|_| rng.direction()[0]).collect();
        let mut bytes = vec![0xFF; len.div_ceil(8)];
        Sign::encode_slice(&x, &mut bytes).unwrap();
        for bit in 0..8 * bytes.len() {
            let is_set = bytes[bit / 8] & (1 << (bit % 8)) != 0;
            assert_eq!(is_set, bit < len && x[bit] < 0.0);
        }
        // The bits of the last byte that no value has say nothing.
        if len % 8 != 0 {
            *bytes.last_mut().unwrap() |= 0xFF << (len % 8);
        }
        let mut back = vec![0.0f32; len];
        Sign::decode_slice(&bytes, &mut back).unwrap();
        assert!(back.iter().zip(&x).all(|(&back, &x)| back == 1f32.copysign(x)));
    }
}

#[test]
fn signs_of_other_lengths_are_refused() {
    for (values, bytes) in [(0, 1), (1, 0), (8, 2), (9, 1), (16, 3)] {
        let error = Err(LengthMismatch::Dense { codes: values, bytes, bits: 1 });
        let (mut x, mut packed) = (vec![7.0; values], vec![7; bytes]);
        assert_eq!(Sign::encode_slice(&x, &mut packed), error);
        assert_eq!(Sign::decode_slice(&packed, &mut x), error);
        assert!(x.iter().all(|&x| x == 7.0) && packed.iter().all(|&byte| byte == 7));
    }
}
