//! Decoding by a table of one octant.

use super::Symmetric;
use crate::batch::columns::{CodeColumn, Columns};
use crate::batch::layout::{self, Codes, VectorsMut};
use crate::batch::storage::Words;
use crate::batch::{Kernel, run};
use crate::simd::{I32x1, Simd, Use, Vec3};

/// A code's vector, from a table of its octant.
#[derive(Clone, Copy)]
pub(crate) struct Mirrored<'t, F>(pub(crate) F, pub(crate) &'t [[f32; 3]]);

impl<F: Symmetric> Mirrored<'_, F> {
    #[inline(always)]
    pub(crate) fn decode<V: Simd>(&self, code: V::Int) -> Vec3<V> {
        let (index, flips) = self.0.octant_index::<V>(code);
        let Vec3 { x, y, z } = Vec3::from(V::gather3(self.1, index));
        Vec3::new(V::select(flips.x, -x, x), V::select(flips.y, -y, y), V::select(flips.z, -z, z))
    }
}

impl<F: Symmetric> Kernel<CodeColumn<Words>, Columns<3>> for Mirrored<'_, F> {
    // Most of the time goes into loads of single elements.
    const USE: Use = Use::Rare;

    #[inline(always)]
    fn run<V: Simd>(self, code: V::Int) -> [V; 3] {
        self.decode::<V>(code).to_array()
    }
}

/// Tables of a formula, compiled here: see [`Kernels`](super::Kernels).
pub(crate) trait OctantKernels {
    /// Writes the vectors of an octant, those of all codes of `bits` bits of which nothing is negated.
    fn fill(&self, bits: u32, octant: &mut [[f32; 3]]);
    /// Decodes by a table.
    fn look_up(&self, octant: &[[f32; 3]], codes: Codes<'_>, vectors: VectorsMut<'_, 3>);
}

/// Implements [`OctantKernels`].
macro_rules! octant_kernels {
    ($($formula:ty),* $(,)?) => { $(
        const _: () = {
            use $crate::batch::layout::{Codes, VectorsMut};
            use $crate::formula::octant_table::{self, OctantKernels};

            impl OctantKernels for $formula {
                #[inline(never)]
                fn fill(&self, bits: u32, octant: &mut [[f32; 3]]) {
                    octant_table::fill(*self, bits, octant);
                }
                #[inline(never)]
                fn look_up(
                    &self,
                    octant: &[[f32; 3]],
                    codes: Codes<'_>,
                    vectors: VectorsMut<'_, 3>,
                ) {
                    octant_table::look_up(*self, octant, codes, vectors);
                }
            }
        };
    )* };
}
pub(crate) use octant_kernels;

#[inline(always)]
pub(crate) fn fill<F: Symmetric>(formula: F, bits: u32, octant: &mut [[f32; 3]]) {
    for code in 0..1 << bits {
        let (index, Vec3 { x, y, z }) = formula.octant_index::<f32>(I32x1(code));
        let is_negated = x | y | z;
        if let Some(v) = octant.get_mut(index.0 as u32 as usize)
            && !is_negated
        {
            *v = formula.decode::<f32>(I32x1(code)).to_array();
        }
    }
}

#[inline(always)]
pub(crate) fn look_up<F: Symmetric>(
    formula: F,
    octant: &[[f32; 3]],
    codes: Codes<'_>,
    vectors: VectorsMut<'_, 3>,
) {
    layout::decode(codes, vectors, &mut |codes, v, fence| {
        run::<CodeColumn<Words>, Columns<3>>(Mirrored(formula, octant), codes, v, fence);
    });
}
