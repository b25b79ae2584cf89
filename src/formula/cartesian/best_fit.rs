//! Crytek's best-fit normals.

use super::{Grid, Xyz};
use crate::batch::storage::Word;
use crate::formula::Formula;
use crate::simd::{Simd, SimdInt, Vec3};

/// Crytek's best-fit normals: the codes of unorm8x3, its fast encoder reading the length from a
/// table.
///
/// With a >= b >= c the magnitudes, the table over (b / a, c / b) has the length, (2 k - 1) / 255
/// on the largest component, with which rounding points closest to the middle of its texel. 512 x
/// 512 bytes.
#[derive(Clone, Copy)]
pub(crate) struct BestFit;

static BEST_FIT: &[u8; 512 * 512] = include_bytes!(concat!(env!("OUT_DIR"), "/best_fit.bin"));

impl BestFit {
    pub(super) const UNORM8: Xyz = Xyz::unorm(8);

    pub(crate) const fn new() -> Self {
        BestFit
    }
}

impl Formula for BestFit {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        /// From 0 to 1 to the texel.
        #[inline(always)]
        fn texel<V: Simd>(t: V) -> V::Int {
            (t * 512.0).floor().round_int().min(511)
        }
        let Vec3 { x, y, z } = v.abs();
        let (a, rest) = (x.max(y), x.min(y));
        let (a, b, c) = (a.max(z), a.min(z).max(rest), rest.min(z));
        let (u, w) = (texel(b / a), texel(c / b.max(1e-30)));
        let largest = V::from_int(V::gather(BEST_FIT, w.shl(9) + u));
        let scale = largest * (1.0 / 255.0) / a;
        let point = Self::UNORM8.nearest(v * scale);
        Self::UNORM8.0.pack::<V>(Self::UNORM8.0.representative::<V>(point))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        Self::UNORM8.encode_precise(v)
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        Self::UNORM8.decode(code)
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        Self::UNORM8.mirror::<V>(code, flips)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn off(code: i32, v: [f32; 3]) -> f32 {
        BestFit.decode::<f32>(code.into()).distance_squared(Vec3::from(v).normalize())
    }

    #[test]
    fn bits_are_those_of_unorm() {
        assert_eq!(
            BestFit.decode::<f32>(0xBD_D1CC.into()),
            BestFit::UNORM8.decode(0xBD_D1CC.into())
        );
        assert_eq!(BestFit.mirror::<f32>(0x80_8080.into(), [false; 3]).0, 0xC9_C9C9);
    }

    #[test]
    fn the_table_gives_the_best_length() {
        // The corner is exact. Nearest to the pole is (1, 1, 255), as there is no zero.
        assert_eq!(BestFit.encode(Vec3::new(1.0f32, 1.0, 1.0)).0, 0xC9_C9C9);
        assert_eq!(BestFit.encode(Vec3::new(0.0f32, 0.0, 1.0)).0, 0xFF_8080);
        assert_eq!(BestFit.encode(Vec3::new(0.0f32, 0.0, -7.0)).0, 0x00_8080);
    }

    #[test]
    fn a_table_is_nearer_than_rounding_and_a_search_nearer_still() {
        let mut sums = [0.0; 3];
        for v in [[0.6f32, 0.64, 0.48], [0.1, 0.2, 0.97], [-0.9, 0.3, 0.2], [0.3, -0.5, -0.8]] {
            let codes = [
                BestFit.encode_precise::<f32>(v.into()),
                BestFit.encode(v.into()),
                BestFit::UNORM8.encode(v.into()),
            ];
            for (sum, code) in sums.iter_mut().zip(codes) {
                *sum += off(code.0, v);
            }
            assert!(off(codes[0].0, v) <= off(codes[1].0, v));
        }
        assert!(sums[0] <= sums[1] && sums[1] * 2.0 < sums[2], "{sums:?}");
    }
}
