//! XYOnly: x and y on a grid each, z from the unit length.

use super::cartesian::{Float16, greatest_common_divisor};
use super::{Kind, Pair, Params, Representation, half, normalize, sign, steps_error, window};

/// x and y on a grid each, z from the unit length.
pub(super) struct XyOnly {
    component: Component,
    rim: Rim,
}

pub(super) enum Component {
    Steps(Pair),
    Half,
}

/// What codes beyond the rim mean.
#[derive(PartialEq)]
enum Rim {
    /// The smaller component, with the larger one on the rim.
    Kept,
    /// The direction of (x, y, 0).
    Normalized,
}

impl Component {
    fn position(&self, x: f64) -> f64 {
        match self {
            Component::Steps(pair) => pair.position(x),
            Component::Half => half::position(x),
        }
    }
    fn value(&self, param: i64) -> f64 {
        match self {
            Component::Steps(pair) => pair.value(param),
            Component::Half => half::value(param),
        }
    }
    fn negate(&self, param: i64) -> i64 {
        match self {
            Component::Steps(pair) if pair.kind == Kind::Unorm => pair.steps() - param,
            Component::Steps(_) => -param,
            Component::Half => -param,
        }
    }
    /// The first grid point at or above x >= 0.
    fn at_least(&self, x: f64) -> i64 {
        self.position(x).ceil() as i64
    }
}

impl XyOnly {
    pub(super) fn kept(component: Component) -> Self {
        XyOnly { component, rim: Rim::Kept }
    }
    pub(super) fn normalized(pair: Pair) -> Self {
        XyOnly { component: Component::Steps(pair), rim: Rim::Normalized }
    }

    fn is_beyond(&self, [x, y, _]: Params<i64>) -> bool {
        let (x, y) = (self.component.value(x), self.component.value(y));
        x * x + y * y >= 1.0
    }

    /// The point of the rim that a code beyond it means: the smaller component's parameter,
    /// cut where the diagonal has passed it, and whether that component is x.
    fn smaller(&self, [x, y, _]: Params<i64>) -> (i64, bool) {
        let x_is_smaller = self.component.value(x).abs() < self.component.value(y).abs();
        let p = if x_is_smaller { x } else { y };
        let cut = self.component.at_least(0.5f64.sqrt());
        let magnitude =
            if self.component.value(p) < 0.0 { self.component.negate(p) } else { p }.min(cut);
        (
            if self.component.value(p) < 0.0 {
                self.component.negate(magnitude)
            } else {
                magnitude
            },
            x_is_smaller,
        )
    }

    /// Of the points in the direction of one beyond the rim, the nearest to the rim.
    fn first_in_direction(&self, [x, y, _]: Params<i64>) -> Params<i64> {
        let Component::Steps(pair) = self.component else { unreachable!("halves keep") };
        // A point is a number of steps, of unorm an odd one of half ones.
        let (doubled, steps) = (i64::from(pair.kind == Kind::Unorm) + 1, pair.steps());
        let offset = (doubled - 1) * steps;
        let point = [x, y].map(|p| doubled * p - offset);
        let divisor = greatest_common_divisor(point[0], point[1]);
        let multiples = (1..=divisor).step_by(doubled as usize);
        let points = multiples.map(|n| point.map(|p| p / divisor * n));
        let mut beyond = points.filter(|[i, j]| i * i + j * j >= steps * steps);
        let [i, j] = beyond.next().unwrap().map(|p| (p + offset) / doubled);
        [i, j, 0]
    }

    /// Beside the direction of `v`, those of codes of every length.
    fn of_every_length(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let range = self.range();
        let mut found = Vec::new();
        for long in range[0].0..=range[0].1 {
            let scale = |c: f64| self.component.value(long).abs() / c.abs().max(1e-300);
            let beside = |c: f64| self.component.position(c.clamp(-1.0, 1.0)).floor() as i64;
            let y = beside(v[1] * scale(v[0]));
            let x = beside(v[0] * scale(v[1]));
            found.extend(window(range, [(long, long), (y, y + 1), (0, 0)]));
            found.extend(window(range, [(x, x + 1), (long, long), (0, 0)]));
        }
        found
    }
}

