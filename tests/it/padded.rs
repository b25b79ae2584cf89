//! Elements with a fourth component. What their bits mean is read here by the words of glTF, WebGPU and Vulkan, without
//! the crate's code.

use bytemuck::{Zeroable, bytes_of};
use unitpack::padded::*;
use unitpack::{
    Float16x3, LengthMismatch, Snorm8x3, Snorm10x3, Snorm12x3, Snorm16x3, Soa, SoaMut,
    StrideMismatch, Strided, StridedMut, XyzUnorm8x3, XyzUnorm10x3, XyzUnorm16x3,
};
use unitpack_test::Elements as Place;
use unitpack_test::random::{Rng, mixed_vectors};

/// Around the sizes of blocks and parts.
const LENGTHS: [usize; 11] = [0, 1, 2, 7, 9, 63, 65, 255, 256, 257, 520];

/// All there are, and what they mean.
const HANDEDNESS: [(f32, f32); 14] = [
    (1.0, 1.0),
    (-1.0, -1.0),
    (0.0, 1.0),
    (-0.0, 1.0),
    (f32::NAN, 1.0),
    (-f32::NAN, 1.0),
    (f32::INFINITY, 1.0),
    (f32::NEG_INFINITY, -1.0),
    (0.25, 1.0),
    (-0.25, -1.0),
    (f32::from_bits(1), 1.0),
    (f32::from_bits(0x8000_0001), -1.0),
    (3e38, 1.0),
    (-3e38, -1.0),
];

/// How the numbers of a vertex format are read.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Number {
    Snorm,
    Unorm,
    Half,
}

/// A vertex format of four components.
#[derive(Clone, Copy, Debug)]
struct Spec {
    number: Number,
    /// Bits of x, y and z, and of w.
    bits: [u32; 2],
    /// Of x, y and z, from 0 to 1; 0 for halves.
    steps: f64,
    /// Bits of w for 1 and for -1.
    one: u16,
    minus_one: u16,
}

const SNORM8: Spec =
    Spec { number: Number::Snorm, bits: [8, 8], steps: 127.0, one: 0x7F, minus_one: 0x81 };
const SNORM12: Spec =
    Spec { number: Number::Snorm, bits: [16, 16], steps: 2047.0, one: 0x7FFF, minus_one: 0x8001 };
const SNORM16: Spec = Spec { steps: 32767.0, ..SNORM12 };
const HALF: Spec =
    Spec { number: Number::Half, bits: [16, 16], steps: 0.0, one: 0x3C00, minus_one: 0xBC00 };
const UNORM8: Spec =
    Spec { number: Number::Unorm, bits: [8, 8], steps: 127.5, one: 0xFF, minus_one: 0 };
const UNORM16: Spec =
    Spec { number: Number::Unorm, bits: [16, 16], steps: 32767.5, one: 0xFFFF, minus_one: 0 };
const UNORM10: Spec =
    Spec { number: Number::Unorm, bits: [10, 2], steps: 511.5, one: 3, minus_one: 0 };
const SNORM10: Spec =
    Spec { number: Number::Snorm, bits: [10, 2], steps: 511.0, one: 1, minus_one: 3 };

impl Spec {
    fn size(self) -> usize {
        (3 * self.bits[0] + self.bits[1]) as usize / 8
    }

    /// The bits of the fields.
    fn fields(self, element: &[u8]) -> [u16; 4] {
        match *element {
            [a, b, c, d] if self.bits[0] == 10 => {
                let word = u32::from_ne_bytes([a, b, c, d]);
                [word & 1023, word >> 10 & 1023, word >> 20 & 1023, word >> 30].map(|f| f as u16)
            }
            [x, y, z, w] => [x, y, z, w].map(u16::from),
            [a, b, c, d, e, f, g, h] => [[a, b], [c, d], [e, f], [g, h]].map(u16::from_ne_bytes),
            _ => panic!("{element:?}"),
        }
    }

