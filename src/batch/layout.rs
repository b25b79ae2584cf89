//! The one place where layouts meet: brings vectors and codes of any layout into the form that
//! kernels take, a few at a time.

pub(crate) use super::codes::{CodeLayout, Codes, CodesMut};
use super::codes::{Room, gather as gather_codes, scatter as scatter_codes};
use super::columns::{Columns, Input, Output, QUAD, RowSlice, RowSliceMut, Rows, Strided, empty};
use super::storage::{CodeSlice, CodeSliceMut, MAX_CODE};
use super::{Kernel, map};
use crate::simd::stream::{self, Fence};
use crate::simd::{Simd, Use};

/// Elements that are converted at a time: more where each part costs a check of the processor.
pub(crate) const PART: usize = if cfg!(feature = "std") { 256 } else { FEW };
/// The same, where at most four columns need room.
const MANY: usize = if cfg!(feature = "std") { 1024 } else { FEW };
/// The same, where rows come from memory and most of their bytes are others': then the next ones are fetched while these are
/// computed.
const FAR: usize = if cfg!(feature = "std") { 128 } else { FEW };
/// A part of so few that the room for it costs little.
const FEW: usize = 64;

/// Vectors of `K` components to read.
#[derive(Clone, Copy)]
pub enum Vectors<'a, const K: usize> {
    /// A slice for each component.
    Columns([&'a [f32]; K]),
    /// Native floats in bytes. A vector begins every `stride` bytes.
    Rows { bytes: &'a [u8], stride: usize },
}

/// Vectors of `K` components to write.
pub enum VectorsMut<'a, const K: usize> {
    /// A slice for each component.
    Columns([&'a mut [f32]; K]),
    /// Native floats in bytes. A vector begins every `stride` bytes; what lies between stays.
    Rows { bytes: &'a mut [u8], stride: usize },
}

impl<'a, const K: usize> Vectors<'a, K> {
    /// Vectors of `N` floats, of which the first `K` count.
    #[inline]
    pub(crate) fn rows<const N: usize>(vectors: &'a [[f32; N]]) -> Self {
        const {
            assert!(N >= K, "a vector has at least three components: use [f32; 3] or longer arrays")
        };
        Vectors::Rows { bytes: bytemuck::cast_slice(vectors.as_flattened()), stride: 4 * N }
    }
}

impl<'a, const K: usize> VectorsMut<'a, K> {
    /// Vectors of `N` floats, of which the first `K` count.
    #[inline]
    pub(crate) fn rows<const N: usize>(vectors: &'a mut [[f32; N]]) -> Self {
        const {
            assert!(N >= K, "a vector has at least three components: use [f32; 3] or longer arrays")
        };
        VectorsMut::Rows {
            bytes: bytemuck::cast_slice_mut(vectors.as_flattened_mut()),
            stride: 4 * N,
        }
    }
}

/// What a batch reads beside codes, in any layout.
pub(crate) trait Read<'a>: Copy {
    /// The slices that kernels take.
    type Kind: Input;
    /// Room for `LEN` elements, made when it is needed.
    type Buffer<const LEN: usize>: Default;
    /// Number of columns in the room.
    const COLUMNS: usize;
    /// Size in bytes of an element in a row.
    const SIZE: usize = 4 * Self::COLUMNS;

    /// Size in bytes of rows and what is between them; 0 if it consists of slices.
    fn row_bytes(&self) -> usize;
    /// The slices, if it consists of them.
    fn direct(self) -> Option<InputSlices<'a, Self::Kind>>;
    /// `len` elements from the one at `first` on, at most `LEN`.
    fn part<'b, const LEN: usize>(
        &'b self,
        first: usize,
        len: usize,
        buffer: &'b mut Self::Buffer<LEN>,
    ) -> InputSlices<'b, Self::Kind>;
}

/// What a batch writes beside codes, in any layout.
pub(crate) trait Write<'a>: Sized {
    /// The slices that kernels take.
    type Kind: Output;
    /// Room for `LEN` elements, made when it is needed.
    type Buffer<const LEN: usize>: Default;
    /// Number of columns in the room.
    const COLUMNS: usize;
    /// Size in bytes of an element in a row.
    const SIZE: usize = 4 * Self::COLUMNS;

    /// Size in bytes of rows and what is between them; 0 if it consists of slices.
    fn row_bytes(&self) -> usize;
    /// Whether it consists of slices.
    fn is_direct(&self) -> bool;
    /// The slices, if it consists of them.
    fn direct(self) -> Option<OutputSlices<'a, Self::Kind>>;
    /// Size of the slices in bytes, and number of elements up to the first that is aligned for
    /// streaming.
    fn size_and_unaligned(slices: &OutputSlices<'a, Self::Kind>) -> (usize, usize);
    /// The first `len` elements, and the others. No elements if there are fewer.
    fn split_at(self, len: usize) -> (Self, Self);
    /// Slices to write all `len` elements to, those of `buffer` if it has none itself.
    fn slices<'b, const LEN: usize>(
        &'b mut self,
        len: usize,
        buffer: &'b mut Self::Buffer<LEN>,
    ) -> Option<OutputSlices<'b, Self::Kind>>;
    /// Takes over what was written to the buffer.
    fn take<const LEN: usize>(self, buffer: &Self::Buffer<LEN>);
}

type InputSlices<'a, K> = <K as Input>::Slices<'a>;
type OutputSlices<'a, K> = <K as Output>::Slices<'a>;

/// What encodes slices.
type EncodeKernel<'k, 'a, R> =
    &'k mut dyn FnMut(InputSlices<'_, <R as Read<'a>>::Kind>, CodeSliceMut<'_>);
