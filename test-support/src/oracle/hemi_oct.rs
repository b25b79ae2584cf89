//! Hemi-oct, and signedoct, which is hemi-oct of either hemisphere.

use super::{Pair, Params, Representation, normalize, steps_error, unsigned_field};

pub(super) struct HemiOct(pub(super) Pair);

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
pub(super) struct SignedOct(pub(super) HemiOct);

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
