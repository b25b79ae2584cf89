//! Scalar quantisation against exact integer arithmetic.

use std::fmt;

use unitpack::scalar::{BiasedUnorm, Fixed, Scalar, Snorm, Unorm};
use unitpack::{CodeInt, LengthMismatch};
use unitpack_test::random::{Rng, special_vectors};
use unitpack_test::tasks::check_all;

/// Which formula a grid has.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Unorm,
    Snorm,
    Biased,
    Fixed,
}

/// One grid, its type forgotten: the checks compile once.
#[derive(Clone, Copy)]
struct Grid {
    kind: Kind,
    bits: u32,
    encode_slice: fn(&[f32], &mut [u32]) -> Result<(), LengthMismatch>,
    decode_slice: fn(&[u32], &mut [f32]) -> Result<(), LengthMismatch>,
}

impl Grid {
    const fn of<S: Scalar>(kind: Kind) -> Self {
        Grid {
            kind,
            bits: S::BITS,
            encode_slice: S::encode_slice::<u32>,
            decode_slice: S::decode_slice::<u32>,
        }
    }

    fn encode(&self, values: &[f32]) -> Vec<u32> {
        let mut codes = vec![u32::MAX; values.len()];
        (self.encode_slice)(values, &mut codes).unwrap();
        codes
    }

    fn decode(&self, codes: &[u32]) -> Vec<f32> {
        let mut values = vec![f32::NAN; codes.len()];
        (self.decode_slice)(codes, &mut values).unwrap();
        values
    }
}

impl fmt::Display for Grid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}<{}>", self.kind, self.bits)
    }
}

macro_rules! grids {
    ($($bits:literal)*) => {
        &[$(
            Grid::of::<Unorm<$bits>>(Kind::Unorm),
            Grid::of::<Snorm<$bits>>(Kind::Snorm),
            Grid::of::<BiasedUnorm<$bits>>(Kind::Biased),
            Grid::of::<Fixed<$bits>>(Kind::Fixed),
        )*]
    };
}

/// Every grid, the widest first.
static GRIDS: &[Grid] = grids!(24 23 22 21 20 19 18 17 16 15 14 13 12 11 10 9 8 7 6 5 4 3 2);

/// The integer that a code means: its low bits, with their sign if it has one.
fn meaning(kind: Kind, bits: u32, code: u32) -> i64 {
    let code = i64::from(code) % (1 << bits);
    let signed = if code < 1 << (bits - 1) { code } else { code - (1 << bits) };
    match kind {
        Kind::Unorm | Kind::Biased => code,
        Kind::Snorm => signed.max(1 - (1 << (bits - 1))),
        Kind::Fixed => signed,
    }
}

/// What it stands for. A quotient rounded to `f64` and then to `f32` is rounded correctly.
fn value(Grid { kind, bits, .. }: Grid, code: u32) -> f32 {
    let i = meaning(kind, bits, code) as f64;
    let full = (1u64 << bits) as f64;
    let exact = match kind {
        Kind::Unorm => i / (full - 1.0),
        Kind::Snorm => i / (full / 2.0 - 1.0),
        Kind::Biased => (i - (full - 1.0 - i)) / (full - 1.0),
        Kind::Fixed => i / (full / 2.0),
    };
    exact as f32
}

/// The nearest code, ties to even, in integers: no rounding but the last.
fn nearest(Grid { kind, bits, .. }: Grid, x: f32) -> u32 {
    let least = if kind == Kind::Unorm { 0.0 } else { -1.0 };
    let x = if x.is_nan() { 0.0 } else { f64::from(x).clamp(least, 1.0) };
    // x as a fraction of 2^80. What is smaller only keeps its side of zero.
    let scaled = x * (1u128 << 80) as f64;
    let x = if scaled != 0.0 && scaled.abs() < 1.0 { x.signum() as i128 } else { scaled as i128 };
    let full = 1i128 << bits;
    // The exact, real index is `above / 2^shift`.
    let (above, shift) = match kind {
        Kind::Unorm => (x * (full - 1), 80),
        Kind::Snorm => (x * (full / 2 - 1), 80),
        Kind::Biased => ((x + (1 << 80)) * (full - 1), 81),
        Kind::Fixed => (x * (full / 2), 80),
    };
    let below = 1i128 << shift;
    let (floor, rest) = (above >> shift, above & (below - 1));
    let up = 2 * rest > below || 2 * rest == below && floor % 2 != 0;
    let index = floor + i128::from(up);
    let index = if kind == Kind::Fixed { index.min(full / 2 - 1) } else { index };
    (index & (full - 1)) as u32
}

