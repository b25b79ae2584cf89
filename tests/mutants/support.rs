//! What the programs for mutation testing share: digests of what codecs make of a few hundred
//! vectors and codes, each chosen to go where random ones do not.

#![allow(dead_code)] // Every program uses a part of this.

use bytemuck::{Zeroable, bytes_of, bytes_of_mut, cast_slice, cast_slice_mut, pod_read_unaligned};
use unitpack::decode_table::{OctantTable, SignSymmetric};
use unitpack::{Axis, Codec, Soa, SoaMut};
use unitpack_test::digests::{Section, digest};

type Vector = [f32; 3];

/// A codec behind pointers, so that all that is compiled for each codec is its own code.
#[derive(Clone, Copy)]
pub struct Functions {
    size: usize,
    encode: [fn(Soa<'_>, &mut [u8]); 2],
    encode_one: [fn(Vector, &mut [u8]); 2],
    decode: fn(&[u8], SoaMut<'_>),
    decode_one: fn(&[u8]) -> Vector,
    canonical: fn(&mut [u8]) -> bool,
    same_direction: fn(&[u8], &[u8]) -> bool,
    /// Canonical, negated, and mirrored in each axis.
    in_place: [fn(&mut [u8]); 5],
    in_place_one: [fn(&mut [u8]); 5],
}

/// Makes something of a code in its bytes.
fn change<C: Codec>(code: &mut [u8], operation: impl Fn(C::Code) -> C::Code) {
    code.copy_from_slice(bytes_of(&operation(pod_read_unaligned(code))));
}

impl Functions {
    pub fn of<C: Codec>() -> Self {
        Functions {
            size: size_of::<C::Code>(),
            encode: [
                |v, codes| C::encode_soa(v, cast_slice_mut(codes)).unwrap(),
                |v, codes| C::encode_soa_precise(v, cast_slice_mut(codes)).unwrap(),
            ],
            encode_one: [
                |v, code| code.copy_from_slice(bytes_of(&C::encode(v))),
                |v, code| code.copy_from_slice(bytes_of(&C::encode_precise(v))),
            ],
            decode: |codes, v| C::decode_soa(cast_slice(codes), v).unwrap(),
            decode_one: |code| C::decode(pod_read_unaligned(code)),
            canonical: |code| {
                let given: C::Code = pod_read_unaligned(code);
                code.copy_from_slice(bytes_of(&C::canonical(given)));
                C::is_canonical(given)
            },
            same_direction: |a, b| C::same_direction(pod_read_unaligned(a), pod_read_unaligned(b)),
            in_place: [
                |codes| C::canonical_slice(cast_slice_mut(codes)),
                |codes| C::negate_slice(cast_slice_mut(codes)),
                |codes| C::mirror_slice(cast_slice_mut(codes), Axis::X),
                |codes| C::mirror_slice(cast_slice_mut(codes), Axis::Y),
                |codes| C::mirror_slice(cast_slice_mut(codes), Axis::Z),
            ],
            in_place_one: [
                |code| change::<C>(code, C::canonical),
                |code| change::<C>(code, C::negate),
                |code| change::<C>(code, |code| C::mirror(code, Axis::X)),
                |code| change::<C>(code, |code| C::mirror(code, Axis::Y)),
                |code| change::<C>(code, |code| C::mirror(code, Axis::Z)),
            ],
        }
    }

    /// Encodes in lanes and, every eighth, alone: both must agree.
    fn encode(&self, effort: usize, vectors: &[Vector]) -> Vec<u8> {
        let [x, y, z] = columns(vectors);
        let mut codes = aligned(vectors.len() * self.size);
        let codes = &mut cast_slice_mut(&mut codes)[..vectors.len() * self.size];
        self.encode[effort](Soa { x: &x, y: &y, z: &z }, codes);
        for (&v, code) in vectors.iter().zip(codes.chunks(self.size)).step_by(8) {
            let mut one = [0; 12];
            let one = &mut one[..self.size];
            self.encode_one[effort](v, one);
            assert_eq!(one, code, "{v:?}");
        }
        codes.to_vec()
    }

    /// Decodes in lanes and, every eighth, alone: both must agree.
    fn decode(&self, bytes: &[u8]) -> Vec<Vector> {
        let count = bytes.len() / self.size;
        let mut codes = aligned(bytes.len());
        let codes: &mut [u8] = &mut cast_slice_mut(&mut codes)[..count * self.size];
        codes.copy_from_slice(&bytes[..count * self.size]);
        let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0f32; count]);
        (self.decode)(codes, SoaMut { x: &mut x, y: &mut y, z: &mut z });
        let vectors: Vec<Vector> = (0..count).map(|i| [x[i], y[i], z[i]]).collect();
        for (v, code) in vectors.iter().zip(codes.chunks(self.size)).step_by(8) {
            assert_eq!(v.map(f32::to_bits), (self.decode_one)(code).map(f32::to_bits), "{code:x?}");
        }
        vectors
    }

    /// The canonical codes.
    fn canonical(&self, bytes: &[u8]) -> Vec<u8> {
        let mut all = Vec::new();
        for code in bytes.chunks_exact(self.size) {
            let mut canonical = code.to_vec();
            let is_canonical = (self.canonical)(&mut canonical);
            assert_eq!(is_canonical, canonical == code, "{code:x?}");
            all.extend(canonical);
        }
        let pairs = bytes.chunks_exact(self.size).zip(bytes.chunks_exact(self.size).skip(1));
        let canonical = all.chunks(self.size).zip(all.chunks(self.size).skip(1));
        for ((a, b), (canonical_a, canonical_b)) in pairs.zip(canonical) {
            let same = canonical_a == canonical_b;
            assert_eq!((self.same_direction)(a, b), same, "{a:x?} and {b:x?}");
            assert!((self.same_direction)(a, canonical_a), "{a:x?}");
        }
        assert_eq!(self.in_place(0, bytes), all);
        all
    }

    /// One of the operations on codes, in lanes and, every fourth, alone: both must agree.
    fn in_place(&self, operation: usize, bytes: &[u8]) -> Vec<u8> {
        let len = bytes.len() / self.size * self.size;
        let mut codes = aligned(len);
        let codes: &mut [u8] = &mut cast_slice_mut(&mut codes)[..len];
        codes.copy_from_slice(&bytes[..len]);
        (self.in_place[operation])(codes);
        for (given, code) in bytes.chunks(self.size).zip(codes.chunks(self.size)).step_by(4) {
            let mut one = given.to_vec();
            (self.in_place_one[operation])(&mut one);
            assert_eq!(one, code, "{given:x?}");
        }
        codes.to_vec()
    }

    /// Gives `check` the digests of the [`OPERATIONS`], in their order. What is slow, `encode_precise`
    /// above all, takes one of so many inputs. `check` gets each at once, since most mutants fail at
    /// the first.
    fn digests(&self, every: usize, mut check: impl FnMut(u64)) {
        let decoded = self.decode(&codes());
        check(digest(decoded.iter().flatten().flat_map(|c| c.to_bits().to_le_bytes())));
        let codes: Vec<u8> = codes().chunks(12 * every).flat_map(|c| c[..12].to_vec()).collect();
        check(digest(self.canonical(&codes)));
        check(digest([1, 2, 3, 4].into_iter().flat_map(|i| self.in_place(i, &codes))));
        // Beside the fixed vectors, points of the format, and what lies between two of them.
        let mut vectors = vectors();
        let points = decoded.iter().filter(|v| v.iter().all(|c| c.is_finite()));
        let points: Vec<Vector> = points.copied().collect();
        for pair in points.chunks_exact(2).step_by(8) {
            vectors.push(pair[0]);
            vectors.push([0, 1, 2].map(|i| pair[0][i] + pair[1][i]));
        }
        check(digest(self.encode(0, &vectors)));
        let few: Vec<Vector> = vectors.iter().copied().step_by(every).collect();
        check(digest(self.encode(1, &few)));
    }
}

/// Memory for so many bytes of codes, at an address that suits every type of code.
fn aligned(bytes: usize) -> Vec<u32> {
    vec![0; bytes.div_ceil(4)]
}

fn columns(vectors: &[Vector]) -> [Vec<f32>; 3] {
    [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect())
}

/// A linear congruential generator.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 32) as u32
    }

    /// In [-1, 1).
    pub fn signed(&mut self) -> f32 {
        (self.bits() >> 8) as f32 / 8_388_608.0 - 1.0
    }

    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.bits() as usize % from.len()]
    }
}

