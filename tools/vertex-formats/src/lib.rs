//! Checks the table of vertex formats on the page of `unitpack::padded` against `wgpu_types`, what the names of other
//! APIs say, and what the codecs write: `cargo test -p vertex-formats`.
#![cfg(test)]

use bytemuck::bytes_of;
use unitpack::padded::{Padded, PaddedCodec, W};
use unitpack::{Codec, padded};
use wgpu_types::VertexFormat;

const PAGE: &str = include_str!("../../../src/padded.rs");

/// How a component is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Snorm,
    Unorm,
    Float,
    Uint,
}

/// What a name says: how components are read, and the bits of each, the first in the low bits.
type Fields = (Kind, Vec<u32>);

/// A row of the table. "-" is `None`.
#[derive(Debug)]
struct Row {
    code: String,
    wgpu: Option<String>,
    vulkan: Option<String>,
    dxgi: Option<String>,
    metal: Option<String>,
    gl: Option<String>,
    gltf: Option<String>,
    /// The name of each field and its bits.
    fields: Vec<(String, u32)>,
}

fn rows() -> Vec<Row> {
    let (_, table) = PAGE.split_once("//! | code | `wgpu::VertexFormat` |").expect("the table");
    let rows = table.lines().skip(2).map_while(|line| line.strip_prefix("//! | "));
    rows.map(|row| {
        let cells: Vec<&str> = row.trim_end_matches(" |").split(" | ").collect();
        let [code, wgpu, vulkan, dxgi, metal, gl, gltf, fields] = cells[..] else {
            panic!("{} cells in {row}", cells.len())
        };
        let name = |cell: &str| {
            let quoted = cell.strip_prefix('`').and_then(|name| name.strip_suffix('`'));
            assert!(quoted.is_some() || cell == "-", "{cell} in {row}");
            quoted.map(str::to_owned)
        };
        let fields = fields.split(", ").map(|field| {
            let (name, bits) = field.split_once(' ').expect("a field and its bits");
            (name.to_owned(), bits.parse().expect("bits"))
        });
        Row {
            code: code.split('`').nth(1).expect("a link").to_owned(),
            wgpu: name(wgpu),
            vulkan: name(vulkan),
            dxgi: name(dxgi),
            metal: name(metal),
            gl: name(gl),
            gltf: name(gltf),
            fields: fields.collect(),
        }
    })
    .collect()
}

impl Row {
    /// A single integer has no fields where it is read.
    fn bits(&self, kind: Kind) -> Vec<u32> {
        let bits = self.fields.iter().map(|field| field.1);
        if kind == Kind::Uint { vec![bits.sum()] } else { bits.collect() }
    }

    fn code(&self) -> &'static Code {
        let code = CODES.iter().find(|code| code.name == self.code);
        code.unwrap_or_else(|| panic!("{} is in no list of this tool", self.code))
    }
}

/// A code or an element.
struct Code {
    name: &'static str,
    size: usize,
    /// Its bytes, little-endian.
    encode: fn([f32; 3]) -> Vec<u8>,
}

macro_rules! codes {
    (padded { $($padded:ident)* } codecs { $($codec:ident)* }) => {
        const CODES: &[Code] = &[
            $(Code {
                name: stringify!($padded),
                size: element_size::<padded::$padded>(),
                encode: |v| little_endian(padded::$padded::encode(v, W::Zero)),
            },)*
            $(Code {
                name: stringify!($codec),
                size: size_of::<<unitpack::$codec as Codec>::Code>(),
                encode: |v| little_endian(unitpack::$codec::encode(v)),
            },)*
        ];
    };
}

codes! {
    padded {
        Snorm8x4 Snorm12x4 Snorm16x4 Float16x4 Unorm8x4 Unorm16x4 Unorm10_10_10_2 Snorm10_10_10_2
    }
    codecs {
        Snorm8x3 Snorm12x3 Snorm16x3 Float16x3 XyzUnorm8x3 XyzUnorm16x3 XyzUnorm10x3 Snorm10x3 Float32x3
        Oct8 Oct16 Oct20 Oct32 OctUnorm8x2 OctUnorm16x2 HemiOct16 HemiOct32 XyOnly16 XyOnly32 XyOnly32F
        XyOnlySnorm16 XyOnlyNormalized16 XyOnlyBiased16 PhiZUnorm8x2 PhiZUnorm16x2
    }
}

trait Element {
    const SIZE: usize;
}

impl<C: PaddedCodec> Element for Padded<C> {
    const SIZE: usize = size_of::<C::Element>();
}

