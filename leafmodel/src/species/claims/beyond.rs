//! Tests of the presets that go beyond the paper.

use super::*;
use crate::venation::network::VeinEdge;
use crate::venation::plan::MarginClearance;

#[test]
fn secondaries_join_in_arches_before_the_leaf_grows() {
    let leaf = Grown::preset("brochidodromous");
    let rule = leaf
        .auxin()
        .margin_clearance
        .expect("it is what the preset shows");
    // The first stage at which all loops are there that form before darts are thrown.
    let steps: Vec<u32> = (0..200).collect();
    let stages = leaf.stages(&steps);
    let size = |stage: &Stage| stage.outline.length();
    let young: Vec<&Stage> = stages
        .iter()
        .filter(|s| size(s) == size(&stages[0]))
        .collect();
    let laid_out = young[young.len() - 2];
    // At each end of the leaf one or two arches have no room.
    let loops = laid_out.network.loops();
    let most = 2 * (rule.arches as usize - 1);
    assert!(
        (most - 6..=most).contains(&loops),
        "{loops} arches of at most {most}"
    );
    // All of the network keeps clear of the margin.
    for node in laid_out.network.nodes().iter().skip(1) {
        let away = laid_out.outline.distance_to_margin(node.position) / laid_out.outline.length();
        let from_base = node.position.length() / laid_out.outline.length();
        assert!(away > 0.5 * rule.distance || from_base < 0.2, "{away}");
    }
    // Where the arches are: the nodes of the last round of sources.
    let open = young.iter().rev().find(|stage| stage.network.loops() == 0);
    let before = open
        .expect("secondaries end freely at first")
        .network
        .nodes()
        .len();
    let arches = before..laid_out.network.nodes().len();
    // In the grown leaf they are wider than the net about them, though not as wide as the
    // secondaries.
    let mean = |wanted: &dyn Fn(&VeinEdge) -> bool| {
        let edges = leaf.network.edges().iter().filter(|edge| wanted(edge));
        let radii: Vec<f64> = edges.map(|edge| edge.radius_to).collect();
        radii.iter().sum::<f64>() / radii.len() as f64
    };
    let arch = mean(&|edge| arches.contains(&(edge.to as usize)));
    let (secondary, net) = (mean(&|edge| edge.order == 2), mean(&|edge| edge.order > 2));
    assert!(arch > 1.3 * net, "{arch} in arches, {net} in the net");
    assert!(
        arch > 0.45 * secondary,
        "{arch} in arches, {secondary} in secondaries"
    );
    // Without the arches, a leaf of the same size has fewer loops.
    let chance = leaf.with_veins(AuxinPlan {
        margin_clearance: Some(MarginClearance { arches: 0, ..rule }),
        ..leaf.auxin().clone()
    });
    let as_large = chance.stages(&steps);
    let as_large = as_large.iter().rfind(|s| size(s) <= 1.1 * size(laid_out));
    assert!(as_large.is_some_and(|stage| 2 * stage.network.loops() < loops));
}

#[test]
fn veinlets_end_freely_inside_areoles() {
    let with = Grown::preset("free-endings");
    let without = with.with_veins(AuxinPlan {
        free_endings: None,
        ..with.auxin().clone()
    });
    // The last round adds to the net and leaves the rest unchanged.
    let old = without.network.nodes();
    assert_eq!(&with.network.nodes()[..old.len()], old);
    assert_eq!(with.network.loops(), without.network.loops());
    let per_areole = |leaf: &Grown| leaf.number("freely_ending_veinlets_per_areole");
    assert!(
        (0.5..4.0).contains(&per_areole(&with)),
        "{}",
        per_areole(&with)
    );
    assert!(
        per_areole(&with) > 3.0 * per_areole(&without),
        "{}",
        per_areole(&without)
    );
}

#[test]
fn a_cupped_leaf_has_the_same_veins_everywhere_on_the_blade_but_not_in_its_map() {
    let leaf = Grown::preset("cupped");
    let map = leaf.network.map();
    let segment = leaf.network.segment_mm();
    // Segments on the sphere, between nodes that no growth has stretched: those of the last steps.
    let last = leaf.network.steps() - 12;
    let nodes = leaf.network.nodes();
    let mut lengths = Vec::new();
    for edge in leaf.network.edges() {
        let (a, b) = (nodes[edge.from as usize], nodes[edge.to as usize]);
        if a.born >= last && b.born > a.born {
            let on_blade = map.in_space(a.position, 0.0) - map.in_space(b.position, 0.0);
            lengths.push((
                on_blade.length() / segment,
                (a.position - b.position).length() / segment,
            ));
        }
    }
    assert!(lengths.len() > 10, "{}", lengths.len());
    for (on_blade, in_map) in lengths {
        // Junctions lie nearer together than a segment.
        assert!(
            on_blade < 1.6,
            "{on_blade} segments on the blade, {in_map} in the map"
        );
    }
    // Density of veins in the middle and towards the margin.
    let centre = leaf.outline.apex() * 0.5;
    let density = |inner: f64, outer: f64, on_blade: bool| {
        let inside = |p: DVec2| (inner..outer).contains(&((p - centre).length() / leaf.length()));
        let factor = |p: DVec2| {
            if on_blade {
                1.0 / map.enlargement(p)
            } else {
                1.0
            }
        };
        let length: f64 = leaf
            .network
            .segments()
            .filter(|s| inside(s.from))
            .map(|s| (s.to - s.from).length() * factor(s.from))
            .sum();
        // Area by a fine grid.
        let step = leaf.length() / 300.0;
        let mut area = 0.0;
        for i in -220..220 {
            for j in -20..340 {
                let p = DVec2::new(f64::from(i), f64::from(j)) * step;
                if inside(p) && leaf.outline.contains(p) {
                    area += (step * factor(p)).powi(2);
                }
            }
        }
        length / area
    };
    let ratio = |on_blade| density(0.36, 0.46, on_blade) / density(0.0, 0.25, on_blade);
    let (blade, map) = (ratio(true), ratio(false));
    assert!(
        (blade - 1.0).abs() < (map - 1.0).abs(),
        "{blade} on the blade, {map} in the map"
    );
    assert!((0.85..1.2).contains(&blade), "{blade}");
}
