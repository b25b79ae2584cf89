//! Cartesian: the three components, each on a grid of its own: snorm, half or float.
//!
//! ```text
//! encode   v / |v|, each component to the nearest grid point
//! decode   the three values, divided by their length; (0, 0, 0) reads as +Z
//! ```
//!
//! Decoding divides by the length, so a grid point stands for its direction, and the precise
//! encoder may take any length: it tries every value of the largest component, rounding the other
//! two, and keeps the nearest direction. From each value to the next the other two components, in
//! steps of the grid, grow by the same amount; in fixed point, with nothing before the point, what
//! rounding leaves of them comes of one addition, which wraps.
//!
//! Canonical: of the patterns of one direction, such as (1, 1, 0) and (90, 90, 0), the one whose
//! length is nearest to 1. That is the one rounding gives. On the grids that are finer than f32,
//! snorm16x3 and float16x3, those that decode alike count as one. Axes survive exactly. In snorm,
//! -M-1 reads as -M; in halves, infinities and NaN read as 65504.
//!
//! [`Floats`] stores the bits of the input as they are, and gives them back.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; the search over lengths: Kaplanyan, "CryENGINE 3: Reaching the Speed of Light", 2010.

use core::marker::PhantomData;

use crate::formula::bits::{snorm_max, unorm_max};
use crate::formula::half;
use crate::formula::{
    Formula, One, Packed, Symmetric, Three, Words, mirror_decoded, mirror_point, sign_bit,
};
use crate::simd::math::{chord_squared, dot, inv_sqrt, length_squared, normalize, sqrt};
use crate::simd::{Each, Simd, SimdInt, SimdMask, inlined};

/// Three components on a grid.
pub(crate) struct Cartesian<G>(PhantomData<G>);

/// The values that each component may have. The default is whole steps.
pub(crate) trait Grid: 'static {
    type Words: Words;
    /// Steps from 0 to 1 on each axis.
    const STEPS: [f32; 3];
    /// How many values the search for the largest component tries.
    const LENGTHS: i32;
    /// Whether f32 tells all directions of the grid apart.
    const DISTINCT: bool;
    /// From one grid point to the next, in steps.
    const PITCH: i32 = 1;
    /// Points whose length is below steps / SHORTER need no search, as a multiple is a point: of whole
    /// steps twice as long, of odd ones three times.
    const SHORTER: i32 = Self::PITCH * (Self::PITCH + 1);

    /// The `n`th value for the largest component, `n` from 1 to [`LENGTHS`](Self::LENGTHS).
    #[inline(always)]
    fn length<V: Simd>(n: V, step: V) -> V {
        n * step
    }
    /// Nearest grid point, ties to even.
    #[inline(always)]
    fn nearest<V: Simd>(x: V, steps: V) -> V::Int {
        (x * steps).round_int()
    }
    #[inline(always)]
    fn value<V: Simd>(i: V::Int, step: V) -> V {
        V::from_int(i) * step
    }
    /// How far `x` is from the nearest value, but for what f32 rounds off.
    #[inline(always)]
    fn off<V: Simd>(x: V, steps: V, step: V) -> V {
        let places = x * steps;
        (places - places.round()).abs() * step
    }
    /// At most half the distance between the two values around `x`.
    #[inline(always)]
    fn half_gap<V: Simd>(_: V, step: V) -> V {
        step * V::splat(0.49 * Self::PITCH as f32)
    }
    /// Of the points in the direction of `point`, which is not zero, the one whose length is
    /// nearest to 1.
    #[inline(always)]
    fn representative<V: Simd>(point: [V::Int; 3]) -> [V::Int; 3] {
        integer_representative::<V>(point, Self::STEPS, Self::PITCH)
    }
    fn pack<V: Simd>(v: [V::Int; 3]) -> Packed<Cartesian<Self>, V>
    where
        Self: Sized;
    fn unpack<V: Simd>(code: Packed<Cartesian<Self>, V>) -> [V::Int; 3]
    where
        Self: Sized;
}

/// Snorm of `X`, `Y` and `Z` bits, x in the low bits. None has more than x.
pub(crate) struct Snorm<const X: u32, const Y: u32, const Z: u32>;

