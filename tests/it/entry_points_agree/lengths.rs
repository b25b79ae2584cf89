//! Lengths that differ are refused: the error says them, and nothing is written.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use unitpack::{Format, LengthMismatch};
use unitpack_test::codes::{decode_slice, encode_slice};
use unitpack_test::{Arrays, Effort, Outcome, Place, Typed, UNWRITTEN};

use super::buffers::{SENTINEL, sentinel};

/// An error that says exactly these lengths.
fn refused(outcome: Outcome, expected: LengthMismatch, lengths: &[usize]) -> TestCaseResult {
    prop_assert_eq!(outcome, Err(expected));
    let message = expected.to_string();
    let said: Vec<usize> =
        message.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).collect();
    prop_assert_eq!(&said, lengths, "{}", message);
    Ok(())
}

/// Asserts that nothing was written.
fn untouched<T: Copy + PartialEq>(
    format: Format,
    lengths: &[usize],
    codes: &[T],
    sentinel: T,
    v: &[&[f32]],
) -> TestCaseResult {
    let kept = codes.iter().all(|&code| code == sentinel)
        && v.iter().copied().flatten().all(|&c| c == UNWRITTEN);
    prop_assert!(kept, "{format} wrote, though lengths {lengths:?} differ");
    Ok(())
}

/// Lengths of x, y and z, and of codes; near a block of eight or a buffer of 64.
#[test]
fn unequal_structures_of_arrays_are_refused() -> TestCaseResult {
    const UNEQUAL: [[usize; 4]; 14] = [
        [9, 9, 9, 8],
        [9, 9, 9, 10],
        [9, 9, 8, 9],
        [9, 9, 10, 9],
        [9, 8, 9, 9],
        [9, 10, 9, 9],
        [8, 9, 9, 9],
        [10, 9, 9, 9],
        [0, 0, 0, 1],
        [1, 1, 1, 0],
        [0, 8, 8, 8],
        [64, 64, 64, 65],
        [65, 65, 65, 64],
        [1, 2, 3, 4],
    ];
    for &format in Format::ALL {
        let size = format.code_size();
        for lengths @ [x, y, z, codes] in UNEQUAL {
            let from = Arrays::filled([x, y, z], 0.5);
            let mut to = Arrays::unwritten([x, y, z]);

            let mut bytes = vec![SENTINEL; codes * size];
            let error = LengthMismatch::Bytes { x, y, z, bytes: codes * size, code_size: size };
            let said = [x, y, z, codes * size, size];
            for effort in Effort::BOTH {
                refused(encode_slice(format, effort, from.read(), &mut bytes), error, &said)?;
            }
            refused(decode_slice(format, &bytes, to.write()), error, &said)?;
            untouched(format, &lengths, &bytes, SENTINEL, &[&to.x, &to.y, &to.z])?;

            let Some(typed) = Typed::of(format) else { continue };
            let mut buffer = vec![sentinel(format); codes];
            let error = LengthMismatch::Soa { x, y, z, codes };
            for effort in Effort::BOTH {
                let outcome = (typed.encode_soa)(effort, from.read(), Place::from(&mut buffer[..]));
                refused(outcome, error, &lengths)?;
            }
            refused((typed.decode_soa)(&buffer, 0..codes, to.write()), error, &lengths)?;
            untouched(format, &lengths, &buffer, sentinel(format), &[&to.x, &to.y, &to.z])?;
        }
    }
    Ok(())
}

#[test]
fn broken_codes_are_refused() -> TestCaseResult {
    for &format in Format::ALL {
        let size = format.code_size();
        for bytes in [9 * size - 1, 9 * size + 1] {
            let from = Arrays::filled([9; 3], 0.5);
            let mut to = Arrays::unwritten([9; 3]);
            let mut buffer = vec![SENTINEL; bytes];
            let error = LengthMismatch::Bytes { x: 9, y: 9, z: 9, bytes, code_size: size };
            let said = [9, 9, 9, bytes, size];
            for effort in Effort::BOTH {
                refused(encode_slice(format, effort, from.read(), &mut buffer), error, &said)?;
            }
            refused(decode_slice(format, &buffer, to.write()), error, &said)?;
            untouched(format, &said, &buffer, SENTINEL, &[&to.x, &to.y, &to.z])?;
        }
    }
    Ok(())
}

#[test]
fn unequal_arrays_of_structures_and_codes_are_refused() -> TestCaseResult {
    for typed in Typed::all() {
        let format = typed.format;
        for said @ [from, to] in [[0, 1], [1, 0], [8, 9], [9, 8], [64, 65], [65, 64], [200, 3]] {
            for aos in &typed.aos {
                let error = LengthMismatch::Aos { vectors: from, codes: to };
                let mut buffer = vec![sentinel(format); to];
                let vectors = vec![0.5; aos.floats * from];
                for effort in Effort::BOTH {
                    refused(
                        (aos.encode)(effort, &vectors, Place::from(&mut buffer[..])),
                        error,
                        &said,
                    )?;
                }
                let mut v = vec![UNWRITTEN; aos.floats * from];
                refused((aos.decode)(&buffer, &mut v), error, &said)?;
                untouched(format, &said, &buffer, sentinel(format), &[&v])?;
            }

            let error = LengthMismatch::Transcode { src: from, dst: to };
            for transcode in &typed.transcode {
                let unwritten = sentinel(transcode.to);
                let mut buffer = vec![unwritten; to];
                let outcome = (transcode.run)(&vec![0; from], Place::from(&mut buffer[..]));
                refused(outcome, error, &said)?;
                untouched(format, &said, &buffer, unwritten, &[])?;
            }
        }
    }
    Ok(())
}

#[test]
fn a_length_mismatch_is_a_copyable_error() {
    fn accepts<E: std::error::Error + Copy + Send + Sync + 'static>(_: E) {}
    accepts(LengthMismatch::Transcode { src: 1, dst: 2 });
}
