//! Drawings: the shapes of an SVG file as they are drawn, and what else is in it.
//!
//! - **In**: an SVG document and the text of its style sheets.
//! - **Out**: [`Drawing`]: every path and basic shape in the order of the document, those that
//!   `<use>` repeats included, with its transform, stroke and vein order; and what is left out.
//! - **Always true**: styles follow the cascade: presentation attributes, then rules by their
//!   specificity, then `style`, then whatever is `!important`.
//! - **Left out**: texts and pictures, clip paths and masks, at-rules, transforms in styles.
//!
//! # Source
//!
//! \[svg2\], chapters 5 (structure), 6 (styling), 8 (coordinates) and 10 (basic shapes).

mod forms;
mod path_data;
mod style;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use glam::{DAffine2, DVec2};
use roxmltree::{Document, Node, ParsingOptions};
use simplecss::StyleSheet;
use svgtypes::{TransformListParser, TransformListToken};

pub(crate) use self::forms::BadAttribute;
use self::style::{Declared, Style};
use super::cubic::Cubic;

/// Most elements that `<use>` may draw, and how deep such elements may be nested.
const MOST_USED: usize = 1_000_000;
const DEEPEST_USE: u32 = 32;

/// How many places of one reason are named.
const NAMED: usize = 5;

/// Elements that hold templates, clips and the like: what is within them is not drawn there.
const TEMPLATES: [&str; 9] = [
    "defs",
    "clipPath",
    "mask",
    "pattern",
    "symbol",
    "marker",
    "font",
    "linearGradient",
    "radialGradient",
];

/// Elements that show something that is no shape.
const NO_SHAPES: [&str; 6] = [
    "text",
    "image",
    "foreignObject",
    "video",
    "canvas",
    "iframe",
];

/// The namespaces of SVG and of links.
const SVG: &str = "http://www.w3.org/2000/svg";
const LINK: (&str, &str) = ("http://www.w3.org/1999/xlink", "href");
const LABEL: (&str, &str) = ("http://www.inkscape.org/namespaces/inkscape", "label");

/// Where a shape is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Standing {
    /// It is drawn.
    Drawn,
    /// It, or a group around it, is hidden.
    Hidden,
    /// It is part of a template or a clip.
    Template,
}

/// A path or basic shape.
#[derive(Clone, Debug)]
pub(crate) struct Shape<'s> {
    pub(crate) node: Node<'s, 's>,
    pub(crate) standing: Standing,
    /// Vein order by the name of the nearest group that has one.
    pub(crate) order: Option<u8>,
    to_root: Result<DAffine2, BadAttribute>,
    style: Style<'s>,
}

/// Why something of a drawing is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Reason {
    /// It is hidden.
    Hidden,
    /// It is no shape: a text, a picture.
    NoShape,
    /// It is a clip path or a mask.
    Clip,
    /// It is a rule of a style sheet with `@`, or a style sheet in another file.
    Rule,
}

impl Reason {
    /// What it is, for a sentence.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Hidden => "elements of the drawing are hidden",
            Self::NoShape => "elements of the drawing are neither paths nor basic shapes",
            Self::Clip => "clip paths and masks of the drawing are not applied",
            Self::Rule => "parts of style sheets are not understood",
        }
    }
}

/// What is left out for one reason.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct LeftOut {
    /// How many elements.
    pub(crate) count: usize,
    /// The first of them, with their lines.
    pub(crate) names: Vec<String>,
}

/// The shapes of a drawing.
#[derive(Clone, Debug)]
pub(crate) struct Drawing<'s> {
    pub(crate) shapes: Vec<Shape<'s>>,
    pub(crate) left_out: BTreeMap<Reason, LeftOut>,
    /// Millimetres per unit of the drawing along x and y, if the outermost element gives its size.
    pub(crate) mm_per_unit: Option<DVec2>,
}

/// Reads the XML of a drawing.
///
/// # Errors
///
/// What the parser says, or that the outermost element is not `<svg>`.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, String> {
    // Drawing programs write a document type with entities into their files.
    let options = ParsingOptions {
        allow_dtd: true,
        nodes_limit: u32::MAX,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options).map_err(|e| e.to_string())?;
    let root = document.root_element().tag_name().name();
    if root != "svg" {
        return Err(format!("its outermost element is <{root}>"));
    }
    Ok(document)
}

