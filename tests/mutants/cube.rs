//! Kills mutants of the cube maps.

mod shared;

digests! {
    Cube16 / 1 = [0xB1F05197E6F806B1, 0xF1CAF1A0D2E9D56D, 0xE4DCF14CF69C3A82, 0x36FAB2DA7AF92BDB, 0x15AEFDE0F079315D],
    Cube24 / 1 = [0xBBEF8B228E52D710, 0xDC01EDA2B242A640, 0xEA5BCF16FBC0F48B, 0x2ECE76A1479FDAAF, 0x94D88A60D9986CA9],
    Cube32 / 1 = [0x6C8DBC50E7A38A01, 0xD8DEC010B507EA1C, 0xA290F10B4A7E0808, 0x2447B9F78009AA04, 0x872F6669A26722E9],
    WarpedCube16 / 1 = [0xC15AB4AE0BA8804C, 0xF1CAF1A0D2E9D56D, 0x2773CF72D4DEA359, 0xC6BCCCD9CF5E988B, 0x15AEFDE0F079315D],
    WarpedCube32 / 1 = [0x3C647A7D7245EF9F, 0xD8DEC010B507EA1C, 0xA2F743F79827A579, 0x507D80510B622E4B, 0x872F6669A26722E9],
    AngularCube4 / 1 = [0xC727B3EFD20F5425, 0xD12EA59B86ED659E, 0x8EB918AF383703F2, 0x8EB918AF383703F2, 0xCD605DA2E647AAC5],
    AngularCube5 / 1 = [0xE473436ECE3D47ED, 0x336BAE4053CD9C70, 0xD54A85A707E29D24, 0xD5752711E8BABAB6, 0xF1382473F7C935A9],
    AngularCube8 / 1 = [0xD8374A8AC9EB03B5, 0x3A828942E6115B59, 0xAECD4B924DE2207A, 0x7BFCACAB636F4D5A, 0x785EDBCF8EE917AD],
    AngularCube16 / 1 = [0x29B07548B7DA5875, 0x624A3857ABDCEBF2, 0xB714936E468B2EC1, 0x5C21123A0F1AB051, 0xD319E0CFE716A046],
    AngularCube24 / 1 = [0x663EB97ADC4F98CF, 0x41F83395C53200E1, 0x353F817D29710945, 0x56D46396E8CCA53B, 0xFBE64C9F02BC1F9A],
    AngularCube31 / 1 = [0xA5E1D31D2CF8FFC6, 0x7304C83F9D6460C3, 0x606762CFA1EBC7D0, 0xEAFDC4674EB0B097, 0x2C3FAFBE3517E8A9],
    AngularCube32 / 1 = [0x3C53F2050ABF6A14, 0x03D7136AD4615F82, 0xCA548FB11B76B846, 0x1774B3904905BB02, 0x802ADACFE7F352A3],
}

#[test]
fn octant_tables_are_exact() {
    shared::octant_table_is_exact::<unitpack::Cube16>();
    shared::octant_table_is_exact::<unitpack::AngularCube4>();
    shared::octant_table_is_exact::<unitpack::AngularCube5>();
    shared::octant_table_is_exact::<unitpack::AngularCube8>();
    shared::octant_table_is_exact::<unitpack::AngularCube13>();
}

/// The decoder guesses the row of a cell, and is most often one off next to an end.
#[test]
fn ends_of_rows_have_not_changed() {
    let side = ((1u64 << 32) / 6).isqrt() as u32;
    let rows = (0..side).step_by(37).flat_map(|i| [(i, 0), (i, 1), (i, side - 2), (i, side - 1)]);
    let codes: Vec<u32> = rows.map(|(i, j)| (i * side + j) * 6 + i % 6).collect();
    let pinned = ("angularcube32", 0x93651FD49695BE35);
    shared::compare_decoded::<unitpack::AngularCube32>(pinned.0, &codes, pinned.1);
}
