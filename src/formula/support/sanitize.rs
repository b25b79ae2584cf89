//! Turns any input into a direction that formulas understand.

use crate::simd::{Simd, SimdInt, SimdMask, Vec3};

/// `v` itself, unless it is zero, NaN, infinite, huge or tiny. Those become +Z, +Z, the limit
/// direction, and `v` times a power of two.
///
/// The largest component is then from 2^-40 to 2^41.
#[inline(always)]
pub(crate) fn sanitize<V: Simd>(v: Vec3<V>) -> Vec3<V> {
    let magnitude = magnitude(v);
    let in_range = is_in_range(magnitude);
    let Vec3 { x, y, z } = v;
    // Keep the components in separate variables: as an array they would be spilled for the cold call.
    let (x, y, z) = if (!in_range).any() {
        let [x, y, z] = sanitize_degenerate([x, y, z], magnitude, in_range);
        (x, y, z)
    } else {
        (x, y, z)
    };
    Vec3 { x, y, z }
}

/// [`sanitize`] in four dimensions, where zero and NaN become +W.
#[inline(always)]
pub(crate) fn sanitize4<V: Simd>([x, y, z, w]: [V; 4]) -> [V; 4] {
    let last = w.abs().to_bits();
    let magnitude = V::from_bits(magnitude(Vec3::new(x, y, z)).to_bits().max(last));
    let in_range = is_in_range(magnitude);
    let (x, y, z, w) = if (!in_range).any() {
        let [x, y, z, w] = sanitize_degenerate([x, y, z, w], magnitude, in_range);
        (x, y, z, w)
    } else {
        (x, y, z, w)
    };
    [x, y, z, w]
}

/// Whether formulas understand a vector with this greatest |component|.
#[inline(always)]
fn is_in_range<V: Simd>(magnitude: V) -> V::Mask {
    const MIN: f32 = 9.094_947e-13; // 2^-40
    const MAX: f32 = 1.099_511_6e12; // 2^40
    V::splat(MIN).le(magnitude) & magnitude.le(MAX)
}

/// Greatest |component|; NaN if there is one.
#[inline(always)]
pub(crate) fn magnitude<V: Simd>(v: Vec3<V>) -> V {
    // Magnitudes are in the order of their bits, with infinity and then NaN last.
    let (x, y, z) = (v.x.abs().to_bits(), v.y.abs().to_bits(), v.z.abs().to_bits());
    V::from_bits(x.max(y).max(z))
}

/// Replaces degenerate vectors: zero and NaN by the last axis, infinite ones by their limit, others by
/// a multiple.
#[cold]
#[inline(never)]
fn sanitize_degenerate<V: Simd, const N: usize>(
    v: [V; N],
    magnitude: V,
    in_range: V::Mask,
) -> [V; N] {
    V::with_target_features(
        #[inline(always)]
        || {
            let infinite = V::splat(f32::INFINITY).le(magnitude);
            // The tiny times 2^72 or, near the subnormal (below 2^-104), 2^126; the huge down to 2^40,
            // so that no sign is lost that a smaller multiple would keep.
            let down =
                (V::Int::splat(127 + 40 + 127) - magnitude.to_bits().shr_logical(23)).shl(23);
            let up = V::select(magnitude.lt(4.930_380_7e-32), 8.507_059e37, 4.722_366_5e21);
            let scale = V::select(magnitude.lt(1.0), up, V::from_bits(down));
            let zero_or_nan = !V::splat(0.0).lt(magnitude);
            let mut sanitized = v;
            for (i, c) in sanitized.iter_mut().enumerate() {
                let at_infinity = V::splat(f32::INFINITY).le(c.abs());
                let limit = V::select(at_infinity, V::splat(1.0).negate_where_negative(*c), 0.0);
                let pole = if i + 1 == N { 1.0 } else { 0.0 };
                let finite = V::select(infinite, limit, *c * scale);
                *c = V::select(in_range, *c, V::select(zero_or_nan, pole, finite));
            }
            sanitized
        },
    )
}
