//! The veins of one side of an axis.

use glam::DVec2;

use super::between::intersecondaries;
use super::laid::{Draft, Laid, Secondary, Site};
use super::targets::{branch_into_teeth, inward, run_into};
use crate::venation::architecture::SecondaryCourse;
use crate::venation::architecture::course::Course;
use crate::venation::architecture::ends::aside;
use crate::venation::architecture::festoons;
use crate::venation::architecture::ground::Ground;
use crate::venation::architecture::{Attachment, Secondaries, SecondaryEnding};

/// The veins of one side of an axis.
pub(super) struct Row {
    /// The number of the axis.
    pub(super) axis: usize,
    /// 1 the right, −1 the left.
    pub(super) side: f64,
    /// Where they leave it, shares of its length, ascending.
    pub(super) places: Vec<f64>,
}

pub(super) fn one_side(
    plan: &Secondaries,
    site: Site<'_>,
    row: &Row,
    taken: &mut Vec<DVec2>,
    laid: &mut Laid,
) {
    let Site { ground, axes } = site;
    let Ground { margin, lots, .. } = ground;
    let (number, side, wanted) = (row.axis, row.side, &row.places);
    let axis = &axes[number];
    let vein = |k: usize| (number as u64) << 16 | u64::from(side < 0.0) << 12 | k as u64;
    let gap = match wanted[..] {
        [first, .., last] => (last - first) / (wanted.len() as f64 - 1.0),
        _ => 0.3,
    };
    let length = axes[0].course.length();
    let mut drafts: Vec<Draft> = wanted
        .iter()
        .enumerate()
        .filter_map(|(k, &share)| {
            let share = share + 0.5 * PLACE_JITTER * gap * lots.jitter(2, vein(k), 0);
            let (place, ahead) = axis.at(share);
            let degrees = plan.angle_at(share) + ANGLE_JITTER * lots.jitter(2, vein(k), 1);
            let angle = (degrees.to_radians() - bend(plan.course)).max(0.15);
            let hit = margin.hit(place, aside(ahead, angle, side))?;
            let is_free = axes.iter().enumerate().all(|(i, other)| {
                let from = place + (hit.place - place) * 0.02;
                i == number || !other.course.is_crossed_by(from, hit.place)
            });
            is_free.then_some(Draft {
                share,
                angle,
                hit,
                tip: None,
            })
        })
        .collect();
    match plan.ending {
        SecondaryEnding::Craspedodromous => {
            run_into(&mut drafts, margin.tips(), site, number, gap, taken);
        }
        SecondaryEnding::Sinus => {
            let sinuses = margin.sinuses();
            run_into(&mut drafts, &sinuses, site, number, gap, taken);
        }
        SecondaryEnding::Semicraspedodromous => branch_into_teeth(&mut drafts, margin),
        SecondaryEnding::Eucamptodromous
        | SecondaryEnding::Brochidodromous
        | SecondaryEnding::Festooned => {}
    }
    // From the apex on, so that the next vein is there when an arch looks for it.
    let mut next: Option<(Course, f64)> = None;
    let mut courses = Vec::new();
    for (k, draft) in drafts.iter().enumerate().rev() {
        let (start, _) = axis.at(draft.share);
        let bends = course(plan, site, start, draft, side, next.as_ref(), [length, gap]);
        let Some(bends) = bends else { continue };
        let course = match plan.attachment {
            Attachment::Excurrent => Course::curve(start, &bends, lots, 2, vein(k), 1.0),
            Attachment::Decurrent => {
                // Lower on the axis, and beside it up to where it turns away.
                let (below, _) = axis.at(draft.share - DECURRENT);
                let way = bends[0] - start;
                let share = (CLEAR * length / way.length().max(1e-9)).clamp(0.12, 0.5);
                let turn = start + way * share;
                let bends: Vec<DVec2> = std::iter::once(turn).chain(bends).collect();
                // What runs beside the axis at first does not join it there.
                Course::curve(below, &bends, lots, 2, vein(k), 1.0).crowded()
            }
        };
        let arches = plan.ending.has_arches() && next.is_some();
        if arches && plan.ending == SecondaryEnding::Festooned {
            let inset = plan.inset * length;
            laid.finer
                .extend(festoons::outside(&course, margin, inset, lots, vein(k)));
        }
        if plan.ending == SecondaryEnding::Semicraspedodromous
            && let Some(tip) = draft.tip
        {
            let (from, _) = course.at(KNEE - 0.04);
            let end = inward(tip, from, length);
            laid.finer
                .push(Course::curve(from, &[end], lots, 3, vein(k), 0.3));
        }
        next = Some((course.clone(), draft.hit.at));
        courses.push(if arches { course.joined() } else { course });
    }
    courses.reverse();
    intersecondaries(plan, &courses, lots, number, side, laid);
    laid.veins
        .extend(courses.into_iter().map(|course| Secondary {
            course,
            axis: number,
            side,
        }));
}

