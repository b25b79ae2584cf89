//! Every entry point of a codec gives the same bits: one vector, structures of arrays, arrays of
//! structures, bytes, transcoding, and with them sixteen or eight lanes and one. The functions for one vector,
//! which run on one lane, are the measure of the others.
//!
//! Random vectors rarely meet a tie, a fold or an odd zero, so the generators aim at those.
//! `PROPTEST_CASES=20000 cargo test agree` searches for longer.

use std::marker::PhantomData;
use std::ops::Range;

use bytemuck::Pod;
use proptest::array::{uniform3, uniform16};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::strategy::ValueTree;
use proptest::test_runner::{TestCaseResult, TestRunner};
use unitpack::{
    Codec, Float32x3, Format, LengthMismatch, Oct16, Oct24, Oct32, Soa, SoaMut, Visitor, transcode,
};

use crate::common::Rng;

type Vector = [f32; 3];

/// What surrounds the results. As an `f32` it is a number that no decoder gives.
const SENTINEL: u8 = 0xA5;

// ---- Generators ----

/// Steps from 0 to 1 of a snorm or unorm grid.
fn grid() -> impl Strategy<Value = f64> {
    (3u32..=16).prop_map(|bits| ((1u64 << bits) - 1) as f64)
}

/// A number in [-1, 1] on a grid or half-way between two of its points.
fn on_grid() -> impl Strategy<Value = f64> {
    (grid(), -1.0..1.0f64, select(vec![0.0, 0.5]))
        .prop_map(|(steps, t, tie)| ((t * steps).floor() + tie) / steps)
}

/// A number half-way between two halves, subnormal ones included.
fn between_halves() -> impl Strategy<Value = f64> {
    let normal = (99..=126u32, 0..1024u32)
        .prop_map(|(exponent, m)| f64::from(f32::from_bits(exponent << 23 | m << 13 | 0x1000)));
    let subnormal = (0..1024u32).prop_map(|m| (f64::from(m) + 0.5) / 16_777_216.0);
    (prop_oneof![normal, subnormal], any::<bool>())
        .prop_map(|(x, minus)| if minus { -x } else { x })
}

/// Any bits, with a taste for the odd ones.
fn component() -> impl Strategy<Value = f32> {
    let odd = select(vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        f32::from_bits(1),
        1e-40,
        -1e-40,
        f32::MIN_POSITIVE,
        -f32::MIN_POSITIVE,
        1e-20,
        1e38,
        -1e38,
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        -f32::NAN,
    ]);
    prop_oneof![odd, any::<u32>().prop_map(f32::from_bits), -1.0..1.0f32]
}

fn ordinary() -> impl Strategy<Value = Vector> {
    uniform3(-1.0..1.0f32)
}

/// The direction of a point of the octahedral square.
fn unfold([u, w]: [f64; 2]) -> [f64; 3] {
    let z = 1.0 - u.abs() - w.abs();
    if z >= 0.0 { [u, w, z] } else { [(1.0 - w.abs()).copysign(u), (1.0 - u.abs()).copysign(w), z] }
}

/// Directions on the borders between codes, between the faces of an octahedron, and where formulas
/// divide by almost nothing.
fn edge() -> impl Strategy<Value = [f64; 3]> {
    let tie = || prop_oneof![4 => on_grid(), 1 => between_halves()];
    let small = || {
        let size = select(vec![0.0, 1e-5, 1e-9, 1e-20, 1e-30, 1e-37, 1e-42]);
        (size, any::<bool>()).prop_map(|(x, minus): (f64, bool)| if minus { -x } else { x })
    };
    let angle = || {
        prop_oneof![on_grid().prop_map(|t| t * 180.0), (-4..=4).prop_map(|i| f64::from(i) * 45.0)]
    };
    let polar = |theta: f64, phi: f64| {
        let ((sin, cos), (y, x)) = (theta.to_radians().sin_cos(), phi.to_radians().sin_cos());
        [sin * x, sin * y, cos]
    };
    let axis = select(vec![[1.0, 0.0, 0.0], [-1.0, -0.0, 0.0]]);
    let diagonal = (select(vec![1.0, -1.0]), -1.0..1.0f64, prop_oneof![-1.0..1.0f64, small()])
        .prop_map(|(s, a, b)| [a, a * s, b]);
    let on_plane = (-1.0..1.0f64, -1.0..1.0f64, small()).prop_map(|(a, b, c)| [a, b, c]);
    let near_axis = (small(), small(), select(vec![1.0, -1.0])).prop_map(|(a, b, c)| [a, b, c]);
    let one_tie = (tie(), -180.0..180.0f64).prop_map(|(c, phi)| {
        let (y, x) = phi.to_radians().sin_cos();
        let r = (1.0 - c * c).max(0.0).sqrt();
        [c, r * y, r * x]
    });
    let two_ties = (tie(), tie()).prop_map(|(a, b)| [a, b, (1.0 - a * a - b * b).max(0.0).sqrt()]);
    let ties = (tie(), tie(), tie()).prop_map(|(a, b, c)| [a, b, c]);
    let free_axes = prop_oneof![axis, diagonal, on_plane, near_axis, one_tie, two_ties, ties]
        .prop_flat_map(|v| Just(v.to_vec()).prop_shuffle())
        .prop_map(|v| [v[0], v[1], v[2]]);

    let oct = (tie(), tie()).prop_map(|(u, w)| unfold([u, w]));
    let hemi_oct = (tie(), tie()).prop_map(|(u, w)| unfold([(u + w) / 2.0, (u - w) / 2.0]));
    let spherical = (angle(), angle()).prop_map(move |(theta, phi)| polar(theta, phi));
    let rim = (angle(), small()).prop_map(move |(phi, z)| {
        let [x, y, _] = polar(90.0, phi);
        [x, y, z]
    });
    prop_oneof![3 => free_axes, 1 => oct, 1 => hemi_oct, 1 => spherical, 1 => rim]
}

