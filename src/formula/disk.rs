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

use crate::formula::bits::{pack_snorm2, snorm_max, unpack_snorm2};
use crate::formula::{Closest, Formula, One, Symmetric, mirror_decoded, negate_if, not_if};
use crate::simd::math::{
    atan2_half_turns, chord_squared, inv_sqrt, length_squared, normalize, sin_cos_of_half,
    sin_cos_of_one, sqrt,
};
use crate::simd::{Each, Simd, SimdInt, SimdMask, inlined};

/// A disk projection `P`, stretched by `S`, in `BITS` bits.
pub(crate) struct Disk<P, S, const BITS: u32>(PhantomData<(P, S)>);

/// A point of the disk or, past the equator, outside it.
#[derive(Clone, Copy)]
pub(crate) struct OnDisk<V> {
    x: V,
    y: V,
    /// 1 - x^2 - y^2.
    d: V,
    /// 2 - x^2 - y^2.
    e: V,
}

/// From a hemisphere, whose pole is z = 1, to the unit disk.
pub(crate) trait Projection: 'static {
    /// Whether x^2 + y^2 = 2, the corners of the square, is the other pole.
    const POLE_IN_CORNERS: bool = false;

    /// Of a unit vector with z >= 0 or, if it is to be seen `past` the equator, z <= 0.
    fn to_disk<V: Simd>(v: [V; 3], past: bool) -> OnDisk<V>;
    /// x^2 + y^2 may be up to 2.
    fn from_disk<V: Simd>(point: OnDisk<V>) -> [V; 3];
    /// Of a point of the square whose sides are stretched by `S`.
    #[inline(always)]
    fn from_square<S: Stretch, V: Simd>(square: [V::Int; 2], m: i32) -> [V; 3] {
        Self::from_disk(S::from_square::<V>(square, m))
    }
    /// Whether (u, v) / m, outside the disk, stands for the same direction as a point inside that of
    /// the other hemisphere; and that point.
    #[inline(always)]
    fn double<V: Simd>(outer: [V::Int; 2], _m: i32) -> (V::Mask, [V::Int; 2]) {
        (outer[0].lt(outer[0]), outer)
    }
}

/// `count` integers from `before` below a place, rounded down.
#[derive(Clone, Copy)]
pub(crate) struct Span {
    before: i32,
    count: i32,
}

/// From the unit disk to the square from -1 to 1.
pub(crate) trait Stretch: 'static {
    /// Whether the disk stays a disk, so that the square has corners outside.
    const CORNERS: bool;
    /// The columns and rows around a place in which the nearest code may stand.
    const WINDOW: [Span; 2];
    /// Whether cells are sheared towards the corners of the square, so that the nearest code may
    /// stand far along a diagonal.
    const SHEARED: bool = false;

    fn to_square<V: Simd>(point: OnDisk<V>) -> [V; 2];
    /// Of integers from -m to m. Exact where d or e is zero.
    fn from_square<V: Simd>(square: [V::Int; 2], m: i32) -> OnDisk<V>;
    /// The same with x and y times sqrt(e).
    #[inline(always)]
    fn from_square_by_root_e<V: Simd>(square: [V::Int; 2], m: i32) -> OnDisk<V> {
        let OnDisk { x, y, d, e } = Self::from_square(square, m);
        let k = sqrt(e);
        OnDisk { x: x * k, y: y * k, d, e }
    }
}

#[inline(always)]
fn scaled<V: Simd>(square: [V::Int; 2], m: i32) -> [V; 2] {
    square.each(|i| V::from_int(i) * V::splat(1.0 / m as f32))
}

/// 1 - (i / m)^2, exact where it is zero.
#[inline(always)]
fn one_minus_square<V: Simd>(i: V::Int, m: i32) -> V {
    let (max, scale) = (V::Int::splat(m), V::splat(1.0 / m as f32));
    (V::from_int(max - i) * scale) * (V::from_int(max + i) * scale)
}

