//! Projections of a hemisphere to a disk: stereo, eqarea and eqdist, plain or stretched to a
//! square.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, SQRT_2, TAU};

use super::{
    Pair, Params, Representation, around, chord_squared, rounding, sign, steps_error, window,
};

pub(super) enum Projection {
    Stereo,
    EqArea,
    EqDist,
}

#[derive(PartialEq)]
pub(super) enum Stretch {
    Plain,
    Concentric,
    Ellipse,
}

/// A hemisphere on a disk, the disk on a square: `[column, row, lower]` with columns from 0 to
/// `steps` and rows from -`steps` to `steps`.
pub(super) struct Disk {
    pub(super) pair: Pair,
    pub(super) projection: Projection,
    pub(super) stretch: Stretch,
}

impl Disk {
    /// How far from the middle of the disk a direction is, by the cosine and sine of its angle
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
