//! Every bit pattern decodes to the unit vector that the oracle gives, which has one canonical code; and it is
//! negated and mirrored as that vector is.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack_fuzz::common::every_code::{DECODE_ERROR, LENGTH_ERROR};
use unitpack_fuzz::common::{angle, last_pattern, length, widen};
use unitpack_fuzz::{AnyCodec, Bytes, Code, ROUNDING, bits};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let codec = AnyCodec::choose(&mut bytes);
    let (format, oracle) = (codec.format, codec.oracle());
    let count = 1 + data.len() / format.code_size();
    let most = if codec.is_finer_than_f32() { 2 } else { 8 };
    let codes = codec.codes(&mut bytes, count.min(most));
    operations(codec, &codes);
    for code in codes {
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

fn operations(codec: &AnyCodec, codes: &[Code]) {
    let format = codec.format;
    // More than a block of lanes.
    let many: Vec<Code> = codes.iter().copied().cycle().take(19).collect();
    for operation in &codec.operations {
        let expected = |&code: &Code| {
            let v = (codec.decode)(code);
            let i_th = |i: usize| if operation.negates[i] { -v[i] } else { v[i] };
            (codec.encode_precise)([0, 1, 2].map(i_th))
        };
        let expected: Vec<Code> = codes.iter().map(expected).collect();
        let one: Vec<Code> = codes.iter().map(|&code| (operation.one)(code)).collect();
        assert_eq!(one, expected, "{format} {codes:x?}, {:?}", operation.negates);
        let mut slice = many.clone();
        (operation.slice)(&mut slice);
        for (slice, one) in slice.iter().zip(one.iter().cycle()) {
            assert_eq!(slice, one, "{format} {many:x?}, {:?}", operation.negates);
        }
    }
    for (&a, &b) in codes.iter().zip(&codes[1..]) {
        let same = (codec.canonical)(a) == (codec.canonical)(b);
        assert_eq!((codec.same_direction)(a, b), same, "{format} {a:x} {b:x}");
    }
}
