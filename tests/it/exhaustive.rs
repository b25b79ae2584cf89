//! What decoding and the canonical codes promise: for every code of every format of up to 20 bits,
//! for some blocks of the formats of up to 32, and for a sample of the wider ones.
//!
//! `tools/proof` looks at every code of up to 32 bits, and an ignored test at those of up to 24.

use unitpack::Format;
use unitpack_test::codes::{decode, encode_precise, encode_with, random_codes};
use unitpack_test::every_code::{self, BLOCK, LENGTH_ERROR};
use unitpack_test::oracle::oracle;
use unitpack_test::random::{Rng, mixed_vectors};
use unitpack_test::tasks::check_all;
use unitpack_test::vectors::{angle, length, widen};
use unitpack_test::{AnyCodec, Code, Effort};

/// Below this, `f32` vectors are one direction.
const SAME_DIRECTION: f64 = 3e-7;

/// How many codes one task looks at.
const CHUNK: u64 = 1 << 16;

/// `Float32x3` gives back what it is given, of any length.
fn formats() -> impl Iterator<Item = Format> {
    Format::ALL.iter().copied().filter(|&f| f != Format::Float32x3)
}

fn check_codes(format: Format, first: u64, count: u64) -> Result<(), String> {
    // Encoding alone takes several times as long.
    let every = if format.bits() <= 20 { 1 } else { 13 };
    let oracle = oracle(format.name());
    every_code::check(format, &oracle, first, count, every).map(|_| ())
}

/// Looks at all codes of the formats of so many bits, or at one chunk in `every` of each.
fn check_formats(bits: std::ops::RangeInclusive<u32>, every: u64) {
    let chunks = |format: Format| {
        let codes = 1 << format.bits();
        let chunks = (0..codes).step_by(CHUNK as usize).map(move |at| (at, CHUNK.min(codes - at)));
        // Of each format other ones.
        let taken = chunks.skip(format as usize % every as usize).step_by(every as usize);
        taken.map(move |(first, count)| (format, first, count))
    };
    let tasks: Vec<_> = formats().filter(|f| bits.contains(&f.bits())).flat_map(chunks).collect();
    check_all(&tasks, |&(format, first, count)| check_codes(format, first, count));
}

#[test]
fn every_code_of_up_to_20_bits() {
    check_formats(0..=20, 1);
}

#[test]
fn one_code_in_eight_of_21_to_24_bits() {
    check_formats(21..=24, 8);
}

#[test]
#[ignore = "takes a minute and a half of processor time; .ci/run runs it"]
fn every_code_of_21_to_24_bits() {
    check_formats(21..=24, 1);
}

#[test]
fn blocks_of_codes_of_up_to_32_bits() {
    let blocks = |format: Format| {
        let count = (1 << format.bits()) / BLOCK;
        let mut rng = Rng::new(format as u64);
        let random = (0..60).map(|_| rng.below(count)).collect::<Vec<_>>();
        let all = [0, count / 2, count - 1].into_iter().chain(random);
        all.map(move |block| (format, block * BLOCK))
    };
    let some = formats().filter(|f| (25..=32).contains(&f.bits()));
    let tasks: Vec<_> = some.flat_map(blocks).collect();
    check_all(&tasks, |&(format, first)| check_codes(format, first, BLOCK));
}

fn canonical(format: Format, codes: &[Code]) -> Vec<Code> {
    let canonical = AnyCodec::of(format).canonical;
    codes.iter().map(|&code| canonical(code)).collect()
}

/// Past the equator, a point of a plain chart may have the very `f32` vector of one of the other
/// hemisphere's: that is canonical.
#[test]
fn codes_that_coincide_in_f32_have_one_canonical_code() {
    let pairs = [
        (Format::Stereo32, 0x9081_006D, 0xC020_E46C),
        (Format::EqArea32, 0x60B0_00A6, 0x3410_E21D),
        (Format::EqDist32, 0x68F0_09AB, 0x48E5_E5BE),
    ];
    for (format, past, own) in pairs {
        let vectors = decode(format, &[past, own]);
        assert_eq!(vectors[0].map(f32::to_bits), vectors[1].map(f32::to_bits), "{format}");
        assert_eq!(encode_precise(format, &vectors), [own, own], "{format}");
        assert_eq!(canonical(format, &[past, own]), [own, own], "{format}");
        // Not so in exact arithmetic.
        assert_eq!(oracle(format.name()).canonical(past), past, "{format}");
    }
}

