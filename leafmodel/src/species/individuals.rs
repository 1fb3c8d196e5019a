//! Leaves of one plant: each differs from the plan in size, form and contents, as leaves of one
//! tree do.
//!
//! - **In**: a plan and the number of a leaf.
//! - **Out**: the plan of that leaf.
//! - **Always true**: the same plan and number give the same leaf; a length stays within the range
//!   that a flora gives for the species, where the preset's [traits](super::traits) have one.
//! - **Left out**: why leaves differ: age, light and place on the shoot.

use super::traits::Traits;
use super::{Preset, find};
use crate::blade::senescence::AgeSource;
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::leaf::venation_plan::VenationPlan;
use crate::optics::{Constituent, Contents};
use crate::random::{Use, bell, uniform};
use crate::shape::contour_curve::ContourCurve;
use crate::venation::plan::Growth;

/// Standard deviation of the length over it, where no flora gives a range.
const LENGTH_CV: f64 = 0.14;

/// Standard deviations that a flora's range is wide to either side of the preset's length.
const DEVIATIONS: f64 = 2.2;

/// Coefficients of variation, by eye.
const BREADTH_CV: f64 = 0.05;
const TOOTH_HEIGHT_CV: f64 = 0.12;
const TOOTH_COUNT_CV: f64 = 0.06;
const LOBE_CV: f64 = 0.08;
const PIGMENT_CV: f64 = 0.08;
const WATER_CV: f64 = 0.05;
const FORM_CV: f64 = 0.18;

/// Standard deviation of the secondaries' angle, degrees.
const ANGLE_DEG: f64 = 1.8;

/// Standard deviation of the day on which a leaf began to age, days.
const DAYS: f64 = 2.5;

/// What varies. The discriminants separate the numbers and must never change.
#[derive(Clone, Copy)]
enum Trait {
    Length = 0,
    Breadth = 1,
    ToothHeight = 2,
    ToothCount = 3,
    Lobes = 4,
    Angle = 5,
    Chlorophyll = 6,
    Anthocyanins = 7,
    Water = 8,
    Fold = 9,
    Curl = 10,
    Ruffle = 11,
    Day = 12,
}

