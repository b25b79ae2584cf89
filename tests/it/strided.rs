//! Vectors and codes where they lie: at strides, in place, and from iterators, against the functions of one vector.

use bytemuck::Zeroable;
use unitpack::frame::{Frame, FrameCodec, OctAngle32, OctAngle64, QTangent64};
use unitpack::quaternion::{
    QuaternionCodec, SmallestThree32, SmallestThree48, SmallestThree64, TanThree32,
};
use unitpack::{
    AxisOrder, Codec, Format, LengthMismatch, Oct8, Oct16, Oct24, Oct32, Snorm8x3, Snorm16x3,
    StrideMismatch, Strided, StridedMut, Visitor,
};
use unitpack_test::codes::random_codes;
use unitpack_test::elements::FILL;
use unitpack_test::random::{Rng, mixed_vectors};
use unitpack_test::tasks::check_all;
use unitpack_test::{AnyCodec, Effort, Elements as Place, Vector, representatives};

/// Around the sizes of blocks and parts.
const LENGTHS: [usize; 12] = [0, 1, 2, 7, 8, 16, 17, 63, 65, 257, 1025, 2100];

type Strides = fn(Format, Strided<'_>, StridedMut<'_>) -> Result<(), StrideMismatch>;
type Structures = fn(Format, &[Vector], &mut [u8]) -> Result<(), LengthMismatch>;

/// A codec's functions of strides, over native codes.
struct Typed;

impl Visitor for Typed {
    type Output = fn() -> Result<(), String>;
    fn visit<C: Codec>(self) -> fn() -> Result<(), String> {
        typed::<C>
    }
}

fn typed<C: Codec>() -> Result<(), String> {
    let mut rng = Rng::new(3);
    let finer = AnyCodec::of(C::FORMAT).is_finer_than_f32();
    for len in LENGTHS {
        let vectors = &mixed_vectors(len as u64, 2100)[..len];
        let (from, to) =
            (Place::random(&mut rng, 12, len), Place::random(&mut rng, size_of::<C::Code>(), len));
        let bytes = from.holding(vectors);
        for precise in [false, true] {
            if precise && finer && len > 70 {
                continue;
            }
            let (encode, single): (fn(_, _) -> _, fn(_) -> _) = if precise {
                (C::encode_strided_precise, C::encode_precise)
            } else {
                (C::encode_strided, C::encode)
            };
            let codes: Vec<C::Code> = vectors.iter().map(|&v| single(v)).collect();
            let mut out = to.bytes(size_of::<C::Code>());
            encode(from.read(&bytes), to.write(&mut out)).unwrap();
            if out != to.holding(&codes) {
                return Err(format!("{}: {from:?} to {to:?}, precise {precise}", C::FORMAT));
            }
            let iterated: Vec<C::Code> = if precise {
                C::encode_iter_precise(vectors.iter().copied()).collect()
            } else {
                C::encode_iter(vectors.iter().copied()).collect()
            };
            if iterated != codes {
                return Err(format!("{}: an iterator of {len}", C::FORMAT));
            }
        }
        // Any bit patterns.
        let mut codes = vec![C::Code::zeroed(); len];
        bytemuck::cast_slice_mut(&mut codes)
            .iter_mut()
            .for_each(|b: &mut u8| *b = rng.bits() as u8);
        let decoded: Vec<[u32; 3]> =
            codes.iter().map(|&c| C::decode(c).map(f32::to_bits)).collect();
        let mut out = from.bytes(12);
        C::decode_strided(to.read(&to.holding(&codes)), from.write(&mut out)).unwrap();
        // Float32x3 gives back any NaN.
        let wanted = from.holding(&decoded);
        if out != wanted {
            return Err(format!("{}: {to:?} back to {from:?}", C::FORMAT));
        }
        let iterated = C::decode_iter(codes.iter().copied()).map(|v| v.map(f32::to_bits));
        if !iterated.eq(decoded) {
            return Err(format!("{}: {len} decoded by an iterator", C::FORMAT));
        }
    }
    Ok(())
}

