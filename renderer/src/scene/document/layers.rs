//! `[leaves.NAME.layers.LAYER]`: contents on top of the tissue's, and where they lie.

use std::sync::Arc;

use leafmodel::blade::layers::{Change, Layer, Mode};
use leafmodel::blade::masks::{Mask, Picture, RimWidth};
use leafmodel::optics::PerConstituent;

use super::contents::limits;
use super::limits::Limits;
use super::names::require_name;
use super::path::{Wanted, resolve};
use super::reader::Block;
use crate::scene::assets;
use crate::scene::error::SceneError;
use crate::scene::source::Place;

/// Largest picture that is read, bytes.
const MOST_PICTURE_BYTES: u64 = 1 << 30;

/// Softness of edges where nothing is said, mm.
pub(super) const SOFTNESS_MM: f64 = 0.5;
/// Size of noise where nothing is said, mm.
pub(super) const SCALE_MM: f64 = 5.0;
/// Softness of noise where nothing is said.
pub(super) const NOISE_SOFTNESS: f64 = 0.3;

const MM: Limits = Limits::closed(0.0, 1000.0);
const SOFT_MM: Limits = Limits::closed(0.001, 1000.0);
const PATCH_MM: Limits = Limits::closed(0.01, 1000.0);
const SHARE: Limits = Limits::closed(0.0, 1.0);

/// Reads all layers of a leaf, in the order of the file; `None` if one has an error.
pub(super) fn read_layers(leaf: &Block<'_>) -> Option<Vec<Layer>> {
    let Some(entry) = leaf.entry("layers") else {
        return Some(Vec::new());
    };
    let block = leaf.open(entry)?;
    let mut layers = Vec::new();
    let mut whole = true;
    for entry in &block.table.0 {
        require_name(block.cx, &entry.key, &entry.key_at);
        let errors = block.cx.error_count();
        let layer = block
            .open(entry)
            .and_then(|inner| read_layer(&inner, &entry.key));
        whole &= layer.is_some() && errors == block.cx.error_count();
        layers.extend(layer);
    }
    whole.then_some(layers)
}

fn read_layer(block: &Block<'_>, name: &str) -> Option<Layer> {
    let share = block.number_or("share", SHARE, 1.0);
    let mask = read_mask(block);
    let change = match block.exactly_one(&["contents", "map"]) {
        Some("contents") => read_values(block),
        Some(_) => block
            .text("map", "the path of an EXR with contents")
            .and_then(|(path, at)| read_map(block, path, at)),
        None => None,
    };
    if !matches!(change, Some(Change::Values { .. })) {
        // A map takes the place of everything.
        block.exclude("map", "mode");
    }
    block.finish();
    Some(Layer {
        name: name.to_owned(),
        mask: mask?,
        share,
        change: change?,
    })
}

fn read_values(block: &Block<'_>) -> Option<Change> {
    let mode = match block.optional_text("mode") {
        None | Some(("replace", _)) => Mode::Replace,
        Some(("add", _)) => Mode::Add,
        Some(("multiply", _)) => Mode::Multiply,
        Some((other, at)) => {
            let error = SceneError::Impossible {
                key: "mode".to_owned(),
                problem: format!("there is no mode \"{}\"", other.escape_debug()),
                help: "write \"replace\", \"add\" or \"multiply\"".to_owned(),
            };
            block.cx.error(at, error);
            return None;
        }
    };
    let inner = block.optional_block("contents")?;
    let values = PerConstituent::from_fn(|constituent| {
        let [_, most] = constituent.range();
        let limits = match mode {
            Mode::Replace => limits(constituent),
            Mode::Add => Limits::closed(-most, most),
            Mode::Multiply => Limits::closed(0.0, 100.0),
        };
        inner.optional_number(constituent.key(), limits)
    });
    inner.finish();
    Some(Change::Values { mode, values })
}

