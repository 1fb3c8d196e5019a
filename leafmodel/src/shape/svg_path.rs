//! Outlines from a path of an SVG file.
//!
//! - **In**: the text of the file, and which path if it is not the first.
//! - **Out**: the contour as a polygon in the coordinates of the file, and from it an [`Outline`]
//!   of any length.
//! - **Always true**: transforms of the path and of its ancestors are applied; the polygon stays
//!   within 10⁻⁴ of the path's extent of its curves.
//! - **Left out**: shapes other than `path`, style sheets, and the `viewBox`, which moves and
//!   scales everything alike.
//!
//! In SVG y points down: the base is the lowest point of the contour as one sees it, the apex the
//! highest, unless both are given.

pub(crate) mod path_data;

use glam::{DAffine2, DMat2, DVec2};
use roxmltree::{Document, Node, ParsingOptions};
use svgtypes::{TransformListParser, TransformListToken};
use thiserror::Error;

use super::cubic::FLATNESS;
use super::outline::{Outline, OutlineError};

/// Greatest number of corners of a polygon.
const MOST_POINTS: usize = 1_000_000;

/// A contour from an SVG file.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgContour {
    /// Name of the file, as the plan gives it.
    pub file: String,
    /// The path's `id`; `None` means the first path that is drawn.
    pub id: Option<String>,
    /// The contour in the coordinates of the file, y down; the first point is not repeated at the
    /// end.
    pub points: Vec<[f64; 2]>,
    /// Where the petiole is attached, in the same coordinates.
    pub base: [f64; 2],
    /// Where the midrib ends, likewise.
    pub apex: [f64; 2],
}

/// A contour, and what was done to the drawing to have one.
#[derive(Clone, Debug, PartialEq)]
pub struct SvgReading {
    /// The contour.
    pub contour: SvgContour,
    /// Distance between the ends of an open path, which a straight line joins, as a share of the
    /// path's extent; 0 for a closed one.
    pub gap: f64,
    /// How many other paths are drawn, of which none was asked for by its `id`.
    pub passed_over: usize,
}

/// Why a file gives no contour.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SvgError {
    /// The file is not XML.
    #[error("is no SVG file: {problem}")]
    NotXml {
        /// What the parser says.
        problem: String,
    },
    /// There is no path.
    #[error("has no path that is drawn; turn shapes into paths")]
    NoPath,
    /// No path has that `id`.
    #[error("has no path with the id \"{id}\"")]
    NoSuchPath {
        /// The name.
        id: String,
    },
    /// Path data or a transform cannot be read.
    #[error("has an attribute `{attribute}` that cannot be read: {problem}")]
    BadAttribute {
        /// `d`, `transform` or `style`.
        attribute: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// The path has holes or several pieces.
    #[error("has a path of {parts} parts; an outline is one closed curve without holes")]
    SeveralParts {
        /// How many.
        parts: usize,
    },
    /// A coordinate is not finite, or there are more than a million corners.
    #[error("has a path that is too large: {problem}")]
    TooLarge {
        /// In what sense.
        problem: &'static str,
    },
}

impl SvgContour {
    /// Reads a path from the text of an SVG file; base and apex are where [`SvgContour::ends_of`]
    /// finds them.
    ///
    /// # Errors
    ///
    /// [`SvgError`]; its messages are written to follow the name of the file.
    ///
    /// # Source
    ///
    /// \[svg2\], chapters 8.5 (transforms) and 9.3 (path data).
    pub fn parse(file: &str, text: &str, id: Option<&str>) -> Result<Self, SvgError> {
        Ok(Self::read(file, text, id)?.contour)
    }

    /// As [`SvgContour::parse`], with what a careful reader tells of it.
    ///
    /// # Errors
    ///
    /// [`SvgError`]; its messages are written to follow the name of the file.
    pub fn read(file: &str, text: &str, id: Option<&str>) -> Result<SvgReading, SvgError> {
        // Drawing programs write a document type with entities into their files.
        let options = ParsingOptions {
            allow_dtd: true,
            nodes_limit: 10_000_000,
            ..ParsingOptions::default()
        };
        let document = Document::parse_with_options(text, options).map_err(|error| {
            let problem = error.to_string();
            SvgError::NotXml { problem }
        })?;
        let path = find(&document, id)?;
        let passed_over = match id {
            Some(_) => 0,
            None => paths(&document)
                .filter(|&other| other != path && is_drawn(other))
                .count(),
        };
        let data = path.attribute("d").unwrap_or_default();
        let parts = path_data::parts(data).map_err(|problem| SvgError::BadAttribute {
            attribute: "d",
            problem,
        })?;
        let [part] = parts.as_slice() else {
            return Err(match parts.len() {
                0 => SvgError::NoPath,
                parts => SvgError::SeveralParts { parts },
            });
        };
        let transform = transform_of(path)?;
        let mut cubics = part.clone();
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for cubic in &mut cubics {
            cubic.0 = cubic.0.map(|p| transform.transform_point2(p));
            for p in cubic.0 {
                if !p.is_finite() {
                    let problem = "a coordinate is not finite";
                    return Err(SvgError::TooLarge { problem });
                }
                (low, high) = (low.min(p), high.max(p));
            }
        }
        let extent = (high - low).max_element();
        let tolerance = FLATNESS * extent;
        let mut points = vec![cubics[0].0[0]];
        for cubic in &cubics {
            cubic.flatten(tolerance, &mut points);
            if points.len() > MOST_POINTS {
                let problem = "it has more than a million corners";
                return Err(SvgError::TooLarge { problem });
            }
        }
        let apart = points[0].distance(points[points.len() - 1]);
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        let points: Vec<[f64; 2]> = points.into_iter().map(DVec2::into).collect();
        let [base, apex] = Self::ends_of(&points);
        let contour = Self {
            file: file.to_owned(),
            id: id.map(str::to_owned),
            points,
            base,
            apex,
        };
        Ok(SvgReading {
            contour,
            gap: if apart > 0.0 { apart / extent } else { 0.0 },
            passed_over,
        })
    }

