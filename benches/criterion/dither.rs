//! Vectors per second with dither, with stochastic rounding, of operations on codes, and of
//! spherical Fibonacci of a million points: structures of arrays, 16 Ki in cache.
//!
//! ```text
//! cargo bench -p unitpack-bench --bench dither
//! ```

use std::hint::black_box;

use criterion::BenchmarkId;
use unitpack::dither::Dither;
use unitpack::{Axis, Codec, Oct16, SphericalFibonacci};
use unitpack_bench::{LEN, criterion, measure};
use unitpack_test::Arrays;

fn main() {
    let mut criterion = criterion();
    let points = SphericalFibonacci::new(1_000_000).unwrap();
    let mut indices: Vec<u32> = (0..LEN as u32).map(|i| i * 61).collect();
    let mut v = Arrays::filled([LEN; 3], 0.0);
    points.decode_soa(&indices, v.write()).expect("equal lengths");
    let v = v.read();
    let mut to = Arrays::filled([LEN; 3], 0.0);
    let mut codes = vec![0; LEN];
    let dither = Dither::new(0);

    let mut measure = |name: &str, run: &mut dyn FnMut()| {
        measure(&mut criterion, "beside", BenchmarkId::from_parameter(name), run);
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
        dither.decode_soa::<Oct16>(0, black_box(&codes), to.write()).expect("equal lengths");
    });
    measure("codes/oct16 mirrored", &mut || {
        Oct16::mirror_slice(black_box(&mut codes), Axis::Z);
    });
    measure("codes/oct16 negated", &mut || Oct16::negate_slice(black_box(&mut codes)));
    measure("encode/fibonacci", &mut || {
        points.encode_soa(black_box(v), &mut indices).expect("equal lengths");
    });
    measure("decode/fibonacci", &mut || {
        points.decode_soa(black_box(&indices), to.write()).expect("equal lengths");
    });
    criterion.final_summary();
}
