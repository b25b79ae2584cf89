//! The trait that every family of rotations implements, and its kernels.

use crate::batch::columns::{CodeColumn, Columns};
use crate::batch::layout::{self, Codes, CodesMut, Vectors, VectorsMut};
use crate::batch::storage::{CodeKind, CodeShape, ShapeIn};
use crate::batch::{Kernel, map, run};
use crate::formula::support::sanitize::sanitize4;
use crate::simd::{Simd, Use};

/// A representation of rotations, on any number of lanes. See
/// [`Formula`](crate::formula::Formula).
pub(super) trait Rotation: Copy + Send + Sync + 'static {
    /// Number of words that hold a code in lanes.
    type Shape: CodeShape;

    /// The fast encoder, of what [`sanitize4`] returns. Gives canonical codes.
    fn encode<V: Simd>(self, q: [V; 4]) -> Code<Self, V>;
    /// The code whose decoded rotation is closest to that of `q`, canonical.
    fn encode_precise<V: Simd>(self, q: [V; 4]) -> Code<Self, V>;
    /// Total: a unit quaternion for every bit pattern.
    fn decode<V: Simd>(self, code: Code<Self, V>) -> [V; 4];
    /// The code that encoders emit for the rotation of `code`.
    fn canonical<V: Simd>(self, code: Code<Self, V>) -> Code<Self, V>;
}

/// A code of the rotation `R` in lanes.
pub(super) type Code<R, V> = ShapeIn<<R as Rotation>::Shape, V>;

/// The kernels of a codec, in any layout, compiled here: see [`Kernels`](crate::formula::Kernels).
pub trait RotationKernels {
    /// [`QuaternionCodec::encode_soa`](super::QuaternionCodec::encode_soa) and the like.
    fn encode_batch(quaternions: Vectors<'_, 4>, codes: CodesMut<'_>);
    /// [`QuaternionCodec::encode_soa_precise`](super::QuaternionCodec::encode_soa_precise) and the like.
    fn encode_batch_precise(quaternions: Vectors<'_, 4>, codes: CodesMut<'_>);
    /// [`QuaternionCodec::decode_soa`](super::QuaternionCodec::decode_soa) and the like.
    fn decode_batch(codes: Codes<'_>, quaternions: VectorsMut<'_, 4>);
}

/// [`Rotation::encode`] or [`Rotation::encode_precise`].
#[derive(Clone, Copy)]
struct Encode<R, const PRECISE: bool>(R);
/// [`Rotation::decode`].
#[derive(Clone, Copy)]
struct Decode<R>(R);

impl<R: Rotation, K: CodeKind<Shape = R::Shape>, const PRECISE: bool>
    Kernel<Columns<4>, CodeColumn<K>> for Encode<R, PRECISE>
{
    const USE: Use = if PRECISE { Use::Sometimes } else { Use::Often };

    #[inline(always)]
    fn run<V: Simd>(self, q: [V; 4]) -> Code<R, V> {
        let q = sanitize4(q);
        if PRECISE { self.0.encode_precise(q) } else { self.0.encode(q) }
    }
}

impl<R: Rotation, K: CodeKind<Shape = R::Shape>> Kernel<CodeColumn<K>, Columns<4>> for Decode<R> {
    #[inline(always)]
    fn run<V: Simd>(self, code: Code<R, V>) -> [V; 4] {
        self.0.decode::<V>(code)
    }
}

#[inline(always)]
pub(super) fn encode<R: Rotation, K: CodeKind<Shape = R::Shape>, const PRECISE: bool>(
    rotation: R,
    quaternions: Vectors<'_, 4>,
    codes: CodesMut<'_>,
) {
    layout::encode(quaternions, codes, &mut |q, codes| {
        map::<Columns<4>, CodeColumn<K>>(Encode::<R, PRECISE>(rotation), q, codes);
    });
}

#[inline(always)]
pub(super) fn decode<R: Rotation, K: CodeKind<Shape = R::Shape>>(
    rotation: R,
    codes: Codes<'_>,
    quaternions: VectorsMut<'_, 4>,
) {
    layout::decode(codes, quaternions, &mut |codes, q, fence| {
        run::<CodeColumn<K>, Columns<4>>(Decode(rotation), codes, q, fence);
    });
}
