//! What an outline is made from: one of several kinds of contour, and teeth on it.

use crate::development::{DevelopedLeaf, DevelopmentPlan};
use crate::document::{Declared, Keys, Kinds, Variant};
use crate::not_grown::{NotGrown, not_grown};
use crate::shape::contour_curve::ContourCurve;
use crate::shape::cubic_margin::CubicMargin;
use crate::shape::growth_form::{GrowthForm, GrowthFormError, GrowthFormProblem, Side};
use crate::shape::outline::{Outline, OutlineError};
use crate::shape::specimen::Specimen;
use crate::shape::svg_path::SvgContour;
use crate::shape::teeth::{ToothWave, toothed};
use crate::transport::{TransportLeaf, TransportPlan};

/// What the margin is made from.
#[derive(Clone, Debug, Declared, PartialEq)]
pub enum Contour {
    /// Local growth rates bring it forth.
    GrowthAlgorithm(GrowthForm),
    /// A smooth curve through points.
    #[key(default = ContourCurve { points: Vec::new(), mirrored: true })]
    Curve(ContourCurve),
    /// A path of an SVG file.
    Svg(SvgContour),
    /// Two cubic splines.
    Cubic(CubicMargin),
    /// A leaf that grows as the cheapest transport network.
    Transport(TransportPlan),
    /// A leaf that develops from its margin.
    Development(DevelopmentPlan),
}

/// A contour, teeth on it, and how it is bent.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct OutlinePlan {
    /// Waves of teeth along the margin.
    #[key(
        "teeth",
        list(
            most = 20,
            wanted = "a list of at most 20 waves, such as { per_side = 20, height = 0.02 }"
        )
    )]
    pub teeth: Vec<ToothWave>,
    /// What makes the contour that of a specimen.
    #[key(with = unbent)]
    #[key(flat)]
    pub specimen: Specimen,
    /// The smooth contour.
    #[key(flat)]
    pub contour: Contour,
}

