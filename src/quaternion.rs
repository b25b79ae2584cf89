//! Rotations as unit quaternions in 32, 48 or 64 bits: [`SmallestThree32`], [`SmallestThree48`],
//! [`SmallestThree64`] and [`TanThree32`], all [`QuaternionCodec`]s.
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

use core::marker::PhantomData;

use bytemuck::Pod;

use crate::error::LengthMismatch;
use crate::formula::{Stored, Words, direction4};
use crate::simd::Simd;
use crate::simd::dispatch::{Job, dispatch};

mod chart;
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

/// A representation of rotations as unit quaternions x, y, z, w, w being the real part, as in
/// `glam::Quat`.
///
/// Any input is allowed, and only its direction in 4D matters: q, -q and all their multiples encode
/// alike. Zero and NaN encode as the identity, (0, 0, 0, 1), and infinite components as the limit
/// direction. Any bit pattern decodes to a unit quaternion; the component left out is >= 0. All entry
/// points give the same bits.
pub trait QuaternionCodec: Copy + 'static {
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

    /// The code that encoders emit for the rotation of `code`, any bit pattern: of several that mean
    /// one rotation the same. In the formats of 32 bits it is `encode_precise(decode(code))`; the others
    /// have different rotations nearer to each other than `f32` can tell, where that may be the other.
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
    fn encode_soa(q: Soa4<'_>, codes: &mut [Self::Code]) -> Result<(), LengthMismatch>;

    /// [`encode_precise`](QuaternionCodec::encode_precise) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the five slices are not equally long; nothing is written then.
    fn encode_soa_precise(q: Soa4<'_>, codes: &mut [Self::Code]) -> Result<(), LengthMismatch>;

    /// [`decode`](QuaternionCodec::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the five slices are not equally long; nothing is written then.
    fn decode_soa(codes: &[Self::Code], q: Soa4Mut<'_>) -> Result<(), LengthMismatch>;

    /// [`encode`](QuaternionCodec::encode) for arrays of structures.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos(q: &[[f32; 4]], codes: &mut [Self::Code]) -> Result<(), LengthMismatch> {
        encode_structures(q, codes, Self::encode_soa)
    }

    /// [`encode_precise`](QuaternionCodec::encode_precise) for arrays of structures.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos_precise(q: &[[f32; 4]], codes: &mut [Self::Code]) -> Result<(), LengthMismatch> {
        encode_structures(q, codes, Self::encode_soa_precise)
    }

    /// [`decode`](QuaternionCodec::decode) for arrays of structures.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn decode_aos(codes: &[Self::Code], q: &mut [[f32; 4]]) -> Result<(), LengthMismatch> {
        decode_structures(codes, q, Self::decode_soa)
    }
}

/// Writes the types and their `QuaternionCodec`.
macro_rules! codecs {
    ($(
        $(#[$doc:meta])*
        $name:ident: $code:ty = $text:literal, $bits:literal bits, $fast:literal / $precise:literal degrees,
            $formula:ty;
    )*) => {$(
        #[doc = concat!("`", $text, "`: ", $bits, " bits in a `", stringify!($code), "`.")]
        #[doc = ""]
        #[doc = concat!(
            "Greatest error: at most ", $fast, "° of rotation with `encode`, ", $precise, "° with `encode_precise`."
        )]
        #[doc = ""]
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        pub struct $name;

        impl QuaternionCodec for $name {
            type Code = $code;
            const NAME: &'static str = $text;
            const BITS: u32 = $bits;
            const MAX_ERROR_DEGREES: f64 = $fast;
            const MAX_ERROR_PRECISE_DEGREES: f64 = $precise;

            #[inline]
            fn encode(q: [f32; 4]) -> $code {
                encode_one::<Fast, $formula, $code>(q)
            }
            #[inline]
            fn encode_precise(q: [f32; 4]) -> $code {
                encode_one::<Precise, $formula, $code>(q)
            }
            #[inline]
            fn decode(code: $code) -> [f32; 4] {
                <$formula>::decode::<f32>(<$code>::load::<f32>(&[code]))
            }
            #[inline]
            fn canonical(code: $code) -> $code {
                let mut canonical = [code];
                <$code>::store::<f32>(
                    <$formula>::canonical::<f32>(<$code>::load::<f32>(&[code])),
                    &mut canonical,
                );
                canonical[0]
            }
            #[inline]
            fn encode_soa(q: Soa4<'_>, codes: &mut [$code]) -> Result<(), LengthMismatch> {
                encode_all::<Fast, $formula, $code>(q, codes)
            }
            #[inline]
            fn encode_soa_precise(q: Soa4<'_>, codes: &mut [$code]) -> Result<(), LengthMismatch> {
                encode_all::<Precise, $formula, $code>(q, codes)
            }
            #[inline]
            fn decode_soa(codes: &[$code], q: Soa4Mut<'_>) -> Result<(), LengthMismatch> {
                decode_all::<$formula, $code>(codes, q)
            }
        }
    )*};
}

