//! The README's table of codecs: a row per family, with its figures at the usual sizes.

use unitpack::Format;

/// What is around the table.
const START: &str = "<!-- Written by `cargo run --release -p survey -- --readme README.md` -->";
const END: &str = "<!-- The end of what it writes -->";

/// A column has each family's largest member of these bits or fewer that the column before it is
/// too small for.
pub const COLUMNS: [u32; 4] = [16, 24, 32, 48];

/// Where in `text` the table is.
fn place(text: &str) -> Result<std::ops::Range<usize>, String> {
    let start = text.find(START).ok_or_else(|| format!("there is no line {START}"))? + START.len();
    let end = text[start..].find(END).ok_or_else(|| format!("after that there is no {END}"))?;
    Ok(start..start + end)
}

/// The table in `text`.
///
/// # Errors
/// If its marks are missing.
pub fn extract(text: &str) -> Result<&str, String> {
    Ok(text[place(text)?].trim())
}

/// `text` with another table.
///
/// # Errors
/// If the marks of the table are missing.
pub fn replace(text: &str, table: &str) -> Result<String, String> {
    let place = place(text)?;
    Ok(format!("{}\n\n{}\n\n{}", &text[..place.start], table.trim(), &text[place.end..]))
}

/// A family's row.
pub struct Row {
    /// The first two cells: which types there are, and of how many bits.
    pub head: String,
    /// Which format a cell is about.
    pub cells: [Option<Format>; COLUMNS.len()],
}

/// What the table is about.
pub fn rows() -> Vec<Row> {
    families().iter().map(|family| Row { head: head(family), cells: cells(family) }).collect()
}

/// The table, with the mean error that `mean` gives of a format's fast or precise encoder.
pub fn table(mean: impl Fn(Format, bool) -> f64) -> String {
    let headings = COLUMNS.map(|bits| format!(" {bits} bits |")).concat();
    let mut table =
        format!("| codecs | bits |{headings}\n|---|---|{}", "--:|".repeat(COLUMNS.len()));
    for row in rows() {
        table += &format!("\n{}", row.head);
        for (format, bits) in row.cells.iter().zip(COLUMNS) {
            let text = format.map(|f| size(f, bits) + &figures(f, &mean)).unwrap_or_default();
            table += &format!(" {text} |");
        }
    }
    table
}

fn head(family: &[Format]) -> String {
    let names: Vec<_> = family.iter().map(|f| format!("`{f:?}`")).collect();
    let names = match &names[..] {
        [first, _, .., last] => format!("{first} to {last}"),
        names => names.join(", "),
    };
    let domain = if family[0].is_hemisphere() { " (z >= 0)" } else { "" };
    format!("| {names}{domain} | {} |", sizes(family))
}

fn cells(family: &[Format]) -> [Option<Format>; COLUMNS.len()] {
    let mut least = 0;
    COLUMNS.map(|most| {
        let range = least..=most;
        least = most + 1;
        let fitting = family.iter().filter(|f| range.contains(&f.bits()));
        fitting.max_by_key(|f| f.bits()).copied()
    })
}

/// The text before the figures of a format, in the column of these bits.
pub fn size(format: Format, column: u32) -> String {
    if format.bits() == column { String::new() } else { format!("{} bits: ", format.bits()) }
}

/// Mean and greatest error of `encode`, and of `encode_precise` if that makes a difference.
fn figures(format: Format, mean: impl Fn(Format, bool) -> f64) -> String {
    let line = |precise, max| format!("{} / {max}", three_digits(mean(format, precise)));
    let mut lines = vec![
        line(false, format.max_error_degrees()),
        line(true, format.max_error_precise_degrees()),
    ];
    lines.dedup();
    lines.join("<br>")
}

/// Formats whose names differ in their sizes alone, in the order of the table of codecs.
fn families() -> Vec<Vec<Format>> {
    let key = |format: &Format| {
        let name = format.name();
        let is_digit = |c: char| c.is_ascii_digit();
        // What follows the last digit tells latlong16D from latlong16.
        (name.split(is_digit).next(), name.rsplit(is_digit).next())
    };
    let mut families: Vec<Vec<Format>> = Vec::new();
    for &format in Format::ALL {
        match families.iter_mut().find(|family| key(&family[0]) == key(&format)) {
            Some(family) => family.push(format),
            None => families.push(vec![format]),
        }
    }
    families
}

/// "4 to 32", "8 to 32, even", or one by one.
fn sizes(family: &[Format]) -> String {
    let mut bits: Vec<_> = family.iter().map(|f| f.bits()).collect();
    bits.dedup();
    let in_steps_of =
        |step| bits.len() > 4 && bits.windows(2).all(|pair| pair[1] - pair[0] == step);
    let range = || format!("{} to {}", bits[0], bits[bits.len() - 1]);
    match () {
        () if in_steps_of(1) => range(),
        () if in_steps_of(2) => range() + ", even",
        () => bits.iter().map(u32::to_string).collect::<Vec<_>>().join(", "),
    }
}

/// More would not be certain after a million vectors.
fn three_digits(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let decimals = (2 - x.abs().log10().floor() as i32).max(0) as usize;
    format!("{x:.decimals$}")
}
