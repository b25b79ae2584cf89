//! The directions that a format represents.

use std::f64::consts::PI;

use unitpack::Format;
use unitpack_test::{Arrays, Effort};

use crate::canvas::{
    BODY, BOLD, Canvas, GAP, GREY, INK, LINE, Scale, TITLE, WHITE, sheet, squarish, text_width,
};
use crate::error::{POINT_SCALE, neighbourhood, views};
use crate::geometry::View;
use crate::raster::{Raster, blur};
use crate::round_trip::{Encoder, decode};

const DENSITY: Scale = Scale {
    title: "Directions in an area over those of an even distribution of all codes",
    gradient: colorous::RED_BLUE,
    range: [-2.0, 2.0],
    ticks: &[(-2.0, "<= 1/4"), (-1.0, "1/2"), (0.0, "1"), (1.0, "2"), (2.0, ">= 4")],
    above: None,
};

/// Half the width of a close-up on the unit disc: sqrt(2) sin(6 degrees / 2).
const CLOSE: f64 = 0.074_014;

/// What close-ups show.
const PLACES: [(&str, [f64; 3]); 4] = [
    ("around +Z", [0.0, 0.0, 1.0]),
    ("around +X", [1.0, 0.0, 0.0]),
    ("around (1, 0, 1)", [1.0, 0.0, 1.0]),
    ("around (1, 1, 1)", [1.0, 1.0, 1.0]),
];

/// The directions of all codes.
pub struct Points {
    format: Format,
    codes: usize,
    /// Each once.
    directions: Arrays,
}

impl Points {
    pub fn of(format: Format) -> Points {
        let count = 1 << format.bits();
        let codes: Vec<u8> = (0..count)
            .flat_map(|code: u64| code.to_le_bytes().into_iter().take(format.code_size()))
            .collect();
        // Of the codes of one direction, one is canonical.
        let all = decode(format, &codes);
        let canonical = Encoder { format, effort: Effort::Precise }.encode(&all);
        let size = format.code_size();
        let mut directions = Arrays::default();
        for ((v, code), canonical) in all.iter().zip(codes.chunks(size)).zip(canonical.chunks(size))
        {
            if code == canonical {
                directions.push(v);
            }
        }
        Points { format, codes: all.count(), directions }
    }

    fn count(&self) -> String {
        format!("{} directions of {} codes", self.directions.count(), self.codes)
    }

    /// The near hemisphere as dots, and close-ups.
    pub fn page(&self, size: usize) -> Canvas {
        let wide = 2 * (size + LINE) + GAP;
        let mut dots = Canvas::new(wide, LINE + wide);
        dots.text(0, 0, BOLD, &format!("all with z >= 0, {}", views(self.format)[0].1));
        let radius = wide as f64 / 2.0 - 4.0;
        let centre = wide as f64 / 2.0;
        dots.ring(centre, LINE as f64 + centre, radius + 2.5, 1.0, GREY);
        for at in self.directions.wide().filter(|v| v[2] >= 0.0) {
            if let Some([right, up]) = View::FROM_PLUS_Z.equal_area_inverse(at) {
                let (x, y) = (centre + right * radius, LINE as f64 + centre - up * radius);
                dots.disc(x, y, wide as f64 / 800.0, INK);
            }
        }

        let mut close = Canvas::new(2 * size + GAP, LINE + wide);
        for (i, (name, eye)) in PLACES.into_iter().enumerate() {
            let (x, y) = (i % 2 * (size + GAP), i / 2 * (size + LINE + GAP));
            close.text(x, y, BOLD, name);
            self.close_up(&mut close, x, y + LINE, size, View::from(eye));
        }
        let title = format!("{}: {}", self.format, self.count());
        let notes = [
            "Left: a dot for each direction. Right: close-ups 12° wide, coloured by the distance to",
            "the nearest direction, which is the error of encode_precise. Equal areas.",
        ];
        sheet(&title, &notes, Some(&POINT_SCALE), 2, &[dots, close])
    }

