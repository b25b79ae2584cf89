//! Projections of a hemisphere onto the unit disk.

use crate::simd::math::{atan2_half_turns, inv_sqrt, sin_cos_of_one, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, Vec3, map2};

/// A point of the disk or, past the equator, outside it.
#[derive(Clone, Copy)]
pub(super) struct DiskPoint<V> {
    pub(super) x: V,
    pub(super) y: V,
    /// D = 1 - x^2 - y^2.
    pub(super) one_minus_r2: V,
    /// E = 2 - x^2 - y^2.
    pub(super) two_minus_r2: V,
}

/// From a hemisphere, whose pole is z = 1, to the unit disk.
#[derive(Clone, Copy)]
pub(crate) enum Projection {
    /// Stereographic.
    Stereo,
    /// Lambert's azimuthal equal-area. The corners of the square are the other pole.
    EqArea,
    /// Azimuthal equidistant.
    EqDist,
}

impl Projection {
    /// Of a unit vector with z >= 0 or, if it is to be seen `past` the equator, z <= 0. D and E may be
    /// wrong unless `needs_d`.
    #[inline(always)]
    pub(super) fn project<V: Simd>(self, v: Vec3<V>, past: bool, needs_d: bool) -> DiskPoint<V> {
        match self {
            Projection::Stereo => {
                let k = V::splat(1.0) / one_plus_z(v, past);
                let d = (v.z + v.z) * k;
                DiskPoint { x: v.x * k, y: v.y * k, one_minus_r2: d, two_minus_r2: d + 1.0 }
            }
            Projection::EqArea => {
                let e = one_plus_z(v, past);
                let k = inv_sqrt(e);
                DiskPoint { x: v.x * k, y: v.y * k, one_minus_r2: v.z, two_minus_r2: e }
            }
            Projection::EqDist => {
                let Vec3 { x, y, z } = v;
                let hh = (x * x + y * y).max(1e-30);
                let per_h = inv_sqrt(hh);
                let h = hh * per_h;
                let r = atan2_half_turns(h, z);
                // 1 - r, from the equator's side: there it is small.
                let short = if needs_d { atan2_half_turns(z, h) } else { V::splat(0.0) };
                let (r, short) = (r + r, short + short);
                let k = r * per_h;
                let d = short * (r + 1.0);
                DiskPoint { x: x * k, y: y * k, one_minus_r2: d, two_minus_r2: d + 1.0 }
            }
        }
    }

    /// x^2 + y^2 may be up to 2.
    #[inline(always)]
    pub(super) fn unproject<V: Simd>(self, point: DiskPoint<V>) -> Vec3<V> {
        let DiskPoint { x, y, one_minus_r2, two_minus_r2 } = point;
        match self {
            Projection::Stereo => Vec3::new(x + x, y + y, one_minus_r2).normalize(),
            Projection::EqArea => {
                let k = sqrt(two_minus_r2);
                Vec3::new(x * k, y * k, one_minus_r2).normalize()
            }
            Projection::EqDist => {
                let rr = (x * x + y * y).max(1e-30);
                let per_r = inv_sqrt(rr);
                // The angle above the equator is 1 - r quarter turns, and 1 - r = D / (1 + r).
                let short = one_minus_r2 / (rr * per_r + 1.0);
                let (sin, cos) = sin_cos_of_one(short);
                let k = cos * per_r;
                Vec3::new(x * k, y * k, sin)
            }
        }
    }

    /// Whether (u, v) / M, outside the disk, has the same direction as a point inside that of the
    /// other hemisphere; and that point.
    ///
    /// In eqdist, (u, v) at the distance r is the direction of (2 M - r) / r times (u, v): an integer
    /// point if r is an integer and divides the product.
    #[inline(always)]
    pub(super) fn duplicate_of<V: Simd>(
        self,
        outer: [V::Int; 2],
        max: i32,
    ) -> (V::Mask, [V::Int; 2]) {
        let Projection::EqDist = self else { return (V::Mask::splat(false), outer) };
        let [u, v] = outer;
        let rr = u * u + v * v;
        let r = sqrt(V::from_int(rr)).round_int();
        let other = V::Int::splat(2 * max) - r;
        let ratio = V::from_int(other) / V::from_int(r.max(1));
        let inner = map2!(outer, |c| (V::from_int(c) * ratio).round_int());
        let u_whole = (inner[0] * r).eq(u * other);
        let v_whole = (inner[1] * r).eq(v * other);
        // A column's u is odd, as M is.
        let column = inner[0].low_bits(1).eq(1);
        ((r * r).eq(rr) & V::Int::splat(max).lt(r) & u_whole & v_whole & column, inner)
    }
}

