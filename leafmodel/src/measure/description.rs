//! A leaf described in the terms of the Manual of Leaf Architecture, from its grown network alone.
//!
//! Nothing here knows what was asked for: primaries, secondaries and tertiaries are found by
//! following veins of one order from where they leave a coarser one.
//!
//! - **In**: an [`Outline`], a [`VenationNetwork`].
//! - **Out**: a [`Description`], and its text.
//! - **Always true**: no number is NaN or infinite; what is not there is missing.
//! - **Left out**: veins of higher order one by one; of them only the net is described.
//!
//! # Source
//!
//! \[ellis2009\] for terms and classes; the limits between classes are ours where it gives none.

mod text;
mod tracing;

use glam::DVec2;

use self::tracing::{Tracer, Vein};
use super::statistics::{mean, median, variation};
use crate::shape::outline::Outline;
use crate::venation::architecture::margin::Margin;
use crate::venation::architecture::{PrimaryPattern, SecondaryEnding, SecondarySpacing};
use crate::venation::areole::areoles;
use crate::venation::network::VenationNetwork;

/// A vein that ends so near to the margin ends there, share of the leaf's length.
const AT_MARGIN: f64 = 0.025;

/// A vein that ends so near to the tip of a tooth or lobe ends in it, likewise.
const IN_TOOTH: f64 = 0.014;

/// Share of a vein's length over which its departure is taken.
const DEPARTURE: f64 = 0.12;

/// A vein that strays less from its chord is straight, share of the chord.
const STRAIGHT: f64 = 0.05;

/// An intersecondary strays less from its chord, share of the chord.
const WINDING: f64 = 0.12;

/// A lateral primary is at least so long, share of the midrib.
const STUB: f64 = 0.12;

/// A vein so much longer than its chord goes round.
const ROUND: f64 = 1.25;

/// So many lateral primaries are many.
const MANY: usize = 6;

/// Ratio of spacings in the two halves of the midrib from which on they change.
const UNEVEN: f64 = 1.3;

/// What is found on a grown leaf.
#[derive(Clone, Debug, PartialEq)]
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
    /// Share of the tertiaries that cross from one coarser vein to another.
    pub percurrent: Option<f64>,
    /// Median angle of those to the vein that they leave, degrees.
    pub tertiary_angle_deg: Option<f64>,
    /// Median of their length over their chord.
    pub tertiary_over_chord: Option<f64>,
    /// Areoles per mm².
    pub areoles_per_mm2: f64,
    /// Median of longer over shorter axis of areoles.
    pub areole_elongation: Option<f64>,
    /// Freely ending veinlets per areole.
    pub veinlets_per_areole: Option<f64>,
    /// Share of the freely ending veins that end at the margin.
    pub free_at_margin: Option<f64>,
}

