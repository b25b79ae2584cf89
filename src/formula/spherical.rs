//! Spherical: the polar angle and the azimuth.
//!
//! ```text
//! encode   theta = atan2(hypot(x, y), z), phi = atan2(y, x);  code = snorm(2 theta / pi - 1), snorm(phi / pi)
//! decode   v = (sin theta cos phi, sin theta sin phi, cos theta)
//! ```
//!
//! Canonical: at the poles the azimuth is 0; the azimuth of -X is +M, never -M. Survive exactly:
//! +-Z and +-X.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014. The angle of a vector near a pole comes from atan2, where acos(z) would lose half its
//! digits.

use super::support::bits::Pair;
use super::support::closest::{Closest, corners, join, split};
use super::support::sign::negate_if;
use super::{Formula, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{atan2_half_turns, sin_cos_of_one, sin_cos_quarter_turns, sqrt};
use crate::simd::{Simd, SimdInt, Use, Vec3, map2};

/// Spherical.
#[derive(Clone, Copy)]
pub(crate) struct Spherical {
    pair: Pair,
    max: i32,
    max_float: f32,
    step: f32,
}

impl Spherical {
    pub(crate) const fn new(bits: u32) -> Self {
        let pair = Pair::new(bits);
        let max = pair.snorm_max();
        Spherical { pair, max, max_float: max as f32, step: 1.0 / max as f32 }
    }

    /// The two parameters, scaled to M.
    #[inline(always)]
    fn angles<V: Simd>(self, Vec3 { x, y, z }: Vec3<V>) -> [V; 2] {
        let theta = atan2_half_turns(sqrt(x * x + y * y), z);
        let phi = atan2_half_turns(y, x);
        [(theta + theta - 1.0) * self.max_float, phi * self.max_float]
    }

    /// The canonical ones of parameters that may be a step out of range.
    #[inline(always)]
    fn canonical_params<V: Simd>(self, [u, w]: [V::Int; 2]) -> [V::Int; 2] {
        let pole = u.abs().eq(self.max);
        // The seam: -M is +M, and one step beyond is one step back from +M. None is above +M.
        let w = V::Int::select(V::Int::splat(-self.max).lt(w), w, w + self.max + self.max);
        [u, V::Int::select(pole, 0, w)]
    }

    #[inline(always)]
    fn pack<V: Simd>(self, params: [V::Int; 2]) -> V::Int {
        self.pair.pack_snorm::<V>(self.canonical_params::<V>(params))
    }

    #[inline(always)]
    fn vector<V: Simd>(self, [u, w]: [V::Int; 2]) -> Vec3<V> {
        let (sin_u, cos_u) = sin_cos_of_one(V::from_int(u) * self.step);
        let (sin_phi, cos_phi) = sin_cos_quarter_turns(V::from_int(w) * (2.0 * self.step));
        Vec3::new(cos_u * cos_phi, cos_u * sin_phi, -sin_u)
    }
}

impl Formula for Spherical {
    type Shape = Word;
    const PRECISE_USE: Use = Use::Often;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        self.pack::<V>(map2!(self.angles(v), |p| p.round_int()))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let mut closest = Closest::to(v);
        for [u, w] in corners(self.angles(v)) {
            let params = self.canonical_params::<V>([u.clamp(-self.max, self.max), w]);
            closest.consider(join::<V>(params), self.vector(params));
        }
        self.pair.pack_snorm::<V>(split::<V>(closest.code()))
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        self.vector(self.pair.unpack_snorm::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, [x, y, z]: [bool; 3]) -> V::Int {
        let [u, w] = self.pair.unpack_snorm::<V>(code);
        let w = negate_if(w, y);
        // Half a turn less the azimuth.
        let half = V::Int::select(w.lt(0), -self.max, self.max);
        self.pack::<V>([negate_if(u, z), if x { half - w } else { w }])
    }
}

kernels!(Spherical: Words);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::{VECTORS, assert_nearest};

    const SPHERICAL: Spherical = Spherical::new(16);

    fn mirror(code: i32, flips: [bool; 3]) -> i32 {
        SPHERICAL.mirror::<f32>(code.into(), flips).0
    }

    #[test]
    fn parameters_are_polar_angle_and_azimuth() {
        // theta = 60 degrees: 127 (2/3 - 1) = -42.3; phi = 30 degrees: 127 / 6 = 21.2.
        let v = Vec3::new(0.75f32, 0.433_013, 0.5);
        assert_eq!([SPHERICAL.encode(v).0, SPHERICAL.encode_precise(v).0], [0x15D6; 2]);
        // 90 - 90 * 42 / 127 = 60.2362 and 180 * 21 / 127 = 29.7638 degrees.
        let decoded = SPHERICAL.decode::<f32>(0x15D6.into());
        assert!(decoded.distance_squared(Vec3::new(0.753_562, 0.430_937, 0.496_425)) < 1e-10);
    }

    #[test]
    fn promised_axes_survive() {
        for (axis, code) in [
            ([0.0f32, 0.0, 1.0], 0x0081),
            ([0.0, 0.0, -1.0], 0x007F),
            ([1.0, 0.0, 0.0], 0x0000),
            ([-1.0, 0.0, 0.0], 0x7F00),
        ] {
            assert_eq!(SPHERICAL.encode(axis.into()).0, code);
            assert_eq!(SPHERICAL.encode_precise(axis.into()).0, code);
            assert_eq!(SPHERICAL.decode::<f32>(code.into()).to_array(), axis);
        }
    }

    #[test]
    fn the_azimuth_of_a_pole_is_zero() {
        assert_eq!(mirror(0x2A7F, [false; 3]), 0x007F);
        assert_eq!(mirror(0x8181, [false; 3]), 0x0081);
    }

    #[test]
    fn the_seam_has_the_greatest_azimuth() {
        assert_eq!(mirror(0x8105, [false; 3]), 0x7F05);
        // -179.94 degrees are rounded to -127 steps.
        assert_eq!(SPHERICAL.encode(Vec3::new(-1.0f32, -0.001, 0.0)).0, 0x7F00);
    }

    #[test]
    fn the_pattern_out_of_range_reads_as_its_neighbour() {
        assert_eq!(mirror(0x0080, [false; 3]), 0x0081);
        assert_eq!(mirror(0x8000, [false; 3]), 0x7F00);
    }

    #[test]
    fn mirror_images_have_the_supplement_or_the_opposite() {
        // 127 - 21 = 106.
        assert_eq!(mirror(0x15D6, [true, false, false]), 0x6AD6);
        assert_eq!(mirror(0xEBD6, [true, false, false]), 0x96D6);
        assert_eq!(mirror(0x15D6, [false, true, false]), 0xEBD6);
        assert_eq!(mirror(0x15D6, [false, false, true]), 0x152A);
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        assert_nearest(Spherical::new(8), 256, VECTORS);
    }
}
