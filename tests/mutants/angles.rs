//! Kills mutants of spherical, phi-z and lat-long.

mod shared;

use unitpack::Codec;

digests! {
    Spherical16 / 1 = [0x5612DF3A7E212236, 0x1BF879E8DC801E22, 0x49341D875B8CD279, 0xBB7437E96AB3E019, 0xB16711AEC7B835F9],
    Spherical24 / 1 = [0x95D93D81108C0FAF, 0x21DD12D719C89412, 0xA55124F6347D1BFD, 0xB057BE466E3AD7AF, 0x8401B78747127243],
    Spherical32 / 1 = [0x4E60BCA55DA3B105, 0x4F2BA64FB2950ED8, 0x3398F0E29B4E6D54, 0xBDE83EED065A44DD, 0x2F4BD599CDF7F84A],
    PhiZUnorm8x2 / 1 = [0x2C9854914099E7B2, 0xEEAF2C5F24D166B1, 0x192A72F326EDA8C0, 0x0EAB9A8B6A58CD91, 0x62E96F555816CAF9],
    PhiZUnorm16x2 / 1 = [0xCAE00C134F068F87, 0x39B810D29CE8B363, 0x58827B498A5A9184, 0x9F5097BB14F4EAB7, 0xD670E70A464F98EC],
    LatLong16 / 1 = [0xDB5A24035F96217E, 0xB0D90414A18281EA, 0x6E31D9B3AC8F2D1D, 0xBD0B326CA5BA3298, 0x56A327EB719E0A1B],
    LatLong24 / 1 = [0x615BD6E25498D6BC, 0x0BF344A168D0EB31, 0xC04C9A89C93C4CBB, 0xCC460EE110C91831, 0xE579B7124EB158EA],
    LatLong32 / 1 = [0x2756B931326D4EAF, 0x0DA9359962C00AC9, 0xEB9C3E7DE8EF9EEA, 0x95EC1D13498946ED, 0x419C1CBF22E55B81],
    LatLong16D / 1 = [0xA86F26FD39C8B2B6, 0xBAE931630E812503, 0x8D6CFFE522609B2A, 0xDA758653D7D05358, 0xB04F64CFB1840F2A],
    LatLong24D / 1 = [0x2FEA2F18E9845245, 0xBAE931630E812503, 0xE553B1D934397C2A, 0x7D26CD5585EDEA81, 0x00E5D440E31BD03C],
    LatLong32D / 1 = [0x7E0FB058DB47CE57, 0x2444AE9F37D02CB3, 0xC3A512ECE695FBF1, 0x9051B9D0CBF69871, 0x973E5A7A201E6C5F],
}

/// The decoder guesses the parallel of a code, and is most often one off next to an end.
#[test]
fn ends_of_parallels_have_not_changed() {
    let mut ends = Vec::new();
    for start in (0..u32::MAX - 200_000).step_by(9_000_001) {
        // Bisect for the first code of the next parallel.
        let z = unitpack::LatLong32D::decode(start)[2];
        let (mut here, mut beyond) = (start, start + 200_000);
        while beyond - here > 1 {
            let middle = here + (beyond - here) / 2;
            let same = unitpack::LatLong32D::decode(middle)[2] == z;
            *(if same { &mut here } else { &mut beyond }) = middle;
        }
        ends.extend([here - 1, here, beyond, beyond + 1]);
    }
    ends.extend([0, 1, u32::MAX - 1, u32::MAX]);
    let pinned = ("latlong32D", 0xCE853425F8F25543);
    shared::compare_decoded::<unitpack::LatLong32D>(pinned.0, &ends, pinned.1);
}
