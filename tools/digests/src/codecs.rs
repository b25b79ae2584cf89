//! The digests of the codecs: `encode`, `encode_precise`, `decode`, and `mirror` with `negate`.

use core::array;

use bytemuck::{Zeroable, bytes_of, bytes_of_mut};
use unitpack::padded::{Padded, PaddedCodec, W};
use unitpack::{
    Axis, Codec, Float16x3, Format, LengthMismatch, Snorm8x3, Snorm10x3, Snorm12x3, Snorm16x3, Soa,
    SoaMut, Strided, StridedMut, Visitor, XyzUnorm8x3, XyzUnorm10x3, XyzUnorm16x3, for_each_codec,
};

use crate::LEN;
use crate::digest::Digest;
use crate::inputs::{CODE, Random};
use crate::platform::line;

/// How many times `LEN` vectors each codec encodes, and codes it decodes. An emulated processor takes a quarter of
/// a minute for all.
const BLOCKS: usize = 24;

/// The same for `encode_precise` where it searches lengths, with a thousand times the work: as many seconds again.
const SLOW_BLOCKS: usize = 2;

pub fn report() {
    for &format in Format::ALL {
        let one = format.visit(One);
        let mut slow = false;
        macro_rules! finer {
            ($name:ident) => {
                slow |= format == Format::$name;
            };
        }
        for_each_codec!(finer: finer);
        let encode = encode(format, &one, BLOCKS, Format::encode, one.encode);
        let precise = self::encode(
            format,
            &one,
            if slow { SLOW_BLOCKS } else { BLOCKS },
            Format::encode_precise,
            one.encode_precise,
        );
        let decode = decode(format, &one);
        let mirror = format.visit(Mirrored);
        line(format_args!(
            "{:20} {encode:016x} {precise:016x} {decode:016x} {mirror:016x}",
            format.name(),
        ));
    }
    strides();
    padded();
}

/// One line for all formats: vectors and codes at strides, of which none is aligned, and back in place.
fn strides() {
    let (mut encode, mut decode) = (Digest::new(), Digest::new());
    for &format in Format::ALL {
        let size = format.code_size();
        let single = format.visit(One).decode;
        let mut random = Random::new();
        let mut vectors = [0; 1 + 21 * LEN];
        for row in vectors[1..].chunks_exact_mut(21) {
            let v = random.vector(size, format.bits(), single);
            row[..12].copy_from_slice(v.map(f32::to_ne_bytes).as_flattened());
        }
        let mut codes = [0; 3 + (CODE + 1) * LEN];
        let (v, stride) = (Strided { bytes: &vectors, offset: 1, stride: 21, len: LEN }, size + 1);
        let to = StridedMut { bytes: &mut codes, offset: 3, stride, len: LEN };
        format.encode_strided(v, to).expect("elements that fit");
        let codes = &mut codes[..3 + stride * LEN];
        for code in codes[3..].chunks_exact_mut(stride) {
            digest_codes(format, &mut code[..size], &mut encode);
        }
        let v = StridedMut { bytes: &mut vectors, offset: 1, stride: 21, len: LEN };
        format.encode_within(v, 3).expect("elements that fit");
        let v = StridedMut { bytes: &mut vectors, offset: 3, stride: 21, len: LEN };
        format.decode_within(v, 1).expect("elements that fit");
        for row in vectors[1..].chunks_exact(21) {
            for float in row[..12].as_chunks().0 {
                decode.floats(&[f32::from_ne_bytes(*float)]);
            }
        }
    }
    line(format_args!("{:20} {:016x} {:016x}", "strides", encode.finish(), decode.finish()));
    doubles();
}

