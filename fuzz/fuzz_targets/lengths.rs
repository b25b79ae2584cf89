//! Every function over slices refuses lengths that do not fit, says them, and writes nothing then.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::decode_table::{DecodeTable, FormatTable, OctantTable};
use unitpack::frame::{FrameCodec, OctAngle32, OctAngle64, OctAngleFormat, QTangent64};
use unitpack::low_dimensions::{Angle, Sign};
use unitpack::packing::*;
use unitpack::quaternion::{
    QuaternionCodec, SmallestThree32, SmallestThree48, SmallestThree64, Soa4, Soa4Mut, TanThree32,
};
use unitpack::scalar::{BiasedUnorm, Fixed, Scalar, Snorm, Unorm};
use unitpack::{CodeInt, Format, LengthMismatch, Oct8, Soa, SoaMut, SphericalFibonacci};
use unitpack_fuzz::{Bytes, FrameArrays, Subject};
use unitpack_test::codes::{decode_slice, encode_slice, last_pattern};
use unitpack_test::{Arrays, Effort, Outcome, Place, Transcode, Typed, UNWRITTEN};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let codec = Subject::choose(&mut bytes);
    let transcode = codec.transcode(&mut bytes);
    let least = bytes.length(10);
    // The same, mostly, or one of any length.
    let lengths = [(); 4].map(|()| if bytes.byte() % 3 == 0 { bytes.length(10) } else { least });
    codecs(codec.typed(), transcode, lengths);
    format_bytes(codec.format, lengths, bytes.byte() % 3 == 0);
    scalars(lengths);
    packed(lengths);
    tables(codec.format, lengths);
    low_dimensions(lengths);
    fibonacci(lengths);
    let w = if bytes.byte() % 3 == 0 { bytes.length(10) } else { lengths[3] };
    quaternions::<SmallestThree32>(lengths, w);
    quaternions::<SmallestThree48>(lengths, w);
    quaternions::<SmallestThree64>(lengths, w);
    quaternions::<TanThree32>(lengths, w);
    let others = [(); 4].map(|()| if bytes.byte() % 3 == 0 { bytes.length(10) } else { least });
    frames::<OctAngle32>(lengths, others);
    frames::<OctAngle64>(lengths, others);
    frames::<QTangent64>(lengths, others);
    let beside = usize::from(bytes.byte() % 3 == 0);
    for (oct, angle) in [(8, 7), (16, 4), (24, 7), (32, 15), (32, 31)] {
        let format = OctAngleFormat::new(oct, angle).expect("a split that there is");
        frame_split(format, lengths, others, beside);
    }
});

/// The error that lengths call for, if any, and the numbers that its message must give in this order.
type Mismatch<'a> = Option<(LengthMismatch, &'a [usize])>;

fn unless(fit: bool, error: LengthMismatch, lengths: &[usize]) -> Mismatch<'_> {
    (!fit).then_some((error, lengths))
}

/// Calls a function with slices that hold `unwritten`, and compares what it returns and leaves.
fn check<T: Clone + PartialEq>(
    of: &str,
    unwritten: T,
    mismatch: Mismatch<'_>,
    run: impl FnOnce(&mut T) -> Outcome,
) {
    let mut out = unwritten.clone();
    let result = run(&mut out);
    assert_eq!(result.err(), mismatch.map(|m| m.0), "{of}");
    if let Some((error, lengths)) = mismatch {
        assert!(out == unwritten, "{of}: something was written");
        let message = error.to_string();
        let mut numbers = message.split(|c: char| !c.is_ascii_digit());
        for length in lengths {
            assert!(numbers.any(|n| n == length.to_string()), "{message:?} lacks {length}");
        }
    }
}

