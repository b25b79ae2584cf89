//! An octahedral normal and an angle in any number of bits.

use super::formula::{Decoded, FrameFormula};
use super::oct_angle::{EMITTED, OctAngle};
use super::{Frame, FrameSoa, FrameSoaMut, Skew, kernels};
use crate::batch::layout::{CodeLayout, Codes, CodesMut, PairMut, Vectors, VectorsMut};
use crate::batch::storage::{DoubleWords, OneLane};
use crate::codec::Format;
use crate::error::{LengthMismatch, StrideMismatch};
use crate::simd::math::sqrt;
use crate::vector::{Strided, StridedMut};

/// Frames as octahedral normal, angle and handedness, whose bits are split at run time.
///
/// A code is a `u64`. From the low bits up it has the normal's two parameters u and v, the angle, and the handedness, 1 for
/// -1. Higher bits are 0, and decoding ignores them. u and v are in two's complement at every width. At 24 bits
/// the normal's code is therefore not in the RGB8 order of [`Oct24`](crate::Oct24).
///
/// `new(22, 9)` gives the codes of [`OctAngle32`](super::OctAngle32), and `new(32, 31)` those of
/// [`OctAngle64`](super::OctAngle64).
///
/// Batches read and write the low [`code_size`](OctAngleFormat::code_size) bytes of each code, little-endian, at any alignment.
///
/// ```
/// use unitpack::frame::{Frame, OctAngleFormat};
/// // 24 + 7 + 1 bits.
/// let format = OctAngleFormat::new(24, 7).ok_or("no such split")?;
/// assert_eq!((format.bits(), format.code_size()), (32, 4));
/// let frame = Frame { normal: [0.0, 0.0, 1.0], tangent: [0.0, 1.0, 0.0], handedness: -1.0 };
/// let code = format.encode(frame);
/// assert_eq!(code, 32 << 24 | 1 << 31);
/// assert_eq!(format.decode(code), frame);
/// # Ok::<(), &str>(())
/// ```
///
/// # Promises
/// Those of the [module](super#promises). Both encoders are stable: a buffer that they wrote keeps its bytes when it is decoded
/// and encoded again. Of more than 22 bits of angle, more than `f32` carries, they leave the others zero. Canonical are
/// these angles, with the canonical normal. Decoding reads all bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OctAngleFormat {
    oct_bits: u32,
    angle_bits: u32,
}

impl OctAngleFormat {
    /// The format of `oct_bits` for the normal, an even number from 8 to 32, and `angle_bits` from 1 to 31. With the
    /// handedness they are 16 to 64. `None` for others.
    #[inline]
    pub const fn new(oct_bits: u32, angle_bits: u32) -> Option<Self> {
        let is_oct = oct_bits >= 8 && oct_bits <= 32 && oct_bits.is_multiple_of(2);
        let is_angle = angle_bits >= 1 && angle_bits <= 31;
        if is_oct && is_angle && oct_bits + angle_bits >= 15 {
            Some(OctAngleFormat { oct_bits, angle_bits })
        } else {
            None
        }
    }

    /// Number of bits of a code: those of normal and angle, and one.
    #[inline]
    pub const fn bits(self) -> u32 {
        self.oct_bits + self.angle_bits + 1
    }

    /// Number of bits of the normal, half of them for each parameter.
    #[inline]
    pub const fn oct_bits(self) -> u32 {
        self.oct_bits
    }

    /// Number of bits of the angle.
    #[inline]
    pub const fn angle_bits(self) -> u32 {
        self.angle_bits
    }

    /// Number of bytes of a code in a batch: 2, 3, 4, 6 or 8, the least that hold its bits.
    #[inline]
    pub const fn code_size(self) -> usize {
        DoubleWords::size_of(self.bits())
    }

    /// A bound of the normal's greatest error with `encode`, in degrees: that of the oct format of as many bits.
    #[inline]
    pub const fn max_normal_error_degrees(self) -> f64 {
        self.oct().max_error_degrees()
    }

    /// A bound of the normal's greatest error with `encode_precise`, in degrees.
    #[inline]
    pub const fn max_normal_error_precise_degrees(self) -> f64 {
        self.oct().max_error_precise_degrees()
    }

