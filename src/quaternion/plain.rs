//! Plain quaternions: all four components as snorm.
//!
//! ```text
//! encode   (i, j, k, l) = round(M q / |q|),   M = 2^(b-1) - 1,   negated if that makes the last nonzero one positive
//! decode   q = (i, j, k, l) / |(i, j, k, l)|;   four zeros read as the identity
//! ```
//!
//! Decoding divides by the length, so integers mean their direction, and the nearest code may have any
//! length. Those of less than half the greatest component are multiples of others. At each greatest component
//! n, the line through q is at one point of a cube of the lattice. The nearest of all is a corner of one of
//! these cubes: mostly the one that rounding gives, and otherwise all eight are tried.
//!
//! Canonical: of the multiples of one direction the one whose length is nearest to M. Above ten bits there
//! are directions that `f32` cannot tell apart: of those whose unit quaternions are equal the one of that length is
//! emitted, and canonical is what the nearest encoder gives.

use core::marker::PhantomData;

use super::chart::{LeftOut, get, largest, put};
use super::formula::{Code, Rotation};
use super::smallest_three::{equal, length_squared, normalize};
use crate::batch::storage::{CodeShape, Word, Words2};
use crate::formula::support::bits::snorm_max;
use crate::formula::support::divisor::gcd;
use crate::simd::math::sqrt;
use crate::simd::{Simd, SimdInt, SimdMask, Vec3, map_vec, map4};

/// Four snorm numbers of `bits` bits in the words `W`, the first in the low bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Plain<W> {
    bits: u32,
    words: PhantomData<W>,
}

impl Plain<Word> {
    /// Of 4 to 8 bits each.
    pub(super) const fn in_one_word(bits: u32) -> Self {
        Plain { bits, words: PhantomData }
    }
}

impl Plain<Words2> {
    /// Of 9 to 16 bits each.
    pub(super) const fn in_two_words(bits: u32) -> Self {
        Plain { bits, words: PhantomData }
    }
}

/// Words that hold four fields.
pub(super) trait Fields: CodeShape + Copy + Send + Sync {
    fn pack<V: Simd>(fields: [V::Int; 4], bits: u32) -> Self::In<V>;
    /// The fields, of which only the low bits count.
    fn unpack<V: Simd>(code: Self::In<V>, bits: u32) -> [V::Int; 4];
}

impl Fields for Word {
    #[inline(always)]
    fn pack<V: Simd>(fields: [V::Int; 4], bits: u32) -> V::Int {
        let [x, y, z, w] = map4!(fields, |f| f.low_bits(bits));
        x | y.shl(bits) | z.shl(2 * bits) | w.shl(3 * bits)
    }
    #[inline(always)]
    fn unpack<V: Simd>(code: V::Int, bits: u32) -> [V::Int; 4] {
        map4!([0, 1, 2, 3], |i: u32| code.shr_logical(i * bits))
    }
}

impl Fields for Words2 {
    #[inline(always)]
    fn pack<V: Simd>(fields: [V::Int; 4], bits: u32) -> [V::Int; 2] {
        let [x, y, z, w] = map4!(fields, |f| f.low_bits(bits));
        let (y, z, w) = (put::<V>(y, bits), put::<V>(z, 2 * bits), put::<V>(w, 3 * bits));
        [x | y[0] | z[0] | w[0], y[1] | z[1] | w[1]]
    }
    #[inline(always)]
    fn unpack<V: Simd>(code: [V::Int; 2], bits: u32) -> [V::Int; 4] {
        let [y, z, w] = [get::<V>(code, bits), get::<V>(code, 2 * bits), get::<V>(code, 3 * bits)];
        [code[0], y, z, w]
    }
}

/// The opposite if the last component that is not zero is negative.
#[inline(always)]
fn upright<V: Simd>([x, y, z, w]: [V::Int; 4]) -> [V::Int; 4] {
    let mut last = x;
    for c in [y, z, w] {
        last = V::Int::select(c.eq(0), last, c);
    }
    map4!([x, y, z, w], |c| c.negate_where_negative(last))
}

