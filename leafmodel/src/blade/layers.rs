//! Layers of contents on the lamina, each on top of those before.
//!
//! A layer is a change of contents, a [`Mask`] that says where, and a share: where it weighs `w`,
//! the contents `C` below it become `C + (C′ − C) w`. Layers set the contents of the living lamina
//! between veins. Ageing, veins and the mottle apply afterwards, in this order.

use std::sync::Arc;

use glam::DVec2;

use super::ageing::Place;
use super::frame::UvFrame;
use super::masks::{MEND_PICTURE, Mask, MaskField, Picture};
use crate::document::named_asset::decoded;
use crate::document::{
    Declared, Keys, Kinds, Limits, NamedList, Number, RangeError, Text, Word, Words,
};
use crate::optics::contents_keys::limits;
use crate::optics::{Constituent, Contents, PerConstituent};
use crate::random::{self, Use};

/// A layer of contents.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct Layer {
    /// Its name in the plan.
    pub name: String,
    /// Factor on the mask's weight.
    #[key("share", 0.0..=1.0)]
    pub share: f64,
    /// Where it lies.
    #[key(flat, with = mask)]
    pub mask: Mask,
    /// What it changes.
    #[key(flat, with = change)]
    pub change: Change,
}

/// How a layer changes the contents below it.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Some of the contents are changed by numbers; the others stay.
    Values {
        /// How.
        mode: Mode,
        /// The numbers, −1000 to 1000 with [`Mode::Add`], else 0 to 1000.
        values: PerConstituent<Option<f64>>,
    },
    /// All contents are replaced by those of a map over the leaf's box.
    Map(Arc<Picture<{ Constituent::COUNT }>>),
}

/// How numbers change contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Words)]
pub enum Mode {
    /// They replace contents.
    Replace,
    /// They are added; no content falls below 0, structure not below 1.
    Add,
    /// They are factors.
    Multiply,
}

impl Change {
    /// No change.
    const NONE: Self = Self::Values {
        mode: Mode::Replace,
        values: PerConstituent::splat(None),
    };
}

fn mask(mask: &mut Mask, keys: &mut Keys<'_>) {
    keys.kind_or_none(mask, Mask::KINDS);
}

fn change(change: &mut Change, keys: &mut Keys<'_>) {
    let current = match change {
        Change::Values { .. } => "contents",
        Change::Map(_) => "map",
    };
    for name in keys.one_of(&["contents", "map"], Some(current)) {
        if name == "contents" {
            values(change, keys);
        } else {
            map(change, keys);
        }
    }
}

fn values(change: &mut Change, keys: &mut Keys<'_>) {
    if matches!(change, Change::Map(_)) {
        *change = Change::NONE;
    }
    let Change::Values { mode, values } = change else {
        return;
    };
    let about = "How the numbers change what is below: they take its place, are added (also \
        below 0), or are factors (0 to 100).";
    keys.key("mode", mode, Word(Words::WORDS), about);
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
    let decoded = decoded(keys, "map", &["exr"], |assets, file| {
        let read = assets.contents(file);
        read.map_err(|problem| (problem, MEND_PICTURE))
    });
    *change = Change::Map(Arc::new(Picture::of_raster(file, None, decoded)));
}

impl Layer {
    /// The keys of all layers of a leaf.
    pub(crate) fn all(layers: &mut Vec<Self>, keys: &mut Keys<'_>) {
        let list = NamedList {
            required: false,
            new: &|name: &str| Self {
                name: name.to_owned(),
                mask: Mask::Everywhere,
                share: 1.0,
                change: Change::NONE,
            },
            name_of: |layer: &Self| &layer.name,
        };
        let about = "Contents on top of the tissue's, the later on top.";
        keys.named("layers", layers, &list, about, Self::declare);
    }

    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`RangeError`] for the first that is out of range.
    pub fn validate(&self) -> Result<(), RangeError> {
        self.in_range()?;
        self.mask.validate()
    }
}

/// Layers prepared for many points of one leaf.
#[derive(Debug)]
pub(super) struct LayerFields<'a> {
    frame: &'a UvFrame,
    layers: Vec<(&'a Layer, MaskField<'a>)>,
}

impl<'a> LayerFields<'a> {
    pub(super) fn new(layers: &'a [Layer], place: &Place<'a>, seed: u64) -> Self {
        let ready = layers.iter().enumerate().map(|(number, layer)| {
            let seed = random::bits(seed, Use::Layer, number as u64);
            (layer, MaskField::new(&layer.mask, place, seed))
        });
        Self {
            frame: place.frame,
            layers: ready.collect(),
        }
    }

