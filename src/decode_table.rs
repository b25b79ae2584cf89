//! Decode tables: every decoded vector of a format of at most 16 bits, in memory of the caller's.
//!
//! Reading a vector from a table gives the same bits as [`Codec::decode`]. [`DecodeTable`] and
//! [`FormatTable`] have an entry for every code; an [`OctantTable`] has one octant and mirrors the
//! rest, so that it fits into a smaller cache. An entry takes 12 bytes:
//!
//! | format | every code | one octant |
//! |---|--:|--:|
//! | 8 bits: oct8 | 256 = 3 KiB | 36 = 432 B |
//! | 12 bits: oct12 | 4 096 = 48 KiB | 528 = 6.2 KiB |
//! | 15 bits: snorm5x3 | 32 768 = 384 KiB | 4 096 = 48 KiB |
//! | 16 bits: oct16 | 65 536 = 768 KiB | 8 256 = 96.8 KiB |
//! | octant16 | 65 536 = 768 KiB | 8 128 = 95.3 KiB |
//! | disk projections | 65 536 = 768 KiB | 8 192 = 96 KiB |
//! | angularcube16 | 65 536 = 768 KiB | 8 112 = 95.1 KiB |
//! | cube16, warpedcube16 | 65 536 = 768 KiB | 3 072 = 36 KiB |
//! | HemiOct16, XY-only of 16 bits | 65 536 = 768 KiB | 16 384 = 192 KiB |
//!
//! ```
//! use unitpack::decode_table::{DecodeTable, OctantTable};
//! use unitpack::{Codec, Oct8};
//!
//! let mut vectors = [[0.0; 3]; DecodeTable::<Oct8>::LEN];
//! let table = DecodeTable::<Oct8>::fill(&mut vectors)?;
//! assert_eq!(table.decode(0x35), Oct8::decode(0x35));
//!
//! let mut octant = [[0.0; 3]; OctantTable::<Oct8>::LEN];
//! let table = OctantTable::<Oct8>::fill(&mut octant)?;
//! assert_eq!(table.decode(0x35), Oct8::decode(0x35));
//! # Ok::<(), unitpack::LengthMismatch>(())
//! ```
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014, section 2.4.

use core::marker::PhantomData;

use crate::batch::layout::{self, Codes, PART, VectorsMut};
use crate::batch::storage::from_native;
use crate::codec::{Codec, Format, for_each_codec};
use crate::error::LengthMismatch;
use crate::formula::names::*;
use crate::formula::octant_table::{Mirrored, OctantKernels};
use crate::simd::look_up3;
use crate::vector::SoaMut;

/// Every decoded vector of the codec `C`, which has at most 16 bits.
///
/// A codec of more bits does not compile:
///
/// ```compile_fail
/// use unitpack::{Oct18, decode_table::DecodeTable};
/// let _ = DecodeTable::<Oct18>::fill(&mut []);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DecodeTable<'a, C> {
    vectors: &'a [[f32; 3]],
    codec: PhantomData<C>,
}

impl<'a, C: Codec> DecodeTable<'a, C> {
    /// How many entries the table has: one for each code.
    pub const LEN: usize = {
        assert!(C::FORMAT.bits() <= 16, "a codec of more than 16 bits has no decode table");
        1 << C::FORMAT.bits()
    };

    /// Writes every decoded vector, in the order of the codes, to `vectors`, which has
    /// [`LEN`](Self::LEN) elements.
    ///
    /// # Errors
    /// [`LengthMismatch`] if it has not; nothing is written then.
    pub fn fill(vectors: &'a mut [[f32; 3]]) -> Result<Self, LengthMismatch> {
        LengthMismatch::check_table(vectors.len(), Some(Self::LEN))?;
        fill(&C::decode_batch, size_of::<C::Code>(), vectors);
        Ok(DecodeTable { vectors, codec: PhantomData })
    }

    /// The vector of a code, the same bits as [`Codec::decode`] gives.
    #[inline]
    pub fn decode(&self, code: C::Code) -> [f32; 3] {
        look_up3(self.vectors, (index::<C>(code) & (Self::LEN - 1)) as i32)
    }

    /// [`decode`](Self::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    pub fn decode_soa(&self, codes: &[C::Code], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        look_up(self.vectors, Codes::native(codes), v.into());
        Ok(())
    }

    /// [`decode`](Self::decode) for arrays of structures of `N` floats. The first three become x, y
    /// and z; the others stay as they are. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    pub fn decode_aos<const N: usize>(
        &self,
        codes: &[C::Code],
        v: &mut [[f32; N]],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(v.len(), codes.len())?;
        look_up(self.vectors, Codes::native(codes), VectorsMut::rows(v));
        Ok(())
    }
}

