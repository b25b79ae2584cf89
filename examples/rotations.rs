//! Measures the codecs of rotations and of tangent frames on uniformly random ones: mean and greatest error in
//! degrees, and nanoseconds for each, best of five.
//!
//!     cargo run --release --example rotations -- [COUNT, default 1000000]

use std::error::Error;
use std::f64::consts::TAU;
use std::time::Instant;

use bytemuck::Zeroable;
use unitpack::frame::{Frame, FrameCodec, OctAngle32, OctAngle64, QTangent64};
use unitpack::quaternion::{
    QuaternionCodec, SmallestThree32, SmallestThree48, SmallestThree64, TanThree32,
};

fn main() -> Result<(), Box<dyn Error>> {
    let count = std::env::args().nth(1).map_or(Ok(1_000_000), |count| count.parse())?;
    let rotations = rotations(count);
    println!("{:<18}{:<9}{:>11}{:>11}{:>9}", "quaternions", "encoder", "mean", "greatest", "ns");
    quaternions::<SmallestThree32>(&rotations);
    quaternions::<SmallestThree48>(&rotations);
    quaternions::<SmallestThree64>(&rotations);
    quaternions::<TanThree32>(&rotations);
    let frames: Vec<Frame> = rotations.iter().map(|&q| frame(q)).collect();
    println!(
        "\n{:<18}{:<9}{:>11}{:>11}{:>11}{:>11}{:>9}",
        "frames", "encoder", "normal", "greatest", "tangent", "greatest", "ns"
    );
    frame_codec::<OctAngle32>(&frames);
    frame_codec::<OctAngle64>(&frames);
    frame_codec::<QTangent64>(&frames);
    Ok(())
}

/// Shoemake, "Uniform Random Rotations", 1992, of a sequence that fills the cube evenly.
fn rotations(count: usize) -> Vec<[f32; 4]> {
    let rotation = |i: usize| {
        let part = |step: f64| (i as f64 * step).fract();
        let (a, b, c) = (
            part(0.819_172_513_396_164_4),
            part(0.671_043_606_703_789_2),
            part(0.549_700_477_901_97),
        );
        let ((sin_b, cos_b), (sin_c, cos_c)) = ((TAU * b).sin_cos(), (TAU * c).sin_cos());
        let (short, long) = ((1.0 - a).sqrt(), a.sqrt());
        [short * sin_b, short * cos_b, long * sin_c, long * cos_c].map(|c| c as f32)
    };
    (1..=count).map(rotation).collect()
}

/// Where a rotation takes z and x.
fn frame([x, y, z, w]: [f32; 4]) -> Frame {
    Frame {
        normal: [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
        tangent: [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        handedness: if x < 0.0 { -1.0 } else { 1.0 },
    }
}

/// Mean and greatest, in degrees, of angles between vectors of unit length, `times` over.
fn errors<const N: usize>(
    pairs: impl Iterator<Item = ([f32; N], [f32; N])>,
    times: f64,
) -> [f64; 2] {
    let (mut count, mut sum, mut greatest) = (0, 0.0, 0.0f64);
    for (a, b) in pairs {
        let [a, b] = [a, b].map(|v| v.map(f64::from));
        // From both the chord and the diagonal, precise at any angle.
        let length = |sign: f64| (0..N).map(|i| (a[i] + sign * b[i]).powi(2)).sum::<f64>().sqrt();
        let angle = 2.0 * length(-1.0).atan2(length(1.0)) * times;
        (count, sum, greatest) = (count + 1, sum + angle, greatest.max(angle));
    }
    [sum / f64::from(count), greatest].map(f64::to_degrees)
}

fn nanoseconds(count: usize, mut job: impl FnMut()) -> f64 {
    let mut turn = || {
        let start = Instant::now();
        job();
        start.elapsed().as_secs_f64() * 1e9 / count as f64
    };
    (0..5).map(|_| turn()).fold(f64::INFINITY, f64::min)
}

fn quaternions<C: QuaternionCodec>(rotations: &[[f32; 4]]) {
    let mut codes = vec![C::Code::zeroed(); rotations.len()];
    let mut decoded = vec![[0.0; 4]; rotations.len()];
    for (encoder, encode) in [
        ("encode", C::encode_aos as fn(&[[f32; 4]], &mut [C::Code]) -> _),
        ("precise", C::encode_aos_precise),
    ] {
        let time = nanoseconds(rotations.len(), || encode(rotations, &mut codes).unwrap());
        C::decode_aos(&codes, &mut decoded).unwrap();
        // q and -q are one rotation, by twice the angle between them in four dimensions.
        let pairs = rotations.iter().zip(&decoded).map(|(&q, &r)| {
            let same = (0..4).map(|i| q[i] * r[i]).sum::<f32>() >= 0.0;
            (q, if same { r } else { r.map(|c| -c) })
        });
        let [mean, greatest] = errors(pairs, 2.0);
        println!("{:<18}{encoder:<9}{mean:>11.3e}{greatest:>11.3e}{time:>9.2}", C::NAME);
    }
    let time = nanoseconds(codes.len(), || C::decode_aos(&codes, &mut decoded).unwrap());
    println!("{:<18}{:<9}{:>31.2}", C::NAME, "decode", time);
}

fn frame_codec<C: FrameCodec>(frames: &[Frame]) {
    let mut normals: Vec<[f32; 3]> = frames.iter().map(|frame| frame.normal).collect();
    let mut tangents: Vec<[f32; 4]> = frames
        .iter()
        .map(|Frame { tangent: [x, y, z], handedness, .. }| [*x, *y, *z, *handedness])
        .collect();
    let mut codes = vec![C::Code::zeroed(); frames.len()];
    for (encoder, encode) in [
        ("encode", C::encode_aos::<3> as fn(&[[f32; 3]], &[[f32; 4]], &mut [C::Code]) -> _),
        ("precise", C::encode_aos_precise),
    ] {
        let time = nanoseconds(frames.len(), || {
            encode(&normals, &tangents, &mut codes).unwrap();
        });
        let decoded: Vec<Frame> = codes.iter().map(|&code| C::decode(code)).collect();
        assert!(decoded.iter().zip(frames).all(|(a, b)| a.handedness == b.handedness));
        let both = || frames.iter().zip(&decoded);
        let [normal, normal_greatest] = errors(both().map(|(a, b)| (a.normal, b.normal)), 1.0);
        let [tangent, greatest] = errors(both().map(|(a, b)| (a.tangent, b.tangent)), 1.0);
        println!(
            "{:<18}{encoder:<9}{normal:>11.3e}{normal_greatest:>11.3e}{tangent:>11.3e}{greatest:>11.3e}{time:>9.2}",
            C::NAME
        );
    }
    let time = nanoseconds(codes.len(), || {
        C::decode_aos(&codes, &mut normals, &mut tangents).unwrap();
    });
    println!("{:<18}{:<9}{:>53.2}", C::NAME, "decode", time);
}
