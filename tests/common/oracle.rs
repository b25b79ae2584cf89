//! Each representation once more, in `f64` and as plainly as can be, from its published definition.
//! Nothing here is shared with `src/`, nor written with an eye on it: a mistake would have to be
//! made twice to go unnoticed.
//!
//! A representation is integer parameters, the point on the sphere that each tuple stands for, and
//! where the parameters stand in a code. [`Oracle`] makes the rest from that: both directions,
//! which codes a fast encoder may give, and which codes lie near a vector.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, SQRT_2, TAU};
use std::sync::LazyLock;

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

    /// The vectors of the codes from `first` on.
    fn vectors_from(&self, first: u128, vectors: &mut [[f64; 3]]) {
        for (code, vector) in (first..).zip(vectors) {
            *vector = self.vector(self.unpack(code));
        }
    }

    /// The one tuple that encoders give for its direction.
    fn canonical(&self, params: Params<i64>) -> Params<i64> {
        params
    }

    fn is_hemisphere(&self) -> bool {
        false
    }

    /// All tuples that rounding the parameters of `v` may give: one, but for parameters that `f32`
    /// cannot tell from a tie.
    fn rounded(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let error = self.params_error();
        let of = self.params(v).map(|p| rounding(p, error));
        let range = self.range();
        let clamp = |i: usize, p: i64| p.clamp(range[i].0, range[i].1);
        window(range, std::array::from_fn(|i| (clamp(i, of[i].0), clamp(i, of[i].1))))
    }

    /// How many steps around a point its neighbours may be, in each parameter.
    fn reach(&self) -> Params<i64> {
        [2; 3]
    }

    /// Parameters that may be the nearest to `v`, the nearest certainly among them: all within two
    /// steps of `v`, and of the points one cell away from it, which may lie on the other side of a
    /// fold, an edge or a pole.
    fn nearby(&self, v: [f64; 3], cell: f64) -> Vec<Params<i64>> {
        let least = (0..3).min_by(|&i, &j| v[i].abs().total_cmp(&v[j].abs())).unwrap();
        let mut axis = [0.0; 3];
        axis[least] = 1.0;
        let e = normalize(cross(v, axis));
        let f = cross(v, e);
        let steps = [-1.0, 0.0, 1.0];
        let offsets = steps.iter().flat_map(|a| steps.iter().map(move |b| (a * cell, b * cell)));
        let mut found = Vec::new();
        for (a, b) in offsets {
            let mut w: [f64; 3] = std::array::from_fn(|i| v[i] + a * e[i] + b * f[i]);
            if self.is_hemisphere() {
                w[2] = w[2].max(0.0);
            }
            let middle = self.params(normalize(w)).map(|p| p.round_ties_even() as i64);
            found.extend(window(self.range(), around(middle, self.reach())));
        }
        found
    }
}

fn around(middle: Params<i64>, reach: Params<i64>) -> Params<(i64, i64)> {
    std::array::from_fn(|i| (middle[i] - reach[i], middle[i] + reach[i]))
}

