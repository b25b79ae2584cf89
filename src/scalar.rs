//! Scalar quantisation: numbers from -1 to 1, or 0 to 1, in 2 to 24 bits, singly and over slices.
//!
//! | type | a code i reads as | range | exact at |
//! |---|---|---|---|
//! | [`Unorm<BITS>`](Unorm) | i / M, M = 2^BITS - 1 | 0 to 1 | 0, 1 |
//! | [`Snorm<BITS>`](Snorm) | i / M, M = 2^(BITS-1) - 1 | -1 to 1 | -1, 0, 1 |
//! | [`BiasedUnorm<BITS>`](BiasedUnorm) | 2 i / M - 1, M = 2^BITS - 1 | -1 to 1 | -1, 1 |
//! | [`Fixed<BITS>`](Fixed) | i / 2^(BITS-1) | -1 to 1 - 2^-(BITS-1) | every code, so -1 and 0 |
//!
//! Encoding gives the code nearest to the number, ties to even, and decoding the `f32` nearest to
//! the exact quotient: neither has any other error. Therefore every code that an encoder emits
//! comes back from its decoded value. Codes are the low `BITS` bits, signed ones in two's
//! complement; the bits above are zero in encoding and ignored in decoding.
//!
//! Sources: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014, on quantisation; Khronos, "The OpenGL Graphics System", version 4.2 and later, on
//! normalised integers, whose snorm has one zero and reads -M-1 as -M.
//!
//! ```
//! use unitpack::scalar::{Scalar, Snorm, Unorm};
//!
//! assert_eq!(Unorm::<8>::encode(0.5), 128);
//! assert_eq!(Snorm::<12>::decode(0x801), -1.0);
//!
//! let roughness = [0.0, 0.25, 1.0, 7.0];
//! let mut codes = [0u16; 4];
//! Unorm::<10>::encode_slice(&roughness, &mut codes)?;
//! assert_eq!(codes, [0, 256, 1023, 1023]);
//! let mut back = [0.0; 4];
//! Unorm::<10>::decode_slice(&codes, &mut back)?;
//! assert_eq!(back, [0.0, 256.0 / 1023.0, 1.0, 1.0]);
//! # Ok::<(), unitpack::LengthMismatch>(())
//! ```

use crate::batch::code_int::{CodeInt, holds};
use crate::batch::columns::{CodeColumn, Columns};
use crate::batch::layout::{self, Codes, CodesMut, Vectors, VectorsMut};
use crate::batch::storage::Words;
use crate::batch::{Kernel, map, run};
use crate::error::LengthMismatch;
use crate::formula::support::bits::{snorm_field, snorm_max, unorm_max};
use crate::simd::{I32x1, Simd, SimdInt, Use};

/// A grid of numbers, and the codes of its points.
pub trait Scalar: Copy + 'static {
    /// How many bits a code has: 2 to 24. Another width does not compile:
    ///
    /// ```compile_fail
    /// use unitpack::scalar::{Scalar, Unorm};
    /// let _ = Unorm::<25>::encode(0.5);
    /// ```
    ///
    /// ```compile_fail
    /// use unitpack::scalar::{Fixed, Scalar};
    /// let _ = Fixed::<1>::decode(0);
    /// ```
    const BITS: u32;

    /// The code nearest to `x`, ties to even. What is out of range is clamped; NaN is taken as 0.
    fn encode(x: f32) -> u32;

    /// The `f32` nearest to the value of the low [`BITS`](Scalar::BITS) bits of `code`, any pattern.
    fn decode(code: u32) -> f32;

    /// [`encode`](Scalar::encode) for slices. Codes that do not fit their integer do not compile:
    ///
    /// ```compile_fail
    /// use unitpack::scalar::{Scalar, Snorm};
    /// let _ = Snorm::<12>::encode_slice(&[0.5], &mut [0u8]);
    /// ```
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    fn encode_slice<C: CodeInt>(values: &[f32], codes: &mut [C]) -> Result<(), LengthMismatch>;

    /// [`decode`](Scalar::decode) for slices. Codes that do not fit their integer do not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    fn decode_slice<C: CodeInt>(codes: &[C], values: &mut [f32]) -> Result<(), LengthMismatch>;
}