impl<const X: u32, const Y: u32, const Z: u32> Grid for Snorm<X, Y, Z> {
    type Words = One;
    const STEPS: [f32; 3] = [snorm_max(X) as f32, snorm_max(Y) as f32, snorm_max(Z) as f32];
    const LENGTHS: i32 = snorm_max(X);
    const DISTINCT: bool = true;

    #[inline(always)]
    fn pack<V: Simd>([x, y, z]: [V::Int; 3]) -> V::Int {
        x.low(X) | y.low(Y).shl(X) | z.low(Z).shl(X + Y)
    }
    #[inline(always)]
    fn unpack<V: Simd>(code: V::Int) -> [V::Int; 3] {
        let field = inlined(
            #[inline(always)]
            |shift: u32, bits: u32| {
                code.shr(shift).sign_extend(bits).max(V::Int::splat(-snorm_max(bits)))
            },
        );
        [field(0, X), field(X, Y), field(X + Y, Z)]
    }
}

/// Snorm of 16 bits in three words.
pub(crate) struct Snorm16;

impl Grid for Snorm16 {
    type Words = Three;
    const STEPS: [f32; 3] = [snorm_max(16) as f32; 3];
    const LENGTHS: i32 = snorm_max(16);
    const DISTINCT: bool = false;

    #[inline(always)]
    fn pack<V: Simd>(v: [V::Int; 3]) -> [V::Int; 3] {
        v
    }
    #[inline(always)]
    fn unpack<V: Simd>(code: [V::Int; 3]) -> [V::Int; 3] {
        code.each(|c| c.sign_extend(16).max(V::Int::splat(-snorm_max(16))))
    }
}

/// Biased unorm of `BITS` bits, (c + 1) / 2: the odd numbers from -(2^BITS - 1). No component is
/// zero.
pub(crate) struct Unorm<const BITS: u32>;

impl<const BITS: u32> Unorm<BITS> {
    const M: i32 = unorm_max(BITS);

    #[inline(always)]
    fn index<V: Simd>(i: V::Int) -> V::Int {
        (i + V::Int::splat(Self::M)).sar(1)
    }
    #[inline(always)]
    fn odd<V: Simd>(index: V::Int) -> V::Int {
        index.low(BITS).shl(1) - V::Int::splat(Self::M)
    }
}

/// What unorm grids share, whatever holds their codes.
macro_rules! unorm_grid {
    ($bits:literal, $words:ty, $distinct:literal, $pack:expr, $unpack:expr) => {
        impl Grid for Unorm<$bits> {
            type Words = $words;
            const STEPS: [f32; 3] = [unorm_max($bits) as f32; 3];
            const LENGTHS: i32 = (unorm_max($bits) + 1) / 2;
            const DISTINCT: bool = $distinct;
            const PITCH: i32 = 2;

            #[inline(always)]
            fn length<V: Simd>(n: V, step: V) -> V {
                (n + n - V::splat(1.0)) * step
            }
            #[inline(always)]
            fn nearest<V: Simd>(x: V, steps: V) -> V::Int {
                let half = steps * V::splat(0.5);
                (x * half + half).round_int().shl(1) - V::Int::splat(Self::M)
            }
            #[inline(always)]
            fn off<V: Simd>(x: V, steps: V, step: V) -> V {
                let places = (x * steps - V::splat(1.0)) * V::splat(0.5);
                (places - places.round()).abs() * (step + step)
            }
            #[inline(always)]
            fn pack<V: Simd>(v: [V::Int; 3]) -> Packed<Cartesian<Self>, V> {
                $pack(v.each(|i| Self::index::<V>(i)))
            }
            #[inline(always)]
            fn unpack<V: Simd>(code: Packed<Cartesian<Self>, V>) -> [V::Int; 3] {
                $unpack(code).each(|i| Self::odd::<V>(i))
            }
        }
    };
}

unorm_grid!(8, One, true, |[x, y, z]: [V::Int; 3]| x | y.shl(8) | z.shl(16), |code: V::Int| [
    code,
    code.shr(8),
    code.shr(16)
]);
unorm_grid!(16, Three, false, |v| v, |v| v);

/// IEEE halves. The largest component of a canonical code is from 0.5 to 1.
pub(crate) struct Halves;

