//! Filled blades are valid transport systems inside their outline.

use proptest::prelude::*;

use super::*;
use crate::blade::BladeForm;
use crate::blade::mesh::BladeMesh;
use crate::species;
use crate::transport::cells::NONE;
use properties::fixed;

/// Outlines that other models grew, that were drawn by hand, and that have sinuses narrower than a
/// cell.
const NAMES: [&str; 13] = [
    "young-3a", "young-4a", "young-5d", "young-6b", "young-8d", "young-9d", "maple", "red-oak",
    "ivy", "willow", "ginkgo", "sweetgum", "xia-3",
];

fn outline_of(name: &str) -> Outline {
    let plan = species::find(name).expect("there is one").plan();
    plan.grow_outline().expect("a good outline")
}

/// A star whose lowest notch is the base.
fn star(rays: u32, notch: f64, turn: f64) -> Outline {
    let point = |i: u32| {
        let angle = std::f64::consts::PI * (f64::from(i) / f64::from(rays) - 0.5);
        let radius = if i.is_multiple_of(2) { notch } else { 30.0 };
        // Uneven rays make the two sides differ.
        let radius = radius * (1.0 + turn * libm::sin(angle + 0.7));
        DVec2::new(radius * libm::cos(angle), radius * libm::sin(angle))
    };
    let margin: Vec<DVec2> = (0..2 * rays).map(point).collect();
    let base = margin[0];
    let margin = margin.into_iter().map(|p| p - base).collect();
    Outline::new(margin, DVec2::ZERO, DVec2::new(0.0, notch - base.y)).expect("a star")
}

fn plan(cells_along: u32) -> FilledPlan {
    FilledPlan {
        cells_along,
        ..FilledPlan::default()
    }
}

/// Checks a filled blade against the definitions.
fn check_blade(plan: &FilledPlan, outline: &Outline) -> FilledBlade {
    let blade = plan.fill(outline).expect("a good plan");
    let leaf = blade.leaf();
    let (frame, all) = plan.grid(outline).expect("a good grid");
    let is_crossed = |a, b| outline.is_crossed_by(frame.to_mm(a), frame.to_mm(b));
    let walls = Walls::around(&all, is_crossed);

    // Every cell whose centre lies on the blade and that is connected to the root is supplied once
    // or listed as unsupplied.
    let mut known: Vec<Cell> = leaf
        .cells()
        .iter()
        .chain(&blade.unsupplied)
        .copied()
        .collect();
    let mut expected = walls.connected(Cell::ROOT);
    known.sort_unstable();
    expected.sort_unstable();
    assert_eq!(known, expected);
    for &cell in &blade.unsupplied {
        let system = leaf.system();
        let multiples = system.multiples();
        for (u, &near) in leaf.cells().iter().enumerate() {
            let step = match leaf.parent(u) {
                Some(p) => near - leaf.cells()[p],
                None => Cell::UP,
            };
            let turns_back = (cell - near).dot(step) <= 0;
            let keeps_sides = !leaf.is_mirrored() || cell.m != 0 || near.m == 0;
            assert!(
                !walls.allow(near, cell) || turns_back || !keeps_sides || !multiples[u].is_finite()
            );
        }
    }

    // The tree balances, its edges stay on the blade, and its cost equals that of the definition.
    let parents: Vec<u32> = (0..leaf.cells().len())
        .map(|v| leaf.parent(v).map_or(NONE, |p| p as u32))
        .collect();
    assert_eq!(leaf.system().counts(), leaf.counts());
    assert_eq!(leaf.counts()[0] as usize, leaf.cells().len());
    for (v, &p) in parents.iter().enumerate().skip(1) {
        let (from, to) = (leaf.cells()[p as usize], leaf.cells()[v]);
        assert!(walls.allow(from, to), "{from:?} {to:?}");
    }
    let cost = leaf.system().cost();
    assert!((leaf.cost() / cost - 1.0).abs() < 1e-10);
    if leaf.is_mirrored() {
        for (v, cell) in leaf.cells().iter().enumerate() {
            let image = leaf.cells().iter().position(|c| *c == cell.mirrored());
            let image = image.expect("its image is there");
            let parent = |v: usize| leaf.parent(v).map(|p| leaf.cells()[p]);
            assert_eq!(parent(v), parent(image).map(Cell::mirrored));
        }
    }

    let network = blade.network(outline, plan.style).expect("a good style");
    assert_eq!(network.validate(), Ok(()));
    assert_eq!(
        (network.components(), network.loops(), network.origins()),
        (1, 0, 1)
    );
    assert_eq!(network.nodes()[0].position, outline.base());
    for node in &network.nodes()[1..] {
        assert!(outline.contains(node.position));
    }
    blade
}

/// Only cells beside and behind the root may be out of reach.
fn assert_few_are_left(blade: &FilledBlade, name: &str) {
    let left = &blade.unsupplied;
    let beside = |cell: &Cell| cell.m.abs() <= 2 && cell.n.abs() <= 1;
    assert!(
        left.len() <= 8 && left.iter().all(beside),
        "{name}: {left:?}"
    );
}

#[test]
fn every_cell_of_the_28_forms_is_supplied_on_both_sides_alike() {
    let forms = species::PRESETS.iter();
    for form in forms.filter(|preset| preset.name.starts_with("young-")) {
        let outline = outline_of(form.name);
        let blade = check_blade(&plan(26), &outline);
        assert_few_are_left(&blade, form.name);
        assert!(blade.leaf().is_mirrored(), "{}", form.name);
    }
}

