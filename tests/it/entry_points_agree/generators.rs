//! Random vectors rarely meet a tie, a fold or an odd zero, so these generators aim at those.

use proptest::array::{uniform3, uniform16};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use unitpack_test::{Code, Vector};

/// Steps from 0 to 1 of a snorm or unorm grid.
fn grid() -> impl Strategy<Value = f64> {
    (3u32..=16).prop_map(|bits| ((1u64 << bits) - 1) as f64)
}

/// A number in [-1, 1] on a grid or half-way between two of its points.
fn on_grid() -> impl Strategy<Value = f64> {
    (grid(), -1.0..1.0f64, select(vec![0.0, 0.5]))
        .prop_map(|(steps, t, tie)| ((t * steps).floor() + tie) / steps)
}

/// A number half-way between two halves, subnormal ones included.
fn between_halves() -> impl Strategy<Value = f64> {
    let normal = (99..=126u32, 0..1024u32)
        .prop_map(|(exponent, m)| f64::from(f32::from_bits(exponent << 23 | m << 13 | 0x1000)));
    let subnormal = (0..1024u32).prop_map(|m| (f64::from(m) + 0.5) / 16_777_216.0);
    (prop_oneof![normal, subnormal], any::<bool>())
        .prop_map(|(x, minus)| if minus { -x } else { x })
}

/// Any bits, with a taste for the odd ones.
fn component() -> impl Strategy<Value = f32> {
    let odd = select(vec![
        0.0,
        -0.0,
        1.0,
        -1.0,
        f32::from_bits(1),
        1e-40,
        -1e-40,
        f32::MIN_POSITIVE,
        -f32::MIN_POSITIVE,
        1e-20,
        1e38,
        -1e38,
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        -f32::NAN,
    ]);
    prop_oneof![odd, any::<u32>().prop_map(f32::from_bits), -1.0..1.0f32]
}

fn ordinary() -> impl Strategy<Value = Vector> {
    uniform3(-1.0..1.0f32)
}

/// The direction of a point of the octahedral square.
fn unfold([u, w]: [f64; 2]) -> [f64; 3] {
    let z = 1.0 - u.abs() - w.abs();
    if z >= 0.0 { [u, w, z] } else { [(1.0 - w.abs()).copysign(u), (1.0 - u.abs()).copysign(w), z] }
}

/// Directions on the borders between codes, between the faces of an octahedron, and where formulas
/// divide by almost nothing.
fn edge() -> impl Strategy<Value = [f64; 3]> {
    let tie = || prop_oneof![4 => on_grid(), 1 => between_halves()];
    let small = || {
        let size = select(vec![0.0, 1e-5, 1e-9, 1e-20, 1e-30, 1e-37, 1e-42]);
        (size, any::<bool>()).prop_map(|(x, minus): (f64, bool)| if minus { -x } else { x })
    };
    let angle = || {
        prop_oneof![on_grid().prop_map(|t| t * 180.0), (-4..=4).prop_map(|i| f64::from(i) * 45.0)]
    };
    let polar = |theta: f64, phi: f64| {
        let ((sin, cos), (y, x)) = (theta.to_radians().sin_cos(), phi.to_radians().sin_cos());
        [sin * x, sin * y, cos]
    };
    let axis = select(vec![[1.0, 0.0, 0.0], [-1.0, -0.0, 0.0]]);
    let diagonal = (select(vec![1.0, -1.0]), -1.0..1.0f64, prop_oneof![-1.0..1.0f64, small()])
        .prop_map(|(s, a, b)| [a, a * s, b]);
    let on_plane = (-1.0..1.0f64, -1.0..1.0f64, small()).prop_map(|(a, b, c)| [a, b, c]);
    let near_axis = (small(), small(), select(vec![1.0, -1.0])).prop_map(|(a, b, c)| [a, b, c]);
    let one_tie = (tie(), -180.0..180.0f64).prop_map(|(c, phi)| {
        let (y, x) = phi.to_radians().sin_cos();
        let r = (1.0 - c * c).max(0.0).sqrt();
        [c, r * y, r * x]
    });
    let two_ties = (tie(), tie()).prop_map(|(a, b)| [a, b, (1.0 - a * a - b * b).max(0.0).sqrt()]);
    let ties = (tie(), tie(), tie()).prop_map(|(a, b, c)| [a, b, c]);
    let free_axes = prop_oneof![axis, diagonal, on_plane, near_axis, one_tie, two_ties, ties]
        .prop_flat_map(|v| Just(v.to_vec()).prop_shuffle())
        .prop_map(|v| [v[0], v[1], v[2]]);

    let oct = (tie(), tie()).prop_map(|(u, w)| unfold([u, w]));
    let hemi_oct = (tie(), tie()).prop_map(|(u, w)| unfold([(u + w) / 2.0, (u - w) / 2.0]));
    let spherical = (angle(), angle()).prop_map(move |(theta, phi)| polar(theta, phi));
    let rim = (angle(), small()).prop_map(move |(phi, z)| {
        let [x, y, _] = polar(90.0, phi);
        [x, y, z]
    });
    prop_oneof![3 => free_axes, 1 => oct, 1 => hemi_oct, 1 => spherical, 1 => rim]
}

/// Vectors on and next to edges, of any length, and vectors of any bits.
pub fn special() -> impl Strategy<Value = Vector> {
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        if length > 0.0 { v.map(|c| c / length) } else { v }
    };
    let length = prop_oneof![
        4 => Just(None),
        2 => Just(Some(1.0)),
        1 => select(vec![0.7, 3.0, 1e38, 1e30, 1e-30, 1e-40]).prop_map(Some),
    ];
    let nudge = |c: f32, n: i8| match n {
        1 => c.next_up(),
        -1 => c.next_down(),
        _ => c,
    };
    let edge = (edge(), length, uniform3(-1..=1i8), any::<bool>()).prop_map(
        move |(v, length, nudges, exactly)| {
            let v = length.map_or(v, |l| unit(v).map(|c| c * l)).map(|c| c as f32);
            if exactly { v } else { std::array::from_fn(|i| nudge(v[i], nudges[i])) }
        },
    );
    prop_oneof![4 => edge, 1 => uniform3(component())]
}

/// Blocks in which every vector is special, and blocks of sixteen in which one is.
pub fn batch() -> impl Strategy<Value = Vec<Vector>> {
    let one = (uniform16(ordinary()), special(), 0..16usize).prop_map(|(mut block, v, lane)| {
        block[lane] = v;
        block.to_vec()
    });
    prop_oneof![vec(special(), 0..=36), one]
}

/// The greatest size of a code.
pub const CODE: usize = 12;

/// Bit patterns, of which a code takes as many bytes as it has.
pub fn patterns() -> impl Strategy<Value = Vec<Code>> {
    let byte = || select(vec![0, 1, 0x3C, 0x7B, 0x7C, 0x7F, 0x80, 0x81, 0xBC, 0xFC, 0xFE, 0xFF]);
    let odd = vec(byte(), CODE).prop_map(|bytes| bytes.iter().fold(0, add_byte));
    vec(prop_oneof![pattern(), odd], 0..=36)
}

/// Any bits.
pub fn pattern() -> impl Strategy<Value = Code> {
    any::<[u8; CODE]>().prop_map(|bytes| bytes.iter().fold(0, add_byte))
}

fn add_byte(code: Code, &byte: &u8) -> Code {
    code << 8 | Code::from(byte)
}

/// Sampled from a generator, the same every time.
pub fn sample<S: Strategy>(strategy: S) -> S::Value {
    strategy.new_tree(&mut TestRunner::deterministic()).unwrap().current()
}
