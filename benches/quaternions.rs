//! Quaternions per second of every codec: `encode`, `precise` and `decode`, with 16 Ki in cache.
//!
//! Names are `operation/codec/layout`, `soa` or `aos`, to be filtered with a regular expression:
//!
//! ```text
//! cargo bench --bench quaternions -- smallest-three32
//! cargo bench --bench quaternions -- decode/.*/soa
//! ```

use std::hint::black_box;
use std::time::Duration;

use bytemuck::Zeroable;
use criterion::{BenchmarkId, Criterion, Throughput};
use unitpack::quaternion::{
    QuaternionCodec, SmallestThree32, SmallestThree48, SmallestThree64, Soa4, Soa4Mut, TanThree32,
};

const LEN: usize = 16 << 10;

fn main() {
    let mut criterion = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .configure_from_args();
    let aos = quaternions();
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
        let mut group = criterion.benchmark_group(operation);
        group.throughput(Throughput::Elements(LEN as u64));
        group.bench_function(BenchmarkId::new(C::NAME, layout), |bencher| bencher.iter(&mut *run));
        group.finish();
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

/// Uniformly random rotations.
fn quaternions() -> Vec<[f32; 4]> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 40) as f32 / (1 << 24) as f32
    };
    (0..LEN)
        .map(|_| {
            let u = uniform();
            let (a, b) = ((std::f32::consts::TAU * uniform()).sin_cos(), uniform());
            let b = (std::f32::consts::TAU * b).sin_cos();
            let (r, s) = ((1.0 - u).sqrt(), u.sqrt());
            [r * a.0, r * a.1, s * b.0, s * b.1]
        })
        .collect()
}
