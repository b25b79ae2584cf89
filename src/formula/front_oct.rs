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

use crate::formula::bits::snorm_max;
use crate::formula::oct::{Central, Oct, Projection, triangle_around};
use crate::formula::{Closest, Formula, One, mirror_decoded};
use crate::simd::math;
use crate::simd::{Each, Simd, inlined};

/// Oct in `BITS` bits, `F` times as fine at +Z.
pub(crate) struct FrontOct<const BITS: u32, const F: u32>;

impl<const BITS: u32, const F: u32> FrontOct<BITS, F> {
    const M: i32 = snorm_max(BITS / 2);
    /// k and b times F^2 + 1.
    const K: f32 = (2 * F) as f32;
    const B: f32 = (F * F - 1) as f32;

    /// (k x, k y, z + b |v|) or, `back`, (k x, k y, z - b |v|), times a length; without cancellation.
    #[inline(always)]
    fn shifted<V: Simd>([x, y, z]: [V; 3], back: bool) -> [V; 3] {
        let (k, b) = (V::splat(Self::K), V::splat(Self::B));
        let length = math::sqrt(math::length_squared([x, y, z]));
        let factor = V::splat((F * F + 1) as f32) * z.abs() + b * length;
        // Away from the pole z + b |v| = (z^2 - b^2 |v|^2) / (z - b |v|), and z^2 - b^2 |v|^2 =
        // k^2 z^2 - b^2 (x^2 + y^2). In integers it is exact where it is zero on an axis.
        let (long, short) = (x.abs().greater(y.abs()) * b, x.abs().lesser(y.abs()) * b);
        let away = (k * z - long) * (k * z + long) - short * short;
        let below = z.lt(V::zero());
        let towards = if back { below } else { !below };
        let height = V::select(towards, factor * factor, away).negate_where_negative(z);
        [x * k * factor, y * k * factor, height]
    }

    /// The vector of a lattice point.
    #[inline(always)]
    fn direction<V: Simd>(p: [V; 3]) -> [V; 3] {
        let v = math::normalize(Self::shifted(p, false));
        // Once more, so that the axes are exact.
        let r = V::splat(1.5) - V::splat(0.5) * math::length_squared(v);
        v.each(|c| c * r)
    }
}

impl<const BITS: u32, const F: u32> Formula for FrontOct<BITS, F> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        Oct::<Central, BITS>::encode(Self::shifted(v, true))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        let v = math::normalize(v);
        let n = Self::shifted(v, true);
        let (base, step) = triangle_around(Central::project(n, Self::M), Self::M);
        let [x_sign, y_sign, z_sign] = n;
        let point = inlined(
            #[inline(always)]
            |[x, y, z]: [V; 3]| {
                let signed = [
                    x.negate_where_negative(x_sign),
                    y.negate_where_negative(y_sign),
                    z.negate_where_negative(z_sign),
                ];
                let code = Oct::<Central, BITS>::code_of([x, y], signed);
                (code, Self::direction(signed))
            },
        );
        let mut closest = Closest::to_unit(v);
        for axis in 0..3 {
            let mut corner = base;
            corner[axis] = corner[axis] + step;
            let (code, decoded) = point(corner);
            closest.consider(code, decoded);
        }
        for axis in 0..3 {
            // Beyond the edge that faces the corner; in the lower half, the mirror image. That of x or y
            // is farther than the corner, since the map is symmetric there.
            let (mut beyond, mut mirrored) = (base.each(|c| c + step), base);
            beyond[axis] = base[axis] - step;
            let corner = base[axis] + step;
            mirrored[axis] = if axis == 2 { -corner } else { corner };
            let outside = beyond[axis].lt(V::zero());
            let beyond = [0, 1, 2].each(
                #[inline(always)]
                |i: usize| V::select(outside, mirrored[i], beyond[i]),
            );
            let (code, decoded) = point(beyond);
            closest.consider(code, decoded);
        }
        closest.code()
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        Self::direction(Oct::<Central, BITS>::point::<V>(code).each(V::from_int))
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        Oct::<Central, BITS>::canonical::<V>(code)
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        if flips[2] {
            mirror_decoded::<Self, V>(code, flips)
        } else {
            Oct::<Central, BITS>::mirror::<V>(code, flips)
        }
    }
}
