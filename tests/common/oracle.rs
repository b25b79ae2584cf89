//! Each representation once more, in `f64` and as plainly as can be, from its published definition.
//! Nothing here is shared with `src/`, nor written with an eye on it: a mistake would have to be
//! made twice to go unnoticed.
//!
//! A representation is integer parameters, the point on the sphere that each tuple stands for, and
//! where the parameters stand in a code. [`Oracle`] makes the rest from that: both directions,
//! which codes a fast encoder may give, and which codes lie near a vector.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{cross, length};

/// Parameters of a code; those it does not have are 0.
pub type Params<T> = [T; 3];

pub trait Representation: Send + Sync {
    /// Of a unit vector, in steps, before rounding.
    fn params(&self, v: [f64; 3]) -> Params<f64>;
    /// How far `f32` arithmetic may put a parameter off, in steps.
    fn params_error(&self) -> f64;
    /// Least and greatest value of each parameter.
    fn range(&self) -> Params<(i64, i64)>;
    /// The unit vector that parameters in range stand for.
    fn vector(&self, params: Params<i64>) -> [f64; 3];
    fn pack(&self, params: Params<i64>) -> u128;
    /// Total: patterns that no encoder gives read as their neighbours.
    fn unpack(&self, code: u128) -> Params<i64>;

    /// The one tuple that encoders give for its direction.
    fn canonical(&self, params: Params<i64>) -> Params<i64> {
        params
    }

    fn is_hemisphere(&self) -> bool {
        false
    }

    /// Parameters that may be the nearest to `v`, the nearest certainly among them: all within two
    /// steps of `v`, and of the points one cell away from it, which may lie on the other side of a
    /// fold or a pole.
    fn nearby(&self, v: [f64; 3], cell: f64) -> Vec<Params<i64>> {
        let least = (0..3).min_by(|&i, &j| v[i].abs().total_cmp(&v[j].abs())).unwrap();
        let mut axis = [0.0; 3];
        axis[least] = 1.0;
        let e = normalize(cross(v, axis));
        let f = cross(v, e);
        let steps = [-1.0, 0.0, 1.0];
        let around = steps.iter().flat_map(|a| steps.iter().map(move |b| (a * cell, b * cell)));
        let mut found = Vec::new();
        for (a, b) in around {
            let mut w: [f64; 3] = std::array::from_fn(|i| v[i] + a * e[i] + b * f[i]);
            if self.is_hemisphere() {
                w[2] = w[2].max(0.0);
            }
            let middle = self.params(normalize(w)).map(|p| p.round_ties_even() as i64);
            found.extend(window(self.range(), middle.map(|p| (p - 2, p + 2))));
        }
        found
    }
}

/// All tuples from the least to the greatest of each parameter that are in range.
fn window(range: Params<(i64, i64)>, of: Params<(i64, i64)>) -> Vec<Params<i64>> {
    let [x, y, z]: [_; 3] =
        std::array::from_fn(|i| of[i].0.max(range[i].0)..=of[i].1.min(range[i].1));
    let mut all = Vec::new();
    for x in x {
        for y in y.clone() {
            all.extend(z.clone().map(|z| [x, y, z]));
        }
    }
    all
}

pub struct Oracle {
    representation: Box<dyn Representation>,
    bits: u32,
}

impl Oracle {
    /// The direction that an input stands for; only that matters. Zero and NaN are +Z, infinities
    /// their limit.
    pub fn target(&self, v: [f32; 3]) -> [f64; 3] {
        let mut v = v.map(f64::from);
        if self.representation.is_hemisphere() && v[2] < 0.0 {
            v[2] = 0.0;
        }
        if v.iter().any(|c| c.is_nan()) || v == [0.0; 3] {
            return [0.0, 0.0, 1.0];
        }
        if v.iter().any(|c| c.is_infinite()) {
            v = v.map(|c| if c.is_infinite() { c.signum() } else { 0.0 });
        }
        normalize(v)
    }

    pub fn decode(&self, code: u128) -> [f64; 3] {
        self.representation.vector(self.representation.unpack(code))
    }

    /// The code that encoders give for what `code` decodes to.
    pub fn canonical(&self, code: u128) -> u128 {
        let params = self.representation.unpack(code);
        self.representation.pack(self.representation.canonical(params))
    }

