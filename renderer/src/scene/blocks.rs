//! The blocks of a scene file, each declared once: see [`leafmodel::document`].
//!
//! - **In**: the tree of a file, with overrides applied.
//! - **Out**: an [`Authored`] scene with names resolved and units in SI, or every error of the file;
//!   the same declarations as a schema.
//! - **Always true**: a scene is returned only if there is no error; its numbers are finite
//!   and in range, indices are valid, files lie in the scene's folder.

mod fluorescence;
mod instances;
mod number_rows;
mod object;
mod placement;
mod references;
pub(in crate::scene) mod spectrum;
pub(in crate::scene) mod table_file;
pub(in crate::scene) mod volume;
pub(in crate::scene) mod yields;

use std::rc::Rc;

use leafmodel::document::context::Context;
use leafmodel::document::declared::Declared;
use leafmodel::document::names::{Named, require_title};
use leafmodel::document::reader::Block;
use leafmodel::document::schema::BlockSchema;
use leafmodel::document::sections::Names;
use leafmodel::document::source::Place;
use leafmodel::document::tree::Table;
use leafmodel::document::value_kind::{Flag, Text};
use leafmodel::document::{Keys, NamedList};
use leafmodel::plan_file::{self, EXTRAPOLATE, read_leaves};

pub(crate) use self::references::Purpose;
use super::authored::Authored;
use super::description::film::film;
use super::description::{Camera, Leaf, Picture};

/// All keys at the top of a scene file.
const SECTIONS: [&str; 16] = [
    "format",
    "name",
    "extrapolate",
    "film",
    "picture",
    "camera",
    "integrator",
    "instruments",
    "media",
    "materials",
    "meshes",
    "leaves",
    "solids",
    "plants",
    "lights",
    "objects",
];

/// Reads a whole file. Errors are left in the context; if there is none, the scene is returned.
pub(crate) fn read(
    cx: &Context,
    tree: &Table,
    default_name: &str,
    text: String,
    purpose: Purpose,
) -> Option<Authored> {
    let mut authored = Authored::empty(default_name, text);
    let root = root(cx, tree);
    Keys::read(root, None, |keys| {
        if let Some(root) = keys.reader() {
            let names = references::SECTIONS.map(|section| {
                let names = Names::of(root, section, &SECTIONS);
                (section, Rc::new(names))
            });
            cx.sections.borrow_mut().extend(names);
        }
        scene(&mut authored, keys, purpose);
    });
    (cx.error_count() == 0).then_some(authored)
}

/// Reports why a scene that was read cannot be expanded.
pub(crate) fn refuse(cx: &Context, tree: &Table, path: &[String], problem: String, help: &str) {
    Keys::read(root(cx, tree), None, |keys| {
        let path: Vec<&str> = path.iter().map(String::as_str).collect();
        keys.refuse(&path, problem, help);
        keys.leave(&SECTIONS);
    });
}

/// Reads only the leaves of a file, which may lack everything else. Errors are left in the context.
pub(crate) fn read_only_leaves(cx: &Context, tree: &Table) -> Option<Vec<Named<Leaf>>> {
    // The other sections of a scene are not checked here.
    read_leaves(cx, tree, &plan_file::SECTIONS, Leaf::declare)
}

/// Reads only `[picture]` of a file. Errors are left in the context.
pub(crate) fn read_only_picture(cx: &Context, tree: &Table) -> Option<Picture> {
    let mut picture = Picture::default();
    Keys::read(root(cx, tree), None, |keys| {
        let about = "How the picture to look at is made from the film.";
        keys.block("picture", about, |keys| picture.declare(keys));
        keys.leave(&SECTIONS);
    });
    (cx.error_count() == 0).then_some(picture)
}

/// The schema of a scene file.
pub(crate) fn schema() -> BlockSchema {
    let mut empty = Authored::empty("", String::new());
    Keys::describe(|keys| scene(&mut empty, keys, Purpose::Picture))
}

