//! The four charts of the rotations. In each, one component is left out, and the three others are
//! stored in their order.

use crate::formula::bits::snorm_max;
use crate::formula::{One, Three, Two, Words, around};
use crate::simd::{Each, Simd, SimdInt};

/// Three stored integers, and which component is left out: 0 to 3 for x to w.
pub(super) type Point<V> = ([<V as Simd>::Int; 3], <V as Simd>::Int);

/// Which component is left out.
pub(super) struct LeftOut<V: Simd> {
    is_x: V::Mask,
    is_y: V::Mask,
    is_z: V::Mask,
}

impl<V: Simd> LeftOut<V> {
    #[inline(always)]
    pub(super) fn new(index: V::Int) -> Self {
        let [is_x, is_y, is_z] = [0, 1, 2].each(
            #[inline(always)]
            |i| index.eq(V::Int::splat(i)),
        );
        LeftOut { is_x, is_y, is_z }
    }

    /// The quaternion of the three others and this one. `select` chooses lane by lane.
    #[inline(always)]
    pub(super) fn insert<T: Copy>(
        &self,
        [i, j, l]: [T; 3],
        left_out: T,
        select: impl Fn(V::Mask, T, T) -> T,
    ) -> [T; 4] {
        let LeftOut { is_x, is_y, is_z } = *self;
        [
            select(is_x, left_out, i),
            select(is_x, i, select(is_y, left_out, j)),
            select(is_x | is_y, j, select(is_z, left_out, l)),
            select(is_x | is_y | is_z, l, left_out),
        ]
    }

    /// The three others, and the one left out.
    #[inline(always)]
    pub(super) fn remove<T: Copy>(
        &self,
        [x, y, z, w]: [T; 4],
        select: impl Fn(V::Mask, T, T) -> T,
    ) -> ([T; 3], T) {
        let LeftOut { is_x, is_y, is_z } = *self;
        let others =
            [select(is_x, y, x), select(is_x | is_y, z, y), select(is_x | is_y | is_z, w, z)];
        (others, select(is_x, x, select(is_y, y, select(is_z, z, w))))
    }
}

/// The index of the greatest, the first of equals.
#[inline(always)]
pub(super) fn greatest<V: Simd>([x, y, z, w]: [V::Int; 4]) -> V::Int {
    let (mut index, mut most) = (V::Int::splat(0), x);
    for (i, c) in [(1, y), (2, z), (3, w)] {
        index = V::Int::select(most.lt(c), V::Int::splat(i), index);
        most = most.max(c);
    }
    index
}

/// The component of the greatest magnitude, the first of equals.
#[inline(always)]
pub(super) fn largest<V: Simd>(q: [V; 4]) -> V::Int {
    // Magnitudes of floats stand in the order of their bits.
    greatest::<V>(q.each(
        #[inline(always)]
        |c| c.abs().to_bits(),
    ))
}

/// A quaternion of integers in the chart of its largest component.
#[inline(always)]
pub(super) fn in_chart_of_largest<V: Simd>(q: [V::Int; 4]) -> Point<V> {
    let index = greatest::<V>(q.each(
        #[inline(always)]
        |c| c.abs(),
    ));
    let (others, left_out) = LeftOut::<V>::new(index).remove(q, V::Int::select);
    let negative = left_out.lt(V::Int::splat(0));
    let others = others.each(
        #[inline(always)]
        |c| V::Int::select(negative, -c, c),
    );
    (others, index)
}

/// One point or another, lane by lane.
#[inline(always)]
pub(super) fn select_point<V: Simd>(mask: V::Mask, yes: Point<V>, no: Point<V>) -> Point<V> {
    let ([a, b, c], [d, e, f]) = (yes.0, no.0);
    let fields =
        [V::Int::select(mask, a, d), V::Int::select(mask, b, e), V::Int::select(mask, c, f)];
    (fields, V::Int::select(mask, yes.1, no.1))
}

/// The two integers from -m to m around `x`, or twice the nearest.
#[inline(always)]
pub(super) fn around_within<V: Simd>(x: V, m: i32) -> [V::Int; 2] {
    around(x).each(
        #[inline(always)]
        |i| i.max(V::Int::splat(-m)).min(V::Int::splat(m)),
    )
}

/// Where the three integers, snorm of `BITS` bits each, and the index stand in a code.
pub(super) trait Layout: 'static {
    type Words: Words;
    const BITS: u32;
    /// The greatest snorm.
    const M: i32 = snorm_max(Self::BITS);

    fn pack<V: Simd>(point: Point<V>) -> <Self::Words as Words>::Packed<V>;
    /// The fields, of which only the low bits count, and the index.
    fn fields<V: Simd>(code: <Self::Words as Words>::Packed<V>) -> Point<V>;

    /// The pattern out of range reads as its neighbour.
    #[inline(always)]
    fn unpack<V: Simd>(code: <Self::Words as Words>::Packed<V>) -> Point<V> {
        let (fields, index) = Self::fields::<V>(code);
        let fields = fields.each(
            #[inline(always)]
            |f| f.sign_extend(Self::BITS).max(V::Int::splat(-Self::M)),
        );
        (fields, index)
    }
}

/// 10-10-10-2.
pub(super) struct Tens;
/// A field in the low 15 bits of each of three words. The top bits of the first and the second are
/// the index; that of the third is spare.
pub(super) struct Fifteens;
/// 20-20-20, two spare bits, and 2.
pub(super) struct Twenties;

impl Layout for Tens {
    type Words = One;
    const BITS: u32 = 10;

    #[inline(always)]
    fn pack<V: Simd>(([i, j, l], index): Point<V>) -> V::Int {
        i.low(10) | j.low(10).shl(10) | l.low(10).shl(20) | index.shl(30)
    }
    #[inline(always)]
    fn fields<V: Simd>(code: V::Int) -> Point<V> {
        ([code, code.shr(10), code.shr(20)], code.shr(30))
    }
}

impl Layout for Fifteens {
    type Words = Three;
    const BITS: u32 = 15;

    #[inline(always)]
    fn pack<V: Simd>(([i, j, l], index): Point<V>) -> [V::Int; 3] {
        [i.low(15) | index.shl(15), j.low(15) | index.shr(1).shl(15), l.low(15)]
    }
    #[inline(always)]
    fn fields<V: Simd>(code: [V::Int; 3]) -> Point<V> {
        (code, code[0].shr(15).low(1) | code[1].shr(15).low(1).shl(1))
    }
}

impl Layout for Twenties {
    type Words = Two;
    const BITS: u32 = 20;

    #[inline(always)]
    fn pack<V: Simd>(([i, j, l], index): Point<V>) -> [V::Int; 2] {
        [i.low(20) | j.shl(20), j.low(20).shr(12) | l.low(20).shl(8) | index.shl(30)]
    }
    #[inline(always)]
    fn fields<V: Simd>([low, high]: [V::Int; 2]) -> Point<V> {
        ([low, low.shr(20) | high.shl(12), high.shr(8)], high.shr(30))
    }
}

/// A code of a layout in lanes.
pub(super) type Code<Y, V> = <<Y as Layout>::Words as Words>::Packed<V>;
