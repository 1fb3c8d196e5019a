//! Plans of leaves and of bodies of solid tissue as files.
//!
//! Each block is declared once, in the file of its name below; see [`crate::document`]. A file with
//! leaves reads and writes without the renderer:
//!
//! ```
//! use std::path::Path;
//!
//! use leafmodel::plan_file;
//!
//! let text = "format = 1\n[leaves.mine]\npreset = \"poplar\"\nlength_mm = 90\n";
//! let leaves = plan_file::parse(text, "mine.toml", Path::new("."), &[])?;
//! assert_eq!(leaves[0].value.length_mm, 90.0);
//! // Only what differs from the preset is written.
//! let written = plan_file::leaf_beside_preset("mine", &leaves[0].value, "poplar");
//! assert_eq!(written.lines().last(), Some("length_mm = 90"));
//! # Ok::<(), leafmodel::document::report::DocumentErrors>(())
//! ```
//!
//! - **In**: a file, its text, or a plan.
//! - **Out**: plans, or everything that is wrong; text that reads back to the same plan.
//! - **Always true**: a plan that was read is within all ranges, and its outline can be grown.
//! - **Left out**: pictures and meshes are decoded by whoever has a decoder
//!   ([`crate::document::assets`]); the surface of a leaf (coats, ratio of its faces) belongs to a
//!   scene.

mod compound;
mod leaf;
pub mod one_leaf;
mod plant;
mod presets;
#[cfg(test)]
mod tests;

use std::path::Path;

pub use self::leaf::leaf;
pub use self::plant::{plant, plant_preset, usual_plant};
pub use self::presets::{colour_preset, leaf_preset};
use crate::blade::senescence::Senescence;
use crate::document::assets::Assets;
use crate::document::coverage::require_coverage;
use crate::document::names::Named;
use crate::document::reader::Block;
use crate::document::report::DocumentErrors;
use crate::document::schema::{BlockSchema, Type};
use crate::document::source::Place;
use crate::document::values::integer_at;
use crate::document::write::to_toml;
use crate::document::written::{Extent, Written};
use crate::document::{
    Context, DocumentError, Flag, Keys, Kind, Limits, NamedList, Node, Opened, Table, Value,
};
use crate::leaf::LeafPlan;
pub use crate::optics::contents_keys::{changed_contents, contents};
use crate::plant::PlantPlan;
use crate::species;

/// Where PROSPECT-D's table has figures, nm.
const PROSPECT_NM: [f64; 2] = [400.0, 2500.0];

/// Days for which a leaf may have aged.
pub const DAYS: Limits = Senescence::DAYS;

/// Keys of a leaf's block that belong to a scene: how it scatters light.
const SURFACE: [&str; 6] = [
    "abaxial_ratio",
    "adaxial",
    "abaxial",
    "optics",
    "fluorescence",
    "light_spread",
];

/// Reads the leaves of the file at `path`, with overrides `key=value` written as in the file.
///
/// # Errors
///
/// [`DocumentErrors`] with everything that is wrong with the leaves and the overrides; what else
/// the file holds is not looked at.
pub fn load(path: &Path, overrides: &[String]) -> Result<Vec<Named<LeafPlan>>, DocumentErrors> {
    leaves_of(Opened::file(path, overrides, schema)?)
}

/// As [`load`], for leaves of which only margin and veins are wanted: their contents need not be
/// said. `assets` reads what the file names.
///
/// # Errors
///
/// As [`load`].
pub fn load_veins(
    path: &Path,
    assets: Option<&'static dyn Assets>,
    overrides: &[String],
) -> Result<Vec<Named<LeafPlan>>, DocumentErrors> {
    let mut opened = Opened::file(path, overrides, schema)?;
    opened.cx.assets = assets;
    let leaves = plans_of_veins(&opened);
    opened.finish(leaves).map(|(leaves, _)| leaves)
}

/// Reads the leaves of a text. `file_name` is what reports call it; paths start at `folder`.
///
/// # Errors
///
/// As [`load`].
pub fn parse(
    text: &str,
    file_name: &str,
    folder: &Path,
    overrides: &[String],
) -> Result<Vec<Named<LeafPlan>>, DocumentErrors> {
    leaves_of(Opened::text(text, file_name, folder, overrides, schema)?)
}

