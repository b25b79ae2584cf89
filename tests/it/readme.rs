//! The README's table of codecs says what this build does.

use unitpack::Format;
use unitpack_test::Effort;
use unitpack_test::readme as table;

use unitpack_test::codes::{decode, encode_with};
use unitpack_test::random::Rng;
use unitpack_test::tasks::check_all;
use unitpack_test::vectors::{angle, widen};

const README: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/README.md");

fn mean(format: Format, precise: bool) -> f64 {
    let mut rng = Rng::new(8);
    let upper = |[x, y, z]: [f32; 3]| [x, y, if format.is_hemisphere() { z.abs() } else { z }];
    let vectors: Vec<_> = (0..4096).map(|_| upper(rng.direction())).collect();
    let effort = if precise { Effort::Precise } else { Effort::Fast };
    let codes = encode_with(format, effort, &vectors);
    let decoded = decode(format, &codes);
    let errors = vectors.iter().zip(decoded).map(|(v, w)| angle(widen(*v), widen(w)).to_degrees());
    errors.sum::<f64>() / vectors.len() as f64
}

/// A cell as the example writes it: a line for `encode`, one for `encode_precise` if it differs,
/// each a mean and the greatest error that the format states.
fn check_cell(text: &str, format: Format, column: u32) -> Result<(), String> {
    let wrong = |what: &str| format!("{format}: {what} in {text:?}");
    let lines = text.strip_prefix(&table::size(format, column)).ok_or_else(|| wrong("size"))?;
    let lines: Vec<_> = lines.split("<br>").collect();
    let (fast, precise) = match lines[..] {
        [both] => (both, both),
        [fast, precise] => (fast, precise),
        _ => return Err(wrong("lines")),
    };
    for (line, is_precise, stated) in [
        (fast, false, format.max_error_degrees()),
        (precise, true, format.max_error_precise_degrees()),
    ] {
        let (written, max) = line.split_once(" / ").ok_or_else(|| wrong("no slash"))?;
        if max != stated.to_string() {
            return Err(wrong(&format!("maximum, stated is {stated},")));
        }
        // Of few vectors, but enough to tell the mean of another codec.
        let (written, measured) = (written.parse::<f64>(), mean(format, is_precise));
        if !written.is_ok_and(|w| (w - measured).abs() <= 0.1 * w) {
            return Err(wrong(&format!("mean, measured is {measured:.3e},")));
        }
    }
    Ok(())
}

#[test]
fn the_table_agrees_with_the_codecs() {
    let readme = std::fs::read_to_string(README).unwrap();
    let (lines, rows) = (table::extract(&readme).unwrap().lines(), table::rows());
    assert!(lines.clone().take(2).eq(table::table(|_, _| 0.0).lines().take(2)), "the head");
    assert_eq!(lines.clone().count(), 2 + rows.len(), "lines");
    let rows: Vec<_> = lines.skip(2).zip(rows).collect();
    check_all(&rows, |(line, row)| {
        let rest = line.strip_prefix(&row.head).ok_or(format!("{line:?} is not {:?}", row.head))?;
        let texts: Vec<_> = rest.split('|').map(str::trim).collect();
        let [texts @ .., ""] = &texts[..] else { return Err(format!("no end: {line:?}")) };
        if texts.len() != row.cells.len() {
            return Err(format!("{} cells: {line:?}", texts.len()));
        }
        for ((text, format), column) in texts.iter().zip(row.cells).zip(table::COLUMNS) {
            match format {
                Some(format) => check_cell(text, format, column)?,
                None if text.is_empty() => {}
                None => return Err(format!("{text:?} stands in an empty cell: {line:?}")),
            }
        }
        Ok(())
    });
}
