//! Stretches of the unit disk to a square.

use super::projection::DiskPoint;
use crate::simd::math::{atan2_half_turns, inv_sqrt, sin_cos_of_half, sqrt};
use crate::simd::{Simd, SimdInt, map2};

/// From the unit disk to the square from -1 to 1.
#[derive(Clone, Copy)]
pub(crate) enum Stretch {
    /// None: the disk stays a disk, so that the square has corners outside.
    Plain,
    /// Circles to squares.
    Concentric,
    /// Nowell's ellipses.
    Ellipse,
}

/// The `count` integers from `before` below floor(place).
#[derive(Clone, Copy)]
pub(super) struct Span {
    pub(super) before: i32,
    pub(super) count: i32,
}

impl Stretch {
    /// Whether the square has corners outside the disk.
    #[inline(always)]
    pub(super) const fn has_corners(self) -> bool {
        matches!(self, Stretch::Plain)
    }

    /// Whether cells are sheared towards the corners of the square, so that the nearest code can be
    /// far along a diagonal.
    #[inline(always)]
    pub(super) const fn is_sheared(self) -> bool {
        matches!(self, Stretch::Ellipse)
    }

    /// The columns and rows around a place that can hold the nearest code.
    #[inline(always)]
    pub(super) const fn window(self) -> [Span; 2] {
        match self {
            Stretch::Plain | Stretch::Concentric => {
                [Span { before: 1, count: 4 }, Span { before: 2, count: 6 }]
            }
            Stretch::Ellipse => [Span { before: 3, count: 8 }, Span { before: 4, count: 10 }],
        }
    }

    #[inline(always)]
    pub(super) fn stretch<V: Simd>(self, point: DiskPoint<V>) -> [V; 2] {
        let DiskPoint { x, y, one_minus_r2, .. } = point;
        match self {
            Stretch::Plain => [x, y],
            Stretch::Concentric => {
                let steep = x.abs().lt(y.abs());
                let (long, short) = (V::select(steep, y, x), V::select(steep, x, y));
                let r = sqrt((x * x + y * y).max(1e-30));
                let along = r * 4.0 * atan2_half_turns(short, long.abs());
                let out = r.negate_where_negative(long);
                [V::select(steep, along, out), V::select(steep, out, along)]
            }
            Stretch::Ellipse => {
                let skew = (x - y) * (x + y);
                let q = sqrt((skew * skew + one_minus_r2 * 4.0).max(0.0));
                let two = V::splat(2.0);
                [(x + x) * inv_sqrt(two + skew + q), (y + y) * inv_sqrt(two - skew + q)]
            }
        }
    }

    /// Of integers from -M to M, with x and y times sqrt(E) if `by_root_e`. Exact where D or E is zero.
    #[inline(always)]
    pub(super) fn unstretch<V: Simd>(
        self,
        square: [V::Int; 2],
        scale: Scale,
        by_root_e: bool,
    ) -> DiskPoint<V> {
        let point = match self {
            Stretch::Plain => {
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
            Stretch::Concentric => {
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
            Stretch::Ellipse => {
                let [du, dv] = map2!(square, |i| scale.one_minus_square::<V>(i));
                let [u, v] = scale.scaled::<V>(square);
                let d = du * dv;
                let e = d + 1.0;
                let factor = if by_root_e { e * 0.5 } else { V::splat(0.5) };
                // 1 - v^2 / 2 = (1 + (1 - v^2)) / 2.
                let (x, y) = (u * sqrt((dv + 1.0) * factor), v * sqrt((du + 1.0) * factor));
                return DiskPoint { x, y, one_minus_r2: d, two_minus_r2: e };
            }
        };
        if by_root_e {
            let k = sqrt(point.two_minus_r2);
            return DiskPoint { x: point.x * k, y: point.y * k, ..point };
        }
        point
    }
}

/// M, the greatest coordinate of the square.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    pub(super) max: i32,
    /// M and 1 / M.
    pub(super) float: f32,
    pub(super) inverse: f32,
    /// 1 / M^2.
    inverse_square: f32,
}

impl Scale {
    pub(super) const fn new(max: i32) -> Self {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;
    use core::f32::consts::FRAC_1_SQRT_2;

    const SCALE: Scale = Scale::new(127);

    fn point(x: f32, y: f32) -> DiskPoint<f32> {
        let rr = x * x + y * y;
        DiskPoint { x, y, one_minus_r2: 1.0 - rr, two_minus_r2: 2.0 - rr }
    }

    fn unstretch(stretch: Stretch, square: [i32; 2], by_root_e: bool) -> [f32; 4] {
        let p = stretch.unstretch::<f32>(square.map(I32x1), SCALE, by_root_e);
        [p.x, p.y, p.one_minus_r2, p.two_minus_r2]
    }

    fn assert_near<const N: usize>(values: [f32; N], expected: [f32; N]) {
        let off = values.into_iter().zip(expected).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f32::max) < 2e-6, "{values:?}");
    }

