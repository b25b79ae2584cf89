//! `unitpack` beside what else there is: meshoptimizer's filters, the scalar encoder of Bevy's meshlets, a plain loop,
//! `half`, and filling or copying the same memory. All contenders run in this process, in turns, and the best turn of
//! each counts; what is said are ratios.
//!
//! ```text
//! cargo run --release -p peers                        # oct16 and its peers, and the codecs beside oct
//! cargo run --release -p peers -- --codecs            # every codec beside a loop over its function for one vector
//! cargo run --release -p peers -- --picture oct16.svg # draws the first table as well
//! ```

mod codecs;
mod peers;
mod picture;
mod timing;

use std::cell::RefCell;
use std::error::Error;
use std::path::PathBuf;

use half::f16;
use half::slice::HalfFloatSliceExt;
use lexopt::prelude::*;
use timing::{Contest, timed};
use unitpack::{
    Codec, CrytekBfn24, EqAreaEllipse16, Float16x3, LatLong16D, LatLong32D, Oct16, Oct24, Oct32,
    Snorm8x3, Soa, Spherical16,
};
use unitpack_test::Arrays;
use unitpack_test::random::Rng;

/// Vectors that stay in the cache, and vectors that do not.
const PLACES: [(&str, usize); 2] =
    [("in cache, 16 Ki vectors", 16 << 10), ("from memory, 16 Mi vectors", 16 << 20)];

fn main() -> Result<(), Box<dyn Error>> {
    let mut picture: Option<PathBuf> = None;
    let mut all = false;
    let mut arguments = lexopt::Parser::from_env();
    while let Some(argument) = arguments.next()? {
        match argument {
            Long("picture") => picture = Some(arguments.value()?.into()),
            Long("codecs") => all = true,
            _ => return Err(argument.unexpected().into()),
        }
    }
    if all {
        codecs::print(PLACES[0].1);
        return Ok(());
    }
    let mut drawn = Vec::new();
    for (place, len) in PLACES {
        let data = Data::new(len);
        for contest in [oct16_decode(&data), oct16_encode(&data)] {
            drawn.push(contest.run(place));
        }
        halves(&data).run(place);
    }
    ratios(&Data::new(PLACES[0].1));
    if let Some(path) = picture {
        picture::draw(&path, &drawn)?;
    }
    Ok(())
}

/// Inputs, and memory for results.
struct Data {
    input: Vectors,
    out: RefCell<Vectors>,
}

/// The same directions in each layout.
#[derive(Clone)]
struct Vectors {
    soa: Arrays,
    aos: Vec<[f32; 3]>,
    padded: Vec<[f32; 4]>,
}

impl Data {
    /// Directions uniform on the sphere.
    fn new(len: usize) -> Self {
        let mut rng = Rng::new(1);
        let aos: Vec<[f32; 3]> = (0..len).map(|_| rng.direction()).collect();
        let soa = Arrays::from(&aos[..]);
        let padded: Vec<_> = aos.iter().map(|&[x, y, z]| [x, y, z, 0.0]).collect();
        // Written to, so that the first turn does not pay for the pages.
        let input = Vectors { soa, aos, padded };
        Data { out: RefCell::new(input.clone()), input }
    }

    fn len(&self) -> usize {
        self.input.aos.len()
    }

    fn soa(&self) -> Soa<'_> {
        self.input.soa.read()
    }

    fn codes<C: Codec>(&self) -> Vec<C::Code> {
        let mut codes = self.zeroed::<C>();
        C::encode_soa(self.soa(), &mut codes).unwrap();
        codes
    }

    fn zeroed<C: Codec>(&self) -> Vec<C::Code> {
        vec![C::encode([0.0, 0.0, 1.0]); self.len()]
    }
}

fn oct16_decode(data: &Data) -> Contest<'_> {
    let codes = std::rc::Rc::new(data.codes::<Oct16>());
    let with = |f: fn(&[u16], &mut Vectors)| {
        let codes = codes.clone();
        move || timed(|| f(&codes, &mut data.out.borrow_mut()))
    };
    let filter = peers::meshopt_codes(&data.input.padded);
    let mut in_place = filter.clone();
    Contest::new("decode oct16", data.len(), "unitpack, structure of arrays")
        .add(
            "fill the three arrays",
            with(|_, out| {
                out.soa.x.fill(1.0);
                out.soa.y.fill(1.0);
                out.soa.z.fill(1.0);
            }),
        )
        .add("copy three arrays", || {
            let out = &mut *data.out.borrow_mut();
            timed(|| {
                out.soa.x.copy_from_slice(&data.input.soa.x);
                out.soa.y.copy_from_slice(&data.input.soa.y);
                out.soa.z.copy_from_slice(&data.input.soa.z);
            })
        })
        .add(
            "unitpack, structure of arrays",
            with(|codes, out| Oct16::decode_soa(codes, out.soa.write()).unwrap()),
        )
        .add(
            "unitpack, [f32; 3]",
            with(|codes, out| Oct16::decode_aos(codes, &mut out.aos).unwrap()),
        )
        .add(
            "unitpack, [f32; 4]",
            with(|codes, out| Oct16::decode_aos(codes, &mut out.padded).unwrap()),
        )
        .add(
            "unitpack, one at a time",
            with(|codes, out| {
                for (v, &code) in out.aos.iter_mut().zip(codes) {
                    *v = Oct16::decode(code);
                }
            }),
        )
        .add(
            "a plain loop",
            with(|codes, out| {
                for (v, &code) in out.aos.iter_mut().zip(codes) {
                    *v = peers::plain_decode(code);
                }
            }),
        )
        .add("meshoptimizer, oct filter to snorm8", move || {
            in_place.copy_from_slice(&filter);
            timed(|| meshopt::decode_filter_oct(&mut in_place))
        })
}