fn codecs(codec: &Typed, transcode: &Transcode, lengths: [usize; 4]) {
    let format = codec.format;
    let [x, y, z, codes] = lengths;
    let unwritten = |len: usize| vec![last_pattern(format) & 0xA5A5_A5A5_A5A5_A5A5_A5A5_A5A5; len];
    let arrays = Arrays::filled([x, y, z], 0.5);
    let error = LengthMismatch::Soa { x, y, z, codes };
    let mismatch = unless(lengths == [x; 4], error, &lengths);
    for effort in Effort::BOTH {
        let of = format!("{format} encode_soa, {effort:?}");
        check(&of, unwritten(codes), mismatch, |codes| {
            (codec.encode_soa)(effort, arrays.read(), Place::from(&mut codes[..]))
        });
    }
    let of = format!("{format} decode_soa");
    check(&of, Arrays::unwritten([x, y, z]), mismatch, |v| {
        (codec.decode_soa)(&unwritten(codes), 0..codes, v.write())
    });

    let vectors = x;
    let mismatch = unless(x == y, LengthMismatch::Aos { vectors, codes: y }, &lengths[..2]);
    for aos in &codec.aos {
        let of = format!("{format}, structures of {}", aos.floats);
        let structures = vec![0.5; aos.floats * vectors];
        for effort in Effort::BOTH {
            check(&of, unwritten(y), mismatch, |codes| {
                (aos.encode)(effort, &structures, Place::from(&mut codes[..]))
            });
        }
        let structures = vec![UNWRITTEN; structures.len()];
        check(&of, structures, mismatch, |v| (aos.decode)(&unwritten(y), v));
    }

    let mismatch = unless(x == y, LengthMismatch::Transcode { src: x, dst: y }, &lengths[..2]);
    let of = format!("{} to {}", transcode.from, transcode.to);
    let unwritten = vec![last_pattern(transcode.to) & 0xA5A5_A5A5_A5A5; y];
    check(&of, unwritten, mismatch, |dst| (transcode.run)(&vec![1; x], Place::from(&mut dst[..])));
}

fn format_bytes(format: Format, [x, y, z, codes]: [usize; 4], one_more: bool) {
    let code_size = format.code_size();
    let bytes = codes * code_size + usize::from(one_more);
    let error = LengthMismatch::Bytes { x, y, z, bytes, code_size };
    let lengths = [x, y, z, bytes, code_size];
    let mismatch = unless(x == y && y == z && bytes == x * code_size, error, &lengths);
    let arrays = Arrays::filled([x, y, z], 0.5);
    let of = format!("{format} in bytes");
    for effort in Effort::BOTH {
        check(&of, vec![0xA5; bytes], mismatch, |b| encode_slice(format, effort, arrays.read(), b));
    }
    let unwritten = Arrays::unwritten([x, y, z]);
    check(&of, unwritten.clone(), mismatch, |v| decode_slice(format, &vec![1; bytes], v.write()));
    if format.bits() <= 8 {
        let mut vectors = vec![[0.0; 3]; 1 << format.bits()];
        let table = FormatTable::fill(format, &mut vectors).unwrap();
        check(&of, unwritten, mismatch, |v| table.decode_bytes(&vec![1; bytes], v.write()));
    }
}

fn scalars([values, codes, ..]: [usize; 4]) {
    fn both<S: Scalar, C: CodeInt>(values: usize, codes: usize) {
        let lengths = [values, codes];
        let mismatch = unless(values == codes, LengthMismatch::Values { values, codes }, &lengths);
        let unwritten: Vec<C> =
            vec![bytemuck::pod_read_unaligned(&[0xA5; 4][..size_of::<C>()]); codes];
        let of = std::any::type_name::<S>();
        check(of, unwritten.clone(), mismatch, |codes| S::encode_slice(&vec![0.5; values], codes));
        check(of, vec![UNWRITTEN; values], mismatch, |values| S::decode_slice(&unwritten, values));
    }
    both::<Unorm<8>, u8>(values, codes);
    both::<Snorm<12>, u16>(values, codes);
    both::<BiasedUnorm<22>, u32>(values, codes);
    both::<Fixed<24>, u32>(values, codes);
}

