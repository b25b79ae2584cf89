//! All tests in one program: every codec is compiled once, not once for each file.
//!
//! What is generic over codecs is compiled for each of them, so checks are not. They reach
//!
//! - every format through the slices of `Format` and, one vector or code at a time, through the
//!   function pointers of `unitpack_test::AnyCodec`;
//! - what only a codec's type has, slices above all, for one format of each family and width of
//!   code, through `unitpack_test::Typed` or a visitor of `unitpack_test::representatives`.

mod axes;
mod code_operations;
mod decode_table;
mod dither;
mod doubles;
mod entry_points_agree;
mod error_report;
mod exhaustive;
mod fibonacci;
mod frame;
mod frame_splits;
mod golden;
mod low_dimensions;
mod max_error;
mod or_none;
mod oracle_agrees;
mod packing;
mod padded;
mod parameters;
mod published_errors;
mod quaternion;
mod quaternion_formats;
mod readme;
mod real_users;
mod scalar;
mod schinko;
mod snorm_format;
mod streaming_stores;
mod strided;
