//! Frames whose bits are split at run time, against `f64`: the formulas of `frame`'s page, written again.

use std::f64::consts::{PI, TAU};

use unitpack::frame::{Frame, FrameCodec, OctAngle32, OctAngle64, OctAngleFormat, Skew, basis};
use unitpack::{Codec, LengthMismatch, Oct16, Oct24, StrideMismatch, Strided, StridedMut};
use unitpack_test::frames::{
    basis as exact_basis, columns, direction, oct_angle, part_across, soa, soa_mut, vectors,
};
use unitpack_test::random::{Rng, special_vectors};
use unitpack_test::vectors::{angle, cross, dot, length, normalize, plus, scaled, widen};

/// What rounding to `f32` may add to an angle, in radians.
const ROUNDING: f64 = 7e-7;

/// Bits of angle that encoders give, at most. Of 2e8 codes with 31 bits none came back off by more than 111 of 2^31, and half
/// a step of 22 bits is 256.
const GIVEN_ANGLE_BITS: u32 = 22;

fn format(oct_bits: u32, angle_bits: u32) -> OctAngleFormat {
    OctAngleFormat::new(oct_bits, angle_bits).unwrap()
}

/// Every split that there is.
fn splits() -> impl Iterator<Item = OctAngleFormat> {
    (0..40).flat_map(|oct| (0..40).filter_map(move |angle| OctAngleFormat::new(oct, angle)))
}

/// Those of every size of a code, of angles with one word, two words and parts of both, and published ones.
const SOME: [[u32; 2]; 16] = [
    [8, 7],
    [14, 1],
    [8, 12],
    [12, 10],
    [22, 9],
    [24, 7],
    [16, 15],
    [8, 31],
    [24, 15],
    [30, 2],
    [32, 1],
    [32, 15],
    [20, 22],
    [24, 24],
    [28, 27],
    [32, 31],
];

fn some() -> impl Iterator<Item = OctAngleFormat> {
    SOME.into_iter().map(|[oct, angle]| format(oct, angle))
}

fn bits(frame: Frame) -> [u32; 7] {
    let [[a, b, c], [d, e, f]] = [frame.normal, frame.tangent];
    [a, b, c, d, e, f, frame.handedness].map(f32::to_bits)
}

fn uniform(rng: &mut Rng) -> Frame {
    let normal = rng.direction();
    let [a, b] = exact_basis(normalize(widen(normal)));
    let (sin, cos) = (rng.unit() * TAU).sin_cos();
    let tangent = plus(scaled(a, cos), scaled(b, sin)).map(|c| c as f32);
    Frame { normal, tangent, handedness: rng.pick(&[1.0, -1.0]) }
}

/// Uniform, hard to round, special, parallel, or half way between two angles.
fn any_frame(format: OctAngleFormat, rng: &mut Rng) -> Frame {
    let special = [0.0, f32::NAN, f32::INFINITY, 1e-45, -1.0, f32::MAX];
    let mut frame = match rng.below(6) {
        0 => Frame { normal: rng.edge(), tangent: rng.edge(), handedness: rng.pick(&special) },
        1 => {
            let v = rng.edge();
            Frame { normal: v, tangent: v.map(|c| -3.0 * c), handedness: rng.pick(&special) }
        }
        2 => {
            let mut v = || [(); 3].map(|()| rng.pick(&special));
            Frame { normal: v(), tangent: v(), handedness: 1.0 }
        }
        _ => uniform(rng),
    };
    if rng.below(4) == 0 {
        let normal = format.decode(format.encode(frame)).normal;
        let steps = 1u64 << format.angle_bits();
        let turns = (rng.below(steps) as f64 + 0.5) / steps as f64;
        let (sin, cos) = (turns * TAU).sin_cos();
        let [a, b] = exact_basis(normalize(widen(normal)));
        frame.normal = normal;
        frame.tangent = plus(scaled(a, cos), scaled(b, sin)).map(|c| c as f32);
    }
    frame
}

