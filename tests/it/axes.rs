//! Each codec's page says which axes survive a round trip exactly: those that its row lists, and no
//! others.

use unitpack::Format;
use unitpack_test::{AnyCodec, Effort};

const AXES: [(usize, f32, &str); 6] = [
    (0, 1.0, "+X"),
    (0, -1.0, "-X"),
    (1, 1.0, "+Y"),
    (1, -1.0, "-Y"),
    (2, 1.0, "+Z"),
    (2, -1.0, "-Z"),
];

/// The axes in a list such as "±X +Z".
fn listed(axes: &str) -> Vec<&'static str> {
    let has = |&(_, _, name): &(usize, f32, &str)| {
        axes.split(' ').any(|axis| axis == name || axis.strip_prefix('±') == Some(&name[1..]))
    };
    AXES.iter().filter(|axis| has(axis)).map(|axis| axis.2).collect()
}

/// The axes that survive encoding and decoding exactly, whatever length they come in.
fn survivors(codec: &AnyCodec, effort: Effort) -> Vec<&'static str> {
    let keeps = |&(axis, sign, _): &(usize, f32, &str)| {
        [1.0f32, 3.0, 1e-42, 1e30, f32::INFINITY].iter().all(|length| {
            let along = |length| core::array::from_fn(|i| if i == axis { length } else { 0.0 });
            // Float32x3 gives back the length as well.
            let kept = if codec.stores_direction() { sign } else { sign * length };
            let expected: [f32; 3] = along(kept);
            (codec.decode)(codec.encode_with(effort, along(sign * length))) == expected
        })
    };
    AXES.iter().filter(|axis| keeps(axis)).map(|axis| axis.2).collect()
}

#[test]
fn axes_survive_as_documented() {
    let mut wrong = String::new();
    for &format in Format::ALL {
        for effort in Effort::BOTH {
            let kept = survivors(AnyCodec::of(format), effort);
            let expected = listed(match effort {
                Effort::Fast => format.exact_axes(),
                Effort::Precise => format.exact_axes_precise(),
            });
            if kept != expected {
                wrong += &format!("{format} {effort:?} keeps {kept:?}, not {expected:?}\n");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
