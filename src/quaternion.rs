//! Rotations as unit quaternions in 32, 48 or 64 bits: [`SmallestThree32`], [`SmallestThree48`],
//! [`SmallestThree64`] and [`TanThree32`], all [`QuaternionCodec`]s; and of any other width, as the smallest
//! three or plain, with [`QuaternionFormat`].
//!
//! One component is left out, and three integers from -M to M, with M = 2^(b-1) - 1 for b bits, tell
//! the others, in the order x, y, z, w:
//!
//! ```text
//! smallest three   decode   q.c = sqrt(n), n = 2 M^2 - i^2 - j^2 - l^2
//!                           the three others = (i, j, l);                            q /= sqrt(2) M
//!                           the identity if n < 0, which no encoder gives
//!                  encode   (i, j, l) = round(sqrt(2) M (the three others) / |q|)
//! tan three        decode   q.c = 1
//!                           the three others = tan((pi / 4) (i, j, l) / M);          q /= |q|
//!                  encode   (i, j, l) = round(M (4 / pi) atan((the three others) / q.c))
//! ```
//!
//! `encode` leaves out the component c of the greatest magnitude, the first of equals, made positive by
//! -q, which is the same rotation. For the smallest three, `encode_precise` takes the other charts too:
//! where no component exceeds sqrt(1/2), all four have codes, and for a sixth of all rotations one of
//! another chart is the nearest. So it is nearer than the best of the eight roundings down or up of the
//! chart of the greatest component, whose mean is 0.0830 degrees at 32 bits.
//!
//! Angles are those of the rotation between two quaternions, twice the angle between them in 4D. Mean
//! and greatest error in degrees, the mean of uniformly random rotations:
//!
//! ```text
//!                    encode                 encode_precise
//!                    mean       greatest    mean       greatest
//! SmallestThree32    0.0844     0.275       0.0793     0.158
//! SmallestThree48    0.00263    0.00858     0.00247    0.00495
//! SmallestThree64    0.0000825  0.00031     0.0000774  0.000163
//! TanThree32         0.0745     0.153       0.0734     0.153
//! ```
//!
//! ```
//! use unitpack::quaternion::{QuaternionCodec, SmallestThree32};
//! let q = [0.0, 0.6, 0.0, 0.8];
//! let code = SmallestThree32::encode_precise(q);
//! assert_eq!(code, SmallestThree32::encode_precise(q.map(|c| -2.0 * c)));
//! let back = SmallestThree32::decode(code);
//! assert!((0..4).all(|i| (back[i] - q[i]).abs() < 1e-3));
//! ```
//!
//! Source: smallest three: Fiedler, "Snapshot Compression", 2015. That all charts are searched, and the
//! tangents over the largest component, are unitpack's.

use bytemuck::Pod;

use crate::batch::layout::{self, CodeLayout, Codes, CodesMut, Vectors, VectorsMut};
use crate::batch::storage::{from_native, to_native};
use crate::error::{LengthMismatch, StrideMismatch};
use crate::formula::support::sanitize::sanitize4;
use crate::vector::{Strided, StridedMut};
use chart::{OneWord, ThreeWords, TwoWords};
use formula::{Rotation, RotationKernels};
use near::{To, decode_near, near};
use smallest_three::SmallestThree;
use tan_three::TanThree;

pub use format::QuaternionFormat;

mod chart;
mod format;
mod formula;
mod near;
mod plain;
mod smallest_three;
mod tan_three;

/// Quaternions to read, as a structure of arrays. All four slices have one element per quaternion.
#[derive(Clone, Copy, Debug)]
pub struct Soa4<'a> {
    /// The x components.
    pub x: &'a [f32],
    /// The y components.
    pub y: &'a [f32],
    /// The z components.
    pub z: &'a [f32],
    /// The w components.
    pub w: &'a [f32],
}

/// Quaternions to write, as a structure of arrays. All four slices have one element per quaternion.
#[derive(Debug)]
pub struct Soa4Mut<'a> {
    /// The x components.
    pub x: &'a mut [f32],
    /// The y components.
    pub y: &'a mut [f32],
    /// The z components.
    pub z: &'a mut [f32],
    /// The w components.
    pub w: &'a mut [f32],
}

