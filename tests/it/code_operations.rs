//! Operations on codes: what decoding, doing it to the vector and encoding gives, and what the
//! oracle says of it.
//!
//! Each operation is checked alone for all formats, and over slices for one format of each family
//! and width of code.

use unitpack::{Axis, Codec, Format};
use unitpack_test::codes::random_codes;
use unitpack_test::every_code::{BLOCK, check_operations};
use unitpack_test::oracle::oracle;
use unitpack_test::tasks::check_all;
use unitpack_test::vectors::angle;
use unitpack_test::{AnyCodec, Code};

const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

/// Of formats of 17 to 24 bits, one code in so many, which no field's size is a multiple of.
const EVERY: u128 = 61;

#[test]
fn every_code_of_up_to_16_bits() {
    let chunks = |format: Format| {
        let codes = 1 << format.bits();
        (0..codes)
            .step_by(BLOCK as usize)
            .map(move |at| (format, at..codes.min(at + BLOCK as u128)))
    };
    let few = Format::ALL.iter().copied().filter(|f| f.bits() <= 16);
    let tasks: Vec<_> = few.flat_map(chunks).collect();
    check_all(&tasks, |(format, codes)| {
        check_operations(*format, &codes.clone().collect::<Vec<_>>())
    });
}

#[test]
fn codes_all_over_formats_of_up_to_24_bits() {
    let chunks = |format: Format| {
        let chunk = EVERY * BLOCK as u128;
        let codes = 1 << format.bits();
        (0..codes).step_by(chunk as usize).map(move |at| (format, at..codes.min(at + chunk)))
    };
    let some = Format::ALL.iter().copied().filter(|f| (17..=24).contains(&f.bits()));
    let tasks: Vec<_> = some.flat_map(chunks).collect();
    check_all(&tasks, |(format, codes)| {
        check_operations(*format, &codes.clone().step_by(EVERY as usize).collect::<Vec<_>>())
    });
}

/// Any bit patterns, those of unused bits among them.
#[test]
fn random_codes_of_all_formats() {
    let tasks: Vec<_> =
        (0..3).flat_map(|seed| Format::ALL.iter().map(move |&f| (f, seed))).collect();
    check_all(&tasks, |&(format, seed)| {
        // Where lengths are searched, encoding is slow.
        let count = if AnyCodec::of(format).is_finer_than_f32() { 101 } else { 5_003 };
        check_operations(format, &random_codes(format, seed, count))
    });
}

/// Whether the format's page lists the axis among those in which all mirror images are points.
fn is_exact(format: Format, axis: Axis) -> bool {
    format.exact_mirrors().split(' ').any(|listed| listed == format!("{axis:?}"))
}

/// The direction of a vector mirrored in one axis, at the rim if a hemisphere's falls below it.
fn mirrored(format: Format, mut v: [f64; 3], axis: Axis) -> [f64; 3] {
    v[axis as usize] = -v[axis as usize];
    if format.is_hemisphere() && v[2] < 0.0 {
        // Below the rim; the pole has no image there but itself.
        v[2] = if v[0] == 0.0 && v[1] == 0.0 { 1.0 } else { 0.0 };
    }
    v
}

/// Of every format that is small enough to look at all codes.
#[test]
fn axes_that_are_not_listed_have_images_that_are_no_points() {
    let small = Format::ALL.iter().copied().filter(|f| f.bits() <= 16);
    let tasks: Vec<_> = small.flat_map(|format| AXES.map(|axis| (format, axis))).collect();
    check_all(&tasks, |&(format, axis)| {
        let oracle = oracle(format.name());
        let codec = AnyCodec::of(format);
        let is_off = |code| {
            let image = oracle.decode((codec.mirror)(code, axis));
            angle(image, mirrored(format, oracle.decode(code), axis)) > 1e-6
        };
        let off = (0..1 << format.bits()).find(|&code| is_off(code));
        match (is_exact(format, axis), off) {
            (true, None) | (false, Some(_)) => Ok(()),
            (true, Some(code)) => {
                Err(format!("{format} in {axis:?}: {code:#x} has no exact image"))
            }
            (false, None) => Err(format!("{format}: all images in {axis:?} are exact")),
        }
    });
}

