//! What a family of frame codecs writes, and what they share: the input, and the basis of a normal.

use bytemuck::Pod;

use crate::batch::Encoder;
use crate::formula::{One, Stored, Two, direction, magnitude};
use crate::lane::{Each, Lane, LaneInt};
use crate::math;

/// A representation of frames, as arithmetic on lanes. A code is two words, of which the second is 0 if
/// it has at most 32 bits.
pub(crate) trait FrameFormula: 'static {
    /// The code of a frame, canonical: its normal by the encoder `E`.
    fn encode<E: Encoder, L: Lane>(frame: Prepared<L>) -> [L::Int; 2];

    /// Total: an orthonormal frame for every bit pattern.
    fn decode<L: Lane>(code: [L::Int; 2]) -> Decoded<L>;

    /// The code that encoders emit for the frame of `code`.
    fn canonical<L: Lane>(code: [L::Int; 2]) -> [L::Int; 2];
}

/// A frame of any kind, made one that can be encoded.
pub(crate) struct Prepared<L: Lane> {
    /// A direction as [`Formula`](crate::formula::Formula) encodes it.
    pub(crate) normal: [L; 3],
    /// Its unit vector.
    pub(crate) unit_normal: [L; 3],
    /// Its part across the normal.
    tangent: [L; 3],
    /// Whether there is a tangent that is not parallel to the normal.
    across: L::Mask,
    /// The squared sine of what the angle between normal and tangent lacks of 90 degrees.
    pub(crate) sin_squared: L,
    /// Whether the handedness is -1.
    pub(crate) negative: L::Mask,
}

impl<L: Lane> Prepared<L> {
    #[inline(always)]
    pub(crate) fn new(normal: [L; 3], tangent: [L; 3], handedness: L) -> Self {
        /// 2^-40, for 2^-20 radians: a few roundings of a parallel vector are far below.
        const LEAST: f32 = 9.094_947e-13;
        let (zero, one) = (L::zero(), L::splat(1.0));
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
            across: given & L::splat(LEAST).lt(across),
            sin_squared: L::select(given, (along * along).lesser(one), one),
            negative: handedness.lt(zero),
        }
    }

    /// The tangent's coordinates in the plane of two vectors across the normal.
    #[inline(always)]
    pub(crate) fn tangent_in(&self, [a, b]: [[L; 3]; 2]) -> [L; 2] {
        [
            L::select(self.across, math::dot(self.tangent, a), L::splat(1.0)),
            L::select(self.across, math::dot(self.tangent, b), L::zero()),
        ]
    }
}

/// A decoded frame.
pub(crate) struct Decoded<L> {
    pub(crate) normal: [L; 3],
    pub(crate) tangent: [L; 3],
    pub(crate) handedness: L,
}

/// Two unit vectors across a unit vector and each other, a right-handed system with it as the third
/// (Duff et al. 2017).
#[inline(always)]
pub(crate) fn basis<L: Lane>([x, y, z]: [L; 3]) -> [[L; 3]; 2] {
    let one = L::splat(1.0);
    let sign = one.negate_where_negative(z);
    let a = -one / (sign + z);
    let b = x * y * a;
    [[one + sign * x * x * a, sign * b, -(sign * x)], [b, sign + y * y * a, -y]]
}

/// u a + w b, over its length, without negative zeros.
#[inline(always)]
pub(crate) fn unit_combination<L: Lane>([u, w]: [L; 2], [a, b]: [[L; 3]; 2]) -> [L; 3] {
    let v = [0, 1, 2].each(
        #[inline(always)]
        |i: usize| u * a[i] + w * b[i],
    );
    math::normalize(v).each(|c| c + L::zero())
}

/// 1, or -1 where the highest bit is set.
#[inline(always)]
pub(crate) fn sign<L: Lane>(bits: L::Int) -> L {
    L::from_bits(L::splat(1.0).to_bits() | (bits & L::Int::splat(i32::MIN)))
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
    fn load<L: Lane>(block: &L::Block<Self>) -> [L::Int; 2];
    fn store<L: Lane>(code: [L::Int; 2], block: &mut L::Block<Self>);
}

impl StoredFrame for u32 {
    #[inline(always)]
    fn load<L: Lane>(block: &L::Block<Self>) -> [L::Int; 2] {
        [<Self as Stored<One>>::load::<L>(block), L::Int::splat(0)]
    }
    #[inline(always)]
    fn store<L: Lane>([low, _]: [L::Int; 2], block: &mut L::Block<Self>) {
        <Self as Stored<One>>::store::<L>(low, block);
    }
}

impl StoredFrame for u64 {
    #[inline(always)]
    fn load<L: Lane>(block: &L::Block<Self>) -> [L::Int; 2] {
        <Self as Stored<Two>>::load::<L>(block)
    }
    #[inline(always)]
    fn store<L: Lane>(code: [L::Int; 2], block: &mut L::Block<Self>) {
        <Self as Stored<Two>>::store::<L>(code, block);
    }
}

impl StoredFrame for [i16; 4] {
    #[inline(always)]
    fn load<L: Lane>(block: &L::Block<Self>) -> [L::Int; 2] {
        let pair = |low: i16, high: i16| u32::from(low as u16) | u32::from(high as u16) << 16;
        [
            L::load_int(block, |[x, y, _, _]: Self| pair(x, y)),
            L::load_int(block, |[_, _, z, w]: Self| pair(z, w)),
        ]
    }
    #[inline(always)]
    fn store<L: Lane>([low, high]: [L::Int; 2], block: &mut L::Block<Self>) {
        L::store_int(low, block, |[x, y, _, _], i| (*x, *y) = (i as i16, (i >> 16) as i16));
        L::store_int(high, block, |[_, _, z, w], i| (*z, *w) = (i as i16, (i >> 16) as i16));
    }
}
