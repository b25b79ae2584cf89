//! What the benchmarks share: how long they measure, and what.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput};
use unitpack_test::random::Rng;

/// How many elements stay in the cache.
pub const LEN: usize = 16 << 10;

/// Criterion as the command line wants it, a second for each benchmark.
pub fn criterion() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .configure_from_args()
}

/// Measures a function that processes [`LEN`] elements.
pub fn measure(criterion: &mut Criterion, group: &str, id: BenchmarkId, run: &mut dyn FnMut()) {
    measure_many(criterion, group, id, LEN, run);
}

/// Measures a function that processes `len` elements.
pub fn measure_many(
    criterion: &mut Criterion,
    group: &str,
    id: BenchmarkId,
    len: usize,
    run: &mut dyn FnMut(),
) {
    let mut group = criterion.benchmark_group(group);
    group.throughput(Throughput::Elements(len as u64));
    group.bench_function(id, |bencher| bencher.iter(&mut *run));
    group.finish();
}

/// `count` items, each from the same random numbers in every run.
pub fn random<T>(count: usize, mut item: impl FnMut(&mut Rng) -> T) -> Vec<T> {
    let mut rng = Rng::new(1);
    (0..count).map(|_| item(&mut rng)).collect()
}
