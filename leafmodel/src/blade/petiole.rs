//! The petiole: a stalk that goes on as the midrib.
//!
//! From the stem it comes along −y to the base at the origin, where the blade's own midrib leaves along +y. Beyond the base the
//! tube follows the thickest vein under the bent blade, gets as thin as that and sinks into it, so that neither a gap
//! nor a step is left. How far and how fast is by eye.

use glam::{DVec2, DVec3};

use super::BladeForm;
use super::form::Bending;
use super::mesh::BladeError;
use super::relief::{Relief, smooth_step};
use super::stalk::StalkMesh;
use crate::shape::outline::Outline;
use crate::venation::network::{VeinSegment, VenationNetwork};

/// Length of the joint in radii of the petiole, and its least and greatest share of the leaf's length.
const JOINT_RADII: f64 = 14.0;
const JOINT_SHARE: [f64; 2] = [0.03, 0.2];
/// Pieces of the joint.
const JOINT_PIECES: usize = 24;
/// Radius of the tube's end over that of the vein it ends in.
const END_RADIUS: f64 = 0.4;
/// By how much the foot is thicker, and over how many radii.
const FOOT: f64 = 0.3;
const FOOT_RADII: f64 = 5.0;
/// Pieces of a petiole, at least, and the greatest angle between two of them, radians.
const PIECES: f64 = 12.0;
const PIECE_ANGLE: f64 = 0.06;

/// What decides a petiole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PetiolePlan {
    /// Length over the leaf's, 0 to 10.
    pub length: f64,
    /// Radius, mm, 0.001 to 100; as the midrib at its base if `None`.
    pub radius_mm: Option<f64>,
    /// Angle by which it has bent towards the abaxial side at its foot, radians, −3 to 3; 0 is straight.
    pub curl: f64,
}

impl PetiolePlan {
    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`BladeError::OutOfRange`] for the first field outside its range.
    pub fn validate(&self) -> Result<(), BladeError> {
        let radius = self.radius_mm.unwrap_or(1.0);
        for (field, value, allowed, range) in [
            ("petiole.length", self.length, 0.0..=10.0, "0 to 10"),
            (
                "petiole.radius_mm",
                radius,
                1e-3..=100.0,
                "0.001 to 100 (millimetres)",
            ),
            ("petiole.curl", self.curl, -3.0..=3.0, "-3 to 3 (radians)"),
        ] {
            if !allowed.contains(&value) {
                return Err(BladeError::OutOfRange {
                    field,
                    value,
                    range,
                });
            }
        }
        Ok(())
    }

    /// Its radius on a leaf with these veins, mm.
    pub fn radius_on(&self, outline: &Outline, network: &VenationNetwork) -> f64 {
        let midrib = || Midrib::new(outline, network).radius;
        self.radius_mm.unwrap_or_else(midrib).max(1e-3)
    }

    /// The petiole of a blade of this form, mm, joint and all.
    ///
    /// # Errors
    ///
    /// [`BladeError`] if a field of either is out of range.
    pub fn build(
        &self,
        outline: &Outline,
        network: &VenationNetwork,
        form: &BladeForm,
    ) -> Result<StalkMesh, BladeError> {
        self.validate()?;
        form.validate()?;
        let midrib = Midrib::new(outline, network);
        let radius = self.radius_mm.unwrap_or(midrib.radius).max(1e-3);
        let leaf = outline.length();
        let length = self.length * leaf;
        let (mut points, mut radii) = (Vec::new(), Vec::new());
        let pieces = PIECES.max((self.curl.abs() / PIECE_ANGLE).ceil()) as usize;
        if length > 1e-6 * leaf {
            for i in 0..pieces {
                let back = length * (pieces - i) as f64 / pieces as f64;
                points.push(self.behind(back, length));
                let from_foot = (length - back) / (FOOT_RADII * radius).min(length);
                radii.push(radius * (1.0 + FOOT * (1.0 - smooth_step(from_foot))));
            }
        }
        let bending = Bending::new(form, outline, network.map());
        let veins: Vec<VeinSegment> = network
            .segments()
            .filter(|vein| vein.radius_from.max(vein.radius_to) >= form.meshed_vein_radius_mm)
            .collect();
        let relief = Relief::new(form, &veins);
        let [least, most] = JOINT_SHARE;
        let joint = (JOINT_RADII * radius).clamp(least * leaf, most * leaf);
        let with_joint = |midrib: &Midrib| {
            let (mut points, mut radii) = (points.clone(), radii.clone());
            for i in 0..=JOINT_PIECES {
                let t = i as f64 / JOINT_PIECES as f64;
                let (p, vein) = midrib.at(joint * t);
                let end = END_RADIUS * vein.min(radius);
                let r = end + (radius - end) * (1.0 - t) * (1.0 - t);
                // At the base about the sheet itself; then as deep as the vein lies, and a little more.
                let depth = smooth_step(t) * (relief.height(p) + 0.5 * r);
                points.push(bending.place(p, -depth));
                radii.push(r);
            }
            StalkMesh::tube(&points, &radii)
        };
        // A vein with a kink is left for the straight line.
        let straight = || {
            let nodes = Vec::new();
            with_joint(&Midrib { nodes, ..midrib })
        };
        Ok(with_joint(&midrib)
            .or_else(|_| straight())
            .expect("a smooth bend of a straight line has no kinks, and radii are above 0"))
    }

    /// A point of the petiole so far from the base.
    fn behind(&self, back: f64, length: f64) -> DVec3 {
        let curvature = self.curl / length;
        let angle = curvature * back;
        let (y, z) = if angle.abs() < 1e-6 {
            (back, 0.5 * angle * back)
        } else {
            let half = libm::sin(0.5 * angle);
            (libm::sin(angle) / curvature, 2.0 * half * half / curvature)
        };
        DVec3::new(0.0, -y, -z)
    }
}

