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

use super::support::bits::Pair;
use super::support::closest::{Closest, corners};
use super::support::sign::negate_if;
use super::{Formula, Lattice, Symmetric, Use, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{atan2_half_turns, sin_cos_of_one, sqrt};
use crate::simd::{Simd, SimdInt, Vec3, map_vec, map2, map3};

/// Octahedral with the map `P`.
#[derive(Clone, Copy)]
pub(crate) struct Oct<P> {
    pair: Pair,
    steps: Steps,
    map: PhantomData<P>,
}

/// M, the sum of the magnitudes of a lattice point.
#[derive(Clone, Copy)]
pub(crate) struct Steps {
    count: i32,
    /// The same as a float.
    float: f32,
    /// 1 / M.
    inverse: f32,
}

impl Steps {
    pub(crate) const fn new(count: i32) -> Self {
        Steps { count, float: count as f32, inverse: 1.0 / count as f32 }
    }
}

/// How an octant of the sphere is mapped to a face of the octahedron.
pub(crate) trait Projection: Copy + Send + Sync + 'static {
    /// The point of |v|, whose components add to M.
    fn project<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V>;
    /// The unit vector of a point whose magnitudes add to 1.
    fn direction<V: Simd>(p: Vec3<V>) -> Vec3<V>;
    /// The lattice point nearest to |v|: of the corners of the triangle around it.
    #[inline(always)]
    fn nearest<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        let v = v.abs();
        let (base, step) = triangle_around(Self::project(v, steps), steps);
        let mut closest = Closest::to(v);
        for axis in 0..3 {
            let mut q = base;
            q[axis] = q[axis] + step;
            closest.consider(V::Int::from(axis as i32), Self::direction(q * steps.inverse));
        }
        let axis = closest.code();
        Vec3::from(map3!([0, 1, 2], |i: usize| {
            V::select(axis.eq(i as i32), base[i] + step, base[i])
        }))
    }
}

/// Along the rays from the centre.
#[derive(Clone, Copy)]
pub(crate) struct Central;
/// With triangles of about the same size.
#[derive(Clone, Copy)]
pub(crate) struct Warped;
/// With equal areas.
#[derive(Clone, Copy)]
pub(crate) struct EqualArea;

impl Projection for Central {
    #[inline(always)]
    fn project<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        let v = v.abs();
        v * (V::splat(steps.float) / (v.x + v.y + v.z))
    }
    #[inline(always)]
    fn direction<V: Simd>(p: Vec3<V>) -> Vec3<V> {
        p.normalize()
    }
    #[inline(always)]
    fn nearest<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        nearest_on_octahedron(Self::project(v, steps), steps)
    }
}

impl Warped {
    /// See `examples/warp.rs`.
    const K: f32 = 0.459_265;
    const Q: f32 = -0.710_567;
    /// About the K and Q of the inverse.
    const INVERSE: [f32; 2] = [-0.35, 0.7];

    /// g(t) = t (1 + (k + q t) (1 - t)); odd.
    #[inline(always)]
    fn warp<V: Simd>(t: V, [k, q]: [f32; 2]) -> V {
        let magnitude = t.abs();
        t * ((magnitude * q + k) * (V::splat(1.0) - magnitude) + 1.0)
    }

    /// g'(t).
    #[inline(always)]
    fn gradient<V: Simd>(t: V) -> V {
        t * (V::splat(2.0 * (Self::Q - Self::K)) - t * (3.0 * Self::Q)) + (1.0 + Self::K)
    }

    #[inline(always)]
    fn warp_all<V: Simd>(p: Vec3<V>) -> Vec3<V> {
        map_vec!(p, |t| Self::warp(t, [Self::K, Self::Q]))
    }
}

impl Projection for Warped {
    #[inline(always)]
    fn project<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        let target = v.abs();
        let central = target * (V::splat(1.0) / (target.x + target.y + target.z));
        // Without a good first guess, two steps would not be enough for 32 bits.
        let mut p = map_vec!(central, |t| Self::warp(t, Self::INVERSE));
        for _ in 0..2 {
            let g = Self::warp_all(p);
            let Vec3 { x, y, z } = map_vec!(p, |t| Self::gradient(t));
            // The inverse of each gradient, and s, from one division.
            let (others, all) = (Vec3::new(y * z, z * x, x * y), x * y * z);
            let (along, off) = (target.dot(others), V::splat(1.0) - (p.x + p.y + p.z));
            let inverse = V::splat(1.0) / (along * all);
            let s = (g.dot(others) + off * all) * all * inverse;
            p = p + (target * s - g).times(others * (along * inverse));
        }
        map_vec!(p, |t| t.max(0.0) * steps.float)
    }
    #[inline(always)]
    fn direction<V: Simd>(p: Vec3<V>) -> Vec3<V> {
        Self::warp_all(p).normalize()
    }
}

