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

use crate::formula::bits::snorm_max;
use crate::formula::{Formula, One, Symmetric, closest_of_four, mirror_point};
use crate::simd::math::{atan2_half_turns, normalize, sin_cos_of_half};
use crate::simd::{Each, Simd, SimdInt, inlined};

/// A cube map with spacing `W` in `BITS` bits.
pub(crate) struct Cube<W, const BITS: u32>(PhantomData<W>);

/// Schinko's cube map in `BITS` bits.
pub(crate) struct AngularCube<const BITS: u32>;

/// How a face is divided.
pub(crate) trait Spacing: 'static {
    /// The parameter of `side / axis`, from -1 to 1, with axis > 0.
    fn param<V: Simd>(side: V, axis: V) -> V;
    /// The direction of the parameters of three components, one of them 1 or -1.
    fn direction<V: Simd>(params: [V; 3]) -> [V; 3];
}

/// Even steps on the face.
pub(crate) struct Flat;
/// Even steps of the angle.
pub(crate) struct Warped;

impl Spacing for Flat {
    #[inline(always)]
    fn param<V: Simd>(side: V, axis: V) -> V {
        side / axis
    }
    #[inline(always)]
    fn direction<V: Simd>(params: [V; 3]) -> [V; 3] {
        params
    }
}

impl Spacing for Warped {
    #[inline(always)]
    fn param<V: Simd>(side: V, axis: V) -> V {
        atan2_half_turns(side, axis) * V::splat(4.0)
    }
    #[inline(always)]
    fn direction<V: Simd>(params: [V; 3]) -> [V; 3] {
        params.each(
            #[inline(always)]
            |p| {
                let (sin, cos) = sin_cos_of_half(p * V::splat(0.5));
                let end = V::splat(1.0).le(p.abs());
                V::select(end, p, sin / cos)
            },
        )
    }
}

/// Which axis is first.
#[inline(always)]
fn turn_to_axis<T: Copy>([x, y, z]: [T; 3], axis: u32) -> [T; 3] {
    match axis {
        0 => [x, y, z],
        1 => [y, z, x],
        _ => [z, x, y],
    }
}

/// A vector turned so that its largest component, X before Y before Z, comes first; and which one
/// that is.
#[inline(always)]
fn largest_first<V: Simd>(v: [V; 3]) -> ([V; 3], V::Int) {
    let [x, y, z] = v.each(|c| c.abs());
    let is_x = y.le(x) & z.le(x);
    let is_y = !is_x & z.le(y);
    let [a, b, c] = [0, 1, 2].each(|axis| turn_to_axis(v, axis));
    let turned = [0, 1, 2].each(|i: usize| V::select(is_x, a[i], V::select(is_y, b[i], c[i])));
    let axis = V::Int::select(
        is_x,
        V::Int::splat(0),
        V::Int::select(is_y, V::Int::splat(1), V::Int::splat(2)),
    );
    (turned, axis)
}

/// Back from the turn of [`largest_first`].
#[inline(always)]
fn turn_back<T: Copy>(v: [T; 3], select: impl Fn(T, T, T) -> T) -> [T; 3] {
    let [x, y, z] = [turn_to_axis(v, 0), turn_to_axis(v, 2), turn_to_axis(v, 1)];
    [0, 1, 2].each(|i: usize| select(x[i], y[i], z[i]))
}

/// Picks by the axis.
#[inline(always)]
fn by_axis<V: Simd>(axis: V::Int) -> impl Fn(V::Int, V::Int, V::Int) -> V::Int {
    let is_x = axis.eq(V::Int::splat(0));
    let is_y = axis.eq(V::Int::splat(1));
    move |x, y, z| V::Int::select(is_x, x, V::Int::select(is_y, y, z))
}

impl<W: Spacing, const BITS: u32> Cube<W, BITS> {
    const SIDE: u32 = (BITS - 3) / 2;
    const M: i32 = snorm_max(Self::SIDE);

