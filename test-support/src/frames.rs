//! Tangent frames in `f64`: the direction of an input, and what a code means; and frames as columns.

use std::f64::consts::TAU;

use unitpack::frame::{Frame, FrameSoa, FrameSoaMut};
use unitpack::{Soa, SoaMut};

use crate::vectors::{cross, dot, length, normalize, plus, scaled, widen};

/// The direction of an input; `None` for zero and NaN.
pub fn direction(v: [f32; 3]) -> Option<[f64; 3]> {
    if v.iter().any(|c| c.is_nan()) || v == [0.0; 3] {
        None
    } else if v.iter().any(|c| c.is_infinite()) {
        Some(normalize(v.map(|c| if c.is_infinite() { f64::from(c).signum() } else { 0.0 })))
    } else {
        Some(normalize(widen(v)))
    }
}

/// Two vectors across a normal, by the listing of Duff et al.
pub fn basis([x, y, z]: [f64; 3]) -> [[f64; 3]; 2] {
    let sign = if z < 0.0 { -1.0 } else { 1.0 };
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [[1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}

/// The direction that a frame's tangent is encoded as, about this normal: its part across. `None`
/// if it is parallel to its own normal.
pub fn part_across(frame: Frame, normal: [f64; 3]) -> Option<[f64; 3]> {
    let tangent = direction(frame.tangent)?;
    let own = direction(frame.normal).unwrap_or([0.0, 0.0, 1.0]);
    let sine = length(cross(own, tangent));
    let across = |v, normal| plus(v, scaled(normal, -dot(v, normal)));
    (sine > 2e-6).then(|| across(across(tangent, own), normal))
}

/// The frame of an octahedral code of two times `oct` bits and an angle.
pub fn oct_angle(code: u64, oct: u32, angle: u32) -> ([f64; 3], [f64; 3]) {
    let max = (1i64 << (oct - 1)) - 1;
    let [u, w] = [0, oct].map(|at| ((code << (64 - at - oct)) as i64 >> (64 - oct)).max(-max));
    // In integers, so that it is 0 where it should.
    let z = max - u.abs() - w.abs();
    let fold = |a: i64, b: i64| (max - b.abs()) * if a < 0 { -1 } else { 1 };
    let p = if z < 0 { [fold(u, w), fold(w, u), z] } else { [u, w, z] }.map(|c| c as f64);
    let normal = normalize(p);
    let turns = (code >> (2 * oct) & ((1 << angle) - 1)) as f64 / (1u64 << angle) as f64;
    let (sin, cos) = (TAU * turns).sin_cos();
    let [a, b] = basis(normal);
    (normal, plus(scaled(a, cos), scaled(b, sin)))
}

/// The frame of a quaternion.
pub fn quaternion(code: [i16; 4]) -> ([f64; 3], [f64; 3]) {
    let [x, y, z, w] = code.map(|c| f64::from(c.max(-32767)));
    let w = if w == 0.0 { 1.0 } else { w };
    // q v q*, of z and of x.
    let turn = |v: [f64; 3]| {
        let q = [x, y, z];
        let c = plus(cross(q, v), scaled(v, w));
        plus(plus(scaled(cross(q, c), 2.0), v), scaled(v, x * x + y * y + z * z + w * w - 1.0))
    };
    // v |q|^2 + 2 q x (q x v + w v).
    (normalize(turn([0.0, 0.0, 1.0])), normalize(turn([1.0, 0.0, 0.0])))
}

/// By how many steps a code is off the unit quaternion of its direction.
pub fn off_unit(code: [i16; 4]) -> f64 {
    let wide = code.map(f64::from);
    let length = wide.iter().map(|c| c * c).sum::<f64>().sqrt();
    let longest = wide.iter().fold(0.0f64, |longest, c| longest.max(c.abs()));
    longest * (1.0 - 32767.0 / length).abs()
}

/// Normal and tangent.
pub fn vectors(frame: Frame) -> ([f64; 3], [f64; 3]) {
    (widen(frame.normal), widen(frame.tangent))
}

/// Normals, tangents and handedness of frames, a column a component.
pub fn columns(frames: &[Frame]) -> [Vec<f32>; 7] {
    [0, 1, 2, 3, 4, 5, 6].map(|i| {
        let column = |f: &Frame| match i {
            0..3 => f.normal[i],
            3..6 => f.tangent[i - 3],
            _ => f.handedness,
        };
        frames.iter().map(column).collect()
    })
}

/// Such columns as a structure of arrays.
pub fn soa([nx, ny, nz, tx, ty, tz, handedness]: &[Vec<f32>; 7]) -> FrameSoa<'_> {
    let (normal, tangent) = (Soa { x: nx, y: ny, z: nz }, Soa { x: tx, y: ty, z: tz });
    FrameSoa { normal, tangent, handedness }
}

/// [`soa`] to write.
pub fn soa_mut([nx, ny, nz, tx, ty, tz, handedness]: &mut [Vec<f32>; 7]) -> FrameSoaMut<'_> {
    let (normal, tangent) = (SoaMut { x: nx, y: ny, z: nz }, SoaMut { x: tx, y: ty, z: tz });
    FrameSoaMut { normal, tangent, handedness }
}
