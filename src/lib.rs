#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(feature = "std", deny(unsafe_code))]
#![cfg_attr(not(feature = "std"), forbid(unsafe_code))]
// Each family of codecs uses another part of what they share.
#![cfg_attr(
    not(all(feature = "all", feature = "std")),
    allow(dead_code, unused_imports, unused_macros, unused_variables)
)]

#[cfg(test)]
extern crate std;

mod batch;
mod codec;
pub mod decode_table;
pub mod dither;
mod error;
mod formula;
#[cfg(feature = "frame")]
pub mod frame;
pub mod low_dimensions;
pub mod packing;
#[cfg(feature = "xyz")]
pub mod padded;
#[cfg(feature = "quaternion")]
pub mod quaternion;
pub mod scalar;
mod simd;
#[cfg(feature = "xyz")]
mod snorm_format;
#[cfg(feature = "fibonacci")]
mod spherical_fibonacci;
mod vector;

pub use batch::code_int::CodeInt;
pub use codec::*;
pub use error::{LengthMismatch, StrideMismatch};
#[cfg(feature = "xyz")]
pub use snorm_format::SnormFormat;
#[cfg(feature = "fibonacci")]
pub use spherical_fibonacci::SphericalFibonacci;
pub use vector::{Soa, SoaMut, Strided, StridedMut};
