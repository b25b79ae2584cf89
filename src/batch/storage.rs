//! Codes in lanes and in memory.

use bytemuck::Pod;

use crate::simd::{I32x1, Simd, SimdInt};

/// Number of 32-bit words that hold a code in lanes.
pub(crate) trait CodeShape: 'static {
    type In<V: Simd>: Copy;
}

/// Codes of at most 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Word;
/// Codes of one integer of more than 32 bits: its low and its high half.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Words2;
/// Codes of three components that need more than 32 bits: a word each.
pub(crate) struct Words3;

impl CodeShape for Word {
    type In<V: Simd> = V::Int;
}
impl CodeShape for Words2 {
    type In<V: Simd> = [V::Int; 2];
}
impl CodeShape for Words3 {
    type In<V: Simd> = [V::Int; 3];
}

/// A code of `S` in lanes.
pub(crate) type ShapeIn<S, V> = <S as CodeShape>::In<V>;

/// Size of the largest code in bytes.
pub(crate) const MAX_CODE: usize = 12;

/// Little-endian codes of `size` bytes, without gaps.
#[derive(Clone, Copy)]
pub struct CodeSlice<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) size: usize,
}

/// [`CodeSlice`] to write.
pub struct CodeSliceMut<'a> {
    pub(crate) bytes: &'a mut [u8],
    pub(crate) size: usize,
}

impl<'a> CodeSlice<'a> {
    pub(crate) fn len(self) -> usize {
        self.bytes.len().checked_div(self.size).unwrap_or(0)
    }

    /// The first `at` codes, and the others. `None` if there are fewer.
    pub(crate) fn split_at(self, at: usize) -> Option<(Self, Self)> {
        let (first, others) = self.bytes.split_at_checked(at * self.size)?;
        Some((CodeSlice { bytes: first, ..self }, CodeSlice { bytes: others, ..self }))
    }
}

impl CodeSliceMut<'_> {
    /// The same codes, for a while.
    pub(crate) fn reborrow(&mut self) -> CodeSliceMut<'_> {
        CodeSliceMut { bytes: &mut *self.bytes, size: self.size }
    }
}