fn check_every_code(grid: &Grid) -> Result<(), String> {
    let all: Vec<u32> = (0..1 << grid.bits).collect();
    for codes in all.chunks(100_003) {
        let values = grid.decode(codes);
        let back = grid.encode(&values);
        for ((&code, value_got), back) in codes.iter().zip(values).zip(back) {
            let right = value(*grid, code);
            if value_got.to_bits() != right.to_bits() {
                return Err(format!("{grid}: {code} is {value_got}, not {right}"));
            }
            // The one pattern that no encoder emits.
            let spare = grid.kind == Kind::Snorm && code == 1 << (grid.bits - 1);
            if back != code + u32::from(spare) {
                return Err(format!("{grid}: {code} comes back as {back}"));
            }
        }
    }
    Ok(())
}

#[test]
fn every_code_has_its_value_and_comes_back() {
    check_all(GRIDS, check_every_code);
}

fn check_nearest(grid: &Grid, values: &[f32]) -> Result<(), String> {
    for (&x, code) in values.iter().zip(grid.encode(values)) {
        let right = nearest(*grid, x);
        if code != right {
            return Err(format!("{grid}: {x:e} is {code}, not {right}"));
        }
    }
    Ok(())
}

/// Half way between codes, and the `f32` to each side.
fn check_midpoints(grid: &Grid) -> Result<(), String> {
    let mut rng = Rng::new(u64::from(grid.bits));
    let count = 1u64 << grid.bits;
    let codes: Vec<u32> = if grid.bits <= 16 {
        (0..count as u32).collect()
    } else {
        (0..1 << 15).map(|_| rng.below(count) as u32).collect()
    };
    let full = count as f64;
    let step = match grid.kind {
        Kind::Unorm => 1.0 / (full - 1.0),
        Kind::Snorm => 1.0 / (full / 2.0 - 1.0),
        Kind::Biased => 2.0 / (full - 1.0),
        Kind::Fixed => 2.0 / full,
    };
    let mut values = Vec::new();
    for code in codes {
        let here = f64::from(value(*grid, code));
        for middle in [here - step / 2.0, here + step / 2.0] {
            let bits = (middle as f32).to_bits();
            values.extend((0..3).map(|i| f32::from_bits(bits.wrapping_add(i).wrapping_sub(1))));
        }
    }
    check_nearest(grid, &values)
}

#[test]
fn encoding_is_nearest_around_midpoints() {
    check_all(GRIDS, check_midpoints);
}

/// Every float from 1/2 to 1, where the steps of `f32` and of the grid are closest.
fn check_upper_octave(grid: &Grid) -> Result<(), String> {
    for from in (0x3F00_0000..0x3F80_0000).step_by(1 << 16) {
        let values: Vec<f32> = (from..from + (1 << 16)).map(f32::from_bits).collect();
        check_nearest(grid, &values)?;
        if grid.kind != Kind::Unorm {
            let values: Vec<f32> = values.iter().map(|x| -x).collect();
            check_nearest(grid, &values)?;
        }
    }
    Ok(())
}

#[test]
fn encoding_is_nearest_for_every_large_float() {
    check_all(grids!(24 23), check_upper_octave);
}

/// Any bits at all, and what the documentation names.
fn check_any_float(grid: &Grid) -> Result<(), String> {
    let mut rng = Rng::new(7);
    let mut values: Vec<f32> = special_vectors().as_flattened().to_vec();
    values.extend([f32::from_bits(0xFFC0_0001), -1.0f32.next_down(), 1.0f32.next_up(), 1.5, -7.0]);
    values.extend((0..20_000).map(|_| f32::from_bits(rng.bits() as u32)));
    values.extend((0..20_000).map(|_| rng.unit() as f32 * 2.0 - 1.0));
    // Down to the subnormal, where half a step of the grid is many.
    values.extend((0..150).flat_map(|e| [2f32.powi(-e), -2f32.powi(-e), 1.5 * 2f32.powi(-e)]));
    check_nearest(grid, &values)
}