impl<W: Fields> Plain<W> {
    #[inline(always)]
    fn max(self) -> i32 {
        snorm_max(self.bits)
    }

    /// Whether `f32` tells all directions apart.
    #[inline(always)]
    fn is_distinct(self) -> bool {
        self.bits <= 10
    }

    #[inline(always)]
    fn pack<V: Simd>(self, point: [V::Int; 4]) -> Code<Self, V> {
        W::pack::<V>(upright::<V>(point), self.bits)
    }

    /// The integers of a code; four zeros are the identity.
    #[inline(always)]
    fn point<V: Simd>(self, code: Code<Self, V>) -> [V::Int; 4] {
        let fields = W::unpack::<V>(code, self.bits);
        let [x, y, z, w] = map4!(fields, |f| f.sign_extend(self.bits).max(-self.max()));
        let is_zero = (x | y | z | w).eq(0);
        [x, y, z, V::Int::select(is_zero, 1, w)]
    }

    /// The unit quaternion of a point, which is not zero. Axes are exact.
    #[inline(always)]
    fn unit<V: Simd>(self, point: [V::Int; 4]) -> [V; 4] {
        let step = 1.0 / self.max() as f32;
        normalize(map4!(point, |i| V::from_int(i) * step))
    }

    /// Of the multiples of a point, which is not zero, the one whose length is nearest to M.
    #[inline(always)]
    fn representative<V: Simd>(self, point: [V::Int; 4]) -> [V::Int; 4] {
        let [x, y, z, w] = map4!(point, |i| V::from_int(i.abs()));
        let divisor = gcd(Vec3::new(gcd(Vec3::new(x, y, z)), w, V::splat(0.0)));
        let primitive = map4!(point, |i| V::from_int(i) / divisor);
        let m = V::splat(self.max() as f32);
        let most = x.max(y).max(z.max(w)) / divisor;
        let room = ((m + 0.5) / most).floor();
        let times = (m / sqrt(length_squared(primitive))).round().min(room);
        map4!(primitive, |c| (c * times).round_int())
    }

    /// The line through `q`, which is not zero.
    #[inline(always)]
    fn line<V: Simd>(q: [V; 4]) -> Line<V> {
        let chart = LeftOut::new(largest(q));
        let (others, main) = chart.remove(q);
        let slope = map_vec!(others, |c| c / main);
        let per_stretch = V::splat(1.0) / (slope.length_squared() + 1.0);
        Line { chart, slope, per_stretch }
    }

    /// The greatest components of which no multiple is a point, the longest first.
    #[inline(always)]
    fn lengths(self) -> impl Iterator<Item = i32> {
        (self.max() / 2..=self.max()).rev()
    }

    /// The nearest point to a line, or a multiple of it: of the rounded ones, or of `ALL` corners. And whether
    /// the rounded ones are enough.
    #[inline(always)]
    fn nearest_corner<V: Simd, const ALL: bool>(self, line: &Line<V>) -> ([V::Int; 4], V::Mask) {
        let one = V::splat(1.0);
        let (mut across, mut reach) = (V::splat(f32::MAX), one);
        let (mut fields, mut main) = (Vec3::from([V::splat(0.0); 3]), one);
        for n in self.lengths() {
            let length = V::splat(n as f32);
            let target = line.slope * length;
            let near = map_vec!(target, |c| c.round());
            let off = near - target;
            let far = map_vec!(off, |e| e - one.negate_where_negative(e));
            for corner in 0..if ALL { 8 } else { 1 } {
                let e = Vec3::new(
                    if corner & 1 == 0 { off.x } else { far.x },
                    if corner & 2 == 0 { off.y } else { far.y },
                    if corner & 4 == 0 { off.z } else { far.z },
                );
                // The squared tangent of the angle is, up to a factor, across / reach^2.
                let (this_across, this_reach) = line.off(e, length);
                let this_reach = this_reach * this_reach;
                let nearer = (this_across * reach).lt(across * this_reach);
                across = V::select(nearer, this_across, across);
                reach = V::select(nearer, this_reach, reach);
                fields = Vec3::select(nearer, target + e, fields);
                main = V::select(nearer, length, main);
            }
        }
        // A corner that is not rounded is at least half a step off, of which a stretch-th may be along the line.
        let most = self.max() as f32 + 1.0;
        let sure = across.lt(line.per_stretch * reach * (0.24 / (most * most)));
        let fields = map_vec!(fields, |c| c.round_int());
        (line.chart.insert_int(fields, main.round_int()), sure)
    }

