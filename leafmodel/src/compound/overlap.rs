//! Tests for overlapping leaflets.

use glam::DVec2;

use super::arranged::{CompoundError, CompoundLeaf, StalkKind};
use crate::shape::outline::Outline;

/// How far a leaflet may overlap an axis, in lengths of the leaflet: a tolerance for rounding at a
/// base on the axis.
const TOUCH: f64 = 1e-6;

/// Leaflets that overlap each other or lie over an axis, as errors; at most as many as `most`.
pub(super) fn find(leaf: &CompoundLeaf, outlines: &[Outline], most: usize) -> Vec<CompoundError> {
    let mut found = Vec::new();
    let of = |leaflet: usize| &outlines[leaf.leaflets[leaflet].variant as usize % outlines.len()];
    let placed: Vec<(Vec<DVec2>, DVec2, DVec2)> = leaf
        .leaflets
        .iter()
        .enumerate()
        .map(|(number, leaflet)| {
            let outline = of(number);
            let base = outline.base();
            let points: Vec<DVec2> = outline
                .points()
                .iter()
                .map(|&p| leaflet.place(p - base))
                .collect();
            let low = points.iter().fold(DVec2::INFINITY, |low, &p| low.min(p));
            let high = points
                .iter()
                .fold(DVec2::NEG_INFINITY, |high, &p| high.max(p));
            (points, low, high)
        })
        .collect();
    // Points are tested in the leaflet's own frame, where its margin is indexed.
    let back = |number: usize, p: DVec2| {
        let leaflet = &leaf.leaflets[number];
        let axis = super::direction(leaflet.angle);
        let p = (p - leaflet.base) / leaflet.scale;
        let x = p.dot(-axis.perp());
        of(number).base() + DVec2::new(if leaflet.mirrored { -x } else { x }, p.dot(axis))
    };
    for (second, (points, low, high)) in placed.iter().enumerate() {
        for (first, (_, other_low, other_high)) in placed[..second].iter().enumerate() {
            if low.cmpgt(*other_high).any() || other_low.cmpgt(*high).any() {
                continue;
            }
            let own: Vec<DVec2> = points.iter().map(|&p| back(first, p)).collect();
            let n = own.len();
            let outline = of(first);
            let crosses = (0..n).any(|i| outline.is_crossed_by(own[i], own[(i + 1) % n]));
            // Margins that do not cross may still be one inside the other: then all corners of the
            // inner are in the outer.
            let around = || {
                let other = back(
                    second,
                    leaf.leaflets[first].place(outline.points()[0] - outline.base()),
                );
                of(second).contains(other)
            };
            if crosses || outline.contains(own[0]) || around() {
                found.push(CompoundError::Overlap { first, second });
                if found.len() >= most {
                    return found;
                }
            }
        }
    }
    let axes = leaf
        .stalks
        .iter()
        .filter(|stalk| stalk.kind != StalkKind::Petiolule);
    for stalk in axes {
        for piece in stalk.points.windows(2) {
            let (from, to) = (piece[0].min(piece[1]), piece[0].max(piece[1]));
            for (leaflet, (_, low, high)) in placed.iter().enumerate() {
                if from.cmpgt(*high).any() || low.cmpgt(to).any() {
                    continue;
                }
                // The end of a stalk may touch a base that sits on it, so touches at the ends of
                // pieces are ignored.
                let [a, b] = [piece[0], piece[1]].map(|p| back(leaflet, p));
                let outline = of(leaflet);
                let touch = (TOUCH * outline.length() / a.distance(b)).min(0.5);
                let (from, to) = (a.lerp(b, touch), b.lerp(a, touch));
                let inside = |p: DVec2| {
                    outline.contains(p) && outline.distance_to_margin(p) > TOUCH * outline.length()
                };
                if outline.is_crossed_by(from, to) || inside(from) || inside(to) {
                    found.push(CompoundError::OnStalk { leaflet });
                    if found.len() >= most {
                        return found;
                    }
                }
            }
        }
    }
    found
}
