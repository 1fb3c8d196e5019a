//! Percurrent veins: across from each secondary to the next, and finer ones across from tertiary to
//! tertiary.

use glam::DVec2;

use super::course::{Course, cross};
use super::ground::Ground;
use super::{Architecture, Lots, Tertiaries, TertiaryCourse};
use crate::plane::polyline;

/// Tertiaries reach at most so far, share of the leaf's length.
const LONGEST: f64 = 0.25;

/// How much farther apart than others the tertiaries below the lowest secondaries are.
const OUTER: f64 = 1.6;

/// Their angle to the secondary, degrees.
const OUTER_DEG: f64 = 65.0;

/// How far from the margin they end, share of the leaf's length.
const MARGIN: f64 = 0.015;

/// How far the bend of a chevron lies off the straight way, share of that.
const CHEVRON: f64 = 0.18;

/// Share of the spacing by which a fully irregular place is moved.
const PLACE_JITTER: f64 = 0.6;

/// Degrees by which a fully irregular angle is turned.
const TURN_DEG: f64 = 9.0;

/// Half the offset of alternate tertiaries, share of the spacing.
const JOG: f64 = 0.13;

/// The same of finer veins, share of their length.
const JOG_OF_FINER: f64 = 0.08;

/// A vein of order 1 or 2 as it has grown.
#[derive(Clone, Debug)]
pub(crate) struct Grown {
    /// Its nodes, from its start on another vein.
    pub(crate) nodes: Vec<DVec2>,
    /// On which side of its parent it lies: 1 the right, −1 the left, 0 for the midrib.
    pub(crate) side: f64,
    /// Share of its length that sends tertiaries to the next vein.
    pub(crate) fertile: f64,
    /// Whether it is the lowest of its side, which sends tertiaries to the margin below as well.
    pub(crate) is_lowest: bool,
}

/// Veins that cross from one to the next of a row.
#[derive(Clone, Copy)]
pub(super) struct Ladder {
    /// How they run, how far apart and at which angle.
    pub(super) plan: Tertiaries,
    /// Their order.
    pub(super) order: u8,
}

/// A vein of a ladder.
pub(crate) struct Rung {
    /// Its course.
    pub(crate) course: Course,
    /// On which side of the vein that it leaves it runs up to the next: 1 the left, seen in that
    /// vein's direction, −1 the right.
    pub(crate) side: f64,
}

/// The tertiaries between veins that have grown; `unit` is a segment.
pub(crate) fn courses(
    architecture: &Architecture,
    veins: &[Grown],
    ground: Ground<'_>,
    unit: f64,
) -> Vec<Rung> {
    let plan = architecture.tertiaries;
    if plan.course == TertiaryCourse::Reticulate {
        return Vec::new();
    }
    Ladder { plan, order: 3 }.rungs(veins, ground, unit)
}

