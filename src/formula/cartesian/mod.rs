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
//! snorm12x3, snorm16x3 and float16x3, those that decode alike count as one. Axes survive exactly. In snorm,
//! -M-1 reads as -M; in halves, infinities and NaN read as 65504.
//!
//! Biased snorm, (c - 128) / 127 in bytes, has the points of snorm in offset binary, as textures of unsigned
//! bytes need it: only the sign bits differ. 128 is zero, and 0 reads as 1.
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

use super::octant_table::octant_kernels;
use super::support::sign::mirror_point;
use super::{Code, Formula, Symmetric, kernels};
use crate::batch::storage::Words;
use crate::simd::{Simd, SimdInt, Use, Vec3};
use grid::{Fine, Grid, Steps};
use search::Search;

/// Three components on a grid.
#[derive(Clone, Copy)]
pub(crate) struct Cartesian<G>(G);

/// Snorm or scaled and biased unorm, in one word.
pub(crate) type Xyz = Cartesian<Steps>;
/// Snorm, scaled and biased unorm or halves, in a word of 16 bits each.
pub(crate) type Xyz16 = Cartesian<Fine>;

impl Xyz {
    /// Snorm with a number of bits for x, y and z. None has more than x.
    #[inline]
    pub(crate) const fn snorm(bits: [u32; 3]) -> Self {
        Cartesian(Steps::snorm(bits))
    }

    /// Scaled and biased unorm with `bits` bits for each.
    pub(crate) const fn unorm(bits: u32) -> Self {
        Cartesian(Steps::unorm(bits))
    }

    /// Snorm in offset binary, with `bits` bits for each: in bytes, 128 is zero.
    pub(crate) const fn biased(bits: u32) -> Self {
        Cartesian(Steps::biased(bits))
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        let [x, y, z] = self.0.bits();
        1 << (x + y + z - 3)
    }
}

