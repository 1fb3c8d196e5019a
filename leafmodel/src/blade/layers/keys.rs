//! `layers.NAME`: contents on top of the tissue's, and where they lie.

use std::sync::Arc;

use crate::blade::layers::{Change, Layer, Mode};
use crate::blade::masks::{Mask, Picture, RimWidth};
use crate::document::assets::Raster;
use crate::document::declared::Declared;
use crate::document::keys::{Keys, NamedList, Variant};
use crate::document::limits::Limits;
use crate::document::named_asset::{asset, bad_file};
use crate::document::source::Place;
use crate::document::value_kind::{Flag, Integer, Number, Text, Word};
use crate::optics::contents_keys::limits;
use crate::optics::{Constituent, PerConstituent};

/// Softness of edges where nothing is said, mm.
const SOFTNESS_MM: f64 = 0.5;
/// Size of noise where nothing is said, mm.
const SCALE_MM: f64 = 5.0;
/// Softness of noise where nothing is said.
const NOISE_SOFTNESS: f64 = 0.3;

const MM: Number = Number(Limits::closed(0.0, 1000.0));
const SOFT_MM: Number = Number(Limits::closed(0.001, 1000.0));
const PATCH_MM: Number = Number(Limits::closed(0.01, 1000.0));
const SHARE: Number = Number(Limits::closed(0.0, 1.0));
const SOFTNESS: &str = "Width of the edge.";

impl Layer {
    /// All layers of a leaf.
    pub(crate) fn all(layers: &mut Vec<Self>, keys: &mut Keys<'_>) {
        let list = NamedList {
            required: false,
            new: &|name: &str| Self {
                name: name.to_owned(),
                mask: Mask::Everywhere,
                share: 1.0,
                change: none(),
            },
            name_of: |layer: &Self| &layer.name,
        };
        let about = "Contents on top of the tissue's, the later on top.";
        keys.named("layers", layers, &list, about, Self::declare);
    }
}

fn none() -> Change {
    Change::Values {
        mode: Mode::Replace,
        values: PerConstituent::splat(None),
    }
}

impl Declared for Layer {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let about = "Factor on the mask's weight.";
        keys.key("share", &mut self.share, SHARE, about);
        keys.kind_or_none(&mut self.mask, &MASKS);
        let current = match self.change {
            Change::Values { .. } => "contents",
            Change::Map(_) => "map",
        };
        for name in keys.one_of(&["contents", "map"], Some(current)) {
            if name == "contents" {
                values(&mut self.change, keys);
            } else {
                map(&mut self.change, keys);
            }
        }
    }
}

/// Contents that are replaced, added to or multiplied.
fn values(change: &mut Change, keys: &mut Keys<'_>) {
    if matches!(change, Change::Map(_)) {
        *change = none();
    }
    let Change::Values { mode, values } = change else {
        return;
    };
    let words = [
        ("replace", Mode::Replace),
        ("add", Mode::Add),
        ("multiply", Mode::Multiply),
    ];
    let about = "How the numbers change what is below: they take its place, are added (also \
        below 0), or are factors (0 to 100).";
    keys.key("mode", mode, Word(&words), about);
    let mode = *mode;
    let about = "What it changes.";
    keys.required_block("contents", about, &[], |keys| {
        for (constituent, value) in values.iter_mut() {
            let [_, most] = constituent.range();
            let limits = match mode {
                Mode::Replace => limits(constituent),
                Mode::Add => Limits::closed(-most, most),
                Mode::Multiply => Limits::closed(0.0, 100.0),
            };
            let number = Number(limits);
            keys.optional(constituent.key(), value, number, constituent.meaning());
        }
    });
}

