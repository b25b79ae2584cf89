//! Octahedral for UNORM render targets.

use super::lattice::{Steps, plus_on_border, unfold};
use crate::batch::storage::Word;
use crate::formula::Formula;
use crate::formula::support::bits::Pair;
use crate::formula::support::closest::{Closest, corners};
use crate::simd::{Simd, SimdInt, Vec3, map2};

/// Octahedral in biased unorm, (c + 1) / 2: the odd numbers from -M to M = 2^(BITS/2) - 1. It has no
/// zero, so of the axes only -Z, a corner of the square, survives.
///
/// Source: Narkowicz, "Octahedron Normal Vector Encoding", 2014.
#[derive(Clone, Copy)]
pub(crate) struct OctUnorm {
    pair: Pair,
    steps: Steps,
}

impl OctUnorm {
    pub(crate) const fn new(bits: u32) -> Self {
        let pair = Pair::new(bits);
        OctUnorm { pair, steps: Steps::new(pair.unorm_max()) }
    }

    /// The two parameters as indices from 0 to M.
    #[inline(always)]
    fn params<V: Simd>(self, v: Vec3<V>) -> [V; 2] {
        let half = V::splat(0.5 * self.steps.float);
        let Vec3 { x, y, z } = v.abs();
        let scale = half / (x + y + z);
        let (x, y) = (x * scale, y * scale);
        // Fold the lower half over the diagonals.
        let lower = v.z.lt(0.0);
        let u = V::select(lower, half - y, x).negate_where_negative(v.x);
        let w = V::select(lower, half - x, y).negate_where_negative(v.y);
        [u + half, w + half]
    }

    /// The point of the square nearest to two indices, canonical.
    #[inline(always)]
    fn canonical_point<V: Simd>(self, indices: [V::Int; 2]) -> [V::Int; 2] {
        let max = self.steps.count;
        plus_on_border::<V>(map2!(indices, |i| (i + i - max).clamp(-max, max)), max)
    }

    #[inline(always)]
    fn vector<V: Simd>(self, point: [V::Int; 2]) -> Vec3<V> {
        let p = Vec3::from_int(unfold::<V>(point, self.steps.count)) * self.steps.inverse;
        p.normalize()
    }

    #[inline(always)]
    fn pack<V: Simd>(self, point: [V::Int; 2]) -> V::Int {
        self.pair.pack::<V>(map2!(point, |i| (i + self.steps.count).shr_arithmetic(1)))
    }
}

impl Formula for OctUnorm {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let indices = map2!(self.params(v), |p| p.round_int());
        self.pack::<V>(self.canonical_point::<V>(indices))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let mut closest = Closest::to(v);
        for indices in corners(self.params(v)) {
            let point = self.canonical_point::<V>(indices);
            closest.consider(self.pack::<V>(point), self.vector(point));
        }
        closest.code()
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        let max = self.steps.count;
        self.vector(map2!(self.pair.unpack::<V>(code), |i| i + i - max))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        let [x, y, z] = flips;
        if z {
            // Odd numbers, folded over the diagonals, are even.
            return self.mirror_decoded::<V>(code, flips);
        }
        let [u, w] = self.pair.unpack::<V>(code);
        let max = V::Int::splat(self.steps.count);
        let indices = [if x { max - u } else { u }, if y { max - w } else { w }];
        self.pack::<V>(self.canonical_point::<V>(indices))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::{VECTORS, assert_nearest};

    const OCT: OctUnorm = OctUnorm::new(16);

    fn mirror(code: i32, flips: [bool; 3]) -> i32 {
        OCT.mirror::<f32>(code.into(), flips).0
    }

    #[test]
    fn parameters_are_biased_and_the_lower_half_is_folded() {
        // 127.5 (1 + 0.1) = 140.25 and 127.5 (1 + 0.2) = 153.
        assert_eq!(OCT.encode(Vec3::new(1.0f32, 2.0, 7.0)).0, 0x998C);
        // Folded over the diagonals (1 - 0.1, 1 - 0.3): 127.5 (1 + 0.9) = 242.25, 127.5 (1 + 0.7) = 216.75.
        assert_eq!(OCT.encode(Vec3::new(3.0f32, 1.0, -6.0)).0, 0xD9F2);
        assert_eq!(OCT.encode(Vec3::new(-3.0f32, 1.0, -6.0)).0, 0xD90D);
    }

    #[test]
    fn there_is_no_zero() {
        // Half of 255 is a tie, and 128 is (2 * 128 - 255) / 255 = 1/255.
        let code = OCT.encode(Vec3::new(0.0f32, 0.0, 1.0));
        assert_eq!(code.0, 0x8080);
        let v = OCT.decode::<f32>(code);
        assert_eq!(v.x, v.y);
        assert!((v.x * 253.0 - v.z).abs() < 1e-6);
    }

    #[test]
    fn the_lower_pole_survives() {
        let pole = Vec3::new(0.0f32, 0.0, -1.0);
        assert_eq!(OCT.encode(pole).0, 0xFFFF);
        assert_eq!(OCT.encode_precise(pole).0, 0xFFFF);
        assert_eq!(OCT.decode::<f32>(0xFFFF.into()), pole);
    }

    #[test]
    fn on_the_border_the_greater_index_counts() {
        // Index 77 is -101/255, and 178 is 101/255.
        for (code, canonical) in [(0x4D00, 0xB200), (0x00B2, 0x00B2), (0xFF4D, 0xFFB2), (0, 0xFFFF)]
        {
            assert_eq!(mirror(code, [false; 3]), canonical, "{code:x}");
        }
    }

    #[test]
    fn mirrored_indices_count_from_the_other_end() {
        assert_eq!(mirror(0x998C, [true, false, false]), 0x9973);
        assert_eq!(mirror(0x998C, [false, true, false]), 0x668C);
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        assert_nearest(OctUnorm::new(8), 256, VECTORS);
    }
}
