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

use crate::formula::{Closest, Formula, One, around, mirror_decoded, negate_if};
use crate::lane::{Lane, LaneInt, LaneMask, inlined};
use crate::layout::unorm_max;
use crate::math::{atan2_half_turns, sin_cos_quarter_turns, sqrt};

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
    fn band<L: Lane>(parallel: L::Int) -> (L::Int, L::Int);
    /// Of an index the parallel, the point on it, and how many that has. What is beyond the last
    /// point is on the last parallel.
    fn find<L: Lane>(index: L::Int) -> [L::Int; 3];
}

/// Polar angle and azimuth in half turns, the azimuth from 0 to 2.
#[inline(always)]
fn angles<L: Lane>([x, y, z]: [L; 3]) -> [L; 2] {
    let theta = atan2_half_turns(sqrt(x * x + y * y), z);
    let phi = atan2_half_turns(y, x);
    [theta, L::select(phi.lt(L::zero()), phi + L::splat(2.0), phi)]
}

/// Point `k` modulo `count`, from -count to count.
#[inline(always)]
fn wrap<L: Lane>(k: L::Int, count: L::Int) -> L::Int {
    let k = L::Int::select(k.lt(L::Int::splat(0)), k + count, k);
    L::Int::select(k.lt(count), k, L::Int::splat(0))
}

impl<P: Parallels> LatLong<P> {
    /// Point `k` of `count` on a parallel.
    #[inline(always)]
    fn point<L: Lane>(parallel: L::Int, k: L::Int, count: L::Int) -> [L; 3] {
        // In quarter turns.
        let theta = L::from_int(parallel) / L::splat(0.5 * P::LAST as f32);
        // From -2 to 2: beyond half a turn a bit would be lost.
        let k = L::Int::select(count.lt(k + k), k - count, k);
        let phi = L::from_int(k.shl(2)) / L::from_int(count);
        let (sin_theta, cos_theta) = sin_cos_quarter_turns(theta);
        let (sin_phi, cos_phi) = sin_cos_quarter_turns(phi);
        [sin_theta * cos_phi, sin_theta * sin_phi, cos_theta]
    }
}

impl<P: Parallels> Formula for LatLong<P> {
    type Words = One;

    #[inline(always)]
    fn encode<L: Lane>(v: [L; 3]) -> L::Int {
        let [theta, phi] = angles(v);
        let (begin, count) = P::band::<L>((theta * L::splat(P::LAST as f32)).round_int());
        begin + wrap::<L>((phi * L::splat(0.5) * L::from_int(count)).round_int(), count)
    }

    #[inline(never)]
    fn encode_precise<L: Lane>(v: [L; 3]) -> L::Int {
        L::compiled_for(
            #[inline(always)]
            || {
                let [theta, phi] = angles(v);
                let (zero, last) = (L::Int::splat(0), L::Int::splat(P::LAST));
                let mut closest = Closest::to(v);
                for parallel in around(theta * L::splat(P::LAST as f32)) {
                    let parallel = parallel.max(zero).min(last);
                    let (begin, count) = P::band::<L>(parallel);
                    for k in around(phi * L::splat(0.5) * L::from_int(count)) {
                        let k = wrap::<L>(k, count);
                        closest.consider(begin + k, Self::point(parallel, k, count));
                    }
                }
                closest.code()
            },
        )
    }

    #[inline(always)]
    fn decode<L: Lane>(code: L::Int) -> [L; 3] {
        let [parallel, k, count] = P::find::<L>(code);
        Self::point(parallel, wrap::<L>(k, count), count)
    }

    #[inline(always)]
    fn canonical<L: Lane>(code: L::Int) -> L::Int {
        let [parallel, k, count] = P::find::<L>(code);
        P::band::<L>(parallel).0 + wrap::<L>(k, count)
    }

