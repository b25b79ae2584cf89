//! XY-only: two components as they are, the third from the unit length. For the +Z hemisphere.
//!
//! ```text
//! encode   code = grid(x), grid(y)         grid: unorm((c + 1) / 2), or the nearest half
//! decode   z = sqrt(1 - x^2 - y^2)
//! ```
//!
//! Beyond the rim, where x^2 + y^2 >= 1, decoding keeps the smaller component (cut to the first
//! grid value at or above sqrt(1/2)), puts the larger one on the rim and z = 0; on a tie x is the
//! larger. Canonical: of the codes that read as one point of the rim, the one nearest to it. In
//! halves +Z, +-X and +-Y survive exactly; unorm has no zero, so no axis does.
//!
//! Precise: the decoded points of one column lie on a circle around its axis, on which the nearest
//! to v is one of two neighbours. Columns are walked outwards from v until no further one can come
//! nearer. Near the rim, where a step in x or y is a large angle, the nearest code may be dozens of
//! steps away.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014.

use super::octant_table::octant_kernels;
use super::support::bits::Pair;
use super::support::closest::Closest;
use super::support::half;
use super::support::sign::negate_if;
use super::{Formula, Symmetric, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{inv_sqrt, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, Use, Vec3, map2};

/// XY-only on a grid.
#[derive(Clone, Copy)]
pub(crate) struct XyOnly<G>(G);

/// The values that a component may have, as integers in their order, symmetric about 0.
pub(crate) trait XyGrid: Copy + Send + Sync + 'static {
    /// From one to the next.
    const STEP: i32;

    /// The greatest; the least is its opposite.
    fn greatest(self) -> i32;
    /// The first at or above sqrt(1/2).
    fn diagonal(self) -> i32;
    /// Nearest grid point, ties to even, of |x| <= 1 (and a little more).
    fn nearest<V: Simd>(self, x: V) -> V::Int;
    fn value<V: Simd>(self, i: V::Int) -> V;
    /// 1 - x^2 - y^2, its sign exact.
    fn height_squared<V: Simd>(self, x: V::Int, y: V::Int) -> V;
    /// 1 - x^2.
    fn rim_squared<V: Simd>(self, x: V::Int) -> V;
    fn pack<V: Simd>(self, params: [V::Int; 2]) -> V::Int;
    fn unpack<V: Simd>(self, code: V::Int) -> [V::Int; 2];
}

/// Unorm, as the odd numbers from -m to m = 2^(BITS/2) - 1.
#[derive(Clone, Copy)]
pub(crate) struct XyUnorm {
    pair: Pair,
    m: i32,
    diagonal: i32,
    /// floor(m^2 / 4).
    quarter: i32,
    /// m / 2, 1 / m, 1 / m^2, 4 / m^2.
    half: f32,
    step: f32,
    per_square: f32,
    per_quarter: f32,
}

impl XyUnorm {
    const fn new(bits: u32) -> Self {
        let pair = Pair::new(bits);
        let m = pair.unorm_max();
        let square = m as f64 * m as f64;
        XyUnorm {
            pair,
            m,
            diagonal: ((m as f64 * core::f64::consts::FRAC_1_SQRT_2) as i32 + 1) / 2 * 2 + 1,
            quarter: (m as i64 * m as i64 / 4) as i32,
            half: 0.5 * m as f32,
            step: 1.0 / m as f32,
            per_square: (1.0 / square) as f32,
            per_quarter: (4.0 / square) as f32,
        }
    }

    /// i (m - i), for the index i = (x + m) / 2: (m^2 - x^2) / 4, at most 2^30.
    #[inline(always)]
    fn quarter_rim<V: Simd>(self, x: V::Int) -> V::Int {
        let i = (x + self.m).shr_arithmetic(1);
        i * (V::Int::splat(self.m) - i)
    }
}

impl XyGrid for XyUnorm {
    const STEP: i32 = 2;