/// What a code becomes: canonical, negated, mirrored in each axis in turn, and mirrored once and
/// twice in each axis.
struct Images {
    canonical: Code,
    negated: Code,
    in_turn: Code,
    once: [Code; 3],
    twice: [Code; 3],
}

impl Images {
    fn of(codec: &AnyCodec, code: Code) -> Self {
        let mirror = codec.mirror;
        let once = AXES.map(|axis| mirror(code, axis));
        Images {
            canonical: (codec.canonical)(code),
            negated: (codec.negate)(code),
            in_turn: AXES.into_iter().fold(code, mirror),
            once,
            twice: [0, 1, 2].map(|i| mirror(once[i], AXES[i])),
        }
    }
}

/// An image is in the exact direction, to what `f32` rounds off, if there is such a point, else the
/// nearest to it.
#[test]
fn images_are_where_the_oracle_has_them() {
    let formats: Vec<_> = Format::ALL.iter().copied().filter(|&f| f != Format::Float32x3).collect();
    check_all(&formats, |&format| {
        let oracle = oracle(format.name());
        let codec = AnyCodec::of(format);
        let finer = codec.is_finer_than_f32();
        let codes = random_codes(format, 77, if finer { 301 } else { 3_001 });
        let nearest = format.max_error_precise_degrees().to_radians();
        for &code in &codes {
            let images = Images::of(codec, code);
            let v = oracle.decode(code);
            for (i, axis) in AXES.into_iter().enumerate() {
                let target = mirrored(format, v, axis);
                let image = oracle.decode(images.once[i]);
                let bound = if is_exact(format, axis) { 1e-6 } else { nearest + 1e-6 };
                let off = angle(image, target);
                if off > bound {
                    return Err(format!("{format}: {code:#x} in {axis:?} is {off:.2e} rad off"));
                }
                if is_exact(format, axis) && !finer && images.twice[i] != images.canonical {
                    let (twice, canonical) = (images.twice[i], images.canonical);
                    return Err(format!(
                        "{format}: {code:#x} twice is {twice:#x}, not {canonical:#x}"
                    ));
                }
            }
            let all_exact = AXES.into_iter().all(|axis| is_exact(format, axis));
            if all_exact && !finer && images.negated != images.in_turn {
                let (negated, in_turn) = (images.negated, images.in_turn);
                return Err(format!("{format}: {code:#x} is {negated:#x}, in turn {in_turn:#x}"));
            }
        }
        Ok(())
    });
}

/// That all others keep every code is checked where all codes are.
#[test]
fn formats_that_are_not_stable_have_codes_that_change() {
    let formats: Vec<_> = Format::ALL.iter().copied().filter(|f| !f.encode_is_stable()).collect();
    assert!(formats.len() > 20);
    check_all(&formats, |&format| {
        let codec = AnyCodec::of(format);
        let changes = random_codes(format, 5, 20_000).into_iter().any(|code| {
            let code = (codec.canonical)(code);
            (codec.encode)((codec.decode)(code)) != code
        });
        if changes { Ok(()) } else { Err(format!("{format}: encode keeps all of the codes")) }
    });
}

/// Signs are flipped, whatever they are signs of.
#[test]
fn floats_keep_all_other_bits() {
    use unitpack::Float32x3;
    let code = [0x7F80_0001, 0xFFFF_FFFF, 0x8000_0000];
    assert_eq!(Float32x3::negate(code), [0xFF80_0001, 0x7FFF_FFFF, 0]);
    assert_eq!(Float32x3::mirror(code, Axis::Y), [0x7F80_0001, 0x7FFF_FFFF, 0x8000_0000]);
    assert!(!Float32x3::same_direction([0; 3], [0, 0, 0x8000_0000]));
}
