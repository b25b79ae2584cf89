//! octant16: three signs and a point of the octant's triangle.

use super::{Params, Representation, normalize, rounding, steps_error, unsigned_field, window};

/// Three signs and a point of the octant's triangle: `[i, j, signs]`, x's in the highest bit of
/// three.
pub(super) struct Octant;

const OCTANT: i64 = 126;

impl Octant {
    /// A zero has no sign.
    fn is_negative([i, j, signs]: Params<i64>) -> [bool; 3] {
        let bit = |k: i64| signs >> k & 1 == 1;
        [bit(2) && i > 0, bit(1) && j > 0, bit(0) && i + j < OCTANT]
    }
}

impl Representation for Octant {
    /// Less a half, so that rounding truncates.
    fn params(&self, [x, y, z]: [f64; 3]) -> Params<f64> {
        let w = OCTANT as f64 / (x.abs() + y.abs() + z.abs());
        let signs = [x, y, z].iter().fold(0.0, |s, &c| 2.0 * s + f64::from(u8::from(c < 0.0)));
        [x.abs() * w - 0.5, y.abs() * w - 0.5, signs]
    }
    fn params_error(&self) -> f64 {
        steps_error(OCTANT)
    }
    fn range(&self) -> Params<(i64, i64)> {
        [(0, OCTANT), (0, OCTANT), (0, 7)]
    }
    fn rounded(&self, v: [f64; 3]) -> Vec<Params<i64>> {
        let [i, j, signs] = self.params(v);
        let [i, j] = [i, j].map(|p| rounding(p, self.params_error()));
        // What f32 does not hold beside the largest component may read as zero, which has no sign.
        let largest = v.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        let certain = v
            .iter()
            .fold(0, |s, &c| 2 * s + i64::from(c < -largest * f64::from(f32::MIN_POSITIVE)));
        let signs = signs as i64;
        let any_of = |s: &i64| s & certain == certain && s & signs == *s;
        let all = (0..8).filter(any_of).flat_map(|s| window(self.range(), [i, j, (s, s)]));
        all.map(|[i, j, signs]| [i, j.min(OCTANT - i), signs]).collect()
    }
    fn vector(&self, [i, j, signs]: Params<i64>) -> [f64; 3] {
        // A search looks beyond the triangle too: the point on its edge.
        let j = j.min(OCTANT - i);
        let magnitudes = [i, j, OCTANT - i - j];
        let negative = Self::is_negative([i, j, signs]);
        normalize(std::array::from_fn(|k| {
            if negative[k] { -magnitudes[k] as f64 } else { magnitudes[k] as f64 }
        }))
    }
    fn pack(&self, [i, j, signs]: Params<i64>) -> u128 {
        let (i, j) = if i >= 64 { (127 - i, 127 - j) } else { (i, j) };
        (signs << 13 | i << 7 | j) as u128
    }
    /// What would have a third component of -1 reads as the neighbour with i one less.
    fn unpack(&self, code: u128) -> Params<i64> {
        let (i, j) = (unsigned_field(code, 7, 6), unsigned_field(code, 0, 7));
        let (i, j) = if i + j >= 127 { (127 - i, 127 - j) } else { (i, j) };
        [if i + j > OCTANT { i - 1 } else { i }, j, unsigned_field(code, 13, 3)]
    }
    fn canonical(&self, [i, j, signs]: Params<i64>) -> Params<i64> {
        let negative = Self::is_negative([i, j, signs]);
        [i, j, negative.iter().fold(0, |s, &negative| 2 * s + i64::from(negative))]
    }
}
