//! Octahedral: the sphere mapped to an octahedron, its lower half folded out into a square.
//!
//! ```text
//! encode   p = the point of the octahedron, |p.x| + |p.y| + |p.z| = 1, signs as v has them
//!            oct         p = v / (|x| + |y| + |z|)
//!            warpedoct   g(|p.x|) : g(|p.y|) : g(|p.z|) = |x| : |y| : |z|
//!            eqareaoct   |p.z| = 1 - r, |p.x| = r (1 - a), |p.y| = r a
//!                        r = sqrt(1 - |z| / |v|), a = (2 / pi) atan2(|y|, |x|)
//!          (u, w) = (p.x, p.y)                                       if z >= 0
//!                   ((1 - |p.y|) sgn p.x, (1 - |p.x|) sgn p.y)       if z < 0
//!          code = snorm(u), snorm(w)
//! decode   p = (u, w, 1 - |u| - |w|), the fold undone if p.z < 0
//!            oct         v = p / |p|
//!            warpedoct   v = (g(|p.x|), g(|p.y|), g(|p.z|)), signs copied, over its length
//!            eqareaoct   |z| = 1 - r^2, |x| = r sqrt(2 - r^2) cos(a pi / 2), |y| = r sqrt(2 - r^2) sin(a pi / 2)
//! ```
//!
//! In integers, with M steps, the representable points are the (i, j, k) with i + j + k = M in each
//! octant: a triangular lattice. M is 2^(BITS/2 - 1) - 1, in sixoct the greatest multiple of 6 below, so
//! that the middles of a cube's edges and its corners are points. The nearest of them to v is one of the
//! three corners of the triangle that p lies in, since no triangle is obtuse once seen from the centre.
//!
//! warpedoct evens out the areas of oct's triangles: g(t) = t (1 + (K + Q t) (1 - t)), where K and Q
//! make the greatest error least (`examples/warp.rs` finds them). Its inverse is Newton's method for all
//! three components at once: with the gradients d = g'(p), p += (s |v| - g(p)) / d, where the length
//! s = (sum(g(p) / d) + 1 - sum(p)) / sum(|v| / d) makes their sum 1.
//!
//! Canonical: on the border of the square the points (u, +-M) and (+-M, w) mean one direction
//! where the folded coordinate is zero; the positive sign is the one emitted. Axes survive exactly.
//!
//! Source: Meyer, Süßmuth, Sußner, Stamminger and Greiner, "On Floating-Point Normal Vectors",
//! 2010; Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; eqareaoct: Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", 2008; the
//! warp and sixoct are unitpack's.

mod lattice;
mod projection;
mod unorm;

pub(crate) use lattice::{
    Steps, nearest_on_octahedron, triangle_around, triangle_index, triangle_len,
};
pub(crate) use projection::{Central, EqualArea, Projection, Warped};
pub(crate) use unorm::OctUnorm;

use core::marker::PhantomData;

