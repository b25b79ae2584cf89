//! The table of codecs: a row each. Everything that is true of a codec is in its row.
//!
//! A family has its description, the axes in which the mirror images of all codes are points of the
//! format, whether `encode` is stable, which is that it gives every canonical code again for its vector, and which code that no
//! encoder gives is [`Codec::NONE`](super::Codec::NONE). Where a code is two parameters and nothing else, it says of which kind. A row has the type and its code, the name, the bits, bounds on the errors of `encode` and
//! `encode_precise`, the axes that round-trip exactly (after `/` those of `encode_precise`, if it keeps
//! more), the formula, and flags:
//!
//! - `hot`: has kernels of its own, in which the formula is constant;
//! - `octant`: decodes the same in all octants ([`Symmetric`](crate::formula::Symmetric)), in at most 16
//!   bits, so that it has an [`OctantTable`](crate::decode_table::OctantTable);
//! - `stochastic`: has [`StochasticRounding`](crate::dither::StochasticRounding);
//! - `finer`: `f32` does not tell all points apart. What decodes alike is one direction, "nearest" and "exact" are up to
//!   rounding, and `encode_precise` searches lengths.

/// Calls a macro with all rows, behind what else it is to be given.
#[doc(hidden)]
#[macro_export]
macro_rules! codec_table {
    ($callback:ident) => { $crate::codec_table! { [$callback] } };
    ([$($callback:tt)*] $($argument:tt)*) => { $($callback)*! { $($argument)*
    #[cfg(feature = "oct")]
    "[Octahedral](https://jcgt.org/published/0003/02/01/): the sphere unfolded from an octahedron into a square. Two snorm \
     [parameters](Codec#bit-layout).", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        Oct8: u8 = "oct8", 8 bits, 17.26 / 11.47 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(8), octant, stochastic;
        Oct10: u16 = "oct10", 10 bits, 8.082 / 5.373 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(10), octant, stochastic;
        Oct12: u16 = "oct12", 12 bits, 3.935 / 2.623 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(12), octant, stochastic;
        Oct14: u16 = "oct14", 14 bits, 1.937 / 1.291 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(14), octant, stochastic;
        Oct16: u16 = "oct16", 16 bits, 0.9609 / 0.6406 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(16), hot, octant, stochastic;
        Oct18: u32 = "oct18", 18 bits, 0.4786 / 0.3191 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(18), stochastic;
        Oct20: u32 = "oct20", 20 bits, 0.2388 / 0.1592 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(20), stochastic;
        Oct22: u32 = "oct22", 22 bits, 0.1193 / 0.07953 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(22), stochastic;
        Oct24: [u8; 3] = "oct24", 24 bits, 0.05962 / 0.03975 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(24), hot, stochastic;
        Oct26: u32 = "oct26", 26 bits, 0.02981 / 0.01987 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(26), stochastic;
        Oct28: u32 = "oct28", 28 bits, 0.01490 / 0.009934 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(28), stochastic;
        Oct30: u32 = "oct30", 30 bits, 0.007460 / 0.004968 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(30), stochastic;
        Oct32: u32 = "oct32", 32 bits, 0.003736 / 0.002486 degrees, exact "±X ±Y ±Z", Oct::<Central>::new(32), hot, stochastic;
    }
    #[cfg(feature = "warpedoct")]
    "Octahedral with cells of about the same size: each coordinate of [`Oct16`]'s octahedron warped by a cubic. With \
     `encode_precise` the least greatest error of all formats of its size. oct, denser around the axes, has the smaller mean error \
     where normals crowd there, as on built geometry. Two snorm [parameters](Codec#bit-layout).", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        WarpedOct16: u16 = "warpedoct16", 16 bits, 0.8893 / 0.5198 degrees, exact "±X ±Y ±Z", Oct::<Warped>::new(16), octant;
        WarpedOct20: u32 = "warpedoct20", 20 bits, 0.2211 / 0.1289 degrees, exact "±X ±Y ±Z", Oct::<Warped>::new(20);
        WarpedOct22: u32 = "warpedoct22", 22 bits, 0.1105 / 0.06450 degrees, exact "±X ±Y ±Z", Oct::<Warped>::new(22);
        WarpedOct24: [u8; 3] = "warpedoct24", 24 bits, 0.05521 / 0.03223 degrees, exact "±X ±Y ±Z", Oct::<Warped>::new(24);
        WarpedOct32: u32 = "warpedoct32", 32 bits, 0.003486 / 0.002014 degrees, exact "±X ±Y ±Z", Oct::<Warped>::new(32);
    }
    #[cfg(feature = "eqareaoct")]
    "Octahedral with cells of equal area, as environment maps have it. Two snorm [parameters](Codec#bit-layout).", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        EqAreaOct16: u16 = "eqareaoct16", 16 bits, 0.9710 / 0.5848 degrees, exact "±X ±Y ±Z", Oct::<EqualArea>::new(16), octant;
        EqAreaOct24: [u8; 3] = "eqareaoct24", 24 bits, 0.06045 / 0.03694 degrees, exact "±X ±Y ±Z", Oct::<EqualArea>::new(24);
        EqAreaOct32: u32 = "eqareaoct32", 32 bits, 0.003800 / 0.002313 degrees, exact "±X ±Y ±Z", Oct::<EqualArea>::new(32);
    }
    #[cfg(feature = "oct")]
    "[Octahedral](https://jcgt.org/published/0003/02/01/) whose steps are a multiple of six: 126, 2046 or 32766. Two snorm \
     [parameters](Codec#bit-layout), of which greater ones read as the greatest. All middles of the edges \
     and corners of a cube, such as (1, 1, 0) and (1, 1, 1), survive exactly too.", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        SixOct16: u16 = "sixoct16", 16 bits, 0.9694 / 0.6462 degrees, exact "±X ±Y ±Z", Oct::<Central>::with_multiple(16, 6), octant, stochastic;
        SixOct24: [u8; 3] = "sixoct24", 24 bits, 0.05972 / 0.03981 degrees, exact "±X ±Y ±Z", Oct::<Central>::with_multiple(24, 6), stochastic;
        SixOct32: u32 = "sixoct32", 32 bits, 0.003742 / 0.002489 degrees, exact "±X ±Y ±Z", Oct::<Central>::with_multiple(32, 6), stochastic;
    }
    #[cfg(feature = "frontoct")]
    "Octahedral with more precision towards +Z, as for normals that mostly face the viewer: cells are half as wide as [`Oct16`]'s at \
     +Z and twice as wide at -Z. Two snorm [parameters](Codec#bit-layout).", mirrors "X Y", stable, none HighestBit, pair snorm {
        FrontOct16: u16 = "frontoct16", 16 bits, 1.341 / 0.9276 degrees, exact "±Z", FrontOct::new(16, 2);
        FrontOct24: [u8; 3] = "frontoct24", 24 bits, 0.08320 / 0.05754 degrees, exact "±Z", FrontOct::new(24, 2);
        FrontOct32: u32 = "frontoct32", 32 bits, 0.005219 / 0.003595 degrees, exact "±X ±Y ±Z", FrontOct::new(32, 2);
    }
    #[cfg(feature = "frontoct")]
    "As [`FrontOct16`], but a quarter as wide at +Z and four times as wide at -Z. Two snorm \
     [parameters](Codec#bit-layout).", mirrors "X Y", stable, none HighestBit, pair snorm {
        QuadFrontOct16: u16 = "quadfrontoct16", 16 bits, 1.814 / 1.447 degrees, exact "±Z", FrontOct::new(16, 4);
        QuadFrontOct24: [u8; 3] = "quadfrontoct24", 24 bits, 0.1126 / 0.08962 degrees, exact "±X ±Y ±Z", FrontOct::new(24, 4);
    }
    #[cfg(feature = "xyz")]
    "Cartesian: the three components, x in the low bits, as many bits each as the name says; decoding divides by the length. Snorm \
     -M-1 reads as -M, infinite and NaN halves as 65504, (0, 0, 0) as +Z. Of the patterns of one direction the one whose length \
     is nearest to 1 is canonical; snorm12x3, snorm16x3 and float16x3 are finer than `f32`, so there what decodes alike is one direction. \
     snorm12x3 has each component in a word of 16 bits, of which the upper four repeat the sign and are ignored by decoding.", mirrors "X Y Z", unstable, none HighestBit, pair none {
        Snorm5x3: u16 = "snorm5x3", 15 bits, 3.299 / 2.707 degrees, exact "±X ±Y ±Z", Xyz::snorm([5, 5, 5]), octant;
        Snorm8x3: [u8; 3] = "snorm8x3", 24 bits, 0.3920 / 0.3203 degrees, exact "±X ±Y ±Z", Xyz::snorm([8, 8, 8]), hot;
        Snorm10x3: u32 = "snorm10x3", 30 bits, 0.09747 / 0.07960 degrees, exact "±X ±Y ±Z", Xyz::snorm([10, 10, 10]), hot;
        Snorm11_11_10: u32 = "snorm11-11-10", 32 bits, 0.06889 / 0.06292 degrees, exact "±X ±Y ±Z", Xyz::snorm([11, 11, 10]);
        Snorm12x3: [u16; 3] = "snorm12x3", 48 bits, 0.0244 / 0.0199 degrees, exact "±X ±Y ±Z", Xyz16::snorm(12), finer;
        Snorm16x3: [u16; 3] = "snorm16x3", 48 bits, 0.00153 / 0.00124 degrees, exact "±X ±Y ±Z", Xyz16::snorm(16), finer;
        Float16x3: [u16; 3] = "float16x3", 48 bits, 0.0240 / 0.00766 degrees, exact "±X ±Y ±Z", Xyz16::halves(), finer;
    }
    #[cfg(feature = "xyz")]
    "Three `f32`, bit for bit: what is stored is what is given back, of any length, zero and NaN included.", mirrors "X Y Z", stable, none Never, pair none {
        Float32x3: [u32; 3] = "float32x3", 96 bits, 0.0 / 0.0 degrees, exact "±X ±Y ±Z", Floats::new();
    }
    #[cfg(feature = "theta-phi")]
    "Spherical: polar angle, 2 theta / pi - 1, and azimuth, phi / pi, as two snorm \
     [parameters](Codec#bit-layout). Canonical: at a pole the azimuth is 0, on -X it is M.", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        Spherical16: u16 = "spherical16", 16 bits, 0.7955 / 0.7955 degrees, exact "±X ±Z", Spherical::new(16), hot;
        Spherical20: u32 = "spherical20", 20 bits, 0.1978 / 0.1978 degrees, exact "±X ±Z", Spherical::new(20);
        Spherical22: u32 = "spherical22", 22 bits, 0.09877 / 0.09876 degrees, exact "±X ±Z", Spherical::new(22);
        Spherical24: [u8; 3] = "spherical24", 24 bits, 0.04937 / 0.04936 degrees, exact "±X ±Z", Spherical::new(24);
        Spherical32: u32 = "spherical32", 32 bits, 0.003093 / 0.003086 degrees, exact "±X ±Z", Spherical::new(32);
    }
    #[cfg(feature = "hemioct")]
    "Hemi-oct: the +Z hemisphere, octahedral, turned so that it fills the square. Two snorm \
     [parameters](Codec#bit-layout).", mirrors "X Y", stable, none HighestBit, pair snorm {
        HemiOct16: u16 = "HemiOct16", 16 bits, 0.5548 / 0.5548 degrees, exact "±X ±Y +Z", HemiOct::new(16), hot, octant;
        HemiOct24: [u8; 3] = "HemiOct24", 24 bits, 0.03443 / 0.03442 degrees, exact "±X ±Y +Z", HemiOct::new(24);
        HemiOct32: u32 = "HemiOct32", 32 bits, 0.002163 / 0.002151 degrees, exact "±X ±Y +Z", HemiOct::new(32);
    }
    #[cfg(feature = "hemioct")]
    "Signed oct: two snorm [parameters](Codec#bit-layout) as [`HemiOct16`] has them, and above them a bit that is set where z < 0. For \
     odd budgets: 10 + 10 + 1 bits leave 11 of a word.", mirrors "X Y Z", stable, none BelowHighest, pair none {
        SignedOct17: u32 = "signedoct17", 17 bits, 0.5554 / 0.5554 degrees, exact "±X ±Y ±Z", SignedOct::new(17);
        SignedOct21: u32 = "signedoct21", 21 bits, 0.1381 / 0.1381 degrees, exact "±X ±Y ±Z", SignedOct::new(21);
        SignedOct23: [u8; 3] = "signedoct23", 23 bits, 0.06895 / 0.06895 degrees, exact "±X ±Y ±Z", SignedOct::new(23);
        SignedOct31: u32 = "signedoct31", 31 bits, 0.004319 / 0.004307 degrees, exact "±X ±Y ±Z", SignedOct::new(31);
    }
    #[cfg(feature = "xyonly")]
    "XY-only: the +Z hemisphere, x and y as two unorm [parameters](Codec#bit-layout), (c + 1) / 2. \
     Beyond the rim, the smaller component is kept, but no more than the first grid value from sqrt(1/2); the larger one is put on the \
     rim, and z is 0. Shaders read such codes as (x, y, 0) over its length, as [`XyOnlyNormalized16`] does. In bytes the two differ \
     by up to 9.9 degrees, at (255, 218). Zero is no value: in bytes, (128, 128) is 0.318 degrees off +Z. [`XyOnlyBiased16`] has 128 for zero.", mirrors "X Y", unstable, none AllBits, pair unorm {
        XyOnly16: u16 = "XYOnly16", 16 bits, 6.05 / 3.611 degrees, exact "", XyOnly::<XyUnorm, Kept>::new(16), octant;
        XyOnly24: [u8; 3] = "XYOnly24", 24 bits, 1.51 / 0.8991 degrees, exact "", XyOnly::<XyUnorm, Kept>::new(24);
        XyOnly32: u32 = "XYOnly32", 32 bits, 0.379 / 0.2248 degrees, exact "", XyOnly::<XyUnorm, Kept>::new(32);
    }
    #[cfg(feature = "xyonly")]
    "XY-only: the +Z hemisphere, x and y as two halves, x in the low bits. Magnitudes above 1, infinity and NaN read as 1. Beyond the rim, the \
     smaller component is kept, but no more than the first half from sqrt(1/2); the larger one is put on the rim, and z is 0.", mirrors "X Y", unstable, none HighestBit, pair none {
        XyOnly32F: u32 = "XYOnly32F", 32 bits, 1.51 / 0.8989 degrees, exact "±X ±Y +Z", XyOnly::<XyHalf, Kept>::new();
    }
    #[cfg(feature = "xyonly")]
    "XY-only as shaders read it: the bits of [`XyOnly16`], decoded by normalizing (x, y, sqrt(max(0, 1 - x^2 - y^2))). So codes \
     beyond the rim read as (x, y, 0) over its length. Of the codes of one direction the one nearest to the rim is canonical.", mirrors "X Y", unstable, none AllBits, pair unorm {
        XyOnlyNormalized16: u16 = "XYOnly-normalized16", 16 bits, 5.98 / 3.611 degrees, exact "", XyOnly::<XyUnorm, Normalized>::new(16), octant;
    }
    #[cfg(feature = "xyonly")]
    "XY-only as BC5_SNORM and RG8_SNORM have it: the +Z hemisphere, x and y as two snorm [parameters](Codec#bit-layout). \
     Beyond the rim, a code reads as shaders do it: (x, y, 0) over its length. Of the codes of one direction \
     the one nearest to the rim is canonical.", mirrors "X Y", unstable, none HighestBit, pair snorm {
        XyOnlySnorm16: u16 = "XYOnly-snorm16", 16 bits, 6.02 / 3.611 degrees, exact "±X ±Y +Z", XyOnly::<XySnorm, Normalized>::new(16), octant;
    }
    #[cfg(feature = "xyonly")]
    "XY-only with 128 for zero, as painters of normal maps take it: the directions of [`XyOnlySnorm16`], x and y as two unsigned bytes, \
     (c - 128) / 127, of which 0 reads as 1.", mirrors "X Y", unstable, none HighestBit, pair none {
        XyOnlyBiased16: u16 = "XYOnly-biased16", 16 bits, 6.02 / 3.611 degrees, exact "±X ±Y +Z", XyOnly::<XySnorm, Normalized>::biased(16), octant;
    }
    #[cfg(feature = "disk")]
    "Disk projection, stereographic, as it is: codes outside the disk decode past the equator, where only `encode_precise` \
     uses them. Two snorm [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2.", mirrors "Y", unstable, none HighestBit, pair snorm {
        Stereo16: u16 = "stereo16", 16 bits, 1.013 / 1.013 degrees, exact "±X", Disk::new(Stereo, Plain, 16), octant;
        Stereo20: u32 = "stereo20", 20 bits, 0.2518 / 0.2518 degrees, exact "±X", Disk::new(Stereo, Plain, 20);
        Stereo22: u32 = "stereo22", 22 bits, 0.1258 / 0.1258 degrees, exact "±X", Disk::new(Stereo, Plain, 22);
        Stereo24: [u8; 3] = "stereo24", 24 bits, 0.06285 / 0.06284 degrees, exact "±X", Disk::new(Stereo, Plain, 24);
        Stereo32: u32 = "stereo32", 32 bits, 0.003932 / 0.003926 degrees, exact "±X", Disk::new(Stereo, Plain, 32);
    }
    #[cfg(feature = "disk")]
    "Disk projection, stereographic, stretched to the square by mapping circles to squares (Shirley and Chiu). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2.", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        StereoConcentric16: u16 = "stereo+concentric16", 16 bits, 1.355 / 0.9926 degrees, exact "±X", Disk::new(Stereo, Concentric, 16), octant;
        StereoConcentric20: u32 = "stereo+concentric20", 20 bits, 0.3435 / 0.2468 degrees, exact "±X", Disk::new(Stereo, Concentric, 20);
        StereoConcentric22: u32 = "stereo+concentric22", 22 bits, 0.1724 / 0.1233 degrees, exact "±X", Disk::new(Stereo, Concentric, 22);
        StereoConcentric24: [u8; 3] = "stereo+concentric24", 24 bits, 0.08642 / 0.06160 degrees, exact "±X", Disk::new(Stereo, Concentric, 24);
        StereoConcentric32: u32 = "stereo+concentric32", 32 bits, 0.005428 / 0.003848 degrees, exact "±X", Disk::new(Stereo, Concentric, 32);
    }
    #[cfg(feature = "disk")]
    "Disk projection, stereographic, stretched to the square by elliptical arcs (Nowell). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2.", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        StereoEllipse16: u16 = "stereo+ellipse16", 16 bits, 1.013 / 1.013 degrees, exact "±X", Disk::new(Stereo, Ellipse, 16), octant;
        StereoEllipse20: u32 = "stereo+ellipse20", 20 bits, 0.2518 / 0.2518 degrees, exact "±X", Disk::new(Stereo, Ellipse, 20);
        StereoEllipse22: u32 = "stereo+ellipse22", 22 bits, 0.1258 / 0.1258 degrees, exact "±X", Disk::new(Stereo, Ellipse, 22);
        StereoEllipse24: [u8; 3] = "stereo+ellipse24", 24 bits, 0.06285 / 0.06284 degrees, exact "±X", Disk::new(Stereo, Ellipse, 24);
        StereoEllipse32: u32 = "stereo+ellipse32", 32 bits, 0.003932 / 0.003926 degrees, exact "±X", Disk::new(Stereo, Ellipse, 32);
    }
    #[cfg(feature = "disk")]
    "Disk projection, equal-area, as it is: codes outside the disk decode past the equator, where only `encode_precise` uses \
     them. Two snorm [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2.", mirrors "Y", unstable, none HighestBit, pair snorm {
        EqArea16: u16 = "eqarea16", 16 bits, 1.016 / 0.9262 degrees, exact "±X" / "±X ±Z", Disk::new(EqArea, Plain, 16), octant;
        EqArea20: u32 = "eqarea20", 20 bits, 0.2520 / 0.2316 degrees, exact "±X" / "±X ±Z", Disk::new(EqArea, Plain, 20);
        EqArea22: u32 = "eqarea22", 22 bits, 0.1258 / 0.1159 degrees, exact "±X" / "±X ±Z", Disk::new(EqArea, Plain, 22);
        EqArea24: [u8; 3] = "eqarea24", 24 bits, 0.06286 / 0.05791 degrees, exact "±X" / "±X ±Z", Disk::new(EqArea, Plain, 24);
        EqArea32: u32 = "eqarea32", 32 bits, 0.003947 / 0.003620 degrees, exact "±X" / "±X ±Z", Disk::new(EqArea, Plain, 32);
    }
    #[cfg(feature = "disk")]
    "Disk projection, equal-area, stretched to the square by mapping circles to squares (Shirley and Chiu). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2.", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        EqAreaConcentric16: u16 = "eqarea+concentric16", 16 bits, 1.048 / 0.9167 degrees, exact "±X", Disk::new(EqArea, Concentric, 16), octant;
        EqAreaConcentric20: u32 = "eqarea+concentric20", 20 bits, 0.2611 / 0.2291 degrees, exact "±X", Disk::new(EqArea, Concentric, 20);
        EqAreaConcentric22: u32 = "eqarea+concentric22", 22 bits, 0.1305 / 0.1146 degrees, exact "±X", Disk::new(EqArea, Concentric, 22);
        EqAreaConcentric24: [u8; 3] = "eqarea+concentric24", 24 bits, 0.06522 / 0.05726 degrees, exact "±X", Disk::new(EqArea, Concentric, 24);
        EqAreaConcentric32: u32 = "eqarea+concentric32", 32 bits, 0.004099 / 0.003579 degrees, exact "±X", Disk::new(EqArea, Concentric, 32);
    }
    #[cfg(feature = "disk")]
    "Disk projection, equal-area, stretched to the square by elliptical arcs (Nowell). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2.", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        EqAreaEllipse16: u16 = "eqarea+ellipse16", 16 bits, 0.9213 / 0.9131 degrees, exact "±X", Disk::new(EqArea, Ellipse, 16), octant;
        EqAreaEllipse20: u32 = "eqarea+ellipse20", 20 bits, 0.2296 / 0.2283 degrees, exact "±X", Disk::new(EqArea, Ellipse, 20);
        EqAreaEllipse22: u32 = "eqarea+ellipse22", 22 bits, 0.1148 / 0.1141 degrees, exact "±X", Disk::new(EqArea, Ellipse, 22);
        EqAreaEllipse24: [u8; 3] = "eqarea+ellipse24", 24 bits, 0.05735 / 0.05705 degrees, exact "±X", Disk::new(EqArea, Ellipse, 24);
        EqAreaEllipse32: u32 = "eqarea+ellipse32", 32 bits, 0.003604 / 0.003566 degrees, exact "±X", Disk::new(EqArea, Ellipse, 32);
    }
    #[cfg(feature = "disk")]
    "Disk projection, equidistant, as it is: codes outside the disk decode past the equator, where only `encode_precise` uses \
     them. Two snorm [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2.", mirrors "Y", unstable, none HighestBit, pair snorm {
        EqDist16: u16 = "eqdist16", 16 bits, 0.7955 / 0.7955 degrees, exact "±X", Disk::new(EqDist, Plain, 16), octant;
        EqDist20: u32 = "eqdist20", 20 bits, 0.1978 / 0.1978 degrees, exact "±X", Disk::new(EqDist, Plain, 20);
        EqDist22: u32 = "eqdist22", 22 bits, 0.09877 / 0.09876 degrees, exact "±X", Disk::new(EqDist, Plain, 22);
        EqDist24: [u8; 3] = "eqdist24", 24 bits, 0.04937 / 0.04936 degrees, exact "±X", Disk::new(EqDist, Plain, 24);
        EqDist32: u32 = "eqdist32", 32 bits, 0.003098 / 0.003086 degrees, exact "±X", Disk::new(EqDist, Plain, 32);
    }
    #[cfg(feature = "disk")]
    "Disk projection, equidistant, stretched to the square by mapping circles to squares (Shirley and Chiu). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2.", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        EqDistConcentric16: u16 = "eqdist+concentric16", 16 bits, 1.078 / 0.7798 degrees, exact "±X", Disk::new(EqDist, Concentric, 16), octant;
        EqDistConcentric20: u32 = "eqdist+concentric20", 20 bits, 0.2710 / 0.1938 degrees, exact "±X", Disk::new(EqDist, Concentric, 20);
        EqDistConcentric22: u32 = "eqdist+concentric22", 22 bits, 0.1358 / 0.09680 degrees, exact "±X", Disk::new(EqDist, Concentric, 22);
        EqDistConcentric24: [u8; 3] = "eqdist+concentric24", 24 bits, 0.06799 / 0.04838 degrees, exact "±X", Disk::new(EqDist, Concentric, 24);
        EqDistConcentric32: u32 = "eqdist+concentric32", 32 bits, 0.004264 / 0.003022 degrees, exact "±X", Disk::new(EqDist, Concentric, 32);
    }
    #[cfg(feature = "disk")]
    "Disk projection, equidistant, stretched to the square by elliptical arcs (Nowell). Two snorm \
     [parameters](Codec#bit-layout), of which the first is sgn(z) (u + 1) / 2.", mirrors "X Y Z", stable, none HighestBit, pair snorm {
        EqDistEllipse16: u16 = "eqdist+ellipse16", 16 bits, 0.7955 / 0.7955 degrees, exact "±X", Disk::new(EqDist, Ellipse, 16), octant;
        EqDistEllipse20: u32 = "eqdist+ellipse20", 20 bits, 0.1978 / 0.1978 degrees, exact "±X", Disk::new(EqDist, Ellipse, 20);
        EqDistEllipse22: u32 = "eqdist+ellipse22", 22 bits, 0.09877 / 0.09876 degrees, exact "±X", Disk::new(EqDist, Ellipse, 22);
        EqDistEllipse24: [u8; 3] = "eqdist+ellipse24", 24 bits, 0.04937 / 0.04936 degrees, exact "±X", Disk::new(EqDist, Ellipse, 24);
        EqDistEllipse32: u32 = "eqdist+ellipse32", 32 bits, 0.003105 / 0.003086 degrees, exact "±X", Disk::new(EqDist, Ellipse, 32);
    }
    #[cfg(feature = "latlong")]
    "Lat-long: as many points on each parallel as there are parallels. The code is an index, row by row from +Z; the last \
     indices read as -Z.", mirrors "Y Z", stable, none AllBits, pair none {
        LatLong16: u16 = "latlong16", 16 bits, 0.7930 / 0.7930 degrees, exact "+X ±Z", LatLong::<Uniform>::new(16);
        LatLong24: [u8; 3] = "latlong24", 24 bits, 0.04937 / 0.04935 degrees, exact "+X ±Z", LatLong::<Uniform>::new(24);
        LatLong32: u32 = "latlong32", 32 bits, 0.003110 / 0.003088 degrees, exact "+X ±Z", LatLong::<Uniform>::new(32);
    }
    #[cfg(feature = "latlong")]
    "Lat-long with fewer points towards the poles, so that cells are about as wide as high. The code is an index, row by row \
     from +Z. A table of 4 bytes a parallel: 1 KB at 16 bits, 15 KB at 24.", mirrors "Y Z", stable, none Never, pair none {
        LatLong16D: u16 = "latlong16D", 16 bits, 0.5647 / 0.5645 degrees, exact "±X ±Z", LatLong::<Adaptive>::new(16);
        LatLong24D: [u8; 3] = "latlong24D", 24 bits, 0.03524 / 0.03522 degrees, exact "±X ±Z", LatLong::<Adaptive>::new(24);
    }
    #[cfg(feature = "latlong")]
    "As [`LatLong24D`], in 32 bits. The last indices read as -Z. A table of 4 bytes a parallel, 232 KB.", mirrors "Y Z", stable, none AllBits, pair none {
        LatLong32D: u32 = "latlong32D", 32 bits, 0.002228 / 0.002205 degrees, exact "+X ±Z", LatLong::<Adaptive>::new(32);
    }
    #[cfg(feature = "fibonacci")]
    "[Spherical Fibonacci](crate::SphericalFibonacci): 2^bits points of about the same area on a spiral from +Z to -Z. The code is the \
     index.", mirrors "", stable, none Never, pair none {
        Fibonacci16: u16 = "fibonacci16", 16 bits, 0.6137 / 0.6137 degrees, exact "", Fibonacci::new(1 << 16);
        Fibonacci24: [u8; 3] = "fibonacci24", 24 bits, 0.03836 / 0.03836 degrees, exact "", Fibonacci::new(1 << 24);
    }
    #[cfg(feature = "cube")]
    "Cube map: 3 bits of face, 2 axis + sign, and two snorm parameters, next / |axis| and next but one / |axis|. The highest \
     bit is unused.", mirrors "X Y Z", stable, none AllBits, pair none {
        Cube16: u16 = "cube16", 16 bits, 1.312 / 1.312 degrees, exact "±X ±Y ±Z", Cube::<Linear>::new(16), octant;
        Cube24: [u8; 3] = "cube24", 24 bits, 0.07961 / 0.07961 degrees, exact "±X ±Y ±Z", Cube::<Linear>::new(24);
        Cube32: u32 = "cube32", 32 bits, 0.004966 / 0.004966 degrees, exact "±X ±Y ±Z", Cube::<Linear>::new(32);
    }
    #[cfg(feature = "cube")]
    "Cube map with even steps of the angle: as cube, each parameter the 4 / pi atan of cube's. The highest bit is unused.", mirrors "X Y Z", stable, none AllBits, pair none {
        WarpedCube16: u16 = "warpedcube16", 16 bits, 1.181 / 1.031 degrees, exact "±X ±Y ±Z", Cube::<WarpedFace>::new(16), octant;
        WarpedCube24: [u8; 3] = "warpedcube24", 24 bits, 0.07216 / 0.06252 degrees, exact "±X ±Y ±Z", Cube::<WarpedFace>::new(24);
        WarpedCube32: u32 = "warpedcube32", 32 bits, 0.004506 / 0.003901 degrees, exact "±X ±Y ±Z", Cube::<WarpedFace>::new(32);
    }
    #[cfg(feature = "cube")]
    "Schinko's angular cube: each face cut into s x s cells of even angle, decoded to their centres, s = floor(sqrt(2^bits / 6)). \
     The code is the index (i s + j) 6 + face; the last indices read as the last cell. The paper's \"error limit\", half the mean \
     distance between neighbours (45°, 6.541°, 1.515°, 0.380° and 0.095° at 4, 8, 12, 16 and 20 bits), is no bound: the greatest error \
     is up to 1.85 times that.", mirrors "X Y Z", stable, none AllBits, pair none {
        AngularCube4: u8 = "angularcube4", 4 bits, 54.96 / 54.96 degrees, exact "±X ±Y ±Z", AngularCube::new(4), octant;
        AngularCube5: u8 = "angularcube5", 5 bits, 30.49 / 30.49 degrees, exact "", AngularCube::new(5), octant;
        AngularCube6: u8 = "angularcube6", 6 bits, 21.33 / 19.74 degrees, exact "±X ±Y ±Z", AngularCube::new(6), octant;
        AngularCube7: u8 = "angularcube7", 7 bits, 16.47 / 15.78 degrees, exact "", AngularCube::new(7), octant;
        AngularCube8: u8 = "angularcube8", 8 bits, 11.36 / 10.59 degrees, exact "", AngularCube::new(8), octant;
        AngularCube9: u16 = "angularcube9", 9 bits, 7.760 / 7.030 degrees, exact "±X ±Y ±Z", AngularCube::new(9), octant;
        AngularCube10: u16 = "angularcube10", 10 bits, 5.460 / 4.892 degrees, exact "±X ±Y ±Z", AngularCube::new(10), octant;
        AngularCube11: u16 = "angularcube11", 11 bits, 3.985 / 3.548 degrees, exact "", AngularCube::new(11), octant;
        AngularCube12: u16 = "angularcube12", 12 bits, 2.783 / 2.457 degrees, exact "", AngularCube::new(12), octant;
        AngularCube13: u16 = "angularcube13", 13 bits, 2.021 / 1.775 degrees, exact "", AngularCube::new(13), octant;
        AngularCube14: u16 = "angularcube14", 14 bits, 1.405 / 1.229 degrees, exact "", AngularCube::new(14), octant;
        AngularCube15: u16 = "angularcube15", 15 bits, 1.004 / 0.8752 degrees, exact "±X ±Y ±Z", AngularCube::new(15), octant;
        AngularCube16: u16 = "angularcube16", 16 bits, 0.7059 / 0.6144 degrees, exact "", AngularCube::new(16), octant;
        AngularCube17: u32 = "angularcube17", 17 bits, 0.5002 / 0.4347 degrees, exact "±X ±Y ±Z", AngularCube::new(17);
        AngularCube18: u32 = "angularcube18", 18 bits, 0.3522 / 0.3058 degrees, exact "±X ±Y ±Z", AngularCube::new(18);
        AngularCube19: u32 = "angularcube19", 19 bits, 0.2497 / 0.2166 degrees, exact "±X ±Y ±Z", AngularCube::new(19);
        AngularCube20: u32 = "angularcube20", 20 bits, 0.1763 / 0.1529 degrees, exact "", AngularCube::new(20);
        AngularCube21: u32 = "angularcube21", 21 bits, 0.1248 / 0.1082 degrees, exact "±X ±Y ±Z", AngularCube::new(21);
        AngularCube22: u32 = "angularcube22", 22 bits, 0.08820 / 0.07643 degrees, exact "", AngularCube::new(22);
        AngularCube23: u32 = "angularcube23", 23 bits, 0.06240 / 0.05406 degrees, exact "", AngularCube::new(23);
        AngularCube24: [u8; 3] = "angularcube24", 24 bits, 0.04412 / 0.03822 degrees, exact "", AngularCube::new(24);
        AngularCube25: u32 = "angularcube25", 25 bits, 0.03121 / 0.02703 degrees, exact "", AngularCube::new(25);
        AngularCube26: u32 = "angularcube26", 26 bits, 0.02206 / 0.01911 degrees, exact "", AngularCube::new(26);
        AngularCube27: u32 = "angularcube27", 27 bits, 0.01561 / 0.01352 degrees, exact "±X ±Y ±Z", AngularCube::new(27);
        AngularCube28: u32 = "angularcube28", 28 bits, 0.01104 / 0.009554 degrees, exact "", AngularCube::new(28);
        AngularCube29: u32 = "angularcube29", 29 bits, 0.007806 / 0.006755 degrees, exact "±X ±Y ±Z", AngularCube::new(29);
        AngularCube30: u32 = "angularcube30", 30 bits, 0.005520 / 0.004777 degrees, exact "±X ±Y ±Z", AngularCube::new(30);
        AngularCube31: u32 = "angularcube31", 31 bits, 0.003912 / 0.003378 degrees, exact "", AngularCube::new(31);
        AngularCube32: u32 = "angularcube32", 32 bits, 0.002766 / 0.002389 degrees, exact "", AngularCube::new(32);
    }
    #[cfg(feature = "octant")]
    "Baptista's octant code: three signs and a point of the octant's triangle. `encode` truncates as the original does; \
     `encode_precise` gives the nearest code of the same format.", mirrors "X Y Z", unstable, none AllBits, pair none {
        Octant16: u16 = "octant16", 16 bits, 1.937 / 0.6456 degrees, exact "±X ±Y ±Z", Octant::new(), octant;
    }
    #[cfg(feature = "xyz")]
    "Cartesian, scaled and biased: three unorm components, (c + 1) / 2, x in the low bits, as a UNORM render target holds \
     them. Decoding divides by the length. `encode_precise` gives the nearest direction of any length. Zero is no value: in bytes, \
     (128, 128, 255) is 0.318 degrees off +Z. [`XyzBiased8x3`] has 128 for zero. xyz-unorm16x3 is finer \
     than `f32`, so there what decodes alike is one direction.", mirrors "X Y Z", unstable, none AllBits, pair none {
        XyzUnorm8x3: [u8; 3] = "xyz-unorm8x3", 24 bits, 0.3898 / 0.3191 degrees, exact "", Xyz::unorm(8), hot;
        XyzUnorm10x3: u32 = "xyz-unorm10x3", 30 bits, 0.09720 / 0.07957 degrees, exact "", Xyz::unorm(10);
        XyzUnorm16x3: [u16; 3] = "xyz-unorm16x3", 48 bits, 0.001528 / 0.001245 degrees, exact "", Xyz16::unorm(), finer;
    }
    #[cfg(feature = "xyz")]
    "Cartesian, biased so that 128 is zero, as painters of normal maps take it: three bytes, (c - 128) / 127, x in the low bits. 0 reads as 1, \
     and (128, 128, 128) as +Z. The directions of [`Snorm8x3`], with the sign bits inverted.", mirrors "X Y Z", unstable, none AllBits, pair none {
        XyzBiased8x3: [u8; 3] = "xyz-biased8x3", 24 bits, 0.3920 / 0.3203 degrees, exact "±X ±Y ±Z", Xyz::biased(8);
    }
    #[cfg(feature = "xyz")]
    "Crytek's best-fit normals: the bits of [`XyzUnorm8x3`], of the length that a table of 256 KiB gives for the direction. \
     `encode_precise` needs no table, nor does decoding; a program that does not call `encode` does not contain it.", mirrors "X Y Z", unstable, none AllBits, pair none {
        CrytekBfn24: [u8; 3] = "CrytekBFN24", 24 bits, 0.3191 / 0.3191 degrees, exact "", BestFit::new();
    }
    #[cfg(feature = "phi-z")]
    "Azimuth and z, each as unorm [parameter](Codec#bit-layout), (phi / pi + 1) / 2 and (z + 1) / 2.", mirrors "Y Z", stable, none AllBits, pair unorm {
        PhiZUnorm8x2: u16 = "phi-z-unorm8x2", 16 bits, 5.097 / 3.605 degrees, exact "±Z", PhiZ::new(16);
        PhiZUnorm16x2: u32 = "phi-z-unorm16x2", 32 bits, 0.3193 / 0.2248 degrees, exact "±Z", PhiZ::new(32);
    }
    #[cfg(feature = "oct")]
    "[Octahedral](https://jcgt.org/published/0003/02/01/), each parameter as unorm, (c + 1) / 2, as a UNORM render target \
     holds it. Two [parameters](Codec#bit-layout).", mirrors "X Y", stable, none Zero, pair unorm {
        OctUnorm8x2: u16 = "oct-unorm8x2", 16 bits, 0.9571 / 0.6381 degrees, exact "-Z", OctUnorm::new(16);
        OctUnorm16x2: u32 = "oct-unorm16x2", 32 bits, 0.003746 / 0.002486 degrees, exact "-Z", OctUnorm::new(32);
    }
    #[cfg(feature = "icosphere")]
    "Icosphere: the nearest of the 162 vertices of an icosahedron with edges cut into four, as Quake 2 had them. Codes from \
     162 read as 161. A table of 2 KB.", mirrors "X Y Z", stable, none AllBits, pair none {
        Icosphere162: u8 = "icosphere162", 8 bits, 10.86 / 10.86 degrees, exact "±X ±Y ±Z", Icosphere::new();
    }
    } };
}
pub(crate) use codec_table;

