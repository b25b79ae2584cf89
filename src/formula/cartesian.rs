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

use super::support::bits::{snorm_max, unorm_max};
use super::support::half;
use super::support::sign::{mirror_point, sign_bit};
use super::{Code, Formula, Symmetric, kernels};
use crate::batch::storage::{CodeShape, Word, Words, Words3};
use crate::simd::math::{inv_sqrt, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, Vec3, map_vec, map2, map3};

/// Three components on a grid.
#[derive(Clone, Copy)]
pub(crate) struct Cartesian<G>(G);

/// The values that each component may have. The default is whole steps.
pub(crate) trait Grid: Copy + Send + Sync + 'static {
    type Shape: CodeShape;
    /// Whether f32 tells all directions of the grid apart.
    const DISTINCT: bool;
    /// From one grid point to the next, in steps.
    const PITCH: i32 = 1;
    /// Points whose length is below steps / SHORTER need no search, as a multiple is a point: of whole
    /// steps twice as long, of odd ones three times.
    const SHORTER: i32 = Self::PITCH * (Self::PITCH + 1);

    /// Steps from 0 to 1 on each axis.
    fn steps(self) -> [f32; 3];
    /// One step on each axis.
    fn step(self) -> [f32; 3];
    /// Number of values that the search for the largest component tries.
    fn lengths(self) -> i32;
    /// The steps of a grid that is coarser in z.
    #[inline(always)]
    fn uneven(self) -> Option<Uneven> {
        None
    }

    /// The `n`th value for the largest component, `n` from 1 to [`lengths`](Grid::lengths).
    #[inline(always)]
    fn length<V: Simd>(self, n: V, step: V) -> V {
        n * step
    }
    /// Nearest grid point, ties to even.
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V, steps: f32) -> V::Int {
        (x * steps).round_int()
    }
    #[inline(always)]
    fn value<V: Simd>(self, i: V::Int, step: f32) -> V {
        V::from_int(i) * step
    }
    /// Distance of `x` from the nearest value, up to rounding in f32.
    #[inline(always)]
    fn off<V: Simd>(self, x: V, steps: V, step: V) -> V {
        let places = x * steps;
        (places - places.round()).abs() * step
    }
    /// At most half the distance between the two values around `x`.
    #[inline(always)]
    fn half_gap<V: Simd>(self, _: V, step: f32) -> V {
        V::splat(step * (0.49 * Self::PITCH as f32))
    }
    /// Of the points in the direction of `point`, which is not zero, the one whose length is
    /// nearest to 1.
    #[inline(always)]
    fn representative<V: Simd>(self, point: Vec3<V::Int>) -> Vec3<V::Int> {
        integer_representative::<V, Self>(self, point)
    }
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> <Self::Shape as CodeShape>::In<V>;
    fn unpack<V: Simd>(self, code: <Self::Shape as CodeShape>::In<V>) -> Vec3<V::Int>;
}

/// Where the three components are in a code.
pub(crate) trait Fields: Copy + Send + Sync + 'static {
    type Shape: CodeShape;
    /// Whether f32 tells the directions of so many bits apart.
    const DISTINCT: bool;

    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> <Self::Shape as CodeShape>::In<V>;
    /// The fields, with anything above their bits.
    fn unpack<V: Simd>(self, code: <Self::Shape as CodeShape>::In<V>) -> Vec3<V::Int>;
}

/// One word, x in the low bits.
#[derive(Clone, Copy)]
pub(crate) struct OneWord {
    bits: [u32; 3],
}

/// A word each.
#[derive(Clone, Copy)]
pub(crate) struct ThreeWords;

impl Fields for OneWord {
    type Shape = Word;
    const DISTINCT: bool = true;

    #[inline(always)]
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> V::Int {
        let [x, y, z] = self.bits;
        point.x.low_bits(x) | point.y.low_bits(y).shl(x) | point.z.low_bits(z).shl(x + y)
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: V::Int) -> Vec3<V::Int> {
        let [x, y, _] = self.bits;
        Vec3::new(code, code.shr_logical(x), code.shr_logical(x + y))
    }
}

impl Fields for ThreeWords {
    type Shape = Words3;
    const DISTINCT: bool = false;

    #[inline(always)]
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> [V::Int; 3] {
        point.to_array()
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: [V::Int; 3]) -> Vec3<V::Int> {
        Vec3::from(code)
    }
}

