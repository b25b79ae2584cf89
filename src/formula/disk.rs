//! Disk projections: each hemisphere projected onto the unit disk, the disk stretched to a square,
//! the hemisphere's sign packed into one parameter.
//!
//! ```text
//! project    (X, Y) = k (x, y)     stereo   k = 1 / (1 + |z|)
//!                                  eqarea   k = 1 / sqrt(1 + |z|)
//!                                  eqdist   k = 2 acos|z| / (pi sqrt(1 - z^2))
//! stretch    plain       (u, v) = (X, Y)
//!            concentric  r = |(X, Y)|;  u = sgn(X) r, v = r (4 / pi) atan2(Y, |X|)  where |X| >= |Y|, else swapped
//!            ellipse     X = u sqrt(1 - v^2 / 2), Y = v sqrt(1 - u^2 / 2)
//! pack       U = sgn(z) (u / 2 + 1 / 2);  code = snorm(U), snorm(v)
//! ```
//!
//! So |U| M, from 0 to M = 2^(BITS/2 - 1) - 1, counts the columns of one hemisphere and v has twice
//! as many rows. Plain uses the disk alone; its codes outside decode past the equator, and the
//! precise encoder uses them.
//!
//! Between projection and stretch stand (X, Y), D = 1 - X^2 - Y^2 and E = 2 - X^2 - Y^2, each known to
//! full precision where it is small: D near the rim, E near the square's corners, which are eqarea's
//! other pole. With D the ellipse's inverse is well conditioned at the corners of the square:
//!
//! ```text
//! q^2 = (2 + X^2 - Y^2)^2 - 8 X^2 = 4 D + (X^2 - Y^2)^2;  u = 2 X / sqrt(2 + X^2 - Y^2 + q), v = 2 Y / sqrt(2 - X^2 + Y^2 + q)
//! ```
//!
//! Canonical: a point of the equator belongs to the upper hemisphere; one that stands in both
//! squares, as eight do in plain eqdist20 and 24, to its own, and so do the few of the plain 32-bit
//! formats whose vectors in f32 are the same; a pole in a corner of plain eqarea is the one with u > 0
//! and v > 0. Of the axes, +-X survive exactly, and +-Z where they are a corner.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; concentric: Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997;
//! ellipse: Nowell, "Mapping a Square to a Circle", 2005.

use core::marker::PhantomData;

use super::support::bits::Pair;
use super::support::closest::Closest;
use super::support::sign::{negate_if, not_if};
use super::{Formula, Symmetric, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{atan2_half_turns, inv_sqrt, sin_cos_of_half, sin_cos_of_one, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, Vec3, map2};

/// A disk projection `P`, stretched by `S`.
#[derive(Clone, Copy)]
pub(crate) struct Disk<P, S> {
    pair: Pair,
    chart: Chart<P, S>,
}

/// A point of the disk or, past the equator, outside it.
#[derive(Clone, Copy)]
pub(crate) struct DiskPoint<V> {
    x: V,
    y: V,
    /// D = 1 - x^2 - y^2.
    one_minus_r2: V,
    /// E = 2 - x^2 - y^2.
    two_minus_r2: V,
}

/// From a hemisphere, whose pole is z = 1, to the unit disk.
pub(crate) trait Projection: Copy + Send + Sync + 'static {
    /// Whether x^2 + y^2 = 2, the corners of the square, is the other pole.
    const POLE_IN_CORNERS: bool = false;

    /// Of a unit vector with z >= 0 or, if it is to be seen `past` the equator, z <= 0.
    fn to_disk<V: Simd>(v: Vec3<V>, past: bool) -> DiskPoint<V>;
    /// x^2 + y^2 may be up to 2.
    fn from_disk<V: Simd>(point: DiskPoint<V>) -> Vec3<V>;
    /// Of a point of the square whose sides are stretched by `S`.
    #[inline(always)]
    fn from_square<S: Stretch, V: Simd>(square: [V::Int; 2], scale: Scale) -> Vec3<V> {
        Self::from_disk(S::from_square::<V>(square, scale))
    }
    /// Whether (u, v) / M, outside the disk, has the same direction as a point inside that of the
    /// other hemisphere; and that point.
    #[inline(always)]
    fn duplicate_of<V: Simd>(outer: [V::Int; 2], _max: i32) -> (V::Mask, [V::Int; 2]) {
        (V::Mask::splat(false), outer)
    }
}

