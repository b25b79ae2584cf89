//! Random and awkward directions, the same on every machine.

use std::f64::consts::TAU;

/// SplitMix64: small, seeded, and the same on every machine.
pub struct Rng(u64);

impl Rng {
    /// Each seed gives another sequence.
    pub fn new(seed: u64) -> Self {
        Rng(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// In 0..n, with a bias that no test can notice.
    pub fn below(&mut self, n: u64) -> u64 {
        ((u128::from(self.bits()) * u128::from(n)) >> 64) as u64
    }

    /// One of `from`.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len() as u64) as usize]
    }

    /// In [-1, 1), a multiple of 2^-23: exact, so the same on every machine.
    pub fn signed(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / 8_388_608.0 - 1.0
    }

    /// Two normal deviates, by Box and Muller.
    pub fn normals(&mut self) -> [f64; 2] {
        // Above 0, at most 1.
        let radius = (-2.0 * (self.unit() + f64::EPSILON / 2.0).ln()).sqrt();
        let (sin, cos) = (TAU * (self.unit() + f64::EPSILON / 2.0)).sin_cos();
        [radius * cos, radius * sin]
    }

    /// A rotation, uniform: Shoemake, "Uniform Random Rotations", 1992.
    pub fn quaternion(&mut self) -> [f32; 4] {
        let u = self.unit();
        let [(sin_a, cos_a), (sin_b, cos_b)] = [(); 2].map(|()| (TAU * self.unit()).sin_cos());
        let (short, long) = ((1.0 - u).sqrt(), u.sqrt());
        [short * sin_a, short * cos_a, long * sin_b, long * cos_b].map(|c| c as f32)
    }

    /// Uniform on the sphere, rounded to `f32`.
    pub fn direction(&mut self) -> [f32; 3] {
        let z = self.unit() * 2.0 - 1.0;
        let (sin, cos) = (self.unit() * TAU).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [(r * cos) as f32, (r * sin) as f32, z as f32]
    }

    /// A direction that random vectors hardly ever meet: near an axis, a fold line, the rim of a
    /// hemisphere or half way between two grid points, and of any length.
    pub fn edge(&mut self) -> [f32; 3] {
        let mut v = match self.below(4) {
            // Simple ratios: corners, edges and diagonals of every solid that is unfolded
            // somewhere.
            0 => [0; 3].map(|_| self.below(5) as f32 - 2.0),
            // Half way between the grid points of some size, in the metric of the octahedron or of
            // the sphere.
            1 => {
                let steps = self.pick(&[7, 15, 31, 63, 127, 255, 511, 1023, 2047, 4095, 32767]);
                let [x, y] =
                    [0; 2].map(|_| self.below(4 * steps + 1) as f64 / (2 * steps) as f64 - 1.0);
                let z = if self.below(2) == 0 {
                    1.0 - x.abs() - y.abs()
                } else {
                    (1.0 - x * x - y * y).max(0.0).sqrt()
                };
                [x as f32, y as f32, z as f32]
            }
            // Two components of one magnitude.
            2 => {
                let [a, b, _] = self.direction();
                let mut v = [a, -a, b];
                v.rotate_left(self.below(3) as usize);
                v
            }
            _ => self.direction(),
        };
        // One or two components a little off zero.
        for _ in 0..self.below(3) {
            v[self.below(3) as usize] =
                self.pick(&[0.0, -0.0, 1e-3, 1e-5, 1e-7, -1e-7, 1e-12, 1e-30, -1e-40]);
        }
        // A few units in the last place, each way.
        if self.below(2) == 0 {
            let i = self.below(3) as usize;
            v[i] =
                f32::from_bits(v[i].to_bits().wrapping_add(self.below(7) as u32).wrapping_sub(3));
        }
        let scale =
            self.pick(&[1.0, 1.0, 1.0, -1.0, 0.3, 7.0, 1e-3, 1e9, 1e30, 1e-30, 1e-38, 1e-42]);
        v.map(|c| c * scale)
    }
}

/// Inputs that the promises name: axes, zeros, infinities, NaN, the greatest and the least, in
/// every position and sign.
pub fn special_vectors() -> Vec<[f32; 3]> {
    let greatest = f32::MAX;
    let least = f32::from_bits(1);
    let one_less = 1.0f32.next_down();
    let positive =
        [0.0, 1.0, 0.5, one_less, 1e-8, 1e-20, greatest, least, f32::MIN_POSITIVE, f32::INFINITY];
    let mut values: Vec<f32> = positive.iter().flat_map(|&c| [c, -c]).collect();
    values.push(f32::NAN);
    let mut vectors = Vec::with_capacity(values.len().pow(3));
    for &x in &values {
        for &y in &values {
            for &z in &values {
                vectors.push([x, y, z]);
            }
        }
    }
    vectors
}

/// `count` directions: the special ones, then edges and uniform ones in turn.
pub fn mixed_vectors(seed: u64, count: usize) -> Vec<[f32; 3]> {
    let mut rng = Rng::new(seed);
    let mut vectors = special_vectors();
    while vectors.len() < count {
        vectors.push(rng.edge());
        vectors.push(rng.direction());
    }
    vectors
}
