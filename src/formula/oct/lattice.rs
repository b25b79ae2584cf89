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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    fn ints<const N: usize>(values: [I32x1; N]) -> [i32; N] {
        values.map(|i| i.0)
    }

    #[test]
    fn the_square_folds_onto_the_octahedron() {
        for (square, point) in [
            ([3, 2], [3, 2, 2]),
            ([5, 4], [3, 2, -2]),
            ([-6, 5], [-2, 1, -4]),
            ([7, -7], [0, 0, -7]),
            // On the diagonal u + w = 7, the equator.
            ([4, -3], [4, -3, 0]),
        ] {
            assert_eq!(ints(unfold::<f32>(square.map(I32x1), 7).to_array()), point);
        }
    }

    #[test]
    fn the_other_hemisphere_is_across_the_diagonal() {
        for (a, b) in [([3, 2], [5, 4]), ([-6, 5], [-2, 1]), ([4, -3], [4, -3]), ([0, 0], [7, 7])] {
            assert_eq!(ints(across_equator::<f32>(a.map(I32x1), 7)), b);
        }
        assert_eq!(ints(across_equator::<f32>([5, 4].map(I32x1), 7)), [3, 2]);
    }

    #[test]
    fn the_border_has_one_sign() {
        for (a, b) in
            [([-3, 7], [3, 7]), ([-7, -2], [-7, 2]), ([-7, -7], [7, 7]), ([-6, -3], [-6, -3])]
        {
            assert_eq!(ints(plus_on_border::<f32>(a.map(I32x1), 7)), b);
        }
    }

    #[test]
    fn points_are_numbered_by_their_sum() {
        let points = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2], [3, 0]];
        for (n, [i, j]) in points.into_iter().enumerate() {
            assert_eq!(triangle_index::<f32>(I32x1(i), I32x1(j)).0, n as i32);
        }
        assert_eq!([triangle_len(0), triangle_len(2), triangle_len(7)], [1, 6, 36]);
    }

    #[test]
    fn triangles_point_up_or_down() {
        let steps = Steps::new(7);
        let up = triangle_around(Vec3::new(0.25f32, 0.5, 6.25), steps);
        assert_eq!(up, (Vec3::new(0.0, 0.0, 6.0), 1.0));
        let down = triangle_around(Vec3::new(0.75f32, 0.75, 5.5), steps);
        assert_eq!(down, (Vec3::new(1.0, 1.0, 6.0), -1.0));
    }

    #[test]
    fn the_nearest_point_is_a_corner_of_the_triangle() {
        let steps = Steps::new(7);
        for (p, nearest) in [
            ([0.25f32, 0.5, 6.25], [0.0, 0.0, 7.0]),
            ([0.75, 0.75, 5.5], [1.0, 1.0, 5.0]),
            ([2.6, 2.2, 2.2], [3.0, 2.0, 2.0]),
        ] {
            assert_eq!(nearest_on_octahedron(p.into(), steps).to_array(), nearest);
        }
    }
}
