//! What must hold for every single code of a format of at most 32 bits.

use bytemuck::Pod;
use unitpack::{Axis, Codec, Format, Soa, SoaMut, Visitor};

use super::oracle::Oracle;
use super::{cross, dot, widen};

/// By how much the length of a decoded vector may differ from 1.
pub const LENGTH_ERROR: f64 = 2.5e-7;
/// The greatest angle, in radians, between a decoded vector and the exact one.
pub const DECODE_ERROR: f64 = 5e-7;

/// How many codes are looked at together.
pub const BLOCK: u64 = 1 << 12;

/// What a number of codes showed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Findings {
    pub codes: u64,
    /// How many of them are canonical.
    pub canonical: u64,
    /// The greatest angle to the exact vector, in radians.
    pub angle: f64,
    /// The greatest difference of a length from 1.
    pub length: f64,
}

impl Findings {
    pub fn add(&mut self, other: Findings) {
        self.codes += other.codes;
        self.canonical += other.canonical;
        self.angle = self.angle.max(other.angle);
        self.length = self.length.max(other.length);
    }
}

/// Looks at `count` codes from `first` on. Each
/// - decodes to the same bits in a batch and alone,
/// - decodes to a vector whose length is 1 to [`LENGTH_ERROR`] and whose direction is the oracle's to
///   [`DECODE_ERROR`],
/// - is encoded again, in a batch, as its canonical code.
///
/// And of one in `every`, that code is the oracle's, and is what encoding alone gives.
pub fn check(
    format: Format,
    oracle: &Oracle,
    first: u64,
    count: u64,
    every: usize,
) -> Result<Findings, String> {
    format.visit(Check { oracle, first, count, every })
}

struct Check<'a> {
    oracle: &'a Oracle,
    first: u64,
    count: u64,
    every: usize,
}

/// The code of an integer, whose little-endian bytes are those of [`Format::encode`].
pub fn code<T: Pod>(i: u128) -> T {
    let mut bytes = i.to_le_bytes();
    let bytes = &mut bytes[..size_of::<T>()];
    swap_if_big_endian::<T>(bytes);
    bytemuck::pod_read_unaligned(bytes)
}

pub fn integer<T: Pod>(code: T) -> u128 {
    let mut bytes = [0; 16];
    bytes[..size_of::<T>()].copy_from_slice(bytemuck::bytes_of(&code));
    swap_if_big_endian::<T>(&mut bytes[..size_of::<T>()]);
    u128::from_le_bytes(bytes)
}

/// A code is one integer or an array of them, as large as its alignment.
fn swap_if_big_endian<T>(bytes: &mut [u8]) {
    if cfg!(target_endian = "big") {
        bytes.chunks_mut(align_of::<T>()).for_each(<[u8]>::reverse);
    }
}

impl Visitor for Check<'_> {
    type Output = Result<Findings, String>;

    fn visit<C: Codec>(self) -> Self::Output {
        let mut findings = Findings::default();
        let end = self.first + self.count;
        for first in (self.first..end).step_by(BLOCK as usize) {
            findings.add(self.block::<C>(first, BLOCK.min(end - first))?);
        }
        Ok(findings)
    }
}

impl Check<'_> {
    fn block<C: Codec>(&self, first: u64, count: u64) -> Result<Findings, String> {
        let codes: Vec<C::Code> = (first..first + count).map(|i| code(i.into())).collect();
        let [mut x, mut y, mut z] = [(); 3].map(|()| vec![0.0; codes.len()]);
        C::decode_soa(&codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
        let vectors = Soa { x: &x, y: &y, z: &z };
        decoded_alike::<C>(&codes, vectors)?;
        let mut findings = self.decoded_exactly(C::FORMAT, first, vectors)?;
        findings.canonical = self.canonical_again::<C>(&codes, vectors)?;
        Ok(findings)
    }

    fn decoded_exactly(&self, format: Format, first: u64, v: Soa<'_>) -> Result<Findings, String> {
        let mut exact = vec![[0.0; 3]; v.x.len()];
        self.oracle.decode_from(first.into(), &mut exact);
        // How far off a length is, and the square of the sine of an angle, infinite beyond 90 degrees.
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
            let i = (0..v.x.len()).find(|&i| is_wrong(off(i))).unwrap();
            let (code, w, (l, s)) = (first + i as u64, [v.x[i], v.y[i], v.z[i]], off(i));
            return Err(format!(
                "{format}: {code:#x} is {w:?}, off by {l:.2e} in length and {:.2e} rad from {:?}",
                s.sqrt(),
                exact[i]
            ));
        }
        // So near to each other, the sine is the angle.
        Ok(Findings { codes: v.x.len() as u64, canonical: 0, angle: sine.sqrt(), length })
    }

    /// Gives how many codes are canonical.
    fn canonical_again<C: Codec>(&self, codes: &[C::Code], v: Soa<'_>) -> Result<u64, String> {
        let format = C::FORMAT;
        let mut again = codes.to_vec();
        C::encode_soa_precise(v, &mut again).unwrap();
        let mut count = 0;
        for (&code, &again) in codes.iter().zip(&again) {
            let canonical = C::canonical(code);
            if again != canonical {
                return Err(format!(
                    "{format}: {code:x?} is encoded as {again:x?}, not {canonical:x?}"
                ));
            }
            count += u64::from(code == canonical);
        }
        for i in (0..codes.len()).step_by(self.every) {
            let (code, again) = (codes[i], again[i]);
            let alone = C::encode_precise([v.x[i], v.y[i], v.z[i]]);
            let exact = self.oracle.canonical(integer(code));
            // Two exact directions may be one in f32.
            let coincides = exact == integer(code) && {
                let [v, w] = [code, again].map(C::decode);
                v.map(f32::to_bits) == w.map(f32::to_bits)
            };
            let is_canonical = C::is_canonical(code) == (code == again);
            if alone != again || (integer(again) != exact && !coincides) || !is_canonical {
                return Err(format!(
                    "{format}: {code:x?} is {again:x?} in a batch, {alone:x?} alone, {exact:#x} by the \
                     oracle"
                ));
            }
        }
        Ok(count)
    }
}