/// The `count` integers from `before` below floor(place).
#[derive(Clone, Copy)]
pub(crate) struct Span {
    before: i32,
    count: i32,
}

/// From the unit disk to the square from -1 to 1.
pub(crate) trait Stretch: Copy + Send + Sync + 'static {
    /// Whether the disk stays a disk, so that the square has corners outside.
    const CORNERS: bool;
    /// The columns and rows around a place that can hold the nearest code.
    const WINDOW: [Span; 2];
    /// Whether cells are sheared towards the corners of the square, so that the nearest code can be
    /// far along a diagonal.
    const SHEARED: bool = false;

    fn to_square<V: Simd>(point: DiskPoint<V>) -> [V; 2];
    /// Of integers from -M to M. Exact where D or E is zero.
    fn from_square<V: Simd>(square: [V::Int; 2], scale: Scale) -> DiskPoint<V>;
    /// The same with x and y times sqrt(E).
    #[inline(always)]
    fn from_square_by_root_e<V: Simd>(square: [V::Int; 2], scale: Scale) -> DiskPoint<V> {
        let point = Self::from_square::<V>(square, scale);
        let k = sqrt(point.two_minus_r2);
        DiskPoint { x: point.x * k, y: point.y * k, ..point }
    }
}

/// M, the greatest coordinate of the square.
#[derive(Clone, Copy)]
pub(crate) struct Scale {
    max: i32,
    /// M and 1 / M.
    float: f32,
    inverse: f32,
    /// 1 / M^2.
    inverse_square: f32,
}

impl Scale {
    const fn new(max: i32) -> Self {
        Scale {
            max,
            float: max as f32,
            inverse: 1.0 / max as f32,
            inverse_square: (1.0 / (max as f64 * max as f64)) as f32,
        }
    }

    /// Coordinates from -1 to 1.
    #[inline(always)]
    fn scaled<V: Simd>(self, square: [V::Int; 2]) -> [V; 2] {
        map2!(square, |i| V::from_int(i) * self.inverse)
    }

    /// 1 - (i / M)^2, exact where it is zero.
    #[inline(always)]
    fn one_minus_square<V: Simd>(self, i: V::Int) -> V {
        let max = V::Int::splat(self.max);
        (V::from_int(max - i) * self.inverse) * (V::from_int(max + i) * self.inverse)
    }
}

/// 1 + z of a unit vector; past the equator without cancellation, and at least 1e-30.
#[inline(always)]
fn one_plus_z<V: Simd>(Vec3 { x, y, z }: Vec3<V>, past: bool) -> V {
    if past { (x * x + y * y).max(1e-30) / (V::splat(1.0) - z) } else { z + 1.0 }
}

/// Stereographic.
#[derive(Clone, Copy)]
pub(crate) struct Stereo;

impl Projection for Stereo {
    #[inline(always)]
    fn to_disk<V: Simd>(v: Vec3<V>, past: bool) -> DiskPoint<V> {
        let k = V::splat(1.0) / one_plus_z(v, past);
        let d = (v.z + v.z) * k;
        DiskPoint { x: v.x * k, y: v.y * k, one_minus_r2: d, two_minus_r2: d + 1.0 }
    }
    #[inline(always)]
    fn from_disk<V: Simd>(DiskPoint { x, y, one_minus_r2, .. }: DiskPoint<V>) -> Vec3<V> {
        Vec3::new(x + x, y + y, one_minus_r2).normalize()
    }
}