/// Every decoded vector of a format of at most 16 bits that is chosen at run time.
#[derive(Clone, Copy, Debug)]
pub struct FormatTable<'a> {
    vectors: &'a [[f32; 3]],
    format: Format,
}

impl<'a> FormatTable<'a> {
    /// How many entries the table of a format has: one for each code. `None` for a format of more
    /// than 16 bits, which has no table.
    #[inline]
    pub const fn len_for(format: Format) -> Option<usize> {
        if format.bits() <= 16 { Some(1 << format.bits()) } else { None }
    }

    /// Writes every decoded vector, in the order of the codes, to `vectors`, which has
    /// [`len_for`](Self::len_for)`(format)` elements.
    ///
    /// # Errors
    /// [`LengthMismatch`] if it has not, or if the format has more than 16 bits; nothing is written
    /// then.
    pub fn fill(format: Format, vectors: &'a mut [[f32; 3]]) -> Result<Self, LengthMismatch> {
        LengthMismatch::check_table(vectors.len(), Self::len_for(format))?;
        let decode = |codes: Codes<'_>, v: VectorsMut<'_, 3>| format.decode_batch(codes, v);
        fill(&decode, format.code_size(), vectors);
        Ok(FormatTable { vectors, format })
    }

    /// The format whose vectors these are.
    #[inline]
    pub fn format(&self) -> Format {
        self.format
    }

    /// The vector of a code, the same bits as [`Format::decode`] gives. Bits above those of the
    /// format are ignored.
    #[inline]
    pub fn decode(&self, code: u16) -> [f32; 3] {
        let used = ((1u32 << self.format.bits()) - 1) as i32;
        look_up3(self.vectors, i32::from(code) & used)
    }

    /// [`decode`](Self::decode) for little-endian codes without gaps, at any alignment, as
    /// [`Format::decode`] takes them.
    ///
    /// `bytes` is [`code_size`](Format::code_size) times as long as `v.x`, `v.y` and `v.z`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    pub fn decode_bytes(&self, bytes: &[u8], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        let size = self.format.code_size();
        LengthMismatch::check_bytes([v.x.len(), v.y.len(), v.z.len()], bytes.len(), size)?;
        look_up(self.vectors, Codes::little_endian(bytes, size), v.into());
        Ok(())
    }
}

/// The decoded vectors of one octant of the codec `C`, and by mirroring all others.
///
/// Only codecs that are exactly [`SignSymmetric`] have such a table.
///
/// ```compile_fail
/// use unitpack::{Spherical16, decode_table::OctantTable};
/// let _ = OctantTable::<Spherical16>::fill(&mut []);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct OctantTable<'a, C> {
    vectors: &'a [[f32; 3]],
    codec: PhantomData<C>,
}

impl<'a, C: SignSymmetric> OctantTable<'a, C> {
    /// How many entries the table has: [`SignSymmetric::ENTRIES`].
    pub const LEN: usize = C::ENTRIES;

    /// Writes the decoded vectors of the octant to `vectors`, which has [`LEN`](Self::LEN) elements.
    ///
    /// # Errors
    /// [`LengthMismatch`] if it has not; nothing is written then.
    pub fn fill(vectors: &'a mut [[f32; 3]]) -> Result<Self, LengthMismatch> {
        LengthMismatch::check_table(vectors.len(), Some(Self::LEN))?;
        C::fill(vectors);
        Ok(OctantTable { vectors, codec: PhantomData })
    }

    /// The vector of a code, the same bits as [`Codec::decode`] gives.
    #[inline]
    pub fn decode(&self, code: C::Code) -> [f32; 3] {
        C::look_up(self.vectors, code)
    }

    /// [`decode`](Self::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    pub fn decode_soa(&self, codes: &[C::Code], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        C::look_up_batch(self.vectors, Codes::native(codes), v.into());
        Ok(())
    }

    /// [`decode`](Self::decode) for arrays of structures of `N` floats. The first three become x, y
    /// and z; the others stay as they are. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    pub fn decode_aos<const N: usize>(
        &self,
        codes: &[C::Code],
        v: &mut [[f32; N]],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(v.len(), codes.len())?;
        C::look_up_batch(self.vectors, Codes::native(codes), VectorsMut::rows(v));
        Ok(())
    }
}

