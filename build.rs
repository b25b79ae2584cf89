//! Builds the tables that are too large for const evaluation, from the same definitions as the
//! formulas. Only + - * / and sqrt of f64 are used, which round the same on every host.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let out = env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
    let write = |feature: &str, name: &str, table: fn() -> Vec<u8>| {
        if env::var_os(feature).is_some() {
            fs::write(Path::new(&out).join(name), table()).expect("OUT_DIR is writable");
        }
    };
    write("CARGO_FEATURE_LATLONG", "latlong_bands.rs", || latlong_bands().into_bytes());
    write("CARGO_FEATURE_XYZ", "best_fit.bin", best_fit);
}

/// CrytekBFN24's lengths: see src/formula/cartesian/best_fit.rs.
fn best_fit() -> Vec<u8> {
    let mut table = Vec::with_capacity(512 * 512);
    for j in 0..512 {
        for i in 0..512 {
            let u = (f64::from(i) + 0.5) / 512.0;
            let w = u * (f64::from(j) + 0.5) / 512.0;
            // The squared sine of the angle between (1, u, w) and its rounding at length (2 k - 1)
            // / 255: the least, largest k first.
            let mut best = (f64::INFINITY, 0);
            for k in (1..=128).rev() {
                let a = f64::from(2 * k - 1);
                let odd = |t: f64| 2.0 * ((t * a + 255.0) / 2.0).round() - 255.0;
                let (b, c) = (odd(u), odd(w));
                let (x, y, z) = (b * w - c * u, c - a * w, a * u - b);
                let sine = (x * x + y * y + z * z) / (a * a + b * b + c * c);
                if sine < best.0 {
                    best = (sine, 2 * k - 1);
                }
            }
            table.push(best.1 as u8);
        }
    }
    table
}

/// sin(x) for 0 <= x <= pi / 2 + 1e-3, by its series.
fn sin(x: f64) -> f64 {
    let mut term = x;
    let mut sum = x;
    for i in 1..14 {
        term *= -x * x / ((2 * i) as f64 * (2 * i + 1) as f64);
        sum += term;
    }
    sum
}

/// asin(s) for 0 <= s <= 1, by Newton's method on sin.
fn asin(s: f64) -> f64 {
    let mut x = s;
    for _ in 0..40 {
        let c = (1.0 - sin(x) * sin(x)).max(1e-30).sqrt();
        x += (s - sin(x)) / c;
        x = x.clamp(0.0, std::f64::consts::FRAC_PI_2);
    }
    x
}

/// Points on each parallel of latlongD: as many as keep every direction within `e` radians.
///
/// The direction furthest from the points of parallel f lies half way between two of them, on the
/// parallel g half way to the next one towards the equator. With d the angle at the pole between it
/// and a point, cos e = cos f cos g + sin f sin g cos d; in haversines sin^2(d / 2) = (sin^2(e / 2)
/// - sin^2((f - g) / 2)) / (sin f sin g), without cancellation.
fn points(parallels: u32, e: f64) -> Vec<u32> {
    let last = parallels - 1;
    let step = std::f64::consts::PI / f64::from(last);
    let numerator = sin(e / 2.0) * sin(e / 2.0) - sin(step / 4.0) * sin(step / 4.0);
    let north: Vec<u32> = (0..=last / 2)
        .map(|j| {
            if j == 0 {
                return 1;
            }
            let f = f64::from(j) * step;
            // On the equator itself the way goes to either side.
            let g = if 2 * j == last { f - step / 2.0 } else { f + step / 2.0 };
            let half = (numerator / (sin(f) * sin(g))).sqrt();
            if half >= 1.0 { 1 } else { (std::f64::consts::PI / (2.0 * asin(half))).ceil() as u32 }
        })
        .collect();
    (0..=last).map(|j| north[j.min(last - j) as usize]).collect()
}

fn latlong_bands() -> String {
    let mut code = String::new();
    for (bits, parallels, e) in LATLONG_D {
        let mut begin = 0u64;
        let mut begins = vec![0, 0];
        for count in points(parallels, e.to_radians()) {
            begin += u64::from(count);
            begins.push(begin);
        }
        begins.push(begin);
        assert!(begin <= 1 << bits, "latlong{bits}D has {begin} points");
        writeln!(
            code,
            "const BEGINS_{bits}: &[u32] = {{ static TABLE: [u32; {}] = {begins:?}; &TABLE }};",
            begins.len()
        )
        .expect("a String can be written to");
    }
    code
}

/// Bits, parallels, and e in degrees: the least with which all points fit, and a hundred-billionth
/// more, so that no parallel stands on the edge of one more point.
const LATLONG_D: [(u32, u32, f64); 3] = [
    (16, 227, 0.5624318720294313),
    (24, 3629, 0.03506896562144907),
    (32, 58073, 0.002191477662428091),
];
