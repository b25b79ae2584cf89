//! Rotations of any width against `f64`, with their own reading of the bits.

use unitpack::quaternion::{QuaternionCodec, QuaternionFormat, SmallestThree32, Soa4, Soa4Mut};
use unitpack::{LengthMismatch, StrideMismatch, Strided, StridedMut};
use unitpack_test::elements::FILL;
use unitpack_test::quaternions::{
    Quaternion, chord, fields, greatest, length, plain, target, unit,
};
use unitpack_test::random::Rng;

/// How far off rounding to f32 may lead, as a chord in 4D.
const ROUNDING: f64 = 3e-7;

fn formats() -> Vec<QuaternionFormat> {
    let three = (0..32).filter_map(QuaternionFormat::smallest_three);
    let all: Vec<_> = three.chain((0..32).filter_map(QuaternionFormat::snorm)).collect();
    assert_eq!(all.len(), 17 + 13);
    all
}

fn is_three(format: QuaternionFormat) -> bool {
    !format.bits().is_multiple_of(4)
        || (0..32).any(|b| QuaternionFormat::smallest_three(b) == Some(format))
}

/// Bits of a component.
fn width(format: QuaternionFormat) -> u32 {
    if is_three(format) { (format.bits() - 2) / 3 } else { format.bits() / 4 }
}

/// The angle of the rotation between two quaternions.
fn degrees(chord: f64) -> f64 {
    4.0 * (chord / 2.0).asin().to_degrees()
}

/// What a code means.
fn meaning(format: QuaternionFormat, code: u64) -> Quaternion {
    let bits = width(format);
    if !is_three(format) {
        return plain(code, bits);
    }
    let fields: [i64; 3] = fields(code, bits);
    let rest = 2 * greatest(bits).pow(2) - fields.iter().map(|f| f * f).sum::<i64>();
    if rest < 0 {
        return [0.0, 0.0, 0.0, 1.0];
    }
    let mut q = fields.map(|f| f as f64).to_vec();
    q.insert((code >> (3 * bits) & 3) as usize, (rest as f64).sqrt());
    unit(q.try_into().unwrap())
}

fn random(rng: &mut Rng) -> [f32; 4] {
    loop {
        let q = [0; 4].map(|_| 2.0 * rng.unit() - 1.0);
        if (0.1..=1.0).contains(&length(q)) {
            return q.map(|c| c as f32);
        }
    }
}

/// Uniform ones, those near a quarter turn, near axes, on coarse grids, and odd ones.
fn inputs(seed: u64, count: usize) -> Vec<[f32; 4]> {
    let mut rng = Rng::new(seed);
    let odd = [0.0, -0.0, 1.0, -1.0, f32::NAN, f32::INFINITY, 1e-45, -7e37, 0.5];
    (0..count)
        .map(|i| match i % 7 {
            0 => [0; 4].map(|_| rng.pick(&odd)),
            // Half way between codes of 4 bits, where rounding is off the most.
            1 => [5.5, 2.5, 2.5, 2.5].map(|c| c * rng.pick(&[1.0, -1.0, 0.99999])),
            6 => [0; 4].map(|_| rng.below(9) as f32 - 4.0),
            2 => {
                let mut q = random(&mut rng).map(|c| 0.01 * c);
                for _ in 0..1 + rng.below(2) {
                    q[rng.below(4) as usize] += rng.pick(&[1.0, -1.0]);
                }
                q
            }
            _ => random(&mut rng),
        })
        .collect()
}

/// How many inputs `encode_precise` is tried with: it takes longer with each bit.
fn precise_count(format: QuaternionFormat) -> usize {
    if is_three(format) { 3000 } else { 60_000 >> width(format) }.max(12)
}

#[test]
fn codes_mean_what_their_bits_say() {
    for format in formats() {
        let sizes = [2, 3, 4, 6, 8].into_iter().find(|size| 8 * size >= format.bits());
        assert_eq!(Some(format.code_size() as u32), sizes);
        let mut rng = Rng::new(u64::from(format.bits()));
        let every: Vec<u64> = if format.bits() <= 16 {
            (0..1 << format.bits()).collect()
        } else {
            (0..20_000).map(|_| rng.bits()).collect()
        };
        for code in every {
            let decoded = format.decode(code).map(f64::from);
            let off = chord(decoded, meaning(format, code));
            assert!(off < ROUNDING, "{format:?} {code:x}: {decoded:?}");
            assert!((length(decoded) - 1.0).abs() < 2.5e-7);
        }
    }
}

