//! The traits of species, tested against their plans and grown outlines.

use crate::document::declared::Declared as _;
use crate::measure::shape;
use crate::optics::Constituent::{Brown, Carotenoids, Chlorophyll};
use crate::species::traits::{Quantity, Traits};
use crate::species::{PRESETS, Preset, find};

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

fn traits(name: &str) -> &'static Traits {
    let found = find(name).and_then(Preset::traits);
    found.unwrap_or_else(|| panic!("{name} is no species"))
}

fn value(traits: &Traits, name: &str) -> f64 {
    let quantity = traits.summer(name).expect("every species has it");
    quantity.value.expect("the leaf has it")
}

fn with_traits() -> impl Iterator<Item = (&'static Preset, &'static Traits)> {
    let traits = |preset: &'static Preset| Some((preset, preset.traits()?));
    PRESETS.iter().filter_map(traits)
}

fn green() -> impl Iterator<Item = (&'static Preset, &'static Traits)> {
    with_traits().filter(|(_, traits)| !traits.is_coloured())
}

#[test]
fn each_species_has_its_traits_and_each_number_lies_within_the_range_of_its_source() {
    for name in ASKED_FOR {
        assert!(!traits(name).is_coloured(), "{name}");
    }
    // Seven more are plants whose own names are rows of a paper.
    assert_eq!(green().count(), ASKED_FOR.len() + 7);
    for (preset, traits) in with_traits() {
        assert!(!traits.species.is_empty(), "{}", preset.name);
        let names: Vec<&str> = traits.summer.iter().map(|q| q.name.as_str()).collect();
        let all = "length thickness structure chlorophyll carotenoids anthocyanins water";
        let mut all: Vec<&str> = all.split(' ').collect();
        all.extend(["dry matter", "width", "widest at"]);
        assert_eq!(names, all, "{}", preset.name);
        for quantity in traits.summer.iter().chain(&traits.differs) {
            let Quantity {
                name, range, from, ..
            } = quantity;
            let [low, high] = *range;
            let at = format!("{name} of {}: {quantity:?}", preset.name);
            let is_measured = ["width", "widest at"].contains(&name.as_str());
            assert!(low < high, "{at}");
            assert_eq!(quantity.value.is_none(), is_measured, "{at}");
            assert!(
                quantity.value.is_none_or(|v| (low..=high).contains(&v)),
                "{at}"
            );
            assert!(!from.says.is_empty(), "{at}");
        }
    }
}

#[test]
fn outlines_are_as_wide_as_floras_say_and_widest_where_they_say() {
    for (preset, traits) in with_traits() {
        let plan = preset.plan();
        // A whole blade of reed is longer than the piece that its traits are of.
        if preset.name == "grass-blade" {
            continue;
        }
        let outline = plan.outline.grow(plan.length_mm, plan.seed);
        let measures = shape(&outline.expect("a good outline"));
        for (key, name) in [("width_mm", "width"), ("widest_at", "widest at")] {
            let value = measures.number(key).expect("a shape has it");
            let span = traits.summer(name).expect("every species has it");
            let [low, high] = span.range;
            assert!(
                (low..=high).contains(&value),
                "{}: {key} is {value}, not {low} to {high} ({})",
                preset.name,
                span.from.words()
            );
        }
    }
}

#[test]
fn every_source_is_in_the_bibliography() {
    let bibliography = include_str!("../../../fixtures/references.bib");
    for preset in PRESETS {
        let traits = preset.traits().into_iter();
        let quantities = traits.flat_map(|traits| traits.summer.iter().chain(&traits.differs));
        for quantity in quantities.chain(preset.counts()) {
            let Some(key) = &quantity.from.key else {
                assert_eq!(quantity.from.word(), "by eye");
                continue;
            };
            let entry = format!("{{{key},");
            assert!(bibliography.contains(&entry), "{key} is missing");
        }
    }
}

#[test]
fn carotenoids_of_green_leaves_follow_from_their_chlorophyll() {
    for (preset, traits) in with_traits() {
        let carotenoids = traits.summer("carotenoids").expect("every species has it");
        if carotenoids.from.word() == "fitted" {
            let fit = 1.13 + 0.222 * value(traits, "chlorophyll");
            let held = value(traits, "carotenoids");
            assert!(
                (held - fit).abs() < 1e-9,
                "{}: {held}, not {fit}",
                preset.name
            );
        }
    }
}

#[test]
fn a_green_leaf_holds_no_brown() {
    for (preset, traits) in green() {
        let held = preset.plan().tissue.lamina;
        assert_eq!(held[Chlorophyll], value(traits, "chlorophyll"));
        assert_eq!(held[Carotenoids], value(traits, "carotenoids"));
        assert_eq!(held[Brown], 0.0, "{}", preset.name);
    }
}

#[test]
fn water_and_dry_matter_fit_into_the_leaf_with_air_between() {
    // Cell walls have about 1.5 g/cm³; air fills a tenth to seven tenths of a leaf.
    for (preset, traits) in green() {
        let solid_mm = 10.0 * (value(traits, "water") + value(traits, "dry matter") / 1.5);
        let filled = solid_mm / value(traits, "thickness");
        assert!(
            (0.3..=0.9).contains(&filled),
            "{}: {filled} of the leaf is filled",
            preset.name
        );
    }
}

#[test]
fn evergreens_are_darker_and_thicker_than_birch_and_the_petal_is_nearly_white() {
    let birch = traits("birch");
    for evergreen in ["ivy", "magnolia"].map(traits) {
        for (name, times) in [
            ("chlorophyll", 1.5),
            ("thickness", 1.5),
            ("dry matter", 1.0),
        ] {
            assert!(
                value(evergreen, name) > times * value(birch, name),
                "{name}"
            );
        }
    }
    let petal = value(traits("trillium"), "chlorophyll");
    assert!(petal < 0.01 * value(birch, "chlorophyll"));
}

#[test]
fn every_species_has_a_surface_and_broad_leaves_are_uneven_by_a_few_hundredths() {
    let mut uneven = 0;
    for (preset, _) in green() {
        let plan = preset.plan();
        let surface = plan.surface.expect("it has a surface");
        assert_eq!(surface.validate(), Ok(()), "{}", preset.name);
        assert!(
            surface.stomata.are_there() || preset.name == "aspen",
            "{}",
            preset.name
        );
        for hairs in &plan.hairs {
            assert_eq!(hairs.in_range(), Ok(()), "{}", preset.name);
        }
        if let Some(unevenness) = plan.unevenness {
            uneven += 1;
            assert_eq!(unevenness.in_range(), Ok(()), "{}", preset.name);
            for fraction in [unevenness.fields, unevenness.patches] {
                assert!(
                    (0.03..=0.08).contains(&fraction),
                    "{}: {fraction}",
                    preset.name
                );
            }
        }
    }
    assert!(uneven >= 13, "{uneven}");
}

#[test]
fn croton_and_magnolia_are_glabrous_and_willow_is_silkier_below() {
    let hairs = |name: &str| find(name).expect("a preset").plan().hairs;
    assert!(hairs("croton").is_empty() && hairs("magnolia").is_empty());
    let silk = &hairs("willow")[0];
    assert!(silk.abaxial_per_mm2 > silk.adaxial_per_mm2 && silk.adaxial_per_mm2 > 0.0);
    assert!(
        hairs("alchemilla")
            .iter()
            .any(|kind| kind.fringe_per_mm > 0.0)
    );
}
