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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::{VECTORS, assert_nearest};

    const PHI_Z: PhiZ = PhiZ::new(16);

    fn mirror(code: i32, flips: [bool; 3]) -> i32 {
        PHI_Z.mirror::<f32>(code.into(), flips).0
    }

    #[test]
    fn parameters_are_azimuth_and_height() {
        // phi = 90 degrees: 127.5 (1 + 1/2) = 191.25; z = -0.2: 127.5 (1 - 0.2) = 102.
        let v = Vec3::new(0.0f32, 0.979_795_9, -0.2);
        assert_eq!([PHI_Z.encode(v).0, PHI_Z.encode_precise(v).0], [0x66BF; 2]);
        // 180 (2 * 191 - 255) / 255 = 89.64706 degrees.
        let decoded = PHI_Z.decode::<f32>(0x66BF.into());
        let expected = Vec3::new(0.006_035_4, 0.979_777_3, -0.2);
        assert!(decoded.distance_squared(expected) < 1e-12, "{decoded:?}");
    }

    #[test]
    fn poles_survive_with_the_first_azimuth_above_zero() {
        for (axis, code) in [([0.0f32, 0.0, 1.0], 0xFF80), ([0.0, 0.0, -1.0], 0x0080)] {
            assert_eq!(PHI_Z.encode(axis.into()).0, code);
            assert_eq!(PHI_Z.encode_precise(axis.into()).0, code);
            assert_eq!(PHI_Z.decode::<f32>(code.into()).to_array(), axis);
        }
        assert_eq!([mirror(0xFF00, [false; 3]), mirror(0x00FF, [false; 3])], [0xFF80, 0x0080]);
    }

    #[test]
    fn the_seam_has_the_greatest_azimuth() {
        assert_eq!(mirror(0x6600, [false; 3]), 0x66FF);
        // z = 0 is half way between 127 and 128.
        assert_eq!(PHI_Z.encode(Vec3::new(-1.0f32, 0.0, 0.0)).0, 0x80FF);
        assert_eq!(PHI_Z.encode(Vec3::new(-1.0f32, -0.001, 0.0)).0, 0x80FF);
    }

    #[test]
    fn mirrored_indices_count_from_the_other_end() {
        assert_eq!(mirror(0x66BF, [false, true, false]), 0x6640);
        assert_eq!(mirror(0x66BF, [false, false, true]), 0x99BF);
        // With x negated 191 would be 191.5.
        assert!([0x66BF, 0x66C0].contains(&mirror(0x66BF, [true, false, false])));
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        assert_nearest(PhiZ::new(8), 256, VECTORS);
    }
}
