//! Padded and tagged elements: a code of three components and a fourth one, w, as vertex formats have it.
//!
//! glTF aligns every element to four bytes, WebGPU has no formats of three bytes, and a tangent has a handedness. A
//! [`Padded`] element is a code of the crate with w in the bits above it. Its x, y and z are what the codec's own
//! functions give.
//!
//! | element | of | bytes | w | 1 | -1 | the handedness is -1 if |
//! |---|---|--:|---|--:|--:|---|
//! | [`Snorm8x4`] | [`Snorm8x3`] | 4 | the last byte, snorm | 127 | -127 | w < 0 |
//! | [`Snorm12x4`] | [`Snorm12x3`] | 8 | the last word, snorm of all 16 bits | 32767 | -32767 | w < 0 |
//! | [`Snorm16x4`] | [`Snorm16x3`] | 8 | the last word, snorm | 32767 | -32767 | w < 0 |
//! | [`Float16x4`] | [`Float16x3`] | 8 | the last word, a half | 0x3C00 | 0xBC00 | w < 0; not if it is -0 or NaN |
//! | [`Unorm8x4`] | [`XyzUnorm8x3`] | 4 | the last byte, unorm | 255 | 0 | w < 128 |
//! | [`Unorm16x4`] | [`XyzUnorm16x3`] | 8 | the last word, unorm | 65535 | 0 | w < 32768 |
//! | [`Unorm10_10_10_2`] | [`XyzUnorm10x3`] | 4 | the two high bits, unorm | 3 | 0 | w < 2 |
//! | [`Snorm10_10_10_2`] | [`Snorm10x3`] | 4 | the two high bits, snorm | 1 | 3 | w is 2 or 3 |
//!
//! # Normals
//! A normal has three floats. Of its element's w, [`W`] says whether it stays, or becomes 0 or 1.
//!
//! ```
//! use unitpack::Strided;
//! use unitpack::StridedMut;
//! use unitpack::padded::{Snorm8x4, Unorm10_10_10_2, W};
//! assert_eq!(Snorm8x4::encode([0.0, 0.0, -1.0], W::Zero), [0, 0, 0x81, 0]);
//!
//! // Normals of a glTF file: BYTE, normalized, VEC3, byteStride 4.
//! let normals = [[0.36f32, 0.48, 0.8]; 100];
//! let mut bytes = [0; 400];
//! let elements = StridedMut { bytes: &mut bytes, offset: 0, stride: 4, len: 100 };
//! Snorm8x4::encode_strided(Strided::of(&normals, 0), W::Zero, elements)?;
//! assert_eq!(bytes[396..], [46, 61, 102, 0]);
//!
//! // w carries a material, which stays.
//! let mut element = [2u32 << 30];
//! Unorm10_10_10_2::encode_strided(Strided::of(&normals[..1], 0), W::Keep, StridedMut::of(&mut element, 0))?;
//! assert_eq!(element[0] >> 30, 2);
//! # Ok::<(), unitpack::StrideMismatch>(())
//! ```
//!
//! # Tangents
//! A tangent has four floats: x, y, z and the handedness, as glTF has it. A handedness below 0 is -1. Anything else is +1:
//! 0, -0 and NaN too. It is never lost: its element has w = 1 or w = -1, and decoding gives 1.0 or -1.0.
//!
//! Decoding takes any w, by the last column of the table above. So w = 0 of a snorm element or a half is +1. Unorm has no
//! negative numbers: there w = 0 is -1, which is what encoding gives for -1.
//!
//! ```
//! use unitpack::padded::{Snorm8x4, Snorm10_10_10_2};
//! let tangent = [1.0, 0.0, 0.0, -1.0];
//! assert_eq!(Snorm8x4::encode_tangent(tangent), [127, 0, 0, 0x81]);
//! assert_eq!(Snorm10_10_10_2::encode_tangent(tangent), 511 | 3 << 30);
//! assert_eq!(Snorm8x4::decode_tangent([127, 0, 0, 0x81]), tangent);
//! ```
//!
//! # Vertex formats
//! What a code or an element is called where vertices are described. "-" means that there is no such format. The last
//! column has the fields from the low bits of little-endian memory up, or in the order of their addresses.
//!
//! What is read is the vector before its division by the length, so a shader has to normalize it. Unorm needs `2 * v - 1`
//! before. Octahedral codes need their decoder.
//!
//! WebGPU and glTF align attributes to four bytes. Codes of two or three bytes there have a stride of four, and those of
//! six one of eight: see [`Strided`].
//!
//! A normal of glTF is VEC3, and its `byteStride` says that there is a w: 4 with BYTE, and 8 with SHORT. A tangent is VEC4.
//! Both are BYTE or SHORT by `KHR_mesh_quantization` only. The other types are for attributes of an application.
//!
//! Vulkan does not require every device to read vertices of three components of 8 or 16 bits, or of snorm 10-10-10-2.
//!
// One row a line: tools/vertex-formats reads them.
//! | code | `wgpu::VertexFormat` | `VkFormat` | `DXGI_FORMAT` | `MTLVertexFormat` | GL | glTF | fields |
//! |---|---|---|---|---|---|---|---|
//! | [`Snorm8x4`] | `Snorm8x4` | `R8G8B8A8_SNORM` | `R8G8B8A8_SNORM` | `char4Normalized` | `4 BYTE normalized` | `VEC4 BYTE normalized` | x 8, y 8, z 8, w 8 |
//! | [`Snorm12x4`] | `Snorm16x4` | `R16G16B16A16_SNORM` | `R16G16B16A16_SNORM` | `short4Normalized` | `4 SHORT normalized` | `VEC4 SHORT normalized` | x 16, y 16, z 16, w 16 |
//! | [`Snorm16x4`] | `Snorm16x4` | `R16G16B16A16_SNORM` | `R16G16B16A16_SNORM` | `short4Normalized` | `4 SHORT normalized` | `VEC4 SHORT normalized` | x 16, y 16, z 16, w 16 |
//! | [`Float16x4`] | `Float16x4` | `R16G16B16A16_SFLOAT` | `R16G16B16A16_FLOAT` | `half4` | `4 HALF_FLOAT` | - | x 16, y 16, z 16, w 16 |
//! | [`Unorm8x4`] | `Unorm8x4` | `R8G8B8A8_UNORM` | `R8G8B8A8_UNORM` | `uchar4Normalized` | `4 UNSIGNED_BYTE normalized` | `VEC4 UNSIGNED_BYTE normalized` | x 8, y 8, z 8, w 8 |
//! | [`Unorm16x4`] | `Unorm16x4` | `R16G16B16A16_UNORM` | `R16G16B16A16_UNORM` | `ushort4Normalized` | `4 UNSIGNED_SHORT normalized` | `VEC4 UNSIGNED_SHORT normalized` | x 16, y 16, z 16, w 16 |
//! | [`Unorm10_10_10_2`] | `Unorm10_10_10_2` | `A2B10G10R10_UNORM_PACK32` | `R10G10B10A2_UNORM` | `uint1010102Normalized` | `4 UNSIGNED_INT_2_10_10_10_REV normalized` | - | x 10, y 10, z 10, w 2 |
//! | [`Snorm10_10_10_2`] | - | `A2B10G10R10_SNORM_PACK32` | - | `int1010102Normalized` | `4 INT_2_10_10_10_REV normalized` | - | x 10, y 10, z 10, w 2 |
//! | [`Snorm8x3`] | - | `R8G8B8_SNORM` | - | `char3Normalized` | `3 BYTE normalized` | `VEC3 BYTE normalized` | x 8, y 8, z 8 |
//! | [`Snorm12x3`] | - | `R16G16B16_SNORM` | - | `short3Normalized` | `3 SHORT normalized` | `VEC3 SHORT normalized` | x 16, y 16, z 16 |
//! | [`Snorm16x3`] | - | `R16G16B16_SNORM` | - | `short3Normalized` | `3 SHORT normalized` | `VEC3 SHORT normalized` | x 16, y 16, z 16 |
//! | [`Float16x3`] | - | `R16G16B16_SFLOAT` | - | `half3` | `3 HALF_FLOAT` | - | x 16, y 16, z 16 |
//! | [`XyzUnorm8x3`] | - | `R8G8B8_UNORM` | - | `uchar3Normalized` | `3 UNSIGNED_BYTE normalized` | `VEC3 UNSIGNED_BYTE normalized` | x 8, y 8, z 8 |
//! | [`XyzUnorm16x3`] | - | `R16G16B16_UNORM` | - | `ushort3Normalized` | `3 UNSIGNED_SHORT normalized` | `VEC3 UNSIGNED_SHORT normalized` | x 16, y 16, z 16 |
//! | [`XyzUnorm10x3`] | `Unorm10_10_10_2` | `A2B10G10R10_UNORM_PACK32` | `R10G10B10A2_UNORM` | `uint1010102Normalized` | `4 UNSIGNED_INT_2_10_10_10_REV normalized` | - | x 10, y 10, z 10, 0 2 |
//! | [`Snorm10x3`] | - | `A2B10G10R10_SNORM_PACK32` | - | `int1010102Normalized` | `4 INT_2_10_10_10_REV normalized` | - | x 10, y 10, z 10, 0 2 |
//! | [`Float32x3`](crate::Float32x3) | `Float32x3` | `R32G32B32_SFLOAT` | `R32G32B32_FLOAT` | `float3` | `3 FLOAT` | `VEC3 FLOAT` | x 32, y 32, z 32 |
//! | [`Oct16`](crate::Oct16) | `Snorm8x2` | `R8G8_SNORM` | `R8G8_SNORM` | `char2Normalized` | `2 BYTE normalized` | `VEC2 BYTE normalized` | u 8, v 8 |
//! | [`Oct32`](crate::Oct32) | `Snorm16x2` | `R16G16_SNORM` | `R16G16_SNORM` | `short2Normalized` | `2 SHORT normalized` | `VEC2 SHORT normalized` | u 16, v 16 |
//! | [`OctUnorm8x2`](crate::OctUnorm8x2) | `Unorm8x2` | `R8G8_UNORM` | `R8G8_UNORM` | `uchar2Normalized` | `2 UNSIGNED_BYTE normalized` | `VEC2 UNSIGNED_BYTE normalized` | u 8, v 8 |
//! | [`OctUnorm16x2`](crate::OctUnorm16x2) | `Unorm16x2` | `R16G16_UNORM` | `R16G16_UNORM` | `ushort2Normalized` | `2 UNSIGNED_SHORT normalized` | `VEC2 UNSIGNED_SHORT normalized` | u 16, v 16 |
//! | [`HemiOct16`](crate::HemiOct16) | `Snorm8x2` | `R8G8_SNORM` | `R8G8_SNORM` | `char2Normalized` | `2 BYTE normalized` | `VEC2 BYTE normalized` | u 8, v 8 |
//! | [`HemiOct32`](crate::HemiOct32) | `Snorm16x2` | `R16G16_SNORM` | `R16G16_SNORM` | `short2Normalized` | `2 SHORT normalized` | `VEC2 SHORT normalized` | u 16, v 16 |
//! | [`XyOnly16`](crate::XyOnly16) | `Unorm8x2` | `R8G8_UNORM` | `R8G8_UNORM` | `uchar2Normalized` | `2 UNSIGNED_BYTE normalized` | `VEC2 UNSIGNED_BYTE normalized` | x 8, y 8 |
//! | [`XyOnly32`](crate::XyOnly32) | `Unorm16x2` | `R16G16_UNORM` | `R16G16_UNORM` | `ushort2Normalized` | `2 UNSIGNED_SHORT normalized` | `VEC2 UNSIGNED_SHORT normalized` | x 16, y 16 |
//! | [`XyOnlySnorm16`](crate::XyOnlySnorm16) | `Snorm8x2` | `R8G8_SNORM` | `R8G8_SNORM` | `char2Normalized` | `2 BYTE normalized` | `VEC2 BYTE normalized` | x 8, y 8 |
//! | [`XyOnlyNormalized16`](crate::XyOnlyNormalized16) | `Unorm8x2` | `R8G8_UNORM` | `R8G8_UNORM` | `uchar2Normalized` | `2 UNSIGNED_BYTE normalized` | `VEC2 UNSIGNED_BYTE normalized` | x 8, y 8 |
//! | [`XyOnlyBiased16`](crate::XyOnlyBiased16) | `Unorm8x2` | `R8G8_UNORM` | `R8G8_UNORM` | `uchar2Normalized` | `2 UNSIGNED_BYTE normalized` | `VEC2 UNSIGNED_BYTE normalized` | x 8, y 8 |
//! | [`PhiZUnorm8x2`](crate::PhiZUnorm8x2) | `Unorm8x2` | `R8G8_UNORM` | `R8G8_UNORM` | `uchar2Normalized` | `2 UNSIGNED_BYTE normalized` | `VEC2 UNSIGNED_BYTE normalized` | phi 8, z 8 |
//! | [`PhiZUnorm16x2`](crate::PhiZUnorm16x2) | `Unorm16x2` | `R16G16_UNORM` | `R16G16_UNORM` | `ushort2Normalized` | `2 UNSIGNED_SHORT normalized` | `VEC2 UNSIGNED_SHORT normalized` | phi 16, z 16 |
//! | [`XyOnly32F`](crate::XyOnly32F) | `Float16x2` | `R16G16_SFLOAT` | `R16G16_FLOAT` | `half2` | `2 HALF_FLOAT` | - | x 16, y 16 |
//! | [`Oct8`](crate::Oct8) | `Uint8` | `R8_UINT` | `R8_UINT` | `uchar` | `1 UNSIGNED_BYTE` | `SCALAR UNSIGNED_BYTE` | u 4, v 4 |
//! | [`Oct20`](crate::Oct20) | `Uint32` | `R32_UINT` | `R32_UINT` | `uint` | `1 UNSIGNED_INT` | - | u 10, v 10, 0 12 |
//!
//! The other codes of one, two or four bytes are single integers, as in the last two rows: `Uint8`, `Uint16` or `Uint32`.
//! [`XyOnlyBiased16`](crate::XyOnlyBiased16) has (255 c - 128) / 127 of what is fetched.
//! GL's integers are those of `glVertexAttribIPointer`.

