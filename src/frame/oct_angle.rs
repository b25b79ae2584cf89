//! An octahedral normal, and the tangent's angle around it.

use crate::batch::Encoder;
use crate::formula::Formula;
use crate::formula::oct::{Central, Oct};
use crate::low_dimensions::{angle_direction, nearest_angle};
use crate::simd::{Simd, SimdInt};

use super::formula::{Decoded, FrameFormula, Prepared, basis, sign, unit_combination};

/// `OCT` bits of normal, `ANGLE` of tangent and one of handedness, 32 or 64 in all.
pub(crate) struct OctAngle<const OCT: u32, const ANGLE: u32>;

impl<const OCT: u32, const ANGLE: u32> OctAngle<OCT, ANGLE> {
    /// Whether the angle stands in a word of its own.
    const WIDE: bool = {
        assert!(OCT == 32 && ANGLE == 31 || OCT + ANGLE == 31);
        OCT == 32
    };
}

impl<const OCT: u32, const ANGLE: u32> FrameFormula for OctAngle<OCT, ANGLE> {
    #[inline(always)]
    fn encode<E: Encoder, V: Simd>(frame: Prepared<V>) -> [V::Int; 2] {
        let oct = E::encode::<Oct<Central, OCT>, V>(frame.normal);
        // Around the normal that the decoder will have.
        let normal = Oct::<Central, OCT>::decode::<V>(oct);
        let angle = nearest_angle::<ANGLE, V>(frame.tangent_in(basis(normal)));
        let sign = V::Int::select(frame.negative, V::Int::splat(i32::MIN), V::Int::splat(0));
        if Self::WIDE {
            [oct, angle | sign]
        } else {
            [oct | angle.shl(OCT) | sign, V::Int::splat(0)]
        }
    }

    #[inline(always)]
    fn decode<V: Simd>([low, high]: [V::Int; 2]) -> Decoded<V> {
        let normal = Oct::<Central, OCT>::decode::<V>(low);
        let (angle, last) = if Self::WIDE { (high, high) } else { (low.shr(OCT), low) };
        let tangent = unit_combination(angle_direction::<ANGLE, V>(angle), basis(normal));
        Decoded { normal, tangent, handedness: sign(last) }
    }

    #[inline(always)]
    fn canonical<V: Simd>([low, high]: [V::Int; 2]) -> [V::Int; 2] {
        let oct = Oct::<Central, OCT>::canonical::<V>(low);
        if Self::WIDE { [oct, high] } else { [oct | low.shr(OCT).shl(OCT), high] }
    }
}
