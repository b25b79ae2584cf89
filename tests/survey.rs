//! The published figures: Tables 1 and 3 of Cigolle et al., "A Survey of Efficient Representations
//! for Independent Unit Vectors", 2014, on a million uniform vectors of our own.
//!
//! A row is reproduced if the mean is within 0.5 % and the maximum within 4 % of the published one.
//! [`expectation`] names the rows for which that is not asked, and why.

use crate::common::*;
use unitpack::Format;

#[derive(Clone, Copy, PartialEq)]
enum Encoder {
    Fast,
    Precise,
}
use Encoder::{Fast, Precise};

/// Whether the published maximum owes its size to `f32` intermediates, which the survey's tables
/// mark.
#[derive(Clone, Copy, PartialEq)]
enum Maximum {
    Exact,
    Float32,
}
use Maximum::{Exact, Float32};

/// Name, format, encoder, mean and greatest error in degrees.
type Row = (&'static str, &'static str, Encoder, f64, f64, Maximum);

/// How many rows there are codecs for. A codec that goes missing must not take its row along
/// unseen.
const COVERED: usize = 33;

#[rustfmt::skip]
const TABLE_1: [Row; 75] = [
    ("CrytekBFN24", "CrytekBFN24", Fast, 0.04027, 4.78260, Exact),
    ("snorm5x3", "snorm5x3", Fast, 1.45262, 3.26743, Exact),
    ("stereo+concentric16", "stereo+concentric16", Fast, 0.37364, 1.29985, Exact),
    ("eqdist+concentric16", "eqdist+concentric16", Fast, 0.36114, 1.05603, Exact),
    ("eqarea+concentric16", "eqarea+concentric16", Fast, 0.36584, 1.00697, Exact),
    ("stereo16", "stereo16", Fast, 0.40140, 1.00318, Exact),
    ("stereo+ellipse16", "stereo+ellipse16", Fast, 0.38233, 1.00318, Exact),
    ("eqarea16", "eqarea16", Fast, 0.38716, 0.96092, Exact),
    ("oct16", "oct16", Fast, 0.33709, 0.94424, Exact),
    ("eqarea+ellipse16", "eqarea+ellipse16", Fast, 0.35217, 0.90617, Exact),
    ("eqdist+ellipse16", "eqdist+ellipse16", Fast, 0.35663, 0.79669, Float32),
    ("eqdist16", "eqdist16", Fast, 0.38452, 0.78944, Exact),
    ("latlong16", "latlong16", Fast, 0.35560, 0.78846, Exact),
    ("spherical16", "spherical16", Fast, 0.35527, 0.78685, Exact),
    ("oct16P", "oct16", Precise, 0.31485, 0.63575, Exact),
    ("latlong16D", "latlong16D", Fast, 0.30351, 0.56178, Exact),
    ("snorm8x3", "snorm8x3", Fast, 0.17015, 0.38588, Exact),
    ("snorm8x3P", "snorm8x3", Precise, 0.03164, 0.33443, Exact),
    ("stereo+concentric20", "stereo+concentric20", Fast, 0.09290, 0.32722, Exact),
    ("stereo+ellipse20", "stereo+ellipse20", Fast, 0.09494, 0.26171, Exact),
    ("eqdist+concentric20", "eqdist+concentric20", Fast, 0.08975, 0.25856, Exact),
    ("stereo20", "stereo20", Fast, 0.09980, 0.24779, Exact),
    ("eqarea+concentric20", "eqarea+concentric20", Fast, 0.09096, 0.24671, Exact),
    ("eqarea20", "eqarea20", Fast, 0.09627, 0.24355, Exact),
    ("oct20", "oct20", Fast, 0.08380, 0.23467, Exact),
    ("eqarea+ellipse20", "eqarea+ellipse20", Fast, 0.08758, 0.22567, Exact),
    ("eqdist20", "eqdist20", Fast, 0.09541, 0.19667, Exact),
    ("eqdist+ellipse20", "eqdist+ellipse20", Fast, 0.08851, 0.19633, Exact),
    ("spherical20", "spherical20", Fast, 0.08847, 0.19632, Exact),
    ("stereo+concentric22", "stereo+concentric22", Fast, 0.04642, 0.16228, Exact),
    ("oct20P", "oct20", Precise, 0.07829, 0.15722, Exact),
    ("stereo+ellipse22", "stereo+ellipse22", Fast, 0.04746, 0.14104, Exact),
    ("eqdist+concentric22", "eqdist+concentric22", Fast, 0.04484, 0.12983, Exact),
    ("stereo22", "stereo22", Fast, 0.04979, 0.12437, Exact),
    ("eqarea+concentric22", "eqarea+concentric22", Fast, 0.04545, 0.12304, Exact),
    ("eqarea22", "eqarea22", Fast, 0.04806, 0.11915, Exact),
    ("oct22", "oct22", Fast, 0.04180, 0.11734, Exact),
    ("eqarea+ellipse22", "eqarea+ellipse22", Fast, 0.04374, 0.11238, Exact),
    ("eqdist+ellipse22", "eqdist+ellipse22", Fast, 0.04418, 0.10132, Exact),
    ("spherical22", "spherical22", Fast, 0.04423, 0.09809, Exact),
    ("eqdist22", "eqdist22", Fast, 0.04768, 0.09806, Exact),
    ("snorm10x3", "snorm10x3", Fast, 0.04228, 0.09598, Exact),
    ("stereo+concentric24", "stereo+concentric24", Fast, 0.02319, 0.08305, Exact),
    ("stereo+ellipse24", "stereo+ellipse24", Fast, 0.02372, 0.08093, Float32),
    ("oct22P", "oct22", Precise, 0.03905, 0.07898, Exact),
    ("snorm11-11-10", "snorm11-11-10", Fast, 0.02937, 0.06776, Exact),
    ("eqdist+concentric24", "eqdist+concentric24", Fast, 0.02241, 0.06548, Exact),
    ("eqarea+concentric24", "eqarea+concentric24", Fast, 0.02273, 0.06265, Exact),
    ("stereo24", "stereo24", Fast, 0.02490, 0.06230, Exact),
    ("eqarea24", "eqarea24", Fast, 0.02402, 0.06067, Float32),
    ("oct24", "oct24", Fast, 0.02091, 0.05874, Exact),
    ("eqdist+ellipse24", "eqdist+ellipse24", Fast, 0.02208, 0.05704, Float32),
    ("eqarea+ellipse24", "eqarea+ellipse24", Fast, 0.02185, 0.05615, Float32),
    ("latlong24", "latlong24", Fast, 0.02211, 0.04907, Exact),
    ("spherical24", "spherical24", Fast, 0.02209, 0.04906, Exact),
    ("eqdist24", "eqdist24", Fast, 0.02387, 0.04899, Exact),
    ("oct24P", "oct24", Precise, 0.01953, 0.03928, Exact),
    ("latlong24D", "latlong24D", Fast, 0.01895, 0.03504, Exact),
    ("float16x3", "float16x3", Fast, 0.00635, 0.02635, Exact),
    ("stereo+ellipse32", "stereo+ellipse32", Fast, 0.00149, 0.02592, Float32),
    ("eqdist+ellipse32", "eqdist+ellipse32", Fast, 0.00138, 0.01807, Float32),
    ("eqarea+ellipse32", "eqarea+ellipse32", Fast, 0.00137, 0.01705, Float32),
    ("spherical32", "spherical32", Fast, 0.00138, 0.00957, Exact),
    ("stereo32", "stereo32", Fast, 0.00155, 0.00547, Float32),
    ("stereo+concentric32", "stereo+concentric32", Fast, 0.00146, 0.00522, Exact),
    ("eqdist+concentric32", "eqdist+concentric32", Fast, 0.00141, 0.00409, Exact),
    ("eqarea+concentric32", "eqarea+concentric32", Fast, 0.00142, 0.00391, Float32),
    ("eqarea32", "eqarea32", Fast, 0.00150, 0.00383, Exact),
    ("latlong32D", "latlong32D", Fast, 0.00119, 0.00381, Float32),
    ("oct32", "oct32", Fast, 0.00131, 0.00370, Exact),
    ("latlong32", "latlong32", Fast, 0.00138, 0.00324, Float32),
    ("eqdist32", "eqdist32", Fast, 0.00149, 0.00307, Exact),
    ("oct32P", "oct32", Precise, 0.00122, 0.00246, Exact),
    ("snorm16x3", "snorm16x3", Fast, 0.00066, 0.00149, Exact),
    ("snorm16x3P", "snorm16x3", Precise, 0.00060, 0.00149, Exact),
];

