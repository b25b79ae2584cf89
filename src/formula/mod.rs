//! What a family of codecs writes.

pub(crate) mod bits;
pub(crate) mod cartesian;
pub(crate) mod cube;
pub(crate) mod disk;
pub(crate) mod fibonacci;
pub(crate) mod front_oct;
pub(crate) mod half;
pub(crate) mod hemi_oct;
pub(crate) mod icosphere;
pub(crate) mod latlong;
pub(crate) mod oct;
pub(crate) mod octant;
pub(crate) mod phi_z;
pub(crate) mod spherical;
pub(crate) mod xy_only;

use bytemuck::Pod;

use crate::simd::math;
use crate::simd::{Each, Simd, SimdInt, SimdMask};

/// A representation, as arithmetic on lanes. A family implements it once; [`batch`](crate::batch)
/// makes every entry point of [`Codec`](crate::Codec) from it.
pub(crate) trait Formula: 'static {
    /// How many 32-bit integers hold a code: [`One`] or [`Three`].
    type Words: Words;
    /// Whether only z >= 0 is represented; z < 0 is then taken as 0.
    const HEMISPHERE: bool = false;

    /// Brings any input into a direction that `encode` understands: finite, not zero, its largest
    /// component from 2^-40 to 2^41.
    #[inline(always)]
    fn prepare<V: Simd>([x, y, z]: [V; 3]) -> [V; 3] {
        if Self::HEMISPHERE {
            direction([x, y, V::select(z.lt(V::zero()), V::zero(), z)])
        } else {
            direction([x, y, z])
        }
    }

    /// The fast encoder: each parameter rounded to nearest, ties to even. Gives canonical codes.
    fn encode<V: Simd>(v: [V; 3]) -> Packed<Self, V>;

    /// The code whose decoded vector is closest to `v`, canonical.
    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> Packed<Self, V> {
        Self::encode(v)
    }

    /// Total: a unit vector for every bit pattern. Bits above the code's width are ignored.
    fn decode<V: Simd>(code: Packed<Self, V>) -> [V; 3];

    /// The code that encoders emit for the direction of `code`.
    fn canonical<V: Simd>(code: Packed<Self, V>) -> Packed<Self, V>;

    /// The code that `encode_precise` gives for the decoded vector with the components negated that are to be
    /// flipped.
    #[inline(always)]
    fn mirror<V: Simd>(code: Packed<Self, V>, flips: [bool; 3]) -> Packed<Self, V> {
        mirror_decoded::<Self, V>(code, flips)
    }
}

/// [`Formula::mirror`] by its definition, for what has no mirror image among the points.
#[inline(always)]
pub(crate) fn mirror_decoded<F: Formula + ?Sized, V: Simd>(
    code: Packed<F, V>,
    flips: [bool; 3],
) -> Packed<F, V> {
    let v = F::decode::<V>(code);
    let mirrored = [0, 1, 2].each(
        #[inline(always)]
        |i: usize| V::from_bits(v[i].to_bits() ^ sign_bit::<V>(flips[i])),
    );
    F::encode_precise(F::prepare(mirrored))
}

/// The sign of an `f32` if it is to be flipped.
#[inline(always)]
pub(crate) fn sign_bit<V: Simd>(flip: bool) -> V::Int {
    V::Int::splat(i32::from(flip) << 31)
}

/// Minus `i` if it is to be flipped; without a branch, which in a loop would remain.
#[inline(always)]
pub(crate) fn negate_if<I: SimdInt>(i: I, flip: bool) -> I {
    let mask = I::splat(-i32::from(flip));
    (i ^ mask) - mask
}

/// [`negate_if`] for the components of a point.
#[inline(always)]
pub(crate) fn mirror_point<I: SimdInt>([x, y, z]: [I; 3], flips: [bool; 3]) -> [I; 3] {
    [negate_if(x, flips[0]), negate_if(y, flips[1]), negate_if(z, flips[2])]
}

/// The opposite of `mask` if it is to be flipped.
#[inline(always)]
pub(crate) fn not_if<V: Simd>(mask: V::Mask, flip: bool) -> V::Mask {
    let flip = V::Int::splat(i32::from(flip)).eq(V::Int::splat(1));
    mask & !flip | !mask & flip
}

/// A formula whose decoder is the same, bit for bit, in all octants: mirroring a code mirrors its
/// vector. A hemisphere's formula is so in its four.
pub(crate) trait Symmetric: Formula<Words = One> {
    /// How many points there are in an octant.
    const ENTRIES: usize;

    /// The number of a code's point in its octant, below [`ENTRIES`](Self::ENTRIES), and which
    /// components of that point to negate. Each number has a code of which none is.
    fn fold<V: Simd>(code: V::Int) -> (V::Int, [V::Mask; 3]);
}

/// A formula whose points form a lattice of triangles with straight edges.
pub(crate) trait Lattice: Formula<Words = One> {
    /// One of the points around `v`, so that the mean over all `t` from 0 to 1 has the direction of `v`.
    fn encode_one_of<V: Simd>(v: [V; 3], t: V) -> V::Int;
}

