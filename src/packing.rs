//! Packing codes more tightly than their integers: pairs of 12 bits in RGB8 texels, three fields in
//! a word, and streams without gaps.
//!
//! The first field of a word is in the low bits, as the components of
//! [`Snorm10x3`](crate::Snorm10x3) and [`Snorm11_11_10`](crate::Snorm11_11_10) are. Bits of an input
//! above its width are ignored.
//!
//! ```
//! use unitpack::packing::{dense_len, pack_dense, unpack_dense};
//! use unitpack::{Codec, Oct12};
//!
//! // Ten normals at 12 bits each: 15 bytes.
//! let normals = [[0.0, 0.6, 0.8]; 10];
//! let mut codes = [0; 10];
//! Oct12::encode_aos(&normals, &mut codes)?;
//! let mut bytes = [0; dense_len(12, 10)];
//! pack_dense::<12, _>(&codes, &mut bytes)?;
//! assert_eq!(bytes.len(), 15);
//!
//! let mut back = [0u16; 10];
//! unpack_dense::<12, _>(&bytes, &mut back)?;
//! assert_eq!(back, codes);
//! # Ok::<(), unitpack::LengthMismatch>(())
//! ```

use crate::batch::code_int::{CodeInt, holds};
use crate::batch::columns::{CodeColumn, Rows};
use crate::batch::storage::{CodeSlice, CodeSliceMut, from_native, to_native};
use crate::batch::{Kernel, map};
use crate::error::LengthMismatch;
use crate::formula::support::bits::Pair;
use crate::scalar::{Grid, SnormGrid};
use crate::simd::{Simd, Use, map2};

/// Two snorm numbers of 12 bits as an RGB8 texel, as [`Oct24`](crate::Oct24) packs its parameters:
/// with u and v from -2047 to 2047 plus 2047, `[u >> 4, (u & 15) << 4 | v >> 8, v & 255]`.
///
/// Each number becomes the nearest of i / 2047, ties to even i; what is out of range is clamped,
/// and NaN becomes 0.
///
/// Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
/// 2014, listing 4. Its `round` leaves ties, of which only -0.5 and 0.5 are, to the GPU.
///
/// ```
/// use unitpack::packing::{pack_snorm12x2, unpack_snorm12x2};
/// assert_eq!(pack_snorm12x2([0.0, 1.0]), [0x7F, 0xFF, 0xFE]);
/// assert_eq!(unpack_snorm12x2([0x7F, 0xFF, 0xFE]), [0.0, 1.0]);
/// ```
#[inline]
pub fn pack_snorm12x2(pair: [f32; 2]) -> [u8; 3] {
    to_native::<[u8; 3], [u8; 3]>(PackSnorm12x2.pack::<f32>(pair))
}

/// [`pack_snorm12x2`] for slices.
///
/// # Errors
/// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
pub fn pack_snorm12x2_slice(
    pairs: &[[f32; 2]],
    texels: &mut [[u8; 3]],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_values(pairs.len(), texels.len())?;
    let rows = bytemuck::cast_slice(pairs);
    let texels = CodeSliceMut { bytes: texels.as_flattened_mut(), size: 3 };
    map::<Rows<2, 2>, CodeColumn<[u8; 3]>>(PackSnorm12x2, rows, texels);
    Ok(())
}

/// The two snorm numbers of a texel that [`pack_snorm12x2`] gives: the `f32` nearest to i / 2047.
/// The field 4095, which packing never gives, reads as 1, like 4094.
///
/// Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
/// 2014, listing 5. Evaluated in `f32`, its `s / 2047 - 1` rounds twice, and is off by up to 2^-24.
#[inline]
pub fn unpack_snorm12x2(texel: [u8; 3]) -> [f32; 2] {
    UnpackSnorm12x2.unpack::<f32>(from_native::<[u8; 3], [u8; 3]>(texel))
}

/// [`unpack_snorm12x2`] for slices.
///
/// # Errors
/// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
pub fn unpack_snorm12x2_slice(
    texels: &[[u8; 3]],
    pairs: &mut [[f32; 2]],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_values(pairs.len(), texels.len())?;
    let rows = bytemuck::cast_slice_mut(pairs);
    let texels = CodeSlice { bytes: texels.as_flattened(), size: 3 };
    map::<CodeColumn<[u8; 3]>, Rows<2, 2>>(UnpackSnorm12x2, texels, rows);
    Ok(())
}

