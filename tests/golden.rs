//! The formats are frozen: one digest each for `encode`, `encode_precise` and `decode` over fixed
//! inputs.
//!
//! A failure prints the new table, ready to paste. A digest that was released and changes is a
//! change of the format: CHANGELOG names it as one.

use std::fmt::Write;

use crate::common::Rng;
use unitpack::{Format, Soa, SoaMut};

/// Of the inputs, so that a change to them is not taken for one to the formats: vectors, codes.
const INPUTS: [u64; 2] = [0x1F96_D4F6_3699_39F8, 0xA9DC_2D06_F422_E170];

/// Name; `encode`, `encode_precise`, `decode`.
#[rustfmt::skip]
const DIGESTS: &[(&str, [u64; 3])] = &[
    ("oct8", [0x794AF25E251035AE, 0x879698CDAE1FC4A6, 0x70EF1E1FAD998C67]),
    ("oct10", [0x6E2F00D36B9A453A, 0x64086EB93C97872E, 0x34C2A7C6FF4FB2D8]),
    ("oct12", [0x185C9F45E527E76E, 0x309235FE9A2BB072, 0x742B164595C3D6FE]),
    ("oct14", [0x0C77A38F1E585714, 0xEA1F12ECC4B13C65, 0xF4663314AE975A64]),
    ("oct16", [0xA9BEA91650B4A6C9, 0xC6CC74137381EFBF, 0xB9BF9917EFBE4993]),
    ("oct18", [0xB6CF9A4C0584E58D, 0x8C8CB84A7C79F779, 0x63A5DEED44708567]),
    ("oct20", [0x207F57ACBC317ACE, 0xF24BD63877CD18BD, 0x9CDD6FD02BC9CE3B]),
    ("oct22", [0x7512B09259F5095D, 0xF03C3A43DA12C14F, 0x230F447FDE9D8AA3]),
    ("oct24", [0xF56F13615F1E9151, 0x7E6777C7E1263141, 0xE95FC48DC46EA3F7]),
    ("oct26", [0x0E26D5E3E6E7914F, 0x10305DA9A5AF5D7A, 0x07CA140939963352]),
    ("oct28", [0x6694403628E4EC2A, 0xFF581AAC6565A7EC, 0x823436A0F2D5DCB5]),
    ("oct30", [0xDC5CBA783214A0BC, 0x46B58E30EE5F3855, 0x41D847406EBA638F]),
    ("oct32", [0x1EA5C2D18E625AA9, 0x2A4FB194ACA110C4, 0x93F9FF8BF3E4E496]),
    ("snorm5x3", [0x2332EAFEF75A0A77, 0xBAD483FA5F49FAEE, 0x7712798A2F730F55]),
    ("snorm8x3", [0xC211DDBE5F6338BC, 0xFF97293EA606D5FF, 0xAC965A8E86133669]),
    ("snorm10x3", [0xA3933CF39F46EEDD, 0xCF63D41DFC15BA84, 0xDCD9D57B5529BB65]),
    ("snorm11-11-10", [0xEEBBEF625C2E69FA, 0x907E152C9DBE4236, 0xE10714FD72BCDFBD]),
    ("snorm16x3", [0x98058037B5F87914, 0x521120D8C65519B4, 0xB96232B63ED04B5D]),
    ("float16x3", [0x7B93CE0CCE8CB5A7, 0x40A381E6CB360CD5, 0x22BCB931BC96EE08]),
    ("float32x3", [0x04A837D822DBE45C, 0x04A837D822DBE45C, 0x4C1B93A850BBCBC0]),
    ("spherical16", [0x0AAAA040BA52FFB7, 0x4F4EAE9E46A94650, 0xDBE6892E1A74BF88]),
    ("spherical20", [0x7F65A18BB0E2D992, 0xFFABC9F21115ED0F, 0x1BC3E1845B4A2B97]),
    ("spherical22", [0x8ED3897DF394B99B, 0xE6C2020A4B6C1AAB, 0xCBC5119D9C1BDCA1]),
    ("spherical24", [0x8F57AA5353DA40CC, 0xD2E1781849BEFB82, 0x01B40A2713EF8E58]),
    ("spherical32", [0xF0DB0FB335CC0B12, 0x851DD02639DFDF77, 0x26659C4839804C7E]),
    ("HemiOct16", [0xA1BA544BEF814BD0, 0x1948FC5FC6928922, 0xD0FA7C2EBC26971B]),
    ("HemiOct24", [0x9EE0377BF9129223, 0x49428CBC12148EF5, 0xF6139D5E8CC589C9]),
    ("HemiOct32", [0x36663B6BBAC110D3, 0x7302DDE901B1B155, 0x6DD54716991BB869]),
    ("XYOnly16", [0x4475E67424052EC5, 0x85B25A4D4C950929, 0x7E812C697DD6D9C2]),
    ("XYOnly24", [0xEFFEB588EFD121FF, 0x711533D5F49B1F59, 0x836F8B3210E10287]),
    ("XYOnly32", [0xC10B4FC03B13DA4D, 0x0A3AF948D003CB1C, 0x2C37AA80ADF1EF56]),
    ("XYOnly32F", [0x350CAAFC74E3400C, 0x33892FE46666237E, 0x197C0D2EE0E8C99C]),
];