/// Lambert's azimuthal equal-area.
#[derive(Clone, Copy)]
pub(crate) struct EqArea;

impl Projection for EqArea {
    const POLE_IN_CORNERS: bool = true;

    #[inline(always)]
    fn to_disk<V: Simd>(v: Vec3<V>, past: bool) -> DiskPoint<V> {
        let e = one_plus_z(v, past);
        let k = inv_sqrt(e);
        DiskPoint { x: v.x * k, y: v.y * k, one_minus_r2: v.z, two_minus_r2: e }
    }
    #[inline(always)]
    fn from_disk<V: Simd>(point: DiskPoint<V>) -> Vec3<V> {
        let k = sqrt(point.two_minus_r2);
        Vec3::new(point.x * k, point.y * k, point.one_minus_r2).normalize()
    }
    #[inline(always)]
    fn from_square<S: Stretch, V: Simd>(square: [V::Int; 2], scale: Scale) -> Vec3<V> {
        let DiskPoint { x, y, one_minus_r2, .. } = S::from_square_by_root_e::<V>(square, scale);
        // Its length is 1 up to the rounding of the roots.
        let v = Vec3::new(x, y, one_minus_r2);
        v * (V::splat(1.5) - v.length_squared() * 0.5)
    }
}

/// Azimuthal equidistant.
#[derive(Clone, Copy)]
pub(crate) struct EqDist;

impl Projection for EqDist {
    #[inline(always)]
    fn to_disk<V: Simd>(Vec3 { x, y, z }: Vec3<V>, _: bool) -> DiskPoint<V> {
        let hh = (x * x + y * y).max(1e-30);
        let per_h = inv_sqrt(hh);
        let h = hh * per_h;
        let r = atan2_half_turns(h, z);
        // 1 - r, from the equator's side: there it is small.
        let short = atan2_half_turns(z, h);
        let (r, short) = (r + r, short + short);
        let k = r * per_h;
        let d = short * (r + 1.0);
        DiskPoint { x: x * k, y: y * k, one_minus_r2: d, two_minus_r2: d + 1.0 }
    }
    #[inline(always)]
    fn from_disk<V: Simd>(DiskPoint { x, y, one_minus_r2, .. }: DiskPoint<V>) -> Vec3<V> {
        let rr = (x * x + y * y).max(1e-30);
        let per_r = inv_sqrt(rr);
        // The angle above the equator is 1 - r quarter turns, and 1 - r = D / (1 + r).
        let short = one_minus_r2 / (rr * per_r + 1.0);
        let (sin, cos) = sin_cos_of_one(short);
        let k = cos * per_r;
        Vec3::new(x * k, y * k, sin)
    }
    /// (u, v) at the distance r is the direction of (2 M - r) / r times (u, v): an integer point if r
    /// is an integer and divides the product.
    #[inline(always)]
    fn duplicate_of<V: Simd>(outer: [V::Int; 2], max: i32) -> (V::Mask, [V::Int; 2]) {
        let [u, v] = outer;
        let rr = u * u + v * v;
        let r = sqrt(V::from_int(rr)).round_int();
        let other = V::Int::splat(2 * max) - r;
        let ratio = V::from_int(other) / V::from_int(r.max(1));
        let inner = map2!(outer, |c| (V::from_int(c) * ratio).round_int());
        let u_whole = (inner[0] * r).eq(u * other);
        let v_whole = (inner[1] * r).eq(v * other);
        // A column's u is odd, as M is.
        let column = inner[0].low_bits(1).eq(1);
        ((r * r).eq(rr) & V::Int::splat(max).lt(r) & u_whole & v_whole & column, inner)
    }
}

/// No stretch.
#[derive(Clone, Copy)]
pub(crate) struct Unstretched;

impl Stretch for Unstretched {
    const CORNERS: bool = true;
    const WINDOW: [Span; 2] = [Span { before: 1, count: 4 }, Span { before: 2, count: 6 }];

