//! Digests that do not depend on the byte order, nor on the bits of NaN.

/// FNV-1a, 64 bits.
pub struct Digest(u64);

impl Digest {
    pub fn new() -> Self {
        Digest(0xcbf2_9ce4_8422_2325)
    }

    pub fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    pub fn words<const N: usize>(&mut self, words: [u32; N]) {
        for word in words {
            self.bytes(&word.to_le_bytes());
        }
    }

    /// All NaN count as one, since moving them changes their bits on some machines.
    pub fn floats(&mut self, floats: &[f32]) {
        for &c in floats {
            self.bytes(&if c.is_nan() { f32::NAN } else { c }.to_le_bytes());
        }
    }

    pub fn finish(self) -> u64 {
        self.0
    }
}
