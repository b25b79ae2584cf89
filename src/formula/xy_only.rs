//! XY-only: two components as they are, the third from the unit length. For the +Z hemisphere.
//!
//! ```text
//! encode   code = grid(x), grid(y)         grid: unorm((c + 1) / 2), snorm(c), or the nearest half
//! decode   z = sqrt(1 - x^2 - y^2)
//! ```
//!
//! Biased snorm, (c - 128) / 127 in bytes, is snorm in offset binary: 128 is zero, and 0 reads as 1.
//! In halves and snorm +Z, +-X and +-Y survive exactly; unorm has no zero, so no axis does.
//!
//! Beyond the rim, where x^2 + y^2 >= 1, a row has one of two rules. Both give z = 0.
//!
//! - [`Kept`]: decoding keeps the smaller component (cut to the first grid value at or above sqrt(1/2))
//!   and puts the larger one on the rim; on a tie x is the larger. Canonical: of the codes that read
//!   as one point of the rim, the one nearest to it.
//! - [`Normalized`]: decoding divides (x, y) by its length, as shaders do: z = sqrt(max(0, 1 - x^2 - y^2)),
//!   then normalize. So a code is a direction there, and its multiples are the same. Canonical: the
//!   least multiple at or beyond the rim, of which odd grids have only the odd ones.
//!
//! The rules differ by up to 9.85 degrees in unorm bytes, at (255, 218), and by 9.52 at (255, 217).
//!
//! Precise: the decoded points of one column lie on a circle around its axis, on which the nearest
//! to v is one of two neighbours. Columns are walked outwards from v until no further one can come
//! nearer. Near the rim, where a step in x or y is a large angle, the nearest code may be dozens of
//! steps away. Of directions on the rim, the nearest of any length is searched as well.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014.

use core::marker::PhantomData;

use super::octant_table::octant_kernels;
use super::support::bits::Pair;
use super::support::closest::Closest;
use super::support::divisor::gcd;
use super::support::half;
use super::support::sign::negate_if;
use super::{Formula, Symmetric, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{inv_sqrt, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, Use, Vec3, map2};

/// XY-only on a grid, with a rule for what is beyond the rim.
#[derive(Clone, Copy)]
pub(crate) struct XyOnly<G, R>(G, PhantomData<R>);

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

/// A grid whose values are its integers over the greatest, all of them or the odd ones.
pub(crate) trait EvenSteps: XyGrid {}

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

impl EvenSteps for XyUnorm {}

/// Snorm, as the integers from -m to m = 2^(BITS/2 - 1) - 1. -m-1 reads as -m.
#[derive(Clone, Copy)]
pub(crate) struct XySnorm {
    pair: Pair,
    m: i32,
    diagonal: i32,
    /// Bits of a code that are stored inverted.
    flip: i32,
    /// m, 1 / m, 1 / m^2.
    steps: f32,
    step: f32,
    per_square: f32,
}

impl XySnorm {
    /// In two's complement.
    const fn new(bits: u32) -> Self {
        let pair = Pair::new(bits);
        let m = pair.snorm_max();
        XySnorm {
            pair,
            m,
            diagonal: (m as f64 * core::f64::consts::FRAC_1_SQRT_2) as i32 + 1,
            flip: 0,
            steps: m as f32,
            step: 1.0 / m as f32,
            per_square: (1.0 / (m as f64 * m as f64)) as f32,
        }
    }

    /// In offset binary: two's complement with its sign bits inverted.
    #[inline]
    const fn biased(bits: u32) -> Self {
        // In 24 bits, pairs of snorm are biased by m already.
        assert!(bits != 24);
        let sign = 1 << (bits / 2 - 1);
        XySnorm { flip: sign | sign << (bits / 2), ..XySnorm::new(bits) }
    }
}

impl XyGrid for XySnorm {
    const STEP: i32 = 1;

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
        (x * self.steps).round_int()
    }
    #[inline(always)]
    fn value<V: Simd>(self, i: V::Int) -> V {
        V::from_int(i) * self.step
    }
    #[inline(always)]
    fn height_squared<V: Simd>(self, x: V::Int, y: V::Int) -> V {
        V::from_int(V::Int::splat(self.m * self.m) - x * x - y * y) * self.per_square
    }
    #[inline(always)]
    fn rim_squared<V: Simd>(self, x: V::Int) -> V {
        V::from_int(V::Int::splat(self.m * self.m) - x * x) * self.per_square
    }
    #[inline(always)]
    fn pack<V: Simd>(self, params: [V::Int; 2]) -> V::Int {
        self.pair.pack_snorm::<V>(params) ^ self.flip
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: V::Int) -> [V::Int; 2] {
        self.pair.unpack_snorm::<V>(code ^ self.flip)
    }
}

