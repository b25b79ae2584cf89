//! An octahedral normal, and the tangent's angle around it.

use crate::formula::Formula;
use crate::formula::circle::Circle;
use crate::formula::oct::{Central, Oct};
use crate::simd::{I32x1, Simd, SimdInt};

use super::formula::{Decoded, FrameFormula, Prepared, basis, sign, unit_combination};

/// Bits of angle that encoders give; where there are more, they are zero. `f32` rounding moves a decoded angle by up to a
/// quarter of their step, so that it is encoded as it was.
pub(super) const EMITTED: u32 = 22;

/// A normal, an angle and a sign bit, from the low bits up: at most 64 bits in all.
#[derive(Clone, Copy)]
pub(super) struct OctAngle {
    oct: Oct<Central>,
    angle: Circle,
    /// The angles that encoders give.
    emitted: Circle,
    /// Where the angle begins, from 8 to 32.
    shift: u32,
    /// How far the sign is below the highest bit of its word.
    below_top: u32,
    /// The sign's bit, a mask a word.
    sign: [i32; 2],
}

impl OctAngle {
    /// An even number of bits for the normal, from 8 to 32, and from 1 to 31 for the angle.
    pub(super) const fn new(oct_bits: u32, angle_bits: u32) -> Self {
        let sign_at = oct_bits + angle_bits;
        OctAngle {
            oct: Oct::plain(oct_bits),
            angle: Circle::new(angle_bits),
            emitted: Circle::new(if angle_bits < EMITTED { angle_bits } else { EMITTED }),
            shift: oct_bits,
            below_top: 31 - sign_at % 32,
            sign: halves(1 << sign_at),
        }
    }

    /// Number of low bits of the angle that encoders leave zero.
    #[inline(always)]
    fn zeros(self) -> u32 {
        self.angle.bits() - self.emitted.bits()
    }

    /// The code of a normal's code, an angle and a sign.
    #[inline(always)]
    fn pack<V: Simd>(self, oct: V::Int, angle: V::Int, negative: V::Mask) -> [V::Int; 2] {
        let [sign_low, sign_high] = self.sign.map(|bit| V::Int::select(negative, bit, 0));
        // In two steps, as one by all 32 bits is not defined.
        let low = angle.shl(self.shift - 1).shl(1);
        let high = angle.shr_logical(32 - self.shift);
        [oct | low | sign_low, high | sign_high]
    }

    /// The angle in the low bits, and the sign in the highest. Other bits are any.
    #[inline(always)]
    fn angle_and_sign<V: Simd>(self, [low, high]: [V::Int; 2]) -> [V::Int; 2] {
        let angle = low.shr_logical(self.shift - 1).shr_logical(1) | high.shl(32 - self.shift);
        let [sign_low, sign_high] = self.sign;
        [angle, ((low & sign_low) | (high & sign_high)).shl(self.below_top)]
    }

    /// The code of a point of the octahedron's square, an angle and whether the handedness is -1. What is out of range
    /// is clamped, or for the angle wrapped.
    pub(super) fn pack_parameters(
        self,
        params: [i32; 2],
        angle: u32,
        negative: bool,
    ) -> [I32x1; 2] {
        let oct = self.oct.pack::<f32>(params.map(I32x1));
        self.pack::<f32>(oct, I32x1(angle as i32).low_bits(self.angle.bits()), negative)
    }

    /// What [`pack_parameters`](OctAngle::pack_parameters) takes.
    pub(super) fn unpack_parameters(self, code: [I32x1; 2]) -> ([i32; 2], u32, bool) {
        let [low, _] = code;
        let [angle, sign] = self.angle_and_sign::<f32>(code);
        let angle = angle.low_bits(self.angle.bits()).0 as u32;
        (self.oct.unpack::<f32>(low).map(|p| p.0), angle, sign.0 < 0)
    }
}

