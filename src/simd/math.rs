//! Roots and trigonometry, written once for any number of lanes, from exact operations only.
//!
//! Arc tangents are in half turns: 1 is 180 degrees; sine and cosine take quarter turns. The
//! polynomials interpolate at Chebyshev nodes.

use super::{Simd, SimdInt};

/// 1/sqrt(x) for normal x > 0, with relative error below 1.1e-7; exact at 1. A large finite number
/// at 0.
///
/// A first guess from the exponent (Jan Kadlec, "Rychla inverzni odmocnina", 2010: error 6.5e-4),
/// then one step of Householder's method of third order. No division and no square root, so it
/// costs the same order of time everywhere, also where there is no hardware for either.
#[inline(always)]
pub(crate) fn inv_sqrt<V: Simd>(x: V) -> V {
    let guess = V::from_bits(V::Int::splat(0x5F1F_FFF9) - x.to_bits().shr_logical(1));
    let y = (guess * 0.703_952_25) * (V::splat(2.389_244_6) - (x * guess) * guess);
    let e = V::splat(1.0) - (x * y) * y;
    y + y * (e * (e * 0.375 + 0.5))
}

/// sqrt(x) for x = 0 or normal x > 0, with relative error below 1.5e-7; exact at 0 and 1.
#[inline(always)]
pub(crate) fn sqrt<V: Simd>(x: V) -> V {
    x * inv_sqrt(x)
}

/// `c[0] + c[1] x + c[2] x^2 + ...`, by Horner's rule.
#[inline(always)]
pub(crate) fn horner<V: Simd, const N: usize>(x: V, coefficients: [f32; N]) -> V {
    let mut sum = V::splat(coefficients[N - 1]);
    for c in coefficients[..N - 1].iter().rev() {
        sum = x * sum + *c;
    }
    sum
}

/// (sin, cos) of |x| <= 4 quarter turns, with error below 1.2e-7; exact at whole ones.
#[inline(always)]
pub(crate) fn sin_cos_quarter_turns<V: Simd>(x: V) -> (V, V) {
    // Nearest quarter turn, and what is left of it.
    let quarter = x.round_int();
    turn_by_quarters(quarter, sin_cos_of_half(x - V::from_int(quarter)))
}

/// The (sin, cos) of an angle, turned by a number of quarters.
#[inline(always)]
pub(crate) fn turn_by_quarters<V: Simd>(quarter: V::Int, (sin, cos): (V, V)) -> (V, V) {
    /// Negated where bit 1 of `quarter` is set.
    #[inline(always)]
    fn signed<V: Simd>(quarter: V::Int, v: V) -> V {
        V::from_bits(v.to_bits() ^ (quarter & 2).shl(30))
    }
    let odd = quarter.low_bits(1).eq(1);
    let (sin, cos) = (V::select(odd, cos, sin), V::select(odd, sin, cos));
    (signed(quarter, sin), signed(quarter + 1, cos))
}

/// [`sin_cos_quarter_turns`] for |x| <= 1, where a cosine of 0 is positive.
#[inline(always)]
pub(crate) fn sin_cos_of_one<V: Simd>(x: V) -> (V, V) {
    let magnitude = x.abs();
    // Mirror into the nearer half, and back.
    let complement = V::splat(1.0) - magnitude;
    let (sin, cos) = sin_cos_of_half(magnitude.min(complement));
    let mirrored = complement.lt(magnitude);
    let (sin, cos) = (V::select(mirrored, cos, sin), V::select(mirrored, sin, cos));
    let sign = x.to_bits() & i32::MIN;
    (V::from_bits(sin.to_bits() | sign), cos)
}

/// [`sin_cos_quarter_turns`] for |x| <= 1/2.
#[inline(always)]
pub(crate) fn sin_cos_of_half<V: Simd>(x: V) -> (V, V) {
    const SIN: [f32; 5] = [
        core::f32::consts::FRAC_PI_2,
        -5.167_713 / 8.0,
        2.550_162_6 / 32.0,
        -0.599_202_1 / 128.0,
        0.081_001_63 / 512.0,
    ];
    const COS: [f32; 5] =
        [1.0, -4.934_802 / 4.0, 4.058_710_6 / 16.0, -1.335_137_8 / 64.0, 0.232_125_41 / 256.0];
    let xx = x * x;
    (x * horner(xx, SIN), horner(xx, COS))
}

/// The angle of (x, y) in half turns, in (-1, 1], with error below 1.5e-7; 0 at (0, 0). Zeros have
/// no sign. Exact on the axes and the diagonals. For components that are zero or from 2^-100 to
/// 2^60.
#[inline(always)]
pub(crate) fn atan2_half_turns<V: Simd>(y: V, x: V) -> V {
    let (ax, ay) = (x.abs(), y.abs());
    let (steep, a) = angle_in_octant(ax, ay);
    let a = V::select(steep, a + 0.25, a);
    // Back to the whole turn.
    let a = V::select(ax.lt(ay), V::splat(0.5) - a, a);
    let a = V::select(x.lt(0.0), V::splat(1.0) - a, a);
    a.negate_where_negative(y)
}

