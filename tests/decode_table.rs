//! Decoding through a table gives the bits that `decode` gives: for every pattern of every format of
//! at most 16 bits, through every kind of table.

use std::collections::BTreeSet;
use std::fmt::Debug;

use unitpack::decode_table::{DecodeTable, FormatTable, OctantTable, SignSymmetric};
use unitpack::*;

/// Every pattern of a code, those with unused bits set too.
trait Pattern: Copy + Debug {
    fn all() -> Vec<Self>;
    fn wide(self) -> u16;
}

impl Pattern for u8 {
    fn all() -> Vec<u8> {
        (0..=u8::MAX).collect()
    }
    fn wide(self) -> u16 {
        self.into()
    }
}

impl Pattern for u16 {
    fn all() -> Vec<u16> {
        (0..=u16::MAX).collect()
    }
    fn wide(self) -> u16 {
        self
    }
}

type Bits = [u32; 3];

fn bits(v: [f32; 3]) -> Bits {
    v.map(f32::to_bits)
}

/// What a table must give, by `Codec::decode` alone.
fn expected<C: Codec<Code: Pattern>>() -> Vec<Bits> {
    C::Code::all().into_iter().map(|code| bits(C::decode(code))).collect()
}

/// Compares what a table gives for every pattern with what it must give.
fn compare<C: Codec<Code: Pattern>>(what: &str, got: impl IntoIterator<Item = Bits>) {
    let got: Vec<_> = got.into_iter().collect();
    let expected = expected::<C>();
    assert_eq!(got.len(), expected.len());
    let wrong: Vec<_> = (0..got.len()).filter(|&i| got[i] != expected[i]).collect();
    if let Some(&i) = wrong.first() {
        let [got, expected] = [got[i], expected[i]].map(|v| v.map(f32::from_bits));
        let (name, count) = (C::FORMAT.name(), wrong.len());
        panic!("{name}, {what}: {count} wrong, first {i:#x} = {got:?}, not {expected:?}");
    }
}