impl Grid for Halves {
    type Words = Three;
    const STEPS: [f32; 3] = [1.0; 3];
    const LENGTHS: i32 = 1025;
    const DISTINCT: bool = false;

    #[inline(always)]
    fn length<V: Simd>(n: V, _: V) -> V {
        (n + V::splat(1023.0)) * V::splat(1.0 / 2048.0)
    }
    #[inline(always)]
    fn nearest<V: Simd>(x: V, _: V) -> V::Int {
        half::nearest(x)
    }
    #[inline(always)]
    fn value<V: Simd>(i: V::Int, _: V) -> V {
        half::value(i)
    }
    #[inline(always)]
    fn off<V: Simd>(x: V, _: V, _: V) -> V {
        (half::value::<V>(half::nearest(x)) - x).abs()
    }
    #[inline(always)]
    fn half_gap<V: Simd>(x: V, _: V) -> V {
        x.abs() * V::splat(0.99 / 4096.0)
    }
    #[inline(always)]
    fn representative<V: Simd>(point: [V::Int; 3]) -> [V::Int; 3] {
        // Each value is an odd integer times a power of two, or zero.
        let values = point.each(|i| half::value::<V>(i));
        let odd = point.each(
            #[inline(always)]
            |i| {
                let mantissa = half::mantissa::<V>(i);
                let lowest = V::from_int(mantissa & -mantissa).greater(V::splat(1.0));
                V::from_int(mantissa) / lowest
            },
        );
        let divisor = gcd(odd);
        let primitive = values.each(|c| c / divisor);
        // So many times, and powers of two, keep all mantissas below 2^11.
        let room = (V::splat(2047.5) * divisor / odd[0].greater(odd[1]).greater(odd[2])).floor();
        let times = inv_sqrt(length_squared(primitive));
        // The least power of two for which that is enough, but none that would cut below 2^-24.
        let over = times / room;
        let power =
            V::from_bits((over.to_bits() + V::Int::splat(0x7F_FFFF)) & V::Int::splat(0x7F80_0000));
        let units = [0, 1, 2].each(
            #[inline(always)]
            |i: usize| {
                let zero = odd[i].le(V::zero());
                let unit = values[i].abs() / odd[i].greater(V::splat(1.0));
                V::select(zero, V::splat(1.0), unit)
            },
        );
        let finest = V::splat(1.0 / 16_777_216.0) / units[0].lesser(units[1]).lesser(units[2]);
        let power = power.greater(finest);
        // Either a multiple of that power, or the greatest multiple of the one below.
        let at_power = (times / power).round() * power;
        let below = room * power * V::splat(0.5);
        let use_below = (times - below).abs().lt((at_power - times).abs()) & finest.lt(power);
        let power = V::select(use_below, power * V::splat(0.5), power);
        let times = V::select(use_below, room, (times / power).round());
        // The largest component is 1 at most.
        let [x, y, z] = primitive.each(
            #[inline(always)]
            |c| (c * power).abs(),
        );
        let largest = x.greater(y).greater(z);
        let too_long = V::splat(1.0).lt(largest * times);
        let times = V::select(too_long, times - V::splat(1.0), times);
        let times = V::select(times.lt(V::splat(0.5)), V::splat(0.5), times);
        primitive.each(
            #[inline(always)]
            |c| half::nearest(c * power * times),
        )
    }
    #[inline(always)]
    fn pack<V: Simd>(v: [V::Int; 3]) -> [V::Int; 3] {
        v.each(|i| half::to_bits::<V>(i))
    }
    #[inline(always)]
    fn unpack<V: Simd>(code: [V::Int; 3]) -> [V::Int; 3] {
        code.each(|bits| half::from_bits::<V>(bits, half::GREATEST))
    }
}

impl<G: Grid> Cartesian<G> {
    #[inline(always)]
    fn nearest<V: Simd>(v: [V; 3]) -> [V::Int; 3] {
        [0, 1, 2].each(
            #[inline(always)]
            |i: usize| G::nearest(v[i], V::splat(G::STEPS[i])),
        )
    }

    #[inline(always)]
    fn values<V: Simd>(point: [V::Int; 3]) -> [V; 3] {
        [0, 1, 2].each(
            #[inline(always)]
            |i: usize| G::value(point[i], V::splat(1.0 / G::STEPS[i])),
        )
    }

