//! Vectors per second with dither, with stochastic rounding, of operations on codes, and of spherical Fibonacci of a
//! million points: structures of arrays, 16 Ki in cache.
//!
//! ```text
//! cargo bench --bench dither
//! ```

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput};
use unitpack::dither::Dither;
use unitpack::{Axis, Codec, Oct16, Soa, SoaMut, SphericalFibonacci};

const LEN: usize = 16 << 10;

fn main() {
    let mut criterion = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .configure_from_args();
    let points = SphericalFibonacci::new(1_000_000).unwrap();
    let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0; LEN]);
    let mut indices: Vec<u32> = (0..LEN as u32).map(|i| i * 61).collect();
    let v = SoaMut { x: &mut x, y: &mut y, z: &mut z };
    points.decode_soa(&indices, v).expect("equal lengths");
    let v = Soa { x: &x, y: &y, z: &z };
    let [mut to_x, mut to_y, mut to_z] = [0; 3].map(|_| vec![0.0; LEN]);
    let mut codes = vec![0; LEN];
    let dither = Dither::new(0);

    let mut measure = |name: &str, run: &mut dyn FnMut()| {
        let mut group = criterion.benchmark_group("beside");
        group.throughput(Throughput::Elements(LEN as u64));
        group.bench_function(name, |bencher| bencher.iter(&mut *run));
        group.finish();
    };
    measure("encode/oct16", &mut || {
        Oct16::encode_soa(black_box(v), &mut codes).expect("equal lengths");
    });
    measure("encode/oct16 dithered", &mut || {
        dither.encode_soa::<Oct16>(0, black_box(v), &mut codes).expect("equal lengths");
    });
    measure("encode/oct16 stochastic", &mut || {
        dither.encode_soa_stochastic::<Oct16>(0, black_box(v), &mut codes).expect("equal lengths");
    });
    measure("decode/oct16 dithered", &mut || {
        let v = SoaMut { x: &mut to_x, y: &mut to_y, z: &mut to_z };
        dither.decode_soa::<Oct16>(0, black_box(&codes), v).expect("equal lengths");
    });
    measure("codes/oct16 mirrored", &mut || {
        Oct16::mirror_slice(black_box(&mut codes), Axis::Z);
    });
    measure("codes/oct16 negated", &mut || Oct16::negate_slice(black_box(&mut codes)));
    measure("encode/fibonacci", &mut || {
        points.encode_soa(black_box(v), &mut indices).expect("equal lengths");
    });
    measure("decode/fibonacci", &mut || {
        let v = SoaMut { x: &mut to_x, y: &mut to_y, z: &mut to_z };
        points.decode_soa(black_box(&indices), v).expect("equal lengths");
    });
    criterion.final_summary();
}
