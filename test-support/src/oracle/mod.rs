//! Each representation once more, in `f64` and as plainly as can be, from its published definition.
//! Nothing here is shared with `src/`, nor written with an eye on it: a mistake would have to be
//! made twice to go unnoticed.
//!
//! A representation is integer parameters, the point on the sphere that each tuple means, and the
//! places of the parameters in a code. [`Oracle`] makes the rest from that: both directions, which
//! codes a fast encoder may give, and which codes lie near a vector.
//!
//! One file holds one family, under the name that its formula has in the crate. This file holds the
//! list of all formats, [`find`], and what the families share.

mod cartesian;
mod cube;
mod disk;
mod fibonacci;
mod front_oct;
mod half;
mod hemi_oct;
mod icosphere;
mod latlong;
mod oct;
mod octant;
mod phi_z;
mod spherical;
mod xy_only;

use std::f64::consts::PI;

use crate::vectors::{chord_squared, cross, length, normalize};
use cartesian::{BestFit, Float16, Float32, InWords, Snorm, Unorm};
use cube::{AngularCube, Cube};
use disk::{Disk, Projection, Stretch};
use fibonacci::Fibonacci;
pub use fibonacci::point as fibonacci_point;
use front_oct::FrontOct;
use hemi_oct::{HemiOct, SignedOct};
use icosphere::Icosphere;
use latlong::{LatLong, LatLongD};
use oct::{Central, EqualArea, Oct, Warped};
use octant::Octant;
use phi_z::PhiZ;
use spherical::Spherical;
use xy_only::{Component, XyOnly};

/// Parameters of a code; those it does not have are 0.
type Params<T> = [T; 3];

trait Representation: Send + Sync {
    /// Of a unit vector, in steps, before rounding.
    fn params(&self, v: [f64; 3]) -> Params<f64>;
    /// How far `f32` arithmetic may put a parameter off, in steps.
    fn params_error(&self) -> f64;
    /// Least and greatest value of each parameter.
    fn range(&self) -> Params<(i64, i64)>;
    /// The unit vector that parameters in range mean.
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

    /// All tuples that rounding the parameters of `v` may give: one, and more where `f32` cannot
    /// tell a parameter from a tie.
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

/// The integers that `p`, known to within `error`, may be rounded to: the least and the greatest.
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

/// What is right for one format.
pub struct Oracle {
    representation: Box<dyn Representation>,
    bits: u32,
}

impl Oracle {
    /// The direction of an input; only that matters. Zero and NaN are +Z, infinities
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

    /// The unit vector that a code means, exactly.
    pub fn decode(&self, code: u128) -> [f64; 3] {
        self.representation.vector(self.representation.unpack(code))
    }

    /// The unit vectors that the codes from `first` on mean.
    pub fn decode_from(&self, first: u128, vectors: &mut [[f64; 3]]) {
        self.representation.vectors_from(first, vectors);
    }

    /// The code that encoders give for what `code` decodes to.
    pub fn canonical(&self, code: u128) -> u128 {
        let params = self.representation.unpack(code);
        self.representation.pack(self.representation.canonical(params))
    }

