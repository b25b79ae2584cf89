//! Tangent frames against f64; batches give what single frames give.
#![no_main]

use std::f64::consts::PI;

use libfuzzer_sys::fuzz_target;
use unitpack::frame::{
    Frame, FrameCodec, OctAngle32, OctAngle64, OctAngleFormat, QTangent64, Skew,
};
use unitpack::{Codec, Oct22, Oct32};
use unitpack_fuzz::{Bytes, FrameArrays};
use unitpack_test::UNWRITTEN;
use unitpack_test::frames::{basis, direction, oct_angle, part_across, quaternion, vectors};
use unitpack_test::vectors::{angle, cross, dot, length, widen};

/// What rounding to f32 may add to an angle, in radians.
const ROUNDING: f64 = 1e-6;

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let which = bytes.byte();
    let which_split = if which % 4 == 3 { bytes.take() } else { [0; 2] };
    let items = bytes.rest::<28>();
    let frame = |item: &[u8; 28]| {
        let [a, b, c, d, e, f, handedness]: [f32; 7] = bytemuck::pod_read_unaligned(item);
        Frame { normal: [a, b, c], tangent: [d, e, f], handedness }
    };
    let frames: Vec<Frame> = items.iter().map(frame).collect();
    match which % 4 {
        0 => {
            let given: Vec<u32> =
                items.iter().map(|i| bytemuck::pod_read_unaligned(&i[2..6])).collect();
            batches::<OctAngle32>(&frames, &given);
            for &frame in &frames {
                oct_angles::<OctAngle32, Oct22>(frame, 9, u64::from, |code| code.into());
            }
            for code in given {
                decodes(OctAngle32::decode(code), oct_angle(code.into(), 11, 9), code >> 31 == 1);
                let canonical = OctAngle32::canonical(code);
                assert_eq!(OctAngle32::encode_precise(OctAngle32::decode(code)), canonical);
            }
        }
        1 => {
            let given: Vec<u64> =
                items.iter().map(|i| bytemuck::pod_read_unaligned(&i[2..10])).collect();
            batches::<OctAngle64>(&frames, &given);
            for &frame in &frames {
                oct_angles::<OctAngle64, Oct32>(frame, 31, |code| code, |code| code.into());
            }
            for code in given {
                decodes(OctAngle64::decode(code), oct_angle(code, 16, 31), code >> 63 == 1);
                let canonical = OctAngle64::canonical(code);
                let again = OctAngle64::encode_precise(OctAngle64::decode(code));
                assert_eq!((again as u32, again >> 63), (canonical as u32, canonical >> 63));
                assert_eq!(OctAngle64::encode_precise(OctAngle64::decode(again)), again);
                assert_eq!(OctAngle64::encode(OctAngle64::decode(canonical)), canonical);
            }
        }
        2 => {
            let given: Vec<[i16; 4]> =
                items.iter().map(|i| bytemuck::pod_read_unaligned(&i[2..10])).collect();
            batches::<QTangent64>(&frames, &given);
            for &frame in &frames {
                quaternions(frame);
            }
            for code in given {
                decodes(QTangent64::decode(code), quaternion(code), code[3] < 0);
                let canonical = QTangent64::canonical(code);
                let [now, then] = [code, canonical].map(QTangent64::decode);
                let off = |a, b| angle(widen(a), widen(b)).to_degrees();
                let bound = QTangent64::MAX_TANGENT_ERROR_PRECISE_DEGREES;
                assert!(off(now.normal, then.normal) <= bound, "{code:?} {canonical:?}");
                assert!(off(now.tangent, then.tangent) <= bound, "{code:?} {canonical:?}");
            }
        }
        _ => {
            let splits: Vec<OctAngleFormat> = (8..=32)
                .flat_map(|oct| (1..=31).filter_map(move |angle| OctAngleFormat::new(oct, angle)))
                .collect();
            let format = splits[usize::from(u16::from_le_bytes(which_split)) % splits.len()];
            let given: Vec<u64> =
                items.iter().map(|i| bytemuck::pod_read_unaligned(&i[2..10])).collect();
            split_batches(format, &frames, &given);
            for &frame in &frames {
                split(format, frame);
            }
            for code in given {
                let (oct, angle) = (format.oct_bits() / 2, format.angle_bits());
                let negative = code >> (format.bits() - 1) & 1 == 1;
                decodes(format.decode(code), oct_angle(code, oct, angle), negative);
                let (u, v, angle, sign) = format.parameters(code);
                let canonical = format.canonical(code);
                let same = format.from_parameters(u, v, angle, sign);
                assert_eq!(format.canonical(same), canonical);
                assert_eq!(format.encode_precise(format.decode(canonical)), canonical);
                assert_eq!(format.encode(format.decode(canonical)), canonical);
            }
        }
    }
});

