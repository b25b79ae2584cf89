//! The tables for people, and the one for machines.

use std::io::{self, Write};

use unitpack::Format;

use crate::measure::{MOST_PASSES, Row};
use unitpack_test::published::{self, Published, RULES, TABLE_1, TABLE_3, Verdict};

/// One set of vectors, measured.
pub struct Report<'a> {
    pub input: &'a str,
    pub title: &'a str,
    /// How many vectors were measured.
    pub vectors: usize,
    /// How many normals had no direction.
    pub left_out: usize,
    pub rows: Vec<Row>,
}

/// What stands above the columns of a table, and how wide they are.
struct Columns<const N: usize> {
    columns: [(&'static str, usize); N],
    /// Above the headings: from which column to which, inclusive.
    groups: &'static [(usize, usize, &'static str)],
}

const MEASURED: Columns<12> = Columns {
    columns: [
        ("codec", 23),
        ("bits", 4),
        ("bytes", 5),
        ("degrees  ", 11),
        ("/best", 5),
        ("degrees  ", 11),
        ("degrees  ", 11),
        ("/best", 5),
        ("ns", 6),
        ("GB/s", 5),
        ("ns", 5),
        ("GB/s", 5),
    ],
    groups: &[
        (3, 4, "mean error"),
        (5, 5, "rms error"),
        (6, 7, "greatest error"),
        (8, 9, "encode"),
        (10, 11, "decode"),
    ],
};

const COMPARED: Columns<10> = Columns {
    columns: [
        ("row", 20),
        ("bits", 4),
        ("here    ", 11),
        ("survey", 7),
        ("ratio", 5),
        ("here    ", 11),
        ("survey", 7),
        ("ratio", 5),
        ("vectors", 9),
        ("", 10),
    ],
    groups: &[(2, 4, "mean error, degrees"), (5, 7, "greatest error, degrees")],
};

impl<const N: usize> Columns<N> {
    fn rule(&self) -> String {
        "-".repeat(self.end(N - 1))
    }

    /// Where a column ends.
    fn end(&self, column: usize) -> usize {
        self.columns[..=column].iter().map(|(_, width)| width + 1).sum::<usize>() - 1
    }

    fn head(&self) -> String {
        let mut groups = String::new();
        for &(first, last, text) in self.groups {
            let start = self.end(first - 1) + 1;
            groups = format!("{groups:start$}{text:^0$}", self.end(last) - start);
        }
        let headings = self.line(self.columns.map(|(heading, _)| heading.into()));
        format!("{0}\n{1}\n{headings}\n{0}", self.rule(), groups.trim_end())
    }

    fn line(&self, cells: [String; N]) -> String {
        let mut line = String::new();
        for (i, (cell, (_, width))) in cells.iter().zip(self.columns).enumerate() {
            line += &if i == 0 { format!("{cell:width$}") } else { format!(" {cell:>width$}") };
        }
        line.trim_end().into()
    }
}

impl Report<'_> {
    pub fn write_table(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}", self.title)?;
        if let Some(note) = self.left_out() {
            writeln!(out, "{note}")?;
        }
        writeln!(out, "{}", MEASURED.head())?;
        for row in &self.rows {
            let (mean_over_best, max_over_best) = row.over_best();
            let (encode_rate, decode_rate) = row.throughput();
            let line = MEASURED.line([
                self.label(row),
                row.format.bits().to_string(),
                row.format.code_size().to_string(),
                degrees(row.mean),
                significant(mean_over_best, 3),
                degrees(row.rms),
                degrees(row.max),
                significant(max_over_best, 3),
                significant(row.encode_ns, 3),
                rate(encode_rate),
                significant(row.decode_ns, 3),
                rate(decode_rate),
            ]);
            writeln!(out, "{line}")?;
        }
        writeln!(out, "{}", MEASURED.rule())?;
        let slow: Vec<_> = self
            .rows
            .iter()
            .filter(|row| row.vectors < self.vectors)
            .map(|row| format!("{} {}", row.name(), thousands(row.vectors)))
            .collect();
        if !slow.is_empty() {
            writeln!(out, "* slow, so on fewer vectors, evenly spaced: {}", slow.join(", "))?;
        }
        writeln!(out)
    }

    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let input = format!("\"{}\"", self.input.replace('"', "\"\""));
        for row in &self.rows {
            let published = published::find(row.format, row.precise, row.hemisphere);
            let published = |figure: fn(&Published) -> f64| {
                published.map_or(String::new(), |row| figure(row).to_string())
            };
            let (mean_over_best, max_over_best) = row.over_best();
            let (encode_rate, decode_rate) = row.throughput();
            writeln!(
                out,
                "{input},{},{},{},{},{},{},{},{},{},{},{},{},{mean_over_best},{max_over_best},{},{},\
                 {encode_rate},{decode_rate}",
                self.left_out,
                row.format,
                if row.precise { "precise" } else { "fast" },
                if row.hemisphere { "hemisphere" } else { "sphere" },
                row.format.bits(),
                row.format.code_size(),
                row.vectors,
                row.mean,
                row.rms,
                row.max,
                published(|row| row.mean),
                published(|row| row.max),
                row.encode_ns,
                row.decode_ns,
            )?;
        }
        Ok(())
    }

    pub fn left_out(&self) -> Option<String> {
        let all = thousands(self.vectors + self.left_out);
        (self.left_out > 0).then(|| {
            let some = thousands(self.left_out);
            format!("{some} of {all} normals are zero, NaN or infinite and were left out")
        })
    }

    /// The mean error of an encoder of `format`. Where the precise one has no row, it gives the same
    /// codes as the fast one. NaN if neither has one.
    pub fn mean(&self, format: Format, precise: bool) -> f64 {
        let domain = format.is_hemisphere();
        let row = |precise| self.row(format, precise, domain);
        row(precise).or_else(|| row(false)).map_or(f64::NAN, |row| row.mean)
    }

    fn row(&self, format: Format, precise: bool, hemisphere: bool) -> Option<&Row> {
        let key = (format, precise, hemisphere);
        self.rows.iter().find(|row| (row.format, row.precise, row.hemisphere) == key)
    }

    /// The published rows of the measured formats.
    pub fn compare(&self) -> Comparison<'_> {
        let pairs = |table: &'static [Published], hemisphere| -> Vec<Pair<'_>> {
            let pair = |published: &'static Published| {
                let format = Format::from_name(published.format)?;
                Some((published, self.row(format, published.precise, hemisphere)?))
            };
            table.iter().filter_map(pair).collect()
        };
        Comparison { table_1: pairs(&TABLE_1, false), table_3: pairs(&TABLE_3, true) }
    }

    fn label(&self, row: &Row) -> String {
        let domain = if row.hemisphere { " +Z" } else { "" };
        let slow = if row.vectors < self.vectors { " *" } else { "" };
        format!("{}{domain}{slow}", row.name())
    }
}

