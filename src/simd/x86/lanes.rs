//! The eight- and sixteen-lane forms of [`Simd`] on AVX2 and AVX-512, through `fearless_simd`.

use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use bytemuck::cast_slice;
use fearless_simd::prelude::*;
use fearless_simd::{Simd as _, SimdMask as _};
use fearless_simd::{
    f32x8, f32x16, i32x8, i32x16, mask32x8, mask32x16, u8x32, u8x64, u32x8, u32x16,
};

use crate::simd::stream::Fence;
use crate::simd::x86::CpuLevel;
use crate::simd::x86::stores::Streaming;
use crate::simd::{MOST_COMPONENTS, Simd, SimdInt, SimdMask, look_up, look_up3, look_up4};

macro_rules! operators {
    ($($type:ident: $($trait:ident $method:ident),*;)*) => { $($(
        impl<T: CpuLevel> $trait for $type<T> {
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
        $int:ident: $i32s:ident | $u32s:ident | $u8s:ident,
        $mask:ident: $mask32s:ident
    ) => {
        #[derive(Clone, Copy)]
        pub(crate) struct $float<T: CpuLevel>($f32s<T::Simd>);
        #[derive(Clone, Copy)]
        pub(crate) struct $int<T: CpuLevel>($i32s<T::Simd>);
        #[derive(Clone, Copy)]
        pub(crate) struct $mask<T: CpuLevel>($mask32s<T::Simd>);

        operators! {
            $float: Add add, Sub sub, Mul mul, Div div;
            $int: Add add, Sub sub, Mul mul, BitAnd bitand, BitOr bitor, BitXor bitxor;
            $mask: BitAnd bitand, BitOr bitor;
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
            const STREAMS: bool = true;

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
            fn stream<'a>(self, block: &'a mut [f32; $n], fence: &Fence<'a>) {
                T::token().stream(*self.0, block, fence);
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
            fn load_vectors<const N: usize>(block: &[[f32; N]; $n]) -> [Self; 3] {
                $int::columns::<N, 3>(cast_slice(block.as_flattened())).map(Self::from_bits)
            }
            #[inline(always)]
            fn store_vectors<const N: usize>([x, y, z]: [Self; 3], block: &mut [[f32; N]; $n]) {
                let (rows, _) = block.as_flattened_mut().as_chunks_mut();
                for (row, [pick_y, pick_z, keep]) in
                    rows.iter_mut().zip(&Shuffle::<N, 3, $n, { 4 * $n }>::STORE)
                {
                    let xyz = x.0.concat_swizzle_dyn(y.0, *pick_y).concat_swizzle_dyn(z.0, *pick_z);
                    let old = $f32s::simd_from(T::token(), *row);
                    *row = if N == 3 { *xyz } else { *xyz.concat_swizzle_dyn(old, *keep) };
                }
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
            fn gather4(table: &[u32], index: $int<T>) -> [$int<T>; 4] {
                let mut rows = [[0; 4]; $n];
                for (row, i) in rows.iter_mut().zip(*index.0) {
                    *row = look_up4(table, i);
                }
                $int::columns::<4, 4>(rows.as_flattened())
            }
            #[inline(always)]
            fn gather3(table: &[[f32; 3]], index: $int<T>) -> [Self; 3] {
                let mut rows = [[0.0; 3]; $n];
                for (row, i) in rows.iter_mut().zip(*index.0) {
                    *row = look_up3(table, i);
                }
                Self::load_vectors(&rows)
            }
        }

        impl<T: CpuLevel> $int<T> {
            /// The first `C` of `N` columns; as many rows as lanes stand one after the other.
            #[inline(always)]
            fn columns<const N: usize, const C: usize>(rows: &[i32]) -> [Self; C] {
                let mut columns = [$i32s::splat(T::token(), 0); C];
                let (parts, _) = rows.as_chunks();
                for (part, picks) in parts.iter().zip(&Shuffle::<N, C, $n, { 4 * $n }>::LOAD) {
                    let part = $i32s::simd_from(T::token(), *part);
                    for (column, pick) in columns.iter_mut().zip(picks) {
                        *column = column.concat_swizzle_dyn(part, *pick);
                    }
                }
                columns.map(Self)
            }
        }

        impl<T: CpuLevel> SimdInt for $int<T> {
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

        impl<T: CpuLevel> SimdMask for $mask<T> {
            #[inline(always)]
            fn any(self) -> bool {
                self.0.any_true()
            }
        }
    };
}

/// Which bytes of two vectors of `LANES` lanes make one, on the way from or to `LANES` vectors of `N`
/// components, of which `C` count, and which stand in `N` rows. Not filled in beyond [`MOST_COMPONENTS`].
struct Shuffle<const N: usize, const C: usize, const LANES: usize, const BYTES: usize>;

impl<const N: usize, const C: usize, const LANES: usize, const BYTES: usize>
    Shuffle<N, C, LANES, BYTES>
{
    /// For each row: of a component what is collected already, and from the row what it has of it.
    const LOAD: [[[u8; BYTES]; C]; N] = {
        let mut picks = [[[0; BYTES]; C]; N];
        let mut i = 0;
        while N <= MOST_COMPONENTS && i < N * LANES {
            let (row, component, lane) = (i / LANES, i % N, i / N);
            // In this row it is found, in those after it kept.
            let mut later = row;
            while component < C && later < N {
                let from = if later == row { LANES + i % LANES } else { lane };
                put(&mut picks[later][component], lane, from);
                later += 1;
            }
            i += 1;
        }
        picks
    };
    /// For each row: of x and y, then of that and z, then of that and what the row has.
    const STORE: [[[u8; BYTES]; 3]; N] = {
        let mut picks = [[[0; BYTES]; 3]; N];
        let mut i = 0;
        while N <= MOST_COMPONENTS && i < N * LANES {
            let (row, place, component, lane) = (i / LANES, i % LANES, i % N, i / N);
            let [y, z, old] = &mut picks[row];
            put(y, place, if component == 1 { LANES + lane } else { lane });
            put(z, place, if component == 2 { LANES + lane } else { place });
            put(old, place, if component > 2 { LANES + place } else { place });
            i += 1;
        }
        picks
    };
}

/// From threes of bytes to fours, the fourth none of the bytes there are.
const fn spread<const BYTES: usize>() -> [u8; BYTES] {
    let mut picks = [u8::MAX; BYTES];
    let mut byte = 0;
    while byte < BYTES {
        if byte % 4 < 3 {
            picks[byte] = (byte / 4 * 3 + byte % 4) as u8;
        }
        byte += 1;
    }
    picks
}

/// From fours of bytes to threes, and then anything.
const fn dense<const BYTES: usize>() -> [u8; BYTES] {
    let mut picks = [0; BYTES];
    let mut byte = 0;
    while byte < BYTES / 4 * 3 {
        picks[byte] = (byte / 3 * 4 + byte % 3) as u8;
        byte += 1;
    }
    picks
}

/// Picks lane `from` for lane `to`.
const fn put(picks: &mut [u8], to: usize, from: usize) {
    let mut byte = 0;
    while byte < 4 {
        picks[4 * to + byte] = (4 * from + byte) as u8;
        byte += 1;
    }
}

lanes!(8, F32x8: f32x8, I32x8: i32x8 | u32x8 | u8x32, Mask32x8: mask32x8);
lanes!(16, F32x16: f32x16, I32x16: i32x16 | u32x16 | u8x64, Mask32x16: mask32x16);
