//! The only arithmetic that a formula may use.
//!
//! Every required method is exact in IEEE arithmetic (or on integers), so one lane and many give the
//! same bits on every target. What is approximate is written once, on top, here and in [`math`].

pub(crate) mod dispatch;
pub(crate) mod math;
mod operators;
mod scalar;
pub(crate) mod stream;
mod vec3;
mod wide;
#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
mod x86;

use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

pub(crate) use scalar::I32x1;
pub(crate) use vec3::{Vec3, map_vec, map2, map3, map4};

/// 1.5 * 2^23: adding it rounds to an integer, ties to even, in the low mantissa bits.
const ROUNDER: f32 = 12_582_912.0;

/// Largest number of lanes.
pub(crate) const MAX_LANES: usize = 16;

/// How much a loop is used, which says for which lanes it is compiled.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Use {
    /// All lanes.
    Often,
    /// No form for processors that were found to have no AVX2: one lane serves those few.
    Sometimes,
    /// No form for AVX-512 either.
    Rare,
    /// Moves elements. `wide` cannot do that better than one lane.
    Moves,
}

/// A loop over many elements.
pub(crate) trait BatchLoop: Sized {
    const USE: Use;

    fn run<V: Simd>(self);
}

/// A SIMD vector of `f32`.
///
/// A number on the right of an operator, or as an argument, means a vector of that number.
pub(crate) trait Simd:
    Copy
    + 'static
    + From<f32>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f32, Output = Self>
    + Sub<f32, Output = Self>
    + Mul<f32, Output = Self>
    + Div<f32, Output = Self>
{
    /// Wrapping 32-bit integers, one per lane.
    type Int: SimdInt<Mask = Self::Mask>;
    /// A truth value per lane.
    type Mask: SimdMask;
    /// As many elements of a slice as there are lanes.
    type Block<T: Copy + 'static>: Copy + 'static;
    /// Number of lanes.
    const LANES: usize;

    /// The whole blocks of a slice, and the rest.
    fn split<T: Copy + 'static>(slice: &[T]) -> (&[Self::Block<T>], &[T]);
    /// The whole blocks of a slice, and the rest.
    fn split_mut<T: Copy + 'static>(slice: &mut [T]) -> (&mut [Self::Block<T>], &mut [T]);

    /// Runs `f` with the target features that these lanes need. A function over lanes that is not
    /// inlined consists of one call of this.
    #[inline(always)]
    fn with_target_features<R>(f: impl FnOnce() -> R) -> R {
        f()
    }

    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self::from(x)
    }
    fn load(block: &Self::Block<f32>) -> Self;
    fn store(self, block: &mut Self::Block<f32>);
    /// Stores, past the caches if the block is aligned. Made visible by a
    /// [`Fence`](stream::Fence).
    #[inline(always)]
    fn stream(self, block: &mut Self::Block<f32>) {
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
    /// The first `C` components of a block of rows of `N` floats in native byte order, at most
    /// four.
    #[inline(always)]
    fn load_rows<const N: usize, const C: usize>(block: &Self::Block<[[u8; 4]; N]>) -> [Self; C] {
        let mut columns = [Self::from(0.0); C];
        for (i, column) in columns.iter_mut().enumerate() {
            *column = Self::from_bits(Self::load_int(block, |row| u32::from_ne_bytes(row[i])));
        }
        columns
    }
    /// The first `C` floats, in native byte order, of each lane's 16 bytes. `None` if those are.
    #[inline(always)]
    fn load_quads<'a, const C: usize>(
        mut quad: impl FnMut() -> Option<&'a [u8; 16]>,
    ) -> Option<[Self; C]> {
        let mut rows = [[0; 16]; MAX_LANES];
        for row in rows.iter_mut().take(Self::LANES) {
            *row = *quad()?;
        }
        let block = Self::split(&rows).0.first()?;
        let mut columns = [Self::from(0.0); C];
        for (i, column) in columns.iter_mut().enumerate() {
            let words = |row: [u8; 16]| u32::from_ne_bytes(row.as_chunks().0[i]);
            *column = Self::from_bits(Self::load_int(block, words));
        }
        Some(columns)
    }
    /// Writes the first `C` floats of each lane's 16 bytes. `None` if those are.
    #[inline(always)]
    fn store_quads<'a, const C: usize>(
        columns: [Self; C],
        mut quad: impl FnMut() -> Option<&'a mut [u8; 16]>,
    ) -> Option<()> {
        let mut rows = [[[0; 4]; C]; MAX_LANES];
        let block = Self::split_mut(&mut rows).0.first_mut()?;
        for (i, column) in columns.into_iter().enumerate() {
            Self::store_int(column.to_bits(), block, |row, bits| row[i] = bits.to_ne_bytes());
        }
        for row in rows.iter().take(Self::LANES) {
            for (to, from) in quad()?.iter_mut().zip(row.as_flattened()) {
                *to = *from;
            }
        }
        Some(())
    }
    /// Writes the first `C` components of a block of rows as [`load_rows`](Simd::load_rows) reads them.
    #[inline(always)]
    fn store_rows<const N: usize, const C: usize>(
        columns: [Self; C],
        block: &mut Self::Block<[[u8; 4]; N]>,
    ) {
        for (i, column) in columns.into_iter().enumerate() {
            Self::store_int(column.to_bits(), block, |row, bits| row[i] = bits.to_ne_bytes());
        }
    }

    fn from_bits(bits: Self::Int) -> Self;
    fn to_bits(self) -> Self::Int;
    /// Nearest number, ties to even; exact for |i| <= 2^24.
    fn from_int(i: Self::Int) -> Self;

    fn lt(self, other: impl Into<Self>) -> Self::Mask;
    fn le(self, other: impl Into<Self>) -> Self::Mask;
    fn select(mask: Self::Mask, yes: impl Into<Self>, no: impl Into<Self>) -> Self;
    /// `table[index]`, or 0 beyond the end.
    fn gather<T: Copy + Into<u32>>(table: &[T], index: Self::Int) -> Self::Int;
    /// `table[index]`, or zeros beyond the end.
    fn gather3(table: &[[f32; 3]], index: Self::Int) -> [Self; 3];
    /// The element at `index` and the three after it, or zeros if there are fewer.
    fn gather4(table: &[u32], index: Self::Int) -> [Self::Int; 4];

    #[inline(always)]
    fn abs(self) -> Self {
        Self::from_bits(self.to_bits() & 0x7FFF_FFFF)
    }

    /// -self where `sign` is below zero. A negative zero counts as zero.
    #[inline(always)]
    fn negate_where_negative(self, sign: Self) -> Self {
        Self::select(sign.lt(0.0), -self, self)
    }

    /// The smaller of two numbers. `other` if either is a quiet NaN.
    ///
    /// With a signalling NaN the result differs between targets, since the compiler may take AArch64's
    /// FMINNM. So callers replace NaN before.
    #[inline(always)]
    fn min(self, other: impl Into<Self>) -> Self {
        let other = other.into();
        Self::select(self.lt(other), self, other)
    }

    /// The greater of two numbers. NaN as in [`min`](Simd::min).
    #[inline(always)]
    fn max(self, other: impl Into<Self>) -> Self {
        let other = other.into();
        Self::select(other.lt(self), self, other)
    }

    /// Nearest integer, ties to even. For |x| < 2^22.
    #[inline(always)]
    fn round(self) -> Self {
        (self + ROUNDER) - ROUNDER
    }

    /// Nearest integer, ties to even, as an integer. For |x| <= 2^22.
    #[inline(always)]
    fn round_int(self) -> Self::Int {
        (self + ROUNDER).to_bits() - ROUNDER.to_bits() as i32
    }

    /// [`round_int`](Simd::round_int) for |x| <= 2^24.
    #[inline(always)]
    fn round_int_wide(self) -> Self::Int {
        // From 2^23 to 2^24 the bits count whole numbers; smaller ones are moved there.
        const FIRST: f32 = 8_388_608.0;
        let magnitude = self.abs();
        let moved = magnitude.lt(FIRST);
        let bits = Self::select(moved, magnitude + FIRST, magnitude).to_bits();
        let start = FIRST.to_bits() as i32;
        let n = bits - Self::Int::select(moved, start, start - FIRST as i32);
        Self::Int::select(self.lt(0.0), -n, n)
    }

    /// Greatest integer not above. For |x| < 2^22.
    #[inline(always)]
    fn floor(self) -> Self {
        let r = self.round();
        Self::select(self.lt(r), r - 1.0, r)
    }
}