impl LeafPlan {
    /// Leaf `number` of the plant of which this is one. `preset` is the plan's name, if it is a
    /// preset: a flora may then tell how long its leaves are.
    #[must_use]
    pub fn individual(&self, preset: Option<&str>, number: u64) -> Self {
        let seed = (uniform(self.seed, Use::Individual, number) * 4_294_967_296.0) as u64;
        let z = |of: Trait| bell(seed, Use::IndividualTrait, of as u64);
        let factor = |cv: f64, of: Trait| (1.0 + cv * z(of)).max(0.3);
        let mut leaf = self.clone();
        leaf.seed = seed;
        let traits = preset.and_then(find).and_then(Preset::traits);
        leaf.length_mm = length(self.length_mm, traits, z(Trait::Length));
        let ratio = leaf.length_mm / self.length_mm;
        leaf.scale_veins(ratio);
        leaf.form.max_edge_mm *= ratio;
        leaf.form.fold *= factor(FORM_CV, Trait::Fold);
        leaf.form.curl *= factor(FORM_CV, Trait::Curl);
        leaf.form.ruffle *= factor(FORM_CV, Trait::Ruffle);
        let is_grown_inside = matches!(
            leaf.outline.contour,
            Contour::Transport(_) | Contour::Development(_)
        );
        if !is_grown_inside {
            let breadth = leaf.outline.specimen.breadth * factor(BREADTH_CV, Trait::Breadth);
            let breadth = self.allowed_breadth(breadth, ratio, traits);
            let breadth = breadth.clamp(0.2, 5.0);
            let wider = breadth / leaf.outline.specimen.breadth;
            leaf.outline.specimen.breadth = breadth;
            // Veins that start side by side stay on the blade.
            if let VenationPlan::Auxin(veins) = &mut leaf.venation {
                for origin in &mut veins.origins {
                    origin[0] *= wider;
                }
            }
        }
        if let Contour::Curve(curve) = &mut leaf.outline.contour {
            deepen(curve, factor(LOBE_CV, Trait::Lobes));
        }
        leaf.vary_teeth(
            factor(TOOTH_HEIGHT_CV, Trait::ToothHeight),
            factor(TOOTH_COUNT_CV, Trait::ToothCount),
        );
        if let VenationPlan::Auxin(veins) = &mut leaf.venation
            && let Some(architecture) = &mut veins.architecture
        {
            let turn = ANGLE_DEG * z(Trait::Angle);
            for angle in &mut architecture.secondaries.angles_deg {
                *angle = (*angle + turn).clamp(10.0, 85.0);
            }
        }
        let chlorophyll = factor(PIGMENT_CV, Trait::Chlorophyll);
        let anthocyanins = factor(2.0 * PIGMENT_CV, Trait::Anthocyanins);
        let water = factor(WATER_CV, Trait::Water);
        let vary = |contents: &mut Contents| {
            for (constituent, value) in contents.iter_mut() {
                *value *= match constituent {
                    Constituent::Chlorophyll => chlorophyll,
                    // They follow chlorophyll, with a smaller slope.
                    Constituent::Carotenoids => 1.0 + 0.8 * (chlorophyll - 1.0),
                    Constituent::Anthocyanins
                    | Constituent::Betacyanins
                    | Constituent::Betaxanthins => anthocyanins,
                    Constituent::Water
                    | Constituent::DryMatter
                    | Constituent::Proteins
                    | Constituent::CarbonBased => water,
                    Constituent::Structure | Constituent::Brown | Constituent::Extra => 1.0,
                };
                let [_, most] = constituent.range();
                *value = value.min(most);
            }
        };
        vary(&mut leaf.tissue.lamina);
        let cells = leaf
            .mosaic
            .iter_mut()
            .flat_map(|mosaic| &mut mosaic.contents);
        cells.for_each(vary);
        if let Some(senescence) = &mut leaf.senescence
            && let AgeSource::Day { day, .. } = &mut senescence.source
            && *day > 0.0
        {
            *day = (*day + DAYS * z(Trait::Day)).max(0.0);
        }
        leaf
    }

    /// Keeps the distance between the finest veins, in millimetres, on a longer leaf.
    fn scale_veins(&mut self, ratio: f64) {
        let VenationPlan::Auxin(veins) = &mut self.venation else {
            return;
        };
        if let Growth::Isogonic {
            initial_length,
            length_step,
        } = &mut veins.growth
        {
            veins.final_length *= ratio;
            *initial_length *= ratio;
            *length_step *= ratio;
        }
    }

    /// A breadth with which the blade is as wide as a flora allows.
    fn allowed_breadth(&self, breadth: f64, ratio: f64, traits: Option<&Traits>) -> f64 {
        let Some(width_mm) = traits.and_then(|traits| traits.summer("width")) else {
            return breadth;
        };
        let Ok(outline) = self.outline.grow(self.length_mm, self.seed) else {
            return breadth;
        };
        let (low, high) = outline.bounds();
        let width = (high.x - low.x) * ratio / self.outline.specimen.breadth;
        let [least, most] = width_mm.range;
        // Sides that differ make it some percent wider or narrower.
        let (least, most) = (1.04 * least / width, 0.96 * most / width);
        if least < most {
            breadth.clamp(least, most)
        } else {
            breadth
        }
    }

    /// Teeth that are higher by a factor, and as many more by another.
    fn vary_teeth(&mut self, higher: f64, more: f64) {
        let mut below = None;
        for wave in &mut self.outline.teeth {
            wave.height = (wave.height * higher).min(0.5);
            let count = f64::from(wave.per_side);
            let varied = match below {
                Some((before, after)) if wave.nested => count / before * after,
                Some(_) | None => (count * more).round().clamp(1.0, 1000.0),
            };
            below = Some((count, varied));
            wave.per_side = varied as u32;
        }
    }
}

