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

use core::marker::PhantomData;

use crate::formula::{Closest, Formula, One, Symmetric, mirror_decoded, negate_if};
use crate::half;
use crate::lane::{Each, Lane, LaneInt, LaneMask, inlined};
use crate::layout::{pack2, unorm_max, unpack2};
use crate::math::{inv_sqrt, normalize, sqrt};

/// XY-only on a grid.
pub(crate) struct XyOnly<G>(PhantomData<G>);

/// The values that a component may have, as integers in their order, symmetric about 0.
pub(crate) trait Grid: 'static {
    /// From -GREATEST to GREATEST.
    const GREATEST: i32;
    /// From one to the next.
    const STEP: i32;
    /// The first at or above sqrt(1/2).
    const DIAGONAL: i32;

    /// Nearest grid point, ties to even, of |x| <= 1 (and a little more).
    fn nearest<L: Lane>(x: L) -> L::Int;
    fn value<L: Lane>(i: L::Int) -> L;
    /// 1 - x^2 - y^2, its sign exact.
    fn height_squared<L: Lane>(x: L::Int, y: L::Int) -> L;
    /// 1 - x^2.
    fn rim_squared<L: Lane>(x: L::Int) -> L;
    fn pack<L: Lane>(params: [L::Int; 2]) -> L::Int;
    fn unpack<L: Lane>(code: L::Int) -> [L::Int; 2];
}

/// Unorm of `BITS / 2` bits, as the odd numbers from -m to m = 2^(BITS/2) - 1.
pub(crate) struct Unorm<const BITS: u32>;

impl<const BITS: u32> Unorm<BITS> {
    const M: i32 = unorm_max(BITS / 2);

    /// i (m - i), for the index i = (x + m) / 2: (m^2 - x^2) / 4, at most 2^30.
    #[inline(always)]
    fn quarter_rim<L: Lane>(x: L::Int) -> L::Int {
        let i = (x + L::Int::splat(Self::M)).sar(1);
        i * (L::Int::splat(Self::M) - i)
    }
}

impl<const BITS: u32> Grid for Unorm<BITS> {
    const GREATEST: i32 = Self::M;
    const STEP: i32 = 2;
    const DIAGONAL: i32 =
        ((Self::M as f64 * core::f64::consts::FRAC_1_SQRT_2) as i32 + 1) / 2 * 2 + 1;

    #[inline(always)]
    fn nearest<L: Lane>(x: L) -> L::Int {
        let half = L::splat(0.5 * Self::M as f32);
        (x * half + half).round_int().shl(1) - L::Int::splat(Self::M)
    }
    #[inline(always)]
    fn value<L: Lane>(i: L::Int) -> L {
        L::from_int(i) * L::splat(1.0 / Self::M as f32)
    }
    #[inline(always)]
    fn height_squared<L: Lane>(x: L::Int, y: L::Int) -> L {
        // m^2 - x^2 - y^2 = 4 q - 1, in exact integers; never zero, as odd squares are 1 mod 8.
        let q = Self::quarter_rim::<L>(x) + Self::quarter_rim::<L>(y)
            - L::Int::splat((Self::M as i64 * Self::M as i64 / 4) as i32);
        (L::from_int(q) * L::splat(4.0) - L::splat(1.0))
            * L::splat((1.0 / (Self::M as f64 * Self::M as f64)) as f32)
    }
    #[inline(always)]
    fn rim_squared<L: Lane>(x: L::Int) -> L {
        L::from_int(Self::quarter_rim::<L>(x))
            * L::splat((4.0 / (Self::M as f64 * Self::M as f64)) as f32)
    }
    #[inline(always)]
    fn pack<L: Lane>(params: [L::Int; 2]) -> L::Int {
        pack2::<BITS, L>(params.each(|p| (p + L::Int::splat(Self::M)).sar(1)))
    }
    #[inline(always)]
    fn unpack<L: Lane>(code: L::Int) -> [L::Int; 2] {
        unpack2::<BITS, L>(code).each(|i| i.shl(1) - L::Int::splat(Self::M))
    }
}

/// Halves from -1 to 1. Greater patterns, infinities and NaN read as 1 with their sign.
pub(crate) struct Halves;

impl Grid for Halves {
    const GREATEST: i32 = half::ONE;
    const STEP: i32 = 1;
    const DIAGONAL: i32 = 0x39A9;