/// Components so simple that they fall on edges, corners and diagonals.
pub const SIMPLE: [f32; 8] = [0.0, -0.0, 1.0, -1.0, 1.0, -1.0, 0.5, -2.0];

/// Components of what is no direction, or hardly one.
pub const ODD: [f32; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-45,
    -1e-39,
    1e-33,
    1e-20,
    -3e-13,
    1e13,
    -1e30,
    f32::MAX,
    f32::INFINITY,
    f32::NEG_INFINITY,
];

/// Vectors of every kind, in an order that brings different kinds into one block of lanes.
pub fn vectors() -> Vec<Vector> {
    let mut random = Random(1);
    let mut vectors = Vec::new();
    // The axes, and ratios so simple that they fall on edges, corners and diagonals.
    for axis in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
        vectors.extend([axis, axis.map(|c| -c)]);
    }
    for _ in 0..96 {
        vectors.push([0; 3].map(|_| random.pick(&SIMPLE)));
    }
    // What is no direction, or hardly one.
    for i in 0..96 {
        let v = [0; 3].map(|_| random.pick(&ODD));
        vectors.push(if i % 16 == 0 { [v[0], f32::NAN, v[2]] } else { v });
    }
    vectors.extend([[0.0; 3], [-0.0, 0.0, -0.0], [f32::NAN; 3]]);
    // Near ties of one component or two.
    const STEPS: [f32; 14] = [
        1.0, 3.0, 7.0, 15.0, 31.0, 127.0, 255.0, 511.0, 1024.0, 2047.0, 2048.0, 4096.0, 8192.0,
        32767.0,
    ];
    for i in 0..160 {
        let steps = random.pick(&STEPS);
        let mut tie = || ((random.signed() * steps).floor() + 0.5) / steps;
        let (a, b) = (tie(), tie());
        vectors.push(match i % 4 {
            0 => [a, b, 1.0 - a.abs() - b.abs()],
            1 => [a, b, (1.0 - a * a - b * b).max(0.0).sqrt()],
            2 => [b, -1.0, a],
            _ => [1.0, a, b],
        });
    }
    // Near a pole, the equator and the planes between.
    for _ in 0..96 {
        let mut v = [0; 3].map(|_| random.signed());
        let i = random.bits() as usize % 3;
        v[i] *= random.pick(&[1e-3, 1e-5, 1e-7, 100.0, 1e4]);
        if random.bits() >> 31 == 1 {
            v[(i + 1) % 3] = random.pick(&[1.0, -1.0]) * v[(i + 2) % 3];
        }
        vectors.push(v);
    }
    // Where the charts of two hemispheres meet, and near the diagonals there.
    for i in 0..256 {
        let near = random.pick(&[0.1, 0.03, 1e-2, 1e-3, 1e-4, 1e-6]);
        let mut v = [0; 2].map(|_| random.pick(&[1.0, -1.0]) * (1.0 + near * random.signed()));
        if i % 4 == 0 {
            v[0] *= random.signed();
        }
        vectors.push([v[0], v[1], near * random.signed()]);
    }
    vectors.extend((0..128).map(|_| [0; 3].map(|_| random.signed())));
    // Not a whole number of blocks.
    if vectors.len() % 8 == 0 {
        vectors.push([0.3, -0.5, 0.7]);
    }
    for i in (1..vectors.len()).rev() {
        vectors.swap(i, random.bits() as usize % (i + 1));
    }
    vectors
}

