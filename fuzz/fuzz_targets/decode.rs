//! Every bit pattern decodes to the unit vector that the oracle gives, which has one canonical code.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack_fuzz::common::every_code::{DECODE_ERROR, LENGTH_ERROR};
use unitpack_fuzz::common::{angle, last_pattern, length, widen};
use unitpack_fuzz::{AnyCodec, Bytes, ROUNDING, bits};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let codec = AnyCodec::choose(&mut bytes);
    let (format, oracle) = (codec.format, codec.oracle());
    let count = 1 + data.len() / format.code_size();
    let most = if codec.is_finer_than_f32() { 2 } else { 8 };
    for code in codec.codes(&mut bytes, count.min(most)) {
        let v = (codec.decode)(code);
        let again = (codec.encode_precise)(v);
        if !codec.stores_direction() {
            assert_eq!(again, code, "{format}");
            continue;
        }
        assert!(v.iter().all(|c| c.is_finite()), "{format} {code:x}: {v:?}");
        let off_unit = (length(widen(v)) - 1.0).abs();
        assert!(off_unit <= LENGTH_ERROR, "{format} {code:x}: {v:?} is off by {off_unit}");
        let off = angle(widen(v), oracle.decode(code));
        assert!(off <= DECODE_ERROR, "{format} {code:x}: {v:?}, not {:?}", oracle.decode(code));

        // Bits above those of the format say nothing.
        let used = u128::MAX >> (128 - format.bits());
        for same in [code & used, code | last_pattern(format) & !used] {
            assert_eq!(bits((codec.decode)(same)), bits(v), "{format} {code:x} and {same:x}");
        }

        codec.check_canonical(again);
        assert_eq!(again, (codec.canonical)(code), "{format} {code:x} {v:?}");
        if codec.is_finer_than_f32() {
            let off = angle(widen((codec.decode)(again)), widen(v));
            assert!(off <= ROUNDING, "{format} {code:x} {v:?} became {again:x}: {off}");
        } else {
            // Two exact directions may be one in f32.
            let exact = oracle.canonical(code);
            let coincides = exact == code && bits((codec.decode)(again)) == bits(v);
            assert!(
                again == exact || coincides,
                "{format} {code:x} {v:?}: {again:x}, not {exact:x}"
            );
        }
    }
});
