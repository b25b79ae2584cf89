//! Lat-long: points on parallels, counted from the north pole to the south.
//!
//! ```text
//! latlong    N = 2^(BITS/2) - 1 parallels at theta = j pi / (N - 1), N points on each at phi = 2 pi k / N;  index = j N + k
//! latlongD   F parallels at theta = j pi / (F - 1), the j-th with as many points as keep every direction within e degrees;
//!            index = points on earlier parallels + k
//! ```
//!
//! latlongD has so many points on each parallel that its cells are about as wide as high; F
//! minimises the total for a given e, and e is the least with which all points fit into BITS bits:
//! 227, 3 629 and 58 073 parallels with 65 536, 16 777 216 and 4 294 967 295 points. A table of 4
//! bytes a parallel (1, 15 and 232 KB) holds where each begins. Decoding guesses the parallel from
//! the index, as the area of a cap, and is right or off by one.
//!
//! Codes are indices, little-endian in 24 bits. Canonical: a pole is point 0 of its parallel;
//! indices beyond the last point read as the south pole. Of the axes, +-Z and +X survive exactly,
//! and -X in latlong16D and 24D, whose equator has an even number of points.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//! 2014; optimal spacing after Smith and Petrova, "Fast Indexing of Spherical Points", 2012.

use core::marker::PhantomData;

use crate::formula::bits::unorm_max;
use crate::formula::{Closest, Formula, One, around, mirror_decoded, negate_if};
use crate::simd::math::{atan2_half_turns, sin_cos_quarter_turns, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, inlined};

/// Lat-long on the parallels `P`.
pub(crate) struct LatLong<P>(PhantomData<P>);

/// `BITS` bits, as many points on every parallel.
pub(crate) struct Even<const BITS: u32>;

/// `BITS` bits, fewer points towards the poles.
pub(crate) struct Spaced<const BITS: u32>;

/// Parallels at equal distances, from pole to pole, with points on them.
pub(crate) trait Parallels: 'static {
    /// The south pole's, if the north pole's is 0.
    const LAST: i32;
    /// The index of a parallel's first point, and how many it has; the poles have one.
    fn band<V: Simd>(parallel: V::Int) -> (V::Int, V::Int);
    /// Of an index the parallel, the point on it, and how many that has. What is beyond the last
    /// point is on the last parallel.
    fn find<V: Simd>(index: V::Int) -> [V::Int; 3];
}

/// Polar angle and azimuth in half turns, the azimuth from 0 to 2.
#[inline(always)]
fn angles<V: Simd>([x, y, z]: [V; 3]) -> [V; 2] {
    let theta = atan2_half_turns(sqrt(x * x + y * y), z);
    let phi = atan2_half_turns(y, x);
    [theta, V::select(phi.lt(V::zero()), phi + V::splat(2.0), phi)]
}

/// Point `k` modulo `count`, from -count to count.
#[inline(always)]
fn wrap<V: Simd>(k: V::Int, count: V::Int) -> V::Int {
    let k = V::Int::select(k.lt(V::Int::splat(0)), k + count, k);
    V::Int::select(k.lt(count), k, V::Int::splat(0))
}

impl<P: Parallels> LatLong<P> {
    /// Point `k` of `count` on a parallel.
    #[inline(always)]
    fn point<V: Simd>(parallel: V::Int, k: V::Int, count: V::Int) -> [V; 3] {
        // In quarter turns.
        let theta = V::from_int(parallel) / V::splat(0.5 * P::LAST as f32);
        // From -2 to 2: beyond half a turn a bit would be lost.
        let k = V::Int::select(count.lt(k + k), k - count, k);
        let phi = V::from_int(k.shl(2)) / V::from_int(count);
        let (sin_theta, cos_theta) = sin_cos_quarter_turns(theta);
        let (sin_phi, cos_phi) = sin_cos_quarter_turns(phi);
        [sin_theta * cos_phi, sin_theta * sin_phi, cos_theta]
    }
}

