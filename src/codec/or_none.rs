//! Codecs that have a code for no vector.

use super::sealed::{Batch, Chosen};
use super::{Axis, Codec, Format};
use crate::batch::layout::{self, CodeLayout, Codes, CodesMut, Vectors, VectorsMut};
use crate::batch::storage::{CodeSlice, CodeSliceMut, swap_if_big_endian};
use crate::formula::support::sanitize::magnitude;
use crate::simd::stream::Fence;

/// The codec `C`, in which its [`NONE`](Codec::NONE) means that there is no vector.
///
/// A vector that is zero or has a NaN, as scans have it for points without a normal, becomes `C::NONE`. That decodes to
/// zero. All else is as in `C`, in every layout. A codec without `NONE` does not compile:
///
/// ```compile_fail
/// use unitpack::{Codec, Fibonacci16, OrNone};
/// let _ = OrNone::<Fibonacci16>::encode([0.0; 3]);
/// ```
///
/// For a [`Format`], [`Format::or_none`] gives a value that [`AxisOrder`](crate::AxisOrder) takes.
///
/// ```
/// use unitpack::{Codec, Oct16, OrNone};
/// let normals = [[0.0, 0.6, 0.8], [0.0, 0.0, 0.0], [f32::NAN, 0.0, 1.0]];
/// let mut codes = [0; 3];
/// OrNone::<Oct16>::encode_aos(&normals, &mut codes)?;
/// assert_eq!(codes, [Oct16::encode(normals[0]), 0x8000, 0x8000]);
///
/// let mut back = [[1.0; 3]; 3];
/// OrNone::<Oct16>::decode_aos(&codes, &mut back)?;
/// assert_eq!(back, [Oct16::decode(codes[0]), [0.0; 3], [0.0; 3]]);
/// # Ok::<(), unitpack::LengthMismatch>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct OrNone<C>(C);

impl<C: Codec> OrNone<C> {
    const NONE: C::Code = match C::NONE {
        Some(code) => code,
        None => panic!("encoders of this codec give all codes, so that none is left for no vector"),
    };

    /// The codec's value, as [`AxisOrder`](crate::AxisOrder) takes it.
    #[inline]
    pub const fn new(codec: C) -> Self {
        const { assert!(C::NONE.is_some()) };
        OrNone(codec)
    }

    /// Whether the bits that say something are those of `NONE`.
    #[inline]
    fn is_none(mut code: C::Code) -> bool {
        let bytes = bytemuck::bytes_of_mut(&mut code);
        swap_if_big_endian(bytes, align_of::<C::Code>());
        is_none(bytes, &used_bits::<8>(C::FORMAT.bits()), Self::bytes())
    }

    /// Its little-endian bytes.
    #[inline]
    fn bytes() -> &'static [u8] {
        C::FORMAT.none().unwrap_or_default()
    }
}

impl Format {
    /// This format with its [`none`](Format::none) for no vector, for [`AxisOrder`](crate::AxisOrder). `None` if it has none.
    ///
    /// ```
    /// use unitpack::{AxisOrder, Format, Strided, StridedMut};
    /// let format = Format::Oct32.or_none().unwrap();
    /// let mut bytes = [0; 4];
    /// let to = StridedMut { bytes: &mut bytes, offset: 0, stride: 4, len: 1 };
    /// AxisOrder::Xyz.encode_strided(format, Strided::of(&[[0.0f32; 3]], 0), to)?;
    /// assert_eq!(bytes, Format::Oct32.none().unwrap());
    /// # Ok::<(), unitpack::StrideMismatch>(())
    /// ```
    #[inline]
    pub const fn or_none(self) -> Option<OrNone<Format>> {
        if self.none().is_some() { Some(OrNone(self)) } else { None }
    }
}

impl<C: Codec> Codec for OrNone<C> {
    type Code = C::Code;
    const FORMAT: Format = C::FORMAT;
    const NONE: Option<C::Code> = C::NONE;

