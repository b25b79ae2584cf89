//! Decoding through a table gives the bits that `decode` gives, for every pattern of every format
//! of at most 16 bits.
//!
//! The tables that are chosen at run time, those of every code and those of an octant are checked
//! for all of these formats. The slices of octants are checked for one format of each family and
//! width.

use unitpack::decode_table::{FormatTable, OctantTable};
use unitpack::*;
use unitpack_test::codes::{last_pattern, to_bytes};
use unitpack_test::tables::{AnyTable, Slices, octant_tables, whole_tables};
use unitpack_test::vectors::bits;
use unitpack_test::{AnyCodec, Arrays, Code, Vector, representatives};

/// Every pattern of a code, those with unused bits set too.
fn patterns(format: Format) -> Vec<Code> {
    (0..=last_pattern(format)).collect()
}

/// What a table must give, by `Codec::decode` alone.
fn expected(format: Format) -> Vec<Vector> {
    AnyCodec::of(format).decode_each(&patterns(format))
}

/// Compares what a table gives for every pattern with what it must give.
fn compare(format: Format, what: &str, got: impl IntoIterator<Item = Vector>, expected: &[Vector]) {
    let got: Vec<_> = got.into_iter().collect();
    assert_eq!(got.len(), expected.len());
    let wrong: Vec<_> = (0..got.len()).filter(|&i| bits(got[i]) != bits(expected[i])).collect();
    if let Some(&i) = wrong.first() {
        let (got, expected, count) = (got[i], expected[i], wrong.len());
        panic!("{format}, {what}: {count} wrong, first {i:#x} = {got:?}, not {expected:?}");
    }
}

/// Runs the slices over every pattern, and over a length that is no multiple of eight.
fn check_slices(format: Format, what: &str, slices: &dyn Slices, expected: &[Vector]) {
    let codes = patterns(format);
    let mut all = Vec::new();
    let (head, tail) = codes.split_at(13);
    for codes in [head, tail] {
        let mut v = Arrays::unwritten([codes.len(); 3]);
        slices.decode_soa(codes, v.write()).unwrap();
        all.extend(v.iter());
    }
    compare(format, &format!("{what}, SoA"), all, expected);
    // Lengths that differ change nothing.
    let mut v = Arrays::filled([3, 3, 2], 7.0);
    let error = slices.decode_soa(&codes[..3], v.write());
    assert_eq!(error, Err(LengthMismatch::Soa { x: 3, y: 3, z: 2, codes: 3 }));
    assert_eq!(v, Arrays::filled([3, 3, 2], 7.0));

    for floats in [3, 4, 8] {
        let mut v = vec![7.0f32; floats * codes.len()];
        slices.decode_aos(&codes, floats, &mut v).unwrap();
        let structures = v.chunks_exact(floats);
        let others = structures.clone().flat_map(|v| &v[3..]).all(|&c| c == 7.0);
        assert!(others, "{format}, {what}: a component behind the vector has changed");
        let vectors = structures.map(|v| [v[0], v[1], v[2]]);
        compare(format, &format!("{what}, AoS {floats}"), vectors, expected);
        let mut v = vec![7.0; 2 * floats];
        let error = slices.decode_aos(&codes[..3], floats, &mut v);
        assert_eq!(error, Err(LengthMismatch::Aos { vectors: 2, codes: 3 }));
        assert_eq!(v, vec![7.0; 2 * floats]);
    }
}

/// That a table of one element more or less is refused, and left as it was.
fn check_lengths(
    entries: usize,
    mut fill: impl FnMut(&mut [Vector]) -> Result<(), LengthMismatch>,
) {
    for len in [0, entries - 1, entries + 1] {
        let mut vectors = vec![[7.0; 3]; len];
        let error = LengthMismatch::Table { vectors: len, entries: Some(entries) };
        assert_eq!(fill(&mut vectors), Err(error));
        assert!(vectors.iter().all(|&v| v == [7.0; 3]));
    }
}

fn check(table: &AnyTable, what: &str) {
    let format = table.format;
    let mut vectors = vec![[f32::NAN; 3]; table.len];
    let filled = (table.fill)(&mut vectors).unwrap();
    let expected = expected(format);
    let singles = patterns(format).into_iter().map(|code| filled.decode(code));
    compare(format, &format!("{what}, single"), singles, &expected);
    if let Some(slices) = filled.slices() {
        check_slices(format, what, slices, &expected);
    }
    check_lengths(table.len, |v| (table.fill)(v).map(drop));
}