/// The same, at most [`MANY`] elements at a time, with `S` columns of room for them.
type EncodePart<'k, 'a, R, const S: usize> =
    &'k mut dyn FnMut(InputSlices<'_, <R as Read<'a>>::Kind>, CodeSliceMut<'_>, [&mut [f32]; S]);

/// Encodes what has any layout. Inlined, so that a program has no code for layouts it does not use.
#[inline]
pub(crate) fn encode<'a, R: Read<'a>>(
    input: R,
    codes: CodesMut<'_>,
    kernel: EncodeKernel<'_, 'a, R>,
) {
    match input.direct() {
        Some(slices) if codes.is_dense() => codes.write_dense(|codes| kernel(slices, codes)),
        _ => encode_in_parts(input, codes, &mut |slices, codes, []| kernel(slices, codes)),
    }
}

/// Encodes what has any layout a part at a time, in order.
#[inline(never)]
pub(crate) fn encode_in_parts<'a, R: Read<'a>, const S: usize>(
    input: R,
    codes: CodesMut<'_>,
    kernel: EncodePart<'_, 'a, R, S>,
) {
    if codes.len() <= FEW {
        encode_parts::<R, S, FEW>(input, codes, kernel);
    } else if is_far(input.row_bytes(), R::SIZE, codes.len()) {
        encode_parts::<R, S, FAR>(input, codes, kernel);
    } else if codes.len() <= PART || const { R::COLUMNS + S > 4 } {
        encode_parts::<R, S, PART>(input, codes, kernel);
    } else {
        encode_parts::<R, S, MANY>(input, codes, kernel);
    }
}

/// Whether rows of so many bytes are beyond the caches, and at least twice what is read or written of them.
fn is_far(row_bytes: usize, size: usize, len: usize) -> bool {
    row_bytes > 4 << 20 && row_bytes / (2 * size).max(1) >= len
}

#[inline(never)]
fn encode_parts<'a, R: Read<'a>, const S: usize, const LEN: usize>(
    input: R,
    codes: CodesMut<'_>,
    kernel: EncodePart<'_, 'a, R, S>,
) {
    let (mut buffer, mut room) = (R::Buffer::<LEN>::default(), [[0.0; LEN]; S]);
    let mut code_room = Room::<LEN>::None;
    for (part, codes) in codes.parts(LEN).enumerate() {
        let len = codes.len();
        let slices = input.part(part * LEN, len, &mut buffer);
        if let Some(room) = columns_mut(&mut room, len) {
            codes.write(&mut code_room, |codes| kernel(slices, codes, room));
        }
    }
}

/// What decodes to slices. Its caller drops the fence.
type DecodeKernel<'k, 'a, W> =
    &'k mut dyn FnMut(CodeSlice<'_>, OutputSlices<'_, <W as Write<'a>>::Kind>, &Fence);
/// The same, at most [`MANY`] elements at a time, with `S` columns of room for them.
type DecodePart<'k, 'a, W, const S: usize> =
    &'k mut dyn FnMut(CodeSlice<'_>, OutputSlices<'_, <W as Write<'a>>::Kind>, [&mut [f32]; S]);

/// Decodes to any layout. Inlined as [`encode`].
#[inline]
pub(crate) fn decode<'a, W: Write<'a>>(
    codes: Codes<'_>,
    output: W,
    kernel: DecodeKernel<'_, 'a, W>,
) {
    match codes.direct() {
        Some(codes) if output.is_direct() => {
            if let Some(slices) = output.direct() {
                decode_direct::<W>(codes, slices, kernel);
            }
        }
        _ => decode_in_parts(codes, output, &mut |codes, slices, []| {
            kernel(codes, slices, &Fence::new(false));
        }),
    }
}

#[inline(never)]
fn decode_direct<'a, W: Write<'a>>(
    codes: CodeSlice<'_>,
    slices: OutputSlices<'a, W::Kind>,
    kernel: DecodeKernel<'_, 'a, W>,
) {
    let (bytes, unaligned) = W::size_and_unaligned(&slices);
    if !stream::is_large(bytes) {
        return kernel(codes, slices, &Fence::new(false));
    }
    // Streaming begins after the vectors whose x is not aligned. Columns are alike if they begin
    // alike.
    if let Some((unaligned_codes, codes)) = codes.split_at(unaligned)
        && let Some((unaligned, slices)) = W::Kind::split(slices, unaligned)
    {
        kernel(unaligned_codes, unaligned, &Fence::new(false));
        kernel(codes, slices, &Fence::new(true));
    }
}

