//! Cube maps: the face of the largest component, and the two others over it.
//!
//! ```text
//! cube         a, b = next / |axis|, next but one / |axis|
//! warpedcube   a, b = (4 / pi) atan of the two
//!              code = face in 3 bits (2 axis + sign), snorm(a), snorm(b) of floor((BITS - 3) / 2) bits each
//! angularcube  s = floor(sqrt(2^BITS / 6)) cells along an edge;  i = floor((a + 1) s / 2) with the warped a, and j
//!              index = (i s + j) 6 + face, faces in the order +X, -X, +Y, -Y, +Z, -Z;  decoded to the cell's centre
//! ```
//!
//! Canonical: a point of an edge belongs to the face of the first of its axes, X before Y before Z.
//! Faces 6 and 7 read as 4 and 5; indices beyond the last cell as the last. All six axes survive
//! exactly, but in angularcube only if s is odd.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; angularcube: Schinko, Ullrich and Fellner, "Simple and Efficient Normal Encoding with
//! Error Bounds", 2011.

mod angular;
mod axis;

pub(crate) use angular::AngularCube;

use core::marker::PhantomData;

use super::octant_table::octant_kernels;
use super::support::bits::{snorm_field, snorm_max};
use super::support::closest::{Closest, corners};
use super::support::sign::mirror_point;
use super::{Formula, Symmetric, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{atan2_half_turns, sin_cos_of_half};
use crate::simd::{Simd, SimdInt, Vec3, map_vec, map2};
use axis::{Axis, largest_first};

/// A cube map with spacing `W`.
#[derive(Clone, Copy)]
pub(crate) struct Cube<W> {
    /// Bits of a parameter.
    side: u32,
    max: i32,
    spacing: PhantomData<W>,
}

/// How a face is divided.
pub(crate) trait Spacing: Copy + Send + Sync + 'static {
    /// The parameter of `side / axis`, from -1 to 1, with axis > 0.
    fn param<V: Simd>(side: V, axis: V) -> V;
    /// The direction of the parameters of three components, one of them 1 or -1.
    fn direction<V: Simd>(params: Vec3<V>) -> Vec3<V>;
}

/// Even steps on the face.
#[derive(Clone, Copy)]
pub(crate) struct Linear;
/// Even steps of the angle.
#[derive(Clone, Copy)]
pub(crate) struct WarpedFace;

impl Spacing for Linear {
    #[inline(always)]
    fn param<V: Simd>(side: V, axis: V) -> V {
        side / axis
    }
    #[inline(always)]
    fn direction<V: Simd>(params: Vec3<V>) -> Vec3<V> {
        params
    }
}

impl Spacing for WarpedFace {
    #[inline(always)]
    fn param<V: Simd>(side: V, axis: V) -> V {
        atan2_half_turns(side, axis) * 4.0
    }
    #[inline(always)]
    fn direction<V: Simd>(params: Vec3<V>) -> Vec3<V> {
        map_vec!(params, |p| {
            let (sin, cos) = sin_cos_of_half(p * 0.5);
            V::select(V::splat(1.0).le(p.abs()), p, sin / cos)
        })
    }
}

impl<W: Spacing> Cube<W> {
    pub(crate) const fn new(bits: u32) -> Self {
        let side = (bits - 3) / 2;
        Cube { side, max: snorm_max(side), spacing: PhantomData }
    }

    /// The canonical code of a point of the cube from -M to M.
    #[inline(always)]
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> V::Int {
        let axis = Axis::<V> { is_x: point.x.abs().eq(self.max), is_y: point.y.abs().eq(self.max) };
        let Vec3 { x: main, y: a, z: b } = axis.first_int(point);
        let index = axis.index();
        (index + index)
            | main.shr_logical(31)
            | a.low_bits(self.side).shl(3)
            | b.low_bits(self.side).shl(3 + self.side)
    }