use super::octant_table::octant_kernels;
use super::support::bits::Pair;
use super::support::sign::negate_if;
use super::{Formula, Lattice, Symmetric, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::sqrt;
use crate::simd::{Simd, SimdInt, Use, Vec3, map2, map3};
use lattice::{across_equator, plus_on_border, unfold};

/// Octahedral with the map `P`.
#[derive(Clone, Copy)]
pub(crate) struct Oct<P> {
    pair: Pair,
    steps: Steps,
    map: PhantomData<P>,
}

impl<P: Projection> Oct<P> {
    pub(crate) const fn new(bits: u32) -> Self {
        Self::with_multiple(bits, 1)
    }

    /// M is a multiple of `multiple`.
    pub(crate) const fn with_multiple(bits: u32, multiple: i32) -> Self {
        let pair = Pair::new(bits);
        let steps = Steps::new(pair.snorm_max() / multiple * multiple);
        Oct { pair, steps, map: PhantomData }
    }

    /// The parameters in two's complement, the first in the low bits, at 24 bits too.
    pub(crate) const fn plain(bits: u32) -> Self {
        let pair = Pair::plain(bits);
        Oct { pair, steps: Steps::new(pair.snorm_max()), map: PhantomData }
    }

    pub(crate) const fn steps(self) -> Steps {
        self.steps
    }

    /// The code of a point of the square, whose parameters are clamped.
    #[inline(always)]
    pub(crate) fn pack<V: Simd>(self, params: [V::Int; 2]) -> V::Int {
        let max = self.steps.count;
        self.pair.pack_snorm::<V>(map2!(params, |p| p.clamp(-max, max)))
    }

    /// The point of the square.
    #[inline(always)]
    pub(crate) fn unpack<V: Simd>(self, code: V::Int) -> [V::Int; 2] {
        let max = self.steps.count;
        let params = self.pair.unpack_snorm::<V>(code);
        if max == self.pair.snorm_max() {
            return params;
        }
        map2!(params, |p| p.clamp(-max, max))
    }

    /// The lattice point, whose magnitudes add to M.
    #[inline(always)]
    pub(crate) fn point<V: Simd>(self, code: V::Int) -> Vec3<V::Int> {
        unfold::<V>(self.unpack::<V>(code), self.steps.count)
    }

    /// The code of the point with magnitudes `x`, `y` and what is left of M, rounded, in the octant of
    /// `v`.
    #[inline(always)]
    pub(crate) fn code_of<V: Simd>(self, [x, y]: [V; 2], v: Vec3<V>) -> V::Int {
        let max = V::splat(self.steps.float);
        // Fold the lower half over the diagonals.
        let lower = v.z.lt(0.0);
        let u = V::select(lower, max - y, x).round_int();
        let w = V::select(lower, max - x, y).round_int();
        // Copy the signs. On the border, where a sign says nothing, it is plus.
        let border = self.steps.count;
        self.pair.pack_snorm::<V>([
            V::Int::select(v.x.lt(0.0) & !w.eq(border), -u, u),
            V::Int::select(v.y.lt(0.0) & !u.eq(border), -w, w),
        ])
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        triangle_len(self.steps.count)
    }
}

impl<P: Projection> Formula for Oct<P> {
    type Shape = Word;
    const PRECISE_USE: Use = P::PRECISE_USE;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let p = P::project(v, self.steps);
        self.code_of([p.x, p.y], v)
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let p = P::nearest(v, self.steps);
        self.code_of([p.x, p.y], v)
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        P::direction(Vec3::from_int(self.point::<V>(code)) * self.steps.inverse)
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, [x, y, z]: [bool; 3]) -> V::Int {
        let [u, w] = self.unpack::<V>(code);
        let point = [negate_if(u, x), negate_if(w, y)];
        let point = if z { across_equator::<V>(point, self.steps.count) } else { point };
        self.pair.pack_snorm::<V>(plus_on_border::<V>(point, self.steps.count))
    }
}

impl Lattice for Oct<Central> {
    #[inline(always)]
    fn encode_stochastic<V: Simd>(self, v: Vec3<V>, t: V) -> V::Int {
        let p = Central::project(v, self.steps);
        let (base, step) = triangle_around(p, self.steps);
        // The weight of the corner whose coordinate `axis` is a step off: the part that it has in p, times
        // its length, which decoding divides by.
        let [a, b, c] = map3!([0, 1, 2], |axis: usize| {
            let mut corner = base;
            corner[axis] = corner[axis] + step;
            (p[axis] - base[axis]) * step * sqrt(corner.length_squared())
        });
        let t = t * (a + b + c);
        let (first, second) = (t.lt(a), t.lt(a + b));
        let [x, y] = [V::select(first, step, 0.0), V::select(second & !first, step, 0.0)];
        self.code_of([base.x + x, base.y + y], v)
    }
}

impl<P: Projection> Symmetric for Oct<P> {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let max = V::Int::splat(self.steps.count);
        let zero = V::Int::splat(0);
        let [u, w] = self.unpack::<V>(code);
        let (i, j) = (u.abs(), w.abs());
        let lower = max.lt(i + j);
        let (i, j) = (V::Int::select(lower, max - j, i), V::Int::select(lower, max - i, j));
        let flips = Vec3::new(u.lt(0) & zero.lt(i), w.lt(0) & zero.lt(j), lower);
        (triangle_index::<V>(i, j), flips)
    }
}

