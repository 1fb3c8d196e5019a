//! Drawings: every stroked path or basic shape is a vein, its stroke's width that of the vein.
//!
//! Ends of strokes nearer to each other than a quarter of the finest stroke's width are one node.
//! Groups called `order-1`, `order-2` … give the orders; the shape called `margin` is the margin.
//! Veins that taper in our own drawings are filled outlines; they are read as what they show.

use std::collections::HashMap;

use glam::{DAffine2, DVec2};
use svgtypes::{PathParser, PathSegment};

use super::draft::{Draft, DraftEdge, DraftMargin, Units};
use super::error::ImportError;
use super::faults::{Fault, FaultKind};
use super::fields::two_numbers;
use super::graph::shortened;
use crate::shape::cubic::FLATNESS;
use crate::shape::drawing::{self, BadAttribute, Drawing, Reason, Shape};

/// Ends of strokes within this share of the finest stroke's width are joined.
const JOINED: f64 = 0.25;

/// Groups of our own drawings that show no veins.
const NO_VEINS: &str = "areoles";

/// Reads the strokes of an SVG.
///
/// Lengths are millimetres if the outermost element gives its size in a unit of length and there is a
/// `viewBox`, else units of the drawing. What is left out becomes a fault.
///
/// # Errors
///
/// [`ImportError`] if it is no SVG, or path data or transforms cannot be read.
pub(super) fn read(text: &str) -> Result<Draft, ImportError> {
    let document = drawing::parse(text).map_err(malformed)?;
    let css = drawing::style_sheets(&document);
    let drawing = Drawing::read(&document, &css).map_err(malformed)?;
    let mut strokes: Vec<Stroke> = Vec::new();
    let mut draft = empty(&drawing);
    let line = |shape: &Shape<'_>| document.text_pos_at(shape.node.range().start).row;
    let mut bare = Fault::new(FaultKind::NoStroke);
    let mut uneven = Fault::new(FaultKind::Uneven);
    let named =
        |shape: &Shape<'_>| format!("line {} <{}>", line(shape), shape.node.tag_name().name());
    for shape in drawing.drawn() {
        let bad = |BadAttribute { attribute, problem }| {
            // To find a line takes as long as the text before it.
            let name = shape.node.tag_name().name();
            malformed(format!(
                "the <{name}> in line {}: {attribute}: {problem}",
                line(shape)
            ))
        };
        if shape.is_called("margin") {
            draft.margins.extend(margins(&drawing, shape).map_err(bad)?);
            continue;
        }
        let width = shape.stroke_width(drawing.mm_per_unit);
        let width = width.map_err(|value| {
            let place = format!("line {}", line(shape));
            let allowed = "it must be a number of at least 0, alone or in mm, cm, in, pt, pc or px";
            ImportError::bad_value(place, "stroke-width", &shortened(&value), allowed)
        })?;
        let before = strokes.len();
        let to_mm = DAffine2::from_scale(mm_per_unit(&drawing));
        if let Some(width) = width {
            if shape.is_unevenly_scaled(drawing.mm_per_unit) {
                uneven.named(|| named(shape));
            }
            let width = width * to_mm.matrix2.determinant().abs().sqrt();
            for points in flattened(&drawing, shape).map_err(bad)? {
                let radii = vec![0.5 * width; 2 * points.len().saturating_sub(1)];
                strokes.push(Stroke {
                    points,
                    radii,
                    order: shape.order,
                });
            }
        } else if let Some(order) = shape.order {
            let whole = to_mm * shape.to_root().map_err(bad)?;
            let data = shape.data().map_err(bad)?;
            strokes.extend(tapers(&data, whole).into_iter().map(|taper| Stroke {
                order: Some(order),
                ..taper
            }));
        }
        let parent = shape.node.parent_element();
        let is_ours = parent.is_some_and(|group| group.attribute("id") == Some(NO_VEINS));
        if strokes.len() == before && !is_ours {
            bare.named(|| named(shape));
        }
    }
    if strokes.is_empty() {
        let left: usize = drawing.left_out.values().map(|left| left.count).sum();
        return Err(ImportError::NoVeins(if bare.count + left > 0 {
            "paths or basic shapes with a stroke; those that it has are hidden or have no stroke"
        } else {
            "paths or basic shapes with a stroke"
        }));
    }
    let found = [bare, uneven].into_iter().filter(|fault| fault.count > 0);
    draft.remarks.extend(found);
    join(&strokes, &mut draft);
    Ok(draft)
}

/// Reads the margin of a drawing: the parts of the shape called `margin`, or else of the first path
/// that is drawn, or else of the first shape.
///
/// # Errors
///
/// As for [`read`].
pub(super) fn read_margin(text: &str) -> Result<Draft, ImportError> {
    let document = drawing::parse(text).map_err(malformed)?;
    let css = drawing::style_sheets(&document);
    let drawing = Drawing::read(&document, &css).map_err(malformed)?;
    let called = drawing.drawn().find(|shape| shape.is_called("margin"));
    let shape = called
        .or_else(|| drawing.drawn().find(|shape| shape.is_path()))
        .or_else(|| drawing.drawn().next());
    let shape = shape.ok_or_else(|| ImportError::bad_margin("there is no path that is drawn"))?;
    Ok(Draft {
        margins: margins(&drawing, shape).map_err(|error| malformed(error.to_string()))?,
        ..empty(&drawing)
    })
}

fn malformed(problem: String) -> ImportError {
    ImportError::malformed("SVG", problem)
}

