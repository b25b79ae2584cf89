//! Hemi-oct: the +Z hemisphere projected onto half an octahedron, turned by 45 degrees so that it
//! fills the square. Signed oct: the same for both hemispheres, and a bit that says which.
//!
//! ```text
//! encode   p = (x, y) / (|x| + |y| + |z|);  code = snorm(p.x + p.y), snorm(p.x - p.y), z < 0
//! decode   p = ((u + w) / 2, (u - w) / 2, 1 - max(|u|, |w|));  v = p / |p|, z negated where the bit is set
//! ```
//!
//! The nearest point of signed oct is on the own side of the equator: its mirror image is farther.
//!
//! Canonical: every direction has one pattern, except for -M-1, which reads as -M, and for points of
//! signed oct's equator, |u| = M or |w| = M, which count as upper. Survive exactly: +Z, +-X and +-Y,
//! and in signed oct -Z.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; signed oct: White, "Signed Octahedron Normal Encoding", 2017, whose parameters are unorm,
//! so that it has no +-Z.

use super::octant_table::octant_kernels;
use super::support::bits::Pair;
use super::support::closest::{Closest, corners, join, split};
use super::support::sign::{negate_if, not_if};
use super::{Formula, Symmetric, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::{Simd, SimdInt, Use, Vec3, map2};

/// Hemi-oct.
#[derive(Clone, Copy)]
pub(crate) struct HemiOct {
    pair: Pair,
    max: i32,
    max_float: f32,
    half_step: f32,
}

impl HemiOct {
    pub(crate) const fn new(bits: u32) -> Self {
        let pair = Pair::new(bits);
        let max = pair.snorm_max();
        HemiOct { pair, max, max_float: max as f32, half_step: 0.5 / max as f32 }
    }

    #[inline(always)]
    fn project<V: Simd>(self, Vec3 { x, y, z }: Vec3<V>) -> [V; 2] {
        let scale = V::splat(self.max_float) / (x.abs() + y.abs() + z);
        let (x, y) = (x * scale, y * scale);
        [x + y, x - y]
    }

    /// The nearest parameters.
    #[inline(always)]
    fn nearest<V: Simd>(self, v: Vec3<V>) -> [V::Int; 2] {
        map2!(self.project(v), |p| p.round_int())
    }

    /// The parameters of the nearest vector.
    #[inline(always)]
    fn nearest_precise<V: Simd>(self, v: Vec3<V>) -> [V::Int; 2] {
        let mut closest = Closest::to(v);
        for params in corners(self.project(v)) {
            let params = map2!(params, |p| p.clamp(-self.max, self.max));
            closest.consider(join::<V>(params), self.vector(params));
        }
        split::<V>(closest.code())
    }

    #[inline(always)]
    fn vector<V: Simd>(self, [u, w]: [V::Int; 2]) -> Vec3<V> {
        let z = V::Int::splat(self.max) - u.abs().max(w.abs());
        let p = Vec3::from_int(Vec3::new(u + w, u - w, z + z));
        (p * self.half_step).normalize()
    }

    /// The parameters with x or y negated: (x + y, x - y) becomes minus (x - y, x + y) or (x - y, x + y).
    #[inline(always)]
    fn mirror_xy<V: Simd>(self, [u, w]: [V::Int; 2], x: bool, y: bool) -> [V::Int; 2] {
        let [u, w] = if x != y { [w, u] } else { [u, w] };
        [negate_if(u, x), negate_if(w, x)]
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        let side = self.max as usize + 1;
        side * side
    }
}

impl Formula for HemiOct {
    type Shape = Word;
    const HEMISPHERE: bool = true;
    const PRECISE_USE: Use = Use::Often;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        self.pair.pack_snorm::<V>(self.nearest(v))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        self.pair.pack_snorm::<V>(self.nearest_precise(v))
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        self.vector(self.pair.unpack_snorm::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        let [x, y, z] = flips;
        if z {
            return self.mirror_decoded::<V>(code, flips);
        }
        let params = self.pair.unpack_snorm::<V>(code);
        self.pair.pack_snorm::<V>(self.mirror_xy::<V>(params, x, y))
    }
}

impl Symmetric for HemiOct {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let [u, w] = self.pair.unpack_snorm::<V>(code);
        let (x, y) = (u + w, u - w);
        // The parameters of (|x|, |y|): the first from 0, the second from minus to plus the first.
        let a = (x.abs() + y.abs()).shr_arithmetic(1);
        let b = (x.abs() - y.abs()).shr_arithmetic(1);
        (a * (a + 1) + b, Vec3::new(x.lt(0), y.lt(0), V::Int::splat(0).lt(0)))
    }
}

/// Hemi-oct, and the sign of z above its bits.
#[derive(Clone, Copy)]
pub(crate) struct SignedOct {
    hemisphere: HemiOct,
    sign_bit: u32,
}

impl SignedOct {
    /// In `bits` bits, an odd number.
    pub(crate) const fn new(bits: u32) -> Self {
        SignedOct { hemisphere: HemiOct::new(bits - 1), sign_bit: bits - 1 }
    }

    /// The code of a point of the upper hemisphere or, off the equator, of its mirror image.
    #[inline(always)]
    fn pack<V: Simd>(self, [u, w]: [V::Int; 2], lower: V::Mask) -> V::Int {
        let lower = lower & u.abs().max(w.abs()).lt(self.hemisphere.max);
        self.hemisphere.pair.pack_snorm::<V>([u, w]) | V::Int::select(lower, 1 << self.sign_bit, 0)
    }