/// 1 + z of a unit vector; past the equator without cancellation, and at least 1e-30.
#[inline(always)]
fn one_plus_z<V: Simd>([x, y, z]: [V; 3], past: bool) -> V {
    let one = V::splat(1.0);
    if past { (x * x + y * y).greater(V::splat(1e-30)) / (one - z) } else { one + z }
}

/// Stereographic.
pub(crate) struct Stereo;

impl Projection for Stereo {
    #[inline(always)]
    fn to_disk<V: Simd>([x, y, z]: [V; 3], past: bool) -> OnDisk<V> {
        let k = V::splat(1.0) / one_plus_z([x, y, z], past);
        let d = (z + z) * k;
        OnDisk { x: x * k, y: y * k, d, e: V::splat(1.0) + d }
    }
    #[inline(always)]
    fn from_disk<V: Simd>(OnDisk { x, y, d, .. }: OnDisk<V>) -> [V; 3] {
        normalize([x + x, y + y, d])
    }
}

/// Lambert's azimuthal equal-area.
pub(crate) struct EqArea;

impl Projection for EqArea {
    const POLE_IN_CORNERS: bool = true;

    #[inline(always)]
    fn to_disk<V: Simd>([x, y, z]: [V; 3], past: bool) -> OnDisk<V> {
        let e = one_plus_z([x, y, z], past);
        let k = inv_sqrt(e);
        OnDisk { x: x * k, y: y * k, d: z, e }
    }
    #[inline(always)]
    fn from_disk<V: Simd>(OnDisk { x, y, d, e }: OnDisk<V>) -> [V; 3] {
        let k = sqrt(e);
        normalize([x * k, y * k, d])
    }
    #[inline(always)]
    fn from_square<S: Stretch, V: Simd>(square: [V::Int; 2], m: i32) -> [V; 3] {
        let OnDisk { x, y, d, .. } = S::from_square_by_root_e::<V>(square, m);
        // Its length is 1 up to the rounding of the roots.
        let v = [x, y, d];
        let r = V::splat(1.5) - V::splat(0.5) * length_squared(v);
        v.each(|c| c * r)
    }
}

/// Azimuthal equidistant.
pub(crate) struct EqDist;

impl Projection for EqDist {
    #[inline(always)]
    fn to_disk<V: Simd>([x, y, z]: [V; 3], _: bool) -> OnDisk<V> {
        let hh = (x * x + y * y).greater(V::splat(1e-30));
        let per_h = inv_sqrt(hh);
        let h = hh * per_h;
        let r = atan2_half_turns(h, z);
        // 1 - r, from the equator's side: there it is small.
        let short = atan2_half_turns(z, h);
        let (r, short) = (r + r, short + short);
        let k = r * per_h;
        let d = short * (V::splat(1.0) + r);
        OnDisk { x: x * k, y: y * k, d, e: V::splat(1.0) + d }
    }
    #[inline(always)]
    fn from_disk<V: Simd>(OnDisk { x, y, d, .. }: OnDisk<V>) -> [V; 3] {
        let rr = (x * x + y * y).greater(V::splat(1e-30));
        let per_r = inv_sqrt(rr);
        // The angle above the equator is 1 - r quarter turns, and 1 - r = d / (1 + r).
        let short = d / (V::splat(1.0) + rr * per_r);
        let (sin, cos) = sin_cos_of_one(short);
        let k = cos * per_r;
        [x * k, y * k, sin]
    }
    /// (u, v) at the distance r is the direction of (2 m - r) / r times (u, v): an integer point if r
    /// is an integer and divides the product.
    #[inline(always)]
    fn double<V: Simd>(outer: [V::Int; 2], m: i32) -> (V::Mask, [V::Int; 2]) {
        let [u, v] = outer;
        let rr = u * u + v * v;
        let r = sqrt(V::from_int(rr)).round_int();
        let ratio = V::from_int(V::Int::splat(2 * m) - r) / V::from_int(r.max(V::Int::splat(1)));
        let inner = outer.each(|c| (V::from_int(c) * ratio).round_int());
        let [u_whole, v_whole] =
            [0, 1].each(|i: usize| (inner[i] * r).eq(outer[i] * (V::Int::splat(2 * m) - r)));
        // A column's u is odd, as m is.
        let column = inner[0].low(1).eq(V::Int::splat(1));
        ((r * r).eq(rr) & V::Int::splat(m).lt(r) & u_whole & v_whole & column, inner)
    }
}

