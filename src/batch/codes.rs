//! Codes in memory: dense or at a stride, little-endian or of native integers.

use bytemuck::Pod;

use super::storage::{CodeSlice, CodeSliceMut, MAX_CODE, copy, swap_if_big_endian};

/// How a code lies in bytes.
#[derive(Clone, Copy)]
pub struct CodeLayout {
    /// Size of a code in bytes.
    pub(crate) size: usize,
    /// Size of the native integers that a code consists of, or 1 if they are little-endian.
    native: usize,
}

impl CodeLayout {
    #[inline]
    pub(crate) fn native<C: Pod>() -> Self {
        CodeLayout { size: size_of::<C>(), native: align_of::<C>() }
    }

    #[inline]
    pub(crate) fn little_endian(size: usize) -> Self {
        CodeLayout { size, native: 1 }
    }
}

/// Codes to read.
#[derive(Clone, Copy)]
pub struct Codes<'a> {
    bytes: &'a [u8],
    layout: CodeLayout,
    /// A code begins every so many bytes, at least its size. The last one may end before a whole stride.
    stride: usize,
}

/// Codes to write. What lies between them stays.
pub struct CodesMut<'a> {
    bytes: &'a mut [u8],
    layout: CodeLayout,
    /// See [`Codes`].
    stride: usize,
}

/// Room for `LEN` codes, made when it is needed.
pub(super) type Room<const LEN: usize> = Option<[[u8; MAX_CODE]; LEN]>;

impl<'a> Codes<'a> {
    #[inline]
    pub(crate) fn native<C: Pod>(codes: &'a [C]) -> Self {
        Codes::dense(bytemuck::cast_slice(codes), CodeLayout::native::<C>())
    }

    #[inline]
    pub(crate) fn little_endian(bytes: &'a [u8], size: usize) -> Self {
        Codes::dense(bytes, CodeLayout::little_endian(size))
    }

    /// Codes without gaps.
    #[inline]
    pub(super) fn dense(bytes: &'a [u8], layout: CodeLayout) -> Self {
        Codes { bytes, layout, stride: layout.size }
    }

    /// One code every `stride` bytes.
    #[inline]
    pub(crate) fn strided(bytes: &'a [u8], layout: CodeLayout, stride: usize) -> Self {
        Codes { bytes, layout, stride }
    }

    pub(super) fn len(self) -> usize {
        count(self.bytes.len(), self.layout.size, self.stride)
    }

    /// Size of a code in bytes.
    pub(crate) fn size(self) -> usize {
        self.layout.size
    }

    /// At most `len` codes at a time.
    pub(crate) fn parts(self, len: usize) -> impl Iterator<Item = Self> {
        self.bytes
            .chunks(len.saturating_mul(self.stride).max(1))
            .map(move |bytes| Codes { bytes, ..self })
    }

    /// Code after code, little-endian.
    #[inline(always)]
    pub(super) fn each<const SIZE: usize>(self) -> impl Iterator<Item = [u8; SIZE]> {
        self.bytes.as_chunks().0.iter().map(move |code| {
            let mut code = *code;
            swap_if_big_endian(&mut code, self.layout.native);
            code
        })
    }

    /// The codes, if they are dense and little-endian.
    #[inline]
    pub(super) fn direct(self) -> Option<CodeSlice<'a>> {
        let Codes { bytes, layout: CodeLayout { size, native }, stride } = self;
        let fits = stride == size && (cfg!(target_endian = "little") || native == 1);
        fits.then_some(CodeSlice { bytes, size })
    }

    /// Calls a kernel with codes, at most `LEN` of them.
    pub(super) fn read<const LEN: usize>(
        self,
        room: &mut Room<LEN>,
        kernel: impl FnOnce(CodeSlice<'_>),
    ) {
        if let Some(codes) = self.direct() {
            return kernel(codes);
        }
        let Codes { bytes, layout: CodeLayout { size, native }, stride } = self;
        let room = room.get_or_insert([[0; MAX_CODE]; LEN]).as_flattened_mut();
        if let Some(dense) = room.get_mut(..self.len() * size) {
            gather(bytes, size, stride, dense);
            swap_if_big_endian(dense, native);
            kernel(CodeSlice { bytes: dense, size });
        }
    }
}