/// Calls a macro with each codec whose row has a flag: `for_each_codec!(octant: check)` is
/// `check!(Oct8); check!(Oct10);` and so on. The tests and tools of this repository, in which all
/// features are on, have their lists from it. In this crate, `for_each_codec!(@row octant: check)` gives
/// the code, the bits and the formula too, if the feature of the codec is on.
#[doc(hidden)]
#[macro_export]
macro_rules! for_each_codec {
    ($flag:ident: $callback:ident) => {
        $crate::codec_table! { [$crate::for_each_codec] @rows [$flag [$callback]] }
    };
    (@row $flag:ident: $callback:ident) => {
        $crate::codec_table! { [$crate::for_each_codec] @rows [$flag [@row $callback]] }
    };
    (@rows $job:tt $(
        #[cfg(feature = $feature:literal)]
        $family:literal, mirrors $mirrors:literal, $stable:ident, none $none:ident , pair $pair:ident {$(
            $name:ident: $code:ty = $text:literal, $bits:literal bits, $fast:literal / $precise:literal degrees,
                exact $axes:tt $(/ $axes_precise:tt)?,
                $formula:ident $(::<$($kind:ident),+>)? :: $new:ident ($($value:expr),*) $(, $flag:ident)*;
        )*}
    )*) => {
        $($($crate::for_each_codec! {
            @flags $job
            [#[cfg(feature = $feature)] $name, $code, $bits, $formula $(::<$($kind),+>)? :: $new($($value),*)]
            $($flag)*
        })*)*
    };
    (@flags [octant $call:tt] $row:tt octant $($rest:ident)*) => {
        $crate::for_each_codec! { @call $call $row }
    };
    (@flags [stochastic $call:tt] $row:tt stochastic $($rest:ident)*) => {
        $crate::for_each_codec! { @call $call $row }
    };
    (@flags [finer $call:tt] $row:tt finer $($rest:ident)*) => {
        $crate::for_each_codec! { @call $call $row }
    };
    (@flags $job:tt $row:tt $flag:ident $($rest:ident)*) => {
        $crate::for_each_codec! { @flags $job $row $($rest)* }
    };
    (@flags $job:tt $row:tt) => {};
    (@call [$callback:ident] [#[cfg(feature = $feature:literal)] $name:ident, $($rest:tt)*]) => { $callback!($name); };
    (@call [@row $callback:ident] [#[cfg(feature = $feature:literal)] $($row:tt)*]) => {
        #[cfg(feature = $feature)]
        $callback!($($row)*);
    };
}
pub(crate) use for_each_codec;
