//! Quaternary veins between percurrent tertiaries: across from each to the next, or branched and
//! ending between them.

use super::course::Course;
use super::ends::aside;
use super::ground::Ground;
use super::tertiaries::{Grown, Ladder, Rung};
use super::{Architecture, Quaternaries, QuaternaryCourse, Tertiaries, TertiaryCourse};

/// Share of the way to the next tertiary over which a freely ramified one runs.
const REACH: [f64; 2] = [0.45, 0.68];

/// Where its branch leaves, share of what it runs.
const FORK: f64 = 0.45;

/// Angle of that branch, radians: 50°.
const BRANCH: f64 = 0.873;

/// What of the order is laid out: what starts on tertiaries, and branches of that.
#[derive(Default)]
pub(crate) struct Laid {
    /// From tertiaries.
    pub(crate) veins: Vec<Course>,
    /// From those.
    pub(crate) branches: Vec<Course>,
}

impl Quaternaries {
    /// As veins that cross from one to the next; none if chance lays them out.
    fn ladder(self) -> Option<Ladder> {
        let course = match self.course {
            QuaternaryCourse::Reticulate => return None,
            QuaternaryCourse::OppositePercurrent | QuaternaryCourse::FreelyRamified => {
                TertiaryCourse::OppositePercurrent
            }
            QuaternaryCourse::AlternatePercurrent => TertiaryCourse::AlternatePercurrent,
        };
        let plan = Tertiaries {
            course,
            spacing: self.spacing,
            angle_deg: 90.0,
        };
        Some(Ladder { plan, order: 4 })
    }
}

/// The quaternaries between tertiaries that have grown. `veins` are all coarser ones, of which
/// those with a side send quaternaries to that side.
pub(crate) fn courses(
    architecture: &Architecture,
    veins: &[Grown],
    ground: Ground<'_>,
    unit: f64,
) -> Laid {
    let plan = architecture.quaternaries;
    let Some(ladder) = plan.ladder() else {
        return Laid::default();
    };
    let rungs = ladder.rungs(veins, ground, unit);
    if plan.course == QuaternaryCourse::FreelyRamified {
        ramified(&rungs, ground)
    } else {
        Laid {
            veins: rungs.into_iter().map(|rung| rung.course).collect(),
            branches: Vec::new(),
        }
    }
}

/// Rungs that end before the next tertiary, each with a branch.
fn ramified(rungs: &[Rung], ground: Ground<'_>) -> Laid {
    let lots = ground.lots;
    let mut laid = Laid::default();
    for (number, rung) in rungs.iter().enumerate() {
        let id = number as u64;
        let [least, most] = REACH;
        let reach = least + (most - least) * lots.share(4, id, 20);
        let at = |share: f64| rung.course.at(reach * share).0;
        let (start, end) = (at(0.0), at(1.0));
        laid.veins
            .push(Course::curve(start, &[at(0.5), end], lots, 4, id, 0.5));
        let side = lots.side(4, id, 21);
        let fork = at(FORK);
        let way = aside(end - fork, BRANCH, side);
        laid.branches.push(Course::curve(
            fork,
            &[fork + way],
            lots,
            4,
            id | 1 << 40,
            0.3,
        ));
    }
    laid
}
