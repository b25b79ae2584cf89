//! The one place where layouts meet: brings vectors and codes of any layout into the form that
//! kernels take, a few at a time.

use bytemuck::Pod;

use super::columns::{Rows, RowsMut};
use super::storage::{CodeBytes, Word, swap_if_big_endian};
use super::{Kernel, map};
use crate::simd::Simd;
use crate::simd::stream::{self, Fence};

/// Elements that are converted at a time: more where each part costs a check of the processor.
pub(crate) const PART: usize = if cfg!(feature = "std") { 256 } else { 64 };

/// Size of the largest code in bytes.
const MAX_CODE: usize = 12;

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

/// Codes to read, without gaps.
#[derive(Clone, Copy)]
pub struct Codes<'a> {
    bytes: &'a [u8],
    size: usize,
    /// Size of the native integers that a code consists of, or 1 if they are little-endian.
    native: usize,
}

/// Codes to write, without gaps.
pub struct CodesMut<'a> {
    bytes: &'a mut [u8],
    size: usize,
    /// See [`Codes`].
    native: usize,
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

impl<'a> Codes<'a> {
    #[inline]
    pub(crate) fn native<C: Pod>(codes: &'a [C]) -> Self {
        let bytes = bytemuck::cast_slice(codes);
        Codes { bytes, size: size_of::<C>(), native: align_of::<C>() }
    }

    #[inline]
    pub(crate) fn little_endian(bytes: &'a [u8], size: usize) -> Self {
        Codes { bytes, size, native: 1 }
    }
}

impl<'a> CodesMut<'a> {
    #[inline]
    pub(crate) fn native<C: Pod>(codes: &'a mut [C]) -> Self {
        let bytes = bytemuck::cast_slice_mut(codes);
        CodesMut { bytes, size: size_of::<C>(), native: align_of::<C>() }
    }

    #[inline]
    pub(crate) fn little_endian(bytes: &'a mut [u8], size: usize) -> Self {
        CodesMut { bytes, size, native: 1 }
    }
}

/// Encodes vectors of any layout. The kernel gives codes of `kernel_size` bytes: their own size or, as
/// words, 4.
#[inline(never)]
pub(crate) fn encode<const K: usize>(
    kernel: &dyn Fn([&[f32]; K], &mut [u8]),
    kernel_size: usize,
    vectors: Vectors<'_, K>,
    codes: CodesMut<'_>,
) {
    let CodesMut { bytes, size, native } = codes;
    match vectors {
        Vectors::Columns(columns) if kernel_size == size => kernel(columns, bytes),
        _ => {
            let mut buffer = [[0.0; PART]; K];
            let mut words = [0; 4 * PART];
            for (part, bytes) in bytes.chunks_mut((PART * size).max(1)).enumerate() {
                let len = bytes.len().checked_div(size).unwrap_or(0);
                let columns = vectors.part(part * PART, len, &mut buffer);
                if kernel_size == size {
                    kernel(columns, bytes);
                } else if let Some(words) = words.get_mut(..4 * len) {
                    kernel(columns, words);
                    narrow(words, bytes, size);
                }
            }
        }
    }
    swap_if_big_endian(bytes, native);
}

/// What a decoding kernel does: writes the vectors of codes. The fence is dropped after it returns.
pub(crate) type DecodeColumns<'k, const K: usize> =
    &'k dyn for<'a> Fn(&[u8], [&'a mut [f32]; K], &Fence<'a>);

/// A closure as a decoding kernel, whose lifetimes rustc does not infer.
#[inline(always)]
pub(crate) fn decode_kernel<F, const K: usize>(kernel: F) -> F
where
    F: for<'a> Fn(&[u8], [&'a mut [f32]; K], &Fence<'a>),
{
    kernel
}

