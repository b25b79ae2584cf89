//! The texel that painters take for flat, 128, and texels beyond the rim, in each form that textures
//! have.

use unitpack::{
    Codec, Snorm8x3, XyOnly16, XyOnlyBiased16, XyOnlyNormalized16, XyOnlySnorm16, XyzBiased8x3,
    XyzUnorm8x3,
};
use unitpack_test::vectors::{angle, length, normalize, widen};

const FLAT: [f32; 3] = [0.0, 0.0, 1.0];

fn texel(x: u8, y: u8) -> u16 {
    u16::from_le_bytes([x, y])
}

fn degrees(a: [f32; 3], b: [f32; 3]) -> f64 {
    angle(widen(a), widen(b)).to_degrees()
}

#[track_caller]
fn assert_degrees(measured: f64, expected: f64) {
    assert!((measured - expected).abs() < 1e-4, "{measured}, not {expected}");
}

#[test]
fn where_128_is_zero_it_is_flat() {
    assert_eq!(XyzBiased8x3::decode([128, 128, 255]), FLAT);
    assert_eq!(XyOnlyBiased16::decode(texel(128, 128)), FLAT);
    // BC5_SNORM and RG8_SNORM.
    assert_eq!(XyOnlySnorm16::decode(texel(0, 0)), FLAT);
    for up in [FLAT, [0.0, 0.0, 7.0], [1e-9, -1e-9, 1.0]] {
        for encode in [XyzBiased8x3::encode, XyzBiased8x3::encode_precise] {
            assert_eq!(encode(up), [128, 128, 255]);
        }
        for encode in [XyOnlyBiased16::encode, XyOnlyBiased16::encode_precise] {
            assert_eq!(encode(up), texel(128, 128));
        }
        for encode in [XyOnlySnorm16::encode, XyOnlySnorm16::encode_precise] {
            assert_eq!(encode(up), 0);
        }
    }
}

/// In unorm, (c + 1) / 2, zero is between 127 and 128.
#[test]
fn in_unorm_128_is_a_third_of_a_degree_off() {
    // Two components of 1/255.
    let off = (2f64.sqrt() / 255.0).asin().to_degrees();
    assert_degrees(off, 0.3178);
    for flat in [
        XyzUnorm8x3::decode([128, 128, 255]),
        XyOnly16::decode(texel(128, 128)),
        XyOnlyNormalized16::decode(texel(128, 128)),
    ] {
        assert_degrees(degrees(flat, FLAT), off);
    }
    // Where UVs are mirrored, the tangent is, and so x: a seam.
    for [x, y, z] in [XyzUnorm8x3::decode([128, 128, 255]), XyOnly16::decode(texel(128, 128))] {
        assert_degrees(degrees([x, y, z], [-x, y, z]), 0.4494);
    }
    let [x, y, z] = XyOnlyBiased16::decode(texel(128, 128));
    assert_eq!(degrees([x, y, z], [-x, y, z]), 0.0);
}

/// Only the sign bits differ.
#[test]
fn biased_bytes_have_the_vectors_of_snorm() {
    for x in 0..=255u8 {
        for y in 0..=255 {
            let biased = XyOnlyBiased16::decode(texel(x, y));
            assert_eq!(biased, XyOnlySnorm16::decode(texel(x ^ 128, y ^ 128)));
            for z in [0, 1, 127, 128, 200, 255] {
                let biased = XyzBiased8x3::decode([x, y, z]);
                assert_eq!(biased, Snorm8x3::decode([x ^ 128, y ^ 128, z ^ 128]));
            }
        }
    }
    // 0 reads as 1, and -128 as -127.
    assert_eq!(XyOnlyBiased16::decode(texel(0, 128)), [-1.0, 0.0, 0.0]);
    assert_eq!(XyOnlySnorm16::decode(texel(0x80, 0)), [-1.0, 0.0, 0.0]);
    assert_eq!(XyzBiased8x3::decode([128, 0, 128]), [0.0, -1.0, 0.0]);
}

/// What a shader computes: z from the unit length, and `normalize`.
fn shaded([x, y]: [f64; 2]) -> [f64; 3] {
    normalize([x, y, (1.0 - x * x - y * y).max(0.0).sqrt()])
}

#[test]
fn all_texels_read_as_in_shaders() {
    let snorm = |c: u8| f64::from((c as i8).max(-127)) / 127.0;
    let biased = |c: u8| (f64::from(c.max(1)) - 128.0) / 127.0;
    let unorm = |c: u8| f64::from(c) / 255.0 * 2.0 - 1.0;
    for x in 0..=255 {
        for y in 0..=255 {
            for (decoded, shaded) in [
                (XyOnlySnorm16::decode(texel(x, y)), shaded([x, y].map(snorm))),
                (XyOnlyBiased16::decode(texel(x, y)), shaded([x, y].map(biased))),
                (XyOnlyNormalized16::decode(texel(x, y)), shaded([x, y].map(unorm))),
            ] {
                assert!(angle(widen(decoded), shaded) < 3e-7, "({x}, {y}): {decoded:?}");
            }
        }
    }
}

/// XYOnly16 keeps the smaller component where shaders divide by the length.
#[test]
fn beyond_the_rim_the_rules_differ_by_up_to_ten_degrees() {
    let off =
        |x, y| degrees(XyOnly16::decode(texel(x, y)), XyOnlyNormalized16::decode(texel(x, y)));
    // (255, 179) / 255: atan and asin of 179/255.
    let smaller = 179.0f64 / 255.0;
    assert_degrees(off(255, 217), (smaller.asin() - smaller.atan()).to_degrees());
    assert_degrees(off(255, 217), 9.5172);
    assert_degrees(off(255, 218), 9.8517);
    let mut greatest = 0.0f64;
    for x in 0..=255u8 {
        for y in 0..=255 {
            let [i, j] = [x, y].map(|c| 2 * i32::from(c) - 255);
            let off = off(x, y);
            // Inside, they are one.
            assert!(off == 0.0 || i * i + j * j > 255 * 255, "({x}, {y}): {off}");
            greatest = greatest.max(off);
        }
    }
    assert_degrees(greatest, 9.8517);
}

/// What is next to flat in all forms is nearer than a step.
#[test]
fn vectors_beside_flat_keep_their_side() {
    let tilted = [0.012f32, -0.02, 1.0];
    for decoded in [
        XyzBiased8x3::decode(XyzBiased8x3::encode_precise(tilted)),
        XyOnlyBiased16::decode(XyOnlyBiased16::encode(tilted)),
        XyOnlySnorm16::decode(XyOnlySnorm16::encode_precise(tilted)),
    ] {
        assert!(decoded[0] > 0.0 && decoded[1] < 0.0, "{decoded:?}");
        assert!((length(widen(decoded)) - 1.0).abs() < 2.5e-7);
        assert!(degrees(decoded, tilted) < 0.33, "{decoded:?}");
    }
}