    /// The canonical code of a point of the cube from -M to M.
    #[inline(always)]
    fn pack<V: Simd>(point: [V::Int; 3]) -> V::Int {
        let max = V::Int::splat(Self::M);
        let [x, y, _] = point.each(|c| c.abs().eq(max));
        let axis = V::Int::select(
            x,
            V::Int::splat(0),
            V::Int::select(y, V::Int::splat(1), V::Int::splat(2)),
        );
        let pick = by_axis::<V>(axis);
        let turned = [0, 1, 2].each(|axis| turn_to_axis(point, axis));
        let [main, a, b] =
            [0, 1, 2].each(|i: usize| pick(turned[0][i], turned[1][i], turned[2][i]));
        (axis + axis)
            | main.shr(31)
            | a.low(Self::SIDE).shl(3)
            | b.low(Self::SIDE).shl(3 + Self::SIDE)
    }

    /// The largest component, which is M or -M, and the two others; and its axis.
    #[inline(always)]
    fn unpack<V: Simd>(code: V::Int) -> ([V::Int; 3], V::Int) {
        let max = V::Int::splat(Self::M);
        let negative = code.low(1).eq(V::Int::splat(1));
        let axis = code.shr(1).low(2).min(V::Int::splat(2));
        let side = inlined(
            #[inline(always)]
            |shift: u32| code.shr(shift).sign_extend(Self::SIDE).max(-max),
        );
        ([V::Int::select(negative, -max, max), side(3), side(3 + Self::SIDE)], axis)
    }

    #[inline(always)]
    fn vector<V: Simd>(point: [V::Int; 3]) -> [V; 3] {
        let params = point.each(|i| V::from_int(i) * V::splat(1.0 / Self::M as f32));
        normalize(W::direction(params))
    }

    /// The parameters of the two smaller components, scaled to M; the axis of the largest, and its
    /// place, M or -M.
    #[inline(always)]
    fn params<V: Simd>(v: [V; 3]) -> ([V; 2], V::Int, V::Int) {
        let ([main, a, b], axis) = largest_first(v);
        let max = V::Int::splat(Self::M);
        let end = V::Int::select(main.lt(V::zero()), -max, max);
        let scale = V::splat(Self::M as f32);
        (
            [a, b].each(
                #[inline(always)]
                |side| W::param(side, main.abs()) * scale,
            ),
            axis,
            end,
        )
    }

    /// A point of the cube from -M to M.
    #[inline(always)]
    fn point<V: Simd>(axis: V::Int, end: V::Int, sides: [V::Int; 2]) -> [V::Int; 3] {
        let max = V::Int::splat(Self::M);
        let [a, b] = sides.each(|p| p.max(-max).min(max));
        turn_back([end, a, b], by_axis::<V>(axis))
    }
}

impl<W: Spacing, const BITS: u32> Formula for Cube<W, BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        let (params, axis, end) = Self::params(v);
        Self::pack::<V>(Self::point::<V>(axis, end, params.each(|p| p.round_int())))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        V::compiled_for(
            #[inline(always)]
            || {
                let (params, axis, end) = Self::params(v);
                closest_of_four(
                    v,
                    params,
                    #[inline(always)]
                    |sides| {
                        let point = Self::point::<V>(axis, end, sides);
                        (Self::pack::<V>(point), Self::vector::<V>(point))
                    },
                )
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        let (point, axis) = Self::unpack::<V>(code);
        Self::vector::<V>(turn_back(point, by_axis::<V>(axis)))
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        let (point, axis) = Self::unpack::<V>(code);
        Self::pack::<V>(turn_back(point, by_axis::<V>(axis)))
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        let (point, axis) = Self::unpack::<V>(code);
        Self::pack::<V>(mirror_point(turn_back(point, by_axis::<V>(axis)), flips))
    }
}

impl<W: Spacing, const BITS: u32> Symmetric for Cube<W, BITS> {
    const ENTRIES: usize = 3 << (2 * (Self::SIDE - 1));

