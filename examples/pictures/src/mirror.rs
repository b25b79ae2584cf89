//! A mirror sphere whose normals went through a format.

use unitpack::Format;
use unitpack_test::Arrays;
use unitpack_test::vectors::{dot, normalize};

use crate::canvas::{BODY, BOLD, Canvas, GAP, LINE, RED, Rgb, TITLE, sheet, squarish, text_width};
use crate::geometry::{V3, in_disc};
use crate::raster::Raster;
use crate::round_trip::Encoder;

/// What differences are multiplied by.
const AMPLIFIED: f64 = 4.0;
/// Samples along the side of a pixel.
const SAMPLES: usize = 3;
/// Degrees that a line in the sky is wide.
const LINES: f64 = 1.2;
/// What details are magnified by.
const MAGNIFIED: usize = 4;

/// A sphere for a page, and a third as large for the overview.
pub struct Sphere {
    large: Canvas,
    small: Canvas,
}

impl Sphere {
    pub fn exact(size: usize) -> Sphere {
        Sphere::render(size, |normals| normals.wide().map(reflected).collect())
    }

    fn through(encoder: Encoder, size: usize) -> Sphere {
        Sphere::render(size, |n| encoder.round_trip(n).wide().map(reflected).collect())
    }

    /// Seen along the parallel rays of an eye at +Z.
    fn render(size: usize, light: impl Fn(&Arrays) -> Vec<[f64; 3]>) -> Sphere {
        let normal = |[right, up]: [f64; 2]| {
            let square = right * right + up * up;
            in_disc([right, up]).then(|| [right, up, (1.0 - square).max(0.0).sqrt()])
        };
        let large = Raster::sample(size, SAMPLES, normal, light);
        let paint = |light: &Raster<3>| {
            let mut canvas = Canvas::new(light.size, light.size);
            light.paint(&mut canvas, 0, 0, srgb);
            canvas
        };
        Sphere { small: paint(&large.smaller(3)), large: paint(&large) }
    }
}

/// The light that comes from where a mirror with this normal shows.
fn reflected(normal: V3) -> [f64; 3] {
    let towards_eye = [0.0, 0.0, 1.0];
    let twice = 2.0 * dot(normal, towards_eye);
    environment(normalize([0, 1, 2].map(|i| twice * normal[i] - towards_eye[i])))
}

/// Linear light: a sky with lines and a sun above a floor in checks. +Y is up.
fn environment([x, y, z]: V3) -> [f64; 3] {
    let mix = |a: [f64; 3], b: [f64; 3], t: f64| [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * t);
    if y < 0.0 {
        // A plane one unit below the eye, darker far away.
        let (u, v) = (x / -y, z / -y);
        let far = u.hypot(v);
        let odd = (u.floor() + v.floor()).rem_euclid(2.0) == 1.0;
        let check = if odd { [0.75, 0.7, 0.6] } else { [0.05, 0.06, 0.1] };
        return mix(check, [0.3, 0.28, 0.25], (far / 12.0).min(1.0));
    }
    let sun = normalize([0.5, 0.6, 0.62]);
    if dot([x, y, z], sun) > 0.985 {
        return [1.0, 0.85, 0.35];
    }
    let (height, azimuth) = (y.asin().to_degrees(), x.atan2(z).to_degrees());
    // Lines 10 degrees apart, about one wide, but not on the horizon nor near the zenith.
    let line = |angle: f64, wide: f64| (angle - (angle / 10.0).round() * 10.0).abs() < wide / 2.0;
    let parallel = height > 5.0 && line(height, LINES);
    if parallel || height < 80.0 && line(azimuth, LINES / height.to_radians().cos()) {
        return [0.9, 0.95, 1.0];
    }
    mix([0.45, 0.6, 0.8], [0.03, 0.1, 0.4], height / 90.0)
}

fn srgb(light: [f64; 3]) -> Rgb {
    light.map(|c| {
        let c = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
        (255.0 * c.clamp(0.0, 1.0)).round() as u8
    })
}

