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
            // Beyond the edge that faces the corner. If that edge is on a plane between octants, an
            // end of the edge or the corner is nearer.
            let mut beyond = map_vec!(base, |c| c + step);
            beyond[axis] = base[axis] - step;
            candidates[3 + axis] = Vec3::select(beyond[axis].lt(0.0), candidates[axis], beyond);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::{assert_nearest, spiral};

    fn assert_near(v: Vec3<f32>, expected: [f32; 3]) {
        assert!(v.distance_squared(expected.into()) < 1e-12, "{v:?}");
    }

    #[test]
    fn the_equator_of_oct_is_a_parallel_of_the_front() {
        // F = 2: k = 4/5, b = 3/5. The point (1, 0, 0) is (k, 0, b) / 1. F = 4: k = 8/17, b = 15/17.
        let [twice, quad] = [FrontOct::new(16, 2), FrontOct::new(16, 4)];
        assert_near(twice.decode::<f32>(0x007F.into()), [0.8, 0.0, 0.6]);
        assert_near(quad.decode::<f32>(0x007F.into()), [8.0 / 17.0, 0.0, 15.0 / 17.0]);
        // +X is n = (4, 0, -3) / 5, so w = 0 and u = 1; folded w = 127 (1 - 4/7) = 54.4.
        assert_eq!(twice.encode(Vec3::new(1.0f32, 0.0, 0.0)).0, 0x367F);
        assert_eq!(twice.encode(Vec3::new(8.0f32, 0.0, 6.0)).0, 0x007F);
    }

    #[test]
    fn a_step_at_the_front_is_half_of_that_of_oct() {
        // (1, 0, 126) is 0.454724 degrees off Z; half the tangent of half of that is a sine of 0.0039682.
        let v = FrontOct::new(16, 2).decode::<f32>(0x0001.into());
        assert_near(v, [0.003_968_2, 0.0, 0.999_992_1]);
    }

    #[test]
    fn promised_axes_survive() {
        let axes: [[f32; 3]; 6] = [
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
        ];
        for (formula, count) in
            [(FrontOct::new(16, 2), 2), (FrontOct::new(32, 2), 6), (FrontOct::new(24, 4), 6)]
        {
            for axis in &axes[..count] {
                for code in
                    [formula.encode(Vec3::from(*axis)), formula.encode_precise((*axis).into())]
                {
                    assert_eq!(formula.decode::<f32>(code).to_array(), *axis);
                }
            }
        }
    }

    #[test]
    fn canonical_codes_are_those_of_oct() {
        let formula = FrontOct::new(16, 2);
        for (code, canonical) in [(0xC07F, 0x407F), (0x8181, 0x7F7F), (0x0080, 0x0081)] {
            assert_eq!(formula.mirror::<f32>(code.into(), [false; 3]).0, canonical);
        }
        assert_eq!(formula.mirror::<f32>(0x3319.into(), [true, false, false]).0, 0x33E7);
        // The poles change places; nothing else of the lattice is its own mirror image.
        assert_eq!(formula.mirror::<f32>(0.into(), [false, false, true]).0, 0x7F7F);
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        // The coarser, the less alike are the two sides of a plane between octants.
        for (bits, f) in [(4, 2), (6, 4), (8, 2), (8, 4)] {
            assert_nearest(FrontOct::new(bits, f), 1 << bits, spiral(250));
        }
    }
}
