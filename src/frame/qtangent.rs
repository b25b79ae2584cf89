//! A quaternion whose sign is the handedness.

use crate::formula::support::bits::snorm_max;
use crate::formula::support::closest::floor_and_ceil;
use crate::simd::math::inv_sqrt;
use crate::simd::{Simd, SimdInt, Vec3, map2, map4};

use super::formula::{
    Decoded, FrameFormula, Prepared, basis, sign, unit_combination, unsigned_zeros,
};

/// x and y, then z and w, of 16 bits each.
#[derive(Clone, Copy)]
pub(super) struct QTangent;

/// Steps from 0 to 1.
const M: i32 = snorm_max(16);

/// An integer component, and how it is off: squared, and along the quaternion.
#[derive(Clone, Copy)]
struct Rounded<V: Simd> {
    component: V::Int,
    off_squared: V,
    along: V,
}

impl QTangent {
    pub(super) const fn new() -> Self {
        QTangent
    }

    #[inline(always)]
    fn pack<V: Simd>([x, y, z, w]: [V::Int; 4]) -> [V::Int; 2] {
        [x.low_bits(16) | y.shl(16), z.low_bits(16) | w.shl(16)]
    }

    /// The components clamped to ±M; w = 0 reads as 1.
    #[inline(always)]
    fn unpack<V: Simd>([low, high]: [V::Int; 2]) -> [V::Int; 4] {
        let fields = [
            low.sign_extend(16),
            low.shr_arithmetic(16),
            high.sign_extend(16),
            high.shr_arithmetic(16),
        ];
        let [x, y, z, w] = map4!(fields, |c| c.max(-M));
        [x, y, z, V::Int::select(w.eq(0), 1, w)]
    }

    /// Whether these, w not 0, are among the points around the unit quaternion of their direction.
    #[inline(always)]
    fn is_near_unit<V: Simd>(components: [V::Int; 4]) -> V::Mask {
        // How far the longest component is off it in steps, at most; more only by rounding.
        const FARTHEST: f32 = 1.01;
        let q = unit_scale::<V>(components);
        let square = length_squared(q);
        let excess = square - 1.0;
        // Near 1, a length differs from it by half of what its square does.
        (excess.abs() * longest(q)).le(square * (2.0 * FARTHEST / M as f32))
    }

    /// Each component rounded.
    #[inline(always)]
    fn rounded<V: Simd>(q: [V; 4]) -> [V::Int; 4] {
        let [x, y, z, w] = map4!(q, |c| (c * M as f32).round_int());
        [x, y, z, w.max(1)]
    }

    /// Each component of a unit quaternion rounded down or up: the closest of those of the sixteen that are
    /// also around their own unit quaternion, as the rounded one is.
    #[inline(always)]
    fn closest<V: Simd>(q: [V; 4]) -> [V::Int; 4] {
        // The quaternion's length does not count, so what is off along it is subtracted.
        let around = map4!([0, 1, 2, 3], |i: usize| {
            let p = q[i] * M as f32;
            let least = if i == 3 { 1 } else { -M };
            map2!(floor_and_ceil(p), |c| {
                let component = c.clamp(least, M);
                let off = V::from_int(component) - p;
                Rounded::<V> { component, off_squared: off * off, along: off * q[i] }
            })
        });
        let longest = longest(q);
        let mut best = map4!(around, |pair| pair[0].component);
        let mut least = V::splat(f32::INFINITY);
        for x in around[0] {
            for y in around[1] {
                for z in around[2] {
                    for w in around[3] {
                        let along = (x.along + y.along) + (z.along + w.along);
                        let off_squared =
                            (x.off_squared + y.off_squared) + (z.off_squared + w.off_squared);
                        let off = off_squared - along * along;
                        let closer = off.lt(least) & (along.abs() * longest).lt(1.0);
                        least = V::select(closer, off, least);
                        best = [
                            V::Int::select(closer, x.component, best[0]),
                            V::Int::select(closer, y.component, best[1]),
                            V::Int::select(closer, z.component, best[2]),
                            V::Int::select(closer, w.component, best[3]),
                        ];
                    }
                }
            }
        }
        best
    }
}

