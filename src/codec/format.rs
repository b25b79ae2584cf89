//! Codecs chosen at run time: what is the same for all. [`Format`] itself stands beside the table,
//! in `codec.rs`.

use core::fmt;
use core::str::FromStr;

use crate::batch::{DecodeBytes, EncodeBytes};
use crate::{Codec, Format, LengthMismatch, Soa, SoaMut};

/// Something to do with a codec whose type is known only at run time: see [`Format::visit`].
pub trait Visitor {
    /// What it gives.
    type Output;
    /// Called once, with the codec's type.
    fn visit<C: Codec>(self) -> Self::Output;
}

impl Format {
    /// Encodes as [`Codec::encode_soa`] does, to little-endian codes without gaps, at any
    /// alignment.
    ///
    /// `bytes` is [`code_size`](Format::code_size) times as long as `v.x`, `v.y` and `v.z`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    #[inline]
    pub fn encode(self, v: Soa<'_>, bytes: &mut [u8]) -> Result<(), LengthMismatch> {
        self.visit(EncodeBytes::<false> { v, bytes })
    }

    /// Encodes as [`Codec::encode_soa_precise`] does, to little-endian codes without gaps, at any
    /// alignment.
    ///
    /// `bytes` is [`code_size`](Format::code_size) times as long as `v.x`, `v.y` and `v.z`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    #[inline]
    pub fn encode_precise(self, v: Soa<'_>, bytes: &mut [u8]) -> Result<(), LengthMismatch> {
        self.visit(EncodeBytes::<true> { v, bytes })
    }

    /// Decodes little-endian codes without gaps, at any alignment, as [`Codec::decode_soa`] does.
    ///
    /// `bytes` is [`code_size`](Format::code_size) times as long as `v.x`, `v.y` and `v.z`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    #[inline]
    pub fn decode(self, bytes: &[u8], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        self.visit(DecodeBytes { bytes, v })
    }

    /// The format of a name as [`name`](Format::name) gives it. ASCII case does not matter.
    #[inline]
    pub fn from_name(name: &str) -> Option<Format> {
        Format::ALL.iter().copied().find(|f| f.name().eq_ignore_ascii_case(name))
    }
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
