//! The digests of what stands beside the codecs: scalars, angles, quaternions, packing and tables, encoding and
//! decoding.

use core::array;

use bytemuck::{Pod, Zeroable, bytes_of, bytes_of_mut};
use unitpack::decode_table::{OctantTable, SignSymmetric};
use unitpack::dither::{Dither, StochasticRounding};
use unitpack::frame::{
    Frame, FrameCodec, FrameSoa, FrameSoaMut, OctAngle32, OctAngle64, OctAngleFormat, QTangent64,
    basis,
};
use unitpack::low_dimensions::Angle;
use unitpack::packing::{
    dense_len, pack_dense, pack_snorm12x2, pack_snorm12x2_slice, unpack_dense, unpack_snorm12x2,
    unpack_snorm12x2_slice,
};
use unitpack::quaternion::{
    QuaternionCodec, QuaternionFormat, SmallestThree32, SmallestThree48, SmallestThree64, Soa4,
    Soa4Mut, TanThree32,
};
use unitpack::scalar::{BiasedUnorm, Fixed, Scalar, Snorm, Unorm};
use unitpack::{
    CodeInt, Codec, Format, HemiOct16, Oct16, Oct24, OrNone, Snorm8x3, Snorm16x3, SnormFormat, Soa,
    SoaMut, SphericalFibonacci, WarpedCube16, for_each_codec,
};

use crate::LEN;
use crate::codecs::swap_to_little_endian;
use crate::digest::Digest;
use crate::inputs::Random;
use crate::platform::line;

pub fn report() {
    let mut row = Row::new();
    row.scalar::<Unorm<2>>().scalar::<Unorm<8>>().scalar::<Unorm<16>>().scalar::<Unorm<24>>();
    row.print("unorm");
    let mut row = Row::new();
    row.scalar::<Snorm<2>>().scalar::<Snorm<8>>().scalar::<Snorm<16>>().scalar::<Snorm<24>>();
    row.print("snorm");
    let mut row = Row::new();
    row.scalar::<BiasedUnorm<2>>().scalar::<BiasedUnorm<8>>();
    row.scalar::<BiasedUnorm<16>>().scalar::<BiasedUnorm<24>>();
    row.print("biased-unorm");
    let mut row = Row::new();
    row.scalar::<Fixed<2>>().scalar::<Fixed<8>>().scalar::<Fixed<16>>().scalar::<Fixed<24>>();
    row.print("fixed");
    let mut row = Row::new();
    row.angle::<1>().angle::<2>().angle::<8>().angle::<13>().angle::<24>();
    row.print("angle");
    Row::quaternion::<SmallestThree32>();
    Row::quaternion::<SmallestThree48>();
    Row::quaternion::<SmallestThree64>();
    Row::quaternion::<TanThree32>();
    let mut row = Row::new();
    for bits in [4, 7, 9, 12, 15, 20] {
        row.quaternion_format(QuaternionFormat::smallest_three(bits).expect("4 to 20"), true);
    }
    // The nearest takes as many steps as there are lengths.
    for bits in [4, 5, 6, 8, 11, 12, 16] {
        row.quaternion_format(QuaternionFormat::snorm(bits).expect("4 to 16"), bits <= 11);
    }
    row.print("quaternion-formats");
    let mut row = Row::new();
    for bits in [4, 7, 9, 11, 14] {
        row.snorm_format(SnormFormat::new(bits).expect("4 to 16"), bits <= 11);
    }
    row.print("snorm-formats");
    let mut row = Row::new();
    row.or_none::<Oct16>().or_none::<Oct24>().or_none::<Snorm8x3>().or_none::<Snorm16x3>();
    row.print("or-none");
    let mut row = Row::new();
    row.parameters();
    row.print("parameters");
    let mut row = Row::new();
    row.fibonacci(1).fibonacci(21).fibonacci(1000).fibonacci(1 << 20).fibonacci(1 << 24);
    row.print("fibonacci");
    let mut row = Row::new();
    row.dither::<Oct16>().dither::<HemiOct16>().dither::<WarpedCube16>();
    macro_rules! stochastic {
        ($name:ident) => {
            row.stochastic::<unitpack::$name>();
        };
    }
    for_each_codec!(stochastic: stochastic);
    row.print("dither");
    frames::<OctAngle32>();
    frames::<OctAngle64>();
    frames::<QTangent64>();
    let mut row = Row::new();
    for (oct, angle) in
        [(8, 7), (14, 1), (12, 9), (24, 7), (30, 2), (24, 15), (32, 15), (20, 24), (32, 31)]
    {
        row.frame_split(OctAngleFormat::new(oct, angle).expect("a split that there is"));
    }
    row.print("octangle-splits");
    let mut row = Row::new();
    row.snorm12x2();
    row.print("snorm12x2");
    let mut row = Row::new();
    row.dense::<7, u8>().dense::<12, u16>().dense::<22, u32>();
    row.print("dense");
    let mut row = Row::new();
    macro_rules! octant_table {
        ($name:ident) => {
            row.octant_table::<unitpack::$name>();
        };
    }
    for_each_codec!(octant: octant_table);
    // Tables only decode.
    line(format_args!("{:20} {:16} {:016x}", "octant-table", "", row.decode.finish()));
}

