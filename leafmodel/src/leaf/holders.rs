//! Which part of a plan contributes which contents.

use super::plan::LeafPlan;
use crate::blade::layers::{Change, Layer, Mode};
use crate::blade::masks::Mask;
use crate::blade::senescence::AgeSource;
use crate::optics::{Constituent, PerConstituent};

const ANTHOCYANINS: Constituent = Constituent::Anthocyanins;
const BETALAINS: [Constituent; 2] = [Constituent::Betacyanins, Constituent::Betaxanthins];

/// A part of a plan, by its keys, and the greatest contents that it brings anywhere.
type Holder = (String, PerConstituent<f64>);

impl LeafPlan {
    /// The keys of two parts of the plan of which the first brings anthocyanins and the second
    /// betalains, which no plant holds together, wherever on the leaf they lie; the same twice if
    /// one part brings both.
    ///
    /// A layer that replaces a pigment everywhere cancels that pigment in the parts below it.
    pub fn anthocyanins_beside_betalains(&self) -> Option<[String; 2]> {
        let holders = self.holders();
        let first = |wanted: &[Constituent]| {
            let brings = |(_, contents): &&Holder| wanted.iter().any(|&i| contents[i] > 0.0);
            holders.iter().find(brings).map(|(key, _)| key.clone())
        };
        Some([first(&[ANTHOCYANINS])?, first(&BETALAINS)?])
    }

    fn holders(&self) -> Vec<Holder> {
        let lamina = self.tissue.lamina.0;
        let mut holders: Vec<Holder> = match &self.mosaic {
            None => vec![("contents".to_owned(), lamina)],
            Some(mosaic) => {
                let types = mosaic.plan.types.iter().zip(&mosaic.contents);
                let types =
                    types.map(|(kind, held)| (format!("mosaic.types.{}", kind.name), held.0));
                let bare = mosaic
                    .may_leave_bare()
                    .then(|| ("contents".to_owned(), lamina));
                types.chain(bare).collect()
            }
        };
        for layer in &self.layers {
            lay(&mut holders, layer);
        }
        // Stalks are of the tissue alone.
        if self.mosaic.is_some() && (self.petiole.is_some() || self.compound.is_some()) {
            holders.push(("contents".to_owned(), lamina));
        }
        if let Some(senescence) = &self.senescence {
            let mut dead = senescence.contents.0;
            let made = match &senescence.source {
                AgeSource::Day { day, course } if *day > 0.0 => course.anthocyanins,
                AgeSource::Day { .. } | AgeSource::Revenue { .. } => 0.0,
            };
            dead[ANTHOCYANINS] = dead[ANTHOCYANINS].max(made);
            holders.push(("senescence".to_owned(), dead));
        }
        holders
    }
}