/// A codec of at most 16 bits whose decoder is the same, bit for bit, in all octants: for every code
/// and every change of signs there is a code of the mirrored vector. A hemisphere's is so in its
/// four.
///
/// The others are so only up to rounding, as spherical16, or have other points in other octants;
/// icosphere162 is decoded by a table already.
pub trait SignSymmetric: Codec {
    /// Number of points that the codec has in one octant.
    const ENTRIES: usize;

    /// Writes the vectors of an octant.
    #[doc(hidden)]
    fn fill(octant: &mut [[f32; 3]]);
    #[doc(hidden)]
    fn look_up(octant: &[[f32; 3]], code: Self::Code) -> [f32; 3];
    #[doc(hidden)]
    fn look_up_batch(octant: &[[f32; 3]], codes: Codes<'_>, vectors: VectorsMut<'_, 3>);
}

/// Implements the trait for the rows with the flag `octant`.
macro_rules! sign_symmetric {
    ($name:ident, $code:ty, $bits:literal, $value:expr) => {
        impl SignSymmetric for crate::codec::$name {
            const ENTRIES: usize = {
                assert!($bits <= 16);
                $value.points_per_octant()
            };

            #[inline]
            fn fill(octant: &mut [[f32; 3]]) {
                const { $value }.fill($bits, octant);
            }
            #[inline]
            fn look_up(octant: &[[f32; 3]], code: $code) -> [f32; 3] {
                let code = from_native::<[u8; size_of::<$code>()], $code>(code);
                Mirrored(const { $value }, octant).decode::<f32>(code).to_array()
            }
            #[inline]
            fn look_up_batch(octant: &[[f32; 3]], codes: Codes<'_>, vectors: VectorsMut<'_, 3>) {
                const { $value }.look_up(octant, codes, vectors);
            }
        }
    };
}

for_each_codec!(@row octant: sign_symmetric);

/// Decodes the codes from 0 on, which have one or two bytes.
#[inline(never)]
fn fill(decode: &dyn Fn(Codes<'_>, VectorsMut<'_, 3>), code_size: usize, vectors: &mut [[f32; 3]]) {
    let mut bytes = [0; 2 * PART];
    let mut next = 0u32;
    for vectors in vectors.chunks_mut(PART) {
        for code in bytes.chunks_mut(code_size.max(1)).take(vectors.len()) {
            for (to, from) in code.iter_mut().zip(next.to_le_bytes()) {
                *to = from;
            }
            next += 1;
        }
        if let Some(bytes) = bytes.get(..vectors.len() * code_size) {
            decode(Codes::little_endian(bytes, code_size), VectorsMut::rows(vectors));
        }
    }
}

/// The integer that a code of one or two bytes is.
#[inline]
fn index<C: Codec>(code: C::Code) -> usize {
    match *bytemuck::bytes_of(&code) {
        [byte] => byte.into(),
        [first, second] => u16::from_ne_bytes([first, second]).into(),
        _ => 0,
    }
}

/// Decodes by a table of all codes, which have one or two bytes.
#[inline(never)]
fn look_up(table: &[[f32; 3]], codes: Codes<'_>, vectors: VectorsMut<'_, 3>) {
    match codes.size() {
        1 => look_up_sized(table, codes, vectors, |[code]: [u8; 1]| code.into()),
        _ => look_up_sized(table, codes, vectors, u16::from_le_bytes),
    }
}

/// There is nothing to compute, so there are no lanes.
#[inline(never)]
fn look_up_sized<const SIZE: usize>(
    table: &[[f32; 3]],
    codes: Codes<'_>,
    vectors: VectorsMut<'_, 3>,
    integer: impl Fn([u8; SIZE]) -> u16,
) {
    let used = table.len().saturating_sub(1) as u16;
    layout::decode_each(codes, vectors, |code| look_up3(table, (integer(code) & used).into()));
}

#[cfg(all(test, feature = "octahedral"))]
mod tests {
    use super::*;
    use crate::codec::{HemiOct16, Oct8, Oct12, Oct18, Octant16};

    #[test]
    fn tables_of_all_codes_give_the_bits_of_the_codec() {
        let mut vectors = [[0.0; 3]; DecodeTable::<Oct8>::LEN];
        let table = DecodeTable::<Oct8>::fill(&mut vectors).unwrap();
        for code in 0..=255 {
            assert_eq!(table.decode(code), Oct8::decode(code));
        }
        // More than a part, in two bytes.
        let mut vectors = [[0.0; 3]; DecodeTable::<Oct12>::LEN];
        let table = DecodeTable::<Oct12>::fill(&mut vectors).unwrap();
        for code in 0..4096 {
            assert_eq!(table.decode(code), Oct12::decode(code));
        }
        assert_eq!(table.decode(0xF123), Oct12::decode(0x0123));
    }