    #[inline(always)]
    fn nearest<V: Simd>(self, line: &Line<V>) -> [V::Int; 4] {
        let (rounded, sure) = self.nearest_corner::<V, false>(line);
        if !(!sure).any() {
            return rounded;
        }
        let (nearest, _) = self.nearest_corner::<V, true>(line);
        map4!([0, 1, 2, 3], |i: usize| V::Int::select(sure, rounded[i], nearest[i]))
    }

    /// Of the points whose unit quaternion is that of `q`, the one that is emitted; `point` if there is none.
    #[inline(always)]
    fn alike<V: Simd>(self, q: [V; 4], point: [V::Int; 4]) -> [V::Int; 4] {
        let unit = normalize(q);
        let line = Self::line(unit);
        let (_, main) = line.chart.remove(unit);
        let unit = map4!(unit, |c| c.negate_where_negative(main));
        let m = self.max() as f32;
        let (mut found, mut off_length) = (point, V::splat(f32::INFINITY));
        for n in self.lengths() {
            let length = V::splat(n as f32);
            let target = line.slope * length;
            let near = map_vec!(target, |c| c.round());
            let (across, _) = line.off(near - target, length);
            // 5e-7 radians, seven roundings.
            if !across.lt(length * length * 2.5e-13).any() {
                continue;
            }
            let there = line.chart.insert_int(map_vec!(near, |c| c.round_int()), V::Int::splat(n));
            let there = self.representative::<V>(there);
            let decoded = normalize(self.unit::<V>(there));
            let length = sqrt(length_squared(map4!(there, |i| V::from_int(i))));
            let off = (length - m).abs();
            let better = equal(decoded, unit) & off.lt(off_length);
            off_length = V::select(better, off, off_length);
            found = map4!([0, 1, 2, 3], |i: usize| V::Int::select(better, there[i], found[i]));
        }
        found
    }
}

/// A line through the origin, seen along its largest component.
struct Line<V: Simd> {
    chart: LeftOut<V>,
    /// The three others over the largest.
    slope: Vec3<V>,
    /// 1 / (slope.slope + 1).
    per_stretch: V,
}

impl<V: Simd> Line<V> {
    /// The squared distance from the line of what is `e` off its point of this length, and the length of the
    /// nearest point of the line.
    #[inline(always)]
    fn off(&self, e: Vec3<V>, length: V) -> (V, V) {
        let along = e.dot(self.slope);
        let per_stretch = along * self.per_stretch;
        (e.length_squared() - along * per_stretch, length + per_stretch)
    }
}

impl<W: Fields> Rotation for Plain<W> {
    type Shape = W;

    #[inline(always)]
    fn encode<V: Simd>(self, q: [V; 4]) -> Code<Self, V> {
        let m = self.max() as f32;
        self.pack::<V>(map4!(normalize(q), |c| (c * m).round_int()))
    }

    #[inline(never)]
    fn encode_precise<V: Simd>(self, q: [V; 4]) -> Code<Self, V> {
        V::with_target_features(
            #[inline(always)]
            || {
                let mut point = self.representative::<V>(self.nearest::<V>(&Self::line(q)));
                if !self.is_distinct() {
                    // What was decoded, and what will be.
                    point = self.alike(q, point);
                    point = self.alike(self.unit::<V>(point), point);
                }
                self.pack::<V>(point)
            },
        )
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: Code<Self, V>) -> [V; 4] {
        self.unit::<V>(self.point::<V>(code))
    }

