//! GML: what networkx, Gephi, yEd and igraph write.

use std::borrow::Cow;

use super::draft::Draft;
use super::error::ImportError;
use super::graph::{Builder, Text};

/// Greatest depth of lists in lists.
const DEEPEST: usize = 64;

/// Reads the first graph of a GML text.
///
/// # Errors
///
/// [`ImportError`] if it is no GML, holds no graph, or a value cannot be read.
pub(super) fn read(text: &str) -> Result<Draft, ImportError> {
    let mut words = Words {
        rest: text,
        line: 1,
    };
    let file = list(&mut words, 0)?;
    let is_of = |name: &'static str| move |entry: &&Entry<'_>| entry.is(name);
    let graph = file.iter().find(is_of("graph")).and_then(Entry::list);
    let graph = graph.ok_or_else(|| malformed(1, "it has no graph [ … ]"))?;
    let directed = graph.iter().find(is_of("directed"));
    let mut builder = Builder::new(directed.is_some_and(|entry| entry.text() == "1"));
    for node in graph.iter().filter(is_of("node")) {
        let place = &|| format!("line {}", node.line);
        let members = node.list().unwrap_or_default();
        builder.node();
        let id = members.iter().find(is_of("id"));
        let id = id.ok_or_else(|| ImportError::at(place(), "a node has no id"))?;
        builder.name(id.text());
        // The place may be in a list of its own, as graphics.
        let inner = members.iter().filter(is_of("graphics"));
        let inner = inner.flat_map(|entry| entry.list().unwrap_or_default());
        let own = members.iter().filter(|entry| !entry.is("graphics"));
        for entry in gathered(inner.chain(own)) {
            let (key, value) = (entry.key, &entry.text());
            builder.node_entry(Text { key, value, place })?;
        }
        builder.node_is_done(place)?;
    }
    builder.nodes_are_done("nodes".to_owned())?;
    for edge in graph.iter().filter(is_of("edge")) {
        let place = &|| format!("line {}", edge.line);
        let members = edge.list().unwrap_or_default();
        builder.edge();
        for entry in gathered(members) {
            let (key, value) = (entry.key, &entry.text());
            builder.edge_entry(Text { key, value, place })?;
        }
        builder.edge_is_done(place);
    }
    Ok(builder.done())
}

fn malformed(line: u32, problem: &str) -> ImportError {
    ImportError::malformed("GML", format!("line {line}: {problem}"))
}

/// A key with its value.
#[derive(Clone)]
struct Entry<'t> {
    key: &'t str,
    line: u32,
    value: Value<'t>,
}

#[derive(Clone)]
enum Value<'t> {
    Text(Cow<'t, str>),
    List(Vec<Entry<'t>>),
}

impl<'t> Entry<'t> {
    fn is(&self, key: &str) -> bool {
        self.key.eq_ignore_ascii_case(key)
    }

    fn list(&self) -> Option<&[Entry<'t>]> {
        match &self.value {
            Value::Text(_) => None,
            Value::List(list) => Some(list),
        }
    }

    /// The value as text, lists as their values with spaces between.
    fn text(&self) -> String {
        match &self.value {
            Value::Text(text) => text.clone().into_owned(),
            Value::List(list) => {
                let texts: Vec<String> = list.iter().map(Entry::text).collect();
                texts.join(" ")
            }
        }
    }
}

/// Entries with the values of those that are repeated put together: lists are written so.
fn gathered<'a, 't: 'a>(entries: impl IntoIterator<Item = &'a Entry<'t>>) -> Vec<Entry<'t>> {
    let mut all: Vec<Entry<'t>> = Vec::new();
    for entry in entries {
        match all.iter_mut().find(|known| known.key == entry.key) {
            Some(known) => {
                known.value = Value::Text(format!("{} {}", known.text(), entry.text()).into());
            }
            None => all.push(entry.clone()),
        }
    }
    all
}

/// Keys and values up to the end of a list or of the text.
fn list<'t>(words: &mut Words<'t>, depth: usize) -> Result<Vec<Entry<'t>>, ImportError> {
    if depth > DEEPEST {
        return Err(malformed(words.line, "lists are nested more than 64 deep"));
    }
    let mut entries = Vec::new();
    loop {
        let (key, line) = (words.next()?, words.line);
        let key = match key {
            None if depth == 0 => return Ok(entries),
            None => return Err(malformed(line, "a list is not closed by ]")),
            Some(Word::Close) if depth > 0 => return Ok(entries),
            Some(Word::Bare(key)) => key,
            Some(Word::Close | Word::Open | Word::Quoted(_)) => {
                return Err(malformed(line, "a key is wanted, as in x 1.5"));
            }
        };
        let value = match words.next()? {
            Some(Word::Bare(text)) => Value::Text(text.into()),
            Some(Word::Quoted(text)) => Value::Text(text),
            Some(Word::Open) => Value::List(list(words, depth + 1)?),
            Some(Word::Close) | None => {
                return Err(malformed(words.line, "a key has no value"));
            }
        };
        entries.push(Entry { key, line, value });
    }
}

enum Word<'t> {
    Open,
    Close,
    Bare(&'t str),
    Quoted(Cow<'t, str>),
}

/// The words of a text, with the line of the last one.
struct Words<'t> {
    rest: &'t str,
    line: u32,
}

impl<'t> Words<'t> {
    fn take(&mut self, length: usize) -> &'t str {
        let (taken, rest) = self.rest.split_at(length);
        self.line += taken.matches('\n').count() as u32;
        self.rest = rest;
        taken
    }

    fn next(&mut self) -> Result<Option<Word<'t>>, ImportError> {
        loop {
            let blank = self.rest.len() - self.rest.trim_start().len();
            self.take(blank);
            if !self.rest.starts_with('#') {
                break;
            }
            let end = self.rest.find('\n').unwrap_or(self.rest.len());
            self.take(end);
        }
        let Some(first) = self.rest.chars().next() else {
            return Ok(None);
        };
        let word = match first {
            '[' | ']' => {
                self.take(1);
                if first == '[' {
                    Word::Open
                } else {
                    Word::Close
                }
            }
            '"' => {
                let end = self.rest[1..].find('"');
                let end = end.ok_or_else(|| malformed(self.line, "a text is not closed by \""))?;
                let quoted = self.take(end + 2);
                Word::Quoted(unescaped(&quoted[1..=end]))
            }
            _ => {
                let end = self
                    .rest
                    .find(|c: char| c.is_whitespace() || "[]\"".contains(c));
                let end = end.unwrap_or(self.rest.len());
                Word::Bare(self.take(end))
            }
        };
        Ok(Some(word))
    }
}

/// A text with its characters in place of the entities that names of nodes have.
fn unescaped(text: &str) -> Cow<'_, str> {
    if !text.contains('&') {
        return text.into();
    }
    let known = [
        ("&quot;", "\""),
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&#181;", "µ"),
        ("&amp;", "&"),
    ];
    let plain = known
        .into_iter()
        .fold(text.to_owned(), |text, (entity, letter)| {
            text.replace(entity, letter)
        });
    plain.into()
}
