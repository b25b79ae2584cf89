//! Of q and -q, which are one rotation, the one that a caller wants.

use crate::batch::layout::{Codes, PART, VectorsMut};

/// `q`, or -q if that is nearer to `previous`.
#[inline]
pub(super) fn near(q: [f32; 4], previous: [f32; 4]) -> [f32; 4] {
    let [x, y, z, w] = q;
    let [a, b, c, d] = previous;
    if x * a + y * b + z * c + w * d < 0.0 { q.map(|c| -c) } else { q }
}

/// To which rotation each of many is to be near.
pub(super) enum To {
    /// The one that it replaces.
    Replaced,
    /// The one before it, and at first this one.
    Before([f32; 4]),
}

/// Decodes a part at a time to quaternions near others.
#[inline(never)]
pub(super) fn decode_near(
    decode: &dyn Fn(Codes<'_>, VectorsMut<'_, 4>),
    codes: Codes<'_>,
    quaternions: &mut [[f32; 4]],
    mut to: To,
) {
    let mut room = [[0.0; 4]; PART];
    for (codes, quaternions) in codes.parts(PART).zip(quaternions.chunks_mut(PART)) {
        if let Some(decoded) = room.get_mut(..quaternions.len()) {
            decode(codes, VectorsMut::rows(decoded));
        }
        for (q, &decoded) in quaternions.iter_mut().zip(&room) {
            match &mut to {
                To::Replaced => *q = near(decoded, *q),
                To::Before(before) => {
                    *q = near(decoded, *before);
                    *before = *q;
                }
            }
        }
    }
}
