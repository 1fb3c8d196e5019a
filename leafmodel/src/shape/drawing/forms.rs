//! Basic shapes as path data, lengths, and viewports.

use glam::{DAffine2, DVec2};
use roxmltree::Node;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, ViewBox};
use thiserror::Error;

use super::style::units;

/// An attribute that cannot be read.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("`{attribute}`: {problem}")]
pub(crate) struct BadAttribute {
    pub(crate) attribute: &'static str,
    pub(crate) problem: String,
}

/// Elements that draw a shape.
pub(super) const SHAPES: [&str; 7] = [
    "path", "line", "polyline", "polygon", "rect", "circle", "ellipse",
];

/// Millimetres to a pixel of CSS.
pub(super) const MM_PER_PIXEL: f64 = 25.4 / 96.0;

/// A length among the attributes of an element, in its own units; `None` without it.
///
/// # Errors
///
/// [`BadAttribute`] if it is no length, or a percentage where the viewport is not known.
pub(super) fn length(
    node: Node<'_, '_>,
    name: &'static str,
    viewport: Option<DVec2>,
) -> Result<Option<f64>, BadAttribute> {
    let Some(text) = node.attribute(name).map(str::trim) else {
        return Ok(None);
    };
    if text == "auto" {
        return Ok(None);
    }
    let side = |of: DVec2| match name {
        "y" | "height" => of.y,
        _ => of.x,
    };
    let read = text.parse::<Length>().ok().and_then(|length| {
        if length.unit == LengthUnit::Percent {
            return viewport.map(|of| 0.01 * length.number * side(of));
        }
        units(length)
    });
    let read = read.filter(|length| length.is_finite());
    read.map(Some).ok_or_else(|| BadAttribute {
        attribute: name,
        problem: format!(
            "{:?} is no length in units of the drawing, mm, cm, in, pt, pc or px",
            text.chars().take(40).collect::<String>()
        ),
    })
}

/// Path data of an element; empty if it draws nothing.
pub(super) fn data(node: Node<'_, '_>) -> Result<String, BadAttribute> {
    let of = |name| length(node, name, None);
    let or_0 = |name| Ok(of(name)?.unwrap_or(0.0));
    let points = || node.attribute("points").unwrap_or_default().trim();
    let ellipse = |centre: DVec2, radii: DVec2| {
        if radii.min_element() <= 0.0 {
            return String::new();
        }
        let (left, right) = (centre.x - radii.x, centre.x + radii.x);
        let (DVec2 { y, .. }, DVec2 { x: rx, y: ry }) = (centre, radii);
        format!("M{left} {y}A{rx} {ry} 0 0 1 {right} {y}A{rx} {ry} 0 0 1 {left} {y}Z")
    };
    Ok(match node.tag_name().name() {
        "path" => node.attribute("d").unwrap_or_default().to_owned(),
        "polyline" if !points().is_empty() => format!("M{}", points()),
        "polygon" if !points().is_empty() => format!("M{}Z", points()),
        "line" => format!(
            "M{} {}L{} {}",
            or_0("x1")?,
            or_0("y1")?,
            or_0("x2")?,
            or_0("y2")?
        ),
        "circle" => {
            let radius = or_0("r")?;
            ellipse(DVec2::new(or_0("cx")?, or_0("cy")?), DVec2::splat(radius))
        }
        "ellipse" => {
            let (rx, ry) = (of("rx")?, of("ry")?);
            let [rx, ry] = [rx.or(ry), ry.or(rx)].map(|radius| radius.unwrap_or(0.0));
            ellipse(DVec2::new(or_0("cx")?, or_0("cy")?), DVec2::new(rx, ry))
        }
        "rect" => {
            let (low, size) = (
                DVec2::new(or_0("x")?, or_0("y")?),
                DVec2::new(or_0("width")?, or_0("height")?),
            );
            let (rx, ry) = (of("rx")?, of("ry")?);
            let [rx, ry] = [rx.or(ry), ry.or(rx)].map(|radius| radius.unwrap_or(0.0));
            rectangle(low, size, DVec2::new(rx, ry))
        }
        _ => String::new(),
    })
}

