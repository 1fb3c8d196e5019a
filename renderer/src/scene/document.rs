//! The scene file as written: TOML with the place of every value, read block by block.
//!
//! - **In**: the tree of a file, overrides already put in.
//! - **Out**: a [`Description`] with names resolved and units in SI, or every error of the file.
//! - **Always true**: a description is given only if there is no error; numbers in it are finite
//!   and in range, indices are valid, files lie in the scene's folder.
//!
//! One file a kind of block; [`reader`] and [`values`] have what they share. Serde's derive is not
//! used, since it stops at the first error and loses the places of values in variants.

mod angle;
mod camera;
mod compound;
mod contents;
pub(crate) mod context;
mod film;
mod instances;
mod layers;
mod leaf;
mod light;
mod limits;
mod material;
mod mesh;
mod mosaic;
pub(crate) mod names;
mod object;
mod outline;
pub(crate) mod overrides;
mod path;
mod petiole;
mod pigments;
mod reader;
mod senescence;
mod solid;
mod spectrum;
mod table_file;
pub(crate) mod tree;
mod values;
mod venation;
pub(crate) mod write;
mod write_compound;
pub(crate) mod write_leaf;
pub(crate) mod write_solid;

use std::collections::BTreeSet;
use std::path::Path;

use camera::{read_camera, read_integrator};
use context::{Context, KnownKey};
use film::{read_film, read_picture};
use names::{Names, require_name};
use object::Shapes;
use reader::Block;
use tree::Table;
use values::integer_at;

use super::description::{Description, Leaf, Light, Named, Object, ObjectShape};
use super::error::SceneError;
use super::source::{Place, Sources};

/// Reads a whole file. Errors are left in the context; without one there is a description.
pub(crate) fn read(
    cx: &Context,
    tree: &Table,
    default_name: &str,
    text: String,
) -> Option<Description> {
    let start = Place {
        source: 0,
        span: 0..0,
    };
    let root = Block::new(cx, tree, String::new(), start);
    read_format(&root);
    let name = root.optional_text("name");
    if let Some((name, at)) = name {
        require_name(cx, name, at);
    }
    cx.extrapolate.set(root.flag_or("extrapolate", false));
    // The film comes first: it says which wavelengths spectra must cover.
    let film = read_film(&root);
    let picture = read_picture(&root);
    let camera = read_camera(&root);
    let integrator = read_integrator(&root);
    let shapes = Shapes {
        meshes: Names::of(&root, "meshes", "mesh"),
        materials: Names::of(&root, "materials", "material"),
        leaves: Names::of(&root, "leaves", "leaf"),
        solids: Names::of(&root, "solids", "solid"),
    };
    let object_names = Names::of(&root, "objects", "object");
    let materials = read_section(&root, "materials", material::read_material);
    let meshes = read_section(&root, "meshes", mesh::read_mesh);
    let leaves = read_section(&root, "leaves", leaf::read_leaf);
    let solids = read_section(&root, "solids", solid::read_solid);
    let lights = read_section(&root, "lights", |block| {
        light::read_light(block, &object_names)
    });
    let objects = read_section(&root, "objects", |block| {
        object::read_object(block, &shapes)
    });
    if Names::of(&root, "lights", "light").are_missing() {
        cx.error_of_the_file(SceneError::NoLight);
    }
    if object_names.are_missing() {
        cx.error_of_the_file(SceneError::NoObject);
    }
    root.finish();
    check_shining(&root, &lights, &objects, &object_names);
    if cx.error_count() > 0 {
        return None;
    }
    let description = Description {
        name: name.map_or(default_name, |(name, _)| name).to_owned(),
        source: text,
        film: film?,
        picture,
        camera: camera?,
        integrator,
        materials: all(materials)?,
        meshes: all(meshes)?,
        leaves: all(leaves)?,
        solids: all(solids)?,
        lights: all(lights)?,
        objects: all(objects)?,
    };
    warn_of_the_unused(&root, &description);
    Some(description)
}

/// Reads only the leaves of a file, which may lack everything else. Errors are left in the context.
pub(crate) fn read_leaves(cx: &Context, tree: &Table) -> Option<Vec<Named<Leaf>>> {
    let start = Place {
        source: 0,
        span: 0..0,
    };
    let root = Block::new(cx, tree, String::new(), start);
    read_format(&root);
    cx.extrapolate.set(root.flag_or("extrapolate", false));
    root.needed("leaves", || "a block `[leaves.NAME]`".to_owned());
    let leaves = read_section(&root, "leaves", leaf::read_leaf);
    for section in names::SECTIONS {
        // What else a scene has is left to whoever renders it.
        root.node(section);
    }
    root.finish();
    all(leaves).filter(|_| cx.error_count() == 0)
}

