//! Runs every codec's batches once, each inside a call of `measured`, whose instructions valgrind counts: see `run`.
//! Prints what each call was, in order.

use std::hint::black_box;

use bytemuck::Zeroable;
use unitpack::dither::{Dither, StochasticRounding};
use unitpack::frame::{FrameCodec, FrameSoa, FrameSoaMut, OctAngle32, OctAngle64, QTangent64};
use unitpack::quaternion::{
    QuaternionCodec, SmallestThree32, SmallestThree48, SmallestThree64, Soa4, Soa4Mut, TanThree32,
};
use unitpack::{Codec, Format, LengthMismatch, Oct16, Soa, SoaMut, SphericalFibonacci, Visitor};
use unitpack_test::Arrays;
use unitpack_test::vectors::golden_spiral;

/// Vectors in a batch: whole blocks, and a few more.
const LEN: usize = 512 + 5;
/// Those of a precise encoder, some of which are slow.
const FEW: usize = 32 + 5;

fn main() {
    let directions: Arrays = golden_spiral(LEN).collect();
    let v = directions.read();
    for format in Format::ALL {
        format.visit(Count(v));
    }
    frames::<OctAngle32>(v);
    frames::<OctAngle64>(v);
    frames::<QTangent64>(v);
    quaternions::<SmallestThree32>(v);
    quaternions::<SmallestThree48>(v);
    quaternions::<SmallestThree64>(v);
    quaternions::<TanThree32>(v);
    fibonacci(v);
    dither::<Oct16>(v);
}

struct Count<'a>(Soa<'a>);

impl Visitor for Count<'_> {
    type Output = ();

    fn visit<C: Codec>(self) {
        let Count(Soa { x, y, z }) = self;
        let mut codes = [C::encode([0.0, 0.0, 1.0]); LEN];
        let [mut to_x, mut to_y, mut to_z] = [[0.0; LEN]; 3];
        let name = C::FORMAT.name();
        count(name, "encode", LEN, &mut || C::encode_soa(Soa { x, y, z }, &mut codes));
        count(name, "decode", LEN, &mut || {
            C::decode_soa(&codes, SoaMut { x: &mut to_x, y: &mut to_y, z: &mut to_z })
        });
        count(name, "precise", FEW, &mut || {
            let few = Soa { x: &x[..FEW], y: &y[..FEW], z: &z[..FEW] };
            C::encode_soa_precise(few, &mut codes[..FEW])
        });
        black_box((codes, to_x, to_y, to_z));
    }
}

fn frames<C: FrameCodec>(normal: Soa<'_>) {
    // Any tangent will do.
    let tangent = Soa { x: normal.y, y: normal.z, z: normal.x };
    let frames = FrameSoa { normal, tangent, handedness: normal.x };
    let mut codes = [C::Code::zeroed(); LEN];
    count(C::NAME, "encode", LEN, &mut || C::encode_soa(frames, &mut codes).map(drop));
    let mut to = [[0.0; LEN]; 7];
    count(C::NAME, "decode", LEN, &mut || {
        let [x, y, z, tx, ty, tz, handedness] = &mut to;
        let (normal, tangent) = (SoaMut { x, y, z }, SoaMut { x: tx, y: ty, z: tz });
        C::decode_soa(&codes, FrameSoaMut { normal, tangent, handedness })
    });
    count(C::NAME, "precise", LEN, &mut || C::encode_soa_precise(frames, &mut codes).map(drop));
    black_box((codes, to));
}

fn quaternions<C: QuaternionCodec>(Soa { x, y, z }: Soa<'_>) {
    // No two equal components, which only some rotations have.
    let w: Vec<f32> = x.iter().rev().copied().collect();
    let q = Soa4 { x, y, z, w: &w };
    let mut codes = [C::Code::zeroed(); LEN];
    count(C::NAME, "encode", LEN, &mut || C::encode_soa(q, &mut codes));
    let mut to = [[0.0; LEN]; 4];
    count(C::NAME, "decode", LEN, &mut || {
        let [x, y, z, w] = &mut to;
        C::decode_soa(&codes, Soa4Mut { x, y, z, w })
    });
    count(C::NAME, "precise", LEN, &mut || C::encode_soa_precise(q, &mut codes));
    black_box((codes, to));
}

fn fibonacci(v: Soa<'_>) {
    let points = SphericalFibonacci::new(black_box(1_000_000)).unwrap();
    let mut indices = [0; LEN];
    count("fibonacci of any number", "encode", LEN, &mut || points.encode_soa(v, &mut indices));
    let [mut x, mut y, mut z] = [[0.0; LEN]; 3];
    count("fibonacci of any number", "decode", LEN, &mut || {
        points.decode_soa(&indices, SoaMut { x: &mut x, y: &mut y, z: &mut z })
    });
    black_box((indices, x, y, z));
}

fn dither<C: StochasticRounding>(v: Soa<'_>) {
    let dither = Dither::new(0);
    let mut codes = [C::Code::zeroed(); LEN];
    let name = format!("dithered {}", C::FORMAT);
    count(&name, "stochastic", LEN, &mut || dither.encode_soa_stochastic::<C>(0, v, &mut codes));
    count(&name, "encode", LEN, &mut || dither.encode_soa::<C>(0, v, &mut codes));
    let [mut x, mut y, mut z] = [[0.0; LEN]; 3];
    count(&name, "decode", LEN, &mut || {
        dither.decode_soa::<C>(0, &codes, SoaMut { x: &mut x, y: &mut y, z: &mut z })
    });
    black_box((codes, x, y, z));
}

fn count(name: &str, what: &str, len: usize, job: &mut dyn FnMut() -> Result<(), LengthMismatch>) {
    measured(job);
    println!("{name},{what},{len}");
}

/// What is counted; `run` knows it by this name.
#[unsafe(no_mangle)]
#[inline(never)]
fn measured(job: &mut dyn FnMut() -> Result<(), LengthMismatch>) {
    job().unwrap();
}
