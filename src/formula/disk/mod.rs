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
//! Projection and stretch exchange (X, Y), D = 1 - X^2 - Y^2 and E = 2 - X^2 - Y^2, each known to
//! full precision where it is small: D near the rim, E near the square's corners, which are eqarea's
//! other pole. With D the ellipse's inverse is well conditioned at the corners of the square:
//!
//! ```text
//! q^2 = (2 + X^2 - Y^2)^2 - 8 X^2 = 4 D + (X^2 - Y^2)^2;  u = 2 X / sqrt(2 + X^2 - Y^2 + q), v = 2 Y / sqrt(2 - X^2 + Y^2 + q)
//! ```
//!
//! Canonical: a point of the equator belongs to the upper hemisphere; one that is in both
//! squares, as eight do in plain eqdist20 and 24, to its own, and so do the few of the plain 32-bit
//! formats whose vectors in f32 are the same; a pole in a corner of plain eqarea is the one with u > 0
//! and v > 0. Of the axes, +-X survive exactly, and +-Z where they are a corner.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; concentric: Shirley and Chiu, "A Low Distortion Map Between Disk and Square", 1997;
//! ellipse: Nowell, "Mapping a Square to a Circle", 2005.

mod projection;
mod search;
mod stretch;

pub(crate) use projection::Projection;
pub(crate) use stretch::Stretch;

use super::octant_table::octant_kernels;
use super::support::bits::Pair;
use super::support::sign::{negate_if, not_if};
use super::{Formula, Symmetric, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::{Simd, SimdInt, SimdMask, Use, Vec3, map2};
use projection::DiskPoint;
use stretch::Scale;

/// A disk projection, stretched.
#[derive(Clone, Copy)]
pub(crate) struct Disk {
    pair: Pair,
    chart: Chart,
}

/// The square of a projection and a stretch, with M columns to each side of the first.
#[derive(Clone, Copy)]
struct Chart {
    projection: Projection,
    stretch: Stretch,
    scale: Scale,
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

impl Chart {
    /// Column and row of a unit vector in the chart of its own hemisphere or, `past` the equator, in
    /// the other; and the same point of the disk.
    #[inline(always)]
    fn params<V: Simd>(self, v: Vec3<V>, past: bool) -> ([V; 2], DiskPoint<V>) {
        let z = if past { -v.z.abs() } else { v.z.abs() };
        let needs_d = past || matches!(self.stretch, Stretch::Ellipse);
        let disk = self.projection.project(Vec3 { z, ..v }, past, needs_d);
        let [u, v] = self.stretch.stretch(disk);
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
        let has_corners = self.stretch.has_corners();
        let equator = if has_corners { (u * u + v * v).eq(max * max) } else { on_u | on_v };
        let upper = !point.lower | equator;
        let (mut column, mut row) = (point.column, v);
        if has_corners && matches!(self.projection, Projection::EqArea) {
            let pole = on_u & on_v;
            (column, row) = (V::Int::select(pole, max, column), V::Int::select(pole, max, row));
        }
        [V::Int::select(upper, column, -column), row]
    }

    /// Whether a point past the equator also is in the chart of its own hemisphere; and the column and
    /// row there.
    #[inline(always)]
    fn duplicate_of<V: Simd>(self, point: &Point<V>) -> (V::Mask, [V::Int; 2]) {
        let outer = [self.u_of::<V>(point.column), point.row];
        let (is_duplicate, [u, row]) = self.projection.duplicate_of::<V>(outer, self.scale.max);
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
        let v = if matches!(self.projection, Projection::EqArea) {
            let DiskPoint { x, y, one_minus_r2, .. } =
                self.stretch.unstretch::<V>(square, self.scale, true);
            // Its length is 1 up to the rounding of the roots.
            let v = Vec3::new(x, y, one_minus_r2);
            v * (V::splat(1.5) - v.length_squared() * 0.5)
        } else {
            self.projection.unproject(self.stretch.unstretch::<V>(square, self.scale, false))
        };
        Vec3 { z: V::select(point.lower, -v.z, v.z), ..v }
    }
}

impl Disk {
    pub(crate) const fn new(projection: Projection, stretch: Stretch, bits: u32) -> Self {
        let pair = Pair::new(bits);
        Disk { pair, chart: Chart { projection, stretch, scale: Scale::new(pair.snorm_max()) } }
    }

    #[inline(always)]
    fn point<V: Simd>(self, code: V::Int) -> Point<V> {
        let [column, row] = self.pair.unpack_snorm::<V>(code);
        Point { column: column.abs(), row, lower: column.lt(0) }
    }

    #[inline(always)]
    fn canonical_code<V: Simd>(self, point: Point<V>) -> V::Int {
        let point =
            if self.chart.stretch.has_corners() { self.chart.in_own_chart(point) } else { point };
        self.pair.pack_snorm::<V>(self.chart.snorms(&point))
    }

    /// Half the columns, M being odd, and the rows from 0.
    pub(crate) const fn points_per_octant(self) -> usize {
        let max = self.chart.scale.max as usize;
        max.div_ceil(2) * (max + 1)
    }
}

impl Formula for Disk {
    type Shape = Word;
    const PRECISE_USE: Use = Use::Rare;

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
        if !self.chart.stretch.has_corners() {
            return mirrored;
        }
        let missing = no_column & !row.eq(0);
        if !missing.any() {
            return mirrored;
        }
        V::Int::select(missing, self.mirror_decoded::<V>(code, flips), mirrored)
    }
}

impl Symmetric for Disk {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let max = self.chart.scale.max;
        let [column, row] = self.pair.unpack_snorm::<V>(code);
        let u = self.chart.u_of::<V>(column.abs());
        let index = u.abs().shr_logical(1) * (max + 1) + row.abs();
        (index, Vec3::new(u.lt(0), row.lt(0), column.lt(0)))
    }
}

