//! Tangent frames, against `f64`: the formulas of `frame`'s page and of Kapoulkine's scheme, written again.

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use bytemuck::Zeroable;

use unitpack::frame::{Frame, FrameCodec, OctAngle32, OctAngle64, QTangent64, Skew};
use unitpack::{Codec, LengthMismatch, Oct22, Oct32};
use unitpack_test::frames::*;
use unitpack_test::random::{Rng, special_vectors};
use unitpack_test::vectors::{angle, cross, dot, length, normalize, plus, scaled, widen};

/// What rounding to `f32` may add to an angle, in radians.
const ROUNDING: f64 = 7e-7;

static SPECIAL: LazyLock<Vec<[f32; 3]>> = LazyLock::new(special_vectors);

/// Calls a function for every codec.
macro_rules! codecs {
    ($check:ident) => {
        $check::<OctAngle32>();
        $check::<OctAngle64>();
        $check::<QTangent64>();
    };
}

/// A normal and a tangent across it, uniform, rounded to `f32`.
fn uniform(rng: &mut Rng) -> Frame {
    let normal = rng.direction();
    let [a, b] = basis(normalize(widen(normal)));
    let (sin, cos) = (rng.unit() * TAU).sin_cos();
    let tangent = plus(scaled(a, cos), scaled(b, sin)).map(|c| c as f32);
    Frame { normal, tangent, handedness: rng.pick(&[1.0, -1.0]) }
}

