//! The four charts of the rotations. In each, one component is left out, and the three others are
//! stored in their order.

use crate::batch::storage::{CodeShape, Word, Words2, Words3};
use crate::formula::support::bits::snorm_max;
use crate::formula::support::closest::floor_and_ceil;
use crate::simd::{Simd, SimdInt, Vec3, map_vec, map2, map4};

/// Three stored integers, and which component is left out.
#[derive(Clone, Copy)]
pub(super) struct Point<V: Simd> {
    pub(super) fields: Vec3<V::Int>,
    /// 0 to 3 for x to w.
    pub(super) left_out: V::Int,
}

impl<V: Simd> Point<V> {
    #[inline(always)]
    pub(super) fn select(mask: V::Mask, yes: Self, no: Self) -> Self {
        Point {
            fields: Vec3::select_int(mask, yes.fields, no.fields),
            left_out: V::Int::select(mask, yes.left_out, no.left_out),
        }
    }
}

/// Which component is left out.
#[derive(Clone, Copy)]
pub(super) struct LeftOut<V: Simd> {
    is_x: V::Mask,
    is_y: V::Mask,
    is_z: V::Mask,
}

/// Inserts one of four components, or removes it: once for floats and once for integers.
macro_rules! insert_and_remove {
    ($insert:ident, $remove:ident, $type:ty, $select:path) => {
        /// The quaternion of the three others and the component left out.
        #[inline(always)]
        pub(super) fn $insert(self, others: Vec3<$type>, left_out: $type) -> [$type; 4] {
            let LeftOut { is_x, is_y, is_z } = self;
            let Vec3 { x: i, y: j, z: l } = others;
            [
                $select(is_x, left_out, i),
                $select(is_x, i, $select(is_y, left_out, j)),
                $select(is_x | is_y, j, $select(is_z, left_out, l)),
                $select(is_x | is_y | is_z, l, left_out),
            ]
        }

        /// The three others, and the component left out.
        #[inline(always)]
        pub(super) fn $remove(self, [x, y, z, w]: [$type; 4]) -> (Vec3<$type>, $type) {
            let LeftOut { is_x, is_y, is_z } = self;
            let others = Vec3::new(
                $select(is_x, y, x),
                $select(is_x | is_y, z, y),
                $select(is_x | is_y | is_z, w, z),
            );
            (others, $select(is_x, x, $select(is_y, y, $select(is_z, z, w))))
        }
    };
}

impl<V: Simd> LeftOut<V> {
    #[inline(always)]
    pub(super) fn new(index: V::Int) -> Self {
        LeftOut { is_x: index.eq(0), is_y: index.eq(1), is_z: index.eq(2) }
    }

    insert_and_remove!(insert, remove, V, V::select);
    insert_and_remove!(insert_int, remove_int, V::Int, V::Int::select);
}

/// The index of the greatest, the first of equals.
#[inline(always)]
fn greatest<V: Simd>([x, y, z, w]: [V::Int; 4]) -> V::Int {
    let (mut index, mut most) = (V::Int::splat(0), x);
    for (i, c) in [(1, y), (2, z), (3, w)] {
        index = V::Int::select(most.lt(c), i, index);
        most = most.max(c);
    }
    index
}

/// The component of the greatest magnitude, the first of equals.
#[inline(always)]
pub(super) fn largest<V: Simd>(q: [V; 4]) -> V::Int {
    // Magnitudes of floats are in the order of their bits.
    greatest::<V>(map4!(q, |c| c.abs().to_bits()))
}

/// A quaternion of integers in the chart of its largest component.
#[inline(always)]
pub(super) fn in_chart_of_largest<V: Simd>(q: [V::Int; 4]) -> Point<V> {
    let index = greatest::<V>(map4!(q, |c| c.abs()));
    let (others, main) = LeftOut::<V>::new(index).remove_int(q);
    let fields = map_vec!(others, |c| c.negate_where_negative(main));
    Point { fields, left_out: index }
}

/// The integers around `x`, the nearer one first, clamped to -m to m.
#[inline(always)]
pub(super) fn floor_and_ceil_clamped<V: Simd>(x: V, m: i32) -> [V::Int; 2] {
    map2!(floor_and_ceil(x), |i| i.clamp(-m, m))
}

/// Where the three integers, snorm of some bits each, and the index are in a code.
pub(super) trait Layout: Copy + Send + Sync + 'static {
    type Shape: CodeShape;

    /// Bits of a field.
    fn bits(self) -> u32;
    fn pack<V: Simd>(self, point: Point<V>) -> Code<Self, V>;
    /// The fields, of which only the low bits count, and the index.
    fn fields<V: Simd>(self, code: Code<Self, V>) -> Point<V>;

    /// The greatest snorm.
    #[inline(always)]
    fn max(self) -> i32 {
        snorm_max(self.bits())
    }
    /// The pattern out of range reads as its neighbour.
    #[inline(always)]
    fn unpack<V: Simd>(self, code: Code<Self, V>) -> Point<V> {
        let point = self.fields::<V>(code);
        let fields = map_vec!(point.fields, |f| f.sign_extend(self.bits()).max(-self.max()));
        Point { fields, ..point }
    }
}

