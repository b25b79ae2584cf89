//! Spherical Fibonacci: N points on a spiral from +Z to -Z, a golden section of a turn apart.
//!
//! ```text
//! decode   z = 1 - (2 i + 1) / N, phi = 2 pi frac(i G / 2^32);  v = (sqrt(1 - z^2) cos phi, sqrt(1 - z^2) sin phi, z)
//! encode   the nearest point
//! ```
//!
//! with G = round(2^32 / golden ratio) = 0x9E3779B9, so that phi is exact in integers.
//!
//! Near a latitude the points form a lattice in index and azimuth. It is spanned by the steps of F and F' points,
//! two Fibonacci numbers in a row, which are turned by frac(F G / 2^32) and frac(F' G / 2^32): little, and in
//! opposite directions. Since F frac(F' g) - F' frac(F g) = +-1, how many of each lead from a point to
//! v is a matter of four products. Which pair spans the squarest cells depends on N (1 - z^2) alone.
//!
//! Canonical: every index. Indices from N on read as N - 1. No axis survives exactly.
//!
//! Source: Keinert, Innmann, Sänger and Stamminger, "Spherical Fibonacci Mapping", 2015, which sums it up in
//! floating point; the integers are unitpack's.

use crate::batch::{Decoder, Soa, SoaMut, decode_all};
use crate::error::LengthMismatch;
use crate::formula::{Closest, Formula, One, direction};
use crate::simd::dispatch::{Job, dispatch};
use crate::simd::math::{atan2_half_turns, normalize, sin_cos_quarter_turns, sqrt};
use crate::simd::{Each, Simd, SimdInt, inlined};

/// 2^`BITS` points.
pub(crate) struct Fibonacci<const BITS: u32>;

/// Spherical Fibonacci of any number of points from 1 to 2^24: nearly the same area around each, on a
/// spiral from +Z to -Z. Point i has z = 1 - (2 i + 1) / N and the azimuth 2 pi i / golden ratio, whose turns are
/// counted in units of 2^-32.
///
/// The greatest error is below 2.8 / sqrt(N) radians from two points on, the mean about 1.35 / sqrt(N). [`Fibonacci16`](crate::Fibonacci16) and
/// [`Fibonacci24`](crate::Fibonacci24) are the same of 2^16 and 2^24 points.
///
/// ```
/// use unitpack::SphericalFibonacci;
/// let points = SphericalFibonacci::new(1000).ok_or("not from 1 to 2^24")?;
/// let index = points.encode([0.0, 3.0, 4.0]);
/// let v = points.decode(index);
/// assert!((v[1] - 0.6).abs() < 0.1);
/// assert_eq!(points.encode(v), index);
/// # Ok::<(), &str>(())
/// ```
///
/// Source: Keinert, Innmann, Sänger and Stamminger, "Spherical Fibonacci Mapping", 2015.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SphericalFibonacci {
    n: i32,
}

impl SphericalFibonacci {
    /// So many points: from 1 to 2^24, else `None`.
    #[inline]
    pub const fn new(points: u32) -> Option<Self> {
        if points >= 1 && points <= 1 << 24 {
            Some(SphericalFibonacci { n: points as i32 })
        } else {
            None
        }
    }

    /// How many points there are.
    #[inline]
    pub const fn points(self) -> u32 {
        self.n as u32
    }

    /// The index of the point nearest to a vector of any length. Zero and NaN are taken as +Z, an infinite
    /// component as the limit direction.
    #[inline]
    pub fn encode(self, [x, y, z]: [f32; 3]) -> u32 {
        let mut index = [0];
        self.encode_block::<f32>(&[x], &[y], &[z], &mut index);
        index[0]
    }

    /// A point, of length 1 to 2.5e-7. Indices beyond the last read as the last.
    #[inline]
    pub fn decode(self, index: u32) -> [f32; 3] {
        Decoder::<u32>::decode::<f32>(&self, &[index])
    }

    /// [`encode`](SphericalFibonacci::encode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    pub fn encode_soa(self, v: Soa<'_>, indices: &mut [u32]) -> Result<(), LengthMismatch> {
        LengthMismatch::check_soa(v.x.len(), v.y.len(), v.z.len(), indices.len())?;
        dispatch(EncodePoints { points: self, v, indices });
        Ok(())
    }

    /// [`decode`](SphericalFibonacci::decode) for structures of arrays.
    ///
    /// # Errors
    /// [`LengthMismatch`] if the four slices are not equally long; nothing is written then.
    pub fn decode_soa(self, indices: &[u32], v: SoaMut<'_>) -> Result<(), LengthMismatch> {
        decode_all(&self, indices, v)
    }

    #[inline(always)]
    fn encode_block<V: Simd>(
        self,
        x: &V::Block<f32>,
        y: &V::Block<f32>,
        z: &V::Block<f32>,
        indices: &mut V::Block<u32>,
    ) {
        let v = direction([V::load(x), V::load(y), V::load(z)]);
        V::store_int(nearest(v, self.n), indices, |index, i| *index = i);
    }
}

impl Decoder<u32> for SphericalFibonacci {
    #[inline(always)]
    fn decode<V: Simd>(&self, indices: &V::Block<u32>) -> [V; 3] {
        let index = V::load_int(indices, |i| i);
        let last = V::Int::splat(self.n - 1);
        point(V::Int::select(last.below(index), last, index), self.n)
    }
}

