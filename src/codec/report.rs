//! What packing does to given vectors, and which format is fine enough.

use super::{Codec, Format};
use crate::batch::layout::{self, Codes, VectorsMut};
use crate::error::LengthMismatch;
use crate::formula::support::sanitize::sanitize;
use crate::simd::Vec3;
use crate::simd::math::{atan2_half_turns, inv_sqrt};
use crate::vector::Soa;

/// The errors of codes, which are the angles between the vectors they were made of and those that they decode
/// to. See [`ErrorReport::of`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ErrorReport {
    /// How many vectors there are. Without any, all else is 0.
    pub count: usize,
    /// The mean error in degrees.
    pub mean_degrees: f64,
    /// The root of the mean squared error in degrees.
    pub rms_degrees: f64,
    /// The greatest error in degrees.
    pub max_degrees: f64,
    /// The index of the first vector with the greatest error.
    pub worst: usize,
}

impl ErrorReport {
    /// The errors of `codes`, the codes of the vectors `v`: each angle to 5e-7 of itself, sums in double
    /// precision.
    ///
    /// Vectors may have any length; as in encoding, zero and NaN count as +Z, and an infinite component as the
    /// limit direction. A hemisphere's codec is measured against z as it is, also below 0.
    ///
    /// ```
    /// use unitpack::{Codec, ErrorReport, Oct16, Soa};
    /// let [x, y, z] = [[1.0, 0.3], [0.0, -0.4], [0.0, 0.5]];
    /// let v = || Soa { x: &x, y: &y, z: &z };
    /// let mut codes = [0; 2];
    /// Oct16::encode_soa_precise(v(), &mut codes)?;
    /// let report = ErrorReport::of::<Oct16>(v(), &codes)?;
    /// assert_eq!(report.worst, 1); // Axes survive exactly.
    /// assert!(report.max_degrees < Oct16::FORMAT.max_error_precise_degrees());
    /// # Ok::<(), unitpack::LengthMismatch>(())
    /// ```
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long.
    #[inline]
    pub fn of<C: Codec>(v: Soa<'_>, codes: &[C::Code]) -> Result<Self, LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), codes.len())?;
        Ok(Self::of_codes(v, &C::decode_batch, Codes::native(codes)))
    }

    #[inline(never)]
    fn of_codes(
        v: Soa<'_>,
        decode: &dyn Fn(Codes<'_>, VectorsMut<'_, 3>),
        codes: Codes<'_>,
    ) -> Self {
        let mut report = ErrorReport::default();
        let (mut sum, mut squares) = (0.0, 0.0);
        let mut vectors = v.x.iter().zip(v.y).zip(v.z);
        layout::decode_for(decode, codes, &mut |[x, y, z]| {
            for (((x, y), z), v) in x.iter().zip(y).zip(z).zip(&mut vectors) {
                let ((a, b), c) = v;
                let error = degrees_between([*a, *b, *c], [*x, *y, *z]);
                sum += error;
                squares += error * error;
                if error > report.max_degrees {
                    (report.max_degrees, report.worst) = (error, report.count);
                }
                report.count += 1;
            }
        });
        if report.count > 0 {
            let count = report.count as f64;
            report.mean_degrees = sum / count;
            report.rms_degrees = root(squares / count);
        }
        report
    }
}

impl Format {
    /// The format of the whole sphere whose codes take the fewest [bytes](Format::code_size) among those whose
    /// [`encode_precise`](Codec::encode_precise) is never off by more than `max_error_degrees`; of several the
    /// one with the fewest [bits](Format::bits), and then the finest. `None` if the bound is below 0 or NaN.
    ///
    /// ```
    /// use unitpack::Format;
    /// assert_eq!(Format::cheapest(0.53), Some(Format::WarpedOct16));
    /// assert_eq!(Format::cheapest(0.0), Some(Format::Float32x3));
    /// ```
    pub fn cheapest(max_error_degrees: f64) -> Option<Format> {
        let error = Format::max_error_precise_degrees;
        let fine = |f: &Format| !f.is_hemisphere() && error(*f) <= max_error_degrees;
        Format::ALL.iter().copied().filter(fine).min_by(|a, b| {
            let size = |f: &Format| (f.code_size(), f.bits());
            size(a).cmp(&size(b)).then(error(*a).total_cmp(&error(*b)))
        })
    }
}

/// The angle between two vectors of any kind.
fn degrees_between(v: [f32; 3], w: [f32; 3]) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let unit = |v: [f32; 3]| {
        let v = sanitize(Vec3::from(v)).to_array().map(f64::from);
        let length = root(dot(v, v));
        v.map(|c| c / length)
    };
    let (a, b) = (unit(v), unit(w));
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    // The arc tangent's relative error is that of f32, however small the angle.
    let sine = root(dot(cross, cross));
    f64::from(atan2_half_turns(sine as f32, dot(a, b) as f32)) * 180.0
}

/// The square root, which `core` does not have: that of f32 and one step of Newton's method, for at
/// most 1e30. Below 1e-30, 0.
fn root(x: f64) -> f64 {
    if x < 1e-30 {
        return 0.0;
    }
    let guess = x * f64::from(inv_sqrt(x as f32));
    0.5 * (guess + x / guess)
}
