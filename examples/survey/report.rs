//! The table for people, and the one for machines.

use std::io::{self, Write};

use crate::measure::{MOST_PASSES, Row};
use crate::published::{Published, Verdict};

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

const WIDTHS: [usize; 14] = [20, 4, 5, 11, 7, 5, 11, 11, 7, 5, 6, 5, 5, 5];
const HEADINGS: [&str; 14] = [
    "codec",
    "bits",
    "bytes",
    "here    ",
    "survey",
    "/best",
    "degrees  ",
    "here    ",
    "survey",
    "/best",
    "ns",
    "GB/s",
    "ns",
    "GB/s",
];
/// What stands above the headings: from which column to which, inclusive.
const GROUPS: [(usize, usize, &str); 5] = [
    (3, 5, "mean error, degrees"),
    (6, 6, "rms error"),
    (7, 9, "greatest error, degrees"),
    (10, 11, "encode"),
    (12, 13, "decode"),
];

impl Report<'_> {
    pub fn write_table(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}", self.title)?;
        if let Some(note) = self.left_out() {
            writeln!(out, "{note}")?;
        }
        let width = WIDTHS.iter().sum::<usize>() + WIDTHS.len() - 1;
        let rule = "-".repeat(width);
        writeln!(out, "{rule}")?;
        let mut groups = String::new();
        for (first, last, text) in GROUPS {
            let start = WIDTHS[..first].iter().map(|w| w + 1).sum::<usize>();
            let end = WIDTHS[..=last].iter().map(|w| w + 1).sum::<usize>() - 1;
            groups = format!("{groups:start$}{text:^0$}", end - start);
        }
        writeln!(out, "{}", groups.trim_end())?;
        write_line(out, HEADINGS.map(String::from))?;
        writeln!(out, "{rule}")?;
        for row in &self.rows {
            let published = |figure: fn(&Published) -> f64| {
                row.published().map_or(String::new(), |row| format!("{:.5}", figure(row)))
            };
            let (mean_over_best, max_over_best) = row.over_best();
            let (encode_rate, decode_rate) = row.throughput();
            write_line(
                out,
                [
                    self.label(row),
                    row.format.bits().to_string(),
                    row.format.code_size().to_string(),
                    degrees(row.mean),
                    published(|row| row.mean),
                    significant(mean_over_best, 3),
                    degrees(row.rms),
                    degrees(row.max),
                    published(|row| row.max),
                    significant(max_over_best, 3),
                    significant(row.encode_ns, 3),
                    rate(encode_rate),
                    significant(row.decode_ns, 3),
                    rate(decode_rate),
                ],
            )?;
        }
        writeln!(out, "{rule}")?;
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
            let published = |figure: fn(&Published) -> f64| {
                row.published().map_or(String::new(), |row| figure(row).to_string())
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

    /// How the rows compare with the published ones, if there are any.
    pub fn tally(&self) -> Option<String> {
        let labels = |wanted| -> Vec<String> {
            let verdict = |row: &Row| Some(row.published()?.verdict(row.mean, row.max));
            let rows = self.rows.iter().filter(|row| verdict(row) == Some(wanted));
            rows.map(|row| self.label(row)).collect()
        };
        let counted = |rows: &[String]| match rows {
            [] => "0".to_string(),
            rows => format!("{} ({})", rows.len(), rows.join(", ")),
        };
        let [reproduced, better, worse] =
            [Verdict::Reproduced, Verdict::Better, Verdict::Worse].map(labels);
        let covered = reproduced.len() + better.len() + worse.len();
        let mut text = format!(
            "Of these rows, {covered} stand in the survey's tables 1 and 3: {} are reproduced (the mean \
             within 0.5 %, the\nmaximum within 4 % or less), better are {}, worse are {}.",
            reproduced.len(),
            counted(&better),
            counted(&worse),
        );
        if self.vectors < 1_000_000 {
            text += "\nThe published figures are of a million vectors; fewer miss some by chance.";
        }
        (covered > 0).then_some(text)
    }

    fn label(&self, row: &Row) -> String {
        let domain = if row.hemisphere { " +Z" } else { "" };
        let slow = if row.vectors < self.vectors { " *" } else { "" };
        format!("{}{domain}{slow}", row.name())
    }
}

pub const CSV_HEADER: &str = "input,left_out,codec,encoder,domain,bits,bytes,vectors,mean_deg,\
    rms_deg,max_deg,survey_mean_deg,survey_max_deg,mean_over_best,max_over_best,encode_ns,\
    decode_ns,encode_gb_s,decode_gb_s";

/// How to read the table.
pub fn legend() -> String {
    format!(
        "survey  published by Cigolle et al. (2014), for uniform random vectors\n\
         /best   over what no code of as many bits can better on uniform vectors: 76.61 degrees / sqrt(2^bits) in the \
         mean,\n        126.01 / sqrt(2^bits) at most, and those over sqrt(2) on a hemisphere\n\
         P       encode_precise; without such a row, encode gives the same codes\n\
         +Z      on the hemisphere, every vector with z = |z|\n\
         ns      a vector, on one thread, f32 x, y, z in three arrays: the best of 2 to {MOST_PASSES} passes over all \
         vectors,\n        encoding and decoding in turn\n\
         GB/s    bytes read and written"
    )
}

fn write_line(out: &mut dyn Write, cells: [String; 14]) -> io::Result<()> {
    let mut line = String::new();
    for (i, (cell, width)) in cells.iter().zip(WIDTHS).enumerate() {
        line += &if i == 0 { format!("{cell:width$}") } else { format!(" {cell:>width$}") };
    }
    writeln!(out, "{}", line.trim_end())
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
