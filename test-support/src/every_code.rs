//! What must hold for every single code of a format of at most 32 bits.

use unitpack::{Format, Soa};

use crate::codes::{Code, decode_arrays, encode_arrays};
use crate::oracle::Oracle;
use crate::vectors::{bits, cross, dot, widen};
use crate::{AnyCodec, Arrays, Effort, Operation, Typed};

/// By how much the length of a decoded vector may differ from 1.
pub const LENGTH_ERROR: f64 = 2.5e-7;
/// The greatest angle, in radians, between a decoded vector and the exact one.
pub const DECODE_ERROR: f64 = 5e-7;

/// How many codes are looked at together.
pub const BLOCK: u64 = 1 << 12;

/// What a number of codes showed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Findings {
    /// How many codes there were.
    pub codes: u64,
    /// How many of them are canonical.
    pub canonical: u64,
    /// The greatest angle to the exact vector, in radians.
    pub angle: f64,
    /// The greatest difference of a length from 1.
    pub length: f64,
}

impl Findings {
    /// Adds what other codes showed.
    pub fn add(&mut self, other: Findings) {
        self.codes += other.codes;
        self.canonical += other.canonical;
        self.angle = self.angle.max(other.angle);
        self.length = self.length.max(other.length);
    }
}

/// Looks at `count` codes from `first` on. Each
/// - decodes to the same bits in a slice of [`Format`]'s and alone,
/// - decodes to a vector whose length is 1 to [`LENGTH_ERROR`] and whose direction is the oracle's
///   to [`DECODE_ERROR`],
/// - is encoded again, in such a slice, as its canonical code, by `encode` too if that is stable.
///
/// And of one in `every`, that code is the oracle's, and is what encoding alone gives.
///
/// # Errors
/// What the first code that is wrong shows.
#[inline]
pub fn check(
    format: Format,
    oracle: &Oracle,
    first: u64,
    count: u64,
    every: usize,
) -> Result<Findings, String> {
    let mut findings = Findings::default();
    let end = first + count;
    for first in (first..end).step_by(BLOCK as usize) {
        let codes: Vec<Code> = (first..end.min(first + BLOCK)).map(Code::from).collect();
        let vectors = decode_arrays(format, &codes);
        let again = encode_arrays(format, Effort::Precise, vectors.read());
        let fast = if format.encode_is_stable() {
            encode_arrays(format, Effort::Fast, vectors.read())
        } else {
            again.clone()
        };
        if let Some(i) = (0..codes.len()).find(|&i| fast[i] != again[i]) {
            let (code, fast, again) = (codes[i], fast[i], again[i]);
            return Err(format!("{format}: {code:#x} is {fast:#x} by encode, not {again:#x}"));
        }
        let block = Block { codec: AnyCodec::of(format), oracle, codes, vectors, again };
        block.decoded_alike()?;
        findings.add(block.decoded_exactly()?);
        findings.canonical += block.canonical_again(every)?;
    }
    Ok(findings)
}

/// Some codes in order, what they decode to, and what that is encoded as.
struct Block<'a> {
    codec: &'a AnyCodec,
    oracle: &'a Oracle,
    codes: Vec<Code>,
    vectors: Arrays,
    again: Vec<Code>,
}

