//! `proof nearest`: whether `encode_precise` gives the nearest of all codes, in f64.
//!
//! Formats of at most 32 bits are compared with every code, those of 48 bits with every length.
//!
//! The promise is about decoded vectors, so by those a format passes. Stated beside is the excess by
//! the exact directions that codes stand for: it has the decoder's rounding in it, twice. Where not
//! all codes are decoded, that must be small enough as well.

mod all_codes;
mod lengths;

use std::error::Error;
use std::fmt::Write as _;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressStyle};
use lexopt::prelude::*;
use unitpack::Format;

use unitpack_test::codes::{decode, encode, encode_precise};
use unitpack_test::oracle::{Oracle, oracle};
use unitpack_test::random::Rng;
use unitpack_test::vectors::{chord_squared, widen};

use all_codes::{Best, Entry, Reaches};
use lengths::Lengths;

/// By how much, in radians, rounding may mislead an encoder: comparing two distances rounds the
/// target twice and each decoded vector once, each by about 2^-24.
const SLACK: f64 = 2.5e-7;
/// What f64 cannot tell from zero.
const NONE: f64 = 1e-12;
/// Directions made at once, from a seed of their own.
const BLOCK: u64 = 4096;

struct Options {
    directions: u64,
    seed: u64,
    threads: usize,
    fast: bool,
    windows: bool,
    output: Option<PathBuf>,
    formats: Vec<Format>,
}

impl Options {
    fn parse(mut arguments: lexopt::Parser) -> Result<Self, Box<dyn Error>> {
        let mut this = Options {
            directions: 10_000_000,
            seed: 1,
            threads: std::thread::available_parallelism()?.get(),
            fast: false,
            windows: false,
            output: None,
            formats: Vec::new(),
        };
        while let Some(argument) = arguments.next()? {
            match argument {
                Long("directions") => this.directions = arguments.value()?.parse()?,
                Long("seed") => this.seed = arguments.value()?.parse()?,
                Long("threads") => this.threads = arguments.value()?.parse()?,
                Long("fast") => this.fast = true,
                Long("windows") => this.windows = true,
                Long("output") => this.output = Some(arguments.value()?.into()),
                Value(name) => this.formats.push(name.parse()?),
                _ => return Err(argument.unexpected().into()),
            }
        }
        if this.formats.contains(&Format::Float32x3) {
            return Err("float32x3 keeps what it is given".into());
        }
        Ok(this)
    }
}

/// Gives whether every format passed.
pub fn run(arguments: lexopt::Parser) -> Result<bool, Box<dyn Error>> {
    let options = Options::parse(arguments)?;
    let rows = Rows::read(options.output.as_deref())?;
    let open = |&format: &Format| format != Format::Float32x3 && !rows.has(format, &options);
    let all = || Format::ALL.iter().copied().filter(open).collect();
    let formats = if options.formats.is_empty() { all() } else { options.formats.clone() };
    let mut failed = 0;
    for format in formats {
        let found = examine(format, &options);
        println!("{format}: {found}");
        failed += usize::from(!found.passes());
        if let Some(path) = options.output.as_deref().filter(|_| found.passes()) {
            // Another run may have written meanwhile.
            let mut rows = Rows::read(Some(path))?;
            rows.put(format, found.row(format, &options));
            std::fs::write(path, rows.text())?;
        }
    }
    if failed > 0 {
        eprintln!("{failed} failed");
    }
    Ok(failed == 0)
}

/// Where directions come from: cells of equal area, and places that are hard.
struct Directions<'a> {
    format: Format,
    oracle: &'a Oracle,
    seed: u64,
    /// Cells along each side of the map.
    side: u64,
    count: u64,
}

impl<'a> Directions<'a> {
    /// At least as many as the options say, and a tenth of that aimed.
    fn new(format: Format, oracle: &'a Oracle, options: &Options) -> Self {
        let side = options.directions.isqrt();
        let side = if side * side < options.directions { side + 1 } else { side };
        let count = side * side + options.directions / 10;
        Directions { format, oracle, seed: options.seed, side, count }
    }