/// Decodes to any layout a part at a time, in order.
#[inline(never)]
pub(crate) fn decode_in_parts<'a, W: Write<'a>, const S: usize>(
    codes: Codes<'_>,
    output: W,
    kernel: DecodePart<'_, 'a, W, S>,
) {
    if codes.len() <= FEW {
        decode_parts::<W, S, FEW>(codes, output, kernel);
    } else if is_far(output.row_bytes(), W::SIZE, codes.len()) {
        decode_parts::<W, S, FAR>(codes, output, kernel);
    } else if codes.len() <= PART || const { W::COLUMNS + S > 4 } {
        decode_parts::<W, S, PART>(codes, output, kernel);
    } else {
        decode_parts::<W, S, MANY>(codes, output, kernel);
    }
}

#[inline(never)]
fn decode_parts<'a, W: Write<'a>, const S: usize, const LEN: usize>(
    codes: Codes<'_>,
    mut output: W,
    kernel: DecodePart<'_, 'a, W, S>,
) {
    let (mut buffer, mut room) = (W::Buffer::<LEN>::default(), [[0.0; LEN]; S]);
    let mut code_room = Room::<LEN>::None;
    for codes in codes.parts(LEN) {
        let len = codes.len();
        let (mut part, others) = output.split_at(len);
        output = others;
        if let Some(slices) = part.slices(len, &mut buffer)
            && let Some(room) = columns_mut(&mut room, len)
        {
            codes.read(&mut code_room, |codes| kernel(codes, slices, room));
        }
        part.take(&buffer);
    }
}

/// Decodes to any layout one vector after the other, where there is so little to do that a part's way by columns would cost
/// as much again. A code has `SIZE` bytes, little-endian here.
#[inline(always)]
pub(crate) fn decode_each<const SIZE: usize>(
    codes: Codes<'_>,
    vectors: VectorsMut<'_, 3>,
    decode: impl Fn([u8; SIZE]) -> [f32; 3],
) {
    match vectors {
        VectorsMut::Columns([x, y, z]) => {
            for (((code, x), y), z) in codes.each().zip(x).zip(y).zip(z) {
                [*x, *y, *z] = decode(code);
            }
        }
        VectorsMut::Rows { bytes, stride } => match stride {
            12 => decode_rows(codes.each(), bytes.as_chunks_mut::<12>().0, decode),
            QUAD => {
                let (rows, rest) = bytes.as_chunks_mut::<QUAD>();
                let last = codes.each().skip(rows.len());
                decode_rows(codes.each(), rows, &decode);
                decode_rows(last, [rest], &decode);
            }
            _ => decode_rows(codes.each(), bytes.chunks_mut(stride.max(1)), decode),
        },
    }
}

/// Decodes to the first bytes of rows.
#[inline(always)]
fn decode_rows<C, R: AsMut<[u8]>>(
    codes: impl Iterator<Item = C>,
    rows: impl IntoIterator<Item = R>,
    decode: impl Fn(C) -> [f32; 3],
) {
    // Rows first: a code too many is not taken.
    for (mut row, code) in rows.into_iter().zip(codes) {
        if let Some(to) = row.as_mut().first_chunk_mut() {
            *to = bytemuck::cast::<[f32; 3], [u8; 12]>(decode(code));
        }
    }
}

/// Elements that hold `F` vectors and their code, which may overlap. All lie within `stride` bytes, so that no element
/// reaches into another.
pub(crate) struct Within<'a, const F: usize = 1> {
    /// From the first byte of the first element to the last byte of the last.
    pub(crate) bytes: &'a mut [u8],
    pub(crate) stride: usize,
    /// Where in an element each vector begins.
    pub(crate) vectors: [usize; F],
    /// Where in an element the code begins.
    pub(crate) code: usize,
    pub(crate) layout: CodeLayout,
}

/// Encodes vectors to where they lie.
#[inline]
pub(crate) fn encode_within<const K: usize>(
    within: Within<'_>,
    encode: &dyn Fn(Vectors<'_, K>, CodesMut<'_>),
) {
    let stride = within.stride;
    encode_fields_within(within, &mut |[bytes], codes| {
        encode(Vectors::Rows { bytes, stride }, codes);
    });
}

/// Decodes codes to where they lie.
#[inline]
pub(crate) fn decode_within<const K: usize>(
    within: Within<'_>,
    decode: &dyn Fn(Codes<'_>, VectorsMut<'_, K>),
) {
    let (stride, [vector]) = (within.stride, within.vectors);
    decode_fields_within(within, &mut |codes, part| {
        if let Some(bytes) = part.get_mut(vector..) {
            decode(codes, VectorsMut::Rows { bytes, stride });
        }
    });
}