    #[inline(always)]
    fn nearest<L: Lane>(x: L) -> L::Int {
        half::nearest(x)
    }
    #[inline(always)]
    fn value<L: Lane>(i: L::Int) -> L {
        half::value(i)
    }
    #[inline(always)]
    fn height_squared<L: Lane>(x: L::Int, y: L::Int) -> L {
        // The squares of 11 bits are exact, and so is the difference wherever it is near zero.
        let (x, y) = (half::value::<L>(x), half::value::<L>(y));
        let (xx, yy) = (x * x, y * y);
        L::splat(1.0) - xx.greater(yy) - xx.lesser(yy)
    }
    #[inline(always)]
    fn rim_squared<L: Lane>(x: L::Int) -> L {
        let x = half::value::<L>(x);
        L::splat(1.0) - x * x
    }
    #[inline(always)]
    fn pack<L: Lane>([x, y]: [L::Int; 2]) -> L::Int {
        half::to_bits::<L>(x) | half::to_bits::<L>(y).shl(16)
    }
    #[inline(always)]
    fn unpack<L: Lane>(code: L::Int) -> [L::Int; 2] {
        [code, code.shr(16)].each(
            #[inline(always)]
            |bits| half::from_bits::<L>(bits, half::ONE),
        )
    }
}

impl<G: Grid> XyOnly<G> {
    /// Beyond the rim: whether x is the larger component, and the magnitude of the smaller.
    #[inline(always)]
    fn minor<L: Lane>([x, y]: [L::Int; 2]) -> (L::Mask, L::Int) {
        let (x, y) = (x.abs(), y.abs());
        (!x.lt(y), x.min(y).min(L::Int::splat(G::DIAGONAL)))
    }

    /// The canonical one of the points that read alike: beyond the rim, the larger component is brought back.
    #[inline(always)]
    fn canonical_point<L: Lane>([x, y]: [L::Int; 2]) -> [L::Int; 2] {
        let step = L::Int::splat(G::STEP);
        let beyond = G::height_squared::<L>(x, y).le(L::zero());
        let (x_larger, minor) = Self::minor::<L>([x, y]);
        // The first at or beyond the rim: the nearest to it or, if that is inside, the next. One tie
        // with the smaller goes to x.
        let near = G::nearest(sqrt(G::rim_squared::<L>(minor)));
        let inside = L::zero().lt(G::height_squared::<L>(minor, near));
        let first = L::Int::select(inside, near + step, near);
        let first = first.max(L::Int::select(x_larger, minor, minor + step));
        let signed = inlined(
            #[inline(always)]
            |magnitude: L::Int, sign: L::Int| {
                L::Int::select(sign.lt(L::Int::splat(0)), -magnitude, magnitude)
            },
        );
        let rim_x = signed(L::Int::select(x_larger, first, minor), x);
        let rim_y = signed(L::Int::select(x_larger, minor, first), y);
        [L::Int::select(beyond, rim_x, x), L::Int::select(beyond, rim_y, y)]
    }

    #[inline(always)]
    fn point<L: Lane>([x, y]: [L::Int; 2]) -> [L; 3] {
        let height = G::height_squared::<L>(x, y);
        let beyond = height.le(L::zero());
        let (x_larger, minor) = Self::minor::<L>([x, y]);
        // One root serves both: z inside, the larger component on the rim.
        let root = sqrt(L::select(beyond, G::rim_squared::<L>(minor), height));
        let minor = G::value::<L>(minor);
        let component = inlined(
            #[inline(always)]
            |larger: L::Mask, i: L::Int| {
                let magnitude = L::select(larger, root, minor);
                let negative = i.lt(L::Int::splat(0));
                let on_rim = L::select(negative, -magnitude, magnitude);
                L::select(beyond, on_rim, G::value::<L>(i))
            },
        );
        [component(x_larger, x), component(!x_larger, y), L::select(beyond, L::zero(), root)]
    }
}

impl<G: Grid> Formula for XyOnly<G> {
    type Words = One;
    const HEMISPHERE: bool = true;

    #[inline(always)]
    fn encode<L: Lane>(v: [L; 3]) -> L::Int {
        let [x, y, _] = normalize(v);
        G::pack::<L>(Self::canonical_point::<L>([G::nearest(x), G::nearest(y)]))
    }

