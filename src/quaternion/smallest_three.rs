//! Smallest three: the component of the greatest magnitude is left out and follows from the others.
//!
//! ```text
//! encode   c = the first component of the greatest magnitude;  q = -q if q.c < 0
//!          (i, j, l) = round(sqrt(2) M (the three others) / |q|),   M = 2^(b-1) - 1
//! decode   n = 2 M^2 - i^2 - j^2 - l^2
//!          q.c = sqrt(n);   the three others = (i, j, l);   q /= sqrt(2) M
//! ```
//!
//! Codes with n < 0, whose fields are longer than a unit quaternion, are given by no encoder; they read as
//! the identity.
//!
//! Every chart reaches beyond the rotations whose greatest component it leaves out: where no component
//! exceeds sqrt(1/2), all four have codes. With T = sqrt(2) M q / |q|, what a code is off is
//! |(i, j, l) - (the three others of T)|^2 + (sqrt(n) - T.c)^2, in steps. In the chart of the greatest
//! component one of the eight roundings down or up is never off by more than about a step, and a code
//! that is nearer has no component off by a step or more: so it is one of the eight roundings of some
//! chart, and the nearest of those 32 is the nearest of all codes.
//!
//! Canonical: where the left-out component is about a whole number of steps too, other charts have codes of about
//! the same rotation. Codes are of one rotation if the unit quaternions that they decode to are equal in `f32`. The
//! one emitted is in the chart of the largest component or, if that has none, the first. An encoder looks for it
//! twice: among the codes that decode to its input, and among those that decode as its choice does. So what was
//! decoded becomes the same code again.

use super::chart::{
    Code, Layout, LeftOut, OneWord, Point, ThreeWords, TwoWords, floor_and_ceil_clamped, largest,
};
use super::formula::Rotation;
use crate::formula::support::bits::snorm_max;
use crate::simd::math::{inv_sqrt, sqrt};
use crate::simd::{Simd, SimdInt, SimdMask, Vec3, map_vec, map3, map4};

/// Smallest three in the layout `Y`.
#[derive(Clone, Copy)]
pub(super) struct SmallestThree<Y> {
    layout: Y,
    scale: Scale,
}

impl SmallestThree<OneWord> {
    /// Fields of `bits` bits, from 4 to 10, and the index above them.
    pub(super) const fn in_one_word(bits: u32) -> Self {
        SmallestThree { layout: OneWord::new(bits), scale: Scale::new(bits) }
    }
}

impl SmallestThree<TwoWords> {
    /// Fields of `bits` bits, from 4 to 20, and the index from bit `index` on.
    pub(super) const fn in_two_words(bits: u32, index: u32) -> Self {
        SmallestThree { layout: TwoWords::new(bits, index), scale: Scale::new(bits) }
    }
}

impl SmallestThree<ThreeWords> {
    pub(super) const fn in_three_words() -> Self {
        SmallestThree { layout: ThreeWords, scale: Scale::new(15) }
    }
}

impl<Y: Layout> SmallestThree<Y> {
    /// The point of a code.
    #[inline(always)]
    fn point<V: Simd>(self, code: Code<Y, V>) -> Point<V> {
        let point = self.layout.unpack::<V>(code);
        let beyond = self.scale.left_out_squared::<V>(point.fields).0.lt(0.0);
        let zero = V::Int::splat(0);
        let identity = Point { fields: Vec3::new(zero, zero, zero), left_out: V::Int::splat(3) };
        Point::select(beyond, identity, point)
    }
}

/// Integers of some bits as components.
#[derive(Clone, Copy)]
struct Scale {
    /// The greatest integer M.
    max: i32,
    /// 2 M^2, the squared length of a quaternion in steps: the low 32 bits and the others from the
    /// 20th on.
    square: i32,
    square_high: i32,
    /// sqrt(2) M.
    steps: f32,
    /// 1 / (sqrt(2) M).
    step: f32,
    /// 1 / (2 M^2).
    per_square: f32,
}