/// Encodes elements to where they lie, from rows that begin at each of the fields. All of a part are read before
/// any is written.
#[inline(never)]
pub(crate) fn encode_fields_within<const F: usize>(
    within: Within<'_, F>,
    encode: &mut dyn FnMut([&[u8]; F], CodesMut<'_>),
) {
    let Within { bytes, stride, vectors, code, layout } = within;
    let size = layout.size;
    let mut room = [[0; MAX_CODE]; PART];
    for part in bytes.chunks_mut(PART.saturating_mul(stride).max(1)) {
        let len = part.len().div_ceil(stride.max(1));
        if let Some(codes) = room.as_flattened_mut().get_mut(..len * size) {
            let rows = vectors.map(|vector| part.get(vector..).unwrap_or_default());
            encode(rows, CodesMut::dense(codes, layout));
            if let Some(to) = part.get_mut(code..) {
                scatter_codes(codes, to, size, stride);
            }
        }
    }
}

/// Decodes the codes of elements to where they lie. All of a part are read before any is written.
#[inline(never)]
pub(crate) fn decode_fields_within<const F: usize>(
    within: Within<'_, F>,
    decode: &mut dyn FnMut(Codes<'_>, &mut [u8]),
) {
    let Within { bytes, stride, code, layout, .. } = within;
    let size = layout.size;
    let mut room = [[0; MAX_CODE]; PART];
    for part in bytes.chunks_mut(PART.saturating_mul(stride).max(1)) {
        let len = part.len().div_ceil(stride.max(1));
        if let Some(codes) = room.as_flattened_mut().get_mut(..len * size)
            && let Some(from) = part.get(code..)
        {
            gather_codes(from, size, stride, codes);
            decode(Codes::dense(codes, layout), part);
        }
    }
}

/// Decodes codes, and gives the vectors away, a part at a time.
#[inline(never)]
pub(crate) fn decode_for(
    decode: &dyn Fn(Codes<'_>, VectorsMut<'_, 3>),
    codes: Codes<'_>,
    take: &mut dyn FnMut([&[f32]; 3]),
) {
    let mut buffer = [[0.0; PART]; 3];
    for codes in codes.parts(PART) {
        let len = codes.len();
        if let Some(columns) = columns_mut(&mut buffer, len) {
            decode(codes, VectorsMut::Columns(columns));
        }
        take(columns(&buffer, len));
    }
}

/// Decodes codes and encodes them again.
#[inline(never)]
pub(crate) fn transcode(
    decode: &dyn Fn(Codes<'_>, VectorsMut<'_, 3>),
    encode: &dyn Fn(Vectors<'_, 3>, CodesMut<'_>),
    from: Codes<'_>,
    to: CodesMut<'_>,
) {
    let mut parts = to.parts(PART);
    decode_for(decode, from, &mut |v| {
        if let Some(to) = parts.next() {
            encode(Vectors::Columns(v), to);
        }
    });
}

/// Changes codes in place.
#[inline(never)]
pub(crate) fn map_codes(codes: CodesMut<'_>, kernel: &dyn Fn(CodeSlice<'_>, CodeSliceMut<'_>)) {
    let mut room = Room::<PART>::None;
    for codes in codes.parts(PART) {
        codes.update(&mut room, kernel);
    }
}

impl<'a, const K: usize> Read<'a> for Vectors<'a, K> {
    type Kind = Columns<K>;
    type Buffer<const LEN: usize> = Option<[[f32; LEN]; K]>;
    const COLUMNS: usize = K;

    fn row_bytes(&self) -> usize {
        match self {
            Vectors::Columns(_) => 0,
            Vectors::Rows { bytes, .. } => bytes.len(),
        }
    }
    #[inline]
    fn direct(self) -> Option<[&'a [f32]; K]> {
        match self {
            Vectors::Columns(columns) => Some(columns),
            Vectors::Rows { .. } => None,
        }
    }
    fn part<'b, const LEN: usize>(
        &'b self,
        first: usize,
        len: usize,
        buffer: &'b mut Option<[[f32; LEN]; K]>,
    ) -> [&'b [f32]; K] {
        match *self {
            Vectors::Columns(columns) => {
                columns.map(|column| column.get(first..first + len).unwrap_or_default())
            }
            Vectors::Rows { bytes, stride } => {
                let buffer = buffer.get_or_insert([[0.0; LEN]; K]);
                if let Some(rows) = bytes.get(first * stride..)
                    && let Some(columns) = columns_mut(buffer, len)
                {
                    gather(rows, stride, columns);
                }
                columns(buffer, len)
            }
        }
    }
}

impl<'a, const K: usize> Write<'a> for VectorsMut<'a, K> {
    type Kind = Columns<K>;
    type Buffer<const LEN: usize> = Option<[[f32; LEN]; K]>;
    const COLUMNS: usize = K;

    fn row_bytes(&self) -> usize {
        match self {
            VectorsMut::Columns(_) => 0,
            VectorsMut::Rows { bytes, .. } => bytes.len(),
        }
    }
    #[inline]
    fn is_direct(&self) -> bool {
        matches!(self, VectorsMut::Columns(_))
    }
    #[inline]
    fn direct(self) -> Option<ColumnsMut<'a, K>> {
        match self {
            VectorsMut::Columns(columns) => Some(columns),
            VectorsMut::Rows { .. } => None,
        }
    }
    fn size_and_unaligned(columns: &ColumnsMut<'a, K>) -> (usize, usize) {
        let Some(x) = columns.first() else { return (0, 0) };
        (K * size_of_val(*x), x.as_ptr().align_offset(stream::ALIGNMENT).min(x.len()))
    }
    fn split_at(self, len: usize) -> (Self, Self) {
        match self {
            VectorsMut::Columns(columns) => {
                let (first, others) = split_columns(columns, len).unwrap_or((empty(), empty()));
                (VectorsMut::Columns(first), VectorsMut::Columns(others))
            }
            VectorsMut::Rows { bytes, stride } => {
                let at = len.saturating_mul(stride).min(bytes.len());
                let (first, others) = bytes.split_at_mut(at);
                (
                    VectorsMut::Rows { bytes: first, stride },
                    VectorsMut::Rows { bytes: others, stride },
                )
            }
        }
    }
    fn slices<'b, const LEN: usize>(
        &'b mut self,
        len: usize,
        buffer: &'b mut Option<[[f32; LEN]; K]>,
    ) -> Option<ColumnsMut<'b, K>> {
        match self {
            VectorsMut::Columns(columns) => Some(columns.each_mut().map(|column| &mut **column)),
            VectorsMut::Rows { .. } => columns_mut(buffer.get_or_insert([[0.0; LEN]; K]), len),
        }
    }
    fn take<const LEN: usize>(self, buffer: &Option<[[f32; LEN]; K]>) {
        if let VectorsMut::Rows { bytes, stride } = self
            && let Some(buffer) = buffer
        {
            scatter(columns(buffer, bytes.len().div_ceil(stride.max(1))), bytes, stride);
        }
    }
}