    #[inline(always)]
    fn is_lower<V: Simd>(self, code: V::Int) -> V::Mask {
        V::Int::splat(0).lt(code.shr_logical(self.sign_bit).low_bits(1))
    }
}

impl Formula for SignedOct {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let params = self.hemisphere.nearest(Vec3 { z: v.z.abs(), ..v });
        self.pack::<V>(params, v.z.lt(0.0))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let params = self.hemisphere.nearest_precise(Vec3 { z: v.z.abs(), ..v });
        self.pack::<V>(params, v.z.lt(0.0))
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        let v = self.hemisphere.decode::<V>(code);
        let lower = self.is_lower::<V>(code) & V::splat(0.0).lt(v.z);
        Vec3 { z: V::select(lower, -v.z, v.z), ..v }
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, [x, y, z]: [bool; 3]) -> V::Int {
        let lower = not_if(self.is_lower::<V>(code), z);
        let params = self.hemisphere.pair.unpack_snorm::<V>(code);
        self.pack::<V>(self.hemisphere.mirror_xy::<V>(params, x, y), lower)
    }
}

kernels!(HemiOct: Words; SignedOct: Words);
octant_kernels!(HemiOct);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::{VECTORS, assert_nearest};

    const HEMI: HemiOct = HemiOct::new(16);
    const SIGNED: SignedOct = SignedOct::new(17);

    #[test]
    fn parameters_are_sum_and_difference() {
        // (1, 2, 2) 127 / 5 = (25.4, 50.8, 50.8): sum 76.2, difference -25.4.
        let v = Vec3::new(1.0f32, 2.0, 2.0);
        assert_eq!(HEMI.encode(v).0, 0xE74C);
        assert_eq!(SIGNED.encode(v).0, 0xE74C);
        assert_eq!(SIGNED.encode(Vec3 { z: -2.0, ..v }).0, 0x1_E74C);
        // ((76 - 25) / 2, (76 + 25) / 2, 127 - 76) = (25.5, 50.5, 51), of length 76.1676.
        let decoded = SIGNED.decode::<f32>(0x1_E74C.into());
        let expected = Vec3::new(0.334_788, 0.663_012, -0.669_576);
        assert!(decoded.distance_squared(expected) < 1e-10, "{decoded:?}");
    }

    #[test]
    fn what_is_below_the_hemisphere_is_put_on_its_rim() {
        assert_eq!(HEMI.prepare(Vec3::new(3.0f32, 4.0, -5.0)), Vec3::new(3.0, 4.0, 0.0));
        assert_eq!(SIGNED.prepare(Vec3::new(3.0f32, 4.0, -5.0)), Vec3::new(3.0, 4.0, -5.0));
    }

    #[test]
    fn axes_survive() {
        for (axis, code) in [
            ([1.0f32, 0.0, 0.0], 0x7F7F),
            ([-1.0, 0.0, 0.0], 0x8181),
            ([0.0, 1.0, 0.0], 0x817F),
            ([0.0, -1.0, 0.0], 0x7F81),
            ([0.0, 0.0, 1.0], 0x0000),
            ([0.0, 0.0, -1.0], 0x1_0000),
        ] {
            assert_eq!(SIGNED.encode(axis.into()).0, code);
            assert_eq!(SIGNED.encode_precise(axis.into()).0, code);
            assert_eq!(SIGNED.decode::<f32>(code.into()).to_array(), axis);
            if code < 0x1_0000 {
                assert_eq!(HEMI.encode(axis.into()).0, code);
                assert_eq!(HEMI.encode_precise(axis.into()).0, code);
                assert_eq!(HEMI.decode::<f32>(code.into()).to_array(), axis);
            }
        }
    }

    #[test]
    fn the_pattern_out_of_range_reads_as_its_neighbour() {
        assert_eq!(HEMI.mirror::<f32>(0x8000.into(), [false; 3]).0, 0x8100);
        assert_eq!(HEMI.mirror::<f32>(0x0080.into(), [false; 3]).0, 0x0081);
    }

    #[test]
    fn the_equator_is_upper() {
        for (code, canonical) in
            [(0x1_7F7F, 0x7F7F), (0x1_007F, 0x007F), (0x1_8123, 0x8123), (0x1_007E, 0x1_007E)]
        {
            assert_eq!(SIGNED.mirror::<f32>(code.into(), [false; 3]).0, canonical);
            assert_eq!(SIGNED.decode::<f32>(code.into()), SIGNED.decode::<f32>(canonical.into()));
        }
    }

    #[test]
    fn mirror_images_swap_or_negate_the_parameters() {
        // (76, -25) with x negated is (25, -76), and with y negated (-25, 76).
        for (flips, code) in [
            ([true, false, false], 0xB419),
            ([false, true, false], 0x4CE7),
            ([true, true, false], 0x19B4),
        ] {
            assert_eq!(HEMI.mirror::<f32>(0xE74C.into(), flips).0, code);
        }
        assert_eq!(SIGNED.mirror::<f32>(0xE74C.into(), [true, false, true]).0, 0x1_B419);
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        assert_nearest(SignedOct::new(9), 512, VECTORS);
    }
}
