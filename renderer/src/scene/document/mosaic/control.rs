//! `mosaic.controls.NAME`: an image wrapped round a cylinder that steers cells.

use glam::DVec3;
use leafmodel::mosaic::control::{ControlImage, CylinderControl, Steered};

use super::{SHARE, impossible};
use crate::image::portable_network;
use crate::scene::document::context::QUOTED;
use crate::scene::document::limits::Limits;
use crate::scene::document::names::Names;
use crate::scene::document::path::{Wanted, resolve};
use crate::scene::document::reader::Block;
use crate::scene::document::values::text_at;
use crate::scene::error::SceneError;
use crate::scene::source::escaped;

const COORDINATES_MM: Limits = Limits::closed(-1e6, 1e6);
const FACTOR: Limits = Limits::closed(0.0, 1000.0);
const IMAGES: [&str; 5] = ["picture", "stripes", "rings", "noise", "constant"];

/// All controls in the file's order, if none has an error.
pub(super) fn read_controls(mosaic: &Block<'_>, types: &Names<'_>) -> Option<Vec<CylinderControl>> {
    if mosaic.entry("controls").is_none() {
        return Some(Vec::new());
    }
    let section = mosaic.optional_block("controls")?;
    let read: Vec<Option<CylinderControl>> = section
        .table
        .0
        .iter()
        .map(|entry| read_control(&section.open(entry)?, types))
        .collect();
    read.into_iter().collect()
}

fn read_control(block: &Block<'_>, types: &Names<'_>) -> Option<CylinderControl> {
    let from = block.numbers::<3>("from_mm", COORDINATES_MM);
    let to = block.numbers::<3>("to_mm", COORDINATES_MM);
    let radius_mm = block.optional_number("radius_mm", Limits::above(0.0, 1e6));
    let image = read_image(block);
    let steers = read_steered(block, types);
    block.finish();
    let (from, to) = (DVec3::from_array(from?), DVec3::from_array(to?));
    if from == to {
        impossible(
            block,
            "to_mm",
            "the axis has no length: it ends where it starts".to_owned(),
            "let the axis run through the body from end to end",
        );
        return None;
    }
    Some(CylinderControl {
        from,
        to,
        radius_mm,
        image: image?,
        steers: steers?,
    })
}

fn read_steered(block: &Block<'_>, types: &Names<'_>) -> Option<Steered> {
    const WORDS: [&str; 4] = ["initial_type", "division_rate", "adhesion", "blocked"];
    block.needed("steers", || {
        "`steers = \"…\"`, one of `initial_type`, `division_rate`, `adhesion`, `blocked`".to_owned()
    })?;
    let steers = block.word("steers", &WORDS)?;
    let find = |key: &'static str| {
        let node = block.node(key)?;
        let found = types.find(block.cx, text_at(block.cx, node, key)?);
        found.map(|index| index as u16)
    };
    let factors = || {
        let low = block.number_or("low", FACTOR, 0.0);
        (low, block.number_or("high", FACTOR, 1.0))
    };
    match steers {
        "initial_type" => {
            block.needed("type", || "`type = \"…\"`, the name of a type".to_owned())?;
            find("type").map(Steered::InitialType)
        }
        "division_rate" => {
            let is_named = block.entry("type").is_some();
            let kind = find("type");
            let (low, high) = factors();
            (kind.is_some() || !is_named).then_some(Steered::DivisionRate { kind, low, high })
        }
        "adhesion" => {
            for key in ["type", "other_type"] {
                block.needed(key, || format!("`{key} = \"…\"`, the name of a type"))?;
            }
            let pair = find("type").zip(find("other_type"));
            let (low, high) = factors();
            pair.map(|(a, b)| Steered::Adhesion {
                pair: [a, b],
                low,
                high,
            })
        }
        _ => Some(Steered::Blocked),
    }
}

fn read_image(control: &Block<'_>) -> Option<ControlImage> {
    let kind = control.exactly_one(&IMAGES)?;
    if kind == "constant" {
        return control
            .number("constant", SHARE)
            .map(ControlImage::Constant);
    }
    let block = control.optional_block(kind)?;
    let image = match kind {
        "picture" => read_picture(&block),
        "stripes" => {
            let count = block.integer("count", 1, 10_000);
            let share = block.number_or("share", SHARE, 0.5);
            let room = Limits::closed(0.0, (1.0 - share) / 2.0);
            let waviness = block.number_or("waviness", room, 0.0);
            let bends = block.number_or("bends", Limits::closed(0.0, 1000.0), 4.0);
            let seed = block.integer_or("seed", 0, u64::MAX, 0);
            count.map(|count| ControlImage::Stripes {
                count: count as u32,
                share,
                waviness,
                bends,
                seed,
            })
        }
        "rings" => {
            let count = block.integer("count", 1, 10_000);
            let share = block.number_or("share", SHARE, 0.5);
            count.map(|count| ControlImage::Rings {
                count: count as u32,
                share,
            })
        }
        _ => {
            let around = block.integer("around", 1, 10_000);
            let octaves = block.integer_or("octaves", 1, 10, 1) as u32;
            let threshold = block.optional_number("threshold", SHARE);
            let seed = block.integer_or("seed", 0, u64::MAX, 0);
            around.map(|around| ControlImage::Noise {
                around: around as u32,
                octaves,
                threshold,
                seed,
            })
        }
    };
    block.finish();
    image
}

/// The grey of a PNG as it is stored, 0 to 1.
fn read_picture(block: &Block<'_>) -> Option<ControlImage> {
    let wanted = Wanted {
        endings: &["png"],
        most_bytes: 64 << 20,
    };
    let (written, at) = block.text("path", "the path of a PNG file")?;
    let file = resolve(block.cx, written, at, wanted)?;
    match portable_network::read_weights(&file, false) {
        Ok(picture) => {
            let values = picture.layers.into_iter().flat_map(|layer| layer.data);
            Some(ControlImage::Picture {
                file: written.to_owned(),
                width: picture.width as usize,
                height: picture.height as usize,
                values: values.map(f64::from).collect(),
            })
        }
        Err(error) => {
            let error = SceneError::BadFile {
                path: escaped(written, 2 * QUOTED),
                problem: escaped(&format!("cannot be read: {error}"), 4 * QUOTED),
                help: "save it anew as a PNG".to_owned(),
            };
            block.cx.error(at, error);
            None
        }
    }
}
