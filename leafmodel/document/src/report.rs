//! Errors and warnings of a scene as text: file, line, the piece meant, and what to write instead.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::context::{ENOUGH, Remark};
use super::error::{DocumentError, LocatedError};
use super::source::{Place, Sources, line_of_byte};

/// Most errors, warnings or notes that are written out.
pub const SHOWN: usize = 100;
/// Most bytes of a line on either side of the piece meant.
const AROUND: usize = 400;

/// Everything that is wrong with a scene.
///
/// `Display` gives the whole report without colours.
#[derive(Clone, Debug)]
pub struct DocumentErrors {
    sources: Arc<Sources>,
    errors: Vec<LocatedError>,
    /// What was noted before: the cause of an error may be there.
    remarks: Vec<Remark>,
}

impl DocumentErrors {
    /// At least one error, with the texts they point into.
    pub fn new(sources: Arc<Sources>, errors: Vec<LocatedError>) -> Self {
        debug_assert!(!errors.is_empty(), "a scene is refused for a reason");
        Self {
            sources,
            errors,
            remarks: Vec::new(),
        }
    }

    /// The same with remarks, which reports show first.
    #[must_use]
    pub fn after(self, remarks: Vec<Remark>) -> Self {
        Self { remarks, ..self }
    }

    /// One error of a file whose text could not be had.
    pub(crate) fn of_a_file(name: &str, error: DocumentError) -> Self {
        let mut sources = Sources::default();
        sources.add(name, "");
        Self::new(Arc::new(sources), vec![LocatedError { error, at: None }])
    }

    /// The errors in the order of the text.
    pub fn errors(&self) -> &[LocatedError] {
        &self.errors
    }

    /// The texts that the errors point into.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// The report; `colour` adds terminal escapes.
    pub fn render(&self, colour: bool) -> String {
        let mut text = String::new();
        for remark in self.remarks.iter().take(SHOWN) {
            text.push_str(&rendered(remark, &self.sources, colour));
            text.push_str("\n\n");
        }
        if let Some(more) = self.remarks.len().checked_sub(SHOWN + 1) {
            text.extend(["… and ", &(more + 1).to_string(), " more warnings\n\n"]);
        }
        for located in self.errors.iter().take(SHOWN) {
            let piece = Piece {
                level: Level::ERROR,
                code: located.error.code(),
                message: located.error.to_string(),
                label: located.error.label(),
                help: located.error.help(),
                at: located.at.as_ref(),
            };
            text.push_str(&piece.render(&self.sources, colour));
            text.push_str("\n\n");
        }
        let count = self.errors.len();
        // Reading ends with that many.
        let at_least = if count >= ENOUGH { "at least " } else { "" };
        if count > SHOWN {
            let more = (count - SHOWN).to_string();
            text.extend(["… and ", at_least, &more, " more\n\n"]);
        }
        let name = self
            .sources
            .get(0)
            .map_or("", |source| source.name.as_str());
        let errors = if count == 1 { "error" } else { "errors" };
        text.extend([name, ": ", at_least, &count.to_string(), " ", errors]);
        text
    }
}

impl fmt::Display for DocumentErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for DocumentErrors {}

/// Something in a scene that is allowed but probably not meant.
///
/// `Display` gives the report without colours.
#[derive(Clone, Debug)]
pub struct Warning {
    remark: Remark,
    sources: Arc<Sources>,
}

impl Warning {
    /// A remark with the texts it points into.
    pub fn new(remark: Remark, sources: &Arc<Sources>) -> Self {
        Self {
            remark,
            sources: Arc::clone(sources),
        }
    }