    #[inline(always)]
    fn mirror<L: Lane>(code: L::Int, flips: [bool; 3]) -> L::Int {
        let [x, y, z] = flips;
        let [parallel, k, count] = P::find::<L>(code);
        let k = wrap::<L>(negate_if(wrap::<L>(k, count), y), count);
        let opposite = wrap::<L>(count.shr(1) - k, count);
        let parallel = if z { L::Int::splat(P::LAST) - parallel } else { parallel };
        let (begin, there) = P::band::<L>(parallel);
        let mirrored = begin + if x { opposite } else { k };
        // Off the poles, half a turn of an odd number of points ends between two.
        let one = L::Int::splat(1);
        let between = one.lt(count) & one.lt(count.low(1) + L::Int::splat(i32::from(x)));
        let missing = between | !there.eq(count);
        if !missing.any() {
            return mirrored;
        }
        L::Int::select(missing, mirror_decoded::<Self, L>(code, flips), mirrored)
    }
}

impl<const BITS: u32> Even<BITS> {
    const N: i32 = unorm_max(BITS / 2);
}

impl<const BITS: u32> Parallels for Even<BITS> {
    const LAST: i32 = Self::N - 1;

    #[inline(always)]
    fn band<L: Lane>(parallel: L::Int) -> (L::Int, L::Int) {
        let inner = L::Int::splat(0).lt(parallel) & parallel.lt(L::Int::splat(Self::LAST));
        let n = L::Int::splat(Self::N);
        (parallel * n, L::Int::select(inner, n, L::Int::splat(1)))
    }

    #[inline(always)]
    fn find<L: Lane>(index: L::Int) -> [L::Int; 3] {
        // index = high 2^h + low = high N + (high + low), with N = 2^h - 1.
        let half = BITS / 2;
        let n = L::Int::splat(Self::N);
        let (high, low) = (index.low(BITS).shr(half), index.low(half));
        let k = high + low;
        let carry = !k.lt(n);
        let parallel = L::Int::select(carry, high + L::Int::splat(1), high);
        let parallel = parallel.min(L::Int::splat(Self::LAST));
        [parallel, L::Int::select(carry, k - n, k), Self::band::<L>(parallel).1]
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
    fn band<L: Lane>(parallel: L::Int) -> (L::Int, L::Int) {
        let [_, begin, end, _] = L::gather4(Self::BEGINS, parallel);
        (begin, end - begin)
    }

    #[inline(always)]
    fn find<L: Lane>(index: L::Int) -> [L::Int; 3] {
        let index = index.low(BITS);
        // The cap above the point, or below if that is smaller, has the area share (1 - cos theta) / 2 =
        // sin^2(theta / 2) = t; theta = 2 asin sqrt t.
        let total = const { Self::BEGINS[Self::BEGINS.len() - 1] };
        let (middle, last) = (L::Int::splat((total / 2) as i32), L::Int::splat((total - 1) as i32));
        let south = middle.below(index);
        let beyond = last.below(index);
        let points = L::Int::select(south, last - index, index);
        let points = L::from_int(L::Int::select(beyond, L::Int::splat(0), points));
        let t = (points + L::splat(0.5)) * L::splat((1.0 / total as f64) as f32);
        let asin = sqrt(t)
            * (L::splat(1.000_004_5)
                + t * (L::splat(0.166_218_98)
                    + t * (L::splat(0.081_858_44)
                        + t * (L::splat(0.009_758_449) + t * L::splat(0.094_634_07)))));
        let pole = L::splat(Self::LAST as f32);
        let from_pole = asin * L::splat(Self::LAST as f32 * core::f32::consts::FRAC_2_PI);
        let guess = L::select(south, pole - from_pole, from_pole).round_int();
        // One off at most.
        let [before, begin, end, after] = L::gather4(Self::BEGINS, guess);
        let early = index.below(begin);
        let late = !index.below(end) & guess.lt(L::Int::splat(Self::LAST));
        let pick = inlined(
            #[inline(always)]
            |at, before, after| L::Int::select(early, before, L::Int::select(late, after, at)),
        );
        let one = L::Int::splat(1);
        let parallel = pick(guess, guess - one, guess + one);
        let (begin, end) = (pick(begin, before, end), pick(end, begin, after));
        let count = end - begin;
        [parallel, index - begin, count]
    }
}
