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

use crate::formula::oct::{nearest_on_octahedron, triangle_index, triangle_len};
use crate::formula::{Formula, One, Symmetric, not_if};
use crate::simd::math::normalize;
use crate::simd::{Each, Simd, SimdInt, inlined};

/// Baptista's 16 bits.
pub(crate) struct Octant;

const M: i32 = 126;

impl Octant {
    #[inline(always)]
    fn project<V: Simd>(v: [V; 3]) -> [V; 3] {
        let [x, y, z] = v.each(|c| c.abs());
        let scale = V::splat(M as f32) / (x + y + z);
        [x * scale, y * scale, z * scale]
    }

    #[inline(always)]
    fn pack<V: Simd>([i, j]: [V::Int; 2], negative: [V::Mask; 3]) -> V::Int {
        let zero = V::Int::splat(0);
        let k = V::Int::splat(M) - i - j;
        // Zero has no sign.
        let sign = inlined(
            #[inline(always)]
            |negative: V::Mask, magnitude: V::Int, bit: u32| {
                V::Int::select(negative & zero.lt(magnitude), V::Int::splat(1 << bit), zero)
            },
        );
        let [x, y, z] = negative;
        let signs = sign(x, i, 15) | sign(y, j, 14) | sign(z, k, 13);
        let fold = V::Int::splat(63).lt(i);
        let [i, j] = [i, j].each(|c| V::Int::select(fold, V::Int::splat(127) - c, c));
        signs | i.shl(7) | j
    }

    /// Which of the three sign bits are set.
    #[inline(always)]
    fn negative<V: Simd>(code: V::Int) -> [V::Mask; 3] {
        [15, 14, 13].each(|bit| code.shr(bit).low(1).eq(V::Int::splat(1)))
    }

    #[inline(always)]
    fn magnitudes<V: Simd>(code: V::Int) -> [V::Int; 3] {
        let (i, j) = (code.shr(7).low(6), code.low(7));
        let fold = !(i + j).lt(V::Int::splat(127));
        let [i, j] = [i, j].each(|c| V::Int::select(fold, V::Int::splat(127) - c, c));
        let unused = V::Int::splat(M).lt(i + j);
        let i = V::Int::select(unused, i - V::Int::splat(1), i);
        let k = V::Int::splat(M) - i - j;
        [i, j, k]
    }
}

impl Formula for Octant {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        let [i, j, _] = Self::project(v).each(
            #[inline(always)]
            |c| c.floor().round_int(),
        );
        Self::pack::<V>([i, j], v.each(|c| c.lt(V::zero())))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        let [i, j, _] = nearest_on_octahedron(Self::project(v), M).each(|c| c.round_int());
        Self::pack::<V>([i, j], v.each(|c| c.lt(V::zero())))
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        let [i, j, k] = Self::magnitudes::<V>(code);
        let signed = inlined(
            #[inline(always)]
            |magnitude: V::Int, bit: u32| {
                let s = code.shl(31 - bit).sar(31);
                V::from_int((magnitude ^ s) - s) * V::splat(1.0 / M as f32)
            },
        );
        normalize([signed(i, 15), signed(j, 14), signed(k, 13)])
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        let [i, j, _] = Self::magnitudes::<V>(code);
        Self::pack::<V>([i, j], Self::negative::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        let [i, j, _] = Self::magnitudes::<V>(code);
        let [x, y, z] = Self::negative::<V>(code);
        let negative =
            [not_if::<V>(x, flips[0]), not_if::<V>(y, flips[1]), not_if::<V>(z, flips[2])];
        Self::pack::<V>([i, j], negative)
    }
}

impl Symmetric for Octant {
    const ENTRIES: usize = triangle_len(M);

    #[inline(always)]
    fn fold<V: Simd>(code: V::Int) -> (V::Int, [V::Mask; 3]) {
        let zero = V::Int::splat(0);
        let [i, j, k] = Self::magnitudes::<V>(code);
        let [x, y, z] = Self::negative::<V>(code);
        (triangle_index::<V>(i, j), [x & zero.lt(i), y & zero.lt(j), z & zero.lt(k)])
    }
}
