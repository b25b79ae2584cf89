//! Structures of arrays, arrays of structures, bytes and transcoding give the bits that single
//! vectors give.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::Format;
use unitpack_fuzz::{AnyCodec, Arrays, Bytes, Code, UNWRITTEN, Vector, all_bits, bits};

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let codec = AnyCodec::choose(&mut bytes);
    let count = codec.count(&mut bytes);
    let at = bytes.length(7);
    let transcode = bytes.choose(&codec.transcode);
    encoders(codec, at, &codec.vectors(&mut Bytes(bytes.0), count));
    decoders(codec, at, &codec.codes(&mut Bytes(bytes.0), count));

    let (a, b) = (AnyCodec::of(transcode.from), AnyCodec::of(transcode.to));
    let from = a.codes(&mut Bytes(bytes.0), count);
    let mut to = vec![0; count];
    (transcode.run)(&from, &mut to).unwrap();
    for (code, got) in from.into_iter().zip(to) {
        assert_eq!(got, (b.encode)((a.decode)(code)), "{} {code:x} to {}", a.format, b.format);
    }
});

fn encoders(codec: &AnyCodec, at: usize, vectors: &[Vector]) {
    let format = codec.format;
    let arrays = Arrays::from(vectors);
    let fast: Vec<Code> = vectors.iter().map(|&v| (codec.encode)(v)).collect();
    let precise: Vec<Code> = vectors.iter().map(|&v| (codec.encode_precise)(v)).collect();
    let run = |encode: &dyn Fn(&mut [Code])| {
        let mut codes = vec![!0; vectors.len()];
        encode(&mut codes);
        codes
    };
    let soa = run(&|codes| (codec.encode_soa)(arrays.read(), codes).unwrap());
    assert_eq!(soa, fast, "{format}");
    let soa = run(&|codes| (codec.encode_soa_precise)(arrays.read(), codes).unwrap());
    assert_eq!(soa, precise, "{format}, precise");
    for aos in &codec.aos {
        let structures: Vec<f32> = vectors
            .iter()
            .flat_map(|v| v.iter().copied().chain([UNWRITTEN; 8]).take(aos.floats))
            .collect();
        let codes = run(&|codes| (aos.encode)(&structures, codes).unwrap());
        assert_eq!(codes, fast, "{format}, structures of {}", aos.floats);
        let codes = run(&|codes| (aos.encode_precise)(&structures, codes).unwrap());
        assert_eq!(codes, precise, "{format}, precise, structures of {}", aos.floats);
    }

    let size = format.code_size();
    for (encode, codes) in
        [(Format::encode as fn(_, _, &mut [u8]) -> _, fast), (Format::encode_precise, precise)]
    {
        // At any alignment.
        let mut bytes = vec![0xA5; at + vectors.len() * size];
        encode(format, arrays.read(), &mut bytes[at..]).unwrap();
        let expected: Vec<u8> =
            codes.iter().flat_map(|c| c.to_le_bytes()[..size].to_vec()).collect();
        assert_eq!(bytes[at..], expected, "{format}, bytes from {at}");
        assert_eq!(bytes[..at], vec![0xA5; at], "{format}, bytes from {at}");
    }
}

fn decoders(codec: &AnyCodec, at: usize, codes: &[Code]) {
    let format = codec.format;
    let single: Vec<_> = codes.iter().map(|&code| bits((codec.decode)(code))).collect();
    let mut soa = Arrays::unwritten([codes.len(); 3]);
    (codec.decode_soa)(codes, soa.write()).unwrap();
    assert_eq!(all_bits(&soa.vectors()), single, "{format}");

    for aos in &codec.aos {
        let mut structures = vec![UNWRITTEN; aos.floats * codes.len()];
        (aos.decode)(codes, &mut structures).unwrap();
        for (structure, single) in structures.chunks(aos.floats).zip(&single) {
            let (v, others) = structure.split_at(3);
            assert_eq!(v.iter().map(|c| c.to_bits()).collect::<Vec<_>>(), single, "{format}");
            assert!(others.iter().all(|&c| c == UNWRITTEN), "{format} wrote {others:?}");
        }
    }

    let size = format.code_size();
    let mut bytes = vec![0xA5; at];
    bytes.extend(codes.iter().flat_map(|c| c.to_le_bytes()[..size].to_vec()));
    let mut soa = Arrays::unwritten([codes.len(); 3]);
    format.decode(&bytes[at..], soa.write()).unwrap();
    assert_eq!(all_bits(&soa.vectors()), single, "{format}, bytes from {at}");
}
