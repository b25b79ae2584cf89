//! Kills mutants of the building blocks: scalars, packing, padded elements, low dimensions, decode
//! tables, and the loops over arrays of structures and from codec to codec.

#[path = "../it/padded.rs"]
mod padded;
mod support;

use std::fmt::Debug;

use bytemuck::{Pod, Zeroable, bytes_of, cast_slice};
use support::{Random, code, vectors};
use unitpack::decode_table::{DecodeTable, OctantTable};
use unitpack::dither::{Dither, StochasticRounding};
use unitpack::low_dimensions::{Angle, Sign};
use unitpack::packing::*;
use unitpack::scalar::{BiasedUnorm, Fixed, Scalar, Snorm, Unorm};
use unitpack::*;
use unitpack_test::digests::{Section, digest};

/// Compares digests with those of a section.
fn compare(title: &'static str, now: &[(&str, u64)]) {
    let mut section = Section::open(title, &["digest"]);
    for &(name, digest) in now {
        section.add(name, digest);
    }
    section.finish();
}

fn bytes<T: Pod>(slice: &[T]) -> impl Iterator<Item = u8> + '_ {
    slice.iter().flat_map(|t| bytes_of(t).to_vec())
}

/// A code of any bits.
fn any<C: CodeInt>(random: &mut Random) -> C {
    bytemuck::pod_read_unaligned(&random.bits().to_le_bytes()[..size_of::<C>()])
}

fn same<T: Pod + Debug>(a: &[T], b: &[T]) {
    assert_eq!(cast_slice::<T, u8>(a), cast_slice::<T, u8>(b), "{a:?}, not {b:?}");
}

/// Numbers from -1 to 1, ties on many grids and beside them, and what is out of range.
fn numbers() -> Vec<f32> {
    let mut random = Random(3);
    let mut numbers = vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        -0.5,
        1.5,
        -7.0,
        1e-45,
        -1e-30,
        f32::MAX,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        1.0f32.next_down(),
        -1.0f32.next_down(),
    ];
    for bits in 1..=24 {
        for max in [(1 << bits) as f32, ((1 << bits) - 1) as f32] {
            for _ in 0..3 {
                let tie = ((random.signed() * max).floor() + 0.5) / max;
                numbers.extend([tie, tie.next_up(), tie.next_down(), -tie]);
            }
        }
    }
    numbers.extend((0..203).map(|_| random.signed()));
    // So small that the numbers are not yet whole steps of the finest grids.
    numbers.extend((0..40).map(|_| random.signed() / 4096.0));
    numbers
}

fn scalar<S: Scalar, C: CodeInt>() -> u64 {
    let numbers = numbers();
    let mut codes = vec![C::zeroed(); numbers.len()];
    S::encode_slice(&numbers, &mut codes).unwrap();
    for (&x, &code) in numbers.iter().zip(&codes) {
        assert_eq!(S::encode(x), code.into(), "{x}");
    }
    let mut random = Random(4);
    let mut all = codes.clone();
    for _ in 0..200 {
        all.push(any(&mut random));
    }
    let mut back = vec![0.0; all.len()];
    S::decode_slice(&all, &mut back).unwrap();
    for (&x, &code) in back.iter().zip(&all) {
        assert_eq!(S::decode(code.into()).to_bits(), x.to_bits(), "{code:?}");
    }
    digest(bytes(&codes).chain(bytes(&back)))
}

