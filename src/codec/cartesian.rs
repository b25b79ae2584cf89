//! Cartesian: the three components, each on a grid of its own: snorm, half or float.
//!
//! ```text
//! encode   v / |v|, each component to the nearest grid point
//! decode   the three values, divided by their length; (0, 0, 0) reads as +Z
//! ```
//!
//! Decoding divides by the length, so a grid point stands for its direction, and the precise encoder may take any length:
//! it tries every value of the largest component, rounding the other two, and keeps the nearest direction.
//!
//! Canonical: of the patterns of one direction, such as (1, 1, 0) and (90, 90, 0), the one whose length is nearest to 1. That
//! is the one rounding gives. Directions that f32 cannot tell apart count as one. Axes survive exactly. In snorm, -M-1 reads as -M;
//! in halves, infinities and NaN read as 65504.
//!
//! [`Floats`] stores the bits of the input as they are, and gives them back.
//!
//! Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", 2014; the search over lengths:
//! Kaplanyan, "CryENGINE 3: Reaching the Speed of Light", 2010.

use core::marker::PhantomData;

use crate::formula::{Formula, One, Packed, Three, Words};
use crate::half;
use crate::lane::{Lane, LaneInt, LaneMask};
use crate::layout::snorm_max;
use crate::math::{chord_squared, length_squared, normalize, sqrt};

/// Three components on a grid.
pub(crate) struct Cartesian<G>(PhantomData<G>);

/// The values that each component may have.
pub(crate) trait Grid: 'static {
    type Words: Words;
    /// Steps from 0 to 1 on each axis.
    const STEPS: [f32; 3];
    /// How many values the search for the largest component tries.
    const LENGTHS: i32;
    /// Vectors this close to the nearest, in radians, count as nearest too: those of one direction differ by rounding alone.
    /// Zero where the grid is finer than f32.
    const SLACK: f32;

    /// The `n`th value for the largest component, `n` from 1 to [`LENGTHS`](Self::LENGTHS).
    fn length<L: Lane>(n: L, step: L) -> L;
    /// Nearest grid point, ties to even.
    fn nearest<L: Lane>(x: L, steps: L) -> L::Int;
    fn value<L: Lane>(i: L::Int, step: L) -> L;
    fn pack<L: Lane>(v: [L::Int; 3]) -> Packed<Cartesian<Self>, L>
    where
        Self: Sized;
    fn unpack<L: Lane>(code: Packed<Cartesian<Self>, L>) -> [L::Int; 3]
    where
        Self: Sized;
}

/// Snorm of `X`, `Y` and `Z` bits, x in the low bits.
pub(crate) struct Snorm<const X: u32, const Y: u32, const Z: u32>;

impl<const X: u32, const Y: u32, const Z: u32> Grid for Snorm<X, Y, Z> {
    type Words = One;
    const STEPS: [f32; 3] = [snorm_max(X) as f32, snorm_max(Y) as f32, snorm_max(Z) as f32];
    const LENGTHS: i32 = if X > Z { snorm_max(X) } else { snorm_max(Z) };
    const SLACK: f32 = 2e-7;

    #[inline(always)]
    fn length<L: Lane>(n: L, step: L) -> L {
        n * step
    }
    #[inline(always)]
    fn nearest<L: Lane>(x: L, steps: L) -> L::Int {
        (x * steps).round_int()
    }
    #[inline(always)]
    fn value<L: Lane>(i: L::Int, step: L) -> L {
        L::from_int(i) * step
    }
    #[inline(always)]
    fn pack<L: Lane>([x, y, z]: [L::Int; 3]) -> L::Int {
        x.low(X) | y.low(Y).shl(X) | z.low(Z).shl(X + Y)
    }
    #[inline(always)]
    fn unpack<L: Lane>(code: L::Int) -> [L::Int; 3] {
        let field = |shift: u32, bits: u32| {
            code.shr(shift).sign_extend(bits).max(L::Int::splat(-snorm_max(bits)))
        };
        [field(0, X), field(X, Y), field(X + Y, Z)]
    }
}

/// Snorm of 16 bits in three words.
pub(crate) struct Snorm16;

