//! The kernels of frame codecs, in any layout.

use crate::batch::columns::{CodeColumn, Columns, Input, Output};
use crate::batch::layout::{Codes, CodesMut, FEW, MANY, PART, Vectors, VectorsMut};
use crate::batch::storage::{CodeIn, CodeSlice, CodeSliceMut};
use crate::batch::{Kernel, map};
use crate::simd::{Simd, Use, Vec3};

use super::Skew;
use super::formula::{FrameBytes, FrameFormula, Prepared, skew_degrees};

/// The kernels of a codec, compiled here: see [`Kernels`](crate::formula::Kernels). Tangents have the
/// handedness as their fourth component.
pub trait FrameKernels {
    /// [`FrameCodec::encode_soa`](super::FrameCodec::encode_soa) and the like.
    fn encode_batch(normals: Vectors<'_, 3>, tangents: Vectors<'_, 4>, codes: CodesMut<'_>)
    -> Skew;
    /// [`FrameCodec::encode_soa_precise`](super::FrameCodec::encode_soa_precise) and the like.
    fn encode_batch_precise(
        normals: Vectors<'_, 3>,
        tangents: Vectors<'_, 4>,
        codes: CodesMut<'_>,
    ) -> Skew;
    /// [`FrameCodec::decode_soa`](super::FrameCodec::decode_soa) and the like.
    fn decode_batch(codes: Codes<'_>, normals: VectorsMut<'_, 3>, tangents: VectorsMut<'_, 4>);
}

/// [`FrameFormula::encode`], and the squared sines of the skew.
#[derive(Clone, Copy)]
struct Encode<F, const PRECISE: bool>(F);
/// [`FrameFormula::decode`].
#[derive(Clone, Copy)]
struct Decode<F>(F);

/// Normals and tangents.
type Frames = (Columns<3>, Columns<4>);
type FrameSlices<'a> = <Frames as Input>::Slices<'a>;
type FrameSlicesMut<'a> = <Frames as Output>::Slices<'a>;

impl<F: FrameFormula, B: FrameBytes, const PRECISE: bool>
    Kernel<Frames, (CodeColumn<B>, Columns<1>)> for Encode<F, PRECISE>
{
    const USE: Use = if PRECISE { Use::Sometimes } else { Use::Often };

    #[inline(always)]
    fn run<V: Simd>(
        self,
        ([nx, ny, nz], [tx, ty, tz, handedness]): ([V; 3], [V; 4]),
    ) -> (CodeIn<B, V>, [V; 1]) {
        let frame = Prepared::new(Vec3::new(nx, ny, nz), Vec3::new(tx, ty, tz), handedness);
        let sin_squared = frame.sin_squared;
        (B::from_words::<V>(self.0.encode::<V, PRECISE>(frame)), [sin_squared])
    }
}

impl<F: FrameFormula, B: FrameBytes> Kernel<CodeColumn<B>, Frames> for Decode<F> {
    #[inline(always)]
    fn run<V: Simd>(self, code: CodeIn<B, V>) -> ([V; 3], [V; 4]) {
        let frame = self.0.decode::<V>(B::to_words::<V>(code));
        let Vec3 { x, y, z } = frame.tangent;
        (frame.normal.to_array(), [x, y, z, frame.handedness])
    }
}

/// The most skewed frame so far.
#[derive(Default)]
struct Worst {
    sin_squared: f32,
    index: usize,
}

impl Worst {
    /// Considers frames from the one with the index `first` on.
    fn consider(&mut self, first: usize, sines: &[f32]) {
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
            self.index = first + 16 * before + rest.iter().position(is_greatest).unwrap_or(0);
        }
    }
}

#[inline(always)]
pub(super) fn encode<F: FrameFormula, const N: usize, const PRECISE: bool>(
    formula: F,
    normals: Vectors<'_, 3>,
    tangents: Vectors<'_, 4>,
    codes: CodesMut<'_>,
) -> Skew
where
    [u8; N]: FrameBytes,
{
    encode_any(normals, tangents, codes, &|frames, codes, sines| {
        let output = (codes, [sines]);
        map::<Frames, (CodeColumn<[u8; N]>, Columns<1>)>(
            Encode::<F, PRECISE>(formula),
            frames,
            output,
        );
    })
}

/// What encodes columns.
type EncodeKernel<'k> = &'k dyn Fn(FrameSlices<'_>, CodeSliceMut<'_>, &mut [f32]);

/// Columns need no room for their parts, so these can be large.
#[inline(never)]
fn encode_any(
    normals: Vectors<'_, 3>,
    tangents: Vectors<'_, 4>,
    codes: CodesMut<'_>,
    kernel: EncodeKernel<'_>,
) -> Skew {
    match (normals, tangents) {
        (Vectors::Columns(_), Vectors::Columns(_)) if codes.len() > FEW => {
            encode_parts::<MANY, 0>(normals, tangents, codes, kernel)
        }
        _ if codes.len() > FEW => encode_parts::<PART, PART>(normals, tangents, codes, kernel),
        _ => encode_parts::<FEW, FEW>(normals, tangents, codes, kernel),
    }
}

#[inline(never)]
fn encode_parts<const PART: usize, const ROWS: usize>(
    normals: Vectors<'_, 3>,
    tangents: Vectors<'_, 4>,
    codes: CodesMut<'_>,
    kernel: EncodeKernel<'_>,
) -> Skew {
    let (mut normal_buffer, mut tangent_buffer) = ([[0.0; ROWS]; 3], [[0.0; ROWS]; 4]);
    let mut sines = [0.0; PART];
    let mut worst = Worst::default();
    let mut first = 0;
    for codes in codes.parts(PART) {
        let len = codes.len();
        let normals = normals.part(first, len, &mut normal_buffer);
        let tangents = tangents.part(first, len, &mut tangent_buffer);
        if let Some(sines) = sines.get_mut(..len) {
            codes.write(|codes| kernel((normals, tangents), codes, sines));
            worst.consider(first, sines);
        }
        first += len;
    }
    Skew { degrees: skew_degrees(worst.sin_squared), index: worst.index }
}

#[inline(always)]
pub(super) fn decode<F: FrameFormula, const N: usize>(
    formula: F,
    codes: Codes<'_>,
    normals: VectorsMut<'_, 3>,
    tangents: VectorsMut<'_, 4>,
) where
    [u8; N]: FrameBytes,
{
    decode_any(codes, normals, tangents, &|codes, frames| {
        map::<CodeColumn<[u8; N]>, Frames>(Decode(formula), codes, frames);
    });
}

/// What decodes to columns.
type DecodeKernel<'k> = &'k dyn Fn(CodeSlice<'_>, FrameSlicesMut<'_>);

#[inline(never)]
fn decode_any(
    codes: Codes<'_>,
    normals: VectorsMut<'_, 3>,
    tangents: VectorsMut<'_, 4>,
    kernel: DecodeKernel<'_>,
) {
    match (normals, tangents) {
        (VectorsMut::Columns(normals), VectorsMut::Columns(tangents)) if codes.is_direct() => {
            codes.read(|codes| kernel(codes, (normals, tangents)));
        }
        (normals, tangents) => decode_parts(codes, normals, tangents, kernel),
    }
}

#[inline(never)]
fn decode_parts(
    codes: Codes<'_>,
    mut normals: VectorsMut<'_, 3>,
    mut tangents: VectorsMut<'_, 4>,
    kernel: DecodeKernel<'_>,
) {
    let (mut normal_buffer, mut tangent_buffer) = ([[0.0; PART]; 3], [[0.0; PART]; 4]);
    for codes in codes.parts(PART) {
        let (normals_part, tangents_part);
        (normals_part, normals) = normals.split_at(codes.len());
        (tangents_part, tangents) = tangents.split_at(codes.len());
        normals_part.write(&mut normal_buffer, |normals| {
            tangents_part.write(&mut tangent_buffer, |tangents| {
                codes.read(|codes| kernel(codes, (normals, tangents)));
            });
        });
    }
}