/// FNV-1a, 64 bits.
fn digest(bytes: impl IntoIterator<Item = u8>) -> u64 {
    bytes.into_iter().fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3)
    })
}

/// Of the bits of floats. All NaN count as one, since moving them changes their bits on some
/// machines.
fn digest_floats<'a>(floats: impl IntoIterator<Item = &'a f32>) -> u64 {
    let bits = |c: &f32| if c.is_nan() { 0x7FC0_0000 } else { c.to_bits() };
    digest(floats.into_iter().flat_map(|c| bits(c).to_le_bytes()))
}

/// In [-1, 1), a multiple of 2^-23: exact, so the same on every machine.
fn signed(random: &mut Rng) -> f32 {
    (random.bits() >> 40) as f32 / 8_388_608.0 - 1.0
}

/// One component of all vectors after another. Made of exact operations only.
fn vectors() -> [Vec<f32>; 3] {
    let mut vectors = Vec::new();
    let mut random = Rng::new(1);

    // Axes, faces, diagonals, zeros of both signs, and what is no direction.
    let odd = [0.0, -0.0, 1.0, -1.0, 0.5, 1e-40, -1e-40, 3e38, f32::INFINITY, f32::NEG_INFINITY];
    for x in odd {
        for y in odd {
            vectors.extend(odd.map(|z| [x, y, z]));
        }
    }
    let nan = f32::from_bits(0x7FC0_0000);
    vectors.extend([[nan, 0.0, 1.0], [1.0, nan, f32::INFINITY], [nan, nan, nan]]);

    // Ties of a component, of two, and of both parameters of the octahedral square; and beside
    // them.
    for bits in 4..=16 {
        let steps = ((1 << bits) - 1) as f32;
        for _ in 0..24 {
            let mut tie = || ((signed(&mut random) * steps).floor() + 0.5) / steps;
            let (a, b) = (tie(), tie());
            let c = 1.0 - a.abs() - b.abs();
            let round = [a, b, (1.0 - a * a - b * b).max(0.0).sqrt()];
            let [x, y, z] = if c >= 0.0 {
                [a, b, c]
            } else {
                [(1.0 - b.abs()).copysign(a), (1.0 - a.abs()).copysign(b), c]
            };
            vectors.extend([[a, b, 1.0], round, [b, round[2], a], [x, y, z]]);
            vectors.extend([[x.next_up(), y, z], [x, y.next_down(), z], [x, y, -z]]);
        }
    }

    // Small, large and usual directions, and any bits.
    for scale in [1e-40, 1e-15, 1e15, 1e38] {
        vectors.extend((0..64).map(|_| [(); 3].map(|()| signed(&mut random) * scale)));
    }
    vectors.extend((0..3000).map(|_| [(); 3].map(|()| signed(&mut random))));
    vectors.extend((0..500).map(|_| {
        [(); 3]
            .map(|()| f32::from_bits(random.bits() as u32))
            .map(|c| if c.is_nan() { nan } else { c })
    }));
    [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect())
}

