//! Every entry point of a codec gives the same bits, with any number of lanes. The functions for
//! one vector, which run on one lane, are the measure of the others:
//!
//! - for all formats, the slices of `Format`;
//! - for one format of each family and width of code, the slices of its type: structures of arrays,
//!   arrays of structures, transcoding.
//!
//! `PROPTEST_CASES=20000 cargo test entry_points_agree` searches for longer.

mod buffers;
mod checks;
mod formats;
mod generators;
mod lengths;

use std::ops::Range;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use unitpack::{Codec, Format, Oct16};
use unitpack_test::codes::last_pattern;
use unitpack_test::random::Rng;
use unitpack_test::vectors::bits;
use unitpack_test::{AnyCodec, Code, Effort, Typed, Vector, representatives, transcodes};

use buffers::MARGIN;
use checks::{decoders_give, encoders_give, transcoder_agrees, transcoders_agree};
use generators::{batch, pattern, patterns, sample, special};

/// As much of each pattern as a code has.
fn cut(format: Format, patterns: &[Code]) -> Vec<Code> {
    patterns.iter().map(|pattern| pattern & last_pattern(format)).collect()
}

#[test]
fn one_format_of_each_family_and_width_is_checked_by_type() {
    assert!(Typed::all().map(|typed| typed.format).eq(representatives::all()));
    let of_width = |size| representatives::all().filter(move |f| f.code_size() == size);
    assert!(Format::ALL.iter().all(|f| of_width(f.code_size()).next().is_some()));
    let snorm = [Format::Snorm8x3, Format::Snorm10x3, Format::Snorm11_11_10];
    assert_eq!(snorm.map(representatives::beside), snorm);
    let alike = [Format::Oct32, Format::LatLong24D, Format::AngularCube16];
    let first = [Format::Oct18, Format::LatLong24D, Format::AngularCube9];
    assert_eq!(alike.map(representatives::beside), first);
}

/// Past one buffer of 256 vectors on the stack, or several of 64, too.
fn lengths() -> impl Iterator<Item = usize> {
    (0..=67).chain([128, 131, 261])
}

/// Enough that every length and offset has other vectors in its lanes.
const POOL: usize = 271;

/// Where in the pool the vectors for a length and offset are.
fn part(len: usize, offset: usize) -> Range<usize> {
    let start = (len + 8 * offset) % (POOL - len);
    start..start + len
}

/// At how many offsets of [`MARGIN`] one is taken: of the fast encoders and the decoders all, since
/// they matter to the loops, which the formats of a family and width share. Others take another one
/// at each length.
fn every_offset(format: Format, effort: Effort) -> usize {
    if representatives::contains(format) && effort == Effort::Fast { 1 } else { MARGIN }
}

#[test]
fn encoders_agree_at_every_length_and_offset() -> TestCaseResult {
    let pool = sample(vec(special(), POOL));
    for codec in AnyCodec::all() {
        for effort in Effort::BOTH {
            let alone = codec.encode_each(effort, &pool);
            let every = every_offset(codec.format, effort);
            // The finest grids take up to 200 us a vector.
            let slow = effort == Effort::Precise && codec.format.bits() > 32;
            for len in lengths().filter(|len| !slow || len % 5 == 1) {
                for offset in (len % every..MARGIN).step_by(every) {
                    let part = part(len, offset);
                    encoders_give(codec, effort, &pool[part.clone()], offset, &alone[part])?;
                }
            }
        }
    }
    Ok(())
}

#[test]
fn decoders_agree_at_every_length_and_offset() -> TestCaseResult {
    let pool = sample(vec(pattern(), POOL));
    for codec in AnyCodec::all() {
        let codes = cut(codec.format, &pool);
        let alone = codec.decode_each(&codes);
        let every = every_offset(codec.format, Effort::Fast);
        for len in lengths() {
            for offset in (len % every..MARGIN).step_by(every) {
                let part = part(len, offset);
                decoders_give(codec, &codes[part.clone()], offset, &alone[part.clone()])?;
                if let Some(typed) = Typed::of(codec.format) {
                    transcoders_agree(typed, &codes[part], offset)?;
                }
            }
        }
    }
    Ok(())
}

#[test]
fn transcoders_agree_between_all_types_of_code() -> TestCaseResult {
    let pool = sample(vec(pattern(), POOL));
    for transcode in transcodes() {
        let codes = cut(transcode.from, &pool);
        for len in [0, 1, 17, 64, 65, POOL] {
            transcoder_agrees(&transcode, &codes[..len], len % MARGIN)?;
        }
    }
    Ok(())
}

/// Up to eight components are rearranged in vectors, more are not. What is beyond three stays as it
/// is.
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

/// The codecs whose codes are directions. The others give the input back.
fn of_directions() -> impl Iterator<Item = &'static AnyCodec> {
    AnyCodec::all().filter(|codec| codec.stores_direction())
}

fn same_code(codec: &AnyCodec, v: Vector, plain: Vector) -> TestCaseResult {
    for effort in Effort::BOTH {
        let [got, expected] = [v, plain].map(|v| codec.encode_with(effort, v));
        prop_assert!(
            got == expected,
            "{} {effort:?}: {v:?} {:x?} is {got:x?}, but {plain:?} {:x?} is {expected:x?}",
            codec.format,
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
    of_directions().try_for_each(|codec| same_code(codec, scaled, v))
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
    for codec in of_directions() {
        for &v in v {
            same_code(codec, v, meant(codec.format, v))?;
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
        for codec in AnyCodec::all() {
            for effort in Effort::BOTH {
                let codes = codec.encode_each(effort, &v);
                encoders_give(codec, effort, &v, offset, &codes)?;
                decoders_give(codec, &codes, offset, &codec.decode_each(&codes))?;
            }
        }
    }

    #[test]
    fn entry_points_agree_on_any_codes(patterns in patterns(), offset in 0..MARGIN) {
        for codec in AnyCodec::all() {
            let codes = cut(codec.format, &patterns);
            decoders_give(codec, &codes, offset, &codec.decode_each(&codes))?;
            if let Some(typed) = Typed::of(codec.format) {
                transcoders_agree(typed, &codes, offset)?;
            }
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
        for codec in AnyCodec::all() {
            let format = codec.format;
            let used = Code::MAX >> (128 - format.bits());
            for (&v, effort) in v.iter().flat_map(|v| Effort::BOTH.map(|effort| (v, effort))) {
                let code = codec.encode_with(effort, v);
                prop_assert!(code & !used == 0, "{format} {effort:?} {v:?}: {code:#x}");
            }
            for code in cut(format, &patterns) {
                let [all, used] = [code, code & used].map(codec.decode);
                prop_assert!(bits(all) == bits(used), "{format} {code:#x}: {all:?}, not {used:?}");
            }
        }
    }
}
