//! What a loop reads and writes, a block at a time.

use core::marker::PhantomData;
use core::slice;

use super::storage::{CodeKind, CodeSlice, CodeSliceMut, MAX_CODE, ShapeIn, copy};
use crate::simd::{MAX_LANES, Simd};

/// A kind of slices to read, all equally long.
pub(crate) trait Input: 'static {
    /// The slices.
    type Slices<'a>: Copy;
    /// Whole blocks of them.
    type Blocks<'a, V: Simd>: Copy;
    /// One block of its own.
    type Block<V: Simd>;
    /// One block in lanes.
    type In<V: Simd>: Copy;

    fn len(slices: Self::Slices<'_>) -> usize;
    /// The whole blocks, of which there are `count`, and the rest. `None` if lengths differ.
    fn split<'a, V: Simd>(
        slices: Self::Slices<'a>,
        count: usize,
    ) -> Option<(Self::Blocks<'a, V>, Self::Slices<'a>)>;
    /// A block that begins with the elements, fewer than that, and repeats the first of them. `None`
    /// without any.
    fn pad<V: Simd>(rest: Self::Slices<'_>) -> Option<Self::Block<V>>;
    fn as_blocks<V: Simd>(block: &Self::Block<V>) -> Self::Blocks<'_, V>;
    /// Block `i`.
    fn load<V: Simd>(blocks: Self::Blocks<'_, V>, i: usize) -> Option<Self::In<V>>;
}

/// A kind of slices to write, all equally long.
pub(crate) trait Output: 'static {
    /// The slices.
    type Slices<'a>;
    /// Whole blocks of them.
    type Blocks<'a, V: Simd>;
    /// One block of its own.
    type Block<V: Simd>;
    /// One block in lanes.
    type In<V: Simd>;

    /// The whole blocks, of which there are `count`, and the rest. `None` if lengths differ.
    fn split<'a, V: Simd>(
        slices: Self::Slices<'a>,
        count: usize,
    ) -> Option<(Self::Blocks<'a, V>, Self::Slices<'a>)>;
    /// A block with room for the elements, fewer than that. It holds what they keep.
    fn pad<V: Simd>(rest: &Self::Slices<'_>) -> Self::Block<V>;
    fn as_blocks<V: Simd>(block: &mut Self::Block<V>) -> Self::Blocks<'_, V>;
    /// Copies the first elements of a block to `rest`.
    fn cut<V: Simd>(block: &Self::Block<V>, rest: Self::Slices<'_>);
    /// Writes block `i`, past the caches if `streams`.
    fn store<V: Simd>(
        blocks: &mut Self::Blocks<'_, V>,
        i: usize,
        value: Self::In<V>,
        streams: bool,
    );
}

/// `blocks`, if there are `count`. Then the compiler knows that indices below it are in bounds.
fn counted<B>(blocks: &[B], count: usize) -> Option<&[B]> {
    if blocks.len() == count { Some(blocks) } else { None }
}

/// [`counted`] to write.
fn counted_mut<B>(blocks: &mut [B], count: usize) -> Option<&mut [B]> {
    if blocks.len() == count { Some(blocks) } else { None }
}

/// A block that begins with `rest`, and otherwise repeats its first element.
fn padded<V: Simd, T: Copy + 'static>(rest: &[T]) -> Option<V::Block<T>> {
    let mut block = V::fill(*rest.first()?);
    for (to, from) in V::elements_mut(&mut block).iter_mut().zip(rest) {
        *to = *from;
    }
    Some(block)
}

/// The first elements of a block.
fn cut<V: Simd, T: Copy + 'static>(block: &V::Block<T>, rest: &mut [T]) {
    for (to, from) in rest.iter_mut().zip(V::elements(block)) {
        *to = *from;
    }
}

/// `K` components of vectors, a slice each.
pub(crate) struct Columns<const K: usize>;

