//! Vectors to measure on, and the two inputs that need no file.

use std::f64::consts::TAU;

use unitpack_test::Arrays;
use unitpack_test::random::Rng;
use unitpack_test::vectors::{cross, normalize};

/// The vectors with z = |z|.
pub fn hemisphere(v: &Arrays) -> Arrays {
    v.iter().map(|[x, y, z]| [x, y, z.abs()]).collect()
}

/// `count` of the vectors, evenly spaced.
pub fn spread(v: &Arrays, count: usize) -> Arrays {
    let pick = |of: &[f32]| (0..count).map(|i| of[i * of.len() / count]).collect();
    Arrays { x: pick(&v.x), y: pick(&v.y), z: pick(&v.z) }
}

/// Directions spread evenly over the sphere, as the survey makes them: three normal deviates,
/// divided by their length.
pub fn uniform(count: usize, seed: u64) -> Arrays {
    let mut random = Rng::new(seed);
    (0..count)
        .map(|_| {
            let ([x, y], [z, _]) = (random.normals(), random.normals());
            let length = (x * x + y * y + z * z).sqrt();
            [x, y, z].map(|c| (c / length) as f32)
        })
        .collect()
}

/// Rings of the torus knot's tessellation, and vertices of a ring.
pub const TORUS_KNOT: (u32, u32) = (1024, 256);

/// The vertex normals of a tube around a (2, 3) torus knot. At angle `u` along the knot and `v`
/// around the tube, the surface's normal is `cos v` times the curve's principal normal plus `sin v`
/// times its binormal, exactly.
pub fn torus_knot() -> Arrays {
    let (rings, sides) = TORUS_KNOT;
    let mut normals = Arrays::default();
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