/// Puts a layer on what is below it.
fn lay(holders: &mut Vec<Holder>, layer: &Layer) {
    if layer.share <= 0.0 {
        return;
    }
    let covers = layer.mask == Mask::Everywhere && layer.share == 1.0;
    let mut brought = PerConstituent::splat(0.0_f64);
    match &layer.change {
        Change::Map(map) => {
            for texel in &map.texels {
                for ((_, most), value) in brought.iter_mut().zip(texel) {
                    *most = most.max(f64::from(*value));
                }
            }
            if covers {
                holders.clear();
            }
        }
        Change::Values { mode, values } => {
            for (constituent, value) in *values {
                let Some(value) = value else { continue };
                let clears = match mode {
                    Mode::Replace => true,
                    Mode::Multiply => value == 0.0,
                    Mode::Add => false,
                };
                if covers && clears {
                    for (_, contents) in holders.iter_mut() {
                        contents[constituent] = 0.0;
                    }
                }
                // Factors bring nothing that is not there.
                if *mode != Mode::Multiply {
                    brought[constituent] = value.max(0.0);
                }
            }
        }
    }
    holders.push((format!("layers.{}", layer.name), brought));
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DVec3;

    use super::*;
    use crate::blade::ageing_courses::{COURSES, LITTER, YELLOW};
    use crate::blade::masks::Picture;
    use crate::blade::senescence::Senescence;
    use crate::mosaic::control::{ControlImage, CylinderControl, Steered};
    use crate::mosaic::pattern::{LeafFaces, MosaicPattern};
    use crate::mosaic::plan::{CellType, MosaicPlan};
    use crate::optics::Texel;
    use crate::species::find;

    /// A beet's leaf: betacyanins, no anthocyanins.
    fn beet() -> LeafPlan {
        let mut plan = find("poplar").expect("a preset").plan();
        plan.tissue.lamina[Constituent::Anthocyanins] = 0.0;
        plan.tissue.lamina[Constituent::Betacyanins] = 8.0;
        plan
    }

    fn layer(mask: Mask, mode: Mode, constituent: Constituent, value: f64) -> Layer {
        let values = PerConstituent::splat(None).with(&[(constituent, Some(value))]);
        Layer {
            name: "spots".to_owned(),
            mask,
            share: 1.0,
            change: Change::Values { mode, values },
        }
    }

    fn midrib() -> Mask {
        Mask::Midrib {
            width_mm: 1.0,
            softness_mm: 0.5,
        }
    }

    fn keys(first: &str, second: &str) -> [String; 2] {
        [first, second].map(str::to_owned)
    }

    #[test]
    fn one_class_alone_is_as_in_plants() {
        assert_eq!(beet().anthocyanins_beside_betalains(), None);
        let red = find("poplar").expect("a preset").plan();
        assert!(red.tissue.lamina[Constituent::Anthocyanins] > 0.0);
        assert_eq!(red.anthocyanins_beside_betalains(), None);
    }

    #[test]
    fn layers_bring_pigments_wherever_they_lie_and_take_them_only_where_they_lie() {
        let with =
            |layers: Vec<Layer>| LeafPlan { layers, ..beet() }.anthocyanins_beside_betalains();
        let red = || layer(midrib(), Mode::Add, ANTHOCYANINS, 2.0);
        assert_eq!(with(vec![red()]), Some(keys("layers.spots", "contents")));
        let washed = |mask| vec![layer(mask, Mode::Replace, BETALAINS[0], 0.0), red()];
        assert_eq!(with(washed(Mask::Everywhere)), None);
        assert_eq!(
            with(washed(midrib())),
            Some(keys("layers.spots", "contents"))
        );
        let faded = vec![
            layer(Mask::Everywhere, Mode::Multiply, BETALAINS[0], 0.0),
            red(),
        ];
        assert_eq!(with(faded), None);
        assert_eq!(
            with(vec![layer(midrib(), Mode::Multiply, ANTHOCYANINS, 9.0)]),
            None
        );
        let nowhere = Layer {
            share: 0.0,
            ..red()
        };
        assert_eq!(with(vec![nowhere]), None);
    }

    #[test]
    fn maps_bring_what_any_of_their_texels_holds() {
        let green = [
            (Constituent::Structure, 1.5),
            (Constituent::Chlorophyll, 30.0),
        ];
        let green = Texel::splat(0.0).with(&green);
        let red = green.with(&[(Constituent::Anthocyanins, 2.0)]);
        let change = Change::Map(Arc::new(Picture {
            file: "map.exr".to_owned(),
            channel: None,
            width: 2,
            texels: [green, red, green, green]
                .map(|texel| *texel.as_array())
                .to_vec(),
        }));
        let map = Layer {
            change,
            ..layer(midrib(), Mode::Add, Constituent::Structure, 0.0)
        };
        let over = |mask| {
            let layers = vec![Layer {
                mask,
                ..map.clone()
            }];
            LeafPlan { layers, ..beet() }.anthocyanins_beside_betalains()
        };
        assert_eq!(over(midrib()), Some(keys("layers.spots", "contents")));
        // It takes the place of everything.
        assert_eq!(over(Mask::Everywhere), None);
    }

    #[test]
    fn types_of_a_mosaic_are_parts_of_one_plant() {
        let kind = |name: &str| CellType {
            name: name.to_owned(),
            division_days: f64::INFINITY,
            initial_probability: 0.5,
            switching: vec![1.0, 0.0],
            adhesion: vec![0.0, 0.0],
        };
        let beet = beet();
        let red = beet.tissue.lamina.with(&[
            (Constituent::Betacyanins, 0.0),
            (Constituent::Anthocyanins, 5.0),
        ]);
        let mosaic = MosaicPattern {
            plan: MosaicPlan {
                types: vec![kind("green"), kind("red")],
                ..MosaicPlan::default()
            },
            contents: vec![beet.tissue.lamina, red],
            blend_mm: 0.2,
            faces: LeafFaces::Through,
        };
        let plan = LeafPlan {
            mosaic: Some(mosaic),
            ..beet
        };
        let both = Some(keys("mosaic.types.red", "mosaic.types.green"));
        assert_eq!(plan.anthocyanins_beside_betalains(), both);
    }

    #[test]
    fn beside_a_mosaic_the_leaf_itself_counts_where_no_cell_may_be() {
        let red = CellType {
            name: "red".to_owned(),
            division_days: f64::INFINITY,
            initial_probability: 1.0,
            switching: vec![1.0],
            adhesion: vec![0.0],
        };
        let held = beet().tissue.lamina.with(&[
            (Constituent::Betacyanins, 0.0),
            (Constituent::Anthocyanins, 5.0),
        ]);
        let steered = |steers: Option<Steered>| {
            let control = |steers| CylinderControl {
                from: DVec3::ZERO,
                to: DVec3::Z,
                radius_mm: None,
                image: ControlImage::Constant(1.0),
                steers,
            };
            let mosaic = MosaicPattern {
                plan: MosaicPlan {
                    types: vec![red.clone()],
                    controls: steers.map(control).into_iter().collect(),
                    ..MosaicPlan::default()
                },
                contents: vec![held],
                blend_mm: 0.2,
                faces: LeafFaces::Through,
            };
            let plan = LeafPlan {
                mosaic: Some(mosaic),
                petiole: None,
                compound: None,
                ..beet()
            };
            plan.anthocyanins_beside_betalains()
        };
        assert_eq!(steered(None), None);
        assert_eq!(steered(Some(Steered::InitialType(0))), None);
        let both = Some(keys("mosaic.types.red", "contents"));
        assert_eq!(steered(Some(Steered::Blocked)), both);
    }

    #[test]
    fn courses_that_redden_leaves_bring_anthocyanins_once_they_have_begun() {
        let aged = |day, course| {
            let senescence = Senescence {
                source: AgeSource::Day { day, course },
                blend: 3.0,
                contents: LITTER,
            };
            LeafPlan {
                senescence: Some(senescence),
                ..beet()
            }
            .anthocyanins_beside_betalains()
        };
        let red = COURSES.iter().find(|(_, course)| course.anthocyanins > 0.0);
        let red = red.expect("some leaves redden").1;
        assert_eq!(aged(20.0, red), Some(keys("senescence", "contents")));
        assert_eq!(aged(0.0, red), None);
        assert_eq!(aged(20.0, YELLOW), None);
    }
}
