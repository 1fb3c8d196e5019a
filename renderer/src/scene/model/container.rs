//! The container of a glTF file: JSON alone, or JSON and bytes (GLB).

use std::borrow::Cow;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf_json::Root;
use gltf_json::mesh::Semantic;
use gltf_json::validation::{Checked, Error, Validate};

use super::error::{ModelError, shown};
use super::textures;

/// First bytes of a GLB file.
const MAGIC: &[u8] = b"glTF";
/// Kinds of chunks of a GLB file.
const JSON_CHUNK: &[u8] = b"JSON";
const BINARY_CHUNK: &[u8] = b"BIN\0";

/// Extensions that may be required: what they change of shapes and pictures is read.
const KNOWN: [&str; 2] = ["KHR_texture_transform", "KHR_mesh_quantization"];

/// What the names of extensions begin with that change neither shapes nor pictures, so that a file
/// may require them though they are not read: they are left out, and named.
const HARMLESS: [&str; 6] = [
    "KHR_materials_",
    "KHR_lights_",
    "EXT_lights_",
    "KHR_animation_",
    "KHR_xmp",
    "KHR_audio",
];

/// Whether a file that requires an extension can be used.
fn is_usable(extension: &str) -> bool {
    KNOWN.contains(&extension) || HARMLESS.iter().any(|start| extension.starts_with(start))
}

/// Parts of a document that are not read, so that it does not matter what is wrong with them.
const UNREAD: [&str; 3] = ["animations", "cameras", "skins"];

/// Bytes of a file that a glTF file names, by its name as written there.
pub type Files<'a> = &'a dyn Fn(&str) -> Option<&'a [u8]>;

/// A glTF file that was opened: its JSON is valid as far as it is read, its buffers are not there
/// yet.
#[derive(Debug)]
pub struct Container<'a> {
    root: Root,
    /// The bytes of a GLB file.
    binary: Option<&'a [u8]>,
}

impl<'a> Container<'a> {
    /// Opens the bytes of a `.gltf` or `.glb` file; which of them it is, they tell.
    ///
    /// # Errors
    ///
    /// [`ModelError`] if it is no glTF 2.0 file or requires an unknown extension.
    pub fn open(bytes: &'a [u8]) -> Result<Self, ModelError> {
        let (json, binary) = if bytes.starts_with(MAGIC) {
            chunks(bytes)?
        } else {
            (bytes, None)
        };
        let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
        let root = Root::from_slice(json).map_err(|error| ModelError::Json(error.to_string()))?;
        let version = &root.asset.version;
        if !version.starts_with("2.") {
            let what = format!("{}, but only version 2 is read", shown(version));
            return Err(ModelError::invalid("asset.version", what));
        }
        let mut required = root.extensions_required.iter();
        if let Some(unknown) = required.find(|name| !is_usable(name)) {
            return Err(ModelError::Extension(shown(unknown)));
        }
        check(&root)?;
        Ok(Self { root, binary })
    }

    /// The document.
    pub(super) fn root(&self) -> &Root {
        &self.root
    }

    /// Names of the files beside it that are read, relative to its folder: buffers, then pictures of
    /// base colours. Each comes once.
    pub fn files(&self) -> Vec<(String, FileKind)> {
        let buffers = self.root.buffers.iter();
        let buffers = buffers.filter_map(|buffer| Some((buffer.uri.as_ref()?, FileKind::Buffer)));
        let pictures = textures::images(&self.root).into_iter();
        let pictures = pictures.filter_map(|number| {
            let uri = self.root.images[number].uri.as_ref()?;
            Some((uri, FileKind::Picture))
        });
        let mut files = Vec::new();
        for (uri, kind) in buffers.chain(pictures).filter(|(uri, _)| !is_data(uri)) {
            let file = (decoded(uri), kind);
            if !files.contains(&file) {
                files.push(file);
            }
        }
        files
    }

    /// The bytes of all buffers.
    pub(super) fn buffers(&self, files: Files<'a>) -> Result<Vec<Cow<'a, [u8]>>, ModelError> {
        let buffers = self.root.buffers.iter().enumerate();
        buffers
            .map(|(number, buffer)| {
                let place = || format!("buffers[{number}]");
                let bytes = if let Some(uri) = &buffer.uri {
                    resource(uri, files, &place)?
                } else {
                    let own = self.binary.filter(|_| number == 0);
                    Cow::Borrowed(own.ok_or_else(|| {
                        ModelError::invalid(place(), "has no uri, and the file no bytes for it")
                    })?)
                };
                let claimed = buffer.byte_length.0;
                if (bytes.len() as u64) < claimed {
                    let what = format!("claims {claimed} bytes, but has {}", bytes.len());
                    return Err(ModelError::invalid(place(), what));
                }
                Ok(bytes)
            })
            .collect()
    }
}

/// What a file beside a glTF file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// Bytes of geometry.
    Buffer,
    /// PNG or JPEG.
    Picture,
}

