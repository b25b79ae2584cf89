//! Packing against models that go bit by bit.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::packing::*;
use unitpack::{CodeInt, LengthMismatch};
use unitpack_fuzz::Bytes;
use unitpack_test::codes::{natives, write_codes};
use unitpack_test::{Code, UNWRITTEN};

struct Dense {
    bits: u32,
    integer: u32,
    pack: fn(&[Code], &mut [u8]) -> Result<(), LengthMismatch>,
    unpack: fn(&[u8], &mut [Code]) -> Result<(), LengthMismatch>,
}

const fn dense<const BITS: u32, C: CodeInt>() -> Dense {
    Dense {
        bits: BITS,
        integer: 8 * size_of::<C>() as u32,
        pack: |codes, bytes| pack_dense::<BITS, C>(&natives(codes), bytes),
        unpack: |bytes, codes| {
            write_codes::<C, _>(codes, &mut |codes| unpack_dense::<BITS, C>(bytes, codes))
        },
    }
}

macro_rules! dense {
    ($($code:ty: $($bits:literal)*;)*) => { [$($(dense::<$bits, $code>(),)*)*] };
}

static DENSE: [Dense; 56] = dense! {
    u8: 1 2 3 4 5 6 7 8;
    u16: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16;
    u32: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16
        17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32;
};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let dense = bytes.choose(&DENSE);
    let words: Vec<u32> = bytes.rest::<4>().into_iter().map(u32::from_le_bytes).collect();
    check_dense(dense, &words);
    check_texels(&words);
    check_words(&words);
});

/// Bit `i` of a stream of bytes.
fn bit(bytes: &[u8], i: usize) -> bool {
    bytes[i / 8] >> (i % 8) & 1 == 1
}

fn check_dense(dense: &Dense, words: &[u32]) {
    let bits = dense.bits as usize;
    let of = format!("{bits} bits in {}", dense.integer);
    let codes: Vec<Code> =
        words.iter().map(|&word| Code::from(word & u32::MAX >> (32 - dense.integer))).collect();
    let len = (codes.len() * bits).div_ceil(8);
    assert_eq!(dense_len(dense.bits, codes.len()), len, "{of}");

    let mut bytes = vec![0xA5; len];
    (dense.pack)(&codes, &mut bytes).unwrap();
    for i in 0..8 * len {
        let expected = codes.get(i / bits).is_some_and(|code| code >> (i % bits) & 1 == 1);
        assert_eq!(bit(&bytes, i), expected, "{of}: bit {i} of {codes:x?} as {bytes:x?}");
    }

    // Any bytes, the spare bits too.
    for (byte, word) in bytes.iter_mut().rev().zip(words) {
        *byte ^= *word as u8;
    }
    let mut unpacked = vec![!0; codes.len()];
    (dense.unpack)(&bytes, &mut unpacked).unwrap();
    for (i, &code) in unpacked.iter().enumerate() {
        let expected = (0..bits).fold(0, |c, b| c | Code::from(bit(&bytes, i * bits + b)) << b);
        assert_eq!(code, expected, "{of}: code {i} of {bytes:x?}");
    }
}