    /// The point of a code; (0, 0, 0) is +Z.
    #[inline(always)]
    fn point<V: Simd>(code: Packed<Self, V>) -> [V::Int; 3] {
        let [x, y, z] = G::unpack::<V>(code);
        let is_zero = (x | y | z).eq(V::Int::splat(0));
        let [_, _, pole] = Self::nearest([V::zero(), V::zero(), V::splat(1.0)]);
        [x, y, V::Int::select(is_zero, pole, z)]
    }

    #[inline(always)]
    fn unit<V: Simd>(values: [V; 3]) -> [V; 3] {
        let zero = length_squared(values).le(V::zero());
        let [x, y, z] = values;
        normalize([x, y, V::select(zero, V::splat(1.0), z)])
    }
}

/// [`Grid::representative`] where the values are integers over `steps`.
#[inline(always)]
fn integer_representative<V: Simd>(point: [V::Int; 3], steps: [f32; 3], pitch: i32) -> [V::Int; 3] {
    let divisor = gcd(point.each(
        #[inline(always)]
        |i| V::from_int(i.abs()),
    ));
    let primitive = point.each(
        #[inline(always)]
        |i| V::from_int(i) / divisor,
    );
    let values = [0, 1, 2].each(
        #[inline(always)]
        |i: usize| primitive[i] * V::splat(1.0 / steps[i]),
    );
    // As many times as bring it nearest to 1, but not beyond the grid.
    let times = inv_sqrt(length_squared(values));
    let room = [0, 1, 2].each(
        #[inline(always)]
        |i: usize| V::splat(steps[i] + 0.5) / primitive[i].abs().greater(V::splat(0.01)),
    );
    let room = room[0].lesser(room[1]).lesser(room[2]);
    let times = if steps[2] < steps[0] {
        // Too close for f32 between twice and three times (244, 328, 9) of snorm11-11-10, for one.
        let less = times.floor();
        let half_more = (less + less).round_int() + V::Int::splat(1);
        let primitive = primitive.each(
            #[inline(always)]
            |c| c.round_int(),
        );
        let more = is_below_two::<V>(primitive, half_more, steps);
        V::select(more, less + V::splat(1.0), less).lesser(room.floor())
    } else if pitch == 1 {
        times.round().lesser(room.floor())
    } else {
        // Odd points have only odd multiples.
        let (half, one) = (V::splat(0.5), V::splat(1.0));
        let pairs = ((times - one) * half).round().lesser(((room - one) * half).floor());
        pairs + pairs + one
    };
    primitive.each(
        #[inline(always)]
        |c| (c * times).round_int(),
    )
}

/// Whether so many times a point is shorter than 2, exactly, where z has fewer steps than x and y.
#[inline(always)]
fn is_below_two<V: Simd>(point: [V::Int; 3], times: V::Int, steps: [f32; 3]) -> V::Mask {
    // In steps of x, with (most / least)^2 = whole + rest / least^2:
    // (x^2 + y^2 + whole z^2 + rest z^2 / least^2) times^2 < 4 most^2.
    let [most, least] = [steps[0] as i64, steps[2] as i64].map(|steps| steps * steps);
    let (whole, rest) = (most / least, most % least);
    let int = inlined(
        #[inline(always)]
        |i: i64| V::Int::splat(i as i32),
    );
    let square = times * times;
    let [x, y, z] = point.each(
        #[inline(always)]
        |i| i * i * square,
    );
    // Below zero it decides, but for the rest, which is added to no more than that can outweigh.
    let over = x + y + z * int(whole) - int(4 * most);
    let least_over = -(rest * (4 * most / whole) / least + 1);
    let over_with_rest = over.max(int(least_over)) * int(least) + z * int(rest);
    over.lt(int(0)) & over_with_rest.lt(int(0))
}

/// The greatest common divisor of three integers from 0 to 2^16, not all of them zero.
#[inline(always)]
fn gcd<V: Simd>([mut a, mut b, mut c]: [V; 3]) -> V {
    let zero = V::zero();
    loop {
        let (least, most) = (b.lesser(c), b.greater(c));
        if !zero.lt(most).any() {
            return a;
        }
        // By the least that is not zero; what is left may be below zero.
        let by = V::select(zero.lt(least), least, V::select(zero.lt(most), most, a));
        let per = V::splat(1.0) / by;
        let rest = inlined(
            #[inline(always)]
            |x: V| (x - (x * per).round() * by).abs(),
        );
        (a, b, c) = (by, rest(a), rest(most));
    }
}

