//! Quaternions per second of every codec: `encode`, `precise` and `decode`, with 16 Ki in cache.
//!
//! Names are `operation/codec/layout`, `soa` or `aos`, to be filtered with a regular expression:
//!
//! ```text
//! cargo bench -p unitpack-bench --bench quaternions -- smallest-three32
//! cargo bench -p unitpack-bench --bench quaternions -- decode/.*/soa
//! ```

use std::hint::black_box;

use bytemuck::Zeroable;
use criterion::{BenchmarkId, Criterion};
use unitpack::quaternion::{
    QuaternionCodec, SmallestThree32, SmallestThree48, SmallestThree64, Soa4, Soa4Mut, TanThree32,
};
use unitpack_bench::{LEN, criterion, measure, random};

fn main() {
    let mut criterion = criterion();
    let aos = random(LEN, |rng| rng.quaternion());
    codec::<SmallestThree32>(&mut criterion, &aos);
    codec::<SmallestThree48>(&mut criterion, &aos);
    codec::<SmallestThree64>(&mut criterion, &aos);
    codec::<TanThree32>(&mut criterion, &aos);
    criterion.final_summary();
}

fn codec<C: QuaternionCodec>(criterion: &mut Criterion, aos: &[[f32; 4]]) {
    let [x, y, z, w] = [0, 1, 2, 3].map(|i| aos.iter().map(|q| q[i]).collect::<Vec<f32>>());
    let soa = Soa4 { x: &x, y: &y, z: &z, w: &w };
    let mut codes = vec![C::Code::zeroed(); LEN];
    let mut measure = |operation: &str, layout: &str, run: &mut dyn FnMut()| {
        measure(criterion, operation, BenchmarkId::new(C::NAME, layout), run);
    };
    measure("encode", "soa", &mut || {
        C::encode_soa(black_box(soa), &mut codes).expect("equal lengths");
    });
    measure("encode", "aos", &mut || {
        C::encode_aos(black_box(aos), &mut codes).expect("equal lengths");
    });
    measure("precise", "soa", &mut || {
        C::encode_soa_precise(black_box(soa), &mut codes).expect("equal lengths");
    });
    measure("precise", "aos", &mut || {
        C::encode_aos_precise(black_box(aos), &mut codes).expect("equal lengths");
    });
    // Codes to decode, also if the encoders are filtered out.
    C::encode_soa(soa, &mut codes).expect("equal lengths");
    let [mut x, mut y, mut z, mut w] = [0; 4].map(|_| vec![0.0; LEN]);
    measure("decode", "soa", &mut || {
        let q = Soa4Mut { x: &mut x, y: &mut y, z: &mut z, w: &mut w };
        C::decode_soa(black_box(&codes), q).expect("equal lengths");
    });
    let mut back = vec![[0.0; 4]; LEN];
    measure("decode", "aos", &mut || {
        C::decode_aos(black_box(&codes), &mut back).expect("equal lengths");
    });
}
