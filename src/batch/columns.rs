//! What a loop reads and writes: kinds of slices, of which it takes a block at a time.

use core::marker::PhantomData;

use super::storage::{
    CodeKind, CodeSlice, CodeSliceMut, MAX_CODE, ShapeIn, blocks, blocks_mut, copy,
};
use crate::simd::{MAX_LANES, Simd};

/// A kind of slices to read, all equally long.
pub(crate) trait Input: 'static {
    /// The slices.
    type Slices<'a>: Copy;
    /// Whole blocks of them.
    type Blocks<'a, V: Simd>: Copy;
    /// Room for one block.
    type Buffer;
    /// One block in lanes.
    type In<V: Simd>: Copy;

    fn len(slices: Self::Slices<'_>) -> usize;
    /// The first `at` elements, and the others. `None` if there are fewer.
    fn split<'a>(
        slices: Self::Slices<'a>,
        at: usize,
    ) -> Option<(Self::Slices<'a>, Self::Slices<'a>)>;
    /// The elements, repeated until there is one for each lane.
    fn pad(slices: Self::Slices<'_>, lanes: usize) -> Self::Buffer;
    /// The first `len` elements of a buffer.
    fn slices(buffer: &Self::Buffer, len: usize) -> Option<Self::Slices<'_>>;
    /// The slices as `count` blocks: then the compiler knows that indices below it are in bounds.
    fn blocks<'a, V: Simd>(slices: Self::Slices<'a>, count: usize) -> Option<Self::Blocks<'a, V>>;
    /// Block `i`.
    fn load<V: Simd>(blocks: Self::Blocks<'_, V>, i: usize) -> Option<Self::In<V>>;
}

/// A kind of slices to write, all equally long.
pub(crate) trait Output: 'static {
    /// The slices.
    type Slices<'a>;
    /// Whole blocks of them.
    type Blocks<'a, V: Simd>;
    /// Room for one block.
    type Buffer;
    /// One block in lanes.
    type In<V: Simd>;

    /// The first `at` elements, and the others. `None` if there are fewer.
    fn split<'a>(
        slices: Self::Slices<'a>,
        at: usize,
    ) -> Option<(Self::Slices<'a>, Self::Slices<'a>)>;
    /// A buffer that begins with the elements, if those keep anything.
    fn pad(slices: &Self::Slices<'_>) -> Self::Buffer;
    /// The first `len` elements of a buffer.
    fn slices(buffer: &mut Self::Buffer, len: usize) -> Option<Self::Slices<'_>>;
    /// Copies the first elements of a buffer.
    fn cut(buffer: &Self::Buffer, slices: Self::Slices<'_>);
    /// The slices as `count` blocks: then the compiler knows that indices below it are in bounds.
    fn blocks<'a, V: Simd>(slices: Self::Slices<'a>, count: usize) -> Option<Self::Blocks<'a, V>>;
    /// Writes block `i`, past the caches if `streams`.
    fn store<V: Simd>(
        blocks: &mut Self::Blocks<'_, V>,
        i: usize,
        value: Self::In<V>,
        streams: bool,
    );
}

/// `K` components of vectors, a slice each.
pub(crate) struct Columns<const K: usize>;

