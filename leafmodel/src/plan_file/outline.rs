//! `outline`: the margin of a leaf.

use std::fs;

use super::development::{self, development};
use super::growth_form::{self, growth_form};
use super::specimen::{self, specimen, teeth};
use crate::document::context::{Context, QUOTED};
use crate::document::encoding::decoded;
use crate::document::error::DocumentError;
use crate::document::keys::{BlockList, Keys, Variant};
use crate::document::limits::Limits;
use crate::document::nearest::nearest;
use crate::document::path::{Wanted, resolve};
use crate::document::schema::Type;
use crate::document::source::{Place, escaped};
use crate::document::tree::{Node, Value};
use crate::document::value_kind::{Flag, Integer, Kind, ListOf, Number, Numbers, Text};
use crate::document::values::{list, number, number_at, text_at, wrong_length, wrong_type};
use crate::leaf::LeafPlan;
use crate::leaf::outline_plan::{Contour, OutlinePlanError};
use crate::shape::contour_curve::{ContourCurve, ControlPoint};
use crate::shape::cubic_margin::CubicMargin;
use crate::shape::outline::{Outline, OutlineError};
use crate::shape::specimen::Specimen;
use crate::shape::svg_path::{SvgContour, SvgError, SvgReading};
use crate::shape::teeth::ToothWave;
use crate::transport::{Ladder, TransportError, TransportPlan};
use crate::variant;

/// Equal steps in which the revenue rises where nothing is said.
const STEPS: u32 = 80;

/// The kinds of contour.
pub(super) const KINDS: [Variant<Contour>; 6] = [
    Variant {
        name: "growth_algorithm",
        about: "Local growth rates bring it forth.",
        new: || Contour::GrowthAlgorithm(growth_form::usual()),
        is: |contour| matches!(contour, Contour::GrowthAlgorithm(_)),
        declare: |contour, keys| {
            if let Contour::GrowthAlgorithm(form) = contour {
                growth_form(form, keys);
            }
        },
    },
    Variant {
        name: "curve",
        about: "A smooth curve through points.",
        new: || {
            Contour::Curve(ContourCurve {
                points: Vec::new(),
                mirrored: true,
            })
        },
        is: |contour| matches!(contour, Contour::Curve(_)),
        declare: |contour, keys| {
            if let Contour::Curve(curve) = contour {
                declare_curve(curve, keys);
            }
        },
    },
    Variant {
        name: "svg",
        about: "A path of an SVG file.",
        new: || {
            Contour::Svg(SvgContour {
                file: String::new(),
                id: None,
                points: Vec::new(),
                base: [0.0; 2],
                apex: [0.0; 2],
            })
        },
        is: |contour| matches!(contour, Contour::Svg(_)),
        declare: |contour, keys| {
            if let Contour::Svg(svg) = contour {
                declare_svg(svg, keys);
            }
        },
    },
    variant!("cubic", Contour::Cubic, cubic, "Two cubic splines."),
    variant!(
        "transport",
        Contour::Transport,
        transport,
        "A leaf that grows as the cheapest transport network."
    ),
    variant!(
        "development",
        Contour::Development,
        development,
        "A leaf that develops from its margin."
    ),
];

/// The keys of `outline`.
pub(super) fn outline(plan: &mut LeafPlan, keys: &mut Keys<'_>) {
    let waves = BlockList {
        most: 20,
        new: &ToothWave::default,
        wanted: "a list of at most 20 waves, such as { per_side = 20, height = 0.02 }",
        is_inside_itself: false,
    };
    let about = "Waves of teeth along the margin.";
    keys.blocks("teeth", &mut plan.outline.teeth, &waves, about, teeth);
    // A contour of another kind than the preset's is not bent as that was.
    let is_other =
        |kind: &Variant<Contour>| keys.has(kind.name) && !(kind.is)(&plan.outline.contour);
    if KINDS.iter().any(is_other) {
        plan.outline.specimen = Specimen::default();
    }
    specimen(&mut plan.outline.specimen, keys);
    keys.kind(&mut plan.outline.contour, &KINDS);
}

fn cubic(margin: &mut CubicMargin, keys: &mut Keys<'_>) {
    let angle = Number(Limits::open(0.0, 180.0));
    let length = Number(Limits::closed(0.01, 10.0));
    let about = "Angle at the base between midrib and margin.";
    keys.key("angle1_deg", &mut margin.angle1_deg, angle, about);
    let about = "Length of the handle at the base, in midribs.";
    keys.key("length1", &mut margin.length1, length, about);
    let about = "Angle at the apex.";
    keys.key("angle2_deg", &mut margin.angle2_deg, angle, about);
    let about = "Length of the handle at the apex, in midribs.";
    keys.key("length2", &mut margin.length2, length, about);
}