/// A [`Scalar`] on any number of lanes.
pub(crate) trait Grid: Copy + Send + Sync + 'static {
    /// The index of the nearest point, ties to even. Negative ones have their sign in all bits.
    fn nearest<V: Simd>(self, x: V) -> V::Int;
    /// The point of a code, whose bits above its width are ignored.
    fn value<V: Simd>(self, code: V::Int) -> V;
}

/// [`Scalar::encode`], of which the low bits count.
#[derive(Clone, Copy)]
struct Encode<G>(G, u32);
/// [`Scalar::decode`].
#[derive(Clone, Copy)]
struct Decode<G>(G);

impl<G: Grid> Kernel<Columns<1>, CodeColumn<Words>> for Encode<G> {
    const USE: Use = Use::Sometimes;

    #[inline(always)]
    fn run<V: Simd>(self, [x]: [V; 1]) -> V::Int {
        self.0.nearest(x).low_bits(self.1)
    }
}

impl<G: Grid> Kernel<CodeColumn<Words>, Columns<1>> for Decode<G> {
    const USE: Use = Use::Sometimes;

    #[inline(always)]
    fn run<V: Simd>(self, code: V::Int) -> [V; 1] {
        [self.0.value::<V>(code)]
    }
}

/// Writes the types and their `Scalar`. The loops are not generic, so that they are compiled here.
macro_rules! scalars {
    ($($(#[$doc:meta])* $name:ident: $grid:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct $name<const BITS: u32>;

        impl<const BITS: u32> Scalar for $name<BITS> {
            const BITS: u32 = {
                assert!(2 <= BITS && BITS <= 24, "a scalar code has 2 to 24 bits");
                BITS
            };

            #[inline]
            fn encode(x: f32) -> u32 {
                $grid { bits: Self::BITS }.nearest(x).low_bits(BITS).0 as u32
            }
            #[inline]
            fn decode(code: u32) -> f32 {
                $grid { bits: Self::BITS }.value(I32x1(code as i32))
            }
            #[inline]
            fn encode_slice<C: CodeInt>(
                values: &[f32],
                codes: &mut [C],
            ) -> Result<(), LengthMismatch> {
                const { assert!(holds::<C>(Self::BITS), "the integer is narrower than the codes") };
                LengthMismatch::check_values(values.len(), codes.len())?;
                $grid { bits: BITS }.encode_slice(values, CodesMut::native(codes));
                Ok(())
            }
            #[inline]
            fn decode_slice<C: CodeInt>(
                codes: &[C],
                values: &mut [f32],
            ) -> Result<(), LengthMismatch> {
                const { assert!(holds::<C>(Self::BITS), "the integer is narrower than the codes") };
                LengthMismatch::check_values(values.len(), codes.len())?;
                $grid { bits: BITS }.decode_slice(Codes::native(codes), values);
                Ok(())
            }
        }

        impl $grid {
            #[inline(never)]
            fn encode_slice(self, values: &[f32], codes: CodesMut<'_>) {
                layout::encode(Vectors::Columns([values]), codes, &mut |values, codes| {
                    map::<Columns<1>, CodeColumn<Words>>(Encode(self, self.bits), values, codes);
                });
            }
            #[inline(never)]
            fn decode_slice(self, codes: Codes<'_>, values: &mut [f32]) {
                layout::decode(codes, VectorsMut::Columns([values]), &mut |codes, values, fence| {
                    run::<CodeColumn<Words>, Columns<1>>(Decode(self), codes, values, fence);
                });
            }
        }
    )*};
}

scalars! {
    /// Unsigned normalised: i / M from 0 to 1, with M = 2^`BITS` - 1. Exact at 0 and 1.
    Unorm: UnormGrid;
    /// Signed normalised: i / M from -1 to 1, with M = 2^(`BITS`-1) - 1. Exact at -1, 0 and 1. The
    /// pattern -M-1 reads as -M.
    Snorm: SnormGrid;
    /// Scaled and biased unorm: (x + 1) / 2 as [`Unorm`], so 2 i / M - 1 from -1 to 1, with
    /// M = 2^`BITS` - 1. Exact at -1 and 1. Not at 0, which lies half way between two codes: it,
    /// and NaN, become the even one, 2^(`BITS`-1), which reads as 1 / M.
    BiasedUnorm: BiasedUnormGrid;
    /// Signed fixed point: i / 2^(`BITS`-1), from -1 to 1 - 2^-(`BITS`-1). Every code is exact, so
    /// -1 and 0 are. 1 is out of range.
    Fixed: FixedGrid;
}

#[derive(Clone, Copy)]
pub(crate) struct UnormGrid {
    bits: u32,
}
#[derive(Clone, Copy)]
pub(crate) struct SnormGrid {
    bits: u32,
}
#[derive(Clone, Copy)]
pub(crate) struct BiasedUnormGrid {
    bits: u32,
}
#[derive(Clone, Copy)]
pub(crate) struct FixedGrid {
    bits: u32,
}

impl Grid for UnormGrid {
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V) -> V::Int {
        times_max(clamp(x).max(0.0), self.bits)
    }
    #[inline(always)]
    fn value<V: Simd>(self, code: V::Int) -> V {
        V::from_int(code.low_bits(self.bits)) / unorm_max(self.bits) as f32
    }
}

