//! The only arithmetic a formula may use, and its one-lane form.
//!
//! Every required method is exact in IEEE arithmetic (or on integers), so one lane and many
//! give the same bits on every target. What is approximate is written once, on top, here and in
//! [`math`](crate::simd::math).

pub(crate) mod dispatch;
pub(crate) mod math;
pub(crate) mod stream;
pub(crate) mod wide;
#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
pub(crate) mod x86;

use core::num::Wrapping;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use crate::simd::stream::Fence;

/// 1.5 * 2^23: adding it rounds to an integer, ties to even, which then stands in the low mantissa bits.
const ROUNDER: f32 = 12_582_912.0;

/// Of vectors that lanes rearrange.
pub(crate) const MOST_COMPONENTS: usize = 8;

/// A vector of `f32`, of as many lanes as the implementation has.
pub(crate) trait Simd:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Wrapping 32-bit integers, one per lane.
    type Int: SimdInt<Mask = Self::Mask>;
    /// A truth value per lane.
    type Mask: SimdMask;
    /// As many elements of a slice as there are lanes.
    type Block<T: Copy + 'static>: Copy + 'static;
    /// Whether [`stream`](Simd::stream) does more than [`store`](Simd::store).
    const STREAMS: bool = false;

    /// The whole blocks of a slice, and the rest.
    fn split<T: Copy + 'static>(slice: &[T]) -> (&[Self::Block<T>], &[T]);
    /// The whole blocks of a slice, and the rest.
    fn split_mut<T: Copy + 'static>(slice: &mut [T]) -> (&mut [Self::Block<T>], &mut [T]);
    /// Compiles `f` for the processor that these lanes need. What is not inlined into a loop over lanes
    /// consists of a call of this, whose closure is.
    #[inline(always)]
    fn compiled_for<R>(f: impl FnOnce() -> R) -> R {
        f()
    }

    fn splat(x: f32) -> Self;
    fn load(block: &Self::Block<f32>) -> Self;
    fn store(self, block: &mut Self::Block<f32>);
    /// Stores, past the caches if the block is aligned for that.
    #[inline(always)]
    fn stream<'a>(self, block: &'a mut Self::Block<f32>, _: &Fence<'a>) {
        self.store(block);
    }
    /// Integers computed from the elements of a block.
    fn load_int<T: Copy + 'static>(block: &Self::Block<T>, f: impl Fn(T) -> u32) -> Self::Int;
    /// Writes integers, converted, to the elements of a block.
    fn store_int<T: Copy + 'static>(
        int: Self::Int,
        block: &mut Self::Block<T>,
        f: impl Fn(&mut T, u32),
    );

    /// Integers of three bytes, little-endian.
    #[inline(always)]
    fn load_bytes(block: &Self::Block<[u8; 3]>) -> Self::Int {
        Self::load_int(block, |[a, b, c]| u32::from_le_bytes([a, b, c, 0]))
    }
    /// Writes the low three bytes of integers, little-endian.
    #[inline(always)]
    fn store_bytes(int: Self::Int, block: &mut Self::Block<[u8; 3]>) {
        Self::store_int(int, block, |[a, b, c], i| [*a, *b, *c, _] = i.to_le_bytes());
    }
    /// The first three components of a block of vectors of at most [`MOST_COMPONENTS`].
    #[inline(always)]
    fn load_vectors<const N: usize>(block: &Self::Block<[f32; N]>) -> [Self; 3] {
        [0, 1, 2].each(
            #[inline(always)]
            |i: usize| Self::from_bits(Self::load_int(block, |v| v[i].to_bits())),
        )
    }
    /// Writes the first three components of a block of vectors of at most [`MOST_COMPONENTS`].
    #[inline(always)]
    fn store_vectors<const N: usize>(v: [Self; 3], block: &mut Self::Block<[f32; N]>) {
        for (i, c) in v.into_iter().enumerate() {
            Self::store_int(c.to_bits(), block, |v, bits| v[i] = f32::from_bits(bits));
        }
    }

    fn from_bits(bits: Self::Int) -> Self;
    fn to_bits(self) -> Self::Int;
    /// Nearest number, ties to even; exact for |i| <= 2^24.
    fn from_int(i: Self::Int) -> Self;

    fn lt(self, other: Self) -> Self::Mask;
    fn le(self, other: Self) -> Self::Mask;
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Looks each lane up. Beyond the end, 0.
    fn gather<T: Copy + Into<u32>>(table: &[T], index: Self::Int) -> Self::Int;
    /// Looks each lane's vector up. Beyond the end, zeros.
    fn gather3(table: &[[f32; 3]], index: Self::Int) -> [Self; 3];
    /// Of each index the element and the three after it, or zeros where there are none.
    fn gather4(table: &[u32], index: Self::Int) -> [Self::Int; 4];

    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::from_bits(self.to_bits() & Self::Int::splat(0x7FFF_FFFF))
    }

    /// Minus self where `sign` is below zero. A negative zero counts as zero.
    #[inline(always)]
    fn negate_where_negative(self, sign: Self) -> Self {
        Self::select(sign.lt(Self::zero()), -self, self)
    }

    /// The lesser; `other` where either is NaN, but not for signalling ones: the compiler may take
    /// AArch64's FMINNM, which makes them quiet and returns them. So a caller's numbers are rid of NaN before.
    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        Self::select(self.lt(other), self, other)
    }

    /// The greater; `other` where either is NaN, with the same exception.
    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        Self::select(other.lt(self), self, other)
    }

    /// Nearest integer, ties to even. For |x| < 2^22.
    #[inline(always)]
    fn round(self) -> Self {
        (self + Self::splat(ROUNDER)) - Self::splat(ROUNDER)
    }

    /// Nearest integer, ties to even, as an integer. For |x| <= 2^22.
    #[inline(always)]
    fn round_int(self) -> Self::Int {
        (self + Self::splat(ROUNDER)).to_bits() - Self::Int::splat(ROUNDER.to_bits() as i32)
    }

    /// [`round_int`](Simd::round_int) for |x| <= 2^24.
    #[inline(always)]
    fn round_int_wide(self) -> Self::Int {
        // From 2^23 to 2^24 the bits count whole numbers; smaller ones are moved there.
        const FIRST: f32 = 8_388_608.0;
        let magnitude = self.abs();
        let moved = magnitude.lt(Self::splat(FIRST));
        let bits = Self::select(moved, magnitude + Self::splat(FIRST), magnitude).to_bits();
        let start = FIRST.to_bits() as i32;
        let start = Self::Int::select(
            moved,
            Self::Int::splat(start),
            Self::Int::splat(start - FIRST as i32),
        );
        let n = bits - start;
        Self::Int::select(self.lt(Self::zero()), -n, n)
    }

    /// Greatest integer not above. For |x| < 2^22.
    #[inline(always)]
    fn floor(self) -> Self {
        let r = self.round();
        Self::select(self.lt(r), r - Self::splat(1.0), r)
    }
}