/// A SIMD vector of wrapping 32-bit integers.
pub(crate) trait SimdInt:
    Copy
    + From<i32>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
    + Neg<Output = Self>
    + Add<i32, Output = Self>
    + Sub<i32, Output = Self>
    + Mul<i32, Output = Self>
    + BitAnd<i32, Output = Self>
    + BitOr<i32, Output = Self>
    + BitXor<i32, Output = Self>
{
    type Mask: SimdMask;

    #[inline(always)]
    fn splat(i: i32) -> Self {
        Self::from(i)
    }
    fn shl(self, bits: u32) -> Self;
    /// Shifts right and fills with zeros.
    fn shr_logical(self, bits: u32) -> Self;
    /// Shifts right and fills with the sign.
    fn shr_arithmetic(self, bits: u32) -> Self;
    fn lt(self, other: impl Into<Self>) -> Self::Mask;
    fn eq(self, other: impl Into<Self>) -> Self::Mask;
    fn select(mask: Self::Mask, yes: impl Into<Self>, no: impl Into<Self>) -> Self;

    #[inline(always)]
    fn min(self, other: impl Into<Self>) -> Self {
        let other = other.into();
        Self::select(self.lt(other), self, other)
    }

    #[inline(always)]
    fn max(self, other: impl Into<Self>) -> Self {
        let other = other.into();
        Self::select(other.lt(self), self, other)
    }

    #[inline(always)]
    fn clamp(self, min: i32, max: i32) -> Self {
        self.max(min).min(max)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.max(-self)
    }

    /// Less than, both read as unsigned.
    #[inline(always)]
    fn lt_unsigned(self, other: Self) -> Self::Mask {
        (self ^ i32::MIN).lt(other ^ i32::MIN)
    }

    /// The low `bits` bits, read as two's complement.
    #[inline(always)]
    fn sign_extend(self, bits: u32) -> Self {
        self.shl(32 - bits).shr_arithmetic(32 - bits)
    }

    /// The low `bits` bits.
    #[inline(always)]
    fn low_bits(self, bits: u32) -> Self {
        self & ((1u64 << bits) - 1) as i32
    }

    /// -self where `sign` is below zero.
    #[inline(always)]
    fn negate_where_negative(self, sign: Self) -> Self {
        Self::select(sign.lt(0), -self, self)
    }
}

/// A truth value per lane.
pub(crate) trait SimdMask:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    fn splat(value: bool) -> Self;
    /// Whether it holds in any lane.
    fn any(self) -> bool;
}

/// One lane of [`Simd::gather`].
#[inline(always)]
pub(crate) fn look_up<T: Copy + Into<u32>>(table: &[T], index: i32) -> i32 {
    table.get(index as u32 as usize).map_or(0, |&t| t.into() as i32)
}

/// One lane of [`Simd::gather4`].
#[inline(always)]
fn look_up4(table: &[u32], index: i32) -> [i32; 4] {
    let index = index as u32 as usize;
    match table.get(index..index.wrapping_add(4)) {
        Some(&[a, b, c, d]) => [a as i32, b as i32, c as i32, d as i32],
        _ => [0; 4],
    }
}

/// One lane of [`Simd::gather3`].
#[inline(always)]
pub(crate) fn look_up3(table: &[[f32; 3]], index: i32) -> [f32; 3] {
    table.get(index as u32 as usize).copied().unwrap_or_default()
}
