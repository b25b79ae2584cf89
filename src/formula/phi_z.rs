//! Phi-z: the azimuth and z, each as biased unorm, (c + 1) / 2.
//!
//! ```text
//! encode   code = unorm((atan2(y, x) / pi + 1) / 2), unorm((z + 1) / 2)
//! decode   v = (sqrt(1 - z^2) cos phi, sqrt(1 - z^2) sin phi, z)
//! ```
//!
//! Canonical: at the poles the azimuth is the first above 0; that of -X is the greatest. Of the
//! axes, +-Z survive exactly, and -X at z = 0 would if unorm had a zero.
//!
//! Source: Narkowicz, "Octahedron Normal Vector Encoding", 2014 (spherical coordinates).

use crate::formula::bits::{pack2, unorm_max, unpack2};
use crate::formula::{Formula, One, closest_of_four, mirror_decoded};
use crate::simd::math::{atan2_half_turns, normalize, sin_cos_quarter_turns, sqrt};
use crate::simd::{Each, Simd, SimdInt};

/// Phi-z in `BITS` bits.
pub(crate) struct PhiZ<const BITS: u32>;

impl<const BITS: u32> PhiZ<BITS> {
    const M: i32 = unorm_max(BITS / 2);

    /// The two parameters, scaled to M.
    #[inline(always)]
    fn params<V: Simd>(v: [V; 3]) -> [V; 2] {
        let [x, y, z] = normalize(v);
        let half = V::splat(0.5 * Self::M as f32);
        [atan2_half_turns(y, x) * half + half, z * half + half]
    }

    /// The nearest in range, canonical.
    #[inline(always)]
    fn canonical_params<V: Simd>([phi, z]: [V::Int; 2]) -> [V::Int; 2] {
        let (zero, max) = (V::Int::splat(0), V::Int::splat(Self::M));
        let z = z.max(zero).min(max);
        // The seam: 0 is the same as M, and one step below is one step back from M. None is above M.
        let phi = V::Int::select(zero.lt(phi), phi, phi + max);
        let pole = z.eq(zero) | z.eq(max);
        [V::Int::select(pole, V::Int::splat(Self::M / 2 + 1), phi), z]
    }

    #[inline(always)]
    fn vector<V: Simd>(params: [V::Int; 2]) -> [V; 3] {
        let max = V::Int::splat(Self::M);
        let [phi, z] = params.each(|i| i + i - max);
        let step = V::splat(1.0 / Self::M as f32);
        let (sin, cos) = sin_cos_quarter_turns(V::from_int(phi) * (step + step));
        // 1 - z^2, without cancellation.
        let rr = (V::from_int(max - z) * step) * (V::from_int(max + z) * step);
        let r = sqrt(rr);
        // The roundings of root, sine and cosine together may put the length off by more than 2.5e-7.
        normalize([r * cos, r * sin, V::from_int(z) * step])
    }
}

impl<const BITS: u32> Formula for PhiZ<BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        let params = Self::params(v).each(|p| p.round_int());
        pack2::<BITS, V>(Self::canonical_params::<V>(params))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        closest_of_four(
            v,
            Self::params(v),
            #[inline(always)]
            |params| {
                let params = Self::canonical_params::<V>(params);
                (pack2::<BITS, V>(params), Self::vector::<V>(params))
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        Self::vector::<V>(unpack2::<BITS, V>(code))
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        pack2::<BITS, V>(Self::canonical_params::<V>(unpack2::<BITS, V>(code)))
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        if flips[0] {
            // Half a turn is no whole number of steps.
            return mirror_decoded::<Self, V>(code, flips);
        }
        let max = V::Int::splat(Self::M);
        let [phi, z] = unpack2::<BITS, V>(code);
        let phi = if flips[1] { max - phi } else { phi };
        let z = if flips[2] { max - z } else { z };
        pack2::<BITS, V>(Self::canonical_params::<V>([phi, z]))
    }
}
