//! The error over the sphere.

use unitpack::Format;

use crate::canvas::{
    BODY, BOLD, Canvas, GAP, LINE, RED, Scale, TITLE, sheet, squarish, text_width,
};
use crate::geometry::{View, in_disc};
use crate::raster::Raster;
use crate::round_trip::Encoder;

/// Of the overview.
const SCALE: Scale = Scale {
    title: "Mean error around each point",
    gradient: colorous::VIRIDIS,
    range: [0.1, 0.7],
    ticks: &[
        (0.1, "0.1°"),
        (0.2, "0.2°"),
        (0.3, "0.3°"),
        (0.4, "0.4°"),
        (0.5, "0.5°"),
        (0.6, "0.6°"),
        (0.7, "0.7°"),
    ],
    above: Some((RED, "more")),
};

/// Of what shows the single cells.
pub const POINT_SCALE: Scale = Scale {
    title: "Error, on the same scale for all codecs",
    gradient: colorous::VIRIDIS,
    range: [0.0, 0.8],
    ticks: &[(0.0, "0°"), (0.2, "0.2°"), (0.4, "0.4°"), (0.6, "0.6°"), (0.8, "0.8°")],
    above: Some((RED, "more")),
};

/// The standard deviation in pixels of what is around a point, on a disc of this size: about one
/// degree, as far as the directions of 16 bits are apart.
pub fn neighbourhood(size: usize) -> f64 {
    (size as f64 / 100.0).max(0.5)
}

/// Samples along the side of a pixel.
const SAMPLES: usize = 3;

/// The views that show all that a format represents.
pub fn views(format: Format) -> &'static [(View, &'static str)] {
    const VIEWS: [(View, &str); 2] = [
        (View::FROM_PLUS_Z, "from +Z: x right, y up"),
        (View::FROM_MINUS_Z, "from -Z: x left, y up"),
    ];
    if format.is_hemisphere() { &VIEWS[..1] } else { &VIEWS }
}

/// The error maps of both encoders of a format.
pub struct Maps {
    format: Format,
    rows: [(Encoder, Vec<Raster<1>>); 2],
}

pub fn measure(format: Format, size: usize) -> Maps {
    let rows = Encoder::both(format).map(|encoder| {
        let map = |(view, _): &(View, _)| {
            let direction = |at| view.equal_area(at).filter(|_| in_disc(at));
            let errors = |v: &_| encoder.errors(v).into_iter().map(|e| [e]).collect();
            Raster::sample(size, SAMPLES, direction, errors)
        };
        (encoder, views(format).iter().map(map).collect())
    });
    Maps { format, rows }
}

fn mean_and_max(maps: &[Raster<1>]) -> (f64, f64) {
    // The discs have equal areas.
    let mean = maps.iter().map(|map| map.mean()[0]).sum::<f64>() / maps.len() as f64;
    (mean, maps.iter().map(|map| map.greatest[0]).fold(0.0, f64::max))
}

impl Maps {
    pub fn page(&self) -> Canvas {
        let size = self.rows[0].1[0].size;
        let tiles = self.rows.each_ref().map(|(encoder, maps)| {
            let (mean, max) = mean_and_max(maps);
            let (name, stated) = (encoder.name(), encoder.stated_max());
            let text =
                format!("{name}: mean {mean:.3}°, greatest {max:.3}°, stated {stated}° at most");
            let discs = maps.len() * (size + GAP);
            let mut canvas = Canvas::new(discs.max(text_width(BOLD, &text)), 2 * LINE + size);
            canvas.text(0, 0, BOLD, &text);
            for (i, (map, (_, view))) in maps.iter().zip(views(self.format)).enumerate() {
                let x = i * (size + GAP);
                canvas.text(x, LINE, BODY, view);
                map.paint(&mut canvas, x, 2 * LINE, |[e]| POINT_SCALE.colour(e));
            }
            canvas
        });
        let notes = [
            "Angle between a vector and what is decoded from its code. Equal areas of the discs are",
            "equal areas of the sphere.",
        ];
        sheet(&format!("{}: error", self.format), &notes, Some(&POINT_SCALE), 1, &tiles)
    }

    /// For the overview, a third as large.
    pub fn tile(&self) -> Canvas {
        let size = self.rows[0].1[0].size / 3;
        let texts = self.rows.each_ref().map(|(encoder, maps)| {
            let (mean, max) = mean_and_max(maps);
            let name = encoder.name();
            format!("{name}: {mean:.3}° / {max:.3}°")
        });
        let width = texts.iter().map(|text| text_width(BODY, text)).max().unwrap_or(0);
        let mut canvas = Canvas::new((2 * size + GAP / 2).max(width), 24 + 2 * (LINE + size + 8));
        canvas.text(0, 0, TITLE, self.format.name());
        for (row, ((_, maps), text)) in self.rows.iter().zip(texts).enumerate() {
            let y = 24 + row * (LINE + size + 8);
            canvas.text(0, y, BODY, &text);
            for (i, map) in maps.iter().enumerate() {
                let x = i * (size + GAP / 2);
                let map = map.smaller(3).smooth(neighbourhood(size));
                map.paint(&mut canvas, x, y + LINE, |[e]| SCALE.colour(e));
            }
        }
        canvas
    }
}

pub fn overview(tiles: &[Canvas]) -> Canvas {
    let notes = [
        "Angle between a vector and what is decoded from its code: mean / greatest.",
        "Left from +Z (x right), right from -Z (x left), y up; one disc: z >= 0 only. Equal areas.",
    ];
    sheet("Error of the 16-bit codecs", &notes, Some(&SCALE), squarish(tiles), tiles)
}