impl Xyz16 {
    /// Snorm with `bits` bits for each, the sign repeated in those above.
    #[inline]
    pub(crate) const fn snorm(bits: u32) -> Self {
        Cartesian(Fine::Steps(Steps::snorm([bits; 3])))
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
octant_kernels!(Xyz);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    const SNORM8: Xyz = Xyz::snorm([8, 8, 8]);
    const SNORM5: Xyz = Xyz::snorm([5, 5, 5]);
    const SNORM11_10: Xyz = Xyz::snorm([11, 11, 10]);
    const UNORM8: Xyz = Xyz::unorm(8);
    const BIASED8: Xyz = Xyz::biased(8);
    const SNORM16: Xyz16 = Xyz16::snorm(16);
    const SNORM12: Xyz16 = Xyz16::snorm(12);
    const HALVES: Xyz16 = Xyz16::halves();

    fn canonical(formula: Xyz, code: i32) -> i32 {
        formula.mirror::<f32>(code.into(), [false; 3]).0
    }

    fn canonical16(formula: Xyz16, code: [i32; 3]) -> [i32; 3] {
        // Only the low bits are stored.
        formula.mirror::<f32>(code.map(I32x1), [false; 3]).map(|c| c.0 & 0xFFFF)
    }

    #[test]
    fn components_are_rounded_each_for_itself() {
        let v = Vec3::new(0.48f32, 0.36, 0.8);
        // 127 v = (60.96, 45.72, 101.6).
        assert_eq!(SNORM8.encode(v * 9.0).0, 0x66_2E3D);
        assert_eq!(SNORM8.encode(-v).0, 0x9A_D2C3);
        // 128 more, with or without sign.
        assert_eq!([BIASED8.encode(v).0, BIASED8.encode(-v).0], [0xE6_AEBD, 0x1A_5243]);
        // 1023 * 0.48 = 491.04, 1023 * 0.36 = 368.28, 511 * 0.8 = 408.8.
        assert_eq!(SNORM11_10.encode(v).0, 491 | 368 << 11 | 409 << 22);
        // 127.5 (1 + c): 204, 209.1 and 188.7.
        let w = Vec3::new(0.6f32, 0.64, 0.48);
        assert_eq!(UNORM8.encode(w).0, 0xBD_D1CC);
        // 32767 w = (19660.2, 20970.9, 15728.2).
        assert_eq!(SNORM16.encode(w).map(|c| c.0), [19_660, 20_971, 15_728]);
        // 0.5 (1 + 205/1024), 0.5 (1 + 287/1024) and 0.25 (1 + 942/1024).
        assert_eq!(HALVES.encode(w).map(|c| c.0), [0x38CD, 0x391F, 0x37AE]);
        // 2047 w = (1228.2, 1310.1, 982.6), and a negative one has its sign in all bits above.
        assert_eq!(SNORM12.encode(w).map(|c| c.0), [1228, 1310, 983]);
        assert_eq!(SNORM12.encode(-w).map(|c| c.0 & 0xFFFF), [0xFB34, 0xFAE2, 0xFC29]);
    }

    #[test]
    fn decoding_divides_by_the_length() {
        // (3, 4, 12) of length 13, on the grids of whole steps, and -(1, 1, 1) of odd ones.
        let expected = Vec3::new(3.0f32, 4.0, 12.0) * (1.0 / 13.0);
        for v in [
            SNORM8.decode::<f32>(0x0C_0403.into()),
            BIASED8.decode::<f32>(0x8C_8483.into()),
            SNORM5.decode::<f32>((3 | 4 << 5 | 12 << 10).into()),
            SNORM16.decode::<f32>([3, 4, 12].map(I32x1)),
            HALVES.decode::<f32>([0x4200, 0x4400, 0x4A00].map(I32x1)),
        ] {
            assert!(v.distance_squared(expected) < 1e-12, "{v:?}");
        }
        let v = UNORM8.decode::<f32>(0x7F_7F7F.into());
        assert!(v.distance_squared(Vec3::from([-0.577_350_3; 3])) < 1e-12, "{v:?}");
    }

    #[test]
    fn axes_survive() {
        for axis in 0..6 {
            let mut v = [0.0f32; 3];
            v[axis / 2] = if axis % 2 == 0 { 1.0 } else { -1.0 };
            for formula in [SNORM8, SNORM5, SNORM11_10, BIASED8] {
                for code in [formula.encode(v.into()), formula.encode_precise(v.into())] {
                    assert_eq!(formula.decode::<f32>(code).to_array(), v);
                }
            }
            for formula in [SNORM16, HALVES] {
                for code in [formula.encode(v.into()), formula.encode_precise(v.into())] {
                    assert_eq!(formula.decode::<f32>(code).to_array(), v);
                }
            }
        }
    }

    #[test]
    fn of_one_direction_the_code_of_about_unit_length_is_canonical() {
        // 127 / sqrt(2) = 89.8; 15 / sqrt(14) = 4.01; odd multiples of (1, 1, 1) near 255 / sqrt(3) = 147.2.
        assert_eq!(canonical(SNORM8, 0x00_0101), 0x00_5A5A);
        assert_eq!(canonical(SNORM8, 0x00_007F), 0x00_007F);
        assert_eq!(canonical(BIASED8, 0x80_8181), 0x80_DADA);
        assert_eq!(canonical(SNORM5, 1 | 2 << 5 | 3 << 10), 4 | 8 << 5 | 12 << 10);
        assert_eq!(canonical(UNORM8, 0x80_8080), 0xC9_C9C9);
        // 1023 / 409.2 is a little less than 2.5, but 5 times half of it is still below 2: so three times.
        assert_eq!(canonical(SNORM11_10, 244 | 328 << 11 | 9 << 22), 732 | 984 << 11 | 27 << 22);
        // 32767 / sqrt(3) = 18918.04.
        assert_eq!(canonical16(SNORM16, [1, 1, 1]), [18_918; 3]);
        assert_eq!(canonical16(HALVES, [0x4200, 0, 0x8000]), [0x3C00, 0, 0]);
    }

    #[test]
    fn zero_reads_as_the_pole() {
        assert_eq!(SNORM8.decode::<f32>(0.into()).to_array(), [0.0, 0.0, 1.0]);
        assert_eq!([canonical(SNORM8, 0), canonical(SNORM5, 0)], [0x7F_0000, 15 << 10]);
        assert_eq!(BIASED8.decode::<f32>(0x80_8080.into()).to_array(), [0.0, 0.0, 1.0]);
        assert_eq!(canonical(BIASED8, 0x80_8080), 0xFF_8080);
        assert_eq!(canonical16(SNORM16, [0; 3]), [0, 0, 0x7FFF]);
        assert_eq!(canonical16(HALVES, [0, 0x8000, 0]), [0, 0, 0x3C00]);
    }

    #[test]
    fn what_is_out_of_range_reads_as_the_greatest() {
        assert_eq!(canonical(SNORM8, 0x80), 0x81);
        assert_eq!(canonical(BIASED8, 0x80_8000), 0x80_8001);
        assert_eq!(canonical(SNORM11_10, 0x200 << 22), 0x201 << 22);
        assert_eq!(canonical16(SNORM16, [0x8000, 0, 0]), [0x8001, 0, 0]);
        // What is above the 12 bits does not count, and -2048 is -2047.
        assert_eq!(canonical16(SNORM12, [0x1800, 0xF000, 0x8000]), [0xF801, 0, 0]);
        // Infinity, NaN and 65504 are one number.
        let v = HALVES.decode::<f32>([0x7C00, 0xFE00, 0x7BFF].map(I32x1));
        assert!(v.x == v.z && v.x == -v.y);
    }

    #[test]
    fn the_nearest_code_may_be_of_another_length() {
        // Of (14, 13, 0) the unit vector is (10.99, 10.21) / 15.
        let v = Vec3::new(14.0f32, 13.0, 0.0);
        assert_eq!([SNORM5.encode(v).0, SNORM5.encode_precise(v).0], [11 | 10 << 5, 14 | 13 << 5]);
    }
}
