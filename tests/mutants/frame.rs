//! Kills mutants of tangent frames.

mod support;

use std::fmt::Debug;

use bytemuck::{Pod, Zeroable, bytes_of, pod_read_unaligned};
use support::{Random, vectors};
use unitpack::LengthMismatch;
use unitpack::frame::*;
use unitpack_test::digests::{Section, digest};
use unitpack_test::frames::{columns, soa, soa_mut};

/// Every kind of normal with every kind of tangent: any two, parallel ones, and ones across.
fn frames() -> Vec<Frame> {
    let mut random = Random(5);
    let vectors = vectors();
    let signs = [1.0, -1.0, 0.0, -0.0, f32::NAN, -1e-45, f32::INFINITY, f32::NEG_INFINITY];
    let mut frames = Vec::new();
    for (i, &normal) in vectors.iter().enumerate() {
        let [x, y, z] = normal;
        let any = vectors[random.bits() as usize % vectors.len()];
        let tangent = match i % 8 {
            0 => normal.map(|c| c * -3.0),
            1 => [-y, x, 0.0],
            2 => [x + 1e-6 * any[0], y, z],
            3 => [x + 3e-4 * any[0], y, z + 3e-4 * any[2]],
            4 => [0.0, z, -y],
            _ => any,
        };
        let handedness = signs[random.bits() as usize % signs.len()];
        frames.push(Frame { normal, tangent, handedness });
    }
    frames
}

fn bytes<T: Pod>(slice: &[T]) -> impl Iterator<Item = u8> + '_ {
    slice.iter().flat_map(|t| bytes_of(t).to_vec())
}

fn bits(frame: Frame) -> [u32; 7] {
    let [[a, b, c], [d, e, f]] = [frame.normal, frame.tangent];
    [a, b, c, d, e, f, frame.handedness].map(f32::to_bits)
}

/// Digests of codes, of decoded frames and of canonical codes. Lanes and structures must agree with single
/// frames.
fn digests<C: FrameCodec>() -> [u64; 4] {
    let frames = frames();
    let columns = columns(&frames);
    let skewed = |i: &usize| frames[*i].skew_degrees();
    let normals: Vec<[f32; 5]> =
        frames.iter().map(|f| [f.normal[0], f.normal[1], f.normal[2], 7.0, 7.0]).collect();
    let tangents: Vec<[f32; 4]> =
        frames.iter().map(|f| [f.tangent[0], f.tangent[1], f.tangent[2], f.handedness]).collect();
    let mut all: Vec<C::Code> = Vec::new();
    let [fast, precise] = [false, true].map(|precise| {
        let mut codes = vec![C::Code::zeroed(); frames.len()];
        let encode = if precise { C::encode_soa_precise } else { C::encode_soa };
        let skew = encode(soa(&columns), &mut codes).unwrap();
        let worst = (0..frames.len()).map(|i| skewed(&i)).fold(0.0, f32::max);
        assert_eq!((skew.degrees, skewed(&skew.index)), (worst, worst));
        let one = if precise { C::encode_precise } else { C::encode };
        for (&frame, &code) in frames.iter().zip(&codes) {
            assert_eq!(one(frame), code, "{frame:?}");
            assert!(C::is_canonical(code), "{frame:?}");
        }
        let encode = if precise { C::encode_aos_precise::<5> } else { C::encode_aos::<5> };
        let mut again = vec![C::Code::zeroed(); frames.len()];
        assert_eq!(encode(&normals, &tangents, &mut again), Ok(skew));
        assert_eq!(codes, again);
        all.extend(&codes);
        digest(bytes(&codes))
    });
    let mut random = Random(6);
    for i in 0..700 {
        let turns = [0x00, 0x01, 0x7F, 0x80, 0x81, 0xFE, 0xFF];
        let bytes = [0; 8].map(|_| match i % 2 {
            0 => (random.bits() >> 24) as u8,
            _ => turns[(random.bits() >> 8) as usize % 7],
        });
        all.push(pod_read_unaligned(&bytes[..size_of::<C::Code>()]));
    }
    let mut decoded = [0; 7].map(|_| vec![9.0; all.len()]);
    C::decode_soa(&all, soa_mut(&mut decoded)).unwrap();
    let (mut normals, mut tangents) = (vec![[7.0; 5]; all.len()], vec![[7.0; 4]; all.len()]);
    C::decode_aos(&all, &mut normals, &mut tangents).unwrap();
    let mut canonical = Vec::new();
    for (i, &code) in all.iter().enumerate() {
        let one = C::decode(code);
        assert_eq!([0, 1, 2, 3, 4, 5, 6].map(|c: usize| decoded[c][i].to_bits()), bits(one));
        let ([a, b, c, d, e], [x, y, z, handedness]) = (normals[i], tangents[i]);
        assert_eq!(bits(Frame { normal: [a, b, c], tangent: [x, y, z], handedness }), bits(one));
        assert_eq!([d, e], [7.0; 2]);
        canonical.push(C::canonical(code));
        assert_eq!(C::is_canonical(code), C::canonical(code) == code);
    }
    let decoded = digest(decoded.iter().flat_map(|column| bytes(column)));
    [fast, precise, decoded, digest(bytes(&canonical))]
}