/// A vector of wrapping 32-bit integers.
pub(crate) trait SimdInt:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
    + Neg<Output = Self>
{
    type Mask: SimdMask;

    fn splat(i: i32) -> Self;
    fn shl(self, bits: u32) -> Self;
    /// Shifts in zeros.
    fn shr(self, bits: u32) -> Self;
    /// Shifts in the sign.
    fn sar(self, bits: u32) -> Self;
    fn lt(self, other: Self) -> Self::Mask;
    fn eq(self, other: Self) -> Self::Mask;
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.lt(other), self, other)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.lt(self), self, other)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.max(-self)
    }

    /// Less than, both read as unsigned.
    #[inline(always)]
    fn below(self, other: Self) -> Self::Mask {
        let flip = Self::splat(i32::MIN);
        (self ^ flip).lt(other ^ flip)
    }

    /// The low `bits` bits, read as two's complement.
    #[inline(always)]
    fn sign_extend(self, bits: u32) -> Self {
        self.shl(32 - bits).sar(32 - bits)
    }

    /// The low `bits` bits.
    #[inline(always)]
    fn low(self, bits: u32) -> Self {
        self & Self::splat(((1u64 << bits) - 1) as i32)
    }
}

/// A truth value per lane.
pub(crate) trait SimdMask:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// Whether it holds in any lane.
    fn any(self) -> bool;
}

/// `map` for the components of a vector, without the detours that keep `array::map` from being
/// inlined.
pub(crate) trait Each<T> {
    type Of<U>;
    fn each<U>(self, f: impl Fn(T) -> U) -> Self::Of<U>;
}

/// A closure with an attribute, which a `let` cannot take. Whatever works on lanes must be inlined, so that
/// it is compiled for the processor of the loop that it ends up in.
#[inline(always)]
pub(crate) fn inlined<F>(f: F) -> F {
    f
}

