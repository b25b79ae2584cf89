//! Codes in lanes and in memory.

use bytemuck::Pod;

use crate::simd::Simd;

/// Number of 32-bit words that hold a code in lanes.
pub(crate) trait CodeShape: 'static {
    type In<V: Simd>: Copy;
}

/// Codes of at most 32 bits.
pub(crate) struct Word;
/// Codes of one integer of more than 32 bits: its low and its high half.
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
pub(crate) struct CodeSlice<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) size: usize,
}

/// [`CodeSlice`] to write.
pub(crate) struct CodeSliceMut<'a> {
    pub(crate) bytes: &'a mut [u8],
    pub(crate) size: usize,
}

/// Codes of one size, the [`CodeBytes`], or of any that a word holds: [`Words`].
pub(crate) trait CodeKind: 'static {
    type Shape: CodeShape;

    /// Block `i`.
    fn load<V: Simd>(codes: CodeSlice<'_>, i: usize) -> Option<ShapeIn<Self::Shape, V>>;
    /// Writes block `i`.
    fn store<V: Simd>(code: ShapeIn<Self::Shape, V>, codes: &mut CodeSliceMut<'_>, i: usize);
}

/// Codes of one to four bytes. Their size is looked at for each block.
pub(crate) struct Words;

impl CodeKind for Words {
    type Shape = Word;

    #[inline(always)]
    fn load<V: Simd>(codes: CodeSlice<'_>, i: usize) -> Option<V::Int> {
        match codes.size {
            1 => <[u8; 1] as CodeKind>::load::<V>(codes, i),
            2 => <[u8; 2] as CodeKind>::load::<V>(codes, i),
            3 => <[u8; 3] as CodeKind>::load::<V>(codes, i),
            _ => <[u8; 4] as CodeKind>::load::<V>(codes, i),
        }
    }
    #[inline(always)]
    fn store<V: Simd>(code: V::Int, codes: &mut CodeSliceMut<'_>, i: usize) {
        match codes.size {
            1 => <[u8; 1] as CodeKind>::store::<V>(code, codes, i),
            2 => <[u8; 2] as CodeKind>::store::<V>(code, codes, i),
            3 => <[u8; 3] as CodeKind>::store::<V>(code, codes, i),
            _ => <[u8; 4] as CodeKind>::store::<V>(code, codes, i),
        }
    }
}

impl<B: CodeBytes> CodeKind for B {
    type Shape = B::Shape;

    #[inline(always)]
    fn load<V: Simd>(codes: CodeSlice<'_>, i: usize) -> Option<CodeIn<B, V>> {
        let size = V::LANES * size_of::<B>();
        let bytes = codes.bytes.get(i * size..)?.get(..size)?;
        let elements = bytemuck::try_cast_slice(bytes).ok()?;
        Some(B::load::<V>(V::split(elements).0.first()?))
    }
    #[inline(always)]
    fn store<V: Simd>(code: CodeIn<B, V>, codes: &mut CodeSliceMut<'_>, i: usize) {
        let size = V::LANES * size_of::<B>();
        if let Some(bytes) = codes.bytes.get_mut(i * size..)
            && let Some(bytes) = bytes.get_mut(..size)
            && let Ok(elements) = bytemuck::try_cast_slice_mut(bytes)
            && let Some(block) = V::split_mut(elements).0.first_mut()
        {
            B::store::<V>(code, block);
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

/// Copies as many bytes as both have.
#[inline(always)]
pub(crate) fn copy(from: &[u8], to: &mut [u8]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}