#[test]
fn blades_of_all_kinds_are_supplied_and_can_be_meshed() {
    for name in NAMES {
        let outline = outline_of(name);
        let blade = check_blade(&plan(40), &outline);
        assert_few_are_left(&blade, name);
        let network = blade
            .network(&outline, plan(40).style)
            .expect("a good style");
        let edges = network.edges().iter();
        let crossing = edges.filter(|edge| {
            let [a, b] = [edge.from, edge.to].map(|n| network.nodes()[n as usize].position);
            edge.from != 0 && outline.is_crossed_by(a, b)
        });
        assert_eq!(crossing.count(), 0, "{name}");
        let form = BladeForm {
            fold: 0.2,
            curl: 0.3,
            ruffle: 0.01,
            ruffle_waves: 3.0,
            pleat: 0.0,
            relief: 0.5,
            thickness_mm: 0.2,
            margin: crate::blade::MarginThickness::EVEN,
            closed: false,
            max_edge_mm: outline.length() / 20.0,
            meshed_vein_radius_mm: 0.1,
        };
        let mesh = BladeMesh::build(&outline, &network, &form).expect("a mesh");
        assert_eq!(mesh.validate(outline.area()), Ok(()), "{name}");
    }
}

proptest! {
    #![proptest_config(fixed(24))]

    #[test]
    fn stars_are_supplied_by_any_parameters(
        rays in 3_u32..9, notch in 6.0..28.0, turn in prop_oneof![Just(0.0), 0.0..0.3],
        alpha in 0.2..0.95, beta in 0.05..3.0, cells_along in 6_u32..40,
    ) {
        let plan = FilledPlan { alpha, beta, ..plan(cells_along) };
        check_blade(&plan, &star(rays, notch, turn));
    }

    #[test]
    fn no_change_of_parent_is_cheaper(
        rays in 3_u32..7, notch in 10.0..25.0, turn in prop_oneof![Just(0.0), 0.05..0.3],
        alpha in 0.4..0.9, beta in 0.1..2.0,
    ) {
        let outline = star(rays, notch, turn);
        let plan = FilledPlan { alpha, beta, ..plan(9) };
        let blade = plan.fill(&outline).expect("a good plan");
        let leaf = blade.leaf();
        let (frame, all) = plan.grid(&outline).expect("a good grid");
        let is_crossed = |a, b| outline.is_crossed_by(frame.to_mm(a), frame.to_mm(b));
        let walls = Walls::around(&all, is_crossed);
        let count = leaf.cells().len();
        let parents: Vec<u32> = (0..count).map(|v| leaf.parent(v).map_or(NONE, |p| p as u32)).collect();
        let number = |cell: Cell| leaf.cells().iter().position(|&c| c == cell);
        for v in 1..count {
            let at = leaf.cells()[v];
            let old = leaf.cells()[parents[v] as usize];
            for u in 0..count {
                let to = leaf.cells()[u];
                // The candidates of the paper's Q_v, restricted to edges on the blade and on one
                // side.
                let near = |other: Cell| (to - other).squared() < 4;
                let keeps_sides = !leaf.is_mirrored()
                    || (to.m * at.m >= 0 && (at.m != 0 || to.m == 0));
                if u == v || !(near(at) || near(old)) || !walls.allow(to, at) || !keeps_sides {
                    continue;
                }
                let mut changed = parents.clone();
                changed[v] = u as u32;
                if leaf.is_mirrored() && at.m != 0 {
                    let image = number(at.mirrored()).expect("it is mirrored");
                    let its = number(to.mirrored()).expect("it is mirrored");
                    changed[image] = its as u32;
                }
                if leads_to_root(&changed) {
                    let parameters = [leaf.plan().alpha, leaf.plan().beta, 1.0];
                    let cost = crate::transport::cost::TransportSystem::new(leaf.cells(), &changed, parameters).cost();
                    prop_assert!(cost >= leaf.cost() * (1.0 - 1e-9), "{at:?} from {to:?}");
                }
            }
        }
    }
}

fn leads_to_root(parents: &[u32]) -> bool {
    (0..parents.len()).all(|v| {
        let mut z = v as u32;
        let mut steps = 0;
        while z != 0 && steps <= parents.len() {
            z = parents[z as usize];
            steps += 1;
        }
        z == 0
    })
}

#[test]
fn the_same_plan_fills_in_the_same_way_and_bad_numbers_are_refused() {
    let outline = outline_of("alchemilla");
    let fill = || plan(30).fill(&outline).expect("a good plan");
    assert_eq!(fill(), fill());
    let refused = |plan: FilledPlan| {
        let count = plan.fill(&outline).map(|blade| blade.unsupplied.len());
        count.expect_err("out of range").to_string()
    };
    let usual = FilledPlan::default();
    assert!(
        refused(FilledPlan {
            alpha: 1.0,
            ..usual
        })
        .starts_with("alpha is 1, outside")
    );
    assert!(refused(FilledPlan { beta: 0.0, ..usual }).starts_with("beta is 0, outside"));
    assert_eq!(refused(plan(3)), "cells_along is 3, outside 4 to 200");
    let style = VeinStyle {
        least_cells: 0,
        ..usual.style
    };
    assert!(refused(FilledPlan { style, ..usual }).starts_with("least_cells is 0"));
    let fine = refused(plan(200));
    assert!(fine.ends_with("cells, more than 20000"), "{fine}");
}