/// The formula behind a codec.
pub(crate) trait Behind: crate::Codec {
    type Formula: Formula;
}

/// A code in lanes.
pub(crate) type Packed<F, V> = <<F as Formula>::Words as Words>::Packed<V>;

/// How many 32-bit integers hold a code while it is in lanes.
pub(crate) trait Words {
    type Packed<V: Simd>: Copy;
}

/// Codes of at most 32 bits.
pub(crate) struct One;
/// Codes of one integer that need more.
pub(crate) struct Two;
/// Codes of three components that need more.
pub(crate) struct Three;

impl Words for One {
    type Packed<V: Simd> = V::Int;
}
impl Words for Two {
    type Packed<V: Simd> = [V::Int; 2];
}
impl Words for Three {
    type Packed<V: Simd> = [V::Int; 3];
}

/// How a code of `W` words stands in memory.
pub(crate) trait Stored<W: Words>: Pod {
    fn load<V: Simd>(block: &V::Block<Self>) -> W::Packed<V>;
    fn store<V: Simd>(code: W::Packed<V>, block: &mut V::Block<Self>);
}

macro_rules! stored {
    ($type:ty: One, $load:expr, $store:expr) => {
        impl Stored<One> for $type {
            #[inline(always)]
            fn load<V: Simd>(block: &V::Block<Self>) -> V::Int {
                V::load_int(block, $load)
            }
            #[inline(always)]
            fn store<V: Simd>(code: V::Int, block: &mut V::Block<Self>) {
                V::store_int(code, block, $store);
            }
        }
    };
    ($type:ty: Three) => {
        impl Stored<Three> for [$type; 3] {
            #[inline(always)]
            fn load<V: Simd>(block: &V::Block<Self>) -> [V::Int; 3] {
                [
                    V::load_int(block, |c: Self| u32::from(c[0])),
                    V::load_int(block, |c: Self| u32::from(c[1])),
                    V::load_int(block, |c: Self| u32::from(c[2])),
                ]
            }
            #[inline(always)]
            fn store<V: Simd>(code: [V::Int; 3], block: &mut V::Block<Self>) {
                V::store_int(code[0], block, |c: &mut Self, i| c[0] = i as $type);
                V::store_int(code[1], block, |c: &mut Self, i| c[1] = i as $type);
                V::store_int(code[2], block, |c: &mut Self, i| c[2] = i as $type);
            }
        }
    };
}

stored!(u8: One, u32::from, |c, i| *c = i as u8);
stored!(u16: One, u32::from, |c, i| *c = i as u16);
stored!(u32: One, |c| c, |c, i| *c = i);
stored!(u16: Three);
stored!(u32: Three);

impl Stored<Two> for u64 {
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> [V::Int; 2] {
        [V::load_int(block, |c: Self| c as u32), V::load_int(block, |c: Self| (c >> 32) as u32)]
    }
    #[inline(always)]
    fn store<V: Simd>(code: [V::Int; 2], block: &mut V::Block<Self>) {
        V::store_int(code[0], block, |c: &mut Self, i| *c = u64::from(i));
        V::store_int(code[1], block, |c: &mut Self, i| *c |= u64::from(i) << 32);
    }
}

impl Stored<One> for [u8; 3] {
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> V::Int {
        V::load_bytes(block)
    }
    #[inline(always)]
    fn store<V: Simd>(code: V::Int, block: &mut V::Block<Self>) {
        V::store_bytes(code, block);
    }
}

/// `v` itself unless it is zero, NaN, infinite, huge or tiny. Those become +Z, +Z, the limit
/// direction, and `v` times a power of two.
#[inline(always)]
pub(crate) fn direction<V: Simd>(v: [V; 3]) -> [V; 3] {
    let magnitude = magnitude(v);
    let usual = is_usual(magnitude);
    let [x, y, z] = v;
    // In registers, but where the call wants them in memory.
    let (x, y, z) = if (!usual).any() {
        let [x, y, z] = mend([x, y, z], magnitude, usual);
        (x, y, z)
    } else {
        (x, y, z)
    };
    [x, y, z]
}

/// [`direction`] in four dimensions, where zero and NaN become +W.
#[inline(always)]
pub(crate) fn direction4<V: Simd>([x, y, z, w]: [V; 4]) -> [V; 4] {
    let last = w.abs().to_bits();
    let magnitude = V::from_bits(magnitude([x, y, z]).to_bits().max(last));
    let usual = is_usual(magnitude);
    let (x, y, z, w) = if (!usual).any() {
        let [x, y, z, w] = mend([x, y, z, w], magnitude, usual);
        (x, y, z, w)
    } else {
        (x, y, z, w)
    };
    [x, y, z, w]
}

