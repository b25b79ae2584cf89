//! Dither: the error of quantisation as noise instead of bands, no greater than without; and stochastic rounding,
//! whose mean is right.
//!
//! Where a surface bends slowly, neighbours have the same code, and then all of them the next one: bands. Dither of the
//! usual kind hides them by adding noise before rounding, which makes the error greater. Here it is subtracted again:
//! element i is turned by a small rotation R(i) before it is encoded, and back after it is decoded.
//!
//! ```text
//! encode   code = C::encode(R(i) v)
//! decode   v = R(i)^-1 C::decode(code)
//! R(i)     by the angle 2 atan |u| around u;  u = w (s(i A1), s(i A2), s(i A3)), i counted from the seed on;
//!          w = the greatest error of encode_precise in radians, but at most 1/4;  for a hemisphere u.x = u.y = 0
//!          s(n) from -1 to 1 is n, an integer of 32 bits with sign, over 2^31
//!          A1, A2, A3 = 2^32 / g, 2^32 / g^2, 2^32 / g^3, g^4 = g + 1
//! ```
//!
//! A rotation changes no angle, so that the greatest error stays that of the codec, up to `f32` rounding, and so does
//! the mean over all directions. For one direction the error depends on the element, and so averages out over
//! neighbours, to 2 to 4 hundredths over 1024 of them: the sequence, Roberts's, fills the range evenly. It depends on the index alone, so that nothing
//! flickers in time. In exchange no direction is exact, axes neither, and equal vectors have different codes.
//!
//! A hemisphere's vectors are turned around Z alone, so that none falls below the rim: there half of the error stays on the
//! average, and around +Z, where turning changes nothing, all of it. Take a format of the whole sphere instead. So it is
//! with formats of less than 8 bits, whose cells are wider than the rotations.
//!
//! ```
//! use unitpack::dither::Dither;
//! use unitpack::{Codec, Oct16, Soa, SoaMut};
//!
//! // A flat wall, a little off an axis.
//! let (x, y, z) = ([0.003f32; 64], [0.0; 64], [1.0; 64]);
//! let mut codes = [0; 64];
//! let dither = Dither::new(0);
//! dither.encode_soa::<Oct16>(0, Soa { x: &x, y: &y, z: &z }, &mut codes)?;
//! let [mut a, mut b, mut c] = [[0.0; 64]; 3];
//! dither.decode_soa::<Oct16>(0, &codes, SoaMut { x: &mut a, y: &mut b, z: &mut c })?;
//! let mean = a.iter().sum::<f32>() / 64.0;
//! assert!((mean - 0.003).abs() < 0.0005);
//! assert_eq!(Oct16::decode(Oct16::encode([0.003, 0.0, 1.0]))[0], 0.0);
//! # Ok::<(), unitpack::LengthMismatch>(())
//! ```
//!
//! The survey of Cigolle et al. (2014) left dither that does not raise the error as an open challenge; this is
//! unitpack's answer. Sources: Schuchman, "Dither Signals and Their Effect on Quantization Noise", 1964, on subtracting
//! it; Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018.

use core::array;
use core::marker::PhantomData;
use core::num::Wrapping;

use bytemuck::Zeroable;

use crate::batch::{STAGE, Stage};
use crate::formula::{Behind, Lattice, One, Stored, direction};
use crate::simd::dispatch::{Job, dispatch};
use crate::simd::math::{length_squared, normalize};
use crate::simd::{Each, Simd, SimdInt, inlined};
use crate::*;

/// A sequence of small rotations and of random numbers, one of each for every element. See the
/// [module](self).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dither {
    start: u32,
}

impl Dither {
    /// Decoding needs the seed that encoding had.
    #[inline]
    pub const fn new(seed: u32) -> Self {
        Dither { start: seed.wrapping_mul(0x9E37_79B9) }
    }

    /// [`Codec::encode`] of a vector that is element `index`. Any input is allowed, as there; with
    /// [`Float32x3`] too, what is no direction is taken as +Z.
    #[inline]
    pub fn encode<C: Codec>(self, index: u32, v: [f32; 3]) -> C::Code {
        C::encode(Rotation::of::<C>().turn_one(v, self.number(index)))
    }

    /// [`Codec::encode_precise`] of a vector that is element `index`.
    #[inline]
    pub fn encode_precise<C: Codec>(self, index: u32, v: [f32; 3]) -> C::Code {
        C::encode_precise(Rotation::of::<C>().turn_one(v, self.number(index)))
    }