impl<'a, A: Read<'a>, B: Read<'a>> Read<'a> for (A, B) {
    type Kind = (A::Kind, B::Kind);
    type Buffer<const LEN: usize> = (A::Buffer<LEN>, B::Buffer<LEN>);
    const COLUMNS: usize = A::COLUMNS + B::COLUMNS;

    fn row_bytes(&self) -> usize {
        self.0.row_bytes().saturating_add(self.1.row_bytes())
    }
    #[inline]
    fn direct(self) -> Option<InputSlices<'a, Self::Kind>> {
        Some((self.0.direct()?, self.1.direct()?))
    }
    fn part<'b, const LEN: usize>(
        &'b self,
        first: usize,
        len: usize,
        (a, b): &'b mut Self::Buffer<LEN>,
    ) -> InputSlices<'b, Self::Kind> {
        (self.0.part(first, len, a), self.1.part(first, len, b))
    }
}

impl<'a, A: Write<'a>, B: Write<'a>> Write<'a> for (A, B) {
    type Kind = (A::Kind, B::Kind);
    type Buffer<const LEN: usize> = (A::Buffer<LEN>, B::Buffer<LEN>);
    const COLUMNS: usize = A::COLUMNS + B::COLUMNS;

    #[inline]
    fn row_bytes(&self) -> usize {
        self.0.row_bytes().saturating_add(self.1.row_bytes())
    }
    #[inline]
    fn is_direct(&self) -> bool {
        self.0.is_direct() && self.1.is_direct()
    }
    #[inline]
    fn direct(self) -> Option<OutputSlices<'a, Self::Kind>> {
        Some((self.0.direct()?, self.1.direct()?))
    }
    fn size_and_unaligned((a, b): &OutputSlices<'a, Self::Kind>) -> (usize, usize) {
        let ((a_size, unaligned), (b_size, _)) =
            (A::size_and_unaligned(a), B::size_and_unaligned(b));
        (a_size + b_size, unaligned)
    }
    fn split_at(self, len: usize) -> (Self, Self) {
        let ((a, other_a), (b, other_b)) = (self.0.split_at(len), self.1.split_at(len));
        ((a, b), (other_a, other_b))
    }
    fn slices<'b, const LEN: usize>(
        &'b mut self,
        len: usize,
        (a, b): &'b mut Self::Buffer<LEN>,
    ) -> Option<OutputSlices<'b, Self::Kind>> {
        Some((self.0.slices(len, a)?, self.1.slices(len, b)?))
    }
    fn take<const LEN: usize>(self, (a, b): &Self::Buffer<LEN>) {
        self.0.take(a);
        self.1.take(b);
    }
}

/// Elements that hold a vector of three and one of four, to be written together.
pub struct PairMut<'a> {
    /// From the first byte of the first element to the last byte of the last.
    pub(crate) bytes: &'a mut [u8],
    pub(crate) stride: usize,
    /// Where in an element each of them begins.
    pub(crate) at: [usize; 2],
}

impl<'a> Write<'a> for PairMut<'a> {
    type Kind = (Columns<3>, Columns<4>);
    type Buffer<const LEN: usize> = (Option<[[f32; LEN]; 3]>, Option<[[f32; LEN]; 4]>);
    const COLUMNS: usize = 7;

    fn row_bytes(&self) -> usize {
        self.bytes.len()
    }
    #[inline]
    fn is_direct(&self) -> bool {
        false
    }
    #[inline]
    fn direct(self) -> Option<OutputSlices<'a, Self::Kind>> {
        None
    }
    fn size_and_unaligned(_: &OutputSlices<'a, Self::Kind>) -> (usize, usize) {
        (0, 0)
    }
    fn split_at(self, len: usize) -> (Self, Self) {
        let PairMut { bytes, stride, at } = self;
        let (first, others) = bytes.split_at_mut(len.saturating_mul(stride).min(bytes.len()));
        (PairMut { bytes: first, stride, at }, PairMut { bytes: others, stride, at })
    }
    fn slices<'b, const LEN: usize>(
        &'b mut self,
        len: usize,
        (a, b): &'b mut Self::Buffer<LEN>,
    ) -> Option<OutputSlices<'b, Self::Kind>> {
        Some((
            columns_mut(a.get_or_insert([[0.0; LEN]; 3]), len)?,
            columns_mut(b.get_or_insert([[0.0; LEN]; 4]), len)?,
        ))
    }
    fn take<const LEN: usize>(self, (a, b): &Self::Buffer<LEN>) {
        let PairMut { bytes, stride, at: [first, second] } = self;
        let len = bytes.len().div_ceil(stride.max(1));
        if let (Some(a), Some(to)) = (a, bytes.get_mut(first..)) {
            scatter(columns(a, len), to, stride);
        }
        if let (Some(b), Some(to)) = (b, bytes.get_mut(second..)) {
            scatter(columns(b, len), to, stride);
        }
    }
}