    /// Every code that the fast encoder may give: one, and more where `f32` cannot tell a parameter
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
}

/// The oracle of a format, by its name.
///
/// # Panics
/// If the list of [`find`] has no row for it.
#[track_caller]
pub fn oracle(name: &str) -> Oracle {
    find(name).unwrap_or_else(|| {
        panic!("{name} has no oracle: add a row to `find` in test-support/src/oracle/mod.rs")
    })
}

/// The oracle of a format, by its name; `None` for an unknown name. This is the list of all
/// formats.
pub fn find(name: &str) -> Option<Oracle> {
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
        ("XYOnly", 1..) => (size, Box::new(XyOnly::kept(Component::Steps(pair(Kind::Unorm))))),
        ("XYOnly32F", 0) => (32, Box::new(XyOnly::kept(Component::Half))),
        ("XYOnly-normalized", 16) => (16, Box::new(XyOnly::normalized(pair(Kind::Unorm)))),
        ("XYOnly-snorm", 16) => (16, Box::new(XyOnly::normalized(pair(Kind::Snorm)))),
        ("XYOnly-biased", 16) => (16, Box::new(XyOnly::normalized(pair(Kind::Around128)))),
        ("snorm5x", 3) => (15, Box::new(Snorm::new([5, 5, 5]))),
        ("snorm8x", 3) => (24, Box::new(Snorm::new([8, 8, 8]))),
        ("snorm10x", 3) => (30, Box::new(Snorm::new([10, 10, 10]))),
        ("snorm11-11-", 10) => (32, Box::new(Snorm::new([11, 11, 10]))),
        ("snorm12x", 3) => (48, Box::new(InWords(Snorm::new([12, 12, 12])))),
        ("snorm16x", 3) => (48, Box::new(Snorm::new([16, 16, 16]))),
        ("float16x", 3) => (48, Box::new(Float16)),
        ("float32x", 3) => (96, Box::new(Float32)),
        ("latlong", 1..) => (size, Box::new(LatLong::new(size))),
        ("cube", 1..) => (size, Box::new(Cube::new(size, false))),
        ("warpedcube", 1..) => (size, Box::new(Cube::new(size, true))),
        ("angularcube", 1..) => (size, Box::new(AngularCube::new(size))),
        ("octant", 16) => (16, Box::new(Octant)),
        ("icosphere", 162) => (8, Box::new(Icosphere::new())),
        ("xyz-unorm8x", 3) => (24, Box::new(Unorm(8))),
        ("xyz-biased8x", 3) => (24, Box::new(Snorm::around_128())),
        ("xyz-unorm10x", 3) => (30, Box::new(Unorm(10))),
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
    /// Snorm bytes, as unsigned ones of which 128 is zero.
    Around128,
}

impl Pair {
    /// Steps from 0 to 1.
    fn steps(self) -> i64 {
        match self.kind {
            Kind::Snorm | Kind::Around128 => snorm_steps(self.bits),
            Kind::Sixes => snorm_steps(self.bits) / 6 * 6,
            Kind::Unorm => (1 << self.bits) - 1,
        }
    }

    /// The place of a number from -1 to 1, in steps.
    fn position(self, t: f64) -> f64 {
        match self.kind {
            Kind::Snorm | Kind::Sixes | Kind::Around128 => t * self.steps() as f64,
            Kind::Unorm => (t + 1.0) / 2.0 * self.steps() as f64,
        }
    }

    /// The number from -1 to 1 that `param` means.
    fn value(self, param: i64) -> f64 {
        let steps = self.steps();
        match self.kind {
            Kind::Snorm | Kind::Sixes | Kind::Around128 => param as f64 / steps as f64,
            // The numerator is whole, so that values are symmetric about 0.
            Kind::Unorm => (2 * param - steps) as f64 / steps as f64,
        }
    }

    /// The parameter of the same magnitude, not negative.
    fn magnitude(self, param: i64) -> i64 {
        match self.kind {
            Kind::Snorm | Kind::Sixes | Kind::Around128 => param.abs(),
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
            let zero = if self.kind == Kind::Around128 { 128 } else { 0 };
            let field = |p: i64| (p + zero) as u128 & ((1 << self.bits) - 1);
            field(u) | field(v) << self.bits
        }
    }

    fn unpack(self, code: u128) -> Params<i64> {
        let [u, v] = if self.bits == 12 {
            let [r, g, b] = [0, 8, 16].map(|shift| unsigned_field(code, shift, 8));
            let bias = if self.kind == Kind::Unorm { 0 } else { 2047 };
            [(r << 4 | g >> 4) - bias, ((g & 15) << 8 | b) - bias]
        } else if self.kind == Kind::Around128 {
            [0, 8].map(|shift| unsigned_field(code, shift, 8) - 128)
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

/// By sine and cosine of the polar angle and of the azimuth.
fn on_sphere(theta: (f64, f64), phi: (f64, f64)) -> [f64; 3] {
    [theta.0 * phi.1, theta.0 * phi.0, theta.1]
}
