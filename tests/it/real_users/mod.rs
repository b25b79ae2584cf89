//! What people who pack normals ran into, with other libraries or with this one. Each case has the right value.
//!
//! Most of these fail not on a codec but on where the vectors lie, on w, on texels, or on what encoding
//! twice does. The details of each feature are tested in its own file.

mod flat_texels;

use unitpack::frame::{Frame, FrameCodec, OctAngle32, OctAngleFormat};
use unitpack::padded::{Snorm8x4, Unorm10_10_10_2, W};
use unitpack::quaternion::{
    QuaternionCodec, QuaternionFormat, SmallestThree32, SmallestThree48, SmallestThree64,
};
use unitpack::{
    AxisOrder, Codec, Format, HemiOct16, Oct16, Oct32, Octant16, OrNone, Snorm8x3, Snorm12x3,
    Strided, StridedMut,
};
use unitpack_test::random::Rng;
use unitpack_test::vectors::{angle, normalize, widen};

const TILTED: [f32; 3] = [0.48, -0.6, 0.64];

fn degrees(a: [f32; 3], b: [f32; 3]) -> f64 {
    angle(normalize(widen(a)), normalize(widen(b))).to_degrees()
}

/// Position, normal and texture coordinates.
const VERTEX: [f32; 8] = [9.0, 8.0, 7.0, 0.48, -0.6, 0.64, 0.25, 0.75];

#[test]
fn the_normal_of_an_interleaved_vertex_goes_into_a_field_of_another() {
    let vertices = [VERTEX; 70];
    // A position of three halves, and the code.
    let mut gpu = [[1u16, 2, 3, 0]; 70];
    Oct16::encode_strided(Strided::of(&vertices, 12), StridedMut::of(&mut gpu, 6)).unwrap();
    assert_eq!(gpu, [[1, 2, 3, Oct16::encode(TILTED)]; 70]);
}

/// The first three floats are the position: `encode_aos` takes it, as its page warns.
#[test]
fn the_first_three_floats_of_a_vertex_are_not_its_normal() {
    let mut codes = [0];
    Oct16::encode_aos(&[VERTEX], &mut codes).unwrap();
    assert_eq!(codes, [Oct16::encode([9.0, 8.0, 7.0])]);
    let to = StridedMut::of(&mut codes, 0);
    Oct16::encode_strided(Strided::of(&[VERTEX], 12), to).unwrap();
    assert_eq!(codes, [Oct16::encode(TILTED)]);
}

/// A vector type of another crate, as glam, mint and nalgebra have them.
#[derive(Clone, Copy)]
struct Vec3(f32, f32, f32);

impl From<Vec3> for [f32; 3] {
    fn from(Vec3(x, y, z): Vec3) -> Self {
        [x, y, z]
    }
}

#[test]
fn vectors_of_other_crates_are_an_iterator() {
    let mesh = [Vec3(0.48, -0.6, 0.64); 300];
    let codes = Oct16::encode_iter(mesh.iter().copied());
    assert_eq!(codes.len(), 300);
    assert!(codes.eq([Oct16::encode(TILTED); 300]));
}

#[test]
fn a_format_from_a_file_takes_arrays_of_vectors() {
    let format: Format = "oct24".parse().unwrap();
    let mut bytes = [0; 15];
    format.encode_aos(&[TILTED; 5], &mut bytes).unwrap();
    let mut back = [[0.0; 3]; 5];
    format.decode_aos(&bytes, &mut back).unwrap();
    assert!(back.iter().all(|&v| degrees(v, TILTED) < 0.06));
}

/// Below the codec's equator is half of what has y up.
#[test]
fn terrain_with_y_up_fits_a_hemisphere_of_z() {
    let normals = [[0.3, 0.9, -0.3]; 9];
    let (mut codes, mut back) = ([0u16; 9], [[0.0f32; 3]; 9]);
    let order = AxisOrder::Zxy;
    let to = StridedMut::of(&mut codes, 0);
    order.encode_strided(HemiOct16, Strided::of(&normals, 0), to).unwrap();
    let to = StridedMut::of(&mut back, 0);
    order.decode_strided(HemiOct16, Strided::of(&codes, 0), to).unwrap();
    assert!(back.iter().all(|&v| degrees(v, normals[0]) < 0.7));
    // As it is, it would fall on the rim.
    assert!(degrees(HemiOct16::decode(HemiOct16::encode(normals[0])), normals[0]) > 15.0);
}