    /// The axis, and the point with the component there, which is M or -M, first.
    #[inline(always)]
    fn unpack<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Int>) {
        let negative = code.low_bits(1).eq(1);
        let axis = code.shr_logical(1).low_bits(2).min(2);
        let [a, b] = map2!([3, 3 + self.side], |at| snorm_field::<V>(code, at, self.side));
        (axis, Vec3::new(V::Int::select(negative, -self.max, self.max), a, b))
    }

    /// The point of a code.
    #[inline(always)]
    fn point_of<V: Simd>(self, code: V::Int) -> Vec3<V::Int> {
        let (axis, point) = self.unpack::<V>(code);
        Axis::<V>::new(axis).back_int(point)
    }

    #[inline(always)]
    fn vector<V: Simd>(self, point: Vec3<V::Int>) -> Vec3<V> {
        W::direction(Vec3::from_int(point) * (1.0 / self.max as f32)).normalize()
    }

    /// The parameters of the two smaller components, scaled to M; the axis of the largest, and its
    /// place, M or -M.
    #[inline(always)]
    fn params<V: Simd>(self, v: Vec3<V>) -> ([V; 2], Axis<V>, V::Int) {
        let (axis, Vec3 { x: main, y: a, z: b }) = largest_first(v);
        let end = V::Int::select(main.lt(0.0), -self.max, self.max);
        let params = map2!([a, b], |side| W::param(side, main.abs()) * self.max as f32);
        (params, axis, end)
    }

    /// A point of the cube from -M to M.
    #[inline(always)]
    fn point<V: Simd>(self, axis: Axis<V>, end: V::Int, sides: [V::Int; 2]) -> Vec3<V::Int> {
        let [a, b] = map2!(sides, |p| p.clamp(-self.max, self.max));
        axis.back_int(Vec3::new(end, a, b))
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        3 << (2 * (self.side - 1))
    }
}

impl<W: Spacing> Formula for Cube<W> {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let (params, axis, end) = self.params(v);
        self.pack::<V>(self.point(axis, end, map2!(params, |p| p.round_int())))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        V::with_target_features(
            #[inline(always)]
            || {
                let (params, axis, end) = self.params(v);
                let mut closest = Closest::to(v);
                for sides in corners(params) {
                    let point = self.point(axis, end, sides);
                    closest.consider(self.pack::<V>(point), self.vector(point));
                }
                closest.code()
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        self.vector(self.point_of::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        self.pack::<V>(mirror_point(self.point_of::<V>(code), flips))
    }
}

impl<W: Spacing> Symmetric for Cube<W> {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let (axis, point) = self.unpack::<V>(code);
        let (a, b) = (point.y.abs(), point.z.abs());
        let index = a | b.shl(self.side - 1) | axis.shl(2 * (self.side - 1));
        (index, Axis::<V>::new(axis).back_int(point).is_negative_int())
    }
}

kernels!(Cube<Linear>: Words; Cube<WarpedFace>: Words; AngularCube: Words);
octant_kernels!(Cube<Linear>, Cube<WarpedFace>, AngularCube);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::{VECTORS, assert_nearest};

    /// Parameters of 6 bits, from -31 to 31.
    const CUBE: Cube<Linear> = Cube::<Linear>::new(16);
    const WARPED: Cube<WarpedFace> = Cube::<WarpedFace>::new(16);

    /// A face, and the parameters.
    const fn code(face: i32, a: i32, b: i32) -> i32 {
        face | (a & 63) << 3 | (b & 63) << 9
    }

    fn mirror(code: i32, flips: [bool; 3]) -> i32 {
        CUBE.mirror::<f32>(code.into(), flips).0
    }

