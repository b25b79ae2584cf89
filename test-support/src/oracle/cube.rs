//! cube and warpedcube, and angularcube.

use std::f64::consts::FRAC_PI_4;

use super::{
    Kind, Pair, Params, Representation, Tabulated, normalize, signed_field, steps_error,
    unsigned_field,
};

/// The largest component's axis, of equals the first, and the next two components in turn.
fn face_of(v: [f64; 3]) -> (usize, [f64; 3]) {
    let mut axis = 0;
    for other in 1..3 {
        if v[other].abs() > v[axis].abs() {
            axis = other;
        }
    }
    (axis, [v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3]])
}

/// The vector with `main` on the axis of a face and the other two components in turn.
fn on_face(face: i64, [a, b]: [f64; 2]) -> [f64; 3] {
    let axis = face as usize / 2;
    let mut v = [0.0; 3];
    v[axis] = if face % 2 == 0 { 1.0 } else { -1.0 };
    v[(axis + 1) % 3] = a;
    v[(axis + 2) % 3] = b;
    normalize(v)
}

fn face_number(axis: usize, main: f64) -> f64 {
    (2 * axis + usize::from(main < 0.0)) as f64
}

/// Two snorm parameters on a face: `[a, b, face]`, face = 2 axis + sign in the low three bits.
pub(super) struct Cube {
    side: Pair,
    warped: bool,
    places: Tabulated<f64>,
}

impl Cube {
    pub(super) fn new(bits: u32, warped: bool) -> Self {
        let side = Pair { bits: (bits - 3) / 2, kind: Kind::Snorm };
        let place = |p: i64| {
            let t = side.value(p);
            if warped { (t * FRAC_PI_4).tan() } else { t }
        };
        Cube { side, warped, places: Tabulated::new(side.range()[0], place) }
    }
}

impl Representation for Cube {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        let (axis, [main, a, b]) = face_of(v);
        let [a, b] = [a / main.abs(), b / main.abs()]
            .map(|t| if self.warped { t.atan() / FRAC_PI_4 } else { t })
            .map(|t| self.side.position(t));
        [a, b, face_number(axis, main)]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.side.steps())
    }
    fn range(&self) -> Params<(i64, i64)> {
        let [a, b, _] = self.side.range();
        [a, b, (0, 5)]
    }
    fn reach(&self) -> Params<i64> {
        [2, 2, 0]
    }
    fn vector(&self, [a, b, face]: Params<i64>) -> [f64; 3] {
        on_face(face, [self.places.at(a), self.places.at(b)])
    }
    fn pack(&self, [a, b, face]: Params<i64>) -> u128 {
        let field = |p: i64| p as u128 & ((1 << self.side.bits) - 1);
        face as u128 | field(a) << 3 | field(b) << (3 + self.side.bits)
    }
    /// Faces 6 and 7 read as 4 and 5.
    fn unpack(&self, code: u128) -> Params<i64> {
        let face = unsigned_field(code, 0, 3);
        let side = |shift| signed_field(code, shift, self.side.bits).max(-self.side.steps());
        [side(3), side(3 + self.side.bits), if face > 5 { face - 2 } else { face }]
    }
    /// A point of an edge is on the face of the first of its axes.
    fn canonical(&self, [a, b, face]: Params<i64>) -> Params<i64> {
        let border = self.side.steps();
        let axis = face as usize / 2;
        let mut point = [0; 3];
        point[axis] = if face % 2 == 0 { border } else { -border };
        point[(axis + 1) % 3] = a;
        point[(axis + 2) % 3] = b;
        let first = (0..3).find(|&i| point[i].abs() == border).unwrap();
        let face = 2 * first as i64 + i64::from(point[first] < 0);
        [point[(first + 1) % 3], point[(first + 2) % 3], face]
    }
}

/// Cells of equal angles on a face: `[i, j, face]`, decoded to their centres.
pub(super) struct AngularCube {
    bits: u32,
    cells: i64,
    places: Tabulated<f64>,
}

impl AngularCube {
    pub(super) fn new(bits: u32) -> Self {
        // floor(sqrt(2^bits / 6)), counted so as not to rely on rounding.
        let fits = |s: i64| 6 * s * s <= 1 << bits;
        let near = (2f64.powi(bits as i32) / 6.0).sqrt() as i64;
        let cells = (near - 1..=near + 1).rev().find(|&s| fits(s)).unwrap();
        let centre = |i: i64| (FRAC_PI_4 * ((2 * i + 1 - cells) as f64 / cells as f64)).tan();
        AngularCube { bits, cells, places: Tabulated::new((0, cells - 1), centre) }
    }
}

impl Representation for AngularCube {
    /// In cells from the centre of the first, so that rounding finds the cell.
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        let (axis, [main, a, b]) = face_of(v);
        let [i, j] = [a, b]
            .map(|t| ((t / main.abs()).atan() / FRAC_PI_4 + 1.0) / 2.0 * self.cells as f64 - 0.5);
        [i, j, face_number(axis, main)]
    }
    fn params_error(&self) -> f64 {
        steps_error(self.cells)
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, self.cells - 1), (0, self.cells - 1), (0, 5)]
    }
    fn reach(&self) -> Params<i64> {
        [2, 2, 0]
    }
    fn vector(&self, [i, j, face]: Params<i64>) -> [f64; 3] {
        on_face(face, [self.places.at(i), self.places.at(j)])
    }
    fn pack(&self, [i, j, face]: Params<i64>) -> u128 {
        ((i * self.cells + j) * 6 + face) as u128
    }
    /// Indices beyond the last cell read as the last.
    fn unpack(&self, code: u128) -> Params<i64> {
        let index = unsigned_field(code, 0, self.bits).min(6 * self.cells * self.cells - 1);
        [index / 6 / self.cells, index / 6 % self.cells, index % 6]
    }
}
