//! The kernels of frame codecs, in any layout.

use crate::batch::layout::{Codes, CodesMut, PART, Vectors, VectorsMut};
use crate::batch::storage::CodeIn;
use crate::batch::{Kernel, map};
use crate::simd::{Simd, Vec3};

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
struct Encode<F, const PRECISE: bool>(F);
/// [`FrameFormula::decode`].
struct Decode<F>(F);

/// Normals and tangents.
type Frames<'a> = ([&'a [f32]; 3], [&'a [f32]; 4]);
/// Normals and tangents to write.
type FramesMut<'a> = ([&'a mut [f32]; 3], [&'a mut [f32]; 4]);

impl<'a, F: FrameFormula, B: FrameBytes, const PRECISE: bool>
    Kernel<'a, Frames<'_>, (&'a mut [B], [&'a mut [f32]; 1])> for Encode<F, PRECISE>
{
    #[inline(always)]
    fn run<V: Simd>(
        &self,
        ([nx, ny, nz], [tx, ty, tz, handedness]): ([V; 3], [V; 4]),
    ) -> (CodeIn<B, V>, [V; 1]) {
        let frame = Prepared::new(Vec3::new(nx, ny, nz), Vec3::new(tx, ty, tz), handedness);
        let sin_squared = frame.sin_squared;
        (B::from_words::<V>(self.0.encode::<V, PRECISE>(frame)), [sin_squared])
    }
}

impl<'a, F: FrameFormula, B: FrameBytes> Kernel<'a, &[B], FramesMut<'a>> for Decode<F> {
    #[inline(always)]
    fn run<V: Simd>(&self, code: CodeIn<B, V>) -> ([V; 3], [V; 4]) {
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
        // None is negative, so they are in the order of their bits, of which maxima vectorise.
        let greatest = sines.iter().map(|sin_squared| sin_squared.to_bits()).max().unwrap_or(0);
        if greatest > self.sin_squared.to_bits() {
            let place = sines.iter().position(|sin_squared| sin_squared.to_bits() == greatest);
            self.sin_squared = f32::from_bits(greatest);
            self.index = first + place.unwrap_or(0);
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
    let kernel = |frames: Frames<'_>, codes: &mut [u8], sines: &mut [f32]| {
        map(Encode::<F, PRECISE>(formula), frames, (codes.as_chunks_mut::<N>().0, [sines]));
    };
    encode_parts(&kernel, normals, tangents, codes)
}

#[inline(never)]
fn encode_parts(
    kernel: &dyn Fn(Frames<'_>, &mut [u8], &mut [f32]),
    normals: Vectors<'_, 3>,
    tangents: Vectors<'_, 4>,
    codes: CodesMut<'_>,
) -> Skew {
    let (mut normal_buffer, mut tangent_buffer) = ([[0.0; PART]; 3], [[0.0; PART]; 4]);
    let mut sines = [0.0; PART];
    let mut worst = Worst::default();
    let mut first = 0;
    for codes in codes.parts() {
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
    let kernel = |codes: &[u8], frames: FramesMut<'_>| {
        map(Decode(formula), codes.as_chunks::<N>().0, frames);
    };
    decode_parts(&kernel, codes, normals, tangents);
}

#[inline(never)]
fn decode_parts(
    kernel: &dyn Fn(&[u8], FramesMut<'_>),
    codes: Codes<'_>,
    mut normals: VectorsMut<'_, 3>,
    mut tangents: VectorsMut<'_, 4>,
) {
    let (mut normal_buffer, mut tangent_buffer) = ([[0.0; PART]; 3], [[0.0; PART]; 4]);
    for codes in codes.parts() {
        let (normals_part, tangents_part);
        (normals_part, normals) = normals.split_at(codes.len());
        (tangents_part, tangents) = tangents.split_at(codes.len());
        normals_part.write(&mut normal_buffer, |normals| {
            tangents_part.write(&mut tangent_buffer, |tangents| {
                codes.with_kernel_bytes(|bytes| kernel(bytes, (normals, tangents)));
            });
        });
    }
}
