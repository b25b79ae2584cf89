//! Octant: three signs, and the octant's triangle unfolded into 64 by 128 cells.
//!
//! ```text
//! encode   (i, j) = trunc(126 (|x|, |y|) / (|x| + |y| + |z|));  if i >= 64: (i, j) = (127 - i, 127 - j)
//!          code = signs of x, y, z in bits 15, 14, 13 | i << 7 | j
//! decode   if i + j >= 127: undo;  v = (i, j, 126 - i - j) with signs, normalised
//! ```
//!
//! The original encoder truncates, which costs a factor of two and a half: `encode_precise` gives
//! the same bits, read by the same decoder, but takes the nearest of the lattice i + j + k = 126,
//! as oct does.
//!
//! Canonical: a zero has no sign. The 512 patterns with i + j = 127, which no encoder emits, read
//! as the neighbour with i one less. Axes survive exactly.
//!
//! Source: Baptista, "Higher Accuracy Quantized Normals", GameDev.net, 2000.

use super::oct::{Central, Projection, Steps, nearest_on_octahedron, triangle_index, triangle_len};
use super::octant_table::octant_kernels;
use super::support::sign::not_if;
use super::{Formula, Symmetric, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::{Simd, SimdInt, Vec3, map_vec};

/// Baptista's 16 bits.
#[derive(Clone, Copy)]
pub(crate) struct Octant;

const M: i32 = 126;
const STEPS: Steps = Steps::new(M);

impl Octant {
    pub(crate) const fn new() -> Self {
        Octant
    }

    #[inline(always)]
    fn pack<V: Simd>(i: V::Int, j: V::Int, negative: Vec3<V::Mask>) -> V::Int {
        let zero = V::Int::splat(0);
        let k = V::Int::splat(M) - i - j;
        // Zero has no sign.
        let x = V::Int::select(negative.x & zero.lt(i), 1 << 15, 0);
        let y = V::Int::select(negative.y & zero.lt(j), 1 << 14, 0);
        let z = V::Int::select(negative.z & zero.lt(k), 1 << 13, 0);
        let (i, j) = Self::fold::<V>(i, j, V::Int::splat(63).lt(i));
        x | y | z | i.shl(7) | j
    }

    /// (127 - i, 127 - j) in some lanes.
    #[inline(always)]
    fn fold<V: Simd>(i: V::Int, j: V::Int, folds: V::Mask) -> (V::Int, V::Int) {
        let last = V::Int::splat(127);
        (V::Int::select(folds, last - i, i), V::Int::select(folds, last - j, j))
    }

    /// Which of the three sign bits are set.
    #[inline(always)]
    fn negative<V: Simd>(code: V::Int) -> Vec3<V::Mask> {
        map_vec!(Vec3::new(15, 14, 13), |bit| code.shr_logical(bit).low_bits(1).eq(1))
    }

    #[inline(always)]
    fn magnitudes<V: Simd>(code: V::Int) -> Vec3<V::Int> {
        let (i, j) = (code.shr_logical(7).low_bits(6), code.low_bits(7));
        let (i, j) = Self::fold::<V>(i, j, !(i + j).lt(127));
        let unused = V::Int::splat(M).lt(i + j);
        let i = V::Int::select(unused, i - 1, i);
        Vec3::new(i, j, V::Int::splat(M) - i - j)
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        triangle_len(M)
    }
}

impl Formula for Octant {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let p = Central::project(v, STEPS).floor().round_int();
        Self::pack::<V>(p.x, p.y, v.is_negative())
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let p = nearest_on_octahedron(Central::project(v, STEPS), STEPS).round_int();
        Self::pack::<V>(p.x, p.y, v.is_negative())
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        let magnitudes = Self::magnitudes::<V>(code);
        let signs = map_vec!(Vec3::new(15, 14, 13), |bit| code.shl(31 - bit).shr_arithmetic(31));
        let point = Vec3::new(
            (magnitudes.x ^ signs.x) - signs.x,
            (magnitudes.y ^ signs.y) - signs.y,
            (magnitudes.z ^ signs.z) - signs.z,
        );
        (Vec3::from_int(point) * (1.0 / M as f32)).normalize()
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        let Vec3 { x: i, y: j, .. } = Self::magnitudes::<V>(code);
        let Vec3 { x, y, z } = Self::negative::<V>(code);
        let negative = Vec3::new(not_if(x, flips[0]), not_if(y, flips[1]), not_if(z, flips[2]));
        Self::pack::<V>(i, j, negative)
    }
}