/// Codes of one size, the [`CodeBytes`], or of any that a word holds: [`Words`].
pub(crate) trait CodeKind: 'static {
    type Shape: CodeShape;
    /// Whole blocks of codes.
    type Blocks<'a, V: Simd>: Copy;
    /// Whole blocks of codes.
    type BlocksMut<'a, V: Simd>;

    fn blocks<V: Simd>(codes: CodeSlice<'_>, count: usize) -> Option<Self::Blocks<'_, V>>;
    fn blocks_mut<V: Simd>(codes: CodeSliceMut<'_>, count: usize)
    -> Option<Self::BlocksMut<'_, V>>;
    /// Block `i`.
    fn load<V: Simd>(blocks: Self::Blocks<'_, V>, i: usize) -> Option<ShapeIn<Self::Shape, V>>;
    /// Writes block `i`.
    fn store<V: Simd>(code: ShapeIn<Self::Shape, V>, blocks: &mut Self::BlocksMut<'_, V>, i: usize);
}

impl<B: CodeBytes> CodeKind for B {
    type Shape = B::Shape;
    type Blocks<'a, V: Simd> = &'a [V::Block<B>];
    type BlocksMut<'a, V: Simd> = &'a mut [V::Block<B>];

    #[inline(always)]
    fn blocks<V: Simd>(codes: CodeSlice<'_>, count: usize) -> Option<&[V::Block<B>]> {
        blocks::<V, B>(bytemuck::try_cast_slice(codes.bytes).ok()?, count)
    }
    #[inline(always)]
    fn blocks_mut<V: Simd>(codes: CodeSliceMut<'_>, count: usize) -> Option<&mut [V::Block<B>]> {
        blocks_mut::<V, B>(bytemuck::try_cast_slice_mut(codes.bytes).ok()?, count)
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: &[V::Block<B>], i: usize) -> Option<CodeIn<B, V>> {
        Some(B::load::<V>(blocks.get(i)?))
    }
    #[inline(always)]
    fn store<V: Simd>(code: CodeIn<B, V>, blocks: &mut &mut [V::Block<B>], i: usize) {
        if let Some(block) = blocks.get_mut(i) {
            B::store::<V>(code, block);
        }
    }
}

/// Codes of one to four bytes. Each block looks at how many.
pub(crate) struct Words;

/// One of four, by the size of a code in bytes.
#[derive(Clone, Copy)]
pub(crate) enum BySize<A, B, C, D> {
    One(A),
    Two(B),
    Three(C),
    Four(D),
}

/// Blocks of codes of `B`.
type BlocksOf<'a, B, V> = <B as CodeKind>::Blocks<'a, V>;
type BlocksMutOf<'a, B, V> = <B as CodeKind>::BlocksMut<'a, V>;

impl CodeKind for Words {
    type Shape = Word;
    type Blocks<'a, V: Simd> = BySize<
        BlocksOf<'a, [u8; 1], V>,
        BlocksOf<'a, [u8; 2], V>,
        BlocksOf<'a, [u8; 3], V>,
        BlocksOf<'a, [u8; 4], V>,
    >;
    type BlocksMut<'a, V: Simd> = BySize<
        BlocksMutOf<'a, [u8; 1], V>,
        BlocksMutOf<'a, [u8; 2], V>,
        BlocksMutOf<'a, [u8; 3], V>,
        BlocksMutOf<'a, [u8; 4], V>,
    >;

    #[inline(always)]
    fn blocks<V: Simd>(codes: CodeSlice<'_>, count: usize) -> Option<Self::Blocks<'_, V>> {
        Some(match codes.size {
            1 => BySize::One(<[u8; 1]>::blocks::<V>(codes, count)?),
            2 => BySize::Two(<[u8; 2]>::blocks::<V>(codes, count)?),
            3 => BySize::Three(<[u8; 3]>::blocks::<V>(codes, count)?),
            _ => BySize::Four(<[u8; 4]>::blocks::<V>(codes, count)?),
        })
    }
    #[inline(always)]
    fn blocks_mut<V: Simd>(
        codes: CodeSliceMut<'_>,
        count: usize,
    ) -> Option<Self::BlocksMut<'_, V>> {
        Some(match codes.size {
            1 => BySize::One(<[u8; 1]>::blocks_mut::<V>(codes, count)?),
            2 => BySize::Two(<[u8; 2]>::blocks_mut::<V>(codes, count)?),
            3 => BySize::Three(<[u8; 3]>::blocks_mut::<V>(codes, count)?),
            _ => BySize::Four(<[u8; 4]>::blocks_mut::<V>(codes, count)?),
        })
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: Self::Blocks<'_, V>, i: usize) -> Option<V::Int> {
        match blocks {
            BySize::One(blocks) => <[u8; 1] as CodeKind>::load::<V>(blocks, i),
            BySize::Two(blocks) => <[u8; 2] as CodeKind>::load::<V>(blocks, i),
            BySize::Three(blocks) => <[u8; 3] as CodeKind>::load::<V>(blocks, i),
            BySize::Four(blocks) => <[u8; 4] as CodeKind>::load::<V>(blocks, i),
        }
    }
    #[inline(always)]
    fn store<V: Simd>(code: V::Int, blocks: &mut Self::BlocksMut<'_, V>, i: usize) {
        match blocks {
            BySize::One(blocks) => <[u8; 1] as CodeKind>::store::<V>(code, blocks, i),
            BySize::Two(blocks) => <[u8; 2] as CodeKind>::store::<V>(code, blocks, i),
            BySize::Three(blocks) => <[u8; 3] as CodeKind>::store::<V>(code, blocks, i),
            BySize::Four(blocks) => <[u8; 4] as CodeKind>::store::<V>(code, blocks, i),
        }
    }
}

/// Codes of at most eight bytes, in two words: those of [`Words`], and those of six or eight bytes. Each block looks at how
/// many.
pub(crate) struct DoubleWords;

impl DoubleWords {
    /// The least size in bytes, of two to eight, of codes of so many bits.
    #[inline]
    pub(crate) const fn size_of(bits: u32) -> usize {
        match bits {
            ..=16 => 2,
            17..=24 => 3,
            25..=32 => 4,
            33..=48 => 6,
            _ => 8,
        }
    }
}

/// One of three, by the size of a code in bytes.
#[derive(Clone, Copy)]
pub(crate) enum ByDoubleSize<A, B, C> {
    UpToFour(A),
    Six(B),
    Eight(C),
}

impl CodeKind for DoubleWords {
    type Shape = Words2;
    type Blocks<'a, V: Simd> =
        ByDoubleSize<BlocksOf<'a, Words, V>, &'a [V::Block<[u8; 6]>], BlocksOf<'a, [u8; 8], V>>;
    type BlocksMut<'a, V: Simd> = ByDoubleSize<
        BlocksMutOf<'a, Words, V>,
        &'a mut [V::Block<[u8; 6]>],
        BlocksMutOf<'a, [u8; 8], V>,
    >;

    #[inline(always)]
    fn blocks<V: Simd>(codes: CodeSlice<'_>, count: usize) -> Option<Self::Blocks<'_, V>> {
        Some(match codes.size {
            6 => ByDoubleSize::Six(<[u8; 6]>::blocks::<V>(codes, count)?),
            8 => ByDoubleSize::Eight(<[u8; 8]>::blocks::<V>(codes, count)?),
            _ => ByDoubleSize::UpToFour(Words::blocks::<V>(codes, count)?),
        })
    }
    #[inline(always)]
    fn blocks_mut<V: Simd>(
        codes: CodeSliceMut<'_>,
        count: usize,
    ) -> Option<Self::BlocksMut<'_, V>> {
        Some(match codes.size {
            6 => ByDoubleSize::Six(<[u8; 6]>::blocks_mut::<V>(codes, count)?),
            8 => ByDoubleSize::Eight(<[u8; 8]>::blocks_mut::<V>(codes, count)?),
            _ => ByDoubleSize::UpToFour(Words::blocks_mut::<V>(codes, count)?),
        })
    }
    #[inline(always)]
    fn load<V: Simd>(blocks: Self::Blocks<'_, V>, i: usize) -> Option<[V::Int; 2]> {
        match blocks {
            ByDoubleSize::UpToFour(blocks) => {
                Some([Words::load::<V>(blocks, i)?, V::Int::splat(0)])
            }
            ByDoubleSize::Six(blocks) => {
                let block = blocks.get(i)?;
                Some([
                    V::load_int(block, |[a, b, c, d, ..]: [u8; 6]| {
                        u32::from_le_bytes([a, b, c, d])
                    }),
                    V::load_int(block, |[.., a, b]: [u8; 6]| u32::from(u16::from_le_bytes([a, b]))),
                ])
            }
            ByDoubleSize::Eight(blocks) => <[u8; 8] as CodeKind>::load::<V>(blocks, i),
        }
    }
    #[inline(always)]
    fn store<V: Simd>([low, high]: [V::Int; 2], blocks: &mut Self::BlocksMut<'_, V>, i: usize) {
        match blocks {
            ByDoubleSize::UpToFour(blocks) => Words::store::<V>(low, blocks, i),
            ByDoubleSize::Six(blocks) => {
                if let Some(block) = blocks.get_mut(i) {
                    V::store_int(low, block, |[a, b, c, d, ..]: &mut [u8; 6], i| {
                        [*a, *b, *c, *d] = i.to_le_bytes();
                    });
                    V::store_int(high, block, |[.., a, b]: &mut [u8; 6], i| {
                        [*a, *b] = (i as u16).to_le_bytes();
                    });
                }
            }
            ByDoubleSize::Eight(blocks) => {
                <[u8; 8] as CodeKind>::store::<V>([low, high], blocks, i)
            }
        }
    }
}

/// A code in memory: its little-endian bytes, at any alignment.
pub(crate) trait CodeBytes: Pod {
    type Shape: CodeShape;

    fn load<V: Simd>(block: &V::Block<Self>) -> CodeIn<Self, V>;
    fn store<V: Simd>(code: CodeIn<Self, V>, block: &mut V::Block<Self>);
}

impl CodeBytes for [u8; 1] {
    type Shape = Word;
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> V::Int {
        V::load_int(block, |[byte]| u32::from(byte))
    }
    #[inline(always)]
    fn store<V: Simd>(code: V::Int, block: &mut V::Block<Self>) {
        V::store_int(code, block, |code, i| *code = [i as u8]);
    }
}

impl CodeBytes for [u8; 2] {
    type Shape = Word;
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> V::Int {
        V::load_int(block, |code| u32::from(u16::from_le_bytes(code)))
    }
    #[inline(always)]
    fn store<V: Simd>(code: V::Int, block: &mut V::Block<Self>) {
        V::store_int(code, block, |code, i| *code = (i as u16).to_le_bytes());
    }
}

impl CodeBytes for [u8; 3] {
    type Shape = Word;
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> V::Int {
        V::load_bytes(block)
    }
    #[inline(always)]
    fn store<V: Simd>(code: V::Int, block: &mut V::Block<Self>) {
        V::store_bytes(code, block);
    }
}

impl CodeBytes for [u8; 4] {
    type Shape = Word;
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> V::Int {
        V::load_int(block, u32::from_le_bytes)
    }
    #[inline(always)]
    fn store<V: Simd>(code: V::Int, block: &mut V::Block<Self>) {
        V::store_int(code, block, |code, i| *code = i.to_le_bytes());
    }
}

/// Three components of two bytes.
impl CodeBytes for [u8; 6] {
    type Shape = Words3;
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> [V::Int; 3] {
        [
            V::load_int(block, |[a, b, ..]: Self| u32::from(u16::from_le_bytes([a, b]))),
            V::load_int(block, |[_, _, a, b, ..]: Self| u32::from(u16::from_le_bytes([a, b]))),
            V::load_int(block, |[.., a, b]: Self| u32::from(u16::from_le_bytes([a, b]))),
        ]
    }
    #[inline(always)]
    fn store<V: Simd>([x, y, z]: [V::Int; 3], block: &mut V::Block<Self>) {
        V::store_int(x, block, |[a, b, ..]: &mut Self, i| [*a, *b] = (i as u16).to_le_bytes());
        V::store_int(y, block, |[_, _, a, b, ..], i| [*a, *b] = (i as u16).to_le_bytes());
        V::store_int(z, block, |[.., a, b], i| [*a, *b] = (i as u16).to_le_bytes());
    }
}

impl CodeBytes for [u8; 8] {
    type Shape = Words2;
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> [V::Int; 2] {
        [
            V::load_int(block, |[a, b, c, d, ..]: Self| u32::from_le_bytes([a, b, c, d])),
            V::load_int(block, |[.., a, b, c, d]: Self| u32::from_le_bytes([a, b, c, d])),
        ]
    }
    #[inline(always)]
    fn store<V: Simd>([low, high]: [V::Int; 2], block: &mut V::Block<Self>) {
        V::store_int(low, block, |[a, b, c, d, ..]: &mut Self, i| {
            [*a, *b, *c, *d] = i.to_le_bytes();
        });
        V::store_int(high, block, |[.., a, b, c, d], i| [*a, *b, *c, *d] = i.to_le_bytes());
    }
}

/// Three components of four bytes.
impl CodeBytes for [u8; 12] {
    type Shape = Words3;
    #[inline(always)]
    fn load<V: Simd>(block: &V::Block<Self>) -> [V::Int; 3] {
        [
            V::load_int(block, |[a, b, c, d, ..]: Self| u32::from_le_bytes([a, b, c, d])),
            V::load_int(block, |[_, _, _, _, a, b, c, d, ..]: Self| {
                u32::from_le_bytes([a, b, c, d])
            }),
            V::load_int(block, |[.., a, b, c, d]: Self| u32::from_le_bytes([a, b, c, d])),
        ]
    }
    #[inline(always)]
    fn store<V: Simd>([x, y, z]: [V::Int; 3], block: &mut V::Block<Self>) {
        V::store_int(x, block, |[a, b, c, d, ..]: &mut Self, i| {
            [*a, *b, *c, *d] = i.to_le_bytes();
        });
        V::store_int(y, block, |[_, _, _, _, a, b, c, d, ..], i| {
            [*a, *b, *c, *d] = i.to_le_bytes();
        });
        V::store_int(z, block, |[.., a, b, c, d], i| [*a, *b, *c, *d] = i.to_le_bytes());
    }
}

/// A code with the bytes `B`, in lanes.
pub(crate) type CodeIn<B, V> = ShapeIn<<B as CodeBytes>::Shape, V>;

/// The native code of one lane, whose little-endian bytes are a `B`, as large as `C`.
#[inline(always)]
pub(crate) fn to_native<B: CodeBytes, C: Pod>(code: CodeIn<B, f32>) -> C {
    let mut bytes = [B::zeroed()];
    B::store::<f32>(code, &mut bytes);
    swap_if_big_endian(bytemuck::bytes_of_mut(&mut bytes), align_of::<C>());
    bytemuck::cast(bytes)
}

/// One lane of a native code, whose little-endian bytes are a `B`, as large as `C`.
#[inline(always)]
pub(crate) fn from_native<B: CodeBytes, C: Pod>(code: C) -> CodeIn<B, f32> {
    let mut bytes: [B; 1] = bytemuck::cast(code);
    swap_if_big_endian(bytemuck::bytes_of_mut(&mut bytes), align_of::<C>());
    B::load::<f32>(&bytes)
}

/// A code of at most 64 bits in one lane.
pub(crate) trait OneLane: Copy {
    fn from_u64(code: u64) -> Self;
    fn to_u64(self) -> u64;
}

impl OneLane for I32x1 {
    #[inline]
    fn from_u64(code: u64) -> Self {
        I32x1(code as i32)
    }
    #[inline]
    fn to_u64(self) -> u64 {
        u64::from(self.0 as u32)
    }
}

/// [`Words2`].
impl OneLane for [I32x1; 2] {
    #[inline]
    fn from_u64(code: u64) -> Self {
        [I32x1(code as i32), I32x1((code >> 32) as i32)]
    }
    #[inline]
    fn to_u64(self) -> u64 {
        self[0].to_u64() | self[1].to_u64() << 32
    }
}

/// [`Words3`], of 16 bits each.
impl OneLane for [I32x1; 3] {
    #[inline]
    fn from_u64(code: u64) -> Self {
        [code, code >> 16, code >> 32].map(|word| I32x1((word & 0xFFFF) as i32))
    }
    #[inline]
    fn to_u64(self) -> u64 {
        let [x, y, z] = self.map(|word| word.to_u64() & 0xFFFF);
        x | y << 16 | z << 32
    }
}

/// Swaps codes between native and little-endian byte order. `element` is the size of the integers
/// that they consist of, which is a code's alignment.
#[inline]
pub(crate) fn swap_if_big_endian(bytes: &mut [u8], element: usize) {
    if cfg!(target_endian = "big") {
        for integer in bytes.chunks_exact_mut(element) {
            integer.reverse();
        }
    }
}

/// A slice as `count` blocks.
#[inline(always)]
pub(super) fn blocks<V: Simd, T: Copy + 'static>(
    slice: &[T],
    count: usize,
) -> Option<&[V::Block<T>]> {
    V::split(slice).0.get(..count)
}

/// A slice as `count` blocks.
#[inline(always)]
pub(super) fn blocks_mut<V: Simd, T: Copy + 'static>(
    slice: &mut [T],
    count: usize,
) -> Option<&mut [V::Block<T>]> {
    V::split_mut(slice).0.get_mut(..count)
}

/// Copies as many elements as both have.
#[inline(always)]
pub(crate) fn copy<T: Copy>(from: &[T], to: &mut [T]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    #[test]
    fn words_are_little_endian_bytes() {
        fn check<B: CodeBytes<Shape = Word> + PartialEq + core::fmt::Debug>(bytes: B, code: u32) {
            let mut stored = [B::zeroed()];
            // Of what is above the bytes nothing is kept.
            B::store::<f32>(I32x1(0x4433_2211), &mut stored);
            assert_eq!(stored, [bytes]);
            assert_eq!(B::load::<f32>(&stored).0 as u32, code);
        }
        check([0x11u8], 0x11);
        check([0x11u8, 0x22], 0x2211);
        check([0x11u8, 0x22, 0x33], 0x33_2211);
        check([0x11u8, 0x22, 0x33, 0x44], 0x4433_2211);
    }

    #[test]
    fn longer_codes_are_words_in_their_order() {
        fn check<B, const N: usize>(words: [i32; N], bytes: B)
        where
            B: CodeBytes + PartialEq + core::fmt::Debug,
            B::Shape: CodeShape<In<f32> = [I32x1; N]>,
        {
            let words = words.map(I32x1);
            assert_eq!(to_native::<B, B>(words), bytes);
            assert_eq!(from_native::<B, B>(bytes), words);
        }
        check([0x2211, 0x4433, 0x6655], [0x11u8, 0x22, 0x33, 0x44, 0x55, 0x66]);
        check([0x4433_2211, 0x0877_6655], [0x11u8, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x08]);
        let words = [0x0403_0201, 0x0807_0605, 0x0C0B_0A09];
        check(words, [1u8, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]);
    }

    #[test]
    fn native_codes_are_integers() {
        assert_eq!(to_native::<[u8; 2], u16>(I32x1(0x2211)), 0x2211);
        assert_eq!(to_native::<[u8; 3], [u8; 3]>(I32x1(0x33_2211)), [0x11, 0x22, 0x33]);
        assert_eq!(from_native::<[u8; 4], u32>(0x4433_2211).0, 0x4433_2211);
        let words = [0x2211, 0x4433, 0x6655];
        assert_eq!(to_native::<[u8; 6], [u16; 3]>(words.map(I32x1)), [0x2211, 0x4433, 0x6655]);
        let halves = from_native::<[u8; 8], u64>(0x0877_6655_4433_2211);
        assert_eq!(halves, [0x4433_2211, 0x0877_6655].map(I32x1));
    }

    #[test]
    fn words_go_by_the_size_of_a_code() {
        let bytes: [u8; 12] = core::array::from_fn(|i| i as u8);
        for (size, second) in [(1, 0x01), (2, 0x0302), (3, 0x05_0403), (4, 0x0706_0504)] {
            let count = bytes.len() / size;
            let blocks = Words::blocks::<f32>(CodeSlice { bytes: &bytes, size }, count).unwrap();
            assert_eq!(Words::load::<f32>(blocks, 1), Some(I32x1(second)));
            assert_eq!(Words::load::<f32>(blocks, count), None);
            assert!(Words::blocks::<f32>(CodeSlice { bytes: &bytes, size }, count + 1).is_none());

            let mut written = [0xEE; 12];
            let codes = CodeSliceMut { bytes: &mut written, size };
            let mut blocks = Words::blocks_mut::<f32>(codes, count).unwrap();
            Words::store::<f32>(I32x1(second), &mut blocks, 1);
            Words::store::<f32>(I32x1(-1), &mut blocks, count);
            assert_eq!(written[size..2 * size], bytes[size..2 * size]);
            assert!(written[..size].iter().chain(&written[2 * size..]).all(|b| *b == 0xEE));
        }
    }

    #[test]
    fn double_words_go_by_the_size_of_a_code() {
        let bytes: [u8; 24] = core::array::from_fn(|i| i as u8);
        for (size, second) in [
            (2, [0x0302, 0]),
            (3, [0x05_0403, 0]),
            (4, [0x0706_0504, 0]),
            (6, [0x0908_0706, 0x0B0A]),
            (8, [0x0B0A_0908, 0x0F0E_0D0C]),
        ] {
            let (count, second) = (bytes.len() / size, second.map(I32x1));
            let codes = CodeSlice { bytes: &bytes, size };
            let blocks = DoubleWords::blocks::<f32>(codes, count).unwrap();
            assert_eq!(DoubleWords::load::<f32>(blocks, 1), Some(second));
            assert_eq!(DoubleWords::load::<f32>(blocks, count), None);
            assert!(DoubleWords::blocks::<f32>(codes, count + 1).is_none());

            let mut written = [0xEE; 24];
            let codes = CodeSliceMut { bytes: &mut written, size };
            let mut blocks = DoubleWords::blocks_mut::<f32>(codes, count).unwrap();
            DoubleWords::store::<f32>(second, &mut blocks, 1);
            DoubleWords::store::<f32>([I32x1(-1); 2], &mut blocks, count);
            assert_eq!(written[size..2 * size], bytes[size..2 * size]);
            assert!(written[..size].iter().chain(&written[2 * size..]).all(|b| *b == 0xEE));
        }
    }

    #[test]
    fn slices_are_counted_and_split_in_codes() {
        let bytes = [1, 2, 3, 4, 5, 6, 7];
        let codes = CodeSlice { bytes: &bytes, size: 3 };
        assert_eq!(codes.len(), 2);
        let (first, others) = codes.split_at(1).unwrap();
        assert_eq!(
            (first.bytes, others.bytes, others.size),
            (&[1, 2, 3][..], &[4, 5, 6, 7][..], 3)
        );
        assert!(codes.split_at(3).is_none());
        assert_eq!(CodeSlice { bytes: &bytes, size: 0 }.len(), 0);
    }
}
