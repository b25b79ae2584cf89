//! What the targets share: how bytes become an input, and every codec behind pointers.
//!
//! The oracle is the tests' own, in f64. It shares nothing with the crate.

#[path = "../../tests/common/mod.rs"]
pub mod common;

use std::sync::{LazyLock, OnceLock};

pub use common::every_code::{code as native, integer};
use common::oracle::{Oracle, oracle};
use unitpack::frame::{Frame, FrameSoa, FrameSoaMut};
use unitpack::{
    Axis, Codec, Float32x3, Format, LengthMismatch, Oct8, Oct16, Oct24, Oct32, Snorm16x3, Soa,
    SoaMut, Visitor, transcode,
};

pub type Vector = [f32; 3];
/// A code as a little-endian integer.
pub type Code = u128;
pub type Outcome = Result<(), LengthMismatch>;

/// Angle that is put down to the rounding of f32, in radians.
pub const ROUNDING: f64 = 3e-7;

/// What is left of the input.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// The next ones; zeros after the end.
    pub fn take<const N: usize>(&mut self) -> [u8; N] {
        let (now, later) = self.0.split_at(self.0.len().min(N));
        self.0 = later;
        std::array::from_fn(|i| now.get(i).copied().unwrap_or(0))
    }

    pub fn byte(&mut self) -> u8 {
        self.take::<1>()[0]
    }

    /// Up to `most`.
    pub fn length(&mut self, most: usize) -> usize {
        usize::from(self.byte()) % (most + 1)
    }

    pub fn float(&mut self) -> f32 {
        f32::from_le_bytes(self.take())
    }

    /// One of them.
    pub fn choose<'t, T>(&mut self, from: &'t [T]) -> &'t T {
        &from[usize::from(self.byte()) % from.len()]
    }

    /// All that is left, in pieces of so many bytes; a part of one is filled with zeros.
    pub fn rest<const N: usize>(&mut self) -> Vec<[u8; N]> {
        let count = self.0.len().div_ceil(N);
        (0..count).map(|_| self.take()).collect()
    }

    /// So many items from what is left: each from `N` bytes and the number of the turn, as the bytes
    /// are taken over again where there are too few.
    fn items<T, const N: usize>(
        &mut self,
        count: usize,
        item: impl Fn([u8; N], usize) -> T,
    ) -> Vec<T> {
        let mut given = self.rest::<N>();
        given.resize(given.len().max(1), [0x3F; N]);
        (0..count).map(|i| item(given[i % given.len()], i / given.len())).collect()
    }
}

/// Vectors as a structure of arrays.
#[derive(Clone, PartialEq, Debug)]
pub struct Arrays(pub [Vec<f32>; 3]);

impl Arrays {
    /// Of the lengths, of a number that stands for memory not yet written.
    pub fn unwritten(lengths: [usize; 3]) -> Self {
        Arrays(lengths.map(|length| vec![UNWRITTEN; length]))
    }

    pub fn read(&self) -> Soa<'_> {
        let [x, y, z] = &self.0;
        Soa { x, y, z }
    }

    pub fn write(&mut self) -> SoaMut<'_> {
        let [x, y, z] = &mut self.0;
        SoaMut { x, y, z }
    }

    pub fn vectors(&self) -> Vec<Vector> {
        let [x, y, z] = &self.0;
        (0..x.len()).map(|i| [x[i], y[i], z[i]]).collect()
    }
}

/// Frames as a structure of arrays: normals, tangents and handednesses.
#[derive(Clone, PartialEq, Debug)]
pub struct FrameArrays(pub [Vec<f32>; 7]);

impl FrameArrays {
    /// Of the lengths, of a number that stands for memory not yet written.
    pub fn unwritten(lengths: [usize; 7]) -> Self {
        FrameArrays(lengths.map(|length| vec![UNWRITTEN; length]))
    }

    pub fn read(&self) -> FrameSoa<'_> {
        let [nx, ny, nz, tx, ty, tz, handedness] = &self.0;
        let (normal, tangent) = (Soa { x: nx, y: ny, z: nz }, Soa { x: tx, y: ty, z: tz });
        FrameSoa { normal, tangent, handedness }
    }

    pub fn write(&mut self) -> FrameSoaMut<'_> {
        let [nx, ny, nz, tx, ty, tz, handedness] = &mut self.0;
        let (normal, tangent) = (SoaMut { x: nx, y: ny, z: nz }, SoaMut { x: tx, y: ty, z: tz });
        FrameSoaMut { normal, tangent, handedness }
    }
}

impl From<&[Frame]> for FrameArrays {
    fn from(frames: &[Frame]) -> Self {
        FrameArrays([0, 1, 2, 3, 4, 5, 6].map(|i| {
            let component = |f: &Frame| match i {
                0..3 => f.normal[i],
                3..6 => f.tangent[i - 3],
                _ => f.handedness,
            };
            frames.iter().map(component).collect()
        }))
    }
}

impl From<&[Vector]> for Arrays {
    fn from(vectors: &[Vector]) -> Self {
        Arrays([0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect()))
    }
}

