//! Three components: snorm, unorm, floats, and CrytekBFN.

use std::sync::LazyLock;

use super::{
    Kind, Pair, Params, Representation, half, length, normalize, rounding, signed_field,
    snorm_steps, steps_error, unsigned_field, window,
};

/// x, y and z in as many bits, x in the low ones.
pub(super) struct Snorm {
    bits: [u32; 3],
    /// What stands for zero in a field without sign; two's complement if that is 0.
    zero: i64,
}

impl Snorm {
    pub(super) fn new(bits: [u32; 3]) -> Self {
        Snorm { bits, zero: 0 }
    }
    /// Three bytes of which 128 is zero.
    pub(super) fn around_128() -> Self {
        Snorm { bits: [8; 3], zero: 128 }
    }

    fn steps(&self) -> [i64; 3] {
        self.bits.map(snorm_steps)
    }
    fn shifts(&self) -> [u32; 3] {
        [0, self.bits[0], self.bits[0] + self.bits[1]]
    }
    fn values(&self, params: Params<i64>) -> [f64; 3] {
        std::array::from_fn(|i| params[i] as f64 / self.steps()[i] as f64)
    }
}

impl Representation for Snorm {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        std::array::from_fn(|i| v[i] * self.steps()[i] as f64)
    }
    fn params_error(&self) -> f64 {
        self.steps().map(steps_error).into_iter().fold(0.0, f64::max)
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.steps().map(|s| (-s, s))
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        if params == [0; 3] { [0.0, 0.0, 1.0] } else { normalize(self.values(params)) }
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        let field = |i: usize| (params[i] + self.zero) as u128 & ((1 << self.bits[i]) - 1);
        (0..3).map(|i| field(i) << self.shifts()[i]).sum()
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        std::array::from_fn(|i| {
            let (shift, bits) = (self.shifts()[i], self.bits[i]);
            let field = match self.zero {
                0 => signed_field(code, shift, bits),
                zero => unsigned_field(code, shift, bits) - zero,
            };
            field.max(-self.steps()[i])
        })
    }
    /// Of the multiples of one tuple, the one whose length is nearest to 1.
    fn canonical(&self, params: Params<i64>) -> Params<i64> {
        let divisor = params.into_iter().fold(0, greatest_common_divisor);
        if divisor == 0 {
            return [0, 0, self.steps()[2]];
        }
        let least = params.map(|p| p / divisor);
        let off_unit = |n: i64| (length(self.values(least.map(|p| p * n))) - 1.0).abs();
        let fits = |n: i64| (0..3).all(|i| (least[i] * n).abs() <= self.steps()[i]);
        let near = (1.0 / length(self.values(least))) as i64;
        let best = [near, near + 1].into_iter().filter(|&n| n > 0 && fits(n));
        let n = best.min_by(|&a, &b| off_unit(a).total_cmp(&off_unit(b))).unwrap();
        least.map(|p| p * n)
    }
    fn nearby(&self, v: [f64; 3], _: f64) -> Vec<Params<i64>> {
        // Any length: every value of the largest component, the others rounded down and up.
        let long = (0..3).max_by(|&i, &j| v[i].abs().total_cmp(&v[j].abs())).unwrap();
        let steps = self.steps();
        let slope: [f64; 3] =
            std::array::from_fn(|i| v[i] / v[long].abs() * steps[i] as f64 / steps[long] as f64);
        let around = |n: i64| {
            let ideal = slope.map(|s| s * n as f64);
            let mut of = ideal.map(|c| (c.floor() as i64, c.floor() as i64 + 1));
            let n = n * ideal[long].signum() as i64;
            of[long] = (n, n);
            window(self.range(), of)
        };
        (1..=steps[long]).flat_map(around).collect()
    }
}

/// The fields of [`Snorm`], each sign-extended to a word of 16 bits. What is above a field does not count.
pub(super) struct InWords(pub(super) Snorm);