#[test]
fn scalars_have_not_changed() {
    compare(
        "mutants: scalars",
        &[
            ("unorm2", scalar::<Unorm<2>, u8>()),
            ("unorm8", scalar::<Unorm<8>, u8>()),
            ("unorm12", scalar::<Unorm<12>, u16>()),
            ("unorm22", scalar::<Unorm<22>, u32>()),
            ("unorm23", scalar::<Unorm<23>, u32>()),
            ("unorm24", scalar::<Unorm<24>, u32>()),
            ("snorm2", scalar::<Snorm<2>, u8>()),
            ("snorm16", scalar::<Snorm<16>, u16>()),
            ("snorm23", scalar::<Snorm<23>, u32>()),
            ("snorm24", scalar::<Snorm<24>, u32>()),
            ("biased2", scalar::<BiasedUnorm<2>, u8>()),
            ("biased11", scalar::<BiasedUnorm<11>, u16>()),
            ("biased24", scalar::<BiasedUnorm<24>, u32>()),
            ("fixed2", scalar::<Fixed<2>, u8>()),
            ("fixed8", scalar::<Fixed<8>, u8>()),
            ("fixed24", scalar::<Fixed<24>, u32>()),
        ],
    );
}

fn angle<const BITS: u32, C: CodeInt>() -> u64 {
    let [x, y] = [0, 2].map(|i| vectors().iter().map(|v| v[i]).collect::<Vec<f32>>());
    let mut codes = vec![C::zeroed(); x.len()];
    Angle::<BITS>::encode_soa(&x, &y, &mut codes).unwrap();
    for ((&x, &y), &code) in x.iter().zip(&y).zip(&codes) {
        assert_eq!(Angle::<BITS>::encode([x, y]), code.into(), "{x} {y}");
    }
    let mut random = Random(5);
    codes.extend((0..101).map(|_| any::<C>(&mut random)));
    let [mut back_x, mut back_y] = [0; 2].map(|_| vec![0.0; codes.len()]);
    Angle::<BITS>::decode_soa(&codes, &mut back_x, &mut back_y).unwrap();
    for ((&x, &y), &code) in back_x.iter().zip(&back_y).zip(&codes) {
        same(&Angle::<BITS>::decode(code.into()), &[x, y]);
    }
    digest(bytes(&codes).chain(bytes(&back_x)).chain(bytes(&back_y)))
}

fn signs() -> u64 {
    let x = numbers();
    let mut packed = vec![0xAA; x.len().div_ceil(8)];
    Sign::encode_slice(&x, &mut packed).unwrap();
    let mut back = vec![0.0; x.len()];
    Sign::decode_slice(&packed, &mut back).unwrap();
    for (&x, &sign) in x.iter().zip(&back) {
        assert_eq!(sign, Sign::decode(Sign::encode(x)));
        assert_eq!(sign, if x < 0.0 { -1.0 } else { 1.0 });
        assert_eq!(Sign::decode(Sign::encode(x) | 0xFE), sign);
    }
    digest(packed)
}

#[test]
fn low_dimensions_have_not_changed() {
    compare(
        "mutants: low dimensions",
        &[
            ("angle1", angle::<1, u8>()),
            ("angle2", angle::<2, u8>()),
            ("angle3", angle::<3, u8>()),
            ("angle8", angle::<8, u8>()),
            ("angle16", angle::<16, u16>()),
            ("angle24", angle::<24, u32>()),
            ("signs", signs()),
        ],
    );
}

/// Longer than what goes over the stack at a time.
fn long() -> [Vec<f32>; 3] {
    let vectors: Vec<_> = vectors().into_iter().cycle().take(600).collect();
    [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect())
}

fn dither<C: Codec<Code = u16>>() -> u64 {
    let [x, y, z] = long();
    let (dither, first) = (Dither::new(5), u32::MAX - 99);
    let v = Soa { x: &x, y: &y, z: &z };
    let [mut fast, mut precise] = [0; 2].map(|_| vec![0; x.len()]);
    dither.encode_soa::<C>(first, v, &mut fast).unwrap();
    dither.encode_soa_precise::<C>(first, v, &mut precise).unwrap();
    let [mut a, mut b, mut c] = [0; 3].map(|_| vec![0.0; x.len()]);
    let to = SoaMut { x: &mut a, y: &mut b, z: &mut c };
    dither.decode_soa::<C>(first, &fast, to).unwrap();
    for i in 0..x.len() {
        let (index, v) = (first.wrapping_add(i as u32), [x[i], y[i], z[i]]);
        assert_eq!(dither.encode::<C>(index, v), fast[i], "{v:?}");
        assert_eq!(dither.encode_precise::<C>(index, v), precise[i], "{v:?}");
        same(&dither.decode::<C>(index, fast[i]), &[a[i], b[i], c[i]]);
    }
    digest(bytes(&fast).chain(bytes(&precise)).chain(bytes(&a)).chain(bytes(&b)).chain(bytes(&c)))
}

