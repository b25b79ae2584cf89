//! Decode tables without the types of their codecs.

use unitpack::decode_table::{DecodeTable, OctantTable, SignSymmetric};
use unitpack::{Codec, Format, LengthMismatch, SoaMut};

use crate::codes::{native, natives};
use crate::{Code, Outcome, Vector};

/// A table that is filled.
pub trait Table: Send + Sync {
    /// The vector of one code.
    fn decode(&self, code: Code) -> Vector;
    /// The functions of slices. Octants have them for one format of each family and width of code
    /// only, as their loops are compiled for every codec.
    fn slices(&self) -> Option<&dyn Slices>;
}

/// A table's functions of slices.
pub trait Slices: Send + Sync {
    /// To a structure of arrays.
    fn decode_soa(&self, codes: &[Code], v: SoaMut<'_>) -> Outcome;
    /// To structures of three, four or eight floats.
    fn decode_aos(&self, codes: &[Code], floats: usize, v: &mut [f32]) -> Outcome;
}

/// A kind of table for one format.
pub struct AnyTable {
    /// The format.
    pub format: Format,
    /// How many vectors it has.
    pub len: usize,
    /// Fills it.
    pub fill: Fill,
}

/// A table's `fill`.
pub type Fill = fn(&mut [Vector]) -> Filled<'_>;
/// A filled table, which borrows its vectors.
pub type Filled<'a> = Result<Box<dyn Table + 'a>, LengthMismatch>;

/// A table of an octant whose slices are left alone.
struct Singles<'a, C: SignSymmetric>(OctantTable<'a, C>);

impl<C: SignSymmetric + Send + Sync> Table for Singles<'_, C> {
    fn decode(&self, code: Code) -> Vector {
        self.0.decode(native(code))
    }
    fn slices(&self) -> Option<&dyn Slices> {
        None
    }
}

macro_rules! with_slices {
    ($table:ident of $bound:ident) => {
        impl<C: $bound + Send + Sync> Table for $table<'_, C> {
            fn decode(&self, code: Code) -> Vector {
                self.decode(native(code))
            }
            fn slices(&self) -> Option<&dyn Slices> {
                Some(self)
            }
        }

        impl<C: $bound + Send + Sync> Slices for $table<'_, C> {
            fn decode_soa(&self, codes: &[Code], v: SoaMut<'_>) -> Outcome {
                self.decode_soa(&natives(codes), v)
            }
            fn decode_aos(&self, codes: &[Code], floats: usize, v: &mut [f32]) -> Outcome {
                let codes = &natives(codes);
                match floats {
                    3 => self.decode_aos(codes, v.as_chunks_mut::<3>().0),
                    4 => self.decode_aos(codes, v.as_chunks_mut::<4>().0),
                    8 => self.decode_aos(codes, v.as_chunks_mut::<8>().0),
                    _ => panic!("no structures of {floats} floats"),
                }
            }
        }
    };
}

with_slices!(DecodeTable of Codec);
with_slices!(OctantTable of SignSymmetric);

fn whole<C: Codec + Send + Sync>() -> AnyTable {
    AnyTable { format: C::FORMAT, len: DecodeTable::<C>::LEN, fill: fill_whole::<C> }
}

fn octant<C: SignSymmetric + Send + Sync>() -> AnyTable {
    AnyTable { format: C::FORMAT, len: OctantTable::<C>::LEN, fill: fill_octant::<C> }
}

fn octant_singles<C: SignSymmetric + Send + Sync>() -> AnyTable {
    AnyTable { format: C::FORMAT, len: OctantTable::<C>::LEN, fill: fill_octant_singles::<C> }
}

fn fill_whole<C: Codec + Send + Sync>(vectors: &mut [Vector]) -> Filled<'_> {
    Ok(Box::new(DecodeTable::<C>::fill(vectors)?))
}

fn fill_octant<C: SignSymmetric + Send + Sync>(vectors: &mut [Vector]) -> Filled<'_> {
    Ok(Box::new(OctantTable::<C>::fill(vectors)?))
}

fn fill_octant_singles<C: SignSymmetric + Send + Sync>(vectors: &mut [Vector]) -> Filled<'_> {
    Ok(Box::new(Singles(OctantTable::<C>::fill(vectors)?)))
}

macro_rules! list {
    ($($kind:ident: $($name:ident)*;)*) => {
        vec![$($($kind::<unitpack::$name>(),)*)*]
    };
}

/// The tables of every code.
#[inline]
pub fn whole_tables() -> Vec<AnyTable> {
    list! {
        whole: Oct8 Oct10 Oct12 Oct14 Oct16 WarpedOct16 EqAreaOct16 SixOct16 FrontOct16
            QuadFrontOct16 OctUnorm8x2 Snorm5x3 Spherical16 PhiZUnorm8x2 HemiOct16 XyOnly16
            Stereo16 StereoConcentric16 StereoEllipse16 EqArea16 EqAreaConcentric16 EqAreaEllipse16
            EqDist16 EqDistConcentric16 EqDistEllipse16
            LatLong16 LatLong16D Fibonacci16 Cube16 WarpedCube16
            AngularCube4 AngularCube5 AngularCube6 AngularCube7 AngularCube8 AngularCube9
            AngularCube10 AngularCube11 AngularCube12 AngularCube13 AngularCube14 AngularCube15
            AngularCube16 Octant16 Icosphere162;
    }
}

/// The tables of one octant.
#[inline]
pub fn octant_tables() -> Vec<AnyTable> {
    list! {
        octant: Oct8 Oct10 WarpedOct16 EqAreaOct16 SixOct16 Snorm5x3 HemiOct16 XyOnly16
            Stereo16 StereoConcentric16 StereoEllipse16 EqArea16 EqAreaConcentric16 EqAreaEllipse16
            EqDist16 EqDistConcentric16 EqDistEllipse16 Cube16 WarpedCube16
            AngularCube4 AngularCube9 Octant16;
        octant_singles: Oct12 Oct14 Oct16 AngularCube5 AngularCube6 AngularCube7 AngularCube8
            AngularCube10 AngularCube11 AngularCube12 AngularCube13 AngularCube14 AngularCube15
            AngularCube16;
    }
}
