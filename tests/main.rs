//! All tests in one program: every codec is compiled once, not once for each file.

mod common;

mod agree;
mod axes;
mod exhaustive;
mod golden;
mod max_error;
mod packing;
mod reference;
mod scalar;
mod survey;
