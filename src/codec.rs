//! The table of codecs, and what each can do.

use crate::batch::{self, Soa, SoaMut};
use crate::error::LengthMismatch;
use crate::format::Visitor;
use crate::formula::Formula;

mod cartesian;
mod hemi_oct;
mod oct;
mod spherical;
mod xy_only;

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
/// 4095 reads as 4094.
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
                "Greatest error: ", $fast, "° with `encode`, ", $precise, "° with `encode_precise`."
            )]
            #[doc = ""]
            #[doc = $family]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
            pub struct $name;

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

            /// The greatest error of `encode`, in degrees. For any input with z >= 0 if the format
            /// is a hemisphere's.
            #[inline]
            pub const fn max_error_degrees(self) -> f64 {
                match self {$($(Format::$name => $fast,)*)*}
            }

            /// The greatest error of `encode_precise`, in degrees. For any input with z >= 0 if the
            /// format is a hemisphere's.
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
        Oct8: u8 = "oct8", 8 bits, 17.26 / 11.47 degrees, oct::Oct<8>;
        Oct10: u16 = "oct10", 10 bits, 8.082 / 5.373 degrees, oct::Oct<10>;
        Oct12: u16 = "oct12", 12 bits, 3.935 / 2.623 degrees, oct::Oct<12>;
        Oct14: u16 = "oct14", 14 bits, 1.937 / 1.291 degrees, oct::Oct<14>;
        Oct16: u16 = "oct16", 16 bits, 0.9609 / 0.6406 degrees, oct::Oct<16>;
        Oct18: u32 = "oct18", 18 bits, 0.4786 / 0.3191 degrees, oct::Oct<18>;
        Oct20: u32 = "oct20", 20 bits, 0.2388 / 0.1592 degrees, oct::Oct<20>;
        Oct22: u32 = "oct22", 22 bits, 0.1193 / 0.07953 degrees, oct::Oct<22>;
        Oct24: [u8; 3] = "oct24", 24 bits, 0.05962 / 0.03975 degrees, oct::Oct<24>;
        Oct26: u32 = "oct26", 26 bits, 0.02981 / 0.01987 degrees, oct::Oct<26>;
        Oct28: u32 = "oct28", 28 bits, 0.01490 / 0.009934 degrees, oct::Oct<28>;
        Oct30: u32 = "oct30", 30 bits, 0.007460 / 0.004968 degrees, oct::Oct<30>;
        Oct32: u32 = "oct32", 32 bits, 0.003736 / 0.002486 degrees, oct::Oct<32>;
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
        Float16x3: [u16; 3] = "float16x3", 48 bits, 0.0240 / 0.00710 degrees, cartesian::Cartesian<cartesian::Halves>;
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
}