impl EvenSteps for XySnorm {}

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

impl<R> XyOnly<XyUnorm, R> {
    pub(crate) const fn new(bits: u32) -> Self {
        XyOnly(XyUnorm::new(bits), PhantomData)
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        let half = (self.0.m as usize).div_ceil(2);
        half * half
    }
}

impl<R> XyOnly<XySnorm, R> {
    pub(crate) const fn new(bits: u32) -> Self {
        XyOnly(XySnorm::new(bits), PhantomData)
    }

    pub(crate) const fn biased(bits: u32) -> Self {
        XyOnly(XySnorm::biased(bits), PhantomData)
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        let half = self.0.m as usize + 1;
        half * half
    }
}

impl<R> XyOnly<XyHalf, R> {
    pub(crate) const fn new() -> Self {
        XyOnly(XyHalf, PhantomData)
    }
}

/// What points beyond the rim mean.
pub(crate) trait Rim<G: XyGrid>: Copy + Send + Sync + 'static {
    /// The unit vector of any point.
    fn vector<V: Simd>(grid: G, xy: [V::Int; 2]) -> Vec3<V>;
    /// The canonical one of the points that read alike.
    fn canonical<V: Simd>(grid: G, xy: [V::Int; 2]) -> [V::Int; 2];
    /// [`canonical`](Rim::canonical) of a point that is inside, or beyond the rim by less than
    /// [`STEP`](XyGrid::STEP).
    fn canonical_nearby<V: Simd>(grid: G, xy: [V::Int; 2]) -> [V::Int; 2];
    /// Considers the points that may be the nearest to a target.
    fn search<V: Simd>(formula: XyOnly<G, Self>, target: Target<V>, closest: &mut Closest<V>);
}

/// Beyond the rim the smaller component is kept, and the larger one put on the rim.
#[derive(Clone, Copy)]
pub(crate) struct Kept;

impl Kept {
    /// Beyond the rim: whether x is the larger component, and the magnitude of the smaller.
    #[inline(always)]
    fn minor<V: Simd>(grid: impl XyGrid, [x, y]: [V::Int; 2]) -> (V::Mask, V::Int) {
        let (x, y) = (x.abs(), y.abs());
        (!x.lt(y), x.min(y).min(grid.diagonal()))
    }
}

