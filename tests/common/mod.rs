//! What the tests share: random and awkward directions, angles, and batches of codes as integers.

#![allow(dead_code)] // Every test file is a crate of its own and uses a part of this.

pub mod every_code;
pub mod frames;
pub mod oracle;
pub mod published;

use std::f64::consts::TAU;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use unitpack::{Format, Soa, SoaMut};

/// SplitMix64: small, seeded, and the same on every machine.
pub struct Rng(u64);

impl Rng {
    pub fn new(seed: u64) -> Self {
        Rng(seed)
    }

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

    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len() as u64) as usize]
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

pub fn widen(v: [f32; 3]) -> [f64; 3] {
    v.map(f64::from)
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// Radians, for vectors of any length; exact near 0, where acos is not. Infinite if one is not a
/// direction, so that it exceeds every bound.
pub fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let finite = [a, b].iter().all(|v| length(*v).is_normal());
    if finite { length(cross(a, b)).atan2(dot(a, b)) } else { f64::INFINITY }
}

/// Whole vectors through the run-time interface, codes as integers.
pub fn encode(format: Format, vectors: &[[f32; 3]]) -> Vec<u128> {
    encode_with(format, vectors, Format::encode)
}

pub fn encode_precise(format: Format, vectors: &[[f32; 3]]) -> Vec<u128> {
    encode_with(format, vectors, Format::encode_precise)
}

fn encode_with<E: std::fmt::Debug>(
    format: Format,
    vectors: &[[f32; 3]],
    encode: impl Fn(Format, Soa<'_>, &mut [u8]) -> Result<(), E>,
) -> Vec<u128> {
    let [x, y, z] = [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect::<Vec<_>>());
    let size = format.code_size();
    let mut bytes = vec![0; vectors.len() * size];
    encode(format, Soa { x: &x, y: &y, z: &z }, &mut bytes).unwrap();
    let integer = |bytes: &[u8]| {
        let mut wide = [0; 16];
        wide[..size].copy_from_slice(bytes);
        u128::from_le_bytes(wide)
    };
    bytes.chunks_exact(size).map(integer).collect()
}

pub fn decode(format: Format, codes: &[u128]) -> Vec<[f32; 3]> {
    let size = format.code_size();
    let bytes: Vec<u8> =
        codes.iter().flat_map(|code| code.to_le_bytes().into_iter().take(size)).collect();
    let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0; codes.len()]);
    format.decode(&bytes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
    x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]).collect()
}

/// All ones, in as many bits as a code's integer has.
pub fn last_pattern(format: Format) -> u128 {
    u128::MAX >> (128 - 8 * format.code_size())
}

/// Codes of any bit pattern: in turn uniform ones, and ones of bytes at which fields turn over.
pub fn random_codes(format: Format, seed: u64, count: usize) -> Vec<u128> {
    const TURNS: [u8; 11] = [0x00, 0x01, 0x3C, 0x7B, 0x7C, 0x7F, 0x80, 0x81, 0xBC, 0xFE, 0xFF];
    let mut rng = Rng::new(seed);
    let mut code = |i| {
        let uniform = i % 2 == 0;
        let byte = [0; 16].map(|_| if uniform { rng.bits() as u8 } else { rng.pick(&TURNS) });
        u128::from_le_bytes(byte) & last_pattern(format)
    };
    (0..count).map(&mut code).collect()
}

/// Runs `check` on every task, on all cores, and gives what it found wrong.
pub fn failures<T: Sync>(
    tasks: &[T],
    check: impl Fn(&T) -> Result<(), String> + Sync,
) -> Vec<String> {
    let next = AtomicUsize::new(0);
    let failures = Mutex::new(Vec::new());
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(|| {
                while let Some(task) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if let Err(failure) = check(task) {
                        failures.lock().unwrap().push(failure);
                    }
                }
            });
        }
    });
    failures.into_inner().unwrap()
}

/// Panics with everything that is wrong with any task, so that one run shows every defect.
pub fn check_all<T: Sync>(tasks: &[T], check: impl Fn(&T) -> Result<(), String> + Sync) {
    let failures = failures(tasks, check);
    assert!(failures.is_empty(), "{} failed:\n{}", failures.len(), failures.join("\n"));
}
