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
use crate::lane::{Each, Lane, LaneInt, LaneMask};
use crate::math::{inv_sqrt, sqrt};

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
    fn left_out_squared<L: Lane>(fields: [L::Int; 3]) -> (L, L::Int) {
        let [ii, jj, ll] = fields.each(
            #[inline(always)]
            |i| i * i,
        );
        let low = L::Int::splat(Self::SQUARE as i32) - ii - jj - ll;
        if Y::BITS <= 15 {
            return (L::from_int(low), low);
        }
        // In digits of 10 bits, i^2 = 2^20 h^2 + 2^11 h r + r^2.
        let [h, r] = [fields.each(|i| i.sar(10)), fields.each(|i| i.low(10))];
        let high =
            L::Int::splat((Self::SQUARE >> 20) as i32) - h[0] * h[0] - h[1] * h[1] - h[2] * h[2];
        let middle = h[0] * r[0] + h[1] * r[1] + h[2] * r[2];
        let rest = L::Int::splat((Self::SQUARE & 0xF_FFFF) as i32)
            - r[0] * r[0]
            - r[1] * r[1]
            - r[2] * r[2];
        // Both exact.
        let high = L::from_int(high - middle.sar(9));
        let rest = L::from_int(rest - middle.low(9).shl(11));
        (high * L::splat(1_048_576.0) + rest, low)
    }

    /// What a code stands for.
    #[inline(always)]
    fn point<L: Lane>(code: Code<Y, L>) -> Point<L> {
        let point = Y::unpack::<L>(code);
        let beyond = Self::left_out_squared::<L>(point.0).0.lt(L::zero());
        let identity = ([L::Int::splat(0); 3], L::Int::splat(3));
        select_point::<L>(beyond, identity, point)
    }

    /// Of the codes that mean one rotation the one that is emitted.
    #[inline(always)]
    fn canonical_point<L: Lane>((fields, index): Point<L>) -> Point<L> {
        let (n, low) = Self::left_out_squared::<L>(fields);
        let root = sqrt(n).round_int();
        // The root is off by less than 0.3, so equal low bits mean that all are.
        let whole = (root * root).eq(low);
        let q = LeftOut::<L>::new(index).insert(fields, root, L::Int::select);
        select_point::<L>(whole, in_chart_of_largest::<L>(q), (fields, index))
    }

    /// The nearest of all codes, canonical.
    #[inline(always)]
    fn nearest<L: Lane>(q: [L; 4]) -> Point<L> {
        let scale = inv_sqrt(length_squared(q)) * L::splat(Self::STEPS);
        let [x, y, z, w] = q.each(
            #[inline(always)]
            |c| c * scale,
        );
        let zero = L::Int::splat(0);
        let mut nearest = Nearest { point: ([zero; 3], zero), off: L::splat(f32::INFINITY) };
        nearest.consider::<Y>([y, z, w], x, 0);
        nearest.consider::<Y>([x, z, w], y, 1);
        nearest.consider::<Y>([x, y, w], z, 2);
        nearest.consider::<Y>([x, y, z], w, 3);
        Self::canonical_point::<L>(nearest.point)
    }
}

/// The nearest code so far, and how far off it is in steps, squared.
struct Nearest<L: Lane> {
    point: Point<L>,
    off: L,
}

impl<L: Lane> Nearest<L> {
    /// Considers the eight roundings in one chart, of a quaternion in steps.
    #[inline(always)]
    fn consider<Y: Layout>(&mut self, others: [L; 3], left_out: L, index: i32) {
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
                    let (n, _) = SmallestThree::<Y>::left_out_squared::<L>(fields);
                    let mut off = sqrt(n) - left_out.abs();
                    off = off * off;
                    for axis in 0..3 {
                        let e = L::from_int(fields[axis]) - target[axis];
                        off = off + e * e;
                    }
                    let nearer = off.lt(self.off) & L::zero().le(n);
                    self.off = L::select(nearer, off, self.off);
                    let point = (fields, L::Int::splat(index));
                    self.point = select_point::<L>(nearer, point, self.point);
                }
            }
        }
    }
}

impl<Y: Layout> Rotation for SmallestThree<Y> {
    type Words = Y::Words;

    #[inline(always)]
    fn encode<L: Lane>(q: [L; 4]) -> Code<Y, L> {
        let index = largest(q);
        let (others, left_out) = LeftOut::<L>::new(index).remove(q, L::select);
        let scale = inv_sqrt(length_squared(q)) * L::splat(Self::STEPS);
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
        let margin = left_out.abs() * scale - L::from_int(i.max(j).max(l));
        let mut point = (fields, index);
        if margin.lt(L::splat(2.0)).any() {
            point = Self::canonical_point::<L>(point);
        }
        Y::pack::<L>(point)
    }

    #[inline(always)]
    fn encode_precise<L: Lane>(q: [L; 4]) -> Code<Y, L> {
        Y::pack::<L>(Self::nearest(q))
    }

    #[inline(always)]
    fn decode<L: Lane>(code: Code<Y, L>) -> [L; 4] {
        let (fields, index) = Self::point::<L>(code);
        let (n, low) = Self::left_out_squared::<L>(fields);
        let root = sqrt(n * L::splat(1.0 / Self::SQUARE as f32));
        // Whole numbers of steps are exact, so that it does not matter which component is left out.
        let whole = (root * L::splat(Self::STEPS)).round_int();
        let exact = L::from_int(whole) * L::splat(Self::STEP);
        let left_out = L::Int::select((whole * whole).eq(low), exact.to_bits(), root.to_bits());
        let others = fields.each(
            #[inline(always)]
            |i| L::from_int(i) * L::splat(Self::STEP),
        );
        LeftOut::<L>::new(index).insert(others, L::from_bits(left_out), L::select)
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: Code<Y, L>) -> Code<Y, L> {
        Y::pack::<L>(Self::canonical_point::<L>(Self::point::<L>(code)))
    }
}

/// q.q.
#[inline(always)]
pub(super) fn length_squared<L: Lane>(q: [L; 4]) -> L {
    q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
}