/// The line of one codec of frames.
fn frames<C: FrameCodec>() {
    let mut row = Row::new();
    for _ in 0..16 {
        row.frames::<C>();
    }
    row.print(C::NAME);
}

/// Of little-endian bytes.
fn integer(bytes: &[u8]) -> u64 {
    let mut word = [0; 8];
    word[..bytes.len()].copy_from_slice(bytes);
    u64::from_le_bytes(word)
}

/// As little-endian bytes.
fn digest_codes<C: Pod>(codes: &[C], digest: &mut Digest) {
    for &(mut code) in codes {
        swap_to_little_endian::<C>(bytes_of_mut(&mut code));
        digest.bytes(bytes_of(&code));
    }
}

/// The digests of one line. Every method adds some inputs.
struct Row {
    random: Random,
    encode: Digest,
    decode: Digest,
}

impl Row {
    fn new() -> Self {
        Row { random: Random::new(), encode: Digest::new(), decode: Digest::new() }
    }

    fn print(self, name: &str) {
        let (encode, decode) = (self.encode.finish(), self.decode.finish());
        line(format_args!("{name:20} {encode:016x} {decode:016x}"));
    }

    fn numbers(&mut self) -> [f32; LEN] {
        array::from_fn(|_| self.random.number())
    }

    fn words(&mut self) -> [u32; LEN] {
        array::from_fn(|_| self.random.bits())
    }

    fn codes<C: CodeInt>(&mut self) -> [C; LEN] {
        self.words().map(C::truncate)
    }

    fn scalar<S: Scalar>(&mut self) -> &mut Self {
        let values = self.numbers();
        let mut codes = [0; LEN];
        S::encode_slice::<u32>(&values, &mut codes).expect("lengths that fit");
        self.encode.words(codes);
        self.encode.words(values.map(S::encode));

        let codes = self.words();
        let mut values = [0.0; LEN];
        S::decode_slice(&codes, &mut values).expect("lengths that fit");
        self.decode.floats(&values);
        self.decode.floats(&codes.map(S::decode));
        self
    }

    fn angle<const BITS: u32>(&mut self) -> &mut Self {
        let vectors: [[f32; 2]; LEN] = array::from_fn(|_| self.random.pair());
        let [x, y] = [0, 1].map(|c: usize| vectors.map(|v| v[c]));
        let mut codes = [0; LEN];
        Angle::<BITS>::encode_soa::<u32>(&x, &y, &mut codes).expect("lengths that fit");
        self.encode.words(codes);
        self.encode.words(vectors.map(Angle::<BITS>::encode));

        let codes = self.words();
        let [mut x, mut y] = [[0.0; LEN]; 2];
        Angle::<BITS>::decode_soa(&codes, &mut x, &mut y).expect("lengths that fit");
        self.decode.floats(&x);
        self.decode.floats(&y);
        self.decode.floats(codes.map(Angle::<BITS>::decode).as_flattened());
        self
    }

