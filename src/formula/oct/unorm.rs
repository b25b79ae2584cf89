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
