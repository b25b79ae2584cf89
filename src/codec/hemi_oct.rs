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

use crate::formula::{Formula, One, Symmetric, closest_of_four, mirror_decoded, negate_if, not_if};
use crate::lane::{Each, Lane, LaneInt};
use crate::layout::{pack_snorm2, snorm_max, unpack_snorm2};
use crate::math;

/// Hemi-oct in `BITS` bits.
pub(crate) struct HemiOct<const BITS: u32>;

impl<const BITS: u32> HemiOct<BITS> {
    const M: i32 = snorm_max(BITS / 2);

    #[inline(always)]
    fn project<L: Lane>([x, y, z]: [L; 3]) -> [L; 2] {
        let scale = L::splat(Self::M as f32) / (x.abs() + y.abs() + z);
        let (x, y) = (x * scale, y * scale);
        [x + y, x - y]
    }

    /// The code with x or y negated: (x + y, x - y) becomes minus (x - y, x + y) or (x - y, x + y).
    #[inline(always)]
    fn mirror_xy<L: Lane>(code: L::Int, x: bool, y: bool) -> L::Int {
        let [u, w] = unpack_snorm2::<BITS, L>(code);
        let [u, w] = if x != y { [w, u] } else { [u, w] };
        pack_snorm2::<BITS, L>([negate_if(u, x), negate_if(w, x)])
    }
}

impl<const BITS: u32> Formula for HemiOct<BITS> {
    type Words = One;
    const HEMISPHERE: bool = true;

    #[inline(always)]
    fn encode<L: Lane>(v: [L; 3]) -> L::Int {
        pack_snorm2::<BITS, L>(Self::project(v).each(|p| p.round_int()))
    }

    #[inline(always)]
    fn encode_precise<L: Lane>(v: [L; 3]) -> L::Int {
        let max = L::Int::splat(Self::M);
        closest_of_four(
            v,
            Self::project(v),
            #[inline(always)]
            |params| {
                let code = pack_snorm2::<BITS, L>(params.each(|p| p.max(-max).min(max)));
                (code, Self::decode::<L>(code))
            },
        )
    }

    #[inline(always)]
    fn decode<L: Lane>(code: L::Int) -> [L; 3] {
        let [u, w] = unpack_snorm2::<BITS, L>(code);
        let z = L::Int::splat(Self::M) - u.abs().max(w.abs());
        let p = [u + w, u - w, z + z];
        math::normalize(p.each(|c| L::from_int(c) * L::splat(0.5 / Self::M as f32)))
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: L::Int) -> L::Int {
        pack_snorm2::<BITS, L>(unpack_snorm2::<BITS, L>(code))
    }

    #[inline(always)]
    fn mirror<L: Lane>(code: L::Int, flips: [bool; 3]) -> L::Int {
        let [x, y, z] = flips;
        if z { mirror_decoded::<Self, L>(code, flips) } else { Self::mirror_xy::<L>(code, x, y) }
    }
}

/// Hemi-oct in `PAIR` bits, and the sign of z above them.
pub(crate) struct SignedOct<const PAIR: u32>;

impl<const PAIR: u32> SignedOct<PAIR> {
    /// The code of a point of the upper hemisphere or, off the equator, of its mirror image.
    #[inline(always)]
    fn signed<L: Lane>(code: L::Int, lower: L::Mask) -> L::Int {
        let max = L::Int::splat(HemiOct::<PAIR>::M);
        let [u, w] = unpack_snorm2::<PAIR, L>(code);
        let lower = lower & u.abs().max(w.abs()).lt(max);
        code | L::Int::select(lower, L::Int::splat(1 << PAIR), L::Int::splat(0))
    }
}

impl<const PAIR: u32> Formula for SignedOct<PAIR> {
    type Words = One;

    #[inline(always)]
    fn encode<L: Lane>([x, y, z]: [L; 3]) -> L::Int {
        Self::signed::<L>(HemiOct::<PAIR>::encode([x, y, z.abs()]), z.lt(L::zero()))
    }

    #[inline(always)]
    fn encode_precise<L: Lane>([x, y, z]: [L; 3]) -> L::Int {
        Self::signed::<L>(HemiOct::<PAIR>::encode_precise([x, y, z.abs()]), z.lt(L::zero()))
    }

    #[inline(always)]
    fn decode<L: Lane>(code: L::Int) -> [L; 3] {
        let [x, y, z] = HemiOct::<PAIR>::decode::<L>(code);
        let lower = L::Int::splat(0).lt(code.shr(PAIR).low(1)) & L::zero().lt(z);
        [x, y, L::select(lower, -z, z)]
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: L::Int) -> L::Int {
        let lower = L::Int::splat(0).lt(code.shr(PAIR).low(1));
        Self::signed::<L>(HemiOct::<PAIR>::canonical::<L>(code), lower)
    }

    #[inline(always)]
    fn mirror<L: Lane>(code: L::Int, [x, y, z]: [bool; 3]) -> L::Int {
        let lower = L::Int::splat(0).lt(code.shr(PAIR).low(1));
        Self::signed::<L>(HemiOct::<PAIR>::mirror_xy::<L>(code, x, y), not_if::<L>(lower, z))
    }
}

impl<const BITS: u32> Symmetric for HemiOct<BITS> {
    const ENTRIES: usize = (Self::M as usize + 1) * (Self::M as usize + 1);

    #[inline(always)]
    fn fold<L: Lane>(code: L::Int) -> (L::Int, [L::Mask; 3]) {
        let zero = L::Int::splat(0);
        let [u, w] = unpack_snorm2::<BITS, L>(code);
        let (x, y) = (u + w, u - w);
        // The parameters of (|x|, |y|): the first from 0, the second from minus to plus the first.
        let (a, b) = ((x.abs() + y.abs()).sar(1), (x.abs() - y.abs()).sar(1));
        (a * (a + L::Int::splat(1)) + b, [x.lt(zero), y.lt(zero), zero.lt(zero)])
    }
}