    fn fibonacci(&mut self, points: u32) -> &mut Self {
        let points = SphericalFibonacci::new(points).expect("a number in range");
        let [x, y, z] = [(); 3].map(|()| self.numbers());
        let mut indices = [0; LEN];
        points.encode_soa(Soa { x: &x, y: &y, z: &z }, &mut indices).expect("lengths that fit");
        self.encode.words(indices);
        self.encode.words(array::from_fn::<_, LEN, _>(|i| points.encode([x[i], y[i], z[i]])));

        let indices = self.words().map(|bits| bits % (points.points() + 1));
        let [mut x, mut y, mut z] = [[0.0; LEN]; 3];
        let v = SoaMut { x: &mut x, y: &mut y, z: &mut z };
        points.decode_soa(&indices, v).expect("lengths that fit");
        for component in [&x, &y, &z] {
            self.decode.floats(component);
        }
        self.decode.floats(indices.map(|i| points.decode(i)).as_flattened());
        self
    }

    fn dither<C: Codec<Code = u16>>(&mut self) -> &mut Self {
        let dither = Dither::new(5);
        let [x, y, z] = [(); 3].map(|()| self.numbers());
        let v = Soa { x: &x, y: &y, z: &z };
        let mut codes = [0; LEN];
        dither.encode_soa::<C>(u32::MAX - 10, v, &mut codes).expect("lengths that fit");
        self.encode.words(codes.map(u32::from));

        let [mut x, mut y, mut z] = [[0.0; LEN]; 3];
        let v = SoaMut { x: &mut x, y: &mut y, z: &mut z };
        dither.decode_soa::<C>(u32::MAX - 10, &codes, v).expect("lengths that fit");
        for component in [&x, &y, &z] {
            self.decode.floats(component);
        }
        self
    }

    fn stochastic<C: StochasticRounding>(&mut self) -> &mut Self {
        let [x, y, z] = [(); 3].map(|()| self.numbers());
        let v = Soa { x: &x, y: &y, z: &z };
        let mut codes = [C::Code::zeroed(); LEN];
        let dither = Dither::new(6);
        dither.encode_soa_stochastic::<C>(9, v, &mut codes).expect("lengths that fit");
        digest_codes(&codes, &mut self.encode);
        self
    }

    fn quaternion<C: QuaternionCodec>() {
        let mut row = Row::new();
        for _ in 0..8 {
            row.quaternion_block::<C>();
        }
        row.print(C::NAME);
    }

    fn quaternion_format(&mut self, format: QuaternionFormat, precise: bool) {
        let mut decoded = [0.0; 4];
        let q: [[f32; 4]; LEN] = array::from_fn(|i| {
            match i % 3 {
                // Any, two of a pair opposite, and on the grid.
                0 => decoded = array::from_fn(|_| self.random.number()),
                1 => decoded[i % 4] = -decoded[(i + 1) % 4],
                _ => {
                    let mut code = [0; 8];
                    self.random.codes(8, &mut code);
                    decoded = format.decode(u64::from_le_bytes(code));
                }
            }
            decoded
        });
        let [x, y, z, w] = [0, 1, 2, 3].map(|c: usize| q.map(|q| q[c]));
        let soa = Soa4 { x: &x, y: &y, z: &z, w: &w };
        let mut bytes = [0; 8 * LEN];
        let bytes = &mut bytes[..format.code_size() * LEN];
        format.encode_soa(soa, bytes).expect("lengths that fit");
        self.encode.bytes(bytes);
        for q in q {
            self.encode.bytes(&format.encode(q).to_le_bytes());
        }
        if precise {
            format.encode_soa_precise(soa, bytes).expect("lengths that fit");
            self.encode.bytes(bytes);
            for &q in q.iter().step_by(16) {
                self.encode.bytes(&format.encode_precise(q).to_le_bytes());
            }
        }

        self.random.codes(format.code_size(), bytes);
        let [mut x, mut y, mut z, mut w] = [[0.0; LEN]; 4];
        let soa = Soa4Mut { x: &mut x, y: &mut y, z: &mut z, w: &mut w };
        format.decode_soa(bytes, soa).expect("lengths that fit");
        for component in [&x, &y, &z, &w] {
            self.decode.floats(component);
        }
        let mut track = q;
        format.decode_track(bytes, q[0], &mut track).expect("lengths that fit");
        self.decode.floats(track.as_flattened());
        for code in bytes.chunks_exact(format.code_size()) {
            let code = integer(code);
            self.decode.floats(&format.decode(code));
            if precise {
                self.decode.bytes(&format.canonical(code).to_le_bytes());
            }
        }
    }

