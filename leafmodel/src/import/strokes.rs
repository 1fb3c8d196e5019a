//! Drawings: every stroked path is a vein, its stroke's width that of the vein.
//!
//! Ends of strokes nearer to each other than a quarter of the finest stroke's width are one node.
//! Groups called `order-1`, `order-2` … give the orders; the path called `margin` is the margin.
//! Veins that taper in our own drawings are filled outlines; they are read as what they show.

use std::collections::HashMap;

use glam::{DAffine2, DVec2};
use roxmltree::{Document, Node, ParsingOptions};
use svgtypes::{Length, LengthUnit, PathParser, PathSegment};

use super::draft::{Draft, DraftEdge, DraftMargin};
use super::error::ImportError;
use super::fields::two_numbers;
use super::graph::shortened;
use crate::shape::cubic::FLATNESS;
use crate::shape::svg_path::path_data::parts;
use crate::shape::svg_path::{is_drawn, transform_of};

/// Ends of strokes within this share of the finest stroke's width are joined.
const JOINED: f64 = 0.25;

/// Reads the strokes of an SVG.
///
/// Lengths are millimetres if `width` of the outermost element has a unit of length and there is a
/// `viewBox`, else units of the drawing.
///
/// # Errors
///
/// [`ImportError`] if it is no SVG, or path data or transforms cannot be read.
pub(super) fn read(text: &str) -> Result<Draft, ImportError> {
    let malformed = |problem: String| ImportError::Malformed {
        format: "SVG",
        problem,
    };
    let options = ParsingOptions {
        allow_dtd: true,
        nodes_limit: u32::MAX,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options)
        .map_err(|error| malformed(error.to_string()))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let found = root.tag_name().name();
        return Err(malformed(format!("its outermost element is <{found}>")));
    }
    let scale = mm_per_unit(root);
    let mut strokes: Vec<Stroke> = Vec::new();
    let mut draft = Draft {
        is_y_down: true,
        places_lack_unit: scale.is_none(),
        radii_lack_unit: scale.is_none(),
        ..Draft::default()
    };
    let scale = scale.unwrap_or(1.0);
    for node in document
        .descendants()
        .filter(|node| node.is_element() && is_drawn(*node))
    {
        let Some(data) = path_of(node) else { continue };
        let whole = transform_of(node).map_err(|error| malformed(error.to_string()))?;
        let whole = DAffine2::from_scale(DVec2::splat(scale)) * whole;
        let bad = |problem: String| {
            // To find a line takes as long as the text before it.
            let line = document.text_pos_at(node.range().start).row;
            malformed(format!("the path in line {line}: {problem}"))
        };
        if node.attribute("id") == Some("margin") {
            draft
                .margins
                .extend(margins(node, &data, whole).map_err(bad)?);
            continue;
        }
        let order = order_of(node);
        let width = stroke_width(node).map_err(|value| ImportError::BadValue {
            place: format!("line {}", document.text_pos_at(node.range().start).row),
            key: "stroke-width".to_owned(),
            value: shortened(&value),
            allowed: "it must be a number of at least 0, alone or in mm, cm, in, pt, pc or px",
        })?;
        if let Some(width) = width {
            let width = width * libm::sqrt(whole.matrix2.determinant().abs());
            for points in flattened(&data, whole).map_err(bad)? {
                let radii = vec![0.5 * width; 2 * points.len().saturating_sub(1)];
                strokes.push(Stroke {
                    points,
                    radii,
                    order,
                });
            }
        } else if order.is_some() {
            strokes.extend(
                tapers(&data, whole)
                    .into_iter()
                    .map(|taper| Stroke { order, ..taper }),
            );
        }
    }
    if strokes.is_empty() {
        return Err(ImportError::NoVeins {
            wanted: "paths, lines or polylines with a stroke",
        });
    }
    join(&strokes, &mut draft);
    Ok(draft)
}

/// Reads the margin of a drawing: the parts of the path called `margin`, or else of the first path
/// that is drawn.
///
/// # Errors
///
/// As for [`read`].
pub(super) fn read_margin(text: &str) -> Result<Draft, ImportError> {
    let has_margin = text.contains("id=\"margin\"") || text.contains("id='margin'");
    let id = has_margin.then_some("margin");
    let malformed = |problem: String| ImportError::Malformed {
        format: "SVG",
        problem,
    };
    let options = ParsingOptions {
        allow_dtd: true,
        nodes_limit: u32::MAX,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options)
        .map_err(|error| malformed(error.to_string()))?;
    let scale = mm_per_unit(document.root_element());
    let mut paths = document.descendants().filter(|node| {
        node.tag_name().name() == "path"
            && is_drawn(*node)
            && (id.is_none() || node.attribute("id") == id)
    });
    let path = paths.next().ok_or(ImportError::BadMargin {
        problem: "there is no path".to_owned(),
    })?;
    let whole = transform_of(path).map_err(|error| malformed(error.to_string()))?;
    let whole = DAffine2::from_scale(DVec2::splat(scale.unwrap_or(1.0))) * whole;
    let data = path.attribute("d").unwrap_or_default();
    Ok(Draft {
        margins: margins(path, data, whole).map_err(malformed)?,
        is_y_down: true,
        places_lack_unit: scale.is_none(),
        ..Draft::default()
    })
}