/// Vectors on and next to edges, of any length, and vectors of any bits.
fn special() -> impl Strategy<Value = Vector> {
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        if length > 0.0 { v.map(|c| c / length) } else { v }
    };
    let length = prop_oneof![
        4 => Just(None),
        2 => Just(Some(1.0)),
        1 => select(vec![0.7, 3.0, 1e38, 1e30, 1e-30, 1e-40]).prop_map(Some),
    ];
    let nudge = |c: f32, n: i8| match n {
        1 => c.next_up(),
        -1 => c.next_down(),
        _ => c,
    };
    let edge = (edge(), length, uniform3(-1..=1i8), any::<bool>()).prop_map(
        move |(v, length, nudges, exactly)| {
            let v = length.map_or(v, |l| unit(v).map(|c| c * l)).map(|c| c as f32);
            if exactly { v } else { std::array::from_fn(|i| nudge(v[i], nudges[i])) }
        },
    );
    prop_oneof![4 => edge, 1 => uniform3(component())]
}

/// Blocks in which every vector is special, and blocks of sixteen in which one is.
fn batch() -> impl Strategy<Value = Vec<Vector>> {
    let one = (uniform16(ordinary()), special(), 0..16usize).prop_map(|(mut block, v, lane)| {
        block[lane] = v;
        block.to_vec()
    });
    prop_oneof![vec(special(), 0..=36), one]
}

/// The greatest size of a code.
const CODE: usize = 12;

/// Bit patterns, of which a code takes as many bytes as it has.
fn patterns() -> impl Strategy<Value = Vec<[u8; CODE]>> {
    let byte = || select(vec![0, 1, 0x3C, 0x7B, 0x7C, 0x7F, 0x80, 0x81, 0xBC, 0xFC, 0xFE, 0xFF]);
    let odd = vec(byte(), CODE).prop_map(|bytes| bytes.try_into().unwrap());
    vec(prop_oneof![any::<[u8; CODE]>(), odd], 0..=36)
}

// ---- Codecs without their types ----

/// The fast encoder or the precise one.
#[derive(Clone, Copy, Debug)]
enum Effort {
    Fast,
    Precise,
}

use Effort::{Fast, Precise};

type Outcome = Result<(), LengthMismatch>;

/// A slice of codes to write, in a larger buffer of little-endian bytes.
struct Place<'a> {
    buffer: &'a mut [u8],
    codes: Range<usize>,
}