impl<P: Parallels> Formula for LatLong<P> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        let [theta, phi] = angles(v);
        let (begin, count) = P::band::<V>((theta * V::splat(P::LAST as f32)).round_int());
        begin + wrap::<V>((phi * V::splat(0.5) * V::from_int(count)).round_int(), count)
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(v: [V; 3]) -> V::Int {
        V::compiled_for(
            #[inline(always)]
            || {
                let [theta, phi] = angles(v);
                let (zero, last) = (V::Int::splat(0), V::Int::splat(P::LAST));
                let mut closest = Closest::to(v);
                for parallel in around(theta * V::splat(P::LAST as f32)) {
                    let parallel = parallel.max(zero).min(last);
                    let (begin, count) = P::band::<V>(parallel);
                    for k in around(phi * V::splat(0.5) * V::from_int(count)) {
                        let k = wrap::<V>(k, count);
                        closest.consider(begin + k, Self::point(parallel, k, count));
                    }
                }
                closest.code()
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        let [parallel, k, count] = P::find::<V>(code);
        Self::point(parallel, wrap::<V>(k, count), count)
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        let [parallel, k, count] = P::find::<V>(code);
        P::band::<V>(parallel).0 + wrap::<V>(k, count)
    }

    #[inline(always)]
    fn mirror<V: Simd>(code: V::Int, flips: [bool; 3]) -> V::Int {
        let [x, y, z] = flips;
        let [parallel, k, count] = P::find::<V>(code);
        let k = wrap::<V>(negate_if(wrap::<V>(k, count), y), count);
        let opposite = wrap::<V>(count.shr(1) - k, count);
        let parallel = if z { V::Int::splat(P::LAST) - parallel } else { parallel };
        let (begin, there) = P::band::<V>(parallel);
        let mirrored = begin + if x { opposite } else { k };
        // Off the poles, half a turn of an odd number of points ends between two.
        let one = V::Int::splat(1);
        let between = one.lt(count) & one.lt(count.low(1) + V::Int::splat(i32::from(x)));
        let missing = between | !there.eq(count);
        if !missing.any() {
            return mirrored;
        }
        V::Int::select(missing, mirror_decoded::<Self, V>(code, flips), mirrored)
    }
}

impl<const BITS: u32> Even<BITS> {
    const N: i32 = unorm_max(BITS / 2);
}

impl<const BITS: u32> Parallels for Even<BITS> {
    const LAST: i32 = Self::N - 1;

    #[inline(always)]
    fn band<V: Simd>(parallel: V::Int) -> (V::Int, V::Int) {
        let inner = V::Int::splat(0).lt(parallel) & parallel.lt(V::Int::splat(Self::LAST));
        let n = V::Int::splat(Self::N);
        (parallel * n, V::Int::select(inner, n, V::Int::splat(1)))
    }

    #[inline(always)]
    fn find<V: Simd>(index: V::Int) -> [V::Int; 3] {
        // index = high 2^h + low = high N + (high + low), with N = 2^h - 1.
        let half = BITS / 2;
        let n = V::Int::splat(Self::N);
        let (high, low) = (index.low(BITS).shr(half), index.low(half));
        let k = high + low;
        let carry = !k.lt(n);
        let parallel = V::Int::select(carry, high + V::Int::splat(1), high);
        let parallel = parallel.min(V::Int::splat(Self::LAST));
        [parallel, V::Int::select(carry, k - n, k), Self::band::<V>(parallel).1]
    }
}

/// Where each parallel begins, with that of the one before the first, 0, and, twice, how many points
/// there are.
pub(crate) trait Table: 'static {
    const BEGINS: &'static [u32];
}

include!(concat!(env!("OUT_DIR"), "/latlong_bands.rs"));

impl<const BITS: u32> Parallels for Spaced<BITS>
where
    Self: Table,
{
    const LAST: i32 = Self::BEGINS.len() as i32 - 4;

    #[inline(always)]
    fn band<V: Simd>(parallel: V::Int) -> (V::Int, V::Int) {
        let [_, begin, end, _] = V::gather4(Self::BEGINS, parallel);
        (begin, end - begin)
    }

    #[inline(always)]
    fn find<V: Simd>(index: V::Int) -> [V::Int; 3] {
        let index = index.low(BITS);
        // The cap above the point, or below if that is smaller, has the area share (1 - cos theta) / 2 =
        // sin^2(theta / 2) = t; theta = 2 asin sqrt t.
        let total = const { Self::BEGINS[Self::BEGINS.len() - 1] };
        let (middle, last) = (V::Int::splat((total / 2) as i32), V::Int::splat((total - 1) as i32));
        let south = middle.below(index);
        let beyond = last.below(index);
        let points = V::Int::select(south, last - index, index);
        let points = V::from_int(V::Int::select(beyond, V::Int::splat(0), points));
        let t = (points + V::splat(0.5)) * V::splat((1.0 / total as f64) as f32);
        let asin = sqrt(t)
            * (V::splat(1.000_004_5)
                + t * (V::splat(0.166_218_98)
                    + t * (V::splat(0.081_858_44)
                        + t * (V::splat(0.009_758_449) + t * V::splat(0.094_634_07)))));
        let pole = V::splat(Self::LAST as f32);
        let from_pole = asin * V::splat(Self::LAST as f32 * core::f32::consts::FRAC_2_PI);
        let guess = V::select(south, pole - from_pole, from_pole).round_int();
        // One off at most.
        let [before, begin, end, after] = V::gather4(Self::BEGINS, guess);
        let early = index.below(begin);
        let late = !index.below(end) & guess.lt(V::Int::splat(Self::LAST));
        let pick = inlined(
            #[inline(always)]
            |at, before, after| V::Int::select(early, before, V::Int::select(late, after, at)),
        );
        let one = V::Int::splat(1);
        let parallel = pick(guess, guess - one, guess + one);
        let (begin, end) = (pick(begin, before, end), pick(end, begin, after));
        let count = end - begin;
        [parallel, index - begin, count]
    }
}