fn stochastic<C: StochasticRounding>() -> u64 {
    let [x, y, z] = long();
    let (dither, first) = (Dither::new(6), u32::MAX - 99);
    let mut codes = vec![C::Code::zeroed(); x.len()];
    dither.encode_soa_stochastic::<C>(first, Soa { x: &x, y: &y, z: &z }, &mut codes).unwrap();
    for (i, &code) in codes.iter().enumerate() {
        let v = [x[i], y[i], z[i]];
        assert_eq!(dither.encode_stochastic::<C>(first.wrapping_add(i as u32), v), code, "{v:?}");
    }
    digest(bytes(&codes))
}

#[test]
fn dither_has_not_changed() {
    compare(
        "mutants: dither",
        &[
            ("dither-oct16", dither::<Oct16>()),
            ("dither-angularcube15", dither::<AngularCube15>()),
            ("dither-HemiOct16", dither::<HemiOct16>()),
            ("stochastic-oct8", stochastic::<Oct8>()),
            ("stochastic-sixoct16", stochastic::<SixOct16>()),
            ("stochastic-oct24", stochastic::<Oct24>()),
        ],
    );
}

fn fibonacci(n: u32) -> u64 {
    let points = SphericalFibonacci::new(n).unwrap();
    let [x, y, z] = long();
    let mut indices = vec![0; x.len()];
    points.encode_soa(Soa { x: &x, y: &y, z: &z }, &mut indices).unwrap();
    let mut random = Random(8);
    indices.extend((0..101).map(|_| random.bits() % (n + 1)));
    let [mut a, mut b, mut c] = [0; 3].map(|_| vec![0.0; indices.len()]);
    points.decode_soa(&indices, SoaMut { x: &mut a, y: &mut b, z: &mut c }).unwrap();
    for (i, &index) in indices.iter().enumerate() {
        if i < x.len() {
            assert_eq!(points.encode([x[i], y[i], z[i]]), index);
        }
        same(&points.decode(index), &[a[i], b[i], c[i]]);
    }
    digest(bytes(&indices).chain(bytes(&a)).chain(bytes(&b)).chain(bytes(&c)))
}

#[test]
fn fibonacci_has_not_changed() {
    assert!([0, (1 << 24) + 1].iter().all(|&n| SphericalFibonacci::new(n).is_none()));
    assert_eq!([1, 1 << 24].map(|n| SphericalFibonacci::new(n).unwrap().points()), [1, 1 << 24]);
    compare(
        "mutants: fibonacci",
        &[
            ("fibonacci-1", fibonacci(1)),
            ("fibonacci-20", fibonacci(20)),
            ("fibonacci-1000", fibonacci(1000)),
            ("fibonacci-2^24", fibonacci(1 << 24)),
        ],
    );
}