/// The integers that `p`, known but for `error`, may be rounded to: the least and the greatest.
fn rounding(p: f64, error: f64) -> (i64, i64) {
    ((p - error).round_ties_even() as i64, (p + error).round_ties_even() as i64)
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

    /// What the codes from `first` on stand for.
    pub fn decode_from(&self, first: u128, vectors: &mut [[f64; 3]]) {
        self.representation.vectors_from(first, vectors);
    }

    /// The code that encoders give for what `code` decodes to.
    pub fn canonical(&self, code: u128) -> u128 {
        let params = self.representation.unpack(code);
        self.representation.pack(self.representation.canonical(params))
    }

    /// Every code that the fast encoder may give: one, but for parameters that `f32` cannot tell
    /// from a tie.
    pub fn encodings(&self, v: [f64; 3]) -> Vec<u128> {
        let pack = |params| self.representation.pack(self.representation.canonical(params));
        self.representation.rounded(v).into_iter().map(pack).collect()
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
    // latlong16D and XYOnly32F have their size in the middle.
    let stem = name.strip_suffix('D').unwrap_or(name);
    let family = stem.trim_end_matches(|c: char| c.is_ascii_digit());
    let size = stem[family.len()..].parse().unwrap_or(0);
    let pair = |kind| Pair { bits: size / 2, kind };
    let (bits, representation): (u32, Box<dyn Representation>) = match (family, size) {
        ("latlong", 16 | 24 | 32) if stem != name => (size, Box::new(LatLongD::new(size))),
        _ if stem != name => return None,
        ("oct", 1..) => (size, Box::new(Oct(pair(Kind::Snorm), &Central))),
        ("warpedoct", 1..) => (size, Box::new(Oct(pair(Kind::Snorm), &Warped))),
        ("eqareaoct", 1..) => (size, Box::new(Oct(pair(Kind::Snorm), &EqualArea))),
        ("sixoct", 1..) => (size, Box::new(Oct(pair(Kind::Sixes), &Central))),
        ("frontoct", 1..) => (size, Box::new(FrontOct(Oct(pair(Kind::Snorm), &Central), 2.0))),
        ("quadfrontoct", 1..) => (size, Box::new(FrontOct(Oct(pair(Kind::Snorm), &Central), 4.0))),
        ("signedoct", 1..) => (size, Box::new(SignedOct(HemiOct(pair(Kind::Snorm))))),
        ("fibonacci", 1..) => (size, Box::new(Fibonacci { points: 1 << size })),
        ("spherical", 1..) => (size, Box::new(Spherical::new(pair(Kind::Snorm)))),
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
        ("latlong", 1..) => (size, Box::new(LatLong::new(size))),
        ("cube", 1..) => (size, Box::new(Cube::new(size, false))),
        ("warpedcube", 1..) => (size, Box::new(Cube::new(size, true))),
        ("angularcube", 1..) => (size, Box::new(AngularCube::new(size))),
        ("octant", 16) => (16, Box::new(Octant)),
        ("icosphere", 162) => (8, Box::new(Icosphere::new())),
        ("xyz-unorm8x", 3) => (24, Box::new(Unorm(8))),
        ("xyz-unorm16x", 3) => (48, Box::new(Unorm(16))),
        ("CrytekBFN", 24) => (24, Box::new(BestFit(Unorm(8)))),
        ("phi-z-unorm8x", 2) => (16, Box::new(PhiZ::new(8))),
        ("phi-z-unorm16x", 2) => (32, Box::new(PhiZ::new(16))),
        ("oct-unorm8x", 2) => (16, Box::new(Oct(Pair { bits: 8, kind: Kind::Unorm }, &Central))),
        ("oct-unorm16x", 2) => (32, Box::new(Oct(Pair { bits: 16, kind: Kind::Unorm }, &Central))),
        (_, 1..) => {
            let (projection, stretch) = family.split_once('+').unwrap_or((family, ""));
            let projection = match projection {
                "stereo" => Projection::Stereo,
                "eqarea" => Projection::EqArea,
                "eqdist" => Projection::EqDist,
                _ => return None,
            };
            let stretch = match stretch {
                "" => Stretch::Plain,
                "concentric" => Stretch::Concentric,
                "ellipse" => Stretch::Ellipse,
                _ => return None,
            };
            (size, Box::new(Disk { pair: pair(Kind::Snorm), projection, stretch }))
        }
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
    /// Snorm with fewer steps, a multiple of six.
    Sixes,
    Unorm,
}

impl Pair {
    /// Steps from 0 to 1.
    fn steps(self) -> i64 {
        match self.kind {
            Kind::Snorm => snorm_steps(self.bits),
            Kind::Sixes => snorm_steps(self.bits) / 6 * 6,
            Kind::Unorm => (1 << self.bits) - 1,
        }
    }

    /// Where a number from -1 to 1 stands.
    fn position(self, t: f64) -> f64 {
        match self.kind {
            Kind::Snorm | Kind::Sixes => t * self.steps() as f64,
            Kind::Unorm => (t + 1.0) / 2.0 * self.steps() as f64,
        }
    }

    /// The number from -1 to 1 that `param` stands for.
    fn value(self, param: i64) -> f64 {
        let steps = self.steps();
        match self.kind {
            Kind::Snorm | Kind::Sixes => param as f64 / steps as f64,
            // The numerator is whole, so that values are symmetric about 0.
            Kind::Unorm => (2 * param - steps) as f64 / steps as f64,
        }
    }

    /// The parameter of the same magnitude, not negative.
    fn magnitude(self, param: i64) -> i64 {
        match self.kind {
            Kind::Snorm | Kind::Sixes => param.abs(),
            Kind::Unorm => param.max(self.steps() - param),
        }
    }

    fn range(self) -> Params<(i64, i64)> {
        let steps = self.steps();
        let one = if self.kind == Kind::Unorm { (0, steps) } else { (-steps, steps) };
        [one, one, (0, 0)]
    }

    fn pack(self, [u, v, _]: Params<i64>) -> u128 {
        if self.bits == 12 {
            let bias = if self.kind == Kind::Unorm { 0 } else { 2047 };
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
            let bias = if self.kind == Kind::Unorm { 0 } else { 2047 };
            [(r << 4 | g >> 4) - bias, ((g & 15) << 8 | b) - bias]
        } else if self.kind != Kind::Unorm {
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

/// Between the sphere and the octahedron |x| + |y| + |z| = 1.
trait Octahedral: Send + Sync {
    fn to_octahedron(&self, v: [f64; 3]) -> [f64; 3];
    fn to_sphere(&self, p: [f64; 3]) -> [f64; 3];
}

struct Central;

impl Octahedral for Central {
    fn to_octahedron(&self, v: [f64; 3]) -> [f64; 3] {
        let k = 1.0 / v.iter().map(|c| c.abs()).sum::<f64>();
        v.map(|c| c * k)
    }
    fn to_sphere(&self, p: [f64; 3]) -> [f64; 3] {
        normalize(p)
    }
}

/// Each coordinate t of the octahedron stands for t (1 + (k + q t) (1 - t)).
struct Warped;

impl Warped {
    /// The polynomial in powers of t, and its slope.
    fn warp(t: f64) -> (f64, f64) {
        let (k, q) = (0.459265, -0.710567);
        let [a, b, c] = [1.0 + k, q - k, -q];
        ((a + (b + c * t) * t) * t, a + (2.0 * b + 3.0 * c * t) * t)
    }

    fn unwarp(g: f64) -> f64 {
        let mut t = g / 1.46;
        for _ in 0..100 {
            let (value, slope) = Self::warp(t);
            let step = (g - value) / slope;
            t += step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        t
    }
}

impl Octahedral for Warped {
    fn to_octahedron(&self, v: [f64; 3]) -> [f64; 3] {
        // How long v has to be for coordinates that add to 1.
        let mut scale = 1.0 / v.iter().map(|c| c.abs()).sum::<f64>();
        for _ in 0..100 {
            let t = v.map(|c| Self::unwarp(c.abs() * scale));
            let slope: f64 = (0..3).map(|i| v[i].abs() / Self::warp(t[i]).1).sum();
            let step = (1.0 - t.iter().sum::<f64>()) / slope;
            scale += step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        v.map(|c| Self::unwarp(c.abs() * scale) * sign(c))
    }
    fn to_sphere(&self, p: [f64; 3]) -> [f64; 3] {
        normalize(p.map(|t| Self::warp(t.abs()).0 * sign(t)))
    }
}

/// Clarberg's, 2008.
struct EqualArea;

impl Octahedral for EqualArea {
    fn to_octahedron(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        // 1 - |z| loses digits near the poles.
        let r = (x * x + y * y).sqrt() / (1.0 + z.abs()).sqrt();
        let v = r * y.abs().atan2(x.abs()) / FRAC_PI_2;
        [(r - v) * sign(x), v * sign(y), (1.0 - r) * sign(z)]
    }
    fn to_sphere(&self, [u, v, w]: [f64; 3]) -> [f64; 3] {
        let r = 1.0 - w.abs();
        let phi = if r == 0.0 { 0.0 } else { FRAC_PI_4 * ((v.abs() - u.abs()) / r + 1.0) };
        let h = r * (2.0 - r * r).sqrt();
        [h * phi.cos() * sign(u), h * phi.sin() * sign(v), (1.0 - r * r) * sign(w)]
    }
}

struct Oct(Pair, &'static dyn Octahedral);

impl Representation for Oct {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        let [px, py, pz] = self.1.to_octahedron(v);
        let (u, w) = if pz > 0.0 {
            (px, py)
        } else {
            ((1.0 - py.abs()) * sign(px), (1.0 - px.abs()) * sign(py))
        };
        [self.0.position(u), self.0.position(w), 0.0]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.0.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.0.range()
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        let [u, w] = [params[0], params[1]].map(|p| self.0.value(p));
        let z = 1.0 - u.abs() - w.abs();
        let (x, y) =
            if z < 0.0 { ((1.0 - w.abs()) * sign(u), (1.0 - u.abs()) * sign(w)) } else { (u, w) };
        self.1.to_sphere([x, y, z])
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        self.0.pack(params)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        self.0.unpack(code)
    }
    /// On the border of the square, the points mirrored in the middle of a side are one.
    fn canonical(&self, [u, w, _]: Params<i64>) -> Params<i64> {
        let is_border = |p: i64| self.0.magnitude(p) == self.0.steps();
        let folded = |p: i64, other: i64| if is_border(other) { self.0.magnitude(p) } else { p };
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

/// Hemi-oct of either hemisphere, and a third parameter that is 1 in the lower one.
struct SignedOct(HemiOct);

impl Representation for SignedOct {
    fn params(&self, [x, y, z]: [f64; 3]) -> Params<f64> {
        let [u, w, _] = self.0.params([x, y, z.abs()]);
        [u, w, f64::from(z < 0.0)]
    }
    fn params_error(&self) -> f64 {
        self.0.params_error()
    }
    fn range(&self) -> Params<(i64, i64)> {
        let [u, w, _] = self.0.range();
        [u, w, (0, 1)]
    }
    fn vector(&self, [u, w, lower]: Params<i64>) -> [f64; 3] {
        let [x, y, z] = self.0.vector([u, w, 0]);
        [x, y, if lower == 1 { -z } else { z }]
    }
    fn pack(&self, [u, w, lower]: Params<i64>) -> u128 {
        self.0.pack([u, w, 0]) | (lower as u128) << (2 * self.0.0.bits)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        let [u, w, _] = self.0.unpack(code);
        [u, w, unsigned_field(code, 2 * self.0.0.bits, 1)]
    }
    /// The equator belongs to the upper hemisphere.
    fn canonical(&self, [u, w, lower]: Params<i64>) -> Params<i64> {
        let equator = u.abs().max(w.abs()) == self.0.0.steps();
        [u, w, if equator { 0 } else { lower }]
    }
}

/// Oct of the direction that a scaling of the stereographic plane leads to.
struct FrontOct(Oct, f64);

impl FrontOct {
    /// The direction whose stereographic projection from -Z is `scale` times that of `v`.
    fn scaled([x, y, z]: [f64; 3], scale: f64) -> [f64; 3] {
        // From the farther pole; the projections from both are each other's inverse.
        let (pole, scale) = if z < 0.0 { (-1.0, 1.0 / scale) } else { (1.0, scale) };
        let [a, b] = [x, y].map(|c| c / (1.0 + z.abs()) * scale);
        let square = a * a + b * b;
        normalize([2.0 * a, 2.0 * b, pole * (1.0 - square)])
    }
}

impl Representation for FrontOct {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        self.0.params(Self::scaled(v, self.1))
    }
    fn params_error(&self) -> f64 {
        self.0.params_error() * self.1
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.0.range()
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        Self::scaled(self.0.vector(params), 1.0 / self.1)
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
}

/// The nearest point is looked for in a lattice basis that Gauss's reduction finds.
struct Fibonacci {
    points: i64,
}

impl Fibonacci {
    fn turns(i: i64) -> f64 {
        f64::from((i as u32).wrapping_mul(0x9E37_79B9)) / 2f64.powi(32)
    }

    fn near(&self, v: [f64; 3]) -> Vec<i64> {
        let n = self.points as f64;
        let height = n * (1.0 - v[2]) / 2.0 - 0.5;
        let start = height.round() as i64;
        let turns = v[1].atan2(v[0]) / TAU - Self::turns(start);
        let target = [height - start as f64, turns - turns.round()];
        // Steps in index and turns, as lengths on the sphere.
        let r = v[0].hypot(v[1]).max(2.0 / n.sqrt());
        let dot = |a: [f64; 2], b: [f64; 2]| {
            a[0] * b[0] * (2.0 / (n * r)).powi(2) + a[1] * b[1] * (TAU * r).powi(2)
        };
        let (mut a, mut b) = ([1.0, Self::turns(1)], [0.0, 1.0]);
        loop {
            let times = (dot(a, b) / dot(a, a)).round();
            b = [b[0] - times * a[0], b[1] - times * a[1]];
            if dot(b, b) >= dot(a, a) {
                break;
            }
            (a, b) = (b, a);
        }
        let area = a[0] * b[1] - a[1] * b[0];
        let of_a = ((target[0] * b[1] - target[1] * b[0]) / area).round();
        let of_b = ((a[0] * target[1] - a[1] * target[0]) / area).round();
        let steps = |middle: f64| (-3..=3).map(move |step| middle + f64::from(step));
        let lattice =
            steps(of_a).flat_map(|s| steps(of_b).map(move |t| (s * a[0] + t * b[0]) as i64));
        // Around the poles there is no lattice.
        let last = self.points - 1;
        let poles = (0..16).flat_map(|i| [i, last - i]);
        let all = lattice.map(|i| start + i).chain(poles.filter(|_| r < 16.0 / n.sqrt()));
        all.filter(|i| (0..=last).contains(i)).collect()
    }
}

impl Representation for Fibonacci {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        let distance = |&i: &i64| chord_squared(v, self.vector([i, 0, 0]));
        let near = self.near(v);
        let nearest = near.iter().min_by(|i, j| distance(i).total_cmp(&distance(j))).unwrap();
        [*nearest as f64, 0.0, 0.0]
    }
    fn params_error(&self) -> f64 {
        0.0
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, self.points - 1), (0, 0), (0, 0)]
    }
    fn vector(&self, [i, _, _]: Params<i64>) -> [f64; 3] {
        let z = 1.0 - (2 * i + 1) as f64 / self.points as f64;
        let r = ((1.0 - z) * (1.0 + z)).sqrt();
        let (sin, cos) = (TAU * Self::turns(i)).sin_cos();
        [r * cos, r * sin, z]
    }
    fn pack(&self, [i, _, _]: Params<i64>) -> u128 {
        i as u128
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        [(code & (self.points - 1) as u128) as i64, 0, 0]
    }
    fn rounded(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let distance = |i: i64| chord_squared(v, self.vector([i, 0, 0])).sqrt();
        let near = self.near(v);
        let least = near.iter().map(|&i| distance(i)).fold(2.0, f64::min);
        let close = near.into_iter().filter(|&i| distance(i) < least + 5e-7);
        close.map(|i| [i, 0, 0]).collect()
    }
    fn nearby(&self, v: [f64; 3], _: f64) -> Vec<Params<i64>> {
        self.near(v).into_iter().map(|i| [i, 0, 0]).collect()
    }
}

/// A function of an integer parameter, computed once for each value in its range.
struct Tabulated<T> {
    least: i64,
    values: Vec<T>,
}

impl<T: Copy> Tabulated<T> {
    fn new((least, greatest): (i64, i64), f: impl Fn(i64) -> T) -> Self {
        Tabulated { least, values: (least..=greatest).map(f).collect() }
    }

    fn at(&self, i: i64) -> T {
        self.values[(i - self.least) as usize]
    }
}

type SinCos = Tabulated<(f64, f64)>;

struct Spherical {
    pair: Pair,
    theta: SinCos,
    phi: SinCos,
}

impl Spherical {
    fn new(pair: Pair) -> Self {
        let [range, ..] = pair.range();
        let part = |p: i64| p as f64 / pair.steps() as f64;
        Spherical {
            pair,
            theta: Tabulated::new(range, |p| ((part(p) + 1.0) * FRAC_PI_2).sin_cos()),
            phi: Tabulated::new(range, |p| (part(p) * PI).sin_cos()),
        }
    }
}

impl Representation for Spherical {
    fn params(&self, [x, y, z]: [f64; 3]) -> Params<f64> {
        let theta = x.hypot(y).atan2(z);
        let phi = y.atan2(x);
        [2.0 * theta / PI - 1.0, phi / PI, 0.0].map(|p| p * self.pair.steps() as f64)
    }
    fn params_error(&self) -> f64 {
        steps_error(self.pair.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.pair.range()
    }
    fn vector(&self, [u, w, _]: Params<i64>) -> [f64; 3] {
        on_sphere(self.theta.at(u), self.phi.at(w))
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        self.pair.pack(params)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        self.pair.unpack(code)
    }
    /// A pole has azimuth 0, and the azimuth of -X is positive.
    fn canonical(&self, [u, w, _]: Params<i64>) -> Params<i64> {
        let greatest = self.pair.steps();
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
            Component::Unorm(pair) => pair.position(x),
            Component::Half => half::position(x),
        }
    }
    fn value(&self, param: i64) -> f64 {
        match self {
            Component::Unorm(pair) => pair.value(param),
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

/// x, y and z as biased unorm of so many bits, x in the low ones. Parameters count the values up
/// from -1, in odd multiples of 1 / steps.
struct Unorm(u32);

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

/// The codes of [`Unorm`], the length by which the fast encoder scales a vector from a table.
struct BestFit(Unorm);

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

/// Azimuth and z.
struct PhiZ {
    pair: Pair,
    phi: SinCos,
}

impl PhiZ {
    fn new(bits: u32) -> Self {
        let pair = Pair { bits, kind: Kind::Unorm };
        PhiZ { pair, phi: Tabulated::new(pair.range()[0], |p| (pair.value(p) * PI).sin_cos()) }
    }
}

impl Representation for PhiZ {
    fn params(&self, [x, y, z]: [f64; 3]) -> Params<f64> {
        [self.pair.position(y.atan2(x) / PI), self.pair.position(z), 0.0]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.pair.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        self.pair.range()
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        let z = self.pair.value(params[1]);
        on_sphere(((1.0 - z * z).sqrt(), z), self.phi.at(params[0]))
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        self.pair.pack(params)
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        self.pair.unpack(code)
    }
    /// The azimuth of a pole is the first above 0; that of -X is positive.
    fn canonical(&self, [phi, z, _]: Params<i64>) -> Params<i64> {
        let steps = self.pair.steps();
        let phi = if z == 0 || z == steps {
            (steps + 1) / 2
        } else if phi == 0 {
            steps
        } else {
            phi
        };
        [phi, z, 0]
    }
    fn nearby(&self, v: [f64; 3], _: f64) -> Vec<Params<i64>> {
        // Rows are far apart at the poles, where many hold points closer than the nearest row's.
        let [phi, z, _] = self.params(v).map(|p| p.floor() as i64);
        window(self.range(), [(phi, phi + 1), (z - 50, z + 51), (0, 0)])
    }
}

/// Parallels with equally many points, the poles included: `[parallel, point]`.
struct LatLong {
    bits: u32,
    count: i64,
    theta: SinCos,
    phi: SinCos,
}

impl LatLong {
    fn new(bits: u32) -> Self {
        let count = (1 << (bits / 2)) - 1;
        let part = |p: i64, of: i64| p as f64 / of as f64;
        LatLong {
            bits,
            count,
            theta: Tabulated::new((0, count - 1), |p| (part(p, count - 1) * PI).sin_cos()),
            phi: Tabulated::new((0, count), |p| (part(p, count) * TAU).sin_cos()),
        }
    }
}

/// Azimuth from 0 to 1.
fn turns([x, y, _]: [f64; 3]) -> f64 {
    let phi = y.atan2(x) / TAU;
    if phi < 0.0 { phi + 1.0 } else { phi }
}

/// Polar angle from 0 to 1.
fn colatitude([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).atan2(z) / PI
}

/// By sine and cosine of the polar angle and of the azimuth.
fn on_sphere(theta: (f64, f64), phi: (f64, f64)) -> [f64; 3] {
    [theta.0 * phi.1, theta.0 * phi.0, theta.1]
}

impl Representation for LatLong {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        [colatitude(v) * (self.count - 1) as f64, turns(v) * self.count as f64, 0.0]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.count)
    }
    /// The last point of a parallel is its first.
    fn range(&self) -> Params<(i64, i64)> {
        [(0, self.count - 1), (0, self.count), (0, 0)]
    }
    fn vector(&self, [parallel, point, _]: Params<i64>) -> [f64; 3] {
        on_sphere(self.theta.at(parallel), self.phi.at(point))
    }
    fn pack(&self, [parallel, point, _]: Params<i64>) -> u128 {
        (parallel * self.count + point) as u128
    }
    /// Indices beyond the last point read as the south pole.
    fn unpack(&self, code: u128) -> Params<i64> {
        let index = unsigned_field(code, 0, self.bits);
        if index < self.count * self.count {
            [index / self.count, index % self.count, 0]
        } else {
            [self.count - 1, 0, 0]
        }
    }
    /// A pole is the first point of its parallel.
    fn canonical(&self, [parallel, point, _]: Params<i64>) -> Params<i64> {
        let is_pole = parallel == 0 || parallel == self.count - 1;
        [parallel, if is_pole { 0 } else { point % self.count }, 0]
    }
}

/// Parallels with as many points as keep every direction within an angle.
struct LatLongD {
    bits: u32,
    /// The index of the first point of each parallel, and at the end how many points there are.
    begins: Vec<i64>,
    /// The parallel of every 2^[`STRIDE`]-th index.
    parallels: Vec<usize>,
    theta: SinCos,
}

const STRIDE: u32 = 12;

impl LatLongD {
    fn new(bits: u32) -> Self {
        // Parallels, and the least angle with which all points fit, in degrees, a little rounded up
        // so that f64 decides alike for all parallels that need a whole number of points.
        let (parallels, degrees, total) = match bits {
            16 => (227, 0.562_431_872_029_450_5, 65_536),
            24 => (3_629, 0.035_068_965_621_449_066, 16_777_216),
            _ => (58_073, 0.002_191_477_662_428_320_4, 4_294_967_295),
        };
        let last = parallels - 1;
        let e: f64 = f64::to_radians(degrees);
        let haversine = |angle: f64| (angle / 2.0).sin().powi(2);
        let points = |parallel: i64| {
            // Both hemispheres are alike, and to either side of the equator too.
            let from_pole = parallel.min(last - parallel);
            if from_pole == 0 {
                return 1;
            }
            let f = from_pole as f64 * PI / last as f64;
            let half_way = PI / (2.0 * last as f64);
            let g = f + half_way;
            // hav e = hav(g - f) + sin f sin g hav d
            let d = (haversine(e) - haversine(half_way)) / (f.sin() * g.sin());
            if d >= 1.0 { 1 } else { (PI / (2.0 * d.sqrt().asin())).ceil() as i64 }
        };
        let mut begins = vec![0];
        for parallel in 0..=last {
            begins.push(begins[parallel as usize] + points(parallel));
        }
        assert_eq!(begins[parallels as usize], total, "latlong{bits}D");
        let mut parallel = 0;
        let parallels = (0..total).step_by(1 << STRIDE).map(|index| {
            while begins[parallel + 1] <= index {
                parallel += 1;
            }
            parallel
        });
        let theta = |p: i64| (p as f64 / last as f64 * PI).sin_cos();
        let (parallels, theta) = (parallels.collect(), Tabulated::new((0, last), theta));
        LatLongD { bits, begins, parallels, theta }
    }

    fn last(&self) -> i64 {
        self.begins.len() as i64 - 2
    }

    fn count(&self, parallel: i64) -> i64 {
        self.begins[parallel as usize + 1] - self.begins[parallel as usize]
    }
}

impl Representation for LatLongD {
    /// Only the parallel: how many steps the azimuth has depends on it.
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        [colatitude(v) * self.last() as f64, 0.0, 0.0]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.last())
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, self.last()), (0, 0), (0, 0)]
    }
    fn rounded(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let (least, greatest) = rounding(self.params(v)[0], self.params_error());
        let mut all = Vec::new();
        for parallel in least.max(0)..=greatest.min(self.last()) {
            let count = self.count(parallel);
            let (first, last) = rounding(turns(v) * count as f64, steps_error(count));
            all.extend((first..=last).map(|point| [parallel, point.rem_euclid(count), 0]));
        }
        all
    }
    fn vector(&self, [parallel, point, _]: Params<i64>) -> [f64; 3] {
        let phi = point as f64 / self.count(parallel) as f64 * TAU;
        on_sphere(self.theta.at(parallel), phi.sin_cos())
    }
    fn pack(&self, [parallel, point, _]: Params<i64>) -> u128 {
        (self.begins[parallel as usize] + point) as u128
    }
    /// Indices beyond the last point read as the south pole.
    fn unpack(&self, code: u128) -> Params<i64> {
        let index = unsigned_field(code, 0, self.bits).min(self.begins[self.begins.len() - 1] - 1);
        let mut parallel = self.parallels[(index >> STRIDE) as usize];
        while self.begins[parallel + 1] <= index {
            parallel += 1;
        }
        [parallel as i64, index - self.begins[parallel], 0]
    }
    fn nearby(&self, v: [f64; 3], _: f64) -> Vec<Params<i64>> {
        let middle = self.params(v)[0].round() as i64;
        let mut all = Vec::new();
        for parallel in (middle - 3).max(0)..=(middle + 3).min(self.last()) {
            let count = self.count(parallel);
            let point = (turns(v) * count as f64).floor() as i64;
            all.extend([point, point + 1].map(|p| [parallel, p.rem_euclid(count), 0]));
        }
        all
    }
}

/// The largest component's axis, of equals the first, and the next two components in turn.
fn face_of(v: [f64; 3]) -> (usize, [f64; 3]) {
    let mut axis = 0;
    for other in 1..3 {
        if v[other].abs() > v[axis].abs() {
            axis = other;
        }
    }
    (axis, [v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3]])
}

/// The vector with `main` on the axis of a face and the other two components in turn.
fn on_face(face: i64, [a, b]: [f64; 2]) -> [f64; 3] {
    let axis = face as usize / 2;
    let mut v = [0.0; 3];
    v[axis] = if face % 2 == 0 { 1.0 } else { -1.0 };
    v[(axis + 1) % 3] = a;
    v[(axis + 2) % 3] = b;
    normalize(v)
}

fn face_number(axis: usize, main: f64) -> f64 {
    (2 * axis + usize::from(main < 0.0)) as f64
}

/// Two snorm parameters on a face: `[a, b, face]`, face = 2 axis + sign in the low three bits.
struct Cube {
    side: Pair,
    warped: bool,
    places: Tabulated<f64>,
}

impl Cube {
    fn new(bits: u32, warped: bool) -> Self {
        let side = Pair { bits: (bits - 3) / 2, kind: Kind::Snorm };
        let place = |p: i64| {
            let t = side.value(p);
            if warped { (t * FRAC_PI_4).tan() } else { t }
        };
        Cube { side, warped, places: Tabulated::new(side.range()[0], place) }
    }
}

impl Representation for Cube {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        let (axis, [main, a, b]) = face_of(v);
        let [a, b] = [a / main.abs(), b / main.abs()]
            .map(|t| if self.warped { t.atan() / FRAC_PI_4 } else { t })
            .map(|t| self.side.position(t));
        [a, b, face_number(axis, main)]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.side.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        let [a, b, _] = self.side.range();
        [a, b, (0, 5)]
    }
    fn reach(&self) -> Params<i64> {
        [2, 2, 0]
    }
    fn vector(&self, [a, b, face]: Params<i64>) -> [f64; 3] {
        on_face(face, [self.places.at(a), self.places.at(b)])
    }
    fn pack(&self, [a, b, face]: Params<i64>) -> u128 {
        let field = |p: i64| p as u128 & ((1 << self.side.bits) - 1);
        face as u128 | field(a) << 3 | field(b) << (3 + self.side.bits)
    }
    /// Faces 6 and 7 read as 4 and 5.
    fn unpack(&self, code: u128) -> Params<i64> {
        let face = unsigned_field(code, 0, 3);
        let side = |shift| signed_field(code, shift, self.side.bits).max(-self.side.steps());
        [side(3), side(3 + self.side.bits), if face > 5 { face - 2 } else { face }]
    }
    /// A point of an edge is on the face of the first of its axes.
    fn canonical(&self, [a, b, face]: Params<i64>) -> Params<i64> {
        let border = self.side.steps();
        let axis = face as usize / 2;
        let mut point = [0; 3];
        point[axis] = if face % 2 == 0 { border } else { -border };
        point[(axis + 1) % 3] = a;
        point[(axis + 2) % 3] = b;
        let first = (0..3).find(|&i| point[i].abs() == border).unwrap();
        let face = 2 * first as i64 + i64::from(point[first] < 0);
        [point[(first + 1) % 3], point[(first + 2) % 3], face]
    }
}

/// Cells of equal angles on a face: `[i, j, face]`, decoded to their centres.
struct AngularCube {
    bits: u32,
    cells: i64,
    places: Tabulated<f64>,
}

impl AngularCube {
    fn new(bits: u32) -> Self {
        // floor(sqrt(2^bits / 6)), counted so as not to rely on rounding.
        let fits = |s: i64| 6 * s * s <= 1 << bits;
        let near = (2f64.powi(bits as i32) / 6.0).sqrt() as i64;
        let cells = (near - 1..=near + 1).rev().find(|&s| fits(s)).unwrap();
        let centre = |i: i64| (FRAC_PI_4 * ((2 * i + 1 - cells) as f64 / cells as f64)).tan();
        AngularCube { bits, cells, places: Tabulated::new((0, cells - 1), centre) }
    }
}

impl Representation for AngularCube {
    /// In cells from the centre of the first, so that rounding finds the cell.
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        let (axis, [main, a, b]) = face_of(v);
        let [i, j] = [a, b]
            .map(|t| ((t / main.abs()).atan() / FRAC_PI_4 + 1.0) / 2.0 * self.cells as f64 - 0.5);
        [i, j, face_number(axis, main)]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.cells)
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, self.cells - 1), (0, self.cells - 1), (0, 5)]
    }
    fn reach(&self) -> Params<i64> {
        [2, 2, 0]
    }
    fn vector(&self, [i, j, face]: Params<i64>) -> [f64; 3] {
        on_face(face, [self.places.at(i), self.places.at(j)])
    }
    fn pack(&self, [i, j, face]: Params<i64>) -> u128 {
        ((i * self.cells + j) * 6 + face) as u128
    }
    /// Indices beyond the last cell read as the last.
    fn unpack(&self, code: u128) -> Params<i64> {
        let index = unsigned_field(code, 0, self.bits).min(6 * self.cells * self.cells - 1);
        [index / 6 / self.cells, index / 6 % self.cells, index % 6]
    }
}