impl<const K: usize> Input for Columns<K> {
    type Slices<'a> = [&'a [f32]; K];
    type Blocks<'a, V: Simd> = [&'a [V::Block<f32>]; K];
    type Buffer = [[f32; MAX_LANES]; K];
    type In<V: Simd> = [V; K];

    fn len(slices: [&[f32]; K]) -> usize {
        slices.first().map_or(0, |column| column.len())
    }
    fn split<'a>(
        slices: <Self as Input>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Input>::Slices<'a>, <Self as Input>::Slices<'a>)> {
        let (mut first, mut others) = ([&[][..]; K], [&[][..]; K]);
        for ((column, first), others) in slices.into_iter().zip(&mut first).zip(&mut others) {
            (*first, *others) = column.split_at_checked(at)?;
        }
        Some((first, others))
    }
    fn pad(slices: [&[f32]; K], lanes: usize) -> [[f32; MAX_LANES]; K] {
        let mut buffer = [[0.0; MAX_LANES]; K];
        for (to, from) in buffer.iter_mut().zip(slices) {
            repeat(from, to, lanes);
        }
        buffer
    }
    fn slices(buffer: &[[f32; MAX_LANES]; K], len: usize) -> Option<[&[f32]; K]> {
        let mut slices = [&[][..]; K];
        for (slice, column) in slices.iter_mut().zip(buffer) {
            *slice = column.get(..len)?;
        }
        Some(slices)
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        slices: <Self as Input>::Slices<'a>,
        count: usize,
    ) -> Option<<Self as Input>::Blocks<'a, V>> {
        let mut all = [&[][..]; K];
        for (all, column) in all.iter_mut().zip(slices) {
            *all = blocks::<V, f32>(column, count)?;
        }
        Some(all)
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
    type Buffer = [[f32; MAX_LANES]; K];
    type In<V: Simd> = [V; K];

    fn split<'a>(
        slices: <Self as Output>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Output>::Slices<'a>, <Self as Output>::Slices<'a>)> {
        let (mut first, mut others) = (empty(), empty());
        for ((column, first), others) in slices.into_iter().zip(&mut first).zip(&mut others) {
            (*first, *others) = column.split_at_mut_checked(at)?;
        }
        Some((first, others))
    }
    fn pad(_: &[&mut [f32]; K]) -> [[f32; MAX_LANES]; K] {
        [[0.0; MAX_LANES]; K]
    }
    fn slices(buffer: &mut [[f32; MAX_LANES]; K], len: usize) -> Option<[&mut [f32]; K]> {
        let mut slices = empty();
        for (slice, column) in slices.iter_mut().zip(buffer) {
            *slice = column.get_mut(..len)?;
        }
        Some(slices)
    }
    fn cut(buffer: &[[f32; MAX_LANES]; K], slices: [&mut [f32]; K]) {
        for (from, to) in buffer.iter().zip(slices) {
            copy(from, to);
        }
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        slices: <Self as Output>::Slices<'a>,
        count: usize,
    ) -> Option<<Self as Output>::Blocks<'a, V>> {
        let mut all = empty();
        for (all, column) in all.iter_mut().zip(slices) {
            *all = blocks_mut::<V, f32>(column, count)?;
        }
        Some(all)
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

/// Columns without elements.
#[inline(always)]
pub(crate) fn empty<'a, T, const K: usize>() -> [&'a mut [T]; K] {
    [(); K].map(|()| &mut [][..])
}

/// Codes in a slice of bytes.
pub(crate) struct CodeColumn<K>(PhantomData<K>);

/// Room for a block of codes.
pub(crate) struct CodeBuffer {
    bytes: [u8; MAX_CODE * MAX_LANES],
    size: usize,
}

impl<K: CodeKind> Input for CodeColumn<K> {
    type Slices<'a> = CodeSlice<'a>;
    type Blocks<'a, V: Simd> = K::Blocks<'a, V>;
    type Buffer = CodeBuffer;
    type In<V: Simd> = ShapeIn<K::Shape, V>;

    fn len(codes: CodeSlice<'_>) -> usize {
        codes.len()
    }
    fn split<'a>(
        codes: <Self as Input>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Input>::Slices<'a>, <Self as Input>::Slices<'a>)> {
        codes.split_at(at)
    }
    fn pad(codes: CodeSlice<'_>, lanes: usize) -> CodeBuffer {
        let mut buffer = CodeBuffer { bytes: [0; MAX_CODE * MAX_LANES], size: codes.size };
        repeat(codes.bytes, &mut buffer.bytes, lanes * codes.size);
        buffer
    }
    fn slices(buffer: &CodeBuffer, len: usize) -> Option<CodeSlice<'_>> {
        let CodeBuffer { ref bytes, size } = *buffer;
        Some(CodeSlice { bytes: bytes.get(..len * size)?, size })
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        codes: <Self as Input>::Slices<'a>,
        count: usize,
    ) -> Option<<Self as Input>::Blocks<'a, V>> {
        K::blocks::<V>(codes, count)
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: K::Blocks<'_, V>, i: usize) -> Option<ShapeIn<K::Shape, V>> {
        K::load::<V>(blocks, i)
    }
}