fn any_code(rng: &mut Rng) -> u64 {
    const TURNS: [u8; 7] = [0x00, 0x01, 0x7F, 0x80, 0x81, 0xFE, 0xFF];
    let uniform = rng.below(2) == 0;
    let byte = |_| if uniform { rng.bits() as u8 } else { rng.pick(&TURNS) };
    u64::from_le_bytes([0; 8].map(byte))
}

/// What a code means, of which higher bits say nothing.
fn check_decoded(format: OctAngleFormat, code: u64) {
    let frame = format.decode(code);
    let of = format!("{format:?} {code:x}: {frame:?}");
    let (normal, tangent) = oct_angle(code, format.oct_bits() / 2, format.angle_bits());
    for (got, exact) in [(frame.normal, normal), (frame.tangent, tangent)] {
        let got = widen(got);
        assert!(length(plus(got, scaled(exact, -1.0))) < 6e-7, "{of}, not {exact:?}");
        assert!((length(got) - 1.0).abs() <= 2.5e-7, "{of}");
    }
    assert!(dot(widen(frame.normal), widen(frame.tangent)).abs() <= 5e-7, "{of}");
    let negative = code >> (format.bits() - 1) & 1 == 1;
    assert_eq!(frame.handedness, if negative { -1.0 } else { 1.0 }, "{of}");
    let negative_zero = |c: &f32| *c == 0.0 && c.is_sign_negative();
    assert!(!frame.normal.iter().chain(&frame.tangent).any(negative_zero), "{of}");
}

#[test]
fn every_code_of_short_splits_decodes_as_the_formula_says() {
    for [oct, angle] in [[8, 7], [10, 5], [12, 3], [14, 1], [8, 9], [16, 1]] {
        let format = format(oct, angle);
        for code in 0..1 << format.bits() {
            check_decoded(format, code);
        }
    }
}

#[test]
fn codes_of_all_splits_decode_as_the_formula_says() {
    let mut rng = Rng::new(1);
    let mut count = 0;
    for format in splits() {
        count += 1;
        for _ in 0..1_000 {
            check_decoded(format, any_code(&mut rng));
        }
    }
    // Of 13 times 31, those below 16 bits are missing.
    assert_eq!(count, 13 * 31 - 6 - 4 - 2);
}

#[test]
fn two_splits_are_the_codecs() {
    let (short, long) = (format(22, 9), format(32, 31));
    let mut rng = Rng::new(2);
    for _ in 0..200_000 {
        let frame = any_frame(short, &mut rng);
        assert_eq!(short.encode(frame), OctAngle32::encode(frame).into());
        assert_eq!(short.encode_precise(frame), OctAngle32::encode_precise(frame).into());
        assert_eq!(long.encode(frame), OctAngle64::encode(frame));
        assert_eq!(long.encode_precise(frame), OctAngle64::encode_precise(frame));
        let code = any_code(&mut rng);
        let low = code as u32;
        assert_eq!(bits(short.decode(code)), bits(OctAngle32::decode(low)));
        assert_eq!(short.canonical(code), OctAngle32::canonical(low).into());
        assert_eq!(bits(long.decode(code)), bits(OctAngle64::decode(code)));
        assert_eq!(long.canonical(code), OctAngle64::canonical(code));
    }
}

/// Normals are those of the oct format, but for the order of 24 bits.
#[test]
fn normals_are_octahedral_codes() {
    let mut rng = Rng::new(3);
    let (short, rgb) = (format(16, 15), format(24, 7));
    for _ in 0..100_000 {
        let v = rng.edge();
        let frame = Frame { normal: v, tangent: rng.edge(), handedness: 1.0 };
        assert_eq!(short.encode(frame) as u16, Oct16::encode(v));
        assert_eq!(short.encode_precise(frame) as u16, Oct16::encode_precise(v));
        for (code, oct) in [
            (rgb.encode(frame), Oct24::encode(v)),
            (rgb.encode_precise(frame), Oct24::encode_precise(v)),
        ] {
            let [u, w] = [0, 12].map(|at| ((code << (52 - at)) as i64 >> 52) as i32);
            let [red, green, blue] = oct.map(i32::from);
            assert_eq!([u, w], [red << 4 | green >> 4, (green & 15) << 8 | blue].map(|p| p - 2047));
            assert_eq!(rgb.decode(code).normal, Oct24::decode(oct));
        }
    }
}