/// The text of all style sheets in a document.
pub(crate) fn style_sheets(document: &Document<'_>) -> String {
    let sheets = document
        .descendants()
        .filter(|node| node.is_element() && node.tag_name().name() == "style");
    let texts = sheets.flat_map(|sheet| sheet.children().filter_map(|child| child.text()));
    texts.collect::<Vec<_>>().join("\n")
}

impl<'s> Drawing<'s> {
    /// Reads the shapes; `css` is what [`style_sheets`] gives.
    ///
    /// # Errors
    ///
    /// If `<use>` draws more than a million elements.
    pub(crate) fn read(document: &'s Document<'s>, css: &'s str) -> Result<Self, String> {
        let root = document.root_element();
        let mut walk = Walk {
            document,
            sheet: StyleSheet::parse(css),
            ids: BTreeMap::new(),
            used: 0,
            drawing: Self {
                shapes: Vec::new(),
                left_out: BTreeMap::new(),
                mm_per_unit: forms::mm_per_unit(root),
            },
        };
        for node in document.descendants() {
            if let Some(id) = node.attribute("id") {
                walk.ids.entry(id).or_insert(node);
            }
            if node
                .pi()
                .is_some_and(|instruction| instruction.target == "xml-stylesheet")
            {
                walk.leave_out(Reason::Rule, node, "a style sheet in another file");
            }
        }
        for rule in style::at_rules(css) {
            let left = walk.drawing.left_out.entry(Reason::Rule).or_default();
            left.count += 1;
            left.names.push(rule);
        }
        walk.through(root)?;
        Ok(walk.drawing)
    }

    /// How much taller the drawing is drawn than its coordinates say, compared with its width: 1
    /// unless `preserveAspectRatio` is `none`.
    pub(crate) fn stretch(&self) -> f64 {
        self.mm_per_unit.map_or(1.0, |mm| mm.y / mm.x)
    }

    /// The shapes that are drawn.
    pub(crate) fn drawn(&self) -> impl Iterator<Item = &Shape<'s>> {
        self.shapes
            .iter()
            .filter(|shape| shape.standing == Standing::Drawn)
    }
}

impl Shape<'_> {
    /// Whether it is a `<path>`.
    pub(crate) fn is_path(&self) -> bool {
        self.node.tag_name().name() == "path"
    }

    /// Whether its `id` or its label in Inkscape is this name.
    pub(crate) fn is_called(&self, name: &str) -> bool {
        self.node.attribute("id") == Some(name) || self.node.attribute(LABEL) == Some(name)
    }

    /// The transform to the coordinates of the outermost element.
    ///
    /// # Errors
    ///
    /// [`BadAttribute`] if a transform cannot be read.
    pub(crate) fn to_root(&self) -> Result<DAffine2, BadAttribute> {
        self.to_root.clone()
    }

    /// Its path data, in its own coordinates; empty if there is nothing to draw.
    ///
    /// # Errors
    ///
    /// [`BadAttribute`] if a length cannot be read.
    pub(crate) fn data(&self) -> Result<String, BadAttribute> {
        forms::data(self.node)
    }

    /// Its parts as cubics in the coordinates of the outermost element.
    ///
    /// # Errors
    ///
    /// [`BadAttribute`] if path data, a length or a transform cannot be read.
    pub(crate) fn parts(&self) -> Result<Vec<Vec<Cubic>>, BadAttribute> {
        let whole = self.to_root()?;
        let parts = path_data::parts(&self.data()?);
        let mut parts = parts.map_err(|problem| BadAttribute {
            attribute: "d",
            problem,
        })?;
        for cubic in parts.iter_mut().flatten() {
            cubic.0 = cubic.0.map(|p| whole.transform_point2(p));
        }
        Ok(parts)
    }

    /// Whether its stroke is wider along one direction than along another.
    pub(crate) fn is_unevenly_scaled(&self, mm_per_unit: Option<DVec2>) -> bool {
        const ROUNDING: f64 = 1e-3;
        let Ok(whole) = &self.to_root else {
            return false;
        };
        let whole = DAffine2::from_scale(mm_per_unit.unwrap_or(DVec2::ONE)) * *whole;
        let (x, y) = (whole.matrix2.x_axis, whole.matrix2.y_axis);
        let area = whole.matrix2.determinant().abs();
        let off = (x.length_squared() - y.length_squared()).hypot(2.0 * x.dot(y));
        !self.style.is_unscaled && off > ROUNDING * area
    }

    /// Width of its stroke in units of the outermost element, above 0; `None` without a stroke.
    ///
    /// # Errors
    ///
    /// What `stroke-width` is, if that is no width.
    pub(crate) fn stroke_width(&self, mm_per_unit: Option<DVec2>) -> Result<Option<f64>, String> {
        let Some(width) = self.style.stroke_width()? else {
            return Ok(None);
        };
        let area = |scale: DVec2| (scale.x * scale.y).sqrt();
        let scale = if self.style.is_unscaled {
            // Pixels of the page.
            mm_per_unit.map_or(1.0, |mm| forms::MM_PER_PIXEL / area(mm))
        } else {
            let whole = self
                .to_root
                .as_ref()
                .map_or(1.0, |whole| whole.matrix2.determinant());
            whole.abs().sqrt()
        };
        Ok(Some(width * scale))
    }
}