/// Decodes to vectors of any layout. The kernel takes codes of `kernel_size` bytes: their own size or,
/// as words, 4.
#[inline(never)]
pub(crate) fn decode<const K: usize>(
    kernel: DecodeColumns<'_, K>,
    kernel_size: usize,
    mut codes: Codes<'_>,
    mut vectors: VectorsMut<'_, K>,
) {
    let is_direct = codes.is_direct(kernel_size);
    let mut buffer = [[0.0; PART]; K];
    let mut code_buffer = [0; MAX_CODE * PART];
    let fence = Fence::new(vectors.is_large());
    let part_len = if is_direct && vectors.is_columns() { usize::MAX } else { PART };
    // Streaming stores begin after the vectors that are not aligned.
    let mut unaligned = if fence.streams() { vectors.unaligned() } else { 0 };
    while codes.len() > 0 {
        let len = if unaligned > 0 { unaligned } else { part_len };
        let (codes_part, vectors_part);
        (codes_part, codes) = codes.split_at(len);
        (vectors_part, vectors) = vectors.split_at(len);
        let bytes = if is_direct {
            codes_part.bytes
        } else {
            codes_part.load(kernel_size, &mut code_buffer)
        };
        match vectors_part {
            VectorsMut::Columns(columns) => kernel(bytes, columns, &fence),
            rows => rows.write(&mut buffer, |columns| kernel(bytes, columns, &Fence::new(false))),
        }
        unaligned = 0;
    }
}

/// Decodes codes and encodes them again, a part at a time.
#[inline(never)]
pub(crate) fn transcode(
    decode: &dyn Fn(Codes<'_>, VectorsMut<'_, 3>),
    encode: &dyn Fn(Vectors<'_, 3>, CodesMut<'_>),
    from: Codes<'_>,
    to: CodesMut<'_>,
) {
    let mut buffer = [[0.0; PART]; 3];
    for (from, bytes) in from.parts().zip(to.bytes.chunks_mut((PART * to.size).max(1))) {
        let len = from.len();
        if let Some(columns) = columns_mut(&mut buffer, len) {
            decode(from, VectorsMut::Columns(columns));
        }
        let codes = CodesMut { bytes, size: to.size, native: to.native };
        encode(Vectors::Columns(columns(&buffer, len)), codes);
    }
}

/// Changes codes in place. The kernel takes and gives codes of `kernel_size` bytes: their own size or,
/// as words, 4.
#[inline(never)]
pub(crate) fn map_codes(
    kernel: &dyn Fn(&[u8], &mut [u8]),
    kernel_size: usize,
    codes: CodesMut<'_>,
) {
    let CodesMut { bytes, size, native } = codes;
    let (mut input, mut output) = ([0; MAX_CODE * PART], [0; MAX_CODE * PART]);
    for bytes in bytes.chunks_mut((PART * size).max(1)) {
        let part = Codes { bytes, size, native };
        let Some(changed) = output.get_mut(..part.len() * kernel_size) else { return };
        kernel(part.load(kernel_size, &mut input), changed);
        if kernel_size == size {
            copy(changed, bytes);
        } else {
            narrow(changed, bytes, size);
        }
        swap_if_big_endian(bytes, native);
    }
}

impl<'a> Codes<'a> {
    pub(crate) fn len(self) -> usize {
        self.bytes.len().checked_div(self.size).unwrap_or(0)
    }

    /// Whether a kernel can read them as they are.
    fn is_direct(self, kernel_size: usize) -> bool {
        kernel_size == self.size && (cfg!(target_endian = "little") || self.native == 1)
    }

    /// At most [`PART`] codes at a time.
    pub(crate) fn parts(self) -> impl Iterator<Item = Self> {
        self.bytes.chunks((PART * self.size).max(1)).map(move |bytes| Codes { bytes, ..self })
    }

    fn split_at(self, len: usize) -> (Self, Self) {
        let at = len.saturating_mul(self.size).min(self.bytes.len());
        let (before, after) = self.bytes.split_at(at);
        (Codes { bytes: before, ..self }, Codes { bytes: after, ..self })
    }

    /// Calls a kernel that takes codes of their own size with at most [`PART`] of them.
    pub(crate) fn with_kernel_bytes(self, kernel: impl FnOnce(&[u8])) {
        if self.is_direct(self.size) {
            kernel(self.bytes);
        } else {
            kernel(self.load(self.size, &mut [0; MAX_CODE * PART]));
        }
    }

    /// At most [`PART`] codes as a kernel takes them.
    fn load<'b>(self, kernel_size: usize, buffer: &'b mut [u8; MAX_CODE * PART]) -> &'b [u8] {
        let Some(loaded) = buffer.get_mut(..self.len() * kernel_size) else { return &[] };
        if cfg!(target_endian = "big") && self.native > 1 {
            let mut little_endian = [0; MAX_CODE * PART];
            let Some(copied) = little_endian.get_mut(..self.bytes.len()) else { return &[] };
            copy(self.bytes, copied);
            swap_if_big_endian(copied, self.native);
            widen_or_copy(copied, self.size, loaded, kernel_size);
        } else {
            widen_or_copy(self.bytes, self.size, loaded, kernel_size);
        }
        loaded
    }
}

