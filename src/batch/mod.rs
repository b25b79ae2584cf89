//! The loops: as many lanes as there are, then one, with the same formula.

pub(crate) mod code_int;

use core::marker::PhantomData;

use bytemuck::Pod;

use crate::error::LengthMismatch;
use crate::formula::{Formula, Packed, Stored};
use crate::simd::dispatch::{Job, dispatch, finish};
use crate::simd::stream::{self, Fence};
use crate::simd::{MOST_COMPONENTS, Simd};
use crate::{Codec, Visitor};

/// Vectors to read, as a structure of arrays. All three slices have one element per vector.
#[derive(Clone, Copy, Debug)]
pub struct Soa<'a> {
    /// The x components.
    pub x: &'a [f32],
    /// The y components.
    pub y: &'a [f32],
    /// The z components.
    pub z: &'a [f32],
}

/// Vectors to write, as a structure of arrays. All three slices have one element per vector.
#[derive(Debug)]
pub struct SoaMut<'a> {
    /// The x components.
    pub x: &'a mut [f32],
    /// The y components.
    pub y: &'a mut [f32],
    /// The z components.
    pub z: &'a mut [f32],
}

/// How many vectors a detour over the stack takes at a time: more where that is no matter, as each
/// time asks for the processor's lanes.
pub(crate) const STAGE: usize = if cfg!(feature = "std") { 256 } else { 64 };

/// Which of a formula's encoders.
pub(crate) trait Encoder {
    /// Whether it gives the nearest code.
    const PRECISE: bool;

    fn encode<F: Formula, V: Simd>(v: [V; 3]) -> Packed<F, V>;
}

pub(crate) struct Fast;
pub(crate) struct Precise;

impl Encoder for Fast {
    const PRECISE: bool = false;

    #[inline(always)]
    fn encode<F: Formula, V: Simd>(v: [V; 3]) -> Packed<F, V> {
        F::encode(v)
    }
}

impl Encoder for Precise {
    const PRECISE: bool = true;

    #[inline(always)]
    fn encode<F: Formula, V: Simd>(v: [V; 3]) -> Packed<F, V> {
        F::encode_precise(v)
    }
}

/// What the loop over codes does with a block of them.
pub(crate) trait Decoder<C: Copy + 'static> {
    fn decode<V: Simd>(&self, codes: &V::Block<C>) -> [V; 3];
}

/// A formula's decoder.
struct Direct<F>(PhantomData<F>);

impl<F: Formula, C: Stored<F::Words>> Decoder<C> for Direct<F> {
    #[inline(always)]
    fn decode<V: Simd>(&self, codes: &V::Block<C>) -> [V; 3] {
        F::decode::<V>(C::load::<V>(codes))
    }
}

#[inline(always)]
fn encode_block<E: Encoder, F: Formula, C: Stored<F::Words>, V: Simd>(
    x: &V::Block<f32>,
    y: &V::Block<f32>,
    z: &V::Block<f32>,
    codes: &mut V::Block<C>,
) {
    let v = F::prepare([V::load(x), V::load(y), V::load(z)]);
    C::store::<V>(E::encode::<F, V>(v), codes);
}

#[inline(always)]
fn encode_single<E: Encoder, F: Formula, C: Stored<F::Words>>([x, y, z]: [f32; 3]) -> C {
    let mut code = [C::zeroed()];
    encode_block::<E, F, C, f32>(&[x], &[y], &[z], &mut code);
    code[0]
}

#[inline]
pub(crate) fn encode_one<F: Formula, C: Stored<F::Words>>(v: [f32; 3]) -> C {
    encode_single::<Fast, F, C>(v)
}

#[inline]
pub(crate) fn encode_one_precise<F: Formula, C: Stored<F::Words>>(v: [f32; 3]) -> C {
    encode_single::<Precise, F, C>(v)
}

#[inline]
pub(crate) fn decode_one<F: Formula, C: Stored<F::Words>>(code: C) -> [f32; 3] {
    F::decode::<f32>(C::load::<f32>(&[code]))
}

/// What is made of codes without vectors.
trait Operation {
    fn apply<F: Formula, V: Simd>(&self, code: Packed<F, V>) -> Packed<F, V>;
}

struct Canonical;

impl Operation for Canonical {
    #[inline(always)]
    fn apply<F: Formula, V: Simd>(&self, code: Packed<F, V>) -> Packed<F, V> {
        F::canonical::<V>(code)
    }
}

/// Which components are negated.
struct Mirror([bool; 3]);

