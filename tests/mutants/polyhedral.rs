//! Kills mutants of the cube maps and the icosphere.

mod support;

digests! { "mutants: polyhedral":
    Cube16,
    Cube24,
    Cube32,
    WarpedCube16,
    WarpedCube32,
    AngularCube4,
    AngularCube5,
    AngularCube8,
    AngularCube16,
    AngularCube24,
    AngularCube31,
    AngularCube32,
    Icosphere162,
}

#[test]
fn octant_tables_are_exact() {
    support::octant_table_is_exact::<unitpack::Cube16>();
    support::octant_table_is_exact::<unitpack::AngularCube4>();
    support::octant_table_is_exact::<unitpack::AngularCube5>();
    support::octant_table_is_exact::<unitpack::AngularCube8>();
    support::octant_table_is_exact::<unitpack::AngularCube13>();
}

/// The decoder guesses the row of a cell, and is most often one off next to an end.
#[test]
fn ends_of_rows_have_not_changed() {
    let side = ((1u64 << 32) / 6).isqrt() as u32;
    let rows = (0..side).step_by(37).flat_map(|i| [(i, 0), (i, 1), (i, side - 2), (i, side - 1)]);
    let codes: Vec<u32> = rows.map(|(i, j)| (i * side + j) * 6 + i % 6).collect();
    support::compare_decoded::<unitpack::AngularCube32>("mutants: ends of rows", &codes);
}
