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
//! | HemiOct16, XYOnly16 | 65 536 = 768 KiB | 16 384 = 192 KiB |
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

use bytemuck::Zeroable;

use crate::batch::{self, Decoder, STAGE};
use crate::formula::{Behind, One, Stored, Symmetric};
use crate::simd::{Each, Simd, SimdMask, look_up3};
use crate::*;

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
        fill::<C>(vectors);
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
    pub fn decode_soa(&self, codes: &[C::Code], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        look_up_soa(codes, v, |&code| self.decode(code))
    }

    /// [`decode`](Self::decode) for arrays of structures of `N` floats. The first three become x, y
    /// and z; the others stay as they are. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    pub fn decode_aos<const N: usize>(
        &self,
        codes: &[C::Code],
        v: &mut [[f32; N]],
    ) -> Result<(), LengthMismatch> {
        look_up_aos(codes, v, |code| self.decode(code))
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
        format.visit(Fill(vectors));
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
        LengthMismatch::check_bytes(v.x.len(), v.y.len(), v.z.len(), bytes.len(), size)?;
        if size == 1 {
            look_up_soa(bytes, v, |&code| self.decode(code.into()))
        } else {
            look_up_soa(bytes.as_chunks().0, v, |&code| self.decode(u16::from_le_bytes(code)))
        }
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
        // The codes of the octant itself.
        for i in 0..1 << C::FORMAT.bits() {
            let code = from_index::<C>(i);
            if let Some(v) = C::place(code).and_then(|place| vectors.get_mut(place)) {
                *v = C::decode(code);
            }
        }
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
        C::look_up_soa(self.vectors, codes, v)
    }

    /// [`decode`](Self::decode) for arrays of structures of `N` floats. The first three become x, y
    /// and z; the others stay as they are. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    pub fn decode_aos<const N: usize>(
        &self,
        codes: &[C::Code],
        v: &mut [[f32; N]],
    ) -> Result<(), LengthMismatch> {
        look_up_aos(codes, v, |code| self.decode(code))
    }
}

/// A codec of at most 16 bits whose decoder is the same, bit for bit, in all octants: for every code
/// and every change of signs there is a code of the mirrored vector. A hemisphere's is so in its
/// four.
///
/// Of the formats of at most 16 bits, spherical16 is so only up to rounding; latlong16, latlong16D,
/// phi-z-unorm8x2, oct-unorm8x2, frontoct16, quadfrontoct16 and fibonacci16 have other points in other octants; icosphere162 is decoded by a
/// table already.
pub trait SignSymmetric: Codec + sealed::Sealed {
    /// How many points the codec has in one octant.
    const ENTRIES: usize;

    /// Where a code of the octant itself stands in its table.
    #[doc(hidden)]
    fn place(code: Self::Code) -> Option<usize>;
    #[doc(hidden)]
    fn look_up(octant: &[[f32; 3]], code: Self::Code) -> [f32; 3];
    #[doc(hidden)]
    fn look_up_soa(
        octant: &[[f32; 3]],
        codes: &[Self::Code],
        v: SoaMut<'_>,
    ) -> Result<(), LengthMismatch>;
}

mod sealed {
    pub trait Sealed {}
}

macro_rules! sign_symmetric {
    ($($codec:ident)*) => {$(
        impl sealed::Sealed for $codec {}

        impl SignSymmetric for $codec {
            const ENTRIES: usize = {
                assert!($codec::FORMAT.bits() <= 16);
                <<$codec as Behind>::Formula as Symmetric>::ENTRIES
            };

            fn place(code: Self::Code) -> Option<usize> {
                place::<<$codec as Behind>::Formula, _>(code)
            }
            #[inline]
            fn look_up(octant: &[[f32; 3]], code: Self::Code) -> [f32; 3] {
                Mirrored::<<$codec as Behind>::Formula>::new(octant).decode::<f32>(&[code])
            }
            #[inline]
            fn look_up_soa(
                octant: &[[f32; 3]],
                codes: &[Self::Code],
                v: SoaMut<'_>,
            ) -> Result<(), LengthMismatch> {
                batch::decode_all(&Mirrored::<<$codec as Behind>::Formula>::new(octant), codes, v)
            }
        }
    )*};
}