/// Of fractions in 32 bits, one.
const WRAP: f32 = 4_294_967_296.0;

/// x in units of 2^-32, without what is before the point. For |x| < 2^10.
#[inline(always)]
fn wrapping_fraction<V: Simd>(x: V) -> V::Int {
    let high = (x * V::splat(2048.0)).round();
    let low = (x - high * V::splat(1.0 / 2048.0)) * V::splat(WRAP);
    high.round_int().shl(21) + low.round_int()
}

/// One target, seen along its largest component.
struct Search<V: Simd> {
    target: [V; 3],
    /// The components over the largest one's magnitude.
    slope: [V; 3],
    /// Their sum of squares.
    stretch: V,
    /// The steps on the axis of the largest component, and one step.
    steps: V,
    step: V,
    /// Whether that is x, or y.
    largest: [V::Mask; 2],
    /// Of the other two axes the slope, the steps, and one step.
    others: [[V; 3]; 2],
}

impl<V: Simd> Search<V> {
    #[inline(always)]
    fn new<G: Grid>(v: [V; 3]) -> Self {
        // Bring the length between sqrt(1/2) and sqrt(2) by a power of two.
        let exponent = length_squared(v).to_bits().sar(23) - V::Int::splat(126);
        let scale = V::from_bits((V::Int::splat(127) - exponent.sar(1)).shl(23));
        let v = v.each(|c| c * scale);
        // A decoded vector is not divided again, so that its own code is at distance zero.
        let unit = normalize(v);
        let off = (length_squared(v) - V::splat(1.0)).abs();
        let decoded = off.lt(V::splat(6e-7));
        let target = [0, 1, 2].each(|i: usize| V::select(decoded, v[i], unit[i]));
        let [x, y, z] = target.each(|c| c.abs());
        let largest = x.greater(y).greater(z);
        let (is_x, is_y) = (largest.le(x), largest.le(y));
        let slope = target.each(|c| c / largest);
        let [on_x, on_y, on_z] = [0, 1, 2]
            .each(|i: usize| [slope[i], V::splat(G::STEPS[i]), V::splat(1.0 / G::STEPS[i])]);
        let pick = inlined(
            #[inline(always)]
            |mask, yes: [V; 3], no: [V; 3]| {
                [0, 1, 2].each(|i: usize| V::select(mask, yes[i], no[i]))
            },
        );
        let [_, steps, step] = pick(is_x, on_x, pick(is_y, on_y, on_z));
        Search {
            target,
            slope,
            stretch: length_squared(slope),
            steps,
            step,
            largest: [is_x, is_y],
            others: [pick(is_x, on_y, on_x), pick(is_x | is_y, on_z, on_y)],
        }
    }

    /// A point can only be nearer than a chord, of which `distance` is the square, if the sine of its
    /// angle is below the chord, but for what f32 rounds off. Gives the square of that sine and, over
    /// the length on the largest axis, how far off the point can be on each of the others.
    #[inline(always)]
    fn bounds(&self, distance: V) -> [V; 2] {
        let sine = sqrt(distance) * V::splat(1.01) + V::splat(6e-7);
        // Stretch times the sine, and a little for the length of the offset itself.
        let off = self.stretch * sine * V::splat(1.3);
        [sine * sine, V::select(sine.lt(V::splat(0.1)), off, V::splat(f32::INFINITY))]
    }

    /// The nearest point of a grid of whole steps, or a multiple of it.
    #[inline(always)]
    fn nearest_whole<G: Grid>(&self) -> [V::Int; 3] {
        let (mut point, sure) = self.nearest_corner::<G, false>();
        if (!sure).any() {
            let (nearest, _) = self.nearest_corner::<G, true>();
            point = [0, 1, 2].each(
                #[inline(always)]
                |i: usize| V::Int::select(sure, point[i], nearest[i]),
            );
        }
        point
    }