#[test]
fn encoders_keep_their_bounds_and_signs_and_lengths_do_not_matter() {
    for format in formats() {
        for (i, q) in inputs(3, 20_000).into_iter().enumerate() {
            let of = target(q);
            let code = format.encode(q);
            assert_eq!(code >> 1 >> (format.bits() - 1), 0);
            let off = degrees(chord(of, meaning(format, code)));
            assert!(off <= format.max_error_degrees(), "{format:?} {q:?}: {off}");
            assert_eq!(format.encode(q.map(|c| -c)), code, "{format:?} {q:?}");
            if i < precise_count(format) {
                let code = format.encode_precise(q);
                assert_eq!(code >> 1 >> (format.bits() - 1), 0);
                let least = degrees(chord(of, meaning(format, code)));
                assert!(least <= format.max_error_precise_degrees(), "{format:?} {q:?}: {least}");
                assert!(least <= off + 1e-4, "{format:?} {q:?}: {least}, not {off}");
                assert_eq!(format.encode_precise(q.map(|c| -4.0 * c)), code, "{format:?} {q:?}");
            }
        }
    }
}

/// The nearest of all codes of 4 bits a component, and of wider plain ones at each length.
#[test]
fn the_precise_code_is_the_nearest() {
    for format in [QuaternionFormat::smallest_three(4), QuaternionFormat::snorm(4)] {
        let format = format.unwrap();
        let all: Vec<Quaternion> = (0..1 << format.bits()).map(|c| meaning(format, c)).collect();
        for q in inputs(5, 600) {
            let of = target(q);
            let least = all.iter().map(|&a| chord(of, a)).fold(4.0, f64::min);
            let off = chord(of, meaning(format, format.encode_precise(q)));
            assert!(off < least + ROUNDING, "{format:?} {q:?}: {off}, not {least}");
        }
    }
    for bits in [5, 6, 8, 10, 12, 16] {
        let format = QuaternionFormat::snorm(bits).unwrap();
        let m = (1i32 << (bits - 1)) - 1;
        for q in inputs(6, precise_count(format) / 4 + 8) {
            let of = target(q);
            let largest = of.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
            let mut least = f64::INFINITY;
            for n in 1..=m {
                let ideal = of.map(|c| c / largest * f64::from(n));
                // Down and up on every axis.
                for corner in 0..16 {
                    let point = [0, 1, 2, 3].map(|i| ideal[i].floor() + f64::from(corner >> i & 1));
                    if point.iter().all(|c| c.abs() <= f64::from(m)) && length(point) > 0.0 {
                        least = least.min(chord(of, unit(point)));
                    }
                }
            }
            let off = chord(of, meaning(format, format.encode_precise(q)));
            assert!(off < least + ROUNDING, "{format:?} {q:?}: {off}, not {least}");
        }
    }
}

#[test]
fn what_was_decoded_becomes_the_same_code() {
    for format in formats() {
        let count = precise_count(format);
        let mut rng = Rng::new(8);
        for q in inputs(7, count) {
            let code = format.encode_precise(q);
            let again = format.encode_precise(format.decode(code));
            assert_eq!(again, code, "{format:?} {q:?}");
            assert_eq!(format.canonical(code), code, "{format:?} {q:?}");
            // Any pattern has one.
            let code = rng.bits();
            let canonical = format.canonical(code);
            assert_eq!(
                format.encode_precise(format.decode(code)),
                canonical,
                "{format:?} {code:x}"
            );
            if is_three(format) {
                let code = format.encode(q);
                assert_eq!(format.encode(format.decode(code)), code, "{format:?} {q:?}");
            }
        }
    }
}

#[test]
fn ten_bits_are_the_codec_of_32() {
    let format = QuaternionFormat::smallest_three(10).unwrap();
    for q in inputs(9, 10_000) {
        let codes = [SmallestThree32::encode(q), SmallestThree32::encode_precise(q)];
        assert_eq!([format.encode(q), format.encode_precise(q)], codes.map(u64::from), "{q:?}");
        assert_eq!(format.decode(codes[0].into()), SmallestThree32::decode(codes[0]));
    }
}

