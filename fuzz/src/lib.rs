//! What the targets share: how bytes become an input, and angles measured in f64.
//!
//! Short runs find more with `-len_control=0 -max_len=128 -dict=fuzz/floats.dict`.

use bytemuck::Zeroable;
use unitpack::{Codec, Format, Soa, SoaMut};

pub type Vector = [f32; 3];

/// Angle that is put down to the rounding of f32, in radians.
pub const ROUNDING: f64 = 3e-7;

/// The first byte chooses a format.
pub fn choose(data: &[u8]) -> Option<(Format, &[u8])> {
    let (&first, rest) = data.split_first()?;
    Some((Format::ALL[usize::from(first) % Format::ALL.len()], rest))
}

/// At least eight items, so that all lanes run, and at most `most`, each from `size` bytes.
fn items<T: Copy>(bytes: &[u8], size: usize, most: usize, item: impl Fn(&[u8]) -> T) -> Vec<T> {
    let mut items: Vec<T> = bytes.chunks_exact(size).take(most).map(&item).collect();
    if items.len() < 8 {
        items.resize(8, item(&[0x3F; 16][..size]));
    }
    items
}

/// Vectors of any bits. Few where the precise search is slow.
pub fn vectors(format: Format, bytes: &[u8]) -> Vec<Vector> {
    let most = if is_slow(format) { 9 } else { 32 };
    items(bytes, 12, most, bytemuck::pod_read_unaligned)
}

/// Codes of any bits.
pub fn codes<C: Codec>(bytes: &[u8]) -> Vec<C::Code> {
    let most = if is_slow(C::FORMAT) { 9 } else { 96 };
    items(bytes, size_of::<C::Code>(), most, bytemuck::pod_read_unaligned)
}

/// Up to 200 us a vector in `encode_precise`, where others take 10 us at most.
fn is_slow(format: Format) -> bool {
    matches!(format, Format::Snorm16x3 | Format::Float16x3)
}

/// Calls `encode` with the vectors as a structure of arrays.
pub fn encode_soa<C: Codec>(
    vectors: &[Vector],
    encode: impl Fn(Soa<'_>, &mut [C::Code]) -> Result<(), unitpack::LengthMismatch>,
) -> Vec<C::Code> {
    let [x, y, z] = [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect::<Vec<_>>());
    let mut codes = vec![C::Code::zeroed(); vectors.len()];
    encode(Soa { x: &x, y: &y, z: &z }, &mut codes).unwrap();
    codes
}

/// Decodes to a structure of arrays.
pub fn decode_soa<C: Codec>(codes: &[C::Code]) -> Vec<Vector> {
    let [mut x, mut y, mut z] = [(); 3].map(|()| vec![0.0; codes.len()]);
    C::decode_soa(codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
    (0..codes.len()).map(|i| [x[i], y[i], z[i]]).collect()
}

pub fn bits(v: Vector) -> [u32; 3] {
    v.map(f32::to_bits)
}

/// Whether the format stores a direction. The others give the input back.
pub fn stores_direction(format: Format) -> bool {
    format != Format::Float32x3
}

/// The direction that the contract gives to an input, of any length.
pub fn meant(format: Format, v: Vector) -> [f64; 3] {
    let [x, y, z] = v.map(f64::from);
    let v = [x, y, if format.is_hemisphere() && z < 0.0 { 0.0 } else { z }];
    if v.iter().any(|c| c.is_nan()) || v == [0.0; 3] {
        [0.0, 0.0, 1.0]
    } else if v.iter().any(|c| c.is_infinite()) {
        v.map(|c| if c.is_infinite() { c.signum() } else { 0.0 })
    } else {
        v
    }
}

/// The angle between two vectors in radians.
pub fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    // Of usual length, as the products of subnormal components vanish.
    let scaled = |v: [f64; 3]| {
        let greatest = v.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        v.map(|c| c / greatest)
    };
    let (a, b) = (scaled(a), scaled(b));
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    (cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]).sqrt().atan2(dot)
}
