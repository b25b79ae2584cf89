//! Bit layouts of codes.

use crate::simd::{Simd, SimdInt, map2};

/// Two parameters of half the bits each, the first in the low bits. At 24 bits, unless [`plain`](Pair::plain), the RGB8
/// bytes of the survey's Listing 4 (Cigolle et al. 2014): `[u >> 4, (u & 15) << 4 | v >> 8, v & 255]`.
#[derive(Clone, Copy)]
pub(crate) struct Pair {
    /// Bits of one parameter.
    half: u32,
    is_rgb8: bool,
}

impl Pair {
    /// Parameters of a code of `bits` bits.
    pub(crate) const fn new(bits: u32) -> Self {
        Pair { half: bits / 2, is_rgb8: bits == 24 }
    }

    /// Two's complement in the order of the bits, at 24 bits too.
    pub(crate) const fn plain(bits: u32) -> Self {
        Pair { half: bits / 2, is_rgb8: false }
    }

    /// Greatest snorm parameter M; the least is -M.
    pub(crate) const fn snorm_max(self) -> i32 {
        snorm_max(self.half)
    }

    /// Greatest unorm parameter.
    pub(crate) const fn unorm_max(self) -> i32 {
        unorm_max(self.half)
    }

    /// The low bits of two parameters.
    #[inline(always)]
    pub(crate) fn pack<V: Simd>(self, [u, v]: [V::Int; 2]) -> V::Int {
        if self.is_rgb8 {
            let green = u.low_bits(4).shl(4) | v.low_bits(12).shr_logical(8);
            u.low_bits(12).shr_logical(4) | green.shl(8) | v.low_bits(8).shl(16)
        } else {
            u.low_bits(self.half) | v.low_bits(self.half).shl(self.half)
        }
    }

    /// The parameters, without sign.
    #[inline(always)]
    pub(crate) fn unpack<V: Simd>(self, code: V::Int) -> [V::Int; 2] {
        if self.is_rgb8 {
            let u = code.low_bits(8).shl(4) | code.shr_logical(12).low_bits(4);
            let v = code.shr_logical(8).low_bits(4).shl(8) | code.shr_logical(16).low_bits(8);
            [u, v]
        } else {
            [code.low_bits(self.half), code.shr_logical(self.half).low_bits(self.half)]
        }
    }

    /// Two snorm parameters: two's complement, but at 24 bits biased by M as in the survey's listings.
    #[inline(always)]
    pub(crate) fn pack_snorm<V: Simd>(self, params: [V::Int; 2]) -> V::Int {
        if self.is_rgb8 {
            self.pack::<V>(map2!(params, |p| p + snorm_max(12)))
        } else {
            self.pack::<V>(params)
        }
    }

    /// The parameters of [`pack_snorm`](Pair::pack_snorm). The one pattern out of range reads as its
    /// neighbour.
    #[inline(always)]
    pub(crate) fn unpack_snorm<V: Simd>(self, code: V::Int) -> [V::Int; 2] {
        if self.is_rgb8 {
            map2!(self.unpack::<V>(code), |p| (p - snorm_max(12)).min(snorm_max(12)))
        } else {
            map2!([0, self.half], |at| snorm_field::<V>(code, at, self.half))
        }
    }
}

/// The snorm of `bits` bits above the lowest `at`. Its one pattern out of range reads as its
/// neighbour.
#[inline(always)]
pub(crate) fn snorm_field<V: Simd>(code: V::Int, at: u32, bits: u32) -> V::Int {
    // On top of the word, where what is below it changes nothing.
    let below = 32 - bits;
    code.shl(below - at).max(-snorm_max(bits) << below).shr_arithmetic(below)
}

/// 2^(bits-1) - 1: the greatest snorm of `bits` bits.
pub(crate) const fn snorm_max(bits: u32) -> i32 {
    (1 << (bits - 1)) - 1
}

/// 2^bits - 1: the greatest unorm of `bits` bits.
pub(crate) const fn unorm_max(bits: u32) -> i32 {
    ((1u64 << bits) - 1) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    #[test]
    fn snorm_pairs_come_back() {
        for bits in [8, 16, 22, 24, 32] {
            let pair = Pair::new(bits);
            let max = pair.snorm_max();
            for params in [[0, 0], [max, -max], [-1, 1], [-max, max], [5, -3]] {
                let code = pair.pack_snorm::<f32>(params.map(I32x1));
                assert_eq!(code.0 as u32 & !(u32::MAX >> (32 - bits)), 0);
                assert_eq!(pair.unpack_snorm::<f32>(code), params.map(I32x1));
            }
        }
    }

    #[test]
    fn plain_pairs_have_one_order_at_every_width() {
        let code = Pair::plain(24).pack_snorm::<f32>([I32x1(0x123), I32x1(-0x123)]);
        assert_eq!(code.0, 0xED_D123);
        for params in [[0, 0], [2047, -2047], [-1, 1]] {
            let code = Pair::plain(24).pack_snorm::<f32>(params.map(I32x1));
            assert_eq!(Pair::plain(24).unpack_snorm::<f32>(code), params.map(I32x1));
        }
        let [plain, usual] =
            [Pair::plain(22), Pair::new(22)].map(|p| p.pack_snorm::<f32>([I32x1(5), I32x1(-9)]));
        assert_eq!(plain, usual);
    }

    #[test]
    fn pairs_of_twelve_bits_are_the_bytes_of_the_survey() {
        let pair = Pair::new(24);
        let code = pair.pack::<f32>([I32x1(0xABC), I32x1(0xDEF)]);
        assert_eq!(code.0.to_le_bytes(), [0xAB, 0xCD, 0xEF, 0]);
        assert_eq!(pair.unpack::<f32>(code), [I32x1(0xABC), I32x1(0xDEF)]);
    }

    #[test]
    fn the_pattern_out_of_range_reads_as_its_neighbour() {
        let params = Pair::new(16).unpack_snorm::<f32>(I32x1(0x7F80));
        assert_eq!(params, [I32x1(-127), I32x1(127)]);
        let params = Pair::new(24).unpack_snorm::<f32>(I32x1(0x00FF_FFFF));
        assert_eq!(params, [I32x1(2047), I32x1(2047)]);
    }
}