/// Snorm.
#[derive(Clone, Copy)]
pub(crate) struct Snorm<F> {
    fields: F,
    bits: [u32; 3],
    steps: [f32; 3],
    step: [f32; 3],
    uneven: Option<Uneven>,
}

impl<F: Fields> Snorm<F> {
    const fn with_fields(fields: F, bits: [u32; 3]) -> Self {
        let steps =
            [snorm_max(bits[0]) as f32, snorm_max(bits[1]) as f32, snorm_max(bits[2]) as f32];
        let step = [1.0 / steps[0], 1.0 / steps[1], 1.0 / steps[2]];
        let uneven = if bits[2] < bits[0] { Some(Uneven::new(bits)) } else { None };
        Snorm { fields, bits, steps, step, uneven }
    }
}

/// Snorm in one word.
pub(crate) type SnormXyz = Cartesian<Snorm<OneWord>>;
/// Snorm of 16 bits each.
pub(crate) type Snorm16Xyz = Cartesian<Snorm<ThreeWords>>;
/// Biased unorm of 8 bits each.
pub(crate) type UnormXyz = Cartesian<Unorm<OneWord>>;
/// Biased unorm of 16 bits each.
pub(crate) type Unorm16Xyz = Cartesian<Unorm<ThreeWords>>;
/// Halves.
pub(crate) type HalfXyz = Cartesian<Halves>;

impl SnormXyz {
    /// Of so many bits for x, y and z. None has more than x.
    pub(crate) const fn new(bits: [u32; 3]) -> Self {
        Cartesian(Snorm::with_fields(OneWord { bits }, bits))
    }

    pub(crate) const fn points_per_octant(self) -> usize {
        let [x, y, z] = self.0.bits;
        1 << (x + y + z - 3)
    }
}

impl Snorm16Xyz {
    pub(crate) const fn new() -> Self {
        Cartesian(Snorm::with_fields(ThreeWords, [16; 3]))
    }
}

impl<F: Fields> Grid for Snorm<F> {
    type Shape = F::Shape;
    const DISTINCT: bool = F::DISTINCT;

    #[inline(always)]
    fn steps(self) -> [f32; 3] {
        self.steps
    }
    #[inline(always)]
    fn step(self) -> [f32; 3] {
        self.step
    }
    #[inline(always)]
    fn lengths(self) -> i32 {
        snorm_max(self.bits[0])
    }
    #[inline(always)]
    fn uneven(self) -> Option<Uneven> {
        self.uneven
    }
    #[inline(always)]
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> <F::Shape as CodeShape>::In<V> {
        self.fields.pack::<V>(point)
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: <F::Shape as CodeShape>::In<V>) -> Vec3<V::Int> {
        let fields = self.fields.unpack::<V>(code);
        Vec3::from(map3!([0, 1, 2], |i: usize| {
            let bits = self.bits[i];
            fields[i].sign_extend(bits).max(-snorm_max(bits))
        }))
    }
}

/// Biased unorm, (c + 1) / 2: the odd numbers from -(2^BITS - 1). No component is zero.
#[derive(Clone, Copy)]
pub(crate) struct Unorm<F> {
    fields: F,
    bits: u32,
}

impl UnormXyz {
    pub(crate) const fn new() -> Self {
        Cartesian(Unorm { fields: OneWord { bits: [8; 3] }, bits: 8 })
    }
}

impl Unorm16Xyz {
    pub(crate) const fn new() -> Self {
        Cartesian(Unorm { fields: ThreeWords, bits: 16 })
    }
}

impl<F: Fields> Grid for Unorm<F> {
    type Shape = F::Shape;
    const DISTINCT: bool = F::DISTINCT;
    const PITCH: i32 = 2;

    #[inline(always)]
    fn steps(self) -> [f32; 3] {
        [unorm_max(self.bits) as f32; 3]
    }
    #[inline(always)]
    fn step(self) -> [f32; 3] {
        [1.0 / unorm_max(self.bits) as f32; 3]
    }
    #[inline(always)]
    fn lengths(self) -> i32 {
        (unorm_max(self.bits) + 1) / 2
    }
    #[inline(always)]
    fn length<V: Simd>(self, n: V, step: V) -> V {
        (n + n - 1.0) * step
    }
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V, steps: f32) -> V::Int {
        let half = steps * 0.5;
        (x * half + half).round_int().shl(1) - unorm_max(self.bits)
    }
    #[inline(always)]
    fn off<V: Simd>(self, x: V, steps: V, step: V) -> V {
        let places = (x * steps - 1.0) * 0.5;
        (places - places.round()).abs() * (step + step)
    }
    #[inline(always)]
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> <F::Shape as CodeShape>::In<V> {
        let max = unorm_max(self.bits);
        self.fields.pack::<V>(map_vec!(point, |i| (i + max).shr_arithmetic(1)))
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: <F::Shape as CodeShape>::In<V>) -> Vec3<V::Int> {
        let fields = self.fields.unpack::<V>(code);
        map_vec!(fields, |index| index.low_bits(self.bits).shl(1) - unorm_max(self.bits))
    }
}

