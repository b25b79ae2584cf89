//! Kills mutants of spherical, phi-z, lat-long and spherical Fibonacci.

mod support;

use unitpack::Codec;

digests! { "mutants: spherical":
    Spherical16,
    Spherical24,
    Spherical32,
    PhiZUnorm8x2,
    PhiZUnorm16x2,
    LatLong16,
    LatLong24,
    LatLong32,
    LatLong16D,
    LatLong24D,
    LatLong32D,
    Fibonacci16,
    Fibonacci24,
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
    support::compare_decoded::<unitpack::LatLong32D>("mutants: ends of parallels", &ends);
}
