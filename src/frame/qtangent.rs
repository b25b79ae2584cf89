//! A quaternion whose sign is the handedness.

use crate::batch::{Encoder, Precise};
use crate::formula::around;
use crate::lane::{Each, Lane, LaneInt, inlined};
use crate::layout::snorm_max;
use crate::math;

use super::formula::{Decoded, FrameFormula, Prepared, basis, sign, unit_combination};

/// x and y, then z and w, of 16 bits each.
pub(crate) struct QTangent;

/// Steps from 0 to 1.
const M: i32 = snorm_max(16);

impl QTangent {
    #[inline(always)]
    fn pack<L: Lane>([x, y, z, w]: [L::Int; 4]) -> [L::Int; 2] {
        [x.low(16) | y.shl(16), z.low(16) | w.shl(16)]
    }

    /// The components, each from -M to M, and w, where it is 0, as 1.
    #[inline(always)]
    fn unpack<L: Lane>([low, high]: [L::Int; 2]) -> [L::Int; 4] {
        let [x, y, z, w] = [low.sign_extend(16), low.sar(16), high.sign_extend(16), high.sar(16)]
            .each(|c| c.max(L::Int::splat(-M)));
        let (zero, one) = (L::Int::splat(0), L::Int::splat(1));
        [x, y, z, L::Int::select(w.eq(zero), one, w)]
    }

    /// Whether these, w not 0, are among the points around the unit quaternion of their direction.
    #[inline(always)]
    fn is_near_unit<L: Lane>(components: [L::Int; 4]) -> L::Mask {
        // How far the longest component is off it in steps, at most; more only by rounding.
        const FARTHEST: f32 = 1.01;
        let q = unit_scale::<L>(components);
        let square = length_squared(q);
        let excess = square - L::splat(1.0);
        // Near 1, a length differs from it by half of what its square does.
        (excess.abs() * longest(q)).le(square * L::splat(2.0 * FARTHEST / M as f32))
    }

    /// Each component rounded.
    #[inline(always)]
    fn rounded<L: Lane>(q: [L; 4]) -> [L::Int; 4] {
        let [x, y, z, w] = q.each(|c| (c * L::splat(M as f32)).round_int());
        [x, y, z, w.max(L::Int::splat(1))]
    }

    /// Each component of a unit quaternion rounded down or up: the closest of those of the sixteen that are
    /// also around their own unit quaternion, as the rounded one is.
    #[inline(always)]
    fn closest<L: Lane>(q: [L; 4]) -> [L::Int; 4] {
        let max = L::Int::splat(M);
        // Of each component both integers, and how they are off, which the quaternion's length does not
        // count in.
        let around = [0, 1, 2, 3].each(
            #[inline(always)]
            |i: usize| {
                let p = q[i] * L::splat(M as f32);
                let least = if i == 3 { L::Int::splat(1) } else { -max };
                around(p).each(
                    #[inline(always)]
                    |c| {
                        let c = c.max(least).min(max);
                        let off = L::from_int(c) - p;
                        (c, off * off, off * q[i])
                    },
                )
            },
        );
        let longest = longest(q);
        let mut best = around.each(|[near, _]| near.0);
        let mut least = L::splat(f32::INFINITY);
        for x in around[0] {
            for y in around[1] {
                for z in around[2] {
                    for w in around[3] {
                        let along = (x.2 + y.2) + (z.2 + w.2);
                        let off = ((x.1 + y.1) + (z.1 + w.1)) - along * along;
                        let closer = off.lt(least) & (along.abs() * longest).lt(L::splat(1.0));
                        least = L::select(closer, off, least);
                        let candidate = [x.0, y.0, z.0, w.0];
                        best = [0, 1, 2, 3].each(
                            #[inline(always)]
                            |i: usize| L::Int::select(closer, candidate[i], best[i]),
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
fn unit_scale<L: Lane>(components: [L::Int; 4]) -> [L; 4] {
    components.each(|c| L::from_int(c) * L::splat(1.0 / M as f32))
}

#[inline(always)]
fn length_squared<L: Lane>([x, y, z, w]: [L; 4]) -> L {
    (x * x + y * y) + (z * z + w * w)
}

/// The greatest |component|.
#[inline(always)]
fn longest<L: Lane>(q: [L; 4]) -> L {
    let [x, y, z, w] = q.each(|c| c.abs());
    x.greater(y).greater(z.greater(w))
}

impl FrameFormula for QTangent {
    #[inline(always)]
    fn encode<E: Encoder, L: Lane>(frame: Prepared<L>) -> [L::Int; 2] {
        let n = frame.unit_normal;
        let plane = basis(n);
        let t = unit_combination(frame.tangent_in(plane), plane);
        let b = math::cross(n, t);
        // The matrix 4 q q^T: its diagonal, and above it.
        let one = L::splat(1.0);
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
            |(square, row): (L, [L; 4]), (other_square, other): (L, [L; 4])| {
                let greater = square.lt(other_square);
                let row = [0, 1, 2, 3].each(
                    #[inline(always)]
                    |i: usize| L::select(greater, other[i], row[i]),
                );
                (L::select(greater, other_square, square), row)
            },
        );
        let [xx, yy, zz, ww] = squares;
        let of_xy = pick((xx, [xx, xy, xz, wx]), (yy, [xy, yy, yz, wy]));
        let of_zw = pick((zz, [xz, yz, zz, wz]), (ww, [wx, wy, wz, ww]));
        let (_, q) = pick(of_zw, of_xy);
        let scale = math::inv_sqrt(length_squared(q)).negate_where_negative(q[3]);
        let q = q.each(|c| c * scale);
        let q = if E::PRECISE { Self::closest(q) } else { Self::rounded(q) };
        Self::pack::<L>(q.each(|c| L::Int::select(frame.negative, -c, c)))
    }

    #[inline(always)]
    fn decode<L: Lane>(code: [L::Int; 2]) -> Decoded<L> {
        let q = Self::unpack::<L>(code);
        let handedness = sign(q[3]);
        let [x, y, z, w] = unit_scale::<L>(q);
        let twice = inlined(
            #[inline(always)]
            |a: L, b: L| a * b + a * b,
        );
        let (xx, yy, zz, ww) = (x * x, y * y, z * z, w * w);
        let tangent = [(ww + xx) - (yy + zz), twice(x, y) + twice(w, z), twice(x, z) - twice(w, y)];
        let normal = [twice(x, z) + twice(w, y), twice(y, z) - twice(w, x), (ww + zz) - (xx + yy)];
        let unit = inlined(
            #[inline(always)]
            |v: [L; 3]| math::normalize(v).each(|c| c + L::zero()),
        );
        Decoded { normal: unit(normal), tangent: unit(tangent), handedness }
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: [L::Int; 2]) -> [L::Int; 2] {
        let q = Self::unpack::<L>(code);
        let Decoded { normal, tangent, handedness } = Self::decode::<L>(code);
        let again = Self::encode::<Precise, L>(Prepared::new(normal, tangent, handedness));
        let (kept, unit) = (Self::pack::<L>(q), Self::is_near_unit::<L>(q));
        [0, 1].each(
            #[inline(always)]
            |i: usize| L::Int::select(unit, kept[i], again[i]),
        )
    }
}
