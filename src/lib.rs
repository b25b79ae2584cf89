#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(feature = "std", deny(unsafe_code))]
#![cfg_attr(not(feature = "std"), forbid(unsafe_code))]

#[cfg(test)]
extern crate std;

mod batch;
mod code_int;
mod codec;
pub mod decode_table;
mod dispatch;
pub mod dither;
mod error;
mod error_report;
mod format;
mod formula;
pub mod frame;
mod half;
mod lane;
mod lane8;
#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
mod lane_x86;
mod layout;
pub mod low_dimensions;
mod math;
pub mod packing;
pub mod quaternion;
pub mod scalar;
#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
mod stores_x86;
mod streaming;
#[cfg(all(feature = "std", any(target_arch = "x86", target_arch = "x86_64")))]
mod x86;

pub use batch::{Soa, SoaMut, transcode};
pub use code_int::CodeInt;
pub use codec::*;
pub use error::LengthMismatch;
pub use error_report::ErrorReport;
pub use format::{UnknownFormat, Visitor};
