//! Outlines from a path of an SVG file.
//!
//! - **In**: the text of the file, and which path if it is not the first.
//! - **Out**: the contour as a polygon in the coordinates of the file, and from it an [`Outline`]
//!   of any length.
//! - **Always true**: transforms of the path and of its ancestors are applied; the polygon stays
//!   within 10⁻⁴ of the path's extent of its curves; hidden elements are skipped.
//! - **Left out**: the `viewBox`, which moves and scales everything alike.
//!
//! In SVG y points down: the base is the lowest point of the contour as one sees it, the apex the
//! highest, unless both are given.

use std::fs;

use glam::DVec2;

use super::cubic::FLATNESS;
use super::drawing::{self, BadAttribute, Drawing, Shape};
use super::outline::{Outline, OutlineError};
use crate::document::context::{Context, QUOTED};
use crate::document::encoding::decoded;
use crate::document::named_asset::bad_file;
use crate::document::path::{Wanted, resolve};
use crate::document::source::{Place, escaped};
use crate::document::values::text_at;
use crate::document::{Declared, Keys, Limits, Numbers, Text};
use crate::not_grown::{NotGrown, not_grown};

/// Greatest number of corners of a polygon.
const MOST_POINTS: usize = 1_000_000;

/// A contour from an SVG file.
#[derive(Clone, Debug, Default, PartialEq)]
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
    /// What else of the drawing is left out, unless a path was asked for by its `id`: a line per reason.
    pub left_out: Vec<String>,
}

impl Declared for SvgContour {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        let contour = self;
        // Coordinates of the file.
        let place = || Numbers(Limits::closed(-1e9, 1e9));
        let before = contour.clone();
        let path = Text("the path of an SVG file");
        keys.required("path", &mut contour.file, path, "The file.");
        let about = "`id` of the path.";
        keys.optional("id", &mut contour.id, Text("the `id` of a path"), about);
        if keys.is_sound() && (contour.file != before.file || contour.id != before.id) {
            *contour = read_svg(contour, keys).unwrap_or(before);
        }
        let [base, apex] = if contour.points.is_empty() {
            [[0.0; 2]; 2]
        } else {
            SvgContour::ends_of(&contour.points)
        };
        for (key, end, usual, about) in [
            (
                "base",
                &mut contour.base,
                base,
                "Where the petiole is attached, `[x, y]` in the coordinates of the file (y down).",
            ),
            ("apex", &mut contour.apex, apex, "Where the midrib ends."),
        ] {
            let mut given = (*end != usual).then_some(*end);
            keys.optional(key, &mut given, place(), about);
            *end = given.unwrap_or(usual);
        }
    }
}

fn read_svg(named: &SvgContour, keys: &Keys<'_>) -> Option<SvgContour> {
    const WANTED: Wanted = Wanted {
        endings: &["svg"],
        most_bytes: 16 << 20,
    };
    let block = keys.reader()?;
    let (path, at) = text_at(block.cx, block.node("path")?, "path")?;
    let file = resolve(block.cx, path, at, WANTED)?;
    let text = fs::read(file)
        .map_err(|error| format!("cannot be read: {error}"))
        .and_then(|bytes| {
            let decoded = decoded(&bytes).map_err(|error| error.to_string())?;
            Ok(decoded.text.into_owned())
        })
        .map_err(|problem| {
            (
                problem,
                "make it a readable text file, in UTF-8 for example",
            )
        });
    let parsed = text.and_then(|text| {
        let reading = SvgContour::read(path, &text, named.id.as_deref());
        reading.map_err(|error| (error.to_string(), error.help()))
    });
    match parsed {
        Ok(reading) => {
            warn_of_guesses(block.cx, at, &reading);
            Some(reading.contour)
        }
        Err((problem, help)) => {
            bad_file(block.cx, at, path, &problem, help);
            None
        }
    }
}

/// Least gap between the ends of a path, as a share of its extent, that is no rounding.
const GAP: f64 = 1e-3;

/// Tells what was done to a drawing to have a contour.
fn warn_of_guesses(cx: &Context, at: &Place, reading: &SvgReading) {
    let path = escaped(&reading.contour.file, 2 * QUOTED);
    if reading.passed_over > 0 {
        let message = format!(
            "\"{path}\" has {} paths that are drawn, of which the first is taken",
            reading.passed_over + 1
        );
        let help = "name the margin's path by its `id`";
        cx.warn(at, "scene::first_path", message, help);
    }
    if !reading.left_out.is_empty() {
        let message = format!(
            "of \"{path}\" the following is left out: {}",
            escaped(&reading.left_out.join("; "), 8 * QUOTED)
        );
        let help = "name the margin's path by its `id` if another one is meant";
        cx.warn(at, "scene::left_out_of_drawing", message, help);
    }
    if reading.gap > GAP {
        let message = format!(
            "the path in \"{path}\" is open; a straight line over {:.2} of its extent closes it",
            reading.gap
        );
        let help = "close the path in the drawing program if the margin goes on there";
        cx.warn(at, "scene::open_path", message, help);
    }
}