/// What a codec does, its codes as little-endian bytes. The checks themselves are then compiled
/// once, not for every codec.
trait Untyped {
    fn format(&self) -> Format;
    /// The format and the size of a code, as its type has them.
    fn describe(&self) -> (Format, usize);
    fn encode(&self, effort: Effort, v: Vector) -> Vec<u8>;
    fn decode(&self, code: &[u8]) -> Vector;
    fn encode_soa(&self, effort: Effort, v: Soa<'_>, into: Place<'_>) -> Outcome;
    fn decode_soa(&self, buffer: &[u8], codes: Range<usize>, v: SoaMut<'_>) -> Outcome;
    /// Vectors of `n` floats: 3, 4 or 8.
    fn encode_aos(&self, effort: Effort, n: usize, v: &[f32], into: Place<'_>) -> Outcome;
    fn decode_aos(&self, n: usize, codes: &[u8], v: &mut [f32]) -> Outcome;
    fn transcode(&self, way: Way, codes: &[u8], into: Place<'_>) -> Outcome;
}

/// To and from two formats only: all pairs would be as many functions as the square of the table.
#[derive(Clone, Copy, Debug)]
enum Way {
    ToOct24,
    FromOct24,
    ToFloats,
    FromFloats,
}

struct Typed<C>(PhantomData<C>);

impl<C: Codec> Untyped for Typed<C> {
    fn format(&self) -> Format {
        C::FORMAT
    }
    fn describe(&self) -> (Format, usize) {
        (C::FORMAT, size_of::<C::Code>())
    }
    fn encode(&self, effort: Effort, v: Vector) -> Vec<u8> {
        let code = match effort {
            Fast => C::encode(v),
            Precise => C::encode_precise(v),
        };
        little_endian(&[code])
    }
    fn decode(&self, code: &[u8]) -> Vector {
        C::decode(native(code)[0])
    }
    fn encode_soa(&self, effort: Effort, v: Soa<'_>, into: Place<'_>) -> Outcome {
        write(into, &mut |codes| match effort {
            Fast => C::encode_soa(v, codes),
            Precise => C::encode_soa_precise(v, codes),
        })
    }
    fn decode_soa(&self, buffer: &[u8], codes: Range<usize>, v: SoaMut<'_>) -> Outcome {
        C::decode_soa(&native(buffer)[codes], v)
    }
    fn encode_aos(&self, effort: Effort, n: usize, v: &[f32], into: Place<'_>) -> Outcome {
        fn aos<C: Codec, const N: usize>(
            effort: Effort,
            v: &[f32],
            codes: &mut [C::Code],
        ) -> Outcome {
            let (v, _) = v.as_chunks::<N>();
            match effort {
                Fast => C::encode_aos(v, codes),
                Precise => C::encode_aos_precise(v, codes),
            }
        }
        write(into, &mut |codes| match n {
            3 => aos::<C, 3>(effort, v, codes),
            4 => aos::<C, 4>(effort, v, codes),
            8 => aos::<C, 8>(effort, v, codes),
            _ => unreachable!(),
        })
    }
    fn decode_aos(&self, n: usize, codes: &[u8], v: &mut [f32]) -> Outcome {
        let codes = &native(codes);
        match n {
            3 => C::decode_aos::<3>(codes, v.as_chunks_mut().0),
            4 => C::decode_aos::<4>(codes, v.as_chunks_mut().0),
            8 => C::decode_aos::<8>(codes, v.as_chunks_mut().0),
            _ => unreachable!(),
        }
    }
    fn transcode(&self, way: Way, codes: &[u8], into: Place<'_>) -> Outcome {
        fn run<A: Codec, B: Codec>(codes: &[u8], into: Place<'_>) -> Outcome {
            write(into, &mut |into| transcode::<A, B>(&native(codes), into))
        }
        match way {
            Way::ToOct24 => run::<C, Oct24>(codes, into),
            Way::FromOct24 => run::<Oct24, C>(codes, into),
            Way::ToFloats => run::<C, Float32x3>(codes, into),
            Way::FromFloats => run::<Float32x3, C>(codes, into),
        }
    }
}

/// A code is an integer, or an array of integers, as large as its alignment.
fn swap_on_big_endian<C>(bytes: &mut [u8]) {
    if cfg!(target_endian = "big") {
        bytes.chunks_exact_mut(align_of::<C>()).for_each(<[u8]>::reverse);
    }
}

fn little_endian<C: Pod>(codes: &[C]) -> Vec<u8> {
    let mut bytes = bytemuck::cast_slice(codes).to_vec();
    swap_on_big_endian::<C>(&mut bytes);
    bytes
}

fn native<C: Pod>(bytes: &[u8]) -> Vec<C> {
    let mut bytes = bytes.to_vec();
    swap_on_big_endian::<C>(&mut bytes);
    bytes.chunks_exact(size_of::<C>()).map(bytemuck::pod_read_unaligned).collect()
}

fn write<C: Pod>(into: Place<'_>, write: &mut dyn FnMut(&mut [C]) -> Outcome) -> Outcome {
    let mut codes = native::<C>(into.buffer);
    let outcome = write(&mut codes[into.codes]);
    into.buffer.copy_from_slice(&little_endian(&codes));
    outcome
}

struct Erase;

impl Visitor for Erase {
    type Output = &'static dyn Untyped;
    fn visit<C: Codec>(self) -> &'static dyn Untyped {
        &Typed::<C>(PhantomData)
    }
}

fn untyped(format: Format) -> &'static dyn Untyped {
    format.visit(Erase)
}

fn codecs() -> impl Iterator<Item = &'static dyn Untyped> {
    Format::ALL.iter().copied().map(untyped)
}

// ---- Buffers ----

/// Elements around a slice that nothing may be written to.
const MARGIN: usize = 8;

fn sentinel() -> f32 {
    f32::from_le_bytes([SENTINEL; 4])
}

fn is_sentinel(floats: &[f32]) -> bool {
    floats.iter().all(|c| c.to_bits() == sentinel().to_bits())
}

/// Sentinels, then `middle`, then sentinels: [`MARGIN`] elements of `size` bytes in all.
fn surrounded(middle: &[u8], offset: usize, size: usize) -> Vec<u8> {
    let margin = |n: usize| vec![SENTINEL; n * size];
    [margin(offset), middle.to_vec(), margin(MARGIN - offset)].concat()
}

/// A structure of arrays in larger buffers, each array at an offset of its own.
struct Columns {
    buffers: [Vec<f32>; 3],
    starts: [usize; 3],
    len: usize,
}

impl Columns {
    /// x starts `offset` elements into its buffer.
    fn new(v: &[Vector], offset: usize) -> Self {
        let starts = [offset, (offset + 3) % MARGIN, (offset + 5) % MARGIN];
        let mut buffers = [(); 3].map(|()| vec![sentinel(); v.len() + MARGIN]);
        for (i, v) in v.iter().enumerate() {
            for ((buffer, start), c) in buffers.iter_mut().zip(starts).zip(v) {
                buffer[start + i] = *c;
            }
        }
        Columns { buffers, starts, len: v.len() }
    }

