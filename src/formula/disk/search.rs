//! The code nearest to a vector.

use super::projection::DiskPoint;
use super::stretch::Scale;
use super::{Chart, Point};
use crate::formula::support::closest::Closest;
use crate::simd::math::{inv_sqrt, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, Vec3, map2};

impl Chart {
    /// The parameters of the point nearest to a direction.
    #[inline(never)]
    pub(super) fn nearest<V: Simd>(self, v: Vec3<V>) -> [V::Int; 2] {
        V::with_target_features(
            #[inline(always)]
            || {
                let v = unit(v);
                let lower = v.z.lt(0.0);
                let other = !lower;
                let always = V::Mask::splat(true);
                let has_corners = self.stretch.has_corners();
                let place = self.params(v, false).0;
                // What was decoded finds its own code at once.
                let mut own = Search::new(self, v);
                own.consider(always, map2!(place, |p| p.round_int()), lower);
                if has_corners {
                    let past = self.params(v, true).0;
                    own.consider(always, map2!(past, |p| p.round_int()), other);
                }
                if own.closest.is_exact() {
                    return own.params();
                }
                let mut search = Search::new(self, v);
                search.around(always, place, lower);
                if self.stretch.is_sheared() {
                    search.diagonals(v, place, lower);
                }
                if has_corners {
                    search.outside(v, other);
                }
                search.params()
            },
        )
    }
}

/// v / |v|. What was decoded keeps its bits, and so finds its code again, however close the next
/// point is.
#[inline(always)]
fn unit<V: Simd>(v: Vec3<V>) -> Vec3<V> {
    // The power of two that brings the length between 0.8 and 1.7.
    let square = v.length_squared();
    let exponent = (square * 1.5).to_bits().shr_logical(23) - 127;
    let scale = V::from_bits((V::Int::splat(127) - exponent.shr_arithmetic(1)).shl(23));
    let is_unit = (square * scale * scale - 1.0).abs().lt(1e-6);
    v * V::select(is_unit, scale, inv_sqrt(square))
}

/// The nearest point so far.
struct Search<V: Simd> {
    closest: Closest<V>,
    chart: Chart,
}

impl<V: Simd> Search<V> {
    #[inline(always)]
    fn new(chart: Chart, v: Vec3<V>) -> Self {
        Search { closest: Closest::to_unit(v), chart }
    }

    /// The canonical parameters of the nearest.
    #[inline(always)]
    fn params(self) -> [V::Int; 2] {
        let code = self.closest.code();
        [code.shr_arithmetic(16), code.sign_extend(16)]
    }

    /// Considers one point.
    #[inline(always)]
    fn consider(&mut self, counts: V::Mask, place: [V::Int; 2], lower: V::Mask) {
        self.window(counts, place, [1, 1], lower);
    }

    /// Considers as many columns and rows from the first on.
    #[inline(never)]
    fn window(&mut self, counts: V::Mask, first: [V::Int; 2], size: [i32; 2], lower: V::Mask) {
        V::with_target_features(
            #[inline(always)]
            || {
                let Chart { stretch, scale, .. } = self.chart;
                for i in 0..size[0] {
                    for j in 0..size[1] {
                        let point =
                            Point::<V>::clamped(first[0] + i, first[1] + j, lower, scale.max);
                        let counts = if stretch.has_corners() {
                            counts & !self.chart.duplicate_of(&point).0
                        } else {
                            counts
                        };
                        let [column, row] = self.chart.snorms::<V>(&point);
                        let code = column.shl(16) | row.low_bits(16);
                        self.closest.consider_where(counts, code, self.chart.vector(&point));
                    }
                }
            },
        );
    }

    /// Considers the points around a place.
    #[inline(always)]
    fn around(&mut self, counts: V::Mask, place: [V; 2], lower: V::Mask) {
        let [columns, rows] = self.chart.stretch.window();
        let first_column = place[0].floor().round_int() - columns.before;
        let first_row = place[1].floor().round_int() - rows.before;
        self.window(counts, [first_column, first_row], [columns.count, rows.count], lower);
    }