/// Every key that the leaf `name` of a file may have, paths beginning with `leaves`. Keys of blocks that are left out
/// are among them, those of kinds that were not chosen are not.
pub(crate) fn known_keys(folder: &Path, tree: &Table, name: &str) -> Vec<KnownKey> {
    let cx = Context::new(Sources::default(), folder.to_owned());
    *cx.survey.borrow_mut() = Some(Vec::new());
    let start = Place {
        source: 0,
        span: 0..0,
    };
    let leaf = tree
        .get("leaves")
        .and_then(|entry| entry.node.table()?.get(name));
    if let Some(table) = leaf.and_then(|entry| entry.node.table()) {
        leaf::read_leaf(&Block::new(&cx, table, format!("leaves.{name}"), start));
    }
    let mut keys = cx.survey.take().unwrap_or_default();
    keys.sort_by(|a, b| a.path.cmp(&b.path));
    keys.dedup();
    keys
}

/// Blocks of a section as read; `None` stands for one with an error.
type Section<T> = Vec<Named<Option<T>>>;

fn read_section<T>(
    root: &Block<'_>,
    section: &'static str,
    read: impl Fn(&Block<'_>) -> Option<T>,
) -> Section<T> {
    let Some(blocks) = root.optional_block(section) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for entry in &blocks.table.0 {
        require_name(root.cx, &entry.key, &entry.key_at);
        let value = blocks.open(entry).and_then(|block| read(&block));
        found.push(Named {
            name: entry.key.clone(),
            value,
        });
    }
    found
}

/// All blocks, if none has an error.
fn all<T>(section: Section<T>) -> Option<Vec<Named<T>>> {
    let whole = |Named { name, value }: Named<Option<T>>| value.map(|value| Named { name, value });
    section.into_iter().map(whole).collect()
}

fn read_format(root: &Block<'_>) {
    let wanted = || "`format = 1`, the version of the format".to_owned();
    let Some(node) = root.needed("format", wanted) else {
        return;
    };
    if let Some(format) = integer_at(root.cx, node, "format", 0, u64::MAX)
        && format != 1
    {
        let found = format.to_string();
        root.cx
            .error(&node.at, SceneError::UnsupportedFormat { found });
    }
}

/// An area light needs a mesh object, and an object bears at most one.
fn check_shining(
    root: &Block<'_>,
    lights: &Section<Light>,
    objects: &Section<Object>,
    names: &Names<'_>,
) {
    let mut shining = BTreeSet::new();
    for (index, light) in lights.iter().enumerate() {
        let Some(Light::Area { object, .. }) = light.value else {
            continue;
        };
        let object_read = objects.get(object).and_then(|object| object.value.as_ref());
        let shape = object_read.map(|object| object.shapes[0]);
        let problem = if object_read.is_some_and(|object| object.instances.is_some()) {
            "has instances, and those do not shine"
        } else if matches!(shape, Some(ObjectShape::Leaf { .. })) {
            "is a leaf, and leaves do not shine"
        } else if matches!(shape, Some(ObjectShape::Solid { .. })) {
            "is a body of solid tissue, and those do not shine"
        } else if shining.insert(object) {
            continue;
        } else {
            "has an area light already"
        };
        let at = root
            .table
            .get("lights")
            .and_then(|section| section.node.table()?.0.get(index))
            .map_or(&root.at, |entry| &entry.key_at);
        let error = SceneError::CannotShine {
            object: names.name(object).to_owned(),
            problem: problem.to_owned(),
        };
        root.cx.error(at, error);
    }
}

/// Blocks that nothing refers to are allowed, and mostly a slip.
fn warn_of_the_unused(root: &Block<'_>, description: &Description) {
    let used = |wanted: fn(&ObjectShape) -> Option<usize>| -> BTreeSet<usize> {
        let objects = description.objects.iter();
        objects
            .flat_map(|object| object.value.shapes.iter().filter_map(wanted))
            .collect()
    };
    let meshes = used(|shape| match shape {
        ObjectShape::Mesh { mesh, .. } => Some(*mesh),
        ObjectShape::Leaf { .. } | ObjectShape::Solid { .. } => None,
    });
    let materials = used(|shape| match shape {
        ObjectShape::Mesh { material, .. } => Some(*material),
        ObjectShape::Leaf { .. } | ObjectShape::Solid { .. } => None,
    });
    let leaves = used(|shape| match shape {
        ObjectShape::Leaf { leaf } => Some(*leaf),
        ObjectShape::Mesh { .. } | ObjectShape::Solid { .. } => None,
    });
    let solids = used(|shape| match shape {
        ObjectShape::Solid { solid } => Some(*solid),
        ObjectShape::Mesh { .. } | ObjectShape::Leaf { .. } => None,
    });
    for (section, kind, used) in [
        ("meshes", "mesh", meshes),
        ("materials", "material", materials),
        ("leaves", "leaf", leaves),
        ("solids", "solid", solids),
    ] {
        let entries = root.table.get(section).and_then(|entry| entry.node.table());
        for (index, entry) in entries
            .into_iter()
            .flat_map(|table| table.0.iter().enumerate())
        {
            if !used.contains(&index) {
                let message = format!("no object uses the {kind} `{}`", entry.key);
                root.cx.warn(
                    &entry.key_at,
                    "scene::unused",
                    message,
                    "take it out, or add an object with it",
                );
            }
        }
    }
}