kernels!(Disk: Words);
octant_kernels!(Disk);

#[cfg(test)]
mod tests {
    use super::Projection::{EqArea, EqDist, Stereo};
    use super::Stretch::{Concentric, Ellipse, Plain};
    use super::*;
    use crate::formula::testing::{assert_nearest, spiral};

    const PROJECTIONS: [Projection; 3] = [Stereo, EqArea, EqDist];
    const STRETCHES: [Stretch; 3] = [Plain, Concentric, Ellipse];

    fn mirror(disk: Disk, code: i32, flips: [bool; 3]) -> i32 {
        disk.mirror::<f32>(code.into(), flips).0
    }

    #[test]
    fn columns_tell_the_hemisphere() {
        // z = 0.8: k is 1 / 1.8, 1 / sqrt(1.8), and 2 acos(0.8) / (0.6 pi) = 0.682776. So (X, Y) is
        // (0.26667, 0.2), (0.35777, 0.26833) or (0.32773, 0.24580): column 63.5 (1 + X), row 127 Y.
        let v = Vec3::new(0.48f32, 0.36, 0.8);
        for (projection, upper, lower) in
            [(Stereo, 0x1950, 0x19B0), (EqArea, 0x2256, 0x22AA), (EqDist, 0x1F54, 0x1FAC)]
        {
            let disk = Disk::new(projection, Plain, 16);
            assert_eq!([disk.encode(v).0, disk.encode_precise(v).0], [upper; 2]);
            assert_eq!(disk.encode(Vec3 { z: -0.8, ..v }).0, lower);
        }
    }

    #[test]
    fn stretches_fill_the_square() {
        let v = Vec3::new(0.48f32, 0.36, 0.8);
        // r = 1/3 and atan(3/4) 4 / pi = 0.81933: (0.33333, 0.27311).
        assert_eq!(Disk::new(Stereo, Concentric, 16).encode(v).0, 0x2355);
        // u = 0.269478 and v = 0.203733 have u sqrt(1 - v^2 / 2) = 0.26667 and v sqrt(1 - u^2 / 2) = 0.2.
        assert_eq!(Disk::new(Stereo, Ellipse, 16).encode(v).0, 0x1A51);
    }