    #[test]
    fn circles_become_squares() {
        // r = 1/2 at 0, 30, 45, 60 and 180 degrees: 4 / pi times 30 degrees is 2/3.
        let [sin, cos] = [0.25, 0.433_012_7];
        for ((x, y), square) in [
            ((0.5, 0.0), [0.5, 0.0]),
            ((cos, sin), [0.5, 1.0 / 3.0]),
            ((sin, cos), [1.0 / 3.0, 0.5]),
            ((-cos, sin), [-0.5, 1.0 / 3.0]),
            ((sin, -cos), [1.0 / 3.0, -0.5]),
        ] {
            assert_near(Stretch::Concentric.stretch(point(x, y)), square);
            assert_near(Stretch::Plain.stretch(point(x, y)), [x, y]);
        }
    }

    #[test]
    fn ellipses_are_those_of_nowell() {
        // u = v = 1/2: X = Y = 0.5 sqrt(1 - 1/8). u = 1, v = 1/2: X = sqrt(1 - 1/8), Y = 0.5 sqrt(1/2).
        for ((x, y), square) in [
            ((0.467_707_2, 0.467_707_2), [0.5, 0.5]),
            ((0.935_414_3, -0.353_553_4), [1.0, -0.5]),
            ((0.0, -0.3), [0.0, -0.3]),
        ] {
            assert_near(Stretch::Ellipse.stretch(point(x, y)), square);
        }
    }

    #[test]
    fn corners_of_the_square_are_on_the_rim() {
        for stretch in [Stretch::Concentric, Stretch::Ellipse] {
            let [x, y, d, e] = unstretch(stretch, [127, -127], false);
            assert_near([x, y], [FRAC_1_SQRT_2, -FRAC_1_SQRT_2]);
            assert_eq!([d, e], [0.0, 1.0]);
        }
        assert_eq!(unstretch(Stretch::Plain, [127, -127], false), [1.0, -1.0, -1.0, 0.0]);
    }

    #[test]
    fn stretching_leads_back() {
        for stretch in [Stretch::Plain, Stretch::Concentric, Stretch::Ellipse] {
            for [u, v] in [[64, 21], [-21, 64], [127, 3], [-90, -89], [1, 0]] {
                let [x, y, d, e] = unstretch(stretch, [u, v], false);
                let back = stretch.stretch(DiskPoint { x, y, one_minus_r2: d, two_minus_r2: e });
                assert_near(back, [u as f32 / 127.0, v as f32 / 127.0]);
                assert_near([d, e], [1.0 - x * x - y * y, 2.0 - x * x - y * y]);
            }
        }
    }

    #[test]
    fn the_root_of_e_is_a_factor_if_asked_for() {
        for stretch in [Stretch::Plain, Stretch::Concentric, Stretch::Ellipse] {
            let [x, y, d, e] = unstretch(stretch, [64, -21], false);
            let k = e.sqrt();
            assert_near(unstretch(stretch, [64, -21], true), [x * k, y * k, d, e]);
        }
    }
}