    fn set_w(self, element: &mut [u8], w: u16) {
        match element {
            [_, _, _, _] if self.bits[1] == 2 => {
                let word = u32::from_ne_bytes(element.try_into().unwrap());
                let word = word & 0x3FFF_FFFF | u32::from(w) << 30;
                element.copy_from_slice(&word.to_ne_bytes());
            }
            [_, _, _, to] => *to = w as u8,
            _ => element[6..].copy_from_slice(&w.to_ne_bytes()),
        }
    }

    /// The number of a field, as a GPU reads it.
    fn value(self, field: u16, bits: u32) -> f64 {
        match self.number {
            Number::Half => half::f16::from_bits(field).to_f64(),
            Number::Unorm => f64::from(field) / f64::from((1u32 << bits) - 1),
            Number::Snorm => {
                let max = f64::from((1 << (bits - 1)) - 1);
                let signed = i32::from(field) << (32 - bits) >> (32 - bits);
                (f64::from(signed) / max).max(-1.0)
            }
        }
    }

    /// The numbers of x, y and z, from -1 to 1 as unorm too.
    fn components(self, element: &[u8]) -> [f64; 3] {
        let [x, y, z, _] = self.fields(element).map(|field| self.value(field, self.bits[0]));
        let bias = |c| if self.number == Number::Unorm { 2.0 * c - 1.0 } else { c };
        [x, y, z].map(bias)
    }

    fn handedness(self, element: &[u8]) -> f32 {
        let w = self.value(self.fields(element)[3], self.bits[1]);
        let is_minus = if self.number == Number::Unorm { w < 0.5 } else { w < 0.0 };
        if is_minus { -1.0 } else { 1.0 }
    }
}

fn normalize(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}

/// Calls a generic function for every element.
macro_rules! each_format {
    ($check:ident) => {
        $check::<Snorm8x3>(SNORM8);
        $check::<Snorm12x3>(SNORM12);
        $check::<Snorm16x3>(SNORM16);
        $check::<Float16x3>(HALF);
        $check::<XyzUnorm8x3>(UNORM8);
        $check::<XyzUnorm16x3>(UNORM16);
        $check::<XyzUnorm10x3>(UNORM10);
        $check::<Snorm10x3>(SNORM10);
    };
}

/// Bytes that are no element's, so that each of them has its own.
fn noise(rng: &mut Rng, place: Place, size: usize) -> Vec<u8> {
    let mut bytes = place.bytes(size);
    bytes.extend([0; 5]);
    bytes.iter_mut().for_each(|byte| *byte = rng.bits() as u8);
    bytes
}

/// Random elements, of which some have every w.
fn any_elements<C: PaddedCodec>(rng: &mut Rng, len: usize) -> Vec<C::Element> {
    let mut elements = vec![C::Element::zeroed(); len];
    bytemuck::cast_slice_mut(&mut elements).iter_mut().for_each(|b: &mut u8| *b = rng.bits() as u8);
    elements
}

/// For so many vectors the nearest codes take longer than everything else here.
fn too_slow<C: PaddedCodec>() -> usize {
    if C::FORMAT.code_size() == 6 { 2 } else { 70 }
}

fn columns(vectors: &[[f32; 3]]) -> [Vec<f32>; 3] {
    std::array::from_fn(|i| vectors.iter().map(|v| v[i]).collect())
}

#[test]
fn elements_have_the_size_of_their_fields() {
    fn check<C: PaddedCodec>(spec: Spec) {
        assert_eq!(size_of::<C::Element>(), spec.size());
        assert_eq!(Padded::<C>::W_BITS, spec.bits[1]);
        let values = [Padded::<C>::W_ONE, Padded::<C>::W_MINUS_ONE];
        assert_eq!(values, [spec.one, spec.minus_one]);
    }
    each_format!(check);
}

