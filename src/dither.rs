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

use crate::batch::columns::{CodeColumn, Columns, Indices};
use crate::batch::layout::{self, Codes, CodesMut, Vectors, VectorsMut};
use crate::batch::storage::{Words, to_native};
use crate::batch::{Kernel, map};
use crate::codec::{Codec, Format, for_each_codec};
use crate::error::LengthMismatch;
use crate::formula::Lattice;
use crate::formula::names::*;
use crate::formula::support::sanitize::sanitize;
use crate::simd::{I32x1, Simd, SimdInt, Use, Vec3, map3};
use crate::vector::{Soa, SoaMut};

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
    /// [`Float32x3`](crate::Float32x3) too, what is no direction is taken as +Z.
    #[inline]
    pub fn encode<C: Codec>(self, index: u32, v: [f32; 3]) -> C::Code {
        C::encode(Rotation::of(C::FORMAT).turn_one(v, self.index(index)))
    }

    /// [`Codec::encode_precise`] of a vector that is element `index`.
    #[inline]
    pub fn encode_precise<C: Codec>(self, index: u32, v: [f32; 3]) -> C::Code {
        C::encode_precise(Rotation::of(C::FORMAT).turn_one(v, self.index(index)))
    }

    /// The vector of element `index`, of length 1 to 2.5e-7.
    #[inline]
    pub fn decode<C: Codec>(self, index: u32, code: C::Code) -> [f32; 3] {
        Rotation::of(C::FORMAT).back().turn_one(C::decode(code), self.index(index))
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
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        self.encode_turned(&C::encode_batch, C::FORMAT, first, v.into(), CodesMut::native(codes));
        Ok(())
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
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        self.encode_turned(
            &C::encode_batch_precise,
            C::FORMAT,
            first,
            v.into(),
            CodesMut::native(codes),
        );
        Ok(())
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
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        self.decode_turned(&C::decode_batch, C::FORMAT, first, Codes::native(codes), v.into());
        Ok(())
    }

    /// Stochastic rounding: one of the three points around `v`, each with such a probability that their mean has the
    /// direction of `v`. For what is summed over many elements or frames, each with its own index or seed: a sum of
    /// nearest codes would keep their common error, this one's shrinks with the root of their number.
    ///
    /// The error of one vector is up to twice the greatest of [`Codec::encode_precise`]. An axis is kept, and so is any point
    /// of the lattice except for `f32` rounding, which of 10^6 draws at 32 bits moves some 200. Decoding is that of the codec,
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
        C::encode_one(self.index(index), v)
    }

    /// [`encode_stochastic`](Dither::encode_stochastic) for structures of arrays, whose first vector is element
    /// `first`.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    pub fn encode_soa_stochastic<C: StochasticRounding>(
        self,
        first: u32,
        v: Soa<'_>,
        codes: &mut [C::Code],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        C::encode_batch_stochastic(self.index(first), v.into(), CodesMut::native(codes));
        Ok(())
    }

    /// The number that the rotation of element `first`, and those after it, come from.
    #[inline(always)]
    fn index(self, first: u32) -> u32 {
        self.start.wrapping_add(first)
    }

    #[inline(never)]
    fn encode_turned(
        self,
        encode: &dyn Fn(Vectors<'_, 3>, CodesMut<'_>),
        format: Format,
        first: u32,
        vectors: Vectors<'_, 3>,
        codes: CodesMut<'_>,
    ) {
        let turn = Turn(Rotation::of(format));
        let mut number = self.index(first);
        layout::encode_in_parts(vectors, codes, &mut |v, codes, mut turned| {
            let numbers = next_numbers(&mut number, v);
            map::<Numbered, Columns<3>>(turn, (v, numbers), turned.each_mut().map(|c| &mut **c));
            encode(Vectors::Columns(turned.map(|c| &*c)), codes.into());
        });
    }

    #[inline(never)]
    fn decode_turned(
        self,
        decode: &dyn Fn(Codes<'_>, VectorsMut<'_, 3>),
        format: Format,
        first: u32,
        codes: Codes<'_>,
        vectors: VectorsMut<'_, 3>,
    ) {
        let turn = Turn(Rotation::of(format).back());
        let mut number = self.index(first);
        layout::decode_in_parts(codes, vectors, &mut |codes, v, mut turned| {
            decode(codes.into(), VectorsMut::Columns(turned.each_mut().map(|c| &mut **c)));
            let turned = turned.map(|c| &*c);
            map::<Numbered, Columns<3>>(turn, (turned, next_numbers(&mut number, turned)), v);
        });
    }
}