impl<const K: usize> Input for Columns<K> {
    type Slices<'a> = [&'a [f32]; K];
    type Blocks<'a, V: Simd> = [&'a [V::Block<f32>]; K];
    type Block<V: Simd> = [V::Block<f32>; K];
    type In<V: Simd> = [V; K];

    fn len(slices: [&[f32]; K]) -> usize {
        slices.first().map_or(0, |column| column.len())
    }
    fn split<'a, V: Simd>(
        slices: <Self as Input>::Slices<'a>,
        count: usize,
    ) -> Option<(<Self as Input>::Blocks<'a, V>, <Self as Input>::Slices<'a>)> {
        let (mut all, mut rests) = ([&[][..]; K], [&[][..]; K]);
        for ((column, all), rest) in slices.into_iter().zip(&mut all).zip(&mut rests) {
            let (blocks, others) = V::split(column);
            (*all, *rest) = (counted(blocks, count)?, others);
        }
        Some((all, rests))
    }
    fn pad<V: Simd>(rest: [&[f32]; K]) -> Option<[V::Block<f32>; K]> {
        let mut blocks = [V::fill(0.0); K];
        for (block, rest) in blocks.iter_mut().zip(rest) {
            *block = padded::<V, f32>(rest)?;
        }
        Some(blocks)
    }
    fn as_blocks<V: Simd>(block: &[V::Block<f32>; K]) -> [&[V::Block<f32>]; K] {
        block.each_ref().map(slice::from_ref)
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: [&[V::Block<f32>]; K], i: usize) -> Option<[V; K]> {
        let mut columns = [V::from(0.0); K];
        for (column, blocks) in columns.iter_mut().zip(blocks) {
            *column = V::load(blocks.get(i)?);
        }
        Some(columns)
    }
}

impl<const K: usize> Output for Columns<K> {
    type Slices<'a> = [&'a mut [f32]; K];
    type Blocks<'a, V: Simd> = [&'a mut [V::Block<f32>]; K];
    type Block<V: Simd> = [V::Block<f32>; K];
    type In<V: Simd> = [V; K];

    fn split<'a, V: Simd>(
        slices: <Self as Output>::Slices<'a>,
        count: usize,
    ) -> Option<(<Self as Output>::Blocks<'a, V>, <Self as Output>::Slices<'a>)> {
        let mut all = [(); K].map(|()| &mut [][..]);
        let mut rests = [(); K].map(|()| &mut [][..]);
        for ((column, all), rest) in slices.into_iter().zip(&mut all).zip(&mut rests) {
            let (blocks, others) = V::split_mut(column);
            (*all, *rest) = (counted_mut(blocks, count)?, others);
        }
        Some((all, rests))
    }
    fn pad<V: Simd>(_: &[&mut [f32]; K]) -> [V::Block<f32>; K] {
        [V::fill(0.0); K]
    }
    fn as_blocks<V: Simd>(block: &mut [V::Block<f32>; K]) -> [&mut [V::Block<f32>]; K] {
        block.each_mut().map(slice::from_mut)
    }
    fn cut<V: Simd>(block: &[V::Block<f32>; K], rest: [&mut [f32]; K]) {
        for (block, rest) in block.iter().zip(rest) {
            cut::<V, f32>(block, rest);
        }
    }
    #[inline(always)]
    fn store<V: Simd>(
        blocks: &mut [&mut [V::Block<f32>]; K],
        i: usize,
        value: [V; K],
        streams: bool,
    ) {
        for (blocks, column) in blocks.iter_mut().zip(value) {
            let Some(block) = blocks.get_mut(i) else { return };
            if streams {
                column.stream(block);
            } else {
                column.store(block);
            }
        }
    }
}

/// Codes in a slice of bytes.
pub(crate) struct CodeColumn<K>(PhantomData<K>);

/// A block of codes of its own.
pub(crate) struct CodeBlock {
    bytes: [u8; MAX_CODE * MAX_LANES],
    size: usize,
}

impl CodeBlock {
    fn new(size: usize) -> Self {
        CodeBlock { bytes: [0; MAX_CODE * MAX_LANES], size }
    }
}

impl<K: CodeKind> Input for CodeColumn<K> {
    type Slices<'a> = CodeSlice<'a>;
    type Blocks<'a, V: Simd> = CodeSlice<'a>;
    type Block<V: Simd> = CodeBlock;
    type In<V: Simd> = ShapeIn<K::Shape, V>;

    fn len(codes: CodeSlice<'_>) -> usize {
        codes.bytes.len().checked_div(codes.size).unwrap_or(0)
    }
    fn split<'a, V: Simd>(
        codes: <Self as Input>::Slices<'a>,
        count: usize,
    ) -> Option<(<Self as Input>::Blocks<'a, V>, <Self as Input>::Slices<'a>)> {
        let (blocks, rest) = codes.bytes.split_at_checked(count * V::LANES * codes.size)?;
        Some((CodeSlice { bytes: blocks, ..codes }, CodeSlice { bytes: rest, ..codes }))
    }
    fn pad<V: Simd>(rest: CodeSlice<'_>) -> Option<CodeBlock> {
        let mut block = CodeBlock::new(rest.size);
        for (to, from) in block.bytes.chunks_mut(rest.size).zip(rest.bytes.chunks(rest.size)) {
            copy(from, to);
        }
        Some(block)
    }
    fn as_blocks<V: Simd>(block: &CodeBlock) -> CodeSlice<'_> {
        CodeSlice { bytes: &block.bytes, size: block.size }
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: CodeSlice<'_>, i: usize) -> Option<ShapeIn<K::Shape, V>> {
        K::load::<V>(blocks, i)
    }
}