#[test]
fn every_w_and_every_entry_point_of_normals_gives_what_single_vectors_do() {
    fn check<C: PaddedCodec>(spec: Spec) {
        let mut rng = Rng::new(1);
        let size = spec.size();
        for (len, w) in
            LENGTHS.into_iter().flat_map(|len| [W::Keep, W::Zero, W::One].map(|w| (len, w)))
        {
            for precise in [false, true] {
                if precise && len > too_slow::<C>() {
                    continue;
                }
                let vectors = &mixed_vectors(len as u64, 520)[..len];
                let from = Place::random(&mut rng, 12, len);
                let to = Place::random(&mut rng, size, len);
                let before = noise(&mut rng, to, size);
                let mut wanted = before.clone();
                for (i, &v) in vectors.iter().enumerate() {
                    let (code, element) = if precise {
                        (C::encode_precise(v), Padded::<C>::encode_precise(v, w))
                    } else {
                        (C::encode(v), Padded::<C>::encode(v, w))
                    };
                    // A single element has nothing to keep.
                    let element = bytes_of(&element);
                    let mut joined = vec![0; size];
                    joined[..size_of::<C::Code>()].copy_from_slice(bytes_of(&code));
                    spec.set_w(&mut joined, if w == W::One { spec.one } else { 0 });
                    assert_eq!(element, joined, "{} {w:?}", C::FORMAT);
                    let at = &mut wanted[to.element(i, size)];
                    let kept = spec.fields(at)[3];
                    at.copy_from_slice(element);
                    if w == W::Keep {
                        spec.set_w(at, kept);
                    }
                }
                let mut out = before.clone();
                let bytes = from.holding(vectors);
                let (read, write) = (from.read(&bytes), to.write(&mut out));
                if precise {
                    Padded::<C>::encode_strided_precise(read, w, write).unwrap();
                } else {
                    Padded::<C>::encode_strided(read, w, write).unwrap();
                }
                assert!(out == wanted, "{} {w:?}: {from:?} to {to:?}", C::FORMAT);

                let mut elements = any_elements::<C>(&mut rng, len);
                for (i, element) in elements.iter_mut().enumerate() {
                    let bytes = bytemuck::bytes_of_mut(element);
                    bytes.copy_from_slice(&before[to.element(i, size)]);
                }
                let [x, y, z] = columns(vectors);
                let soa = Soa { x: &x, y: &y, z: &z };
                if precise {
                    Padded::<C>::encode_soa_precise(soa, w, &mut elements).unwrap();
                } else {
                    Padded::<C>::encode_soa(soa, w, &mut elements).unwrap();
                }
                for (i, element) in elements.iter().enumerate() {
                    assert_eq!(bytes_of(element), &wanted[to.element(i, size)], "{}", C::FORMAT);
                }
            }
        }
    }
    each_format!(check);
}

#[test]
fn every_entry_point_of_tangents_gives_what_single_ones_do() {
    fn check<C: PaddedCodec>(spec: Spec) {
        let mut rng = Rng::new(2);
        let size = spec.size();
        for len in LENGTHS {
            for precise in [false, true] {
                if precise && len > too_slow::<C>() {
                    continue;
                }
                let vectors = &mixed_vectors(len as u64, 520)[..len];
                let hands = (0..len).map(|_| rng.pick(&HANDEDNESS));
                let hands: Vec<(f32, f32)> = hands.collect();
                let tangents: Vec<[f32; 4]> =
                    vectors.iter().zip(&hands).map(|(&[x, y, z], &(w, _))| [x, y, z, w]).collect();
                let from = Place::random(&mut rng, 16, len);
                let to = Place::random(&mut rng, size, len);
                let before = noise(&mut rng, to, size);
                let mut wanted = before.clone();
                let mut singles = Vec::new();
                for (i, &tangent) in tangents.iter().enumerate() {
                    let [x, y, z, _] = tangent;
                    let (code, element) = if precise {
                        (C::encode_precise([x, y, z]), Padded::<C>::encode_tangent_precise(tangent))
                    } else {
                        (C::encode([x, y, z]), Padded::<C>::encode_tangent(tangent))
                    };
                    let mut joined = vec![0; size];
                    joined[..size_of::<C::Code>()].copy_from_slice(bytes_of(&code));
                    let w = if hands[i].1 < 0.0 { spec.minus_one } else { spec.one };
                    spec.set_w(&mut joined, w);
                    assert_eq!(bytes_of(&element), joined, "{} {tangent:?}", C::FORMAT);
                    // It is never lost.
                    assert_eq!(Padded::<C>::decode_tangent(element)[3], hands[i].1);
                    wanted[to.element(i, size)].copy_from_slice(&joined);
                    singles.push(element);
                }
                let mut out = before;
                let bytes = from.holding(&tangents);
                let (read, write) = (from.read(&bytes), to.write(&mut out));
                let mut elements = any_elements::<C>(&mut rng, len);
                if precise {
                    Padded::<C>::encode_tangents_strided_precise(read, write).unwrap();
                    Padded::<C>::encode_tangents_aos_precise(&tangents, &mut elements).unwrap();
                } else {
                    Padded::<C>::encode_tangents_strided(read, write).unwrap();
                    Padded::<C>::encode_tangents_aos(&tangents, &mut elements).unwrap();
                }
                assert!(out == wanted, "{}: {from:?} to {to:?}", C::FORMAT);
                assert_eq!(elements, singles, "{}", C::FORMAT);
            }
        }
    }
    each_format!(check);
}

