//! Octahedral: the sphere projected onto an octahedron, its lower half folded out into a square.
//!
//! ```text
//! encode   p = v / (|x| + |y| + |z|)
//!          (u, w) = (p.x, p.y)                                       if z >= 0
//!                   ((1 - |p.y|) sgn p.x, (1 - |p.x|) sgn p.y)       if z < 0
//!          code = snorm(u), snorm(w)
//! decode   p = (u, w, 1 - |u| - |w|), the fold undone if p.z < 0; v = p / |p|
//! ```
//!
//! In integers, with M = 2^(BITS/2 - 1) - 1 steps, the representable points are the (i, j, k) with
//! i + j + k = M in each octant: a triangular lattice. The nearest of them to v is one of the three
//! corners of the triangle that p lies in, since no triangle is obtuse once seen from the centre.
//!
//! Canonical: on the border of the square the points (u, +-M) and (+-M, w) stand for one direction
//! where the folded coordinate is zero; the positive sign is the one emitted. Axes survive exactly.
//!
//! Source: Meyer, Süßmuth, Sußner, Stamminger and Greiner, "On Floating-Point Normal Vectors",
//! 2010; Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014.

use crate::formula::{Formula, One, Symmetric, closest_of_four};
use crate::lane::{Each, Lane, LaneInt, inlined};
use crate::layout::{pack_snorm2, pack2, snorm_max, unorm_max, unpack_snorm2, unpack2};
use crate::math;

/// Octahedral in `BITS` bits.
pub(crate) struct Oct<const BITS: u32>;

impl<const BITS: u32> Oct<BITS> {
    const M: i32 = snorm_max(BITS / 2);

    /// |v| on the octahedron, scaled to M.
    #[inline(always)]
    fn project<L: Lane>(v: [L; 3]) -> [L; 3] {
        let [x, y, z] = v.each(|c| c.abs());
        let scale = L::splat(Self::M as f32) / (x + y + z);
        [x * scale, y * scale, z * scale]
    }

    /// Gives the magnitudes `u`, `w` the signs of `x`, `y`, but where a sign says nothing, plus.
    #[inline(always)]
    fn finish<L: Lane>([u, w]: [L::Int; 2], [x, y, _]: [L; 3]) -> L::Int {
        let max = L::Int::splat(Self::M);
        let zero = L::zero();
        pack_snorm2::<BITS, L>([
            L::Int::select(x.lt(zero) & !w.eq(max), -u, u),
            L::Int::select(y.lt(zero) & !u.eq(max), -w, w),
        ])
    }
}

impl<const BITS: u32> Formula for Oct<BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<L: Lane>(v: [L; 3]) -> L::Int {
        let [x, y, _] = Self::project(v);
        let max = L::splat(Self::M as f32);
        // Fold the lower half over the diagonals.
        let lower = v[2].lt(L::zero());
        let u = L::select(lower, max - y, x).round_int();
        let w = L::select(lower, max - x, y).round_int();
        Self::finish([u, w], v)
    }

    #[inline(always)]
    fn encode_precise<L: Lane>(v: [L; 3]) -> L::Int {
        let max = L::splat(Self::M as f32);
        let [i, j, _] = nearest_on_octahedron(Self::project(v), Self::M);
        let lower = v[2].lt(L::zero());
        let u = L::select(lower, max - j, i).round_int();
        let w = L::select(lower, max - i, j).round_int();
        Self::finish([u, w], v)
    }

    #[inline(always)]
    fn decode<L: Lane>(code: L::Int) -> [L; 3] {
        unfold::<L>(unpack_snorm2::<BITS, L>(code), Self::M)
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: L::Int) -> L::Int {
        let point = plus_on_border::<L>(unpack_snorm2::<BITS, L>(code), Self::M);
        pack_snorm2::<BITS, L>(point)
    }
}

impl<const BITS: u32> Symmetric for Oct<BITS> {
    const ENTRIES: usize = triangle_len(Self::M);

    #[inline(always)]
    fn fold<L: Lane>(code: L::Int) -> (L::Int, [L::Mask; 3]) {
        let (max, zero) = (L::Int::splat(Self::M), L::Int::splat(0));
        let [u, w] = unpack_snorm2::<BITS, L>(code);
        let (i, j) = (u.abs(), w.abs());
        let lower = max.lt(i + j);
        let (i, j) = (L::Int::select(lower, max - j, i), L::Int::select(lower, max - i, j));
        let flips = [u.lt(zero) & zero.lt(i), w.lt(zero) & zero.lt(j), lower];
        (triangle_index::<L>(i, j), flips)
    }
}

/// How many points (i, j) with i + j <= m there are.
pub(crate) const fn triangle_len(m: i32) -> usize {
    (m as usize + 1) * (m as usize + 2) / 2
}