/// The JSON and the bytes of a GLB file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), ModelError> {
    let wrong = |byte: usize, what: String| ModelError::Container { byte, what };
    let number = |at: usize| {
        let four = bytes.get(at..at + 4).and_then(|four| four.try_into().ok());
        let cut_short = || wrong(at, "the file is cut short".to_owned());
        four.map(u32::from_le_bytes).ok_or_else(cut_short)
    };
    let version = number(4)?;
    if version != 2 {
        let what = format!("version {version} of GLB, but only 2 is read");
        return Err(wrong(4, what));
    }
    let length = number(8)? as usize;
    if length > bytes.len() {
        let what = format!(
            "claims {length} bytes, but has {}: it is cut short",
            bytes.len()
        );
        return Err(wrong(8, what));
    }
    let chunk = |at: usize| {
        let claimed = number(at)? as usize;
        let end = at.saturating_add(8).saturating_add(claimed);
        let inside = bytes[..length].get(at + 8..end);
        if let (Some(kind), Some(inside)) = (bytes.get(at + 4..at + 8), inside) {
            return Ok((kind, inside, end));
        }
        let what = format!("a chunk claims {claimed} bytes, more than are left");
        Err(wrong(at, what))
    };
    let (kind, json, mut at) = chunk(12)?;
    if kind != JSON_CHUNK {
        return Err(wrong(16, "the first chunk is not JSON".to_owned()));
    }
    // Chunks of other kinds are passed over.
    while at + 8 <= length {
        let (kind, inside, end) = chunk(at)?;
        if kind == BINARY_CHUNK {
            return Ok((json, Some(inside)));
        }
        at = end;
    }
    Ok((json, None))
}

/// Refuses a document that contradicts itself in what is read of it.
fn check(root: &Root) -> Result<(), ModelError> {
    for (number, mesh) in root.meshes.iter().enumerate() {
        for (part, primitive) in mesh.primitives.iter().enumerate() {
            let place = || format!("meshes[{number}].primitives[{part}]");
            // The validation takes the accessor for granted.
            let positions = primitive
                .attributes
                .get(&Checked::Valid(Semantic::Positions));
            let Some(positions) = positions else {
                return Err(ModelError::invalid(place(), "has no POSITION"));
            };
            if root.accessors.len() <= positions.value() {
                let (index, count) = (positions.value(), root.accessors.len());
                let what = format!("POSITION is accessor {index}, but there are {count}");
                return Err(ModelError::invalid(place(), what));
            }
        }
    }
    let mut first = None;
    root.validate(root, gltf_json::Path::new, &mut |path, error| {
        let path = path().to_string();
        let unread = UNREAD.iter().any(|part| path.starts_with(part));
        // Bounds of positions and attributes with names of one's own.
        let unused = path.contains(".attributes") && error != Error::IndexOutOfBounds;
        let known = error == Error::Unsupported;
        if !(unread || unused || known) && first.is_none() {
            first = Some((path, error));
        }
    });
    match first {
        None => Ok(()),
        Some((path, error)) => {
            let is_source = path.starts_with("textures[") && path.ends_with(".source");
            let mut used = root.extensions_used.iter();
            if let Some(extension) = used.find(|name| is_source && !is_usable(name)) {
                let what = format!(
                    "is missing: the picture may be in the extension {}, which is not read; save the \
                     file with PNG or JPEG pictures",
                    shown(extension)
                );
                return Err(ModelError::invalid(path, what));
            }
            let what = match error {
                Error::IndexOutOfBounds => "names what is not there",
                Error::Invalid => "is not what glTF allows there",
                Error::Missing => "is missing",
                Error::Oversize => "is too large a number",
                Error::Unsupported => "is not supported",
            };
            Err(ModelError::invalid(path, what))
        }
    }
}

fn is_data(uri: &str) -> bool {
    uri.get(..5)
        .is_some_and(|start| start.eq_ignore_ascii_case("data:"))
}

/// The bytes behind an address: those that it holds, or those of a file.
pub(super) fn resource<'f>(
    uri: &str,
    files: Files<'f>,
    place: &dyn Fn() -> String,
) -> Result<Cow<'f, [u8]>, ModelError> {
    if is_data(uri) {
        let bytes = uri
            .split_once(";base64,")
            .map(|(_, text)| STANDARD.decode(text));
        return match bytes {
            Some(Ok(bytes)) => Ok(Cow::Owned(bytes)),
            Some(Err(error)) => {
                let what = format!("its base64 cannot be read: {error}");
                Err(ModelError::invalid(place(), what))
            }
            None => Err(ModelError::invalid(place(), "its data are not base64")),
        };
    }
    let name = decoded(uri);
    let bytes = files(&name).map(Cow::Borrowed);
    bytes.ok_or_else(|| {
        let what = format!("the file {} is not there", shown(&name));
        ModelError::invalid(place(), what)
    })
}

/// A relative address with `%20` and the like as the characters that they stand for.
fn decoded(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, behind @ ..] = rest {
        let pair = behind
            .get(..2)
            .and_then(|pair| std::str::from_utf8(pair).ok());
        let code = pair.and_then(|pair| u8::from_str_radix(pair, 16).ok());
        if let Some(code) = code.filter(|_| *first == b'%') {
            bytes.push(code);
            rest = &behind[2..];
        } else {
            bytes.push(*first);
            rest = behind;
        }
    }
    String::from_utf8(bytes).unwrap_or_else(|_| uri.to_owned())
}
