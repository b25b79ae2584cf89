//! What others do, for one vector at a time.

/// meshoptimizer's encoder of 8-bit octahedral codes, which allocates what it gives.
pub fn meshopt_codes(vectors: &[[f32; 4]]) -> Vec<[i8; 4]> {
    meshopt::encode_filter_oct(vectors, 8)
}

/// The scalar encoder of the meshlet builder in Bevy (`bevy_pbr`, `meshlet/from_mesh.rs`, 2025: fold, scale, add a
/// half, floor), at 8 bits instead of 16.
pub fn bevy_encode([x, y, z]: [f32; 3]) -> u16 {
    let sum = x.abs() + y.abs() + z.abs();
    let p = [x / sum, y / sum];
    let sign = |c: f32| if c >= 0.0 { 1.0 } else { -1.0 };
    let folded = [(1.0 - p[1].abs()) * sign(p[0]), (1.0 - p[0].abs()) * sign(p[1])];
    let [u, w] = if z / sum >= 0.0 { p } else { folded };
    let snorm = |c: f32| (c.clamp(-1.0, 1.0) * 127.0 + 0.5).floor() as i8;
    u16::from_le_bytes([snorm(u) as u8, snorm(w) as u8])
}

/// The survey's decoder, as one writes it at first.
pub fn plain_decode(code: u16) -> [f32; 3] {
    let [u, w] = code.to_le_bytes().map(|byte| (f32::from(byte as i8) / 127.0).max(-1.0));
    let z = 1.0 - u.abs() - w.abs();
    let sign = |c: f32| if c >= 0.0 { 1.0 } else { -1.0 };
    let [x, y] =
        if z < 0.0 { [(1.0 - w.abs()) * sign(u), (1.0 - u.abs()) * sign(w)] } else { [u, w] };
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitpack::{Codec, Oct16};

    /// A peer that does something else is none.
    #[test]
    fn peers_do_the_same() {
        let angle = |a: [f32; 3], b: [f32; 3]| {
            let [a, b] = [a, b].map(|v| v.map(f64::from));
            let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
            let length = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
            (dot / (length(a) * length(b))).min(1.0).acos().to_degrees()
        };
        for code in 0..=u16::MAX {
            assert!(angle(plain_decode(code), Oct16::decode(code)) < 0.03, "{code:#x}");
            let v = Oct16::decode(code);
            assert!(angle(Oct16::decode(bevy_encode(v)), v) < 1.1, "{code:#x}");
            let mut filtered = meshopt_codes(&[[v[0], v[1], v[2], 0.0]]);
            meshopt::decode_filter_oct(&mut filtered);
            let [x, y, z, _] = filtered[0].map(f32::from);
            assert!(angle([x, y, z], v) < 1.5, "{code:#x}: {filtered:?}");
        }
    }
}
