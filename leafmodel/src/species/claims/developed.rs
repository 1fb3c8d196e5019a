//! What the presets that develop from their margin look like.

use glam::DVec2;

use crate::development::{DevelopedLeaf, DevelopmentPlan, MainVein};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::Contour;
use crate::leaf::venation_plan::VenationPlan;
use crate::species;
use crate::venation::plan::Growth;

const NAMES: [&str; 15] = [
    "maple-development",
    "white-oak-development",
    "red-oak-development",
    "cottonwood-development",
    "birch-development",
    "willow-development",
    "ivy-development",
    "magnolia-development",
    "linden",
    "hawthorn",
    "arabidopsis",
    "cardamine",
    "tomato",
    "horse-chestnut-development",
    "plantain",
];

fn preset(name: &str) -> LeafPlan {
    species::find(name).expect("there is one").plan()
}

fn development(plan: &LeafPlan) -> &DevelopmentPlan {
    let Contour::Development(development) = &plan.outline.contour else {
        panic!("it develops from its margin");
    };
    development
}

fn developed(name: &str) -> (DevelopedLeaf, Vec<MainVein>) {
    let plan = preset(name);
    let leaf = development(&plan).develop(plan.seed).expect("a good plan");
    let veins = leaf.veins(plan.length_mm);
    (leaf, veins)
}

fn of_wave(veins: &[MainVein], wave: usize) -> Vec<MainVein> {
    let veins = veins.iter().filter(|vein| vein.wave == Some(wave));
    veins.copied().collect()
}

#[test]
fn every_tooth_and_lobe_of_a_preset_has_its_vein_and_the_fine_net_holds_all_of_them() {
    for name in NAMES {
        let mut plan = preset(name);
        // A coarse net shows it as well.
        let VenationPlan::Auxin(auxin) = &mut plan.venation else {
            panic!("{name} has a net");
        };
        auxin.growth = Growth::Isogonic {
            initial_length: 40.0,
            length_step: 2.5,
        };
        auxin.final_length = 120.0;
        let lamina = plan.grow_lamina().expect("a good plan");
        let (outline, network) = (&lamina.outline, &lamina.network);
        assert_eq!(network.validate(), Ok(()), "{name}");
        assert_eq!(network.components(), 1, "{name}");
        let leaf = lamina.developed.as_ref().expect("it has developed");
        let veins = leaf.veins(plan.length_mm);
        assert!(veins.len() >= 5, "{name}");
        assert!(network.nodes().len() > 4 * veins.len(), "{name}");
        for vein in &veins {
            let tip = DVec2::from_array(vein.tip);
            let near = 1e-9 * plan.length_mm;
            assert!(outline.distance_to_margin(tip) < near, "{name}: {vein:?}");
            let mut nodes = network.nodes().iter();
            assert!(
                nodes.any(|node| (node.position - tip).length() < near),
                "{name}: no node at {tip}"
            );
        }
        for node in network.nodes() {
            assert!(outline.covers(node.position), "{name}: {node:?}");
        }
    }
}

#[test]
fn palmate_presets_have_primaries_from_the_base_and_pinnate_ones_do_not() {
    for (name, primaries) in [
        ("maple-development", 4..=8),
        ("ivy-development", 4..=4),
        ("horse-chestnut-development", 4..=8),
        ("plantain", 4..=10),
        ("white-oak-development", 0..=0),
        ("magnolia-development", 0..=0),
        ("cardamine", 0..=0),
    ] {
        let lobes = of_wave(&developed(name).1, 0);
        let from_base = lobes.iter().filter(|vein| vein.order == 1).count();
        assert!(primaries.contains(&from_base), "{name}: {from_base}");
        assert!(lobes.len() >= 4, "{name}: {}", lobes.len());
    }
}

#[test]
fn presets_range_from_entire_to_compound() {
    // Area of the blade over that of the same development with nothing held back.
    let fullness = |name: &str| {
        let plan = preset(name);
        let mut entire = development(&plan).clone();
        for wave in &mut entire.waves {
            wave.hold = 0.0;
        }
        let whole = entire.develop(plan.seed).expect("a good plan");
        let area = |leaf: &DevelopedLeaf| leaf.outline(1.0).expect("a good margin").area();
        area(&developed(name).0) / area(&whole)
    };
    assert!(fullness("magnolia-development") > 0.999);
    assert!((0.9..0.99).contains(&fullness("birch-development")));
    assert!((0.55..0.85).contains(&fullness("white-oak-development")));
    assert!(fullness("cardamine") < 0.6);
    assert!(fullness("cardamine") < fullness("white-oak-development"));
}

#[test]
fn stages_show_the_main_veins_first_and_then_the_fine_net() {
    let mut plan = preset("arabidopsis");
    let VenationPlan::Auxin(auxin) = &mut plan.venation else {
        panic!("it has a net");
    };
    auxin.growth = Growth::Isogonic {
        initial_length: 30.0,
        length_step: 2.5,
    };
    auxin.final_length = 90.0;
    let lamina = plan.grow_lamina().expect("a good plan");
    let last = plan.last_step(&lamina).expect("it has stages");
    let mut steps: Vec<u32> = (0..8).map(|i| last * i / 8).collect();
    // Beyond the last it is full-grown.
    steps.push(last + 1);
    let stages = plan.stages(&lamina, &steps).expect("it has stages");
    for pair in stages.windows(2) {
        assert!(pair[0].outline.area() <= pair[1].outline.area());
        assert!(pair[0].network.nodes().len() <= pair[1].network.nodes().len());
    }
    assert!(stages[0].outline.length() < 0.1 * plan.length_mm);
    assert_eq!(stages[8].outline, lamina.outline);
    assert_eq!(stages[8].network, lamina.network);
}
