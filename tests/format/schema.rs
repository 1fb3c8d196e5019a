//! What is made from the declarations of the blocks: the schema that is committed, and the tables
//! of the book.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use leafmodel::document::schema::tables::filled;
use leafmodel::document::schema::{BlockSchema, Is};
use renderer::scene::load;

use super::book::pages;
use super::{accept, refuse, text_of};

#[test]
fn the_schema_that_is_committed_is_that_of_this_program() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/scene.schema.json");
    let kept = fs::read_to_string(file).expect("the schema is part of the repository");
    let json = load::json_schema();
    assert!(
        kept == format!("{json:#}\n"),
        "stale: run `lamina schema --out scenes/scene.schema.json`"
    );
}

#[test]
fn the_tables_of_the_book_are_those_of_this_program() {
    let schema = load::schema();
    let mut stale = Vec::new();
    let mut book = String::new();
    for (path, page) in pages() {
        let whole = filled(&page, &schema)
            .unwrap_or_else(|problem| panic!("{}: {problem}", path.display()));
        if whole != page {
            stale.push(path.display().to_string());
        }
        if path.components().any(|part| part.as_os_str() == "format") {
            book.push_str(&page);
        }
    }
    assert!(
        stale.is_empty(),
        "stale: run `lamina schema --pages docs/src/format/*.md`: {stale:?}"
    );
    let is_part = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let words: BTreeSet<&str> = book.split(|letter| !is_part(letter)).collect();
    let mut untold = Vec::new();
    tell(&schema, &mut |key| {
        if !words.contains(key) {
            untold.push(key.to_owned());
        }
    });
    assert!(untold.is_empty(), "no page of the book names {untold:?}");
}

/// Every key of a block and of the blocks in it.
fn tell(schema: &BlockSchema, to: &mut impl FnMut(&str)) {
    for entry in &schema.entries {
        to(&entry.key);
        match &entry.is {
            Is::Block(inner) | Is::Named(inner) | Is::List { of: inner, .. } => tell(inner, to),
            Is::Value { .. } => {}
        }
    }
}

#[test]
fn every_key_says_what_it_means_in_a_sentence() {
    fn check(schema: &BlockSchema, path: &str) {
        for entry in &schema.entries {
            let path = format!("{path}.{}", entry.key);
            assert!(entry.about.ends_with('.'), "{path}: \"{}\"", entry.about);
            match &entry.is {
                Is::Block(inner) | Is::Named(inner) | Is::List { of: inner, .. } => {
                    check(inner, &path);
                }
                Is::Value { .. } => {}
            }
        }
    }
    check(&load::schema(), "");
}

#[test]
fn a_leaf_of_a_preset_is_that_leaf_and_any_key_beside_it_changes_it() {
    let scene = |leaf: &str| {
        let text = text_of("minimal.toml");
        format!("{text}\n[leaves.mine]\n{leaf}\n[objects.mine]\nleaf = \"mine\"\n")
    };
    let read = |leaf: &str| {
        let loaded = accept(&scene(leaf), "preset.toml", &[]);
        loaded.description.leaves[0].value.plan.clone()
    };
    for preset in leafmodel::species::PRESETS {
        let plan = read(&format!("preset = \"{}\"", preset.name));
        assert_eq!(plan, preset.plan(), "{}", preset.name);
    }
    let poplar = read("preset = \"poplar\"");
    let changed = read("preset = \"poplar\"\nlength_mm = 90\nblade.fold_deg = 3");
    assert_eq!(changed.length_mm, 90.0);
    assert_eq!(changed.form.fold, 3_f64.to_radians());
    assert_eq!(changed.venation, poplar.venation);
    assert_eq!(changed.tissue, poplar.tissue);
    let spline = read("preset = \"poplar\"\nvenation.arcuate = {}");
    assert!(spline.venation.auxin().is_none());
    assert_eq!(spline.outline, poplar.outline);
}

#[test]
fn slips_beside_a_preset_say_which_preset_and_which_kind() {
    let report = |leaf: &str| {
        let text = format!("{}\n[leaves.mine]\n{leaf}\n", text_of("minimal.toml"));
        refuse(&text, "preset.toml", &[]).to_string()
    };
    let unknown = report("preset = \"poplr\"");
    assert!(
        unknown.contains("there is no preset `poplr`")
            && unknown.contains("did you mean `poplar`?"),
        "{unknown}"
    );
    let oak = report("preset = \"oak\"\nblade.fold_deg = 3\noutline.transport = {}");
    assert!(oak.contains("did you mean `white-oak`, `red-oak`"), "{oak}");
    assert!(oak.contains("preset.toml: 1 error"), "{oak}");
    let other = report("preset = \"poplar\"\n[leaves.mine.outline.growth_algorithm]\nrows = 90");
    for part in [
        "[leaves.mine.outline.growth_algorithm] lacks `widest_at`",
        "the preset `poplar` has the kind",
    ] {
        assert!(other.contains(part), "{other}");
    }
    let key = report("preset = \"poplar\"\nblade.foldd_deg = 3");
    assert!(key.contains("did you mean `fold_deg`?"), "{key}");
}

#[test]
fn a_material_takes_the_contents_of_a_colour_by_its_name() {
    let material = |keys: &str| {
        let text = text_of("minimal.toml");
        let text = format!("{text}\n[materials.mine.leaf]\n{keys}\n");
        accept(&text, "colour.toml", &[]);
        text
    };
    material("preset = \"birch-yellow\"");
    material("preset = \"birch-yellow\"\ncontents.brown = 0.5");
    let text = format!(
        "{}\n[materials.mine.leaf]\npreset = \"brich\"\n",
        text_of("minimal.toml")
    );
    let report = refuse(&text, "colour.toml", &[]).to_string();
    assert!(report.contains("did you mean `birch-yellow`?"), "{report}");
}

#[test]
fn overrides_are_typed_as_their_keys_are() {
    let minimal = text_of("minimal.toml");
    let loaded = accept(
        &minimal,
        "minimal.toml",
        &["name=2024", "picture.tone=filmic"],
    );
    assert_eq!(loaded.description.name, "2024");
}
