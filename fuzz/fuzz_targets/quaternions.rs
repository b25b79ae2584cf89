//! Quaternions against f64: what a code means, and no code of another rounding or chart is nearer than the precise one.
#![no_main]

use std::f64::consts::{FRAC_PI_4, SQRT_2};

use bytemuck::{Zeroable, bytes_of, pod_read_unaligned};
use libfuzzer_sys::fuzz_target;
use unitpack::quaternion::{
    QuaternionCodec, QuaternionFormat, SmallestThree32, SmallestThree48, SmallestThree64, Soa4,
    Soa4Mut, TanThree32,
};
use unitpack::{Strided, StridedMut};
use unitpack_fuzz::Bytes;
use unitpack_test::UNWRITTEN;
use unitpack_test::quaternions::{
    Quaternion, chord, fields, greatest, length, plain, target, unit,
};

/// How far off the nearest code rounding to f32 may lead, as a chord in 4D.
const ROUNDING: f64 = 3e-7;

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let codec = bytes.byte();
    let power = i32::from(bytes.byte() as i8);
    let given = bytes.rest::<16>();
    // Widths that are chosen at run time.
    if codec >= 64 {
        let bits = 4 + u32::from(codec / 2 % 17);
        return match if codec % 2 == 0 { QuaternionFormat::snorm(bits) } else { None } {
            Some(format) => check_format(format, &given, &|code| plain(code, bits)),
            None => check_format(
                QuaternionFormat::smallest_three(bits).expect("4 to 20 bits"),
                &given,
                &|code| three(code, bits, 3 * bits).quaternion(false),
            ),
        };
    }
    match codec % 4 {
        0 => check::<SmallestThree32>(power, &given, |c| three(u64::from(c), 10, 30), false),
        1 => check::<SmallestThree48>(power, &given, words, false),
        2 => check::<SmallestThree64>(power, &given, |c| three(c, 20, 62), false),
        _ => check::<TanThree32>(power, &given, |c| three(u64::from(c), 10, 30), true),
    }
});

/// Three integers, the greatest that they can be, and the component left out.
struct Point {
    fields: [i64; 3],
    m: i64,
    left_out: usize,
}

fn three(code: u64, width: u32, top: u32) -> Point {
    Point { fields: fields(code, width), m: greatest(width), left_out: (code >> top & 3) as usize }
}

fn words([a, b, c]: [u16; 3]) -> Point {
    let fields = [a, b, c].iter().rev().fold(0, |all, word| all << 15 | u64::from(word & 0x7FFF));
    let left_out = usize::from(a >> 15) | usize::from(b >> 15) << 1;
    Point { left_out, ..three(fields, 15, 60) }
}

impl Point {
    /// What is left of the squared length.
    fn rest(&self) -> i64 {
        2 * self.m * self.m - self.fields.iter().map(|f| f * f).sum::<i64>()
    }

    fn quaternion(&self, tangents: bool) -> Quaternion {
        let (side, rest) = if tangents {
            (self.fields.map(|f| (FRAC_PI_4 * f as f64 / self.m as f64).tan()), 1.0)
        } else {
            if self.rest() < 0 {
                return [0.0, 0.0, 0.0, 1.0];
            }
            (self.fields.map(|f| f as f64), (self.rest() as f64).sqrt())
        };
        let mut q = [side[0], side[1], side[2], 0.0];
        q.copy_within(self.left_out..3, self.left_out + 1);
        q[self.left_out] = rest;
        unit(q)
    }