/// Integers over M.
#[inline(always)]
fn unit_scale<V: Simd>(components: [V::Int; 4]) -> [V; 4] {
    map4!(components, |c| V::from_int(c) * (1.0 / M as f32))
}

#[inline(always)]
fn length_squared<V: Simd>([x, y, z, w]: [V; 4]) -> V {
    (x * x + y * y) + (z * z + w * w)
}

/// The greatest |component|.
#[inline(always)]
fn longest<V: Simd>(q: [V; 4]) -> V {
    let [x, y, z, w] = map4!(q, |c| c.abs());
    x.max(y).max(z.max(w))
}

/// A square, and a row of the matrix that belongs to it.
#[derive(Clone, Copy)]
struct Row<V> {
    square: V,
    row: [V; 4],
}

impl<V: Simd> Row<V> {
    /// The one with the greater square, `self` of equals.
    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        let greater = self.square.lt(other.square);
        let row = map4!([0, 1, 2, 3], |i: usize| V::select(greater, other.row[i], self.row[i]));
        Row { square: V::select(greater, other.square, self.square), row }
    }
}

impl FrameFormula for QTangent {
    #[inline(always)]
    fn encode<V: Simd, const PRECISE: bool>(self, frame: Prepared<V>) -> [V::Int; 2] {
        let n = frame.unit_normal;
        let plane = basis(n);
        let t = unit_combination(frame.tangent_in(plane), plane);
        let b = n.cross(t);
        // The matrix 4 q q^T: its diagonal, and above it.
        let [xx, yy, zz, ww] = [
            t.x - b.y - n.z + 1.0,
            b.y - t.x - n.z + 1.0,
            n.z - t.x - b.y + 1.0,
            t.x + b.y + n.z + 1.0,
        ];
        let (xy, xz, yz) = (t.y + b.x, t.z + n.x, b.z + n.y);
        let (wx, wy, wz) = (b.z - n.y, n.x - t.z, t.y - b.x);
        // Its row with the greatest square has the least rounding.
        let x = Row { square: xx, row: [xx, xy, xz, wx] };
        let y = Row { square: yy, row: [xy, yy, yz, wy] };
        let z = Row { square: zz, row: [xz, yz, zz, wz] };
        let w = Row { square: ww, row: [wx, wy, wz, ww] };
        let Row { row: q, .. } = z.greater(w).greater(x.greater(y));
        let scale = inv_sqrt(length_squared(q)).negate_where_negative(q[3]);
        let q = map4!(q, |c| c * scale);
        let q = if PRECISE { Self::closest(q) } else { Self::rounded(q) };
        Self::pack::<V>(map4!(q, |c| V::Int::select(frame.negative, -c, c)))
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: [V::Int; 2]) -> Decoded<V> {
        let q = Self::unpack::<V>(code);
        let handedness = sign(q[3]);
        let [x, y, z, w] = unit_scale::<V>(q);
        let (xx, yy, zz, ww) = (x * x, y * y, z * z, w * w);
        let (xy, xz, yz) = (x * y + x * y, x * z + x * z, y * z + y * z);
        let (wx, wy, wz) = (w * x + w * x, w * y + w * y, w * z + w * z);
        let tangent = Vec3::new((ww + xx) - (yy + zz), xy + wz, xz - wy);
        let normal = Vec3::new(xz + wy, yz - wx, (ww + zz) - (xx + yy));
        Decoded {
            normal: unsigned_zeros(normal.normalize()),
            tangent: unsigned_zeros(tangent.normalize()),
            handedness,
        }
    }