fn decoded_alike<C: Codec>(codes: &[C::Code], v: Soa<'_>) -> Result<(), String> {
    let bits = |v: [f32; 3]| v.map(f32::to_bits);
    for (i, &code) in codes.iter().enumerate() {
        let (batch, alone) = ([v.x[i], v.y[i], v.z[i]], C::decode(code));
        if bits(batch) != bits(alone) {
            let format = C::FORMAT;
            return Err(format!("{format}: {code:x?} is {batch:?} in a batch and {alone:?} alone"));
        }
    }
    Ok(())
}

/// Looks at what is made of codes without vectors. Each code
/// - is made canonical, negated and mirrored in each axis as decoding, doing it to the vector and encoding
///   precisely does it,
/// - in a slice and alone,
/// - means the direction of the one before it if both have the same canonical code.
pub fn check_operations(format: Format, codes: &[u128]) -> Result<(), String> {
    format.visit(Operations(codes))
}

struct Operations<'a>(&'a [u128]);

/// Something that is made of one code, of a slice, and which components of the vector it negates.
type Operation<C> = (&'static str, fn(C) -> C, fn(&mut [C]), [bool; 3]);

impl Visitor for Operations<'_> {
    type Output = Result<(), String>;

    fn visit<C: Codec>(self) -> Self::Output {
        let format = C::FORMAT;
        let codes: Vec<C::Code> = self.0.iter().map(|&i| code(i)).collect();
        let [mut x, mut y, mut z] = [(); 3].map(|()| vec![0.0; codes.len()]);
        C::decode_soa(&codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
        let by_vectors = |flips: [bool; 3]| {
            let flipped = |c: &[f32], flip: bool| -> Vec<f32> {
                c.iter().map(|&c| if flip { -c } else { c }).collect()
            };
            let [x, y, z] = [flipped(&x, flips[0]), flipped(&y, flips[1]), flipped(&z, flips[2])];
            let mut again = codes.clone();
            C::encode_soa_precise(Soa { x: &x, y: &y, z: &z }, &mut again).unwrap();
            again
        };
        let operations: [Operation<C::Code>; 5] = [
            ("canonical", C::canonical, C::canonical_slice, [false; 3]),
            ("negated", C::negate, C::negate_slice, [true; 3]),
            (
                "mirrored in x",
                |code| C::mirror(code, Axis::X),
                |codes| C::mirror_slice(codes, Axis::X),
                [true, false, false],
            ),
            (
                "mirrored in y",
                |code| C::mirror(code, Axis::Y),
                |codes| C::mirror_slice(codes, Axis::Y),
                [false, true, false],
            ),
            (
                "mirrored in z",
                |code| C::mirror(code, Axis::Z),
                |codes| C::mirror_slice(codes, Axis::Z),
                [false, false, true],
            ),
        ];
        for (name, single, slice, flips) in operations {
            let expected = by_vectors(flips);
            let mut batch = codes.clone();
            slice(&mut batch);
            for ((&code, &batch), &expected) in codes.iter().zip(&batch).zip(&expected) {
                let alone = single(code);
                if batch != expected || alone != expected {
                    return Err(format!(
                        "{format}: {code:x?} {name} is {batch:x?} in a slice and {alone:x?} alone, not \
                         {expected:x?}"
                    ));
                }
            }
        }
        let canonical = by_vectors([false; 3]);
        for (pair, canonical) in codes.windows(2).zip(canonical.windows(2)) {
            let same = C::same_direction(pair[0], pair[1]);
            if same != (canonical[0] == canonical[1]) || !C::same_direction(pair[0], canonical[0]) {
                return Err(format!("{format}: {pair:x?} are wrongly of one direction or not"));
            }
        }
        Ok(())
    }
}