impl<G: XyGrid> Rim<G> for Kept {
    #[inline(always)]
    fn vector<V: Simd>(grid: G, xy: [V::Int; 2]) -> Vec3<V> {
        let height = grid.height_squared::<V>(xy[0], xy[1]);
        let beyond = height.le(0.0);
        let (x_larger, minor) = Kept::minor::<V>(grid, xy);
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

    /// The larger component is brought back.
    #[inline(always)]
    fn canonical<V: Simd>(grid: G, [x, y]: [V::Int; 2]) -> [V::Int; 2] {
        let beyond = grid.height_squared::<V>(x, y).le(0.0);
        let (x_larger, minor) = Kept::minor::<V>(grid, [x, y]);
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
    fn canonical_nearby<V: Simd>(grid: G, xy: [V::Int; 2]) -> [V::Int; 2] {
        Self::canonical::<V>(grid, xy)
    }

    #[inline(always)]
    fn search<V: Simd>(formula: XyOnly<G, Self>, target: Target<V>, closest: &mut Closest<V>) {
        let XyOnly(grid, _) = formula;
        let Target { swap, p, q, .. } = target;
        // On the rim there is a point for each smaller component: x above and below the diagonals,
        // y between them.
        let to_rim = inv_sqrt((p * p + q * q).max(1e-30));
        let [rim_p, rim_q] = map2!([p, q], |c| c * to_rim);
        let greatest = grid.greatest();
        let [outside_p, outside_q] =
            map2!([p, q], |c| V::Int::select(c.lt(0.0), -greatest, greatest));
        let [beside_q, beside_p] = [rim_q, rim_p].map(
            #[inline(always)]
            |c| map2!(formula.neighbours(c), |i| i.clamp(-grid.diagonal(), grid.diagonal())),
        );
        for point in [
            [outside_p, beside_q[0]],
            [outside_p, beside_q[1]],
            [beside_p[0], outside_q],
            [beside_p[1], outside_q],
        ] {
            formula.consider(closest, V::Mask::splat(true), swap_where::<V>(swap, point));
        }
        formula.walk_columns(target, closest);
    }
}

/// Beyond the rim a point is the direction of (x, y, 0).
#[derive(Clone, Copy)]
pub(crate) struct Normalized;

impl Normalized {
    /// Of the points beyond the rim whose larger component is the first, the one in the direction
    /// nearest to (p, q), or a multiple of it. For |q| <= |p|.
    ///
    /// Every column has its two points around the target considered. Where both are inside, those beyond
    /// the rim are more than a step off, and the last column, all beyond, has nearer ones.
    #[inline(always)]
    fn nearest_on_rim<G: EvenSteps, V: Simd>(formula: XyOnly<G, Self>, p: V, q: V) -> [V::Int; 2] {
        let XyOnly(grid, _) = formula;
        let greatest = grid.greatest();
        let slope = q / p.abs().max(1e-18);
        let mut least = V::splat(f32::INFINITY);
        let mut nearest = [V::Int::splat(greatest); 2];
        let mut column = grid.diagonal();
        while column <= greatest {
            let i = V::Int::splat(column);
            let along = grid.value::<V>(i);
            for j in formula.neighbours(slope * along) {
                let j = j.clamp(-greatest, greatest);
                let across = grid.value::<V>(j);
                // Proportional to the square of the sine of the angle between them.
                let off = across - slope * along;
                let off = off * off / (along * along + across * across);
                let nearer = off.lt(least) & grid.height_squared::<V>(i, j).le(0.0);
                least = V::select(nearer, off, least);
                let [a, b] = nearest;
                nearest = [V::Int::select(nearer, i, a), V::Int::select(nearer, j, b)];
            }
            column += G::STEP;
        }
        let [i, j] = nearest;
        [V::Int::select(p.lt(0.0), -i, i), j]
    }
}

impl<G: EvenSteps> Rim<G> for Normalized {
    #[inline(always)]
    fn vector<V: Simd>(grid: G, xy: [V::Int; 2]) -> Vec3<V> {
        let height = grid.height_squared::<V>(xy[0], xy[1]);
        let beyond = height.le(0.0);
        let [x, y] = map2!(xy, |i| grid.value::<V>(i));
        // One root serves both: the length beyond the rim, z inside.
        let square = V::select(beyond, x * x + y * y, height);
        let per_root = inv_sqrt(square);
        let scale = V::select(beyond, per_root, 1.0);
        Vec3::new(x * scale, y * scale, V::select(beyond, 0.0, square * per_root))
    }

    /// The least multiple that is not inside.
    #[inline(always)]
    fn canonical<V: Simd>(grid: G, [x, y]: [V::Int; 2]) -> [V::Int; 2] {
        let beyond = grid.height_squared::<V>(x, y).le(0.0);
        if !beyond.any() {
            return [x, y];
        }
        // Points inside may be zero, which has no divisor.
        let [a, b] = map2!([x, y], |i| V::select(beyond, V::from_int(i), 1.0));
        let divisor = gcd(Vec3::new(a.abs(), b.abs(), V::splat(0.0)));
        let [a, b] = map2!([a, b], |i| i / divisor);
        let times = inv_sqrt(a * a + b * b) * grid.greatest() as f32;
        // The nearest multiple to the rim or, if that is inside, the next.
        let near = if G::STEP == 1 {
            times.round()
        } else {
            let pairs = ((times - 1.0) * 0.5).round();
            pairs + pairs + 1.0
        };
        let [i, j] = map2!([a, b], |i| (i * near).round_int());
        let inside = V::splat(0.0).lt(grid.height_squared::<V>(i, j));
        let times = V::select(inside, near + G::STEP as f32, near);
        let [i, j] = map2!([a, b], |i| (i * times).round_int());
        [V::Int::select(beyond, i, x), V::Int::select(beyond, j, y)]
    }

    /// The point itself: the next lesser multiple is STEP times the primitive point nearer to zero, and
    /// no primitive point is shorter than 1. So it is inside.
    #[inline(always)]
    fn canonical_nearby<V: Simd>(_: G, xy: [V::Int; 2]) -> [V::Int; 2] {
        xy
    }

    #[inline(always)]
    fn search<V: Simd>(formula: XyOnly<G, Self>, target: Target<V>, closest: &mut Closest<V>) {
        let Target { swap, p, q, z } = target;
        formula.walk_columns(target, closest);
        // No point of the rim is nearer than its plane.
        let counts = (z * z).lt(closest.distance_squared());
        if counts.any() {
            let point = Normalized::nearest_on_rim(formula, p, q);
            let point = Self::canonical::<V>(formula.0, swap_where::<V>(swap, point));
            formula.consider(closest, counts, point);
        }
    }
}

/// What the precise encoder looks for: a unit vector (p, q, z), |q| <= |p|.
#[derive(Clone, Copy)]
pub(crate) struct Target<V: Simd> {
    /// Whether p is y.
    swap: V::Mask,
    p: V,
    q: V,
    z: V,
}

impl<V: Simd> Target<V> {
    #[inline(always)]
    fn new(Vec3 { x, y, z }: Vec3<V>) -> Self {
        let swap = x.abs().lt(y.abs());
        Target { swap, p: V::select(swap, y, x), q: V::select(swap, x, y), z }
    }
}

impl<G: XyGrid, R: Rim<G>> XyOnly<G, R> {
    /// The two grid points around `value`, the nearer one first.
    #[inline(always)]
    fn neighbours<V: Simd>(self, value: V) -> [V::Int; 2] {
        let near = self.0.nearest(value);
        let up = self.0.value::<V>(near).lt(value);
        [near, near + V::Int::select(up, G::STEP, -G::STEP)]
    }

    /// Considers the code of a point, which may be out of range. It is canonical, or beyond the rim by less
    /// than [`STEP`](XyGrid::STEP), or any point if the rule is [`Kept`].
    #[inline(never)]
    fn consider<V: Simd>(self, closest: &mut Closest<V>, counts: V::Mask, xy: [V::Int; 2]) {
        V::with_target_features(
            #[inline(always)]
            || {
                let XyOnly(grid, _) = self;
                let greatest = grid.greatest();
                let xy =
                    R::canonical_nearby::<V>(grid, map2!(xy, |i| i.clamp(-greatest, greatest)));
                closest.consider_where(counts, grid.pack::<V>(xy), R::vector::<V>(grid, xy));
            },
        );
    }

    /// Considers the points around the target, column after column.
    #[inline(always)]
    fn walk_columns<V: Simd>(self, target: Target<V>, closest: &mut Closest<V>) {
        let XyOnly(grid, _) = self;
        // Walk along the greater component, whose steps are the coarser.
        let Target { swap, p, q, z } = target;
        let radius = sqrt(q * q + z * z);
        let around = q / radius.max(1e-18);
        let greatest = grid.greatest();
        // To both sides. The middle one may be further than the one on the other side of v.
        let middle = grid.nearest(p);
        let (mut up, mut down) = (middle, middle);
        let mut open = V::Mask::splat(true);
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
                        self.consider(closest, counts, point);
                    }
                }
            }
            open = open & any_open;
            (up, down) = (up + G::STEP, down - G::STEP);
        }
    }
}