/// A draft with what a drawing says as a whole.
fn empty(drawing: &Drawing<'_>) -> Draft {
    let units = Units {
        some_lack: drawing.mm_per_unit.is_none(),
        some_have: false,
    };
    let fault = |(reason, left): (&Reason, &drawing::LeftOut)| Fault {
        kind: match reason {
            Reason::Hidden => FaultKind::Hidden,
            Reason::NoShape => FaultKind::NoShape,
            Reason::Clip => FaultKind::Clip,
            Reason::Rule => FaultKind::StyleRule,
        },
        count: left.count,
        places: Vec::new(),
        names: left.names.clone(),
    };
    Draft {
        is_y_down: true,
        place_units: units,
        radius_units: units,
        remarks: drawing.left_out.iter().map(fault).collect(),
        ..Draft::default()
    }
}

fn mm_per_unit(drawing: &Drawing<'_>) -> DVec2 {
    drawing.mm_per_unit.unwrap_or(DVec2::ONE)
}

/// The parts of a shape as margins. Our own drawings give base and apex.
fn margins(drawing: &Drawing<'_>, shape: &Shape<'_>) -> Result<Vec<DraftMargin>, BadAttribute> {
    let whole = shape.to_root()?;
    let end = |name: &str| {
        let pair = two_numbers(shape.node.attribute(name)?)?;
        Some(mm_per_unit(drawing) * whole.transform_point2(pair.into()))
    };
    let (base, apex) = (end("data-base"), end("data-apex"));
    let parts = flattened(drawing, shape)?.into_iter();
    Ok(parts
        .map(|points| DraftMargin { points, base, apex })
        .collect())
}

/// A vein of a drawing: radii at both ends of each piece in turn.
struct Stroke {
    points: Vec<DVec2>,
    radii: Vec<f64>,
    order: Option<u8>,
}

/// Makes nodes of the ends of pieces.
fn join(strokes: &[Stroke], draft: &mut Draft) {
    let finest = strokes.iter().flat_map(|stroke| &stroke.radii).copied();
    let finest = finest
        .filter(|radius| *radius > 0.0)
        .fold(f64::INFINITY, f64::min);
    let reach = if finest.is_finite() {
        2.0 * JOINED * finest
    } else {
        0.0
    };
    let cell = if reach > 0.0 { reach } else { 1.0 };
    // It is only asked, never walked through.
    let mut cells: HashMap<[i64; 2], Vec<u32>> = HashMap::new();
    for stroke in strokes {
        let mut nodes = Vec::with_capacity(stroke.points.len());
        for &place in &stroke.points {
            let home = (place / cell).floor();
            let home = [home.x as i64, home.y as i64];
            let mut near = None;
            for across in -1..=1 {
                for along in -1..=1 {
                    let key = [
                        home[0].saturating_add(across),
                        home[1].saturating_add(along),
                    ];
                    for &node in cells.get(&key).into_iter().flatten() {
                        let away = (draft.places[node as usize] - place).length();
                        if away <= reach && near.is_none_or(|(least, _)| away < least) {
                            near = Some((away, node));
                        }
                    }
                }
            }
            let node = near.map_or_else(
                || {
                    draft.places.push(place);
                    let node = draft.places.len() as u32 - 1;
                    cells.entry(home).or_default().push(node);
                    node
                },
                |(_, node)| node,
            );
            nodes.push(node);
        }
        for (step, pair) in nodes.windows(2).enumerate() {
            // Bends finer than the reach fall together.
            if pair[0] != pair[1] {
                draft.edges.push(DraftEdge {
                    ends: [pair[0], pair[1]],
                    radii: [
                        Some(stroke.radii[2 * step]),
                        Some(stroke.radii[2 * step + 1]),
                    ],
                    order: stroke.order,
                });
            }
        }
    }
}

/// The parts of a shape as polygons.
fn flattened(drawing: &Drawing<'_>, shape: &Shape<'_>) -> Result<Vec<Vec<DVec2>>, BadAttribute> {
    let scale = mm_per_unit(drawing);
    let mut lines = Vec::new();
    for mut part in shape.parts()? {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for cubic in &mut part {
            cubic.0 = cubic.0.map(|p| p * scale);
            for p in cubic.0 {
                if !p.is_finite() {
                    return Err(BadAttribute {
                        attribute: "d",
                        problem: "a coordinate is not finite".to_owned(),
                    });
                }
                (low, high) = (low.min(p), high.max(p));
            }
        }
        let tolerance = FLATNESS * (high - low).max_element();
        let mut points = vec![part[0].0[0]];
        for cubic in &part {
            cubic.flatten(tolerance, &mut points);
        }
        points.dedup();
        lines.push(points);
    }
    Ok(lines)
}

/// Tapering veins: outlines from both corners of the wide end to a corner of the fine one, around
/// it by an arc, and back. There may be several in one path.
fn tapers(data: &str, whole: DAffine2) -> Vec<Stroke> {
    let segments: Vec<PathSegment> = PathParser::from(data).map_while(Result::ok).collect();
    let mut found = Vec::new();
    for five in segments.chunks(5) {
        let &[
            PathSegment::MoveTo {
                abs: true,
                x: ax,
                y: ay,
            },
            PathSegment::LineTo {
                abs: true,
                x: bx,
                y: by,
            },
            PathSegment::LineTo {
                abs: true,
                x: cx,
                y: cy,
            },
            PathSegment::EllipticalArc {
                abs: true,
                x: dx,
                y: dy,
                ..
            },
            PathSegment::ClosePath { .. },
        ] = five
        else {
            return Vec::new();
        };
        let [a, b, c, d] = [(ax, ay), (bx, by), (cx, cy), (dx, dy)]
            .map(|p| whole.transform_point2(DVec2::from(p)));
        found.push(Stroke {
            points: vec![0.5 * (a + b), 0.5 * (c + d)],
            radii: vec![0.5 * a.distance(b), 0.5 * c.distance(d)],
            order: None,
        });
    }
    found
}
