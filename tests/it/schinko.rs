//! Table 1 of Schinko, Ullrich and Fellner, "Simple and Efficient Normal Encoding with Error
//! Bounds", 2011, from the decoded points of the angular cube, and the true greatest errors.

use std::collections::HashSet;
use std::f64::consts::FRAC_PI_4;

use unitpack::Format;
use unitpack_test::codes::{decode, encode};
use unitpack_test::random::mixed_vectors;
use unitpack_test::tasks::check_all;
use unitpack_test::vectors::{angle, dot, length, widen};

struct Row {
    bits: u32,
    points: usize,
    /// Distances from each point to its nearest neighbour, degrees: least, greatest and mean.
    published: [&'static str; 3],
    /// Half the mean distance. No encoder meets it.
    error_limit: &'static str,
    /// The greatest error there is, at the corner of a cell, degrees. Not in the paper.
    corner: f64,
}

const TABLE: [Row; 5] = [
    Row {
        bits: 4,
        points: 6,
        published: ["90.00", "90.00", "90.00"],
        error_limit: "45.00",
        corner: 54.736,
    },
    Row {
        bits: 8,
        points: 216,
        published: ["11.93", "14.87", "13.08"],
        error_limit: "6.541",
        corner: 11.309,
    },
    Row {
        bits: 12,
        points: 4_056,
        published: ["2.521", "3.460", "3.030"],
        error_limit: "1.515",
        corner: 2.771,
    },
    Row {
        bits: 16,
        points: 64_896,
        published: ["0.617", "0.865", "0.760"],
        error_limit: "0.380",
        corner: 0.703_05,
    },
    Row {
        bits: 20,
        points: 1_048_344,
        published: ["0.153", "0.215", "0.189"],
        error_limit: "0.095",
        corner: 0.175_58,
    },
];

impl Row {
    fn format(&self) -> Format {
        Format::from_name(&format!("angularcube{}", self.bits)).unwrap()
    }

    /// Every decoded point, normalised.
    fn points(&self) -> Vec<[f64; 3]> {
        let codes: Vec<u128> = (0..self.points as u128).collect();
        let unit = |v: [f32; 3]| {
            let v = widen(v);
            v.map(|c| c / length(v))
        };
        decode(self.format(), &codes).into_iter().map(unit).collect()
    }
}

/// Points on the sphere in the cells of a grid, found by a hash of the cell.
struct Grid<'a> {
    points: &'a [[f64; 3]],
    cell: f64,
    /// The points sorted by hash, and where each hash begins.
    sorted: Vec<u32>,
    begins: Vec<u32>,
}

impl<'a> Grid<'a> {
    /// Finds neighbours within `cell`.
    fn new(points: &'a [[f64; 3]], cell: f64) -> Self {
        let hashes = points.len().next_power_of_two();
        let mut grid =
            Grid { points, cell, sorted: vec![0; points.len()], begins: vec![0; hashes + 1] };
        for &p in points {
            let hash = grid.hash(grid.place(p));
            grid.begins[hash + 1] += 1;
        }
        for i in 0..hashes {
            grid.begins[i + 1] += grid.begins[i];
        }
        let mut next = grid.begins.clone();
        for (i, &p) in points.iter().enumerate() {
            let hash = grid.hash(grid.place(p));
            grid.sorted[next[hash] as usize] = i as u32;
            next[hash] += 1;
        }
        grid
    }

    fn place(&self, p: [f64; 3]) -> [i64; 3] {
        p.map(|c| (c / self.cell).floor() as i64)
    }

    fn hash(&self, [x, y, z]: [i64; 3]) -> usize {
        let mixed = (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15)
            ^ (y as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F)
            ^ (z as u64).wrapping_mul(0x1656_67B1_9E37_79F9);
        (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9) as usize >> 32
            & (self.begins.len() - 2)
    }

    /// The chord to the nearest other point. All points within `cell` are among those looked at.
    fn nearest(&self, index: usize) -> f64 {
        let p = self.points[index];
        let [x, y, z] = self.place(p);
        let mut least = f64::INFINITY;
        for step in 0..27 {
            let place = [x + step % 3 - 1, y + step / 3 % 3 - 1, z + step / 9 - 1];
            let hash = self.hash(place);
            let range = self.begins[hash] as usize..self.begins[hash + 1] as usize;
            for &i in &self.sorted[range] {
                let q = self.points[i as usize];
                let d = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
                if i as usize != index {
                    least = least.min(dot(d, d));
                }
            }
        }
        least.sqrt()
    }
}

