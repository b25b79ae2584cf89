//! The table of codecs, and what each can do.

use crate::batch::{self, Soa, SoaMut};
use crate::error::LengthMismatch;
use crate::formula::{
    Behind, Formula, cartesian, cube, disk, fibonacci, front_oct, hemi_oct, icosphere, latlong,
    oct, octant, phi_z, spherical, xy_only,
};

mod format;
mod report;

pub use crate::formula::fibonacci::SphericalFibonacci;
pub use format::{UnknownFormat, Visitor};
pub use report::ErrorReport;

/// A representation of unit vectors: what a bit pattern means, and how to get there.
///
/// The promises that hold for every codec are listed on the [crate's page](crate#promises). In
/// short: any input is allowed and only its direction matters; zero and NaN encode as +Z, an
/// infinite component as the limit direction, and a hemisphere codec takes z < 0 as 0; every bit
/// pattern decodes to a unit vector; all entry points give the same bits.
///
/// # Bit layout
/// The first parameter stands in the low bits, in two's complement if it is snorm. Snorm counts from
/// -M to M, with M = 2^(b-1) - 1 for b bits; the pattern -M-1 reads as -M. A code narrower than its
/// integer leaves the high bits zero, and decoding ignores them.
///
/// Two parameters u and v of 12 bits stand in three bytes as the survey's RGB8 has them:
/// `[u >> 4, (u & 15) << 4 | v >> 8, v & 255]`. Snorm ones are then biased: u and v plus 2047, where
/// 4095 reads as 4094. All other codes of three bytes are integers in little-endian order.
///
/// # Operations on codes
/// [`canonical`](Codec::canonical), [`negate`](Codec::negate) and [`mirror`](Codec::mirror) take any bit pattern and give
/// what `encode_precise` gives for the decoded vector, or that negated or mirrored: a canonical code. In a hemisphere's format, a
/// direction mirrored in Z falls below the rim, and so is put on it.
///
/// Where a mirror image is a point of the format, it is exact: doing it twice gives the canonical code again, and negating
/// is mirroring in X, Y and Z in turn. It is found in integers, without decoding, but for these, which decode, encode
/// precisely, and so give the nearest point, in that time:
///
/// - in Z, and negated: HemiOct, XYOnly, frontoct, quadfrontoct and oct-unorm,
/// - in X, and negated: phi-z, latlong, and latlongD on parallels with an odd number of points,
/// - in X and Z, and negated: of disk projections as they are, without a stretch, the few codes whose image would be in
///   column 0 of the lower hemisphere, which does not exist,
/// - fibonacci; and snorm16x3, xyz-unorm16x3 and float16x3, where images are exact up to `f32` rounding.
///
/// Half way between two points, as in X of phi-z and latlong, `f32` rounding decides. `Float32x3` flips signs, those of NaN too.
pub trait Codec: Copy + 'static {
    /// One packed vector. Its bits are laid out as the codec's page says.
    type Code: bytemuck::Pod + Eq + core::fmt::Debug;
    /// The run-time twin of this type.
    const FORMAT: Format;

    /// Packs a vector of any length, rounding each parameter to nearest, ties to even. Gives a
    /// canonical code.
    fn encode(v: [f32; 3]) -> Self::Code;

    /// Packs a vector of any length into the code that decodes closest to it, up to `f32` rounding.
    /// Gives a canonical code.
    fn encode_precise(v: [f32; 3]) -> Self::Code;

    /// Unpacks a code, any bit pattern, into a vector of length 1 to 2.5e-7.
    fn decode(code: Self::Code) -> [f32; 3];

    /// The code that encoders emit for the direction of `code`, any bit pattern: of several that mean
    /// one direction the same. It is `encode_precise(decode(code))`, found without decoding but in
    /// `Snorm16x3`, `XyzUnorm16x3` and `Float16x3`, where it takes as long as encoding.
    ///
    /// ```
    /// use unitpack::{Codec, Oct16};
    /// // (-127, -5) and (-127, 5) are one point of the border; -128 reads as -127.
    /// let border = |u: i8, w: i8| u16::from_le_bytes([u as u8, w as u8]);
    /// assert_eq!(Oct16::canonical(border(-128, -5)), border(-127, 5));
    /// assert!(Oct16::is_canonical(border(-127, 5)));
    /// ```
    fn canonical(code: Self::Code) -> Self::Code;

    /// Whether encoders emit `code` for its direction.
    #[inline]
    fn is_canonical(code: Self::Code) -> bool {
        Self::canonical(code) == code
    }

    /// The code of the opposite direction: `encode_precise` of the negated `decode(code)`. Most formats find it
    /// without decoding: see [Operations on codes](Codec#operations-on-codes).
    ///
    /// ```
    /// use unitpack::{Codec, Oct16};
    /// let [z, minus_z] = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]].map(Oct16::encode);
    /// assert_eq!(Oct16::negate(z), minus_z);
    /// ```
    fn negate(code: Self::Code) -> Self::Code;

    /// The code of the direction mirrored in one axis: `encode_precise` of `decode(code)` with that component
    /// negated. Most formats find it without decoding: see [Operations on codes](Codec#operations-on-codes).
    ///
    /// ```
    /// use unitpack::{Axis, Codec, Oct16};
    /// // (127, 5) is a point of the border, where (127, -5) means the same.
    /// let code = |u: i8, w: i8| u16::from_le_bytes([u as u8, w as u8]);
    /// assert_eq!(Oct16::mirror(code(127, 5), Axis::X), code(-127, 5));
    /// assert_eq!(Oct16::mirror(code(127, 5), Axis::Y), code(127, 5));
    /// ```
    fn mirror(code: Self::Code, axis: Axis) -> Self::Code;

    /// Whether two codes, any bit patterns, mean one direction: whether their [`canonical`](Codec::canonical)
    /// codes are equal.
    #[inline]
    fn same_direction(a: Self::Code, b: Self::Code) -> bool {
        Self::canonical(a) == Self::canonical(b)
    }

    /// [`canonical`](Codec::canonical) for many codes, in place.
    fn canonical_slice(codes: &mut [Self::Code]);

    /// [`negate`](Codec::negate) for many codes, in place.
    fn negate_slice(codes: &mut [Self::Code]);

    /// [`mirror`](Codec::mirror) for many codes, in place.
    fn mirror_slice(codes: &mut [Self::Code], axis: Axis);

    /// [`encode`](Codec::encode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    fn encode_soa(v: Soa<'_>, codes: &mut [Self::Code]) -> Result<(), LengthMismatch>;

    /// [`encode_precise`](Codec::encode_precise) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    fn encode_soa_precise(v: Soa<'_>, codes: &mut [Self::Code]) -> Result<(), LengthMismatch>;

    /// [`decode`](Codec::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    fn decode_soa(codes: &[Self::Code], v: SoaMut<'_>) -> Result<(), LengthMismatch>;

    /// [`encode`](Codec::encode) for arrays of structures of `N` floats, of which the first three are
    /// x, y and z. `N < 3` does not compile:
    ///
    /// ```compile_fail
    /// use unitpack::{Codec, Oct16};
    /// let _ = Oct16::encode_aos(&[[1.0f32, 0.0]], &mut [0]);
    /// ```
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos<const N: usize>(
        v: &[[f32; N]],
        codes: &mut [Self::Code],
    ) -> Result<(), LengthMismatch> {
        batch::encode_aos(v, codes, Self::encode_soa)
    }

    /// [`encode_precise`](Codec::encode_precise) for arrays of structures of `N` floats, of which the
    /// first three are x, y and z. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos_precise<const N: usize>(
        v: &[[f32; N]],
        codes: &mut [Self::Code],
    ) -> Result<(), LengthMismatch> {
        batch::encode_aos(v, codes, Self::encode_soa_precise)
    }

    /// [`decode`](Codec::decode) for arrays of structures of `N` floats. The first three become x, y
    /// and z; the others stay as they are. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn decode_aos<const N: usize>(
        codes: &[Self::Code],
        v: &mut [[f32; N]],
    ) -> Result<(), LengthMismatch> {
        batch::decode_aos(codes, v, Self::decode_soa)
    }
}