/// Three signs and a point of the octant's triangle: `[i, j, signs]`, x's in the highest bit of
/// three.
struct Octant;

const OCTANT: i64 = 126;

impl Octant {
    /// A zero has no sign.
    fn is_negative([i, j, signs]: Params<i64>) -> [bool; 3] {
        let bit = |k: i64| signs >> k & 1 == 1;
        [bit(2) && i > 0, bit(1) && j > 0, bit(0) && i + j < OCTANT]
    }
}

impl Representation for Octant {
    /// Less a half, so that rounding truncates.
    fn params(&self, [x, y, z]: [f64; 3]) -> Params<f64> {
        let w = OCTANT as f64 / (x.abs() + y.abs() + z.abs());
        let signs = [x, y, z].iter().fold(0.0, |s, &c| 2.0 * s + f64::from(u8::from(c < 0.0)));
        [x.abs() * w - 0.5, y.abs() * w - 0.5, signs]
    }
    fn params_error(&self) -> f64 {
        steps_error(OCTANT)
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, OCTANT), (0, OCTANT), (0, 7)]
    }
    fn rounded(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let [i, j, signs] = self.params(v);
        let [i, j] = [i, j].map(|p| rounding(p, self.params_error()));
        // What f32 does not hold beside the largest component may read as zero, which has no sign.
        let largest = v.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        let certain = v
            .iter()
            .fold(0, |s, &c| 2 * s + i64::from(c < -largest * f64::from(f32::MIN_POSITIVE)));
        let signs = signs as i64;
        let any_of = |s: &i64| s & certain == certain && s & signs == *s;
        let all = (0..8).filter(any_of).flat_map(|s| window(self.range(), [i, j, (s, s)]));
        all.map(|[i, j, signs]| [i, j.min(OCTANT - i), signs]).collect()
    }
    fn vector(&self, [i, j, signs]: Params<i64>) -> [f64; 3] {
        // A search looks beyond the triangle too: the point on its edge.
        let j = j.min(OCTANT - i);
        let magnitudes = [i, j, OCTANT - i - j];
        let negative = Self::is_negative([i, j, signs]);
        normalize(std::array::from_fn(|k| {
            if negative[k] { -magnitudes[k] as f64 } else { magnitudes[k] as f64 }
        }))
    }
    fn pack(&self, [i, j, signs]: Params<i64>) -> u128 {
        let (i, j) = if i >= 64 { (127 - i, 127 - j) } else { (i, j) };
        (signs << 13 | i << 7 | j) as u128
    }
    /// What would have a third component of -1 reads as the neighbour with i one less.
    fn unpack(&self, code: u128) -> Params<i64> {
        let (i, j) = (unsigned_field(code, 7, 6), unsigned_field(code, 0, 7));
        let (i, j) = if i + j >= 127 { (127 - i, 127 - j) } else { (i, j) };
        [if i + j > OCTANT { i - 1 } else { i }, j, unsigned_field(code, 13, 3)]
    }
    fn canonical(&self, [i, j, signs]: Params<i64>) -> Params<i64> {
        let negative = Self::is_negative([i, j, signs]);
        [i, j, negative.iter().fold(0, |s, &negative| 2 * s + i64::from(negative))]
    }
}