impl Scale {
    /// Of 4 to 20 bits. With fewer, rounding could make the three longer than a unit quaternion.
    const fn new(bits: u32) -> Self {
        let max = snorm_max(bits);
        let square = 2 * max as i64 * max as i64;
        Scale {
            max,
            square: square as i32,
            square_high: (square >> 20) as i32,
            steps: (max as f64 * core::f64::consts::SQRT_2) as f32,
            step: (core::f64::consts::FRAC_1_SQRT_2 / max as f64) as f32,
            per_square: 1.0 / square as f32,
        }
    }

    /// n to `f32` rounding, and its low 32 bits.
    #[inline(always)]
    fn left_out_squared<V: Simd>(self, fields: Vec3<V::Int>) -> (V, V::Int) {
        let Vec3 { x: ii, y: jj, z: ll } = map_vec!(fields, |i| i * i);
        let low = V::Int::splat(self.square) - ii - jj - ll;
        if self.max < 1 << 14 {
            return (V::from_int(low), low);
        }
        // In digits of 10 bits, i^2 = 2^20 h^2 + 2^11 h r + r^2.
        let h = map_vec!(fields, |i| i.shr_arithmetic(10));
        let r = map_vec!(fields, |i| i.low_bits(10));
        let high = V::Int::splat(self.square_high) - h.x * h.x - h.y * h.y - h.z * h.z;
        let middle = h.x * r.x + h.y * r.y + h.z * r.z;
        let rest = V::Int::splat(self.square & 0xF_FFFF) - r.x * r.x - r.y * r.y - r.z * r.z;
        // Both exact.
        let high = V::from_int(high - middle.shr_arithmetic(9));
        let rest = V::from_int(rest - middle.low_bits(9).shl(11));
        (high * 1_048_576.0 + rest, low)
    }

    #[inline(always)]
    fn decode<V: Simd>(self, Point { fields, left_out }: Point<V>) -> [V; 4] {
        let (n, low) = self.left_out_squared::<V>(fields);
        let root = sqrt(n * self.per_square);
        // Whole numbers of steps are exact, so that it does not matter which component is left out.
        let whole = (root * self.steps).round_int();
        let exact = V::from_int(whole) * self.step;
        let is_whole = (whole * whole).eq(low);
        let main = V::select(is_whole, exact, root);
        LeftOut::<V>::new(left_out).insert(Vec3::from_int(fields) * self.step, main)
    }

    /// Of the points that decode to the unit quaternion of `q`, and `point` if it is one of them, the one
    /// that is emitted, and where there is one; `point` if there is none. Only where it is `asked`.
    #[inline(always)]
    fn first_alike<V: Simd>(
        self,
        asked: V::Mask,
        q: [V; 4],
        point: Point<V>,
        is_alike: bool,
    ) -> (V::Mask, Point<V>) {
        let unit = normalize(q);
        let largest = largest(unit);
        let rank = |chart: V::Int| V::Int::select(chart.eq(largest), -1, chart);
        let none = V::Int::splat(4);
        let mut least = if is_alike { rank(point.left_out) } else { none };
        let mut first = point;
        let steps = map4!(unit, |c| c * self.steps);
        let [x, y, z, w] = map4!(steps, |c| is_about_whole(c));
        for (chart, fit) in [(0, y & z & w), (1, x & z & w), (2, x & y & w), (3, x & y & z)] {
            let chart = V::Int::splat(chart);
            let counts = asked & fit & rank(chart).lt(least);
            if counts.any() {
                let there = LeftOut::<V>::new(chart);
                let (others, main) = there.remove(steps);
                let fields = map_vec!(others, |c| c.negate_where_negative(main).round_int());
                let there = Point { fields, left_out: chart };
                let decoded = normalize(self.decode::<V>(there));
                let alike = equal(decoded, map4!(unit, |c| c.negate_where_negative(main)));
                let Vec3 { x: i, y: j, z: l } = fields.abs_int();
                let beyond = V::Int::splat(self.max).lt(i.max(j).max(l));
                let alike = counts & !beyond & alike;
                least = V::Int::select(alike, rank(chart), least);
                first = Point::select(alike, there, first);
            }
        }
        (least.lt(none), first)
    }