#[test]
fn precise_normals_are_the_nearest() {
    let mut rng = Rng::new(4);
    for [oct, angle] in [[8, 7], [10, 11]] {
        let format = format(oct, angle);
        let all: Vec<[f64; 3]> =
            (0..1u64 << oct).map(|code| oct_angle(code, oct / 2, angle).0).collect();
        for _ in 0..3_000 {
            let frame = uniform(&mut rng);
            let own = normalize(widen(frame.normal));
            let nearest = all.iter().map(|v| unitpack_test::vectors::angle(own, *v));
            let least = nearest.fold(f64::INFINITY, f64::min);
            let got = format.decode(format.encode_precise(frame)).normal;
            assert!(angle_between(own, got) <= least + ROUNDING, "{frame:?}");
        }
    }
}

fn angle_between(a: [f64; 3], b: [f32; 3]) -> f64 {
    angle(a, widen(b))
}

#[test]
fn errors_keep_their_bounds() {
    let mut rng = Rng::new(5);
    for format in splits() {
        let mut greatest = [[0.0f64; 2]; 2];
        let frames =
            if SOME.contains(&[format.oct_bits(), format.angle_bits()]) { 50_000 } else { 1_000 };
        for _ in 0..frames {
            let frame = uniform(&mut rng);
            let codes = [format.encode(frame), format.encode_precise(frame)];
            for (code, greatest) in codes.into_iter().zip(&mut greatest) {
                let decoded = format.decode(code);
                let (normal, tangent) = vectors(frame);
                let errors = [(normal, decoded.normal), (tangent, decoded.tangent)];
                for ((own, got), greatest) in errors.into_iter().zip(greatest) {
                    *greatest = greatest.max(angle_between(own, got).to_degrees());
                }
            }
        }
        let bounds = [
            [format.max_normal_error_degrees(), format.max_tangent_error_degrees()],
            [format.max_normal_error_precise_degrees(), format.max_tangent_error_precise_degrees()],
        ];
        for (got, bound) in greatest.as_flattened().iter().zip(bounds.as_flattened()) {
            assert!(got <= bound, "{format:?}: {greatest:?}, not {bounds:?}");
            assert!(frames < 50_000 || *got > 0.65 * bound, "{format:?}: {greatest:?}, {bounds:?}");
        }
    }
}

/// The tangent is the nearest for its normal, the handedness a bit, and nothing is set above.
#[test]
fn tangents_are_nearest_and_signs_survive() {
    let mut rng = Rng::new(6);
    for format in some() {
        let half_step = PI / (1u64 << format.angle_bits().min(GIVEN_ANGLE_BITS)) as f64;
        let mut greatest = 0.0f64;
        for _ in 0..30_000 {
            let frame = any_frame(format, &mut rng);
            for code in [format.encode(frame), format.encode_precise(frame)] {
                let of = format!("{format:?} {frame:?} = {code:x}");
                assert_eq!(code >> (format.bits() - 1), (frame.handedness < 0.0).into(), "{of}");
                assert!(format.is_canonical(code), "{of}");
                let (about, tangent) = vectors(format.decode(code));
                let Some(target) = part_across(frame, about) else {
                    let own = direction(frame.normal).unwrap_or([0.0, 0.0, 1.0]);
                    let sine = direction(frame.tangent).map_or(0.0, |t| length(cross(own, t)));
                    let angle = format.parameters(code).2;
                    assert!(sine >= 5e-7 || angle == 0, "{of}");
                    continue;
                };
                if length(target) > 1e-5 {
                    let slack = ROUNDING * (1.0 + 1.0 / length(target));
                    let error = angle(target, tangent);
                    assert!(error <= half_step + slack, "{of}: {error:e}");
                    greatest = greatest.max((error - slack) / half_step);
                }
            }
        }
        let sees_ties = format.angle_bits() <= 10;
        assert!(!sees_ties || greatest > 0.999, "{format:?}: ties were missed, {greatest}");
    }
}