/// One line for all formats: doubles that no float is, of any length.
fn doubles() {
    let (mut fast, mut precise) = (Digest::new(), Digest::new());
    for &format in Format::ALL {
        let size = format.code_size();
        let single = format.visit(One).decode;
        let mut random = Random::new();
        let vectors: [[f64; 3]; LEN] = array::from_fn(|i| {
            let length = f64::from_bits((1023 - 800 + 25 * i as u64) << 52);
            let v = random.vector(size, format.bits(), single);
            v.map(|c| f64::from(c) * (1.0 + 1.0 / 1_099_511_627_776.0) * length)
        });
        let mut codes = [0; CODE * LEN];
        let codes = &mut codes[..size * LEN];
        format.encode_aos_f64(&vectors, codes).expect("lengths that fit");
        digest_codes(format, codes, &mut fast);
        format.encode_aos_f64_precise(&vectors, codes).expect("lengths that fit");
        digest_codes(format, codes, &mut precise);
    }
    line(format_args!("{:20} {:016x} {:016x}", "doubles", fast.finish(), precise.finish()));
}

/// One line for all elements with a fourth component: normals that keep it, and tangents.
fn padded() {
    let mut digests = [Digest::new(), Digest::new(), Digest::new()];
    padded_of::<Snorm8x3>(&mut digests);
    padded_of::<Snorm12x3>(&mut digests);
    padded_of::<Snorm16x3>(&mut digests);
    padded_of::<Float16x3>(&mut digests);
    padded_of::<XyzUnorm8x3>(&mut digests);
    padded_of::<XyzUnorm16x3>(&mut digests);
    padded_of::<XyzUnorm10x3>(&mut digests);
    padded_of::<Snorm10x3>(&mut digests);
    let [normals, tangents, decode] = digests.map(Digest::finish);
    line(format_args!("{:20} {normals:016x} {tangents:016x} {decode:016x}", "padded"));
}

fn padded_of<C: PaddedCodec>([normals, tangents, decode]: &mut [Digest; 3]) {
    let size = size_of::<C::Element>();
    let single = C::FORMAT.visit(One).decode;
    let mut random = Random::new();
    let vectors: [[f32; 4]; LEN] = array::from_fn(|i| {
        let [x, y, z] = random.vector(C::FORMAT.code_size(), C::FORMAT.bits(), single);
        [x, y, z, [1.0, -1.0, 0.0, f32::NAN, -0.5][i % 5]]
    });
    let mut patterns = [0; 8 * LEN];
    random.codes(size, &mut patterns[..size * LEN]);
    let mut elements: [C::Element; LEN] = array::from_fn(|i| {
        let mut element = C::Element::zeroed();
        let bytes = bytes_of_mut(&mut element);
        bytes.copy_from_slice(&patterns[size * i..size * (i + 1)]);
        swap_to_little_endian::<C::Element>(bytes);
        element
    });
    let mut decoded = [[0.0; 4]; LEN];
    Padded::<C>::decode_tangents_aos(&elements, &mut decoded).expect("lengths that fit");
    decode.floats(decoded.as_flattened());
    let to = StridedMut::of(&mut elements, 0);
    Padded::<C>::encode_strided(Strided::of(&vectors, 0), W::Keep, to).expect("elements that fit");
    digest_elements::<C>(&elements, normals);
    Padded::<C>::encode_tangents_aos(&vectors, &mut elements).expect("lengths that fit");
    digest_elements::<C>(&elements, tangents);
}

fn digest_elements<C: PaddedCodec>(elements: &[C::Element], digest: &mut Digest) {
    for &(mut element) in elements {
        let bytes = bytes_of_mut(&mut element);
        swap_to_little_endian::<C::Element>(bytes);
        digest.bytes(bytes);
    }
}

/// A codec's functions of one vector, over the little-endian bytes of a code.
struct Singles {
    encode: fn([f32; 3]) -> [u8; CODE],
    encode_precise: fn([f32; 3]) -> [u8; CODE],
    decode: fn(&[u8]) -> [f32; 3],
}

/// Gives a codec's [`Singles`].
struct One;

impl Visitor for One {
    type Output = Singles;
    fn visit<C: Codec>(self) -> Singles {
        Singles {
            encode: |v| to_bytes::<C>(C::encode(v)),
            encode_precise: |v| to_bytes::<C>(C::encode_precise(v)),
            decode: |bytes| {
                let mut code = C::Code::zeroed();
                bytes_of_mut(&mut code).copy_from_slice(bytes);
                swap_to_little_endian::<C::Code>(bytes_of_mut(&mut code));
                C::decode(code)
            },
        }
    }
}