impl<'a> CodesMut<'a> {
    pub(crate) fn len(&self) -> usize {
        self.bytes.len().checked_div(self.size).unwrap_or(0)
    }

    /// At most [`PART`] codes at a time.
    pub(crate) fn parts(self) -> impl Iterator<Item = Self> {
        let CodesMut { bytes, size, native } = self;
        bytes.chunks_mut((PART * size).max(1)).map(move |bytes| CodesMut { bytes, size, native })
    }

    /// Lets a kernel write codes of their own size.
    pub(crate) fn write(self, kernel: impl FnOnce(&mut [u8])) {
        kernel(self.bytes);
        swap_if_big_endian(self.bytes, self.native);
    }
}

impl<'a, const K: usize> VectorsMut<'a, K> {
    fn is_columns(&self) -> bool {
        matches!(self, VectorsMut::Columns(_))
    }

    /// Whether stores should stream.
    fn is_large(&self) -> bool {
        match self {
            VectorsMut::Columns(columns) => {
                columns.first().is_some_and(|x| stream::is_large(K * size_of_val::<[f32]>(x)))
            }
            VectorsMut::Rows { .. } => false,
        }
    }

    /// Number of vectors before the first whose x can be streamed to. All columns are alike if they
    /// begin alike.
    fn unaligned(&self) -> usize {
        match self {
            VectorsMut::Columns(columns) => columns
                .first()
                .map_or(0, |x| x.as_ptr().align_offset(stream::ALIGNMENT).min(x.len()).min(PART)),
            VectorsMut::Rows { .. } => 0,
        }
    }

    /// The first `len` vectors, and the others.
    pub(crate) fn split_at(self, len: usize) -> (Self, Self) {
        match self {
            VectorsMut::Columns(columns) => {
                let (mut first, mut others) = (empty(), empty());
                for ((column, first), others) in
                    columns.into_iter().zip(&mut first).zip(&mut others)
                {
                    (*first, *others) = column.split_at_mut(len.min(column.len()));
                }
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

    /// Writes columns. Rows, at most [`PART`], are written by way of `buffer`.
    pub(crate) fn write(self, buffer: &mut [[f32; PART]; K], write: impl FnOnce([&mut [f32]; K])) {
        match self {
            VectorsMut::Columns(columns) => write(columns),
            VectorsMut::Rows { bytes, stride } => {
                let len = bytes.len().div_ceil(stride.max(1));
                if let Some(columns) = columns_mut(buffer, len) {
                    write(columns);
                    scatter(buffer, len, bytes, stride);
                }
            }
        }
    }
}

fn empty<'a, const K: usize>() -> [&'a mut [f32]; K] {
    [(); K].map(|()| &mut [][..])
}

impl<const K: usize> Vectors<'_, K> {
    /// `len` vectors from the one at `first` on, at most [`PART`].
    pub(crate) fn part<'b>(
        &'b self,
        first: usize,
        len: usize,
        buffer: &'b mut [[f32; PART]; K],
    ) -> [&'b [f32]; K] {
        match *self {
            Vectors::Columns(columns) => {
                columns.map(|column| column.get(first..first + len).unwrap_or_default())
            }
            Vectors::Rows { bytes, stride } => {
                let rows = bytes.get(first * stride..).unwrap_or_default();
                gather(rows, stride, buffer, len);
                self::columns(buffer, len)
            }
        }
    }
}

/// The first `len` elements of each column.
pub(crate) fn columns<const K: usize>(buffer: &[[f32; PART]; K], len: usize) -> [&[f32]; K] {
    buffer.each_ref().map(|column| column.get(..len).unwrap_or_default())
}

/// The first `len` elements of each column, or `None` if there are fewer.
pub(crate) fn columns_mut<const K: usize>(
    buffer: &mut [[f32; PART]; K],
    len: usize,
) -> Option<[&mut [f32]; K]> {
    (len <= PART).then(|| buffer.each_mut().map(|column| column.get_mut(..len).unwrap_or_default()))
}