/// Frames at which rounding, selection and prepared inputs are hard; mostly not orthogonal.
fn awkward(rng: &mut Rng) -> Frame {
    let signs = [1.0, -1.0, 0.0, -0.0, 5.0, -1e-45, f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let mut frame = Frame { normal: rng.edge(), tangent: rng.edge(), handedness: rng.pick(&signs) };
    match rng.below(6) {
        // Parallel, or hardly not.
        0 => {
            let scale = rng.pick(&[1.0, -1.0, 3.0, -1e-3]);
            frame.tangent = frame.normal.map(|c| c * scale);
            if rng.below(2) == 0 {
                frame.tangent[rng.below(3) as usize] += rng.pick(&[1e-3, 1e-5, 1e-2]) * scale;
            }
        }
        // Across, in the plane of an axis.
        1 => {
            let [x, y, z] = frame.normal;
            frame.tangent = rng.pick(&[[-y, x, 0.0], [0.0, z, -y], [z, 0.0, -x]]);
        }
        // Half way between two codes of the angle.
        2 => {
            let normal = OctAngle32::decode(OctAngle32::encode(frame)).normal;
            let (sin, cos) = ((rng.below(512) as f64 + 0.5) / 512.0 * TAU).sin_cos();
            let [a, b] = basis(normalize(widen(normal)));
            frame.normal = normal;
            frame.tangent = plus(scaled(a, cos), scaled(b, sin)).map(|c| c as f32);
        }
        3 => {
            frame.normal = rng.pick(&SPECIAL);
            frame.tangent = if rng.below(2) == 0 { rng.pick(&SPECIAL) } else { frame.tangent };
        }
        _ => {}
    }
    frame
}

fn bits(frame: Frame) -> [u32; 7] {
    let [[a, b, c], [d, e, f]] = [frame.normal, frame.tangent];
    [a, b, c, d, e, f, frame.handedness].map(f32::to_bits)
}

fn any_code<C: FrameCodec>(rng: &mut Rng) -> C::Code {
    const TURNS: [u8; 7] = [0x00, 0x01, 0x7F, 0x80, 0x81, 0xFE, 0xFF];
    let uniform = rng.below(2) == 0;
    let bytes = [0; 8].map(|_| if uniform { rng.bits() as u8 } else { rng.pick(&TURNS) });
    bytemuck::pod_read_unaligned(&bytes[..size_of::<C::Code>()])
}

fn check_decoded(frame: Frame, of: &str) {
    let (normal, tangent) = (widen(frame.normal), widen(frame.tangent));
    for v in [normal, tangent] {
        assert!((length(v) - 1.0).abs() <= 2.5e-7, "{of}: {frame:?}");
    }
    assert!(dot(normal, tangent).abs() <= 5e-7, "{of}: {frame:?} {:e}", dot(normal, tangent));
    assert!(frame.handedness == 1.0 || frame.handedness == -1.0, "{of}: {frame:?}");
    let negative_zero = |c: &f32| *c == 0.0 && c.is_sign_negative();
    assert!(!frame.normal.iter().chain(&frame.tangent).any(negative_zero), "{of}: {frame:?}");
    let bitangent = scaled(cross(normal, tangent), f64::from(frame.handedness));
    let error = length(plus(widen(frame.bitangent()), scaled(bitangent, -1.0)));
    assert!(error < 2e-7, "{of}: {frame:?}");
}

fn decodes_to_a_frame<C: FrameCodec>() {
    let mut rng = Rng::new(1);
    let mut least_across = 0.0f64;
    for _ in 0..400_000 {
        let code = any_code::<C>(&mut rng);
        let frame = C::decode(code);
        check_decoded(frame, &format!("{} {code:x?}", C::NAME));
        least_across = least_across.max(dot(widen(frame.normal), widen(frame.tangent)).abs());
    }
    eprintln!("{}: normal . tangent up to {least_across:.2e}", C::NAME);
}

#[test]
fn any_bit_pattern_decodes_to_an_orthonormal_frame() {
    codecs!(decodes_to_a_frame);
}

fn check_against(frame: Frame, (normal, tangent): ([f64; 3], [f64; 3]), of: &str) {
    let off = |a: [f32; 3], b: [f64; 3]| length(plus(widen(a), scaled(b, -1.0)));
    let errors = [off(frame.normal, normal), off(frame.tangent, tangent)];
    assert!(errors.iter().all(|e| *e < 6e-7), "{of}: {frame:?}, not {normal:?} {tangent:?}");
}

#[test]
fn codes_decode_as_their_formulas_say() {
    let mut rng = Rng::new(2);
    for _ in 0..300_000 {
        let code = any_code::<OctAngle32>(&mut rng);
        let frame = OctAngle32::decode(code);
        check_against(frame, oct_angle(code.into(), 11, 9), &format!("{code:x}"));
        assert_eq!(frame.normal, Oct22::decode(code));
        assert_eq!(frame.handedness, if code >> 31 == 1 { -1.0 } else { 1.0 });
        let code = any_code::<OctAngle64>(&mut rng);
        let frame = OctAngle64::decode(code);
        check_against(frame, oct_angle(code, 16, 31), &format!("{code:x}"));
        assert_eq!(frame.normal, Oct32::decode(code as u32));
        assert_eq!(frame.handedness, if code >> 63 == 1 { -1.0 } else { 1.0 });
        let code = any_code::<QTangent64>(&mut rng);
        let frame = QTangent64::decode(code);
        check_against(frame, quaternion(code), &format!("{code:?}"));
        assert_eq!(frame.handedness, if code[3] < 0 { -1.0 } else { 1.0 });
    }
}

/// Mean and greatest, in degrees.
#[derive(Default)]
struct Errors {
    sum: f64,
    count: u32,
    greatest: f64,
}

impl Errors {
    fn add(&mut self, radians: f64) {
        self.sum += radians.to_degrees();
        self.count += 1;
        self.greatest = self.greatest.max(radians.to_degrees());
    }

    fn mean(&self) -> f64 {
        self.sum / f64::from(self.count)
    }

    fn say(&self) -> String {
        format!("{:.6} / {:.6}", self.mean(), self.greatest)
    }
}

/// Errors of normal and tangent over uniform frames.
fn errors_of(seed: u64, code: impl Fn(Frame) -> ([f64; 3], [f64; 3])) -> [Errors; 2] {
    let mut rng = Rng::new(seed);
    let mut errors = <[Errors; 2]>::default();
    for _ in 0..1_000_000 {
        let frame = uniform(&mut rng);
        let (normal, tangent) = code(frame);
        errors[0].add(angle(widen(frame.normal), normal));
        errors[1].add(angle(widen(frame.tangent), tangent));
    }
    errors
}

/// Frames of which the quaternion lies half way between codes in all components, and in every second one
/// w is hardly above 0, but stored as 1.
fn between_quaternions(rng: &mut Rng) -> Frame {
    let mut direction = rng.direction();
    if rng.below(4) == 0 {
        // Near an axis, where the greatest component is all that a quaternion's length frees.
        for _ in 0..2 {
            direction.rotate_left(1);
            direction[0] *= 1e-3;
        }
    }
    let [x, y, z] = scaled(normalize(widen(direction)), 32766.0).map(|c| c.floor() + 0.5);
    let length = |v: [f64; 4]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let w = if rng.below(2) == 0 { 0.01 } else { rng.unit() * 32766.0 };
    let q = [x, y, z, w];
    let q = q.map(|c| (c * 32767.0 / length(q)).floor() + 0.5);
    let w = if w < 1.0 { w } else { q[3] };
    let [x, y, z, w] = [q[0], q[1], q[2], w].map(|c| c / length([q[0], q[1], q[2], w]));
    let normal = [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)];
    let tangent = [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)];
    Frame {
        normal: normal.map(|c| c as f32),
        tangent: tangent.map(|c| c as f32),
        handedness: rng.pick(&[1.0, -1.0]),
    }
}