fn dense<const BITS: u32, C: CodeInt>() -> u64 {
    let mut random = Random(6);
    let mut all = Vec::new();
    for len in [0, 1, 7, 8, 9, 16, 37] {
        let codes: Vec<C> = (0..len).map(|_| any(&mut random)).collect();
        let mut packed = vec![0xAA; dense_len(BITS, len)];
        pack_dense::<BITS, C>(&codes, &mut packed).unwrap();
        // Bit by bit.
        for (i, &code) in codes.iter().enumerate() {
            for bit in 0..BITS as usize {
                let at = i * BITS as usize + bit;
                let code: u32 = code.into();
                assert_eq!(packed[at / 8] >> (at % 8) & 1, (code >> bit & 1) as u8);
            }
        }
        let mut back = vec![C::zeroed(); len];
        unpack_dense::<BITS, C>(&packed, &mut back).unwrap();
        for (&back, &code) in back.iter().zip(&codes) {
            let (back, code): (u32, u32) = (back.into(), code.into());
            assert_eq!(back, code & (u32::MAX >> (32 - BITS)));
        }
        all.extend(packed);
    }
    digest(all)
}

fn pairs() -> u64 {
    let numbers = numbers();
    let pairs: Vec<[f32; 2]> = numbers.windows(2).map(|w| [w[0], w[1]]).collect();
    let mut texels = vec![[0; 3]; pairs.len()];
    pack_snorm12x2_slice(&pairs, &mut texels).unwrap();
    for (&pair, texel) in pairs.iter().zip(&texels) {
        assert_eq!(pack_snorm12x2(pair), *texel, "{pair:?}");
    }
    let mut random = Random(7);
    texels.extend((0..100).map(|_| [0; 3].map(|_| random.bits() as u8)));
    texels.push([0xFF; 3]);
    let mut back = vec![[0.0; 2]; texels.len()];
    unpack_snorm12x2_slice(&texels, &mut back).unwrap();
    for (&texel, pair) in texels.iter().zip(&back) {
        same(&unpack_snorm12x2(texel), pair);
    }
    digest(bytes(&texels).chain(bytes(&back)))
}

fn fields() -> u64 {
    let mut random = Random(8);
    let mut fields: Vec<[u16; 3]> =
        (0..41).map(|_| [0; 3].map(|_| (random.bits() >> 16) as u16)).collect();
    let mut tags: Vec<u8> = (0..41).map(|_| (random.bits() >> 24) as u8).collect();
    let mut codes: Vec<u32> = (0..41).map(|_| random.bits()).collect();
    let [mut tagged, mut tens, mut elevens] = [0; 3].map(|_| vec![0; 41]);
    pack_tag_slice(&codes, &tags, &mut tagged).unwrap();
    pack_10_10_10_2_slice(&fields, &tags, &mut tens).unwrap();
    pack_11_11_10_slice(&fields, &mut elevens).unwrap();
    for i in 0..41 {
        assert_eq!(tagged[i], pack_tag(codes[i], tags[i]));
        assert_eq!(tens[i], pack_10_10_10_2(fields[i], tags[i]));
        assert_eq!(elevens[i], pack_11_11_10(fields[i]));
    }
    let words: Vec<u8> = bytes(&tagged).chain(bytes(&tens)).chain(bytes(&elevens)).collect();
    let mut all = words;
    unpack_tag_slice(&tagged, &mut codes, &mut tags).unwrap();
    all.extend(bytes(&codes).chain(bytes(&tags)));
    unpack_10_10_10_2_slice(&tens, &mut fields, &mut tags).unwrap();
    all.extend(bytes(&fields).chain(bytes(&tags)));
    for i in 0..41 {
        assert_eq!(unpack_tag(tagged[i]), (codes[i], tags[i]));
        assert_eq!(unpack_10_10_10_2(tens[i]), (fields[i], tags[i]));
    }
    unpack_11_11_10_slice(&elevens, &mut fields).unwrap();
    all.extend(bytes(&fields));
    for i in 0..41 {
        assert_eq!(unpack_11_11_10(elevens[i]), fields[i]);
    }
    digest(all)
}