/// What an element has from those around it.
#[derive(Clone)]
struct Around<'s> {
    to_root: Result<DAffine2, BadAttribute>,
    style: Style<'s>,
    standing: Standing,
    order: Option<u8>,
    /// Size of the viewport, for nested elements that do not give their own.
    viewport: DVec2,
    uses: u32,
    /// Size that a `<use>` asks of the symbol that it draws.
    asked: [Option<f64>; 2],
    /// Whether the element is drawn by a `<use>`, though it is a symbol.
    is_used: bool,
}

struct Walk<'s> {
    document: &'s Document<'s>,
    sheet: StyleSheet<'s>,
    ids: BTreeMap<&'s str, Node<'s, 's>>,
    used: usize,
    drawing: Drawing<'s>,
}

impl<'s> Walk<'s> {
    fn through(&mut self, root: Node<'s, 's>) -> Result<(), String> {
        let around = Around {
            to_root: Ok(DAffine2::IDENTITY),
            style: Style::default(),
            standing: Standing::Drawn,
            order: None,
            viewport: forms::view_box(root).map_or(DVec2::ONE, |view| DVec2::new(view.w, view.h)),
            uses: 0,
            asked: [None; 2],
            is_used: false,
        };
        let mut open = vec![(root, around)];
        while let Some((node, around)) = open.pop() {
            if around.uses > 0 {
                self.used += 1;
                if self.used > MOST_USED {
                    return Err(format!(
                        "its <use> elements draw more than {MOST_USED} elements"
                    ));
                }
            }
            let Some(within) = self.enter(node, around) else {
                continue;
            };
            if node.tag_name().name() == "use" {
                open.extend(self.target(node, within));
                continue;
            }
            let first = open.len();
            let mut children: Vec<_> = node.children().filter(Node::is_element).collect();
            if node.tag_name().name() == "switch" {
                let chosen = children.iter().position(applies);
                let chosen = chosen.map(|at| children.remove(at));
                if within.standing == Standing::Drawn {
                    for child in children {
                        self.leave_out(Reason::Hidden, child, "another of its <switch> is drawn");
                    }
                }
                children = chosen.into_iter().collect();
            }
            open.extend(children.into_iter().map(|child| (child, within.clone())));
            open[first..].reverse();
        }
        Ok(())
    }

