//! The functions of slices that only a codec's type has, for one format of each family and width of
//! code.

use std::ops::Range;

use unitpack::{
    Codec, Float32x3, Format, Oct8, Oct16, Oct24, Oct32, Snorm16x3, Soa, SoaMut, Visitor,
};

use crate::codes::{Code, natives, write_codes};
use crate::{Effort, Operation, Outcome};

/// Codes to write, in a larger buffer.
pub struct Place<'a> {
    /// The buffer.
    pub buffer: &'a mut [Code],
    /// Which of its codes.
    pub codes: Range<usize>,
}

impl<'a> From<&'a mut [Code]> for Place<'a> {
    fn from(buffer: &'a mut [Code]) -> Self {
        let codes = 0..buffer.len();
        Place { buffer, codes }
    }
}

/// Arrays of structures of some size.
pub struct Aos {
    /// How many floats a structure has.
    pub floats: usize,
    /// [`Codec::encode_aos`], or [`Codec::encode_aos_precise`].
    pub encode: fn(Effort, &[f32], Place<'_>) -> Outcome,
    /// [`Codec::decode_aos`].
    pub decode: fn(&[Code], &mut [f32]) -> Outcome,
}

/// Codes of one format to codes of another.
#[derive(Clone, Copy)]
pub struct Transcode {
    /// The format of the source.
    pub from: Format,
    /// The format of the destination.
    pub to: Format,
    /// [`transcode`](unitpack::transcode()).
    pub run: fn(&[Code], Place<'_>) -> Outcome,
}

/// A codec's functions of slices. There is one for each of the [`representatives`].
pub struct Typed {
    /// Which codec it is.
    pub format: Format,
    /// [`Codec::encode_soa`], or [`Codec::encode_soa_precise`].
    pub encode_soa: fn(Effort, Soa<'_>, Place<'_>) -> Outcome,
    /// [`Codec::decode_soa`], of some codes in a larger buffer.
    pub decode_soa: fn(&[Code], Range<usize>, SoaMut<'_>) -> Outcome,
    /// Arrays of structures of three, four and eight floats.
    pub aos: [Aos; 3],
    /// To and from two formats: all pairs would be as many functions as the square of the table.
    pub transcode: [Transcode; 4],
    /// [`Codec::canonical_slice`], [`Codec::negate_slice`] or [`Codec::mirror_slice`].
    pub operate: fn(Operation, &mut [Code]),
}

impl Typed {
    /// Those of a format, if it is one of the [`representatives`].
    #[inline]
    pub fn of(format: Format) -> Option<&'static Typed> {
        representatives::visit(format, Erase)
    }

    /// Those of the format of the same family and width of code.
    #[inline]
    pub fn beside(format: Format) -> &'static Typed {
        Typed::of(representatives::beside(format)).expect("it is one of the list")
    }

    /// Those of all [`representatives`].
    #[inline]
    pub fn all() -> impl Iterator<Item = &'static Typed> {
        representatives::all().filter_map(Typed::of)
    }
}

struct Erase;

impl Visitor for Erase {
    type Output = &'static Typed;
    fn visit<C: Codec>(self) -> &'static Typed {
        // Functions, as pointers to closures would be compiled again in every unit that names them.
        const {
            &Typed {
                format: C::FORMAT,
                encode_soa: encode_soa::<C>,
                decode_soa: decode_soa::<C>,
                aos: [aos::<C, 3>(), aos::<C, 4>(), aos::<C, 8>()],
                transcode: [
                    transcode::<C, Oct24>(),
                    transcode::<Oct24, C>(),
                    transcode::<C, Float32x3>(),
                    transcode::<Float32x3, C>(),
                ],
                operate: operate::<C>,
            }
        }
    }
}

fn encode_soa<C: Codec>(effort: Effort, v: Soa<'_>, place: Place<'_>) -> Outcome {
    write(place, &mut |codes| match effort {
        Effort::Fast => C::encode_soa(v, codes),
        Effort::Precise => C::encode_soa_precise(v, codes),
    })
}

fn decode_soa<C: Codec>(buffer: &[Code], codes: Range<usize>, v: SoaMut<'_>) -> Outcome {
    C::decode_soa(&natives(buffer)[codes], v)
}

const fn aos<C: Codec, const N: usize>() -> Aos {
    Aos { floats: N, encode: encode_aos::<C, N>, decode: decode_aos::<C, N> }
}