#[test]
fn typed_strides_and_iterators_give_what_single_vectors_do() {
    let all: Vec<_> = Format::ALL
        .iter()
        .filter(|f| representatives::contains(**f))
        .map(|f| f.visit(Typed))
        .collect();
    check_all(&all, |check| check());
}

#[test]
fn formats_take_strides_and_arrays_of_structures() {
    check_all(Format::ALL, |&format| {
        let mut rng = Rng::new(format as u64);
        let codec = AnyCodec::of(format);
        let size = format.code_size();
        let little_endian = |code: u128| code.to_le_bytes()[..size].to_vec();
        for len in [0, 1, 9, 65, if codec.is_finer_than_f32() { 70 } else { 1030 }] {
            let vectors = &mixed_vectors(len as u64 + 5, 1030)[..len];
            let (from, to) = (Place::random(&mut rng, 12, len), Place::random(&mut rng, size, len));
            for effort in Effort::BOTH {
                let (strided, aos): (Strides, Structures) = match effort {
                    Effort::Fast => (Format::encode_strided, Format::encode_aos::<3>),
                    Effort::Precise => {
                        (Format::encode_strided_precise, Format::encode_aos_precise::<3>)
                    }
                };
                let codes: Vec<u8> = vectors
                    .iter()
                    .flat_map(|&v| little_endian(codec.encode_with(effort, v)))
                    .collect();
                let mut out = vec![FILL; size * len];
                aos(format, vectors, &mut out[..]).unwrap();
                if out != codes {
                    return Err(format!("{format}: arrays of structures, {effort:?}"));
                }
                let mut out = to.bytes(size);
                strided(format, from.read(&from.holding(vectors)), to.write(&mut out)).unwrap();
                let mut wanted = to.bytes(size);
                for (i, code) in codes.chunks(size).enumerate() {
                    wanted[to.element(i, size)].copy_from_slice(code);
                }
                if out != wanted {
                    return Err(format!("{format}: {from:?} to {to:?}, {effort:?}"));
                }
            }
            let codes = random_codes(format, len as u64, len);
            let (mut dense, mut strided) = (vec![], to.bytes(size));
            for (i, &code) in codes.iter().enumerate() {
                dense.extend(little_endian(code));
                strided[to.element(i, size)].copy_from_slice(&little_endian(code));
            }
            let decoded: Vec<Vector> = codes.iter().map(|&code| (codec.decode)(code)).collect();
            let bits =
                |v: &[Vector]| -> Vec<[u32; 3]> { v.iter().map(|v| v.map(f32::to_bits)).collect() };
            let mut out = vec![[0.0; 3]; len];
            format.decode_aos(&dense, &mut out).unwrap();
            if bits(&out) != bits(&decoded) {
                return Err(format!("{format}: {len} decoded to arrays of structures"));
            }
            let mut out = from.bytes(12);
            format.decode_strided(to.read(&strided), from.write(&mut out)).unwrap();
            if out != from.holding(&bits(&decoded)) {
                return Err(format!("{format}: {to:?} back to {from:?}"));
            }
        }
        Ok(())
    });
}

/// Fields before, after and over each other, with and without room between elements.
#[test]
fn codes_replace_vectors_in_place() {
    fn check<C: Codec>() {
        let size = size_of::<C::Code>();
        for (vector, code, gap) in
            [(0, 0, 0), (0, 12, 0), (size, 0, 3), (5, 9, 1), (7, 30, 0), (20, 7, 9), (4, 2, 0)]
        {
            let span = (vector + 12).max(code + size) - vector.min(code);
            let stride = span + gap;
            for len in LENGTHS {
                let vectors = &mixed_vectors(9, 2100)[..len];
                let places = [vector, code].map(|offset| Place { offset, stride, len });
                let end = vector.min(code)
                    + len.saturating_sub(1) * stride
                    + if len > 0 { span } else { 0 };
                let mut bytes = vec![FILL; end];
                let put = |bytes: &mut Vec<u8>, i, element: &[u8], place: Place| {
                    bytes[place.element(i, element.len())].copy_from_slice(element);
                };
                for (i, v) in vectors.iter().enumerate() {
                    put(&mut bytes, i, bytemuck::bytes_of(v), places[0]);
                }
                let mut wanted = bytes.clone();
                let codes: Vec<C::Code> = vectors.iter().map(|&v| C::encode(v)).collect();
                for (i, code) in codes.iter().enumerate() {
                    put(&mut wanted, i, bytemuck::bytes_of(code), places[1]);
                }
                C::encode_within(places[0].write(&mut bytes), code).unwrap();
                assert_eq!(bytes, wanted, "{} {vector} {code} {gap} {len}", C::FORMAT);
                for (i, &code) in codes.iter().enumerate() {
                    put(&mut wanted, i, bytemuck::bytes_of(&C::decode(code)), places[0]);
                }
                C::decode_within(places[1].write(&mut bytes), vector).unwrap();
                assert_eq!(bytes, wanted, "{} {vector} {code} {gap} {len} back", C::FORMAT);
            }
        }
    }
    check::<Oct8>();
    check::<Oct16>();
    check::<Oct24>();
    check::<Oct32>();
    check::<Snorm16x3>();
}