    /// At each length the target's ray passes a cell of the grid. Gives the nearest of the corners of
    /// all cells, or unless `ALL` of those that rounding gives, and whether these are enough.
    #[inline(always)]
    fn nearest_corner<G: Grid, const ALL: bool>(&self) -> ([V::Int; 3], V::Mask) {
        let most = G::STEPS[0];
        let equal = G::STEPS[2] == most;
        let [[p, p_steps, _], [q, q_steps, _]] = self.others;
        let one = V::splat(1.0);
        let lengths = G::LENGTHS + 1 - most as i32 / G::SHORTER;
        let first = (self.steps * V::splat(1.0 / G::SHORTER as f32)).floor();
        // How far the ray is from the rounded corner: fractions of 2^32 pitches, which wrap.
        let rises = [p * (p_steps / self.steps), q * (q_steps / self.steps)];
        let [mut a, mut b] = rises.each(
            #[inline(always)]
            |rise| {
                let from = wrapping_fraction(rise) * first.round_int();
                if G::PITCH == 1 {
                    return from;
                }
                from - wrapping_fraction((rise + one) * V::splat(0.5))
            },
        );
        let [rise_a, rise_b] = rises.each(
            #[inline(always)]
            |rise| wrapping_fraction(rise),
        );
        // The square of the tangent of the angle between point and target, but for a factor, is
        // (x (x + skew y) + other y^2) / (length - (x lean_x + y lean_y))^2.
        let unit = V::splat(G::PITCH as f32 / WRAP);
        let ratio = p_steps / q_steps;
        let scale = one + q * q;
        let skew = -(p * q + p * q) / scale * ratio;
        let other = (one + p * p) / scale * (ratio * ratio);
        let lean = unit * self.steps / self.stretch;
        let (lean_x, lean_y) = (lean * p / p_steps, lean * q / q_steps);
        // With it the length, x and y.
        let mut best = [V::splat(f32::MAX), one, one, V::zero(), V::zero()];
        let mut n = first;
        for _ in 0..lengths {
            let here = G::length(n, one);
            let consider = inlined(
                #[inline(always)]
                |best: &mut [V; 5], x: V, y: V| {
                    let [square, along, ..] = *best;
                    let across = x * (x + skew * y) + other * y * y;
                    let reach = here - (x * lean_x + y * lean_y);
                    let reach = reach * reach;
                    let mut nearer = (across * along).lt(square * reach);
                    if !equal {
                        nearer = nearer & here.le(self.steps);
                    }
                    for (best, now) in best.iter_mut().zip([across, reach, here, x, y]) {
                        *best = V::select(nearer, now, *best);
                    }
                },
            );
            let [x, y] = [a, b].each(V::from_int);
            consider(&mut best, x, y);
            if ALL {
                let [far_x, far_y] = [x, y].each(
                    #[inline(always)]
                    |x| x - V::splat(WRAP).negate_where_negative(x),
                );
                consider(&mut best, far_x, y);
                consider(&mut best, x, far_y);
                consider(&mut best, far_x, far_y);
            }
            (n, a, b) = (n + one, a + rise_a, b + rise_b);
        }
        let [square, along, length, x, y] = best;
        let at = length * self.step;
        let ideal = self.slope.each(
            #[inline(always)]
            |s| s * at,
        );
        let [x, y] = if ALL { [x * unit / p_steps, y * unit / q_steps] } else { [V::zero(); 2] };
        let [is_x, is_y] = self.largest;
        let zero = V::zero();
        let off = [
            V::select(is_x, zero, x),
            V::select(is_x, x, V::select(is_y, zero, y)),
            V::select(is_x | is_y, y, zero),
        ];
        let point = [0, 1, 2].each(
            #[inline(always)]
            |i: usize| ideal[i] - off[i],
        );
        let point = Cartesian::<G>::nearest(point);
        (point, self.surely_rounded::<G>(square / along))
    }

    /// Whether the nearest corner is a rounded one, if the tangent of the nearest of those is, squared and
    /// in the units of [`nearest_corner`](Self::nearest_corner), `square`.
    #[inline(always)]
    fn surely_rounded<G: Grid>(&self, square: V) -> V::Mask {
        let [[p, p_steps, _], [q, ..]] = self.others;
        let [pp, qq] = [p * p, q * q];
        let one = V::splat(1.0);
        let unit = V::splat(G::PITCH as f32 / WRAP);
        let tangent = unit * self.steps / (p_steps * self.stretch);
        let tangent_squared = tangent * tangent * (one + qq) * square;
        // What is no rounded corner is at least half a pitch off on one axis.
        let half = 0.23 * (G::PITCH * G::PITCH) as f32 / (G::STEPS[0] * G::STEPS[0]);
        (tangent_squared * self.stretch * (one + pp.greater(qq))).lt(V::splat(half))
    }