fn encode_aos<C: Codec, const N: usize>(effort: Effort, v: &[f32], place: Place<'_>) -> Outcome {
    let vectors = v.as_chunks::<N>().0;
    write(place, &mut |codes| match effort {
        Effort::Fast => C::encode_aos(vectors, codes),
        Effort::Precise => C::encode_aos_precise(vectors, codes),
    })
}

fn decode_aos<C: Codec, const N: usize>(codes: &[Code], v: &mut [f32]) -> Outcome {
    C::decode_aos(&natives(codes), v.as_chunks_mut::<N>().0)
}

const fn transcode<A: Codec, B: Codec>() -> Transcode {
    Transcode { from: A::FORMAT, to: B::FORMAT, run: run_transcode::<A, B> }
}

/// From each type of code to each.
#[inline]
pub fn transcodes() -> Vec<Transcode> {
    macro_rules! pairs {
        ($($from:ident)*; $to:tt) => { vec![$(pairs!(@ $from $to)),*].concat() };
        (@ $from:ident [$($to:ident)*]) => { vec![$(transcode::<$from, $to>()),*] };
    }
    pairs!(Oct8 Oct16 Oct24 Oct32 Snorm16x3 Float32x3; [Oct8 Oct16 Oct24 Oct32 Snorm16x3 Float32x3])
}

fn run_transcode<A: Codec, B: Codec>(from: &[Code], place: Place<'_>) -> Outcome {
    write(place, &mut |to| unitpack::transcode::<A, B>(&natives(from), to))
}

fn operate<C: Codec>(operation: Operation, codes: &mut [Code]) {
    write_codes(codes, &mut |codes| match operation {
        Operation::Canonical => C::canonical_slice(codes),
        Operation::Negate => C::negate_slice(codes),
        Operation::Mirror(axis) => C::mirror_slice(codes, axis),
    });
}

/// Not generic over what it calls, so that there is one for each type of code.
fn write<T: bytemuck::Pod>(
    place: Place<'_>,
    write: &mut dyn FnMut(&mut [T]) -> Outcome,
) -> Outcome {
    write_codes(place.buffer, &mut |codes| write(&mut codes[place.codes.clone()]))
}

/// One format of each family and width of code: the first of the table. Formulas and loops depend
/// on these; what depends on the sizes of the parameters shows in the functions of one vector as
/// well.
pub mod representatives {
    use unitpack::{Codec, Format, Visitor};

    /// All of them, in the order of the table.
    pub fn all() -> impl Iterator<Item = Format> {
        Format::ALL.iter().copied().filter(|&format| contains(format))
    }

    /// Whether a format is one of them.
    pub const fn contains(format: Format) -> bool {
        beside(format) as usize == format as usize
    }

    /// That of a format's family and width.
    pub const fn beside(format: Format) -> Format {
        let mut i = 0;
        while !is_alike(Format::ALL[i], format) {
            i += 1;
        }
        Format::ALL[i]
    }

    /// Whether codes are of one size, and names the same except for their digits, as snorm8x3 and
    /// snorm10x3.
    const fn is_alike(a: Format, b: Format) -> bool {
        let [name_a, name_b] = [a.name().as_bytes(), b.name().as_bytes()];
        let (mut i, mut j) = (0, 0);
        loop {
            i = skip_digits(name_a, i);
            j = skip_digits(name_b, j);
            if i == name_a.len() || j == name_b.len() {
                let both_end = i == name_a.len() && j == name_b.len();
                return both_end && a.code_size() == b.code_size();
            }
            if name_a[i] != name_b[j] {
                return false;
            }
            i += 1;
            j += 1;
        }
    }

    const fn skip_digits(name: &[u8], mut i: usize) -> usize {
        while i < name.len() && name[i].is_ascii_digit() {
            i += 1;
        }
        i
    }

    /// Calls a visitor with a codec's type, if it is one of them. Only for these is the visitor
    /// compiled.
    #[inline]
    pub fn visit<V: Visitor>(format: Format, visitor: V) -> Option<V::Output> {
        format.visit(IfContained(visitor))
    }

    struct IfContained<V>(V);

    impl<V: Visitor> Visitor for IfContained<V> {
        type Output = Option<V::Output>;
        fn visit<C: Codec>(self) -> Option<V::Output> {
            let visit = const {
                if contains(C::FORMAT) {
                    Some(visit_codec::<V, C> as fn(V) -> V::Output)
                } else {
                    None
                }
            };
            visit.map(|visit| visit(self.0))
        }
    }

    fn visit_codec<V: Visitor, C: Codec>(visitor: V) -> V::Output {
        visitor.visit::<C>()
    }
}
