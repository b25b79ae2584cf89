//! Prints a digest of what each codec, and each of the building blocks beside them, makes of the same inputs.
//! Every computer, instruction set, virtual machine and microcontroller prints the same lines, those
//! of [machines] in `tests/digests.txt`: one result everywhere. `run` compares them.
//!
//! Without `std`, so that the same program runs on bare metal and builds in seconds for any target.
#![no_std]
#![no_main]

// On x86 alone the library needs it.
#[cfg(feature = "std")]
extern crate std;

mod building_blocks;
mod codecs;
mod digest;
mod inputs;
mod platform;

/// Four blocks of sixteen lanes or eight of eight, and seven lanes alone. The crate takes at most 64 on the way to bytes.
const LEN: usize = 71;

fn report() {
    codecs::report();
    building_blocks::report();
}
