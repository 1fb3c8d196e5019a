//! The outline of a developing leaf at its size in millimetres.

use glam::DVec2;

use super::check::{bent, no_margin};
use super::skeleton::NO_NODE;
use super::steps::Developing;
use crate::not_grown::NotGrown;
use crate::shape::outer_boundary::union_boundary;
use crate::shape::outline::{Outline, OutlineError};

/// Least width of blade beside a main vein, over the leaf's length: nowhere does a vein lie bare.
const LEAST_BLADE: f64 = 0.002;

/// Pieces of the margin longer than this, over the leaf's length, are divided once more.
const SMOOTH: f64 = 0.004;

impl Developing {
    /// The margin, its midrib from the origin to (0, `length_mm`). Where lobes overlap, it is the
    /// outer boundary of both.
    pub(super) fn outline(&self, length_mm: f64) -> Result<Outline, NotGrown> {
        let scale = length_mm / self.skeleton.length();
        let apex = DVec2::new(0.0, length_mm);
        let margin: Vec<DVec2> = self.smooth(SMOOTH * self.skeleton.length());
        let margin: Vec<DVec2> = margin.into_iter().map(|p| p * scale).collect();
        let plain = Outline::new(margin.clone(), DVec2::ZERO, apex);
        let lie_on = |outline: &Outline| {
            let places = self.skeleton.nodes.iter().map(|node| node.place * scale);
            let mut places = places;
            places.all(|p| outline.covers(p))
        };
        match plain {
            Ok(outline) if lie_on(&outline) => return Ok(outline),
            Ok(_) | Err(OutlineError::SelfCrossing { .. }) => {}
            Err(error) => return Err(no_margin(error)),
        }
        let strips = self.strips(scale, LEAST_BLADE * length_mm);
        let mut parts: Vec<&[DVec2]> = vec![&margin];
        parts.extend(strips.iter().map(Vec::as_slice));
        let joined = union_boundary(&parts);
        let joined = Outline::new(joined, DVec2::ZERO, apex).map_err(no_margin)?;
        if lie_on(&joined) {
            Ok(joined)
        } else {
            Err(bent(NotGrown::because(
                "a vein of the leaf leaves its blade",
            )))
        }
    }

    /// The margin without its second end, with points between those that lie far apart.
    fn smooth(&self, longest: f64) -> Vec<DVec2> {
        let points = &self.margin.points;
        let last = points.len() - 1;
        let is_plain = |i: usize| i > 0 && i < last && points[i].tip == NO_NODE;
        let mut smooth = Vec::with_capacity(2 * points.len());
        for i in 0..last {
            let [a, b] = [points[i].place, points[i + 1].place];
            smooth.push(a);
            if is_plain(i) && is_plain(i + 1) && (b - a).length() > longest {
                let straight = (a + b) * 0.5;
                let around = (points[i - 1].place + points[i + 2].place) * 0.5;
                smooth.push(straight + (straight - around) * 0.125);
            }
        }
        smooth
    }

    /// A narrow blade about each vein.
    fn strips(&self, scale: f64, half_width: f64) -> Vec<Vec<DVec2>> {
        let skeleton = &self.skeleton;
        let strip = |vein: &super::skeleton::Vein| {
            let mut way = vec![vein.tip];
            while let Some(&node) = way.last() {
                let before = skeleton.nodes[node as usize].before;
                if node == vein.origin || before == NO_NODE {
                    break;
                }
                way.push(before);
            }
            let places: Vec<DVec2> = way
                .iter()
                .map(|&node| skeleton.nodes[node as usize].place * scale)
                .collect();
            let aside = |i: usize| {
                let along = places[i.saturating_sub(1)] - places[(i + 1).min(places.len() - 1)];
                along.normalize_or(DVec2::Y).perp() * half_width
            };
            let inner = 1..places.len();
            let left = inner.clone().map(|i| places[i] + aside(i));
            let right = inner.rev().map(|i| places[i] - aside(i));
            // Pointed at the tip.
            let mut ring = vec![places[0]];
            ring.extend(left);
            ring.extend(right);
            ring
        };
        skeleton.veins.iter().map(strip).collect()
    }
}