/// IEEE halves. The largest component of a canonical code is from 0.5 to 1.
#[derive(Clone, Copy)]
pub(crate) struct Halves;

impl HalfXyz {
    pub(crate) const fn new() -> Self {
        Cartesian(Halves)
    }
}

impl Grid for Halves {
    type Shape = Words3;
    const DISTINCT: bool = false;

    #[inline(always)]
    fn steps(self) -> [f32; 3] {
        [1.0; 3]
    }
    #[inline(always)]
    fn step(self) -> [f32; 3] {
        [1.0; 3]
    }
    #[inline(always)]
    fn lengths(self) -> i32 {
        1025
    }
    #[inline(always)]
    fn length<V: Simd>(self, n: V, _: V) -> V {
        (n + 1023.0) * (1.0 / 2048.0)
    }
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V, _: f32) -> V::Int {
        half::nearest(x)
    }
    #[inline(always)]
    fn value<V: Simd>(self, i: V::Int, _: f32) -> V {
        half::value(i)
    }
    #[inline(always)]
    fn off<V: Simd>(self, x: V, _: V, _: V) -> V {
        (half::value::<V>(half::nearest(x)) - x).abs()
    }
    #[inline(always)]
    fn half_gap<V: Simd>(self, x: V, _: f32) -> V {
        x.abs() * (0.99 / 4096.0)
    }
    #[inline(always)]
    fn representative<V: Simd>(self, point: Vec3<V::Int>) -> Vec3<V::Int> {
        // Each value is an odd integer times a power of two, or zero.
        let values = map_vec!(point, |i| half::value::<V>(i));
        let odd = map_vec!(point, |i| {
            let mantissa = half::mantissa::<V>(i);
            V::from_int(mantissa) / V::from_int(mantissa & -mantissa).max(1.0)
        });
        let divisor = gcd(odd);
        let primitive = map_vec!(values, |c| c / divisor);
        // So many times, and powers of two, keep all mantissas below 2^11.
        let room = (divisor * 2047.5 / odd.max_component()).floor();
        let times = inv_sqrt(primitive.length_squared());
        // The least power of two for which that is enough, but none that would cut below 2^-24.
        let over = times / room;
        let power = V::from_bits((over.to_bits() + 0x7F_FFFF) & 0x7F80_0000);
        let units = Vec3::from(map3!([0, 1, 2], |i: usize| {
            let unit = values[i].abs() / odd[i].max(1.0);
            V::select(odd[i].le(0.0), 1.0, unit)
        }));
        let finest = V::splat(1.0 / 16_777_216.0) / units.min_component();
        let power = power.max(finest);
        // Either a multiple of that power, or the greatest multiple of the one below.
        let at_power = (times / power).round() * power;
        let below = room * power * 0.5;
        let use_below = (times - below).abs().lt((at_power - times).abs()) & finest.lt(power);
        let power = V::select(use_below, power * 0.5, power);
        let times = V::select(use_below, room, (times / power).round());
        // The largest component is 1 at most.
        let largest = map_vec!(primitive, |c| (c * power).abs()).max_component();
        let too_long = V::splat(1.0).lt(largest * times);
        let times = V::select(too_long, times - 1.0, times);
        let times = V::select(times.lt(0.5), 0.5, times);
        map_vec!(primitive, |c| half::nearest(c * power * times))
    }
    #[inline(always)]
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> [V::Int; 3] {
        map3!(point.to_array(), |i| half::to_bits::<V>(i))
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: [V::Int; 3]) -> Vec3<V::Int> {
        Vec3::from(map3!(code, |bits| half::from_bits::<V>(bits, half::GREATEST)))
    }
}

impl<G: Grid> Cartesian<G> {
    #[inline(always)]
    fn nearest<V: Simd>(self, v: Vec3<V>) -> Vec3<V::Int> {
        let Cartesian(grid) = self;
        let [x, y, z] = grid.steps();
        Vec3::new(grid.nearest(v.x, x), grid.nearest(v.y, y), grid.nearest(v.z, z))
    }

