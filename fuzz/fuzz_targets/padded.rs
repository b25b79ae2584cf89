//! Elements with a fourth component at any stride: those that fit are read and written alone, and give what single ones
//! do; others are refused, and nothing is written. A handedness is never lost.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unitpack::padded::{Padded, PaddedCodec, W};
use unitpack::{
    Float16x3, Snorm8x3, Snorm10x3, Snorm12x3, Snorm16x3, XyzUnorm8x3, XyzUnorm10x3, XyzUnorm16x3,
};
use unitpack_fuzz::{Bytes, choose_elements, lie_in};

fn floats<const N: usize>(bytes: &[u8]) -> [f32; N] {
    std::array::from_fn(|i| f32::from_ne_bytes(bytes[4 * i..][..4].try_into().unwrap()))
}

/// An element with the w of another one.
fn with_w_of<C: PaddedCodec>(element: &[u8], from: &[u8]) -> Vec<u8> {
    let [zero, one] = [W::Zero, W::One].map(|w| Padded::<C>::encode([0.0, 0.0, 1.0], w));
    let (zero, one) = (bytemuck::bytes_of(&zero), bytemuck::bytes_of(&one));
    let mask = match element.len() {
        4 if Padded::<C>::W_BITS == 2 => (3u32 << 30).to_ne_bytes().to_vec(),
        4 => vec![0, 0, 0, 0xFF],
        _ => vec![0, 0, 0, 0, 0, 0, 0xFF, 0xFF],
    };
    assert!((0..mask.len()).all(|i| (zero[i] ^ one[i]) & !mask[i] == 0));
    (0..mask.len()).map(|i| element[i] & !mask[i] | from[i] & mask[i]).collect()
}

fn check<C: PaddedCodec>(mut bytes: Bytes<'_>) {
    type P<C> = Padded<C>;
    let size = size_of::<C::Element>();
    let precise = bytes.byte().is_multiple_of(8);
    let w = *bytes.choose(&[W::Keep, W::Zero, W::One]);
    let tangents = bytes.byte().is_multiple_of(2);
    let vector_size = if tangents { 16 } else { 12 };
    let vectors = choose_elements(&mut bytes, vector_size);
    let mut elements = choose_elements(&mut bytes, size);
    if !bytes.byte().is_multiple_of(8) {
        elements.len = vectors.len;
    }
    let from = bytes.0;
    let fits = vectors.len == elements.len
        && lie_in(vectors, vector_size, from.len())
        && lie_in(elements, size, from.len());

    // The bytes to write to are others than those to read.
    let before: Vec<u8> = from.iter().map(|byte| !byte).collect();
    let mut to = before.clone();
    let (read, write) = (vectors.read(from), elements.write(&mut to));
    let result = match (tangents, precise) {
        (false, false) => P::<C>::encode_strided(read, w, write),
        (false, true) => P::<C>::encode_strided_precise(read, w, write),
        (true, false) => P::<C>::encode_tangents_strided(read, write),
        (true, true) => P::<C>::encode_tangents_strided_precise(read, write),
    };
    assert_eq!(result.is_ok(), fits, "{vectors:?} {elements:?} {result:?}");
    let mut wanted = before.clone();
    for i in 0..if fits { elements.len } else { 0 } {
        let (vector, at) = (&from[vectors.element(i, vector_size)], elements.element(i, size));
        let element = if tangents {
            let tangent = floats(vector);
            let element = match precise {
                false => P::<C>::encode_tangent(tangent),
                true => P::<C>::encode_tangent_precise(tangent),
            };
            let handedness = if tangent[3] < 0.0 { -1.0 } else { 1.0 };
            assert_eq!(P::<C>::decode_tangent(element)[3], handedness, "{tangent:?}");
            element
        } else if precise {
            P::<C>::encode_precise(floats(vector), w)
        } else {
            P::<C>::encode(floats(vector), w)
        };
        let mut element = bytemuck::bytes_of(&element).to_vec();
        if !tangents && w == W::Keep {
            element = with_w_of::<C>(&element, &before[at.clone()]);
        }
        wanted[at].copy_from_slice(&element);
    }
    assert_eq!(to, wanted, "{vectors:?} {elements:?}");

    let mut to = before.clone();
    let (read, write) = (elements.read(from), vectors.write(&mut to));
    let result = match tangents {
        false => P::<C>::decode_strided(read, write),
        true => P::<C>::decode_tangents_strided(read, write),
    };
    assert_eq!(result.is_ok(), fits, "{elements:?} {vectors:?} {result:?}");
    let mut wanted = before;
    for i in 0..if fits { elements.len } else { 0 } {
        let element: C::Element = bytemuck::pod_read_unaligned(&from[elements.element(i, size)]);
        let [x, y, z, handedness] = P::<C>::decode_tangent(element);
        assert_eq!(P::<C>::decode(element), [x, y, z]);
        assert!(handedness.abs() == 1.0);
        let v = bytemuck::cast::<[f32; 4], [u8; 16]>([x, y, z, handedness]);
        wanted[vectors.element(i, vector_size)].copy_from_slice(&v[..vector_size]);
    }
    assert_eq!(to, wanted, "{elements:?} {vectors:?}");
}

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    match bytes.byte() % 8 {
        0 => check::<Snorm8x3>(bytes),
        1 => check::<Snorm10x3>(bytes),
        2 => check::<Snorm12x3>(bytes),
        3 => check::<Snorm16x3>(bytes),
        4 => check::<Float16x3>(bytes),
        5 => check::<XyzUnorm8x3>(bytes),
        6 => check::<XyzUnorm10x3>(bytes),
        _ => check::<XyzUnorm16x3>(bytes),
    }
});
