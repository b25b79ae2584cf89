//! The nearest code of a format of three components of 16 bits, decoded by dividing by the length:
//! every length, in f64.

use unitpack::Format;

use unitpack_test::oracle::Oracle;
use unitpack_test::vectors::chord_squared;

/// The values that a component may have, times a constant.
trait Grid: Sync {
    const GREATEST: f64;
    /// The value nearest to `x`, or on a finer grid.
    fn nearest(x: f64) -> f64;
    /// From one value to the next at `x`.
    fn step(x: f64) -> f64;
    /// 16 bits, if it is a value.
    fn bits(x: f64) -> Option<u16>;
}

/// Integers up to this.
struct Snorm<const GREATEST: i64>;

impl<const GREATEST: i64> Grid for Snorm<GREATEST> {
    const GREATEST: f64 = GREATEST as f64;
    #[inline(always)]
    fn nearest(x: f64) -> f64 {
        round(x)
    }
    fn step(_: f64) -> f64 {
        1.0
    }
    fn bits(x: f64) -> Option<u16> {
        (x.abs() <= Self::GREATEST && x.fract() == 0.0).then_some(x as i16 as u16)
    }
}

/// Odd numbers.
struct Unorm;

impl Grid for Unorm {
    const GREATEST: f64 = 65535.0;
    #[inline(always)]
    fn nearest(x: f64) -> f64 {
        2.0 * round((x - 1.0) * 0.5) + 1.0
    }
    fn step(_: f64) -> f64 {
        2.0
    }
    fn bits(x: f64) -> Option<u16> {
        let is_value = x.abs() <= Self::GREATEST && x as i64 % 2 != 0;
        is_value.then_some(((x + Self::GREATEST) / 2.0) as u16)
    }
}

struct Half;

impl Grid for Half {
    const GREATEST: f64 = 65504.0;
    /// To 11 bits: below 2^-14 the grid is coarser.
    #[inline(always)]
    fn nearest(x: f64) -> f64 {
        // Veltkamp's splitting.
        let big = x * (2f64.powi(42) + 1.0);
        big - (big - x)
    }
    fn step(x: f64) -> f64 {
        // The power of two at or below |x|.
        let power = f64::from_bits(x.abs().to_bits() & 0x7FF0_0000_0000_0000);
        power.max(2f64.powi(-14)) * 2f64.powi(-10)
    }
    fn bits(x: f64) -> Option<u16> {
        let step = Self::step(x);
        let mantissa = x.abs() / step;
        let exponent = (step.log2() + 24.0) as u16;
        let bits = if mantissa < 1024.0 {
            mantissa as u16
        } else {
            (exponent + 1) << 10 | (mantissa as u16 - 1024)
        };
        let sign = if x < 0.0 { 0x8000 } else { 0 };
        (x.abs() <= Self::GREATEST && mantissa.fract() == 0.0).then_some(sign | bits)
    }
}

/// To an integer, ties to even, of |x| < 2^51.
#[inline(always)]
fn round(x: f64) -> f64 {
    const SHIFT: f64 = 6_755_399_441_055_744.0; // 1.5 * 2^52
    (x + SHIFT) - SHIFT
}

/// The formats whose codes cannot all be decoded, 2^48 of each.
pub struct Lengths {
    /// All values, not negative, of the component that is the target's largest.
    lengths: Vec<f64>,
    search: fn(&[f64], &Oracle, [f64; 3], f64) -> f64,
}

impl Lengths {
    pub fn of(format: Format) -> Option<Self> {
        match format {
            Format::Snorm12x3 => {
                let lengths = (1..=2047).map(f64::from).collect();
                Some(Lengths { lengths, search: search::<Snorm<2047>> })
            }
            Format::Snorm16x3 => {
                let lengths = (1..=32767).map(f64::from).collect();
                Some(Lengths { lengths, search: search::<Snorm<32767>> })
            }
            Format::XyzUnorm16x3 => {
                let lengths = (1..=65535).step_by(2).map(f64::from).collect();
                Some(Lengths { lengths, search: search::<Unorm> })
            }
            // Every code times a power of two, as long as that is a code, has its largest component
            // in the highest octave; another component, nearly as large, in that or the next.
            Format::Float16x3 => {
                let octave = |unit: f64| (1024..2048).map(move |n| f64::from(n) * unit);
                let lengths = octave(16.0).chain(octave(32.0)).collect();
                Some(Lengths { lengths, search: search::<Half> })
            }
            _ => None,
        }
    }

