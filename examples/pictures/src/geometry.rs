//! Where on a picture a direction lies.

use unitpack_test::vectors::{cross, dot, normalize};

pub type V3 = [f64; 3];

/// The sphere as seen from one side.
#[derive(Clone, Copy)]
pub struct View {
    /// Towards the right, up and towards the eye.
    axes: [V3; 3],
}

impl View {
    pub const FROM_PLUS_Z: View =
        View { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };
    pub const FROM_MINUS_Z: View =
        View { axes: [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]] };

    /// With `eye` in the middle, and +Z up, or +Y if it is +Z that is in the middle.
    pub fn from(eye: V3) -> View {
        let eye = normalize(eye);
        let up = if eye[2] == 1.0 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        let right = normalize(cross(up, eye));
        View { axes: [right, cross(eye, right), eye] }
    }

    fn world(&self, [right, up, eye]: V3) -> V3 {
        [0, 1, 2].map(|i| right * self.axes[0][i] + up * self.axes[1][i] + eye * self.axes[2][i])
    }

    /// Lambert's azimuthal equal-area projection: the near hemisphere fills the unit disc, the
    /// whole sphere one of radius sqrt(2).
    pub fn equal_area(&self, [right, up]: [f64; 2]) -> Option<V3> {
        let square = right * right + up * up;
        let stretch = (2.0 - square).max(0.0).sqrt();
        (square <= 2.0).then(|| self.world([right * stretch, up * stretch, 1.0 - square]))
    }

    /// Its inverse. The antipode of the eye lies nowhere.
    pub fn equal_area_inverse(&self, v: V3) -> Option<[f64; 2]> {
        let [right, up, eye] = self.axes.map(|axis| dot(axis, v));
        let shrink = (1.0 + eye).sqrt();
        (shrink > 1e-6).then(|| [right / shrink, up / shrink])
    }
}

pub fn in_disc([right, up]: [f64; 2]) -> bool {
    right * right + up * up <= 1.0
}
