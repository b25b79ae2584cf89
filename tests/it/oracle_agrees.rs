//! Every codec against the oracle of `unitpack_test`, which computes in `f64` what the definitions
//! say.

use unitpack::{Codec, Format, HemiOct16, Oct16, Oct24, Snorm8x3, Snorm11_11_10, XyOnly32F};
use unitpack_test::codes::{decode, encode, encode_precise, last_pattern, random_codes};
use unitpack_test::every_code::DECODE_ERROR;
use unitpack_test::oracle::{self, Oracle, oracle};
use unitpack_test::random::{mixed_vectors, special_vectors};
use unitpack_test::tasks::check_all;
use unitpack_test::vectors::{angle, dot, widen};

/// By how much, in radians, rounding may mislead an encoder that compares distances in f32.
const SLACK: f64 = 2.5e-7;

/// Every format whose codes stand for directions. `Float32x3` keeps what it is given and has a test
/// of its own.
fn directions() -> Vec<(Format, Oracle)> {
    let formats = Format::ALL.iter().filter(|&&f| f != Format::Float32x3);
    formats.map(|&f| (f, oracle(f.name()))).collect()
}

/// Takes at most `count` evenly from `all`.
fn thin<T: Copy>(all: &[T], count: usize) -> Vec<T> {
    all.iter().step_by(all.len().div_ceil(count)).copied().collect()
}

#[test]
fn every_format_has_an_oracle() {
    for format in Format::ALL {
        oracle(format.name());
    }
    for unknown in ["oct", "oct16D", "latlong", "stereo+square16"] {
        assert!(oracle::find(unknown).is_none(), "{unknown}");
    }
}

#[test]
fn decoding_agrees() {
    check_all(&directions(), |(format, oracle)| {
        let codes = match format.code_size() {
            1 | 2 => (0..=last_pattern(*format)).collect(),
            _ => random_codes(*format, 1, 300_000),
        };
        let mut worst = (0.0, 0, [0.0; 3]);
        for (&code, v) in codes.iter().zip(decode(*format, &codes)) {
            let off = angle(widen(v), oracle.decode(code));
            if off > worst.0 {
                worst = (off, code, v);
            }
        }
        let (off, code, v) = worst;
        eprintln!("{format}: decode is off by at most {off:.2e} rad");
        if off <= DECODE_ERROR {
            Ok(())
        } else {
            Err(format!(
                "{format}: {code:#x} decodes to {v:?}, not {:?}: {off:.2e} rad off",
                oracle.decode(code)
            ))
        }
    });
}

/// The fast encoder rounds each parameter. Where `f32` can tell it from a tie there is one right
/// code; within `params_error` of a tie (5e-7 of the range, so less than 1e-3 of a step up to 11
/// bits a parameter and 0.02 at 16), either neighbour is right.
#[test]
fn fast_encoding_agrees() {
    let vectors = mixed_vectors(2, 200_000);
    check_all(&directions(), |(format, oracle)| {
        let mut failures = 0;
        let mut first = String::new();
        let mut ties = 0;
        for (v, code) in vectors.iter().zip(encode(*format, &vectors)) {
            let right = oracle.encodings(oracle.target(*v));
            ties += usize::from(right.len() > 1);
            if !right.contains(&code) {
                if failures == 0 {
                    first = format!("{v:?} encodes to {code:#x}, not {right:x?}");
                }
                failures += 1;
            }
        }
        eprintln!("{format}: {ties} of {} vectors are near a tie", vectors.len());
        if failures == 0 {
            Ok(())
        } else {
            Err(format!("{format}: {failures} wrong, first: {first}"))
        }
    });
}

/// How many vectors to look at: the search in the oracle, and in the encoder of the widest formats,
/// is slow. In snorm8x3 rounding misses the nearest code for so few vectors that it takes many to
/// see.
fn nearest_count(format: Format) -> usize {
    match format.name() {
        "snorm16x3" | "xyz-unorm16x3" => 400,
        "float16x3" | "snorm12x3" => 2_000,
        "snorm8x3" => 100_000,
        // Each with every code.
        _ if format.bits() <= 16 => 1_000,
        _ => 8_000,
    }
}

