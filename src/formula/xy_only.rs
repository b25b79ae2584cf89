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

use crate::formula::bits::{pack2, unorm_max, unpack2};
use crate::formula::half;
use crate::formula::{Closest, Formula, One, Symmetric, mirror_decoded, negate_if};
use crate::simd::math::{inv_sqrt, normalize, sqrt};
use crate::simd::{Each, Simd, SimdInt, SimdMask, inlined};

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
    fn nearest<V: Simd>(x: V) -> V::Int;
    fn value<V: Simd>(i: V::Int) -> V;
    /// 1 - x^2 - y^2, its sign exact.
    fn height_squared<V: Simd>(x: V::Int, y: V::Int) -> V;
    /// 1 - x^2.
    fn rim_squared<V: Simd>(x: V::Int) -> V;
    fn pack<V: Simd>(params: [V::Int; 2]) -> V::Int;
    fn unpack<V: Simd>(code: V::Int) -> [V::Int; 2];
}

/// Unorm of `BITS / 2` bits, as the odd numbers from -m to m = 2^(BITS/2) - 1.
pub(crate) struct Unorm<const BITS: u32>;

impl<const BITS: u32> Unorm<BITS> {
    const M: i32 = unorm_max(BITS / 2);

    /// i (m - i), for the index i = (x + m) / 2: (m^2 - x^2) / 4, at most 2^30.
    #[inline(always)]
    fn quarter_rim<V: Simd>(x: V::Int) -> V::Int {
        let i = (x + V::Int::splat(Self::M)).sar(1);
        i * (V::Int::splat(Self::M) - i)
    }
}

impl<const BITS: u32> Grid for Unorm<BITS> {
    const GREATEST: i32 = Self::M;
    const STEP: i32 = 2;
    const DIAGONAL: i32 =
        ((Self::M as f64 * core::f64::consts::FRAC_1_SQRT_2) as i32 + 1) / 2 * 2 + 1;

    #[inline(always)]
    fn nearest<V: Simd>(x: V) -> V::Int {
        let half = V::splat(0.5 * Self::M as f32);
        (x * half + half).round_int().shl(1) - V::Int::splat(Self::M)
    }
    #[inline(always)]
    fn value<V: Simd>(i: V::Int) -> V {
        V::from_int(i) * V::splat(1.0 / Self::M as f32)
    }
    #[inline(always)]
    fn height_squared<V: Simd>(x: V::Int, y: V::Int) -> V {
        // m^2 - x^2 - y^2 = 4 q - 1, in exact integers; never zero, as odd squares are 1 mod 8.
        let q = Self::quarter_rim::<V>(x) + Self::quarter_rim::<V>(y)
            - V::Int::splat((Self::M as i64 * Self::M as i64 / 4) as i32);
        (V::from_int(q) * V::splat(4.0) - V::splat(1.0))
            * V::splat((1.0 / (Self::M as f64 * Self::M as f64)) as f32)
    }
    #[inline(always)]
    fn rim_squared<V: Simd>(x: V::Int) -> V {
        V::from_int(Self::quarter_rim::<V>(x))
            * V::splat((4.0 / (Self::M as f64 * Self::M as f64)) as f32)
    }
    #[inline(always)]
    fn pack<V: Simd>(params: [V::Int; 2]) -> V::Int {
        pack2::<BITS, V>(params.each(|p| (p + V::Int::splat(Self::M)).sar(1)))
    }
    #[inline(always)]
    fn unpack<V: Simd>(code: V::Int) -> [V::Int; 2] {
        unpack2::<BITS, V>(code).each(|i| i.shl(1) - V::Int::splat(Self::M))
    }
}

/// Halves from -1 to 1. Greater patterns, infinities and NaN read as 1 with their sign.
pub(crate) struct Halves;

impl Grid for Halves {
    const GREATEST: i32 = half::ONE;
    const STEP: i32 = 1;
    const DIAGONAL: i32 = 0x39A9;

    #[inline(always)]
    fn nearest<V: Simd>(x: V) -> V::Int {
        half::nearest(x)
    }
    #[inline(always)]
    fn value<V: Simd>(i: V::Int) -> V {
        half::value(i)
    }
    #[inline(always)]
    fn height_squared<V: Simd>(x: V::Int, y: V::Int) -> V {
        // The squares of 11 bits are exact, and so is the difference wherever it is near zero.
        let (x, y) = (half::value::<V>(x), half::value::<V>(y));
        let (xx, yy) = (x * x, y * y);
        V::splat(1.0) - xx.greater(yy) - xx.lesser(yy)
    }
    #[inline(always)]
    fn rim_squared<V: Simd>(x: V::Int) -> V {
        let x = half::value::<V>(x);
        V::splat(1.0) - x * x
    }
    #[inline(always)]
    fn pack<V: Simd>([x, y]: [V::Int; 2]) -> V::Int {
        half::to_bits::<V>(x) | half::to_bits::<V>(y).shl(16)
    }
    #[inline(always)]
    fn unpack<V: Simd>(code: V::Int) -> [V::Int; 2] {
        [code, code.shr(16)].each(
            #[inline(always)]
            |bits| half::from_bits::<V>(bits, half::ONE),
        )
    }
}

impl<G: Grid> XyOnly<G> {
    /// Beyond the rim: whether x is the larger component, and the magnitude of the smaller.
    #[inline(always)]
    fn minor<V: Simd>([x, y]: [V::Int; 2]) -> (V::Mask, V::Int) {
        let (x, y) = (x.abs(), y.abs());
        (!x.lt(y), x.min(y).min(V::Int::splat(G::DIAGONAL)))
    }