/// glTF aligns to 4 bytes, and its tangents have the handedness in w.
#[test]
fn a_tangent_keeps_its_handedness_in_w() {
    let tangents = [[0.0, 0.6, 0.8, -1.0], [1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 0.0]];
    let mut elements = [[0u8; 4]; 3];
    Snorm8x4::encode_tangents_aos(&tangents, &mut elements).unwrap();
    // 127 (0, 0.6, 0.8) = (0, 76.2, 101.6), and w is -127 or 127.
    assert_eq!(elements, [[0, 76, 102, 129], [127, 0, 0, 127], [0, 0, 127, 127]]);
}

/// WebGPU's only packed format: 0.042 degrees in the mean by component, where 0.004 is possible.
#[test]
fn ten_bits_a_component_have_a_nearest_code() {
    let mut rng = Rng::new(1);
    let mut sums = [0.0; 2];
    let count = 20_000;
    for _ in 0..count {
        let v = rng.direction();
        let codes =
            [Unorm10_10_10_2::encode(v, W::One), Unorm10_10_10_2::encode_precise(v, W::One)];
        for (sum, code) in sums.iter_mut().zip(codes) {
            assert_eq!(code >> 30, 3);
            *sum += degrees(Unorm10_10_10_2::decode(code), v);
        }
    }
    let [fast, precise] = sums.map(|sum| sum / f64::from(count));
    assert!((fast - 0.0422).abs() < 0.0008 && (precise - 0.0036).abs() < 0.0003, "{sums:?}");
}

#[test]
fn twelve_bits_in_shorts_are_sign_extended() {
    // 2047 (0.48, -0.6, 0.64) = (982.6, -1228.2, 1310.1).
    assert_eq!(Snorm12x3::encode(TILTED).map(|c| c as i16), [983, -1228, 1310]);
}

#[test]
fn a_rotation_near_a_quarter_turn_does_not_alternate() {
    let code = SmallestThree32::encode([0.0, 0.0014, 0.7070, 0.7072]);
    assert_eq!(SmallestThree32::encode(SmallestThree32::decode(code)), code);
    // Noise of 0.2 degrees around it.
    for i in 0..10_000 {
        let noise = |k: i32| (i * k % 1009) as f32 / 1009.0 * 0.005 - 0.0025;
        let q = [noise(17), noise(31), 1.0 + noise(53), 1.0 + noise(97)];
        let code = SmallestThree32::encode(q);
        assert_eq!(SmallestThree32::encode(SmallestThree32::decode(code)), code, "{q:?}");
    }
}

/// Where rounding cannot keep a code, the nearest does, and the constant tells.
#[test]
fn a_buffer_that_is_encoded_again_keeps_its_bytes() {
    let code = [-67i8, -107, 6].map(|c| c as u8);
    let v = Snorm8x3::decode(code);
    assert_eq!(Snorm8x3::encode(v), [-67i8, -108, 6].map(|c| c as u8));
    assert_eq!(Snorm8x3::encode_precise(v), code);
    assert!(!Format::Snorm8x3.encode_is_stable() && !Format::Octant16.encode_is_stable());
    assert!(Format::Oct16.encode_is_stable());

    // The original's truncation creeps: over five rounds, to the foot of the octant's triangle.
    let mut rng = Rng::new(2);
    let [mut farthest, mut farthest_precise] = [0.0f64; 2];
    for _ in 0..60_000 {
        let start = rng.direction();
        let [mut fast, mut precise] = [start; 2];
        for _ in 0..5 {
            fast = Octant16::decode(Octant16::encode(fast));
            precise = Octant16::decode(Octant16::encode_precise(precise));
        }
        farthest = farthest.max(degrees(fast, start));
        farthest_precise = farthest_precise.max(degrees(precise, start));
    }
    assert!((8.0..9.4).contains(&farthest), "{farthest}");
    assert!(farthest_precise <= Format::Octant16.max_error_precise_degrees());
}

/// At 48 and 64 bits too, where `f32` does not tell all rotations apart.
#[test]
fn noise_around_rotations_does_not_move_codes_of_any_width() {
    fn check<C: QuaternionCodec>() {
        let mut rng = Rng::new(3);
        for _ in 0..30_000 {
            let q = [0; 4].map(|_| (rng.unit() - 0.5) as f32);
            for encode in [C::encode, C::encode_precise] {
                let code = encode(q);
                assert_eq!(encode(C::decode(code)), code, "{} {q:?}", C::NAME);
            }
        }
    }
    check::<SmallestThree32>();
    check::<SmallestThree48>();
    check::<SmallestThree64>();
}