/// Low and high half.
const fn halves(bits: u64) -> [i32; 2] {
    [bits as i32, (bits >> 32) as i32]
}

impl FrameFormula for OctAngle {
    #[inline(always)]
    fn encode<V: Simd, const PRECISE: bool>(self, frame: Prepared<V>) -> [V::Int; 2] {
        let oct = if PRECISE {
            self.oct.encode_precise(frame.normal)
        } else {
            self.oct.encode(frame.normal)
        };
        // Around the normal that the decoder will have.
        let normal = self.oct.decode::<V>(oct);
        let angle = self.emitted.nearest(frame.tangent_in(basis(normal)));
        self.pack::<V>(oct, angle.shl(self.zeros()), frame.negative)
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: [V::Int; 2]) -> Decoded<V> {
        let [low, _] = code;
        let normal = self.oct.decode::<V>(low);
        let [angle, last] = self.angle_and_sign::<V>(code);
        let tangent = unit_combination(self.angle.direction::<V>(angle), basis(normal));
        Decoded { normal, tangent, handedness: sign(last) }
    }

    #[inline(always)]
    fn canonical<V: Simd>(self, [low, high]: [V::Int; 2]) -> [V::Int; 2] {
        let oct = self.oct.mirror::<V>(low, [false; 3]);
        let [mut angle, sign] = self.angle_and_sign::<V>([low, high]);
        let zeros = self.zeros();
        if zeros > 0 {
            // The nearest of the angles that are given, ties to even.
            let odd = angle.shr_logical(zeros).low_bits(1);
            angle = (angle + odd + ((1 << (zeros - 1)) - 1)).shr_logical(zeros).shl(zeros);
        }
        self.pack::<V>(oct, angle.low_bits(self.angle.bits()), sign.lt(0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::Vec3;

    const BITS32: OctAngle = OctAngle::new(22, 9);
    const BITS64: OctAngle = OctAngle::new(32, 31);

    fn encode(formula: OctAngle, normal: [f32; 3], tangent: [f32; 3], handedness: f32) -> [u32; 2] {
        let frame = || Prepared::new(normal.into(), tangent.into(), handedness);
        let code = formula.encode::<f32, false>(frame());
        assert_eq!(formula.encode::<f32, true>(frame()), code);
        code.map(|word| word.0 as u32)
    }

    #[test]
    fn angles_are_counted_around_the_normal() {
        let z = [0.0, 0.0, 1.0];
        // The basis of +Z is +X and +Y, and 512 steps are a turn.
        for (tangent, angle) in [
            ([1.0, 0.0, 0.0], 0),
            ([1.0, 1.0, 0.0], 64),
            ([0.0, 1.0, 5.0], 128),
            ([-1.0, 0.0, 0.0], 256),
            ([0.0, -1.0, 0.0], 384),
        ] {
            assert_eq!(encode(BITS32, z, tangent, 1.0), [angle << 22, 0]);
            assert_eq!(encode(BITS64, z, tangent, 1.0), [0, angle << 22]);
        }
    }

    #[test]
    fn the_basis_turns_with_the_normal() {
        // Of +X it is -Z and +Y: s = 1, a = -1, so b1 = (1 - 1, 0, -1) and b2 = (0, 1, 0).
        for (tangent, angle) in
            [([0.0, 0.0, -1.0], 0), ([0.0, 1.0, 0.0], 128), ([0.0, 0.0, 1.0], 256)]
        {
            assert_eq!(encode(BITS32, [1.0, 0.0, 0.0], tangent, 1.0), [1023 | angle << 22, 0]);
        }
        // Of -Z it is +X and -Y.
        let code = encode(BITS64, [0.0, 0.0, -1.0], [0.0, -1.0, 0.0], 1.0);
        assert_eq!(code, [0x7FFF_7FFF, 1 << 29]);
    }

    #[test]
    fn the_highest_bit_is_the_handedness() {
        let [z, x] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
        assert_eq!(encode(BITS32, z, x, -0.5), [1 << 31, 0]);
        assert_eq!(encode(BITS64, z, x, -0.5), [0, 1 << 31]);
        assert_eq!(encode(BITS64, z, x, f32::NAN), [0, 0]);
        assert_eq!(BITS32.decode::<f32>([I32x1(i32::MIN), I32x1(0)]).handedness, -1.0);
        assert_eq!(BITS64.decode::<f32>([I32x1(i32::MIN), I32x1(0)]).handedness, 1.0);
    }

    #[test]
    fn without_a_tangent_the_angle_is_zero() {
        for tangent in [[0.0; 3], [0.0, 0.0, -2.0], [f32::NAN, 1.0, 0.0]] {
            assert_eq!(encode(BITS32, [0.0, 0.0, 3.0], tangent, 1.0), [0, 0]);
        }
    }

    #[test]
    fn quarters_around_axes_decode_exactly() {
        let decoded = BITS32.decode::<f32>([I32x1(1023 | 128 << 22), I32x1(0)]);
        assert_eq!(decoded.normal, Vec3::new(1.0, 0.0, 0.0));
        assert_eq!(decoded.tangent, Vec3::new(0.0, 1.0, 0.0));
    }

    #[test]
    fn an_angle_may_lie_in_both_words() {
        // 20 bits of normal, 24 of angle, and the sign.
        let split = OctAngle::new(20, 24);
        let code = split.pack_parameters([-1, 2], 0xAB_CDEF, true).map(|word| word.0 as u32);
        assert_eq!(code, [0xDEF0_0BFF, 0x1ABC]);
        let code = code.map(|word| I32x1(word as i32));
        assert_eq!(split.unpack_parameters(code), ([-1, 2], 0xAB_CDEF, true));
        // What is above the sign does not count.
        let [low, high] = code;
        let given = split.pack_parameters([-1, 2], 0xAB_CDF0, true);
        assert_eq!(split.canonical::<f32>([low, high | 0x7FFF_E000]), given);
        assert_eq!(split.decode::<f32>([low, high | 0x7FFF_E000]).handedness, -1.0);
        assert_eq!(split.decode::<f32>([low, I32x1(0x0ABC)]).handedness, 1.0);
    }

    #[test]
    fn what_is_left_of_the_normals_word_is_the_angle() {
        // The sign is the first word's highest bit, the second's lowest, and within the first.
        for (oct, angle, code) in
            [(24, 7, [0xFF00_0000, 0]), (24, 8, [0xFF00_0000, 1]), (16, 5, [0x003F_0000, 0])]
        {
            let all = OctAngle::new(oct, angle).pack_parameters([0, 0], u32::MAX, true);
            assert_eq!(all.map(|word| word.0 as u32), code);
        }
    }

    #[test]
    fn only_the_normal_has_several_patterns() {
        // -1024 reads as -1023, and (1023, -5) is (1023, 5).
        let canonical =
            |code: u32| BITS32.canonical::<f32>([I32x1(code as i32), I32x1(0)])[0].0 as u32;
        assert_eq!(canonical(0xABC0_0000 | 1024), 0xABC0_0000 | 1025);
        assert_eq!(canonical(0xABC0_0000 | (2048 - 5) << 11 | 1023), 0xABC0_0000 | 5 << 11 | 1023);
    }

    #[test]
    fn long_angles_have_the_digits_that_are_given() {
        // Multiples of 512, ties to even, and a whole turn is none.
        for (angle, given) in [
            (0, 0),
            (256, 0),
            (257, 512),
            (768, 1024),
            (0x1234_5678, 0x1234_5600),
            (0x7FFF_FFB3, 0),
        ] {
            let long = BITS64.canonical::<f32>([I32x1(0x8000), I32x1(angle | i32::MIN)]);
            assert_eq!(long, [I32x1(0x8001), I32x1(given | i32::MIN)], "{angle:x}");
        }
    }
}
