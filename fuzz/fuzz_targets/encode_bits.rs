//! Encoders take any input, give canonical codes, and the precise one is never the worse.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::{Codec, Visitor};
use unitpack_fuzz::{ROUNDING, angle, bits, choose, meant, stores_direction, vectors};

struct Check<'a>(&'a [u8]);

impl Visitor for Check<'_> {
    type Output = ();
    fn visit<C: Codec>(self) {
        let format = C::FORMAT;
        for v in vectors(format, self.0) {
            let codes = [C::encode(v), C::encode_precise(v)];
            let decoded = codes.map(C::decode);
            if !stores_direction(format) {
                assert_eq!(decoded.map(bits), [bits(v); 2], "{format}");
                continue;
            }
            let name = ["encode", "encode_precise"];
            // Beyond 32 bits, codes are closer together than f32 can tell.
            for i in (0..2).filter(|_| format.bits() <= 32) {
                let again = C::encode_precise(decoded[i]);
                let (name, code, decoded) = (name[i], codes[i], decoded[i]);
                assert_eq!(
                    again,
                    code,
                    "{format} {name} {:x?} {v:?}, decoded {decoded:?}",
                    bits(v)
                );
            }
            let [fast, precise] = decoded.map(|d| angle(d.map(f64::from), meant(format, v)));
            assert!(
                precise <= fast + ROUNDING,
                "{format} {:x?} {v:?}: encode {:x?} is off by {fast}, encode_precise {:x?} by {precise}",
                bits(v),
                codes[0],
                codes[1]
            );
        }
    }
}

fuzz_target!(|data: &[u8]| {
    if let Some((format, bytes)) = choose(data) {
        format.visit(Check(bytes));
    }
});