/// The angle between (ax, ay) and the nearer axis in half turns, for components >= 0. Where it is
/// steep, a quarter is subtracted: the angle from the diagonal, which is negative. So it is from -1/8
/// to 1/8, with relative error below 3e-7.
#[inline(always)]
pub(crate) fn angle_in_octant<V: Simd>(ax: V, ay: V) -> (V::Mask, V) {
    const ATAN: [f32; 5] =
        [core::f32::consts::FRAC_1_PI, -0.106_101_55, 0.063_579_48, -0.044_081_114, 0.025_389_325];
    let (long, short) = (ax.max(ay), ax.min(ay));
    // Above tan(22.5 degrees), measure from the diagonal: atan(s/l) = 45 degrees +
    // atan((s-l)/(s+l)).
    let steep = (long * 0.414_213_57).lt(short);
    let over = V::select(steep, short - long, short);
    let under = V::select(steep, short + long, long);
    let t = over / under.max(f32::MIN_POSITIVE);
    (steep, t * horner(t * t, ATAN))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Greatest of `error(x)` over evenly spaced x.
    fn greatest(from: f32, to: f32, count: u32, error: impl Fn(f32) -> f64) -> f64 {
        (0..=count)
            .map(|i| from + (to - from) * (i as f32 / count as f32))
            .map(error)
            .fold(0.0, f64::max)
    }

    #[test]
    fn inverse_root_meets_its_bound_for_every_mantissa() {
        for bits in 0x3F80_0000u32..0x4080_0000 {
            let x = f32::from_bits(bits);
            let exact = 1.0 / f64::from(x).sqrt();
            assert!((f64::from(inv_sqrt(x)) / exact - 1.0).abs() < 1.1e-7, "{x}");
            let root = f64::from(x).sqrt();
            assert!((f64::from(sqrt(x)) / root - 1.0).abs() < 1.5e-7, "{x}");
        }
    }

    #[test]
    fn inverse_root_scales_by_exact_powers_of_two() {
        for x in [1.0f32, 1.5, 1.999, 2.0, 3.999] {
            for k in -60..=60 {
                let scale = 2f32.powi(k);
                assert_eq!(inv_sqrt(x * scale * scale) * scale, inv_sqrt(x), "{x} 2^{k}");
            }
        }
    }

    #[test]
    fn roots_are_exact_at_zero_and_one() {
        assert_eq!([sqrt(0.0f32), sqrt(1.0f32), inv_sqrt(1.0f32)], [0.0, 1.0, 1.0]);
        assert!(inv_sqrt(0.0f32).is_finite());
    }

    #[test]
    fn sine_and_cosine_meet_their_bound() {
        let error = |x: f32| {
            let (es, ec) = (PI / 2.0 * f64::from(x)).sin_cos();
            let off = |(s, c)| (f64::from(s) - es).abs().max((f64::from(c) - ec).abs());
            let of_one = if x.abs() <= 1.0 { off(sin_cos_of_one(x)) } else { 0.0 };
            off(sin_cos_quarter_turns(x)).max(of_one)
        };
        let worst = greatest(-4.0, 4.0, 4_000_000, error);
        assert!(worst < 1.2e-7, "{worst:e}");
    }

    #[test]
    fn sine_and_cosine_are_exact_at_quarter_turns() {
        let got = [-2.0f32, -1.0, 0.0, 1.0, 2.0].map(sin_cos_quarter_turns);
        assert_eq!(got, [(0.0, -1.0), (-1.0, 0.0), (0.0, 1.0), (1.0, 0.0), (0.0, -1.0)]);
        let got = [-1.0f32, 0.0, 1.0].map(sin_cos_of_one);
        assert_eq!(got, [(-1.0, 0.0), (0.0, 1.0), (1.0, 0.0)]);
        assert!(got.iter().all(|(_, cos)| cos.is_sign_positive()));
    }

    #[test]
    fn arc_tangent_meets_its_bound_all_around() {
        for radius in [1e-12f32, 1.0, 1e12] {
            let error = |t: f32| {
                let (y, x) = (PI * f64::from(t)).sin_cos();
                let (x, y) = (x as f32 * radius, y as f32 * radius);
                let exact = f64::from(y).atan2(f64::from(x)) / PI;
                (f64::from(atan2_half_turns(y, x)) - exact).abs()
            };
            let worst = greatest(-1.0, 1.0, 2_000_000, error);
            assert!(worst < 1.5e-7, "{worst:e}");
        }
    }

    #[test]
    fn angle_in_octant_meets_its_relative_bound() {
        let error = |x: f32| {
            let (y, x) = (f64::from(x).tan() as f32, 1.0f32);
            let (steep, a) = angle_in_octant(x, y);
            let exact = f64::from(y).atan2(1.0) / PI - if steep { 0.25 } else { 0.0 };
            if exact == 0.0 { f64::from(a) } else { (f64::from(a) / exact - 1.0).abs() }
        };
        let worst = greatest(0.0, core::f32::consts::FRAC_PI_4, 2_000_000, error);
        assert!(worst < 3e-7, "{worst:e}");
    }

    #[test]
    fn arc_tangent_is_exact_on_axes_and_diagonals_and_zero_has_no_sign() {
        let at = |y: f32, x: f32| atan2_half_turns(y, x);
        assert_eq!(
            [at(0.0, 1.0), at(1.0, 0.0), at(-1.0, 0.0), at(0.0, -1.0)],
            [0.0, 0.5, -0.5, 1.0]
        );
        assert_eq!([at(-0.0, -1.0), at(-0.0, -0.0), at(0.0, 0.0)], [1.0, 0.0, 0.0]);
        assert_eq!([at(1.0, 1.0), at(1.0, -1.0), at(-1.0, -1.0)], [0.25, 0.75, -0.75]);
    }
}
