//! Eight and sixteen lanes on AVX2 and AVX-512, through `fearless_simd`.

use core::ops::{Neg, Not};

use fearless_simd::prelude::*;
use fearless_simd::{
    Avx2, Avx512, Simd as _, SimdMask as _, f32x8, f32x16, i32x8, i32x16, mask32x16, u8x16, u8x32,
    u8x64, u32x8, u32x16,
};

use super::mask::{Bits8, Compare, Equal, LessOrEqual};
use super::shuffle::{Shuffle, dense, first, spread};
use super::{Token, each};
use crate::simd::operators::{operators, scalar_operators};
use crate::simd::stream::x86::Streaming;
use crate::simd::{Simd, SimdInt, SimdMask, look_up, look_up3, look_up4};

/// A vector of the elements of an array. `simd_from` would copy them with checks in debug builds.
macro_rules! from_array {
    ($vector:ident, $token:expr, $array:expr) => {{
        let mut vector = $vector::splat($token, Default::default());
        *vector = $array;
        vector
    }};
}

/// Joins vectors of 16 bytes to one of `u8`s.
macro_rules! join {
    (8, $token:expr, $quad:expr) => {
        from_array!(u8x16, $token, *$quad()?).combine(from_array!(u8x16, $token, *$quad()?))
    };
    (16, $token:expr, $quad:expr) => {
        join!(8, $token, $quad).combine(join!(8, $token, $quad))
    };
}

/// Splits a vector of `u8`s, and writes the first bytes of each 16, by the pick.
macro_rules! split {
    (4, $token:expr, $bytes:expr, $pick:expr, $quad:expr) => {{
        let to = $quad()?;
        let kept = from_array!(u8x16, $token, *to);
        *to = *$bytes.concat_swizzle_dyn(kept, $pick);
    }};
    (8, $token:expr, $bytes:expr, $pick:expr, $quad:expr) => {{
        let (low, high) = $bytes.split();
        split!(4, $token, low, $pick, $quad);
        split!(4, $token, high, $pick, $quad);
    }};
    (16, $token:expr, $bytes:expr, $pick:expr, $quad:expr) => {{
        let (low, high) = $bytes.split();
        split!(8, $token, low, $pick, $quad);
        split!(8, $token, high, $pick, $quad);
    }};
}