use core::fmt::Debug;
use core::marker::PhantomData;

use bytemuck::Pod;

use crate::batch::layout::{self, CodeLayout, Codes, CodesMut, PART, Vectors, VectorsMut};
use crate::batch::storage::{CodeSlice, CodeSliceMut};
use crate::codec::{
    Float16x3, Snorm8x3, Snorm10x3, Snorm12x3, Snorm16x3, XyzUnorm8x3, XyzUnorm10x3, XyzUnorm16x3,
};
use crate::error::{LengthMismatch, StrideMismatch};
use crate::simd::stream::Fence;
use crate::vector::{Soa, SoaMut, Strided, StridedMut};
use sealed::Pad;

/// A code of `C` and a fourth component in an element of four or eight bytes. The [module](self) says what w means in each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Padded<C>(PhantomData<C>);

/// `[x, y, z, w]` in snorm bytes: BYTE of glTF.
pub type Snorm8x4 = Padded<Snorm8x3>;
/// `[x, y, z, w]` in words, of which x, y and z have 12 bits: the SHORT that gltfpack writes with `-vn 12`.
///
/// x, y and z are from -2047 to 2047. A glTF reader divides them by 32767, which gives the same direction at a sixteenth of
/// the length. So a shader has to normalize it. w has all its 16 bits, as a reader expects: 32767 is 1.
pub type Snorm12x4 = Padded<Snorm12x3>;
/// `[x, y, z, w]` in snorm words: SHORT of glTF.
pub type Snorm16x4 = Padded<Snorm16x3>;
/// `[x, y, z, w]` in halves.
pub type Float16x4 = Padded<Float16x3>;
/// `[x, y, z, w]` in unorm bytes.
pub type Unorm8x4 = Padded<XyzUnorm8x3>;
/// `[x, y, z, w]` in unorm words.
pub type Unorm16x4 = Padded<XyzUnorm16x3>;
/// Unorm x, y and z of 10 bits, x in the low ones, and w of two: `Unorm10_10_10_2` of WebGPU.
pub type Unorm10_10_10_2 = Padded<XyzUnorm10x3>;
/// Snorm x, y and z of 10 bits, x in the low ones, and w of two.
pub type Snorm10_10_10_2 = Padded<Snorm10x3>;