#[test]
fn any_element_decodes_alike_everywhere_and_to_what_its_fields_mean() {
    fn check<C: PaddedCodec>(spec: Spec) {
        let mut rng = Rng::new(3);
        let size = spec.size();
        for len in LENGTHS {
            let elements = any_elements::<C>(&mut rng, len);
            let vectors: Vec<[f32; 3]> = elements.iter().map(|&e| Padded::<C>::decode(e)).collect();
            let tangents: Vec<[f32; 4]> =
                elements.iter().map(|&e| Padded::<C>::decode_tangent(e)).collect();
            for ((element, v), t) in elements.iter().zip(&vectors).zip(&tangents) {
                let element = bytes_of(element);
                assert_eq!((t[..3].to_vec(), t[3]), (v.to_vec(), spec.handedness(element)));
                let fields = spec.components(element);
                // Halves that are no numbers read as the greatest, 12 bits of 16 count, and zero is +Z.
                let is_plain = spec.steps != 2047.0 && fields.iter().all(|c| c.is_finite());
                if is_plain && fields != [0.0; 3] {
                    let exact = normalize(fields);
                    let off = (0..3).map(|i| (exact[i] - f64::from(v[i])).abs());
                    assert!(off.fold(0.0, f64::max) < 5e-7, "{} {element:?}", C::FORMAT);
                }
            }
            let from = Place::random(&mut rng, size, len);
            let bytes = from.holding(&elements);
            for k in [3, 4] {
                let to = Place::random(&mut rng, 4 * k, len);
                let mut wanted = noise(&mut rng, to, 4 * k);
                let mut out = wanted.clone();
                for (i, tangent) in tangents.iter().enumerate() {
                    wanted[to.element(i, 4 * k)].copy_from_slice(&bytes_of(tangent)[..4 * k]);
                }
                let (read, write) = (from.read(&bytes), to.write(&mut out));
                if k == 3 {
                    Padded::<C>::decode_strided(read, write).unwrap();
                } else {
                    Padded::<C>::decode_tangents_strided(read, write).unwrap();
                }
                assert!(out == wanted, "{}: {from:?} to {to:?}", C::FORMAT);
            }
            let mut aos = vec![[9.0; 4]; len];
            Padded::<C>::decode_tangents_aos(&elements, &mut aos).unwrap();
            assert_eq!(aos, tangents);
            let [mut x, mut y, mut z] = [(); 3].map(|()| vec![9.0; len]);
            let soa = SoaMut { x: &mut x, y: &mut y, z: &mut z };
            Padded::<C>::decode_soa(&elements, soa).unwrap();
            assert_eq!([x, y, z], columns(&vectors));
        }
    }
    each_format!(check);
}

