//! A proof by linking that no function of `unitpack` can panic.
//!
//! The panic handler calls a function that does not exist. If any panic path survives the optimiser, the
//! handler is kept and linking fails: `undefined symbol: a_panic_path_survives`. Every slice passes through
//! `black_box`, so that nothing is known of its address, its contents or its length, not even that it is as
//! long as another.
//!
//! Functions are named with their type or trait, as `.ci/no-panic` requires every public one to stand here.
//!
//! Left out, since `core` itself can panic there: `Debug` of what holds `f32` ([`Soa`], [`Soa4`] and
//! theirs to write, and the decode tables), for `core` asserts in its digits of floats; and a width above 65535 that a caller puts
//! into a format string at run time.
//!
//! The feature `control` adds one panic path. It must not link, or the proof proves nothing. With the feature `std`
//! nothing is proved by linking; `.ci/no-panic` reads the objects instead.
#![no_std]
#![no_main]

use core::fmt::{self, Debug, Display, Write};
use core::hash::{Hash, Hasher};
use core::hint::black_box;
use core::str::FromStr;

use bytemuck::Zeroable;
use unitpack::decode_table::{DecodeTable, FormatTable, OctantTable, SignSymmetric};
use unitpack::dither::{Dither, StochasticRounding};
use unitpack::frame::{
    Frame, FrameCodec, FrameSoa, FrameSoaMut, OctAngle32, OctAngle64, OctAngleFormat, QTangent64,
    basis,
};
use unitpack::low_dimensions::{Angle, Sign};
use unitpack::packing::*;
use unitpack::padded::{Padded, PaddedCodec, W};
use unitpack::quaternion::*;
use unitpack::scalar::{BiasedUnorm, Fixed, Scalar, Snorm, Unorm};
use unitpack::*;

const LEN: usize = 67;

/// All entry points of one codec.
struct Everything;

impl Visitor for Everything {
    type Output = ();

    fn visit<C: Codec>(self) {
        black_box(<C as Codec>::encode(black_box([0.0, 0.6, 0.8])));
        black_box(<C as Codec>::encode_precise(black_box([0.0, 0.6, 0.8])));
        black_box(<C as Codec>::decode(black_box(C::Code::zeroed())));
        black_box(<C as Codec>::canonical(black_box(C::Code::zeroed())));
        black_box(<C as Codec>::is_canonical(black_box(C::Code::zeroed())));
        black_box(<C as Codec>::negate(black_box(C::Code::zeroed())));
        black_box(<C as Codec>::mirror(black_box(C::Code::zeroed()), black_box(Axis::X)));
        black_box(<C as Codec>::same_direction(
            black_box(C::Code::zeroed()),
            black_box(C::Code::zeroed()),
        ));

        let mut buffers = Buffers::new();
        let mut codes = [C::Code::zeroed(); LEN];
        let codes = &mut codes[..];
        black_box(<C as Codec>::encode_soa(buffers.read(), black_box(codes)).is_ok());
        black_box(<C as Codec>::encode_soa_precise(buffers.read(), black_box(codes)).is_ok());
        black_box(<C as Codec>::decode_soa(black_box(codes), buffers.write()).is_ok());
        arrays_of_structures::<C, 3>(codes);
        arrays_of_structures::<C, 4>(codes);
        black_box(ErrorReport::of::<C>(buffers.read(), black_box(codes)).is_ok());
        <C as Codec>::canonical_slice(black_box(codes));
        <C as Codec>::negate_slice(black_box(codes));
        <C as Codec>::mirror_slice(black_box(codes), black_box(Axis::Y));

        let bytes = &mut [0; 12 * LEN];
        black_box(Format::encode(C::FORMAT, buffers.read(), opaque(bytes)).is_ok());
        black_box(Format::encode_precise(C::FORMAT, buffers.read(), opaque(bytes)).is_ok());
        black_box(Format::decode(C::FORMAT, opaque(bytes), buffers.write()).is_ok());

        let vectors = &mut [[0.5; 3]; LEN];
        let vectors = opaque(vectors);
        black_box(Format::encode_aos(C::FORMAT, vectors, bytes).is_ok());
        black_box(Format::encode_aos_precise(C::FORMAT, vectors, bytes).is_ok());
        black_box(Format::decode_aos(C::FORMAT, bytes, vectors).is_ok());
        let (a, b) = (&mut [0; 24 * LEN], &mut [0; 24 * LEN]);
        black_box(<C as Codec>::encode_strided(strided(a), strided_mut(b)).is_ok());
        black_box(<C as Codec>::encode_strided_precise(strided(a), strided_mut(b)).is_ok());
        black_box(<C as Codec>::decode_strided(strided(a), strided_mut(b)).is_ok());
        black_box(<C as Codec>::encode_within(strided_mut(a), black_box(3)).is_ok());
        black_box(<C as Codec>::encode_within_precise(strided_mut(a), black_box(3)).is_ok());
        black_box(<C as Codec>::decode_within(strided_mut(a), black_box(3)).is_ok());
        black_box(Format::encode_strided(C::FORMAT, strided(a), strided_mut(b)).is_ok());
        black_box(Format::encode_strided_precise(C::FORMAT, strided(a), strided_mut(b)).is_ok());
        black_box(Format::decode_strided(C::FORMAT, strided(a), strided_mut(b)).is_ok());
        black_box(Format::encode_within(C::FORMAT, strided_mut(a), black_box(3)).is_ok());
        black_box(Format::encode_within_precise(C::FORMAT, strided_mut(a), black_box(3)).is_ok());
        black_box(Format::decode_within(C::FORMAT, strided_mut(a), black_box(3)).is_ok());
        black_box(<C as Codec>::encode_f64(black_box([0.0, 0.6, 0.8])));
        black_box(<C as Codec>::encode_precise_f64(black_box([0.0, 0.6, 0.8])));
        let doubles = &mut [[0.5; 3]; LEN];
        let doubles = opaque(doubles);
        black_box(<C as Codec>::encode_aos_f64(doubles, black_box(codes)).is_ok());
        black_box(<C as Codec>::encode_aos_f64_precise(doubles, black_box(codes)).is_ok());
        black_box(<C as Codec>::encode_strided_f64(strided(a), strided_mut(b)).is_ok());
        black_box(<C as Codec>::encode_strided_f64_precise(strided(a), strided_mut(b)).is_ok());
        black_box(Format::encode_aos_f64(C::FORMAT, doubles, bytes).is_ok());
        black_box(Format::encode_aos_f64_precise(C::FORMAT, doubles, bytes).is_ok());
        black_box(Format::encode_strided_f64(C::FORMAT, strided(a), strided_mut(b)).is_ok());
        let written = Format::encode_strided_f64_precise(C::FORMAT, strided(a), strided_mut(b));
        black_box(written.is_ok());
        let order = black_box(AxisOrder::Zxy);
        let (v, code) = (strided(a), black_box(3));
        black_box(AxisOrder::encode_strided(order, C::FORMAT, v, strided_mut(b)).is_ok());
        black_box(
            AxisOrder::encode_strided_precise(order, C::FORMAT, strided(a), strided_mut(b)).is_ok(),
        );
        black_box(AxisOrder::decode_strided(order, C::FORMAT, strided(a), strided_mut(b)).is_ok());
        black_box(AxisOrder::encode_within(order, C::FORMAT, strided_mut(a), code).is_ok());
        black_box(AxisOrder::encode_within_precise(order, C::FORMAT, strided_mut(a), code).is_ok());
        black_box(AxisOrder::decode_within(order, C::FORMAT, strided_mut(a), code).is_ok());
        all_of(<C as Codec>::encode_iter(opaque(&mut [[0.5; 3]; LEN]).iter().copied()));
        all_of(<C as Codec>::encode_iter_precise(opaque(&mut [[0.5; 3]; LEN]).iter().copied()));
        all_of(<C as Codec>::decode_iter(black_box(&*codes).iter().copied()));

        black_box(
            transcode::<C, C>(black_box(codes), opaque(&mut [C::Code::zeroed(); LEN])).is_ok(),
        );
        black_box(transcode::<C, Oct16>(black_box(codes), opaque(&mut [0; LEN])).is_ok());
        black_box(transcode::<Float32x3, C>(opaque(&mut [[0; 3]; LEN]), black_box(codes)).is_ok());
    }
}

