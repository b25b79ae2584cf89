//! Measures error and speed of every codec on real vectors, and compares with what was published:
//! `cargo run --release -p survey -- --help`

mod load;
mod measure;
mod report;
mod vectors;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use unitpack::Format;
use unitpack_test::{Arrays, published, readme};

use measure::{Row, encoders_agree, measure};
use report::{CSV_HEADER, Report, legend, thousands};
use vectors::TORUS_KNOT;

const HELP: &str = "\
Measures error and speed of every codec of unitpack, and compares the errors with those
that Cigolle et al. published: Tables 1 and 3 of A Survey of Efficient Representations for Independent
Unit Vectors (2014).

Usage: survey [OPTIONS] [FILE]...

Without a file: uniform random vectors, and the vertex normals of a torus knot.
A file gives its normals: .obj, .glb, .gltf, or little-endian f32 triples as .bin, .raw or .f32.

Options:
      --format NAME  only this codec, such as oct16 (may be repeated)
      --vectors N    how many uniform random vectors [default: 1000000]
      --seed N       which uniform random vectors [default: 1]
      --csv          comma-separated values instead of the tables
      --readme FILE  also write the table of codecs between its marks in FILE
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
    readme: Option<PathBuf>,
}

impl Options {
    /// `None` if help is asked for.
    fn parse() -> Result<Option<Options>, lexopt::Error> {
        use lexopt::prelude::*;
        let (mut files, mut formats) = (Vec::new(), Vec::new());
        let (mut vectors, mut seed, mut csv, mut readme) = (None, None, false, None);
        let mut parser = lexopt::Parser::from_env();
        while let Some(arg) = parser.next()? {
            match arg {
                Long("format") => formats.push(parser.value()?.parse_with(format)?),
                Long("vectors") => vectors = Some(parser.value()?.parse_with(vector_count)?),
                Long("seed") => seed = Some(parser.value()?.parse()?),
                Long("csv") => csv = true,
                Long("readme") => readme = Some(parser.value()?.into()),
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
        if readme.is_some() && !(files.is_empty() && formats.is_empty()) {
            return Err("--readme is of all codecs on random vectors: not together with files or \
                 --format"
                .into());
        }
        if formats.is_empty() {
            formats = Format::ALL.to_vec();
        }
        let (vectors, seed) = (vectors.unwrap_or(1_000_000), seed.unwrap_or(1));
        Ok(Some(Options { files, formats, vectors, seed, csv, readme }))
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
    vectors: Arrays,
    /// How many normals had no direction.
    left_out: usize,
    /// Whether these are vectors like the survey's, so that its figures can be expected.
    uniform: bool,
}

fn inputs(options: &Options) -> Result<Vec<Input>, String> {
    // Before minutes of measuring.
    options.readme.as_deref().map(read_readme).transpose()?;
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
        let title = format!("{name}: {} normals", thousands(vectors.count()));
        Ok(Input { name, title, vectors, left_out, uniform: false })
    };
    options.files.iter().map(load).collect()
}

/// A README that has a table of codecs.
fn read_readme(path: &Path) -> Result<String, String> {
    let read = || {
        let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
        readme::extract(&text)?;
        Ok(text)
    };
    read().map_err(|error: String| format!("{}: {error}", path.display()))
}

fn run(options: &Options, inputs: &[Input]) -> io::Result<()> {
    let start = Instant::now();
    let mut out = io::stdout().lock();
    if cfg!(debug_assertions) {
        eprintln!("built without optimisation, the times say little: use cargo run --release");
    }
    if options.csv {
        writeln!(out, "{CSV_HEADER}")?;
    }
    // Draws nothing where standard error is no terminal.
    let bar = ProgressBar::new((inputs.len() * options.formats.len()) as u64);
    let style = "[{bar:40}] {pos}/{len}, {elapsed} of about {duration}: {msg}";
    bar.set_style(ProgressStyle::with_template(style).expect("valid"));
    let mut uniform = None;
    for input in inputs {
        let report = Report {
            input: &input.name,
            title: &input.title,
            vectors: input.vectors.count(),
            left_out: input.left_out,
            rows: measure_all(&options.formats, input, &bar),
        };
        bar.suspend(|| {
            if !options.csv {
                return report.write_table(&mut out);
            }
            if let Some(note) = report.left_out() {
                eprintln!("{}: {note}", report.input);
            }
            report.write_csv(&mut out)
        })?;
        if input.uniform {
            uniform = Some(report);
        }
    }
    bar.finish_and_clear();
    if let (Some(path), Some(report)) = (&options.readme, &uniform) {
        let table = readme::table(|format, precise| report.mean(format, precise));
        let text = read_readme(path).and_then(|text| readme::replace(&text, &table));
        fs::write(path, text.map_err(io::Error::other)?)
            .map_err(|e| io::Error::new(e.kind(), format!("{}: {e}", path.display())))?;
    }
    if !options.csv {
        writeln!(out, "{}\n", legend())?;
        let comparison = uniform.as_ref().map(|report| report.compare());
        if let Some(comparison) = &comparison {
            comparison.write_tables(&mut out)?;
        }
        writeln!(out, "Measured in {:.1} s.", start.elapsed().as_secs_f64())?;
        if let Some(tally) = comparison.and_then(|comparison| comparison.tally()) {
            writeln!(out, "{tally}")?;
        }
    }
    out.flush()
}

fn measure_all(formats: &[Format], input: &Input, bar: &ProgressBar) -> Vec<Row> {
    let sphere = &input.vectors;
    let hemisphere = &vectors::hemisphere(sphere);
    // A mesh may be too small to tell two encoders apart.
    let sample = vectors::uniform(1 << 16, 0);
    let mut rows = Vec::new();
    for &format in formats {
        bar.set_message(format.name());
        let own = format.is_hemisphere();
        for precise in [false, true] {
            let published =
                |domain| input.uniform && published::find(format, precise, domain).is_some();
            if !precise || published(own) || !encoders_agree(format, sample.read()) {
                let vectors = if own { hemisphere } else { sphere };
                rows.push(measure(format, precise, own, vectors));
            }
            // The survey's Table 3 has some codecs of the sphere too, to compare those of the
            // hemisphere with.
            if !own && published(true) {
                rows.push(measure(format, precise, true, hemisphere));
            }
        }
        bar.inc(1);
    }
    rows
}
