//! Codecs chosen at run time.

use core::fmt;
use core::str::FromStr;

use super::{Codec, Format};
use crate::batch::layout::{self, Codes, CodesMut};
use crate::error::LengthMismatch;
use crate::vector::{Soa, SoaMut};

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
