//! One leaf of a file or of a preset, with settings whose keys may be written short.

use std::path::Path;

use thiserror::Error;

use super::{leaf_to_toml, plans, plans_of_veins, schema, whole_leaf};
use crate::document::assets::Assets;
use crate::document::context::{Context, KnownKey, QUOTED};
use crate::document::names::Named;
use crate::document::nearest::nearest;
use crate::document::overrides;
use crate::document::reader::Block;
use crate::document::report::{DocumentErrors, Warning};
use crate::document::source::{Place, Sources, escaped};
use crate::document::written::Extent;
use crate::document::{Keys, Opened, Table};
use crate::leaf::LeafPlan;
use crate::species;

/// Where a leaf is described.
#[derive(Clone, Copy, Debug)]
pub enum LeafFile<'f> {
    /// A file with leaves, and which leaf if it has several.
    File {
        /// The file.
        path: &'f Path,
        /// The leaf's name.
        leaf: Option<&'f str>,
    },
    /// A plan that is written out and read like a file.
    Plan {
        /// The leaf's name, which is also what reports call the file.
        name: &'f str,
        /// The plan.
        plan: &'f LeafPlan,
    },
}

/// Why there is no leaf to grow.
#[derive(Debug, Error)]
pub enum LeafNotChosen {
    /// The file, or a setting, has errors.
    #[error(transparent)]
    Scene(#[from] DocumentErrors),
    /// The file has no such leaf, or several and none was named.
    #[error(
        "{file} holds the leaves {names}: name one of them behind the file, as in {file}#{first}"
    )]
    WhichLeaf {
        /// The file.
        file: String,
        /// Its leaves.
        names: String,
        /// The first of them.
        first: String,
    },
    /// A setting that is not `key=value`.
    #[error("--set {setting} has no `=`: write --set key=value")]
    NoValue {
        /// The setting.
        setting: String,
    },
    /// A short key that no block of the leaf has.
    #[error("--set {key}: the leaf `{leaf}` has no such key{}", meant(.nearest.as_deref()))]
    UnknownKey {
        /// The key.
        key: String,
        /// The leaf.
        leaf: String,
        /// Path of the key that was probably meant.
        nearest: Option<String>,
    },
    /// A short key that several blocks have.
    #[error("--set {key} could be {paths}: write the whole of one of them")]
    Ambiguous {
        /// The key.
        key: String,
        /// What it could be.
        paths: String,
    },
}

fn meant(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |path| format!("; did you mean {path}?"))
}

/// Reads one leaf. `overridden` are `key=value` with paths from the top of the file, `settings`
/// with paths from the leaf, or with as much of a path's end as only one key has. Where only margin
/// and veins are wanted, `veins_alone`, the leaf's contents need not be said.
///
/// # Errors
///
/// [`LeafNotChosen`]; messages about values are those of any scene.
///
/// What is allowed but probably not meant comes with the leaf.
pub fn load_one_leaf(
    file: LeafFile<'_>,
    assets: Option<&'static dyn Assets>,
    veins_alone: bool,
    overridden: &[String],
    settings: &[String],
) -> Result<(Named<LeafPlan>, Vec<Warning>), LeafNotChosen> {
    // The plan with all its keys, which short ones are looked up in.
    let mut in_full_text = None;
    let mut opened = match file {
        LeafFile::File { path, .. } => Opened::file(path, overridden, schema)?,
        LeafFile::Plan { name, plan } => {
            let folder = Path::new(".");
            let whole = leaf_to_toml(name, plan, Extent::Changed);
            let whole = Opened::text(&whole, name, folder, overridden, schema)?;
            if species::find(name).is_some_and(|preset| preset.plan() == *plan) {
                // Another kind of outline or veins then takes the place of the preset's, as in a file.
                in_full_text = Some(whole);
                let text = format!("format = 1\n[leaves.{name}]\npreset = \"{name}\"\n");
                Opened::text(&text, name, folder, overridden, schema)?
            } else {
                whole
            }
        }
    };
    opened.cx.assets = assets;
    let leaves = opened
        .tree
        .get("leaves")
        .and_then(|entry| entry.node.table());
    let names: Vec<String> = leaves
        .into_iter()
        .flat_map(|table| table.0.iter().map(|entry| entry.key.clone()))
        .collect();
    let chosen = match file {
        LeafFile::File {
            leaf: Some(leaf), ..
        } => names.iter().find(|name| *name == leaf),
        LeafFile::Plan { name: leaf, .. } => names.iter().find(|name| *name == leaf),
        LeafFile::File { leaf: None, .. } => names.first().filter(|_| names.len() == 1),
    };
    let chosen = chosen.cloned();
    if let Some(name) = chosen.as_ref().filter(|_| !settings.is_empty()) {
        let known = known_keys(in_full_text.as_ref().unwrap_or(&opened), name);
        let types = schema();
        for setting in settings {
            let text = in_full(setting, name, &known)?;
            overrides::apply(&opened.cx, &mut opened.tree, "--set", &text, &types);
        }
    }
    let leaves = if veins_alone {
        plans_of_veins(&opened)
    } else {
        plans(&opened)
    };
    let (leaves, warnings) = opened.finish(leaves)?;
    leaves
        .into_iter()
        .find(|leaf| Some(&leaf.name) == chosen.as_ref())
        .map(|leaf| (leaf, warnings))
        .ok_or_else(|| LeafNotChosen::WhichLeaf {
            file: match file {
                LeafFile::File { path, .. } => path.display().to_string(),
                LeafFile::Plan { name, .. } => name.to_owned(),
            },
            names: names.join(", "),
            first: names.first().cloned().unwrap_or_default(),
        })
}

