//! What integers have in common.

use crate::simd::{Simd, SimdMask, Vec3};

/// The greatest common divisor of three integers from 0 to 2^16, not all of them zero.
#[inline(always)]
pub(crate) fn gcd<V: Simd>(numbers: Vec3<V>) -> V {
    /// What is left of x, or what it lacks of one more divisor.
    #[inline(always)]
    fn rest<V: Simd>(x: V, by: V, per: V) -> V {
        (x - (x * per).round() * by).abs()
    }
    let zero = V::splat(0.0);
    let Vec3 { x: mut a, y: mut b, z: mut c } = numbers;
    loop {
        let (least, most) = (b.min(c), b.max(c));
        if !zero.lt(most).any() {
            return a;
        }
        // By the least that is not zero.
        let by = V::select(zero.lt(least), least, V::select(zero.lt(most), most, a));
        let per = V::splat(1.0) / by;
        (a, b, c) = (by, rest(a, by, per), rest(most, by, per));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_common_divisor_is_that_of_all_three() {
        for (numbers, divisor) in [
            ([12, 18, 30], 6),
            ([0, 0, 5], 5),
            ([7, 0, 0], 7),
            ([0, 21, 14], 7),
            ([65_535, 65_534, 0], 1),
            ([32_767, 32_767, 32_767], 32_767),
            ([46_368, 28_657, 0], 1),
            ([65_536, 49_152, 16_384], 16_384),
        ] {
            assert_eq!(gcd(Vec3::from(numbers.map(|n| n as f32))), divisor as f32);
        }
    }
}