    /// A bound of the tangent's greatest error with `encode`, in degrees: the root of the squares of half a step of the angle and
    /// the normal's error, and what rounding to `f32` adds.
    #[inline]
    pub fn max_tangent_error_degrees(self) -> f64 {
        self.tangent_error(self.max_normal_error_degrees())
    }

    /// A bound of the tangent's greatest error with `encode_precise`, in degrees.
    #[inline]
    pub fn max_tangent_error_precise_degrees(self) -> f64 {
        self.tangent_error(self.max_normal_error_precise_degrees())
    }

    /// As [`FrameCodec::encode`](super::FrameCodec::encode).
    pub fn encode(self, frame: Frame) -> u64 {
        self.formula().encode::<f32, false>(frame.prepare()).to_u64()
    }

    /// As [`FrameCodec::encode_precise`](super::FrameCodec::encode_precise).
    pub fn encode_precise(self, frame: Frame) -> u64 {
        self.formula().encode::<f32, true>(frame.prepare()).to_u64()
    }

    /// As [`FrameCodec::decode`](super::FrameCodec::decode).
    pub fn decode(self, code: u64) -> Frame {
        let Decoded { normal, tangent, handedness } =
            self.formula().decode::<f32>(OneLane::from_u64(code));
        Frame { normal: normal.to_array(), tangent: tangent.to_array(), handedness }
    }

    /// As [`FrameCodec::canonical`](super::FrameCodec::canonical).
    pub fn canonical(self, code: u64) -> u64 {
        self.formula().canonical::<f32>(OneLane::from_u64(code)).to_u64()
    }

    /// Whether encoders emit `code`.
    #[inline]
    pub fn is_canonical(self, code: u64) -> bool {
        self.canonical(code) == code
    }

    /// The code of the normal's parameters u and v, the angle, and whether the handedness is -1.
    ///
    /// With M = 2^([`oct_bits`](OctAngleFormat::oct_bits)/2 - 1) - 1, the normal is the direction of u, v and M - |u| - |v|. Where that z is
    /// negative, x and y are (M - |v|) sgn u and (M - |u|) sgn v instead. The tangent is b1 cos(a) + b2 sin(a) with the
    /// [`basis`](super::basis) of the normal, and a is the angle in steps of 2 pi / 2^[`angle_bits`](OctAngleFormat::angle_bits).
    ///
    /// u and v are clamped to ±M, and whole turns of the angle are left out. The code need not be
    /// [canonical](OctAngleFormat::canonical).
    ///
    /// ```
    /// use unitpack::frame::OctAngleFormat;
    /// let format = OctAngleFormat::new(32, 15).ok_or("no such split")?;
    /// let code = format.from_parameters(-2, 5, 1 << 14, true);
    /// assert_eq!(code, 0xC000_0005_FFFE);
    /// assert_eq!(format.parameters(code), (-2, 5, 1 << 14, true));
    /// # Ok::<(), &str>(())
    /// ```
    pub fn from_parameters(self, u: i32, v: i32, angle: u32, negative: bool) -> u64 {
        self.formula().pack_parameters([u, v], angle, negative).to_u64()
    }

    /// The parameters of a code, any bit pattern, as [`from_parameters`](OctAngleFormat::from_parameters) takes them. -M - 1 reads
    /// as -M.
    pub fn parameters(self, code: u64) -> (i32, i32, u32, bool) {
        let ([u, v], angle, negative) = self.formula().unpack_parameters(OneLane::from_u64(code));
        (u, v, angle, negative)
    }

    /// [`encode`](OctAngleFormat::encode) for structures of arrays, to tightly packed little-endian codes. Gives the input's greatest
    /// skew.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the seven slices are not equally long, or `bytes` has not
    /// [`code_size`](OctAngleFormat::code_size) for each frame; nothing is written then.
    pub fn encode_soa(
        self,
        frames: FrameSoa<'_>,
        bytes: &mut [u8],
    ) -> Result<Skew, LengthMismatch> {
        frames.check_bytes(bytes.len(), self.code_size())?;
        let codes = CodesMut::little_endian(bytes, self.code_size());
        Ok(self.encode_batch(frames.vectors(), codes))
    }

