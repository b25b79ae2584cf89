//! Packing against the survey's listings and against bits taken one by one.

use unitpack::packing::*;
use unitpack::{CodeInt, Codec, LengthMismatch, Oct12, Oct20, Oct22, Snorm10x3, Snorm11_11_10};
use unitpack_test::random::{Rng, mixed_vectors};
use unitpack_test::tasks::check_all;

/// Listings 4 and 5 of the survey, restated in the floats of GLSL and in wider ones.
macro_rules! listings {
    ($name:ident: $float:ident) => {
        mod $name {
            /// Two snorm numbers to the three numbers, 0 to 1, of an RGB texel.
            pub fn snorm12x2_to_unorm8x3(f: [$float; 2]) -> [$float; 3] {
                let u = f.map(|f| (f.clamp(-1.0, 1.0) * 2047.0 + 2047.0).round_ties_even());
                let t = (u[1] / 256.0).floor();
                let fract = u[0] / 16.0 - (u[0] / 16.0).floor();
                [u[0] / 16.0, fract * 256.0 + t, u[1] - t * 256.0].map(|c| c.floor() / 255.0)
            }

            /// The other way, up to the whole numbers, 0 to 4095.
            pub fn whole(u: [$float; 3]) -> [$float; 2] {
                let [r, g, b] = u.map(|u| u * 255.0);
                let g = g / 16.0;
                [r * 16.0 + g.floor(), (g - g.floor()) * (16.0 * 256.0) + b]
            }

            pub fn unorm8x3_to_snorm12x2(u: [$float; 3]) -> [$float; 2] {
                whole(u).map(|s| (s / 2047.0 - 1.0).clamp(-1.0, 1.0))
            }

            pub fn texel([r, g, b]: [u8; 3]) -> [$float; 3] {
                [r, g, b].map(|c| $float::from(c) / 255.0)
            }

            /// A texture stores the nearest byte.
            pub fn bytes(texel: [$float; 3]) -> [u8; 3] {
                texel.map(|c| (c * 255.0).round_ties_even() as u8)
            }
        }
    };
}

listings!(single: f32);
listings!(double: f64);

/// Every texel, in tasks of one value of the first byte.
fn every_texel(check: impl Fn(&[[u8; 3]]) -> Result<(), String> + Sync) {
    let firsts: Vec<u8> = (0..=255).collect();
    check_all(&firsts, |&r| {
        let texels: Vec<_> = (0..=u16::MAX).map(u16::to_be_bytes).map(|[g, b]| [r, g, b]).collect();
        check(&texels)
    });
}

fn unpack_all(texels: &[[u8; 3]]) -> Vec<[f32; 2]> {
    let mut pairs = vec![[f32::NAN; 2]; texels.len()];
    unpack_snorm12x2_slice(texels, &mut pairs).unwrap();
    pairs
}

fn pack_all(pairs: &[[f32; 2]]) -> Vec<[u8; 3]> {
    let mut texels = vec![[0xAA; 3]; pairs.len()];
    pack_snorm12x2_slice(pairs, &mut texels).unwrap();
    texels
}

#[test]
fn every_texel_unpacks_as_the_listing_says() {
    every_texel(|texels| {
        for (&texel, pair) in texels.iter().zip(unpack_all(texels)) {
            let right = double::unorm8x3_to_snorm12x2(double::texel(texel));
            let near = single::unorm8x3_to_snorm12x2(single::texel(texel));
            // As exact integers both agree; the last division of the one in `f32` is off.
            let [u, v] = pair.map(|x| f64::from(x) * 2047.0 + 2047.0);
            let whole = single::whole(single::texel(texel)).map(|s| f64::from(s.min(4094.0)));
            let agree = pair == right.map(|x| x as f32)
                && [u.round(), v.round()] == whole
                && (0..2).all(|i| (pair[i] - near[i]).abs() <= 1.0 / 16_777_216.0);
            if !agree {
                return Err(format!("{texel:?} is {pair:?}, not {right:?} or near {near:?}"));
            }
        }
        Ok(())
    });
}

#[test]
fn every_texel_packs_as_the_listing_says_and_comes_back() {
    every_texel(|texels| {
        let pairs = unpack_all(texels);
        for ((&texel, &pair), back) in texels.iter().zip(&pairs).zip(pack_all(&pairs)) {
            let fields = [
                u16::from(texel[0]) << 4 | u16::from(texel[1]) >> 4,
                u16::from(texel[1] & 15) << 8 | u16::from(texel[2]),
            ];
            let [u, v] = fields.map(|field| field.min(4094));
            let right = [(u >> 4) as u8, ((u & 15) << 4 | v >> 8) as u8, (v & 255) as u8];
            let listed = [
                double::bytes(double::snorm12x2_to_unorm8x3(pair.map(f64::from))),
                single::bytes(single::snorm12x2_to_unorm8x3(pair)),
            ];
            if back != right || listed != [right; 2] {
                return Err(format!("{texel:?} comes back as {back:?}, listed {listed:?}"));
            }
            if fields.iter().all(|&field| field < 4095) && back != texel {
                return Err(format!("{texel:?} does not come back, but as {back:?}"));
            }
        }
        Ok(())
    });
}