/// An order of axes, with a codec by its type.
fn axis_order() {
    let order = black_box(AxisOrder::Zxy);
    black_box((AxisOrder::apply(order, black_box([0.5; 3])), AxisOrder::undo(order, [0.5; 3])));
    derived::<AxisOrder>(order);
    order.hash(&mut Sink);
    let (a, b) = (&mut [0; 24 * LEN], &mut [0; 24 * LEN]);
    black_box(order.encode_strided(Oct24, strided(a), strided_mut(b)).is_ok());
    black_box(order.encode_strided_precise(Oct24, strided(a), strided_mut(b)).is_ok());
    black_box(order.decode_strided(Oct24, strided(a), strided_mut(b)).is_ok());
    black_box(order.encode_within(Oct24, strided_mut(a), black_box(3)).is_ok());
    black_box(order.encode_within_precise(Oct24, strided_mut(a), black_box(3)).is_ok());
    black_box(order.decode_within(Oct24, strided_mut(a), black_box(3)).is_ok());
}

/// Elements anywhere, or nowhere.
fn strided<const N: usize>(bytes: &mut [u8; N]) -> Strided<'_> {
    let [offset, stride, len] = black_box([1, 20, LEN]);
    Strided { bytes: opaque(bytes), offset, stride, len }
}

fn strided_mut<const N: usize>(bytes: &mut [u8; N]) -> StridedMut<'_> {
    let [offset, stride, len] = black_box([1, 20, LEN]);
    StridedMut { bytes: opaque(bytes), offset, stride, len }
}