    #[inline(always)]
    fn canonical<V: Simd>(self, code: Code<Self, V>) -> Code<Self, V> {
        if self.is_distinct() {
            self.pack::<V>(self.representative::<V>(self.point::<V>(code)))
        } else {
            self.encode_precise::<V>(self.decode::<V>(code))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    const BITS4: Plain<Word> = Plain::in_one_word(4);
    const BITS8: Plain<Word> = Plain::in_one_word(8);
    const BITS16: Plain<Words2> = Plain::in_two_words(16);

    #[test]
    fn components_are_rounded_and_the_last_is_positive() {
        // 127 (0, 0.6, 0, 0.8) = (0, 76.2, 0, 101.6).
        let code = |q: [f32; 4]| BITS8.encode(q).0 as u32;
        assert_eq!(code([0.0, 1.2, 0.0, 1.6]), 102 << 24 | 76 << 8);
        assert_eq!(code([0.0, 1.2, 0.0, -1.6]), 102 << 24 | (256 - 76) << 8);
        assert_eq!(code([-3.0, 0.0, 0.0, 0.0]), 127);
        let code = |q: [f32; 4]| BITS16.encode(q).map(|word| word.0 as u32);
        // 32767 (0.6, 0, 0, 0.8) = (19660.2, 0, 0, 26213.6).
        assert_eq!(code([0.6, 0.0, 0.0, 0.8]), [19_660, 26_214 << 16]);
        assert_eq!(code([0.0, 0.0, -1.0, 0.0]), [0, 32_767]);
    }

    #[test]
    fn decoding_divides_by_the_length() {
        let q = BITS4.decode::<f32>(I32x1(0x4003));
        assert!((q[0] - 0.6).abs() < 1e-7 && (q[3] - 0.8).abs() < 1e-7 && q[1] == 0.0);
        // -8 reads as -7, and zeros as the identity.
        assert_eq!(BITS4.decode::<f32>(I32x1(8)), [-1.0, 0.0, 0.0, 0.0]);
        assert_eq!(BITS16.decode::<f32>([I32x1(0); 2]), [0.0, 0.0, 0.0, 1.0]);
    }

    #[test]
    fn of_multiples_and_opposites_one_is_canonical() {
        let canonical = |code: i32| BITS4.canonical::<f32>(I32x1(code)).0;
        // (1, 0, 0, 0) and (-8, 0, 0, 0) are (7, 0, 0, 0); (1, 1, 1, 1) is (4, 4, 4, 4), as 7 / 2 is a tie.
        assert_eq!([canonical(1), canonical(8), canonical(0)], [7, 7, 0x7000]);
        assert_eq!(canonical(0x1111), 0x4444);
        // -(2, 0, 0, 1), three times.
        assert_eq!(canonical(0xF00E), 0x3006);
    }

    #[test]
    fn the_nearest_code_is_found() {
        let mut seed = 1u32;
        for _ in 0..200 {
            let q = [0; 4].map(|_| {
                seed = seed.wrapping_mul(0x915F_77F5).wrapping_add(12_345);
                (seed >> 8) as f32 / 8_388_608.0 - 1.0
            });
            let unit = normalize(q);
            let off = |code: i32| {
                let d = BITS4.decode::<f32>(I32x1(code));
                let dot = (0..4).map(|i| d[i] * unit[i]).sum::<f32>().abs();
                1.0 - dot
            };
            let least = (0..1 << 16).map(off).fold(4.0, f32::min);
            let found = BITS4.encode_precise(q).0;
            assert!(off(found) <= least + 3e-7, "{q:?}: {found:x}");
            assert_eq!(BITS4.canonical::<f32>(I32x1(found)).0, found);
        }
    }
}
