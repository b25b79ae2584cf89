//! The axis of a face.

use crate::simd::{Simd, SimdInt, Vec3};

/// One of the three axes in each lane.
#[derive(Clone, Copy)]
pub(super) struct Axis<V: Simd> {
    pub(super) is_x: V::Mask,
    pub(super) is_y: V::Mask,
}

impl<V: Simd> Axis<V> {
    /// Axis 0, 1 or 2.
    #[inline(always)]
    pub(super) fn new(index: V::Int) -> Self {
        Axis { is_x: index.eq(0), is_y: index.eq(1) }
    }

    /// 0, 1 or 2.
    #[inline(always)]
    pub(super) fn index(self) -> V::Int {
        V::Int::select(self.is_x, 0, V::Int::select(self.is_y, 1, 2))
    }

    #[inline(always)]
    pub(super) fn pick_int(self, [x, y, z]: [V::Int; 3]) -> V::Int {
        V::Int::select(self.is_x, x, V::Int::select(self.is_y, y, z))
    }

    #[inline(always)]
    pub(super) fn pick(self, [x, y, z]: [V; 3]) -> V {
        V::select(self.is_x, x, V::select(self.is_y, y, z))
    }

    /// Rotates components so that this axis is first.
    #[inline(always)]
    pub(super) fn first(self, v: Vec3<V>) -> Vec3<V> {
        let Vec3 { x, y, z } = v;
        Vec3::new(self.pick([x, y, z]), self.pick([y, z, x]), self.pick([z, x, y]))
    }

    /// [`first`](Axis::first) for integers.
    #[inline(always)]
    pub(super) fn first_int(self, v: Vec3<V::Int>) -> Vec3<V::Int> {
        let Vec3 { x, y, z } = v;
        Vec3::new(self.pick_int([x, y, z]), self.pick_int([y, z, x]), self.pick_int([z, x, y]))
    }

    /// The inverse of [`first`](Axis::first).
    #[inline(always)]
    pub(super) fn back(self, v: Vec3<V>) -> Vec3<V> {
        let Vec3 { x: main, y: a, z: b } = v;
        Vec3::new(self.pick([main, b, a]), self.pick([a, main, b]), self.pick([b, a, main]))
    }

    /// [`back`](Axis::back) for integers.
    #[inline(always)]
    pub(super) fn back_int(self, v: Vec3<V::Int>) -> Vec3<V::Int> {
        let Vec3 { x: main, y: a, z: b } = v;
        Vec3::new(
            self.pick_int([main, b, a]),
            self.pick_int([a, main, b]),
            self.pick_int([b, a, main]),
        )
    }
}

/// The axis of the largest component, X before Y before Z, and the vector with that component first.
#[inline(always)]
pub(super) fn largest_first<V: Simd>(v: Vec3<V>) -> (Axis<V>, Vec3<V>) {
    let Vec3 { x, y, z } = v.abs();
    let is_x = y.le(x) & z.le(x);
    let axis = Axis { is_x, is_y: !is_x & z.le(y) };
    (axis, axis.first(v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_equals_the_first_axis_is_the_largest() {
        for (v, index) in [
            ([1.0f32, -1.0, 1.0], 0),
            ([0.5, -1.0, 1.0], 1),
            ([0.5, 0.5, -1.0], 2),
            ([-2.0, 1.0, 1.5], 0),
            ([1.0, 1.0, 2.0], 2),
        ] {
            assert_eq!(largest_first(Vec3::from(v)).0.index().0, index, "{v:?}");
        }
    }

    #[test]
    fn components_are_turned_and_turned_back() {
        let turned = [[5, 6, 7], [6, 7, 5], [7, 5, 6]];
        for (index, first) in (0..).zip(turned) {
            let axis = Axis::<f32>::new(index.into());
            let v = Vec3::from([5, 6, 7].map(crate::simd::I32x1));
            assert_eq!(axis.first_int(v).to_array().map(|i| i.0), first);
            assert_eq!(axis.back_int(axis.first_int(v)), v);
            let v = Vec3::new(5.0, 6.0, 7.0);
            assert_eq!(axis.first(v).to_array(), first.map(|i| i as f32));
            assert_eq!(axis.back(axis.first(v)), v);
        }
    }
}