/// By how many steps an angle is off, from the other, in the circle.
fn steps_apart(a: u32, b: u32, angle_bits: u32) -> u32 {
    let top = 32 - angle_bits;
    ((a << top).wrapping_sub(b << top) as i32 >> top).unsigned_abs()
}

#[test]
fn decoded_frames_are_encoded_as_they_were() {
    let mut rng = Rng::new(7);
    for format in splits() {
        let angle_bits = format.angle_bits();
        let step = 1 << angle_bits.saturating_sub(GIVEN_ANGLE_BITS);
        let codes = if (22..26).contains(&angle_bits) { 50_000 } else { 2_000 };
        for _ in 0..codes {
            let code = any_code(&mut rng);
            let canonical = format.canonical(code);
            assert_eq!(format.canonical(canonical), canonical);
            let [(u, v, a, sign), (cu, cv, ca, csign)] =
                [code, canonical].map(|code| format.parameters(code));
            // The nearest of the angles that are given.
            assert_eq!((ca % step, csign), (0, sign), "{format:?} {code:x}");
            assert!(steps_apart(a, ca, angle_bits) <= step / 2, "{format:?} {code:x}");
            let frame = format.decode(canonical);
            if step == 1 {
                assert_eq!(bits(frame), bits(format.decode(code)), "{format:?} {code:x}");
            }
            assert_eq!(format.from_parameters(cu, cv, ca, csign), canonical);
            assert!(
                (u, v) == (cu, cv)
                    || format.canonical(format.from_parameters(u, v, a, sign)) == canonical
            );
            for again in [format.encode(frame), format.encode_precise(frame)] {
                assert_eq!(again, canonical, "{format:?} {code:x}");
            }
        }
    }
}

#[test]
fn every_code_of_short_splits_comes_back() {
    for [oct, angle] in [[8, 7], [12, 3], [14, 1], [8, 9]] {
        let format = format(oct, angle);
        let mut count = 0u32;
        for code in 0..1 << format.bits() {
            let frame = format.decode(code);
            let canonical = format.canonical(code);
            assert_eq!(format.encode(frame), canonical, "{format:?} {code:x}");
            assert_eq!(format.encode_precise(frame), canonical, "{format:?} {code:x}");
            assert_eq!(format.is_canonical(code), code == canonical);
            assert_eq!(format.canonical(code | u64::MAX << format.bits()), canonical);
            count += u32::from(code == canonical);
        }
        // Points of the octahedron: 4 M^2 + 2, for each angle and sign.
        let m = (1 << (oct / 2 - 1)) - 1;
        assert_eq!(count, (4 * m * m + 2) << (angle + 1));
    }
}

#[test]
fn codes_are_their_parameters() {
    let mut rng = Rng::new(8);
    for format in splits() {
        let (oct, angle_bits) = (format.oct_bits(), format.angle_bits());
        let half = oct / 2;
        let max = (1i64 << (half - 1)) - 1;
        for _ in 0..300 {
            let [u, v] = [(); 2].map(|()| match rng.below(3) {
                0 => rng.bits() as i32,
                1 => rng.pick(&[i32::MIN, i32::MAX, 0, -1]),
                _ => (rng.below(2 * max as u64 + 5) as i64 - max - 2) as i32,
            });
            let (angle, negative) = (rng.bits() as u32, rng.below(2) == 1);
            let code = format.from_parameters(u, v, angle, negative);
            let [u, v] = [u, v].map(|p| i64::from(p).clamp(-max, max));
            let angle = u64::from(angle) % (1 << angle_bits);
            let [low, high] = [u, v].map(|p| p as u64 % (1 << half));
            let oct_code = low | high << half;
            let expected = oct_code | angle << oct | u64::from(negative) << (oct + angle_bits);
            assert_eq!(code, expected, "{format:?}");
            assert_eq!(format.parameters(code), (u as i32, v as i32, angle as u32, negative));

            let code = any_code(&mut rng);
            let (u, v, angle, negative) = format.parameters(code);
            let again = format.from_parameters(u, v, angle, negative);
            assert_eq!(format.canonical(again), format.canonical(code), "{format:?} {code:x}");
            assert_eq!(format.parameters(again), (u, v, angle, negative));
            // All that differs is what reads as the least.
            assert!([u, v].iter().all(|p| i64::from(*p).abs() <= max));
        }
    }
}

