//! The one place where layouts meet: brings vectors and codes of any layout into the form that
//! kernels take, a few at a time.

use bytemuck::Pod;

use super::columns::{Columns, Rows};
use super::storage::{CodeSlice, CodeSliceMut, MAX_CODE, copy, swap_if_big_endian};
use super::{Kernel, map};
use crate::simd::Simd;
use crate::simd::stream::{self, Fence};

/// Elements that are converted at a time: more where each part costs a check of the processor.
pub(crate) const PART: usize = if cfg!(feature = "std") { 256 } else { 64 };

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
    codes: CodeSlice<'a>,
    /// Size of the native integers that a code consists of, or 1 if they are little-endian.
    native: usize,
}

/// Codes to write, without gaps.
pub struct CodesMut<'a> {
    codes: CodeSliceMut<'a>,
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
        Codes { codes: CodeSlice { bytes, size: size_of::<C>() }, native: align_of::<C>() }
    }

    #[inline]
    pub(crate) fn little_endian(bytes: &'a [u8], size: usize) -> Self {
        Codes { codes: CodeSlice { bytes, size }, native: 1 }
    }

    pub(crate) fn len(self) -> usize {
        self.codes.bytes.len().checked_div(self.codes.size).unwrap_or(0)
    }

    /// At most [`PART`] codes at a time.
    pub(crate) fn parts(self) -> impl Iterator<Item = Self> {
        let Codes { codes: CodeSlice { bytes, size }, native } = self;
        bytes
            .chunks((PART * size).max(1))
            .map(move |bytes| Codes { codes: CodeSlice { bytes, size }, native })
    }

    /// The first `len` codes, and the others.
    fn split_at(self, len: usize) -> (Self, Self) {
        let CodeSlice { bytes, size } = self.codes;
        let (first, others) = bytes.split_at(len.saturating_mul(size).min(bytes.len()));
        let codes = |bytes| Codes { codes: CodeSlice { bytes, size }, ..self };
        (codes(first), codes(others))
    }

    /// Whether their bytes are little-endian.
    fn is_direct(self) -> bool {
        cfg!(target_endian = "little") || self.native == 1
    }

    /// Calls a kernel with codes, at most [`PART`] of them.
    pub(crate) fn read(self, kernel: impl FnOnce(CodeSlice<'_>)) {
        if self.is_direct() {
            return kernel(self.codes);
        }
        let CodeSlice { bytes, size } = self.codes;
        let mut buffer = [0; MAX_CODE * PART];
        if let Some(swapped) = buffer.get_mut(..bytes.len()) {
            copy(bytes, swapped);
            swap_if_big_endian(swapped, self.native);
            kernel(CodeSlice { bytes: swapped, size });
        }
    }
}

impl<'a> CodesMut<'a> {
    #[inline]
    pub(crate) fn native<C: Pod>(codes: &'a mut [C]) -> Self {
        let bytes = bytemuck::cast_slice_mut(codes);
        CodesMut { codes: CodeSliceMut { bytes, size: size_of::<C>() }, native: align_of::<C>() }
    }

    #[inline]
    pub(crate) fn little_endian(bytes: &'a mut [u8], size: usize) -> Self {
        CodesMut { codes: CodeSliceMut { bytes, size }, native: 1 }
    }

    pub(crate) fn len(&self) -> usize {
        self.codes.bytes.len().checked_div(self.codes.size).unwrap_or(0)
    }

    /// At most [`PART`] codes at a time.
    pub(crate) fn parts(self) -> impl Iterator<Item = Self> {
        let CodesMut { codes: CodeSliceMut { bytes, size }, native } = self;
        bytes
            .chunks_mut((PART * size).max(1))
            .map(move |bytes| CodesMut { codes: CodeSliceMut { bytes, size }, native })
    }