/// A component of a vector, which [`Codec::mirror`] negates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    #[inline(always)]
    fn flips(self) -> [bool; 3] {
        [self == Axis::X, self == Axis::Y, self == Axis::Z]
    }
}

/// Writes the types, their `Codec`, and `Format` from the table below.
macro_rules! codecs {
    ($(
        $family:literal {$(
            $name:ident: $code:ty = $text:literal, $bits:literal bits, $fast:literal / $precise:literal degrees,
                $formula:ty;
        )*}
    )*) => {
        $($(
            #[doc = concat!("`", $text, "`: ", $bits, " bits in a `", stringify!($code), "`.")]
            #[doc = ""]
            #[doc = concat!(
                "Greatest error: at most ", $fast, "° with `encode`, ", $precise, "° with `encode_precise`."
            )]
            #[doc = ""]
            #[doc = $family]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
            pub struct $name;

            impl Behind for $name {
                type Formula = $formula;
            }

            impl Codec for $name {
                type Code = $code;
                const FORMAT: Format = Format::$name;

                #[inline]
                fn encode(v: [f32; 3]) -> $code {
                    batch::encode_one::<$formula, $code>(v)
                }
                #[inline]
                fn encode_precise(v: [f32; 3]) -> $code {
                    batch::encode_one_precise::<$formula, $code>(v)
                }
                #[inline]
                fn decode(code: $code) -> [f32; 3] {
                    batch::decode_one::<$formula, $code>(code)
                }
                #[inline]
                fn canonical(code: $code) -> $code {
                    batch::canonical_one::<$formula, $code>(code)
                }
                #[inline]
                fn negate(code: $code) -> $code {
                    batch::mirror_one::<$formula, $code>(code, [true; 3])
                }
                #[inline]
                fn mirror(code: $code, axis: Axis) -> $code {
                    batch::mirror_one::<$formula, $code>(code, axis.flips())
                }
                #[inline]
                fn canonical_slice(codes: &mut [$code]) {
                    batch::canonical_all::<$formula, $code>(codes);
                }
                #[inline]
                fn negate_slice(codes: &mut [$code]) {
                    batch::mirror_all::<$formula, $code>(codes, [true; 3]);
                }
                #[inline]
                fn mirror_slice(codes: &mut [$code], axis: Axis) {
                    batch::mirror_all::<$formula, $code>(codes, axis.flips());
                }
                #[inline]
                fn encode_soa(v: Soa<'_>, codes: &mut [$code]) -> Result<(), LengthMismatch> {
                    batch::encode_soa::<$formula, $code>(v, codes)
                }
                #[inline]
                fn encode_soa_precise(
                    v: Soa<'_>,
                    codes: &mut [$code],
                ) -> Result<(), LengthMismatch> {
                    batch::encode_soa_precise::<$formula, $code>(v, codes)
                }
                #[inline]
                fn decode_soa(codes: &[$code], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
                    batch::decode_soa::<$formula, $code>(codes, v)
                }
            }
        )*)*

        /// A codec chosen at run time: one variant per codec, in the order of the table.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Format {$($(
            #[doc = concat!("[`", stringify!($name), "`](struct@", stringify!($name), ")")]
            $name,
        )*)*}

        impl Format {
            /// Every format, in the order of the table.
            pub const ALL: &'static [Format] = &[$($(Format::$name,)*)*];

            /// The survey's own name, such as "oct16".
            #[inline]
            pub const fn name(self) -> &'static str {
                match self {$($(Format::$name => $text,)*)*}
            }

            /// How many bits of a code say something. The others are zero, and ignored in decoding.
            #[inline]
            pub const fn bits(self) -> u32 {
                match self {$($(Format::$name => $bits,)*)*}
            }

            /// How many bytes one code takes.
            #[inline]
            pub const fn code_size(self) -> usize {
                match self {$($(Format::$name => size_of::<$code>(),)*)*}
            }

            /// Whether only directions with z >= 0 are represented.
            #[inline]
            pub const fn is_hemisphere(self) -> bool {
                match self {$($(Format::$name => <$formula>::HEMISPHERE,)*)*}
            }

            /// A bound of the greatest error of `encode`, in degrees, mostly half a per cent above
            /// it. For any input with z >= 0 if the format is a hemisphere's.
            #[inline]
            pub const fn max_error_degrees(self) -> f64 {
                match self {$($(Format::$name => $fast,)*)*}
            }

            /// A bound of the greatest error of `encode_precise`, in degrees, mostly half a per cent above
            /// it. For any input with z >= 0 if the format is a hemisphere's.
            #[inline]
            pub const fn max_error_precise_degrees(self) -> f64 {
                match self {$($(Format::$name => $precise,)*)*}
            }

            /// Calls `v` with the type of this codec.
            #[inline]
            pub fn visit<V: Visitor>(self, v: V) -> V::Output {
                match self {$($(Format::$name => v.visit::<$name>(),)*)*}
            }
        }
    };
}

