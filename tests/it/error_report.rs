//! Error reports against plain `f64`, and the cheapest format against a search.

use unitpack::{Codec, ErrorReport, Format, LengthMismatch, Oct16, Soa, Visitor};

use unitpack_test::codes::natives;
use unitpack_test::oracle::oracle;
use unitpack_test::random::{mixed_vectors, special_vectors};
use unitpack_test::tasks::check_all;
use unitpack_test::vectors::{angle, widen};
use unitpack_test::{AnyCodec, Arrays, Code, Effort, Vector};

type Report = fn(&[Vector], &[Code]) -> ErrorReport;

/// [`ErrorReport::of`].
struct Erase;

impl Visitor for Erase {
    type Output = Report;
    fn visit<C: Codec>(self) -> Report {
        of::<C>
    }
}

fn of<C: Codec>(vectors: &[Vector], codes: &[Code]) -> ErrorReport {
    ErrorReport::of::<C>(Arrays::from(vectors).read(), &natives(codes)).unwrap()
}

/// Encodes vectors alone, and returns what they decode to and the report.
fn report(format: Format, effort: Effort, vectors: &[Vector]) -> (Vec<Vector>, ErrorReport) {
    let codec = AnyCodec::of(format);
    let codes = codec.encode_each(effort, vectors);
    (codec.decode_each(&codes), format.visit(Erase)(vectors, &codes))
}

fn agree(report: f64, exact: f64) -> bool {
    (report - exact).abs() <= 1e-6 * exact + 1e-13
}

#[test]
fn reports_agree_with_the_errors_one_by_one() {
    let all = mixed_vectors(9, special_vectors().len() + 1000);
    check_all(Format::ALL, |&format| {
        // What is 0, NaN or infinite stands for a direction, which the oracle of another format
        // knows.
        let sphere = oracle("oct16");
        for count in [0, 1, 63, 64, 65, 1000] {
            let vectors = &all[all.len() - count - 500..all.len() - 500];
            let precise = count % 2 == 0 && !AnyCodec::of(format).is_finer_than_f32();
            let effort = if precise { Effort::Precise } else { Effort::Fast };
            let (decoded, report) = report(format, effort, vectors);
            let error = |(v, w): (&[f32; 3], &[f32; 3])| {
                angle(sphere.target(*v), sphere.target(*w)).to_degrees()
            };
            let errors: Vec<f64> = vectors.iter().zip(&decoded).map(error).collect();
            let n = count.max(1) as f64;
            let mean = errors.iter().sum::<f64>() / n;
            let rms = (errors.iter().map(|e| e * e).sum::<f64>() / n).sqrt();
            let max = errors.iter().copied().fold(0.0, f64::max);
            let worst = errors.get(report.worst).copied().unwrap_or_default();
            let figures = [report.mean_degrees, report.rms_degrees, report.max_degrees, worst];
            let exact = [mean, rms, max, max];
            if report.count != count || !(0..4).all(|i| agree(figures[i], exact[i])) {
                return Err(format!("{format}: {report:?}, worst {worst}, but {exact:?}"));
            }
        }
        Ok(())
    });
}

#[test]
fn reports_take_any_input() {
    let vectors = special_vectors();
    let (decoded, precise) = report(Format::Oct32, Effort::Precise, &vectors);
    let sphere = oracle("oct32");
    let errors = vectors.iter().zip(decoded).map(|(v, w)| angle(sphere.target(*v), widen(w)));
    let max = errors.fold(0.0, f64::max).to_degrees();
    assert!(agree(precise.max_degrees, max), "{precise:?}, but {max}");
    // The opposite direction, and a hemisphere's codec below its rim.
    let (_, below) = report(Format::HemiOct16, Effort::Fast, &[[0.0, 0.0, -1.0]]);
    assert_eq!(below.max_degrees, 180.0);
    let (x, code) = ([1.0], Oct16::encode([-1.0, 0.0, 0.0]));
    let opposite = ErrorReport::of::<Oct16>(Soa { x: &x, y: &[0.0], z: &[0.0] }, &[code]).unwrap();
    assert_eq!((opposite.mean_degrees, opposite.max_degrees), (180.0, 180.0));
}

#[test]
fn reports_need_equal_lengths() {
    let short = Soa { x: &[1.0, 0.0], y: &[0.0], z: &[0.0, 1.0] };
    let error = LengthMismatch::Soa { x: 2, y: 1, z: 2, codes: 3 };
    assert_eq!(ErrorReport::of::<Oct16>(short, &[0; 3]), Err(error));
}

#[test]
fn the_cheapest_format_is_fine_enough_and_none_is_smaller() {
    let error = Format::max_error_precise_degrees;
    let sphere: Vec<_> = Format::ALL.iter().copied().filter(|f| !f.is_hemisphere()).collect();
    let bounds = sphere.iter().flat_map(|f| [error(*f), error(*f).next_down(), error(*f) * 1.1]);
    for bound in bounds.chain([180.0, f64::INFINITY]) {
        let fine: Vec<_> = sphere.iter().copied().filter(|f| error(*f) <= bound).collect();
        let Some(cheapest) = Format::cheapest(bound) else {
            assert!(fine.is_empty(), "{bound}");
            continue;
        };
        assert!(fine.contains(&cheapest), "{cheapest} at {bound}");
        for other in fine {
            let size = |f: Format| (f.code_size(), f.bits());
            let finer = size(other) == size(cheapest) && error(other) < error(cheapest);
            assert!(size(other) >= size(cheapest) && !finer, "{other} at {bound}");
        }
    }
    assert_eq!([-0.1, f64::NAN].map(Format::cheapest), [None; 2]);
}