    #[inline(always)]
    fn values<V: Simd>(self, point: Vec3<V::Int>) -> Vec3<V> {
        let Cartesian(grid) = self;
        let [x, y, z] = grid.step();
        Vec3::new(grid.value(point.x, x), grid.value(point.y, y), grid.value(point.z, z))
    }

    /// The point of a code; (0, 0, 0) is +Z.
    #[inline(always)]
    fn point<V: Simd>(self, code: Code<Self, V>) -> Vec3<V::Int> {
        let point = self.0.unpack::<V>(code);
        let is_zero = (point.x | point.y | point.z).eq(0);
        let pole = self.0.nearest(V::splat(1.0), self.0.steps()[2]);
        Vec3 { z: V::Int::select(is_zero, pole, point.z), ..point }
    }

    #[inline(always)]
    fn unit<V: Simd>(values: Vec3<V>) -> Vec3<V> {
        let is_zero = values.length_squared().le(0.0);
        Vec3 { z: V::select(is_zero, 1.0, values.z), ..values }.normalize()
    }
}

/// [`Grid::representative`] where the values are integers over the steps.
#[inline(always)]
fn integer_representative<V: Simd, G: Grid>(grid: G, point: Vec3<V::Int>) -> Vec3<V::Int> {
    let divisor = gcd(map_vec!(point, |i| V::from_int(i.abs())));
    let primitive = map_vec!(point, |i| V::from_int(i) / divisor);
    let [x, y, z] = grid.step();
    let values = Vec3::new(primitive.x * x, primitive.y * y, primitive.z * z);
    // As many times as bring it nearest to 1, but not beyond the grid.
    let times = inv_sqrt(values.length_squared());
    let steps = grid.steps();
    let room = Vec3::from(map3!([0, 1, 2], |i: usize| {
        V::splat(steps[i] + 0.5) / primitive[i].abs().max(0.01)
    }));
    let room = room.min_component();
    let times = if let Some(uneven) = grid.uneven() {
        // Too close for f32 between twice and three times (244, 328, 9) of snorm11-11-10, for one.
        let less = times.floor();
        let half_more = (less + less).round_int() + 1;
        let more = uneven.is_below_two::<V>(primitive.round_int(), half_more);
        V::select(more, less + 1.0, less).min(room.floor())
    } else if G::PITCH == 1 {
        times.round().min(room.floor())
    } else {
        // Odd points have only odd multiples.
        let pairs = ((times - 1.0) * 0.5).round().min(((room - 1.0) * 0.5).floor());
        pairs + pairs + 1.0
    };
    (primitive * times).round_int()
}

/// Steps of which z has fewer than x and y.
#[derive(Clone, Copy)]
pub(crate) struct Uneven {
    /// Steps of z, squared.
    least: i32,
    /// (steps of x / steps of z)^2 = whole + rest / least.
    whole: i32,
    rest: i32,
    /// 4 (steps of x)^2.
    limit: i32,
    /// A bound on what is added for `rest`, times -1 / least.
    least_over: i32,
}

impl Uneven {
    const fn new(bits: [u32; 3]) -> Self {
        let (most, least) = (snorm_max(bits[0]) as i64, snorm_max(bits[2]) as i64);
        let (most, least) = (most * most, least * least);
        let (whole, rest) = (most / least, most % least);
        Uneven {
            least: least as i32,
            whole: whole as i32,
            rest: rest as i32,
            limit: (4 * most) as i32,
            least_over: -(rest * (4 * most / whole) / least + 1) as i32,
        }
    }

    /// Whether `times` times a point is shorter than 2, exactly.
    #[inline(always)]
    fn is_below_two<V: Simd>(self, point: Vec3<V::Int>, times: V::Int) -> V::Mask {
        // In steps of x: (x^2 + y^2 + whole z^2 + rest z^2 / least) times^2 < limit.
        let square = times * times;
        let Vec3 { x, y, z } = map_vec!(point, |i| i * i * square);
        // Below zero it decides, except for the rest, which is added to no more than that can outweigh.
        let over = x + y + z * self.whole - self.limit;
        let over_with_rest = over.max(self.least_over) * self.least + z * self.rest;
        over.lt(0) & over_with_rest.lt(0)
    }
}

