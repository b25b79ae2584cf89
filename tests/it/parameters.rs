//! Codes from two parameters and back, by their own reading of the bits.

use unitpack::{Format, Oct16, Oct24, Oct32, OctUnorm8x2, TwoParameters, XyOnly16};
use unitpack_test::AnyCodec;
use unitpack_test::random::Rng;

/// Formats whose parameters are unorm.
const UNORM: [&str; 8] = [
    "XYOnly16",
    "XYOnly24",
    "XYOnly32",
    "XYOnly-normalized16",
    "phi-z-unorm8x2",
    "phi-z-unorm16x2",
    "oct-unorm8x2",
    "oct-unorm16x2",
];

/// Two fields of a code. RGB8 has them in the order of the survey's listing.
fn fields(code: u32, bits: u32) -> [u32; 2] {
    if bits == 24 {
        let [r, g, b, _] = code.to_le_bytes().map(u32::from);
        [r << 4 | g >> 4, (g & 15) << 8 | b]
    } else {
        [code, code >> (bits / 2)].map(|field| (u64::from(field) & ((1 << (bits / 2)) - 1)) as u32)
    }
}

#[test]
fn parameters_are_the_fields_of_a_code() {
    let mut count = 0;
    for &format in Format::ALL {
        let bits = format.bits();
        if format.parameters(0).is_none() {
            assert_eq!(format.from_parameters([0, 0]), None);
            continue;
        }
        count += 1;
        let unorm = UNORM.contains(&format.name());
        let m = (1i64 << (bits / 2 - 1)) - 1;
        let mut rng = Rng::new(u64::from(bits));
        for i in 0..70_000u32 {
            let code = if bits <= 16 { i & ((1 << bits) - 1) } else { rng.bits() as u32 };
            let code = (u64::from(code) & ((1 << bits) - 1)) as u32;
            let expected = fields(code, bits).map(|field| {
                let field = i64::from(field);
                match (unorm, bits) {
                    (true, _) => field,
                    (false, 24) => (field - m).min(m),
                    _ => (if field > m { field - 2 * m - 2 } else { field }).max(-m),
                }
            });
            let parameters = format.parameters(code).unwrap();
            assert_eq!(parameters.map(i64::from), expected, "{format} {code:x}");
            // Back: the same code, or another pattern of the same vector.
            let again = format.from_parameters(parameters).unwrap();
            assert_eq!(format.parameters(again), Some(parameters), "{format} {code:x}");
            if i % 64 == 0 {
                let decode = AnyCodec::of(format).decode;
                assert_eq!(decode(again.into()), decode(code.into()), "{format} {code:x}");
            }
        }
        let (least, most) = if unorm { (0, 2 * m + 1) } else { (-m, m) };
        let ends = format.from_parameters([i32::MIN, i32::MAX]).unwrap();
        assert_eq!(format.parameters(ends).unwrap().map(i64::from), [least, most], "{format}");
    }
    assert_eq!(count, 91);
}

#[test]
fn types_have_what_formats_have() {
    fn check<C: TwoParameters>(range: (i32, i32)) {
        assert_eq!((*C::RANGE.start(), *C::RANGE.end()), range);
        let mut rng = Rng::new(1);
        for _ in 0..2000 {
            let parameters = [0; 2].map(|_| rng.bits() as i32 >> rng.below(31));
            let code = C::from_parameters(parameters);
            let integer = unitpack_test::codes::integer(code) as u32;
            assert_eq!(C::FORMAT.from_parameters(parameters), Some(integer));
            let clamped = parameters.map(|p| p.clamp(range.0, range.1));
            assert_eq!(C::parameters(code), clamped, "{}", C::FORMAT);
        }
    }
    check::<Oct16>((-127, 127));
    check::<Oct24>((-2047, 2047));
    check::<Oct32>((-32_767, 32_767));
    check::<OctUnorm8x2>((0, 255));
    check::<XyOnly16>((0, 255));
}
