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

use crate::formula::{Formula, One, closest_of_four, mirror_decoded};
use crate::lane::{Each, Lane, LaneInt};
use crate::layout::{pack2, unorm_max, unpack2};
use crate::math::{atan2_half_turns, normalize, sin_cos_quarter_turns, sqrt};

/// Phi-z in `BITS` bits.
pub(crate) struct PhiZ<const BITS: u32>;

impl<const BITS: u32> PhiZ<BITS> {
    const M: i32 = unorm_max(BITS / 2);

    /// The two parameters, scaled to M.
    #[inline(always)]
    fn params<L: Lane>(v: [L; 3]) -> [L; 2] {
        let [x, y, z] = normalize(v);
        let half = L::splat(0.5 * Self::M as f32);
        [atan2_half_turns(y, x) * half + half, z * half + half]
    }

    /// The nearest in range, canonical.
    #[inline(always)]
    fn canonical_params<L: Lane>([phi, z]: [L::Int; 2]) -> [L::Int; 2] {
        let (zero, max) = (L::Int::splat(0), L::Int::splat(Self::M));
        let z = z.max(zero).min(max);
        // The seam: 0 is the same as M, and one step below is one step back from M. None is above M.
        let phi = L::Int::select(zero.lt(phi), phi, phi + max);
        let pole = z.eq(zero) | z.eq(max);
        [L::Int::select(pole, L::Int::splat(Self::M / 2 + 1), phi), z]
    }

    #[inline(always)]
    fn vector<L: Lane>(params: [L::Int; 2]) -> [L; 3] {
        let max = L::Int::splat(Self::M);
        let [phi, z] = params.each(|i| i + i - max);
        let step = L::splat(1.0 / Self::M as f32);
        let (sin, cos) = sin_cos_quarter_turns(L::from_int(phi) * (step + step));
        // 1 - z^2, without cancellation.
        let rr = (L::from_int(max - z) * step) * (L::from_int(max + z) * step);
        let r = sqrt(rr);
        // The roundings of root, sine and cosine together may put the length off by more than 2.5e-7.
        normalize([r * cos, r * sin, L::from_int(z) * step])
    }
}

impl<const BITS: u32> Formula for PhiZ<BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<L: Lane>(v: [L; 3]) -> L::Int {
        let params = Self::params(v).each(|p| p.round_int());
        pack2::<BITS, L>(Self::canonical_params::<L>(params))
    }

    #[inline(always)]
    fn encode_precise<L: Lane>(v: [L; 3]) -> L::Int {
        closest_of_four(
            v,
            Self::params(v),
            #[inline(always)]
            |params| {
                let params = Self::canonical_params::<L>(params);
                (pack2::<BITS, L>(params), Self::vector::<L>(params))
            },
        )
    }

    #[inline(always)]
    fn decode<L: Lane>(code: L::Int) -> [L; 3] {
        Self::vector::<L>(unpack2::<BITS, L>(code))
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: L::Int) -> L::Int {
        pack2::<BITS, L>(Self::canonical_params::<L>(unpack2::<BITS, L>(code)))
    }

    #[inline(always)]
    fn mirror<L: Lane>(code: L::Int, flips: [bool; 3]) -> L::Int {
        if flips[0] {
            // Half a turn is no whole number of steps.
            return mirror_decoded::<Self, L>(code, flips);
        }
        let max = L::Int::splat(Self::M);
        let [phi, z] = unpack2::<BITS, L>(code);
        let phi = if flips[1] { max - phi } else { phi };
        let z = if flips[2] { max - z } else { z };
        pack2::<BITS, L>(Self::canonical_params::<L>([phi, z]))
    }
}
