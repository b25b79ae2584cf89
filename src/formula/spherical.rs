//! Spherical: the polar angle and the azimuth.
//!
//! ```text
//! encode   theta = atan2(hypot(x, y), z), phi = atan2(y, x);  code = snorm(2 theta / pi - 1), snorm(phi / pi)
//! decode   v = (sin theta cos phi, sin theta sin phi, cos theta)
//! ```
//!
//! Canonical: at the poles the azimuth is 0; the azimuth of -X is +M, never -M. Survive exactly:
//! +-Z and +-X.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014. The angle of a vector near a pole comes from atan2, where acos(z) would lose half its
//! digits.

use crate::formula::bits::{pack_snorm2, snorm_max, unpack_snorm2};
use crate::formula::{Formula, One, closest_of_four, negate_if};
use crate::simd::math::{atan2_half_turns, sin_cos_of_one, sin_cos_quarter_turns, sqrt};
use crate::simd::{Each, Simd, SimdInt};

/// Spherical in `BITS` bits.
pub(crate) struct Spherical<const BITS: u32>;

impl<const BITS: u32> Spherical<BITS> {
    const M: i32 = snorm_max(BITS / 2);

    /// The two parameters, scaled to M.
    #[inline(always)]
    fn angles<V: Simd>([x, y, z]: [V; 3]) -> [V; 2] {
        let max = V::splat(Self::M as f32);
        let theta = atan2_half_turns(sqrt(x * x + y * y), z);
        let phi = atan2_half_turns(y, x);
        [(theta + theta - V::splat(1.0)) * max, phi * max]
    }

    #[inline(always)]
    fn pack<V: Simd>([u, w]: [V::Int; 2]) -> V::Int {
        let max = V::Int::splat(Self::M);
        let pole = u.abs().eq(max);
        // The seam: -M is +M, and one step beyond is one step back from +M. None is above +M.
        let w = V::Int::select((-max).lt(w), w, w + max + max);
        let w = V::Int::select(pole, V::Int::splat(0), w);
        pack_snorm2::<BITS, V>([u, w])
    }
}

impl<const BITS: u32> Formula for Spherical<BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        Self::pack::<V>(Self::angles(v).each(|p| p.round_int()))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        let max = V::Int::splat(Self::M);
        closest_of_four(
            v,
            Self::angles(v),
            #[inline(always)]
            |[u, w]| {
                let code = Self::pack::<V>([u.max(-max).min(max), w]);
                (code, Self::decode::<V>(code))
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        let [u, w] = unpack_snorm2::<BITS, V>(code);
        let step = 1.0 / Self::M as f32;
        let (sin_u, cos_u) = sin_cos_of_one(V::from_int(u) * V::splat(step));
        let (sin_phi, cos_phi) = sin_cos_quarter_turns(V::from_int(w) * V::splat(2.0 * step));
        [cos_u * cos_phi, cos_u * sin_phi, -sin_u]
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        Self::pack::<V>(unpack_snorm2::<BITS, V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, [x, y, z]: [bool; 3]) -> V::Int {
        let [u, w] = unpack_snorm2::<BITS, V>(code);
        let w = negate_if(w, y);
        // Half a turn less the azimuth.
        let max = V::Int::splat(Self::M);
        let half = V::Int::select(w.lt(V::Int::splat(0)), -max, max);
        let w = if x { half - w } else { w };
        Self::pack::<V>([negate_if(u, z), w])
    }
}
