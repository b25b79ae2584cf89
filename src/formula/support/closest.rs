//! Chooses the nearest of several codes.

use crate::simd::{Simd, SimdInt, SimdMask, Vec3};

/// The candidate so far that decodes closest to a vector.
pub(crate) struct Closest<V: Simd> {
    target: Vec3<V>,
    code: V::Int,
    distance: V,
}

impl<V: Simd> Closest<V> {
    /// `target` needs no unit length.
    #[inline(always)]
    pub(crate) fn to(target: Vec3<V>) -> Self {
        Self::to_unit(target.normalize())
    }

    /// `target` has unit length. What decodes to its very bits is at distance 0.
    #[inline(always)]
    pub(crate) fn to_unit(target: Vec3<V>) -> Self {
        Closest { target, code: V::Int::splat(0), distance: V::splat(f32::INFINITY) }
    }

    /// Considers a code that decodes to the unit vector `decoded`. The first of equals stays.
    #[inline(always)]
    pub(crate) fn consider(&mut self, code: V::Int, decoded: Vec3<V>) {
        self.consider_where(V::Mask::splat(true), code, decoded);
    }

    /// Considers a code in some lanes.
    #[inline(always)]
    pub(crate) fn consider_where(&mut self, counts: V::Mask, code: V::Int, decoded: Vec3<V>) {
        let distance = decoded.distance_squared(self.target);
        let closer = counts & distance.lt(self.distance);
        self.code = V::Int::select(closer, code, self.code);
        self.distance = V::select(closer, distance, self.distance);
    }

    /// Whether in every lane the closest so far decodes to the target itself.
    #[inline(always)]
    pub(crate) fn is_exact(&self) -> bool {
        !V::splat(0.0).lt(self.distance).any()
    }

    /// Squared distance to the closest so far.
    #[inline(always)]
    pub(crate) fn distance_squared(&self) -> V {
        self.distance
    }

    #[inline(always)]
    pub(crate) fn code(self) -> V::Int {
        self.code
    }
}

/// Two parameters of at most 16 bits, as one integer for [`Closest`].
#[inline(always)]
pub(crate) fn join<V: Simd>([u, w]: [V::Int; 2]) -> V::Int {
    u.low_bits(16) | w.shl(16)
}

/// The parameters of [`join`].
#[inline(always)]
pub(crate) fn split<V: Simd>(joined: V::Int) -> [V::Int; 2] {
    [joined.sign_extend(16), joined.shr_arithmetic(16)]
}

/// floor(x) and ceil(x), the nearer one first. For an integer, the other one is below.
#[inline(always)]
pub(crate) fn floor_and_ceil<V: Simd>(x: V) -> [V::Int; 2] {
    let near = x.round_int();
    let up = V::from_int(near).lt(x);
    [near, near + V::Int::select(up, 1, -1)]
}

/// Two parameters, each rounded down or up. They may be one step out of range.
#[inline(always)]
pub(crate) fn corners<V: Simd>([u, w]: [V; 2]) -> [[V::Int; 2]; 4] {
    let ([u0, u1], [w0, w1]) = (floor_and_ceil(u), floor_and_ceil(w));
    [[u0, w0], [u1, w0], [u0, w1], [u1, w1]]
}