    /// The vector of element `index`, of length 1 to 2.5e-7.
    #[inline]
    pub fn decode<C: Codec>(self, index: u32, code: C::Code) -> [f32; 3] {
        Rotation::of::<C>().back().turn_one(C::decode(code), self.number(index))
    }

    /// [`encode`](Dither::encode) for structures of arrays, whose first vector is element `first`. After element
    /// 2^32 - 1 comes 0.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    pub fn encode_soa<C: Codec>(
        self,
        first: u32,
        v: Soa<'_>,
        codes: &mut [C::Code],
    ) -> Result<(), LengthMismatch> {
        self.encode_all(Rotation::of::<C>(), first, v, codes, C::encode_soa)
    }

    /// [`encode_precise`](Dither::encode_precise) for structures of arrays, whose first vector is element
    /// `first`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    pub fn encode_soa_precise<C: Codec>(
        self,
        first: u32,
        v: Soa<'_>,
        codes: &mut [C::Code],
    ) -> Result<(), LengthMismatch> {
        self.encode_all(Rotation::of::<C>(), first, v, codes, C::encode_soa_precise)
    }

    /// [`decode`](Dither::decode) for structures of arrays, whose first vector is element `first`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    pub fn decode_soa<C: Codec>(
        self,
        first: u32,
        codes: &[C::Code],
        v: SoaMut<'_>,
    ) -> Result<(), LengthMismatch> {
        self.decode_all(Rotation::of::<C>().back(), first, codes, v, C::decode_soa)
    }

    /// Stochastic rounding: one of the three points around `v`, each with such a probability that their mean has the
    /// direction of `v`. For what is summed over many elements or frames, each with its own index or seed: a sum of
    /// nearest codes would keep their common error, this one's shrinks with the root of their number.
    ///
    /// The error of one vector is up to twice the greatest of [`Codec::encode_precise`]. An axis is kept, and so is any point
    /// of the lattice but for `f32` rounding, which of 10^6 draws at 32 bits moves some 200. Decoding is that of the codec,
    /// without dither.
    ///
    /// ```
    /// use unitpack::dither::Dither;
    /// use unitpack::{Codec, Oct16};
    /// let x = |code| Oct16::decode(code)[0];
    /// let v = [0.003, 0.0, 1.0];
    /// assert_eq!(x(Oct16::encode_precise(v)), 0.0);
    /// let sum: f32 = (0..10_000).map(|i| x(Dither::new(0).encode_stochastic::<Oct16>(i, v))).sum();
    /// assert!((sum / 10_000.0 - 0.003).abs() < 0.0002);
    /// ```
    #[inline]
    pub fn encode_stochastic<C: StochasticRounding>(self, index: u32, v: [f32; 3]) -> C::Code {
        C::encode_one_of(v, self.random(index))
    }

    /// [`encode_stochastic`](Dither::encode_stochastic) for structures of arrays, whose first vector is element
    /// `first`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    pub fn encode_soa_stochastic<C: StochasticRounding>(
        self,
        mut first: u32,
        v: Soa<'_>,
        codes: &mut [C::Code],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        let vectors = v.x.chunks(STAGE).zip(v.y.chunks(STAGE)).zip(v.z.chunks(STAGE));
        for (((x, y), z), codes) in vectors.zip(codes.chunks_mut(STAGE)) {
            let random: [u32; STAGE] =
                array::from_fn(|i| self.random(first.wrapping_add(i as u32)));
            C::encode_soa_one_of(Soa { x, y, z }, &random[..x.len().min(STAGE)], codes);
            first = first.wrapping_add(STAGE as u32);
        }
        Ok(())
    }

    #[inline(always)]
    fn number(self, index: u32) -> u32 {
        self.start.wrapping_add(index)
    }

    /// 32 bits. Source: Wellons, "Prospecting for Hash Functions", 2018.
    #[inline(always)]
    fn random(self, index: u32) -> u32 {
        let x = self.number(index);
        let x = (x ^ x >> 16).wrapping_mul(0x7FEB_352D);
        let x = (x ^ x >> 15).wrapping_mul(0x846C_A68B);
        x ^ x >> 16
    }

    fn encode_all<T>(
        self,
        rotation: Rotation,
        mut first: u32,
        v: Soa<'_>,
        codes: &mut [T],
        encode: fn(Soa<'_>, &mut [T]) -> Result<(), LengthMismatch>,
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        let mut stage = Stage::new();
        let vectors = v.x.chunks(STAGE).zip(v.y.chunks(STAGE)).zip(v.z.chunks(STAGE));
        for (((x, y), z), codes) in vectors.zip(codes.chunks_mut(STAGE)) {
            let numbers = &self.numbers(first)[..x.len().min(STAGE)];
            let to = stage.write(x.len());
            dispatch(Turn { rotation, numbers, v: Soa { x, y, z }, to });
            encode(stage.read(x.len()), codes)?;
            first = first.wrapping_add(STAGE as u32);
        }
        Ok(())
    }

    fn decode_all<T>(
        self,
        rotation: Rotation,
        mut first: u32,
        codes: &[T],
        v: SoaMut<'_>,
        decode: fn(&[T], SoaMut<'_>) -> Result<(), LengthMismatch>,
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        let mut stage = Stage::new();
        let vectors = v.x.chunks_mut(STAGE).zip(v.y.chunks_mut(STAGE)).zip(v.z.chunks_mut(STAGE));
        for (((x, y), z), codes) in vectors.zip(codes.chunks(STAGE)) {
            let numbers = &self.numbers(first)[..codes.len().min(STAGE)];
            decode(codes, stage.write(codes.len()))?;
            let v = stage.read(codes.len());
            dispatch(Turn { rotation, numbers, v, to: SoaMut { x, y, z } });
            first = first.wrapping_add(STAGE as u32);
        }
        Ok(())
    }

    #[inline(always)]
    fn numbers(self, first: u32) -> [u32; STAGE] {
        array::from_fn(|i| self.number(first).wrapping_add(i as u32))
    }
}

/// What the rotations of all elements have in common.
#[derive(Clone, Copy)]
struct Rotation {
    /// w of the module's formula.
    width: f32,
    /// Whether it is around Z, so that no vector leaves the upper hemisphere.
    upright: bool,
    /// Whether to turn the other way round, and to unit length.
    back: bool,
}

impl Rotation {
    /// 2^32 / g, 2^32 / g^2, 2^32 / g^3 with g^4 = g + 1.
    const STEPS: [i32; 3] =
        [0xD1B5_4A33_u32 as i32, 0xABC9_8389_u32 as i32, 0x8CB9_2BA7_u32 as i32];

    /// Turns by up to twice the greatest error around each axis, but by half a radian at the most.
    #[inline]
    fn of<C: Codec>() -> Self {
        let reach = 2.0 * C::FORMAT.max_error_precise_degrees().to_radians();
        let reach = if reach < 0.5 { reach } else { 0.5 };
        Rotation { width: (0.5 * reach) as f32, upright: C::FORMAT.is_hemisphere(), back: false }
    }

    #[inline]
    fn back(self) -> Self {
        Rotation { back: true, ..self }
    }

    #[inline(always)]
    fn turn<V: Simd>(self, v: [V; 3], number: V::Int) -> [V; 3] {
        let [x, y, z] = direction(v);
        let width = if self.back { -self.width } else { self.width };
        let scale = V::splat(width * (1.0 / 2_147_483_648.0));
        let [a, b, c] = Self::STEPS.each(
            #[inline(always)]
            |step| V::from_int(number * V::Int::splat(step)) * scale,
        );
        let [a, b] = if self.upright { [V::zero(); 2] } else { [a, b] };
        // v + 2 u x (v + u x v) / (1 + |u|^2).
        let cross = inlined(
            #[inline(always)]
            |[x, y, z]: [V; 3]| [b * z - c * y, c * x - a * z, a * y - b * x],
        );
        let [p, q, r] = cross([x, y, z]);
        let turned = cross([x + p, y + q, z + r]);
        let k = V::splat(2.0) / (V::splat(1.0) + length_squared([a, b, c]));
        let v = [x + k * turned[0], y + k * turned[1], z + k * turned[2]];
        if self.back { normalize(v) } else { v }
    }

    #[inline(always)]
    fn turn_one(self, v: [f32; 3], number: u32) -> [f32; 3] {
        self.turn(v, Wrapping(number as i32))
    }
}

struct Turn<'a> {
    rotation: Rotation,
    numbers: &'a [u32],
    v: Soa<'a>,
    to: SoaMut<'a>,
}

