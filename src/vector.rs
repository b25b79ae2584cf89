//! The public shapes of data.

/// Vectors to read, as a structure of arrays. All three slices have one element per vector.
#[derive(Clone, Copy, Debug)]
pub struct Soa<'a> {
    /// The x components.
    pub x: &'a [f32],
    /// The y components.
    pub y: &'a [f32],
    /// The z components.
    pub z: &'a [f32],
}

/// Vectors to write, as a structure of arrays. All three slices have one element per vector.
#[derive(Debug)]
pub struct SoaMut<'a> {
    /// The x components.
    pub x: &'a mut [f32],
    /// The y components.
    pub y: &'a mut [f32],
    /// The z components.
    pub z: &'a mut [f32],
}
