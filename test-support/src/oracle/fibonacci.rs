//! Spherical Fibonacci.

use std::f64::consts::TAU;

use super::{Params, Representation, chord_squared};

/// Point `i` of `n`.
pub fn point(i: u32, n: u32) -> [f64; 3] {
    let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(n);
    let (sin, cos) = (TAU * turns(i.into())).sin_cos();
    let r = ((1.0 - z) * (1.0 + z)).sqrt();
    [r * cos, r * sin, z]
}

fn turns(i: i64) -> f64 {
    f64::from((i as u32).wrapping_mul(0x9E37_79B9)) / 2f64.powi(32)
}

/// The nearest point is looked for in a lattice basis that Gauss's reduction finds.
pub(super) struct Fibonacci {
    pub(super) points: i64,
}

impl Fibonacci {
    fn near(&self, v: [f64; 3]) -> Vec<i64> {
        let n = self.points as f64;
        let height = n * (1.0 - v[2]) / 2.0 - 0.5;
        let start = height.round() as i64;
        let off = v[1].atan2(v[0]) / TAU - turns(start);
        let target = [height - start as f64, off - off.round()];
        // Steps in index and turns, as lengths on the sphere.
        let r = v[0].hypot(v[1]).max(2.0 / n.sqrt());
        let dot = |a: [f64; 2], b: [f64; 2]| {
            a[0] * b[0] * (2.0 / (n * r)).powi(2) + a[1] * b[1] * (TAU * r).powi(2)
        };
        let (mut a, mut b) = ([1.0, turns(1)], [0.0, 1.0]);
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
        point(i as u32, self.points as u32)
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
