//! What a `Format` says of its codec, and its names.

use unitpack::{Codec, Format, Oct16, Oct32, Soa};
use unitpack_test::codes::encode_slice;
use unitpack_test::{AnyCodec, Effort, Vector};

use super::buffers::SENTINEL;
use super::generators::CODE;

#[test]
fn formats_describe_their_codecs() {
    for &format in Format::ALL {
        let codec = AnyCodec::of(format);
        assert_eq!((codec.format, codec.code_size), (format, format.code_size()));
        assert!(format.code_size() <= CODE, "{format}: let CODE be the greatest size of a code");
        assert!((1..=8 * format.code_size()).contains(&(format.bits() as usize)), "{format}");
    }
}

#[test]
fn all_is_in_the_order_of_the_variants() {
    assert!(Format::ALL.is_sorted_by(|a, b| a < b));
    assert_eq!(Format::ALL.first(), Some(&Format::Oct8));
}

#[test]
fn names_are_read_back_in_any_case() {
    let alternating = |name: &str| -> String {
        let case = |(i, c): (usize, char)| {
            if i % 2 == 0 { c.to_ascii_uppercase() } else { c.to_ascii_lowercase() }
        };
        name.chars().enumerate().map(case).collect()
    };
    for &format in Format::ALL {
        let name = format.name();
        assert_eq!(format.to_string(), name);
        assert_eq!(format!("{format:>30}|{format:<30}"), format!("{name:>30}|{name:<30}"));
        for name in [
            name.to_owned(),
            name.to_ascii_lowercase(),
            name.to_ascii_uppercase(),
            alternating(name),
        ] {
            assert_eq!(name.parse(), Ok(format), "{name}");
            assert_eq!(Format::from_name(&name), Some(format), "{name}");
        }
    }
}

#[test]
fn unknown_names_are_refused() {
    // Full-width digits and the Kelvin sign have ASCII look-alikes.
    let mut unknown =
        ["", " ", "oct", "oct17", "16", "o\u{FF43}t16", "\u{212A}"].map(String::from).to_vec();
    for format in Format::ALL {
        let name = format.name();
        unknown.extend([
            format!(" {name}"),
            format!("{name} "),
            format!("{name}\0"),
            format!("{name}x"),
        ]);
    }
    for name in unknown {
        assert!(name.parse::<Format>().is_err(), "{name:?}");
        assert_eq!(Format::from_name(&name), None, "{name:?}");
    }
    let error = "nonsense".parse::<Format>().unwrap_err();
    let error: &dyn std::error::Error = &error;
    assert!(!error.to_string().is_empty());
}

/// Codes whose bytes the formats' definitions give, one for each kind of code.
#[test]
fn bytes_are_little_endian() {
    let bytes = |format: Format, [x, y, z]: Vector| {
        let mut bytes = vec![SENTINEL; format.code_size()];
        let v = Soa { x: &[x], y: &[y], z: &[z] };
        encode_slice(format, Effort::Fast, v, &mut bytes).unwrap();
        bytes
    };
    assert_eq!(bytes(Format::Oct8, [1.0, 0.0, 0.0]), [0x07]);
    assert_eq!(bytes(Format::Oct16, [1.0, 0.0, 0.0]), [0x7F, 0x00]);
    assert_eq!(bytes(Format::Oct24, [1.0, 0.0, 0.0]), [0xFF, 0xE7, 0xFF]);
    assert_eq!(bytes(Format::Oct32, [1.0, 0.0, 0.0]), [0xFF, 0x7F, 0x00, 0x00]);
    assert_eq!(bytes(Format::Snorm16x3, [0.0, 1.0, 0.0]), [0, 0, 0xFF, 0x7F, 0, 0]);
    assert_eq!(
        bytes(Format::Float32x3, [1.0, -2.0, 0.1]),
        [0, 0, 0x80, 0x3F, 0, 0, 0, 0xC0, 0xCD, 0xCC, 0xCC, 0x3D]
    );
    assert_eq!(Oct16::encode([0.0, 1.0, 0.0]), 0x7F00);
    assert_eq!(Oct32::encode([0.0, 1.0, 0.0]), 0x7FFF_0000);
}