    fn snorm_format(&mut self, format: SnormFormat, precise: bool) {
        let [x, y, z] = [(); 3].map(|()| self.numbers());
        let v = Soa { x: &x, y: &y, z: &z };
        let mut bytes = [0; 8 * LEN];
        let bytes = &mut bytes[..format.code_size() * LEN];
        format.encode_soa(v, bytes).expect("lengths that fit");
        self.encode.bytes(bytes);
        if precise {
            format.encode_soa_precise(v, bytes).expect("lengths that fit");
            self.encode.bytes(bytes);
        }
        self.random.codes(format.code_size(), bytes);
        let [mut x, mut y, mut z] = [[0.0; LEN]; 3];
        let v = SoaMut { x: &mut x, y: &mut y, z: &mut z };
        format.decode_soa(bytes, v).expect("lengths that fit");
        for component in [&x, &y, &z] {
            self.decode.floats(component);
        }
        for code in bytes.chunks_exact(format.code_size()) {
            let v = format.decode(integer(code));
            self.decode.floats(&v);
            self.encode.bytes(&format.encode(v).to_le_bytes());
        }
    }

    fn or_none<C: Codec>(&mut self) -> &mut Self {
        let v: [[f32; 3]; LEN] = array::from_fn(|i| match i % 5 {
            0 => [0.0; 3],
            1 => [f32::NAN, 1.0, 0.0],
            _ => [(); 3].map(|()| self.random.number()),
        });
        let mut codes = [C::Code::zeroed(); LEN];
        OrNone::<C>::encode_aos(&v, &mut codes).expect("lengths that fit");
        digest_codes(&codes, &mut self.encode);
        digest_codes(&v.map(OrNone::<C>::encode_precise), &mut self.encode);
        let mut v = [[0.0; 3]; LEN];
        OrNone::<C>::decode_aos(&codes, &mut v).expect("lengths that fit");
        self.decode.floats(v.as_flattened());
        OrNone::<C>::negate_slice(&mut codes);
        digest_codes(&codes, &mut self.decode);
        self
    }

    fn parameters(&mut self) {
        for &format in Format::ALL {
            let [code, u, v] = [(); 3].map(|()| self.random.bits());
            if let Some(parameters) = format.parameters(code) {
                self.decode.words(parameters.map(|p| p as u32));
            }
            for shift in [0, 16, 26] {
                let parameters = [u, v].map(|bits| bits as i32 >> shift);
                self.encode.words([format.from_parameters(parameters).unwrap_or(u32::MAX)]);
            }
            self.encode.bytes(format.none().unwrap_or_default());
        }
    }

    fn quaternion_block<C: QuaternionCodec>(&mut self) {
        let random = &mut self.random;
        let mut near = [0.0; 4];
        let q: [[f32; 4]; LEN] = array::from_fn(|i| {
            match i % 4 {
                // Any, and two of a pair equal.
                0 => near = array::from_fn(|_| random.number()),
                1 => near.rotate_left(1),
                2 => near[i / 4 % 4] = -near[(i / 4 + 1) % 4],
                _ => {
                    // On the grid.
                    let mut code = C::Code::zeroed();
                    random.codes(size_of::<C::Code>(), bytes_of_mut(&mut code));
                    near = C::decode(native::<C>(code));
                }
            }
            near
        });
        let [x, y, z, w] = [0, 1, 2, 3].map(|c: usize| q.map(|q| q[c]));
        let soa = Soa4 { x: &x, y: &y, z: &z, w: &w };
        let mut codes = [C::Code::zeroed(); LEN];
        C::encode_soa(soa, &mut codes).expect("lengths that fit");
        digest_codes(&codes, &mut self.encode);
        C::encode_soa_precise(soa, &mut codes).expect("lengths that fit");
        digest_codes(&codes, &mut self.encode);
        C::encode_aos(&q, &mut codes).expect("lengths that fit");
        digest_codes(&codes, &mut self.encode);
        digest_codes(&q.map(C::encode), &mut self.encode);
        digest_codes(&q.map(C::encode_precise), &mut self.encode);

        for code in &mut codes {
            self.random.codes(size_of::<C::Code>(), bytes_of_mut(code));
            *code = native::<C>(*code);
        }
        digest_codes(&codes.map(C::canonical), &mut self.encode);
        let [mut x, mut y, mut z, mut w] = [[0.0; LEN]; 4];
        let soa = Soa4Mut { x: &mut x, y: &mut y, z: &mut z, w: &mut w };
        C::decode_soa(&codes, soa).expect("lengths that fit");
        for component in [&x, &y, &z, &w] {
            self.decode.floats(component);
        }
        let mut q = [[0.0; 4]; LEN];
        C::decode_aos(&codes, &mut q).expect("lengths that fit");
        self.decode.floats(q.as_flattened());
        self.decode.floats(codes.map(C::decode).as_flattened());
    }

