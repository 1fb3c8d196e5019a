//! Palmate leaves: secondary axes that repeat the midrib, each with rows of cells and growth rates of its own.
//!
//! An axis starts on its parent, at the petiole in a palmate leaf, and grows for as long as the whole leaf does. Its own axial
//! rate decides how long it gets, its own lateral rates how wide its lobe. Axes may bear axes in turn. The blade is the union of all
//! lobes.
//!
//! - **In**: a [`PalmateForm`].
//! - **Out**: an [`Outline`], base at the origin, midrib along +y; the axes.
//! - **Always true**: the outline never crosses itself, and every axis ends on the blade. Holes between lobes are filled.
//! - **Left out**: lobes do not push each other aside; where two overlap they become one. Lobes that meet below the petiole close
//!   over it, as in a peltate leaf.

#[cfg(test)]
mod tests;

use glam::DVec2;

use super::cell_rows::ENLARGEMENT;
use super::growth_form::{GrowthForm, GrowthFormError, check_length, in_range};
use super::outer_boundary::union_boundary;
use super::outline::Outline;

/// Axes that a leaf may have in all, twins of pairs counted.
const MOST_AXES: usize = 200;

/// By which share of their size lobes are moved that lie on each other, from lobe to lobe: 0.1 nm on a leaf of 100 mm, then
/// more.
const SHIFTS: [f64; 4] = [1e-9, 1e-8, 1e-7, 1e-6];

/// How often axes may bear axes.
const DEEPEST: usize = 8;

/// An axis that replicates the midrib.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondaryAxis {
    /// Where it starts along its parent, 0 at the parent's base to 1 at its tip; 0 in a palmate leaf.
    pub position: f64,
    /// Its direction, radians from the parent's towards the right, −π to π.
    pub angle: f64,
    /// Whether its mirror image about the parent is there too.
    pub paired: bool,
    /// Its rows and their growth. Its `axial_rate` is compared with that of the main axis:
    /// [`SecondaryAxis::axial_rate_for`] gives the rate for a length.
    pub form: GrowthForm,
    /// Axes on it; with `paired` the twin has their mirror images.
    pub axes: Vec<SecondaryAxis>,
}

/// A leaf of several axes.
///
/// # Source
///
/// \[young2010\], section IV, says what palmate leaves need: "a self-similar organization in which the secondary veins
/// replicate the midrib with autonomous growth characteristics". How the axes are placed is ours.
#[derive(Clone, Debug, PartialEq)]
pub struct PalmateForm {
    /// The midrib and its rows.
    pub main: GrowthForm,
    /// The axes on it.
    pub axes: Vec<SecondaryAxis>,
}

/// An axis in its place: similarity from the form's own frame, in units of the main midrib.
#[derive(Clone, Copy, Debug)]
struct Frame {
    base: DVec2,
    /// From base to tip.
    axis: DVec2,
    mirrored: bool,
}

impl Frame {
    fn place(self, p: DVec2) -> DVec2 {
        let right = if self.mirrored {
            self.axis.perp()
        } else {
            -self.axis.perp()
        };
        self.base + right * p.x + self.axis * p.y
    }
}

impl SecondaryAxis {
    /// The axial growth rate of an axis that gets `length` times as long as the main one, whose rate is `main_rate`:
    /// `(1 + gy) length^(1/T) − 1`, as both grow the same `T` steps from primordia of one size.
    pub fn axial_rate_for(length: f64, main_rate: f64) -> f64 {
        let per_step = libm::log1p(main_rate) / libm::log(ENLARGEMENT);
        (1.0 + main_rate) * libm::pow(length, per_step) - 1.0
    }
}

impl PalmateForm {
    /// Grows all axes until the main midrib is a thousand times longer, and scales the outcome so that this midrib measures
    /// `length_mm`, 0.001 to 100 000.
    ///
    /// # Errors
    ///
    /// [`GrowthFormError`], naming the parameter and its range, or the axis that lies apart.
    pub fn grow(&self, length_mm: f64) -> Result<Outline, GrowthFormError> {
        let lobes = self.lobes(length_mm)?;
        let mut outcome = unite(&lobes, length_mm, 0.0);
        // Margins that run along each other have no clear crossings: moved apart by less than anyone sees, they do.
        for shift in SHIFTS {
            if outcome.is_ok() {
                break;
            }
            outcome = unite(&lobes, length_mm, shift).or(outcome);
        }
        outcome
    }