/// What a GPU reads is off by half a step of the unit vector at most.
#[test]
fn fields_are_the_rounded_components() {
    fn check<C: PaddedCodec>(spec: Spec) {
        let mut rng = Rng::new(4);
        for _ in 0..3000 {
            let v = rng.direction();
            let element = Padded::<C>::encode(v, W::One);
            let element = bytes_of(&element);
            // 12 bits are a sixteenth as long in 16.
            let longer = if spec.steps == 2047.0 { 32767.0 / 2047.0 } else { 1.0 };
            let read = spec.components(element).map(|c| c * longer);
            let unit = normalize(v.map(f64::from));
            for (read, unit) in read.into_iter().zip(unit) {
                let half_step = match spec.number {
                    Number::Half => unit.abs().max(6.2e-5) / 2048.0,
                    _ => 0.5 / spec.steps,
                };
                let off = (read - unit).abs();
                assert!(off <= half_step + 3e-7, "{} {v:?}: {read} for {unit}", C::FORMAT);
            }
            assert_eq!(spec.value(spec.fields(element)[3], spec.bits[1]), 1.0);
        }
    }
    each_format!(check);
}

/// From what glTF, DirectX and Vulkan say of the formats, and what other encoders write.
#[test]
fn bytes_are_those_of_other_encoders() {
    let v = [0.36, 0.48, 0.8];
    let w = [-0.48, 0.6, -0.64];
    let tangent = |[x, y, z]: [f32; 3], handedness| [x, y, z, handedness];
    // 127 c = (45.72, 60.96, 101.6) and (-60.96, 76.2, -81.28).
    assert_eq!(Snorm8x4::encode(v, W::Zero), [0x2E, 0x3D, 0x66, 0]);
    assert_eq!(Snorm8x4::encode(w, W::One), [0xC3, 0x4C, 0xAF, 0x7F]);
    assert_eq!(Snorm8x4::encode_tangent(tangent(v, -1.0)), [0x2E, 0x3D, 0x66, 0x81]);
    assert_eq!(Snorm8x4::encode_tangent(tangent(w, -1.0)), [0xC3, 0x4C, 0xAF, 0x81]);
    // 32767 c = (11796.1, 15728.2, 26213.6) and (-15728.2, 19660.2, -20970.9).
    assert_eq!(Snorm16x4::encode(v, W::Zero), [0x2E14, 0x3D70, 0x6666, 0]);
    assert_eq!(Snorm16x4::encode_tangent(tangent(w, 1.0)), [0xC290, 0x4CCC, 0xAE15, 0x7FFF]);
    assert_eq!(Snorm16x4::encode_tangent(tangent(v, -1.0)), [0x2E14, 0x3D70, 0x6666, 0x8001]);
    // 1.44 / 4, 1.92 / 4 and 1.6 / 2.
    assert_eq!(Float16x4::encode(v, W::One), [0x35C3, 0x37AE, 0x3A66, 0x3C00]);
    assert_eq!(Float16x4::encode_tangent(tangent(v, -1.0)), [0x35C3, 0x37AE, 0x3A66, 0xBC00]);
    // 127.5 (1 + c) = (173.4, 188.7, 229.5); 32767.5 (1 + c) = (44563.8, 48495.9, 58981.5).
    assert_eq!(Unorm8x4::encode([1.0, 0.6, 0.8].map(|c| c * 3.0), W::One)[3], 255);
    assert_eq!(Unorm8x4::encode(w, W::Zero), [66, 204, 46, 0]);
    assert_eq!(Unorm16x4::encode(w, W::One), [17_039, 52_428, 11_796, 65_535]);
    assert_eq!(Unorm8x4::encode_tangent(tangent(w, -1.0)), [66, 204, 46, 0]);
    assert_eq!(Unorm8x4::encode_tangent(tangent(w, 1.0)), [66, 204, 46, 255]);
    // DXGI's 10-10-10-2, as bytes of a little-endian word.
    let bytes = u32::to_le_bytes;
    for (v, snorm_minus, unorm_plus) in [
        ([0.0, 0.0, 1.0], [0x00, 0x00, 0xF0, 0xDF], [0x00, 0x02, 0xF8, 0xFF]),
        ([0.0, 0.0, -1.0], [0x00, 0x00, 0x10, 0xE0], [0x00, 0x02, 0x08, 0xC0]),
        ([1.0, 0.0, 0.0], [0xFF, 0x01, 0x00, 0xC0], [0xFF, 0x03, 0x08, 0xE0]),
        ([-1.0, 0.0, 0.0], [0x01, 0x02, 0x00, 0xC0], [0x00, 0x00, 0x08, 0xE0]),
        ([0.0, 1.0, 0.0], [0x00, 0xFC, 0x07, 0xC0], [0x00, 0xFE, 0x0F, 0xE0]),
        ([0.0, -1.0, 0.0], [0x00, 0x04, 0x08, 0xC0], [0x00, 0x02, 0x00, 0xE0]),
        (v, [0xB8, 0xD4, 0x93, 0xD9], [0xB8, 0xD6, 0x9B, 0xF9]),
        (w, [0x0B, 0xCF, 0x94, 0xEB], [0x0A, 0xC9, 0x8C, 0xCB]),
    ] {
        assert_eq!(bytes(Snorm10_10_10_2::encode_tangent(tangent(v, -1.0))), snorm_minus);
        assert_eq!(bytes(Unorm10_10_10_2::encode_tangent(tangent(v, 1.0))), unorm_plus);
        assert_eq!(bytes(Unorm10_10_10_2::encode(v, W::One)), unorm_plus);
    }
    assert_eq!(Snorm10_10_10_2::encode_tangent([0.0, 0.0, 1.0, 1.0]) >> 30, 1);
    assert_eq!(Unorm10_10_10_2::encode_tangent([0.0, 0.0, 1.0, -1.0]) >> 30, 0);
}

