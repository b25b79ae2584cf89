//! Half floats as integers that count them from 0 up: their bits, negative if the sign is set.

pub const ONE: i64 = 0x3C00;
/// 65504.
pub const GREATEST: i64 = 0x7BFF;

pub fn value(ordinal: i64) -> f64 {
    let (exponent, mantissa) = (ordinal.abs() >> 10, ordinal.abs() & 0x3FF);
    let magnitude = if exponent == 0 {
        mantissa as f64 * 2f64.powi(-24)
    } else {
        (1024 + mantissa) as f64 * 2f64.powi(exponent as i32 - 25)
    };
    if ordinal < 0 { -magnitude } else { magnitude }
}

/// The place of `x` among the halves: whole at a half, and in proportion between two. The even
/// one of two halves has the even integer, so rounding the position is rounding `x`.
pub fn position(x: f64) -> f64 {
    let magnitude = x.abs();
    let exponent = if magnitude < 2f64.powi(-14) { -14 } else { magnitude.log2().floor() as i32 };
    // log2 may round up just below a power of two; the position runs on there all the same.
    let mantissa = magnitude * 2f64.powi(10 - exponent);
    let position = f64::from((exponent + 14) * 1024) + mantissa;
    if x < 0.0 { -position } else { position }
}

pub fn bits(ordinal: i64) -> u128 {
    let sign = if ordinal < 0 { 0x8000 } else { 0 };
    sign | ordinal.unsigned_abs() as u128
}

/// The ordinal of any pattern. Infinities, NaN and all above `greatest` read as `greatest`.
pub fn ordinal(bits: u128, greatest: i64) -> i64 {
    let magnitude = (bits as i64 & 0x7FFF).min(greatest);
    if bits & 0x8000 == 0 { magnitude } else { -magnitude }
}
