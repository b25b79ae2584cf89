//! Non-temporal stores for outputs larger than the caches.
//!
//! An ordinary store first reads the line that it changes, and evicts another. So of what is written
//! once and read much later, every byte crosses the memory bus twice. A streaming store avoids both.

/// Smallest output in bytes that counts as larger than the caches.
const LARGE: usize = 32 << 20;

/// Whether an output of `bytes` is larger than the caches, and streaming stores exist here.
#[inline(always)]
pub(crate) fn is_large(bytes: usize) -> bool {
    let available = cfg!(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")));
    available && bytes >= LARGE
}

/// Alignment in bytes that streaming stores need.
pub(crate) const ALIGNMENT: usize = 64;

/// Whether stores stream. Other threads may see streaming stores in any order until the fence is
/// dropped. So whoever makes a fence keeps the destination borrowed until then, and drops the fence.
pub struct Fence {
    streams: bool,
}

impl Fence {
    #[inline(always)]
    pub(crate) fn new(streams: bool) -> Self {
        Fence { streams }
    }

    #[inline(always)]
    pub(crate) fn streams(&self) -> bool {
        self.streams
    }
}

impl Drop for Fence {
    #[inline(always)]
    fn drop(&mut self) {
        #[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
        if self.streams {
            x86::fence();
        }
    }
}

#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
pub(crate) mod x86 {
    //! The streaming stores of AVX2 and AVX-512.
    //!
    //! `forbid(unsafe_code)` stops here, as they take pointers. A token proves that the processor has
    //! the instructions.

    #![allow(unsafe_code)]

    #[cfg(target_arch = "x86")]
    use core::arch::x86 as arch;
    #[cfg(target_arch = "x86_64")]
    use core::arch::x86_64 as arch;

    use fearless_simd::{Avx2, Avx512};

    /// A processor, by its token, that streams blocks of `N` floats.
    pub(crate) trait Streaming<const N: usize> {
        /// Streams to an aligned block, and stores to any other.
        fn stream(self, from: [f32; N], to: &mut [f32; N]);
    }

    macro_rules! streaming {
        ($token:ty, $n:literal: $load:ident, $stream:ident) => {
            impl Streaming<$n> for $token {
                #[inline(always)]
                fn stream(self, from: [f32; $n], to: &mut [f32; $n]) {
                    let address = to.as_mut_ptr();
                    if address.addr() % size_of_val(to) != 0 {
                        *to = from;
                        return;
                    }
                    // SAFETY: the token proves that these instructions exist. Both arrays are as long
                    // as the vector. The one written to is aligned, and borrowed alone, by
                    // `layout::decode`, until after it has dropped the fence.
                    unsafe { arch::$stream(address, arch::$load(from.as_ptr())) }
                }
            }
        };
    }

    streaming!(Avx2, 8: _mm256_loadu_ps, _mm256_stream_ps);
    streaming!(Avx512, 16: _mm512_loadu_ps, _mm512_stream_ps);

    /// Orders all earlier streaming stores before later ones.
    #[inline(always)]
    pub(super) fn fence() {
        // SAFETY: it takes nothing. Only AVX2 and AVX-512 stream, and those processors have it.
        unsafe { arch::_mm_sfence() }
    }
}
