//! XML elements with owned attributes and children.
//!
//! - **In**: [`Element`]s with attributes and children; numbers, words and switches as attributes.
//! - **Out**: the text of a [`Document`].
//! - **Always true**: elements are properly nested and closed; names are constants of the program;
//!   values are escaped; numbers read back exactly.
//! - **Left out**: text between elements, namespaces, reading.

use std::fmt::{self, Display, Write as _};

/// Indentation of an element's children, spaces.
const INDENT: usize = 2;

/// An element with its attributes and children.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Element>,
    layout: Layout,
}

/// The layout of an element's children, which matters to human readers only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layout {
    /// On separate lines, indented.
    Indented,
    /// On separate lines, with the indentation of the element itself.
    Level,
    /// On the element's own line.
    Inline,
}

impl Element {
    /// An element without attributes and children.
    pub(crate) fn new(name: &'static str) -> Self {
        Self {
            name,
            attributes: Vec::new(),
            children: Vec::new(),
            layout: Layout::Indented,
        }
    }

    /// Appends an attribute. A number is written with as many digits as are needed to read it back
    /// exactly.
    pub(crate) fn with(mut self, name: &'static str, value: impl Display) -> Self {
        self.attributes.push((name, value.to_string()));
        self
    }

    /// Appends a child.
    pub(crate) fn holding(mut self, child: Self) -> Self {
        self.children.push(child);
        self
    }

    /// Appends children.
    pub(crate) fn holding_all(mut self, children: impl IntoIterator<Item = Self>) -> Self {
        self.children.extend(children);
        self
    }

    /// Sets the layout of its children.
    pub(crate) fn laid_out(self, layout: Layout) -> Self {
        Self { layout, ..self }
    }

    /// Writes it, indented by `indent` spaces, without a final newline.
    fn write(&self, text: &mut String, indent: usize) {
        self.write_start(text);
        if self.children.is_empty() {
            text.push_str("/>");
            return;
        }
        text.push('>');
        let (inside, separate) = match self.layout {
            Layout::Indented => (indent + INDENT, true),
            Layout::Level => (indent, true),
            Layout::Inline => (indent, false),
        };
        for child in &self.children {
            if separate {
                next_line(text, inside);
            }
            child.write(text, inside);
        }
        if separate {
            next_line(text, indent);
        }
        text.push_str("</");
        text.push_str(self.name);
        text.push('>');
    }

    /// Writes its start tag up to the closing bracket.
    fn write_start(&self, text: &mut String) {
        text.push('<');
        text.push_str(self.name);
        for (name, value) in &self.attributes {
            let _ = write!(text, " {name}=\"");
            push_escaped(text, value);
            text.push('"');
        }
    }
}

impl Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::new();
        self.write(&mut text, 0);
        f.write_str(&text)
    }
}

/// A root element whose children are converted to text one by one, so that a scene of many
/// instances is in memory only once.
#[derive(Debug)]
pub(crate) struct Document {
    root: &'static str,
    text: String,
}

impl Document {
    /// A document with this root and its children so far; children have the indentation of the
    /// root.
    pub(crate) fn new(root: &Element) -> Self {
        let mut text = String::new();
        root.write_start(&mut text);
        text.push_str(">\n");
        let mut document = Self {
            root: root.name,
            text,
        };
        for child in &root.children {
            document.add(child);
        }
        document
    }

    /// Adds a child of the root.
    pub(crate) fn add(&mut self, child: &Element) {
        let _ = writeln!(self.text, "{child}");
    }

    /// The whole text.
    pub(crate) fn finish(mut self) -> String {
        let _ = writeln!(self.text, "</{}>", self.root);
        self.text
    }
}

fn next_line(text: &mut String, indent: usize) {
    text.push('\n');
    text.extend(std::iter::repeat_n(' ', indent));
}

/// Writes the value of an attribute, escaped. Characters that XML cannot hold become U+FFFD.
fn push_escaped(text: &mut String, value: &str) {
    for character in value.chars() {
        match character {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            // Unescaped, these would be read as spaces.
            '\t' | '\n' | '\r' => {
                let _ = write!(text, "&#{};", u32::from(character));
            }
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => text.push(char::REPLACEMENT_CHARACTER),
            _ => text.push(character),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shape with a material and a lamp, with children in every layout.
    fn shape() -> Element {
        let black = Element::new("bsdf").holding(Element::new("float").with("value", 0.5));
        Element::new("shape")
            .with("type", "disk")
            .holding(black.laid_out(Layout::Inline))
            .holding(
                Element::new("emitter")
                    .holding_all([Element::new("a"), Element::new("b")])
                    .laid_out(Layout::Level),
            )
    }

    #[test]
    fn elements_end_inside_of_those_that_hold_them() {
        let root = Element::new("scene").with("version", "3.0.0");
        let mut document = Document::new(&root.holding(shape()));
        let group = Element::new("group").holding(shape());
        document.add(&group.laid_out(Layout::Level));
        let one = "<shape type=\"disk\">\n  <bsdf><float value=\"0.5\"/></bsdf>\n  <emitter>\n  <a/>\n  \
                   <b/>\n  </emitter>\n</shape>\n";
        let expected =
            format!("<scene version=\"3.0.0\">\n{one}<group>\n{one}</group>\n</scene>\n");
        assert_eq!(document.finish(), expected);
    }

    #[test]
    fn what_has_a_meaning_in_xml_is_escaped() {
        let value = "a<b>\"c\" & 'd'\n\u{1}é";
        let expected = "<string value=\"a&lt;b&gt;&quot;c&quot; &amp; 'd'&#10;\u{fffd}é\"/>";
        let element = Element::new("string").with("value", value);
        assert_eq!(element.to_string(), expected);
    }

    #[test]
    fn numbers_read_back_as_they_were() {
        for number in [0.1 + 0.2, 1e-310, -0.0, f64::MAX, 1.0 / 3.0, 1e21] {
            let text = Element::new("float").with("value", number).to_string();
            let written = text.split('"').nth(1).expect("a value");
            let back: f64 = written.parse().expect("a number");
            assert_eq!(back.to_bits(), number.to_bits(), "{written}");
        }
    }
}
