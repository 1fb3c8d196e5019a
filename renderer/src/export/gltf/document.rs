//! The file: JSON and bytes.

use std::collections::BTreeSet;

use serde_json::{Map, Value, json};

use super::error::GltfError;
use crate::checkpoint::PROGRAM;

/// Numbers of glTF for a component of 16 and 32 bits and for a float.
const SHORT: u32 = 5123;
const INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// A glTF file that is being put together.
#[derive(Debug, Default)]
pub(super) struct GltfDocument {
    bytes: Vec<u8>,
    parts: Map<String, Value>,
    used: BTreeSet<&'static str>,
    required: BTreeSet<&'static str>,
}

impl GltfDocument {
    /// Adds to a list of the file, such as `meshes`, and returns the number there.
    pub(super) fn add(&mut self, list: &str, entry: Value) -> usize {
        let list = self.parts.entry(list).or_insert_with(|| json!([]));
        let list = list.as_array_mut().expect("it was made as a list");
        list.push(entry);
        list.len() - 1
    }

    /// The number of an entry that is in a list already or is added.
    pub(super) fn find_or_add(&mut self, list: &str, entry: Value) -> usize {
        let entries = self.parts.get(list).and_then(Value::as_array);
        let found = entries.and_then(|all| all.iter().position(|other| *other == entry));
        found.unwrap_or_else(|| self.add(list, entry))
    }

    /// Says more of an entry, for programs that know what.
    pub(super) fn describe(&mut self, list: &str, number: usize, extras: Value) {
        self.parts[list][number]["extras"] = extras;
    }

    /// How many entries a list has.
    pub(super) fn count(&self, list: &str) -> usize {
        let entries = self.parts.get(list).and_then(Value::as_array);
        entries.map_or(0, Vec::len)
    }

    /// Notes that an extension is used, without which the file can be read.
    pub(super) fn uses(&mut self, extension: &'static str) -> &'static str {
        self.used.insert(extension);
        extension
    }

    /// Notes that an extension is used, without which the file would show something else.
    pub(super) fn requires(&mut self, extension: &'static str) -> &'static str {
        self.required.insert(extension);
        self.uses(extension)
    }

    /// Adds bytes as a view, which begins at a multiple of four.
    fn view(&mut self, target: Option<u32>, bytes: impl IntoIterator<Item = u8>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({
            "buffer": 0,
            "byteOffset": offset,
            "byteLength": self.bytes.len() - offset,
        });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.add("bufferViews", view)
    }

    /// Adds a picture and its texture, repeated beside it as the words of `wrap` say.
    pub(super) fn texture(&mut self, name: &str, png: &[u8], wrap: [u32; 2]) -> usize {
        let view = self.view(None, png.iter().copied());
        let image = self.add(
            "images",
            json!({ "name": name, "bufferView": view, "mimeType": "image/png" }),
        );
        // Linear, and linear between levels.
        let sampler =
            json!({ "magFilter": 9729, "minFilter": 9987, "wrapS": wrap[0], "wrapT": wrap[1] });
        let sampler = self.find_or_add("samplers", sampler);
        self.add("textures", json!({ "source": image, "sampler": sampler }))
    }

    /// Adds vectors of floats; those of places have their bounds beside them, and those of vertices
    /// a view that says so.
    pub(super) fn vectors<const N: usize>(
        &mut self,
        vectors: &[[f32; N]],
        are_vertices: bool,
        are_bounded: bool,
    ) -> usize {
        let bytes = vectors.as_flattened().iter().flat_map(|n| n.to_le_bytes());
        let view = self.view(are_vertices.then_some(34962), bytes);
        let mut accessor = json!({
            "bufferView": view,
            "componentType": FLOAT,
            "count": vectors.len(),
            "type": format!("VEC{N}"),
        });
        if are_bounded {
            let bound = |of: fn(f32, f32) -> f32| {
                let all = vectors.iter().copied();
                let all = all.reduce(|a, b| std::array::from_fn(|i| of(a[i], b[i])));
                all.unwrap_or([0.0; N]).map(f64::from).to_vec()
            };
            accessor["min"] = bound(f32::min).into();
            accessor["max"] = bound(f32::max).into();
        }
        self.add("accessors", accessor)
    }

    /// Adds the vertices of triangles, of which there are `vertices`.
    pub(super) fn triangles(&mut self, triangles: &[[u32; 3]], vertices: usize) -> usize {
        let indices = triangles.as_flattened();
        // The greatest number of either width would begin a new strip.
        let is_short = u16::try_from(vertices).is_ok();
        let width = if is_short { 2 } else { 4 };
        let bytes = indices
            .iter()
            .flat_map(|i| i.to_le_bytes().into_iter().take(width));
        let view = self.view(Some(34963), bytes);
        self.add(
            "accessors",
            json!({
                "bufferView": view,
                "componentType": if is_short { SHORT } else { INT },
                "count": indices.len(),
                "type": "SCALAR",
            }),
        )
    }

    /// The file, whose scene has these nodes.
    pub(super) fn finish(mut self, name: &str, nodes: &[usize]) -> Result<Vec<u8>, GltfError> {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut root = std::mem::take(&mut self.parts);
        let generator = format!("Lamina {PROGRAM}");
        root.insert(
            "asset".to_owned(),
            json!({ "version": "2.0", "generator": generator }),
        );
        root.insert("scene".to_owned(), json!(0));
        root.insert(
            "scenes".to_owned(),
            json!([{ "name": name, "nodes": nodes }]),
        );
        root.insert(
            "buffers".to_owned(),
            json!([{ "byteLength": self.bytes.len() }]),
        );
        let lists = [
            ("extensionsUsed", self.used),
            ("extensionsRequired", self.required),
        ];
        for (list, names) in lists.into_iter().filter(|(_, names)| !names.is_empty()) {
            root.insert(list.to_owned(), json!(names));
        }
        let mut text = Value::Object(root).to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = 28 + text.len() + self.bytes.len();
        let whole = u32::try_from(length).map_err(|_| GltfError::TooLarge(length))?;
        let mut file = Vec::with_capacity(length);
        let header = [0x4654_6c67, 2, whole, text.len() as u32, 0x4e4f_534a];
        file.extend(header.into_iter().flat_map(u32::to_le_bytes));
        file.extend(text);
        let header = [self.bytes.len() as u32, 0x004e_4942];
        file.extend(header.into_iter().flat_map(u32::to_le_bytes));
        file.extend(self.bytes);
        Ok(file)
    }
}