    #[inline(always)]
    fn to_square<V: Simd>(DiskPoint { x, y, .. }: DiskPoint<V>) -> [V; 2] {
        [x, y]
    }
    #[inline(always)]
    fn from_square<V: Simd>(square: [V::Int; 2], scale: Scale) -> DiskPoint<V> {
        let [u, v] = square;
        let mm = scale.max * scale.max;
        let [x, y] = scale.scaled::<V>(square);
        let d = V::Int::splat(mm) - u * u - v * v;
        DiskPoint {
            x,
            y,
            one_minus_r2: V::from_int(d) * scale.inverse_square,
            two_minus_r2: V::from_int(d + mm) * scale.inverse_square,
        }
    }
}

/// Circles to squares.
#[derive(Clone, Copy)]
pub(crate) struct Concentric;

impl Stretch for Concentric {
    const CORNERS: bool = false;
    const WINDOW: [Span; 2] = [Span { before: 1, count: 4 }, Span { before: 2, count: 6 }];

    #[inline(always)]
    fn to_square<V: Simd>(DiskPoint { x, y, .. }: DiskPoint<V>) -> [V; 2] {
        let steep = x.abs().lt(y.abs());
        let (long, short) = (V::select(steep, y, x), V::select(steep, x, y));
        let r = sqrt((x * x + y * y).max(1e-30));
        let along = r * 4.0 * atan2_half_turns(short, long.abs());
        let out = r.negate_where_negative(long);
        [V::select(steep, along, out), V::select(steep, out, along)]
    }
    #[inline(always)]
    fn from_square<V: Simd>(square: [V::Int; 2], scale: Scale) -> DiskPoint<V> {
        let [u, v] = scale.scaled::<V>(square);
        let steep = u.abs().lt(v.abs());
        let (out, along) = (V::select(steep, v, u), V::select(steep, u, v));
        let (sin, cos) = sin_cos_of_half(along * 0.5 / out);
        let (long, short) = (out * cos, out * sin);
        let d = scale.one_minus_square::<V>(square[0].abs().max(square[1].abs()));
        DiskPoint {
            x: V::select(steep, short, long),
            y: V::select(steep, long, short),
            one_minus_r2: d,
            two_minus_r2: d + 1.0,
        }
    }
}

/// Nowell's ellipses.
#[derive(Clone, Copy)]
pub(crate) struct Ellipse;

impl Stretch for Ellipse {
    const CORNERS: bool = false;
    const WINDOW: [Span; 2] = [Span { before: 3, count: 8 }, Span { before: 4, count: 10 }];
    const SHEARED: bool = true;

    #[inline(always)]
    fn to_square<V: Simd>(DiskPoint { x, y, one_minus_r2, .. }: DiskPoint<V>) -> [V; 2] {
        let skew = (x - y) * (x + y);
        let q = sqrt((skew * skew + one_minus_r2 * 4.0).max(0.0));
        let two = V::splat(2.0);
        [(x + x) * inv_sqrt(two + skew + q), (y + y) * inv_sqrt(two - skew + q)]
    }
    #[inline(always)]
    fn from_square<V: Simd>(square: [V::Int; 2], scale: Scale) -> DiskPoint<V> {
        Self::from_square_by::<V, false>(square, scale)
    }
    #[inline(always)]
    fn from_square_by_root_e<V: Simd>(square: [V::Int; 2], scale: Scale) -> DiskPoint<V> {
        Self::from_square_by::<V, true>(square, scale)
    }
}