#[derive(Clone, Copy)]
struct PackSnorm12x2;
#[derive(Clone, Copy)]
struct UnpackSnorm12x2;

impl PackSnorm12x2 {
    #[inline(always)]
    fn pack<V: Simd>(&self, pair: [V; 2]) -> V::Int {
        const GRID: SnormGrid = SnormGrid::new(12);
        Pair::new(24).pack_snorm::<V>(map2!(pair, |x| GRID.nearest(x)))
    }
}

impl UnpackSnorm12x2 {
    #[inline(always)]
    fn unpack<V: Simd>(&self, code: V::Int) -> [V; 2] {
        let pair = Pair::new(24);
        map2!(pair.unpack_snorm::<V>(code), |i| V::from_int(i) / pair.snorm_max() as f32)
    }
}

impl Kernel<Rows<2, 2>, CodeColumn<[u8; 3]>> for PackSnorm12x2 {
    const USE: Use = Use::Sometimes;

    #[inline(always)]
    fn run<V: Simd>(self, pair: [V; 2]) -> V::Int {
        self.pack(pair)
    }
}

impl Kernel<CodeColumn<[u8; 3]>, Rows<2, 2>> for UnpackSnorm12x2 {
    const USE: Use = Use::Sometimes;

    #[inline(always)]
    fn run<V: Simd>(self, code: V::Int) -> [V; 2] {
        self.unpack::<V>(code)
    }
}

/// A code of 30 bits, such as a [`Snorm10x3`](crate::Snorm10x3), with a tag of 2 bits above it: a
/// tangent and its handedness in an RGB10A2 word. As snorm, the tags 0, 1 and 3 are 0, 1 and -1.
///
/// The word decodes as the code does, since decoders ignore the bits above.
///
/// ```
/// use unitpack::packing::{pack_tag, unpack_tag};
/// use unitpack::{Codec, Snorm10x3};
///
/// let word = pack_tag(Snorm10x3::encode([0.0, 0.0, 1.0]), 3);
/// assert_eq!(Snorm10x3::decode(word), [0.0, 0.0, 1.0]);
/// assert_eq!(unpack_tag(word).1, 3);
/// ```
#[inline]
pub const fn pack_tag(code: u32, tag: u8) -> u32 {
    code & LOW_30 | (tag as u32) << 30
}

/// The code, its upper bits zero, and the tag, 0 to 3, of [`pack_tag`].
#[inline]
pub const fn unpack_tag(word: u32) -> (u32, u8) {
    (word & LOW_30, (word >> 30) as u8)
}

/// [`pack_tag`] for slices.
///
/// # Errors
/// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
pub fn pack_tag_slice(codes: &[u32], tags: &[u8], words: &mut [u32]) -> Result<(), LengthMismatch> {
    LengthMismatch::check_tagged(codes.len(), tags.len(), words.len())?;
    for ((&code, &tag), word) in codes.iter().zip(tags).zip(words) {
        *word = pack_tag(code, tag);
    }
    Ok(())
}

/// [`unpack_tag`] for slices.
///
/// # Errors
/// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
pub fn unpack_tag_slice(
    words: &[u32],
    codes: &mut [u32],
    tags: &mut [u8],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_tagged(codes.len(), tags.len(), words.len())?;
    for ((&word, code), tag) in words.iter().zip(codes).zip(tags) {
        (*code, *tag) = unpack_tag(word);
    }
    Ok(())
}

/// Three fields of 10 bits and a tag of 2: bits 0 to 9, 10 to 19, 20 to 29, and 30 to 31.
#[inline]
pub const fn pack_10_10_10_2([x, y, z]: [u16; 3], tag: u8) -> u32 {
    pack_tag(low(x, 10) | low(y, 10) << 10 | low(z, 10) << 20, tag)
}

/// The fields and the tag of [`pack_10_10_10_2`].
#[inline]
pub const fn unpack_10_10_10_2(word: u32) -> ([u16; 3], u8) {
    let (code, tag) = unpack_tag(word);
    ([field(code, 0, 10), field(code, 10, 10), field(code, 20, 10)], tag)
}

