//! The public codecs: what each can do, and how to choose one at run time.

mod axis_order;
mod define;
mod format;
mod iter;
mod or_none;
mod parameters;
mod report;
mod spare;
mod table;

use crate::batch::doubles::{Doubles, to_f32};
use crate::batch::layout::{self, CodeLayout, Codes, CodesMut, Vectors, VectorsMut};
use crate::error::{LengthMismatch, StrideMismatch};
use crate::vector::{Soa, SoaMut, Strided, StridedMut};

pub use axis_order::AxisOrder;
pub use define::*;
pub use format::{UnknownFormat, Visitor, transcode};
pub use iter::{DecodeIter, EncodeIter};
pub use or_none::OrNone;
pub use parameters::TwoParameters;
pub use report::ErrorReport;
pub(crate) use table::{codec_table, for_each_codec};

/// A representation of unit vectors: what a bit pattern means, and how to get there.
///
/// The promises that hold for every codec are listed on the [crate's page](crate#promises). In
/// short: any input is allowed and only its direction matters; zero and NaN encode as +Z, an
/// infinite component as the limit direction, and a hemisphere codec takes z < 0 as 0; every bit
/// pattern decodes to a unit vector; all entry points give the same bits.
///
/// # Bit layout
/// The first parameter is in the low bits, in two's complement if it is snorm. Snorm counts from
/// -M to M, with M = 2^(b-1) - 1 for b bits; the pattern -M-1 reads as -M. A code narrower than its
/// integer leaves the high bits zero, and decoding ignores them.
///
/// Two parameters u and v of 12 bits are three bytes, as in the survey's RGB8:
/// `[u >> 4, (u & 15) << 4 | v >> 8, v & 255]`. Snorm ones are then biased: u and v plus 2047, where
/// 4095 reads as 4094. All other codes of three bytes are integers in little-endian order.
///
/// Formats named biased hold each snorm byte plus 128, as an unsigned one: 128 is zero, and 0 reads as 1.
///
/// # Operations on codes
/// [`canonical`](Codec::canonical), [`negate`](Codec::negate) and [`mirror`](Codec::mirror) take any bit pattern and give
/// what `encode_precise` gives for the decoded vector, or that negated or mirrored: a canonical code. In a hemisphere's format, a
/// direction mirrored in Z falls below the rim, and so is put on it.
///
/// A codec's page lists the axes in which every mirror image is a point of the format. In these, `mirror` is exact: doing it
/// twice gives the canonical code again, and if all three are listed, `negate` is mirroring in each in turn. It works on
/// integers, without decoding.
/// In the others, a code whose image is no point is decoded and encoded precisely, which gives the nearest. Half way between
/// two points, as in X of phi-z and latlong, `f32` rounding decides.
///
/// Formats whose pages say "up to `f32` rounding" are finer than `f32`, and take that longer way everywhere. `Float32x3` flips
/// signs, those of NaN too.
pub trait Codec: Copy + 'static + sealed::Batch {
    /// One packed vector. Its bits are laid out as the codec's page says.
    type Code: bytemuck::Pod + Eq + core::fmt::Debug;
    /// The run-time twin of this type.
    const FORMAT: Format;
    /// A code that no encoder gives, free to say that there is no vector: see [`OrNone`]. `None` if
    /// encoders give all codes, as those of `LatLong16D`, `LatLong24D`, `Fibonacci16`, `Fibonacci24` and `Float32x3` do. It decodes
    /// to a unit vector, as all codes do.
    ///
    /// ```
    /// use unitpack::{Codec, Fibonacci16, Oct16};
    /// assert_eq!(Oct16::NONE, Some(0x8000));
    /// assert!(!Oct16::is_canonical(0x8000));
    /// assert_eq!(Fibonacci16::NONE, None);
    /// ```
    const NONE: Option<Self::Code>;

    /// Packs a vector of any length, rounding each parameter to nearest, ties to even. Gives a
    /// canonical code.
    fn encode(v: [f32; 3]) -> Self::Code;

    /// Packs a vector of any length into the code that decodes closest to it, up to `f32` rounding.
    /// Gives a canonical code.
    fn encode_precise(v: [f32; 3]) -> Self::Code;

    /// Unpacks a code, any bit pattern, into a vector of length 1 to 2.5e-7.
    fn decode(code: Self::Code) -> [f32; 3];

    /// The code that encoders emit for the direction of `code`, any bit pattern: of several that mean
    /// one direction the same. It is `encode_precise(decode(code))`, found without decoding but in
    /// `Snorm12x3`, `Snorm16x3`, `XyzUnorm16x3` and `Float16x3`, where it takes as long as encoding.
    ///
    /// ```
    /// use unitpack::{Codec, Oct16};
    /// // (-127, -5) and (-127, 5) are one point of the border; -128 reads as -127.
    /// let border = |u: i8, w: i8| u16::from_le_bytes([u as u8, w as u8]);
    /// assert_eq!(Oct16::canonical(border(-128, -5)), border(-127, 5));
    /// assert!(Oct16::is_canonical(border(-127, 5)));
    /// ```
    fn canonical(code: Self::Code) -> Self::Code;

    /// Whether encoders emit `code` for its direction.
    #[inline]
    fn is_canonical(code: Self::Code) -> bool {
        Self::canonical(code) == code
    }

    /// The code of the opposite direction: `encode_precise` of the negated `decode(code)`. Most formats find it
    /// without decoding: see [Operations on codes](Codec#operations-on-codes).
    ///
    /// ```
    /// use unitpack::{Codec, Oct16};
    /// let [z, minus_z] = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]].map(Oct16::encode);
    /// assert_eq!(Oct16::negate(z), minus_z);
    /// ```
    fn negate(code: Self::Code) -> Self::Code;

    /// The code of the direction mirrored in one axis: `encode_precise` of `decode(code)` with that component
    /// negated. Most formats find it without decoding: see [Operations on codes](Codec#operations-on-codes).
    ///
    /// ```
    /// use unitpack::{Axis, Codec, Oct16};
    /// // (127, 5) is a point of the border, where (127, -5) means the same.
    /// let code = |u: i8, w: i8| u16::from_le_bytes([u as u8, w as u8]);
    /// assert_eq!(Oct16::mirror(code(127, 5), Axis::X), code(-127, 5));
    /// assert_eq!(Oct16::mirror(code(127, 5), Axis::Y), code(127, 5));
    /// ```
    fn mirror(code: Self::Code, axis: Axis) -> Self::Code;

    /// Whether two codes, any bit patterns, mean one direction: whether their [`canonical`](Codec::canonical)
    /// codes are equal.
    #[inline]
    fn same_direction(a: Self::Code, b: Self::Code) -> bool {
        Self::canonical(a) == Self::canonical(b)
    }

    /// [`canonical`](Codec::canonical) for many codes, in place.
    #[inline]
    fn canonical_slice(codes: &mut [Self::Code]) {
        Self::mirror_batch(CodesMut::native(codes), [false; 3]);
    }

    /// [`negate`](Codec::negate) for many codes, in place.
    #[inline]
    fn negate_slice(codes: &mut [Self::Code]) {
        Self::mirror_batch(CodesMut::native(codes), [true; 3]);
    }

    /// [`mirror`](Codec::mirror) for many codes, in place.
    #[inline]
    fn mirror_slice(codes: &mut [Self::Code], axis: Axis) {
        Self::mirror_batch(CodesMut::native(codes), axis.flips());
    }

    /// [`encode`](Codec::encode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    fn encode_soa(v: Soa<'_>, codes: &mut [Self::Code]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        Self::encode_batch(v.into(), CodesMut::native(codes));
        Ok(())
    }

    /// [`encode_precise`](Codec::encode_precise) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    fn encode_soa_precise(v: Soa<'_>, codes: &mut [Self::Code]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        Self::encode_batch_precise(v.into(), CodesMut::native(codes));
        Ok(())
    }

    /// [`decode`](Codec::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    fn decode_soa(codes: &[Self::Code], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        Self::decode_batch(Codes::native(codes), v.into());
        Ok(())
    }

    /// [`encode`](Codec::encode) for arrays of structures of `N` floats, of which the first three are
    /// x, y and z: of vertices whose *first* field is the vector. Where the position is, take
    /// [`encode_strided`](Codec::encode_strided), or what is packed is the position. `N < 3` does not compile:
    ///
    /// ```compile_fail
    /// use unitpack::{Codec, Oct16};
    /// let _ = Oct16::encode_aos(&[[1.0f32, 0.0]], &mut [0]);
    /// ```
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos<const N: usize>(
        v: &[[f32; N]],
        codes: &mut [Self::Code],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(v.len(), codes.len())?;
        Self::encode_batch(Vectors::rows(v), CodesMut::native(codes));
        Ok(())
    }

    /// [`encode_precise`](Codec::encode_precise) for arrays of structures of `N` floats, of which the
    /// first three are x, y and z. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos_precise<const N: usize>(
        v: &[[f32; N]],
        codes: &mut [Self::Code],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(v.len(), codes.len())?;
        Self::encode_batch_precise(Vectors::rows(v), CodesMut::native(codes));
        Ok(())
    }

    /// [`decode`](Codec::decode) for arrays of structures of `N` floats. The first three become x, y
    /// and z; the others stay as they are. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn decode_aos<const N: usize>(
        codes: &[Self::Code],
        v: &mut [[f32; N]],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(v.len(), codes.len())?;
        Self::decode_batch(Codes::native(codes), VectorsMut::rows(v));
        Ok(())
    }

    /// [`encode`](Codec::encode) for vectors of three native floats and codes, both at a stride: a field of a vertex into a
    /// field of another, without a copy between. Codes are as `Code` lies in memory. See [`Strided`].
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn encode_strided(v: Strided<'_>, codes: StridedMut<'_>) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded(codes, CodeLayout::native::<Self::Code>())?;
        Self::encode_batch(v, codes);
        Ok(())
    }

    /// [`encode_precise`](Codec::encode_precise) for vectors and codes at a stride, as
    /// [`encode_strided`](Codec::encode_strided) takes them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn encode_strided_precise(v: Strided<'_>, codes: StridedMut<'_>) -> Result<(), StrideMismatch> {
        let (v, codes) = v.encoded(codes, CodeLayout::native::<Self::Code>())?;
        Self::encode_batch_precise(v, codes);
        Ok(())
    }

    /// [`decode`](Codec::decode) for codes and vectors at a stride, as [`encode_strided`](Codec::encode_strided) takes
    /// them. What lies between the vectors stays as it is.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn decode_strided(codes: Strided<'_>, v: StridedMut<'_>) -> Result<(), StrideMismatch> {
        let (codes, v) = codes.decoded(v, CodeLayout::native::<Self::Code>())?;
        Self::decode_batch(codes, v);
        Ok(())
    }

    /// [`encode_strided`](Codec::encode_strided) in place: the code of the vector at `v.offset` goes to `code_offset` in the
    /// same bytes, the others each a stride further on. Vector and code may overlap: an element is read before it is written.
    ///
    /// ```
    /// use core::mem::offset_of;
    /// use unitpack::{Codec, Oct32, StridedMut};
    /// // Eight floats: position, normal, uv. The code takes the place of the normal's x.
    /// let mut vertices = [[5.0f32, 5.0, 5.0, 0.0, 0.0, 1.0, 0.5, 0.5]; 10];
    /// Oct32::encode_within(StridedMut::of(&mut vertices, 12), 12)?;
    /// assert_eq!(Oct32::decode(vertices[9][3].to_bits()), [0.0, 0.0, 1.0]);
    /// # Ok::<(), unitpack::StrideMismatch>(())
    /// ```
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or vector and code together are longer than the stride;
    /// nothing is written then.
    #[inline]
    fn encode_within(v: StridedMut<'_>, code_offset: usize) -> Result<(), StrideMismatch> {
        let within = v.vectors_within::<3>(code_offset, CodeLayout::native::<Self::Code>())?;
        layout::encode_within(within, &Self::encode_batch);
        Ok(())
    }

    /// [`encode_precise`](Codec::encode_precise) in place, as [`encode_within`](Codec::encode_within) has it.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or vector and code together are longer than the stride;
    /// nothing is written then.
    #[inline]
    fn encode_within_precise(v: StridedMut<'_>, code_offset: usize) -> Result<(), StrideMismatch> {
        let within = v.vectors_within::<3>(code_offset, CodeLayout::native::<Self::Code>())?;
        layout::encode_within(within, &Self::encode_batch_precise);
        Ok(())
    }

    /// [`decode_strided`](Codec::decode_strided) in place: the vector of the code at `codes.offset` goes to `vector_offset`
    /// in the same bytes. Both may overlap, as in [`encode_within`](Codec::encode_within).
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or vector and code together are longer than the stride;
    /// nothing is written then.
    #[inline]
    fn decode_within(codes: StridedMut<'_>, vector_offset: usize) -> Result<(), StrideMismatch> {
        let within = codes.codes_within::<3>(vector_offset, CodeLayout::native::<Self::Code>())?;
        layout::decode_within(within, &Self::decode_batch);
        Ok(())
    }

    /// [`encode`](Codec::encode) for doubles of any length: of the direction they have, not of what they would be as `f32`,
    /// where 1e40 is infinite. `Float32x3`, which keeps lengths, takes what they are as `f32`.
    ///
    /// ```
    /// use unitpack::{Codec, Oct32};
    /// assert_eq!(Oct32::encode_f64([2e40, 1e40, 0.0]), Oct32::encode([2.0, 1.0, 0.0]));
    /// ```
    #[inline]
    fn encode_f64(v: [f64; 3]) -> Self::Code {
        Self::encode(to_f32(v, Self::FORMAT.keeps()))
    }

    /// [`encode_precise`](Codec::encode_precise) for doubles, as [`encode_f64`](Codec::encode_f64) takes them.
    #[inline]
    fn encode_precise_f64(v: [f64; 3]) -> Self::Code {
        Self::encode_precise(to_f32(v, Self::FORMAT.keeps()))
    }

    /// [`encode_f64`](Codec::encode_f64) for arrays of structures of `N` doubles, of which the first three are x, y and z.
    /// `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos_f64<const N: usize>(
        v: &[[f64; N]],
        codes: &mut [Self::Code],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(v.len(), codes.len())?;
        layout::encode(
            Doubles::rows(v, Self::FORMAT.keeps()),
            CodesMut::native(codes),
            &mut Self::encode_columns,
        );
        Ok(())
    }

    /// [`encode_precise_f64`](Codec::encode_precise_f64) for arrays of structures of `N` doubles, of which the first three are
    /// x, y and z. `N < 3` does not compile.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    fn encode_aos_f64_precise<const N: usize>(
        v: &[[f64; N]],
        codes: &mut [Self::Code],
    ) -> Result<(), LengthMismatch> {
        LengthMismatch::check_aos(v.len(), codes.len())?;
        layout::encode(
            Doubles::rows(v, Self::FORMAT.keeps()),
            CodesMut::native(codes),
            &mut Self::encode_columns_precise,
        );
        Ok(())
    }

    /// [`encode_f64`](Codec::encode_f64) for vectors of three native doubles and codes, both at a stride, as
    /// [`encode_strided`](Codec::encode_strided) takes them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn encode_strided_f64(v: Strided<'_>, codes: StridedMut<'_>) -> Result<(), StrideMismatch> {
        let keeps = Self::FORMAT.keeps();
        let (v, codes) = v.encoded_doubles(keeps, codes, CodeLayout::native::<Self::Code>())?;
        layout::encode(v, codes, &mut Self::encode_columns);
        Ok(())
    }

    /// [`encode_precise_f64`](Codec::encode_precise_f64) for vectors of three native doubles and codes, both at a stride, as
    /// [`encode_strided`](Codec::encode_strided) takes them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    fn encode_strided_f64_precise(
        v: Strided<'_>,
        codes: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        let keeps = Self::FORMAT.keeps();
        let (v, codes) = v.encoded_doubles(keeps, codes, CodeLayout::native::<Self::Code>())?;
        layout::encode(v, codes, &mut Self::encode_columns_precise);
        Ok(())
    }

    /// [`encode`](Codec::encode) for what an iterator gives, as anything that becomes `[f32; 3]`: the vectors of `glam`,
    /// `nalgebra` and `mint` do. It takes up to 256 at a time from the iterator, so that lanes are used.
    ///
    /// ```
    /// use unitpack::{Codec, Oct16};
    /// let normals = [[0.0, 0.6, 0.8]; 100];
    /// let codes: Vec<u16> = Oct16::encode_iter(normals).collect();
    /// assert_eq!(codes, [Oct16::encode(normals[0]); 100]);
    /// ```
    #[inline]
    fn encode_iter<I: IntoIterator<Item: Into<[f32; 3]>>>(v: I) -> EncodeIter<Self, I::IntoIter> {
        EncodeIter::new(v.into_iter(), Self::encode_batch)
    }

    /// [`encode_precise`](Codec::encode_precise) for what an iterator gives, as [`encode_iter`](Codec::encode_iter) takes it.
    #[inline]
    fn encode_iter_precise<I: IntoIterator<Item: Into<[f32; 3]>>>(
        v: I,
    ) -> EncodeIter<Self, I::IntoIter> {
        EncodeIter::new(v.into_iter(), Self::encode_batch_precise)
    }

    /// [`decode`](Codec::decode) for codes that an iterator gives. It takes up to 256 at a time from it.
    #[inline]
    fn decode_iter<I: IntoIterator<Item = Self::Code>>(codes: I) -> DecodeIter<Self, I::IntoIter> {
        DecodeIter::new(codes.into_iter(), Self::decode_batch)
    }
}