    /// The stable name of the kind of warning.
    pub fn code(&self) -> &'static str {
        self.remark.code
    }

    /// What is the matter, in one sentence.
    pub fn message(&self) -> &str {
        &self.remark.message
    }

    /// The report; `colour` adds terminal escapes.
    pub fn render(&self, colour: bool) -> String {
        rendered(&self.remark, &self.sources, colour)
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

/// A remark as a warning.
fn rendered(remark: &Remark, sources: &Sources, colour: bool) -> String {
    let piece = Piece {
        level: Level::WARNING,
        code: remark.code,
        message: remark.message.clone(),
        label: "here",
        help: Some(remark.help.clone()),
        at: remark.at.as_ref(),
    };
    piece.render(sources, colour)
}

struct Piece<'p> {
    level: Level<'static>,
    code: &'static str,
    message: String,
    label: &'static str,
    help: Option<String>,
    at: Option<&'p Place>,
}

impl Piece<'_> {
    fn render(self, sources: &Sources, colour: bool) -> String {
        let renderer = if colour {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        let title = self.level.primary_title(self.message).id(self.code);
        let help = self.help.map(|help| Level::HELP.message(help));
        let source = self.at.and_then(|at| Some((sources.get(at.source)?, at)));
        let Some((source, at)) = source else {
            let name = sources.get(0).map_or("", |source| source.name.as_str());
            let group = title
                .element(annotate_snippets::Origin::path(name))
                .elements(help);
            return renderer.render(&[group]);
        };
        let mut window = Window::around(&source.text, &at.span);
        window.line += source.first_line - 1;
        let mut snippet = Snippet::source(window.text)
            .line_start(window.line)
            .annotation(AnnotationKind::Primary.span(window.span).label(self.label));
        let mut origin = None;
        if window.starts_inside_a_line {
            // The snippet cannot know the column of a line that it does not see whole.
            let place = annotate_snippets::Origin::path(&source.name);
            origin = Some(place.line(window.line).char_column(window.column));
        } else {
            snippet = snippet.path(&source.name);
        }
        let group = title.elements(origin).element(snippet).elements(help);
        renderer.render(&[group])
    }
}

/// The piece of a text that a report shows: a line, or some lines, or part of a very long one.
struct Window<'t> {
    text: &'t str,
    span: Range<usize>,
    line: usize,
    column: usize,
    starts_inside_a_line: bool,
}

impl<'t> Window<'t> {
    fn around(text: &'t str, span: &Range<usize>) -> Self {
        let boundary = |mut at: usize| {
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            at
        };
        let from = boundary(span.start.min(text.len()));
        let line_start = text[..from].rfind('\n').map_or(0, |end| end + 1);
        let start = boundary(line_start.max(from.saturating_sub(AROUND)));
        let line_end = text[from..].find('\n').map_or(text.len(), |end| from + end);
        // A span over several lines is shown by its first one.
        let to = boundary(span.end.clamp(from, line_end));
        let end = boundary(line_end.min(to.max(from) + AROUND));
        let shown = text[start..end].trim_end_matches('\r');
        let last = start + shown.len();
        Self {
            text: shown,
            span: from.min(last) - start..to.min(last) - start,
            line: line_of_byte(text.as_bytes(), from),
            column: 1 + text[line_start..from].chars().count(),
            starts_inside_a_line: start > line_start,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_shows_one_line_whole_and_a_long_one_in_part() {
        let window = Window::around("a = 1\nbb = 22\r\nc", &(11..13));
        assert_eq!(
            (window.text, window.span, window.line),
            ("bb = 22", 5..7, 2)
        );
        assert!(!window.starts_inside_a_line);
        let long = format!("x = [{}]", "1, ".repeat(10_000));
        let window = Window::around(&long, &(20_000..20_001));
        assert!(window.text.len() <= 2 * AROUND + 1 && window.starts_inside_a_line);
        assert_eq!(window.column, 20_001);
    }

    #[test]
    fn a_window_keeps_to_characters_whatever_the_span() {
        let text = "ä\nöü\n";
        for start in 0..=text.len() + 2 {
            for end in start..=text.len() + 2 {
                let window = Window::around(text, &(start..end));
                assert!(
                    window.text.get(window.span.clone()).is_some(),
                    "{start}..{end}"
                );
            }
        }
    }
}
