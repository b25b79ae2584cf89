//! Phi-z: the azimuth and z, each as biased unorm, (c + 1) / 2.
//!
//! ```text
//! encode   code = unorm((atan2(y, x) / pi + 1) / 2), unorm((z + 1) / 2)
//! decode   v = (sqrt(1 - z^2) cos phi, sqrt(1 - z^2) sin phi, z)
//! ```
//!
//! Canonical: at the poles the azimuth is the first above 0; that of -X is the greatest. Of the
//! axes, +-Z survive exactly, and -X at z = 0 would if unorm had a zero.
//!
//! Source: Narkowicz, "Octahedron Normal Vector Encoding", 2014 (spherical coordinates).

use super::support::bits::Pair;
use super::support::closest::{Closest, corners};
use super::{Formula, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{atan2_half_turns, sin_cos_quarter_turns, sqrt};
use crate::simd::{Simd, SimdInt, Vec3, map2};

/// Phi-z.
#[derive(Clone, Copy)]
pub(crate) struct PhiZ {
    pair: Pair,
    max: i32,
    half: f32,
    step: f32,
}

impl PhiZ {
    pub(crate) const fn new(bits: u32) -> Self {
        let pair = Pair::new(bits);
        let max = pair.unorm_max();
        PhiZ { pair, max, half: 0.5 * max as f32, step: 1.0 / max as f32 }
    }

    /// The two parameters, scaled to M.
    #[inline(always)]
    fn params<V: Simd>(self, v: Vec3<V>) -> [V; 2] {
        let Vec3 { x, y, z } = v.normalize();
        [atan2_half_turns(y, x) * self.half + self.half, z * self.half + self.half]
    }

    /// The nearest parameters in range, canonical.
    #[inline(always)]
    fn canonical_params<V: Simd>(self, [phi, z]: [V::Int; 2]) -> [V::Int; 2] {
        let z = z.clamp(0, self.max);
        // The seam: 0 is the same as M, and one step below is one step back from M. None is above M.
        let phi = V::Int::select(V::Int::splat(0).lt(phi), phi, phi + self.max);
        let pole = z.eq(0) | z.eq(self.max);
        [V::Int::select(pole, self.max / 2 + 1, phi), z]
    }

    #[inline(always)]
    fn vector<V: Simd>(self, params: [V::Int; 2]) -> Vec3<V> {
        let max = V::Int::splat(self.max);
        let [phi, z] = map2!(params, |i| i + i - self.max);
        let (sin, cos) = sin_cos_quarter_turns(V::from_int(phi) * (self.step + self.step));
        // 1 - z^2, without cancellation.
        let rr = (V::from_int(max - z) * self.step) * (V::from_int(max + z) * self.step);
        let r = sqrt(rr);
        // The roundings of root, sine and cosine together may put the length off by more than 2.5e-7.
        Vec3::new(r * cos, r * sin, V::from_int(z) * self.step).normalize()
    }
}

impl Formula for PhiZ {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let params = map2!(self.params(v), |p| p.round_int());
        self.pair.pack::<V>(self.canonical_params::<V>(params))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let mut closest = Closest::to(v);
        for params in corners(self.params(v)) {
            let params = self.canonical_params::<V>(params);
            closest.consider(self.pair.pack::<V>(params), self.vector(params));
        }
        closest.code()
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        self.vector(self.pair.unpack::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        if flips[0] {
            // Half a turn is no whole number of steps.
            return self.mirror_decoded::<V>(code, flips);
        }
        let max = V::Int::splat(self.max);
        let [phi, z] = self.pair.unpack::<V>(code);
        let phi = if flips[1] { max - phi } else { phi };
        let z = if flips[2] { max - z } else { z };
        self.pair.pack::<V>(self.canonical_params::<V>([phi, z]))
    }
}

kernels!(PhiZ: Words);