impl Operation for Mirror {
    #[inline(always)]
    fn apply<F: Formula, V: Simd>(&self, code: Packed<F, V>) -> Packed<F, V> {
        F::mirror::<V>(code, self.0)
    }
}

#[inline(always)]
fn apply_to_block<O: Operation, F: Formula, C: Stored<F::Words>, V: Simd>(
    operation: &O,
    codes: &mut V::Block<C>,
) {
    C::store::<V>(operation.apply::<F, V>(C::load::<V>(codes)), codes);
}

#[inline(always)]
fn apply_to_one<O: Operation, F: Formula, C: Stored<F::Words>>(operation: &O, code: C) -> C {
    let mut code = [code];
    apply_to_block::<O, F, C, f32>(operation, &mut code);
    code[0]
}

#[inline(never)]
fn apply_to_all<O: Operation, F: Formula, C: Stored<F::Words>>(operation: &O, codes: &mut [C]) {
    struct ApplyToAll<'a, O, F, C> {
        operation: &'a O,
        codes: &'a mut [C],
        formula: PhantomData<F>,
    }
    impl<O: Operation, F: Formula, C: Stored<F::Words>> Job for ApplyToAll<'_, O, F, C> {
        #[inline(always)]
        fn run<V: Simd>(self) -> Self {
            let ApplyToAll { operation, codes, formula } = self;
            let (blocks, codes) = V::split_mut(codes);
            for block in blocks {
                apply_to_block::<O, F, C, V>(operation, block);
            }
            ApplyToAll { operation, codes, formula }
        }
    }
    dispatch(ApplyToAll { operation, codes, formula: PhantomData::<F> });
}

#[inline]
pub(crate) fn canonical_one<F: Formula, C: Stored<F::Words>>(code: C) -> C {
    apply_to_one::<_, F, C>(&Canonical, code)
}

#[inline]
pub(crate) fn canonical_all<F: Formula, C: Stored<F::Words>>(codes: &mut [C]) {
    apply_to_all::<_, F, C>(&Canonical, codes);
}

#[inline]
pub(crate) fn mirror_one<F: Formula, C: Stored<F::Words>>(code: C, flips: [bool; 3]) -> C {
    apply_to_one::<_, F, C>(&Mirror(flips), code)
}

#[inline]
pub(crate) fn mirror_all<F: Formula, C: Stored<F::Words>>(codes: &mut [C], flips: [bool; 3]) {
    apply_to_all::<_, F, C>(&Mirror(flips), codes);
}

#[inline]
pub(crate) fn encode_soa<F: Formula, C: Stored<F::Words>>(
    v: Soa<'_>,
    codes: &mut [C],
) -> Result<(), LengthMismatch> {
    encode_all::<Fast, F, C>(v, codes)
}

#[inline]
pub(crate) fn encode_soa_precise<F: Formula, C: Stored<F::Words>>(
    v: Soa<'_>,
    codes: &mut [C],
) -> Result<(), LengthMismatch> {
    encode_all::<Precise, F, C>(v, codes)
}

#[inline(never)]
fn encode_all<E: Encoder, F: Formula, C: Stored<F::Words>>(
    v: Soa<'_>,
    codes: &mut [C],
) -> Result<(), LengthMismatch> {
    struct EncodeAll<'a, E, F, C> {
        v: Soa<'a>,
        codes: &'a mut [C],
        how: PhantomData<(E, F)>,
    }
    impl<E: Encoder, F: Formula, C: Stored<F::Words>> Job for EncodeAll<'_, E, F, C> {
        #[inline(always)]
        fn run<V: Simd>(self) -> Self {
            let EncodeAll { v: Soa { x, y, z }, codes, how } = self;
            let ((xs, x), (ys, y), (zs, z)) = (V::split(x), V::split(y), V::split(z));
            let (blocks, codes) = V::split_mut(codes);
            for (((x, y), z), codes) in xs.iter().zip(ys).zip(zs).zip(blocks) {
                encode_block::<E, F, C, V>(x, y, z, codes);
            }
            EncodeAll { v: Soa { x, y, z }, codes, how }
        }
    }
    LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
    dispatch(EncodeAll { v, codes, how: PhantomData::<(E, F)> });
    Ok(())
}

#[inline]
pub(crate) fn decode_soa<F: Formula, C: Stored<F::Words>>(
    codes: &[C],
    v: SoaMut<'_>,
) -> Result<(), LengthMismatch> {
    decode_all(&Direct::<F>(PhantomData), codes, v)
}