impl Soa4<'_> {
    #[inline]
    fn lengths(&self) -> [usize; 4] {
        [self.x.len(), self.y.len(), self.z.len(), self.w.len()]
    }

    #[inline]
    fn check(&self, codes: usize) -> Result<(), LengthMismatch> {
        LengthMismatch::check_quaternions(self.lengths(), codes)
    }

    #[inline]
    fn check_bytes(&self, bytes: usize, code_size: usize) -> Result<(), LengthMismatch> {
        LengthMismatch::check_quaternion_bytes(self.lengths(), bytes, code_size)
    }
}

impl Soa4Mut<'_> {
    #[inline]
    fn lengths(&self) -> [usize; 4] {
        [self.x.len(), self.y.len(), self.z.len(), self.w.len()]
    }

    #[inline]
    fn check(&self, codes: usize) -> Result<(), LengthMismatch> {
        LengthMismatch::check_quaternions(self.lengths(), codes)
    }

    #[inline]
    fn check_bytes(&self, bytes: usize, code_size: usize) -> Result<(), LengthMismatch> {
        LengthMismatch::check_quaternion_bytes(self.lengths(), bytes, code_size)
    }
}

impl<'a> From<Soa4<'a>> for Vectors<'a, 4> {
    #[inline]
    fn from(q: Soa4<'a>) -> Self {
        Vectors::Columns([q.x, q.y, q.z, q.w])
    }
}

impl<'a> From<Soa4Mut<'a>> for VectorsMut<'a, 4> {
    #[inline]
    fn from(q: Soa4Mut<'a>) -> Self {
        VectorsMut::Columns([q.x, q.y, q.z, q.w])
    }
}

