//! Vectors per second of oct16 at strides, beside a plain loop and a loop that only reads the bytes: 4 Ki in cache and
//! 4 Mi from memory.
//!
//! ```text
//! cargo bench -p unitpack-bench --bench strides
//! ```

use std::hint::black_box;

use criterion::BenchmarkId;
use unitpack::{Codec, Oct16, Strided, StridedMut};
use unitpack_bench::{criterion, measure_many, random};

fn main() {
    let mut criterion = criterion();
    for (place, len) in [("cache", 4 << 10), ("memory", 4 << 20)] {
        let vectors = random(len, |rng| rng.direction());
        let mut codes = vec![0u16; len];
        for stride in [12, 16, 32, 48] {
            let mut vertices = vec![0u8; stride * len];
            for (vertex, v) in vertices.chunks_mut(stride).zip(&vectors) {
                vertex[..12].copy_from_slice(bytemuck::bytes_of(v));
            }
            let mut to = vertices.clone();
            let read = |bytes| Strided { bytes, offset: 0, stride, len };
            let mut measure = |name: &str, run: &mut dyn FnMut()| {
                let id = BenchmarkId::new(name, stride);
                measure_many(&mut criterion, place, id, len, run);
            };
            measure("encode", &mut || {
                let codes = StridedMut::of(black_box(&mut codes), 0);
                Oct16::encode_strided(read(black_box(&vertices)), codes).expect("it fits");
            });
            measure("encode to a field", &mut || {
                let codes = StridedMut { bytes: black_box(&mut to), offset: 4, stride, len };
                Oct16::encode_strided(read(black_box(&vertices)), codes).expect("it fits");
            });
            measure("encode in place", &mut || {
                let vertices = StridedMut { bytes: black_box(&mut to), offset: 0, stride, len };
                Oct16::encode_within(vertices, 0).expect("it fits");
            });
            measure("decode", &mut || {
                let vectors = StridedMut { bytes: black_box(&mut to), offset: 0, stride, len };
                Oct16::decode_strided(Strided::of(black_box(&codes), 0), vectors).expect("it fits");
            });
            measure("encode in a plain loop", &mut || {
                let vertices = black_box(&vertices).chunks_exact(stride);
                for (vertex, code) in vertices.zip(black_box(&mut codes)) {
                    *code = Oct16::encode(bytemuck::pod_read_unaligned(&vertex[..12]));
                }
            });
            measure("read", &mut || {
                let words = black_box(&vertices).as_chunks::<8>().0.iter();
                black_box(words.fold(0, |sum, word| sum ^ u64::from_ne_bytes(*word)));
            });
        }
    }
    criterion.final_summary();
}
