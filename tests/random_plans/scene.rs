//! A random scene: several blocks of each section, by the schema.

use std::fmt::Write as _;

use leafmodel::document::schema::BlockSchema;

use super::chance::Chance;
use super::plan::{SCHEMA, leaf, tameness};
use super::written::{NAMES, Writer};

/// Writes the blocks of one scene.
struct Scene {
    chance: Chance,
    share: f64,
    tame: f64,
    text: String,
}

/// Keys of the sun's place by date and place on earth, and those that an elevation says.
const DATES: [&str; 6] = [
    "latitude_deg",
    "longitude_deg",
    "time",
    "elevation_deg",
    "azimuth_deg",
    "compass_deg",
];

fn schema_of(path: &[&str]) -> &'static BlockSchema {
    SCHEMA.at(path).expect("scenes have such a block")
}

impl Scene {
    /// Writes a block, with lines of its own at its start.
    fn block(&mut self, path: &str, schema: &[&str], is_whole: bool, skip: &[&str], lines: &str) {
        let mut writer = Writer {
            chance: &mut self.chance,
            share: self.share,
            tame: self.tame,
            text: String::new(),
        };
        writer.block(path, schema_of(schema), is_whole, skip);
        let header = format!("[{path}]\n");
        let written = writer.text.replacen(&header, &(header.clone() + lines), 1);
        self.text.push_str(&written);
    }

    /// Writes one or two blocks of a section, each of one of these kinds.
    fn section(&mut self, section: &str, kinds: &[&str]) {
        for name in NAMES {
            if name == NAMES[0] || self.chance.is(0.5) {
                let kind = kinds[self.chance.below(kinds.len())];
                let path = format!("{section}.{name}.{kind}");
                let (skip, lines): (&[&str], _) = match kind {
                    "daylight" => (&DATES, "elevation_deg = 40\nazimuth_deg = 10\n"),
                    _ => (&[], ""),
                };
                self.block(&path, &[section, "NAME", kind], true, skip, lines);
            }
        }
    }

    fn camera_and_film(&mut self) {
        let film = ["rgb", "spectral"][self.chance.below(2)];
        let lines = match film {
            "rgb" => "size = [4, 4]\nspp = 1\n",
            _ => "size = [4, 4]\nspp = 1\nbands_nm = [450, 550, 700]\nband_width_nm = 20\n",
        };
        let path = format!("film.{film}");
        let skip = [
            "size",
            "spp",
            "bands_nm",
            "band_width_nm",
            "range_nm",
            "sensor",
        ];
        self.block(&path, &["film", film], true, &skip, lines);
        let camera = ["perspective", "orthographic"][self.chance.below(2)];
        let mut lines = String::new();
        for (key, at) in [
            ("position_m", [0.0, -0.4, 0.3]),
            ("look_at_m", [0.0, 0.04, 0.0]),
        ] {
            let at = at.map(|x: f64| x + 0.3 * (self.chance.uniform() - 0.5));
            let _ = writeln!(lines, "{key} = {at:?}");
        }
        lines.push_str(match camera {
            "perspective" => "vertical_fov_deg = 40\n",
            _ => "height_m = 0.3\n",
        });
        let path = format!("camera.{camera}");
        // What the angle and the height say already.
        let skip = [
            "position_m",
            "look_at_m",
            "vertical_fov_deg",
            "height_m",
            "focal_length_mm",
            "magnification",
            "frame",
            "sensor_height_mm",
        ];
        self.block(&path, &["camera", camera], true, &skip, &lines);
    }

    fn object(&mut self, name: &str, lines: &str) {
        let path = format!("objects.{name}");
        let skip = [
            "mesh",
            "material",
            "leaf",
            "solid",
            "plant",
            "instances",
            "scatter",
            "volume",
        ];
        self.block(&path, &["objects", "NAME"], false, &skip, lines);
    }
}

/// The scene of a number.
pub(super) fn text(number: u64) -> String {
    let mut chance = Chance::of(number ^ (1 << 40));
    let tame = tameness(&mut chance);
    let share = 0.3 * chance.uniform();
    let mut scene = Scene {
        chance,
        share,
        tame,
        text: "format = 1\nextrapolate = true\n".to_owned(),
    };
    scene.camera_and_film();
    for section in ["integrator", "picture"] {
        if scene.chance.is(0.4) {
            scene.block(
                section,
                &[section],
                false,
                &["white_object", "grey_object"],
                "",
            );
        }
    }
    scene.section(
        "lights",
        &[
            "constant",
            "distant",
            "daylight",
            "overcast",
            "spot",
            "environment",
        ],
    );
    let shapes = [
        "rectangle",
        "box",
        "disc",
        "sphere",
        "drop",
        "lump",
        "terrain",
        "masonry",
        "file",
    ];
    scene.section("meshes", &shapes);
    scene.section(
        "materials",
        &["diffuse", "dielectric", "plastic", "leaf", "solid"],
    );
    if scene.chance.is(0.3) {
        scene.block("media.a", &["media", "NAME"], true, &[], "");
    }
    scene.object("a", "mesh = \"a\"\nmaterial = \"a\"\n");
    if scene.chance.is(0.5) {
        leaf(&mut scene.chance, "a", tame, &mut scene.text);
        scene.object("b", "leaf = \"a\"\n");
    }
    if scene.chance.is(0.2) {
        scene.block(
            "solids.a",
            &["solids", "NAME"],
            true,
            &["map_size"],
            "map_size = 32\n",
        );
        scene.object("c", "solid = \"a\"\n");
    }
    if scene.chance.is(0.2) {
        scene.object("d", "mesh = \"a\"\nmaterial = \"a\"\nscale = 1e-3\n");
        let kind = ["scatter", "volume"][scene.chance.below(2)];
        let lines = match kind {
            "scatter" => "on = \"a\"\n",
            _ => "within_m = [-0.1, -0.1, 0, 0.1, 0.1, 0.1]\n",
        };
        let path = format!("objects.d.{kind}");
        let skip = ["on", "within_m", "over"];
        scene.block(&path, &["objects", "NAME", kind], true, &skip, lines);
    }
    if scene.chance.is(0.25) {
        let kind = ["sphere", "gonio", "canopy", "depth"][scene.chance.below(4)];
        let path = format!("instruments.a.{kind}");
        let lines = match kind {
            "canopy" => "within_m = [-0.1, -0.1, 0.1, 0.1]\n",
            _ => "object = \"a\"\n",
        };
        let skip = ["within_m", "object", "soil"];
        scene.block(&path, &["instruments", "NAME", kind], true, &skip, lines);
    }
    scene.text
}
