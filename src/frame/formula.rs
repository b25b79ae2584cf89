//! The trait that every family of frame codecs implements, and what they share: the input, and the
//! basis of a normal.

use crate::batch::storage::{CodeKind, DoubleWords, ShapeIn};
use crate::formula::support::sanitize::{magnitude, sanitize};
use crate::simd::math::{atan2_half_turns, sqrt};
use crate::simd::{Simd, SimdInt, Vec3, map_vec};

/// A representation of frames, on any number of lanes. A code is two words, of which the second is 0
/// if it has at most 32 bits.
pub(super) trait FrameFormula: Copy + Send + Sync + 'static {
    /// The code of a frame, canonical, with the nearest normal if `PRECISE`.
    fn encode<V: Simd, const PRECISE: bool>(self, frame: Prepared<V>) -> [V::Int; 2];

    /// Total: an orthonormal frame for every bit pattern.
    fn decode<V: Simd>(self, code: [V::Int; 2]) -> Decoded<V>;

    /// The code that encoders emit for the frame of `code`.
    fn canonical<V: Simd>(self, code: [V::Int; 2]) -> [V::Int; 2];
}

/// A frame of any kind, made one that can be encoded.
pub(super) struct Prepared<V: Simd> {
    /// A direction as [`Formula`](crate::formula::Formula) encodes it.
    pub(super) normal: Vec3<V>,
    /// Its unit vector.
    pub(super) unit_normal: Vec3<V>,
    /// The component of the tangent perpendicular to the normal.
    tangent: Vec3<V>,
    /// Whether there is a tangent that is not parallel to the normal.
    across: V::Mask,
    /// The squared sine of the difference between 90 degrees and the angle from normal to tangent.
    pub(super) sin_squared: V,
    /// Whether the handedness is -1.
    pub(super) negative: V::Mask,
}

impl<V: Simd> Prepared<V> {
    #[inline(always)]
    pub(super) fn new(normal: Vec3<V>, tangent: Vec3<V>, handedness: V) -> Self {
        /// 2^-40, for 2^-20 radians: a few roundings of a parallel vector are far below.
        const LEAST: f32 = 9.094_947e-13;
        // Neither zero nor NaN.
        let given = V::splat(0.0).lt(magnitude(tangent));
        let normal = sanitize(normal);
        let unit_normal = normal.normalize();
        let tangent = sanitize(tangent).normalize();
        let along = unit_normal.dot(tangent);
        let across = unit_normal.cross(tangent).length_squared();
        Prepared {
            normal,
            unit_normal,
            tangent: tangent - unit_normal * along,
            across: given & V::splat(LEAST).lt(across),
            sin_squared: V::select(given, (along * along).min(1.0), 1.0),
            negative: handedness.lt(0.0),
        }
    }

    /// The tangent's coordinates in the plane of two vectors perpendicular to the normal.
    #[inline(always)]
    pub(super) fn tangent_in(&self, [a, b]: [Vec3<V>; 2]) -> [V; 2] {
        [
            V::select(self.across, self.tangent.dot(a), 1.0),
            V::select(self.across, self.tangent.dot(b), 0.0),
        ]
    }
}

/// A decoded frame.
pub(super) struct Decoded<V> {
    pub(super) normal: Vec3<V>,
    pub(super) tangent: Vec3<V>,
    pub(super) handedness: V,
}

/// Two unit vectors perpendicular to a unit vector and each other, a right-handed system with it as
/// the third (Duff et al. 2017).
#[inline(always)]
pub(super) fn basis<V: Simd>(Vec3 { x, y, z }: Vec3<V>) -> [Vec3<V>; 2] {
    let one = V::splat(1.0);
    let sign = one.negate_where_negative(z);
    let a = -one / (sign + z);
    let b = x * y * a;
    [Vec3::new(sign * x * x * a + one, sign * b, -(sign * x)), Vec3::new(b, sign + y * y * a, -y)]
}

/// u a + w b, over its length, without negative zeros.
#[inline(always)]
pub(super) fn unit_combination<V: Simd>([u, w]: [V; 2], [a, b]: [Vec3<V>; 2]) -> Vec3<V> {
    unsigned_zeros((a * u + b * w).normalize())
}

/// Replaces -0 by 0.
#[inline(always)]
pub(super) fn unsigned_zeros<V: Simd>(v: Vec3<V>) -> Vec3<V> {
    map_vec!(v, |c| c + 0.0)
}

/// 1, or -1 where the highest bit is set.
#[inline(always)]
pub(super) fn sign<V: Simd>(bits: V::Int) -> V {
    V::from_bits((bits & i32::MIN) | 1.0f32.to_bits() as i32)
}

/// The angle whose sine has this square, from 0 to 1.
#[inline]
pub(super) fn skew_degrees(sin_squared: f32) -> f32 {
    // Below this a root is not defined, nor can anyone see it.
    if sin_squared < f32::MIN_POSITIVE {
        return 0.0;
    }
    let (sin, cos) = (sqrt(sin_squared), sqrt(1.0 - sin_squared));
    atan2_half_turns(sin, cos) * 180.0
}

/// Bytes that hold a code of two words.
pub(super) trait FrameCodes: CodeKind {
    fn to_words<V: Simd>(code: ShapeIn<Self::Shape, V>) -> [V::Int; 2];
    fn from_words<V: Simd>(words: [V::Int; 2]) -> ShapeIn<Self::Shape, V>;
}

impl FrameCodes for [u8; 4] {
    #[inline(always)]
    fn to_words<V: Simd>(code: V::Int) -> [V::Int; 2] {
        [code, V::Int::splat(0)]
    }
    #[inline(always)]
    fn from_words<V: Simd>([low, _]: [V::Int; 2]) -> V::Int {
        low
    }
}

impl FrameCodes for [u8; 8] {
    #[inline(always)]
    fn to_words<V: Simd>(code: [V::Int; 2]) -> [V::Int; 2] {
        code
    }
    #[inline(always)]
    fn from_words<V: Simd>(words: [V::Int; 2]) -> [V::Int; 2] {
        words
    }
}

impl FrameCodes for DoubleWords {
    #[inline(always)]
    fn to_words<V: Simd>(code: [V::Int; 2]) -> [V::Int; 2] {
        code
    }
    #[inline(always)]
    fn from_words<V: Simd>(words: [V::Int; 2]) -> [V::Int; 2] {
        words
    }
}