#[test]
fn errors_of_quaternions_keep_their_bounds_where_they_are_greatest() {
    type C = QTangent64;
    for (encode, bounds) in [
        (C::encode as fn(Frame) -> _, [C::MAX_NORMAL_ERROR_DEGREES, C::MAX_TANGENT_ERROR_DEGREES]),
        (
            C::encode_precise,
            [C::MAX_NORMAL_ERROR_PRECISE_DEGREES, C::MAX_TANGENT_ERROR_PRECISE_DEGREES],
        ),
    ] {
        let mut rng = Rng::new(13);
        let mut errors = <[Errors; 2]>::default();
        for _ in 0..1_000_000 {
            let frame = between_quaternions(&mut rng);
            let (normal, tangent) = vectors(C::decode(encode(frame)));
            errors[0].add(angle(widen(frame.normal), normal));
            errors[1].add(angle(widen(frame.tangent), tangent));
        }
        eprintln!("qtangent64 at its worst: {}, {}", errors[0].say(), errors[1].say());
        for (errors, bound) in errors.iter().zip(bounds) {
            assert!(errors.greatest <= bound && errors.greatest >= 0.92 * bound);
        }
    }
}

fn errors_keep_their_bounds<C: FrameCodec>() {
    for (precise, encode) in [C::encode, C::encode_precise].into_iter().enumerate() {
        let [normal, tangent] = errors_of(3, |frame| vectors(C::decode(encode(frame))));
        let name = ["encode", "precise"][precise];
        eprintln!("{} {name}: normal {}, tangent {}", C::NAME, normal.say(), tangent.say());
        let bound = [
            [C::MAX_NORMAL_ERROR_DEGREES, C::MAX_TANGENT_ERROR_DEGREES],
            [C::MAX_NORMAL_ERROR_PRECISE_DEGREES, C::MAX_TANGENT_ERROR_PRECISE_DEGREES],
        ][precise];
        for (errors, bound) in [(normal, bound[0]), (tangent, bound[1])] {
            assert!(errors.greatest <= bound, "{} {name}: {}", C::NAME, errors.greatest);
            assert!(errors.greatest >= 0.65 * bound, "{} {name}: {}", C::NAME, errors.greatest);
        }
    }
}

#[test]
fn errors_of_uniform_frames_keep_their_bounds() {
    codecs!(errors_keep_their_bounds);
}

/// Kapoulkine's oct11x2 + d9: each parameter rounded, and the tangent on a diamond's rim.
fn kapoulkine(frame: Frame) -> ([f64; 3], [f64; 3]) {
    let (normal, tangent) = vectors(frame);
    let sum = normal.iter().map(|c| c.abs()).sum::<f64>();
    let [x, y, z] = scaled(normal, 1.0 / sum);
    let (u, w) =
        if z < 0.0 { ((1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)) } else { (x, y) };
    let [u, w] = [u, w].map(|c| ((c * 1023.0).round() as i64 & 0x7FF) as u64);
    let (normal, _) = oct_angle(u | w << 11, 11, 9);
    let plane = basis(normal);
    let [a, b] = [dot(tangent, plane[0]), dot(tangent, plane[1])];
    // From 0 to 4 around the diamond.
    let along = b / (a.abs() + b.abs());
    let at = if a < 0.0 { 2.0 - along } else { along };
    let at = ((at * 128.0).round() / 128.0).rem_euclid(4.0);
    let quarter = at.floor();
    let (sin, cos) = ((at - quarter), 1.0 - (at - quarter));
    let [c, s] = [[cos, sin], [-sin, cos], [-cos, -sin], [sin, -cos]][quarter as usize % 4];
    (normal, normalize(plus(scaled(plane[0], c), scaled(plane[1], s))))
}

