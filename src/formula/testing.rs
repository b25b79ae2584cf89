//! What the families' unit tests share.

use super::Formula;
use crate::batch::storage::Word;
use crate::simd::Vec3;

/// A vector of each kind of place: near the pole, on an edge, and in octants below.
pub(crate) const VECTORS: [[f32; 3]; 5] =
    [[0.1, 0.2, 0.9], [-0.7, 0.7, 0.1], [0.3, -0.2, -0.4], [0.9, -0.01, -0.05], [-0.2, -0.9, -0.8]];

/// `count` vectors from pole to pole, round and round.
pub(crate) fn spiral(count: u8) -> impl Iterator<Item = [f32; 3]> {
    let step = 6.0 / f32::from(count);
    (0..count).map(f32::from).map(move |turn| {
        let (sin, cos) = (turn * 0.7).sin_cos();
        [sin, cos, turn * step - 2.95]
    })
}

/// Asserts that of the codes below `codes` the nearest to each vector is found.
pub(crate) fn assert_nearest<F: Formula<Shape = Word>>(
    formula: F,
    codes: i32,
    vectors: impl IntoIterator<Item = [f32; 3]>,
) {
    for v in vectors {
        let v = Vec3::from(v).normalize();
        let distance = |code: i32| formula.decode::<f32>(code.into()).distance_squared(v);
        let least = (0..codes).map(distance).fold(4.0, f32::min);
        assert!(distance(formula.encode_precise(v).0) <= least + 1e-7, "{v:?}");
    }
}
