//! Normals out of files. An error names the place in the file; the caller adds the path.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::Path;

use base64::{Engine, engine::general_purpose::STANDARD as BASE64};
use gltf::accessor::{DataType, Dimensions};
use gltf::{Accessor, Buffer, Document, Glb, Semantic, buffer::Source, json};

use unitpack_test::Arrays;

type Normals = Result<Vec<[f32; 3]>, String>;
type Reader = fn(&Path, &[u8]) -> Normals;

/// The normals of a file, and how many it has of no direction: zero, NaN or infinite. Those are
/// left out.
pub fn load(path: &Path) -> Result<(Arrays, usize), String> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let read: Reader = match extension.as_str() {
        "obj" => obj,
        "glb" | "gltf" => gltf,
        "bin" | "raw" | "f32" => raw,
        _ => {
            return Err("unknown kind of file: the extension must be .obj, .glb, .gltf or, for \
                 little-endian f32 triples, .bin, .raw or .f32"
                .into());
        }
    };
    let bytes = fs::read(path).map_err(|e| e.to_string())?;
    if bytes.is_empty() {
        return Err("the file is empty".into());
    }
    let normals = read(path, &bytes)?;
    let has_direction =
        |v: &&[f32; 3]| v.iter().all(|c| c.is_finite()) && v.iter().any(|&c| c != 0.0);
    let vectors: Arrays = normals.iter().filter(has_direction).copied().collect();
    match (normals.len(), vectors.count()) {
        (0, _) => Err("the file has no normals".into()),
        (all, 0) => {
            Err(format!("none of the {all} normals has a direction: zero, NaN or infinite"))
        }
        (all, good) => Ok((vectors, all - good)),
    }
}

fn raw(_: &Path, bytes: &[u8]) -> Normals {
    let (triples, rest) = bytes.as_chunks::<12>();
    if !rest.is_empty() {
        return Err(format!(
            "byte {}: the last {} bytes are no whole triple of f32 (12 bytes)",
            bytes.len() - rest.len(),
            rest.len()
        ));
    }
    Ok(triples.iter().map(|bytes| vector(DataType::F32, bytes)).collect())
}

/// Every normal of the file, used or not. Loaders for OBJ give those that faces use, once for each
/// object, so that a zero normal beside the surface would not be counted and a cloud of points
/// would have none. They stand one on a line.
fn obj(_: &Path, bytes: &[u8]) -> Normals {
    // Comments and names may be in Latin-1.
    let text = String::from_utf8_lossy(bytes).replace("\r\n", "\n");
    let lines = text.trim_start_matches('\u{feff}').split(['\n', '\r']);
    let mut normals = Vec::new();
    for (i, line) in lines.enumerate() {
        let mut words = line.split_whitespace();
        if words.next() == Some("vn") {
            let numbers: Vec<f32> = words.map_while(|word| word.parse().ok()).take(3).collect();
            let normal = numbers.try_into();
            normals.push(normal.map_err(|_| format!("line {}: a normal is three numbers", i + 1))?);
        }
    }
    Ok(normals)
}

/// The vertex normals of all meshes. Those that several primitives share come once.
fn gltf(path: &Path, bytes: &[u8]) -> Normals {
    let (json, blob) = if bytes.starts_with(b"glTF") {
        let declared = bytes.get(8..12).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
        match declared {
            Some(length) if (12..=bytes.len()).contains(&(length as usize)) => {}
            Some(length) => {
                let found = bytes.len();
                return Err(format!(
                    "byte 8: the header says {length} bytes, the file has {found}"
                ));
            }
            None => return Err(format!("byte {}: the header is cut off", bytes.len())),
        }
        let glb = Glb::from_slice(bytes).map_err(|e| format!("GLB chunks: {e}"))?;
        (glb.json, glb.bin)
    } else if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb")) {
        return Err("byte 0: not a GLB file, which begins with \"glTF\"".into());
    } else {
        (bytes.into(), None)
    };
    let mut root = json::Root::from_slice(&json).map_err(|e| format!("JSON: {e}"))?;
    // What else a renderer must know does not matter for normals.
    let required = std::mem::take(&mut root.extensions_required);
    if let Some(extension) = required.iter().find(|name| name.ends_with("_compression")) {
        return Err(format!("compressed meshes ({extension}) are not supported"));
    }
    let document = Document::from_json(root).map_err(|error| match error {
        gltf::Error::Validation(errors) => {
            let (place, error) = &errors[0];
            format!("JSON, {place}: {error}")
        }
        error => error.to_string(),
    })?;

    let mut buffers = Buffers { path, blob: blob.as_deref(), read: HashMap::new() };
    let (mut normals, mut seen) = (Vec::new(), HashSet::new());
    for mesh in document.meshes() {
        for primitive in mesh.primitives() {
            let Some(accessor) = primitive.get(&Semantic::Normals) else { continue };
            if seen.insert(accessor.index()) {
                let place = format!("mesh {}, primitive {}", mesh.index(), primitive.index());
                let read = read_accessor(&accessor, &mut buffers);
                normals.extend(
                    read.map_err(|e| format!("{place}, accessor {}: {e}", accessor.index()))?,
                );
            }
        }
    }
    Ok(normals)
}

