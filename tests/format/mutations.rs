//! Scenes with bytes changed at random: refused or accepted, never a panic.

use renderer::scene::load::parse;

use super::{folder, text_of};

/// A well-mixed number for each counter.
fn mixed(counter: u64) -> u64 {
    let mut z = counter.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// One to four changes: a byte replaced, dropped or put in, or a piece doubled.
fn mutated(text: &[u8], seed: u64) -> Vec<u8> {
    const BYTES: &[u8] = b"[]{}=\"'#,.-+_\n\t 0123456789eEnxaif\\\x00\x1b\xc3\xa4\xff";
    let mut bytes = text.to_vec();
    let count = 1 + mixed(seed) % 4;
    for change in 0..count {
        let random = |stream: u64, below: usize| {
            (mixed(seed.wrapping_mul(64) + change * 8 + stream + 1) % below.max(1) as u64) as usize
        };
        let at = random(0, bytes.len());
        let byte = BYTES[random(1, BYTES.len())];
        match random(2, 4) {
            0 => bytes[at] = byte,
            1 => drop(bytes.remove(at)),
            2 => bytes.insert(at, byte),
            _ => {
                let end = (at + 1 + random(3, 40)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
        }
    }
    bytes
}

#[test]
fn three_thousand_changed_scenes_are_told_apart_without_a_panic() {
    let folder = folder();
    let whole = text_of("whole.toml");
    let mut accepted = 0;
    for seed in 0..3000 {
        let bytes = mutated(whole.as_bytes(), seed);
        let text = String::from_utf8_lossy(&bytes);
        match parse(&text, "changed.toml", folder.path(), &[]) {
            Ok(_) => accepted += 1,
            Err(errors) => {
                assert!(!errors.errors().is_empty());
                assert!(!errors.to_string().is_empty());
            }
        }
    }
    // Changes in comments, names and digits are harmless, most others are not.
    assert!(
        (30..1000).contains(&accepted),
        "{accepted} of 3000 were accepted"
    );
}

#[test]
fn two_thousand_changed_tables_of_instances_are_told_apart_without_a_panic() {
    let folder = folder();
    let read = |name: &str| std::fs::read(folder.path().join(name)).expect("the folder's file");
    let scene = text_of("minimal.toml")
        + "[meshes.ball.sphere]\nradius_m = 1\n[objects.row]\nmesh = [\"floor\", \"ball\"]\n\
           material = \"grey\"\ninstances.file = \"changed.csv\"\n";
    for (ending, whole) in [("csv", read("places.csv")), ("npy", read("places.npy"))] {
        let scene = scene.replace("changed.csv", &format!("changed.{ending}"));
        let mut accepted = 0;
        for seed in 0..1000 {
            let bytes = mutated(&whole, seed);
            let file = folder.path().join(format!("changed.{ending}"));
            std::fs::write(file, bytes).expect("the folder was just made");
            match parse(&scene, "changed.toml", folder.path(), &[]) {
                Ok(_) => accepted += 1,
                Err(errors) => assert!(!errors.to_string().is_empty()),
            }
        }
        assert!((10..900).contains(&accepted), "{accepted} of 1000 {ending}");
    }
}