fn packed(lengths: [usize; 4]) {
    let [a, b, c, _] = lengths;
    let two = unless(a == b, LengthMismatch::Values { values: a, codes: b }, &lengths[..2]);
    let (texels, words) = (vec![[0xA5; 3]; b], vec![0xA5A5_A5A5; b]);
    check("texels", texels.clone(), two, |to| pack_snorm12x2_slice(&vec![[0.5; 2]; a], to));
    check("texels", vec![[UNWRITTEN; 2]; a], two, |to| unpack_snorm12x2_slice(&texels, to));
    check("11-11-10", words.clone(), two, |to| pack_11_11_10_slice(&vec![[1; 3]; a], to));
    check("11-11-10", vec![[0xA5A5; 3]; a], two, |to| unpack_11_11_10_slice(&words, to));

    let error = LengthMismatch::Tagged { codes: a, tags: b, words: c };
    let three = unless(a == b && b == c, error, &lengths[..3]);
    let (codes, tags, words) = (vec![0xA5A5_A5A5; a], vec![0xA5; b], vec![0xA5A5_A5A5; c]);
    let fields = vec![[0xA5A5; 3]; a];
    check("tags", words.clone(), three, |to| pack_tag_slice(&codes, &tags, to));
    check("tags", (codes, tags.clone()), three, |to| {
        unpack_tag_slice(&words, &mut to.0, &mut to.1)
    });
    check("10-10-10-2", words.clone(), three, |to| pack_10_10_10_2_slice(&fields, &tags, to));
    check("10-10-10-2", (fields, tags), three, |to| {
        unpack_10_10_10_2_slice(&words, &mut to.0, &mut to.1)
    });

    fn dense<const BITS: u32>(codes: usize, bytes: usize) {
        let error = LengthMismatch::Dense { codes, bytes, bits: BITS };
        let lengths = [codes, bytes, BITS as usize];
        let mismatch = unless((codes * BITS as usize).div_ceil(8) == bytes, error, &lengths);
        let words = vec![0xA5A5_A5A5u32; codes];
        check("dense", vec![0xA5; bytes], mismatch, |to| pack_dense::<BITS, u32>(&words, to));
        check("dense", words.clone(), mismatch, |to| {
            unpack_dense::<BITS, u32>(&vec![1; bytes], to)
        });
    }
    for bytes in [b, (a * 12).div_ceil(8), a.div_ceil(8), 4 * a] {
        dense::<1>(a, bytes);
        dense::<12>(a, bytes);
        dense::<22>(a, bytes);
        dense::<32>(a, bytes);
    }
}

fn tables(format: Format, lengths: [usize; 4]) {
    let [x, y, z, codes] = lengths;
    let entries = (format.bits() <= 16).then(|| 1 << format.bits());
    let fitting = entries.filter(|&entries| entries <= 256);
    for vectors in [x].into_iter().chain(fitting) {
        let error = LengthMismatch::Table { vectors, entries };
        let mismatch = unless(entries == Some(vectors), error, &lengths[..0]);
        check("a table", vec![[UNWRITTEN; 3]; vectors], mismatch, |to| {
            FormatTable::fill(format, to).map(|_| ())
        });
    }

    const WHOLE: usize = DecodeTable::<Oct8>::LEN;
    const OCTANT: usize = OctantTable::<Oct8>::LEN;
    let short = |vectors, entries| LengthMismatch::Table { vectors, entries: Some(entries) };
    let numbers = [x, WHOLE];
    check("a table", vec![[UNWRITTEN; 3]; x], Some((short(x, WHOLE), &numbers)), |to| {
        DecodeTable::<Oct8>::fill(to).map(|_| ())
    });
    let numbers = [x, OCTANT];
    check("an octant", vec![[UNWRITTEN; 3]; x], Some((short(x, OCTANT), &numbers)), |to| {
        OctantTable::<Oct8>::fill(to).map(|_| ())
    });
    let (mut whole, mut octant) = ([[0.0; 3]; WHOLE], [[0.0; 3]; OCTANT]);
    let whole = DecodeTable::<Oct8>::fill(&mut whole).unwrap();
    let octant = OctantTable::<Oct8>::fill(&mut octant).unwrap();
    let soa = unless(lengths == [x; 4], LengthMismatch::Soa { x, y, z, codes }, &lengths);
    let aos = unless(x == y, LengthMismatch::Aos { vectors: x, codes: y }, &lengths[..2]);
    let arrays = Arrays::unwritten([x, y, z]);
    let structures = vec![[UNWRITTEN; 4]; x];
    check("a table", arrays.clone(), soa, |v| whole.decode_soa(&vec![1; codes], v.write()));
    check("an octant", arrays, soa, |v| octant.decode_soa(&vec![1; codes], v.write()));
    check("a table", structures.clone(), aos, |v| whole.decode_aos(&vec![1; y], v));
    check("an octant", structures, aos, |v| octant.decode_aos(&vec![1; y], v));
}