impl Grid for Snorm16 {
    type Words = Three;
    const STEPS: [f32; 3] = [snorm_max(16) as f32; 3];
    const LENGTHS: i32 = snorm_max(16);
    const SLACK: f32 = 0.0;

    #[inline(always)]
    fn length<L: Lane>(n: L, step: L) -> L {
        n * step
    }
    #[inline(always)]
    fn nearest<L: Lane>(x: L, steps: L) -> L::Int {
        (x * steps).round_int()
    }
    #[inline(always)]
    fn value<L: Lane>(i: L::Int, step: L) -> L {
        L::from_int(i) * step
    }
    #[inline(always)]
    fn pack<L: Lane>(v: [L::Int; 3]) -> [L::Int; 3] {
        v
    }
    #[inline(always)]
    fn unpack<L: Lane>(code: [L::Int; 3]) -> [L::Int; 3] {
        code.map(|c| c.sign_extend(16).max(L::Int::splat(-snorm_max(16))))
    }
}

/// IEEE halves. The largest component of a canonical code is from 0.5 to 1.
pub(crate) struct Halves;

impl Grid for Halves {
    type Words = Three;
    const STEPS: [f32; 3] = [1.0; 3];
    const LENGTHS: i32 = 1025;
    const SLACK: f32 = 0.0;

    #[inline(always)]
    fn length<L: Lane>(n: L, _: L) -> L {
        (n + L::splat(1023.0)) * L::splat(1.0 / 2048.0)
    }
    #[inline(always)]
    fn nearest<L: Lane>(x: L, _: L) -> L::Int {
        half::nearest(x)
    }
    #[inline(always)]
    fn value<L: Lane>(i: L::Int, _: L) -> L {
        half::value(i)
    }
    #[inline(always)]
    fn pack<L: Lane>(v: [L::Int; 3]) -> [L::Int; 3] {
        v.map(|i| half::to_bits::<L>(i))
    }
    #[inline(always)]
    fn unpack<L: Lane>(code: [L::Int; 3]) -> [L::Int; 3] {
        code.map(|bits| half::from_bits::<L>(bits, half::GREATEST))
    }
}

impl<G: Grid> Cartesian<G> {
    #[inline(always)]
    fn nearest<L: Lane>(v: [L; 3]) -> [L::Int; 3] {
        core::array::from_fn(|i| G::nearest(v[i], L::splat(G::STEPS[i])))
    }

    #[inline(always)]
    fn values<L: Lane>(point: [L::Int; 3]) -> [L; 3] {
        core::array::from_fn(|i| G::value(point[i], L::splat(1.0 / G::STEPS[i])))
    }

    #[inline(always)]
    fn unit<L: Lane>(values: [L; 3]) -> [L; 3] {
        let zero = length_squared(values).le(L::zero());
        let [x, y, z] = values;
        normalize([x, y, L::select(zero, L::splat(1.0), z)])
    }
}

/// What the search over lengths has found: a point, its distance from the target, and that of its length from 1.
struct Found<L: Lane> {
    point: [L::Int; 3],
    distance: L,
    off_unit: L,
}

/// One target, seen along its largest component.
struct Search<L: Lane> {
    target: [L; 3],
    /// The components over the largest one's magnitude.
    slope: [L; 3],
    /// From one grid point to the next on the axis of the largest component.
    step: L,
}

impl<L: Lane> Search<L> {
    #[inline(always)]
    fn new<G: Grid>(v: [L; 3]) -> Self {
        // A decoded vector is not divided again, so that its own code is at distance zero.
        let unit = normalize(v);
        let off = (length_squared(v) - L::splat(1.0)).abs();
        let decoded = off.lt(L::splat(6e-7));
        let target = core::array::from_fn(|i| L::select(decoded, v[i], unit[i]));
        let [x, y, z] = target.map(|c| c.abs());
        let [step_x, step_y, step_z] = G::STEPS.map(|s| L::splat(1.0 / s));
        let largest = x.greater(y).greater(z);
        let on = |c: L, step: L, other: L| L::select(largest.le(c), step, other);
        Search {
            target,
            slope: target.map(|c| c / largest),
            step: on(x, step_x, on(y, step_y, step_z)),
        }
    }