/// gltfpack: `int(v * 2047 + 0.5)` in a short, and a glTF reader that divides it by 32767.
#[test]
fn twelve_bits_are_what_gltfpack_writes() {
    let [v, w] = [[0.36f32, 0.48, 0.8], [-0.48, 0.6, -0.64]];
    let gltfpack = |c: f32| (c * 2047.0 + if c >= 0.0 { 0.5 } else { -0.5 }) as i16 as u16;
    for v in [v, w, [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]] {
        let [x, y, z] = v.map(gltfpack);
        assert_eq!(Snorm12x4::encode(v, W::Zero), [x, y, z, 0]);
        // As the reader has it, but for the length.
        let decoded = Snorm12x4::decode([x, y, z, 0]);
        let reader = [x, y, z].map(|c| f64::from(c as i16) / 32767.0);
        assert!((0..3).all(|i| (normalize(reader)[i] - f64::from(decoded[i])).abs() < 2e-7));
        let as_16_bits = Snorm16x4::decode([x, y, z, 0]);
        assert!((0..3).all(|i| (as_16_bits[i] - decoded[i]).abs() < 2e-7));
    }
    assert_eq!(Snorm12x4::encode(w, W::One), [0xFC29, 1228, 0xFAE2, 0x7FFF]);
    assert_eq!(Snorm12x4::encode_tangent([0.0, 0.0, 1.0, -1.0]), [0, 0, 2047, 0x8001]);
}

#[test]
fn every_w_has_a_handedness() {
    let hand = |words: &[u16], decode: fn(u16) -> [f32; 4]| -> Vec<f32> {
        words.iter().map(|&w| decode(w)[3]).collect()
    };
    let bytes = [0, 1, 126, 127, 128, 129, 254, 255];
    assert_eq!(
        hand(&bytes, |w| Snorm8x4::decode_tangent([0, 0, 127, w as u8])),
        [1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0]
    );
    assert_eq!(
        hand(&bytes, |w| Unorm8x4::decode_tangent([0, 0, 255, w as u8])),
        [-1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0]
    );
    let words = [0, 1, 0x7FFF, 0x8000, 0x8001, 0xFFFF];
    assert_eq!(
        hand(&words, |w| Snorm16x4::decode_tangent([0, 0, 1, w])),
        [1.0, 1.0, 1.0, -1.0, -1.0, -1.0]
    );
    assert_eq!(
        hand(&words, |w| Unorm16x4::decode_tangent([0, 0, 1, w])),
        [-1.0, -1.0, -1.0, 1.0, 1.0, 1.0]
    );
    // 0, 1, infinity, NaN, -0, the least below, -1, -infinity, -NaN.
    let halves = [0, 0x3C00, 0x7C00, 0x7E00, 0x8000, 0x8001, 0xBC00, 0xFC00, 0xFC01, 0xFFFF];
    assert_eq!(
        hand(&halves, |w| Float16x4::decode_tangent([0, 0, 0x3C00, w])),
        [1.0, 1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, 1.0, 1.0]
    );
    let tags = [0, 1, 2, 3];
    assert_eq!(
        hand(&tags, |w| Snorm10_10_10_2::decode_tangent(1 | u32::from(w) << 30)),
        [1.0, 1.0, -1.0, -1.0]
    );
    assert_eq!(
        hand(&tags, |w| Unorm10_10_10_2::decode_tangent(1 | u32::from(w) << 30)),
        [-1.0, -1.0, 1.0, 1.0]
    );
}