macro_rules! lanes {
    (
        $n:tt, $level:ident,
        $float:ident: $f32s:ident,
        $int:ident: $i32s:ident | $u32s:ident | $u8s:ident,
        $mask:ident: $masks:ident $(<$mask_level:ident>)?
    ) => {
        #[derive(Clone, Copy)]
        pub(crate) struct $float($f32s<$level>);
        #[derive(Clone, Copy)]
        pub(crate) struct $int($i32s<$level>);
        #[derive(Clone, Copy)]
        pub(crate) struct $mask($masks $(<$mask_level>)?);

        operators!($float: Add add, Sub sub, Mul mul, Div div);
        operators!($int: Add add, Sub sub, Mul mul, BitAnd bitand, BitOr bitor, BitXor bitxor);
        operators!($mask: BitAnd bitand, BitOr bitor);
        scalar_operators!($float, f32: Add add, Sub sub, Mul mul, Div div);
        scalar_operators!(
            $int, i32: Add add, Sub sub, Mul mul, BitAnd bitand, BitOr bitor, BitXor bitxor
        );

        impl From<f32> for $float {
            #[inline(always)]
            fn from(x: f32) -> Self {
                $float($f32s::splat($level::assumed(), x))
            }
        }

        impl From<i32> for $int {
            #[inline(always)]
            fn from(i: i32) -> Self {
                $int($i32s::splat($level::assumed(), i))
            }
        }

        impl Neg for $float {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Neg for $int {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Not for $mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self(!self.0)
            }
        }

        impl Simd for $float {
            type Int = $int;
            type Mask = $mask;
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
                $level::assumed().vectorize(f)
            }
            #[inline(always)]
            fn load(block: &[f32; $n]) -> Self {
                $float(from_array!($f32s, $level::assumed(), *block))
            }
            #[inline(always)]
            fn store(self, block: &mut [f32; $n]) {
                *block = *self.0;
            }
            #[inline(always)]
            fn stream(self, block: &mut [f32; $n]) {
                $level::assumed().stream(*self.0, block);
            }
            #[inline(always)]
            fn load_bytes(block: &[[u8; 3]; $n]) -> $int {
                // AVX2 has no permutation of all bytes.
                if $n == 8 {
                    return Self::load_int(block, |[a, b, c]| u32::from_le_bytes([a, b, c, 0]));
                }
                let mut bytes = [0; 4 * $n];
                let (from, _) = block.as_flattened().as_chunks::<$n>();
                let (to, _) = bytes.as_chunks_mut::<$n>();
                each::<3>(
                    #[inline(always)]
                    |i| to[i] = from[i],
                );
                let pick = from_array!($u8s, $level::assumed(), const { spread::<{ 4 * $n }>() });
                let bytes = from_array!($u8s, $level::assumed(), bytes);
                $int(bytes.swizzle_dyn_precise(pick).bitcast())
            }
            #[inline(always)]
            fn store_bytes(int: $int, block: &mut [[u8; 3]; $n]) {
                let bytes: $u8s<$level> = int.0.bitcast();
                let pick = from_array!($u8s, $level::assumed(), const { dense::<{ 4 * $n }>() });
                let bytes: [u8; 4 * $n] = *bytes.swizzle_dyn(pick);
                let (from, _) = bytes.as_chunks::<$n>();
                let (to, _) = block.as_flattened_mut().as_chunks_mut::<$n>();
                each::<3>(
                    #[inline(always)]
                    |i| to[i] = from[i],
                );
            }
            #[inline(always)]
            fn load_rows<const N: usize, const C: usize>(block: &[[[u8; 4]; N]; $n]) -> [Self; C] {
                let mut columns = [$u8s::splat($level::assumed(), 0).bitcast::<$u32s<$level>>(); C];
                let (rows, _) = block.as_flattened().as_flattened().as_chunks();
                for (row, picks) in rows.iter().zip(&Shuffle::<N, C, $n, { 4 * $n }>::LOAD) {
                    let row: $u32s<$level> = from_array!($u8s, $level::assumed(), *row).bitcast();
                    for (column, pick) in columns.iter_mut().zip(picks) {
                        *column = column.concat_swizzle_dyn(row, from_array!($u8s, $level::assumed(), *pick));
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
                let mut columns = [$u8s::splat($level::assumed(), 0).bitcast::<$u32s<$level>>(); C];
                for picks in &Shuffle::<4, C, $n, { 4 * $n }>::LOAD {
                    let row: $u32s<$level> = join!($n, $level::assumed(), quad).bitcast();
                    for (column, pick) in columns.iter_mut().zip(picks) {
                        *column = column.concat_swizzle_dyn(row, from_array!($u8s, $level::assumed(), *pick));
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
                let columns: [$u32s<$level>; C] = columns.map(
                    #[inline(always)]
                    |column| column.0.bitcast(),
                );
                let (rows, _) = block.as_flattened_mut().as_flattened_mut().as_chunks_mut();
                for (row, picks) in rows.iter_mut().zip(&Shuffle::<N, C, $n, { 4 * $n }>::STORE) {
                    let mut all = columns[0];
                    for (column, pick) in columns[1..].iter().zip(picks) {
                        all = all.concat_swizzle_dyn(*column, from_array!($u8s, $level::assumed(), *pick));
                    }
                    if N > C {
                        let kept: $u32s<$level> =
                            from_array!($u8s, $level::assumed(), *row).bitcast();
                        all = all.concat_swizzle_dyn(kept, from_array!($u8s, $level::assumed(), picks[C - 1]));
                    }
                    *row = *all.bitcast::<$u8s<$level>>();
                }
            }
            #[inline(always)]
            fn store_quads<'a, const C: usize>(
                columns: [Self; C],
                mut quad: impl FnMut() -> Option<&'a mut [u8; 16]>,
            ) -> Option<()> {
                let pick = from_array!(u8x16, $level::assumed(), const { first::<C>() });
                let columns: [$u32s<$level>; C] = columns.map(
                    #[inline(always)]
                    |column| column.0.bitcast(),
                );
                for picks in &Shuffle::<4, C, $n, { 4 * $n }>::STORE {
                    let mut all = columns[0];
                    for (column, pick) in columns[1..].iter().zip(picks) {
                        all = all.concat_swizzle_dyn(*column, from_array!($u8s, $level::assumed(), *pick));
                    }
                    split!($n, $level::assumed(), all.bitcast::<$u8s<$level>>(), pick, quad);
                }
                Some(())
            }
            #[inline(always)]
            fn load_int<B: Copy + 'static>(block: &[B; $n], f: impl Fn(B) -> u32) -> $int {
                let mut ints = [0; $n];
                each::<$n>(
                    #[inline(always)]
                    |i| ints[i] = f(block[i]) as i32,
                );
                $int(from_array!($i32s, $level::assumed(), ints))
            }
            #[inline(always)]
            fn store_int<B: Copy + 'static>(
                int: $int,
                block: &mut [B; $n],
                f: impl Fn(&mut B, u32),
            ) {
                let ints = *int.0;
                each::<$n>(
                    #[inline(always)]
                    |i| f(&mut block[i], ints[i] as u32),
                );
            }
            #[inline(always)]
            fn from_bits(bits: $int) -> Self {
                $float(bits.0.bitcast())
            }
            #[inline(always)]
            fn to_bits(self) -> $int {
                $int(self.0.bitcast())
            }
            #[inline(always)]
            fn from_int(i: $int) -> Self {
                $float($f32s::float_from(i.0))
            }
            #[inline(always)]
            fn lt(self, other: impl Into<Self>) -> $mask {
                $mask(self.0.less(other.into().0))
            }
            #[inline(always)]
            fn le(self, other: impl Into<Self>) -> $mask {
                $mask(self.0.less_or_equal(other.into().0))
            }
            #[inline(always)]
            fn select(mask: $mask, yes: impl Into<Self>, no: impl Into<Self>) -> Self {
                $float(Compare::select(mask.0, yes.into().0, no.into().0))
            }
            #[inline(always)]
            fn gather<B: Copy + Into<u32>>(table: &[B], index: $int) -> $int {
                let mut ints = *index.0;
                for i in &mut ints {
                    *i = look_up(table, *i);
                }
                $int(from_array!($i32s, $level::assumed(), ints))
            }
            #[inline(always)]
            fn gather3(table: &[[f32; 3]], index: $int) -> [Self; 3] {
                let mut rows = [[[0; 4]; 3]; $n];
                for (row, i) in rows.iter_mut().zip(*index.0) {
                    *row = look_up3(table, i).map(f32::to_ne_bytes);
                }
                Self::load_rows(&rows)
            }
            #[inline(always)]
            fn gather4(table: &[u32], index: $int) -> [$int; 4] {
                let mut rows = [[[0; 4]; 4]; $n];
                for (row, i) in rows.iter_mut().zip(*index.0) {
                    *row = look_up4(table, i).map(i32::to_ne_bytes);
                }
                Self::load_rows(&rows).map(Self::to_bits)
            }
        }

        impl SimdInt for $int {
            type Mask = $mask;

            #[inline(always)]
            fn shl(self, bits: u32) -> Self {
                $int(self.0 << bits)
            }
            #[inline(always)]
            fn shr_logical(self, bits: u32) -> Self {
                let unsigned: $u32s<$level> = self.0.bitcast();
                $int((unsigned >> bits).bitcast())
            }
            #[inline(always)]
            fn shr_arithmetic(self, bits: u32) -> Self {
                $int(self.0 >> bits)
            }
            #[inline(always)]
            fn lt(self, other: impl Into<Self>) -> $mask {
                $mask(self.0.less(other.into().0))
            }
            #[inline(always)]
            fn eq(self, other: impl Into<Self>) -> $mask {
                $mask(self.0.equal(other.into().0))
            }
            #[inline(always)]
            fn select(mask: $mask, yes: impl Into<Self>, no: impl Into<Self>) -> Self {
                $int(Compare::select(mask.0, yes.into().0, no.into().0))
            }
        }

        impl SimdMask for $mask {
            #[inline(always)]
            fn splat(value: bool) -> Self {
                $mask($masks::splat($level::assumed(), value))
            }
            #[inline(always)]
            fn any(self) -> bool {
                self.0.any_true()
            }
        }
    };
}

lanes!(8, Avx2, F32x8: f32x8, I32x8: i32x8 | u32x8 | u8x32, Mask32x8: Bits8);
lanes!(16, Avx512, F32x16: f32x16, I32x16: i32x16 | u32x16 | u8x64, Mask32x16: mask32x16<Avx512>);
