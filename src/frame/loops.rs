//! The loops over frames: as many lanes as there are, then one, with the same formula.

use core::marker::PhantomData;

use crate::batch::{Encoder, STAGE, Soa, SoaMut, Stage};
use crate::error::LengthMismatch;
use crate::simd::dispatch::{Job, dispatch};
use crate::simd::{Simd, SimdInt};

use super::formula::{FrameFormula, Prepared, StoredFrame, skew_degrees};
use super::{Frame, FrameSoa, FrameSoaMut, Skew};

/// The most skewed of the frames seen so far.
#[derive(Default)]
struct Worst {
    sin_squared: f32,
    index: usize,
    seen: usize,
}

impl Worst {
    /// Takes account of so many blocks: of each lane the greatest squared sine, and of which block it
    /// first was.
    #[inline(always)]
    fn consider<V: Simd>(&mut self, sin_squared: V, block: V::Int, blocks: usize) {
        /// No lanes are more.
        const MOST: usize = 16;
        let lanes = size_of::<V::Block<f32>>() / size_of::<f32>();
        let (mut sines, mut of_blocks) = ([0.0; MOST], [0; MOST]);
        if let (Some(sines), Some(of_blocks)) =
            (V::split_mut(&mut sines).0.first_mut(), V::split_mut(&mut of_blocks).0.first_mut())
        {
            sin_squared.store(sines);
            V::store_int(block, of_blocks, |block, i| *block = i);
        }
        let first = self.seen;
        for (lane, (sin_squared, block)) in sines.into_iter().zip(of_blocks).enumerate() {
            let index = first + block as usize * lanes + lane;
            // Of equals the first, which may stand in a later lane.
            let earlier = sin_squared == self.sin_squared && index < self.index;
            if sin_squared > self.sin_squared || earlier {
                (self.sin_squared, self.index) = (sin_squared, index);
            }
        }
        self.seen = first + blocks * lanes;
    }

    fn skew(&self) -> Skew {
        Skew { degrees: skew_degrees(self.sin_squared), index: self.index }
    }
}

#[inline(always)]
fn encode_block<E: Encoder, F: FrameFormula, C: StoredFrame, V: Simd>(
    normal: [V; 3],
    tangent: [V; 3],
    handedness: V,
    code: &mut V::Block<C>,
) -> V {
    let frame = Prepared::new(normal, tangent, handedness);
    let sin_squared = frame.sin_squared;
    C::store::<V>(F::encode::<E, V>(frame), code);
    sin_squared
}

#[inline]
pub(crate) fn encode_one<E: Encoder, F: FrameFormula, C: StoredFrame>(frame: Frame) -> C {
    let Frame { normal, tangent, handedness } = frame;
    let mut code = [C::zeroed()];
    encode_block::<E, F, C, f32>(normal, tangent, handedness, &mut code);
    code[0]
}

#[inline]
pub(crate) fn decode_one<F: FrameFormula, C: StoredFrame>(code: C) -> Frame {
    let frame = F::decode::<f32>(C::load::<f32>(&[code]));
    Frame { normal: frame.normal, tangent: frame.tangent, handedness: frame.handedness }
}

#[inline]
pub(crate) fn canonical_one<F: FrameFormula, C: StoredFrame>(code: C) -> C {
    let mut canonical = [C::zeroed()];
    C::store::<f32>(F::canonical::<f32>(C::load::<f32>(&[code])), &mut canonical);
    canonical[0]
}

#[inline]
pub(crate) fn encode_soa<E: Encoder, F: FrameFormula, C: StoredFrame>(
    frames: FrameSoa<'_>,
    codes: &mut [C],
) -> Result<Skew, LengthMismatch> {
    let lengths = |v: Soa<'_>| [v.x.len(), v.y.len(), v.z.len()];
    let (normal, tangent) = (lengths(frames.normal), lengths(frames.tangent));
    LengthMismatch::check_frame_soa(normal, tangent, frames.handedness.len(), codes.len())?;
    let mut worst = Worst::default();
    encode_all::<E, F, C>(frames, codes, &mut worst);
    Ok(worst.skew())
}