/// Describes a leaf.
pub fn describe(outline: &Outline, network: &VenationNetwork) -> Description {
    let tracer = Tracer::new(outline, network);
    let length = outline.length();
    let primaries = tracer.primaries();
    let mut description = Description::of_net(outline, network);
    let Some((midrib, laterals)) = primaries.split_first() else {
        return description;
    };
    // Where primaries come together, ends of some are left over.
    let laterals: Vec<&Vein> = laterals
        .iter()
        .filter(|vein| vein.length() > STUB * midrib.length())
        .collect();
    let laterals = &laterals[..];
    description.midrib_over_chord = Some(midrib.length() / midrib.chord().max(1e-12));
    description.primaries = Some(pattern(laterals, midrib, outline));
    description.lateral_primaries = laterals.len();
    let part = laterals.iter().map(|vein| midrib.share_near(vein.start()));
    description.part_at = part.reduce(f64::min);
    let margin = Margin::new(&outline.moved_and_scaled(outline.base(), 1.0));
    let teeth: Vec<DVec2> = margin
        .tips()
        .iter()
        .map(|tip| tip.place + outline.base())
        .collect();
    let in_tooth = |vein: &Vein| {
        let near = |tip: &DVec2| (*tip - vein.end()).length() < IN_TOOTH * length;
        outline.distance_to_margin(vein.end()) < AT_MARGIN * length && teeth.iter().any(near)
    };
    let all: Vec<Vein> = primaries
        .iter()
        .flat_map(|primary| tracer.leaving(primary, 2))
        .collect();
    if !all.is_empty() {
        let count = all.iter().filter(|vein| in_tooth(vein)).count();
        description.in_teeth = Some(count as f64 / all.len() as f64);
    }
    let secondaries = tracer.leaving(midrib, 2);
    description.secondaries(midrib, &secondaries);
    description.ending = ending(&secondaries, &tracer, in_tooth);
    let coarse: Vec<&Vein> = primaries.iter().chain(&all).collect();
    description.tertiaries(&coarse, &tracer);
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

/// How most secondaries end.
fn ending(
    secondaries: &[Vein],
    tracer: &Tracer<'_>,
    in_tooth: impl Fn(&Vein) -> bool,
) -> Option<SecondaryEnding> {
    if secondaries.is_empty() {
        return None;
    }
    let most = |count: usize| 2 * count > secondaries.len();
    if most(secondaries.iter().filter(|vein| in_tooth(vein)).count()) {
        return Some(SecondaryEnding::Craspedodromous);
    }
    let joined: Vec<&Vein> = secondaries.iter().filter(|vein| vein.is_joined).collect();
    if !most(joined.len()) {
        return Some(SecondaryEnding::Eucamptodromous);
    }
    let branches = |vein: &&&Vein| tracer.leaving(vein, 3).iter().any(&in_tooth);
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

impl Description {
    /// What the net alone tells.
    fn of_net(outline: &Outline, network: &VenationNetwork) -> Self {
        let found = areoles(network);
        let mut long: Vec<f64> = found.iter().map(|areole| areole.elongation).collect();
        let free: Vec<_> = found.free_endings().collect();
        let near = AT_MARGIN * outline.length();
        let at_margin = free
            .iter()
            .filter(|end| outline.distance_to_margin(end.tip) < near)
            .count();
        let inside = free.iter().filter(|end| end.areole.is_some()).count();
        let share = |count: usize, of: usize| (of > 0).then(|| count as f64 / of as f64);
        Self {
            primaries: None,
            lateral_primaries: 0,
            part_at: None,
            midrib_over_chord: None,
            secondaries: [0, 0],
            angles_deg: [None; 3],
            ending: None,
            in_teeth: None,
            are_straight: None,
            spacing: None,
            spacing_cv: None,
            intersecondaries: None,
            percurrent: None,
            tertiary_angle_deg: None,
            tertiary_over_chord: None,
            areoles_per_mm2: found.len() as f64 / outline.area(),
            areole_elongation: median(&mut long),
            veinlets_per_areole: share(inside, found.len()),
            free_at_margin: share(at_margin, free.len()),
        }
    }

    fn secondaries(&mut self, midrib: &Vein, secondaries: &[Vein]) {
        let mut angles: [Vec<f64>; 3] = Default::default();
        let mut places: [Vec<f64>; 2] = Default::default();
        for vein in secondaries {
            let share = midrib.share_near(vein.start());
            let ahead = midrib.direction_at(share);
            let way = vein.departure(DEPARTURE);
            let side = usize::from(ahead.perp_dot(way) > 0.0);
            places[side].push(share);
            let angle = libm::atan2(ahead.perp_dot(way).abs(), ahead.dot(way)).to_degrees();
            angles[((share * 3.0) as usize).min(2)].push(angle);
        }
        self.secondaries = [places[0].len(), places[1].len()];
        self.angles_deg = angles.map(|list| mean(&list));
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

    fn tertiaries(&mut self, coarse: &[&Vein], tracer: &Tracer<'_>) {
        let (mut across, mut count) = (0, 0);
        let (mut angles, mut winding) = (Vec::new(), Vec::new());
        for vein in coarse {
            for tertiary in tracer.leaving(vein, 3) {
                count += 1;
                // A loop outside an arch comes back to it.
                let is_loop = tertiary.length() > ROUND * tertiary.chord();
                let reaches = tertiary.joined_order.is_some_and(|order| order <= 2) && !is_loop;
                if !reaches {
                    continue;
                }
                across += 1;
                let ahead = vein.direction_at(vein.share_near(tertiary.start()));
                let way = tertiary.departure(0.6);
                angles.push(libm::atan2(ahead.perp_dot(way).abs(), ahead.dot(way)).to_degrees());
                winding.push(tertiary.length() / tertiary.chord().max(1e-12));
            }
        }
        self.percurrent = (count > 0).then(|| f64::from(across) / f64::from(count));
        self.tertiary_angle_deg = median(&mut angles);
        self.tertiary_over_chord = median(&mut winding);
    }
}