fn leaves_of(opened: Opened) -> Result<Vec<Named<LeafPlan>>, DocumentErrors> {
    let leaves = plans(&opened);
    opened.finish(leaves).map(|(leaves, _)| leaves)
}

fn plans(opened: &Opened) -> Option<Vec<Named<LeafPlan>>> {
    read_leaves(&opened.cx, &opened.tree, &SECTIONS, whole_leaf)
}

/// As [`plans`], but contents need not be said.
fn plans_of_veins(opened: &Opened) -> Option<Vec<Named<LeafPlan>>> {
    read_leaves(&opened.cx, &opened.tree, &SECTIONS, |plan, keys| {
        leaf_preset(plan, keys);
        leaf::veins_alone(plan, keys);
        keys.leave(&SURFACE);
    })
}

/// The keys of a leaf, those of its surface left alone.
fn whole_leaf(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    leaf_preset(plan, keys);
    leaf(plan, keys);
    keys.leave(&SURFACE);
}

/// The other keys at the top of a scene, which a file of leaves may have.
pub const SECTIONS: [&str; 13] = [
    "name",
    "film",
    "picture",
    "camera",
    "integrator",
    "instruments",
    "media",
    "materials",
    "meshes",
    "solids",
    "plants",
    "lights",
    "objects",
];

