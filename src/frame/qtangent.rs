//! A quaternion whose sign is the handedness.

use crate::batch::{Encoder, Precise};
use crate::formula::around;
use crate::formula::bits::snorm_max;
use crate::simd::math;
use crate::simd::{Each, Simd, SimdInt, inlined};

use super::formula::{Decoded, FrameFormula, Prepared, basis, sign, unit_combination};

/// x and y, then z and w, of 16 bits each.
pub(crate) struct QTangent;

/// Steps from 0 to 1.
const M: i32 = snorm_max(16);

impl QTangent {
    #[inline(always)]
    fn pack<V: Simd>([x, y, z, w]: [V::Int; 4]) -> [V::Int; 2] {
        [x.low(16) | y.shl(16), z.low(16) | w.shl(16)]
    }

    /// The components, each from -M to M, and w, where it is 0, as 1.
    #[inline(always)]
    fn unpack<V: Simd>([low, high]: [V::Int; 2]) -> [V::Int; 4] {
        let [x, y, z, w] = [low.sign_extend(16), low.sar(16), high.sign_extend(16), high.sar(16)]
            .each(|c| c.max(V::Int::splat(-M)));
        let (zero, one) = (V::Int::splat(0), V::Int::splat(1));
        [x, y, z, V::Int::select(w.eq(zero), one, w)]
    }

    /// Whether these, w not 0, are among the points around the unit quaternion of their direction.
    #[inline(always)]
    fn is_near_unit<V: Simd>(components: [V::Int; 4]) -> V::Mask {
        // How far the longest component is off it in steps, at most; more only by rounding.
        const FARTHEST: f32 = 1.01;
        let q = unit_scale::<V>(components);
        let square = length_squared(q);
        let excess = square - V::splat(1.0);
        // Near 1, a length differs from it by half of what its square does.
        (excess.abs() * longest(q)).le(square * V::splat(2.0 * FARTHEST / M as f32))
    }

    /// Each component rounded.
    #[inline(always)]
    fn rounded<V: Simd>(q: [V; 4]) -> [V::Int; 4] {
        let [x, y, z, w] = q.each(|c| (c * V::splat(M as f32)).round_int());
        [x, y, z, w.max(V::Int::splat(1))]
    }

    /// Each component of a unit quaternion rounded down or up: the closest of those of the sixteen that are
    /// also around their own unit quaternion, as the rounded one is.
    #[inline(always)]
    fn closest<V: Simd>(q: [V; 4]) -> [V::Int; 4] {
        let max = V::Int::splat(M);
        // Of each component both integers, and how they are off, which the quaternion's length does not
        // count in.
        let around = [0, 1, 2, 3].each(
            #[inline(always)]
            |i: usize| {
                let p = q[i] * V::splat(M as f32);
                let least = if i == 3 { V::Int::splat(1) } else { -max };
                around(p).each(
                    #[inline(always)]
                    |c| {
                        let c = c.max(least).min(max);
                        let off = V::from_int(c) - p;
                        (c, off * off, off * q[i])
                    },
                )
            },
        );
        let longest = longest(q);
        let mut best = around.each(|[near, _]| near.0);
        let mut least = V::splat(f32::INFINITY);
        for x in around[0] {
            for y in around[1] {
                for z in around[2] {
                    for w in around[3] {
                        let along = (x.2 + y.2) + (z.2 + w.2);
                        let off = ((x.1 + y.1) + (z.1 + w.1)) - along * along;
                        let closer = off.lt(least) & (along.abs() * longest).lt(V::splat(1.0));
                        least = V::select(closer, off, least);
                        let candidate = [x.0, y.0, z.0, w.0];
                        best = [0, 1, 2, 3].each(
                            #[inline(always)]
                            |i: usize| V::Int::select(closer, candidate[i], best[i]),
                        );
                    }
                }
            }
        }
        best
    }
}