#[test]
fn formats_work_in_place_too() {
    let vectors = mixed_vectors(4, 300);
    for format in [Format::Oct16, Format::Snorm8x3, Format::Octant16] {
        let codec = AnyCodec::of(format);
        let size = format.code_size();
        for effort in Effort::BOTH {
            let mut bytes: Vec<u8> = bytemuck::cast_slice(&vectors).to_vec();
            fn whole(bytes: &mut [u8]) -> StridedMut<'_> {
                let len = bytes.len() / 12;
                StridedMut { bytes, offset: 0, stride: 12, len }
            }
            match effort {
                Effort::Fast => format.encode_within(whole(&mut bytes), 8).unwrap(),
                Effort::Precise => format.encode_within_precise(whole(&mut bytes), 8).unwrap(),
            }
            for (row, &v) in bytes.chunks(12).zip(&vectors) {
                let code = codec.encode_with(effort, v).to_le_bytes();
                assert_eq!(row[8..][..size], code[..size], "{format}");
                assert_eq!(row[..8], bytemuck::bytes_of(&v)[..8]);
            }
            let codes = StridedMut { offset: 8, ..whole(&mut bytes) };
            format.decode_within(codes, 0).unwrap();
            for (row, &v) in bytes.chunks(12).zip(&vectors) {
                let decoded = (codec.decode)(codec.encode_with(effort, v));
                assert_eq!(row, bytemuck::bytes_of(&decoded), "{format}");
            }
        }
    }
}

#[test]
fn rotations_work_in_place_too() {
    fn check<C: QuaternionCodec>() {
        let size = size_of::<C::Code>();
        let mut rng = Rng::new(12);
        for (q_at, code_at, gap) in [(0, 0, 0), (0, 16, 0), (size, 0, 3), (5, 9, 1), (4, 2, 0)] {
            let span = (q_at + 16).max(code_at + size) - q_at.min(code_at);
            let stride = span + gap;
            for len in LENGTHS {
                let q: Vec<[f32; 4]> =
                    (0..len).map(|_| [(); 4].map(|()| rng.bits() as i32 as f32)).collect();
                let [q_place, code_place] =
                    [q_at, code_at].map(|offset| Place { offset, stride, len });
                for precise in [false, true] {
                    let mut bytes = vec![FILL; q_at.min(code_at) + len * stride];
                    for (i, q) in q.iter().enumerate() {
                        bytes[q_place.element(i, 16)].copy_from_slice(bytemuck::bytes_of(q));
                    }
                    let single = if precise { C::encode_precise } else { C::encode };
                    let codes: Vec<C::Code> = q.iter().map(|&q| single(q)).collect();
                    let mut wanted = bytes.clone();
                    for (i, code) in codes.iter().enumerate() {
                        let code = bytemuck::bytes_of(code);
                        wanted[code_place.element(i, size)].copy_from_slice(code);
                    }
                    let encode = if precise { C::encode_within_precise } else { C::encode_within };
                    encode(q_place.write(&mut bytes), code_at).unwrap();
                    assert_eq!(bytes, wanted, "{} {q_at} {code_at} {len}", C::NAME);
                    for (i, &code) in codes.iter().enumerate() {
                        let q = C::decode(code);
                        wanted[q_place.element(i, 16)].copy_from_slice(bytemuck::bytes_of(&q));
                    }
                    C::decode_within(code_place.write(&mut bytes), q_at).unwrap();
                    assert_eq!(bytes, wanted, "{} {q_at} {code_at} {len} back", C::NAME);
                }
            }
        }
    }
    check::<SmallestThree32>();
    check::<SmallestThree48>();
    check::<SmallestThree64>();
    let mut bytes = [FILL; 40];
    let q = StridedMut { bytes: &mut bytes, offset: 0, stride: 19, len: 2 };
    let error = StrideMismatch::Fields {
        first: 0,
        first_size: 16,
        second: 16,
        second_size: 4,
        stride: 19,
        len: 2,
        bytes: 40,
    };
    assert_eq!(SmallestThree32::encode_within(q, 16), Err(error));
    assert_eq!(bytes, [FILL; 40]);
}

