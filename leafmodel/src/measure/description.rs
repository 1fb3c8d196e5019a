//! A leaf described in the terms of the Manual of Leaf Architecture, from its grown network alone.
//!
//! Nothing here knows what was asked for: primaries, secondaries, tertiaries and quaternaries are
//! found by following veins of one order from where they leave a coarser one.
//!
//! - **In**: an [`Outline`], a [`VenationNetwork`].
//! - **Out**: a [`Description`], and its text.
//! - **Always true**: no number is NaN or infinite; what is not there is missing.
//! - **Left out**: veins of order 5 and finer one by one; of them only the net is described.
//!
//! # Source
//!
//! \[ellis2009\] for terms and classes; the limits between classes are ours where it gives none.

mod laterals;
mod marginal;
mod net;
mod percurrent;
mod rules;
mod text;
mod tracing;

use self::laterals::Ends;
pub use self::marginal::MarginalVenation;
pub use self::net::{Areolation, Net, Veinlets};
pub use self::percurrent::Percurrence;
use self::tracing::{Tracer, Vein};
use super::statistics::{mean, median, variation};
use crate::shape::outline::Outline;
use crate::venation::architecture::margin::Margin;
use crate::venation::architecture::{
    Agrophic, Attachment, PrimaryPattern, SecondaryEnding, SecondarySpacing,
};
use crate::venation::areole::areoles;
use crate::venation::network::{self, VenationNetwork};

/// A vein that strays less from its chord is straight, share of the chord.
const STRAIGHT: f64 = 0.05;

/// An intersecondary strays less from its chord, share of the chord.
const WINDING: f64 = 0.12;

/// A lateral primary is at least so long, share of the midrib.
const STUB: f64 = 0.12;

/// So many lateral primaries are many.
const MANY: usize = 6;

/// Ratio of spacings in the two halves of the midrib from which on they change.
const UNEVEN: f64 = 1.3;

/// What is found on a grown leaf.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Description {
    /// How the primaries run; none without veins.
    pub primaries: Option<PrimaryPattern>,
    /// Lateral primaries of both sides together.
    pub lateral_primaries: usize,
    /// Where the first of them parts from the midrib, share of its length.
    pub part_at: Option<f64>,
    /// Length of the midrib over its chord.
    pub midrib_over_chord: Option<f64>,
    /// Secondaries of the midrib on the right and on the left.
    pub secondaries: [usize; 2],
    /// Mean angle to the midrib in its lower, middle and upper third, degrees.
    pub angles_deg: [Option<f64>; 3],
    /// How most of them end.
    pub ending: Option<SecondaryEnding>,
    /// Share of the secondaries of all primaries that end in a tooth or lobe.
    pub in_teeth: Option<f64>,
    /// Whether most of them are straight.
    pub are_straight: Option<bool>,
    /// How they follow one another.
    pub spacing: Option<SecondarySpacing>,
    /// Coefficient of variation of the distances between neighbours.
    pub spacing_cv: Option<f64>,
    /// Shorter veins of order 3 that leave the midrib along them, for each space between two.
    pub intersecondaries: Option<f64>,
    /// How most of them leave the midrib.
    pub attachment: Option<Attachment>,
    /// Which secondaries or lateral primaries bear combs of veins on their outer side.
    pub agrophic: Agrophic,
    /// The tertiaries.
    pub tertiaries: Percurrence,
    /// The quaternaries that leave tertiaries.
    pub quaternaries: Percurrence,
    /// The net of fine veins.
    pub net: Net,
    /// Share of the margin beside which a vein of order 3 or coarser runs.
    pub accompanied_margin: f64,
    /// How veins end at the margin.
    pub marginal: Option<MarginalVenation>,
}

/// Describes a leaf.
pub fn describe(outline: &Outline, network: &VenationNetwork) -> Description {
    let edges = network::ends(network.edges());
    let tracer = Tracer::new(outline, network, &edges);
    let length = outline.length();
    let primaries = tracer.primaries();
    let margin = Margin::new(&outline.moved_and_scaled(outline.base(), 1.0));
    let mut description = Description::without_coarse_veins(outline, network, &margin);
    let Some((midrib, others)) = primaries.split_first() else {
        return description;
    };
    // Where primaries come together, ends of some are left over.
    let long: Vec<&Vein> = others
        .iter()
        .filter(|vein| vein.length() > STUB * midrib.length())
        .collect();
    let lateral_primaries = &long[..];
    description.midrib_over_chord = Some(midrib.length() / midrib.chord().max(1e-12));
    description.primaries = Some(pattern(lateral_primaries, midrib, outline));
    description.lateral_primaries = lateral_primaries.len();
    let starts = lateral_primaries.iter();
    let part = starts.map(|vein| midrib.share_near(vein.start()));
    description.part_at = part.reduce(f64::min);
    let ends = Ends::new(&margin, outline);
    let all: Vec<Vein> = primaries
        .iter()
        .flat_map(|primary| tracer.leaving(primary, 2))
        .collect();
    if !all.is_empty() {
        let count = all.iter().filter(|vein| ends.in_tooth(vein)).count();
        description.in_teeth = Some(count as f64 / all.len() as f64);
    }
    let secondaries = tracer.leaving(midrib, 2);
    description.secondaries(midrib, &secondaries, length);
    description.ending = laterals::ending(&secondaries, &tracer, &ends);
    let combs = laterals::combs(midrib, lateral_primaries, &secondaries, &tracer);
    description.agrophic = laterals::agrophic(combs);
    let coarse: Vec<&Vein> = primaries.iter().chain(&all).collect();
    let (tertiaries, found) = Percurrence::new(&coarse, 3, &tracer);
    let thirds: Vec<&Vein> = found.iter().collect();
    description.tertiaries = tertiaries;
    description.quaternaries = Percurrence::new(&thirds, 4, &tracer).0;
    let typical = mean(&secondaries.iter().map(Vein::length).collect::<Vec<f64>>());
    if let Some(typical) = typical
        && secondaries.len() > 2
    {
        // Veins of the net wind more.
        let shorter = |vein: &Vein| {
            !vein.is_joined && vein.length() > 0.22 * typical && vein.stray() < WINDING
        };
        let count = tracer
            .leaving(midrib, 3)
            .into_iter()
            .filter(shorter)
            .count();
        description.intersecondaries = Some(count as f64 / (secondaries.len() - 2) as f64);
    }
    description
}

