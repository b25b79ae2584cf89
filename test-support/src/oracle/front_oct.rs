//! frontoct and quadfrontoct: oct of a direction that is scaled first.

use super::oct::Oct;
use super::{Params, Representation, normalize};

/// Oct of the direction that a scaling of the stereographic plane leads to.
pub(super) struct FrontOct(pub(super) Oct, pub(super) f64);

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
