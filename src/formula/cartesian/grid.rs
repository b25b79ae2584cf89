//! The values that each component may have.

use crate::batch::storage::{CodeShape, Word, Words3};
use crate::formula::support::bits::{snorm_max, unorm_max};
use crate::formula::support::divisor::gcd;
use crate::formula::support::half;
use crate::simd::math::inv_sqrt;
use crate::simd::{Simd, SimdInt, Vec3, map_vec, map3};

/// The values that each component may have, and where they are in a code.
pub(crate) trait Grid: Copy + Send + Sync + 'static {
    type Shape: CodeShape;
    /// Whether f32 tells all directions of the grid apart.
    const DISTINCT: bool;

    /// From one grid point to the next, in steps.
    fn pitch(self) -> i32;
    /// Points whose length is below steps / shorter need no search, as a multiple is a point: of whole
    /// steps twice as long, of odd ones three times.
    #[inline(always)]
    fn shorter(self) -> i32 {
        self.pitch() * (self.pitch() + 1)
    }
    /// Steps from 0 to 1 on each axis.
    fn steps(self) -> [f32; 3];
    /// One step on each axis.
    fn step(self) -> [f32; 3];
    /// Number of values that the search for the largest component tries.
    fn lengths(self) -> i32;
    /// Whether the grid is as fine in z as in x.
    fn is_even(self) -> bool;

    /// The `n`th value for the largest component, `n` from 1 to [`lengths`](Grid::lengths).
    fn length<V: Simd>(self, n: V, step: V) -> V;
    /// Nearest grid point, ties to even.
    fn nearest<V: Simd>(self, x: V, steps: f32) -> V::Int;
    fn value<V: Simd>(self, i: V::Int, step: f32) -> V;
    /// Distance of `x` from the nearest value, up to rounding in f32.
    fn off<V: Simd>(self, x: V, steps: V, step: V) -> V;
    /// At most half the distance between the two values around `x`.
    fn half_gap<V: Simd>(self, x: V, step: f32) -> V;
    /// Of the points in the direction of `point`, which is not zero, the one whose length is
    /// nearest to 1.
    fn representative<V: Simd>(self, point: Vec3<V::Int>) -> Vec3<V::Int>;
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> <Self::Shape as CodeShape>::In<V>;
    fn unpack<V: Simd>(self, code: <Self::Shape as CodeShape>::In<V>) -> Vec3<V::Int>;
}

/// Integers over a number of steps: all of them, snorm, or the odd ones, scaled and biased unorm.
#[derive(Clone, Copy)]
pub(crate) struct Steps {
    bits: [u32; 3],
    is_odd: bool,
    steps: [f32; 3],
    step: [f32; 3],
    lengths: i32,
    uneven: Option<Uneven>,
    /// Bits of a code that are stored inverted.
    flip: i32,
}

impl Steps {
    /// Snorm with a number of bits for x, y and z. None has more than x.
    #[inline]
    pub(super) const fn snorm(bits: [u32; 3]) -> Self {
        let steps =
            [snorm_max(bits[0]) as f32, snorm_max(bits[1]) as f32, snorm_max(bits[2]) as f32];
        Steps {
            bits,
            is_odd: false,
            steps,
            step: [1.0 / steps[0], 1.0 / steps[1], 1.0 / steps[2]],
            lengths: snorm_max(bits[0]),
            uneven: if bits[2] < bits[0] { Some(Uneven::new(bits)) } else { None },
            flip: 0,
        }
    }

    /// Snorm in offset binary, (c - 2^(bits - 1)) / M: two's complement with its sign bits inverted.
    pub(super) const fn biased(bits: u32) -> Self {
        let sign = 1 << (bits - 1);
        Steps { flip: sign | sign << bits | sign << (2 * bits), ..Steps::snorm([bits; 3]) }
    }

    /// Biased unorm, (c + 1) / 2: the odd numbers from -(2^bits - 1). No component is zero.
    pub(super) const fn unorm(bits: u32) -> Self {
        let steps = unorm_max(bits) as f32;
        Steps {
            bits: [bits; 3],
            is_odd: true,
            steps: [steps; 3],
            step: [1.0 / steps; 3],
            lengths: (unorm_max(bits) + 1) / 2,
            uneven: None,
            flip: 0,
        }
    }

