//! Secondaries one by one: how they leave the primary, where they end, and which bear combs.

use glam::DVec2;

use super::rules::{AT_MARGIN, IN_TOOTH, ROUND};
use super::tracing::{Tracer, Vein};
use crate::shape::outline::Outline;
use crate::venation::architecture::margin::Margin;
use crate::venation::architecture::{Agrophic, Attachment, SecondaryEnding};

/// Share of a vein's length over which its departure is taken.
const DEPARTURE: f64 = 0.12;

/// Where a vein has left the primary behind, shares of its length.
const AWAY: [f64; 2] = [0.16, 0.4];

/// A vein that leaves at less than this share of the angle at which it goes on is decurrent.
const DECURRENT: f64 = 0.62;

/// The first stretch of a vein is at most so long, share of the leaf's length.
const FIRST: f64 = 0.03;

/// A comb has at least so many veins.
const COMB: usize = 2;

/// Where a leaf's veins may end.
pub(super) struct Ends<'o> {
    outline: &'o Outline,
    tips: Vec<DVec2>,
    sinuses: Vec<DVec2>,
}

impl<'o> Ends<'o> {
    pub(super) fn new(margin: &Margin, outline: &'o Outline) -> Self {
        let places = |list: &[crate::venation::architecture::margin::Tip]| {
            list.iter().map(|tip| tip.place + outline.base()).collect()
        };
        Self {
            outline,
            tips: places(margin.tips()),
            sinuses: places(&margin.sinuses()),
        }
    }

    fn is_near(&self, end: DVec2, places: &[DVec2]) -> bool {
        let length = self.outline.length();
        let near = |place: &DVec2| (*place - end).length() < IN_TOOTH * length;
        self.outline.distance_to_margin(end) < AT_MARGIN * length && places.iter().any(near)
    }

    pub(super) fn in_tooth(&self, vein: &Vein) -> bool {
        self.is_near(vein.end(), &self.tips)
    }

    pub(super) fn in_sinus(&self, vein: &Vein) -> bool {
        self.is_near(vein.end(), &self.sinuses)
    }
}

/// How most secondaries end.
pub(super) fn ending(
    secondaries: &[Vein],
    tracer: &Tracer<'_>,
    ends: &Ends<'_>,
) -> Option<SecondaryEnding> {
    if secondaries.is_empty() {
        return None;
    }
    let most = |count: usize| 2 * count > secondaries.len();
    let count = |holds: &dyn Fn(&Vein) -> bool| secondaries.iter().filter(|v| holds(v)).count();
    if most(count(&|vein| ends.in_tooth(vein))) {
        return Some(SecondaryEnding::Craspedodromous);
    }
    if most(count(&|vein| ends.in_sinus(vein))) {
        return Some(SecondaryEnding::Sinus);
    }
    let joined: Vec<&Vein> = secondaries.iter().filter(|vein| vein.is_joined).collect();
    if !most(joined.len()) {
        return Some(SecondaryEnding::Eucamptodromous);
    }
    let branches = |vein: &&&Vein| tracer.leaving(vein, 3).iter().any(|v| ends.in_tooth(v));
    if 2 * joined.iter().filter(branches).count() > joined.len() {
        return Some(SecondaryEnding::Semicraspedodromous);
    }
    // Loops leave an arch and come back to a vein of its order, on a long way round.
    let is_loop =
        |vein: &Vein| vein.joined_order == Some(2) && vein.length() > ROUND * vein.chord();
    let loops = |vein: &&&Vein| tracer.leaving(vein, 3).iter().any(is_loop);
    if 2 * joined.iter().filter(loops).count() > joined.len() {
        Some(SecondaryEnding::Festooned)
    } else {
        Some(SecondaryEnding::Brochidodromous)
    }
}

/// How a secondary leaves the midrib, and its angle to it once it has, degrees.
pub(super) fn departure(midrib: &Vein, vein: &Vein, length: f64) -> (Attachment, f64) {
    let ahead = midrib.direction_at(midrib.share_near(vein.start()));
    let angle = |way: DVec2| libm::atan2(ahead.perp_dot(way).abs(), ahead.dot(way));
    let first = DEPARTURE.min(FIRST * length / vein.length().max(1e-12));
    let onward = angle(vein.at(AWAY[1]) - vein.at(AWAY[0]));
    if angle(vein.departure(first)) < DECURRENT * onward {
        let beyond = angle(vein.at(AWAY[0] + DEPARTURE) - vein.at(AWAY[0]));
        (Attachment::Decurrent, beyond.to_degrees())
    } else {
        (
            Attachment::Excurrent,
            angle(vein.departure(DEPARTURE)).to_degrees(),
        )
    }
}

/// How most secondaries leave the midrib.
pub(super) fn attachment(midrib: &Vein, secondaries: &[Vein], length: f64) -> Option<Attachment> {
    let is_decurrent = |vein: &&Vein| departure(midrib, vein, length).0 == Attachment::Decurrent;
    let count = secondaries.iter().filter(is_decurrent).count();
    (!secondaries.is_empty()).then_some(if 2 * count > secondaries.len() {
        Attachment::Decurrent
    } else {
        Attachment::Excurrent
    })
}

/// Combs on the outer sides of lateral primaries and of the midrib's secondaries, over both sides
/// of the leaf.
pub(super) fn combs(
    midrib: &Vein,
    laterals: &[&Vein],
    secondaries: &[Vein],
    tracer: &Tracer<'_>,
) -> usize {
    let bearers = laterals.iter().copied().chain(secondaries);
    let is_comb = |bearer: &&Vein| {
        let up = midrib.direction_at(midrib.share_near(bearer.start()));
        let side = up.perp_dot(bearer.at(0.5) - bearer.start());
        let is_outside = |vein: &Vein| {
            let ahead = bearer.direction_at(bearer.share_near(vein.start()));
            ahead.perp_dot(vein.departure(DEPARTURE)) * side > 0.0
        };
        let outside = tracer.leaving(bearer, 2);
        outside.iter().filter(|vein| is_outside(vein)).count() >= COMB
    };
    bearers.filter(is_comb).count()
}

/// Agrophic veins by the number of combs of both sides.
pub(super) fn agrophic(combs: usize) -> Agrophic {
    match combs {
        0 => Agrophic::Absent,
        1 | 2 => Agrophic::Simple,
        _ => Agrophic::Compound,
    }
}