/// The bends of a vein after its start; none if there is no room for it.
pub(super) fn course(
    plan: &Secondaries,
    site: Site<'_>,
    start: DVec2,
    draft: &Draft,
    side: f64,
    next: Option<&(Course, f64)>,
    [length, gap]: [f64; 2],
) -> Option<Vec<DVec2>> {
    let margin = site.ground.margin;
    let bowed = |end: DVec2| {
        let chord = end - start;
        let basal = -chord.perp() * side;
        let [half, far] = bow(plan.course);
        [
            start + chord * 0.5 + basal * half,
            start + chord * 0.82 + basal * far,
        ]
    };
    let reach = (draft.hit.place - start).length();
    let inset = (plan.inset * length).min(0.3 * reach);
    if reach < 0.02 * length {
        return None;
    }
    if plan.ending.has_targets() {
        let end = inward(draft.tip?, start, length);
        let [half, far] = bowed(end);
        let stays = [(start, half), (half, far), (far, end)]
            .iter()
            .all(|&(a, b)| {
                let from = a + (b - a) * 0.02;
                !site.ground.blade.is_crossed_by(from, b)
            });
        return Some(if stays {
            vec![half, far, end]
        } else {
            vec![end]
        });
    }
    // The knee lies on the way to the margin, inside it by `inset`.
    let way = (draft.hit.place - start) / reach;
    let back = inset / way.perp_dot(margin.direction(draft.hit.at)).abs().max(0.25);
    let knee = draft.hit.place - way * back.min(0.5 * reach);
    let [half, _] = bowed(knee);
    let towards_apex = if side > 0.0 { 1.0 } else { -1.0 };
    let on = match next {
        Some((_, at)) => (at - draft.hit.at).abs().min(0.2),
        None => gap * 0.3 * length / margin.perimeter(),
    };
    let is_arch = plan.ending.has_arches();
    let end = match next {
        Some((next, _)) if is_arch => next.at(ARCH_END).0,
        Some(_) | None => margin.inside(draft.hit.at + towards_apex * 0.62 * on, 0.8 * inset),
    };
    Some(vec![half, knee, end])
}

/// Share of the spacing by which a fully irregular place is moved.
const PLACE_JITTER: f64 = 0.4;

/// Degrees by which a fully irregular angle is turned.
const ANGLE_JITTER: f64 = 9.0;

/// Where on the next vein an arch ends, as a share of the places of its course.
const ARCH_END: f64 = 0.56;

/// Where a course bends up near the margin, likewise.
const KNEE: f64 = 2.0 / 3.0;

/// How far below its place a decurrent vein leaves, share of the axis.
const DECURRENT: f64 = 0.035;

/// How far from the axis it turns away at least, share of the leaf's length, so that it does not
/// join what it runs beside.
const CLEAR: f64 = 0.02;

/// How far a course bows towards the base, over its chord, at half and at five sixths.
fn bow(course: SecondaryCourse) -> [f64; 2] {
    match course {
        SecondaryCourse::Straight => [0.0, 0.0],
        SecondaryCourse::Arching => [0.075, 0.055],
        SecondaryCourse::Upturned => [0.045, 0.075],
    }
}

/// How much flatter the chord is than the departure, radians.
pub(crate) fn bend(course: SecondaryCourse) -> f64 {
    match course {
        SecondaryCourse::Straight => 0.0,
        SecondaryCourse::Arching => 0.16,
        SecondaryCourse::Upturned => 0.06,
    }
}