/// [`pack_10_10_10_2`] for slices.
///
/// # Errors
/// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
pub fn pack_10_10_10_2_slice(
    fields: &[[u16; 3]],
    tags: &[u8],
    words: &mut [u32],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_tagged(fields.len(), tags.len(), words.len())?;
    for ((&fields, &tag), word) in fields.iter().zip(tags).zip(words) {
        *word = pack_10_10_10_2(fields, tag);
    }
    Ok(())
}

/// [`unpack_10_10_10_2`] for slices.
///
/// # Errors
/// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
pub fn unpack_10_10_10_2_slice(
    words: &[u32],
    fields: &mut [[u16; 3]],
    tags: &mut [u8],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_tagged(fields.len(), tags.len(), words.len())?;
    for ((&word, fields), tag) in words.iter().zip(fields).zip(tags) {
        (*fields, *tag) = unpack_10_10_10_2(word);
    }
    Ok(())
}

/// Three fields of 11, 11 and 10 bits: bits 0 to 10, 11 to 21, and 22 to 31.
#[inline]
pub const fn pack_11_11_10([x, y, z]: [u16; 3]) -> u32 {
    low(x, 11) | low(y, 11) << 11 | low(z, 10) << 22
}

/// The fields of [`pack_11_11_10`].
#[inline]
pub const fn unpack_11_11_10(word: u32) -> [u16; 3] {
    [field(word, 0, 11), field(word, 11, 11), field(word, 22, 10)]
}

/// [`pack_11_11_10`] for slices.
///
/// # Errors
/// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
pub fn pack_11_11_10_slice(fields: &[[u16; 3]], words: &mut [u32]) -> Result<(), LengthMismatch> {
    LengthMismatch::check_values(fields.len(), words.len())?;
    for (&fields, word) in fields.iter().zip(words) {
        *word = pack_11_11_10(fields);
    }
    Ok(())
}

/// [`unpack_11_11_10`] for slices.
///
/// # Errors
/// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
pub fn unpack_11_11_10_slice(words: &[u32], fields: &mut [[u16; 3]]) -> Result<(), LengthMismatch> {
    LengthMismatch::check_values(fields.len(), words.len())?;
    for (&word, fields) in words.iter().zip(fields) {
        *fields = unpack_11_11_10(word);
    }
    Ok(())
}

const LOW_30: u32 = (1 << 30) - 1;

/// The low bits.
const fn low(field: u16, bits: u32) -> u32 {
    field as u32 & ((1 << bits) - 1)
}

const fn field(word: u32, first: u32, bits: u32) -> u16 {
    (word >> first & ((1 << bits) - 1)) as u16
}

/// Number of bytes that `count` codes of `bits` bits take without gaps: `count * bits / 8`, rounded up.
/// `usize::MAX` if it is more than that.
#[inline]
pub const fn dense_len(bits: u32, count: usize) -> usize {
    let bits = bits as usize;
    // Eight codes are `bits` bytes.
    let rest = (count % 8).saturating_mul(bits).div_ceil(8);
    (count / 8).saturating_mul(bits).saturating_add(rest)
}

/// Packs codes of 1 to 32 bits without gaps, in little-endian bit order: code i takes the bits
/// `i * BITS` to `(i + 1) * BITS`, where bit b is bit `b % 8` of byte `b / 8`.
///
/// `bytes` has [`dense_len`]`(BITS, codes.len())` bytes; spare bits of the last one become zero.
/// Codes of more than 32 bits, or that do not fit their integer, do not compile:
///
/// ```compile_fail
/// use unitpack::packing::pack_dense;
/// let _ = pack_dense::<33, _>(&[0u32], &mut [0; 5]);
/// ```
///
/// ```compile_fail
/// use unitpack::packing::pack_dense;
/// let _ = pack_dense::<20, _>(&[0u16], &mut [0; 3]);
/// ```
///
/// # Errors
/// [`LengthMismatch`] if `bytes` has another length; nothing is written then.
#[inline]
pub fn pack_dense<const BITS: u32, C: CodeInt>(
    codes: &[C],
    bytes: &mut [u8],
) -> Result<(), LengthMismatch> {
    const { assert_dense::<C>(BITS) };
    let (blocks, rest) = codes.as_chunks();
    let at = dense_len(BITS, 8 * blocks.len());
    match bytes.split_at_mut_checked(at) {
        Some((whole, last)) if last.len() == dense_len(BITS, rest.len()) => {
            for (codes, bytes) in blocks.iter().zip(whole.chunks_exact_mut(BITS as usize)) {
                pack_block::<BITS, C>(codes, bytes);
            }
            let mut codes = [C::zeroed(); 8];
            copy(rest, &mut codes);
            pack_block::<BITS, C>(&codes, last);
            Ok(())
        }
        _ => Err(LengthMismatch::Dense { codes: codes.len(), bytes: bytes.len(), bits: BITS }),
    }
}

