//! Programs for a bare Cortex-M whose size `.ci/size` measures. They are built, not run: each passes what it takes
//! and gives through `black_box`, so that nothing of it is computed by the compiler.
//!
//! On a computer they can be linted, which is why `std` is left out on bare metal only.
#![cfg_attr(target_os = "none", no_std)]

use core::hint::black_box;

use unitpack::{Codec, Soa, SoaMut};

/// The functions of one vector.
#[inline(always)]
pub fn singles<C: Codec>() {
    black_box(C::encode(black_box([0.0, 0.6, 0.8])));
    black_box(C::encode_precise(black_box([0.0, 0.6, 0.8])));
    black_box(C::decode(black_box(bytemuck::Zeroable::zeroed())));
}

/// One batch each way, of a length that is known only when the program runs.
#[inline(always)]
pub fn batches<C: Codec>() {
    let [mut x, mut y, mut z] = [[0.5; LEN]; 3];
    let mut codes = [bytemuck::Zeroable::zeroed(); LEN];
    let codes: &mut [C::Code] = black_box(&mut codes);
    let [x, y, z] = [&mut x, &mut y, &mut z].map(|c| black_box(&mut c[..]));
    black_box(C::encode_soa(Soa { x, y, z }, codes).is_ok());
    black_box(C::decode_soa(codes, SoaMut { x, y, z }).is_ok());
}

const LEN: usize = 20;

#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
