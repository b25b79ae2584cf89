//! Every bit pattern decodes to the unit vector that the oracle gives, which has one canonical code; and it is
//! negated and mirrored as that vector is.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack_fuzz::{Bytes, ROUNDING, Subject};
use unitpack_test::codes::last_pattern;
use unitpack_test::every_code::{DECODE_ERROR, LENGTH_ERROR};
use unitpack_test::vectors::{angle, bits, length, widen};
use unitpack_test::{Code, Operation};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let codec = Subject::choose(&mut bytes);
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

        // Another pattern of the same two parameters is the same vector.
        if let Some(parameters) = format.parameters(code as u32) {
            let again = format.from_parameters(parameters).expect("a code of them");
            assert_eq!(format.parameters(again), Some(parameters), "{format} {code:x}");
            assert_eq!(bits((codec.decode)(again.into())), bits(v), "{format} {code:x}");
        }

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

fn operations(codec: &Subject, codes: &[Code]) {
    let format = codec.format;
    // More than a block of lanes.
    let many: Vec<Code> = codes.iter().copied().cycle().take(19).collect();
    for operation in Operation::ALL {
        let by_vector =
            |&code: &Code| (codec.encode_precise)(operation.apply((codec.decode)(code)));
        let expected: Vec<Code> = codes.iter().map(by_vector).collect();
        let one: Vec<Code> = codes.iter().map(|&code| codec.operate(operation, code)).collect();
        assert_eq!(one, expected, "{format} {codes:x?}, {operation:?}");

        // Slices, of the format of this family and width that has them.
        let typed = codec.typed();
        let alone = Subject::of(typed.format);
        let many: Vec<Code> = many.iter().map(|code| code & last_pattern(typed.format)).collect();
        let mut slice = many.clone();
        (typed.operate)(operation, &mut slice);
        for (&code, &slice) in many.iter().zip(&slice) {
            let one = alone.operate(operation, code);
            assert_eq!(slice, one, "{} {many:x?}, {operation:?}", typed.format);
        }
    }
    for (&a, &b) in codes.iter().zip(&codes[1..]) {
        let same = (codec.canonical)(a) == (codec.canonical)(b);
        assert_eq!((codec.same_direction)(a, b), same, "{format} {a:x} {b:x}");
    }
}