/// The codes that [`pack_dense`] packed. Their upper bits become zero, and spare bits of the last
/// byte are ignored.
///
/// `bytes` has [`dense_len`]`(BITS, codes.len())` bytes. Codes of more than 32 bits, or that do not
/// fit their integer, do not compile.
///
/// # Errors
/// [`LengthMismatch`] if `bytes` has another length; nothing is written then.
#[inline]
pub fn unpack_dense<const BITS: u32, C: CodeInt>(
    bytes: &[u8],
    codes: &mut [C],
) -> Result<(), LengthMismatch> {
    const { assert_dense::<C>(BITS) };
    let mismatch = LengthMismatch::Dense { codes: codes.len(), bytes: bytes.len(), bits: BITS };
    let (blocks, rest) = codes.as_chunks_mut();
    match bytes.split_at_checked(dense_len(BITS, 8 * blocks.len())) {
        Some((whole, last)) if last.len() == dense_len(BITS, rest.len()) => {
            for (codes, bytes) in blocks.iter_mut().zip(whole.chunks_exact(BITS as usize)) {
                *codes = unpack_block::<BITS, C>(bytes);
            }
            copy(&unpack_block::<BITS, C>(last), rest);
            Ok(())
        }
        _ => Err(mismatch),
    }
}

const fn assert_dense<C>(bits: u32) {
    assert!(1 <= bits && bits <= 32, "a dense code has 1 to 32 bits");
    assert!(holds::<C>(bits), "the integer is narrower than the codes");
}

/// Eight codes as up to `BITS` bytes.
#[inline(always)]
fn pack_block<const BITS: u32, C: CodeInt>(&[a, b, c, d, e, f, g, h]: &[C; 8], bytes: &mut [u8]) {
    let four = |codes: [C; 4]| {
        codes
            .iter()
            .rev()
            .fold(0u128, |all, &code| all << BITS | u128::from(code.into() & mask(BITS)))
    };
    let (low, high) = (four([a, b, c, d]), four([e, f, g, h]));
    let low_half = low | high.unbounded_shl(4 * BITS);
    let high_half = high >> (128 - 4 * BITS);
    copy([low_half.to_le_bytes(), high_half.to_le_bytes()].as_flattened(), bytes);
}

/// The codes of [`pack_block`]; zero where there are no bytes.
#[inline(always)]
fn unpack_block<const BITS: u32, C: CodeInt>(bytes: &[u8]) -> [C; 8] {
    let mut halves = [[0; 16]; 2];
    copy(bytes, halves.as_flattened_mut());
    let [low_half, high_half] = halves.map(u128::from_le_bytes);
    let high = low_half.unbounded_shr(4 * BITS) | high_half << (128 - 4 * BITS);
    let code = |four: u128, i: u32| C::truncate((four >> (i * BITS)) as u32 & mask(BITS));
    let four = |four| [0, 1, 2, 3].map(|i| code(four, i));
    let ([a, b, c, d], [e, f, g, h]) = (four(low_half), four(high));
    [a, b, c, d, e, f, g, h]
}

const fn mask(bits: u32) -> u32 {
    u32::MAX >> (32 - bits)
}

/// As many elements as both have.
#[inline(always)]
fn copy<T: Copy>(from: &[T], to: &mut [T]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}