    #[inline(always)]
    fn greatest(self) -> i32 {
        self.m
    }
    #[inline(always)]
    fn diagonal(self) -> i32 {
        self.diagonal
    }
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V) -> V::Int {
        (x * self.half + self.half).round_int().shl(1) - self.m
    }
    #[inline(always)]
    fn value<V: Simd>(self, i: V::Int) -> V {
        V::from_int(i) * self.step
    }
    #[inline(always)]
    fn height_squared<V: Simd>(self, x: V::Int, y: V::Int) -> V {
        // m^2 - x^2 - y^2 = 4 q - 1, in exact integers; never zero, as odd squares are 1 mod 8.
        let q = self.quarter_rim::<V>(x) + self.quarter_rim::<V>(y) - self.quarter;
        (V::from_int(q) * 4.0 - 1.0) * self.per_square
    }
    #[inline(always)]
    fn rim_squared<V: Simd>(self, x: V::Int) -> V {
        V::from_int(self.quarter_rim::<V>(x)) * self.per_quarter
    }
    #[inline(always)]
    fn pack<V: Simd>(self, params: [V::Int; 2]) -> V::Int {
        self.pair.pack::<V>(map2!(params, |p| (p + self.m).shr_arithmetic(1)))
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: V::Int) -> [V::Int; 2] {
        map2!(self.pair.unpack::<V>(code), |i| i.shl(1) - self.m)
    }
}

/// Halves from -1 to 1. Greater patterns, infinities and NaN read as 1 with their sign.
#[derive(Clone, Copy)]
pub(crate) struct XyHalf;

impl XyGrid for XyHalf {
    const STEP: i32 = 1;

    #[inline(always)]
    fn greatest(self) -> i32 {
        half::ONE
    }
    #[inline(always)]
    fn diagonal(self) -> i32 {
        0x39A9
    }
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V) -> V::Int {
        half::nearest(x)
    }
    #[inline(always)]
    fn value<V: Simd>(self, i: V::Int) -> V {
        half::value(i)
    }
    #[inline(always)]
    fn height_squared<V: Simd>(self, x: V::Int, y: V::Int) -> V {
        // The squares of 11 bits are exact, and so is the difference wherever it is near zero.
        let (x, y) = (half::value::<V>(x), half::value::<V>(y));
        let (xx, yy) = (x * x, y * y);
        V::splat(1.0) - xx.max(yy) - xx.min(yy)
    }
    #[inline(always)]
    fn rim_squared<V: Simd>(self, x: V::Int) -> V {
        let x = half::value::<V>(x);
        V::splat(1.0) - x * x
    }
    #[inline(always)]
    fn pack<V: Simd>(self, [x, y]: [V::Int; 2]) -> V::Int {
        half::to_bits::<V>(x) | half::to_bits::<V>(y).shl(16)
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: V::Int) -> [V::Int; 2] {
        map2!([code, code.shr_logical(16)], |bits| half::from_bits::<V>(bits, half::ONE))
    }
}

impl XyOnly<XyUnorm> {
    pub(crate) const fn new(bits: u32) -> Self {
        XyOnly(XyUnorm::new(bits))
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        let half = (self.0.m as usize).div_ceil(2);
        half * half
    }
}

impl XyOnly<XyHalf> {
    pub(crate) const fn new() -> Self {
        XyOnly(XyHalf)
    }
}

impl<G: XyGrid> XyOnly<G> {
    /// Beyond the rim: whether x is the larger component, and the magnitude of the smaller.
    #[inline(always)]
    fn minor<V: Simd>(self, [x, y]: [V::Int; 2]) -> (V::Mask, V::Int) {
        let (x, y) = (x.abs(), y.abs());
        (!x.lt(y), x.min(y).min(self.0.diagonal()))
    }