    /// Considers the nearest point on each of the diagonals beside a place near a corner: along
    /// them, x and y hardly change.
    #[inline(always)]
    fn diagonals(&mut self, v: Vec3<V>, place: [V; 2], lower: V::Mask) {
        let Scale { max, float, .. } = self.chart.scale;
        let u = place[0] + place[0] - float;
        let near = V::splat(float * 0.75).lt(u.abs().min(place[1].abs()));
        if !near.any() {
            return;
        }
        let outwards = map2!([u, place[1]], |side| V::Int::select(side.lt(0.0), -1, 1));
        // A column is two rows wide.
        let step = [outwards[0], outwards[1] + outwards[1]];
        let [column, row] = map2!(place, |p| p.round_int());
        let last = V::Int::splat(max);
        let first = row - 3;
        for beside in 0..7 {
            let row = first + beside;
            // A diagonal that would begin outside the square begins where it leaves it.
            let outside = (row.abs() - max + 1).shr_arithmetic(1).max(0);
            let mut at = [column.clamp(0, max) - step[0] * outside, row - step[1] * outside];
            let mut least = self.distance_squared(at, lower, v);
            for length in [64, 32, 16, 8, 4, 2, 2, 1, 1] {
                for length in [length, -length] {
                    let to = [at[0] + step[0] * length, at[1] + step[1] * length];
                    let exists = !to[0].lt(0) & !last.lt(to[0]) & !last.lt(to[1].abs());
                    let there = self.distance_squared(to, lower, v);
                    let closer = exists & there.lt(least);
                    at = [
                        V::Int::select(closer, to[0], at[0]),
                        V::Int::select(closer, to[1], at[1]),
                    ];
                    least = V::select(closer, there, least);
                }
            }
            self.consider(near, at, lower);
            // Along a diagonal the distance has one minimum inside the square at most, and perhaps
            // another at the border.
            let across = V::Int::select(step[0].lt(0), at[0], last - at[0]);
            let room = across.min((last - at[1].abs()).shr_arithmetic(1));
            self.consider(near, [at[0] + step[0] * room, at[1] + step[1] * room], lower);
        }
    }

    #[inline(always)]
    fn distance_squared(&self, [column, row]: [V::Int; 2], lower: V::Mask, v: Vec3<V>) -> V {
        self.chart.vector(&Point { column, row, lower }).distance_squared(v)
    }

    /// Considers the points outside the disk of the other hemisphere, which is the `lower` one.
    #[inline(always)]
    fn outside(&mut self, v: Vec3<V>, lower: V::Mask) {
        let Scale { max, float: edge, inverse, .. } = self.chart.scale;
        let ([column, row], disk) = self.chart.params(v, true);
        let u = column + column - edge;
        let reachable = V::splat(-0.2).lt(disk.two_minus_r2);
        if !reachable.any() {
            return;
        }
        let limit = edge + 4.0;
        let beside = u.abs().le(limit) & row.abs().le(limit);
        self.around(beside, [column, row], lower);
        // Towards the corners cells grow long across the radius: follow the parallel of v from
        // column to column.
        let rr = (V::splat(1.0) - disk.one_minus_r2) * edge * edge;
        let inside = sqrt((-disk.one_minus_r2).max(0.0)) * edge;
        let start = u.abs().max(inside).min(edge).negate_where_negative(u);
        let start = ((start + edge) * 0.5).round_int();
        let mut open = reachable;
        let mut ends = [start; 2];
        while open.any() {
            let mut any_open = V::Mask::splat(false);
            for column in ends {
                let exists = V::Int::splat(-1).lt(column) & column.lt(max + 1);
                let u = V::from_int(self.chart.u_of::<V>(column));
                let across = sqrt((rr - u * u).max(0.0)).negate_where_negative(row);
                let place = DiskPoint { x: u * inverse, y: across * inverse, ..disk };
                let there = self.chart.projection.unproject(place);
                let there = Vec3 { z: V::select(lower, -there.z, there.z), ..there };
                let near = there.distance_squared(v).le(self.closest.distance_squared() * 4.0);
                let counts = open & exists & near;
                any_open = any_open | counts;
                if counts.any() {
                    let first = across.floor().round_int() - 1;
                    self.window(counts, [column, first], [1, 4], lower);
                }
            }
            open = open & any_open;
            ends = [ends[0] + 1, ends[1] - 1];
        }
    }
}
