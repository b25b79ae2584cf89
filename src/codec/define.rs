//! Defines the types, their `Codec`, and `Format`, from the rows of the table.

use core::ops::RangeInclusive;

use super::format::Visitor;
use super::parameters::{Kind, TwoParameters};
use super::sealed::Batch;
use super::spare::{self, Spare};
use super::{Axis, Codec, codec_table};
use crate::batch::doubles::Keeps;
use crate::batch::storage::{CodeSlice, CodeSliceMut, MAX_CODE, from_native, to_native};
use crate::formula::names::*;
use crate::formula::{Formula, Kernels, Source, kernels};
use crate::simd::I32x1;
use crate::simd::stream::Fence;

/// The kernels of a row: the codec's own if it is `hot`, and otherwise those of its formula.
macro_rules! row_kernels {
    ($name:ident, $code:ty, $formula:ty, $value:expr; hot $($rest:ident)*) => {
        impl Source for $name {
            type Formula = $formula;
            #[inline(always)]
            fn formula(self) -> $formula {
                const { $value }
            }
        }
        kernels!($name: [u8; size_of::<$code>()], FORMULA);
        const KERNELS: &$name = &$name;
    };
    ($name:ident, $code:ty, $formula:ty, $value:expr; $flag:ident $($rest:ident)*) => {
        row_kernels!($name, $code, $formula, $value; $($rest)*);
    };
    ($name:ident, $code:ty, $formula:ty, $value:expr;) => {
        const KERNELS: &$formula = &$value;
    };
}

/// Implements [`TwoParameters`] if codes are two parameters of a kind.
macro_rules! two_parameters {
    ($name:ident, $bits:literal, none) => {};
    ($name:ident, $bits:literal, $pair:ident) => {
        impl TwoParameters for $name {
            const RANGE: RangeInclusive<i32> = KIND.range($bits);

            #[inline]
            fn from_parameters(parameters: [i32; 2]) -> Code {
                to_native::<Bytes, Code>(I32x1(KIND.pack($bits, parameters) as i32))
            }
            #[inline]
            fn parameters(code: Code) -> [i32; 2] {
                KIND.unpack($bits, from_native::<Bytes, Code>(code).0 as u32)
            }
        }
        const KIND: Kind = match Kind::of(stringify!($pair)) {
            Some(kind) => kind,
            None => panic!("a pair is snorm or unorm"),
        };
    };
}

/// The axes of `encode_precise`: those of `encode`, or its own.
macro_rules! precise_axes {
    ($axes:tt) => {
        $axes
    };
    ($axes:tt $precise:tt) => {
        $precise
    };
}