impl SvgContour {
    /// Reads a path from the text of an SVG file; base and apex are where [`SvgContour::ends_of`]
    /// finds them.
    ///
    /// # Errors
    ///
    /// [`NotGrown`]; its messages are written to follow the name of the file.
    ///
    /// # Source
    ///
    /// \[svg2\], chapters 8.5 (transforms) and 9.3 (path data).
    pub fn parse(file: &str, text: &str, id: Option<&str>) -> Result<Self, NotGrown> {
        Ok(Self::read(file, text, id)?.contour)
    }

    /// As [`SvgContour::parse`], with what a careful reader tells of it.
    ///
    /// # Errors
    ///
    /// [`NotGrown`]; its messages are written to follow the name of the file.
    pub fn read(file: &str, text: &str, id: Option<&str>) -> Result<SvgReading, NotGrown> {
        let document = drawing::parse(text).map_err(no_xml)?;
        let css = drawing::style_sheets(&document);
        let drawing = Drawing::read(&document, &css).map_err(no_xml)?;
        let shape = find(&drawing, id)?;
        let others = drawing
            .drawn()
            .filter(|other| other.node != shape.node && other.is_path() == shape.is_path());
        let passed_over = id.map_or_else(|| others.count(), |_| 0);
        let parts = shape
            .parts()
            .map_err(|BadAttribute { attribute, problem }| {
                let error =
                    not_grown!("has an attribute `{attribute}` that cannot be read: {problem}");
                let help = "mend the attribute, or save the file anew from a drawing program";
                error.mend("path", help)
            })?;
        let [part] = parts.as_slice() else {
            return Err(match parts.len() {
                0 => no_path(),
                parts => not_grown!(
                    "has a path of {parts} parts; an outline is one closed curve without holes"
                )
                .mend(
                    "path",
                    "keep one closed curve, or name another path by its `id`",
                ),
            });
        };
        // Drawn taller or wider than its coordinates say.
        let stretch = DVec2::new(1.0, drawing.stretch());
        let mut cubics = part.clone();
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for cubic in &mut cubics {
            cubic.0 = cubic.0.map(|p| p * stretch);
            for p in cubic.0 {
                if !p.is_finite() {
                    return Err(too_large("a coordinate is not finite"));
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
                return Err(too_large("it has more than a million corners"));
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
            left_out: if id.is_some() {
                Vec::new()
            } else {
                left_out(&drawing, shape)
            },
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

fn no_xml(problem: impl std::fmt::Display) -> NotGrown {
    not_grown!("is no SVG file: {problem}").mend("path", "save it as plain SVG")
}

fn no_path() -> NotGrown {
    let error = NotGrown::because("has no path or basic shape that is drawn");
    error.mend(
        "path",
        "draw the margin as one `<path>`, outside of `<defs>`",
    )
}

fn too_large(problem: &str) -> NotGrown {
    not_grown!("has a path that is too large: {problem}").mend("path", "simplify the path")
}

/// The path or basic shape of that `id`, drawn if there is one, or else the first path that is drawn,
/// or else the first shape.
fn find<'a, 'd>(drawing: &'a Drawing<'d>, id: Option<&str>) -> Result<&'a Shape<'d>, NotGrown> {
    let Some(id) = id else {
        let mut paths = drawing.drawn().filter(|shape| shape.is_path());
        let first = paths.next().or_else(|| drawing.drawn().next());
        return first.ok_or_else(no_path);
    };
    let called = |shape: &&Shape| shape.node.attribute("id") == Some(id);
    let drawn = drawing.drawn().find(called);
    drawn
        .or_else(|| drawing.shapes.iter().find(called))
        .ok_or_else(|| {
            let error = not_grown!("has no path with the id \"{id}\"");
            let help = "look the path's `id` up in the file, or leave `id` out for the first path";
            error.mend("path", help)
        })
}

/// What is left out of a drawing besides other shapes of the same kind.
fn left_out(drawing: &Drawing<'_>, taken: &Shape<'_>) -> Vec<String> {
    let lines = drawing.left_out.iter().map(|(reason, left)| {
        let names = left.names.join(", ");
        format!("{} ({}): {names}", reason.words(), left.count)
    });
    let mut lines: Vec<String> = lines.collect();
    let others = drawing
        .drawn()
        .filter(|shape| shape.is_path() != taken.is_path());
    let others = others.count();
    if others > 0 {
        lines.push(format!("basic shapes beside the path ({others})"));
    }
    lines
}

#[cfg(test)]
mod tests;
