//! Rotations in `f64`, and what codes of any width mean.

/// x, y, z and w.
pub type Quaternion = [f64; 4];

/// |q|.
pub fn length(q: Quaternion) -> f64 {
    q.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// q / |q|.
pub fn unit(q: Quaternion) -> Quaternion {
    // Twice, as the square of a small length is less than the least number.
    let greatest = q.iter().fold(0.0f64, |a, c| a.max(c.abs()));
    let q = q.map(|c| c / greatest);
    let length = length(q);
    q.map(|c| c / length)
}

/// Of unit quaternions: -q is q.
pub fn chord(a: Quaternion, b: Quaternion) -> f64 {
    let off = |sign: f64| length([0, 1, 2, 3].map(|i| a[i] - sign * b[i]));
    off(1.0).min(off(-1.0))
}

/// The rotation that an input stands for.
pub fn target(q: [f32; 4]) -> Quaternion {
    let q = q.map(f64::from);
    unit(if q.iter().any(|c| c.is_nan()) || q == [0.0; 4] {
        [0.0, 0.0, 0.0, 1.0]
    } else if q.iter().any(|c| c.is_infinite()) {
        q.map(|c| if c.is_infinite() { c.signum() } else { 0.0 })
    } else {
        q
    })
}

/// The greatest of the integers of `bits` bits.
pub fn greatest(bits: u32) -> i64 {
    (1 << (bits - 1)) - 1
}

/// Integers of `bits` bits each, the first in the low ones. The one out of range is its neighbour.
pub fn fields<const N: usize>(code: u64, bits: u32) -> [i64; N] {
    let m = greatest(bits);
    std::array::from_fn(|i| {
        let field = (code >> (i as u32 * bits)) as i64 & (2 * m + 1);
        (if field > m { field - 2 * m - 2 } else { field }).max(-m)
    })
}

/// What a code of plain quaternions means: four integers over their length.
pub fn plain(code: u64, bits: u32) -> Quaternion {
    let fields: [i64; 4] = fields(code, bits);
    if fields == [0; 4] { [0.0, 0.0, 0.0, 1.0] } else { unit(fields.map(|f| f as f64)) }
}
