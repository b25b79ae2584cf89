//! Tangent frames per second: `encode`, `precise` and `decode`, with 16 Ki frames in cache, of
//! structures of arrays and of arrays of structures.
//!
//! ```text
//! cargo bench -p unitpack-bench --bench frames -- octangle32
//! ```

use bytemuck::Zeroable;
use criterion::{Criterion, Throughput};
use unitpack::frame::{FrameCodec, FrameSoa, FrameSoaMut, OctAngle32, OctAngle64, QTangent64};
use unitpack::{Soa, SoaMut};
use unitpack_bench::{LEN, criterion, random};

fn main() {
    let mut criterion = criterion();
    bench::<OctAngle32>(&mut criterion);
    bench::<OctAngle64>(&mut criterion);
    bench::<QTangent64>(&mut criterion);
    criterion.final_summary();
}

fn bench<C: FrameCodec>(criterion: &mut Criterion) {
    let numbers = random(7 * LEN, |rng| rng.signed());
    let columns = [0, 1, 2, 3, 4, 5, 6].map(|i| numbers[i * LEN..][..LEN].to_vec());
    let [nx, ny, nz, tx, ty, tz, handedness] = &columns;
    let frames = FrameSoa {
        normal: Soa { x: nx, y: ny, z: nz },
        tangent: Soa { x: tx, y: ty, z: tz },
        handedness,
    };
    let mut normals: Vec<[f32; 3]> = (0..LEN).map(|i| [nx[i], ny[i], nz[i]]).collect();
    let mut tangents: Vec<[f32; 4]> =
        (0..LEN).map(|i| [tx[i], ty[i], tz[i], handedness[i]]).collect();
    let mut codes = vec![C::Code::zeroed(); LEN];
    let mut output = columns.clone();

    let mut group = criterion.benchmark_group(C::NAME);
    group.throughput(Throughput::Elements(LEN as u64));
    group.bench_function("encode/soa", |b| b.iter(|| C::encode_soa(frames, &mut codes)));
    group.bench_function("precise/soa", |b| b.iter(|| C::encode_soa_precise(frames, &mut codes)));
    group.bench_function("encode/aos", |b| {
        b.iter(|| C::encode_aos(&normals, &tangents, &mut codes));
    });
    group.bench_function("precise/aos", |b| {
        b.iter(|| C::encode_aos_precise(&normals, &tangents, &mut codes));
    });
    group.bench_function("decode/soa", |b| {
        let [nx, ny, nz, tx, ty, tz, handedness] = &mut output;
        b.iter(|| {
            let normal = SoaMut { x: nx, y: ny, z: nz };
            let tangent = SoaMut { x: tx, y: ty, z: tz };
            C::decode_soa(&codes, FrameSoaMut { normal, tangent, handedness })
        });
    });
    group.bench_function("decode/aos", |b| {
        b.iter(|| C::decode_aos(&codes, &mut normals, &mut tangents));
    });
    group.finish();
}