/// All entry points of elements with a code of one codec.
fn padded<C: PaddedCodec>() {
    let element = black_box(C::Element::zeroed());
    let (v, tangent) = (black_box([0.0, 0.6, 0.8]), black_box([0.0, 0.6, 0.8, -1.0]));
    black_box(Padded::<C>::encode(v, black_box(W::One)));
    black_box(Padded::<C>::encode_precise(v, black_box(W::One)));
    black_box(Padded::<C>::decode(element));
    black_box(Padded::<C>::encode_tangent(tangent));
    black_box(Padded::<C>::encode_tangent_precise(tangent));
    black_box(Padded::<C>::decode_tangent(element));

    let w = black_box(W::Keep);
    let mut buffers = Buffers::new();
    let elements = &mut [C::Element::zeroed(); LEN];
    let elements = opaque(elements);
    black_box(Padded::<C>::encode_soa(buffers.read(), w, elements).is_ok());
    black_box(Padded::<C>::encode_soa_precise(buffers.read(), w, elements).is_ok());
    black_box(Padded::<C>::decode_soa(elements, buffers.write()).is_ok());
    let tangents = &mut [[0.5; 4]; LEN];
    let tangents = opaque(tangents);
    black_box(Padded::<C>::encode_tangents_aos(tangents, elements).is_ok());
    black_box(Padded::<C>::encode_tangents_aos_precise(tangents, elements).is_ok());
    black_box(Padded::<C>::decode_tangents_aos(elements, tangents).is_ok());

    let (a, b) = (&mut [0; 24 * LEN], &mut [0; 24 * LEN]);
    black_box(Padded::<C>::encode_strided(strided(a), w, strided_mut(b)).is_ok());
    black_box(Padded::<C>::encode_strided_precise(strided(a), w, strided_mut(b)).is_ok());
    black_box(Padded::<C>::decode_strided(strided(a), strided_mut(b)).is_ok());
    black_box(Padded::<C>::encode_tangents_strided(strided(a), strided_mut(b)).is_ok());
    black_box(Padded::<C>::encode_tangents_strided_precise(strided(a), strided_mut(b)).is_ok());
    black_box(Padded::<C>::decode_tangents_strided(strided(a), strided_mut(b)).is_ok());
}

fn all_padded() {
    padded::<Snorm8x3>();
    padded::<Snorm10x3>();
    padded::<Snorm12x3>();
    padded::<Snorm16x3>();
    padded::<Float16x3>();
    padded::<XyzUnorm8x3>();
    padded::<XyzUnorm10x3>();
    padded::<XyzUnorm16x3>();
    derived::<W>(black_box(W::Keep));
    W::Keep.hash(&mut Sink);
}

fn all_of<T>(elements: impl ExactSizeIterator<Item = T>) {
    black_box(elements.len());
    for element in elements {
        black_box(element);
    }
}

fn arrays_of_structures<C: Codec, const N: usize>(codes: &mut [C::Code]) {
    let mut vectors = [[0.5; N]; LEN];
    let vectors = &mut vectors[..];
    black_box(<C as Codec>::encode_aos(black_box(vectors), black_box(codes)).is_ok());
    black_box(<C as Codec>::encode_aos_precise(black_box(vectors), black_box(codes)).is_ok());
    black_box(<C as Codec>::decode_aos(black_box(codes), black_box(vectors)).is_ok());
}

/// What is known of a format, and its name read and written.
fn format(format: Format) {
    black_box((Format::name(format), Format::bits(format), Format::code_size(format)));
    black_box((Format::is_hemisphere(format), Format::max_error_degrees(format)));
    black_box(Format::max_error_precise_degrees(format));
    black_box((Format::exact_axes(format), Format::exact_axes_precise(format)));
    black_box((Format::exact_mirrors(format), Format::encode_is_stable(format)));
    black_box(Format::cheapest(black_box(0.5)));
    black_box(Format::from_name(black_box("oct16")));
    match <Format as FromStr>::from_str(black_box("oct16")) {
        Ok(format) => derived::<Format>(format),
        Err(error) => {
            display::<UnknownFormat>(error);
            derived::<UnknownFormat>(error);
        }
    }
    display::<Format>(format);
    black_box(format.cmp(black_box(&Format::Oct16)));
    format.hash(&mut Sink);
}

fn errors() {
    let [a, b, c, d] = black_box([1, 2, 3, 4]);
    let bits = black_box(12);
    for error in black_box([
        LengthMismatch::Soa { x: a, y: b, z: c, codes: d },
        LengthMismatch::Aos { vectors: a, codes: b },
        LengthMismatch::Bytes { x: a, y: b, z: c, bytes: d, code_size: a },
        LengthMismatch::AosBytes { vectors: a, bytes: b, code_size: c },
        LengthMismatch::Transcode { src: a, dst: b },
        LengthMismatch::Values { values: a, codes: b },
        LengthMismatch::Tagged { codes: a, tags: b, words: c },
        LengthMismatch::Dense { codes: a, bytes: b, bits },
        LengthMismatch::Table { vectors: a, entries: Some(b) },
        LengthMismatch::Table { vectors: a, entries: None },
        LengthMismatch::Angles { x: a, y: b, codes: c },
        LengthMismatch::Quaternions { x: a, y: b, z: c, w: d, codes: a },
        LengthMismatch::QuaternionBytes { components: [a, b, c, d], bytes: a, code_size: b },
        LengthMismatch::FrameSoa { normal: [a, b, c], tangent: [a, b, c], handedness: d, codes: a },
        LengthMismatch::FrameBytes {
            normal: [a, b, c],
            tangent: [a, b, c],
            handedness: d,
            bytes: a,
            code_size: b,
        },
        LengthMismatch::FrameAos { normals: a, tangents: b, codes: c },
    ]) {
        display::<LengthMismatch>(error);
        derived::<LengthMismatch>(error);
    }
    for error in black_box([
        StrideMismatch::Bounds { offset: a, stride: b, len: c, size: d, bytes: a },
        StrideMismatch::Stride { offset: a, stride: b, len: a, size: b, bytes: a },
        StrideMismatch::Lengths { vectors: a, codes: b },
        StrideMismatch::Frames { normals: a, tangents: b, codes: c },
        StrideMismatch::Fields {
            first: a,
            first_size: b,
            second: c,
            second_size: d,
            stride: a,
            len: b,
            bytes: c,
        },
    ]) {
        display::<StrideMismatch>(error);
        derived::<StrideMismatch>(error);
    }
    let mut structures = [[1u32; 3]; LEN];
    let structures = opaque(&mut structures);
    black_box(Strided::of::<[u32; 3]>(structures, black_box(4)));
    black_box(StridedMut::of::<[u32; 3]>(structures, black_box(4)));
}