    fn stratified(&self) -> u64 {
        self.side * self.side
    }

    fn block(&self, numbers: Range<u64>) -> Vec<[f32; 3]> {
        let mut rng = Rng::new(Rng::new(self.seed ^ numbers.start).bits());
        numbers.map(|number| self.direction(number, &mut rng)).collect()
    }

    fn direction(&self, number: u64, rng: &mut Rng) -> [f32; 3] {
        let (row, column) = (number / self.side, number % self.side);
        if row < self.side {
            // Lambert's cylinder: z and azimuth.
            let [z, turn] = [row, column].map(|i| (i as f64 + rng.unit()) / self.side as f64);
            let z = if self.format.is_hemisphere() { z } else { 2.0 * z - 1.0 };
            let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
            let r = (1.0 - z * z).sqrt();
            return [r * cos, r * sin, z].map(|c| c as f32);
        }
        match number % 3 {
            0 => rng.edge(),
            // Half way between a code and another that often stands beside it.
            1 => {
                let bits = self.format.bits();
                let code = u128::from(rng.bits()) & ((1 << bits) - 1);
                let beside = code ^ 1 << rng.pick(&[0, 1, 3, bits / 2, bits / 2 + 1, bits / 3]);
                let [a, b] = [code, beside].map(|code| self.oracle.decode(code));
                std::array::from_fn(|i| (a[i] + b[i]) as f32)
            }
            // Beside an axis, or half way between two or three: poles, folds, the corners of a
            // square or a cube.
            _ => {
                let mut v: [f32; 3] =
                    rng.pick(&[[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0]]);
                v.rotate_right(rng.below(3) as usize);
                v.map(|c| {
                    let off = 10f64.powf(-8.0 * rng.unit()) as f32;
                    (c + rng.pick(&[off, -off])) * rng.pick(&[1.0, -1.0])
                })
            }
        }
    }
}

/// What is known of a direction before the search.
struct Direction {
    input: [f32; 3],
    stratified: bool,
    /// To the code that was chosen.
    chosen: Chords,
    /// To the nearest code, where that is found at once.
    best: Option<f64>,
}

/// The squares of the chords from a direction to what a code stands for, and to what the crate
/// decodes it to.
struct Chords {
    exact: f64,
    decoded: f64,
}

fn examine(format: Format, options: &Options) -> Found {
    let oracle = oracle(format.name());
    let directions = Directions::new(format, &oracle, options);
    let lengths = Lengths::of(format);
    let windows = options.windows && format.bits() > 24;
    let codes: u64 = if lengths.is_some() || windows { 0 } else { 1 << format.bits() };
    // Directions looked at in one pass over the codes: as many as keep within 2 GB, or fewer where
    // the codes are few.
    let pass = if format.bits() > 24 { 1 << 24 } else { 1 << 20 };
    let passes = directions.count.div_ceil(pass);
    // Codes that a thread takes at once.
    let piece = (codes / 64).clamp(1024, 1 << 22);
    let bar = progress(format, directions.count.div_ceil(BLOCK) + passes * codes.div_ceil(piece));
    let mut found = Found::new(match (&lengths, windows) {
        (Some(_), _) => "all lengths".into(),
        (_, true) => "windows".into(),
        _ => format!("all {codes} codes"),
    });
    for pass in pieces(0..directions.count, pass) {
        let blocks: Vec<_> = pieces(pass, BLOCK).collect();
        let blocks = parallel(options.threads, blocks.len(), |i| {
            let inputs = directions.block(blocks[i].clone());
            let encode = if options.fast { encode } else { encode_precise };
            let codes = encode(format, &inputs);
            bar.inc(1);
            let decoded = decode(format, &codes);
            let known = inputs.iter().zip(codes).zip(decoded).zip(blocks[i].clone());
            let known = known.map(|(((&input, code), decoded), number)| {
                let stratified = number < directions.stratified();
                let target = oracle.target(input);
                let [exact, decoded] = [oracle.decode(code), widen(decoded)];
                let [exact, decoded] = [exact, decoded].map(|v| chord_squared(v, target));
                let best = match &lengths {
                    Some(lengths) => Some(lengths.nearest(&oracle, target, exact)),
                    None if windows => {
                        Some((2.0 * (oracle.nearest_angle(target) / 2.0).sin()).powi(2))
                    }
                    None => None,
                };
                let chosen = Chords { exact, decoded };
                Direction { input, stratified, chosen, best }
            });
            known.collect::<Vec<_>>()
        });
        let known: Vec<_> = blocks.into_iter().flatten().collect();
        if codes > 0 {
            let entry = |(i, d): (usize, &Direction)| {
                Entry::new(i, oracle.target(d.input), d.chosen.exact.sqrt())
            };
            let entries: Vec<_> = known.iter().enumerate().map(entry).collect();
            let reaches = Reaches::new(&entries);
            let best: Vec<_> = known.iter().map(|_| Best::default()).collect();
            let pieces: Vec<_> = pieces(0..codes, piece).collect();
            parallel(options.threads, pieces.len(), |i| {
                let target = |number: u32| oracle.target(known[number as usize].input);
                reaches.search(format, &oracle, pieces[i].clone(), target, &best);
                bar.inc(1);
            });
            for (direction, best) in known.iter().zip(&best) {
                found.add(direction, best.exact(), Some(best.decoded()));
            }
        } else {
            for direction in &known {
                found.add(direction, direction.best.unwrap(), None);
            }
        }
    }
    bar.finish_and_clear();
    found
}