/// The number of a point (i, j), counted by i + j.
#[inline(always)]
pub(crate) fn triangle_index<L: Lane>(i: L::Int, j: L::Int) -> L::Int {
    let n = i + j;
    (n * (n + L::Int::splat(1))).shr(1) + j
}

/// The vector of a point of the square from -m to m.
#[inline(always)]
fn unfold<L: Lane>([u, w]: [L::Int; 2], m: i32) -> [L; 3] {
    let (max, zero) = (L::Int::splat(m), L::Int::splat(0));
    let (i, j) = (u.abs(), w.abs());
    let (left_i, left_j) = (max - j, max - i);
    let copy_sign = inlined(
        #[inline(always)]
        |magnitude: L::Int, sign: L::Int| L::Int::select(sign.lt(zero), -magnitude, magnitude),
    );
    // Below the diagonals, where more is left over than is there, fold back.
    let p = [copy_sign(i.min(left_i), u), copy_sign(j.min(left_j), w), left_i - i];
    math::normalize(p.each(|c| L::from_int(c) * L::splat(1.0 / m as f32)))
}

/// The canonical one of a point of the square from -m to m and its mirror image on the border.
#[inline(always)]
fn plus_on_border<L: Lane>([u, w]: [L::Int; 2], m: i32) -> [L::Int; 2] {
    let max = L::Int::splat(m);
    let (au, aw) = (u.abs(), w.abs());
    [L::Int::select(aw.eq(max), au, u), L::Int::select(au.eq(max), aw, w)]
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
    fn params<L: Lane>(v: [L; 3]) -> [L; 2] {
        let [x, y, z] = v.each(|c| c.abs());
        let half = L::splat(0.5 * Self::M as f32);
        let scale = half / (x + y + z);
        let (x, y) = (x * scale, y * scale);
        let lower = v[2].lt(L::zero());
        let u = L::select(lower, half - y, x).negate_where_negative(v[0]);
        let w = L::select(lower, half - x, y).negate_where_negative(v[1]);
        [u + half, w + half]
    }

    /// The nearest point of the square, canonical.
    #[inline(always)]
    fn canonical_point<L: Lane>(indices: [L::Int; 2]) -> [L::Int; 2] {
        let max = L::Int::splat(Self::M);
        plus_on_border::<L>(indices.each(|i| (i + i - max).max(-max).min(max)), Self::M)
    }

    #[inline(always)]
    fn pack<L: Lane>(point: [L::Int; 2]) -> L::Int {
        pack2::<BITS, L>(point.each(|i| (i + L::Int::splat(Self::M)).sar(1)))
    }
}

impl<const BITS: u32> Formula for OctUnorm<BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<L: Lane>(v: [L; 3]) -> L::Int {
        let indices = Self::params(v).each(|p| p.round_int());
        Self::pack::<L>(Self::canonical_point::<L>(indices))
    }

    #[inline(always)]
    fn encode_precise<L: Lane>(v: [L; 3]) -> L::Int {
        closest_of_four(
            v,
            Self::params(v),
            #[inline(always)]
            |indices| {
                let point = Self::canonical_point::<L>(indices);
                (Self::pack::<L>(point), unfold::<L>(point, Self::M))
            },
        )
    }

    #[inline(always)]
    fn decode<L: Lane>(code: L::Int) -> [L; 3] {
        let max = L::Int::splat(Self::M);
        unfold::<L>(unpack2::<BITS, L>(code).each(|i| i + i - max), Self::M)
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: L::Int) -> L::Int {
        Self::pack::<L>(Self::canonical_point::<L>(unpack2::<BITS, L>(code)))
    }
}

/// Of the lattice points i + j + k = m of an octant, the one nearest in angle to `p`, whose
/// components are >= 0 and add to m.
#[inline(always)]
pub(crate) fn nearest_on_octahedron<L: Lane>(p: [L; 3], m: i32) -> [L; 3] {
    let max = L::splat(m as f32);
    let one = L::splat(1.0);
    let floor = p.each(
        #[inline(always)]
        |c| c.floor(),
    );
    // The triangle around p: one short of M above the floors, or two.
    let short = max - floor[0] - floor[1] - floor[2];
    let down = L::splat(1.5).lt(short);
    let base = floor.each(|c| L::select(down, c + one, c));
    let step = max - base[0] - base[1] - base[2];
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
        |a: ([L; 3], L, L), b: ([L; 3], L, L)| {
            let b_wins = (b.1 * a.2).lt(a.1 * b.2);
            let pick = inlined(
                #[inline(always)]
                |a, b| L::select(b_wins, b, a),
            );
            let q = [0, 1, 2].each(|i: usize| pick(a.0[i], b.0[i]));
            (q, pick(a.1, b.1), pick(a.2, b.2))
        },
    );
    closer(closer(corner(0), corner(1)), corner(2)).0
}
