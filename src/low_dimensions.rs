//! Unit vectors of one and two dimensions: [`Sign`] in one bit, [`Angle`] in 1 to 24.
//!
//! Source: the closing remark of Cigolle et al., "A Survey of Efficient Representations for
//! Independent Unit Vectors", 2014.

use crate::batch::code_int::CodeInt;
use crate::batch::code_int::holds;
use crate::error::LengthMismatch;
use crate::formula::direction;
use crate::simd::dispatch::{Job, dispatch};
use crate::simd::math::{
    angle_in_octant, sin_cos_of_half, sin_cos_quarter_turns, turn_by_quarters,
};
use crate::simd::{Each, Simd, SimdInt};

/// 1D: a sign, in one bit. 0 is +1, and 1 is -1.
///
/// In bytes, the first of eight values stands in the lowest bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Sign;

impl Sign {
    /// 1 if `x` is below zero, else 0: for zero of either sign and NaN too.
    #[inline]
    pub fn encode(x: f32) -> u8 {
        (x < 0.0).into()
    }

    /// 1 or, if the lowest bit of `code` is set, -1. The other bits are ignored.
    #[inline]
    pub fn decode(code: u8) -> f32 {
        f32::from_bits(1.0f32.to_bits() | u32::from(code) << 31)
    }

    /// [`encode`](Sign::encode) for a slice. `bytes` is an eighth as long as `x`, rounded up; the
    /// bits of the last byte that no value has become 0.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    pub fn encode_slice(x: &[f32], bytes: &mut [u8]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_signs(x.len(), bytes.len())?;
        for (x, byte) in x.chunks(8).zip(bytes) {
            *byte = x.iter().rev().fold(0, |byte, &x| byte << 1 | Self::encode(x));
        }
        Ok(())
    }

    /// [`decode`](Sign::decode) for a slice. `bytes` is an eighth as long as `x`, rounded up.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the lengths do not fit; nothing is written then.
    pub fn decode_slice(bytes: &[u8], x: &mut [f32]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_signs(x.len(), bytes.len())?;
        for (x, &byte) in x.chunks_mut(8).zip(bytes) {
            for (bit, x) in (0..8).zip(x) {
                *x = Self::decode(byte >> bit);
            }
        }
        Ok(())
    }
}

/// 2D: an angle in `BITS` bits, from 1 to 24. Code k is the direction of k / 2^`BITS` turns, from +X
/// over +Y.
///
/// No code of so many bits is better: the greatest error is half a step, pi / 2^`BITS` radians or
/// 180 / 2^`BITS` degrees, and 1.3e-7 radians of `f32` rounding; the mean is half of that. The axes
/// survive exactly, +-Y from two bits on. Every code is canonical: it encodes back to itself.
///
/// ```text
/// encode   k = round(atan2(y, x) 2^BITS / (2 pi)) mod 2^BITS
/// decode   v = (cos, sin)(2 pi k / 2^BITS)
/// ```
///
/// Other widths do not compile:
///
/// ```compile_fail
/// unitpack::low_dimensions::Angle::<25>::encode([1.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Angle<const BITS: u32>;

impl<const BITS: u32> Angle<BITS> {
    const BITS: u32 = {
        assert!(BITS >= 1 && BITS <= 24, "an angle has from 1 to 24 bits");
        BITS
    };

    /// The nearest code of a vector of any length; of two equally near, the even one.
    ///
    /// Zero and NaN encode as +X, an infinite component as the limit direction.
    #[inline]
    pub fn encode(v: [f32; 2]) -> u32 {
        let mut code = [0];
        Self::encode_block::<u32, f32>(&[v[0]], &[v[1]], &mut code);
        code[0]
    }

    /// The vector of a code, each component with error below 1.2e-7 and its length 1 to 2.5e-7. Bits
    /// above `BITS` are ignored.
    #[inline]
    pub fn decode(code: u32) -> [f32; 2] {
        let (mut x, mut y) = ([0.0], [0.0]);
        Self::decode_block::<u32, f32>(&[code], &mut x, &mut y);
        [x[0], y[0]]
    }

    /// [`encode`](Angle::encode) for structures of arrays, the x and the y components. `T` is `u8`,
    /// `u16` or `u32`; too narrow a one does not compile:
    ///
    /// ```compile_fail
    /// use unitpack::low_dimensions::Angle;
    /// let _ = Angle::<9>::encode_soa(&[1.0], &[0.0], &mut [0u8]);
    /// ```
    ///
    /// # Errors
    /// [`LengthMismatch`] if the three slices are not equally long; nothing is written then.
    pub fn encode_soa<T: CodeInt>(
        x: &[f32],
        y: &[f32],
        codes: &mut [T],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_angles(x.len(), y.len(), codes.len())?;
        dispatch(EncodeAngles::<BITS, T> { x, y, codes });
        Ok(())
    }

    /// [`decode`](Angle::decode) for structures of arrays, the x and the y components. `T` is `u8`,
    /// `u16` or `u32`; too narrow a one does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the three slices are not equally long; nothing is written then.
    pub fn decode_soa<T: CodeInt>(
        codes: &[T],
        x: &mut [f32],
        y: &mut [f32],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_angles(x.len(), y.len(), codes.len())?;
        dispatch(DecodeAngles::<BITS, T> { codes, x, y });
        Ok(())
    }