kernels!(Oct<Central>: Words; OctUnorm: Words);
octant_kernels!(Oct<Central>);
#[cfg(feature = "warpedoct")]
kernels!(Oct<Warped>: Words);
#[cfg(feature = "warpedoct")]
octant_kernels!(Oct<Warped>);
#[cfg(feature = "eqareaoct")]
kernels!(Oct<EqualArea>: Words);
#[cfg(feature = "eqareaoct")]
octant_kernels!(Oct<EqualArea>);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::{VECTORS, assert_nearest};

    const OCT16: Oct<Central> = Oct::new(16);
    const SIXOCT16: Oct<Central> = Oct::with_multiple(16, 6);

    fn mirror(oct: Oct<Central>, code: i32, flips: [bool; 3]) -> i32 {
        oct.mirror::<f32>(code.into(), flips).0
    }

    #[test]
    fn the_lower_half_is_folded_over_the_diagonals() {
        // (1, 2, 2) 127 / 5 = (25.4, 50.8, 50.8); folded (127 - 50.8, 127 - 25.4) = (76.2, 101.6).
        for (v, code) in [
            ([1.0, 2.0, 2.0], 0x3319),
            ([-1.0, 2.0, 2.0], 0x33E7),
            ([1.0, 2.0, -2.0], 0x664C),
            ([-1.0, -2.0, -2.0], 0x9AB4),
        ] {
            assert_eq!(OCT16.encode::<f32>(v.into()).0, code, "{v:?}");
        }
        assert_eq!(OCT16.point::<f32>(0x664C.into()).to_array().map(|i| i.0), [25, 51, -51]);
        assert_eq!(mirror(OCT16, 0x3319, [false, false, true]), 0x664C);
        assert_eq!(mirror(OCT16, 0x664C, [true, true, true]), 0xCDE7);
    }

    #[test]
    fn ties_go_to_even() {
        for (v, code) in [([25.5, 50.0, 51.5], 0x321A), ([26.5, 50.0, 50.5], 0x321A)] {
            assert_eq!(OCT16.encode::<f32>(v.into()).0, code, "{v:?}");
        }
    }

    #[test]
    fn the_nearest_point_need_not_be_the_rounded_one() {
        // Off (42, 42, 43) by (0.45, 0.4, -0.85), and off (43, 42, 42) by (-0.55, 0.4, 0.15).
        let v = [42.45f32, 42.4, 42.15];
        assert_eq!(OCT16.encode(v.into()).0, 0x2A2A);
        assert_eq!(OCT16.encode_precise(v.into()).0, 0x2A2B);
    }

    #[test]
    fn axes_survive() {
        let codes = [0x007F, 0x0081, 0x7F00, 0x8100, 0x0000, 0x7F7F];
        for (i, code) in codes.into_iter().enumerate() {
            let mut axis = [0.0f32; 3];
            axis[i / 2] = if i % 2 == 0 { 1.0 } else { -1.0 };
            assert_eq!(OCT16.encode(axis.into()).0, code);
            assert_eq!(OCT16.encode_precise(axis.into()).0, code);
            assert_eq!(OCT16.decode::<f32>(code.into()).to_array(), axis);
        }
    }

    #[test]
    fn the_sign_of_a_zero_on_the_border_is_plus() {
        // Both (127, 64) and (127, -64) are (63, 0, -64), and all corners are -Z.
        for (code, canonical) in
            [(0xC07F, 0x407F), (0x7FC0, 0x7F40), (0x8181, 0x7F7F), (0x8101, 0x8101)]
        {
            let decoded = OCT16.decode::<f32>(code.into());
            assert_eq!(decoded, OCT16.decode::<f32>(canonical.into()));
            assert_eq!(mirror(OCT16, code, [false; 3]), canonical);
        }
    }

    #[test]
    fn what_is_out_of_range_reads_as_the_nearest() {
        assert_eq!(mirror(OCT16, 0x0080, [false; 3]), 0x0081);
        // The steps of sixoct16 are 126.
        assert_eq!(mirror(SIXOCT16, 0x007F, [false; 3]), 0x007E);
        assert_eq!(mirror(SIXOCT16, 0x8000, [false; 3]), 0x8200);
    }

    #[test]
    fn plain_codes_differ_only_in_their_layout() {
        let (plain, rgb8) = (Oct::<Central>::plain(24), Oct::<Central>::new(24));
        let code = plain.encode::<f32>([1.0, -2.0, 2.0].into());
        // 2047 / 5 = 409.4 and 818.8.
        assert_eq!(code.0, 0xCC_D199);
        let same = rgb8.encode::<f32>([1.0, -2.0, 2.0].into());
        assert_eq!(plain.decode::<f32>(code), rgb8.decode::<f32>(same));
        let params = plain.unpack::<f32>(code);
        assert_eq!(params.map(|p| p.0), [409, -819]);
        assert_eq!(plain.pack::<f32>(params), code);
        assert_eq!(plain.pack::<f32>([9999.into(), (-9999).into()]).0, 0x80_17FF);
    }

    #[test]
    fn sixoct_keeps_edges_and_corners_of_a_cube() {
        for (v, code) in [([1.0f32, 1.0, 1.0], 0x2A2A), ([1.0, 1.0, 0.0], 0x3F3F)] {
            assert_eq!(SIXOCT16.encode(v.into()).0, code);
            let [x, y, z] = SIXOCT16.decode::<f32>(code.into()).to_array();
            assert_eq!([y, z], [x, x * v[2]]);
        }
    }

    #[test]
    fn stochastic_weights_are_parts_times_lengths() {
        // Half way from (25, 50, 52) to (26, 50, 51), of lengths 76.35 and 76.01: 0.4989 of the time the latter.
        for (t, code) in [(0.0, 0x321A), (0.498, 0x321A), (0.4995, 0x3219), (0.999, 0x3219)] {
            let v = Vec3::new(25.5f32, 50.0, 51.5);
            assert_eq!(OCT16.encode_stochastic(v, t).0, code, "{t}");
        }
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        assert_nearest(Oct::<Warped>::new(8), 256, VECTORS);
    }
}