/// The first part of the thickest vein that starts at the base.
struct Midrib {
    base: DVec2,
    /// Radius at the base.
    radius: f64,
    /// Distance along it, place and radius.
    nodes: Vec<(f64, DVec2, f64)>,
}

impl Midrib {
    fn new(outline: &Outline, network: &VenationNetwork) -> Self {
        let base = outline.base();
        let leaf = outline.length();
        let mut thickest: Vec<Option<usize>> = vec![None; network.nodes().len()];
        let edges = network.edges();
        for (number, edge) in edges.iter().enumerate() {
            let best = &mut thickest[edge.from as usize];
            if best.is_none_or(|best| edges[best].radius_from < edge.radius_from) {
                *best = Some(number);
            }
        }
        let place = |node: u32| network.nodes()[node as usize].position;
        let near = |node: &u32| place(*node).distance(base) < 1e-3 * leaf;
        let start = (0..network.origins() as u32).find(near);
        let mut nodes = Vec::new();
        let mut next = start.and_then(|node| thickest[node as usize]);
        let mut way = 0.0;
        // Only as far as it is asked for, and only while it goes on towards the apex.
        while let Some(edge) = next.map(|edge| &edges[edge]) {
            let (from, to) = (place(edge.from), place(edge.to));
            if way > JOINT_SHARE[1] * leaf || (to - from).y <= 0.0 {
                break;
            }
            nodes.push((way, from, edge.radius_from));
            way += from.distance(to);
            next = thickest[edge.to as usize];
        }
        let thick = network.segments().map(|vein| vein.radius_from);
        let radius = nodes
            .first()
            .map_or_else(|| thick.fold(0.0, f64::max), |node| node.2);
        Self {
            base,
            radius,
            nodes,
        }
    }

