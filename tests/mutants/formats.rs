//! Kills mutants of what is chosen at run time. Slow to build, since every codec is in it.

mod support;

use support::{Random, vectors};
use unitpack::decode_table::FormatTable;
use unitpack::*;

struct Direct<'a>(&'a [[f32; 3]]);

impl Visitor for Direct<'_> {
    type Output = [Vec<u8>; 2];

    fn visit<C: Codec>(self) -> [Vec<u8>; 2] {
        // Bytes at no good alignment are what is to be compared, so these are written one by one.
        let bytes = |code: C::Code| bytemuck::bytes_of(&code).to_vec();
        [C::encode, C::encode_precise]
            .map(|encode| self.0.iter().flat_map(|&v| bytes(encode(v))).collect())
    }
}

#[test]
fn bytes_are_the_codes() {
    // More than one detour over the stack.
    let vectors: Vec<[f32; 3]> = vectors().into_iter().take(261).collect();
    let [x, y, z] = [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect::<Vec<f32>>());
    let v = Soa { x: &x, y: &y, z: &z };
    // One for each type of code.
    for format in [
        Format::Oct8,
        Format::Oct16,
        Format::Oct24,
        Format::Oct32,
        Format::Float32x3,
        Format::AngularCube15,
    ] {
        let len = vectors.len() * format.code_size();
        let [fast, precise] = format.visit(Direct(&vectors));
        for offset in 0..4 {
            let mut words = vec![0u32; len / 4 + 2];
            let bytes = &mut bytemuck::cast_slice_mut(&mut words)[offset..][..len];
            format.encode(v, bytes).unwrap();
            assert_eq!(bytes, fast, "{format}");
            format.encode_precise(v, bytes).unwrap();
            assert_eq!(bytes, precise, "{format}");

            let [mut x, mut y, mut z] = [0; 3].map(|_| vec![9.0; vectors.len()]);
            format.decode(bytes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
            let [mut x1, mut y1, mut z1] = [0; 3].map(|_| vec![9.0; vectors.len()]);
            for (i, code) in bytes.chunks(format.code_size()).enumerate() {
                let [x, y, z] = [&mut x1, &mut y1, &mut z1].map(|c| &mut c[i..=i]);
                format.decode(code, SoaMut { x, y, z }).unwrap();
            }
            let bits =
                |v: [Vec<f32>; 3]| v.map(|c| c.iter().map(|c| c.to_bits()).collect::<Vec<_>>());
            assert_eq!(bits([x, y, z]), bits([x1, y1, z1]), "{format}");
        }

        // Too few or too many of any.
        let size = format.code_size();
        for [nx, ny, nz, bytes] in
            [[8, 9, 9, 9 * size], [9, 8, 9, 9 * size], [9, 9, 8, 9 * size], [9, 9, 9, 9 * size - 1]]
        {
            let error = LengthMismatch::Bytes { x: nx, y: ny, z: nz, bytes, code_size: size };
            let mut buffer = vec![0; bytes];
            let v = Soa { x: &x[..nx], y: &y[..ny], z: &z[..nz] };
            assert_eq!(format.encode(v, &mut buffer), Err(error));
            assert_eq!(format.encode_precise(v, &mut buffer), Err(error));
            let [mut x, mut y, mut z] = [nx, ny, nz].map(|n| vec![0.0; n]);
            let v = SoaMut { x: &mut x, y: &mut y, z: &mut z };
            assert_eq!(format.decode(&buffer, v), Err(error));
            assert_eq!(
                error.to_string(),
                format!(
                    "lengths do not fit: x {nx}, y {ny}, z {nz}, bytes {bytes} at {size} a code"
                )
            );
        }
    }
}

#[test]
fn tables_of_formats_are_exact() {
    for format in [Format::Oct8, Format::AngularCube5, Format::Oct10, Format::AngularCube13] {
        let len = FormatTable::len_for(format).unwrap();
        assert_eq!(len, 1 << format.bits());
        for vectors in [len - 1, len + 1] {
            let error = LengthMismatch::Table { vectors, entries: Some(len) };
            let outcome = FormatTable::fill(format, &mut vec![[0.0; 3]; vectors]).map(drop);
            assert_eq!(outcome, Err(error));
        }
        let mut entries = vec![[0.0; 3]; len];
        let table = FormatTable::fill(format, &mut entries).unwrap();
        assert_eq!(table.format(), format);
        let mut random = Random(9);
        let codes: Vec<u8> =
            (0..200 * format.code_size()).map(|_| (random.bits() >> 24) as u8).collect();
        let [mut x, mut y, mut z] = [0; 3].map(|_| [0.0; 200]);
        format.decode(&codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
        let [mut x1, mut y1, mut z1] = [0; 3].map(|_| [0.0; 200]);
        table.decode_bytes(&codes, SoaMut { x: &mut x1, y: &mut y1, z: &mut z1 }).unwrap();
        assert_eq!([x, y, z], [x1, y1, z1], "{format}");
        for (i, code) in codes.chunks(format.code_size()).enumerate() {
            let code = code.iter().rev().fold(0, |all, &byte| all << 8 | u16::from(byte));
            assert_eq!(table.decode(code), [x[i], y[i], z[i]], "{format}");
        }
        let v = SoaMut { x: &mut x1[1..], y: &mut y1, z: &mut z1 };
        assert!(table.decode_bytes(&codes, v).is_err());
    }
    assert_eq!(FormatTable::len_for(Format::Oct16), Some(65536));
    assert_eq!(FormatTable::len_for(Format::AngularCube17), None);
    let error = FormatTable::fill(Format::Oct32, &mut []).unwrap_err();
    assert_eq!(error, LengthMismatch::Table { vectors: 0, entries: None });
    assert_eq!(
        error.to_string(),
        "vectors 0, but formats of more than 16 bits have no decode table"
    );
}

#[test]
fn names_are_read_back() {
    for &format in Format::ALL {
        assert_eq!(format.name().to_ascii_uppercase().parse(), Ok(format));
        assert_eq!(Format::from_name(format.name()), Some(format));
        assert_eq!(format!("{format:>20}"), format!("{:>20}", format.name()));
    }
    assert_eq!(Format::from_name("oct17"), None);
    let error = "oct17".parse::<Format>().unwrap_err();
    assert_eq!(
        error.to_string(),
        "no format has this name; the names are those of Format::ALL, such as \"oct16\""
    );
}

/// Vectors of `N` components in more than one block of lanes, and a rest.
fn structures_are_rearranged<const N: usize>() {
    let vectors: Vec<[f32; N]> = vectors()
        .iter()
        .take(45)
        .map(|v| std::array::from_fn(|i| v.get(i).copied().unwrap_or(100.0 + i as f32)))
        .collect();
    let mut codes = vec![0; vectors.len()];
    Oct16::encode_aos(&vectors, &mut codes).unwrap();
    for (v, &code) in vectors.iter().zip(&codes) {
        assert_eq!(code, Oct16::encode([v[0], v[1], v[2]]), "{v:?}");
    }
    let mut decoded = vectors.clone();
    Oct16::decode_aos(&codes, &mut decoded).unwrap();
    for ((v, decoded), &code) in vectors.iter().zip(&decoded).zip(&codes) {
        assert_eq!(decoded[..3], Oct16::decode(code));
        assert_eq!(decoded[3..], v[3..]);
    }
}

#[test]
fn structures_of_any_size_are_rearranged() {
    structures_are_rearranged::<3>();
    structures_are_rearranged::<4>();
    structures_are_rearranged::<5>();
    structures_are_rearranged::<8>();
    structures_are_rearranged::<9>();
}

/// Radians, of vectors whose squares `f64` holds.
fn angle(v: [f32; 3], w: [f32; 3]) -> f64 {
    let [a, b] = [v, w].map(|v| v.map(f64::from));
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    });
    dot(cross, cross).sqrt().atan2(dot(a, b))
}