#[test]
fn packing_has_not_changed() {
    compare(
        "mutants: packing",
        &[
            ("dense1", dense::<1, u8>()),
            ("dense7", dense::<7, u8>()),
            ("dense8", dense::<8, u8>()),
            ("dense12", dense::<12, u16>()),
            ("dense31", dense::<31, u32>()),
            ("dense32", dense::<32, u32>()),
            ("pairs", pairs()),
            ("fields", fields()),
        ],
    );
    assert_eq!([dense_len(12, 0), dense_len(12, 3), dense_len(32, 9)], [0, 5, 36]);
    assert_eq!(dense_len(1, 9), 2);
    assert_eq!(dense_len(32, usize::MAX), usize::MAX);
    assert_eq!(dense_len(8, usize::MAX), usize::MAX);
    assert_eq!(dense_len(7, usize::MAX), usize::MAX / 8 * 7 + 7);
}

// ---- Arrays of structures, and codec to codec ----

/// As structure of arrays and as array of structures: the same.
fn layouts<C: Codec, const N: usize>() {
    let vectors: Vec<[f32; 3]> = vectors().into_iter().take(131).collect();
    let [x, y, z] = [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect::<Vec<f32>>());
    let soa = Soa { x: &x, y: &y, z: &z };
    let wide = |v: &[f32; 3]| -> [f32; N] {
        let mut wide = [7.0; N];
        wide[..3].copy_from_slice(v);
        wide
    };
    let aos: Vec<[f32; N]> = vectors.iter().map(wide).collect();
    let [mut fast, mut precise, mut fast_aos, mut precise_aos] =
        [0; 4].map(|_| vec![code::<C>(0); vectors.len()]);
    C::encode_soa(soa, &mut fast).unwrap();
    C::encode_soa_precise(soa, &mut precise).unwrap();
    C::encode_aos(&aos, &mut fast_aos).unwrap();
    C::encode_aos_precise(&aos, &mut precise_aos).unwrap();
    same(&fast_aos, &fast);
    same(&precise_aos, &precise);
    assert_ne!(fast, precise);

    let mut decoded = vec![[3.0; N]; fast.len()];
    C::decode_aos(&fast, &mut decoded).unwrap();
    for (&code, v) in fast.iter().zip(&decoded) {
        same(&wide(&C::decode(code)).map(|c| if c == 7.0 { 3.0 } else { c }), v);
    }

    let mut across = vec![0; fast.len()];
    transcode::<C, Oct32>(&fast, &mut across).unwrap();
    for (&code, &other) in fast.iter().zip(&across) {
        assert_eq!(other, Oct32::encode(C::decode(code)));
    }
}

#[test]
fn layouts_agree() {
    layouts::<Oct8, 3>();
    layouts::<Oct16, 4>();
    layouts::<Oct24, 5>();
    layouts::<Oct32, 8>();
}

// ---- Decode tables ----

fn table<C: Codec>() {
    let mut vectors = vec![[0.0; 3]; DecodeTable::<C>::LEN];
    let table = DecodeTable::<C>::fill(&mut vectors).unwrap();
    let codes: Vec<C::Code> =
        (0..1 << (8 * size_of::<C::Code>())).step_by(5).map(code::<C>).collect();
    let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0f32; codes.len()]);
    table.decode_soa(&codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
    let mut aos = vec![[9.0; 4]; codes.len()];
    table.decode_aos(&codes, &mut aos).unwrap();
    for (i, &code) in codes.iter().enumerate() {
        let v = C::decode(code);
        same(&table.decode(code), &v);
        same(&[x[i], y[i], z[i]], &v);
        same(&aos[i], &[v[0], v[1], v[2], 9.0]);
    }
}

#[test]
fn tables_are_exact() {
    table::<Oct8>();
    table::<AngularCube5>();
    table::<Oct10>();
    table::<Oct16>();

    let mut vectors = [[0.0; 3]; OctantTable::<Oct8>::LEN];
    assert_eq!(vectors.len(), 36);
    let octant = OctantTable::<Oct8>::fill(&mut vectors).unwrap();
    let codes: Vec<u8> = (0..=255).collect();
    let mut aos = [[9.0; 4]; 256];
    octant.decode_aos(&codes, &mut aos).unwrap();
    for (&code, v) in codes.iter().zip(&aos) {
        let [x, y, z] = Oct8::decode(code);
        same(v, &[x, y, z, 9.0]);
        same(&octant.decode(code), &[x, y, z]);
    }
}

