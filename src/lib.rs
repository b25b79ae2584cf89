#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(feature = "std", deny(unsafe_code))]
#![cfg_attr(not(feature = "std"), forbid(unsafe_code))]

#[cfg(test)]
extern crate std;

mod batch;
mod codec;
pub mod decode_table;
pub mod dither;
mod error;
mod formula;
pub mod frame;
pub mod low_dimensions;
pub mod packing;
pub mod quaternion;
pub mod scalar;
mod simd;

pub use batch::code_int::CodeInt;
pub use batch::{Soa, SoaMut, transcode};
pub use codec::*;
pub use error::LengthMismatch;