    #[inline(always)]
    fn encode_block<T: CodeInt, V: Simd>(
        x: &V::Block<f32>,
        y: &V::Block<f32>,
        codes: &mut V::Block<T>,
    ) {
        const { assert!(holds::<T>(Self::BITS), "the integer has too few bits for the angle") };
        // What is no direction becomes (0, 0, 1), and (0, 0) has the angle 0.
        let [x, y, _] = direction([V::load(x), V::load(y), V::zero()]);
        V::store_int(nearest_angle::<BITS, V>([x, y]), codes, |code, k| *code = T::truncate(k));
    }

    #[inline(always)]
    fn decode_block<T: CodeInt, V: Simd>(
        codes: &V::Block<T>,
        x: &mut V::Block<f32>,
        y: &mut V::Block<f32>,
    ) {
        const { assert!(holds::<T>(Self::BITS), "the integer has too few bits for the angle") };
        let [cos, sin] = angle_direction::<BITS, V>(V::load_int(codes, T::into));
        cos.store(x);
        sin.store(y);
    }
}

/// The code of the nearest multiple of 2^-`BITS` turns to the direction (x, y), of which 0 counts as +X:
/// ties to even. For components that are zero or from 2^-100 to 2^60. Above 24 bits the last ones are
/// those of `f32` rounding.
#[inline(always)]
pub(crate) fn nearest_angle<const BITS: u32, V: Simd>([x, y]: [V; 2]) -> V::Int {
    let (ax, ay) = (x.abs(), y.abs());
    // So many eighths of a turn, and a rest in half turns: no digit of a long code is lost.
    let (steep, rest) = angle_in_octant(ax, ay);
    let eighths = V::Int::select(steep, V::Int::splat(1), V::Int::splat(0));
    let mirror = |mask: V::Mask, sum: i32, (eighths, rest): (V::Int, V)| {
        let mirrored = V::Int::splat(sum) - eighths;
        (V::Int::select(mask, mirrored, eighths), V::select(mask, -rest, rest))
    };
    let angle = mirror(ax.lt(ay), 2, (eighths, rest));
    let angle = mirror(x.lt(V::zero()), 4, angle);
    let (eighths, rest) = mirror(y.lt(V::zero()), 0, angle);
    let rest = rest * V::splat((1u32 << (BITS - 1)) as f32);
    let k = if BITS < 3 {
        let eighth = V::splat(if BITS == 1 { 0.25 } else { 0.5 });
        (V::from_int(eighths) * eighth + rest).round_int()
    } else if BITS <= 24 {
        eighths.shl(BITS - 3) + rest.round_int()
    } else {
        // More than a float is rounded to at once. What the first rounding leaves is exact.
        let coarse = (rest * V::splat(1.0 / 256.0)).round_int();
        let fine = (rest - V::from_int(coarse) * V::splat(256.0)).round_int();
        eighths.shl(BITS - 3) + coarse.shl(8) + fine
    };
    k.low(BITS)
}

/// (cos, sin) of the multiple of 2^-`BITS` turns that stands in the low bits of a code, each with error
/// below 1.2e-7, and without negative zeros.
#[inline(always)]
pub(crate) fn angle_direction<const BITS: u32, V: Simd>(code: V::Int) -> [V; 2] {
    let k = code.sign_extend(BITS);
    let (sin, cos) = if BITS <= 24 {
        // Exact, as is its distance from the nearest quarter turn.
        sin_cos_quarter_turns(V::from_int(k) * V::splat(2.0 / (1u32 << (BITS - 1)) as f32))
    } else {
        // The nearest quarter turn in integers, as a float has fewer digits; then the rest.
        let quarter = (k + V::Int::splat(1 << (BITS - 3))).sar(BITS - 2);
        let rest = V::from_int(k - quarter.shl(BITS - 2));
        let rest = rest * V::splat(1.0 / (1u32 << (BITS - 2)) as f32);
        turn_by_quarters(quarter, sin_cos_of_half(rest))
    };
    [cos, sin].each(|c| c + V::zero())
}

struct EncodeAngles<'a, const BITS: u32, T> {
    x: &'a [f32],
    y: &'a [f32],
    codes: &'a mut [T],
}

impl<const BITS: u32, T: CodeInt> Job for EncodeAngles<'_, BITS, T> {
    #[inline(always)]
    fn run<V: Simd>(self) -> Self {
        let EncodeAngles { x, y, codes } = self;
        let ((xs, x), (ys, y), (blocks, codes)) = (V::split(x), V::split(y), V::split_mut(codes));
        for ((x, y), codes) in xs.iter().zip(ys).zip(blocks) {
            Angle::<BITS>::encode_block::<T, V>(x, y, codes);
        }
        EncodeAngles { x, y, codes }
    }
}

struct DecodeAngles<'a, const BITS: u32, T> {
    codes: &'a [T],
    x: &'a mut [f32],
    y: &'a mut [f32],
}

impl<const BITS: u32, T: CodeInt> Job for DecodeAngles<'_, BITS, T> {
    #[inline(always)]
    fn run<V: Simd>(self) -> Self {
        let DecodeAngles { codes, x, y } = self;
        let ((blocks, codes), (xs, x), (ys, y)) =
            (V::split(codes), V::split_mut(x), V::split_mut(y));
        for ((codes, x), y) in blocks.iter().zip(xs).zip(ys) {
            Angle::<BITS>::decode_block::<T, V>(codes, x, y);
        }
        DecodeAngles { codes, x, y }
    }
}
