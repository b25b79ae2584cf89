//! A picture to draw on, text on it, and legends.

use std::convert::Infallible;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use colorous::Gradient;
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle, iso_8859_1};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::text::{Baseline, Text};

pub type Rgb = [u8; 3];

pub const WHITE: Rgb = [255; 3];
pub const GREY: Rgb = [150; 3];
/// No colour of the gradients, nor of the mirrored scene.
pub const RED: Rgb = [215, 25, 60];
pub const INK: Rgb = [25; 3];

/// The fonts: the Latin-1 ones have the degree sign.
pub const TITLE: &MonoFont = &iso_8859_1::FONT_10X20;
pub const BOLD: &MonoFont = &iso_8859_1::FONT_8X13_BOLD;
pub const BODY: &MonoFont = &iso_8859_1::FONT_8X13;

/// Between what stands on a page, and around it.
pub const GAP: usize = 16;
/// From one line of `BODY` to the next.
pub const LINE: usize = 18;

pub fn text_width(font: &MonoFont, text: &str) -> usize {
    text.chars().count() * font.character_size.width as usize
}

#[derive(Clone)]
pub struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<Rgb>,
}

impl Canvas {
    pub fn new(width: usize, height: usize) -> Canvas {
        Canvas { width, height, pixels: vec![WHITE; width * height] }
    }

    pub fn width(&self) -> usize {
        self.width
    }

    pub fn pixel(&self, x: usize, y: usize) -> Rgb {
        self.pixels[y * self.width + x]
    }

    /// Draws nothing outside of the canvas.
    pub fn set(&mut self, x: usize, y: usize, colour: Rgb) {
        self.blend(x, y, colour, 1.0);
    }

    /// Covers this share of a pixel.
    pub fn blend(&mut self, x: usize, y: usize, colour: Rgb, share: f64) {
        if x < self.width && y < self.height {
            let pixel = &mut self.pixels[y * self.width + x];
            for (channel, to) in pixel.iter_mut().zip(colour) {
                let (a, b) = (f64::from(*channel), f64::from(to));
                *channel = (a + (b - a) * share).round() as u8;
            }
        }
    }

    pub fn fill(&mut self, x: usize, y: usize, width: usize, height: usize, colour: Rgb) {
        for y in y..y + height {
            for x in x..x + width {
                self.set(x, y, colour);
            }
        }
    }

    /// A line one pixel wide around so many pixels.
    pub fn frame(&mut self, x: usize, y: usize, width: usize, height: usize, colour: Rgb) {
        self.fill(x, y, width, 1, colour);
        self.fill(x, y + height - 1, width, 1, colour);
        self.fill(x, y, 1, height, colour);
        self.fill(x + width - 1, y, 1, height, colour);
    }

    /// A disc about (x, y), where pixel (0, 0) goes from 0 to 1.
    pub fn disc(&mut self, x: f64, y: f64, radius: f64, colour: Rgb) {
        self.ring(x, y, radius / 2.0, radius, colour);
    }

    /// A circle this wide, as seen through square pixels.
    pub fn ring(&mut self, x: f64, y: f64, radius: f64, width: f64, colour: Rgb) {
        let reach = radius + width;
        let pixels = |at: f64| ((at - reach).max(0.0) as usize)..=((at + reach).max(0.0) as usize);
        for row in pixels(y) {
            for column in pixels(x) {
                let distance = (column as f64 + 0.5 - x).hypot(row as f64 + 0.5 - y);
                let share = width / 2.0 + 0.5 - (distance - radius).abs();
                self.blend(column, row, colour, share.clamp(0.0, 1.0));
            }
        }
    }

    pub fn paste(&mut self, x: usize, y: usize, picture: &Canvas) {
        for row in 0..picture.height {
            for column in 0..picture.width {
                self.set(x + column, y + row, picture.pixel(column, row));
            }
        }
    }

    /// With squares for pixels.
    pub fn enlarged(&self, factor: usize) -> Canvas {
        let mut canvas = Canvas::new(self.width * factor, self.height * factor);
        for y in 0..canvas.height {
            for x in 0..canvas.width {
                canvas.set(x, y, self.pixel(x / factor, y / factor));
            }
        }
        canvas
    }

    pub fn part(&self, x: usize, y: usize, width: usize, height: usize) -> Canvas {
        let mut canvas = Canvas::new(width, height);
        for row in 0..height {
            for column in 0..width {
                canvas.set(column, row, self.pixel(x + column, y + row));
            }
        }
        canvas
    }

    /// Text with its upper left corner at (x, y).
    pub fn text(&mut self, x: usize, y: usize, font: &MonoFont, text: &str) {
        let at = Point::new(x as i32, y as i32);
        let style = MonoTextStyle::new(font, Rgb888::new(INK[0], INK[1], INK[2]));
        let Ok(_) = Text::with_baseline(text, at, style, Baseline::Top).draw(self);
    }