    /// What an encoder emits for `q` if it would choose `point`. Only where it is `asked`.
    #[inline(always)]
    fn canonical_choice<V: Simd>(self, asked: V::Mask, q: [V; 4], point: Point<V>) -> Point<V> {
        let (found, point) = self.first_alike(asked, q, point, false);
        let asked = asked & !found;
        if !asked.any() {
            return point;
        }
        self.first_alike(asked, self.decode::<V>(point), point, true).1
    }

    /// [`canonical_choice`](Self::canonical_choice), apart from the common way.
    #[inline(never)]
    fn between_charts<V: Simd>(self, asked: V::Mask, q: [V; 4], point: Point<V>) -> Point<V> {
        V::with_target_features(
            #[inline(always)]
            || self.canonical_choice(asked, q, point),
        )
    }

    /// The nearest of all points, canonical.
    #[inline(never)]
    fn nearest<V: Simd>(self, q: [V; 4]) -> Point<V> {
        V::with_target_features(
            #[inline(always)]
            || {
                let to_steps = inv_sqrt(length_squared(q)) * self.steps;
                let [x, y, z, w] = map4!(q, |c| c * to_steps);
                let zero = V::Int::splat(0);
                let point = Point { fields: Vec3::new(zero, zero, zero), left_out: zero };
                let mut nearest = Nearest { point, off: V::splat(f32::INFINITY) };
                let charts = [([y, z, w], x), ([x, z, w], y), ([x, y, w], z), ([x, y, z], w)];
                for (left_out, (others, main)) in (0..).zip(charts) {
                    nearest.consider(self, others.into(), main, left_out);
                }
                self.canonical_choice(V::Mask::splat(true), q, nearest.point)
            },
        )
    }
}

/// The nearest point so far, and its squared distance in steps.
struct Nearest<V: Simd> {
    point: Point<V>,
    off: V,
}

impl<V: Simd> Nearest<V> {
    /// Considers the eight roundings in one chart, of a quaternion in steps.
    #[inline(always)]
    fn consider(&mut self, scale: Scale, others: Vec3<V>, main: V, left_out: i32) {
        let target = map_vec!(others, |c| c.negate_where_negative(main));
        let around = map_vec!(target, |c| floor_and_ceil_clamped(c, scale.max));
        for i in around.x {
            for j in around.y {
                for l in around.z {
                    let fields = Vec3::new(i, j, l);
                    let (n, _) = scale.left_out_squared::<V>(fields);
                    let mut off = sqrt(n) - main.abs();
                    off = off * off;
                    let e = Vec3::from_int(fields) - target;
                    off = off + e.x * e.x;
                    off = off + e.y * e.y;
                    off = off + e.z * e.z;
                    let nearer = off.lt(self.off) & V::splat(0.0).le(n);
                    self.off = V::select(nearer, off, self.off);
                    let point = Point { fields, left_out: V::Int::splat(left_out) };
                    self.point = Point::select(nearer, point, self.point);
                }
            }
        }
    }
}

impl<Y: Layout> Rotation for SmallestThree<Y> {
    type Shape = Y::Shape;

    #[inline(always)]
    fn encode<V: Simd>(self, q: [V; 4]) -> Code<Y, V> {
        let left_out = largest(q);
        let (others, main) = LeftOut::<V>::new(left_out).remove(q);
        let scale = inv_sqrt(length_squared(q)) * self.scale.steps;
        let signed = scale.negate_where_negative(main);
        let steps = others * signed;
        let fields = steps.round_int();
        // Rounding moves what is left out by up to 1.6 steps and a field by a half. So the largest
        // component of what is decoded may be another, by 2.1 steps, which rounding makes 2.6.
        let Vec3 { x: i, y: j, z: l } = fields.abs_int();
        let margin = main.abs() * scale - V::from_int(i.max(j).max(l));
        let mut point = Point { fields, left_out };
        let between = margin.lt(2.75);
        if between.any() {
            // Other charts have a code of this rotation only if what is left out is about whole, and of
            // what decodes to `q` three components are.
            let (n, _) = self.scale.left_out_squared::<V>(fields);
            let [x, y, z] = map3!(steps.to_array(), |c| is_about_whole(c));
            let main = is_about_whole(main * scale);
            let three = (x & y & (z | main)) | (z & main & (x | y));
            let asked = between & (three | is_about_whole(sqrt(n)));
            if asked.any() {
                point = self.scale.between_charts(asked, q, point);
            }
        }
        self.layout.pack::<V>(point)
    }

