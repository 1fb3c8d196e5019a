//! What holds for the files of all presets.

use super::*;
use crate::document::written::Extent;
use crate::plan_file::leaf_to_toml;

#[test]
fn every_preset_is_found_by_its_name_and_can_be_carried_out() {
    for preset in PRESETS {
        let allowed = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'-';
        assert!(preset.name.bytes().all(allowed), "{}", preset.name);
        let found = find(preset.name).expect("it is in the list");
        assert!(
            std::ptr::eq(found, preset),
            "{} is there twice",
            preset.name
        );
        let plan = preset.plan();
        assert_eq!(plan.tissue.validate(), Ok(()));
        assert_eq!(plan.stance.validate(), Ok(()));
        plan.form.validate().expect("a good form");
        plan.check_senescence().expect("a good old age");
        plan.check_lamina().expect("a good outline and venation");
    }
    assert!(find("popplar").is_none());
}

#[test]
fn every_file_says_what_it_is_and_where_its_numbers_are_from() {
    for preset in PRESETS {
        for text in [preset.about(), preset.source()] {
            assert!(text.len() > 5, "{}: {text}", preset.name);
        }
        // Contents, veins and margin come from the file or what it inherits.
        let opened = preset.opened();
        let leaf = opened.tree.get("leaf").and_then(|entry| entry.node.table());
        let leaf = leaf.expect("a block `leaf`");
        for block in ["length_mm", "outline", "venation", "contents", "blade"] {
            assert!(leaf.get(block).is_some(), "{} has no {block}", preset.name);
        }
    }
}

#[test]
fn every_file_is_in_the_list() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/species");
    for (folder, files) in [
        (folder.to_owned(), PRESETS),
        (format!("{folder}/bases"), &BASES),
    ] {
        let entries = std::fs::read_dir(folder).expect("the folder is there");
        let files_there = entries
            .map(|entry| entry.expect("it can be read").path())
            .filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
        for path in files_there {
            let stem = path.file_stem().and_then(|stem| stem.to_str());
            let is_listed = |file: &Preset| file.name.rsplit('/').next() == stem;
            assert!(files.iter().any(is_listed), "{}", path.display());
        }
    }
}

/// One hash of the declared keys of all presets and of two individuals of each, in their order.
///
#[test]
fn no_preset_has_drifted() {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for preset in PRESETS {
        let plan = preset.plan();
        let individuals = [1, 2].map(|number| plan.individual(Some(preset.name), number));
        for plan in individuals.into_iter().chain([plan]) {
            for byte in leaf_to_toml(preset.name, &plan, Extent::All).bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
    }
    assert_eq!(format!("{hash:016x}"), HASH);
}