#[inline(never)]
pub(crate) fn decode_all<D: Decoder<C>, C: Copy + 'static>(
    decoder: &D,
    codes: &[C],
    v: SoaMut<'_>,
) -> Result<(), LengthMismatch> {
    struct DecodeAll<'a, D, C> {
        decoder: &'a D,
        codes: &'a [C],
        v: SoaMut<'a>,
    }
    impl<D: Decoder<C>, C: Copy + 'static> DecodeAll<'_, D, C> {
        /// Decodes lane by lane until `x` is aligned, and so, if they begin alike, `y` and `z`.
        fn align(self) -> Self {
            let DecodeAll { decoder, codes, v: SoaMut { x, y, z } } = self;
            let n = x.as_ptr().align_offset(stream::ALIGNMENT).min(codes.len());
            let (first_codes, codes) = codes.split_at(n);
            let ((first_x, x), (first_y, y), (first_z, z)) =
                (x.split_at_mut(n), y.split_at_mut(n), z.split_at_mut(n));
            finish(DecodeAll {
                decoder,
                codes: first_codes,
                v: SoaMut { x: first_x, y: first_y, z: first_z },
            });
            DecodeAll { decoder, codes, v: SoaMut { x, y, z } }
        }
    }
    impl<D: Decoder<C>, C: Copy + 'static> Job for DecodeAll<'_, D, C> {
        #[inline(always)]
        fn run<V: Simd>(self) -> Self {
            let DecodeAll { decoder, codes, v: SoaMut { x, y, z } } = self;
            let fence = Fence::new(V::STREAMS && stream::is_large(3 * size_of_val(x)));
            let ((xs, x), (ys, y), (zs, z)) = (V::split_mut(x), V::split_mut(y), V::split_mut(z));
            let (blocks, codes) = V::split(codes);
            for (((codes, x), y), z) in blocks.iter().zip(xs).zip(ys).zip(zs) {
                let v = decoder.decode::<V>(codes);
                if fence.streams() {
                    v[0].stream(x, &fence);
                    v[1].stream(y, &fence);
                    v[2].stream(z, &fence);
                } else {
                    v[0].store(x);
                    v[1].store(y);
                    v[2].store(z);
                }
            }
            DecodeAll { decoder, codes, v: SoaMut { x, y, z } }
        }
    }
    LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
    let mut job = DecodeAll { decoder, codes, v };
    if stream::is_large(3 * size_of_val(job.v.x)) {
        job = job.align();
    }
    dispatch(job);
    Ok(())
}

/// What a loop from one slice to another does to each block.
pub(crate) trait Kernel<A: Copy + 'static, B: Copy + 'static> {
    fn run<V: Simd>(from: &V::Block<A>, to: &mut V::Block<B>);
}

/// Runs `K` over two slices, which are equally long.
#[inline]
pub(crate) fn run<K: Kernel<A, B>, A: Copy + 'static, B: Copy + 'static>(from: &[A], to: &mut [B]) {
    struct All<'a, K, A, B> {
        from: &'a [A],
        to: &'a mut [B],
        kernel: PhantomData<K>,
    }
    impl<K: Kernel<A, B>, A: Copy + 'static, B: Copy + 'static> Job for All<'_, K, A, B> {
        #[inline(always)]
        fn run<V: Simd>(self) -> Self {
            let All { from, to, kernel } = self;
            let ((froms, from), (tos, to)) = (V::split(from), V::split_mut(to));
            for (from, to) in froms.iter().zip(tos) {
                K::run::<V>(from, to);
            }
            All { from, to, kernel }
        }
    }
    dispatch(All { from, to, kernel: PhantomData::<K> });
}

/// Runs `K` on one element.
#[inline]
pub(crate) fn run_one<K: Kernel<A, B>, A: Copy + 'static, B: Pod>(from: A) -> B {
    let mut to = [B::zeroed()];
    K::run::<f32>(&[from], &mut to);
    to[0]
}

/// A few vectors on the stack, between a layout of the caller's and the loops over structures of
/// arrays.
pub(crate) struct Stage {
    x: [f32; STAGE],
    y: [f32; STAGE],
    z: [f32; STAGE],
}