    #[inline(always)]
    fn encode_precise<V: Simd>(self, q: [V; 4]) -> Code<Y, V> {
        self.layout.pack::<V>(self.scale.nearest(q))
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: Code<Y, V>) -> [V; 4] {
        self.scale.decode::<V>(self.point::<V>(code))
    }

    #[inline(always)]
    fn canonical<V: Simd>(self, code: Code<Y, V>) -> Code<Y, V> {
        let point = self.point::<V>(code);
        let decoded = self.scale.decode::<V>(point);
        self.layout.pack::<V>(self.scale.first_alike(V::Mask::splat(true), decoded, point, true).1)
    }
}

/// Whether a number of steps is whole, up to seven roundings in `f32`.
#[inline(always)]
fn is_about_whole<V: Simd>(steps: V) -> V::Mask {
    (steps - steps.round()).abs().le(steps.abs() * 4e-7)
}

/// Whether all components are equal.
#[inline(always)]
pub(super) fn equal<V: Simd>(p: [V; 4], q: [V; 4]) -> V::Mask {
    let [x, y, z, w] = map4!([0, 1, 2, 3], |i: usize| p[i].le(q[i]) & q[i].le(p[i]));
    x & y & z & w
}

/// q / |q|.
#[inline(always)]
pub(super) fn normalize<V: Simd>(q: [V; 4]) -> [V; 4] {
    let inverse = inv_sqrt(length_squared(q));
    map4!(q, |c| c * inverse)
}

