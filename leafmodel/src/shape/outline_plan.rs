//! What an outline is made from: one of several kinds of contour, and teeth on it.

use thiserror::Error;

use super::contour_curve::{ContourCurve, ContourCurveError};
use super::growth_shape::{GrowthShape, GrowthShapeError};
use super::outline::{Outline, OutlineError};
use super::svg_path::SvgContour;
use super::teeth::{TeethError, ToothWave, toothed};

/// Where the smooth contour comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Contour {
    /// Local growth rates bring it forth.
    GrowthAlgorithm(GrowthShape),
    /// A smooth curve through control points.
    Curve(ContourCurve),
    /// A path of an SVG file.
    Svg(SvgContour),
}

/// Everything that decides an outline.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlinePlan {
    /// The contour without teeth.
    pub contour: Contour,
    /// Waves of teeth along it, at most 20; none is an entire margin.
    pub teeth: Vec<ToothWave>,
}

/// Why a plan gives no outline.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum OutlinePlanError {
    /// A length that no leaf has.
    #[error("length_mm is {value}, outside 0.001 to 100000 (millimetres)")]
    Length {
        /// What it was.
        value: f64,
    },
    /// The growth algorithm.
    #[error(transparent)]
    GrowthAlgorithm(#[from] GrowthShapeError),
    /// Control points.
    #[error(transparent)]
    Curve(#[from] ContourCurveError),
    /// The path of an SVG file.
    #[error("\"{file}\" holds a path that is no margin: {problem}")]
    Svg {
        /// The file's name.
        file: String,
        /// What is wrong with the path.
        problem: OutlineError,
    },
    /// An end of the midrib lies off the path.
    #[error("the {end} ({x}, {y}) lies neither on the path of \"{file}\" nor inside it")]
    SvgEnd {
        /// The file's name.
        file: String,
        /// `base` or `apex`.
        end: &'static str,
        /// Where it lies in the coordinates of the file.
        x: f64,
        /// Likewise, downwards.
        y: f64,
    },
    /// Teeth.
    #[error(transparent)]
    Teeth(#[from] TeethError),
}

impl From<Contour> for OutlinePlan {
    /// The contour with an entire margin.
    fn from(contour: Contour) -> Self {
        Self {
            contour,
            teeth: Vec::new(),
        }
    }
}

impl OutlinePlan {
    /// The outline of a leaf whose midrib goes from the origin to (0, `length_mm`).
    ///
    /// # Errors
    ///
    /// [`OutlinePlanError`], naming what is out of range or why the curve is no margin.
    pub fn grow(&self, length_mm: f64) -> Result<Outline, OutlinePlanError> {
        if !(1e-3..=1e5).contains(&length_mm) {
            return Err(OutlinePlanError::Length { value: length_mm });
        }
        let smooth = match &self.contour {
            Contour::GrowthAlgorithm(shape) => shape.grow(length_mm)?,
            Contour::Curve(curve) => curve.grow(length_mm)?,
            Contour::Svg(contour) => contour
                .grow(length_mm)
                .map_err(|problem| refused(contour, problem))?,
        };
        Ok(toothed(&smooth, &self.teeth)?)
    }
}

/// An error in the words of the file that the contour comes from.
fn refused(contour: &SvgContour, problem: OutlineError) -> OutlinePlanError {
    let file = contour.file.clone();
    let OutlineError::OffBlade { end, .. } = problem else {
        return OutlinePlanError::Svg { file, problem };
    };
    let [x, y] = if end == "base" {
        contour.base
    } else {
        contour.apex
    };
    OutlinePlanError::SvgEnd { file, end, x, y }
}
