//! What the nodes of a plant bear: leaves, buds, short shoots and branches.

use glam::{DAffine3, DMat3, DVec3};

use super::axis::{Axis, Node, Start};
use super::posture::Stand;
use super::{
    AxisPlan, BorneLeaf, Branching, Buds, Foot, MOST_LEAVES, MOST_VERTICES, Phyllotaxis, Plant,
    PlantError, PlantPlan,
};
use crate::blade::stalk::StalkMesh;
use crate::rotation::about;
use crate::shape::chance::{Use, uniform};

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

/// A plant under construction.
struct Builder<'a> {
    plan: &'a PlantPlan,
    feet: &'a [Vec<Foot>],
    plant: Plant,
    /// Number of axes so far.
    axes: u64,
    /// Which individual comes next on the present axis.
    next: usize,
}

/// Grows a checked plan.
pub(super) fn grow(plan: &PlantPlan, feet: &[Vec<Foot>]) -> Result<Plant, PlantError> {
    let mut builder = Builder {
        plan,
        feet,
        plant: Plant {
            axes: StalkMesh::default(),
            leaves: Vec::new(),
        },
        axes: 0,
        next: 0,
    };
    let (sin, cos) = (
        libm::sin(plan.axis.inclination),
        libm::cos(plan.axis.inclination),
    );
    let along = DVec3::new(0.0, sin, cos);
    builder.axis(&plan.axis, DVec3::ZERO, along, 0)?;
    Ok(builder.plant)
}

impl Builder<'_> {
    /// Adds an axis of an order (0 is the main one) and all that it bears.
    fn axis(
        &mut self,
        plan: &AxisPlan,
        at: DVec3,
        along: DVec3,
        order: u32,
    ) -> Result<(), PlantError> {
        let start = Start {
            at,
            along,
            number: self.axes,
            seed: self.plan.seed,
        };
        self.axes += 1;
        let axis = plan.grown(&start);
        self.tube(&axis.points, &axis.radii)?;
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
        self.terminal_bud(&axis)
    }

    /// A branch in the axil of a leaf that has fallen.
    fn branch(
        &mut self,
        parent: &AxisPlan,
        node: &Node,
        radial: DVec3,
        branches: &Branching,
        order: u32,
    ) -> Result<(), PlantError> {
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
            Some(plan) => self.axis(&plan, node.at, along.normalize(), order + 1),
            None => self.leaf_and_bud(node, radial),
        }
    }

    fn leaf_and_bud(&mut self, node: &Node, radial: DVec3) -> Result<(), PlantError> {
        let [foot, tip] = self.plan.posture.angle;
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
    fn short_shoot(&mut self, node: &Node, radial: DVec3) -> Result<(), PlantError> {
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
        let reference = super::axis::level(along);
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

    fn leaf(&mut self, at: DVec3, stand: &Stand, share: f64) -> Result<(), PlantError> {
        let leaves = &mut self.plant.leaves;
        if leaves.len() >= MOST_LEAVES {
            return Err(PlantError::TooLarge);
        }
        let kinds = self.feet.len();
        let kind = ((share * kinds as f64) as usize).min(kinds - 1);
        let individual = self.next % self.feet[kind].len();
        self.next += 1;
        let foot = &self.feet[kind][individual];
        let turn = self.plan.posture.turned(stand, foot, self.plan.seed);
        let linear = turn * DMat3::from_diagonal(DVec3::splat(self.plan.posture.size_at(share)));
        leaves.push(BorneLeaf {
            kind,
            individual: individual as u32,
            to_plant: DAffine3::from_mat3_translation(linear, at - linear * foot.at),
            node: at,
        });
        Ok(())
    }

    fn terminal_bud(&mut self, axis: &Axis) -> Result<(), PlantError> {
        let (Some(buds), [.., before, end]) = (self.plan.buds, axis.points.as_slice()) else {
            return Ok(());
        };
        self.bud(&buds, *end, (*end - *before).normalize(), 1.3)
    }

    fn bud(&mut self, buds: &Buds, at: DVec3, along: DVec3, size: f64) -> Result<(), PlantError> {
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

    fn tube(&mut self, points: &[DVec3], radii: &[f64]) -> Result<(), PlantError> {
        self.plant.axes.append(StalkMesh::tube(points, radii)?);
        if self.plant.axes.positions.len() > MOST_VERTICES {
            return Err(PlantError::TooLarge);
        }
        Ok(())
    }
}
