//! The four charts of the rotations. In each, one component is left out, and the three others are
//! stored in their order.

use crate::formula::{One, Three, Two, Words, around};
use crate::lane::{Each, Lane, LaneInt};
use crate::layout::snorm_max;

/// Three stored integers, and which component is left out: 0 to 3 for x to w.
pub(super) type Point<L> = ([<L as Lane>::Int; 3], <L as Lane>::Int);

/// Which component is left out.
pub(super) struct LeftOut<L: Lane> {
    is_x: L::Mask,
    is_y: L::Mask,
    is_z: L::Mask,
}

impl<L: Lane> LeftOut<L> {
    #[inline(always)]
    pub(super) fn new(index: L::Int) -> Self {
        let [is_x, is_y, is_z] = [0, 1, 2].each(
            #[inline(always)]
            |i| index.eq(L::Int::splat(i)),
        );
        LeftOut { is_x, is_y, is_z }
    }

    /// The quaternion of the three others and this one. `select` chooses lane by lane.
    #[inline(always)]
    pub(super) fn insert<T: Copy>(
        &self,
        [i, j, l]: [T; 3],
        left_out: T,
        select: impl Fn(L::Mask, T, T) -> T,
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
        select: impl Fn(L::Mask, T, T) -> T,
    ) -> ([T; 3], T) {
        let LeftOut { is_x, is_y, is_z } = *self;
        let others =
            [select(is_x, y, x), select(is_x | is_y, z, y), select(is_x | is_y | is_z, w, z)];
        (others, select(is_x, x, select(is_y, y, select(is_z, z, w))))
    }
}

/// The index of the greatest, the first of equals.
#[inline(always)]
pub(super) fn greatest<L: Lane>([x, y, z, w]: [L::Int; 4]) -> L::Int {
    let (mut index, mut most) = (L::Int::splat(0), x);
    for (i, c) in [(1, y), (2, z), (3, w)] {
        index = L::Int::select(most.lt(c), L::Int::splat(i), index);
        most = most.max(c);
    }
    index
}

/// The component of the greatest magnitude, the first of equals.
#[inline(always)]
pub(super) fn largest<L: Lane>(q: [L; 4]) -> L::Int {
    // Magnitudes of floats stand in the order of their bits.
    greatest::<L>(q.each(
        #[inline(always)]
        |c| c.abs().to_bits(),
    ))
}

/// A quaternion of integers in the chart of its largest component.
#[inline(always)]
pub(super) fn in_chart_of_largest<L: Lane>(q: [L::Int; 4]) -> Point<L> {
    let index = greatest::<L>(q.each(
        #[inline(always)]
        |c| c.abs(),
    ));
    let (others, left_out) = LeftOut::<L>::new(index).remove(q, L::Int::select);
    let negative = left_out.lt(L::Int::splat(0));
    let others = others.each(
        #[inline(always)]
        |c| L::Int::select(negative, -c, c),
    );
    (others, index)
}

/// One point or another, lane by lane.
#[inline(always)]
pub(super) fn select_point<L: Lane>(mask: L::Mask, yes: Point<L>, no: Point<L>) -> Point<L> {
    let ([a, b, c], [d, e, f]) = (yes.0, no.0);
    let fields =
        [L::Int::select(mask, a, d), L::Int::select(mask, b, e), L::Int::select(mask, c, f)];
    (fields, L::Int::select(mask, yes.1, no.1))
}

/// The two integers from -m to m around `x`, or twice the nearest.
#[inline(always)]
pub(super) fn around_within<L: Lane>(x: L, m: i32) -> [L::Int; 2] {
    around(x).each(
        #[inline(always)]
        |i| i.max(L::Int::splat(-m)).min(L::Int::splat(m)),
    )
}

/// Where the three integers, snorm of `BITS` bits each, and the index stand in a code.
pub(super) trait Layout: 'static {
    type Words: Words;
    const BITS: u32;
    /// The greatest snorm.
    const M: i32 = snorm_max(Self::BITS);

    fn pack<L: Lane>(point: Point<L>) -> <Self::Words as Words>::Packed<L>;
    /// The fields, of which only the low bits count, and the index.
    fn fields<L: Lane>(code: <Self::Words as Words>::Packed<L>) -> Point<L>;

    /// The pattern out of range reads as its neighbour.
    #[inline(always)]
    fn unpack<L: Lane>(code: <Self::Words as Words>::Packed<L>) -> Point<L> {
        let (fields, index) = Self::fields::<L>(code);
        let fields = fields.each(
            #[inline(always)]
            |f| f.sign_extend(Self::BITS).max(L::Int::splat(-Self::M)),
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
    fn pack<L: Lane>(([i, j, l], index): Point<L>) -> L::Int {
        i.low(10) | j.low(10).shl(10) | l.low(10).shl(20) | index.shl(30)
    }
    #[inline(always)]
    fn fields<L: Lane>(code: L::Int) -> Point<L> {
        ([code, code.shr(10), code.shr(20)], code.shr(30))
    }
}

impl Layout for Fifteens {
    type Words = Three;
    const BITS: u32 = 15;

    #[inline(always)]
    fn pack<L: Lane>(([i, j, l], index): Point<L>) -> [L::Int; 3] {
        [i.low(15) | index.shl(15), j.low(15) | index.shr(1).shl(15), l.low(15)]
    }
    #[inline(always)]
    fn fields<L: Lane>(code: [L::Int; 3]) -> Point<L> {
        (code, code[0].shr(15).low(1) | code[1].shr(15).low(1).shl(1))
    }
}

impl Layout for Twenties {
    type Words = Two;
    const BITS: u32 = 20;

    #[inline(always)]
    fn pack<L: Lane>(([i, j, l], index): Point<L>) -> [L::Int; 2] {
        [i.low(20) | j.shl(20), j.low(20).shr(12) | l.low(20).shl(8) | index.shl(30)]
    }
    #[inline(always)]
    fn fields<L: Lane>([low, high]: [L::Int; 2]) -> Point<L> {
        ([low, low.shr(20) | high.shl(12), high.shr(8)], high.shr(30))
    }
}

/// A code of a layout in lanes.
pub(super) type Code<Y, L> = <<Y as Layout>::Words as Words>::Packed<L>;