impl Stage {
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Stage { x: [0.0; STAGE], y: [0.0; STAGE], z: [0.0; STAGE] }
    }

    #[inline(always)]
    pub(crate) fn read(&self, len: usize) -> Soa<'_> {
        let len = len.min(STAGE);
        Soa { x: &self.x[..len], y: &self.y[..len], z: &self.z[..len] }
    }

    #[inline(always)]
    pub(crate) fn write(&mut self, len: usize) -> SoaMut<'_> {
        let len = len.min(STAGE);
        SoaMut { x: &mut self.x[..len], y: &mut self.y[..len], z: &mut self.z[..len] }
    }

    #[inline(always)]
    pub(crate) fn gather<const N: usize>(&mut self, vectors: &[[f32; N]]) {
        rearrange::<N, _>(Gather { vectors, v: self.write(vectors.len()) });
    }

    #[inline(always)]
    pub(crate) fn scatter<const N: usize>(&self, vectors: &mut [[f32; N]]) {
        rearrange::<N, _>(Scatter { v: self.read(vectors.len()), vectors });
    }
}

/// Does a job for vectors of `N` components, in lanes if there are few.
#[inline(always)]
fn rearrange<const N: usize, J: Job>(job: J) {
    if N <= MOST_COMPONENTS { dispatch(job) } else { finish(job) }
}

/// From an array of structures to a structure of arrays.
struct Gather<'a, const N: usize> {
    vectors: &'a [[f32; N]],
    v: SoaMut<'a>,
}

impl<const N: usize> Job for Gather<'_, N> {
    // It has no operations that rearrange lanes; the compiler does better with a plain loop.
    const WIDE: bool = false;

    #[inline(always)]
    fn run<V: Simd>(self) -> Self {
        let Gather { vectors, v: SoaMut { x, y, z } } = self;
        let ((xs, x), (ys, y), (zs, z)) = (V::split_mut(x), V::split_mut(y), V::split_mut(z));
        let (blocks, vectors) = V::split(vectors);
        for (((vectors, x), y), z) in blocks.iter().zip(xs).zip(ys).zip(zs) {
            let v = V::load_vectors(vectors);
            v[0].store(x);
            v[1].store(y);
            v[2].store(z);
        }
        Gather { vectors, v: SoaMut { x, y, z } }
    }
}

/// From a structure of arrays to an array of structures.
struct Scatter<'a, const N: usize> {
    v: Soa<'a>,
    vectors: &'a mut [[f32; N]],
}

impl<const N: usize> Job for Scatter<'_, N> {
    // It has no operations that rearrange lanes; the compiler does better with a plain loop.
    const WIDE: bool = false;

    #[inline(always)]
    fn run<V: Simd>(self) -> Self {
        let Scatter { v: Soa { x, y, z }, vectors } = self;
        let ((xs, x), (ys, y), (zs, z)) = (V::split(x), V::split(y), V::split(z));
        let (blocks, vectors) = V::split_mut(vectors);
        for (((x, y), z), vectors) in xs.iter().zip(ys).zip(zs).zip(blocks) {
            V::store_vectors([V::load(x), V::load(y), V::load(z)], vectors);
        }
        Scatter { v: Soa { x, y, z }, vectors }
    }
}

