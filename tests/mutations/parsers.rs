//! The parsers: all that the program reads.

use std::fs;
use std::path::Path;

use leafmodel::document::assets::Assets;
use leafmodel::document::report::DocumentErrors;
use leafmodel::import::{Format, Wanted, read, read_margin};
use renderer::checkpoint;
use renderer::geometry::import::import;
use renderer::image::{jpeg, openexr, portable_network, radiance, scan};
use renderer::scene::assets::{DECODER, mask, shining};
use renderer::scene::load::{parse, parse_leaves, parse_picture};
use renderer::scene::model::{self, Container};
use renderer::sweep::{Sweep, Words};

use super::seeds::{checkpoints, folder, mend_checkpoint, mend_png, seeds, whole_scene};
use super::trial::{Parser, refuse, run};

/// Whether a document was read; what is wrong with it is told.
fn accepted<T>(read: Result<T, DocumentErrors>) -> bool {
    read.map_err(|errors| {
        assert!(!errors.errors().is_empty(), "refused without an error");
        refuse(errors.to_string());
    })
    .is_ok()
}

/// Whether a file was read; what is wrong with it is told.
fn told<T, E: ToString>(read: Result<T, E>) -> bool {
    read.map_err(|error| refuse(error.to_string())).is_ok()
}

/// The parser of a file, of a text that names it.
fn of_named_file(name: &'static str, seeds_of: &[&str], file: &str, text: &str) {
    let folder = folder();
    let seeds = seeds_of.iter().flat_map(|name| seeds(name)).collect();
    let read = |bytes: &[u8]| {
        fs::write(folder.path().join(file), bytes).expect("the folder was just made");
        accepted(parse(text, "changed.toml", folder.path(), &[]))
    };
    run(&Parser {
        name,
        seeds,
        read: &read,
        mend: None,
    });
}

/// The scene of one floor, and more blocks.
fn scene_with(blocks: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("format/minimal.toml");
    fs::read_to_string(file).expect("a committed file") + blocks
}

#[test]
fn scenes() {
    let folder = folder();
    let mut seeds = seeds("scene");
    seeds.push(whole_scene());
    run(&Parser {
        name: "scene",
        seeds,
        read: &|bytes| {
            let text = String::from_utf8_lossy(bytes);
            accepted(parse(&text, "changed.toml", folder.path(), &[]))
        },
        mend: None,
    });
}

#[test]
fn leaves() {
    let folder = folder();
    let mut seeds = seeds("leaf");
    seeds.push(whole_scene());
    run(&Parser {
        name: "leaf",
        seeds,
        read: &|bytes| {
            let text = String::from_utf8_lossy(bytes);
            accepted(parse_leaves(&text, "changed.toml", folder.path(), &[]))
        },
        mend: None,
    });
}

#[test]
fn scenes_that_pictures_carry() {
    let mut seeds = seeds("scene");
    seeds.push(whole_scene());
    run(&Parser {
        name: "carried",
        seeds,
        read: &|bytes| {
            let text = String::from_utf8_lossy(bytes);
            accepted(parse_picture(&text, "changed.exr", &[]))
        },
        mend: None,
    });
}

#[test]
fn words_that_set_keys() {
    let folder = folder();
    let scene = scene_with("");
    run(&Parser {
        name: "words",
        seeds: seeds("words"),
        read: &|bytes| {
            let text = String::from_utf8_lossy(bytes);
            let words: Vec<String> = text.lines().map(str::to_owned).collect();
            accepted(parse(&scene, "scene.toml", folder.path(), &words))
        },
        mend: None,
    });
}

#[test]
fn sweeps() {
    let folder = folder();
    let file = folder.path().join("sweep.toml");
    run(&Parser {
        name: "sweep",
        seeds: seeds("sweep"),
        read: &|bytes| {
            fs::write(&file, bytes).expect("the folder was just made");
            accepted(Sweep::file(&file, &Words::default()))
        },
        mend: None,
    });
}

#[test]
fn tables_of_a_sweeps_tasks() {
    let folder = folder();
    let file = folder.path().join("sweep.toml");
    let text = "format = 1\nscene = \"scene.toml\"\nrows = \"rows.csv\"\n";
    fs::write(&file, text).expect("the folder was just made");
    run(&Parser {
        name: "rows",
        seeds: seeds("rows"),
        read: &|bytes| {
            fs::write(folder.path().join("rows.csv"), bytes).expect("the folder was just made");
            accepted(Sweep::file(&file, &Words::default()))
        },
        mend: None,
    });
}

#[test]
fn spectra() {
    let text = scene_with("").replace(
        "reflectance = 0.5",
        "reflectance = { file = \"paper.csv\" }",
    );
    let text = text.replace("format = 1\n", "format = 1\nextrapolate = true\n");
    of_named_file("spectrum", &["spectrum"], "paper.csv", &text);
}

