//! An octahedral normal, and the tangent's angle around it.

use crate::formula::Formula;
use crate::formula::circle::Circle;
use crate::formula::oct::{Central, Oct};
use crate::simd::{Simd, SimdInt};

use super::formula::{Decoded, FrameFormula, Prepared, basis, sign, unit_combination};

/// A normal, an angle and a sign bit, in 32 or 64 bits in all.
#[derive(Clone, Copy)]
pub(super) struct OctAngle {
    oct: Oct<Central>,
    angle: Circle,
    /// Where the angle begins, or 32 if it has a word of its own.
    shift: u32,
}

impl OctAngle {
    pub(super) const fn new(oct_bits: u32, angle_bits: u32) -> Self {
        assert!(oct_bits == 32 && angle_bits == 31 || oct_bits + angle_bits == 31);
        OctAngle { oct: Oct::new(oct_bits), angle: Circle::new(angle_bits), shift: oct_bits }
    }
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
        let angle = self.angle.nearest(frame.tangent_in(basis(normal)));
        let sign = V::Int::select(frame.negative, i32::MIN, 0);
        if self.shift == 32 {
            [oct, angle | sign]
        } else {
            [oct | angle.shl(self.shift) | sign, V::Int::splat(0)]
        }
    }

    #[inline(always)]
    fn decode<V: Simd>(self, [low, high]: [V::Int; 2]) -> Decoded<V> {
        let normal = self.oct.decode::<V>(low);
        let (angle, last) =
            if self.shift == 32 { (high, high) } else { (low.shr_logical(self.shift), low) };
        let tangent = unit_combination(self.angle.direction::<V>(angle), basis(normal));
        Decoded { normal, tangent, handedness: sign(last) }
    }

    #[inline(always)]
    fn canonical<V: Simd>(self, [low, high]: [V::Int; 2]) -> [V::Int; 2] {
        let oct = self.oct.mirror::<V>(low, [false; 3]);
        if self.shift == 32 {
            [oct, high]
        } else {
            [oct | low.shr_logical(self.shift).shl(self.shift), high]
        }
    }
}
