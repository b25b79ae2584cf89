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
//! Canonical: on the border of the square the points (u, +-M) and (+-M, w) stand for one direction
//! where the folded coordinate is zero; the positive sign is the one emitted. Axes survive exactly.
//!
//! Source: Meyer, Süßmuth, Sußner, Stamminger and Greiner, "On Floating-Point Normal Vectors",
//! 2010; Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; eqareaoct: Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", 2008; the
//! warp and sixoct are unitpack's.

use core::marker::PhantomData;

use crate::formula::bits::{pack_snorm2, pack2, snorm_max, unorm_max, unpack_snorm2, unpack2};
use crate::formula::{
    Closest, Formula, Lattice, One, Symmetric, closest_of_four, mirror_decoded, negate_if,
};
use crate::simd::math;
use crate::simd::{Each, Simd, SimdInt, inlined};

/// Octahedral with the map `P` in `BITS` bits; the steps are a multiple of `MULTIPLE`.
pub(crate) struct Oct<P, const BITS: u32, const MULTIPLE: i32 = 1>(PhantomData<P>);

/// How an octant of the sphere is mapped to a face of the octahedron.
pub(crate) trait Projection: 'static {
    /// The point of |v|, whose components add to `m`.
    fn project<V: Simd>(v: [V; 3], m: i32) -> [V; 3];
    /// The unit vector of a point whose magnitudes add to 1.
    fn direction<V: Simd>(p: [V; 3]) -> [V; 3];
    /// The lattice point nearest to |v|: of the corners of the triangle around it.
    #[inline(always)]
    fn nearest<V: Simd>(v: [V; 3], m: i32) -> [V; 3] {
        let v = v.each(|c| c.abs());
        let (base, step) = triangle_around(Self::project(v, m), m);
        let mut closest = Closest::to(v);
        for axis in 0..3 {
            let mut q = base;
            q[axis] = q[axis] + step;
            let decoded = Self::direction(q.each(|c| c * V::splat(1.0 / m as f32)));
            closest.consider(V::Int::splat(axis as i32), decoded);
        }
        let axis = closest.code();
        [0, 1, 2].each(
            #[inline(always)]
            |i: usize| V::select(axis.eq(V::Int::splat(i as i32)), base[i] + step, base[i]),
        )
    }
}

/// Along the rays from the centre.
pub(crate) struct Central;
/// With triangles of about the same size.
pub(crate) struct Warped;
/// With equal areas.
pub(crate) struct EqualArea;

impl Projection for Central {
    #[inline(always)]
    fn project<V: Simd>(v: [V; 3], m: i32) -> [V; 3] {
        let [x, y, z] = v.each(|c| c.abs());
        let scale = V::splat(m as f32) / (x + y + z);
        [x * scale, y * scale, z * scale]
    }
    #[inline(always)]
    fn direction<V: Simd>(p: [V; 3]) -> [V; 3] {
        math::normalize(p)
    }
    #[inline(always)]
    fn nearest<V: Simd>(v: [V; 3], m: i32) -> [V; 3] {
        nearest_on_octahedron(Self::project(v, m), m)
    }
}

impl Warped {
    /// See `examples/warp.rs`.
    const K: f32 = 0.459_265;
    const Q: f32 = -0.710_567;

    /// g(t) = t (1 + (k + q t) (1 - t)); odd.
    #[inline(always)]
    fn warp<V: Simd>(t: V, [k, q]: [f32; 2]) -> V {
        let magnitude = t.abs();
        t * (V::splat(1.0) + (V::splat(k) + V::splat(q) * magnitude) * (V::splat(1.0) - magnitude))
    }

    /// g'(t).
    #[inline(always)]
    fn gradient<V: Simd>(t: V) -> V {
        V::splat(1.0 + Self::K)
            + t * (V::splat(2.0 * (Self::Q - Self::K)) - V::splat(3.0 * Self::Q) * t)
    }
}

impl Projection for Warped {
    #[inline(always)]
    fn project<V: Simd>(v: [V; 3], m: i32) -> [V; 3] {
        let target = v.each(|c| c.abs());
        // Its inverse about, without which two steps would not be enough for 32 bits.
        let mut p = Central::project(v, 1).each(
            #[inline(always)]
            |t| Self::warp(t, [-0.35, 0.7]),
        );
        for _ in 0..2 {
            let g = p.each(
                #[inline(always)]
                |t| Self::warp(t, [Self::K, Self::Q]),
            );
            let [x, y, z] = p.each(
                #[inline(always)]
                |t| Self::gradient(t),
            );
            // Each gradient's inverse, and s, of one division.
            let (others, all) = ([y * z, z * x, x * y], x * y * z);
            let (along, off) = (math::dot(target, others), V::splat(1.0) - (p[0] + p[1] + p[2]));
            let inverse = V::splat(1.0) / (along * all);
            let (s, per_all) =
                ((math::dot(g, others) + off * all) * all * inverse, along * inverse);
            p = [0, 1, 2].each(
                #[inline(always)]
                |i: usize| p[i] + (s * target[i] - g[i]) * (others[i] * per_all),
            );
        }
        p.each(
            #[inline(always)]
            |t| t.greater(V::zero()) * V::splat(m as f32),
        )
    }
    #[inline(always)]
    fn direction<V: Simd>(p: [V; 3]) -> [V; 3] {
        math::normalize(p.each(
            #[inline(always)]
            |t| Self::warp(t, [Self::K, Self::Q]),
        ))
    }
}

