//! The public shapes of data.

use core::ops::Range;

use bytemuck::{AnyBitPattern, NoUninit};

use crate::batch::doubles::{Doubles, Keeps};
use crate::batch::layout::{CodeLayout, Codes, CodesMut, PairMut, Vectors, VectorsMut, Within};
use crate::error::StrideMismatch;

/// Vectors to read, as a structure of arrays. All three slices have one element per vector.
#[derive(Clone, Copy, Debug)]
pub struct Soa<'a> {
    /// The x components.
    pub x: &'a [f32],
    /// The y components.
    pub y: &'a [f32],
    /// The z components.
    pub z: &'a [f32],
}

/// Vectors to write, as a structure of arrays. All three slices have one element per vector.
#[derive(Debug)]
pub struct SoaMut<'a> {
    /// The x components.
    pub x: &'a mut [f32],
    /// The y components.
    pub y: &'a mut [f32],
    /// The z components.
    pub z: &'a mut [f32],
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

/// Elements to read at any alignment: element i begins at byte `offset + i * stride`. The last one may end before a whole
/// stride.
///
/// ```
/// use unitpack::{Codec, Oct32, Strided, StridedMut};
/// // Position, normal and uv: the normal begins at byte 12.
/// let vertices = [[5.0f32, 5.0, 5.0, 0.0, 0.0, 1.0, 0.5, 0.5]; 100];
/// // Position, normal and uv of the GPU: the normal begins at byte 8.
/// let mut packed = [[7u32; 4]; 100];
/// Oct32::encode_strided(Strided::of(&vertices, 12), StridedMut::of(&mut packed, 8))?;
/// assert_eq!(Oct32::decode(packed[99][2]), [0.0, 0.0, 1.0]);
/// assert_eq!(packed[99][3], 7);
/// # Ok::<(), unitpack::StrideMismatch>(())
/// ```
///
/// Vertices are often structures. With `bytemuck`'s derives `Pod` and `Zeroable` they are
/// `Strided::of(&vertices, offset_of!(Vertex, normal))`.
#[derive(Clone, Copy, Debug)]
pub struct Strided<'a> {
    /// All bytes, those between the elements too.
    pub bytes: &'a [u8],
    /// Where the first element begins.
    pub offset: usize,
    /// Bytes from one element to the next, at least those of an element: 12 for tight vectors, not 0.
    pub stride: usize,
    /// Number of elements.
    pub len: usize,
}

/// Elements to write at any alignment, as [`Strided`] has them. What lies between them stays as it is.
#[derive(Debug)]
pub struct StridedMut<'a> {
    /// All bytes, those between the elements too.
    pub bytes: &'a mut [u8],
    /// Where the first element begins.
    pub offset: usize,
    /// Bytes from one element to the next, at least those of an element: 12 for tight vectors, not 0.
    pub stride: usize,
    /// Number of elements.
    pub len: usize,
}

impl<'a> Strided<'a> {
    /// A field of all structures: `offset` is what [`offset_of!`](core::mem::offset_of) gives.
    #[inline]
    pub fn of<T: NoUninit>(structures: &'a [T], offset: usize) -> Self {
        let (stride, len) = (size_of::<T>(), structures.len());
        Strided { bytes: bytemuck::cast_slice(structures), offset, stride, len }
    }

    /// The bytes from the first element to the last, which have `size` bytes each.
    #[inline]
    pub(crate) fn elements(self, size: usize) -> Result<&'a [u8], StrideMismatch> {
        let Strided { bytes, offset, stride, len } = self;
        let range = range(bytes.len(), [offset, stride, len, size])?;
        Ok(bytes.get(range).unwrap_or_default())
    }

    /// Vectors of `K` native floats.
    #[inline]
    pub(crate) fn vectors<const K: usize>(self) -> Result<Vectors<'a, K>, StrideMismatch> {
        Ok(Vectors::Rows { bytes: self.elements(4 * K)?, stride: self.stride })
    }

    /// Vectors of `K` native floats, and as many codes to encode them to.
    #[inline]
    pub(crate) fn encoded<'c, const K: usize>(
        self,
        codes: StridedMut<'c>,
        layout: CodeLayout,
    ) -> Result<(Vectors<'a, K>, CodesMut<'c>), StrideMismatch> {
        StrideMismatch::check_lengths(self.len, codes.len)?;
        Ok((self.vectors()?, codes.codes(layout)?))
    }

    /// Vectors of three native doubles, and as many codes to encode them to.
    #[inline]
    pub(crate) fn encoded_doubles<'c>(
        self,
        keeps: Keeps,
        codes: StridedMut<'c>,
        layout: CodeLayout,
    ) -> Result<(Doubles<'a>, CodesMut<'c>), StrideMismatch> {
        StrideMismatch::check_lengths(self.len, codes.len)?;
        Ok((self.doubles(keeps)?, codes.codes(layout)?))
    }

    /// Codes, and as many vectors of `K` native floats to decode them to.
    #[inline]
    pub(crate) fn decoded<'v, const K: usize>(
        self,
        v: StridedMut<'v>,
        layout: CodeLayout,
    ) -> Result<(Codes<'a>, VectorsMut<'v, K>), StrideMismatch> {
        StrideMismatch::check_lengths(v.len, self.len)?;
        Ok((self.codes(layout)?, v.vectors()?))
    }

    /// Vectors of three native doubles.
    #[inline]
    fn doubles(self, keeps: Keeps) -> Result<Doubles<'a>, StrideMismatch> {
        Ok(Doubles { bytes: self.elements(24)?, stride: self.stride, keeps })
    }

    #[inline]
    pub(crate) fn codes(self, layout: CodeLayout) -> Result<Codes<'a>, StrideMismatch> {
        Ok(Codes::strided(self.elements(layout.size)?, layout, self.stride))
    }
}