// ---- Lengths that differ ----

/// An error that is `expected`, in these words.
fn refused(outcome: Result<(), LengthMismatch>, expected: LengthMismatch, words: &str) {
    assert_eq!(outcome, Err(expected));
    assert_eq!(expected.to_string(), words);
}

#[test]
fn vectors_and_codes_that_differ_are_refused() {
    let c = [0.5; 9];
    for [x, y, z, codes] in [[8, 9, 9, 9], [9, 8, 9, 9], [9, 9, 8, 9], [9, 9, 9, 8]] {
        let error = LengthMismatch::Soa { x, y, z, codes };
        let words = format!("lengths differ: x {x}, y {y}, z {z}, codes {codes}");
        let v = Soa { x: &c[..x], y: &c[..y], z: &c[..z] };
        refused(Oct16::encode_soa(v, &mut [0; 9][..codes]), error, &words);
        refused(Oct16::encode_soa_precise(v, &mut [0; 9][..codes]), error, &words);
        let [mut to_x, mut to_y, mut to_z] = [c; 3];
        let v = SoaMut { x: &mut to_x[..x], y: &mut to_y[..y], z: &mut to_z[..z] };
        refused(Oct16::decode_soa(&[0; 9][..codes], v), error, &words);

        let mut vectors = vec![[0.0; 3]; 256];
        let table = DecodeTable::<Oct8>::fill(&mut vectors).unwrap();
        let v = SoaMut { x: &mut to_x[..x], y: &mut to_y[..y], z: &mut to_z[..z] };
        refused(table.decode_soa(&[0; 9][..codes], v), error, &words);
        let mut vectors = [[0.0; 3]; 36];
        let table = OctantTable::<Oct8>::fill(&mut vectors).unwrap();
        let v = SoaMut { x: &mut to_x[..x], y: &mut to_y[..y], z: &mut to_z[..z] };
        refused(table.decode_soa(&[0; 9][..codes], v), error, &words);
    }
    for [vectors, codes] in [[8, 9], [9, 8]] {
        let error = LengthMismatch::Aos { vectors, codes };
        let words = format!("lengths differ: vectors {vectors}, codes {codes}");
        let mut v = [[0.0; 3]; 9];
        refused(Oct16::encode_aos(&v[..vectors], &mut [0; 9][..codes]), error, &words);
        refused(Oct16::encode_aos_precise(&v[..vectors], &mut [0; 9][..codes]), error, &words);
        refused(Oct16::decode_aos(&[0; 9][..codes], &mut v[..vectors]), error, &words);
        let mut entries = vec![[0.0; 3]; 256];
        let table = DecodeTable::<Oct8>::fill(&mut entries).unwrap();
        refused(table.decode_aos(&[0; 9][..codes], &mut v[..vectors]), error, &words);

        let (src, dst) = (vectors, codes);
        let error = LengthMismatch::Transcode { src, dst };
        let words = format!("lengths differ: source {src}, destination {dst}");
        refused(transcode::<Oct16, Oct24>(&[0; 9][..src], &mut [[0; 3]; 9][..dst]), error, &words);
    }
    for vectors in [255, 257] {
        let error = LengthMismatch::Table { vectors, entries: Some(256) };
        let words = format!("lengths differ: vectors {vectors}, entries of the table 256");
        refused(
            DecodeTable::<Oct8>::fill(&mut [[0.0; 3]; 257][..vectors]).map(drop),
            error,
            &words,
        );
    }
    for vectors in [35, 37] {
        let error = LengthMismatch::Table { vectors, entries: Some(36) };
        let words = format!("lengths differ: vectors {vectors}, entries of the table 36");
        refused(OctantTable::<Oct8>::fill(&mut [[0.0; 3]; 37][..vectors]).map(drop), error, &words);
    }
}

