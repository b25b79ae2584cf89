//! latlong, with equally many points on each parallel, and latlongD, with fewer towards the poles.

use std::f64::consts::{PI, TAU};

use super::{
    Params, Representation, SinCos, Tabulated, on_sphere, rounding, steps_error, unsigned_field,
};

/// Parallels with equally many points, the poles included: `[parallel, point]`.
pub(super) struct LatLong {
    bits: u32,
    count: i64,
    theta: SinCos,
    phi: SinCos,
}

impl LatLong {
    pub(super) fn new(bits: u32) -> Self {
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
pub(super) struct LatLongD {
    bits: u32,
    /// The index of the first point of each parallel, and at the end how many points there are.
    begins: Vec<i64>,
    /// The parallel of every 2^[`STRIDE`]-th index.
    parallels: Vec<usize>,
    theta: SinCos,
}

const STRIDE: u32 = 12;

impl LatLongD {
    pub(super) fn new(bits: u32) -> Self {
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

/// Azimuth from 0 to 1.
fn turns([x, y, _]: [f64; 3]) -> f64 {
    let phi = y.atan2(x) / TAU;
    if phi < 0.0 { phi + 1.0 } else { phi }
}

/// Polar angle from 0 to 1.
fn colatitude([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).atan2(z) / PI
}
