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
use crate::simd::math::{angle_in_octant, dot, inv_sqrt, sin_cos_of_half};
use crate::simd::{Each, Simd, SimdInt};

/// Tangents over the largest in the layout `Y`.
pub(super) struct TanThree<Y>(PhantomData<Y>);

impl<Y: Layout> TanThree<Y> {
    /// tan((pi / 4) i / M); exact at the ends, as the sine of 45 degrees is the cosine.
    #[inline(always)]
    fn tan<V: Simd>(i: V::Int) -> V {
        let (sin, cos) = sin_cos_of_half(V::from_int(i) * V::splat(0.5 / Y::M as f32));
        sin / cos
    }

    /// Its inverse of `side / axis`, for |side| <= |axis|.
    #[inline(always)]
    fn param<V: Simd>(side: V, axis: V) -> V {
        let (steep, angle) = angle_in_octant(axis.abs(), side.abs());
        // From half turns to eighths.
        let eighths = V::splat(4.0) * V::select(steep, V::splat(0.25) + angle, angle);
        let param = eighths * V::splat(Y::M as f32);
        param.negate_where_negative(side).negate_where_negative(axis)
    }

    /// The code of a point, canonical.
    #[inline(always)]
    fn pack<V: Simd>((fields, index): Point<V>) -> Code<Y, V> {
        let q = LeftOut::<V>::new(index).insert(fields, V::Int::splat(Y::M), V::Int::select);
        Y::pack::<V>(in_chart_of_largest::<V>(q))
    }
}

impl<Y: Layout> Rotation for TanThree<Y> {
    type Words = Y::Words;

    #[inline(always)]
    fn encode<V: Simd>(q: [V; 4]) -> Code<Y, V> {
        let index = largest(q);
        let (others, axis) = LeftOut::<V>::new(index).remove(q, V::select);
        let fields = others.each(
            #[inline(always)]
            |side| Self::param(side, axis).round_int(),
        );
        Self::pack::<V>((fields, index))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(q: [V; 4]) -> Code<Y, V> {
        let index = largest(q);
        let (others, axis) = LeftOut::<V>::new(index).remove(q, V::select);
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
            |around: [V::Int; 2]| {
                around.each(
                    #[inline(always)]
                    |i| (i, Self::tan::<V>(i)),
                )
            },
        );
        // Least squared sine of the angle, (|d|^2 |t|^2 - (t.d)^2) / (|t|^2 |c|^2), c = t + d.
        let tt = V::splat(1.0) + dot(target, target);
        let mut point = ([V::Int::splat(0); 3], index);
        let (mut least, mut least_cc) = (V::splat(f32::INFINITY), V::splat(1.0));
        for (i, x) in is {
            for (j, y) in js {
                for (l, z) in ls {
                    let d = [x - target[0], y - target[1], z - target[2]];
                    let along = dot(target, d);
                    let off = dot(d, d) * tt - along * along;
                    let cc = V::splat(1.0) + dot([x, y, z], [x, y, z]);
                    let nearer = (off * least_cc).lt(least * cc);
                    least = V::select(nearer, off, least);
                    least_cc = V::select(nearer, cc, least_cc);
                    point = select_point::<V>(nearer, ([i, j, l], index), point);
                }
            }
        }
        Self::pack::<V>(point)
    }

    #[inline(always)]
    fn decode<V: Simd>(code: Code<Y, V>) -> [V; 4] {
        let (fields, index) = Y::unpack::<V>(code);
        let sides = fields.each(
            #[inline(always)]
            |i| Self::tan::<V>(i),
        );
        let q = LeftOut::<V>::new(index).insert(sides, V::splat(1.0), V::select);
        let inverse = inv_sqrt(length_squared(q));
        q.each(
            #[inline(always)]
            |c| c * inverse,
        )
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: Code<Y, V>) -> Code<Y, V> {
        Self::pack::<V>(Y::unpack::<V>(code))
    }
}