/// Bytes of codes: the same byte throughout, then any, and near bytes at which fields turn over.
fn codes() -> Vec<u8> {
    let mut random = Random(2);
    let mut codes = Vec::new();
    for byte in [0x00, 0xFF, 0x80, 0x7F, 0x01, 0x55, 0xAA, 0xC3] {
        codes.extend([byte; 24]);
    }
    codes.extend((0..2304).map(|_| (random.bits() >> 24) as u8));
    const TURNS: [u8; 10] = [0x00, 0x01, 0x3C, 0x7C, 0x7F, 0x80, 0x81, 0xBC, 0xFE, 0xFF];
    codes.extend((0..768).map(|_| random.pick(&TURNS)));
    codes
}

/// What is digested of a codec: the columns of its section.
const OPERATIONS: [&str; 5] = ["decode", "canonical", "mirror", "encode", "encode_precise"];

/// Compares with the pinned digests.
pub fn compare(title: &'static str, codecs: &[(&str, Functions, usize)]) {
    let mut section = Section::open(title, &OPERATIONS);
    for &(name, functions, every) in codecs {
        functions.digests(every, |digest| section.expect(name, digest));
    }
    section.finish();
}

/// A test of the digests of some codecs, which are a section of their own. The precise encoder takes
/// one vector of so many.
#[macro_export]
macro_rules! digests {
    ($title:literal: $($codec:ident $(/ $every:literal)?,)*) => {
        #[test]
        fn digests_have_not_changed() {
            support::compare($title, &[$((
                <unitpack::$codec as unitpack::Codec>::FORMAT.name(),
                support::Functions::of::<unitpack::$codec>(),
                1 $(* $every)?,
            ),)*]);
        }
    };
}