    /// The least chord from `q` to a code of this format.
    fn least_chord(&self, q: Quaternion, tangents: bool) -> f64 {
        let mut least = f64::INFINITY;
        for left_out in 0..4 {
            let mut others = q.to_vec();
            let axis = others.remove(left_out);
            let params: Vec<f64> = others
                .iter()
                .map(|c| {
                    let c = c * axis.signum();
                    let m = self.m as f64;
                    if tangents { (c / axis.abs()).atan() / FRAC_PI_4 * m } else { c * SQRT_2 * m }
                })
                .collect();
            // Down, up, and one more each way.
            for n in 0..64 {
                let shifts = [n & 3, n >> 2 & 3, n >> 4];
                let fields = [0, 1, 2].map(|i| params[i].floor() as i64 + shifts[i] - 1);
                let point = Point { fields, m: self.m, left_out };
                if fields.iter().all(|f| f.abs() <= self.m) && (tangents || point.rest() >= 0) {
                    least = least.min(chord(q, point.quaternion(tangents)));
                }
            }
        }
        least
    }
}

fn check<C: QuaternionCodec>(
    power: i32,
    given: &[[u8; 16]],
    point: fn(C::Code) -> Point,
    tangents: bool,
) {
    let q: Vec<[f32; 4]> = given.iter().map(|g| pod_read_unaligned(g)).collect();
    let codes: Vec<C::Code> =
        given.iter().map(|g| pod_read_unaligned(&g[..size_of::<C::Code>()])).collect();
    for &q in &q {
        let of = target(q);
        let [fast, precise] = [C::encode(q), C::encode_precise(q)];
        let [off, least] = [fast, precise].map(|c| chord(of, point(c).quaternion(tangents)));
        let of_all = point(precise).least_chord(of, tangents);
        assert!(least <= of_all + ROUNDING, "{} {q:?}: {least}, not {of_all}", C::NAME);
        assert!(least <= off + ROUNDING, "{} {q:?}: fast {off}, precise {least}", C::NAME);
        let limit = |degrees: f64| 2.0 * (degrees.to_radians() / 4.0).sin();
        assert!(off <= limit(C::MAX_ERROR_DEGREES) + ROUNDING, "{} {q:?}: {off}", C::NAME);
        assert!(least <= limit(C::MAX_ERROR_PRECISE_DEGREES) + ROUNDING, "{} {q:?}", C::NAME);
        assert!(C::is_canonical(fast) && C::is_canonical(precise), "{} {q:?}", C::NAME);
        assert_eq!(C::encode(C::decode(fast)), fast, "{} {q:?}", C::NAME);
        for factor in [2f64.powi(power), -(2f64.powi(power))] {
            let scaled = q.map(|c| (f64::from(c) * factor) as f32);
            if (0..4).all(|i| f64::from(scaled[i]) == f64::from(q[i]) * factor) {
                let same = [C::encode(scaled), C::encode_precise(scaled)];
                assert_eq!(same, [fast, precise], "{} {q:?}, and {scaled:?}", C::NAME);
            }
        }
    }
    for &code in &codes {
        let q = C::decode(code);
        let (wide, given) = (q.map(f64::from), point(code));
        let expected = given.quaternion(tangents);
        let of = format!("{} {code:x?} is {q:?}", C::NAME);
        assert!((0..4).all(|i| (wide[i] - expected[i]).abs() < ROUNDING), "{of}, not {expected:?}");
        assert!((length(wide) - 1.0).abs() <= 2.5e-7, "{of}");
        assert!(q[given.left_out] >= 0.0, "{of}");
        let canonical = C::canonical(code);
        assert!(C::is_canonical(canonical), "{of}");
        if tangents || given.rest() >= 0 {
            // Wider ones have rotations that f32 cannot tell apart.
            let alike = if C::BITS == 32 { 1e-12 } else { ROUNDING };
            let off = chord(point(canonical).quaternion(tangents), expected);
            assert!(off < alike, "{of}, canonical {canonical:x?}");
        }
        assert_eq!(C::encode_precise(q), canonical, "{of}");
    }
    batches::<C>(&q, &codes);
}

