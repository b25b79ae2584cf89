//! One lane, for single vectors and for processors without SIMD.

use core::ops::{Add, BitAnd, BitOr, BitXor, Mul, Neg, Sub};

use super::{Simd, SimdInt, SimdMask, look_up, look_up3, look_up4};

/// One wrapping 32-bit integer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub(crate) struct I32x1(pub(crate) i32);

impl From<i32> for I32x1 {
    #[inline(always)]
    fn from(i: i32) -> Self {
        I32x1(i)
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident = $wrapping:ident;)*) => { $(
        impl $trait for I32x1 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                I32x1(self.0.$wrapping(other.0))
            }
        }
        impl $trait<i32> for I32x1 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: i32) -> Self {
                I32x1(self.0.$wrapping(other))
            }
        }
    )* };
}

operators! {
    Add add = wrapping_add;
    Sub sub = wrapping_sub;
    Mul mul = wrapping_mul;
    BitAnd bitand = bitand;
    BitOr bitor = bitor;
    BitXor bitxor = bitxor;
}

impl Neg for I32x1 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        I32x1(self.0.wrapping_neg())
    }
}

impl Simd for f32 {
    type Int = I32x1;
    type Mask = bool;
    type Block<T: Copy + 'static> = [T; 1];
    const LANES: usize = 1;

    #[inline(always)]
    fn split<T: Copy + 'static>(slice: &[T]) -> (&[[T; 1]], &[T]) {
        slice.as_chunks()
    }
    #[inline(always)]
    fn split_mut<T: Copy + 'static>(slice: &mut [T]) -> (&mut [[T; 1]], &mut [T]) {
        slice.as_chunks_mut()
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
    fn load_int<T: Copy + 'static>(block: &[T; 1], f: impl Fn(T) -> u32) -> I32x1 {
        I32x1(f(block[0]) as i32)
    }
    #[inline(always)]
    fn store_int<T: Copy + 'static>(int: I32x1, block: &mut [T; 1], f: impl Fn(&mut T, u32)) {
        f(&mut block[0], int.0 as u32);
    }
    #[inline(always)]
    fn from_bits(bits: I32x1) -> Self {
        f32::from_bits(bits.0 as u32)
    }
    #[inline(always)]
    fn to_bits(self) -> I32x1 {
        I32x1(f32::to_bits(self) as i32)
    }
    #[inline(always)]
    fn from_int(i: I32x1) -> Self {
        i.0 as f32
    }
    #[inline(always)]
    fn lt(self, other: impl Into<Self>) -> bool {
        self < other.into()
    }
    #[inline(always)]
    fn le(self, other: impl Into<Self>) -> bool {
        self <= other.into()
    }
    #[inline(always)]
    fn select(mask: bool, yes: impl Into<Self>, no: impl Into<Self>) -> Self {
        if mask { yes.into() } else { no.into() }
    }
    #[inline(always)]
    fn gather<T: Copy + Into<u32>>(table: &[T], index: I32x1) -> I32x1 {
        I32x1(look_up(table, index.0))
    }
    #[inline(always)]
    fn gather3(table: &[[f32; 3]], index: I32x1) -> [Self; 3] {
        look_up3(table, index.0)
    }
    #[inline(always)]
    fn gather4(table: &[u32], index: I32x1) -> [I32x1; 4] {
        look_up4(table, index.0).map(I32x1)
    }
}

impl SimdInt for I32x1 {
    type Mask = bool;

    #[inline(always)]
    fn shl(self, bits: u32) -> Self {
        I32x1(self.0.wrapping_shl(bits))
    }
    #[inline(always)]
    fn shr_logical(self, bits: u32) -> Self {
        I32x1((self.0 as u32).wrapping_shr(bits) as i32)
    }
    #[inline(always)]
    fn shr_arithmetic(self, bits: u32) -> Self {
        I32x1(self.0.wrapping_shr(bits))
    }
    #[inline(always)]
    fn lt(self, other: impl Into<Self>) -> bool {
        self.0 < other.into().0
    }
    #[inline(always)]
    fn eq(self, other: impl Into<Self>) -> bool {
        self.0 == other.into().0
    }
    #[inline(always)]
    fn select(mask: bool, yes: impl Into<Self>, no: impl Into<Self>) -> Self {
        if mask { yes.into() } else { no.into() }
    }
}

impl SimdMask for bool {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        value
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
}