/// The first `len` elements of each column.
pub(super) fn columns<const K: usize, const PART: usize>(
    buffer: &[[f32; PART]; K],
    len: usize,
) -> [&[f32]; K] {
    buffer.each_ref().map(|column| column.get(..len).unwrap_or_default())
}

/// The first `len` elements of each column, or `None` if there are fewer.
pub(super) fn columns_mut<const K: usize, const PART: usize>(
    buffer: &mut [[f32; PART]; K],
    len: usize,
) -> Option<[&mut [f32]; K]> {
    (len <= PART).then(|| buffer.each_mut().map(|column| column.get_mut(..len).unwrap_or_default()))
}

/// Columns to write.
type ColumnsMut<'a, const K: usize> = [&'a mut [f32]; K];

/// The first `at` elements of each column, and the others. `None` if there are fewer.
fn split_columns<const K: usize>(
    columns: ColumnsMut<'_, K>,
    at: usize,
) -> Option<(ColumnsMut<'_, K>, ColumnsMut<'_, K>)> {
    <Columns<K> as Output>::split(columns, at)
}

/// Number of whole rows in bytes, if their stride is one that kernels take. The last row may end before
/// a whole stride.
fn whole_rows<const K: usize>(bytes: &[u8], stride: usize) -> usize {
    if stride == 4 * K || stride >= QUAD { bytes.len().checked_div(stride).unwrap_or(0) } else { 0 }
}

/// From rows to columns, as many as those have elements.
#[inline(never)]
fn gather<const K: usize>(bytes: &[u8], stride: usize, columns: [&mut [f32]; K]) {
    let len = columns.first().map_or(0, |column| column.len());
    let whole = whole_rows::<K>(bytes, stride).min(len);
    let Some((rows, rest)) = bytes.split_at_checked(whole * stride) else { return };
    let Some((columns, rest_columns)) = split_columns(columns, whole) else { return };
    if stride == 4 * K {
        let rows = rows.as_chunks().0.as_chunks().0;
        map::<Rows<K, K>, Columns<K>>(Transpose, rows, columns);
    } else if stride == QUAD {
        let rows = rows.as_chunks().0.as_chunks().0;
        map::<Rows<4, K>, Columns<K>>(Transpose, rows, columns);
    } else {
        map::<Strided<K>, Columns<K>>(Transpose, RowSlice { bytes: rows, stride }, columns);
    }
    for (c, column) in rest_columns.into_iter().enumerate() {
        for (to, row) in column.iter_mut().zip(rest.chunks(stride.max(1))) {
            *to = row.as_chunks().0.get(c).copied().map_or(0.0, f32::from_ne_bytes);
        }
    }
}

/// From columns to rows, whose other bytes stay.
#[inline(never)]
fn scatter<const K: usize>(columns: [&[f32]; K], bytes: &mut [u8], stride: usize) {
    let whole = whole_rows::<K>(bytes, stride);
    let Some((rows, rest)) = bytes.split_at_mut_checked(whole * stride) else { return };
    let Some((columns, rest_columns)) = <Columns<K> as Input>::split(columns, whole) else {
        return;
    };
    if stride == 4 * K {
        let rows = rows.as_chunks_mut().0.as_chunks_mut().0;
        map::<Columns<K>, Rows<K, K>>(Transpose, columns, rows);
    } else if stride == QUAD {
        let rows = rows.as_chunks_mut().0.as_chunks_mut().0;
        map::<Columns<K>, Rows<4, K>>(Transpose, columns, rows);
    } else {
        map::<Columns<K>, Strided<K>>(Transpose, columns, RowSliceMut { bytes: rows, stride });
    }
    for (c, column) in rest_columns.into_iter().enumerate() {
        for (from, row) in column.iter().zip(rest.chunks_mut(stride.max(1))) {
            if let Some(to) = row.as_chunks_mut().0.get_mut(c) {
                *to = from.to_ne_bytes();
            }
        }
    }
}

/// Between rows and columns.
#[derive(Clone, Copy)]
struct Transpose;

macro_rules! transpose {
    ($([$($generics:tt)*] $from:ty => $to:ty;)*) => { $(
        impl<$($generics)*> Kernel<$from, $to> for Transpose {
            const USE: Use = Use::Moves;

            #[inline(always)]
            fn run<V: Simd>(self, vectors: [V; K]) -> [V; K] {
                vectors
            }
        }
    )* };
}