/// What the directions of one format showed.
struct Found {
    searched: String,
    directions: u64,
    /// Of the chosen codes, in radians: the sum over the stratified directions, and the greatest.
    error_sum: f64,
    stratified: u64,
    error_max: f64,
    /// How many have a nearer code at all, by more than 1e-7, and by more than the slack.
    nearer: [u64; 3],
    /// By how much the nearest of what codes stand for is nearer, and the nearest of what they
    /// decode to, if that was looked for; and for which directions.
    exact: Excess,
    decoded: Option<Excess>,
}

#[derive(Default)]
struct Excess {
    most: f64,
    at: [f32; 3],
}

impl Excess {
    fn add(&mut self, excess: f64, input: [f32; 3]) {
        if excess > self.most {
            *self = Excess { most: excess, at: input };
        }
    }
}

impl Found {
    fn new(searched: String) -> Self {
        Found {
            searched,
            directions: 0,
            error_sum: 0.0,
            stratified: 0,
            error_max: 0.0,
            nearer: [0; 3],
            exact: Excess::default(),
            decoded: None,
        }
    }

    fn add(
        &mut self,
        &Direction { input, stratified, ref chosen, .. }: &Direction,
        exact: f64,
        decoded: Option<f64>,
    ) {
        let angle = |chord_squared: f64| 2.0 * (chord_squared.sqrt() / 2.0).asin();
        let error = angle(chosen.exact);
        let excess = error - angle(exact);
        // The search must see the chosen code itself.
        assert!(excess > -NONE, "{input:?}: {:e} {exact:e}", chosen.exact);
        self.directions += 1;
        if stratified {
            self.stratified += 1;
            self.error_sum += error;
        }
        self.error_max = error.max(self.error_max);
        for (count, least) in self.nearer.iter_mut().zip([NONE, 1e-7, SLACK]) {
            *count += u64::from(excess > least);
        }
        self.exact.add(excess, input);
        if let Some(decoded) = decoded {
            let excess = angle(chosen.decoded) - angle(decoded);
            self.decoded.get_or_insert_default().add(excess, input);
        }
    }

    /// By how much some code's decoded vector is nearer than the chosen one's.
    fn excess(&self) -> &Excess {
        self.decoded.as_ref().unwrap_or(&self.exact)
    }

    fn passes(&self) -> bool {
        self.excess().most <= SLACK
    }