    fn read(&self) -> Soa<'_> {
        let [x, y, z] = &self.buffers;
        let [at_x, at_y, at_z] = self.starts.map(|start| start..start + self.len);
        Soa { x: &x[at_x], y: &y[at_y], z: &z[at_z] }
    }

    fn write(&mut self) -> SoaMut<'_> {
        let [x, y, z] = &mut self.buffers;
        let [at_x, at_y, at_z] = self.starts.map(|start| start..start + self.len);
        SoaMut { x: &mut x[at_x], y: &mut y[at_y], z: &mut z[at_z] }
    }

    fn bits(&self) -> [Vec<u32>; 3] {
        self.buffers.each_ref().map(|buffer| all_bits(buffer))
    }
}

/// Each vector followed by `n - 3` further floats, all different.
fn widened(v: &[Vector], n: usize) -> Vec<f32> {
    let more = |i: usize| (3..n).map(move |j| (100 * i + j) as f32);
    v.iter().enumerate().flat_map(|(i, v)| v.iter().copied().chain(more(i))).collect()
}

fn bits(v: Vector) -> [u32; 3] {
    v.map(f32::to_bits)
}

fn all_bits(floats: &[f32]) -> Vec<u32> {
    floats.iter().map(|c| c.to_bits()).collect()
}

// ---- All entry points give the same bits ----

/// The position in bytes, or in bits of floats, of the first difference.
fn difference<T: PartialEq>(a: &[T], b: &[T]) -> Option<usize> {
    a.iter()
        .zip(b)
        .position(|(a, b)| a != b)
        .or((a.len() != b.len()).then_some(a.len().min(b.len())))
}

/// Every encoder of slices gives `expected`, and writes nowhere else.
fn encoders_give(
    codec: &dyn Untyped,
    effort: Effort,
    v: &[Vector],
    offset: usize,
    expected: &[u8],
) -> TestCaseResult {
    let (format, size) = (codec.format(), codec.format().code_size());
    let check = |what: &str, got: &[u8], expected: &[u8]| {
        if let Some(byte) = difference(got, expected) {
            // Where one of several vectors is at fault.
            let v = byte.checked_sub(offset * size).and_then(|byte| v.get(byte / size));
            prop_assert!(
                false,
                "{format} {effort:?} {what} at offset {offset}, vector {v:?} ({:x?}), byte {byte}:\n\
                 {got:x?}, but alone\n{expected:x?}",
                v.copied().map(bits)
            );
        }
        Ok(())
    };
    let all = surrounded(expected, offset, size);
    let empty = surrounded(&vec![SENTINEL; expected.len()], offset, size);
    let codes = offset..offset + v.len();

    let columns = Columns::new(v, offset);
    let mut buffer = empty.clone();
    let into = Place { buffer: &mut buffer, codes: codes.clone() };
    codec.encode_soa(effort, columns.read(), into).unwrap();
    check("SoA", &buffer, &all)?;

    for n in [3, 4, 8] {
        let vectors = [vec![sentinel(); n * offset], widened(v, n)].concat();
        let mut buffer = empty.clone();
        let into = Place { buffer: &mut buffer, codes: codes.clone() };
        codec.encode_aos(effort, n, &vectors[n * offset..], into).unwrap();
        check(&format!("AoS {n}"), &buffer, &all)?;
    }

    // Bytes start at any byte.
    let mut buffer = surrounded(&vec![SENTINEL; expected.len()], offset, 1);
    let bytes = &mut buffer[offset..offset + expected.len()];
    match effort {
        Fast => format.encode(columns.read(), bytes).unwrap(),
        Precise => format.encode_precise(columns.read(), bytes).unwrap(),
    }
    check("bytes", &buffer, &surrounded(expected, offset, 1))
}

/// Every decoder of slices gives `expected`, and writes nowhere else.
fn decoders_give(
    codec: &dyn Untyped,
    codes: &[u8],
    offset: usize,
    expected: &[Vector],
) -> TestCaseResult {
    let (format, size) = (codec.format(), codec.format().code_size());
    let nothing = vec![[sentinel(); 3]; expected.len()];
    let check = |what: &str, got: &[u32], expected: &[u32]| {
        if let Some(i) = difference(got, expected) {
            prop_assert!(
                false,
                "{format} decoded {what} at offset {offset}, float {i} of {codes:x?}:\n\
                 {got:x?}, but alone\n{expected:x?}"
            );
        }
        Ok(())
    };
    let alone = Columns::new(expected, offset).bits();
    let check_columns = |what: &str, got: &Columns| {
        got.bits().iter().zip(&alone).try_for_each(|(got, alone)| check(what, got, alone))
    };

    let mut columns = Columns::new(&nothing, offset);
    let range = offset..offset + expected.len();
    codec.decode_soa(&surrounded(codes, offset, size), range, columns.write()).unwrap();
    check_columns("SoA", &columns)?;

    let mut columns = Columns::new(&nothing, offset);
    let bytes = surrounded(codes, offset, 1);
    format.decode(&bytes[offset..offset + codes.len()], columns.write()).unwrap();
    check_columns("bytes", &columns)?;

    for n in [3, 4, 8] {
        let around = |v: &[Vector]| {
            let margin = |elements| vec![sentinel(); n * elements];
            [margin(offset), widened(v, n), margin(MARGIN - offset)].concat()
        };
        let mut got = around(&nothing);
        let range = n * offset..n * (offset + expected.len());
        codec.decode_aos(n, codes, &mut got[range]).unwrap();
        check(&format!("AoS {n}"), &all_bits(&got), &all_bits(&around(expected)))?;
    }
    Ok(())
}

