//! Tangent frames: normal, tangent and handedness in 16 to 64 bits.
//!
//! [`OctAngle32`] and [`OctAngle64`] hold the normal as the crate's octahedral code, and the tangent as
//! its angle around the normal that this code decodes to. [`OctAngleFormat`] is the same with any split of the
//! bits, chosen at run time:
//!
//! ```text
//! basis    of the decoded normal n:  s = -1 if n.z < 0, else 1;  a = -1 / (s + n.z);  b = n.x n.y a
//!          b1 = (1 + s n.x^2 a, s b, -s n.x)
//!          b2 = (b, s + n.y^2 a, -n.y)
//! encode   t = tangent's part across the normal
//!          n = decode(oct(normal)), k = round(atan2(t.b2, t.b1) 2^A / (2 pi)) mod 2^A
//!          code = oct(normal), k in A bits, 1 if handedness < 0 else 0
//! decode   normal = n, tangent = b1 cos(2 pi k / 2^A) + b2 sin(2 pi k / 2^A)
//! ```
//!
//! [`QTangent64`] holds the rotation that takes x, y and z to tangent, bitangent and normal, as a unit
//! quaternion whose w has the sign of the handedness:
//!
//! ```text
//! encode   t = tangent's part across the normal n, over its length; b = n x t
//!          4 (w^2, x^2, y^2, z^2) = 1 + (t.x + b.y + n.z, t.x - b.y - n.z, b.y - t.x - n.z, n.z - t.x - b.y)
//!          4 (w x, w y, w z) = (b.z - n.y, n.x - t.z, t.y - b.x)
//!          4 (x y, x z, y z) = (t.y + b.x, t.z + n.x, b.z + n.y)
//!          q = the one of the matrix 4 q q^T's four rows that has the greatest square, over its length; w >= 0
//!          code = round(32767 q), of which w is at least 1; all negated if handedness < 0
//!          precise: of the 16 codes whose components are rounded down or up, the one whose direction is nearest
//! decode   tangent = (w^2 + x^2 - y^2 - z^2, 2 (x y + w z), 2 (x z - w y)), over its length
//!          normal = (2 (x z + w y), 2 (y z - w x), w^2 - x^2 - y^2 + z^2), over its length
//! ```
//!
//! An angle's steps are all of one size. The other usual choice, a point on the rim of a diamond |x| + |y| = 1,
//! needs no sine and no arc tangent, but its steps are 1.27 times as large where they are largest: on uniform
//! frames, with `encode` and 9 bits, a diamond's tangents are off by 0.188° in the mean and 0.459° at most, an
//! angle's by 0.181° and 0.367°.
//!
//! [`basis()`] gives b1 and b2, as other decoders have to find them. The basis has a seam at n.z = 0. They have to find the same
//! side of it, so n.z is best computed as M - |u| - |w| in the code's integers, where the equator's z is exactly 0.
//!
//! # Promises
//! The [crate's](crate#promises) hold here too:
//! - Any input encodes. Of normal and tangent only the direction matters; an infinite component means
//!   the limit direction. A normal that is zero or NaN counts as +Z. What is encoded of the tangent
//!   is its part across the normal; if there is none, since the tangent is zero, NaN or within 1e-6
//!   radians of the normal or its opposite, it is the first vector of the basis above.
//! - A handedness below 0 is -1, and anything else, zero and NaN too, is +1. It always survives.
//! - Any bit pattern decodes: normal and tangent have length 1 to 2.5e-7 and are orthogonal to 5e-7, and
//!   the handedness is 1 or -1.
//! - A tangent that is not orthogonal to its normal is encoded all the same, and said to be so: every
//!   batch gives the [`Skew`] of its input, and [`Frame::skew_degrees`] that of one frame.
//! - An octahedral code that was decoded and encoded again stays, with both encoders. Of [`QTangent64`] most do.
//! - All entry points give the same bits, on any computer.
//!
//! ```
//! use unitpack::frame::{Frame, FrameCodec, OctAngle32};
//! let frame = Frame { normal: [0.0, 0.6, 0.8], tangent: [1.0, 0.0, 0.0], handedness: -1.0 };
//! assert_eq!(frame.skew_degrees(), 0.0);
//! let code: u32 = OctAngle32::encode_precise(frame);
//! let decoded = OctAngle32::decode(code);
//! assert!(decoded.tangent[0] > 0.9999 && decoded.normal[2] > 0.799);
//! assert_eq!(decoded.handedness, -1.0);
//! ```
//!
//! Source: Duff, Burgess, Christensen, Hery, Kensler, Liani and Villemin, "Building an Orthonormal
//! Basis, Revisited", 2017; Kapoulkine, "Quantizing tangent frames", 2026; Frey and Herzeg, "Spherical
//! Skinning with Dual-Quaternions and QTangents", 2011. The angle in place of a diamond is unitpack's.