#[test]
fn angles_are_counted_around_the_public_basis() {
    let mut rng = Rng::new(9);
    for format in some() {
        for _ in 0..5_000 {
            let code = any_code(&mut rng);
            let frame = format.decode(code);
            let [b1, b2] = basis(frame.normal).map(widen);
            let turns = f64::from(format.parameters(code).2) / (1u64 << format.angle_bits()) as f64;
            let (sin, cos) = (turns * TAU).sin_cos();
            let tangent = plus(scaled(b1, cos), scaled(b2, sin));
            assert!(length(plus(tangent, scaled(widen(frame.tangent), -1.0))) < 6e-7, "{code:x}");
        }
    }
}

#[test]
fn the_basis_is_orthonormal_for_any_vector() {
    let mut rng = Rng::new(10);
    let mut given = special_vectors();
    given.extend([[0.0, 1.0, -0.0], [-0.0; 3], [f32::NAN; 3], [f32::MAX; 3], [1e-45, 0.0, -1e-45]]);
    given.extend((0..100_000).map(|i| if i % 2 == 0 { rng.edge() } else { rng.direction() }));
    for v in given {
        let own = direction(v).unwrap_or([0.0, 0.0, 1.0]);
        let [b1, b2] = basis(v).map(widen);
        for b in [b1, b2] {
            assert!((length(b) - 1.0).abs() < 2e-6, "{v:?}: {b:?}");
            assert!(dot(b, own).abs() < 2e-6, "{v:?}: {b:?}");
        }
        assert!(length(plus(cross(b1, b2), scaled(own, -1.0))) < 3e-6, "{v:?}: {b1:?} {b2:?}");
        // Across the seam there is another.
        if own[2] == 0.0 || own[2].abs() > 1e-30 {
            let exact = exact_basis(own);
            for (got, exact) in [b1, b2].into_iter().zip(exact) {
                assert!(length(plus(got, scaled(exact, -1.0))) < 4e-6, "{v:?}: {got:?}");
            }
        }
    }
}

#[test]
fn axes_survive_exactly() {
    let axes: Vec<[f32; 3]> = [0, 1, 2]
        .into_iter()
        .flat_map(|i| [1.0, -1.0].map(|c| [0, 1, 2].map(|j| if i == j { c } else { 0.0 })))
        .collect();
    for format in splits().filter(|format| format.angle_bits() >= 2) {
        for &normal in &axes {
            for &tangent in axes.iter().filter(|t| dot(widen(**t), widen(normal)) == 0.0) {
                for handedness in [1.0, -1.0] {
                    let frame = Frame { normal, tangent, handedness };
                    assert_eq!(format.decode(format.encode(frame)), frame, "{format:?}");
                    assert_eq!(format.decode(format.encode_precise(frame)), frame, "{format:?}");
                }
            }
        }
    }
}

fn to_bytes(codes: &[u64], size: usize) -> Vec<u8> {
    codes.iter().flat_map(|code| code.to_le_bytes()[..size].to_vec()).collect()
}

