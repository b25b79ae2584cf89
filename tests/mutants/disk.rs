//! Kills mutants of the disk projections.

mod support;

use bytemuck::{Zeroable, cast_slice};
use support::{Random, code};
use unitpack::{
    Codec, EqArea16, EqArea24, EqArea32, EqAreaEllipse32, EqDist16, EqDist20, EqDist32, Stereo16,
    Stereo32, StereoEllipse32,
};
use unitpack_test::digests::{Section, digest};

digests! { "mutants: disk":
    Stereo16 / 8,
    Stereo24 / 8,
    Stereo32 / 8,
    StereoConcentric16 / 8,
    StereoEllipse16 / 8,
    EqArea16 / 8,
    EqArea32 / 8,
    EqAreaConcentric20 / 8,
    EqAreaEllipse16 / 8,
    EqAreaEllipse32 / 8,
    EqDist16 / 8,
    EqDist20 / 8,
    EqDistConcentric16 / 8,
    EqDistEllipse24 / 8,
}

#[test]
fn octant_tables_are_exact() {
    support::octant_table_is_exact::<unitpack::EqArea16>();
    support::octant_table_is_exact::<unitpack::StereoConcentric16>();
}

/// Eight points of eqdist20 stand outside the disk of one hemisphere and inside that of the other.
#[test]
fn what_stands_twice_belongs_to_its_own_hemisphere() {
    let code = |u: i32, v: i32| (u & 1023 | (v & 1023) << 10) as u32;
    for ([u, v], [own_u, own_v]) in [([8, 432], [-118, 240]), ([503, 432], [-393, 240])] {
        for [sign_u, sign_v] in [[1, 1], [1, -1], [-1, 1], [-1, -1]] {
            let outside = code(sign_u * u, sign_v * v);
            let own = code(sign_u * own_u, sign_v * own_v);
            assert_eq!(EqDist20::canonical(outside), own);
            assert_eq!(EqDist20::canonical(own), own);
            assert_eq!(EqDist20::encode_precise(EqDist20::decode(outside)), own);
        }
    }
}

/// Adds the digest of codes.
fn add<C: Codec>(section: &mut Section, codes: &[C::Code]) {
    section.add(C::FORMAT.name(), digest(cast_slice(codes).iter().copied()));
}

fn add_precise<C: Codec>(section: &mut Section, vectors: &[[f32; 3]]) {
    let mut codes = vec![C::Code::zeroed(); vectors.len()];
    C::encode_aos_precise(vectors, &mut codes).unwrap();
    add::<C>(section, &codes);
}

/// One that is below 1 as often as below 1/2, 1/4 and so on.
fn small(random: &mut Random, halvings: u32) -> f32 {
    random.signed() / (1u32 << (random.bits() % halvings)) as f32
}

fn one(random: &mut Random) -> f32 {
    if random.bits() >> 31 == 1 { 1.0 } else { -1.0 }
}

/// Towards the corners of the ellipse's square a cell is sheared, and the nearest point may stand
/// far along a diagonal.
#[test]
fn corners_have_not_changed() {
    let mut random = Random(3);
    let vectors: Vec<[f32; 3]> = (0..4000)
        .map(|_| {
            let r = &mut random;
            let side = [0; 2].map(|_| one(r) * (1.0 + small(r, 20) / 16.0));
            [side[0], side[1], small(r, 20) / 16.0]
        })
        .collect();
    let mut section = Section::open("mutants: corners of disks", &["encode_precise"]);
    add_precise::<StereoEllipse32>(&mut section, &vectors);
    add_precise::<EqAreaEllipse32>(&mut section, &vectors);
    section.finish();
}

/// Past the equator points stand outside the disk.
#[test]
fn rims_have_not_changed() {
    let mut random = Random(4);
    let vectors: Vec<[f32; 3]> = (0..1000)
        .map(|_| {
            let r = &mut random;
            [r.signed(), small(r, 20), small(r, 20)]
        })
        .collect();
    let mut section = Section::open("mutants: rims of disks", &["encode_precise"]);
    add_precise::<Stereo16>(&mut section, &vectors);
    add_precise::<Stereo32>(&mut section, &vectors);
    add_precise::<EqArea16>(&mut section, &vectors);
    add_precise::<EqDist16>(&mut section, &vectors);
    section.finish();
}

/// The other pole is the corners of eqarea's square, where cells are long.
#[test]
fn poles_have_not_changed() {
    let mut random = Random(5);
    let mut near = |count: usize, halvings: u32| -> Vec<[f32; 3]> {
        (0..count)
            .map(|_| {
                let r = &mut random;
                let far = (1.0 + 0.5 * r.signed()) / (1u32 << (r.bits() % halvings)) as f32;
                [far * one(r), far * one(r) * (1.0 + small(r, 16)), one(r)]
            })
            .collect()
    };
    let mut section = Section::open("mutants: poles of disks", &["encode_precise"]);
    add_precise::<EqArea16>(&mut section, &near(1000, 10));
    add_precise::<EqArea24>(&mut section, &near(1000, 6));
    add_precise::<EqArea32>(&mut section, &near(2000, 6));
    section.finish();
}

/// What is decoded, times a power of two, is encoded as what it was.
fn is_found_again<C: Codec>(codes: &[u32]) {
    for code in codes.iter().map(|&index| code::<C>(index)) {
        let v = C::decode(code);
        for exponent in -30..=30 {
            let code_again = C::encode_precise(v.map(|c| c * 2f32.powi(exponent)));
            assert_eq!(code_again, C::canonical(code), "{code:x?} at 2^{exponent}");
        }
    }
}

/// Points of two charts that `f32` hardly keeps apart: rounded once more, as all else is, one would
/// be the other.
#[test]
fn close_points_are_kept_apart() {
    is_found_again::<Stereo32>(&[0xABDD9871, 0xA63A602E, 0xC089921D, 0x2A79FC47]);
    is_found_again::<EqArea32>(&[0x37976E80, 0x47E29F53, 0x8C21D8AB, 0x17D17EAD]);
    is_found_again::<EqDist32>(&[0xA038A28E, 0x576BDFB4, 0xBC1F163C, 0xE61A0162]);
    // One or two of the components are the same.
    for index in [0x7A14F619, 0x81102622, 0xA7AF051B, 0x7A2AD8E5] {
        assert!(EqDist32::is_canonical(index));
    }
    // All three are.
    assert_eq!(Stereo32::canonical(0x4C137E6A), 0x3A529027);
    assert_eq!(EqArea32::canonical(0xAF4501F2), 0xC736EBA7);
    assert_eq!(EqDist32::canonical(0x825F0CFC), 0xB6EADDAE);
}

/// Few points are on the equator, or stand twice.
#[test]
fn canonical_codes_have_not_changed() {
    let rows = 0..512;
    let codes = rows.flat_map(|v| (0..512).map(move |u: i32| (-u & 1023 | v << 10) as u32));
    let codes: Vec<u32> = codes.map(EqDist20::canonical).collect();
    let mut section = Section::open("mutants: canonical codes of disks", &["canonical"]);
    add::<EqDist20>(&mut section, &codes);
    section.finish();
}