codecs! {
    /// Smallest three, 10-10-10-2: the three others in two's complement, the first in the low bits, and
    /// in the top two bits which component is left out, 0 to 3 for x to w. -512 reads as -511. The
    /// rotations (1, 0, 0, 0) to (0, 0, 0, 1) survive exactly.
    SmallestThree32: u32 = "smallest-three32", 32 bits, 0.2755 / 0.1592 degrees,
        smallest_three::SmallestThree<chart::Tens>;
    /// Smallest three: the three others in two's complement in the low 15 bits of a word each. The top
    /// bits of the first and the second word are the low and the high bit of which component is left
    /// out, 0 to 3 for x to w; the top bit of the third is spare. -16384 reads as -16383. The rotations
    /// (1, 0, 0, 0) to (0, 0, 0, 1) survive exactly.
    SmallestThree48: [u16; 3] = "smallest-three48", 47 bits, 0.00862 / 0.00498 degrees,
        smallest_three::SmallestThree<chart::Fifteens>;
    /// Smallest three: the three others in two's complement of 20 bits, the first in the low bits; bits
    /// 60 and 61 are spare, and the top two bits tell which component is left out, 0 to 3 for x to w.
    /// -524288 reads as -524287. The rotations (1, 0, 0, 0) to (0, 0, 0, 1) survive exactly.
    SmallestThree64: u64 = "smallest-three64", 62 bits, 0.000315 / 0.000167 degrees,
        smallest_three::SmallestThree<chart::Twenties>;
    /// Tangents over the largest, 10-10-10-2: the three others in two's complement, the first in the low
    /// bits, and in the top two bits which component is left out, 0 to 3 for x to w. -512 reads as
    /// -511. The rotations (1, 0, 0, 0) to (0, 0, 0, 1) survive exactly, and so do all whose components
    /// are 0, c and -c.
    TanThree32: u32 = "tan-three32", 32 bits, 0.1533 / 0.1533 degrees,
        tan_three::TanThree<chart::Tens>;
}

/// A representation, as arithmetic on lanes.
trait Rotation: 'static {
    type Words: Words;

    /// The fast encoder, of what [`direction4`] gives. Gives canonical codes.
    fn encode<V: Simd>(q: [V; 4]) -> <Self::Words as Words>::Packed<V>;
    /// The code whose decoded rotation is closest to that of `q`, canonical.
    fn encode_precise<V: Simd>(q: [V; 4]) -> <Self::Words as Words>::Packed<V>;
    /// Total: a unit quaternion for every bit pattern.
    fn decode<V: Simd>(code: <Self::Words as Words>::Packed<V>) -> [V; 4];
    /// The code that encoders emit for the rotation of `code`.
    fn canonical<V: Simd>(
        code: <Self::Words as Words>::Packed<V>,
    ) -> <Self::Words as Words>::Packed<V>;
}

/// Which of a rotation's encoders.
trait Encoder {
    fn encode<F: Rotation, V: Simd>(q: [V; 4]) -> <F::Words as Words>::Packed<V>;
}

struct Fast;
struct Precise;

impl Encoder for Fast {
    #[inline(always)]
    fn encode<F: Rotation, V: Simd>(q: [V; 4]) -> <F::Words as Words>::Packed<V> {
        F::encode(q)
    }
}

impl Encoder for Precise {
    #[inline(always)]
    fn encode<F: Rotation, V: Simd>(q: [V; 4]) -> <F::Words as Words>::Packed<V> {
        F::encode_precise(q)
    }
}

#[inline(always)]
fn encode_block<E: Encoder, F: Rotation, C: Stored<F::Words>, V: Simd>(
    q: [&V::Block<f32>; 4],
    codes: &mut V::Block<C>,
) {
    let [x, y, z, w] = q;
    let q = direction4([V::load(x), V::load(y), V::load(z), V::load(w)]);
    C::store::<V>(E::encode::<F, V>(q), codes);
}

#[inline]
fn encode_one<E: Encoder, F: Rotation, C: Stored<F::Words>>([x, y, z, w]: [f32; 4]) -> C {
    let mut code = [C::zeroed()];
    encode_block::<E, F, C, f32>([&[x], &[y], &[z], &[w]], &mut code);
    code[0]
}