sign_symmetric! {
    Oct8 Oct10 Oct12 Oct14 Oct16 WarpedOct16 EqAreaOct16 SixOct16 Octant16 Snorm5x3 HemiOct16 XyOnly16
    Stereo16 StereoConcentric16 StereoEllipse16
    EqArea16 EqAreaConcentric16 EqAreaEllipse16
    EqDist16 EqDistConcentric16 EqDistEllipse16
    Cube16 WarpedCube16
    AngularCube4 AngularCube5 AngularCube6 AngularCube7 AngularCube8 AngularCube9 AngularCube10
    AngularCube11 AngularCube12 AngularCube13 AngularCube14 AngularCube15 AngularCube16
}

/// An octant's table and the formula that it is of.
struct Mirrored<'a, F> {
    octant: &'a [[f32; 3]],
    formula: PhantomData<F>,
}

impl<'a, F> Mirrored<'a, F> {
    #[inline(always)]
    fn new(octant: &'a [[f32; 3]]) -> Self {
        Mirrored { octant, formula: PhantomData }
    }
}

impl<F: Symmetric, C: Stored<One>> Decoder<C> for Mirrored<'_, F> {
    #[inline(always)]
    fn decode<V: Simd>(&self, codes: &V::Block<C>) -> [V; 3] {
        let (index, flips) = F::fold::<V>(C::load::<V>(codes));
        let v = V::gather3(self.octant, index);
        [0, 1, 2].each(|i: usize| V::select(flips[i], -v[i], v[i]))
    }
}

#[inline]
fn place<F: Symmetric, C: Stored<One>>(code: C) -> Option<usize> {
    let (index, [x, y, z]) = F::fold::<f32>(C::load::<f32>(&[code]));
    if (x | y | z).any() { None } else { Some(index.0 as u32 as usize) }
}

struct Fill<'a>(&'a mut [[f32; 3]]);

impl Visitor for Fill<'_> {
    type Output = ();
    #[inline]
    fn visit<C: Codec>(self) {
        fill::<C>(self.0);
    }
}

/// Decodes the codes from 0.
fn fill<C: Codec>(vectors: &mut [[f32; 3]]) {
    let mut codes = [C::Code::zeroed(); STAGE];
    let mut next = 0;
    for vectors in vectors.chunks_mut(STAGE) {
        for code in &mut codes {
            *code = from_index::<C>(next);
            next += 1;
        }
        let codes = &codes[..vectors.len().min(STAGE)];
        // They are equally long.
        let _ = C::decode_aos(codes, vectors);
    }
}

/// The code whose integer is `index`, which is below 2^16.
#[inline]
fn from_index<C: Codec>(index: u32) -> C::Code {
    let mut code = C::Code::zeroed();
    let bytes = bytemuck::bytes_of_mut(&mut code);
    let [low, high, ..] = index.to_le_bytes();
    match bytes {
        [byte] => *byte = low,
        [first, second] => [*first, *second] = u16::from_le_bytes([low, high]).to_ne_bytes(),
        _ => {}
    }
    code
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

/// There is nothing to compute, so there are no lanes.
#[inline]
fn look_up_soa<C>(
    codes: &[C],
    SoaMut { x, y, z }: SoaMut<'_>,
    look_up: impl Fn(&C) -> [f32; 3],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_soa(x.len(), y.len(), z.len(), codes.len())?;
    for (((code, x), y), z) in codes.iter().zip(x).zip(y).zip(z) {
        [*x, *y, *z] = look_up(code);
    }
    Ok(())
}

#[inline]
fn look_up_aos<C: Copy, const N: usize>(
    codes: &[C],
    vectors: &mut [[f32; N]],
    look_up: impl Fn(C) -> [f32; 3],
) -> Result<(), LengthMismatch> {
    const { assert!(N >= 3, "a vector has at least three components") };
    LengthMismatch::check_aos(vectors.len(), codes.len())?;
    for (code, v) in codes.iter().zip(vectors) {
        [v[0], v[1], v[2]] = look_up(*code);
    }
    Ok(())
}