fn read_accessor(accessor: &Accessor<'_>, buffers: &mut Buffers<'_>) -> Normals {
    // Integers stand for fractions of the greatest one. Only the direction matters here, so they
    // stay as they are.
    let kind = accessor.data_type();
    let (DataType::F32 | DataType::I16 | DataType::I8) = kind else {
        return Err(format!("normals of type {kind:?} are not supported"));
    };
    if accessor.dimensions() != Dimensions::Vec3 {
        return Err(format!("normals are {:?}, not Vec3", accessor.dimensions()));
    }
    if accessor.sparse().is_some() {
        return Err("sparse normals are not supported".into());
    }
    let view = accessor.view().ok_or("the normals are in no buffer view")?;
    let data = buffers
        .get(&view.buffer())
        .map_err(|e| format!("buffer {}: {e}", view.buffer().index()))?
        .get(view.offset()..)
        .and_then(|bytes| bytes.get(..view.length()))
        .and_then(|bytes| bytes.get(accessor.offset()..))
        .ok_or_else(|| format!("buffer view {} lies outside of its buffer", view.index()))?;
    let stride = view.stride().unwrap_or(accessor.size());
    let normal = |i| {
        let bytes = data.get(i * stride..).and_then(|bytes| bytes.get(..accessor.size()));
        let all = accessor.count();
        let outside =
            || format!("normal {i} of {all} lies outside of buffer view {}", view.index());
        bytes.map(|bytes| vector(kind, bytes)).ok_or_else(outside)
    };
    (0..accessor.count()).map(normal).collect()
}

/// Three little-endian numbers.
fn vector(kind: DataType, bytes: &[u8]) -> [f32; 3] {
    [0, 1, 2].map(|i| {
        let component = &bytes[i * kind.size()..];
        match (kind, component) {
            (DataType::F32, &[a, b, c, d, ..]) => f32::from_le_bytes([a, b, c, d]),
            (DataType::I16, &[a, b, ..]) => i16::from_le_bytes([a, b]).into(),
            (_, component) => component[0].cast_signed().into(),
        }
    })
}

/// The buffers of a glTF file, read when first needed.
struct Buffers<'a> {
    path: &'a Path,
    /// The BIN chunk of a GLB file.
    blob: Option<&'a [u8]>,
    read: HashMap<usize, Cow<'a, [u8]>>,
}

impl<'a> Buffers<'a> {
    fn get(&mut self, buffer: &Buffer<'_>) -> Result<&[u8], String> {
        let bytes = match self.read.remove(&buffer.index()) {
            Some(bytes) => bytes,
            None => self.fetch(buffer)?,
        };
        Ok(self.read.entry(buffer.index()).or_insert(bytes))
    }

    fn fetch(&self, buffer: &Buffer<'_>) -> Result<Cow<'a, [u8]>, String> {
        match buffer.source() {
            Source::Bin => {
                let blob = self.blob.filter(|_| buffer.index() == 0);
                blob.map(Cow::from).ok_or_else(|| "it has neither a uri nor a BIN chunk".into())
            }
            Source::Uri(uri) if uri.starts_with("data:") => {
                let (_, data) = uri.split_once(";base64,").ok_or("its data uri is not base64")?;
                BASE64.decode(data).map(Cow::from).map_err(|e| format!("its data uri: {e}"))
            }
            Source::Uri(uri) if uri.contains("://") => Err(format!("{uri}: only files are read")),
            Source::Uri(uri) => {
                let file = self.path.with_file_name(percent_decode(uri));
                fs::read(&file).map(Cow::from).map_err(|e| format!("{}: {e}", file.display()))
            }
        }
    }
}

/// A uri's bytes, with `%20` for a space and the like.
fn percent_decode(uri: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let [first, tail @ ..] = rest {
        let code = tail.get(..2).and_then(|hex| str::from_utf8(hex).ok());
        match code.and_then(|hex| u8::from_str_radix(hex, 16).ok()) {
            Some(byte) if *first == b'%' => {
                bytes.push(byte);
                rest = &tail[2..];
            }
            _ => {
                bytes.push(*first);
                rest = tail;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