/// How lateral primaries run.
fn pattern(laterals: &[&Vein], midrib: &Vein, outline: &Outline) -> PrimaryPattern {
    let length = outline.length();
    let most = |count: usize| 2 * count > laterals.len();
    let count = |holds: &dyn Fn(&Vein) -> bool| laterals.iter().filter(|v| holds(v)).count();
    if laterals.is_empty() {
        return PrimaryPattern::Pinnate;
    }
    if most(count(&|vein| {
        (vein.end() - outline.apex()).length() < 0.25 * length
    })) {
        let up = midrib.direction_at(0.5);
        if most(count(&|vein| vein.departure(0.06).dot(up) < 0.5)) {
            PrimaryPattern::Campylodromous
        } else if laterals.len() >= MANY {
            PrimaryPattern::Parallelodromous
        } else {
            PrimaryPattern::Acrodromous
        }
    } else {
        // Those that leave another lateral, away from the midrib.
        let leaves = |vein: &Vein| {
            let on_midrib = midrib.at(midrib.share_near(vein.start()));
            (vein.start() - on_midrib).length() > 0.02 * length
        };
        match count(&leaves) {
            0 => PrimaryPattern::Actinodromous,
            some if some >= MANY && most(some) => PrimaryPattern::Flabellate,
            _ => PrimaryPattern::Palinactinodromous,
        }
    }
}

impl Description {
    /// What the net and the margin alone tell.
    fn without_coarse_veins(outline: &Outline, network: &VenationNetwork, margin: &Margin) -> Self {
        let found = areoles(network);
        let accompanied_margin = marginal::accompanied(margin, outline, network);
        Self {
            net: Net::new(outline, &found),
            accompanied_margin,
            marginal: marginal::venation(accompanied_margin, outline, &found),
            ..Self::default()
        }
    }

    fn secondaries(&mut self, midrib: &Vein, secondaries: &[Vein], length: f64) {
        let mut angles: [Vec<f64>; 3] = Default::default();
        let mut places: [Vec<f64>; 2] = Default::default();
        for vein in secondaries {
            let share = midrib.share_near(vein.start());
            let ahead = midrib.direction_at(share);
            let side = usize::from(ahead.perp_dot(vein.at(0.2) - vein.start()) > 0.0);
            places[side].push(share);
            let (_, angle) = laterals::departure(midrib, vein, length);
            angles[((share * 3.0) as usize).min(2)].push(angle);
        }
        self.secondaries = [places[0].len(), places[1].len()];
        self.angles_deg = angles.map(|list| mean(&list));
        self.attachment = laterals::attachment(midrib, secondaries, length);
        let straight = secondaries.iter().filter(|vein| vein.stray() < STRAIGHT);
        self.are_straight =
            (!secondaries.is_empty()).then(|| 2 * straight.count() > secondaries.len());
        let mut gaps: Vec<(f64, f64)> = Vec::new();
        for side in &mut places {
            side.sort_by(f64::total_cmp);
            gaps.extend(side.windows(2).map(|p| (0.5 * (p[0] + p[1]), p[1] - p[0])));
        }
        let widths = |of: &dyn Fn(f64) -> bool| -> Option<f64> {
            let chosen: Vec<f64> = gaps
                .iter()
                .filter(|&&(at, _)| of(at))
                .map(|&(_, gap)| gap)
                .collect();
            mean(&chosen)
        };
        let mut middles: Vec<f64> = gaps.iter().map(|&(at, _)| at).collect();
        let Some(middle) = median(&mut middles) else {
            return;
        };
        let all: Vec<f64> = gaps.iter().map(|&(_, gap)| gap).collect();
        self.spacing_cv = variation(&all);
        if gaps.len() < 4 {
            return;
        }
        self.spacing = match (widths(&|at| at < middle), widths(&|at| at > middle)) {
            (Some(low), Some(high)) if low > UNEVEN * high => {
                Some(SecondarySpacing::IncreasingProximally)
            }
            (Some(low), Some(high)) if high > UNEVEN * low => {
                Some(SecondarySpacing::DecreasingProximally)
            }
            _ => Some(SecondarySpacing::Regular),
        };
    }
}
