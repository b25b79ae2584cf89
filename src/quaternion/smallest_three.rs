//! Smallest three: the component of the greatest magnitude is left out and follows from the others.
//!
//! ```text
//! encode   c = the first component of the greatest magnitude;  q = -q if q.c < 0
//!          (i, j, l) = round(sqrt(2) M (the three others) / |q|),   M = 2^(b-1) - 1
//! decode   n = 2 M^2 - i^2 - j^2 - l^2
//!          q.c = sqrt(n);   the three others = (i, j, l);   q /= sqrt(2) M
//! ```
//!
//! Codes with n < 0, whose fields are longer than a unit quaternion, are given by no encoder; they read as
//! the identity.
//!
//! Every chart reaches beyond the rotations whose greatest component it leaves out: where no component
//! exceeds sqrt(1/2), all four have codes. With T = sqrt(2) M q / |q|, what a code is off is
//! |(i, j, l) - (the three others of T)|^2 + (sqrt(n) - T.c)^2, in steps. In the chart of the greatest
//! component one of the eight roundings down or up is never off by more than about a step, and a code
//! that is nearer has no component off by a step or more: so it is one of the eight roundings of some
//! chart, and the nearest of those 32 is the nearest of all codes.
//!
//! Canonical: codes mean one rotation exactly where n is a square, so that the four integers are a
//! quaternion in other charts too; the chart of the greatest component is the one emitted, the first of
//! equals.

use core::marker::PhantomData;

use super::chart::{
    Code, Layout, LeftOut, Point, floor_and_ceil_clamped, in_chart_of_largest, largest,
};
use super::formula::Rotation;
use crate::formula::support::bits::snorm_max;
use crate::simd::math::{inv_sqrt, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, Vec3, map_vec, map4};

/// Smallest three in the layout `Y`.
#[derive(Clone, Copy)]
pub(super) struct SmallestThree<Y>(PhantomData<Y>);

impl<Y: Layout> SmallestThree<Y> {
    const SCALE: Scale = Scale::new(Y::BITS);

    pub(super) const fn new() -> Self {
        SmallestThree(PhantomData)
    }

    /// The point of a code.
    #[inline(always)]
    fn point<V: Simd>(code: Code<Y, V>) -> Point<V> {
        let point = Y::unpack::<V>(code);
        let beyond = Self::SCALE.left_out_squared::<V>(point.fields).0.lt(0.0);
        let zero = V::Int::splat(0);
        let identity = Point { fields: Vec3::new(zero, zero, zero), left_out: V::Int::splat(3) };
        Point::select(beyond, identity, point)
    }
}

/// Integers of some bits as components.
#[derive(Clone, Copy)]
struct Scale {
    /// The greatest integer M.
    max: i32,
    /// 2 M^2, the squared length of a quaternion in steps: the low 32 bits and the others from the
    /// 20th on.
    square: i32,
    square_high: i32,
    /// sqrt(2) M.
    steps: f32,
    /// 1 / (sqrt(2) M).
    step: f32,
    /// 1 / (2 M^2).
    per_square: f32,
}

impl Scale {
    const fn new(bits: u32) -> Self {
        let max = snorm_max(bits);
        let square = 2 * max as i64 * max as i64;
        Scale {
            max,
            square: square as i32,
            square_high: (square >> 20) as i32,
            steps: (max as f64 * core::f64::consts::SQRT_2) as f32,
            step: (core::f64::consts::FRAC_1_SQRT_2 / max as f64) as f32,
            per_square: 1.0 / square as f32,
        }
    }

    /// n to `f32` rounding, and its low 32 bits.
    #[inline(always)]
    fn left_out_squared<V: Simd>(self, fields: Vec3<V::Int>) -> (V, V::Int) {
        let Vec3 { x: ii, y: jj, z: ll } = map_vec!(fields, |i| i * i);
        let low = V::Int::splat(self.square) - ii - jj - ll;
        if self.max < 1 << 14 {
            return (V::from_int(low), low);
        }
        // In digits of 10 bits, i^2 = 2^20 h^2 + 2^11 h r + r^2.
        let h = map_vec!(fields, |i| i.shr_arithmetic(10));
        let r = map_vec!(fields, |i| i.low_bits(10));
        let high = V::Int::splat(self.square_high) - h.x * h.x - h.y * h.y - h.z * h.z;
        let middle = h.x * r.x + h.y * r.y + h.z * r.z;
        let rest = V::Int::splat(self.square & 0xF_FFFF) - r.x * r.x - r.y * r.y - r.z * r.z;
        // Both exact.
        let high = V::from_int(high - middle.shr_arithmetic(9));
        let rest = V::from_int(rest - middle.low_bits(9).shl(11));
        (high * 1_048_576.0 + rest, low)
    }