/// The other way round in some lanes.
#[inline(always)]
fn swap_where<V: Simd>(swap: V::Mask, [p, q]: [V::Int; 2]) -> [V::Int; 2] {
    [V::Int::select(swap, q, p), V::Int::select(swap, p, q)]
}

impl<G: XyGrid, R: Rim<G>> Formula for XyOnly<G, R> {
    type Shape = Word;
    const HEMISPHERE: bool = true;
    const PRECISE_USE: Use = Use::Rare;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let XyOnly(grid, _) = self;
        let v = v.normalize();
        let nearest = [grid.nearest(v.x), grid.nearest(v.y)];
        grid.pack::<V>(R::canonical_nearby::<V>(grid, nearest))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        V::with_target_features(
            #[inline(always)]
            || {
                let mut closest = Closest::to(v);
                R::search(self, Target::new(v.normalize()), &mut closest);
                closest.code()
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        R::vector::<V>(self.0, self.0.unpack::<V>(code))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        if flips[2] {
            return self.mirror_decoded::<V>(code, flips);
        }
        let XyOnly(grid, _) = self;
        let [x, y] = grid.unpack::<V>(code);
        let point = [negate_if(x, flips[0]), negate_if(y, flips[1])];
        grid.pack::<V>(R::canonical::<V>(grid, point))
    }
}

impl<R: Rim<XyUnorm>> Symmetric for XyOnly<XyUnorm, R> {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let [x, y] = self.0.unpack::<V>(code);
        let half = (self.0.m + 1) / 2;
        let index = x.abs().shr_logical(1) + y.abs().shr_logical(1) * half;
        (index, Vec3::new(x.lt(0), y.lt(0), V::Mask::splat(false)))
    }
}

