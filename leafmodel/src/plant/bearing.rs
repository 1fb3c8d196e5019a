//! What the nodes of a plant bear: leaves, buds, short shoots and branches.

use glam::{DAffine3, DMat3, DVec3};

use super::apart::{Standing, Wood, keep_apart};
use super::axis::{Axis, Node, Start};
use super::bark::AxisRelief;
use super::climbing::Wall;
use super::plan::{AxisPlan, Branching, Buds, Phyllotaxis, PlantPlan};
use super::posture::Stand;
use super::stems::stem_of;
use super::{BorneLeaf, FlowerPlan, Foot, Organ, Plant};
use crate::blade::stalk::StalkMesh;
use crate::not_grown::{NotGrown, not_grown};
use crate::plane::polyline;
use crate::random::{Use, uniform};
use crate::rotation::about;

/// How deep the foot of a petiole stands in its axis, as a share of the radius there.
const SUNK: f64 = 0.25;
/// Radii of a bud from its foot to its tip, over the greatest, and where.
const BUD: [[f64; 2]; 7] = [
    [0.0, 0.6],
    [0.15, 0.85],
    [0.35, 1.0],
    [0.55, 0.9],
    [0.75, 0.62],
    [0.9, 0.3],
    [1.0, 0.08],
];
/// Direction of a bud in the axil: share of the axis in the bisector with the petiole.
const BUD_UPRIGHT: f64 = 0.55;
/// Radius of a short shoot over that of the axis.
const SPUR_THICKNESS: f64 = 0.7;
/// Angle of the leaves of a short shoot from it: the first and the last.
const CLUSTER_ANGLES: [f64; 2] = [1.25, 0.6];

/// Share of an axis from which on it has no rootlets yet.
const ROOTED: f64 = 0.88;
/// Radii of a rootlet at its foot and its end, mm.
const ROOTLET_MM: [f64; 2] = [0.2, 0.1];

/// A plant under construction.
struct Builder<'a> {
    plan: &'a PlantPlan,
    /// How leaves are held, then sepals and petals.
    feet: &'a [Vec<Foot>],
    /// Number of kinds of leaves.
    kinds: usize,
    wall: Option<&'a Wall>,
    plant: Plant,
    /// The leaves that may turn, and what is in their way besides one another.
    standing: Vec<Standing>,
    wood: Vec<Wood>,
    /// Number of axes so far.
    axes: u64,
    /// Which individual comes next on the present axis.
    next: usize,
}

/// Most leaves of a plant.
const MOST_LEAVES: usize = 100_000;

/// Most vertices of its axes and buds.
const MOST_VERTICES: usize = 1 << 23;

/// Grows a checked plan.
pub(super) fn grow(
    plan: &PlantPlan,
    feet: &[Vec<Foot>],
    wall: Option<&Wall>,
) -> Result<Plant, NotGrown> {
    let mut builder = Builder {
        plan,
        feet,
        kinds: feet.len() - if plan.flower.is_some() { 2 } else { 0 },
        wall,
        plant: Plant {
            axes: StalkMesh::default(),
            leaves: Vec::new(),
            organs: Vec::new(),
            crumbs: Vec::new(),
            crossing: None,
        },
        standing: Vec::new(),
        wood: Vec::new(),
        axes: 0,
        next: 0,
    };
    for stem in 0..plan.stems.count {
        let (axis, at, along) = stem_of(plan, stem, wall);
        builder.axis(&axis, at, along, 0)?;
    }
    let mut plant = builder.plant;
    if plan.climbing.is_none() {
        let bodies = (&*builder.standing, &*builder.wood);
        plant.crossing = keep_apart(plan, feet, bodies, &mut plant.leaves);
    }
    if let Some(pot) = &plan.pot {
        plant.organs.push((Organ::Pot, pot.vessel()));
        plant.organs.push((Organ::Soil, pot.soil(plan.seed)));
        plant.crumbs = pot.crumbs(plan.seed);
    }
    Ok(plant)
}

