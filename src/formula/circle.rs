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

    /// The code of the nearest multiple to the direction (x, y), of which 0 counts as +X: ties to even.
    /// For components that are zero or from 2^-100 to 2^60. Above 24 bits the last ones are those of
    /// `f32` rounding.
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
        } else if bits <= 24 {
            eighths.shl(bits - 3) + rest.round_int()
        } else {
            // More than a float is rounded to at once. What the first rounding leaves is exact.
            let coarse = (rest * (1.0 / 256.0)).round_int();
            let fine = (rest - V::from_int(coarse) * 256.0).round_int();
            eighths.shl(bits - 3) + coarse.shl(8) + fine
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