/// What becomes of the fourth component when a normal is encoded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum W {
    /// It stays as it is in the element.
    Keep,
    /// All its bits become 0.
    #[default]
    Zero,
    /// It becomes 1, as the format has it: 127, 255, 32767, 65535, a half of 1.0, or of two bits 1 as snorm and 3 as unorm.
    One,
}

/// A codec whose codes have room for a fourth component: see [`Padded`]. It is sealed.
pub trait PaddedCodec: Pad {
    /// An element: a code and w. It lies in memory as a vertex format has it, with integers in native order.
    type Element: Pod + Eq + Debug;
}

impl<C: PaddedCodec> Padded<C> {
    /// Number of bits of w: 2, 8 or 16.
    pub const W_BITS: u32 = C::SLOT.place.bits();
    /// The bits of w that mean 1, and a handedness of +1.
    pub const W_ONE: u16 = C::SLOT.one;
    /// The bits of w that mean -1, and a handedness of -1.
    pub const W_MINUS_ONE: u16 = C::SLOT.minus_one;

    /// Packs a vector of any length as [`Codec::encode`](crate::Codec::encode) does. There is nothing to keep: [`W::Keep`] is [`W::Zero`].
    #[inline]
    pub fn encode(v: [f32; 3], w: W) -> C::Element {
        C::join(C::encode(v), C::SLOT.bits_of(w))
    }