fn fibonacci([x, y, z, codes]: [usize; 4]) {
    let points = SphericalFibonacci::new(1 + x as u32).unwrap();
    let error = LengthMismatch::Soa { x, y, z, codes };
    let lengths = [x, y, z, codes];
    let mismatch = unless(lengths.iter().all(|&length| length == x), error, &lengths);
    let [from_x, from_y, from_z] = [x, y, z].map(|length| vec![0.5; length]);
    check("points", vec![u32::MAX; codes], mismatch, |to| {
        points.encode_soa(Soa { x: &from_x, y: &from_y, z: &from_z }, to)
    });
    let unwritten = [x, y, z].map(|length| vec![UNWRITTEN; length]);
    check("points", unwritten, mismatch, |[x, y, z]| {
        points.decode_soa(&vec![0; codes], SoaMut { x, y, z })
    });
}

fn low_dimensions(lengths: [usize; 4]) {
    let [x, y, codes, bytes] = lengths;
    let error = LengthMismatch::Angles { x, y, codes };
    let mismatch = unless(x == y && y == codes, error, &lengths[..3]);
    check("angles", vec![0xA5A5u16; codes], mismatch, |to| {
        Angle::<12>::encode_soa(&vec![0.5; x], &vec![0.5; y], to)
    });
    check("angles", (vec![UNWRITTEN; x], vec![UNWRITTEN; y]), mismatch, |to| {
        Angle::<12>::decode_soa(&vec![1u16; codes], &mut to.0, &mut to.1)
    });
    for bytes in [bytes, x.div_ceil(8)] {
        let error = LengthMismatch::Dense { codes: x, bytes, bits: 1 };
        let lengths = [x, bytes, 1];
        let mismatch = unless(bytes == x.div_ceil(8), error, &lengths);
        check("signs", vec![0xA5; bytes], mismatch, |to| Sign::encode_slice(&vec![0.5; x], to));
        check("signs", vec![UNWRITTEN; x], mismatch, |to| Sign::decode_slice(&vec![1; bytes], to));
    }
}

fn quaternions<C: QuaternionCodec>([x, y, z, codes]: [usize; 4], w: usize) {
    let lengths = [x, y, z, w, codes];
    let error = LengthMismatch::Quaternions { x, y, z, w, codes };
    let mismatch = unless(lengths == [x; 5], error, &lengths);
    let pattern: C::Code = bytemuck::pod_read_unaligned(&[0xA5; 8][..size_of::<C::Code>()]);
    let arrays = [x, y, z, w].map(|len| vec![0.5; len]);
    let soa = Soa4 { x: &arrays[0], y: &arrays[1], z: &arrays[2], w: &arrays[3] };
    check(C::NAME, vec![pattern; codes], mismatch, |to| C::encode_soa(soa, to));
    check(C::NAME, vec![pattern; codes], mismatch, |to| C::encode_soa_precise(soa, to));
    let unwritten = [x, y, z, w].map(|len| vec![UNWRITTEN; len]);
    check(C::NAME, unwritten, mismatch, |[x, y, z, w]| {
        C::decode_soa(&vec![pattern; codes], Soa4Mut { x, y, z, w })
    });

    let mismatch = unless(x == y, LengthMismatch::Aos { vectors: x, codes: y }, &lengths[..2]);
    let structures = vec![[0.5; 4]; x];
    check(C::NAME, vec![pattern; y], mismatch, |to| C::encode_aos(&structures, to));
    check(C::NAME, vec![pattern; y], mismatch, |to| C::encode_aos_precise(&structures, to));
    check(C::NAME, vec![[UNWRITTEN; 4]; x], mismatch, |to| C::decode_aos(&vec![pattern; y], to));
}

