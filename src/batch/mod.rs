//! Batch loops: whole SIMD blocks, then the remainder as one padded block, with the same formula.
//!
//! A kernel reads and writes columns: components of vectors as slices of `f32`, and codes as
//! little-endian bytes. [`layout`] brings everything else into that form.

pub(crate) mod code_int;
mod codes;
pub(crate) mod columns;
pub(crate) mod doubles;
pub(crate) mod layout;
pub(crate) mod storage;

use crate::simd::dispatch::dispatch;
use crate::simd::stream::Fence;
use crate::simd::{BatchLoop, Simd, Use};
use columns::{Input, Output};

/// What a loop does with one block.
pub(crate) trait Kernel<I: Input, O: Output>: Copy {
    const USE: Use = Use::Often;

    fn run<V: Simd>(self, input: I::In<V>) -> O::In<V>;
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
    const USE: Use = K::USE;

    #[inline(always)]
    fn run<V: Simd>(self) {
        let Loop { kernel, input, output, streams } = self;
        run_padded::<I, O>(V::LANES, input, output, &|input, output, count| {
            V::with_target_features(
                #[inline(always)]
                move || {
                    let blocks = I::blocks::<V>(input, count);
                    let output_blocks = O::blocks::<V>(output, count);
                    let (Some(blocks), Some(mut output)) = (blocks, output_blocks) else { return };
                    for i in 0..count {
                        let Some(block) = I::load::<V>(blocks, i) else { return };
                        O::store::<V>(&mut output, i, kernel.run::<V>(block), streams);
                    }
                },
            );
        });
    }
}

/// A kernel over a number of whole blocks.
type BlocksKernel<'k, I, O> =
    &'k dyn Fn(<I as Input>::Slices<'_>, <O as Output>::Slices<'_>, usize);

/// Runs `kernel` over a number of whole blocks, and then over the remainder in a padded block. Not
/// generic over the kernel, so that all kernels between the same kinds of slices share it.
#[inline(never)]
fn run_padded<I: Input, O: Output>(
    lanes: usize,
    input: I::Slices<'_>,
    output: O::Slices<'_>,
    kernel: BlocksKernel<'_, I, O>,
) {
    let len = I::len(input);
    // A power of two, of which division would leave a check for zero.
    let rest_len = len & (lanes - 1);
    let Some((blocks, rest)) = I::split(input, len - rest_len) else { return };
    let Some((output_blocks, output_rest)) = O::split(output, len - rest_len) else { return };
    kernel(blocks, output_blocks, len >> lanes.trailing_zeros());
    if rest_len > 0 {
        let block = I::pad(rest, lanes);
        let mut output_block = O::pad(&output_rest);
        if let (Some(block), Some(output)) =
            (I::slices(&block, lanes), O::slices(&mut output_block, lanes))
        {
            kernel(block, output, 1);
        }
        O::cut(&output_block, output_rest);
    }
}
