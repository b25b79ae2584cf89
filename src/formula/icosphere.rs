//! Icosphere: the 162 vertices of an icosahedron whose edges are cut into four and pushed out to
//! the sphere, as Quake 2 stored the normals of its models.
//!
//! ```text
//! faces      of the vertices (+-1, 0, +-phi), (+-phi, +-1, 0), (0, +-phi, +-1), phi = (1 + sqrt 5) / 2
//! vertices   (i A + j B + k C) / |i A + j B + k C| for each face A, B, C, i + j + k = 4
//! ```
//!
//! All of them are mirror images of the 27 in the octant x, y, z >= 0, where the nearest one is
//! sought. Those are nine, and the same with their components moved up once and twice:
//!
//! ```text
//! n       point          weights of (1, 0, phi), (phi, 1, 0), (0, phi, 1), (-1, 0, phi)
//! 0..5    off all planes 3 1 0 0, 3 0 1 0, 2 2 0 0, 2 1 1 0, 2 0 1 1    code = (3 n + moves) 8 + signs
//! 5..8    on a plane     4 0 0 0, 3 0 0 1, 1 0 2 1                      code = 120 + (3 (n - 5) + moves) 4 + signs
//! 8       on an axis     2 0 0 2                                        code = 156 + 2 moves + sign
//! ```
//!
//! signs has a bit for each component that is not zero, x first, set if it is negative. A move takes
//! (x, y, z) to (z, x, y). Codes from 162 read as 161. A table of 2 KB holds the vertices for decoding,
//! one of 486 bytes the codes of mirror images.
//!
//! All six axes survive exactly. Both encoders give the nearest code.
//!
//! Source: id Software, "Quake II" (anorms.h), 1997, for the set; the numbering is ours.

use super::{Formula, kernels};
use crate::batch::storage::Word;
use crate::simd::{Simd, SimdInt, Vec3, map_vec};

/// The 162 vertices.
#[derive(Clone, Copy)]
pub(crate) struct Icosphere;

const VERTICES: usize = 162;

/// A vertex with x, y, z >= 0, and the codes of it and its images.
#[derive(Clone, Copy)]
struct Corner {
    point: [f64; 3],
    /// The code without signs.
    code: usize,
}

const CORNERS: [Corner; 27] = corners();
const POINTS: [[f32; 3]; 27] = {
    let mut points = [[0.0; 3]; 27];
    let mut n = 0;
    while n < 27 {
        let [x, y, z] = CORNERS[n].point;
        points[n] = [x as f32, y as f32, z as f32];
        n += 1;
    }
    points
};
/// Every vertex.
static TABLE: [[f32; 3]; VERTICES] = table();

const fn corners() -> [Corner; 27] {
    const WEIGHTS: [[f64; 4]; 9] = [
        [3.0, 1.0, 0.0, 0.0],
        [3.0, 0.0, 1.0, 0.0],
        [2.0, 2.0, 0.0, 0.0],
        [2.0, 1.0, 1.0, 0.0],
        [2.0, 0.0, 1.0, 1.0],
        [4.0, 0.0, 0.0, 0.0],
        [3.0, 0.0, 0.0, 1.0],
        [1.0, 0.0, 2.0, 1.0],
        [2.0, 0.0, 0.0, 2.0],
    ];
    const PHI: f64 = 1.618_033_988_749_895;
    let mut corners = [Corner { point: [0.0; 3], code: 0 }; 27];
    let mut code = 0;
    let mut n = 0;
    while n < 27 {
        let [a, b, c, d] = WEIGHTS[n / 3];
        let v = [a + PHI * b - d, b + PHI * c, PHI * (a + d) + c];
        let length = root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        let v = [v[0] / length, v[1] / length, v[2] / length];
        let moves = n % 3;
        let point = [v[(3 - moves) % 3], v[(4 - moves) % 3], v[(5 - moves) % 3]];
        corners[n] = Corner { point, code };
        code += images(point);
        n += 1;
    }
    assert!(code == VERTICES);
    corners
}

/// Newton's method, from above until it comes no nearer. For x >= 1.
const fn root(x: f64) -> f64 {
    let mut y = x;
    loop {
        let next = 0.5 * (y + x / y);
        if next >= y {
            return y;
        }
        y = next;
    }
}

/// How many mirror images a point of the octant has, itself included.
const fn images(point: [f64; 3]) -> usize {
    let mut images = 1;
    let mut i = 0;
    while i < 3 {
        if point[i] > 0.0 {
            images *= 2;
        }
        i += 1;
    }
    images
}

/// The code of every vertex with x, y or z negated.
static MIRROR_IMAGES: [[u8; VERTICES]; 3] = mirror_images();

const fn mirror_images() -> [[u8; VERTICES]; 3] {
    let mut table = [[0; VERTICES]; 3];
    let mut n = 0;
    while n < 27 {
        let Corner { point, code } = CORNERS[n];
        let mut signs = 0;
        while signs < images(point) {
            let (mut i, mut sign) = (0, 1);
            while i < 3 {
                let mut image = signs;
                if point[i] > 0.0 {
                    image ^= sign;
                    sign <<= 1;
                }
                table[i][code + signs] = (code + image) as u8;
                i += 1;
            }
            signs += 1;
        }
        n += 1;
    }
    table
}

