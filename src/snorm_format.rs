//! Three snorm components of any width.

use crate::batch::layout::{self, CodeLayout, Codes, CodesMut, Vectors, VectorsMut};
use crate::batch::storage::OneLane;
use crate::error::{LengthMismatch, StrideMismatch};
use crate::formula::cartesian::{Xyz, Xyz16};
use crate::formula::support::bits::snorm_max;
use crate::formula::{Formula, Kernels};
use crate::vector::{Soa, SoaMut, Strided, StridedMut};

/// Three snorm components of 4 to 16 bits each, chosen at run time.
///
/// Up to 10 bits a code is one integer of 32 bits, with x in the low bits, as [`Snorm10x3`](crate::Snorm10x3) has it.
/// Above, it is three words of 16 bits, as [`Snorm16x3`](crate::Snorm16x3) has them, in which the sign is repeated and decoding ignores what
/// is above a component's bits. In bytes, codes are little-endian.
///
/// Decoding divides by the length. `encode` rounds each component and `encode_precise` gives the nearest direction of any
/// length. Only that is stable: a buffer that is decoded and encoded again keeps its bytes with `encode_precise`. From 11 bits on it is
/// slow: at 16, 17 µs a vector of a batch and 32 µs alone. Inputs are as those of every [`Codec`](crate::Codec).
///
/// ```
/// use unitpack::{Codec, Snorm10x3, SnormFormat};
/// let format = SnormFormat::new(9).ok_or("not from 4 to 16")?;
/// let code = format.encode_precise([0.0, 0.6, 0.8]);
/// assert!((format.decode(code)[1] - 0.6).abs() < 2e-3);
/// assert_eq!(SnormFormat::new(10).unwrap().encode([1.0, 2.0, 3.0]), Snorm10x3::encode([1.0, 2.0, 3.0]).into());
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SnormFormat {
    bits: u32,
}

/// Does something with the formula of a format.
macro_rules! with_formula {
    ($format:expr, |$formula:ident| $body:expr) => {
        if $format.bits <= 10 {
            let $formula = Xyz::snorm([$format.bits; 3]);
            $body
        } else {
            let $formula = Xyz16::snorm($format.bits);
            $body
        }
    };
}

impl SnormFormat {
    /// Components of 4 to 16 bits each, otherwise `None`.
    #[inline]
    pub const fn new(bits: u32) -> Option<Self> {
        if 4 <= bits && bits <= 16 { Some(SnormFormat { bits }) } else { None }
    }

    /// Number of bits of a component.
    #[inline]
    pub const fn component_bits(self) -> u32 {
        self.bits
    }

    /// Size of a code in bytes: 4, or 6 above 10 bits a component.
    #[inline]
    pub const fn code_size(self) -> usize {
        if self.bits <= 10 { 4 } else { 6 }
    }

    /// A bound of the greatest error of `encode`, in degrees.
    #[inline]
    pub const fn max_error_degrees(self) -> f64 {
        50.1 / snorm_max(self.bits) as f64 + 2e-5
    }

    /// A bound of the greatest error of `encode_precise`, in degrees.
    #[inline]
    pub const fn max_error_precise_degrees(self) -> f64 {
        41.0 / snorm_max(self.bits) as f64 + 2e-5
    }

    /// Packs a vector of any length, rounding each component to nearest, ties to even.
    #[inline]
    pub fn encode(self, v: [f32; 3]) -> u64 {
        with_formula!(self, |formula| formula.encode::<f32>(formula.prepare(v.into())).to_u64())
    }

    /// Packs a vector of any length into the code that decodes closest to it, up to `f32` rounding.
    #[inline]
    pub fn encode_precise(self, v: [f32; 3]) -> u64 {
        with_formula!(self, |formula| {
            formula.encode_precise::<f32>(formula.prepare(v.into())).to_u64()
        })
    }

    /// Unpacks a code, any bit pattern, into a vector of length 1 to 2.5e-7.
    #[inline]
    pub fn decode(self, code: u64) -> [f32; 3] {
        with_formula!(self, |formula| formula.decode::<f32>(OneLane::from_u64(code)).to_array())
    }

    /// [`encode`](SnormFormat::encode) for structures of arrays, to little-endian codes without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless the three slices are equally long and `bytes` has `code_size` for each; nothing is
    /// written then.
    pub fn encode_soa(self, v: Soa<'_>, bytes: &mut [u8]) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_bytes([v.x.len(), v.y.len(), v.z.len()], bytes.len(), size)?;
        self.encode_batch(v.into(), CodesMut::little_endian(bytes, size));
        Ok(())
    }

    /// [`encode_precise`](SnormFormat::encode_precise) for structures of arrays, to little-endian codes without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless the three slices are equally long and `bytes` has `code_size` for each; nothing is
    /// written then.
    pub fn encode_soa_precise(self, v: Soa<'_>, bytes: &mut [u8]) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_bytes([v.x.len(), v.y.len(), v.z.len()], bytes.len(), size)?;
        self.encode_batch_precise(v.into(), CodesMut::little_endian(bytes, size));
        Ok(())
    }

    /// [`decode`](SnormFormat::decode) for structures of arrays, from little-endian codes without gaps.
    ///
    /// # Errors
    /// [`LengthMismatch`] unless the three slices are equally long and `bytes` has `code_size` for each; nothing is
    /// written then.
    pub fn decode_soa(self, bytes: &[u8], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        let size = self.code_size();
        LengthMismatch::check_bytes([v.x.len(), v.y.len(), v.z.len()], bytes.len(), size)?;
        self.decode_batch(Codes::little_endian(bytes, size), v.into());
        Ok(())
    }

    /// [`encode`](SnormFormat::encode) for vectors of three native floats and little-endian codes, both at a stride. See
    /// [`Strided`].
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided(
        self,
        v: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded(codes, CodeLayout::little_endian(self.code_size()))?;
        self.encode_batch(v, codes);
        Ok(())
    }

    /// [`encode_precise`](SnormFormat::encode_precise) for vectors and codes at a stride, as
    /// [`encode_strided`](SnormFormat::encode_strided) takes them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn encode_strided_precise(
        self,
        v: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded(codes, CodeLayout::little_endian(self.code_size()))?;
        self.encode_batch_precise(v, codes);
        Ok(())
    }

    /// [`decode`](SnormFormat::decode) for codes and vectors at a stride, as
    /// [`encode_strided`](SnormFormat::encode_strided) takes them. What lies between the vectors stays as it is.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    pub fn decode_strided(
        self,
        codes: Strided<'_>,
        v: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let (codes, v) = codes.decoded(v, CodeLayout::little_endian(self.code_size()))?;
        self.decode_batch(codes, v);
        Ok(())
    }

    fn encode_batch(self, v: Vectors<'_, 3>, codes: CodesMut<'_>) {
        with_formula!(self, |formula| {
            layout::encode(v, codes, &mut |v, codes| Kernels::encode(&formula, v, codes));
        });
    }

    fn encode_batch_precise(self, v: Vectors<'_, 3>, codes: CodesMut<'_>) {
        with_formula!(self, |formula| {
            layout::encode(v, codes, &mut |v, codes| Kernels::encode_precise(&formula, v, codes));
        });
    }

    fn decode_batch(self, codes: Codes<'_>, v: VectorsMut<'_, 3>) {
        with_formula!(self, |formula| {
            layout::decode(codes, v, &mut |codes, v, fence| {
                Kernels::decode(&formula, codes, v, fence);
            });
        });
    }
}