    #[inline(always)]
    fn fold<V: Simd>(code: V::Int) -> (V::Int, [V::Mask; 3]) {
        let (point, axis) = Self::unpack::<V>(code);
        let [_, a, b] = point.each(|i| i.abs());
        let index = a | b.shl(Self::SIDE - 1) | axis.shl(2 * (Self::SIDE - 1));
        let point = turn_back(point, by_axis::<V>(axis));
        (index, point.each(|i| i.lt(V::Int::splat(0))))
    }
}

impl<const BITS: u32> AngularCube<BITS> {
    const CELLS: Cells = Cells { side: ((1u64 << BITS) / 6).isqrt() as i32 };
}

/// The cells of a cube with `side` of them along an edge. It is no constant, so that all sizes share
/// their code.
#[derive(Clone, Copy)]
struct Cells {
    side: i32,
}

impl Cells {
    #[inline(always)]
    fn pack<V: Simd>(self, [i, j]: [V::Int; 2], face: V::Int) -> V::Int {
        (i * V::Int::splat(self.side) + j) * V::Int::splat(6) + face
    }

    #[inline(always)]
    fn vector<V: Simd>(self, cell: [V::Int; 2], face: V::Int) -> [V; 3] {
        let s = V::Int::splat(self.side);
        let scale = V::splat(0.5 / self.side as f32);
        let [a, b] = cell.each(
            #[inline(always)]
            |i| {
                // Half of (2 i + 1) / s - 1, in quarter turns.
                let odd = i + i + V::Int::splat(1) - s;
                let (sin, cos) = sin_cos_of_half(V::from_int(odd) * scale);
                sin / cos
            },
        );
        let negative = face.low(1).eq(V::Int::splat(1));
        let main = V::select(negative, V::splat(-1.0), V::splat(1.0));
        let axis = face.shr(1);
        let (is_x, is_y) = (axis.eq(V::Int::splat(0)), axis.eq(V::Int::splat(1)));
        let v = turn_back([main, a, b], |x, y, z| V::select(is_x, x, V::select(is_y, y, z)));
        normalize(v)
    }

    /// The cell's coordinates, of which the integers are the centres; and the face.
    #[inline(always)]
    fn params<V: Simd>(self, v: [V; 3]) -> ([V; 2], V::Int) {
        let ([main, a, b], axis) = largest_first(v);
        let half = V::splat(0.5 * self.side as f32);
        let params = [a, b].each(
            #[inline(always)]
            |side| Warped::param(side, main.abs()) * half + (half - V::splat(0.5)),
        );
        let sign = V::Int::select(main.lt(V::zero()), V::Int::splat(1), V::Int::splat(0));
        (params, axis + axis + sign)
    }

    #[inline(always)]
    fn clamp<V: Simd>(self, cell: [V::Int; 2]) -> [V::Int; 2] {
        cell.each(|i| i.max(V::Int::splat(0)).min(V::Int::splat(self.side - 1)))
    }

