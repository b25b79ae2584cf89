//! Run-time detection of AVX2 and AVX-512.
//!
//! `forbid(unsafe_code)` stops here, for one reason: `fearless_simd` asks for a token per operation,
//! and a [`Simd`](super::Simd) carries none. So [`CpuLevel::token`] creates one, which is sound only
//! below [`dispatch`].

#![allow(unsafe_code)]

mod lanes;
mod shuffle;

use fearless_simd::{Avx2, Avx512, Level, Simd};

use super::dispatch::BatchLoop;
use lanes::{F32x8, F32x16};

/// Instructions that the processor was found to have.
///
/// # Safety
/// The implementing types are used only below [`dispatch`], after the instructions were detected.
pub(crate) unsafe trait CpuLevel: Copy + 'static {
    type Simd: Simd;
    fn token() -> Self::Simd;
}

#[derive(Clone, Copy)]
struct Avx2Level;

// SAFETY: used only in `dispatch`, after AVX2 was detected.
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

// SAFETY: used only in `dispatch`, after AVX-512 was detected.
unsafe impl CpuLevel for Avx512Level {
    type Simd = Avx512;
    #[inline(always)]
    fn token() -> Avx512 {
        // SAFETY: see `CpuLevel`.
        unsafe { Avx512::assume_supported() }
    }
}

/// Runs a loop on AVX-512 or AVX2, or returns it where there is neither.
///
/// `--cfg disable_dispatch_avx512` and `--cfg disable_dispatch_avx2` leave one out, as they do in
/// `fearless_simd`.
#[inline(always)]
pub(super) fn dispatch<L: BatchLoop>(batch: L) -> Option<L> {
    let level = Level::new();
    if cfg!(not(disable_dispatch_avx512)) && L::USE_AVX512 && level.as_avx512().is_some() {
        batch.run::<F32x16<Avx512Level>>();
    } else if cfg!(not(disable_dispatch_avx2)) && level.as_avx2().is_some() {
        batch.run::<F32x8<Avx2Level>>();
    } else {
        return Some(batch);
    }
    None
}
