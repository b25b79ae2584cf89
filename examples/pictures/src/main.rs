//! Draws what the 16-bit codecs do to the sphere, as PNG files: `cargo run --release -p pictures -- --help`

mod canvas;
mod error;
mod geometry;
mod mirror;
mod points;
mod raster;
mod round_trip;
mod rounding;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use unitpack::Format;

use canvas::Canvas;
const HELP: &str = "\
Draws what the 16-bit codecs of unitpack do to the sphere, as PNG files.

Usage: pictures [OPTIONS] [FOLDER]

FOLDER is made if need be [default: target/pictures]. Files of the same names are overwritten.

Options:
      --format NAME  only this codec, such as oct16 (may be repeated)
      --size N       diameter of the discs on the overviews, in pixels, 64 to 400; on a codec's own
                     pages they are three times as large [default: 160]
  -h, --help         this text

Exit status: 0, 1 if a file could not be written, 2 for a mistake on the command line.
";

/// A code of so many bits is what the pictures compare.
const BITS: u32 = 16;

struct Options {
    folder: PathBuf,
    formats: Vec<Format>,
    size: usize,
}

impl Options {
    /// `None` if help is asked for.
    fn parse() -> Result<Option<Options>, lexopt::Error> {
        use lexopt::prelude::*;
        let (mut folder, mut formats, mut size) = (None, Vec::new(), 160);
        let mut parser = lexopt::Parser::from_env();
        while let Some(arg) = parser.next()? {
            match arg {
                Long("format") => {
                    let format = parser.value()?.parse_with(format)?;
                    if !formats.contains(&format) {
                        formats.push(format);
                    }
                }
                Long("size") => size = parser.value()?.parse_with(disc_size)?,
                Short('h') | Long("help") => return Ok(None),
                Value(path) if folder.is_none() => folder = Some(path.into()),
                _ => return Err(arg.unexpected()),
            }
        }
        if formats.is_empty() {
            formats = all().collect();
        }
        let folder = folder.unwrap_or_else(|| "target/pictures".into());
        Ok(Some(Options { folder, formats, size }))
    }
}

fn all() -> impl Iterator<Item = Format> {
    Format::ALL.iter().copied().filter(|f| f.bits() == BITS)
}

fn format(name: &str) -> Result<Format, String> {
    Format::from_name(name).filter(|f| f.bits() == BITS).ok_or_else(|| {
        let names: Vec<_> = all().map(|f| f.name()).collect();
        format!("no such codec of {BITS} bits; there are {}", names.join(", "))
    })
}

fn disc_size(size: &str) -> Result<usize, String> {
    let size = size.parse().map_err(|e| format!("{e}"))?;
    if (64..=400).contains(&size) { Ok(size) } else { Err("not from 64 to 400".into()) }
}

fn main() -> ExitCode {
    let result = match Options::parse() {
        Ok(Some(options)) => draw(&options),
        Ok(None) => io::stdout().write_all(HELP.as_bytes()).map_err(Failure::Output),
        Err(error) => {
            eprintln!("error: {error}\nTry --help.");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads has seen enough.
        Err(Failure::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(Failure::Output(error)) => {
            eprintln!("error: cannot write to standard output: {error}");
            ExitCode::FAILURE
        }
        Err(Failure::File(path, error)) => {
            eprintln!("error: cannot write {}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}

enum Failure {
    Output(io::Error),
    File(PathBuf, io::Error),
}

/// Writes the pictures, and says what each one is.
struct Album<'a> {
    folder: &'a Path,
}

impl Album<'_> {
    fn add(&self, name: &str, what: &str, picture: &Canvas) -> Result<(), Failure> {
        let path = self.folder.join(name);
        picture.save(&path).map_err(|error| Failure::File(path, error))?;
        writeln!(io::stdout(), "  {name:<36} {what}").map_err(Failure::Output)
    }
}

fn draw(options: &Options) -> Result<(), Failure> {
    let Options { folder, formats, size } = options;
    fs::create_dir_all(folder).map_err(|error| Failure::File(folder.clone(), error))?;
    if cfg!(debug_assertions) {
        eprintln!("built without optimisation, this takes long: use cargo run --release");
    }
    writeln!(io::stdout(), "Pictures in {}:", folder.display()).map_err(Failure::Output)?;
    let album = Album { folder };

    let exact = mirror::Sphere::exact(3 * size);
    let (mut errors, mut densities, mut mirrors) = (Vec::new(), Vec::new(), Vec::new());
    for &format in formats {
        let name = format.name();
        let maps = error::measure(format, 3 * size);
        let what = format!("error of {name} over the sphere");
        album.add(&format!("error-{name}.png"), &what, &maps.page())?;
        errors.push(maps.tile());

        let points = points::Points::of(format);
        let what = format!("directions that {name} represents, with close-ups");
        album.add(&format!("points-{name}.png"), &what, &points.page(3 * size))?;
        densities.push(points.tile(*size));

        let (page, tile) = mirror::page_and_tile(format, &exact);
        let what = format!("mirror sphere with normals through {name}, and the difference");
        album.add(&format!("mirror-{name}.png"), &what, &page)?;
        mirrors.push(tile);
    }
    if formats.contains(&Format::Oct16) {
        let what = "which rounding of the two parameters of oct16 is nearest";
        album.add("rounding-oct16.png", what, &rounding::page(*size))?;
    }
    album.add("overview-error.png", "error of every codec", &error::overview(&errors))?;
    let what = "how densely every codec's directions lie";
    album.add("overview-points.png", what, &points::overview(&densities))?;
    let what = "mirror sphere through every codec";
    album.add("overview-mirror.png", what, &mirror::overview(&exact, mirrors))
}