#[test]
fn frames_work_in_place_too() {
    fn check<C: FrameCodec>() {
        let size = size_of::<C::Code>();
        let mut rng = Rng::new(13);
        // Beside each other, in another order, over each other.
        for (at, span) in [([0, 12, 28], 36), ([24, 8, 0], 36), ([2, 14, 2], 28), ([0, 4, 9], 20)] {
            for len in LENGTHS {
                let stride = span + rng.below(3) as usize;
                let frames: Vec<Frame> = (0..len)
                    .map(|_| {
                        let mut vector = || [(); 3].map(|()| rng.unit() as f32 - 0.5);
                        let (normal, tangent) = (vector(), vector());
                        Frame { normal, tangent, handedness: vector()[0].signum() }
                    })
                    .collect();
                let [normal, tangent, code] = at.map(|offset| Place { offset, stride, len });
                let put = |bytes: &mut [u8], i, frame: &Frame| {
                    let [x, y, z] = frame.tangent;
                    bytes[normal.element(i, 12)].copy_from_slice(bytemuck::bytes_of(&frame.normal));
                    let tangent_bytes = [x, y, z, frame.handedness];
                    bytes[tangent.element(i, 16)]
                        .copy_from_slice(bytemuck::bytes_of(&tangent_bytes));
                };
                let mut bytes = vec![FILL; 2 + len * stride];
                frames.iter().enumerate().for_each(|(i, frame)| put(&mut bytes, i, frame));
                // What lies over another is what counts, so read it back.
                let floats = |bytes: &[u8]| -> Vec<f32> {
                    bytes.chunks(4).map(|c| f32::from_ne_bytes(c.try_into().unwrap())).collect()
                };
                let read: Vec<Frame> = (0..len)
                    .map(|i| {
                        let n = floats(&bytes[normal.element(i, 12)]);
                        let t = floats(&bytes[tangent.element(i, 16)]);
                        let normal = [n[0], n[1], n[2]];
                        Frame { normal, tangent: [t[0], t[1], t[2]], handedness: t[3] }
                    })
                    .collect();
                let normals: Vec<[f32; 3]> = read.iter().map(|f| f.normal).collect();
                let tangents: Vec<[f32; 4]> = read
                    .iter()
                    .map(|f| [f.tangent[0], f.tangent[1], f.tangent[2], f.handedness])
                    .collect();
                let mut codes = vec![C::Code::zeroed(); len];
                for precise in [false, true] {
                    let (all, within): (fn(_, _, _) -> _, fn(_, _, _) -> _) = if precise {
                        (C::encode_aos_precise::<3>, C::encode_within_precise)
                    } else {
                        (C::encode_aos::<3>, C::encode_within)
                    };
                    let skew = all(&normals[..], &tangents[..], &mut codes[..]).unwrap();
                    let mut got = bytes.clone();
                    let mut wanted = bytes.clone();
                    for (i, c) in codes.iter().enumerate() {
                        wanted[code.element(i, size)].copy_from_slice(bytemuck::bytes_of(c));
                    }
                    assert_eq!(within(normal.write(&mut got), at[1], at[2]), Ok(skew));
                    assert_eq!(got, wanted, "{} {at:?} {len}", C::NAME);
                    for (i, &c) in codes.iter().enumerate() {
                        put(&mut wanted, i, &C::decode(c));
                    }
                    C::decode_within(normal.write(&mut got), at[1], at[2]).unwrap();
                    assert_eq!(got, wanted, "{} {at:?} {len} back", C::NAME);
                }
            }
        }
    }
    check::<OctAngle32>();
    check::<OctAngle64>();
    check::<QTangent64>();
    let mut bytes = [FILL; 64];
    let normals = StridedMut { bytes: &mut bytes, offset: 0, stride: 31, len: 2 };
    // Normal and tangent are one field of 28 bytes.
    let error = StrideMismatch::Fields {
        first: 0,
        first_size: 28,
        second: 28,
        second_size: 4,
        stride: 31,
        len: 2,
        bytes: 64,
    };
    assert_eq!(OctAngle32::encode_within(normals, 12, 28), Err(error));
    let normals = StridedMut { bytes: &mut bytes, offset: 0, stride: 32, len: 2 };
    assert!(OctAngle32::decode_within(normals, usize::MAX - 3, 28).is_err());
    assert_eq!(bytes, [FILL; 64]);
}