/// No stretch.
pub(crate) struct Plain;

impl Stretch for Plain {
    const CORNERS: bool = true;
    const WINDOW: [Span; 2] = [Span { before: 1, count: 4 }, Span { before: 2, count: 6 }];

    #[inline(always)]
    fn to_square<V: Simd>(OnDisk { x, y, .. }: OnDisk<V>) -> [V; 2] {
        [x, y]
    }
    #[inline(always)]
    fn from_square<V: Simd>(square: [V::Int; 2], m: i32) -> OnDisk<V> {
        let [u, v] = square;
        let mm = V::Int::splat(m) * V::Int::splat(m);
        let scale = V::splat((1.0 / (m as f64 * m as f64)) as f32);
        let [x, y] = scaled::<V>(square, m);
        let d = mm - u * u - v * v;
        OnDisk { x, y, d: V::from_int(d) * scale, e: V::from_int(d + mm) * scale }
    }
}

/// Circles to squares.
pub(crate) struct Concentric;

impl Stretch for Concentric {
    const CORNERS: bool = false;
    const WINDOW: [Span; 2] = [Span { before: 1, count: 4 }, Span { before: 2, count: 6 }];

    #[inline(always)]
    fn to_square<V: Simd>(OnDisk { x, y, .. }: OnDisk<V>) -> [V; 2] {
        let steep = x.abs().lt(y.abs());
        let (long, short) = (V::select(steep, y, x), V::select(steep, x, y));
        let r = sqrt((x * x + y * y).greater(V::splat(1e-30)));
        let along = r * V::splat(4.0) * atan2_half_turns(short, long.abs());
        let out = r.negate_where_negative(long);
        [V::select(steep, along, out), V::select(steep, out, along)]
    }
    #[inline(always)]
    fn from_square<V: Simd>(square: [V::Int; 2], m: i32) -> OnDisk<V> {
        let [u, v] = scaled::<V>(square, m);
        let steep = u.abs().lt(v.abs());
        let (out, along) = (V::select(steep, v, u), V::select(steep, u, v));
        let (sin, cos) = sin_cos_of_half(V::splat(0.5) * along / out);
        let (long, short) = (out * cos, out * sin);
        let d = one_minus_square::<V>(square[0].abs().max(square[1].abs()), m);
        OnDisk {
            x: V::select(steep, short, long),
            y: V::select(steep, long, short),
            d,
            e: V::splat(1.0) + d,
        }
    }
}

/// Nowell's ellipses.
pub(crate) struct Ellipse;

impl Stretch for Ellipse {
    const CORNERS: bool = false;
    const WINDOW: [Span; 2] = [Span { before: 3, count: 8 }, Span { before: 4, count: 10 }];
    const SHEARED: bool = true;

    #[inline(always)]
    fn to_square<V: Simd>(OnDisk { x, y, d, .. }: OnDisk<V>) -> [V; 2] {
        let skew = (x - y) * (x + y);
        let q = sqrt((skew * skew + d * V::splat(4.0)).greater(V::zero()));
        let side = inlined(
            #[inline(always)]
            |c: V, sum: V| (c + c) * inv_sqrt(sum),
        );
        [side(x, V::splat(2.0) + skew + q), side(y, V::splat(2.0) - skew + q)]
    }
    #[inline(always)]
    fn from_square<V: Simd>(square: [V::Int; 2], m: i32) -> OnDisk<V> {
        Self::from_square_by(square, m, |_| V::splat(0.5))
    }
    #[inline(always)]
    fn from_square_by_root_e<V: Simd>(square: [V::Int; 2], m: i32) -> OnDisk<V> {
        Self::from_square_by(square, m, |e| e * V::splat(0.5))
    }
}