fn display<T: Display>(value: T) {
    black_box(write!(Sink, "{value} {value:*^30.5}").is_ok());
}

/// What the standard derives write for `T`.
fn derived<T: Debug + PartialEq + Copy + 'static>(value: T) {
    black_box(write!(Sink, "{value:?} {value:#08x?}").is_ok());
    black_box(value == black_box(value));
}

/// Takes what is written to it, and what is hashed.
struct Sink;

impl Write for Sink {
    fn write_str(&mut self, s: &str) -> fmt::Result {
        black_box(s);
        black_box(Ok(()))
    }
}

impl Hasher for Sink {
    fn finish(&self) -> u64 {
        black_box(0)
    }
    fn write(&mut self, bytes: &[u8]) {
        black_box(bytes);
    }
}

/// Calls a function for each width in the list, as its first argument.
macro_rules! widths {
    ($function:ident::<$code:ty>: $($bits:literal)*) => {
        $($function::<$bits, $code>();)*
    };
}

fn scalar<S: Scalar, C: CodeInt>() {
    black_box(<S as Scalar>::encode(black_box(0.5)));
    black_box(<S as Scalar>::decode(black_box(1)));
    let (mut values, mut codes) = ([0.5; LEN], [C::zeroed(); LEN]);
    let (values, codes) = (opaque(&mut values), opaque(&mut codes));
    black_box(<S as Scalar>::encode_slice(black_box(values), black_box(codes)).is_ok());
    black_box(<S as Scalar>::decode_slice(black_box(codes), black_box(values)).is_ok());
}

fn scalars<const BITS: u32, C: CodeInt>() {
    scalar::<Unorm<BITS>, C>();
    scalar::<Snorm<BITS>, C>();
    scalar::<BiasedUnorm<BITS>, C>();
    scalar::<Fixed<BITS>, C>();
}