    /// A frame of any kind: its tangent any, across the normal or parallel to it.
    fn frame(&mut self) -> Frame {
        let [normal, any] = [(); 2].map(|()| [(); 3].map(|()| self.random.number()));
        let [x, y, z] = normal;
        let tangent = match self.random.bits() >> 30 {
            0 => [-y, x, 0.0],
            1 => [x + 1e-6 * any[0], y, z],
            _ => any,
        };
        Frame { normal, tangent, handedness: self.random.number() }
    }

    fn frames<C: FrameCodec>(&mut self) {
        let frames: [Frame; LEN] = array::from_fn(|_| self.frame());
        let [nx, ny, nz] = [0, 1, 2].map(|i: usize| frames.map(|f| f.normal[i]));
        let [tx, ty, tz] = [0, 1, 2].map(|i: usize| frames.map(|f| f.tangent[i]));
        let (normal, tangent) = (Soa { x: &nx, y: &ny, z: &nz }, Soa { x: &tx, y: &ty, z: &tz });
        let soa = FrameSoa { normal, tangent, handedness: &frames.map(|f| f.handedness) };
        let mut codes = [C::Code::zeroed(); LEN];
        for (encode, single) in [
            (C::encode_soa as fn(_, &mut [_]) -> _, C::encode as fn(_) -> _),
            (C::encode_soa_precise, C::encode_precise),
        ] {
            let skew = encode(soa, &mut codes).expect("lengths that fit");
            digest_codes(&codes, &mut self.encode);
            self.encode.words([skew.index as u32]);
            self.encode.floats(&[skew.degrees]);
            digest_codes(&frames.map(single), &mut self.encode);
        }

        let mut patterns = [0; 8 * LEN];
        let size = size_of::<C::Code>();
        self.random.codes(size, &mut patterns[..size * LEN]);
        for (code, bytes) in codes.iter_mut().zip(patterns.chunks_exact(size)) {
            bytes_of_mut(code).copy_from_slice(bytes);
            swap_to_little_endian::<C::Code>(bytes_of_mut(code));
        }
        let [mut nx, mut ny, mut nz] = [[0.0; LEN]; 3];
        let [mut tx, mut ty, mut tz] = [[0.0; LEN]; 3];
        let mut handedness = [0.0; LEN];
        let soa = FrameSoaMut {
            normal: SoaMut { x: &mut nx, y: &mut ny, z: &mut nz },
            tangent: SoaMut { x: &mut tx, y: &mut ty, z: &mut tz },
            handedness: &mut handedness,
        };
        C::decode_soa(&codes, soa).expect("lengths that fit");
        for column in [&nx, &ny, &nz, &tx, &ty, &tz, &handedness] {
            self.decode.floats(column);
        }
        for frame in codes.map(C::decode) {
            self.decode.floats(&frame.normal);
            self.decode.floats(&frame.tangent);
            self.decode.floats(&[frame.handedness]);
        }
        digest_codes(&codes.map(C::canonical), &mut self.decode);
    }

