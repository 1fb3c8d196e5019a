//! Layers of contents as blocks of a file.

use leafmodel::blade::layers::{Change, Layer, Mode};
use leafmodel::blade::masks::{Mask, RimWidth};

use super::Keys;
use crate::scene::document::layers::{NOISE_SOFTNESS, SCALE_MM, SOFTNESS_MM};
use crate::scene::document::tree::Value;

pub(super) fn layers(layers: &[Layer]) -> Keys {
    let all = Keys::default();
    layers
        .iter()
        .fold(all, |keys, one| keys.with(&one.name, layer(one)))
}

fn text(keys: &mut Keys, key: &str, text: &str) {
    keys.value(key, Value::Text(text.to_owned()));
}

fn layer(layer: &Layer) -> Keys {
    let mut keys = Keys::default();
    keys.number_unless("share", layer.share, 1.0);
    match &layer.change {
        Change::Map(map) => text(&mut keys, "map", &map.file),
        Change::Values { mode, .. } => match mode {
            Mode::Replace => {}
            Mode::Add => text(&mut keys, "mode", "add"),
            Mode::Multiply => text(&mut keys, "mode", "multiply"),
        },
    }
    if let Some((name, block)) = mask(&layer.mask) {
        keys.block(name, block);
    }
    if let Change::Values { values, .. } = &layer.change {
        let mut block = Keys::default();
        for (constituent, value) in *values {
            if let Some(value) = value {
                block.number(constituent.key(), value);
            }
        }
        keys.block("contents", block);
    }
    keys
}

fn mask(mask: &Mask) -> Option<(&'static str, Keys)> {
    let mut keys = Keys::default();
    let name = match mask {
        Mask::Everywhere => return None,
        Mask::Margin {
            width,
            softness_mm,
            wander,
            wander_scale_mm,
        } => {
            match *width {
                RimWidth::Mm(mm) => keys.number("width_mm", mm),
                RimWidth::HalfWidths(share) => keys.number("width_share", share),
            }
            keys.number_unless("softness_mm", *softness_mm, SOFTNESS_MM);
            keys.number_unless("wander", *wander, 0.0);
            keys.number_unless("wander_scale_mm", *wander_scale_mm, SCALE_MM);
            "margin"
        }
        Mask::Veins {
            orders: [lowest, highest],
            width_mm,
            softness_mm,
            outside,
        } => {
            keys.number_unless("lowest_order", f64::from(*lowest), 1.0);
            keys.number_unless("highest_order", f64::from(*highest), 20.0);
            keys.number("width_mm", *width_mm);
            keys.number_unless("softness_mm", *softness_mm, SOFTNESS_MM);
            if *outside {
                keys.value("outside", Value::Flag(true));
            }
            "veins"
        }
        Mask::Midrib {
            width_mm,
            softness_mm,
        } => {
            keys.number("width_mm", *width_mm);
            keys.number_unless("softness_mm", *softness_mm, SOFTNESS_MM);
            "midrib"
        }
        Mask::BaseToTip { from, to } => {
            keys.number_unless("from", *from, 0.0);
            keys.number_unless("to", *to, 1.0);
            "base_to_tip"
        }
        Mask::Noise {
            scale_mm,
            threshold,
            softness,
            repeat_cells,
        } => {
            keys.number_unless("scale_mm", *scale_mm, SCALE_MM);
            keys.number_unless("threshold", *threshold, 0.0);
            keys.number_unless("softness", *softness, NOISE_SOFTNESS);
            if let Some(cells) = repeat_cells {
                keys.integer("repeat_cells", u64::from(*cells));
            }
            "noise"
        }
        Mask::Picture(picture) => {
            text(&mut keys, "file", &picture.file);
            if let Some(channel) = &picture.channel {
                text(&mut keys, "channel", channel);
            }
            "image"
        }
    };
    Some((name, keys))
}
