//! The names that rows of the table use.

#[cfg(feature = "xyz")]
pub(crate) use super::cartesian::{BestFit, Floats, Xyz, Xyz16};
#[cfg(feature = "cube")]
pub(crate) use super::cube::{AngularCube, Cube, Linear, WarpedFace};
#[cfg(feature = "disk")]
pub(crate) use super::disk::{
    Disk,
    Projection::{EqArea, EqDist, Stereo},
    Stretch::{Concentric, Ellipse, Plain},
};
#[cfg(feature = "fibonacci")]
pub(crate) use super::fibonacci::Fibonacci;
#[cfg(feature = "frontoct")]
pub(crate) use super::front_oct::FrontOct;
#[cfg(feature = "hemioct")]
pub(crate) use super::hemi_oct::{HemiOct, SignedOct};
#[cfg(feature = "icosphere")]
pub(crate) use super::icosphere::Icosphere;
#[cfg(feature = "latlong")]
pub(crate) use super::latlong::{Adaptive, LatLong, Uniform};
#[cfg(feature = "oct")]
pub(crate) use super::oct::{Central, EqualArea, Oct, OctUnorm, Warped};
#[cfg(feature = "octant")]
pub(crate) use super::octant::Octant;
#[cfg(feature = "phi-z")]
pub(crate) use super::phi_z::PhiZ;
#[cfg(feature = "theta-phi")]
pub(crate) use super::spherical::Spherical;
#[cfg(feature = "xyonly")]
pub(crate) use super::xy_only::{Kept, Normalized, XyHalf, XyOnly, XySnorm, XyUnorm};
