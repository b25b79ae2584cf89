//! Runs a batch loop on the widest SIMD that the processor has.

use super::wide::F32x8;
use super::{BatchLoop, Use};

/// Whether the processor is asked what it has. Then `wide`'s lanes are for those without AVX2.
const DETECTS: bool = cfg!(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")));

/// Whether `wide`'s eight lanes compile to SIMD here. Where they do not, one lane is faster and
/// smaller, and gives the same bits.
const HAS_SIMD: bool = cfg!(any(
    target_feature = "sse2",
    target_feature = "simd128",
    all(target_arch = "aarch64", target_feature = "neon"),
));

#[inline(always)]
pub(crate) fn dispatch<L: BatchLoop>(batch: L) {
    #[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
    let Some(batch) = super::x86::dispatch(batch) else { return };
    if const { has_wide_form(L::USE) } {
        batch.run::<F32x8>();
    } else {
        batch.run::<f32>();
    }
}

/// Whether `wide`'s lanes are used. A constant, so that what is only called with them is not compiled.
const fn has_wide_form(of: Use) -> bool {
    HAS_SIMD
        && match of {
            Use::Often => true,
            Use::Sometimes | Use::Rare => !DETECTS,
            Use::Moves => false,
        }
}
