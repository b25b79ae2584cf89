//! Slices of formats, structures of arrays, arrays of structures and transcoding give the bits that
//! single vectors give.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack_fuzz::{Bytes, Subject};
use unitpack_test::codes::{decode_slice, encode_slice, to_bytes};
use unitpack_test::vectors::bits;
use unitpack_test::{Arrays, Code, Effort, Place, UNWRITTEN, Vector};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let codec = Subject::choose(&mut bytes);
    let count = codec.count(&mut bytes);
    let at = bytes.length(7);
    let transcode = codec.transcode(&mut bytes);
    let vectors = codec.vectors(&mut Bytes(bytes.0), count);
    let codes = codec.codes(&mut Bytes(bytes.0), count);
    encoders(codec, at, &vectors);
    decoders(codec, at, &codes);
    // A format of the same family and width has the functions of its type too.
    let typed = Subject::of(codec.typed().format);
    typed_encoders(typed, &typed.vectors(&mut Bytes(bytes.0), count));
    typed_decoders(typed, &typed.codes(&mut Bytes(bytes.0), count));

    let (a, b) = (Subject::of(transcode.from), Subject::of(transcode.to));
    let from = a.codes(&mut Bytes(bytes.0), count);
    let mut to = vec![0; count];
    (transcode.run)(&from, Place::from(&mut to[..])).unwrap();
    for (code, got) in from.into_iter().zip(to) {
        assert_eq!(got, (b.encode)((a.decode)(code)), "{} {code:x} to {}", a.format, b.format);
    }
});

fn encoders(codec: &Subject, at: usize, vectors: &[Vector]) {
    let format = codec.format;
    let arrays = Arrays::from(vectors);
    for effort in Effort::BOTH {
        // At any alignment.
        let expected = to_bytes(format, &codec.encode_each(effort, vectors));
        let mut bytes = vec![0xA5; at + expected.len()];
        encode_slice(format, effort, arrays.read(), &mut bytes[at..]).unwrap();
        assert_eq!(bytes[at..], expected, "{format} {effort:?}, bytes from {at}");
        assert_eq!(bytes[..at], vec![0xA5; at], "{format} {effort:?}, bytes from {at}");
    }
}

fn typed_encoders(codec: &Subject, vectors: &[Vector]) {
    let (format, typed) = (codec.format, codec.typed());
    let arrays = Arrays::from(vectors);
    for effort in Effort::BOTH {
        let expected = codec.encode_each(effort, vectors);
        let check = |what: &str, encode: &dyn Fn(Place<'_>)| {
            let mut codes = vec![!0; vectors.len()];
            encode(Place::from(&mut codes[..]));
            assert_eq!(codes, expected, "{format} {effort:?}, {what}");
        };
        check("arrays", &|to| (typed.encode_soa)(effort, arrays.read(), to).unwrap());
        for aos in &typed.aos {
            let structures: Vec<f32> = vectors
                .iter()
                .flat_map(|v| v.iter().copied().chain([UNWRITTEN; 8]).take(aos.floats))
                .collect();
            let what = format!("structures of {}", aos.floats);
            check(&what, &|to| (aos.encode)(effort, &structures, to).unwrap());
        }
    }
}

fn decoders(codec: &Subject, at: usize, codes: &[Code]) {
    let format = codec.format;
    let single = singles(codec, codes);
    let mut bytes = vec![0xA5; at];
    bytes.extend(to_bytes(format, codes));
    let mut soa = Arrays::unwritten([codes.len(); 3]);
    decode_slice(format, &bytes[at..], soa.write()).unwrap();
    assert!(soa.bits().eq(single), "{format}, bytes from {at}: {soa:?}");
}

fn singles(codec: &Subject, codes: &[Code]) -> Vec<[u32; 3]> {
    codes.iter().map(|&code| bits((codec.decode)(code))).collect()
}

fn typed_decoders(codec: &Subject, codes: &[Code]) {
    let (format, typed) = (codec.format, codec.typed());
    let single = singles(codec, codes);
    let mut soa = Arrays::unwritten([codes.len(); 3]);
    (typed.decode_soa)(codes, 0..codes.len(), soa.write()).unwrap();
    assert!(soa.bits().eq(single.iter().copied()), "{format}: {soa:?}");

    for aos in &typed.aos {
        let mut structures = vec![UNWRITTEN; aos.floats * codes.len()];
        (aos.decode)(codes, &mut structures).unwrap();
        for (structure, single) in structures.chunks(aos.floats).zip(&single) {
            let (v, others) = structure.split_at(3);
            assert_eq!(v.iter().map(|c| c.to_bits()).collect::<Vec<_>>(), single, "{format}");
            assert!(others.iter().all(|&c| c == UNWRITTEN), "{format} wrote {others:?}");
        }
    }
}