impl Ellipse {
    /// With x and y times sqrt(E) if `BY_ROOT_E`.
    #[inline(always)]
    fn from_square_by<V: Simd, const BY_ROOT_E: bool>(
        square: [V::Int; 2],
        scale: Scale,
    ) -> DiskPoint<V> {
        let [du, dv] = map2!(square, |i| scale.one_minus_square::<V>(i));
        let [u, v] = scale.scaled::<V>(square);
        let d = du * dv;
        let e = d + 1.0;
        let factor = if BY_ROOT_E { e * 0.5 } else { V::splat(0.5) };
        // 1 - v^2 / 2 = (1 + (1 - v^2)) / 2.
        let (x, y) = (u * sqrt((dv + 1.0) * factor), v * sqrt((du + 1.0) * factor));
        DiskPoint { x, y, one_minus_r2: d, two_minus_r2: e }
    }
}

/// A representable point: the column from 0 to M, the row from -M to M, and whether it is a lower
/// one.
struct Point<V: Simd> {
    column: V::Int,
    row: V::Int,
    lower: V::Mask,
}

impl<V: Simd> Point<V> {
    /// The nearest in range. Column 0 has no sign, so it is the upper hemisphere's.
    #[inline(always)]
    fn clamped(column: V::Int, row: V::Int, lower: V::Mask, max: i32) -> Self {
        let column = column.clamp(0, max);
        let lower = lower & V::Int::splat(0).lt(column);
        Point { column, row: row.clamp(-max, max), lower }
    }
}

/// The square of one projection and stretch, with M columns to each side of the first.
#[derive(Clone, Copy)]
struct Chart<P, S> {
    scale: Scale,
    kind: PhantomData<(P, S)>,
}

impl<P: Projection, S: Stretch> Chart<P, S> {
    /// Column and row of a unit vector in the chart of its own hemisphere or, `past` the equator, in
    /// the other; and the same point of the disk.
    #[inline(always)]
    fn params<V: Simd>(self, v: Vec3<V>, past: bool) -> ([V; 2], DiskPoint<V>) {
        let z = if past { -v.z.abs() } else { v.z.abs() };
        let disk = P::to_disk(Vec3 { z, ..v }, past);
        let [u, v] = S::to_square(disk);
        let half = 0.5 * self.scale.float;
        ([u * half + half, v * self.scale.float], disk)
    }

    /// u of a column, from -M to M.
    #[inline(always)]
    fn u_of<V: Simd>(self, column: V::Int) -> V::Int {
        column + column - self.scale.max
    }

    /// The canonical parameters.
    #[inline(always)]
    fn snorms<V: Simd>(self, point: &Point<V>) -> [V::Int; 2] {
        let max = self.scale.max;
        let (u, v) = (self.u_of::<V>(point.column), point.row);
        let (on_u, on_v) = (u.abs().eq(max), v.abs().eq(max));
        let equator = if S::CORNERS { (u * u + v * v).eq(max * max) } else { on_u | on_v };
        let upper = !point.lower | equator;
        let (mut column, mut row) = (point.column, v);
        if S::CORNERS && P::POLE_IN_CORNERS {
            let pole = on_u & on_v;
            (column, row) = (V::Int::select(pole, max, column), V::Int::select(pole, max, row));
        }
        [V::Int::select(upper, column, -column), row]
    }

    /// Whether a point past the equator also is in the chart of its own hemisphere; and the column and
    /// row there.
    #[inline(always)]
    fn duplicate_of<V: Simd>(self, point: &Point<V>) -> (V::Mask, [V::Int; 2]) {
        let u = self.u_of::<V>(point.column);
        let (is_duplicate, [u, row]) = P::duplicate_of::<V>([u, point.row], self.scale.max);
        (is_duplicate, [(u + self.scale.max).shr_arithmetic(1), row])
    }

