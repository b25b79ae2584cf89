//! Vectors per second of every codec: `encode`, `precise` and `decode`, with 16 Ki vectors in cache
//! and with 16 Mi from memory. Beside each `batch` is `scalar`, a plain loop over the codec's
//! function for one vector.
//!
//! Names are `place/operation/format/loop`, to be filtered with a regular expression:
//!
//! ```text
//! cargo bench -p unitpack-bench --bench codecs -- oct16
//! cargo bench -p unitpack-bench --bench codecs -- cache/decode
//! cargo bench -p unitpack-bench --bench codecs -- 'memory/.*/batch'
//! ```
//!
//! A precise encoder too slow for so many vectors takes fewer, and its name says how many: `batch
//! of 65536`.

use std::cell::RefCell;
use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Throughput};
use unitpack::{Codec, Format, Soa, SoaMut, Visitor};
use unitpack_bench::{criterion, random};
use unitpack_test::Arrays;
use unitpack_test::random::Rng;

const PLACES: [(&str, usize); 2] = [("cache", 16 << 10), ("memory", 16 << 20)];

/// The longest that a precise encoder may take for all vectors once.
const PASS: Duration = Duration::from_secs(1);

fn main() {
    let mut criterion = criterion();
    let data = RefCell::new(Data::default());
    for (place, len) in PLACES {
        for operation in [Operation::Encode, Operation::Precise, Operation::Decode] {
            let mut group = criterion.benchmark_group(format!("{place}/{}", operation.name()));
            for &format in Format::ALL {
                format.visit(Bench { group: &mut group, operation, len, data: &data });
            }
            group.finish();
        }
    }
    criterion.final_summary();
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Operation {
    Encode,
    Precise,
    Decode,
}

impl Operation {
    fn name(self) -> &'static str {
        match self {
            Operation::Encode => "encode",
            Operation::Precise => "precise",
            Operation::Decode => "decode",
        }
    }

    fn batch<C: Codec>(self, buffers: &mut Buffers<'_, C>) {
        let Buffers { input, output: [x, y, z], codes } = buffers;
        match self {
            Operation::Encode => C::encode_soa(*input, codes),
            Operation::Precise => C::encode_soa_precise(*input, codes),
            Operation::Decode => C::decode_soa(codes, SoaMut { x, y, z }),
        }
        .expect("equal lengths");
    }

    fn scalar<C: Codec>(self, buffers: &mut Buffers<'_, C>) {
        match self {
            Operation::Encode => encode_each(buffers, C::encode),
            Operation::Precise => encode_each(buffers, C::encode_precise),
            Operation::Decode => {
                let [x, y, z] = &mut buffers.output;
                let outputs = x.iter_mut().zip(y.iter_mut()).zip(z.iter_mut());
                for (&code, ((x, y), z)) in buffers.codes.iter().zip(outputs) {
                    [*x, *y, *z] = C::decode(code);
                }
            }
        }
    }
}

fn encode_each<C: Codec>(buffers: &mut Buffers<'_, C>, encode: impl Fn([f32; 3]) -> C::Code) {
    let Soa { x, y, z } = buffers.input;
    for (((&x, &y), &z), code) in x.iter().zip(y).zip(z).zip(&mut *buffers.codes) {
        *code = encode([x, y, z]);
    }
}

/// Measures one operation of one codec in one place.
struct Bench<'a, 'c> {
    group: &'a mut BenchmarkGroup<'c, WallTime>,
    operation: Operation,
    len: usize,
    data: &'a RefCell<Data>,
}

impl Visitor for Bench<'_, '_> {
    type Output = ();

    fn visit<C: Codec>(self) {
        let Bench { group, operation, len: all, data } = self;
        let loops: [(&str, Loop<C>); 2] =
            [("batch", Operation::batch::<C>), ("scalar", Operation::scalar::<C>)];
        for (name, run) in loops {
            let (len, name) = match affordable::<C>(data, run) {
                fewer if operation == Operation::Precise && fewer < all => {
                    (fewer, format!("{name} of {fewer}"))
                }
                _ => (all, name.to_string()),
            };
            group.throughput(Throughput::Elements(len as u64));
            // Criterion calls this once per sample, and not at all if the name is filtered out.
            let mut filled = false;
            group.bench_function(BenchmarkId::new(C::FORMAT.name(), name), |bencher| {
                let mut data = data.borrow_mut();
                let mut buffers = data.buffers::<C>(len);
                if !filled {
                    // Codes to decode.
                    Operation::Encode.batch(&mut buffers);
                    filled = true;
                }
                bencher.iter(|| run(operation, black_box(&mut buffers)));
            });
        }
    }
}

type Loop<C> = fn(Operation, &mut Buffers<'_, C>);

/// How many vectors the precise encoder gets through in time: 16 Mi over a power of 16, so that the
/// names of the benchmarks stay the same from run to run.
fn affordable<C: Codec>(data: &RefCell<Data>, run: Loop<C>) -> usize {
    const PROBE: usize = 256;
    let mut data = data.borrow_mut();
    let mut buffers = data.buffers::<C>(PROBE);
    let start = Instant::now();
    run(Operation::Precise, black_box(&mut buffers));
    let each = start.elapsed() / PROBE as u32;
    let mut len = 16 << 20;
    while each * len as u32 > PASS && len > PROBE {
        len /= 16;
    }
    len
}

/// The buffers that all benchmarks share, as long as the longest so far.
#[derive(Default)]
struct Data {
    input: Arrays,
    /// |z|, for the formats of a hemisphere.
    upper: Vec<f32>,
    output: Arrays,
    /// Room for codes of up to 12 bytes.
    codes: Vec<[u32; 3]>,
}

struct Buffers<'a, C: Codec> {
    input: Soa<'a>,
    output: [&'a mut [f32]; 3],
    codes: &'a mut [C::Code],
}

impl Data {
    fn buffers<C: Codec>(&mut self, len: usize) -> Buffers<'_, C> {
        if self.codes.len() < len {
            self.input = Arrays::from(&random(len, Rng::direction)[..]);
            self.upper = self.input.z.iter().map(|z| z.abs()).collect();
            self.output = Arrays::filled([len; 3], 0.0);
            self.codes.resize(len, [0; 3]);
        }
        let Soa { x, y, z } = self.input.read();
        let z = if C::FORMAT.is_hemisphere() { &self.upper } else { z };
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut self.codes);
        Buffers {
            input: Soa { x: &x[..len], y: &y[..len], z: &z[..len] },
            output: [&mut self.output.x, &mut self.output.y, &mut self.output.z]
                .map(|component| &mut component[..len]),
            codes: bytemuck::cast_slice_mut(&mut bytes[..len * size_of::<C::Code>()]),
        }
    }
}
