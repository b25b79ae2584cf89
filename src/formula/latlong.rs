//! Lat-long: points on parallels, counted from the north pole to the south.
//!
//! ```text
//! latlong    N = 2^(BITS/2) - 1 parallels at theta = j pi / (N - 1), N points on each at phi = 2 pi k / N;  index = j N + k
//! latlongD   F parallels at theta = j pi / (F - 1), the j-th with as many points as keep every direction within e degrees;
//!            index = points on earlier parallels + k
//! ```
//!
//! latlongD has as many points on each parallel as make its cells about as wide as high; F
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

use super::support::bits::unorm_max;
use super::support::closest::{Closest, floor_and_ceil};
use super::support::sign::negate_if;
use super::{Formula, kernels};
use crate::batch::storage::{Word, Words};
use crate::simd::math::{atan2_half_turns, horner, sin_cos_quarter_turns, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, Vec3};

/// Lat-long on the parallels `P`.
#[derive(Clone, Copy)]
pub(crate) struct LatLong<P> {
    parallels: P,
    /// Number of the south pole's parallel, if the north pole's is 0.
    last: i32,
}

/// As many points on every parallel.
#[derive(Clone, Copy)]
pub(crate) struct Uniform {
    /// Bits of half an index.
    half: u32,
    /// Number of parallels, and of points on each.
    n: i32,
}

/// Fewer points towards the poles.
#[derive(Clone, Copy)]
pub(crate) struct Adaptive {
    bits: u32,
    /// First index of each parallel, with one sentinel before, 0, and two after, the number of points.
    begins: &'static [u32],
    last: i32,
    /// Number of points, minus one.
    last_point: i32,
    /// Number of points, halved.
    middle: i32,
    /// 1 over the number of points.
    per_point: f32,
}

/// Parallels at equal distances, from pole to pole, with points on them.
pub(crate) trait Parallels: Copy + Send + Sync + 'static {
    /// First index of a parallel, and number of its points; the poles have one.
    fn band<V: Simd>(self, parallel: V::Int) -> (V::Int, V::Int);
    /// Parallel of an index, point on it, and number of its points. Indices beyond the last point are on
    /// the last parallel.
    fn find<V: Simd>(self, index: V::Int) -> [V::Int; 3];
}

/// Polar angle and azimuth in half turns, the azimuth from 0 to 2.
#[inline(always)]
fn angles<V: Simd>(Vec3 { x, y, z }: Vec3<V>) -> [V; 2] {
    let theta = atan2_half_turns(sqrt(x * x + y * y), z);
    let phi = atan2_half_turns(y, x);
    [theta, V::select(phi.lt(0.0), phi + 2.0, phi)]
}

/// Point `k` modulo `count`, from -count to count.
#[inline(always)]
fn wrap<V: Simd>(k: V::Int, count: V::Int) -> V::Int {
    let k = V::Int::select(k.lt(0), k + count, k);
    V::Int::select(k.lt(count), k, 0)
}

impl LatLong<Uniform> {
    pub(crate) const fn new(bits: u32) -> Self {
        let n = unorm_max(bits / 2);
        LatLong { parallels: Uniform { half: bits / 2, n }, last: n - 1 }
    }
}

impl LatLong<Adaptive> {
    /// In 16, 24 or 32 bits.
    pub(crate) const fn new(bits: u32) -> Self {
        let begins = match bits {
            16 => BEGINS_16,
            24 => BEGINS_24,
            _ => BEGINS_32,
        };
        let last = begins.len() as i32 - 4;
        let points = begins[begins.len() - 1];
        let parallels = Adaptive {
            bits,
            begins,
            last,
            last_point: (points - 1) as i32,
            middle: (points / 2) as i32,
            per_point: (1.0 / points as f64) as f32,
        };
        LatLong { parallels, last }
    }
}

include!(concat!(env!("OUT_DIR"), "/latlong_bands.rs"));

impl<P: Parallels> LatLong<P> {
    /// Point `k` of `count` on a parallel.
    #[inline(always)]
    fn point<V: Simd>(self, parallel: V::Int, k: V::Int, count: V::Int) -> Vec3<V> {
        // In quarter turns.
        let theta = V::from_int(parallel) / (0.5 * self.last as f32);
        // From -2 to 2: beyond half a turn a bit would be lost.
        let k = V::Int::select(count.lt(k + k), k - count, k);
        let phi = V::from_int(k.shl(2)) / V::from_int(count);
        let (sin_theta, cos_theta) = sin_cos_quarter_turns(theta);
        let (sin_phi, cos_phi) = sin_cos_quarter_turns(phi);
        Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
    }
}