impl Job for Turn<'_> {
    #[inline(always)]
    fn run<V: Simd>(self) -> Self {
        let Turn { rotation, numbers, v: Soa { x, y, z }, to } = self;
        let ((xs, x), (ys, y), (zs, z)) = (V::split(x), V::split(y), V::split(z));
        let (blocks, numbers) = V::split(numbers);
        let ((to_xs, to_x), (to_ys, to_y), (to_zs, to_z)) =
            (V::split_mut(to.x), V::split_mut(to.y), V::split_mut(to.z));
        let from = xs.iter().zip(ys).zip(zs).zip(blocks);
        for ((((x, y), z), number), ((to_x, to_y), to_z)) in
            from.zip(to_xs.iter_mut().zip(to_ys).zip(to_zs))
        {
            let v = [V::load(x), V::load(y), V::load(z)];
            let v = rotation.turn::<V>(v, V::load_int(number, |number| number));
            v[0].store(to_x);
            v[1].store(to_y);
            v[2].store(to_z);
        }
        let to = SoaMut { x: to_x, y: to_y, z: to_z };
        Turn { rotation, numbers, v: Soa { x, y, z }, to }
    }
}

/// A codec whose points form a lattice of triangles with straight edges: oct and sixoct of every size. See
/// [`Dither::encode_stochastic`].
pub trait StochasticRounding: Codec + sealed::Sealed {
    #[doc(hidden)]
    fn encode_one_of(v: [f32; 3], random: u32) -> Self::Code;
    /// Of equally long slices.
    #[doc(hidden)]
    fn encode_soa_one_of(v: Soa<'_>, random: &[u32], codes: &mut [Self::Code]);
}

mod sealed {
    pub trait Sealed {}
}

macro_rules! stochastic_rounding {
    ($($codec:ident)*) => {$(
        impl sealed::Sealed for $codec {}

        impl StochasticRounding for $codec {
            #[inline]
            fn encode_one_of([x, y, z]: [f32; 3], random: u32) -> Self::Code {
                let mut code = [Self::Code::zeroed()];
                encode_block::<<$codec as Behind>::Formula, _, f32>(&[x], &[y], &[z], &[random], &mut code);
                code[0]
            }
            #[inline]
            fn encode_soa_one_of(v: Soa<'_>, random: &[u32], codes: &mut [Self::Code]) {
                let formula = PhantomData::<<$codec as Behind>::Formula>;
                dispatch(EncodeOneOf { v, random, codes, formula });
            }
        }
    )*};
}

stochastic_rounding! {
    Oct8 Oct10 Oct12 Oct14 Oct16 Oct18 Oct20 Oct22 Oct24 Oct26 Oct28 Oct30 Oct32
    SixOct16 SixOct24 SixOct32
}

struct EncodeOneOf<'a, F, C> {
    v: Soa<'a>,
    random: &'a [u32],
    codes: &'a mut [C],
    formula: PhantomData<F>,
}