#[test]
fn no_worse_than_the_published_scheme_on_uniform_frames() {
    let theirs = errors_of(4, kapoulkine);
    let fast = errors_of(4, |frame| vectors(OctAngle32::decode(OctAngle32::encode(frame))));
    let precise =
        errors_of(4, |frame| vectors(OctAngle32::decode(OctAngle32::encode_precise(frame))));
    for (name, errors) in [("oct11x2 + d9", &theirs), ("octangle32", &fast), ("precise", &precise)]
    {
        eprintln!("{name}: normal {}, tangent {}", errors[0].say(), errors[1].say());
    }
    for (theirs, (fast, precise)) in theirs.iter().zip(fast.iter().zip(&precise)) {
        // The same rounding of normals, where f32 decides ties another way than f64.
        assert!(fast.mean() <= theirs.mean() * 1.0001);
        assert!(fast.greatest <= theirs.greatest * 1.0001);
        assert!(precise.mean() < theirs.mean() && precise.greatest < theirs.greatest);
    }
    assert!(fast[1].mean() < 0.98 * theirs[1].mean());
    assert!(fast[1].greatest < 0.85 * theirs[1].greatest);
    // Published, of a mesh: the greatest errors of the normal, of which no mesh has more.
    assert!(precise[0].greatest < 0.0816 && precise[1].greatest < 0.4485);
}

/// The normal is the crate's own code, the tangent the nearest of the plane, the handedness a bit.
fn check_oct_angle<C: FrameCodec, N: Codec>(angle_bits: u32, wide: fn(C::Code) -> u64)
where
    N::Code: Into<u64>,
{
    let mut rng = Rng::new(5);
    // Encoders give 22 bits of longer angles.
    let half_step = PI / (1u64 << angle_bits.min(22)) as f64;
    let (mut greatest, mut parallel) = (0.0f64, 0);
    for i in 0..400_000 {
        let frame = if i % 2 == 0 { awkward(&mut rng) } else { uniform(&mut rng) };
        let normals = [N::encode(frame.normal), N::encode_precise(frame.normal)].map(N::Code::into);
        for (code, normal) in [C::encode(frame), C::encode_precise(frame)].into_iter().zip(normals)
        {
            let of = format!("{} {frame:?} = {code:x?}", C::NAME);
            let code_bits = wide(code);
            let normal_bits = C::BITS - 1 - angle_bits;
            assert_eq!(code_bits & ((1 << normal_bits) - 1), normal, "{of}");
            assert_eq!(code_bits >> (C::BITS - 1) == 1, frame.handedness < 0.0, "{of}");
            assert!(C::is_canonical(code), "{of}");
            let decoded = C::decode(code);
            let (about, tangent) = vectors(decoded);
            let Some(target) = part_across(frame, about) else {
                // No direction, or none across.
                let own = direction(frame.normal).unwrap_or([0.0, 0.0, 1.0]);
                let sine = direction(frame.tangent).map_or(0.0, |t| length(cross(own, t)));
                if sine < 5e-7 {
                    assert_eq!(code_bits >> normal_bits & ((1 << angle_bits) - 1), 0, "{of}");
                    parallel += 1;
                }
                continue;
            };
            // What rounding moves a short part by.
            let slack = ROUNDING * (1.0 + 1.0 / length(target));
            // However skewed the frame is, no more than the codec's bound.
            let own = direction(frame.normal).unwrap_or([0.0, 0.0, 1.0]);
            let whole = angle(part_across(frame, own).unwrap(), tangent);
            assert!(whole <= C::MAX_TANGENT_ERROR_DEGREES.to_radians() + slack, "{of}: {whole:e}");
            if length(target) > 1e-5 {
                let error = angle(target, tangent);
                assert!(error <= half_step + slack, "{of}: {error:e}");
                greatest = greatest.max((error - slack) / half_step);
            }
        }
    }
    assert!(parallel > 10_000, "{parallel}");
    assert!(angle_bits > 20 || greatest > 0.999, "{greatest}: the ties were missed");
}

#[test]
fn normals_are_octahedral_codes_and_tangents_nearest() {
    check_oct_angle::<OctAngle32, Oct22>(9, u64::from);
    check_oct_angle::<OctAngle64, Oct32>(31, |code| code);
}

#[test]
fn every_angle_comes_back_about_every_kind_of_normal() {
    let mut rng = Rng::new(6);
    let corners = [0u32, 0x3FF, 0x401, 0x400, 0x200, 0x1FF, 1, 0x7FF];
    for i in 0..600 {
        let [u, w] = [0; 2].map(|_| match i {
            0..300 => rng.pick(&corners),
            _ => rng.bits() as u32 & 0x7FF,
        });
        for rest in 0..1 << 10 {
            let code = u | w << 11 | rest << 22;
            let canonical = Oct22::canonical(code & 0x3F_FFFF) | rest << 22;
            assert_eq!(OctAngle32::canonical(code), canonical, "{code:x}");
            assert_eq!(OctAngle32::encode_precise(OctAngle32::decode(code)), canonical, "{code:x}");
        }
    }
}