fn decodes(frame: Frame, (normal, tangent): ([f64; 3], [f64; 3]), negative: bool) {
    for (got, exact) in [(frame.normal, normal), (frame.tangent, tangent)] {
        let got = widen(got);
        let off = [0, 1, 2].map(|i| got[i] - exact[i]);
        assert!(length(off) < 7e-7, "{frame:?}, not {exact:?}");
        assert!((length(got) - 1.0).abs() <= 2.5e-7, "{frame:?}");
    }
    assert!(dot(widen(frame.normal), widen(frame.tangent)).abs() <= 5e-7, "{frame:?}");
    assert_eq!(frame.handedness, if negative { -1.0 } else { 1.0 });
}

/// The normal's own code, the nearest angle, and the sign.
fn oct_angles<C: FrameCodec, N: Codec>(
    frame: Frame,
    bits: u32,
    wide: fn(C::Code) -> u64,
    oct: fn(N::Code) -> u64,
) {
    let normals = [N::encode(frame.normal), N::encode_precise(frame.normal)];
    for (code, normal) in [C::encode(frame), C::encode_precise(frame)].into_iter().zip(normals) {
        let of = format!("{} {frame:?} = {code:x?}", C::NAME);
        let normal_bits = C::BITS - 1 - bits;
        assert_eq!(wide(code) & ((1 << normal_bits) - 1), oct(normal), "{of}");
        assert_eq!(wide(code) >> (C::BITS - 1) == 1, frame.handedness < 0.0, "{of}");
        assert!(C::is_canonical(code), "{of}");
        let (about, tangent) = vectors(C::decode(code));
        if let Some(target) = part_across(frame, about)
            && length(target) > 1e-5
        {
            let slack = ROUNDING * (1.0 + 1.0 / length(target));
            let error = angle(target, tangent);
            assert!(error <= PI / (1u64 << bits.min(22)) as f64 + slack, "{of}, off by {error:e}");
        }
    }
}

/// The nearest angle, and the sign, with nothing above.
fn split(format: OctAngleFormat, frame: Frame) {
    for code in [format.encode(frame), format.encode_precise(frame)] {
        let of = format!("{format:?} {frame:?} = {code:x}");
        assert_eq!(code >> (format.bits() - 1) == 1, frame.handedness < 0.0, "{of}");
        assert_eq!(code >> (format.bits() - 1) >> 1, 0, "{of}");
        assert!(format.is_canonical(code), "{of}");
        let (about, tangent) = vectors(format.decode(code));
        if let Some(target) = part_across(frame, about)
            && length(target) > 1e-5
        {
            let slack = ROUNDING * (1.0 + 1.0 / length(target));
            let error = angle(target, tangent);
            let half_step = PI / (1u64 << format.angle_bits().min(22)) as f64;
            assert!(error <= half_step + slack, "{of}, off by {error:e}");
        }
    }
}

/// Bytes are those of single codes.
fn split_batches(format: OctAngleFormat, frames: &[Frame], given: &[u64]) {
    let (arrays, size) = (FrameArrays::from(frames), format.code_size());
    let to_bytes = |codes: &mut dyn Iterator<Item = u64>| -> Vec<u8> {
        codes.flat_map(|code| code.to_le_bytes()[..size].to_vec()).collect()
    };
    let mut bytes = vec![0xEE; size * frames.len()];
    format.encode_soa(arrays.read(), &mut bytes).unwrap();
    assert_eq!(bytes, to_bytes(&mut frames.iter().map(|frame| format.encode(*frame))));
    format.encode_soa_precise(arrays.read(), &mut bytes).unwrap();
    assert_eq!(bytes, to_bytes(&mut frames.iter().map(|frame| format.encode_precise(*frame))));

    let mut decoded = FrameArrays::unwritten([given.len(); 7]);
    format.decode_soa(&to_bytes(&mut given.iter().copied()), decoded.write()).unwrap();
    for (i, &code) in given.iter().enumerate() {
        let got = [0, 1, 2, 3, 4, 5, 6].map(|c: usize| decoded.0[c][i].to_bits());
        assert_eq!(got, bits(format.decode(code)));
    }
}

