//! Dither raises no error and averages out; stochastic rounding has the right mean. Against `f64`.
//!
//! The functions of one vector are checked for all formats. The slices are compared with them for
//! one format of each family and width of code.

use unitpack::dither::{Dither, StochasticRounding};
use unitpack::*;
use unitpack_test::codes::{integer, native, natives, write_codes};
use unitpack_test::random::{Rng, mixed_vectors};
use unitpack_test::tasks::check_all;
use unitpack_test::vectors::{angle, bits, cross, dot, length, normalize, plus, scaled, widen};
use unitpack_test::{AnyCodec, Arrays, Code, Effort, Outcome, Vector, representatives};

/// What `f32` may add to an angle, in radians.
const ROUNDING: f64 = 1e-6;

/// The rotation of an element, as the module's page has it.
fn rotated(format: Format, seed: u32, index: u32, v: [f64; 3], back: bool) -> [f64; 3] {
    let start = seed.wrapping_mul(0x9E37_79B9).wrapping_add(index);
    let g: f64 = 1.220_744_084_605_759_5;
    let reach = (2.0 * format.max_error_precise_degrees().to_radians()).min(0.5);
    let mut u: [f64; 3] = core::array::from_fn(|i| {
        let step = (2f64.powi(32) / g.powi(i as i32 + 1)).round() as u32;
        f64::from(start.wrapping_mul(step) as i32) / 2f64.powi(31) * reach / 2.0
    });
    if format.is_hemisphere() {
        (u[0], u[1]) = (0.0, 0.0);
    }
    // By an angle around an axis, Rodrigues's formula.
    let angle = 2.0 * length(u).atan() * if back { -1.0 } else { 1.0 };
    let axis = if length(u) == 0.0 { [0.0, 0.0, 1.0] } else { normalize(u) };
    let (sin, cos) = angle.sin_cos();
    let (aside, along) = (cross(axis, v), dot(axis, v));
    core::array::from_fn(|i| v[i] * cos + aside[i] * sin + axis[i] * along * (1.0 - cos))
}

/// The functions of one vector with dither: what a [`Dither`] does for an element and a vector or
/// code.
struct Dithered {
    format: Format,
    encode: fn(Dither, u32, Vector) -> Code,
    encode_precise: fn(Dither, u32, Vector) -> Code,
    decode: fn(Dither, u32, Code) -> Vector,
}

impl Dithered {
    fn of(format: Format) -> Self {
        format.visit(Erase)
    }
}

struct Erase;

impl Visitor for Erase {
    type Output = Dithered;
    fn visit<C: Codec>(self) -> Dithered {
        Dithered {
            format: C::FORMAT,
            encode: encode::<C>,
            encode_precise: encode_precise::<C>,
            decode: decode::<C>,
        }
    }
}

fn encode<C: Codec>(dither: Dither, index: u32, v: Vector) -> Code {
    integer(dither.encode::<C>(index, v))
}

fn encode_precise<C: Codec>(dither: Dither, index: u32, v: Vector) -> Code {
    integer(dither.encode_precise::<C>(index, v))
}

fn decode<C: Codec>(dither: Dither, index: u32, code: Code) -> Vector {
    dither.decode::<C>(index, native(code))
}

fn check_formats(
    formats: impl Fn(Format) -> bool,
    check: impl Fn(&Dithered, &AnyCodec) -> Result<(), String> + Sync,
) {
    let formats: Vec<Format> = Format::ALL.iter().copied().filter(|&f| formats(f)).collect();
    check_all(&formats, |&format| check(&Dithered::of(format), AnyCodec::of(format)));
}

fn is_coarse(format: Format) -> bool {
    format.bits() <= 24 && format.bits() >= 8
}

