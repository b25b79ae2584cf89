//! Vectors and codes at which an implementation could round, branch or fold another way than its neighbour.
//! Made of integers, and of float operations that IEEE arithmetic gives one result for.

/// The greatest size of a code in bytes.
pub const CODE: usize = 12;

/// Components with which something special happens. The NaN are quiet and signalling.
const EDGES: [u32; 16] = [
    0x0000_0000, // 0
    0x8000_0000, // -0
    0x3F80_0000, // 1
    0xBF80_0000, // -1
    0x3F7F_FFFF, // the greatest below 1
    0x3F00_0000, // 1/2
    0x0000_0001, // the least subnormal
    0x8000_0001, // and negative
    0x007F_FFFF, // the greatest subnormal
    0x0080_0000, // the least normal
    0x7F7F_FFFF, // the greatest
    0xFF7F_FFFF, // and negative
    0x7F80_0000, // infinity
    0xFF80_0000, // -infinity
    0xFFC0_0001, // NaN
    0x7F80_0001, // NaN
];

/// Bytes of codes at which fields turn over, halves become infinite and signs change.
const TURNS: [u8; 11] = [0x00, 0x01, 0x3C, 0x7B, 0x7C, 0x7F, 0x80, 0x81, 0xBC, 0xFE, 0xFF];

/// A linear congruential generator.
pub struct Random(u64);

impl Random {
    pub fn new() -> Self {
        Random(1)
    }

    pub fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 32) as u32
    }

    /// In 0..n.
    fn below(&mut self, n: u32) -> u32 {
        ((u64::from(self.bits()) * u64::from(n)) >> 32) as u32
    }

    /// In -n..=n.
    fn within(&mut self, n: i32) -> i32 {
        self.below(2 * n as u32 + 1) as i32 - n
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len() as u32) as usize]
    }

    /// Bytes of codes, of any kind.
    pub fn codes(&mut self, size: usize, bytes: &mut [u8]) {
        for code in bytes.chunks_exact_mut(size) {
            match self.below(4) {
                // The ends of the range.
                0 => code.fill(0u8.wrapping_sub(self.below(2) as u8)),
                1 => code.fill_with(|| self.pick(&TURNS)),
                _ => code.fill_with(|| self.bits() as u8),
            }
            // Up to four away.
            if self.below(4) == 0 {
                code[0] = code[0].wrapping_add(self.below(9) as u8).wrapping_sub(4);
            }
        }
    }

    /// A vector of any kind. `decode` is that of the codec in question, with `size` bytes a code of which `bits`
    /// say something.
    pub fn vector(&mut self, size: usize, bits: u32, decode: fn(&[u8]) -> [f32; 3]) -> [f32; 3] {
        let mut v = match self.below(8) {
            0 => [(); 3].map(|()| self.edge()),
            1 => [(); 3].map(|()| f32::from_bits(self.bits())),
            2 => self.between_neighbours(size, bits, decode),
            3 | 4 => self.between_grid_points(),
            5 => self.fold(),
            _ => self.inside(),
        };
        // On an axis, in a plane of two, on the rim of the hemisphere, or hardly off.
        if self.below(6) == 0 {
            v[self.below(3) as usize] = self.pick(&[0.0, -0.0, 1e-3, -1e-5, 1e-7, -1e-12, 1e-40]);
        }
        if self.below(3) == 0 {
            let i = self.below(3) as usize;
            v[i] = self.beside(v[i]);
        }
        let scale = self.pick(&[1.0, 1.0, 1.0, -1.0, 0.3, 7.0, 1e-3, 1e30, 1e-30, 1e-38, 1e-42]);
        v.map(|c| c * scale)
    }

    /// A vector of the plane, or two numbers.
    pub fn pair(&mut self) -> [f32; 2] {
        let [a, b] = [(); 2].map(|()| self.number());
        match self.below(4) {
            // On a diagonal.
            0 => [a, self.pick(&[a, -a])],
            _ => [a, b],
        }
    }

    /// A number of any kind, mostly from -1 to 1: on a grid of 2 to 24 bits, half way between its points, or
    /// beside either.
    pub fn number(&mut self) -> f32 {
        match self.below(6) {
            0 => self.edge(),
            1 => f32::from_bits(self.bits()),
            2 => self.inside()[0],
            _ => {
                let bits = 2 + self.below(23);
                let steps = 2 * ((1 << bits) - self.below(2) as i32);
                let number = self.within(steps) as f32 / steps as f32;
                self.beside(number)
            }
        }
    }

    fn edge(&mut self) -> f32 {
        f32::from_bits(self.pick(&EDGES))
    }

    /// A few units in the last place away, either way.
    fn beside(&mut self, x: f32) -> f32 {
        f32::from_bits(x.to_bits().wrapping_add_signed(self.within(3)))
    }

    /// Anywhere in the cube.
    fn inside(&mut self) -> [f32; 3] {
        [(); 3].map(|()| self.bits() as i32 as f32 / 2_147_483_648.0)
    }

    /// On the codec's grid, or half way between two of its directions: a tie of its nearest code, and of a
    /// parameter on which it is rounded.
    fn between_neighbours(
        &mut self,
        size: usize,
        bits: u32,
        decode: fn(&[u8]) -> [f32; 3],
    ) -> [f32; 3] {
        let mut code = [0; 16];
        code[..size].fill_with(|| self.bits() as u8);
        // Parameters begin at the code's half and thirds.
        let any = self.below(bits);
        let step = self.pick(&[0, bits / 3, bits / 2, 2 * bits / 3, any]);
        let next = u128::from_le_bytes(code).wrapping_add(1 << step).to_le_bytes();
        let (a, b) = (decode(&code[..size]), decode(&next[..size]));
        if self.below(4) == 0 { a } else { [a[0] + b[0], a[1] + b[1], a[2] + b[2]] }
    }

    /// On a grid of 1 to 16 bits a parameter, signed or not, or half way between its points: in the metric of the
    /// octahedron, of the sphere, or of the cube.
    fn between_grid_points(&mut self) -> [f32; 3] {
        let steps = 2 * ((1 << (1 + self.below(16))) - 1);
        let (i, j) = (self.within(steps), self.within(steps));
        let [x, y] = [i as f32, j as f32];
        let mut v = match self.below(3) {
            0 => {
                let z = steps - i.abs() - j.abs();
                // Beyond the fold, the other half of the square.
                let fold = |i: i32, j: i32| (steps - j.abs()) * if i < 0 { -1 } else { 1 };
                let [x, y] =
                    if z < 0 { [fold(i, j), fold(j, i)] } else { [i, j] }.map(|i| i as f32);
                [x, y, z as f32]
            }
            1 => {
                let [i, j, steps] = [i, j, steps].map(i64::from);
                let square = (steps * steps - i * i - j * j).max(0) as u64;
                [x, y, (square << 28).isqrt() as f32 / 16_384.0]
            }
            _ => [x, y, steps as f32],
        };
        if self.below(2) == 0 {
            v[2] = -v[2];
        }
        v.rotate_left(self.below(3) as usize);
        let length = if self.below(2) == 0 { steps as f32 } else { 1.0 };
        v.map(|c| c / length)
    }

    /// Two or three components of one magnitude, or in a simple ratio: diagonals, folds, and the corners and edges
    /// of all that is unfolded somewhere.
    fn fold(&mut self) -> [f32; 3] {
        let [a, b, _] = self.inside();
        let mut v = match self.below(2) {
            0 => [a, -a, b],
            _ => [(); 3].map(|()| self.within(3) as f32 * a),
        };
        v.rotate_left(self.below(3) as usize);
        v
    }
}
