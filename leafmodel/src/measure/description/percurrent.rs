//! Tertiaries and quaternaries: whether they cross from one coarser vein to the next, and how.

use super::rules::ROUND;
use super::tracing::{Tracer, Vein};
use crate::measure::statistics::median;
use crate::venation::architecture::QuaternaryCourse;

/// A chevron strays at least so far from its chord, share of the chord.
const BENT: f64 = 0.09;

/// Where on the chord its bend lies.
const MIDWAY: [f64; 2] = [0.28, 0.72];

/// Its limbs stray less from their own chords, share of how far its bend strays: an arc's stray by
/// a quarter.
const LIMB: f64 = 0.22;

/// Alternate percurrent veins are offset by this or more, in the median, share of the chord.
const OFFSET: f64 = 0.07;

/// Freely ramified veins end freely in at least this share; of those that chance lays out half do,
/// before finer ones go on.
const RAMIFIED: f64 = 0.75;

/// Parts of the chord whose distance across it is the offset.
const LIMBS: [[f64; 2]; 2] = [[0.1, 0.42], [0.58, 0.9]];

/// What veins of one order between coarser ones are like.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Percurrence {
    /// Share of those that leave coarser veins that cross to another.
    pub across: Option<f64>,
    /// Share of them that end freely.
    pub free: Option<f64>,
    /// Median angle of those that cross to the vein that they leave, degrees.
    pub angle_deg: Option<f64>,
    /// Median of their length over their chord.
    pub length_over_chord: Option<f64>,
    /// Median of their offset midway, share of the chord.
    pub offset: Option<f64>,
    /// Share of them with one sharp bend midway.
    pub chevrons: Option<f64>,
}

impl Percurrence {
    /// The veins of an order that leave `coarse` ones.
    pub(super) fn new(coarse: &[&Vein], order: u8, tracer: &Tracer<'_>) -> (Self, Vec<Vein>) {
        let (mut angles, mut winding, mut offsets) = (Vec::new(), Vec::new(), Vec::new());
        let (mut chevrons, mut free) = (0_u32, 0_u32);
        let mut all = Vec::new();
        for vein in coarse {
            for found in tracer.leaving(vein, order) {
                free += u32::from(!found.is_joined);
                // A loop outside an arch comes back to it.
                let is_loop = found.length() > ROUND * found.chord();
                let reaches = found.joined_order.is_some_and(|to| to < order) && !is_loop;
                if reaches {
                    let ahead = vein.direction_at(vein.share_near(found.start()));
                    let way = found.departure(0.6);
                    angles
                        .push(libm::atan2(ahead.perp_dot(way).abs(), ahead.dot(way)).to_degrees());
                    winding.push(found.length() / found.chord().max(1e-12));
                    offsets.push(offset(&found));
                    chevrons += u32::from(is_chevron(&found));
                }
                all.push(found);
            }
        }
        let share = |count: f64, of: usize| (of > 0).then(|| count / of as f64);
        let found = Self {
            across: share(angles.len() as f64, all.len()),
            free: share(f64::from(free), all.len()),
            chevrons: share(f64::from(chevrons), angles.len()),
            angle_deg: median(&mut angles),
            length_over_chord: median(&mut winding),
            offset: median(&mut offsets),
        };
        (found, all)
    }

    /// Whether most cross.
    pub(crate) fn is_percurrent(&self) -> Option<bool> {
        self.across.map(|share| share > 0.5)
    }

    /// Whether most of those that cross have a sharp bend.
    pub(crate) fn are_chevrons(&self) -> bool {
        self.chevrons.is_some_and(|share| share > 0.5)
    }

    /// As quaternaries.
    pub(crate) fn quaternary_course(&self) -> Option<QuaternaryCourse> {
        Some(if self.across? > 0.5 {
            if self.offset.is_some_and(|offset| offset < OFFSET) {
                QuaternaryCourse::OppositePercurrent
            } else {
                QuaternaryCourse::AlternatePercurrent
            }
        } else if self.free? > RAMIFIED {
            QuaternaryCourse::FreelyRamified
        } else {
            QuaternaryCourse::Reticulate
        })
    }
}

/// How far the second limb of a vein lies beside the first, share of the chord.
fn offset(vein: &Vein) -> f64 {
    let chord = vein.end() - vein.start();
    let way = chord.normalize_or_zero();
    let [first, second] = LIMBS.map(|[from, to]| {
        let at = |k: u32| vein.at(from + (to - from) * f64::from(k) / 8.0);
        let across = (0..=8).map(|k| way.perp_dot(at(k) - vein.start()));
        across.sum::<f64>() / 9.0
    });
    (first - second).abs() / chord.length().max(1e-12)
}

/// Whether a vein has one sharp bend midway and straight limbs.
fn is_chevron(vein: &Vein) -> bool {
    let chord = vein.end() - vein.start();
    let (length, way) = (chord.length(), chord.normalize_or_zero());
    let Some((bend, away)) = vein.farthest(vein.start(), vein.end(), 0.0..1.0) else {
        return false;
    };
    let on_chord = (bend - vein.start()).dot(way) / length.max(1e-12);
    let at = vein.share_near(bend);
    let limb = |from, to, range| vein.farthest(from, to, range).map_or(0.0, |(_, away)| away);
    away > BENT * length
        && (MIDWAY[0]..MIDWAY[1]).contains(&on_chord)
        && limb(vein.start(), bend, 0.0..at) < LIMB * away
        && limb(bend, vein.end(), at..1.0) < LIMB * away
}