#[test]
fn reports_hold_the_errors() {
    let ordinary = |v: &[f32; 3]| v.iter().all(|c| c.is_finite()) && *v != [0.0; 3];
    let mut vectors: Vec<[f32; 3]> = vectors().into_iter().filter(ordinary).take(130).collect();
    vectors[100] = [0.0, 0.1, -3.0];
    let [x, y, z] = [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect::<Vec<f32>>());
    let codes: Vec<u16> = vectors.iter().map(|&v| HemiOct16::encode(v)).collect();
    let report = ErrorReport::of::<HemiOct16>(Soa { x: &x, y: &y, z: &z }, &codes).unwrap();
    let errors: Vec<f64> = (vectors.iter().zip(&codes))
        .map(|(&v, &code)| angle(v, HemiOct16::decode(code)).to_degrees())
        .collect();
    let n = errors.len() as f64;
    let max = errors.iter().copied().fold(0.0, f64::max);
    let squares: f64 = errors.iter().map(|e| e * e).sum();
    let exact = [errors.iter().sum::<f64>() / n, (squares / n).sqrt(), max, errors[report.worst]];
    let figures = [report.mean_degrees, report.rms_degrees, report.max_degrees, max];
    for (figure, exact) in figures.iter().zip(exact) {
        assert!((figure - exact).abs() <= 1e-6 * exact, "{report:?}: {exact}");
    }
    assert_eq!((report.count, max > 80.0), (vectors.len(), true));
    let none = Soa { x: &[], y: &[], z: &[] };
    assert_eq!(ErrorReport::of::<Oct8>(none, &[]), Ok(ErrorReport::default()));
    let none = Soa { x: &[], y: &[], z: &[] };
    assert!(ErrorReport::of::<Oct8>(none, &[1]).is_err());
    let same = ErrorReport::of::<Float32x3>(
        Soa { x: &[0.1], y: &[3.0], z: &[7.0] },
        &[Float32x3::encode([0.1, 3.0, 7.0])],
    );
    assert_eq!(same.unwrap().max_degrees, 0.0);
}

#[test]
fn the_cheapest_format_is_found() {
    use Format::*;
    let found = [0.0, 0.00124, 0.53, 0.5198, 0.5197, 11.47, 11.46, 11.0, 180.0, -1.0];
    let expected = [Float32x3, Snorm16x3, WarpedOct16, WarpedOct16];
    assert_eq!(found.map(Format::cheapest)[..4], expected.map(Some));
    assert_eq!(
        found.map(Format::cheapest)[4..],
        [
            Some(SignedOct23),
            Some(AngularCube8),
            Some(AngularCube8),
            Some(AngularCube8),
            Some(AngularCube4),
            None
        ]
    );
}
