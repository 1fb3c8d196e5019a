//! Walks around faces, and the cycle of veins that encloses each.

use glam::DVec2;

use super::{Areole, Chains};
use crate::plane::polygon;

/// Upper bound of elongation.
const MOST_ELONGATED: f64 = 1e6;

/// All halves, each once, in closed walks with a face on their left.
pub(super) struct Walks {
    starts: Vec<u32>,
    halves: Vec<u32>,
    /// Signed area enclosed by each walk: negative or 0 for the walk around the outside of each
    /// component.
    pub(super) areas: Vec<f64>,
    /// Component of each walk.
    component: Vec<u32>,
    /// Component of each joint.
    pub(super) component_of_joint: Vec<u32>,
    /// The walk around the outside of each component.
    pub(super) outer: Vec<u32>,
}

impl Walks {
    pub(super) fn halves(&self, walk: usize) -> &[u32] {
        &self.halves[self.starts[walk] as usize..self.starts[walk + 1] as usize]
    }

    /// The walks around bounded faces.
    pub(super) fn bounded(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.areas.len())
            .filter(|&walk| self.outer[self.component[walk] as usize] != walk as u32)
    }
}

/// Follows all faces.
pub(super) fn walks(chains: &Chains) -> Walks {
    let nexts = chains.nexts();
    let bulges: Vec<f64> = (0..chains.len() as u32)
        .map(|chain| polygon::signed_area(chains.points(chain)))
        .collect();
    let mut walks = Walks {
        starts: vec![0],
        halves: Vec::with_capacity(nexts.len()),
        areas: Vec::new(),
        component: Vec::new(),
        component_of_joint: components(chains),
        outer: Vec::new(),
    };
    let mut done = vec![false; nexts.len()];
    for first in 0..nexts.len() as u32 {
        if done[first as usize] {
            continue;
        }
        let origin = tail(chains, first);
        let mut area = 0.0;
        let mut half = first;
        while !done[half as usize] {
            done[half as usize] = true;
            walks.halves.push(half);
            area += swept(chains, &bulges, half, origin);
            half = nexts[half as usize];
        }
        let component = walks.component_of_joint[chains.start(first) as usize];
        let walk = walks.areas.len() as u32;
        walks.areas.push(area);
        walks.component.push(component);
        walks.starts.push(walks.halves.len() as u32);
        // The walk around the outside is the only one of its component with a negative area; a tree
        // has only one walk.
        if component as usize == walks.outer.len() {
            walks.outer.push(walk);
        } else if area < walks.areas[walks.outer[component as usize] as usize] {
            walks.outer[component as usize] = walk;
        }
    }
    walks
}

fn tail(chains: &Chains, half: u32) -> DVec2 {
    let points = chains.points(half / 2);
    points[(half % 2) as usize * (points.len() - 1)]
}

/// Signed area between a half and `origin`, positive if the half runs counter-clockwise around it.
fn swept(chains: &Chains, bulges: &[f64], half: u32, origin: DVec2) -> f64 {
    let bulge = bulges[(half / 2) as usize];
    let (a, b) = (tail(chains, half), tail(chains, half ^ 1));
    let chord = 0.5 * (a - origin).perp_dot(b - origin);
    if half.is_multiple_of(2) {
        chord + bulge
    } else {
        chord - bulge
    }
}

/// Component of each joint, numbered in the order in which the halves first reach them.
fn components(chains: &Chains) -> Vec<u32> {
    let mut component = vec![u32::MAX; chains.joints.len()];
    let mut count = 0;
    let mut open = Vec::new();
    for &[first, _] in &chains.ends {
        if component[first as usize] != u32::MAX {
            continue;
        }
        component[first as usize] = count;
        open.push(first);
        while let Some(joint) = open.pop() {
            for &half in chains.leaving(joint) {
                let other = chains.start(half ^ 1);
                if component[other as usize] == u32::MAX {
                    component[other as usize] = count;
                    open.push(other);
                }
            }
        }
        count += 1;
    }
    component
}