fn error_is_no_greater(dithered: &Dithered, codec: &AnyCodec) -> Result<(), String> {
    let format = dithered.format;
    let dither = Dither::new(3);
    let mut rng = Rng::new(1);
    let count = if format.bits() <= 32 { 4000 } else { 200 };
    let mut sums = [0.0; 4];
    for i in 0..count {
        let mut v = if i % 2 == 0 { rng.direction() } else { rng.edge() };
        if v.iter().any(|c| !c.is_finite()) || !length(widen(v)).is_normal() {
            continue;
        }
        if format.is_hemisphere() {
            v[2] = v[2].abs();
        }
        let index = rng.bits() as u32;
        let target = widen(v);
        let off = |decoded: Vector| angle(target, widen(decoded));
        let [fast, precise] = [dithered.encode, dithered.encode_precise]
            .map(|encode| off((dithered.decode)(dither, index, encode(dither, index, v))));
        let most = [format.max_error_degrees(), format.max_error_precise_degrees()];
        for (off, most) in [fast, precise].into_iter().zip(most) {
            if off > most.to_radians() + ROUNDING {
                return Err(format!("{format}: {v:?} at {index} is off by {off}"));
            }
        }
        if i % 2 == 0 {
            let [plain, plain_precise] =
                Effort::BOTH.map(|effort| off((codec.decode)(codec.encode_with(effort, v))));
            for (sum, off) in sums.iter_mut().zip([plain, fast, plain_precise, precise]) {
                *sum += off;
            }
        }
    }
    // The mean over all directions stays too. Where a few directions are far worse than most,
    // chance has more to say.
    let [plain, fast, plain_precise, precise] = sums;
    let apart = |a: f64, b: f64| (a - b).abs() > 0.06 * a.max(b) + f64::from(count) * ROUNDING;
    if is_coarse(format) && (apart(plain, fast) || apart(plain_precise, precise)) {
        return Err(format!("{format}: sums of errors, in turn without and with: {sums:?}"));
    }
    Ok(())
}

#[test]
fn the_error_is_no_greater() {
    check_formats(|f| f != Format::Float32x3, error_is_no_greater);
}

fn rotation_is_the_stated(dithered: &Dithered, codec: &AnyCodec) -> Result<(), String> {
    let format = dithered.format;
    let mut rng = Rng::new(2);
    for i in 0..300 {
        let (seed, index) = (rng.bits() as u32, rng.bits() as u32);
        let dither = Dither::new(seed);
        let code = (codec.encode)(rng.direction());
        let v = widen((codec.decode)(code));
        let back = rotated(format, seed, index, v, true);
        let decoded = widen((dithered.decode)(dither, index, code));
        let off = angle(back, decoded);
        if off > ROUNDING || (length(decoded) - 1.0).abs() > 2.5e-7 {
            return Err(format!("{format}: {code:#x} at {index}, {seed}: {off:e}"));
        }
        // What lies on a point once turned is encoded as that.
        if format.bits() <= 24 && i < 100 {
            let v = back.map(|c| c as f32);
            if (dithered.encode_precise)(dither, index, v) != (codec.canonical)(code) {
                return Err(format!("{format}: {v:?} at {index} is not {code:#x}"));
            }
        }
    }
    Ok(())
}

#[test]
fn rotations_are_the_stated_ones() {
    check_formats(|f| !f.is_hemisphere(), rotation_is_the_stated);
}

/// Of one direction, the mean over neighbours.
fn error_averages_out(dithered: &Dithered, codec: &AnyCodec) -> Result<(), String> {
    let mut rng = Rng::new(4);
    let dither = Dither::new(0);
    let (mut plain, mut mean) = (0.0, 0.0);
    let count = 1024;
    for _ in 0..40 {
        let v = rng.direction();
        let target = widen(v);
        plain += angle(target, widen((codec.decode)((codec.encode_precise)(v)))) / 40.0;
        let mut sum = [0.0; 3];
        for i in 0..count {
            let code = (dithered.encode_precise)(dither, i, v);
            sum = plus(sum, widen((dithered.decode)(dither, i, code)));
        }
        mean += angle(target, sum) / 40.0;
    }
    let format = dithered.format;
    eprintln!("{format}: {:.4} of {plain:.4}", mean / plain);
    if mean < 0.08 * plain { Ok(()) } else { Err(format!("{format}: {mean} {plain}")) }
}

#[test]
fn errors_average_out() {
    let few =
        ["oct12", "oct16", "warpedoct16", "spherical16", "fibonacci16", "cube16", "latlong16D"];
    check_formats(|f| few.contains(&f.name()), error_averages_out);
}

