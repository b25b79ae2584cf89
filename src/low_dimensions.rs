//! Unit vectors of one and two dimensions: [`Sign`] in one bit, [`Angle`] in 1 to 24.
//!
//! Source: the closing remark of Cigolle et al., "A Survey of Efficient Representations for
//! Independent Unit Vectors", 2014.

use crate::batch::code_int::{CodeInt, holds};
use crate::batch::columns::{CodeColumn, Columns};
use crate::batch::layout::{self, Codes, CodesMut, Vectors, VectorsMut};
use crate::batch::storage::Words;
use crate::batch::{Kernel, map, run};
use crate::error::LengthMismatch;
use crate::formula::circle::Circle;
use crate::formula::support::sanitize::sanitize;
use crate::simd::{I32x1, Simd, Use, Vec3};

/// 1D: a sign, in one bit. 0 is +1, and 1 is -1.
///
/// In bytes, the first of eight values is the lowest bit.
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
/// No code of that size is better: the greatest error is half a step, pi / 2^`BITS` radians or
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
    const CIRCLE: Circle = Circle::new(Self::BITS);

    /// The nearest code of a vector of any length; of two equally near, the even one.
    ///
    /// Zero and NaN encode as +X, an infinite component as the limit direction.
    #[inline]
    pub fn encode(v: [f32; 2]) -> u32 {
        Encode(Self::CIRCLE).nearest::<f32>(v).0 as u32
    }

    /// The vector of a code, each component with error below 1.2e-7 and its length 1 to 2.5e-7. Bits
    /// above `BITS` are ignored.
    #[inline]
    pub fn decode(code: u32) -> [f32; 2] {
        Self::CIRCLE.direction::<f32>(I32x1(code as i32))
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
    #[inline]
    pub fn encode_soa<T: CodeInt>(
        x: &[f32],
        y: &[f32],
        codes: &mut [T],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_angles(x.len(), y.len(), codes.len())?;
        const { assert!(holds::<T>(Self::BITS), "the integer has too few bits for the angle") };
        encode(Self::CIRCLE, [x, y], CodesMut::native(codes));
        Ok(())
    }

    /// [`decode`](Angle::decode) for structures of arrays, the x and the y components. `T` is `u8`,
    /// `u16` or `u32`; too narrow a one does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the three slices are not equally long; nothing is written then.
    #[inline]
    pub fn decode_soa<T: CodeInt>(
        codes: &[T],
        x: &mut [f32],
        y: &mut [f32],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_angles(x.len(), y.len(), codes.len())?;
        const { assert!(holds::<T>(Self::BITS), "the integer has too few bits for the angle") };
        decode(Self::CIRCLE, Codes::native(codes), [x, y]);
        Ok(())
    }
}

#[derive(Clone, Copy)]
struct Encode(Circle);
#[derive(Clone, Copy)]
struct Decode(Circle);

impl Encode {
    #[inline(always)]
    fn nearest<V: Simd>(self, [x, y]: [V; 2]) -> V::Int {
        // What is no direction becomes (0, 0, 1), and (0, 0) has the angle 0.
        let v = sanitize(Vec3::new(x, y, V::splat(0.0)));
        self.0.nearest([v.x, v.y])
    }
}

impl Kernel<Columns<2>, CodeColumn<Words>> for Encode {
    const USE: Use = Use::Sometimes;

    #[inline(always)]
    fn run<V: Simd>(self, v: [V; 2]) -> V::Int {
        self.nearest(v)
    }
}

impl Kernel<CodeColumn<Words>, Columns<2>> for Decode {
    const USE: Use = Use::Sometimes;

    #[inline(always)]
    fn run<V: Simd>(self, code: V::Int) -> [V; 2] {
        self.0.direction::<V>(code)
    }
}

#[inline(never)]
fn encode(circle: Circle, xy: [&[f32]; 2], codes: CodesMut<'_>) {
    layout::encode(Vectors::Columns(xy), codes, &mut |xy, codes| {
        map::<Columns<2>, CodeColumn<Words>>(Encode(circle), xy, codes);
    });
}

#[inline(never)]
fn decode(circle: Circle, codes: Codes<'_>, xy: [&mut [f32]; 2]) {
    layout::decode(codes, VectorsMut::Columns(xy), &mut |codes, xy, fence| {
        run::<CodeColumn<Words>, Columns<2>>(Decode(circle), codes, xy, fence);
    });
}
