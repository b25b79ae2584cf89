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

use super::chart::{
    Code, Layout, LeftOut, Point, floor_and_ceil_clamped, in_chart_of_largest, largest,
};
use super::formula::Rotation;
use super::smallest_three::length_squared;
use crate::simd::math::{angle_in_octant, inv_sqrt, sin_cos_of_half};
use crate::simd::{Simd, SimdInt, Vec3, map_vec, map2, map4};

/// Tangents over the largest in the layout `Y`.
#[derive(Clone, Copy)]
pub(super) struct TanThree<Y>(PhantomData<Y>);

impl<Y: Layout> TanThree<Y> {
    pub(super) const fn new() -> Self {
        TanThree(PhantomData)
    }

    /// tan((pi / 4) i / M); exact at the ends, as the sine of 45 degrees is the cosine.
    #[inline(always)]
    fn tan<V: Simd>(i: V::Int) -> V {
        let (sin, cos) = sin_cos_of_half(V::from_int(i) * (0.5 / Y::M as f32));
        sin / cos
    }

    /// Its inverse of `side / axis`, for |side| <= |axis|.
    #[inline(always)]
    fn param<V: Simd>(side: V, axis: V) -> V {
        let (steep, angle) = angle_in_octant(axis.abs(), side.abs());
        // From half turns to eighths.
        let eighths = V::select(steep, angle + 0.25, angle) * 4.0;
        let param = eighths * Y::M as f32;
        param.negate_where_negative(side).negate_where_negative(axis)
    }

    /// The code of a point, canonical.
    #[inline(always)]
    fn pack<V: Simd>(Point { fields, left_out }: Point<V>) -> Code<Y, V> {
        let q = LeftOut::<V>::new(left_out).insert_int(fields, V::Int::splat(Y::M));
        Y::pack::<V>(in_chart_of_largest::<V>(q))
    }
}

impl<Y: Layout> Rotation for TanThree<Y> {
    type Shape = Y::Shape;

    #[inline(always)]
    fn encode<V: Simd>(self, q: [V; 4]) -> Code<Y, V> {
        let left_out = largest(q);
        let (others, axis) = LeftOut::<V>::new(left_out).remove(q);
        let fields = map_vec!(others, |side| Self::param(side, axis).round_int());
        Self::pack(Point::<V> { fields, left_out })
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, q: [V; 4]) -> Code<Y, V> {
        let left_out = largest(q);
        let (others, axis) = LeftOut::<V>::new(left_out).remove(q);
        let target = map_vec!(others, |side| side / axis);
        let around = map_vec!(others, |side| {
            let integers = floor_and_ceil_clamped(Self::param(side, axis), Y::M);
            map2!(integers, |i| (i, Self::tan::<V>(i)))
        });
        // Least squared sine of the angle, (|d|^2 |t|^2 - (t.d)^2) / (|t|^2 |c|^2), c = t + d.
        let tt = target.length_squared() + 1.0;
        let zero = V::Int::splat(0);
        let mut point = Point::<V> { fields: Vec3::new(zero, zero, zero), left_out };
        let (mut least, mut least_cc) = (V::splat(f32::INFINITY), V::splat(1.0));
        for (i, x) in around.x {
            for (j, y) in around.y {
                for (l, z) in around.z {
                    let c = Vec3::new(x, y, z);
                    let d = c - target;
                    let along = target.dot(d);
                    let off = d.length_squared() * tt - along * along;
                    let cc = c.length_squared() + 1.0;
                    let nearer = (off * least_cc).lt(least * cc);
                    least = V::select(nearer, off, least);
                    least_cc = V::select(nearer, cc, least_cc);
                    let candidate = Point { fields: Vec3::new(i, j, l), left_out };
                    point = Point::select(nearer, candidate, point);
                }
            }
        }
        Self::pack(point)
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: Code<Y, V>) -> [V; 4] {
        let Point { fields, left_out } = Y::unpack::<V>(code);
        let sides = map_vec!(fields, |i| Self::tan::<V>(i));
        let q = LeftOut::<V>::new(left_out).insert(sides, V::splat(1.0));
        let inverse = inv_sqrt(length_squared(q));
        map4!(q, |c| c * inverse)
    }

    #[inline(always)]
    fn canonical<V: Simd>(self, code: Code<Y, V>) -> Code<Y, V> {
        Self::pack::<V>(Y::unpack::<V>(code))
    }
}
