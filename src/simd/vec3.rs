//! Vectors of three components, and `map` over two to four values.

use core::ops::{Add, Index, IndexMut, Mul, Neg, Sub};

use super::math::inv_sqrt;
use super::{Simd, SimdInt};

/// `map` over a `[T; 2]`. Unlike a closure's, the body is always inlined, and so compiled with the
/// target features of the loop around it.
macro_rules! map2 {
    ($array:expr, |$element:ident $(: $type:ty)?| $body:expr) => {{
        let [a, b] = $array;
        let a = { let $element $(: $type)? = a; $body };
        let b = { let $element $(: $type)? = b; $body };
        [a, b]
    }};
}

/// [`map2`] over a `[T; 3]`.
macro_rules! map3 {
    ($array:expr, |$element:ident $(: $type:ty)?| $body:expr) => {{
        let [a, b, c] = $array;
        let a = { let $element $(: $type)? = a; $body };
        let b = { let $element $(: $type)? = b; $body };
        let c = { let $element $(: $type)? = c; $body };
        [a, b, c]
    }};
}

/// [`map2`] over a `[T; 4]`.
macro_rules! map4 {
    ($array:expr, |$element:ident $(: $type:ty)?| $body:expr) => {{
        let [a, b, c, d] = $array;
        let a = { let $element $(: $type)? = a; $body };
        let b = { let $element $(: $type)? = b; $body };
        let c = { let $element $(: $type)? = c; $body };
        let d = { let $element $(: $type)? = d; $body };
        [a, b, c, d]
    }};
}

/// [`map2`] over the components of a [`Vec3`].
macro_rules! map_vec {
    ($vector:expr, |$component:ident $(: $type:ty)?| $body:expr) => {
        $crate::simd::Vec3::from($crate::simd::map3!($vector.to_array(), |$component $(: $type)?| $body))
    };
}

pub(crate) use {map_vec, map2, map3, map4};

/// Three components: floats, integers or masks, each a SIMD vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vec3<T> {
    pub(crate) x: T,
    pub(crate) y: T,
    pub(crate) z: T,
}

impl<T> From<[T; 3]> for Vec3<T> {
    #[inline(always)]
    fn from([x, y, z]: [T; 3]) -> Self {
        Vec3 { x, y, z }
    }
}

impl<T> Vec3<T> {
    #[inline(always)]
    pub(crate) const fn new(x: T, y: T, z: T) -> Self {
        Vec3 { x, y, z }
    }
}

impl<T: Copy> Vec3<T> {
    #[inline(always)]
    pub(crate) fn to_array(self) -> [T; 3] {
        [self.x, self.y, self.z]
    }
}

impl<T> Index<usize> for Vec3<T> {
    type Output = T;
    #[inline(always)]
    fn index(&self, axis: usize) -> &T {
        match axis {
            0 => &self.x,
            1 => &self.y,
            _ => &self.z,
        }
    }
}

impl<T> IndexMut<usize> for Vec3<T> {
    #[inline(always)]
    fn index_mut(&mut self, axis: usize) -> &mut T {
        match axis {
            0 => &mut self.x,
            1 => &mut self.y,
            _ => &mut self.z,
        }
    }
}

impl<T: Add<Output = T>> Add for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Vec3::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<T: Sub<Output = T>> Sub for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Vec3::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<T: Neg<Output = T>> Neg for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Vec3::new(-self.x, -self.y, -self.z)
    }
}

impl<T: Mul<S, Output = T>, S: Copy> Mul<S> for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, scale: S) -> Self {
        Vec3::new(self.x * scale, self.y * scale, self.z * scale)
    }
}

impl<V: Simd> Vec3<V> {
    /// The components over their length 1: (0, 0, 1) and the like are exact.
    #[inline(always)]
    pub(crate) fn normalize(self) -> Self {
        self * inv_sqrt(self.length_squared())
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> V {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Vec3::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    #[inline(always)]
    pub(crate) fn length_squared(self) -> V {
        self.dot(self)
    }

    /// The product of each component with that of `other`.
    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Self {
        Vec3::new(self.x * other.x, self.y * other.y, self.z * other.z)
    }

    /// Squared distance between two points.
    #[inline(always)]
    pub(crate) fn distance_squared(self, other: Self) -> V {
        (self - other).length_squared()
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        map_vec!(self, |c| c.abs())
    }

    /// Greatest component.
    #[inline(always)]
    pub(crate) fn max_component(self) -> V {
        self.x.max(self.y).max(self.z)
    }

    /// Smallest component.
    #[inline(always)]
    pub(crate) fn min_component(self) -> V {
        self.x.min(self.y).min(self.z)
    }

    #[inline(always)]
    pub(crate) fn floor(self) -> Self {
        map_vec!(self, |c| c.floor())
    }

    #[inline(always)]
    pub(crate) fn round_int(self) -> Vec3<V::Int> {
        map_vec!(self, |c| c.round_int())
    }

    #[inline(always)]
    pub(crate) fn from_int(i: Vec3<V::Int>) -> Self {
        map_vec!(i, |i| V::from_int(i))
    }

    /// Which components are negative.
    #[inline(always)]
    pub(crate) fn is_negative(self) -> Vec3<V::Mask> {
        map_vec!(self, |c| c.lt(0.0))
    }

    /// Each component negated where that of `signs` is negative.
    #[inline(always)]
    pub(crate) fn negate_where_negative(self, signs: Self) -> Self {
        Vec3::new(
            self.x.negate_where_negative(signs.x),
            self.y.negate_where_negative(signs.y),
            self.z.negate_where_negative(signs.z),
        )
    }

    #[inline(always)]
    pub(crate) fn select(mask: V::Mask, yes: Self, no: Self) -> Self {
        Vec3::new(
            V::select(mask, yes.x, no.x),
            V::select(mask, yes.y, no.y),
            V::select(mask, yes.z, no.z),
        )
    }
}

/// Vectors of integers. The functions have names of their own, as those of floats are inherent too.
impl<I: SimdInt> Vec3<I> {
    #[inline(always)]
    pub(crate) fn abs_int(self) -> Self {
        map_vec!(self, |i| i.abs())
    }

    #[inline(always)]
    pub(crate) fn is_negative_int(self) -> Vec3<I::Mask> {
        map_vec!(self, |i| i.lt(0))
    }

    #[inline(always)]
    pub(crate) fn select_int(mask: I::Mask, yes: Self, no: Self) -> Self {
        Vec3::new(
            I::select(mask, yes.x, no.x),
            I::select(mask, yes.y, no.y),
            I::select(mask, yes.z, no.z),
        )
    }
}