/// A float that no decoder gives, not even that of `Float32x3` but for one input in 2^32.
pub const UNWRITTEN: f32 = -7.252_952_6e22;

pub fn bits(v: Vector) -> [u32; 3] {
    v.map(f32::to_bits)
}

/// The bits of all.
pub fn all_bits(vectors: &[Vector]) -> Vec<[u32; 3]> {
    vectors.iter().copied().map(bits).collect()
}

/// Arrays of structures of `floats` each.
pub struct Aos {
    pub floats: usize,
    pub encode: fn(&[f32], &mut [Code]) -> Outcome,
    pub encode_precise: fn(&[f32], &mut [Code]) -> Outcome,
    pub decode: fn(&[Code], &mut [f32]) -> Outcome,
}

/// Codes of one format to codes of another.
pub struct Transcode {
    pub from: Format,
    pub to: Format,
    pub run: fn(&[Code], &mut [Code]) -> Outcome,
}

/// Something that is made of codes without vectors.
pub struct Operation {
    /// Which components of the vectors it negates.
    pub negates: [bool; 3],
    pub one: fn(Code) -> Code,
    pub slice: fn(&mut [Code]),
}

/// A codec's functions, which are so compiled once and not for every target.
pub struct AnyCodec {
    pub format: Format,
    pub encode: fn(Vector) -> Code,
    pub encode_precise: fn(Vector) -> Code,
    pub decode: fn(Code) -> Vector,
    pub canonical: fn(Code) -> Code,
    pub operations: [Operation; 5],
    pub same_direction: fn(Code, Code) -> bool,
    pub encode_soa: fn(Soa<'_>, &mut [Code]) -> Outcome,
    pub encode_soa_precise: fn(Soa<'_>, &mut [Code]) -> Outcome,
    pub decode_soa: fn(&[Code], SoaMut<'_>) -> Outcome,
    pub aos: [Aos; 3],
    /// From and to one format of each type of code: all pairs would be as many functions as the
    /// square of the table.
    pub transcode: [Transcode; 12],
    oracle: OnceLock<Oracle>,
}

impl AnyCodec {
    /// The next byte chooses.
    pub fn choose(bytes: &mut Bytes<'_>) -> &'static AnyCodec {
        Self::of(*bytes.choose(Format::ALL))
    }

    pub fn of(format: Format) -> &'static AnyCodec {
        static ALL: LazyLock<Vec<AnyCodec>> =
            LazyLock::new(|| Format::ALL.iter().map(|format| format.visit(Erase)).collect());
        &ALL[format as usize]
    }

    pub fn oracle(&self) -> &Oracle {
        self.oracle.get_or_init(|| oracle(self.format.name()).expect("every format has an oracle"))
    }

    /// So many vectors, from what is left: of any bits, of any direction, or about half way between
    /// two codes.
    pub fn vectors(&self, bytes: &mut Bytes<'_>, count: usize) -> Vec<Vector> {
        let kind = bytes.byte() % 3;
        bytes.items(count, |item: [u8; 12], turn| {
            let mut v: Vector = match kind {
                0 => bytemuck::cast(item),
                1 => bytemuck::cast::<_, [i32; 3]>(item).map(|i| i as f32 / 2f32.powi(31)),
                _ => {
                    let code = u128::from_le_bytes(std::array::from_fn(|i| item[i % 12]));
                    let other = code ^ 1 << (u32::from(item[11]) % self.format.bits());
                    let [v, w] = [code, other].map(self.decode);
                    [v[0] + w[0], v[1] + w[1], v[2] + w[2]]
                }
            };
            // No two turns give the same.
            v.rotate_left(turn % 3);
            if turn / 3 % 2 == 1 { v.map(|c| -c) } else { v }
        })
    }

    /// So many codes, from what is left: of any bits, or that of a vector but for one bit.
    pub fn codes(&self, bytes: &mut Bytes<'_>, count: usize) -> Vec<Code> {
        let near = bytes.byte() % 2 == 1;
        let mask = common::last_pattern(self.format);
        if near {
            bytes.items(count, |item: [u8; 13], turn| {
                let v = bytemuck::pod_read_unaligned(&item[..12]);
                let bit = (usize::from(item[12]) + turn) % self.format.bits() as usize;
                (self.encode)(v) ^ 1 << bit
            })
        } else {
            // As many bytes as a code has, so that a dictionary's fit.
            let size = self.format.code_size();
            let given: Vec<Code> = bytes.0.chunks(size).map(integer_of).chain([1]).collect();
            let mixed = |turn| turn as Code * 0x9E37_79B9_7F4A_7C15_F39C;
            let code = |i| given[i % given.len()] ^ mixed(i / given.len()) & mask;
            (0..count).map(code).collect()
        }
    }

    /// How many vectors, up to a hundred: a block and a bit where the precise search takes
    /// up to 200 us for one and not 10.
    pub fn count(&self, bytes: &mut Bytes<'_>) -> usize {
        bytes.length(if self.is_finer_than_f32() { 18 } else { 100 })
    }

    /// Whether `f32` does not tell all codes apart: what decodes alike is then one direction.
    pub fn is_finer_than_f32(&self) -> bool {
        matches!(self.format, Format::Snorm16x3 | Format::XyzUnorm16x3 | Format::Float16x3)
    }

    /// Whether the format stores a direction. `Float32x3` gives its input back.
    pub fn stores_direction(&self) -> bool {
        self.format != Format::Float32x3
    }

    /// Stops unless an encoder gives this very code for what it decodes to.
    pub fn check_canonical(&self, code: Code) {
        let format = self.format;
        let decoded = (self.decode)(code);
        let again = (self.encode_precise)(decoded);
        if self.is_finer_than_f32() {
            let alike = (self.decode)(again);
            assert_eq!(bits(alike), bits(decoded), "{format} {code:x} became {again:x}");
            let third = (self.encode_precise)(alike);
            assert_eq!(third, again, "{format} {code:x} became {again:x}, then {third:x}");
        } else {
            assert_eq!(again, code, "{format} {code:x}, which is {decoded:?}, became {again:x}");
        }
    }
}

struct Erase;

impl Visitor for Erase {
    type Output = AnyCodec;
    fn visit<C: Codec>(self) -> AnyCodec {
        AnyCodec {
            format: C::FORMAT,
            encode: |v| integer(C::encode(v)),
            encode_precise: |v| integer(C::encode_precise(v)),
            decode: |i| C::decode(native(i)),
            canonical: |i| integer(C::canonical(native(i))),
            operations: [
                Operation {
                    negates: [false; 3],
                    one: |i| integer(C::canonical(native(i))),
                    slice: |codes| write_codes(codes, C::canonical_slice),
                },
                Operation {
                    negates: [true; 3],
                    one: |i| integer(C::negate(native(i))),
                    slice: |codes| write_codes(codes, C::negate_slice),
                },
                Operation {
                    negates: [true, false, false],
                    one: |i| integer(C::mirror(native(i), Axis::X)),
                    slice: |codes| write_codes(codes, |codes| C::mirror_slice(codes, Axis::X)),
                },
                Operation {
                    negates: [false, true, false],
                    one: |i| integer(C::mirror(native(i), Axis::Y)),
                    slice: |codes| write_codes(codes, |codes| C::mirror_slice(codes, Axis::Y)),
                },
                Operation {
                    negates: [false, false, true],
                    one: |i| integer(C::mirror(native(i), Axis::Z)),
                    slice: |codes| write_codes(codes, |codes| C::mirror_slice(codes, Axis::Z)),
                },
            ],
            same_direction: |a, b| C::same_direction(native(a), native(b)),
            encode_soa: |v, codes| write_codes(codes, |codes| C::encode_soa(v, codes)),
            encode_soa_precise: |v, codes| {
                write_codes(codes, |codes| C::encode_soa_precise(v, codes))
            },
            decode_soa: |codes, v| C::decode_soa(&natives(codes), v),
            aos: [aos::<C, 3>(), aos::<C, 4>(), aos::<C, 8>()],
            transcode: [
                convert::<C, Oct8>(),
                convert::<C, Oct16>(),
                convert::<C, Oct24>(),
                convert::<C, Oct32>(),
                convert::<C, Snorm16x3>(),
                convert::<C, Float32x3>(),
                convert::<Oct8, C>(),
                convert::<Oct16, C>(),
                convert::<Oct24, C>(),
                convert::<Oct32, C>(),
                convert::<Snorm16x3, C>(),
                convert::<Float32x3, C>(),
            ],
            oracle: OnceLock::new(),
        }
    }
}

fn aos<C: Codec, const N: usize>() -> Aos {
    Aos {
        floats: N,
        encode: |v, codes| write_codes(codes, |codes| C::encode_aos(v.as_chunks::<N>().0, codes)),
        encode_precise: |v, codes| {
            write_codes(codes, |codes| C::encode_aos_precise(v.as_chunks::<N>().0, codes))
        },
        decode: |codes, v| C::decode_aos(&natives(codes), v.as_chunks_mut::<N>().0),
    }
}

fn convert<A: Codec, B: Codec>() -> Transcode {
    Transcode {
        from: A::FORMAT,
        to: B::FORMAT,
        run: |src, dst| write_codes(dst, |dst| transcode::<A, B>(&natives(src), dst)),
    }
}

/// At most sixteen bytes.
fn integer_of(bytes: &[u8]) -> Code {
    bytes.iter().rev().fold(0, |code, &byte| code << 8 | Code::from(byte))
}

pub fn natives<T: bytemuck::Pod>(codes: &[Code]) -> Vec<T> {
    codes.iter().copied().map(native).collect()
}

/// Lets `write` change codes, and brings back what it left, whether it failed or not.
pub fn write_codes<T: bytemuck::Pod, R>(
    codes: &mut [Code],
    write: impl FnOnce(&mut [T]) -> R,
) -> R {
    let mut natives = natives::<T>(codes);
    let result = write(&mut natives);
    for (code, native) in codes.iter_mut().zip(natives) {
        *code = integer(native);
    }
    result
}
