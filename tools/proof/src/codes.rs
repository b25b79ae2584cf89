//! `proof codes`: every code of every format of at most 32 bits.
//!
//! The codes of a format are cut into [`SLICES`] slices, each of every so many-th block. What a slice
//! showed is kept in a journal, so that an interrupted run goes on where it stopped; it counts as long as
//! the format's digest stays the same. A format whose slices are all done becomes a row of the published
//! table.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::fs::{self, OpenOptions};
use std::io::{self, Write as _};
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{ProgressBar, ProgressStyle};
use lexopt::prelude::*;
use unitpack::Format;

use unitpack_test::codes::{decode, encode, encode_precise};
use unitpack_test::every_code::{self, BLOCK, Findings, check_operations};
use unitpack_test::oracle::oracle;

/// How many slices the codes of a format are cut into.
const SLICES: u64 = 256;

/// Of so many codes, one is compared with the oracle's canonical code and with encoding alone, and in
/// formats of more than 24 bits negated and mirrored.
const EVERY: usize = 61;

struct Options {
    formats: Vec<Format>,
    /// Only this slice of each format, and no journal.
    slice: Option<u64>,
    threads: usize,
    journal: PathBuf,
    output: PathBuf,
}

impl Options {
    fn parse(mut arguments: lexopt::Parser) -> Result<Self, Box<dyn Error>> {
        let mut this = Options {
            formats: Vec::new(),
            slice: None,
            threads: std::thread::available_parallelism()?.get(),
            journal: "codes.journal".into(),
            output: "codes.csv".into(),
        };
        while let Some(argument) = arguments.next()? {
            match argument {
                Long("journal") => this.journal = arguments.value()?.into(),
                Long("output") => this.output = arguments.value()?.into(),
                Long("slice") => this.slice = Some(arguments.value()?.parse()?),
                Long("threads") => this.threads = arguments.value()?.parse()?,
                Value(name) => this.formats.push(name.parse()?),
                other => return Err(other.unexpected().into()),
            }
        }
        if let Some(wide) = this.formats.iter().find(|format| format.bits() > 32) {
            return Err(format!("{wide} has more than 32 bits").into());
        }
        if this.formats.is_empty() {
            this.formats = formats();
        }
        Ok(this)
    }
}

/// The formats that have so few codes; the slowest last.
fn formats() -> Vec<Format> {
    let mut all: Vec<_> = Format::ALL.iter().copied().filter(|f| f.bits() <= 32).collect();
    all.sort_by_key(|f| (f.name() == "snorm11-11-10", f.name() == "snorm10x3", *f));
    all
}

/// What a format makes of 2^18 codes all over its range: their vectors, and the codes that those become.
/// FNV-1a.
fn digest(format: Format) -> u64 {
    let mask = u128::MAX >> (128 - format.bits());
    let codes: Vec<u128> = (0..1 << 18).map(|i: u128| i.wrapping_mul(0x9E37_79B9) & mask).collect();
    let vectors = decode(format, &codes);
    let vector_bits = vectors.iter().flatten().map(|c| u64::from(c.to_bits()));
    let fast = encode(format, &vectors).into_iter().map(|code| code as u64);
    let precise = encode_precise(format, &vectors).into_iter().map(|code| code as u64);
    vector_bits
        .chain(fast)
        .chain(precise)
        .fold(0xcbf2_9ce4_8422_2325, |hash, word| (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3))
}

/// One slice of one format. Formats of fewer blocks than slices leave the last ones empty.
type Task = (Format, u64);

fn check(&(format, slice): &Task) -> Result<Findings, String> {
    let oracle = oracle(format.name());
    let codes = 1u64 << format.bits();
    let mut findings = Findings::default();
    for first in (0..codes).step_by(BLOCK as usize).skip(slice as usize).step_by(SLICES as usize) {
        let count = BLOCK.min(codes - first);
        findings.add(every_code::check(format, &oracle, first, count, EVERY)?);
        let every = if format.bits() <= 24 { 1 } else { EVERY };
        let some: Vec<u128> = (first..first + count).step_by(every).map(u128::from).collect();
        check_operations(format, &some)?;
    }
    Ok(findings)
}