    fn frame_split(&mut self, format: OctAngleFormat) {
        let frames: [Frame; LEN] = array::from_fn(|_| self.frame());
        let [nx, ny, nz] = [0, 1, 2].map(|i: usize| frames.map(|f| f.normal[i]));
        let [tx, ty, tz] = [0, 1, 2].map(|i: usize| frames.map(|f| f.tangent[i]));
        let (normal, tangent) = (Soa { x: &nx, y: &ny, z: &nz }, Soa { x: &tx, y: &ty, z: &tz });
        let soa = FrameSoa { normal, tangent, handedness: &frames.map(|f| f.handedness) };
        let mut bytes = [0; 8 * LEN];
        let bytes = &mut bytes[..format.code_size() * LEN];
        let skew = format.encode_soa(soa, bytes).expect("lengths that fit");
        self.encode.bytes(bytes);
        self.encode.words([skew.index as u32]);
        self.encode.floats(&[skew.degrees]);
        format.encode_soa_precise(soa, bytes).expect("lengths that fit");
        self.encode.bytes(bytes);
        for frame in frames {
            self.encode.bytes(&format.encode(frame).to_le_bytes());
            self.encode.bytes(&format.encode_precise(frame).to_le_bytes());
        }

        self.random.codes(format.code_size(), bytes);
        let [mut nx, mut ny, mut nz] = [[0.0; LEN]; 3];
        let [mut tx, mut ty, mut tz] = [[0.0; LEN]; 3];
        let mut handedness = [0.0; LEN];
        let soa = FrameSoaMut {
            normal: SoaMut { x: &mut nx, y: &mut ny, z: &mut nz },
            tangent: SoaMut { x: &mut tx, y: &mut ty, z: &mut tz },
            handedness: &mut handedness,
        };
        format.decode_soa(bytes, soa).expect("lengths that fit");
        for column in [&nx, &ny, &nz, &tx, &ty, &tz, &handedness] {
            self.decode.floats(column);
        }
        for code in bytes.chunks_exact(format.code_size()) {
            let code = integer(code);
            let frame = format.decode(code);
            self.decode.floats(&frame.normal);
            self.decode.floats(&frame.tangent);
            self.decode.floats(basis(frame.normal).as_flattened());
            let (u, v, angle, negative) = format.parameters(code);
            self.decode.words([u as u32, v as u32, angle, u32::from(negative)]);
            self.decode.bytes(&format.from_parameters(u, v, angle, negative).to_le_bytes());
            self.decode.bytes(&format.canonical(code).to_le_bytes());
        }
    }

    fn snorm12x2(&mut self) {
        let pairs: [[f32; 2]; LEN] = array::from_fn(|_| self.random.pair());
        let mut texels = [[0; 3]; LEN];
        pack_snorm12x2_slice(&pairs, &mut texels).expect("lengths that fit");
        self.encode.bytes(texels.as_flattened());
        self.encode.bytes(pairs.map(pack_snorm12x2).as_flattened());

        self.random.codes(3, texels.as_flattened_mut());
        let mut pairs = [[0.0; 2]; LEN];
        unpack_snorm12x2_slice(&texels, &mut pairs).expect("lengths that fit");
        self.decode.floats(pairs.as_flattened());
        self.decode.floats(texels.map(unpack_snorm12x2).as_flattened());
    }

    fn dense<const BITS: u32, C: CodeInt>(&mut self) -> &mut Self {
        let mut codes = self.codes::<C>();
        let mut bytes = [0; 4 * LEN];
        let bytes = &mut bytes[..dense_len(BITS, LEN)];
        pack_dense::<BITS, C>(&codes, bytes).expect("lengths that fit");
        self.encode.bytes(bytes);

        self.random.codes(1, bytes);
        unpack_dense::<BITS, C>(bytes, &mut codes).expect("lengths that fit");
        self.decode.words(codes.map(C::into));
        self
    }

    fn octant_table<C: SignSymmetric>(&mut self) -> &mut Self {
        let mut table = [[0.0; 3]; 1 << 14];
        let table = &mut table[..OctantTable::<C>::LEN];
        let table = OctantTable::<C>::fill(table).expect("a length that fits");
        let mut codes = [C::Code::zeroed(); LEN];
        for code in &mut codes {
            *code = C::encode([(); 3].map(|()| self.random.number()));
        }
        let [mut x, mut y, mut z] = [[0.0; LEN]; 3];
        let vectors = SoaMut { x: &mut x, y: &mut y, z: &mut z };
        table.decode_soa(&codes, vectors).expect("lengths that fit");
        for component in [&x, &y, &z] {
            self.decode.floats(component);
        }
        self.decode.floats(codes.map(|code| table.decode(code)).as_flattened());
        self
    }
}

/// A code from little-endian bytes, or back to them.
fn native<C: QuaternionCodec>(mut code: C::Code) -> C::Code {
    swap_to_little_endian::<C::Code>(bytes_of_mut(&mut code));
    code
}