fn all_scalars() {
    widths!(scalars::<u8>: 2 3 4 5 6 7 8);
    widths!(scalars::<u16>: 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
    widths!(scalars::<u32>: 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24);
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

fn all_dense() {
    widths!(dense::<u8>: 1 2 3 4 5 6 7 8);
    widths!(dense::<u16>: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
    widths!(dense::<u32>: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
    widths!(dense::<u32>: 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32);
}

fn table_of_format(format: Format, vectors: &mut [[f32; 3]]) {
    let len = FormatTable::len_for(format).unwrap_or(0);
    if let Some(vectors) = vectors.get_mut(..len)
        && let Ok(table) = FormatTable::fill(format, opaque(vectors))
    {
        let table = black_box(table);
        black_box((FormatTable::format(&table), FormatTable::decode(&table, black_box(5))));
        let mut buffers = Buffers::new();
        let bytes = &mut [0; 12 * LEN];
        black_box(FormatTable::decode_bytes(&table, opaque(bytes), buffers.write()).is_ok());
    }
}

fn table_of_codec<C: Codec>(vectors: &mut [[f32; 3]]) {
    if let Some(vectors) = vectors.get_mut(..DecodeTable::<C>::LEN)
        && let Ok(table) = DecodeTable::<C>::fill(opaque(vectors))
    {
        let table = black_box(table);
        black_box(DecodeTable::<C>::decode(&table, black_box(C::Code::zeroed())));
        let mut buffers = Buffers::new();
        let mut codes = [C::Code::zeroed(); LEN];
        let codes = opaque(&mut codes);
        black_box(DecodeTable::<C>::decode_soa(&table, codes, buffers.write()).is_ok());
        black_box(
            DecodeTable::<C>::decode_aos(&table, codes, opaque(&mut [[0.5; 4]; LEN])).is_ok(),
        );
    }
}

fn table_of_octant<C: SignSymmetric>(vectors: &mut [[f32; 3]]) {
    if let Some(vectors) = vectors.get_mut(..OctantTable::<C>::LEN)
        && let Ok(table) = OctantTable::<C>::fill(opaque(vectors))
    {
        let table = black_box(table);
        black_box(OctantTable::<C>::decode(&table, black_box(C::Code::zeroed())));
        let mut buffers = Buffers::new();
        let mut codes = [C::Code::zeroed(); LEN];
        let codes = opaque(&mut codes);
        black_box(OctantTable::<C>::decode_soa(&table, codes, buffers.write()).is_ok());
        black_box(
            OctantTable::<C>::decode_aos(&table, codes, opaque(&mut [[0.5; 4]; LEN])).is_ok(),
        );
    }
}

/// Calls [`table_of_codec`], for codecs of at most 16 bits: others have no table.
struct TableOfCodec<'a>(&'a mut [[f32; 3]]);

impl Visitor for TableOfCodec<'_> {
    type Output = ();

    fn visit<C: Codec>(self) {
        let table = const {
            let has_one = C::FORMAT.bits() <= 16;
            if has_one { Some(table_of_codec::<C> as fn(&mut [[f32; 3]])) } else { None }
        };
        if let Some(table) = table {
            table(self.0);
        }
    }
}

fn decode_tables() {
    let vectors = &mut [[0.5; 3]; 1 << 16];
    for &format in black_box(Format::ALL) {
        table_of_format(format, opaque(vectors));
        Format::visit(format, TableOfCodec(opaque(vectors)));
    }
    macro_rules! octant {
        ($codec:ident) => {
            table_of_octant::<$codec>(opaque(vectors))
        };
    }
    for_each_codec!(octant: octant);
}

fn angles<const BITS: u32, T: CodeInt>() {
    black_box(Angle::<BITS>::encode(black_box([0.6, 0.8])));
    black_box(Angle::<BITS>::decode(black_box(0)));
    let mut buffers = Buffers::new();
    let mut codes = [T::zeroed(); LEN];
    let codes = opaque(&mut codes);
    let SoaMut { x, y, .. } = buffers.write();
    black_box(Angle::<BITS>::encode_soa(x, y, codes).is_ok());
    black_box(Angle::<BITS>::decode_soa(codes, x, y).is_ok());
}

fn low_dimensions() {
    widths!(angles::<u8>: 1 2 3 4 5 6 7 8);
    widths!(angles::<u16>: 9 10 11 12 13 14 15 16);
    widths!(angles::<u32>: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24);
    black_box(Sign::decode(Sign::encode(black_box(0.5))));
    let (mut x, mut bytes) = ([0.5; LEN], [0; LEN / 8 + 1]);
    let (x, bytes) = (opaque(&mut x), opaque(&mut bytes));
    black_box(Sign::encode_slice(x, bytes).is_ok());
    black_box(Sign::decode_slice(bytes, x).is_ok());
}

fn dithered<C: Codec>() {
    let dither = Dither::new(black_box(1));
    let index = black_box(7);
    let v = black_box([0.0, 0.6, 0.8]);
    let code = Dither::encode::<C>(dither, index, v);
    black_box(Dither::decode::<C>(dither, index, code));
    black_box(Dither::encode_precise::<C>(dither, index, v));
    let (mut buffers, mut codes) = (Buffers::new(), [C::Code::zeroed(); LEN]);
    let codes = opaque(&mut codes);
    black_box(Dither::encode_soa::<C>(dither, index, buffers.read(), codes).is_ok());
    black_box(Dither::encode_soa_precise::<C>(dither, index, buffers.read(), codes).is_ok());
    black_box(Dither::decode_soa::<C>(dither, index, codes, buffers.write()).is_ok());
}

fn stochastic<C: StochasticRounding>() {
    let dither = Dither::new(black_box(1));
    black_box(Dither::encode_stochastic::<C>(dither, black_box(7), black_box([0.0, 0.6, 0.8])));
    let (mut buffers, mut codes) = (Buffers::new(), [C::Code::zeroed(); LEN]);
    let codes = opaque(&mut codes);
    black_box(Dither::encode_soa_stochastic::<C>(dither, 7, buffers.read(), codes).is_ok());
}

fn all_dithered() {
    // One of each type of code, and a hemisphere's.
    dithered::<Oct8>();
    dithered::<Oct16>();
    dithered::<Oct24>();
    dithered::<Oct32>();
    dithered::<Snorm16x3>();
    dithered::<Float32x3>();
    dithered::<HemiOct16>();
    macro_rules! stochastic {
        ($codec:ident) => {
            stochastic::<$codec>()
        };
    }
    for_each_codec!(stochastic: stochastic);
}

fn fibonacci() {
    let Some(points) = SphericalFibonacci::new(black_box(1000)) else { return };
    black_box(SphericalFibonacci::points(points));
    let index = SphericalFibonacci::encode(points, black_box([0.0, 0.6, 0.8]));
    black_box(SphericalFibonacci::decode(points, index));
    let (mut buffers, mut indices) = (Buffers::new(), [0; LEN]);
    let indices = opaque(&mut indices);
    black_box(SphericalFibonacci::encode_soa(points, buffers.read(), indices).is_ok());
    black_box(SphericalFibonacci::decode_soa(points, indices, buffers.write()).is_ok());
}

fn quaternions<C: QuaternionCodec>() {
    black_box(<C as QuaternionCodec>::encode(black_box([0.0, 0.6, 0.0, 0.8])));
    black_box(<C as QuaternionCodec>::encode_precise(black_box([0.0, 0.6, 0.0, 0.8])));
    black_box(<C as QuaternionCodec>::decode(black_box(C::Code::zeroed())));
    black_box(<C as QuaternionCodec>::canonical(black_box(C::Code::zeroed())));
    black_box(<C as QuaternionCodec>::is_canonical(black_box(C::Code::zeroed())));
    black_box(<C as QuaternionCodec>::decode_near(
        black_box(C::Code::zeroed()),
        black_box([0.5; 4]),
    ));

    let mut codes = [C::Code::zeroed(); LEN];
    let codes = opaque(&mut codes);
    let [mut x, mut y, mut z, mut w] = [[0.5; LEN]; 4];
    let (x, y, z, w) = (opaque(&mut x), opaque(&mut y), opaque(&mut z), opaque(&mut w));
    let q = Soa4 { x, y, z, w };
    black_box(<C as QuaternionCodec>::encode_soa(q, codes).is_ok());
    black_box(<C as QuaternionCodec>::encode_soa_precise(q, codes).is_ok());
    black_box(<C as QuaternionCodec>::decode_soa(codes, Soa4Mut { x, y, z, w }).is_ok());
    let mut aos = [[0.5; 4]; LEN];
    let aos = opaque(&mut aos);
    black_box(<C as QuaternionCodec>::encode_aos(aos, codes).is_ok());
    black_box(<C as QuaternionCodec>::encode_aos_precise(aos, codes).is_ok());
    black_box(<C as QuaternionCodec>::decode_aos(codes, aos).is_ok());
    black_box(<C as QuaternionCodec>::decode_aos_near(codes, aos).is_ok());
    black_box(<C as QuaternionCodec>::decode_track(codes, black_box([0.5; 4]), aos).is_ok());
    let (a, b) = (&mut [0; 24 * LEN], &mut [0; 24 * LEN]);
    black_box(<C as QuaternionCodec>::encode_strided(strided(a), strided_mut(b)).is_ok());
    black_box(<C as QuaternionCodec>::encode_strided_precise(strided(a), strided_mut(b)).is_ok());
    black_box(<C as QuaternionCodec>::decode_strided(strided(a), strided_mut(b)).is_ok());
    black_box(<C as QuaternionCodec>::encode_within(strided_mut(b), black_box(3)).is_ok());
    black_box(<C as QuaternionCodec>::encode_within_precise(strided_mut(b), black_box(3)).is_ok());
    black_box(<C as QuaternionCodec>::decode_within(strided_mut(b), black_box(3)).is_ok());
}

fn all_quaternions() {
    quaternions::<SmallestThree32>();
    quaternions::<SmallestThree48>();
    quaternions::<SmallestThree64>();
    quaternions::<TanThree32>();
}

/// All entry points of a format of rotations chosen at run time.
fn quaternion_formats() {
    let three = QuaternionFormat::smallest_three(black_box(9));
    let snorm = QuaternionFormat::snorm(black_box(9));
    let Some(format) = (if black_box(true) { three } else { snorm }) else { return };
    black_box(QuaternionFormat::bits(format));
    black_box(QuaternionFormat::code_size(format));
    black_box(QuaternionFormat::max_error_degrees(format));
    black_box(QuaternionFormat::max_error_precise_degrees(format));
    black_box(QuaternionFormat::encode(format, black_box([0.5; 4])));
    black_box(QuaternionFormat::encode_precise(format, black_box([0.5; 4])));
    black_box(QuaternionFormat::decode(format, black_box(0)));
    black_box(QuaternionFormat::decode_near(format, black_box(0), black_box([0.5; 4])));
    black_box(QuaternionFormat::canonical(format, black_box(0)));
    derived::<QuaternionFormat>(format);
    let [mut x, mut y, mut z, mut w] = [[0.5; LEN]; 4];
    let (x, y, z, w) = (opaque(&mut x), opaque(&mut y), opaque(&mut z), opaque(&mut w));
    let q = Soa4 { x, y, z, w };
    let (bytes, aos) = (&mut [0; 8 * LEN], &mut [[0.5; 4]; LEN]);
    let (bytes, aos) = (opaque(bytes), opaque(aos));
    black_box(QuaternionFormat::encode_soa(format, q, bytes).is_ok());
    black_box(QuaternionFormat::encode_soa_precise(format, q, bytes).is_ok());
    black_box(QuaternionFormat::decode_soa(format, bytes, Soa4Mut { x, y, z, w }).is_ok());
    black_box(QuaternionFormat::decode_aos_near(format, bytes, aos).is_ok());
    black_box(QuaternionFormat::decode_track(format, bytes, black_box([0.5; 4]), aos).is_ok());
    let (a, b) = (&mut [0; 24 * LEN], &mut [0; 24 * LEN]);
    black_box(QuaternionFormat::encode_strided(format, strided(a), strided_mut(b)).is_ok());
    black_box(QuaternionFormat::encode_strided_precise(format, strided(a), strided_mut(b)).is_ok());
    black_box(QuaternionFormat::decode_strided(format, strided(a), strided_mut(b)).is_ok());
}

/// All entry points of snorm of a width chosen at run time.
fn snorm_formats() {
    let Some(format) = SnormFormat::new(black_box(9)) else { return };
    black_box(SnormFormat::component_bits(format));
    black_box(SnormFormat::code_size(format));
    black_box(SnormFormat::max_error_degrees(format));
    black_box(SnormFormat::max_error_precise_degrees(format));
    black_box(SnormFormat::encode(format, black_box([0.5; 3])));
    black_box(SnormFormat::encode_precise(format, black_box([0.5; 3])));
    black_box(SnormFormat::decode(format, black_box(0)));
    derived::<SnormFormat>(format);
    let (mut buffers, bytes) = (Buffers::new(), &mut [0; 8 * LEN]);
    let bytes = opaque(bytes);
    black_box(SnormFormat::encode_soa(format, buffers.read(), bytes).is_ok());
    black_box(SnormFormat::encode_soa_precise(format, buffers.read(), bytes).is_ok());
    black_box(SnormFormat::decode_soa(format, bytes, buffers.write()).is_ok());
    let (a, b) = (&mut [0; 24 * LEN], &mut [0; 24 * LEN]);
    black_box(SnormFormat::encode_strided(format, strided(a), strided_mut(b)).is_ok());
    black_box(SnormFormat::encode_strided_precise(format, strided(a), strided_mut(b)).is_ok());
    black_box(SnormFormat::decode_strided(format, strided(a), strided_mut(b)).is_ok());
}

/// A code for no vector, and codes of two parameters.
fn codes_and_parameters() {
    Everything.visit::<OrNone<Oct16>>();
    Everything.visit::<OrNone<Oct24>>();
    Everything.visit::<OrNone<Oct32>>();
    Everything.visit::<OrNone<Snorm16x3>>();
    derived::<OrNone<Oct16>>(OrNone::<Oct16>::new(Oct16));
    for &format in black_box(Format::ALL) {
        black_box(Format::none(format));
        black_box(Format::from_parameters(format, black_box([1, -1])));
        black_box(Format::parameters(format, black_box(0)));
        if let Some(format) = Format::or_none(format) {
            let (a, b) = (&mut [0; 24 * LEN], &mut [0; 24 * LEN]);
            let order = black_box(AxisOrder::Zxy);
            black_box(AxisOrder::encode_strided(order, format, strided(a), strided_mut(b)).is_ok());
            black_box(
                AxisOrder::encode_strided_precise(order, format, strided(a), strided_mut(b))
                    .is_ok(),
            );
            black_box(AxisOrder::decode_strided(order, format, strided(a), strided_mut(b)).is_ok());
        }
    }
    fn parameters<C: TwoParameters>() {
        black_box(<C as TwoParameters>::from_parameters(black_box([1, -1])));
        black_box(<C as TwoParameters>::parameters(black_box(C::Code::zeroed())));
    }
    parameters::<Oct16>();
    parameters::<Oct24>();
    parameters::<OctUnorm16x2>();
}

/// All entry points of one codec of frames.
fn frames<C: FrameCodec>() {
    let frame = Frame { normal: [0.0, 0.6, 0.8], tangent: [1.0, 0.0, 0.0], handedness: 1.0 };
    black_box(<C as FrameCodec>::encode(black_box(frame)));
    black_box(<C as FrameCodec>::encode_precise(black_box(frame)));
    black_box(<C as FrameCodec>::decode(black_box(C::Code::zeroed())));
    black_box(<C as FrameCodec>::canonical(black_box(C::Code::zeroed())));
    black_box(<C as FrameCodec>::is_canonical(black_box(C::Code::zeroed())));

    let (mut normal, mut tangent) = (Buffers::new(), Buffers::new());
    let (mut codes, mut handedness) = ([C::Code::zeroed(); LEN], [1.0; LEN]);
    let codes = &mut codes[..];
    let handedness = &mut handedness[..];
    for precise in black_box([false, true]) {
        let handedness = black_box(&*handedness);
        let frames = FrameSoa { normal: normal.read(), tangent: tangent.read(), handedness };
        let codes = black_box(&mut *codes);
        let skew = if precise {
            <C as FrameCodec>::encode_soa_precise(frames, codes)
        } else {
            <C as FrameCodec>::encode_soa(frames, codes)
        };
        black_box(skew.is_ok());
    }
    let handedness = black_box(handedness);
    let frames = FrameSoaMut { normal: normal.write(), tangent: tangent.write(), handedness };
    black_box(<C as FrameCodec>::decode_soa(black_box(codes), frames).is_ok());
    frame_structures::<C, 3>(codes);
    frame_structures::<C, 4>(codes);
    let (a, b, c) = (&mut [0; 24 * LEN], &mut [0; 24 * LEN], &mut [0; 24 * LEN]);
    let skew = <C as FrameCodec>::encode_strided(strided(a), strided(b), strided_mut(c));
    black_box(skew.is_ok());
    let skew = <C as FrameCodec>::encode_strided_precise(strided(a), strided(b), strided_mut(c));
    black_box(skew.is_ok());
    let (v, tangent) = (strided_mut(b), black_box(20));
    black_box(<C as FrameCodec>::decode_vertices(strided(a), v, tangent).is_ok());
    let at = black_box([3, 9]);
    black_box(<C as FrameCodec>::encode_within(strided_mut(b), at[0], at[1]).is_ok());
    black_box(<C as FrameCodec>::encode_within_precise(strided_mut(b), at[0], at[1]).is_ok());
    black_box(<C as FrameCodec>::decode_within(strided_mut(b), at[0], at[1]).is_ok());
    black_box(
        <C as FrameCodec>::decode_strided(strided(a), strided_mut(b), strided_mut(c)).is_ok(),
    );
}

fn frame_structures<C: FrameCodec, const N: usize>(codes: &mut [C::Code]) {
    let (normals, tangents) = (&mut [[0.5; N]; LEN], &mut [[0.5; 4]; LEN]);
    let (normals, tangents) = (opaque(normals), opaque(tangents));
    let codes = opaque(codes);
    black_box(<C as FrameCodec>::encode_aos(normals, tangents, codes).is_ok());
    black_box(<C as FrameCodec>::encode_aos_precise(normals, tangents, codes).is_ok());
    black_box(<C as FrameCodec>::decode_aos(codes, normals, tangents).is_ok());
}

/// All entry points of a frame format chosen at run time.
fn frame_splits() {
    let Some(format) = OctAngleFormat::new(black_box(24), black_box(7)) else { return };
    black_box(OctAngleFormat::bits(format));
    black_box(OctAngleFormat::oct_bits(format));
    black_box(OctAngleFormat::angle_bits(format));
    black_box(OctAngleFormat::max_normal_error_degrees(format));
    black_box(OctAngleFormat::max_normal_error_precise_degrees(format));
    black_box(OctAngleFormat::max_tangent_error_degrees(format));
    black_box(OctAngleFormat::max_tangent_error_precise_degrees(format));
    let frame = Frame { normal: [0.0, 0.6, 0.8], tangent: [1.0, 0.0, 0.0], handedness: 1.0 };
    black_box(OctAngleFormat::encode(format, black_box(frame)));
    black_box(OctAngleFormat::encode_precise(format, black_box(frame)));
    black_box(OctAngleFormat::decode(format, black_box(0)));
    black_box(OctAngleFormat::canonical(format, black_box(0)));
    black_box(OctAngleFormat::is_canonical(format, black_box(0)));
    let [u, v] = black_box([1, -1]);
    black_box(OctAngleFormat::from_parameters(format, u, v, black_box(9), black_box(true)));
    black_box(OctAngleFormat::parameters(format, black_box(0)));
    derived::<OctAngleFormat>(format);

    let (mut normal, mut tangent) = (Buffers::new(), Buffers::new());
    let (bytes, handedness) = (&mut [0; 8 * LEN], &mut [1.0; LEN]);
    let (bytes, handedness) = (opaque(bytes), opaque(handedness));
    let size = LEN * OctAngleFormat::code_size(format);
    let bytes = bytes.get_mut(..size).unwrap_or_default();
    for precise in black_box([false, true]) {
        let handedness = black_box(&*handedness);
        let frames = FrameSoa { normal: normal.read(), tangent: tangent.read(), handedness };
        let bytes = black_box(&mut *bytes);
        let skew = if precise {
            OctAngleFormat::encode_soa_precise(format, frames, bytes)
        } else {
            OctAngleFormat::encode_soa(format, frames, bytes)
        };
        black_box(skew.is_ok());
    }
    let frames = FrameSoaMut { normal: normal.write(), tangent: tangent.write(), handedness };
    black_box(OctAngleFormat::decode_soa(format, black_box(bytes), frames).is_ok());
    let (a, b, c) = (&mut [0; 24 * LEN], &mut [0; 24 * LEN], &mut [0; 24 * LEN]);
    let skew = OctAngleFormat::encode_strided(format, strided(a), strided(b), strided_mut(c));
    black_box(skew.is_ok());
    let skew =
        OctAngleFormat::encode_strided_precise(format, strided(a), strided(b), strided_mut(c));
    black_box(skew.is_ok());
    let (v, tangent) = (strided_mut(b), black_box(20));
    black_box(OctAngleFormat::decode_vertices(format, strided(a), v, tangent).is_ok());
    let (normals, tangents) = (strided_mut(b), strided_mut(c));
    black_box(OctAngleFormat::decode_strided(format, strided(a), normals, tangents).is_ok());
}

fn all_frames() {
    frame_splits();
    black_box(basis(black_box([0.0, 0.6, 0.8])));
    frames::<OctAngle32>();
    frames::<OctAngle64>();
    frames::<QTangent64>();
    let frame = Frame { normal: [0.0, 0.6, 0.8], tangent: [1.0, 0.0, 0.0], handedness: 1.0 };
    black_box(Frame::bitangent(black_box(frame)));
    black_box(Frame::skew_degrees(black_box(frame)));
    black_box(black_box(frame) == black_box(frame));
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

/// Every public function of the crate.
fn all() {
    for &each in black_box(Format::ALL) {
        Format::visit(each, Everything);
        format(each);
    }
    errors();
    axis_order();
    all_padded();
    all_scalars();
    packing();
    all_dense();
    decode_tables();
    low_dimensions();
    fibonacci();
    all_dithered();
    all_quaternions();
    quaternion_formats();
    snorm_formats();
    codes_and_parameters();
    all_frames();
}

#[unsafe(no_mangle)]
extern "C" fn main() -> i32 {
    if cfg!(feature = "control") {
        // One codec, so that it is built in a moment.
        Visitor::visit::<Oct16>(Everything);
        black_box(black_box(Format::ALL)[black_box(0)]);
    } else {
        all();
    }
    0
}

#[cfg(not(feature = "std"))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        /// Defined nowhere.
        fn a_panic_path_survives() -> !;
    }
    // SAFETY: a program with this call does not link.
    unsafe { a_panic_path_survives() }
}

/// The precompiled `core` names it; with `panic = "abort"` nothing calls it.
#[cfg(not(feature = "std"))]
#[unsafe(no_mangle)]
extern "C" fn rust_eh_personality() {}

// memcpy, memset and the start of the program.
#[link(name = "c")]
unsafe extern "C" {}
