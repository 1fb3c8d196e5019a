//! Leaves that get out of each other's way.
//!
//! A leaf whose blade would cut another blade or an axis tries other turns about the foot of its
//! petiole, ever larger ones, and takes the first that cuts nothing, or the one that cuts least.
//! Blades are the coarse sheets of their feet, axes two crossed strips.

use glam::{DAffine3, DMat3, DVec3};

use super::plan::PlantPlan;
use super::posture::LEAST_AWAY;
use super::{BorneLeaf, Foot};
use crate::random::{Use, bell};
use crate::rotation::about;
use crate::shell::{Extent, cross, each_near, sweep};

/// Standard deviation of the turns about each axis that come first and last, radians.
const TURNS: [f64; 2] = [0.1, 0.4];
/// How often all leaves are looked at: one that turns later may have been in an earlier one's way.
const SWEEPS: usize = 2;
/// A plant of more leaves keeps them as they stand.
const MOST_TURNED: usize = 20_000;
/// Most neighbours of a leaf that are looked at, and most pairs of boxes around triangles in all: what
/// is crowded beyond that stays as it stands.
const MOST_NEAR: usize = 1024;
const MOST_WORK: u64 = 1 << 29;
/// Distance from a leaf's node within which its own axis is not in its way, over the axis' radius.
const OWN_WOOD: f64 = 2.0;

/// A leaf that may turn: its number within the plant, and the direction away from its axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    pub leaf: usize,
    pub radial: DVec3,
}

/// A straight piece of an axis: its ends and its radius, mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wood {
    pub ends: [DVec3; 2],
    pub radius: f64,
}

/// Triangles that may be in the way, with boxes around them.
#[derive(Clone, Debug)]
struct Body {
    faces: Vec<([DVec3; 3], Extent)>,
    extent: Extent,
}

impl Body {
    fn new(triangles: impl Iterator<Item = [DVec3; 3]>) -> Self {
        let faces: Vec<_> = triangles.map(|face| (face, Extent::of(&face))).collect();
        let corners: Vec<DVec3> = faces.iter().flat_map(|(face, _)| *face).collect();
        Self {
            extent: Extent::of(&corners),
            faces,
        }
    }

    /// The blade of a leaf whose frame goes to the plant's like this.
    fn blade(foot: &Foot, to_plant: &DAffine3) -> Self {
        let rows: Vec<[DVec3; 3]> = foot
            .blade
            .iter()
            .map(|row| row.map(|point| to_plant.transform_point3(point)))
            .collect();
        Self::new(rows.windows(2).flat_map(|pair| {
            let [[a, b, c], [d, e, f]] = [pair[0], pair[1]];
            [[a, b, e], [a, e, d], [b, c, f], [b, f, e]]
        }))
    }

    fn wood(wood: &Wood) -> Self {
        let [from, to] = wood.ends;
        let (first, second) = (to - from).normalize_or(DVec3::Z).any_orthonormal_pair();
        Self::new([first, second].into_iter().flat_map(|across| {
            let side = across * wood.radius;
            let corners = [from - side, from + side, to + side, to - side];
            let [a, b, c, d] = corners;
            [[a, b, c], [a, c, d]]
        }))
    }

    /// How many pairs of triangles cross; adds the pairs of boxes that it compares to `work`.
    fn cuts(&self, other: &Self, work: &mut u64) -> usize {
        if !self.extent.meets(&other.extent) {
            return 0;
        }
        let mut count = 0;
        for (face, extent) in &self.faces {
            if !extent.meets(&other.extent) {
                continue;
            }
            *work += other.faces.len() as u64;
            let near = other.faces.iter().filter(|(_, own)| own.meets(extent));
            count += near.filter(|(own, _)| cross(face, own)).count();
        }
        count
    }
}

impl Wood {
    /// Whether a node is on this piece.
    fn bears(&self, node: DVec3) -> bool {
        let [from, to] = self.ends;
        let way = to - from;
        let along = ((node - from).dot(way) / way.length_squared().max(1e-12)).clamp(0.0, 1.0);
        from.lerp(to, along).distance(node) < OWN_WOOD * self.radius
    }
}