impl<K: CodeKind> Output for CodeColumn<K> {
    type Slices<'a> = CodeSliceMut<'a>;
    type Blocks<'a, V: Simd> = K::BlocksMut<'a, V>;
    type Buffer = CodeBuffer;
    type In<V: Simd> = ShapeIn<K::Shape, V>;

    fn split<'a>(
        codes: <Self as Output>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Output>::Slices<'a>, <Self as Output>::Slices<'a>)> {
        let CodeSliceMut { bytes, size } = codes;
        let (first, others) = bytes.split_at_mut_checked(at * size)?;
        Some((CodeSliceMut { bytes: first, size }, CodeSliceMut { bytes: others, size }))
    }
    fn pad(codes: &CodeSliceMut<'_>) -> CodeBuffer {
        CodeBuffer { bytes: [0; MAX_CODE * MAX_LANES], size: codes.size }
    }
    fn slices(buffer: &mut CodeBuffer, len: usize) -> Option<CodeSliceMut<'_>> {
        let CodeBuffer { ref mut bytes, size } = *buffer;
        Some(CodeSliceMut { bytes: bytes.get_mut(..len * size)?, size })
    }
    fn cut(buffer: &CodeBuffer, codes: CodeSliceMut<'_>) {
        copy(&buffer.bytes, codes.bytes);
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        codes: <Self as Output>::Slices<'a>,
        count: usize,
    ) -> Option<<Self as Output>::Blocks<'a, V>> {
        K::blocks_mut::<V>(codes, count)
    }
    #[inline(always)]
    fn store<V: Simd>(
        blocks: &mut K::BlocksMut<'_, V>,
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
    type Buffer = [Row<N>; MAX_LANES];
    type In<V: Simd> = [V; C];

    fn len(rows: &[Row<N>]) -> usize {
        rows.len()
    }
    fn split<'a>(
        rows: <Self as Input>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Input>::Slices<'a>, <Self as Input>::Slices<'a>)> {
        rows.split_at_checked(at)
    }
    fn pad(rows: &[Row<N>], lanes: usize) -> [Row<N>; MAX_LANES] {
        let mut buffer = [[[0; 4]; N]; MAX_LANES];
        repeat(rows, &mut buffer, lanes);
        buffer
    }
    fn slices(buffer: &[Row<N>; MAX_LANES], len: usize) -> Option<&[Row<N>]> {
        buffer.get(..len)
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        rows: <Self as Input>::Slices<'a>,
        count: usize,
    ) -> Option<<Self as Input>::Blocks<'a, V>> {
        blocks::<V, _>(rows, count)
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: &[V::Block<Row<N>>], i: usize) -> Option<[V; C]> {
        Some(V::load_rows(blocks.get(i)?))
    }
}

impl<const N: usize, const C: usize> Output for Rows<N, C> {
    type Slices<'a> = &'a mut [Row<N>];
    type Blocks<'a, V: Simd> = &'a mut [V::Block<Row<N>>];
    type Buffer = [Row<N>; MAX_LANES];
    type In<V: Simd> = [V; C];

    fn split<'a>(
        rows: <Self as Output>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Output>::Slices<'a>, <Self as Output>::Slices<'a>)> {
        rows.split_at_mut_checked(at)
    }
    fn pad(rows: &&mut [Row<N>]) -> [Row<N>; MAX_LANES] {
        <Self as Input>::pad(rows, rows.len())
    }
    fn slices(buffer: &mut [Row<N>; MAX_LANES], len: usize) -> Option<&mut [Row<N>]> {
        buffer.get_mut(..len)
    }
    fn cut(buffer: &[Row<N>; MAX_LANES], rows: &mut [Row<N>]) {
        copy(buffer, rows);
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        rows: <Self as Output>::Slices<'a>,
        count: usize,
    ) -> Option<<Self as Output>::Blocks<'a, V>> {
        blocks_mut::<V, _>(rows, count)
    }
    #[inline(always)]
    fn store<V: Simd>(blocks: &mut &mut [V::Block<Row<N>>], i: usize, value: [V; C], _: bool) {
        if let Some(block) = blocks.get_mut(i) {
            V::store_rows(value, block);
        }
    }
}

/// Rows of `C` floats in native byte order, one every `stride` bytes, at least [`QUAD`]. What lies
/// between keeps what it holds.
pub(crate) struct Strided<const C: usize>;