fn oct16_encode(data: &Data) -> Contest<'_> {
    let codes = std::rc::Rc::new(RefCell::new(data.zeroed::<Oct16>()));
    let with = |f: fn(&Data, &mut [u16])| {
        let codes = codes.clone();
        move || timed(|| f(data, &mut codes.borrow_mut()))
    };
    Contest::new("encode oct16", data.len(), "unitpack, structure of arrays")
        .add(
            "unitpack, structure of arrays",
            with(|data, codes| Oct16::encode_soa(data.soa(), codes).unwrap()),
        )
        .add(
            "unitpack, [f32; 3]",
            with(|data, codes| Oct16::encode_aos(&data.input.aos, codes).unwrap()),
        )
        .add(
            "unitpack, [f32; 4]",
            with(|data, codes| Oct16::encode_aos(&data.input.padded, codes).unwrap()),
        )
        .add(
            "unitpack, precise",
            with(|data, codes| Oct16::encode_soa_precise(data.soa(), codes).unwrap()),
        )
        .add(
            "unitpack, one at a time",
            with(|data, codes| {
                for (code, &v) in codes.iter_mut().zip(&data.input.aos) {
                    *code = Oct16::encode(v);
                }
            }),
        )
        .add(
            "as in Bevy's meshlets",
            with(|data, codes| {
                for (code, &v) in codes.iter_mut().zip(&data.input.aos) {
                    *code = peers::bevy_encode(v);
                }
            }),
        )
        .add("meshoptimizer, oct filter", || timed(|| peers::meshopt_codes(&data.input.padded)))
}

fn halves(data: &Data) -> Contest<'_> {
    let codes = RefCell::new(data.zeroed::<Float16x3>());
    let decoded = data.codes::<Float16x3>();
    let numbers = RefCell::new([0, 1, 2].map(|_| vec![f16::ZERO; data.len()]));
    let converted = [&data.input.soa.x, &data.input.soa.y, &data.input.soa.z]
        .map(|c| c.iter().map(|&c| f16::from_f32(c)).collect::<Vec<_>>());
    Contest::new("f16", data.len(), "unitpack, decode float16x3")
        .add("unitpack, encode float16x3", move || {
            timed(|| Float16x3::encode_soa(data.soa(), &mut codes.borrow_mut()).unwrap())
        })
        .add("half, three slices from f32", move || {
            timed(|| {
                for (to, from) in numbers.borrow_mut().iter_mut().zip([
                    &data.input.soa.x,
                    &data.input.soa.y,
                    &data.input.soa.z,
                ]) {
                    to.convert_from_f32_slice(from);
                }
            })
        })
        .add("unitpack, decode float16x3", move || {
            timed(|| Float16x3::decode_soa(&decoded, data.out.borrow_mut().soa.write()).unwrap())
        })
        .add("half, three slices to f32", move || {
            let out = &mut *data.out.borrow_mut();
            timed(|| {
                for (to, from) in
                    [&mut out.soa.x, &mut out.soa.y, &mut out.soa.z].into_iter().zip(&converted)
                {
                    from.convert_to_f32_slice(to);
                }
            })
        })
}

/// What other codecs cost beside oct of the same size.
fn ratios(data: &Data) {
    fn decode<'a, C: Codec>(contest: Contest<'a>, data: &'a Data) -> Contest<'a> {
        let codes = data.codes::<C>();
        contest.add(&format!("decode {}", C::FORMAT), move || {
            timed(|| C::decode_soa(&codes, data.out.borrow_mut().soa.write()).unwrap())
        })
    }
    fn encode<'a, C: Codec>(
        contest: Contest<'a>,
        data: &'a Data,
        what: &str,
        encode: codecs::Encode<C>,
    ) -> Contest<'a> {
        let mut codes = data.zeroed::<C>();
        contest.add(&format!("{what} {}", C::FORMAT), move || {
            timed(|| encode(data.soa(), &mut codes).unwrap())
        })
    }
    let place = PLACES[0].0;
    let new = |title, of| Contest::new(title, data.len(), of);
    let contest = decode::<Oct16>(new("decode, 16 bits", "decode oct16"), data);
    let contest = decode::<Spherical16>(contest, data);
    let contest = decode::<LatLong16D>(contest, data);
    decode::<EqAreaEllipse16>(contest, data).run(place);
    let contest = decode::<Oct32>(new("decode, 32 bits", "decode oct32"), data);
    decode::<LatLong32D>(contest, data).run(place);
    let contest = new("encode, 24 bits", "encode oct24");
    let contest = encode::<Oct24>(contest, data, "encode", Oct24::encode_soa);
    let contest = encode::<Oct24>(contest, data, "precise", Oct24::encode_soa_precise);
    let contest = encode::<CrytekBfn24>(contest, data, "encode", CrytekBfn24::encode_soa);
    encode::<Snorm8x3>(contest, data, "precise", Snorm8x3::encode_soa_precise).run(place);
}
