use std::cell::Cell;
use std::sync::Arc;

use leafmodel::blade::layers::{Change, Layer, Mode};
use leafmodel::blade::masks::{Mask, Picture};
use leafmodel::compound::WholeLeaf;
use leafmodel::optics::PerConstituent;
use leafmodel::species::find;

use super::*;
use crate::material::palette::Palette;
use crate::scene::load::parse_leaves;
use crate::scene::plants;

/// Small leaves that cover the contents of files: a single blade, one with a stalk, several on
/// axes.
fn plans() -> Vec<LeafPlan> {
    ["poplar", "ash"]
        .map(|name| {
            let mut plan = find(name).expect("a preset").plan();
            plan.map_size = 24;
            plan
        })
        .to_vec()
}

/// The leaf from the cache, and whether it was grown.
fn take(cache: &PlantCache, plan: &LeafPlan) -> (LeafParts, bool) {
    let grown = Cell::new(false);
    let parts = cache.take_or_grow(plan, || {
        grown.set(true);
        LeafParts::grow(plan)
    });
    (parts.expect("a good plan"), grown.get())
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    names
        .map(|name| name.to_string_lossy().into_owned())
        .collect()
}

#[test]
fn a_leaf_from_the_cache_is_the_one_that_would_be_grown() {
    let folder = tempfile::tempdir().expect("a folder");
    for plan in plans() {
        let alone = LeafParts::grow(&plan).expect("a good plan");
        let whole = WholeLeaf::grow(&plan).expect("a good plan");
        assert_eq!(alone.maps.len(), whole.blades.len());
        for is_grown in [true, false, false] {
            // As each run of the program opens it.
            let cache = PlantCache::open(folder.path()).expect("it can be used");
            assert_eq!(take(&cache, &plan), (alone.clone(), is_grown));
            assert_eq!(cache.take_notes(), Vec::<String>::new());
        }
        assert_eq!(parts_from(&codec::to_bytes(&alone)), Some(alone));
    }
    assert_eq!(names(folder.path()).len(), plans().len());
}

#[test]
fn a_scene_has_the_same_meshes_and_maps_with_and_without_a_cache() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = PlantCache::open(folder.path()).expect("it can be used");
    for plan in plans() {
        let text = leafmodel::plan_file::leaf_to_toml("a", &plan, Extent::Changed);
        let leaves = parse_leaves(&text, "a.toml", folder.path(), &[]).expect("it reads back");
        let grow = |cache| {
            let grown = plants::grow(&leaves[0].value, &Palette::default(), cache);
            format!("{:?}", grown.expect("a good plan"))
        };
        let alone = grow(None);
        assert_eq!(alone, grow(Some(&cache)), "grown into the cache");
        assert_eq!(alone, grow(Some(&cache)), "taken from it");
    }
}

#[test]
fn a_damaged_file_is_reported_and_replaced_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = PlantCache::open(folder.path()).expect("it can be used");
    let plan = &plans()[0];
    let (leaf, _) = take(&cache, plan);
    let path = cache.path(&identity(plan));
    let whole = std::fs::read(&path).expect("it is there");
    let sizes = [0, 7, 16, 24, 500, whole.len() / 2, whole.len() - 1];
    let cut = sizes.map(|size| whole[..size].to_vec());
    let places = [0, 17, 30, whole.len() / 3, whole.len() / 2, whole.len() - 1];
    let flipped = places.map(|place| {
        let mut bytes = whole.clone();
        bytes[place] ^= 4;
        bytes
    });
    let longer = [whole.iter().copied().chain([0]).collect()];
    for bytes in cut.into_iter().chain(flipped).chain(longer) {
        std::fs::write(&path, &bytes).expect("it can be written");
        assert_eq!(take(&cache, plan), (leaf.clone(), true));
        let notes = cache.take_notes();
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert!(notes[0].contains(".leaf"), "{notes:?}");
        assert_eq!(std::fs::read(&path).expect("it is there"), whole);
        assert_eq!(take(&cache, plan), (leaf.clone(), false));
    }
}