impl Projection for EqualArea {
    #[inline(always)]
    fn project<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        let Vec3 { x, y, z } = v.abs().normalize();
        // 1 - z, and 1 - r, without cancellation.
        let r = sqrt((x * x + y * y) / (z + 1.0));
        let k = z / (r + 1.0);
        let a = atan2_half_turns(y, x);
        let a = a + a;
        Vec3::new(r * (V::splat(1.0) - a), r * a, k) * steps.float
    }
    #[inline(always)]
    fn direction<V: Simd>(p: Vec3<V>) -> Vec3<V> {
        let Vec3 { x, y, z: k } = p.abs();
        let r = x + y;
        let (sin, cos) = sin_cos_of_one(y / r.max(f32::MIN_POSITIVE));
        // 2 - r^2 = 1 + z.
        let height = k * (r + 1.0);
        let h = r * sqrt(height + 1.0);
        Vec3::new(h * cos, h * sin, height).negate_where_negative(p).normalize()
    }
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

    pub(crate) const fn steps(self) -> Steps {
        self.steps
    }

    /// The point of the square.
    #[inline(always)]
    fn unpack<V: Simd>(self, code: V::Int) -> [V::Int; 2] {
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
    const PRECISE_USE: Use = Use::Often;

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

/// Number of points (i, j) with i + j <= m.
pub(crate) const fn triangle_len(m: i32) -> usize {
    (m as usize + 1) * (m as usize + 2) / 2
}

/// Number of the point (i, j), in the order of i + j.
#[inline(always)]
pub(crate) fn triangle_index<V: Simd>(i: V::Int, j: V::Int) -> V::Int {
    let n = i + j;
    (n * (n + 1)).shr_logical(1) + j
}

/// The lattice point, whose magnitudes add to m, of a point of the square from -m to m.
#[inline(always)]
fn unfold<V: Simd>([u, w]: [V::Int; 2], m: i32) -> Vec3<V::Int> {
    let (i, j) = (u.abs(), w.abs());
    let (left_i, left_j) = (V::Int::splat(m) - j, V::Int::splat(m) - i);
    // Below the diagonals, where the other coordinate leaves less than there is, fold back.
    let (x, y) = (i.min(left_i), j.min(left_j));
    Vec3::new(x.negate_where_negative(u), y.negate_where_negative(w), left_i - i)
}

/// The point of the square with the opposite z: its mirror image in the diagonal of its quarter.
#[inline(always)]
fn across_equator<V: Simd>([u, w]: [V::Int; 2], m: i32) -> [V::Int; 2] {
    let (i, j) = (V::Int::splat(m) - w.abs(), V::Int::splat(m) - u.abs());
    [i.negate_where_negative(u), j.negate_where_negative(w)]
}

/// The canonical one of a point of the square and its mirror image on the border.
#[inline(always)]
fn plus_on_border<V: Simd>([u, w]: [V::Int; 2], m: i32) -> [V::Int; 2] {
    let (au, aw) = (u.abs(), w.abs());
    [V::Int::select(aw.eq(m), au, u), V::Int::select(au.eq(m), aw, w)]
}

/// The triangle of the lattice i + j + k = M around `p`, whose components are >= 0 and add to M: a
/// point, and the step that leads to a corner when added to one of its components.
#[inline(always)]
pub(crate) fn triangle_around<V: Simd>(p: Vec3<V>, steps: Steps) -> (Vec3<V>, V) {
    let max = V::splat(steps.float);
    let floor = p.floor();
    // M is one or two above the sum of the floors.
    let short = max - floor.x - floor.y - floor.z;
    let down = V::splat(1.5).lt(short);
    let base = map_vec!(floor, |c| V::select(down, c + 1.0, c));
    (base, max - base.x - base.y - base.z)
}

/// The lattice point i + j + k = M of an octant that is nearest in angle to `p`, whose components are
/// >= 0 and add to M.
#[inline(always)]
pub(crate) fn nearest_on_octahedron<V: Simd>(p: Vec3<V>, steps: Steps) -> Vec3<V> {
    /// A lattice point q, its |d x p|^2 with q = p + d, and |q|^2.
    #[derive(Clone, Copy)]
    struct Corner<V> {
        point: Vec3<V>,
        off: V,
        length_squared: V,
    }
    let (base, step) = triangle_around(p, steps);
    let pp = p.length_squared();
    let [mut nearest, second, third] = map3!([0, 1, 2], |axis: usize| {
        let mut point = base;
        point[axis] = point[axis] + step;
        let d = point - p;
        let along = p.dot(d);
        let off = d.length_squared() * pp - along * along;
        Corner { point, off, length_squared: point.length_squared() }
    });
    // The squared sine of the angle is off / (|p|^2 |q|^2).
    for corner in [second, third] {
        let closer = (corner.off * nearest.length_squared).lt(nearest.off * corner.length_squared);
        nearest = Corner {
            point: Vec3::select(closer, corner.point, nearest.point),
            off: V::select(closer, corner.off, nearest.off),
            length_squared: V::select(closer, corner.length_squared, nearest.length_squared),
        };
    }
    nearest.point
}

/// Octahedral in biased unorm, (c + 1) / 2: the odd numbers from -M to M = 2^(BITS/2) - 1. It has no
/// zero, so of the axes only -Z, a corner of the square, survives.
///
/// Source: Narkowicz, "Octahedron Normal Vector Encoding", 2014.
#[derive(Clone, Copy)]
pub(crate) struct OctUnorm {
    pair: Pair,
    steps: Steps,
}

impl OctUnorm {
    pub(crate) const fn new(bits: u32) -> Self {
        let pair = Pair::new(bits);
        OctUnorm { pair, steps: Steps::new(pair.unorm_max()) }
    }

    /// The two parameters as indices from 0 to M.
    #[inline(always)]
    fn params<V: Simd>(self, v: Vec3<V>) -> [V; 2] {
        let half = V::splat(0.5 * self.steps.float);
        let Vec3 { x, y, z } = v.abs();
        let scale = half / (x + y + z);
        let (x, y) = (x * scale, y * scale);
        // Fold the lower half over the diagonals.
        let lower = v.z.lt(0.0);
        let u = V::select(lower, half - y, x).negate_where_negative(v.x);
        let w = V::select(lower, half - x, y).negate_where_negative(v.y);
        [u + half, w + half]
    }

    /// The point of the square nearest to two indices, canonical.
    #[inline(always)]
    fn canonical_point<V: Simd>(self, indices: [V::Int; 2]) -> [V::Int; 2] {
        let max = self.steps.count;
        plus_on_border::<V>(map2!(indices, |i| (i + i - max).clamp(-max, max)), max)
    }

    #[inline(always)]
    fn vector<V: Simd>(self, point: [V::Int; 2]) -> Vec3<V> {
        let p = Vec3::from_int(unfold::<V>(point, self.steps.count)) * self.steps.inverse;
        p.normalize()
    }

    #[inline(always)]
    fn pack<V: Simd>(self, point: [V::Int; 2]) -> V::Int {
        self.pair.pack::<V>(map2!(point, |i| (i + self.steps.count).shr_arithmetic(1)))
    }
}

impl Formula for OctUnorm {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let indices = map2!(self.params(v), |p| p.round_int());
        self.pack::<V>(self.canonical_point::<V>(indices))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let mut closest = Closest::to(v);
        for indices in corners(self.params(v)) {
            let point = self.canonical_point::<V>(indices);
            closest.consider(self.pack::<V>(point), self.vector(point));
        }
        closest.code()
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        let max = self.steps.count;
        self.vector(map2!(self.pair.unpack::<V>(code), |i| i + i - max))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        let [x, y, z] = flips;
        if z {
            // Odd numbers, folded over the diagonals, are even.
            return self.mirror_decoded::<V>(code, flips);
        }
        let [u, w] = self.pair.unpack::<V>(code);
        let max = V::Int::splat(self.steps.count);
        let indices = [if x { max - u } else { u }, if y { max - w } else { w }];
        self.pack::<V>(self.canonical_point::<V>(indices))
    }
}

kernels!(Oct<Central>: Words; Oct<Warped>: Words; Oct<EqualArea>: Words; OctUnorm: Words);