// THE TABLE. One row per codec: type, code, name, bits, greatest error of `encode` and
// `encode_precise`, formula.
codecs! {
    "[Octahedral](https://jcgt.org/published/0003/02/01/): the sphere unfolded from an octahedron into a square. Two snorm \
     [parameters](Codec#bit-layout). All six axes survive exactly." {
        Oct8: u8 = "oct8", 8 bits, 17.26 / 11.47 degrees, oct::Oct<oct::Central, 8>;
        Oct10: u16 = "oct10", 10 bits, 8.082 / 5.373 degrees, oct::Oct<oct::Central, 10>;
        Oct12: u16 = "oct12", 12 bits, 3.935 / 2.623 degrees, oct::Oct<oct::Central, 12>;
        Oct14: u16 = "oct14", 14 bits, 1.937 / 1.291 degrees, oct::Oct<oct::Central, 14>;
        Oct16: u16 = "oct16", 16 bits, 0.9609 / 0.6406 degrees, oct::Oct<oct::Central, 16>;
        Oct18: u32 = "oct18", 18 bits, 0.4786 / 0.3191 degrees, oct::Oct<oct::Central, 18>;
        Oct20: u32 = "oct20", 20 bits, 0.2388 / 0.1592 degrees, oct::Oct<oct::Central, 20>;
        Oct22: u32 = "oct22", 22 bits, 0.1193 / 0.07953 degrees, oct::Oct<oct::Central, 22>;
        Oct24: [u8; 3] = "oct24", 24 bits, 0.05962 / 0.03975 degrees, oct::Oct<oct::Central, 24>;
        Oct26: u32 = "oct26", 26 bits, 0.02981 / 0.01987 degrees, oct::Oct<oct::Central, 26>;
        Oct28: u32 = "oct28", 28 bits, 0.01490 / 0.009934 degrees, oct::Oct<oct::Central, 28>;
        Oct30: u32 = "oct30", 30 bits, 0.007460 / 0.004968 degrees, oct::Oct<oct::Central, 30>;
        Oct32: u32 = "oct32", 32 bits, 0.003736 / 0.002486 degrees, oct::Oct<oct::Central, 32>;
    }
    "Octahedral with cells of about the same size: each coordinate of [`Oct16`]'s octahedron warped by a cubic. With \
     `encode_precise` the least greatest error of all formats of its size. oct, denser around the axes, has the smaller mean error \
     where normals crowd there, as on built geometry. Two snorm [parameters](Codec#bit-layout). All six axes survive exactly." {
        WarpedOct16: u16 = "warpedoct16", 16 bits, 0.8893 / 0.5198 degrees, oct::Oct<oct::Warped, 16>;
        WarpedOct20: u32 = "warpedoct20", 20 bits, 0.2211 / 0.1289 degrees, oct::Oct<oct::Warped, 20>;
        WarpedOct22: u32 = "warpedoct22", 22 bits, 0.1105 / 0.06450 degrees, oct::Oct<oct::Warped, 22>;
        WarpedOct24: [u8; 3] = "warpedoct24", 24 bits, 0.05521 / 0.03223 degrees, oct::Oct<oct::Warped, 24>;
        WarpedOct32: u32 = "warpedoct32", 32 bits, 0.003486 / 0.002014 degrees, oct::Oct<oct::Warped, 32>;
    }
    "Octahedral with cells of equal area, as environment maps have it. Two snorm [parameters](Codec#bit-layout). All six axes \
     survive exactly." {
        EqAreaOct16: u16 = "eqareaoct16", 16 bits, 0.9710 / 0.5848 degrees, oct::Oct<oct::EqualArea, 16>;
        EqAreaOct24: [u8; 3] = "eqareaoct24", 24 bits, 0.06045 / 0.03694 degrees, oct::Oct<oct::EqualArea, 24>;
        EqAreaOct32: u32 = "eqareaoct32", 32 bits, 0.003800 / 0.002313 degrees, oct::Oct<oct::EqualArea, 32>;
    }
    "[Octahedral](https://jcgt.org/published/0003/02/01/) whose steps are a multiple of six: 126, 2046 or 32766. Two snorm \
     [parameters](Codec#bit-layout), of which greater ones read as the greatest. All six axes and all middles of the edges and \
     corners of a cube, such as (1, 1, 0) and (1, 1, 1), survive exactly." {
        SixOct16: u16 = "sixoct16", 16 bits, 0.9694 / 0.6462 degrees, oct::Oct<oct::Central, 16, 6>;
        SixOct24: [u8; 3] = "sixoct24", 24 bits, 0.05972 / 0.03981 degrees, oct::Oct<oct::Central, 24, 6>;
        SixOct32: u32 = "sixoct32", 32 bits, 0.003742 / 0.002489 degrees, oct::Oct<oct::Central, 32, 6>;
    }
    "Octahedral with more precision towards +Z, as for normals that mostly face the viewer: cells are half as wide as [`Oct16`]'s at \
     +Z and twice as wide at -Z. Two snorm [parameters](Codec#bit-layout). Of the axes, +-Z survive exactly; at 32 bits all." {
        FrontOct16: u16 = "frontoct16", 16 bits, 1.341 / 0.9276 degrees, front_oct::FrontOct<16, 2>;
        FrontOct24: [u8; 3] = "frontoct24", 24 bits, 0.08320 / 0.05754 degrees, front_oct::FrontOct<24, 2>;
        FrontOct32: u32 = "frontoct32", 32 bits, 0.005219 / 0.003595 degrees, front_oct::FrontOct<32, 2>;
    }
    "As [`FrontOct16`], but a quarter as wide at +Z and four times as wide at -Z. Two snorm \
     [parameters](Codec#bit-layout). Of the axes, +-Z survive exactly; at 24 bits all." {
        QuadFrontOct16: u16 = "quadfrontoct16", 16 bits, 1.814 / 1.447 degrees, front_oct::FrontOct<16, 4>;
        QuadFrontOct24: [u8; 3] = "quadfrontoct24", 24 bits, 0.1126 / 0.08962 degrees, front_oct::FrontOct<24, 4>;
    }
    "Cartesian: the three components, x in the low bits, as many bits each as the name says; decoding divides by the length. Snorm \
     -M-1 reads as -M, infinite and NaN halves as 65504, (0, 0, 0) as +Z. Of the patterns of one direction the one whose length \
     is nearest to 1 is canonical; snorm16x3 and float16x3 are finer than `f32`, so there what decodes alike is one direction. All six \
     axes survive exactly." {
        Snorm5x3: u16 = "snorm5x3", 15 bits, 3.299 / 2.707 degrees, cartesian::Cartesian<cartesian::Snorm<5, 5, 5>>;
        Snorm8x3: [u8; 3] = "snorm8x3", 24 bits, 0.3920 / 0.3203 degrees, cartesian::Cartesian<cartesian::Snorm<8, 8, 8>>;
        Snorm10x3: u32 = "snorm10x3", 30 bits, 0.09747 / 0.07960 degrees, cartesian::Cartesian<cartesian::Snorm<10, 10, 10>>;
        Snorm11_11_10: u32 = "snorm11-11-10", 32 bits, 0.06889 / 0.06292 degrees, cartesian::Cartesian<cartesian::Snorm<11, 11, 10>>;
        Snorm16x3: [u16; 3] = "snorm16x3", 48 bits, 0.00153 / 0.00124 degrees, cartesian::Cartesian<cartesian::Snorm16>;
        Float16x3: [u16; 3] = "float16x3", 48 bits, 0.0240 / 0.00766 degrees, cartesian::Cartesian<cartesian::Halves>;
    }
    "Three `f32`, bit for bit: what is stored is what is given back, of any length, zero and NaN included." {
        Float32x3: [u32; 3] = "float32x3", 96 bits, 0.0 / 0.0 degrees, cartesian::Floats;
    }
    "Spherical: polar angle, 2 theta / pi - 1, and azimuth, phi / pi, as two snorm \
     [parameters](Codec#bit-layout). Canonical: at a pole the azimuth is 0, on -X it is M. Of the axes, +-Z and +-X survive \
     exactly." {
        Spherical16: u16 = "spherical16", 16 bits, 0.7955 / 0.7955 degrees, spherical::Spherical<16>;
        Spherical20: u32 = "spherical20", 20 bits, 0.1978 / 0.1978 degrees, spherical::Spherical<20>;
        Spherical22: u32 = "spherical22", 22 bits, 0.09877 / 0.09876 degrees, spherical::Spherical<22>;
        Spherical24: [u8; 3] = "spherical24", 24 bits, 0.04937 / 0.04936 degrees, spherical::Spherical<24>;
        Spherical32: u32 = "spherical32", 32 bits, 0.003093 / 0.003086 degrees, spherical::Spherical<32>;
    }
    "Hemi-oct: the +Z hemisphere, octahedral, turned so that it fills the square. Two snorm \
     [parameters](Codec#bit-layout). +Z, +-X and +-Y survive exactly." {
        HemiOct16: u16 = "HemiOct16", 16 bits, 0.5548 / 0.5548 degrees, hemi_oct::HemiOct<16>;
        HemiOct24: [u8; 3] = "HemiOct24", 24 bits, 0.03443 / 0.03442 degrees, hemi_oct::HemiOct<24>;
        HemiOct32: u32 = "HemiOct32", 32 bits, 0.002163 / 0.002151 degrees, hemi_oct::HemiOct<32>;
    }
    "Signed oct: two snorm [parameters](Codec#bit-layout) as [`HemiOct16`] has them, and above them a bit that is set where z < 0. For \
     odd budgets: 10 + 10 + 1 bits leave 11 of a word. All six axes survive exactly." {
        SignedOct17: u32 = "signedoct17", 17 bits, 0.5554 / 0.5554 degrees, hemi_oct::SignedOct<16>;
        SignedOct21: u32 = "signedoct21", 21 bits, 0.1381 / 0.1381 degrees, hemi_oct::SignedOct<20>;
        SignedOct23: [u8; 3] = "signedoct23", 23 bits, 0.06895 / 0.06895 degrees, hemi_oct::SignedOct<22>;
        SignedOct31: u32 = "signedoct31", 31 bits, 0.004319 / 0.004307 degrees, hemi_oct::SignedOct<30>;
    }
    "XY-only: the +Z hemisphere, x and y as two unorm [parameters](Codec#bit-layout), (c + 1) / 2. \
     Beyond the rim, the smaller component is kept, but no more than the first grid value from sqrt(1/2); the larger one is put on the \
     rim, and z is 0. No axis survives exactly." {
        XyOnly16: u16 = "XYOnly16", 16 bits, 6.05 / 3.611 degrees, xy_only::XyOnly<xy_only::Unorm<16>>;
        XyOnly24: [u8; 3] = "XYOnly24", 24 bits, 1.51 / 0.8991 degrees, xy_only::XyOnly<xy_only::Unorm<24>>;
        XyOnly32: u32 = "XYOnly32", 32 bits, 0.379 / 0.2248 degrees, xy_only::XyOnly<xy_only::Unorm<32>>;
    }
    "XY-only: the +Z hemisphere, x and y as two halves, x in the low bits. Magnitudes above 1, infinity and NaN read as 1. Beyond the rim, the \
     smaller component is kept, but no more than the first half from sqrt(1/2); the larger one is put on the rim, and z is 0. +Z, +-X \
     and +-Y survive exactly." {
        XyOnly32F: u32 = "XYOnly32F", 32 bits, 1.51 / 0.8989 degrees, xy_only::XyOnly<xy_only::Halves>;
    }
    "Disk projection, stereographic, as it is: codes outside the disk decode past the equator, where only `encode_precise` \
     uses them. Two snorm [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2. Of the axes, +-X survive \
     exactly." {
        Stereo16: u16 = "stereo16", 16 bits, 1.013 / 1.013 degrees, disk::Disk<disk::Stereo, disk::Plain, 16>;
        Stereo20: u32 = "stereo20", 20 bits, 0.2518 / 0.2518 degrees, disk::Disk<disk::Stereo, disk::Plain, 20>;
        Stereo22: u32 = "stereo22", 22 bits, 0.1258 / 0.1258 degrees, disk::Disk<disk::Stereo, disk::Plain, 22>;
        Stereo24: [u8; 3] = "stereo24", 24 bits, 0.06285 / 0.06284 degrees, disk::Disk<disk::Stereo, disk::Plain, 24>;
        Stereo32: u32 = "stereo32", 32 bits, 0.003932 / 0.003926 degrees, disk::Disk<disk::Stereo, disk::Plain, 32>;
    }
    "Disk projection, stereographic, stretched to the square by mapping circles to squares (Shirley and Chiu). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2. Of the axes, +-X survive exactly." {
        StereoConcentric16: u16 = "stereo+concentric16", 16 bits, 1.355 / 0.9926 degrees, disk::Disk<disk::Stereo, disk::Concentric, 16>;
        StereoConcentric20: u32 = "stereo+concentric20", 20 bits, 0.3435 / 0.2468 degrees, disk::Disk<disk::Stereo, disk::Concentric, 20>;
        StereoConcentric22: u32 = "stereo+concentric22", 22 bits, 0.1724 / 0.1233 degrees, disk::Disk<disk::Stereo, disk::Concentric, 22>;
        StereoConcentric24: [u8; 3] = "stereo+concentric24", 24 bits, 0.08642 / 0.06160 degrees, disk::Disk<disk::Stereo, disk::Concentric, 24>;
        StereoConcentric32: u32 = "stereo+concentric32", 32 bits, 0.005428 / 0.003848 degrees, disk::Disk<disk::Stereo, disk::Concentric, 32>;
    }
    "Disk projection, stereographic, stretched to the square by elliptical arcs (Nowell). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2. Of the axes, +-X survive exactly." {
        StereoEllipse16: u16 = "stereo+ellipse16", 16 bits, 1.013 / 1.013 degrees, disk::Disk<disk::Stereo, disk::Ellipse, 16>;
        StereoEllipse20: u32 = "stereo+ellipse20", 20 bits, 0.2518 / 0.2518 degrees, disk::Disk<disk::Stereo, disk::Ellipse, 20>;
        StereoEllipse22: u32 = "stereo+ellipse22", 22 bits, 0.1258 / 0.1258 degrees, disk::Disk<disk::Stereo, disk::Ellipse, 22>;
        StereoEllipse24: [u8; 3] = "stereo+ellipse24", 24 bits, 0.06285 / 0.06284 degrees, disk::Disk<disk::Stereo, disk::Ellipse, 24>;
        StereoEllipse32: u32 = "stereo+ellipse32", 32 bits, 0.003932 / 0.003926 degrees, disk::Disk<disk::Stereo, disk::Ellipse, 32>;
    }
    "Disk projection, equal-area, as it is: codes outside the disk decode past the equator, where only `encode_precise` uses \
     them. Two snorm [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2. Of the axes, +-X survive \
     exactly, and with `encode_precise` +-Z." {
        EqArea16: u16 = "eqarea16", 16 bits, 1.016 / 0.9262 degrees, disk::Disk<disk::EqArea, disk::Plain, 16>;
        EqArea20: u32 = "eqarea20", 20 bits, 0.2520 / 0.2316 degrees, disk::Disk<disk::EqArea, disk::Plain, 20>;
        EqArea22: u32 = "eqarea22", 22 bits, 0.1258 / 0.1159 degrees, disk::Disk<disk::EqArea, disk::Plain, 22>;
        EqArea24: [u8; 3] = "eqarea24", 24 bits, 0.06286 / 0.05791 degrees, disk::Disk<disk::EqArea, disk::Plain, 24>;
        EqArea32: u32 = "eqarea32", 32 bits, 0.003947 / 0.003620 degrees, disk::Disk<disk::EqArea, disk::Plain, 32>;
    }
    "Disk projection, equal-area, stretched to the square by mapping circles to squares (Shirley and Chiu). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2. Of the axes, +-X survive exactly." {
        EqAreaConcentric16: u16 = "eqarea+concentric16", 16 bits, 1.048 / 0.9167 degrees, disk::Disk<disk::EqArea, disk::Concentric, 16>;
        EqAreaConcentric20: u32 = "eqarea+concentric20", 20 bits, 0.2611 / 0.2291 degrees, disk::Disk<disk::EqArea, disk::Concentric, 20>;
        EqAreaConcentric22: u32 = "eqarea+concentric22", 22 bits, 0.1305 / 0.1146 degrees, disk::Disk<disk::EqArea, disk::Concentric, 22>;
        EqAreaConcentric24: [u8; 3] = "eqarea+concentric24", 24 bits, 0.06522 / 0.05726 degrees, disk::Disk<disk::EqArea, disk::Concentric, 24>;
        EqAreaConcentric32: u32 = "eqarea+concentric32", 32 bits, 0.004099 / 0.003579 degrees, disk::Disk<disk::EqArea, disk::Concentric, 32>;
    }
    "Disk projection, equal-area, stretched to the square by elliptical arcs (Nowell). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2. Of the axes, +-X survive exactly." {
        EqAreaEllipse16: u16 = "eqarea+ellipse16", 16 bits, 0.9213 / 0.9131 degrees, disk::Disk<disk::EqArea, disk::Ellipse, 16>;
        EqAreaEllipse20: u32 = "eqarea+ellipse20", 20 bits, 0.2296 / 0.2283 degrees, disk::Disk<disk::EqArea, disk::Ellipse, 20>;
        EqAreaEllipse22: u32 = "eqarea+ellipse22", 22 bits, 0.1148 / 0.1141 degrees, disk::Disk<disk::EqArea, disk::Ellipse, 22>;
        EqAreaEllipse24: [u8; 3] = "eqarea+ellipse24", 24 bits, 0.05735 / 0.05705 degrees, disk::Disk<disk::EqArea, disk::Ellipse, 24>;
        EqAreaEllipse32: u32 = "eqarea+ellipse32", 32 bits, 0.003604 / 0.003566 degrees, disk::Disk<disk::EqArea, disk::Ellipse, 32>;
    }
    "Disk projection, equidistant, as it is: codes outside the disk decode past the equator, where only `encode_precise` uses \
     them. Two snorm [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2. Of the axes, +-X survive \
     exactly." {
        EqDist16: u16 = "eqdist16", 16 bits, 0.7955 / 0.7955 degrees, disk::Disk<disk::EqDist, disk::Plain, 16>;
        EqDist20: u32 = "eqdist20", 20 bits, 0.1978 / 0.1978 degrees, disk::Disk<disk::EqDist, disk::Plain, 20>;
        EqDist22: u32 = "eqdist22", 22 bits, 0.09877 / 0.09876 degrees, disk::Disk<disk::EqDist, disk::Plain, 22>;
        EqDist24: [u8; 3] = "eqdist24", 24 bits, 0.04937 / 0.04936 degrees, disk::Disk<disk::EqDist, disk::Plain, 24>;
        EqDist32: u32 = "eqdist32", 32 bits, 0.003098 / 0.003086 degrees, disk::Disk<disk::EqDist, disk::Plain, 32>;
    }
    "Disk projection, equidistant, stretched to the square by mapping circles to squares (Shirley and Chiu). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2. Of the axes, +-X survive exactly." {
        EqDistConcentric16: u16 = "eqdist+concentric16", 16 bits, 1.078 / 0.7798 degrees, disk::Disk<disk::EqDist, disk::Concentric, 16>;
        EqDistConcentric20: u32 = "eqdist+concentric20", 20 bits, 0.2710 / 0.1938 degrees, disk::Disk<disk::EqDist, disk::Concentric, 20>;
        EqDistConcentric22: u32 = "eqdist+concentric22", 22 bits, 0.1358 / 0.09680 degrees, disk::Disk<disk::EqDist, disk::Concentric, 22>;
        EqDistConcentric24: [u8; 3] = "eqdist+concentric24", 24 bits, 0.06799 / 0.04838 degrees, disk::Disk<disk::EqDist, disk::Concentric, 24>;
        EqDistConcentric32: u32 = "eqdist+concentric32", 32 bits, 0.004264 / 0.003022 degrees, disk::Disk<disk::EqDist, disk::Concentric, 32>;
    }
    "Disk projection, equidistant, stretched to the square by elliptical arcs (Nowell). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2. Of the axes, +-X survive exactly." {
        EqDistEllipse16: u16 = "eqdist+ellipse16", 16 bits, 0.7955 / 0.7955 degrees, disk::Disk<disk::EqDist, disk::Ellipse, 16>;
        EqDistEllipse20: u32 = "eqdist+ellipse20", 20 bits, 0.1978 / 0.1978 degrees, disk::Disk<disk::EqDist, disk::Ellipse, 20>;
        EqDistEllipse22: u32 = "eqdist+ellipse22", 22 bits, 0.09877 / 0.09876 degrees, disk::Disk<disk::EqDist, disk::Ellipse, 22>;
        EqDistEllipse24: [u8; 3] = "eqdist+ellipse24", 24 bits, 0.04937 / 0.04936 degrees, disk::Disk<disk::EqDist, disk::Ellipse, 24>;
        EqDistEllipse32: u32 = "eqdist+ellipse32", 32 bits, 0.003105 / 0.003086 degrees, disk::Disk<disk::EqDist, disk::Ellipse, 32>;
    }
    "Lat-long: as many points on each parallel as there are parallels. The code is an index, row by row from +Z; the last \
     indices read as -Z. Of the axes, +-Z and +X survive exactly." {
        LatLong16: u16 = "latlong16", 16 bits, 0.7930 / 0.7930 degrees, latlong::LatLong<latlong::Even<16>>;
        LatLong24: [u8; 3] = "latlong24", 24 bits, 0.04937 / 0.04935 degrees, latlong::LatLong<latlong::Even<24>>;
        LatLong32: u32 = "latlong32", 32 bits, 0.003110 / 0.003088 degrees, latlong::LatLong<latlong::Even<32>>;
    }
    "Lat-long with fewer points towards the poles, so that cells are about as wide as high. The code is an index, row by row \
     from +Z; the last indices read as -Z. A table of 4 bytes a parallel: 1 KB at 16 bits, 15 KB at 24, 232 KB at 32. Of the axes, \
     +-Z and +X survive exactly, and at 16 and 24 bits -X." {
        LatLong16D: u16 = "latlong16D", 16 bits, 0.5647 / 0.5645 degrees, latlong::LatLong<latlong::Spaced<16>>;
        LatLong24D: [u8; 3] = "latlong24D", 24 bits, 0.03524 / 0.03522 degrees, latlong::LatLong<latlong::Spaced<24>>;
        LatLong32D: u32 = "latlong32D", 32 bits, 0.002228 / 0.002205 degrees, latlong::LatLong<latlong::Spaced<32>>;
    }
    "[Spherical Fibonacci](SphericalFibonacci): 2^bits points of about the same area on a spiral from +Z to -Z. The code is the \
     index. No axis survives exactly." {
        Fibonacci16: u16 = "fibonacci16", 16 bits, 0.6137 / 0.6137 degrees, fibonacci::Fibonacci<16>;
        Fibonacci24: [u8; 3] = "fibonacci24", 24 bits, 0.03836 / 0.03836 degrees, fibonacci::Fibonacci<24>;
    }
    "Cube map: 3 bits of face, 2 axis + sign, and two snorm parameters, next / |axis| and next but one / |axis|. The highest \
     bit is unused. All six axes survive exactly." {
        Cube16: u16 = "cube16", 16 bits, 1.312 / 1.312 degrees, cube::Cube<cube::Flat, 16>;
        Cube24: [u8; 3] = "cube24", 24 bits, 0.07961 / 0.07961 degrees, cube::Cube<cube::Flat, 24>;
        Cube32: u32 = "cube32", 32 bits, 0.004966 / 0.004966 degrees, cube::Cube<cube::Flat, 32>;
    }
    "Cube map with even steps of the angle: as cube, each parameter the 4 / pi atan of cube's. The highest bit is unused. All \
     six axes survive exactly." {
        WarpedCube16: u16 = "warpedcube16", 16 bits, 1.181 / 1.031 degrees, cube::Cube<cube::Warped, 16>;
        WarpedCube24: [u8; 3] = "warpedcube24", 24 bits, 0.07216 / 0.06252 degrees, cube::Cube<cube::Warped, 24>;
        WarpedCube32: u32 = "warpedcube32", 32 bits, 0.004506 / 0.003901 degrees, cube::Cube<cube::Warped, 32>;
    }
    "Schinko's angular cube: each face cut into s x s cells of even angle, decoded to their centres, s = floor(sqrt(2^bits / 6)). \
     The code is the index (i s + j) 6 + face; the last indices read as the last cell. The paper's \"error limit\", half the mean \
     distance between neighbours (45°, 6.541°, 1.515°, 0.380° and 0.095° at 4, 8, 12, 16 and 20 bits), is no bound: the greatest error \
     is up to 1.85 times that. All six axes survive exactly if s is odd, else none." {
        AngularCube4: u8 = "angularcube4", 4 bits, 54.96 / 54.96 degrees, cube::AngularCube<4>;
        AngularCube5: u8 = "angularcube5", 5 bits, 30.49 / 30.49 degrees, cube::AngularCube<5>;
        AngularCube6: u8 = "angularcube6", 6 bits, 21.33 / 19.74 degrees, cube::AngularCube<6>;
        AngularCube7: u8 = "angularcube7", 7 bits, 16.47 / 15.78 degrees, cube::AngularCube<7>;
        AngularCube8: u8 = "angularcube8", 8 bits, 11.36 / 10.59 degrees, cube::AngularCube<8>;
        AngularCube9: u16 = "angularcube9", 9 bits, 7.760 / 7.030 degrees, cube::AngularCube<9>;
        AngularCube10: u16 = "angularcube10", 10 bits, 5.460 / 4.892 degrees, cube::AngularCube<10>;
        AngularCube11: u16 = "angularcube11", 11 bits, 3.985 / 3.548 degrees, cube::AngularCube<11>;
        AngularCube12: u16 = "angularcube12", 12 bits, 2.783 / 2.457 degrees, cube::AngularCube<12>;
        AngularCube13: u16 = "angularcube13", 13 bits, 2.021 / 1.775 degrees, cube::AngularCube<13>;
        AngularCube14: u16 = "angularcube14", 14 bits, 1.405 / 1.229 degrees, cube::AngularCube<14>;
        AngularCube15: u16 = "angularcube15", 15 bits, 1.004 / 0.8752 degrees, cube::AngularCube<15>;
        AngularCube16: u16 = "angularcube16", 16 bits, 0.7059 / 0.6144 degrees, cube::AngularCube<16>;
        AngularCube17: u32 = "angularcube17", 17 bits, 0.5002 / 0.4347 degrees, cube::AngularCube<17>;
        AngularCube18: u32 = "angularcube18", 18 bits, 0.3522 / 0.3058 degrees, cube::AngularCube<18>;
        AngularCube19: u32 = "angularcube19", 19 bits, 0.2497 / 0.2166 degrees, cube::AngularCube<19>;
        AngularCube20: u32 = "angularcube20", 20 bits, 0.1763 / 0.1529 degrees, cube::AngularCube<20>;
        AngularCube21: u32 = "angularcube21", 21 bits, 0.1248 / 0.1082 degrees, cube::AngularCube<21>;
        AngularCube22: u32 = "angularcube22", 22 bits, 0.08820 / 0.07643 degrees, cube::AngularCube<22>;
        AngularCube23: u32 = "angularcube23", 23 bits, 0.06240 / 0.05406 degrees, cube::AngularCube<23>;
        AngularCube24: [u8; 3] = "angularcube24", 24 bits, 0.04412 / 0.03822 degrees, cube::AngularCube<24>;
        AngularCube25: u32 = "angularcube25", 25 bits, 0.03121 / 0.02703 degrees, cube::AngularCube<25>;
        AngularCube26: u32 = "angularcube26", 26 bits, 0.02206 / 0.01911 degrees, cube::AngularCube<26>;
        AngularCube27: u32 = "angularcube27", 27 bits, 0.01561 / 0.01352 degrees, cube::AngularCube<27>;
        AngularCube28: u32 = "angularcube28", 28 bits, 0.01104 / 0.009554 degrees, cube::AngularCube<28>;
        AngularCube29: u32 = "angularcube29", 29 bits, 0.007806 / 0.006755 degrees, cube::AngularCube<29>;
        AngularCube30: u32 = "angularcube30", 30 bits, 0.005520 / 0.004777 degrees, cube::AngularCube<30>;
        AngularCube31: u32 = "angularcube31", 31 bits, 0.003912 / 0.003378 degrees, cube::AngularCube<31>;
        AngularCube32: u32 = "angularcube32", 32 bits, 0.002766 / 0.002389 degrees, cube::AngularCube<32>;
    }
    "Baptista's octant code: three signs and a point of the octant's triangle. `encode` truncates as the original does; \
     `encode_precise` gives the nearest code of the same format. All six axes survive exactly." {
        Octant16: u16 = "octant16", 16 bits, 1.937 / 0.6456 degrees, octant::Octant;
    }
    "Cartesian, scaled and biased: three unorm components, (c + 1) / 2, x in the low bits, as a UNORM render target holds \
     them. Decoding divides by the length. `encode_precise` gives the nearest direction of any length. xyz-unorm16x3 is finer \
     than `f32`, so there what decodes alike is one direction. No axis survives exactly." {
        XyzUnorm8x3: [u8; 3] = "xyz-unorm8x3", 24 bits, 0.3898 / 0.3191 degrees, cartesian::Cartesian<cartesian::Unorm<8>>;
        XyzUnorm16x3: [u16; 3] = "xyz-unorm16x3", 48 bits, 0.001528 / 0.001245 degrees, cartesian::Cartesian<cartesian::Unorm<16>>;
    }
    "Crytek's best-fit normals: the bits of [`XyzUnorm8x3`], of the length that a table of 256 KiB gives for the direction. \
     `encode_precise` needs no table, nor does decoding; a program that does not call `encode` does not contain it. No axis \
     survives exactly." {
        CrytekBfn24: [u8; 3] = "CrytekBFN24", 24 bits, 0.3191 / 0.3191 degrees, cartesian::BestFit;
    }
    "Azimuth and z, each as unorm [parameter](Codec#bit-layout), (phi / pi + 1) / 2 and (z + 1) / 2. Of the axes, +-Z survive \
     exactly." {
        PhiZUnorm8x2: u16 = "phi-z-unorm8x2", 16 bits, 5.097 / 3.605 degrees, phi_z::PhiZ<16>;
        PhiZUnorm16x2: u32 = "phi-z-unorm16x2", 32 bits, 0.3193 / 0.2248 degrees, phi_z::PhiZ<32>;
    }
    "[Octahedral](https://jcgt.org/published/0003/02/01/), each parameter as unorm, (c + 1) / 2, as a UNORM render target \
     holds it. Two [parameters](Codec#bit-layout). Of the axes, -Z alone survives exactly." {
        OctUnorm8x2: u16 = "oct-unorm8x2", 16 bits, 0.9571 / 0.6381 degrees, oct::OctUnorm<16>;
        OctUnorm16x2: u32 = "oct-unorm16x2", 32 bits, 0.003746 / 0.002486 degrees, oct::OctUnorm<32>;
    }
    "Icosphere: the nearest of the 162 vertices of an icosahedron with edges cut into four, as Quake 2 had them. Codes from \
     162 read as 161. A table of 2 KB. All six axes survive exactly." {
        Icosphere162: u8 = "icosphere162", 8 bits, 10.86 / 10.86 degrees, icosphere::Icosphere;
    }
}