/// Where simpler encoders missed the nearest code: in a coarse lattice, beside a diagonal of it, at
/// the rim, in the corners of the ellipse's square, and half way between points far apart.
const HARD: [[f32; 3]; 14] = [
    [-0.5464705, 0.6048495, 0.57924694],
    [-0.6650616, 0.33451542, -0.667677],
    [-0.7019101, -0.7011718, -0.1252212],
    [-0.99999994, -1.0, 2.0],
    [-0.7101852, 0.70401484, 8.716084e-5],
    [0.70265913, -0.7115266, -0.0001195407],
    [-0.7103609, 0.70383763, 3.9055485e-7],
    [0.7059746, 0.7082372, -3.4672305e-6],
    [0.70861953, -0.7055908, 3.0971965e-5],
    [-0.7034997, 0.71069556, -5.9495742e-5],
    [-0.99413264, 0.99999887, 1.8724366e-8],
    [0.9954581, 0.9998165, -8.183487e-5],
    [1.0003296, 1.000141, -1.0000025],
    [-0.99999946, 1.0, 0.9999996],
];

#[test]
fn precise_encoding_is_nearest() {
    let mixed = mixed_vectors(3, 120_000);
    check_all(&directions(), |(format, oracle)| {
        let vectors = [HARD.to_vec(), thin(&mixed, nearest_count(*format))].concat();
        let all: Vec<_> = match format.bits() {
            bits @ ..=16 => (0..1 << bits).map(|code| oracle.decode(code)).collect(),
            _ => Vec::new(),
        };
        let mut worst = (0.0, String::new());
        for (v, code) in vectors.iter().zip(encode_precise(*format, &vectors)) {
            let target = oracle.target(*v);
            let least = if all.is_empty() {
                oracle.nearest_angle(target)
            } else {
                let cosine = all.iter().map(|&w| dot(w, target)).fold(-1.0, f64::max);
                // Half a chord is exact where a cosine near 1 is not.
                2.0 * ((1.0 - cosine).max(0.0) / 2.0).sqrt().asin()
            };
            let excess = angle(oracle.decode(code), target) - least;
            if excess > worst.0 {
                worst = (
                    excess,
                    format!(
                        "{v:?} encodes to {code:#x}, {excess:.2e} rad further than {least:.3e}"
                    ),
                );
            }
        }
        eprintln!("{format}: precise is at most {:.2e} rad further than the nearest", worst.0);
        if worst.0 <= SLACK { Ok(()) } else { Err(format!("{format}: {}", worst.1)) }
    });
}

#[test]
fn float32x3_keeps_the_bits() {
    let vectors = special_vectors();
    for encode in [encode, encode_precise] {
        let codes = encode(Format::Float32x3, &vectors);
        for ((v, w), code) in vectors.iter().zip(decode(Format::Float32x3, &codes)).zip(codes) {
            let [x, y, z] = v.map(|c| u128::from(c.to_bits()));
            assert_eq!(code, x | y << 32 | z << 64);
            assert_eq!(v.map(f32::to_bits), w.map(f32::to_bits));
        }
    }
}

#[test]
fn first_parameter_stands_in_the_low_bits() {
    // Rg8Snorm: the byte pair [x, y].
    assert_eq!(Oct16::encode([0.0, -1.0, 0.0]).to_le_bytes(), [0, 0x81]);
    assert_eq!(Oct16::encode([1.0, 0.0, 1.0]).to_le_bytes(), [0x40, 0]);
    assert_eq!(HemiOct16::encode([1.0, 0.0, 0.0]).to_le_bytes(), [127, 127]);
    assert_eq!(HemiOct16::encode([0.0, 1.0, 0.0]).to_le_bytes(), [127, 0x81]);
    // x in the low bits, each field two's complement.
    assert_eq!(Snorm8x3::encode([-1.0, 0.0, 0.0]), [0x81, 0, 0]);
    assert_eq!(Snorm8x3::encode([0.0, 0.0, 1.0]), [0, 0, 127]);
    assert_eq!(Snorm11_11_10::encode([1.0, 0.0, 0.0]), 0x3FF);
    assert_eq!(Snorm11_11_10::encode([0.0, 1.0, 0.0]), 0x3FF << 11);
    assert_eq!(Snorm11_11_10::encode([0.0, 0.0, -1.0]), 0x201 << 22);
    assert_eq!(XyOnly32F::encode([-1.0, 0.0, 0.0]), 0xBC00);
    assert_eq!(XyOnly32F::encode([0.0, 1.0, 0.0]), 0x3C00 << 16);
}

