//! Rotations of any width, chosen at run time.

use super::chart::{OneWord, TwoWords};
use super::formula::{self, Rotation};
use super::near::{To, decode_near, near};
use super::plain::Plain;
use super::smallest_three::SmallestThree;
use super::{Soa4, Soa4Mut};
use crate::batch::layout::{CodeLayout, Codes, CodesMut, Vectors, VectorsMut};
use crate::batch::storage::{DoubleWords, OneLane, Word, Words, Words2};
use crate::error::{LengthMismatch, StrideMismatch};
use crate::formula::support::bits::snorm_max;
use crate::formula::support::sanitize::sanitize4;
use crate::vector::{Strided, StridedMut};

/// A format of rotations with any number of bits for each component: the smallest three, or plain quaternions.
///
/// A code is an integer of [`bits`](QuaternionFormat::bits) bits. In bytes it is little-endian and has
/// [`code_size`](QuaternionFormat::code_size) of them. [`pack_dense`](crate::packing::pack_dense) packs codes without gaps.
/// Inputs are as those of [`QuaternionCodec`](super::QuaternionCodec). All entry points give the same bits.
///
/// ```
/// use unitpack::quaternion::{QuaternionCodec, QuaternionFormat, SmallestThree32};
/// let q = [0.0, 0.6, 0.0, 0.8];
/// // 9 bits a component, as netcode has it: 29 bits.
/// let format = QuaternionFormat::smallest_three(9).ok_or("not from 4 to 20")?;
/// let code = format.encode_precise(q);
/// assert!(code < 1 << 29);
/// assert!((format.decode(code)[1] - 0.6).abs() < 2e-3);
///
/// let ten = QuaternionFormat::smallest_three(10).ok_or("not from 4 to 20")?;
/// assert_eq!(ten.encode(q), u64::from(SmallestThree32::encode(q)));
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct QuaternionFormat {
    bits: u32,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Kind {
    SmallestThree,
    Snorm,
}

/// Does something with the formula of a format, and the kind of its codes.
macro_rules! with_formula {
    ($format:expr, |$formula:ident, $codes:ident| $body:expr) => {
        match ($format.kind, $format.bits) {
            (Kind::SmallestThree, bits) if bits <= 10 => {
                type $codes = Words;
                let $formula = SmallestThree::<OneWord>::in_one_word(bits);
                $body
            }
            (Kind::SmallestThree, bits) => {
                type $codes = DoubleWords;
                let $formula = SmallestThree::<TwoWords>::in_two_words(bits, 3 * bits);
                $body
            }
            (Kind::Snorm, bits) if bits <= 8 => {
                type $codes = Words;
                let $formula = Plain::<Word>::in_one_word(bits);
                $body
            }
            (Kind::Snorm, bits) => {
                type $codes = DoubleWords;
                let $formula = Plain::<Words2>::in_two_words(bits);
                $body
            }
        }
    };
}

impl QuaternionFormat {
    /// The smallest three with 4 to 20 bits for each of three components, otherwise `None`.
    ///
    /// The three components that are left are snorm in two's complement, in the order x, y, z, w, the first in the low
    /// bits. The two bits above them tell which component is left out, 0 to 3 for x to w. With 10 bits it is
    /// [`SmallestThree32`](super::SmallestThree32).
    ///
    /// Both encoders are stable: a buffer that is decoded and encoded keeps its bytes.
    #[inline]
    pub const fn smallest_three(bits: u32) -> Option<Self> {
        let fits = 4 <= bits && bits <= 20;
        if fits { Some(QuaternionFormat { bits, kind: Kind::SmallestThree }) } else { None }
    }

    /// Plain quaternions: all four components as snorm with 4 to 16 bits each, otherwise `None`.
    ///
    /// They are in two's complement and in the order x, y, z, w, x in the low bits: as glTF, Unreal and others have them
    /// in four bytes or shorts. Decoding divides by the length. Encoders negate q where that makes the last component
    /// that is not zero positive. `encode` rounds each component; `encode_precise` gives the nearest rotation of any length, at 8 bits
    /// 0.12 degrees off in the mean, where rounding is 0.43. It tries all lengths: one quaternion takes 0.4 µs at 8 bits, 10 at
    /// 12 and 150 at 16.
    ///
    /// `encode_precise` is stable, `encode` is not.
    #[inline]
    pub const fn snorm(bits: u32) -> Option<Self> {
        let fits = 4 <= bits && bits <= 16;
        if fits { Some(QuaternionFormat { bits, kind: Kind::Snorm }) } else { None }
    }

    /// Number of significant bits of a code. The others are zero, and ignored in decoding.
    #[inline]
    pub const fn bits(self) -> u32 {
        match self.kind {
            Kind::SmallestThree => 3 * self.bits + 2,
            Kind::Snorm => 4 * self.bits,
        }
    }

    /// Size of a code in bytes: 2, 3, 4, 6 or 8, the least that holds its bits.
    #[inline]
    pub const fn code_size(self) -> usize {
        DoubleWords::size_of(self.bits())
    }

    /// A bound of the greatest error of `encode`, in degrees of rotation.
    #[inline]
    pub const fn max_error_degrees(self) -> f64 {
        let steps = snorm_max(self.bits) as f64;
        match self.kind {
            Kind::SmallestThree => 142.0 / steps + 4e-5,
            // Twice the arc sine of one step: each component is half of one off, at most.
            Kind::Snorm => 114.7 / steps + 20.0 / (steps * steps * steps) + 2e-5,
        }
    }

    /// A bound of the greatest error of `encode_precise`, in degrees of rotation.
    #[inline]
    pub const fn max_error_precise_degrees(self) -> f64 {
        let steps = snorm_max(self.bits) as f64;
        match self.kind {
            Kind::SmallestThree => 82.0 / steps + 2e-5,
            Kind::Snorm => 114.7 / steps + 2e-5,
        }
    }

    #[inline]
    fn layout(self) -> CodeLayout {
        CodeLayout::little_endian(self.code_size())
    }

    /// Packs a quaternion of any length, rounding each component to nearest, ties to even.
    #[inline]
    pub fn encode(self, q: [f32; 4]) -> u64 {
        with_formula!(self, |formula, _Codes| formula.encode::<f32>(sanitize4(q)).to_u64())
    }

    /// Packs a quaternion of any length into the code that decodes closest to its rotation, up to `f32` rounding.
    #[inline]
    pub fn encode_precise(self, q: [f32; 4]) -> u64 {
        with_formula!(self, |formula, _Codes| formula.encode_precise::<f32>(sanitize4(q)).to_u64())
    }

    /// Unpacks a code, any bit pattern, into a quaternion of length 1 to 2.5e-7.
    #[inline]
    pub fn decode(self, code: u64) -> [f32; 4] {
        with_formula!(self, |formula, _Codes| formula.decode::<f32>(OneLane::from_u64(code)))
    }

    /// [`decode`](QuaternionFormat::decode), or the opposite if that is nearer to `previous`: see
    /// [`QuaternionCodec::decode_near`](super::QuaternionCodec::decode_near).
    #[inline]
    pub fn decode_near(self, code: u64, previous: [f32; 4]) -> [f32; 4] {
        near(self.decode(code), previous)
    }

    /// The code that `encode_precise` gives for the rotation of `code`, any bit pattern.
    #[inline]
    pub fn canonical(self, code: u64) -> u64 {
        with_formula!(self, |formula, _Codes| {
            formula.canonical::<f32>(OneLane::from_u64(code)).to_u64()
        })
    }

    /// [`encode`](QuaternionFormat::encode) for structures of arrays, to little-endian codes without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless the four slices are equally long and `bytes` has `code_size` for each; nothing is
    /// written then.
    pub fn encode_soa(self, q: Soa4<'_>, bytes: &mut [u8]) -> Result<(), LengthMismatch> {
        q.check_bytes(bytes.len(), self.code_size())?;
        self.encode_batch(q.into(), CodesMut::little_endian(bytes, self.code_size()));
        Ok(())
    }

    /// [`encode_precise`](QuaternionFormat::encode_precise) for structures of arrays, as
    /// [`encode_soa`](QuaternionFormat::encode_soa) takes them.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless the four slices are equally long and `bytes` has `code_size` for each; nothing is
    /// written then.
    pub fn encode_soa_precise(self, q: Soa4<'_>, bytes: &mut [u8]) -> Result<(), LengthMismatch> {
        q.check_bytes(bytes.len(), self.code_size())?;
        self.encode_batch_precise(q.into(), CodesMut::little_endian(bytes, self.code_size()));
        Ok(())
    }

    /// [`decode`](QuaternionFormat::decode) for structures of arrays, from little-endian codes without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless the four slices are equally long and `bytes` has `code_size` for each; nothing is
    /// written then.
    pub fn decode_soa(self, bytes: &[u8], q: Soa4Mut<'_>) -> Result<(), LengthMismatch> {
        q.check_bytes(bytes.len(), self.code_size())?;
        self.decode_batch(Codes::little_endian(bytes, self.code_size()), q.into());
        Ok(())
    }

    /// [`decode_near`](QuaternionFormat::decode_near) for little-endian codes without gaps: each becomes near to the rotation
    /// that it replaces.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless `bytes` has `code_size` for each quaternion; nothing is written then.
    pub fn decode_aos_near(self, bytes: &[u8], q: &mut [[f32; 4]]) -> Result<(), LengthMismatch> {
        self.decode_rows_near(bytes, q, To::Replaced)
    }

    /// [`decode_near`](QuaternionFormat::decode_near) for a track of little-endian codes without gaps: each becomes near to
    /// the one before it, and the first near to `previous`.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless `bytes` has `code_size` for each quaternion; nothing is written then.
    pub fn decode_track(
        self,
        bytes: &[u8],
        previous: [f32; 4],
        q: &mut [[f32; 4]],
    ) -> Result<(), LengthMismatch> {
        self.decode_rows_near(bytes, q, To::Before(previous))
    }

    fn decode_rows_near(
        self,
        bytes: &[u8],
        q: &mut [[f32; 4]],
        to: To,
    ) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_aos_bytes(q.len(), bytes.len(), size)?;
        decode_near(
            &|codes, q| self.decode_batch(codes, q),
            Codes::little_endian(bytes, size),
            q,
            to,
        );
        Ok(())
    }

    /// [`encode`](QuaternionFormat::encode) for quaternions of four native floats and little-endian codes, both at a stride.
    /// Arrays are [`Strided::of`] themselves.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided(
        self,
        q: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (q, codes) = q.encoded(codes, self.layout())?;
        self.encode_batch(q, codes);
        Ok(())
    }

    /// [`encode_precise`](QuaternionFormat::encode_precise) for quaternions and codes at a stride, as
    /// [`encode_strided`](QuaternionFormat::encode_strided) takes them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided_precise(
        self,
        q: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (q, codes) = q.encoded(codes, self.layout())?;
        self.encode_batch_precise(q, codes);
        Ok(())
    }

    /// [`decode`](QuaternionFormat::decode) for codes and quaternions at a stride, as
    /// [`encode_strided`](QuaternionFormat::encode_strided) takes them. What lies between the quaternions stays as it is.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn decode_strided(
        self,
        codes: Strided<'_>,
        q: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (codes, q) = codes.decoded(q, self.layout())?;
        self.decode_batch(codes, q);
        Ok(())
    }

    #[inline(never)]
    fn encode_batch(self, q: Vectors<'_, 4>, codes: CodesMut<'_>) {
        with_formula!(self, |formula, Stored| formula::encode::<_, Stored, false>(
            formula, q, codes
        ));
    }

    #[inline(never)]
    fn encode_batch_precise(self, q: Vectors<'_, 4>, codes: CodesMut<'_>) {
        with_formula!(self, |formula, Stored| formula::encode::<_, Stored, true>(
            formula, q, codes
        ));
    }

    #[inline(never)]
    fn decode_batch(self, codes: Codes<'_>, q: VectorsMut<'_, 4>) {
        with_formula!(self, |formula, Stored| formula::decode::<_, Stored>(formula, codes, q));
    }
}
