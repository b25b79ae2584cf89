//! Dither raises no error and averages out; stochastic rounding has the right mean. Against `f64`.

use crate::common::*;
use unitpack::dither::{Dither, StochasticRounding};
use unitpack::*;

/// What `f32` may add to an angle, in radians.
const ROUNDING: f64 = 1e-6;

fn normalize(v: [f64; 3]) -> [f64; 3] {
    let length = length(v);
    v.map(|c| c / length)
}

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

/// Runs a check for every format.
struct Each<F>(F);

trait Check: Sync {
    fn check<C: Codec>(&self) -> Result<(), String>;
}

impl<F: Check> Visitor for Each<&F> {
    type Output = Result<(), String>;
    fn visit<C: Codec>(self) -> Self::Output {
        self.0.check::<C>()
    }
}

fn check_formats(formats: impl Fn(Format) -> bool, check: impl Check) {
    let formats: Vec<Format> = Format::ALL.iter().copied().filter(|&f| formats(f)).collect();
    check_all(&formats, |format| format.visit(Each(&check)));
}

fn is_coarse(format: Format) -> bool {
    format.bits() <= 24 && format.bits() >= 8
}

struct ErrorIsNoGreater;

impl Check for ErrorIsNoGreater {
    fn check<C: Codec>(&self) -> Result<(), String> {
        let format = C::FORMAT;
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
            let off = |decoded: [f32; 3]| angle(target, widen(decoded));
            let fast = off(dither.decode::<C>(index, dither.encode::<C>(index, v)));
            let precise = off(dither.decode::<C>(index, dither.encode_precise::<C>(index, v)));
            let most = [format.max_error_degrees(), format.max_error_precise_degrees()];
            for (off, most) in [fast, precise].into_iter().zip(most) {
                if off > most.to_radians() + ROUNDING {
                    return Err(format!("{format}: {v:?} at {index} is off by {off}"));
                }
            }
            if i % 2 == 0 {
                let plain = [off(C::decode(C::encode(v))), off(C::decode(C::encode_precise(v)))];
                for (sum, off) in sums.iter_mut().zip([plain[0], fast, plain[1], precise]) {
                    *sum += off;
                }
            }
        }
        // The mean over all directions stays too. Where a few directions are far worse than most, chance has more to say.
        let [plain, fast, plain_precise, precise] = sums;
        let apart = |a: f64, b: f64| (a - b).abs() > 0.06 * a.max(b) + f64::from(count) * ROUNDING;
        if is_coarse(format) && (apart(plain, fast) || apart(plain_precise, precise)) {
            return Err(format!("{format}: sums of errors, in turn without and with: {sums:?}"));
        }
        Ok(())
    }
}

#[test]
fn the_error_is_no_greater() {
    check_formats(|f| f != Format::Float32x3, ErrorIsNoGreater);
}

struct RotationIsTheStated;

impl Check for RotationIsTheStated {
    fn check<C: Codec>(&self) -> Result<(), String> {
        let mut rng = Rng::new(2);
        for i in 0..300 {
            let (seed, index) = (rng.bits() as u32, rng.bits() as u32);
            let dither = Dither::new(seed);
            let code = C::encode(rng.direction());
            let v = widen(C::decode(code));
            let back = rotated(C::FORMAT, seed, index, v, true);
            let off = angle(back, widen(dither.decode::<C>(index, code)));
            let length = length(widen(dither.decode::<C>(index, code)));
            if off > ROUNDING || (length - 1.0).abs() > 2.5e-7 {
                return Err(format!("{}: {code:?} at {index}, {seed}: {off:e}", C::FORMAT));
            }
            // What lies on a point once turned is encoded as that.
            let v = back.map(|c| c as f32);
            let bits = C::FORMAT.bits();
            if bits <= 24 && i < 100 && dither.encode_precise::<C>(index, v) != C::canonical(code) {
                return Err(format!("{}: {v:?} at {index} is not {code:?}", C::FORMAT));
            }
        }
        Ok(())
    }
}

#[test]
fn rotations_are_the_stated_ones() {
    check_formats(|f| !f.is_hemisphere(), RotationIsTheStated);
}

/// Of one direction, the mean over neighbours.
struct ErrorAveragesOut;