impl<K: CodeKind> Output for CodeColumn<K> {
    type Slices<'a> = CodeSliceMut<'a>;
    type Blocks<'a, V: Simd> = CodeSliceMut<'a>;
    type Block<V: Simd> = CodeBlock;
    type In<V: Simd> = ShapeIn<K::Shape, V>;

    fn split<'a, V: Simd>(
        codes: <Self as Output>::Slices<'a>,
        count: usize,
    ) -> Option<(<Self as Output>::Blocks<'a, V>, <Self as Output>::Slices<'a>)> {
        let CodeSliceMut { bytes, size } = codes;
        let (blocks, rest) = bytes.split_at_mut_checked(count * V::LANES * size)?;
        Some((CodeSliceMut { bytes: blocks, size }, CodeSliceMut { bytes: rest, size }))
    }
    fn pad<V: Simd>(rest: &CodeSliceMut<'_>) -> CodeBlock {
        CodeBlock::new(rest.size)
    }
    fn as_blocks<V: Simd>(block: &mut CodeBlock) -> CodeSliceMut<'_> {
        CodeSliceMut { bytes: &mut block.bytes, size: block.size }
    }
    fn cut<V: Simd>(block: &CodeBlock, rest: CodeSliceMut<'_>) {
        copy(&block.bytes, rest.bytes);
    }
    #[inline(always)]
    fn store<V: Simd>(
        blocks: &mut CodeSliceMut<'_>,
        i: usize,
        code: ShapeIn<K::Shape, V>,
        _: bool,
    ) {
        K::store::<V>(code, blocks, i);
    }
}

/// Rows of `N` floats in native byte order, of which the first `C` count. The others keep what they
/// hold.
pub(crate) struct Rows<const N: usize, const C: usize>;

/// A row as its bytes.
type Row<const N: usize> = [[u8; 4]; N];

impl<const N: usize, const C: usize> Input for Rows<N, C> {
    type Slices<'a> = &'a [Row<N>];
    type Blocks<'a, V: Simd> = &'a [V::Block<Row<N>>];
    type Block<V: Simd> = V::Block<Row<N>>;
    type In<V: Simd> = [V; C];

    fn len(rows: &[Row<N>]) -> usize {
        rows.len()
    }
    fn split<'a, V: Simd>(
        rows: <Self as Input>::Slices<'a>,
        count: usize,
    ) -> Option<(<Self as Input>::Blocks<'a, V>, <Self as Input>::Slices<'a>)> {
        let (blocks, rest) = V::split(rows);
        Some((counted(blocks, count)?, rest))
    }
    fn pad<V: Simd>(rest: &[Row<N>]) -> Option<V::Block<Row<N>>> {
        padded::<V, _>(rest)
    }
    fn as_blocks<V: Simd>(block: &V::Block<Row<N>>) -> &[V::Block<Row<N>>] {
        slice::from_ref(block)
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: &[V::Block<Row<N>>], i: usize) -> Option<[V; C]> {
        Some(V::load_rows(blocks.get(i)?))
    }
}

impl<const N: usize, const C: usize> Output for Rows<N, C> {
    type Slices<'a> = &'a mut [Row<N>];
    type Blocks<'a, V: Simd> = &'a mut [V::Block<Row<N>>];
    type Block<V: Simd> = V::Block<Row<N>>;
    type In<V: Simd> = [V; C];

