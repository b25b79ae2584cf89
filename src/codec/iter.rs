//! Codecs over iterators.

use core::fmt;
use core::iter::{Fuse, FusedIterator};
use core::marker::PhantomData;

use bytemuck::Zeroable;

use super::Codec;
use crate::batch::layout::{Codes, CodesMut, PART, Vectors, VectorsMut};

/// Elements taken from an iterator at a time.
const BLOCK: usize = PART;

/// Elements of which some are yet to be given out.
#[derive(Clone)]
struct Block<T> {
    elements: [T; BLOCK],
    next: usize,
    len: usize,
}

impl<T: Copy> Block<T> {
    fn new(empty: T) -> Self {
        Block { elements: [empty; BLOCK], next: 0, len: 0 }
    }

    #[inline]
    fn left(&self) -> usize {
        self.len - self.next
    }

    /// What is yet to be given out.
    #[inline]
    fn rest(&self) -> &[T] {
        self.elements.get(self.next..self.len).unwrap_or_default()
    }

    #[inline]
    fn next(&mut self) -> Option<T> {
        let element = self.elements.get(..self.len)?.get(self.next).copied()?;
        self.next += 1;
        Some(element)
    }

    /// Replaces what there was by `len` elements, written by `fill`.
    fn refill(&mut self, len: usize, fill: impl FnOnce(&mut [T])) {
        (self.next, self.len) = (0, len);
        fill(self.elements.get_mut(..len).unwrap_or_default());
    }
}

/// Takes up to a block from an iterator. Returns how many.
fn take<T>(from: &mut impl Iterator<Item = T>, block: &mut [T; BLOCK]) -> usize {
    let mut len = 0;
    for to in block {
        let Some(element) = from.next() else { break };
        *to = element;
        len += 1;
    }
    len
}

/// Bounds on how many elements there are.
fn size_hint(left: usize, (least, most): (usize, Option<usize>)) -> (usize, Option<usize>) {
    (least.saturating_add(left), most.and_then(|most| most.checked_add(left)))
}

/// The codes of the vectors that an iterator gives: see [`Codec::encode_iter`].
#[derive(Clone)]
pub struct EncodeIter<C: Codec, I> {
    vectors: Fuse<I>,
    codes: Block<C::Code>,
    encode: fn(Vectors<'_, 3>, CodesMut<'_>),
}

impl<C: Codec, I: Iterator> EncodeIter<C, I> {
    #[inline]
    pub(super) fn new(vectors: I, encode: fn(Vectors<'_, 3>, CodesMut<'_>)) -> Self {
        EncodeIter { vectors: vectors.fuse(), codes: Block::new(C::Code::zeroed()), encode }
    }
}

impl<C: Codec, I: Iterator<Item: Into<[f32; 3]>>> EncodeIter<C, I> {
    /// Returns how many codes there are now.
    #[inline(never)]
    fn refill(&mut self) -> usize {
        let mut vectors = [[0.0; 3]; BLOCK];
        let len = take(&mut self.vectors.by_ref().map(Into::into), &mut vectors);
        let vectors = vectors.get(..len).unwrap_or_default();
        let encode = self.encode;
        self.codes.refill(len, |codes| encode(Vectors::rows(vectors), CodesMut::native(codes)));
        len
    }
}

impl<C: Codec, I: Iterator<Item: Into<[f32; 3]>>> Iterator for EncodeIter<C, I> {
    type Item = C::Code;

    #[inline]
    fn next(&mut self) -> Option<C::Code> {
        if self.codes.left() == 0 {
            self.refill();
        }
        self.codes.next()
    }

    /// A block at a time, as `for_each` and `collect` of many take it.
    #[inline]
    fn fold<B, F: FnMut(B, C::Code) -> B>(mut self, mut result: B, mut f: F) -> B {
        loop {
            result = self.codes.rest().iter().copied().fold(result, &mut f);
            if self.refill() == 0 {
                return result;
            }
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        size_hint(self.codes.left(), self.vectors.size_hint())
    }
}

// The provided `len` could panic.
impl<C: Codec, I: ExactSizeIterator<Item: Into<[f32; 3]>>> ExactSizeIterator for EncodeIter<C, I> {
    fn len(&self) -> usize {
        self.vectors.len().saturating_add(self.codes.left())
    }
}
impl<C: Codec, I: Iterator<Item: Into<[f32; 3]>>> FusedIterator for EncodeIter<C, I> {}

impl<C: Codec, I: fmt::Debug> fmt::Debug for EncodeIter<C, I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("EncodeIter").field("vectors", &self.vectors).finish_non_exhaustive()
    }
}

/// The vectors of the codes that an iterator gives: see [`Codec::decode_iter`].
#[derive(Clone)]
pub struct DecodeIter<C, I> {
    codes: Fuse<I>,
    vectors: Block<[f32; 3]>,
    decode: fn(Codes<'_>, VectorsMut<'_, 3>),
    codec: PhantomData<C>,
}

impl<C: Codec, I: Iterator<Item = C::Code>> DecodeIter<C, I> {
    #[inline]
    pub(super) fn new(codes: I, decode: fn(Codes<'_>, VectorsMut<'_, 3>)) -> Self {
        DecodeIter {
            codes: codes.fuse(),
            vectors: Block::new([0.0; 3]),
            decode,
            codec: PhantomData,
        }
    }
}

impl<C: Codec, I: Iterator<Item = C::Code>> DecodeIter<C, I> {
    /// Returns how many vectors there are now.
    #[inline(never)]
    fn refill(&mut self) -> usize {
        let mut codes = [C::Code::zeroed(); BLOCK];
        let len = take(&mut self.codes, &mut codes);
        let codes = codes.get(..len).unwrap_or_default();
        let decode = self.decode;
        self.vectors.refill(len, |vectors| decode(Codes::native(codes), VectorsMut::rows(vectors)));
        len
    }
}

impl<C: Codec, I: Iterator<Item = C::Code>> Iterator for DecodeIter<C, I> {
    type Item = [f32; 3];

    #[inline]
    fn next(&mut self) -> Option<[f32; 3]> {
        if self.vectors.left() == 0 {
            self.refill();
        }
        self.vectors.next()
    }

    /// A block at a time, as `for_each` and `collect` of many take it.
    #[inline]
    fn fold<B, F: FnMut(B, [f32; 3]) -> B>(mut self, mut result: B, mut f: F) -> B {
        loop {
            result = self.vectors.rest().iter().copied().fold(result, &mut f);
            if self.refill() == 0 {
                return result;
            }
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        size_hint(self.vectors.left(), self.codes.size_hint())
    }
}

impl<C: Codec, I: ExactSizeIterator<Item = C::Code>> ExactSizeIterator for DecodeIter<C, I> {
    fn len(&self) -> usize {
        self.codes.len().saturating_add(self.vectors.left())
    }
}
impl<C: Codec, I: Iterator<Item = C::Code>> FusedIterator for DecodeIter<C, I> {}

impl<C, I: fmt::Debug> fmt::Debug for DecodeIter<C, I> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DecodeIter").field("codes", &self.codes).finish_non_exhaustive()
    }
}
