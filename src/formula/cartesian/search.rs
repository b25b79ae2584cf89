//! The nearest point over all lengths.

use super::Cartesian;
use super::grid::Grid;
use crate::simd::math::sqrt;
use crate::simd::{Simd, SimdInt, SimdMask, Vec3, map_vec, map2, map3};

/// 1 in 0.32 fixed point.
const WRAP: f32 = 4_294_967_296.0;

/// x in units of 2^-32, without what is before the point. For |x| < 2^10.
#[inline(always)]
fn wrapping_fraction<V: Simd>(x: V) -> V::Int {
    let high = (x * 2048.0).round();
    let low = (x - high * (1.0 / 2048.0)) * WRAP;
    high.round_int().shl(21) + low.round_int()
}

/// An axis, in each lane: the target's slope along it, its steps, and one step.
#[derive(Clone, Copy)]
struct Side<V> {
    slope: V,
    steps: V,
    step: V,
}

impl<V: Simd> Side<V> {
    #[inline(always)]
    fn select(mask: V::Mask, yes: Self, no: Self) -> Self {
        Side {
            slope: V::select(mask, yes.slope, no.slope),
            steps: V::select(mask, yes.steps, no.steps),
            step: V::select(mask, yes.step, no.step),
        }
    }
}

/// One target, seen along its largest component.
pub(super) struct Search<V: Simd, G> {
    grid: G,
    target: Vec3<V>,
    /// The components over the largest one's magnitude.
    slope: Vec3<V>,
    /// Their sum of squares.
    stretch: V,
    /// The steps on the axis of the largest component, and one step.
    steps: V,
    step: V,
    /// Whether that is x, or y.
    is_x: V::Mask,
    is_y: V::Mask,
    /// The other two axes.
    p: Side<V>,
    q: Side<V>,
}

/// The best corner so far: the square and the length that the tangent is made of, and the place.
#[derive(Clone, Copy)]
struct Corner<V> {
    across: V,
    reach: V,
    length: V,
    x: V,
    y: V,
}

impl<V: Simd, G: Grid> Search<V, G> {
    #[inline(always)]
    pub(super) fn new(grid: G, v: Vec3<V>) -> Self {
        // Bring the length between sqrt(1/2) and sqrt(2) by a power of two.
        let exponent = v.length_squared().to_bits().shr_arithmetic(23) - 126;
        let scale = V::from_bits((V::Int::splat(127) - exponent.shr_arithmetic(1)).shl(23));
        let v = v * scale;
        // A decoded vector is not divided again, so that its own code is at distance zero.
        let is_decoded = (v.length_squared() - 1.0).abs().lt(6e-7);
        let target = Vec3::select(is_decoded, v, v.normalize());
        let magnitudes = target.abs();
        let largest = magnitudes.max_component();
        let (is_x, is_y) = (largest.le(magnitudes.x), largest.le(magnitudes.y));
        let slope = map_vec!(target, |c| c / largest);
        let (steps, step) = (grid.steps(), grid.step());
        let [on_x, on_y, on_z] = map3!([0, 1, 2], |i: usize| Side {
            slope: slope[i],
            steps: V::splat(steps[i]),
            step: V::splat(step[i]),
        });
        let main = Side::select(is_x, on_x, Side::select(is_y, on_y, on_z));
        Search {
            grid,
            target,
            slope,
            stretch: slope.length_squared(),
            steps: main.steps,
            step: main.step,
            is_x,
            is_y,
            p: Side::select(is_x, on_y, on_x),
            q: Side::select(is_x | is_y, on_z, on_y),
        }
    }

    /// A point can only be nearer than the square root of `distance` if the sine of its angle is below
    /// that, up to rounding in f32. Returns the square of that sine and, over the length on the largest
    /// axis, how far off the point can be on each of the others.
    #[inline(always)]
    fn bounds(&self, distance: V) -> [V; 2] {
        let sine = sqrt(distance) * 1.01 + 6e-7;
        // Stretch times the sine, and a little for the length of the offset itself.
        let off = self.stretch * sine * 1.3;
        [sine * sine, V::select(sine.lt(0.1), off, f32::INFINITY)]
    }

    /// The nearest point of a grid of whole steps, or a multiple of it.
    #[inline(always)]
    pub(super) fn nearest_whole(&self) -> Vec3<V::Int> {
        let (point, sure) = self.nearest_corner::<false>();
        if !(!sure).any() {
            return point;
        }
        let (nearest, _) = self.nearest_corner::<true>();
        Vec3::select_int(sure, point, nearest)
    }

