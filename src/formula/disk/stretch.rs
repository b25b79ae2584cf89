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