/// The greatest common divisor of three integers from 0 to 2^16, not all of them zero.
#[inline(always)]
fn gcd<V: Simd>(numbers: Vec3<V>) -> V {
    /// What is left of x, or what it lacks of one more divisor.
    #[inline(always)]
    fn rest<V: Simd>(x: V, by: V, per: V) -> V {
        (x - (x * per).round() * by).abs()
    }
    let zero = V::splat(0.0);
    let Vec3 { x: mut a, y: mut b, z: mut c } = numbers;
    loop {
        let (least, most) = (b.min(c), b.max(c));
        if !zero.lt(most).any() {
            return a;
        }
        // By the least that is not zero.
        let by = V::select(zero.lt(least), least, V::select(zero.lt(most), most, a));
        let per = V::splat(1.0) / by;
        (a, b, c) = (by, rest(a, by, per), rest(most, by, per));
    }
}

/// 1 in 0.32 fixed point.
const WRAP: f32 = 4_294_967_296.0;

/// x in units of 2^-32, without what is before the point. For |x| < 2^10.
#[inline(always)]
fn wrapping_fraction<V: Simd>(x: V) -> V::Int {
    let high = (x * 2048.0).round();
    let low = (x - high * (1.0 / 2048.0)) * WRAP;
    high.round_int().shl(21) + low.round_int()
}

/// An axis, in each lane: the target's slope along it, its steps, and one step.
#[derive(Clone, Copy)]
struct Side<V> {
    slope: V,
    steps: V,
    step: V,
}

impl<V: Simd> Side<V> {
    #[inline(always)]
    fn select(mask: V::Mask, yes: Self, no: Self) -> Self {
        Side {
            slope: V::select(mask, yes.slope, no.slope),
            steps: V::select(mask, yes.steps, no.steps),
            step: V::select(mask, yes.step, no.step),
        }
    }
}

/// One target, seen along its largest component.
struct Search<V: Simd, G> {
    grid: G,
    target: Vec3<V>,
    /// The components over the largest one's magnitude.
    slope: Vec3<V>,
    /// Their sum of squares.
    stretch: V,
    /// The steps on the axis of the largest component, and one step.
    steps: V,
    step: V,
    /// Whether that is x, or y.
    is_x: V::Mask,
    is_y: V::Mask,
    /// The other two axes.
    p: Side<V>,
    q: Side<V>,
}

/// The best corner so far: the square and the length that the tangent is made of, and the place.
#[derive(Clone, Copy)]
struct Corner<V> {
    across: V,
    reach: V,
    length: V,
    x: V,
    y: V,
}

impl<V: Simd, G: Grid> Search<V, G> {
    #[inline(always)]
    fn new(grid: G, v: Vec3<V>) -> Self {
        // Bring the length between sqrt(1/2) and sqrt(2) by a power of two.
        let exponent = v.length_squared().to_bits().shr_arithmetic(23) - 126;
        let scale = V::from_bits((V::Int::splat(127) - exponent.shr_arithmetic(1)).shl(23));
        let v = v * scale;
        // A decoded vector is not divided again, so that its own code is at distance zero.
        let is_decoded = (v.length_squared() - 1.0).abs().lt(6e-7);
        let target = Vec3::select(is_decoded, v, v.normalize());
        let magnitudes = target.abs();
        let largest = magnitudes.max_component();
        let (is_x, is_y) = (largest.le(magnitudes.x), largest.le(magnitudes.y));
        let slope = map_vec!(target, |c| c / largest);
        let (steps, step) = (grid.steps(), grid.step());
        let [on_x, on_y, on_z] = map3!([0, 1, 2], |i: usize| Side {
            slope: slope[i],
            steps: V::splat(steps[i]),
            step: V::splat(step[i]),
        });
        let main = Side::select(is_x, on_x, Side::select(is_y, on_y, on_z));
        Search {
            grid,
            target,
            slope,
            stretch: slope.length_squared(),
            steps: main.steps,
            step: main.step,
            is_x,
            is_y,
            p: Side::select(is_x, on_y, on_x),
            q: Side::select(is_x | is_y, on_z, on_y),
        }
    }

    /// A point can only be nearer than the square root of `distance` if the sine of its angle is below
    /// that, up to rounding in f32. Returns the square of that sine and, over the length on the largest
    /// axis, how far off the point can be on each of the others.
    #[inline(always)]
    fn bounds(&self, distance: V) -> [V; 2] {
        let sine = sqrt(distance) * 1.01 + 6e-7;
        // Stretch times the sine, and a little for the length of the offset itself.
        let off = self.stretch * sine * 1.3;
        [sine * sine, V::select(sine.lt(0.1), off, f32::INFINITY)]
    }