    #[inline(never)]
    fn encode_precise<L: Lane>(v: [L; 3]) -> L::Int {
        L::compiled_for(
            #[inline(always)]
            || {
                let [x, y, z] = normalize(v);
                // Walk along the greater component, whose steps are the coarser.
                let swap = x.abs().lt(y.abs());
                let (p, q) = (L::select(swap, y, x), L::select(swap, x, y));
                let radius = sqrt(q * q + z * z);
                let around = q / radius.greater(L::splat(1e-18));
                let greatest = L::Int::splat(G::GREATEST);
                let step = L::Int::splat(G::STEP);

                let mut closest = Closest::to(v);
                let consider = inlined(
                    #[inline(always)]
                    |closest: &mut Closest<L>,
                     counts: L::Mask,
                     p_index: L::Int,
                     q_index: L::Int| {
                        let xy = [
                            L::Int::select(swap, q_index, p_index),
                            L::Int::select(swap, p_index, q_index),
                        ];
                        let xy =
                            Self::canonical_point::<L>(xy.each(|i| i.max(-greatest).min(greatest)));
                        closest.consider_where(counts, G::pack::<L>(xy), Self::point::<L>(xy));
                    },
                );
                let neighbours = inlined(
                    #[inline(always)]
                    |value: L| {
                        let near = G::nearest(value);
                        let up = G::value::<L>(near).lt(value);
                        [near, near + L::Int::select(up, step, -step)]
                    },
                );
                // On the rim there is a point for each smaller component: x above and below the diagonals,
                // y between them.
                let always = L::zero().le(L::zero());
                let to_rim = inv_sqrt((p * p + q * q).greater(L::splat(1e-30)));
                let [rim_p, rim_q] = [p, q].each(|c| c * to_rim);
                let diagonal = L::Int::splat(G::DIAGONAL);
                let outside = inlined(
                    #[inline(always)]
                    |c: L| L::Int::select(c.lt(L::zero()), -greatest, greatest),
                );
                for q_index in neighbours(rim_q) {
                    let q_index = q_index.max(-diagonal).min(diagonal);
                    consider(&mut closest, always, outside(p), q_index);
                }
                for p_index in neighbours(rim_p) {
                    let p_index = p_index.max(-diagonal).min(diagonal);
                    consider(&mut closest, always, p_index, outside(q));
                }
                // Column after column, to both sides. The middle one may be further than the one on the
                // other side of v.
                let middle = G::nearest(p);
                let (mut up, mut down) = (middle, middle);
                let mut open = always;
                while open.any() {
                    let mut any_open = up.eq(down);
                    for column in [up, down] {
                        let exists = !greatest.lt(column.abs());
                        let column = column.max(-greatest).min(greatest);
                        let column_radius = sqrt(G::rim_squared::<L>(column));
                        // No point of this column is nearer than this.
                        let (dp, dr) = (p - G::value::<L>(column), radius - column_radius);
                        let bound = dp * dp + dr * dr;
                        let counts = open & exists & bound.lt(closest.distance_squared());
                        any_open = any_open | counts;
                        if counts.any() {
                            for q_index in neighbours(around * column_radius) {
                                consider(&mut closest, counts, column, q_index);
                            }
                        }
                    }
                    open = open & any_open;
                    (up, down) = (up + step, down - step);
                }
                closest.code()
            },
        )
    }

    #[inline(always)]
    fn decode<L: Lane>(code: L::Int) -> [L; 3] {
        Self::point::<L>(G::unpack::<L>(code))
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: L::Int) -> L::Int {
        G::pack::<L>(Self::canonical_point::<L>(G::unpack::<L>(code)))
    }

    #[inline(always)]
    fn mirror<L: Lane>(code: L::Int, flips: [bool; 3]) -> L::Int {
        if flips[2] {
            return mirror_decoded::<Self, L>(code, flips);
        }
        let [x, y] = G::unpack::<L>(code);
        let point = [negate_if(x, flips[0]), negate_if(y, flips[1])];
        G::pack::<L>(Self::canonical_point::<L>(point))
    }
}

impl<const BITS: u32> Symmetric for XyOnly<Unorm<BITS>> {
    const ENTRIES: usize = 1 << (BITS - 2);

    #[inline(always)]
    fn fold<L: Lane>(code: L::Int) -> (L::Int, [L::Mask; 3]) {
        let zero = L::Int::splat(0);
        let [x, y] = <Unorm<BITS> as Grid>::unpack::<L>(code);
        let index = x.abs().shr(1) | y.abs().shr(1).shl(BITS / 2 - 1);
        (index, [x.lt(zero), y.lt(zero), zero.lt(zero)])
    }
}