impl<'a> From<CodeSlice<'a>> for Codes<'a> {
    #[inline]
    fn from(codes: CodeSlice<'a>) -> Self {
        Codes::little_endian(codes.bytes, codes.size)
    }
}

impl<'a> CodesMut<'a> {
    #[inline]
    pub(crate) fn native<C: Pod>(codes: &'a mut [C]) -> Self {
        CodesMut::dense(bytemuck::cast_slice_mut(codes), CodeLayout::native::<C>())
    }

    #[inline]
    pub(crate) fn little_endian(bytes: &'a mut [u8], size: usize) -> Self {
        CodesMut::dense(bytes, CodeLayout::little_endian(size))
    }

    /// Codes without gaps.
    #[inline]
    pub(super) fn dense(bytes: &'a mut [u8], layout: CodeLayout) -> Self {
        CodesMut { bytes, layout, stride: layout.size }
    }

    /// One code every `stride` bytes.
    #[inline]
    pub(crate) fn strided(bytes: &'a mut [u8], layout: CodeLayout, stride: usize) -> Self {
        CodesMut { bytes, layout, stride }
    }

    pub(crate) fn len(&self) -> usize {
        count(self.bytes.len(), self.layout.size, self.stride)
    }

    /// Whether they are dense.
    #[inline]
    pub(super) fn is_dense(&self) -> bool {
        self.stride == self.layout.size
    }

    /// At most `len` codes at a time.
    pub(super) fn parts(self, len: usize) -> impl Iterator<Item = Self> {
        let CodesMut { bytes, layout, stride } = self;
        let parts = bytes.chunks_mut(len.saturating_mul(stride).max(1));
        parts.map(move |bytes| CodesMut { bytes, layout, stride })
    }