impl Symmetric for Octant {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let zero = V::Int::splat(0);
        let Vec3 { x: i, y: j, z: k } = Self::magnitudes::<V>(code);
        let Vec3 { x, y, z } = Self::negative::<V>(code);
        let flips = Vec3::new(x & zero.lt(i), y & zero.lt(j), z & zero.lt(k));
        (triangle_index::<V>(i, j), flips)
    }
}

kernels!(Octant: Words);
octant_kernels!(Octant);

#[cfg(test)]
mod tests {
    use super::*;

    fn canonical(code: i32) -> i32 {
        Octant.mirror::<f32>(code.into(), [false; 3]).0
    }

    #[test]
    fn the_fast_encoder_truncates() {
        // (1, 2, 2) 126 / 5 = (25.2, 50.4, 50.4): 25 * 128 + 50.
        assert_eq!(Octant.encode(Vec3::new(1.0f32, 2.0, 2.0)).0, 0x0CB2);
        assert_eq!(Octant.encode(Vec3::new(-1.0f32, 2.0, -2.0)).0, 0xACB2);
        let v = Vec3::new(25.25f32, 50.75, 50.0);
        assert_eq!([Octant.encode(v).0, Octant.encode_precise(v).0], [0x0CB2, 0x0CB3]);
    }

    #[test]
    fn from_64_on_the_triangle_is_folded() {
        // (5, 2, 2) 126 / 9 = (70, 28, 28), stored as (127 - 70, 127 - 28) = (57, 99).
        assert_eq!(Octant.encode(Vec3::new(5.0f32, 2.0, 2.0)).0, 57 * 128 + 99);
        let v = Octant.decode::<f32>((57 * 128 + 99).into());
        // (5, 2, 2) / sqrt(33).
        assert!(v.distance_squared(Vec3::new(0.870_388, 0.348_155, 0.348_155)) < 1e-11, "{v:?}");
    }

    #[test]
    fn axes_survive() {
        // (126, 0) is stored as (1, 127).
        for (axis, code) in [
            ([1.0f32, 0.0, 0.0], 0x00FF),
            ([-1.0, 0.0, 0.0], 0x80FF),
            ([0.0, 1.0, 0.0], 0x007E),
            ([0.0, -1.0, 0.0], 0x407E),
            ([0.0, 0.0, 1.0], 0x0000),
            ([0.0, 0.0, -1.0], 0x2000),
        ] {
            assert_eq!(Octant.encode(axis.into()).0, code);
            assert_eq!(Octant.encode_precise(axis.into()).0, code);
            assert_eq!(Octant.decode::<f32>(code.into()).to_array(), axis);
        }
    }

    #[test]
    fn a_zero_has_no_sign() {
        assert_eq!([canonical(0xC000), canonical(0xE07E), canonical(0xE0FF)], [0, 0x407E, 0x80FF]);
        assert_eq!(Octant.mirror::<f32>(0x00FF.into(), [true; 3]).0, 0x80FF);
    }

    #[test]
    fn patterns_whose_sum_is_127_read_as_a_neighbour() {
        // (10, 117) would be (117, 10), and reads as (116, 10), which is stored as (11, 117).
        assert_eq!(canonical(10 * 128 + 117), 11 * 128 + 117);
        // (63, 64) would be (64, 63), and reads as (63, 63).
        assert_eq!(canonical(63 * 128 + 64), 63 * 128 + 63);
    }
}