/// The parts of a path as margins. Our own drawings tell base and apex.
fn margins(node: Node<'_, '_>, data: &str, whole: DAffine2) -> Result<Vec<DraftMargin>, String> {
    let end = |name: &str| {
        let pair = two_numbers(node.attribute(name)?)?;
        Some(whole.transform_point2(pair.into()))
    };
    let (base, apex) = (end("data-base"), end("data-apex"));
    let parts = flattened(data, whole)?.into_iter();
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

/// Millimetres to a unit of the `viewBox`, if the outermost element says how wide it is.
fn mm_per_unit(root: Node<'_, '_>) -> Option<f64> {
    let width: Length = root.attribute("width")?.trim().parse().ok()?;
    let mm = match width.unit {
        LengthUnit::Mm => 1.0,
        LengthUnit::Cm => 10.0,
        LengthUnit::In => 25.4,
        LengthUnit::Pt => 25.4 / 72.0,
        LengthUnit::Pc => 25.4 / 6.0,
        LengthUnit::None
        | LengthUnit::Em
        | LengthUnit::Ex
        | LengthUnit::Px
        | LengthUnit::Percent => return None,
    };
    let mut view = root
        .attribute("viewBox")?
        .split([' ', ','])
        .filter(|part| !part.is_empty());
    let units: f64 = view.nth(2)?.parse().ok()?;
    let scale = width.number * mm / units;
    (scale.is_finite() && scale > 0.0).then_some(scale)
}

/// Path data of an element that can be stroked.
fn path_of(node: Node<'_, '_>) -> Option<String> {
    match node.tag_name().name() {
        "path" => node.attribute("d").map(str::to_owned),
        "polyline" => Some(format!("M{}", node.attribute("points")?)),
        "line" => {
            let of = |name| node.attribute(name).unwrap_or("0");
            Some(format!(
                "M{} {}L{} {}",
                of("x1"),
                of("y1"),
                of("x2"),
                of("y2")
            ))
        }
        _ => None,
    }
}

/// A property that elements inherit: of its own or an ancestor's attribute or style.
fn inherited(node: Node<'_, '_>, name: &str) -> Option<String> {
    node.ancestors().find_map(|node| {
        let style = node.attribute("style").unwrap_or_default();
        let styled = style.split(';').find_map(|rule| {
            let (key, value) = rule.split_once(':')?;
            (key.trim() == name).then(|| value.trim().to_owned())
        });
        styled.or_else(|| node.attribute(name).map(str::to_owned))
    })
}

/// Width of the stroke in the element's own units; `None` if it has none, an error with what stands
/// there if that is no width.
///
/// A width with a unit of length is counted as CSS does, 96 units of the drawing to an inch.
fn stroke_width(node: Node<'_, '_>) -> Result<Option<f64>, String> {
    let stroke = inherited(node, "stroke");
    if stroke.is_none_or(|stroke| stroke == "none" || stroke == "transparent") {
        return Ok(None);
    }
    let Some(text) = inherited(node, "stroke-width") else {
        return Ok(Some(1.0));
    };
    let length = text.trim().parse::<Length>().ok();
    let width = length.and_then(|length| {
        let units = match length.unit {
            LengthUnit::None | LengthUnit::Px => 1.0,
            LengthUnit::Mm => 96.0 / 25.4,
            LengthUnit::Cm => 960.0 / 25.4,
            LengthUnit::In => 96.0,
            LengthUnit::Pt => 96.0 / 72.0,
            LengthUnit::Pc => 16.0,
            LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return None,
        };
        Some(length.number * units)
    });
    match width {
        Some(width) if width.is_finite() && width >= 0.0 => {
            Ok(Some(width).filter(|width| *width > 0.0))
        }
        Some(_) | None => Err(text),
    }
}

/// The number behind `order-` in the name of the nearest group that has one.
fn order_of(node: Node<'_, '_>) -> Option<u8> {
    let orders = node
        .ancestors()
        .filter_map(|node| node.attribute("id")?.strip_prefix("order-"));
    orders
        .filter_map(|order| order.parse().ok())
        .find(|order| *order > 0)
}

/// The parts of a path as polygons.
fn flattened(data: &str, whole: DAffine2) -> Result<Vec<Vec<DVec2>>, String> {
    let mut lines = Vec::new();
    for mut part in parts(data)? {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for cubic in &mut part {
            cubic.0 = cubic.0.map(|p| whole.transform_point2(p));
            for p in cubic.0 {
                if !p.is_finite() {
                    return Err("a coordinate is not finite".to_owned());
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
