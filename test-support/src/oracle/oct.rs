//! The octahedral families: oct, warpedoct, eqareaoct, sixoct and oct-unorm.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::{Pair, Params, Representation, normalize, sign, steps_error};

/// Between the sphere and the octahedron |x| + |y| + |z| = 1.
pub(super) trait Octahedral: Send + Sync {
    fn to_octahedron(&self, v: [f64; 3]) -> [f64; 3];
    fn to_sphere(&self, p: [f64; 3]) -> [f64; 3];
}

pub(super) struct Central;

impl Octahedral for Central {
    fn to_octahedron(&self, v: [f64; 3]) -> [f64; 3] {
        let k = 1.0 / v.iter().map(|c| c.abs()).sum::<f64>();
        v.map(|c| c * k)
    }
    fn to_sphere(&self, p: [f64; 3]) -> [f64; 3] {
        normalize(p)
    }
}

/// Each coordinate t of the octahedron means t (1 + (k + q t) (1 - t)).
pub(super) struct Warped;

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
pub(super) struct EqualArea;

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

pub(super) struct Oct(pub(super) Pair, pub(super) &'static dyn Octahedral);

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