#[test]
fn wide_angles_are_given_to_what_floats_carry() {
    let mut rng = Rng::new(7);
    for i in 0..600_000 {
        let code = any_code::<OctAngle64>(&mut rng);
        let canonical = OctAngle64::canonical(code);
        // The nearest multiple of 512, ties to even, and a turn is none.
        let angle = (code >> 32 & 0x7FFF_FFFF) as f64 / 512.0;
        let angle = (angle.round_ties_even() as u64 * 512) & 0x7FFF_FFFF;
        let normal = u64::from(Oct32::canonical(code as u32));
        assert_eq!(canonical, normal | angle << 32 | code >> 63 << 63, "{code:x}");
        // Whatever was given comes back, always.
        let frame = if i % 2 == 0 { OctAngle64::decode(code) } else { awkward(&mut rng) };
        for encode in [OctAngle64::encode, OctAngle64::encode_precise] {
            let given = encode(frame);
            assert!(OctAngle64::is_canonical(given), "{frame:?}");
            for encode in [OctAngle64::encode, OctAngle64::encode_precise] {
                assert_eq!(encode(OctAngle64::decode(given)), given, "{frame:?}");
            }
        }
    }
}

/// Radians by which one frame's normal or tangent is off the other's, at most.
fn apart(a: Frame, b: Frame) -> f64 {
    angle(widen(a.normal), widen(b.normal)).max(angle(widen(a.tangent), widen(b.tangent)))
}

#[test]
fn quaternions_are_canonical_if_encoders_emit_them() {
    let mut rng = Rng::new(8);
    let (mut canonical, mut moved) = (0, 0);
    for i in 0..600_000 {
        let code = if i % 2 == 0 {
            any_code::<QTangent64>(&mut rng)
        } else {
            // Near the length 1.
            QTangent64::encode(awkward(&mut rng))
                .map(|c| c.saturating_add(rng.pick(&[0, 0, 1, -1, 2])).max(-32767))
        };
        let again = QTangent64::canonical(code);
        assert_eq!(QTangent64::is_canonical(code), code == again, "{code:?}");
        assert!(QTangent64::is_canonical(again), "{code:?}, {again:?}");
        let encoded = QTangent64::encode_precise(QTangent64::decode(code));
        // By definition: less than a step off the unit quaternion of the same direction.
        let off = off_unit(code);
        let in_range = code[3] != 0 && code.iter().all(|c| *c != i16::MIN);
        if in_range && off < 0.99 {
            assert!(QTangent64::is_canonical(code), "{code:?}");
        } else if !in_range || off > 1.02 {
            assert!(!QTangent64::is_canonical(code), "{code:?}");
        }
        if QTangent64::is_canonical(code) {
            canonical += 1;
            if encoded != code && off < 0.99 {
                // Only to one that decodes alike.
                let off = apart(QTangent64::decode(code), QTangent64::decode(encoded));
                assert!(off < 2e-6, "{code:?}, {encoded:?}: {off:e}");
                moved += 1;
            }
        } else {
            let read = [code[0], code[1], code[2], if code[3] == 0 { 1 } else { code[3] }]
                .map(|c| c.max(-32767));
            let expected = if QTangent64::is_canonical(read) { read } else { encoded };
            assert_eq!(again, expected, "{code:?}");
        }
    }
    eprintln!("of {canonical} canonical quaternions {moved} encode to one that decodes alike");
    assert!(canonical > 100_000);
}

#[test]
fn quaternions_keep_handedness_and_frame() {
    let mut rng = Rng::new(9);
    for i in 0..600_000 {
        let frame = match i % 3 {
            0 => awkward(&mut rng),
            1 => between_quaternions(&mut rng),
            _ => uniform(&mut rng),
        };
        let codes = [QTangent64::encode(frame), QTangent64::encode_precise(frame)];
        for code in codes {
            let of = format!("{frame:?} = {code:?}");
            assert!(QTangent64::is_canonical(code), "{of}");
            assert_eq!(code[3] < 0, frame.handedness < 0.0, "{of}");
            assert!(code[3] != 0, "{of}");
            let decoded = QTangent64::decode(code);
            let (normal, tangent) = vectors(decoded);
            let own = direction(frame.normal).unwrap_or([0.0, 0.0, 1.0]);
            let bound = QTangent64::MAX_TANGENT_ERROR_DEGREES.to_radians();
            assert!(angle(own, normal) <= bound, "{of}");
            let target = match part_across(frame, own) {
                Some(target) => target,
                None if direction(frame.tangent).is_none_or(|t| length(cross(own, t)) < 5e-7) => {
                    // Beside a z far too small for f32 there is none.
                    basis(own.map(|c| f64::from(c as f32)))[0]
                }
                None => continue,
            };
            let slack = ROUNDING / length(target);
            assert!(angle(target, tangent) <= bound + slack, "{of} {target:?}");
        }
    }
}