/// Every key that the leaf `name` of a file may have, paths beginning with `leaves`. Keys of blocks
/// that are left out are among them, those of kinds that were not chosen are not.
fn known_keys(opened: &Opened, name: &str) -> Vec<KnownKey> {
    let cx = Context::new(Sources::default(), opened.cx.folder.clone());
    *cx.survey.borrow_mut() = Some(Vec::new());
    let at = Place {
        source: 0,
        span: 0..0,
    };
    let leaf = opened.tree.get("leaves");
    let leaf = leaf.and_then(|entry| entry.node.table()?.get(name));
    if let Some(table) = leaf.and_then(|entry| entry.node.table()) {
        let table: &Table = table;
        let block = Block::new(&cx, table, format!("leaves.{name}"), at);
        let mut plan = LeafPlan::of_length(100.0);
        Keys::read(block, None, |keys| whole_leaf(&mut plan, keys));
    }
    let mut keys = cx.survey.take().unwrap_or_default();
    keys.sort_by(|a, b| a.path.cmp(&b.path));
    keys.dedup();
    keys
}

/// A setting of the leaf `name` as an override of the file.
fn in_full(setting: &str, name: &str, known: &[KnownKey]) -> Result<String, LeafNotChosen> {
    let Some((key, value)) = setting.split_once('=') else {
        let setting = escaped(setting, QUOTED);
        return Err(LeafNotChosen::NoValue { setting });
    };
    let key = key.trim();
    let prefix = format!("leaves.{name}.");
    let in_whole = |path: &str| Ok(format!("{prefix}{path}={value}"));
    // Paths from the leaf; those of blocks that the file has count before those that it lacks.
    let paths = |there: bool| {
        known
            .iter()
            .filter(move |known| known.block_is_there == there)
            .filter_map(|known| known.path.strip_prefix(&prefix))
    };
    let ends_with_key = |path: &&str| {
        let before = path.strip_suffix(key);
        before.is_some_and(|before| before.is_empty() || before.ends_with('.'))
    };
    for there in [true, false] {
        let found: Vec<&str> = paths(there).filter(ends_with_key).collect();
        match found.as_slice() {
            [] => {}
            [path] => return in_whole(path),
            several if several.contains(&key) && key.contains('.') => return in_whole(key),
            several => {
                return Err(LeafNotChosen::Ambiguous {
                    key: escaped(key, QUOTED),
                    paths: several.join(" or "),
                });
            }
        }
    }
    if key.contains('.') {
        // The reader tells which part of the path is wrong.
        return in_whole(key);
    }
    let last = |path: &str| path.rsplit('.').next().unwrap_or_default().to_owned();
    let all: Vec<&str> = paths(true).chain(paths(false)).collect();
    let lasts: Vec<String> = all.iter().map(|path| last(path)).collect();
    let near = nearest(key, lasts.iter().map(String::as_str));
    let path = near.and_then(|near| all.iter().find(|path| last(path) == near));
    Err(LeafNotChosen::UnknownKey {
        key: escaped(key, QUOTED),
        leaf: name.to_owned(),
        nearest: path.map(|path| (*path).to_owned()),
    })
}

#[cfg(test)]
mod tests {
    use crate::leaf::outline_plan::Contour;
    use crate::shape::growth_form::{GrowthForm, HalfForm};
    use crate::venation::plan::AuxinPlan;

    use super::*;
    use crate::optics::Constituent;

    fn set(settings: &[&str]) -> Result<LeafPlan, LeafNotChosen> {
        let mut plan = crate::species::find("poplar").expect("a preset").plan();
        // Whatever the preset has, the keys of these tests are those of these kinds.
        let form = GrowthForm::from(HalfForm::entire(1.2, 0.3, 3.0));
        plan.outline = Contour::GrowthAlgorithm(form).into();
        plan.venation = AuxinPlan::default().into();
        let file = LeafFile::Plan {
            name: "poplar",
            plan: &plan,
        };
        let settings: Vec<String> = settings.iter().map(|text| (*text).to_owned()).collect();
        load_one_leaf(file, None, false, &[], &settings).map(|(leaf, _)| leaf.value)
    }