    fn row(&self, format: Format, options: &Options) -> String {
        let [mean, max] = self.errors();
        let [nearer, small, beyond] = self.nearer;
        let decoded = self.decoded.as_ref().map_or("-".into(), |d| format!("{:.2e}", d.most));
        let [x, y, z] = self.excess().at;
        format!(
            "{format},{},{},{},{mean:.4e},{max:.4e},{nearer},{small},{beyond},{:.2e},{decoded},{x:e} {y:e} {z:e}",
            options.seed, self.directions, self.searched, self.exact.most
        )
    }

    /// Mean and greatest, in degrees.
    fn errors(&self) -> [f64; 2] {
        [self.error_sum / self.stratified as f64, self.error_max].map(f64::to_degrees)
    }
}

impl std::fmt::Display for Found {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [mean, max] = self.errors();
        let [nearer, small, beyond] = self.nearer;
        write!(
            f,
            "{} directions, {}: error {mean:.3e} to {max:.3e} degrees; {nearer} have a nearer code, \
             {small} by 1e-7 rad, {beyond} by {SLACK:e}; at most {:.2e}",
            self.directions, self.searched, self.exact.most,
        )?;
        if let Some(decoded) = &self.decoded {
            write!(f, ", {:.2e} as decoded", decoded.most)?;
        }
        write!(f, " at {:?}{}", self.excess().at, if self.passes() { "" } else { " FAILED" })
    }
}

/// The figures kept in a file: one row for each format that passed, in the order of the table.
struct Rows(Vec<(Format, String)>);

const HEADER: &str = "\
    format,seed,directions,against,mean error in degrees,greatest error in degrees,\
    directions with a nearer code,nearer by 1e-7 rad,nearer by 2.5e-7 rad,\
    greatest excess in rad,greatest excess as decoded,at";

impl Rows {
    /// None, if there is no file.
    fn read(path: Option<&Path>) -> Result<Self, Box<dyn Error>> {
        let text = match path {
            Some(path) if path.exists() => std::fs::read_to_string(path)?,
            _ => String::new(),
        };
        let row = |line: &str| {
            let (name, _) = line.split_once(',').ok_or("a row without columns")?;
            Ok((name.parse()?, line.into()))
        };
        text.lines().skip(1).map(row).collect::<Result<_, _>>().map(Rows)
    }

    /// Whether there is a row from as many directions.
    fn has(&self, format: Format, options: &Options) -> bool {
        let row = self.0.iter().find(|row| row.0 == format);
        row.and_then(|row| row.1.split(',').nth(2))
            .and_then(|directions| directions.parse().ok())
            .is_some_and(|directions: u64| directions >= options.directions)
    }

    fn put(&mut self, format: Format, row: String) {
        self.0.retain(|row| row.0 != format);
        self.0.push((format, row));
        self.0.sort_by_key(|row| Format::ALL.iter().position(|&format| format == row.0));
    }

    fn text(&self) -> String {
        let mut text = format!("{HEADER}\n");
        for (_, row) in &self.0 {
            writeln!(text, "{row}").unwrap();
        }
        text
    }
}

fn progress(format: Format, steps: u64) -> ProgressBar {
    let style = "{prefix:20} {wide_bar} {percent:>3} % {elapsed} left {eta}";
    ProgressBar::new(steps)
        .with_style(ProgressStyle::with_template(style).unwrap())
        .with_prefix(format.name())
}

/// A range in pieces of at most `size`.
fn pieces(range: Range<u64>, size: u64) -> impl Iterator<Item = Range<u64>> {
    range.clone().step_by(size as usize).map(move |first| first..(first + size).min(range.end))
}

/// Does `work` for every number below `count`, and gives the results in order.
fn parallel<T: Send>(threads: usize, count: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let take = || {
        let number = next.fetch_add(1, Ordering::Relaxed);
        (number < count).then(|| (number, work(number)))
    };
    let mut done: Vec<_> = std::thread::scope(|scope| {
        let worker = || std::iter::from_fn(take).collect::<Vec<_>>();
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().flat_map(|worker| worker.join().unwrap()).collect()
    });
    done.sort_by_key(|(number, _)| *number);
    done.into_iter().map(|(_, result)| result).collect()
}