enum Projection {
    Stereo,
    EqArea,
    EqDist,
}

#[derive(PartialEq)]
enum Stretch {
    Plain,
    Concentric,
    Ellipse,
}

/// A hemisphere on a disk, the disk on a square: `[column, row, lower]` with columns from 0 to
/// `steps` and rows from -`steps` to `steps`.
struct Disk {
    pair: Pair,
    projection: Projection,
    stretch: Stretch,
}

impl Disk {
    /// How far from the middle of the disk a direction stands, by the cosine and sine of its angle
    /// from the pole of the hemisphere; in the other hemisphere, beyond 1.
    fn radius(&self, cos: f64, sin: f64) -> f64 {
        let angle = sin.atan2(cos);
        match self.projection {
            Projection::Stereo => (angle / 2.0).tan(),
            Projection::EqArea => SQRT_2 * (angle / 2.0).sin(),
            Projection::EqDist => angle / FRAC_PI_2,
        }
    }

    /// The angle from the pole at a radius.
    fn polar_angle(&self, radius: f64) -> f64 {
        match self.projection {
            Projection::Stereo => 2.0 * radius.atan(),
            Projection::EqArea => 2.0 * (radius / SQRT_2).min(1.0).asin(),
            Projection::EqDist => radius * FRAC_PI_2,
        }
    }