/// Of 8 bits, as the page says.
#[test]
fn the_nearest_of_all_lengths_is_a_third_as_far_as_rounding() {
    let format = QuaternionFormat::snorm(8).unwrap();
    let mut rng = Rng::new(10);
    let mut sums = [0.0; 2];
    let count = 4000;
    for _ in 0..count {
        let q = random(&mut rng);
        let codes = [format.encode(q), format.encode_precise(q)];
        for (sum, code) in sums.iter_mut().zip(codes) {
            *sum += degrees(chord(target(q), meaning(format, code)));
        }
    }
    let [fast, precise] = sums.map(|sum| sum / f64::from(count));
    assert!((fast - 0.429).abs() < 0.01 && (precise - 0.119).abs() < 0.004, "{fast} {precise}");
}

#[test]
fn batches_give_the_bits_of_single_quaternions() {
    for format in formats() {
        let size = format.code_size();
        for len in [0, 1, 17, if is_three(format) { 300 } else { 40 }] {
            let q = &inputs(11, 300)[..len];
            let [x, y, z, w] = [0, 1, 2, 3].map(|i| q.iter().map(|q| q[i]).collect::<Vec<_>>());
            let soa = Soa4 { x: &x, y: &y, z: &z, w: &w };
            let bytes = |encode: &dyn Fn([f32; 4]) -> u64| -> Vec<u8> {
                q.iter().flat_map(|&q| encode(q).to_le_bytes()[..size].to_vec()).collect()
            };
            let fast = bytes(&|q| format.encode(q));
            let mut out = vec![FILL; size * len];
            format.encode_soa(soa, &mut out).unwrap();
            assert_eq!(out, fast, "{format:?}");
            if width(format) <= 12 || is_three(format) {
                format.encode_soa_precise(soa, &mut out).unwrap();
                assert_eq!(out, bytes(&|q| format.encode_precise(q)), "{format:?}");
            }
            // Codes three bytes apart, from the second byte on.
            let stride = size + 3;
            let mut apart = vec![FILL; 1 + stride * len];
            let to = StridedMut { bytes: &mut apart, offset: 1, stride, len };
            format.encode_strided(Strided::of(q, 0), to).unwrap();
            for (i, code) in fast.chunks(size).enumerate() {
                let element = &apart[1 + i * stride..][..stride];
                assert_eq!((&element[..size], &element[size..]), (code, &[FILL; 3][..]));
            }
            let expected: Vec<[f32; 4]> = fast
                .chunks(size)
                .map(|code| {
                    let mut bytes = [0; 8];
                    bytes[..size].copy_from_slice(code);
                    format.decode(u64::from_le_bytes(bytes))
                })
                .collect();
            let mut decoded = vec![[7.0f32; 4]; len];
            let from = Strided { bytes: &apart, offset: 1, stride, len };
            format.decode_strided(from, StridedMut::of(&mut decoded, 0)).unwrap();
            assert_eq!(decoded, expected);
            let [mut x, mut y, mut z, mut w] = [0; 4].map(|_| vec![7.0; len]);
            let soa = Soa4Mut { x: &mut x, y: &mut y, z: &mut z, w: &mut w };
            format.decode_soa(&fast, soa).unwrap();
            for (i, &q) in expected.iter().enumerate() {
                assert_eq!([x[i], y[i], z[i], w[i]], q);
            }
        }
    }
}

#[test]
fn other_lengths_are_refused() {
    let format = QuaternionFormat::smallest_three(12).unwrap();
    let c = [0.5f32; 3];
    let q = |len: usize| Soa4 { x: &c[..len], y: &c, z: &c, w: &c };
    let mut bytes = [FILL; 24];
    for (x, len) in [(2, 18), (3, 17), (3, 12), (3, 0)] {
        let error =
            LengthMismatch::QuaternionBytes { components: [x, 3, 3, 3], bytes: len, code_size: 6 };
        assert_eq!(format.encode_soa(q(x), &mut bytes[..len]), Err(error));
        assert_eq!(format.encode_soa_precise(q(x), &mut bytes[..len]), Err(error));
        let words = format!("lengths do not fit: x {x}, y 3, z 3, w 3, bytes {len} at 6 a code");
        assert_eq!(error.to_string(), words);
        let [mut a, mut b, mut c, mut d] = [[7.0; 3]; 4];
        let to = Soa4Mut { x: &mut a[..x], y: &mut b, z: &mut c, w: &mut d };
        assert_eq!(format.decode_soa(&bytes[..len], to), Err(error));
    }
    let to = StridedMut { bytes: &mut bytes, offset: 0, stride: 5, len: 3 };
    let error = StrideMismatch::Stride { offset: 0, stride: 5, len: 3, size: 6, bytes: 24 };
    assert_eq!(format.encode_strided(Strided::of(&[[1.0f32; 4]; 3], 0), to), Err(error));
    assert_eq!(bytes, [FILL; 24]);
}

