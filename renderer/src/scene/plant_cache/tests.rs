use std::time::Duration;

use leafmodel::compound::WholeLeaf;
use leafmodel::document::written::Extent;
use leafmodel::grow_options::GrowOptions;
use leafmodel::leaf::{LeafPlan, keep_shared_veins};
use leafmodel::optics::Constituent;
use leafmodel::species::find;

use super::*;
use crate::material::palette::Palette;
use crate::scene::load::parse_leaves;
use crate::scene::plants;

/// Small leaves: a single blade, one that ages and has faces, several on axes.
fn plans() -> Vec<LeafPlan> {
    ["poplar", "birch-autumn", "ash"]
        .map(|name| {
            let mut plan = find(name).expect("a preset").plan();
            plan.map_size = 24;
            // Veins that come about at once.
            plan.venation = find("arcuate").expect("a preset").plan().venation;
            plan
        })
        .to_vec()
}

fn open(folder: &Path) -> PlantCache {
    PlantCache::open(folder, None).expect("it can be used")
}

fn grown(plan: &LeafPlan, cache: Option<&PlantCache>) -> WholeLeaf {
    let options = GrowOptions {
        kept: cache.map(|cache| cache as &dyn Kept),
        ..GrowOptions::default()
    };
    WholeLeaf::grow_with(plan, options).expect("a good plan")
}

/// The files of a folder whose stage is this one.
fn files(folder: &Path, stage: &str) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> = entries(folder)
        .into_iter()
        .map(|entry| entry.path)
        .collect();
    paths.retain(|path| {
        let name = path.file_name().expect("a file").to_string_lossy();
        name.starts_with(stage)
    });
    paths.sort();
    paths
}

#[test]
fn a_leaf_whose_stages_are_kept_is_the_one_that_would_be_grown() {
    let folder = tempfile::tempdir().expect("a folder");
    for plan in plans() {
        let alone = grown(&plan, None);
        for _ in 0..3 {
            // As each run of the program opens it.
            let cache = open(folder.path());
            assert_eq!(grown(&plan, Some(&cache)), alone);
            assert_eq!(cache.take_notes(), Vec::<String>::new());
        }
    }
}

#[test]
fn another_day_changes_the_contents_and_grows_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = open(folder.path());
    let plan = &plans()[1];
    let senescence = plan.senescence.expect("it ages");
    let later = LeafPlan {
        senescence: senescence.on_day(20.0),
        ..plan.clone()
    };
    grown(plan, Some(&cache));
    let before = ["veins", "form"].map(|stage| files(folder.path(), stage));
    assert_eq!(grown(&later, Some(&cache)), grown(&later, None));
    assert_eq!(
        ["veins", "form"].map(|stage| files(folder.path(), stage)),
        before
    );
    assert_eq!(files(folder.path(), "contents").len(), 2);
    // Another curl bends the blade and leaves its contents as they are.
    let mut curled = plan.clone();
    curled.form.curl += 0.1;
    assert_eq!(grown(&curled, Some(&cache)), grown(&curled, None));
    assert_eq!(files(folder.path(), "veins").len(), 1);
    assert_eq!(files(folder.path(), "form").len(), 2);
    assert_eq!(files(folder.path(), "contents").len(), 2);
}

#[test]
fn a_file_that_changed_is_not_taken_for_what_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = open(&folder.path().join("cache"));
    let text = "format = 1\n[leaves.a]\nlength_mm = 60\nmap_size = 24\noutline.svg.path = \"a.svg\"\nvenation.arcuate = {}\n\
        contents = { structure = 1.5, chlorophyll_ug_per_cm2 = 40, carotenoids_ug_per_cm2 = 9, water_cm = 0.01, \
        dry_matter_g_per_cm2 = 0.005 }\n";
    let outlines = [60, 45].map(|width| {
        let path = format!("M30 100 C25 90 28 50 30 0 C{width} 50 55 80 30 100 Z");
        let drawing =
            format!("<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"{path}\"/></svg>");
        std::fs::write(folder.path().join("a.svg"), drawing).expect("it can be written");
        let leaves = parse_leaves(text, "a.toml", folder.path(), &[]);
        let leaves = leaves.unwrap_or_else(|errors| panic!("{errors}"));
        let plan = &leaves[0].value.plan;
        let alone = grown(plan, None);
        assert_eq!(grown(plan, Some(&cache)), alone);
        alone
    });
    assert_ne!(outlines[0], outlines[1]);
}

#[test]
fn leaves_with_the_same_veins_grow_them_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = open(folder.path());
    let plan = plans().remove(0);
    let mut other = plan.clone();
    other.tissue.lamina[Constituent::Chlorophyll] += 1.0;
    let mut unlike = plan.clone();
    unlike.seed += 1;
    keep_shared_veins(&[plan.clone(), other, unlike], &cache);
    assert_eq!(files(folder.path(), "veins").len(), 1);
    assert_eq!(grown(&plan, Some(&cache)), grown(&plan, None));
    assert_eq!(files(folder.path(), "veins").len(), 1);
}