/// 1 + z of a unit vector; past the equator without cancellation, and at least 1e-30.
#[inline(always)]
fn one_plus_z<V: Simd>(Vec3 { x, y, z }: Vec3<V>, past: bool) -> V {
    if past { (x * x + y * y).max(1e-30) / (V::splat(1.0) - z) } else { z + 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Projection; 3] = [Projection::Stereo, Projection::EqArea, Projection::EqDist];

    fn parts(point: DiskPoint<f32>) -> [f32; 4] {
        [point.x, point.y, point.one_minus_r2, point.two_minus_r2]
    }

    fn assert_near(point: DiskPoint<f32>, expected: [f32; 4]) {
        let off = parts(point).into_iter().zip(expected).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f32::max) < 2e-6, "{:?}", parts(point));
    }

    #[test]
    fn the_disk_is_reached_from_the_own_hemisphere() {
        // D = 1 - r^2 and E = 2 - r^2, with r = 1/3, r = sqrt(0.2), and r = 2 acos(0.8) / pi = 0.409666.
        let v = Vec3::new(0.48f32, 0.36, 0.8);
        for (projection, expected) in ALL.into_iter().zip([
            [0.266_666_7, 0.2, 0.888_888_9, 1.888_889],
            [0.357_770_9, 0.268_328_2, 0.8, 1.8],
            [0.327_732_4, 0.245_799_3, 0.832_174, 1.832_174],
        ]) {
            assert_near(projection.project(v, false, true), expected);
        }
    }

    #[test]
    fn past_the_equator_points_are_outside() {
        // z = -0.28, r = 0.96: stereo r = 0.96 / 0.72 = 4/3, eqarea r = 0.96 / sqrt(0.72) = 1.131371, eqdist
        // r = 2 acos(-0.28) / pi = 1.180669.
        let v = Vec3::new(0.96f32, 0.0, -0.28);
        for (projection, expected) in ALL.into_iter().zip([
            [1.333_333_3, 0.0, -0.777_777_8, 0.222_222_2],
            [1.131_370_9, 0.0, -0.28, 0.72],
            [1.180_669, 0.0, -0.393_979_2, 0.606_020_8],
        ]) {
            assert_near(projection.project(v, true, true), expected);
        }
    }

    #[test]
    fn unprojecting_leads_back() {
        for projection in ALL {
            for v in
                [[0.48f32, -0.36, 0.8], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0], [0.768, 0.576, -0.28]]
            {
                let back = projection.unproject(projection.project(v.into(), v[2] < 0.0, true));
                assert!(back.distance_squared(v.into()) < 1e-12, "{back:?}");
            }
        }
    }

    #[test]
    fn only_equidistant_points_are_in_both_squares() {
        // (495, 432) has r = 657, and (2 * 511 - 657) / 657 = 5/9; (497, 496) has no whole r.
        for (projection, outer, is_duplicate) in [
            (Projection::EqDist, [495, 432], true),
            (Projection::EqDist, [-495, -432], true),
            (Projection::EqDist, [497, 496], false),
            (Projection::EqDist, [275, 240], false),
            (Projection::Stereo, [495, 432], false),
        ] {
            let outer = outer.map(crate::simd::I32x1);
            let (found, inner) = projection.duplicate_of::<f32>(outer, 511);
            assert_eq!(found, is_duplicate);
            if found {
                assert_eq!(inner.map(|i| i.0.abs()), [275, 240]);
                assert_eq!(inner[0].0 < 0, outer[0].0 < 0);
            }
        }
    }
}
