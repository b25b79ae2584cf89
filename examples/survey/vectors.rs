//! Vectors to measure on, and the two inputs that need no file.

use std::f64::consts::TAU;

use unitpack::Soa;

#[derive(Default)]
pub struct Vectors {
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
}

impl Vectors {
    pub fn len(&self) -> usize {
        self.x.len()
    }

    pub fn push(&mut self, [x, y, z]: [f32; 3]) {
        self.x.push(x);
        self.y.push(y);
        self.z.push(z);
    }

    pub fn soa(&self) -> Soa<'_> {
        Soa { x: &self.x, y: &self.y, z: &self.z }
    }

    /// The vectors with z = |z|.
    pub fn hemisphere(&self) -> Vectors {
        let z = self.z.iter().map(|z| z.abs()).collect();
        Vectors { x: self.x.clone(), y: self.y.clone(), z }
    }

    /// `count` of the vectors, evenly spaced.
    pub fn spread(&self, count: usize) -> Vectors {
        let pick = |of: &[f32]| (0..count).map(|i| of[i * of.len() / count]).collect();
        Vectors { x: pick(&self.x), y: pick(&self.y), z: pick(&self.z) }
    }
}

impl FromIterator<[f32; 3]> for Vectors {
    fn from_iter<I: IntoIterator<Item = [f32; 3]>>(vectors: I) -> Self {
        let mut all = Vectors::default();
        vectors.into_iter().for_each(|v| all.push(v));
        all
    }
}

/// Directions spread evenly over the sphere, as the survey makes them: three normal deviates,
/// divided by their length.
pub fn uniform(count: usize, seed: u64) -> Vectors {
    let mut random = SplitMix64(seed);
    (0..count)
        .map(|_| {
            let ([x, y], [z, _]) = (random.normals(), random.normals());
            let length = (x * x + y * y + z * z).sqrt();
            [x, y, z].map(|c| (c / length) as f32)
        })
        .collect()
}

/// Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators" (2014).
struct SplitMix64(u64);

impl SplitMix64 {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Above 0, at most 1.
    fn unit(&mut self) -> f64 {
        ((self.next() >> 11) + 1) as f64 * 2f64.powi(-53)
    }

    /// Two normal deviates, by Box and Muller.
    fn normals(&mut self) -> [f64; 2] {
        let radius = (-2.0 * self.unit().ln()).sqrt();
        let (sin, cos) = (TAU * self.unit()).sin_cos();
        [radius * cos, radius * sin]
    }
}

/// Rings of the torus knot's tessellation, and vertices of a ring.
pub const TORUS_KNOT: (u32, u32) = (1024, 256);

/// The vertex normals of a tube around a (2, 3) torus knot. At angle `u` along the knot and `v`
/// around the tube, the surface's normal is `cos v` times the curve's principal normal plus `sin v`
/// times its binormal, exactly.
pub fn torus_knot() -> Vectors {
    let (rings, sides) = TORUS_KNOT;
    let mut normals = Vectors::default();
    for ring in 0..rings {
        let u = TAU * f64::from(ring) / f64::from(rings);
        let ((sin2, cos2), (sin3, cos3)) = ((2.0 * u).sin_cos(), (3.0 * u).sin_cos());
        // The curve is (r cos 2u, r sin 2u, sin 3u) with r = 2 + cos 3u; its first and second
        // derivatives:
        let (r, dr, ddr) = (2.0 + cos3, -3.0 * sin3, -9.0 * cos3);
        let first = [dr * cos2 - 2.0 * r * sin2, dr * sin2 + 2.0 * r * cos2, 3.0 * cos3];
        let second = [
            (ddr - 4.0 * r) * cos2 - 4.0 * dr * sin2,
            (ddr - 4.0 * r) * sin2 + 4.0 * dr * cos2,
            -9.0 * sin3,
        ];
        let tangent = normalize(first);
        let binormal = normalize(cross(first, second));
        let principal = cross(binormal, tangent);
        for side in 0..sides {
            let (sin, cos) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
            normals.push([0, 1, 2].map(|i| (cos * principal[i] + sin * binormal[i]) as f32));
        }
    }
    normals
}

fn normalize(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