#[test]
fn digests_have_not_changed() {
    let columns = &["encode", "encode_precise", "decode", "canonical"];
    let mut section = Section::open("mutants: frame", columns);
    for (name, digests) in [
        (OctAngle32::NAME, digests::<OctAngle32>()),
        (OctAngle64::NAME, digests::<OctAngle64>()),
        (QTangent64::NAME, digests::<QTangent64>()),
    ] {
        digests.into_iter().for_each(|digest| section.add(name, digest));
    }
    section.finish();
}

/// The small values that no digest shows.
#[test]
fn skew_and_bitangent_are_right() {
    let frame = Frame { normal: [0.0, 0.0, 2.0], tangent: [3.0, 0.0, 0.0], handedness: -1.0 };
    assert_eq!((frame.bitangent(), frame.skew_degrees()), ([0.0, -6.0, 0.0], 0.0));
    for degrees in [0.01f32, 1.0, 30.0, 45.0, 60.0, 80.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        for sin in [sin, -sin] {
            let frame = Frame { tangent: [cos, 0.0, sin], ..frame };
            assert!((frame.skew_degrees() - degrees).abs() < 1e-4, "{degrees}");
        }
    }
    for tangent in [[0.0; 3], [f32::NAN, 1.0, 0.0], [0.0, 0.0, -5.0]] {
        assert_eq!(Frame { tangent, ..frame }.skew_degrees(), 90.0);
    }
    assert_eq!(Frame { tangent: [1.0, 0.0, 1e-25], ..frame }.skew_degrees(), 0.0);
    assert!(Frame { tangent: [1.0, 0.0, 1e-10], ..frame }.skew_degrees() > 5.0e-9);
    // The square is the least normal number.
    assert!(Frame { tangent: [1.0, 0.0, 2f32.powi(-63)], ..frame }.skew_degrees() > 0.0);
}

/// The first of equals, wherever among blocks and lanes, or in a later stage of structures.
#[test]
fn the_most_skewed_frame_is_named() {
    let right = Frame { normal: [0.0, 0.0, 1.0], tangent: [1.0, 0.0, 0.0], handedness: 1.0 };
    let mild = Frame { tangent: [1.0, 0.0, 0.5], ..right };
    let skewed = Frame { tangent: [1.0, 0.0, 1.0], ..right };
    for len in [1, 7, 8, 19, 70, 300] {
        for first in 0..len {
            let mut frames = vec![right; len];
            frames[0] = mild;
            for later in [0, 1, 7, 8, 9, 64].map(|step| first + step) {
                if let Some(frame) = frames.get_mut(later) {
                    *frame = skewed;
                }
            }
            let expected = (skewed.skew_degrees(), first);
            let mut codes = vec![0; len];
            let skew = OctAngle32::encode_soa(soa(&columns(&frames)), &mut codes).unwrap();
            assert_eq!((skew.degrees, skew.index), expected);
            let normals: Vec<[f32; 3]> = frames.iter().map(|f| f.normal).collect();
            let tangents: Vec<[f32; 4]> = frames
                .iter()
                .map(|f| [f.tangent[0], f.tangent[1], f.tangent[2], f.handedness])
                .collect();
            let skew = OctAngle32::encode_aos(&normals, &tangents, &mut codes).unwrap();
            assert_eq!((skew.degrees, skew.index), expected);
        }
    }
    let none = OctAngle32::encode_soa(soa(&columns(&[])), &mut []).unwrap();
    assert_eq!(none, Skew::default());
}

/// Axes survive, and a tangent that is none is the first of Duff's basis.
#[test]
fn simple_frames_survive() {
    for (normal, tangent) in [
        ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]),
        ([0.0, 0.0, -1.0], [0.0, -1.0, 0.0]),
        ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
        ([-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ] {
        for handedness in [1.0, -1.0] {
            let frame = Frame { normal, tangent, handedness };
            assert_eq!(OctAngle32::decode(OctAngle32::encode(frame)), frame);
            assert_eq!(OctAngle64::decode(OctAngle64::encode_precise(frame)), frame);
        }
    }
    let frame = Frame { normal: [1.0, 0.0, 0.0], tangent: [0.0; 3], handedness: 1.0 };
    let expected = Frame { tangent: [0.0, 0.0, -1.0], ..frame };
    assert_eq!(OctAngle32::decode(OctAngle32::encode(frame)), expected);
    assert_eq!(QTangent64::decode(QTangent64::encode(frame)), expected);
    assert_eq!(QTangent64::decode([0; 4]).normal, [0.0, 0.0, 1.0]);
}