type DecodeSoa<'a, T> = &'a dyn Fn(&[T], SoaMut<'_>) -> Result<(), LengthMismatch>;

/// Runs a batch decoder over every pattern, and over a length that is no multiple of eight.
fn check_soa<C: Codec<Code: Pattern>>(what: &str, decode: DecodeSoa<'_, C::Code>) {
    let codes = C::Code::all();
    let mut v = [vec![0.0; codes.len()], vec![0.0; codes.len()], vec![0.0; codes.len()]];
    let (head, tail) = codes.split_at(13);
    let [x, y, z] = &mut v;
    for (codes, range) in [(head, 0..13), (tail, 13..codes.len())] {
        let (x, y, z) = (&mut x[range.clone()], &mut y[range.clone()], &mut z[range]);
        decode(codes, SoaMut { x, y, z }).unwrap();
    }
    compare::<C>(what, (0..codes.len()).map(|i| bits([v[0][i], v[1][i], v[2][i]])));
    // Lengths that differ change nothing.
    let [x, y, z] = [&mut [7.0; 3][..], &mut [7.0; 3], &mut [7.0; 2]];
    let error = decode(&codes[..3], SoaMut { x, y, z });
    assert_eq!(error, Err(LengthMismatch::Soa { x: 3, y: 3, z: 2, codes: 3 }));
    assert_eq!([x[0], y[0], z[0]], [7.0; 3]);
}

type DecodeAos<'a, T> = &'a dyn Fn(&[T], &mut [[f32; 4]]) -> Result<(), LengthMismatch>;

fn check_aos<C: Codec<Code: Pattern>>(what: &str, decode: DecodeAos<'_, C::Code>) {
    let codes = C::Code::all();
    let mut v = vec![[7.0f32; 4]; codes.len()];
    decode(&codes, &mut v).unwrap();
    assert!(v.iter().all(|v| v[3] == 7.0), "{what}: the fourth component has changed");
    compare::<C>(what, v.iter().map(|&[x, y, z, _]| bits([x, y, z])));
    let mut v = [[7.0; 4]; 2];
    let error = decode(&codes[..3], &mut v);
    assert_eq!(error, Err(LengthMismatch::Aos { vectors: 2, codes: 3 }));
    assert_eq!(v, [[7.0; 4]; 2]);
}

/// That a table of one element more or less is refused, and left as it was.
fn check_lengths(
    entries: usize,
    mut fill: impl FnMut(&mut [[f32; 3]]) -> Result<(), LengthMismatch>,
) {
    for len in [0, entries - 1, entries + 1] {
        let mut vectors = vec![[7.0; 3]; len];
        let error = LengthMismatch::Table { vectors: len, entries: Some(entries) };
        assert_eq!(fill(&mut vectors), Err(error));
        assert!(vectors.iter().all(|&v| v == [7.0; 3]));
    }
}

fn check_full<C: Codec<Code: Pattern>>() {
    let entries = DecodeTable::<C>::LEN;
    assert_eq!(entries, 1 << C::FORMAT.bits());
    let mut vectors = vec![[f32::NAN; 3]; entries];
    let table = DecodeTable::<C>::fill(&mut vectors).unwrap();
    compare::<C>("single", C::Code::all().into_iter().map(|c| bits(table.decode(c))));
    check_soa::<C>("SoA", &|codes, v| table.decode_soa(codes, v));
    check_aos::<C>("AoS", &|codes, v| table.decode_aos(codes, v));
    check_lengths(entries, |v| DecodeTable::<C>::fill(v).map(drop));
}

fn check_run_time<C: Codec<Code: Pattern>>() {
    let format = C::FORMAT;
    let entries = FormatTable::len_for(format).unwrap();
    assert_eq!(entries, 1 << format.bits());
    let mut vectors = vec![[f32::NAN; 3]; entries];
    let table = FormatTable::fill(format, &mut vectors).unwrap();
    assert_eq!(table.format(), format);
    compare::<C>(
        "run time",
        C::Code::all().into_iter().map(|code| bits(table.decode(code.wide()))),
    );
    let size = format.code_size();
    let bytes = |codes: &[C::Code]| -> Vec<u8> {
        codes.iter().flat_map(|c| c.wide().to_le_bytes().into_iter().take(size)).collect()
    };
    let codes = C::Code::all();
    let mut v = [vec![0.0; codes.len()], vec![0.0; codes.len()], vec![0.0; codes.len()]];
    let [x, y, z] = &mut v;
    table.decode_bytes(&bytes(&codes), SoaMut { x, y, z }).unwrap();
    compare::<C>("bytes", (0..codes.len()).map(|i| bits([v[0][i], v[1][i], v[2][i]])));
    let [x, y, z] = [&mut [7.0; 3][..], &mut [7.0; 3], &mut [7.0; 3]];
    let short = &bytes(&codes[..3])[1..];
    let error = LengthMismatch::Bytes { x: 3, y: 3, z: 3, bytes: 3 * size - 1, code_size: size };
    assert_eq!(table.decode_bytes(short, SoaMut { x, y, z }), Err(error));
    assert_eq!([x[0], y[0], z[0]], [7.0; 3]);
    check_lengths(entries, |v| FormatTable::fill(format, v).map(drop));
}

fn check_octant<C: SignSymmetric<Code: Pattern>>() {
    let entries = OctantTable::<C>::LEN;
    assert_eq!(entries, C::ENTRIES);
    let mut vectors = vec![[f32::NAN; 3]; entries];
    OctantTable::<C>::fill(&mut vectors).unwrap();
    // No entry is spare, and all are of one octant, but for corners past the equator.
    let corners = ["stereo16", "eqarea16", "eqdist16"].contains(&C::FORMAT.name());
    let within = |&[x, y, z]: &[f32; 3]| x >= 0.0 && y >= 0.0 && (z >= 0.0 || corners && z < 0.0);
    assert!(vectors.iter().all(within), "{}", C::FORMAT);
    let table = OctantTable::<C>::fill(&mut vectors).unwrap();
    compare::<C>("octant", C::Code::all().into_iter().map(|c| bits(table.decode(c))));
    check_soa::<C>("octant, SoA", &|codes, v| table.decode_soa(codes, v));
    check_aos::<C>("octant, AoS", &|codes, v| table.decode_aos(codes, v));
    check_lengths(entries, |v| OctantTable::<C>::fill(v).map(drop));
}

/// What to do for each of some codecs.
macro_rules! each {
    ($check:ident: $($codec:ident)*) => {
        [$(($codec::FORMAT, $check::<$codec> as fn())),*]
    };
}

/// Checks that exactly the formats that ought to be listed are.
fn run(checks: &[(Format, fn())], listed: impl Fn(Format) -> bool) {
    let names: BTreeSet<_> = checks.iter().map(|(format, _)| format.name()).collect();
    let all: BTreeSet<_> =
        Format::ALL.iter().copied().filter(|&f| listed(f)).map(Format::name).collect();
    assert_eq!(names, all);
    for (_, check) in checks {
        check();
    }
}

macro_rules! each_of_16_bits_at_most {
    ($check:ident) => {
        each!($check:
            Oct8 Oct10 Oct12 Oct14 Oct16 WarpedOct16 EqAreaOct16 SixOct16 Octant16 OctUnorm8x2 Snorm5x3 Spherical16 PhiZUnorm8x2
            HemiOct16 XyOnly16 LatLong16 LatLong16D Cube16 WarpedCube16
            Stereo16 StereoConcentric16 StereoEllipse16 EqArea16 EqAreaConcentric16
            EqAreaEllipse16 EqDist16 EqDistConcentric16 EqDistEllipse16
            AngularCube4 AngularCube5 AngularCube6 AngularCube7 AngularCube8 AngularCube9
            AngularCube10 AngularCube11 AngularCube12 AngularCube13 AngularCube14 AngularCube15
            AngularCube16 FrontOct16 QuadFrontOct16 Fibonacci16 Icosphere162)
    };
}

#[test]
fn tables_of_every_code_decode_the_same() {
    run(&each_of_16_bits_at_most!(check_full), |f| f.bits() <= 16);
}

#[test]
fn tables_chosen_at_run_time_decode_the_same() {
    run(&each_of_16_bits_at_most!(check_run_time), |f| f.bits() <= 16);
}

#[test]
fn octants_decode_the_same() {
    let checks = each!(check_octant:
        Oct8 Oct10 Oct12 Oct14 Oct16 WarpedOct16 EqAreaOct16 SixOct16 Octant16 Snorm5x3 HemiOct16 XyOnly16 Cube16 WarpedCube16
        Stereo16 StereoConcentric16 StereoEllipse16 EqArea16 EqAreaConcentric16 EqAreaEllipse16
        EqDist16 EqDistConcentric16 EqDistEllipse16
        AngularCube4 AngularCube5 AngularCube6 AngularCube7 AngularCube8 AngularCube9
        AngularCube10 AngularCube11 AngularCube12 AngularCube13 AngularCube14 AngularCube15
        AngularCube16);
    let without = [
        "oct-unorm8x2",
        "spherical16",
        "phi-z-unorm8x2",
        "latlong16",
        "latlong16D",
        "frontoct16",
        "quadfrontoct16",
        "fibonacci16",
        // Decoding is a table already.
        "icosphere162",
    ];
    run(&checks, |f| f.bits() <= 16 && !without.contains(&f.name()));
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