    /// Every code that rounding each parameter may give: one, but for parameters that `f32` cannot
    /// tell from a tie.
    pub fn encodings(&self, v: [f64; 3]) -> Vec<u128> {
        let exact = self.representation.params(v);
        let error = self.representation.params_error();
        let of = exact
            .map(|p| ((p - error).round_ties_even() as i64, (p + error).round_ties_even() as i64));
        let range = self.representation.range();
        let of = std::array::from_fn(|i| {
            let clamp = |p: i64| p.clamp(range[i].0, range[i].1);
            (clamp(of[i].0), clamp(of[i].1))
        });
        let pack = |params| self.representation.pack(self.representation.canonical(params));
        window(range, of).into_iter().map(pack).collect()
    }

    /// The angle from `v` to the nearest code that a search around it finds.
    pub fn nearest_angle(&self, v: [f64; 3]) -> f64 {
        let cell = (4.0 * PI / 2f64.powi(self.bits as i32)).sqrt();
        let nearby = self.representation.nearby(v, cell).into_iter();
        let chord = nearby
            .map(|p| chord_squared(self.representation.vector(p), v))
            .fold(4.0, f64::min)
            .sqrt();
        2.0 * (chord / 2.0).asin()
    }

    pub fn params_error(&self) -> f64 {
        self.representation.params_error()
    }
}

/// |a - b|^2, which for unit vectors orders as the angle does and is as exact near 0.
pub fn chord_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

fn normalize(v: [f64; 3]) -> [f64; 3] {
    let length = length(v);
    v.map(|c| c / length)
}

/// The oracle of a format, by its name.
pub fn oracle(name: &str) -> Option<Oracle> {
    let family = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let size = name[family.len()..].parse().unwrap_or(0);
    let pair = |kind| Pair { bits: size / 2, kind };
    let (bits, representation): (u32, Box<dyn Representation>) = match (family, size) {
        ("oct", 1..) => (size, Box::new(Oct(pair(Kind::Snorm)))),
        ("spherical", 1..) => (size, Box::new(Spherical(pair(Kind::Snorm)))),
        ("HemiOct", 1..) => (size, Box::new(HemiOct(pair(Kind::Snorm)))),
        ("XYOnly", 1..) => (size, Box::new(XyOnly(Component::Unorm(pair(Kind::Unorm))))),
        ("XYOnly32F", 0) => (32, Box::new(XyOnly(Component::Half))),
        ("snorm5x", 3) => (15, Box::new(Snorm([5, 5, 5]))),
        ("snorm8x", 3) => (24, Box::new(Snorm([8, 8, 8]))),
        ("snorm10x", 3) => (30, Box::new(Snorm([10, 10, 10]))),
        ("snorm11-11-", 10) => (32, Box::new(Snorm([11, 11, 10]))),
        ("snorm16x", 3) => (48, Box::new(Snorm([16, 16, 16]))),
        ("float16x", 3) => (48, Box::new(Float16)),
        ("float32x", 3) => (96, Box::new(Float32)),
        _ => return None,
    };
    Some(Oracle { representation, bits })
}

/// Low `bits` of `code` from `shift` on, as two's complement.
fn signed_field(code: u128, shift: u32, bits: u32) -> i64 {
    (((code >> shift) as i64) << (64 - bits)) >> (64 - bits)
}

fn unsigned_field(code: u128, shift: u32, bits: u32) -> i64 {
    ((code >> shift) as i64) & ((1 << bits) - 1)
}

/// 2^(bits-1) - 1 steps from 0 to 1.
fn snorm_steps(bits: u32) -> i64 {
    (1 << (bits - 1)) - 1
}

/// What rounding errors of a few units in the last place, here 5e-7 of the whole range, are in
/// steps.
fn steps_error(steps: i64) -> f64 {
    5e-7 * steps as f64
}

/// Two parameters of `bits` each, the first in the low bits; at 2 x 12 bits the three bytes of the
/// survey's Listing 5.
#[derive(Clone, Copy)]
struct Pair {
    bits: u32,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Snorm,
    Unorm,
}

impl Pair {
    /// Steps from 0 to 1.
    fn steps(self) -> i64 {
        match self.kind {
            Kind::Snorm => snorm_steps(self.bits),
            Kind::Unorm => (1 << self.bits) - 1,
        }
    }