    /// The nearest point of a grid of whole steps, or a multiple of it.
    #[inline(always)]
    fn nearest_whole(&self) -> Vec3<V::Int> {
        let (point, sure) = self.nearest_corner::<false>();
        if !(!sure).any() {
            return point;
        }
        let (nearest, _) = self.nearest_corner::<true>();
        Vec3::select_int(sure, point, nearest)
    }

    /// At each length the target's ray passes a cell of the grid. Returns the nearest of the corners of
    /// all cells, or unless `ALL` of those that rounding gives, and whether these are enough.
    #[inline(always)]
    fn nearest_corner<const ALL: bool>(&self) -> (Vec3<V::Int>, V::Mask) {
        let Search { grid, p, q, .. } = *self;
        let is_even = grid.uneven().is_none();
        let one = V::splat(1.0);
        let lengths = grid.lengths() + 1 - grid.steps()[0] as i32 / G::SHORTER;
        let first = (self.steps * (1.0 / G::SHORTER as f32)).floor();
        // How far the ray is from the rounded corner: fractions of 2^32 pitches, which wrap.
        let rises = [p.slope * (p.steps / self.steps), q.slope * (q.steps / self.steps)];
        let [mut a, mut b] = map2!(rises, |rise| {
            let from = wrapping_fraction(rise) * first.round_int();
            if G::PITCH == 1 { from } else { from - wrapping_fraction((rise + one) * 0.5) }
        });
        let [rise_a, rise_b] = map2!(rises, |rise| wrapping_fraction(rise));
        // The square of the tangent of the angle between point and target, up to a factor, is
        // (x (x + skew y) + other y^2) / (length - (x lean_x + y lean_y))^2.
        let unit = G::PITCH as f32 / WRAP;
        let ratio = p.steps / q.steps;
        let scale = q.slope * q.slope + one;
        let pq = p.slope * q.slope;
        let skew = -(pq + pq) / scale * ratio;
        let other = (p.slope * p.slope + one) / scale * (ratio * ratio);
        let lean = self.steps * unit / self.stretch;
        let (lean_x, lean_y) = (lean * p.slope / p.steps, lean * q.slope / q.steps);
        let zero = V::splat(0.0);
        let mut best =
            Corner { across: V::splat(f32::MAX), reach: one, length: one, x: zero, y: zero };
        let mut n = first;
        for _ in 0..lengths {
            let length = grid.length(n, one);
            let (x, y) = (V::from_int(a), V::from_int(b));
            let far_x = x - V::splat(WRAP).negate_where_negative(x);
            let far_y = y - V::splat(WRAP).negate_where_negative(y);
            let corners = [(x, y), (far_x, y), (x, far_y), (far_x, far_y)];
            for &(x, y) in if ALL { &corners[..] } else { &corners[..1] } {
                let across = x * (x + skew * y) + other * y * y;
                let reach = length - (x * lean_x + y * lean_y);
                let reach = reach * reach;
                let mut nearer = (across * best.reach).lt(best.across * reach);
                if !is_even {
                    nearer = nearer & length.le(self.steps);
                }
                best = Corner {
                    across: V::select(nearer, across, best.across),
                    reach: V::select(nearer, reach, best.reach),
                    length: V::select(nearer, length, best.length),
                    x: V::select(nearer, x, best.x),
                    y: V::select(nearer, y, best.y),
                };
            }
            (n, a, b) = (n + one, a + rise_a, b + rise_b);
        }
        let at = best.length * self.step;
        let ideal = self.slope * at;
        let (mut x, mut y) = (zero, zero);
        if ALL {
            (x, y) = (best.x * unit / p.steps, best.y * unit / q.steps);
        }
        let off = Vec3::new(
            V::select(self.is_x, zero, x),
            V::select(self.is_x, x, V::select(self.is_y, zero, y)),
            V::select(self.is_x | self.is_y, y, zero),
        );
        let point = Cartesian(grid).nearest(ideal - off);
        (point, self.surely_rounded(best.across / best.reach))
    }