fn transport(plan: &mut TransportPlan, keys: &mut Keys<'_>) {
    let limits = Number(Limits::open(0.0, 1.0));
    let about = "α: how little it saves to transport much together; larger is rounder.";
    keys.required("alpha", &mut plan.alpha, limits, about);
    let limits = Number(Limits::above(0.0, 20.0));
    let about = "β: how dearly a change of direction is paid.";
    keys.required("beta", &mut plan.beta, limits, about);
    let limits = Number(Limits::above(0.0, 1e9));
    let about = "ε: what a full-grown leaf's cell earns per area: larger leaves have more cells.";
    keys.required("epsilon", &mut plan.epsilon, limits, about);
    let limits = Number(Limits::closed(1e-6, 1e6));
    keys.key(
        "cell",
        &mut plan.cell,
        limits,
        "h: edge of a cell in the leaf's own unit.",
    );
    keys.exclude("steps", "events");
    let (mut steps, mut events) = match plan.ladder {
        Ladder::Equal(steps) => (steps, false),
        Ladder::Events => (STEPS, true),
    };
    if keys.reader().is_some() && keys.has("steps") {
        events = false;
    }
    let count = Integer::within(1, 10_000);
    let about = "Equal steps in which ε rises, from where the first cell comes.";
    if !events || keys.reader().is_some() {
        keys.key("steps", &mut steps, count, about);
    }
    let about = "Instead: one step for each rise that brings a cell, the smallest there are.";
    if events || keys.reader().is_some() || keys.is_description() {
        keys.key("events", &mut events, Flag, about);
    }
    plan.ladder = if events {
        Ladder::Events
    } else {
        Ladder::Equal(steps)
    };
    let about = "Both sides grow as one. Uneven light overrules it.";
    keys.key("mirrored", &mut plan.mirrored, Flag, about);
    let limits = Number(Limits::below(0.0, 1.0));
    let about = "Uneven light: greatest departure of a cell's ε from its mean, as a share; the \
        leaf's `seed` decides where.";
    keys.key("noise", &mut plan.noise, limits, about);
    let limits = Number(Limits::closed(1.0, 1000.0));
    let about = "cells: width of patches of light and shadow.";
    keys.key("noise_cells", &mut plan.noise_cells, limits, about);
    let count = Integer::within(1, 1_000_000);
    let about = "A leaf with more is an error.";
    keys.key("most_cells", &mut plan.most_cells, count, about);
}

const WANTED_POINTS: &str = "a list of 3 to 1000 points, [x, y] or [x, y, \"corner\"]";

fn declare_curve(curve: &mut ContourCurve, keys: &mut Keys<'_>) {
    let about = "The points are the right side, from the base `[0, 0]` to the apex `[0, 1]`, and \
        the left side is its mirror image. If false, they go all round.";
    keys.key("mirrored", &mut curve.mirrored, Flag, about);
    let points = ListOf {
        of: Point,
        least: 3,
        most: 1000,
        wanted: WANTED_POINTS,
    };
    let about = "`[[x, y], [x, y, \"corner\"], …]`: in order; the word makes a corner where else \
        the curve is smooth.";
    keys.required("points", &mut curve.points, points, about);
}

/// `[x, y]` or `[x, y, "corner"]`.
#[derive(Clone, Copy, Debug)]
struct Point;

impl Point {
    const LIMITS: Limits = Limits::closed(-10.0, 10.0);
    const ONE: &str = "a point, [x, y] or [x, y, \"corner\"]";
}

impl Kind for Point {
    type Of = ControlPoint;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<ControlPoint> {
        let Value::List(parts) = &node.value else {
            wrong_type(cx, node, key, Self::ONE);
            return None;
        };
        let (x, y, corner) = match parts.as_slice() {
            [x, y] => (x, y, Some(false)),
            [x, y, word] => (x, y, read_corner(cx, word, key)),
            _ => {
                wrong_length(cx, &node.at, key, "a list", parts.len(), Self::ONE);
                return None;
            }
        };
        let [x, y] = [x, y].map(|node| number_at(cx, node, key, Self::LIMITS));
        Some(ControlPoint {
            place: [x?, y?],
            corner: corner?,
        })
    }

    fn write(&self, point: &ControlPoint) -> Value {
        let corner = point.corner.then(|| Value::Text("corner".to_owned()));
        list(point.place.map(number).into_iter().chain(corner))
    }

