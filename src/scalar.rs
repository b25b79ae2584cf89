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
//! comes back from its decoded value. Codes stand in the low `BITS` bits, signed ones in two's
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

use core::marker::PhantomData;

use crate::batch::code_int::{CodeInt, holds};
use crate::batch::{self, Kernel};
use crate::error::LengthMismatch;
use crate::formula::bits::{snorm_max, unorm_max};
use crate::simd::{Simd, SimdInt};

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

    /// The `f32` nearest to what the low [`BITS`](Scalar::BITS) bits of `code`, any pattern, stand
    /// for.
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

/// A [`Scalar`] as arithmetic on lanes.
pub(crate) trait Grid: 'static {
    const BITS: u32;
    /// The index of the nearest point, ties to even. Negative ones have their sign in all bits.
    fn nearest<V: Simd>(x: V) -> V::Int;
    /// The point of a code, whose bits above `BITS` are ignored.
    fn value<V: Simd>(code: V::Int) -> V;
}

/// [`Scalar::encode`].
struct Encode<G>(PhantomData<G>);
/// [`Scalar::decode`].
struct Decode<G>(PhantomData<G>);

impl<G: Grid, C: CodeInt> Kernel<f32, C> for Encode<G> {
    #[inline(always)]
    fn run<V: Simd>(values: &V::Block<f32>, codes: &mut V::Block<C>) {
        const { assert!(holds::<C>(G::BITS), "the integer is narrower than the codes") };
        let code = G::nearest(V::load(values)).low(G::BITS);
        V::store_int(code, codes, |c, i| *c = C::truncate(i));
    }
}

impl<G: Grid, C: CodeInt> Kernel<C, f32> for Decode<G> {
    #[inline(always)]
    fn run<V: Simd>(codes: &V::Block<C>, values: &mut V::Block<f32>) {
        const { assert!(holds::<C>(G::BITS), "the integer is narrower than the codes") };
        G::value::<V>(V::load_int(codes, C::into)).store(values);
    }
}

/// Writes the types and their `Scalar`.
macro_rules! scalars {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
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
                batch::run_one::<Encode<Self>, f32, u32>(x)
            }
            #[inline]
            fn decode(code: u32) -> f32 {
                batch::run_one::<Decode<Self>, u32, f32>(code)
            }
            #[inline]
            fn encode_slice<C: CodeInt>(
                values: &[f32],
                codes: &mut [C],
            ) -> Result<(), LengthMismatch> {
                LengthMismatch::check_values(values.len(), codes.len())?;
                batch::run::<Encode<Self>, f32, C>(values, codes);
                Ok(())
            }
            #[inline]
            fn decode_slice<C: CodeInt>(
                codes: &[C],
                values: &mut [f32],
            ) -> Result<(), LengthMismatch> {
                LengthMismatch::check_values(values.len(), codes.len())?;
                batch::run::<Decode<Self>, C, f32>(codes, values);
                Ok(())
            }
        }
    )*};
}

scalars! {
    /// Unsigned normalised: i / M from 0 to 1, with M = 2^`BITS` - 1. Exact at 0 and 1.
    Unorm;
    /// Signed normalised: i / M from -1 to 1, with M = 2^(`BITS`-1) - 1. Exact at -1, 0 and 1. The
    /// pattern -M-1 reads as -M.
    Snorm;
    /// Scaled and biased unorm: (x + 1) / 2 as [`Unorm`], so 2 i / M - 1 from -1 to 1, with
    /// M = 2^`BITS` - 1. Exact at -1 and 1. Not at 0, which lies half way between two codes: it,
    /// and NaN, become the even one, 2^(`BITS`-1), which reads as 1 / M.
    BiasedUnorm;
    /// Signed fixed point: i / 2^(`BITS`-1), from -1 to 1 - 2^-(`BITS`-1). Every code is exact, so
    /// -1 and 0 are. 1 is out of range.
    Fixed;
}

impl<const BITS: u32> Grid for Unorm<BITS> {
    const BITS: u32 = <Self as Scalar>::BITS;

    #[inline(always)]
    fn nearest<V: Simd>(x: V) -> V::Int {
        times_max(clamp(x).greater(V::zero()), BITS)
    }
    #[inline(always)]
    fn value<V: Simd>(code: V::Int) -> V {
        V::from_int(code.low(BITS)) / V::splat(unorm_max(BITS) as f32)
    }
}

impl<const BITS: u32> Grid for Snorm<BITS> {
    const BITS: u32 = <Self as Scalar>::BITS;

    #[inline(always)]
    fn nearest<V: Simd>(x: V) -> V::Int {
        let x = clamp(x);
        let magnitude = times_max(x.abs(), BITS - 1);
        V::Int::select(x.lt(V::zero()), -magnitude, magnitude)
    }
    #[inline(always)]
    fn value<V: Simd>(code: V::Int) -> V {
        let max = snorm_max(BITS);
        V::from_int(code.sign_extend(BITS).max(V::Int::splat(-max))) / V::splat(max as f32)
    }
}

impl<const BITS: u32> Grid for BiasedUnorm<BITS> {
    const BITS: u32 = <Self as Scalar>::BITS;

    #[inline(always)]
    fn nearest<V: Simd>(x: V) -> V::Int {
        // (x + 1) / 2 M = 2^(BITS-1) + n + rest - (x + 1) / 2, with n + rest = 2^(BITS-1) x: all
        // exact.
        let x = clamp(x);
        let (n, rest) = scale(x, BITS - 1);
        one_less_where_below::<V>(n, rest + rest, x) + V::Int::splat(1 << (BITS - 1))
    }
    #[inline(always)]
    fn value<V: Simd>(code: V::Int) -> V {
        let max = unorm_max(BITS);
        let code = code.low(BITS);
        V::from_int(code + code - V::Int::splat(max)) / V::splat(max as f32)
    }
}

impl<const BITS: u32> Grid for Fixed<BITS> {
    const BITS: u32 = <Self as Scalar>::BITS;

    #[inline(always)]
    fn nearest<V: Simd>(x: V) -> V::Int {
        let (n, _) = scale(clamp(x), BITS - 1);
        n.min(V::Int::splat(snorm_max(BITS)))
    }
    #[inline(always)]
    fn value<V: Simd>(code: V::Int) -> V {
        V::from_int(code.sign_extend(BITS)) / V::splat((1 << (BITS - 1)) as f32)
    }
}

/// From -1 to 1; NaN becomes 0.
#[inline(always)]
fn clamp<V: Simd>(x: V) -> V {
    // `greater` alone would not do: see there.
    let x = V::select(x.le(x), x, V::zero());
    x.greater(V::splat(-1.0)).lesser(V::splat(1.0))
}

/// 2^`bits` x as the nearest integer, ties to even, and what is left, -1/2 to 1/2. Both exact for
/// |x| <= 1 and at most 24 bits.
#[inline(always)]
fn scale<V: Simd>(x: V, bits: u32) -> (V::Int, V) {
    let scaled = x * V::splat((1 << bits) as f32);
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
    one_less_where_below::<V>(n, rest + V::splat(0.5), x)
}

/// n - 1 where a < b; where they are equal, the even one of n and n - 1; otherwise n.
#[inline(always)]
fn one_less_where_below<V: Simd>(n: V::Int, a: V, b: V) -> V::Int {
    let odd = n.low(1).eq(V::Int::splat(1));
    let less = a.lt(b) | (a.le(b) & odd);
    V::Int::select(less, n - V::Int::splat(1), n)
}