/// Transcoding gives what decoding and then encoding gives.
fn transcoders_agree(codec: &dyn Untyped, codes: &[u8], offset: usize) -> TestCaseResult {
    for (other, there, back) in [
        (Format::Oct24, Way::ToOct24, Way::FromOct24),
        (Format::Float32x3, Way::ToFloats, Way::FromFloats),
    ] {
        let other = untyped(other);
        let codes = transcodes(codec, other, codec, there, codes, offset)?;
        transcodes(other, codec, codec, back, &codes, offset)?;
    }
    Ok(())
}

fn transcodes(
    from: &dyn Untyped,
    to: &dyn Untyped,
    by: &dyn Untyped,
    way: Way,
    codes: &[u8],
    offset: usize,
) -> Result<Vec<u8>, TestCaseError> {
    let codes_in = codes.chunks(from.format().code_size());
    let (len, size) = (codes_in.len(), to.format().code_size());
    let alone: Vec<_> = codes_in.flat_map(|code| to.encode(Fast, from.decode(code))).collect();
    let mut got = surrounded(&vec![SENTINEL; alone.len()], offset, size);
    let into = Place { buffer: &mut got, codes: offset..offset + len };
    by.transcode(way, codes, into).unwrap();
    let alone_surrounded = surrounded(&alone, offset, size);
    prop_assert!(
        got == alone_surrounded,
        "{} {way:?} at offset {offset}: {codes:x?} is\n{got:x?}, but decoded and encoded\n{alone_surrounded:x?}",
        by.format()
    );
    Ok(alone)
}

fn encode_all(codec: &dyn Untyped, effort: Effort, v: &[Vector]) -> Vec<u8> {
    v.iter().flat_map(|&v| codec.encode(effort, v)).collect()
}

fn decode_all(codec: &dyn Untyped, codes: &[u8]) -> Vec<Vector> {
    codes.chunks(codec.format().code_size()).map(|code| codec.decode(code)).collect()
}

/// As many bytes of each pattern as the codec has.
fn cut(codec: &dyn Untyped, patterns: &[[u8; CODE]]) -> Vec<u8> {
    patterns.iter().flat_map(|pattern| &pattern[..codec.format().code_size()]).copied().collect()
}

/// Sampled from a generator, the same every time.
fn sample<S: Strategy>(strategy: S) -> S::Value {
    strategy.new_tree(&mut TestRunner::deterministic()).unwrap().current()
}

/// Past one detour of 256 vectors over the stack, or several of 64, too.
fn lengths() -> impl Iterator<Item = usize> {
    (0..=67).chain([128, 131, 261])
}

/// Enough that every length and offset has other vectors in its lanes.
const POOL: usize = 271;

/// Where in the pool the vectors for a length and offset stand.
fn part(len: usize, offset: usize) -> Range<usize> {
    let start = (len + 8 * offset) % (POOL - len);
    start..start + len
}

/// The precise search of these takes up to 200 us a vector, others 10 us at most.
fn is_slow(format: Format, effort: Effort) -> bool {
    use Format::*;
    let wide = matches!(format, Snorm16x3 | XyzUnorm16x3 | Float16x3 | Snorm11_11_10 | Snorm10x3);
    matches!(effort, Precise) && wide
}

/// Slow ones at one offset for each length.
#[test]
fn encoders_agree_at_every_length_and_offset() -> TestCaseResult {
    let pool = sample(vec(special(), POOL));
    for codec in codecs() {
        let size = codec.format().code_size();
        for effort in [Fast, Precise] {
            let alone = encode_all(codec, effort, &pool);
            let every = if is_slow(codec.format(), effort) { MARGIN } else { 1 };
            for len in lengths() {
                for offset in (len % every..MARGIN).step_by(every) {
                    let part = part(len, offset);
                    let alone = &alone[size * part.start..size * part.end];
                    encoders_give(codec, effort, &pool[part], offset, alone)?;
                }
            }
        }
    }
    Ok(())
}

#[test]
fn decoders_agree_at_every_length_and_offset() -> TestCaseResult {
    let pool = sample(vec(any::<[u8; CODE]>(), POOL));
    for codec in codecs() {
        let size = codec.format().code_size();
        let codes = cut(codec, &pool);
        let alone = decode_all(codec, &codes);
        for len in lengths() {
            for offset in 0..MARGIN {
                let part = part(len, offset);
                let codes = &codes[size * part.start..size * part.end];
                decoders_give(codec, codes, offset, &alone[part])?;
                transcoders_agree(codec, codes, offset)?;
            }
        }
    }
    Ok(())
}

/// Up to eight components are rearranged in vectors, more are not. What is beyond three stays as it is.
fn of_components<const N: usize>() {
    for len in [1, 15, 16, 255, 257, 530] {
        let mut rng = Rng::new(len as u64);
        let vectors: Vec<[f32; N]> = (0..len).map(|_| [0; N].map(|_| rng.unit() as f32)).collect();
        let mut codes = vec![0; len];
        Oct16::encode_aos(&vectors, &mut codes).unwrap();
        let mut decoded = vectors.clone();
        Oct16::decode_aos(&codes, &mut decoded).unwrap();
        for ((v, &code), decoded) in vectors.iter().zip(&codes).zip(&decoded) {
            let mut expected = *v;
            assert_eq!(code, Oct16::encode([v[0], v[1], v[2]]));
            expected[..3].copy_from_slice(&Oct16::decode(code));
            assert_eq!(decoded.map(f32::to_bits), expected.map(f32::to_bits));
        }
    }
}