/// A turn about z by 1.4 revolutions, in which the sign of what is decoded changes.
#[test]
fn a_track_has_no_jumps() {
    let turn = |i: usize| {
        let half = i as f32 * 0.011;
        [0.1 * half.sin(), 0.0, half.sin(), half.cos()]
    };
    let q: Vec<[f32; 4]> = (0..800).map(turn).collect();
    let dot = |a: [f32; 4], b: [f32; 4]| (0..4).map(|i| a[i] * b[i]).sum::<f32>();
    let mut codes = vec![0; q.len()];
    SmallestThree32::encode_aos(&q, &mut codes).unwrap();
    let jumps = |q: &[[f32; 4]]| q.windows(2).filter(|w| dot(w[0], w[1]) < 0.0).count();
    let mut decoded = q.clone();
    SmallestThree32::decode_aos(&codes, &mut decoded).unwrap();
    assert!(jumps(&decoded) >= 3);
    let start = turn(0).map(|c| -c);
    let mut track = decoded.clone();
    SmallestThree32::decode_track(&codes, start, &mut track).unwrap();
    assert_eq!(jumps(&track), 0);
    assert!(dot(track[0], start) > 0.0);
    for (t, d) in track.iter().zip(&decoded) {
        assert!(t == d || *t == d.map(|c| -c));
    }
    let mut previous = start;
    for (&code, &t) in codes.iter().zip(&track) {
        previous = SmallestThree32::decode_near(code, previous);
        assert_eq!(previous, t);
    }

    // Each near to what it replaces.
    let mut replaced: Vec<[f32; 4]> = q.iter().map(|q| q.map(|c| -c)).collect();
    SmallestThree32::decode_aos_near(&codes, &mut replaced).unwrap();
    assert!(replaced.iter().zip(&q).all(|(r, q)| dot(*r, *q) < -0.9));
    // What is no rotation has no sign to keep.
    assert_eq!(SmallestThree32::decode_near(codes[9], [f32::NAN; 4]), decoded[9]);

    for format in [QuaternionFormat::smallest_three(10), QuaternionFormat::snorm(12)] {
        let format = format.unwrap();
        let mut bytes = vec![0; format.code_size() * q.len()];
        let to =
            StridedMut { bytes: &mut bytes, offset: 0, stride: format.code_size(), len: q.len() };
        format.encode_strided(Strided::of(&q, 0), to).unwrap();
        let mut there = vec![[0.0; 4]; q.len()];
        format.decode_track(&bytes, start, &mut there).unwrap();
        assert_eq!(jumps(&there), 0);
        assert!(dot(there[0], start) > 0.0);
        if format.bits() == 32 {
            assert_eq!(there, track);
        }
        let mut near: Vec<[f32; 4]> = q.iter().map(|q| q.map(|c| -c)).collect();
        format.decode_aos_near(&bytes, &mut near).unwrap();
        assert!(near.iter().zip(&q).all(|(n, q)| dot(*n, *q) < -0.9));
        assert!(format.decode_near(format.encode(q[5]), start)[3] < 0.0);
        let error =
            LengthMismatch::AosBytes { vectors: 800, bytes: 7, code_size: format.code_size() };
        assert_eq!(format.decode_aos_near(&bytes[..7], &mut near), Err(error));
        assert_eq!(format.decode_track(&bytes[..7], start, &mut near), Err(error));
    }
    let error = Err(LengthMismatch::Aos { vectors: 800, codes: 799 });
    assert_eq!(SmallestThree32::decode_aos_near(&codes[1..], &mut replaced), error);
    assert_eq!(SmallestThree32::decode_track(&codes[1..], start, &mut replaced), error);
}
