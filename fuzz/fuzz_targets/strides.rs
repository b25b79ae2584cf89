//! Elements at any stride: those that fit are read and written alone, and give what single vectors do; others are
//! refused, and nothing is written. In place, each element is read before it is written.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::AxisOrder;
use unitpack_fuzz::{Bytes, Subject, choose_elements, lie_in};
use unitpack_test::vectors::bits;
use unitpack_test::{Effort, Elements};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let codec = Subject::choose(&mut bytes);
    let format = codec.format;
    let size = format.code_size();
    let effort = if bytes.byte() % 8 == 0 { Effort::Precise } else { Effort::Fast };
    let vectors = choose_elements(&mut bytes, 12);
    let mut codes = choose_elements(&mut bytes, size);
    if bytes.byte() % 8 != 0 {
        codes.len = vectors.len;
    }
    let code_offset = usize::from(bytes.byte() % 32);
    let from = bytes.0;
    let vector = |bytes: &[u8]| {
        let floats: [[u8; 4]; 3] = std::array::from_fn(|i| bytes[4 * i..][..4].try_into().unwrap());
        floats.map(f32::from_ne_bytes)
    };
    let code_of = |v| codec.encode_with(effort, v).to_le_bytes();

    // The bytes to write to are others than those to read.
    let before: Vec<u8> = from.iter().map(|byte| !byte).collect();
    let mut to = before.clone();
    let result = match effort {
        Effort::Fast => format.encode_strided(vectors.read(from), codes.write(&mut to)),
        Effort::Precise => format.encode_strided_precise(vectors.read(from), codes.write(&mut to)),
    };
    let fits = vectors.len == codes.len
        && lie_in(vectors, 12, from.len())
        && lie_in(codes, size, before.len());
    assert_eq!(result.is_ok(), fits, "{format}: {vectors:?} {codes:?} {result:?}");
    let mut wanted = before.clone();
    if fits {
        for i in 0..codes.len {
            let code = code_of(vector(&from[vectors.element(i, 12)]));
            wanted[codes.element(i, size)].copy_from_slice(&code[..size]);
        }
    }
    assert_eq!(to, wanted, "{format}: {vectors:?} {codes:?}");

    let mut to = before.clone();
    let result = format.decode_strided(codes.read(from), vectors.write(&mut to));
    assert_eq!(result.is_ok(), fits, "{format}: {codes:?} {vectors:?} {result:?}");
    let integer =
        |bytes: &[u8]| bytes.iter().rev().fold(0, |code, byte| code << 8 | u128::from(*byte));
    let decode = |bytes: &[u8]| bits((codec.decode)(integer(bytes)));
    let mut wanted = before;
    if fits {
        for i in 0..codes.len {
            let v = decode(&from[codes.element(i, size)]).map(u32::to_ne_bytes);
            wanted[vectors.element(i, 12)].copy_from_slice(v.as_flattened());
        }
    }
    assert_eq!(to, wanted, "{format}: {codes:?} {vectors:?}");

    // A code for no vector, if there is one.
    if let Some(or_none) = format.or_none() {
        let none = format.none().expect("it has one");
        let order = AxisOrder::Xyz;
        let mut to = from.iter().map(|byte| !byte).collect::<Vec<u8>>();
        let mut wanted = to.clone();
        let result = match effort {
            Effort::Fast => order.encode_strided(or_none, vectors.read(from), codes.write(&mut to)),
            Effort::Precise => {
                order.encode_strided_precise(or_none, vectors.read(from), codes.write(&mut to))
            }
        };
        assert_eq!(result.is_ok(), fits, "{format}: {vectors:?} {codes:?} {result:?}");
        let mut decoded = to.clone();
        if fits {
            for i in 0..codes.len {
                let v = vector(&from[vectors.element(i, 12)]);
                let missing = v.iter().all(|&c| c == 0.0) || v.iter().any(|c| c.is_nan());
                let code = code_of(v);
                let code = if missing { none } else { &code[..size] };
                assert!(missing || code != none, "{format} {v:?}");
                wanted[codes.element(i, size)].copy_from_slice(code);
            }
        }
        assert_eq!(to, wanted, "{format}: {vectors:?} {codes:?}");
        let result = order.decode_strided(or_none, codes.read(from), vectors.write(&mut decoded));
        assert_eq!(result.is_ok(), fits, "{format}: {codes:?} {vectors:?} {result:?}");
        if fits {
            for i in 0..codes.len {
                let code = &from[codes.element(i, size)];
                let used = u128::MAX >> (128 - format.bits());
                let is_none = integer(code) & used == integer(none);
                let v = if is_none { [0; 3] } else { decode(code) };
                wanted[vectors.element(i, 12)]
                    .copy_from_slice(v.map(u32::to_ne_bytes).as_flattened());
            }
        }
        assert_eq!(decoded, wanted, "{format}: {codes:?} {vectors:?}");
    }

    // In place.
    let first = vectors.offset.min(code_offset);
    let span = vectors.offset.saturating_add(12).max(code_offset + size) - first;
    let fits = lie_in(Elements { offset: first, ..vectors }, span, from.len());
    let code = Elements { offset: code_offset, ..vectors };
    let mut within = from.to_vec();
    let result = match effort {
        Effort::Fast => format.encode_within(vectors.write(&mut within), code_offset),
        Effort::Precise => format.encode_within_precise(vectors.write(&mut within), code_offset),
    };
    assert_eq!(result.is_ok(), fits, "{format}: {vectors:?} {code_offset} {result:?}");
    let mut wanted = from.to_vec();
    if fits {
        for i in 0..vectors.len {
            let bytes = code_of(vector(&from[vectors.element(i, 12)]));
            wanted[code.element(i, size)].copy_from_slice(&bytes[..size]);
        }
    }
    assert_eq!(within, wanted, "{format}: {vectors:?} {code_offset}");
    let mut within = from.to_vec();
    let result = format.decode_within(code.write(&mut within), vectors.offset);
    assert_eq!(result.is_ok(), fits, "{format}: {code:?} {vectors:?} {result:?}");
    let mut wanted = from.to_vec();
    if fits {
        for i in 0..vectors.len {
            let v = decode(&from[code.element(i, size)]).map(u32::to_ne_bytes);
            wanted[vectors.element(i, 12)].copy_from_slice(v.as_flattened());
        }
    }
    assert_eq!(within, wanted, "{format}: {code:?} {vectors:?}");
});