/// An encoder's loop. A pointer, so that the detours are compiled once for each type of code, not
/// for each codec.
type Encode<C> = fn(Soa<'_>, &mut [C]) -> Result<(), LengthMismatch>;
/// A decoder's loop.
type Decode<C> = fn(&[C], SoaMut<'_>) -> Result<(), LengthMismatch>;

/// Runs `encode` over an array of structures.
#[inline]
pub(crate) fn encode_aos<C, const N: usize>(
    vectors: &[[f32; N]],
    codes: &mut [C],
    encode: Encode<C>,
) -> Result<(), LengthMismatch> {
    const { assert!(N >= 3, "a vector has at least three components") };
    LengthMismatch::check_aos(vectors.len(), codes.len())?;
    let mut stage = Stage::new();
    for (vectors, codes) in vectors.chunks(STAGE).zip(codes.chunks_mut(STAGE)) {
        stage.gather(vectors);
        encode(stage.read(vectors.len()), codes)?;
    }
    Ok(())
}

/// Runs `decode` over an array of structures.
#[inline]
pub(crate) fn decode_aos<C, const N: usize>(
    codes: &[C],
    vectors: &mut [[f32; N]],
    decode: Decode<C>,
) -> Result<(), LengthMismatch> {
    const { assert!(N >= 3, "a vector has at least three components") };
    LengthMismatch::check_aos(vectors.len(), codes.len())?;
    let mut stage = Stage::new();
    for (vectors, codes) in vectors.chunks_mut(STAGE).zip(codes.chunks(STAGE)) {
        decode(codes, stage.write(vectors.len()))?;
        stage.scatter(vectors);
    }
    Ok(())
}

/// Decodes codes of `A` and encodes them as `B` with the fast encoder, without a buffer between.
///
/// `dst` is as long as `src`; otherwise nothing is written.
///
/// # Errors
/// [`LengthMismatch`] if the lengths differ.
#[inline]
pub fn transcode<A: Codec, B: Codec>(
    src: &[A::Code],
    dst: &mut [B::Code],
) -> Result<(), LengthMismatch> {
    transcode_with(src, dst, A::decode_soa, B::encode_soa)
}

#[inline]
fn transcode_with<A, B>(
    src: &[A],
    dst: &mut [B],
    decode: Decode<A>,
    encode: Encode<B>,
) -> Result<(), LengthMismatch> {
    LengthMismatch::check_transcode(src.len(), dst.len())?;
    let mut stage = Stage::new();
    for (src, dst) in src.chunks(STAGE).zip(dst.chunks_mut(STAGE)) {
        decode(src, stage.write(src.len()))?;
        encode(stage.read(src.len()), dst)?;
    }
    Ok(())
}

/// Runs `encode` over codes that stand as little-endian bytes, at any alignment.
#[inline]
fn encode_bytes<C: Pod>(
    v: Soa<'_>,
    bytes: &mut [u8],
    encode: Encode<C>,
) -> Result<(), LengthMismatch> {
    let size = size_of::<C>();
    LengthMismatch::check_bytes(v.x.len(), v.y.len(), v.z.len(), bytes.len(), size)?;
    if cfg!(target_endian = "little")
        && let Ok(codes) = bytemuck::try_cast_slice_mut(bytes)
    {
        return encode(v, codes);
    }
    let mut codes = [C::zeroed(); STAGE];
    let vectors = v.x.chunks(STAGE).zip(v.y.chunks(STAGE)).zip(v.z.chunks(STAGE));
    for (((x, y), z), bytes) in vectors.zip(bytes.chunks_mut(STAGE * size)) {
        let codes = &mut codes[..x.len().min(STAGE)];
        encode(Soa { x, y, z }, codes)?;
        copy_little_endian::<C>(bytes, bytemuck::cast_slice(codes));
    }
    Ok(())
}

/// Runs `decode` over codes that stand as little-endian bytes, at any alignment.
#[inline]
fn decode_bytes<C: Pod>(
    bytes: &[u8],
    v: SoaMut<'_>,
    decode: Decode<C>,
) -> Result<(), LengthMismatch> {
    let size = size_of::<C>();
    LengthMismatch::check_bytes(v.x.len(), v.y.len(), v.z.len(), bytes.len(), size)?;
    if cfg!(target_endian = "little")
        && let Ok(codes) = bytemuck::try_cast_slice(bytes)
    {
        return decode(codes, v);
    }
    let mut codes = [C::zeroed(); STAGE];
    let vectors = v.x.chunks_mut(STAGE).zip(v.y.chunks_mut(STAGE)).zip(v.z.chunks_mut(STAGE));
    for (((x, y), z), bytes) in vectors.zip(bytes.chunks(STAGE * size)) {
        let codes = &mut codes[..x.len().min(STAGE)];
        copy_little_endian::<C>(bytemuck::cast_slice_mut(codes), bytes);
        decode(codes, SoaMut { x, y, z })?;
    }
    Ok(())
}

/// Copies whole codes between native and little-endian byte order, either way.
#[inline]
fn copy_little_endian<C>(to: &mut [u8], from: &[u8]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
    if cfg!(target_endian = "big") {
        // A code is one integer or an array of them, as large as its alignment.
        for word in to.chunks_exact_mut(align_of::<C>()) {
            word.reverse();
        }
    }
}

/// [`Format::encode`](crate::Format::encode).
pub(crate) struct EncodeBytes<'a, const PRECISE: bool> {
    pub(crate) v: Soa<'a>,
    pub(crate) bytes: &'a mut [u8],
}

impl<const PRECISE: bool> Visitor for EncodeBytes<'_, PRECISE> {
    type Output = Result<(), LengthMismatch>;
    #[inline]
    fn visit<C: Codec>(self) -> Self::Output {
        let encode = if PRECISE { C::encode_soa_precise } else { C::encode_soa };
        encode_bytes(self.v, self.bytes, encode)
    }
}

/// [`Format::decode`](crate::Format::decode).
pub(crate) struct DecodeBytes<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) v: SoaMut<'a>,
}

impl Visitor for DecodeBytes<'_> {
    type Output = Result<(), LengthMismatch>;
    #[inline]
    fn visit<C: Codec>(self) -> Self::Output {
        decode_bytes(self.bytes, self.v, C::decode_soa)
    }
}