    /// Lets a kernel write codes.
    pub(crate) fn write(self, kernel: impl FnOnce(CodeSliceMut<'_>)) {
        let CodeSliceMut { bytes, size } = self.codes;
        kernel(CodeSliceMut { bytes: &mut *bytes, size });
        swap_if_big_endian(bytes, self.native);
    }
}

/// Encodes vectors of any layout.
#[inline(never)]
pub(crate) fn encode<const K: usize>(
    vectors: Vectors<'_, K>,
    codes: CodesMut<'_>,
    kernel: &dyn Fn([&[f32]; K], CodeSliceMut<'_>),
) {
    if let Vectors::Columns(columns) = vectors {
        return codes.write(|codes| kernel(columns, codes));
    }
    let mut buffer = [[0.0; PART]; K];
    for (part, codes) in codes.parts().enumerate() {
        let columns = vectors.part(part * PART, codes.len(), &mut buffer);
        codes.write(|codes| kernel(columns, codes));
    }
}

/// Decodes to vectors of any layout. Of what the kernel streams, the fence is dropped here.
#[inline(never)]
pub(crate) fn decode<const K: usize>(
    mut codes: Codes<'_>,
    mut vectors: VectorsMut<'_, K>,
    kernel: &dyn Fn(CodeSlice<'_>, [&mut [f32]; K], &Fence),
) {
    let mut buffer = [[0.0; PART]; K];
    let fence = Fence::new(vectors.is_large());
    let part_len = if codes.is_direct() && vectors.is_columns() { usize::MAX } else { PART };
    // Streaming stores begin after the vectors that are not aligned.
    let mut unaligned = if fence.streams() { vectors.unaligned() } else { 0 };
    while codes.len() > 0 {
        let len = if unaligned > 0 { unaligned } else { part_len };
        let (codes_part, vectors_part);
        (codes_part, codes) = codes.split_at(len);
        (vectors_part, vectors) = vectors.split_at(len);
        codes_part.read(|codes| {
            vectors_part.write(&mut buffer, |columns| kernel(codes, columns, &fence));
        });
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
    for (from, to) in from.parts().zip(to.parts()) {
        let len = from.len();
        if let Some(columns) = columns_mut(&mut buffer, len) {
            decode(from, VectorsMut::Columns(columns));
        }
        encode(Vectors::Columns(columns(&buffer, len)), to);
    }
}

/// Changes codes in place.
#[inline(never)]
pub(crate) fn map_codes(codes: CodesMut<'_>, kernel: &dyn Fn(CodeSlice<'_>, CodeSliceMut<'_>)) {
    let mut buffer = [0; MAX_CODE * PART];
    for part in codes.parts() {
        let native = part.native;
        let CodeSliceMut { bytes, size } = part.codes;
        if let Some(before) = buffer.get_mut(..bytes.len()) {
            copy(bytes, before);
            swap_if_big_endian(before, native);
            kernel(CodeSlice { bytes: before, size }, CodeSliceMut { bytes: &mut *bytes, size });
            swap_if_big_endian(bytes, native);
        }
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
    let len = to.first().map_or(0, |column| column.len());
    let rows = rows.as_chunks().0.as_chunks().0.get(..len).unwrap_or_default();
    map::<Rows<N, K>, Columns<K>>(Transpose, rows, to);
}

#[inline(never)]
fn scatter_rows<const N: usize, const K: usize>(from: [&[f32]; K], rows: &mut [u8]) {
    let rows = rows.as_chunks_mut().0.as_chunks_mut().0;
    map::<Columns<K>, Rows<N, K>>(Transpose, from, rows);
}

/// Between rows and columns.
struct Transpose;

impl<const N: usize, const K: usize> Kernel<Rows<N, K>, Columns<K>> for Transpose {
    // It has no shuffles; the compiler does better with a scalar loop.
    const USE_WIDE: bool = false;

    #[inline(always)]
    fn run<V: Simd>(&self, vectors: [V; K]) -> [V; K] {
        vectors
    }
}

impl<const N: usize, const K: usize> Kernel<Columns<K>, Rows<N, K>> for Transpose {
    const USE_WIDE: bool = false;

    #[inline(always)]
    fn run<V: Simd>(&self, vectors: [V; K]) -> [V; K] {
        vectors
    }
}