/// The unit quaternion of a frame with w >= 0, by the trace where that is exact enough.
fn unit_quaternion(frame: Frame) -> Option<[f64; 4]> {
    let n = normalize(widen(frame.normal));
    let t = widen(frame.tangent);
    let t = normalize(plus(t, scaled(n, -dot(t, n))));
    let b = cross(n, t);
    let w = (1.0 + t[0] + b[1] + n[2]).max(0.0).sqrt() / 2.0;
    let q = [b[2] - n[1], n[0] - t[2], t[1] - b[0]].map(|c| c / (4.0 * w));
    (w > 0.01).then_some([q[0], q[1], q[2], w])
}

#[test]
fn precise_quaternions_are_the_closest_of_sixteen() {
    let mut rng = Rng::new(14);
    let (mut gained, mut sums) = (0, [0.0; 2]);
    let mut count = 0;
    for _ in 0..200_000 {
        let frame = uniform(&mut rng);
        let Some(q) = unit_quaternion(frame) else { continue };
        let rotation = |code: [i16; 4]| {
            let code = code.map(|c| f64::from(c) * f64::from(frame.handedness));
            let length = code.iter().map(|c| c * c).sum::<f64>().sqrt();
            let off: f64 = (0..4).map(|i| (code[i] / length - q[i]).powi(2)).sum();
            2.0 * off.sqrt()
        };
        let mut least = f64::INFINITY;
        for corner in 0..16 {
            let c = [0, 1, 2, 3].map(|i| {
                let c = (q[i] * 32767.0).floor() as i64 + (corner >> i & 1);
                c.clamp(if i == 3 { 1 } else { -32767 }, 32767) as i16
            });
            let sign = frame.handedness as i16;
            // Not where rounding decides whether it is around at all.
            let around = (0..4).all(|i| (f64::from(c[i]) - q[i] * 32767.0).abs() < 0.97);
            if around && off_unit(c) < 0.97 {
                least = least.min(rotation(c.map(|c| c * sign)));
            }
        }
        let [fast, precise] =
            [QTangent64::encode(frame), QTangent64::encode_precise(frame)].map(rotation);
        assert!(precise <= least + 4e-6, "{frame:?}: {precise:e}, not {least:e}");
        gained += u32::from(precise < fast - 1e-6);
        sums = [sums[0] + fast.to_degrees(), sums[1] + precise.to_degrees()];
        count += 1;
    }
    eprintln!("rotations off by {:?} degrees", sums.map(|sum| sum / f64::from(count)));
    assert!(gained > count / 3);
}

/// Frames of which every vector is an axis: 6 normals, 4 tangents, 2 signs.
fn axes_survive<C: FrameCodec>(expected: usize) {
    let axes = [0, 1, 2].map(|i| {
        [1.0f32, -1.0].map(|c| {
            let mut v = [0.0; 3];
            v[i] = c;
            v
        })
    });
    let mut survive = 0;
    for normal in axes.as_flattened() {
        for tangent in axes.as_flattened() {
            if dot(widen(*normal), widen(*tangent)) != 0.0 {
                continue;
            }
            for handedness in [1.0, -1.0] {
                let frame = Frame { normal: *normal, tangent: *tangent, handedness };
                let same = |encode: fn(Frame) -> C::Code| C::decode(encode(frame)) == frame;
                survive += usize::from(same(C::encode) && same(C::encode_precise));
                assert_eq!(frame.skew_degrees(), 0.0);
            }
        }
    }
    assert_eq!(survive, expected, "{}", C::NAME);
}

#[test]
fn axes_survive_exactly() {
    axes_survive::<OctAngle32>(48);
    axes_survive::<OctAngle64>(48);
    // Those of a half turn have w = 0, which is not stored.
    axes_survive::<QTangent64>(30);
}

fn only_directions_matter<C: FrameCodec>() {
    let mut rng = Rng::new(10);
    for _ in 0..20_000 {
        let frame = uniform(&mut rng);
        let (fast, precise) = (C::encode(frame), C::encode_precise(frame));
        for power in [-80, -30, 30, 90] {
            let scale = 2f32.powi(power);
            let scaled = Frame {
                normal: frame.normal.map(|c| c * scale),
                tangent: frame.tangent.map(|c| c / scale),
                handedness: frame.handedness * 7.0,
            };
            assert_eq!((C::encode(scaled), C::encode_precise(scaled)), (fast, precise));
            assert_eq!(scaled.skew_degrees(), frame.skew_degrees());
        }
    }
}