use crate::batch::layout::{CodeLayout, Codes, CodesMut, PairMut, Vectors, VectorsMut};
use crate::batch::storage::{from_native, to_native};
use crate::codec::Format;
use crate::error::{LengthMismatch, StrideMismatch};
use crate::formula::support::sanitize::sanitize;
use crate::simd::{I32x1, Vec3};
use crate::vector::{Soa, SoaMut, Strided, StridedMut};
pub use format::OctAngleFormat;
use formula::{FrameCodes, FrameFormula, Prepared, skew_degrees};
use kernels::FrameKernels;
use oct_angle::OctAngle;
use qtangent::QTangent;

mod format;
mod formula;
mod kernels;
mod oct_angle;
mod qtangent;

/// A tangent frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The normal, of any length.
    pub normal: [f32; 3],
    /// The tangent, of any length, orthogonal to the normal.
    pub tangent: [f32; 3],
    /// -1 if the bitangent is opposite to normal x tangent, else 1.
    pub handedness: f32,
}

impl Frame {
    /// handedness (normal x tangent): the third vector, as glTF and most programs define it.
    #[inline]
    pub fn bitangent(self) -> [f32; 3] {
        let bitangent = Vec3::from(self.normal).cross(Vec3::from(self.tangent));
        bitangent.to_array().map(|c| self.handedness * c)
    }

    /// By how many degrees the angle between normal and tangent, as encoders understand them, is not 90.
    /// From 0 to 90; 90 too if the tangent is zero or NaN, as then none of it is encoded. Exact to 4e-5
    /// degrees below 60, to 0.05 above.
    #[inline]
    pub fn skew_degrees(self) -> f32 {
        skew_degrees(self.prepare().sin_squared)
    }
}

impl Frame {
    #[inline(always)]
    fn prepare(self) -> Prepared<f32> {
        Prepared::new(self.normal.into(), self.tangent.into(), self.handedness)
    }
}

/// The vectors b1 and b2 around which [`OctAngle32`], [`OctAngle64`] and [`OctAngleFormat`] count the angle, for a decoded normal n:
///
/// ```text
/// s = -1 if n.z < 0, else 1;  a = -1 / (s + n.z);  b = n.x n.y a
/// b1 = (1 + s n.x^2 a, s b, -s n.x)
/// b2 = (b, s + n.y^2 a, -n.y)
/// ```
///
/// b1, b2 and n are an orthonormal, right-handed system. The tangent of angle t is b1 cos(t) + b2 sin(t). Of a vector whose
/// squared length is not 1 to 1e-6 the direction counts: zero and NaN are taken as +Z, an infinite component as the limit direction.
///
/// ```
/// let [b1, b2] = unitpack::frame::basis([1.0, 0.0, 0.0]);
/// assert_eq!((b1, b2), ([0.0, 0.0, -1.0], [0.0, 1.0, 0.0]));
/// ```
///
/// Source: Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
pub fn basis(normal: [f32; 3]) -> [[f32; 3]; 2] {
    let v = Vec3::from(normal);
    // A decoded normal stays as it is.
    let is_unit = (v.length_squared() - 1.0).abs() <= 1e-6;
    let unit = if is_unit { v } else { sanitize(v).normalize() };
    // -0 is not below 0.
    formula::basis(formula::unsigned_zeros(unit)).map(|b| formula::unsigned_zeros(b).to_array())
}

/// The frame of a batch whose tangent is the farthest from orthogonal to its normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Skew {
    /// Its [`Frame::skew_degrees`]: 0 if there is no frame.
    pub degrees: f32,
    /// Its index; the first of several. 0 if there is none.
    pub index: usize,
}