#[inline(never)]
fn encode_all<E: Encoder, F: Rotation, C: Stored<F::Words>>(
    q: Soa4<'_>,
    codes: &mut [C],
) -> Result<(), LengthMismatch> {
    struct EncodeAll<'a, E, F, C> {
        q: Soa4<'a>,
        codes: &'a mut [C],
        how: PhantomData<(E, F)>,
    }
    impl<E: Encoder, F: Rotation, C: Stored<F::Words>> Job for EncodeAll<'_, E, F, C> {
        #[inline(always)]
        fn run<V: Simd>(self) -> Self {
            let EncodeAll { q: Soa4 { x, y, z, w }, codes, how } = self;
            let ((xs, x), (ys, y), (zs, z), (ws, w)) =
                (V::split(x), V::split(y), V::split(z), V::split(w));
            let (blocks, codes) = V::split_mut(codes);
            for ((((x, y), z), w), codes) in xs.iter().zip(ys).zip(zs).zip(ws).zip(blocks) {
                encode_block::<E, F, C, V>([x, y, z, w], codes);
            }
            EncodeAll { q: Soa4 { x, y, z, w }, codes, how }
        }
    }
    let lengths = [q.x, q.y, q.z, q.w].map(<[f32]>::len);
    LengthMismatch::check_quaternions(lengths, codes.len())?;
    dispatch(EncodeAll { q, codes, how: PhantomData::<(E, F)> });
    Ok(())
}

#[inline(never)]
fn decode_all<F: Rotation, C: Stored<F::Words>>(
    codes: &[C],
    q: Soa4Mut<'_>,
) -> Result<(), LengthMismatch> {
    struct DecodeAll<'a, F, C> {
        codes: &'a [C],
        q: Soa4Mut<'a>,
        how: PhantomData<F>,
    }
    impl<F: Rotation, C: Stored<F::Words>> Job for DecodeAll<'_, F, C> {
        #[inline(always)]
        fn run<V: Simd>(self) -> Self {
            let DecodeAll { codes, q: Soa4Mut { x, y, z, w }, how } = self;
            let ((xs, x), (ys, y), (zs, z), (ws, w)) =
                (V::split_mut(x), V::split_mut(y), V::split_mut(z), V::split_mut(w));
            let (blocks, codes) = V::split(codes);
            for ((((codes, x), y), z), w) in blocks.iter().zip(xs).zip(ys).zip(zs).zip(ws) {
                let q = F::decode::<V>(C::load::<V>(codes));
                q[0].store(x);
                q[1].store(y);
                q[2].store(z);
                q[3].store(w);
            }
            DecodeAll { codes, q: Soa4Mut { x, y, z, w }, how }
        }
    }
    let lengths = [q.x.len(), q.y.len(), q.z.len(), q.w.len()];
    LengthMismatch::check_quaternions(lengths, codes.len())?;
    dispatch(DecodeAll { codes, q, how: PhantomData::<F> });
    Ok(())
}

/// How many quaternions stand on the stack at a time, between arrays of structures and the loops over
/// structures of arrays.
const STAGE: usize = 64;

/// Runs `encode` over an array of structures.
#[inline]
fn encode_structures<C>(
    q: &[[f32; 4]],
    codes: &mut [C],
    encode: fn(Soa4<'_>, &mut [C]) -> Result<(), LengthMismatch>,
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_aos(q.len(), codes.len())?;
    let [mut x, mut y, mut z, mut w] = [[0.0; STAGE]; 4];
    for (q, codes) in q.chunks(STAGE).zip(codes.chunks_mut(STAGE)) {
        let n = q.len().min(STAGE);
        for ((((q, x), y), z), w) in q.iter().zip(&mut x).zip(&mut y).zip(&mut z).zip(&mut w) {
            [*x, *y, *z, *w] = *q;
        }
        encode(Soa4 { x: &x[..n], y: &y[..n], z: &z[..n], w: &w[..n] }, codes)?;
    }
    Ok(())
}

/// Runs `decode` over an array of structures.
#[inline]
fn decode_structures<C>(
    codes: &[C],
    q: &mut [[f32; 4]],
    decode: fn(&[C], Soa4Mut<'_>) -> Result<(), LengthMismatch>,
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_aos(q.len(), codes.len())?;
    let [mut x, mut y, mut z, mut w] = [[0.0; STAGE]; 4];
    for (q, codes) in q.chunks_mut(STAGE).zip(codes.chunks(STAGE)) {
        let n = q.len().min(STAGE);
        decode(codes, Soa4Mut { x: &mut x[..n], y: &mut y[..n], z: &mut z[..n], w: &mut w[..n] })?;
        for ((((q, x), y), z), w) in q.iter_mut().zip(&x).zip(&y).zip(&z).zip(&w) {
            *q = [*x, *y, *z, *w];
        }
    }
    Ok(())
}