/// A number for each vector, from `number` on, which is set to the one after them.
fn next_numbers(number: &mut u32, [x, ..]: [&[f32]; 3]) -> Indices {
    let numbers = Indices { first: *number, len: x.len() };
    *number = number.wrapping_add(x.len() as u32);
    numbers
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

    /// Turns by up to twice the maximum error around each axis, and by at most half a radian.
    #[inline]
    fn of(format: Format) -> Self {
        let reach = 2.0 * format.max_error_precise_degrees().to_radians();
        let reach = if reach < 0.5 { reach } else { 0.5 };
        Rotation { width: (0.5 * reach) as f32, upright: format.is_hemisphere(), back: false }
    }

    #[inline]
    fn back(self) -> Self {
        Rotation { back: true, ..self }
    }

    #[inline(always)]
    fn turn<V: Simd>(self, v: Vec3<V>, number: V::Int) -> Vec3<V> {
        let v = sanitize(v);
        let width = if self.back { -self.width } else { self.width };
        let scale = width * (1.0 / 2_147_483_648.0);
        let [a, b, c] = map3!(Self::STEPS, |step| V::from_int(number * step) * scale);
        let zero = V::splat(0.0);
        let u = if self.upright { Vec3::new(zero, zero, c) } else { Vec3::new(a, b, c) };
        // v + 2 u x (v + u x v) / (1 + |u|^2).
        let turned = u.cross(v + u.cross(v));
        let k = V::splat(2.0) / (u.length_squared() + 1.0);
        let v = v + turned * k;
        if self.back { v.normalize() } else { v }
    }

    #[inline(always)]
    fn turn_one(self, v: [f32; 3], number: u32) -> [f32; 3] {
        self.turn(Vec3::from(v), I32x1(number as i32)).to_array()
    }
}

/// Vectors, and their numbers.
type Numbered = (Columns<3>, Indices);

#[derive(Clone, Copy)]
struct Turn(Rotation);

impl Kernel<Numbered, Columns<3>> for Turn {
    const USE: Use = Use::Sometimes;

    #[inline(always)]
    fn run<V: Simd>(self, (v, number): ([V; 3], V::Int)) -> [V; 3] {
        self.0.turn(Vec3::from(v), number).to_array()
    }
}

/// A codec whose points form a lattice of triangles with straight edges: oct and sixoct of every size. See
/// [`Dither::encode_stochastic`].
pub trait StochasticRounding: Codec {
    /// Of an element with this number.
    #[doc(hidden)]
    fn encode_one(number: u32, v: [f32; 3]) -> Self::Code;
    /// Of the elements from this number on.
    #[doc(hidden)]
    fn encode_batch_stochastic(first: u32, vectors: Vectors<'_, 3>, codes: CodesMut<'_>);
}

/// 32 random bits of each number. Source: Wellons, "Prospecting for Hash Functions", 2018.
#[inline(always)]
fn random<I: SimdInt>(number: I) -> I {
    let x = number;
    let x = (x ^ x.shr_logical(16)) * 0x7FEB_352D;
    let x = (x ^ x.shr_logical(15)) * 0x846C_A68B_u32 as i32;
    x ^ x.shr_logical(16)
}

