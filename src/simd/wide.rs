//! Eight lanes on `wide`, which chooses its instructions at compile time.
//!
//! Only operations that `wide` computes exactly on every target are used: `clippy.toml` lists those
//! that are banned.

use core::ops::{Neg, Not};

use bytemuck::cast;
use wide::{f32x8, i32x8, u32x8};

use super::operators::{operators, scalar_operators};
use super::{Simd, SimdInt, SimdMask, look_up, look_up3, look_up4, map3, map4};

/// Eight `f32`.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(crate) struct F32x8(f32x8);

/// Eight wrapping 32-bit integers.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(crate) struct I32x8(i32x8);

/// Eight truth values, all bits set or none.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(crate) struct Mask32x8(i32x8);

operators!(F32x8: Add add, Sub sub, Mul mul, Div div);
operators!(I32x8: Add add, Sub sub, Mul mul, BitAnd bitand, BitOr bitor, BitXor bitxor);
operators!(Mask32x8: BitAnd bitand, BitOr bitor);
scalar_operators!(F32x8, f32: Add add, Sub sub, Mul mul, Div div);
scalar_operators!(I32x8, i32: Add add, Sub sub, Mul mul, BitAnd bitand, BitOr bitor, BitXor bitxor);

impl From<f32> for F32x8 {
    #[inline(always)]
    fn from(x: f32) -> Self {
        F32x8(f32x8::splat(x))
    }
}

impl From<i32> for I32x8 {
    #[inline(always)]
    fn from(i: i32) -> Self {
        I32x8(i32x8::splat(i))
    }
}

impl Neg for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        F32x8(cast::<i32x8, f32x8>(cast::<f32x8, i32x8>(self.0) ^ i32x8::splat(i32::MIN)))
    }
}

impl Neg for I32x8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        I32x8(i32x8::splat(0) - self.0)
    }
}

impl Not for Mask32x8 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Mask32x8(!self.0)
    }
}

impl Simd for F32x8 {
    type Int = I32x8;
    type Mask = Mask32x8;
    type Block<T: Copy + 'static> = [T; 8];
    const LANES: usize = 8;

    #[inline(always)]
    fn split<T: Copy + 'static>(slice: &[T]) -> (&[[T; 8]], &[T]) {
        slice.as_chunks()
    }
    #[inline(always)]
    fn split_mut<T: Copy + 'static>(slice: &mut [T]) -> (&mut [[T; 8]], &mut [T]) {
        slice.as_chunks_mut()
    }
    #[inline(always)]
    fn load(block: &[f32; 8]) -> Self {
        F32x8(f32x8::new(*block))
    }
    #[inline(always)]
    fn store(self, block: &mut [f32; 8]) {
        *block = self.0.to_array();
    }
    #[inline(always)]
    fn load_int<T: Copy + 'static>(block: &[T; 8], f: impl Fn(T) -> u32) -> I32x8 {
        I32x8(i32x8::new(block.map(|t| f(t) as i32)))
    }
    #[inline(always)]
    fn store_int<T: Copy + 'static>(int: I32x8, block: &mut [T; 8], f: impl Fn(&mut T, u32)) {
        for (t, i) in block.iter_mut().zip(int.0.to_array()) {
            f(t, i as u32);
        }
    }
    #[inline(always)]
    fn from_bits(bits: I32x8) -> Self {
        F32x8(cast(bits.0))
    }
    #[inline(always)]
    fn to_bits(self) -> I32x8 {
        I32x8(cast(self.0))
    }
    #[inline(always)]
    fn from_int(i: I32x8) -> Self {
        F32x8(i.0.round_float())
    }
    #[inline(always)]
    fn lt(self, other: impl Into<Self>) -> Mask32x8 {
        Mask32x8(cast(self.0.simd_lt(other.into().0)))
    }
    #[inline(always)]
    fn le(self, other: impl Into<Self>) -> Mask32x8 {
        Mask32x8(cast(self.0.simd_le(other.into().0)))
    }
    #[inline(always)]
    fn select(mask: Mask32x8, yes: impl Into<Self>, no: impl Into<Self>) -> Self {
        F32x8(cast::<i32x8, f32x8>(mask.0).select(yes.into().0, no.into().0))
    }
    #[inline(always)]
    fn gather<T: Copy + Into<u32>>(table: &[T], index: I32x8) -> I32x8 {
        I32x8(i32x8::new(index.0.to_array().map(|i| look_up(table, i))))
    }
    #[inline(always)]
    fn gather3(table: &[[f32; 3]], index: I32x8) -> [Self; 3] {
        let vectors = index.0.to_array().map(|i| look_up3(table, i));
        map3!([0, 1, 2], |c: usize| F32x8(f32x8::new(vectors.map(|v| v[c]))))
    }
    #[inline(always)]
    fn gather4(table: &[u32], index: I32x8) -> [I32x8; 4] {
        let fours = index.0.to_array().map(|i| look_up4(table, i));
        map4!([0, 1, 2, 3], |i: usize| I32x8(i32x8::new(fours.map(|four| four[i]))))
    }
}

impl SimdInt for I32x8 {
    type Mask = Mask32x8;

    #[inline(always)]
    fn shl(self, bits: u32) -> Self {
        I32x8(self.0 << bits)
    }
    #[inline(always)]
    fn shr_logical(self, bits: u32) -> Self {
        I32x8(cast(cast::<i32x8, u32x8>(self.0) >> bits))
    }
    #[inline(always)]
    fn shr_arithmetic(self, bits: u32) -> Self {
        I32x8(self.0 >> bits)
    }
    #[inline(always)]
    fn lt(self, other: impl Into<Self>) -> Mask32x8 {
        Mask32x8(self.0.simd_lt(other.into().0))
    }
    #[inline(always)]
    fn eq(self, other: impl Into<Self>) -> Mask32x8 {
        Mask32x8(self.0.simd_eq(other.into().0))
    }
    #[inline(always)]
    fn select(mask: Mask32x8, yes: impl Into<Self>, no: impl Into<Self>) -> Self {
        I32x8(mask.0.select(yes.into().0, no.into().0))
    }
}

impl SimdMask for Mask32x8 {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Mask32x8(i32x8::splat(-i32::from(value)))
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0.any()
    }
}