/// A code of a layout in lanes.
pub(super) type Code<Y, V> = <<Y as Layout>::Shape as CodeShape>::In<V>;

/// Three fields of at most 10 bits in a word, the first in the low bits, and the index above them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct OneWord {
    bits: u32,
}
/// Three fields of at most 20 bits in two words, the first in the low bits, and the index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TwoWords {
    bits: u32,
    /// Where the index begins.
    index: u32,
}
/// A field in the low 15 bits of each of three words. The top bits of the first and the second are
/// the index; that of the third is spare.
#[derive(Clone, Copy)]
pub(super) struct ThreeWords;

impl OneWord {
    /// Fields of at most 10 bits.
    pub(super) const fn new(bits: u32) -> Self {
        OneWord { bits }
    }
}

impl TwoWords {
    /// Fields of at most 20 bits, and the index from bit `index` on, above them.
    pub(super) const fn new(bits: u32, index: u32) -> Self {
        TwoWords { bits, index }
    }
}

impl Layout for OneWord {
    type Shape = Word;

    #[inline(always)]
    fn bits(self) -> u32 {
        self.bits
    }
    #[inline(always)]
    fn pack<V: Simd>(self, Point { fields, left_out }: Point<V>) -> V::Int {
        let Vec3 { x: i, y: j, z: l } = map_vec!(fields, |f| f.low_bits(self.bits));
        i | j.shl(self.bits) | l.shl(2 * self.bits) | left_out.shl(3 * self.bits)
    }
    #[inline(always)]
    fn fields<V: Simd>(self, code: V::Int) -> Point<V> {
        let fields = Vec3::new(code, code.shr_logical(self.bits), code.shr_logical(2 * self.bits));
        Point { fields, left_out: code.shr_logical(3 * self.bits).low_bits(2) }
    }
}

impl Layout for TwoWords {
    type Shape = Words2;

    #[inline(always)]
    fn bits(self) -> u32 {
        self.bits
    }
    #[inline(always)]
    fn pack<V: Simd>(self, Point { fields, left_out }: Point<V>) -> [V::Int; 2] {
        let Vec3 { x: i, y: j, z: l } = map_vec!(fields, |f| f.low_bits(self.bits));
        let [mut low, mut high] = [i, V::Int::splat(0)];
        for (field, at) in [(j, self.bits), (l, 2 * self.bits), (left_out, self.index)] {
            let part = put::<V>(field, at);
            (low, high) = (low | part[0], high | part[1]);
        }
        [low, high]
    }
    #[inline(always)]
    fn fields<V: Simd>(self, code: [V::Int; 2]) -> Point<V> {
        let fields = Vec3::new(code[0], get::<V>(code, self.bits), get::<V>(code, 2 * self.bits));
        Point { fields, left_out: get::<V>(code, self.index).low_bits(2) }
    }
}

impl Layout for ThreeWords {
    type Shape = Words3;

    #[inline(always)]
    fn bits(self) -> u32 {
        15
    }
    #[inline(always)]
    fn pack<V: Simd>(self, Point { fields, left_out }: Point<V>) -> [V::Int; 3] {
        let Vec3 { x: i, y: j, z: l } = map_vec!(fields, |f| f.low_bits(15));
        [i | left_out.shl(15), j | left_out.shr_logical(1).shl(15), l]
    }
    #[inline(always)]
    fn fields<V: Simd>(self, code: [V::Int; 3]) -> Point<V> {
        let low = code[0].shr_logical(15).low_bits(1);
        let high = code[1].shr_logical(15).low_bits(1);
        Point { fields: Vec3::from(code), left_out: low | high.shl(1) }
    }
}

/// A field that begins at bit `at`, from 1 to 63, of two words.
#[inline(always)]
pub(super) fn put<V: Simd>(field: V::Int, at: u32) -> [V::Int; 2] {
    if at < 32 {
        [field.shl(at), field.shr_logical(32 - at)]
    } else {
        [V::Int::splat(0), field.shl(at - 32)]
    }
}

