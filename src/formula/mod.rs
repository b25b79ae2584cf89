//! The mathematics: a file a family. [`Formula`] is the trait that every family implements.

#[cfg(feature = "xyz")]
pub(crate) mod cartesian;
pub(crate) mod circle;
#[cfg(feature = "cube")]
pub(crate) mod cube;
#[cfg(feature = "disk")]
pub(crate) mod disk;
#[cfg(feature = "fibonacci")]
pub(crate) mod fibonacci;
#[cfg(feature = "frontoct")]
pub(crate) mod front_oct;
#[cfg(feature = "hemioct")]
pub(crate) mod hemi_oct;
#[cfg(feature = "icosphere")]
pub(crate) mod icosphere;
#[cfg(feature = "latlong")]
pub(crate) mod latlong;
pub(crate) mod names;
#[cfg(feature = "oct")]
pub(crate) mod oct;
#[cfg(feature = "octant")]
pub(crate) mod octant;
pub(crate) mod octant_table;
#[cfg(feature = "phi-z")]
pub(crate) mod phi_z;
#[cfg(feature = "theta-phi")]
pub(crate) mod spherical;
pub(crate) mod support;
#[cfg(test)]
pub(crate) mod testing;
#[cfg(feature = "xyonly")]
pub(crate) mod xy_only;

use crate::batch::columns::{CodeColumn, Columns};
use crate::batch::storage::{CodeKind, CodeShape, CodeSlice, CodeSliceMut, ShapeIn, Word};
use crate::batch::{Kernel, map, run};
use crate::simd::stream::Fence;
use crate::simd::{Simd, Use, Vec3};
use support::sanitize::sanitize;
use support::sign::mirror_vector;

/// A representation: what a code means, and how to get there, on any number of lanes.
///
/// A formula is a value: bits, steps and tables are its fields, given by the row of the table. A
/// single vector's functions are inlined and fold them; the kernels of batches load them.
pub(crate) trait Formula: Copy + Send + Sync + 'static {
    /// Number of words that hold a code in lanes: [`Word`] for up to 32 bits.
    type Shape: CodeShape;
    /// Whether only z >= 0 is represented. z < 0 is then taken as 0.
    const HEMISPHERE: bool = false;
    /// Whether codes are the vectors as they are, of any length.
    const KEEPS_LENGTH: bool = false;
    /// How much `encode_precise` of many vectors is used.
    const PRECISE_USE: Use = Use::Sometimes;
    /// Whether `encode` is `encode_precise`.
    const ONE_ENCODER: bool = false;

    /// Turns any input into a direction that `encode` understands: see [`sanitize`].
    #[inline(always)]
    fn prepare<V: Simd>(self, v: Vec3<V>) -> Vec3<V> {
        if Self::HEMISPHERE {
            sanitize(Vec3 { z: V::select(v.z.lt(0.0), 0.0, v.z), ..v })
        } else {
            sanitize(v)
        }
    }

    /// The fast encoder: rounds each parameter to nearest, ties to even. Gives canonical codes.
    fn encode<V: Simd>(self, v: Vec3<V>) -> Code<Self, V>;

    /// The code whose decoded vector is closest to `v`, canonical.
    #[inline(always)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> Code<Self, V> {
        self.encode(v)
    }

    /// Total: a unit vector for every bit pattern. Bits above the code's width are ignored.
    fn decode<V: Simd>(self, code: Code<Self, V>) -> Vec3<V>;

    /// The code that `encode_precise` gives for the decoded vector with some components negated.
    /// Without any, the canonical code.
    fn mirror<V: Simd>(self, code: Code<Self, V>, flips: [bool; 3]) -> Code<Self, V>;

    /// [`mirror`](Formula::mirror) by its definition, for mirror images that are no points.
    #[inline(always)]
    fn mirror_decoded<V: Simd>(self, code: Code<Self, V>, flips: [bool; 3]) -> Code<Self, V> {
        let mirrored = mirror_vector(self.decode::<V>(code), flips);
        self.encode_precise(self.prepare(mirrored))
    }
}

/// A code of the formula `F` in lanes.
pub(crate) type Code<F, V> = ShapeIn<<F as Formula>::Shape, V>;

/// A formula whose decoder is the same, bit for bit, in all octants: mirroring a code mirrors its
/// vector. A hemisphere's formula is so in its four. It has an inherent `points_per_octant`.
pub(crate) trait Symmetric: Formula<Shape = Word> {
    /// Number of a code's point in its octant, below `points_per_octant`, and which components of that
    /// point to negate. Each number has a code of which none is.
    fn octant_index<V: Simd>(self, code: V::Int) -> (V::Int, Vec3<V::Mask>);
}

/// A formula whose points form a lattice of triangles with straight edges.
pub(crate) trait Lattice: Formula<Shape = Word> {
    /// One of the points around `v`, so that the mean over all `t` from 0 to 1 has the direction of
    /// `v`.
    fn encode_stochastic<V: Simd>(self, v: Vec3<V>, t: V) -> V::Int;
}

/// Where a kernel has its formula from: a value at run time, or a constant that is folded into it.
pub(crate) trait Source: Copy {
    type Formula: Formula;
    fn formula(self) -> Self::Formula;
}

impl<F: Formula> Source for F {
    type Formula = F;
    #[inline(always)]
    fn formula(self) -> F {
        self
    }
}

/// [`Formula::encode`] or [`Formula::encode_precise`].
#[derive(Clone, Copy)]
pub(crate) struct Encode<S, const PRECISE: bool>(pub(crate) S);
/// [`Formula::decode`].
#[derive(Clone, Copy)]
pub(crate) struct Decode<S>(pub(crate) S);
/// [`Formula::mirror`].
#[derive(Clone, Copy)]
pub(crate) struct Mirror<S>(pub(crate) S, pub(crate) [bool; 3]);