    /// Column and row in the chart of one hemisphere.
    fn position(&self, [x, y, z]: [f64; 3], lower: bool) -> [f64; 2] {
        let h = x.hypot(y);
        let z = if lower { -z } else { z };
        let r = self.radius(z, h);
        let (dx, dy) = if h == 0.0 { (1.0, 0.0) } else { (x / h, y / h) };
        let (disk_x, disk_y) = (r * dx, r * dy);
        let [u, v] = match self.stretch {
            Stretch::Plain => [disk_x, disk_y],
            Stretch::Concentric => {
                let along = |a: f64, b: f64| r * b.atan2(a.abs()) / FRAC_PI_4;
                if dx.abs() >= dy.abs() {
                    [sign(dx) * r, along(dx, dy)]
                } else {
                    [along(dy, dx), sign(dy) * r]
                }
            }
            Stretch::Ellipse => {
                let difference = disk_x * disk_x - disk_y * disk_y;
                // (2 + X^2 - Y^2)^2 - 8 X^2, by 1 - r^2.
                let q = (4.0 * (1.0 - r) * (1.0 + r) + difference * difference).max(0.0).sqrt();
                let place = |c: f64, sum: f64| 2.0 * c / sum.sqrt();
                [place(disk_x, 2.0 + difference + q), place(disk_y, 2.0 - difference + q)]
            }
        };
        let steps = self.pair.steps() as f64;
        [(u / 2.0 + 0.5) * steps, v * steps]
    }

