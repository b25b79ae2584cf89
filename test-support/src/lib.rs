//! What the tests, fuzz targets, proofs, benchmarks and examples of `unitpack` share.
//!
//! - [`oracle`]: every format once more, in `f64` and as plainly as can be.
//! - [`every_code`]: what must hold for every code of a format.
//! - [`AnyCodec`]: a codec's functions of one vector behind pointers, for every format. A check
//!   over them is compiled once, not once for each of the codecs.
//! - [`Typed`]: the functions of slices that only a codec's type has, for one format of each family
//!   and width of code.
//! - [`codes`]: codes as integers, and the slices of [`Format`](unitpack::Format).
//! - [`digests`]: the pinned digests.
//! - [`tables`]: decode tables, likewise.
//! - [`readme`]: the README's table of codecs.
//! - [`random`], [`vectors`], [`Arrays`], [`frames`], [`quaternions`], [`published`] and [`tasks`]: what their names
//!   say.
//!
//! Whatever runs a codec is generic or `#[inline]`. So this crate itself contains no codec, and a
//! program that needs few of them, such as those for mutation testing, is quick to build.

mod any_codec;
mod arrays;
pub mod codes;
pub mod digests;
pub mod elements;
pub mod every_code;
pub mod frames;
pub mod oracle;
pub mod published;
pub mod quaternions;
pub mod random;
pub mod readme;
pub mod tables;
pub mod tasks;
mod typed;
pub mod vectors;

pub use any_codec::{AnyCodec, Effort, Operation};
pub use arrays::{Arrays, UNWRITTEN};
pub use codes::Code;
pub use elements::Elements;
pub use typed::{Aos, Place, Transcode, Typed, representatives, transcodes};

/// A vector as the crate takes and gives it.
pub type Vector = [f32; 3];
/// What functions over slices return.
pub type Outcome = Result<(), unitpack::LengthMismatch>;