    /// Contents of the lamina at a point (mm); `ground` are the contents below all layers.
    pub(super) fn contents(&self, ground: Contents, p: DVec2) -> Contents {
        if self.layers.is_empty() {
            return ground;
        }
        let mut contents = ground;
        for (layer, mask) in &self.layers {
            let weight = layer.share * mask.at(p);
            if weight <= 0.0 {
                continue;
            }
            match &layer.change {
                Change::Values { mode, values: by } => {
                    for (constituent, value) in contents.iter_mut() {
                        let Some(by) = by[constituent] else { continue };
                        let target = match mode {
                            Mode::Replace => by,
                            Mode::Add => *value + by,
                            Mode::Multiply => *value * by,
                        };
                        *value += (target.max(constituent.least()) - *value) * weight;
                    }
                }
                Change::Map(map) => {
                    let targets = PerConstituent::new(map.at(self.frame.uv(p)));
                    for (constituent, value) in contents.iter_mut() {
                        let target = targets[constituent].max(constituent.least());
                        *value += (target - *value) * weight;
                    }
                }
            }
        }
        contents
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: UvFrame = UvFrame {
        min: DVec2::ZERO,
        size: DVec2::new(10.0, 10.0),
    };

    fn ground() -> Contents {
        Contents::of(&[
            (Constituent::Structure, 1.5),
            (Constituent::Chlorophyll, 40.0),
            (Constituent::Carotenoids, 9.0),
            (Constituent::Anthocyanins, 1.0),
            (Constituent::Brown, 0.1),
            (Constituent::Water, 0.01),
            (Constituent::DryMatter, 0.005),
        ])
    }

    fn layer(mode: Mode, chlorophyll: f64, share: f64) -> Layer {
        let values = PerConstituent::splat(None);
        let values = values.with(&[(Constituent::Chlorophyll, Some(chlorophyll))]);
        Layer {
            name: "test".to_owned(),
            mask: Mask::Everywhere,
            share,
            change: Change::Values { mode, values },
        }
    }

    fn painted(layers: &[Layer]) -> Contents {
        let place = Place {
            frame: &FRAME,
            margin: &[],
            veins: &[],
            base: DVec2::ZERO,
            apex: DVec2::Y,
        };
        LayerFields::new(layers, &place, 1).contents(ground(), DVec2::ONE)
    }

    #[test]
    fn layers_replace_add_and_multiply_by_their_share_and_leave_the_rest() {
        for (mode, by, share, chlorophyll) in [
            (Mode::Replace, 10.0, 1.0, 10.0),
            (Mode::Replace, 10.0, 0.5, 25.0),
            (Mode::Add, -10.0, 0.5, 35.0),
            (Mode::Add, -100.0, 1.0, 0.0),
            (Mode::Multiply, 0.5, 1.0, 20.0),
            (Mode::Multiply, 0.5, 0.0, 40.0),
        ] {
            let expected = ground().with(&[(Constituent::Chlorophyll, chlorophyll)]);
            assert_eq!(painted(&[layer(mode, by, share)]), expected);
        }
    }

    #[test]
    fn later_layers_lie_on_top() {
        let (pale, twice) = (
            layer(Mode::Replace, 10.0, 1.0),
            layer(Mode::Multiply, 2.0, 1.0),
        );
        let chlorophyll = |layers: &[Layer]| painted(layers)[Constituent::Chlorophyll];
        assert_eq!(chlorophyll(&[pale.clone(), twice.clone()]), 20.0);
        assert_eq!(chlorophyll(&[twice, pale]), 10.0);
        assert_eq!(painted(&[]), ground());
    }

    #[test]
    fn a_map_takes_the_place_of_all_contents() {
        let texel = std::array::from_fn(|channel| 1.0 + 0.25 * channel as f32);
        let map = Picture {
            file: "map.exr".to_owned(),
            channel: None,
            width: 1,
            texels: vec![texel],
        };
        let layer = Layer {
            change: Change::Map(Arc::new(map)),
            ..layer(Mode::Replace, 0.0, 1.0)
        };
        let found = painted(&[layer]).to_texel();
        assert_eq!(found.as_array(), &texel);
    }

    #[test]
    fn numbers_out_of_range_are_refused_by_name() {
        let field = |layer: Layer| layer.validate().expect_err("out of range").path;
        let key = "contents.chlorophyll_ug_per_cm2";
        assert_eq!(field(layer(Mode::Replace, -1.0, 1.0)), key);
        assert_eq!(field(layer(Mode::Multiply, f64::NAN, 1.0)), key);
        assert_eq!(field(layer(Mode::Add, 1.0, 1.1)), "share");
        assert_eq!(layer(Mode::Add, -1.0, 1.0).validate(), Ok(()));
    }
}
