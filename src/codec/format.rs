//! Codecs chosen at run time.

use core::fmt;
use core::str::FromStr;

use super::{Codec, Format};
use crate::batch::doubles::Doubles;
use crate::batch::layout::{self, CodeLayout, Codes, CodesMut, Vectors, VectorsMut};
use crate::error::{LengthMismatch, StrideMismatch};
use crate::vector::{Soa, SoaMut, Strided, StridedMut};

/// Something to do with a codec whose type is known only at run time: see [`Format::visit`].
pub trait Visitor {
    /// The result of the visit.
    type Output;
    /// Called once, with the codec's type.
    fn visit<C: Codec>(self) -> Self::Output;
}

impl Format {
    /// Encodes as [`Codec::encode_soa`] does, to tightly packed little-endian codes at any alignment.
    ///
    /// `bytes.len()` must be [`code_size`](Format::code_size) times the length of `v.x`, `v.y` and `v.z`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    pub fn encode(self, v: Soa<'_>, bytes: &mut [u8]) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_bytes([v.x.len(), v.y.len(), v.z.len()], bytes.len(), size)?;
        self.encode_batch(v.into(), CodesMut::little_endian(bytes, size));
        Ok(())
    }

    /// Encodes as [`Codec::encode_soa_precise`] does, to tightly packed little-endian codes at any
    /// alignment.
    ///
    /// `bytes.len()` must be [`code_size`](Format::code_size) times the length of `v.x`, `v.y` and `v.z`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    pub fn encode_precise(self, v: Soa<'_>, bytes: &mut [u8]) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_bytes([v.x.len(), v.y.len(), v.z.len()], bytes.len(), size)?;
        self.encode_batch_precise(v.into(), CodesMut::little_endian(bytes, size));
        Ok(())
    }

    /// Decodes tightly packed little-endian codes at any alignment, as [`Codec::decode_soa`] does.
    ///
    /// `bytes.len()` must be [`code_size`](Format::code_size) times the length of `v.x`, `v.y` and `v.z`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    pub fn decode(self, bytes: &[u8], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_bytes([v.x.len(), v.y.len(), v.z.len()], bytes.len(), size)?;
        self.decode_batch(Codes::little_endian(bytes, size), v.into());
        Ok(())
    }

    /// Encodes as [`Codec::encode_aos`] does, to tightly packed little-endian codes at any alignment.
    ///
    /// `bytes.len()` must be [`code_size`](Format::code_size) times `v.len()`. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    #[inline]
    pub fn encode_aos<const N: usize>(
        self,
        v: &[[f32; N]],
        bytes: &mut [u8],
    ) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_aos_bytes(v.len(), bytes.len(), size)?;
        self.encode_batch(Vectors::rows(v), CodesMut::little_endian(bytes, size));
        Ok(())
    }

    /// Encodes as [`Codec::encode_aos_precise`] does, as [`encode_aos`](Format::encode_aos) takes vectors and codes.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    #[inline]
    pub fn encode_aos_precise<const N: usize>(
        self,
        v: &[[f32; N]],
        bytes: &mut [u8],
    ) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_aos_bytes(v.len(), bytes.len(), size)?;
        self.encode_batch_precise(Vectors::rows(v), CodesMut::little_endian(bytes, size));
        Ok(())
    }

    /// Decodes as [`Codec::decode_aos`] does, as [`encode_aos`](Format::encode_aos) takes vectors and codes.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    #[inline]
    pub fn decode_aos<const N: usize>(
        self,
        bytes: &[u8],
        v: &mut [[f32; N]],
    ) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_aos_bytes(v.len(), bytes.len(), size)?;
        self.decode_batch(Codes::little_endian(bytes, size), VectorsMut::rows(v));
        Ok(())
    }

    /// Encodes as [`Codec::encode_strided`] does, to little-endian codes.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided(
        self,
        v: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded(codes, self.layout())?;
        self.encode_batch(v, codes);
        Ok(())
    }

    /// Encodes as [`Codec::encode_strided_precise`] does, to little-endian codes.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided_precise(
        self,
        v: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded(codes, self.layout())?;
        self.encode_batch_precise(v, codes);
        Ok(())
    }

    /// Decodes little-endian codes, as [`Codec::decode_strided`] does.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn decode_strided(
        self,
        codes: Strided<'_>,
        v: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (codes, v) = codes.decoded(v, self.layout())?;
        self.decode_batch(codes, v);
        Ok(())
    }

    /// Encodes in place as [`Codec::encode_within`] does, to little-endian codes.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or vector and code together are longer than the stride;
    /// nothing is written then.
    pub fn encode_within(
        self,
        v: StridedMut<'_>,
        code_offset: usize,
    ) -> Result<(), StrideMismatch> {
        let within = v.vectors_within::<3>(code_offset, self.layout())?;
        layout::encode_within(within, &|v, codes| self.encode_batch(v, codes));
        Ok(())
    }

    /// Encodes in place as [`Codec::encode_within_precise`] does, to little-endian codes.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or vector and code together are longer than the stride;
    /// nothing is written then.
    pub fn encode_within_precise(
        self,
        v: StridedMut<'_>,
        code_offset: usize,
    ) -> Result<(), StrideMismatch> {
        let within = v.vectors_within::<3>(code_offset, self.layout())?;
        layout::encode_within(within, &|v, codes| self.encode_batch_precise(v, codes));
        Ok(())
    }

    /// Decodes little-endian codes in place, as [`Codec::decode_within`] does.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or vector and code together are longer than the stride;
    /// nothing is written then.
    pub fn decode_within(
        self,
        codes: StridedMut<'_>,
        vector_offset: usize,
    ) -> Result<(), StrideMismatch> {
        let within = codes.codes_within::<3>(vector_offset, self.layout())?;
        layout::decode_within(within, &|codes, v| self.decode_batch(codes, v));
        Ok(())
    }

    /// Encodes as [`Codec::encode_aos_f64`] does, to tightly packed little-endian codes at any alignment.
    ///
    /// `bytes.len()` must be [`code_size`](Format::code_size) times `v.len()`. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    #[inline]
    pub fn encode_aos_f64<const N: usize>(
        self,
        v: &[[f64; N]],
        bytes: &mut [u8],
    ) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_aos_bytes(v.len(), bytes.len(), size)?;
        self.encode_doubles(Doubles::rows(v, self.keeps()), CodesMut::little_endian(bytes, size));
        Ok(())
    }

    /// Encodes as [`Codec::encode_aos_f64_precise`] does, as [`encode_aos_f64`](Format::encode_aos_f64) takes vectors and
    /// codes.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    #[inline]
    pub fn encode_aos_f64_precise<const N: usize>(
        self,
        v: &[[f64; N]],
        bytes: &mut [u8],
    ) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_aos_bytes(v.len(), bytes.len(), size)?;
        self.encode_doubles_precise(
            Doubles::rows(v, self.keeps()),
            CodesMut::little_endian(bytes, size),
        );
        Ok(())
    }

    /// Encodes as [`Codec::encode_strided_f64`] does, to little-endian codes.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided_f64(
        self,
        v: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded_doubles(self.keeps(), codes, self.layout())?;
        self.encode_doubles(v, codes);
        Ok(())
    }

    /// Encodes as [`Codec::encode_strided_f64_precise`] does, to little-endian codes.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided_f64_precise(
        self,
        v: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded_doubles(self.keeps(), codes, self.layout())?;
        self.encode_doubles_precise(v, codes);
        Ok(())
    }

    #[inline]
    pub(super) fn layout(self) -> CodeLayout {
        CodeLayout::little_endian(self.code_size())
    }

    #[inline(never)]
    fn encode_batch(self, vectors: Vectors<'_, 3>, codes: CodesMut<'_>) {
        layout::encode(vectors, codes, &mut |v, codes| self.encode_columns(v, codes));
    }

    #[inline(never)]
    fn encode_batch_precise(self, vectors: Vectors<'_, 3>, codes: CodesMut<'_>) {
        layout::encode(vectors, codes, &mut |v, codes| self.encode_columns_precise(v, codes));
    }

    #[inline(never)]
    fn encode_doubles(self, vectors: Doubles<'_>, codes: CodesMut<'_>) {
        layout::encode(vectors, codes, &mut |v, codes| self.encode_columns(v, codes));
    }

    #[inline(never)]
    fn encode_doubles_precise(self, vectors: Doubles<'_>, codes: CodesMut<'_>) {
        layout::encode(vectors, codes, &mut |v, codes| self.encode_columns_precise(v, codes));
    }

    #[inline(never)]
    pub(crate) fn decode_batch(self, codes: Codes<'_>, vectors: VectorsMut<'_, 3>) {
        layout::decode(codes, vectors, &mut |codes, v, fence| self.decode_columns(codes, v, fence));
    }

    /// The format whose name, as [`name`](Format::name) gives it, this is. ASCII case does not matter.
    #[inline]
    pub fn from_name(name: &str) -> Option<Format> {
        Format::ALL.iter().copied().find(|f| f.name().eq_ignore_ascii_case(name))
    }
}

/// Decodes codes of `A` and encodes them as `B` with the fast encoder, without a buffer between.
///
/// `dst` must be as long as `src`; otherwise nothing is written.
///
/// # Errors
/// [`LengthMismatch`] if the lengths differ.
#[inline]
pub fn transcode<A: Codec, B: Codec>(
    src: &[A::Code],
    dst: &mut [B::Code],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_transcode(src.len(), dst.len())?;
    layout::transcode(
        &A::decode_batch,
        &B::encode_batch,
        Codes::native(src),
        CodesMut::native(dst),
    );
    Ok(())
}

/// A name that no format has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownFormat(());

impl fmt::Display for UnknownFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "no format has this name; the names are those of Format::ALL, such as \"oct16\"",
        )
    }
}

impl core::error::Error for UnknownFormat {}

impl FromStr for Format {
    type Err = UnknownFormat;
    #[inline]
    fn from_str(name: &str) -> Result<Self, UnknownFormat> {
        Format::from_name(name).ok_or(UnknownFormat(()))
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