/// Every code, read through a table of an octant, is what the decoder gives, and every entry is of a
/// code.
pub fn octant_table_is_exact<C: SignSymmetric>() {
    let mut vectors = vec![[f32::NAN; 3]; C::ENTRIES];
    OctantTable::<C>::fill(&mut vectors).unwrap();
    assert!(vectors.iter().flatten().all(|c| c.is_finite()), "an entry is spare");
    let table = OctantTable::<C>::fill(&mut vectors).unwrap();
    let codes: Vec<C::Code> = (0..1 << C::FORMAT.bits()).step_by(7).map(code::<C>).collect();
    let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0f32; codes.len()]);
    table.decode_soa(&codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
    for (i, &code) in codes.iter().enumerate() {
        let v = C::decode(code).map(f32::to_bits);
        assert_eq!([x[i], y[i], z[i]].map(f32::to_bits), v, "{code:x?}");
        assert_eq!(table.decode(code).map(f32::to_bits), v, "{code:x?}");
    }
}

/// The code whose integer is `index`.
pub fn code<C: Codec>(index: u32) -> C::Code {
    let mut code = C::Code::zeroed();
    let bytes = bytes_of_mut(&mut code);
    bytes.copy_from_slice(&index.to_le_bytes()[..bytes.len()]);
    code
}

/// Compares the digest of the decoded vectors of some codes, which is a section of its own.
pub fn compare_decoded<C: Codec>(title: &'static str, codes: &[u32]) {
    let codes: Vec<C::Code> = codes.iter().map(|&index| code::<C>(index)).collect();
    let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0f32; codes.len()]);
    C::decode_soa(&codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
    let bits = x.iter().chain(&y).chain(&z).flat_map(|c| c.to_bits().to_le_bytes());
    let mut section = Section::open(title, &["decode"]);
    section.add(C::FORMAT.name(), digest(bits));
    section.finish();
}