const fn element_size<P: Element>() -> usize {
    P::SIZE
}

fn little_endian<T: bytemuck::Pod>(code: T) -> Vec<u8> {
    let mut bytes = bytes_of(&code).to_vec();
    if cfg!(target_endian = "big") {
        bytes.chunks_mut(align_of::<T>()).for_each(<[u8]>::reverse);
    }
    bytes
}

/// The formats of `wgpu` by their names.
macro_rules! wgpu_formats {
    ($($name:ident)*) => {
        fn wgpu_format(name: &str) -> VertexFormat {
            match name {
                $(stringify!($name) => VertexFormat::$name,)*
                _ => panic!("{name} is in no list of this tool"),
            }
        }
    };
}

wgpu_formats! {
    Uint8 Uint16 Uint32 Unorm8x2 Unorm8x4 Snorm8x2 Snorm8x4 Unorm16x2 Unorm16x4 Snorm16x2 Snorm16x4 Float16x2
    Float16x4 Float32x3 Unorm10_10_10_2
}

/// `Snorm8x4`, `Unorm10_10_10_2`.
fn of_wgpu(name: &str) -> Fields {
    let digits = name.find(|c: char| c.is_ascii_digit()).expect("bits");
    let kind = match &name[..digits] {
        "Snorm" => Kind::Snorm,
        "Unorm" => Kind::Unorm,
        "Float" => Kind::Float,
        "Uint" => Kind::Uint,
        kind => panic!("{kind} of {name}"),
    };
    let number = |text: &str| text.parse::<u32>().expect("a number");
    let bits = match name[digits..].split_once('x') {
        Some((bits, count)) => vec![number(bits); number(count) as usize],
        None => name[digits..].split('_').map(number).collect(),
    };
    (kind, bits)
}

/// `R8G8B8_SNORM`, `A2B10G10R10_UNORM_PACK32`: a packed word begins with its high bits.
fn of_channels(name: &str) -> Fields {
    let mut parts = name.split('_');
    let (channels, kind) = (parts.next().expect("channels"), parts.next().expect("a kind"));
    let kind = match kind {
        "SNORM" => Kind::Snorm,
        "UNORM" => Kind::Unorm,
        "SFLOAT" | "FLOAT" => Kind::Float,
        "UINT" => Kind::Uint,
        _ => panic!("{kind} of {name}"),
    };
    let mut fields: Vec<(char, u32)> = channels.split_inclusive(|c: char| c.is_ascii_digit()).fold(
        Vec::new(),
        |mut fields, part| {
            let digit = part.chars().last().and_then(|c| c.to_digit(10)).expect("a digit");
            match (part.len(), fields.last_mut()) {
                (1, Some((_, bits))) => *bits = 10 * *bits + digit,
                _ => fields.push((part.chars().next().expect("a channel"), digit)),
            }
            fields
        },
    );
    if parts.next().is_some() {
        fields.reverse();
    }
    let order: String = fields.iter().map(|field| field.0).collect();
    assert!("RGBA".starts_with(&order), "{order} of {name}");
    (kind, fields.into_iter().map(|field| field.1).collect())
}

/// `char4Normalized`, `uint1010102Normalized`, `half2`, `uint`.
fn of_metal(name: &str) -> Fields {
    let (name, normalized) = match name.strip_suffix("Normalized") {
        Some(name) => (name, true),
        None => (name, false),
    };
    let base = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let kind = match (base, normalized) {
        ("char" | "short" | "int", true) => Kind::Snorm,
        ("uchar" | "ushort" | "uint", true) => Kind::Unorm,
        ("half" | "float", false) => Kind::Float,
        ("uchar" | "ushort" | "uint", false) => Kind::Uint,
        _ => panic!("{name}"),
    };
    let bits = match base.trim_start_matches('u') {
        "char" => 8,
        "short" | "half" => 16,
        _ => 32,
    };
    let bits = match &name[base.len()..] {
        "1010102" => vec![10, 10, 10, 2],
        "" => vec![bits],
        count => vec![bits; count.parse().expect("a number of components")],
    };
    (kind, bits)
}

