//! Every codec beside a loop over its function for one vector.

use std::cell::RefCell;
use std::time::Duration;

use unitpack::{Codec, Format, LengthMismatch, Soa, Visitor};
use unitpack_test::Arrays;

use crate::Data;
use crate::timing::{Contest, timed};

/// How many vectors are encoded precisely, which some codecs take long for.
const PRECISE: usize = 256;
/// For how long each pair takes turns.
const TIME: Duration = Duration::from_millis(20);

pub fn print(len: usize) {
    println!(
        "ns a vector in batches of {len} (precise: {PRECISE}), and how many times as long a loop over single vectors takes\n"
    );
    println!("| | decode | loop | encode | loop | precise | loop |\n|---|--:|--:|--:|--:|--:|--:|");
    let (data, few) = (Data::new(len), Data::new(PRECISE));
    for format in Format::ALL {
        let [decode, encode, precise] = format.visit(Row { data: &data, few: &few });
        let cell = |[batch, single]: [f64; 2]| format!("{batch:.2} | {:.1}", single / batch);
        println!("| {format} | {} | {} | {} |", cell(decode), cell(encode), cell(precise));
    }
}

struct Row<'a> {
    data: &'a Data,
    few: &'a Data,
}

pub type Encode<C> = fn(Soa<'_>, &mut [Code<C>]) -> Result<(), LengthMismatch>;
pub type Code<C> = <C as Codec>::Code;

impl Visitor for Row<'_> {
    type Output = [[f64; 2]; 3];

    fn visit<C: Codec>(self) -> Self::Output {
        [
            decode::<C>(self.data),
            encode::<C>(self.data, C::encode_soa, C::encode),
            encode::<C>(self.few, C::encode_soa_precise, C::encode_precise),
        ]
    }
}

fn decode<C: Codec>(data: &Data) -> [f64; 2] {
    let codes = data.codes::<C>();
    let contest = Contest::new("decode", data.len(), "batch")
        .add("batch", || {
            timed(|| C::decode_soa(&codes, data.out.borrow_mut().soa.write()).unwrap())
        })
        .add("loop", || {
            timed(|| {
                let Arrays { x, y, z } = &mut data.out.borrow_mut().soa;
                for (((x, y), z), &code) in x.iter_mut().zip(y).zip(z).zip(&codes) {
                    [*x, *y, *z] = C::decode(code);
                }
            })
        });
    best(contest)
}

fn encode<C: Codec>(data: &Data, batch: Encode<C>, single: fn([f32; 3]) -> Code<C>) -> [f64; 2] {
    let codes = RefCell::new(data.zeroed::<C>());
    let contest = Contest::new("encode", data.len(), "batch")
        .add("batch", || timed(|| batch(data.soa(), &mut codes.borrow_mut()).unwrap()))
        .add("loop", || {
            timed(|| {
                for (code, &v) in codes.borrow_mut().iter_mut().zip(&data.input.aos) {
                    *code = single(v);
                }
            })
        });
    best(contest)
}

fn best(contest: Contest<'_>) -> [f64; 2] {
    let times = contest.times("", TIME);
    [times.rows[0].1, times.rows[1].1]
}