/// All contents from a map, which takes the place of everything.
fn map(change: &mut Change, keys: &mut Keys<'_>) {
    keys.exclude("map", "mode");
    let before = match change {
        Change::Map(map) => map.file.clone(),
        Change::Values { .. } => String::new(),
    };
    let mut file = before.clone();
    let path = Text("the path of an EXR with contents");
    let about = "An EXR that takes the place of all contents, as `materials.NAME.leaf.map` reads \
        it.";
    keys.required("map", &mut file, path, about);
    if file == before && !keys.is_description() {
        return;
    }
    let mut read = Picture {
        file,
        channel: None,
        width: 1,
        texels: Vec::new(),
    };
    if keys.is_sound()
        && let Some((assets, file, at)) = asset(keys, "map", &["exr"])
    {
        match assets.contents(&file) {
            Ok(Raster { width, values }) => {
                read.width = width;
                let texels = values.chunks_exact(Constituent::COUNT);
                read.texels = texels
                    .map(|texel| std::array::from_fn(|index| texel[index]))
                    .collect();
            }
            Err(problem) => refuse(keys, &at, &read.file, &problem),
        }
    }
    *change = Change::Map(Arc::new(read));
}

const MASKS: [Variant<Mask>; 6] = [
    Variant {
        name: "margin",
        about: "Within some distance of the margin.",
        new: || Mask::Margin {
            width: RimWidth::Mm(0.0),
            softness_mm: SOFTNESS_MM,
            wander: 0.0,
            wander_scale_mm: SCALE_MM,
        },
        is: |mask| matches!(mask, Mask::Margin { .. }),
        declare: |mask, keys| {
            let Mask::Margin {
                width,
                softness_mm,
                wander,
                wander_scale_mm,
            } = mask
            else {
                return;
            };
            let current = match width {
                RimWidth::Mm(_) => "width_mm",
                RimWidth::HalfWidths(_) => "width_share",
            };
            for name in keys.one_of(&["width_mm", "width_share"], Some(current)) {
                let (RimWidth::Mm(mut value) | RimWidth::HalfWidths(mut value)) = *width;
                *width = if name == "width_mm" {
                    keys.required("width_mm", &mut value, MM, "Width of the rim.");
                    RimWidth::Mm(value)
                } else {
                    let limits = Number(Limits::closed(0.0, 2.0));
                    let about = "Width of the rim, in half-widths of the leaf.";
                    keys.required("width_share", &mut value, limits, about);
                    RimWidth::HalfWidths(value)
                };
            }
            keys.key("softness_mm", softness_mm, SOFT_MM, SOFTNESS);
            let about = "Share by which its width varies along the margin.";
            keys.key("wander", wander, SHARE, about);
            let about = "Size of those variations.";
            keys.key("wander_scale_mm", wander_scale_mm, PATCH_MM, about);
        },
    },
    Variant {
        name: "veins",
        about: "Within some distance of the axes of veins.",
        new: || Mask::Veins {
            orders: [1, 20],
            width_mm: 0.0,
            softness_mm: SOFTNESS_MM,
            outside: false,
        },
        is: |mask| matches!(mask, Mask::Veins { .. }),
        declare: |mask, keys| {
            if let Mask::Veins {
                orders: [lowest, highest],
                width_mm,
                softness_mm,
                outside,
            } = mask
            {
                let about = "Lowest order of veins that count.";
                keys.key("lowest_order", lowest, Integer::within(1, 20), about);
                let highest_orders = Integer::within(u64::from(*lowest).max(1), 20);
                let about = "Highest order of veins that count.";
                keys.key("highest_order", highest, highest_orders, about);
                keys.required("width_mm", width_mm, MM, "Distance from the axis.");
                keys.key("softness_mm", softness_mm, SOFT_MM, SOFTNESS);
                let about = "Whether it lies between veins instead.";
                keys.key("outside", outside, Flag, about);
            }
        },
    },
    Variant {
        name: "midrib",
        about: "Within some distance of the line from base to apex.",
        new: || Mask::Midrib {
            width_mm: 0.0,
            softness_mm: SOFTNESS_MM,
        },
        is: |mask| matches!(mask, Mask::Midrib { .. }),
        declare: |mask, keys| {
            if let Mask::Midrib {
                width_mm,
                softness_mm,
            } = mask
            {
                keys.key("softness_mm", softness_mm, SOFT_MM, SOFTNESS);
                keys.required("width_mm", width_mm, MM, "Distance from the line.");
            }
        },
    },
    Variant {
        name: "base_to_tip",
        about: "More and more of it along the midrib.",
        new: || Mask::BaseToTip { from: 0.0, to: 1.0 },
        is: |mask| matches!(mask, Mask::BaseToTip { .. }),
        declare: |mask, keys| {
            if let Mask::BaseToTip { from, to } = mask {
                let about = "Where there is nothing of it: 0 the base, 1 the apex.";
                keys.key("from", from, SHARE, about);
                keys.key("to", to, SHARE, "Where there is all of it.");
                if keys.is_sound() && from == to {
                    let problem = "the layer begins where it is whole";
                    let help = "let `from` and `to` differ";
                    keys.refuse(&["to"], problem.to_owned(), help);
                }
            }
        },
    },
    Variant {
        name: "noise",
        about: "In patches.",
        new: || Mask::Noise {
            scale_mm: SCALE_MM,
            threshold: 0.0,
            softness: NOISE_SOFTNESS,
            repeat_cells: None,
        },
        is: |mask| matches!(mask, Mask::Noise { .. }),
        declare: |mask, keys| {
            if let Mask::Noise {
                scale_mm,
                threshold,
                softness,
                repeat_cells,
            } = mask
            {
                keys.key("scale_mm", scale_mm, PATCH_MM, "Size of patches.");
                let limits = Number(Limits::closed(-1.0, 1.0));
                let about = "Noise above which there is some of it; higher is less.";
                keys.key("threshold", threshold, limits, about);
                let limits = Number(Limits::closed(0.001, 2.0));
                let about = "Width of the edge, in noise.";
                keys.key("softness", softness, limits, about);
                let count = Integer::within(1, 65536);
                let about = "Patches after which the pattern repeats; left out, never.";
                keys.optional("repeat_cells", repeat_cells, count, about);
            }
        },
    },
    Variant {
        name: "image",
        about: "As a picture over the leaf's box says.",
        new: || {
            Mask::Picture(Arc::new(Picture {
                file: String::new(),
                channel: None,
                width: 1,
                texels: Vec::new(),
            }))
        },
        is: |mask| matches!(mask, Mask::Picture(_)),
        declare: |mask, keys| {
            if let Mask::Picture(picture) = mask {
                let (mut file, mut channel) = (picture.file.clone(), picture.channel.clone());
                let path = Text("the path of a PNG or EXR");
                keys.required("file", &mut file, path, "The picture.");
                let name = Text("the name of a channel");
                let about = "Which channel of an EXR; left out, its grey.";
                keys.optional("channel", &mut channel, name, about);
                if file != picture.file || channel != picture.channel {
                    *picture = Arc::new(Picture {
                        file,
                        channel,
                        width: 1,
                        texels: Vec::new(),
                    });
                    if keys.is_sound() {
                        read_picture(picture, keys);
                    }
                }
            }
        },
    },
];

fn read_picture(picture: &mut Arc<Picture<1>>, keys: &Keys<'_>) {
    let Some((assets, file, at)) = asset(keys, "file", &["png", "exr"]) else {
        return;
    };
    match assets.grey(&file, picture.channel.as_deref()) {
        Ok(Raster { width, values }) => {
            *picture = Arc::new(Picture {
                file: picture.file.clone(),
                channel: picture.channel.clone(),
                width,
                texels: values.into_iter().map(|value| [value]).collect(),
            });
        }
        Err(problem) => refuse(keys, &at, &picture.file, &problem),
    }
}

fn refuse(keys: &Keys<'_>, at: &Place, path: &str, problem: &str) {
    if let Some(block) = keys.reader() {
        let help = "see docs/src/format/leaf.md for what pictures of layers hold";
        bad_file(block.cx, at, path, problem, help);
    }
}
