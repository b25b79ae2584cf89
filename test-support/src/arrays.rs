//! Vectors as a structure of arrays.

use unitpack::{Soa, SoaMut};

use crate::Vector;
use crate::vectors::widen;

/// A float that no decoder gives, except that of `Float32x3` for one input in 2^32.
pub const UNWRITTEN: f32 = -7.252_952_6e22;

/// Vectors as a structure of arrays. The arrays may have different lengths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrays {
    /// The first components.
    pub x: Vec<f32>,
    /// The second components.
    pub y: Vec<f32>,
    /// The third components.
    pub z: Vec<f32>,
}

impl Arrays {
    /// Arrays of these lengths, filled with one number.
    pub fn filled([x, y, z]: [usize; 3], with: f32) -> Self {
        let array = |length| vec![with; length];
        Arrays { x: array(x), y: array(y), z: array(z) }
    }

    /// Arrays of these lengths, filled with [`UNWRITTEN`].
    pub fn unwritten(lengths: [usize; 3]) -> Self {
        Arrays::filled(lengths, UNWRITTEN)
    }

    /// How many vectors there are, if all arrays have one length.
    pub fn count(&self) -> usize {
        self.x.len()
    }

    /// Adds one vector.
    pub fn push(&mut self, [x, y, z]: Vector) {
        self.x.push(x);
        self.y.push(y);
        self.z.push(z);
    }

    /// To encode from.
    pub fn read(&self) -> Soa<'_> {
        Soa { x: &self.x, y: &self.y, z: &self.z }
    }

    /// To decode to.
    pub fn write(&mut self) -> SoaMut<'_> {
        SoaMut { x: &mut self.x, y: &mut self.y, z: &mut self.z }
    }

    /// The vectors, as many as the shortest array has.
    pub fn iter(&self) -> impl Iterator<Item = Vector> + Clone {
        self.x.iter().zip(&self.y).zip(&self.z).map(|((&x, &y), &z)| [x, y, z])
    }

    /// The vectors in `f64`.
    pub fn wide(&self) -> impl Iterator<Item = [f64; 3]> + Clone {
        self.iter().map(widen)
    }

    /// The bits of each vector.
    pub fn bits(&self) -> impl Iterator<Item = [u32; 3]> {
        self.iter().map(|v| v.map(f32::to_bits))
    }
}

impl FromIterator<Vector> for Arrays {
    fn from_iter<I: IntoIterator<Item = Vector>>(vectors: I) -> Self {
        let mut all = Arrays::default();
        vectors.into_iter().for_each(|v| all.push(v));
        all
    }
}

impl From<&[Vector]> for Arrays {
    fn from(vectors: &[Vector]) -> Self {
        vectors.iter().copied().collect()
    }
}
