//! All tests in one program: every codec is compiled once, not once for each file.

mod common;

mod agree;
mod axes;
mod code_operations;
mod decode_table;
mod dither;
mod error_report;
mod exhaustive;
mod fibonacci;
mod frame;
mod golden;
mod large;
mod low_dimensions;
mod max_error;
mod packing;
mod quaternion;
mod readme;
mod reference;
mod scalar;
mod schinko;
mod survey;