/// Position, normal and tangent of floats into the buffer of a glTF file, and from there into a vertex of a GPU.
#[test]
fn interleaved_vertices_of_gltf_are_packed_and_unpacked() {
    let source: Vec<[f32; 10]> = (0..500)
        .map(|i| {
            let (sin, cos) = (0.1 * i as f32).sin_cos();
            let handedness = if i % 3 == 0 { -1.0 } else { 1.0 };
            [i as f32, 0.0, 1.0, sin, cos, 0.0, cos, -sin, 0.0, handedness]
        })
        .collect();
    // Position, then BYTE normal, then BYTE tangent.
    let stride = 20;
    let mut gltf = vec![0xAA; stride * source.len()];
    let len = source.len();
    let normals = StridedMut { bytes: &mut gltf, offset: 12, stride, len };
    Snorm8x4::encode_strided(Strided::of(&source, 12), W::Zero, normals).unwrap();
    let tangents = StridedMut { bytes: &mut gltf, offset: 16, stride, len };
    Snorm8x4::encode_tangents_strided(Strided::of(&source, 24), tangents).unwrap();
    for (v, row) in source.iter().zip(gltf.chunks(stride)) {
        assert_eq!(row[..12], [0xAA; 12]);
        assert_eq!((row[15], row[19]), (0, if v[9] < 0.0 { 0x81 } else { 0x7F }));
        for (i, c) in [3, 4, 5, 6, 7, 8].into_iter().zip([12, 13, 14, 16, 17, 18]) {
            assert!((f32::from(row[c] as i8) / 127.0 - v[i]).abs() <= 0.501 / 127.0);
        }
    }
    let mut back = source.clone();
    let tangents = Strided { bytes: &gltf, offset: 16, stride, len };
    Snorm8x4::decode_tangents_strided(tangents, StridedMut::of(&mut back, 24)).unwrap();
    for (v, w) in source.iter().zip(&back) {
        assert_eq!((&v[..6], v[9]), (&w[..6], w[9]));
        assert!((6..9).all(|i| (v[i] - w[i]).abs() < 0.01));
    }
    // WebGPU has unorm 10-10-10-2 alone. w holds a material of two bits, which the encoder leaves.
    let mut gpu: Vec<[u32; 2]> = (0..len as u32).map(|i| [i << 30, 7]).collect();
    let normals = StridedMut::of(&mut gpu, 0);
    Unorm10_10_10_2::encode_strided_precise(Strided::of(&source, 12), W::Keep, normals).unwrap();
    for (i, ([word, after], v)) in gpu.into_iter().zip(&source).enumerate() {
        assert_eq!((word >> 30, after), (i as u32 & 3, 7));
        let decoded = Unorm10_10_10_2::decode(word);
        assert!((0..3).all(|c| (decoded[c] - v[3 + c]).abs() < 0.0015));
    }
}

type Decode = fn(Strided<'_>, StridedMut<'_>) -> Result<(), StrideMismatch>;

