//! Styles of elements: the cascade of attributes, style sheets and `style`.

use roxmltree::Node;
use simplecss::{
    AttributeOperator, Declaration, DeclarationTokenizer, Element, PseudoClass, StyleSheet,
};
use svgtypes::{Length, LengthUnit};

/// The properties that matter, in the order of [`Declared::values`].
const PROPERTIES: [&str; 10] = [
    "stroke",
    "stroke-width",
    "stroke-opacity",
    "visibility",
    "display",
    "opacity",
    "transform",
    "clip-path",
    "mask",
    "vector-effect",
];

/// What is declared for one element itself.
pub(super) struct Declared<'s> {
    values: [Option<&'s str>; PROPERTIES.len()],
}

impl<'s> Declared<'s> {
    pub(super) fn of(node: Node<'s, 's>, sheet: &StyleSheet<'s>) -> Self {
        let mut values = PROPERTIES.map(|name| node.attribute(name));
        // A transform as an attribute has its own syntax.
        values[6] = None;
        let element = Styled(node);
        let rules = sheet.rules.iter();
        let of_rules = rules
            .filter(|rule| rule.selector.matches(&element))
            .flat_map(|rule| rule.declarations.iter().copied());
        let own = DeclarationTokenizer::from(node.attribute("style").unwrap_or_default());
        let all: Vec<Declaration<'s>> = of_rules.chain(own).collect();
        for is_important in [false, true] {
            for one in all.iter().filter(|one| one.important == is_important) {
                let name = one.name.trim();
                let place = PROPERTIES
                    .iter()
                    .position(|known| known.eq_ignore_ascii_case(name));
                if let Some(place) = place {
                    values[place] = Some(one.value.trim());
                }
            }
        }
        let values = values.map(|value| value.filter(|value| *value != "inherit"));
        Self { values }
    }

    fn get(&self, name: &str) -> Option<&'s str> {
        let place = PROPERTIES.iter().position(|known| *known == name)?;
        self.values[place]
    }

    /// Whether neither the element nor anything in it is seen.
    pub(super) fn is_gone(&self) -> bool {
        self.get("display") == Some("none") || self.get("opacity").is_some_and(is_zero)
    }

    pub(super) fn has_transform(&self) -> bool {
        self.get("transform").is_some_and(|value| value != "none")
    }

    pub(super) fn is_clipped(&self) -> bool {
        ["clip-path", "mask"]
            .into_iter()
            .any(|name| self.get(name).is_some_and(|value| value != "none"))
    }
}

/// The properties that elements inherit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Style<'s> {
    stroke: Option<&'s str>,
    width: Option<&'s str>,
    opacity: Option<&'s str>,
    visibility: Option<&'s str>,
    /// Whether the width of the stroke is in pixels of the page.
    pub(super) is_unscaled: bool,
}

impl<'s> Style<'s> {
    /// The style of an element within one of this style.
    pub(super) fn with(self, declared: &Declared<'s>) -> Self {
        Self {
            stroke: declared.get("stroke").or(self.stroke),
            width: declared.get("stroke-width").or(self.width),
            opacity: declared.get("stroke-opacity").or(self.opacity),
            visibility: declared.get("visibility").or(self.visibility),
            is_unscaled: declared.get("vector-effect") == Some("non-scaling-stroke"),
        }
    }

    pub(super) fn is_hidden(&self) -> bool {
        matches!(self.visibility, Some("hidden" | "collapse"))
    }

    /// Width of the stroke in the element's own units, above 0; `None` if it has none, an error with
    /// what is given if that is no width.
    ///
    /// A width with a unit of length is counted as CSS does, 96 units of the drawing to an inch.
    pub(super) fn stroke_width(&self) -> Result<Option<f64>, String> {
        let is_seen = |stroke: &str| {
            let bare = stroke.trim();
            !bare.is_empty() && bare != "none" && bare != "transparent"
        };
        if !self.stroke.is_some_and(is_seen) || self.opacity.is_some_and(is_zero) {
            return Ok(None);
        }
        let Some(text) = self.width else {
            return Ok(Some(1.0));
        };
        let width = text.trim().parse::<Length>().ok().and_then(units);
        match width {
            Some(width) if width.is_finite() && width >= 0.0 => {
                Ok(Some(width).filter(|width| *width > 0.0))
            }
            Some(_) | None => Err(text.to_owned()),
        }
    }
}

/// A length in units of the drawing, 96 to an inch; `None` for units that depend on something else.
pub(super) fn units(length: Length) -> Option<f64> {
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
}

fn is_zero(opacity: &str) -> bool {
    let number = opacity.trim().trim_end_matches('%').trim();
    number.parse::<f64>().is_ok_and(|number| number <= 0.0)
}

/// The rules of style sheets that begin with `@`.
pub(super) fn at_rules(css: &str) -> Vec<String> {
    let mut bare = String::new();
    let mut rest = css;
    while let Some((before, comment)) = rest.split_once("/*") {
        bare.push_str(before);
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    bare.push_str(rest);
    let mut names: Vec<String> = Vec::new();
    for after in bare.split('@').skip(1) {
        let is_of_name = |c: char| c.is_ascii_alphanumeric() || c == '-';
        let end = after.find(|c| !is_of_name(c)).unwrap_or(after.len());
        let name = format!("@{}", &after[..end.min(40)]);
        // Fonts and the encoding change no shape.
        let is_harmless = ["@", "@font-face", "@charset", "@namespace"].contains(&name.as_str());
        if !is_harmless && !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// An element as selectors see it.
struct Styled<'s>(Node<'s, 's>);

impl Element for Styled<'_> {
    fn parent_element(&self) -> Option<Self> {
        self.0.parent_element().map(Styled)
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.0.prev_sibling_element().map(Styled)
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.0.tag_name().name() == name
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        self.0
            .attribute(name)
            .is_some_and(|value| operator.matches(value))
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        class == PseudoClass::FirstChild && self.0.prev_sibling_element().is_none()
    }
}