/// Frames to read, as a structure of arrays. All seven slices have one element per frame.
#[derive(Clone, Copy, Debug)]
pub struct FrameSoa<'a> {
    /// The normals.
    pub normal: Soa<'a>,
    /// The tangents.
    pub tangent: Soa<'a>,
    /// Below 0 or not.
    pub handedness: &'a [f32],
}

/// Frames to write, as a structure of arrays. All seven slices have one element per frame.
#[derive(Debug)]
pub struct FrameSoaMut<'a> {
    /// The normals.
    pub normal: SoaMut<'a>,
    /// The tangents.
    pub tangent: SoaMut<'a>,
    /// 1 or -1.
    pub handedness: &'a mut [f32],
}

impl<'a> FrameSoa<'a> {
    /// Of normals, tangents and handednesses.
    #[inline]
    fn lengths(&self) -> ([usize; 3], [usize; 3], usize) {
        let lengths = |v: Soa<'_>| [v.x.len(), v.y.len(), v.z.len()];
        (lengths(self.normal), lengths(self.tangent), self.handedness.len())
    }

    #[inline]
    fn check(&self, codes: usize) -> Result<(), LengthMismatch> {
        let (normal, tangent, handedness) = self.lengths();
        LengthMismatch::check_frame_soa(normal, tangent, handedness, codes)
    }

    #[inline]
    fn check_bytes(&self, bytes: usize, code_size: usize) -> Result<(), LengthMismatch> {
        let (normal, tangent, handedness) = self.lengths();
        LengthMismatch::check_frame_bytes(normal, tangent, handedness, bytes, code_size)
    }

    #[inline]
    fn vectors(self) -> (Vectors<'a, 3>, Vectors<'a, 4>) {
        let Soa { x, y, z } = self.tangent;
        (self.normal.into(), Vectors::Columns([x, y, z, self.handedness]))
    }
}

impl<'a> FrameSoaMut<'a> {
    /// Of normals, tangents and handednesses.
    #[inline]
    fn lengths(&self) -> ([usize; 3], [usize; 3], usize) {
        let lengths = |v: &SoaMut<'_>| [v.x.len(), v.y.len(), v.z.len()];
        (lengths(&self.normal), lengths(&self.tangent), self.handedness.len())
    }

    #[inline]
    fn check(&self, codes: usize) -> Result<(), LengthMismatch> {
        let (normal, tangent, handedness) = self.lengths();
        LengthMismatch::check_frame_soa(normal, tangent, handedness, codes)
    }

    #[inline]
    fn check_bytes(&self, bytes: usize, code_size: usize) -> Result<(), LengthMismatch> {
        let (normal, tangent, handedness) = self.lengths();
        LengthMismatch::check_frame_bytes(normal, tangent, handedness, bytes, code_size)
    }

    #[inline]
    fn vectors(self) -> (VectorsMut<'a, 3>, VectorsMut<'a, 4>) {
        let SoaMut { x, y, z } = self.tangent;
        (self.normal.into(), VectorsMut::Columns([x, y, z, self.handedness]))
    }
}