impl Representation for XyOnly {
    fn params(&self, [x, y, _]: [f64; 3]) -> Params<f64> {
        [self.component.position(x), self.component.position(y), 0.0]
    }
    fn params_error(&self) -> f64 {
        match self.component {
            Component::Steps(pair) => steps_error(pair.steps()),
            Component::Half => Float16.params_error(),
        }
    }
    fn range(&self) -> Params<(i64, i64)> {
        match self.component {
            Component::Steps(pair) => pair.range(),
            Component::Half => [(-half::ONE, half::ONE), (-half::ONE, half::ONE), (0, 0)],
        }
    }
    fn vector(&self, params: Params<i64>) -> [f64; 3] {
        let [x, y] = [params[0], params[1]].map(|p| self.component.value(p));
        if !self.is_beyond(params) {
            return [x, y, (1.0 - x * x - y * y).sqrt()];
        }
        if self.rim == Rim::Normalized {
            return normalize([x, y, 0.0]);
        }
        let (small, x_is_smaller) = self.smaller(params);
        let small = self.component.value(small);
        let large = (1.0 - small * small).sqrt();
        if x_is_smaller { [small, large * sign(y), 0.0] } else { [large * sign(x), small, 0.0] }
    }
    fn pack(&self, params: Params<i64>) -> u128 {
        match self.component {
            Component::Steps(pair) => pair.pack(params),
            Component::Half => half::bits(params[0]) | half::bits(params[1]) << 16,
        }
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        match self.component {
            Component::Steps(pair) => pair.unpack(code),
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
        if self.rim == Rim::Normalized {
            return self.first_in_direction(params);
        }
        let (small, x_is_smaller) = self.smaller(params);
        let value = self.component.value(small);
        let large = self.component.at_least((1.0 - value * value).sqrt());
        // It must remain the larger one; x is on a tie.
        let magnitude = if value < 0.0 { self.component.negate(small) } else { small };
        let large = large.max(if x_is_smaller { magnitude + 1 } else { magnitude });
        let signed = |old: i64| {
            if self.component.value(old) < 0.0 { self.component.negate(large) } else { large }
        };
        if x_is_smaller { [small, signed(params[1]), 0] } else { [signed(params[0]), small, 0] }
    }
    fn nearby(&self, v: [f64; 3], _: f64) -> Vec<Params<i64>> {
        let range = self.range();
        let (greatest, swap) =
            (range[0].1, |p: Params<i64>, swapped: bool| if swapped { [p[1], p[0], 0] } else { p });
        let mut found = match self.rim {
            Rim::Kept => Vec::new(),
            Rim::Normalized => self.of_every_length(v),
        };
        for swapped in [false, true] {
            // The points of one column lie on a circle about its axis; the nearest to v is at v's
            // angle on it.
            let (p, q) = if swapped { (v[1], v[0]) } else { (v[0], v[1]) };
            let around = if v[2].hypot(q) == 0.0 { 1.0 } else { q / v[2].hypot(q) };
            let middle = self.component.position(p).floor() as i64;
            for column in (middle - 100).max(range[0].0)..=(middle + 101).min(range[0].1) {
                let radius = (1.0 - self.component.value(column).powi(2)).max(0.0).sqrt();
                let q = self.component.position(around * radius).floor() as i64;
                let rows = window(range, [(column, column), (q, q + 1), (0, 0)]);
                found.extend(rows.into_iter().map(|params| swap(params, swapped)));
            }
            // And those of the rim, which codes far beyond it read as.
            let small = p / p.hypot(q).max(1e-300);
            let small = self.component.position(small).floor() as i64;
            let far = [range[0].0, greatest].map(|far| {
                let columns = window(range, [(small, small + 1), (far, far), (0, 0)]);
                columns.into_iter().map(|params| swap(params, swapped)).collect::<Vec<_>>()
            });
            found.extend(far.into_iter().flatten());
        }
        found
    }
}
