//! Spherical Fibonacci: N points on a spiral from +Z to -Z, a golden section of a turn apart.
//!
//! ```text
//! decode   z = 1 - (2 i + 1) / N, phi = 2 pi frac(i G / 2^32);  v = (sqrt(1 - z^2) cos phi, sqrt(1 - z^2) sin phi, z)
//! encode   the nearest point
//! ```
//!
//! with G = round(2^32 / golden ratio) = 0x9E3779B9, so that phi is exact in integers.
//!
//! Near a latitude the points form a lattice in index and azimuth. It is spanned by the steps of F and F' points,
//! two Fibonacci numbers in a row, which are turned by frac(F G / 2^32) and frac(F' G / 2^32): little, and in
//! opposite directions. Since F frac(F' g) - F' frac(F g) = +-1, t F' steps of the one and -t F of the other turn by t
//! and stay at the same latitude. So they lead from the point nearest to v's latitude to v's cell, up to a fifth of a
//! step. All four corners are looked at, so that this is near enough.
//! Which pair spans the squarest cells depends on N (1 - z^2) alone.
//!
//! Canonical: every index. Indices from N on read as N - 1. No axis survives exactly.
//!
//! Source: Keinert, Innmann, Sänger and Stamminger, "Spherical Fibonacci Mapping", 2015, which sums it up in
//! floating point; the integers are unitpack's.

use super::support::closest::Closest;
use super::{Formula, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{atan2_half_turns, sin_cos_quarter_turns, sqrt};
use crate::simd::{Simd, SimdInt, Vec3, map2};

/// Number of points, from 1 to 2^24.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Fibonacci {
    n: i32,
}

/// 2^32 over the golden ratio.
const G: i32 = 0x9E37_79B9_u32 as i32;

/// The Fibonacci numbers, from F(2) = 1 and F(3) = 2 on.
const NUMBERS: [u32; 20] = {
    let mut numbers = [1; 20];
    numbers[1] = 2;
    let mut i = 2;
    while i < numbers.len() {
        numbers[i] = numbers[i - 1] + numbers[i - 2];
        i += 1;
    }
    numbers
};

impl Fibonacci {
    pub(crate) const fn new(points: u32) -> Self {
        Fibonacci { n: points as i32 }
    }

    pub(crate) const fn points(self) -> u32 {
        self.n as u32
    }

    /// The index of the same point, below N.
    #[inline(always)]
    fn clamp<V: Simd>(self, index: V::Int) -> V::Int {
        let last = V::Int::splat(self.n - 1);
        V::Int::select(last.lt_unsigned(index), last, index)
    }

    /// Point `i`, from 0 to N - 1.
    #[inline(always)]
    fn point<V: Simd>(self, i: V::Int) -> Vec3<V> {
        let per_n = 1.0 / self.n as f32;
        // 1 - z and 1 + z.
        let odd = i + i + 1;
        let above = V::from_int(odd) * per_n;
        let below = V::from_int(V::Int::splat(2 * self.n) - odd) * per_n;
        let z = V::from_int(V::Int::splat(self.n) - odd) * per_n;
        let r = sqrt(above * below);
        let quarter_turns = V::from_int(i * G) * (1.0 / (1 << 30) as f32);
        let (sin, cos) = sin_cos_quarter_turns(quarter_turns);
        Vec3::new(r * cos, r * sin, z).normalize()
    }
}