#[test]
fn a_rotation_keeps_its_sign_over_a_turn() {
    // Around 270 degrees another component becomes the greatest, and what is left out is positive.
    let turn = |degrees: f32| {
        let half = degrees.to_radians() / 2.0;
        SmallestThree32::encode([0.0, 0.0, half.sin(), half.cos()])
    };
    let dot = |a: [f32; 4], b: [f32; 4]| (0..4).map(|i| a[i] * b[i]).sum::<f32>();
    let before = SmallestThree32::decode(turn(269.0));
    assert!(dot(before, SmallestThree32::decode(turn(271.0))) < -0.99);
    assert!(dot(before, SmallestThree32::decode_near(turn(271.0), before)) > 0.99);
}

/// Four signed bytes, as glTF's animations and packers of skeletons have them.
#[test]
fn plain_quaternions_of_bytes_are_nearer_at_other_lengths() {
    let format = QuaternionFormat::snorm(8).unwrap();
    let q = [0.18257f32, 0.36515, 0.54772, 0.73030];
    let off = |code| {
        let back: [f32; 4] = format.decode(code);
        let dot = (0..4).map(|i| f64::from(q[i]) * f64::from(back[i])).sum::<f64>();
        2.0 * dot.min(1.0).acos().to_degrees()
    };
    // (23, 46, 70, 93), and a multiple of (1, 2, 3, 4).
    assert_eq!(format.encode(q).to_le_bytes(), [23, 46, 70, 93, 0, 0, 0, 0]);
    assert_eq!(format.encode_precise(q).to_le_bytes(), [23, 46, 69, 92, 0, 0, 0, 0]);
    assert!(off(format.encode_precise(q)) < 0.1 && off(format.encode(q)) > 0.2);
}

#[test]
fn a_frame_takes_the_bits_that_a_vertex_has_left() {
    let frame = Frame { normal: TILTED, tangent: [0.8, 0.64, 0.0], handedness: -1.0 };
    for (oct, angle, size) in [(24, 7, 4), (32, 15, 6)] {
        let format = OctAngleFormat::new(oct, angle).unwrap();
        assert_eq!(format.code_size(), size);
        let back = format.decode(format.encode(frame));
        assert_eq!(back.handedness, -1.0);
        assert!(degrees(back.normal, frame.normal) < 0.06);
        assert!(degrees(back.tangent, frame.tangent) < 180.0 / f64::from(1 << angle) + 0.06);
    }
    // Normals and tangents of one vertex buffer, each at its place.
    let mut vertices = [[0.0f32; 10]; 3];
    let codes = [OctAngle32::encode(frame); 3];
    let to = StridedMut::of(&mut vertices, 12);
    OctAngle32::decode_vertices(Strided::of(&codes, 0), to, 24).unwrap();
    assert_eq!(vertices[2][9], -1.0);
}

/// A scan has points whose normal is not known.
#[test]
fn a_point_without_a_normal_stays_one() {
    let normals = [TILTED, [0.0; 3], [f32::NAN; 3]];
    let mut codes = [0; 3];
    OrNone::<Oct16>::encode_aos(&normals, &mut codes).unwrap();
    assert_eq!(codes[1..], [Oct16::NONE.unwrap(); 2]);
    let mut back = [[1.0; 3]; 3];
    OrNone::<Oct16>::decode_aos(&codes, &mut back).unwrap();
    assert_eq!(back[1..], [[0.0; 3]; 2]);
    assert!(degrees(back[0], TILTED) < 1.0);
    // Without asking, it is +Z.
    assert_eq!(Oct16::decode(Oct16::encode([0.0; 3])), [0.0, 0.0, 1.0]);
}

/// As f32, the first is infinite: 39 degrees off, as a diagonal of x and y.
#[test]
fn doubles_keep_the_direction_they_have() {
    let v = Oct32::decode(Oct32::encode_f64([1e40, 1e39, 0.0]));
    assert!(degrees(v, [10.0, 1.0, 0.0]) < 0.004);
    let cast = Oct32::decode(Oct32::encode([1e40, 1e39, 0.0].map(|c: f64| c as f32)));
    assert!(degrees(cast, [10.0, 1.0, 0.0]) > 39.0);
}