    /// The canonical one of the points that read alike: beyond the rim, the larger component is brought
    /// back.
    #[inline(always)]
    fn canonical_point<V: Simd>(self, [x, y]: [V::Int; 2]) -> [V::Int; 2] {
        let XyOnly(grid) = self;
        let beyond = grid.height_squared::<V>(x, y).le(0.0);
        let (x_larger, minor) = self.minor::<V>([x, y]);
        // The first at or beyond the rim: the nearest to it or, if that is inside, the next. One tie
        // with the smaller goes to x.
        let near = grid.nearest(sqrt(grid.rim_squared::<V>(minor)));
        let inside = V::splat(0.0).lt(grid.height_squared::<V>(minor, near));
        let first = V::Int::select(inside, near + G::STEP, near);
        let first = first.max(V::Int::select(x_larger, minor, minor + G::STEP));
        let rim_x = V::Int::select(x_larger, first, minor).negate_where_negative(x);
        let rim_y = V::Int::select(x_larger, minor, first).negate_where_negative(y);
        [V::Int::select(beyond, rim_x, x), V::Int::select(beyond, rim_y, y)]
    }

    #[inline(always)]
    fn point<V: Simd>(self, xy: [V::Int; 2]) -> Vec3<V> {
        let XyOnly(grid) = self;
        let height = grid.height_squared::<V>(xy[0], xy[1]);
        let beyond = height.le(0.0);
        let (x_larger, minor) = self.minor::<V>(xy);
        // One root serves both: z inside, the larger component on the rim.
        let root = sqrt(V::select(beyond, grid.rim_squared::<V>(minor), height));
        let minor = grid.value::<V>(minor);
        let on_rim = [V::select(x_larger, root, minor), V::select(!x_larger, root, minor)];
        let [x, y] = map2!([0, 1], |i: usize| {
            let on_rim = V::select(xy[i].lt(0), -on_rim[i], on_rim[i]);
            V::select(beyond, on_rim, grid.value::<V>(xy[i]))
        });
        Vec3::new(x, y, V::select(beyond, 0.0, root))
    }

    /// The two grid points around `value`, the nearer one first.
    #[inline(always)]
    fn neighbours<V: Simd>(self, value: V) -> [V::Int; 2] {
        let near = self.0.nearest(value);
        let up = self.0.value::<V>(near).lt(value);
        [near, near + V::Int::select(up, G::STEP, -G::STEP)]
    }

    /// Considers the code of a point, which may be out of range.
    #[inline(never)]
    fn consider<V: Simd>(self, closest: &mut Closest<V>, counts: V::Mask, xy: [V::Int; 2]) {
        V::with_target_features(
            #[inline(always)]
            || {
                let greatest = self.0.greatest();
                let xy = self.canonical_point::<V>(map2!(xy, |i| i.clamp(-greatest, greatest)));
                closest.consider_where(counts, self.0.pack::<V>(xy), self.point::<V>(xy));
            },
        );
    }
}

/// The other way round in some lanes.
#[inline(always)]
fn swap_where<V: Simd>(swap: V::Mask, [p, q]: [V::Int; 2]) -> [V::Int; 2] {
    [V::Int::select(swap, q, p), V::Int::select(swap, p, q)]
}