impl Representation for InWords {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        self.0.params(v)
    }
    fn params_error(&self) -> f64 {
        self.0.params_error()
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.0.range()
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        self.0.vector(params)
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        let [x, y, z] = params.map(|p| u128::from(p as u16));
        x | y << 16 | z << 32
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        let steps = self.0.steps();
        std::array::from_fn(|i| signed_field(code, 16 * i as u32, self.0.bits[i]).max(-steps[i]))
    }
    fn canonical(&self, params: Params<i64>) -> Params<i64> {
        self.0.canonical(params)
    }
    fn nearby(&self, v: [f64; 3], cell: f64) -> Vec<Params<i64>> {
        self.0.nearby(v, cell)
    }
}

/// x, y and z as biased unorm of this many bits, x in the low ones. Parameters count the values up
/// from -1, in odd multiples of 1 / steps.
pub(super) struct Unorm(pub(super) u32);

impl Unorm {
    fn component(&self) -> Pair {
        Pair { bits: self.0, kind: Kind::Unorm }
    }
    fn steps(&self) -> i64 {
        self.component().steps()
    }
    /// The odd numerators of the values.
    fn odd(&self, params: Params<i64>) -> Params<i64> {
        params.map(|p| 2 * p - self.steps())
    }
}

impl Representation for Unorm {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        v.map(|c| self.component().position(c))
    }
    fn params_error(&self) -> f64 {
        steps_error(self.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, self.steps()); 3]
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        normalize(self.odd(params).map(|p| p as f64))
    }
    fn pack(&self, [x, y, z]: Params<i64>) -> u128 {
        x as u128 | (y as u128) << self.0 | (z as u128) << (2 * self.0)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        [0, self.0, 2 * self.0].map(|shift| unsigned_field(code, shift, self.0))
    }
    /// Of the multiples of one tuple, the one whose length is nearest to 1. All have odd factors.
    fn canonical(&self, params: Params<i64>) -> Params<i64> {
        let odd = self.odd(params);
        let divisor = odd.into_iter().fold(0, greatest_common_divisor);
        let least = odd.map(|p| p / divisor);
        let unit = self.steps() as f64 / length(least.map(|p| p as f64));
        let below = ((unit as i64 - 1) | 1).max(1);
        let fits = |n: i64| least.into_iter().all(|p| (p * n).abs() <= self.steps());
        let off = |n: i64| (n as f64 - unit).abs();
        let best = [below, below + 2].into_iter().filter(|&n| fits(n));
        let n = best.min_by(|&a, &b| off(a).total_cmp(&off(b))).unwrap();
        least.map(|p| (p * n + self.steps()) / 2)
    }
    fn nearby(&self, v: [f64; 3], _: f64) -> Vec<Params<i64>> {
        // Any length: every value of the largest component, the others rounded down and up.
        let long = (0..3).max_by(|&i, &j| v[i].abs().total_cmp(&v[j].abs())).unwrap();
        let around = |n: i64| {
            let scale = self.component().value(n) / v[long].abs();
            let ideal = v.map(|c| self.component().position(c * scale));
            let mut of = ideal.map(|c| (c.floor() as i64, c.floor() as i64 + 1));
            let n = if v[long] < 0.0 { self.steps() - n } else { n };
            of[long] = (n, n);
            window(self.range(), of)
        };
        ((self.steps() + 1) / 2..=self.steps()).flat_map(around).collect()
    }
}

pub(super) fn greatest_common_divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { greatest_common_divisor(b, a % b) }
}

pub(super) struct Float16;

