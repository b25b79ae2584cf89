//! Kills mutants of Cartesian and XY-only.

mod support;

use unitpack::*;

digests! { "mutants: cartesian":
    Snorm5x3,
    Snorm8x3 / 4,
    Snorm11_11_10 / 16,
    Snorm16x3 / 256,
    Float16x3 / 64,
    Float32x3,
    XyzUnorm8x3 / 4,
    XyzUnorm16x3 / 256,
    XyzBiased8x3 / 4,
    CrytekBfn24 / 16,
    XyOnly16,
    XyOnly24 / 2,
    XyOnly32 / 4,
    XyOnly32F / 4,
    XyOnlyNormalized16,
    XyOnlySnorm16,
    XyOnlyBiased16,
}

#[test]
fn octant_tables_are_exact() {
    support::octant_table_is_exact::<Snorm5x3>();
    support::octant_table_is_exact::<XyOnly16>();
    support::octant_table_is_exact::<XyOnlyNormalized16>();
    support::octant_table_is_exact::<XyOnlySnorm16>();
    support::octant_table_is_exact::<XyOnlyBiased16>();
}

/// The nearest code of `v`.
fn precise<C: Codec>(v: [f32; 3], code: &[u8]) {
    assert_eq!(bytemuck::bytes_of(&C::encode_precise(v)), code, "{v:?}");
}

/// Where the nearest code is none that rounding gives, is barely nearer than the next, or has a
/// length that is no obvious choice.
#[test]
fn nearest_of_hard_vectors() {
    precise::<Snorm5x3>([0.589404, -0.5665983, 0.53191566], &[0x6D, 0x32]);
    precise::<Snorm5x3>([0.25481176, -0.7010031, -0.72706854], &[0x45, 0x4A]);
    precise::<Snorm5x3>([1.0, -0.062225975, -0.033302076], &[0xEF, 0x7F]);
    precise::<Snorm5x3>([-0.92347515, 0.9964549, 0.96284455], &[0xF2, 0x3D]);
    precise::<Snorm8x3>([0.9927786, -0.9986093, -1.0029315], &[0x7C, 0x83, 0x83]);
    precise::<Snorm8x3>([-1.9914265, 0.99286306, 1.9990106], &[0x82, 0x3F, 0x7F]);
    precise::<Snorm11_11_10>([1.0000129, 2.0000827, -1.999952], &[0x00, 0xFA, 0x5F, 0x80]);
    precise::<Snorm11_11_10>([244.0, -328.0, 9.0 * 1023.0 / 511.0], &[0xDC, 0x42, 0xE1, 0x06]);
    precise::<Snorm16x3>(
        [0.5048139, 0.50482273, 0.50478584],
        &[0xB9, 0x3C, 0xB9, 0x3C, 0xB8, 0x3C],
    );
    precise::<XyzUnorm16x3>(
        [0.6069422, 0.6069523, 0.60694355],
        &[0xD7, 0xFF, 0xD8, 0xFF, 0xD7, 0xFF],
    );
    precise::<Float16x3>(
        [0.2868867, -0.3754654, -0.38416338],
        &[0xAB, 0x35, 0x6B, 0xB7, 0x97, 0xB7],
    );
    precise::<Float16x3>(
        [0.56531024, -0.48752224, 1.5816688e-8],
        &[0x4D, 0x38, 0x6B, 0xB7, 0x01, 0x00],
    );
    precise::<Float16x3>(
        [-0.37814152, -0.25551438, 0.27150762],
        &[0x67, 0xB9, 0x4D, 0xB7, 0xC2, 0x37],
    );
    precise::<Float16x3>(
        [-1.0005814, -1.0003159, -0.99942344],
        &[0xA0, 0xB7, 0xA0, 0xB7, 0x9E, 0xB7],
    );
    precise::<Float16x3>(
        [-0.9977981, -0.06632454, 4.9585513e-5],
        &[0x51, 0xBB, 0xC8, 0xAB, 0xFB, 0x02],
    );
    precise::<XyzUnorm8x3>([-0.57240736, 0.69532585, -5.921365e-10], &[0x19, 0xFC, 0x7F]);
    precise::<XyzUnorm8x3>([-0.99837416, 1.0048618, -0.9931956], &[0x01, 0xFF, 0x02]);
    precise::<XyOnly32>([0.50143874, -0.35518062, -0.4948815], &[0x74, 0xE8, 0x04, 0x36]);
    precise::<XyOnly32F>([-0.0055607366, 0.99602944, 0.007958152], &[0xB8, 0x9D, 0x00, 0x3C]);
    precise::<XyOnlySnorm16>([0.92671347, 0.3754029, 0.016575687], &[0x79, 0x31]);
    precise::<XyOnlySnorm16>([-0.5089389, -0.8606729, 0.014944942], &[0xBC, 0x8D]);
    precise::<XyOnlySnorm16>([-0.98833394, 0.13363591, 0.0730577], &[0x83, 0x14]);
    precise::<XyOnlySnorm16>([4.0, -3.0, 0.0], &[0x68, 0xB2]);
    precise::<XyOnlyBiased16>([-0.98916835, 0.14089192, 0.041175347], &[0x02, 0x8F]);
    precise::<XyOnlyBiased16>([0.43829826, 0.89882225, 0.0036307403], &[0xBB, 0xF9]);
    precise::<XyOnlyNormalized16>([0.9480011, 0.3181925, 0.0068866], &[0xFE, 0xAA]);
    precise::<XyOnlyNormalized16>([-0.50538743, -0.86288613, 0.003328909], &[0x36, 0x02]);
    precise::<XyOnlyNormalized16>([0.9969118, -0.060424857, 0.050156046], &[0xFE, 0x73]);
    precise::<XyOnlyNormalized16>([3.0, 5.0, 0.0], &[0xC3, 0xF0]);
    precise::<XyzBiased8x3>([0.9927786, -0.9986093, -1.0029315], &[0xFC, 0x03, 0x03]);
}