impl<R: Rim<XySnorm>> Symmetric for XyOnly<XySnorm, R> {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let [x, y] = self.0.unpack::<V>(code);
        let index = x.abs() + y.abs() * (self.0.m + 1);
        (index, Vec3::new(x.lt(0), y.lt(0), V::Mask::splat(false)))
    }
}

kernels!(
    XyOnly<XyUnorm, Kept>: Words;
    XyOnly<XyHalf, Kept>: Words;
    XyOnly<XyUnorm, Normalized>: Words;
    XyOnly<XySnorm, Normalized>: Words;
);
octant_kernels!(
    XyOnly<XyUnorm, Kept>,
    XyOnly<XyUnorm, Normalized>,
    XyOnly<XySnorm, Normalized>,
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::testing::assert_nearest;

    const UNORM: XyOnly<XyUnorm, Kept> = XyOnly::<XyUnorm, Kept>::new(16);
    const HALF: XyOnly<XyHalf, Kept> = XyOnly::<XyHalf, Kept>::new();
    const NORMALIZED: XyOnly<XyUnorm, Normalized> = XyOnly::<XyUnorm, Normalized>::new(16);
    const SNORM: XyOnly<XySnorm, Normalized> = XyOnly::<XySnorm, Normalized>::new(16);
    const BIASED: XyOnly<XySnorm, Normalized> = XyOnly::<XySnorm, Normalized>::biased(16);

    fn canonical<G: XyGrid, R: Rim<G>>(formula: XyOnly<G, R>, code: u32) -> u32 {
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
        // 127 v = (76.2, 60.96, 81.28), and 128 more.
        assert_eq!([SNORM.encode(v * 5.0).0, BIASED.encode(v).0], [0x3D4C, 0xBDCC]);
        // 76/127, 61/127, and the root of 127^2 - 76^2 - 61^2 = 6632.
        for v in [SNORM.decode::<f32>(0x3D4C.into()), BIASED.decode::<f32>(0xBDCC.into())] {
            assert_near(v, [0.598_425, 0.480_315, 0.641_237]);
        }
    }

    #[test]
    fn the_pattern_out_of_range_reads_as_its_neighbour() {
        assert_eq!([canonical(SNORM, 0x0080), canonical(SNORM, 0x8000)], [0x0081, 0x8100]);
        assert_eq!([canonical(BIASED, 0x8000), canonical(BIASED, 0x0080)], [0x8001, 0x0180]);
    }

    #[test]
    fn beyond_the_rim_shaders_normalize() {
        // (255, 181) and (181, 255) over their length.
        assert_near(NORMALIZED.decode::<f32>(0xDAFF.into()), [0.815_459, 0.578_816, 0.0]);
        assert_near(NORMALIZED.decode::<f32>(0x00DA.into()), [0.578_816, -0.815_459, 0.0]);
        // (105, -100) of length 145, and (120, 90) of length 150.
        assert_near(SNORM.decode::<f32>(0x9C69.into()), [0.724_138, -0.689_655, 0.0]);
        assert_near(BIASED.decode::<f32>(0xDAF8.into()), [0.8, 0.6, 0.0]);
        // Inside, the two rules are one.
        let inside = NORMALIZED.decode::<f32>(0xBDCC.into());
        assert_eq!(inside, UNORM.decode::<f32>(0xBDCC.into()));
    }

    #[test]
    fn of_one_direction_the_least_multiple_beyond_the_rim_is_canonical() {
        // Of (1, 1): 127 / sqrt(2) = 89.8. Of (4, 3): 25.4. Of (3, -2): 35.2. (127, 90) is primitive.
        for (code, first) in [
            (0x7F7F, 0x5A5A),
            (0x5A78, 0x4E68),
            (0xAC7E, 0xB86C),
            (0x5A7F, 0x5A7F),
            (0x007F, 0x007F),
            (0x3D4C, 0x3D4C),
        ] {
            assert_eq!(canonical(SNORM, code), first, "{code:x}");
            assert_eq!(canonical(BIASED, code ^ 0x8080), first ^ 0x8080, "{code:x}");
        }
        // Odd multiples of (1, 1) from 180.3, of (5, 3) from 43.7, of (3, 1) from 80.6 and of (7, 5) from 29.6.
        for (code, first) in [
            (0xFFFF, 0xDADA),
            (0xCCFF, 0xC3F0),
            (0xAAFF, 0xA8F9),
            (0xD7FA, 0xCDEC),
            (0xFCFD, 0xFCFD),
            (0xBDCC, 0xBDCC),
        ] {
            assert_eq!(canonical(NORMALIZED, code), first, "{code:x}");
        }
    }

    #[test]
    fn the_nearest_on_the_rim_may_be_of_any_length() {
        // 127 (0.8, 0.6) = (101.6, 76.2); 26 (4, 3) is exact.
        let v = Vec3::new(4.0f32, 3.0, 0.0);
        assert_eq!([SNORM.encode(v).0, SNORM.encode_precise(v).0], [0x4C66, 0x4E68]);
        let v = Vec3::new(-3.0f32, 4.0, 0.0);
        assert_eq!([SNORM.encode(v).0, SNORM.encode_precise(v).0], [0x66B4, 0x68B2]);
        // 255 (5, 3) / sqrt(34) = (218.7, 131.2), so (219, 131); 45 (5, 3) is exact.
        let v = Vec3::new(5.0f32, 3.0, 0.0);
        assert_eq!([NORMALIZED.encode(v).0, NORMALIZED.encode_precise(v).0], [0xC1ED, 0xC3F0]);
    }

    fn assert_survives<R: Rim<G>, G: XyGrid>(formula: XyOnly<G, R>, axis: [f32; 3], code: u32) {
        assert_eq!(formula.encode(axis.into()).0 as u32, code);
        assert_eq!(formula.encode_precise(axis.into()).0 as u32, code);
        assert_eq!(formula.decode::<f32>((code as i32).into()).to_array(), axis);
    }

    #[test]
    fn promised_axes_survive() {
        for (axis, half, snorm, biased) in [
            ([1.0f32, 0.0, 0.0], 0x0000_3C00u32, 0x007F, 0x80FF),
            ([-1.0, 0.0, 0.0], 0x0000_BC00, 0x0081, 0x8001),
            ([0.0, 1.0, 0.0], 0x3C00_0000, 0x7F00, 0xFF80),
            ([0.0, -1.0, 0.0], 0xBC00_0000, 0x8100, 0x0180),
            ([0.0, 0.0, 1.0], 0, 0, 0x8080),
        ] {
            assert_survives(HALF, axis, half);
            assert_survives(SNORM, axis, snorm);
            assert_survives(BIASED, axis, biased);
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
        assert_nearest(XyOnly::<XyUnorm, Kept>::new(8), 256, vectors);
        assert_nearest(XyOnly::<XyUnorm, Normalized>::new(8), 256, vectors);
        assert_nearest(XyOnly::<XySnorm, Normalized>::new(10), 1024, vectors);
        assert_nearest(BIASED, 1 << 16, vectors);
    }
}