/// Gives whether everything held.
pub fn run(arguments: lexopt::Parser) -> Result<bool, Box<dyn Error>> {
    let options = Options::parse(arguments)?;
    let digests: BTreeMap<Format, u64> = match options.slice {
        Some(_) => BTreeMap::new(),
        None => options.formats.iter().map(|&format| (format, digest(format))).collect(),
    };
    let mut done = match options.slice {
        Some(_) => BTreeMap::new(),
        None => read_journal(&options.journal, &digests),
    };
    let slices = options.slice.map_or(0..SLICES, |slice| slice % SLICES..slice % SLICES + 1);
    let tasks: Vec<Task> = options
        .formats
        .iter()
        .flat_map(|&format| slices.clone().map(move |slice| (format, slice)))
        .filter(|task| !done.contains_key(task))
        .collect();
    let mut journal = match options.slice {
        Some(_) => None,
        None => Some(OpenOptions::new().create(true).append(true).open(&options.journal)?),
    };

    let progress = ProgressBar::new(tasks.iter().map(|task| task.0.bits()).map(in_slice).sum());
    progress.set_style(ProgressStyle::with_template(STYLE).expect("a valid template"));
    let next = AtomicUsize::new(0);
    let results = Mutex::new((&mut done, &mut journal, Vec::new(), Ok(())));
    std::thread::scope(|scope| {
        for _ in 0..options.threads {
            scope.spawn(|| {
                while let Some(task) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
                    progress.set_message(task.0.name());
                    let result = check(task);
                    progress.inc(in_slice(task.0.bits()));
                    let (done, journal, failures, written) = &mut *results.lock().unwrap();
                    match result {
                        Ok(findings) => {
                            if let Some(journal) = journal {
                                let line = journal_line(task, digests[&task.0], &findings);
                                if let Err(error) = journal.write_all(line.as_bytes()) {
                                    *written = Err(error);
                                }
                            }
                            done.insert(*task, findings);
                        }
                        Err(failure) => {
                            progress.println(format!("FAILED {failure}"));
                            failures.push(failure);
                        }
                    }
                }
            });
        }
    });
    progress.finish_and_clear();
    let (_, _, failures, written) = results.into_inner().unwrap();
    written?;

    report(&options.formats, &done);
    if options.slice.is_none() {
        write_table(&options.output, &done)?;
    }
    for failure in &failures {
        eprintln!("FAILED {failure}");
    }
    Ok(failures.is_empty())
}

const STYLE: &str = "{bar:40} {percent}% of {human_len} codes, {eta} left, {msg}";

/// How many codes a slice has, but for the formats whose last slices are empty.
fn in_slice(bits: u32) -> u64 {
    (1u64 << bits).div_ceil(SLICES)
}

/// What the slices of each format showed together, and how many there are.
fn sums(done: &BTreeMap<Task, Findings>) -> BTreeMap<Format, (u64, Findings)> {
    let mut sums = BTreeMap::new();
    for (&(format, _), &findings) in done {
        let (slices, sum): &mut (u64, Findings) = sums.entry(format).or_default();
        *slices += 1;
        sum.add(findings);
    }
    sums
}

fn report(formats: &[Format], done: &BTreeMap<Task, Findings>) {
    for (format, (slices, sum)) in sums(done).into_iter().filter(|sum| formats.contains(&sum.0)) {
        println!(
            "{:20} {slices:3} of {SLICES} slices: {:10} codes, {:10} canonical, decoded to {:.2e} rad and {:.2e} in length",
            format.name(),
            sum.codes,
            sum.canonical,
            sum.angle,
            sum.length
        );
    }
}

fn journal_line(&(format, slice): &Task, digest: u64, findings: &Findings) -> String {
    let Findings { codes, canonical, angle, length } = findings;
    format!("{format} {digest:016x} {slice} {codes} {canonical} {angle:e} {length:e}\n")
}

/// What a journal says of formats with these digests; a line cut short counts for nothing.
fn read_journal(path: &PathBuf, digests: &BTreeMap<Format, u64>) -> BTreeMap<Task, Findings> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let entry = |line: &str| {
        let fields: Vec<&str> = line.split(' ').collect();
        let [format, digest, slice, codes, canonical, angle, length] = fields[..] else {
            return None;
        };
        let findings = Findings {
            codes: codes.parse().ok()?,
            canonical: canonical.parse().ok()?,
            angle: angle.parse().ok()?,
            length: length.parse().ok()?,
        };
        let format: Format = format.parse().ok()?;
        let is_same = digests.get(&format) == Some(&u64::from_str_radix(digest, 16).ok()?);
        is_same.then_some(((format, slice.parse().ok()?), findings))
    };
    let whole = text.split_inclusive('\n').filter_map(|line| line.strip_suffix('\n'));
    whole.filter_map(entry).collect()
}

/// Puts every format that is done into the table, in place of its old row.
fn write_table(path: &PathBuf, done: &BTreeMap<Task, Findings>) -> io::Result<()> {
    let old = fs::read_to_string(path).unwrap_or_default();
    let mut rows = BTreeMap::new();
    for row in old.lines() {
        if let Some(format) = row.split(',').next().and_then(|name| name.parse::<Format>().ok()) {
            rows.insert(format, row.to_owned());
        }
    }
    for (format, (slices, sum)) in sums(done) {
        let Findings { codes, canonical, angle, length } = sum;
        if slices == SLICES {
            assert_eq!(codes, 1 << format.bits(), "{format}");
            let row = format!("{format},{codes},{canonical},{angle:.2e},{length:.2e}");
            rows.insert(format, row);
        }
    }
    let mut table = String::from("format,codes,canonical,decode_error_rad,length_error\n");
    for row in rows.values() {
        writeln!(table, "{row}").expect("strings take everything");
    }
    fs::write(path, table)
}
