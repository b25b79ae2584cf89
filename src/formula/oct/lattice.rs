//! The lattice of an octahedron's face, i + j + k = M, and its square.

use crate::simd::{Simd, SimdInt, Vec3, map_vec, map3};

/// M, the sum of the magnitudes of a lattice point.
#[derive(Clone, Copy)]
pub(crate) struct Steps {
    pub(super) count: i32,
    /// The same as a float.
    pub(super) float: f32,
    /// 1 / M.
    pub(super) inverse: f32,
}

impl Steps {
    pub(crate) const fn new(count: i32) -> Self {
        Steps { count, float: count as f32, inverse: 1.0 / count as f32 }
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
pub(super) fn unfold<V: Simd>([u, w]: [V::Int; 2], m: i32) -> Vec3<V::Int> {
    let (i, j) = (u.abs(), w.abs());
    let (left_i, left_j) = (V::Int::splat(m) - j, V::Int::splat(m) - i);
    // Below the diagonals, where the other coordinate leaves less than there is, fold back.
    let (x, y) = (i.min(left_i), j.min(left_j));
    Vec3::new(x.negate_where_negative(u), y.negate_where_negative(w), left_i - i)
}

/// The point of the square with the opposite z: its mirror image in the diagonal of its quarter.
#[inline(always)]
pub(super) fn across_equator<V: Simd>([u, w]: [V::Int; 2], m: i32) -> [V::Int; 2] {
    let (i, j) = (V::Int::splat(m) - w.abs(), V::Int::splat(m) - u.abs());
    [i.negate_where_negative(u), j.negate_where_negative(w)]
}

/// The canonical one of a point of the square and its mirror image on the border.
#[inline(always)]
pub(super) fn plus_on_border<V: Simd>([u, w]: [V::Int; 2], m: i32) -> [V::Int; 2] {
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