    /// The nearest point of a grid finer than f32; of those that decode alike, the one whose length is
    /// nearest to 1.
    #[inline(always)]
    fn nearest<G: Grid>(&self) -> [V::Int; 3] {
        let mut found = [V::Int::splat(0); 3];
        let mut distance = V::splat(4.0);
        let mut off_unit = V::splat(4.0);
        let per_stretch = V::splat(1.0) / self.stretch;
        let [mut within, mut reach] = self.bounds(distance);
        let first = (G::STEPS[0] as i32 / G::SHORTER).max(1);
        for n in (first..=G::LENGTHS).rev() {
            let length = G::length(V::splat(n as f32), self.step);
            let [a, b] = self.others.each(
                #[inline(always)]
                |[slope, steps, step]| G::off(slope * length, steps, step),
            );
            let reach_here = reach * length;
            if !a.greater(b).le(reach_here).any() {
                continue;
            }
            let ideal = self.slope.each(|s| s * length);
            // Near the diagonals and in a coarse grid the rounded corner of the cell is not always
            // the nearest: components may go the other way, if half a gap is near enough.
            let gap = [0, 1, 2].each(
                #[inline(always)]
                |i: usize| G::half_gap(ideal[i], V::splat(1.0 / G::STEPS[i])),
            );
            let least = gap[0].lesser(gap[1]).lesser(gap[2]);
            let other_ways = least.le(reach_here).any();
            let mut consider = inlined(
                #[inline(always)]
                |point: [V::Int; 3]| {
                    let values = Cartesian::<G>::values::<V>(point);
                    let offset = [0, 1, 2].each(|i: usize| values[i] - ideal[i]);
                    let square = length_squared(offset);
                    let along = dot(offset, self.slope);
                    let across = square - along * along * per_stretch;
                    let near =
                        across.le(length_squared(values) * within) & length.le(V::splat(1.0));
                    if near.any() {
                        // As f32 does not tell neighbours apart, only canonical points compete.
                        let point = G::representative::<V>(point);
                        let values = Cartesian::<G>::values::<V>(point);
                        let there = chord_squared(Cartesian::<G>::unit(values), self.target);
                        let off = (sqrt(length_squared(values)) - V::splat(1.0)).abs();
                        let alike = distance.le(there) & there.le(distance) & off.lt(off_unit);
                        let better = near & (there.lt(distance) | alike);
                        distance = V::select(better, there, distance);
                        off_unit = V::select(better, off, off_unit);
                        found =
                            [0, 1, 2].each(|i: usize| V::Int::select(better, point[i], found[i]));
                        [within, reach] = self.bounds(distance);
                    }
                },
            );
            let rounded = Cartesian::<G>::nearest(ideal);
            consider(rounded);
            if other_ways {
                // The corners but for the rounded one: the largest component stays as it is.
                let values = Cartesian::<G>::values::<V>(rounded);
                let other = [0, 1, 2].each(
                    #[inline(always)]
                    |i: usize| {
                        let count = inlined(
                            #[inline(always)]
                            |mask| V::Int::select(mask, V::Int::splat(G::PITCH), V::Int::splat(0)),
                        );
                        let up = count(values[i].lt(ideal[i]));
                        let down = count(ideal[i].lt(values[i]));
                        rounded[i] + up - down
                    },
                );
                for kept in 0..3 {
                    let mut point = other;
                    point[kept] = rounded[kept];
                    consider(point);
                }
            }
        }
        found
    }
}

