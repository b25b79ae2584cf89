//! The one place where layouts meet: brings vectors and codes of any layout into the form that
//! kernels take, a few at a time.

use bytemuck::Pod;

use super::columns::{Columns, Input, Output, QUAD, RowSlice, RowSliceMut, Rows, Strided, empty};
use super::storage::{CodeSlice, CodeSliceMut, MAX_CODE, copy, swap_if_big_endian};
use super::{Kernel, map};
use crate::simd::stream::{self, Fence};
use crate::simd::{Simd, Use};
use crate::vector::{Soa, SoaMut};

/// Elements that are converted at a time: more where each part costs a check of the processor.
pub(crate) const PART: usize = if cfg!(feature = "std") { 256 } else { FEW };
/// The same, where nothing else needs room.
pub(crate) const MANY: usize = if cfg!(feature = "std") { 1024 } else { FEW };
/// A part of so few that the room for it costs little.
pub(crate) const FEW: usize = 64;

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

impl<'a> From<Soa<'a>> for Vectors<'a, 3> {
    #[inline]
    fn from(v: Soa<'a>) -> Self {
        Vectors::Columns([v.x, v.y, v.z])
    }
}

impl<'a> From<SoaMut<'a>> for VectorsMut<'a, 3> {
    #[inline]
    fn from(v: SoaMut<'a>) -> Self {
        VectorsMut::Columns([v.x, v.y, v.z])
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
        self.codes.len()
    }

    /// At most `len` codes at a time.
    pub(crate) fn parts(self, len: usize) -> impl Iterator<Item = Self> {
        let Codes { codes: CodeSlice { bytes, size }, native } = self;
        bytes
            .chunks((len * size).max(1))
            .map(move |bytes| Codes { codes: CodeSlice { bytes, size }, native })
    }

    /// Whether their bytes are little-endian.
    #[inline]
    pub(crate) fn is_direct(self) -> bool {
        cfg!(target_endian = "little") || self.native == 1
    }

    /// Calls a kernel with codes, at most [`MANY`] of them.
    pub(crate) fn read(self, kernel: impl FnOnce(CodeSlice<'_>)) {
        if self.is_direct() {
            return kernel(self.codes);
        }
        let CodeSlice { bytes, size } = self.codes;
        let mut buffer = [0; MAX_CODE * MANY];
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

    /// At most `len` codes at a time.
    pub(crate) fn parts(self, len: usize) -> impl Iterator<Item = Self> {
        let CodesMut { codes: CodeSliceMut { bytes, size }, native } = self;
        bytes
            .chunks_mut((len * size).max(1))
            .map(move |bytes| CodesMut { codes: CodeSliceMut { bytes, size }, native })
    }

    /// Lets a kernel write codes.
    #[inline]
    pub(crate) fn write(self, kernel: impl FnOnce(CodeSliceMut<'_>)) {
        let CodeSliceMut { bytes, size } = self.codes;
        kernel(CodeSliceMut { bytes: &mut *bytes, size });
        swap_if_big_endian(bytes, self.native);
    }
}

/// Encodes vectors of any layout. Inlined, so that a program has no code for layouts it does not use.
#[inline]
pub(crate) fn encode<const K: usize>(
    vectors: Vectors<'_, K>,
    codes: CodesMut<'_>,
    kernel: &dyn Fn([&[f32]; K], CodeSliceMut<'_>),
) {
    match vectors {
        Vectors::Columns(columns) => codes.write(|codes| kernel(columns, codes)),
        Vectors::Rows { .. } => encode_rows(vectors, codes, kernel),
    }
}

#[inline(never)]
fn encode_rows<const K: usize>(
    vectors: Vectors<'_, K>,
    codes: CodesMut<'_>,
    kernel: &dyn Fn([&[f32]; K], CodeSliceMut<'_>),
) {
    if codes.len() <= FEW {
        encode_parts::<K, FEW>(vectors, codes, kernel);
    } else {
        encode_parts::<K, MANY>(vectors, codes, kernel);
    }
}

#[inline(never)]
fn encode_parts<const K: usize, const PART: usize>(
    vectors: Vectors<'_, K>,
    codes: CodesMut<'_>,
    kernel: &dyn Fn([&[f32]; K], CodeSliceMut<'_>),
) {
    let mut buffer = [[0.0; PART]; K];
    for (part, codes) in codes.parts(PART).enumerate() {
        let columns = vectors.part(part * PART, codes.len(), &mut buffer);
        codes.write(|codes| kernel(columns, codes));
    }
}

/// What decodes to columns. Its caller drops the fence.
type DecodeKernel<'k, const K: usize> = &'k dyn Fn(CodeSlice<'_>, [&mut [f32]; K], &Fence);

/// Decodes to vectors of any layout. Inlined as [`encode`].
#[inline]
pub(crate) fn decode<const K: usize>(
    codes: Codes<'_>,
    vectors: VectorsMut<'_, K>,
    kernel: DecodeKernel<'_, K>,
) {
    match vectors {
        VectorsMut::Columns(columns) if codes.is_direct() => {
            decode_columns(codes.codes, columns, kernel);
        }
        _ => decode_rows(codes, vectors, kernel),
    }
}

#[inline(never)]
fn decode_rows<const K: usize>(
    codes: Codes<'_>,
    vectors: VectorsMut<'_, K>,
    kernel: DecodeKernel<'_, K>,
) {
    if codes.len() <= FEW {
        decode_parts::<K, FEW>(codes, vectors, kernel);
    } else {
        decode_parts::<K, MANY>(codes, vectors, kernel);
    }
}

#[inline(never)]
fn decode_columns<const K: usize>(
    codes: CodeSlice<'_>,
    columns: [&mut [f32]; K],
    kernel: DecodeKernel<'_, K>,
) {
    let bytes = columns.first().map_or(0, |x| K * size_of::<f32>() * x.len());
    if !stream::is_large(bytes) {
        return kernel(codes, columns, &Fence::new(false));
    }
    // Streaming begins after the vectors whose x is not aligned. Columns are alike if they begin
    // alike.
    let unaligned =
        columns.first().map_or(0, |x| x.as_ptr().align_offset(stream::ALIGNMENT).min(x.len()));
    if let Some((unaligned_codes, codes)) = codes.split_at(unaligned)
        && let Some((unaligned, columns)) = split_columns(columns, unaligned)
    {
        kernel(unaligned_codes, unaligned, &Fence::new(false));
        kernel(codes, columns, &Fence::new(true));
    }
}

#[inline(never)]
fn decode_parts<const K: usize, const PART: usize>(
    codes: Codes<'_>,
    mut vectors: VectorsMut<'_, K>,
    kernel: DecodeKernel<'_, K>,
) {
    let mut buffer = [[0.0; PART]; K];
    for codes in codes.parts(PART) {
        let part;
        (part, vectors) = vectors.split_at(codes.len());
        codes.read(|codes| {
            part.write(&mut buffer, |columns| kernel(codes, columns, &Fence::new(false)));
        });
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
    for (from, to) in from.parts(PART).zip(to.parts(PART)) {
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
    for part in codes.parts(PART) {
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
    /// The first `len` vectors, and the others. No vectors if there are fewer.
    pub(crate) fn split_at(self, len: usize) -> (Self, Self) {
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

    /// Writes columns. Rows, at most `PART`, are written by way of `buffer`.
    pub(crate) fn write<const PART: usize>(
        self,
        buffer: &mut [[f32; PART]; K],
        write: impl FnOnce([&mut [f32]; K]),
    ) {
        match self {
            VectorsMut::Columns(columns) => write(columns),
            VectorsMut::Rows { bytes, stride } => {
                let len = bytes.len().div_ceil(stride.max(1));
                if let Some(to) = columns_mut(buffer, len) {
                    write(to);
                    scatter(columns(buffer, len), bytes, stride);
                }
            }
        }
    }
}

impl<const K: usize> Vectors<'_, K> {
    /// `len` vectors from the one at `first` on, at most `PART`.
    pub(crate) fn part<'b, const PART: usize>(
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

/// The first `len` elements of each column.
pub(crate) fn columns<const K: usize, const PART: usize>(
    buffer: &[[f32; PART]; K],
    len: usize,
) -> [&[f32]; K] {
    buffer.each_ref().map(|column| column.get(..len).unwrap_or_default())
}

/// The first `len` elements of each column, or `None` if there are fewer.
pub(crate) fn columns_mut<const K: usize, const PART: usize>(
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
                encode(vectors, CodesMut::little_endian(&mut codes, 2), &encode_numbers);
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
                decode(Codes::little_endian(&codes, 2), vectors, &decode_numbers);
                assert_eq!(bytes, rows(len, stride, true), "{len} of {stride}");
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
        encode(Vectors::rows(&vectors), CodesMut::native(&mut codes), &encode_numbers);
        assert_eq!(codes, [0, 1, 2, 3, 4]);
        let mut decoded = [[9.0f32; 4]; 5];
        decode(Codes::native(&codes), VectorsMut::rows(&mut decoded), &decode_numbers);
        assert_eq!(decoded, vectors);
    }

    #[test]
    fn columns_are_passed_on() {
        let [mut x, mut y, mut z] = [[0.0f32; 3]; 3];
        let codes = Codes::native(&[7u16, 8, 9]);
        decode(codes, VectorsMut::Columns([&mut x, &mut y, &mut z]), &decode_numbers);
        assert_eq!([x[2], y[2], z[2]], vector(9));
        let mut back = [0u16; 3];
        encode(Vectors::Columns([&x, &y, &z]), CodesMut::native(&mut back), &encode_numbers);
        assert_eq!(back, [7, 8, 9]);
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
                &|codes, vectors| decode(codes, vectors, &decode_numbers),
                &|vectors, codes| encode(vectors, codes, &encode_numbers),
                Codes::little_endian(&from, 2),
                CodesMut::little_endian(&mut to, 2),
            );
            assert_eq!(from, to);
        }
    }

    #[test]
    fn codes_are_counted_by_their_size() {
        assert_eq!(Codes::native(&[[0u16; 3]; 5]).len(), 5);
        assert_eq!(Codes::little_endian(&[0; 10], 3).len(), 3);
        assert_eq!(Codes::little_endian(&[], 3).parts(2).count(), 0);
        let sizes: Vec<usize> =
            Codes::little_endian(&[0; 15], 3).parts(2).map(Codes::len).collect();
        assert_eq!(sizes, [2, 2, 1]);
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