    /// Packs a vector of any length as [`Codec::encode_precise`](crate::Codec::encode_precise) does. There is nothing to keep: [`W::Keep`] is [`W::Zero`].
    #[inline]
    pub fn encode_precise(v: [f32; 3], w: W) -> C::Element {
        C::join(C::encode_precise(v), C::SLOT.bits_of(w))
    }

    /// Unpacks the vector of an element, any bit pattern, as [`Codec::decode`](crate::Codec::decode) does. It does not look at w.
    #[inline]
    pub fn decode(element: C::Element) -> [f32; 3] {
        C::decode(C::split(element).0)
    }

    /// Packs a tangent: x, y and z of any length as [`Codec::encode`](crate::Codec::encode) does, and the handedness. Below 0 it is -1, and
    /// anything else is +1.
    #[inline]
    pub fn encode_tangent([x, y, z, handedness]: [f32; 4]) -> C::Element {
        C::join(C::encode([x, y, z]), C::SLOT.bits_of_handedness(handedness))
    }

    /// Packs a tangent: x, y and z of any length as [`Codec::encode_precise`](crate::Codec::encode_precise) does, and the handedness. Below 0 it is -1,
    /// and anything else is +1.
    #[inline]
    pub fn encode_tangent_precise([x, y, z, handedness]: [f32; 4]) -> C::Element {
        C::join(C::encode_precise([x, y, z]), C::SLOT.bits_of_handedness(handedness))
    }

    /// Unpacks a tangent, any bit pattern: x, y and z as [`Codec::decode`](crate::Codec::decode) does, and the handedness, 1.0 or -1.0. The
    /// [module](self) says which w is which.
    #[inline]
    pub fn decode_tangent(element: C::Element) -> [f32; 4] {
        let (code, w) = C::split(element);
        let [x, y, z] = C::decode(code);
        [x, y, z, C::SLOT.handedness(w)]
    }