/// The number of components, the component type and whether it is normalized: `4 BYTE normalized` of GL, `VEC4 BYTE
/// normalized` of glTF.
fn of_components(name: &str) -> Fields {
    let words: Vec<&str> = name.split(' ').collect();
    let (count, component, normalized) = match words[..] {
        [count, component] => (count, component, false),
        [count, component, "normalized"] => (count, component, true),
        _ => panic!("{name}"),
    };
    let count = match count {
        "SCALAR" => 1,
        _ => count.trim_start_matches("VEC").parse().expect("a number of components"),
    };
    let is_unsigned = component.starts_with("UNSIGNED_");
    let (bits, is_float) = match component.trim_start_matches("UNSIGNED_") {
        "BYTE" => (vec![8; count], false),
        "SHORT" => (vec![16; count], false),
        "INT" => (vec![32; count], false),
        "INT_2_10_10_10_REV" => (vec![10, 10, 10, 2], false),
        "HALF_FLOAT" => (vec![16; count], true),
        "FLOAT" => (vec![32; count], true),
        _ => panic!("{name}"),
    };
    assert_eq!(bits.len(), count, "{name}");
    let kind = match (is_float, normalized, is_unsigned) {
        (true, false, false) => Kind::Float,
        (false, true, true) => Kind::Unorm,
        (false, true, false) => Kind::Snorm,
        (false, false, true) => Kind::Uint,
        _ => panic!("{name}"),
    };
    (kind, bits)
}

#[test]
fn every_element_is_in_the_table_once() {
    let rows: Vec<String> = rows().into_iter().map(|row| row.code).collect();
    for code in CODES {
        assert_eq!(rows.iter().filter(|row| *row == code.name).count(), 1, "{}", code.name);
    }
    assert_eq!(rows.len(), CODES.len());
}

#[test]
fn formats_of_wgpu_have_the_size_of_their_codes() {
    for row in rows() {
        let size = row.code().size;
        let bits: u32 = row.fields.iter().map(|field| field.1).sum();
        assert_eq!(bits as usize, 8 * size, "{}", row.code);
        if let Some(name) = &row.wgpu {
            assert_eq!(wgpu_format(name).size(), size as u64, "{}: {name}", row.code);
        }
    }
}

#[test]
fn all_names_of_a_row_say_the_same() {
    for row in rows() {
        let code = &row.code;
        let all = [
            row.wgpu.as_deref().map(of_wgpu),
            row.vulkan.as_deref().map(of_channels),
            row.dxgi.as_deref().map(of_channels),
            row.metal.as_deref().map(of_metal),
            row.gl.as_deref().map(of_components),
            row.gltf.as_deref().map(of_components),
        ];
        let all: Vec<Fields> = all.into_iter().flatten().collect();
        let kind = all.first().unwrap_or_else(|| panic!("{code} has no name")).0;
        for fields in &all {
            assert_eq!(*fields, (kind, row.bits(kind)), "{code}: {row:?}");
        }
        let is_named = |name: &str| code.contains(name);
        match kind {
            Kind::Float => assert!(is_named("Float") || is_named("32F"), "{code}"),
            Kind::Unorm => assert!(is_named("Unorm") || is_named("XyOnly"), "{code}"),
            Kind::Snorm => assert!(is_named("Snorm") || is_named("Oct"), "{code}"),
            Kind::Uint => assert!(is_named("Oct"), "{code}"),
        }
    }
}

/// The order of the fields is what encoders write: along an axis its own field is the greatest.
#[test]
fn fields_stand_where_the_table_says() {
    for row in rows() {
        let code = row.code();
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let mut v = [0.0; 3];
            v[axis] = 1.0;
            let bytes = (code.encode)(v);
            let bits = bytes.iter().rev().fold(0u128, |bits, byte| bits << 8 | u128::from(*byte));
            let mut at = 0;
            let fields: Vec<(&str, u128)> = row
                .fields
                .iter()
                .map(|(name, width)| {
                    let field = bits >> at & ((1 << width) - 1);
                    at += width;
                    (name.as_str(), field)
                })
                .collect();
            // The square of octahedral codes has x and y as its axes.
            let name = match (name, row.fields.iter().any(|field| field.0 == "u")) {
                ("x", true) => "u",
                ("y", true) => "v",
                _ => name,
            };
            let of = fields.iter().find(|field| field.0 == name).map(|field| field.1);
            // The hemispherical octahedron is turned, so that neither is.
            if let Some(of) = of.filter(|_| !code.name.starts_with("Hemi")) {
                let greatest = fields.iter().map(|field| field.1).max();
                assert_eq!(Some(of), greatest, "{}: {fields:?}", code.name);
                let others = fields.iter().filter(|field| field.1 == of).count();
                assert_eq!(others, 1, "{}: {fields:?}", code.name);
            }
        }
    }
}
