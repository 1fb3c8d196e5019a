//! One axis: the course of its middle line, its nodes and its radii.

use glam::{DQuat, DVec3};

use crate::plant::turned::level;

use super::climbing::Wall;
use super::plan::AxisPlan;
use crate::not_grown::{NotGrown, not_grown};
use crate::plane::polyline;
use crate::random::{Use, bell};
use crate::rotation::about;

/// Radius of the tightest bend by which an axis follows a wall, mm: it bridges narrow joints.
const STIFFNESS_MM: f64 = 60.0;

/// Pieces of an internode.
const PIECES: usize = 6;
/// Width of a node's swelling, in radii of the axis.
const SWELLING_RADII: f64 = 1.6;
/// Least distance between two points of the middle line, in radii.
const APART: f64 = 0.15;

/// A node of a grown axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// Its place on the middle line.
    pub(super) at: DVec3,
    /// Direction of the axis there.
    pub(super) along: DVec3,
    /// Direction in which its first leaf stands, at right angles to the axis.
    pub(super) radial: DVec3,
    /// Radius of the axis there, mm.
    pub(super) radius: f64,
    /// Share of the axis below it.
    pub(super) share: f64,
}

/// A grown axis.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    pub(super) points: Vec<DVec3>,
    pub(super) radii: Vec<f64>,
    pub(super) nodes: Vec<Node>,
}

/// Where an axis starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start<'a> {
    pub(super) at: DVec3,
    pub(super) along: DVec3,
    /// Number of the axis within the plant, for its random numbers.
    pub(super) number: u64,
    pub(super) seed: u64,
    /// The wall on which it climbs.
    pub(super) wall: Option<&'a Wall>,
}

impl AxisPlan {
    /// Distances of the nodes from the foot.
    fn nodes_along(&self) -> Vec<f64> {
        let first = self.bare * self.length_mm;
        let count = self.nodes as usize;
        if count == 1 {
            return vec![self.length_mm];
        }
        let mut ways = vec![0.0];
        let mut internode = 1.0;
        for _ in 1..count {
            ways.push(ways[ways.len() - 1] + internode);
            internode *= self.shortening;
        }
        let unit = (self.length_mm - first) / ways[count - 1];
        ways.iter().map(|way| first + way * unit).collect()
    }

    /// Radius at a share of the axis, without the swelling of nodes.
    fn radius(&self, share: f64) -> f64 {
        let [foot, tip] = self.radius_mm;
        foot + (tip - foot) * share
    }

    /// Whether leaves have room between one another.
    pub(super) fn has_room(&self) -> Result<(), NotGrown> {
        let ways = self.nodes_along();
        for pair in ways.windows(2) {
            let (internode, radius) = (pair[1] - pair[0], self.radius(pair[1] / self.length_mm));
            if internode < radius {
                let (length, nodes) = (self.length_mm, self.nodes);
                let error = not_grown!(
                    "an internode of an axis of {length:.3} mm with {nodes} nodes is {internode:.3} \
                     mm long, less than the radius there, {radius:.3} mm"
                );
                let help =
                    "use fewer nodes, a longer or thinner axis, or a `shortening` nearer to 1";
                return Err(error.mend("nodes", help));
            }
        }
        Ok(())
    }

    /// The axis from its foot on.
    pub(super) fn grown(&self, start: &Start<'_>) -> Axis {
        let nodes = self.nodes_along();
        let length = self.length_mm;
        let chance = |number: u64| {
            self.stray * bell(start.seed, Use::Plant, start.number * 0x1_0000 + number)
        };
        let mut axis = Axis {
            points: vec![start.at],
            radii: Vec::new(),
            nodes: Vec::with_capacity(nodes.len()),
        };
        let (mut at, mut along) = (start.at, start.along);
        // Leaves of two ranks lie level on a level axis.
        let mut reference = start.wall.map_or(level(along), |wall| wall.beside(along));
        let mut way = 0.0;
        let mut ways = vec![0.0];
        for (number, &node) in (0_u64..).zip(&nodes) {
            let internode = node - way;
            let pieces = if number == 0 { 2 * PIECES } else { PIECES };
            let piece = internode / pieces as f64;
            let bend = [chance(2 * number), chance(2 * number + 1)];
            for _ in 0..pieces {
                if piece <= 0.0 {
                    break;
                }
                let side = along.cross(reference);
                let up = DVec3::Z - along * along.z;
                let turn = up * (self.upward * piece / length)
                    + (reference * bend[0] + side * bend[1]) / pieces as f64;
                let mut turned = (along + turn).normalize();
                if let Some(wall) = start.wall {
                    turned = wall.within(turned);
                }
                reference = carried(reference, along, turned);
                at += (along + turned).normalize() * piece;
                along = turned;
                way += piece;
                axis.points.push(at);
                ways.push(way);
            }
            let turned = number as f64 * self.phyllotaxis.divergence;
            let mut radial = about(along, turned) * reference;
            if start.wall.is_some() {
                // No leaf stands out of the wall or into it: those of a spiral stand in two rows.
                radial = reference * radial.dot(reference).signum();
            }
            axis.nodes.push(Node {
                at,
                along,
                radial,
                radius: self.radius(node / length) * (1.0 + self.swelling),
                share: (node / length).min(1.0),
            });
            if self.phyllotaxis.per_node == 1 && self.zigzag > 0.0 {
                let bent = (along - radial * libm::tan(self.zigzag)).normalize();
                reference = carried(reference, along, bent);
                along = bent;
            }
        }
        axis.thicken(self, &nodes, &ways);
        if let Some(wall) = start.wall {
            axis.lie_on(wall);
        }
        axis
    }
}

