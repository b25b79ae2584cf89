//! Front-biased oct: more precision towards +Z, for normals in view space, of which most face the
//! viewer.
//!
//! ```text
//! b = (F^2 - 1) / (F^2 + 1), k = sqrt(1 - b^2) = 2 F / (F^2 + 1)
//! encode   n = (k x, k y, z - b |v|);  code = oct(n)
//! decode   p = oct's point of the octahedron;  v = (k p.x, k p.y, p.z + b |p|) / (|p| + b p.z)
//! ```
//!
//! In the plane of the stereographic projection this is a scaling by F; so do the stars crowd ahead of an
//! observer who moves at b times the speed of light. It keeps circles and angles, and oct's cells
//! become (1 - b v.z) / k times as large: 1 / F at +Z, F at -Z.
//!
//! Across a cell the scale changes a little, which may turn oct's right angles into obtuse ones. So
//! the nearest point is a corner of the triangle that n lies in, or of the three beside it.
//!
//! Canonical: as oct. Survive exactly: +-Z, and in frontoct32 and quadfrontoct24, whose steps are a multiple
//! of 7 and 23, all axes.
//!
//! Source: the wish for such a code, which is Sloan's, is in Cigolle et al., "A Survey of Efficient
//! Representations for Independent Unit Vectors", 2014, "Conclusions"; the map is unitpack's.

use super::oct::{Central, Oct, triangle_around};
use super::support::closest::Closest;
use super::{Formula, kernels, oct::Projection};
use crate::batch::storage::{Word, Words};
use crate::simd::math::sqrt;
use crate::simd::{Simd, Vec3, map_vec};

/// Oct, `F` times as fine at +Z.
#[derive(Clone, Copy)]
pub(crate) struct FrontOct {
    oct: Oct<Central>,
    /// k, b and 1, times F^2 + 1.
    k: f32,
    b: f32,
    one: f32,
}

impl FrontOct {
    pub(crate) const fn new(bits: u32, f: u32) -> Self {
        let [k, b, one] = [2 * f, f * f - 1, f * f + 1];
        FrontOct { oct: Oct::new(bits), k: k as f32, b: b as f32, one: one as f32 }
    }

    /// (k x, k y, z + b |v|) or, if `back`, (k x, k y, z - b |v|), times a length; without cancellation.
    #[inline(always)]
    fn shifted<V: Simd>(self, v: Vec3<V>, back: bool) -> Vec3<V> {
        let FrontOct { k, b, one, .. } = self;
        let Vec3 { x, y, z } = v;
        let length = sqrt(v.length_squared());
        let factor = z.abs() * one + length * b;
        // Away from the pole z + b |v| = (z^2 - b^2 |v|^2) / (z - b |v|), and z^2 - b^2 |v|^2 =
        // k^2 z^2 - b^2 (x^2 + y^2). In integers it is exact where it is zero on an axis.
        let (long, short) = (x.abs().max(y.abs()) * b, x.abs().min(y.abs()) * b);
        let away = (z * k - long) * (z * k + long) - short * short;
        let below = z.lt(0.0);
        let towards = if back { below } else { !below };
        let height = V::select(towards, factor * factor, away).negate_where_negative(z);
        Vec3::new(x * k * factor, y * k * factor, height)
    }

    /// The vector of a lattice point.
    #[inline(always)]
    fn direction<V: Simd>(self, p: Vec3<V>) -> Vec3<V> {
        let v = self.shifted(p, false).normalize();
        // Once more, so that the axes are exact.
        v * (V::splat(1.5) - v.length_squared() * 0.5)
    }
}

impl Formula for FrontOct {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        self.oct.encode(self.shifted(v, true))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let v = v.normalize();
        let n = self.shifted(v, true);
        let steps = self.oct.steps();
        let (base, step) = triangle_around(Central::project(n, steps), steps);
        let mut candidates = [base; 6];
        for axis in 0..3 {
            let corner = base[axis] + step;
            candidates[axis][axis] = corner;
            // Beyond the edge that faces the corner; in the lower half, the mirror image. That of x or y
            // is farther than the corner, since the map is symmetric there.
            let (mut beyond, mut mirrored) = (map_vec!(base, |c| c + step), base);
            beyond[axis] = base[axis] - step;
            mirrored[axis] = if axis == 2 { -corner } else { corner };
            candidates[3 + axis] = Vec3::select(beyond[axis].lt(0.0), mirrored, beyond);
        }
        let mut closest = Closest::to_unit(v);
        for p in candidates {
            let signed = p.negate_where_negative(n);
            closest.consider(self.oct.code_of([p.x, p.y], signed), self.direction(signed));
        }
        closest.code()
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        self.direction(Vec3::from_int(self.oct.point::<V>(code)))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        if flips[2] {
            self.mirror_decoded::<V>(code, flips)
        } else {
            self.oct.mirror::<V>(code, flips)
        }
    }
}

kernels!(FrontOct: Words);
