//! What formulas of several families use.

pub(crate) mod bits;
pub(crate) mod closest;
pub(crate) mod half;
pub(crate) mod sanitize;
pub(crate) mod sign;