/// Two snorm numbers of 12 bits, against f64.
fn check_texels(words: &[u32]) {
    let pairs: Vec<[f32; 2]> = words.windows(2).map(|w| [w[0], w[1]].map(f32::from_bits)).collect();
    let mut texels = vec![[0xA5; 3]; pairs.len()];
    pack_snorm12x2_slice(&pairs, &mut texels).unwrap();
    for (&pair, &texel) in pairs.iter().zip(&texels) {
        let [u, v] = pair.map(|x| {
            let x = if x.is_nan() { 0.0 } else { f64::from(x).clamp(-1.0, 1.0) };
            ((x * 2047.0).round_ties_even() + 2047.0) as u32
        });
        let expected = [u >> 4, (u & 15) << 4 | v >> 8, v & 255].map(|byte| byte as u8);
        assert_eq!(texel, expected, "{pair:?}");
        assert_eq!(pack_snorm12x2(pair), expected, "{pair:?}");
    }
    let texels: Vec<[u8; 3]> =
        words.iter().map(|w| [*w as u8, (w >> 8) as u8, (w >> 16) as u8]).collect();
    let mut pairs = vec![[UNWRITTEN; 2]; texels.len()];
    unpack_snorm12x2_slice(&texels, &mut pairs).unwrap();
    for (&texel, pair) in texels.iter().zip(pairs) {
        let [r, g, b] = texel.map(u32::from);
        let expected = [r << 4 | g >> 4, (g & 15) << 8 | b]
            .map(|field| ((f64::from(field) - 2047.0) / 2047.0).min(1.0) as f32);
        assert_eq!(pair, expected, "{texel:x?}");
        assert_eq!(unpack_snorm12x2(texel), expected, "{texel:x?}");
    }
}

/// Fields of a word, from the low bits up.
fn fields<const N: usize>(word: u32, widths: [u32; N]) -> [u32; N] {
    let mut first = 0;
    widths.map(|width| {
        let field = (0..width).map(|i| u32::from(word >> (first + i) & 1 == 1) << i).sum();
        first += width;
        field
    })
}

fn check_words(words: &[u32]) {
    let n = words.len();
    let tags: Vec<u8> = words.iter().map(|w| (w >> 7) as u8).collect();
    let triples: Vec<[u16; 3]> = words
        .iter()
        .map(|&w| [w as u16, (w >> 16) as u16, (w.wrapping_mul(0x9E37_79B9) >> 16) as u16])
        .collect();

    let (mut tagged, mut tens, mut elevens) = (vec![!0; n], vec![!0; n], vec![!0; n]);
    pack_tag_slice(words, &tags, &mut tagged).unwrap();
    pack_10_10_10_2_slice(&triples, &tags, &mut tens).unwrap();
    pack_11_11_10_slice(&triples, &mut elevens).unwrap();
    for i in 0..n {
        let tag = u32::from(tags[i]);
        let [x, y, z] = triples[i].map(u32::from);
        let low = |field, width| fields(field, [width])[0];
        assert_eq!(fields(tagged[i], [30, 2]), [low(words[i], 30), low(tag, 2)]);
        let ten = [low(x, 10), low(y, 10), low(z, 10), low(tag, 2)];
        assert_eq!(fields(tens[i], [10, 10, 10, 2]), ten);
        assert_eq!(fields(elevens[i], [11, 11, 10]), [low(x, 11), low(y, 11), low(z, 10)]);
        assert_eq!(pack_tag(words[i], tags[i]), tagged[i]);
        assert_eq!(pack_10_10_10_2(triples[i], tags[i]), tens[i]);
        assert_eq!(pack_11_11_10(triples[i]), elevens[i]);
    }

    let (mut codes, mut tags, mut triples) = (vec![!0; n], vec![!0; n], vec![[!0; 3]; n]);
    unpack_tag_slice(words, &mut codes, &mut tags).unwrap();
    for (i, &word) in words.iter().enumerate() {
        assert_eq!([codes[i], tags[i].into()], fields(word, [30, 2]));
        assert_eq!(unpack_tag(word), (codes[i], tags[i]));
    }
    tags.fill(!0);
    unpack_10_10_10_2_slice(words, &mut triples, &mut tags).unwrap();
    for (i, &word) in words.iter().enumerate() {
        let [x, y, z] = triples[i].map(u32::from);
        assert_eq!([x, y, z, tags[i].into()], fields(word, [10, 10, 10, 2]));
        assert_eq!(unpack_10_10_10_2(word), (triples[i], tags[i]));
    }
    unpack_11_11_10_slice(words, &mut triples).unwrap();
    for (i, &word) in words.iter().enumerate() {
        assert_eq!(triples[i].map(u32::from), fields(word, [11, 11, 10]));
        assert_eq!(unpack_11_11_10(word), triples[i]);
    }
}