    #[test]
    fn the_face_is_that_of_the_largest_component() {
        // 31/4 = 7.75 and 31 * 3/4 = 23.25.
        for (v, expected) in [
            ([4.0f32, 1.0, -3.0], code(0, 8, -23)),
            ([-4.0, 1.0, -3.0], code(1, 8, -23)),
            // Next to y are z and then x.
            ([1.0, 4.0, 3.0], code(2, 23, 8)),
            ([1.0, -4.0, 3.0], code(3, 23, 8)),
            ([1.0, -3.0, 4.0], code(4, 8, -23)),
            ([1.0, -3.0, -4.0], code(5, 8, -23)),
        ] {
            assert_eq!(CUBE.encode(v.into()).0, expected, "{v:?}");
            assert_eq!(CUBE.encode_precise(v.into()).0, expected, "{v:?}");
        }
        assert_eq!(code(0, 8, -23), 0x5240);
        // (31, 8, -23) over its length 39.4208.
        let v = CUBE.decode::<f32>(0x5240.into());
        assert!(v.distance_squared(Vec3::new(0.786_387, 0.202_939, -0.583_449)) < 1e-11, "{v:?}");
    }

    #[test]
    fn warped_steps_are_of_the_angle() {
        // 15 degrees are a third of 45: 31/3 = 10.3.
        let v = Vec3::new(1.0f32, 0.267_949, 0.0);
        assert_eq!([WARPED.encode(v).0, WARPED.encode_precise(v).0], [code(0, 10, 0); 2]);
        // 45 * 10 / 31 = 14.516 degrees.
        let decoded = WARPED.decode::<f32>(code(0, 10, 0).into());
        assert!(decoded.distance_squared(Vec3::new(0.968_077, 0.250_653, 0.0)) < 1e-11);
    }

    #[test]
    fn axes_survive() {
        for face in 0..6 {
            let mut axis = [0.0f32; 3];
            axis[face / 2] = if face % 2 == 0 { 1.0 } else { -1.0 };
            let code = face as i32;
            assert_eq!([CUBE.encode(axis.into()).0, CUBE.encode_precise(axis.into()).0], [code; 2]);
            assert_eq!(
                [WARPED.encode(axis.into()).0, WARPED.encode_precise(axis.into()).0],
                [code; 2]
            );
            assert_eq!(CUBE.decode::<f32>(code.into()).to_array(), axis);
            assert_eq!(WARPED.decode::<f32>(code.into()).to_array(), axis);
        }
    }

    #[test]
    fn edges_belong_to_the_first_of_their_axes() {
        for (there, canonical) in [
            // (1, 1, 0), (-1, 0, 1) and (0, -1, 1), and the corner (1, -1, -1).
            (code(2, 0, 31), code(0, 31, 0)),
            (code(4, -31, 0), code(1, 0, 31)),
            (code(4, 0, -31), code(3, 31, 0)),
            (code(5, 31, -31), code(0, -31, -31)),
            (code(3, 31, 30), code(3, 31, 30)),
        ] {
            assert_eq!(mirror(there, [false; 3]), canonical);
            assert_eq!(CUBE.decode::<f32>(there.into()), CUBE.decode::<f32>(canonical.into()));
        }
        assert_eq!(CUBE.encode(Vec3::new(0.0f32, -1.0, 1.0)).0, code(3, 31, 0));
    }

    #[test]
    fn what_is_out_of_range_reads_as_its_neighbour() {
        // Faces 6 and 7, a parameter of -32, and the unused bit.
        for (there, canonical) in [
            (code(6, 8, -23), code(4, 8, -23)),
            (code(7, 8, -23), code(5, 8, -23)),
            (code(0, -32, 0), code(0, -31, 0)),
            (0x8000 | code(0, 8, -23), code(0, 8, -23)),
        ] {
            assert_eq!(mirror(there, [false; 3]), canonical);
            let indices = [there, canonical].map(|c| CUBE.octant_index::<f32>(c.into()).0);
            assert_eq!(indices[0], indices[1]);
        }
    }

    #[test]
    fn mirror_images_have_opposite_parameters() {
        for (flips, expected) in [
            ([true, false, false], code(3, 23, -8)),
            ([false, true, false], code(2, 23, 8)),
            ([false, false, true], code(3, -23, 8)),
        ] {
            assert_eq!(mirror(code(3, 23, 8), flips), expected);
        }
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        assert_nearest(Cube::<WarpedFace>::new(9), 512, VECTORS);
    }
}
