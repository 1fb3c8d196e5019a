//! What an outline is made from: one of several kinds of contour, and teeth on it.

use thiserror::Error;

use crate::development::{DevelopedLeaf, DevelopmentError, DevelopmentPlan};
use crate::shape::contour_curve::{ContourCurve, ContourCurveError};
use crate::shape::cubic_margin::{CubicMargin, CubicMarginError};
use crate::shape::growth_form::{GrowthForm, GrowthFormError};
use crate::shape::outline::{Outline, OutlineError};
use crate::shape::specimen::{Specimen, SpecimenError};
use crate::shape::svg_path::SvgContour;
use crate::shape::teeth::{TeethError, ToothWave, toothed};
use crate::transport::{TransportError, TransportLeaf, TransportPlan};

/// Where the smooth contour comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Contour {
    /// Local growth rates bring it forth.
    GrowthAlgorithm(GrowthForm),
    /// A smooth curve through control points.
    Curve(ContourCurve),
    /// A path of an SVG file.
    Svg(SvgContour),
    /// Two cubic splines by their angles and lengths.
    Cubic(CubicMargin),
    /// A leaf that grows as the cheapest transport network.
    Transport(TransportPlan),
    /// A leaf that develops from its margin.
    Development(DevelopmentPlan),
}

/// Everything that decides an outline.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlinePlan {
    /// The contour without teeth.
    pub contour: Contour,
    /// Waves of teeth along it, at most 20; none is an entire margin.
    pub teeth: Vec<ToothWave>,
    /// How the contour of a specimen departs from it: base, apex, unlike sides.
    pub specimen: Specimen,
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
    GrowthAlgorithm(#[from] GrowthFormError),
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
    /// Cubic splines.
    #[error(transparent)]
    Cubic(#[from] CubicMarginError),
    /// The transport leaf.
    #[error(transparent)]
    Transport(#[from] TransportError),
    /// The leaf that develops from its margin.
    #[error(transparent)]
    Development(#[from] DevelopmentError),
    /// Base, apex or asymmetry.
    #[error(transparent)]
    Specimen(#[from] SpecimenError),
    /// Veins or cells have come with the contour and would not follow it.
    #[error(
        "the margin of a leaf that {grows} comes with what is inside it and cannot be bent: {key} is for other contours"
    )]
    GrownInside {
        /// `develops` or `grows as a transport network`.
        grows: &'static str,
        /// The first key that would bend it.
        key: &'static str,
    },
    /// Teeth.
    #[error(transparent)]
    Teeth(#[from] TeethError),
}

/// What an outline is the margin of.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Origin {
    /// It is a curve.
    Curve,
    /// Of the cells of a transport leaf.
    Cells(TransportLeaf),
    /// Of a leaf that has developed from it.
    Developed(DevelopedLeaf),
}

impl Origin {
    /// The transport leaf, if it is one.
    pub(super) fn cells(self) -> Option<TransportLeaf> {
        match self {
            Self::Cells(leaf) => Some(leaf),
            Self::Curve | Self::Developed(_) => None,
        }
    }

    /// The developed leaf, if it is one.
    pub(super) fn developed(&self) -> Option<&DevelopedLeaf> {
        match self {
            Self::Developed(leaf) => Some(leaf),
            Self::Curve | Self::Cells(_) => None,
        }
    }
}

impl From<Contour> for OutlinePlan {
    /// The contour with an entire margin.
    fn from(contour: Contour) -> Self {
        Self {
            contour,
            teeth: Vec::new(),
            specimen: Specimen::default(),
        }
    }
}

impl OutlinePlan {
    /// The two splines that are the whole margin, if they are.
    pub(super) fn plain_cubic(&self) -> Option<&CubicMargin> {
        match &self.contour {
            Contour::Cubic(margin) if self.is_contour() => Some(margin),
            Contour::Cubic(_)
            | Contour::Curve(_)
            | Contour::GrowthAlgorithm(_)
            | Contour::Svg(_)
            | Contour::Transport(_)
            | Contour::Development(_) => None,
        }
    }

    /// The parameters of the growth algorithm, if that brings forth the contour.
    pub fn growth_form(&self) -> Option<&GrowthForm> {
        match &self.contour {
            Contour::GrowthAlgorithm(form) => Some(form),
            Contour::Curve(_)
            | Contour::Svg(_)
            | Contour::Cubic(_)
            | Contour::Transport(_)
            | Contour::Development(_) => None,
        }
    }

    /// Whether the contour is the whole margin.
    pub fn is_contour(&self) -> bool {
        self.teeth.is_empty() && self.specimen.is_none()
    }

    /// Refuses to bend a contour that has brought forth what is inside it.
    fn check_inside(&self) -> Result<(), OutlinePlanError> {
        let grows = match &self.contour {
            Contour::Transport(_) => "grows as a transport network",
            Contour::Development(_) => "develops",
            Contour::GrowthAlgorithm(_)
            | Contour::Curve(_)
            | Contour::Svg(_)
            | Contour::Cubic(_) => return Ok(()),
        };
        let Specimen {
            breadth,
            base,
            oblique,
            ..
        } = self.specimen;
        let key = if self.specimen.keeps_contour() {
            return Ok(());
        } else if breadth != 1.0 {
            "breadth"
        } else if base.is_some() {
            "base"
        } else if oblique != 0.0 {
            "oblique"
        } else if !self.specimen.asymmetry.is_none() {
            "asymmetry"
        } else {
            "apex"
        };
        Err(OutlinePlanError::GrownInside { grows, key })
    }

    /// The outline of a leaf whose midrib goes from the origin to (0, `length_mm`). `seed` matters
    /// to transport leaves in uneven light, to leaves that develop from their margin, to teeth that
    /// differ by chance and to asymmetry.
    ///
    /// # Errors
    ///
    /// [`OutlinePlanError`], naming what is out of range or why the curve is no margin.
    pub fn grow(&self, length_mm: f64, seed: u64) -> Result<Outline, OutlinePlanError> {
        Ok(self.grow_with_origin(length_mm, seed)?.0)
    }

    /// The outline, and the leaf whose margin it is if that is more than a curve.
    pub(super) fn grow_with_origin(
        &self,
        length_mm: f64,
        seed: u64,
    ) -> Result<(Outline, Origin), OutlinePlanError> {
        if !(1e-3..=1e5).contains(&length_mm) {
            return Err(OutlinePlanError::Length { value: length_mm });
        }
        self.check_inside()?;
        let mut origin = Origin::Curve;
        let smooth = match &self.contour {
            Contour::GrowthAlgorithm(form) => form.grow(length_mm)?,
            Contour::Curve(curve) => curve.grow(length_mm)?,
            Contour::Svg(contour) => contour
                .grow(length_mm)
                .map_err(|problem| refused(contour, problem))?,
            Contour::Cubic(margin) => margin.grow(length_mm)?,
            Contour::Transport(plan) => {
                let leaf = plan.grow(seed)?;
                let outline = leaf.outline(length_mm)?;
                origin = Origin::Cells(leaf);
                outline
            }
            Contour::Development(plan) => {
                let leaf = plan.develop(seed)?;
                let outline = leaf.outline(length_mm)?;
                origin = Origin::Developed(leaf);
                outline
            }
        };
        let bent = self.specimen.applied(smooth, seed)?;
        let tips = self.specimen.tips();
        Ok((toothed(&bent, &self.teeth, tips, seed)?, origin))
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