    /// [`encode`](Padded::encode) for structures of arrays. [`W::Keep`] keeps what the elements have.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    pub fn encode_soa(v: Soa<'_>, w: W, elements: &mut [C::Element]) -> Result<(), LengthMismatch> {
        encode_soa(C::SLOT, C::encode_columns, v, w, bytemuck::cast_slice_mut(elements))
    }

    /// [`encode_precise`](Padded::encode_precise) for structures of arrays. [`W::Keep`] keeps what the elements have.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    pub fn encode_soa_precise(
        v: Soa<'_>,
        w: W,
        elements: &mut [C::Element],
    ) -> Result<(), LengthMismatch> {
        encode_soa(C::SLOT, C::encode_columns_precise, v, w, bytemuck::cast_slice_mut(elements))
    }

    /// [`decode`](Padded::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    #[inline]
    pub fn decode_soa(elements: &[C::Element], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        decode_soa(C::SLOT, C::decode_columns, bytemuck::cast_slice(elements), v)
    }

    /// [`encode`](Padded::encode) for vectors of three native floats and elements, both at a stride. [`W::Keep`] keeps what
    /// the elements have, and so does what lies between them. See [`Strided`].
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    pub fn encode_strided(
        v: Strided<'_>,
        w: W,
        elements: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        encode_strided(C::SLOT, C::encode_columns, v, w, elements)
    }

    /// [`encode_precise`](Padded::encode_precise) for vectors and elements at a stride, as
    /// [`encode_strided`](Padded::encode_strided) takes them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    pub fn encode_strided_precise(
        v: Strided<'_>,
        w: W,
        elements: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        encode_strided(C::SLOT, C::encode_columns_precise, v, w, elements)
    }

    /// [`decode`](Padded::decode) for elements and vectors at a stride, as [`encode_strided`](Padded::encode_strided) takes
    /// them. What lies between the vectors stays as it is.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    pub fn decode_strided(elements: Strided<'_>, v: StridedMut<'_>) -> Result<(), StrideMismatch> {
        decode_strided(C::SLOT, C::decode_columns, elements, v)
    }

    /// [`encode_tangent`](Padded::encode_tangent) for arrays of structures.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    pub fn encode_tangents_aos(
        tangents: &[[f32; 4]],
        elements: &mut [C::Element],
    ) -> Result<(), LengthMismatch> {
        let elements = bytemuck::cast_slice_mut(elements);
        encode_tangents_aos(C::SLOT, C::encode_columns, tangents, elements)
    }

    /// [`encode_tangent_precise`](Padded::encode_tangent_precise) for arrays of structures.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    pub fn encode_tangents_aos_precise(
        tangents: &[[f32; 4]],
        elements: &mut [C::Element],
    ) -> Result<(), LengthMismatch> {
        let elements = bytemuck::cast_slice_mut(elements);
        encode_tangents_aos(C::SLOT, C::encode_columns_precise, tangents, elements)
    }

    /// [`decode_tangent`](Padded::decode_tangent) for arrays of structures.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the slices are not equally long; nothing is written then.
    #[inline]
    pub fn decode_tangents_aos(
        elements: &[C::Element],
        tangents: &mut [[f32; 4]],
    ) -> Result<(), LengthMismatch> {
        decode_tangents_aos(C::SLOT, C::decode_columns, bytemuck::cast_slice(elements), tangents)
    }

    /// [`encode_tangent`](Padded::encode_tangent) for tangents of four native floats, x, y, z and handedness, and elements,
    /// both at a stride. What lies between the elements stays as it is. See [`Strided`].
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    pub fn encode_tangents_strided(
        tangents: Strided<'_>,
        elements: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        encode_tangents_strided(C::SLOT, C::encode_columns, tangents, elements)
    }

    /// [`encode_tangent_precise`](Padded::encode_tangent_precise) for tangents and elements at a stride, as
    /// [`encode_tangents_strided`](Padded::encode_tangents_strided) takes them.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    pub fn encode_tangents_strided_precise(
        tangents: Strided<'_>,
        elements: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        encode_tangents_strided(C::SLOT, C::encode_columns_precise, tangents, elements)
    }

    /// [`decode_tangent`](Padded::decode_tangent) for elements and tangents at a stride, as
    /// [`encode_tangents_strided`](Padded::encode_tangents_strided) takes them. What lies between the tangents stays as it is.
    ///
    /// # Errors
    /// [`StrideMismatch`] if the elements do not fit their bytes, or their numbers differ; nothing is written then.
    #[inline]
    pub fn decode_tangents_strided(
        elements: Strided<'_>,
        tangents: StridedMut<'_>,
    ) -> Result<(), StrideMismatch> {
        decode_tangents_strided(C::SLOT, C::decode_columns, elements, tangents)
    }
}

/// The code's bits of an element in one word.
const LOW_30: u32 = (1 << 30) - 1;

/// Where w is in an element.
#[derive(Clone, Copy)]
enum Place {
    /// The byte at 3.
    Byte,
    /// The native word at byte 6.
    Word,
    /// The high two bits of a native word of four bytes.
    Tag,
}

