//! Where the two constants of warpedoct come from: they make its greatest error least.
//!
//! ```sh
//! cargo run --release --example warp
//! ```
//!
//! warpedoct takes the point t of an octahedron's face, whose three coordinates add to 1, to the direction of
//! (g(t.x), g(t.y), g(t.z)), where g(t) = t (1 + (K + Q t) (1 - t)) keeps the corners, t = 0 and t = 1. The points of a
//! code are a triangular lattice of t with steps of 1 / M. Seen from close by, that is a lattice on the sphere too,
//! and what lies farthest from all of its points is the centre of a triangle's circumscribed circle. So the greatest
//! error is, but for a factor of 1 / M, the greatest circumradius on a face. This looks for the K and Q that make it
//! least, and compares them with the crate's.

use unitpack::{Codec, WarpedOct32};

/// What the crate has.
const CRATE: [f64; 2] = [0.459265, -0.710567];

/// How finely the face is searched.
const STEPS: usize = 300;

fn warp([k, q]: [f64; 2], t: f64) -> f64 {
    t * (1.0 + (k + q * t) * (1.0 - t))
}

fn gradient([k, q]: [f64; 2], t: f64) -> f64 {
    1.0 + k + 2.0 * (q - k) * t - 3.0 * q * t * t
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The circumradius, in radians, of a triangle of the lattice around t, times M.
fn circumradius(constants: [f64; 2], t: [f64; 3]) -> f64 {
    let v = t.map(|t| warp(constants, t));
    let length = dot(v, v).sqrt();
    let n = v.map(|c| c / length);
    // A step of the lattice, seen on the sphere.
    let step = |along: [f64; 3]| -> [f64; 3] {
        let moved: [f64; 3] = std::array::from_fn(|i| gradient(constants, t[i]) * along[i]);
        let outward = dot(moved, n);
        std::array::from_fn(|i| (moved[i] - outward * n[i]) / length)
    };
    let sides = [[1.0, -1.0, 0.0], [0.0, 1.0, -1.0], [-1.0, 0.0, 1.0]].map(step);
    let squares = sides.map(|side| dot(side, side));
    let cosine = dot(sides[0], sides[1]);
    let twice_area = (squares[0] * squares[1] - cosine * cosine).sqrt();
    (squares[0] * squares[1] * squares[2]).sqrt() / (2.0 * twice_area)
}

/// The greatest circumradius on the face, of which a sixth is enough.
fn greatest(constants: [f64; 2]) -> f64 {
    let mut greatest = 0.0f64;
    for i in 0..=STEPS {
        for j in 0..=i.min(STEPS - i) {
            let k = STEPS - i - j;
            if k <= j {
                let t = [i, j, k].map(|c| c as f64 / STEPS as f64);
                greatest = greatest.max(circumradius(constants, t));
            }
        }
    }
    greatest
}

/// From no warp downhill, by ever smaller steps along both axes and both diagonals.
fn best() -> ([f64; 2], f64) {
    let mut best = ([0.0; 2], greatest([0.0; 2]));
    let mut step = 0.1;
    while step > 1e-7 {
        let directions = (-1..=1).flat_map(|a| (-1..=1).map(move |b| [a, b].map(f64::from)));
        let there = directions
            .map(|d| [best.0[0] + d[0] * step, best.0[1] + d[1] * step])
            .map(|constants| (constants, greatest(constants)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .expect("there are nine directions");
        if there.1 < best.1 {
            best = there;
        } else {
            step /= 2.0;
        }
    }
    best
}

/// Whether the crate decodes with the constants that stand above.
fn crate_agrees() -> bool {
    (1..32).all(|i| {
        let t = f64::from(i * 1024) / 32767.0;
        let [x, _, z] = WarpedOct32::decode(i * 1024).map(f64::from);
        let expected = warp(CRATE, t).atan2(warp(CRATE, 1.0 - t));
        (x.atan2(z) - expected).abs() < 3e-7
    })
}

fn main() {
    assert!(crate_agrees(), "the crate has other constants");
    let degrees = |radius: f64, bits: i32| (radius / (2f64.powi(bits / 2 - 1) - 1.0)).to_degrees();
    let (found, least) = best();
    println!("Greatest error in degrees, as if all triangles were as small as those of many bits:");
    println!("                    K          Q   16 bits  24 bits   32 bits");
    for (name, constants) in [("oct", [0.0; 2]), ("crate", CRATE), ("found", found)] {
        let radius = greatest(constants);
        let errors = [16, 24, 32].map(|bits| degrees(radius, bits));
        let [k, q] = constants;
        println!(
            "{name:>10}  {k:9.6}  {q:9.6}    {:.4}  {:.5}  {:.6}",
            errors[0], errors[1], errors[2]
        );
    }
    let excess = greatest(CRATE) / least - 1.0;
    println!("The crate's greatest error is {:.4} % above the least found.", 100.0 * excess);
    assert!(excess < 1e-3, "the crate's constants are not the best");
}
