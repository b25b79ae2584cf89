//! Vectors through a codec and back.

use unitpack::Format;
use unitpack_test::codes::{decode_slice, encode_slice};
use unitpack_test::vectors::angle;
use unitpack_test::{Arrays, Effort};

pub fn decode(format: Format, codes: &[u8]) -> Arrays {
    let mut v = Arrays::unwritten([codes.len() / format.code_size(); 3]);
    decode_slice(format, codes, v.write()).expect("the lengths fit");
    v
}

#[derive(Clone, Copy)]
pub struct Encoder {
    pub format: Format,
    pub effort: Effort,
}

impl Encoder {
    pub fn both(format: Format) -> [Encoder; 2] {
        Effort::BOTH.map(|effort| Encoder { format, effort })
    }

    pub fn name(&self) -> &'static str {
        match self.effort {
            Effort::Fast => "encode",
            Effort::Precise => "encode_precise",
        }
    }

    pub fn stated_max(&self) -> f64 {
        match self.effort {
            Effort::Fast => self.format.max_error_degrees(),
            Effort::Precise => self.format.max_error_precise_degrees(),
        }
    }

    pub fn encode(&self, v: &Arrays) -> Vec<u8> {
        let mut codes = vec![0; v.count() * self.format.code_size()];
        encode_slice(self.format, self.effort, v.read(), &mut codes).expect("the lengths fit");
        codes
    }

    pub fn round_trip(&self, v: &Arrays) -> Arrays {
        decode(self.format, &self.encode(v))
    }

    /// In degrees.
    pub fn errors(&self, v: &Arrays) -> Vec<f64> {
        v.wide().zip(self.round_trip(v).wide()).map(|(a, b)| angle(a, b).to_degrees()).collect()
    }
}