/// Lets a contour of another kind than the preset's not be bent as that was.
fn unbent(plan: &mut OutlinePlan, keys: &mut Keys<'_>) {
    let is_other = |kind: &Variant<Contour>| keys.has(kind.name) && !(kind.is)(&plan.contour);
    if Contour::KINDS.iter().any(is_other) {
        plan.specimen = Specimen::default();
    }
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

/// An outline that has grown, and what else its contour has brought forth.
pub(super) struct GrownOutline {
    pub(super) outline: Outline,
    pub(super) origin: Origin,
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
    pub(crate) fn is_contour(&self) -> bool {
        self.teeth.is_empty() && self.specimen.is_none()
    }

    /// Refuses to bend a contour that has brought forth what is inside it.
    fn check_inside(&self) -> Result<(), NotGrown> {
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
        let error = not_grown!(
            "the margin of a leaf that {grows} comes with what is inside it and cannot be bent: \
             {key} is for other contours"
        );
        Err(error.mend(
            &format!("outline.{key}"),
            "leave it out, or take another contour, such as [leaves.NAME.outline.curve]",
        ))
    }

    /// The outline of a leaf whose midrib goes from the origin to (0, `length_mm`). `seed` matters
    /// to transport leaves in uneven light, to leaves that develop from their margin, to teeth that
    /// differ by chance and to asymmetry.
    ///
    /// # Errors
    ///
    /// [`NotGrown`], naming what is out of range or why the curve is no margin.
    pub fn grow(&self, length_mm: f64, seed: u64) -> Result<Outline, NotGrown> {
        Ok(self.grow_with_origin(length_mm, seed)?.outline)
    }

    /// The outline, and the leaf whose margin it is if that is more than a curve.
    pub(super) fn grow_with_origin(
        &self,
        length_mm: f64,
        seed: u64,
    ) -> Result<GrownOutline, NotGrown> {
        if !(1e-3..=1e5).contains(&length_mm) {
            let error =
                not_grown!("length_mm is {length_mm}, outside 0.001 to 100000 (millimetres)");
            return Err(error.mend("length_mm", "use the length of a leaf"));
        }
        self.check_inside()?;
        let mut origin = Origin::Curve;
        let smooth = match &self.contour {
            Contour::GrowthAlgorithm(form) => form
                .grow(length_mm)
                .map_err(|error| not_grown_form(&error))?,
            Contour::Curve(curve) => curve.grow(length_mm).map_err(|error| {
                let help = "give the points in order, so that the curve goes around the blade once";
                NotGrown::because(error).mend("outline.curve.points", help)
            })?,
            Contour::Svg(contour) => contour
                .grow(length_mm)
                .map_err(|problem| refused(contour, &problem))?,
            Contour::Cubic(margin) => margin.grow(length_mm).map_err(|error| {
                let help = "use shorter handles, or angles that lead away from the midrib";
                NotGrown::because(error).mend("outline.cubic.angle1_deg", help)
            })?,
            Contour::Transport(plan) => {
                let of = |error: NotGrown| error.within("outline.transport");
                let leaf = plan.grow(seed).map_err(of)?;
                let outline = leaf.outline(length_mm).map_err(of)?;
                origin = Origin::Cells(leaf);
                outline
            }
            Contour::Development(plan) => {
                let of = |error: NotGrown| error.within("outline.development");
                let leaf = plan.develop(seed).map_err(of)?;
                let outline = leaf.outline(length_mm).map_err(of)?;
                origin = Origin::Developed(leaf);
                outline
            }
        };
        let bent = self.specimen.applied(smooth, seed);
        let bent = bent.map_err(|error| error.within("outline"))?;
        let tips = self.specimen.tips();
        let outline = toothed(&bent, &self.teeth, tips, seed)?;
        Ok(GrownOutline { outline, origin })
    }
}

/// The error of a path that is no margin.
fn refused(contour: &SvgContour, problem: &OutlineError) -> NotGrown {
    let file = &contour.file;
    if let OutlineError::OffBlade { end, .. } = problem {
        let [x, y] = if *end == "base" {
            contour.base
        } else {
            contour.apex
        };
        let error =
            not_grown!("the {end} ({x}, {y}) lies neither on the path of \"{file}\" nor inside it");
        let help = "name a point of the contour by its coordinates in the file, y down";
        return error.mend(&format!("outline.svg.{end}"), help);
    }
    let (path, help) = if *problem == OutlineError::NoMidrib {
        (
            "outline.svg.apex",
            "name two different points, the foot of the midrib and its tip",
        )
    } else {
        (
            "outline.svg.path",
            "draw one closed curve that does not cross itself",
        )
    };
    not_grown!("\"{file}\" holds a path that is no margin: {problem}").mend(path, help)
}

/// The error of a form that each of its numbers allows and that grows to no leaf all the same.
fn not_grown_form(error: &GrowthFormError) -> NotGrown {
    let (candidates, help): (&[&str], _) = match &error.problem {
        GrowthFormProblem::VeinOrder { .. } => (
            &["veins", "vein_count"],
            "put the veins farther apart, or use more `rows`",
        ),
        GrowthFormProblem::VeinsCross { .. } => (
            &["veins"],
            "change the slope as far as that, or put the veins farther apart",
        ),
        GrowthFormProblem::TooWide { .. } => (
            &["lateral_rates", "rate_ratio"],
            "use lower lateral rates, or a larger `rate_ratio`",
        ),
        GrowthFormProblem::Apart => (
            &["position"],
            "place the axis nearer to the middle of the blade, or widen its base",
        ),
        GrowthFormProblem::Range(_) => (&["axes"], "use fewer axes"),
        GrowthFormProblem::NoMargin(OutlineError::ShortMidrib { .. }) => (
            &["axes", "lateral_rates", "rate_ratio"],
            "use shorter axes, or lower lateral rates",
        ),
        GrowthFormProblem::NoMargin(_) => (
            &["veins", "axes"],
            "put the veins farther apart, with slopes that differ less",
        ),
    };
    let mut part = "outline.growth_algorithm".to_owned();
    for number in &error.part.axes {
        part += &format!(".axes.{number}");
    }
    let mut halves = vec![part.clone()];
    if error.part.side == Side::Left {
        // What the left half does not have is written beside it.
        halves.insert(0, format!("{part}.left"));
    }
    let mut refused = NotGrown::because(error);
    for half in &halves {
        for key in candidates {
            refused = refused.mend(&format!("{half}.{key}"), help);
        }
    }
    refused.mend(&format!("{part}.{}", candidates[0]), help)
}