    pub(super) const fn bits(self) -> [u32; 3] {
        self.bits
    }

    /// What is stored of a point. Bits above the field's may be set.
    #[inline(always)]
    fn fields_of<V: Simd>(self, point: Vec3<V::Int>) -> Vec3<V::Int> {
        if self.is_odd {
            let max = unorm_max(self.bits[0]);
            map_vec!(point, |i| (i + max).shr_arithmetic(1))
        } else {
            point
        }
    }

    /// The point of what is stored, with anything above the fields' bits.
    #[inline(always)]
    fn point_of<V: Simd>(self, fields: Vec3<V::Int>) -> Vec3<V::Int> {
        if self.is_odd {
            let bits = self.bits[0];
            map_vec!(fields, |index| index.low_bits(bits).shl(1) - unorm_max(bits))
        } else {
            Vec3::from(map3!([0, 1, 2], |i: usize| {
                let bits = self.bits[i];
                fields[i].sign_extend(bits).max(-snorm_max(bits))
            }))
        }
    }
}

impl Grid for Steps {
    type Shape = Word;
    const DISTINCT: bool = true;

    #[inline(always)]
    fn pitch(self) -> i32 {
        1 + i32::from(self.is_odd)
    }
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
        self.lengths
    }
    #[inline(always)]
    fn is_even(self) -> bool {
        self.uneven.is_none()
    }
    #[inline(always)]
    fn length<V: Simd>(self, n: V, step: V) -> V {
        if self.is_odd { (n + n - 1.0) * step } else { n * step }
    }
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V, steps: f32) -> V::Int {
        if self.is_odd {
            let half = steps * 0.5;
            (x * half + half).round_int().shl(1) - unorm_max(self.bits[0])
        } else {
            (x * steps).round_int()
        }
    }
    #[inline(always)]
    fn value<V: Simd>(self, i: V::Int, step: f32) -> V {
        V::from_int(i) * step
    }
    #[inline(always)]
    fn off<V: Simd>(self, x: V, steps: V, step: V) -> V {
        if self.is_odd {
            let places = (x * steps - 1.0) * 0.5;
            (places - places.round()).abs() * (step + step)
        } else {
            let places = x * steps;
            (places - places.round()).abs() * step
        }
    }
    #[inline(always)]
    fn half_gap<V: Simd>(self, _: V, step: f32) -> V {
        V::splat(step * (0.49 * self.pitch() as f32))
    }
    #[inline(always)]
    fn representative<V: Simd>(self, point: Vec3<V::Int>) -> Vec3<V::Int> {
        let divisor = gcd(map_vec!(point, |i| V::from_int(i.abs())));
        let primitive = map_vec!(point, |i| V::from_int(i) / divisor);
        let [x, y, z] = self.step;
        let values = Vec3::new(primitive.x * x, primitive.y * y, primitive.z * z);
        // As many times as bring it nearest to 1, but not beyond the grid.
        let times = inv_sqrt(values.length_squared());
        let steps = self.steps;
        let room = Vec3::from(map3!([0, 1, 2], |i: usize| {
            V::splat(steps[i] + 0.5) / primitive[i].abs().max(0.01)
        }));
        let room = room.min_component();
        let times = if let Some(uneven) = self.uneven {
            // Too close for f32 between twice and three times (244, 328, 9) of snorm11-11-10, for one.
            let less = times.floor();
            let half_more = (less + less).round_int() + 1;
            let more = uneven.is_below_two::<V>(primitive.round_int(), half_more);
            V::select(more, less + 1.0, less).min(room.floor())
        } else if !self.is_odd {
            times.round().min(room.floor())
        } else {
            // Odd points have only odd multiples.
            let pairs = ((times - 1.0) * 0.5).round().min(((room - 1.0) * 0.5).floor());
            pairs + pairs + 1.0
        };
        (primitive * times).round_int()
    }
    #[inline(always)]
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> V::Int {
        let [x, y, z] = self.bits;
        let fields = self.fields_of::<V>(point);
        let code =
            fields.x.low_bits(x) | fields.y.low_bits(y).shl(x) | fields.z.low_bits(z).shl(x + y);
        code ^ self.flip
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: V::Int) -> Vec3<V::Int> {
        let [x, y, _] = self.bits;
        let code = code ^ self.flip;
        self.point_of::<V>(Vec3::new(code, code.shr_logical(x), code.shr_logical(x + y)))
    }
}

