//! Truth values per lane.
//!
//! `fearless_simd` converts AVX2's by way of arrays, which dev builds copy with checks. So here they are
//! vectors of 0 and -1.

#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
use core::ops::{BitAnd, BitOr, Not};

use fearless_simd::prelude::*;
use fearless_simd::{Avx2, Avx512, f32x8, f32x16, i32x8, i32x16, kernel, mask32x16};

use super::Token;

/// Vectors that are compared, and chosen by what that gives.
pub(super) trait Compare: Copy {
    type Mask: Copy;

    fn less(self, other: Self) -> Self::Mask;
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
}

/// What only floats are asked.
pub(super) trait LessOrEqual: Compare {
    fn less_or_equal(self, other: Self) -> Self::Mask;
}

/// What only integers are asked.
pub(super) trait Equal: Compare {
    fn equal(self, other: Self) -> Self::Mask;
}

/// 0 or -1 in each of eight lanes.
#[derive(Clone, Copy)]
pub(super) struct Bits8(i32x8<Avx2>);

impl Bits8 {
    #[inline(always)]
    pub(super) fn splat(token: Avx2, value: bool) -> Self {
        Bits8(i32x8::splat(token, -i32::from(value)))
    }

    #[inline(always)]
    pub(super) fn any_true(self) -> bool {
        kernel!(
            #[inline(always)]
            fn any(_token: Avx2, bits: i32x8<Avx2>) -> bool {
                _mm256_movemask_epi8(bits.into()) != 0
            }
        );
        any(Avx2::assumed(), self.0)
    }
}

impl BitAnd for Bits8 {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Bits8(self.0 & other.0)
    }
}

impl BitOr for Bits8 {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Bits8(self.0 | other.0)
    }
}

impl Not for Bits8 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Bits8(self.0 ^ i32x8::splat(Avx2::assumed(), -1))
    }
}

/// A function of two vectors on AVX2.
macro_rules! compare {
    ($name:ident, $vector:ident, |$a:ident, $b:ident| $value:expr) => {
        #[inline(always)]
        fn $name(self, other: Self) -> Bits8 {
            kernel!(
                #[inline(always)]
                fn compare(token: Avx2, $a: $vector<Avx2>, $b: $vector<Avx2>) -> i32x8<Avx2> {
                    $value.simd_into(token)
                }
            );
            Bits8(compare(Avx2::assumed(), self, other))
        }
    };
}

impl Compare for f32x8<Avx2> {
    type Mask = Bits8;

    compare!(less, f32x8, |a, b| _mm256_castps_si256(_mm256_cmp_ps::<_CMP_LT_OQ>(
        a.into(),
        b.into()
    )));
    #[inline(always)]
    fn select(mask: Bits8, yes: Self, no: Self) -> Self {
        kernel!(
            #[inline(always)]
            fn choose(
                token: Avx2,
                mask: i32x8<Avx2>,
                yes: f32x8<Avx2>,
                no: f32x8<Avx2>,
            ) -> f32x8<Avx2> {
                let mask = _mm256_castsi256_ps(mask.into());
                _mm256_blendv_ps(no.into(), yes.into(), mask).simd_into(token)
            }
        );
        choose(Avx2::assumed(), mask.0, yes, no)
    }
}

impl LessOrEqual for f32x8<Avx2> {
    compare!(less_or_equal, f32x8, |a, b| _mm256_castps_si256(_mm256_cmp_ps::<_CMP_LE_OQ>(
        a.into(),
        b.into()
    )));
}

impl Compare for i32x8<Avx2> {
    type Mask = Bits8;

    compare!(less, i32x8, |a, b| _mm256_cmpgt_epi32(b.into(), a.into()));

    #[inline(always)]
    fn select(mask: Bits8, yes: Self, no: Self) -> Self {
        kernel!(
            #[inline(always)]
            fn choose(
                token: Avx2,
                mask: i32x8<Avx2>,
                yes: i32x8<Avx2>,
                no: i32x8<Avx2>,
            ) -> i32x8<Avx2> {
                _mm256_blendv_epi8(no.into(), yes.into(), mask.into()).simd_into(token)
            }
        );
        choose(Avx2::assumed(), mask.0, yes, no)
    }
}

impl Equal for i32x8<Avx2> {
    compare!(equal, i32x8, |a, b| _mm256_cmpeq_epi32(a.into(), b.into()));
}

/// AVX-512 has registers for truth values.
macro_rules! compare_by_registers {
    ($($vector:ident),*) => { $(
        impl Compare for $vector<Avx512> {
            type Mask = mask32x16<Avx512>;

            #[inline(always)]
            fn less(self, other: Self) -> Self::Mask {
                self.simd_lt(other)
            }
            #[inline(always)]
            fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
                Select::select(mask, yes, no)
            }
        }
    )* };
}

compare_by_registers!(f32x16, i32x16);

impl LessOrEqual for f32x16<Avx512> {
    #[inline(always)]
    fn less_or_equal(self, other: Self) -> Self::Mask {
        self.simd_le(other)
    }
}

impl Equal for i32x16<Avx512> {
    #[inline(always)]
    fn equal(self, other: Self) -> Self::Mask {
        self.simd_eq(other)
    }
}
