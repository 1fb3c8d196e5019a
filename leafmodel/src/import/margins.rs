//! Margins of files, and what lies outside of them.

use glam::DVec2;

use super::draft::Draft;
use super::error::ImportError;
use super::faults::{Fault, FaultKind};
use super::repair::leave_out_bare;
use crate::plane::polygon;
use crate::shape::outline::{Outline, OutlineError};

/// How far outside a margin, as a share of the blade's extent, a node still counts as on it: files
/// round, and veins end at the margin.
const NEAR: f64 = 2e-3;

/// How far off the margin, as a share of the blade's extent, a base or an apex that is given is
/// moved onto it.
const ROUNDED: f64 = 1e-4;

/// Greatest share of the nodes that may lie outside of the margins.
const MOST_OUTSIDE: f64 = 0.5;

impl Draft {
    /// The margins of the file.
    pub(super) fn made_outlines(&self) -> Result<Vec<Outline>, ImportError> {
        let made = self.margins.iter().map(|margin| {
            let end = |sign: f64, given: Option<DVec2>| {
                given.map_or_else(|| ends_of(&margin.points, sign), |end| vec![end])
            };
            let (bases, apices) = (end(-1.0, margin.base), end(1.0, margin.apex));
            let mut made = Outline::new(margin.points.clone(), bases[0], apices[0]);
            // The middle between the lowest lobes may lie beside the blade; a lobe does not.
            for (base, apex) in bases
                .iter()
                .flat_map(|b| apices.iter().map(move |a| (b, a)))
            {
                if made.is_ok() {
                    break;
                }
                made = made.or_else(|_| Outline::new(margin.points.clone(), *base, *apex));
            }
            // Files round: an end that is given may lie off the line by its last digits.
            if made.is_err() && !margin.points.is_empty() {
                let extent = margin.points.iter().copied();
                let low = extent.clone().reduce(DVec2::min).unwrap_or_default();
                let high = extent.reduce(DVec2::max).unwrap_or_default();
                let slack = ROUNDED * (high - low).max_element();
                let snapped = |end: DVec2| {
                    let place = polygon::nearest(&margin.points, end).at;
                    if place.distance(end) <= slack {
                        place
                    } else {
                        end
                    }
                };
                let ends = (snapped(bases[0]), snapped(apices[0]));
                made = made.or_else(|_| Outline::new(margin.points.clone(), ends.0, ends.1));
            }
            made
        });
        made.collect::<Result<_, _>>()
            .map_err(|error: OutlineError| ImportError::bad_margin(error.to_string()))
    }
}

/// Leaves out the edges of which an end lies outside of all margins: a petiole, the stalks of
/// leaflets.
///
/// # Errors
///
/// [`ImportError::BadMargin`] if more than half of the nodes lie outside.
pub(super) fn leave_out_outside(
    draft: &mut Draft,
    outlines: &[Outline],
    faults: &mut Vec<Fault>,
) -> Result<(), ImportError> {
    if outlines.is_empty() {
        return Ok(());
    }
    let boxes: Vec<_> = outlines
        .iter()
        .map(|outline| {
            let (low, high) = outline.bounds();
            let slack = NEAR * (high - low).max_element();
            (outline, low - slack, high + slack, slack)
        })
        .collect();
    let is_inside = |p: DVec2| {
        boxes.iter().any(|&(outline, low, high, slack)| {
            p.cmpge(low).all()
                && p.cmple(high).all()
                && (outline.contains(p) || outline.distance_to_margin(p) <= slack)
        })
    };
    let inside: Vec<bool> = draft.places.iter().map(|&place| is_inside(place)).collect();
    let mut outside = Fault::new(FaultKind::OutsideMargin);
    for (place, _) in draft
        .places
        .iter()
        .zip(&inside)
        .filter(|(_, inside)| !**inside)
    {
        outside.at(*place);
    }
    if outside.count == 0 {
        return Ok(());
    }
    let nodes = draft.places.len();
    if outside.count as f64 > MOST_OUTSIDE * nodes as f64 {
        return Err(ImportError::bad_margin(format!(
            "{} of the {nodes} nodes lie outside of it; margin and veins must be in one frame and in one scale \
             (--mm-per-unit)",
            outside.count
        )));
    }
    draft
        .edges
        .retain(|edge| edge.ends.iter().all(|&end| inside[end as usize]));
    if draft.edges.is_empty() {
        return Err(ImportError::bad_margin("no vein lies within it"));
    }
    // Not told again: they went with their edges.
    leave_out_bare(draft, &vec![true; nodes], &mut Vec::new());
    faults.push(outside);
    Ok(())
}

/// Where base (sign −1) or apex (sign 1) of a margin may be that does not tell: in the middle of its
/// lowest or of its highest points, or at the outermost of these.
fn ends_of(points: &[DVec2], sign: f64) -> Vec<DVec2> {
    let most = points
        .iter()
        .map(|p| sign * p.y)
        .fold(f64::NEG_INFINITY, f64::max);
    let at_it = points.iter().filter(|p| sign * p.y == most).map(|p| p.x);
    let (left, right) = at_it.fold((f64::INFINITY, f64::NEG_INFINITY), |(left, right), x| {
        (f64::min(left, x), f64::max(right, x))
    });
    let at = |x: f64| DVec2::new(x, sign * most);
    vec![at(left + 0.5 * (right - left)), at(left), at(right)]
}