impl Builder<'_> {
    /// Adds an axis of an order (0 is the main one) and all that it bears.
    fn axis(
        &mut self,
        plan: &AxisPlan,
        at: DVec3,
        along: DVec3,
        order: u32,
    ) -> Result<(), NotGrown> {
        let start = Start {
            at,
            along,
            number: self.axes,
            seed: self.plan.seed,
            wall: self.wall,
        };
        self.axes += 1;
        let axis = plan.grown(&start);
        self.wooden(&axis, start.number)?;
        for (ends, radii) in axis.points.windows(2).zip(axis.radii.windows(2)) {
            self.wood.push(Wood {
                ends: [ends[0], ends[1]],
                radius: radii[0].max(radii[1]),
            });
        }
        self.rootlets(&axis, start.number)?;
        // Neighbours on an axis are different individuals, whatever its branches bear.
        let on_parent = std::mem::replace(&mut self.next, start.number as usize);
        let branching = self
            .plan
            .branching
            .filter(|branches| branches.order > order);
        for (number, node) in (0_u64..).zip(&axis.nodes) {
            let around = plan.phyllotaxis.per_node;
            for leaf in 0..around {
                let turn = std::f64::consts::TAU * f64::from(leaf) / f64::from(around);
                let radial = about(node.along, turn) * node.radial;
                let axil = start.number * 0x1_0000 + number * 16 + u64::from(leaf);
                let branch = branching.filter(|branches| {
                    let [from, to] = branches.between;
                    (from..=to).contains(&node.share)
                        && uniform(self.plan.seed, Use::Branch, axil) < branches.share
                });
                match branch {
                    Some(branches) => self.branch(plan, node, radial, &branches, order)?,
                    None if self.plan.posture.cluster > 1 => self.short_shoot(node, radial)?,
                    None => self.leaf_and_bud(node, radial)?,
                }
            }
        }
        self.next = on_parent;
        match (self.plan.flower, order) {
            (Some(flower), 0) => self.flower(&flower, &axis),
            (Some(_) | None, _) => self.terminal_bud(&axis),
        }
    }

    /// The flower at the tip of an axis.
    fn flower(&mut self, flower: &FlowerPlan, axis: &Axis) -> Result<(), NotGrown> {
        let [.., before, end] = axis.points.as_slice() else {
            return Ok(());
        };
        let seed = self.plan.seed.wrapping_add(self.axes);
        let grown = flower.grown(*end, (*end - *before).normalize(), seed);
        let grown = grown.map_err(|error| bent(&error))?;
        for (whorl, seats) in grown.seats.iter().enumerate() {
            let kind = self.kinds + whorl;
            for (number, seat) in seats.iter().enumerate() {
                let stand = Stand {
                    along: seat.along,
                    radial: seat.radial,
                    angle: seat.angle,
                    number: 0,
                };
                let individual = number % self.feet[kind].len();
                let foot = &self.feet[kind][individual];
                let turn = stand.facing_tip(foot);
                self.plant.leaves.push(BorneLeaf {
                    kind,
                    individual: individual as u32,
                    to_plant: DAffine3::from_mat3_translation(turn, seat.at - turn * foot.at),
                    node: seat.at,
                });
            }
        }
        let bodies = grown.bodies;
        self.plant.organs.extend([
            (Organ::Peduncle, bodies.peduncle),
            (Organ::Filaments, bodies.filaments),
            (Organ::Anthers, bodies.anthers),
            (Organ::Pistil, bodies.pistil),
        ]);
        Ok(())
    }

    /// Adventitious roots of an axis that climbs: from its underside to the wall, on both sides.
    fn rootlets(&mut self, axis: &Axis, number: u64) -> Result<(), NotGrown> {
        let (Some(wall), Some(climbing)) = (self.wall, self.plan.climbing) else {
            return Ok(());
        };
        if climbing.rootlets_per_mm <= 0.0 {
            return Ok(());
        }
        let apart = 1.0 / climbing.rootlets_per_mm;
        let whole = polyline::length(&axis.points);
        let (mut way, mut next, mut count) = (0.0, apart, 0_u64);
        for (piece, pair) in axis.points.windows(2).enumerate() {
            let length = pair[0].distance(pair[1]);
            while next < way + length && next < ROOTED * whole {
                let chance = |what: u64| {
                    uniform(
                        self.plan.seed,
                        Use::Rootlet,
                        (number << 40) + 4 * count + what,
                    )
                };
                let at = pair[0].lerp(pair[1], (next - way) / length);
                let along = (pair[1] - pair[0]) / length;
                let radius = axis.radii[piece];
                let side =
                    along.cross(wall.away()).normalize() * if count % 2 == 0 { 1.0 } else { -1.0 };
                let out = side * (radius * (0.9 + 0.9 * chance(0)));
                let drift = along * (2.0 * radius * (chance(1) - 0.5));
                let end = at + out + drift;
                let end = wall.below(end) + wall.away() * (wall.height(end) - 0.2);
                let foot = at + side * (0.55 * radius) - wall.away() * (0.6 * radius);
                let middle = foot.lerp(end, 0.5) + out * 0.15;
                let [thick, thin] = ROOTLET_MM.map(|mm| mm * (0.7 + 0.6 * chance(2)));
                // One that would turn back is left out.
                if (middle - foot).dot(end - middle) > 0.0 {
                    self.tube(&[foot, middle, end], &[thick, 0.5 * (thick + thin), thin])?;
                }
                count += 1;
                next += apart;
            }
            way += length;
        }
        Ok(())
    }

    /// A branch in the axil of a leaf that has fallen.
    fn branch(
        &mut self,
        parent: &AxisPlan,
        node: &Node,
        radial: DVec3,
        branches: &Branching,
        order: u32,
    ) -> Result<(), NotGrown> {
        let [from, to] = branches.between;
        let share = if to > from {
            (node.share - from) / (to - from)
        } else {
            0.0
        };
        let [first, last] = branches.length;
        let ratio = first + (last - first) * share;
        let thick = branches.thickness * node.radius / (1.0 + parent.swelling);
        let tip = parent.radius_mm[1].min(thick);
        let plan = AxisPlan {
            length_mm: parent.length_mm * ratio,
            nodes: ((f64::from(parent.nodes) * ratio).round() as u32).max(2),
            radius_mm: [thick, tip],
            ..*parent
        };
        let along = node.along * libm::cos(branches.angle) + radial * libm::sin(branches.angle);
        // A short branch has fewer nodes rather than none.
        let plan = (2..=plan.nodes)
            .rev()
            .map(|nodes| AxisPlan { nodes, ..plan })
            .find(|plan| plan.has_room().is_ok());
        match plan {
            Some(plan) => {
                let (at, along) = match self.wall {
                    Some(wall) => (wall.below(node.at), wall.within(along)),
                    None => (node.at, along.normalize()),
                };
                self.axis(&plan, at, along, order + 1)
            }
            None => self.leaf_and_bud(node, radial),
        }
    }

    fn leaf_and_bud(&mut self, node: &Node, radial: DVec3) -> Result<(), NotGrown> {
        let [foot, tip] = self.plan.posture.angle;
        let radial = match self.plan.climbing {
            Some(climbing) => climbing.lifted(radial, node.along),
            None => radial,
        };
        let stand = Stand {
            along: node.along,
            radial,
            angle: foot + (tip - foot) * node.share,
            number: self.plant.leaves.len() as u64,
        };
        if let Some(buds) = self.plan.buds {
            let upwards = node.along * BUD_UPRIGHT + stand.petiole() * (1.0 - BUD_UPRIGHT);
            let above = node.at + node.along * (1.2 * buds.radius_mm);
            let at = above + radial * (node.radius - SUNK * buds.radius_mm);
            self.bud(&buds, at, upwards.normalize(), 1.0)?;
        }
        self.leaf(
            node.at + radial * node.radius * (1.0 - SUNK),
            &stand,
            node.share,
        )
    }

    /// A short shoot: a spur with a cluster of leaves at its end.
    fn short_shoot(&mut self, node: &Node, radial: DVec3) -> Result<(), NotGrown> {
        let posture = &self.plan.posture;
        let [foot, tip] = posture.angle;
        let angle = foot + (tip - foot) * node.share;
        let along = node.along * libm::cos(angle) + radial * libm::sin(angle);
        let radius = SPUR_THICKNESS * node.radius;
        let length = node.radius + posture.spur_mm;
        let end = node.at + along * length;
        self.tube(
            &[node.at, node.at.lerp(end, 0.5), end],
            &[radius, 0.9 * radius, radius],
        )?;
        let reference = super::turned::level(along);
        let count = posture.cluster;
        for number in 0..count {
            let share = f64::from(number) / f64::from(count - 1).max(1.0);
            let turned = f64::from(number) * Phyllotaxis::SPIRAL.divergence;
            let radial = about(along, turned) * reference;
            let [first, last] = CLUSTER_ANGLES;
            let stand = Stand {
                along,
                radial,
                angle: first + (last - first) * share,
                number: self.plant.leaves.len() as u64,
            };
            let back = along * (-0.3 * radius);
            self.leaf(
                end + back + radial * radius * (1.0 - SUNK),
                &stand,
                node.share,
            )?;
        }
        if let Some(buds) = self.plan.buds {
            self.bud(&buds, end, along, 1.0)?;
        }
        Ok(())
    }

    fn leaf(&mut self, at: DVec3, stand: &Stand, share: f64) -> Result<(), NotGrown> {
        let leaves = &mut self.plant.leaves;
        if leaves.len() >= MOST_LEAVES {
            return Err(too_large(self.plan));
        }
        let kinds = self.kinds;
        let kind = ((share * kinds as f64) as usize).min(kinds - 1);
        let individual = self.next % self.feet[kind].len();
        self.next += 1;
        let foot = &self.feet[kind][individual];
        let turn = self.plan.posture.turned(stand, foot, self.plan.seed);
        let mut linear =
            turn * DMat3::from_diagonal(DVec3::splat(self.plan.posture.size_at(share)));
        if let (Some(wall), Some(climbing)) = (self.wall, self.plan.climbing) {
            let blade = foot.reach().map(|point| linear * point);
            linear = climbing.cleared(wall, at, &blade) * linear;
        }
        self.standing.push(Standing {
            leaf: leaves.len(),
            radial: stand.radial,
        });
        leaves.push(BorneLeaf {
            kind,
            individual: individual as u32,
            to_plant: DAffine3::from_mat3_translation(linear, at - linear * foot.at),
            node: at,
        });
        Ok(())
    }

    fn terminal_bud(&mut self, axis: &Axis) -> Result<(), NotGrown> {
        let (Some(buds), [.., before, end]) = (self.plan.buds, axis.points.as_slice()) else {
            return Ok(());
        };
        self.bud(&buds, *end, (*end - *before).normalize(), 1.3)
    }

    fn bud(&mut self, buds: &Buds, at: DVec3, along: DVec3, size: f64) -> Result<(), NotGrown> {
        let points: Vec<DVec3> = BUD
            .iter()
            .map(|[way, _]| at + along * (way * size * buds.length_mm))
            .collect();
        let radii: Vec<f64> = BUD
            .iter()
            .map(|[_, share]| share * size * buds.radius_mm)
            .collect();
        self.tube(&points, &radii)
    }

    /// The body of an axis of this number.
    fn wooden(&mut self, axis: &Axis, number: u64) -> Result<(), NotGrown> {
        let Some(relief) = self.plan.relief else {
            return self.tube(&axis.points, &axis.radii);
        };
        let length = polyline::length(&axis.points);
        let widest = axis.radii.iter().copied().fold(0.0, f64::max);
        let around = std::f64::consts::TAU * widest / relief.edge_mm;
        // With those of both ends.
        let vertices = around * (length / relief.edge_mm + 0.5 * around);
        if vertices > MOST_VERTICES as f64 {
            return Err(too_large(self.plan));
        }
        let own = AxisRelief::new(relief, (self.plan.seed, number), (length, widest));
        let height = |way, turn, radius| own.height(way, turn, radius);
        let tube = StalkMesh::raised(&axis.points, &axis.radii, relief.edge_mm, height);
        self.add(tube.map_err(|error| bent(&error))?)
    }

    fn tube(&mut self, points: &[DVec3], radii: &[f64]) -> Result<(), NotGrown> {
        self.add(StalkMesh::tube(points, radii).map_err(|error| bent(&error))?)
    }

    fn add(&mut self, tube: StalkMesh) -> Result<(), NotGrown> {
        self.plant.axes.append(tube);
        if self.plant.axes.positions.len() > MOST_VERTICES {
            return Err(too_large(self.plan));
        }
        Ok(())
    }
}

/// The error of an axis that bends so sharply that it is no tube.
fn bent(error: &NotGrown) -> NotGrown {
    not_grown!("an axis cannot be built: {error}").mend("length_mm", "let its axes bend less")
}

fn too_large(plan: &PlantPlan) -> NotGrown {
    let (key, help) = if plan.relief.is_some() {
        (
            "relief",
            "use a longer `edge_mm`, or fewer nodes or branches",
        )
    } else {
        ("nodes", "use fewer nodes or branches")
    };
    let error = not_grown!(
        "the plant has more than {MOST_LEAVES} leaves, or {MOST_VERTICES} vertices of axes and buds"
    );
    error.mend(key, help)
}
