//! Vectors whose axes have another order than the codec's.

use super::sealed::Chosen;
use crate::batch::layout::{self, Codes, CodesMut, Vectors, VectorsMut};
use crate::error::StrideMismatch;
use crate::vector::{Strided, StridedMut};

/// Which of a caller's components a codec has as its x, y and z: `Zxy` encodes (z, x, y).
///
/// Batches permute nothing for it, they only take the columns in that order. For structures of arrays it needs no help:
/// `Soa { x: &z, y: &x, z: &y }`. An array of vectors is [`Strided::of`]`(&vectors, 0)`. What an iterator gives is mapped
/// by [`apply`](AxisOrder::apply), and what it decodes by [`undo`](AxisOrder::undo).
///
/// ```
/// use unitpack::{AxisOrder, Codec, HemiOct16, Strided, StridedMut};
/// // Terrain with y up, in a format of the upper half.
/// let normals = [[0.0, 1.0, 0.0], [0.6, 0.8, 0.0]];
/// let mut codes = [0u16; 2];
/// let order = AxisOrder::Zxy;
/// order.encode_strided(HemiOct16, Strided::of(&normals, 0), StridedMut::of(&mut codes, 0))?;
/// assert_eq!(codes[0], HemiOct16::encode([0.0, 0.0, 1.0]));
/// assert_eq!(order.undo(HemiOct16::decode(codes[0])), [0.0, 1.0, 0.0]);
/// # Ok::<(), unitpack::StrideMismatch>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum AxisOrder {
    /// As they are.
    #[default]
    Xyz,
    /// The codec's (x, y, z) are the caller's (x, z, y).
    Xzy,
    /// The codec's (x, y, z) are the caller's (y, x, z).
    Yxz,
    /// The codec's (x, y, z) are the caller's (y, z, x).
    Yzx,
    /// The codec's (x, y, z) are the caller's (z, x, y): a caller's y axis is the codec's z.
    Zxy,
    /// The codec's (x, y, z) are the caller's (z, y, x).
    Zyx,
}

impl AxisOrder {
    /// Every order.
    pub const ALL: [AxisOrder; 6] = [
        AxisOrder::Xyz,
        AxisOrder::Xzy,
        AxisOrder::Yxz,
        AxisOrder::Yzx,
        AxisOrder::Zxy,
        AxisOrder::Zyx,
    ];

    /// The codec's components of a caller's vector: what to encode.
    #[inline]
    pub fn apply(self, v: [f32; 3]) -> [f32; 3] {
        self.columns(v)
    }

    /// The caller's components of a codec's vector: of what was decoded.
    #[inline]
    pub fn undo(self, v: [f32; 3]) -> [f32; 3] {
        match self {
            AxisOrder::Yzx => AxisOrder::Zxy.columns(v),
            AxisOrder::Zxy => AxisOrder::Yzx.columns(v),
            // Swaps.
            order => order.columns(v),
        }
    }

    #[inline]
    fn columns<T>(self, [x, y, z]: [T; 3]) -> [T; 3] {
        match self {
            AxisOrder::Xyz => [x, y, z],
            AxisOrder::Xzy => [x, z, y],
            AxisOrder::Yxz => [y, x, z],
            AxisOrder::Yzx => [y, z, x],
            AxisOrder::Zxy => [z, x, y],
            AxisOrder::Zyx => [z, y, x],
        }
    }

    /// [`Codec::encode_strided`](super::Codec::encode_strided) in this order, with `codec` a codec, such as `Oct16`, for
    /// native codes, or a [`Format`](super::Format) for little-endian ones.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    pub fn encode_strided(
        self,
        codec: impl Chosen,
        v: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded(codes, codec.code_layout())?;
        self.encode(codec, v, codes);
        Ok(())
    }

    /// [`Codec::encode_strided_precise`](super::Codec::encode_strided_precise) in this order: see
    /// [`encode_strided`](Self::encode_strided).
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    pub fn encode_strided_precise(
        self,
        codec: impl Chosen,
        v: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded(codes, codec.code_layout())?;
        self.encode_precise(codec, v, codes);
        Ok(())
    }

    /// [`Codec::decode_strided`](super::Codec::decode_strided) in this order: see [`encode_strided`](Self::encode_strided).
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    pub fn decode_strided(
        self,
        codec: impl Chosen,
        codes: Strided<'_>,
        v: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (codes, v) = codes.decoded(v, codec.code_layout())?;
        self.decode(codec, codes, v);
        Ok(())
    }

    /// [`Codec::encode_within`](super::Codec::encode_within) in this order: see [`encode_strided`](Self::encode_strided).
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or vector and code together are longer than the stride;
    /// nothing is written then.
    #[inline]
    pub fn encode_within(
        self,
        codec: impl Chosen,
        v: StridedMut<'_>,
        code_offset: usize,
    ) -> Result<(), StrideMismatch> {
        let within = v.vectors_within::<3>(code_offset, codec.code_layout())?;
        layout::encode_within(within, &|v, codes| self.encode(codec, v, codes));
        Ok(())
    }

    /// [`Codec::encode_within_precise`](super::Codec::encode_within_precise) in this order: see
    /// [`encode_strided`](Self::encode_strided).
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or vector and code together are longer than the stride;
    /// nothing is written then.
    #[inline]
    pub fn encode_within_precise(
        self,
        codec: impl Chosen,
        v: StridedMut<'_>,
        code_offset: usize,
    ) -> Result<(), StrideMismatch> {
        let within = v.vectors_within::<3>(code_offset, codec.code_layout())?;
        layout::encode_within(within, &|v, codes| self.encode_precise(codec, v, codes));
        Ok(())
    }

    /// [`Codec::decode_within`](super::Codec::decode_within) in this order: see [`encode_strided`](Self::encode_strided).
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or vector and code together are longer than the stride;
    /// nothing is written then.
    #[inline]
    pub fn decode_within(
        self,
        codec: impl Chosen,
        codes: StridedMut<'_>,
        vector_offset: usize,
    ) -> Result<(), StrideMismatch> {
        let within = codes.codes_within::<3>(vector_offset, codec.code_layout())?;
        layout::decode_within(within, &|codes, v| self.decode(codec, codes, v));
        Ok(())
    }

    #[inline]
    fn encode(self, codec: impl Chosen, v: Vectors<'_, 3>, codes: CodesMut<'_>) {
        layout::encode(v, codes, &mut |v, codes| codec.encode_chosen(self.columns(v), codes));
    }

    #[inline]
    fn encode_precise(self, codec: impl Chosen, v: Vectors<'_, 3>, codes: CodesMut<'_>) {
        layout::encode(v, codes, &mut |v, codes| {
            codec.encode_chosen_precise(self.columns(v), codes);
        });
    }

    #[inline]
    fn decode(self, codec: impl Chosen, codes: Codes<'_>, v: VectorsMut<'_, 3>) {
        layout::decode(codes, v, &mut |codes, v, fence| {
            codec.decode_chosen(codes, self.columns(v), fence);
        });
    }
}
