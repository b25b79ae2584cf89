//! Scalars: the nearest code and the nearest value, against exact arithmetic in f64; slices give
//! what single numbers give.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::scalar::{BiasedUnorm, Fixed, Scalar, Snorm, Unorm};
use unitpack::{CodeInt, LengthMismatch};
use unitpack_fuzz::Bytes;
use unitpack_test::codes::{integer, native, natives, write_codes};
use unitpack_test::{Code, UNWRITTEN};

#[derive(Clone, Copy, PartialEq, Debug)]
enum Kind {
    Unorm,
    Snorm,
    BiasedUnorm,
    Fixed,
}

/// Codes of one integer type.
#[derive(Clone, Copy)]
struct Slices {
    bits: u32,
    encode: fn(&[f32], &mut [Code]) -> Result<(), LengthMismatch>,
    decode: fn(&[Code], &mut [f32]) -> Result<(), LengthMismatch>,
}

struct Grid {
    kind: Kind,
    bits: u32,
    encode: fn(f32) -> u32,
    decode: fn(u32) -> f32,
    slices: [Slices; 2],
}

const fn slices<S: Scalar, C: CodeInt>() -> Slices {
    Slices {
        bits: 8 * size_of::<C>() as u32,
        encode: |values, codes| {
            write_codes::<C, _>(codes, &mut |codes| S::encode_slice(values, codes))
        },
        decode: |codes, values| S::decode_slice(&natives::<C>(codes), values),
    }
}

const fn grid<S: Scalar, C: CodeInt>(kind: Kind) -> Grid {
    Grid {
        kind,
        bits: S::BITS,
        encode: S::encode,
        decode: S::decode,
        slices: [slices::<S, C>(), slices::<S, u32>()],
    }
}

/// All kinds at each width, with the narrowest integer that holds them beside u32.
macro_rules! grids {
    ($($code:ty: $($bits:literal)*;)*) => {
        [$($(
            grid::<Unorm<$bits>, $code>(Kind::Unorm),
            grid::<Snorm<$bits>, $code>(Kind::Snorm),
            grid::<BiasedUnorm<$bits>, $code>(Kind::BiasedUnorm),
            grid::<Fixed<$bits>, $code>(Kind::Fixed),
        )*)*]
    };
}

static GRIDS: [Grid; 92] = grids! {
    u8: 2 3 4 5 6 7 8;
    u16: 9 10 11 12 13 14 15 16;
    u32: 17 18 19 20 21 22 23 24;
};

impl Grid {
    /// The code as a number: signed, and not below the least that means something.
    fn index(&self, code: u32) -> f64 {
        let low = code << (32 - self.bits);
        match self.kind {
            Kind::Unorm | Kind::BiasedUnorm => f64::from(low >> (32 - self.bits)),
            Kind::Fixed => f64::from(low as i32 >> (32 - self.bits)),
            Kind::Snorm => f64::from(low as i32 >> (32 - self.bits)).max(-self.steps()),
        }
    }

    /// Steps from 0 to 1; of biased unorm, from -1 to 1.
    fn steps(&self) -> f64 {
        let power = |bits: u32| f64::from(1u32 << bits);
        match self.kind {
            Kind::Unorm | Kind::BiasedUnorm => power(self.bits) - 1.0,
            Kind::Snorm => power(self.bits - 1) - 1.0,
            Kind::Fixed => power(self.bits - 1),
        }
    }

    /// The index nearest to a number, ties to even. The products, of 48 bits, are exact.
    fn nearest(&self, x: f32) -> f64 {
        let steps = self.steps();
        let x = if x.is_nan() { 0.0 } else { f64::from(x) };
        match self.kind {
            Kind::Unorm => (x.clamp(0.0, 1.0) * steps).round_ties_even(),
            Kind::Snorm => (x.clamp(-1.0, 1.0) * steps).round_ties_even(),
            Kind::Fixed => (x.clamp(-1.0, 1.0) * steps).round_ties_even().min(steps - 1.0),
            Kind::BiasedUnorm => {
                // Index i stands at the odd number 2 i - steps of steps.
                let at = x.clamp(-1.0, 1.0) * steps;
                let odd = 2.0 * (at / 2.0).floor() + 1.0;
                let i = (odd + steps) / 2.0;
                // Half way between the odd numbers around an even one.
                if odd - at == 1.0 && i % 2.0 == 1.0 { i - 1.0 } else { i }
            }
        }
    }

    fn value(&self, code: u32) -> f32 {
        let (index, steps) = (self.index(code), self.steps());
        let numerator = if self.kind == Kind::BiasedUnorm { 2.0 * index - steps } else { index };
        // With so short a divisor, rounding twice is rounding once.
        (numerator / steps) as f32
    }
}

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let grid = &GRIDS[usize::from(bytes.byte()) % GRIDS.len()];
    let of = format!("{:?} of {} bits", grid.kind, grid.bits);
    let words = bytes.rest::<4>();
    let used = u32::MAX >> (32 - grid.bits);

    let given: Vec<u32> = words.iter().map(|&word| u32::from_le_bytes(word)).collect();
    // Any floats, and such as are in range.
    let mut values: Vec<f32> = given.iter().map(|&word| f32::from_bits(word)).collect();
    values.extend(given.iter().map(|&word| word as i32 as f32 / 2f32.powi(31)));
    // Points of the grid, half way between two, and beside that.
    for &word in &given {
        let (a, b) = (grid.value(word), grid.value(word.wrapping_add(1)));
        let middle = (a + b) / 2.0;
        values.extend([a, middle, middle.next_up(), middle.next_down()]);
    }

    let codes: Vec<u32> = values.iter().map(|&x| (grid.encode)(x)).collect();
    for (&x, &code) in values.iter().zip(&codes) {
        assert_eq!(code & !used, 0, "{of}: {x:e} is {code:x}");
        assert_eq!(grid.index(code), grid.nearest(x), "{of}: {x:e} is {code:x}");
        assert_eq!((grid.encode)((grid.decode)(code)), code, "{of}");
    }
    for &code in &given {
        let value = (grid.decode)(code);
        assert_eq!(value.to_bits(), grid.value(code).to_bits(), "{of}: {code:x}");
        let again = (grid.encode)(value);
        assert_eq!(grid.index(again), grid.index(code), "{of}: {code:x}");
    }
    for slices in &grid.slices {
        let mut written = vec![!0; values.len()];
        (slices.encode)(&values, &mut written).unwrap();
        let expected: Vec<Code> = codes.iter().map(|&code| integer(code)).collect();
        assert_eq!(written, expected, "{of} in {}", slices.bits);

        let given: Vec<Code> =
            given.iter().map(|&code| integer(code & u32::MAX >> (32 - slices.bits))).collect();
        let mut written = vec![UNWRITTEN; given.len()];
        (slices.decode)(&given, &mut written).unwrap();
        for (&code, x) in given.iter().zip(written) {
            let single = (grid.decode)(native(code));
            assert_eq!(x.to_bits(), single.to_bits(), "{of} in {}: {code:x}", slices.bits);
        }
    }
});