    /// The point in the chart of its own hemisphere, of one past the equator that also is there or, in
    /// `f32`, has the very vector of one that is.
    #[inline(always)]
    fn in_own_chart<V: Simd>(self, point: Point<V>) -> Point<V> {
        let (is_duplicate, duplicate) = self.duplicate_of(&point);
        let v = self.vector(&point);
        let [column, row] = map2!(self.params(v, false).0, |p| p.round_int());
        let near = Point::<V>::clamped(column, row, !point.lower, self.scale.max);
        let w = self.vector(&near);
        let coincides = w.x.to_bits().eq(v.x.to_bits())
            & w.y.to_bits().eq(v.y.to_bits())
            & w.z.to_bits().eq(v.z.to_bits());
        let column = V::Int::select(coincides, near.column, point.column);
        let row = V::Int::select(coincides, near.row, point.row);
        let moves = is_duplicate | coincides;
        Point {
            column: V::Int::select(is_duplicate, duplicate[0], column),
            row: V::Int::select(is_duplicate, duplicate[1], row),
            lower: moves & !point.lower | !moves & point.lower,
        }
    }

    #[inline(always)]
    fn vector<V: Simd>(self, point: &Point<V>) -> Vec3<V> {
        let square = [self.u_of::<V>(point.column), point.row];
        let v = P::from_square::<S, V>(square, self.scale);
        Vec3 { z: V::select(point.lower, -v.z, v.z), ..v }
    }

