//! The kernels of frame codecs, in any layout.

use crate::batch::columns::{CodeColumn, Columns, Output};
use crate::batch::layout::{self, Codes, CodesMut, PairMut, Vectors, VectorsMut, Within, Write};
use crate::batch::storage::{CodeSlice, ShapeIn};
use crate::batch::{Kernel, map, run};
use crate::simd::stream::Fence;
use crate::simd::{Simd, Use, Vec3};

use super::Skew;
use super::formula::{FrameCodes, FrameFormula, Prepared, skew_degrees};

/// The kernels of a codec, compiled here: see [`Kernels`](crate::formula::Kernels). Tangents have the
/// handedness as their fourth component.
pub trait FrameKernels {
    /// [`FrameCodec::encode_soa`](super::FrameCodec::encode_soa) and the like.
    fn encode_batch(frames: (Vectors<'_, 3>, Vectors<'_, 4>), codes: CodesMut<'_>) -> Skew;
    /// [`FrameCodec::encode_soa_precise`](super::FrameCodec::encode_soa_precise) and the like.
    fn encode_batch_precise(frames: (Vectors<'_, 3>, Vectors<'_, 4>), codes: CodesMut<'_>) -> Skew;
    /// [`FrameCodec::decode_soa`](super::FrameCodec::decode_soa) and the like.
    fn decode_batch(codes: Codes<'_>, frames: (VectorsMut<'_, 3>, VectorsMut<'_, 4>));
    /// [`FrameCodec::decode_vertices`](super::FrameCodec::decode_vertices).
    fn decode_pairs(codes: Codes<'_>, frames: PairMut<'_>);
}

/// [`FrameFormula::encode`], and the squared sines of the skew.
#[derive(Clone, Copy)]
struct Encode<F, const PRECISE: bool>(F);
/// [`FrameFormula::decode`].
#[derive(Clone, Copy)]
struct Decode<F>(F);

/// Normals and tangents.
pub(super) type Frames = (Columns<3>, Columns<4>);

impl<F: FrameFormula, C: FrameCodes, const PRECISE: bool>
    Kernel<Frames, (CodeColumn<C>, Columns<1>)> for Encode<F, PRECISE>
{
    const USE: Use = if PRECISE { Use::Sometimes } else { Use::Often };

    #[inline(always)]
    fn run<V: Simd>(
        self,
        ([nx, ny, nz], [tx, ty, tz, handedness]): ([V; 3], [V; 4]),
    ) -> (ShapeIn<C::Shape, V>, [V; 1]) {
        let frame = Prepared::new(Vec3::new(nx, ny, nz), Vec3::new(tx, ty, tz), handedness);
        let sin_squared = frame.sin_squared;
        (C::from_words::<V>(self.0.encode::<V, PRECISE>(frame)), [sin_squared])
    }
}

impl<F: FrameFormula, C: FrameCodes> Kernel<CodeColumn<C>, Frames> for Decode<F> {
    #[inline(always)]
    fn run<V: Simd>(self, code: ShapeIn<C::Shape, V>) -> ([V; 3], [V; 4]) {
        let frame = self.0.decode::<V>(C::to_words::<V>(code));
        let Vec3 { x, y, z } = frame.tangent;
        (frame.normal.to_array(), [x, y, z, frame.handedness])
    }
}

/// The most skewed of the frames so far.
#[derive(Default)]
struct Worst {
    sin_squared: f32,
    index: usize,
    /// Number of frames so far.
    count: usize,
}

impl Worst {
    /// Considers the next frames.
    fn consider(&mut self, sines: &[f32]) {
        // None is negative, so they are in the order of their bits. Compilers vectorise maxima of
        // integers, and comparisons of a number of elements that they know.
        let greatest = sines.iter().fold(0, |most, sine| most.max(sine.to_bits() as i32)) as u32;
        if greatest > self.sin_squared.to_bits() {
            let is_greatest = |sine: &f32| sine.to_bits() == greatest;
            let (blocks, _) = sines.as_chunks::<16>();
            let before = blocks
                .iter()
                .position(|block| block.iter().fold(false, |found, sine| found | is_greatest(sine)))
                .unwrap_or(blocks.len());
            let rest = sines.get(16 * before..).unwrap_or_default();
            self.sin_squared = f32::from_bits(greatest);
            self.index = self.count + 16 * before + rest.iter().position(is_greatest).unwrap_or(0);
        }
        self.count += sines.len();
    }
}

#[inline(always)]
pub(super) fn encode<F: FrameFormula, C: FrameCodes, const PRECISE: bool>(
    formula: F,
    frames: (Vectors<'_, 3>, Vectors<'_, 4>),
    codes: CodesMut<'_>,
) -> Skew {
    let mut worst = Worst::default();
    layout::encode_in_parts(frames, codes, &mut |frames, codes, [sines]| {
        let kernel = Encode::<F, PRECISE>(formula);
        let output = (codes, [&mut *sines]);
        map::<Frames, (CodeColumn<C>, Columns<1>)>(kernel, frames, output);
        worst.consider(sines);
    });
    Skew { degrees: skew_degrees(worst.sin_squared), index: worst.index }
}

#[inline(never)]
fn decode_columns<F: FrameFormula, C: FrameCodes>(
    formula: F,
    codes: CodeSlice<'_>,
    frames: <Frames as Output>::Slices<'_>,
    fence: &Fence,
) {
    run::<CodeColumn<C>, Frames>(Decode(formula), codes, frames, fence);
}

#[inline(always)]
pub(super) fn decode<'a, F: FrameFormula, C: FrameCodes, W: Write<'a, Kind = Frames>>(
    formula: F,
    codes: Codes<'_>,
    frames: W,
) {
    layout::decode(codes, frames, &mut |codes, frames, fence| {
        decode_columns::<F, C>(formula, codes, frames, fence);
    });
}

/// Encodes frames to where they lie. Returns the greatest skew.
#[inline(never)]
pub(super) fn encode_within(
    within: Within<'_, 2>,
    encode: &dyn Fn((Vectors<'_, 3>, Vectors<'_, 4>), CodesMut<'_>) -> Skew,
) -> Skew {
    let stride = within.stride;
    let mut worst = Skew { degrees: 0.0, index: 0 };
    let mut count = 0;
    layout::encode_fields_within(within, &mut |[normals, tangents], codes| {
        let len = codes.len();
        let normals = Vectors::Rows { bytes: normals, stride };
        let skew = encode((normals, Vectors::Rows { bytes: tangents, stride }), codes);
        if skew.degrees > worst.degrees {
            worst = Skew { index: count + skew.index, ..skew };
        }
        count += len;
    });
    worst
}

/// Decodes frames to where they lie.
#[inline(never)]
pub(super) fn decode_within(within: Within<'_, 2>, decode: &dyn Fn(Codes<'_>, PairMut<'_>)) {
    let (stride, at) = (within.stride, within.vectors);
    layout::decode_fields_within(within, &mut |codes, bytes| {
        decode(codes, PairMut { bytes, stride, at });
    });
}
