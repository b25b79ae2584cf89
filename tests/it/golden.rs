//! The formats are frozen: `tests/digests.txt` has a digest each for `encode`, `encode_precise` and
//! `decode` over fixed inputs.

use unitpack::Format;
use unitpack_test::codes::{decode_slice, encode_slice};
use unitpack_test::digests::{Section, digest};
use unitpack_test::random::Rng;
use unitpack_test::{AnyCodec, Arrays, Effort, Vector};

/// The digest of the bits of floats, one component of all vectors after another. All NaN count as
/// one, since moving them changes their bits on some machines.
fn digest_arrays(v: &Arrays) -> u64 {
    let bits = |c: &f32| if c.is_nan() { 0x7FC0_0000 } else { c.to_bits() };
    digest(v.x.iter().chain(&v.y).chain(&v.z).flat_map(|c| bits(c).to_le_bytes()))
}

/// Made of exact operations only.
fn vectors() -> Vec<Vector> {
    let mut vectors = Vec::new();
    let mut random = Rng::new(1);

    // Axes, faces, diagonals, zeros of both signs, and what is no direction.
    let odd = [0.0, -0.0, 1.0, -1.0, 0.5, 1e-40, -1e-40, 3e38, f32::INFINITY, f32::NEG_INFINITY];
    for x in odd {
        for y in odd {
            vectors.extend(odd.map(|z| [x, y, z]));
        }
    }
    let nan = f32::from_bits(0x7FC0_0000);
    vectors.extend([[nan, 0.0, 1.0], [1.0, nan, f32::INFINITY], [nan, nan, nan]]);

    // Ties of a component, of two, and of both parameters of the octahedral square; and beside
    // them.
    for bits in 4..=16 {
        let steps = ((1 << bits) - 1) as f32;
        for _ in 0..24 {
            let mut tie = || ((random.signed() * steps).floor() + 0.5) / steps;
            let (a, b) = (tie(), tie());
            let c = 1.0 - a.abs() - b.abs();
            let round = [a, b, (1.0 - a * a - b * b).max(0.0).sqrt()];
            let [x, y, z] = if c >= 0.0 {
                [a, b, c]
            } else {
                [(1.0 - b.abs()).copysign(a), (1.0 - a.abs()).copysign(b), c]
            };
            vectors.extend([[a, b, 1.0], round, [b, round[2], a], [x, y, z]]);
            vectors.extend([[x.next_up(), y, z], [x, y.next_down(), z], [x, y, -z]]);
        }
    }

    // Small, large and usual directions, and any bits.
    for scale in [1e-40, 1e-15, 1e15, 1e38] {
        vectors.extend((0..64).map(|_| [(); 3].map(|()| random.signed() * scale)));
    }
    vectors.extend((0..3000).map(|_| [(); 3].map(|()| random.signed())));
    vectors.extend((0..500).map(|_| {
        [(); 3]
            .map(|()| f32::from_bits(random.bits() as u32))
            .map(|c| if c.is_nan() { nan } else { c })
    }));
    vectors
}

/// Bytes of codes: runs of one byte, then random ones. A multiple of every size of code up to 12
/// bytes.
fn codes() -> Vec<u8> {
    let mut random = Rng::new(2);
    let runs = (0..=255).flat_map(|byte| [byte; 24]);
    runs.chain((0..48_000).map(|_| (random.bits() >> 56) as u8)).collect()
}

fn encode(vectors: &[Vector], format: Format, effort: Effort) -> u64 {
    // The search of these is slow: a part will do.
    let slow = AnyCodec::of(format).is_finer_than_f32();
    let every = if slow && effort == Effort::Precise { 16 } else { 1 };
    let v: Arrays = vectors.iter().copied().step_by(every).collect();
    let mut bytes = vec![0; v.count() * format.code_size()];
    encode_slice(format, effort, v.read(), &mut bytes).unwrap();
    digest(bytes)
}

fn decode(codes: &[u8], format: Format) -> u64 {
    let mut v = Arrays::unwritten([codes.len() / format.code_size(); 3]);
    decode_slice(format, codes, v.write()).unwrap();
    digest_arrays(&v)
}

#[test]
fn digests_have_not_changed() {
    let (vectors, codes) = (vectors(), codes());
    // So that a change to the inputs is not taken for one to the formats.
    let mut inputs = Section::open("it: inputs", &["digest"]);
    inputs.add("vectors", digest_arrays(&Arrays::from(&vectors[..])));
    inputs.add("codes", digest(codes.iter().copied()));
    inputs.finish();

    let mut formats = Section::open("it: formats", &["encode", "encode_precise", "decode"]);
    for &format in Format::ALL {
        for effort in Effort::BOTH {
            formats.add(format.name(), encode(&vectors, format, effort));
        }
        formats.add(format.name(), decode(&codes, format));
    }
    formats.finish();
}