/// Up to 16 bits each, in words of their own.
#[derive(Clone, Copy)]
pub(crate) enum Fine {
    Steps(Steps),
    /// IEEE halves. The largest component of a canonical code is from 0.5 to 1.
    Halves,
}

impl Grid for Fine {
    type Shape = Words3;
    const DISTINCT: bool = false;

    #[inline(always)]
    fn pitch(self) -> i32 {
        match self {
            Fine::Steps(steps) => steps.pitch(),
            Fine::Halves => 1,
        }
    }
    #[inline(always)]
    fn steps(self) -> [f32; 3] {
        match self {
            Fine::Steps(steps) => steps.steps(),
            Fine::Halves => [1.0; 3],
        }
    }
    #[inline(always)]
    fn step(self) -> [f32; 3] {
        match self {
            Fine::Steps(steps) => steps.step(),
            Fine::Halves => [1.0; 3],
        }
    }
    #[inline(always)]
    fn lengths(self) -> i32 {
        match self {
            Fine::Steps(steps) => steps.lengths(),
            Fine::Halves => 1025,
        }
    }
    #[inline(always)]
    fn is_even(self) -> bool {
        true
    }
    #[inline(always)]
    fn length<V: Simd>(self, n: V, step: V) -> V {
        match self {
            Fine::Steps(steps) => steps.length(n, step),
            Fine::Halves => (n + 1023.0) * (1.0 / 2048.0),
        }
    }
    #[inline(always)]
    fn nearest<V: Simd>(self, x: V, steps_to_one: f32) -> V::Int {
        match self {
            Fine::Steps(steps) => steps.nearest(x, steps_to_one),
            Fine::Halves => half::nearest(x),
        }
    }
    #[inline(always)]
    fn value<V: Simd>(self, i: V::Int, step: f32) -> V {
        match self {
            Fine::Steps(steps) => steps.value(i, step),
            Fine::Halves => half::value(i),
        }
    }
    #[inline(always)]
    fn off<V: Simd>(self, x: V, steps_to_one: V, step: V) -> V {
        match self {
            Fine::Steps(steps) => steps.off(x, steps_to_one, step),
            Fine::Halves => (half::value::<V>(half::nearest(x)) - x).abs(),
        }
    }
    #[inline(always)]
    fn half_gap<V: Simd>(self, x: V, step: f32) -> V {
        match self {
            Fine::Steps(steps) => steps.half_gap(x, step),
            Fine::Halves => x.abs() * (0.99 / 4096.0),
        }
    }
    #[inline(always)]
    fn representative<V: Simd>(self, point: Vec3<V::Int>) -> Vec3<V::Int> {
        match self {
            Fine::Steps(steps) => steps.representative::<V>(point),
            Fine::Halves => representative_half::<V>(point),
        }
    }
    #[inline(always)]
    fn pack<V: Simd>(self, point: Vec3<V::Int>) -> [V::Int; 3] {
        match self {
            Fine::Steps(steps) => steps.fields_of::<V>(point).to_array(),
            Fine::Halves => map3!(point.to_array(), |i| half::to_bits::<V>(i)),
        }
    }
    #[inline(always)]
    fn unpack<V: Simd>(self, code: [V::Int; 3]) -> Vec3<V::Int> {
        match self {
            Fine::Steps(steps) => steps.point_of::<V>(Vec3::from(code)),
            Fine::Halves => {
                Vec3::from(map3!(code, |bits| half::from_bits::<V>(bits, half::GREATEST)))
            }
        }
    }
}