fn frame_split(
    format: OctAngleFormat,
    [a, b, c, d]: [usize; 4],
    [e, f, handedness, codes]: [usize; 4],
    beside: usize,
) {
    let (normal, tangent, code_size) = ([a, b, c], [d, e, f], format.code_size());
    let bytes = codes * code_size + beside;
    let error = LengthMismatch::FrameBytes { normal, tangent, handedness, bytes, code_size };
    let lengths = [a, b, c, d, e, f, handedness, bytes, code_size];
    let fit = [a, b, c, d, e, f, handedness] == [codes; 7] && beside == 0;
    let mismatch = unless(fit, error, &lengths);
    let unwritten = vec![0xA5; bytes];
    for encode in [OctAngleFormat::encode_soa, OctAngleFormat::encode_soa_precise] {
        let frames = FrameArrays([a, b, c, d, e, f, handedness].map(|len| vec![0.5; len]));
        let encode = |to: &mut Vec<u8>| encode(format, frames.read(), to).map(drop);
        check("a split of frames", unwritten.clone(), mismatch, encode);
    }
    let frames = FrameArrays::unwritten([a, b, c, d, e, f, handedness]);
    let decode = |to: &mut FrameArrays| format.decode_soa(&unwritten, to.write());
    check("a split of frames", frames, mismatch, decode);
}

fn frames<C: FrameCodec>([a, b, c, d]: [usize; 4], [e, f, handedness, codes]: [usize; 4]) {
    let (normal, tangent) = ([a, b, c], [d, e, f]);
    let error = LengthMismatch::FrameSoa { normal, tangent, handedness, codes };
    let lengths = [a, b, c, d, e, f, handedness, codes];
    let mismatch = unless(lengths == [a; 8], error, &lengths);
    let unwritten = |len: usize| {
        vec![bytemuck::pod_read_unaligned::<C::Code>(&[0xA5; 8][..size_of::<C::Code>()]); len]
    };
    let unwritten_frames = FrameArrays::unwritten([a, b, c, d, e, f, handedness]);
    for encode in [C::encode_soa, C::encode_soa_precise] {
        let frames = FrameArrays([a, b, c, d, e, f, handedness].map(|len| vec![0.5; len]));
        check(C::NAME, unwritten(codes), mismatch, |to| encode(frames.read(), to).map(drop));
    }
    check(C::NAME, unwritten_frames, mismatch, |to| C::decode_soa(&unwritten(codes), to.write()));

    let (normals, tangents, codes) = (a, b, c);
    let error = LengthMismatch::FrameAos { normals, tangents, codes };
    let mismatch = unless(a == b && b == c, error, &lengths[..3]);
    for encode in [C::encode_aos::<3>, C::encode_aos_precise::<3>] {
        let (normals, tangents) = (vec![[0.5; 3]; normals], vec![[0.5; 4]; tangents]);
        check(C::NAME, unwritten(codes), mismatch, |to| encode(&normals, &tangents, to).map(drop));
    }
    let structures = (vec![[UNWRITTEN; 3]; normals], vec![[UNWRITTEN; 4]; tangents]);
    check(C::NAME, structures, mismatch, |to| {
        C::decode_aos(&unwritten(codes), &mut to.0, &mut to.1)
    });
}
