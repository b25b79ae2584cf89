//! The figures that Cigolle et al. published in "A Survey of Efficient Representations for
//! Independent Unit Vectors" (Journal of Computer Graphics Techniques 3(2), 2014), in degrees over
//! a million uniform random vectors.

use unitpack::Format;

/// One row of a table in the survey.
pub struct Published {
    /// As [`Format::name`] gives it.
    pub format: &'static str,
    /// Whether the row is of the precise encoder: its name in the survey ends in P.
    pub precise: bool,
    pub mean: f64,
    pub max: f64,
}

/// How a measured row compares with a published one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Reproduced,
    /// The mean is lower than published, the maximum is not higher.
    Better,
    Worse,
}

impl Published {
    /// The mean is reproduced within 0.5 %, the maximum within 4 % or better: it rests on the few
    /// worst of the random vectors. Both were printed with five decimals, so half of the last one
    /// comes on top.
    pub fn verdict(&self, mean: f64, max: f64) -> Verdict {
        const ROUNDING: f64 = 0.5e-5;
        let tolerance = 0.005 * self.mean + ROUNDING;
        if mean > self.mean + tolerance || max > 1.04 * self.max + ROUNDING {
            Verdict::Worse
        } else if mean < self.mean - tolerance {
            Verdict::Better
        } else {
            Verdict::Reproduced
        }
    }
}

/// The published row of a format over the sphere (Table 1) or the hemisphere z >= 0 (Table 3).
pub fn find(format: Format, precise: bool, hemisphere: bool) -> Option<&'static Published> {
    let table = if hemisphere { TABLE_3 } else { TABLE_1 };
    table.iter().find(|row| row.format == format.name() && row.precise == precise)
}

const fn fast(format: &'static str, mean: f64, max: f64) -> Published {
    Published { format, precise: false, mean, max }
}

const fn precise(format: &'static str, mean: f64, max: f64) -> Published {
    Published { format, precise: true, mean, max }
}

/// Table 1: the sphere.
pub const TABLE_1: &[Published] = &[
    fast("CrytekBFN24", 0.04027, 4.78260),
    fast("snorm5x3", 1.45262, 3.26743),
    fast("stereo+concentric16", 0.37364, 1.29985),
    fast("eqdist+concentric16", 0.36114, 1.05603),
    fast("eqarea+concentric16", 0.36584, 1.00697),
    fast("stereo16", 0.40140, 1.00318),
    fast("stereo+ellipse16", 0.38233, 1.00318),
    fast("eqarea16", 0.38716, 0.96092),
    fast("oct16", 0.33709, 0.94424),
    fast("eqarea+ellipse16", 0.35217, 0.90617),
    fast("eqdist+ellipse16", 0.35663, 0.79669),
    fast("eqdist16", 0.38452, 0.78944),
    fast("latlong16", 0.35560, 0.78846),
    fast("spherical16", 0.35527, 0.78685),
    precise("oct16", 0.31485, 0.63575),
    fast("latlong16D", 0.30351, 0.56178),
    fast("snorm8x3", 0.17015, 0.38588),
    precise("snorm8x3", 0.03164, 0.33443),
    fast("stereo+concentric20", 0.09290, 0.32722),
    fast("stereo+ellipse20", 0.09494, 0.26171),
    fast("eqdist+concentric20", 0.08975, 0.25856),
    fast("stereo20", 0.09980, 0.24779),
    fast("eqarea+concentric20", 0.09096, 0.24671),
    fast("eqarea20", 0.09627, 0.24355),
    fast("oct20", 0.08380, 0.23467),
    fast("eqarea+ellipse20", 0.08758, 0.22567),
    fast("eqdist20", 0.09541, 0.19667),
    fast("eqdist+ellipse20", 0.08851, 0.19633),
    fast("spherical20", 0.08847, 0.19632),
    fast("stereo+concentric22", 0.04642, 0.16228),
    precise("oct20", 0.07829, 0.15722),
    fast("stereo+ellipse22", 0.04746, 0.14104),
    fast("eqdist+concentric22", 0.04484, 0.12983),
    fast("stereo22", 0.04979, 0.12437),
    fast("eqarea+concentric22", 0.04545, 0.12304),
    fast("eqarea22", 0.04806, 0.11915),
    fast("oct22", 0.04180, 0.11734),
    fast("eqarea+ellipse22", 0.04374, 0.11238),
    fast("eqdist+ellipse22", 0.04418, 0.10132),
    fast("spherical22", 0.04423, 0.09809),
    fast("eqdist22", 0.04768, 0.09806),
    fast("snorm10x3", 0.04228, 0.09598),
    fast("stereo+concentric24", 0.02319, 0.08305),
    fast("stereo+ellipse24", 0.02372, 0.08093),
    precise("oct22", 0.03905, 0.07898),
    fast("snorm11-11-10", 0.02937, 0.06776),
    fast("eqdist+concentric24", 0.02241, 0.06548),
    fast("eqarea+concentric24", 0.02273, 0.06265),
    fast("stereo24", 0.02490, 0.06230),
    fast("eqarea24", 0.02402, 0.06067),
    fast("oct24", 0.02091, 0.05874),
    fast("eqdist+ellipse24", 0.02208, 0.05704),
    fast("eqarea+ellipse24", 0.02185, 0.05615),
    fast("latlong24", 0.02211, 0.04907),
    fast("spherical24", 0.02209, 0.04906),
    fast("eqdist24", 0.02387, 0.04899),
    precise("oct24", 0.01953, 0.03928),
    fast("latlong24D", 0.01895, 0.03504),
    fast("float16x3", 0.00635, 0.02635),
    fast("stereo+ellipse32", 0.00149, 0.02592),
    fast("eqdist+ellipse32", 0.00138, 0.01807),
    fast("eqarea+ellipse32", 0.00137, 0.01705),
    fast("spherical32", 0.00138, 0.00957),
    fast("stereo32", 0.00155, 0.00547),
    fast("stereo+concentric32", 0.00146, 0.00522),
    fast("eqdist+concentric32", 0.00141, 0.00409),
    fast("eqarea+concentric32", 0.00142, 0.00391),
    fast("eqarea32", 0.00150, 0.00383),
    fast("latlong32D", 0.00119, 0.00381),
    fast("oct32", 0.00131, 0.00370),
    fast("latlong32", 0.00138, 0.00324),
    fast("eqdist32", 0.00149, 0.00307),
    precise("oct32", 0.00122, 0.00246),
    fast("snorm16x3", 0.00066, 0.00149),
    precise("snorm16x3", 0.00060, 0.00149),
];

/// Table 3: the hemisphere z >= 0.
pub const TABLE_3: &[Published] = &[
    fast("XYOnly16", 0.46669, 5.71419),
    fast("XYOnly32F", 0.07759, 2.10047),
    fast("XYOnly24", 0.03844, 1.43251),
    precise("oct16", 0.31485, 0.63574),
    fast("HemiOct16", 0.24000, 0.55112),
    fast("XYOnly32", 0.00298, 0.35281),
    precise("oct24", 0.01953, 0.03928),
    fast("HemiOct24", 0.01489, 0.03406),
    precise("oct32", 0.00122, 0.00246),
    fast("HemiOct32", 0.00093, 0.00213),
];
