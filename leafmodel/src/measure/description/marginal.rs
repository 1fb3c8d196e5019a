//! Veins at the margin: one that runs all along it, or how the finest ones end there.

use glam::DVec2;

use super::rules::AT_MARGIN;
use crate::plane::segment;
use crate::shape::outline::Outline;
use crate::venation::architecture::margin::Margin;
use crate::venation::areole::{Areoles, OUTSIDE};
use crate::venation::network::VenationNetwork;

/// Places of the margin that are looked at.
const PLACES: u32 = 400;

/// A fimbrial vein is nearer to the margin than this, share of the leaf's length.
const BESIDE: f64 = 0.012;

/// It is of this order or a coarser one.
const FINEST: u8 = 3;

/// Cosine of the greatest angle between it and the margin: 30°.
const ALONG: f64 = 0.866;

/// It runs beside at least this share of the margin.
const WHOLE: f64 = 0.75;

/// Free ends at the margin for each outermost areole from which on loops are incomplete: more
/// veins end there than turn back.
const OPEN: f64 = 1.0;

/// How veins end at the margin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarginalVenation {
    /// In a vein that runs all along it.
    Fimbrial,
    /// In loops.
    Looped,
    /// Many of them freely.
    Incomplete,
}

/// Share of the margin beside which a coarse vein runs.
pub(super) fn accompanied(margin: &Margin, outline: &Outline, network: &VenationNetwork) -> f64 {
    let place = |node: u32| network.nodes()[node as usize].position - outline.base();
    let pieces: Vec<(DVec2, DVec2)> = network
        .edges()
        .iter()
        .filter(|edge| edge.order <= FINEST)
        .map(|edge| (place(edge.from), place(edge.to)))
        .filter(|(from, to)| from != to)
        .collect();
    let reach = BESIDE * outline.length();
    let is_accompanied = |k: &u32| {
        let at = (f64::from(*k) + 0.5) / f64::from(PLACES);
        let (here, ahead) = (margin.at(at), margin.direction(at));
        pieces.iter().any(|&(from, to)| {
            let way = to - from;
            segment::distance_squared(from, to, here) < reach * reach
                && way.dot(ahead).abs() > ALONG * way.length()
        })
    };
    f64::from((0..PLACES).filter(is_accompanied).count() as u32) / f64::from(PLACES)
}

/// How veins end at a margin of which this share has a vein beside it.
pub(super) fn venation(
    accompanied: f64,
    outline: &Outline,
    found: &Areoles,
) -> Option<MarginalVenation> {
    if accompanied >= WHOLE {
        return Some(MarginalVenation::Fimbrial);
    }
    let near = AT_MARGIN * outline.length();
    let at_margin = |tip: DVec2| outline.distance_to_margin(tip) < near;
    let free = found
        .free_endings()
        .filter(|end| end.areole.is_none() && at_margin(end.tip))
        .count();
    let mut outermost: Vec<u32> = (0..found.chains().len() as u32)
        .filter_map(|chain| match found.beside(chain) {
            [OUTSIDE, areole] | [areole, OUTSIDE] if areole != OUTSIDE => Some(areole),
            _ => None,
        })
        .collect();
    outermost.sort_unstable();
    outermost.dedup();
    if free == 0 && outermost.is_empty() {
        return None;
    }
    Some(if free as f64 >= OPEN * outermost.len() as f64 {
        MarginalVenation::Incomplete
    } else {
        MarginalVenation::Looped
    })
}