/// The functions of slices, for one format of each family and width of code.
struct DitheredSlices {
    encode: fn(Effort, Dither, u32, Soa<'_>, &mut [Code]) -> Outcome,
    decode: fn(Dither, u32, &[Code], SoaMut<'_>) -> Outcome,
}

struct EraseSlices;

impl Visitor for EraseSlices {
    type Output = DitheredSlices;
    fn visit<C: Codec>(self) -> DitheredSlices {
        DitheredSlices { encode: encode_soa::<C>, decode: decode_soa::<C> }
    }
}

fn encode_soa<C: Codec>(
    effort: Effort,
    dither: Dither,
    first: u32,
    v: Soa<'_>,
    codes: &mut [Code],
) -> Outcome {
    write_codes(codes, &mut |codes| match effort {
        Effort::Fast => dither.encode_soa::<C>(first, v, codes),
        Effort::Precise => dither.encode_soa_precise::<C>(first, v, codes),
    })
}

fn decode_soa<C: Codec>(dither: Dither, first: u32, codes: &[Code], v: SoaMut<'_>) -> Outcome {
    dither.decode_soa::<C>(first, &natives(codes), v)
}

fn slices_give_the_same(format: Format) -> Result<(), String> {
    let slices = representatives::visit(format, EraseSlices).expect("it is one of them");
    let dithered = Dithered::of(format);
    let vectors = mixed_vectors(5, 700);
    let vectors = &vectors[vectors.len() - 700..];
    let arrays = Arrays::from(vectors);
    let (dither, first) = (Dither::new(77), u32::MAX - 300);
    let index = |i: usize| first.wrapping_add(i as u32);
    for (effort, encode) in
        [(Effort::Fast, dithered.encode), (Effort::Precise, dithered.encode_precise)]
    {
        if effort == Effort::Precise && format.bits() > 16 {
            continue;
        }
        let mut codes = vec![0; 700];
        (slices.encode)(effort, dither, first, arrays.read(), &mut codes).unwrap();
        let mut decoded = Arrays::unwritten([700; 3]);
        (slices.decode)(dither, first, &codes, decoded.write()).unwrap();
        for (i, (&v, decoded)) in vectors.iter().zip(decoded.bits()).enumerate() {
            let single = bits((dithered.decode)(dither, index(i), codes[i]));
            if encode(dither, index(i), v) != codes[i] || single != decoded {
                return Err(format!("{format} {effort:?}: {v:?} at {}", index(i)));
            }
        }
    }
    Ok(())
}

#[test]
fn batches_give_the_same() {
    let formats: Vec<Format> = representatives::all().collect();
    check_all(&formats, |&format| slices_give_the_same(format));
}

/// How often each code came, and the mean of the decoded vectors.
fn of_many<C: StochasticRounding>(v: [f32; 3], count: u32) -> (Vec<(C::Code, u32)>, [f64; 3]) {
    let dither = Dither::new(9);
    let (mut codes, mut sum) = (Vec::<(C::Code, u32)>::new(), [0.0; 3]);
    for i in 0..count {
        let code = dither.encode_stochastic::<C>(i, v);
        match codes.iter_mut().find(|(known, _)| *known == code) {
            Some((_, times)) => *times += 1,
            None => codes.push((code, 1)),
        }
        sum = plus(sum, scaled(widen(C::decode(code)), 1.0 / f64::from(count)));
    }
    (codes, sum)
}

fn mean_is_right<C: StochasticRounding>() {
    let mut rng = Rng::new(10);
    let count = 20_000;
    let (mut precise, mut mean) = (0.0, 0.0);
    for i in 0..40 {
        let v = if i % 2 == 0 { rng.direction() } else { rng.edge() };
        let target = widen(v);
        if !length(target).is_normal() {
            continue;
        }
        let (codes, sum) = of_many::<C>(v, count);
        assert!(codes.len() <= 3, "{}: {v:?} has {} codes", C::FORMAT, codes.len());
        let most = codes.iter().map(|&(code, _)| angle(target, widen(C::decode(code))));
        let most = most.fold(0.0, f64::max);
        let limit = 2.0 * C::FORMAT.max_error_precise_degrees().to_radians() + ROUNDING;
        assert!(most <= limit, "{}: {v:?}, {most}", C::FORMAT);
        // Five standard deviations of a mean of such errors.
        let off = angle(target, sum);
        let chance = 5.0 * most / f64::from(count).sqrt() + ROUNDING;
        assert!(
            off <= chance,
            "{}: the mean of {v:?} is off by {off:e}, not {chance:e}",
            C::FORMAT
        );
        precise += angle(target, widen(C::decode(C::encode_precise(v))));
        mean += off;
        // The probabilities, by solving for the vector in f64.
        if let [(a, times_a), (b, times_b), (c, times_c)] = codes[..] {
            let [p, q, r] = [a, b, c].map(|code| widen(C::decode(code)));
            let volumes =
                [dot(target, cross(q, r)), dot(target, cross(r, p)), dot(target, cross(p, q))];
            let all: f64 = volumes.iter().sum();
            for (volume, times) in volumes.into_iter().zip([times_a, times_b, times_c]) {
                let expected = volume / all;
                let got = f64::from(times) / f64::from(count);
                let sigma = (expected * (1.0 - expected) / f64::from(count)).max(0.0).sqrt();
                assert!(
                    (got - expected).abs() <= 5.0 * sigma + 0.004,
                    "{}: {v:?}: {got} {expected}",
                    C::FORMAT
                );
            }
        }
    }
    assert!(mean < 0.1 * precise, "{}: {mean} {precise}", C::FORMAT);
}

fn points_are_kept<C: StochasticRounding>() {
    let mut rng = Rng::new(11);
    let axes = [
        [1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
        [0.0; 3],
        [f32::NAN; 3],
    ];
    for v in axes {
        let (codes, _) = of_many::<C>(v, 100);
        assert_eq!(codes, [(C::encode(v), 100)], "{}: {v:?}", C::FORMAT);
    }
    if C::FORMAT.bits() <= 16 {
        for _ in 0..200 {
            let code = C::encode(rng.direction());
            let (codes, _) = of_many::<C>(C::decode(code), 100);
            let times = codes.iter().find(|(c, _)| *c == code).map_or(0, |c| c.1);
            assert!(times >= 98, "{}: {code:?} {codes:?}", C::FORMAT);
        }
    }
}

fn stochastic_batches<C: StochasticRounding>() {
    let vectors = mixed_vectors(12, 10_000);
    let arrays = Arrays::from(&vectors[..]);
    let mut codes = vec![bytemuck::Zeroable::zeroed(); vectors.len()];
    let (dither, first) = (Dither::new(13), u32::MAX - 4000);
    dither.encode_soa_stochastic::<C>(first, arrays.read(), &mut codes).unwrap();
    for (i, &v) in vectors.iter().enumerate() {
        let code = dither.encode_stochastic::<C>(first.wrapping_add(i as u32), v);
        assert_eq!(code, codes[i], "{}: {v:?}", C::FORMAT);
        assert!(C::is_canonical(code), "{}: {v:?} is {code:?}", C::FORMAT);
    }
}

#[test]
fn stochastic_rounding_has_the_right_mean() {
    macro_rules! check {
        ($codec:ident) => {
            mean_is_right::<$codec>();
            points_are_kept::<$codec>();
            stochastic_batches::<$codec>();
        };
    }
    for_each_codec!(stochastic: check);
}

#[test]
fn lengths_are_checked() {
    let [mut x, mut y, mut z] = [[7.0; 3], [7.0; 3], [7.0; 3]];
    let (dither, mut codes) = (Dither::new(0), [9; 2]);
    let error = Err(LengthMismatch::Soa { x: 3, y: 3, z: 3, codes: 2 });
    let v = Soa { x: &x, y: &y, z: &z };
    assert_eq!(dither.encode_soa::<Oct16>(0, v, &mut codes), error);
    assert_eq!(dither.encode_soa_precise::<Oct16>(0, v, &mut codes), error);
    assert_eq!(dither.encode_soa_stochastic::<Oct16>(0, v, &mut codes), error);
    assert_eq!(codes, [9; 2]);
    let v = SoaMut { x: &mut x, y: &mut y, z: &mut z };
    assert_eq!(dither.decode_soa::<Oct16>(0, &codes, v), error);
    assert_eq!([x, y, z], [[7.0; 3]; 3]);
}