#[test]
fn a_scene_has_the_same_meshes_and_maps_with_and_without_a_cache() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = open(folder.path());
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
    let cache = open(folder.path());
    cache.keep("veins", "a", b"veins of the leaf a");
    let path = &files(folder.path(), "veins")[0];
    let whole = std::fs::read(path).expect("it is there");
    let cut = [0, 7, 16, 24, whole.len() / 2, whole.len() - 1].map(|size| whole[..size].to_vec());
    let flipped = (0..whole.len()).map(|place| {
        let mut bytes = whole.clone();
        bytes[place] ^= 4;
        bytes
    });
    let longer = [whole.iter().copied().chain([0]).collect()];
    for bytes in cut.into_iter().chain(flipped).chain(longer) {
        std::fs::write(path, &bytes).expect("it can be written");
        assert_eq!(cache.take("veins", "a"), None);
        let notes = cache.take_notes();
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert!(notes[0].contains(".leaf"), "{notes:?}");
        cache.keep("veins", "a", b"veins of the leaf a");
        assert_eq!(std::fs::read(path).expect("it is there"), whole);
        assert_eq!(
            cache.take("veins", "a").as_deref(),
            Some(&b"veins of the leaf a"[..])
        );
    }
}

#[test]
fn nothing_of_another_key_stage_or_program_is_taken() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut cache = open(folder.path());
    cache.keep("veins", "a", b"1");
    assert_eq!(cache.take("veins", "b"), None);
    assert_eq!(cache.take("form", "a"), None);
    let ours = cache.place("veins", "a").1;
    std::fs::copy(&ours, cache.place("veins", "b").1).expect("it can be copied");
    assert_eq!(cache.take("veins", "b"), None);
    assert!(cache.take_notes()[0].contains("another leaf's"));
    cache.program = "lamina 0.0.0".to_owned();
    assert_eq!(cache.take("veins", "a"), None);
    assert_eq!(cache.take_notes(), Vec::<String>::new());
}

#[test]
fn a_full_folder_loses_what_was_not_used_for_longest() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = PlantCache::open(folder.path(), Some(40_000)).expect("it can be used");
    // Bytes that do not pack.
    let value = |seed: u64| -> Vec<u8> {
        let mixed = (0..10_000_u64).map(|i| fnv1a(&(i ^ seed << 32).to_le_bytes()) as u8);
        mixed.collect()
    };
    let aged = |key: &str, seconds: u64| {
        let file = File::open(cache.place("veins", key).1).expect("it is there");
        let then = SystemTime::now() - Duration::from_secs(seconds);
        file.set_modified(then).expect("it is ours");
    };
    for (number, key) in (1..).zip(["a", "b", "c"]) {
        cache.keep("veins", key, &value(number));
        aged(key, 100 * (4 - number));
    }
    // It was the oldest and is the youngest once it is used.
    assert_eq!(cache.take("veins", "a"), Some(value(1)));
    std::fs::write(folder.path().join("notes.txt"), vec![0; 50_000]).expect("it can be written");
    cache.keep("veins", "d", &value(4));
    let there = ["a", "b", "c", "d"].map(|key| cache.take("veins", key).is_some());
    assert_eq!(there, [true, false, true, true]);
    assert!(folder.path().join("notes.txt").exists());
    assert_eq!(PlantCache::content(folder.path()).0, 3);
    PlantCache::clear(folder.path()).expect("they are ours");
    assert_eq!(PlantCache::content(folder.path()), (0, 0));
    assert!(folder.path().join("notes.txt").exists());
}

#[test]
fn programs_that_share_a_folder_do_not_disturb_each_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = &plans()[0];
    let alone = grown(plan, None);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let cache = open(folder.path());
                for _ in 0..8 {
                    assert_eq!(grown(plan, Some(&cache)), alone);
                    // The other programs may be in the middle of reading it.
                    let _ = PlantCache::clear(folder.path());
                }
                assert_eq!(cache.take_notes(), Vec::<String>::new());
            });
        }
    });
    let left = std::fs::read_dir(folder.path()).expect("the folder is there");
    let left = left.map(|entry| entry.expect("an entry").file_name());
    assert!(
        left.into_iter()
            .all(|name| !name.to_string_lossy().starts_with(".lamina-"))
    );
}

#[test]
fn a_folder_that_cannot_be_is_an_error_and_one_that_cannot_be_written_a_note() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    std::fs::write(&file, "text").expect("it can be written");
    let error = PlantCache::open(&file.join("cache"), None).expect_err("a file is no folder");
    assert!(error.to_string().contains("--cache"), "{error}");
    let place = folder.path().join("cache");
    let cache = open(&place);
    std::fs::remove_dir(&place).expect("it is empty");
    cache.keep("veins", "a", b"1");
    assert!(cache.take_notes()[0].contains("not kept"));
}
