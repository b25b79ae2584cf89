//! Codes that no encoder gives.

use crate::batch::storage::MAX_CODE;

/// Which code of a family's formats no encoder gives.
#[derive(Clone, Copy)]
pub(super) enum Spare {
    /// All bits are zero but the highest: the last parameter is the snorm that reads as its neighbour, or a bit
    /// is set that has no meaning. In three bytes, where parameters are biased, all bits.
    HighestBit,
    /// All bits are zero but the second highest: the same, below a sign.
    BelowHighest,
    /// All bits are one.
    AllBits,
    /// All bits are zero.
    Zero,
    /// Encoders give all codes.
    Never,
}

impl Spare {
    /// The code's little-endian bytes.
    pub(super) const fn code(self, bits: u32, size: usize) -> Option<[u8; MAX_CODE]> {
        let all = if bits == 96 { 0 } else { u64::MAX >> (64 - bits) };
        let code = match self {
            Spare::HighestBit if size != 3 => all ^ all >> 1,
            Spare::HighestBit | Spare::AllBits => all,
            Spare::BelowHighest => (all ^ all >> 1) >> 1,
            Spare::Zero => 0,
            Spare::Never => return None,
        };
        let mut bytes = [0; MAX_CODE];
        let mut i = 0;
        while i < 8 {
            bytes[i] = (code >> (8 * i)) as u8;
            i += 1;
        }
        Some(bytes)
    }
}

/// A code in native bytes, of integers of `element` bytes.
pub(super) const fn native<const N: usize>(
    little_endian: [u8; MAX_CODE],
    element: usize,
) -> [u8; N] {
    let mut bytes = [0; N];
    let mut i = 0;
    while i < N {
        let from = if cfg!(target_endian = "big") { i ^ (element - 1) } else { i };
        bytes[i] = little_endian[from];
        i += 1;
    }
    bytes
}