    #[inline(never)]
    fn encode<V: Simd>(self, v: [V; 3]) -> V::Int {
        V::compiled_for(
            #[inline(always)]
            || {
                let (params, face) = self.params(v);
                self.pack::<V>(self.clamp::<V>(params.each(|p| p.round_int())), face)
            },
        )
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(self, v: [V; 3]) -> V::Int {
        V::compiled_for(
            #[inline(always)]
            || {
                let (params, face) = self.params(v);
                closest_of_four(
                    v,
                    params,
                    #[inline(always)]
                    |cell| {
                        let cell = self.clamp::<V>(cell);
                        (self.pack::<V>(cell, face), self.vector::<V>(cell, face))
                    },
                )
            },
        )
    }

    /// The cell of a code, and its face.
    #[inline(always)]
    fn unpack<V: Simd>(self, code: V::Int) -> ([V::Int; 2], V::Int) {
        let (cell, face) = div_rem::<V, 6>(code);
        // Quotient below 2^15, to within one.
        let s = V::Int::splat(self.side);
        let i = (V::from_int(cell) * V::splat(1.0 / self.side as f32)).floor().round_int();
        let j = cell - i * s;
        let (early, late) = (j.lt(V::Int::splat(0)), !j.lt(s));
        let one = V::Int::splat(1);
        let i = V::Int::select(early, i - one, V::Int::select(late, i + one, i));
        let j = V::Int::select(early, j + s, V::Int::select(late, j - s, j));
        let beyond = !i.lt(s);
        let last = V::Int::splat(self.side - 1);
        let cell = [V::Int::select(beyond, last, i), V::Int::select(beyond, last, j)];
        (cell, V::Int::select(beyond, V::Int::splat(5), face))
    }

    #[inline(never)]
    fn decode<V: Simd>(self, code: V::Int) -> [V; 3] {
        V::compiled_for(
            #[inline(always)]
            || {
                let (cell, face) = self.unpack::<V>(code);
                self.vector::<V>(cell, face)
            },
        )
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        let ([i, j], face) = self.unpack::<V>(code);
        let flips = flips.each(|flip| V::Int::splat(-i32::from(flip)));
        let turned = [0, 1, 2].each(|axis| turn_to_axis(flips, axis));
        let pick = by_axis::<V>(face.shr(1));
        let [main, a, b] =
            [0, 1, 2].each(|i: usize| pick(turned[0][i], turned[1][i], turned[2][i]));
        // From the other end: side + (-1 - i), and -1 - i is i with all bits flipped.
        let side = V::Int::splat(self.side);
        self.pack::<V>([(i ^ a) + (side & a), (j ^ b) + (side & b)], face ^ main.low(1))
    }

    /// Cells from the middle of an edge to its end.
    const fn half_side(self) -> i32 {
        (self.side + 1) / 2
    }

    #[inline(never)]
    fn fold<V: Simd>(self, code: V::Int) -> (V::Int, [V::Mask; 3]) {
        V::compiled_for(
            #[inline(always)]
            || {
                let zero = V::Int::splat(0);
                let (cell, face) = self.unpack::<V>(code);
                let axis = face.shr(1);
                let [a, b] = cell.each(|i| i + i + V::Int::splat(1 - self.side));
                let half = V::Int::splat(self.half_side());
                let index = (axis * half + a.abs().shr(1)) * half + b.abs().shr(1);
                let point = turn_back([-face.low(1), a, b], by_axis::<V>(axis));
                (index, point.each(|i| i.lt(zero)))
            },
        )
    }
}

impl<const BITS: u32> Formula for AngularCube<BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        Self::CELLS.encode(v)
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        Self::CELLS.encode_precise(v)
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        Self::CELLS.decode(code.low(BITS))
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        let (cell, face) = Self::CELLS.unpack::<V>(code.low(BITS));
        Self::CELLS.pack::<V>(cell, face)
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        Self::CELLS.mirror::<V>(code.low(BITS), flips)
    }
}

impl<const BITS: u32> Symmetric for AngularCube<BITS> {
    const ENTRIES: usize = {
        let half = Self::CELLS.half_side() as usize;
        3 * half * half
    };

    #[inline(always)]
    fn fold<V: Simd>(code: V::Int) -> (V::Int, [V::Mask; 3]) {
        Self::CELLS.fold::<V>(code.low(BITS))
    }
}

/// Quotient and remainder of an unsigned integer by a small `D`, at most 32: by halves, each exact
/// in f32.
#[inline(always)]
fn div_rem<V: Simd, const D: i32>(n: V::Int) -> (V::Int, V::Int) {
    let d = V::Int::splat(D);
    // floor((n + 1/2) / D) is never within rounding of an integer.
    let divide = inlined(
        #[inline(always)]
        |n: V::Int| {
            ((V::from_int(n) + V::splat(0.5)) * V::splat(1.0 / D as f32)).floor().round_int()
        },
    );
    let high = divide(n.shr(16));
    let rest = (n.shr(16) - high * d).shl(16) + n.low(16);
    let low = divide(rest);
    (high.shl(16) + low, rest - low * d)
}
