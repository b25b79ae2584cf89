//! Eight lanes give the bits that one lane gives.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::{Codec, Visitor};
use unitpack_fuzz::{bits, choose, codes, decode_soa, encode_soa, vectors};

struct Check<'a>(&'a [u8]);

impl Visitor for Check<'_> {
    type Output = ();
    fn visit<C: Codec>(self) {
        let vectors = vectors(C::FORMAT, self.0);
        let fast = encode_soa::<C>(&vectors, C::encode_soa);
        let precise = encode_soa::<C>(&vectors, C::encode_soa_precise);
        for ((&v, fast), precise) in vectors.iter().zip(fast).zip(precise) {
            assert_eq!(fast, C::encode(v), "{} encode {:x?}", C::FORMAT, bits(v));
            assert_eq!(precise, C::encode_precise(v), "{} precise {:x?}", C::FORMAT, bits(v));
        }
        let codes = codes::<C>(self.0);
        for (&code, v) in codes.iter().zip(decode_soa::<C>(&codes)) {
            assert_eq!(bits(v), bits(C::decode(code)), "{} decode {code:x?}", C::FORMAT);
        }
    }
}

fuzz_target!(|data: &[u8]| {
    if let Some((format, bytes)) = choose(data) {
        format.visit(Check(bytes));
    }
});