    /// Whether the nearest corner is a rounded one, if the tangent of the nearest of those is, squared and
    /// in the units of [`nearest_corner`](Self::nearest_corner), `square`.
    #[inline(always)]
    fn surely_rounded(&self, square: V) -> V::Mask {
        let Search { grid, p, q, .. } = *self;
        let [pp, qq] = [p.slope * p.slope, q.slope * q.slope];
        let unit = G::PITCH as f32 / WRAP;
        let tangent = self.steps * unit / (p.steps * self.stretch);
        let tangent_squared = tangent * tangent * (qq + 1.0) * square;
        // What is no rounded corner is at least half a pitch off on one axis.
        let most = grid.steps()[0];
        let half = 0.23 * (G::PITCH * G::PITCH) as f32 / (most * most);
        (tangent_squared * self.stretch * (pp.max(qq) + 1.0)).lt(half)
    }

    /// The nearest point of a grid finer than f32; of those that decode alike, the one whose length is
    /// nearest to 1.
    #[inline(always)]
    fn nearest(&self) -> Vec3<V::Int> {
        let Search { grid, p, q, .. } = *self;
        let mut found = FoundPoint {
            point: Vec3::from([V::Int::splat(0); 3]),
            distance: V::splat(4.0),
            off_unit: V::splat(4.0),
            bounds: self.bounds(V::splat(4.0)),
        };
        let per_stretch = V::splat(1.0) / self.stretch;
        let first = (grid.steps()[0] as i32 / G::SHORTER).max(1);
        for n in (first..=grid.lengths()).rev() {
            let length = grid.length(V::splat(n as f32), self.step);
            let a = grid.off(p.slope * length, p.steps, p.step);
            let b = grid.off(q.slope * length, q.steps, q.step);
            let reach = found.bounds[1] * length;
            if !a.max(b).le(reach).any() {
                continue;
            }
            let ideal = self.slope * length;
            // Near the diagonals and in a coarse grid the rounded corner of the cell is not always
            // the nearest: components may go the other way, if half a gap is near enough.
            let [x, y, z] = grid.step();
            let gap = Vec3::new(
                grid.half_gap(ideal.x, x),
                grid.half_gap(ideal.y, y),
                grid.half_gap(ideal.z, z),
            );
            let rounded = Cartesian(grid).nearest(ideal);
            let mut candidates = [rounded; 4];
            let mut count = 1;
            if gap.min_component().le(reach).any() {
                // The other corners: the largest component stays as it is.
                let values = Cartesian(grid).values::<V>(rounded);
                let other = Vec3::from(map3!([0, 1, 2], |i: usize| {
                    let up = V::Int::select(values[i].lt(ideal[i]), G::PITCH, 0);
                    let down = V::Int::select(ideal[i].lt(values[i]), G::PITCH, 0);
                    rounded[i] + up - down
                }));
                for kept in 0..3 {
                    let mut point = other;
                    point[kept] = rounded[kept];
                    candidates[kept + 1] = point;
                }
                count = 4;
            }
            for point in candidates.into_iter().take(count) {
                self.consider(&mut found, point, ideal, length, per_stretch);
            }
        }
        found.point
    }

    /// Considers a point beside the ray's `ideal` one.
    #[inline(always)]
    fn consider(
        &self,
        found: &mut FoundPoint<V>,
        point: Vec3<V::Int>,
        ideal: Vec3<V>,
        length: V,
        per_stretch: V,
    ) {
        let cartesian = Cartesian(self.grid);
        let values = cartesian.values::<V>(point);
        let offset = values - ideal;
        let along = offset.dot(self.slope);
        let across = offset.length_squared() - along * along * per_stretch;
        let near = across.le(values.length_squared() * found.bounds[0]) & length.le(1.0);
        if !near.any() {
            return;
        }
        // As f32 does not tell neighbours apart, only canonical points compete.
        let point = self.grid.representative::<V>(point);
        let values = cartesian.values::<V>(point);
        let there = Cartesian::<G>::unit(values).distance_squared(self.target);
        let off_unit = (sqrt(values.length_squared()) - 1.0).abs();
        let alike =
            found.distance.le(there) & there.le(found.distance) & off_unit.lt(found.off_unit);
        let better = near & (there.lt(found.distance) | alike);
        found.distance = V::select(better, there, found.distance);
        found.off_unit = V::select(better, off_unit, found.off_unit);
        found.point = Vec3::select_int(better, point, found.point);
        found.bounds = self.bounds(found.distance);
    }
}

/// The nearest point so far of a grid finer than f32.
struct FoundPoint<V: Simd> {
    point: Vec3<V::Int>,
    distance: V,
    /// How far its length is from 1.
    off_unit: V,
    /// See [`Search::bounds`].
    bounds: [V; 2],
}