/// A component of a vector, which [`Codec::mirror`] negates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    #[inline(always)]
    fn flips(self) -> [bool; 3] {
        [self == Axis::X, self == Axis::Y, self == Axis::Z]
    }
}

pub(crate) mod sealed {
    use crate::batch::layout::{self, CodeLayout, Codes, CodesMut, Vectors, VectorsMut};
    use crate::batch::storage::{CodeSlice, CodeSliceMut};
    use crate::codec::{Codec, Format};
    use crate::simd::stream::Fence;

    /// A codec, by its type or its [`Format`], with the kernels of [`Batch`].
    pub trait Chosen: Copy {
        fn code_layout(self) -> CodeLayout;
        fn encode_chosen(self, v: [&[f32]; 3], codes: CodeSliceMut<'_>);
        fn encode_chosen_precise(self, v: [&[f32]; 3], codes: CodeSliceMut<'_>);
        fn decode_chosen(self, codes: CodeSlice<'_>, v: [&mut [f32]; 3], fence: &Fence);
    }

    impl<C: Codec> Chosen for C {
        #[inline]
        fn code_layout(self) -> CodeLayout {
            CodeLayout::native::<C::Code>()
        }
        #[inline]
        fn encode_chosen(self, v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
            C::encode_columns(v, codes);
        }
        #[inline]
        fn encode_chosen_precise(self, v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
            C::encode_columns_precise(v, codes);
        }
        #[inline]
        fn decode_chosen(self, codes: CodeSlice<'_>, v: [&mut [f32]; 3], fence: &Fence) {
            C::decode_columns(codes, v, fence);
        }
    }

    impl Chosen for Format {
        fn code_layout(self) -> CodeLayout {
            self.layout()
        }
        fn encode_chosen(self, v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
            self.encode_columns(v, codes);
        }
        fn encode_chosen_precise(self, v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
            self.encode_columns_precise(v, codes);
        }
        fn decode_chosen(self, codes: CodeSlice<'_>, v: [&mut [f32]; 3], fence: &Fence) {
            self.decode_columns(codes, v, fence);
        }
    }

    /// The kernels of a codec, and by them its batches in any layout. What is inlined is a call.
    pub trait Batch {
        fn encode_columns(v: [&[f32]; 3], codes: CodeSliceMut<'_>);
        fn encode_columns_precise(v: [&[f32]; 3], codes: CodeSliceMut<'_>);
        /// Whoever makes the fence drops it before others may read the vectors.
        fn decode_columns(codes: CodeSlice<'_>, v: [&mut [f32]; 3], fence: &Fence);
        fn mirror_codes(from: CodeSlice<'_>, to: CodeSliceMut<'_>, flips: [bool; 3]);

        #[inline]
        fn encode_batch(vectors: Vectors<'_, 3>, codes: CodesMut<'_>) {
            layout::encode(vectors, codes, &mut Self::encode_columns);
        }
        #[inline]
        fn encode_batch_precise(vectors: Vectors<'_, 3>, codes: CodesMut<'_>) {
            layout::encode(vectors, codes, &mut Self::encode_columns_precise);
        }
        #[inline]
        fn decode_batch(codes: Codes<'_>, vectors: VectorsMut<'_, 3>) {
            layout::decode(codes, vectors, &mut Self::decode_columns);
        }
        #[inline]
        fn mirror_batch(codes: CodesMut<'_>, flips: [bool; 3]) {
            layout::map_codes(codes, &|from, to| Self::mirror_codes(from, to, flips));
        }
    }
}