/// What begins at bit `at`, from 1 to 63, of two words, and is followed by other bits.
#[inline(always)]
pub(super) fn get<V: Simd>([low, high]: [V::Int; 2], at: u32) -> V::Int {
    if at < 32 { low.shr_logical(at) | high.shl(32 - at) } else { high.shr_logical(at - 32) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::I32x1;

    const BITS10: OneWord = OneWord::new(10);
    const BITS20: TwoWords = TwoWords::new(20, 62);

    fn point(fields: [i32; 3], left_out: i32) -> Point<f32> {
        Point { fields: Vec3::from(fields.map(I32x1)), left_out: I32x1(left_out) }
    }

    fn parts(Point { fields, left_out }: Point<f32>) -> ([i32; 3], i32) {
        (fields.to_array().map(|f| f.0), left_out.0)
    }

    #[test]
    fn fields_are_where_the_layouts_say() {
        assert_eq!(BITS10.pack::<f32>(point([1, -1, 2], 3)).0 as u32, 0xC02F_FC01);
        // 3 << 12 | 2 << 8 | 15 << 4 | 1.
        assert_eq!(OneWord::new(4).pack::<f32>(point([1, -1, 2], 3)).0, 0x32F1);
        // Of each word 16 bits are stored.
        let words = |p| ThreeWords.pack::<f32>(p).map(|w| w.0 & 0xFFFF);
        assert_eq!(words(point([1, -1, 2], 1)), [0x8001, 0x7FFF, 0x0002]);
        assert_eq!(words(point([1, -1, 2], 2)), [0x0001, 0xFFFF, 0x0002]);
        let halves =
            |layout: TwoWords| layout.pack::<f32>(point([1, -1, 2], 3)).map(|w| w.0 as u32);
        assert_eq!(halves(BITS20), [0xFFF0_0001, 0xC000_02FF]);
        // 1, -1 from bit 12 on, 2 from bit 24 on and 3 from bit 36 on.
        assert_eq!(halves(TwoWords::new(12, 36)), [0x02FF_F001, 0x30]);
        // 2 from bit 32 on.
        assert_eq!(halves(TwoWords::new(16, 48)), [0xFFFF_0001, 0x3_0002]);
    }

    #[test]
    fn fields_come_back_without_spare_bits() {
        let fields = [1, -1, 2];
        assert_eq!(parts(BITS10.unpack::<f32>(I32x1(0xC02F_FC01_u32 as i32))), (fields, 3));
        assert_eq!(parts(OneWord::new(4).unpack::<f32>(I32x1(0xF_72F1))), (fields, 3));
        let words = [0x0001, 0xFFFF, 0x8002].map(I32x1);
        assert_eq!(parts(ThreeWords.unpack::<f32>(words)), (fields, 2));
        let halves = [0xFFF0_0001_u32, 0xF000_02FF].map(|w| I32x1(w as i32));
        assert_eq!(parts(BITS20.unpack::<f32>(halves)), (fields, 3));
        let halves = [0x02FF_F001_u32, 0xFFFF_FFF0].map(|w| I32x1(w as i32));
        assert_eq!(parts(TwoWords::new(12, 36).unpack::<f32>(halves)), (fields, 3));
        let halves = [0xFFFF_0001_u32, 0xFFFE_0002].map(|w| I32x1(w as i32));
        assert_eq!(parts(TwoWords::new(16, 48).unpack::<f32>(halves)), (fields, 2));
    }

    #[test]
    fn the_pattern_out_of_range_reads_as_its_neighbour() {
        assert_eq!(parts(BITS10.unpack::<f32>(I32x1(0x200))), ([-511, 0, 0], 0));
        assert_eq!(
            parts(ThreeWords.unpack::<f32>([0, 0x4000, 0].map(I32x1))),
            ([0, -16_383, 0], 0)
        );
        assert_eq!(parts(BITS20.unpack::<f32>([0, 0x0800_0000].map(I32x1))), ([0, 0, -524_287], 0));
    }

    #[test]
    fn components_keep_their_order() {
        for index in 0..4 {
            let chart = LeftOut::<f32>::new(I32x1(index));
            let others = Vec3::new(1.0, 2.0, 3.0);
            let inserted = chart.insert(others, 9.0);
            let mut expected = [1.0, 2.0, 3.0, 9.0];
            expected[index as usize..].rotate_right(1);
            assert_eq!(inserted, expected);
            assert_eq!(chart.remove(inserted), (others, 9.0));
        }
    }

    #[test]
    fn of_equals_the_first_is_the_largest() {
        for (q, index) in [
            ([1.0, -1.0, 1.0, 1.0], 0),
            ([0.5, -1.0, 1.0, 1.0], 1),
            ([0.5, 0.0, -1.0, 1.0], 2),
            ([0.5, 0.0, 0.7, -1.0], 3),
        ] {
            assert_eq!(largest(q).0, index);
        }
        // Made positive by the opposite of all.
        let there = in_chart_of_largest::<f32>([3, -7, 7, 1].map(I32x1));
        assert_eq!(parts(there), ([-3, -7, -1], 1));
    }

    #[test]
    fn the_nearer_integer_comes_first() {
        for (x, around) in
            [(2.3, [2, 3]), (2.7, [3, 2]), (-2.3, [-2, -3]), (6.9, [7, 6]), (7.2, [7, 7])]
        {
            assert_eq!(floor_and_ceil_clamped(x, 7).map(|i| i.0), around);
        }
    }
}