/// [`Grid::representative`] of halves.
#[inline(always)]
fn representative_half<V: Simd>(point: Vec3<V::Int>) -> Vec3<V::Int> {
    // Each value is an odd integer times a power of two, or zero.
    let values = map_vec!(point, |i| half::value::<V>(i));
    let odd = map_vec!(point, |i| {
        let mantissa = half::mantissa::<V>(i);
        V::from_int(mantissa) / V::from_int(mantissa & -mantissa).max(1.0)
    });
    let divisor = gcd(odd);
    let primitive = map_vec!(values, |c| c / divisor);
    // Multiples up to this, and powers of two, keep all mantissas below 2^11.
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
    #[inline]
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    fn representative(grid: impl Grid, point: [i32; 3]) -> [i32; 3] {
        grid.representative::<f32>(point.map(I32x1).into()).to_array().map(|i| i.0)
    }

    #[test]
    fn a_field_has_an_index_or_a_signed_number() {
        let point = [-3, 5, -127].map(I32x1);
        let snorm = Steps::snorm([8; 3]);
        assert_eq!(snorm.pack::<f32>(point.into()).0, 0x81_05FD);
        assert_eq!(snorm.unpack::<f32>(0x80_05FD.into()).to_array(), point);
        // (i + 255) / 2.
        let unorm = Steps::unorm(8);
        assert_eq!(unorm.pack::<f32>(point.into()).0, 0x40_827E);
        assert_eq!(unorm.unpack::<f32>(0x40_827E.into()).to_array(), point);
        // i + 128; 0 reads as 1.
        let biased = Steps::biased(8);
        assert_eq!(biased.pack::<f32>(point.into()).0, 0x01_857D);
        assert_eq!(biased.unpack::<f32>(0x00_857D.into()).to_array(), point);
    }

    #[test]
    fn representatives_are_as_long_as_one() {
        // (3, 4, 0): 127 / 5 = 25.4 times, and so from (6, 8, 0) or (75, 100, 0).
        for point in [[3, 4, 0], [-6, -8, 0], [75, 100, 0]] {
            assert_eq!(representative(Steps::snorm([8; 3]), point).map(i32::abs), [75, 100, 0]);
        }
        // (7, 6, 0) on a grid of 15: 15 / 9.22 = 1.63, and twice is (14, 12, 0); (8, 7, 0) has room for once.
        assert_eq!(representative(Steps::snorm([5; 3]), [-7, 6, 0]), [-14, 12, 0]);
        assert_eq!(representative(Steps::snorm([5; 3]), [8, -7, 0]), [8, -7, 0]);
        // Odd multiples only: (1, 3, 5) has 255 / 5.916 = 43.1.
        assert_eq!(representative(Steps::unorm(8), [3, -9, 15]), [43, -129, 215]);
    }

    #[test]
    fn representative_halves_are_as_long_as_one() {
        // 2 and 65504 times an axis; (1, 1, 0) over sqrt(2) is 0.70703125, or 0x39A8; (0, 2^-24, 0).
        for (point, expected) in [
            ([0x4000, 0, 0], [0x3C00, 0, 0]),
            ([0, -0x7BFF, 0], [0, -0x3C00, 0]),
            ([0x3C00, -0x3C00, 0], [0x39A8, -0x39A8, 0]),
            ([0, 1, 0], [0, 0x3C00, 0]),
        ] {
            assert_eq!(representative(Fine::Halves, point), expected);
        }
    }

    #[test]
    fn lengths_are_compared_exactly_where_steps_differ() {
        // 25 (244^2 + 328^2 + 81 (1023 / 511)^2) is 0.14 below 4 * 1023^2. Of (1, 0, 0) 2045 is below, 2046 not.
        let uneven = Uneven::new([11, 11, 10]);
        for (point, times, is_below) in [
            ([244, 328, 9], 5, true),
            ([244, 328, 10], 5, false),
            ([1, 0, 0], 2045, true),
            ([1, 0, 0], 2046, false),
            ([0, 0, 1], 1021, true),
            ([0, 0, 1], 1022, false),
        ] {
            let below = uneven.is_below_two::<f32>(point.map(I32x1).into(), I32x1(times));
            assert_eq!(below, is_below, "{point:?}");
        }
    }
}