/// The name says which components are the codec's.
#[test]
fn axes_have_any_order() {
    let vectors = mixed_vectors(14, 1100);
    for order in AxisOrder::ALL {
        let name = format!("{order:?}").to_lowercase();
        let ordered = |v: Vector| -> Vector {
            core::array::from_fn(|i| v["xyz".find(&name[i..=i]).unwrap()])
        };
        assert_eq!(order.apply([1.0, 2.0, 3.0]), ordered([1.0, 2.0, 3.0]));
        assert_eq!(order.undo(ordered([1.0, 2.0, 3.0])), [1.0, 2.0, 3.0]);

        let read = Strided::of(&vectors, 0);
        let mut codes = vec![0u32; vectors.len()];
        order.encode_strided(Oct32, read, StridedMut::of(&mut codes, 0)).unwrap();
        assert!(codes.iter().zip(&vectors).all(|(&code, &v)| code == Oct32::encode(ordered(v))));
        order.encode_strided_precise(Oct32, read, StridedMut::of(&mut codes, 0)).unwrap();
        assert!(
            codes.iter().zip(&vectors).all(|(&code, &v)| code == Oct32::encode_precise(ordered(v)))
        );
        // Little-endian, by a format.
        let mut bytes = vec![0; 4 * vectors.len()];
        let to = StridedMut { bytes: &mut bytes, offset: 0, stride: 4, len: vectors.len() };
        order.encode_strided_precise(Format::Oct32, read, to).unwrap();
        assert!(bytes.chunks(4).zip(&codes).all(|(bytes, code)| bytes == code.to_le_bytes()));

        let mut decoded = vectors.clone();
        let from = Strided::of(&codes, 0);
        order.decode_strided(Oct32, from, StridedMut::of(&mut decoded, 0)).unwrap();
        assert!(decoded.iter().zip(&codes).all(|(&v, &code)| ordered(v) == Oct32::decode(code)));

        let mut within = vectors.clone();
        order.encode_within(Oct32, StridedMut::of(&mut within, 0), 8).unwrap();
        let code = |v: Vector| Oct32::encode(ordered(v));
        assert!(within.iter().zip(&vectors).all(|(w, &v)| w[2].to_bits() == code(v)));
        order.decode_within(Oct32, StridedMut::of(&mut within, 8), 0).unwrap();
        assert!(within.iter().zip(&vectors).all(|(&w, &v)| ordered(w) == Oct32::decode(code(v))));
        let mut within = vectors.clone();
        order.encode_within_precise(Oct32, StridedMut::of(&mut within, 0), 0).unwrap();
        assert!(within.iter().zip(&codes).all(|(w, code)| w[0].to_bits() == *code));
    }
    let read = Strided::of(&vectors, 0);
    let none = StridedMut { bytes: &mut [], offset: 0, stride: 4, len: 0 };
    assert_eq!(
        AxisOrder::Zyx.encode_strided(Oct32, read, none),
        Err(StrideMismatch::Lengths { vectors: vectors.len(), codes: 0 })
    );
}

