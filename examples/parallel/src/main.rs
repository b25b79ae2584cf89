//! All cores: slices are encoded and decoded in chunks with rayon, to the same bits as whole, and the times compared.
//!
//! ```text
//! cargo run --release -p parallel
//! ```

use std::time::{Duration, Instant};

use rayon::prelude::*;
use unitpack::{Codec, LatLong16D, Oct16, Soa, SoaMut};
use unitpack_test::Arrays;
use unitpack_test::vectors::golden_spiral;

const LEN: usize = 4 << 20;
/// Vectors in a chunk: enough that sharing them out costs nothing, and 256 KB, so that they stay in a core's cache.
const CHUNK: usize = 16 << 10;

fn main() {
    let v: Arrays = golden_spiral(LEN).collect();
    println!(
        "{} threads, {LEN} vectors, ms: whole, in chunks, times as fast",
        rayon::current_num_threads()
    );
    compare::<Oct16>(&v);
    compare::<LatLong16D>(&v);
}

fn compare<C: Codec<Code: Send + Sync>>(v: &Arrays) {
    let mut whole = vec![C::encode([0.0, 0.0, 1.0]); LEN];
    let mut chunked = whole.clone();
    let encode = || C::encode_soa(v.read(), &mut whole).unwrap();
    let encode_chunks = || {
        let v = v.x.par_chunks(CHUNK).zip(v.y.par_chunks(CHUNK)).zip(v.z.par_chunks(CHUNK));
        v.zip(chunked.par_chunks_mut(CHUNK))
            .for_each(|(((x, y), z), codes)| C::encode_soa(Soa { x, y, z }, codes).unwrap());
    };
    print::<C>("encode", encode, encode_chunks);
    assert!(whole == chunked, "{}: chunks encode otherwise", C::FORMAT);

    let (mut a, mut b) = (v.clone(), v.clone());
    let decode = || C::decode_soa(&whole, a.write()).unwrap();
    let decode_chunks = || {
        let v =
            b.x.par_chunks_mut(CHUNK).zip(b.y.par_chunks_mut(CHUNK)).zip(b.z.par_chunks_mut(CHUNK));
        v.zip(whole.par_chunks(CHUNK))
            .for_each(|(((x, y), z), codes)| C::decode_soa(codes, SoaMut { x, y, z }).unwrap());
    };
    print::<C>("decode", decode, decode_chunks);
    assert!(a.bits().eq(b.bits()), "{}: chunks decode otherwise", C::FORMAT);
}

/// The best of some turns of each.
fn print<C: Codec>(what: &str, mut whole: impl FnMut(), mut chunked: impl FnMut()) {
    fn time(f: &mut impl FnMut()) -> Duration {
        let start = Instant::now();
        f();
        start.elapsed()
    }
    let [mut one, mut many] = [Duration::MAX; 2];
    for _ in 0..20 {
        one = time(&mut whole).min(one);
        many = time(&mut chunked).min(many);
    }
    let [one, many] = [one, many].map(|time| time.as_secs_f64() * 1e3);
    println!("{what} {:10} {one:7.2} {many:7.2} {:5.2}", C::FORMAT.name(), one / many);
}