impl Representation for Float16 {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        v.map(half::position)
    }
    /// Of a relative error of 2.5e-7, with up to 2048 steps in a magnitude.
    fn params_error(&self) -> f64 {
        2.5e-7 * 2048.0
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(-half::GREATEST, half::GREATEST); 3]
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        if params == [0; 3] { [0.0, 0.0, 1.0] } else { normalize(params.map(half::value)) }
    }
    fn pack(&self, [x, y, z]: Params<i64>) -> u128 {
        half::bits(x) | half::bits(y) << 16 | half::bits(z) << 32
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        [0, 16, 32].map(|shift| half::ordinal(code >> shift, half::GREATEST))
    }
    fn nearby(&self, v: [f64; 3], _: f64) -> Vec<Params<i64>> {
        // Halves look the same at every power of two, so one octave of the largest component has
        // them all, except components below 2^-24 of it.
        let long = (0..3).max_by(|&i, &j| v[i].abs().total_cmp(&v[j].abs())).unwrap();
        let around = |n: i64| {
            let scale = half::value(n) / v[long].abs();
            let mut of = v.map(|c| half::position(c * scale).floor() as i64).map(|p| (p, p + 1));
            let n = n * v[long].signum() as i64;
            of[long] = (n, n);
            window(self.range(), of)
        };
        (half::ONE - 1024..=half::ONE).flat_map(around).collect()
    }
}

/// Not a representation of directions: it keeps what it is given. Parameters are the bits.
pub(super) struct Float32;

impl Representation for Float32 {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        v.map(|c| f64::from((c as f32).to_bits()))
    }
    fn params_error(&self) -> f64 {
        1.0
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, u32::MAX.into()); 3]
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        params.map(|p| f32::from_bits(p as u32).into())
    }
    fn pack(&self, [x, y, z]: Params<i64>) -> u128 {
        x as u128 | (y as u128) << 32 | (z as u128) << 64
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        [0, 32, 64].map(|shift| unsigned_field(code, shift, 32))
    }
}

/// The codes of [`Unorm`], the length by which the fast encoder scales a vector from a table.
pub(super) struct BestFit(pub(super) Unorm);

/// For magnitudes a >= b >= c, indexed by 512 c / b and 512 b / a: the numerator of the value of
/// the largest component with which rounding points closest to the middle of the texel.
static LENGTHS: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let texels = (0..512 * 512).map(|at| {
        // The middle of the texel, times 1024^2.
        let (i, j) = (2 * (at % 512) + 1, 2 * (at / 512) + 1);
        let middle: [i64; 3] = [1 << 20, i << 10, i * j];
        let mut best = (0, 0, 1);
        for n in (1..=255).rev().step_by(2) {
            // The odd number nearest to n times a component; there are no ties.
            let point = middle.map(|c| ((n * c) >> 20) | 1);
            let along: i64 = (0..3).map(|i| point[i] * middle[i]).sum();
            let squared: i64 = point.map(|c| c * c).iter().sum();
            // The greatest cosine; exact, since parallel points are equally close.
            let cosine = (along as u128).pow(2);
            if cosine * best.2 > best.1 * squared as u128 {
                best = (n, cosine, squared as u128);
            }
        }
        best.0 as u8
    });
    texels.collect()
});

impl Representation for BestFit {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        self.0.params(v)
    }
    fn params_error(&self) -> f64 {
        self.0.params_error()
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.0.range()
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        self.0.vector(params)
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        self.0.pack(params)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        self.0.unpack(code)
    }
    fn canonical(&self, params: Params<i64>) -> Params<i64> {
        self.0.canonical(params)
    }
    fn nearby(&self, v: [f64; 3], cell: f64) -> Vec<Params<i64>> {
        self.0.nearby(v, cell)
    }
    fn rounded(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let mut sorted = v.map(f64::abs);
        sorted.sort_by(f64::total_cmp);
        let [c, b, a] = sorted;
        // The texels that a ratio may be taken to lie in.
        let texels = |ratio: f64| {
            let [least, greatest] = [-1e-4, 1e-4].map(|e| (512.0 * ratio + e).floor() as usize);
            least.min(511)..=greatest.min(511)
        };
        let mut all = Vec::new();
        for i in texels(b / a) {
            for j in texels(if b == 0.0 { 0.0 } else { c / b }) {
                let scale = f64::from(LENGTHS[512 * j + i]) / 255.0 / a;
                let of = self.params(v.map(|c| c * scale));
                all.extend(window(self.range(), of.map(|p| rounding(p, self.params_error()))));
            }
        }
        all
    }
}
