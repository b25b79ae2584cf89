//! Operators of vectors that wrap another crate's.

/// Operators between two vectors.
macro_rules! operators {
    ($type:ty: $($trait:ident $method:ident),*) => {
        $(operators!(@one $type, $trait $method);)*
    };
    (@one $type:ty, $trait:ident $method:ident) => {
        impl core::ops::$trait for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(core::ops::$trait::$method(self.0, other.0))
            }
        }
    };
}

/// Operators between a vector and a number on its right.
macro_rules! scalar_operators {
    ($type:ty, $scalar:ty: $($trait:ident $method:ident),*) => {
        $(scalar_operators!(@one $type, $scalar, $trait $method);)*
    };
    (@one $type:ty, $scalar:ty, $trait:ident $method:ident) => {
        impl core::ops::$trait<$scalar> for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: $scalar) -> Self {
                core::ops::$trait::$method(self, Self::from(other))
            }
        }
    };
}

pub(super) use {operators, scalar_operators};