impl<G: XyGrid> Formula for XyOnly<G> {
    type Shape = Word;
    const HEMISPHERE: bool = true;
    const PRECISE_USE: Use = Use::Rare;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let v = v.normalize();
        let nearest = [self.0.nearest(v.x), self.0.nearest(v.y)];
        self.0.pack::<V>(self.canonical_point::<V>(nearest))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        V::with_target_features(
            #[inline(always)]
            || {
                let XyOnly(grid) = self;
                let mut closest = Closest::to(v);
                let Vec3 { x, y, z } = v.normalize();
                // Walk along the greater component, whose steps are the coarser.
                let swap = x.abs().lt(y.abs());
                let (p, q) = (V::select(swap, y, x), V::select(swap, x, y));
                let radius = sqrt(q * q + z * z);
                let around = q / radius.max(1e-18);
                let greatest = grid.greatest();

                // On the rim there is a point for each smaller component: x above and below the diagonals,
                // y between them.
                let always = V::Mask::splat(true);
                let to_rim = inv_sqrt((p * p + q * q).max(1e-30));
                let [rim_p, rim_q] = map2!([p, q], |c| c * to_rim);
                let [outside_p, outside_q] =
                    map2!([p, q], |c| V::Int::select(c.lt(0.0), -greatest, greatest));
                let [beside_q, beside_p] = [rim_q, rim_p].map(
                    #[inline(always)]
                    |c| map2!(self.neighbours(c), |i| i.clamp(-grid.diagonal(), grid.diagonal())),
                );
                for point in [
                    [outside_p, beside_q[0]],
                    [outside_p, beside_q[1]],
                    [beside_p[0], outside_q],
                    [beside_p[1], outside_q],
                ] {
                    self.consider(&mut closest, always, swap_where::<V>(swap, point));
                }
                // Column after column, to both sides. The middle one may be further than the one on the
                // other side of v.
                let middle = grid.nearest(p);
                let (mut up, mut down) = (middle, middle);
                let mut open = always;
                while open.any() {
                    let mut any_open = up.eq(down);
                    for column in [up, down] {
                        let exists = !V::Int::splat(greatest).lt(column.abs());
                        let column = column.clamp(-greatest, greatest);
                        let column_radius = sqrt(grid.rim_squared::<V>(column));
                        // No point of this column is nearer than this.
                        let (dp, dr) = (p - grid.value::<V>(column), radius - column_radius);
                        let bound = dp * dp + dr * dr;
                        let counts = open & exists & bound.lt(closest.distance_squared());
                        any_open = any_open | counts;
                        if counts.any() {
                            for q_index in self.neighbours(around * column_radius) {
                                let point = swap_where::<V>(swap, [column, q_index]);
                                self.consider(&mut closest, counts, point);
                            }
                        }
                    }
                    open = open & any_open;
                    (up, down) = (up + G::STEP, down - G::STEP);
                }
                closest.code()
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        self.point::<V>(self.0.unpack::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        if flips[2] {
            return self.mirror_decoded::<V>(code, flips);
        }
        let [x, y] = self.0.unpack::<V>(code);
        let point = [negate_if(x, flips[0]), negate_if(y, flips[1])];
        self.0.pack::<V>(self.canonical_point::<V>(point))
    }
}

impl Symmetric for XyOnly<XyUnorm> {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let [x, y] = self.0.unpack::<V>(code);
        let half = (self.0.m + 1) / 2;
        let index = x.abs().shr_logical(1) + y.abs().shr_logical(1) * half;
        (index, Vec3::new(x.lt(0), y.lt(0), V::Mask::splat(false)))
    }
}

kernels!(XyOnly<XyUnorm>: Words; XyOnly<XyHalf>: Words);
octant_kernels!(XyOnly<XyUnorm>);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::assert_nearest;

    const UNORM: XyOnly<XyUnorm> = XyOnly::<XyUnorm>::new(16);
    const HALF: XyOnly<XyHalf> = XyOnly::<XyHalf>::new();

    fn canonical<G: XyGrid>(formula: XyOnly<G>, code: u32) -> u32 {
        formula.mirror::<f32>((code as i32).into(), [false; 3]).0 as u32
    }

    fn assert_near(v: Vec3<f32>, expected: [f32; 3]) {
        assert!(v.distance_squared(expected.into()) < 1e-11, "{v:?}");
    }

    #[test]
    fn x_and_y_are_stored_as_they_are() {
        // 127.5 (1 + 0.6) = 204 and 127.5 (1 + 0.48) = 188.7.
        let v = Vec3::new(0.6f32, 0.48, 0.64);
        assert_eq!(UNORM.encode(v * 5.0).0, 0xBDCC);
        // 153/255, 123/255, and sqrt(1 - 0.36 - 0.232664).
        assert_near(UNORM.decode::<f32>(0xBDCC.into()), [0.6, 0.482_353, 0.638_229]);
        // 0.5 (1 + 205/1024) and 0.25 (1 + 942/1024).
        assert_eq!(HALF.encode(v * 5.0).0, 0x37AE_38CD);
        assert_near(HALF.decode::<f32>(0x37AE_38CD.into()), [0.600_097_7, 0.479_980_5, 0.639_923]);
    }