/// Of the +Z hemisphere.
#[rustfmt::skip]
const TABLE_3: [Row; 10] = [
    ("XYOnly16", "XYOnly16", Fast, 0.46669, 5.71419, Exact),
    ("XYOnly32F", "XYOnly32F", Fast, 0.07759, 2.10047, Exact),
    ("XYOnly24", "XYOnly24", Fast, 0.03844, 1.43251, Exact),
    ("oct16P", "oct16", Precise, 0.31485, 0.63574, Exact),
    ("HemiOct16", "HemiOct16", Fast, 0.24000, 0.55112, Exact),
    ("XYOnly32", "XYOnly32", Fast, 0.00298, 0.35281, Exact),
    ("oct24P", "oct24", Precise, 0.01953, 0.03928, Exact),
    ("HemiOct24", "HemiOct24", Fast, 0.01489, 0.03406, Exact),
    ("oct32P", "oct32", Precise, 0.00122, 0.00246, Exact),
    ("HemiOct32", "HemiOct32", Fast, 0.00093, 0.00213, Exact),
];

/// What is asked of a row, as bounds on ours over the published: of the mean, and of the maximum.
struct Expectation {
    mean: (f64, f64),
    max: (f64, f64),
}

fn within(tolerance: f64) -> (f64, f64) {
    (1.0 - tolerance, 1.0 + tolerance)
}

