//! Bars: how long each contender takes.

use std::path::Path;

use svg::Document;
use svg::node::element::{Rectangle, Text};

use crate::timing::Times;

const LINE: f64 = 20.0;
const WIDTH: f64 = 760.0;
/// Where bars begin, and how long the longest is.
const LEFT: f64 = 270.0;
const LONGEST: f64 = 400.0;

/// Writes an SVG of some contests. The bars of each have a scale of their own.
pub fn draw(path: &Path, contests: &[Times]) -> std::io::Result<()> {
    let mut document = Document::new();
    let mut y = LINE;
    for Times { title, place, rows } in contests {
        document = document.add(
            text(10.0, y, &format!("{title}, {place}: ns a vector")).set("font-weight", "bold"),
        );
        let most = rows.iter().map(|row| row.1).fold(0.0, f64::max);
        for (name, ns) in rows {
            y += LINE;
            let ours = name.starts_with("unitpack");
            let length = LONGEST * ns / most;
            let bar = Rectangle::new()
                .set("x", LEFT)
                .set("y", y - 12.0)
                .set("width", format!("{length:.1}"))
                .set("height", 14)
                .set("fill", if ours { "#2b6cb0" } else { "#a0aec0" });
            document = document.add(text(10.0, y, name)).add(bar).add(text(
                LEFT + length + 6.0,
                y,
                &format!("{ns:.2}"),
            ));
        }
        y += 2.0 * LINE;
    }
    let background = Rectangle::new().set("width", WIDTH).set("height", y).set("fill", "white");
    let sized = Document::new().set("viewBox", (0, 0, WIDTH, y)).add(background).add(document);
    svg::save(path, &sized)
}

fn text(x: f64, y: f64, content: &str) -> Text {
    Text::new(content)
        .set("x", format!("{x:.1}"))
        .set("y", y)
        .set("font-family", "sans-serif")
        .set("font-size", 13)
}