    /// Place and radius at a distance from the base; straight on behind the last node.
    ///
    /// Veins zigzag from node to node: across, a place is the mean over those near it.
    fn at(&self, way: f64) -> (DVec2, f64) {
        let straight = (self.base + DVec2::Y * way, self.radius);
        let Some(&(last, end, thin)) = self.nodes.last() else {
            return straight;
        };
        if way >= last {
            return (end + DVec2::Y * (way - last), thin);
        }
        let after = self.nodes.partition_point(|node| node.0 <= way).max(1);
        let [(a, from, r), (b, to, s)] = [self.nodes[after - 1], self.nodes[after]];
        let t = (way - a) / (b - a);
        let p = from.lerp(to, t);
        let reach = 0.35 * way;
        let near = self.nodes.iter().filter(|n| (n.0 - way).abs() <= reach);
        let (sum, count) = near.fold((p.x, 1.0), |(sum, count), n| (sum + n.1.x, count + 1.0));
        (DVec2::new(sum / count, p.y), r + (s - r) * t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blade::tests::{ellipse, flat};
    use crate::venation::network::{VeinEdge, VeinNode};

    fn midrib() -> VenationNetwork {
        let node = |i: u32| VeinNode {
            position: DVec2::new(0.0, f64::from(i) * 0.5),
            born: i,
        };
        let edge = |i: u32| VeinEdge {
            from: i,
            to: i + 1,
            radius_from: 0.5 - 0.003 * f64::from(i),
            radius_to: 0.5 - 0.003 * f64::from(i + 1),
            order: 1,
        };
        VenationNetwork::from_parts(
            (0..=120).map(node).collect(),
            (0..120).map(edge).collect(),
            0.5,
        )
        .expect("a midrib")
    }

    #[test]
    fn a_petiole_is_closed_and_goes_from_its_foot_into_the_blade() {
        let outline = ellipse(20.0, 60.0, 60);
        for (curl, bend, radius_mm) in [
            (0.0, 0.0, None),
            (1.0, 0.8, Some(0.9)),
            (-0.5, -1.2, Some(0.1)),
        ] {
            let form = BladeForm {
                curl: bend,
                fold: 0.3,
                relief: 0.5,
                ..flat()
            };
            let plan = PetiolePlan {
                length: 0.5,
                radius_mm,
                curl,
            };
            let mesh = plan.build(&outline, &midrib(), &form).expect("a petiole");
            assert_eq!(mesh.validate(), Ok(()), "{curl}");
            let radius = radius_mm.unwrap_or(0.5);
            assert_eq!(plan.radius_on(&outline, &midrib()), radius);
            // The foot lies on an arc of 30 mm that leaves the base along −y and bends down.
            let foot = plan.behind(30.0, 30.0);
            let least = mesh
                .positions
                .iter()
                .map(|p| p.distance(foot))
                .fold(f64::INFINITY, f64::min);
            assert!(
                (least - radius * (1.0 + FOOT)).abs() < 0.02 * radius,
                "{least}"
            );
            assert!((foot.z < 0.0) == (curl > 0.0) || curl == 0.0);
            assert!(
                mesh.positions.iter().any(|p| p.y > 0.02 * 60.0),
                "it reaches into the blade"
            );
        }
    }

    #[test]
    fn the_joint_ends_within_the_vein() {
        let outline = ellipse(20.0, 60.0, 60);
        let plan = PetiolePlan {
            length: 0.3,
            radius_mm: Some(0.8),
            curl: 0.0,
        };
        let form = BladeForm {
            relief: 0.5,
            ..flat()
        };
        let mesh = plan.build(&outline, &midrib(), &form).expect("a petiole");
        let end = mesh.positions.iter().map(|p| p.y).fold(0.0, f64::max);
        let tip = mesh.positions.iter().filter(|p| p.y > end - 0.3);
        for p in tip {
            // Half-width and height of the mound: 1.5 r, and as much as the relief says.
            assert!(p.x.abs() < 0.5 && p.z < 0.0 && p.z > -0.75, "{p}");
        }
    }

    #[test]
    fn numbers_out_of_range_are_named() {
        let plan = PetiolePlan {
            length: 0.3,
            radius_mm: None,
            curl: 0.0,
        };
        for (bad, name) in [
            (
                PetiolePlan {
                    length: -0.1,
                    ..plan
                },
                "petiole.length",
            ),
            (
                PetiolePlan {
                    radius_mm: Some(0.0),
                    ..plan
                },
                "petiole.radius_mm",
            ),
            (
                PetiolePlan {
                    curl: f64::NAN,
                    ..plan
                },
                "petiole.curl",
            ),
        ] {
            let message = bad.validate().expect_err("out of range").to_string();
            assert!(message.starts_with(name), "{message}");
        }
    }
}