/// q.q.
#[inline(always)]
pub(super) fn length_squared<V: Simd>([x, y, z, w]: [V; 4]) -> V {
    x * x + y * y + z * z + w * w
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    const BITS10: SmallestThree<OneWord> = SmallestThree::in_one_word(10);
    const BITS15: SmallestThree<ThreeWords> = SmallestThree::in_three_words();
    const BITS20: SmallestThree<TwoWords> = SmallestThree::in_two_words(20, 62);

    /// Fields of 10 bits, and the component left out.
    const fn code([i, j, l]: [i32; 3], left_out: i32) -> i32 {
        (i & 1023) | (j & 1023) << 10 | (l & 1023) << 20 | left_out << 30
    }

    fn canonical(code: i32) -> i32 {
        BITS10.canonical::<f32>(I32x1(code)).0
    }

    #[test]
    fn the_largest_component_is_left_out() {
        // sqrt(2) 511 = 722.66, and 722.66 * 0.6 = 433.6.
        for (q, expected) in [
            ([0.0f32, 0.6, 0.0, 0.8], code([0, 434, 0], 3)),
            ([0.0, -0.6, 0.0, -0.8], code([0, 434, 0], 3)),
            ([0.0, 1.2, 0.0, -1.6], code([0, -434, 0], 3)),
            ([0.8, 0.6, 0.0, 0.0], code([434, 0, 0], 0)),
            ([0.0, 0.0, -0.8, 0.6], code([0, 0, -434], 2)),
        ] {
            assert_eq!([BITS10.encode(q).0, BITS10.encode_precise(q).0], [expected; 2], "{q:?}");
        }
    }

    #[test]
    fn what_is_left_out_follows_from_the_others() {
        // 434 / 722.66 = 0.600557, and sqrt(1 - 0.600557^2) = 0.799582.
        let q = BITS10.decode::<f32>(I32x1(code([0, -434, 0], 2)));
        let off = [q[0], q[1] + 0.600_557, q[2] - 0.799_582, q[3]];
        assert!(length_squared(off) < 1e-11, "{q:?}");
    }

    #[test]
    fn axes_survive() {
        fn check<Y: Layout>(formula: SmallestThree<Y>) {
            for axis in 0..4 {
                let mut q = [0.0f32; 4];
                q[axis] = 1.0;
                assert_eq!(formula.decode::<f32>(formula.encode(q)), q);
                assert_eq!(formula.decode::<f32>(formula.encode_precise(q.map(|c| -c))), q);
            }
        }
        check(BITS10);
        check(BITS15);
        check(BITS20);
    }

    #[test]
    fn fields_that_are_too_long_read_as_the_identity() {
        // 3 * 511^2 and 512^2 + 511^2 + 1 are more than 2 * 511^2, and 2 * 511^2 is not.
        for fields in [[511, 511, 511], [511, -511, 1]] {
            assert_eq!(BITS10.decode::<f32>(I32x1(code(fields, 1))), [0.0, 0.0, 0.0, 1.0]);
            assert_eq!(canonical(code(fields, 1)), code([0; 3], 3));
        }
        assert!(BITS10.decode::<f32>(I32x1(code([511, 511, 0], 3)))[0] > 0.7);
        // -512 is -511.
        assert_eq!(canonical(code([-512, 0, 300], 3)), code([-511, 0, 300], 3));
    }

    #[test]
    fn where_the_rest_is_a_square_the_first_of_the_largest_counts() {
        // 2 * 511^2 - 511^2 = 511^2: (511, 0, 0, 511), whose x is left out, and (-511, 0, 0, 511), negated.
        assert_eq!(canonical(code([511, 0, 0], 3)), code([0, 0, 511], 0));
        assert_eq!(canonical(code([-511, 0, 0], 3)), code([0, 0, -511], 0));
        // 2 * 511^2 - 511^2 - 511^2 = 0: (511, 511, 0, 0).
        assert_eq!(canonical(code([511, 511, 0], 3)), code([511, 0, 0], 0));
        // 2 * 511^2 - 434^2 = 333886 is between 577^2 and 578^2.
        assert_eq!(canonical(code([0, 434, 0], 0)), code([0, 434, 0], 0));
    }

    #[test]
    fn whole_numbers_of_steps_decode_alike_in_every_chart() {
        const STEPS: std::ops::RangeInclusive<i32> = 0..=511;
        let mut count = 0;
        for (i, w) in STEPS.flat_map(|i| STEPS.map(move |w| (i, w))) {
            let rest = 2 * 511 * 511 - i * i - w * w;
            let j = (rest as f64).sqrt() as i32;
            if j <= 511 && j * j == rest {
                // (i, j, 0, w), of which w or i is left out.
                let [own, other] = [code([i, j, 0], 3), code([j, 0, w], 0)];
                let decoded = [own, other].map(|code| BITS10.decode::<f32>(I32x1(code)));
                assert_eq!(decoded[0], decoded[1], "{i} {j} {w}");
                count += 1;
            }
        }
        assert!(count >= 12, "{count}");
    }

    #[test]
    fn the_rest_is_exact_where_it_is_longer_than_a_word() {
        let [m, i, j, l] = [524_287i64, 524_286, -3077, 70_055];
        let fields = Vec3::from([i, j, l].map(|f| I32x1(f as i32)));
        let (n, low) = BITS20.scale.left_out_squared::<f32>(fields);
        let exact = 2 * m * m - i * i - j * j - l * l;
        assert_eq!((n, low.0), (exact as f32, exact as i32));
        // The same rotation in two charts: (M, 0, 0, M).
        let there = [I32x1(524_287), I32x1(3 << 30)];
        let own = [I32x1(0), I32x1(524_287 << 8)];
        assert_eq!(BITS20.canonical::<f32>(there), own);
    }

    #[test]
    fn the_nearest_code_may_be_in_another_chart() {
        // In steps (361.2, 361.4, 361.3, 361.4), about sqrt(2) 511 / 2 each.
        let q = [0.5f32, 0.5, 0.5, 0.5];
        let square = |code: I32x1| {
            let d = BITS10.decode::<f32>(code);
            length_squared([d[0] - q[0], d[1] - q[1], d[2] - q[2], d[3] - q[3]])
        };
        let least = (0..4).flat_map(|chart| {
            (0..8)
                .map(move |up| code([361 + (up & 1), 361 + (up >> 1 & 1), 361 + (up >> 2)], chart))
        });
        let least = least.map(|code| square(I32x1(code))).fold(4.0, f32::min);
        assert!(square(BITS10.encode_precise(q)) <= least + 1e-12);
    }
}