/// All slices are equally long.
#[inline(never)]
fn encode_all<E: Encoder, F: FrameFormula, C: StoredFrame>(
    frames: FrameSoa<'_>,
    codes: &mut [C],
    worst: &mut Worst,
) {
    struct EncodeAll<'a, E, F, C> {
        frames: FrameSoa<'a>,
        codes: &'a mut [C],
        worst: &'a mut Worst,
        how: PhantomData<(E, F)>,
    }
    impl<E: Encoder, F: FrameFormula, C: StoredFrame> Job for EncodeAll<'_, E, F, C> {
        #[inline(always)]
        fn run<V: Simd>(self) -> Self {
            let EncodeAll { frames: FrameSoa { normal, tangent, handedness }, codes, worst, how } =
                self;
            let (normals, normal) = split::<V>(normal);
            let (tangents, tangent) = split::<V>(tangent);
            let (signs, handedness) = V::split(handedness);
            let (blocks, codes) = V::split_mut(codes);
            let count = blocks.len();
            let normals = normals.x.iter().zip(normals.y).zip(normals.z);
            let tangents = tangents.x.iter().zip(tangents.y).zip(tangents.z);
            let (mut greatest, mut of_block) = (V::zero(), V::Int::splat(0));
            let mut number = V::Int::splat(0);
            for ((((nx, ny), nz), ((tx, ty), tz)), (sign, code)) in
                normals.zip(tangents).zip(signs.iter().zip(blocks))
            {
                let normal = [V::load(nx), V::load(ny), V::load(nz)];
                let tangent = [V::load(tx), V::load(ty), V::load(tz)];
                let sin_squared = encode_block::<E, F, C, V>(normal, tangent, V::load(sign), code);
                let greater = greatest.lt(sin_squared);
                greatest = V::select(greater, sin_squared, greatest);
                of_block = V::Int::select(greater, number, of_block);
                number = number + V::Int::splat(1);
            }
            worst.consider(greatest, of_block, count);
            EncodeAll { frames: FrameSoa { normal, tangent, handedness }, codes, worst, how }
        }
    }
    dispatch(EncodeAll { frames, codes, worst, how: PhantomData::<(E, F)> });
}

/// Blocks of the components of vectors.
struct Blocks<'a, B> {
    x: &'a [B],
    y: &'a [B],
    z: &'a [B],
}

#[inline(always)]
fn split<V: Simd>(v: Soa<'_>) -> (Blocks<'_, V::Block<f32>>, Soa<'_>) {
    let ((xs, x), (ys, y), (zs, z)) = (V::split(v.x), V::split(v.y), V::split(v.z));
    (Blocks { x: xs, y: ys, z: zs }, Soa { x, y, z })
}

#[inline]
pub(crate) fn decode_soa<F: FrameFormula, C: StoredFrame>(
    codes: &[C],
    frames: FrameSoaMut<'_>,
) -> Result<(), LengthMismatch> {
    let lengths = |v: &SoaMut<'_>| [v.x.len(), v.y.len(), v.z.len()];
    let (normal, tangent) = (lengths(&frames.normal), lengths(&frames.tangent));
    LengthMismatch::check_frame_soa(normal, tangent, frames.handedness.len(), codes.len())?;
    decode_all::<F, C>(codes, frames);
    Ok(())
}