impl Projection for EqualArea {
    #[inline(always)]
    fn project<V: Simd>(v: [V; 3], m: i32) -> [V; 3] {
        let [x, y, z] = math::normalize(v.each(|c| c.abs()));
        // 1 - z, and 1 - r, without cancellation.
        let r = math::sqrt((x * x + y * y) / (V::splat(1.0) + z));
        let k = z / (V::splat(1.0) + r);
        let a = math::atan2_half_turns(y, x);
        let scale = V::splat(m as f32);
        [r * (V::splat(1.0) - (a + a)) * scale, r * (a + a) * scale, k * scale]
    }
    #[inline(always)]
    fn direction<V: Simd>([x, y, z]: [V; 3]) -> [V; 3] {
        let one = V::splat(1.0);
        let (r, k) = (x.abs() + y.abs(), z.abs());
        let (sin, cos) = math::sin_cos_of_one(y.abs() / r.greater(V::splat(f32::MIN_POSITIVE)));
        // 2 - r^2 = 1 + z.
        let height = k * (one + r);
        let h = r * math::sqrt(one + height);
        let v = [h * cos, h * sin, height];
        math::normalize([
            v[0].negate_where_negative(x),
            v[1].negate_where_negative(y),
            v[2].negate_where_negative(z),
        ])
    }
}

impl<P: Projection, const BITS: u32, const MULTIPLE: i32> Oct<P, BITS, MULTIPLE> {
    const M: i32 = snorm_max(BITS / 2) / MULTIPLE * MULTIPLE;

    #[inline(always)]
    fn unpack<V: Simd>(code: V::Int) -> [V::Int; 2] {
        let params = unpack_snorm2::<BITS, V>(code);
        if MULTIPLE == 1 {
            return params;
        }
        let max = V::Int::splat(Self::M);
        params.each(|p| p.max(-max).min(max))
    }

    /// The lattice point, whose magnitudes add to `M`.
    #[inline(always)]
    pub(crate) fn point<V: Simd>(code: V::Int) -> [V::Int; 3] {
        unfold::<V>(Self::unpack::<V>(code), Self::M)
    }

    /// Of the point whose magnitudes are `x`, `y` and what is left of `m`, rounded, in the octant of `v`.
    #[inline(always)]
    pub(crate) fn code_of<V: Simd>([x, y]: [V; 2], v: [V; 3]) -> V::Int {
        let max = V::splat(Self::M as f32);
        // Fold the lower half over the diagonals.
        let lower = v[2].lt(V::zero());
        let u = V::select(lower, max - y, x).round_int();
        let w = V::select(lower, max - x, y).round_int();
        Self::finish([u, w], v)
    }

    /// Gives the magnitudes `u`, `w` the signs of `x`, `y`, but where a sign says nothing, plus.
    #[inline(always)]
    fn finish<V: Simd>([u, w]: [V::Int; 2], [x, y, _]: [V; 3]) -> V::Int {
        let max = V::Int::splat(Self::M);
        let zero = V::zero();
        pack_snorm2::<BITS, V>([
            V::Int::select(x.lt(zero) & !w.eq(max), -u, u),
            V::Int::select(y.lt(zero) & !u.eq(max), -w, w),
        ])
    }
}

impl<P: Projection, const BITS: u32, const MULTIPLE: i32> Formula for Oct<P, BITS, MULTIPLE> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        let [x, y, _] = P::project(v, Self::M);
        Self::code_of([x, y], v)
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        let [i, j, _] = P::nearest(v, Self::M);
        Self::code_of([i, j], v)
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        P::direction(scaled(Self::point::<V>(code), Self::M))
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        let point = plus_on_border::<V>(Self::unpack::<V>(code), Self::M);
        pack_snorm2::<BITS, V>(point)
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, [x, y, z]: [bool; 3]) -> V::Int {
        let [u, w] = Self::unpack::<V>(code);
        let point = [negate_if(u, x), negate_if(w, y)];
        let point = if z { across_equator::<V>(point, Self::M) } else { point };
        pack_snorm2::<BITS, V>(plus_on_border::<V>(point, Self::M))
    }
}