#[test]
fn rotations_and_frames_have_strides() {
    fn rotations<C: QuaternionCodec>() {
        let mut rng = Rng::new(8);
        for len in LENGTHS {
            let q: Vec<[f32; 4]> =
                (0..len).map(|_| [(); 4].map(|()| rng.bits() as i32 as f32)).collect();
            let (from, to) = (
                Place::random(&mut rng, 16, len),
                Place::random(&mut rng, size_of::<C::Code>(), len),
            );
            let bytes = from.holding(&q);
            let mut out = to.bytes(size_of::<C::Code>());
            C::encode_strided(from.read(&bytes), to.write(&mut out)).unwrap();
            let codes: Vec<C::Code> = q.iter().map(|&q| C::encode(q)).collect();
            assert_eq!(out, to.holding(&codes), "{} {from:?} {to:?}", C::NAME);
            let mut back = from.bytes(16);
            C::decode_strided(to.read(&out), from.write(&mut back)).unwrap();
            let decoded: Vec<[f32; 4]> = codes.iter().map(|&code| C::decode(code)).collect();
            assert_eq!(back, from.holding(&decoded), "{} {to:?} {from:?}", C::NAME);
            C::encode_strided_precise(from.read(&bytes), to.write(&mut out)).unwrap();
            let codes: Vec<C::Code> = q.iter().map(|&q| C::encode_precise(q)).collect();
            assert_eq!(out, to.holding(&codes), "{} {from:?} {to:?}", C::NAME);
        }
    }
    rotations::<SmallestThree32>();
    rotations::<SmallestThree48>();
    rotations::<SmallestThree64>();
    rotations::<TanThree32>();

    fn frames<C: FrameCodec>() {
        let mut rng = Rng::new(9);
        for len in LENGTHS {
            let normals = &mixed_vectors(10, 2100)[..len];
            let tangents: Vec<[f32; 4]> =
                (0..len).map(|_| [(); 4].map(|()| rng.bits() as i32 as f32)).collect();
            let [n, t] = [12, 16].map(|size| Place::random(&mut rng, size, len));
            let to = Place::random(&mut rng, size_of::<C::Code>(), len);
            let bytes = [n.holding(normals), t.holding(&tangents)];
            let mut dense = vec![C::Code::zeroed(); len];
            let single =
                |precise: bool| -> Vec<C::Code> {
                    let frames =
                        normals.iter().zip(&tangents).map(|(&normal, &[x, y, z, handedness])| {
                            Frame { normal, tangent: [x, y, z], handedness }
                        });
                    frames.map(if precise { C::encode_precise } else { C::encode }).collect()
                };
            let mut out = to.bytes(size_of::<C::Code>());
            let skew = C::encode_strided(n.read(&bytes[0]), t.read(&bytes[1]), to.write(&mut out));
            assert_eq!(out, to.holding(&single(false)), "{} {n:?} {t:?} {to:?}", C::NAME);
            let same = C::encode_aos(normals, &tangents, &mut dense).unwrap();
            assert_eq!(skew.unwrap(), same);
            C::encode_strided_precise(n.read(&bytes[0]), t.read(&bytes[1]), to.write(&mut out))
                .unwrap();
            let codes = single(true);
            assert_eq!(out, to.holding(&codes), "{} {n:?} {t:?} {to:?}", C::NAME);
            let [mut normals_out, mut tangents_out] = [n.bytes(12), t.bytes(16)];
            C::decode_strided(to.read(&out), n.write(&mut normals_out), t.write(&mut tangents_out))
                .unwrap();
            let decoded: Vec<Frame> = codes.iter().map(|&code| C::decode(code)).collect();
            let normals: Vec<_> = decoded.iter().map(|f| f.normal).collect();
            let tangents: Vec<_> = decoded
                .iter()
                .map(|f| [f.tangent[0], f.tangent[1], f.tangent[2], f.handedness])
                .collect();
            assert_eq!(normals_out, n.holding(&normals));
            assert_eq!(tangents_out, t.holding(&tangents));

            // Both in one buffer, tangents before and behind normals.
            for (normal, tangent, stride) in [(3, 15, 28), (20, 1, 35)] {
                let [n, t] = [normal, tangent].map(|offset| Place { offset, stride, len });
                let size = (n.offset + 12).max(t.offset + 16);
                let end = len.checked_sub(1).map_or(0, |last| last * stride + size);
                let mut out = vec![FILL; end];
                let mut wanted = out.clone();
                for i in 0..len {
                    wanted[n.element(i, 12)].copy_from_slice(bytemuck::bytes_of(&normals[i]));
                    wanted[t.element(i, 16)].copy_from_slice(bytemuck::bytes_of(&tangents[i]));
                }
                let codes = to.holding(&codes);
                C::decode_vertices(to.read(&codes), n.write(&mut out), tangent).unwrap();
                assert_eq!(out, wanted, "{} {normal} {tangent} {len}", C::NAME);
            }
        }
    }
    frames::<OctAngle32>();
    frames::<OctAngle64>();
    frames::<QTangent64>();
}