/// A representation of tangent frames. What holds for all is listed [here](self#promises).
///
/// Errors are angles between a vector, the tangent's being orthogonal to the normal, and the one that
/// its code decodes to.
pub trait FrameCodec: FrameKernels + Copy + 'static {
    /// One packed frame.
    type Code: bytemuck::Pod + Eq + core::fmt::Debug;
    /// The name, such as "octangle32".
    const NAME: &'static str;
    /// How many bits a code has.
    const BITS: u32;
    /// A bound of the normal's greatest error with `encode`, in degrees.
    const MAX_NORMAL_ERROR_DEGREES: f64;
    /// A bound of the normal's greatest error with `encode_precise`, in degrees.
    const MAX_NORMAL_ERROR_PRECISE_DEGREES: f64;
    /// A bound of the tangent's greatest error with `encode`, in degrees.
    const MAX_TANGENT_ERROR_DEGREES: f64;
    /// A bound of the tangent's greatest error with `encode_precise`, in degrees.
    const MAX_TANGENT_ERROR_PRECISE_DEGREES: f64;

    /// Packs a frame with the fast encoder of normals. Gives a canonical code.
    fn encode(frame: Frame) -> Self::Code;

    /// Packs a frame: the nearest normal, and the tangent nearest for it, both up to `f32` rounding; a
    /// quaternion as [`QTangent64`] says. Gives a canonical code.
    fn encode_precise(frame: Frame) -> Self::Code;

    /// Unpacks a code, any bit pattern.
    fn decode(code: Self::Code) -> Frame;

    /// The code that encoders emit for the frame of `code`, any bit pattern: of several that mean one
    /// frame the same. A canonical code stays as it is.
    fn canonical(code: Self::Code) -> Self::Code;

    /// Whether encoders emit `code`.
    #[inline]
    fn is_canonical(code: Self::Code) -> bool {
        Self::canonical(code) == code
    }

    /// [`encode`](FrameCodec::encode) for structures of arrays. Gives the input's greatest skew.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the eight slices are not equally long; nothing is written then.
    #[inline]
    fn encode_soa(frames: FrameSoa<'_>, codes: &mut [Self::Code]) -> Result<Skew, LengthMismatch> {
        frames.check(codes.len())?;
        Ok(Self::encode_batch(frames.vectors(), CodesMut::native(codes)))
    }

    /// [`encode_precise`](FrameCodec::encode_precise) for structures of arrays. Gives the input's
    /// greatest skew.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the eight slices are not equally long; nothing is written then.
    #[inline]
    fn encode_soa_precise(
        frames: FrameSoa<'_>,
        codes: &mut [Self::Code],
    ) -> Result<Skew, LengthMismatch> {
        frames.check(codes.len())?;
        Ok(Self::encode_batch_precise(frames.vectors(), CodesMut::native(codes)))
    }

    /// [`decode`](FrameCodec::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the eight slices are not equally long; nothing is written then.
    #[inline]
    fn decode_soa(codes: &[Self::Code], frames: FrameSoaMut<'_>) -> Result<(), LengthMismatch> {
        frames.check(codes.len())?;
        Self::decode_batch(Codes::native(codes), frames.vectors());
        Ok(())
    }

    /// [`encode`](FrameCodec::encode) for arrays of structures: normals of `N` floats, of which the first
    /// three are x, y and z, and tangents as glTF has them, x, y, z and handedness. Gives the input's
    /// greatest skew. `N < 3` does not compile:
    ///
    /// ```compile_fail
    /// use unitpack::frame::{FrameCodec, OctAngle32};
    /// let _ = OctAngle32::encode_aos(&[[1.0f32, 0.0]], &[[0.0, 1.0, 0.0, 1.0]], &mut [0]);
    /// ```
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos<const N: usize>(
        normals: &[[f32; N]],
        tangents: &[[f32; 4]],
        codes: &mut [Self::Code],
    ) -> Result<Skew, LengthMismatch> {
        LengthMismatch::check_frame_aos(normals.len(), tangents.len(), codes.len())?;
        let frames = (Vectors::rows(normals), Vectors::rows(tangents));
        Ok(Self::encode_batch(frames, CodesMut::native(codes)))
    }

    /// [`encode_precise`](FrameCodec::encode_precise) for arrays of structures, as
    /// [`encode_aos`](FrameCodec::encode_aos) takes them. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos_precise<const N: usize>(
        normals: &[[f32; N]],
        tangents: &[[f32; 4]],
        codes: &mut [Self::Code],
    ) -> Result<Skew, LengthMismatch> {
        LengthMismatch::check_frame_aos(normals.len(), tangents.len(), codes.len())?;
        let frames = (Vectors::rows(normals), Vectors::rows(tangents));
        Ok(Self::encode_batch_precise(frames, CodesMut::native(codes)))
    }

    /// [`decode`](FrameCodec::decode) for arrays of structures: the first three floats of normals become
    /// x, y and z, the others stay as they are; tangents become x, y, z and handedness. `N < 3` does not
    /// compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn decode_aos<const N: usize>(
        codes: &[Self::Code],
        normals: &mut [[f32; N]],
        tangents: &mut [[f32; 4]],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_frame_aos(normals.len(), tangents.len(), codes.len())?;
        let frames = (VectorsMut::rows(normals), VectorsMut::rows(tangents));
        Self::decode_batch(Codes::native(codes), frames);
        Ok(())
    }

    /// [`encode`](FrameCodec::encode) for normals of three native floats, tangents of four, x, y, z and handedness, and codes,
    /// each at a stride. Gives the input's greatest skew. See [`Strided`].
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn encode_strided(
        normals: Strided<'_>,
        tangents: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<Skew, StrideMismatch> {
        StrideMismatch::check_frames(normals.len, tangents.len, codes.len)?;
        let codes = codes.codes(CodeLayout::native::<Self::Code>())?;
        Ok(Self::encode_batch((normals.vectors()?, tangents.vectors()?), codes))
    }

    /// [`encode_precise`](FrameCodec::encode_precise) for normals, tangents and codes at a stride, as
    /// [`encode_strided`](FrameCodec::encode_strided) takes them. Gives the input's greatest skew.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn encode_strided_precise(
        normals: Strided<'_>,
        tangents: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<Skew, StrideMismatch> {
        StrideMismatch::check_frames(normals.len, tangents.len, codes.len)?;
        let codes = codes.codes(CodeLayout::native::<Self::Code>())?;
        Ok(Self::encode_batch_precise((normals.vectors()?, tangents.vectors()?), codes))
    }

    /// [`decode`](FrameCodec::decode) for codes, normals and tangents at a stride, as
    /// [`encode_strided`](FrameCodec::encode_strided) takes them. What lies between stays as it is.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn decode_strided(
        codes: Strided<'_>,
        normals: StridedMut<'_>,
        tangents: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        StrideMismatch::check_frames(normals.len, tangents.len, codes.len)?;
        let codes = codes.codes(CodeLayout::native::<Self::Code>())?;
        Self::decode_batch(codes, (normals.vectors()?, tangents.vectors()?));
        Ok(())
    }

    /// [`decode_strided`](FrameCodec::decode_strided) to vertices that hold both: normals as `normals` has them, and tangents
    /// from `tangent_offset` on in the same bytes, with the same stride.
    ///
    /// ```
    /// use unitpack::frame::{FrameCodec, OctAngle32};
    /// use unitpack::{Strided, StridedMut};
    /// // Position, normal and tangent.
    /// let mut vertices = [[9.0f32; 10]; 5];
    /// let codes = [0u32; 5];
    /// OctAngle32::decode_vertices(Strided::of(&codes, 0), StridedMut::of(&mut vertices, 12), 24)?;
    /// assert_eq!(vertices[4], [9.0, 9.0, 9.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0]);
    /// # Ok::<(), unitpack::StrideMismatch>(())
    /// ```
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, their numbers differ, or normal and tangent together are
    /// longer than the stride; nothing is written then.
    #[inline]
    fn decode_vertices(
        codes: Strided<'_>,
        normals: StridedMut<'_>,
        tangent_offset: usize,
    ) -> Result<(), StrideMismatch> {
        StrideMismatch::check_lengths(normals.len, codes.len)?;
        let codes = codes.codes(CodeLayout::native::<Self::Code>())?;
        Self::decode_pairs(codes, normals.pair(tangent_offset)?);
        Ok(())
    }

    /// [`encode_strided`](FrameCodec::encode_strided) in place, for vertices that hold all: normals as `normals` has them,
    /// tangents from `tangent_offset` on, and codes to `code_offset`, in the same bytes. They may overlap: an
    /// element is read before it is written. Gives the input's greatest skew.
    ///
    /// ```
    /// use unitpack::StridedMut;
    /// use unitpack::frame::{FrameCodec, OctAngle32};
    /// // Position, normal and tangent. The code takes the place of the normal's x.
    /// let mut vertices = [[9.0f32, 9.0, 9.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0]; 5];
    /// OctAngle32::encode_within(StridedMut::of(&mut vertices, 12), 24, 12)?;
    /// assert_eq!(vertices[4][3].to_bits(), 0);
    /// OctAngle32::decode_within(StridedMut::of(&mut vertices, 12), 24, 12)?;
    /// assert_eq!(vertices[4], [9.0, 9.0, 9.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0]);
    /// # Ok::<(), unitpack::StrideMismatch>(())
    /// ```
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or normal, tangent and code together are longer than
    /// the stride; nothing is written then.
    #[inline]
    fn encode_within(
        normals: StridedMut<'_>,
        tangent_offset: usize,
        code_offset: usize,
    ) -> Result<Skew, StrideMismatch> {
        let layout = CodeLayout::native::<Self::Code>();
        let within = normals.frame_within(tangent_offset, code_offset, layout)?;
        Ok(kernels::encode_within(within, &Self::encode_batch))
    }

    /// [`encode_precise`](FrameCodec::encode_precise) in place, as [`encode_within`](FrameCodec::encode_within) has it.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or normal, tangent and code together are longer than
    /// the stride; nothing is written then.
    #[inline]
    fn encode_within_precise(
        normals: StridedMut<'_>,
        tangent_offset: usize,
        code_offset: usize,
    ) -> Result<Skew, StrideMismatch> {
        let layout = CodeLayout::native::<Self::Code>();
        let within = normals.frame_within(tangent_offset, code_offset, layout)?;
        Ok(kernels::encode_within(within, &Self::encode_batch_precise))
    }

    /// [`decode_strided`](FrameCodec::decode_strided) in place: from the codes at `code_offset` to normals and tangents, as
    /// [`encode_within`](FrameCodec::encode_within) has them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or normal, tangent and code together are longer than
    /// the stride; nothing is written then.
    #[inline]
    fn decode_within(
        normals: StridedMut<'_>,
        tangent_offset: usize,
        code_offset: usize,
    ) -> Result<(), StrideMismatch> {
        let layout = CodeLayout::native::<Self::Code>();
        let within = normals.frame_within(tangent_offset, code_offset, layout)?;
        kernels::decode_within(within, &Self::decode_pairs);
        Ok(())
    }
}