    /// Calls `consider` with each grid point that may lie within `reach()` of the target.
    #[inline(always)]
    fn walk<G: Grid>(
        &self,
        found: &mut Found<L>,
        reach: impl Fn(&Found<L>) -> L,
        consider: impl Fn(&mut Found<L>, L::Mask, [L::Int; 3], [L; 3]),
    ) {
        // The angle is at least |e| / (|length| |slope|^2), with e the rounding error of the point, but for a tenth where it is
        // large: one step in 15.
        let stretch = length_squared(self.slope);
        let limit = |reach: L| {
            let e = (reach * L::splat(1.1) + L::splat(3e-7)) * stretch;
            e * e
        };
        let mut within = limit(reach(found));
        let mut n = G::LENGTHS;
        while n > 0 {
            let length = G::length(L::splat(n as f32), self.step);
            n -= 1;
            let ideal = self.slope.map(|s| s * length);
            let point = Cartesian::<G>::nearest(ideal);
            let values = Cartesian::<G>::values::<L>(point);
            let near = chord_squared(values, ideal).le(length * length * within)
                & length.le(L::splat(1.0));
            if near.any() {
                consider(found, near, point, values);
                within = limit(reach(found));
            }
        }
    }
}

impl<G: Grid> Formula for Cartesian<G> {
    type Words = G::Words;

    #[inline(always)]
    fn encode<L: Lane>(v: [L; 3]) -> Packed<Self, L> {
        G::pack::<L>(Self::nearest(normalize(v)))
    }

    #[inline(always)]
    fn encode_precise<L: Lane>(v: [L; 3]) -> Packed<Self, L> {
        let search = Search::new::<G>(v);
        let distance_to = |values: [L; 3]| chord_squared(Self::unit(values), search.target);
        let off_unit = |values| (sqrt(length_squared::<L>(values)) - L::splat(1.0)).abs();
        let mut found = Found {
            point: [L::Int::splat(0); 3],
            distance: L::splat(4.0),
            off_unit: L::splat(4.0),
        };
        // A grid finer than f32 has equals only where f32 has them; then one walk is enough.
        let fine = G::SLACK == 0.0;
        let consider = |f: &mut Found<L>, near: L::Mask, point: [L::Int; 3], values: [L; 3]| {
            let (distance, off) = (distance_to(values), off_unit(values));
            let equal = f.distance.le(distance) & distance.le(f.distance) & off.lt(f.off_unit);
            let better = near & (distance.lt(f.distance) | equal);
            f.distance = L::select(better, distance, f.distance);
            f.off_unit = L::select(better, off, f.off_unit);
            f.point = core::array::from_fn(|i| L::Int::select(better, point[i], f.point[i]));
        };
        search.walk::<G>(&mut found, |f| sqrt(f.distance), consider);
        if !fine {
            // Of those that are as near but for rounding, the one whose length is nearest to 1.
            let reach = sqrt(found.distance) + L::splat(G::SLACK);
            found.off_unit = L::splat(4.0);
            search.walk::<G>(
                &mut found,
                |_| reach,
                |f, near, point, values| {
                    let off = off_unit(values);
                    let equal = distance_to(values).le(reach * reach);
                    let better = near & equal & off.lt(f.off_unit);
                    f.off_unit = L::select(better, off, f.off_unit);
                    f.point =
                        core::array::from_fn(|i| L::Int::select(better, point[i], f.point[i]));
                },
            );
        }
        G::pack::<L>(found.point)
    }

    #[inline(always)]
    fn decode<L: Lane>(code: Packed<Self, L>) -> [L; 3] {
        Self::unit(Self::values::<L>(G::unpack::<L>(code)))
    }
}

/// Three `f32`, bit for bit.
pub(crate) struct Floats;

impl Formula for Floats {
    type Words = Three;

    #[inline(always)]
    fn prepare<L: Lane>(v: [L; 3]) -> [L; 3] {
        v
    }
    #[inline(always)]
    fn encode<L: Lane>(v: [L; 3]) -> [L::Int; 3] {
        v.map(|c| c.to_bits())
    }
    #[inline(always)]
    fn decode<L: Lane>(code: [L::Int; 3]) -> [L; 3] {
        code.map(L::from_bits)
    }
}