/// Around every midpoint, and anything else that a float can be.
#[test]
fn any_pair_packs_as_the_listing_says() {
    let mut rng = Rng::new(12);
    let mut numbers: Vec<f32> = Vec::new();
    for twice in -4100..=4100 {
        let bits = ((f64::from(twice) / 4094.0) as f32).to_bits();
        numbers.extend((0..5).map(|i| f32::from_bits(bits.wrapping_add(i).wrapping_sub(2))));
    }
    numbers.extend((0..200_000).map(|_| f32::from_bits(rng.bits() as u32)));
    numbers.extend((0..200_000).map(|_| rng.unit() as f32 * 2.0 - 1.0));
    numbers.extend([0.0, -0.0, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, -1e-45]);
    // The listings say nothing of NaN, and leave the two ties to the GPU.
    numbers.retain(|x| !x.is_nan() && x.abs() != 0.5);
    let pairs: Vec<[f32; 2]> = numbers.iter().map(|&x| [x, rng.pick(&numbers)]).collect();
    for (&pair, texel) in pairs.iter().zip(pack_all(&pairs)) {
        let right = double::bytes(double::snorm12x2_to_unorm8x3(pair.map(f64::from)));
        assert_eq!(texel, right, "{pair:?}");
        assert_eq!(pack_snorm12x2(pair), right, "{pair:?}");
    }
}

#[test]
fn ties_of_pairs_go_to_even_and_nan_is_zero() {
    let fields = |[r, g, b]: [u8; 3]| {
        [u32::from(r) << 4 | u32::from(g) >> 4, u32::from(g & 15) << 8 | u32::from(b)]
    };
    assert_eq!(fields(pack_snorm12x2([0.5, -0.5])), [2047 + 1024, 2047 - 1024]);
    assert_eq!(fields(pack_snorm12x2([f32::NAN, 0.0])), [2047, 2047]);
    assert_eq!(fields(pack_snorm12x2([-0.0, -f32::NAN])), [2047, 2047]);
}

#[test]
fn pairs_are_the_same_at_every_length() {
    let mut rng = Rng::new(4);
    for len in 0..=24 {
        let texels: Vec<_> = (0..len).map(|_| [0; 3].map(|_| rng.bits() as u8)).collect();
        let pairs = unpack_all(&texels);
        let single: Vec<_> = texels.iter().map(|&texel| unpack_snorm12x2(texel)).collect();
        assert_eq!(pairs, single);
        let single: Vec<_> = pairs.iter().map(|&pair| pack_snorm12x2(pair)).collect();
        assert_eq!(pack_all(&pairs), single);
    }
}

/// Puts fields into a word by arithmetic; each is reduced to its bits.
fn sum_of_fields(fields: &[(u32, u32)]) -> u32 {
    let (mut word, mut weight) = (0u64, 1u64);
    for &(field, bits) in fields {
        word += u64::from(field) % (1 << bits) * weight;
        weight <<= bits;
    }
    word.try_into().unwrap()
}

#[test]
fn fields_and_tags_stand_where_they_should() {
    let mut rng = Rng::new(10);
    let mut fields =
        vec![[0u16; 3], [u16::MAX; 3], [1, 2, 4], [0x3FF, 0, 0x3FF], [0x400, 0x7FF, 1]];
    fields.extend((0..1000).map(|_| [0; 3].map(|_| rng.bits() as u16)));
    let tags: Vec<u8> = fields.iter().map(|_| rng.bits() as u8).collect();
    let count = fields.len();

    let mut words = vec![0; count];
    pack_10_10_10_2_slice(&fields, &tags, &mut words).unwrap();
    let mut back = (vec![[0; 3]; count], vec![9; count]);
    unpack_10_10_10_2_slice(&words, &mut back.0, &mut back.1).unwrap();
    for (i, &[x, y, z]) in fields.iter().enumerate() {
        let [wx, wy, wz] = [x, y, z].map(u32::from);
        let right = sum_of_fields(&[(wx, 10), (wy, 10), (wz, 10), (u32::from(tags[i]), 2)]);
        assert_eq!([words[i], pack_10_10_10_2([x, y, z], tags[i])], [right; 2]);
        let right = ([x % 1024, y % 1024, z % 1024], tags[i] % 4);
        assert_eq!((back.0[i], back.1[i]), right);
        assert_eq!(unpack_10_10_10_2(words[i]), right);
    }

    pack_11_11_10_slice(&fields, &mut words).unwrap();
    unpack_11_11_10_slice(&words, &mut back.0).unwrap();
    for (i, &[x, y, z]) in fields.iter().enumerate() {
        let [wx, wy, wz] = [x, y, z].map(u32::from);
        let right = sum_of_fields(&[(wx, 11), (wy, 11), (wz, 10)]);
        assert_eq!([words[i], pack_11_11_10([x, y, z])], [right; 2]);
        let right = [x % 2048, y % 2048, z % 1024];
        assert_eq!([back.0[i], unpack_11_11_10(words[i])], [right; 2]);
    }
}

