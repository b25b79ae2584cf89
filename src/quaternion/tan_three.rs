//! The component of the greatest magnitude divides the three others, each of which is stored as an
//! angle.
//!
//! ```text
//! encode   c = the first component of the greatest magnitude
//!          (i, j, l) = round(M (4 / pi) atan((the three others) / q.c)),   M = 2^(b-1) - 1
//! decode   q.c = 1;   the three others = tan((pi / 4) (i, j, l) / M);   q /= |q|
//! ```
//!
//! The nearest code is one of the eight roundings down or up: the charts only touch, where a field is
//! M or -M, and share the codes there.
//!
//! Canonical: those codes belong to the first of the components of the greatest magnitude.

use core::marker::PhantomData;

use super::Rotation;
use super::chart::{
    Code, Layout, LeftOut, Point, around_within, in_chart_of_largest, largest, select_point,
};
use super::smallest_three::length_squared;
use crate::lane::{Each, Lane, LaneInt};
use crate::math::{angle_in_octant, dot, inv_sqrt, sin_cos_of_half};

/// Tangents over the largest in the layout `Y`.
pub(super) struct TanThree<Y>(PhantomData<Y>);

impl<Y: Layout> TanThree<Y> {
    /// tan((pi / 4) i / M); exact at the ends, as the sine of 45 degrees is the cosine.
    #[inline(always)]
    fn tan<L: Lane>(i: L::Int) -> L {
        let (sin, cos) = sin_cos_of_half(L::from_int(i) * L::splat(0.5 / Y::M as f32));
        sin / cos
    }

    /// Its inverse of `side / axis`, for |side| <= |axis|.
    #[inline(always)]
    fn param<L: Lane>(side: L, axis: L) -> L {
        let (steep, angle) = angle_in_octant(axis.abs(), side.abs());
        // From half turns to eighths.
        let eighths = L::splat(4.0) * L::select(steep, L::splat(0.25) + angle, angle);
        let param = eighths * L::splat(Y::M as f32);
        param.negate_where_negative(side).negate_where_negative(axis)
    }

    /// The code of a point, canonical.
    #[inline(always)]
    fn pack<L: Lane>((fields, index): Point<L>) -> Code<Y, L> {
        let q = LeftOut::<L>::new(index).insert(fields, L::Int::splat(Y::M), L::Int::select);
        Y::pack::<L>(in_chart_of_largest::<L>(q))
    }
}

impl<Y: Layout> Rotation for TanThree<Y> {
    type Words = Y::Words;

    #[inline(always)]
    fn encode<L: Lane>(q: [L; 4]) -> Code<Y, L> {
        let index = largest(q);
        let (others, axis) = LeftOut::<L>::new(index).remove(q, L::select);
        let fields = others.each(
            #[inline(always)]
            |side| Self::param(side, axis).round_int(),
        );
        Self::pack::<L>((fields, index))
    }

    #[inline(always)]
    fn encode_precise<L: Lane>(q: [L; 4]) -> Code<Y, L> {
        let index = largest(q);
        let (others, axis) = LeftOut::<L>::new(index).remove(q, L::select);
        let around = others.each(
            #[inline(always)]
            |side| around_within(Self::param(side, axis), Y::M),
        );
        let target = others.each(
            #[inline(always)]
            |side| side / axis,
        );
        let [is, js, ls] = around.each(
            #[inline(always)]
            |around: [L::Int; 2]| {
                around.each(
                    #[inline(always)]
                    |i| (i, Self::tan::<L>(i)),
                )
            },
        );
        // Least squared sine of the angle, (|d|^2 |t|^2 - (t.d)^2) / (|t|^2 |c|^2), c = t + d.
        let tt = L::splat(1.0) + dot(target, target);
        let mut point = ([L::Int::splat(0); 3], index);
        let (mut least, mut least_cc) = (L::splat(f32::INFINITY), L::splat(1.0));
        for (i, x) in is {
            for (j, y) in js {
                for (l, z) in ls {
                    let d = [x - target[0], y - target[1], z - target[2]];
                    let along = dot(target, d);
                    let off = dot(d, d) * tt - along * along;
                    let cc = L::splat(1.0) + dot([x, y, z], [x, y, z]);
                    let nearer = (off * least_cc).lt(least * cc);
                    least = L::select(nearer, off, least);
                    least_cc = L::select(nearer, cc, least_cc);
                    point = select_point::<L>(nearer, ([i, j, l], index), point);
                }
            }
        }
        Self::pack::<L>(point)
    }

    #[inline(always)]
    fn decode<L: Lane>(code: Code<Y, L>) -> [L; 4] {
        let (fields, index) = Y::unpack::<L>(code);
        let sides = fields.each(
            #[inline(always)]
            |i| Self::tan::<L>(i),
        );
        let q = LeftOut::<L>::new(index).insert(sides, L::splat(1.0), L::select);
        let inverse = inv_sqrt(length_squared(q));
        q.each(
            #[inline(always)]
            |c| c * inverse,
        )
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: Code<Y, L>) -> Code<Y, L> {
        Self::pack::<L>(Y::unpack::<L>(code))
    }
}