/// An element's w: where it is and what its bits mean.
#[derive(Clone, Copy)]
pub struct Slot {
    place: Place,
    one: u16,
    minus_one: u16,
    /// The first and the last bits that mean a handedness of -1.
    minus: [u16; 2],
}

impl Slot {
    const SNORM8: Self =
        Slot { place: Place::Byte, one: 0x7F, minus_one: 0x81, minus: [0x80, 0xFF] };
    const SNORM16: Self =
        Slot { place: Place::Word, one: 0x7FFF, minus_one: 0x8001, minus: [0x8000, 0xFFFF] };
    /// Neither -0 nor a NaN is below 0.
    const HALF: Self =
        Slot { place: Place::Word, one: 0x3C00, minus_one: 0xBC00, minus: [0x8001, 0xFC00] };
    const UNORM8: Self = Slot { place: Place::Byte, one: 0xFF, minus_one: 0, minus: [0, 0x7F] };
    const UNORM16: Self =
        Slot { place: Place::Word, one: 0xFFFF, minus_one: 0, minus: [0, 0x7FFF] };
    const UNORM2: Self = Slot { place: Place::Tag, one: 3, minus_one: 0, minus: [0, 1] };
    const SNORM2: Self = Slot { place: Place::Tag, one: 1, minus_one: 3, minus: [2, 3] };

    /// How the code before w lies in memory.
    #[inline]
    fn layout(self) -> CodeLayout {
        match self.place {
            Place::Byte => CodeLayout::native::<[u8; 3]>(),
            Place::Word => CodeLayout::native::<[u16; 3]>(),
            Place::Tag => CodeLayout::native::<u32>(),
        }
    }

    /// Size of an element in bytes.
    #[inline]
    fn size(self) -> usize {
        match self.place {
            Place::Byte | Place::Tag => 4,
            Place::Word => 8,
        }
    }

    #[inline]
    fn bits_of(self, w: W) -> u16 {
        match w {
            W::Keep | W::Zero => 0,
            W::One => self.one,
        }
    }

    #[inline]
    fn bits_of_handedness(self, handedness: f32) -> u16 {
        if handedness < 0.0 { self.minus_one } else { self.one }
    }

    #[inline]
    fn handedness(self, w: u16) -> f32 {
        let [first, last] = self.minus;
        if (first..=last).contains(&w) { -1.0 } else { 1.0 }
    }
}

impl Place {
    #[inline]
    const fn bits(self) -> u32 {
        match self {
            Place::Byte => 8,
            Place::Word => 16,
            Place::Tag => 2,
        }
    }
}

mod sealed {
    use crate::codec::Codec;
    use crate::padded::{PaddedCodec, Slot};

    /// What [`PaddedCodec`] has for this module alone.
    pub trait Pad: Codec {
        const SLOT: Slot;

        fn join(code: Self::Code, w: u16) -> Self::Element
        where
            Self: PaddedCodec;
        fn split(element: Self::Element) -> (Self::Code, u16)
        where
            Self: PaddedCodec;
    }
}

/// The codecs, their elements and slots, and how a single element is put together and taken apart.
macro_rules! padded {
    ($($name:ident: $element:ty, $slot:ident, $join:expr, $split:expr;)*) => { $(
        impl PaddedCodec for $name {
            type Element = $element;
        }

        impl Pad for $name {
            const SLOT: Slot = Slot::$slot;

            #[inline]
            fn join(code: Self::Code, w: u16) -> $element {
                $join(code, w)
            }
            #[inline]
            fn split(element: $element) -> (Self::Code, u16) {
                $split(element)
            }
        }
    )* };
}

padded! {
    Snorm8x3: [u8; 4], SNORM8, join_bytes, split_bytes;
    Snorm10x3: u32, SNORM2, join_tag, split_tag;
    Snorm12x3: [u16; 4], SNORM16, join_words, split_words;
    Snorm16x3: [u16; 4], SNORM16, join_words, split_words;
    Float16x3: [u16; 4], HALF, join_words, split_words;
    XyzUnorm8x3: [u8; 4], UNORM8, join_bytes, split_bytes;
    XyzUnorm10x3: u32, UNORM2, join_tag, split_tag;
    XyzUnorm16x3: [u16; 4], UNORM16, join_words, split_words;
}

#[inline]
fn join_bytes([x, y, z]: [u8; 3], w: u16) -> [u8; 4] {
    [x, y, z, w as u8]
}

#[inline]
fn split_bytes([x, y, z, w]: [u8; 4]) -> ([u8; 3], u16) {
    ([x, y, z], w.into())
}

#[inline]
fn join_words([x, y, z]: [u16; 3], w: u16) -> [u16; 4] {
    [x, y, z, w]
}

#[inline]
fn split_words([x, y, z, w]: [u16; 4]) -> ([u16; 3], u16) {
    ([x, y, z], w)
}

#[inline]
fn join_tag(code: u32, w: u16) -> u32 {
    code & LOW_30 | u32::from(w) << 30
}

#[inline]
fn split_tag(element: u32) -> (u32, u16) {
    (element & LOW_30, (element >> 30) as u16)
}

