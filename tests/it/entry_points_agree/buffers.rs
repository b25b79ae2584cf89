//! Slices in larger buffers, filled with what nobody else writes.

use unitpack::{Format, Soa, SoaMut};
use unitpack_test::codes::last_pattern;
use unitpack_test::{Arrays, Code, UNWRITTEN, Vector};

/// A byte that is unlikely to be written.
pub const SENTINEL: u8 = 0xA5;

/// Elements around a slice that nothing may be written to.
pub const MARGIN: usize = 8;

/// A code of [`SENTINEL`]s.
pub fn sentinel(format: Format) -> Code {
    Code::from_le_bytes([SENTINEL; 16]) & last_pattern(format)
}

/// `margin` elements before and after `middle`, [`MARGIN`] in all.
pub fn surrounded<T: Clone>(middle: &[T], offset: usize, margin: T) -> Vec<T> {
    let around = |n: usize| vec![margin.clone(); n];
    [around(offset), middle.to_vec(), around(MARGIN - offset)].concat()
}

/// A structure of arrays in larger buffers, each array at an offset of its own.
pub struct Columns {
    buffers: Arrays,
    starts: [usize; 3],
    len: usize,
}

impl Columns {
    /// x starts `offset` elements into its buffer.
    pub fn new(v: &[Vector], offset: usize) -> Self {
        let starts = [offset, (offset + 3) % MARGIN, (offset + 5) % MARGIN];
        let column = |i: usize| {
            let components: Vec<f32> = v.iter().map(|v| v[i]).collect();
            surrounded(&components, starts[i], UNWRITTEN)
        };
        let buffers = Arrays { x: column(0), y: column(1), z: column(2) };
        Columns { buffers, starts, len: v.len() }
    }

    pub fn read(&self) -> Soa<'_> {
        let Arrays { x, y, z } = &self.buffers;
        let [at_x, at_y, at_z] = self.starts.map(|start| start..start + self.len);
        Soa { x: &x[at_x], y: &y[at_y], z: &z[at_z] }
    }

    pub fn write(&mut self) -> SoaMut<'_> {
        let Arrays { x, y, z } = &mut self.buffers;
        let [at_x, at_y, at_z] = self.starts.map(|start| start..start + self.len);
        SoaMut { x: &mut x[at_x], y: &mut y[at_y], z: &mut z[at_z] }
    }

    pub fn bits(&self) -> [Vec<u32>; 3] {
        let Arrays { x, y, z } = &self.buffers;
        [x, y, z].map(|buffer| all_bits(buffer))
    }
}

/// Each vector followed by `n - 3` further floats, all different.
pub fn widened(v: &[Vector], n: usize) -> Vec<f32> {
    let more = |i: usize| (3..n).map(move |j| (100 * i + j) as f32);
    v.iter().enumerate().flat_map(|(i, v)| v.iter().copied().chain(more(i))).collect()
}

pub fn all_bits(floats: &[f32]) -> Vec<u32> {
    floats.iter().map(|c| c.to_bits()).collect()
}
