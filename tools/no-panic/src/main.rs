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
use unitpack::packing::*;
use unitpack::scalar::{BiasedUnorm, Fixed, Scalar, Snorm, Unorm};

use unitpack::decode_table::{DecodeTable, FormatTable, OctantTable, SignSymmetric};
use unitpack::low_dimensions::{Angle, Sign};
use unitpack::*;

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

fn scalar<S: Scalar, C: CodeInt>() {
    black_box(S::encode(black_box(0.5)));
    black_box(S::decode(black_box(1)));
    let (mut values, mut codes) = ([0.5; LEN], [C::zeroed(); LEN]);
    black_box(S::encode_slice(opaque(&mut values), opaque(&mut codes)).is_ok());
    black_box(S::decode_slice(opaque(&mut codes), opaque(&mut values)).is_ok());
}

fn scalars<const NARROW: u32, const WIDE: u32>() {
    scalar::<Unorm<NARROW>, u8>();
    scalar::<Snorm<NARROW>, u8>();
    scalar::<BiasedUnorm<NARROW>, u16>();
    scalar::<Fixed<NARROW>, u16>();
    scalar::<Unorm<WIDE>, u32>();
    scalar::<Snorm<WIDE>, u32>();
    scalar::<BiasedUnorm<WIDE>, u32>();
    scalar::<Fixed<WIDE>, u32>();
}

fn packing() {
    let (mut pairs, mut texels) = ([[0.5; 2]; LEN], [[0; 3]; LEN]);
    let (mut codes, mut tags, mut words) = ([0; LEN], [0; LEN], [0; LEN]);
    let mut fields = [[0; 3]; LEN];
    let (pairs, texels) = (opaque(&mut pairs), opaque(&mut texels));
    let (codes, tags, words) = (opaque(&mut codes), opaque(&mut tags), opaque(&mut words));
    let fields = opaque(&mut fields);
    black_box(unpack_snorm12x2(black_box(pack_snorm12x2(black_box([0.5; 2])))));
    black_box(pack_snorm12x2_slice(pairs, texels).is_ok());
    black_box(unpack_snorm12x2_slice(texels, pairs).is_ok());
    black_box(unpack_tag(black_box(pack_tag(black_box(7), black_box(1)))));
    black_box(pack_tag_slice(codes, tags, words).is_ok());
    black_box(unpack_tag_slice(words, codes, tags).is_ok());
    black_box(unpack_10_10_10_2(black_box(pack_10_10_10_2(black_box([7; 3]), black_box(1)))));
    black_box(pack_10_10_10_2_slice(fields, tags, words).is_ok());
    black_box(unpack_10_10_10_2_slice(words, fields, tags).is_ok());
    black_box(unpack_11_11_10(black_box(pack_11_11_10(black_box([7; 3])))));
    black_box(pack_11_11_10_slice(fields, words).is_ok());
    black_box(unpack_11_11_10_slice(words, fields).is_ok());
    black_box(dense_len(black_box(12), black_box(LEN)));
}

fn dense<const BITS: u32, C: CodeInt>() {
    let (mut codes, mut bytes) = ([C::zeroed(); LEN], [0; 4 * LEN]);
    let (codes, bytes) = (opaque(&mut codes), opaque(&mut bytes));
    black_box(pack_dense::<BITS, C>(codes, bytes).is_ok());
    black_box(unpack_dense::<BITS, C>(bytes, codes).is_ok());
}

fn table_of_format(format: Format) {
    let mut vectors = [[0.5; 3]; 1 << 16];
    let len = FormatTable::len_for(format).unwrap_or(0);
    if let Some(vectors) = opaque(&mut vectors).get_mut(..len)
        && let Ok(table) = FormatTable::fill(format, vectors)
    {
        let table = black_box(table);
        black_box((table.format(), table.decode(black_box(5))));
        let mut buffers = Buffers::new();
        black_box(table.decode_bytes(opaque(&mut [0; 12 * LEN]), buffers.write()).is_ok());
    }
}

fn table_of_codec<C: Codec, const ENTRIES: usize>() {
    if let Ok(table) = DecodeTable::<C>::fill(opaque(&mut [[0.5; 3]; ENTRIES])) {
        let table = black_box(table);
        black_box(table.decode(black_box(C::Code::zeroed())));
        let mut buffers = Buffers::new();
        let mut codes = [C::Code::zeroed(); LEN];
        let codes = opaque(&mut codes);
        black_box(table.decode_soa(codes, buffers.write()).is_ok());
        black_box(table.decode_aos(codes, opaque(&mut [[0.5; 4]; LEN])).is_ok());
    }
}

fn table_of_octant<C: SignSymmetric>() {
    let mut vectors = [[0.5; 3]; 1 << 14];
    if let Some(vectors) = opaque(&mut vectors).get_mut(..OctantTable::<C>::LEN)
        && let Ok(table) = OctantTable::<C>::fill(vectors)
    {
        let table = black_box(table);
        black_box(table.decode(black_box(C::Code::zeroed())));
        let mut buffers = Buffers::new();
        let mut codes = [C::Code::zeroed(); LEN];
        let codes = opaque(&mut codes);
        black_box(table.decode_soa(codes, buffers.write()).is_ok());
        black_box(table.decode_aos(codes, opaque(&mut [[0.5; 4]; LEN])).is_ok());
    }
}

fn decode_tables() {
    table_of_codec::<Oct8, 256>();
    table_of_codec::<Oct16, 65_536>();
    // One of each formula.
    table_of_octant::<Oct8>();
    table_of_octant::<Oct16>();
    table_of_octant::<Octant16>();
    table_of_octant::<Snorm5x3>();
    table_of_octant::<HemiOct16>();
    table_of_octant::<XyOnly16>();
    table_of_octant::<EqDistEllipse16>();
    table_of_octant::<WarpedCube16>();
    table_of_octant::<AngularCube8>();
    table_of_octant::<AngularCube16>();
}

fn angles<const BITS: u32, T: CodeInt + Default>() {
    black_box(Angle::<BITS>::encode(black_box([0.6, 0.8])));
    black_box(Angle::<BITS>::decode(black_box(0)));
    let mut buffers = Buffers::new();
    let mut codes = [T::default(); LEN];
    let codes = opaque(&mut codes);
    let SoaMut { x, y, .. } = buffers.write();
    black_box(Angle::<BITS>::encode_soa(x, y, codes).is_ok());
    black_box(Angle::<BITS>::decode_soa(codes, x, y).is_ok());
}

fn low_dimensions() {
    angles::<1, u8>();
    angles::<8, u16>();
    angles::<24, u32>();
    black_box(Sign::decode(Sign::encode(black_box(0.5))));
    let (mut x, mut bytes) = ([0.5; LEN], [0; LEN / 8 + 1]);
    let (x, bytes) = (opaque(&mut x), opaque(&mut bytes));
    black_box(Sign::encode_slice(x, bytes).is_ok());
    black_box(Sign::decode_slice(bytes, x).is_ok());
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
        table_of_format(*format);
    }
    scalars::<2, 22>();
    scalars::<8, 24>();
    packing();
    dense::<1, u8>();
    dense::<12, u16>();
    dense::<22, u32>();
    dense::<32, u32>();
    decode_tables();
    low_dimensions();
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
