//! What an entry point gives, compared with what the functions of one vector give.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use unitpack_test::codes::{decode_slice, encode_slice, to_bytes};
use unitpack_test::vectors::bits;
use unitpack_test::{AnyCodec, Code, Effort, Place, Transcode, Typed, UNWRITTEN, Vector};

use super::buffers::{Columns, MARGIN, SENTINEL, all_bits, sentinel, surrounded, widened};

/// The position of the first difference.
fn difference<T: PartialEq>(a: &[T], b: &[T]) -> Option<usize> {
    a.iter()
        .zip(b)
        .position(|(a, b)| a != b)
        .or((a.len() != b.len()).then_some(a.len().min(b.len())))
}

/// Every encoder of slices gives `expected`, and writes nowhere else.
pub fn encoders_give(
    codec: &AnyCodec,
    effort: Effort,
    v: &[Vector],
    offset: usize,
    expected: &[Code],
) -> TestCaseResult {
    let format = codec.format;
    let columns = Columns::new(v, offset);

    // Bytes start at any byte.
    let bytes = to_bytes(format, expected);
    let all = surrounded(&bytes, offset, SENTINEL);
    let mut buffer = vec![SENTINEL; all.len()];
    encode_slice(format, effort, columns.read(), &mut buffer[offset..offset + bytes.len()])
        .unwrap();
    if let Some(byte) = difference(&buffer, &all) {
        // Where one of several vectors is at fault.
        let at = byte.checked_sub(offset).map(|byte| byte / format.code_size());
        let v = at.and_then(|i| v.get(i));
        prop_assert!(
            false,
            "{format} {effort:?} bytes at offset {offset}, vector {v:?} ({:x?}), byte {byte}:\n\
             {buffer:x?}, but alone\n{all:x?}",
            v.copied().map(bits)
        );
    }

    let Some(typed) = Typed::of(format) else { return Ok(()) };
    let all = surrounded(expected, offset, sentinel(format));
    let check = |what: &str, got: &[Code]| {
        if let Some(i) = difference(got, &all) {
            let v = i.checked_sub(offset).and_then(|i| v.get(i));
            prop_assert!(
                false,
                "{format} {effort:?} {what} at offset {offset}, vector {v:?} ({:x?}):\n\
                 {got:x?}, but alone\n{all:x?}",
                v.copied().map(bits)
            );
        }
        Ok(())
    };
    let empty = vec![sentinel(format); all.len()];
    let codes = offset..offset + v.len();
    let mut buffer = empty.clone();
    let place = Place { buffer: &mut buffer, codes: codes.clone() };
    (typed.encode_soa)(effort, columns.read(), place).unwrap();
    check("SoA", &buffer)?;
    for aos in &typed.aos {
        let n = aos.floats;
        let vectors = [vec![UNWRITTEN; n * offset], widened(v, n)].concat();
        let mut buffer = empty.clone();
        let place = Place { buffer: &mut buffer, codes: codes.clone() };
        (aos.encode)(effort, &vectors[n * offset..], place).unwrap();
        check(&format!("AoS {n}"), &buffer)?;
    }
    Ok(())
}

/// Every decoder of slices gives `expected`, and writes nowhere else.
pub fn decoders_give(
    codec: &AnyCodec,
    codes: &[Code],
    offset: usize,
    expected: &[Vector],
) -> TestCaseResult {
    let format = codec.format;
    let nothing = vec![[UNWRITTEN; 3]; expected.len()];
    let check = |what: &str, got: &[u32], expected: &[u32]| {
        if let Some(i) = difference(got, expected) {
            prop_assert!(
                false,
                "{format} decoded {what} at offset {offset}, float {i} of {codes:x?}:\n\
                 {got:x?}, but alone\n{expected:x?}"
            );
        }
        Ok(())
    };
    let alone = Columns::new(expected, offset).bits();
    let check_columns = |what: &str, got: &Columns| {
        got.bits().iter().zip(&alone).try_for_each(|(got, alone)| check(what, got, alone))
    };

    let mut columns = Columns::new(&nothing, offset);
    let bytes = surrounded(&to_bytes(format, codes), offset, SENTINEL);
    let len = codes.len() * format.code_size();
    decode_slice(format, &bytes[offset..offset + len], columns.write()).unwrap();
    check_columns("bytes", &columns)?;

    let Some(typed) = Typed::of(format) else { return Ok(()) };
    let mut columns = Columns::new(&nothing, offset);
    let buffer = surrounded(codes, offset, sentinel(format));
    (typed.decode_soa)(&buffer, offset..offset + codes.len(), columns.write()).unwrap();
    check_columns("SoA", &columns)?;
    for aos in &typed.aos {
        let n = aos.floats;
        let around = |v: &[Vector]| {
            let margin = |elements| vec![UNWRITTEN; n * elements];
            [margin(offset), widened(v, n), margin(MARGIN - offset)].concat()
        };
        let mut got = around(&nothing);
        (aos.decode)(codes, &mut got[n * offset..n * (offset + expected.len())]).unwrap();
        check(&format!("AoS {n}"), &all_bits(&got), &all_bits(&around(expected)))?;
    }
    Ok(())
}

/// Transcoding gives what decoding and then encoding gives, to another format and back.
pub fn transcoders_agree(typed: &Typed, codes: &[Code], offset: usize) -> TestCaseResult {
    for [there, back] in typed.transcode.as_chunks().0 {
        let codes = transcoder_agrees(there, codes, offset)?;
        transcoder_agrees(back, &codes, offset)?;
    }
    Ok(())
}

/// Returns the codes.
pub fn transcoder_agrees(
    transcode: &Transcode,
    codes: &[Code],
    offset: usize,
) -> Result<Vec<Code>, TestCaseError> {
    let &Transcode { from, to, run } = transcode;
    let [from_codec, to_codec] = [from, to].map(AnyCodec::of);
    let alone = to_codec.encode_each(Effort::Fast, &from_codec.decode_each(codes));
    let mut got = vec![sentinel(to); codes.len() + MARGIN];
    let place = Place { buffer: &mut got, codes: offset..offset + codes.len() };
    run(codes, place).unwrap();
    let all = surrounded(&alone, offset, sentinel(to));
    prop_assert!(
        got == all,
        "{from} to {to} at offset {offset}: {codes:x?} is\n{got:x?}, but decoded and encoded\n{all:x?}"
    );
    Ok(alone)
}
