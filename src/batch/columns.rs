//! What a loop reads and writes, a block at a time.

use super::storage::{CodeBytes, CodeShape};
use crate::simd::stream::Fence;
use crate::simd::{MAX_LANES, Simd};

/// Equally long slices to read.
pub(crate) trait Input: Copy {
    /// One block in lanes.
    type In<V: Simd>: Copy;
    /// The whole blocks that are left.
    type Blocks<V: Simd>;

    fn len(self) -> usize;
    /// The whole blocks, and the rest.
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self);
    /// The next whole block.
    fn load<V: Simd>(blocks: &mut Self::Blocks<V>) -> Option<Self::In<V>>;
    /// Fewer elements than a block, of which the first also fills the other lanes. `None` without any.
    fn load_rest<V: Simd>(self) -> Option<Self::In<V>>;
}

/// Equally long slices to write.
pub(crate) trait Output<'a> {
    /// One block in lanes.
    type In<V: Simd>;
    /// The whole blocks that are left.
    type Blocks<V: Simd>;

    fn len(&self) -> usize;
    /// The whole blocks, and the rest.
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self);
    /// Writes the next whole block.
    fn store<V: Simd>(blocks: &mut Self::Blocks<V>, value: Self::In<V>, fence: &Fence<'a>);
    /// Writes fewer elements than a block.
    fn store_rest<V: Simd>(self, value: Self::In<V>);
}

#[inline(always)]
fn next<'a, B>(blocks: &mut &'a [B]) -> Option<&'a B> {
    let (block, rest) = blocks.split_first()?;
    *blocks = rest;
    Some(block)
}

#[inline(always)]
fn next_mut<'a, B>(blocks: &mut &'a mut [B]) -> Option<&'a mut B> {
    let (block, rest) = core::mem::take(blocks).split_first_mut()?;
    *blocks = rest;
    Some(block)
}

/// A block that begins with `rest`, and otherwise repeats its first element.
#[inline(always)]
fn padded<V: Simd, T: Copy + 'static>(rest: &[T]) -> Option<V::Block<T>> {
    let mut block = V::fill(*rest.first()?);
    for (to, from) in V::elements_mut(&mut block).iter_mut().zip(rest) {
        *to = *from;
    }
    Some(block)
}

/// The first elements of a block.
#[inline(always)]
fn cut<V: Simd, T: Copy + 'static>(block: &V::Block<T>, rest: &mut [T]) {
    for (to, from) in rest.iter_mut().zip(V::elements(block)) {
        *to = *from;
    }
}

/// Components of vectors, a slice each.
impl<'a, const K: usize> Input for [&'a [f32]; K] {
    type In<V: Simd> = [V; K];
    type Blocks<V: Simd> = [&'a [V::Block<f32>]; K];

    #[inline(always)]
    fn len(self) -> usize {
        self.first().map_or(0, |column| column.len())
    }
    #[inline(always)]
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self) {
        (self.map(|column| V::split(column).0), self.map(|column| V::split(column).1))
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: &mut Self::Blocks<V>) -> Option<[V; K]> {
        let mut columns = [V::from(0.0); K];
        for (column, blocks) in columns.iter_mut().zip(blocks) {
            *column = V::load(next(blocks)?);
        }
        Some(columns)
    }
    #[inline(always)]
    fn load_rest<V: Simd>(self) -> Option<[V; K]> {
        let mut columns = [V::from(0.0); K];
        for (column, rest) in columns.iter_mut().zip(self) {
            *column = V::load(&padded::<V, f32>(rest)?);
        }
        Some(columns)
    }
}