impl Ellipse {
    /// With x and y times the root of twice `factor` of e.
    #[inline(always)]
    fn from_square_by<V: Simd>(square: [V::Int; 2], m: i32, factor: impl Fn(V) -> V) -> OnDisk<V> {
        let one = V::splat(1.0);
        let [du, dv] = square.each(|i| one_minus_square::<V>(i, m));
        let [u, v] = scaled::<V>(square, m);
        let d = du * dv;
        let e = one + d;
        let factor = factor(e);
        // 1 - v^2 / 2 = (1 + (1 - v^2)) / 2.
        let side = inlined(
            #[inline(always)]
            |c: V, other: V| c * sqrt((one + other) * factor),
        );
        OnDisk { x: side(u, dv), y: side(v, du), d, e }
    }
}

/// A representable point: the column from 0 to m, the row from -m to m, and whether it is a lower
/// one.
struct Point<V: Simd> {
    column: V::Int,
    row: V::Int,
    lower: V::Mask,
}

impl<V: Simd> Point<V> {
    /// The nearest in range. Column 0 has no sign, so it is the upper hemisphere's.
    #[inline(always)]
    fn clamped(column: V::Int, row: V::Int, lower: V::Mask, max: V::Int) -> Self {
        let column = column.max(V::Int::splat(0)).min(max);
        let lower = lower & V::Int::splat(0).lt(column);
        Point { column, row: row.max(-max).min(max), lower }
    }
}

/// The square of one projection and stretch, with `m` columns to each side of the first. `m` is no
/// constant, so that all sizes share the search for the nearest point.
struct Chart<P, S>(PhantomData<(P, S)>);

impl<P: Projection, S: Stretch> Chart<P, S> {
    /// Column and row of a unit vector in the chart of its own hemisphere or, `past` the equator, in
    /// the other; and the same point of the disk.
    #[inline(always)]
    fn params<V: Simd>([x, y, z]: [V; 3], past: bool, m: i32) -> ([V; 2], OnDisk<V>) {
        let z = if past { -z.abs() } else { z.abs() };
        let disk = P::to_disk([x, y, z], past);
        let [u, v] = S::to_square(disk);
        let (max, half) = (V::splat(m as f32), V::splat(0.5 * m as f32));
        ([u * half + half, v * max], disk)
    }

    /// The canonical parameters.
    #[inline(always)]
    fn snorms<V: Simd>(point: &Point<V>, m: i32) -> [V::Int; 2] {
        let max = V::Int::splat(m);
        let (u, v) = (point.column + point.column - max, point.row);
        let (on_u, on_v) = (u.abs().eq(max), v.abs().eq(max));
        let equator = if S::CORNERS { (u * u + v * v).eq(max * max) } else { on_u | on_v };
        let upper = !point.lower | equator;
        let pole = inlined(
            #[inline(always)]
            |side| {
                if S::CORNERS && P::POLE_IN_CORNERS {
                    V::Int::select(on_u & on_v, max, side)
                } else {
                    side
                }
            },
        );
        let column = pole(point.column);
        [V::Int::select(upper, column, -column), pole(v)]
    }

    /// Whether a point past the equator also stands in the chart of its own hemisphere; and the
    /// column and row there.
    #[inline(always)]
    fn double<V: Simd>(point: &Point<V>, m: i32) -> (V::Mask, [V::Int; 2]) {
        let max = V::Int::splat(m);
        let u = point.column + point.column - max;
        let (is_double, [u, row]) = P::double::<V>([u, point.row], m);
        (is_double, [(u + max).sar(1), row])
    }