impl Ladder {
    /// The veins between those that have grown.
    pub(super) fn rungs(self, veins: &[Grown], ground: Ground<'_>, unit: f64) -> Vec<Rung> {
        let Ladder { plan, order } = self;
        let Ground {
            blade,
            margin,
            lots,
        } = ground;
        let length = blade.length();
        let spacing = (plan.spacing * length).max(2.5 * unit);
        let pieces: Vec<(usize, DVec2, DVec2)> = veins
            .iter()
            .enumerate()
            .flat_map(|(i, vein)| vein.nodes.windows(2).map(move |pair| (i, pair[0], pair[1])))
            .collect();
        let meets = |number: usize, near: DVec2, far: DVec2| {
            pieces
                .iter()
                .filter(|(i, ..)| *i != number)
                .filter_map(|&(_, a, b)| cross(near, far, a, b))
                .min_by(f64::total_cmp)
        };
        let mut rungs = Vec::new();
        let lateral = |vein: &&Grown| vein.side != 0.0;
        let flanks = |vein: &Grown| {
            let below = vein.is_lowest.then_some(-vein.side);
            std::iter::once(vein.side).chain(below)
        };
        let numbered = veins.iter().enumerate().filter(|(_, vein)| lateral(vein));
        for (number, side, vein) in numbered.flat_map(|(i, v)| flanks(v).map(move |s| (i, s, v))) {
            let is_below = side != vein.side;
            let spacing = if is_below { OUTER * spacing } else { spacing };
            let total = polyline::length(&vein.nodes);
            let key = (number as u64) << 13 | u64::from(is_below) << 12;
            let (mut walked, mut count) = (0.0, 0_u64);
            let place = |count: u64| {
                let jitter = PLACE_JITTER * lots.loose(order, key | count, 0);
                (count as f64 + 0.6 + jitter) * spacing
            };
            for pair in vein.nodes.windows(2) {
                let piece = pair[1] - pair[0];
                let step = piece.length();
                while place(count) < (walked + step).min(total * vein.fertile - 1.5 * unit) {
                    let id = key | count;
                    let start = pair[0] + piece * ((place(count) - walked).max(0.0) / step);
                    count += 1;
                    let degrees = if is_below { OUTER_DEG } else { plan.angle_deg };
                    let turn = (degrees + TURN_DEG * lots.loose(order, id, 1)).to_radians();
                    let (sin, cos) = libm::sincos(turn);
                    let ahead = piece / step;
                    let way = ahead * cos + ahead.perp() * (side * sin);
                    let far = start + way * (LONGEST * length);
                    let near = start + way * (0.5 * unit);
                    let meets = meets(number, near, far).map(|share| near.lerp(far, share));
                    let inside = |end: &DVec2| !blade.is_crossed_by(near, *end);
                    let course = if let Some(end) = meets.filter(inside) {
                        if (end - start).length() < 2.5 * unit {
                            continue;
                        }
                        let bends = if plan.course == TertiaryCourse::ChevronPercurrent {
                            let bend = CHEVRON * (end - start).length();
                            chevron(start, end, start.lerp(end, 0.47) + ahead * bend)
                        } else {
                            bends(self, start, end, ahead, spacing, lots, id)
                        };
                        Course::curve(start, &bends, lots, order, id, 0.8).joined()
                    } else {
                        let Some(hit) = margin.hit(start, way).filter(|_| is_below) else {
                            continue;
                        };
                        let end = hit.place - way * (MARGIN * length).max(1.5 * unit);
                        if (end - start).dot(way) < 2.5 * unit {
                            continue;
                        }
                        let bow = ahead * (0.06 * (end - start).length());
                        Course::curve(
                            start,
                            &[start.lerp(end, 0.5) - bow, end],
                            lots,
                            order,
                            id,
                            0.8,
                        )
                    };
                    rungs.push(Rung { course, side });
                }
                walked += step;
            }
        }
        rungs
    }
}

/// What leads from start to end over a sharp bend: limbs that are straight up to it.
fn chevron(start: DVec2, end: DVec2, bend: DVec2) -> Vec<DVec2> {
    vec![
        start.lerp(bend, 0.5),
        start.lerp(bend, 0.9),
        bend,
        end.lerp(bend, 0.9),
        end.lerp(bend, 0.5),
        end,
    ]
}

/// What leads a rung from start to end.
fn bends(
    ladder: Ladder,
    start: DVec2,
    end: DVec2,
    ahead: DVec2,
    spacing: f64,
    lots: Lots,
    id: u64,
) -> Vec<DVec2> {
    let order = ladder.order;
    let at = |share: f64, offset: f64| start.lerp(end, share) + ahead * (offset * spacing);
    let side = lots.side(order, id, 2);
    match ladder.plan.course {
        TertiaryCourse::Reticulate
        | TertiaryCourse::OppositePercurrent
        | TertiaryCourse::ChevronPercurrent => vec![end],
        TertiaryCourse::AlternatePercurrent => {
            let middle = 0.5 + 0.25 * lots.loose(order, id, 3);
            // No two are offset alike, and some hardly at all.
            let share = 0.15 + 1.1 * lots.share(order, id, 4);
            let jog = if order == 3 {
                JOG * share * side
            } else {
                JOG_OF_FINER * (end - start).length() / spacing * (0.7 + 0.5 * share) * side
            };
            vec![
                at(0.5 * middle, 0.5 * jog),
                at(middle - 0.06, jog),
                at(middle + 0.06, -jog),
                at(0.5 + 0.5 * middle, -0.5 * jog),
                end,
            ]
        }
        TertiaryCourse::SinuousPercurrent => {
            vec![
                at(0.27, 0.16 * side),
                at(0.5, 0.0),
                at(0.73, -0.16 * side),
                end,
            ]
        }
    }
}
