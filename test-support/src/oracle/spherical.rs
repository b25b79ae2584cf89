//! Polar angle and azimuth.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Pair, Params, Representation, SinCos, Tabulated, on_sphere, steps_error};

pub(super) struct Spherical {
    pair: Pair,
    theta: SinCos,
    phi: SinCos,
}

impl Spherical {
    pub(super) fn new(pair: Pair) -> Self {
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