#[test]
fn batches_give_the_bits_of_single_frames() {
    let mut rng = Rng::new(11);
    for format in some() {
        let size = format.code_size();
        let kept = u64::MAX >> (64 - 8 * size);
        for len in (0..36).chain([257, 300]) {
            let frames: Vec<Frame> = (0..len).map(|_| any_frame(format, &mut rng)).collect();
            let skews: Vec<f32> = frames.iter().map(|f| f.skew_degrees()).collect();
            let check = |skew: Skew| {
                assert_eq!(skew.degrees, skews.iter().copied().fold(0.0, f32::max));
                assert_eq!(skew.degrees, skews.get(skew.index).copied().unwrap_or(0.0));
            };
            let singles = |encode: fn(OctAngleFormat, Frame) -> u64| -> Vec<u8> {
                let codes: Vec<u64> = frames.iter().map(|frame| encode(format, *frame)).collect();
                to_bytes(&codes, size)
            };
            let columns = columns(&frames);
            // One byte in front, so that nothing is aligned.
            let mut bytes = vec![0xEE; size * len + 1];
            check(format.encode_soa(soa(&columns), &mut bytes[1..]).unwrap());
            assert_eq!(bytes[1..], singles(OctAngleFormat::encode));
            check(format.encode_soa_precise(soa(&columns), &mut bytes[1..]).unwrap());
            assert_eq!(bytes[1..], singles(OctAngleFormat::encode_precise));

            let normals: Vec<[f32; 3]> = frames.iter().map(|f| f.normal).collect();
            let tangents: Vec<[f32; 4]> = frames
                .iter()
                .map(|Frame { tangent: [x, y, z], handedness, .. }| [*x, *y, *z, *handedness])
                .collect();
            let read = || (Strided::of(&normals, 0), Strided::of(&tangents, 0));
            for (stride, precise) in [(size, false), (size, true), (size + 3, false), (11, true)] {
                let mut bytes = vec![0xEE; stride * len + 5];
                let codes = StridedMut { bytes: &mut bytes, offset: 2, stride, len };
                let (normals, tangents) = read();
                let expected = if precise {
                    check(format.encode_strided_precise(normals, tangents, codes).unwrap());
                    singles(OctAngleFormat::encode_precise)
                } else {
                    check(format.encode_strided(normals, tangents, codes).unwrap());
                    singles(OctAngleFormat::encode)
                };
                for (i, byte) in bytes.iter().enumerate() {
                    let (row, at) = (i.wrapping_sub(2) / stride, i.wrapping_sub(2) % stride);
                    let is_code = i >= 2 && row < len && at < size;
                    let wanted = if is_code { expected[row * size + at] } else { 0xEE };
                    assert_eq!(*byte, wanted, "{format:?} at {i}");
                }
            }

            let codes: Vec<u64> = (0..len).map(|_| any_code(&mut rng) & kept).collect();
            let bytes = to_bytes(&codes, size);
            let expected: Vec<[u32; 7]> =
                codes.iter().map(|code| bits(format.decode(*code))).collect();
            let mut decoded = [0; 7].map(|_| vec![9.0f32; len]);
            format.decode_soa(&bytes, soa_mut(&mut decoded)).unwrap();
            for (i, expected) in expected.iter().enumerate() {
                let got = [0, 1, 2, 3, 4, 5, 6].map(|c: usize| decoded[c][i].to_bits());
                assert_eq!(got, *expected, "{format:?} {:x}", codes[i]);
            }
            let from = || Strided { bytes: &bytes, offset: 0, stride: size, len };
            let (mut normals, mut tangents) = (vec![[9.0f32; 3]; len], vec![[9.0f32; 5]; len]);
            let to = (StridedMut::of(&mut normals, 0), StridedMut::of(&mut tangents, 4));
            format.decode_strided(from(), to.0, to.1).unwrap();
            let mut vertices = vec![[9.0f32; 9]; len];
            format.decode_vertices(from(), StridedMut::of(&mut vertices, 24), 4).unwrap();
            for (i, expected) in expected.iter().enumerate() {
                let ([a, b, c], [kept, x, y, z, w]) = (normals[i], tangents[i]);
                assert_eq!([a, b, c, x, y, z, w].map(f32::to_bits), *expected);
                assert_eq!(kept, 9.0);
                let [first, x, y, z, w, other, a, b, c] = vertices[i];
                assert_eq!([a, b, c, x, y, z, w].map(f32::to_bits), *expected);
                assert_eq!([first, other], [9.0; 2]);
            }
        }
    }
}