#[inline(always)]
fn encode_stochastic<F: Lattice, V: Simd>(formula: F, v: Vec3<V>, number: V::Int) -> V::Int {
    // From 0 to 1, 1 excluded.
    let t = V::from_int(random(number).shr_logical(8)) * (1.0 / 16_777_216.0);
    formula.encode_stochastic(formula.prepare(v), t)
}

#[derive(Clone, Copy)]
struct Stochastic<F>(F);

impl<F: Lattice> Kernel<Numbered, CodeColumn<Words>> for Stochastic<F> {
    const USE: Use = Use::Sometimes;

    #[inline(always)]
    fn run<V: Simd>(self, (v, number): ([V; 3], V::Int)) -> V::Int {
        encode_stochastic(self.0, Vec3::from(v), number)
    }
}

#[inline(always)]
fn encode_batch<F: Lattice>(formula: F, first: u32, vectors: Vectors<'_, 3>, codes: CodesMut<'_>) {
    let mut number = first;
    layout::encode(vectors, codes, &mut |v, codes| {
        let numbers = next_numbers(&mut number, v);
        map::<Numbered, CodeColumn<Words>>(Stochastic(formula), (v, numbers), codes);
    });
}

/// Implements the trait for the rows with the flag `stochastic`.
macro_rules! stochastic_rounding {
    ($name:ident, $code:ty, $bits:literal, $value:expr) => {
        impl StochasticRounding for crate::codec::$name {
            #[inline]
            fn encode_one(number: u32, v: [f32; 3]) -> $code {
                let code = encode_stochastic($value, Vec3::from(v), I32x1(number as i32));
                to_native::<[u8; size_of::<$code>()], $code>(code)
            }
            #[inline]
            fn encode_batch_stochastic(first: u32, vectors: Vectors<'_, 3>, codes: CodesMut<'_>) {
                $value.encode_stochastic_batch(first, vectors, codes);
            }
        }
    };
}

for_each_codec!(@row stochastic: stochastic_rounding);