    #[test]
    fn promised_axes_survive() {
        for (axis, code) in [
            ([1.0f32, 0.0, 0.0], 0x0000_3C00u32),
            ([-1.0, 0.0, 0.0], 0x0000_BC00),
            ([0.0, 1.0, 0.0], 0x3C00_0000),
            ([0.0, -1.0, 0.0], 0xBC00_0000),
            ([0.0, 0.0, 1.0], 0),
        ] {
            assert_eq!(HALF.encode(axis.into()).0 as u32, code);
            assert_eq!(HALF.encode_precise(axis.into()).0 as u32, code);
            assert_eq!(HALF.decode::<f32>((code as i32).into()).to_array(), axis);
        }
    }

    #[test]
    fn beyond_the_rim_the_smaller_component_is_kept() {
        // x = 1, y = 101/255: x is sqrt(1 - y^2) = 234.145/255.
        assert_near(UNORM.decode::<f32>(0xB2FF.into()), [0.918_217, 0.396_078, 0.0]);
        assert_near(UNORM.decode::<f32>(0xFFB2.into()), [0.396_078, 0.918_217, 0.0]);
        // x = y = 1: y is cut to 181/255, the first from sqrt(1/2), and x is the larger.
        assert_near(UNORM.decode::<f32>(0xFFFF.into()), [0.704_399, 0.709_804, 0.0]);
        // In halves it is cut to 0x39A9 = 0.707520.
        assert_near(HALF.decode::<f32>(0x3C00_3C00.into()), [0.706_694, 0.707_520, 0.0]);
    }

    #[test]
    fn of_codes_beyond_the_rim_the_first_is_canonical() {
        // From 234.145 on the first x is 235/255, index 245. (181, 179) is inside, so (181, 181), index 218,
        // where x is the larger; where y is, it is (181, 183). From 249.85 on the first is 251.
        for (code, first) in [
            (0xB2FF, 0xB2F5),
            (0xFFB2, 0xF5B2),
            (0xB200, 0xB20A),
            (0xFFFF, 0xDADA),
            (0xFFDB, 0xDBDA),
            (0x99FF, 0x99FD),
            (0xBDCC, 0xBDCC),
        ] {
            assert_eq!(canonical(UNORM, code), first, "{code:x}");
            let v = UNORM.decode::<f32>((code as i32).into());
            assert_eq!(v, UNORM.decode::<f32>((first as i32).into()));
        }
    }

    #[test]
    fn halves_above_one_read_as_one() {
        // 2, infinity, NaN, and their opposites; and there is one zero.
        for (code, one) in
            [(0x4000, 0x3C00), (0x7C00, 0x3C00), (0xFE00, 0xBC00), (0x7E00_0000, 0x3C00_0000)]
        {
            assert_eq!(canonical(HALF, code), one, "{code:x}");
        }
        assert_eq!(canonical(HALF, 0x8000_8000), 0);
        assert_eq!(HALF.decode::<f32>(0xFE00.into()).to_array(), [-1.0, 0.0, 0.0]);
    }

    #[test]
    fn mirror_images_have_opposite_parameters() {
        // 255 - 0xCC = 0x33.
        assert_eq!(UNORM.mirror::<f32>(0xBDCC.into(), [true, false, false]).0, 0xBD33);
        assert_eq!(UNORM.mirror::<f32>(0xBDCC.into(), [false, true, false]).0, 0x42CC);
        assert_eq!(HALF.mirror::<f32>(0x37AE_38CD.into(), [true, false, false]).0, 0x37AE_B8CD);
    }

    #[test]
    fn of_all_codes_the_nearest_is_found() {
        let vectors = [
            [0.8, 0.55, 0.24],
            [0.03, 0.998, 0.05],
            [-0.7, 0.7, 0.1],
            [0.3, -0.2, 0.9],
            [-0.99, -0.1, 0.0],
        ];
        assert_nearest(XyOnly::<XyUnorm>::new(8), 256, vectors);
    }
}