impl<'a, const K: usize> Output<'a> for [&'a mut [f32]; K] {
    type In<V: Simd> = [V; K];
    type Blocks<V: Simd> = [&'a mut [V::Block<f32>]; K];

    #[inline(always)]
    fn len(&self) -> usize {
        self.first().map_or(0, |column| column.len())
    }
    #[inline(always)]
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self) {
        let mut rest = [(); K].map(|()| &mut [][..]);
        let mut rests = rest.iter_mut();
        let blocks = self.map(|column| {
            let (blocks, rest) = V::split_mut(column);
            if let Some(to) = rests.next() {
                *to = rest;
            }
            blocks
        });
        (blocks, rest)
    }
    #[inline(always)]
    fn store<V: Simd>(blocks: &mut Self::Blocks<V>, value: [V; K], fence: &Fence<'a>) {
        for (blocks, column) in blocks.iter_mut().zip(value) {
            let Some(block) = next_mut(blocks) else { return };
            if fence.streams() {
                column.stream(block, fence);
            } else {
                column.store(block);
            }
        }
    }
    #[inline(always)]
    fn store_rest<V: Simd>(self, value: [V; K]) {
        for (rest, column) in self.into_iter().zip(value) {
            let mut block = V::fill(0.0);
            column.store(&mut block);
            cut::<V, f32>(&block, rest);
        }
    }
}

/// Codes.
impl<'a, B: CodeBytes> Input for &'a [B] {
    type In<V: Simd> = <B::Shape as CodeShape>::In<V>;
    type Blocks<V: Simd> = &'a [V::Block<B>];

    #[inline(always)]
    fn len(self) -> usize {
        <[B]>::len(self)
    }
    #[inline(always)]
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self) {
        V::split(self)
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: &mut Self::Blocks<V>) -> Option<Self::In<V>> {
        Some(B::load::<V>(next(blocks)?))
    }
    #[inline(always)]
    fn load_rest<V: Simd>(self) -> Option<Self::In<V>> {
        Some(B::load::<V>(&padded::<V, B>(self)?))
    }
}

impl<'a, B: CodeBytes> Output<'a> for &'a mut [B] {
    type In<V: Simd> = <B::Shape as CodeShape>::In<V>;
    type Blocks<V: Simd> = &'a mut [V::Block<B>];

    #[inline(always)]
    fn len(&self) -> usize {
        <[B]>::len(self)
    }
    #[inline(always)]
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self) {
        V::split_mut(self)
    }
    #[inline(always)]
    fn store<V: Simd>(blocks: &mut Self::Blocks<V>, value: Self::In<V>, _: &Fence<'a>) {
        if let Some(block) = next_mut(blocks) {
            B::store::<V>(value, block);
        }
    }
    #[inline(always)]
    fn store_rest<V: Simd>(self, value: Self::In<V>) {
        let mut block = V::fill(B::zeroed());
        B::store::<V>(value, &mut block);
        cut::<V, B>(&block, self);
    }
}

/// Rows of `N` floats in native byte order, of which the first `C` count.
#[derive(Clone, Copy)]
pub(crate) struct Rows<'a, const N: usize, const C: usize>(pub(crate) &'a [[[u8; 4]; N]]);

/// [`Rows`] to write. Their other floats stay as they are.
pub(crate) struct RowsMut<'a, const N: usize, const C: usize>(pub(crate) &'a mut [[[u8; 4]; N]]);

impl<'a, const N: usize, const C: usize> Input for Rows<'a, N, C> {
    type In<V: Simd> = [V; C];
    type Blocks<V: Simd> = &'a [V::Block<[[u8; 4]; N]>];

    #[inline(always)]
    fn len(self) -> usize {
        self.0.len()
    }
    #[inline(always)]
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self) {
        let (blocks, rest) = V::split(self.0);
        (blocks, Rows(rest))
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: &mut Self::Blocks<V>) -> Option<[V; C]> {
        Some(V::load_rows(next(blocks)?))
    }
    #[inline(always)]
    fn load_rest<V: Simd>(self) -> Option<[V; C]> {
        Some(V::load_rows(&padded::<V, [[u8; 4]; N]>(self.0)?))
    }
}

