//! The names that rows of the table use.

#[cfg(feature = "cartesian")]
pub(crate) use super::cartesian::{BestFit, Floats, Xyz, Xyz16};
#[cfg(feature = "polyhedral")]
pub(crate) use super::cube::{AngularCube, Cube, Linear, WarpedFace};
#[cfg(feature = "disk")]
pub(crate) use super::disk::{
    Disk,
    Projection::{EqArea, EqDist, Stereo},
    Stretch::{Concentric, Ellipse, Plain},
};
#[cfg(feature = "polyhedral")]
pub(crate) use super::icosphere::Icosphere;
#[cfg(feature = "cartesian")]
pub(crate) use super::xy_only::{XyHalf, XyOnly, XyUnorm};
#[cfg(feature = "spherical")]
pub(crate) use super::{
    fibonacci::Fibonacci,
    latlong::{Adaptive, LatLong, Uniform},
    phi_z::PhiZ,
    spherical::Spherical,
};
#[cfg(feature = "octahedral")]
pub(crate) use super::{
    front_oct::FrontOct,
    hemi_oct::{HemiOct, SignedOct},
    oct::{Central, EqualArea, Oct, OctUnorm, Warped},
    octant::Octant,
};