#[test]
fn what_does_not_fit_is_refused_and_nothing_written() {
    let bytes = [0; 100];
    let read = |offset, stride, len| Strided { bytes: &bytes, offset, stride, len };
    let mut out = [7; 30];
    let refused = |v: Strided<'_>, offset, stride, len, out: &mut [u8]| {
        let codes = StridedMut { bytes: out, offset, stride, len };
        Oct16::encode_strided(v, codes).unwrap_err()
    };
    let bounds = StrideMismatch::Bounds { offset: 4, stride: 20, len: 6, size: 12, bytes: 100 };
    assert_eq!(refused(read(4, 20, 6), 0, 2, 6, &mut out), bounds);
    // The last element may end before a whole stride, but not before itself.
    let bounds = StrideMismatch::Bounds { offset: 29, stride: 60, len: 2, size: 12, bytes: 100 };
    assert_eq!(refused(read(29, 60, 2), 0, 2, 2, &mut out), bounds);
    let bounds = StrideMismatch::Bounds { offset: 1, stride: 28, len: 3, size: 2, bytes: 30 };
    assert_eq!(refused(read(0, 12, 3), 1, 28, 3, &mut out), bounds);
    for stride in [0, 11] {
        let expected = StrideMismatch::Stride { offset: 0, stride, len: 2, size: 12, bytes: 100 };
        assert_eq!(refused(read(0, stride, 2), 0, 2, 2, &mut out), expected);
    }
    assert_eq!(
        refused(read(0, 12, 2), 0, 1, 2, &mut out),
        StrideMismatch::Stride { offset: 0, stride: 1, len: 2, size: 2, bytes: 30 }
    );
    assert_eq!(
        refused(read(0, 12, 2), 0, 2, 3, &mut out),
        StrideMismatch::Lengths { vectors: 2, codes: 3 }
    );
    for (offset, stride, len) in
        [(usize::MAX, 12, 2), (0, usize::MAX, 2), (0, usize::MAX / 2, 3), (0, 12, usize::MAX)]
    {
        let bounds = StrideMismatch::Bounds { offset, stride, len, size: 12, bytes: 100 };
        assert_eq!(refused(read(offset, stride, len), 0, 2, len, &mut out), bounds);
    }
    assert_eq!(out, [7; 30]);
    // Where the only element lies does not depend on the stride.
    let one = StridedMut { bytes: &mut [7; 5], offset: 2, stride: usize::MAX, len: 1 };
    assert_eq!(Oct16::encode_strided(read(88, usize::MAX, 1), one), Ok(()));
    let one = StridedMut { bytes: &mut [7; 16], offset: 0, stride: usize::MAX, len: 1 };
    assert_eq!(Oct16::encode_within(one, 13), Ok(()));
    // No elements lie anywhere, at any stride.
    let none = StridedMut { bytes: &mut [], offset: 0, stride: 0, len: 0 };
    assert_eq!(Oct16::encode_strided(read(0, 0, 0), none), Ok(()));
    let none = StridedMut { bytes: &mut [], offset: 12, stride: 32, len: 0 };
    assert_eq!(Oct16::encode_strided(read(200, 12, 0), none), Ok(()));

    let mut bytes = [7; 40];
    fn within(bytes: &mut [u8], stride: usize, len: usize) -> StridedMut<'_> {
        StridedMut { bytes, offset: 0, stride, len }
    }
    assert_eq!(
        Oct32::encode_within(within(&mut bytes, 15, 2), 12),
        Err(StrideMismatch::Fields {
            first: 0,
            first_size: 12,
            second: 12,
            second_size: 4,
            stride: 15,
            len: 2,
            bytes: 40
        })
    );
    assert_eq!(
        Oct32::decode_within(within(&mut bytes, 20, 2), usize::MAX - 3),
        Err(StrideMismatch::Fields {
            first: usize::MAX - 3,
            first_size: 12,
            second: 0,
            second_size: 4,
            stride: 20,
            len: 2,
            bytes: 40
        })
    );
    assert_eq!(
        Oct32::encode_within(within(&mut bytes, 16, 3), 12),
        Err(StrideMismatch::Fields {
            first: 0,
            first_size: 12,
            second: 12,
            second_size: 4,
            stride: 16,
            len: 3,
            bytes: 40
        })
    );
    assert_eq!(bytes, [7; 40]);
    assert_eq!(
        bounds_text(),
        "6 elements of 12 bytes from byte 4 on, 20 bytes apart, do not lie in 100 bytes"
    );
    assert_eq!(
        Format::Oct24.encode_aos(&[[1.0; 3]; 3], &mut [0; 8]),
        Err(LengthMismatch::AosBytes { vectors: 3, bytes: 8, code_size: 3 })
    );
    let frames = OctAngle32::encode_strided(
        read(0, 12, 2),
        read(0, 16, 3),
        StridedMut { bytes: &mut out, offset: 0, stride: 4, len: 2 },
    );
    assert_eq!(frames, Err(StrideMismatch::Frames { normals: 2, tangents: 3, codes: 2 }));
}

