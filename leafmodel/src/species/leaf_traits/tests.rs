//! The traits of species, tested against their plans and grown outlines.

use super::*;
use crate::measure::shape;
use crate::optics::Constituent::{
    Anthocyanins, Brown, Carotenoids, Chlorophyll, DryMatter, Structure, Water,
};
use crate::species::{PRESETS, find};

/// The species that must have a preset.
const ASKED_FOR: [&str; 18] = [
    "poplar",
    "cottonwood",
    "aspen",
    "maple",
    "white-oak",
    "red-oak",
    "ginkgo",
    "birch",
    "willow",
    "cherry",
    "sweetgum",
    "alchemilla",
    "ivy",
    "magnolia",
    "grass",
    "orchid",
    "trillium",
    "croton",
];

fn published(from: Provenance) -> Option<Source> {
    match from {
        Provenance::Measured(source)
        | Provenance::Flora(source)
        | Provenance::Fitted(source)
        | Provenance::Relative(source)
        | Provenance::Estimate(source) => Some(source),
        Provenance::ByEye(_) => None,
    }
}

#[test]
fn each_species_has_its_traits_and_each_number_lies_within_the_range_of_its_source() {
    assert_eq!(all().map(|t| t.preset).collect::<Vec<_>>(), ASKED_FOR);
    for traits in all() {
        for (name, _, quantity) in traits.quantities() {
            let [low, high] = quantity.range;
            let at = format!("{} of {}: {quantity:?}", name, traits.preset);
            assert!(low < high, "{at}");
            assert!((low..=high).contains(&quantity.value), "{at}");
            assert!(!quantity.from.words().is_empty(), "{at}");
        }
    }
}

#[test]
fn a_preset_is_grown_from_the_traits_that_are_told() {
    for traits in all() {
        let plan = find(traits.preset).expect("a preset").plan();
        let held = plan.tissue.lamina;
        let grown = [
            plan.length_mm,
            plan.form.thickness_mm,
            held[Structure],
            held[Chlorophyll],
            held[Carotenoids],
            held[Anthocyanins],
            held[Water],
            held[DryMatter],
        ];
        let told = traits.quantities().map(|(_, _, quantity)| quantity.value);
        assert_eq!(grown, told, "{}", traits.preset);
        // There is no other constituent.
        assert_eq!(held[Brown], 0.0);
    }
}

#[test]
fn grown_outlines_are_as_wide_as_floras_say_and_widest_where_they_say() {
    for traits in all() {
        let plan = find(traits.preset).expect("a preset").plan();
        let outline = plan.outline.grow(plan.length_mm, plan.seed);
        let measures = shape(&outline.expect("a good outline"));
        for (key, span) in [
            ("width_mm", traits.width_mm),
            ("widest_at", traits.widest_at),
        ] {
            let value = measures.number(key).expect("a shape has it");
            let [low, high] = span.range;
            let words = span.from.words();
            assert!(
                (low..=high).contains(&value),
                "{}: {key} is {value}, not {low} to {high} ({words})",
                traits.preset
            );
        }
    }
}

#[test]
fn every_source_is_in_the_bibliography() {
    let bibliography = include_str!("../../../fixtures/references.bib");
    for traits in all() {
        let quantities = traits.quantities().map(|(_, _, q)| q.from);
        let spans = traits.spans().map(|(_, _, span)| span.from);
        for source in quantities.into_iter().chain(spans).filter_map(published) {
            let entry = format!("{{{},", source.key);
            assert!(bibliography.contains(&entry), "{} is missing", source.key);
        }
    }
}

#[test]
fn water_and_dry_matter_fit_into_the_leaf_with_air_between() {
    // Cell walls have about 1.5 g/cm³; air fills a tenth to seven tenths of a leaf.
    for traits in all() {
        let solid_mm = 10.0 * (traits.water.value + traits.dry_matter.value / 1.5);
        let share = solid_mm / traits.thickness_mm.value;
        assert!(
            (0.3..=0.9).contains(&share),
            "{}: {share} of the leaf is filled",
            traits.preset
        );
    }
}

#[test]
fn evergreens_are_darker_and_thicker_than_birch_and_the_petal_is_nearly_white() {
    let of = |preset| traits(preset).expect("a species");
    let birch = of("birch");
    for evergreen in ["ivy", "magnolia"].map(of) {
        assert!(evergreen.chlorophyll.value > 1.5 * birch.chlorophyll.value);
        assert!(evergreen.thickness_mm.value > 1.5 * birch.thickness_mm.value);
        assert!(evergreen.dry_matter.value > birch.dry_matter.value);
    }
    let petal = of("trillium");
    assert!(petal.chlorophyll.value < 0.01 * birch.chlorophyll.value);
}

#[test]
fn other_presets_have_no_traits() {
    let with = PRESETS.iter().filter(|p| traits(p.name).is_some());
    // Seven more are plants whose own names are rows of a paper.
    assert_eq!(with.count(), ASKED_FOR.len() + 7);
}