const NO_WORSE: (f64, f64) = (0.0, 1.0);

fn expectation((row, _, _, _, _, maximum): Row) -> Expectation {
    let reproduced = Expectation { mean: within(0.005), max: within(0.04) };
    match row {
        // Halves are rounded to nearest here and were truncated there.
        "float16x3" | "XYOnly32F" => Expectation { mean: NO_WORSE, max: NO_WORSE },
        // The nearest code of the direction; theirs looks one length up in a table.
        "snorm8x3P" | "snorm16x3P" => Expectation { mean: NO_WORSE, max: NO_WORSE },
        // Their table had wrong entries, hence the maximum. Its mean is not reproduced by any table
        // that was tried, but nearly.
        "CrytekBFN24" => Expectation { mean: within(0.03), max: NO_WORSE },
        // Their maximum comes from acos(z) near a pole, in f32.
        "spherical32" => Expectation { max: NO_WORSE, ..reproduced },
        // No quantiser is known that gives the published mean at 16 to 24 bits.
        _ if row.contains("concentric") => Expectation { mean: within(0.01), ..reproduced },
        _ if maximum == Float32 => Expectation { max: (0.0, 1.04), ..reproduced },
        _ => reproduced,
    }
}

/// How many vectors the time allows.
fn budget((row, ..): Row) -> usize {
    match row {
        "snorm16x3P" => 20_000,
        _ => 1_000_000,
    }
}

/// Mean and greatest error of a round trip, in degrees.
fn measure(format: Format, encoder: Encoder, vectors: &[[f32; 3]]) -> (f64, f64) {
    let encode = if encoder == Fast { encode } else { encode_precise };
    let (mut sum, mut greatest) = (0.0, 0.0f64);
    for chunk in vectors.chunks(1 << 14) {
        for (v, w) in chunk.iter().zip(decode(format, &encode(format, chunk))) {
            let error = angle(widen(*v), widen(w)).to_degrees();
            sum += error;
            greatest = greatest.max(error);
        }
    }
    (sum / vectors.len() as f64, greatest)
}

fn covered(rows: &[Row]) -> Vec<(Format, Row)> {
    rows.iter().filter_map(|&row| Some((Format::from_name(row.1)?, row))).collect()
}

fn check(format: Format, row: Row, vectors: &[[f32; 3]]) -> Result<(), String> {
    let (name, _, encoder, published_mean, published_max, _) = row;
    let (mean, max) = measure(format, encoder, &vectors[..budget(row)]);
    let (mean_ratio, max_ratio) = (mean / published_mean, max / published_max);
    let line = format!(
        "{name}: mean {mean:.6}, published {published_mean}, ratio {mean_ratio:.4}; \
         max {max:.6}, published {published_max}, ratio {max_ratio:.4}"
    );
    eprintln!("{line}");
    let Expectation { mean, max } = expectation(row);
    let inside = |ratio: f64, (least, greatest)| least <= ratio && ratio <= greatest;
    if inside(mean_ratio, mean) && inside(max_ratio, max) { Ok(()) } else { Err(line) }
}

#[test]
fn published_figures_are_reproduced() {
    let mut rng = Rng::new(2014);
    let sphere: Vec<_> = (0..1_000_000).map(|_| rng.direction()).collect();
    check_all(&covered(&TABLE_1), |&(format, row)| check(format, row, &sphere));
    let hemisphere: Vec<_> = sphere.iter().map(|&[x, y, z]| [x, y, z.abs()]).collect();
    check_all(&covered(&TABLE_3), |&(format, row)| check(format, row, &hemisphere));
}

#[test]
fn no_row_is_lost() {
    assert_eq!(covered(&TABLE_1).len() + covered(&TABLE_3).len(), COVERED);
}