#[test]
fn any_float_is_clamped_and_encoded_to_the_nearest() {
    check_all(GRIDS, check_any_float);
}

fn check_exact_values(grid: &Grid) -> Result<(), String> {
    let exact: &[f32] = match grid.kind {
        Kind::Unorm => &[0.0, 1.0],
        Kind::Snorm => &[-1.0, 0.0, 1.0],
        Kind::Biased => &[-1.0, 1.0],
        Kind::Fixed => &[-1.0, 0.0],
    };
    let back = grid.decode(&grid.encode(exact));
    let wrong = exact.iter().zip(back).find(|(x, back)| x.to_bits() != back.to_bits());
    let zero = if grid.kind == Kind::Biased { 1 << (grid.bits - 1) } else { 0 };
    match wrong {
        Some((x, back)) => Err(format!("{grid}: {x} comes back as {back}")),
        None if grid.encode(&[f32::NAN, -f32::NAN, 0.0, -0.0]) != [zero; 4] => {
            Err(format!("{grid}: NaN or -0 is not {zero}"))
        }
        None => Ok(()),
    }
}

#[test]
fn the_stated_values_are_exact_and_nan_is_zero() {
    check_all(GRIDS, check_exact_values);
}

/// Codes with rubbish above their bits, at every length up to three blocks.
fn check_storage<S: Scalar, C: CodeInt + TryFrom<u32>>() -> Result<(), String> {
    let mut rng = Rng::new(3);
    let integer = |bits: u64| {
        let bits = bits as u32 & (u32::MAX >> (32 - 8 * size_of::<C>()));
        C::try_from(bits).ok().unwrap()
    };
    for len in 0..=24 {
        let codes: Vec<C> = (0..len).map(|_| integer(rng.bits())).collect();
        let mut values = vec![7.0; len];
        S::decode_slice(&codes, &mut values).unwrap();
        let mut back: Vec<C> = codes.iter().rev().copied().collect();
        S::encode_slice(&values, &mut back).unwrap();
        for ((&code, value), back) in codes.iter().zip(values).zip(back) {
            let wide: u32 = code.into();
            if value.to_bits() != S::decode(wide).to_bits()
                || value.to_bits() != S::decode(wide % (1 << S::BITS)).to_bits()
                || back.into() != S::encode(value)
                || S::encode(value) >= 1 << S::BITS
            {
                return Err(format!("{} bits of {code:?}: {value}, {back:?}", S::BITS));
            }
        }
    }
    Ok(())
}

#[test]
fn every_integer_holds_the_same_codes_as_the_single_form() {
    let checks: &[fn() -> Result<(), String>] = &[
        check_storage::<Unorm<2>, u8>,
        check_storage::<Snorm<5>, u8>,
        check_storage::<BiasedUnorm<8>, u8>,
        check_storage::<Fixed<7>, u8>,
        check_storage::<Unorm<8>, u16>,
        check_storage::<Snorm<16>, u16>,
        check_storage::<BiasedUnorm<12>, u16>,
        check_storage::<Fixed<10>, u16>,
        check_storage::<Unorm<24>, u32>,
        check_storage::<Snorm<23>, u32>,
        check_storage::<BiasedUnorm<24>, u32>,
        check_storage::<Fixed<3>, u32>,
    ];
    check_all(checks, |check| check());
}

#[test]
fn a_mismatch_of_lengths_says_them_and_writes_nothing() {
    let error = LengthMismatch::Values { values: 9, codes: 17 };
    let mut codes = [77u8; 17];
    assert_eq!(Snorm::<8>::encode_slice(&[0.5; 9], &mut codes), Err(error));
    assert_eq!(codes, [77; 17]);
    let mut values = [0.25; 9];
    assert_eq!(Snorm::<8>::decode_slice(&codes, &mut values), Err(error));
    assert_eq!(values, [0.25; 9]);
    assert_eq!(error.to_string(), "lengths differ: values 9, codes 17");
}