    #[test]
    fn a_format_has_as_many_entries_as_codes() {
        assert_eq!(FormatTable::len_for(Format::Oct8), Some(256));
        assert_eq!(FormatTable::len_for(Format::Octant16), Some(65_536));
        assert_eq!(FormatTable::len_for(Format::Oct18), None);
        let refused = FormatTable::fill(Format::Oct18, &mut []).map(|_| ());
        assert_eq!(refused, Err(LengthMismatch::Table { vectors: 0, entries: None }));
        let refused = DecodeTable::<Oct8>::fill(&mut [[0.0; 3]; 255]).map(|_| ());
        assert_eq!(refused, Err(LengthMismatch::Table { vectors: 255, entries: Some(256) }));
        assert!(Oct18::FORMAT == Format::Oct18);
    }

    #[test]
    fn a_format_table_reads_little_endian_bytes() {
        let mut vectors = [[0.0; 3]; 4096];
        let table = FormatTable::fill(Format::Oct12, &mut vectors).unwrap();
        assert_eq!(table.format(), Format::Oct12);
        let [mut x, mut y, mut z] = [[0.0; 2]; 3];
        let v = SoaMut { x: &mut x, y: &mut y, z: &mut z };
        table.decode_bytes(&[0x23, 0x01, 0x45, 0xF6], v).unwrap();
        assert_eq!([x[0], y[0], z[0]], Oct12::decode(0x0123));
        assert_eq!([x[1], y[1], z[1]], Oct12::decode(0x0645));
        let mut vectors = [[0.0; 3]; 256];
        let table = FormatTable::fill(Format::Oct8, &mut vectors).unwrap();
        let v = SoaMut { x: &mut x, y: &mut y, z: &mut z };
        table.decode_bytes(&[0x35, 0x9A], v).unwrap();
        assert_eq!([x[1], y[1], z[1]], Oct8::decode(0x9A));
        assert!(table.decode_bytes(&[0; 3], SoaMut { x: &mut x, y: &mut y, z: &mut z }).is_err());
    }

    #[test]
    fn an_octant_is_mirrored_into_all_others() {
        // The 36 points (i, j, k) with i + j + k = 7.
        assert_eq!(OctantTable::<Oct8>::LEN, 36);
        let mut vectors = [[0.0; 3]; 36];
        let table = OctantTable::<Oct8>::fill(&mut vectors).unwrap();
        for code in 0..=255 {
            assert_eq!(table.decode(code).map(f32::to_bits), Oct8::decode(code).map(f32::to_bits));
        }
        assert!(vectors.iter().flatten().all(|c| *c >= 0.0));
        assert!(OctantTable::<Oct8>::fill(&mut vectors[1..]).is_err());
        assert_eq!([OctantTable::<HemiOct16>::LEN, OctantTable::<Octant16>::LEN], [16_384, 8128]);
    }

    #[test]
    fn structures_of_arrays_and_arrays_of_structures_are_filled() {
        let mut vectors = [[0.0; 3]; 256];
        let mut octant = [[0.0; 3]; 36];
        let table = DecodeTable::<Oct8>::fill(&mut vectors).unwrap();
        let small = OctantTable::<Oct8>::fill(&mut octant).unwrap();
        let codes: [u8; 33] = core::array::from_fn(|i| (i * 71) as u8);
        let [mut x, mut y, mut z] = [[0.0; 33]; 3];
        let [mut rows, mut small_rows] = [[[9.0; 4]; 33]; 2];
        table.decode_soa(&codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
        table.decode_aos(&codes, &mut rows).unwrap();
        small.decode_aos(&codes, &mut small_rows).unwrap();
        assert_eq!(rows, small_rows);
        for (i, row) in rows.iter().enumerate() {
            let [a, b, c] = Oct8::decode(codes[i]);
            assert_eq!((*row, [x[i], y[i], z[i]]), ([a, b, c, 9.0], [a, b, c]));
        }
        assert!(table.decode_aos(&codes, &mut rows[1..]).is_err());
        let short = SoaMut { x: &mut x, y: &mut y[1..], z: &mut z };
        assert!(small.decode_soa(&codes, short).is_err());
    }
}