/// Size in bytes of what is loaded or stored of a row at once.
pub(super) const QUAD: usize = 16;

/// Whole rows.
#[derive(Clone, Copy)]
pub(crate) struct RowSlice<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) stride: usize,
}

/// [`RowSlice`] to write.
pub(crate) struct RowSliceMut<'a> {
    pub(crate) bytes: &'a mut [u8],
    pub(crate) stride: usize,
}

impl<const C: usize> Input for Strided<C> {
    type Slices<'a> = RowSlice<'a>;
    type Blocks<'a, V: Simd> = RowSlice<'a>;
    type Buffer = [u8; QUAD * MAX_LANES];
    type In<V: Simd> = [V; C];

    fn len(rows: RowSlice<'_>) -> usize {
        rows.bytes.len().checked_div(rows.stride).unwrap_or(0)
    }
    fn split<'a>(
        rows: <Self as Input>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Input>::Slices<'a>, <Self as Input>::Slices<'a>)> {
        let (first, others) = rows.bytes.split_at_checked(at * rows.stride)?;
        Some((RowSlice { bytes: first, ..rows }, RowSlice { bytes: others, ..rows }))
    }
    fn pad(rows: RowSlice<'_>, _: usize) -> [u8; QUAD * MAX_LANES] {
        let mut buffer = [0; QUAD * MAX_LANES];
        let rows = rows.bytes.chunks(rows.stride.max(1));
        for (to, from) in buffer.chunks_mut(QUAD).zip(rows) {
            copy(from, to);
        }
        buffer
    }
    fn slices(buffer: &[u8; QUAD * MAX_LANES], len: usize) -> Option<RowSlice<'_>> {
        Some(RowSlice { bytes: buffer.get(..QUAD * len)?, stride: QUAD })
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        rows: <Self as Input>::Slices<'a>,
        _: usize,
    ) -> Option<<Self as Input>::Blocks<'a, V>> {
        (rows.stride >= QUAD).then_some(rows)
    }
    #[inline(always)]
    fn load<V: Simd>(rows: RowSlice<'_>, i: usize) -> Option<[V; C]> {
        let mut rest = rows.bytes.get(i * V::LANES * rows.stride..)?;
        V::load_quads(
            #[inline(always)]
            || {
                let (row, others) = rest.split_at_checked(rows.stride)?;
                rest = others;
                row.first_chunk()
            },
        )
    }
}

impl<const C: usize> Output for Strided<C> {
    type Slices<'a> = RowSliceMut<'a>;
    type Blocks<'a, V: Simd> = RowSliceMut<'a>;
    type Buffer = [u8; QUAD * MAX_LANES];
    type In<V: Simd> = [V; C];