#[test]
fn vectors_may_have_any_number_of_components() {
    of_components::<3>();
    of_components::<4>();
    of_components::<5>();
    of_components::<7>();
    of_components::<8>();
    of_components::<9>();
    of_components::<256>();
}

// ---- Only the direction matters ----

/// Whether the format stores a direction. The others give the input back.
fn stores_direction(codec: &dyn Untyped) -> bool {
    codec.format() != Format::Float32x3
}

fn same_code(codec: &dyn Untyped, v: Vector, plain: Vector) -> TestCaseResult {
    for effort in [Fast, Precise] {
        let (got, expected) = (codec.encode(effort, v), codec.encode(effort, plain));
        prop_assert!(
            got == expected,
            "{} {effort:?}: {v:?} {:x?} is {got:x?}, but {plain:?} {:x?} is {expected:x?}",
            codec.format(),
            bits(v),
            bits(plain)
        );
    }
    Ok(())
}

/// `v` and 2^exponent times `v` have one code, if the product loses no bit.
fn scale_does_not_matter(v: Vector, exponent: i32) -> TestCaseResult {
    let scale = 2f32.powi(exponent);
    let scaled = v.map(|c| c * scale);
    if scaled.map(|c| c / scale) != v {
        return Ok(());
    }
    codecs()
        .filter(|&codec| stores_direction(codec))
        .try_for_each(|codec| same_code(codec, scaled, v))
}

/// A z that vanishes in any computation still says on which side of the equator a vector is.
#[test]
fn a_power_of_two_does_not_matter_beside_the_equator() -> TestCaseResult {
    const DIAGONAL: f32 = std::f32::consts::FRAC_1_SQRT_2;
    for z in [1e-30, -1e-30, 1e-45, -1e-45] {
        for exponent in -126..=127 {
            scale_does_not_matter([DIAGONAL, -DIAGONAL, z], exponent)?;
        }
    }
    Ok(())
}

/// A finite vector with the direction that the contract gives to `v`.
fn meant(format: Format, [x, y, z]: Vector) -> Vector {
    let v = [x, y, if format.is_hemisphere() && z < 0.0 { 0.0 } else { z }];
    if v.iter().any(|c| c.is_nan()) || v.iter().all(|&c| c == 0.0) {
        [0.0, 0.0, 1.0]
    } else if v.iter().any(|c| c.is_infinite()) {
        v.map(|c| if c.is_infinite() { c.signum() } else { 0.0 })
    } else {
        v
    }
}

fn odd_vectors_encode_as_documented(v: &[Vector]) -> TestCaseResult {
    for codec in codecs().filter(|&codec| stores_direction(codec)) {
        for &v in v {
            same_code(codec, v, meant(codec.format(), v))?;
        }
    }
    Ok(())
}

/// Every combination of odd components.
#[test]
fn zero_nan_infinite_and_lower_vectors_encode_as_documented() -> TestCaseResult {
    let odd = [
        0.0,
        -0.0,
        0.6,
        -0.6,
        1e-44,
        -1e-44,
        3e38,
        -3e38,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        -f32::NAN,
    ];
    let mut all = Vec::new();
    for x in odd {
        for y in odd {
            all.extend(odd.map(|z| [x, y, z]));
        }
    }
    odd_vectors_encode_as_documented(&all)
}

proptest! {
    // Not written to a file: what fails is printed, and belongs into a test of its own.
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn entry_points_agree_on_any_vectors(v in batch(), offset in 0..MARGIN) {
        for codec in codecs() {
            for effort in [Fast, Precise] {
                let codes = encode_all(codec, effort, &v);
                encoders_give(codec, effort, &v, offset, &codes)?;
                decoders_give(codec, &codes, offset, &decode_all(codec, &codes))?;
            }
        }
    }

    #[test]
    fn entry_points_agree_on_any_codes(patterns in patterns(), offset in 0..MARGIN) {
        for codec in codecs() {
            let codes = cut(codec, &patterns);
            decoders_give(codec, &codes, offset, &decode_all(codec, &codes))?;
            transcoders_agree(codec, &codes, offset)?;
        }
    }

    #[test]
    fn a_power_of_two_does_not_matter(v in vec(special(), 1..=16), exponent in -126..=127i32) {
        v.iter().try_for_each(|&v| scale_does_not_matter(v, exponent))?;
    }

    #[test]
    fn odd_input_encodes_as_documented(v in vec(special(), 1..=16)) {
        odd_vectors_encode_as_documented(&v)?;
    }

    #[test]
    fn bits_beyond_the_width_are_zero_and_ignored(v in vec(special(), 1..=8), patterns in patterns()) {
        for codec in codecs() {
            let format = codec.format();
            let used = |byte: usize| match (format.bits() as usize).saturating_sub(8 * byte) {
                bits @ 0..8 => (1u8 << bits) - 1,
                _ => 0xFF,
            };
            let clear = |code: &[u8]| -> Vec<u8> {
                code.iter().enumerate().map(|(i, byte)| byte & used(i)).collect()
            };
            for (&v, effort) in v.iter().flat_map(|v| [(v, Fast), (v, Precise)]) {
                let code = codec.encode(effort, v);
                prop_assert!(code == clear(&code), "{format} {effort:?} {v:?}: {code:x?}");
            }
            for code in cut(codec, &patterns).chunks(format.code_size()) {
                let (all, used) = (codec.decode(code), codec.decode(&clear(code)));
                prop_assert!(bits(all) == bits(used), "{format} {code:x?}: {all:?}, not {used:?}");
            }
        }
    }
}

