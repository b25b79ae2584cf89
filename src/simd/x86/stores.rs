//! The stores of AVX2 and AVX-512 that bypass the caches.
//!
//! `forbid(unsafe_code)` stops here, as they take pointers. Whoever has a token has the processor; a
//! [`Fence`] keeps the block that is written to borrowed until all others see what it holds.

#![allow(unsafe_code)]

#[cfg(target_arch = "x86")]
use core::arch::x86 as arch;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64 as arch;

use fearless_simd::{Avx2, Avx512};

use crate::simd::stream::Fence;

/// A processor, by its token, that streams blocks of `N`.
pub(crate) trait Streaming<const N: usize> {
    /// Streams to an aligned block if the fence is for that, and stores to any other.
    fn stream<'a>(self, from: [f32; N], to: &'a mut [f32; N], fence: &Fence<'a>);
}

macro_rules! streaming {
    ($token:ty, $n:literal: $load:ident, $stream:ident) => {
        impl Streaming<$n> for $token {
            #[inline(always)]
            fn stream<'a>(self, from: [f32; $n], to: &'a mut [f32; $n], fence: &Fence<'a>) {
                let address = to.as_mut_ptr();
                if !fence.streams() || address.addr() % size_of_val(to) != 0 {
                    *to = from;
                    return;
                }
                // SAFETY: the token stands for these instructions. Both arrays are as long as the
                // vector; the one written to is aligned, borrowed alone, and stays so until the fence,
                // which `batch::decode_all`, the one place that makes any, drops.
                unsafe { arch::$stream(address, arch::$load(from.as_ptr())) }
            }
        }
    };
}

streaming!(Avx2, 8: _mm256_loadu_ps, _mm256_stream_ps);
streaming!(Avx512, 16: _mm512_loadu_ps, _mm512_stream_ps);

/// Ends a time of streaming.
#[inline(always)]
pub(crate) fn fence() {
    // SAFETY: it takes nothing, and only lanes of AVX2 and AVX-512 stream; those processors have it.
    unsafe { arch::_mm_sfence() }
}