    /// [`encode_precise`](OctAngleFormat::encode_precise) for structures of arrays, as
    /// [`encode_soa`](OctAngleFormat::encode_soa) takes them. Gives the input's greatest skew.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    pub fn encode_soa_precise(
        self,
        frames: FrameSoa<'_>,
        bytes: &mut [u8],
    ) -> Result<Skew, LengthMismatch> {
        frames.check_bytes(bytes.len(), self.code_size())?;
        let codes = CodesMut::little_endian(bytes, self.code_size());
        Ok(self.encode_batch_precise(frames.vectors(), codes))
    }

    /// [`decode`](OctAngleFormat::decode) of tightly packed little-endian codes to structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit, as for [`encode_soa`](OctAngleFormat::encode_soa); nothing is written then.
    pub fn decode_soa(self, bytes: &[u8], frames: FrameSoaMut<'_>) -> Result<(), LengthMismatch> {
        frames.check_bytes(bytes.len(), self.code_size())?;
        self.decode_batch(Codes::little_endian(bytes, self.code_size()), frames.vectors());
        Ok(())
    }

    /// [`encode`](OctAngleFormat::encode) for normals of three native floats, tangents of four, x, y, z and handedness, and
    /// little-endian codes, each at a stride. Gives the input's greatest skew. See [`Strided`].
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided(
        self,
        normals: Strided<'_>,
        tangents: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<Skew, StrideMismatch> {
        StrideMismatch::check_frames(normals.len, tangents.len, codes.len)?;
        let codes = codes.codes(self.layout())?;
        Ok(self.encode_batch((normals.vectors()?, tangents.vectors()?), codes))
    }

    /// [`encode_precise`](OctAngleFormat::encode_precise) at strides, as [`encode_strided`](OctAngleFormat::encode_strided) takes
    /// them. Gives the input's greatest skew.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided_precise(
        self,
        normals: Strided<'_>,
        tangents: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<Skew, StrideMismatch> {
        StrideMismatch::check_frames(normals.len, tangents.len, codes.len)?;
        let codes = codes.codes(self.layout())?;
        Ok(self.encode_batch_precise((normals.vectors()?, tangents.vectors()?), codes))
    }

    /// [`decode`](OctAngleFormat::decode) at strides, as [`encode_strided`](OctAngleFormat::encode_strided) takes them. What lies
    /// between stays as it is.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn decode_strided(
        self,
        codes: Strided<'_>,
        normals: StridedMut<'_>,
        tangents: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        StrideMismatch::check_frames(normals.len, tangents.len, codes.len)?;
        let codes = codes.codes(self.layout())?;
        self.decode_batch(codes, (normals.vectors()?, tangents.vectors()?));
        Ok(())
    }

    /// [`decode_strided`](OctAngleFormat::decode_strided) to vertices that hold both, as
    /// [`FrameCodec::decode_vertices`](super::FrameCodec::decode_vertices) has them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, their numbers differ, or normal and tangent together are
    /// longer than the stride; nothing is written then.
    pub fn decode_vertices(
        self,
        codes: Strided<'_>,
        normals: StridedMut<'_>,
        tangent_offset: usize,
    ) -> Result<(), StrideMismatch> {
        StrideMismatch::check_lengths(normals.len, codes.len)?;
        let codes = codes.codes(self.layout())?;
        self.decode_pairs(codes, normals.pair(tangent_offset)?);
        Ok(())
    }

    #[inline]
    fn formula(self) -> OctAngle {
        OctAngle::new(self.oct_bits, self.angle_bits)
    }

    #[inline]
    fn layout(self) -> CodeLayout {
        CodeLayout::little_endian(self.code_size())
    }

    /// The format of as many bits as the normal has.
    const fn oct(self) -> Format {
        match self.oct_bits {
            8 => Format::Oct8,
            10 => Format::Oct10,
            12 => Format::Oct12,
            14 => Format::Oct14,
            16 => Format::Oct16,
            18 => Format::Oct18,
            20 => Format::Oct20,
            22 => Format::Oct22,
            24 => Format::Oct24,
            26 => Format::Oct26,
            28 => Format::Oct28,
            30 => Format::Oct30,
            _ => Format::Oct32,
        }
    }

    /// Where the normal has this error.
    fn tangent_error(self, normal: f64) -> f64 {
        /// What rounding adds, that of the root too.
        const ROUNDING: f64 = 5e-5;
        let half_step = 180.0 / (1u64 << self.angle_bits.min(EMITTED)) as f64;
        // Right-angled on the sphere, where the longest side is shorter than it is in the plane.
        f64::from(sqrt((half_step * half_step + normal * normal) as f32)) + ROUNDING
    }

    #[inline(never)]
    fn encode_batch(self, frames: (Vectors<'_, 3>, Vectors<'_, 4>), codes: CodesMut<'_>) -> Skew {
        kernels::encode::<_, DoubleWords, false>(self.formula(), frames, codes)
    }

    #[inline(never)]
    fn encode_batch_precise(
        self,
        frames: (Vectors<'_, 3>, Vectors<'_, 4>),
        codes: CodesMut<'_>,
    ) -> Skew {
        kernels::encode::<_, DoubleWords, true>(self.formula(), frames, codes)
    }

    #[inline(never)]
    fn decode_batch(self, codes: Codes<'_>, frames: (VectorsMut<'_, 3>, VectorsMut<'_, 4>)) {
        kernels::decode::<_, DoubleWords, _>(self.formula(), codes, frames);
    }

    #[inline(never)]
    fn decode_pairs(self, codes: Codes<'_>, frames: PairMut<'_>) {
        kernels::decode::<_, DoubleWords, _>(self.formula(), codes, frames);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{FrameCodec, OctAngle32, OctAngle64};

    fn format(oct_bits: u32, angle_bits: u32) -> OctAngleFormat {
        OctAngleFormat::new(oct_bits, angle_bits).unwrap()
    }

    #[test]
    fn splits_are_of_16_to_64_bits() {
        let sizes = [(8, 7, 2), (14, 1, 2), (8, 8, 3), (14, 9, 3), (16, 8, 4), (24, 7, 4)];
        let more = [(24, 8, 6), (32, 1, 6), (32, 15, 6), (32, 16, 8), (18, 31, 8), (32, 31, 8)];
        for (oct, angle, size) in sizes.into_iter().chain(more) {
            let format = format(oct, angle);
            assert_eq!((format.bits(), format.code_size()), (oct + angle + 1, size));
            assert_eq!((format.oct_bits(), format.angle_bits()), (oct, angle));
        }
        for (oct, angle) in [(6, 31), (8, 6), (9, 20), (12, 2), (32, 0), (32, 32), (34, 9)] {
            assert_eq!(OctAngleFormat::new(oct, angle), None);
        }
        assert_eq!(OctAngleFormat::new(u32::MAX - 1, u32::MAX), None);
    }

    #[test]
    fn bounds_are_those_of_the_codecs_with_as_many_bits() {
        let short = format(22, 9);
        assert_eq!(short.max_normal_error_degrees(), OctAngle32::MAX_NORMAL_ERROR_DEGREES);
        assert_eq!(format(24, 1).max_normal_error_precise_degrees(), 0.03975);
        for (ours, theirs) in [
            (short.max_tangent_error_degrees(), OctAngle32::MAX_TANGENT_ERROR_DEGREES),
            (
                short.max_tangent_error_precise_degrees(),
                OctAngle32::MAX_TANGENT_ERROR_PRECISE_DEGREES,
            ),
            (format(32, 31).max_tangent_error_degrees(), OctAngle64::MAX_TANGENT_ERROR_DEGREES),
        ] {
            assert!((ours - theirs).abs() < 2e-4, "{ours}, not {theirs}");
        }
    }

    #[test]
    fn oct_formats_have_as_many_bits() {
        for oct_bits in (8..=32).step_by(2) {
            let oct = format(oct_bits, 10).oct();
            assert_eq!(oct.bits(), oct_bits);
            assert!(oct.name().starts_with("oct"));
        }
    }

    #[test]
    fn parameters_are_clamped_and_wrapped() {
        // M is 7.
        let format = format(8, 7);
        assert_eq!(format.from_parameters(1, -1, 3, false), 0x03F1);
        assert_eq!(format.from_parameters(99, i32::MIN, 128 + 3, true), 0x8397);
        assert_eq!(format.parameters(0x8397), (7, -7, 3, true));
        // -8 reads as -7, and higher bits as nothing.
        assert_eq!(format.parameters(0xFFFF_FFFF_FFFF_0388), (-7, -7, 3, false));
        assert_eq!(format.canonical(0xFFFF_FFFF_FFFF_0388), 0x0377);
        assert!(format.is_canonical(0x0377) && !format.is_canonical(0x0388));
    }
}