/// Bytes of codes: runs of one byte, then random ones. A multiple of every size of code up to 12
/// bytes.
fn codes() -> Vec<u8> {
    let mut random = Rng::new(2);
    let runs = (0..=255).flat_map(|byte| [byte; 24]);
    runs.chain((0..48_000).map(|_| (random.bits() >> 56) as u8)).collect()
}

fn encode(v: [&[f32]; 3], format: Format, precise: bool) -> u64 {
    // The search of these is slow: a part will do.
    let slow = precise && matches!(format, Format::Snorm16x3 | Format::Float16x3);
    let every = if slow { 16 } else { 1 };
    let [x, y, z] = v.map(|c| c.iter().copied().step_by(every).collect::<Vec<_>>());
    let v = Soa { x: &x, y: &y, z: &z };
    let mut bytes = vec![0; x.len() * format.code_size()];
    let encode = if precise { Format::encode_precise } else { Format::encode };
    encode(format, v, &mut bytes).unwrap();
    digest(bytes)
}

fn decode(codes: &[u8], format: Format) -> u64 {
    let [mut x, mut y, mut z] = [(); 3].map(|()| vec![0.0; codes.len() / format.code_size()]);
    format.decode(codes, SoaMut { x: &mut x, y: &mut y, z: &mut z }).unwrap();
    digest_floats(x.iter().chain(&y).chain(&z))
}

#[test]
fn digests_have_not_changed() {
    let (vectors, codes) = (vectors(), codes());
    let [x, y, z] = &vectors;
    let inputs = [digest_floats(x.iter().chain(y).chain(z)), digest(codes.iter().copied())];
    assert_eq!(inputs, INPUTS, "the inputs changed: {inputs:#018X?}");

    let got: Vec<_> = Format::ALL
        .iter()
        .map(|&format| {
            let encode = |precise| encode([x, y, z], format, precise);
            (format.name(), [encode(false), encode(true), decode(&codes, format)])
        })
        .collect();
    if got == DIGESTS {
        return;
    }

    let mut message = String::new();
    for (name, _) in DIGESTS.iter().filter(|(name, _)| Format::from_name(name).is_none()) {
        writeln!(message, "{name} is gone").unwrap();
    }
    for (name, digests) in &got {
        match DIGESTS.iter().find(|(pinned, _)| pinned == name) {
            None => writeln!(message, "{name} is new").unwrap(),
            Some((_, pinned)) => {
                let what = ["encode", "encode_precise", "decode"];
                for ((what, pinned), digest) in what.iter().zip(pinned).zip(digests) {
                    if pinned != digest {
                        writeln!(message, "{what} of {name} changed").unwrap();
                    }
                }
            }
        }
    }
    let mut table = String::new();
    for (name, [encode, precise, decode]) in got {
        writeln!(table, "    ({name:?}, [{encode:#018X}, {precise:#018X}, {decode:#018X}]),")
            .unwrap();
    }
    panic!(
        "A changed digest is a change of the format: name it in CHANGELOG.\n{message}\n\
         const DIGESTS: &[(&str, [u64; 3])] = &[\n{table}];"
    );
}

/// Values published with the algorithms.
#[test]
fn digest_and_generator_are_what_they_say() {
    assert_eq!(digest(*b"foobar"), 0x8594_4171_F739_67E8);
    assert_eq!(Rng::new(1_234_567).bits(), 6_457_827_717_110_365_317);
}