macro_rules! define_codecs {
    ($(
        #[cfg(feature = $feature:literal)]
        $family:literal, mirrors $mirrors:tt, $stable:ident, none $none:ident , pair $pair:ident {$(
            $name:ident: $code:ty = $text:literal, $bits:literal bits, $fast:literal / $precise:literal degrees,
                exact $axes:tt $(/ $axes_precise:tt)?,
                $formula:ident $(::<$($kind:ident),+>)? :: $new:ident ($($value:expr),*) $(, $flag:ident)*;
        )*}
    )*) => {
        $($(
            #[cfg(feature = $feature)]
            #[doc = concat!("`", $text, "`: ", $bits, " bits in a `", stringify!($code), "`.")]
            #[doc = ""]
            #[doc = concat!(
                "Maximum error: ", $fast, "° with `encode`, ", $precise, "° with `encode_precise`. ",
                stable_text!($stable)
            )]
            #[doc = ""]
            #[doc = $family]
            #[doc = ""]
            #[doc = concat!(
                "Axes that round-trip exactly: ", axes_text!($axes), $("; with `encode_precise`: ", axes_text!($axes_precise),)? ".",
                " Axes with exact [mirror images](Codec#operations-on-codes): ", axes_text!($mirrors),
                finer_text!($($flag)*), ".",
                " Feature: `", $feature, "`."
            )]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
            pub struct $name;

            #[cfg(feature = $feature)]
            const _: () = {
                type Code = $code;
                type Bytes = [u8; size_of::<$code>()];
                const FORMULA: $formula $(<$($kind),+>)? = $formula $(::<$($kind),+>)? :: $new($($value),*);

                row_kernels!(
                    $name, $code, $formula $(<$($kind),+>)?, $formula $(::<$($kind),+>)? :: $new($($value),*);
                    $($flag)*
                );

                impl Codec for $name {
                    type Code = Code;
                    const FORMAT: Format = Format::$name;
                    const NONE: Option<Code> = match Spare::$none.code($bits, size_of::<Code>()) {
                        Some(code) => {
                            Some(bytemuck::must_cast::<Bytes, Code>(spare::native(code, align_of::<Code>())))
                        }
                        None => None,
                    };

                    #[inline]
                    fn encode(v: [f32; 3]) -> Code {
                        let v = FORMULA.prepare::<f32>(v.into());
                        to_native::<Bytes, Code>(FORMULA.encode(v))
                    }
                    #[inline]
                    fn encode_precise(v: [f32; 3]) -> Code {
                        let v = FORMULA.prepare::<f32>(v.into());
                        to_native::<Bytes, Code>(FORMULA.encode_precise(v))
                    }
                    #[inline]
                    fn decode(code: Code) -> [f32; 3] {
                        FORMULA.decode::<f32>(from_native::<Bytes, Code>(code)).to_array()
                    }
                    #[inline]
                    fn canonical(code: Code) -> Code {
                        mirror(code, [false; 3])
                    }
                    #[inline]
                    fn negate(code: Code) -> Code {
                        mirror(code, [true; 3])
                    }
                    #[inline]
                    fn mirror(code: Code, axis: Axis) -> Code {
                        mirror(code, axis.flips())
                    }
                }

                two_parameters!($name, $bits, $pair);

                impl Batch for $name {
                    #[inline]
                    fn encode_columns(v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
                        KERNELS.encode(v, codes);
                    }
                    #[inline]
                    fn encode_columns_precise(v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
                        KERNELS.encode_precise(v, codes);
                    }
                    #[inline]
                    fn decode_columns(codes: CodeSlice<'_>, v: [&mut [f32]; 3], fence: &Fence) {
                        KERNELS.decode(codes, v, fence);
                    }
                    #[inline]
                    fn mirror_codes(from: CodeSlice<'_>, to: CodeSliceMut<'_>, flips: [bool; 3]) {
                        KERNELS.mirror(from, to, flips);
                    }
                }

                #[inline(always)]
                fn mirror(code: Code, flips: [bool; 3]) -> Code {
                    let code = from_native::<Bytes, Code>(code);
                    to_native::<Bytes, Code>(FORMULA.mirror::<f32>(code, flips))
                }
            };
        )*)*

        /// A codec chosen at run time: one variant per codec, in the order of the table.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Format {$($(
            #[cfg(feature = $feature)]
            #[doc = concat!("[`", stringify!($name), "`](struct@", stringify!($name), ")")]
            $name,
        )*)*}

        impl Format {
            /// Every format, in the order of the table.
            pub const ALL: &'static [Format] = &[$($(#[cfg(feature = $feature)] Format::$name,)*)*];

            /// The survey's own name, such as "oct16".
            #[inline]
            pub const fn name(self) -> &'static str {
                match self {$($(#[cfg(feature = $feature)] Format::$name => $text,)*)*}
            }

            /// Number of significant bits. Higher bits are zero when encoded and ignored when decoded.
            #[inline]
            pub const fn bits(self) -> u32 {
                match self {$($(#[cfg(feature = $feature)] Format::$name => $bits,)*)*}
            }

            /// Size of a code in bytes.
            #[inline]
            pub const fn code_size(self) -> usize {
                match self {$($(#[cfg(feature = $feature)] Format::$name => size_of::<$code>(),)*)*}
            }

            /// Whether only directions with z >= 0 are represented.
            #[inline]
            pub const fn is_hemisphere(self) -> bool {
                match self {$($(
                    #[cfg(feature = $feature)]
                    Format::$name => <$formula $(<$($kind),+>)? as Formula>::HEMISPHERE,
                )*)*}
            }

            /// Upper bound on the error of `encode` in degrees, usually within 0.5 % of the true maximum.
            /// For hemisphere formats it holds for inputs with z >= 0.
            #[inline]
            pub const fn max_error_degrees(self) -> f64 {
                match self {$($(#[cfg(feature = $feature)] Format::$name => $fast,)*)*}
            }

            /// Upper bound on the error of `encode_precise` in degrees, usually within 0.5 % of the true
            /// maximum. For hemisphere formats it holds for inputs with z >= 0.
            #[inline]
            pub const fn max_error_precise_degrees(self) -> f64 {
                match self {$($(#[cfg(feature = $feature)] Format::$name => $precise,)*)*}
            }

            /// The axes that `encode` and `decode` return exactly, such as "±X ±Z"; "" if there are none.
            #[inline]
            pub const fn exact_axes(self) -> &'static str {
                match self {$($(#[cfg(feature = $feature)] Format::$name => $axes,)*)*}
            }

            /// The axes that `encode_precise` and `decode` return exactly, such as "±X ±Z"; "" if there are
            /// none.
            #[inline]
            pub const fn exact_axes_precise(self) -> &'static str {
                match self {$($(#[cfg(feature = $feature)] Format::$name => precise_axes!($axes $($axes_precise)?),)*)*}
            }

            /// The axes in which the mirror images of all codes are points of the format, such as "X Y", so
            /// that [`Codec::mirror`] is exact; "" if there are none.
            #[inline]
            pub const fn exact_mirrors(self) -> &'static str {
                match self {$($(#[cfg(feature = $feature)] Format::$name => $mirrors,)*)*}
            }

            /// Whether `encode(decode(code))` is `code` for every canonical code, so that decoding a buffer and encoding
            /// it again keeps its bytes. For the other formats [`encode_precise`](Codec::encode_precise) does that: see
            /// the [promises](crate#promises).
            #[inline]
            pub const fn encode_is_stable(self) -> bool {
                match self {$($(#[cfg(feature = $feature)] Format::$name => is_stable!($stable),)*)*}
            }

            /// The little-endian bytes of [`Codec::NONE`], if this codec has it.
            #[inline]
            pub const fn none(self) -> Option<&'static [u8]> {
                match self {$($(#[cfg(feature = $feature)] Format::$name => {
                    const CODE: Option<[u8; MAX_CODE]> = Spare::$none.code($bits, size_of::<$code>());
                    const BYTES: Option<&[u8]> = match &CODE {
                        Some(code) => Some(code.split_at(size_of::<$code>()).0),
                        None => None,
                    };
                    BYTES
                })*)*}
            }

            /// The code of two parameters as a little-endian integer: [`TwoParameters::from_parameters`] at run time.
            /// `None` if codes of this format are not two snorm or two unorm parameters.
            pub fn from_parameters(self, parameters: [i32; 2]) -> Option<u32> {
                match self {$($(
                    #[cfg(feature = $feature)]
                    Format::$name => Kind::of(stringify!($pair)).map(|kind| kind.pack($bits, parameters)),
                )*)*}
            }

            /// The parameters of a code given as a little-endian integer: [`TwoParameters::parameters`] at run
            /// time. `None` if codes of this format are not two snorm or two unorm parameters.
            pub fn parameters(self, code: u32) -> Option<[i32; 2]> {
                match self {$($(
                    #[cfg(feature = $feature)]
                    Format::$name => Kind::of(stringify!($pair)).map(|kind| kind.unpack($bits, code)),
                )*)*}
            }

            /// Calls `v` with the type of this codec.
            ///
            /// What `v` does is compiled for each of the codecs. [`encode`](Format::encode) and the like are
            /// compiled once, in this crate.
            #[inline]
            pub fn visit<V: Visitor>(self, v: V) -> V::Output {
                match self {$($(#[cfg(feature = $feature)] Format::$name => v.visit::<$name>(),)*)*}
            }

            /// What it has of a vector of doubles.
            #[inline]
            pub(crate) const fn keeps(self) -> Keeps {
                match self {$($(
                    #[cfg(feature = $feature)]
                    Format::$name => match (
                        <$formula $(<$($kind),+>)? as Formula>::KEEPS_LENGTH,
                        <$formula $(<$($kind),+>)? as Formula>::HEMISPHERE,
                    ) {
                        (true, _) => Keeps::Floats,
                        (_, true) => Keeps::UpperDirection,
                        _ => Keeps::Direction,
                    },
                )*)*}
            }

            pub(super) fn encode_columns(self, v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
                match self {
                    $($(#[cfg(feature = $feature)] Format::$name => $name::encode_columns(v, codes),)*)*
                }
            }

            pub(super) fn encode_columns_precise(self, v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
                match self {
                    $($(#[cfg(feature = $feature)] Format::$name => $name::encode_columns_precise(v, codes),)*)*
                }
            }

            pub(super) fn decode_columns(self, codes: CodeSlice<'_>, v: [&mut [f32]; 3], fence: &Fence) {
                match self {
                    $($(#[cfg(feature = $feature)] Format::$name => $name::decode_columns(codes, v, fence),)*)*
                }
            }
        }
    };
}

/// The text for a list of axes.
macro_rules! axes_text {
    ("") => {
        "none"
    };
    ($axes:tt) => {
        $axes
    };
}

/// Whether a family is stable.
macro_rules! is_stable {
    (stable) => {
        true
    };
    (unstable) => {
        false
    };
}

/// What a page says of encoding again.
macro_rules! stable_text {
    (stable) => {
        "Codes that an encoder gave stay when they are decoded and encoded again."
    };
    (unstable) => {
        "Codes that an encoder gave stay when they are decoded and encoded again with `encode_precise`, but can change with `encode`."
    };
}

/// What qualifies an exact mirror image of a codec with these flags.
macro_rules! finer_text {
    (finer $($rest:ident)*) => {
        ", up to `f32` rounding"
    };
    ($flag:ident $($rest:ident)*) => {
        finer_text!($($rest)*)
    };
    () => {
        ""
    };
}

codec_table!(define_codecs);
