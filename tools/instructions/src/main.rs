//! Runs every codec's batches once, each inside a call of `measured`, whose instructions valgrind counts: see `run`.
//! Prints what each call was, in order.

use std::hint::black_box;

use unitpack::{Codec, Format, LengthMismatch, Soa, SoaMut, Visitor};

/// Vectors in a batch: whole blocks, and a few more.
const LEN: usize = 512 + 5;
/// Those of a precise encoder, some of which are slow.
const FEW: usize = 32 + 5;

fn main() {
    let [x, y, z] = directions();
    for format in Format::ALL {
        format.visit(Count { x: &x, y: &y, z: &z });
    }
}

struct Count<'a> {
    x: &'a [f32],
    y: &'a [f32],
    z: &'a [f32],
}

impl Visitor for Count<'_> {
    type Output = ();

    fn visit<C: Codec>(self) {
        let Count { x, y, z } = self;
        let mut codes = [C::encode([0.0, 0.0, 1.0]); LEN];
        let [mut to_x, mut to_y, mut to_z] = [[0.0; LEN]; 3];
        count::<C>("encode", LEN, &mut || C::encode_soa(Soa { x, y, z }, &mut codes));
        count::<C>("decode", LEN, &mut || {
            C::decode_soa(&codes, SoaMut { x: &mut to_x, y: &mut to_y, z: &mut to_z })
        });
        count::<C>("precise", FEW, &mut || {
            let few = Soa { x: &x[..FEW], y: &y[..FEW], z: &z[..FEW] };
            C::encode_soa_precise(few, &mut codes[..FEW])
        });
        black_box((codes, to_x, to_y, to_z));
    }
}

fn count<C: Codec>(what: &str, len: usize, job: &mut dyn FnMut() -> Result<(), LengthMismatch>) {
    measured(job);
    println!("{},{what},{len}", C::FORMAT);
}

/// What is counted; `run` knows it by this name.
#[unsafe(no_mangle)]
#[inline(never)]
fn measured(job: &mut dyn FnMut() -> Result<(), LengthMismatch>) {
    job().unwrap();
}

/// Spread evenly, by the golden angle.
fn directions() -> [[f32; LEN]; 3] {
    let mut vectors = [[0.0; LEN]; 3];
    for i in 0..LEN {
        let z = 1.0 - (2 * i + 1) as f32 / LEN as f32;
        let (sin, cos) = (2.399_963_3 * i as f32).sin_cos();
        let r = (1.0 - z * z).sqrt();
        for (to, c) in vectors.iter_mut().zip([r * cos, r * sin, z]) {
            to[i] = c;
        }
    }
    vectors
}
