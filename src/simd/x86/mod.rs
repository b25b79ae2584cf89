//! Run-time detection of AVX2 and AVX-512.
//!
//! `forbid(unsafe_code)` stops here, for one reason: `fearless_simd` asks for a token per operation,
//! and a [`Simd`](super::Simd) carries none. So [`Token::assumed`] creates one, which is sound only
//! below [`dispatch`].

#![allow(unsafe_code)]

mod lanes;
mod mask;
mod shuffle;

use fearless_simd::{Avx2, Avx512, Level};

use super::{BatchLoop, Use};
use lanes::{F32x8, F32x16};

/// Instructions that the processor was found to have. Nothing but the lanes calls
/// [`assumed`](Token::assumed), and nothing but [`dispatch`] chooses lanes.
trait Token: Sized {
    fn assumed() -> Self;
}

impl Token for Avx2 {
    #[inline(always)]
    fn assumed() -> Avx2 {
        // SAFETY: `dispatch` has detected them.
        unsafe { Avx2::assume_supported() }
    }
}

impl Token for Avx512 {
    #[inline(always)]
    fn assumed() -> Avx512 {
        // SAFETY: `dispatch` has detected them.
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
    // A constant, so that what is only called with these lanes is not compiled.
    if const { !matches!(L::USE, Use::Rare) && cfg!(not(disable_dispatch_avx512)) }
        && level.as_avx512().is_some()
    {
        batch.run::<F32x16>();
    } else if cfg!(not(disable_dispatch_avx2)) && level.as_avx2().is_some() {
        batch.run::<F32x8>();
    } else {
        return Some(batch);
    }
    None
}

/// Calls `f` with 0 to N - 1. An iterator's checks in debug builds would keep the loop from being
/// vectorised.
#[inline(always)]
fn each<const N: usize>(mut f: impl FnMut(usize)) {
    let mut i = 0;
    while i < N {
        f(i);
        i += 1;
    }
}