/// From rows to columns.
fn gather<const K: usize>(rows: &[u8], stride: usize, columns: &mut [[f32; PART]; K], len: usize) {
    let Some(to) = columns_mut(columns, len) else { return };
    if stride == 4 * K {
        gather_rows::<K, K>(rows, to);
    } else if stride == 16 && K == 3 {
        gather_rows::<4, K>(rows, to);
    } else {
        for (i, row) in rows.chunks(stride.max(1)).take(len).enumerate() {
            for (column, c) in columns.iter_mut().zip(row.as_chunks().0) {
                if let Some(to) = column.get_mut(i) {
                    *to = f32::from_ne_bytes(*c);
                }
            }
        }
    }
}

/// From columns to rows, whose other bytes stay.
fn scatter<const K: usize>(columns: &[[f32; PART]; K], len: usize, rows: &mut [u8], stride: usize) {
    let from = self::columns(columns, len);
    if stride == 4 * K {
        scatter_rows::<K, K>(from, rows);
    } else if stride == 16 && K == 3 {
        scatter_rows::<4, K>(from, rows);
    } else {
        for (i, row) in rows.chunks_mut(stride.max(1)).take(len).enumerate() {
            for (column, c) in columns.iter().zip(row.as_chunks_mut().0) {
                if let Some(from) = column.get(i) {
                    *c = from.to_ne_bytes();
                }
            }
        }
    }
}

#[inline(never)]
fn gather_rows<const N: usize, const K: usize>(rows: &[u8], to: [&mut [f32]; K]) {
    let len = to[0].len();
    let rows = rows.as_chunks().0.as_chunks().0;
    map(Transpose, Rows::<N, K>(rows.get(..len).unwrap_or_default()), to);
}

#[inline(never)]
fn scatter_rows<const N: usize, const K: usize>(from: [&[f32]; K], rows: &mut [u8]) {
    map(Transpose, from, RowsMut::<N, K>(rows.as_chunks_mut().0.as_chunks_mut().0));
}

/// Between rows and columns.
struct Transpose;

impl<'a, const N: usize, const K: usize> Kernel<'a, Rows<'_, N, K>, [&'a mut [f32]; K]>
    for Transpose
{
    // It has no shuffles; the compiler does better with a scalar loop.
    const USE_WIDE: bool = false;

    #[inline(always)]
    fn run<V: Simd>(&self, vectors: [V; K]) -> [V; K] {
        vectors
    }
}

impl<'a, const N: usize, const K: usize> Kernel<'a, [&[f32]; K], RowsMut<'a, N, K>> for Transpose {
    const USE_WIDE: bool = false;

    #[inline(always)]
    fn run<V: Simd>(&self, vectors: [V; K]) -> [V; K] {
        vectors
    }
}

/// From words to codes of 1 to 3 bytes.
#[inline(never)]
fn narrow(words: &[u8], codes: &mut [u8], size: usize) {
    let words = words.as_chunks::<4>().0;
    match size {
        1 => map(Resize, words, codes.as_chunks_mut::<1>().0),
        2 => map(Resize, words, codes.as_chunks_mut::<2>().0),
        _ => map(Resize, words, codes.as_chunks_mut::<3>().0),
    }
}

/// From codes of 1 to 3 bytes to words, or from codes to themselves.
#[inline(never)]
fn widen_or_copy(codes: &[u8], size: usize, words: &mut [u8], kernel_size: usize) {
    if size == kernel_size {
        return copy(codes, words);
    }
    let words = words.as_chunks_mut::<4>().0;
    match size {
        1 => map(Resize, codes.as_chunks::<1>().0, words),
        2 => map(Resize, codes.as_chunks::<2>().0, words),
        _ => map(Resize, codes.as_chunks::<3>().0, words),
    }
}

/// Between codes and words.
struct Resize;

impl<'a, A: CodeBytes<Shape = Word>, B: CodeBytes<Shape = Word>> Kernel<'a, &[A], &'a mut [B]>
    for Resize
{
    #[inline(always)]
    fn run<V: Simd>(&self, code: V::Int) -> V::Int {
        code
    }
}

/// As many elements as both have.
#[inline(always)]
fn copy(from: &[u8], to: &mut [u8]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}