impl<'a> StridedMut<'a> {
    /// A field of all structures: `offset` is what [`offset_of!`](core::mem::offset_of) gives.
    #[inline]
    pub fn of<T: NoUninit + AnyBitPattern>(structures: &'a mut [T], offset: usize) -> Self {
        let (stride, len) = (size_of::<T>(), structures.len());
        StridedMut { bytes: bytemuck::cast_slice_mut(structures), offset, stride, len }
    }

    /// See [`Strided::elements`].
    #[inline]
    pub(crate) fn elements(self, size: usize) -> Result<&'a mut [u8], StrideMismatch> {
        let StridedMut { bytes, offset, stride, len } = self;
        let range = range(bytes.len(), [offset, stride, len, size])?;
        Ok(bytes.get_mut(range).unwrap_or_default())
    }

    /// See [`Strided::vectors`].
    #[inline]
    pub(crate) fn vectors<const K: usize>(self) -> Result<VectorsMut<'a, K>, StrideMismatch> {
        let stride = self.stride;
        Ok(VectorsMut::Rows { bytes: self.elements(4 * K)?, stride })
    }

    #[inline]
    pub(crate) fn codes(self, layout: CodeLayout) -> Result<CodesMut<'a>, StrideMismatch> {
        let stride = self.stride;
        Ok(CodesMut::strided(self.elements(layout.size)?, layout, stride))
    }

    /// Elements with a vector of `K` floats at `offset`, and its code at `code`.
    #[inline]
    pub(crate) fn vectors_within<const K: usize>(
        self,
        code: usize,
        layout: CodeLayout,
    ) -> Result<Within<'a>, StrideMismatch> {
        let vector = self.offset;
        self.within(vector, 4 * K, code, layout)
    }

    /// Elements with a code at `offset`, and its vector of `K` floats at `vector`.
    #[inline]
    pub(crate) fn codes_within<const K: usize>(
        self,
        vector: usize,
        layout: CodeLayout,
    ) -> Result<Within<'a>, StrideMismatch> {
        let code = self.offset;
        self.within(vector, 4 * K, code, layout)
    }

    #[inline]
    fn within(
        self,
        vector: usize,
        size: usize,
        code: usize,
        layout: CodeLayout,
    ) -> Result<Within<'a>, StrideMismatch> {
        let stride = self.stride;
        let (bytes, [vector, code]) = self.fields([vector, size], [code, layout.size])?;
        Ok(Within { bytes, stride, vectors: [vector], code, layout })
    }

    /// Elements with a normal of three floats at `offset`, a tangent of four at `tangent`, and their code at `code`.
    /// For the error, normal and tangent are one field.
    pub(crate) fn frame_within(
        self,
        tangent: usize,
        code: usize,
        layout: CodeLayout,
    ) -> Result<Within<'a, 2>, StrideMismatch> {
        let (stride, normal) = (self.stride, self.offset);
        let start = normal.min(tangent);
        let end = normal.saturating_add(12).max(tangent.saturating_add(16));
        let (bytes, [vectors, code]) = self.fields([start, end - start], [code, layout.size])?;
        let vectors = [normal, tangent].map(|at| vectors + (at - start));
        Ok(Within { bytes, stride, vectors, code, layout })
    }

    /// Elements with normals of three floats at `offset`, and tangents of four at `tangent`.
    #[inline]
    pub(crate) fn pair(self, tangent: usize) -> Result<PairMut<'a>, StrideMismatch> {
        let (stride, normal) = (self.stride, self.offset);
        let (bytes, at) = self.fields([normal, 12], [tangent, 16])?;
        Ok(PairMut { bytes, stride, at })
    }

    /// From the first byte of the first element's two fields to the last byte of the last's, and where in an element they are. A
    /// field is where it begins and its size.
    fn fields(
        self,
        [first, first_size]: [usize; 2],
        [second, second_size]: [usize; 2],
    ) -> Result<(&'a mut [u8], [usize; 2]), StrideMismatch> {
        let StridedMut { bytes, stride, len, .. } = self;
        let start = first.min(second);
        let end = first.saturating_add(first_size).max(second.saturating_add(second_size));
        let size = bytes.len();
        let range =
            range(size, [start, stride, len, end - start]).map_err(|_| StrideMismatch::Fields {
                first,
                first_size,
                second,
                second_size,
                stride,
                len,
                bytes: size,
            })?;
        Ok((bytes.get_mut(range).unwrap_or_default(), [first - start, second - start]))
    }
}

/// Where elements of `size` bytes lie in so many bytes.
#[inline]
fn range(
    bytes: usize,
    [offset, stride, len, size]: [usize; 4],
) -> Result<Range<usize>, StrideMismatch> {
    let Some(last) = len.checked_sub(1) else { return Ok(0..0) };
    if stride < size {
        return Err(StrideMismatch::Stride { offset, stride, len, size, bytes });
    }
    let end = last.checked_mul(stride).and_then(|at| at.checked_add(offset)?.checked_add(size));
    match end {
        Some(end) if end <= bytes => Ok(offset..end),
        _ => Err(StrideMismatch::Bounds { offset, stride, len, size, bytes }),
    }
}
