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