impl SnormGrid {
    pub(crate) const fn new(bits: u32) -> Self {
        SnormGrid { bits }
    }
}

impl Grid for SnormGrid {
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V) -> V::Int {
        let x = clamp(x);
        let magnitude = times_max(x.abs(), self.bits - 1);
        V::Int::select(x.lt(0.0), -magnitude, magnitude)
    }
    #[inline(always)]
    fn value<V: Simd>(self, code: V::Int) -> V {
        let max = snorm_max(self.bits);
        V::from_int(snorm_field::<V>(code, 0, self.bits)) / max as f32
    }
}

impl Grid for BiasedUnormGrid {
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V) -> V::Int {
        // (x + 1) / 2 M = 2^(BITS-1) + n + rest - (x + 1) / 2, with n + rest = 2^(BITS-1) x: all
        // exact.
        let x = clamp(x);
        let (n, rest) = scale(x, self.bits - 1);
        one_less_where_less(n, rest + rest, x) + (1 << (self.bits - 1))
    }
    #[inline(always)]
    fn value<V: Simd>(self, code: V::Int) -> V {
        let max = unorm_max(self.bits);
        let code = code.low_bits(self.bits);
        V::from_int(code + code - max) / max as f32
    }
}

impl Grid for FixedGrid {
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V) -> V::Int {
        let (n, _) = scale(clamp(x), self.bits - 1);
        n.min(snorm_max(self.bits))
    }
    #[inline(always)]
    fn value<V: Simd>(self, code: V::Int) -> V {
        V::from_int(code.sign_extend(self.bits)) / (1 << (self.bits - 1)) as f32
    }
}

/// From -1 to 1; NaN becomes 0.
#[inline(always)]
fn clamp<V: Simd>(x: V) -> V {
    // `max` alone would not do: see there.
    let x = V::select(x.le(x), x, 0.0);
    x.max(-1.0).min(1.0)
}

/// 2^`bits` x as the nearest integer, ties to even, and what is left, -1/2 to 1/2. Both exact for
/// |x| <= 1 and at most 24 bits.
#[inline(always)]
fn scale<V: Simd>(x: V, bits: u32) -> (V::Int, V) {
    let scaled = x * (1 << bits) as f32;
    let n = if bits <= 22 { scaled.round_int() } else { scaled.round_int_wide() };
    (n, scaled - V::from_int(n))
}

/// The integer nearest to (2^`bits` - 1) x, ties to even, for 0 <= x <= 1.
///
/// The product itself needs up to 48 bits, and rounding it to `f32` first may make a tie of what is
/// none. But it is n + rest - x, with n + rest = 2^`bits` x, and rest + 1/2 is exact wherever it is
/// not greater than x.
#[inline(always)]
fn times_max<V: Simd>(x: V, bits: u32) -> V::Int {
    let (n, rest) = scale(x, bits);
    one_less_where_less(n, rest + 0.5, x)
}

/// n - 1 where a < b; where they are equal, the even one of n and n - 1; otherwise n.
#[inline(always)]
fn one_less_where_less<V: Simd>(n: V::Int, a: V, b: V) -> V::Int {
    let odd = n.low_bits(1).eq(1);
    let less = a.lt(b) | (a.le(b) & odd);
    V::Int::select(less, n - 1, n)
}