fn bounds_text() -> String {
    StrideMismatch::Bounds { offset: 4, stride: 20, len: 6, size: 12, bytes: 100 }.to_string()
}

#[test]
fn iterators_know_their_length_and_stop() {
    for len in [0, 1, 63, 64, 65, 200] {
        let mut codes = Oct16::encode_iter((0..len).map(|i| [i as f32, 1.0, 0.0]));
        for left in (0..len).rev() {
            assert_eq!(codes.len(), left + 1);
            assert!(codes.next().is_some());
        }
        assert_eq!((codes.len(), codes.next(), codes.next()), (0, None, None));
        let vectors = Oct16::decode_iter(vec![0; len]);
        assert_eq!((vectors.len(), vectors.count()), (len, len));
    }
    // Of an unknown number.
    let odd = (0..100).filter(|i| i % 2 == 1).map(|i| [i as f32, 1.0, 0.0]);
    let mut codes = Oct16::encode_iter(odd);
    assert_eq!(codes.size_hint(), (0, Some(100)));
    assert!(codes.next().is_some());
    assert_eq!(codes.size_hint(), (49, Some(49)));
    // What comes after an end does not come.
    let mut calls = 0;
    let flickering = core::iter::from_fn(|| {
        calls += 1;
        (calls % 3 != 0).then_some([1.0, 0.0, 0.0])
    });
    assert_eq!(Oct16::encode_iter(flickering).count(), 2);

    #[derive(Clone, Copy)]
    struct Normal(f32);
    impl From<Normal> for [f32; 3] {
        fn from(v: Normal) -> [f32; 3] {
            [0.0, v.0, 1.0]
        }
    }
    let codes: Vec<u32> = Oct32::encode_iter_precise([Normal(0.5), Normal(-0.5)]).collect();
    assert_eq!(codes, [0.5, -0.5].map(|y| Oct32::encode_precise([0.0, y, 1.0])));
    let _: [u8; 3] = Snorm8x3::encode_iter([Normal(0.0)]).next().unwrap();
}
