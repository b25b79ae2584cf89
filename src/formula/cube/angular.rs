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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::{assert_nearest, spiral};

    const fn cube(bits: u32) -> AngularCube {
        AngularCube::new(bits)
    }

    fn mirror(bits: u32, code: i32, flips: [bool; 3]) -> i32 {
        cube(bits).mirror::<f32>(code.into(), flips).0
    }

    #[test]
    fn the_index_counts_cells_and_then_faces() {
        // 104 = floor(sqrt(65536 / 6)) cells. 4 / pi times atan(1/4) is 0.3119, and of -3/4 -0.8193:
        // 52 (1 + 0.3119) = 68.2 and 52 (1 - 0.8193) = 9.4.
        let v = Vec3::new(4.0f32, 1.0, -3.0);
        let code = (68 * 104 + 9) * 6;
        assert_eq!([cube(16).encode(v).0, cube(16).encode_precise(v).0], [code; 2]);
        assert_eq!(cube(16).encode(Vec3::new(-3.0f32, -4.0, 1.0)).0, code + 3);
    }

    #[test]
    fn cells_decode_to_their_centres() {
        // Two cells along an edge: the middle of the first is at -22.5 degrees, whose tangent is -0.414214.
        let v = cube(5).decode::<f32>(0.into());
        assert!(v.distance_squared(Vec3::new(0.862_856, -0.357_407, -0.357_407)) < 1e-11, "{v:?}");
        assert_eq!(cube(5).encode(Vec3::new(1.0f32, 0.1, -0.1)).0, 2 * 6);
    }

    #[test]
    fn axes_survive_if_a_cell_is_in_the_middle() {
        // One cell along an edge, and three.
        for (bits, middle) in [(4, 0), (6, 4 * 6)] {
            for face in 0..6 {
                let mut axis = [0.0f32; 3];
                axis[face / 2] = if face % 2 == 0 { 1.0 } else { -1.0 };
                let code = middle + face as i32;
                assert_eq!(cube(bits).encode(axis.into()).0, code);
                assert_eq!(cube(bits).encode_precise(axis.into()).0, code);
                assert_eq!(cube(bits).decode::<f32>(code.into()).to_array(), axis);
            }
        }
    }

    #[test]
    fn the_last_indices_read_as_the_last_cell() {
        for (bits, last) in [(4, 5), (5, 23), (16, 104 * 104 * 6 - 1)] {
            for code in [last, last + 1, (1 << bits) - 1] {
                assert_eq!(mirror(bits, code, [false; 3]), last);
                let v = cube(bits).decode::<f32>(code.into());
                assert_eq!(v, cube(bits).decode::<f32>(last.into()));
            }
        }
        // 6 * 26754^2 - 1, as an unsigned integer.
        assert_eq!(mirror(32, -1, [false; 3]), (6 * 26_754u32.pow(2) - 1) as i32);
    }

    #[test]
    fn mirror_images_count_from_the_other_end() {
        // Cell (2, 0) of three by three on the face +X.
        for (flips, code) in [
            ([false, false, false], 6 * 6),
            ([true, false, false], 6 * 6 + 1),
            ([false, true, false], 0),
            ([false, false, true], 8 * 6),
        ] {
            assert_eq!(mirror(6, 6 * 6, flips), code);
        }
    }

    #[test]
    fn integers_are_divided_exactly() {
        for n in [0u32, 5, 6, 7, 65_535, 65_536, 0x7FFF_FFFF, 0x8000_0000, 0xFFFF_FFFB, 0xFFFF_FFFF]
        {
            let (quotient, remainder) = div_rem::<f32, 6>((n as i32).into());
            assert_eq!([quotient.0 as u32, remainder.0 as u32], [n / 6, n % 6]);
        }
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        assert_nearest(AngularCube::new(8), 256, spiral(60));
    }
}
