//! No packing at all.

use crate::batch::storage::Words3;
use crate::formula::Formula;
use crate::formula::support::sign::sign_bit;
use crate::simd::{Simd, Vec3, map3};

/// Three `f32`, bit for bit.
#[derive(Clone, Copy)]
pub(crate) struct Floats;

impl Floats {
    pub(crate) const fn new() -> Self {
        Floats
    }
}

impl Formula for Floats {
    type Shape = Words3;
    const KEEPS_LENGTH: bool = true;
    const ONE_ENCODER: bool = true;

    #[inline(always)]
    fn prepare<V: Simd>(self, v: Vec3<V>) -> Vec3<V> {
        v
    }
    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> [V::Int; 3] {
        map3!(v.to_array(), |c| c.to_bits())
    }
    #[inline(always)]
    fn decode<V: Simd>(self, code: [V::Int; 3]) -> Vec3<V> {
        Vec3::from(map3!(code, |bits| V::from_bits(bits)))
    }
    #[inline(always)]
    fn mirror<V: Simd>(self, code: [V::Int; 3], flips: [bool; 3]) -> [V::Int; 3] {
        map3!([0, 1, 2], |i: usize| code[i] ^ sign_bit(flips[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    #[test]
    fn bits_come_back() {
        let bits = [0x7FC0_1234, i32::MIN, 0x4049_0FDB];
        let v = Floats.decode::<f32>(bits.map(I32x1));
        assert_eq!(v.z, core::f32::consts::PI);
        assert_eq!(Floats.encode(Floats.prepare(v)), bits.map(I32x1));
        assert_eq!(Floats.encode_precise(v), bits.map(I32x1));
    }

    #[test]
    fn mirror_images_change_sign_bits() {
        let code = [1, 2, i32::MIN].map(I32x1);
        assert_eq!(Floats.mirror::<f32>(code, [false; 3]), code);
        let mirrored = Floats.mirror::<f32>(code, [true, false, false]);
        assert_eq!(mirrored, [i32::MIN | 1, 2, i32::MIN].map(I32x1));
    }
}