    #[inline]
    fn encode(v: [f32; 3]) -> C::Code {
        if has_direction(v) { C::encode(v) } else { Self::NONE }
    }
    #[inline]
    fn encode_precise(v: [f32; 3]) -> C::Code {
        if has_direction(v) { C::encode_precise(v) } else { Self::NONE }
    }
    #[inline]
    fn decode(code: C::Code) -> [f32; 3] {
        if Self::is_none(code) { [0.0; 3] } else { C::decode(code) }
    }
    #[inline]
    fn canonical(code: C::Code) -> C::Code {
        if Self::is_none(code) { Self::NONE } else { C::canonical(code) }
    }
    #[inline]
    fn negate(code: C::Code) -> C::Code {
        if Self::is_none(code) { Self::NONE } else { C::negate(code) }
    }
    #[inline]
    fn mirror(code: C::Code, axis: Axis) -> C::Code {
        if Self::is_none(code) { Self::NONE } else { C::mirror(code, axis) }
    }
}

impl<C: Codec> Batch for OrNone<C> {
    #[inline]
    fn encode_columns(v: [&[f32]; 3], mut codes: CodeSliceMut<'_>) {
        C::encode_columns(v, codes.reborrow());
        mark(v, codes, Self::bytes());
    }
    #[inline]
    fn encode_columns_precise(v: [&[f32]; 3], mut codes: CodeSliceMut<'_>) {
        C::encode_columns_precise(v, codes.reborrow());
        mark(v, codes, Self::bytes());
    }
    #[inline]
    fn decode_columns(codes: CodeSlice<'_>, [x, y, z]: [&mut [f32]; 3], fence: &Fence) {
        C::decode_columns(codes, [&mut *x, &mut *y, &mut *z], fence);
        clear(codes, [x, y, z], Self::bytes(), C::FORMAT.bits());
    }
    #[inline]
    fn mirror_codes(from: CodeSlice<'_>, mut to: CodeSliceMut<'_>, flips: [bool; 3]) {
        C::mirror_codes(from, to.reborrow(), flips);
        keep(from, to, Self::bytes(), C::FORMAT.bits());
    }

    // Part by part, so that what the second pass looks at is still near.
    #[inline]
    fn encode_batch(vectors: Vectors<'_, 3>, codes: CodesMut<'_>) {
        layout::encode_in_parts(vectors, codes, &mut |v, codes, []| Self::encode_columns(v, codes));
    }
    #[inline]
    fn encode_batch_precise(vectors: Vectors<'_, 3>, codes: CodesMut<'_>) {
        layout::encode_in_parts(vectors, codes, &mut |v, codes, []| {
            Self::encode_columns_precise(v, codes);
        });
    }
    #[inline]
    fn decode_batch(codes: Codes<'_>, vectors: VectorsMut<'_, 3>) {
        layout::decode_in_parts(codes, vectors, &mut |codes, v, []| {
            Self::decode_columns(codes, v, &Fence::new(false));
        });
    }
}

impl Chosen for OrNone<Format> {
    fn code_layout(self) -> CodeLayout {
        self.0.code_layout()
    }
    fn encode_chosen(self, v: [&[f32]; 3], mut codes: CodeSliceMut<'_>) {
        self.0.encode_chosen(v, codes.reborrow());
        mark(v, codes, self.0.none().unwrap_or_default());
    }
    fn encode_chosen_precise(self, v: [&[f32]; 3], mut codes: CodeSliceMut<'_>) {
        self.0.encode_chosen_precise(v, codes.reborrow());
        mark(v, codes, self.0.none().unwrap_or_default());
    }
    fn decode_chosen(self, codes: CodeSlice<'_>, [x, y, z]: [&mut [f32]; 3], fence: &Fence) {
        self.0.decode_chosen(codes, [&mut *x, &mut *y, &mut *z], fence);
        clear(codes, [x, y, z], self.0.none().unwrap_or_default(), self.0.bits());
    }
}

/// Whether a vector is neither zero nor has a NaN.
#[inline(always)]
fn has_direction(v: [f32; 3]) -> bool {
    0.0 < magnitude::<f32>(v.into())
}