    #[inline(always)]
    fn canonical<V: Simd>(self, code: [V::Int; 2]) -> [V::Int; 2] {
        let q = Self::unpack::<V>(code);
        let Decoded { normal, tangent, handedness } = self.decode::<V>(code);
        let again = self.encode::<V, true>(Prepared::new(normal, tangent, handedness));
        let (kept, unit) = (Self::pack::<V>(q), Self::is_near_unit::<V>(q));
        map2!([0, 1], |i: usize| V::Int::select(unit, kept[i], again[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    /// x, y, z and w.
    fn words([x, y, z, w]: [i32; 4]) -> [I32x1; 2] {
        [I32x1(x & 0xFFFF | y << 16), I32x1(z & 0xFFFF | w << 16)]
    }

    fn frame(normal: [f32; 3], tangent: [f32; 3], handedness: f32) -> Prepared<f32> {
        Prepared::new(normal.into(), tangent.into(), handedness)
    }

    #[test]
    fn rotations_by_thirds_and_quarters_are_known() {
        // 32767 / 2 = 16383.5, and 32767 / sqrt(2) = 23169.8.
        for (normal, tangent, q) in [
            ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0, 0, 0, 32_767]),
            ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [16_384; 4]),
            ([0.0, 0.0, 2.0], [0.0, 1.0, 0.3], [0, 0, 23_170, 23_170]),
            ([0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [23_170, 0, 0, 23_170]),
            // Half turns have w = 0, which is stored as 1.
            ([0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [32_767, 0, 0, 1]),
            ([0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0, 32_767, 0, 1]),
            ([0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0, 0, 32_767, 1]),
        ] {
            let code = QTangent.encode::<f32, false>(frame(normal, tangent, 1.0));
            assert_eq!(code, words(q), "{normal:?} {tangent:?}");
            let code = QTangent.encode::<f32, false>(frame(normal, tangent, -1.0));
            assert_eq!(code, words(q.map(|c| -c)));
        }
    }

    #[test]
    fn decoding_turns_x_and_z() {
        for (q, normal, tangent, handedness) in [
            ([0, 0, 0, 32_767], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], 1.0),
            ([100; 4], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 1.0),
            ([-100; 4], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], -1.0),
            ([7, 0, 0, 7], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0], 1.0),
        ] {
            let decoded = QTangent.decode::<f32>(words(q));
            for (v, expected) in [(decoded.normal, normal), (decoded.tangent, tangent)] {
                assert!(v.distance_squared(expected.into()) < 1e-13, "{v:?}");
                assert!(v.to_array().iter().all(|c| c.to_bits() != (-0.0f32).to_bits()));
            }
            assert_eq!(decoded.handedness, handedness);
        }
    }

    #[test]
    fn what_is_out_of_range_reads_as_its_neighbour() {
        let unpack = |q| QTangent::unpack::<f32>(words(q)).map(|c| c.0);
        assert_eq!(unpack([-32_768, 0, 5, -32_768]), [-32_767, 0, 5, -32_767]);
        assert_eq!(unpack([3, -4, 5, 0]), [3, -4, 5, 1]);
    }

    #[test]
    fn only_codes_of_about_unit_length_are_canonical() {
        for (there, own) in [
            // 32767 (0.6, 0.8) = (19660.2, 26213.6); 4 * 19660 - 3 * 26213 = 1 is the least.
            ([0, -300, 0, -400], [0, -19_660, 0, -26_213]),
            ([32_767, 0, 0, 0], [32_767, 0, 0, 1]),
            ([0, 0, 0, -1], [0, 0, 0, -32_767]),
            ([16_383; 4], [16_383; 4]),
            ([-16_384; 4], [-16_384; 4]),
        ] {
            assert_eq!(QTangent.canonical::<f32>(words(there)), words(own), "{there:?}");
        }
    }

    #[test]
    fn the_greatest_of_equal_rows_is_the_first() {
        let row = |square: f32, c: f32| Row { square, row: [c; 4] };
        assert_eq!(row(1.0, 5.0).greater(row(1.0, 6.0)).row, [5.0; 4]);
        assert_eq!(row(1.0, 5.0).greater(row(2.0, 6.0)).row, [6.0; 4]);
    }
}
