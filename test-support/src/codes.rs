//! Codes of any format as integers, and the functions of [`Format`] over them.

use bytemuck::Pod;
use unitpack::{Format, Soa, SoaMut};

use crate::random::Rng;
use crate::{Arrays, Effort, Outcome, Vector};

/// A code as an integer, whose little-endian bytes are those of [`Format::encode`].
pub type Code = u128;

/// The code of an integer.
pub fn native<T: Pod>(code: Code) -> T {
    let mut bytes = code.to_le_bytes();
    let bytes = &mut bytes[..size_of::<T>()];
    swap_if_big_endian::<T>(bytes);
    bytemuck::pod_read_unaligned(bytes)
}

/// The integer of a code.
pub fn integer<T: Pod>(code: T) -> Code {
    let mut bytes = [0; 16];
    bytes[..size_of::<T>()].copy_from_slice(bytemuck::bytes_of(&code));
    swap_if_big_endian::<T>(&mut bytes[..size_of::<T>()]);
    Code::from_le_bytes(bytes)
}

/// A code is one integer or an array of them, as large as its alignment.
fn swap_if_big_endian<T>(bytes: &mut [u8]) {
    if cfg!(target_endian = "big") {
        bytes.chunks_mut(align_of::<T>()).for_each(<[u8]>::reverse);
    }
}

/// The codes of integers.
pub fn natives<T: Pod>(codes: &[Code]) -> Vec<T> {
    codes.iter().copied().map(native).collect()
}

/// Lets `write` change codes, and brings back what it left, whether it failed or not. Not generic
/// over `write`, so that there is one for each type of code.
pub fn write_codes<T: Pod, R>(codes: &mut [Code], write: &mut dyn FnMut(&mut [T]) -> R) -> R {
    let mut natives = natives::<T>(codes);
    let result = write(&mut natives);
    for (code, native) in codes.iter_mut().zip(natives) {
        *code = integer(native);
    }
    result
}

/// The bytes of codes, as [`Format::encode`] writes them.
pub fn to_bytes(format: Format, codes: &[Code]) -> Vec<u8> {
    let size = format.code_size();
    let mut bytes = vec![0; codes.len() * size];
    for (bytes, code) in bytes.chunks_exact_mut(size).zip(codes) {
        bytes.copy_from_slice(&code.to_le_bytes()[..size]);
    }
    bytes
}

/// The codes of bytes, as [`Format::encode`] writes them.
pub fn from_bytes(format: Format, bytes: &[u8]) -> Vec<Code> {
    let integer = |bytes: &[u8]| {
        let mut wide = [0; 16];
        wide[..bytes.len()].copy_from_slice(bytes);
        Code::from_le_bytes(wide)
    };
    bytes.chunks_exact(format.code_size()).map(integer).collect()
}

/// All ones, in as many bits as the integer of a code has.
pub fn last_pattern(format: Format) -> Code {
    Code::MAX >> (128 - 8 * format.code_size())
}

/// Codes of any bit pattern: in turn uniform ones, and ones of bytes at which fields turn over.
pub fn random_codes(format: Format, seed: u64, count: usize) -> Vec<Code> {
    const TURNS: [u8; 11] = [0x00, 0x01, 0x3C, 0x7B, 0x7C, 0x7F, 0x80, 0x81, 0xBC, 0xFE, 0xFF];
    let mut rng = Rng::new(seed);
    let mut code = |i| {
        let uniform = i % 2 == 0;
        let byte = [0; 16].map(|_| if uniform { rng.bits() as u8 } else { rng.pick(&TURNS) });
        Code::from_le_bytes(byte) & last_pattern(format)
    };
    (0..count).map(&mut code).collect()
}

/// [`Format::encode`], or [`Format::encode_precise`].
///
/// # Errors
/// As theirs.
#[inline]
pub fn encode_slice(format: Format, effort: Effort, v: Soa<'_>, bytes: &mut [u8]) -> Outcome {
    compiled_once::encode::<true>(format, effort, v, bytes)
}

/// [`Format::decode`].
///
/// # Errors
/// As its.
#[inline]
pub fn decode_slice(format: Format, bytes: &[u8], v: SoaMut<'_>) -> Outcome {
    compiled_once::decode::<true>(format, bytes, v)
}

/// The codes of vectors, by [`Format::encode`].
#[inline]
pub fn encode(format: Format, vectors: &[Vector]) -> Vec<Code> {
    encode_with(format, Effort::Fast, vectors)
}

/// The codes of vectors, by [`Format::encode_precise`].
#[inline]
pub fn encode_precise(format: Format, vectors: &[Vector]) -> Vec<Code> {
    encode_with(format, Effort::Precise, vectors)
}

/// The codes of vectors, by a slice of the format.
#[inline]
pub fn encode_with(format: Format, effort: Effort, vectors: &[Vector]) -> Vec<Code> {
    encode_arrays(format, effort, Arrays::from(vectors).read())
}

/// The codes of a structure of arrays, by a slice of the format.
#[inline]
pub fn encode_arrays(format: Format, effort: Effort, v: Soa<'_>) -> Vec<Code> {
    let mut bytes = vec![0; v.x.len() * format.code_size()];
    encode_slice(format, effort, v, &mut bytes).expect("the lengths fit");
    from_bytes(format, &bytes)
}

/// The vectors of codes, by [`Format::decode`].
#[inline]
pub fn decode(format: Format, codes: &[Code]) -> Vec<Vector> {
    decode_arrays(format, codes).iter().collect()
}

/// The vectors of codes as a structure of arrays, by [`Format::decode`].
#[inline]
pub fn decode_arrays(format: Format, codes: &[Code]) -> Arrays {
    let mut v = Arrays::unwritten([codes.len(); 3]);
    decode_slice(format, &to_bytes(format, codes), v.write()).expect("the lengths fit");
    v
}

/// The loops of all codecs, once in a program. A generic function has no code in this crate, and
/// one that is not inlined has one copy in the crate that calls it.
mod compiled_once {
    use unitpack::{Format, Soa, SoaMut};

    use crate::{Effort, Outcome};

    #[inline(never)]
    pub fn encode<const GENERIC: bool>(
        format: Format,
        effort: Effort,
        v: Soa<'_>,
        bytes: &mut [u8],
    ) -> Outcome {
        match effort {
            Effort::Fast => format.encode(v, bytes),
            Effort::Precise => format.encode_precise(v, bytes),
        }
    }

    #[inline(never)]
    pub fn decode<const GENERIC: bool>(format: Format, bytes: &[u8], v: SoaMut<'_>) -> Outcome {
        format.decode(bytes, v)
    }
}
