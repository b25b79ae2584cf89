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
pub(crate) trait Kernel<'a, I: Input, O: Output<'a>> {
    /// See [`BatchLoop::USE_WIDE`].
    const USE_WIDE: bool = true;
    /// See [`BatchLoop::USE_AVX512`].
    const USE_AVX512: bool = true;

    fn run<V: Simd>(&self, input: I::In<V>) -> O::In<V>;
}

/// Runs `kernel` over all blocks. Whoever makes the fence drops it before others may read the output.
#[inline(always)]
pub(crate) fn run<'a, I: Input, O: Output<'a>>(
    kernel: impl Kernel<'a, I, O>,
    input: I,
    output: O,
    fence: &Fence<'a>,
) {
    dispatch(Loop { kernel, input, output, fence });
}

/// [`run`] without streaming.
#[inline(always)]
pub(crate) fn map<'a, I: Input, O: Output<'a>>(kernel: impl Kernel<'a, I, O>, input: I, output: O) {
    run(kernel, input, output, &Fence::new(false));
}

struct Loop<'f, 'a, K, I, O> {
    kernel: K,
    input: I,
    output: O,
    fence: &'f Fence<'a>,
}

impl<'a, K: Kernel<'a, I, O>, I: Input, O: Output<'a>> BatchLoop for Loop<'_, 'a, K, I, O> {
    const USE_WIDE: bool = K::USE_WIDE;
    const USE_AVX512: bool = K::USE_AVX512;

    // One call of the kernel serves whole blocks and the remainder, so that it is compiled once.
    #[inline(always)]
    fn run<V: Simd>(self) {
        let Loop { kernel, input, output, fence } = self;
        let (mut blocks, rest) = input.split::<V>();
        let (mut output_blocks, output_rest) = output.split::<V>();
        loop {
            let block = I::load::<V>(&mut blocks);
            let is_whole = block.is_some();
            let rest = if is_whole || V::LANES == 1 { None } else { rest.load_rest::<V>() };
            let Some(block) = block.or(rest) else { return };
            let value = kernel.run::<V>(block);
            if !is_whole {
                return output_rest.store_rest::<V>(value);
            }
            O::store::<V>(&mut output_blocks, value, fence);
        }
    }
}