impl Check for ErrorAveragesOut {
    fn check<C: Codec>(&self) -> Result<(), String> {
        let mut rng = Rng::new(4);
        let dither = Dither::new(0);
        let most = C::FORMAT.max_error_precise_degrees().to_radians();
        let (mut plain, mut dithered) = (0.0, 0.0);
        let count = 1024;
        for _ in 0..40 {
            let v = rng.direction();
            let target = widen(v);
            plain += angle(target, widen(C::decode(C::encode_precise(v)))) / 40.0;
            let mut sum = [0.0; 3];
            for i in 0..count {
                let decoded = dither.decode::<C>(i, dither.encode_precise::<C>(i, v));
                for (sum, c) in sum.iter_mut().zip(decoded) {
                    *sum += f64::from(c);
                }
            }
            dithered += angle(target, sum) / 40.0;
        }
        eprintln!("{}: {:.4} of {:.4}, {most:.4}", C::FORMAT, dithered / plain, plain);
        if dithered < 0.08 * plain {
            Ok(())
        } else {
            Err(format!("{}: {dithered} {plain}", C::FORMAT))
        }
    }
}

#[test]
fn errors_average_out() {
    let few =
        ["oct12", "oct16", "warpedoct16", "spherical16", "fibonacci16", "cube16", "latlong16D"];
    check_formats(|f| few.contains(&f.name()), ErrorAveragesOut);
}

struct BatchesGiveTheSame;

impl Check for BatchesGiveTheSame {
    fn check<C: Codec>(&self) -> Result<(), String> {
        let vectors = mixed_vectors(5, 700);
        let vectors = &vectors[vectors.len() - 700..];
        let [x, y, z] = [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect::<Vec<_>>());
        let v = Soa { x: &x, y: &y, z: &z };
        let (dither, first) = (Dither::new(77), u32::MAX - 300);
        let mut codes = vec![bytemuck::Zeroable::zeroed(); 700];
        dither.encode_soa::<C>(first, v, &mut codes).unwrap();
        let [mut a, mut b, mut c] = [0; 3].map(|_| vec![7.0; 700]);
        let to = SoaMut { x: &mut a, y: &mut b, z: &mut c };
        dither.decode_soa::<C>(first, &codes, to).unwrap();
        for (i, &v) in vectors.iter().enumerate() {
            let index = first.wrapping_add(i as u32);
            let single = dither.decode::<C>(index, codes[i]).map(f32::to_bits);
            let same = single == [a[i], b[i], c[i]].map(f32::to_bits);
            if dither.encode::<C>(index, v) != codes[i] || !same {
                return Err(format!("{}: {v:?} at {index}", C::FORMAT));
            }
        }
        if C::FORMAT.bits() <= 16 {
            dither.encode_soa_precise::<C>(first, v, &mut codes).unwrap();
            for (i, &v) in vectors.iter().enumerate() {
                let index = first.wrapping_add(i as u32);
                if dither.encode_precise::<C>(index, v) != codes[i] {
                    return Err(format!("{}: {v:?} at {index}, precise", C::FORMAT));
                }
            }
        }
        Ok(())
    }
}

#[test]
fn batches_give_the_same() {
    check_formats(|_| true, BatchesGiveTheSame);
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
        for (sum, c) in sum.iter_mut().zip(C::decode(code)) {
            *sum += f64::from(c) / f64::from(count);
        }
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
    let [x, y, z] = [0, 1, 2].map(|i| vectors.iter().map(|v| v[i]).collect::<Vec<_>>());
    let mut codes = vec![bytemuck::Zeroable::zeroed(); x.len()];
    let (dither, first) = (Dither::new(13), u32::MAX - 4000);
    dither.encode_soa_stochastic::<C>(first, Soa { x: &x, y: &y, z: &z }, &mut codes).unwrap();
    for (i, &v) in vectors.iter().enumerate() {
        let code = dither.encode_stochastic::<C>(first.wrapping_add(i as u32), v);
        assert_eq!(code, codes[i], "{}: {v:?}", C::FORMAT);
        assert!(C::is_canonical(code), "{}: {v:?} is {code:?}", C::FORMAT);
    }
}

macro_rules! each {
    ($($codec:ident)*) => {$({
        mean_is_right::<$codec>();
        points_are_kept::<$codec>();
        stochastic_batches::<$codec>();
    })*};
}

#[test]
fn stochastic_rounding_has_the_right_mean() {
    each!(Oct8 Oct10 Oct12 Oct16 Oct22 Oct24 Oct32 SixOct16 SixOct24 SixOct32);
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