impl<const BITS: u32, const MULTIPLE: i32> Lattice for Oct<Central, BITS, MULTIPLE> {
    #[inline(always)]
    fn encode_one_of<V: Simd>(v: [V; 3], t: V) -> V::Int {
        let p = Central::project(v, Self::M);
        let (base, step) = triangle_around(p, Self::M);
        // Of the corner whose coordinate `axis` is a step off, the part that it has in p, times its length,
        // which decoding divides by.
        let [a, b, c] = [0, 1, 2].each(
            #[inline(always)]
            |axis: usize| {
                let mut corner = base;
                corner[axis] = corner[axis] + step;
                (p[axis] - base[axis]) * step * math::sqrt(math::length_squared(corner))
            },
        );
        let t = t * (a + b + c);
        let (first, second) = (t.lt(a), t.lt(a + b));
        let zero = V::zero();
        let steps = [V::select(first, step, zero), V::select(second & !first, step, zero)];
        Self::code_of([base[0] + steps[0], base[1] + steps[1]], v)
    }
}

impl<P: Projection, const BITS: u32, const MULTIPLE: i32> Symmetric for Oct<P, BITS, MULTIPLE> {
    const ENTRIES: usize = triangle_len(Self::M);

    #[inline(always)]
    fn fold<V: Simd>(code: V::Int) -> (V::Int, [V::Mask; 3]) {
        let (max, zero) = (V::Int::splat(Self::M), V::Int::splat(0));
        let [u, w] = Self::unpack::<V>(code);
        let (i, j) = (u.abs(), w.abs());
        let lower = max.lt(i + j);
        let (i, j) = (V::Int::select(lower, max - j, i), V::Int::select(lower, max - i, j));
        let flips = [u.lt(zero) & zero.lt(i), w.lt(zero) & zero.lt(j), lower];
        (triangle_index::<V>(i, j), flips)
    }
}

/// How many points (i, j) with i + j <= m there are.
pub(crate) const fn triangle_len(m: i32) -> usize {
    (m as usize + 1) * (m as usize + 2) / 2
}

/// The number of a point (i, j), counted by i + j.
#[inline(always)]
pub(crate) fn triangle_index<V: Simd>(i: V::Int, j: V::Int) -> V::Int {
    let n = i + j;
    (n * (n + V::Int::splat(1))).shr(1) + j
}

/// The point of the octahedron, whose magnitudes add to 1, of a lattice point.
#[inline(always)]
fn scaled<V: Simd>(p: [V::Int; 3], m: i32) -> [V; 3] {
    p.each(
        #[inline(always)]
        |c| V::from_int(c) * V::splat(1.0 / m as f32),
    )
}

/// The lattice point, whose magnitudes add to m, of one of the square from -m to m.
#[inline(always)]
fn unfold<V: Simd>([u, w]: [V::Int; 2], m: i32) -> [V::Int; 3] {
    let (max, zero) = (V::Int::splat(m), V::Int::splat(0));
    let (i, j) = (u.abs(), w.abs());
    let (left_i, left_j) = (max - j, max - i);
    let copy_sign = inlined(
        #[inline(always)]
        |magnitude: V::Int, sign: V::Int| V::Int::select(sign.lt(zero), -magnitude, magnitude),
    );
    // Below the diagonals, where more is left over than is there, fold back.
    [copy_sign(i.min(left_i), u), copy_sign(j.min(left_j), w), left_i - i]
}

/// The point of the square from -m to m whose z is the opposite: its mirror image in the diagonal of its quarter.
#[inline(always)]
fn across_equator<V: Simd>([u, w]: [V::Int; 2], m: i32) -> [V::Int; 2] {
    let (max, zero) = (V::Int::splat(m), V::Int::splat(0));
    let (i, j) = (max - w.abs(), max - u.abs());
    [V::Int::select(u.lt(zero), -i, i), V::Int::select(w.lt(zero), -j, j)]
}

/// The canonical one of a point of the square from -m to m and its mirror image on the border.
#[inline(always)]
fn plus_on_border<V: Simd>([u, w]: [V::Int; 2], m: i32) -> [V::Int; 2] {
    let max = V::Int::splat(m);
    let (au, aw) = (u.abs(), w.abs());
    [V::Int::select(aw.eq(max), au, u), V::Int::select(au.eq(max), aw, w)]
}

/// Octahedral in biased unorm, (c + 1) / 2, of `BITS / 2` bits each: the odd numbers from -m to m =
/// 2^(BITS/2) - 1. It has no zero, so of the axes only -Z, a corner of the square, survives.
///
/// Source: Narkowicz, "Octahedron Normal Vector Encoding", 2014.
pub(crate) struct OctUnorm<const BITS: u32>;

