//! The greatest errors that the table states are upper bounds, and tight.
//!
//! Random directions, then a climb from the worst of them. The figures printed are what to put into
//! the table.

use unitpack::{Codec, Format, Visitor};

use crate::common::{Rng, angle, widen};

/// The climb's starting points, and how far it goes.
struct Effort {
    vectors: usize,
    climbers: usize,
    steps: usize,
}

/// The error of one vector, in degrees.
struct ErrorOf {
    precise: bool,
}

impl Visitor for ErrorOf {
    type Output = fn([f32; 3]) -> f64;
    fn visit<C: Codec>(self) -> Self::Output {
        fn error(v: [f32; 3], decoded: [f32; 3]) -> f64 {
            angle(widen(v), widen(decoded)).to_degrees()
        }
        if self.precise {
            |v| error(v, C::decode(C::encode_precise(v)))
        } else {
            |v| error(v, C::decode(C::encode(v)))
        }
    }
}

fn worst(format: Format, precise: bool, effort: &Effort) -> f64 {
    let error = format.visit(ErrorOf { precise });
    let mut rng = Rng::new(7);
    let upper = |mut v: [f32; 3]| {
        if format.is_hemisphere() {
            v[2] = v[2].abs();
        }
        v
    };
    // Many of them close to an axis, or close to a plane between two: the worst places of some
    // formats.
    let mut start = |i: usize| {
        let mut v = rng.direction();
        let small = 10f32.powf(-5.0 * rng.unit() as f32);
        let axis = i / 7 % 3;
        match i % 7 {
            0 | 1 => v[axis] /= small,
            2 | 3 => v[axis] *= small,
            // Near the diagonals of the rim of a hemisphere.
            4 => v = [v[0], v[0] * (1.0 + 0.1 * v[1]), v[2] * small * small],
            // Near the corners of a cube.
            5 => v = v.map(|c| (1.0 + c * small).copysign(c)),
            _ => {}
        }
        upper(v)
    };
    let mut worst: Vec<(f64, [f32; 3])> =
        (0..effort.vectors).map(&mut start).map(|v| (error(v), v)).collect();
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    worst.truncate(effort.climbers);
    for (e, v) in &mut worst {
        let mut reach = (e.to_radians() * 0.5).max(1e-6);
        for _ in 0..effort.steps {
            let d = rng.direction();
            let scale = reach * f64::from(v[0].hypot(v[1]).hypot(v[2]));
            let w = upper(core::array::from_fn(|i| v[i] + d[i] * scale as f32));
            let there = error(w);
            if there > *e {
                (*e, *v) = (there, w);
            } else {
                reach *= 0.97;
            }
            reach = reach.max(1e-7);
        }
    }
    worst.iter().map(|w| w.0).fold(0.0, f64::max)
}

#[test]
fn stated_maxima_hold_and_are_tight() {
    let mut wrong = String::new();
    for &format in Format::ALL {
        for precise in [false, true] {
            let slow = precise && format.name() == "snorm16x3";
            let effort = match (slow, precise) {
                (true, _) => Effort { vectors: 2_000, climbers: 5, steps: 100 },
                (_, true) => Effort { vectors: 20_000, climbers: 20, steps: 250 },
                _ => Effort { vectors: 200_000, climbers: 50, steps: 400 },
            };
            let measured = worst(format, precise, &effort);
            let stated = if precise {
                format.max_error_precise_degrees()
            } else {
                format.max_error_degrees()
            };
            println!(
                "{format} {} {measured:.7} of {stated}",
                if precise { "precise" } else { "fast" }
            );
            // 32-bit formats and finer: what f32 rounding moves is a part of the figure, and rarely
            // met.
            let tight = if slow { 0.3 } else { 0.9 };
            if measured > stated || measured < tight * stated {
                wrong += &format!(
                    "{format} precise={precise}: measured {measured:.7}, stated {stated}\n"
                );
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