transpose! {
    [const N: usize, const K: usize] Rows<N, K> => Columns<K>;
    [const N: usize, const K: usize] Columns<K> => Rows<N, K>;
    [const K: usize] Strided<K> => Columns<K>;
    [const K: usize] Columns<K> => Strided<K>;
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Around the sizes of blocks and parts.
    const LENGTHS: [usize; 16] =
        [0, 1, 2, 7, 8, 9, 15, 16, 17, 31, 33, FEW, FEW + 1, MANY - 1, MANY, MANY + 1];
    const STRIDES: [usize; 7] = [12, 13, 15, 16, 17, 20, 33];

    fn vector(i: usize) -> [f32; 3] {
        [i as f32, 0.25 + i as f32, -(i as f32)]
    }

    /// The code of a vector: its number.
    fn encode_numbers([x, y, z]: [&[f32]; 3], codes: CodeSliceMut<'_>) {
        assert_eq!([x.len(), y.len(), z.len()], [codes.bytes.len() / 2; 3]);
        for (i, code) in codes.bytes.as_chunks_mut().0.iter_mut().enumerate() {
            let is_vector = [x[i], y[i], z[i]] == vector(x[i] as usize);
            *code = if is_vector { x[i] as u16 } else { u16::MAX }.to_le_bytes();
        }
    }

    fn decode_numbers(codes: CodeSlice<'_>, [x, y, z]: [&mut [f32]; 3], _: &Fence) {
        assert_eq!([x.len(), y.len(), z.len()], [codes.bytes.len() / 2; 3]);
        for (i, code) in codes.bytes.as_chunks().0.iter().enumerate() {
            [x[i], y[i], z[i]] = vector(u16::from_le_bytes(*code).into());
        }
    }

    /// Little-endian codes from 0 on.
    fn numbers(len: usize) -> Vec<u8> {
        (0..len).flat_map(|i| (i as u16).to_le_bytes()).collect()
    }

    /// Rows, between which is 0xEE. The last one ends with its z.
    fn rows(len: usize, stride: usize, filled: bool) -> Vec<u8> {
        let mut bytes = Vec::new();
        for i in 0..len {
            bytes.resize(i * stride, 0xEE);
            let floats = vector(i).into_iter().flat_map(f32::to_ne_bytes);
            bytes.extend(floats.map(|byte| if filled { byte } else { 0xDD }));
        }
        bytes
    }

    #[test]
    fn rows_of_any_stride_are_encoded() {
        for stride in STRIDES {
            for len in LENGTHS {
                let bytes = rows(len, stride, true);
                let mut codes: Vec<u8> = [0xEE].repeat(2 * len);
                let vectors = Vectors::Rows { bytes: &bytes, stride };
                encode(vectors, CodesMut::little_endian(&mut codes, 2), &mut encode_numbers);
                assert_eq!(codes, numbers(len), "{len} of {stride}");
            }
        }
    }

    #[test]
    fn rows_of_any_stride_are_decoded_and_keep_what_is_between() {
        for stride in STRIDES {
            for len in LENGTHS {
                let mut bytes = rows(len, stride, false);
                let vectors = VectorsMut::Rows { bytes: &mut bytes, stride };
                let codes = numbers(len);
                decode(Codes::little_endian(&codes, 2), vectors, &mut decode_numbers);
                assert_eq!(bytes, rows(len, stride, true), "{len} of {stride}");

                let mut bytes = rows(len, stride, false);
                let vectors = VectorsMut::Rows { bytes: &mut bytes, stride };
                decode_each(Codes::little_endian(&codes, 2), vectors, |code| {
                    vector(u16::from_le_bytes(code).into())
                });
                assert_eq!(bytes, rows(len, stride, true), "{len} of {stride}, one by one");
            }
        }
    }

    #[test]
    fn native_arrays_are_rows() {
        let vectors: [[f32; 4]; 5] = core::array::from_fn(|i| {
            let [x, y, z] = vector(i);
            [x, y, z, 9.0]
        });
        let mut codes = [0u16; 5];
        encode(Vectors::rows(&vectors), CodesMut::native(&mut codes), &mut encode_numbers);
        assert_eq!(codes, [0, 1, 2, 3, 4]);
        let mut decoded = [[9.0f32; 4]; 5];
        decode(Codes::native(&codes), VectorsMut::rows(&mut decoded), &mut decode_numbers);
        assert_eq!(decoded, vectors);
    }

    #[test]
    fn columns_are_passed_on() {
        let [mut x, mut y, mut z] = [[0.0f32; 3]; 3];
        let codes = Codes::native(&[7u16, 8, 9]);
        decode(codes, VectorsMut::Columns([&mut x, &mut y, &mut z]), &mut decode_numbers);
        assert_eq!([x[2], y[2], z[2]], vector(9));
        let mut back = [0u16; 3];
        encode(Vectors::Columns([&x, &y, &z]), CodesMut::native(&mut back), &mut encode_numbers);
        assert_eq!(back, [7, 8, 9]);
    }

    /// Columns beside rows, whole and in parts.
    #[test]
    fn pairs_are_read_and_written_together() {
        for len in LENGTHS {
            let bytes = rows(len, 13, true);
            let x: Vec<f32> = (0..len).map(|i| i as f32).collect();
            let vectors = Vectors::Rows { bytes: &bytes, stride: 13 };
            let mut codes: Vec<u8> = [0xEE].repeat(2 * len);
            encode(
                (Vectors::Columns([&x]), vectors),
                CodesMut::little_endian(&mut codes, 2),
                &mut |([numbers], v), codes| {
                    assert_eq!(numbers, v[0]);
                    encode_numbers(v, codes);
                },
            );
            assert_eq!(codes, numbers(len));

            let mut bytes = rows(len, 13, false);
            let mut decoded: Vec<f32> = [9.0].repeat(len);
            let vectors = VectorsMut::Rows { bytes: &mut bytes, stride: 13 };
            let output = (vectors, VectorsMut::Columns([&mut decoded]));
            decode(Codes::little_endian(&codes, 2), output, &mut |codes, (v, [numbers]), fence| {
                decode_numbers(codes, v, fence);
                for (to, code) in numbers.iter_mut().zip(codes.bytes.as_chunks().0) {
                    *to = u16::from_le_bytes(*code).into();
                }
            });
            assert_eq!((bytes, decoded), (rows(len, 13, true), x));
        }
    }

    #[test]
    fn pairs_of_columns_are_passed_on_whole() {
        let (x, codes) = ([1.0f32; MANY + 5], [0u16; MANY + 5]);
        let columns = Vectors::Columns([&x[..]]);
        assert!((columns, columns).direct().is_some());
        let rows = Vectors::<3>::rows(&[[1.0; 3]; 2]);
        assert!((columns, rows).direct().is_none() && (rows, columns).direct().is_none());
        let [mut a, mut b] = [[0.0f32; MANY + 5]; 2];
        let output = (VectorsMut::Columns([&mut a]), VectorsMut::Columns([&mut b]));
        decode(Codes::native(&codes), output, &mut |codes, ([a], [b]), _| {
            assert_eq!([codes.len(), a.len(), b.len()], [MANY + 5; 3]);
        });
    }

    /// Room is as long as a part, and parts come in order, columns too.
    #[test]
    fn parts_have_room() {
        for len in LENGTHS {
            let x: Vec<f32> = (0..len).map(|i| i as f32).collect();
            let mut codes: Vec<u8> = [0xEE].repeat(2 * len);
            let mut count = 0;
            let input = Vectors::Columns([&x]);
            encode_in_parts(
                input,
                CodesMut::little_endian(&mut codes, 2),
                &mut |[x], codes, room| {
                    let [a, b] = room;
                    assert!(x[0] == count as f32 && x.len() <= MANY);
                    assert_eq!([a.len(), b.len()], [x.len(); 2]);
                    count += x.len();
                    for (to, x) in codes.bytes.as_chunks_mut().0.iter_mut().zip(x) {
                        *to = (*x as u16).to_le_bytes();
                    }
                },
            );
            assert_eq!((count, codes), (len, numbers(len)));

            let (mut decoded, codes) = ([9.0].repeat(len), numbers(len));
            let output = VectorsMut::Columns([&mut decoded]);
            decode_in_parts(Codes::little_endian(&codes, 2), output, &mut |codes, [x], [room]| {
                assert_eq!([codes.len(), room.len()], [x.len(); 2]);
                for (to, code) in x.iter_mut().zip(codes.bytes.as_chunks().0) {
                    *to = u16::from_le_bytes(*code).into();
                }
            });
            assert_eq!(decoded, x);
        }
    }

    #[test]
    fn codes_are_changed_in_place_a_part_at_a_time() {
        for len in LENGTHS {
            let mut codes: Vec<u16> = (0..len as u16).collect();
            map_codes(CodesMut::native(&mut codes), &|from, to| {
                assert_eq!([from.size, to.size], [2; 2]);
                for (from, to) in from.bytes.as_chunks().0.iter().zip(to.bytes.as_chunks_mut().0) {
                    *to = (u16::from_le_bytes(*from) + 5).to_le_bytes();
                }
            });
            assert!(codes.iter().zip(5..).all(|(code, i)| *code == i));
        }
    }

    #[test]
    fn transcoding_goes_by_way_of_vectors() {
        for len in LENGTHS {
            let (from, mut to) = (numbers(len), [0xEE].repeat(2 * len));
            transcode(
                &|codes, vectors| decode(codes, vectors, &mut decode_numbers),
                &|vectors, codes| encode(vectors, codes, &mut encode_numbers),
                Codes::little_endian(&from, 2),
                CodesMut::little_endian(&mut to, 2),
            );
            assert_eq!(from, to);
        }
    }

    #[test]
    fn vectors_are_split_at_rows() {
        fn lengths((first, others): (VectorsMut<'_, 3>, VectorsMut<'_, 3>)) -> [usize; 2] {
            [first, others].map(|vectors| match vectors {
                VectorsMut::Rows { bytes, stride: 14 } => bytes.len(),
                _ => usize::MAX,
            })
        }
        let mut bytes = [0; 40];
        // Two rows, and a third that ends early.
        for (at, expected) in [(0, [0, 40]), (2, [28, 12]), (3, [40, 0])] {
            let vectors = VectorsMut::Rows { bytes: &mut bytes, stride: 14 };
            assert_eq!(lengths(vectors.split_at(at)), expected);
        }
    }
}