    /// The canonical one of the points that read alike: beyond the rim, the larger component is brought back.
    #[inline(always)]
    fn canonical_point<V: Simd>([x, y]: [V::Int; 2]) -> [V::Int; 2] {
        let step = V::Int::splat(G::STEP);
        let beyond = G::height_squared::<V>(x, y).le(V::zero());
        let (x_larger, minor) = Self::minor::<V>([x, y]);
        // The first at or beyond the rim: the nearest to it or, if that is inside, the next. One tie
        // with the smaller goes to x.
        let near = G::nearest(sqrt(G::rim_squared::<V>(minor)));
        let inside = V::zero().lt(G::height_squared::<V>(minor, near));
        let first = V::Int::select(inside, near + step, near);
        let first = first.max(V::Int::select(x_larger, minor, minor + step));
        let signed = inlined(
            #[inline(always)]
            |magnitude: V::Int, sign: V::Int| {
                V::Int::select(sign.lt(V::Int::splat(0)), -magnitude, magnitude)
            },
        );
        let rim_x = signed(V::Int::select(x_larger, first, minor), x);
        let rim_y = signed(V::Int::select(x_larger, minor, first), y);
        [V::Int::select(beyond, rim_x, x), V::Int::select(beyond, rim_y, y)]
    }

    #[inline(always)]
    fn point<V: Simd>([x, y]: [V::Int; 2]) -> [V; 3] {
        let height = G::height_squared::<V>(x, y);
        let beyond = height.le(V::zero());
        let (x_larger, minor) = Self::minor::<V>([x, y]);
        // One root serves both: z inside, the larger component on the rim.
        let root = sqrt(V::select(beyond, G::rim_squared::<V>(minor), height));
        let minor = G::value::<V>(minor);
        let component = inlined(
            #[inline(always)]
            |larger: V::Mask, i: V::Int| {
                let magnitude = V::select(larger, root, minor);
                let negative = i.lt(V::Int::splat(0));
                let on_rim = V::select(negative, -magnitude, magnitude);
                V::select(beyond, on_rim, G::value::<V>(i))
            },
        );
        [component(x_larger, x), component(!x_larger, y), V::select(beyond, V::zero(), root)]
    }
}

impl<G: Grid> Formula for XyOnly<G> {
    type Words = One;
    const HEMISPHERE: bool = true;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        let [x, y, _] = normalize(v);
        G::pack::<V>(Self::canonical_point::<V>([G::nearest(x), G::nearest(y)]))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        V::compiled_for(
            #[inline(always)]
            || {
                let [x, y, z] = normalize(v);
                // Walk along the greater component, whose steps are the coarser.
                let swap = x.abs().lt(y.abs());
                let (p, q) = (V::select(swap, y, x), V::select(swap, x, y));
                let radius = sqrt(q * q + z * z);
                let around = q / radius.greater(V::splat(1e-18));
                let greatest = V::Int::splat(G::GREATEST);
                let step = V::Int::splat(G::STEP);

                let mut closest = Closest::to(v);
                let consider = inlined(
                    #[inline(always)]
                    |closest: &mut Closest<V>,
                     counts: V::Mask,
                     p_index: V::Int,
                     q_index: V::Int| {
                        let xy = [
                            V::Int::select(swap, q_index, p_index),
                            V::Int::select(swap, p_index, q_index),
                        ];
                        let xy =
                            Self::canonical_point::<V>(xy.each(|i| i.max(-greatest).min(greatest)));
                        closest.consider_where(counts, G::pack::<V>(xy), Self::point::<V>(xy));
                    },
                );
                let neighbours = inlined(
                    #[inline(always)]
                    |value: V| {
                        let near = G::nearest(value);
                        let up = G::value::<V>(near).lt(value);
                        [near, near + V::Int::select(up, step, -step)]
                    },
                );
                // On the rim there is a point for each smaller component: x above and below the diagonals,
                // y between them.
                let always = V::zero().le(V::zero());
                let to_rim = inv_sqrt((p * p + q * q).greater(V::splat(1e-30)));
                let [rim_p, rim_q] = [p, q].each(|c| c * to_rim);
                let diagonal = V::Int::splat(G::DIAGONAL);
                let outside = inlined(
                    #[inline(always)]
                    |c: V| V::Int::select(c.lt(V::zero()), -greatest, greatest),
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
                        let column_radius = sqrt(G::rim_squared::<V>(column));
                        // No point of this column is nearer than this.
                        let (dp, dr) = (p - G::value::<V>(column), radius - column_radius);
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
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        Self::point::<V>(G::unpack::<V>(code))
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        G::pack::<V>(Self::canonical_point::<V>(G::unpack::<V>(code)))
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        if flips[2] {
            return mirror_decoded::<Self, V>(code, flips);
        }
        let [x, y] = G::unpack::<V>(code);
        let point = [negate_if(x, flips[0]), negate_if(y, flips[1])];
        G::pack::<V>(Self::canonical_point::<V>(point))
    }
}

impl<const BITS: u32> Symmetric for XyOnly<Unorm<BITS>> {
    const ENTRIES: usize = 1 << (BITS - 2);

    #[inline(always)]
    fn fold<V: Simd>(code: V::Int) -> (V::Int, [V::Mask; 3]) {
        let zero = V::Int::splat(0);
        let [x, y] = <Unorm<BITS> as Grid>::unpack::<V>(code);
        let index = x.abs().shr(1) | y.abs().shr(1).shl(BITS / 2 - 1);
        (index, [x.lt(zero), y.lt(zero), zero.lt(zero)])
    }
}
