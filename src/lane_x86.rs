//! The eight- and sixteen-lane forms of [`Lane`] on AVX2 and AVX-512, through `fearless_simd`.

use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f32x16, i32x8, i32x16, mask32x8, mask32x16, u32x8, u32x16};

use crate::lane::{Lane, LaneInt, LaneMask, look_up, look_up_pair, look_up3};
use crate::x86::Tier;

macro_rules! operators {
    ($($type:ident: $($trait:ident $method:ident),*;)*) => { $($(
        impl<T: Tier> $trait for $type<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self($trait::$method(self.0, other.0))
            }
        }
    )*)* };
}

macro_rules! lanes {
    (
        $n:literal,
        $float:ident: $f32s:ident,
        $int:ident: $i32s:ident | $u32s:ident,
        $mask:ident: $mask32s:ident
    ) => {
        #[derive(Clone, Copy)]
        pub(crate) struct $float<T: Tier>($f32s<T::Simd>);
        #[derive(Clone, Copy)]
        pub(crate) struct $int<T: Tier>($i32s<T::Simd>);
        #[derive(Clone, Copy)]
        pub(crate) struct $mask<T: Tier>($mask32s<T::Simd>);

        operators! {
            $float: Add add, Sub sub, Mul mul, Div div;
            $int: Add add, Sub sub, Mul mul, BitAnd bitand, BitOr bitor, BitXor bitxor;
            $mask: BitAnd bitand, BitOr bitor;
        }

        impl<T: Tier> Neg for $float<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl<T: Tier> Neg for $int<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl<T: Tier> Not for $mask<T> {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self(!self.0)
            }
        }

        impl<T: Tier> Lane for $float<T> {
            type Int = $int<T>;
            type Mask = $mask<T>;
            type Block<B: Copy + 'static> = [B; $n];

            #[inline(always)]
            fn split<B: Copy + 'static>(slice: &[B]) -> (&[[B; $n]], &[B]) {
                slice.as_chunks()
            }
            #[inline(always)]
            fn split_mut<B: Copy + 'static>(slice: &mut [B]) -> (&mut [[B; $n]], &mut [B]) {
                slice.as_chunks_mut()
            }
            #[inline(always)]
            fn compiled_for<R>(f: impl FnOnce() -> R) -> R {
                T::token().vectorize(f)
            }
            #[inline(always)]
            fn splat(x: f32) -> Self {
                $float($f32s::splat(T::token(), x))
            }
            #[inline(always)]
            fn load(block: &[f32; $n]) -> Self {
                $float($f32s::simd_from(T::token(), *block))
            }
            #[inline(always)]
            fn store(self, block: &mut [f32; $n]) {
                *block = *self.0;
            }
            #[inline(always)]
            fn load_int<B: Copy + 'static>(block: &[B; $n], f: impl Fn(B) -> u32) -> $int<T> {
                let mut ints = [0; $n];
                for (i, &b) in ints.iter_mut().zip(block) {
                    *i = f(b) as i32;
                }
                $int($i32s::simd_from(T::token(), ints))
            }
            #[inline(always)]
            fn store_int<B: Copy + 'static>(
                int: $int<T>,
                block: &mut [B; $n],
                f: impl Fn(&mut B, u32),
            ) {
                for (b, i) in block.iter_mut().zip(*int.0) {
                    f(b, i as u32);
                }
            }
            #[inline(always)]
            fn from_bits(bits: $int<T>) -> Self {
                $float(bits.0.bitcast())
            }
            #[inline(always)]
            fn to_bits(self) -> $int<T> {
                $int(self.0.bitcast())
            }
            #[inline(always)]
            fn from_int(i: $int<T>) -> Self {
                $float($f32s::float_from(i.0))
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask<T> {
                $mask(self.0.simd_lt(other.0))
            }
            #[inline(always)]
            fn le(self, other: Self) -> $mask<T> {
                $mask(self.0.simd_le(other.0))
            }
            #[inline(always)]
            fn select(mask: $mask<T>, yes: Self, no: Self) -> Self {
                $float(mask.0.select(yes.0, no.0))
            }
            #[inline(always)]
            fn gather<B: Copy + Into<u32>>(table: &[B], index: $int<T>) -> $int<T> {
                let mut ints = *index.0;
                for i in &mut ints {
                    *i = look_up(table, *i);
                }
                $int($i32s::simd_from(T::token(), ints))
            }
            #[inline(always)]
            fn gather_pair(table: &[u32], index: $int<T>) -> [$int<T>; 2] {
                let [mut a, mut b] = [[0; $n]; 2];
                for ((a, b), i) in a.iter_mut().zip(&mut b).zip(*index.0) {
                    [*a, *b] = look_up_pair(table, i);
                }
                [$int($i32s::simd_from(T::token(), a)), $int($i32s::simd_from(T::token(), b))]
            }
            #[inline(always)]
            fn gather3(table: &[[f32; 3]], index: $int<T>) -> [Self; 3] {
                let [mut x, mut y, mut z] = [[0.0; $n]; 3];
                let places = x.iter_mut().zip(&mut y).zip(&mut z);
                for (((x, y), z), i) in places.zip(*index.0) {
                    [*x, *y, *z] = look_up3(table, i);
                }
                [Self::load(&x), Self::load(&y), Self::load(&z)]
            }
        }

        impl<T: Tier> LaneInt for $int<T> {
            type Mask = $mask<T>;

            #[inline(always)]
            fn splat(i: i32) -> Self {
                $int($i32s::splat(T::token(), i))
            }
            #[inline(always)]
            fn shl(self, bits: u32) -> Self {
                $int(self.0 << bits)
            }
            #[inline(always)]
            fn shr(self, bits: u32) -> Self {
                let unsigned: $u32s<T::Simd> = self.0.bitcast();
                $int((unsigned >> bits).bitcast())
            }
            #[inline(always)]
            fn sar(self, bits: u32) -> Self {
                $int(self.0 >> bits)
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask<T> {
                $mask(self.0.simd_lt(other.0))
            }
            #[inline(always)]
            fn eq(self, other: Self) -> $mask<T> {
                $mask(self.0.simd_eq(other.0))
            }
            #[inline(always)]
            fn select(mask: $mask<T>, yes: Self, no: Self) -> Self {
                $int(mask.0.select(yes.0, no.0))
            }
        }

        impl<T: Tier> LaneMask for $mask<T> {
            #[inline(always)]
            fn any(self) -> bool {
                self.0.any_true()
            }
        }
    };
}

lanes!(8, F8: f32x8, I8: i32x8 | u32x8, M8: mask32x8);
lanes!(16, F16: f32x16, I16: i32x16 | u32x16, M16: mask32x16);
