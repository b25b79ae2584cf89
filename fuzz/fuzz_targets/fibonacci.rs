//! Spherical Fibonacci of any number of points: the nearest of all where they are few, every index comes back, and
//! batches give what single calls give.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::SphericalFibonacci;
use unitpack_fuzz::{Bytes, ROUNDING};
use unitpack_test::oracle::fibonacci_point as exact;
use unitpack_test::vectors::{angle, bits, length, widen};
use unitpack_test::{Arrays, Vector};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let n = 1 + u32::from_le_bytes(bytes.take()) % (1 << (1 + bytes.byte() % 24));
    let points = SphericalFibonacci::new(n).unwrap();
    let rest = bytes.rest::<12>();
    let vectors: Vec<Vector> = rest.iter().map(|v| bytemuck::pod_read_unaligned(v)).collect();

    let mut indices = vec![u32::MAX; vectors.len()];
    points.encode_soa(Arrays::from(&vectors[..]).read(), &mut indices).unwrap();
    for (i, (&v, &index)) in vectors.iter().zip(&indices).enumerate() {
        assert_eq!(points.encode(v), index, "{n} points: {v:?}");
        assert!(index < n, "{n} points: {v:?} is {index}");
        let wide = widen(v);
        if i == 0 && n <= 4096 && length(wide).is_normal() {
            let least = (0..n).map(|i| angle(wide, exact(i, n))).fold(4.0, f64::min);
            let off = angle(wide, exact(index, n));
            assert!(off <= least + ROUNDING, "{n} points: {v:?} is {index}, {off} not {least}");
        }
    }

    // Any index: three to a vector.
    let given: Vec<u32> =
        rest.as_flattened().as_chunks().0.iter().map(|&i| u32::from_le_bytes(i)).collect();
    let mut soa = Arrays::unwritten([given.len(); 3]);
    points.decode_soa(&given, soa.write()).unwrap();
    for (&index, v) in given.iter().zip(soa.iter()) {
        let decoded = points.decode(index);
        assert_eq!(bits(decoded), bits(v), "{n} points: {index}");
        let last = index.min(n - 1);
        let off = angle(widen(v), exact(last, n));
        assert!(off <= 5e-7 && (length(widen(v)) - 1.0).abs() <= 2.5e-7, "{n}: {index} is {v:?}");
        assert_eq!(points.encode(v), last, "{n} points: {index} is {v:?}");
    }
});