/// A representation of rotations as unit quaternions x, y, z, w, w being the real part, as in
/// `glam::Quat`.
///
/// Any input is allowed, and only its direction in 4D matters: q, -q and all their multiples encode
/// alike. Zero and NaN encode as the identity, (0, 0, 0, 1), and infinite components as the limit
/// direction. Any bit pattern decodes to a unit quaternion; the component left out is >= 0. All entry
/// points give the same bits.
///
/// Both encoders are stable: they give the code that they gave once again for what it decodes to. So a
/// buffer that is decoded and encoded keeps its bytes.
pub trait QuaternionCodec: RotationKernels + Copy + 'static {
    /// One packed rotation. Its bits are laid out as the codec's page says.
    type Code: Pod + Eq + core::fmt::Debug;
    /// Such as "smallest-three32".
    const NAME: &'static str;
    /// How many bits of a code say something. The others are zero, and ignored in decoding.
    const BITS: u32;
    /// A bound of the greatest error of `encode`, in degrees of rotation, about half a per cent above
    /// it.
    const MAX_ERROR_DEGREES: f64;
    /// A bound of the greatest error of `encode_precise`, in degrees of rotation, about half a per
    /// cent above it.
    const MAX_ERROR_PRECISE_DEGREES: f64;

    /// Packs a quaternion of any length, rounding each parameter to nearest, ties to even. Gives a
    /// canonical code.
    fn encode(q: [f32; 4]) -> Self::Code;

    /// Packs a quaternion of any length into the code that decodes closest to its rotation, up to
    /// `f32` rounding. Gives a canonical code.
    fn encode_precise(q: [f32; 4]) -> Self::Code;

    /// Unpacks a code, any bit pattern, into a quaternion of length 1 to 2.5e-7.
    fn decode(code: Self::Code) -> [f32; 4];

    /// [`decode`](QuaternionCodec::decode), or the opposite if that is nearer to `previous`. q and -q are one rotation, but
    /// what decoding gives changes its sign where another component becomes the greatest, as in the course of
    /// a turn. Interpolation must not go from q to -q.
    ///
    /// ```
    /// use unitpack::quaternion::{QuaternionCodec, SmallestThree32};
    /// let [before, after] = [[0.0, 0.0, 0.72, -0.694], [0.0, 0.0, 0.694, -0.72]].map(SmallestThree32::encode);
    /// let [a, b] = [before, after].map(SmallestThree32::decode);
    /// assert!(a[2] > 0.0 && b[2] < 0.0);
    /// assert!(SmallestThree32::decode_near(after, a)[2] > 0.0);
    /// ```
    #[inline]
    fn decode_near(code: Self::Code, previous: [f32; 4]) -> [f32; 4] {
        near(Self::decode(code), previous)
    }

    /// The code that encoders emit for the rotation of `code`, any bit pattern: of several that mean
    /// one rotation the same. It is `encode_precise(decode(code))`. In the formats of more than 32 bits, codes
    /// whose unit quaternions are equal in `f32` mean one rotation.
    fn canonical(code: Self::Code) -> Self::Code;

    /// Whether encoders emit `code` for its rotation.
    #[inline]
    fn is_canonical(code: Self::Code) -> bool {
        Self::canonical(code) == code
    }

    /// [`encode`](QuaternionCodec::encode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the five slices are not equally long; nothing is written then.
    #[inline]
    fn encode_soa(q: Soa4<'_>, codes: &mut [Self::Code]) -> Result<(), LengthMismatch> {
        q.check(codes.len())?;
        Self::encode_batch(q.into(), CodesMut::native(codes));
        Ok(())
    }

    /// [`encode_precise`](QuaternionCodec::encode_precise) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the five slices are not equally long; nothing is written then.
    #[inline]
    fn encode_soa_precise(q: Soa4<'_>, codes: &mut [Self::Code]) -> Result<(), LengthMismatch> {
        q.check(codes.len())?;
        Self::encode_batch_precise(q.into(), CodesMut::native(codes));
        Ok(())
    }

    /// [`decode`](QuaternionCodec::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the five slices are not equally long; nothing is written then.
    #[inline]
    fn decode_soa(codes: &[Self::Code], q: Soa4Mut<'_>) -> Result<(), LengthMismatch> {
        q.check(codes.len())?;
        Self::decode_batch(Codes::native(codes), q.into());
        Ok(())
    }

    /// [`encode`](QuaternionCodec::encode) for arrays of structures.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos(q: &[[f32; 4]], codes: &mut [Self::Code]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(q.len(), codes.len())?;
        Self::encode_batch(Vectors::rows(q), CodesMut::native(codes));
        Ok(())
    }

    /// [`encode_precise`](QuaternionCodec::encode_precise) for arrays of structures.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos_precise(q: &[[f32; 4]], codes: &mut [Self::Code]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(q.len(), codes.len())?;
        Self::encode_batch_precise(Vectors::rows(q), CodesMut::native(codes));
        Ok(())
    }

    /// [`decode`](QuaternionCodec::decode) for arrays of structures.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn decode_aos(codes: &[Self::Code], q: &mut [[f32; 4]]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(q.len(), codes.len())?;
        Self::decode_batch(Codes::native(codes), VectorsMut::rows(q));
        Ok(())
    }

    /// [`decode_near`](QuaternionCodec::decode_near) for arrays of structures: each becomes near to the rotation that it
    /// replaces, as joints of a skeleton from one frame to the next.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn decode_aos_near(codes: &[Self::Code], q: &mut [[f32; 4]]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(q.len(), codes.len())?;
        decode_near(&Self::decode_batch, Codes::native(codes), q, To::Replaced);
        Ok(())
    }

    /// [`decode_near`](QuaternionCodec::decode_near) for a track: each becomes near to the one before it, and the first near to
    /// `previous`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn decode_track(
        codes: &[Self::Code],
        previous: [f32; 4],
        q: &mut [[f32; 4]],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(q.len(), codes.len())?;
        decode_near(&Self::decode_batch, Codes::native(codes), q, To::Before(previous));
        Ok(())
    }

    /// [`encode`](QuaternionCodec::encode) for quaternions of four native floats, x, y, z and w, and codes, both at a stride.
    /// See [`Strided`].
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn encode_strided(q: Strided<'_>, codes: StridedMut<'_>) -> Result<(), StrideMismatch> {
        let (q, codes) = q.encoded(codes, CodeLayout::native::<Self::Code>())?;
        Self::encode_batch(q, codes);
        Ok(())
    }

    /// [`encode_precise`](QuaternionCodec::encode_precise) for quaternions and codes at a stride, as
    /// [`encode_strided`](QuaternionCodec::encode_strided) takes them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn encode_strided_precise(q: Strided<'_>, codes: StridedMut<'_>) -> Result<(), StrideMismatch> {
        let (q, codes) = q.encoded(codes, CodeLayout::native::<Self::Code>())?;
        Self::encode_batch_precise(q, codes);
        Ok(())
    }

    /// [`decode`](QuaternionCodec::decode) for codes and quaternions at a stride, as
    /// [`encode_strided`](QuaternionCodec::encode_strided) takes them. What lies between the quaternions stays as it is.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn decode_strided(codes: Strided<'_>, q: StridedMut<'_>) -> Result<(), StrideMismatch> {
        let (codes, q) = codes.decoded(q, CodeLayout::native::<Self::Code>())?;
        Self::decode_batch(codes, q);
        Ok(())
    }

    /// [`encode_strided`](QuaternionCodec::encode_strided) in place: the code of the quaternion at `q.offset` goes to
    /// `code_offset` in the same bytes, the others each a stride further on. Both may overlap: an element is read before
    /// it is written.
    ///
    /// ```
    /// use unitpack::StridedMut;
    /// use unitpack::quaternion::{QuaternionCodec, SmallestThree64};
    /// let mut joints = [[0.0f32, 0.0, 0.0, 1.0]; 5];
    /// SmallestThree64::encode_within(StridedMut::of(&mut joints, 0), 8)?;
    /// SmallestThree64::decode_within(StridedMut::of(&mut joints, 8), 0)?;
    /// assert_eq!(joints[4], [0.0, 0.0, 0.0, 1.0]);
    /// # Ok::<(), unitpack::StrideMismatch>(())
    /// ```
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or quaternion and code together are longer than the
    /// stride; nothing is written then.
    #[inline]
    fn encode_within(q: StridedMut<'_>, code_offset: usize) -> Result<(), StrideMismatch> {
        let within = q.vectors_within::<4>(code_offset, CodeLayout::native::<Self::Code>())?;
        layout::encode_within(within, &Self::encode_batch);
        Ok(())
    }

    /// [`encode_precise`](QuaternionCodec::encode_precise) in place, as [`encode_within`](QuaternionCodec::encode_within)
    /// has it.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or quaternion and code together are longer than the
    /// stride; nothing is written then.
    #[inline]
    fn encode_within_precise(q: StridedMut<'_>, code_offset: usize) -> Result<(), StrideMismatch> {
        let within = q.vectors_within::<4>(code_offset, CodeLayout::native::<Self::Code>())?;
        layout::encode_within(within, &Self::encode_batch_precise);
        Ok(())
    }

    /// [`decode_strided`](QuaternionCodec::decode_strided) in place: the quaternion of the code at `codes.offset` goes to
    /// `quaternion_offset` in the same bytes. Both may overlap, as in [`encode_within`](QuaternionCodec::encode_within).
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or quaternion and code together are longer than the
    /// stride; nothing is written then.
    #[inline]
    fn decode_within(
        codes: StridedMut<'_>,
        quaternion_offset: usize,
    ) -> Result<(), StrideMismatch> {
        let within =
            codes.codes_within::<4>(quaternion_offset, CodeLayout::native::<Self::Code>())?;
        layout::decode_within(within, &Self::decode_batch);
        Ok(())
    }
}