impl<const BITS: u32> OctUnorm<BITS> {
    const M: i32 = unorm_max(BITS / 2);

    /// The two parameters as indices from 0 to m.
    #[inline(always)]
    fn params<V: Simd>(v: [V; 3]) -> [V; 2] {
        let [x, y, z] = v.each(|c| c.abs());
        let half = V::splat(0.5 * Self::M as f32);
        let scale = half / (x + y + z);
        let (x, y) = (x * scale, y * scale);
        let lower = v[2].lt(V::zero());
        let u = V::select(lower, half - y, x).negate_where_negative(v[0]);
        let w = V::select(lower, half - x, y).negate_where_negative(v[1]);
        [u + half, w + half]
    }

    /// The nearest point of the square, canonical.
    #[inline(always)]
    fn canonical_point<V: Simd>(indices: [V::Int; 2]) -> [V::Int; 2] {
        let max = V::Int::splat(Self::M);
        plus_on_border::<V>(indices.each(|i| (i + i - max).max(-max).min(max)), Self::M)
    }

    #[inline(always)]
    fn pack<V: Simd>(point: [V::Int; 2]) -> V::Int {
        pack2::<BITS, V>(point.each(|i| (i + V::Int::splat(Self::M)).sar(1)))
    }
}

impl<const BITS: u32> Formula for OctUnorm<BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        let indices = Self::params(v).each(|p| p.round_int());
        Self::pack::<V>(Self::canonical_point::<V>(indices))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        closest_of_four(
            v,
            Self::params(v),
            #[inline(always)]
            |indices| {
                let point = Self::canonical_point::<V>(indices);
                let p = scaled(unfold::<V>(point, Self::M), Self::M);
                (Self::pack::<V>(point), Central::direction(p))
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        let max = V::Int::splat(Self::M);
        let point = unpack2::<BITS, V>(code).each(|i| i + i - max);
        Central::direction(scaled(unfold::<V>(point, Self::M), Self::M))
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        Self::pack::<V>(Self::canonical_point::<V>(unpack2::<BITS, V>(code)))
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        let [x, y, z] = flips;
        if z {
            // Odd numbers, folded over the diagonals, are even.
            return mirror_decoded::<Self, V>(code, flips);
        }
        let [u, w] = unpack2::<BITS, V>(code);
        let index = inlined(
            #[inline(always)]
            |i: V::Int, flip: bool| if flip { V::Int::splat(Self::M) - i } else { i },
        );
        Self::pack::<V>(Self::canonical_point::<V>([index(u, x), index(w, y)]))
    }
}

/// The triangle of the lattice i + j + k = m that `p` lies in, whose components are >= 0 and add to m:
/// a point, and what has to be added to one component or another for its corners.
#[inline(always)]
pub(crate) fn triangle_around<V: Simd>(p: [V; 3], m: i32) -> ([V; 3], V) {
    let max = V::splat(m as f32);
    let one = V::splat(1.0);
    let floor = p.each(
        #[inline(always)]
        |c| c.floor(),
    );
    // One short of M above the floors, or two.
    let short = max - floor[0] - floor[1] - floor[2];
    let down = V::splat(1.5).lt(short);
    let base = floor.each(|c| V::select(down, c + one, c));
    (base, max - base[0] - base[1] - base[2])
}

/// Of the lattice points i + j + k = m of an octant, the one nearest in angle to `p`, whose
/// components are >= 0 and add to m.
#[inline(always)]
pub(crate) fn nearest_on_octahedron<V: Simd>(p: [V; 3], m: i32) -> [V; 3] {
    let (base, step) = triangle_around(p, m);
    // Least squared sine of the angle, |d x p|^2 / (|p|^2 |q|^2), q = p + d.
    let pp = math::length_squared(p);
    let corner = inlined(
        #[inline(always)]
        |axis: usize| {
            let mut q = base;
            q[axis] = q[axis] + step;
            let d = [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
            let along = math::dot(p, d);
            let off = math::length_squared(d) * pp - along * along;
            (q, off, math::length_squared(q))
        },
    );
    let closer = inlined(
        #[inline(always)]
        |a: ([V; 3], V, V), b: ([V; 3], V, V)| {
            let b_wins = (b.1 * a.2).lt(a.1 * b.2);
            let pick = inlined(
                #[inline(always)]
                |a, b| V::select(b_wins, b, a),
            );
            let q = [0, 1, 2].each(|i: usize| pick(a.0[i], b.0[i]));
            (q, pick(a.1, b.1), pick(a.2, b.2))
        },
    );
    closer(closer(corner(0), corner(1)), corner(2)).0
}