#[test]
fn lengths_of_vectors_do_not_matter() {
    codecs!(only_directions_matter);
}

#[test]
fn skew_is_what_the_angle_lacks_of_90_degrees() {
    let mut rng = Rng::new(11);
    let mut greatest = [0.0f64; 2];
    for i in 0..400_000 {
        let frame = if i % 4 == 0 { uniform(&mut rng) } else { awkward(&mut rng) };
        let skew = f64::from(frame.skew_degrees());
        assert!((0.0..=90.0).contains(&skew), "{frame:?}: {skew}");
        let Some(tangent) = direction(frame.tangent) else {
            assert_eq!(skew, 90.0, "{frame:?}");
            continue;
        };
        let normal = direction(frame.normal).unwrap_or([0.0, 0.0, 1.0]);
        let expected = (90.0 - angle(normal, tangent).to_degrees()).abs();
        let steep = expected > 60.0;
        let error = (skew - expected).abs();
        assert!(error < if steep { 0.05 } else { 4e-5 }, "{frame:?}: {skew}, not {expected}");
        greatest[usize::from(steep)] = greatest[usize::from(steep)].max(error);
    }
    eprintln!("skew off by {greatest:?} degrees, below and above 60");
    // What remains of an angle so small that its square is not a normal number.
    let frame = Frame { normal: [0.0, 0.0, 1.0], tangent: [1.0, 0.0, 1e-30], handedness: 1.0 };
    assert_eq!(frame.skew_degrees(), 0.0);
    let frame = Frame { tangent: [1.0, 0.0, 1.0], ..frame };
    assert!((frame.skew_degrees() - 45.0).abs() < 1e-5);
    let frame = Frame { normal: [f32::NAN; 3], tangent: [0.0, 0.0, -8.0], ..frame };
    assert_eq!(frame.skew_degrees(), 90.0);
}

fn check_aos<C: FrameCodec, const N: usize>(frames: &[Frame], codes: [&[C::Code]; 2], skew: Skew) {
    let normals: Vec<[f32; N]> = frames
        .iter()
        .map(|f| std::array::from_fn(|i| f.normal.get(i).copied().unwrap_or(7.0)))
        .collect();
    let tangents: Vec<[f32; 4]> =
        frames.iter().map(|f| [f.tangent[0], f.tangent[1], f.tangent[2], f.handedness]).collect();
    let mut got = vec![C::Code::zeroed(); frames.len()];
    assert_eq!(C::encode_aos(&normals, &tangents, &mut got), Ok(skew));
    assert_eq!(got, codes[0]);
    assert_eq!(C::encode_aos_precise(&normals, &tangents, &mut got), Ok(skew));
    assert_eq!(got, codes[1]);
    let (mut normals, mut tangents) = (vec![[5.0; N]; got.len()], vec![[5.0; 4]; got.len()]);
    C::decode_aos(&got, &mut normals, &mut tangents).unwrap();
    for ((code, normal), tangent) in got.iter().zip(&normals).zip(&tangents) {
        let frame = C::decode(*code);
        assert_eq!(normal[..3], frame.normal);
        assert!(normal[3..].iter().all(|c| *c == 5.0));
        let [x, y, z] = frame.tangent;
        assert_eq!(*tangent, [x, y, z, frame.handedness]);
    }
}

fn batches_agree<C: FrameCodec>() {
    let mut rng = Rng::new(12);
    for len in (0..70).chain([255, 256, 257, 513, 700]) {
        let mut frames: Vec<Frame> = (0..len)
            .map(|i| if i % 3 == 0 { awkward(&mut rng) } else { uniform(&mut rng) })
            .collect();
        // The same greatest skew at several places.
        if len > 3 && len % 2 == 0 {
            let given = frames[rng.below(len as u64) as usize];
            for _ in 0..5 {
                frames[rng.below(len as u64) as usize] = given;
            }
        }
        let mut skew = Skew::default();
        for (i, frame) in frames.iter().enumerate() {
            if frame.skew_degrees() > skew.degrees {
                (skew.degrees, skew.index) = (frame.skew_degrees(), i);
            }
        }
        let columns = columns(&frames);
        let one = |encode: fn(Frame) -> C::Code| -> Vec<C::Code> {
            frames.iter().copied().map(encode).collect()
        };
        let (fast, precise) = (one(C::encode), one(C::encode_precise));
        let mut codes = vec![C::Code::zeroed(); len];
        let got = C::encode_soa(soa(&columns), &mut codes).unwrap();
        assert_eq!(codes, fast);
        assert_eq!(got.degrees, skew.degrees, "{} {len}", C::NAME);
        // Two squared sines may have one angle; the greater of them counts.
        assert_eq!(frames[got.index..].first().map_or(0.0, |f| f.skew_degrees()), skew.degrees);
        assert!(got.index >= skew.index);
        assert_eq!(C::encode_soa_precise(soa(&columns), &mut codes), Ok(got));
        assert_eq!(codes, precise);
        check_aos::<C, 3>(&frames, [&fast, &precise], got);
        check_aos::<C, 4>(&frames, [&fast, &precise], got);
        check_aos::<C, 9>(&frames, [&fast, &precise], got);
        let patterns: Vec<C::Code> = (0..len).map(|_| any_code::<C>(&mut rng)).collect();
        let mut decoded = [0; 7].map(|_| vec![9.0; len]);
        C::decode_soa(&patterns, soa_mut(&mut decoded)).unwrap();
        for (i, code) in patterns.iter().enumerate() {
            let got = [0, 1, 2, 3, 4, 5, 6].map(|c: usize| decoded[c][i].to_bits());
            assert_eq!(got, bits(C::decode(*code)), "{} {code:x?}", C::NAME);
        }
    }
}

