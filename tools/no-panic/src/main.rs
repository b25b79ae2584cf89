//! A proof by linking that no function of `unitpack` can panic.
//!
//! The panic handler calls a function that does not exist. If any panic path survives the optimiser, the
//! handler is kept and linking fails: `undefined symbol: a_panic_path_survives`. Every slice passes through
//! `black_box`, so that nothing is known of its address, its contents or its length, not even that it is as
//! long as another.
//!
//! The feature `control` adds one panic path. It must not link, or the proof proves nothing.
#![no_std]
#![no_main]

use core::hint::black_box;
use core::panic::PanicInfo;

use bytemuck::Zeroable;
use unitpack::{Codec, Float32x3, Format, Oct16, Soa, SoaMut, Visitor, transcode};

const LEN: usize = 67;

/// All entry points of one codec.
struct Everything;

impl Visitor for Everything {
    type Output = ();

    fn visit<C: Codec>(self) {
        black_box(C::encode(black_box([0.0, 0.6, 0.8])));
        black_box(C::encode_precise(black_box([0.0, 0.6, 0.8])));
        black_box(C::decode(black_box(C::Code::zeroed())));

        let mut buffers = Buffers::new();
        let mut codes = [C::Code::zeroed(); LEN];
        let codes = &mut codes[..];
        black_box(C::encode_soa(buffers.read(), black_box(codes)).is_ok());
        black_box(C::encode_soa_precise(buffers.read(), black_box(codes)).is_ok());
        black_box(C::decode_soa(black_box(codes), buffers.write()).is_ok());
        arrays_of_structures::<C, 3>(codes);
        arrays_of_structures::<C, 4>(codes);

        black_box(C::FORMAT.encode(buffers.read(), opaque(&mut [0; 12 * LEN])).is_ok());
        black_box(C::FORMAT.encode_precise(buffers.read(), opaque(&mut [0; 12 * LEN])).is_ok());
        black_box(C::FORMAT.decode(opaque(&mut [0; 12 * LEN]), buffers.write()).is_ok());

        black_box(
            transcode::<C, C>(black_box(codes), opaque(&mut [C::Code::zeroed(); LEN])).is_ok(),
        );
        black_box(transcode::<C, Oct16>(black_box(codes), opaque(&mut [0; LEN])).is_ok());
        black_box(transcode::<Float32x3, C>(opaque(&mut [[0; 3]; LEN]), black_box(codes)).is_ok());
    }
}

fn arrays_of_structures<C: Codec, const N: usize>(codes: &mut [C::Code]) {
    let mut vectors = [[0.5; N]; LEN];
    let vectors = &mut vectors[..];
    black_box(C::encode_aos(black_box(vectors), black_box(codes)).is_ok());
    black_box(C::encode_aos_precise(black_box(vectors), black_box(codes)).is_ok());
    black_box(C::decode_aos(black_box(codes), black_box(vectors)).is_ok());
}

struct Buffers([[f32; LEN]; 3]);

impl Buffers {
    fn new() -> Self {
        Buffers([[0.5; LEN]; 3])
    }

    fn read(&mut self) -> Soa<'_> {
        let [x, y, z] = &mut self.0;
        Soa { x: opaque(x), y: opaque(y), z: opaque(z) }
    }

    fn write(&mut self) -> SoaMut<'_> {
        let [x, y, z] = &mut self.0;
        SoaMut { x: opaque(x), y: opaque(y), z: opaque(z) }
    }
}

fn opaque<T>(slice: &mut [T]) -> &mut [T] {
    black_box(slice)
}

#[unsafe(no_mangle)]
extern "C" fn main() -> i32 {
    for format in black_box(Format::ALL) {
        format.visit(Everything);
        black_box((format.name(), format.bits(), format.code_size(), format.is_hemisphere()));
        black_box((format.max_error_degrees(), format.max_error_precise_degrees()));
    }
    black_box(black_box("oct16").parse::<Format>().is_ok());
    #[cfg(feature = "control")]
    black_box(black_box(Format::ALL)[black_box(0)]);
    0
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        /// Defined nowhere.
        fn a_panic_path_survives() -> !;
    }
    // SAFETY: a program with this call does not link.
    unsafe { a_panic_path_survives() }
}

/// The precompiled `core` names it; with `panic = "abort"` nothing calls it.
#[unsafe(no_mangle)]
extern "C" fn rust_eh_personality() {}

// memcpy, memset and the start of the program.
#[link(name = "c")]
unsafe extern "C" {}