    /// The point in the chart of its own hemisphere, of one past the equator that also stands there
    /// or, in `f32`, has the very vector of one that does.
    #[inline(always)]
    fn in_own_chart<V: Simd>(point: Point<V>, m: i32) -> Point<V> {
        let (is_double, double) = Self::double(&point, m);
        let v = Self::vector(&point, m);
        let place = Self::params(v, false, m).0.each(|p| p.round_int());
        let near = Point::<V>::clamped(place[0], place[1], !point.lower, V::Int::splat(m));
        let [x, y, z] = Self::vector(&near, m);
        let same = inlined(
            #[inline(always)]
            |a: V, b: V| a.to_bits().eq(b.to_bits()),
        );
        let coincides = same(x, v[0]) & same(y, v[1]) & same(z, v[2]);
        let pick = inlined(
            #[inline(always)]
            |double, near, own| {
                V::Int::select(is_double, double, V::Int::select(coincides, near, own))
            },
        );
        let moves = is_double | coincides;
        Point {
            column: pick(double[0], near.column, point.column),
            row: pick(double[1], near.row, point.row),
            lower: moves & !point.lower | !moves & point.lower,
        }
    }

    #[inline(always)]
    fn vector<V: Simd>(point: &Point<V>, m: i32) -> [V; 3] {
        let u = point.column + point.column - V::Int::splat(m);
        let [x, y, z] = P::from_square::<S, V>([u, point.row], m);
        [x, y, V::select(point.lower, -z, z)]
    }

