//! The nearest of all codes, without any notion of neighbours: every code is decoded and looked up
//! among the directions that it may be nearer to than the code they were given.

use std::f64::consts::SQRT_2;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use unitpack::{Format, SoaMut};

use unitpack_test::oracle::Oracle;
use unitpack_test::vectors::{chord_squared, widen};

/// Radians by which the crate's decoder may be off (4e-7 in `tests/it/oracle_agrees.rs`), and the map.
const DECODE_ERROR: f64 = 2e-6;
/// Cells along the octahedral map's sides, at most: 2^27 in all.
const MOST_CELLS: f64 = 8192.0;
/// Parts along a cell's sides.
const PARTS: u32 = 8;
/// How many codes are decoded at once.
const BATCH: usize = 4096;
/// How many vectors are remembered, so as to look up but once what many codes decode to.
const MEMORY: usize = 1 << 16;

/// A direction, and the chord within which it looks for codes.
#[derive(Clone, Copy, Default)]
pub struct Entry {
    unit: [f32; 3],
    reach: f32,
    number: u32,
}

impl Entry {
    /// Of the `number`th direction, whose code is at a chord of `chosen`.
    pub fn new(number: usize, target: [f64; 3], chosen: f64) -> Self {
        let unit = target.map(|c| c as f32);
        Entry { unit, reach: (chosen + DECODE_ERROR) as f32, number: number as u32 }
    }
}

/// Directions, by the cells that their reach touches. Cells are those of a grid on the octahedron
/// seen from above and from below: place x / s and y / s, with s = |x| + |y| + |z|, and the sign of
/// z.
pub struct Reaches {
    side: u32,
    words: Vec<Word>,
    /// Those that are touched, and one more.
    cells: Vec<Cell>,
    entries: Vec<Entry>,
}

/// Which of 64 cells are touched, and how many before them.
#[derive(Clone, Copy, Default)]
struct Word {
    touched: u64,
    before: u32,
}

/// Which parts are touched, and where the entries begin.
#[derive(Clone, Copy, Default)]
struct Cell {
    parts: u64,
    begin: u32,
}

impl Reaches {
    pub fn new(directions: &[Entry]) -> Self {
        // Twice as wide as most reaches.
        let mean = directions.iter().map(|d| f64::from(d.reach)).sum::<f64>();
        let mean = (mean / directions.len() as f64).max(1e-9);
        let side = (2.0 / (4.0 * SQRT_2 * mean)).clamp(1.0, MOST_CELLS) as u32;
        let count = 2 * (side as usize + 1).pow(2);
        let words = vec![Word::default(); count.div_ceil(64)];
        let mut this = Reaches { side, words, cells: Vec::new(), entries: Vec::new() };
        for direction in directions {
            let words = &mut this.words;
            touched(side, direction, |cell, _| words[cell / 64].touched |= 1 << (cell % 64));
        }
        let mut count = 0;
        for word in &mut this.words {
            word.before = count;
            count += word.touched.count_ones();
        }
        let mut cells = vec![Cell::default(); count as usize + 1];
        for direction in directions {
            touched(side, direction, |cell, parts| {
                let cell = &mut cells[this.rank(cell).unwrap()];
                cell.parts |= parts;
                cell.begin += 1;
            });
        }
        // Where a cell's entries end, moved down to where they begin as they are filled in.
        let mut end = 0;
        for cell in &mut cells {
            end += cell.begin;
            cell.begin = end;
        }
        let mut entries = vec![Entry::default(); end as usize];
        for direction in directions {
            touched(side, direction, |cell, _| {
                let end = &mut cells[this.rank(cell).unwrap()].begin;
                *end -= 1;
                entries[*end as usize] = *direction;
            });
        }
        Reaches { cells, entries, ..this }
    }

    /// How many touched cells stand before a touched one.
    #[inline(always)]
    fn rank(&self, cell: usize) -> Option<usize> {
        let word = self.words[cell / 64];
        let bit = 1 << (cell % 64);
        let below = (word.touched & (bit - 1)).count_ones();
        (word.touched & bit != 0).then_some((word.before + below) as usize)
    }

    /// The directions that may reach a place.
    #[inline(always)]
    fn at(&self, [cell, part]: [u32; 2]) -> &[Entry] {
        match self.rank(cell as usize) {
            Some(rank) if self.cells[rank].parts >> part & 1 == 1 => {
                let [begin, end] = [rank, rank + 1].map(|i| self.cells[i].begin as usize);
                &self.entries[begin..end]
            }
            _ => &[],
        }
    }

