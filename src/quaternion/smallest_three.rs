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

use super::Rotation;
use super::chart::{
    Code, Layout, LeftOut, Point, around_within, in_chart_of_largest, largest, select_point,
};
use crate::simd::math::{inv_sqrt, sqrt};
use crate::simd::{Each, Simd, SimdInt, SimdMask};

/// Smallest three in the layout `Y`.
pub(super) struct SmallestThree<Y>(PhantomData<Y>);

impl<Y: Layout> SmallestThree<Y> {
    /// 2 M^2, the squared length of a quaternion in steps.
    const SQUARE: i64 = 2 * Y::M as i64 * Y::M as i64;
    /// sqrt(2) M.
    const STEPS: f32 = (Y::M as f64 * core::f64::consts::SQRT_2) as f32;
    /// 1 / (sqrt(2) M).
    const STEP: f32 = (core::f64::consts::FRAC_1_SQRT_2 / Y::M as f64) as f32;

    /// n to `f32` rounding, and its low 32 bits.
    #[inline(always)]
    fn left_out_squared<V: Simd>(fields: [V::Int; 3]) -> (V, V::Int) {
        let [ii, jj, ll] = fields.each(
            #[inline(always)]
            |i| i * i,
        );
        let low = V::Int::splat(Self::SQUARE as i32) - ii - jj - ll;
        if Y::BITS <= 15 {
            return (V::from_int(low), low);
        }
        // In digits of 10 bits, i^2 = 2^20 h^2 + 2^11 h r + r^2.
        let [h, r] = [fields.each(|i| i.sar(10)), fields.each(|i| i.low(10))];
        let high =
            V::Int::splat((Self::SQUARE >> 20) as i32) - h[0] * h[0] - h[1] * h[1] - h[2] * h[2];
        let middle = h[0] * r[0] + h[1] * r[1] + h[2] * r[2];
        let rest = V::Int::splat((Self::SQUARE & 0xF_FFFF) as i32)
            - r[0] * r[0]
            - r[1] * r[1]
            - r[2] * r[2];
        // Both exact.
        let high = V::from_int(high - middle.sar(9));
        let rest = V::from_int(rest - middle.low(9).shl(11));
        (high * V::splat(1_048_576.0) + rest, low)
    }

    /// What a code stands for.
    #[inline(always)]
    fn point<V: Simd>(code: Code<Y, V>) -> Point<V> {
        let point = Y::unpack::<V>(code);
        let beyond = Self::left_out_squared::<V>(point.0).0.lt(V::zero());
        let identity = ([V::Int::splat(0); 3], V::Int::splat(3));
        select_point::<V>(beyond, identity, point)
    }

    /// Of the codes that mean one rotation the one that is emitted.
    #[inline(always)]
    fn canonical_point<V: Simd>((fields, index): Point<V>) -> Point<V> {
        let (n, low) = Self::left_out_squared::<V>(fields);
        let root = sqrt(n).round_int();
        // The root is off by less than 0.3, so equal low bits mean that all are.
        let whole = (root * root).eq(low);
        let q = LeftOut::<V>::new(index).insert(fields, root, V::Int::select);
        select_point::<V>(whole, in_chart_of_largest::<V>(q), (fields, index))
    }

    /// The nearest of all codes, canonical.
    #[inline(always)]
    fn nearest<V: Simd>(q: [V; 4]) -> Point<V> {
        let scale = inv_sqrt(length_squared(q)) * V::splat(Self::STEPS);
        let [x, y, z, w] = q.each(
            #[inline(always)]
            |c| c * scale,
        );
        let zero = V::Int::splat(0);
        let mut nearest = Nearest { point: ([zero; 3], zero), off: V::splat(f32::INFINITY) };
        nearest.consider::<Y>([y, z, w], x, 0);
        nearest.consider::<Y>([x, z, w], y, 1);
        nearest.consider::<Y>([x, y, w], z, 2);
        nearest.consider::<Y>([x, y, z], w, 3);
        Self::canonical_point::<V>(nearest.point)
    }
}

/// The nearest code so far, and how far off it is in steps, squared.
struct Nearest<V: Simd> {
    point: Point<V>,
    off: V,
}

impl<V: Simd> Nearest<V> {
    /// Considers the eight roundings in one chart, of a quaternion in steps.
    #[inline(always)]
    fn consider<Y: Layout>(&mut self, others: [V; 3], left_out: V, index: i32) {
        let target = others.each(
            #[inline(always)]
            |c| c.negate_where_negative(left_out),
        );
        let [is, js, ls] = target.each(
            #[inline(always)]
            |c| around_within(c, Y::M),
        );
        for i in is {
            for j in js {
                for l in ls {
                    let fields = [i, j, l];
                    let (n, _) = SmallestThree::<Y>::left_out_squared::<V>(fields);
                    let mut off = sqrt(n) - left_out.abs();
                    off = off * off;
                    for axis in 0..3 {
                        let e = V::from_int(fields[axis]) - target[axis];
                        off = off + e * e;
                    }
                    let nearer = off.lt(self.off) & V::zero().le(n);
                    self.off = V::select(nearer, off, self.off);
                    let point = (fields, V::Int::splat(index));
                    self.point = select_point::<V>(nearer, point, self.point);
                }
            }
        }
    }
}

impl<Y: Layout> Rotation for SmallestThree<Y> {
    type Words = Y::Words;

    #[inline(always)]
    fn encode<V: Simd>(q: [V; 4]) -> Code<Y, V> {
        let index = largest(q);
        let (others, left_out) = LeftOut::<V>::new(index).remove(q, V::select);
        let scale = inv_sqrt(length_squared(q)) * V::splat(Self::STEPS);
        let fields = others.each(
            #[inline(always)]
            |c| (c * scale.negate_where_negative(left_out)).round_int(),
        );
        // Rounding moves what is left out by up to 1.6 steps: only so near to another chart can the
        // code be one of that.
        let [i, j, l] = fields.each(
            #[inline(always)]
            |i| i.abs(),
        );
        let margin = left_out.abs() * scale - V::from_int(i.max(j).max(l));
        let mut point = (fields, index);
        if margin.lt(V::splat(2.0)).any() {
            point = Self::canonical_point::<V>(point);
        }
        Y::pack::<V>(point)
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(q: [V; 4]) -> Code<Y, V> {
        Y::pack::<V>(Self::nearest(q))
    }

    #[inline(always)]
    fn decode<V: Simd>(code: Code<Y, V>) -> [V; 4] {
        let (fields, index) = Self::point::<V>(code);
        let (n, low) = Self::left_out_squared::<V>(fields);
        let root = sqrt(n * V::splat(1.0 / Self::SQUARE as f32));
        // Whole numbers of steps are exact, so that it does not matter which component is left out.
        let whole = (root * V::splat(Self::STEPS)).round_int();
        let exact = V::from_int(whole) * V::splat(Self::STEP);
        let left_out = V::Int::select((whole * whole).eq(low), exact.to_bits(), root.to_bits());
        let others = fields.each(
            #[inline(always)]
            |i| V::from_int(i) * V::splat(Self::STEP),
        );
        LeftOut::<V>::new(index).insert(others, V::from_bits(left_out), V::select)
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: Code<Y, V>) -> Code<Y, V> {
        Y::pack::<V>(Self::canonical_point::<V>(Self::point::<V>(code)))
    }
}

/// q.q.
#[inline(always)]
pub(super) fn length_squared<V: Simd>(q: [V; 4]) -> V {
    q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
}