/// Reads the section `leaves` of a file whose other `sections` are left alone. Errors are left in
/// the context.
pub fn read_leaves<T: From<LeafPlan>>(
    cx: &Context,
    tree: &Table,
    sections: &[&'static str],
    declare: impl Fn(&mut T, &mut Keys<'_>),
) -> Option<Vec<Named<T>>> {
    let start = Place {
        source: 0,
        span: 0..0,
    };
    let root = Block::new(cx, tree, String::new(), start);
    let mut leaves = Vec::new();
    Keys::read(root, None, |keys| {
        file_of_leaves(&mut leaves, keys, declare);
        keys.leave(sections);
    });
    (cx.error_count() == 0).then_some(leaves)
}

/// What a file with nothing but leaves may hold.
pub fn schema() -> BlockSchema {
    let mut leaves: Vec<Named<LeafPlan>> = Vec::new();
    Keys::describe(|keys| file_of_leaves(&mut leaves, keys, whole_leaf))
}

/// The keys at the top of a file with leaves.
fn file_of_leaves<T: From<LeafPlan>>(
    leaves: &mut Vec<Named<T>>,
    keys: &mut Keys<'_>,
    declare: impl Fn(&mut T, &mut Keys<'_>),
) {
    format(keys);
    let mut extrapolate = false;
    keys.key("extrapolate", &mut extrapolate, Flag, EXTRAPOLATE);
    if let Some(root) = keys.reader() {
        root.cx.extrapolate.set(extrapolate);
        root.needed("leaves", || "a block `[leaves.NAME]`".to_owned());
    }
    let list = NamedList {
        required: false,
        new: &|name: &str| Named {
            name: name.to_owned(),
            value: T::from(LeafPlan::of_length(100.0)),
        },
        name_of: |leaf: &Named<T>| &leaf.name,
    };
    let about = "Leaves that are grown.";
    keys.named("leaves", leaves, &list, about, |leaf, keys| {
        declare(&mut leaf.value, keys);
    });
}

/// What `extrapolate` means.
pub const EXTRAPOLATE: &str =
    "Whether spectra go on with their end values where their data do not reach.";

/// The key `format`.
pub fn format(keys: &mut Keys<'_>) {
    keys.required("format", &mut 1, Format, "Version of the format: 1.");
}

/// The version of the format.
struct Format;

impl Kind for Format {
    type Of = u64;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<u64> {
        let format = integer_at(cx, node, key, 0, u64::MAX)?;
        if format != 1 {
            let found = format.to_string();
            cx.error(&node.at, DocumentError::UnsupportedFormat { found });
        }
        Some(format)
    }

    fn write(&self, value: &u64) -> Value {
        Value::Integer((*value).into())
    }

    fn describe(&self) -> Type {
        Type::Integer { least: 1, most: 1 }
    }
}

/// Makes sure that PROSPECT's spectra reach over the wavelengths that the document needs.
pub fn require_prospect(keys: &Keys<'_>) {
    if let Some(block) = keys.reader() {
        require_coverage(block.cx, &block.at, "PROSPECT-D's table", PROSPECT_NM);
    }
}

/// A file with one leaf that reads back to the same plan. Keys come in the same order always.
///
/// A plan with numbers that no file may have gives one that is refused when it is read.
pub fn leaf_to_toml(name: &str, plan: &LeafPlan, extent: Extent) -> String {
    file_of("leaves", name, written(plan, extent))
}

/// As [`leaf_to_toml`], but with the name of a preset and what differs from it; all of it if the
/// plan lacks something that the preset has, or there is no such preset.
pub fn leaf_beside_preset(name: &str, plan: &LeafPlan, preset: &str) -> String {
    let found = species::find(preset).map(|preset| {
        // As it will be read, of another length.
        let mut beneath = preset.plan();
        let before = beneath.length_mm;
        beneath.follow_length(before, plan.length_mm);
        written(&beneath, Extent::All)
    });
    let beside = found.and_then(|preset| written(plan, Extent::All).beside_preset(&preset));
    let Some(beside) = beside else {
        return leaf_to_toml(name, plan, Extent::Changed);
    };
    let mut block = Written::default();
    block.value("preset", true, Value::Text(preset.to_owned()));
    block.extend(beside);
    file_of("leaves", name, block)
}

/// A file with leaves of one plant. Those of a preset are named by their numbers; other plans are
/// written out.
pub fn individuals_to_toml(
    name: &str,
    plan: &LeafPlan,
    preset: Option<&str>,
    numbers: std::ops::RangeInclusive<u64>,
) -> String {
    let is_preset = preset
        .and_then(species::find)
        .is_some_and(|found| found.plan() == *plan);
    let mut leaves = Written::default();
    for number in numbers {
        let block = match preset.filter(|_| is_preset) {
            Some(preset) => {
                let mut block = Written::default();
                block.value("preset", true, Value::Text(preset.to_owned()));
                block.value("individual", true, Value::Integer(number.into()));
                block
            }
            None => written(&plan.individual(preset, number), Extent::Changed),
        };
        leaves.block(&format!("{name}-{number}"), true, block);
    }
    let mut file = Written::default();
    file.value("format", true, Value::Integer(1));
    file.block("leaves", true, leaves);
    to_toml(&file.into_table())
}

/// A plan as a block.
fn written(plan: &LeafPlan, extent: Extent) -> Written {
    let mut own = plan.clone();
    let block = Keys::write(extent, |keys| leaf(&mut own, keys));
    match extent {
        Extent::All => block,
        Extent::Changed => {
            let mut usual = LeafPlan::of_length(plan.length_mm);
            let usual = Keys::write(extent, |keys| leaf(&mut usual, keys));
            block.without_defaults(&usual)
        }
    }
}

/// A block `[solids.NAME]` that reads back to the same body where the files that it names are;
/// `declare` has all keys of the block, the plan's among them.
pub fn solid_to_toml<T>(
    name: &str,
    solid: &mut T,
    usual: &mut T,
    declare: impl Fn(&mut T, &mut Keys<'_>),
) -> String {
    let own = Keys::write(Extent::Changed, |keys| declare(solid, keys));
    let usual = Keys::write(Extent::Changed, |keys| declare(usual, keys));
    file_of("solids", name, own.without_defaults(&usual))
}

/// A file with one plant and all numbers of its plan, to tell plans apart.
pub fn plant_to_toml(name: &str, plan: &PlantPlan) -> String {
    let mut own = plan.clone();
    let block = Keys::write(Extent::All, |keys| plant(&mut own, keys));
    file_of("plants", name, block)
}

fn file_of(section: &str, name: &str, block: Written) -> String {
    let mut named = Written::default();
    named.block(name, true, block);
    let mut file = Written::default();
    file.value("format", true, Value::Integer(1));
    file.block(section, true, named);
    to_toml(&file.into_table())
}