impl<F: Lattice, C: Stored<One>> Job for EncodeOneOf<'_, F, C> {
    #[inline(always)]
    fn run<V: Simd>(self) -> Self {
        let EncodeOneOf { v: Soa { x, y, z }, random, codes, formula } = self;
        let ((xs, x), (ys, y), (zs, z)) = (V::split(x), V::split(y), V::split(z));
        let ((randoms, random), (blocks, codes)) = (V::split(random), V::split_mut(codes));
        for ((((x, y), z), random), codes) in xs.iter().zip(ys).zip(zs).zip(randoms).zip(blocks) {
            encode_block::<F, C, V>(x, y, z, random, codes);
        }
        EncodeOneOf { v: Soa { x, y, z }, random, codes, formula }
    }
}

#[inline(always)]
fn encode_block<F: Lattice, C: Stored<One>, V: Simd>(
    x: &V::Block<f32>,
    y: &V::Block<f32>,
    z: &V::Block<f32>,
    random: &V::Block<u32>,
    codes: &mut V::Block<C>,
) {
    let v = F::prepare([V::load(x), V::load(y), V::load(z)]);
    // From 0 to 1, 1 excluded.
    let t = V::from_int(V::load_int(random, |bits| bits >> 8)) * V::splat(1.0 / 16_777_216.0);
    C::store::<V>(F::encode_one_of(v, t), codes);
}
