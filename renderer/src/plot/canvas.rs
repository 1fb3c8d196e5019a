//! Lines, marks and text as SVG.

use std::fmt::Write as _;

use crate::checkpoint::PROGRAM;

/// On which side of its place a text stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// It begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// A drawing, pixels from the upper left corner. Styles are attributes: `stroke="#333"`.
#[derive(Clone, Debug)]
pub(crate) struct Canvas {
    size: [f64; 2],
    body: String,
}

impl Canvas {
    pub(crate) fn new(size: [f64; 2]) -> Self {
        let body = String::new();
        Self { size, body }
    }

    /// A part of the drawing with a corner of its own.
    pub(crate) fn shifted(&mut self, [x, y]: [f64; 2], draw: impl FnOnce(&mut Self)) {
        let _ = writeln!(
            self.body,
            "<g transform=\"translate({} {})\">",
            px(x),
            px(y)
        );
        draw(self);
        self.body += "</g>\n";
    }

    /// A part of the drawing in which a click leads to a place of the page.
    pub(crate) fn linked(&mut self, place: &str, draw: impl FnOnce(&mut Self)) {
        let _ = writeln!(self.body, "<a href=\"#{}\">", escaped(place));
        draw(self);
        self.body += "</a>\n";
    }

    pub(crate) fn line(&mut self, from: [f64; 2], to: [f64; 2], style: &str) {
        let [[x1, y1], [x2, y2]] = [from, to].map(|end| end.map(px));
        let _ = writeln!(
            self.body,
            "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {style}/>"
        );
    }

    /// A line through points; nothing without any.
    pub(crate) fn polyline(&mut self, points: impl Iterator<Item = [f64; 2]>, style: &str) {
        let points: Vec<String> = points
            .map(|[x, y]| format!("{},{}", px(x), px(y)))
            .collect();
        if !points.is_empty() {
            let points = points.join(" ");
            let _ = writeln!(
                self.body,
                "<polyline points=\"{points}\" fill=\"none\" {style}/>"
            );
        }
    }

    /// A path in SVG's own words.
    pub(crate) fn path(&mut self, way: &str, style: &str) {
        let _ = writeln!(self.body, "<path d=\"{way}\" {style}/>");
    }

    pub(crate) fn rectangle(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], style: &str) {
        let [x, y, width, height] = [x, y, width, height].map(px);
        let _ = writeln!(
            self.body,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" {style}/>"
        );
    }

    pub(crate) fn circle(&mut self, [x, y]: [f64; 2], radius: f64, style: &str) {
        let [x, y, radius] = [x, y, radius].map(px);
        let _ = writeln!(
            self.body,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {style}/>"
        );
    }

    /// A text, which may hold anything.
    pub(crate) fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, style: &str, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let _ = writeln!(
            self.body,
            "<text x=\"{}\" y=\"{}\"{anchor} {style}>{}</text>",
            px(x),
            px(y),
            escaped(text)
        );
    }

    /// A file of its own, on white.
    pub(crate) fn file(&self) -> String {
        let [width, height] = self.size.map(px);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"11\">\n\
             <desc>Written by Lamina {PROGRAM}.</desc>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{}</svg>\n",
            self.body
        )
    }

    /// A figure of a page, with what it shows for those who cannot see it.
    pub(crate) fn figure(&self, shows: &str) -> String {
        let [width, height] = self.size.map(px);
        format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
            escaped(shows),
            self.body
        )
    }
}

/// A text of which nothing is read as markup, in text or in an attribute. Characters that XML does
/// not allow become U+FFFD.
pub(crate) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            '\'' => safe += "&#39;",
            '\t' | '\n' | '\r' => safe.push(' '),
            '\u{fffe}' | '\u{ffff}' => safe.push('\u{fffd}'),
            letter if letter.is_control() => safe.push('\u{fffd}'),
            letter => safe.push(letter),
        }
    }
    safe
}

/// A length with at most two digits after the point.
fn px(value: f64) -> f64 {
    // Adding 0 turns the negative zero into zero.
    libm::round(value * 100.0) / 100.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_never_markup() {
        assert_eq!(
            escaped("a<b> & \"c\" 'd'\u{1}\n"),
            "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;\u{fffd} "
        );
        let mut canvas = Canvas::new([10.0, 20.0]);
        canvas.text([1.234567, -0.001], Anchor::End, "class=\"x\"", "</svg>");
        canvas.linked("a\"b", |canvas| canvas.circle([1.0, 2.0], 3.0, ""));
        let file = canvas.file();
        assert_eq!(file.matches("</svg>").count(), 1);
        assert!(
            file.contains("x=\"1.23\" y=\"0\" text-anchor=\"end\""),
            "{file}"
        );
        assert!(file.contains("href=\"#a&quot;b\""), "{file}");
        assert!(
            canvas
                .figure("a \"b\"")
                .contains("aria-label=\"a &quot;b&quot;\"")
        );
    }
}
