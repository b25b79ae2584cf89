//! What a family of frame codecs writes, and what they share: the input, and the basis of a normal.

use bytemuck::Pod;

use crate::batch::Encoder;
use crate::formula::{One, Stored, Two, direction, magnitude};
use crate::simd::math;
use crate::simd::{Each, Simd, SimdInt};

/// A representation of frames, as arithmetic on lanes. A code is two words, of which the second is 0 if
/// it has at most 32 bits.
pub(crate) trait FrameFormula: 'static {
    /// The code of a frame, canonical: its normal by the encoder `E`.
    fn encode<E: Encoder, V: Simd>(frame: Prepared<V>) -> [V::Int; 2];

    /// Total: an orthonormal frame for every bit pattern.
    fn decode<V: Simd>(code: [V::Int; 2]) -> Decoded<V>;

    /// The code that encoders emit for the frame of `code`.
    fn canonical<V: Simd>(code: [V::Int; 2]) -> [V::Int; 2];
}

/// A frame of any kind, made one that can be encoded.
pub(crate) struct Prepared<V: Simd> {
    /// A direction as [`Formula`](crate::formula::Formula) encodes it.
    pub(crate) normal: [V; 3],
    /// Its unit vector.
    pub(crate) unit_normal: [V; 3],
    /// Its part across the normal.
    tangent: [V; 3],
    /// Whether there is a tangent that is not parallel to the normal.
    across: V::Mask,
    /// The squared sine of what the angle between normal and tangent lacks of 90 degrees.
    pub(crate) sin_squared: V,
    /// Whether the handedness is -1.
    pub(crate) negative: V::Mask,
}

impl<V: Simd> Prepared<V> {
    #[inline(always)]
    pub(crate) fn new(normal: [V; 3], tangent: [V; 3], handedness: V) -> Self {
        /// 2^-40, for 2^-20 radians: a few roundings of a parallel vector are far below.
        const LEAST: f32 = 9.094_947e-13;
        let (zero, one) = (V::zero(), V::splat(1.0));
        // Neither zero nor NaN.
        let given = zero.lt(magnitude(tangent));
        let normal = direction(normal);
        let unit_normal = math::normalize(normal);
        let tangent = math::normalize(direction(tangent));
        let along = math::dot(unit_normal, tangent);
        let across = math::length_squared(math::cross(unit_normal, tangent));
        Prepared {
            normal,
            unit_normal,
            tangent: [0, 1, 2].each(
                #[inline(always)]
                |i: usize| tangent[i] - along * unit_normal[i],
            ),
            across: given & V::splat(LEAST).lt(across),
            sin_squared: V::select(given, (along * along).lesser(one), one),
            negative: handedness.lt(zero),
        }
    }

    /// The tangent's coordinates in the plane of two vectors across the normal.
    #[inline(always)]
    pub(crate) fn tangent_in(&self, [a, b]: [[V; 3]; 2]) -> [V; 2] {
        [
            V::select(self.across, math::dot(self.tangent, a), V::splat(1.0)),
            V::select(self.across, math::dot(self.tangent, b), V::zero()),
        ]
    }
}

/// A decoded frame.
pub(crate) struct Decoded<V> {
    pub(crate) normal: [V; 3],
    pub(crate) tangent: [V; 3],
    pub(crate) handedness: V,
}

/// Two unit vectors across a unit vector and each other, a right-handed system with it as the third
/// (Duff et al. 2017).
#[inline(always)]
pub(crate) fn basis<V: Simd>([x, y, z]: [V; 3]) -> [[V; 3]; 2] {
    let one = V::splat(1.0);
    let sign = one.negate_where_negative(z);
    let a = -one / (sign + z);
    let b = x * y * a;
    [[one + sign * x * x * a, sign * b, -(sign * x)], [b, sign + y * y * a, -y]]
}

/// u a + w b, over its length, without negative zeros.
#[inline(always)]
pub(crate) fn unit_combination<V: Simd>([u, w]: [V; 2], [a, b]: [[V; 3]; 2]) -> [V; 3] {
    let v = [0, 1, 2].each(
        #[inline(always)]
        |i: usize| u * a[i] + w * b[i],
    );
    math::normalize(v).each(|c| c + V::zero())
}

/// 1, or -1 where the highest bit is set.
#[inline(always)]
pub(crate) fn sign<V: Simd>(bits: V::Int) -> V {
    V::from_bits(V::splat(1.0).to_bits() | (bits & V::Int::splat(i32::MIN)))
}

/// The angle whose sine has this square, from 0 to 1.
#[inline]
pub(crate) fn skew_degrees(sin_squared: f32) -> f32 {
    // Less than a root is defined for, or than anyone can see.
    if sin_squared < f32::MIN_POSITIVE {
        return 0.0;
    }
    let (sin, cos) = (math::sqrt(sin_squared), math::sqrt(1.0 - sin_squared));
    math::atan2_half_turns(sin, cos) * 180.0
}

/// How a code of two words stands in memory.
pub(crate) trait StoredFrame: Pod {
    fn load<V: Simd>(block: &V::Block<Self>) -> [V::Int; 2];
    fn store<V: Simd>(code: [V::Int; 2], block: &mut V::Block<Self>);
}

impl StoredFrame for u32 {
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> [V::Int; 2] {
        [<Self as Stored<One>>::load::<V>(block), V::Int::splat(0)]
    }
    #[inline(always)]
    fn store<V: Simd>([low, _]: [V::Int; 2], block: &mut V::Block<Self>) {
        <Self as Stored<One>>::store::<V>(low, block);
    }
}

impl StoredFrame for u64 {
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> [V::Int; 2] {
        <Self as Stored<Two>>::load::<V>(block)
    }
    #[inline(always)]
    fn store<V: Simd>(code: [V::Int; 2], block: &mut V::Block<Self>) {
        <Self as Stored<Two>>::store::<V>(code, block);
    }
}

impl StoredFrame for [i16; 4] {
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> [V::Int; 2] {
        let pair = |low: i16, high: i16| u32::from(low as u16) | u32::from(high as u16) << 16;
        [
            V::load_int(block, |[x, y, _, _]: Self| pair(x, y)),
            V::load_int(block, |[_, _, z, w]: Self| pair(z, w)),
        ]
    }
    #[inline(always)]
    fn store<V: Simd>([low, high]: [V::Int; 2], block: &mut V::Block<Self>) {
        V::store_int(low, block, |[x, y, _, _], i| (*x, *y) = (i as i16, (i >> 16) as i16));
        V::store_int(high, block, |[_, _, z, w], i| (*z, *w) = (i as i16, (i >> 16) as i16));
    }
}