impl<S: Source, K, const PRECISE: bool> Kernel<Columns<3>, CodeColumn<K>> for Encode<S, PRECISE>
where
    K: CodeKind<Shape = <S::Formula as Formula>::Shape>,
{
    const USE: Use = if PRECISE { S::Formula::PRECISE_USE } else { Use::Often };

    #[inline(always)]
    fn run<V: Simd>(self, v: [V; 3]) -> Code<S::Formula, V> {
        let formula = self.0.formula();
        let v = formula.prepare(v.into());
        if PRECISE { formula.encode_precise(v) } else { formula.encode(v) }
    }
}

impl<S: Source, K> Kernel<CodeColumn<K>, Columns<3>> for Decode<S>
where
    K: CodeKind<Shape = <S::Formula as Formula>::Shape>,
{
    #[inline(always)]
    fn run<V: Simd>(self, code: Code<S::Formula, V>) -> [V; 3] {
        self.0.formula().decode::<V>(code).to_array()
    }
}

impl<S: Source, K> Kernel<CodeColumn<K>, CodeColumn<K>> for Mirror<S>
where
    K: CodeKind<Shape = <S::Formula as Formula>::Shape>,
{
    // The least used of the kernels would be half of what all of them cost to compile.
    const USE: Use = Use::Rare;

    #[inline(always)]
    fn run<V: Simd>(self, code: Code<S::Formula, V>) -> Code<S::Formula, V> {
        self.0.formula().mirror::<V>(code, self.1)
    }
}

/// The kernels of a formula, or of one codec, over columns. The functions are neither generic nor
/// inlined, so that they are compiled here, once, and not in the crates that call them.
pub(crate) trait Kernels: Sync + 'static {
    fn encode(&self, v: [&[f32]; 3], codes: CodeSliceMut<'_>);
    fn encode_precise(&self, v: [&[f32]; 3], codes: CodeSliceMut<'_>);
    /// Whoever makes the fence drops it before others may read the vectors.
    fn decode(&self, codes: CodeSlice<'_>, v: [&mut [f32]; 3], fence: &Fence);
    fn mirror(&self, from: CodeSlice<'_>, to: CodeSliceMut<'_>, flips: [bool; 3]);
}

/// Implements [`Kernels`] by the kind of the codes: `Words`, or bytes. A second formula does what
/// few need, so that it is not compiled twice.
macro_rules! kernels {
    ($($source:ty: $codes:ty $(, $formula:expr)?);* $(;)?) => { $(
        const _: () = {
            use $crate::batch::storage::{CodeSlice, CodeSliceMut};
            use $crate::formula::Kernels;
            use $crate::simd::stream::Fence;

            impl Kernels for $source {
                #[inline(never)]
                fn encode(&self, v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
                    $crate::formula::encode::<_, $codes, false>(*self, v, codes);
                }
                #[inline(never)]
                fn decode(&self, codes: CodeSlice<'_>, v: [&mut [f32]; 3], fence: &Fence) {
                    $crate::formula::decode::<_, $codes>(*self, codes, v, fence);
                }
                kernels!(@rare $codes $(, $formula)?);
            }
        };
    )* };
    (@rare $codes:ty) => {
        #[inline(never)]
        fn encode_precise(&self, v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
            $crate::formula::encode::<_, $codes, true>(*self, v, codes);
        }
        #[inline(never)]
        fn mirror(&self, from: CodeSlice<'_>, to: CodeSliceMut<'_>, flips: [bool; 3]) {
            $crate::formula::mirror::<_, $codes>(*self, from, to, flips);
        }
    };
    (@rare $codes:ty, $formula:expr) => {
        #[inline]
        fn encode_precise(&self, v: [&[f32]; 3], codes: CodeSliceMut<'_>) {
            Kernels::encode_precise(&$formula, v, codes);
        }
        #[inline]
        fn mirror(&self, from: CodeSlice<'_>, to: CodeSliceMut<'_>, flips: [bool; 3]) {
            Kernels::mirror(&$formula, from, to, flips);
        }
    };
}
pub(crate) use kernels;

#[inline]
pub(crate) fn encode<S: Source, K, const PRECISE: bool>(
    source: S,
    v: [&[f32]; 3],
    codes: CodeSliceMut<'_>,
) where
    K: CodeKind<Shape = <S::Formula as Formula>::Shape>,
{
    if const { PRECISE && S::Formula::ONE_ENCODER } {
        return encode::<S, K, false>(source, v, codes);
    }
    map::<Columns<3>, CodeColumn<K>>(Encode::<S, PRECISE>(source), v, codes);
}

#[inline(always)]
pub(crate) fn decode<S: Source, K>(
    source: S,
    codes: CodeSlice<'_>,
    v: [&mut [f32]; 3],
    fence: &Fence,
) where
    K: CodeKind<Shape = <S::Formula as Formula>::Shape>,
{
    run::<CodeColumn<K>, Columns<3>>(Decode(source), codes, v, fence);
}

#[inline(always)]
pub(crate) fn mirror<S: Source, K>(
    source: S,
    from: CodeSlice<'_>,
    to: CodeSliceMut<'_>,
    flips: [bool; 3],
) where
    K: CodeKind<Shape = <S::Formula as Formula>::Shape>,
{
    map::<CodeColumn<K>, CodeColumn<K>>(Mirror(source, flips), from, to);
}
