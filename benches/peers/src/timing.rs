//! Contenders that take turns.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// For how long a contest goes on, and how many rounds at least.
const TIME: Duration = Duration::from_secs(3);
const ROUNDS: usize = 15;

/// How long `f` took.
pub fn timed<T>(f: impl FnOnce() -> T) -> Duration {
    let start = Instant::now();
    black_box(f());
    start.elapsed()
}

type Turn<'a> = Box<dyn FnMut() -> Duration + 'a>;

pub struct Contest<'a> {
    title: String,
    /// How many vectors a turn takes.
    len: usize,
    /// Whose time the others are compared with.
    reference: String,
    contenders: Vec<(String, Turn<'a>)>,
}

/// What a contest showed.
pub struct Times {
    pub title: String,
    pub place: String,
    /// The best turns, in nanoseconds a vector.
    pub rows: Vec<(String, f64)>,
}

impl<'a> Contest<'a> {
    pub fn new(title: &str, len: usize, reference: &str) -> Self {
        Contest { title: title.into(), len, reference: reference.into(), contenders: Vec::new() }
    }

    /// A contender, by the function that does a turn and says how long it took.
    pub fn add(mut self, name: &str, turn: impl FnMut() -> Duration + 'a) -> Self {
        self.contenders.push((name.into(), Box::new(turn)));
        self
    }

    /// Lets all take turns for some time.
    pub fn times(mut self, place: &str, time: Duration) -> Times {
        let mut best = vec![Duration::MAX; self.contenders.len()];
        let (start, mut rounds) = (Instant::now(), 0);
        while rounds < ROUNDS || start.elapsed() < time {
            for (best, (_, turn)) in best.iter_mut().zip(&mut self.contenders) {
                *best = turn().min(*best);
            }
            rounds += 1;
        }
        let ns = |best: Duration| best.as_secs_f64() * 1e9 / self.len as f64;
        let names = self.contenders.into_iter().map(|(name, _)| name);
        Times {
            title: self.title,
            place: place.into(),
            rows: names.zip(best.into_iter().map(ns)).collect(),
        }
    }

    /// Lets all take turns, and prints the table.
    pub fn run(self, place: &str) -> Times {
        let reference = self.reference.clone();
        let times = self.times(place, TIME);
        let of = times.rows.iter().find(|row| row.0 == reference).expect("a contender").1;
        println!("\n| {}, {} | ns a vector | times |\n|---|--:|--:|", times.title, times.place);
        for (name, ns) in &times.rows {
            println!("| {name} | {ns:.2} | {:.2} |", ns / of);
        }
        times
    }
}
