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

use core::marker::PhantomData;

use super::support::bits::snorm_max;
use super::support::closest::{Closest, corners};
use super::support::sign::mirror_point;
use super::{Formula, Symmetric, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{atan2_half_turns, sin_cos_of_half};
use crate::simd::{Simd, SimdInt, Vec3, map_vec, map2};

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

/// One of the three axes in each lane.
#[derive(Clone, Copy)]
struct Axis<V: Simd> {
    is_x: V::Mask,
    is_y: V::Mask,
}

impl<V: Simd> Axis<V> {
    /// Axis 0, 1 or 2.
    #[inline(always)]
    fn new(index: V::Int) -> Self {
        Axis { is_x: index.eq(0), is_y: index.eq(1) }
    }

    /// 0, 1 or 2.
    #[inline(always)]
    fn index(self) -> V::Int {
        V::Int::select(self.is_x, 0, V::Int::select(self.is_y, 1, 2))
    }

    #[inline(always)]
    fn pick_int(self, [x, y, z]: [V::Int; 3]) -> V::Int {
        V::Int::select(self.is_x, x, V::Int::select(self.is_y, y, z))
    }

    #[inline(always)]
    fn pick(self, [x, y, z]: [V; 3]) -> V {
        V::select(self.is_x, x, V::select(self.is_y, y, z))
    }

    /// Rotates components so that this axis is first.
    #[inline(always)]
    fn first(self, v: Vec3<V>) -> Vec3<V> {
        let Vec3 { x, y, z } = v;
        Vec3::new(self.pick([x, y, z]), self.pick([y, z, x]), self.pick([z, x, y]))
    }

    /// [`first`](Axis::first) for integers.
    #[inline(always)]
    fn first_int(self, v: Vec3<V::Int>) -> Vec3<V::Int> {
        let Vec3 { x, y, z } = v;
        Vec3::new(self.pick_int([x, y, z]), self.pick_int([y, z, x]), self.pick_int([z, x, y]))
    }

    /// The inverse of [`first`](Axis::first).
    #[inline(always)]
    fn back(self, v: Vec3<V>) -> Vec3<V> {
        let Vec3 { x: main, y: a, z: b } = v;
        Vec3::new(self.pick([main, b, a]), self.pick([a, main, b]), self.pick([b, a, main]))
    }

    /// [`back`](Axis::back) for integers.
    #[inline(always)]
    fn back_int(self, v: Vec3<V::Int>) -> Vec3<V::Int> {
        let Vec3 { x: main, y: a, z: b } = v;
        Vec3::new(
            self.pick_int([main, b, a]),
            self.pick_int([a, main, b]),
            self.pick_int([b, a, main]),
        )
    }
}

/// The axis of the largest component, X before Y before Z, and the vector with that component first.
#[inline(always)]
fn largest_first<V: Simd>(v: Vec3<V>) -> (Axis<V>, Vec3<V>) {
    let Vec3 { x, y, z } = v.abs();
    let is_x = y.le(x) & z.le(x);
    let axis = Axis { is_x, is_y: !is_x & z.le(y) };
    (axis, axis.first(v))
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
        let [a, b] = map2!([3, 3 + self.side], |shift| {
            code.shr_logical(shift).sign_extend(self.side).max(-self.max)
        });
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

/// Schinko's cube map: cells, `side` of them along an edge of the cube.
#[derive(Clone, Copy)]
pub(crate) struct AngularCube {
    bits: u32,
    side: i32,
}

impl AngularCube {
    pub(crate) const fn new(bits: u32) -> Self {
        AngularCube { bits, side: ((1u64 << bits) / 6).isqrt() as i32 }
    }

    #[inline(always)]
    fn pack<V: Simd>(self, [i, j]: [V::Int; 2], face: V::Int) -> V::Int {
        (i * self.side + j) * 6 + face
    }

    #[inline(always)]
    fn vector<V: Simd>(self, cell: [V::Int; 2], face: V::Int) -> Vec3<V> {
        let [a, b] = map2!(cell, |i| {
            // Half of (2 i + 1) / s - 1, in quarter turns.
            let odd = i + i + 1 - self.side;
            let (sin, cos) = sin_cos_of_half(V::from_int(odd) * (0.5 / self.side as f32));
            sin / cos
        });
        let main = V::select(face.low_bits(1).eq(1), -1.0, 1.0);
        Axis::new(face.shr_logical(1)).back(Vec3::new(main, a, b)).normalize()
    }

    /// The cell's coordinates, of which the integers are the centres; and the face.
    #[inline(always)]
    fn params<V: Simd>(self, v: Vec3<V>) -> ([V; 2], V::Int) {
        let (axis, Vec3 { x: main, y: a, z: b }) = largest_first(v);
        let half = 0.5 * self.side as f32;
        let params =
            map2!([a, b], |side| WarpedFace::param(side, main.abs()) * half + (half - 0.5));
        let index = axis.index();
        (params, index + index + V::Int::select(main.lt(0.0), 1, 0))
    }

    #[inline(always)]
    fn clamp<V: Simd>(self, cell: [V::Int; 2]) -> [V::Int; 2] {
        map2!(cell, |i| i.clamp(0, self.side - 1))
    }

    /// The cell of a code, and its face.
    #[inline(always)]
    fn unpack<V: Simd>(self, code: V::Int) -> ([V::Int; 2], V::Int) {
        let (cell, face) = div_rem::<V, 6>(code.low_bits(self.bits));
        // Quotient below 2^15, to within one.
        let i = (V::from_int(cell) * (1.0 / self.side as f32)).floor().round_int();
        let j = cell - i * self.side;
        let (early, late) = (j.lt(0), !j.lt(self.side));
        let i = V::Int::select(early, i - 1, V::Int::select(late, i + 1, i));
        let j = V::Int::select(early, j + self.side, V::Int::select(late, j - self.side, j));
        let beyond = !i.lt(self.side);
        let last = self.side - 1;
        let cell = [V::Int::select(beyond, last, i), V::Int::select(beyond, last, j)];
        (cell, V::Int::select(beyond, 5, face))
    }

    /// Cells from the middle of an edge to its end.
    const fn half_side(self) -> i32 {
        (self.side + 1) / 2
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        let half = self.half_side() as usize;
        3 * half * half
    }
}

impl Formula for AngularCube {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let (params, face) = self.params(v);
        self.pack::<V>(self.clamp::<V>(map2!(params, |p| p.round_int())), face)
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let (params, face) = self.params(v);
        let mut closest = Closest::to(v);
        for cell in corners(params) {
            let cell = self.clamp::<V>(cell);
            closest.consider(self.pack::<V>(cell, face), self.vector(cell, face));
        }
        closest.code()
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        let (cell, face) = self.unpack::<V>(code);
        self.vector(cell, face)
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        let ([i, j], face) = self.unpack::<V>(code);
        let flips = map_vec!(Vec3::from(flips), |flip| V::Int::splat(-i32::from(flip)));
        let Vec3 { x: main, y: a, z: b } = Axis::<V>::new(face.shr_logical(1)).first_int(flips);
        // From the other end: side + (-1 - i), and -1 - i is i with all bits flipped.
        let cell = [(i ^ a) + (a & self.side), (j ^ b) + (b & self.side)];
        self.pack::<V>(cell, face ^ main.low_bits(1))
    }
}

impl Symmetric for AngularCube {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let (cell, face) = self.unpack::<V>(code);
        let axis = face.shr_logical(1);
        let [a, b] = map2!(cell, |i| i + i + (1 - self.side));
        let half = self.half_side();
        let index = (axis * half + a.abs().shr_logical(1)) * half + b.abs().shr_logical(1);
        let point = Axis::<V>::new(axis).back_int(Vec3::new(-face.low_bits(1), a, b));
        (index, point.is_negative_int())
    }
}

/// Quotient and remainder of an unsigned integer by a small `D`, at most 32: by halves, each exact
/// in f32.
#[inline(always)]
fn div_rem<V: Simd, const D: i32>(n: V::Int) -> (V::Int, V::Int) {
    /// floor(n / D) for n < 2^21.
    #[inline(always)]
    fn divide<V: Simd, const D: i32>(n: V::Int) -> V::Int {
        // floor((n + 1/2) / D) is never within rounding of an integer.
        ((V::from_int(n) + 0.5) * (1.0 / D as f32)).floor().round_int()
    }
    let high = divide::<V, D>(n.shr_logical(16));
    let rest = (n.shr_logical(16) - high * D).shl(16) + n.low_bits(16);
    let low = divide::<V, D>(rest);
    (high.shl(16) + low, rest - low * D)
}

kernels!(Cube<Linear>: Words; Cube<WarpedFace>: Words; AngularCube: Words);