/// Least, greatest and mean angle from a point to its nearest neighbour, degrees.
fn neighbour_distances(points: &[[f64; 3]]) -> Result<[f64; 3], String> {
    // Above the greatest distance, as is checked: a point has an area of 4 pi / n.
    let cell = 1.5 * (16.0 * FRAC_PI_4 / points.len() as f64).sqrt();
    let grid = Grid::new(points, cell);
    let [mut least, mut greatest, mut sum] = [f64::INFINITY, 0.0f64, 0.0];
    for i in 0..points.len() {
        let chord = grid.nearest(i);
        if chord > cell {
            return Err(format!("point {i}: no neighbour within {cell}"));
        }
        let degrees = (2.0 * (chord / 2.0).asin()).to_degrees();
        least = least.min(degrees);
        greatest = greatest.max(degrees);
        sum += degrees;
    }
    Ok([least, greatest, sum / points.len() as f64])
}

fn check_published(row: &Row) -> Result<(), String> {
    let points = row.points();
    let distinct: HashSet<_> = points.iter().map(|p| p.map(f64::to_bits)).collect();
    if distinct.len() != row.points {
        return Err(format!("{}: {} points, not {}", row.format(), distinct.len(), row.points));
    }
    let [least, greatest, mean] = neighbour_distances(&points)?;
    eprintln!("{}: {least:.5} {greatest:.5} {mean:.5} {:.5}", row.format(), mean / 2.0);
    let [a, b, c] = row.published;
    for (ours, published) in [(least, a), (greatest, b), (mean, c), (mean / 2.0, row.error_limit)] {
        let decimals = published.len() - published.find('.').unwrap() - 1;
        if format!("{ours:.decimals$}") != published {
            return Err(format!("{}: {ours}, published {published}", row.format()));
        }
    }
    Ok(())
}

#[test]
fn table_1_is_reproduced() {
    check_all(&TABLE, check_published);
}

/// The corners of each point's cell, moved inwards by a ten-thousandth of the edge.
fn corners(row: &Row) -> Vec<[f32; 3]> {
    let side = f64::from(row.points as u32 / 6).sqrt();
    let mut corners = Vec::with_capacity(4 * row.points);
    for p in row.points() {
        let axis = (0..3).max_by(|&i, &j| p[i].abs().total_cmp(&p[j].abs())).unwrap();
        for [right, up] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]] {
            // To half a cell beside the point, in angles over the face.
            let beside = |i: usize, direction: f64| {
                let angle = p[i].atan2(p[axis].abs());
                (angle + direction * 0.9999 * FRAC_PI_4 / side).tan()
            };
            let mut corner = [0.0; 3];
            corner[axis] = p[axis].signum();
            corner[(axis + 1) % 3] = beside((axis + 1) % 3, right);
            corner[(axis + 2) % 3] = beside((axis + 2) % 3, up);
            corners.push(corner.map(|c| c as f32));
        }
    }
    corners
}

fn check_corners(row: &Row) -> Result<(), String> {
    let format = row.format();
    let corners = corners(row);
    let codes = encode(format, &corners);
    // Inside its cell, each has the code of its point.
    for (i, &code) in codes.iter().enumerate() {
        if code != i as u128 / 4 {
            return Err(format!("{format}: {:?} of {} is in {code}", corners[i], i / 4));
        }
    }
    let decoded = decode(format, &codes);
    let errors = corners.iter().zip(decoded).map(|(&a, b)| angle(widen(a), widen(b)).to_degrees());
    let greatest = errors.fold(0.0, f64::max);
    eprintln!("{format}: {greatest:.5}");
    let limit: f64 = row.error_limit.parse().unwrap();
    if (greatest / row.corner - 1.0).abs() > 1e-3 || greatest < 1.2 * limit {
        return Err(format!("{format}: off by {greatest} at a corner, not {}", row.corner));
    }
    Ok(())
}

/// The paper's error limit is half the mean distance between neighbours: the true greatest error is
/// 1.2 to 1.85 times that.
#[test]
fn the_greatest_error_is_at_the_corner_of_a_cell() {
    check_all(&TABLE, check_corners);
}

/// No direction anywhere is further off than the corners.
#[test]
fn no_error_is_greater_than_a_corner() {
    check_all(&TABLE, |row| {
        let format = row.format();
        let vectors: Vec<_> = mixed_vectors(12, 200_000)
            .into_iter()
            .filter(|v| length(widen(*v)).is_normal())
            .collect();
        let decoded = decode(format, &encode(format, &vectors));
        for (&v, w) in vectors.iter().zip(decoded) {
            let error = angle(widen(v), widen(w)).to_degrees();
            if error > row.corner * 1.001 {
                return Err(format!("{format}: {v:?} is off by {error}"));
            }
        }
        Ok(())
    });
}