    fn range(self) -> Params<(i64, i64)> {
        let steps = self.steps();
        let one = if self.kind == Kind::Snorm { (-steps, steps) } else { (0, steps) };
        [one, one, (0, 0)]
    }

    fn pack(self, [u, v, _]: Params<i64>) -> u128 {
        if self.bits == 12 {
            let bias = if self.kind == Kind::Snorm { 2047 } else { 0 };
            let [u, v] = [u + bias, v + bias];
            let rgb = [u >> 4, (u & 15) << 4 | v >> 8, v & 255];
            rgb.iter().rev().fold(0, |code, &byte| code << 8 | byte as u128)
        } else {
            let field = |p: i64| p as u128 & ((1 << self.bits) - 1);
            field(u) | field(v) << self.bits
        }
    }

    fn unpack(self, code: u128) -> Params<i64> {
        let [u, v] = if self.bits == 12 {
            let [r, g, b] = [0, 8, 16].map(|shift| unsigned_field(code, shift, 8));
            let bias = if self.kind == Kind::Snorm { 2047 } else { 0 };
            [(r << 4 | g >> 4) - bias, ((g & 15) << 8 | b) - bias]
        } else if self.kind == Kind::Snorm {
            [signed_field(code, 0, self.bits), signed_field(code, self.bits, self.bits)]
        } else {
            [unsigned_field(code, 0, self.bits), unsigned_field(code, self.bits, self.bits)]
        };
        let steps = self.steps();
        [u.clamp(-steps, steps), v.clamp(-steps, steps), 0]
    }
}

fn sign(t: f64) -> f64 {
    if t >= 0.0 { 1.0 } else { -1.0 }
}

struct Oct(Pair);