/// Defines the types and their `FrameCodec`.
macro_rules! frame_codecs {
    ($(
        $(#[$doc:meta])*
        $name:ident: $code:ty = $text:literal, $bits:literal bits,
            normal $normal:expr, $normal_precise:expr, tangent $tangent:literal / $tangent_precise:literal degrees,
            $formula:ident :: new($($value:expr),*);
    )*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct $name;

        const _: () = {
            type Bytes = [u8; size_of::<$code>()];
            const FORMULA: $formula = $formula::new($($value),*);

            impl FrameCodec for $name {
                type Code = $code;
                const NAME: &'static str = $text;
                const BITS: u32 = $bits;
                const MAX_NORMAL_ERROR_DEGREES: f64 = $normal;
                const MAX_NORMAL_ERROR_PRECISE_DEGREES: f64 = $normal_precise;
                const MAX_TANGENT_ERROR_DEGREES: f64 = $tangent;
                const MAX_TANGENT_ERROR_PRECISE_DEGREES: f64 = $tangent_precise;

                #[inline]
                fn encode(frame: Frame) -> $code {
                    from_words(FORMULA.encode::<f32, false>(frame.prepare()))
                }
                #[inline]
                fn encode_precise(frame: Frame) -> $code {
                    from_words(FORMULA.encode::<f32, true>(frame.prepare()))
                }
                #[inline]
                fn decode(code: $code) -> Frame {
                    let frame = FORMULA.decode::<f32>(to_words(code));
                    Frame {
                        normal: frame.normal.to_array(),
                        tangent: frame.tangent.to_array(),
                        handedness: frame.handedness,
                    }
                }
                #[inline]
                fn canonical(code: $code) -> $code {
                    from_words(FORMULA.canonical::<f32>(to_words(code)))
                }
            }

            #[inline(always)]
            fn from_words(words: [I32x1; 2]) -> $code {
                to_native::<Bytes, $code>(Bytes::from_words::<f32>(words))
            }
            #[inline(always)]
            fn to_words(code: $code) -> [I32x1; 2] {
                Bytes::to_words::<f32>(from_native::<Bytes, $code>(code))
            }

            impl FrameKernels for $name {
                #[inline(never)]
                fn encode_batch(frames: (Vectors<'_, 3>, Vectors<'_, 4>), codes: CodesMut<'_>) -> Skew {
                    kernels::encode::<_, Bytes, false>(FORMULA, frames, codes)
                }
                #[inline(never)]
                fn encode_batch_precise(
                    frames: (Vectors<'_, 3>, Vectors<'_, 4>),
                    codes: CodesMut<'_>,
                ) -> Skew {
                    kernels::encode::<_, Bytes, true>(FORMULA, frames, codes)
                }
                #[inline(never)]
                fn decode_batch(codes: Codes<'_>, frames: (VectorsMut<'_, 3>, VectorsMut<'_, 4>)) {
                    kernels::decode::<_, Bytes, _>(FORMULA, codes, frames);
                }
                #[inline(never)]
                fn decode_pairs(codes: Codes<'_>, frames: PairMut<'_>) {
                    kernels::decode::<_, Bytes, _>(FORMULA, codes, frames);
                }
            }
        };
    )*};
}

