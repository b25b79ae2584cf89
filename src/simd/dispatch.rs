//! Which lanes a loop runs on: the widest that the processor has.

use crate::simd::Simd;
use crate::simd::wide::F32x8;

/// A loop over blocks of lanes, of any number.
pub(crate) trait Job: Sized {
    /// Whether eight lanes of `wide` are quicker than one.
    const WIDE: bool = true;

    /// Does what fills whole blocks, and gives the rest.
    fn run<V: Simd>(self) -> Self;
}

/// Whether this target has vectors that eight lanes can stand on. Without them one lane is quicker
/// and smaller, and gives the same bits.
const EIGHT_LANES: bool = cfg!(any(
    target_feature = "sse2",
    target_feature = "simd128",
    all(target_arch = "aarch64", target_feature = "neon"),
));

/// Does a job, all of it.
#[inline(always)]
pub(crate) fn dispatch<J: Job>(job: J) {
    #[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
    let Some(job) = crate::simd::x86::dispatch(job) else { return };
    if EIGHT_LANES && J::WIDE {
        finish(job.run::<F32x8>());
    } else {
        finish(job);
    }
}

/// The rest of a job, lane by lane.
#[inline(always)]
pub(crate) fn finish<J: Job>(job: J) {
    job.run::<f32>();
}