    /// At each length the target's ray passes a cell of the grid. Returns the nearest of the corners of
    /// all cells, or unless `ALL` of those that rounding gives, and whether these are enough.
    #[inline(always)]
    fn nearest_corner<const ALL: bool>(&self) -> (Vec3<V::Int>, V::Mask) {
        let Search { grid, p, q, .. } = *self;
        let is_even = grid.is_even();
        let one = V::splat(1.0);
        let lengths = grid.lengths() + 1 - grid.steps()[0] as i32 / grid.shorter();
        let first = (self.steps * (1.0 / grid.shorter() as f32)).floor();
        // How far the ray is from the rounded corner: fractions of 2^32 pitches, which wrap.
        let rises = [p.slope * (p.steps / self.steps), q.slope * (q.steps / self.steps)];
        let [mut a, mut b] = map2!(rises, |rise| {
            let from = wrapping_fraction(rise) * first.round_int();
            if grid.pitch() == 1 { from } else { from - wrapping_fraction((rise + one) * 0.5) }
        });
        let [rise_a, rise_b] = map2!(rises, |rise| wrapping_fraction(rise));
        // The square of the tangent of the angle between point and target, up to a factor, is
        // (x (x + skew y) + other y^2) / (length - (x lean_x + y lean_y))^2.
        let unit = grid.pitch() as f32 / WRAP;
        let ratio = p.steps / q.steps;
        let scale = q.slope * q.slope + one;
        let pq = p.slope * q.slope;
        let skew = -(pq + pq) / scale * ratio;
        let other = (p.slope * p.slope + one) / scale * (ratio * ratio);
        let lean = self.steps * unit / self.stretch;
        let (lean_x, lean_y) = (lean * p.slope / p.steps, lean * q.slope / q.steps);
        let zero = V::splat(0.0);
        let mut best =
            Corner { across: V::splat(f32::MAX), reach: one, length: one, x: zero, y: zero };
        let mut n = first;
        for _ in 0..lengths {
            let length = grid.length(n, one);
            let (x, y) = (V::from_int(a), V::from_int(b));
            let far_x = x - V::splat(WRAP).negate_where_negative(x);
            let far_y = y - V::splat(WRAP).negate_where_negative(y);
            let corners = [(x, y), (far_x, y), (x, far_y), (far_x, far_y)];
            for &(x, y) in if ALL { &corners[..] } else { &corners[..1] } {
                let across = x * (x + skew * y) + other * y * y;
                let reach = length - (x * lean_x + y * lean_y);
                let reach = reach * reach;
                let mut nearer = (across * best.reach).lt(best.across * reach);
                if !is_even {
                    nearer = nearer & length.le(self.steps);
                }
                best = Corner {
                    across: V::select(nearer, across, best.across),
                    reach: V::select(nearer, reach, best.reach),
                    length: V::select(nearer, length, best.length),
                    x: V::select(nearer, x, best.x),
                    y: V::select(nearer, y, best.y),
                };
            }
            (n, a, b) = (n + one, a + rise_a, b + rise_b);
        }
        let at = best.length * self.step;
        let ideal = self.slope * at;
        let (mut x, mut y) = (zero, zero);
        if ALL {
            (x, y) = (best.x * unit / p.steps, best.y * unit / q.steps);
        }
        let off = Vec3::new(
            V::select(self.is_x, zero, x),
            V::select(self.is_x, x, V::select(self.is_y, zero, y)),
            V::select(self.is_x | self.is_y, y, zero),
        );
        let point = Cartesian(grid).nearest(ideal - off);
        (point, self.surely_rounded(best.across / best.reach))
    }

    /// Whether the nearest corner is a rounded one, if the tangent of the nearest of those is, squared and
    /// in the units of [`nearest_corner`](Self::nearest_corner), `square`.
    #[inline(always)]
    fn surely_rounded(&self, square: V) -> V::Mask {
        let Search { grid, p, q, .. } = *self;
        let [pp, qq] = [p.slope * p.slope, q.slope * q.slope];
        let unit = grid.pitch() as f32 / WRAP;
        let tangent = self.steps * unit / (p.steps * self.stretch);
        let tangent_squared = tangent * tangent * (qq + 1.0) * square;
        // What is no rounded corner is at least half a pitch off on one axis.
        let most = grid.steps()[0];
        let half = 0.23 * (grid.pitch() * grid.pitch()) as f32 / (most * most);
        (tangent_squared * self.stretch * (pp.max(qq) + 1.0)).lt(half)
    }