    fn auxin(plan: &LeafPlan) -> &AuxinPlan {
        plan.venation.auxin().expect("the poplar's veins grow")
    }

    fn refusal(setting: &str) -> String {
        set(&[setting]).expect_err(setting).to_string()
    }

    #[test]
    fn a_preset_without_settings_is_itself() {
        for preset in crate::species::PRESETS {
            let plan = preset.plan();
            let file = LeafFile::Plan {
                name: preset.name,
                plan: &plan,
            };
            let (leaf, _) = load_one_leaf(file, None, false, &[], &[])
                .unwrap_or_else(|error| panic!("{error}"));
            assert_eq!((leaf.name.as_str(), leaf.value), (preset.name, plan));
        }
    }

    #[test]
    fn a_setting_puts_another_kind_in_the_place_of_a_presets_as_a_file_does() {
        // Paths beside a preset start at the working folder.
        let folder = tempfile::tempdir_in(".").expect("a folder");
        let drawing = "<svg xmlns=\"http://www.w3.org/2000/svg\"><g display=\"none\"><path d=\"M0 0H1V1Z\"/></g>\
            <path d=\"M5 9 L7 6 L5 1 L3 6 Z\"/></svg>";
        std::fs::write(folder.path().join("leaf.svg"), drawing).expect("it can be written");
        let path = folder.path().join("leaf.toml");
        for preset in ["birch", "poplar", "reticulate"] {
            let text = format!("format = 1\n[leaves.{preset}]\npreset = \"{preset}\"\n");
            std::fs::write(&path, text).expect("it can be written");
            let setting = ["outline.svg.path=leaf.svg".to_owned()];
            let in_file = LeafFile::File {
                path: &path,
                leaf: None,
            };
            let (expected, warnings) = load_one_leaf(in_file, None, true, &[], &setting)
                .unwrap_or_else(|error| panic!("{preset}: {error}"));
            assert!(matches!(expected.value.outline.contour, Contour::Svg(_)));
            assert_eq!(warnings.len(), 1, "{warnings:?}");
            assert!(
                warnings[0].message().contains("are hidden"),
                "{}",
                warnings[0].message()
            );
            let plan = species::find(preset).expect("a preset").plan();
            let shown = folder.path().file_name().expect("a name").to_string_lossy();
            let named = LeafFile::Plan {
                name: preset,
                plan: &plan,
            };
            let setting = format!("outline.svg.path={shown}/leaf.svg");
            let (found, _) = load_one_leaf(named, None, true, &[], &[setting])
                .unwrap_or_else(|error| panic!("{preset}: {error}"));
            let (Contour::Svg(found), Contour::Svg(expected)) =
                (found.value.outline.contour, expected.value.outline.contour)
            else {
                panic!("{preset}: no drawing");
            };
            assert_eq!(found.points, expected.points);
        }
    }

    #[test]
    fn a_key_is_found_wherever_it_is() {
        let plan = set(&[
            "seed=3",
            "kill_distance_segments = 2",
            "lobe_decay=0.001",
            "blade.fold_deg=0",
        ]);
        let plan = plan.expect("good settings");
        assert_eq!(
            (plan.seed, auxin(&plan).kill_distance, plan.form.fold),
            (3, 2.0, 0.0)
        );
        let plan = set(&["isogonic.length_step_segments=2", "veins.structure=1.1"])
            .expect("good settings");
        assert_eq!(plan.tissue.vein_factors[Constituent::Structure], 1.1);
        // In a block that the plan does not have.
        let clearance = set(&["venation.closed.margin_clearance={ distance = 0.1, until = 1 }"]);
        let clearance = clearance.expect("a good block");
        assert!(auxin(&clearance).margin_clearance.is_some());
    }

    #[test]
    fn slips_are_reported_with_what_was_meant() {
        assert_eq!(
            refusal("seed"),
            "--set seed has no `=`: write --set key=value"
        );
        assert_eq!(
            refusal("kil_distance_segments=2"),
            "--set kil_distance_segments: the leaf `poplar` has no such key; did you mean \
             venation.closed.kill_distance_segments?"
        );
        assert_eq!(
            refusal("structure=2"),
            "--set structure could be contents.structure or veins.body.structure or veins.structure: write the whole of one of them"
        );
        let range = refusal("kill_distance_segments=-1");
        assert!(
            range.contains("`kill_distance_segments` is -1, outside 0.01 to 10000"),
            "{range}"
        );
        assert!(range.contains("--> --set:1:"), "{range}");
        let unknown = refusal("venation.closed.kil=1");
        assert!(
            unknown.contains("[leaves.poplar.venation.closed] has no key `kil`"),
            "{unknown}"
        );
    }
}