impl<G: Grid> Formula for Cartesian<G> {
    type Words = G::Words;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> Packed<Self, V> {
        G::pack::<V>(Self::nearest(normalize(v)))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> Packed<Self, V> {
        V::compiled_for(
            #[inline(always)]
            || {
                let search = Search::new::<G>(v);
                let point = if G::DISTINCT {
                    G::representative::<V>(search.nearest_whole::<G>())
                } else {
                    search.nearest::<G>()
                };
                G::pack::<V>(point)
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(code: Packed<Self, V>) -> [V; 3] {
        Self::unit(Self::values::<V>(G::unpack::<V>(code)))
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: Packed<Self, V>) -> Packed<Self, V> {
        if !G::DISTINCT {
            return Self::encode_precise(Self::decode::<V>(code));
        }
        G::pack::<V>(G::representative::<V>(Self::point::<V>(code)))
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: Packed<Self, V>, flips: [bool; 3]) -> Packed<Self, V> {
        if !G::DISTINCT {
            return mirror_decoded::<Self, V>(code, flips);
        }
        G::pack::<V>(G::representative::<V>(mirror_point(Self::point::<V>(code), flips)))
    }
}

impl<const X: u32, const Y: u32, const Z: u32> Symmetric for Cartesian<Snorm<X, Y, Z>> {
    const ENTRIES: usize = 1 << (X + Y + Z - 3);

    #[inline(always)]
    fn fold<V: Simd>(code: V::Int) -> (V::Int, [V::Mask; 3]) {
        let point = <Snorm<X, Y, Z> as Grid>::unpack::<V>(code);
        let [x, y, z] = point.each(|i| i.abs());
        (x | y.shl(X - 1) | z.shl(X + Y - 2), point.each(|i| i.lt(V::Int::splat(0))))
    }
}

/// Crytek's best-fit normals: the grid of `Unorm<8>`, its fast encoder reading the length from a
/// table.
///
/// With a >= b >= c the magnitudes, the table over (b / a, c / b) has the length, (2 k - 1) / 255
/// on the largest component, with which rounding points closest to the middle of its texel. 512 x
/// 512 bytes.
pub(crate) struct BestFit;

static BEST_FIT: &[u8; 512 * 512] = include_bytes!(concat!(env!("OUT_DIR"), "/best_fit.bin"));

impl Formula for BestFit {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        let [x, y, z] = v.each(|c| c.abs());
        let (a, rest) = (x.greater(y), x.lesser(y));
        let (a, b, c) = (a.greater(z), a.lesser(z).greater(rest), rest.lesser(z));
        let texel = inlined(
            #[inline(always)]
            |t: V| (t * V::splat(512.0)).floor().round_int().min(V::Int::splat(511)),
        );
        let (u, v_texel) = (texel(b / a), texel(c / b.greater(V::splat(1e-30))));
        let largest = V::from_int(V::gather(BEST_FIT, v_texel.shl(9) + u));
        let scale = largest * V::splat(1.0 / 255.0) / a;
        let steps = V::splat(255.0);
        let point = v.each(
            #[inline(always)]
            |c| Unorm::<8>::nearest(c * scale, steps),
        );
        Unorm::<8>::pack::<V>(Unorm::<8>::representative::<V>(point))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        V::compiled_for(
            #[inline(always)]
            || Cartesian::<Unorm<8>>::encode_precise(v),
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        Cartesian::<Unorm<8>>::decode(code)
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        Cartesian::<Unorm<8>>::canonical::<V>(code)
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        Cartesian::<Unorm<8>>::mirror::<V>(code, flips)
    }
}

/// Three `f32`, bit for bit.
pub(crate) struct Floats;

impl Formula for Floats {
    type Words = Three;

    #[inline(always)]
    fn prepare<V: Simd>(v: [V; 3]) -> [V; 3] {
        v
    }
    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> [V::Int; 3] {
        v.each(|c| c.to_bits())
    }
    #[inline(always)]
    fn decode<V: Simd>(code: [V::Int; 3]) -> [V; 3] {
        code.each(V::from_bits)
    }
    #[inline(always)]
    fn canonical<V: Simd>(code: [V::Int; 3]) -> [V::Int; 3] {
        code
    }
    #[inline(always)]
    fn mirror<V: Simd>([x, y, z]: [V::Int; 3], flips: [bool; 3]) -> [V::Int; 3] {
        let [flip_x, flip_y, flip_z] = flips.each(
            #[inline(always)]
            |flip| sign_bit::<V>(flip),
        );
        [x ^ flip_x, y ^ flip_y, z ^ flip_z]
    }
}
