#![doc = include_str!("../README.md")]
#![no_std]
#![forbid(unsafe_code)]

#[cfg(test)]
extern crate std;

mod batch;
mod code_int;
mod codec;
pub mod decode_table;
mod error;
mod format;
mod formula;
mod half;
mod lane;
mod lane8;
mod layout;
pub mod low_dimensions;
mod math;
pub mod packing;
pub mod scalar;

pub use batch::{Soa, SoaMut, transcode};
pub use code_int::CodeInt;
pub use codec::*;
pub use error::LengthMismatch;
pub use format::{UnknownFormat, Visitor};
