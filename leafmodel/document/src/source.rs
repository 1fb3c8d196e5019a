//! Texts that a scene is made of, and places in them.
//!
//! Of a table with millions of rows only the rows that reports show are kept, each as a text of its
//! own that knows its line.

use std::ops::Range;

/// A piece of one of the texts: the scene file, an override, or a table of a spectrum.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Which text, an index into [`Sources`].
    pub source: usize,
    /// Bytes of that text, on character boundaries.
    pub span: Range<usize>,
}

/// One text with the name under which reports show it.
#[derive(Clone, Debug)]
pub struct Source {
    /// File name, or `-D` for an override.
    pub name: String,
    /// The text.
    pub text: String,
    /// Line of the file in which the text starts, from 1.
    pub first_line: usize,
}

/// All texts of a scene; number 0 is the scene file.
#[derive(Clone, Debug, Default)]
pub struct Sources(Vec<Source>);

impl Sources {
    /// Takes a text in and gives its number.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> usize {
        self.add_excerpt(name, text, 1)
    }

    /// Takes a piece of a text in, which starts in the given line of its file, and gives its
    /// number.
    pub fn add_excerpt(
        &mut self,
        name: impl Into<String>,
        text: impl Into<String>,
        first_line: usize,
    ) -> usize {
        self.0.push(Source {
            name: name.into(),
            text: text.into(),
            first_line,
        });
        self.0.len() - 1
    }

    /// The text of that number.
    pub fn get(&self, source: usize) -> Option<&Source> {
        self.0.get(source)
    }

    /// A place as `file:line:column`, both counted from 1.
    pub fn shown(&self, place: &Place) -> String {
        let Some(source) = self.get(place.source) else {
            return String::new();
        };
        let before = source.text.get(..place.span.start).unwrap_or("");
        let line = before.matches('\n').count() + source.first_line;
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        format!("{}:{line}:{column}", source.name)
    }

    /// What stands at a place; nothing if it lies outside the text.
    pub fn slice(&self, place: &Place) -> &str {
        self.get(place.source)
            .and_then(|source| source.text.get(place.span.clone()))
            .unwrap_or("")
    }
}

/// Line of a byte, both counted in the usual way: bytes from 0, lines from 1.
pub fn line_of_byte(text: &[u8], byte: usize) -> usize {
    text[..byte.min(text.len())]
        .split(|byte| *byte == b'\n')
        .count()
}

/// Longest piece of a file that a message repeats, in characters.
const LONGEST: usize = 80;

/// A value of a file as messages repeat it: safe to print, and cut if it is long. Every parser
/// passes what it has read through here before it enters a message.
pub fn quoted(text: &str) -> String {
    escaped(text, LONGEST)
}

/// A message of several lines without control characters, whatever is repeated in it.
pub fn printable(message: &str) -> String {
    let lines = message.split('\n').map(|line| escaped(line, usize::MAX));
    lines.collect::<Vec<String>>().join("\n")
}

/// Text from a file, made safe to print: control characters and those that turn the writing
/// direction become visible escapes, and what is longer than `limit` characters is cut.
pub fn escaped(text: &str, limit: usize) -> String {
    let mut safe = String::new();
    for (index, character) in text.chars().enumerate() {
        if index == limit {
            safe.push('…');
            break;
        }
        let turns = matches!(character,
            '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{feff}');
        if character.is_control() || turns {
            safe.extend(character.escape_unicode());
        } else {
            safe.push(character);
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminal_escapes_become_visible_and_long_text_is_cut() {
        assert_eq!(escaped("a\u{1b}[31mb", 20), "a\\u{1b}[31mb");
        assert_eq!(escaped("\u{202e}x", 20), "\\u{202e}x");
        assert_eq!(escaped("abcdef", 3), "abc…");
        assert_eq!(quoted(&"9".repeat(100_000)), "9".repeat(80) + "…");
        assert_eq!(printable("a\u{1b}[2J\nb\u{7}"), "a\\u{1b}[2J\nb\\u{7}");
    }

    #[test]
    fn a_place_knows_its_text_and_a_byte_its_line() {
        let mut sources = Sources::default();
        let source = sources.add("scene.toml", "a = 1\nb = 2\n");
        let place = Place { source, span: 6..7 };
        assert_eq!(sources.slice(&place), "b");
        assert_eq!(sources.shown(&place), "scene.toml:2:1");
        let lines: Vec<usize> = [0, 5, 6, 12, 99]
            .map(|byte| line_of_byte(b"a = 1\nb = 2\n", byte))
            .into();
        assert_eq!(lines, [1, 1, 2, 3, 3]);
    }
}
