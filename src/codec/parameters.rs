//! Codes made of two parameters.

use core::ops::RangeInclusive;

use super::Codec;
use crate::formula::support::bits::Pair;
use crate::simd::I32x1;

/// A codec whose code is two snorm or two unorm integers and nothing else, such as u and v of an octahedron's square.
///
/// The codec's page says what the two are, and where in the code: see [Bit layout](Codec#bit-layout). Snorm
/// parameters go from -M to M, with M = 2^(b-1) - 1 for b bits, and unorm ones from 0 to 2^b - 1.
///
/// ```
/// use unitpack::{Codec, Oct16, Oct24, TwoParameters};
/// // The middle of the square is +Z, and its right edge has +X.
/// assert_eq!(Oct16::decode(Oct16::from_parameters([0, 0])), [0.0, 0.0, 1.0]);
/// assert_eq!(Oct16::parameters(Oct16::encode([1.0, 0.0, 0.0])), [127, 0]);
/// // In RGB8 they are biased by 2047, with no need to know it.
/// assert_eq!(Oct24::parameters(Oct24::from_parameters([-2047, 5])), [-2047, 5]);
/// // What is out of range is clamped.
/// assert_eq!(Oct16::parameters(Oct16::from_parameters([1000, -128])), [127, -127]);
/// ```
pub trait TwoParameters: Codec {
    /// The values that a parameter can have. In sixoct the greatest one reads as the one below.
    const RANGE: RangeInclusive<i32>;

    /// The code of two parameters, each clamped to [`RANGE`](TwoParameters::RANGE). It need not be canonical.
    fn from_parameters(parameters: [i32; 2]) -> Self::Code;

    /// The parameters of a code, any bit pattern. A pattern out of range reads as its neighbour.
    fn parameters(code: Self::Code) -> [i32; 2];
}

/// What both parameters are.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Snorm,
    Unorm,
}

impl Kind {
    /// By its name in the table. `None` for "none".
    pub(super) const fn of(name: &str) -> Option<Self> {
        match name.as_bytes() {
            b"snorm" => Some(Kind::Snorm),
            b"unorm" => Some(Kind::Unorm),
            _ => None,
        }
    }

    pub(super) const fn range(self, bits: u32) -> RangeInclusive<i32> {
        let pair = Pair::new(bits);
        match self {
            Kind::Snorm => -pair.snorm_max()..=pair.snorm_max(),
            Kind::Unorm => 0..=pair.unorm_max(),
        }
    }

    pub(super) fn pack(self, bits: u32, parameters: [i32; 2]) -> u32 {
        let (pair, range) = (Pair::new(bits), self.range(bits));
        let parameters = parameters.map(|p| I32x1(p.max(*range.start()).min(*range.end())));
        let code = match self {
            Kind::Snorm => pair.pack_snorm::<f32>(parameters),
            Kind::Unorm => pair.pack::<f32>(parameters),
        };
        code.0 as u32
    }

    pub(super) fn unpack(self, bits: u32, code: u32) -> [i32; 2] {
        let (pair, code) = (Pair::new(bits), I32x1(code as i32));
        let parameters = match self {
            Kind::Snorm => pair.unpack_snorm::<f32>(code),
            Kind::Unorm => pair.unpack::<f32>(code),
        };
        parameters.map(|p| p.0)
    }
}