    fn split<'a>(
        rows: <Self as Output>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Output>::Slices<'a>, <Self as Output>::Slices<'a>)> {
        let RowSliceMut { bytes, stride } = rows;
        let (first, others) = bytes.split_at_mut_checked(at * stride)?;
        Some((RowSliceMut { bytes: first, stride }, RowSliceMut { bytes: others, stride }))
    }
    fn pad(_: &RowSliceMut<'_>) -> [u8; QUAD * MAX_LANES] {
        [0; QUAD * MAX_LANES]
    }
    fn slices(buffer: &mut [u8; QUAD * MAX_LANES], len: usize) -> Option<RowSliceMut<'_>> {
        Some(RowSliceMut { bytes: buffer.get_mut(..QUAD * len)?, stride: QUAD })
    }
    fn cut(buffer: &[u8; QUAD * MAX_LANES], rows: RowSliceMut<'_>) {
        let rows = rows.bytes.chunks_mut(rows.stride.max(1));
        for (from, to) in buffer.chunks(QUAD).zip(rows) {
            copy(from.get(..4 * C).unwrap_or_default(), to);
        }
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        rows: <Self as Output>::Slices<'a>,
        _: usize,
    ) -> Option<<Self as Output>::Blocks<'a, V>> {
        (rows.stride >= QUAD).then_some(rows)
    }
    #[inline(always)]
    fn store<V: Simd>(rows: &mut RowSliceMut<'_>, i: usize, value: [V; C], _: bool) {
        let stride = rows.stride;
        let Some(mut rest) = rows.bytes.get_mut(i * V::LANES * stride..) else { return };
        let _: Option<()> = V::store_quads(
            value,
            #[inline(always)]
            || {
                let (row, others) = core::mem::take(&mut rest).split_at_mut_checked(stride)?;
                rest = others;
                row.first_chunk_mut()
            },
        );
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
    type Buffer = Self;
    type In<V: Simd> = V::Int;

    fn len(indices: Self) -> usize {
        indices.len
    }
    fn split<'a>(
        Indices { first, len }: <Self as Input>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Input>::Slices<'a>, <Self as Input>::Slices<'a>)> {
        let others = Indices { first: first.wrapping_add(at as u32), len: len.checked_sub(at)? };
        Some((Indices { first, len: at }, others))
    }
    fn pad(indices: Self, _: usize) -> Self {
        indices
    }
    fn slices(indices: &Self, len: usize) -> Option<Self> {
        Some(Indices { len, ..*indices })
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        indices: <Self as Input>::Slices<'a>,
        _: usize,
    ) -> Option<<Self as Input>::Blocks<'a, V>> {
        Some(indices)
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
    type Buffer = (A::Buffer, B::Buffer);
    type In<V: Simd> = (A::In<V>, B::In<V>);

    fn len((a, _): Self::Slices<'_>) -> usize {
        A::len(a)
    }
    fn split<'a>(
        (a, b): <Self as Input>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Input>::Slices<'a>, <Self as Input>::Slices<'a>)> {
        let ((a, other_a), (b, other_b)) = (A::split(a, at)?, B::split(b, at)?);
        Some(((a, b), (other_a, other_b)))
    }
    fn pad((a, b): Self::Slices<'_>, lanes: usize) -> Self::Buffer {
        (A::pad(a, lanes), B::pad(b, lanes))
    }
    fn slices((a, b): &Self::Buffer, len: usize) -> Option<Self::Slices<'_>> {
        Some((A::slices(a, len)?, B::slices(b, len)?))
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        (a, b): <Self as Input>::Slices<'a>,
        count: usize,
    ) -> Option<<Self as Input>::Blocks<'a, V>> {
        Some((A::blocks::<V>(a, count)?, B::blocks::<V>(b, count)?))
    }
    #[inline(always)]
    fn load<V: Simd>((a, b): Self::Blocks<'_, V>, i: usize) -> Option<Self::In<V>> {
        Some((A::load::<V>(a, i)?, B::load::<V>(b, i)?))
    }
}

impl<A: Output, B: Output> Output for (A, B) {
    type Slices<'a> = (A::Slices<'a>, B::Slices<'a>);
    type Blocks<'a, V: Simd> = (A::Blocks<'a, V>, B::Blocks<'a, V>);
    type Buffer = (A::Buffer, B::Buffer);
    type In<V: Simd> = (A::In<V>, B::In<V>);

    fn split<'a>(
        (a, b): <Self as Output>::Slices<'a>,
        at: usize,
    ) -> Option<(<Self as Output>::Slices<'a>, <Self as Output>::Slices<'a>)> {
        let ((a, other_a), (b, other_b)) = (A::split(a, at)?, B::split(b, at)?);
        Some(((a, b), (other_a, other_b)))
    }
    fn pad((a, b): &Self::Slices<'_>) -> Self::Buffer {
        (A::pad(a), B::pad(b))
    }
    fn slices((a, b): &mut Self::Buffer, len: usize) -> Option<Self::Slices<'_>> {
        Some((A::slices(a, len)?, B::slices(b, len)?))
    }
    fn cut((a, b): &Self::Buffer, (to_a, to_b): Self::Slices<'_>) {
        A::cut(a, to_a);
        B::cut(b, to_b);
    }
    #[inline(always)]
    fn blocks<'a, V: Simd>(
        (a, b): <Self as Output>::Slices<'a>,
        count: usize,
    ) -> Option<<Self as Output>::Blocks<'a, V>> {
        Some((A::blocks::<V>(a, count)?, B::blocks::<V>(b, count)?))
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

