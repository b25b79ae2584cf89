//! Codecs without their types.

use unitpack::{Axis, Codec, Format, Visitor};

use crate::Vector;
use crate::codes::{Code, integer, native};

/// The fast encoder or the precise one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// `encode`.
    Fast,
    /// `encode_precise`.
    Precise,
}

impl Effort {
    /// Both.
    pub const BOTH: [Effort; 2] = [Effort::Fast, Effort::Precise];
}

/// What is made of codes without vectors.
#[derive(Clone, Copy, Debug)]
pub enum Operation {
    /// `canonical`.
    Canonical,
    /// `negate`.
    Negate,
    /// `mirror`.
    Mirror(Axis),
}

impl Operation {
    /// All, the mirrors in the order of the axes.
    pub const ALL: [Operation; 5] = [
        Operation::Canonical,
        Operation::Negate,
        Operation::Mirror(Axis::X),
        Operation::Mirror(Axis::Y),
        Operation::Mirror(Axis::Z),
    ];

    /// What it makes of the vector.
    pub fn apply(self, v: Vector) -> Vector {
        let negated = match self {
            Operation::Canonical => [false; 3],
            Operation::Negate => [true; 3],
            Operation::Mirror(axis) => [Axis::X, Axis::Y, Axis::Z].map(|other| other == axis),
        };
        std::array::from_fn(|i| if negated[i] { -v[i] } else { v[i] })
    }
}

/// A codec's functions of one vector or code. There is one for every format.
pub struct AnyCodec {
    /// Which codec it is, as its type says.
    pub format: Format,
    /// How many bytes a code has, as its type says.
    pub code_size: usize,
    /// [`Codec::encode`].
    pub encode: fn(Vector) -> Code,
    /// [`Codec::encode_precise`].
    pub encode_precise: fn(Vector) -> Code,
    /// [`Codec::decode`].
    pub decode: fn(Code) -> Vector,
    /// [`Codec::canonical`].
    pub canonical: fn(Code) -> Code,
    /// [`Codec::is_canonical`].
    pub is_canonical: fn(Code) -> bool,
    /// [`Codec::negate`].
    pub negate: fn(Code) -> Code,
    /// [`Codec::mirror`].
    pub mirror: fn(Code, Axis) -> Code,
    /// [`Codec::same_direction`].
    pub same_direction: fn(Code, Code) -> bool,
}

impl AnyCodec {
    /// That of a format.
    #[inline]
    pub fn of(format: Format) -> &'static AnyCodec {
        format.visit(Erase)
    }

    /// Those of all formats.
    #[inline]
    pub fn all() -> impl Iterator<Item = &'static AnyCodec> {
        Format::ALL.iter().map(|&format| AnyCodec::of(format))
    }

    /// The code of one vector.
    pub fn encode_with(&self, effort: Effort, v: Vector) -> Code {
        match effort {
            Effort::Fast => (self.encode)(v),
            Effort::Precise => (self.encode_precise)(v),
        }
    }

    /// The code of each vector.
    pub fn encode_each(&self, effort: Effort, vectors: &[Vector]) -> Vec<Code> {
        vectors.iter().map(|&v| self.encode_with(effort, v)).collect()
    }

    /// The vector of each code.
    pub fn decode_each(&self, codes: &[Code]) -> Vec<Vector> {
        codes.iter().map(|&code| (self.decode)(code)).collect()
    }

    /// What an operation makes of one code.
    pub fn operate(&self, operation: Operation, code: Code) -> Code {
        match operation {
            Operation::Canonical => (self.canonical)(code),
            Operation::Negate => (self.negate)(code),
            Operation::Mirror(axis) => (self.mirror)(code, axis),
        }
    }

    /// Whether the format stores a direction. `Float32x3` gives its input back.
    pub fn stores_direction(&self) -> bool {
        self.format != Format::Float32x3
    }

    /// Whether `f32` does not tell all codes apart: what decodes alike is then one direction.
    pub fn is_finer_than_f32(&self) -> bool {
        let mut is_finer = false;
        macro_rules! check {
            ($name:ident) => {
                is_finer |= self.format == Format::$name;
            };
        }
        unitpack::for_each_codec!(finer: check);
        is_finer
    }
}

struct Erase;

impl Visitor for Erase {
    type Output = &'static AnyCodec;
    fn visit<C: Codec>(self) -> &'static AnyCodec {
        // Functions, as pointers to closures would be compiled again in every unit that names them.
        const {
            &AnyCodec {
                format: C::FORMAT,
                code_size: size_of::<C::Code>(),
                encode: encode::<C>,
                encode_precise: encode_precise::<C>,
                decode: decode::<C>,
                canonical: canonical::<C>,
                is_canonical: is_canonical::<C>,
                negate: negate::<C>,
                mirror: mirror::<C>,
                same_direction: same_direction::<C>,
            }
        }
    }
}

fn encode<C: Codec>(v: Vector) -> Code {
    integer(C::encode(v))
}

fn encode_precise<C: Codec>(v: Vector) -> Code {
    integer(C::encode_precise(v))
}

fn decode<C: Codec>(code: Code) -> Vector {
    C::decode(native(code))
}

fn canonical<C: Codec>(code: Code) -> Code {
    integer(C::canonical(native(code)))
}

fn is_canonical<C: Codec>(code: Code) -> bool {
    C::is_canonical(native(code))
}

fn negate<C: Codec>(code: Code) -> Code {
    integer(C::negate(native(code)))
}

fn mirror<C: Codec>(code: Code, axis: Axis) -> Code {
    integer(C::mirror(native(code), axis))
}

fn same_direction<C: Codec>(a: Code, b: Code) -> bool {
    C::same_direction(native(a), native(b))
}