impl Formula for Fibonacci {
    type Shape = Word;
    const ONE_ENCODER: bool = true;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let last = V::Int::splat(self.n - 1);
        let v = v.normalize();
        let Vec3 { x, y, z } = v;
        let rr = x * x + y * y;
        // The point nearest in latitude, counted from the pole of the own hemisphere, from whose side 1 - |z| is exact.
        let height = rr * (0.5 * self.n as f32) / (z.abs() + 1.0) - 0.5;
        let whole = height.round_int_wide();
        let start = V::Int::select(z.lt(0.0), last - whole, whole);
        // The turn from there to v, as a fraction of 2^32.
        let azimuth = (atan2_half_turns(y, x) * (1 << 24) as f32).round_int_wide().shl(7);
        let turn = azimuth - start * G;
        // The squarest cells are at about N pi sqrt(5) r^2 = golden ratio^(2 k).
        const PI_ROOT_5: f64 = core::f64::consts::PI * 2.236_067_977;
        let square = (rr * (PI_ROOT_5 * self.n as f64) as f32).max(1.0);
        let log2 = V::from_int(square.to_bits() - (127 << 23)) * (1.0 / (1 << 23) as f32);
        let k = (log2 * 0.720_21).floor().round_int().max(2);
        let number = V::gather(&NUMBERS, k - 2);
        let next = (V::from_int(number) * 1.618_034).round_int();
        const PER_TURN: f32 = 1.0 / 65536.0 / 65536.0;
        let turn = V::from_int(turn) * PER_TURN;
        // Every other Fibonacci number turns back.
        let turn = turn.negate_where_negative(V::from_int(number * G));
        let [a, b] = [turn * V::from_int(next), -turn * V::from_int(number)];
        let [a, b] = map2!([a, b], |c| c.floor().round_int());
        let corner = start + a * number + b * next;
        let mut closest = Closest::to_unit(v);
        for i in [corner, corner + next, corner + number, corner + number + next] {
            // Beyond a pole there is none.
            let i = i.clamp(0, self.n - 1);
            closest.consider(i, self.point(i));
        }
        closest.code()
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        self.point(self.clamp::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        if flips == [false; 3] {
            return self.clamp::<V>(code);
        }
        self.mirror_decoded::<V>(code, flips)
    }
}

kernels!(Fibonacci: Words);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::assert_nearest;

    #[test]
    fn four_points_are_a_golden_section_of_a_turn_apart() {
        // z = 3/4, 1/4, -1/4 and -3/4; 0, 222.49, 84.98 and 307.48 degrees.
        let points = [
            [0.661_437_8f32, 0.0, 0.75],
            [-0.713_954_3, -0.654_040_7, 0.25],
            [0.084_649_6, 0.964_538_5, -0.25],
            [0.402_444_5, -0.524_917_6, -0.75],
        ];
        let formula = Fibonacci::new(4);
        for (i, point) in (0..).zip(points) {
            let decoded = formula.decode::<f32>(i.into());
            assert!(decoded.distance_squared(point.into()) < 1e-12, "{decoded:?}");
            assert_eq!(formula.encode(Vec3::from(point) * 3.0).0, i);
        }
    }

    #[test]
    fn indices_beyond_the_last_read_as_the_last() {
        let formula = Fibonacci::new(1000);
        let last = formula.decode::<f32>(999.into());
        for index in [1000, i32::MAX, i32::MIN, -1] {
            assert_eq!(formula.decode::<f32>(index.into()), last);
            assert_eq!(formula.mirror::<f32>(index.into(), [false; 3]).0, 999);
        }
        assert_eq!(formula.mirror::<f32>(998.into(), [false; 3]).0, 998);
    }

    #[test]
    fn one_point_is_on_the_equator() {
        let formula = Fibonacci::new(1);
        assert_eq!(formula.decode::<f32>(0.into()).to_array(), [1.0, 0.0, 0.0]);
        assert_eq!(formula.encode(Vec3::new(-0.3f32, 0.2, 0.9)).0, 0);
    }

    #[test]
    fn the_numbers_are_those_of_fibonacci() {
        assert_eq!(NUMBERS[..7], [1, 2, 3, 5, 8, 13, 21]);
        assert_eq!(NUMBERS[19], 10_946);
    }

    #[test]
    fn of_all_points_the_nearest_is_found() {
        // Around both poles, and farther and farther from them.
        let vectors = (0u8..60).map(|turn| {
            let pole = if turn % 2 == 0 { 4.0 } else { -4.0 };
            let turn = f32::from(turn);
            let (sin, cos) = (turn * 0.7).sin_cos();
            [sin, cos, pole - 0.07 * turn]
        });
        for n in [5, 30, 1000] {
            assert_nearest(Fibonacci::new(n as u32), n, vectors.clone());
        }
    }

    #[test]
    fn every_index_is_canonical() {
        let formula = Fibonacci::new(1 << 24);
        for i in [0, 1, 2, 7, 1000, 8_388_607, 8_388_608, 16_777_214, 16_777_215] {
            assert_eq!(formula.encode(formula.decode::<f32>(i.into())).0, i);
            assert_eq!(formula.mirror::<f32>(i.into(), [false; 3]).0, i);
        }
    }
}
