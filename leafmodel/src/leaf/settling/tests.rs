//! Leaves that have dried, wilted or fallen.

use glam::DVec3;

use crate::blade::stance::Stance;

use super::super::tests::plan;
use super::super::*;
use crate::blade::petiole::{Course, PetiolePlan, Section};
use crate::blade::stance::{Drying, MarginGrowth, Wilting};

fn grown(stance: Stance) -> Leaf {
    let petiole = Some(PetiolePlan {
        length: 0.4,
        radius_mm: Some(0.5),
        curl: 0.3,
        course: Course {
            sag: 0.3,
            neck: -0.4,
            sway: 0.2,
            twist: 0.3,
            stray: 0.1,
            ..Course::STRAIGHT
        },
        section: Section {
            groove: 0.4,
            flatness: 0.2,
            foot: 0.4,
            head: 0.4,
        },
    });
    let plan = LeafPlan {
        stance,
        petiole,
        ..plan()
    };
    Leaf::grow(&plan).expect("a good plan")
}

fn lowest(leaf: &Leaf) -> f64 {
    let stalk = leaf.petiole.iter().flat_map(|stalk| &stalk.positions);
    let all = leaf.mesh.positions.iter().chain(stalk);
    all.map(|p| p.z).fold(f64::INFINITY, f64::min)
}

#[test]
fn fresh_tissue_that_dries_not_at_all_stays_where_it_is() {
    let drying = Some(Drying {
        share: 0.0,
        ..Drying::USUAL
    });
    let leaf = grown(Stance {
        drying,
        ..Stance::default()
    });
    let fresh = grown(Stance::default());
    for (a, b) in leaf.mesh.positions.iter().zip(&fresh.mesh.positions) {
        assert!(a.distance(*b) < 1e-2, "{a} is not {b}");
    }
}

#[test]
fn litter_shrinks_curls_and_lies_on_the_ground() {
    let stance = Stance {
        drying: Some(Drying::USUAL),
        on_ground: true,
        ..Stance::default()
    };
    let (litter, fresh) = (grown(stance), grown(Stance::default()));
    assert_eq!(litter.mesh.validate(litter.lamina.outline.area()), Ok(()));
    assert_eq!(lowest(&litter), 0.0);
    let width = |leaf: &Leaf| {
        let x = leaf.mesh.positions.iter().map(|p| p.x);
        x.clone().fold(f64::MIN, f64::max) - x.fold(f64::MAX, f64::min)
    };
    assert!(width(&litter) < 0.9 * width(&fresh), "{}", width(&litter));
    assert_eq!(grown(stance), litter, "the same bits");
}

#[test]
fn a_wilted_leaf_hangs_from_its_base() {
    let wilted = |share: f64| {
        grown(Stance {
            wilting: Some(Wilting { share, pitch: 0.0 }),
            ..Stance::default()
        })
    };
    let base = |leaf: &Leaf| {
        let all = leaf.mesh.positions.iter().zip(&leaf.mesh.lamina);
        let near = all.min_by(|(_, p), (_, q)| p.length_squared().total_cmp(&q.length_squared()));
        *near.expect("a mesh has vertices").0
    };
    let (fresh, whole) = (wilted(0.0), wilted(1.0));
    assert!(
        lowest(&whole) < lowest(&fresh) - 5.0,
        "{} {}",
        lowest(&whole),
        lowest(&fresh)
    );
    assert!(base(&whole).distance(DVec3::ZERO) < 1.0, "{}", base(&whole));
    assert_eq!(whole.mesh.validate(whole.lamina.outline.area()), Ok(()));
}

#[test]
fn a_leaf_droops_the_more_the_more_turgor_it_has_lost() {
    let droops = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| {
        let leaf = grown(Stance {
            wilting: Some(Wilting { share, pitch: 0.0 }),
            ..Stance::default()
        });
        let heights = leaf.mesh.positions.iter().map(|p| p.z);
        -heights.sum::<f64>() / leaf.mesh.positions.len() as f64
    });
    for pair in droops.windows(2) {
        assert!(pair[1] > pair[0], "{droops:?}");
    }
    // A blade that hangs straight down can droop no more: the first quarter of the turgor counts
    // for more than a quarter of the way, but it is not yet most of it.
    let reached = (droops[1] - droops[0]) / (droops[4] - droops[0]);
    assert!((0.25..0.6).contains(&reached), "{reached} of {droops:?}");
}

