//! Vectors of `f64`, which become `f32` of the same direction.

use super::columns::Columns;
use super::layout::{Read, columns, columns_mut};

/// Vectors of three native doubles in bytes. One begins every `stride` bytes.
#[derive(Clone, Copy)]
pub struct Doubles<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) stride: usize,
    pub(crate) keeps: Keeps,
}

impl<'a> Doubles<'a> {
    /// Vectors of `N` doubles, of which the first three count.
    #[inline]
    pub(crate) fn rows<const N: usize>(vectors: &'a [[f64; N]], keeps: Keeps) -> Self {
        const {
            assert!(N >= 3, "a vector has at least three components: use [f64; 3] or longer arrays")
        };
        let bytes = bytemuck::cast_slice(vectors.as_flattened());
        Doubles { bytes, stride: 8 * N, keeps }
    }
}

impl<'a> Read<'a> for Doubles<'a> {
    type Kind = Columns<3>;
    type Buffer<const LEN: usize> = Option<[[f32; LEN]; 3]>;
    const COLUMNS: usize = 3;
    const SIZE: usize = 24;

    fn row_bytes(&self) -> usize {
        self.bytes.len()
    }
    #[inline]
    fn direct(self) -> Option<[&'a [f32]; 3]> {
        None
    }
    fn part<'b, const LEN: usize>(
        &'b self,
        first: usize,
        len: usize,
        buffer: &'b mut Option<[[f32; LEN]; 3]>,
    ) -> [&'b [f32]; 3] {
        let buffer = buffer.get_or_insert([[0.0; LEN]; 3]);
        if let Some(rows) = self.bytes.get(first * self.stride..)
            && let Some(columns) = columns_mut(buffer, len)
        {
            gather(rows, self.stride, self.keeps, columns);
        }
        columns(buffer, len)
    }
}

#[inline(never)]
fn gather(rows: &[u8], stride: usize, keeps: Keeps, columns: [&mut [f32]; 3]) {
    match stride {
        24 => gather_rows(rows.as_chunks().0.iter(), keeps, columns),
        _ => {
            let rows = rows.chunks(stride.max(1)).map(|row| row.first_chunk().unwrap_or(&[0; 24]));
            gather_rows(rows, keeps, columns);
        }
    }
}

#[inline(always)]
fn gather_rows<'a>(
    rows: impl Iterator<Item = &'a [u8; 24]>,
    keeps: Keeps,
    [x, y, z]: [&mut [f32]; 3],
) {
    for (((row, x), y), z) in rows.zip(x).zip(y).zip(z) {
        let v = keeps.of(vector(row));
        // Mostly they are in range. It is so surely if this sum is, which takes less to find than the greatest of them.
        let sum = v[0].abs() + v[1].abs() + v[2].abs();
        [*x, *y, *z] =
            if (1e-11..1e12).contains(&sum) { v.map(|c| c as f32) } else { to_f32(v, keeps) };
    }
}

#[inline(always)]
fn vector(row: &[u8; 24]) -> [f64; 3] {
    let doubles = row.as_chunks().0;
    [0, 1, 2].map(|i| doubles.get(i).map_or(0.0, |bytes| f64::from_ne_bytes(*bytes)))
}

/// What a format has of a vector.
#[derive(Clone, Copy)]
pub enum Keeps {
    Direction,
    /// z < 0 is taken as 0, before a length is looked at: beside it, x and y could vanish. -Z alone is then +Z.
    UpperDirection,
    /// All of it.
    Floats,
}

impl Keeps {
    #[inline(always)]
    fn of(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let up = if x.abs() + y.abs() > 0.0 { 0.0 } else { 1.0 };
        [x, y, if matches!(self, Keeps::UpperDirection) && z < 0.0 { up } else { z }]
    }
}

/// The greatest |component| as bits, which are in the order of what they stand for, with infinity and then NaN last.
#[inline(always)]
fn magnitude(v: [f64; 3]) -> u64 {
    let [x, y, z] = v.map(|c| c.abs().to_bits());
    x.max(y).max(z)
}

