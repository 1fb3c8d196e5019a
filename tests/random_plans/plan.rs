//! A random scene with a leaf, and at times a body of solid tissue.

use std::fmt::Write as _;
use std::fs;
use std::sync::LazyLock;

use leafmodel::document::schema::BlockSchema;
use leafmodel::leaf::venation_plan::VenationPlan;
use leafmodel::species::{PRESETS, find};
use renderer::scene::load::schema;
use tempfile::TempDir;

use super::chance::Chance;
use super::written::Writer;

const SCENE: &str = "format = 1
[film.rgb]
size = [6, 6]
spp = 1
[lights.sky.constant]
radiance_w_m2_sr_nm = 0.1
[lights.sun.distant]
irradiance_w_m2_nm = 1
elevation_deg = 40
azimuth_deg = 100
[objects.leaf]
leaf = \"one\"
";

/// Veins that take little time, in place of a preset's.
const VEINS: [&str; 3] = [
    "[leaves.one.venation.arcuate]\n",
    "[leaves.one.venation.closed]\nfinal_length_segments = 60\nkill_distance_segments = 3\n\
     birth_distance_segments = 4\ndarts_per_segment2 = 0.05\nveinlet_radius_mm = 0.02\n\
     growth.isogonic = { initial_length_segments = 15, length_step_segments = 1 }\n",
    "[leaves.one.venation.open]\nfinal_length_segments = 60\nkill_distance_segments = 4\n\
     birth_distance_segments = 4\ndarts_per_segment2 = 0.05\nveinlet_radius_mm = 0.02\n\
     growth.none = {}\n",
];

pub(super) static SCHEMA: LazyLock<BlockSchema> = LazyLock::new(schema);

/// Whether veins take little time.
fn has_coarse_veins(venation: &VenationPlan) -> bool {
    match venation {
        VenationPlan::Auxin(plan) => plan.final_length < 150.0 && plan.free_endings.is_none(),
        VenationPlan::Transport(plan) => plan.cells_along < 60,
        VenationPlan::Arcuate(_) | VenationPlan::Cells(_) | VenationPlan::Development(_) => true,
    }
}

/// The scene of a number.
pub(super) fn text(number: u64) -> String {
    let mut chance = Chance::of(number);
    let mut text = SCENE.to_owned();
    let length_m = 0.1;
    let _ = writeln!(
        text,
        "[camera.perspective]\nposition_m = [0, {}, {}]\nlook_at_m = [0, {}, 0]\nvertical_fov_deg = 50",
        -0.6 * length_m,
        1.2 * length_m,
        0.5 * length_m
    );
    let tame = tameness(&mut chance);
    let share = leaf(&mut chance, "one", tame, &mut text);
    if chance.is(0.15) {
        let solid = SCHEMA.at(&["solids", "NAME"]).expect("scenes have bodies");
        let mut writer = Writer {
            chance: &mut chance,
            share,
            tame,
            text: String::new(),
        };
        writer.block("solids.body", solid, true, &["map_size"]);
        let start = "[solids.body]\nmap_size = 32\n";
        text.push_str(&writer.text.replacen("[solids.body]\n", start, 1));
        text.push_str("[objects.body]\nsolid = \"body\"\n");
    }
    if chance.is(0.2) {
        let plant = SCHEMA.at(&["plants", "NAME"]).expect("scenes have plants");
        let mut writer = Writer {
            chance: &mut chance,
            share,
            tame,
            text: String::new(),
        };
        writer.block("plants.bough", plant, false, &["leaf", "bark", "preset"]);
        let start = "[plants.bough]\nleaf = \"one\"\n";
        text.push_str(&writer.text.replacen("[plants.bough]\n", start, 1));
        text.push_str("[objects.bough]\nplant = \"bough\"\n");
    }
    text
}

/// The fraction of numbers that stay near their defaults.
pub(super) fn tameness(chance: &mut Chance) -> f64 {
    [0.95, 0.8, 0.3][chance.below(3)]
}

/// Writes a leaf of this name; the fraction of optional keys that it has.
pub(super) fn leaf(chance: &mut Chance, name: &str, tame: f64, text: &mut String) -> f64 {
    let is_preset = chance.is(0.5);
    let share = if is_preset { 0.12 } else { 0.25 } * (0.3 + chance.uniform());
    let leaf = SCHEMA.at(&["leaves", "NAME"]).expect("scenes have leaves");
    let (mut skip, mut veins) = (vec!["preset", "map_size"], "");
    let mut start = "map_size = 32\n".to_owned();
    if is_preset {
        let preset = &PRESETS[chance.below(PRESETS.len())];
        // Those of the presets have thousands of cells.
        let is_patterned = preset.plan().mosaic.is_some();
        let preset = if is_patterned {
            find("birch").expect("a preset")
        } else {
            preset
        };
        let _ = writeln!(start, "preset = \"{}\"", preset.name);
        let is_fine = !has_coarse_veins(&preset.plan().venation);
        if chance.is(0.5) || is_fine {
            skip.push("venation");
            veins = VEINS[chance.below(VEINS.len())];
        }
    }
    if !is_preset {
        // A leaf without a preset is of no plant.
        skip.push("individual");
    }
    let mut writer = Writer {
        chance,
        share,
        tame,
        text: String::new(),
    };
    let header = format!("[leaves.{name}]\n");
    writer.block(&format!("leaves.{name}"), leaf, !is_preset, &skip);
    let written = writer.text.replacen(&header, &(header.clone() + &start), 1);
    // The mesh is coarse: fine ones take longer and are made the same way.
    let blade = format!("[leaves.{name}.blade]\n");
    let edge = [2, 4, 8, 30][writer.chance.below(4)];
    let edge = format!("{blade}max_edge_mm = {edge}\n");
    if written.contains(&blade) {
        text.push_str(&written.replacen(&blade, &edge, 1));
    } else {
        text.push_str(&written);
        text.push_str(&edge);
    }
    text.push_str(&veins.replace("leaves.one", &format!("leaves.{name}")));
    share
}

/// A folder with the files that plans name.
pub(super) fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("the system has a place for temporary files");
    let write = |name: &str, bytes: &[u8]| {
        fs::write(folder.path().join(name), bytes).expect("the folder was just made");
    };
    write(
        "leaf.svg",
        b"<svg xmlns=\"http://www.w3.org/2000/svg\"><path id=\"margin\" d=\"M210 30 C260 90 330 120 \
          300 190 C360 200 380 260 300 330 C290 390 250 420 205 470 C150 430 90 380 80 300 C70 200 \
          150 120 210 30 Z\"/></svg>",
    );
    let grey: Vec<u8> = (0..3 * 8 * 8).map(|byte| (byte * 5 % 256) as u8).collect();
    let png = renderer::image::portable_network::encoded(8, 8, &grey).expect("a small picture");
    write("grey.png", &png);
    write(
        "cube.obj",
        b"v -9 -9 -9\nv 9 -9 -9\nv 9 9 -9\nv -9 9 -9\nv -9 -9 9\nv 9 -9 9\nv 9 9 9\nv -9 9 9\n\
          f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
    );
    write("ratio.csv", b"wavelength_nm,ratio\n300,1.5\n2600,1.1\n");
    folder
}
