//! Cartesian: the three components, each on a grid of its own: snorm, half or float.
//!
//! ```text
//! encode   v / |v|, each component to the nearest grid point
//! decode   the three values, divided by their length; (0, 0, 0) reads as +Z
//! ```
//!
//! Decoding divides by the length, so a grid point means its direction, and the precise
//! encoder may take any length: it tries every value of the largest component, rounding the other
//! two, and keeps the nearest direction. From each value to the next the other two components, in
//! steps of the grid, grow by the same amount; in fixed point, with nothing before the point, what
//! rounding leaves of them comes of one addition, which wraps.
//!
//! Canonical: of the patterns of one direction, such as (1, 1, 0) and (90, 90, 0), the one whose
//! length is nearest to 1. That is the one rounding gives. On the grids that are finer than f32,
//! snorm16x3 and float16x3, those that decode alike count as one. Axes survive exactly. In snorm,
//! -M-1 reads as -M; in halves, infinities and NaN read as 65504.
//!
//! [`Floats`] stores the bits of the input as they are, and gives them back.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; the search over lengths: Kaplanyan, "CryENGINE 3: Reaching the Speed of Light", 2010.

mod best_fit;
mod floats;
mod grid;
mod search;

pub(crate) use best_fit::BestFit;
pub(crate) use floats::Floats;

use super::support::sign::mirror_point;
use super::{Code, Formula, Symmetric, kernels};
use crate::batch::storage::Words;
use crate::simd::{Simd, SimdInt, Use, Vec3};
use grid::{Fine, Grid, Steps};
use search::Search;

/// Three components on a grid.
#[derive(Clone, Copy)]
pub(crate) struct Cartesian<G>(G);

/// Snorm or biased unorm, in one word.
pub(crate) type Xyz = Cartesian<Steps>;
/// Snorm, biased unorm or halves, of 16 bits each.
pub(crate) type Xyz16 = Cartesian<Fine>;

impl Xyz {
    /// Snorm with a number of bits for x, y and z. None has more than x.
    #[inline]
    pub(crate) const fn snorm(bits: [u32; 3]) -> Self {
        Cartesian(Steps::snorm(bits))
    }

    /// Biased unorm with `bits` bits for each.
    pub(crate) const fn unorm(bits: u32) -> Self {
        Cartesian(Steps::unorm(bits))
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        let [x, y, z] = self.0.bits();
        1 << (x + y + z - 3)
    }
}

impl Xyz16 {
    #[inline]
    pub(crate) const fn snorm() -> Self {
        Cartesian(Fine::Steps(Steps::snorm([16; 3])))
    }

    pub(crate) const fn unorm() -> Self {
        Cartesian(Fine::Steps(Steps::unorm(16)))
    }

    pub(crate) const fn halves() -> Self {
        Cartesian(Fine::Halves)
    }
}

impl<G: Grid> Cartesian<G> {
    #[inline(always)]
    fn nearest<V: Simd>(self, v: Vec3<V>) -> Vec3<V::Int> {
        let Cartesian(grid) = self;
        let [x, y, z] = grid.steps();
        Vec3::new(grid.nearest(v.x, x), grid.nearest(v.y, y), grid.nearest(v.z, z))
    }

    #[inline(always)]
    fn values<V: Simd>(self, point: Vec3<V::Int>) -> Vec3<V> {
        let Cartesian(grid) = self;
        let [x, y, z] = grid.step();
        Vec3::new(grid.value(point.x, x), grid.value(point.y, y), grid.value(point.z, z))
    }

    /// The point of a code; (0, 0, 0) is +Z.
    #[inline(always)]
    fn point<V: Simd>(self, code: Code<Self, V>) -> Vec3<V::Int> {
        let point = self.0.unpack::<V>(code);
        let is_zero = (point.x | point.y | point.z).eq(0);
        let pole = self.0.nearest(V::splat(1.0), self.0.steps()[2]);
        Vec3 { z: V::Int::select(is_zero, pole, point.z), ..point }
    }

    #[inline(always)]
    fn unit<V: Simd>(values: Vec3<V>) -> Vec3<V> {
        let is_zero = values.length_squared().le(0.0);
        Vec3 { z: V::select(is_zero, 1.0, values.z), ..values }.normalize()
    }
}

impl<G: Grid> Formula for Cartesian<G> {
    type Shape = G::Shape;
    const PRECISE_USE: Use = if G::DISTINCT { Use::Often } else { Use::Rare };

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> Code<Self, V> {
        self.0.pack::<V>(self.nearest(v.normalize()))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> Code<Self, V> {
        V::with_target_features(
            #[inline(always)]
            || {
                let Cartesian(grid) = self;
                let search = Search::new(grid, v);
                let point = if G::DISTINCT {
                    grid.representative::<V>(search.nearest_whole())
                } else {
                    search.nearest()
                };
                grid.pack::<V>(point)
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: Code<Self, V>) -> Vec3<V> {
        Self::unit(self.values::<V>(self.0.unpack::<V>(code)))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: Code<Self, V>, flips: [bool; 3]) -> Code<Self, V> {
        if !G::DISTINCT {
            return self.mirror_decoded::<V>(code, flips);
        }
        let point = mirror_point(self.point::<V>(code), flips);
        self.0.pack::<V>(self.0.representative::<V>(point))
    }
}

impl Symmetric for Xyz {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let [x, y, _] = self.0.bits();
        let point = self.0.unpack::<V>(code);
        let Vec3 { x: i, y: j, z: k } = point.abs_int();
        (i | j.shl(x - 1) | k.shl(x + y - 2), point.is_negative_int())
    }
}

kernels!(Xyz: Words; Xyz16: [u8; 6]; BestFit: [u8; 3], BestFit::UNORM8; Floats: [u8; 12]);