#[test]
fn what_does_not_fit_is_refused_with_its_numbers() {
    fn check<C: PaddedCodec>(spec: Spec) {
        type P<C> = Padded<C>;
        let size = spec.size();
        let floats = [0u8; 64];
        let read = |stride, len| Strided { bytes: &floats, offset: 0, stride, len };
        let mut bytes = [7u8; 40];
        fn write(bytes: &mut [u8], stride: usize, len: usize) -> StridedMut<'_> {
            StridedMut { bytes, offset: 1, stride, len }
        }
        let lengths = Err(StrideMismatch::Lengths { vectors: 2, codes: 3 });
        let short = |offset, stride, size, bytes| StrideMismatch::Stride {
            offset,
            stride,
            len: 2,
            size,
            bytes,
        };
        let stride = Err(short(1, size - 1, size, 40));
        let bounds = Err(StrideMismatch::Bounds { offset: 1, stride: 37, len: 2, size, bytes: 40 });
        for w in [W::Keep, W::Zero, W::One] {
            for encode in [P::<C>::encode_strided, P::<C>::encode_strided_precise] {
                assert_eq!(encode(read(12, 2), w, write(&mut bytes, size, 3)), lengths);
                assert_eq!(encode(read(12, 2), w, write(&mut bytes, size - 1, 2)), stride);
                assert_eq!(encode(read(12, 2), w, write(&mut bytes, 37, 2)), bounds);
                let vectors = Err(short(0, 11, 12, 64));
                assert_eq!(encode(read(11, 2), w, write(&mut bytes, size, 2)), vectors);
                // Nothing to write is never wrong.
                assert_eq!(encode(read(0, 0), w, write(&mut bytes, 0, 0)), Ok(()));
            }
        }
        for encode in [P::<C>::encode_tangents_strided, P::<C>::encode_tangents_strided_precise] {
            assert_eq!(encode(read(16, 2), write(&mut bytes, size, 3)), lengths);
            assert_eq!(encode(read(16, 2), write(&mut bytes, size - 1, 2)), stride);
            assert_eq!(encode(read(16, 2), write(&mut bytes, 37, 2)), bounds);
            // A tangent is longer than a normal.
            let tangents = Err(short(0, 12, 16, 64));
            assert_eq!(encode(read(12, 2), write(&mut bytes, size, 2)), tangents);
        }
        let elements = |stride, len| Strided { bytes: &floats[..40], offset: 1, stride, len };
        let decoders: [(Decode, usize); 2] =
            [(P::<C>::decode_strided, 12), (P::<C>::decode_tangents_strided, 16)];
        for (decode, floats) in decoders {
            let lengths = Err(StrideMismatch::Lengths { vectors: 2, codes: 3 });
            assert_eq!(decode(elements(size, 3), write(&mut bytes, floats, 2)), lengths);
            assert_eq!(decode(elements(size - 1, 2), write(&mut bytes, floats, 2)), stride);
            assert_eq!(decode(elements(37, 2), write(&mut bytes, floats, 2)), bounds);
            let vectors = Err(short(1, floats - 1, floats, 40));
            assert_eq!(decode(elements(size, 2), write(&mut bytes, floats - 1, 2)), vectors);
        }
        assert_eq!(bytes, [7; 40]);

        let kept = any_elements::<C>(&mut Rng::new(5), 3);
        let mut elements = kept.clone();
        let (x, y) = ([1.0; 3], [1.0; 2]);
        let soa = Soa { x: &x, y: &y, z: &x };
        let mismatch = LengthMismatch::Soa { x: 3, y: 2, z: 3, codes: 3 };
        for encode in [P::<C>::encode_soa, P::<C>::encode_soa_precise] {
            assert_eq!(encode(soa, W::One, &mut elements), Err(mismatch));
        }
        let mut out = [[7.0; 3]; 3];
        let [x, y, z] = &mut out;
        let soa = SoaMut { x, y: &mut y[..2], z };
        assert_eq!(P::<C>::decode_soa(&elements, soa), Err(mismatch));
        assert_eq!(out, [[7.0; 3]; 3]);
        let mut tangents = [[7.0; 4]; 2];
        let mismatch = LengthMismatch::Aos { vectors: 2, codes: 3 };
        for encode in [P::<C>::encode_tangents_aos, P::<C>::encode_tangents_aos_precise] {
            assert_eq!(encode(&tangents, &mut elements), Err(mismatch));
        }
        assert_eq!(P::<C>::decode_tangents_aos(&elements, &mut tangents), Err(mismatch));
        assert_eq!((elements, tangents), (kept, [[7.0; 4]; 2]));
    }
    each_format!(check);
}
