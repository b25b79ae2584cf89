//! Vectors of three numbers, in `f64`.

/// The same vector in `f64`.
pub fn widen(v: [f32; 3]) -> [f64; 3] {
    v.map(f64::from)
}

/// The scalar product.
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `v` times `s`.
pub fn scaled(v: [f64; 3], s: f64) -> [f64; 3] {
    v.map(|c| c * s)
}

/// The sum of two vectors.
pub fn plus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// The Euclidean length.
pub fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// The vector of length 1 in this direction.
pub fn normalize(v: [f64; 3]) -> [f64; 3] {
    let length = length(v);
    v.map(|c| c / length)
}

/// |a - b|^2, which for unit vectors orders as the angle does and is as exact near 0.
pub fn chord_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    dot(d, d)
}

/// Radians, for vectors of any length; exact near 0, where acos is not. Infinite if one is not a
/// direction, so that it exceeds every bound.
pub fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let finite = [a, b].iter().all(|v| length(*v).is_normal());
    if finite { length(cross(a, b)).atan2(dot(a, b)) } else { f64::INFINITY }
}

/// `count` directions, spread evenly by the golden angle.
pub fn golden_spiral(count: usize) -> impl Iterator<Item = [f32; 3]> {
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (2.399_963_229_728_653 * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [r * cos, r * sin, z].map(|c| c as f32)
    })
}

/// The bits of each component, which tell apart what `==` does not: zeros, and kinds of NaN.
pub fn bits(v: [f32; 3]) -> [u32; 3] {
    v.map(f32::to_bits)
}