#[test]
fn tables_of_every_code_decode_the_same() {
    let tables = whole_tables();
    let formats = Format::ALL.iter().copied().filter(|f| f.bits() <= 16);
    assert!(tables.iter().map(|table| table.format).eq(formats));
    for table in &tables {
        assert_eq!(table.len, 1 << table.format.bits());
        check(table, "whole");
    }
}

#[test]
fn octants_decode_the_same() {
    let tables = octant_tables();
    assert!(tables.len() > 30);
    for table in &tables {
        let format = table.format;
        let mut vectors = vec![[f32::NAN; 3]; table.len];
        let has_slices = (table.fill)(&mut vectors).unwrap().slices().is_some();
        assert_eq!(has_slices, representatives::contains(format), "{format}");
        // No entry is spare, and all are of one octant, except for corners past the equator.
        let corners = ["stereo16", "eqarea16", "eqdist16"].contains(&format.name());
        let within = |&[x, y, z]: &Vector| x >= 0.0 && y >= 0.0 && (z >= 0.0 || corners && z < 0.0);
        assert!(vectors.iter().all(within), "{format}");
        check(table, "octant");
    }
}

#[test]
fn tables_chosen_at_run_time_decode_the_same() {
    for &format in Format::ALL.iter().filter(|f| f.bits() <= 16) {
        let entries = FormatTable::len_for(format).unwrap();
        assert_eq!(entries, 1 << format.bits());
        let mut vectors = vec![[f32::NAN; 3]; entries];
        let table = FormatTable::fill(format, &mut vectors).unwrap();
        assert_eq!(table.format(), format);
        let (codes, expected) = (patterns(format), expected(format));
        let singles = codes.iter().map(|&code| table.decode(code as u16));
        compare(format, "run time", singles, &expected);
        let size = format.code_size();
        let mut v = Arrays::unwritten([codes.len(); 3]);
        table.decode_bytes(&to_bytes(format, &codes), v.write()).unwrap();
        compare(format, "bytes", v.iter(), &expected);
        let mut v = Arrays::filled([3; 3], 7.0);
        let (bytes, code_size) = (3 * size - 1, size);
        let error = LengthMismatch::Bytes { x: 3, y: 3, z: 3, bytes, code_size };
        assert_eq!(table.decode_bytes(&vec![1; bytes], v.write()), Err(error));
        assert_eq!(v, Arrays::filled([3; 3], 7.0));
        check_lengths(entries, |v| FormatTable::fill(format, v).map(drop));
    }
}

#[test]
fn octants_have_the_documented_sizes() {
    let sizes = [
        (OctantTable::<Oct8>::LEN, 36),
        (OctantTable::<Oct12>::LEN, 528),
        (OctantTable::<Snorm5x3>::LEN, 4_096),
        (OctantTable::<Oct16>::LEN, 8_256),
        (OctantTable::<Octant16>::LEN, 8_128),
        (OctantTable::<EqDistConcentric16>::LEN, 8_192),
        (OctantTable::<AngularCube16>::LEN, 8_112),
        (OctantTable::<WarpedCube16>::LEN, 3_072),
        (OctantTable::<HemiOct16>::LEN, 16_384),
        (OctantTable::<XyOnly16>::LEN, 16_384),
    ];
    for (len, documented) in sizes {
        assert_eq!(len, documented);
    }
}

#[test]
fn formats_of_more_bits_have_no_table() {
    let more = Format::ALL.iter().copied().filter(|f| f.bits() > 16);
    let mut vectors = vec![[7.0; 3]; 1 << 18];
    let mut count = 0;
    for format in more {
        assert_eq!(FormatTable::len_for(format), None);
        for len in [0, 1 << 16, 1 << 18] {
            let error = FormatTable::fill(format, &mut vectors[..len]).map(drop).unwrap_err();
            assert_eq!(error, LengthMismatch::Table { vectors: len, entries: None });
            assert!(error.to_string().contains("more than 16 bits"));
        }
        count += 1;
    }
    assert!(count > 0);
    assert!(vectors.iter().all(|&v| v == [7.0; 3]));
}