/// Integers as parts of M.
#[inline(always)]
fn unit_scale<V: Simd>(components: [V::Int; 4]) -> [V; 4] {
    components.each(|c| V::from_int(c) * V::splat(1.0 / M as f32))
}

#[inline(always)]
fn length_squared<V: Simd>([x, y, z, w]: [V; 4]) -> V {
    (x * x + y * y) + (z * z + w * w)
}

/// The greatest |component|.
#[inline(always)]
fn longest<V: Simd>(q: [V; 4]) -> V {
    let [x, y, z, w] = q.each(|c| c.abs());
    x.greater(y).greater(z.greater(w))
}

impl FrameFormula for QTangent {
    #[inline(always)]
    fn encode<E: Encoder, V: Simd>(frame: Prepared<V>) -> [V::Int; 2] {
        let n = frame.unit_normal;
        let plane = basis(n);
        let t = unit_combination(frame.tangent_in(plane), plane);
        let b = math::cross(n, t);
        // The matrix 4 q q^T: its diagonal, and above it.
        let one = V::splat(1.0);
        let squares = [
            one + (t[0] - b[1] - n[2]),
            one + (b[1] - t[0] - n[2]),
            one + (n[2] - t[0] - b[1]),
            one + (t[0] + b[1] + n[2]),
        ];
        let (xy, xz, yz) = (t[1] + b[0], t[2] + n[0], b[2] + n[1]);
        let (wx, wy, wz) = (b[2] - n[1], n[0] - t[2], t[1] - b[0]);
        // Its row with the greatest square has the least rounding.
        let pick = inlined(
            #[inline(always)]
            |(square, row): (V, [V; 4]), (other_square, other): (V, [V; 4])| {
                let greater = square.lt(other_square);
                let row = [0, 1, 2, 3].each(
                    #[inline(always)]
                    |i: usize| V::select(greater, other[i], row[i]),
                );
                (V::select(greater, other_square, square), row)
            },
        );
        let [xx, yy, zz, ww] = squares;
        let of_xy = pick((xx, [xx, xy, xz, wx]), (yy, [xy, yy, yz, wy]));
        let of_zw = pick((zz, [xz, yz, zz, wz]), (ww, [wx, wy, wz, ww]));
        let (_, q) = pick(of_zw, of_xy);
        let scale = math::inv_sqrt(length_squared(q)).negate_where_negative(q[3]);
        let q = q.each(|c| c * scale);
        let q = if E::PRECISE { Self::closest(q) } else { Self::rounded(q) };
        Self::pack::<V>(q.each(|c| V::Int::select(frame.negative, -c, c)))
    }

    #[inline(always)]
    fn decode<V: Simd>(code: [V::Int; 2]) -> Decoded<V> {
        let q = Self::unpack::<V>(code);
        let handedness = sign(q[3]);
        let [x, y, z, w] = unit_scale::<V>(q);
        let twice = inlined(
            #[inline(always)]
            |a: V, b: V| a * b + a * b,
        );
        let (xx, yy, zz, ww) = (x * x, y * y, z * z, w * w);
        let tangent = [(ww + xx) - (yy + zz), twice(x, y) + twice(w, z), twice(x, z) - twice(w, y)];
        let normal = [twice(x, z) + twice(w, y), twice(y, z) - twice(w, x), (ww + zz) - (xx + yy)];
        let unit = inlined(
            #[inline(always)]
            |v: [V; 3]| math::normalize(v).each(|c| c + V::zero()),
        );
        Decoded { normal: unit(normal), tangent: unit(tangent), handedness }
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: [V::Int; 2]) -> [V::Int; 2] {
        let q = Self::unpack::<V>(code);
        let Decoded { normal, tangent, handedness } = Self::decode::<V>(code);
        let again = Self::encode::<Precise, V>(Prepared::new(normal, tangent, handedness));
        let (kept, unit) = (Self::pack::<V>(q), Self::is_near_unit::<V>(q));
        [0, 1].each(
            #[inline(always)]
            |i: usize| V::Int::select(unit, kept[i], again[i]),
        )
    }
}
