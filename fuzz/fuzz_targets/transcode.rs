//! Transcoding is decoding, then encoding.
//!
//! From or to one format of each kind of code: all pairs would be as many functions as the square
//! of the table.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::{Codec, Float32x3, Oct8, Oct16, Oct24, Oct32, Snorm16x3, Visitor, transcode};
use unitpack_fuzz::{choose, codes};

struct Check<'a>(&'a [u8]);

fn there_and_back<A: Codec, B: Codec>(bytes: &[u8]) {
    check::<A, B>(bytes);
    check::<B, A>(bytes);
}

fn check<A: Codec, B: Codec>(bytes: &[u8]) {
    let src = codes::<A>(bytes);
    let mut dst = vec![bytemuck::Zeroable::zeroed(); src.len()];
    transcode::<A, B>(&src, &mut dst).unwrap();
    for (code, got) in src.into_iter().zip(dst) {
        assert_eq!(got, B::encode(A::decode(code)), "{} {code:x?} to {}", A::FORMAT, B::FORMAT);
    }
}

impl Visitor for Check<'_> {
    type Output = ();
    fn visit<C: Codec>(self) {
        let Some((other, bytes)) = self.0.split_first() else { return };
        match other % 7 {
            0 => there_and_back::<C, Oct8>(bytes),
            1 => there_and_back::<C, Oct16>(bytes),
            2 => there_and_back::<C, Oct24>(bytes),
            3 => there_and_back::<C, Oct32>(bytes),
            4 => there_and_back::<C, Snorm16x3>(bytes),
            5 => there_and_back::<C, Float32x3>(bytes),
            _ => check::<C, C>(bytes),
        }
    }
}

fuzz_target!(|data: &[u8]| {
    if let Some((format, bytes)) = choose(data) {
        format.visit(Check(bytes));
    }
});
