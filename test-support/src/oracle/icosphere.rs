//! icosphere162: the vertices of a subdivided icosahedron.

use super::{Params, Representation, chord_squared, normalize, unsigned_field};

/// All vertices, in the order of their codes.
pub(super) struct Icosphere(Vec<[f64; 3]>);

impl Icosphere {
    pub(super) fn new() -> Self {
        let phi = (1.0 + 5f64.sqrt()) / 2.0;
        let corners = [[1.0, 0.0, phi], [phi, 1.0, 0.0], [0.0, phi, 1.0], [-1.0, 0.0, phi]];
        let point = |corners: [[f64; 3]; 4], weights: [i32; 4]| -> [f64; 3] {
            let component = |i: usize| {
                corners.iter().zip(weights).map(|(c, weight)| c[i] * f64::from(weight)).sum()
            };
            normalize([0, 1, 2].map(component))
        };
        let numbered = [
            [3, 1, 0, 0],
            [3, 0, 1, 0],
            [2, 2, 0, 0],
            [2, 1, 1, 0],
            [2, 0, 1, 1],
            [4, 0, 0, 0],
            [3, 0, 0, 1],
            [1, 0, 2, 1],
            [2, 0, 0, 2],
        ];
        let mut all = Vec::new();
        for weights in numbered {
            let mut v = point(corners, weights);
            for _ in 0..3 {
                // Each sign in turn, that of x fastest, of components that have one.
                for signs in 0..8 {
                    let image: [f64; 3] =
                        std::array::from_fn(|i| if signs >> i & 1 == 1 { -v[i] } else { v[i] });
                    if (0..3).all(|i| v[i] > 1e-9 || signs >> i & 1 == 0) {
                        all.push(image);
                    }
                }
                v.rotate_right(1);
            }
        }
        // The same set from the faces of the solid: every triple of corners an edge apart.
        let solid: Vec<[f64; 3]> = (0..12)
            .map(|i: usize| {
                let [a, b] = [i % 2, i / 2 % 2].map(|minus| 1.0 - 2.0 * minus as f64);
                let mut v = [a, 0.0, b * phi];
                v.rotate_right(i / 4);
                v
            })
            .collect();
        let edge = |i: usize, j: usize| (chord_squared(solid[i], solid[j]) - 4.0).abs() < 1e-9;
        for i in 0..12 {
            for j in (0..i).filter(|&j| edge(i, j)) {
                for k in (0..j).filter(|&k| edge(i, k) && edge(j, k)) {
                    for (a, b) in (0..=4).flat_map(|a| (0..=4 - a).map(move |b| (a, b))) {
                        let face = [solid[i], solid[j], solid[k], [0.0; 3]];
                        let v = point(face, [a, b, 4 - a - b, 0]);
                        let same = all.iter().filter(|w| chord_squared(v, **w) < 1e-18).count();
                        assert_eq!(same, 1, "{v:?}");
                    }
                }
            }
        }
        assert_eq!(all.len(), 162);
        Icosphere(all)
    }

    fn nearest(&self, v: [f64; 3]) -> (usize, f64) {
        let distances = self.0.iter().map(|w| chord_squared(v, *w)).enumerate();
        distances.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
    }
}

impl Representation for Icosphere {
    fn params(&self, v: [f64; 3]) -> Params<f64> {
        [self.nearest(v).0 as f64, 0.0, 0.0]
    }
    fn params_error(&self) -> f64 {
        0.0
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, 161), (0, 0), (0, 0)]
    }
    fn vector(&self, [index, _, _]: Params<i64>) -> [f64; 3] {
        self.0[index as usize]
    }
    fn pack(&self, [index, _, _]: Params<i64>) -> u128 {
        index as u128
    }
    fn unpack(&self, code: u128) -> Params<i64> {
        [unsigned_field(code, 0, 8).min(161), 0, 0]
    }
    fn rounded(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let (_, least) = self.nearest(v);
        let close = |&i: &i64| chord_squared(v, self.0[i as usize]) < least + 1e-6;
        (0..162).filter(close).map(|i| [i, 0, 0]).collect()
    }
    fn nearby(&self, _: [f64; 3], _: f64) -> Vec<Params<i64>> {
        (0..162).map(|i| [i, 0, 0]).collect()
    }
}
