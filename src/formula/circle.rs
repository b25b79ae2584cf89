//! Directions in the plane: multiples of an angle.
//!
//! ```text
//! encode   k = round(atan2(y, x) 2^BITS / (2 pi)) mod 2^BITS
//! decode   v = (cos, sin)(2 pi k / 2^BITS)
//! ```

use crate::simd::math::{
    angle_in_octant, sin_cos_of_half, sin_cos_quarter_turns, turn_by_quarters,
};
use crate::simd::{Simd, SimdInt, map2};

/// Angles of 2^-BITS turns.
#[derive(Clone, Copy)]
pub(crate) struct Circle {
    bits: u32,
}

/// An angle in the first octants: a number of eighths of a turn, and a rest in half turns.
struct Eighths<V: Simd> {
    eighths: V::Int,
    rest: V,
}

impl<V: Simd> Eighths<V> {
    /// `sum` eighths minus the angle, in some lanes.
    #[inline(always)]
    fn mirror_where(self, mask: V::Mask, sum: i32) -> Self {
        Eighths {
            eighths: V::Int::select(mask, V::Int::splat(sum) - self.eighths, self.eighths),
            rest: V::select(mask, -self.rest, self.rest),
        }
    }
}

impl Circle {
    /// From 1 to 31 bits.
    pub(crate) const fn new(bits: u32) -> Self {
        Circle { bits }
    }

    pub(crate) const fn bits(self) -> u32 {
        self.bits
    }

    /// The code of the nearest multiple to the direction (x, y), of which 0 counts as +X: ties to even.
    /// For components that are zero or from 2^-100 to 2^60, and at most 24 bits.
    #[inline(always)]
    pub(crate) fn nearest<V: Simd>(self, [x, y]: [V; 2]) -> V::Int {
        let bits = self.bits;
        let (ax, ay) = (x.abs(), y.abs());
        // No digit of a long code is lost.
        let (steep, rest) = angle_in_octant(ax, ay);
        let Eighths { eighths, rest } = Eighths { eighths: V::Int::select(steep, 1, 0), rest }
            .mirror_where(ax.lt(ay), 2)
            .mirror_where(x.lt(0.0), 4)
            .mirror_where(y.lt(0.0), 0);
        let rest = rest * (1u32 << (bits - 1)) as f32;
        let k = if bits < 3 {
            let eighth = if bits == 1 { 0.25 } else { 0.5 };
            (V::from_int(eighths) * eighth + rest).round_int()
        } else {
            eighths.shl(bits - 3) + rest.round_int()
        };
        k.low_bits(bits)
    }

    /// (cos, sin) of the multiple in the low bits of a code, each with error below 1.2e-7, and without
    /// negative zeros.
    #[inline(always)]
    pub(crate) fn direction<V: Simd>(self, code: V::Int) -> [V; 2] {
        let bits = self.bits;
        let k = code.sign_extend(bits);
        let (sin, cos) = if bits <= 24 {
            // Exact, as is its distance from the nearest quarter turn.
            sin_cos_quarter_turns(V::from_int(k) * (2.0 / (1u32 << (bits - 1)) as f32))
        } else {
            // The nearest quarter turn in integers, as a float has fewer digits; then the rest.
            let quarter = (k + (1 << (bits - 3))).shr_arithmetic(bits - 2);
            let rest = V::from_int(k - quarter.shl(bits - 2));
            let rest = rest * (1.0 / (1u32 << (bits - 2)) as f32);
            turn_by_quarters(quarter, sin_cos_of_half(rest))
        };
        map2!([cos, sin], |c| c + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nearest(bits: u32, x: f32, y: f32) -> i32 {
        Circle::new(bits).nearest([x, y]).0
    }

    #[test]
    fn angles_are_counted_from_x_to_y() {
        let eighths = [
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [-1.0, 1.0],
            [-1.0, 0.0],
            [-1.0, -1.0],
            [0.0, -1.0],
        ];
        for (n, [x, y]) in (0..).zip(eighths) {
            assert_eq!(nearest(8, x, y), 32 * n);
            assert_eq!(nearest(24, 3.0 * x, 3.0 * y), n << 21);
        }
        // 30 degrees are 256 / 12 = 21.3 steps, and -30 degrees 234.7.
        assert_eq!([nearest(8, 0.866, 0.5), nearest(8, 0.866, -0.5)], [21, 235]);
        assert_eq!([nearest(8, 1.0, -0.001), nearest(8, 0.0, 0.0)], [0, 0]);
    }

    #[test]
    fn ties_go_to_even() {
        let diagonals = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        assert_eq!(diagonals.map(|[x, y]| nearest(2, x, y)), [0, 2, 2, 0]);
        assert_eq!([nearest(1, 0.0, 1.0), nearest(1, 0.0, -1.0), nearest(1, -1.0, 1.0)], [0, 0, 1]);
    }

    #[test]
    fn long_codes_are_as_fine_as_f32() {
        // atan(3/4) is 0.10241638235 of a turn.
        assert_eq!(nearest(24, 4.0, 3.0), 1_718_262);
    }

    #[test]
    fn quarters_decode_exactly_and_without_negative_zeros() {
        for bits in [2, 8, 24, 25, 31] {
            let circle = Circle::new(bits);
            let quarters = [[1.0f32, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
            for (n, quarter) in (0..).zip(quarters) {
                let decoded = circle.direction::<f32>((n << (bits - 2)).into());
                assert_eq!(decoded.map(f32::to_bits), quarter.map(f32::to_bits));
            }
        }
    }

    #[test]
    fn only_the_low_bits_count() {
        // 32 of 256 are 45 degrees.
        let [x, y] = Circle::new(8).direction::<f32>(0x7FFF_FF20.into());
        let half = core::f32::consts::FRAC_1_SQRT_2;
        assert!((x - half).abs() < 2e-7 && (y - half).abs() < 2e-7);
    }

    #[test]
    fn one_step_of_a_long_code_is_seen() {
        // 2 pi / 2^31.
        let [x, y] = Circle::new(31).direction::<f32>(1.into());
        assert!(x == 1.0 && (y / 2.925_836_2e-9 - 1.0).abs() < 1e-6);
        let [x, y] = Circle::new(31).direction::<f32>(((1 << 29) + 1).into());
        assert!((x / -2.925_836_2e-9 - 1.0).abs() < 1e-6 && y == 1.0);
    }
}
