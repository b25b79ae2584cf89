//! What formulas of several families use.

pub(crate) mod bits;
pub(crate) mod closest;
#[cfg(any(feature = "xyz", feature = "xyonly", feature = "quaternion"))]
pub(crate) mod divisor;
pub(crate) mod half;
pub(crate) mod sanitize;
pub(crate) mod sign;
