//! Kills mutants of the disk projections.

mod shared;

use bytemuck::{Zeroable, cast_slice};
use shared::{Random, code, digest};
use unitpack::{
    Codec, EqArea16, EqArea24, EqArea32, EqAreaEllipse32, EqDist16, EqDist20, EqDist32, Stereo16,
    Stereo32, StereoEllipse32,
};

digests! {
    Stereo16 / 8 = [0x056B54DCE3EB43A8, 0x0D81E6404DAC6210, 0x02216849904CEAE6, 0x15A5390358B47EDA, 0x10F4FC024E5A39B5],
    Stereo24 / 8 = [0xCC616EE5C6B54BC6, 0xE2BD3FD7F06E3299, 0x4CC0DF5E4BEE93F4, 0xEB045AC99D707C02, 0x2470F1BFF99DA55F],
    Stereo32 / 8 = [0x13ACF3109D660681, 0xA024675CD6F586B6, 0xCEA85DB571F6ACF9, 0xF1D48243331373A7, 0x577A84F385590D61],
    StereoConcentric16 / 8 = [0x71A77B24124ADF39, 0x48E1472E26EC94EC, 0x706672309FB79830, 0x564B4133A0C535E2, 0xD56DC68B8AF4FB9F],
    StereoEllipse16 / 8 = [0x446B83CAAAD06915, 0x48E1472E26EC94EC, 0xA6A3EEAD7D9AC92D, 0xD88061E34CA96BAB, 0xD56DC68B8AF4FB9F],
    EqArea16 / 8 = [0xAD6DE92E7309D511, 0x5C4E7801DBAEEB7E, 0x1BB7691CDCCBA1CA, 0x5CFD73FE9A2E3268, 0xB08832AB6B6928D1],
    EqArea32 / 8 = [0xCBBAB8E8B0BF0632, 0xA024675CD6F586B6, 0xFD9ED8511FD3157E, 0x0C2B760FEBF8F34A, 0x3A24B03E6C56F5B1],
    EqAreaConcentric20 / 8 = [0xE67241F837E059BB, 0x7FE838D3AD49645F, 0x3B9E8E50397C580A, 0x8E75EBE878C68CBA, 0x2BC26C43A7D716AB],
    EqAreaEllipse16 / 8 = [0x1A3D7E17AB21F97F, 0x48E1472E26EC94EC, 0x4B7FF1584FFB6C9B, 0x8E62C9BF42E02556, 0xD56DC68B8AF4FB9F],
    EqAreaEllipse32 / 8 = [0x8032AD97FAF872A8, 0x9A5485929F215A05, 0x508E98556E36C0D6, 0x22FFB037467960EC, 0xA63B5E87CFD3AF36],
    EqDist16 / 8 = [0x2C518E27A4C0C940, 0x0D81E6404DAC6210, 0xCAF29174755F4E2A, 0x4389A5339B211EED, 0x18C5D06D85191B4B],
    EqDist20 / 8 = [0x073620BAD3CF6283, 0x5E9CD435EAF2ECAB, 0xB2D130935766D5B3, 0xC7B09FD70B2F1444, 0x7806D1DE7E5D2B00],
    EqDistConcentric16 / 8 = [0xA0F58D6C523D6DCD, 0x48E1472E26EC94EC, 0xBAB79A55E6F31E0A, 0x53024D17C11ADB32, 0xD56DC68B8AF4FB9F],
    EqDistEllipse24 / 8 = [0x294F4F9F0E193D46, 0x1E27416D148FFDAB, 0xD89DED200A961C59, 0xBCA739AF9FAD369A, 0xF775EAD7291F7865],
}

#[test]
fn octant_tables_are_exact() {
    shared::octant_table_is_exact::<unitpack::EqArea16>();
    shared::octant_table_is_exact::<unitpack::StereoConcentric16>();
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

/// Compares the digest of some codes with the pinned one. With PIN in the environment prints that of
/// now.
fn compare<C: Codec>((name, pinned): (&str, u64), codes: &[C::Code]) {
    let now = digest(cast_slice(codes).iter().copied());
    if std::env::var_os("PIN").is_some() {
        println!("        ({name:?}, {now:#018X}),");
    } else {
        assert_eq!(now, pinned, "{name}");
    }
}

fn compare_precise<C: Codec>(pinned: (&str, u64), vectors: &[[f32; 3]]) {
    let mut codes = vec![C::Code::zeroed(); vectors.len()];
    C::encode_aos_precise(vectors, &mut codes).unwrap();
    compare::<C>(pinned, &codes);
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
    compare_precise::<StereoEllipse32>(("stereo_ellipse32", 0xDA920B51FF6706D6), &vectors);
    compare_precise::<EqAreaEllipse32>(("eqarea_ellipse32", 0x6E024860A28C335C), &vectors);
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
    compare_precise::<Stereo16>(("stereo16", 0xFCCF9E1D7E190412), &vectors);
    compare_precise::<Stereo32>(("stereo32", 0x448E519D9F04AF97), &vectors);
    compare_precise::<EqArea16>(("eqarea16", 0x4E9FFF9A99330945), &vectors);
    compare_precise::<EqDist16>(("eqdist16", 0x73BCEAE2B50B819C), &vectors);
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
    compare_precise::<EqArea16>(("eqarea16_poles", 0xAF2BBC43EEF826A1), &near(1000, 10));
    compare_precise::<EqArea24>(("eqarea24_poles", 0x791314B31ACDC555), &near(1000, 6));
    compare_precise::<EqArea32>(("eqarea32_poles", 0x8F292328B73506F7), &near(2000, 6));
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
    compare::<EqDist20>(("eqdist20", 0x59DA277B0FB310B2), &codes);
}