    /// Of the points of one rotation the one that is emitted.
    #[inline(always)]
    fn canonical_point<V: Simd>(self, point: Point<V>) -> Point<V> {
        let (n, low) = self.left_out_squared::<V>(point.fields);
        let root = sqrt(n).round_int();
        // The root is off by less than 0.3, so equal low bits mean that all are.
        let whole = (root * root).eq(low);
        let q = LeftOut::<V>::new(point.left_out).insert_int(point.fields, root);
        Point::select(whole, in_chart_of_largest::<V>(q), point)
    }

    /// The nearest of all points, canonical.
    #[inline(never)]
    fn nearest<V: Simd>(self, q: [V; 4]) -> Point<V> {
        V::with_target_features(
            #[inline(always)]
            || {
                let to_steps = inv_sqrt(length_squared(q)) * self.steps;
                let [x, y, z, w] = map4!(q, |c| c * to_steps);
                let zero = V::Int::splat(0);
                let point = Point { fields: Vec3::new(zero, zero, zero), left_out: zero };
                let mut nearest = Nearest { point, off: V::splat(f32::INFINITY) };
                let charts = [([y, z, w], x), ([x, z, w], y), ([x, y, w], z), ([x, y, z], w)];
                for (left_out, (others, main)) in (0..).zip(charts) {
                    nearest.consider(self, others.into(), main, left_out);
                }
                self.canonical_point::<V>(nearest.point)
            },
        )
    }
}

/// The nearest point so far, and its squared distance in steps.
struct Nearest<V: Simd> {
    point: Point<V>,
    off: V,
}

impl<V: Simd> Nearest<V> {
    /// Considers the eight roundings in one chart, of a quaternion in steps.
    #[inline(always)]
    fn consider(&mut self, scale: Scale, others: Vec3<V>, main: V, left_out: i32) {
        let target = map_vec!(others, |c| c.negate_where_negative(main));
        let around = map_vec!(target, |c| floor_and_ceil_clamped(c, scale.max));
        for i in around.x {
            for j in around.y {
                for l in around.z {
                    let fields = Vec3::new(i, j, l);
                    let (n, _) = scale.left_out_squared::<V>(fields);
                    let mut off = sqrt(n) - main.abs();
                    off = off * off;
                    let e = Vec3::from_int(fields) - target;
                    off = off + e.x * e.x;
                    off = off + e.y * e.y;
                    off = off + e.z * e.z;
                    let nearer = off.lt(self.off) & V::splat(0.0).le(n);
                    self.off = V::select(nearer, off, self.off);
                    let point = Point { fields, left_out: V::Int::splat(left_out) };
                    self.point = Point::select(nearer, point, self.point);
                }
            }
        }
    }
}

impl<Y: Layout> Rotation for SmallestThree<Y> {
    type Shape = Y::Shape;

    #[inline(always)]
    fn encode<V: Simd>(self, q: [V; 4]) -> Code<Y, V> {
        let left_out = largest(q);
        let (others, main) = LeftOut::<V>::new(left_out).remove(q);
        let scale = inv_sqrt(length_squared(q)) * Self::SCALE.steps;
        let signed = scale.negate_where_negative(main);
        let fields = (others * signed).round_int();
        // Rounding moves what is left out by up to 1.6 steps: only so near to another chart can the
        // code be one of that.
        let Vec3 { x: i, y: j, z: l } = fields.abs_int();
        let margin = main.abs() * scale - V::from_int(i.max(j).max(l));
        let mut point = Point { fields, left_out };
        if margin.lt(2.0).any() {
            point = Self::SCALE.canonical_point::<V>(point);
        }
        Y::pack::<V>(point)
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, q: [V; 4]) -> Code<Y, V> {
        Y::pack::<V>(Self::SCALE.nearest(q))
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: Code<Y, V>) -> [V; 4] {
        let Point { fields, left_out } = Self::point::<V>(code);
        let (n, low) = Self::SCALE.left_out_squared::<V>(fields);
        let root = sqrt(n * Self::SCALE.per_square);
        // Whole numbers of steps are exact, so that it does not matter which component is left out.
        let whole = (root * Self::SCALE.steps).round_int();
        let exact = V::from_int(whole) * Self::SCALE.step;
        let is_whole = (whole * whole).eq(low);
        let main = V::select(is_whole, exact, root);
        LeftOut::<V>::new(left_out).insert(Vec3::from_int(fields) * Self::SCALE.step, main)
    }

    #[inline(always)]
    fn canonical<V: Simd>(self, code: Code<Y, V>) -> Code<Y, V> {
        Y::pack::<V>(Self::SCALE.canonical_point::<V>(Self::point::<V>(code)))
    }
}

/// q.q.
#[inline(always)]
pub(super) fn length_squared<V: Simd>([x, y, z, w]: [V; 4]) -> V {
    x * x + y * y + z * z + w * w
}
