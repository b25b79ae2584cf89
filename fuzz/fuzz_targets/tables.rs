//! Decode tables, of every code and of one octant, give the bits that the codec gives.
#![no_main]

use std::sync::OnceLock;

use libfuzzer_sys::fuzz_target;
use unitpack::decode_table::{DecodeTable, FormatTable, OctantTable, SignSymmetric};
use unitpack::*;
use unitpack_fuzz::{
    AnyCodec, Arrays, Bytes, Code, Outcome, UNWRITTEN, Vector, all_bits, bits, native, natives,
};

/// A table of any codec.
trait Table: Send + Sync {
    fn decode(&self, code: Code) -> Vector;
    fn decode_soa(&self, codes: &[Code], v: SoaMut<'_>) -> Outcome;
    /// Of structures of three, four or eight floats.
    fn decode_aos(&self, codes: &[Code], floats: usize, v: &mut [f32]) -> Outcome;
}

macro_rules! table {
    ($fill:ident: $table:ident of $bound:ident) => {
        impl<C: $bound + Send + Sync> Table for $table<'static, C> {
            fn decode(&self, code: Code) -> Vector {
                self.decode(native(code))
            }
            fn decode_soa(&self, codes: &[Code], v: SoaMut<'_>) -> Outcome {
                self.decode_soa(&natives(codes), v)
            }
            fn decode_aos(&self, codes: &[Code], floats: usize, v: &mut [f32]) -> Outcome {
                let codes = &natives(codes);
                match floats {
                    3 => self.decode_aos(codes, v.as_chunks_mut::<3>().0),
                    4 => self.decode_aos(codes, v.as_chunks_mut::<4>().0),
                    _ => self.decode_aos(codes, v.as_chunks_mut::<8>().0),
                }
            }
        }

        fn $fill<C: $bound + Send + Sync>() -> Box<dyn Table> {
            let vectors = vec![[UNWRITTEN; 3]; $table::<C>::LEN].leak();
            Box::new($table::<C>::fill(vectors).expect("it is as long as the table"))
        }
    };
}

table!(whole: DecodeTable of Codec);
table!(octant: OctantTable of SignSymmetric);

/// A codec, its table of one kind, and how to fill it when first asked for.
struct Entry(Format, OnceLock<Box<dyn Table>>, fn() -> Box<dyn Table>);

macro_rules! entries {
    ($($fill:ident: $($codec:ident)*;)*) => {
        [$($(Entry(Format::$codec, OnceLock::new(), $fill::<$codec>),)*)*]
    };
}

static ENTRIES: [Entry; 81] = entries! {
    octant: Oct8 Oct10 Oct12 Oct14 Oct16 WarpedOct16 EqAreaOct16 SixOct16 Octant16 Snorm5x3 HemiOct16 XyOnly16
        Stereo16 StereoConcentric16 StereoEllipse16
        EqArea16 EqAreaConcentric16 EqAreaEllipse16
        EqDist16 EqDistConcentric16 EqDistEllipse16 Cube16 WarpedCube16
        AngularCube4 AngularCube5 AngularCube6 AngularCube7 AngularCube8 AngularCube9
        AngularCube10 AngularCube11 AngularCube12 AngularCube13 AngularCube14 AngularCube15
        AngularCube16;
    whole: Oct8 Oct10 Oct12 Oct14 Oct16 WarpedOct16 EqAreaOct16 SixOct16 Octant16 Snorm5x3 HemiOct16 XyOnly16
        Stereo16 StereoConcentric16 StereoEllipse16
        EqArea16 EqAreaConcentric16 EqAreaEllipse16
        EqDist16 EqDistConcentric16 EqDistEllipse16 Cube16 WarpedCube16
        AngularCube4 AngularCube5 AngularCube6 AngularCube7 AngularCube8 AngularCube9
        AngularCube10 AngularCube11 AngularCube12 AngularCube13 AngularCube14 AngularCube15
        AngularCube16
        Spherical16 LatLong16 LatLong16D PhiZUnorm8x2 OctUnorm8x2 FrontOct16
        QuadFrontOct16 Fibonacci16 Icosphere162;
};

/// The run-time table of a format, filled when first asked for.
fn format_table(format: Format) -> &'static FormatTable<'static> {
    static TABLES: [OnceLock<FormatTable>; 256] = [const { OnceLock::new() }; 256];
    TABLES[format as usize].get_or_init(|| {
        let len = FormatTable::len_for(format).expect("it has at most 16 bits");
        FormatTable::fill(format, vec![[UNWRITTEN; 3]; len].leak()).expect("it is as long")
    })
}

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes(data);
    let Entry(format, table, fill) = bytes.choose(&ENTRIES);
    let table = table.get_or_init(fill);
    let count = bytes.length(100);
    let at = bytes.length(7);
    let codec = AnyCodec::of(*format);
    let codes = codec.codes(&mut bytes, count);
    let expected: Vec<_> = codes.iter().map(|&code| bits((codec.decode)(code))).collect();
    for (&code, expected) in codes.iter().zip(&expected) {
        assert_eq!(bits(table.decode(code)), *expected, "{format} {code:x}");
        assert_eq!(bits(format_table(*format).decode(code as u16)), *expected, "{format} {code:x}");
    }
    let mut soa = Arrays::unwritten([count; 3]);
    table.decode_soa(&codes, soa.write()).unwrap();
    assert_eq!(all_bits(&soa.vectors()), expected, "{format}");

    for floats in [3, 4, 8] {
        let mut structures = vec![UNWRITTEN; floats * count];
        table.decode_aos(&codes, floats, &mut structures).unwrap();
        for (structure, expected) in structures.chunks(floats).zip(&expected) {
            let (v, others) = structure.split_at(3);
            assert_eq!(v.iter().map(|c| c.to_bits()).collect::<Vec<_>>(), expected, "{format}");
            assert!(others.iter().all(|&c| c == UNWRITTEN), "{format} wrote {others:?}");
        }
    }

    let size = format.code_size();
    let mut bytes = vec![0xA5; at];
    bytes.extend(codes.iter().flat_map(|c| c.to_le_bytes()[..size].to_vec()));
    let mut soa = Arrays::unwritten([count; 3]);
    format_table(*format).decode_bytes(&bytes[at..], soa.write()).unwrap();
    assert_eq!(all_bits(&soa.vectors()), expected, "{format}, bytes from {at}");
});
