//! Stores past the caches, for outputs that are larger than they.
//!
//! A usual store reads the line that it changes first, and drives out another: of what is written
//! once and read much later, every byte crosses the memory bus twice. Streaming stores do neither.

#![cfg_attr(
    all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")),
    allow(unsafe_code)
)]

use core::cell::Cell;
use core::marker::PhantomData;

/// Bytes from which on an output counts as larger than the caches.
const LARGE: usize = 32 << 20;

/// What streaming stores need to be aligned to.
pub(crate) const ALIGNMENT: usize = 64;

/// Whether stores stream. Those that do are seen late and in any order, also by the thread itself,
/// until this is dropped; it keeps what they go to borrowed so long.
pub(crate) struct Fence<'a> {
    streams: bool,
    blocks: PhantomData<Cell<&'a mut ()>>,
}

impl Fence<'_> {
    /// For an output of so many bytes.
    #[inline(always)]
    pub(crate) fn new(bytes: usize) -> Self {
        let streams = cfg!(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")));
        Fence { streams: streams && bytes >= LARGE, blocks: PhantomData }
    }

    #[inline(always)]
    pub(crate) fn streams(&self) -> bool {
        self.streams
    }
}

impl Drop for Fence<'_> {
    #[inline(always)]
    fn drop(&mut self) {
        #[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
        if self.streams {
            x86::fence();
        }
    }
}

#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
pub(crate) use x86::Streaming;

#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
mod x86 {
    #[cfg(target_arch = "x86")]
    use core::arch::x86 as arch;
    #[cfg(target_arch = "x86_64")]
    use core::arch::x86_64 as arch;

    use fearless_simd::{Avx2, Avx512};

    use super::Fence;

    /// A processor, by its token, that streams blocks of `N`.
    pub(crate) trait Streaming<const N: usize> {
        /// Streams to an aligned block, if stores stream.
        fn stream<'a>(self, from: [f32; N], to: &'a mut [f32; N], fence: &Fence<'a>);
    }

    macro_rules! streaming {
        ($token:ty, $n:literal: $load:ident, $stream:ident) => {
            impl Streaming<$n> for $token {
                #[inline(always)]
                fn stream<'a>(self, from: [f32; $n], to: &'a mut [f32; $n], fence: &Fence<'a>) {
                    let address = to.as_mut_ptr();
                    if !fence.streams || address.addr() % size_of_val(to) != 0 {
                        *to = from;
                        return;
                    }
                    // SAFETY: the token stands for these instructions. Both arrays are as long as the
                    // vector; the one written to is aligned, borrowed alone, and stays so until the fence.
                    unsafe { arch::$stream(address, arch::$load(from.as_ptr())) }
                }
            }
        };
    }

    streaming!(Avx2, 8: _mm256_loadu_ps, _mm256_stream_ps);
    streaming!(Avx512, 16: _mm512_loadu_ps, _mm512_stream_ps);

    #[inline(always)]
    pub(super) fn fence() {
        // SAFETY: of no operands; every processor that streams, and so has a fence, has it.
        unsafe { arch::_mm_sfence() }
    }
}
