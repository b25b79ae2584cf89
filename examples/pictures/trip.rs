//! Vectors through a codec and back.

use unitpack::{Format, Soa, SoaMut};

use crate::geometry::{V3, degrees};

#[derive(Default)]
pub struct Vectors {
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
}

impl Vectors {
    fn with_len(count: usize) -> Vectors {
        let zeros = || vec![0.0; count];
        Vectors { x: zeros(), y: zeros(), z: zeros() }
    }

    pub fn len(&self) -> usize {
        self.x.len()
    }

    pub fn push(&mut self, v: V3) {
        let [x, y, z] = v.map(|c| c as f32);
        self.x.push(x);
        self.y.push(y);
        self.z.push(z);
    }

    pub fn iter(&self) -> impl Iterator<Item = V3> {
        self.x.iter().zip(&self.y).zip(&self.z).map(|((&x, &y), &z)| [x, y, z].map(f64::from))
    }

    fn soa(&self) -> Soa<'_> {
        Soa { x: &self.x, y: &self.y, z: &self.z }
    }
}

pub fn decode(format: Format, codes: &[u8]) -> Vectors {
    let mut v = Vectors::with_len(codes.len() / format.code_size());
    let soa = SoaMut { x: &mut v.x, y: &mut v.y, z: &mut v.z };
    format.decode(codes, soa).expect("the lengths fit");
    v
}

#[derive(Clone, Copy)]
pub struct Encoder {
    pub format: Format,
    pub precise: bool,
}

impl Encoder {
    pub fn both(format: Format) -> [Encoder; 2] {
        [false, true].map(|precise| Encoder { format, precise })
    }

    pub fn name(&self) -> &'static str {
        if self.precise { "encode_precise" } else { "encode" }
    }

    pub fn stated_max(&self) -> f64 {
        if self.precise {
            self.format.max_error_precise_degrees()
        } else {
            self.format.max_error_degrees()
        }
    }

    pub fn encode(&self, v: &Vectors) -> Vec<u8> {
        let mut codes = vec![0; v.len() * self.format.code_size()];
        if self.precise {
            self.format.encode_precise(v.soa(), &mut codes)
        } else {
            self.format.encode(v.soa(), &mut codes)
        }
        .expect("the lengths fit");
        codes
    }

    pub fn round_trip(&self, v: &Vectors) -> Vectors {
        decode(self.format, &self.encode(v))
    }

    /// In degrees.
    pub fn errors(&self, v: &Vectors) -> Vec<f64> {
        v.iter().zip(self.round_trip(v).iter()).map(|(a, b)| degrees(a, b)).collect()
    }
}
