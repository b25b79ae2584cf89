//! Kills mutants of the disk projections.

mod shared;

use unitpack::{Codec, EqDist20};

digests! {
    Stereo16 / 8 = [0x056B54DCE3EB43A8, 0x0D81E6404DAC6210, 0x02216849904CEAE6, 0x15A5390358B47EDA],
    Stereo24 / 8 = [0xCC616EE5C6B54BC6, 0xE2BD3FD7F06E3299, 0x4CC0DF5E4BEE93F4, 0xEB045AC99D707C02],
    Stereo32 / 8 = [0x13ACF3109D660681, 0xA024675CD6F586B6, 0xCEA85DB571F6ACF9, 0xF1D48243331373A7],
    StereoConcentric16 / 8 = [0x71A77B24124ADF39, 0x48E1472E26EC94EC, 0x706672309FB79830, 0x564B4133A0C535E2],
    StereoEllipse16 / 8 = [0x446B83CAAAD06915, 0x48E1472E26EC94EC, 0xA6A3EEAD7D9AC92D, 0xD88061E34CA96BAB],
    EqArea16 / 8 = [0x8443BB7B4B2CCE3D, 0x5C4E7801DBAEEB7E, 0x1BB7691CDCCBA1CA, 0x5CFD73FE9A2E3268],
    EqArea32 / 8 = [0xD8AF3DAEB9761C29, 0xA024675CD6F586B6, 0xFD9ED8511FD3157E, 0x0C2B760FEBF8F34A],
    EqAreaConcentric20 / 8 = [0xEEF03B6294AE53DE, 0x7FE838D3AD49645F, 0x3B9E8E50397C580A, 0x8E75EBE878C68CBA],
    EqAreaEllipse16 / 8 = [0x32E7096213F08B4B, 0x48E1472E26EC94EC, 0x4B7FF1584FFB6C9B, 0x8E62C9BF42E02556],
    EqAreaEllipse32 / 8 = [0xFE43761B64D2288E, 0x9A5485929F215A05, 0x508E98556E36C0D6, 0x1F97A8B2966EBEFF],
    EqDist16 / 8 = [0x2C518E27A4C0C940, 0x0D81E6404DAC6210, 0xCAF29174755F4E2A, 0x4389A5339B211EED],
    EqDist20 / 8 = [0x073620BAD3CF6283, 0x5E9CD435EAF2ECAB, 0xB2D130935766D5B3, 0xC7B09FD70B2F1444],
    EqDistConcentric16 / 8 = [0xA0F58D6C523D6DCD, 0x48E1472E26EC94EC, 0xBAB79A55E6F31E0A, 0x53024D17C11ADB32],
    EqDistEllipse24 / 8 = [0x294F4F9F0E193D46, 0x1E27416D148FFDAB, 0xD89DED200A961C59, 0xBCA739AF9FAD369A],
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