    /// Lowers `best`, for each direction the least squares of chords so far, to the nearest of some
    /// codes.
    pub fn search(
        &self,
        format: Format,
        oracle: &Oracle,
        codes: Range<u64>,
        target: impl Fn(u32) -> [f64; 3],
        best: &[Best],
    ) {
        let size = format.code_size();
        let mut bytes = vec![0; BATCH * size];
        let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0; BATCH]);
        let mut places = vec![[0; 2]; BATCH];
        let mut memory = vec![[0.0; 3]; MEMORY];
        for first in codes.clone().step_by(BATCH) {
            let count = (codes.end - first).min(BATCH as u64) as usize;
            let bytes = &mut bytes[..count * size];
            fill(bytes, size, first);
            let v = SoaMut { x: &mut x[..count], y: &mut y[..count], z: &mut z[..count] };
            format.decode(bytes, v).unwrap();
            for (i, place) in places[..count].iter_mut().enumerate() {
                let v = [x[i], y[i], z[i]];
                *place = cell(self.side, parts(self.side, v).map(whole), v[2] < 0.0);
            }
            for (i, &place) in places[..count].iter().enumerate() {
                let entries = self.at(place);
                if entries.is_empty() {
                    continue;
                }
                let v = [x[i], y[i], z[i]];
                let near = |entry: &&Entry| {
                    let [dx, dy, dz] = [0, 1, 2].map(|i| v[i] - entry.unit[i]);
                    dx * dx + dy * dy + dz * dz <= entry.reach * entry.reach
                };
                let mut near = entries.iter().filter(near).peekable();
                if near.peek().is_none() {
                    continue;
                }
                let code = u128::from(first) + i as u128;
                let exact = oracle.decode(code);
                let off = chord_squared(exact, widen(v)).sqrt();
                assert!(off < DECODE_ERROR / 2.0, "{format}: {code:#x} decodes to {v:?}");
                let remembered = &mut memory[hash(exact) % MEMORY];
                if *remembered == exact {
                    continue;
                }
                *remembered = exact;
                for entry in near {
                    let target = target(entry.number);
                    let best = &best[entry.number as usize];
                    lower(&best.exact, chord_squared(exact, target));
                    lower(&best.decoded, chord_squared(widen(v), target));
                }
            }
        }
    }
}

/// The least squares of chords from a direction, as bits: to what codes stand for, and to what the
/// crate decodes them to.
pub struct Best {
    exact: AtomicU64,
    decoded: AtomicU64,
}

impl Default for Best {
    fn default() -> Self {
        let [exact, decoded] = [f64::INFINITY; 2].map(|chord| AtomicU64::new(chord.to_bits()));
        Best { exact, decoded }
    }
}

impl Best {
    pub fn exact(&self) -> f64 {
        f64::from_bits(self.exact.load(Ordering::Relaxed))
    }

    pub fn decoded(&self) -> f64 {
        f64::from_bits(self.decoded.load(Ordering::Relaxed))
    }
}

fn lower(least: &AtomicU64, chord_squared: f64) {
    // Not negative, so the bits stand in the order of the numbers.
    if chord_squared.to_bits() < least.load(Ordering::Relaxed) {
        least.fetch_min(chord_squared.to_bits(), Ordering::Relaxed);
    }
}

fn hash(v: [f64; 3]) -> usize {
    let mix = |hash: u64, c: f64| (hash ^ c.to_bits()).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (v.into_iter().fold(0, mix) >> 32) as usize
}

/// Consecutive codes.
fn fill(bytes: &mut [u8], size: usize, first: u64) {
    fn fill<const SIZE: usize>(bytes: &mut [u8], first: u64) {
        for (bytes, code) in bytes.as_chunks_mut::<SIZE>().0.iter_mut().zip(first..) {
            bytes.copy_from_slice(&code.to_le_bytes()[..SIZE]);
        }
    }
    match size {
        1 => fill::<1>(bytes, first),
        2 => fill::<2>(bytes, first),
        3 => fill::<3>(bytes, first),
        _ => fill::<4>(bytes, first),
    }
}