/// All slices are equally long.
#[inline(never)]
fn decode_all<F: FrameFormula, C: StoredFrame>(codes: &[C], frames: FrameSoaMut<'_>) {
    struct DecodeAll<'a, F, C> {
        codes: &'a [C],
        frames: FrameSoaMut<'a>,
        how: PhantomData<F>,
    }
    impl<F: FrameFormula, C: StoredFrame> Job for DecodeAll<'_, F, C> {
        #[inline(always)]
        fn run<V: Simd>(self) -> Self {
            let DecodeAll { codes, frames: FrameSoaMut { normal, tangent, handedness }, how } =
                self;
            let ((nx, x), (ny, y), (nz, z)) =
                (V::split_mut(normal.x), V::split_mut(normal.y), V::split_mut(normal.z));
            let normal = SoaMut { x, y, z };
            let ((tx, x), (ty, y), (tz, z)) =
                (V::split_mut(tangent.x), V::split_mut(tangent.y), V::split_mut(tangent.z));
            let tangent = SoaMut { x, y, z };
            let (signs, handedness) = V::split_mut(handedness);
            let (blocks, codes) = V::split(codes);
            let normals = nx.iter_mut().zip(ny).zip(nz);
            let tangents = tx.iter_mut().zip(ty).zip(tz);
            for ((((nx, ny), nz), ((tx, ty), tz)), (sign, code)) in
                normals.zip(tangents).zip(signs.iter_mut().zip(blocks))
            {
                let frame = F::decode::<V>(C::load::<V>(code));
                frame.normal[0].store(nx);
                frame.normal[1].store(ny);
                frame.normal[2].store(nz);
                frame.tangent[0].store(tx);
                frame.tangent[1].store(ty);
                frame.tangent[2].store(tz);
                frame.handedness.store(sign);
            }
            DecodeAll { codes, frames: FrameSoaMut { normal, tangent, handedness }, how }
        }
    }
    dispatch(DecodeAll { codes, frames, how: PhantomData::<F> });
}

#[inline]
pub(crate) fn encode_aos<E: Encoder, F: FrameFormula, C: StoredFrame, const N: usize>(
    normals: &[[f32; N]],
    tangents: &[[f32; 4]],
    codes: &mut [C],
) -> Result<Skew, LengthMismatch> {
    const { assert!(N >= 3, "a vector has at least three components") };
    LengthMismatch::check_frame_aos(normals.len(), tangents.len(), codes.len())?;
    let (mut normal, mut tangent, mut handedness) = (Stage::new(), Stage::new(), [0.0; STAGE]);
    let mut worst = Worst::default();
    let chunks = normals.chunks(STAGE).zip(tangents.chunks(STAGE));
    for ((normals, tangents), codes) in chunks.zip(codes.chunks_mut(STAGE)) {
        normal.gather(normals);
        tangent.gather(tangents);
        for (sign, tangent) in handedness.iter_mut().zip(tangents) {
            *sign = tangent[3];
        }
        let len = codes.len().min(STAGE);
        let frames = FrameSoa {
            normal: normal.read(len),
            tangent: tangent.read(len),
            handedness: &handedness[..len],
        };
        encode_all::<E, F, C>(frames, codes, &mut worst);
    }
    Ok(worst.skew())
}

#[inline]
pub(crate) fn decode_aos<F: FrameFormula, C: StoredFrame, const N: usize>(
    codes: &[C],
    normals: &mut [[f32; N]],
    tangents: &mut [[f32; 4]],
) -> Result<(), LengthMismatch> {
    const { assert!(N >= 3, "a vector has at least three components") };
    LengthMismatch::check_frame_aos(normals.len(), tangents.len(), codes.len())?;
    let (mut normal, mut tangent, mut handedness) = (Stage::new(), Stage::new(), [0.0; STAGE]);
    let chunks = normals.chunks_mut(STAGE).zip(tangents.chunks_mut(STAGE));
    for ((normals, tangents), codes) in chunks.zip(codes.chunks(STAGE)) {
        let len = codes.len().min(STAGE);
        let frames = FrameSoaMut {
            normal: normal.write(len),
            tangent: tangent.write(len),
            handedness: &mut handedness[..len],
        };
        decode_all::<F, C>(codes, frames);
        normal.scatter(normals);
        tangent.scatter(tangents);
        for (tangent, sign) in tangents.iter_mut().zip(handedness) {
            tangent[3] = sign;
        }
    }
    Ok(())
}
