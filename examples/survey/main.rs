//! Measures error and speed of every codec on real vectors: `cargo run --release --example survey
//! -- --help`

mod load;
mod measure;
mod published;
mod report;
mod vectors;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use indicatif::{ProgressBar, ProgressStyle};
use unitpack::Format;

use measure::{Row, encoders_agree, measure};
use report::{CSV_HEADER, Report, legend, thousands};
use vectors::{TORUS_KNOT, Vectors};

const HELP: &str = "\
Measures error and speed of every codec of unitpack.

Usage: survey [OPTIONS] [FILE]...

Without a file: uniform random vectors, and the vertex normals of a torus knot.
A file gives its normals: .obj, .glb, .gltf, or little-endian f32 triples as .bin, .raw or .f32.

Options:
      --format NAME  only this codec, such as oct16 (may be repeated)
      --vectors N    how many uniform random vectors [default: 1000000]
      --seed N       which uniform random vectors [default: 1]
      --csv          comma-separated values instead of the table
  -h, --help         this text

Exit status: 0, 1 if a file could not be read, 2 for a mistake on the command line.
";

const MOST_VECTORS: usize = 100_000_000;

struct Options {
    files: Vec<PathBuf>,
    formats: Vec<Format>,
    vectors: usize,
    seed: u64,
    csv: bool,
}

impl Options {
    /// `None` if help is asked for.
    fn parse() -> Result<Option<Options>, lexopt::Error> {
        use lexopt::prelude::*;
        let (mut files, mut formats) = (Vec::new(), Vec::new());
        let (mut vectors, mut seed, mut csv) = (None, None, false);
        let mut parser = lexopt::Parser::from_env();
        while let Some(arg) = parser.next()? {
            match arg {
                Long("format") => formats.push(parser.value()?.parse_with(format)?),
                Long("vectors") => vectors = Some(parser.value()?.parse_with(vector_count)?),
                Long("seed") => seed = Some(parser.value()?.parse()?),
                Long("csv") => csv = true,
                Short('h') | Long("help") => return Ok(None),
                Value(file) => files.push(file.into()),
                _ => return Err(arg.unexpected()),
            }
        }
        if !files.is_empty() && (vectors.is_some() || seed.is_some()) {
            return Err(
                "--vectors and --seed are of the random vectors: not together with files".into()
            );
        }
        if formats.is_empty() {
            formats = Format::ALL.to_vec();
        }
        let (vectors, seed) = (vectors.unwrap_or(1_000_000), seed.unwrap_or(1));
        Ok(Some(Options { files, formats, vectors, seed, csv }))
    }
}

fn format(name: &str) -> Result<Format, String> {
    Format::from_name(name).ok_or_else(|| {
        let names: Vec<_> = Format::ALL.iter().map(|f| f.name()).collect();
        format!("no such codec; there are {}", names.join(", "))
    })
}

fn vector_count(count: &str) -> Result<usize, String> {
    let count = count.parse().map_err(|e| format!("{e}"))?;
    if (1..=MOST_VECTORS).contains(&count) {
        Ok(count)
    } else {
        Err(format!("not from 1 to {}", thousands(MOST_VECTORS)))
    }
}

fn main() -> ExitCode {
    let result = match Options::parse() {
        Ok(Some(options)) => match inputs(&options) {
            Ok(inputs) => run(&options, &inputs),
            Err(error) => {
                eprintln!("error: {error}");
                return ExitCode::FAILURE;
            }
        },
        Ok(None) => io::stdout().write_all(HELP.as_bytes()),
        Err(error) => {
            eprintln!("error: {error}\nTry --help.");
            return ExitCode::from(2);
        }
    };
    match result {
        // A closed pipe: whoever reads has seen enough.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            eprintln!("error: cannot write the result: {error}");
            ExitCode::FAILURE
        }
        _ => ExitCode::SUCCESS,
    }
}

/// A set of vectors to measure on.
struct Input {
    name: String,
    /// The name in a sentence.
    title: String,
    vectors: Vectors,
    /// How many normals had no direction.
    left_out: usize,
    /// Whether these are vectors like the survey's, so that its figures can be expected.
    uniform: bool,
}

fn inputs(options: &Options) -> Result<Vec<Input>, String> {
    if options.files.is_empty() {
        let (count, seed) = (options.vectors, options.seed);
        let (rings, sides) = TORUS_KNOT;
        return Ok(vec![
            Input {
                name: "uniform".into(),
                title: format!("{} uniform random vectors, seed {seed}", thousands(count)),
                vectors: vectors::uniform(count, seed),
                left_out: 0,
                uniform: true,
            },
            Input {
                name: "torus knot".into(),
                title: format!("Torus knot: {rings} x {sides} vertex normals"),
                vectors: vectors::torus_knot(),
                left_out: 0,
                uniform: false,
            },
        ]);
    }
    let load = |path: &PathBuf| {
        let (vectors, left_out) =
            load::load(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let name = path.display().to_string();
        let title = format!("{name}: {} normals", thousands(vectors.len()));
        Ok(Input { name, title, vectors, left_out, uniform: false })
    };
    options.files.iter().map(load).collect()
}

fn run(options: &Options, inputs: &[Input]) -> io::Result<()> {
    let mut out = io::stdout().lock();
    if cfg!(debug_assertions) {
        eprintln!("built without optimisation, the times say little: use cargo run --release");
    }
    if options.csv {
        writeln!(out, "{CSV_HEADER}")?;
    }
    // Draws nothing where standard error is no terminal.
    let bar = ProgressBar::new((inputs.len() * options.formats.len()) as u64);
    bar.set_style(ProgressStyle::with_template("[{bar:40}] {pos}/{len} {msg}").expect("valid"));
    let mut tally = None;
    for input in inputs {
        let report = Report {
            input: &input.name,
            title: &input.title,
            vectors: input.vectors.len(),
            left_out: input.left_out,
            rows: measure_all(&options.formats, input, &bar),
        };
        if input.uniform {
            tally = report.tally();
        }
        bar.suspend(|| {
            if !options.csv {
                return report.write_table(&mut out);
            }
            if let Some(note) = report.left_out() {
                eprintln!("{}: {note}", report.input);
            }
            report.write_csv(&mut out)
        })?;
    }
    bar.finish_and_clear();
    if !options.csv {
        writeln!(out, "{}", legend())?;
        if let Some(tally) = tally {
            writeln!(out, "\n{tally}")?;
        }
    }
    out.flush()
}

fn measure_all(formats: &[Format], input: &Input, bar: &ProgressBar) -> Vec<Row> {
    let sphere = &input.vectors;
    let hemisphere = &sphere.hemisphere();
    // A mesh may be too small to tell two encoders apart.
    let sample = vectors::uniform(1 << 16, 0);
    let mut rows = Vec::new();
    for &format in formats {
        bar.set_message(format.name());
        let on_hemisphere = format.is_hemisphere();
        let vectors = if on_hemisphere { hemisphere } else { sphere };
        rows.push(measure(format, false, on_hemisphere, vectors));
        if !(encoders_agree(format, vectors.soa()) && encoders_agree(format, sample.soa())) {
            rows.push(measure(format, true, on_hemisphere, vectors));
        }
        // The survey's Table 3 has some codecs of the sphere too, to compare those of the
        // hemisphere with.
        for precise in [false, true] {
            if input.uniform && !on_hemisphere && published::find(format, precise, true).is_some() {
                rows.push(measure(format, precise, true, hemisphere));
            }
        }
        bar.inc(1);
    }
    rows
}
