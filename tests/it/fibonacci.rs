//! Spherical Fibonacci of any number of points, against `f64` and every point.

use std::f64::consts::TAU;

use unitpack::{Codec, Fibonacci16, Fibonacci24, LengthMismatch, Soa, SoaMut, SphericalFibonacci};
use unitpack_test::Arrays;
use unitpack_test::oracle::fibonacci_point as exact;
use unitpack_test::random::{Rng, mixed_vectors, special_vectors};
use unitpack_test::vectors::{bits, chord_squared, length, normalize, widen};

fn points(n: u32) -> SphericalFibonacci {
    SphericalFibonacci::new(n).unwrap()
}

/// Directions, of which many are around the poles.
fn directions(rng: &mut Rng, n: u32, count: usize) -> Vec<[f32; 3]> {
    let mut direction = |i: usize| {
        if i.is_multiple_of(2) {
            return rng.direction();
        }
        let z = (1.0 - rng.unit() * 40.0 / f64::from(n)).max(-1.0);
        let (sin, cos) = (rng.unit() * TAU).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [r * cos, r * sin, if i % 4 == 1 { z } else { -z }].map(|c| c as f32)
    };
    (0..count).map(&mut direction).collect()
}

#[test]
fn the_nearest_of_all_points_is_found() {
    let mut rng = Rng::new(5);
    for n in (1..300).chain([377, 610, 987, 1000, 1597, 2000, 4181, 5000]) {
        let all: Vec<_> = (0..n).map(|i| exact(i, n)).collect();
        for v in directions(&mut rng, n, 1500) {
            let w = normalize(widen(v));
            let least = all.iter().map(|&p| chord_squared(w, p)).fold(4.0, f64::min).sqrt();
            let index = points(n).encode(v);
            let found = chord_squared(w, all[index as usize]).sqrt();
            assert!(found - least < 2.5e-7, "{n} points: {v:?} is {index}, {found} not {least}");
        }
    }
}

/// Around the equator and the poles every point of many is found again, which a wrong cell would not do.
#[test]
fn points_come_back() {
    let mut rng = Rng::new(6);
    for n in [1, 2, 3, 10, 1000, 65_537, 1_000_000, (1 << 24) - 1, 1 << 24] {
        let step = (n / 50_000).max(1);
        let mut indices: Vec<u32> = (0..n).step_by(step as usize).collect();
        indices.extend(
            (0..200).flat_map(|i| [i, n / 2 + i, n.wrapping_sub(i + 1)]).filter(|&i| i < n),
        );
        indices.extend((0..1000).map(|_| rng.below(n.into()) as u32));
        for i in indices {
            let v = points(n).decode(i);
            let off = chord_squared(widen(v), exact(i, n)).sqrt();
            assert!(off < 5e-7, "{n} points: {i} is {v:?}, off by {off:e}");
            assert!((length(widen(v)) - 1.0).abs() <= 2.5e-7, "{n} points: {i}");
            assert_eq!(points(n).encode(v), i, "{n} points: {v:?}");
        }
        for beyond in [n, n + 1, u32::MAX] {
            assert_eq!(points(n).decode(beyond), points(n).decode(n - 1));
        }
    }
}

#[test]
fn the_stated_error_holds() {
    let mut rng = Rng::new(7);
    for n in [100, 1000, 30_000, 1 << 24] {
        let (mut sum, mut greatest) = (0.0, 0.0f64);
        let count = 20_000;
        for v in (0..count).map(|_| rng.direction()) {
            let p = exact(points(n).encode(v), n);
            let off = chord_squared(p, normalize(widen(v))).sqrt();
            sum += off;
            greatest = greatest.max(off);
        }
        let root = f64::from(n).sqrt();
        let (mean, greatest) = (sum / f64::from(count) * root, greatest * root);
        assert!(
            (1.3..1.4).contains(&mean) && (2.3..2.8).contains(&greatest),
            "{n}: {mean} {greatest}"
        );
    }
}

#[test]
fn from_1_to_2_to_the_24() {
    assert_eq!(SphericalFibonacci::new(0), None);
    assert_eq!(SphericalFibonacci::new((1 << 24) + 1), None);
    assert_eq!(SphericalFibonacci::new(u32::MAX), None);
    assert_eq!([1, 7, 1 << 24].map(|n| points(n).points()), [1, 7, 1 << 24]);
}

/// Zero and NaN are +Z, infinities their limit.
#[test]
fn any_input_has_an_index() {
    for n in [1, 2, 12, 4096] {
        for v in special_vectors() {
            let index = points(n).encode(v);
            assert!(index < n);
            let [x, y, z] = v;
            let expected = if v.iter().any(|c| c.is_nan()) || v == [0.0; 3] {
                [0.0, 0.0, 1.0]
            } else if v.iter().any(|c| c.is_infinite()) {
                [x, y, z].map(|c| if c.is_infinite() { c.signum() } else { 0.0 })
            } else {
                continue;
            };
            assert_eq!(index, points(n).encode(expected), "{v:?}");
        }
    }
}

#[test]
fn batches_and_formats_give_the_same() {
    let vectors = mixed_vectors(8, 12_000);
    let arrays = Arrays::from(&vectors[..]);
    for n in [1, 100, 1 << 16, 12_345_678, 1 << 24] {
        let points = points(n);
        let mut indices = vec![u32::MAX; vectors.len()];
        points.encode_soa(arrays.read(), &mut indices).unwrap();
        let mut back = Arrays::unwritten([vectors.len(); 3]);
        points.decode_soa(&indices, back.write()).unwrap();
        for ((&v, &index), back) in vectors.iter().zip(&indices).zip(back.bits()) {
            assert_eq!(points.encode(v), index, "{v:?}");
            let decoded = points.decode(index);
            assert_eq!(back, bits(decoded));
            match n {
                0x1_0000 => {
                    assert_eq!(Fibonacci16::encode(v), index as u16);
                    assert_eq!(Fibonacci16::decode(index as u16), decoded);
                }
                0x100_0000 => {
                    let [r, g, b, _] = index.to_le_bytes();
                    assert_eq!(Fibonacci24::encode(v), [r, g, b]);
                    assert_eq!(Fibonacci24::decode([r, g, b]), decoded);
                }
                _ => {}
            }
        }
    }
}

#[test]
fn lengths_are_checked() {
    let [mut x, mut y, mut z] = [[7.0; 3], [7.0; 3], [7.0; 3]];
    let mut indices = [9; 2];
    let error = Err(LengthMismatch::Soa { x: 3, y: 3, z: 3, codes: 2 });
    assert_eq!(points(10).encode_soa(Soa { x: &x, y: &y, z: &z }, &mut indices), error);
    assert_eq!(indices, [9; 2]);
    let v = SoaMut { x: &mut x, y: &mut y, z: &mut z };
    assert_eq!(points(10).decode_soa(&indices, v), error);
    assert_eq!([x, y, z], [[7.0; 3]; 3]);
}