/// Defines the types and their `QuaternionCodec`.
macro_rules! codecs {
    ($(
        $(#[$doc:meta])*
        $name:ident: $code:ty = $text:literal, $bits:literal bits, $fast:literal / $precise:literal degrees,
            $formula:ty = $value:expr;
    )*) => {$(
        #[doc = concat!("`", $text, "`: ", $bits, " bits in a `", stringify!($code), "`.")]
        #[doc = ""]
        #[doc = concat!(
            "Maximum error: ", $fast, "° of rotation with `encode`, ", $precise, "° with `encode_precise`."
        )]
        #[doc = ""]
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct $name;

        const _: () = {
            type Bytes = [u8; size_of::<$code>()];
            const FORMULA: $formula = $value;

            impl QuaternionCodec for $name {
                type Code = $code;
                const NAME: &'static str = $text;
                const BITS: u32 = $bits;
                const MAX_ERROR_DEGREES: f64 = $fast;
                const MAX_ERROR_PRECISE_DEGREES: f64 = $precise;

                #[inline]
                fn encode(q: [f32; 4]) -> $code {
                    to_native::<Bytes, $code>(FORMULA.encode::<f32>(sanitize4(q)))
                }
                #[inline]
                fn encode_precise(q: [f32; 4]) -> $code {
                    to_native::<Bytes, $code>(FORMULA.encode_precise::<f32>(sanitize4(q)))
                }
                #[inline]
                fn decode(code: $code) -> [f32; 4] {
                    FORMULA.decode::<f32>(from_native::<Bytes, $code>(code))
                }
                #[inline]
                fn canonical(code: $code) -> $code {
                    let code = from_native::<Bytes, $code>(code);
                    to_native::<Bytes, $code>(FORMULA.canonical::<f32>(code))
                }
            }

            impl RotationKernels for $name {
                #[inline(never)]
                fn encode_batch(quaternions: Vectors<'_, 4>, codes: CodesMut<'_>) {
                    formula::encode::<_, Bytes, false>(FORMULA, quaternions, codes);
                }
                #[inline(never)]
                fn encode_batch_precise(quaternions: Vectors<'_, 4>, codes: CodesMut<'_>) {
                    formula::encode::<_, Bytes, true>(FORMULA, quaternions, codes);
                }
                #[inline(never)]
                fn decode_batch(codes: Codes<'_>, quaternions: VectorsMut<'_, 4>) {
                    formula::decode::<_, Bytes>(FORMULA, codes, quaternions);
                }
            }
        };
    )*};
}