    #[test]
    fn promised_axes_survive() {
        for projection in PROJECTIONS {
            for stretch in STRETCHES {
                let disk = Disk::new(projection, stretch, 16);
                for (x, code) in [(1.0f32, 0x007F), (-1.0, 0x0000)] {
                    let axis = Vec3::new(x, 0.0, 0.0);
                    assert_eq!([disk.encode(axis).0, disk.encode_precise(axis).0], [code; 2]);
                    assert_eq!(disk.decode::<f32>(code.into()), axis);
                }
            }
        }
    }

    #[test]
    fn the_corners_of_plain_equal_area_are_the_other_pole() {
        let disk = Disk::new(EqArea, Plain, 16);
        for (z, code) in [(-1.0f32, 0x7F7F), (1.0, 0x7F81)] {
            let pole = Vec3::new(0.0, 0.0, z);
            assert_eq!(disk.encode_precise(pole).0, code);
            assert_eq!(disk.decode::<f32>(code.into()), pole);
            assert_eq!(mirror(disk, code, [false, false, true]), code ^ 0xFE);
        }
        // Column 0 is u = -1, and a row of -127 is v = -1.
        assert_eq!(
            [0x7F00, 0x8100, 0x817F, 0x8181].map(|code| mirror(disk, code, [false; 3])),
            [0x7F7F, 0x7F7F, 0x7F7F, 0x7F81]
        );
    }

    #[test]
    fn the_equator_is_upper() {
        for projection in PROJECTIONS {
            for stretch in STRETCHES {
                let disk = Disk::new(projection, stretch, 16);
                // Column -127 and -128, which reads as -127.
                assert_eq!(
                    [0x0081, 0x0080].map(|code| mirror(disk, code, [false; 3])),
                    [0x007F; 2]
                );
            }
            // With stretches all of the square's border, as row -127 of column -80.
            let disk = Disk::new(projection, Concentric, 16);
            assert_eq!(mirror(disk, 0x81B0, [false; 3]), 0x8150);
            assert_eq!(mirror(disk, 0x82B0, [false; 3]), 0x82B0);
        }
    }

    #[test]
    fn corners_of_the_plain_square_are_past_the_equator() {
        // X = Y = 1: stereo (2 X, 2 Y, 1 - 2) / 3.
        let v = Disk::new(Stereo, Plain, 16).decode::<f32>(0x7F7F.into());
        assert!(v.distance_squared(Vec3::new(2.0, 2.0, -1.0) * (1.0 / 3.0)) < 1e-12, "{v:?}");
    }

    #[test]
    fn a_point_in_both_squares_belongs_to_its_own() {
        // Column 503 is u = 495; with v = 432 r = 657. Times (2 * 511 - 657) / 657 = 5/9 it is (275, 240),
        // and u = 275 is column 393.
        let disk = Disk::new(EqDist, Plain, 20);
        let [there, own] = [432 << 10 | (1024 - 503), 240 << 10 | 393];
        assert_eq!(mirror(disk, there, [false; 3]), own);
        let [v, w] = [there, own].map(|code| disk.decode::<f32>(code.into()));
        assert!(v.distance_squared(w) < 1e-12, "{v:?}");
        assert_eq!(disk.encode_precise(v).0, own);
    }

    #[test]
    fn mirror_images_count_from_the_other_end() {
        for stretch in STRETCHES {
            let disk = Disk::new(Stereo, stretch, 16);
            for (flips, code) in [
                ([true, false, false], 0x192F),
                ([false, true, false], 0xE750),
                ([false, false, true], 0x19B0),
                ([true, true, true], 0xE7D1),
            ] {
                assert_eq!(mirror(disk, 0x1950, flips), code);
            }
        }
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        for (projection, stretch) in PROJECTIONS.into_iter().flat_map(|p| STRETCHES.map(|s| (p, s)))
        {
            assert_nearest(Disk::new(projection, stretch, 10), 1024, spiral(20));
        }
    }
}