/// A length `z` standard deviations from the plan's.
fn length(usual: f64, traits: Option<&Traits>, z: f64) -> f64 {
    let range = traits.and_then(|traits| traits.summer("length"));
    let range = range.map(|length| length.range);
    // A plan of another length is no longer what the flora tells of.
    let range = range.filter(|[least, most]| (*least..=*most).contains(&usual));
    let length = match range {
        Some([least, most]) => {
            let side = if z < 0.0 { usual - least } else { most - usual };
            (usual + z * side / DEVIATIONS).clamp(least, most)
        }
        None => usual * (1.0 + LENGTH_CV * z).max(0.3),
    };
    // Files give no more digits than anybody measures.
    (length * 100.0).round() / 100.0
}

/// Makes lobes deeper by a factor: places move away from the mean of those about them. A contour
/// without lobes stays as it is.
fn deepen(curve: &mut ContourCurve, factor: f64) {
    let places: Vec<[f64; 2]> = curve.points.iter().map(|point| point.place).collect();
    let bays = places
        .windows(3)
        .filter(|three| three[1][0] < three[0][0] && three[1][0] < three[2][0]);
    if !curve.mirrored || bays.count() == 0 || places.len() < 7 {
        return;
    }
    for i in 3..places.len() - 3 {
        let about = &places[i - 2..=i + 2];
        for axis in 0..2 {
            let mean = about.iter().map(|place| place[axis]).sum::<f64>() / 5.0;
            let away = places[i][axis] - mean;
            curve.points[i].place[axis] = mean + factor * away;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::species::{PRESETS, find};

    #[test]
    fn twelve_leaves_of_a_tree_differ_and_are_as_long_as_its_flora_says() {
        for name in ["birch", "maple", "red-oak", "willow", "birch-autumn"] {
            let plan = find(name).expect("a preset").plan();
            let traits = find(name).and_then(Preset::traits);
            let range = |name| {
                let trait_of_summer = traits.and_then(|traits| traits.summer(name));
                trait_of_summer.expect("a species").range
            };
            let leaves: Vec<LeafPlan> = (1..=12).map(|i| plan.individual(Some(name), i)).collect();
            let [least, most] = range("length");
            let lengths: Vec<f64> = leaves.iter().map(|leaf| leaf.length_mm).collect();
            let mean = lengths.iter().sum::<f64>() / 12.0;
            let spread = lengths.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / 12.0;
            assert!(lengths.iter().all(|l| (least..=most).contains(l)), "{name}");
            let share = spread.sqrt() / (most - least);
            assert!((0.1..0.35).contains(&share), "{name}: {share} of the range");
            for (i, leaf) in leaves.iter().enumerate() {
                assert!(leaves[..i].iter().all(|other| other != leaf), "{name}");
                assert_eq!(leaf, &plan.individual(Some(name), i as u64 + 1));
                let outline = leaf.grow_outline().expect("a good outline");
                let (low, high) = outline.bounds();
                let [narrow, wide] = range("width");
                let width = high.x - low.x;
                assert!(
                    (narrow..=wide).contains(&width),
                    "{name} {i}: {width} mm wide"
                );
            }
        }
    }

    #[test]
    fn no_individual_holds_more_than_tissue_may() {
        let mut plan = find("birch").expect("a preset").plan();
        let [_, most] = Constituent::Chlorophyll.range();
        plan.tissue.lamina[Constituent::Chlorophyll] = most;
        for number in 1..=20 {
            let leaf = plan.individual(None, number);
            assert_eq!(leaf.tissue.validate(), Ok(()), "{number}");
        }
    }

    #[test]
    fn every_preset_has_individuals_that_can_be_grown() {
        for preset in PRESETS {
            for number in [1, 2] {
                let leaf = preset.plan().individual(Some(preset.name), number);
                leaf.check_lamina()
                    .unwrap_or_else(|error| panic!("{} {number}: {error}", preset.name));
                assert_eq!(leaf.tissue.validate(), Ok(()), "{}", preset.name);
                leaf.form.validate().expect("a good form");
                leaf.check_senescence().expect("a good old age");
            }
        }
    }
}