const ROW: &str = "[meshes.ball.sphere]\nradius_m = 1\n[objects.row]\nmesh = [\"floor\", \"ball\"]\n\
                   material = \"grey\"\ninstances.file = \"NAME\"\n";

#[test]
fn tables_of_placements() {
    let text = scene_with(&ROW.replace("NAME", "places.csv"));
    of_named_file("placements", &["placements"], "places.csv", &text);
}

#[test]
fn arrays_of_placements() {
    let text = scene_with(&ROW.replace("NAME", "places.npy"));
    of_named_file("arrays", &["arrays"], "places.npy", &text);
}

#[test]
fn drawings() {
    let folder = folder();
    let leaf = "format = 1\n[leaves.drawn]\npreset = \"birch\"\n[leaves.drawn.outline.svg]\n\
                path = \"margin.svg\"\nid = \"blade\"\n";
    run(&Parser {
        name: "svg",
        seeds: seeds("svg"),
        read: &|bytes| {
            fs::write(folder.path().join("margin.svg"), bytes).expect("the folder was just made");
            accepted(parse_leaves(leaf, "leaf.toml", folder.path(), &[]))
        },
        mend: None,
    });
}

/// Networks of a format, with and without a scale, and their margins.
fn networks(name: &'static str, format: Format) {
    let wanted = Wanted {
        mm_per_unit: Some(0.01),
        ..Wanted::default()
    };
    let read = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes);
        let _ = read_margin(format, &text).and_then(|draft| draft.outlines(&wanted));
        told(read(format, &text, None).and_then(|draft| draft.network(&wanted)))
    };
    run(&Parser {
        name,
        seeds: seeds(name),
        read: &read,
        mend: None,
    });
}

#[test]
fn networks_as_graphml() {
    networks("graphml", Format::GraphMl);
}

#[test]
fn networks_as_json() {
    networks("network", Format::Json);
}

#[test]
fn networks_as_tables() {
    networks("edges", Format::Table);
}

#[test]
fn networks_as_gml() {
    networks("gml", Format::Gml);
}

#[test]
fn networks_as_lists_of_neighbours() {
    networks("neighbours", Format::Neighbours);
}

#[test]
fn networks_as_drawings() {
    networks("strokes", Format::Svg);
}

#[test]
fn meshes() {
    for name in ["ply", "obj"] {
        run(&Parser {
            name,
            seeds: seeds(name),
            read: &|bytes| told(import(bytes, name, 1.0)),
            mend: None,
        });
    }
}

#[test]
fn pictures_as_openexr() {
    let folder = folder();
    let file = folder.path().join("changed.exr");
    run(&Parser {
        name: "exr",
        seeds: seeds("exr"),
        read: &|bytes| {
            fs::write(&file, bytes).expect("the folder was just made");
            told(shining(&file, None));
            told(mask(&file, None));
            told(DECODER.contents(&file));
            told(openexr::decode(bytes))
        },
        mend: None,
    });
}

#[test]
fn pictures_as_png() {
    let folder = folder();
    let file = folder.path().join("changed.png");
    run(&Parser {
        name: "png",
        seeds: seeds("png"),
        read: &|bytes| {
            fs::write(&file, bytes).expect("the folder was just made");
            told(shining(&file, None));
            told(mask(&file, None));
            told(DECODER.weights(&file));
            told(scan::decode_grey(bytes));
            told(portable_network::decode(bytes))
        },
        mend: Some(mend_png),
    });
}

#[test]
fn pictures_as_jpeg() {
    run(&Parser {
        name: "jpeg",
        seeds: seeds("jpeg"),
        read: &|bytes| {
            told(scan::decode_grey(bytes));
            told(jpeg::decode(bytes))
        },
        mend: None,
    });
}

#[test]
fn pictures_as_radiance_hdr() {
    run(&Parser {
        name: "hdr",
        seeds: seeds("hdr"),
        read: &|bytes| told(radiance::decode(bytes)),
        mend: None,
    });
}

#[test]
fn models() {
    let read = |bytes: &[u8]| {
        let container = Container::open(bytes);
        let beside = |_: &str| None;
        told(
            container
                .and_then(|container| model::read(&container, &beside, 1.0, model::Wanted::ALL)),
        )
    };
    for name in ["gltf", "glb"] {
        run(&Parser {
            name,
            seeds: seeds(name),
            read: &read,
            mend: None,
        });
    }
}

#[test]
fn checkpoints_and_parts() {
    let folder = folder();
    let seeds = checkpoints();
    let (file, other) = (folder.path().join("changed"), folder.path().join("other"));
    fs::write(&other, &seeds[0]).expect("the folder was just made");
    run(&Parser {
        name: "checkpoint",
        seeds,
        read: &|bytes| {
            fs::write(&file, bytes).expect("the folder was just made");
            told(checkpoint::merge(&[other.clone(), file.clone()]));
            told(checkpoint::read(&file))
        },
        mend: Some(mend_checkpoint),
    });
}