    /// The square of the chord from `target` to the nearest code, which is at most `chosen`, that of
    /// a code.
    pub fn nearest(&self, oracle: &Oracle, target: [f64; 3], chosen: f64) -> f64 {
        (self.search)(&self.lengths, oracle, target, chosen)
    }
}

/// Of a point with `n` on the axis of the target's largest component, the two other components are
/// off n times the target's slope by some e. The distance of the point from the target's line is at
/// least |e| times the target's largest component t; so its angle a has
///
/// ```text
/// sin a >= |e| t / (n / t + |e|),  |e| <= n sin a / (t (t - sin a))
/// ```
///
/// and only points with that can be as near as `chosen`.
fn search<G: Grid>(lengths: &[f64], oracle: &Oracle, target: [f64; 3], chosen: f64) -> f64 {
    const BLOCK: usize = 16;
    let axis = (0..3).max_by(|&i, &j| target[i].abs().total_cmp(&target[j].abs())).unwrap();
    let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
    let t = target[axis].abs();
    let [p, q] = [target[i] / t, target[j] / t];
    // A chord is no shorter than the sine.
    let sin = chosen.sqrt();
    let tolerance = sin / (t * (t - sin)) * 1.000_001 + 1e-12;
    let mut best = 4.0;
    let mut consider = |n: f64| {
        // Two values to each side, also where steps below are half as wide: with steps in
        // proportion to the components, and angles that grow by no more than sqrt 3 times faster
        // one way than the other, the nearest is among them.
        let around = |ideal: f64| {
            let half_step = G::step(ideal) * 0.5;
            let middle = (ideal / half_step).floor();
            let values = (-3..=4).map(move |k| (middle + f64::from(k)) * half_step);
            values.filter(move |value| (value - ideal).abs() <= n * tolerance)
        };
        for a in around(n * p) {
            for b in around(n * q) {
                let mut point = [0.0; 3];
                (point[axis], point[i], point[j]) = (n.copysign(target[axis]), a, b);
                if let [Some(x), Some(y), Some(z)] = point.map(G::bits) {
                    let code =
                        [x, y, z].iter().rev().fold(0, |code, &c| code << 16 | u128::from(c));
                    best = chord_squared(oracle.decode(code), target).min(best);
                }
            }
        }
    };
    let off = |n: f64, slope: f64| (n * slope - G::nearest(n * slope)).abs();
    let (blocks, rest) = lengths.as_chunks::<BLOCK>();
    for block in blocks {
        let near = block.map(|n| off(n, p) <= n * tolerance && off(n, q) <= n * tolerance);
        if near.iter().fold(false, |any, &near| any | near) {
            for (&n, near) in block.iter().zip(near) {
                if near {
                    consider(n);
                }
            }
        }
    }
    rest.iter().for_each(|&n| consider(n));
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitpack_test::AnyCodec;
    use unitpack_test::codes::encode;
    use unitpack_test::oracle::oracle;
    use unitpack_test::random::mixed_vectors;

    #[test]
    fn nothing_nearer_is_missed() {
        let finer = |f: &&Format| AnyCodec::of(**f).is_finer_than_f32();
        for &format in Format::ALL.iter().filter(finer) {
            let oracle = oracle(format.name());
            let lengths = Lengths::of(format).unwrap();
            let vectors = mixed_vectors(1, 10_000).split_off(9_800);
            for (v, code) in vectors.iter().zip(encode(format, &vectors)) {
                let target = oracle.target(*v);
                let chosen = chord_squared(oracle.decode(code), target);
                let found = lengths.nearest(&oracle, target, chosen);
                let found = 2.0 * (found.sqrt() / 2.0).asin();
                let least = oracle.nearest_angle(target);
                // The oracle looks at one octave of halves, which has none below 2^-24.
                let finer = if format == Format::Float16x3 { 2f64.powi(-24) } else { 0.0 };
                assert!(found - least < 1e-13, "{format}: {v:?}: {found:e}, not {least:e}");
                assert!(least - found < 1e-13 + finer, "{format}: {v:?}: {found:e} < {least:e}");
            }
        }
    }
}