const fn table() -> [[f32; 3]; VERTICES] {
    let mut table = [[0.0; 3]; VERTICES];
    let mut n = 0;
    while n < 27 {
        let Corner { point, code } = CORNERS[n];
        let mut signs = 0;
        while signs < images(point) {
            let (mut i, mut bit) = (0, 0);
            while i < 3 {
                let mut c = point[i] as f32;
                if point[i] > 0.0 {
                    if signs >> bit & 1 == 1 {
                        c = -c;
                    }
                    bit += 1;
                }
                table[code + signs][i] = c;
                i += 1;
            }
            signs += 1;
        }
        n += 1;
    }
    table
}

impl Icosphere {
    pub(crate) const fn new() -> Self {
        Icosphere
    }

    #[inline(always)]
    fn clamp<V: Simd>(code: V::Int) -> V::Int {
        code.low_bits(8).min(VERTICES as i32 - 1)
    }
}

impl Formula for Icosphere {
    type Shape = Word;
    const ONE_ENCODER: bool = true;

    #[inline(always)]
    fn encode<V: Simd>(self, v: Vec3<V>) -> V::Int {
        let target = v.abs().normalize();
        let negative = map_vec!(v, |c| V::Int::select(c.lt(0.0), 1, 0));
        let mut least = V::splat(4.0);
        let mut code = V::Int::splat(0);
        for (corner, point) in CORNERS.iter().zip(&POINTS) {
            // Half way between points f32 tells distances apart better than cosines.
            let distance = map_vec!(Vec3::from(*point), |c| V::splat(c)).distance_squared(target);
            // A bit for each component that is not zero, x lowest.
            let mut signs = V::Int::splat(0);
            for axis in [2, 1, 0] {
                if corner.point[axis] > 0.0 {
                    signs = signs + signs + negative[axis];
                }
            }
            let closer = distance.lt(least);
            code = V::Int::select(closer, signs + corner.code as i32, code);
            least = V::select(closer, distance, least);
        }
        code
    }

    #[inline(always)]
    fn decode<V: Simd>(self, code: V::Int) -> Vec3<V> {
        Vec3::from(V::gather3(&TABLE, Self::clamp::<V>(code)))
    }

    #[inline(always)]
    fn mirror<V: Simd>(self, code: V::Int, flips: [bool; 3]) -> V::Int {
        let mut code = Self::clamp::<V>(code);
        for (images, flip) in MIRROR_IMAGES.iter().zip(flips) {
            if flip {
                code = V::gather(images, code);
            }
        }
        code
    }
}

kernels!(Icosphere: [u8; 1]);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_are_those_of_the_source() {
        // Lines of Quake II's anorms.h.
        for v in [
            [-0.525_731f32, 0.0, 0.850_651],
            [-0.442_863, 0.238_856, 0.864_188],
            [-0.295_242, 0.0, 0.955_423],
            [-0.309_017, 0.5, 0.809_017],
            [-0.162_460, 0.262_866, 0.951_056],
            [0.681_718, 0.147_621, 0.716_567],
        ] {
            let code = Icosphere.encode(Vec3::from(v));
            let vertex = Icosphere.decode::<f32>(code);
            assert!(vertex.distance_squared(v.into()) < 1e-11, "{vertex:?}");
        }
    }

    #[test]
    fn codes_are_numbered_as_the_table_says() {
        // 3 (1, 0, phi) + (phi, 1, 0), then without moves (1, 0, phi), with x or z negated, moved.
        for (code, v) in [
            (0, [0.681_718f32, 0.147_621, 0.716_567]),
            (7, [-0.681_718, -0.147_621, -0.716_567]),
            (8, [0.716_567, 0.681_718, 0.147_621]),
            (120, [0.525_731, 0.0, 0.850_651]),
            (121, [-0.525_731, 0.0, 0.850_651]),
            (122, [0.525_731, 0.0, -0.850_651]),
            (124, [0.850_651, 0.525_731, 0.0]),
        ] {
            assert_eq!(Icosphere.encode(Vec3::from(v)).0, code);
            assert!(Icosphere.decode::<f32>(code.into()).distance_squared(v.into()) < 1e-11);
        }
    }

    #[test]
    fn axes_survive() {
        for (axis, code) in [
            ([0.0f32, 0.0, 1.0], 156),
            ([0.0, 0.0, -1.0], 157),
            ([1.0, 0.0, 0.0], 158),
            ([-1.0, 0.0, 0.0], 159),
            ([0.0, 1.0, 0.0], 160),
            ([0.0, -1.0, 0.0], 161),
        ] {
            assert_eq!(Icosphere.encode(axis.into()).0, code);
            assert_eq!(Icosphere.decode::<f32>(code.into()).to_array(), axis);
        }
    }

    #[test]
    fn codes_from_162_read_as_161() {
        for (code, canonical) in [(162, 161), (255, 161), (161, 161), (0x19E, 158)] {
            assert_eq!(Icosphere.mirror::<f32>(code.into(), [false; 3]).0, canonical);
            let v = Icosphere.decode::<f32>(code.into());
            assert_eq!(v, Icosphere.decode::<f32>(canonical.into()));
        }
    }

    #[test]
    fn every_vertex_has_its_code_and_its_mirror_images() {
        for code in 0..162 {
            let v = Icosphere.decode::<f32>(code.into());
            assert_eq!(Icosphere.encode(v).0, code);
            for axis in 0..3 {
                let (mut flips, mut image) = ([false; 3], v);
                flips[axis] = true;
                image[axis] = -image[axis];
                assert_eq!(Icosphere.mirror::<f32>(code.into(), flips), Icosphere.encode(image));
            }
        }
    }
}
