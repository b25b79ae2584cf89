//! Eight and sixteen lanes on AVX2 and AVX-512, through `fearless_simd`.

use core::ops::{Neg, Not};

use fearless_simd::prelude::*;
use fearless_simd::{
    Simd as _, SimdMask as _, f32x8, f32x16, i32x8, i32x16, mask32x8, mask32x16, u8x16, u8x32,
    u8x64, u32x8, u32x16,
};

use super::CpuLevel;
use super::shuffle::{Shuffle, dense, first, spread};
use crate::simd::operators::{operators, scalar_operators};
use crate::simd::stream::x86::Streaming;
use crate::simd::{Simd, SimdInt, SimdMask, look_up, look_up3, look_up4};

/// Joins vectors of 16 bytes to one of `u8`s.
macro_rules! join {
    (8, $token:expr, $quad:expr) => {
        u8x16::simd_from($token, *$quad()?).combine(u8x16::simd_from($token, *$quad()?))
    };
    (16, $token:expr, $quad:expr) => {
        join!(8, $token, $quad).combine(join!(8, $token, $quad))
    };
}

/// Splits a vector of `u8`s, and writes the first bytes of each 16, by the pick.
macro_rules! split {
    (4, $bytes:expr, $pick:expr, $quad:expr) => {{
        let to = $quad()?;
        let kept = u8x16::simd_from(T::token(), *to);
        *to = *$bytes.concat_swizzle_dyn(kept, $pick);
    }};
    (8, $bytes:expr, $pick:expr, $quad:expr) => {{
        let (low, high) = $bytes.split();
        split!(4, low, $pick, $quad);
        split!(4, high, $pick, $quad);
    }};
    (16, $bytes:expr, $pick:expr, $quad:expr) => {{
        let (low, high) = $bytes.split();
        split!(8, low, $pick, $quad);
        split!(8, high, $pick, $quad);
    }};
}

