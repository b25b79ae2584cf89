//! Each codec's page says which axes survive a round trip exactly; here is that list.

use unitpack::Format;
use unitpack_test::{AnyCodec, Effort};

const ALL: &[&str] = &["+X", "-X", "+Y", "-Y", "+Z", "-Z"];

/// The axes, by name, that a format keeps. All others it must not keep, or the page says too
/// little.
fn exact_axes(name: &str, precise: bool) -> &'static [&'static str] {
    let family = name.trim_end_matches(|c: char| c.is_ascii_digit());
    match family {
        "oct" | "warpedoct" | "eqareaoct" | "sixoct" | "signedoct" | "cube" | "warpedcube"
        | "octant" | "icosphere" => ALL,
        "spherical" => &["+X", "-X", "+Z", "-Z"],
        "HemiOct" | "XYOnly32F" => &["+X", "-X", "+Y", "-Y", "+Z"],
        // Their steps are a multiple of 7 and of 23, so that the other axes are points too.
        _ if name == "frontoct32" || name == "quadfrontoct24" => ALL,
        "frontoct" | "quadfrontoct" => &["+Z", "-Z"],
        "latlong" => &["+X", "+Z", "-Z"],
        // An odd number of points on the equator.
        _ if name == "latlong32D" => &["+X", "+Z", "-Z"],
        "XYOnly" | "xyz-unorm8x" | "xyz-unorm16x" | "CrytekBFN" | "fibonacci" => &[],
        // A corner of the square.
        "oct-unorm8x" | "oct-unorm16x" => &["-Z"],
        // The poles are the corners of the square too, and exact there.
        "eqarea" if precise => &["+X", "-X", "+Z", "-Z"],
        "phi-z-unorm8x" | "phi-z-unorm16x" => &["+Z", "-Z"],
        // A cell has its centre on the axis if the number of cells along an edge is odd.
        "angularcube" => {
            let bits: u32 = name[family.len()..].parse().unwrap();
            let cells = ((1u64 << bits) as f64 / 6.0).sqrt() as u64;
            if cells % 2 == 1 { ALL } else { &[] }
        }
        _ if name.starts_with("latlong") => &["+X", "-X", "+Z", "-Z"],
        _ if name.starts_with("snorm") || name.starts_with("float") => ALL,
        _ if ["stereo", "eqarea", "eqdist"].iter().any(|p| name.starts_with(p)) => &["+X", "-X"],
        _ => panic!("{name} has no row here"),
    }
}

const AXES: [(usize, f32, &str); 6] = [
    (0, 1.0, "+X"),
    (0, -1.0, "-X"),
    (1, 1.0, "+Y"),
    (1, -1.0, "-Y"),
    (2, 1.0, "+Z"),
    (2, -1.0, "-Z"),
];

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
            let expected = exact_axes(format.name(), effort == Effort::Precise);
            if kept != expected {
                wrong += &format!("{format} {effort:?} keeps {kept:?}, not {expected:?}\n");
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