    /// The parameters of the point nearest to a direction.
    #[inline(never)]
    fn nearest<V: Simd>(self, v: Vec3<V>) -> [V::Int; 2] {
        V::with_target_features(
            #[inline(always)]
            || {
                let v = unit(v);
                let lower = v.z.lt(0.0);
                let other = !lower;
                let always = V::Mask::splat(true);
                let place = self.params(v, false).0;
                // What was decoded finds its own code at once.
                let mut own = Search::new(self, v);
                own.consider(always, map2!(place, |p| p.round_int()), lower);
                if S::CORNERS {
                    let past = self.params(v, true).0;
                    own.consider(always, map2!(past, |p| p.round_int()), other);
                }
                if own.closest.is_exact() {
                    return own.params();
                }
                let mut search = Search::new(self, v);
                search.window(always, place, lower);
                if S::SHEARED {
                    search.diagonals(v, place, lower);
                }
                if S::CORNERS {
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
struct Search<P, S, V: Simd> {
    closest: Closest<V>,
    chart: Chart<P, S>,
}

impl<P: Projection, S: Stretch, V: Simd> Search<P, S, V> {
    #[inline(always)]
    fn new(chart: Chart<P, S>, v: Vec3<V>) -> Self {
        Search { closest: Closest::to_unit(v), chart }
    }

    /// The canonical parameters of the nearest.
    #[inline(always)]
    fn params(self) -> [V::Int; 2] {
        let code = self.closest.code();
        [code.shr_arithmetic(16), code.sign_extend(16)]
    }

    #[inline(always)]
    fn consider(&mut self, counts: V::Mask, place: [V::Int; 2], lower: V::Mask) {
        let point = Point::<V>::clamped(place[0], place[1], lower, self.chart.scale.max);
        let is_duplicate = self.chart.duplicate_of(&point).0;
        let counts = if S::CORNERS { counts & !is_duplicate } else { counts };
        let [column, row] = self.chart.snorms::<V>(&point);
        let code = column.shl(16) | row.low_bits(16);
        self.closest.consider_where(counts, code, self.chart.vector(&point));
    }

    /// Considers the points around a place.
    #[inline(always)]
    fn window(&mut self, counts: V::Mask, place: [V; 2], lower: V::Mask) {
        let [columns, rows] = S::WINDOW;
        let first_column = place[0].floor().round_int() - columns.before;
        let first_row = place[1].floor().round_int() - rows.before;
        for i in 0..columns.count {
            for j in 0..rows.count {
                self.consider(counts, [first_column + i, first_row + j], lower);
            }
        }
    }

    /// Considers the nearest point on each of the diagonals beside a place near a corner: along
    /// them, x and y hardly change.
    #[inline(always)]
    fn diagonals(&mut self, v: Vec3<V>, place: [V; 2], lower: V::Mask) {
        let Chart { scale: Scale { max, float, .. }, .. } = self.chart;
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
        self.window(beside, [column, row], lower);
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
                let there = P::from_disk(DiskPoint { x: u * inverse, y: across * inverse, ..disk });
                let there = Vec3 { z: V::select(lower, -there.z, there.z), ..there };
                let near = there.distance_squared(v).le(self.closest.distance_squared() * 4.0);
                let counts = open & exists & near;
                any_open = any_open | counts;
                if counts.any() {
                    let first = across.floor().round_int() - 1;
                    for j in 0..4 {
                        self.consider(counts, [column, first + j], lower);
                    }
                }
            }
            open = open & any_open;
            ends = [ends[0] + 1, ends[1] - 1];
        }
    }
}

impl<P: Projection, S: Stretch> Disk<P, S> {
    pub(crate) const fn new(bits: u32) -> Self {
        let pair = Pair::new(bits);
        Disk { pair, chart: Chart { scale: Scale::new(pair.snorm_max()), kind: PhantomData } }
    }

    #[inline(always)]
    fn point<V: Simd>(self, code: V::Int) -> Point<V> {
        let [column, row] = self.pair.unpack_snorm::<V>(code);
        Point { column: column.abs(), row, lower: column.lt(0) }
    }

    #[inline(always)]
    fn canonical_code<V: Simd>(self, point: Point<V>) -> V::Int {
        let point = if S::CORNERS { self.chart.in_own_chart(point) } else { point };
        self.pair.pack_snorm::<V>(self.chart.snorms(&point))
    }

    /// Half the columns, M being odd, and the rows from 0.
    pub(crate) const fn points_per_octant(self) -> usize {
        let max = self.chart.scale.max as usize;
        max.div_ceil(2) * (max + 1)
    }
}

impl<P: Projection, S: Stretch> Formula for Disk<P, S> {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let lower = v.z.lt(0.0);
        let [column, row] = map2!(self.chart.params(v.normalize(), false).0, |p| p.round_int());
        let point = Point::<V>::clamped(column, row, lower, self.chart.scale.max);
        self.pair.pack_snorm::<V>(self.chart.snorms(&point))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        self.pair.pack_snorm::<V>(self.chart.nearest(v))
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        self.chart.vector(&self.point::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        let Point { column, row, lower } = self.point::<V>(code);
        let column = if flips[0] { V::Int::splat(self.chart.scale.max) - column } else { column };
        let row = negate_if(row, flips[1]);
        let lower = not_if(lower, flips[2]);
        // Column 0 is the upper hemisphere's alone. Of the lower one's, what is on the equator is upper
        // too, and what is outside the disk is missing.
        let no_column = lower & column.eq(0);
        let mirrored = self.canonical_code(Point::<V> { column, row, lower: lower & !no_column });
        if !S::CORNERS {
            return mirrored;
        }
        let missing = no_column & !row.eq(0);
        if !missing.any() {
            return mirrored;
        }
        V::Int::select(missing, self.mirror_decoded::<V>(code, flips), mirrored)
    }
}

impl<P: Projection, S: Stretch> Symmetric for Disk<P, S> {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let max = self.chart.scale.max;
        let [column, row] = self.pair.unpack_snorm::<V>(code);
        let u = self.chart.u_of::<V>(column.abs());
        let index = u.abs().shr_logical(1) * (max + 1) + row.abs();
        (index, Vec3::new(u.lt(0), row.lt(0), column.lt(0)))
    }
}

kernels!(
    Disk<Stereo, Unstretched>: Words,
    Disk<Stereo, Concentric>: Words,
    Disk<Stereo, Ellipse>: Words,
    Disk<EqArea, Unstretched>: Words,
    Disk<EqArea, Concentric>: Words,
    Disk<EqArea, Ellipse>: Words,
    Disk<EqDist, Unstretched>: Words,
    Disk<EqDist, Concentric>: Words,
    Disk<EqDist, Ellipse>: Words,
);