impl<T> Each<T> for [T; 2] {
    type Of<U> = [U; 2];
    #[inline(always)]
    fn each<U>(self, f: impl Fn(T) -> U) -> [U; 2] {
        let [a, b] = self;
        [f(a), f(b)]
    }
}

impl<T> Each<T> for [T; 3] {
    type Of<U> = [U; 3];
    #[inline(always)]
    fn each<U>(self, f: impl Fn(T) -> U) -> [U; 3] {
        let [a, b, c] = self;
        [f(a), f(b), f(c)]
    }
}

impl<T> Each<T> for [T; 4] {
    type Of<U> = [U; 4];
    #[inline(always)]
    fn each<U>(self, f: impl Fn(T) -> U) -> [U; 4] {
        let [a, b, c, d] = self;
        [f(a), f(b), f(c), f(d)]
    }
}

impl Simd for f32 {
    type Int = Wrapping<i32>;
    type Mask = bool;
    type Block<T: Copy + 'static> = [T; 1];

    #[inline(always)]
    fn split<T: Copy + 'static>(slice: &[T]) -> (&[[T; 1]], &[T]) {
        slice.as_chunks()
    }
    #[inline(always)]
    fn split_mut<T: Copy + 'static>(slice: &mut [T]) -> (&mut [[T; 1]], &mut [T]) {
        slice.as_chunks_mut()
    }
    #[inline(always)]
    fn splat(x: f32) -> Self {
        x
    }
    #[inline(always)]
    fn load(block: &[f32; 1]) -> Self {
        block[0]
    }
    #[inline(always)]
    fn store(self, block: &mut [f32; 1]) {
        *block = [self];
    }
    #[inline(always)]
    fn load_int<T: Copy + 'static>(block: &[T; 1], f: impl Fn(T) -> u32) -> Self::Int {
        Wrapping(f(block[0]) as i32)
    }
    #[inline(always)]
    fn store_int<T: Copy + 'static>(int: Self::Int, block: &mut [T; 1], f: impl Fn(&mut T, u32)) {
        f(&mut block[0], int.0 as u32);
    }
    #[inline(always)]
    fn from_bits(bits: Self::Int) -> Self {
        f32::from_bits(bits.0 as u32)
    }
    #[inline(always)]
    fn to_bits(self) -> Self::Int {
        Wrapping(f32::to_bits(self) as i32)
    }
    #[inline(always)]
    fn from_int(i: Self::Int) -> Self {
        i.0 as f32
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn gather<T: Copy + Into<u32>>(table: &[T], index: Self::Int) -> Self::Int {
        Wrapping(look_up(table, index.0))
    }
    #[inline(always)]
    fn gather4(table: &[u32], index: Self::Int) -> [Self::Int; 4] {
        look_up4(table, index.0).map(Wrapping)
    }
    #[inline(always)]
    fn gather3(table: &[[f32; 3]], index: Self::Int) -> [Self; 3] {
        look_up3(table, index.0)
    }
}

impl SimdInt for Wrapping<i32> {
    type Mask = bool;

    #[inline(always)]
    fn splat(i: i32) -> Self {
        Wrapping(i)
    }
    #[inline(always)]
    fn shl(self, bits: u32) -> Self {
        Wrapping(self.0.wrapping_shl(bits))
    }
    #[inline(always)]
    fn shr(self, bits: u32) -> Self {
        Wrapping((self.0 as u32).wrapping_shr(bits) as i32)
    }
    #[inline(always)]
    fn sar(self, bits: u32) -> Self {
        Wrapping(self.0.wrapping_shr(bits))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }
    #[inline(always)]
    fn eq(self, other: Self) -> bool {
        self.0 == other.0
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

impl SimdMask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
}

/// One lane of a gather.
#[inline(always)]
pub(crate) fn look_up<T: Copy + Into<u32>>(table: &[T], index: i32) -> i32 {
    table.get(index as u32 as usize).map_or(0, |&t| t.into() as i32)
}

/// One lane of a gather of four in a row.
#[inline(always)]
pub(crate) fn look_up4(table: &[u32], index: i32) -> [i32; 4] {
    let index = index as u32 as usize;
    match table.get(index..index.wrapping_add(4)) {
        Some(&[a, b, c, d]) => [a as i32, b as i32, c as i32, d as i32],
        _ => [0; 4],
    }
}

/// One lane of a gather of vectors.
#[inline(always)]
pub(crate) fn look_up3(table: &[[f32; 3]], index: i32) -> [f32; 3] {
    table.get(index as u32 as usize).copied().unwrap_or_default()
}
