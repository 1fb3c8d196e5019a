//! The midrib, its secondaries and their tertiaries.

use glam::DVec2;

use super::skeleton::{Skeleton, angle_deg};
use super::statistics::{mean, variation};

/// Length over which a secondary's angle is taken, as a share of the midrib's.
const CHORD: f64 = 0.05;

/// Measures of the midrib and of its secondaries and tertiaries.
#[derive(Debug, Default)]
pub(super) struct Hierarchy {
    /// Length of the midrib.
    pub(super) midrib_mm: Option<f64>,
    /// Secondaries that leave the midrib on its left, seen from the base.
    pub(super) left: usize,
    /// Secondaries on the right.
    pub(super) right: usize,
    /// Mean distance along the midrib between neighbours on one side.
    pub(super) spacing_mm: Option<f64>,
    /// Standard deviation of that distance over its mean.
    pub(super) spacing_cv: Option<f64>,
    /// Mean angle between secondaries and the midrib's direction to the apex.
    pub(super) secondary_deg: Option<f64>,
    /// Mean angle between tertiaries and the direction of the secondary that they leave.
    pub(super) tertiary_deg: Option<f64>,
}

impl Hierarchy {
    pub(super) fn new(skeleton: &Skeleton, base: DVec2) -> Self {
        let tertiary_deg = mean(&tertiary_angles(skeleton));
        let Some(midrib) = Midrib::new(skeleton, base) else {
            return Self {
                tertiary_deg,
                ..Self::default()
            };
        };
        let length = midrib.length();
        let chord = CHORD * length;
        let mut places: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
        let mut angles = Vec::new();
        for (&node, &at) in midrib.nodes.iter().zip(&midrib.along) {
            for &edge in skeleton.topology.leaving(node) {
                if skeleton.edge(edge).order == 2 {
                    let here = skeleton.place(node);
                    let along = midrib.at(skeleton, at + chord) - midrib.at(skeleton, at - chord);
                    let aside = follow(skeleton, edge, chord) - here;
                    places[usize::from(along.perp_dot(aside) < 0.0)].push(at);
                    angles.push(angle_deg(along, aside));
                }
            }
        }
        let gaps: Vec<f64> = places
            .iter()
            .flat_map(|side| side.windows(2).map(|pair| pair[1] - pair[0]))
            .collect();
        Self {
            midrib_mm: Some(length),
            left: places[0].len(),
            right: places[1].len(),
            spacing_mm: mean(&gaps),
            spacing_cv: variation(&gaps),
            secondary_deg: mean(&angles),
            tertiary_deg,
        }
    }
}

/// The edge of this order in which a vein continues from the end of another edge: that with the
/// largest `r (1 + cos φ)`, as in [`crate::venation`].
fn continuation(skeleton: &Skeleton, edge: u32, order: u8) -> Option<u32> {
    let out = skeleton.topology.leaving(skeleton.edge(edge).to);
    let mut same = out
        .iter()
        .copied()
        .filter(|&e| skeleton.edge(e).order == order);
    let first = same.next()?;
    let arrival = skeleton.arrival(edge).normalize_or_zero();
    let score = |e: u32| {
        let departure = skeleton.departure(e).normalize_or_zero();
        skeleton.edge(e).radius_to * (1.0 + arrival.dot(departure))
    };
    let better = |best: u32, other: u32| {
        if score(other) > score(best) {
            other
        } else {
            best
        }
    };
    Some(same.fold(first, better))
}

/// The point of a vein at the distance `length` from its start, or its end if it is shorter.
fn follow(skeleton: &Skeleton, edge: u32, length: f64) -> DVec2 {
    let order = skeleton.edge(edge).order;
    let (mut edge, mut left) = (edge, length);
    loop {
        let e = skeleton.edge(edge);
        let (from, to) = (skeleton.place(e.from), skeleton.place(e.to));
        let step = (to - from).length();
        if step >= left {
            return from + (to - from) * (left / step);
        }
        left -= step;
        match continuation(skeleton, edge, order) {
            Some(next) => edge = next,
            None => return to,
        }
    }
}

/// The widest vein of order 1 at its start, followed along the widest and straightest branches.
struct Midrib {
    nodes: Vec<u32>,
    /// Length from the base to each node.
    along: Vec<f64>,
}

impl Midrib {
    /// The midrib; `None` without a vein of order 1. Of equally wide ones it is the nearest to the
    /// base.
    fn new(skeleton: &Skeleton, base: DVec2) -> Option<Self> {
        let distance = |edge: u32| (skeleton.place(skeleton.edge(edge).from) - base).length();
        let first = skeleton
            .nodes()
            .filter(|&node| skeleton.topology.entering(node).is_empty())
            .flat_map(|node| skeleton.topology.leaving(node))
            .copied()
            .filter(|&edge| skeleton.edge(edge).order == 1)
            .reduce(|best, other| {
                let (p, q) = (
                    skeleton.edge(best).radius_to,
                    skeleton.edge(other).radius_to,
                );
                let better = q > p || (q == p && distance(other) < distance(best));
                if better { other } else { best }
            })?;
        let mut midrib = Self {
            nodes: vec![skeleton.edge(first).from],
            along: vec![0.0],
        };
        let mut next = Some(first);
        let mut length = 0.0;
        // A vein that crosses itself contains a cycle once the crossing is a node.
        let mut seen = vec![false; skeleton.nodes().len()];
        while let Some(edge) = next {
            let e = skeleton.edge(edge);
            if std::mem::replace(&mut seen[e.to as usize], true) {
                break;
            }
            length += (skeleton.place(e.to) - skeleton.place(e.from)).length();
            midrib.nodes.push(e.to);
            midrib.along.push(length);
            next = continuation(skeleton, edge, 1);
        }
        Some(midrib)
    }

    fn length(&self) -> f64 {
        self.along[self.along.len() - 1]
    }

    /// The point at a length from the base, clamped to the midrib.
    fn at(&self, skeleton: &Skeleton, length: f64) -> DVec2 {
        let last = self.along.len() - 1;
        let next = self
            .along
            .partition_point(|&along| along < length)
            .clamp(1, last);
        let (start, end) = (self.along[next - 1], self.along[next]);
        let share = ((length - start) / (end - start)).clamp(0.0, 1.0);
        let (a, b) = (
            skeleton.place(self.nodes[next - 1]),
            skeleton.place(self.nodes[next]),
        );
        a + (b - a) * share
    }
}

/// Angles at which veins of order 3 leave those of order 2.
fn tertiary_angles(skeleton: &Skeleton) -> Vec<f64> {
    let mut angles = Vec::new();
    for node in skeleton.nodes() {
        if skeleton.degree(node) < 3 {
            continue;
        }
        let entering = skeleton.topology.entering(node).iter().copied();
        let Some(secondary) = entering
            .clone()
            .find(|&edge| skeleton.edge(edge).order == 2)
        else {
            continue;
        };
        let along = match continuation(skeleton, secondary, 2) {
            Some(next) => skeleton.departure(next),
            None => skeleton.arrival(secondary),
        };
        for &edge in skeleton.topology.leaving(node) {
            if skeleton.edge(edge).order == 3 {
                angles.push(angle_deg(along, skeleton.departure(edge)));
            }
        }
    }
    angles
}