/// The least multiple beyond the rim, found by trying all.
#[test]
fn first_multiples_beyond_the_rim() {
    /// Of points that are `step` apart, in steps of which `most` are 1.
    fn check(step: usize, most: i32, canonical: impl Fn(i32, i32) -> [i32; 2]) {
        let values = || (-most..=most).step_by(step);
        for [i, j] in values().flat_map(|i| values().map(move |j| [i, j])) {
            let beyond = |[i, j]: [i32; 2]| i * i + j * j >= most * most;
            let divides = |by: &i32| i % by == 0 && j % by == 0;
            let point = if beyond([i, j]) {
                let divisor = (1..=most).rev().find(divides).unwrap();
                let multiples =
                    (1..=divisor).step_by(step).map(|n| [i, j].map(|c| c / divisor * n));
                multiples.into_iter().find(|&multiple| beyond(multiple)).unwrap()
            } else {
                [i, j]
            };
            assert_eq!(canonical(i, j), point, "({i}, {j})");
        }
    }
    check(1, 127, |i, j| {
        let code = u16::from_le_bytes([i as u8, j as u8]);
        XyOnlySnorm16::canonical(code).to_le_bytes().map(|c| i32::from(c as i8))
    });
    check(1, 127, |i, j| {
        let code = u16::from_le_bytes([i, j].map(|c| (c + 128) as u8));
        XyOnlyBiased16::canonical(code).to_le_bytes().map(|c| i32::from(c) - 128)
    });
    check(2, 255, |i, j| {
        let code = u16::from_le_bytes([i, j].map(|c| ((c + 255) / 2) as u8));
        XyOnlyNormalized16::canonical(code).to_le_bytes().map(|c| 2 * i32::from(c) - 255)
    });
}

/// Points half way between whose multiples the length is 1 but for one part in a million. In no grid of
/// equal steps is there one, as there the squares of lengths are integers.
#[test]
fn multiples_that_are_almost_as_near_to_length_1() {
    let (most, least) = (1023i64, 511i64);
    let length = |[x, y, z]: [i64; 3]| {
        let [u, v, w] = [x as f64 / most as f64, y as f64 / most as f64, z as f64 / least as f64];
        (u * u + v * v + w * w).sqrt()
    };
    let mut count = 0;
    for halves in [3, 5, 7, 9, 11] {
        let wanted = 2.0 / halves as f64;
        for (x, z) in (0..=most).flat_map(|x| (0..=least).map(move |z| (x, z))) {
            let rest = wanted * wanted - length([x, 0, z]).powi(2);
            let point = [x, (rest.max(0.0).sqrt() * most as f64).round() as i64, z];
            if (length(point) / wanted - 1.0).abs() > 5e-7 {
                continue;
            }
            let divides = |by: &i64| point.iter().all(|c| c % by == 0);
            let primitive = point.map(|c| c / (1..=most).rev().find(divides).unwrap());
            let nearest = (1..=most)
                .map(|times| primitive.map(|c| c * times))
                .take_while(|&[x, y, z]| x.max(y) <= most && z <= least)
                .min_by(|&a, &b| (length(a) - 1.0).abs().total_cmp(&(length(b) - 1.0).abs()));
            let code = |[x, y, z]: [i64; 3]| (x | y << 11 | z << 22) as u32;
            assert_eq!(Snorm11_11_10::canonical(code(point)), code(nearest.unwrap()), "{point:?}");
            count += 1;
        }
    }
    assert!(count > 100, "{count}");
}