/// Elements that are looked at together, as most have a direction.
const BLOCK: usize = 16;

/// Writes `none` for vectors without a direction.
#[inline(never)]
fn mark([x, y, z]: [&[f32]; 3], codes: CodeSliceMut<'_>, none: &[u8]) {
    let blocks = x.chunks(BLOCK).zip(y.chunks(BLOCK)).zip(z.chunks(BLOCK));
    let codes = codes.bytes.chunks_mut((BLOCK * codes.size).max(1));
    for (((x, y), z), codes) in blocks.zip(codes) {
        let vectors = || x.iter().zip(y).zip(z).map(|((&x, &y), &z)| [x, y, z]);
        if vectors().fold(true, |all, v| all & has_direction(v)) {
            continue;
        }
        for (v, code) in vectors().zip(codes.chunks_exact_mut(none.len().max(1))) {
            if !has_direction(v) {
                write(code, none);
            }
        }
    }
}

#[inline(always)]
fn write(code: &mut [u8], none: &[u8]) {
    for (to, &from) in code.iter_mut().zip(none) {
        *to = from;
    }
}

/// The little-endian bytes of a code that say something, of `bits` bits.
#[inline(always)]
fn used_bits<const N: usize>(bits: u32) -> [u8; N] {
    let used = (u64::MAX >> (64 - bits.clamp(1, 64))).to_le_bytes();
    core::array::from_fn(|i| used.get(i).copied().unwrap_or(0))
}

/// Whether the `used` bits of a code are those of `none`.
#[inline(always)]
fn is_none(code: &[u8], used: &[u8], none: &[u8]) -> bool {
    let bytes = code.iter().zip(used).zip(none);
    bytes.fold(0, |differ, ((code, used), none)| differ | (code & used) ^ none) == 0
}

/// Calls `found` with the index of each code that is `none`, of `bits` bits.
#[inline(always)]
fn for_each_none(codes: CodeSlice<'_>, none: &[u8], bits: u32, mut found: impl FnMut(usize)) {
    /// The same for codes of `N` bytes.
    #[inline(always)]
    fn of_size<const N: usize>(
        codes: &[u8],
        none: &[u8],
        bits: u32,
        found: &mut impl FnMut(usize),
    ) {
        let (Some(none), (codes, _)) = (none.first_chunk::<N>(), codes.as_chunks::<N>()) else {
            return;
        };
        let used = used_bits::<N>(bits);
        let is_none = |code: &[u8; N]| is_none(code, &used, none);
        for (block, codes) in codes.chunks(BLOCK).enumerate() {
            if codes.iter().fold(false, |any, code| any | is_none(code)) {
                for (i, code) in codes.iter().enumerate() {
                    if is_none(code) {
                        found(block * BLOCK + i);
                    }
                }
            }
        }
    }
    match none.len() {
        1 => of_size::<1>(codes.bytes, none, bits, &mut found),
        2 => of_size::<2>(codes.bytes, none, bits, &mut found),
        3 => of_size::<3>(codes.bytes, none, bits, &mut found),
        4 => of_size::<4>(codes.bytes, none, bits, &mut found),
        _ => of_size::<6>(codes.bytes, none, bits, &mut found),
    }
}

/// Writes zero for codes that are `none`.
#[inline(never)]
fn clear(codes: CodeSlice<'_>, v: [&mut [f32]; 3], none: &[u8], bits: u32) {
    let [x, y, z] = v;
    for_each_none(codes, none, bits, |i| {
        for column in [&mut *x, &mut *y, &mut *z] {
            if let Some(c) = column.get_mut(i) {
                *c = 0.0;
            }
        }
    });
}

/// Writes `none` where it was.
#[inline(never)]
fn keep(from: CodeSlice<'_>, to: CodeSliceMut<'_>, none: &[u8], bits: u32) {
    let to = to.bytes;
    for_each_none(from, none, bits, |i| {
        if let Some(code) = to.chunks_exact_mut(none.len().max(1)).nth(i) {
            write(code, none);
        }
    });
}
