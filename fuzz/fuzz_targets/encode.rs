//! Encoders take any input, round as the oracle does, and give canonical codes of the direction
//! alone; the precise one gives the nearest.
#![no_main]

use std::sync::OnceLock;

use libfuzzer_sys::fuzz_target;
use unitpack_fuzz::{Bytes, ROUNDING, Subject};
use unitpack_test::Vector;
use unitpack_test::vectors::{angle, bits, chord_squared, dot, widen};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let codec = Subject::choose(&mut bytes);
    let power = i32::from(bytes.byte() as i8);
    let most = if codec.is_finer_than_f32() { 2 } else { 8 };
    for (i, v) in
        codec.vectors(&mut bytes, data.len().div_ceil(12).min(most)).into_iter().enumerate()
    {
        if codec.stores_direction() {
            // The oracle's search takes the most of the time.
            check(codec, v, power, i == 0);
        } else {
            let kept = [codec.encode, codec.encode_precise].map(|f| bits((codec.decode)(f(v))));
            assert_eq!(kept, [bits(v); 2], "{}", codec.format);
        }
    }
});

fn check(codec: &Subject, v: Vector, power: i32, search: bool) {
    let oracle = codec.oracle();
    let target = oracle.target(v);
    let of = || format!("{} of {v:?} = {:x?}", codec.format, bits(v));
    let [fast, precise] = [(codec.encode)(v), (codec.encode_precise)(v)];
    let expected = oracle.encodings(target);
    assert!(expected.contains(&fast), "{}: {fast:x}, not {expected:x?}", of());

    let [fast_off, precise_off] = [fast, precise].map(|code| {
        codec.check_canonical(code);
        if !codec.is_finer_than_f32() {
            assert_eq!(oracle.canonical(code), code, "{}", of());
        }
        let decoded = (codec.decode)(code);
        // Where a code stands for an axis, it decodes to it exactly.
        let exact = oracle.decode(code);
        let axis = exact.map(f64::round);
        if chord_squared(exact, axis) < 1e-24 {
            assert_eq!(widen(decoded), axis, "{}: {code:x}", of());
        }
        angle(widen(decoded), target)
    });
    let least = if search { nearest(codec, target).min(fast_off) } else { fast_off };
    assert!(
        precise_off <= least + ROUNDING,
        "{}: {precise:x} is off by {precise_off}, not {least}",
        of()
    );

    // Any multiple by a power of two that f32 holds is the same direction.
    let scaled = v.map(|c| (f64::from(c) * 2f64.powi(power)) as f32);
    if (0..3).all(|i| f64::from(scaled[i]) == f64::from(v[i]) * 2f64.powi(power)) {
        let codes = [(codec.encode)(scaled), (codec.encode_precise)(scaled)];
        assert_eq!(codes, [fast, precise], "{}, and {scaled:?}", of());
    }
}

/// The angle to the nearest code: of all where there are few, else of those that the oracle finds
/// around.
fn nearest(codec: &Subject, target: [f64; 3]) -> f64 {
    static ALL: [OnceLock<Vec<[f64; 3]>>; 256] = [const { OnceLock::new() }; 256];
    if codec.format.bits() > 12 {
        return codec.oracle().nearest_angle(target);
    }
    let all = ALL[codec.format as usize]
        .get_or_init(|| (0..1 << codec.format.bits()).map(|c| codec.oracle().decode(c)).collect());
    let cosine = all.iter().map(|&w| dot(w, target)).fold(-1.0, f64::max);
    // Half a chord is exact where a cosine near 1 is not.
    2.0 * ((1.0 - cosine).max(0.0) / 2.0).sqrt().asin()
}
