//! Secondary axes in their places, and the union of all lobes.

use glam::DVec2;

use crate::document::RangeError;

use super::error::{FormPart, GrowthFormError, GrowthFormProblem, Side};
use super::form::{Axis, GrowthForm, SecondaryAxis};
use super::rows::{AxisGrowth, Rows};
use crate::shape::outer_boundary::union_boundary;
use crate::shape::outline::Outline;

/// Greatest number of axes of a leaf, the twins of pairs included.
const MOST_AXES: usize = 200;

/// Shifts tried for lobes whose margins coincide, from one lobe to the next, as shares of the
/// leaf's length: 0.1 nm on a leaf of 100 mm, then more.
const SHIFTS: [f64; 4] = [1e-9, 1e-8, 1e-7, 1e-6];

/// The place of an axis: a similarity from the axis' own frame to that of the leaf, in units of the
/// midrib.
#[derive(Clone, Debug)]
pub(super) struct Place {
    base: DVec2,
    /// From base to tip.
    axis: DVec2,
    mirrored: bool,
    /// Numbers that lead to the axis, as in `FormPart::axes`.
    path: Vec<usize>,
}

impl Place {
    fn of_midrib() -> Self {
        Self {
            base: DVec2::ZERO,
            axis: DVec2::Y,
            mirrored: false,
            path: Vec::new(),
        }
    }

    fn apply(&self, p: DVec2) -> DVec2 {
        let right = if self.mirrored {
            self.axis.perp()
        } else {
            -self.axis.perp()
        };
        self.base + right * p.x + self.axis * p.y
    }

    /// Moves the place.
    #[cfg(test)]
    pub(super) fn shift(&mut self, by: DVec2) {
        self.base += by;
    }

    /// Base and tip.
    #[cfg(test)]
    pub(super) fn ends(&self) -> [DVec2; 2] {
        [DVec2::ZERO, DVec2::Y].map(|p| self.apply(p))
    }

    /// Where an axis on this one lies.
    fn of_secondary(&self, axis: &SecondaryAxis, length: f64, number: usize, twin: bool) -> Self {
        // Lengths are in midribs, not in lengths of the parent.
        let own_length = length / self.axis.length();
        let side = if twin { -1.0 } else { 1.0 };
        let direction = DVec2::new(side * libm::sin(axis.angle), libm::cos(axis.angle));
        let tip = DVec2::new(0.0, axis.position) + direction * own_length;
        let base = self.apply(DVec2::new(0.0, axis.position));
        let mut path = self.path.clone();
        path.push(number);
        Self {
            base,
            axis: self.apply(tip) - base,
            mirrored: self.mirrored != twin,
            path,
        }
    }

    fn error(&self, problem: GrowthFormProblem) -> GrowthFormError {
        let part = FormPart {
            axes: self.path.clone(),
            side: Side::Right,
        };
        part.error(problem)
    }
}

impl GrowthForm {
    /// Place and margin of each axis' lobe, the midrib's first, counter-clockwise, in units of the
    /// midrib.
    pub(super) fn lobes(&self) -> Result<Vec<(Place, Vec<DVec2>)>, GrowthFormError> {
        let growth = self.checked()?;
        let mut lobes = Vec::new();
        add_lobes(&self.midrib, growth, &[Place::of_midrib()], &mut lobes)?;
        Ok(lobes)
    }
}

/// Adds the lobes of a checked axis at each of these places, and those of the axes on it.
fn add_lobes(
    axis: &Axis,
    growth: AxisGrowth,
    places: &[Place],
    lobes: &mut Vec<(Place, Vec<DVec2>)>,
) -> Result<(), GrowthFormError> {
    let count = (lobes.len() + places.len() - 1) as f64;
    RangeError::unless(count <= MOST_AXES as f64, "axes (count)", count, "0 to 200")
        .map_err(GrowthFormProblem::Range)?;
    let margin = lobe(axis, growth, &places[0].path)?;
    for place in places {
        let mut placed: Vec<DVec2> = margin.iter().map(|&p| place.apply(p)).collect();
        if place.mirrored {
            placed.reverse();
        }
        lobes.push((place.clone(), placed));
    }
    for (number, secondary) in axis.axes.iter().enumerate() {
        let twins: &[bool] = if secondary.paired {
            &[false, true]
        } else {
            &[false]
        };
        let length = growth.length_of(secondary);
        let on_each = |place: &Place| {
            let place = place.clone();
            twins
                .iter()
                .map(move |&twin| place.of_secondary(secondary, length, number, twin))
        };
        let places: Vec<Place> = places.iter().flat_map(on_each).collect();
        let growth = growth.of_secondary(secondary);
        add_lobes(&secondary.axis, growth, &places, lobes)?;
    }
    Ok(())
}

/// The margin of an axis' own lobe in units of the axis: from the base (0, 0) up the right half,
/// over the tip (0, 1), down the left one.
fn lobe(axis: &Axis, growth: AxisGrowth, path: &[usize]) -> Result<Vec<DVec2>, GrowthFormError> {
    let half = |side| {
        let part = FormPart {
            axes: path.to_vec(),
            side,
        };
        Rows::new(axis, growth, part).margin()
    };
    let mut points = half(Side::Right)?;
    let left = match &axis.left {
        None => points.clone(),
        Some(_) => half(Side::Left)?,
    };
    let inner = &left[1..left.len() - 1];
    points.extend(inner.iter().rev().map(|p| DVec2::new(-p.x, p.y)));
    Ok(points)
}

/// The union of all lobes in millimetres.
pub(super) fn union(
    lobes: &[(Place, Vec<DVec2>)],
    length_mm: f64,
) -> Result<Outline, GrowthFormError> {
    let mut outcome = unite(lobes, length_mm, 0.0);
    // Margins that run along each other have no well-defined crossings. They have after a shift far
    // too small to be seen.
    for shift in SHIFTS {
        if outcome.is_ok() {
            break;
        }
        outcome = unite(lobes, length_mm, shift).or(outcome);
    }
    outcome
}

/// The union of lobes, each smaller and turned more than the one before it by the share `shift`.
fn unite(
    lobes: &[(Place, Vec<DVec2>)],
    length_mm: f64,
    shift: f64,
) -> Result<Outline, GrowthFormError> {
    let moved = |(number, (place, points)): (usize, &(Place, Vec<DVec2>))| -> Vec<DVec2> {
        let off = number as f64 * shift;
        let move_point = |&p: &DVec2| {
            let p = p - place.base;
            (place.base + p * (1.0 - off) + p.perp() * off) * length_mm
        };
        points.iter().map(move_point).collect()
    };
    let polygons: Vec<Vec<DVec2>> = lobes.iter().enumerate().map(moved).collect();
    let rings: Vec<&[DVec2]> = polygons.iter().map(Vec::as_slice).collect();
    let apex = DVec2::new(0.0, length_mm);
    let outline = Outline::new(union_boundary(&rings), DVec2::ZERO, apex)?;
    // The middle of the axis is tested, since a shifted lobe may end short of its axis' ends.
    let middle = DVec2::new(0.0, 0.5);
    let apart =
        |(place, _): &&(Place, Vec<DVec2>)| !outline.covers(place.apply(middle) * length_mm);
    match lobes.iter().find(apart) {
        Some((place, _)) => Err(place.error(GrowthFormProblem::Apart)),
        None => Ok(outline),
    }
}