impl Representation for Oct {
    fn params(&self, [x, y, z]: [f64; 3]) -> Params<f64> {
        let k = 1.0 / (x.abs() + y.abs() + z.abs());
        let (px, py) = (x * k, y * k);
        let (u, w) = if z > 0.0 {
            (px, py)
        } else {
            ((1.0 - py.abs()) * sign(px), (1.0 - px.abs()) * sign(py))
        };
        [u, w, 0.0].map(|p| p * self.0.steps() as f64)
    }
    fn params_error(&self) -> f64 {
        steps_error(self.0.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.0.range()
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        let [u, w, _] = params.map(|p| p as f64 / self.0.steps() as f64);
        let z = 1.0 - u.abs() - w.abs();
        let (x, y) =
            if z < 0.0 { ((1.0 - w.abs()) * sign(u), (1.0 - u.abs()) * sign(w)) } else { (u, w) };
        normalize([x, y, z])
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        self.0.pack(params)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        self.0.unpack(code)
    }
    /// On the border of the square, the points mirrored in the middle of a side are one.
    fn canonical(&self, [u, w, _]: Params<i64>) -> Params<i64> {
        let border = self.0.steps();
        let folded = |p: i64, other: i64| if other.abs() == border { p.abs() } else { p };
        [folded(u, w), folded(w, u), 0]
    }
}

struct HemiOct(Pair);

impl Representation for HemiOct {
    fn params(&self, [x, y, z]: [f64; 3]) -> Params<f64> {
        let k = self.0.steps() as f64 / (x.abs() + y.abs() + z);
        [(x + y) * k, (x - y) * k, 0.0]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.0.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.0.range()
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        let [u, w, _] = params.map(|p| p as f64 / self.0.steps() as f64);
        let (x, y) = ((u + w) / 2.0, (u - w) / 2.0);
        normalize([x, y, 1.0 - x.abs() - y.abs()])
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        self.0.pack(params)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        self.0.unpack(code)
    }
    fn is_hemisphere(&self) -> bool {
        true
    }
}

struct Spherical(Pair);

impl Representation for Spherical {
    fn params(&self, [x, y, z]: [f64; 3]) -> Params<f64> {
        let theta = x.hypot(y).atan2(z);
        let phi = y.atan2(x);
        [2.0 * theta / PI - 1.0, phi / PI, 0.0].map(|p| p * self.0.steps() as f64)
    }
    fn params_error(&self) -> f64 {
        steps_error(self.0.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.0.range()
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        let [u, w, _] = params.map(|p| p as f64 / self.0.steps() as f64);
        let (theta, phi) = ((u + 1.0) * FRAC_PI_2, w * PI);
        [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        self.0.pack(params)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        self.0.unpack(code)
    }
    /// A pole has azimuth 0, and the azimuth of -X is positive.
    fn canonical(&self, [u, w, _]: Params<i64>) -> Params<i64> {
        let greatest = self.0.steps();
        let w = if u.abs() == greatest {
            0
        } else if w == -greatest {
            greatest
        } else {
            w
        };
        [u, w, 0]
    }
}

/// x, y and z in as many bits, x in the low ones.
struct Snorm([u32; 3]);

impl Snorm {
    fn steps(&self) -> [i64; 3] {
        self.0.map(snorm_steps)
    }
    fn shifts(&self) -> [u32; 3] {
        [0, self.0[0], self.0[0] + self.0[1]]
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
        let field = |i: usize| (params[i] as u128 & ((1 << self.0[i]) - 1)) << self.shifts()[i];
        field(0) | field(1) | field(2)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        std::array::from_fn(|i| {
            signed_field(code, self.shifts()[i], self.0[i]).max(-self.steps()[i])
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

fn greatest_common_divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { greatest_common_divisor(b, a % b) }
}

/// A half as an integer that counts the halves from 0 up: its bits, negative if its sign is set.
mod half {
    pub const ONE: i64 = 0x3C00;
    /// 65504.
    pub const GREATEST: i64 = 0x7BFF;

    pub fn value(ordinal: i64) -> f64 {
        let (exponent, mantissa) = (ordinal.abs() >> 10, ordinal.abs() & 0x3FF);
        let magnitude = if exponent == 0 {
            mantissa as f64 * 2f64.powi(-24)
        } else {
            (1024 + mantissa) as f64 * 2f64.powi(exponent as i32 - 25)
        };
        if ordinal < 0 { -magnitude } else { magnitude }
    }

    /// Where `x` stands among the halves: whole at a half, and in proportion between two. The even
    /// one of two halves has the even integer, so rounding the position is rounding `x`.
    pub fn position(x: f64) -> f64 {
        let magnitude = x.abs();
        let exponent =
            if magnitude < 2f64.powi(-14) { -14 } else { magnitude.log2().floor() as i32 };
        // log2 may round up just below a power of two; the position runs on there all the same.
        let mantissa = magnitude * 2f64.powi(10 - exponent);
        let position = f64::from((exponent + 14) * 1024) + mantissa;
        if x < 0.0 { -position } else { position }
    }

    pub fn bits(ordinal: i64) -> u128 {
        let sign = if ordinal < 0 { 0x8000 } else { 0 };
        sign | ordinal.unsigned_abs() as u128
    }

    /// Of any pattern; infinities and NaN, and all above `greatest`, read as `greatest`.
    pub fn ordinal(bits: u128, greatest: i64) -> i64 {
        let magnitude = (bits as i64 & 0x7FFF).min(greatest);
        if bits & 0x8000 == 0 { magnitude } else { -magnitude }
    }
}

struct Float16;

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
        // them all, but for components below 2^-24 of it.
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
struct Float32;

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

/// x and y on a grid each, z from the unit length.
struct XyOnly(Component);

enum Component {
    Unorm(Pair),
    Half,
}

impl Component {
    fn position(&self, x: f64) -> f64 {
        match self {
            Component::Unorm(pair) => (x + 1.0) / 2.0 * pair.steps() as f64,
            Component::Half => half::position(x),
        }
    }
    fn value(&self, param: i64) -> f64 {
        match self {
            // The numerator is whole, so that values are symmetric about 0.
            Component::Unorm(pair) => (2 * param - pair.steps()) as f64 / pair.steps() as f64,
            Component::Half => half::value(param),
        }
    }
    fn negate(&self, param: i64) -> i64 {
        match self {
            Component::Unorm(pair) => pair.steps() - param,
            Component::Half => -param,
        }
    }
    /// The first grid point at or above x >= 0.
    fn at_least(&self, x: f64) -> i64 {
        self.position(x).ceil() as i64
    }
}

impl XyOnly {
    fn is_beyond(&self, [x, y, _]: Params<i64>) -> bool {
        let (x, y) = (self.0.value(x), self.0.value(y));
        x * x + y * y >= 1.0
    }

    /// The point of the rim that a code beyond it stands for: the smaller component's parameter,
    /// cut where the diagonal has passed it, and whether that component is x.
    fn smaller(&self, [x, y, _]: Params<i64>) -> (i64, bool) {
        let x_is_smaller = self.0.value(x).abs() < self.0.value(y).abs();
        let p = if x_is_smaller { x } else { y };
        let cut = self.0.at_least(0.5f64.sqrt());
        let magnitude = if self.0.value(p) < 0.0 { self.0.negate(p) } else { p }.min(cut);
        (if self.0.value(p) < 0.0 { self.0.negate(magnitude) } else { magnitude }, x_is_smaller)
    }
}

impl Representation for XyOnly {
    fn params(&self, [x, y, _]: [f64; 3]) -> Params<f64> {
        [self.0.position(x), self.0.position(y), 0.0]
    }
    fn params_error(&self) -> f64 {
        match self.0 {
            Component::Unorm(pair) => steps_error(pair.steps()),
            Component::Half => Float16.params_error(),
        }
    }
    fn range(&self) -> Params<(i64, i64)> {
        match self.0 {
            Component::Unorm(pair) => pair.range(),
            Component::Half => [(-half::ONE, half::ONE), (-half::ONE, half::ONE), (0, 0)],
        }
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        let [x, y] = [params[0], params[1]].map(|p| self.0.value(p));
        if !self.is_beyond(params) {
            return [x, y, (1.0 - x * x - y * y).sqrt()];
        }
        let (small, x_is_smaller) = self.smaller(params);
        let small = self.0.value(small);
        let large = (1.0 - small * small).sqrt();
        if x_is_smaller { [small, large * sign(y), 0.0] } else { [large * sign(x), small, 0.0] }
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        match self.0 {
            Component::Unorm(pair) => pair.pack(params),
            Component::Half => half::bits(params[0]) | half::bits(params[1]) << 16,
        }
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        match self.0 {
            Component::Unorm(pair) => pair.unpack(code),
            Component::Half => {
                [half::ordinal(code, half::ONE), half::ordinal(code >> 16, half::ONE), 0]
            }
        }
    }
    fn is_hemisphere(&self) -> bool {
        true
    }
    /// Of the codes beyond the rim that read as one point of it, the nearest to it.
    fn canonical(&self, params: Params<i64>) -> Params<i64> {
        if !self.is_beyond(params) {
            return params;
        }
        let (small, x_is_smaller) = self.smaller(params);
        let value = self.0.value(small);
        let large = self.0.at_least((1.0 - value * value).sqrt());
        // It must remain the larger one; x is on a tie.
        let magnitude = if value < 0.0 { self.0.negate(small) } else { small };
        let large = large.max(if x_is_smaller { magnitude + 1 } else { magnitude });
        let signed = |old: i64| if self.0.value(old) < 0.0 { self.0.negate(large) } else { large };
        if x_is_smaller { [small, signed(params[1]), 0] } else { [signed(params[0]), small, 0] }
    }
    fn nearby(&self, v: [f64; 3], _: f64) -> Vec<Params<i64>> {
        let range = self.range();
        let (greatest, swap) =
            (range[0].1, |p: Params<i64>, swapped: bool| if swapped { [p[1], p[0], 0] } else { p });
        let mut found = Vec::new();
        for swapped in [false, true] {
            // The points of one column lie on a circle about its axis; the nearest to v is at v's
            // angle on it.
            let (p, q) = if swapped { (v[1], v[0]) } else { (v[0], v[1]) };
            let around = if v[2].hypot(q) == 0.0 { 1.0 } else { q / v[2].hypot(q) };
            let middle = self.0.position(p).floor() as i64;
            for column in (middle - 100).max(range[0].0)..=(middle + 101).min(range[0].1) {
                let radius = (1.0 - self.0.value(column).powi(2)).max(0.0).sqrt();
                let q = self.0.position(around * radius).floor() as i64;
                let rows = window(range, [(column, column), (q, q + 1), (0, 0)]);
                found.extend(rows.into_iter().map(|params| swap(params, swapped)));
            }
            // And those of the rim, which codes far beyond it read as.
            let small = p / p.hypot(q).max(1e-300);
            let small = self.0.position(small).floor() as i64;
            let far = [range[0].0, greatest].map(|far| {
                let columns = window(range, [(small, small + 1), (far, far), (0, 0)]);
                columns.into_iter().map(|params| swap(params, swapped)).collect::<Vec<_>>()
            });
            found.extend(far.into_iter().flatten());
        }
        found
    }
}