/// The amplified difference, and its mean over the sphere before that.
fn difference(a: &Canvas, b: &Canvas) -> (Canvas, f64) {
    let mut canvas = Canvas::new(a.width(), a.width());
    let (mut sum, mut count) = (0.0, 0);
    let radius = a.width() as f64 / 2.0;
    for y in 0..a.width() {
        for x in 0..a.width() {
            if (x as f64 + 0.5 - radius).hypot(y as f64 + 0.5 - radius) < radius {
                let (a, b) = (a.pixel(x, y), b.pixel(x, y));
                let off = [0, 1, 2].map(|i| f64::from(a[i].abs_diff(b[i])));
                sum += off.iter().sum::<f64>() / 3.0;
                count += 1;
                canvas.set(x, y, off.map(|d| (AMPLIFIED * d).min(255.0) as u8));
            }
        }
    }
    (canvas, sum / f64::from(count))
}

/// The page of a format, and its tile on the overview.
pub fn page_and_tile(format: Format, exact: &Sphere) -> (Canvas, Canvas) {
    let size = exact.large.width();
    let spheres = Encoder::both(format).map(|encoder| Sphere::through(encoder, size));
    let columns = [
        column("exact normals", exact, None),
        column("encode", &spheres[0], Some(exact)),
        column("encode_precise", &spheres[1], Some(exact)),
    ];
    let notes = [
        "A mirror seen from +Z, whose normals were encoded and decoded. It doubles their error.",
        "Black in a difference: the same.",
    ];
    let page = sheet(&format!("{format}: mirror sphere"), &notes, None, columns.len(), &columns);
    (page, tile(format, &spheres, exact))
}

fn column(name: &str, sphere: &Sphere, exact: Option<&Sphere>) -> Canvas {
    let size = sphere.large.width();
    let step = LINE + size + GAP;
    let mut canvas = Canvas::new(size.max(370), 3 * step - GAP);
    canvas.text(0, 0, BOLD, name);
    canvas.paste(0, LINE, &sphere.large);
    let (corner, side) = (3 * size / 8, size / MAGNIFIED);
    canvas.frame(corner, LINE + corner, side, side, RED);

    canvas.text(0, step, BODY, &format!("what is framed, {MAGNIFIED} times as large"));
    let detail = sphere.large.part(corner, corner, side, side).enlarged(MAGNIFIED);
    canvas.paste(0, step + LINE, &detail);

    if let Some(exact) = exact {
        let (difference, mean) = difference(&exact.large, &sphere.large);
        let text = format!("difference × {AMPLIFIED}, mean {mean:.2} of 255 before that");
        canvas.text(0, 2 * step, BODY, &text);
        canvas.paste(0, 2 * step + LINE, &difference);
    }
    canvas
}

fn tile(format: Format, spheres: &[Sphere; 2], exact: &Sphere) -> Canvas {
    let size = exact.small.width();
    let means = spheres.each_ref().map(|sphere| difference(&exact.large, &sphere.large).1);
    let text = format!("mean difference {:.2} / {:.2}", means[0], means[1]);
    let width = (2 * size + GAP / 2).max(text_width(BODY, &text));
    let mut canvas = Canvas::new(width, 24 + LINE + 2 * size + GAP / 2);
    canvas.text(0, 0, TITLE, format.name());
    canvas.text(0, 24, BODY, &text);
    for (i, sphere) in spheres.iter().enumerate() {
        let (x, y) = (i * (size + GAP / 2), 24 + LINE);
        canvas.paste(x, y, &sphere.small);
        let (difference, _) = difference(&exact.small, &sphere.small);
        canvas.paste(x, y + size + GAP / 2, &difference);
    }
    canvas
}

/// The exact sphere before the tiles of the codecs.
pub fn overview(exact: &Sphere, mut tiles: Vec<Canvas>) -> Canvas {
    let size = exact.small.width();
    let title = "exact normals";
    let mut first = Canvas::new(size.max(text_width(TITLE, title)), 24 + LINE + size);
    first.text(0, 0, TITLE, title);
    first.paste(0, 24 + LINE, &exact.small);
    tiles.insert(0, first);
    let notes = [
        "A mirror seen from +Z, whose normals were encoded and decoded.",
        "Left with encode, right with encode_precise.",
        &format!("Below: the difference, × {AMPLIFIED}. Its mean is before that, of 255."),
    ];
    sheet("Mirror sphere through the 16-bit codecs", &notes, None, squarish(&tiles), &tiles)
}
