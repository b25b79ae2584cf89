//! Maps of an octant of the sphere to a face of the octahedron.

use super::lattice::{Steps, nearest_on_octahedron, triangle_around};
use crate::formula::support::closest::Closest;
use crate::simd::math::{atan2_half_turns, sin_cos_of_one, sqrt};
use crate::simd::{Simd, SimdInt, Use, Vec3, map_vec, map3};

/// How an octant of the sphere is mapped to a face of the octahedron.
pub(crate) trait Projection: Copy + Send + Sync + 'static {
    /// See [`Formula::PRECISE_USE`](crate::formula::Formula::PRECISE_USE).
    const PRECISE_USE: Use = Use::Sometimes;

    /// The point of |v|, whose components add to M.
    fn project<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V>;
    /// The unit vector of a point whose magnitudes add to 1.
    fn direction<V: Simd>(p: Vec3<V>) -> Vec3<V>;
    /// The lattice point nearest to |v|: of the corners of the triangle around it.
    #[inline(always)]
    fn nearest<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        let v = v.abs();
        let (base, step) = triangle_around(Self::project(v, steps), steps);
        let mut closest = Closest::to(v);
        for axis in 0..3 {
            let mut q = base;
            q[axis] = q[axis] + step;
            closest.consider(V::Int::from(axis as i32), Self::direction(q * steps.inverse));
        }
        let axis = closest.code();
        Vec3::from(map3!([0, 1, 2], |i: usize| {
            V::select(axis.eq(i as i32), base[i] + step, base[i])
        }))
    }
}

/// Along the rays from the centre.
#[derive(Clone, Copy)]
pub(crate) struct Central;
/// With triangles of about the same size.
#[derive(Clone, Copy)]
pub(crate) struct Warped;
/// With equal areas.
#[derive(Clone, Copy)]
pub(crate) struct EqualArea;

impl Projection for Central {
    const PRECISE_USE: Use = Use::Often;

    #[inline(always)]
    fn project<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        let v = v.abs();
        v * (V::splat(steps.float) / (v.x + v.y + v.z))
    }
    #[inline(always)]
    fn direction<V: Simd>(p: Vec3<V>) -> Vec3<V> {
        p.normalize()
    }
    #[inline(always)]
    fn nearest<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        nearest_on_octahedron(Self::project(v, steps), steps)
    }
}

impl Warped {
    /// See `examples/warp.rs`.
    const K: f32 = 0.459_265;
    const Q: f32 = -0.710_567;
    /// About the K and Q of the inverse.
    const INVERSE: [f32; 2] = [-0.35, 0.7];

    /// g(t) = t (1 + (k + q t) (1 - t)); odd.
    #[inline(always)]
    fn warp<V: Simd>(t: V, [k, q]: [f32; 2]) -> V {
        let magnitude = t.abs();
        t * ((magnitude * q + k) * (V::splat(1.0) - magnitude) + 1.0)
    }

    /// g'(t).
    #[inline(always)]
    fn gradient<V: Simd>(t: V) -> V {
        t * (V::splat(2.0 * (Self::Q - Self::K)) - t * (3.0 * Self::Q)) + (1.0 + Self::K)
    }

    #[inline(always)]
    fn warp_all<V: Simd>(p: Vec3<V>) -> Vec3<V> {
        map_vec!(p, |t| Self::warp(t, [Self::K, Self::Q]))
    }
}

impl Projection for Warped {
    #[inline(always)]
    fn project<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        let target = v.abs();
        let central = target * (V::splat(1.0) / (target.x + target.y + target.z));
        // Without a good first guess, two steps would not be enough for 32 bits.
        let mut p = map_vec!(central, |t| Self::warp(t, Self::INVERSE));
        for _ in 0..2 {
            let g = Self::warp_all(p);
            let Vec3 { x, y, z } = map_vec!(p, |t| Self::gradient(t));
            // The inverse of each gradient, and s, from one division.
            let (others, all) = (Vec3::new(y * z, z * x, x * y), x * y * z);
            let (along, off) = (target.dot(others), V::splat(1.0) - (p.x + p.y + p.z));
            let inverse = V::splat(1.0) / (along * all);
            let s = (g.dot(others) + off * all) * all * inverse;
            p = p + (target * s - g).times(others * (along * inverse));
        }
        map_vec!(p, |t| t.max(0.0) * steps.float)
    }
    #[inline(always)]
    fn direction<V: Simd>(p: Vec3<V>) -> Vec3<V> {
        Self::warp_all(p).normalize()
    }
}