impl<P: Parallels> Formula for LatLong<P> {
    type Shape = Word;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let [theta, phi] = angles(v);
        let (begin, count) = self.parallels.band::<V>((theta * self.last as f32).round_int());
        begin + wrap::<V>((phi * 0.5 * V::from_int(count)).round_int(), count)
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(self, v: Vec3<V>) -> V::Int {
        V::with_target_features(
            #[inline(always)]
            || {
                let [theta, phi] = angles(v);
                let mut closest = Closest::to(v);
                for parallel in floor_and_ceil(theta * self.last as f32) {
                    let parallel = parallel.clamp(0, self.last);
                    let (begin, count) = self.parallels.band::<V>(parallel);
                    for k in floor_and_ceil(phi * 0.5 * V::from_int(count)) {
                        let k = wrap::<V>(k, count);
                        closest.consider(begin + k, self.point(parallel, k, count));
                    }
                }
                closest.code()
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        let [parallel, k, count] = self.parallels.find::<V>(code);
        self.point(parallel, wrap::<V>(k, count), count)
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        let [x, y, z] = flips;
        let [parallel, k, count] = self.parallels.find::<V>(code);
        let k = wrap::<V>(negate_if(wrap::<V>(k, count), y), count);
        let opposite = wrap::<V>(count.shr_logical(1) - k, count);
        let parallel = if z { V::Int::splat(self.last) - parallel } else { parallel };
        let (begin, there) = self.parallels.band::<V>(parallel);
        let mirrored = begin + if x { opposite } else { k };
        // Off the poles, half a turn of an odd number of points ends between two.
        let one = V::Int::splat(1);
        let between = one.lt(count) & one.lt(count.low_bits(1) + i32::from(x));
        let missing = between | !there.eq(count);
        if !missing.any() {
            return mirrored;
        }
        V::Int::select(missing, self.mirror_decoded::<V>(code, flips), mirrored)
    }
}

impl Parallels for Uniform {
    #[inline(always)]
    fn band<V: Simd>(self, parallel: V::Int) -> (V::Int, V::Int) {
        let inner = V::Int::splat(0).lt(parallel) & parallel.lt(self.n - 1);
        (parallel * self.n, V::Int::select(inner, self.n, 1))
    }

    #[inline(always)]
    fn find<V: Simd>(self, index: V::Int) -> [V::Int; 3] {
        // index = high 2^h + low = high N + (high + low), with N = 2^h - 1.
        let high = index.shr_logical(self.half).low_bits(self.half);
        let k = high + index.low_bits(self.half);
        let carry = !k.lt(self.n);
        let parallel = V::Int::select(carry, high + 1, high).min(self.n - 1);
        [parallel, V::Int::select(carry, k - self.n, k), self.band::<V>(parallel).1]
    }
}

impl Parallels for Adaptive {
    #[inline(always)]
    fn band<V: Simd>(self, parallel: V::Int) -> (V::Int, V::Int) {
        let [_, begin, end, _] = V::gather4(self.begins, parallel);
        (begin, end - begin)
    }

    #[inline(always)]
    fn find<V: Simd>(self, index: V::Int) -> [V::Int; 3] {
        /// asin(sqrt(t)) / sqrt(t), for t up to 1/2.
        const ASIN: [f32; 5] =
            [1.000_004_5, 0.166_218_98, 0.081_858_44, 0.009_758_449, 0.094_634_07];
        let index = index.low_bits(self.bits);
        // The cap above the point, or below if that is smaller, has the area share (1 - cos theta) / 2 =
        // sin^2(theta / 2) = t; theta = 2 asin sqrt t.
        let last_point = V::Int::splat(self.last_point);
        let south = V::Int::splat(self.middle).lt_unsigned(index);
        let beyond = last_point.lt_unsigned(index);
        let points = V::Int::select(south, last_point - index, index);
        let points = V::from_int(V::Int::select(beyond, 0, points));
        let t = (points + 0.5) * self.per_point;
        let asin = sqrt(t) * horner(t, ASIN);
        let from_pole = asin * (self.last as f32 * core::f32::consts::FRAC_2_PI);
        let guess = V::select(south, V::splat(self.last as f32) - from_pole, from_pole).round_int();
        // One off at most.
        let [before, begin, end, after] = V::gather4(self.begins, guess);
        let early = index.lt_unsigned(begin);
        let late = !index.lt_unsigned(end) & guess.lt(self.last);
        let (begin, end, parallel) = (
            V::Int::select(early, before, V::Int::select(late, end, begin)),
            V::Int::select(early, begin, V::Int::select(late, after, end)),
            V::Int::select(early, guess - 1, V::Int::select(late, guess + 1, guess)),
        );
        [parallel, index - begin, end - begin]
    }
}

kernels!(LatLong<Uniform>: Words; LatLong<Adaptive>: Words);

#[cfg(test)]
mod tests {
    use super::*;

    /// 255 parallels of 255 points.
    const UNIFORM: LatLong<Uniform> = LatLong::<Uniform>::new(16);
    const LAST: i32 = 254 * 255;

    fn adaptive(bits: u32) -> LatLong<Adaptive> {
        LatLong::<Adaptive>::new(bits)
    }

    fn assert_near(v: Vec3<f32>, expected: [f32; 3]) {
        assert!(v.distance_squared(expected.into()) < 1e-12, "{v:?}");
    }

    #[test]
    fn points_are_numbered_along_parallels() {
        // theta = 60 degrees: 254 / 3 = 84.7; phi = 90 degrees: 255 / 4 = 63.75.
        let v = Vec3::new(0.0f32, 0.866_025, 0.5);
        let code = 85 * 255 + 64;
        assert_eq!([UNIFORM.encode(v).0, UNIFORM.encode_precise(v).0], [code; 2]);
        // 85 * 180 / 254 = 60.23622 and 64 * 360 / 255 = 90.35294 degrees.
        let decoded = UNIFORM.decode::<f32>(code.into());
        assert_near(decoded, [-0.005_347_33, 0.868_063, 0.496_425_3]);
        // A little less than a whole turn is point 0.
        assert_eq!(UNIFORM.encode(Vec3::new(1.0f32, -0.001, 0.0)).0, 127 * 255);
    }

    #[test]
    fn promised_axes_survive() {
        let axes = [[0.0f32, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
        for (axis, code) in axes.into_iter().zip([0, LAST, 127 * 255]) {
            assert_eq!(UNIFORM.encode(axis.into()).0, code);
            assert_eq!(UNIFORM.encode_precise(axis.into()).0, code);
            assert_eq!(UNIFORM.decode::<f32>(code.into()).to_array(), axis);
        }
        for (bits, axes) in [(16, &axes[..]), (24, &axes[..]), (32, &axes[..3])] {
            for axis in axes {
                let code = adaptive(bits).encode(Vec3::from(*axis));
                assert_eq!(adaptive(bits).encode_precise(Vec3::from(*axis)), code);
                assert_eq!(adaptive(bits).decode::<f32>(code).to_array(), *axis);
            }
        }
    }

    #[test]
    fn a_pole_is_one_point() {
        for (code, canonical) in [(1, 0), (254, 0), (255, 255), (LAST + 1, LAST), (0xFFFF, LAST)] {
            assert_eq!(UNIFORM.mirror::<f32>(code.into(), [false; 3]).0, canonical);
            let decoded = UNIFORM.decode::<f32>(code.into());
            assert_eq!(decoded, UNIFORM.decode::<f32>(canonical.into()));
        }
        // 180 / 254 degrees.
        assert_near(UNIFORM.decode::<f32>(255.into()), [0.012_368_11, 0.0, 0.999_923_5]);
    }

    #[test]
    fn mirror_images_of_uniform_points_count_backwards() {
        let code = 85 * 255 + 64;
        for (flips, mirrored) in [
            ([false, true, false], 85 * 255 + 191),
            ([false, false, true], 169 * 255 + 64),
            ([false, true, true], 169 * 255 + 191),
        ] {
            assert_eq!(UNIFORM.mirror::<f32>(code.into(), flips).0, mirrored);
        }
        // Half a turn from 0 is between 127 and 128.
        let opposite = UNIFORM.mirror::<f32>((85 * 255).into(), [true, false, false]).0;
        assert!([85 * 255 + 127, 85 * 255 + 128].contains(&opposite));
    }

    #[test]
    fn adaptive_points_are_numbered_from_pole_to_pole() {
        let formula = adaptive(16);
        assert_eq!(formula.encode(Vec3::new(0.0f32, 0.0, -1.0)).0, 0xFFFF);
        // The 227 parallels are 180 / 226 degrees apart.
        assert_near(formula.decode::<f32>(1.into()), [0.013_900_39, 0.0, 0.999_903_4]);
        // Half of the points are before the opposite of the equator's first.
        assert_eq!(formula.encode(Vec3::new(-1.0f32, 0.0, 0.0)).0, 0x8000);
        assert_eq!(formula.mirror::<f32>(0x8000.into(), [true, false, false]), {
            formula.encode(Vec3::new(1.0f32, 0.0, 0.0))
        });
    }

    #[test]
    fn the_one_index_beyond_the_last_point_reads_as_the_south_pole() {
        let formula = adaptive(32);
        assert_eq!(formula.decode::<f32>((-1).into()).to_array(), [0.0, 0.0, -1.0]);
        assert_eq!(formula.mirror::<f32>((-1).into(), [false; 3]).0, -2);
    }

    #[test]
    fn the_nearest_code_of_a_decoded_vector_is_its_own() {
        for code in [0, 1, 7, 1000, 0x7FFF, 0x8000, 0x8001, 50_000, 0xFFFE, 0xFFFF] {
            let v = adaptive(16).decode::<f32>(code.into());
            assert_eq!([adaptive(16).encode(v).0, adaptive(16).encode_precise(v).0], [code; 2]);
            assert_eq!(adaptive(16).mirror::<f32>(code.into(), [false; 3]).0, code);
        }
    }
}