    fn square(&self, [column, row, _]: Params<i64>) -> [f64; 2] {
        let steps = self.pair.steps();
        [(2 * column - steps) as f64 / steps as f64, row as f64 / steps as f64]
    }

    /// Of a plain chart's points past the equator, the same point in the other chart if it is one
    /// there too.
    fn own_chart(&self, params: Params<i64>, past: bool) -> Params<i64> {
        if !past {
            return params;
        }
        let lower = 1 - params[2];
        let exact = self.position(self.vector(params), lower == 1);
        let near = exact.map(f64::round);
        let is_whole = (0..2).all(|i| (exact[i] - near[i]).abs() < 1e-7);
        if is_whole { [near[0] as i64, near[1] as i64, lower] } else { params }
    }

    /// The points of a plain chart within an angle of `v`, and some more: those of a sector of a
    /// ring.
    fn sector(&self, v: [f64; 3], lower: bool, within: f64) -> Vec<Params<i64>> {
        let h = v[0].hypot(v[1]);
        let angle = h.atan2(if lower { -v[2] } else { v[2] });
        let [near, far] = [(angle - within).max(0.0), (angle + within).min(PI)];
        let corner = SQRT_2 * 1.000_001;
        if near > self.polar_angle(corner) {
            return Vec::new();
        }
        let far = far.min(self.polar_angle(corner));
        let [near, far] = [near, far].map(|a| self.radius(a.cos(), a.sin()));
        let azimuth = v[1].atan2(v[0]);
        let spread = if h <= within.sin() { PI } else { (within.sin() / h).asin() };
        // Least and greatest of r cos(a - b) in the sector.
        let extent = |b: f64| {
            let middle = (azimuth - b + 3.0 * PI).rem_euclid(TAU) - PI;
            let ends = [(middle - spread).cos(), (middle + spread).cos()];
            let greatest = if middle.abs() <= spread { 1.0 } else { ends[0].max(ends[1]) };
            let least = if PI - middle.abs() <= spread { -1.0 } else { ends[0].min(ends[1]) };
            [(near * least).min(far * least), (near * greatest).max(far * greatest)]
        };
        let steps = self.pair.steps();
        let [u, v] = [extent(0.0), extent(FRAC_PI_2)];
        let column = |u: f64| ((u / 2.0 + 0.5) * steps as f64).clamp(0.0, steps as f64);
        let row = |v: f64| (v * steps as f64).clamp(-steps as f64, steps as f64);
        let (bottom, top) = (row(v[0]).floor() as i64, row(v[1]).ceil() as i64);
        let mut found = Vec::new();
        for column in column(u[0]).floor() as i64..=column(u[1]).ceil() as i64 {
            let [u, _] = self.square([column, 0, 0]);
            if u.abs() > far {
                continue;
            }
            let reach = |r: f64| (r * r - u * u).max(0.0).sqrt() * steps as f64;
            let (inner, outer) = (reach(near).floor() as i64, reach(far).ceil() as i64);
            for rows in
                [(-outer).max(bottom)..=(-inner).min(top), inner.max(bottom)..=outer.min(top)]
            {
                let rows = rows.filter(|row| row.abs() <= steps);
                found.extend(rows.map(|row| [column, row, i64::from(lower)]));
            }
        }
        found
    }
}