impl Block<'_> {
    fn decoded_alike(&self) -> Result<(), String> {
        for (&code, batch) in self.codes.iter().zip(self.vectors.iter()) {
            let alone = (self.codec.decode)(code);
            if bits(batch) != bits(alone) {
                let format = self.codec.format;
                return Err(format!(
                    "{format}: {code:#x} is {batch:?} in a batch and {alone:?} alone"
                ));
            }
        }
        Ok(())
    }

    fn decoded_exactly(&self) -> Result<Findings, String> {
        let v: Soa<'_> = self.vectors.read();
        let mut exact = vec![[0.0; 3]; v.x.len()];
        self.oracle.decode_from(self.codes[0], &mut exact);
        // How far off a length is, and the square of the sine of an angle, infinite beyond 90
        // degrees.
        let off = |i: usize| {
            let w = widen([v.x[i], v.y[i], v.z[i]]);
            let sine = cross(w, exact[i]);
            let facing = if dot(w, exact[i]) > 0.0 { 0.0 } else { f64::INFINITY };
            // |w|^2 - 1 = (|w| - 1) (|w| + 1)
            ((dot(w, w) - 1.0).abs() * 0.5, dot(sine, sine) + facing)
        };
        // What is no number is wrong too.
        let is_wrong = |(length, sine): (f64, f64)| {
            !(length <= LENGTH_ERROR && sine <= DECODE_ERROR * DECODE_ERROR)
        };
        let (mut length, mut sine) = (0.0, 0.0);
        let mut wrong = false;
        for i in 0..v.x.len() {
            let (l, s) = off(i);
            wrong |= is_wrong((l, s));
            length = if l > length { l } else { length };
            sine = if s > sine { s } else { sine };
        }
        if wrong {
            let i = (0..v.x.len()).find(|&i| is_wrong(off(i))).expect("one is wrong");
            let (code, w, (l, s)) = (self.codes[i], [v.x[i], v.y[i], v.z[i]], off(i));
            return Err(format!(
                "{}: {code:#x} is {w:?}, off by {l:.2e} in length and {:.2e} rad from {:?}",
                self.codec.format,
                s.sqrt(),
                exact[i]
            ));
        }
        // So near to each other, the sine is the angle.
        Ok(Findings { codes: v.x.len() as u64, canonical: 0, angle: sine.sqrt(), length })
    }

    /// Returns how many codes are canonical.
    fn canonical_again(&self, every: usize) -> Result<u64, String> {
        let AnyCodec { format, .. } = *self.codec;
        let mut count = 0;
        for (&code, &again) in self.codes.iter().zip(&self.again) {
            let canonical = (self.codec.canonical)(code);
            if again != canonical {
                return Err(format!(
                    "{format}: {code:#x} is encoded as {again:#x}, not {canonical:#x}"
                ));
            }
            count += u64::from(code == canonical);
        }
        for ((&code, &again), v) in
            self.codes.iter().zip(&self.again).zip(self.vectors.iter()).step_by(every)
        {
            let alone = (self.codec.encode_precise)(v);
            let exact = self.oracle.canonical(code);
            // Two exact directions may be one in f32.
            let coincides = exact == code && {
                let [v, w] = [code, again].map(self.codec.decode);
                bits(v) == bits(w)
            };
            let is_canonical = (self.codec.is_canonical)(code) == (code == again);
            if alone != again || (again != exact && !coincides) || !is_canonical {
                return Err(format!(
                    "{format}: {code:#x} is {again:#x} in a batch, {alone:#x} alone, {exact:#x} by the \
                     oracle"
                ));
            }
        }
        Ok(count)
    }
}

/// Looks at what is made of codes without vectors. Each code
/// - is made canonical, negated and mirrored in each axis as decoding, doing it to the vector and
///   encoding precisely does it,
/// - alone, and in a slice if the format has [`Typed`] functions,
/// - means the direction of the one before it if both have the same canonical code.
///
/// # Errors
/// What the first code that is wrong shows.
#[inline]
pub fn check_operations(format: Format, codes: &[Code]) -> Result<(), String> {
    let vectors = decode_arrays(format, codes);
    let by_vectors = Operation::ALL.map(|operation| {
        let v: Arrays = vectors.iter().map(|v| operation.apply(v)).collect();
        encode_arrays(format, Effort::Precise, v.read())
    });
    compare_operations(AnyCodec::of(format), Typed::of(format), codes, by_vectors)
}

fn compare_operations(
    codec: &AnyCodec,
    typed: Option<&Typed>,
    codes: &[Code],
    by_vectors: [Vec<Code>; 5],
) -> Result<(), String> {
    let format = codec.format;
    for (operation, expected) in Operation::ALL.into_iter().zip(&by_vectors) {
        for (&code, &expected) in codes.iter().zip(expected) {
            let alone = codec.operate(operation, code);
            if alone != expected {
                return Err(format!(
                    "{format}, {operation:?}: {code:#x} is {alone:#x} alone, not {expected:#x}"
                ));
            }
        }
        let Some(typed) = typed else { continue };
        let mut slice = codes.to_vec();
        (typed.operate)(operation, &mut slice);
        for ((&code, &slice), &expected) in codes.iter().zip(&slice).zip(expected) {
            if slice != expected {
                return Err(format!(
                    "{format}, {operation:?}: {code:#x} is {slice:#x} in a slice, not {expected:#x}"
                ));
            }
        }
    }
    let canonical = &by_vectors[0];
    for (pair, canonical) in codes.windows(2).zip(canonical.windows(2)) {
        let same = (codec.same_direction)(pair[0], pair[1]);
        let own = (codec.same_direction)(pair[0], canonical[0]);
        if same != (canonical[0] == canonical[1]) || !own {
            return Err(format!("{format}: {pair:#x?} have one direction: {same}"));
        }
    }
    Ok(())
}
