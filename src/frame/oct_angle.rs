//! An octahedral normal, and the tangent's angle around it.

use crate::batch::Encoder;
use crate::codec::oct::{Central, Oct};
use crate::formula::Formula;
use crate::lane::{Lane, LaneInt};
use crate::low_dimensions::{angle_direction, nearest_angle};

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
    fn encode<E: Encoder, L: Lane>(frame: Prepared<L>) -> [L::Int; 2] {
        let oct = E::encode::<Oct<Central, OCT>, L>(frame.normal);
        // Around the normal that the decoder will have.
        let normal = Oct::<Central, OCT>::decode::<L>(oct);
        let angle = nearest_angle::<ANGLE, L>(frame.tangent_in(basis(normal)));
        let sign = L::Int::select(frame.negative, L::Int::splat(i32::MIN), L::Int::splat(0));
        if Self::WIDE {
            [oct, angle | sign]
        } else {
            [oct | angle.shl(OCT) | sign, L::Int::splat(0)]
        }
    }

    #[inline(always)]
    fn decode<L: Lane>([low, high]: [L::Int; 2]) -> Decoded<L> {
        let normal = Oct::<Central, OCT>::decode::<L>(low);
        let (angle, last) = if Self::WIDE { (high, high) } else { (low.shr(OCT), low) };
        let tangent = unit_combination(angle_direction::<ANGLE, L>(angle), basis(normal));
        Decoded { normal, tangent, handedness: sign(last) }
    }

    #[inline(always)]
    fn canonical<L: Lane>([low, high]: [L::Int; 2]) -> [L::Int; 2] {
        let oct = Oct::<Central, OCT>::canonical::<L>(low);
        if Self::WIDE { [oct, high] } else { [oct | low.shr(OCT).shl(OCT), high] }
    }
}