macro_rules! lanes {
    (
        $n:tt,
        $float:ident: $f32s:ident,
        $int:ident: $i32s:ident | $u32s:ident | $u8s:ident,
        $mask:ident: $mask32s:ident
    ) => {
        #[derive(Clone, Copy)]
        pub(crate) struct $float<T: CpuLevel>($f32s<T::Simd>);
        #[derive(Clone, Copy)]
        pub(crate) struct $int<T: CpuLevel>($i32s<T::Simd>);
        #[derive(Clone, Copy)]
        pub(crate) struct $mask<T: CpuLevel>($mask32s<T::Simd>);

        operators!([T: CpuLevel] $float<T>: Add add, Sub sub, Mul mul, Div div);
        operators!([T: CpuLevel] $int<T>: Add add, Sub sub, Mul mul, BitAnd bitand, BitOr bitor, BitXor bitxor);
        operators!([T: CpuLevel] $mask<T>: BitAnd bitand, BitOr bitor);
        scalar_operators!([T: CpuLevel] $float<T>, f32: Add add, Sub sub, Mul mul, Div div);
        scalar_operators!(
            [T: CpuLevel] $int<T>, i32: Add add, Sub sub, Mul mul, BitAnd bitand, BitOr bitor, BitXor bitxor
        );

        impl<T: CpuLevel> From<f32> for $float<T> {
            #[inline(always)]
            fn from(x: f32) -> Self {
                $float($f32s::splat(T::token(), x))
            }
        }

        impl<T: CpuLevel> From<i32> for $int<T> {
            #[inline(always)]
            fn from(i: i32) -> Self {
                $int($i32s::splat(T::token(), i))
            }
        }

        impl<T: CpuLevel> Neg for $float<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl<T: CpuLevel> Neg for $int<T> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl<T: CpuLevel> Not for $mask<T> {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self(!self.0)
            }
        }

        impl<T: CpuLevel<Simd: Streaming<$n>>> Simd for $float<T> {
            type Int = $int<T>;
            type Mask = $mask<T>;
            type Block<B: Copy + 'static> = [B; $n];
            const LANES: usize = $n;

            #[inline(always)]
            fn split<B: Copy + 'static>(slice: &[B]) -> (&[[B; $n]], &[B]) {
                slice.as_chunks()
            }
            #[inline(always)]
            fn split_mut<B: Copy + 'static>(slice: &mut [B]) -> (&mut [[B; $n]], &mut [B]) {
                slice.as_chunks_mut()
            }
            #[inline(always)]
            fn with_target_features<R>(f: impl FnOnce() -> R) -> R {
                T::token().vectorize(f)
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
            fn stream(self, block: &mut [f32; $n]) {
                T::token().stream(*self.0, block);
            }
            #[inline(always)]
            fn load_bytes(block: &[[u8; 3]; $n]) -> $int<T> {
                // AVX2 has no permutation of all bytes.
                if $n == 8 {
                    return Self::load_int(block, |[a, b, c]| u32::from_le_bytes([a, b, c, 0]));
                }
                let mut bytes = [0; 4 * $n];
                for (to, from) in bytes.iter_mut().zip(block.as_flattened()) {
                    *to = *from;
                }
                let pick: [u8; 4 * $n] = const { spread() };
                $int($u8s::simd_from(T::token(), bytes).swizzle_dyn_precise(pick).bitcast())
            }
            #[inline(always)]
            fn store_bytes(int: $int<T>, block: &mut [[u8; 3]; $n]) {
                let bytes: $u8s<T::Simd> = int.0.bitcast();
                let pick: [u8; 4 * $n] = const { dense() };
                for (to, from) in block.as_flattened_mut().iter_mut().zip(*bytes.swizzle_dyn(pick))
                {
                    *to = from;
                }
            }
            #[inline(always)]
            fn load_rows<const N: usize, const C: usize>(block: &[[[u8; 4]; N]; $n]) -> [Self; C] {
                let mut columns = [$u8s::splat(T::token(), 0).bitcast::<$u32s<T::Simd>>(); C];
                let (rows, _) = block.as_flattened().as_flattened().as_chunks();
                for (row, picks) in rows.iter().zip(&Shuffle::<N, C, $n, { 4 * $n }>::LOAD) {
                    let row: $u32s<T::Simd> = $u8s::simd_from(T::token(), *row).bitcast();
                    for (column, pick) in columns.iter_mut().zip(picks) {
                        *column = column.concat_swizzle_dyn(row, *pick);
                    }
                }
                columns.map(
                    #[inline(always)]
                    |column| $float(column.bitcast()),
                )
            }
            #[inline(always)]
            fn load_quads<'a, const C: usize>(
                mut quad: impl FnMut() -> Option<&'a [u8; 16]>,
            ) -> Option<[Self; C]> {
                let mut columns = [$u8s::splat(T::token(), 0).bitcast::<$u32s<T::Simd>>(); C];
                for picks in &Shuffle::<4, C, $n, { 4 * $n }>::LOAD {
                    let row: $u32s<T::Simd> = join!($n, T::token(), quad).bitcast();
                    for (column, pick) in columns.iter_mut().zip(picks) {
                        *column = column.concat_swizzle_dyn(row, *pick);
                    }
                }
                Some(columns.map(
                    #[inline(always)]
                    |column| $float(column.bitcast()),
                ))
            }
            #[inline(always)]
            fn store_rows<const N: usize, const C: usize>(
                columns: [Self; C],
                block: &mut [[[u8; 4]; N]; $n],
            ) {
                let columns: [$u32s<T::Simd>; C] = columns.map(
                    #[inline(always)]
                    |column| column.0.bitcast(),
                );
                let (rows, _) = block.as_flattened_mut().as_flattened_mut().as_chunks_mut();
                for (row, picks) in rows.iter_mut().zip(&Shuffle::<N, C, $n, { 4 * $n }>::STORE) {
                    let mut all = columns[0];
                    for (column, pick) in columns[1..].iter().zip(picks) {
                        all = all.concat_swizzle_dyn(*column, *pick);
                    }
                    if N > C {
                        let kept: $u32s<T::Simd> =
                            $u8s::simd_from(T::token(), *row).bitcast();
                        all = all.concat_swizzle_dyn(kept, picks[C - 1]);
                    }
                    *row = *all.bitcast::<$u8s<T::Simd>>();
                }
            }
            #[inline(always)]
            fn store_quads<'a, const C: usize>(
                columns: [Self; C],
                mut quad: impl FnMut() -> Option<&'a mut [u8; 16]>,
            ) -> Option<()> {
                let pick = const { first::<C>() };
                let columns: [$u32s<T::Simd>; C] = columns.map(
                    #[inline(always)]
                    |column| column.0.bitcast(),
                );
                for picks in &Shuffle::<4, C, $n, { 4 * $n }>::STORE {
                    let mut all = columns[0];
                    for (column, pick) in columns[1..].iter().zip(picks) {
                        all = all.concat_swizzle_dyn(*column, *pick);
                    }
                    split!($n, all.bitcast::<$u8s<T::Simd>>(), pick, quad);
                }
                Some(())
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
            fn lt(self, other: impl Into<Self>) -> $mask<T> {
                $mask(self.0.simd_lt(other.into().0))
            }
            #[inline(always)]
            fn le(self, other: impl Into<Self>) -> $mask<T> {
                $mask(self.0.simd_le(other.into().0))
            }
            #[inline(always)]
            fn select(mask: $mask<T>, yes: impl Into<Self>, no: impl Into<Self>) -> Self {
                $float(mask.0.select(yes.into().0, no.into().0))
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
            fn gather3(table: &[[f32; 3]], index: $int<T>) -> [Self; 3] {
                let mut rows = [[[0; 4]; 3]; $n];
                for (row, i) in rows.iter_mut().zip(*index.0) {
                    *row = look_up3(table, i).map(f32::to_ne_bytes);
                }
                Self::load_rows(&rows)
            }
            #[inline(always)]
            fn gather4(table: &[u32], index: $int<T>) -> [$int<T>; 4] {
                let mut rows = [[[0; 4]; 4]; $n];
                for (row, i) in rows.iter_mut().zip(*index.0) {
                    *row = look_up4(table, i).map(i32::to_ne_bytes);
                }
                Self::load_rows(&rows).map(Self::to_bits)
            }
        }

        impl<T: CpuLevel> SimdInt for $int<T> {
            type Mask = $mask<T>;

            #[inline(always)]
            fn shl(self, bits: u32) -> Self {
                $int(self.0 << bits)
            }
            #[inline(always)]
            fn shr_logical(self, bits: u32) -> Self {
                let unsigned: $u32s<T::Simd> = self.0.bitcast();
                $int((unsigned >> bits).bitcast())
            }
            #[inline(always)]
            fn shr_arithmetic(self, bits: u32) -> Self {
                $int(self.0 >> bits)
            }
            #[inline(always)]
            fn lt(self, other: impl Into<Self>) -> $mask<T> {
                $mask(self.0.simd_lt(other.into().0))
            }
            #[inline(always)]
            fn eq(self, other: impl Into<Self>) -> $mask<T> {
                $mask(self.0.simd_eq(other.into().0))
            }
            #[inline(always)]
            fn select(mask: $mask<T>, yes: impl Into<Self>, no: impl Into<Self>) -> Self {
                $int(mask.0.select(yes.into().0, no.into().0))
            }
        }

        impl<T: CpuLevel> SimdMask for $mask<T> {
            #[inline(always)]
            fn splat(value: bool) -> Self {
                $mask($mask32s::splat(T::token(), value))
            }
            #[inline(always)]
            fn any(self) -> bool {
                self.0.any_true()
            }
        }
    };
}

lanes!(8, F32x8: f32x8, I32x8: i32x8 | u32x8 | u8x32, Mask32x8: mask32x8);
lanes!(16, F32x16: f32x16, I32x16: i32x16 | u32x16 | u8x64, Mask32x16: mask32x16);