/// In formats that are finer than `f32`, what decodes alike is one direction, and one code is
/// canonical: a second time round, nothing moves.
fn check_wide(format: Format, codes: &[Code]) -> Result<(), String> {
    let vectors = decode(format, codes);
    let once = encode_precise(format, &vectors);
    let vectors_again = decode(format, &once);
    let twice = encode_precise(format, &vectors_again);
    let canonical = canonical(format, codes);
    for i in 0..codes.len() {
        let (code, v, w) = (codes[i], vectors[i], vectors_again[i]);
        let off = (length(widen(v)) - 1.0).abs();
        if off.is_nan() || off > LENGTH_ERROR {
            return Err(format!("{format}: {code:#x} is {v:?}, off by {off:.2e} in length"));
        }
        if once[i] >> format.bits() != 0 {
            return Err(format!("{format}: {v:?} is encoded as {:#x}, with unused bits", once[i]));
        }
        if angle(widen(v), widen(w)) > SAME_DIRECTION {
            return Err(format!(
                "{format}: {code:#x} = {v:?} comes back as {:#x} = {w:?}",
                once[i]
            ));
        }
        if once[i] != twice[i] || once[i] != canonical[i] {
            let [once, twice, canonical] = [once[i], twice[i], canonical[i]];
            return Err(format!("{format}: {code:#x} is {once:#x}, {twice:#x} or {canonical:#x}"));
        }
    }
    Ok(())
}

#[test]
fn some_codes_of_more_bits() {
    let wide = formats().filter(|f| f.bits() > 32);
    let tasks: Vec<_> = wide.flat_map(|f| (0..8).map(move |seed| (f, seed))).collect();
    assert_eq!(tasks.len(), 4 * 8);
    check_all(&tasks, |&(format, seed)| {
        // The precise encoder is slow.
        check_wide(format, &random_codes(format, seed, 2_500))
    });
}

/// What an encoder gave is decoded and encoded again.
fn check_canonical(effort: Effort, count: usize) {
    let vectors = mixed_vectors(4, count);
    let all: Vec<_> = formats().collect();
    check_all(&all, |&format| {
        // The precise encoders of the finest grids are slow.
        let vectors = if format.bits() > 32 { &vectors[..4_000] } else { &vectors[..] };
        let codes = encode_with(format, effort, vectors);
        let again = encode_precise(format, &decode(format, &codes));
        let different = |&i: &usize| codes[i] != again[i];
        match (0..codes.len()).find(different) {
            None => Ok(()),
            Some(i) => {
                let count = (0..codes.len()).filter(different).count();
                let (v, code, again) = (vectors[i], codes[i], again[i]);
                Err(format!(
                    "{format}: {count} not canonical, first {v:?} = {code:#x}, which is {again:#x}"
                ))
            }
        }
    });
}

#[test]
fn fast_codes_are_canonical() {
    check_canonical(Effort::Fast, 200_000);
}

#[test]
fn precise_codes_are_canonical() {
    check_canonical(Effort::Precise, 40_000);
}

#[test]
fn unused_bits_are_ignored() {
    let spare: Vec<_> = formats().filter(|f| f.bits() < 8 * f.code_size() as u32).collect();
    assert!(spare.contains(&Format::Oct18) && spare.contains(&Format::Snorm5x3));
    check_all(&spare, |&format| {
        let codes = random_codes(format, 5, 100_000);
        let used: Vec<_> = codes.iter().map(|code| code & ((1 << format.bits()) - 1)).collect();
        if decode(format, &codes) == decode(format, &used) {
            Ok(())
        } else {
            Err(format!("{format}: bits above {} say something", format.bits()))
        }
    });
}