/// Finds the enclosing cycle in a walk around a face.
///
/// The walk passes veins that end inside the face twice and goes around rings attached inside it.
/// Whenever it returns to a joint, the part in between is a simple cycle, or a path there and back,
/// and is removed. Only the enclosing cycle runs counter-clockwise.
pub(super) struct Cycles {
    /// Position of each joint on the stack.
    at: Vec<u32>,
    stack: Vec<u32>,
    best: Vec<u32>,
    polygon: Vec<DVec2>,
}

impl Cycles {
    pub(super) fn new(chains: &Chains) -> Self {
        Self {
            at: vec![u32::MAX; chains.joints.len()],
            stack: Vec::new(),
            best: Vec::new(),
            polygon: Vec::new(),
        }
    }

    /// Halves of the last enclosing cycle.
    pub(super) fn best(&self) -> &[u32] {
        &self.best
    }

    /// Measures the face to the left of a walk, whose signed area is given; `None` if the area is 0
    /// up to rounding.
    pub(super) fn enclosing(&mut self, chains: &Chains, walk: &[u32], area: f64) -> Option<Areole> {
        self.best.clear();
        let mut best = 0.0;
        for &half in walk {
            self.at[chains.start(half) as usize] = self.stack.len() as u32;
            self.stack.push(half);
            let end = self.at[chains.start(half ^ 1) as usize];
            if end == u32::MAX {
                continue;
            }
            let cycle = &self.stack[end as usize..];
            for &half in cycle {
                self.at[chains.start(half) as usize] = u32::MAX;
            }
            if !(cycle.len() == 2 && cycle[0] ^ 1 == cycle[1]) {
                let size = if self.stack.len() == walk.len() {
                    area // Nothing hangs on this cycle.
                } else {
                    self.polygon.clear();
                    self.polygon
                        .extend(cycle.iter().flat_map(|&half| chains.corners(half)));
                    polygon::signed_area(&self.polygon)
                };
                if size > best {
                    best = size;
                    self.best.clear();
                    self.best.extend_from_slice(cycle);
                }
            }
            self.stack.truncate(end as usize);
        }
        if !(area > 0.0 && best > 0.0) {
            return None;
        }
        self.polygon.clear();
        let corners = self.best.iter().flat_map(|&half| chains.corners(half));
        self.polygon.extend(corners);
        let (elongation, centroid) = shape(&self.polygon);
        Some(Areole {
            area_mm2: area.min(best),
            outline_area_mm2: best,
            perimeter_mm: self
                .best
                .iter()
                .map(|&half| chains.lengths[(half / 2) as usize])
                .sum(),
            elongation,
            centroid,
        })
    }
}

/// Elongation and centre of mass of a polygon, by Green's theorem about its first corner.
fn shape(polygon: &[DVec2]) -> (f64, DVec2) {
    let origin = polygon[0];
    let (mut doubled, mut first) = (0.0, DVec2::ZERO);
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    let mut p = polygon[polygon.len() - 1] - origin;
    for &corner in polygon {
        let q = corner - origin;
        let cross = p.perp_dot(q);
        doubled += cross;
        first += cross * (p + q);
        xx += cross * (p.x * p.x + p.x * q.x + q.x * q.x);
        yy += cross * (p.y * p.y + p.y * q.y + q.y * q.y);
        xy += cross * (2.0 * (p.x * p.y + q.x * q.y) + p.x * q.y + q.x * p.y);
        p = q;
    }
    // Moments per area: ∫x² = Σ/12, ∫xy = Σ/24, ∫x = Σ/6, area = Σ/2.
    let centre = first / (3.0 * doubled);
    let xx = xx / (6.0 * doubled) - centre.x * centre.x;
    let yy = yy / (6.0 * doubled) - centre.y * centre.y;
    let xy = xy / (12.0 * doubled) - centre.x * centre.y;
    let mean = 0.5 * (xx + yy);
    let spread = (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
    let (most, least) = (mean + spread, mean - spread);
    let elongation = if most < MOST_ELONGATED * MOST_ELONGATED * least {
        (most / least).sqrt()
    } else {
        MOST_ELONGATED
    };
    (elongation, origin + centre)
}