/// Turns the leaves of a plant that cut others or its axes. How many still do; `None` if not all
/// were looked at.
pub(super) fn keep_apart(
    plan: &PlantPlan,
    feet: &[Vec<Foot>],
    (standing, wood): (&[Standing], &[Wood]),
    leaves: &mut [BorneLeaf],
) -> Option<usize> {
    if plan.evasions == 0 || leaves.len() > MOST_TURNED {
        return None;
    }
    let foot = |leaf: &BorneLeaf| &feet[leaf.kind][leaf.individual as usize];
    let mut bodies: Vec<Body> = leaves
        .iter()
        .map(|leaf| Body::blade(foot(leaf), &leaf.to_plant))
        .chain(wood.iter().map(Body::wood))
        .collect();
    let near = neighbours(leaves, &bodies, wood);
    let mut work = 0;
    let mut crossing = 0;
    for _ in 0..SWEEPS {
        let mut has_turned = false;
        crossing = 0;
        for stand in standing {
            if work > MOST_WORK {
                return None;
            }
            let leaf = leaves[stand.leaf];
            let mut cuts = |body: &Body| -> usize {
                let others = near[stand.leaf].iter();
                others
                    .map(|&other| body.cuts(&bodies[other as usize], &mut work))
                    .sum()
            };
            let mut least = cuts(&bodies[stand.leaf]);
            let mut best = None;
            for number in 1..=plan.evasions {
                if least == 0 {
                    break;
                }
                let Some(to_plant) = turned(plan, &leaf, foot(&leaf), stand, number) else {
                    continue;
                };
                let body = Body::blade(foot(&leaf), &to_plant);
                let count = cuts(&body);
                if count < least {
                    (least, best) = (count, Some((to_plant, body)));
                }
            }
            if let Some((to_plant, body)) = best {
                leaves[stand.leaf].to_plant = to_plant;
                bodies[stand.leaf] = body;
                has_turned = true;
            }
            crossing += usize::from(least > 0);
        }
        if !has_turned {
            break;
        }
    }
    Some(crossing)
}

/// The place of a leaf that has turned, the try of this number; none if its petiole would bend into
/// the axis.
fn turned(
    plan: &PlantPlan,
    leaf: &BorneLeaf,
    foot: &Foot,
    stand: &Standing,
    number: u32,
) -> Option<DAffine3> {
    let [first, last] = TURNS;
    let deviation = first + (last - first) * f64::from(number) / f64::from(plan.evasions);
    let by = |which: u64| {
        let counter = ((stand.leaf as u64) << 16) + 3 * u64::from(number) + which;
        deviation * bell(plan.seed, Use::Evasion, counter)
    };
    let own = about(DVec3::X, by(0)) * about(DVec3::Y, by(1)) * about(DVec3::Z, by(2));
    let linear = leaf.to_plant.matrix3;
    let away = |linear: DMat3| {
        let petiole = linear * foot.frame.y_axis;
        petiole.normalize_or_zero().dot(stand.radial)
    };
    let least = LEAST_AWAY.min(away(linear));
    let linear = linear * own;
    (away(linear) >= least)
        .then(|| DAffine3::from_mat3_translation(linear, leaf.node - linear * foot.at))
}