    /// The parameters of the point nearest to a direction.
    #[inline(never)]
    fn nearest<V: Simd>(v: [V; 3], m: i32) -> [V::Int; 2] {
        V::compiled_for(
            #[inline(always)]
            || {
                let v = unit(v);
                let lower = v[2].lt(V::zero());
                let other = !lower;
                let always = V::zero().le(V::zero());
                let place = Self::params(v, false, m).0;
                // What was decoded finds its own code at once.
                let mut own = Search::<P, S, V>::to(v, m);
                own.consider(always, place.each(|p| p.round_int()), lower);
                if S::CORNERS {
                    let past = Self::params(v, true, m).0;
                    own.consider(always, past.each(|p| p.round_int()), other);
                }
                if own.closest.is_exact() {
                    return own.params();
                }
                let mut search = Search::<P, S, V>::to(v, m);
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
fn unit<V: Simd>(v: [V; 3]) -> [V; 3] {
    // The power of two that brings the length between 0.8 and 1.7.
    let square = length_squared(v);
    let exponent = (square * V::splat(1.5)).to_bits().shr(23) - V::Int::splat(127);
    let scale = V::from_bits((V::Int::splat(127) - exponent.sar(1)).shl(23));
    let is_unit = (square * scale * scale - V::splat(1.0)).abs().lt(V::splat(1e-6));
    let k = V::select(is_unit, scale, inv_sqrt(square));
    v.each(|c| c * k)
}

/// The nearest point so far.
struct Search<P, S, V: Simd> {
    closest: Closest<V>,
    m: i32,
    chart: PhantomData<(P, S)>,
}

impl<P: Projection, S: Stretch, V: Simd> Search<P, S, V> {
    #[inline(always)]
    fn to(v: [V; 3], m: i32) -> Self {
        Search { closest: Closest::to_unit(v), m, chart: PhantomData }
    }

    /// The canonical parameters of the nearest.
    #[inline(always)]
    fn params(self) -> [V::Int; 2] {
        let code = self.closest.code();
        [code.sar(16), code.sign_extend(16)]
    }

    #[inline(always)]
    fn consider(&mut self, counts: V::Mask, place: [V::Int; 2], lower: V::Mask) {
        let point = Point::<V>::clamped(place[0], place[1], lower, V::Int::splat(self.m));
        let double = Chart::<P, S>::double(&point, self.m).0;
        let counts = if S::CORNERS { counts & !double } else { counts };
        let [column, row] = Chart::<P, S>::snorms::<V>(&point, self.m);
        let code = column.shl(16) | row.low(16);
        self.closest.consider_where(counts, code, Chart::<P, S>::vector(&point, self.m));
    }

    /// Considers the points around a place.
    #[inline(always)]
    fn window(&mut self, counts: V::Mask, place: [V; 2], lower: V::Mask) {
        let first = [0, 1]
            .each(|i: usize| place[i].floor().round_int() - V::Int::splat(S::WINDOW[i].before));
        for i in 0..S::WINDOW[0].count {
            for j in 0..S::WINDOW[1].count {
                let place = [first[0] + V::Int::splat(i), first[1] + V::Int::splat(j)];
                self.consider(counts, place, lower);
            }
        }
    }

    /// Considers the nearest point on each of the diagonals beside a place near a corner: along
    /// them, x and y hardly change.
    #[inline(always)]
    fn diagonals(&mut self, v: [V; 3], place: [V; 2], lower: V::Mask) {
        let max = V::splat(self.m as f32);
        let u = place[0] + place[0] - max;
        let near = (max * V::splat(0.75)).lt(u.abs().lesser(place[1].abs()));
        if !near.any() {
            return;
        }
        let out = inlined(
            #[inline(always)]
            |side: V| V::Int::select(side.lt(V::zero()), V::Int::splat(-1), V::Int::splat(1)),
        );
        // A column is two rows wide.
        let step = [out(u), out(place[1]) + out(place[1])];
        let [column, row] = place.each(|p| p.round_int());
        let (zero, last) = (V::Int::splat(0), V::Int::splat(self.m));
        let m = self.m;
        let distance = inlined(
            #[inline(always)]
            |[column, row]: [V::Int; 2]| {
                chord_squared(Chart::<P, S>::vector(&Point { column, row, lower }, m), v)
            },
        );
        let first = row - V::Int::splat(3);
        for beside in 0..7 {
            let row = first + V::Int::splat(beside);
            // A diagonal that would begin outside the square begins where it leaves it.
            let outside = (row.abs() - last + V::Int::splat(1)).sar(1).max(zero);
            let mut at = [column.max(zero).min(last) - step[0] * outside, row - step[1] * outside];
            let mut least = distance(at);
            for length in [64, 32, 16, 8, 4, 2, 2, 1, 1] {
                for length in [length, -length] {
                    let length = V::Int::splat(length);
                    let to = [at[0] + step[0] * length, at[1] + step[1] * length];
                    let exists = !to[0].lt(zero) & !last.lt(to[0]) & !last.lt(to[1].abs());
                    let there = distance(to);
                    let closer = exists & there.lt(least);
                    at = [0, 1].each(|i: usize| V::Int::select(closer, to[i], at[i]));
                    least = V::select(closer, there, least);
                }
            }
            self.consider(near, at, lower);
            // Along a diagonal the distance has one minimum inside the square at most, and perhaps
            // another at the border.
            let across = V::Int::select(step[0].lt(zero), at[0], last - at[0]);
            let room = across.min((last - at[1].abs()).sar(1));
            self.consider(near, [0, 1].each(|i: usize| at[i] + step[i] * room), lower);
        }
    }

    /// Considers the points outside the disk of the other hemisphere, which is the `lower` one.
    #[inline(always)]
    fn outside(&mut self, v: [V; 3], lower: V::Mask) {
        let edge = V::splat(self.m as f32);
        let ([column, row], OnDisk { d, e, .. }) = Chart::<P, S>::params(v, true, self.m);
        let u = column + column - edge;
        let reachable = V::splat(-0.2).lt(e);
        if !reachable.any() {
            return;
        }
        let limit = edge + V::splat(4.0);
        let beside = u.abs().le(limit) & row.abs().le(limit);
        self.window(beside, [column, row], lower);
        // Towards the corners cells grow long across the radius: follow the parallel of v from
        // column to column.
        let max = V::Int::splat(self.m);
        let scale = V::splat(1.0 / self.m as f32);
        let rr = (V::splat(1.0) - d) * edge * edge;
        let inside = sqrt((-d).greater(V::zero())) * edge;
        let start = u.abs().greater(inside).lesser(edge).negate_where_negative(u);
        let start = ((start + edge) * V::splat(0.5)).round_int();
        let mut open = reachable;
        let mut ends = [start; 2];
        while open.any() {
            let mut any_open = V::zero().lt(V::zero());
            for column in ends {
                let exists = V::Int::splat(-1).lt(column) & column.lt(max + V::Int::splat(1));
                let u = V::from_int(column + column - max);
                let across = sqrt((rr - u * u).greater(V::zero())).negate_where_negative(row);
                let [x, y, z] = P::from_disk(OnDisk { x: u * scale, y: across * scale, d, e });
                let there = [x, y, V::select(lower, -z, z)];
                let near =
                    chord_squared(there, v).le(self.closest.distance_squared() * V::splat(4.0));
                let counts = open & exists & near;
                any_open = any_open | counts;
                if counts.any() {
                    let first = across.floor().round_int() - V::Int::splat(1);
                    for j in 0..4 {
                        self.consider(counts, [column, first + V::Int::splat(j)], lower);
                    }
                }
            }
            open = open & any_open;
            ends = [ends[0] + V::Int::splat(1), ends[1] - V::Int::splat(1)];
        }
    }
}

impl<P: Projection, S: Stretch, const BITS: u32> Disk<P, S, BITS> {
    const M: i32 = snorm_max(BITS / 2);

    #[inline(always)]
    fn point<V: Simd>(code: V::Int) -> Point<V> {
        let [column, row] = unpack_snorm2::<BITS, V>(code);
        Point { column: column.abs(), row, lower: column.lt(V::Int::splat(0)) }
    }

    #[inline(always)]
    fn canonical_of<V: Simd>(point: Point<V>) -> V::Int {
        let point = if S::CORNERS { Chart::<P, S>::in_own_chart(point, Self::M) } else { point };
        pack_snorm2::<BITS, V>(Chart::<P, S>::snorms(&point, Self::M))
    }
}

impl<P: Projection, S: Stretch, const BITS: u32> Formula for Disk<P, S, BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        let lower = v[2].lt(V::zero());
        let ([column, row], _) = Chart::<P, S>::params(normalize(v), false, Self::M);
        let max = V::Int::splat(Self::M);
        let point = Point::<V>::clamped(column.round_int(), row.round_int(), lower, max);
        pack_snorm2::<BITS, V>(Chart::<P, S>::snorms(&point, Self::M))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        pack_snorm2::<BITS, V>(Chart::<P, S>::nearest(v, Self::M))
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        Chart::<P, S>::vector(&Self::point::<V>(code), Self::M)
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        Self::canonical_of(Self::point::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        let (max, zero) = (V::Int::splat(Self::M), V::Int::splat(0));
        let Point { column, row, lower } = Self::point::<V>(code);
        let column = if flips[0] { max - column } else { column };
        let row = negate_if(row, flips[1]);
        let lower = not_if::<V>(lower, flips[2]);
        // Column 0 is the upper hemisphere's alone. Of the lower one's, what is on the equator is upper too, and what
        // is outside the disk is missing.
        let no_column = lower & column.eq(zero);
        let mirrored = Self::canonical_of::<V>(Point { column, row, lower: lower & !no_column });
        if !S::CORNERS {
            return mirrored;
        }
        let missing = no_column & !row.eq(zero);
        if !missing.any() {
            return mirrored;
        }
        V::Int::select(missing, mirror_decoded::<Self, V>(code, flips), mirrored)
    }
}

impl<P: Projection, S: Stretch, const BITS: u32> Symmetric for Disk<P, S, BITS> {
    /// Half the columns, M being odd, and the rows from 0.
    const ENTRIES: usize = (Self::M as usize).div_ceil(2) * (Self::M as usize + 1);

    #[inline(always)]
    fn fold<V: Simd>(code: V::Int) -> (V::Int, [V::Mask; 3]) {
        let (max, zero) = (V::Int::splat(Self::M), V::Int::splat(0));
        let [column, row] = unpack_snorm2::<BITS, V>(code);
        let magnitude = column.abs();
        let u = magnitude + magnitude - max;
        let index = u.abs().shr(1) * (max + V::Int::splat(1)) + row.abs();
        (index, [u.lt(zero), row.lt(zero), column.lt(zero)])
    }
}