#[cfg(feature = "oct")]
impl Oct<Central> {
    #[inline(never)]
    fn encode_stochastic_batch(self, first: u32, vectors: Vectors<'_, 3>, codes: CodesMut<'_>) {
        encode_batch(self, first, vectors, codes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(feature = "octahedral")]
    use crate::codec::{HemiOct16, Oct16, Oct24};

    const FREE: Rotation = Rotation { width: 0.25, upright: false, back: false };
    const UPRIGHT: Rotation = Rotation { upright: true, ..FREE };

    #[test]
    fn steps_are_powers_of_the_root_of_roberts() {
        let g = (0..100).fold(1.2f64, |g, _| (g + 1.0).sqrt().sqrt());
        assert!((g - 1.220_744_084_605_76).abs() < 1e-13);
        for (step, power) in Rotation::STEPS.into_iter().zip(1..) {
            let exact = 4_294_967_296.0 / g.powi(power);
            assert!((f64::from(step as u32) - exact).abs() < 1.0, "{power}");
        }
    }

    #[test]
    fn random_bits_are_those_of_the_source() {
        // lowbias32, computed elsewhere.
        let values = [0, 1, 2, -1].map(|n| random(I32x1(n)).0 as u32);
        assert_eq!(values, [0, 0x6889_90C0, 0xD113_2181, 0x6768_824A]);
    }

    #[test]
    fn the_angle_is_that_of_the_vector() {
        // Element 1: u.z = 0.25 (2^32 / g^3 - 2^32) / 2^31 = -0.225150; 2 atan 0.225150 = 25.3771 degrees.
        let v = UPRIGHT.turn_one([1.0, 0.0, 0.0], 1);
        assert!((v[0] - 0.903_507).abs() < 1e-5 && (v[1] + 0.428_574).abs() < 1e-5, "{v:?}");
        assert_eq!(v[2], 0.0);
    }

    #[test]
    fn element_zero_is_not_turned() {
        let v = [0.48, 0.36, 0.8];
        assert_eq!(FREE.turn_one(v, 0), v);
        // A length is kept, and not kept on the way back.
        assert_eq!(FREE.turn_one([0.0, 0.0, 4.0], 0), [0.0, 0.0, 4.0]);
        assert_eq!(FREE.back().turn_one([0.0, 0.0, 4.0], 0), [0.0, 0.0, 1.0]);
        assert_eq!(FREE.turn_one([f32::NAN, 0.0, 0.0], 0), [0.0, 0.0, 1.0]);
    }

    #[test]
    fn turning_back_undoes_turning() {
        for rotation in [FREE, UPRIGHT] {
            for number in [1, 2, 3, 1000, u32::MAX] {
                let v = Vec3::new(0.48f32, 0.36, 0.8);
                let turned = Vec3::from(rotation.turn_one(v.to_array(), number));
                assert!((turned.length_squared() - 1.0).abs() < 1e-6);
                assert!(
                    turned.distance_squared(v) > 1e-3 && (!rotation.upright || turned.z == v.z)
                );
                let back = Vec3::from(rotation.back().turn_one(turned.to_array(), number));
                assert!(back.distance_squared(v) < 1e-12, "{back:?}");
            }
        }
    }

    #[cfg(feature = "octahedral")]
    #[test]
    fn the_width_is_the_greatest_error() {
        // 0.6406 degrees; a hemisphere's vectors turn around Z.
        let rotation = Rotation::of(Oct16::FORMAT);
        assert!((rotation.width - 0.011_181).abs() < 1e-6 && !rotation.upright);
        assert!(Rotation::of(HemiOct16::FORMAT).upright);
    }

    #[cfg(feature = "octahedral")]
    #[test]
    fn batches_give_what_single_vectors_do() {
        // Across the ends of blocks and parts, and of the numbers.
        const LEN: usize = 256 + 35;
        let first = u32::MAX - 20;
        let x: [f32; LEN] = core::array::from_fn(|i| 0.01 * i as f32 - 1.0);
        let (y, z) = ([0.3; LEN], [-0.7; LEN]);
        let v = || Soa { x: &x, y: &y, z: &z };
        let dither = Dither::new(5);
        let [mut codes, mut precise, mut stochastic] = [[[0; 3]; LEN]; 3];
        dither.encode_soa::<Oct24>(first, v(), &mut codes).unwrap();
        dither.encode_soa_precise::<Oct24>(first, v(), &mut precise).unwrap();
        dither.encode_soa_stochastic::<Oct24>(first, v(), &mut stochastic).unwrap();
        let [mut a, mut b, mut c] = [[0.0; LEN]; 3];
        let decoded = SoaMut { x: &mut a, y: &mut b, z: &mut c };
        dither.decode_soa::<Oct24>(first, &codes, decoded).unwrap();
        for i in 0..LEN {
            let (index, v) = (first.wrapping_add(i as u32), [x[i], y[i], z[i]]);
            assert_eq!(codes[i], dither.encode::<Oct24>(index, v));
            assert_eq!(precise[i], dither.encode_precise::<Oct24>(index, v));
            assert_eq!(stochastic[i], dither.encode_stochastic::<Oct24>(index, v));
            assert_eq!([a[i], b[i], c[i]], dither.decode::<Oct24>(index, codes[i]));
        }
        assert_ne!(codes[..3], precise.map(|_| Oct24::encode([-1.0, 0.3, -0.7]))[..3]);
    }

    #[cfg(feature = "octahedral")]
    #[test]
    fn slices_of_other_lengths_are_refused() {
        let mut codes = [7; 2];
        let v = Soa { x: &[1.0; 3], y: &[1.0; 3], z: &[1.0; 3] };
        let result = Dither::new(0).encode_soa::<Oct16>(0, v, &mut codes);
        assert_eq!(result, Err(LengthMismatch::Soa { x: 3, y: 3, z: 3, codes: 2 }));
        assert_eq!(codes, [7; 2]);
    }
}