frame_codecs! {
    /// 32 bits in a `u32`: the code of [`Oct22`](crate::Oct22), 9 bits of angle and the handedness, 1 for -1,
    /// from the low bits up.
    ///
    /// Greatest error of the normal: that of `Oct22`, 0.1193° with `encode`, 0.07953° with `encode_precise`; of the
    /// tangent 0.3714° and 0.3606°. In the mean, on uniform frames, 0.0418° and 0.0391° of the normal, 0.1807° and
    /// 0.1800° of the tangent. Frames along the axes survive exactly, all 48. Only the normal has codes that
    /// are not canonical; `encode_precise(decode(code))` is `canonical(code)`.
    OctAngle32: u32 = "octangle32", 32 bits,
        normal Format::Oct22.max_error_degrees(), Format::Oct22.max_error_precise_degrees(),
        tangent 0.3714 / 0.3606 degrees, OctAngle::new(22, 9);
    /// 64 bits in a `u64`: the code of [`Oct32`](crate::Oct32), 31 bits of angle and the handedness, 1 for -1,
    /// from the low bits up.
    ///
    /// Greatest error of the normal: that of `Oct32`, 0.003736° with `encode`, 0.002486° with `encode_precise`; of
    /// the tangent the same and what `f32` rounding adds, 4e-5°. In the mean, on uniform frames, 0.00131° and 0.00122°
    /// of the normal, 0.00083° and 0.00078° of the tangent. Frames along the axes survive exactly, all 48.
    ///
    /// Of the angle's 31 bits `f32` carries about 23. Encoders give 22 of them, and the low 9 are zero: so a buffer that
    /// is decoded and encoded keeps its bytes. Canonical are these angles, with the canonical normal. Decoding reads all 31.
    OctAngle64: u64 = "octangle64", 64 bits,
        normal Format::Oct32.max_error_degrees(), Format::Oct32.max_error_precise_degrees(),
        tangent 0.003779 / 0.002529 degrees, OctAngle::new(32, 31);
    /// 64 bits in an `[i16; 4]`: a quaternion's x, y, z and w as snorm, with the sign of the handedness.
    ///
    /// Greatest error of normal and tangent: 0.00468° with `encode`, 0.00434° with `encode_precise`; where the frame
    /// is not turned by nearly 180 degrees, so that w is stored as it is, less than 0.0036°. In the mean, on uniform frames,
    /// 0.00131° and 0.00104°. `encode_precise` takes the nearest of the codes around the unit quaternion, of which a
    /// component is less than a step off. Codes of other lengths, of which some are nearer still, it does not look for.
    ///
    /// w is never 0, so that its sign survives: a 0 reads as 1, and an angle of 180 degrees is 0.0035° off. (The
    /// source also makes the other components shorter then, by 5e-10 of themselves.) Of the 48 frames along the axes
    /// the 30 that are not turned by 180 degrees survive exactly. -32768 reads as -32767, and four zeros as the frame of
    /// x, y and z.
    ///
    /// Canonical are the codes around their own unit quaternion, which are those that encoders emit.
    /// `encode_precise(decode(code))` is `canonical(code)`, or another one that decodes alike up to rounding, to 2e-6 radians. That
    /// happens for one frame in 3000 of what `encode_precise` gave, and for one in 60 of what `encode` gave. `OctAngle64` always stays.
    QTangent64: [i16; 4] = "qtangent64", 64 bits,
        normal 0.00468, 0.00434, tangent 0.00468 / 0.00434 degrees, QTangent::new();
}