    pub fn save(&self, path: &Path) -> io::Result<()> {
        let mut file = BufWriter::new(File::create(path)?);
        let mut encoder = png::Encoder::new(&mut file, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        writer.finish()?;
        file.flush()
    }
}

impl OriginDimensions for Canvas {
    fn size(&self) -> Size {
        Size::new(self.width as u32, self.height as u32)
    }
}

impl DrawTarget for Canvas {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        for Pixel(at, colour) in pixels {
            if let (Ok(x), Ok(y)) = (at.x.try_into(), at.y.try_into()) {
                self.set(x, y, [colour.r(), colour.g(), colour.b()]);
            }
        }
        Ok(())
    }
}

/// What colour a value has.
pub struct Scale {
    pub title: &'static str,
    pub gradient: Gradient,
    /// The values at the ends of the gradient.
    pub range: [f64; 2],
    /// The values that the legend names.
    pub ticks: &'static [(f64, &'static str)],
    /// The colour of what lies above the range, and what the legend calls it; else the end's.
    pub above: Option<(Rgb, &'static str)>,
}

impl Scale {
    /// The gradient and the texts under it, without a margin.
    pub const HEIGHT: usize = LINE + 18 + 22;
    const BAR: usize = 400;

    pub fn colour(&self, value: f64) -> Rgb {
        let [low, high] = self.range;
        match self.above {
            Some((colour, _)) if value > high => colour,
            _ => {
                let colour = self.gradient.eval_continuous((value - low) / (high - low));
                [colour.r, colour.g, colour.b]
            }
        }
    }

    pub fn width(&self) -> usize {
        let above = self.above.map_or(0, |(_, text)| GAP + 26 + text_width(BODY, text));
        (Self::BAR + above + 3 * GAP).max(text_width(BODY, self.title))
    }

    pub fn legend(&self, canvas: &mut Canvas, x: usize, y: usize) {
        let [low, high] = self.range;
        canvas.text(x, y, BODY, self.title);
        let y = y + LINE;
        for i in 0..Self::BAR {
            let value = low + (high - low) * (i as f64 + 0.5) / Self::BAR as f64;
            canvas.fill(x + i, y, 1, 18, self.colour(value));
        }
        for &(value, text) in self.ticks {
            let share = (value - low) / (high - low);
            let at = x + (share * (Self::BAR - 1) as f64).round() as usize;
            canvas.fill(at, y + 14, 1, 8, INK);
            canvas.text(at.saturating_sub(text_width(BODY, text) / 2).max(x), y + 23, BODY, text);
        }
        if let Some((colour, text)) = self.above {
            let x = x + Self::BAR + GAP;
            canvas.fill(x, y, 18, 18, colour);
            canvas.text(x + 26, y + 3, BODY, text);
        }
    }
}

/// How many columns make such tiles about as wide as high.
pub fn squarish(tiles: &[Canvas]) -> usize {
    let (width, height) = greatest(tiles);
    (1..tiles.len())
        .find(|columns| {
            columns * (width + 2 * GAP) >= tiles.len().div_ceil(*columns) * (height + 2 * GAP)
        })
        .unwrap_or(tiles.len().max(1))
}

fn greatest(tiles: &[Canvas]) -> (usize, usize) {
    let width = tiles.iter().map(|tile| tile.width).max();
    let height = tiles.iter().map(|tile| tile.height).max();
    (width.unwrap_or(0), height.unwrap_or(0))
}

/// Tiles in rows, below a title and a legend.
pub fn sheet(
    title: &str,
    notes: &[&str],
    legend: Option<&Scale>,
    columns: usize,
    tiles: &[Canvas],
) -> Canvas {
    let (width, _) = greatest(tiles);
    let rows: Vec<_> = tiles.chunks(columns).map(|row| (row, greatest(row).1)).collect();

    let text = notes.iter().map(|note| text_width(BODY, note)).max().unwrap_or(0);
    let text = text.max(text_width(TITLE, title)).max(legend.map_or(0, Scale::width));
    let below = if legend.is_some() { Scale::HEIGHT + 2 * GAP } else { GAP };
    let top = GAP + 28 + notes.len() * LINE + below;
    let mut canvas = Canvas::new(
        (columns * (width + 2 * GAP)).max(text + 2 * GAP),
        top + rows.iter().map(|(_, height)| height + 2 * GAP).sum::<usize>() - GAP,
    );
    canvas.text(GAP, GAP, TITLE, title);
    for (line, note) in notes.iter().enumerate() {
        canvas.text(GAP, GAP + 28 + line * LINE, BODY, note);
    }
    if let Some(scale) = legend {
        scale.legend(&mut canvas, GAP, GAP + 36 + notes.len() * LINE);
    }
    let mut y = top;
    for (row, height) in rows {
        for (column, tile) in row.iter().enumerate() {
            canvas.paste(GAP + column * (width + 2 * GAP), y, tile);
        }
        y += height + 2 * GAP;
    }
    canvas
}
