//! Values sampled over a square.

use unitpack_test::Arrays;

use crate::canvas::{Canvas, Rgb};
use crate::geometry::V3;

/// The sum of a pixel's samples, and how many there are.
type Pixel<const N: usize> = ([f64; N], usize);

/// Mean values over pixels. Positions go from -1 to 1, right and up.
pub struct Raster<const N: usize> {
    pub size: usize,
    /// Samples of a whole pixel.
    samples: usize,
    pixels: Vec<Pixel<N>>,
    /// The greatest values of all samples.
    pub greatest: [f64; N],
}

impl<const N: usize> Raster<N> {
    /// Samples `side` squared times a pixel: `value` gets the vectors of a row of pixels, those
    /// that `direction` has at the positions.
    pub fn sample(
        size: usize,
        side: usize,
        direction: impl Fn([f64; 2]) -> Option<V3>,
        value: impl Fn(&Arrays) -> Vec<[f64; N]>,
    ) -> Raster<N> {
        let mut pixels = vec![([0.0; N], 0); size * size];
        let mut greatest = [f64::NEG_INFINITY; N];
        let step = 2.0 / (size * side) as f64;
        for (y, row) in pixels.chunks_mut(size).enumerate() {
            let (mut vectors, mut columns) = (Arrays::default(), Vec::new());
            for i in 0..side {
                let up = 1.0 - ((y * side + i) as f64 + 0.5) * step;
                for j in 0..size * side {
                    if let Some(v) = direction([(j as f64 + 0.5) * step - 1.0, up]) {
                        vectors.push(v.map(|c| c as f32));
                        columns.push(j / side);
                    }
                }
            }
            for (value, column) in value(&vectors).into_iter().zip(columns) {
                let (sum, count) = &mut row[column];
                *count += 1;
                for i in 0..N {
                    sum[i] += value[i];
                    greatest[i] = greatest[i].max(value[i]);
                }
            }
        }
        Raster { size, samples: side * side, pixels, greatest }
    }

    /// With one pixel for `factor` squared.
    pub fn smaller(&self, factor: usize) -> Raster<N> {
        let size = self.size / factor;
        let mut pixels = vec![([0.0; N], 0); size * size];
        for y in 0..size * factor {
            for x in 0..size * factor {
                let (from, n) = self.pixels[y * self.size + x];
                let (sum, count) = &mut pixels[y / factor * size + x / factor];
                *count += n;
                for i in 0..N {
                    sum[i] += from[i];
                }
            }
        }
        let samples = self.samples * factor * factor;
        Raster { size, samples, pixels, greatest: self.greatest }
    }

    /// With every pixel the mean of the samples around it.
    pub fn smooth(mut self, sigma: f64) -> Raster<N> {
        let part = |value: &dyn Fn(&Pixel<N>) -> f64| {
            blur(self.size, self.pixels.iter().map(value).collect(), sigma)
        };
        let counts = part(&|(_, count)| *count as f64);
        let sums: [Vec<f64>; N] = std::array::from_fn(|i| part(&|(sum, _)| sum[i]));
        for (at, (sum, count)) in self.pixels.iter_mut().enumerate() {
            if *count > 0 {
                let share = *count as f64 / counts[at];
                *sum = std::array::from_fn(|i| sums[i][at] * share);
            }
        }
        self
    }

    pub fn mean(&self) -> [f64; N] {
        let (mut sum, mut count) = ([0.0; N], 0);
        for (of, n) in &self.pixels {
            count += n;
            for i in 0..N {
                sum[i] += of[i];
            }
        }
        sum.map(|s| s / count as f64)
    }

    /// Paints with the upper left corner at (x, y), and nothing where there are no samples.
    pub fn paint(&self, canvas: &mut Canvas, x: usize, y: usize, colour: impl Fn([f64; N]) -> Rgb) {
        for (i, &(sum, count)) in self.pixels.iter().enumerate() {
            if count > 0 {
                let share = count as f64 / self.samples as f64;
                let colour = colour(sum.map(|s| s / count as f64));
                canvas.blend(x + i % self.size, y + i / self.size, colour, share);
            }
        }
    }
}

/// Spreads the values of a square with so many pixels a side by a Gaussian.
pub fn blur(side: usize, mut pixels: Vec<f64>, sigma: f64) -> Vec<f64> {
    let reach = (3.0 * sigma).ceil() as usize;
    let weights: Vec<f64> =
        (0..=reach).map(|i| (-0.5 * (i as f64 / sigma).powi(2)).exp()).collect();
    let sum = 2.0 * weights.iter().sum::<f64>() - weights[0];
    // Rows become columns, twice.
    for _ in 0..2 {
        let mut turned = vec![0.0; pixels.len()];
        for (y, row) in pixels.chunks(side).enumerate() {
            for (x, value) in row.iter().enumerate() {
                for to in x.saturating_sub(reach)..(x + reach + 1).min(side) {
                    turned[to * side + y] += value * weights[to.abs_diff(x)] / sum;
                }
            }
        }
        pixels = turned;
    }
    pixels
}
