//! Each codec's page says which axes survive a round trip exactly; here is that list.

use unitpack::{Codec, Format, Visitor};

/// The axes, by name, that a format keeps. All others it must not keep, or the page says too
/// little.
fn exact_axes(name: &str) -> &'static [&'static str] {
    let family = name.trim_end_matches(|c: char| c.is_ascii_digit());
    match family {
        "oct" => &["+X", "-X", "+Y", "-Y", "+Z", "-Z"],
        "spherical" => &["+X", "-X", "+Z", "-Z"],
        "HemiOct" | "XYOnly32F" => &["+X", "-X", "+Y", "-Y", "+Z"],
        "XYOnly" => &[],
        _ if name.starts_with("snorm") || name.starts_with("float") => {
            &["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
        }
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

struct Survivors;

impl Visitor for Survivors {
    type Output = [Vec<&'static str>; 2];
    fn visit<C: Codec>(self) -> Self::Output {
        let encoders: [fn([f32; 3]) -> C::Code; 2] = [C::encode, C::encode_precise];
        encoders.map(|encode| {
            let keeps = |&(axis, sign, _): &(usize, f32, &str)| {
                // Whatever length it comes in.
                [1.0f32, 3.0, 1e-42, 1e30, f32::INFINITY].iter().all(|length| {
                    let along =
                        |length| core::array::from_fn(|i| if i == axis { length } else { 0.0 });
                    // Float32x3 gives back the length as well.
                    let whole = C::FORMAT == Format::Float32x3;
                    let expected: [f32; 3] = along(if whole { sign * length } else { sign });
                    C::decode(encode(along(sign * length))) == expected
                })
            };
            AXES.iter().filter(|axis| keeps(axis)).map(|axis| axis.2).collect()
        })
    }
}

#[test]
fn axes_survive_as_documented() {
    for &format in Format::ALL {
        let [fast, precise] = format.visit(Survivors);
        assert_eq!(fast, exact_axes(format.name()), "{format}");
        assert_eq!(precise, exact_axes(format.name()), "{format}, precise");
    }
}