#[test]
fn wide_pairs_are_the_rgb8_bytes_of_the_survey() {
    // Biased by 2047: +Z is (2047, 2047) = 0x7FF, 0x7FF.
    assert_eq!(Oct24::encode([0.0, 0.0, 1.0]), [0x7F, 0xF7, 0xFF]);
    // +X is (4094, 2047) = 0xFFE, 0x7FF; -Y is (2047, 0).
    assert_eq!(Oct24::encode([1.0, 0.0, 0.0]), [0xFF, 0xE7, 0xFF]);
    assert_eq!(Oct24::encode([0.0, -1.0, 0.0]), [0x7F, 0xF0, 0x00]);
    // 4095 is out of range and reads as 4094.
    assert_eq!(Oct24::decode([0xFF, 0xF7, 0xFF]), [1.0, 0.0, 0.0]);
}

#[test]
fn ties_go_to_even() {
    // On the octahedron |x| + |y| + |z| = 2 x 127, half the components are the parameters.
    assert_eq!(Oct16::encode([1.0, 3.0, 250.0]).to_le_bytes(), [0, 2]);
    assert_eq!(Oct16::encode([5.0, -7.0, 242.0]).to_le_bytes(), [2, 4u8.wrapping_neg()]);
    assert_eq!(HemiOct16::encode([2.0, 1.0, 251.0]).to_le_bytes(), [2, 0]);
    assert_eq!(HemiOct16::encode([4.0, 1.0, 249.0]).to_le_bytes(), [2, 2]);
}

/// Then the nearest point of a vector is a corner of the triangle around it.
#[test]
fn no_triangle_of_an_octahedral_lattice_is_obtuse() {
    // Of the triangles with these corners, how many are.
    let obtuse = |name: &str, bits: u32, corners: [[i64; 2]; 3]| {
        let oracle = oracle(name);
        let m = (1i64 << (bits / 2 - 1)) - 1;
        let point = |i: i64, j: i64| oracle.decode((i | j << (bits / 2)) as u128);
        let places = (0..m).flat_map(|i| (0..m - i).map(move |j| [i, j]));
        let triangles = places.map(|[i, j]| corners.map(|[a, b]| [i + a, j + b]));
        let whole = triangles.filter(|corners| corners.iter().all(|[i, j]| i + j <= m));
        whole.map(|corners| corners.map(|[i, j]| point(i, j))).filter(is_obtuse).count()
    };
    let (upright, turned) = ([[0, 0], [1, 0], [0, 1]], [[1, 0], [0, 1], [1, 1]]);
    for family in ["oct", "warpedoct", "eqareaoct"] {
        for bits in [16, 22] {
            let name = format!("{family}{bits}");
            assert_eq!([upright, turned].map(|t| obtuse(&name, bits, t)), [0; 2], "{name}");
        }
        // Halves of the same cells, cut the other way.
        assert!(obtuse(&format!("{family}16"), 16, [[0, 0], [1, 0], [1, 1]]) > 7000, "{family}");
    }
}

fn is_obtuse(corners: &[[f64; 3]; 3]) -> bool {
    (0..3).any(|at| {
        let [a, b, c] = [0, 1, 2].map(|k| corners[(at + k) % 3]);
        dot([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k])) < 0.0
    })
}