    /// The nearest point of a grid finer than f32; of those that decode alike, the one whose length is
    /// nearest to 1.
    #[inline(always)]
    pub(super) fn nearest(&self) -> Vec3<V::Int> {
        let Search { grid, p, q, .. } = *self;
        let mut found = FoundPoint {
            point: Vec3::from([V::Int::splat(0); 3]),
            distance: V::splat(4.0),
            off_unit: V::splat(4.0),
            bounds: self.bounds(V::splat(4.0)),
        };
        let per_stretch = V::splat(1.0) / self.stretch;
        let first = (grid.steps()[0] as i32 / grid.shorter()).max(1);
        for n in (first..=grid.lengths()).rev() {
            let length = grid.length(V::splat(n as f32), self.step);
            let a = grid.off(p.slope * length, p.steps, p.step);
            let b = grid.off(q.slope * length, q.steps, q.step);
            let reach = found.bounds[1] * length;
            if !a.max(b).le(reach).any() {
                continue;
            }
            let ideal = self.slope * length;
            // Near the diagonals and in a coarse grid the rounded corner of the cell is not always
            // the nearest: components may go the other way, if half a gap is near enough.
            let [x, y, z] = grid.step();
            let gap = Vec3::new(
                grid.half_gap(ideal.x, x),
                grid.half_gap(ideal.y, y),
                grid.half_gap(ideal.z, z),
            );
            let rounded = Cartesian(grid).nearest(ideal);
            let mut candidates = [rounded; 4];
            let mut count = 1;
            if gap.min_component().le(reach).any() {
                // The other corners: the largest component stays as it is.
                let values = Cartesian(grid).values::<V>(rounded);
                let other = Vec3::from(map3!([0, 1, 2], |i: usize| {
                    let up = V::Int::select(values[i].lt(ideal[i]), grid.pitch(), 0);
                    let down = V::Int::select(ideal[i].lt(values[i]), grid.pitch(), 0);
                    rounded[i] + up - down
                }));
                for kept in 0..3 {
                    let mut point = other;
                    point[kept] = rounded[kept];
                    candidates[kept + 1] = point;
                }
                count = 4;
            }
            for point in candidates.into_iter().take(count) {
                self.consider(&mut found, point, ideal, length, per_stretch);
            }
        }
        found.point
    }

    /// Considers a point beside the ray's `ideal` one.
    #[inline(always)]
    fn consider(
        &self,
        found: &mut FoundPoint<V>,
        point: Vec3<V::Int>,
        ideal: Vec3<V>,
        length: V,
        per_stretch: V,
    ) {
        let cartesian = Cartesian(self.grid);
        let values = cartesian.values::<V>(point);
        let offset = values - ideal;
        let along = offset.dot(self.slope);
        let across = offset.length_squared() - along * along * per_stretch;
        let near = across.le(values.length_squared() * found.bounds[0]) & length.le(1.0);
        if !near.any() {
            return;
        }
        // As f32 does not tell neighbours apart, only canonical points compete.
        let point = self.grid.representative::<V>(point);
        let values = cartesian.values::<V>(point);
        let there = Cartesian::<G>::unit(values).distance_squared(self.target);
        let off_unit = (sqrt(values.length_squared()) - 1.0).abs();
        let alike =
            found.distance.le(there) & there.le(found.distance) & off_unit.lt(found.off_unit);
        let better = near & (there.lt(found.distance) | alike);
        found.distance = V::select(better, there, found.distance);
        found.off_unit = V::select(better, off_unit, found.off_unit);
        found.point = Vec3::select_int(better, point, found.point);
        found.bounds = self.bounds(found.distance);
    }
}

/// The nearest point so far of a grid finer than f32.
struct FoundPoint<V: Simd> {
    point: Vec3<V::Int>,
    distance: V,
    /// How far its length is from 1.
    off_unit: V,
    /// See [`Search::bounds`].
    bounds: [V; 2],
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::cartesian::Xyz;
    use crate::formula::testing::assert_nearest;

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        let vectors = [[1.0, 2.0, 3.0], [-7.0, 6.9, 0.1], [0.3, -0.9, 0.2], [5.0, 5.1, -5.2]];
        let formulas = [(Xyz::snorm([5; 3]), 15), (Xyz::snorm([5, 5, 4]), 14), (Xyz::unorm(4), 12)];
        for (formula, bits) in formulas {
            assert_nearest(formula, 1 << bits, vectors);
        }
    }

    #[test]
    fn what_is_before_the_point_wraps() {
        for (x, fraction) in
            [(0.25f32, 1 << 30), (3.25, 1 << 30), (-0.25, -1 << 30), (7.5, i32::MIN)]
        {
            assert_eq!(wrapping_fraction(x).0, fraction, "{x}");
        }
        assert_eq!(wrapping_fraction(1.0f32 + f32::EPSILON).0, 1 << 9);
    }
}
