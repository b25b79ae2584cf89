//! phi-z: azimuth and z.

use std::f64::consts::PI;

use super::{
    Kind, Pair, Params, Representation, SinCos, Tabulated, on_sphere, steps_error, window,
};

/// Azimuth and z.
pub(super) struct PhiZ {
    pair: Pair,
    phi: SinCos,
}

impl PhiZ {
    pub(super) fn new(bits: u32) -> Self {
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