/// The bodies that each leaf may reach by turning: leaves first, then wood that does not bear it.
fn neighbours(leaves: &[BorneLeaf], bodies: &[Body], wood: &[Wood]) -> Vec<Vec<u32>> {
    let reach = |leaf: usize| {
        let node = leaves[leaf].node;
        let corners = bodies[leaf].faces.iter().flat_map(|(face, _)| face);
        let far = corners
            .map(|corner| corner.distance(node))
            .fold(0.0, f64::max);
        Extent::of(&[node]).widened(far)
    };
    let mut boxes: Vec<(Extent, u32)> = (0_u32..)
        .zip(bodies)
        .filter(|(_, body)| !body.faces.is_empty())
        .map(|(number, body)| match number as usize {
            leaf if leaf < leaves.len() => (reach(leaf), number),
            _ => (body.extent, number),
        })
        .collect();
    sweep(&mut boxes);
    let mut near = vec![Vec::new(); leaves.len()];
    each_near(&boxes, |a, b| {
        for (leaf, other) in [(a, b), (b, a)] {
            let Some(own) = leaves.get(leaf as usize) else {
                continue;
            };
            if near[leaf as usize].len() >= MOST_NEAR {
                continue;
            }
            let borne_by = (other as usize).checked_sub(leaves.len());
            if borne_by.is_none_or(|piece| !wood[piece].bears(own.node)) {
                near[leaf as usize].push(other);
            }
        }
    });
    near
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Plant, presets};
    use crate::species;

    /// Leaves of a plant's preset with the leaf of a name, and how many of its pairs of leaves cut
    /// each other.
    fn grown(preset: &str, leaf: &str, evasions: u32) -> (Plant, usize) {
        let mut plan = presets::find(preset).expect("a preset").plan();
        (plan.evasions, plan.individuals) = (evasions, 4);
        let leaf = species::find(leaf).expect("a preset").plan();
        let feet = (0..4_u64).map(|number| Foot::of(&leaf.individual(None, number)));
        let feet: Vec<Foot> = feet.collect::<Result<_, _>>().expect("it is borne");
        let plant = Plant::grow(&plan, std::slice::from_ref(&feet), None).expect("a good plan");
        let bodies: Vec<Body> = plant
            .leaves
            .iter()
            .map(|leaf| Body::blade(&feet[leaf.individual as usize], &leaf.to_plant))
            .collect();
        let mut cut = 0;
        for (number, body) in bodies.iter().enumerate() {
            cut += bodies[..number]
                .iter()
                .filter(|o| body.cuts(o, &mut 0) > 0)
                .count();
        }
        (plant, cut)
    }

    #[test]
    fn leaves_that_would_cut_others_turn_out_of_their_way() {
        for (preset, leaf) in [
            ("ginkgo-shoot", "ginkgo"),
            ("poplar-branch", "poplar"),
            ("maple-bough", "maple"),
            ("croton-shoot", "croton"),
        ] {
            let [(before, many), (after, few)] = [0, 24].map(|n| grown(preset, leaf, n));
            assert!(many > 0 && few * 8 <= many, "{preset}: {many}, then {few}");
            // Some that cut no other leaf cut an axis.
            let crossing = after.crossing.expect("all were looked at");
            assert!((few > 0) <= (crossing > 0), "{preset}: {few}, {crossing}");
            assert!(20 * crossing <= after.leaves.len(), "{preset}: {crossing}");
            assert_eq!(before.crossing, None);
            let (before, after) = (before.leaves, after.leaves);
            let stayed = before.iter().zip(&after).filter(|(a, b)| a == b).count();
            assert!(2 * stayed > before.len(), "{preset}: {stayed} stay");
            for (a, b) in before.iter().zip(&after) {
                assert_eq!(
                    (a.node, a.kind, a.individual),
                    (b.node, b.kind, b.individual)
                );
            }
        }
    }

    #[test]
    fn the_preset_of_a_tuft_keeps_its_inner_blades_upright() {
        let tuft = presets::find("grass-tuft").expect("a preset").plan();
        let [(kept, _), (turned, _)] =
            [tuft.evasions, 24].map(|tries| grown("grass-tuft", "grass-blade", tries));
        // Greatest angle of an inner blade to the vertical.
        let lean = |plant: &Plant| {
            let up = |leaf: &BorneLeaf| leaf.to_plant.matrix3.y_axis.normalize().z;
            let inner = plant.leaves.iter().rev().take(8);
            libm::acos(inner.map(up).fold(1.0, f64::min)).to_degrees()
        };
        let leans = [&kept, &turned].map(lean);
        assert!(leans[0] < 25.0 && leans[1] > 45.0, "{leans:?}");
        // And half of them still cut others.
        assert_eq!((turned.leaves.len(), turned.crossing), (26, Some(14)));
    }

    #[test]
    fn a_strip_of_wood_cuts_what_it_passes_through_and_not_what_it_bears() {
        let wood = Wood {
            ends: [DVec3::new(0.0, 0.0, -5.0), DVec3::new(0.0, 0.0, 5.0)],
            radius: 1.0,
        };
        let face = |x: f64| {
            let corners = [[x - 3.0, -3.0, 0.1], [x + 3.0, -3.0, 0.2], [x, 4.0, 0.3]];
            Body::new([corners.map(DVec3::from_array)].into_iter())
        };
        assert!(Body::wood(&wood).cuts(&face(0.0), &mut 0) > 0);
        assert_eq!(Body::wood(&wood).cuts(&face(8.0), &mut 0), 0);
        assert!(wood.bears(DVec3::new(1.5, 0.0, 2.0)));
        assert!(!wood.bears(DVec3::new(1.5, 0.0, 8.0)));
    }

    #[test]
    fn a_plant_too_dense_to_be_sorted_out_is_grown_all_the_same() {
        let mut plan = presets::find("croton-shoot").expect("a preset").plan();
        (plan.axis.nodes, plan.axis.length_mm) = (1000, 20_000.0);
        plan.axis.shortening = 1.0;
        plan.axis.phyllotaxis.per_node = 12;
        plan.branching = None;
        let leaf = species::find("croton").expect("a preset").plan();
        let foot = Foot::of(&leaf).expect("it is borne");
        let [turned, stayed] = [24, 0].map(|evasions| {
            plan.evasions = evasions;
            let plant = Plant::grow(&plan, &[vec![foot.clone()]], None);
            plant.expect("a good plan").leaves
        });
        assert_eq!((turned.len(), stayed.len()), (12_000, 12_000));
        // The first have turned, the last have not been looked at.
        assert_ne!(turned[..100], stayed[..100]);
        assert_eq!(turned[11_000..], stayed[11_000..]);
    }
}
