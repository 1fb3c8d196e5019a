//! The light of the scenes stays what it was:
//! `UPDATE_GOLDENS=1 cargo test --release -p lamina-tests golden` makes the pictures in `goldens/`
//! anew.

use std::path::{Path, PathBuf};

use renderer::image::openexr;
use support::golden::{Golden, compare};

const SIZE: &str = "film.rgb.size=[64, 48]";
const BANDS: &str = "film.spectral.size=[48, 48]";
const SPP: &str = "film.rgb.spp=48";
const BANDS_SPP: &str = "film.spectral.spp=48";

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../scenes")
        .join(name)
        .join("scene.toml")
}

fn check(name: &str, overrides: &[&str]) {
    let golden = Golden {
        name,
        scene: &scene(name),
        overrides,
    };
    golden.check(Path::new(env!("CARGO_TARGET_TMPDIR")));
}

#[test]
fn the_first_leaf_has_its_light() {
    check("first-leaf", &[SIZE, SPP, "leaves.aspen.map_size=400"]);
}

#[test]
fn the_autumn_leaf_has_its_light() {
    check("autumn-leaf", &[SIZE, SPP, "leaves.leaf.map_size=400"]);
}

#[test]
fn the_leaves_of_the_comparison_have_their_light() {
    check("two-leaves", &[BANDS, BANDS_SPP]);
    check("textured-veins", &[BANDS, BANDS_SPP]);
}

#[test]
fn a_body_of_solid_tissue_with_a_mosaic_has_its_light() {
    check("solid-fruit", &[]);
}

#[test]
fn leaves_with_palettes_of_their_own_have_their_light() {
    let names = [
        "prospect",
        "pelargonidin",
        "delphinidin",
        "blue",
        "betanin",
        "betaxanthin",
        "lutein",
        "lycopene",
    ];
    // One leaf to a region.
    let small = names.map(|name| format!("leaves.{name}.map_size=128"));
    let overrides: Vec<&str> = ["film.rgb.size=[64, 40]", SPP]
        .into_iter()
        .chain(small.iter().map(String::as_str))
        .collect();
    check("pigments", &overrides);
}

#[test]
fn one_percent_more_light_does_not_pass() {
    for name in [
        "first-leaf",
        "autumn-leaf",
        "two-leaves",
        "textured-veins",
        "solid-fruit",
        "pigments",
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("goldens/{name}.exr"));
        let golden = openexr::read(&path).expect("the golden is there");
        let mut picture = golden.clone();
        picture
            .layers
            .retain(|layer| layer.name.starts_with("mean"));
        assert!(compare(&golden, &picture).passes());
        for layer in &mut picture.layers {
            layer.data.iter_mut().for_each(|value| *value *= 1.01);
        }
        let verdict = compare(&golden, &picture);
        assert!(!verdict.passes(), "{name}: {verdict:?}");
    }
}