/// Whether the greatest |component| is from 2^-40 to below 2^41: see
/// [`sanitize`](crate::formula::support::sanitize::sanitize).
#[inline(always)]
fn is_in_range(v: [f64; 3]) -> bool {
    const EXPONENTS: core::ops::RangeInclusive<u64> = 1023 - 40..=1023 + 40;
    EXPONENTS.contains(&(magnitude(v) >> 52))
}

/// A vector of `f32` of the same direction, each component rounded once. Infinite components give the limit; zero and NaN stay
/// what they are.
#[inline]
pub(crate) fn to_f32(v: [f64; 3], keeps: Keeps) -> [f32; 3] {
    const INFINITE: u64 = 2047;
    let v = keeps.of(v);
    if is_in_range(v) || matches!(keeps, Keeps::Floats) {
        return v.map(|c| c as f32);
    }
    let magnitude = magnitude(v);
    let exponent = magnitude >> 52;
    if exponent == INFINITE {
        let is_infinite = magnitude << 12 == 0;
        return v.map(|c| if is_infinite && c.is_finite() { 0.0 } else { c as f32 });
    }
    // Up to 2^40, by a power of two, so that no sign is lost that a smaller multiple would keep.
    let power = (1023 + 40 + 1023 - exponent).min(2046);
    let scale = f64::from_bits(power << 52);
    v.map(|c| (c * scale) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_in_range_are_rounded_alone() {
        let v = [1.0 + 1e-9, -3e-30, 1e12];
        assert_eq!(to_f32(v, Keeps::Direction), v.map(|c| c as f32));
    }

    #[test]
    fn others_are_scaled_by_a_power_of_two() {
        let v = [0.75, -0.25, 1.5];
        for power in [-1000, -300, -45, 45, 300, 1000] {
            let [x, y, z] = to_f32(v.map(|c| c * 2f64.powi(power)), Keeps::Direction);
            assert_eq!([x / z, y / z], [0.5, -1.0 / 6.0]);
            assert!((1e6..1e13).contains(&z), "{power}: {z}");
        }
        // The least and the greatest there are.
        assert_eq!(
            to_f32([f64::MAX, -f64::MAX, 0.0], Keeps::Direction)[..2],
            [2f32.powi(41), -(2f32.powi(41))]
        );
        let [x, y, _] = to_f32([5e-324, -5e-324, 0.0], Keeps::Direction);
        assert!(x > 0.0 && y == -x);
    }

    #[test]
    fn what_is_no_direction_stays_none() {
        assert_eq!(to_f32([0.0, -0.0, 0.0], Keeps::Direction), [0.0; 3]);
        assert!(to_f32([1.0, f64::NAN, f64::INFINITY], Keeps::Direction)[1].is_nan());
        let infinite = to_f32([1e300, f64::NEG_INFINITY, f64::INFINITY], Keeps::Direction);
        assert_eq!(infinite, [0.0, f32::NEG_INFINITY, f32::INFINITY]);
    }

    #[test]
    fn in_a_hemisphere_what_is_below_counts_for_nothing() {
        let v = [3e-200, -4e-200, -1e200];
        assert_eq!(to_f32(v, Keeps::Direction)[..2], [0.0, -0.0]);
        let [x, y, z] = to_f32(v, Keeps::UpperDirection);
        assert!(z == 0.0 && (x / -y - 0.75).abs() < 1e-6);
        assert_eq!(to_f32([0.0, 1.0, f64::NEG_INFINITY], Keeps::UpperDirection), [0.0, 1.0, 0.0]);
    }

    #[test]
    fn floats_keep_their_length() {
        let v = [1e-30, f64::INFINITY, 1e300];
        assert_eq!(to_f32(v, Keeps::Floats), [1e-30, f32::INFINITY, f32::INFINITY]);
    }
}