struct EncodePoints<'a> {
    points: SphericalFibonacci,
    v: Soa<'a>,
    indices: &'a mut [u32],
}

impl Job for EncodePoints<'_> {
    #[inline(always)]
    fn run<V: Simd>(self) -> Self {
        let EncodePoints { points, v: Soa { x, y, z }, indices } = self;
        let ((xs, x), (ys, y), (zs, z)) = (V::split(x), V::split(y), V::split(z));
        let (blocks, indices) = V::split_mut(indices);
        for (((x, y), z), indices) in xs.iter().zip(ys).zip(zs).zip(blocks) {
            points.encode_block::<V>(x, y, z, indices);
        }
        EncodePoints { points, v: Soa { x, y, z }, indices }
    }
}

/// 2^32 over the golden ratio.
const G: i32 = 0x9E37_79B9_u32 as i32;

/// The Fibonacci numbers, from F(2) = 1 and F(3) = 2 on.
const NUMBERS: [u32; 20] = {
    let mut numbers = [1; 20];
    numbers[1] = 2;
    let mut i = 2;
    while i < numbers.len() {
        numbers[i] = numbers[i - 1] + numbers[i - 2];
        i += 1;
    }
    numbers
};

/// Point `i`, from 0 to n - 1.
#[inline(always)]
fn point<V: Simd>(i: V::Int, n: i32) -> [V; 3] {
    let per_n = V::splat(1.0 / n as f32);
    // 1 - z and 1 + z.
    let odd = i + i + V::Int::splat(1);
    let (above, below) =
        (V::from_int(odd) * per_n, V::from_int(V::Int::splat(2) * V::Int::splat(n) - odd) * per_n);
    let z = V::from_int(V::Int::splat(n) - odd) * per_n;
    let r = sqrt(above * below);
    let quarter_turns = V::from_int(i * V::Int::splat(G)) * V::splat(1.0 / (1 << 30) as f32);
    let (sin, cos) = sin_cos_quarter_turns(quarter_turns);
    normalize([r * cos, r * sin, z])
}

/// The point nearest to `v`, of n.
#[inline(always)]
fn nearest<V: Simd>(v: [V; 3], n: i32) -> V::Int {
    let one = V::Int::splat(1);
    let last = V::Int::splat(n - 1);
    let [x, y, z] = normalize(v);
    let rr = x * x + y * y;
    // How many points are nearer to the pole of the own hemisphere, from its side, where 1 - |z| is exact.
    let height = V::splat(0.5 * n as f32) * rr / (V::splat(1.0) + z.abs()) - V::splat(0.5);
    let whole = height.round_int_wide();
    let rest = height - V::from_int(whole);
    let lower = z.lt(V::zero());
    let start = V::Int::select(lower, last - whole, whole);
    let rest = V::select(lower, -rest, rest);
    // The turn from there to v, as a fraction of 2^32.
    let azimuth = (atan2_half_turns(y, x) * V::splat((1 << 24) as f32)).round_int_wide().shl(7);
    let turn = azimuth - start * V::Int::splat(G);
    // The squarest cells at about N pi sqrt(5) r^2 = golden ratio^(2 k).
    let square = (V::splat((core::f64::consts::PI * 2.236_067_977 * n as f64) as f32) * rr)
        .greater(V::splat(1.0));
    let log2 =
        V::from_int(square.to_bits() - V::Int::splat(127 << 23)) * V::splat(1.0 / (1 << 23) as f32);
    let k = (log2 * V::splat(0.720_21)).floor().round_int().max(V::Int::splat(2));
    let number = V::gather(&NUMBERS, k - V::Int::splat(2));
    let next = (V::from_int(number) * V::splat(1.618_034)).round_int();
    let turned = inlined(
        #[inline(always)]
        |i: V::Int| V::from_int(i) * V::splat(1.0 / 65536.0 / 65536.0),
    );
    let [by_number, by_next] = [number, next].each(
        #[inline(always)]
        |f| turned(f * V::Int::splat(G)),
    );
    let turn = turned(turn);
    let a = turn * V::from_int(next) - rest * by_next;
    let b = rest * by_number - turn * V::from_int(number);
    let [a, b] = [a, b].each(
        #[inline(always)]
        |c| c.negate_where_negative(by_number).floor().round_int(),
    );
    let corner = start + a * number + b * next;
    let mut closest = Closest::to_unit([x, y, z]);
    for s in [0, 1] {
        for t in [0, 1] {
            let i = corner + V::Int::splat(s) * number + V::Int::splat(t) * next;
            // Beyond a pole, back.
            let i = V::Int::select(i.lt(V::Int::splat(0)), -one - i, i);
            let i = V::Int::select(last.lt(i), last + last + one - i, i);
            let i = i.max(V::Int::splat(0)).min(last);
            closest.consider(i, point(i, n));
        }
    }
    closest.code()
}

impl<const BITS: u32> Formula for Fibonacci<BITS> {
    type Words = One;

    #[inline(always)]
    fn encode<V: Simd>(v: [V; 3]) -> V::Int {
        nearest(v, 1 << BITS)
    }

    #[inline(always)]
    fn decode<V: Simd>(code: V::Int) -> [V; 3] {
        point(code.low(BITS), 1 << BITS)
    }

    #[inline(always)]
    fn canonical<V: Simd>(code: V::Int) -> V::Int {
        code.low(BITS)
    }
}
