//! Prints a digest of what each codec makes of the same vectors and codes. A computer and a bare Cortex-M4
//! print the same lines: one result everywhere.
#![cfg_attr(target_os = "none", no_std, no_main)]

use core::array;

use unitpack::{Format, Soa, SoaMut};

/// Seven blocks of eight, and seven alone.
const LEN: usize = 63;

/// Components with which something special happens. The others are random.
const EDGES: [f32; 10] =
    [0.0, -0.0, 1.0, -1.0, 0.5, 1e-45, -1e-39, f32::MAX, f32::NEG_INFINITY, f32::NAN];

/// What `encode`, `encode_precise` and `decode` give, digested.
fn digests(format: Format) -> [u64; 3] {
    let mut random = Random(1);
    let [x, y, z]: [[f32; LEN]; 3] = array::from_fn(|_| array::from_fn(|_| random.component()));
    let vectors = Soa { x: &x, y: &y, z: &z };
    let mut codes = [0; 12 * LEN];
    let codes = &mut codes[..format.code_size() * LEN];
    let [mut x, mut y, mut z] = [[0.0; LEN]; 3];

    format.encode(vectors, codes).expect("lengths that fit");
    let encoded = fnv1a(codes.iter().copied());
    format.encode_precise(vectors, codes).expect("lengths that fit");
    let precise = fnv1a(codes.iter().copied());
    codes.fill_with(|| random.next() as u8);
    let decoded = SoaMut { x: &mut x, y: &mut y, z: &mut z };
    format.decode(codes, decoded).expect("lengths that fit");
    let decoded = [x, y, z].into_iter().flatten().flat_map(f32::to_le_bytes);
    [encoded, precise, fnv1a(decoded)]
}

fn fnv1a(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// A linear congruential generator.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 32) as u32
    }

    /// An edge, or anything from -1 to 1.
    fn component(&mut self) -> f32 {
        let random = self.next();
        match EDGES.get((random % 40) as usize) {
            Some(&edge) => edge,
            None => self.next() as i32 as f32 / (1u32 << 31) as f32,
        }
    }
}

fn report() {
    #[cfg(target_os = "none")]
    use cortex_m_semihosting::hprintln as println;

    for &format in Format::ALL {
        let [encode, precise, decode] = digests(format);
        println!("{:14} {:016x} {:016x} {:016x}", format, encode, precise, decode);
    }
}

#[cfg(not(target_os = "none"))]
fn main() {
    report();
}

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    use cortex_m_semihosting::debug;
    use panic_semihosting as _;

    report();
    loop {
        debug::exit(debug::EXIT_SUCCESS);
    }
}