impl Representation for Disk {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        let lower = v[2] < 0.0;
        let [column, row] = self.position(v, lower);
        [column, row, f64::from(u8::from(lower))]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.pair.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        let steps = self.pair.steps();
        [(0, steps), (-steps, steps), (0, 1)]
    }
    fn reach(&self) -> Params<i64> {
        [4, 4, 0]
    }
    fn rounded(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let lower = i64::from(v[2] < 0.0);
        let [column, row] = self.position(v, lower == 1).map(|p| rounding(p, self.params_error()));
        let hemisphere = if v[2].abs() < 1e-30 { (0, 1) } else { (lower, lower) };
        let [columns, rows, _] = self.range();
        let clamp = |(a, b): (i64, i64), range: (i64, i64)| {
            (a.clamp(range.0, range.1), b.clamp(range.0, range.1))
        };
        window(self.range(), [clamp(column, columns), clamp(row, rows), hemisphere])
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        let [u, v] = self.square(params);
        let (x, y) = match self.stretch {
            Stretch::Plain => (u, v),
            Stretch::Concentric if u.abs() >= v.abs() => {
                let (sin, cos) = (FRAC_PI_4 * v / u).sin_cos();
                (u * cos, u * sin)
            }
            Stretch::Concentric => {
                let (sin, cos) = (FRAC_PI_4 * u / v).sin_cos();
                (v * sin, v * cos)
            }
            Stretch::Ellipse => (u * (1.0 - v * v / 2.0).sqrt(), v * (1.0 - u * u / 2.0).sqrt()),
        };
        // The cosine of the angle from the pole, and its sine over the radius.
        let rr = x * x + y * y;
        let (cos, k) = match self.projection {
            Projection::Stereo => ((1.0 - rr) / (1.0 + rr), 2.0 / (1.0 + rr)),
            Projection::EqArea => (1.0 - rr, (2.0 - rr).max(0.0).sqrt()),
            Projection::EqDist => {
                let r = rr.sqrt();
                let (sin, cos) = (r * FRAC_PI_2).sin_cos();
                (cos, sin / r)
            }
        };
        let z = if params[2] == 1 { -cos } else { cos };
        [x * k, y * k, z]
    }
    /// Column 0 has no sign of its own: it is the upper hemisphere's.
    fn pack(&self, [column, row, lower]: Params<i64>) -> u128 {
        self.pair.pack([if lower == 1 { -column } else { column }, row, 0])
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        let [u, row, _] = self.pair.unpack(code);
        [u.abs(), row, i64::from(u < 0)]
    }
    /// The equator is the upper hemisphere's. A direction past it that has a code in the chart of
    /// its own hemisphere has that. Corners that are the other pole have all signs positive.
    fn canonical(&self, [column, row, lower]: Params<i64>) -> Params<i64> {
        let steps = self.pair.steps();
        let u = 2 * column - steps;
        let from_equator = match self.stretch {
            Stretch::Plain => u * u + row * row - steps * steps,
            _ => u.abs().max(row.abs()) - steps,
        };
        let lower = if column == 0 || from_equator == 0 { 0 } else { lower };
        if matches!((&self.projection, &self.stretch), (Projection::EqArea, Stretch::Plain))
            && (u.abs(), row.abs()) == (steps, steps)
        {
            return [steps, steps, lower];
        }
        self.own_chart([column, row, lower], from_equator > 0)
    }
    fn nearby(&self, v: [f64; 3], cell: f64) -> Vec<Params<i64>> {
        let lower = v[2] < 0.0;
        let at = |v: [f64; 3], lower: bool| {
            let middle = self.position(v, lower).map(|p| p.round() as i64);
            let middle = [middle[0], middle[1], i64::from(lower)];
            // The ellipse's cells are sheared towards the corners.
            let corner = v[2].abs() < 0.01 && (v[0].abs() - v[1].abs()).abs() < 0.03;
            let sheared = corner && self.stretch == Stretch::Ellipse;
            let reach = if sheared { [24, 48, 0] } else { self.reach() };
            window(self.range(), around(middle, reach))
        };
        let mut found = at(v, lower);
        if self.stretch == Stretch::Plain {
            let within = found.iter().map(|&p| chord_squared(self.vector(p), v));
            let within = 2.0 * (within.fold(4.0, f64::min).sqrt() / 2.0).asin() + 1e-9;
            found.extend(self.sector(v, !lower, within));
        } else if v[2].abs() < 4.0 * cell {
            found.extend(at([v[0], v[1], 0.0], !lower));
        }
        // Column 0 of the lower hemisphere does not exist.
        found.retain(|&[column, _, lower]| column > 0 || lower == 0);
        found
    }
}