fn batches<C: QuaternionCodec>(q: &[[f32; 4]], codes: &[C::Code]) {
    let [x, y, z, w] = [0, 1, 2, 3].map(|i| q.iter().map(|q| q[i]).collect::<Vec<_>>());
    let soa = Soa4 { x: &x, y: &y, z: &z, w: &w };
    let [mut a, mut b, mut c, mut d] = [(); 4].map(|()| vec![C::Code::zeroed(); q.len()]);
    C::encode_soa(soa, &mut a).unwrap();
    C::encode_aos(q, &mut b).unwrap();
    C::encode_soa_precise(soa, &mut c).unwrap();
    C::encode_aos_precise(q, &mut d).unwrap();
    for (i, &q) in q.iter().enumerate() {
        assert_eq!([a[i], b[i]], [C::encode(q); 2], "{} {q:?}", C::NAME);
        assert_eq!([c[i], d[i]], [C::encode_precise(q); 2], "{} {q:?}", C::NAME);
    }
    let [mut x, mut y, mut z, mut w] = [(); 4].map(|()| vec![UNWRITTEN; codes.len()]);
    let soa = Soa4Mut { x: &mut x, y: &mut y, z: &mut z, w: &mut w };
    C::decode_soa(codes, soa).unwrap();
    let mut aos = vec![[UNWRITTEN; 4]; codes.len()];
    C::decode_aos(codes, &mut aos).unwrap();
    for (i, &code) in codes.iter().enumerate() {
        let q = C::decode(code);
        assert_eq!(bytes_of(&[x[i], y[i], z[i], w[i]]), bytes_of(&q), "{} {code:x?}", C::NAME);
        assert_eq!(bytes_of(&aos[i]), bytes_of(&q), "{} {code:x?}", C::NAME);
    }
}

fn check_format(format: QuaternionFormat, given: &[[u8; 16]], meaning: &dyn Fn(u64) -> Quaternion) {
    let size = format.code_size();
    // Searching lengths takes a while.
    for given in given.iter().take(if format.bits() > 40 { 1 } else { 4 }) {
        let q: [f32; 4] = pod_read_unaligned(given);
        let of = target(q);
        let [fast, precise] = [format.encode(q), format.encode_precise(q)];
        let [off, least] = [fast, precise].map(|code| chord(of, meaning(code)));
        let limit = |degrees: f64| 2.0 * (degrees.min(360.0).to_radians() / 4.0).sin();
        assert!(off <= limit(format.max_error_degrees()) + ROUNDING, "{format:?} {q:?}: {off}");
        assert!(least <= limit(format.max_error_precise_degrees()) + ROUNDING, "{format:?} {q:?}");
        assert!(least <= off + ROUNDING, "{format:?} {q:?}: fast {off}, precise {least}");
        assert_eq!(format.encode_precise(format.decode(precise)), precise, "{format:?} {q:?}");
        assert_eq!(format.canonical(precise), precise, "{format:?} {q:?}");

        let code: u64 = pod_read_unaligned(&given[..8]);
        let decoded = format.decode(code);
        let wide = decoded.map(f64::from);
        assert!(chord(wide, meaning(code)) < ROUNDING, "{format:?} {code:x}: {decoded:?}");
        assert!((length(wide) - 1.0).abs() <= 2.5e-7, "{format:?} {code:x}: {decoded:?}");
        let canonical = format.canonical(code);
        assert_eq!(format.encode_precise(decoded), canonical, "{format:?} {code:x}");
        let near = format.decode_near(code, q);
        assert!(near == decoded || near == decoded.map(|c| -c), "{format:?} {code:x}");

        // More than a block of lanes.
        let mut bytes = vec![0; 19 * size];
        let to = StridedMut { bytes: &mut bytes, offset: 0, stride: size, len: 19 };
        format.encode_strided(Strided::of(&[q; 19], 0), to).unwrap();
        assert!(bytes.chunks(size).all(|code| code == &fast.to_le_bytes()[..size]), "{q:?}");
        let mut back = [[0.0f32; 4]; 19];
        let from = Strided { bytes: &bytes, offset: 0, stride: size, len: 19 };
        format.decode_strided(from, StridedMut::of(&mut back, 0)).unwrap();
        assert_eq!(back, [format.decode(fast); 19], "{format:?} {q:?}");
    }
}