/// A codec's kernel that encodes.
type Encode = fn([&[f32]; 3], CodeSliceMut<'_>);
/// A codec's kernel that decodes.
type Decode = fn(CodeSlice<'_>, [&mut [f32]; 3], &Fence);

/// Where the w of many elements comes from.
#[derive(Clone, Copy)]
enum Source<'a> {
    Given(W),
    /// Tangents of four native floats, one every `stride` bytes.
    Handedness {
        bytes: &'a [u8],
        stride: usize,
    },
}

#[inline(never)]
fn encode_soa(
    slot: Slot,
    encode: Encode,
    v: Soa<'_>,
    w: W,
    bytes: &mut [u8],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), bytes.len() / slot.size())?;
    encode_elements(slot, encode, v.into(), Source::Given(w), bytes, slot.size());
    Ok(())
}

#[inline(never)]
fn decode_soa(
    slot: Slot,
    mut decode: Decode,
    bytes: &[u8],
    v: SoaMut<'_>,
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), bytes.len() / slot.size())?;
    let codes = Codes::strided(bytes, slot.layout(), slot.size());
    layout::decode(codes, VectorsMut::from(v), &mut decode);
    Ok(())
}

#[inline(never)]
fn encode_strided(
    slot: Slot,
    encode: Encode,
    v: Strided<'_>,
    w: W,
    elements: StridedMut<'_>,
) -> Result<(), StrideMismatch> {
    StrideMismatch::check_lengths(v.len, elements.len)?;
    let (v, stride) = (v.vectors()?, elements.stride);
    encode_elements(slot, encode, v, Source::Given(w), elements.elements(slot.size())?, stride);
    Ok(())
}

#[inline(never)]
fn decode_strided(
    slot: Slot,
    mut decode: Decode,
    elements: Strided<'_>,
    v: StridedMut<'_>,
) -> Result<(), StrideMismatch> {
    StrideMismatch::check_lengths(v.len, elements.len)?;
    let bytes = elements.elements(slot.size())?;
    let codes = Codes::strided(bytes, slot.layout(), elements.stride);
    layout::decode(codes, v.vectors()?, &mut decode);
    Ok(())
}

#[inline(never)]
fn encode_tangents_aos(
    slot: Slot,
    encode: Encode,
    tangents: &[[f32; 4]],
    bytes: &mut [u8],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_aos(tangents.len(), bytes.len() / slot.size())?;
    let tangents = bytemuck::cast_slice(tangents.as_flattened());
    encode_tangents(slot, encode, tangents, 16, bytes, slot.size());
    Ok(())
}

#[inline(never)]
fn decode_tangents_aos(
    slot: Slot,
    decode: Decode,
    bytes: &[u8],
    tangents: &mut [[f32; 4]],
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_aos(tangents.len(), bytes.len() / slot.size())?;
    let tangents = bytemuck::cast_slice_mut(tangents.as_flattened_mut());
    decode_tangents(slot, decode, bytes, slot.size(), tangents, 16);
    Ok(())
}

#[inline(never)]
fn encode_tangents_strided(
    slot: Slot,
    encode: Encode,
    tangents: Strided<'_>,
    elements: StridedMut<'_>,
) -> Result<(), StrideMismatch> {
    StrideMismatch::check_lengths(tangents.len, elements.len)?;
    let (from, stride) = (tangents.elements(16)?, elements.stride);
    let elements = elements.elements(slot.size())?;
    encode_tangents(slot, encode, from, tangents.stride, elements, stride);
    Ok(())
}

#[inline(never)]
fn decode_tangents_strided(
    slot: Slot,
    decode: Decode,
    elements: Strided<'_>,
    tangents: StridedMut<'_>,
) -> Result<(), StrideMismatch> {
    StrideMismatch::check_lengths(tangents.len, elements.len)?;
    let (from, stride) = (elements.elements(slot.size())?, tangents.stride);
    decode_tangents(slot, decode, from, elements.stride, tangents.elements(16)?, stride);
    Ok(())
}

/// Encodes tangents of four native floats, one every `from_stride` bytes.
fn encode_tangents(
    slot: Slot,
    encode: Encode,
    from: &[u8],
    from_stride: usize,
    to: &mut [u8],
    to_stride: usize,
) {
    let v = Vectors::Rows { bytes: from, stride: from_stride };
    let handedness = Source::Handedness { bytes: from, stride: from_stride };
    encode_elements(slot, encode, v, handedness, to, to_stride);
}

