//! Patterns of byte shuffles between vectors and rows of components.

/// Largest number of components of a vector that lanes transpose with shuffles.
const MAX_SHUFFLED: usize = 4;

/// Shuffles from or to `LANES` vectors of `N` components, of which the first `C` count. In memory they
/// are `N` rows of `LANES` components. Empty beyond [`MAX_SHUFFLED`].
pub(super) struct Shuffle<const N: usize, const C: usize, const LANES: usize, const BYTES: usize>;

impl<const N: usize, const C: usize, const LANES: usize, const BYTES: usize>
    Shuffle<N, C, LANES, BYTES>
{
    /// For each row and component: keeps the lanes already collected, and adds this row's.
    pub(super) const LOAD: [[[u8; BYTES]; C]; N] = {
        let mut picks = [[[0; BYTES]; C]; N];
        let mut i = 0;
        while N <= MAX_SHUFFLED && i < N * LANES {
            let (row, component, lane) = (i / LANES, i % N, i / N);
            // The lane is found in this row, and kept in later ones.
            let mut later = row;
            while component < C && later < N {
                let from = if later == row { LANES + i % LANES } else { lane };
                put(&mut picks[later][component], lane, from);
                later += 1;
            }
            i += 1;
        }
        picks
    };
    /// For each row: adds component 1 to component 0, then each further one, then what the row keeps.
    pub(super) const STORE: [[[u8; BYTES]; C]; N] = {
        let mut picks = [[[0; BYTES]; C]; N];
        let mut i = 0;
        while N <= MAX_SHUFFLED && i < N * LANES {
            let (row, place, component, lane) = (i / LANES, i % LANES, i % N, i / N);
            let mut step = 1;
            while step < C {
                let collected = if step == 1 { lane } else { place };
                let from = if component == step { LANES + lane } else { collected };
                put(&mut picks[row][step - 1], place, from);
                step += 1;
            }
            put(&mut picks[row][C - 1], place, if component < C { place } else { LANES + place });
            i += 1;
        }
        picks
    };
}

/// From groups of three bytes to groups of four, whose fourth byte is 0.
pub(super) const fn spread<const BYTES: usize>() -> [u8; BYTES] {
    let mut picks = [u8::MAX; BYTES];
    let mut byte = 0;
    while byte < BYTES {
        if byte % 4 < 3 {
            picks[byte] = (byte / 4 * 3 + byte % 4) as u8;
        }
        byte += 1;
    }
    picks
}

/// From groups of four bytes to groups of three, followed by anything.
pub(super) const fn dense<const BYTES: usize>() -> [u8; BYTES] {
    let mut picks = [0; BYTES];
    let mut byte = 0;
    while byte < BYTES / 4 * 3 {
        picks[byte] = (byte / 3 * 4 + byte % 3) as u8;
        byte += 1;
    }
    picks
}

/// From two vectors of 16 bytes, the first `C` floats of the first, and the others of the second.
pub(super) const fn first<const C: usize>() -> [u8; 16] {
    let mut picks = [0; 16];
    let mut byte = 0;
    while byte < 16 {
        picks[byte] = if byte < 4 * C { byte as u8 } else { byte as u8 + 16 };
        byte += 1;
    }
    picks
}

/// Picks lane `from` for lane `to`.
const fn put(picks: &mut [u8], to: usize, from: usize) {
    let mut byte = 0;
    while byte < 4 {
        picks[4 * to + byte] = (4 * from + byte) as u8;
        byte += 1;
    }
}