/// All vertices, in the order of their codes.
struct Icosphere(Vec<[f64; 3]>);

impl Icosphere {
    fn new() -> Self {
        let phi = (1.0 + 5f64.sqrt()) / 2.0;
        let corners = [[1.0, 0.0, phi], [phi, 1.0, 0.0], [0.0, phi, 1.0], [-1.0, 0.0, phi]];
        let point = |corners: [[f64; 3]; 4], weights: [i32; 4]| -> [f64; 3] {
            let component = |i: usize| {
                corners.iter().zip(weights).map(|(c, weight)| c[i] * f64::from(weight)).sum()
            };
            normalize([0, 1, 2].map(component))
        };
        let numbered = [
            [3, 1, 0, 0],
            [3, 0, 1, 0],
            [2, 2, 0, 0],
            [2, 1, 1, 0],
            [2, 0, 1, 1],
            [4, 0, 0, 0],
            [3, 0, 0, 1],
            [1, 0, 2, 1],
            [2, 0, 0, 2],
        ];
        let mut all = Vec::new();
        for weights in numbered {
            let mut v = point(corners, weights);
            for _ in 0..3 {
                // Each sign in turn, that of x fastest, of components that have one.
                for signs in 0..8 {
                    let image: [f64; 3] =
                        std::array::from_fn(|i| if signs >> i & 1 == 1 { -v[i] } else { v[i] });
                    if (0..3).all(|i| v[i] > 1e-9 || signs >> i & 1 == 0) {
                        all.push(image);
                    }
                }
                v.rotate_right(1);
            }
        }
        // The same set from the faces of the solid: every triple of corners an edge apart.
        let solid: Vec<[f64; 3]> = (0..12)
            .map(|i: usize| {
                let [a, b] = [i % 2, i / 2 % 2].map(|minus| 1.0 - 2.0 * minus as f64);
                let mut v = [a, 0.0, b * phi];
                v.rotate_right(i / 4);
                v
            })
            .collect();
        let edge = |i: usize, j: usize| (chord_squared(solid[i], solid[j]) - 4.0).abs() < 1e-9;
        for i in 0..12 {
            for j in (0..i).filter(|&j| edge(i, j)) {
                for k in (0..j).filter(|&k| edge(i, k) && edge(j, k)) {
                    for (a, b) in (0..=4).flat_map(|a| (0..=4 - a).map(move |b| (a, b))) {
                        let face = [solid[i], solid[j], solid[k], [0.0; 3]];
                        let v = point(face, [a, b, 4 - a - b, 0]);
                        let same = all.iter().filter(|w| chord_squared(v, **w) < 1e-18).count();
                        assert_eq!(same, 1, "{v:?}");
                    }
                }
            }
        }
        assert_eq!(all.len(), 162);
        Icosphere(all)
    }

    fn nearest(&self, v: [f64; 3]) -> (usize, f64) {
        let distances = self.0.iter().map(|w| chord_squared(v, *w)).enumerate();
        distances.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
    }
}

impl Representation for Icosphere {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        [self.nearest(v).0 as f64, 0.0, 0.0]
    }
    fn params_error(&self) -> f64 {
        0.0
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, 161), (0, 0), (0, 0)]
    }
    fn vector(&self, [index, _, _]: Params<i64>) -> [f64; 3] {
        self.0[index as usize]
    }
    fn pack(&self, [index, _, _]: Params<i64>) -> u128 {
        index as u128
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        [unsigned_field(code, 0, 8).min(161), 0, 0]
    }
    fn rounded(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let (_, least) = self.nearest(v);
        let close = |&i: &i64| chord_squared(v, self.0[i as usize]) < least + 1e-6;
        (0..162).filter(close).map(|i| [i, 0, 0]).collect()
    }
    fn nearby(&self, _: [f64; 3], _: f64) -> Vec<Params<i64>> {
        (0..162).map(|i| [i, 0, 0]).collect()
    }
}
