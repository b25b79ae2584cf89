//! Kills mutants of the quaternions.

mod support;

use bytemuck::{Pod, Zeroable, bytes_of, bytes_of_mut};
use support::{ODD, Random, SIMPLE};
use unitpack::LengthMismatch;
use unitpack::quaternion::*;
use unitpack_test::digests::{Section, digest};

/// Quaternions of every kind, in an order that brings different kinds into one block of lanes.
fn quaternions<C: QuaternionCodec>() -> Vec<[f32; 4]> {
    let mut random = Random(1);
    let points = decoded::<C>(&codes::<C>(), 1);
    (0..1003)
        .map(|i| {
            let mut q = [0; 4].map(|_| random.signed());
            let at = random.bits() as usize % 4;
            match i % 9 {
                0 => q = q.map(|_| random.pick(&SIMPLE)),
                1 => q = q.map(|_| random.pick(&ODD)),
                2 => q[at] = if i % 2 == 0 { f32::NAN } else { 10.0 },
                // Two components about equal.
                3 => q[at] = q[(at + 1) % 4] * random.pick(&[1.0, -1.0, 1.0001, 0.998]),
                // All four, where all charts have codes.
                4 => q = q.map(|c| 1.0 + 0.02 * c),
                // On the grid, and half way.
                5 => q = points[random.bits() as usize % points.len()],
                6 => {
                    let [a, b] = [0; 2].map(|_| points[random.bits() as usize % points.len()]);
                    q = [0, 1, 2, 3].map(|i| a[i] + b[i]);
                }
                // One vanishes, and the others are in a corner of its chart.
                7 => {
                    q = q.map(|c| 0.577f32.copysign(c) + 0.05 * c);
                    q[at] = random.pick(&[0.0, 1e-5, 1e-3, -1e-3]);
                }
                _ => {}
            }
            q
        })
        .collect()
}

/// Codes of any bits, and those at which a field ends.
fn codes<C: QuaternionCodec>() -> Vec<C::Code> {
    const TURNS: [u8; 10] = [0x00, 0x01, 0x3C, 0x7C, 0x7F, 0x80, 0x81, 0xBC, 0xFE, 0xFF];
    let mut random = Random(2);
    let mut codes = vec![C::Code::zeroed(); 1003];
    for (i, code) in codes.iter_mut().enumerate() {
        for byte in bytes_of_mut(code) {
            let bits = random.bits();
            *byte = if i % 3 == 0 { TURNS[bits as usize % 10] } else { (bits >> 24) as u8 };
        }
    }
    codes
}

/// Decodes in lanes, as both layouts and, every so many, alone: all must agree.
fn decoded<C: QuaternionCodec>(codes: &[C::Code], every: usize) -> Vec<[f32; 4]> {
    let [mut x, mut y, mut z, mut w] = [0; 4].map(|_| vec![0.0; codes.len()]);
    let q = Soa4Mut { x: &mut x, y: &mut y, z: &mut z, w: &mut w };
    C::decode_soa(codes, q).unwrap();
    let mut aos = vec![[0.0; 4]; codes.len()];
    C::decode_aos(codes, &mut aos).unwrap();
    for (i, &q) in aos.iter().enumerate() {
        assert_eq!([x[i], y[i], z[i], w[i]].map(f32::to_bits), q.map(f32::to_bits));
    }
    for (&code, q) in codes.iter().zip(&aos).step_by(every) {
        assert_eq!(C::decode(code).map(f32::to_bits), q.map(f32::to_bits), "{code:x?}");
    }
    aos
}

fn bytes<T: Pod>(slice: &[T]) -> impl Iterator<Item = u8> + '_ {
    slice.iter().flat_map(|t| bytes_of(t).to_vec())
}

