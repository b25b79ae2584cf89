//! Spherical Fibonacci points in any number.

use crate::batch::layout::{self, Codes, CodesMut, Vectors, VectorsMut};
use crate::error::LengthMismatch;
use crate::formula::fibonacci::Fibonacci;
use crate::formula::{Formula, Kernels};
use crate::simd::I32x1;
use crate::vector::{Soa, SoaMut};

/// Spherical Fibonacci of any number of points from 1 to 2^24: nearly the same area around each, on a
/// spiral from +Z to -Z. Point i has z = 1 - (2 i + 1) / N and the azimuth 2 pi i / golden ratio, whose turns are
/// counted in units of 2^-32.
///
/// The greatest error is below 2.8 / sqrt(N) radians from two points on, the mean about 1.35 / sqrt(N). [`Fibonacci16`](crate::Fibonacci16) and
/// [`Fibonacci24`](crate::Fibonacci24) are the same of 2^16 and 2^24 points.
///
/// ```
/// use unitpack::SphericalFibonacci;
/// let points = SphericalFibonacci::new(1000).ok_or("not from 1 to 2^24")?;
/// let index = points.encode([0.0, 3.0, 4.0]);
/// let v = points.decode(index);
/// assert!((v[1] - 0.6).abs() < 0.1);
/// assert_eq!(points.encode(v), index);
/// # Ok::<(), &str>(())
/// ```
///
/// Source: Keinert, Innmann, Sänger and Stamminger, "Spherical Fibonacci Mapping", 2015.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SphericalFibonacci(Fibonacci);

impl SphericalFibonacci {
    /// A number of points from 1 to 2^24, otherwise `None`.
    #[inline]
    pub const fn new(points: u32) -> Option<Self> {
        if points >= 1 && points <= 1 << 24 {
            Some(SphericalFibonacci(Fibonacci::new(points)))
        } else {
            None
        }
    }

    /// How many points there are.
    #[inline]
    pub const fn points(self) -> u32 {
        self.0.points()
    }

    /// The index of the point nearest to a vector of any length. Zero and NaN are taken as +Z, an infinite
    /// component as the limit direction.
    #[inline]
    pub fn encode(self, v: [f32; 3]) -> u32 {
        let v = self.0.prepare::<f32>(v.into());
        self.0.encode(v).0 as u32
    }

    /// A point, of length 1 to 2.5e-7. Indices beyond the last read as the last.
    #[inline]
    pub fn decode(self, index: u32) -> [f32; 3] {
        self.0.decode::<f32>(I32x1(index as i32)).to_array()
    }

    /// [`encode`](SphericalFibonacci::encode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    pub fn encode_soa(self, v: Soa<'_>, indices: &mut [u32]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), indices.len())?;
        layout::encode(Vectors::from(v), CodesMut::native(indices), &mut |v, codes| {
            Kernels::encode(&self.0, v, codes);
        });
        Ok(())
    }

    /// [`decode`](SphericalFibonacci::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    pub fn decode_soa(self, indices: &[u32], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), indices.len())?;
        layout::decode(Codes::native(indices), VectorsMut::from(v), &mut |codes, v, fence| {
            Kernels::decode(&self.0, codes, v, fence);
        });
        Ok(())
    }
}
