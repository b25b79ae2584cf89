//! IEEE 754 half precision in lanes.

use crate::simd::{Simd, SimdInt};

/// The greatest finite half, 65504.
pub(crate) const GREATEST: i32 = 0x7BFF;
/// 1.0.
pub(crate) const ONE: i32 = 0x3C00;

/// A finite half as a sign and a magnitude in order: -5 is the half with bits 0x8005, 5 that with
/// bits 0x0005. There is one zero.
///
/// The nearest to `x`, ties to even, for |x| < 65520.
#[inline(always)]
pub(crate) fn nearest<V: Simd>(x: V) -> V::Int {
    let bits = x.abs().to_bits();
    // Normal: round the 13 low bits of the mantissa away, then move the exponent's bias from 127 to
    // 15.
    let even = bits.shr_logical(13).low_bits(1);
    let normal = (bits + 0xFFF + even).shr_logical(13) - (112 << 10);
    // Subnormal: in [0.5, 1) the mantissa counts units of 2^-24.
    let subnormal = (x.abs() + 0.5).to_bits() - 0.5f32.to_bits() as i32;
    const MIN_NORMAL: i32 = 113 << 23; // 2^-14
    let magnitude = V::Int::select(bits.lt(MIN_NORMAL), subnormal, normal);
    V::Int::select(x.lt(0.0), -magnitude, magnitude)
}

/// The value of an ordered half. For |i| <= [`GREATEST`].
#[inline(always)]
pub(crate) fn value<V: Simd>(i: V::Int) -> V {
    let magnitude = i.abs();
    let normal = V::from_bits(magnitude.shl(13) + (112 << 23));
    let subnormal = V::from_int(magnitude) * (1.0 / 16_777_216.0);
    let v = V::select(magnitude.lt(0x400), subnormal, normal);
    V::select(i.lt(0), -v, v)
}

/// The mantissa of an ordered half, with its hidden bit: below 2^11.
#[inline(always)]
pub(crate) fn mantissa<V: Simd>(i: V::Int) -> V::Int {
    const HIDDEN: i32 = 0x400;
    let magnitude = i.abs();
    V::Int::select(magnitude.lt(HIDDEN), magnitude, magnitude.low_bits(10) | HIDDEN)
}

/// The bits of an ordered half.
#[inline(always)]
pub(crate) fn to_bits<V: Simd>(i: V::Int) -> V::Int {
    i.abs() | (i & i32::MIN).shr_logical(16)
}

/// The ordered half of any 16 bits. Its magnitude is clamped to `greatest`, that of infinities and NaN
/// too.
#[inline(always)]
pub(crate) fn from_bits<V: Simd>(bits: V::Int, greatest: i32) -> V::Int {
    let magnitude = bits.low_bits(15).min(greatest);
    let sign = bits.sign_extend(16).shr_arithmetic(31);
    (magnitude ^ sign) - sign
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;
    use ::half::f16;

    #[test]
    fn every_finite_half_has_its_value_and_its_bits() {
        for bits in (0..=0x7BFFu16).chain(0x8000..=0xFBFF) {
            let i = from_bits::<f32>(I32x1(i32::from(bits)), GREATEST);
            assert_eq!(value::<f32>(i), f16::from_bits(bits).to_f32());
            let back = if bits == 0x8000 { 0 } else { bits };
            assert_eq!(to_bits::<f32>(i).0, i32::from(back));
            assert_eq!(nearest(f16::from_bits(bits).to_f32()), i);
        }
    }

    #[test]
    fn magnitudes_are_cut() {
        for (bits, cut) in [(0x7C00, 0x7BFF), (0x7E01, 0x7BFF), (0xFFFF, -0x7BFF)] {
            assert_eq!(from_bits::<f32>(I32x1(bits), GREATEST).0, cut);
        }
        assert_eq!(from_bits::<f32>(I32x1(0xC000), ONE).0, -ONE);
    }

    #[test]
    fn rounding_is_to_nearest_even() {
        // Every half, every midpoint between two, and the floats next to each.
        for bits in 0..0x7BFFu16 {
            let (a, b) = (f16::from_bits(bits).to_f32(), f16::from_bits(bits + 1).to_f32());
            for centre in [a, (a + b) / 2.0] {
                for x in [centre.next_down(), centre, centre.next_up()] {
                    let i =
                        from_bits::<f32>(I32x1(i32::from(f16::from_f32(x).to_bits())), GREATEST);
                    assert_eq!(nearest(x), i, "{x:e}");
                    assert_eq!(nearest(-x), -i, "{x:e}");
                }
            }
        }
    }
}
