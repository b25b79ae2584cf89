//! The pinned digests of `tests/digests.txt`, and how a test compares with them.
//!
//! With `PIN` in the environment a test writes its section instead: `tools/pin` does that for all.

use std::fs;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// FNV-1a, 64 bits.
pub fn digest(bytes: impl IntoIterator<Item = u8>) -> u64 {
    bytes.into_iter().fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3)
    })
}

/// A name without spaces, and its digests in the order of the columns.
type Line = (String, Vec<u64>);

/// One section of the file: `[title] column column ...`, then a line for each thing that is digested.
pub struct Section {
    title: &'static str,
    columns: &'static [&'static str],
    pinned: Vec<Line>,
    now: Vec<Line>,
}

impl Section {
    /// The section of this title, which may be missing.
    pub fn open(title: &'static str, columns: &'static [&'static str]) -> Self {
        let text = read();
        let pinned = match place(&text, title) {
            Some((begin, end)) => text[begin..end].lines().skip(1).filter_map(parse).collect(),
            None => Vec::new(),
        };
        Section { title, columns, pinned, now: Vec::new() }
    }

    /// Takes the next digest of the thing `name`. Whether it is the pinned one decides
    /// [`finish`](Section::finish), or at once [`expect`](Section::expect).
    pub fn add(&mut self, name: &str, digest: u64) {
        match self.now.last_mut() {
            Some((last, digests)) if last == name => digests.push(digest),
            _ => self.now.push((name.to_owned(), vec![digest])),
        }
    }

    /// As [`add`](Section::add), for tests that take long: fails without the rest.
    ///
    /// # Panics
    /// If another digest is pinned.
    pub fn expect(&mut self, name: &str, digest: u64) {
        self.add(name, digest);
        if pins() {
            return;
        }
        if let Some(change) = self.changes(name).last() {
            panic!("[{}] {change}", self.title);
        }
    }

    /// Compares, or pins.
    ///
    /// # Panics
    /// If other lines are pinned.
    pub fn finish(self) {
        if pins() {
            return self.pin();
        }
        let mut changes: Vec<String> =
            self.now.iter().flat_map(|(name, _)| self.changes(name)).collect();
        let is_gone = |(name, _): &&Line| self.find(&self.now, name).is_none();
        changes
            .extend(self.pinned.iter().filter(is_gone).map(|(name, _)| format!("{name} is gone")));
        assert!(
            changes.is_empty(),
            "[{}] of tests/digests.txt differs. A digest that was released and changes is a change of \
             the format: CHANGELOG names it as one. `tools/pin digests` pins those of now.\n{}",
            self.title,
            changes.join("\n")
        );
    }

    fn find<'a>(&self, lines: &'a [Line], name: &str) -> Option<&'a [u64]> {
        lines.iter().find(|(other, _)| other == name).map(|(_, digests)| &digests[..])
    }

    /// What differs of one thing, as far as it has been added.
    fn changes(&self, name: &str) -> Vec<String> {
        let now = self.find(&self.now, name).unwrap_or(&[]);
        let Some(pinned) = self.find(&self.pinned, name) else {
            return vec![format!("{name} is new")];
        };
        let differs = |&i: &usize| pinned.get(i) != Some(&now[i]);
        let differing = (0..now.len()).filter(differs);
        differing.map(|i| format!("{} of {name} changed", self.columns[i])).collect()
    }

    fn pin(self) {
        let mut section = format!("[{}] {}\n", self.title, self.columns.join(" "));
        for (name, digests) in &self.now {
            let digests: Vec<String> = digests.iter().map(|d| format!("{d:016x}")).collect();
            section += &format!("{name:20} {}\n", digests.join(" "));
        }
        let _alone = lock();
        let mut text = read();
        match place(&text, self.title) {
            Some((begin, end)) => text.replace_range(begin..end, &section),
            None => text += &format!("\n{section}"),
        }
        fs::write(path(), text).expect("tests/digests.txt can be written");
    }
}

/// Whether digests are pinned and not compared.
fn pins() -> bool {
    std::env::var_os("PIN").is_some()
}

/// The tests of one program run side by side.
fn lock() -> MutexGuard<'static, ()> {
    static LOCK: Mutex<()> = Mutex::new(());
    LOCK.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Read when a test runs, so that pinning compiles nothing again.
fn read() -> String {
    fs::read_to_string(path()).expect("tests/digests.txt can be read")
}

fn path() -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "..", "tests", "digests.txt"].iter().collect()
}

/// Where a section begins and ends, without the empty line behind it.
fn place(text: &str, title: &str) -> Option<(usize, usize)> {
    let head = format!("[{title}]");
    let starts = text.match_indices(&head).map(|(at, _)| at);
    let begin = starts.into_iter().find(|&at| at == 0 || text[..at].ends_with('\n'))?;
    let end = text[begin..].find("\n\n").map_or(text.len(), |len| begin + len + 1);
    Some((begin, end))
}

fn parse(line: &str) -> Option<Line> {
    let mut words = line.split_whitespace();
    let name = words.next()?.to_owned();
    let digests = words.map(|word| u64::from_str_radix(word, 16).expect("digests are hexadecimal"));
    Some((name, digests.collect()))
}