type Pair<'a> = (&'static Published, &'a Row);

/// The survey's tables beside ours.
pub struct Comparison<'a> {
    table_1: Vec<Pair<'a>>,
    table_3: Vec<Pair<'a>>,
}

impl Comparison<'_> {
    pub fn write_tables(&self, out: &mut dyn Write) -> io::Result<()> {
        for (title, pairs, all) in [
            ("Table 1, the sphere", &self.table_1, TABLE_1.len()),
            ("Table 3, the hemisphere z >= 0", &self.table_3, TABLE_3.len()),
        ] {
            if pairs.is_empty() {
                continue;
            }
            writeln!(out, "The survey's {title}: {} of {all} rows", pairs.len())?;
            writeln!(out, "{}", COMPARED.head())?;
            for (published, row) in pairs {
                let line = COMPARED.line([
                    published.name.into(),
                    published.bits.to_string(),
                    degrees(row.mean),
                    format!("{:.5}", published.mean),
                    format!("{:.3}", row.mean / published.mean),
                    degrees(row.max),
                    format!("{:.5}", published.max),
                    format!("{:.3}", row.max / published.max),
                    thousands(row.vectors),
                    format!("{:?}", published.verdict(row.mean, row.max)).to_lowercase(),
                ]);
                writeln!(out, "{line}")?;
            }
            writeln!(out, "{}\n", COMPARED.rule())?;
        }
        let mut rows = self.table_1.iter().chain(&self.table_3).peekable();
        if rows.peek().is_some() {
            writeln!(out, "{RULES}")?;
        }
        if rows.any(|(_, row)| row.vectors < 1_000_000) {
            writeln!(
                out,
                "The published figures are of a million vectors; fewer miss or beat some by chance."
            )?;
        }
        Ok(())
    }

    /// How many rows are reproduced, in one line; nothing if none was measured.
    pub fn tally(&self) -> Option<String> {
        let pairs: Vec<_> = self.table_1.iter().chain(&self.table_3).collect();
        let having = |verdict| {
            let has_it =
                |(published, row): &&&Pair<'_>| published.verdict(row.mean, row.max) == verdict;
            pairs.iter().filter(has_it).map(|(published, _)| published.name).collect::<Vec<_>>()
        };
        let counted = |rows: &[&str]| match rows {
            [] => "none".to_string(),
            rows => format!("{} ({})", rows.len(), rows.join(", ")),
        };
        (!pairs.is_empty()).then(|| {
            format!(
                "Of {} published rows {} are reproduced, better are {}, worse are {}.",
                pairs.len(),
                having(Verdict::Reproduced).len(),
                counted(&having(Verdict::Better)),
                counted(&having(Verdict::Worse)),
            )
        })
    }
}

pub const CSV_HEADER: &str = "input,left_out,codec,encoder,domain,bits,bytes,vectors,mean_deg,\
    rms_deg,max_deg,survey_mean_deg,survey_max_deg,mean_over_best,max_over_best,encode_ns,\
    decode_ns,encode_gb_s,decode_gb_s";

/// How to read the table.
pub fn legend() -> String {
    format!(
        "/best   over what no code of as many bits can better on uniform vectors: 76.61 degrees / sqrt(2^bits) in the \
         mean,\n        126.01 / sqrt(2^bits) at most, and those over sqrt(2) on a hemisphere\n\
         P       encode_precise; without such a row, encode gives the same codes\n\
         +Z      on the hemisphere, every vector with z = |z|\n\
         ns      a vector, on one thread, f32 x, y, z in three arrays: the best of 2 to {MOST_PASSES} passes over all \
         vectors,\n        encoding and decoding in turn\n\
         GB/s    bytes read and written"
    )
}

/// Four digits, padded so that the decimal points of a column stand below each other.
fn degrees(x: f64) -> String {
    let text = significant(x, 4);
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let point = if fraction.is_empty() { ' ' } else { '.' };
    format!("{whole:>2}{point}{fraction:<8}")
}

/// So many digits, and all those of the integral part.
fn significant(x: f64, digits: i32) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let decimals = (digits - 1 - x.abs().log10().floor() as i32).clamp(0, 8) as usize;
    format!("{x:.decimals$}")
}

/// Three digits, but no more than two decimals.
fn rate(x: f64) -> String {
    if x < 1.0 { format!("{x:.2}") } else { significant(x, 3) }
}

/// With commas.
pub fn thousands(n: usize) -> String {
    let digits = n.to_string();
    let groups: Vec<_> = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy).collect();
    groups.join(",")
}