impl<'a, const N: usize, const C: usize> Output<'a> for RowsMut<'a, N, C> {
    type In<V: Simd> = [V; C];
    type Blocks<V: Simd> = &'a mut [V::Block<[[u8; 4]; N]>];

    #[inline(always)]
    fn len(&self) -> usize {
        self.0.len()
    }
    #[inline(always)]
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self) {
        let (blocks, rest) = V::split_mut(self.0);
        (blocks, RowsMut(rest))
    }
    #[inline(always)]
    fn store<V: Simd>(blocks: &mut Self::Blocks<V>, value: [V; C], _: &Fence<'a>) {
        if let Some(block) = next_mut(blocks) {
            V::store_rows(value, block);
        }
    }
    #[inline(always)]
    fn store_rest<V: Simd>(self, value: [V; C]) {
        if let Some(mut block) = padded::<V, [[u8; 4]; N]>(self.0) {
            V::store_rows(value, &mut block);
            cut::<V, [[u8; 4]; N]>(&block, self.0);
        }
    }
}

/// The numbers from `first` on, as many as are asked for; after 2^32 - 1 comes 0.
#[derive(Clone, Copy)]
pub(crate) struct Indices {
    pub(crate) first: u32,
    pub(crate) len: usize,
}

impl Input for Indices {
    type In<V: Simd> = V::Int;
    type Blocks<V: Simd> = Self;

    #[inline(always)]
    fn len(self) -> usize {
        self.len
    }
    #[inline(always)]
    fn split<V: Simd>(self) -> (Self, Self) {
        let rest = self.len % V::LANES;
        let whole = self.len - rest;
        let first = self.first.wrapping_add(whole as u32);
        (Indices { first: self.first, len: whole }, Indices { first, len: rest })
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: &mut Self) -> Option<V::Int> {
        let indices = blocks.load_rest::<V>();
        blocks.first = blocks.first.wrapping_add(V::LANES as u32);
        indices
    }
    #[inline(always)]
    fn load_rest<V: Simd>(self) -> Option<V::Int> {
        const LANES: [u32; MAX_LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        let (blocks, _) = V::split(&LANES);
        Some(V::load_int(blocks.first()?, |lane| lane) + self.first as i32)
    }
}

impl<A: Input, B: Input> Input for (A, B) {
    type In<V: Simd> = (A::In<V>, B::In<V>);
    type Blocks<V: Simd> = (A::Blocks<V>, B::Blocks<V>);

    #[inline(always)]
    fn len(self) -> usize {
        self.0.len()
    }
    #[inline(always)]
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self) {
        let ((a, rest_a), (b, rest_b)) = (self.0.split::<V>(), self.1.split::<V>());
        ((a, b), (rest_a, rest_b))
    }
    #[inline(always)]
    fn load<V: Simd>((a, b): &mut Self::Blocks<V>) -> Option<Self::In<V>> {
        Some((A::load::<V>(a)?, B::load::<V>(b)?))
    }
    #[inline(always)]
    fn load_rest<V: Simd>(self) -> Option<Self::In<V>> {
        Some((self.0.load_rest::<V>()?, self.1.load_rest::<V>()?))
    }
}

impl<'a, A: Output<'a>, B: Output<'a>> Output<'a> for (A, B) {
    type In<V: Simd> = (A::In<V>, B::In<V>);
    type Blocks<V: Simd> = (A::Blocks<V>, B::Blocks<V>);

    #[inline(always)]
    fn len(&self) -> usize {
        self.0.len()
    }
    #[inline(always)]
    fn split<V: Simd>(self) -> (Self::Blocks<V>, Self) {
        let ((a, rest_a), (b, rest_b)) = (self.0.split::<V>(), self.1.split::<V>());
        ((a, b), (rest_a, rest_b))
    }
    #[inline(always)]
    fn store<V: Simd>((a, b): &mut Self::Blocks<V>, value: Self::In<V>, fence: &Fence<'a>) {
        A::store::<V>(a, value.0, fence);
        B::store::<V>(b, value.1, fence);
    }
    #[inline(always)]
    fn store_rest<V: Simd>(self, value: Self::In<V>) {
        self.0.store_rest::<V>(value.0);
        self.1.store_rest::<V>(value.1);
    }
}