    fn close_up(&self, canvas: &mut Canvas, x: usize, y: usize, size: usize, view: View) {
        let hemisphere = self.format.is_hemisphere();
        let encoder = Encoder { format: self.format, effort: Effort::Precise };
        let direction = |at: [f64; 2]| {
            view.equal_area(at.map(|c| c * CLOSE)).filter(|v| !hemisphere || v[2] >= 0.0)
        };
        let errors = |v: &_| encoder.errors(v).into_iter().map(|e| [e]).collect();
        Raster::sample(size, 2, direction, errors).paint(canvas, x, y, |[e]| POINT_SCALE.colour(e));
        canvas.frame(x, y, size, size, GREY);
        let half = size as f64 / 2.0;
        // All rims first: where dots merge, they stay bright.
        let radius = size as f64 / 160.0;
        for (radius, colour) in [(radius + 1.0, INK), (radius, WHITE)] {
            for at in self.directions.wide().filter_map(|v| view.equal_area_inverse(v)) {
                let [right, up] = at.map(|c| c / CLOSE);
                if right.abs().max(up.abs()) < 0.99 {
                    let (x, y) = (x as f64 + half * (1.0 + right), y as f64 + half * (1.0 - up));
                    canvas.disc(x, y, radius, colour);
                }
            }
        }
    }

    /// For the overview: how densely the directions lie.
    pub fn tile(&self, size: usize) -> Canvas {
        let count = self.count();
        let width = (2 * size + GAP / 2).max(text_width(BODY, &count));
        let mut canvas = Canvas::new(width, 24 + LINE + size);
        canvas.text(0, 0, TITLE, self.format.name());
        canvas.text(0, 24, BODY, &count);
        for (i, (view, _)) in views(self.format).iter().enumerate() {
            let x = i * (size + GAP / 2);
            self.density(*view, size).paint(&mut canvas, x, 24 + LINE);
        }
        canvas
    }

    fn density(&self, view: View, size: usize) -> Density {
        let mut density = Density::new(size);
        let hemisphere = self.format.is_hemisphere();
        for v in self.directions.wide() {
            density.add(view.equal_area_inverse(v));
            // Go on evenly beyond the rim.
            if hemisphere && v[2] > 0.0 {
                density.add(view.equal_area_inverse([v[0], v[1], -v[2]]));
            }
        }
        density.pixels = blur(density.side, density.pixels, neighbourhood(size));
        let discs = views(self.format).len();
        let even = self.codes as f64 / (discs as f64 * PI * (size as f64 / 2.0).powi(2));
        density.pixels.iter_mut().for_each(|d| *d /= even);
        density
    }
}

/// How many directions lie around the pixels of a square around the disc.
struct Density {
    /// Of the disc.
    size: usize,
    /// What the square has beyond it on either side, so that the rim has its neighbours.
    margin: usize,
    side: usize,
    pixels: Vec<f64>,
}

impl Density {
    fn new(size: usize) -> Density {
        let margin = size / 8;
        let side = size + 2 * margin;
        Density { size, margin, side, pixels: vec![0.0; side * side] }
    }

    /// Shares a direction among the four nearest pixels.
    fn add(&mut self, at: Option<[f64; 2]>) {
        let Some([right, up]) = at else { return };
        let half = self.size as f64 / 2.0;
        let middle = half + self.margin as f64 - 0.5;
        let (x, y) = (middle + right * half, middle - up * half);
        let last = (self.side - 1) as f64;
        if x.min(y) < 0.0 || x.max(y) >= last {
            return;
        }
        let (right, down) = (x.fract(), y.fract());
        let i = y as usize * self.side + x as usize;
        self.pixels[i] += (1.0 - right) * (1.0 - down);
        self.pixels[i + 1] += right * (1.0 - down);
        self.pixels[i + self.side] += (1.0 - right) * down;
        self.pixels[i + self.side + 1] += right * down;
    }

    fn paint(&self, canvas: &mut Canvas, x: usize, y: usize) {
        let half = self.size as f64 / 2.0;
        for row in 0..self.size {
            for column in 0..self.size {
                let density = self.pixels[(row + self.margin) * self.side + column + self.margin];
                let away = (column as f64 + 0.5 - half).hypot(row as f64 + 0.5 - half);
                let share = (half + 0.5 - away).clamp(0.0, 1.0);
                let colour = DENSITY.colour(density.max(1e-9).log2());
                canvas.blend(x + column, y + row, colour, share);
            }
        }
        canvas.ring(x as f64 + half, y as f64 + half, half - 0.5, 1.0, GREY);
    }
}

pub fn overview(tiles: &[Canvas]) -> Canvas {
    let notes = [
        "How many directions a codec represents in an area.",
        "Left from +Z (x right), right from -Z (x left), y up; one disc: z >= 0 only. Equal areas.",
    ];
    sheet("Directions of the 16-bit codecs", &notes, Some(&DENSITY), squarish(tiles), tiles)
}