/// The mask; everywhere if none is there.
fn read_mask(block: &Block<'_>) -> Option<Mask> {
    const MASKS: [&str; 6] = ["margin", "veins", "midrib", "base_to_tip", "noise", "image"];
    let there = MASKS.map(|key| block.entry(key).is_some());
    let chosen = match there.into_iter().filter(|there| *there).count() {
        0 => return Some(Mask::Everywhere),
        _ => block.exactly_one(&MASKS)?,
    };
    let inner = block.optional_block(chosen)?;
    let softness = |inner: &Block<'_>| inner.number_or("softness_mm", SOFT_MM, SOFTNESS_MM);
    let mask = match chosen {
        "margin" => {
            let softness_mm = softness(&inner);
            let wander = inner.number_or("wander", SHARE, 0.0);
            let wander_scale_mm = inner.number_or("wander_scale_mm", PATCH_MM, SCALE_MM);
            let width = match inner.exactly_one(&["width_mm", "width_share"]) {
                Some("width_mm") => inner.number("width_mm", MM).map(RimWidth::Mm),
                Some(_) => inner
                    .number("width_share", Limits::closed(0.0, 2.0))
                    .map(RimWidth::HalfWidths),
                None => None,
            };
            width.map(|width| Mask::Margin {
                width,
                softness_mm,
                wander,
                wander_scale_mm,
            })
        }
        "veins" => {
            let lowest = inner.integer_or("lowest_order", 1, 20, 1);
            let highest = inner.integer_or("highest_order", lowest.max(1), 20, 20);
            let width_mm = inner.number("width_mm", MM);
            let softness_mm = softness(&inner);
            let outside = inner.flag_or("outside", false);
            width_mm.map(|width_mm| Mask::Veins {
                orders: [lowest as u8, highest as u8],
                width_mm,
                softness_mm,
                outside,
            })
        }
        "midrib" => {
            let softness_mm = softness(&inner);
            inner.number("width_mm", MM).map(|width_mm| Mask::Midrib {
                width_mm,
                softness_mm,
            })
        }
        "base_to_tip" => {
            let from = inner.number_or("from", SHARE, 0.0);
            let to = inner.number_or("to", SHARE, 1.0);
            if from == to {
                let error = SceneError::Impossible {
                    key: "to".to_owned(),
                    problem: "the layer begins where it is whole".to_owned(),
                    help: "let `from` and `to` differ".to_owned(),
                };
                block.cx.error(&inner.at, error);
            }
            (from != to).then_some(Mask::BaseToTip { from, to })
        }
        "noise" => {
            let scale_mm = inner.number_or("scale_mm", PATCH_MM, SCALE_MM);
            let threshold = inner.number_or("threshold", Limits::closed(-1.0, 1.0), 0.0);
            let softness = inner.number_or("softness", Limits::closed(0.001, 2.0), NOISE_SOFTNESS);
            let repeat_cells = inner.entry("repeat_cells").is_some();
            let cells = inner.integer_or("repeat_cells", 1, 65536, 1) as u32;
            Some(Mask::Noise {
                scale_mm,
                threshold,
                softness,
                repeat_cells: repeat_cells.then_some(cells),
            })
        }
        _ => {
            let channel = inner.optional_text("channel").map(|(name, _)| name);
            inner
                .text("file", "the path of a PNG or EXR")
                .and_then(|(path, at)| read_picture(&inner, path, at, channel))
        }
    };
    inner.finish();
    mask
}

fn read_picture(block: &Block<'_>, path: &str, at: &Place, channel: Option<&str>) -> Option<Mask> {
    let wanted = Wanted {
        endings: &["png", "exr"],
        most_bytes: MOST_PICTURE_BYTES,
    };
    let file = resolve(block.cx, path, at, wanted)?;
    match assets::mask(&file, channel) {
        Ok((width, values)) => Some(Mask::Picture(Arc::new(Picture {
            file: path.to_owned(),
            channel: channel.map(str::to_owned),
            width,
            texels: values.into_iter().map(|value| [value]).collect(),
        }))),
        Err(problem) => {
            bad_file(block, path, at, problem);
            None
        }
    }
}

fn read_map(block: &Block<'_>, path: &str, at: &Place) -> Option<Change> {
    let wanted = Wanted {
        endings: &["exr"],
        most_bytes: MOST_PICTURE_BYTES,
    };
    let file = resolve(block.cx, path, at, wanted)?;
    match assets::contents_map(&file) {
        Ok(map) => Some(Change::Map(Arc::new(Picture {
            file: path.to_owned(),
            channel: None,
            width: map.size().0,
            texels: map.texels().iter().map(|texel| *texel.as_array()).collect(),
        }))),
        Err(error) => {
            bad_file(block, path, at, error.without_path(&file));
            None
        }
    }
}

fn bad_file(block: &Block<'_>, path: &str, at: &Place, problem: String) {
    let error = SceneError::BadFile {
        path: path.escape_debug().to_string(),
        problem,
        help: "see docs/src/format/leaf.md for what pictures of layers hold".to_owned(),
    };
    block.cx.error(at, error);
}