/// Codes whose bytes the formats' definitions give, one for each kind of code.
#[test]
fn bytes_are_little_endian() {
    let bytes = |format: Format, [x, y, z]: Vector| {
        let mut bytes = vec![SENTINEL; format.code_size()];
        format.encode(Soa { x: &[x], y: &[y], z: &[z] }, &mut bytes).unwrap();
        bytes
    };
    assert_eq!(bytes(Format::Oct8, [1.0, 0.0, 0.0]), [0x07]);
    assert_eq!(bytes(Format::Oct16, [1.0, 0.0, 0.0]), [0x7F, 0x00]);
    assert_eq!(bytes(Format::Oct24, [1.0, 0.0, 0.0]), [0xFF, 0xE7, 0xFF]);
    assert_eq!(bytes(Format::Oct32, [1.0, 0.0, 0.0]), [0xFF, 0x7F, 0x00, 0x00]);
    assert_eq!(bytes(Format::Snorm16x3, [0.0, 1.0, 0.0]), [0, 0, 0xFF, 0x7F, 0, 0]);
    assert_eq!(
        bytes(Format::Float32x3, [1.0, -2.0, 0.1]),
        [0, 0, 0x80, 0x3F, 0, 0, 0, 0xC0, 0xCD, 0xCC, 0xCC, 0x3D]
    );
    assert_eq!(Oct16::encode([0.0, 1.0, 0.0]), 0x7F00);
    assert_eq!(Oct32::encode([0.0, 1.0, 0.0]), 0x7FFF_0000);
}

// ---- Lengths that differ ----

/// An error that says exactly these lengths.
fn refused(outcome: Outcome, expected: LengthMismatch, lengths: &[usize]) -> TestCaseResult {
    prop_assert_eq!(outcome, Err(expected));
    let message = expected.to_string();
    let said: Vec<usize> =
        message.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).collect();
    prop_assert_eq!(&said, lengths, "{}", message);
    Ok(())
}

/// Asserts that nothing was written.
fn untouched(codec: &dyn Untyped, lengths: &[usize], codes: &[u8], v: &[&[f32]]) -> TestCaseResult {
    let kept = codes.iter().all(|&byte| byte == SENTINEL) && v.iter().all(|c| is_sentinel(c));
    prop_assert!(kept, "{} wrote, though lengths {lengths:?} differ", codec.format());
    Ok(())
}

/// Lengths of x, y and z, and of codes; near a block of eight or a detour of 64.
#[test]
fn unequal_structures_of_arrays_are_refused() -> TestCaseResult {
    const UNEQUAL: [[usize; 4]; 14] = [
        [9, 9, 9, 8],
        [9, 9, 9, 10],
        [9, 9, 8, 9],
        [9, 9, 10, 9],
        [9, 8, 9, 9],
        [9, 10, 9, 9],
        [8, 9, 9, 9],
        [10, 9, 9, 9],
        [0, 0, 0, 1],
        [1, 1, 1, 0],
        [0, 8, 8, 8],
        [64, 64, 64, 65],
        [65, 65, 65, 64],
        [1, 2, 3, 4],
    ];
    for codec in codecs() {
        let (format, size) = (codec.format(), codec.format().code_size());
        for lengths @ [x, y, z, codes] in UNEQUAL {
            let columns = [x, y, z].map(|n| vec![0.5; n]);
            let v = Soa { x: &columns[0], y: &columns[1], z: &columns[2] };
            let mut to = [x, y, z].map(|n| vec![sentinel(); n]);
            let [to_x, to_y, to_z] = &mut to;
            let mut buffer = vec![SENTINEL; codes * size];

            let error = LengthMismatch::Soa { x, y, z, codes };
            for effort in [Fast, Precise] {
                let into = Place { buffer: &mut buffer, codes: 0..codes };
                refused(codec.encode_soa(effort, v, into), error, &lengths)?;
            }
            let outcome = codec.decode_soa(&buffer, 0..codes, SoaMut { x: to_x, y: to_y, z: to_z });
            refused(outcome, error, &lengths)?;

            let error = LengthMismatch::Bytes { x, y, z, bytes: codes * size, code_size: size };
            let said = [x, y, z, codes * size, size];
            refused(format.encode(v, &mut buffer), error, &said)?;
            refused(format.encode_precise(v, &mut buffer), error, &said)?;
            let outcome = format.decode(&buffer, SoaMut { x: to_x, y: to_y, z: to_z });
            refused(outcome, error, &said)?;
            untouched(codec, &lengths, &buffer, &[to_x, to_y, to_z])?;
        }
    }
    Ok(())
}

