//! Kills mutants of the octahedral formats, and of what all formats stand on.

mod support;

digests! { "mutants: octahedral":
    Oct8,
    Oct16,
    Oct24,
    Oct32,
    WarpedOct16,
    WarpedOct24,
    WarpedOct32,
    EqAreaOct16,
    EqAreaOct24,
    EqAreaOct32,
    SixOct16,
    SixOct24,
    SixOct32,
    OctUnorm8x2,
    OctUnorm16x2,
    HemiOct16,
    HemiOct24,
    SignedOct21,
    SignedOct23,
    FrontOct16,
    FrontOct32,
    QuadFrontOct24,
    Octant16,
}

#[test]
fn octant_tables_are_exact() {
    support::octant_table_is_exact::<unitpack::Oct8>();
    support::octant_table_is_exact::<unitpack::Oct14>();
    support::octant_table_is_exact::<unitpack::HemiOct16>();
    support::octant_table_is_exact::<unitpack::Octant16>();
}
