//! Angular cube: equal cells of each face, decoded to their centres.

use super::axis::{Axis, largest_first};
use super::{Spacing, WarpedFace};
use crate::batch::storage::Word;
use crate::formula::support::closest::{Closest, corners};
use crate::formula::{Formula, Symmetric};
use crate::simd::math::sin_cos_of_half;
use crate::simd::{Simd, SimdInt, Vec3, map_vec, map2};

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