#[test]
fn batches_give_the_bits_of_single_frames() {
    codecs!(batches_agree);
}

#[test]
fn the_first_of_equally_skewed_frames_is_named() {
    let frame = Frame { normal: [0.0, 0.0, 1.0], tangent: [1.0, 0.0, 0.0], handedness: 1.0 };
    let skewed = Frame { tangent: [1.0, 0.0, 1.0], ..frame };
    for len in [1usize, 7, 8, 9, 40, 300] {
        for first in 0..len {
            let mut frames = vec![frame; len];
            frames[first] = skewed;
            for later in [first + 1, first + 7, first + 15, first + 16] {
                if later < len {
                    frames[later] = skewed;
                }
            }
            let mut codes = vec![0u32; len];
            let skew = OctAngle32::encode_soa(soa(&columns(&frames)), &mut codes).unwrap();
            assert_eq!((skew.degrees, skew.index), (skewed.skew_degrees(), first));
        }
    }
}

fn lengths_are_checked<C: FrameCodec>() {
    let code: C::Code = C::Code::zeroed();
    for differs in 0..8 {
        for other in [2, 4] {
            let mut lengths = [3; 8];
            lengths[differs] = other;
            let [a, b, c, d, e, f, handedness, count] = lengths;
            let error = LengthMismatch::FrameSoa {
                normal: [a, b, c],
                tangent: [d, e, f],
                handedness,
                codes: count,
            };
            assert_eq!(
                error.to_string(),
                format!(
                    "lengths differ: normal x {a}, y {b}, z {c}, tangent x {d}, y {e}, z {f}, \
                     handedness {handedness}, codes {count}"
                )
            );
            let mut columns = [a, b, c, d, e, f, handedness].map(|len| vec![0.5; len]);
            let before = columns.clone();
            let full =
                C::encode(Frame { normal: [1.0; 3], tangent: [1.0, -1.0, 0.0], handedness: 1.0 });
            let mut codes = vec![full; count];
            assert_eq!(C::encode_soa(soa(&columns), &mut codes), Err(error));
            assert_eq!(C::encode_soa_precise(soa(&columns), &mut codes), Err(error));
            assert_eq!(codes, vec![full; count]);
            assert_eq!(C::decode_soa(&vec![code; count], soa_mut(&mut columns)), Err(error));
            assert_eq!(columns, before);
        }
    }
    for [normals, tangents, codes] in [[3, 4, 4], [4, 3, 4], [4, 4, 3]] {
        let error = LengthMismatch::FrameAos { normals, tangents, codes };
        assert_eq!(
            error.to_string(),
            format!("lengths differ: normals {normals}, tangents {tangents}, codes {codes}")
        );
        let (mut n, mut t) = (vec![[7.0; 3]; normals], vec![[7.0; 4]; tangents]);
        let mut out = vec![code; codes];
        assert_eq!(C::encode_aos(&n, &t, &mut out), Err(error));
        assert_eq!(C::encode_aos_precise(&n, &t, &mut out), Err(error));
        assert_eq!(out, vec![code; codes]);
        assert_eq!(C::decode_aos(&out, &mut n, &mut t), Err(error));
        assert_eq!((n, t), (vec![[7.0; 3]; normals], vec![[7.0; 4]; tangents]));
    }
}

#[test]
fn frames_of_other_lengths_are_refused() {
    codecs!(lengths_are_checked);
}