#[test]
fn broken_codes_are_refused() -> TestCaseResult {
    for codec in codecs() {
        let (format, size) = (codec.format(), codec.format().code_size());
        for bytes in [9 * size - 1, 9 * size + 1] {
            let c = [0.5; 9];
            let v = Soa { x: &c, y: &c, z: &c };
            let [mut x, mut y, mut z] = [[sentinel(); 9]; 3];
            let mut buffer = vec![SENTINEL; bytes];
            let error = LengthMismatch::Bytes { x: 9, y: 9, z: 9, bytes, code_size: size };
            let said = [9, 9, 9, bytes, size];
            refused(format.encode(v, &mut buffer), error, &said)?;
            refused(format.encode_precise(v, &mut buffer), error, &said)?;
            let outcome = format.decode(&buffer, SoaMut { x: &mut x, y: &mut y, z: &mut z });
            refused(outcome, error, &said)?;
            untouched(codec, &said, &buffer, &[&x, &y, &z])?;
        }
    }
    Ok(())
}

#[test]
fn unequal_arrays_of_structures_and_codes_are_refused() -> TestCaseResult {
    for codec in codecs() {
        let size = codec.format().code_size();
        for said @ [from, to] in [[0, 1], [1, 0], [8, 9], [9, 8], [64, 65], [65, 64], [200, 3]] {
            for n in [3, 4, 8] {
                let error = LengthMismatch::Aos { vectors: from, codes: to };
                let mut buffer = vec![SENTINEL; to * size];
                for effort in [Fast, Precise] {
                    let into = Place { buffer: &mut buffer, codes: 0..to };
                    let outcome = codec.encode_aos(effort, n, &vec![0.5; n * from], into);
                    refused(outcome, error, &said)?;
                }
                let mut v = vec![sentinel(); n * from];
                refused(codec.decode_aos(n, &buffer, &mut v), error, &said)?;
                untouched(codec, &said, &buffer, &[&v])?;
            }

            let error = LengthMismatch::Transcode { src: from, dst: to };
            for (way, from_size, to_size) in [
                (Way::ToOct24, size, 3),
                (Way::FromOct24, 3, size),
                (Way::ToFloats, size, 12),
                (Way::FromFloats, 12, size),
            ] {
                let mut buffer = vec![SENTINEL; to * to_size];
                let into = Place { buffer: &mut buffer, codes: 0..to };
                let outcome = codec.transcode(way, &vec![0; from * from_size], into);
                refused(outcome, error, &said)?;
                untouched(codec, &said, &buffer, &[])?;
            }
        }
    }
    Ok(())
}

#[test]
fn a_length_mismatch_is_a_copyable_error() {
    fn accepts<E: std::error::Error + Copy + Send + Sync + 'static>(_: E) {}
    accepts(LengthMismatch::Transcode { src: 1, dst: 2 });
}

// ---- Format ----

#[test]
fn formats_describe_their_codecs() {
    for &format in Format::ALL {
        assert_eq!(untyped(format).describe(), (format, format.code_size()), "{format}");
        assert!(format.code_size() <= CODE, "{format}: let CODE be the greatest size of a code");
        assert!((1..=8 * format.code_size()).contains(&(format.bits() as usize)), "{format}");
    }
}

#[test]
fn all_stands_in_the_order_of_the_variants() {
    assert!(Format::ALL.is_sorted_by(|a, b| a < b));
    assert_eq!(Format::ALL.first(), Some(&Format::Oct8));
}

#[test]
fn names_are_read_back_in_any_case() {
    let alternating = |name: &str| -> String {
        let case = |(i, c): (usize, char)| {
            if i % 2 == 0 { c.to_ascii_uppercase() } else { c.to_ascii_lowercase() }
        };
        name.chars().enumerate().map(case).collect()
    };
    for &format in Format::ALL {
        let name = format.name();
        assert_eq!(format.to_string(), name);
        assert_eq!(format!("{format:>30}|{format:<30}"), format!("{name:>30}|{name:<30}"));
        for name in [
            name.to_owned(),
            name.to_ascii_lowercase(),
            name.to_ascii_uppercase(),
            alternating(name),
        ] {
            assert_eq!(name.parse(), Ok(format), "{name}");
            assert_eq!(Format::from_name(&name), Some(format), "{name}");
        }
    }
}

#[test]
fn unknown_names_are_refused() {
    // Full-width digits and the Kelvin sign have ASCII look-alikes.
    let mut unknown =
        ["", " ", "oct", "oct17", "16", "o\u{FF43}t16", "\u{212A}"].map(String::from).to_vec();
    for format in Format::ALL {
        let name = format.name();
        unknown.extend([
            format!(" {name}"),
            format!("{name} "),
            format!("{name}\0"),
            format!("{name}x"),
        ]);
    }
    for name in unknown {
        assert!(name.parse::<Format>().is_err(), "{name:?}");
        assert_eq!(Format::from_name(&name), None, "{name:?}");
    }
    let error = "nonsense".parse::<Format>().unwrap_err();
    let error: &dyn std::error::Error = &error;
    assert!(!error.to_string().is_empty());
}