#[test]
fn a_margin_that_grows_in_excess_is_longer_and_leaves_the_plane() {
    let excess = |excess: f64| {
        grown(Stance {
            margin_growth: Some(MarginGrowth {
                excess,
                width: 0.05,
            }),
            ..Stance::default()
        })
    };
    let area = |leaf: &Leaf| -> f64 {
        let areas = leaf.mesh.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|v| leaf.mesh.positions[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        });
        areas.sum()
    };
    let (little, much) = (excess(0.01), excess(0.4));
    assert!(area(&much) > 1.15 * area(&little), "{}", area(&much));
    assert_eq!(much.mesh.validate(much.lamina.outline.area()), Ok(()));
}

#[test]
fn dry_leaves_do_not_pass_through_themselves() {
    let species = ["oak-litter", "sugar-maple-autumn"].map(|name| {
        let plan = crate::species::find(name).expect("a preset").plan();
        (name, plan.form_alone().expect("good numbers"))
    });
    // Rolled up from side to side, more than once round.
    let mut rolled = species[0].1.clone();
    rolled.stance.drying = Some(Drying {
        faces: 0.03,
        shrinkage: 0.1,
        ..Drying::USUAL
    });
    for (name, plan) in species.into_iter().chain([("a rolled oak", rolled)]) {
        let mesh = Leaf::grow(&plan).expect("a good plan").mesh;
        let crossed = crate::shell::crossings(&mesh.positions, &mesh.triangles);
        assert_eq!(crossed.len(), 0, "{name}");
    }
}

#[test]
fn a_closed_blade_lies_on_its_abaxial_face() {
    let mut plan = plan();
    plan.form.closed = true;
    plan.form.relief = 0.0;
    plan.stance.on_ground = true;
    let leaf = Leaf::grow(&plan).expect("a good plan");
    let body = leaf.mesh.body(|place| place);
    let bottom = body
        .positions
        .iter()
        .map(|p| p.z)
        .fold(f64::INFINITY, f64::min);
    // The rim is round and tilted, so that it may reach a little less far down than its thickness.
    let slack = 0.5 * plan.form.thickness_mm;
    assert!((-1e-9..slack).contains(&bottom), "{bottom}");
    assert!(lowest(&leaf) > 0.1 * slack, "the sheet is inside");
}

#[test]
fn the_petiole_of_a_leaf_on_the_ground_has_no_step_before_its_joint() {
    for radius_mm in [0.4, 1.4, 2.5] {
        let petiole = Some(PetiolePlan {
            length: 0.5,
            radius_mm: Some(radius_mm),
            curl: 0.3,
            course: Course::STRAIGHT,
            section: Section::default(),
        });
        let stance = Stance {
            on_ground: true,
            ..Stance::default()
        };
        let plan = LeafPlan {
            stance,
            petiole,
            ..plan()
        };
        let leaf = Leaf::grow(&plan).expect("a good plan");
        let stalk = leaf.petiole.expect("it has one");
        // The centres of its rings, from foot to joint; those of the caps left out.
        let rings = stalk.uvs.chunk_by(|a, b| a.y == b.y).scan(0, |from, ring| {
            let own = *from..*from + ring.len();
            *from = own.end;
            Some((ring[0].y, own))
        });
        let centres: Vec<DVec3> = rings
            .filter(|(along, _)| *along > 0.0 && *along < 1.0)
            .map(|(_, own)| {
                let count = own.len() as f64;
                stalk.positions[own].iter().sum::<DVec3>() / count
            })
            .collect();
        assert!(centres.len() > 20);
        let ways: Vec<DVec3> = centres.windows(2).map(|p| p[1] - p[0]).collect();
        for pair in ways.windows(2) {
            let turn = pair[0].angle_between(pair[1]);
            // The whole petiole bends by 0.3 and may be stopped by the ground; a step turns by 1.
            assert!(turn < 0.4, "{radius_mm} mm: it turns by {turn}");
        }
    }
}
