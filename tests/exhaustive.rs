//! What decoding and the canonical codes promise. Every code of every format of up to 24 bits is
//! decoded, and of up to 20 bits encoded again; beyond, [`stride`] codes apart or a sample.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use crate::common::oracle::oracle;
use crate::common::*;
use unitpack::Format;

/// By how much the length of a decoded vector may differ from 1.
const LENGTH_ERROR: f64 = 2.5e-7;
/// Below this, `f32` vectors are one direction.
const SAME_DIRECTION: f64 = 3e-7;

/// How many codes one task looks at.
const CHUNK: u128 = 1 << 19;

/// `Float32x3` gives back what it is given, of any length.
fn formats() -> impl Iterator<Item = Format> {
    Format::ALL.iter().copied().filter(|&f| f != Format::Float32x3)
}

/// Of the formats of 22 to 24 bits, every code is decoded, but only so many codes apart are they
/// encoded again: all where the encoder is fast, and else as the time allows. An odd prime, so that all
/// values of every field are met.
fn stride(format: Format) -> usize {
    match format.name() {
        _ if format.bits() <= 20 || format.bits() > 24 => 1,
        "oct22" | "oct24" | "spherical22" | "spherical24" | "HemiOct24" => 1,
        "snorm8x3" | "xyz-unorm8x3" | "CrytekBFN24" => 31,
        _ if format.bits() <= 22 => 3,
        _ => 13,
    }
}

/// How many codes to sample of a format that has too many: fewer where the precise encoder is slow.
fn sample_size(format: Format) -> usize {
    match format.name() {
        "snorm16x3" | "xyz-unorm16x3" => 20_000,
        "float16x3" => 50_000,
        "snorm10x3" | "snorm11-11-10" => 200_000,
        _ => 1_000_000,
    }
}

/// Codes to look at, in chunks.
enum Codes {
    From(u128),
    Sample(u64, usize),
}

impl Codes {
    fn all_of(format: Format) -> Vec<Codes> {
        if format.bits() <= 24 {
            (0..1 << format.bits()).step_by(CHUNK as usize).map(Codes::From).collect()
        } else {
            let tasks = 8;
            (0..tasks)
                .map(|seed| Codes::Sample(seed, sample_size(format) / tasks as usize))
                .collect()
        }
    }

    fn list(&self, format: Format) -> Vec<u128> {
        match *self {
            Codes::From(first) => (first..(first + CHUNK).min(1 << format.bits())).collect(),
            Codes::Sample(seed, count) => random_codes(format, seed, count),
        }
    }
}

/// Decodes every code, and encodes those [`stride`] apart again. What comes back the same is
/// canonical; for what does not, goes round once more.
fn check_codes(format: Format, codes: &[u128]) -> Result<(), String> {
    let oracle = oracle(format.name()).unwrap();
    let vectors = decode(format, codes);
    for (code, v) in codes.iter().zip(&vectors) {
        let off = (length(widen(*v)) - 1.0).abs();
        if off.is_nan() || off > LENGTH_ERROR {
            return Err(format!(
                "{format}: {code:#x} decodes to {v:?}, off by {off:.2e} in length"
            ));
        }
    }
    let first = codes[0] as usize;
    let stride = stride(format);
    let apart = (first.next_multiple_of(stride) - first..codes.len()).step_by(stride);
    let (codes, vectors): (Vec<_>, Vec<_>) = apart.map(|i| (codes[i], vectors[i])).unzip();
    let once = encode_precise(format, &vectors);
    let moved: Vec<_> = (0..codes.len()).filter(|&i| once[i] != codes[i]).collect();
    let moved_to: Vec<_> = moved.iter().map(|&i| once[i]).collect();
    let vectors_again = decode(format, &moved_to);
    let twice = encode_precise(format, &vectors_again);
    for (((i, once), w), twice) in moved.into_iter().zip(moved_to).zip(vectors_again).zip(twice) {
        let (code, v) = (codes[i], vectors[i]);
        if once >> format.bits() != 0 {
            return Err(format!("{format}: {v:?} encodes to {once:#x}, with unused bits set"));
        }
        if angle(widen(v), widen(w)) > SAME_DIRECTION {
            return Err(format!("{format}: {code:#x} = {v:?} comes back as {once:#x} = {w:?}"));
        }
        if once != twice {
            return Err(format!("{format}: {code:#x} = {v:?} is {once:#x} and then {twice:#x}"));
        }
    }
    // In wider formats, f32 takes directions for one that the exact rule tells apart.
    let exact = format.bits() <= 32;
    let wrong =
        codes.iter().zip(&once).find(|&(&code, &once)| exact && once != oracle.canonical(code));
    match wrong {
        None => Ok(()),
        Some((&code, once)) => {
            let right = oracle.canonical(code);
            Err(format!("{format}: {code:#x} comes back as {once:#x}, not {right:#x}"))
        }
    }
}

#[test]
fn codes_decode_to_unit_vectors_and_back() {
    let chunks = |format| Codes::all_of(format).into_iter().map(move |codes| (format, codes));
    let tasks: Vec<_> = formats().flat_map(chunks).collect();
    let times: Vec<_> = Format::ALL.iter().map(|_| AtomicU64::new(0)).collect();
    let failures = failures(&tasks, |(format, codes)| {
        let start = Instant::now();
        let result = check_codes(*format, &codes.list(*format));
        times[*format as usize].fetch_add(start.elapsed().as_nanos() as u64, Ordering::Relaxed);
        result
    });
    for format in formats() {
        let time = Duration::from_nanos(times[format as usize].load(Ordering::Relaxed));
        eprintln!("{format}: {:.2} s", time.as_secs_f64());
    }
    assert!(failures.is_empty(), "{} chunks failed:\n{}", failures.len(), failures.join("\n"));
}

/// What an encoder gave is decoded and encoded again.
fn check_canonical(encode: fn(Format, &[[f32; 3]]) -> Vec<u128>, count: usize) {
    let vectors = mixed_vectors(4, count);
    let all: Vec<_> = formats().collect();
    check_all(&all, |&format| {
        // The precise encoders of the finest grids are slow.
        let vectors = if format.bits() > 32 { &vectors[..4_000] } else { &vectors[..] };
        let codes = encode(format, vectors);
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
    check_canonical(encode, 200_000);
}

#[test]
fn precise_codes_are_canonical() {
    check_canonical(encode_precise, 40_000);
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