impl<G: Grid> Formula for Cartesian<G> {
    type Shape = G::Shape;
    const PRECISE_ON_ALL_LANES: bool = true;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> Code<Self, V> {
        self.0.pack::<V>(self.nearest(v.normalize()))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> Code<Self, V> {
        V::with_target_features(
            #[inline(always)]
            || {
                let Cartesian(grid) = self;
                let search = Search::new(grid, v);
                let point = if G::DISTINCT {
                    grid.representative::<V>(search.nearest_whole())
                } else {
                    search.nearest()
                };
                grid.pack::<V>(point)
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: Code<Self, V>) -> Vec3<V> {
        Self::unit(self.values::<V>(self.0.unpack::<V>(code)))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: Code<Self, V>, flips: [bool; 3]) -> Code<Self, V> {
        if !G::DISTINCT {
            return self.mirror_decoded::<V>(code, flips);
        }
        let point = mirror_point(self.point::<V>(code), flips);
        self.0.pack::<V>(self.0.representative::<V>(point))
    }
}

impl Symmetric for SnormXyz {
    #[inline(always)]
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>) {
        let [x, y, _] = self.0.bits;
        let point = self.0.unpack::<V>(code);
        let Vec3 { x: i, y: j, z: k } = point.abs_int();
        (i | j.shl(x - 1) | k.shl(x + y - 2), point.is_negative_int())
    }
}

/// Crytek's best-fit normals: the codes of unorm8x3, its fast encoder reading the length from a
/// table.
///
/// With a >= b >= c the magnitudes, the table over (b / a, c / b) has the length, (2 k - 1) / 255
/// on the largest component, with which rounding points closest to the middle of its texel. 512 x
/// 512 bytes.
#[derive(Clone, Copy)]
pub(crate) struct BestFit;

static BEST_FIT: &[u8; 512 * 512] = include_bytes!(concat!(env!("OUT_DIR"), "/best_fit.bin"));

impl BestFit {
    const UNORM8: UnormXyz = UnormXyz::new();

    pub(crate) const fn new() -> Self {
        BestFit
    }
}

impl Formula for BestFit {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        /// From 0 to 1 to the texel.
        #[inline(always)]
        fn texel<V: Simd>(t: V) -> V::Int {
            (t * 512.0).floor().round_int().min(511)
        }
        let Vec3 { x, y, z } = v.abs();
        let (a, rest) = (x.max(y), x.min(y));
        let (a, b, c) = (a.max(z), a.min(z).max(rest), rest.min(z));
        let (u, w) = (texel(b / a), texel(c / b.max(1e-30)));
        let largest = V::from_int(V::gather(BEST_FIT, w.shl(9) + u));
        let scale = largest * (1.0 / 255.0) / a;
        let point = Self::UNORM8.nearest(v * scale);
        Self::UNORM8.0.pack::<V>(Self::UNORM8.0.representative::<V>(point))
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        Self::UNORM8.encode_precise(v)
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        Self::UNORM8.decode(code)
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        Self::UNORM8.mirror::<V>(code, flips)
    }
}

/// Three `f32`, bit for bit.
#[derive(Clone, Copy)]
pub(crate) struct Floats;

impl Floats {
    pub(crate) const fn new() -> Self {
        Floats
    }
}

impl Formula for Floats {
    type Shape = Words3;

    #[inline(always)]
    fn prepare<V: Simd>(self, v: Vec3<V>) -> Vec3<V> {
        v
    }
    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> [V::Int; 3] {
        map3!(v.to_array(), |c| c.to_bits())
    }
    #[inline(always)]
    fn decode<V: Simd>(self, code: [V::Int; 3]) -> Vec3<V> {
        Vec3::from(map3!(code, |bits| V::from_bits(bits)))
    }
    #[inline(always)]
    fn mirror<V: Simd>(self, code: [V::Int; 3], flips: [bool; 3]) -> [V::Int; 3] {
        map3!([0, 1, 2], |i: usize| code[i] ^ sign_bit(flips[i]))
    }
}

kernels!(
    SnormXyz: Words;
    Snorm16Xyz: [u8; 6];
    UnormXyz: [u8; 3];
    Unorm16Xyz: [u8; 6];
    HalfXyz: [u8; 6];
    BestFit: [u8; 3], BestFit::UNORM8;
    Floats: [u8; 12];
);