/// Whether formulas understand a vector with this greatest |component|.
#[inline(always)]
fn is_usual<V: Simd>(magnitude: V) -> V::Mask {
    const LEAST: f32 = 9.094_947e-13; // 2^-40
    const GREATEST: f32 = 1.099_511_6e12; // 2^40
    V::splat(LEAST).le(magnitude) & magnitude.le(V::splat(GREATEST))
}

/// The greatest |component|; NaN if there is one.
#[inline(always)]
pub(crate) fn magnitude<V: Simd>(v: [V; 3]) -> V {
    // As integers, magnitudes stand in the same order, with infinity and then NaN last.
    let [x, y, z] = v.each(|c| c.abs().to_bits());
    V::from_bits(x.max(y).max(z))
}

/// Zero and NaN become the last axis.
#[cold]
#[inline(never)]
fn mend<V: Simd, const N: usize>(v: [V; N], magnitude: V, usual: V::Mask) -> [V; N] {
    V::compiled_for(
        #[inline(always)]
        || {
            let infinite = V::splat(f32::INFINITY).le(magnitude);
            // The tiny times 2^72 or, near the subnormal (below 2^-104), 2^126; the huge down to 2^40, so
            // that no sign is lost that a smaller multiple would keep.
            let down = (V::Int::splat(127 + 40 + 127) - magnitude.to_bits().shr(23)).shl(23);
            let scale = V::select(
                magnitude.lt(V::splat(4.930_380_7e-32)),
                V::splat(8.507_059e37),
                V::select(
                    magnitude.lt(V::splat(1.0)),
                    V::splat(4.722_366_5e21),
                    V::from_bits(down),
                ),
            );
            let none = !(V::zero().lt(magnitude)); // zero or NaN
            let mut mended = v;
            for (i, c) in mended.iter_mut().enumerate() {
                let at_infinity = V::splat(f32::INFINITY).le(c.abs());
                let limit =
                    V::select(at_infinity, V::splat(1.0).negate_where_negative(*c), V::zero());
                let pole = if i + 1 == N { V::splat(1.0) } else { V::zero() };
                let c_mended = V::select(none, pole, V::select(infinite, limit, *c * scale));
                *c = V::select(usual, *c, c_mended);
            }
            mended
        },
    )
}

/// Keeps the candidate that decodes closest to a vector.
pub(crate) struct Closest<V: Simd> {
    target: [V; 3],
    code: V::Int,
    distance: V,
}

impl<V: Simd> Closest<V> {
    /// `target` needs no unit length.
    #[inline(always)]
    pub(crate) fn to(target: [V; 3]) -> Self {
        Self::to_unit(math::normalize(target))
    }

    /// `target` has unit length. What decodes to its very bits is at distance 0.
    #[inline(always)]
    pub(crate) fn to_unit(target: [V; 3]) -> Self {
        Closest { target, code: V::Int::splat(0), distance: V::splat(f32::INFINITY) }
    }

    /// Considers a code that decodes to the unit vector `decoded`. The first of equals stays.
    #[inline(always)]
    pub(crate) fn consider(&mut self, code: V::Int, decoded: [V; 3]) {
        self.consider_where(V::zero().le(V::zero()), code, decoded);
    }

    /// Considers a code in some lanes.
    #[inline(always)]
    pub(crate) fn consider_where(&mut self, counts: V::Mask, code: V::Int, decoded: [V; 3]) {
        let distance = math::chord_squared(decoded, self.target);
        let closer = counts & distance.lt(self.distance);
        self.code = V::Int::select(closer, code, self.code);
        self.distance = V::select(closer, distance, self.distance);
    }

    /// Whether in every lane the closest so far decodes to the target itself.
    #[inline(always)]
    pub(crate) fn is_exact(&self) -> bool {
        !V::zero().lt(self.distance).any()
    }

    /// Chord to the closest so far.
    #[inline(always)]
    pub(crate) fn distance_squared(&self) -> V {
        self.distance
    }

    #[inline(always)]
    pub(crate) fn code(self) -> V::Int {
        self.code
    }
}

/// The two integers around `x`, the nearer one first.
#[inline(always)]
pub(crate) fn around<V: Simd>(x: V) -> [V::Int; 2] {
    let near = x.round_int();
    let up = V::from_int(near).lt(x);
    [near, near + V::Int::select(up, V::Int::splat(1), V::Int::splat(-1))]
}

/// The closest code of those whose two parameters are each rounded down or up. `decode` turns
/// parameters, which may be one step out of range, into a canonical code and its vector.
#[inline(always)]
pub(crate) fn closest_of_four<V: Simd>(
    target: [V; 3],
    params: [V; 2],
    decode: impl Fn([V::Int; 2]) -> (V::Int, [V; 3]),
) -> V::Int {
    let [columns, rows] = params.each(around);
    let mut closest = Closest::to(target);
    for w in rows {
        for u in columns {
            let (code, decoded) = decode([u, w]);
            closest.consider(code, decoded);
        }
    }
    closest.code()
}