impl Axis {
    /// Lays an axis that was grown in the plane onto the wall: each point lies as high as the axis is
    /// thick, or higher, where it is too stiff to follow.
    fn lie_on(&mut self, wall: &Wall) {
        let needed: Vec<f64> = (self.points.iter().zip(&self.radii))
            .map(|(point, radius)| wall.needed(*point, *radius))
            .collect();
        let ways = polyline::lengths(&self.points);
        let lifted: Vec<f64> = (0..needed.len())
            .map(|here| {
                let bridge = |there: usize| {
                    let away = ways[there] - ways[here];
                    needed[there] - away * away / (2.0 * STIFFNESS_MM)
                };
                (0..needed.len()).map(bridge).fold(needed[here], f64::max)
            })
            .collect();
        let flat = self.points.clone();
        for (point, lift) in self.points.iter_mut().zip(&lifted) {
            *point += wall.away() * lift;
        }
        for node in &mut self.nodes {
            // The point of the middle line that is nearest in the plane.
            let near = (0..flat.len())
                .min_by(|a, b| {
                    let far = |number: &usize| flat[*number].distance_squared(node.at);
                    far(a).total_cmp(&far(b))
                })
                .unwrap_or(0);
            node.at += wall.away() * lifted[near];
            let [from, to] = [near.saturating_sub(1), (near + 1).min(flat.len() - 1)];
            let along = self.points[to] - self.points[from];
            node.along = along.try_normalize().unwrap_or(node.along);
            let radial = node.radial - node.along * node.radial.dot(node.along);
            node.radial = radial.normalize();
        }
    }

    /// Adds points where nodes swell, and gives every point its radius.
    fn thicken(&mut self, plan: &AxisPlan, nodes: &[f64], ways: &[f64]) {
        let length = plan.length_mm;
        let mut wanted: Vec<f64> = ways.to_vec();
        if plan.swelling > 0.0 {
            for &node in nodes {
                let width = SWELLING_RADII * plan.radius(node / length);
                let around = [-1.5, -1.0, -0.5, 0.5, 1.0, 1.5].map(|step| node + step * width);
                wanted.extend(around.into_iter().filter(|way| (0.0..length).contains(way)));
            }
            wanted.sort_by(f64::total_cmp);
        }
        let last = ways[ways.len() - 1];
        let mut kept: Vec<f64> = vec![0.0];
        for way in wanted {
            let apart = APART * plan.radius(way / length);
            if way - kept[kept.len() - 1] >= apart && last - way >= apart {
                kept.push(way);
            }
        }
        kept.push(last);
        let before = std::mem::take(&mut self.points);
        self.points = kept.iter().map(|&way| on(ways, &before, way)).collect();
        self.radii = kept
            .iter()
            .map(|&way| {
                let radius = plan.radius(way / length);
                let width = SWELLING_RADII * radius;
                let swollen = |node: &f64| {
                    let away = (way - node) / width;
                    libm::exp(-away * away)
                };
                // Farther ones are not felt: e⁻³⁶.
                let near = nodes.partition_point(|&node| node < way - 6.0 * width)
                    ..nodes.partition_point(|&node| node <= way + 6.0 * width);
                let most = nodes[near].iter().map(swollen).fold(0.0, f64::max);
                radius * (1.0 + plan.swelling * most)
            })
            .collect();
    }
}

/// The place at a way along a polyline.
fn on(ways: &[f64], points: &[DVec3], way: f64) -> DVec3 {
    let after = ways
        .partition_point(|&one| one < way)
        .clamp(1, ways.len() - 1);
    let (from, to) = (ways[after - 1], ways[after]);
    let share = if to > from {
        (way - from) / (to - from)
    } else {
        0.0
    };
    points[after - 1].lerp(points[after], share)
}

/// A direction at right angles to `from`, carried along as that turns to `to`.
fn carried(reference: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let turned = DQuat::from_rotation_arc(from, to) * reference;
    (turned - to * turned.dot(to)).normalize()
}