    fn split<'a, V: Simd>(
        rows: <Self as Output>::Slices<'a>,
        count: usize,
    ) -> Option<(<Self as Output>::Blocks<'a, V>, <Self as Output>::Slices<'a>)> {
        let (blocks, rest) = V::split_mut(rows);
        Some((counted_mut(blocks, count)?, rest))
    }
    fn pad<V: Simd>(rest: &&mut [Row<N>]) -> V::Block<Row<N>> {
        padded::<V, _>(rest).unwrap_or(V::fill([[0; 4]; N]))
    }
    fn as_blocks<V: Simd>(block: &mut V::Block<Row<N>>) -> &mut [V::Block<Row<N>>] {
        slice::from_mut(block)
    }
    fn cut<V: Simd>(block: &V::Block<Row<N>>, rest: &mut [Row<N>]) {
        cut::<V, _>(block, rest);
    }
    #[inline(always)]
    fn store<V: Simd>(blocks: &mut &mut [V::Block<Row<N>>], i: usize, value: [V; C], _: bool) {
        if let Some(block) = blocks.get_mut(i) {
            V::store_rows(value, block);
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
    type Slices<'a> = Self;
    type Blocks<'a, V: Simd> = Self;
    type Block<V: Simd> = Self;
    type In<V: Simd> = V::Int;

    fn len(indices: Self) -> usize {
        indices.len
    }
    fn split<'a, V: Simd>(
        indices: <Self as Input>::Slices<'a>,
        count: usize,
    ) -> Option<(<Self as Input>::Blocks<'a, V>, <Self as Input>::Slices<'a>)> {
        let first = indices.first.wrapping_add((count * V::LANES) as u32);
        Some((indices, Indices { first, len: indices.len % V::LANES }))
    }
    fn pad<V: Simd>(rest: Self) -> Option<Self> {
        Some(rest)
    }
    fn as_blocks<V: Simd>(block: &Self) -> Self {
        *block
    }
    #[inline(always)]
    fn load<V: Simd>(indices: Self, i: usize) -> Option<V::Int> {
        const LANES: [u32; MAX_LANES] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        let lanes = V::load_int(V::split(&LANES).0.first()?, |lane| lane);
        Some(lanes + indices.first.wrapping_add((i * V::LANES) as u32) as i32)
    }
}

impl<A: Input, B: Input> Input for (A, B) {
    type Slices<'a> = (A::Slices<'a>, B::Slices<'a>);
    type Blocks<'a, V: Simd> = (A::Blocks<'a, V>, B::Blocks<'a, V>);
    type Block<V: Simd> = (A::Block<V>, B::Block<V>);
    type In<V: Simd> = (A::In<V>, B::In<V>);

    fn len((a, _): Self::Slices<'_>) -> usize {
        A::len(a)
    }
    fn split<'a, V: Simd>(
        (a, b): <Self as Input>::Slices<'a>,
        count: usize,
    ) -> Option<(<Self as Input>::Blocks<'a, V>, <Self as Input>::Slices<'a>)> {
        let ((a, rest_a), (b, rest_b)) = (A::split::<V>(a, count)?, B::split::<V>(b, count)?);
        Some(((a, b), (rest_a, rest_b)))
    }
    fn pad<V: Simd>((a, b): Self::Slices<'_>) -> Option<Self::Block<V>> {
        Some((A::pad::<V>(a)?, B::pad::<V>(b)?))
    }
    fn as_blocks<V: Simd>((a, b): &Self::Block<V>) -> Self::Blocks<'_, V> {
        (A::as_blocks::<V>(a), B::as_blocks::<V>(b))
    }
    #[inline(always)]
    fn load<V: Simd>((a, b): Self::Blocks<'_, V>, i: usize) -> Option<Self::In<V>> {
        Some((A::load::<V>(a, i)?, B::load::<V>(b, i)?))
    }
}

impl<A: Output, B: Output> Output for (A, B) {
    type Slices<'a> = (A::Slices<'a>, B::Slices<'a>);
    type Blocks<'a, V: Simd> = (A::Blocks<'a, V>, B::Blocks<'a, V>);
    type Block<V: Simd> = (A::Block<V>, B::Block<V>);
    type In<V: Simd> = (A::In<V>, B::In<V>);

    fn split<'a, V: Simd>(
        (a, b): <Self as Output>::Slices<'a>,
        count: usize,
    ) -> Option<(<Self as Output>::Blocks<'a, V>, <Self as Output>::Slices<'a>)> {
        let ((a, rest_a), (b, rest_b)) = (A::split::<V>(a, count)?, B::split::<V>(b, count)?);
        Some(((a, b), (rest_a, rest_b)))
    }
    fn pad<V: Simd>((a, b): &Self::Slices<'_>) -> Self::Block<V> {
        (A::pad::<V>(a), B::pad::<V>(b))
    }
    fn as_blocks<V: Simd>((a, b): &mut Self::Block<V>) -> Self::Blocks<'_, V> {
        (A::as_blocks::<V>(a), B::as_blocks::<V>(b))
    }
    fn cut<V: Simd>((a, b): &Self::Block<V>, (rest_a, rest_b): Self::Slices<'_>) {
        A::cut::<V>(a, rest_a);
        B::cut::<V>(b, rest_b);
    }
    #[inline(always)]
    fn store<V: Simd>(
        (a, b): &mut Self::Blocks<'_, V>,
        i: usize,
        value: Self::In<V>,
        streams: bool,
    ) {
        A::store::<V>(a, i, value.0, streams);
        B::store::<V>(b, i, value.1, streams);
    }
}