/// Encodes to one element every `stride` bytes, a part at a time, so that it is in the cache when its w is written.
#[inline(never)]
fn encode_elements(
    slot: Slot,
    mut encode: Encode,
    v: Vectors<'_, 3>,
    w: Source<'_>,
    bytes: &mut [u8],
    stride: usize,
) {
    let (place, layout) = (slot.place, slot.layout());
    // Beside a code of whole bytes, w stays by itself.
    if matches!((w, place), (Source::Given(W::Keep), Place::Byte | Place::Word)) {
        return layout::encode(v, CodesMut::strided(bytes, layout, stride), &mut encode);
    }
    let mut room = [0; PART];
    for (i, part) in bytes.chunks_mut(PART.saturating_mul(stride).max(1)).enumerate() {
        let (first, len) = (i * PART, part.len().div_ceil(stride.max(1)));
        match w {
            Source::Given(W::Keep) => read_w(place, part, stride, &mut room),
            Source::Given(w) => room.fill(slot.bits_of(w)),
            Source::Handedness { bytes, stride } => {
                let tangents = bytes.get(first.saturating_mul(stride)..).unwrap_or_default();
                read(tangents, stride, &mut room, |&[.., a, b, c, d]: &[u8; 16]| {
                    slot.bits_of_handedness(f32::from_ne_bytes([a, b, c, d]))
                });
            }
        }
        let codes = CodesMut::strided(&mut *part, layout, stride);
        layout::encode(vectors_from(v, first, len), codes, &mut encode);
        write_w(place, &room, part, stride);
    }
}

/// `len` vectors from the one at `first` on.
fn vectors_from(v: Vectors<'_, 3>, first: usize, len: usize) -> Vectors<'_, 3> {
    match v {
        Vectors::Columns(columns) => {
            Vectors::Columns(columns.map(|c| c.get(first..first + len).unwrap_or_default()))
        }
        Vectors::Rows { bytes, stride } => {
            let bytes = bytes.get(first.saturating_mul(stride)..).unwrap_or_default();
            Vectors::Rows { bytes, stride }
        }
    }
}

/// Decodes to tangents of four native floats, one every `to_stride` bytes, a part at a time.
#[inline(never)]
fn decode_tangents(
    slot: Slot,
    mut decode: Decode,
    from: &[u8],
    from_stride: usize,
    to: &mut [u8],
    to_stride: usize,
) {
    let mut room = [0; PART];
    let parts = from.chunks(PART.saturating_mul(from_stride).max(1));
    for (from, to) in parts.zip(to.chunks_mut(PART.saturating_mul(to_stride).max(1))) {
        let codes = Codes::strided(from, slot.layout(), from_stride);
        let v = VectorsMut::Rows::<3> { bytes: &mut *to, stride: to_stride };
        layout::decode(codes, v, &mut decode);
        read_w(slot.place, from, from_stride, &mut room);
        write(to, to_stride, &room, |[.., a, b, c, d]: &mut [u8; 16], w| {
            [*a, *b, *c, *d] = slot.handedness(w).to_ne_bytes();
        });
    }
}

/// Reads something of each element of `SIZE` bytes, one every `stride` bytes.
#[inline(always)]
fn read<const SIZE: usize>(
    elements: &[u8],
    stride: usize,
    to: &mut [u16],
    read: impl Fn(&[u8; SIZE]) -> u16,
) {
    // Without gaps it takes a fraction of the time.
    if stride == SIZE {
        for (to, element) in to.iter_mut().zip(elements.as_chunks().0) {
            *to = read(element);
        }
        return;
    }
    for (to, element) in to.iter_mut().zip(elements.chunks(stride.max(1))) {
        if let Some(element) = element.first_chunk() {
            *to = read(element);
        }
    }
}

/// Writes something of each element of `SIZE` bytes, one every `stride` bytes.
#[inline(always)]
fn write<const SIZE: usize>(
    elements: &mut [u8],
    stride: usize,
    from: &[u16],
    write: impl Fn(&mut [u8; SIZE], u16),
) {
    if stride == SIZE {
        for (&from, element) in from.iter().zip(elements.as_chunks_mut().0) {
            write(element, from);
        }
        return;
    }
    for (&from, element) in from.iter().zip(elements.chunks_mut(stride.max(1))) {
        if let Some(element) = element.first_chunk_mut() {
            write(element, from);
        }
    }
}

/// Reads the w of elements, one every `stride` bytes.
#[inline(never)]
fn read_w(place: Place, elements: &[u8], stride: usize, to: &mut [u16]) {
    match place {
        Place::Byte => read(elements, stride, to, |&[_, _, _, w]: &[u8; 4]| w.into()),
        Place::Word => {
            read(elements, stride, to, |&[.., a, b]: &[u8; 8]| u16::from_ne_bytes([a, b]));
        }
        Place::Tag => read(elements, stride, to, |word| split_tag(u32::from_ne_bytes(*word)).1),
    }
}

/// Writes the w of elements, one every `stride` bytes. Their codes stay.
#[inline(never)]
fn write_w(place: Place, from: &[u16], elements: &mut [u8], stride: usize) {
    match place {
        Place::Byte => {
            write(elements, stride, from, |[_, _, _, to]: &mut [u8; 4], w| *to = w as u8)
        }
        Place::Word => write(elements, stride, from, |[.., a, b]: &mut [u8; 8], w| {
            [*a, *b] = w.to_ne_bytes();
        }),
        Place::Tag => write(elements, stride, from, |word, w| {
            *word = join_tag(u32::from_ne_bytes(*word), w).to_ne_bytes();
        }),
    }
}