fn root<'a>(cx: &'a Context, tree: &'a Table) -> Block<'a> {
    let start = Place {
        source: 0,
        span: 0..0,
    };
    Block::new(cx, tree, String::new(), start)
}

/// The keys of a scene.
fn scene(scene: &mut Authored, keys: &mut Keys<'_>, purpose: Purpose) {
    plan_file::format(keys);
    let mut name = None;
    let about = "What the scene is called, and its pictures; left out, as the folder or file is.";
    keys.optional("name", &mut name, Text("a name"), about);
    if let (Some(name), Some(root)) = (name, keys.reader()) {
        let at = root.node("name").map_or(&root.at, |node| &node.at);
        require_title(root.cx, &name, at);
        scene.name = name;
    }
    let mut extrapolate = false;
    keys.key("extrapolate", &mut extrapolate, Flag, EXTRAPOLATE);
    if let Some(root) = keys.reader() {
        root.cx.extrapolate.set(extrapolate);
    }
    // The film comes first, since it sets the wavelengths that spectra must cover.
    let about = "What is recorded, and how well.";
    keys.required_block("film", about, &["rgb", "spectral"], |keys| {
        film(&mut scene.film, keys);
    });
    fluorescence::report_range(keys);
    let about = "How the picture to look at is made from the film.";
    keys.block("picture", about, |keys| scene.picture.declare(keys));
    let about = "Where the scene is seen from.";
    keys.required_block("camera", about, &Camera::kinds(), |keys| {
        scene.camera.declare(keys);
    });
    let about = "How light is followed.";
    keys.block("integrator", about, |keys| scene.integrator.declare(keys));
    let about = "Instruments, which `lamina instruments` reads out.";
    named(keys, "instruments", &mut scene.instruments, about);
    if purpose == Purpose::Instruments {
        set_range(scene, keys);
    }
    sections(scene, keys, purpose);
    if keys.reader().is_some() {
        references::check(scene, keys, purpose);
    }
}

/// From here on spectra must cover what the instruments need, if they are what the scene is read
/// for; `None` if there is none.
fn set_range(scene: &Authored, keys: &Keys<'_>) {
    let Some(block) = keys.reader() else {
        return;
    };
    let ranges = scene.instruments.iter();
    let ranges = ranges.filter_map(|Named { value, .. }| value.range_nm());
    let all = ranges.reduce(|[low, high], [from, to]| [low.min(from), high.max(to)]);
    block.cx.range_nm.set(all);
    block.cx.needed_by.set("an instrument");
}

/// The named blocks.
fn sections(scene: &mut Authored, keys: &mut Keys<'_>, purpose: Purpose) {
    named(keys, "media", &mut scene.media, "What fills bodies.");
    let about = "What surfaces are made of.";
    named(keys, "materials", &mut scene.materials, about);
    named(keys, "meshes", &mut scene.meshes, "Shapes as triangles.");
    named(keys, "leaves", &mut scene.leaves, "Leaves that are grown.");
    named(keys, "solids", &mut scene.solids, "Bodies of solid tissue.");
    let about = "Boughs and shoots that bear leaves.";
    named(keys, "plants", &mut scene.plants, about);
    if purpose == Purpose::Instruments
        && let Some(root) = keys.reader()
    {
        root.cx.range_nm.set(None);
    }
    let about = "Lights; there is one at least.";
    named(keys, "lights", &mut scene.lights, about);
    let about = "What stands in the scene; there is one at least.";
    named(keys, "objects", &mut scene.objects, about);
}

/// A section of blocks with names.
fn named<T: Declared + Default>(
    keys: &mut Keys<'_>,
    name: &'static str,
    blocks: &mut Vec<Named<T>>,
    about: &'static str,
) {
    let list = NamedList {
        required: false,
        new: &|name: &str| Named {
            name: name.to_owned(),
            value: T::default(),
        },
        name_of: |block: &Named<T>| &block.name,
    };
    keys.named(name, blocks, &list, about, |block, keys| {
        block.value.declare(keys);
    });
}