codecs! {
    /// Smallest three, 10-10-10-2: the three others in two's complement, the first in the low bits, and
    /// in the top two bits which component is left out, 0 to 3 for x to w. -512 reads as -511. The
    /// rotations (1, 0, 0, 0) to (0, 0, 0, 1) survive exactly.
    SmallestThree32: u32 = "smallest-three32", 32 bits, 0.2755 / 0.1592 degrees,
        SmallestThree<OneWord> = SmallestThree::in_one_word(10);
    /// Smallest three: the three others in two's complement in the low 15 bits of a word each. The top
    /// bits of the first and the second word are the low and the high bit of which component is left
    /// out, 0 to 3 for x to w; the top bit of the third is spare. -16384 reads as -16383. The rotations
    /// (1, 0, 0, 0) to (0, 0, 0, 1) survive exactly.
    SmallestThree48: [u16; 3] = "smallest-three48", 47 bits, 0.00862 / 0.00498 degrees,
        SmallestThree<ThreeWords> = SmallestThree::in_three_words();
    /// Smallest three: the three others in two's complement of 20 bits, the first in the low bits; bits
    /// 60 and 61 are spare, and the top two bits tell which component is left out, 0 to 3 for x to w.
    /// -524288 reads as -524287. The rotations (1, 0, 0, 0) to (0, 0, 0, 1) survive exactly.
    SmallestThree64: u64 = "smallest-three64", 62 bits, 0.000315 / 0.000167 degrees,
        SmallestThree<TwoWords> = SmallestThree::in_two_words(20, 62);
    /// Tangents over the largest, 10-10-10-2: the three others in two's complement, the first in the low
    /// bits, and in the top two bits which component is left out, 0 to 3 for x to w. -512 reads as
    /// -511. The rotations (1, 0, 0, 0) to (0, 0, 0, 1) survive exactly, and so do all whose components
    /// are 0, c and -c.
    TanThree32: u32 = "tan-three32", 32 bits, 0.1533 / 0.1533 degrees,
        TanThree<OneWord> = TanThree::new(OneWord::new(10));
}
