//! Batch loops: whole SIMD blocks, then the remainder as one padded block, with the same formula.
//!
//! A kernel reads and writes columns: components of vectors as slices of `f32`, and codes as
//! little-endian bytes. [`layout`] brings everything else into that form.

pub(crate) mod code_int;
pub(crate) mod columns;
pub(crate) mod layout;
pub(crate) mod storage;

use crate::simd::Simd;
use crate::simd::dispatch::{BatchLoop, dispatch};
use crate::simd::stream::Fence;
use columns::{Input, Output};

/// What a loop does with one block.
pub(crate) trait Kernel<I: Input, O: Output> {
    /// See [`BatchLoop::USE_WIDE`].
    const USE_WIDE: bool = true;
    /// See [`BatchLoop::USE_AVX512`].
    const USE_AVX512: bool = true;

    fn run<V: Simd>(&self, input: I::In<V>) -> O::In<V>;
}

/// Runs `kernel` over all blocks. Whoever makes the fence drops it before others may read the output.
#[inline(always)]
pub(crate) fn run<I: Input, O: Output>(
    kernel: impl Kernel<I, O>,
    input: I::Slices<'_>,
    output: O::Slices<'_>,
    fence: &Fence,
) {
    dispatch(Loop::<_, I, O> { kernel, input, output, streams: fence.streams() });
}

/// [`run`] without streaming.
#[inline(always)]
pub(crate) fn map<I: Input, O: Output>(
    kernel: impl Kernel<I, O>,
    input: I::Slices<'_>,
    output: O::Slices<'_>,
) {
    run::<I, O>(kernel, input, output, &Fence::new(false));
}

struct Loop<'i, 'o, K, I: Input, O: Output> {
    kernel: K,
    input: I::Slices<'i>,
    output: O::Slices<'o>,
    streams: bool,
}

impl<K: Kernel<I, O>, I: Input, O: Output> BatchLoop for Loop<'_, '_, K, I, O> {
    const USE_WIDE: bool = K::USE_WIDE;
    const USE_AVX512: bool = K::USE_AVX512;

    #[inline(always)]
    fn run<V: Simd>(self) {
        let Loop { kernel, input, output, streams } = self;
        run_blocks::<V, I, O>(input, output, &|blocks, mut output, count| {
            V::with_target_features(
                #[inline(always)]
                || {
                    for i in 0..count {
                        let Some(block) = I::load::<V>(blocks, i) else { return };
                        O::store::<V>(&mut output, i, kernel.run::<V>(block), streams);
                    }
                },
            );
        });
    }
}

/// Runs `kernel` over the whole blocks, and then over the remainder in a padded block. Not generic
/// over the kernel, so that all kernels between the same kinds of slices share it.
#[inline(never)]
fn run_blocks<V: Simd, I: Input, O: Output>(
    input: I::Slices<'_>,
    output: O::Slices<'_>,
    kernel: &dyn Fn(I::Blocks<'_, V>, O::Blocks<'_, V>, usize),
) {
    let len = I::len(input);
    let count = len / V::LANES;
    let Some((blocks, rest)) = I::split::<V>(input, count) else { return };
    let Some((output_blocks, output_rest)) = O::split::<V>(output, count) else { return };
    kernel(blocks, output_blocks, count);
    if len % V::LANES > 0
        && let Some(block) = I::pad::<V>(rest)
    {
        let mut output_block = O::pad::<V>(&output_rest);
        kernel(I::as_blocks::<V>(&block), O::as_blocks::<V>(&mut output_block), 1);
        O::cut::<V>(&output_block, output_rest);
    }
}