/// Of `decode`, `canonical`, `encode` and `encode_precise`.
fn digests<C: QuaternionCodec>() -> [u64; 4] {
    let codes = codes::<C>();
    let decoded = decoded::<C>(&codes, 8);
    let canonical: Vec<C::Code> = codes.iter().map(|&code| C::canonical(code)).collect();
    for (&code, &canonical) in codes.iter().zip(&canonical) {
        assert_eq!(C::is_canonical(code), code == canonical);
    }
    let aos = quaternions::<C>();
    let [x, y, z, w] = [0, 1, 2, 3].map(|i| aos.iter().map(|q| q[i]).collect::<Vec<f32>>());
    let soa = Soa4 { x: &x, y: &y, z: &z, w: &w };
    let [mut fast, mut fast_aos, mut precise, mut precise_aos] =
        [0; 4].map(|_| vec![C::Code::zeroed(); aos.len()]);
    C::encode_soa(soa, &mut fast).unwrap();
    C::encode_aos(&aos, &mut fast_aos).unwrap();
    C::encode_soa_precise(soa, &mut precise).unwrap();
    C::encode_aos_precise(&aos, &mut precise_aos).unwrap();
    assert_eq!((&fast, &precise), (&fast_aos, &precise_aos));
    for (i, &q) in aos.iter().enumerate().step_by(8) {
        assert_eq!([fast[i], precise[i]], [C::encode(q), C::encode_precise(q)], "{q:?}");
    }
    [
        digest(bytes(&decoded)),
        digest(bytes(&canonical)),
        digest(bytes(&fast)),
        digest(bytes(&precise)),
    ]
}

fn add<C: QuaternionCodec>(section: &mut Section) {
    digests::<C>().into_iter().for_each(|digest| section.add(C::NAME, digest));
}

#[test]
fn digests_have_not_changed() {
    let columns = &["decode", "canonical", "encode", "encode_precise"];
    let mut section = Section::open("mutants: quaternion", columns);
    add::<SmallestThree32>(&mut section);
    add::<SmallestThree48>(&mut section);
    add::<SmallestThree64>(&mut section);
    add::<TanThree32>(&mut section);
    section.finish();
}

#[test]
fn a_rotation_has_one_code() {
    // (511, 511, 0, 0) is a quaternion in all charts.
    let code = |i: i32, j: i32, l: i32, left_out: u32| {
        (i & 1023) as u32 | ((j & 1023) as u32) << 10 | ((l & 1023) as u32) << 20 | left_out << 30
    };
    let canonical = code(511, 0, 0, 0);
    for same in [canonical, code(511, 0, 0, 1), code(511, 511, 0, 2), code(-511, -511, 0, 3)] {
        assert_eq!(SmallestThree32::canonical(same), canonical);
        assert_eq!(SmallestThree32::encode_precise(SmallestThree32::decode(same)), canonical);
        assert_eq!(TanThree32::canonical(code(511, 0, 0, 1)), canonical);
    }
    assert_eq!(SmallestThree32::encode([1.0, 1.0, 0.0, 0.0]), canonical);
    assert_eq!(SmallestThree32::encode([0.0; 4]), code(0, 0, 0, 3));
    // Rounded in the chart of w, where it is 385 again.
    let q = [335.51, 335.51, 384.51, 386.34];
    assert_eq!(SmallestThree32::encode(q), code(336, 336, 385, 2));
}

#[test]
fn other_lengths_are_refused() {
    let c = [0.5; 9];
    for [x, y, z, w, codes] in
        [[8, 9, 9, 9, 9], [9, 8, 9, 9, 9], [9, 9, 8, 9, 9], [9, 9, 9, 8, 9], [9, 9, 9, 9, 8]]
    {
        let error = LengthMismatch::Quaternions { x, y, z, w, codes };
        let words = format!("lengths differ: x {x}, y {y}, z {z}, w {w}, codes {codes}");
        assert_eq!(error.to_string(), words);
        let q = Soa4 { x: &c[..x], y: &c[..y], z: &c[..z], w: &c[..w] };
        let mut to = [7; 9];
        assert_eq!(SmallestThree32::encode_soa(q, &mut to[..codes]), Err(error));
        assert_eq!(SmallestThree32::encode_soa_precise(q, &mut to[..codes]), Err(error));
        let [mut a, mut b, mut c, mut d] = [[7.0; 9]; 4];
        let q = Soa4Mut { x: &mut a[..x], y: &mut b[..y], z: &mut c[..z], w: &mut d[..w] };
        assert_eq!(SmallestThree32::decode_soa(&[0; 9][..codes], q), Err(error));
    }
    for [vectors, codes] in [[8, 9], [9, 8]] {
        let error = Err(LengthMismatch::Aos { vectors, codes });
        let (mut q, mut to) = ([[7.0; 4]; 9], [7; 9]);
        assert_eq!(SmallestThree32::encode_aos(&q[..vectors], &mut to[..codes]), error);
        assert_eq!(SmallestThree32::encode_aos_precise(&q[..vectors], &mut to[..codes]), error);
        assert_eq!(SmallestThree32::decode_aos(&to[..codes], &mut q[..vectors]), error);
    }
}
