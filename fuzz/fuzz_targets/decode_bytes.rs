//! Every bit pattern decodes to a unit vector, which has one canonical code.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::{Codec, Visitor};
use unitpack_fuzz::{ROUNDING, angle, bits, choose, codes, stores_direction};

struct Check<'a>(&'a [u8]);

impl Visitor for Check<'_> {
    type Output = ();
    fn visit<C: Codec>(self) {
        let format = C::FORMAT;
        for code in codes::<C>(self.0) {
            let v = C::decode(code);
            let canonical = C::encode_precise(v);
            if !stores_direction(format) {
                assert_eq!(canonical, code, "{format} {code:x?}: {:x?}", bits(v));
                continue;
            }
            assert!(v.iter().all(|c| c.is_finite()), "{format} {code:x?}: {v:?}");
            let length = v.iter().map(|&c| f64::from(c).powi(2)).sum::<f64>().sqrt();
            assert!((length - 1.0).abs() <= 2.5e-7, "{format} {code:x?}: {v:?} is {length} long");

            let w = C::decode(canonical);
            let off = angle(v.map(f64::from), w.map(f64::from));
            assert!(off <= ROUNDING, "{format} {code:x?} {v:?} became {canonical:x?} {w:?}: {off}");
            let again = C::encode_precise(w);
            assert_eq!(again, canonical, "{format} {code:x?} {v:?} became {canonical:x?} {w:?}");
        }
    }
}

fuzz_target!(|data: &[u8]| {
    if let Some((format, bytes)) = choose(data) {
        format.visit(Check(bytes));
    }
});
