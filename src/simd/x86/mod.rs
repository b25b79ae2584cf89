//! The vectors of this very processor, found when the program runs.
//!
//! `forbid(unsafe_code)` stops here, for one reason: a lane's operations take no token that its
//! instructions exist, so [`CpuLevel::token`] makes one of nothing.

#![allow(unsafe_code)]

pub(crate) mod lanes;
pub(crate) mod stores;

use fearless_simd::{Avx2, Avx512, Level, Simd};

use crate::simd::dispatch::{Job, finish};
use crate::simd::x86::lanes::{F32x8, F32x16};

/// Instructions that the processor has.
///
/// # Safety
/// A type that implements it is named only where the processor was asked, which is here, so that
/// whoever calls these functions does so on such a processor.
pub(crate) unsafe trait CpuLevel: Copy + 'static {
    type Simd: Simd;
    fn token() -> Self::Simd;
}

#[derive(Clone, Copy)]
struct Avx2Level;

// SAFETY: `dispatch` alone names it.
unsafe impl CpuLevel for Avx2Level {
    type Simd = Avx2;
    #[inline(always)]
    fn token() -> Avx2 {
        // SAFETY: see `CpuLevel`.
        unsafe { Avx2::assume_supported() }
    }
}

#[derive(Clone, Copy)]
struct Avx512Level;

// SAFETY: `dispatch` alone names it.
unsafe impl CpuLevel for Avx512Level {
    type Simd = Avx512;
    #[inline(always)]
    fn token() -> Avx512 {
        // SAFETY: see `CpuLevel`.
        unsafe { Avx512::assume_supported() }
    }
}

/// Does a job on the vectors of AVX-512 or AVX2, or gives it back where there are none.
///
/// `--cfg disable_dispatch_avx512` and `--cfg disable_dispatch_avx2` leave one out, as they do in
/// `fearless_simd`.
#[inline(always)]
pub(crate) fn dispatch<J: Job>(job: J) -> Option<J> {
    let level = Level::new();
    if cfg!(not(disable_dispatch_avx512))
        && let Some(avx512) = level.as_avx512()
    {
        avx512.vectorize(
            #[inline(always)]
            || finish(job.run::<F32x16<Avx512Level>>()),
        );
    } else if cfg!(not(disable_dispatch_avx2))
        && let Some(avx2) = level.as_avx2()
    {
        avx2.vectorize(
            #[inline(always)]
            || finish(job.run::<F32x8<Avx2Level>>()),
        );
    } else {
        return Some(job);
    }
    None
}
