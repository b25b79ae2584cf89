//! Decode tables without the types of their codecs.

use unitpack::decode_table::{DecodeTable, OctantTable, SignSymmetric};
use unitpack::{Codec, Format, LengthMismatch, SoaMut, Visitor};

use crate::codes::{native, natives};
use crate::{Code, Outcome, Vector, representatives};

/// A table that is filled.
pub trait Table {
    /// The vector of one code.
    fn decode(&self, code: Code) -> Vector;
    /// The functions of slices. Octants have them for one format of each family and width of code
    /// only, as their loops are compiled for every codec.
    fn slices(&self) -> Option<&dyn Slices>;
}

/// A table's functions of slices.
pub trait Slices {
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

impl<C: SignSymmetric> Table for Singles<'_, C> {
    fn decode(&self, code: Code) -> Vector {
        self.0.decode(native(code))
    }
    fn slices(&self) -> Option<&dyn Slices> {
        None
    }
}

macro_rules! with_slices {
    ($table:ident of $bound:ident) => {
        impl<C: $bound> Table for $table<'_, C> {
            fn decode(&self, code: Code) -> Vector {
                self.decode(native(code))
            }
            fn slices(&self) -> Option<&dyn Slices> {
                Some(self)
            }
        }

        impl<C: $bound> Slices for $table<'_, C> {
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

/// A table of every code, if the codec has one.
struct Whole;

impl Visitor for Whole {
    type Output = Option<AnyTable>;
    fn visit<C: Codec>(self) -> Option<AnyTable> {
        // Of longer codes none is compiled.
        let fill =
            const { if C::FORMAT.bits() <= 16 { Some(fill_whole::<C> as Fill) } else { None } };
        fill.map(|fill| AnyTable { format: C::FORMAT, len: 1 << C::FORMAT.bits(), fill })
    }
}

fn octant<C: SignSymmetric>() -> AnyTable {
    let fill = const {
        if representatives::contains(C::FORMAT) {
            fill_octant::<C> as Fill
        } else {
            fill_octant_singles::<C>
        }
    };
    AnyTable { format: C::FORMAT, len: OctantTable::<C>::LEN, fill }
}

fn fill_whole<C: Codec>(vectors: &mut [Vector]) -> Filled<'_> {
    Ok(Box::new(DecodeTable::<C>::fill(vectors)?))
}

fn fill_octant<C: SignSymmetric>(vectors: &mut [Vector]) -> Filled<'_> {
    Ok(Box::new(OctantTable::<C>::fill(vectors)?))
}

fn fill_octant_singles<C: SignSymmetric>(vectors: &mut [Vector]) -> Filled<'_> {
    Ok(Box::new(Singles(OctantTable::<C>::fill(vectors)?)))
}

/// The tables of every code, for all formats of at most 16 bits.
#[inline]
pub fn whole_tables() -> Vec<AnyTable> {
    Format::ALL.iter().filter_map(|&format| format.visit(Whole)).collect()
}

/// The tables of one octant, for all formats that have one.
#[inline]
pub fn octant_tables() -> Vec<AnyTable> {
    let mut tables = Vec::new();
    macro_rules! push {
        ($name:ident) => {
            tables.push(octant::<unitpack::$name>())
        };
    }
    unitpack::for_each_codec!(octant: push);
    tables
}