#[test]
fn fields_are_those_of_the_codecs() {
    let mut rng = Rng::new(11);
    // Two's complement of each component of a code whose vector is an axis.
    for (i, axis) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]].into_iter().enumerate() {
        let (small, large) =
            (unpack_10_10_10_2(Snorm10x3::encode(axis)).0, Snorm11_11_10::encode(axis));
        let (mut right_small, mut right_large) = ([0; 3], [0; 3]);
        right_small[i] = [511, 511, 1024 - 511][i];
        right_large[i] = [1023, 1023, 1024 - 511][i];
        assert_eq!(small, right_small);
        assert_eq!(unpack_11_11_10(large), right_large);
    }
    let vectors: Vec<_> = (0..1000).map(|_| rng.direction()).collect();
    let codes: Vec<u32> = vectors.iter().map(|&v| Snorm10x3::encode(v)).collect();
    let tags: Vec<u8> = (0..1000).map(|i| i as u8).collect();
    let mut words = vec![0; 1000];
    pack_tag_slice(&codes, &tags, &mut words).unwrap();
    let (mut codes_back, mut tags_back) = (vec![7; 1000], vec![7; 1000]);
    unpack_tag_slice(&words, &mut codes_back, &mut tags_back).unwrap();
    assert_eq!(codes_back, codes);
    for i in 0..1000 {
        let tag = (i % 4) as u8;
        assert_eq!(tags_back[i], tag);
        assert_eq!(words[i], sum_of_fields(&[(codes[i], 30), (u32::from(tag), 2)]));
        assert_eq!(pack_tag(codes[i] | 0xC000_0000, tags[i]), words[i]);
        assert_eq!(unpack_tag(words[i]), (codes[i], tag));
        assert_eq!(Snorm10x3::decode(words[i]), Snorm10x3::decode(codes[i]));
        assert_eq!(unpack_10_10_10_2(words[i]).1, tag);
    }
}

/// Bit b of the stream, one by one.
fn dense_bit_by_bit(bits: u32, codes: &[u32]) -> Vec<u8> {
    let total = bits as usize * codes.len();
    let mut bytes = vec![0; total.div_ceil(8)];
    for b in 0..total {
        let (code, bit) = (codes[b / bits as usize], b % bits as usize);
        bytes[b / 8] |= ((code >> bit & 1) as u8) << (b % 8);
    }
    bytes
}

fn check_dense<const BITS: u32, C: CodeInt + TryFrom<u32>>() {
    let mut rng = Rng::new(u64::from(BITS));
    let mut integer = || {
        let random = rng.bits();
        let bits = rng.pick(&[0, u64::MAX, random, random, random]) as u32;
        C::try_from(bits >> (32 - 8 * size_of::<C>())).ok().unwrap()
    };
    for len in 0..=40 {
        // With rubbish above their bits.
        let codes: Vec<C> = (0..len).map(|_| integer()).collect();
        let wide: Vec<u32> = codes.iter().map(|&code| code.into()).collect();
        let right = dense_bit_by_bit(BITS, &wide);
        assert_eq!(dense_len(BITS, len), right.len(), "{len} of {BITS} bits");
        let mut bytes = vec![0xA5; right.len()];
        pack_dense::<BITS, C>(&codes, &mut bytes).unwrap();
        assert_eq!(bytes, right, "{len} of {BITS} bits");

        // Spare bits say nothing.
        let spare = 8 * bytes.len() as u32 - BITS * len as u32;
        if spare > 0 {
            *bytes.last_mut().unwrap() |= !(0xFF >> spare);
        }
        let mut back: Vec<C> = (0..len).map(|_| integer()).collect();
        unpack_dense::<BITS, C>(&bytes, &mut back).unwrap();
        for (back, code) in back.into_iter().zip(wide) {
            assert_eq!(
                u64::from(back.into()),
                u64::from(code) % (1 << BITS),
                "{len} of {BITS} bits"
            );
        }

        // One byte too many or too few.
        for wrong in [bytes.len() + 1, bytes.len().wrapping_sub(1)] {
            if wrong <= 1000 {
                let error = LengthMismatch::Dense { codes: len, bytes: wrong, bits: BITS };
                let mut bytes = vec![0xA5; wrong];
                assert_eq!(pack_dense::<BITS, C>(&codes, &mut bytes), Err(error));
                assert_eq!(bytes, vec![0xA5; wrong]);
                let mut kept = codes.clone();
                assert_eq!(unpack_dense::<BITS, C>(&bytes, &mut kept), Err(error));
                assert_eq!(kept, codes);
            }
        }
    }
}