/// Where a vector stands, in parts of cells.
#[inline(always)]
fn parts(side: u32, [x, y, z]: [f32; 3]) -> [f32; 2] {
    let half = 0.5 * (PARTS * side) as f32;
    let scale = half / (x.abs() + y.abs() + z.abs());
    [x * scale + half, y * scale + half]
}

/// The nearest integer to a number from 0 to 2^22.
#[inline(always)]
fn whole(t: f32) -> u32 {
    // Adding 2^23 rounds and leaves the integer in the low bits.
    (t + 8_388_608.0).to_bits() & 0x7F_FFFF
}

/// The cell, and the number of the part in it.
#[inline(always)]
fn cell(side: u32, [i, j]: [u32; 2], below: bool) -> [u32; 2] {
    let row = u32::from(below) * (side + 1) + j / PARTS;
    [row * (side + 1) + i / PARTS, j % PARTS * PARTS + i % PARTS]
}

/// Calls `visit` with every cell in which there may be points within the reach of a direction, and
/// with those of its parts.
#[inline(always)]
fn touched(side: u32, direction: &Entry, mut visit: impl FnMut(usize, u64)) {
    let reach = direction.reach;
    // asin c <= c + (pi / 2 - 1) c^3, so the angle is at most this.
    let angle = reach * (1.0 + 0.143 * reach * reach);
    // No gradient of x / s or y / s is longer than sqrt 2.
    let margin = 1.4143 * 0.5 * (PARTS * side) as f32 * angle;
    let middle = parts(side, direction.unit);
    let bounds = [-margin, margin];
    let [least, greatest] =
        bounds.map(|m| middle.map(|t| whole((t + m).clamp(0.0, (PARTS * side) as f32))));
    let z = direction.unit[2];
    for (below, is_there) in [(false, z > -angle), (true, z < angle)] {
        if !is_there {
            continue;
        }
        for row in least[1] / PARTS..=greatest[1] / PARTS {
            // All parts of the rows between, in the lowest column.
            let [first, last] = within(row, least[1], greatest[1]);
            let rows =
                (u64::MAX >> (8 * (7 - last + first)) << (8 * first)) & 0x0101_0101_0101_0101;
            for column in least[0] / PARTS..=greatest[0] / PARTS {
                let [first, last] = within(column, least[0], greatest[0]);
                let columns = u64::from(0xFFu8 >> (7 - last + first) << first);
                let [cell, _] = cell(side, [column * PARTS, row * PARTS], below);
                visit(cell as usize, rows * columns);
            }
        }
    }
}

/// The first and the last of a cell's parts that are between two.
#[inline(always)]
fn within(cell: u32, least: u32, greatest: u32) -> [u32; 2] {
    let begin = cell * PARTS;
    [least.max(begin) - begin, greatest.min(begin + PARTS - 1) - begin]
}

#[cfg(test)]
mod tests {
    use super::*;
    use unitpack_test::codes::encode;
    use unitpack_test::oracle::oracle;
    use unitpack_test::random::mixed_vectors;

    #[test]
    fn nothing_nearer_is_missed() {
        for name in ["oct10", "angularcube5", "snorm5x3", "XYOnly16", "eqarea16", "latlong16D"] {
            let (format, oracle) = (name.parse::<Format>().unwrap(), oracle(name));
            let targets: Vec<_> =
                mixed_vectors(1, 10_000).iter().step_by(20).map(|v| oracle.target(*v)).collect();
            let inputs: Vec<_> = targets.iter().map(|v| v.map(|c| c as f32)).collect();
            // The fast encoder's codes, which leave more to find.
            let codes = encode(format, &inputs);
            let chosen = targets
                .iter()
                .zip(codes)
                .map(|(target, code)| chord_squared(oracle.decode(code), *target).sqrt());
            let entries: Vec<_> =
                chosen.enumerate().map(|(i, chosen)| Entry::new(i, targets[i], chosen)).collect();
            let best: Vec<_> = targets.iter().map(|_| Best::default()).collect();
            let (count, target) = (1 << format.bits(), |number: u32| targets[number as usize]);
            Reaches::new(&entries).search(format, &oracle, 0..count, target, &best);
            let all: Vec<_> = (0..u128::from(count)).map(|code| oracle.decode(code)).collect();
            for (target, best) in targets.iter().zip(&best) {
                let least = all.iter().map(|v| chord_squared(*v, *target)).fold(4.0, f64::min);
                assert_eq!(best.exact(), least, "{name}: {target:?}");
            }
        }
    }
}
