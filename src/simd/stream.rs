//! Stores past the caches, for outputs that are larger than they.
//!
//! A usual store reads the line that it changes first, and drives out another: of what is written
//! once and read much later, every byte crosses the memory bus twice. Streaming stores do neither.

use core::cell::Cell;
use core::marker::PhantomData;

/// Bytes from which on an output counts as larger than the caches.
const LARGE: usize = 32 << 20;

/// Whether an output of so many bytes is larger than the caches, where any lanes stream.
#[inline(always)]
pub(crate) fn is_large(bytes: usize) -> bool {
    let any = cfg!(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")));
    any && bytes >= LARGE
}

/// What streaming stores need to be aligned to.
pub(crate) const ALIGNMENT: usize = 64;

/// Whether stores should stream. Those that do may be seen late and in any order until this is
/// dropped, which whoever makes one has to do; so long it keeps what they go to borrowed.
pub(crate) struct Fence<'a> {
    streams: bool,
    blocks: PhantomData<Cell<&'a mut ()>>,
}

impl Fence<'_> {
    #[inline(always)]
    pub(crate) fn new(streams: bool) -> Self {
        Fence { streams, blocks: PhantomData }
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
            crate::simd::x86::stores::fence();
        }
    }
}