macro_rules! dense {
    ($($int:ty: $($bits:literal)*;)*) => { $($(check_dense::<$bits, $int>();)*)* };
}

#[test]
fn dense_streams_are_those_made_bit_by_bit() {
    dense! {
        u8: 1 2 3 4 5 6 7 8;
        u16: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16;
        u32: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32;
    }
}

fn check_dense_codec<const BITS: u32, T: Codec<Code: CodeInt>>() {
    assert_eq!(T::FORMAT.bits(), BITS);
    let vectors = mixed_vectors(6, 20_003);
    let mut codes = vec![<T::Code as bytemuck::Zeroable>::zeroed(); vectors.len()];
    T::encode_aos(&vectors, &mut codes).unwrap();
    let mut bytes = vec![0; dense_len(BITS, codes.len())];
    pack_dense::<BITS, _>(&codes, &mut bytes).unwrap();
    let wide: Vec<u32> = codes.iter().map(|&code| code.into()).collect();
    assert_eq!(bytes, dense_bit_by_bit(BITS, &wide));
    let mut back = vec![<T::Code as bytemuck::Zeroable>::zeroed(); vectors.len()];
    unpack_dense::<BITS, _>(&bytes, &mut back).unwrap();
    assert_eq!(back, codes);
}

#[test]
fn codes_of_codecs_come_back_from_dense_streams() {
    check_dense_codec::<12, Oct12>();
    check_dense_codec::<20, Oct20>();
    check_dense_codec::<22, Oct22>();
}

#[test]
fn the_length_of_a_stream_does_not_overflow() {
    assert_eq!(dense_len(12, 3), 5);
    assert_eq!(dense_len(32, usize::MAX / 4), usize::MAX / 4 * 4);
    assert_eq!(dense_len(32, usize::MAX), usize::MAX);
    assert_eq!(dense_len(u32::MAX, usize::MAX), usize::MAX);
    assert_eq!(dense_len(0, usize::MAX), 0);
}

#[test]
fn a_mismatch_of_lengths_says_them_and_writes_nothing() {
    let error = LengthMismatch::Values { values: 9, codes: 8 };
    let (mut pairs, mut texels) = ([[0.5; 2]; 9], [[7; 3]; 8]);
    assert_eq!(pack_snorm12x2_slice(&pairs, &mut texels), Err(error));
    assert_eq!(unpack_snorm12x2_slice(&texels, &mut pairs), Err(error));
    assert_eq!((pairs, texels), ([[0.5; 2]; 9], [[7; 3]; 8]));
    let (mut fields, mut words) = ([[5; 3]; 9], [7; 8]);
    assert_eq!(pack_11_11_10_slice(&fields, &mut words), Err(error));
    assert_eq!(unpack_11_11_10_slice(&words, &mut fields), Err(error));
    assert_eq!((fields, words), ([[5; 3]; 9], [7; 8]));

    // One of the three at a time.
    for [codes, tags, words] in [[9, 8, 8], [8, 9, 8], [8, 8, 9]] {
        let error = LengthMismatch::Tagged { codes, tags, words };
        let (mut c, mut t, mut w) = (vec![1; codes], vec![2; tags], vec![3; words]);
        let mut f = vec![[4; 3]; codes];
        assert_eq!(pack_tag_slice(&c, &t, &mut w), Err(error));
        assert_eq!(pack_10_10_10_2_slice(&f, &t, &mut w), Err(error));
        assert_eq!(unpack_tag_slice(&w, &mut c, &mut t), Err(error));
        assert_eq!(unpack_10_10_10_2_slice(&w, &mut f, &mut t), Err(error));
        let kept = (vec![1; codes], vec![2; tags], vec![3; words], vec![[4; 3]; codes]);
        assert_eq!((c, t, w, f), kept);
    }

    let tagged = LengthMismatch::Tagged { codes: 1, tags: 2, words: 3 };
    assert_eq!(tagged.to_string(), "lengths differ: codes 1, tags 2, words 3");
    let dense = LengthMismatch::Dense { codes: 3, bytes: 4, bits: 12 };
    assert_eq!(dense.to_string(), "lengths do not fit: codes 3, bytes 4 at 12 bits a code");
}