    /// Default base and apex: the lowest and the highest point as drawn, with y pointing down. If
    /// several points share that height, it is the midpoint of the outermost ones.
    pub fn ends_of(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
        let end = |sign: f64| {
            let height = |p: &[f64; 2]| sign * p[1];
            let most = points.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
            let at_it = points.iter().filter(|p| height(p) == most);
            let (left, right) = at_it
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(left, right), p| {
                    (left.min(p[0]), right.max(p[0]))
                });
            [left + (right - left) / 2.0, sign * most]
        };
        [end(1.0), end(-1.0)]
    }

    /// The outline, moved, turned and scaled so that the midrib goes from the origin to (0,
    /// `length_mm`).
    ///
    /// # Errors
    ///
    /// [`OutlineError`] if the polygon crosses itself or base and apex do not lie on it.
    /// `length_mm` must be finite and above 0.
    pub fn grow(&self, length_mm: f64) -> Result<Outline, OutlineError> {
        let seen = |p: [f64; 2]| DVec2::new(p[0], -p[1]);
        let (base, apex) = (seen(self.base), seen(self.apex));
        let midrib = apex - base;
        let length_squared = midrib.length_squared();
        if length_squared == 0.0 {
            return Err(OutlineError::NoMidrib);
        }
        let along = midrib * (length_mm / length_squared);
        let place = |p: DVec2| DVec2::new((p - base).perp_dot(along), (p - base).dot(along));
        let points = self.points.iter().map(|&p| place(seen(p))).collect();
        Outline::new(points, DVec2::ZERO, DVec2::new(0.0, length_mm))
    }
}

/// All paths of a file.
fn paths<'d>(document: &'d Document<'_>) -> impl Iterator<Item = Node<'d, 'd>> {
    document
        .descendants()
        .filter(|node| node.is_element() && node.tag_name().name() == "path")
}

/// The path of that `id`, or else the first that is drawn.
fn find<'d>(document: &'d Document<'_>, id: Option<&str>) -> Result<Node<'d, 'd>, SvgError> {
    let mut paths = paths(document);
    match id {
        Some(id) => paths
            .find(|node| node.attribute("id") == Some(id))
            .ok_or_else(|| SvgError::NoSuchPath { id: id.to_owned() }),
        None => paths.find(|&node| is_drawn(node)).ok_or(SvgError::NoPath),
    }
}

/// Whether an element is drawn where it stands.
pub(crate) fn is_drawn(node: Node<'_, '_>) -> bool {
    // What is within these elements is a template or a clip.
    const NOT_DRAWN: [&str; 7] = [
        "defs", "clipPath", "mask", "pattern", "symbol", "marker", "font",
    ];
    !node
        .ancestors()
        .any(|node| NOT_DRAWN.contains(&node.tag_name().name()))
}

/// The transform from a path's own coordinates to those of the file.
///
/// # Errors
///
/// [`SvgError::BadAttribute`] if a transform cannot be read.
pub(crate) fn transform_of(path: Node<'_, '_>) -> Result<DAffine2, SvgError> {
    let mut whole = DAffine2::IDENTITY;
    for node in path.ancestors() {
        if node
            .attribute("style")
            .is_some_and(|style| style.contains("transform"))
        {
            return Err(SvgError::BadAttribute {
                attribute: "style",
                problem: "write the transform as an attribute of its own".to_owned(),
            });
        }
        let Some(list) = node.attribute("transform") else {
            continue;
        };
        let mut own = DAffine2::IDENTITY;
        for token in TransformListParser::from(list) {
            let token = token.map_err(|error| SvgError::BadAttribute {
                attribute: "transform",
                problem: error.to_string(),
            })?;
            own *= affine(token);
        }
        whole = own * whole;
    }
    Ok(whole)
}

fn affine(token: TransformListToken) -> DAffine2 {
    let linear = |a, b, c, d| DAffine2::from_mat2(DMat2::from_cols_array(&[a, b, c, d]));
    match token {
        TransformListToken::Matrix { a, b, c, d, e, f } => {
            DAffine2::from_cols_array(&[a, b, c, d, e, f])
        }
        TransformListToken::Translate { tx, ty } => DAffine2::from_translation(DVec2::new(tx, ty)),
        TransformListToken::Scale { sx, sy } => linear(sx, 0.0, 0.0, sy),
        TransformListToken::Rotate { angle } => {
            let (sin, cos) = libm::sincos(angle.to_radians());
            linear(cos, sin, -sin, cos)
        }
        TransformListToken::SkewX { angle } => linear(1.0, 0.0, libm::tan(angle.to_radians()), 1.0),
        TransformListToken::SkewY { angle } => linear(1.0, libm::tan(angle.to_radians()), 0.0, 1.0),
    }
}

#[cfg(test)]
mod tests;