#[test]
fn no_leaf_of_another_plan_or_program_is_taken() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut cache = PlantCache::open(folder.path()).expect("it can be used");
    let plan = &plans()[0];
    let other = LeafPlan {
        seed: plan.seed + 1,
        ..plan.clone()
    };
    let (leaf, _) = take(&cache, plan);
    let (others, is_grown) = take(&cache, &other);
    assert!(is_grown && others != leaf);
    std::fs::copy(cache.path(&identity(plan)), cache.path(&identity(&other)))
        .expect("it can be copied");
    assert_eq!(take(&cache, &other), (others, true));
    assert!(cache.take_notes()[0].contains("another plan's"));
    std::fs::write(cache.path(&identity(plan)), b"lamina leaf  1\n\nand so on")
        .expect("it can be written");
    assert_eq!(take(&cache, plan), (leaf.clone(), true));
    assert!(cache.take_notes()[0].contains("written by Lamina 0.1.0"));
    cache.program = "lamina 0.0.0".to_owned();
    assert_eq!(take(&cache, plan), (leaf, true));
    assert!(cache.take_notes()[0].contains("another program's"));
}

#[test]
fn other_pictures_by_the_same_names_make_another_plan() {
    let identity_with = |value: f32| {
        let picture = Picture {
            file: "spots.png".to_owned(),
            channel: None,
            width: 1,
            texels: vec![[value]],
        };
        let mut plan = plans().remove(0);
        plan.layers.push(Layer {
            name: "spots".to_owned(),
            mask: Mask::Picture(Arc::new(picture)),
            share: 1.0,
            change: Change::Values {
                mode: Mode::Replace,
                values: PerConstituent::from_fn(|_| None),
            },
        });
        identity(&plan)
    };
    assert_eq!(identity_with(0.5), identity_with(0.5));
    assert_ne!(identity_with(0.5), identity_with(0.25));
}

#[test]
fn bytes_of_every_kind_are_refused_and_not_believed() {
    let parts = LeafParts::grow(&plans()[0]).expect("a good plan");
    let whole = codec::to_bytes(&parts);
    // Counts greater than the data that follow.
    for place in (0..whole.len() - 8).step_by(whole.len() / 40) {
        let mut bytes = whole.clone();
        bytes[place..place + 8].fill(0xff);
        let read = parts_from(&bytes);
        assert!(read.is_none_or(|read| read.pieces.iter().all(|p| p.mesh < read.meshes.len())));
    }
    for count in [u64::MAX, u64::MAX / 12, 1 << 40] {
        let bytes = [codec::to_bytes(&count), whole[1..].to_vec()].concat();
        assert_eq!(parts_from(&bytes), None);
    }
    assert_eq!(parts_from(&[]), None);
}

#[test]
fn programs_that_share_a_folder_do_not_disturb_each_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = &plans()[0];
    let alone = LeafParts::grow(plan).expect("a good plan");
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let cache = PlantCache::open(folder.path()).expect("it can be used");
                for _ in 0..8 {
                    assert_eq!(take(&cache, plan).0, alone);
                    // The other programs may be in the middle of reading it.
                    let _ = std::fs::remove_file(cache.path(&identity(plan)));
                }
                assert_eq!(cache.take_notes(), Vec::<String>::new());
            });
        }
    });
    assert!(
        names(folder.path())
            .iter()
            .all(|name| !name.starts_with(".lamina-"))
    );
}

#[test]
fn a_folder_that_cannot_be_is_an_error_and_one_that_cannot_be_written_a_note() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    std::fs::write(&file, "text").expect("it can be written");
    let error = PlantCache::open(&file.join("cache")).expect_err("a file is no folder");
    assert!(error.to_string().contains("--cache"), "{error}");
    let place = folder.path().join("cache");
    let cache = PlantCache::open(&place).expect("it can be used");
    std::fs::remove_dir(&place).expect("it is empty");
    let plan = &plans()[0];
    assert!(take(&cache, plan).1);
    assert!(cache.take_notes()[0].contains("not kept"));
}
