//! Mirror images of integers, masks and points. Whether to mirror is the same for all lanes.

use crate::simd::{Simd, SimdInt, SimdMask, Vec3};

/// -i if `flip`. Without a branch, which would remain in a loop.
#[inline(always)]
pub(crate) fn negate_if<I: SimdInt>(i: I, flip: bool) -> I {
    let mask = -i32::from(flip);
    (i ^ mask) - mask
}

/// [`negate_if`] for the components of a point.
#[inline(always)]
pub(crate) fn mirror_point<I: SimdInt>(point: Vec3<I>, flips: [bool; 3]) -> Vec3<I> {
    Vec3::new(
        negate_if(point.x, flips[0]),
        negate_if(point.y, flips[1]),
        negate_if(point.z, flips[2]),
    )
}

/// The opposite of `mask` if `flip`.
#[inline(always)]
pub(crate) fn not_if<M: SimdMask>(mask: M, flip: bool) -> M {
    let flip = M::splat(flip);
    mask & !flip | !mask & flip
}

/// The sign bit of an `f32` if `flip`.
#[inline(always)]
pub(crate) fn sign_bit(flip: bool) -> i32 {
    i32::from(flip) << 31
}

/// A vector whose components change their sign bit if they are to be mirrored.
#[inline(always)]
pub(crate) fn mirror_vector<V: Simd>(v: Vec3<V>, flips: [bool; 3]) -> Vec3<V> {
    Vec3::new(
        V::from_bits(v.x.to_bits() ^ sign_bit(flips[0])),
        V::from_bits(v.y.to_bits() ^ sign_bit(flips[1])),
        V::from_bits(v.z.to_bits() ^ sign_bit(flips[2])),
    )
}
