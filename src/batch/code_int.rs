//! Integer types that hold a code.

use bytemuck::Pod;

/// An integer that holds one code in its low bits: `u8`, `u16` or `u32`.
pub trait CodeInt: Pod + Eq + core::fmt::Debug + Into<u32> + sealed::Truncate {}

impl CodeInt for u8 {}
impl CodeInt for u16 {}
impl CodeInt for u32 {}

/// Whether codes of a number of bits fit.
pub(crate) const fn holds<C>(bits: u32) -> bool {
    size_of::<C>() as u32 * 8 >= bits
}

mod sealed {
    pub trait Truncate {
        /// The low bits.
        fn truncate(code: u32) -> Self;
    }

    impl Truncate for u8 {
        #[inline(always)]
        fn truncate(code: u32) -> Self {
            code as u8
        }
    }
    impl Truncate for u16 {
        #[inline(always)]
        fn truncate(code: u32) -> Self {
            code as u16
        }
    }
    impl Truncate for u32 {
        #[inline(always)]
        fn truncate(code: u32) -> Self {
            code
        }
    }
}