fn quaternions(frame: Frame) {
    let own = direction(frame.normal).unwrap_or([0.0, 0.0, 1.0]);
    for (code, bound) in [
        (QTangent64::encode(frame), QTangent64::MAX_TANGENT_ERROR_DEGREES),
        (QTangent64::encode_precise(frame), QTangent64::MAX_TANGENT_ERROR_PRECISE_DEGREES),
    ] {
        let of = format!("{frame:?} = {code:?}");
        assert!(QTangent64::is_canonical(code), "{of}");
        assert_eq!(code[3] < 0, frame.handedness < 0.0, "{of}");
        let (normal, tangent) = vectors(QTangent64::decode(code));
        assert!(angle(own, normal).to_degrees() <= bound, "{of}");
        let own_sine = direction(frame.tangent).map_or(0.0, |t| length(cross(own, t)));
        let target = match part_across(frame, own) {
            Some(target) => target,
            // Whether z is below 0 may be lost with what is too small for f32.
            None if own_sine < 5e-7 && own[2].abs() > 1e-30 => basis(own)[0],
            None => continue,
        };
        let slack = (ROUNDING / length(target)).to_degrees();
        assert!(angle(target, tangent).to_degrees() <= bound + slack, "{of}");
    }
}

fn bits(frame: Frame) -> [u32; 7] {
    let [[a, b, c], [d, e, f]] = [frame.normal, frame.tangent];
    [a, b, c, d, e, f, frame.handedness].map(f32::to_bits)
}

fn batches<C: FrameCodec>(frames: &[Frame], given: &[C::Code]) {
    let arrays = FrameArrays::from(frames);
    let normals: Vec<[f32; 3]> = frames.iter().map(|f| f.normal).collect();
    let tangents: Vec<[f32; 4]> =
        frames.iter().map(|f| [f.tangent[0], f.tangent[1], f.tangent[2], f.handedness]).collect();
    let skews: Vec<f32> = frames.iter().map(|f| f.skew_degrees()).collect();
    for (frame, skew) in frames.iter().zip(&skews) {
        let normal = direction(frame.normal).unwrap_or([0.0, 0.0, 1.0]);
        let exact = direction(frame.tangent)
            .map_or(90.0, |tangent| (90.0 - angle(normal, tangent).to_degrees()).abs());
        let error = (f64::from(*skew) - exact).abs();
        assert!(error < if exact > 60.0 { 0.05 } else { 3e-5 }, "{frame:?}: {skew}, not {exact}");
    }
    let check = |skew: Skew| {
        assert_eq!(skew.degrees, skews.iter().copied().fold(0.0, f32::max));
        assert_eq!(skew.degrees, skews.get(skew.index).copied().unwrap_or(0.0));
    };
    let mut codes = given.to_vec();
    let singles = |encode: fn(Frame) -> C::Code| -> Vec<C::Code> {
        frames.iter().copied().map(encode).collect()
    };
    check(C::encode_soa(arrays.read(), &mut codes).unwrap());
    assert_eq!(codes, singles(C::encode));
    check(C::encode_aos(&normals, &tangents, &mut codes).unwrap());
    assert_eq!(codes, singles(C::encode));
    check(C::encode_soa_precise(arrays.read(), &mut codes).unwrap());
    assert_eq!(codes, singles(C::encode_precise));
    check(C::encode_aos_precise(&normals, &tangents, &mut codes).unwrap());
    assert_eq!(codes, singles(C::encode_precise));

    let mut decoded = FrameArrays::unwritten([given.len(); 7]);
    C::decode_soa(given, decoded.write()).unwrap();
    let (mut normals, mut tangents) =
        (vec![[UNWRITTEN; 5]; given.len()], vec![[UNWRITTEN; 4]; given.len()]);
    C::decode_aos(given, &mut normals, &mut tangents).unwrap();
    for (i, &code) in given.iter().enumerate() {
        let single = bits(C::decode(code));
        assert_eq!([0, 1, 2, 3, 4, 5, 6].map(|c: usize| decoded.0[c][i].to_bits()), single);
        let ([a, b, c, rest @ ..], [x, y, z, handedness]) = (normals[i], tangents[i]);
        assert_eq!(bits(Frame { normal: [a, b, c], tangent: [x, y, z], handedness }), single);
        assert_eq!(rest, [UNWRITTEN; 2]);
        assert!(C::is_canonical(C::canonical(code)));
        assert_eq!(C::is_canonical(code), C::canonical(code) == code);
    }
}
