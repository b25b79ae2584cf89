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

use super::chart::{
    Code, Layout, LeftOut, Point, floor_and_ceil_clamped, in_chart_of_largest, largest,
};
use super::formula::Rotation;
use super::smallest_three::length_squared;
use crate::simd::math::{angle_in_octant, inv_sqrt, sin_cos_of_half};
use crate::simd::{Simd, SimdInt, Vec3, map_vec, map2, map4};

/// Tangents over the largest in the layout `Y`.
#[derive(Clone, Copy)]
pub(super) struct TanThree<Y>(Y);

impl<Y: Layout> TanThree<Y> {
    pub(super) const fn new(layout: Y) -> Self {
        TanThree(layout)
    }

    /// tan((pi / 4) i / M); exact at the ends, as the sine of 45 degrees is the cosine.
    #[inline(always)]
    fn tan<V: Simd>(self, i: V::Int) -> V {
        let (sin, cos) = sin_cos_of_half(V::from_int(i) * (0.5 / self.0.max() as f32));
        sin / cos
    }

    /// Its inverse of `side / axis`, for |side| <= |axis|.
    #[inline(always)]
    fn param<V: Simd>(self, side: V, axis: V) -> V {
        let (steep, angle) = angle_in_octant(axis.abs(), side.abs());
        // From half turns to eighths.
        let eighths = V::select(steep, angle + 0.25, angle) * 4.0;
        let param = eighths * self.0.max() as f32;
        param.negate_where_negative(side).negate_where_negative(axis)
    }

    /// The code of a point, canonical.
    #[inline(always)]
    fn pack<V: Simd>(self, Point { fields, left_out }: Point<V>) -> Code<Y, V> {
        let q = LeftOut::<V>::new(left_out).insert_int(fields, V::Int::splat(self.0.max()));
        self.0.pack::<V>(in_chart_of_largest::<V>(q))
    }
}

impl<Y: Layout> Rotation for TanThree<Y> {
    type Shape = Y::Shape;

    #[inline(always)]
    fn encode<V: Simd>(self, q: [V; 4]) -> Code<Y, V> {
        let left_out = largest(q);
        let (others, axis) = LeftOut::<V>::new(left_out).remove(q);
        let fields = map_vec!(others, |side| self.param(side, axis).round_int());
        self.pack(Point::<V> { fields, left_out })
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, q: [V; 4]) -> Code<Y, V> {
        let left_out = largest(q);
        let (others, axis) = LeftOut::<V>::new(left_out).remove(q);
        let target = map_vec!(others, |side| side / axis);
        let around = map_vec!(others, |side| {
            let integers = floor_and_ceil_clamped(self.param(side, axis), self.0.max());
            map2!(integers, |i| (i, self.tan::<V>(i)))
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
        self.pack(point)
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: Code<Y, V>) -> [V; 4] {
        let Point { fields, left_out } = self.0.unpack::<V>(code);
        let sides = map_vec!(fields, |i| self.tan::<V>(i));
        let q = LeftOut::<V>::new(left_out).insert(sides, V::splat(1.0));
        let inverse = inv_sqrt(length_squared(q));
        map4!(q, |c| c * inverse)
    }

    #[inline(always)]
    fn canonical<V: Simd>(self, code: Code<Y, V>) -> Code<Y, V> {
        self.pack::<V>(self.0.unpack::<V>(code))
    }
}

#[cfg(test)]
mod tests {
    use super::super::chart::OneWord;
    use super::*;
    use crate::simd::I32x1;

    const TAN: TanThree<OneWord> = TanThree::new(OneWord::new(10));

    /// Fields of 10 bits, and the component left out.
    const fn code([i, j, l]: [i32; 3], left_out: i32) -> i32 {
        (i & 1023) | (j & 1023) << 10 | (l & 1023) << 20 | left_out << 30
    }

    #[test]
    fn fields_are_even_steps_of_the_angle() {
        // atan(1/2) 4 / pi = 0.590334, times 511 is 301.7; atan(1/4) 4 / pi = 0.311917 gives 159.4.
        for (q, expected) in [
            ([0.0f32, 0.5, 0.0, 1.0], code([0, 302, 0], 3)),
            ([0.0, 1.0, 0.5, -2.0], code([0, -302, -159], 3)),
            ([-4.0, 1.0, 0.0, 2.0], code([-159, 0, -302], 0)),
        ] {
            assert_eq!([TAN.encode(q).0, TAN.encode_precise(q).0], [expected; 2], "{q:?}");
        }
    }

    #[test]
    fn decoding_takes_tangents() {
        // tan(45 degrees * 302 / 511) = 0.500652, over the length 1.118326.
        let q = TAN.decode::<f32>(I32x1(code([0, 302, 0], 3)));
        let off = [q[0], q[1] - 0.447_680, q[2], q[3] - 0.894_194];
        assert!(length_squared(off) < 1e-11, "{q:?}");
    }

    #[test]
    fn rotations_of_zeros_and_one_magnitude_survive() {
        let half = core::f32::consts::FRAC_1_SQRT_2;
        for (q, expected) in [
            ([1.0f32, 0.0, 0.0, 0.0], code([0, 0, 0], 0)),
            ([0.0, 0.0, 0.0, 1.0], code([0, 0, 0], 3)),
            ([0.5, -0.5, 0.5, 0.5], code([-511, 511, 511], 0)),
            ([0.0, half, 0.0, -half], code([0, 0, -511], 1)),
        ] {
            assert_eq!([TAN.encode(q).0, TAN.encode_precise(q).0], [expected; 2], "{q:?}");
            let decoded = TAN.decode::<f32>(I32x1(expected));
            let off = [decoded[0] - q[0], decoded[1] - q[1], decoded[2] - q[2], decoded[3] - q[3]];
            assert!(length_squared(off) < 1e-13);
            assert!(decoded.iter().zip(q).all(|(d, c)| (*d == 0.0) == (c == 0.0)));
        }
    }

    #[test]
    fn where_charts_touch_the_first_counts() {
        for (there, own) in [
            // (511, 511, 0, 0), (-511, 0, 0, 511), and -512 that reads as -511.
            (code([511, 0, 0], 1), code([511, 0, 0], 0)),
            (code([-511, 0, 0], 3), code([0, 0, -511], 0)),
            (code([-512, 0, 0], 3), code([0, 0, -511], 0)),
            (code([510, 0, 0], 3), code([510, 0, 0], 3)),
        ] {
            assert_eq!(TAN.canonical::<f32>(I32x1(there)).0, own);
        }
    }

    #[test]
    fn the_nearest_code_of_a_decoded_rotation_is_its_own() {
        for own in [code([302, -17, 5], 3), code([-510, 509, 1], 0), code([7, 0, -511], 2)] {
            let own = TAN.canonical::<f32>(I32x1(own));
            assert_eq!(TAN.encode_precise(TAN.decode::<f32>(own)), own);
        }
    }
}