    /// All axes from base to tip, mm, the main one first, each before those on it.
    ///
    /// # Errors
    ///
    /// As [`PalmateForm::grow`], but that axes may lie apart.
    pub fn axis_lines(&self, length_mm: f64) -> Result<Vec<[DVec2; 2]>, GrowthFormError> {
        let ends = |(frame, _): &(Frame, Vec<DVec2>)| {
            [DVec2::ZERO, DVec2::Y].map(|p| frame.place(p) * length_mm)
        };
        Ok(self.lobes(length_mm)?.iter().map(ends).collect())
    }

    /// Frame and margin of each axis' lobe, the main one first, in units of the main midrib.
    fn lobes(&self, length_mm: f64) -> Result<Vec<(Frame, Vec<DVec2>)>, GrowthFormError> {
        check_length(length_mm)?;
        let steps = self.main.checked_steps()?;
        let whole = Frame {
            base: DVec2::ZERO,
            axis: DVec2::Y,
            mirrored: false,
        };
        let mut lobes = vec![(whole, self.main.margin(steps, ENLARGEMENT)?)];
        add_axes(&self.axes, whole, steps, 1, &mut lobes)?;
        Ok(lobes)
    }
}

/// The union of lobes in millimetres, each smaller and turned more than the one before it by the share `shift`.
fn unite(
    lobes: &[(Frame, Vec<DVec2>)],
    length_mm: f64,
    shift: f64,
) -> Result<Outline, GrowthFormError> {
    let moved = |(number, (frame, points)): (usize, &(Frame, Vec<DVec2>))| -> Vec<DVec2> {
        let off = number as f64 * shift;
        let place = |&p: &DVec2| {
            let p = p - frame.base;
            (frame.base + p * (1.0 - off) + p.perp() * off) * length_mm
        };
        points.iter().map(place).collect()
    };
    let polygons: Vec<Vec<DVec2>> = lobes.iter().enumerate().map(moved).collect();
    let rings: Vec<&[DVec2]> = polygons.iter().map(Vec::as_slice).collect();
    let apex = DVec2::new(0.0, length_mm);
    let outline = Outline::new(union_boundary(&rings), DVec2::ZERO, apex)?;
    // Half-way along, since a lobe that was moved may end short of its axis.
    let middle = DVec2::new(0.0, 0.5);
    let apart = |(frame, _): &(Frame, Vec<DVec2>)| !outline.covers(frame.place(middle) * length_mm);
    match lobes.iter().position(apart) {
        Some(number) => Err(GrowthFormError::Apart {
            axis: number.saturating_sub(1),
        }),
        None => Ok(outline),
    }
}

/// Adds the lobes of axes on a parent.
fn add_axes(
    axes: &[SecondaryAxis],
    parent: Frame,
    steps: f64,
    depth: usize,
    lobes: &mut Vec<(Frame, Vec<DVec2>)>,
) -> Result<(), GrowthFormError> {
    for axis in axes {
        in_range("axes.position", axis.position, 0.0..=1.0, "0 to 1")?;
        let half_turn = std::f64::consts::PI;
        in_range(
            "axes.angle",
            axis.angle,
            -half_turn..=half_turn,
            "-pi to pi",
        )?;
        in_range("axes.depth", depth as f64, 0.0..=DEEPEST as f64, "0 to 8")?;
        axis.form.validate()?;
        let enlargement = libm::exp(steps * libm::log1p(axis.form.axial_rate));
        let length = enlargement / ENLARGEMENT;
        let words = "0.01 to 100 of the main axis' length";
        in_range("axes.length", length, 0.01..=100.0, words)?;
        let margin = axis.form.margin(steps, enlargement)?;
        // Lengths are those of the leaf, whatever the parent's.
        let own_length = length / parent.axis.length();
        let twins: &[bool] = if axis.paired {
            &[false, true]
        } else {
            &[false]
        };
        for &twin in twins {
            let count = (lobes.len() + 1) as f64;
            in_range("axes (count)", count, 0.0..=MOST_AXES as f64, "0 to 200")?;
            let side = if twin { -1.0 } else { 1.0 };
            let direction = DVec2::new(side * libm::sin(axis.angle), libm::cos(axis.angle));
            let tip = DVec2::new(0.0, axis.position) + direction * own_length;
            let base = parent.place(DVec2::new(0.0, axis.position));
            let frame = Frame {
                base,
                axis: parent.place(tip) - base,
                mirrored: parent.mirrored != twin,
            };
            let mut placed: Vec<DVec2> = margin.iter().map(|&p| frame.place(p)).collect();
            if frame.mirrored {
                placed.reverse();
            }
            lobes.push((frame, placed));
            add_axes(&axis.axes, frame, steps, depth + 1, lobes)?;
        }
    }
    Ok(())
}