/// A buffer that encoders wrote keeps its bytes.
#[test]
fn decoded_buffers_are_encoded_to_the_same_bytes() {
    let mut rng = Rng::new(12);
    for format in some() {
        let frames: Vec<Frame> = (0..2_000).map(|_| any_frame(format, &mut rng)).collect();
        let mut bytes = vec![0; frames.len() * format.code_size()];
        format.encode_soa(soa(&columns(&frames)), &mut bytes).unwrap();
        let mut decoded = [0; 7].map(|_| vec![0.0; frames.len()]);
        format.decode_soa(&bytes, soa_mut(&mut decoded)).unwrap();
        let mut again = vec![0; bytes.len()];
        format.encode_soa(soa(&decoded), &mut again).unwrap();
        assert_eq!(again, bytes);
        format.encode_soa_precise(soa(&decoded), &mut again).unwrap();
        assert_eq!(again, bytes);
    }
}

#[test]
fn frames_of_other_lengths_are_refused() {
    for format in [format(8, 7), format(32, 15)] {
        let code_size = format.code_size();
        for differs in 0..8 {
            for other in [2, 4] {
                let mut lengths = [3; 8];
                lengths[differs] = other;
                let [a, b, c, d, e, f, handedness, codes] = lengths;
                let bytes = codes * code_size;
                let error = LengthMismatch::FrameBytes {
                    normal: [a, b, c],
                    tangent: [d, e, f],
                    handedness,
                    bytes,
                    code_size,
                };
                assert_eq!(
                    error.to_string(),
                    format!(
                        "lengths do not fit: normal x {a}, y {b}, z {c}, tangent x {d}, y {e}, z {f}, \
                         handedness {handedness}, bytes {bytes} at {code_size} a code"
                    )
                );
                let mut columns = [a, b, c, d, e, f, handedness].map(|len| vec![0.5; len]);
                let before = columns.clone();
                let mut out = vec![0xEE; bytes];
                assert_eq!(format.encode_soa(soa(&columns), &mut out), Err(error));
                assert_eq!(format.encode_soa_precise(soa(&columns), &mut out), Err(error));
                assert_eq!(out, vec![0xEE; bytes]);
                assert_eq!(format.decode_soa(&out, soa_mut(&mut columns)), Err(error));
                assert_eq!(columns, before);
            }
        }
        let columns = [0; 7].map(|_| vec![0.5; 3]);
        assert!(format.encode_soa(soa(&columns), &mut vec![0; 3 * code_size + 1]).is_err());

        let (normals, tangents) = ([[0.5f32; 3]; 4], [[0.5f32; 4]; 3]);
        let (n, t) = (Strided::of(&normals, 0), Strided::of(&tangents, 0));
        let mut bytes = [0xEE; 64];
        let error = StrideMismatch::Frames { normals: 4, tangents: 3, codes: 3 };
        fn codes(bytes: &mut [u8], stride: usize) -> StridedMut<'_> {
            StridedMut { bytes, offset: 0, stride, len: 3 }
        }
        assert_eq!(format.encode_strided(n, t, codes(&mut bytes, code_size)), Err(error));
        assert_eq!(format.encode_strided_precise(n, t, codes(&mut bytes, code_size)), Err(error));
        let n = Strided { len: 3, ..n };
        let close = codes(&mut bytes, code_size - 1);
        let error = StrideMismatch::Stride {
            offset: 0,
            stride: code_size - 1,
            len: 3,
            size: code_size,
            bytes: 64,
        };
        assert_eq!(format.encode_strided(n, t, close), Err(error));
        assert_eq!(bytes, [0xEE; 64]);
    }
}