impl Projection for EqualArea {
    #[inline(always)]
    fn project<V: Simd>(v: Vec3<V>, steps: Steps) -> Vec3<V> {
        let Vec3 { x, y, z } = v.abs().normalize();
        // 1 - z, and 1 - r, without cancellation.
        let r = sqrt((x * x + y * y) / (z + 1.0));
        let k = z / (r + 1.0);
        let a = atan2_half_turns(y, x);
        let a = a + a;
        Vec3::new(r * (V::splat(1.0) - a), r * a, k) * steps.float
    }
    #[inline(always)]
    fn direction<V: Simd>(p: Vec3<V>) -> Vec3<V> {
        let Vec3 { x, y, z: k } = p.abs();
        let r = x + y;
        let (sin, cos) = sin_cos_of_one(y / r.max(f32::MIN_POSITIVE));
        // 2 - r^2 = 1 + z.
        let height = k * (r + 1.0);
        let h = r * sqrt(height + 1.0);
        Vec3::new(h * cos, h * sin, height).negate_where_negative(p).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: Steps = Steps::new(127);

    fn assert_near(v: Vec3<f32>, expected: [f32; 3]) {
        assert!(v.distance_squared(expected.into()) < 1e-10, "{v:?}");
    }

    #[test]
    fn projections_are_inverse_to_directions() {
        fn check<P: Projection>() {
            for v in [[0.48f32, 0.36, 0.8], [0.6, 0.8, 0.0], [0.02, 0.01, 0.9997], [0.8, 0.0, 0.6]]
            {
                let p = P::project(Vec3::from(v), STEPS);
                assert!((p.x + p.y + p.z - 127.0).abs() < 1e-3);
                let back = P::direction(p * STEPS.inverse);
                assert!(back.distance_squared(Vec3::from(v).normalize()) < 1e-10, "{v:?}");
            }
        }
        check::<Central>();
        check::<Warped>();
        check::<EqualArea>();
    }

    #[test]
    fn signs_do_not_count_for_projections_but_for_directions() {
        fn check<P: Projection>() {
            let v = Vec3::new(1.0f32, -2.0, -3.0);
            assert_eq!(P::project(v, STEPS), P::project(v.abs(), STEPS));
            let p = Vec3::new(0.25f32, -0.25, -0.5);
            let signed = P::direction(p.abs()).negate_where_negative(p);
            assert_eq!(P::direction(p), signed);
        }
        check::<Central>();
        check::<Warped>();
        check::<EqualArea>();
    }

    #[test]
    fn the_warp_is_the_cubic() {
        // t = 32/127, 1 - t = 95/127: g(t) = 0.251969 (1 + 0.280224 * 0.748031) = 0.304786, and
        // g(1 - t) = 0.748031 (1 - 0.072261 * 0.251969) = 0.734411. Their ratio is 0.415007.
        let v = Warped::direction(Vec3::new(0.0f32, 32.0, 95.0) * STEPS.inverse);
        assert_near(v, [0.0, 0.383_303, 0.923_623]);
        assert_near(Warped::project(v, STEPS) * STEPS.inverse, [0.0, 0.251_969, 0.748_031]);
    }

    #[test]
    fn the_corner_and_the_axes_of_a_warped_octant_stay() {
        assert_near(Warped::project(Vec3::new(1.0f32, 1.0, 1.0), STEPS), [127.0 / 3.0; 3]);
        for axis in [[1.0f32, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            assert_near(Warped::project(axis.into(), STEPS) * STEPS.inverse, axis);
            assert_eq!(Warped::direction(Vec3::from(axis)).to_array(), axis);
        }
    }

    #[test]
    fn equal_area_has_even_steps_of_azimuth_and_of_the_root_of_height() {
        // z = 0.75 is r = sqrt(1 - z) = 1/2; 60 degrees are a = 2/3: (r (1 - a), r a, 1 - r).
        let v = [0.330_719f32, 0.572_822, 0.75];
        let p = [1.0 / 6.0, 1.0 / 3.0, 0.5];
        assert_near(EqualArea::project(v.into(), STEPS) * STEPS.inverse, p);
        assert_near(EqualArea::direction(p.into()), v);
    }

    #[test]
    fn the_nearest_lattice_point_is_found() {
        fn nearest<P: Projection>(p: [f32; 3]) -> [f32; 3] {
            let v = P::direction(Vec3::from(p) * STEPS.inverse);
            P::nearest(v, STEPS).to_array()
        }
        // Near the corner (1, 1, 1) triangles are equilateral. (42.45, 42.4, 42.15) is rounded to
        // (42, 42, 43), but (43, 42, 42) is nearer.
        let p = [42.45, 42.4, 42.15];
        assert_eq!(nearest::<Central>(p), [43.0, 42.0, 42.0]);
        assert_eq!(nearest::<Warped>(p), [43.0, 42.0, 42.0]);
        assert_eq!(nearest::<EqualArea>([0.1, 0.2, 126.7]), [0.0, 0.0, 127.0]);
        assert_eq!(nearest::<EqualArea>([20.1, 60.2, 46.7]), [20.0, 60.0, 47.0]);
    }
}