    /// Takes in an element: a shape, or what is around its children.
    fn enter(&mut self, node: Node<'s, 's>, around: Around<'s>) -> Option<Around<'s>> {
        let name = node.tag_name().name();
        if node
            .tag_name()
            .namespace()
            .is_some_and(|space| space != SVG)
            || name == "style"
        {
            return None;
        }
        let declared = Declared::of(node, &self.sheet);
        let mut within = Around {
            is_used: false,
            asked: [None; 2],
            ..around.clone()
        };
        within.style = around.style.with(&declared);
        within.order = order_of(node).or(around.order);
        if TEMPLATES.contains(&name) && !(around.is_used && name == "symbol") {
            within.standing = Standing::Template;
        }
        let is_shown = within.standing == Standing::Drawn;
        if is_shown && NO_SHAPES.contains(&name) && !declared.is_gone() {
            self.leave_out(Reason::NoShape, node, "");
            return None;
        }
        if is_shown && declared.is_gone() {
            self.leave_out(Reason::Hidden, node, "");
            within.standing = Standing::Hidden;
        }
        let is_shape = forms::SHAPES.contains(&name);
        if is_shape && within.standing == Standing::Drawn && within.style.is_hidden() {
            self.leave_out(Reason::Hidden, node, "");
            within.standing = Standing::Hidden;
        }
        if declared.is_clipped() && within.standing == Standing::Drawn {
            self.leave_out(Reason::Clip, node, "");
        }
        within.to_root = around.to_root.and_then(|outer| {
            let own = own_transform(node, &declared)?;
            // The outermost element's own viewport gives the scale.
            let is_viewport = matches!(name, "svg" | "symbol") && node.parent_element().is_some();
            let view = if is_viewport {
                let (to_outer, size) = forms::viewport(node, around.asked, around.viewport)?;
                within.viewport = size;
                to_outer
            } else {
                DAffine2::IDENTITY
            };
            Ok(outer * own * view)
        });
        if !is_shape {
            return Some(within);
        }
        self.drawing.shapes.push(Shape {
            node,
            standing: within.standing,
            order: within.order,
            to_root: within.to_root,
            style: within.style,
        });
        None
    }

    /// What a `<use>` draws, with what is around it.
    fn target(
        &mut self,
        node: Node<'s, 's>,
        mut around: Around<'s>,
    ) -> Option<(Node<'s, 's>, Around<'s>)> {
        let link = node.attribute("href").or_else(|| node.attribute(LINK));
        let link = link.unwrap_or_default();
        let target = link.strip_prefix('#').and_then(|id| self.ids.get(id));
        let Some(&target) = target.filter(|_| around.uses < DEEPEST_USE) else {
            if around.standing == Standing::Drawn {
                self.leave_out(Reason::NoShape, node, link);
            }
            return None;
        };
        let read = |name| forms::length(node, name, Some(around.viewport));
        let moved = read("x").and_then(|x| {
            let at = DVec2::new(x.unwrap_or(0.0), read("y")?.unwrap_or(0.0));
            let asked = [read("width")?, read("height")?];
            Ok((at, asked))
        });
        around.to_root = around.to_root.and_then(|outer| {
            let (at, asked) = moved?;
            around.asked = asked;
            Ok(outer * DAffine2::from_translation(at))
        });
        around.uses += 1;
        around.is_used = true;
        Some((target, around))
    }

    fn leave_out(&mut self, reason: Reason, node: Node<'s, 's>, what: &str) {
        let left = self.drawing.left_out.entry(reason).or_default();
        left.count += 1;
        if left.names.len() < NAMED {
            // To find a line takes as long as the text before it.
            let line = self.document.text_pos_at(node.range().start).row;
            let mut name = format!("line {line}");
            if node.is_element() {
                let _ = write!(name, " <{}>", node.tag_name().name());
            }
            let label = node.attribute(LABEL).or_else(|| node.attribute("id"));
            let label = if what.is_empty() {
                label.unwrap_or_default()
            } else {
                what
            };
            if !label.is_empty() {
                let label: String = label.chars().take(40).collect();
                let _ = write!(name, " {label:?}");
            }
            left.names.push(name);
        }
    }
}

/// Whether an element of a `<switch>` may be the one that is drawn: it needs no extension, and its
/// text is English if it is in some language. Features are all there, as SVG 2 has it.
fn applies(node: &Node<'_, '_>) -> bool {
    let is_english = |tags: &str| {
        let mut tags = tags.split(',').map(str::trim);
        tags.any(|tag| {
            tag.split('-')
                .next()
                .is_some_and(|main| main.eq_ignore_ascii_case("en"))
        })
    };
    node.attribute("requiredExtensions").is_none()
        && node.attribute("systemLanguage").is_none_or(is_english)
}

/// The number behind `order-` in the name of a group, or in its label in Inkscape.
fn order_of(node: Node<'_, '_>) -> Option<u8> {
    let names = [node.attribute("id"), node.attribute(LABEL)];
    let orders = names.into_iter().flatten();
    orders
        .filter_map(|name| name.strip_prefix("order-")?.parse().ok())
        .find(|order| *order > 0)
}

/// The transform of an element itself.
fn own_transform(node: Node<'_, '_>, declared: &Declared<'_>) -> Result<DAffine2, BadAttribute> {
    if declared.has_transform() {
        return Err(BadAttribute {
            attribute: "style",
            problem: "write the transform as an attribute of its own".to_owned(),
        });
    }
    let mut own = DAffine2::IDENTITY;
    for token in TransformListParser::from(node.attribute("transform").unwrap_or_default()) {
        own *= affine(token.map_err(|error| BadAttribute {
            attribute: "transform",
            problem: error.to_string(),
        })?);
    }
    Ok(own)
}

fn affine(token: TransformListToken) -> DAffine2 {
    let linear = |a, b, c, d| DAffine2::from_cols_array(&[a, b, c, d, 0.0, 0.0]);
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