    fn describe(&self) -> Type {
        let place = || vec![Type::Number(Self::LIMITS); 2];
        let mut corner = place();
        corner.push(Type::Word(vec!["corner".to_owned()]));
        Type::AnyOf(vec![Type::Tuple(place()), Type::Tuple(corner)], Self::ONE)
    }
}

/// The word `"corner"`.
fn read_corner(cx: &Context, node: &Node, key: &str) -> Option<bool> {
    let (word, at) = text_at(cx, node, key)?;
    if word == "corner" {
        return Some(true);
    }
    let error = DocumentError::UnknownWord {
        key: key.to_owned(),
        word: escaped(word, QUOTED),
        nearest: nearest(word, ["corner"]).map(str::to_owned),
        known: "`corner`".to_owned(),
    };
    cx.error(at, error);
    None
}

fn declare_svg(contour: &mut SvgContour, keys: &mut Keys<'_>) {
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
        reading.map_err(|error| (error.to_string(), help(&error)))
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

/// Reports a file that is of no use.
pub(super) fn bad_file(cx: &Context, at: &Place, path: &str, problem: &str, help: &str) {
    let error = DocumentError::BadFile {
        path: escaped(path, 2 * QUOTED),
        problem: escaped(problem, 8 * QUOTED),
        help: help.to_owned(),
    };
    cx.error(at, error);
}

fn help(error: &SvgError) -> &'static str {
    match error {
        SvgError::NotXml { .. } => "save it as plain SVG",
        SvgError::NoPath => "draw the margin as one `<path>`, outside of `<defs>`",
        SvgError::NoSuchPath { .. } => {
            "look the path's `id` up in the file, or leave `id` out for the first path"
        }
        SvgError::BadAttribute { .. } => {
            "mend the attribute, or save the file anew from a drawing program"
        }
        SvgError::SeveralParts { .. } => "keep one closed curve, or name another path by its `id`",
        SvgError::TooLarge { .. } => "simplify the path",
    }
}

/// The outline at a length of 1 mm, or a report of why there is none; `keys` are the leaf's.
pub(super) fn tried(plan: &LeafPlan, keys: &Keys<'_>) -> Option<Outline> {
    match plan.outline.grow(1.0, plan.seed) {
        Ok(grown) => Some(grown),
        Err(error) => {
            report(keys, &error);
            None
        }
    }
}

/// Reports an outline that each of its numbers allows and that is none all the same, at the key to
/// change.
fn report(keys: &Keys<'_>, error: &OutlinePlanError) {
    let (path, help): (&[&str], _) = match error {
        OutlinePlanError::Teeth(error) => (&["outline", "teeth"], specimen::teeth_help(error)),
        OutlinePlanError::Specimen(error) => specimen::help(error),
        OutlinePlanError::GrownInside { key, .. } => {
            keys.refuse(
                &["outline", key],
                error.to_string(),
                "leave it out, or take another contour, such as [leaves.NAME.outline.curve]",
            );
            return;
        }
        OutlinePlanError::Curve(_) => (
            &["outline", "curve", "points"],
            "give the points in order, so that the curve goes around the blade once",
        ),
        OutlinePlanError::SvgEnd { end, .. } => (
            &["outline", "svg", end],
            "name a point of the contour by its coordinates in the file, y down",
        ),
        OutlinePlanError::Svg {
            problem: OutlineError::NoMidrib,
            ..
        } => (
            &["outline", "svg", "apex"],
            "name two different points, the foot of the midrib and its tip",
        ),
        OutlinePlanError::Svg { .. } => (
            &["outline", "svg", "path"],
            "draw one closed curve that does not cross itself",
        ),
        OutlinePlanError::Cubic(_) => (
            &["outline", "cubic", "angle1_deg"],
            "use shorter handles, or angles that lead away from the midrib",
        ),
        OutlinePlanError::Transport(error) => {
            let help = match error {
                TransportError::OutOfRange { .. } => "use a lower revenue, or a larger cell",
                TransportError::TooManyCells { .. } => {
                    "use a lower revenue, a larger alpha, or allow more cells"
                }
                TransportError::Outline(_) | TransportError::TooFine { .. } => {
                    "let the leaf grow larger"
                }
            };
            (&["outline", "transport", "epsilon"], help)
        }
        OutlinePlanError::GrowthAlgorithm(error) => {
            growth_form::report(keys, error);
            return;
        }
        OutlinePlanError::Development(error) => {
            development::report(keys, error);
            return;
        }
        // Reported where the length is read.
        OutlinePlanError::Length { .. } => (&["length_mm"], "use the length of a leaf"),
    };
    keys.refuse(path, error.to_string(), help);
}
