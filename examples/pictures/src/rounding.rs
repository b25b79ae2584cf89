//! Which way the parameters of oct16 have to be rounded for the nearest code.

use unitpack::Format;
use unitpack_test::vectors::{chord_squared, normalize};

use crate::canvas::{
    BODY, BOLD, Canvas, GAP, INK, LINE, RED, Rgb, Scale, WHITE, sheet, text_width,
};
use crate::geometry::V3;
use crate::raster::Raster;
use crate::round_trip::{Encoder, decode};

/// The roundings of u and v, in the order of `nearest`. Colours of Okabe and Ito, "Color Universal
/// Design" (2008).
const ROUNDINGS: [(&str, Rgb); 4] = [
    ("u down, v down", [0, 114, 178]),
    ("u up, v down", [230, 159, 0]),
    ("u down, v up", [0, 158, 115]),
    ("u up, v up", [204, 121, 167]),
];

/// Steps of a parameter from 0 to 1.
const STEPS: i32 = 127;
/// Cells along the square.
const CELLS: usize = 2 * STEPS as usize;
/// Samples along the side of a cell, for its share.
const SAMPLES: usize = 32;
/// Cells along a close-up.
const CLOSE: usize = 6;
/// Radius of the circle of a code.
const DOT: usize = 5;

const MISSED: Scale = Scale {
    title: "Share of a cell",
    gradient: colorous::VIRIDIS,
    range: [0.0, 0.3],
    ticks: &[(0.0, "0 %"), (0.1, "10 %"), (0.2, "20 %"), (0.3, "30 %")],
    above: Some((RED, "more")),
};
/// The lower left corners of the close-ups.
const PLACES: [(&str, [i32; 2]); 4] = [
    ("around u = 0, v = 0: +Z", [-3, -3]),
    ("around u = 1/3, v = 1/3: (1, 1, 1)", [39, 39]),
    ("around u = 1/2, v = 1/2: the equator", [60, 60]),
    ("at u = 1, v = 0: +X", [121, -3]),
];

/// The direction of u and v in steps.
fn direction([u, v]: [f64; 2]) -> V3 {
    let [u, v] = [u, v].map(|c| c / f64::from(STEPS));
    let z = 1.0 - u.abs() - v.abs();
    let fold = (-z).max(0.0);
    normalize([u - fold.copysign(u), v - fold.copysign(v), z])
}

/// The best rounding of `side` times `side` samples a cell, row by row from the top.
fn nearest(corner: [i32; 2], cells: usize, side: usize) -> Vec<usize> {
    let mut best = Vec::with_capacity((cells * side).pow(2));
    for row in (0..cells * side).rev() {
        let (mut codes, mut directions) = (Vec::new(), Vec::new());
        for column in 0..cells * side {
            let [u, v] = [column, row].map(|i| (i as f64 + 0.5) / side as f64);
            let [u, v] = [f64::from(corner[0]) + u, f64::from(corner[1]) + v];
            directions.push(direction([u, v]));
            for i in 0..ROUNDINGS.len() {
                let up = |bit: usize| (i >> bit & 1) as f64;
                // Low byte first.
                codes.extend([u.floor() + up(0), v.floor() + up(1)].map(|c| c as i8 as u8));
            }
        }
        let decoded: Vec<V3> = decode(Format::Oct16, &codes).wide().collect();
        for (&v, four) in directions.iter().zip(decoded.chunks(ROUNDINGS.len())) {
            let distance = |i: &usize| chord_squared(four[*i], v);
            best.extend((0..four.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))));
        }
    }
    best
}

/// Each cell with the share of it for which `encode` and `encode_precise` give different codes.
fn missed() -> Raster<1> {
    // Each row of samples is shifted by the golden ratio, else many meet the ties on diagonals.
    let direction = |at: [f64; 2]| {
        let [u, v] = at.map(|c| c * f64::from(STEPS));
        let shifted = u - u.floor() + (v - v.floor()) * SAMPLES as f64 * 0.618_034;
        Some(direction([u.floor() + shifted.fract(), v]))
    };
    Raster::sample(CELLS, SAMPLES, direction, |v| {
        let [fast, precise] = Encoder::both(Format::Oct16).map(|encoder| encoder.encode(v));
        let size = Format::Oct16.code_size();
        let codes = fast.chunks(size).zip(precise.chunks(size));
        codes.map(|(fast, precise)| [f64::from(u8::from(fast != precise))]).collect()
    })
}

/// Squares of both parameters, and close-ups. `size` is about a third of a square.
pub fn page(size: usize) -> Canvas {
    let missed = missed();
    let mut squares = [Canvas::new(CELLS, CELLS), Canvas::new(CELLS, CELLS)];
    for (i, best) in nearest([-STEPS; 2], CELLS, 1).into_iter().enumerate() {
        squares[0].set(i % CELLS, i / CELLS, ROUNDINGS[best].1);
    }
    missed.paint(&mut squares[1], 0, 0, |[share]| MISSED.colour(share));

    let pixels = (3 * size).div_ceil(CELLS);
    let side = CELLS * pixels;
    let titles = ["nearest to the middle of a cell", "where encode misses the nearest"];
    let mut squares = [0, 1].map(|i| {
        let width = side.max(MISSED.width());
        let mut canvas = Canvas::new(width, LINE + side + GAP + Scale::HEIGHT);
        canvas.text(0, 0, BOLD, titles[i]);
        canvas.paste(0, LINE, &squares[i].enlarged(pixels));
        canvas
    });
    let below = LINE + side + GAP;
    for (i, (name, colour)) in ROUNDINGS.into_iter().enumerate() {
        let (x, y) = (i % 2 * 160, below + i / 2 * 30);
        squares[0].fill(x, y, 18, 18, colour);
        squares[0].text(x + 26, y + 3, BODY, name);
    }
    MISSED.legend(&mut squares[1], 0, below);

    let mut tiles = squares.to_vec();
    tiles.extend(PLACES.map(|(title, corner)| close_up(title, corner, side / CLOSE)));
    let often = 100.0 * missed.mean()[0];
    let notes = [
        "A cell lies between four codes: both parameters, u and v, are rounded up or down.",
        "Above: all cells, u to the right and v up, from -1 to 1. Below: a few of them; circles",
        "are codes, and lines are where encode goes over from one to another.",
        &format!("It misses the nearest in {often:.1} % of the square."),
    ];
    sheet("oct16: best rounding", &notes, None, 2, &tiles)
}

fn close_up(title: &str, corner: [i32; 2], side: usize) -> Canvas {
    let size = CLOSE * side;
    let mut canvas =
        Canvas::new((size + 2 * DOT).max(text_width(BOLD, title)), LINE + size + 2 * DOT);
    canvas.text(0, 0, BOLD, title);
    let (x, y) = (DOT, LINE + DOT);
    for (i, best) in nearest(corner, CLOSE, side).into_iter().enumerate() {
        canvas.set(x + i % size, y + i / size, ROUNDINGS[best].1);
    }
    for cell in 0..CLOSE {
        let half = cell * side + side / 2;
        canvas.fill(x + half, y, 1, size, WHITE);
        canvas.fill(x, y + half, size, 1, WHITE);
    }
    for i in 0..(CLOSE + 1).pow(2) {
        let [x, y] = [x + i % (CLOSE + 1) * side, y + i / (CLOSE + 1) * side].map(|c| c as f64);
        canvas.disc(x, y, DOT as f64, INK);
        canvas.disc(x, y, DOT as f64 - 1.0, WHITE);
    }
    canvas
}