fn to_bytes<C: Codec>(code: C::Code) -> [u8; CODE] {
    let mut bytes = [0; CODE];
    let own = &mut bytes[..size_of::<C::Code>()];
    own.copy_from_slice(bytes_of(&code));
    swap_to_little_endian::<C::Code>(own);
    bytes
}

/// A code is one integer or an array of them, as large as its alignment.
pub fn swap_to_little_endian<C>(bytes: &mut [u8]) {
    if cfg!(target_endian = "big") {
        bytes.chunks_exact_mut(align_of::<C>()).for_each(<[u8]>::reverse);
    }
}

fn encode(
    format: Format,
    one: &Singles,
    blocks: usize,
    batch: fn(Format, Soa<'_>, &mut [u8]) -> Result<(), LengthMismatch>,
    single: fn([f32; 3]) -> [u8; CODE],
) -> u64 {
    let size = format.code_size();
    let mut random = Random::new();
    let mut digest = Digest::new();
    let mut codes = [0; CODE * LEN];
    let codes = &mut codes[..size * LEN];
    for _ in 0..blocks {
        let vectors: [[f32; 3]; LEN] =
            array::from_fn(|_| random.vector(size, format.bits(), one.decode));
        let [x, y, z] = [0, 1, 2].map(|c: usize| vectors.map(|v| v[c]));
        batch(format, Soa { x: &x, y: &y, z: &z }, codes).expect("lengths that fit");
        digest_codes(format, codes, &mut digest);
        for v in vectors {
            digest_codes(format, &mut single(v)[..size], &mut digest);
        }
    }
    digest.finish()
}

/// Codes of float32x3 are floats, with NaN among them.
fn digest_codes(format: Format, codes: &mut [u8], digest: &mut Digest) {
    if format == Format::Float32x3 {
        for bytes in codes.chunks_exact(4) {
            digest.floats(&[f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])]);
        }
    } else {
        digest.bytes(codes);
    }
}

fn decode(format: Format, one: &Singles) -> u64 {
    let size = format.code_size();
    let mut random = Random::new();
    let mut digest = Digest::new();
    let mut codes = [0; CODE * LEN];
    let codes = &mut codes[..size * LEN];
    let [mut x, mut y, mut z] = [[0.0; LEN]; 3];
    for _ in 0..BLOCKS {
        random.codes(size, codes);
        let vectors = SoaMut { x: &mut x, y: &mut y, z: &mut z };
        format.decode(codes, vectors).expect("lengths that fit");
        for component in [&x, &y, &z] {
            digest.floats(component);
        }
        for code in codes.chunks_exact(size) {
            digest.floats(&(one.decode)(code));
        }
    }
    digest.finish()
}

/// Gives the digest of a codec's codes mirrored in each axis, and negated.
struct Mirrored;

impl Visitor for Mirrored {
    type Output = u64;
    fn visit<C: Codec>(self) -> u64 {
        let size = size_of::<C::Code>();
        let mut bytes = [0; CODE * LEN];
        Random::new().codes(size, &mut bytes[..size * LEN]);
        let mut codes = [C::Code::zeroed(); LEN];
        for (code, bytes) in codes.iter_mut().zip(bytes.chunks_exact(size)) {
            bytes_of_mut(code).copy_from_slice(bytes);
            swap_to_little_endian::<C::Code>(bytes_of_mut(code));
        }
        let mut digest = Digest::new();
        let mut add = |codes: [C::Code; LEN]| {
            codes.iter().for_each(|code| {
                digest_codes(C::FORMAT, &mut to_bytes::<C>(*code)[..size], &mut digest)
            });
        };
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let mut many = codes;
            C::mirror_slice(&mut many, axis);
            add(many);
            add(codes.map(|code| C::mirror(code, axis)));
        }
        add(codes.map(C::negate));
        C::negate_slice(&mut codes);
        add(codes);
        digest.finish()
    }
}