    /// Lets a kernel write dense codes.
    #[inline]
    pub(super) fn write_dense(self, kernel: impl FnOnce(CodeSliceMut<'_>)) {
        let CodesMut { bytes, layout: CodeLayout { size, native }, .. } = self;
        kernel(CodeSliceMut { bytes: &mut *bytes, size });
        swap_if_big_endian(bytes, native);
    }

    /// Lets a kernel write codes, at most `LEN` of them.
    pub(super) fn write<const LEN: usize>(
        self,
        room: &mut Room<LEN>,
        kernel: impl FnOnce(CodeSliceMut<'_>),
    ) {
        if self.is_dense() {
            return self.write_dense(kernel);
        }
        let len = self.len();
        let CodesMut { bytes, layout: CodeLayout { size, native }, stride } = self;
        let room = room.get_or_insert([[0; MAX_CODE]; LEN]).as_flattened_mut();
        if let Some(dense) = room.get_mut(..len * size) {
            kernel(CodeSliceMut { bytes: &mut *dense, size });
            swap_if_big_endian(dense, native);
            scatter(dense, bytes, size, stride);
        }
    }

    /// Gives a kernel dense codes, at most `LEN`, to read, and to write over them.
    pub(super) fn update<const LEN: usize>(
        self,
        room: &mut Room<LEN>,
        kernel: impl FnOnce(CodeSlice<'_>, CodeSliceMut<'_>),
    ) {
        let CodesMut { bytes, layout: CodeLayout { size, native }, .. } = self;
        let room = room.get_or_insert([[0; MAX_CODE]; LEN]).as_flattened_mut();
        if let Some(before) = room.get_mut(..bytes.len()) {
            copy(bytes, before);
            swap_if_big_endian(before, native);
            kernel(CodeSlice { bytes: before, size }, CodeSliceMut { bytes: &mut *bytes, size });
            swap_if_big_endian(bytes, native);
        }
    }
}

impl<'a> From<CodeSliceMut<'a>> for CodesMut<'a> {
    #[inline]
    fn from(codes: CodeSliceMut<'a>) -> Self {
        CodesMut::little_endian(codes.bytes, codes.size)
    }
}

/// Number of codes in so many bytes.
fn count(bytes: usize, size: usize, stride: usize) -> usize {
    bytes.saturating_add(stride.saturating_sub(size)).checked_div(stride).unwrap_or(0)
}

/// Calls a function with a code's size as its constant.
macro_rules! by_size {
    ($size:expr, $copy:ident($($argument:expr),*)) => {
        match $size {
            1 => $copy::<1>($($argument),*),
            2 => $copy::<2>($($argument),*),
            3 => $copy::<3>($($argument),*),
            4 => $copy::<4>($($argument),*),
            6 => $copy::<6>($($argument),*),
            8 => $copy::<8>($($argument),*),
            12 => $copy::<12>($($argument),*),
            _ => {}
        }
    };
}

/// Dense codes from those at a stride.
#[inline(never)]
pub(super) fn gather(bytes: &[u8], size: usize, stride: usize, dense: &mut [u8]) {
    #[inline(always)]
    fn copy<const SIZE: usize>(bytes: &[u8], stride: usize, dense: &mut [u8]) {
        for (to, from) in
            dense.as_chunks_mut::<SIZE>().0.iter_mut().zip(bytes.chunks(stride.max(1)))
        {
            if let Some(from) = from.first_chunk() {
                *to = *from;
            }
        }
    }
    by_size!(size, copy(bytes, stride, dense));
}

/// Dense codes to those at a stride.
#[inline(never)]
pub(super) fn scatter(dense: &[u8], bytes: &mut [u8], size: usize, stride: usize) {
    #[inline(always)]
    fn copy<const SIZE: usize>(dense: &[u8], bytes: &mut [u8], stride: usize) {
        for (from, to) in dense.as_chunks::<SIZE>().0.iter().zip(bytes.chunks_mut(stride.max(1))) {
            if let Some(to) = to.first_chunk_mut() {
                *to = *from;
            }
        }
    }
    by_size!(size, copy(dense, bytes, stride));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

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
    fn the_last_code_may_end_before_a_whole_stride() {
        let codes = |len| Codes::strided(&[0; 40][..len], CodeLayout::little_endian(3), 7);
        assert_eq!([0, 3, 10, 14, 17].map(|len| codes(len).len()), [0, 1, 2, 2, 3]);
        let sizes: Vec<usize> = codes(17).parts(2).map(Codes::len).collect();
        assert_eq!(sizes, [2, 1]);
    }

    #[test]
    fn what_lies_between_codes_stays() {
        for size in [1, 2, 3, 4, 6, 8, 12] {
            for stride in size + 1..size + 5 {
                let mut bytes: Vec<u8> = [0xEE].repeat(3 * stride + size);
                let codes = CodesMut::strided(&mut bytes, CodeLayout::little_endian(size), stride);
                codes.write::<4>(&mut None, |codes| {
                    assert_eq!(codes.bytes.len(), 4 * size);
                    codes.bytes.iter_mut().zip(1..).for_each(|(byte, i)| *byte = i);
                });
                for (i, byte) in bytes.iter().enumerate() {
                    let (row, at) = (i / stride, i % stride);
                    let wanted = if at < size { (row * size + at + 1) as u8 } else { 0xEE };
                    assert_eq!(*byte, wanted);
                }
                let codes = Codes::strided(&bytes, CodeLayout::little_endian(size), stride);
                codes.read::<4>(&mut None, |codes| {
                    assert!(codes.bytes.iter().copied().eq(1..=4 * size as u8));
                });
            }
        }
    }
}
