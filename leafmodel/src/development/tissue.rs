//! How the blade grows: with the veins about it, or held back beside the vein that others spring
//! from.

use std::ops::Range;

use glam::DVec2;

use super::margin::Margin;
use super::skeleton::{Deformation, NO_NODE, Skeleton};
use crate::plane::bounds;
use crate::plane::segment::{cross, meeting};

/// How near to a vein, of the way there, growth can be held back.
const SHORT_OF_VEINS: f64 = 0.8;

/// Distances below this share of the leaf's length count alike where veins share the tissue out.
const SOFT: f64 = 1e-3;

/// Veins that add less than this share to the weight of others are left out.
const NEGLIGIBLE: f64 = 1e-4;

impl Margin {
    /// Moves every point with the tissue about it: as far as growth is free there with that of all
    /// veins, and as far as it is held back with the vein from which those beside it spring.
    pub(super) fn carry(&mut self, skeleton: &Skeleton, deformations: &[Deformation]) {
        let blade = Blade::new(skeleton, deformations);
        for interval in self.intervals(skeleton.veins[0].tip) {
            let [from, to] = interval.ends;
            let is_held = self.points[from..=to].iter().any(|p| p.restraint > 0.0);
            let tips = [from, to].map(|end| self.points[end].tip);
            let between = is_held.then(|| skeleton.between(tips));
            let anchor = between
                .as_ref()
                .map(|between| Anchor::new(&between.nodes, deformations));
            let order = blade.order(skeleton, tips);
            for point in &mut self.points[from + 1..to] {
                let free = blade.carried(point.place, 1.0 - point.restraint, &order);
                let (Some(anchor), Some(between)) = (&anchor, &between) else {
                    point.place = free;
                    continue;
                };
                let held = point.place + anchor.shift(point.share);
                let wanted = free.lerp(held, point.restraint);
                point.place = short_of(&between.ways, deformations, free, wanted);
            }
        }
        for point in &mut self.points {
            if point.tip != NO_NODE {
                point.place = deformations[point.tip as usize].to;
            }
        }
    }
}

/// All tissue, by the veins that it belongs to.
struct Blade<'a> {
    tissues: &'a [Deformation],
    veins: Vec<VeinTissue>,
    softening: f64,
}

/// The tissue about a vein.
struct VeinTissue {
    nodes: Range<usize>,
    /// Corners of the rectangle about its nodes.
    low: DVec2,
    high: DVec2,
    /// Length of the vein.
    weight: f64,
}

impl<'a> Blade<'a> {
    fn new(skeleton: &Skeleton, tissues: &'a [Deformation]) -> Self {
        let mut first = 0;
        let veins = skeleton.veins.iter().map(|vein| {
            let nodes = first..vein.tip as usize + 1;
            first = nodes.end;
            let own = &tissues[nodes.clone()];
            let (low, high) = bounds(own.iter().map(|tissue| tissue.from));
            VeinTissue {
                nodes,
                low,
                high,
                weight: own.iter().map(|tissue| tissue.weight).sum(),
            }
        });
        let soft = SOFT * skeleton.length();
        Self {
            tissues,
            veins: veins.collect(),
            softening: soft * soft,
        }
    }

    /// The veins in the order in which points between two tips, or one and the base, ask for them:
    /// those that weigh most first.
    fn order(&self, skeleton: &Skeleton, tips: [u32; 2]) -> Vec<usize> {
        let ends = tips.into_iter().filter(|&tip| tip != NO_NODE);
        let mut first: Vec<usize> = ends
            .map(|tip| skeleton.nodes[tip as usize].vein as usize)
            .collect();
        first.push(0);
        let rest: Vec<usize> = (0..self.veins.len())
            .filter(|v| !first.contains(v))
            .collect();
        first.extend(rest);
        first.dedup();
        first
    }

    /// Where a place goes with the tissue about it, of which the share `growing` grows.
    fn carried(&self, place: DVec2, growing: f64, order: &[usize]) -> DVec2 {
        let mut sum = DVec2::ZERO;
        let mut weights = 0.0;
        for &number in order {
            let vein = &self.veins[number];
            let outside = (vein.low - place).max(place - vein.high).max(DVec2::ZERO);
            let nearest = outside.length_squared() + self.softening;
            if vein.weight < NEGLIGIBLE * weights * nearest * nearest {
                continue;
            }
            for tissue in &self.tissues[vein.nodes.clone()] {
                let away = place - tissue.from;
                let squared = away.length_squared() + self.softening;
                let weight = tissue.weight / (squared * squared);
                let growth = tissue.growth * growing;
                let enlarged = away * (1.0 + growth + 0.5 * growth * growth);
                sum += (tissue.to + tissue.turn.rotate(enlarged)) * weight;
                weights += weight;
            }
        }
        sum / weights
    }
}

/// The way from `free` to `wanted` as far as no vein of `ways` crosses it: the blade is held back
/// short of its veins.
fn short_of(
    ways: &[Vec<u32>; 2],
    deformations: &[Deformation],
    free: DVec2,
    wanted: DVec2,
) -> DVec2 {
    let mut share = 1.0_f64;
    let way = wanted - free;
    for piece in ways.iter().flat_map(|way| way.windows(2)) {
        let [c, d] = [piece[0], piece[1]].map(|node| deformations[node as usize].to);
        if cross(free, wanted, c, d) {
            share = share.min(meeting(free, way, c, d).0 * SHORT_OF_VEINS);
        }
    }
    free + way * share.max(0.0)
}

/// The part of a vein from which the veins at both ends of an interval spring.
struct Anchor {
    /// How far each node moves.
    shifts: Vec<DVec2>,
    /// Length of the vein up to each node.
    lengths: Vec<f64>,
}

impl Anchor {
    fn new(nodes: &[u32], deformations: &[Deformation]) -> Self {
        let tissues = nodes.iter().map(|&node| &deformations[node as usize]);
        let mut lengths = vec![0.0];
        for pair in nodes.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|node| deformations[node as usize].from);
            lengths.push(lengths[lengths.len() - 1] + (b - a).length());
        }
        Self {
            shifts: tissues.map(|tissue| tissue.to - tissue.from).collect(),
            lengths,
        }
    }

    /// How far it moves at a share of its length.
    fn shift(&self, share: f64) -> DVec2 {
        let last = self.lengths.len() - 1;
        let at = share * self.lengths[last];
        let next = self
            .lengths
            .partition_point(|&l| l <= at)
            .clamp(1, last.max(1))
            .min(last);
        if next == 0 {
            return self.shifts[0];
        }
        let [low, high] = [self.lengths[next - 1], self.lengths[next]];
        let part = if high > low {
            (at - low) / (high - low)
        } else {
            0.5
        };
        self.shifts[next - 1].lerp(self.shifts[next], part)
    }
}