#[test]
fn blocks_that_differ_are_refused() {
    for [values, codes] in [[8, 9], [9, 8]] {
        let error = LengthMismatch::Values { values, codes };
        let words = format!("lengths differ: values {values}, codes {codes}");
        let (mut x, mut c) = ([0.0; 9], [0u16; 9]);
        let (mut pairs, mut texels) = ([[0.0; 2]; 9], [[0; 3]; 9]);
        let (mut fields, mut w) = ([[0; 3]; 9], [0; 9]);
        refused(Unorm::<9>::encode_slice(&x[..values], &mut c[..codes]), error, &words);
        refused(Snorm::<9>::decode_slice(&c[..codes], &mut x[..values]), error, &words);
        refused(pack_snorm12x2_slice(&pairs[..values], &mut texels[..codes]), error, &words);
        refused(unpack_snorm12x2_slice(&texels[..codes], &mut pairs[..values]), error, &words);
        refused(pack_11_11_10_slice(&fields[..values], &mut w[..codes]), error, &words);
        refused(unpack_11_11_10_slice(&w[..codes], &mut fields[..values]), error, &words);
    }
    for [codes, tags, words] in [[8, 9, 9], [9, 8, 9], [9, 9, 8]] {
        let error = LengthMismatch::Tagged { codes, tags, words };
        let said = format!("lengths differ: codes {codes}, tags {tags}, words {words}");
        let (mut c, mut f, mut t, mut w) = ([0; 9], [[0; 3]; 9], [0; 9], [0; 9]);
        refused(pack_tag_slice(&c[..codes], &t[..tags], &mut w[..words]), error, &said);
        refused(unpack_tag_slice(&w[..words], &mut c[..codes], &mut t[..tags]), error, &said);
        refused(pack_10_10_10_2_slice(&f[..codes], &t[..tags], &mut w[..words]), error, &said);
        let outcome = unpack_10_10_10_2_slice(&w[..words], &mut f[..codes], &mut t[..tags]);
        refused(outcome, error, &said);
    }
    for (codes, bytes) in [(9, 13), (9, 15), (8, 11), (8, 13), (16, 1), (0, 1)] {
        let error = LengthMismatch::Dense { codes, bytes, bits: 12 };
        let words = format!("lengths do not fit: codes {codes}, bytes {bytes} at 12 bits a code");
        let (mut c, mut b) = ([0u16; 16], [0; 15]);
        refused(pack_dense::<12, _>(&c[..codes], &mut b[..bytes]), error, &words);
        refused(unpack_dense::<12, _>(&b[..bytes], &mut c[..codes]), error, &words);
    }
    for (values, bytes) in [(9, 1), (9, 3), (8, 2), (0, 1)] {
        let error = LengthMismatch::Dense { codes: values, bytes, bits: 1 };
        let words = format!("lengths do not fit: codes {values}, bytes {bytes} at 1 bits a code");
        let (mut x, mut b) = ([0.0; 9], [0; 3]);
        refused(Sign::encode_slice(&x[..values], &mut b[..bytes]), error, &words);
        refused(Sign::decode_slice(&b[..bytes], &mut x[..values]), error, &words);
    }
    for [x, y, codes] in [[8, 9, 9], [9, 8, 9], [9, 9, 8]] {
        let error = LengthMismatch::Angles { x, y, codes };
        let words = format!("lengths differ: x {x}, y {y}, codes {codes}");
        let (mut a, mut b, mut c) = ([0.0; 9], [0.0; 9], [0u8; 9]);
        refused(Angle::<8>::encode_soa(&a[..x], &b[..y], &mut c[..codes]), error, &words);
        refused(Angle::<8>::decode_soa(&c[..codes], &mut a[..x], &mut b[..y]), error, &words);
    }
}
