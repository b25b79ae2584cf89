//! Where the parameters of a code stand among its bits.

use crate::simd::{Each, Simd, SimdInt};

/// Two parameters of `BITS / 2` bits each: the first in the low bits. At 24 bits, the RGB8 bytes of
/// the survey's Listing 4 (Cigolle et al. 2014): `[u >> 4, (u & 15) << 4 | v >> 8, v & 255]`.
#[inline(always)]
pub(crate) fn pack2<const BITS: u32, V: Simd>([u, v]: [V::Int; 2]) -> V::Int {
    if BITS == 24 {
        u.low(12).shr(4) | (u.low(4).shl(4) | v.low(12).shr(8)).shl(8) | v.low(8).shl(16)
    } else {
        u.low(BITS / 2) | v.low(BITS / 2).shl(BITS / 2)
    }
}

/// The parameters of [`pack2`], without sign.
#[inline(always)]
pub(crate) fn unpack2<const BITS: u32, V: Simd>(code: V::Int) -> [V::Int; 2] {
    if BITS == 24 {
        [code.low(8).shl(4) | code.shr(12).low(4), code.shr(8).low(4).shl(8) | code.shr(16).low(8)]
    } else {
        [code.low(BITS / 2), code.shr(BITS / 2).low(BITS / 2)]
    }
}

/// 2^(bits-1) - 1: the greatest snorm of so many bits.
pub(crate) const fn snorm_max(bits: u32) -> i32 {
    (1 << (bits - 1)) - 1
}

/// 2^bits - 1: the greatest unorm of so many bits.
pub(crate) const fn unorm_max(bits: u32) -> i32 {
    ((1u64 << bits) - 1) as i32
}

/// Two snorm parameters, each from -M to M with M = 2^(BITS/2 - 1) - 1: two's complement, but at 24
/// bits biased by M as the survey's listings have it.
#[inline(always)]
pub(crate) fn pack_snorm2<const BITS: u32, V: Simd>(params: [V::Int; 2]) -> V::Int {
    if BITS == 24 {
        let bias = V::Int::splat(snorm_max(12));
        pack2::<BITS, V>(params.each(|p| p + bias))
    } else {
        pack2::<BITS, V>(params)
    }
}

/// The parameters of [`pack_snorm2`]. The one pattern out of range reads as its neighbour.
#[inline(always)]
pub(crate) fn unpack_snorm2<const BITS: u32, V: Simd>(code: V::Int) -> [V::Int; 2] {
    let max = V::Int::splat(snorm_max(BITS / 2));
    if BITS == 24 {
        unpack2::<BITS, V>(code).each(|p| (p - max).min(max))
    } else {
        [code, code.shr(BITS / 2)].each(|p| p.sign_extend(BITS / 2).max(-max))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::num::Wrapping;

    fn round_trip<const BITS: u32>() {
        let max = snorm_max(BITS / 2);
        for [u, w] in [[0, 0], [max, -max], [-1, 1], [-max, max], [5, -3]] {
            let code = pack_snorm2::<BITS, f32>([Wrapping(u), Wrapping(w)]);
            assert_eq!(code.0 as u32 & !(u32::MAX >> (32 - BITS)), 0);
            assert_eq!(unpack_snorm2::<BITS, f32>(code).map(|p| p.0), [u, w]);
        }
    }

    #[test]
    fn snorm_pairs_come_back() {
        round_trip::<8>();
        round_trip::<16>();
        round_trip::<22>();
        round_trip::<24>();
        round_trip::<32>();
    }

    #[test]
    fn pairs_of_twelve_bits_stand_in_three_bytes_as_the_survey_has_them() {
        let code = pack2::<24, f32>([Wrapping(0xABC), Wrapping(0xDEF)]);
        assert_eq!(code.0.to_le_bytes(), [0xAB, 0xCD, 0xEF, 0]);
        assert_eq!(unpack2::<24, f32>(code).map(|p| p.0), [0xABC, 0xDEF]);
    }

    #[test]
    fn the_pattern_out_of_range_reads_as_its_neighbour() {
        assert_eq!(unpack_snorm2::<16, f32>(Wrapping(0x7F80)).map(|p| p.0), [-127, 127]);
        let biased = Wrapping(0x00FF_FFFF);
        assert_eq!(unpack_snorm2::<24, f32>(biased).map(|p| p.0), [2047, 2047]);
    }
}
