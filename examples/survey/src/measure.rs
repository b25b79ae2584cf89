//! Measuring one codec on one set of vectors.

use std::hint::black_box;
use std::time::{Duration, Instant};

use unitpack::{Format, Soa};
use unitpack_test::codes::{decode_slice, encode_slice};
use unitpack_test::vectors::angle;
use unitpack_test::{Arrays, Effort};

use crate::vectors::spread;

/// An encoder that would take longer than this over all vectors gets fewer of them.
const LONGEST_PASS: Duration = Duration::from_secs(1);
/// Passes go on, at least two and at most `MOST_PASSES` of them, until this much time has gone.
const ENOUGH: Duration = Duration::from_millis(100);
pub const MOST_PASSES: usize = 7;
/// How many vectors tell how fast an encoder is.
const PROBE: usize = 1024;

/// What was measured of one encoder of one format.
pub struct Row {
    pub format: Format,
    pub precise: bool,
    /// Measured on the hemisphere z >= 0.
    pub hemisphere: bool,
    /// How many vectors were measured: fewer than there are if the encoder is slow.
    pub vectors: usize,
    /// Errors in degrees.
    pub mean: f64,
    pub rms: f64,
    pub max: f64,
    /// Time a vector.
    pub encode_ns: f64,
    pub decode_ns: f64,
}

impl Row {
    /// The survey's name: that of a precise encoder ends in P.
    pub fn name(&self) -> String {
        format!("{}{}", self.format.name(), if self.precise { "P" } else { "" })
    }

    /// The mean and greatest error over those of the best that any code of this size could do on
    /// uniform vectors: hexagonal cells (mean) and Fejes Toth's bound (maximum) with 2^bits points.
    pub fn over_best(&self) -> (f64, f64) {
        let area = if self.hemisphere { 0.5 } else { 1.0 };
        let cell = (area / f64::from(self.format.bits()).exp2()).sqrt();
        (self.mean / (76.61 * cell), self.max / (126.01 * cell))
    }

    /// Bytes read and written over time, encoding and decoding. In bytes per nanosecond, which is
    /// GB/s.
    pub fn throughput(&self) -> (f64, f64) {
        let bytes = (size_of::<[f32; 3]>() + self.format.code_size()) as f64;
        (bytes / self.encode_ns, bytes / self.decode_ns)
    }
}

/// Measures `format` on `vectors`, which have z >= 0 if `hemisphere` says so.
pub fn measure(format: Format, precise: bool, hemisphere: bool, vectors: &Arrays) -> Row {
    let mut codes = vec![0; vectors.count() * format.code_size()];
    let probe = spread(vectors, PROBE.min(vectors.count()));
    let probe_codes = &mut codes[..probe.count() * format.code_size()];
    let pace = (0..3)
        .map(|_| time(1, || encode(format, precise, probe.read(), probe_codes)))
        .fold(f64::INFINITY, f64::min)
        / probe.count() as f64;
    let affordable = (LONGEST_PASS.as_secs_f64() / pace) as usize;
    let fewer;
    let vectors = if affordable < vectors.count() {
        fewer = spread(vectors, affordable.max(probe.count()));
        &fewer
    } else {
        vectors
    };

    let count = vectors.count();
    let codes = &mut codes[..count * format.code_size()];
    let mut decoded = Arrays::filled([count; 3], 0.0);
    // A clock cannot time a handful of vectors.
    let calls = (4096 / count).max(1);
    let (mut encoding, mut decoding) = (f64::INFINITY, f64::INFINITY);
    let start = Instant::now();
    for pass in 0..MOST_PASSES {
        if pass >= 2 && start.elapsed() >= ENOUGH {
            break;
        }
        encoding = encoding.min(time(calls, || encode(format, precise, vectors.read(), codes)));
        decoding = decoding.min(time(calls, || {
            decode_slice(format, black_box(codes), decoded.write()).expect("the lengths fit");
        }));
    }

    let (mean, rms, max) = errors(vectors, &decoded);
    let ns = 1e9 / count as f64;
    Row {
        format,
        precise,
        hemisphere,
        vectors: count,
        mean,
        rms,
        max,
        encode_ns: encoding * ns,
        decode_ns: decoding * ns,
    }
}

/// Whether both encoders of `format` give the same codes, as far as these vectors tell.
pub fn encoders_agree(format: Format, Soa { x, y, z }: Soa<'_>) -> bool {
    let (mut fast, mut precise) = (vec![0; PROBE * format.code_size()], Vec::new());
    x.chunks(PROBE).zip(y.chunks(PROBE)).zip(z.chunks(PROBE)).all(|((x, y), z)| {
        fast.truncate(x.len() * format.code_size());
        precise.resize(fast.len(), 0);
        encode(format, false, Soa { x, y, z }, &mut fast);
        encode(format, true, Soa { x, y, z }, &mut precise);
        fast == precise
    })
}

fn encode(format: Format, precise: bool, v: Soa<'_>, codes: &mut [u8]) {
    let effort = if precise { Effort::Precise } else { Effort::Fast };
    encode_slice(format, effort, v, black_box(codes)).expect("the lengths fit");
}

/// Seconds that one call takes, averaged over `calls`.
fn time(calls: usize, mut call: impl FnMut()) -> f64 {
    let start = Instant::now();
    for _ in 0..calls {
        call();
    }
    start.elapsed().as_secs_f64() / calls as f64
}

/// Mean, root mean square and greatest angle between the vectors, in degrees.
fn errors(a: &Arrays, b: &Arrays) -> (f64, f64, f64) {
    let (mut sum, mut squares, mut max) = (0.0, 0.0, 0.0);
    for (a, b) in a.wide().zip(b.wide()) {
        let e = angle(a, b).to_degrees();
        sum += e;
        squares += e * e;
        max = e.max(max);
    }
    let count = a.count() as f64;
    (sum / count, (squares / count).sqrt(), max)
}