/// Off the unit quaternions of their directions by 0.986 steps, and by 1.021.
#[test]
fn a_quaternion_is_canonical_less_than_a_step_off() {
    assert!(QTangent64::is_canonical([31024, 9009, 938, 5405]));
    assert!(!QTangent64::is_canonical([2626, -30423, -11237, 3876]));
}

/// Codes of a few splits, alone and in bytes, come back; some are known.
#[test]
fn splits_agree_with_single_frames() {
    let frames = frames();
    let columns = columns(&frames);
    for (oct, angle, size) in
        [(8, 7, 2), (14, 8, 3), (24, 7, 4), (22, 9, 4), (32, 15, 6), (20, 22, 6), (32, 31, 8)]
    {
        let format = OctAngleFormat::new(oct, angle).unwrap();
        assert_eq!((format.bits(), format.code_size()), (oct + angle + 1, size));
        for precise in [false, true] {
            let one = |frame: &Frame| match precise {
                false => format.encode(*frame),
                true => format.encode_precise(*frame),
            };
            let codes: Vec<u64> = frames.iter().map(one).collect();
            let expected: Vec<u8> =
                codes.iter().flat_map(|code| code.to_le_bytes()[..size].to_vec()).collect();
            let mut bytes = vec![0xEE; size * frames.len()];
            if precise {
                format.encode_soa_precise(soa(&columns), &mut bytes).unwrap();
            } else {
                format.encode_soa(soa(&columns), &mut bytes).unwrap();
            }
            assert_eq!(bytes, expected);
            let mut decoded = [0; 7].map(|_| vec![9.0; frames.len()]);
            format.decode_soa(&bytes, soa_mut(&mut decoded)).unwrap();
            for (i, (&code, frame)) in codes.iter().zip(&frames).enumerate() {
                let one = format.decode(code);
                assert_eq!(
                    [0, 1, 2, 3, 4, 5, 6].map(|c: usize| decoded[c][i].to_bits()),
                    bits(one)
                );
                assert!(format.is_canonical(code) && code >> (format.bits() - 1) <= 1);
                assert_eq!(one.handedness < 0.0, frame.handedness < 0.0);
                if angle < 24 {
                    assert_eq!(format.encode(one), code);
                }
                let (u, v, turn, negative) = format.parameters(code);
                assert_eq!(format.from_parameters(u, v, turn, negative), code);
            }
            let other = match (oct, angle) {
                (22, 9) => frames.iter().map(|f| OctAngle32::encode(*f).into()).collect(),
                (32, 31) => frames.iter().map(|f| OctAngle64::encode(*f)).collect(),
                _ => codes.clone(),
            };
            assert!(precise || codes == other);
        }
    }
    let [b1, b2] = basis([0.0, 0.0, -3.0]);
    assert_eq!((b1, b2), ([1.0, 0.0, 0.0], [0.0, -1.0, 0.0]));
}

fn refused<T: Debug + PartialEq>(
    outcome: Result<T, LengthMismatch>,
    error: LengthMismatch,
    words: &str,
) {
    assert_eq!((outcome, error.to_string().as_str()), (Err(error), words));
}

#[test]
fn frames_of_other_lengths_are_refused() {
    for differs in 0..8 {
        let mut lengths = [9; 8];
        lengths[differs] = 8;
        let [a, b, c, d, e, f, handedness, codes] = lengths;
        let error =
            LengthMismatch::FrameSoa { normal: [a, b, c], tangent: [d, e, f], handedness, codes };
        let words = format!(
            "lengths differ: normal x {a}, y {b}, z {c}, tangent x {d}, y {e}, z {f}, handedness \
             {handedness}, codes {codes}"
        );
        let mut columns = [a, b, c, d, e, f, handedness].map(|len| vec![0.5; len]);
        let mut codes = vec![0u32; codes];
        refused(OctAngle32::encode_soa(soa(&columns), &mut codes), error, &words);
        refused(OctAngle32::decode_soa(&codes, soa_mut(&mut columns)), error, &words);
    }
    for [normals, tangents, codes] in [[8, 9, 9], [9, 8, 9], [9, 9, 8]] {
        let error = LengthMismatch::FrameAos { normals, tangents, codes };
        let words =
            format!("lengths differ: normals {normals}, tangents {tangents}, codes {codes}");
        let (mut n, mut t) = (vec![[0.5; 3]; normals], vec![[0.5; 4]; tangents]);
        let mut codes = vec![0u32; codes];
        refused(OctAngle32::encode_aos(&n, &t, &mut codes), error, &words);
        refused(OctAngle32::decode_aos(&codes, &mut n, &mut t), error, &words);
    }
}
