//! Elements at a stride.

use bytemuck::Pod;
use unitpack::{Strided, StridedMut};

use crate::random::Rng;

/// Bytes around elements.
pub const FILL: u8 = 0xEE;

/// Where elements of some size lie in bytes: an offset, a stride, and how many.
#[derive(Clone, Copy, Debug)]
pub struct Elements {
    /// Where the first begins.
    pub offset: usize,
    /// Bytes from one to the next.
    pub stride: usize,
    /// How many there are.
    pub len: usize,
}

impl Elements {
    /// Any place: tight or not, at any alignment.
    pub fn random(rng: &mut Rng, size: usize, len: usize) -> Self {
        let gap = [0, 1, 3, 4, 20][rng.below(5) as usize];
        Elements { offset: rng.below(20) as usize, stride: size + gap, len }
    }

    /// Bytes that end with the last element.
    pub fn bytes(self, size: usize) -> Vec<u8> {
        let end = self.len.checked_sub(1).map_or(0, |last| self.offset + last * self.stride + size);
        vec![FILL; end]
    }

    /// The bytes of element `i`, of `size` bytes.
    pub fn element(self, i: usize, size: usize) -> core::ops::Range<usize> {
        let at = self.offset + i * self.stride;
        at..at + size
    }

    /// To read.
    pub fn read(self, bytes: &[u8]) -> Strided<'_> {
        let Elements { offset, stride, len } = self;
        Strided { bytes, offset, stride, len }
    }

    /// To write.
    pub fn write(self, bytes: &mut [u8]) -> StridedMut<'_> {
        let Elements { offset, stride, len } = self;
        StridedMut { bytes, offset, stride, len }
    }

    /// Bytes that hold elements, and are otherwise filled.
    pub fn holding<T: Pod>(self, elements: &[T]) -> Vec<u8> {
        let size = size_of::<T>();
        let mut bytes = self.bytes(size);
        for (i, element) in elements.iter().enumerate() {
            bytes[self.element(i, size)].copy_from_slice(bytemuck::bytes_of(element));
        }
        bytes
    }
}