/// Fills the first `len` elements of a slice with others, again and again.
fn repeat<T: Copy>(from: &[T], to: &mut [T], len: usize) {
    for to in to.get_mut(..len).unwrap_or_default().chunks_mut(from.len().max(1)) {
        copy(from, to);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::batch::{Kernel, map};
    use crate::simd::{I32x1, SimdInt};
    use std::vec::Vec;

    /// (x, y) to (2 x, y + 1).
    #[derive(Clone, Copy)]
    struct Change;

    macro_rules! change {
        ($($from:ty => $to:ty;)*) => { $(
            impl Kernel<$from, $to> for Change {
                fn run<V: Simd>(self, [x, y]: [V; 2]) -> [V; 2] {
                    [x + x, y + 1.0]
                }
            }
        )* };
    }
    change! {
        Columns<2> => Columns<2>;
        Columns<2> => Rows<3, 2>;
        Rows<3, 2> => Columns<2>;
        Columns<2> => Strided<2>;
        Strided<2> => Columns<2>;
    }

    /// x in columns and one in front, to see whether the elements beside them stay.
    fn input(len: usize) -> [Vec<f32>; 2] {
        [(0..len).map(|i| i as f32).collect(), (0..len).map(|i| 100.0 + i as f32).collect()]
    }

    fn expected(i: usize) -> [f32; 2] {
        [2.0 * i as f32, 101.0 + i as f32]
    }

    /// The bytes of a row of `stride` bytes that begins with two floats.
    fn row(values: [f32; 2], stride: usize) -> Vec<u8> {
        let mut row: Vec<u8> = values.into_iter().flat_map(f32::to_ne_bytes).collect();
        row.resize(stride, 0xEE);
        row
    }

    #[test]
    fn any_number_of_columns_elements_is_changed_and_no_other() {
        for len in 0..=33 {
            let [x, y] = input(len);
            let [mut a, mut b] = [[-1.0f32; 40]; 2];
            map::<Columns<2>, Columns<2>>(Change, [&x, &y], [&mut a[..len], &mut b[..len]]);
            for i in 0..40 {
                let wanted = if i < len { expected(i) } else { [-1.0; 2] };
                assert_eq!([a[i], b[i]], wanted, "{i} of {len}");
            }
        }
    }

    #[test]
    fn what_rows_have_besides_stays() {
        for len in 0..=33 {
            let [x, y] = input(len);
            let mut rows = [[[0xEE; 4]; 3]; 40];
            map::<Columns<2>, Rows<3, 2>>(Change, [&x, &y], &mut rows[..len]);
            for (i, row) in rows.into_iter().enumerate() {
                let wanted =
                    if i < len { expected(i).map(f32::to_ne_bytes) } else { [[0xEE; 4]; 2] };
                assert_eq!(row, [wanted[0], wanted[1], [0xEE; 4]], "{i} of {len}");
            }
            let mut rows = [[[0xEE; 4]; 3]; 40];
            for (row, (x, y)) in rows.iter_mut().zip(x.iter().zip(&y)) {
                [row[0], row[1]] = [x.to_ne_bytes(), y.to_ne_bytes()];
            }
            let [mut a, mut b] = [[-1.0f32; 40]; 2];
            map::<Rows<3, 2>, Columns<2>>(Change, &rows[..len], [&mut a[..len], &mut b[..len]]);
            assert!((0..len).all(|i| [a[i], b[i]] == expected(i)) && a[len..] == [-1.0; 40][len..]);
        }
    }

    #[test]
    fn strided_rows_keep_what_is_between_them() {
        for stride in [16, 17, 23, 32] {
            for len in [0, 1, 2, 7, 8, 9, 15, 16, 17, 33] {
                let [x, y] = input(len);
                let mut bytes: Vec<u8> = [0xEE].repeat(stride * len);
                let rows = RowSliceMut { bytes: &mut bytes, stride };
                map::<Columns<2>, Strided<2>>(Change, [&x, &y], rows);
                let wanted: Vec<u8> = (0..len).flat_map(|i| row(expected(i), stride)).collect();
                assert_eq!(bytes, wanted, "{len} of {stride}");

                let bytes: Vec<u8> = (0..len).flat_map(|i| row([x[i], y[i]], stride)).collect();
                let [mut a, mut b] = [[-1.0f32; 40]; 2];
                let rows = RowSlice { bytes: &bytes, stride };
                map::<Strided<2>, Columns<2>>(Change, rows, [&mut a[..len], &mut b[..len]]);
                assert!((0..len).all(|i| [a[i], b[i]] == expected(i)), "{len} of {stride}");
            }
        }
    }

    /// Codes of three bytes, and numbers: the sum of both, and the low byte of the code.
    #[derive(Clone, Copy)]
    struct Number;

    impl Kernel<(CodeColumn<[u8; 3]>, Indices), (CodeColumn<[u8; 3]>, CodeColumn<[u8; 1]>)> for Number {
        fn run<V: Simd>(self, (code, number): (V::Int, V::Int)) -> (V::Int, V::Int) {
            (code + number, code.low_bits(8))
        }
    }

    #[test]
    fn numbers_go_on_behind_a_block_and_wrap() {
        for len in 0..=33 {
            let codes: Vec<[u8; 3]> = (0..len).map(|i| [i as u8, 1, 0]).collect();
            let (mut sums, mut bytes) = ([[0xEE; 3]; 40], [0xEE; 40]);
            map::<(CodeColumn<[u8; 3]>, Indices), (CodeColumn<[u8; 3]>, CodeColumn<[u8; 1]>)>(
                Number,
                (
                    CodeSlice { bytes: codes.as_flattened(), size: 3 },
                    Indices { first: u32::MAX - 2, len },
                ),
                (
                    CodeSliceMut { bytes: sums[..len].as_flattened_mut(), size: 3 },
                    CodeSliceMut { bytes: &mut bytes[..len], size: 1 },
                ),
            );
            for i in 0..40 {
                // 256 + i - 3 + i.
                let [low, high, ..] = (253 + 2 * i as u32).to_le_bytes();
                let wanted = if i < len { ([low, high, 0], i as u8) } else { ([0xEE; 3], 0xEE) };
                assert_eq!((sums[i], bytes[i]), wanted, "{i} of {len}");
            }
        }
    }

    #[test]
    fn splitting_beyond_the_end_fails() {
        let x = [1.0f32, 2.0, 3.0];
        let (first, others) = <Columns<2> as Input>::split([&x, &x], 1).unwrap();
        assert_eq!((first, others), ([&x[..1]; 2], [&x[1..]; 2]));
        assert!(<Columns<2> as Input>::split([&x, &x[..1]], 2).is_none());
        assert!(<Indices as Input>::split(Indices { first: 7, len: 2 }, 3).is_none());
        let (_, others) = <Indices as Input>::split(Indices { first: 7, len: 2 }, 2).unwrap();
        assert_eq!((others.first, others.len), (9, 0));
        let rows = RowSlice { bytes: &[0; 40], stride: 20 };
        assert_eq!(<Strided<3> as Input>::len(rows), 2);
        assert!(<Strided<3> as Input>::split(rows, 3).is_none());
    }

    #[test]
    fn padding_repeats_the_elements() {
        let padded = <Columns<1> as Input>::pad([&[5.0, 6.0, 7.0]], 7);
        assert_eq!(padded[0][..7], [5.0, 6.0, 7.0, 5.0, 6.0, 7.0, 5.0]);
        let codes = CodeSlice { bytes: &[1, 2, 3, 4], size: 2 };
        let buffer = <CodeColumn<[u8; 2]> as Input>::pad(codes, 3);
        let padded = <CodeColumn<[u8; 2]> as Input>::slices(&buffer, 3).unwrap();
        assert_eq!((padded.bytes, padded.size), (&[1, 2, 3, 4, 1, 2][..], 2));
    }

    #[test]
    fn blocks_need_all_their_elements() {
        let x = [1.0f32, 2.0];
        assert!(<Columns<1> as Input>::blocks::<f32>([&x], 2).is_some());
        assert!(<Columns<1> as Input>::blocks::<f32>([&x], 3).is_none());
        let short = RowSlice { bytes: &[0; 60], stride: 15 };
        assert!(<Strided<3> as Input>::blocks::<f32>(short, 1).is_none());
        let numbers = Indices { first: 10, len: 5 };
        assert_eq!(<Indices as Input>::load::<f32>(numbers, 3), Some(I32x1(13)));
    }
}