/// A rectangle with corners that may be round.
fn rectangle(low: DVec2, size: DVec2, radii: DVec2) -> String {
    if size.min_element() <= 0.0 {
        return String::new();
    }
    let DVec2 { x, y } = low;
    let DVec2 { x: right, y: below } = low + size;
    let DVec2 { x: rx, y: ry } = radii.max(DVec2::ZERO).min(0.5 * size);
    if rx == 0.0 || ry == 0.0 {
        return format!("M{x} {y}H{right}V{below}H{x}Z");
    }
    let arc = |x: f64, y: f64| format!("A{rx} {ry} 0 0 1 {x} {y}");
    format!(
        "M{} {y}H{}{}V{}{}H{}{}V{}{}Z",
        x + rx,
        right - rx,
        arc(right, y + ry),
        below - ry,
        arc(right - rx, below),
        x + rx,
        arc(x, below - ry),
        y + ry,
        arc(x + rx, y)
    )
}

pub(super) fn view_box(node: Node<'_, '_>) -> Option<ViewBox> {
    node.attribute("viewBox")?.parse().ok()
}

/// Scale of a view along x and y in a viewport: one for both unless `preserveAspectRatio` is `none`.
fn scale(node: Node<'_, '_>, view: ViewBox, size: DVec2) -> (DVec2, Align) {
    let aspect = node.attribute("preserveAspectRatio");
    let aspect: Option<AspectRatio> = aspect.and_then(|text| text.trim().parse().ok());
    let (align, slice) = aspect.map_or((Align::XMidYMid, false), |a| (a.align, a.slice));
    let each = size / DVec2::new(view.w, view.h);
    let scale = match (align, slice) {
        (Align::None, _) => each,
        (_, false) => DVec2::splat(each.min_element()),
        (_, true) => DVec2::splat(each.max_element()),
    };
    (scale, align)
}

/// The transform from within a nested `<svg>` or a `<symbol>` to what is around it, and the size of
/// its own viewport; `asked` is the size that a `<use>` asks for.
pub(super) fn viewport(
    node: Node<'_, '_>,
    asked: [Option<f64>; 2],
    around: DVec2,
) -> Result<(DAffine2, DVec2), BadAttribute> {
    let of = |name| length(node, name, Some(around));
    let place = DVec2::new(of("x")?.unwrap_or(0.0), of("y")?.unwrap_or(0.0));
    let size = DVec2::new(
        asked[0].or(of("width")?).unwrap_or(around.x),
        asked[1].or(of("height")?).unwrap_or(around.y),
    );
    let moved = DAffine2::from_translation(place);
    let Some(view) = view_box(node) else {
        return Ok((moved, size));
    };
    let (scale, align) = scale(node, view, size);
    let rest = size - scale * DVec2::new(view.w, view.h);
    let (across, along) = match align {
        Align::None | Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    };
    let shift = rest * DVec2::new(across, along) - scale * DVec2::new(view.x, view.y);
    let inner = DAffine2::from_translation(shift) * DAffine2::from_scale(scale);
    Ok((moved * inner, DVec2::new(view.w, view.h)))
}

/// Millimetres per unit of the `viewBox` along x and y, if the outermost element says how large it
/// is in a unit of length.
pub(super) fn mm_per_unit(root: Node<'_, '_>) -> Option<DVec2> {
    let view = view_box(root)?;
    let mm = |name| {
        let length: Length = root.attribute(name)?.trim().parse().ok()?;
        let mm = match length.unit {
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
        Some(length.number * mm)
    };
    let size = match [mm("width"), mm("height")] {
        [Some(width), Some(height)] => DVec2::new(width, height),
        // The other side is as long as the view makes it.
        [Some(width), None] => DVec2::new(width, width / view.w * view.h),
        [None, Some(height)] => DVec2::new(height / view.h * view.w, height),
        [None, None] => return None,
    };
    let (scale, _) = scale(root, view, size);
    (scale.is_finite() && scale.min_element() > 0.0).then_some(scale)
}
