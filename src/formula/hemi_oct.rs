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
//! Canonical: every direction has one pattern, but for -M-1, which reads as -M, and for points of
//! signed oct's equator, |u| = M or |w| = M, which count as upper. Survive exactly: +Z, +-X and +-Y,
//! and in signed oct -Z.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; signed oct: White, "Signed Octahedron Normal Encoding", 2017, whose parameters are unorm,
//! so that it has no +-Z.

use crate::formula::bits::{pack_snorm2, snorm_max, unpack_snorm2};
use crate::formula::{Formula, One, Symmetric, closest_of_four, mirror_decoded, negate_if, not_if};
use crate::simd::math;
use crate::simd::{Each, Simd, SimdInt};

/// Hemi-oct in `BITS` bits.
pub(crate) struct HemiOct<const BITS: u32>;

impl<const BITS: u32> HemiOct<BITS> {
    const M: i32 = snorm_max(BITS / 2);

    #[inline(always)]
    fn project<V: Simd>([x, y, z]: [V; 3]) -> [V; 2] {
        let scale = V::splat(Self::M as f32) / (x.abs() + y.abs() + z);
        let (x, y) = (x * scale, y * scale);
        [x + y, x - y]
    }

    /// The code with x or y negated: (x + y, x - y) becomes minus (x - y, x + y) or (x - y, x + y).
    #[inline(always)]
    fn mirror_xy<V: Simd>(code: V::Int, x: bool, y: bool) -> V::Int {
        let [u, w] = unpack_snorm2::<BITS, V>(code);
        let [u, w] = if x != y { [w, u] } else { [u, w] };
        pack_snorm2::<BITS, V>([negate_if(u, x), negate_if(w, x)])
    }
}

impl<const BITS: u32> Formula for HemiOct<BITS> {
    type Words = One;
    const HEMISPHERE: bool = true;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        pack_snorm2::<BITS, V>(Self::project(v).each(|p| p.round_int()))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        let max = V::Int::splat(Self::M);
        closest_of_four(
            v,
            Self::project(v),
            #[inline(always)]
            |params| {
                let code = pack_snorm2::<BITS, V>(params.each(|p| p.max(-max).min(max)));
                (code, Self::decode::<V>(code))
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        let [u, w] = unpack_snorm2::<BITS, V>(code);
        let z = V::Int::splat(Self::M) - u.abs().max(w.abs());
        let p = [u + w, u - w, z + z];
        math::normalize(p.each(|c| V::from_int(c) * V::splat(0.5 / Self::M as f32)))
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        pack_snorm2::<BITS, V>(unpack_snorm2::<BITS, V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        let [x, y, z] = flips;
        if z { mirror_decoded::<Self, V>(code, flips) } else { Self::mirror_xy::<V>(code, x, y) }
    }
}

/// Hemi-oct in `PAIR` bits, and the sign of z above them.
pub(crate) struct SignedOct<const PAIR: u32>;

impl<const PAIR: u32> SignedOct<PAIR> {
    /// The code of a point of the upper hemisphere or, off the equator, of its mirror image.
    #[inline(always)]
    fn signed<V: Simd>(code: V::Int, lower: V::Mask) -> V::Int {
        let max = V::Int::splat(HemiOct::<PAIR>::M);
        let [u, w] = unpack_snorm2::<PAIR, V>(code);
        let lower = lower & u.abs().max(w.abs()).lt(max);
        code | V::Int::select(lower, V::Int::splat(1 << PAIR), V::Int::splat(0))
    }
}

impl<const PAIR: u32> Formula for SignedOct<PAIR> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>([x, y, z]: [V; 3]) -> V::Int {
        Self::signed::<V>(HemiOct::<PAIR>::encode([x, y, z.abs()]), z.lt(V::zero()))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>([x, y, z]: [V; 3]) -> V::Int {
        Self::signed::<V>(HemiOct::<PAIR>::encode_precise([x, y, z.abs()]), z.lt(V::zero()))
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        let [x, y, z] = HemiOct::<PAIR>::decode::<V>(code);
        let lower = V::Int::splat(0).lt(code.shr(PAIR).low(1)) & V::zero().lt(z);
        [x, y, V::select(lower, -z, z)]
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        let lower = V::Int::splat(0).lt(code.shr(PAIR).low(1));
        Self::signed::<V>(HemiOct::<PAIR>::canonical::<V>(code), lower)
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, [x, y, z]: [bool; 3]) -> V::Int {
        let lower = V::Int::splat(0).lt(code.shr(PAIR).low(1));
        Self::signed::<V>(HemiOct::<PAIR>::mirror_xy::<V>(code, x, y), not_if::<V>(lower, z))
    }
}

impl<const BITS: u32> Symmetric for HemiOct<BITS> {
    const ENTRIES: usize = (Self::M as usize + 1) * (Self::M as usize + 1);

    #[inline(always)]
    fn fold<V: Simd>(code: V::Int) -> (V::Int, [V::Mask; 3]) {
        let zero = V::Int::splat(0);
        let [u, w] = unpack_snorm2::<BITS, V>(code);
        let (x, y) = (u + w, u - w);
        // The parameters of (|x|, |y|): the first from 0, the second from minus to plus the first.
        let (a, b) = ((x.abs() + y.abs()).sar(1), (x.abs() - y.abs()).sar(1));
        (a * (a + V::Int::splat(1)) + b, [x.lt(zero), y.lt(zero), zero.lt(zero)])
    }
}
