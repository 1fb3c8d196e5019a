//! A document from its file or text, before its blocks are read.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::Read;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use toml::de::DeTable;

use super::context::{Context, QUOTED};
use super::error::{DocumentError, LocatedError};
use super::inheritance::inherit;
use super::other_format::with_equals;
use super::report::{DocumentErrors, Warning};
use super::schema::BlockSchema;
use super::source::{Place, Sources, escaped, line_of_byte};
use super::tree::Table;
use super::{overrides, write};

/// Largest document, bytes.
const MOST_BYTES: u64 = 16 << 20;

/// A file as a tree, with overrides put in and syntax errors noted, before its blocks are read.
#[derive(Debug)]
pub struct Opened {
    /// What its blocks need while they are read.
    pub cx: Context,
    /// Its keys and values.
    pub tree: Table,
    syntax: Vec<LocatedError>,
    /// What is recorded as the document's text: the file, or with overrides what they make of it.
    pub recorded: String,
}

impl Opened {
    /// The file at `path`, with overrides `key=value` written as in the file; the
    /// schema tells their types.
    ///
    /// # Errors
    ///
    /// [`DocumentErrors`] if there is no text to be had.
    pub fn file(
        path: &Path,
        overridden: &[String],
        schema: fn() -> BlockSchema,
    ) -> Result<Self, DocumentErrors> {
        let shown = escaped(&path.display().to_string(), 4 * QUOTED);
        let text =
            read_text(path, &shown).map_err(|error| DocumentErrors::of_a_file(&shown, error))?;
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            Some(_) | None => Path::new("."),
        };
        Self::text(&text, &shown, folder, overridden, schema)
    }

    /// A text; `shown` is what reports call it, and paths start at `folder`.
    ///
    /// # Errors
    ///
    /// [`DocumentErrors`] if the text is too long.
    pub fn text(
        text: &str,
        shown: &str,
        folder: &Path,
        overridden: &[String],
        schema: fn() -> BlockSchema,
    ) -> Result<Self, DocumentErrors> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.len() as u64 > MOST_BYTES {
            let error = too_large(shown, text.len() as u64);
            return Err(DocumentErrors::of_a_file(shown, error));
        }
        let mut sources = Sources::default();
        let source = sources.add(shown, text);
        let cx = Context::new(sources, folder.to_owned());
        let (mut tree, mut syntax) = parsed(text, source);
        if let Some(error) = is_json(text, source) {
            syntax = vec![error];
        }
        if !overridden.is_empty() {
            let schema = schema();
            for text in overridden {
                overrides::apply(&cx, &mut tree, "-D", text, &schema);
            }
        }
        syntax.extend(inherit(&mut tree));
        let recorded = if overridden.is_empty() {
            text.to_owned()
        } else {
            write::to_toml(&tree)
        };
        Ok(Self {
            cx,
            tree,
            syntax,
            recorded,
        })
    }

    /// Another text whose values join this document's, as a tree. Errors of its syntax are noted.
    pub fn also(&mut self, text: &str, shown: &str) -> Table {
        let source = self.cx.sources.borrow_mut().add(shown, text);
        let (tree, syntax) = parsed(text, source);
        self.syntax.extend(syntax);
        tree
    }

    /// What its blocks have noted so far, unless the file has errors of syntax.
    ///
    /// # Errors
    ///
    /// [`DocumentErrors`] with those, and with what was noted of values.
    pub fn into_whole(self) -> Result<Context, DocumentErrors> {
        if self.syntax.is_empty() {
            return Ok(self.cx);
        }
        let (sources, errors, _) = self.cx.into_parts();
        let errors = with_syntax(&sources, self.syntax, errors);
        Err(DocumentErrors::new(Arc::new(sources), errors))
    }

    /// What was read, unless there is any error.
    ///
    /// # Errors
    ///
    /// [`DocumentErrors`] with all that were found.
    pub fn finish<T>(self, read: Option<T>) -> Result<(T, Vec<Warning>), DocumentErrors> {
        let (sources, errors, remarks) = self.cx.into_parts();
        let sources = Arc::new(sources);
        match read {
            Some(read) if self.syntax.is_empty() && errors.is_empty() => {
                let warnings = remarks.into_iter();
                let warnings = warnings.map(|remark| Warning::new(remark, &sources));
                Ok((read, warnings.collect()))
            }
            Some(_) | None => {
                let errors = with_syntax(&sources, self.syntax, errors);
                Err(DocumentErrors::new(sources, errors).after(remarks))
            }
        }
    }
}

/// A text as a tree, and its errors of syntax.
fn parsed(text: &str, source: usize) -> (Table, Vec<LocatedError>) {
    let (parsed, errors) = DeTable::parse_recoverable(text);
    let errors = errors
        .iter()
        .map(|error| syntax_error(text, source, error.message(), error.span()));
    let errors = errors.collect();
    (Table::from_toml(source, parsed.into_inner()), errors)
}

/// All errors in the order of the text. Beside syntax errors only those are kept that are about a
/// value of its own: the rest may be nothing but consequences.
fn with_syntax(
    sources: &Sources,
    mut syntax: Vec<LocatedError>,
    errors: Vec<LocatedError>,
) -> Vec<LocatedError> {
    if syntax.is_empty() {
        let mut errors = errors;
        errors.sort_by_key(order);
        errors.dedup_by(|one, other| is_same(one, other));
        return errors;
    }
    let text = sources.get(0).map_or("", |source| source.text.as_str());
    let ends: Vec<usize> = text.match_indices('\n').map(|(end, _)| end).collect();
    let line_of = |located: &LocatedError| {
        let start = located.at.as_ref().map_or(0, |at| at.span.start);
        ends.partition_point(|end| *end < start)
    };
    let broken: BTreeSet<usize> = syntax.iter().map(line_of).collect();
    let kept = errors.into_iter().filter(|located| {
        let elsewhere = located.at.as_ref().is_some_and(|at| at.source != 0);
        // What the parser puts in place of a broken value has no extent.
        let written = located.at.as_ref().is_some_and(|at| !at.span.is_empty());
        elsewhere
            || (written && located.error.is_about_a_value() && !broken.contains(&line_of(located)))
    });
    // One slip often gives several errors in its line: the first says enough. So does a header that is
    // there twice for all keys below it.
    syntax.sort_by_key(order);
    syntax.dedup_by_key(|located| line_of(located));
    let mut block: Range<usize> = 0..0;
    syntax.retain(|located| {
        let start = located.at.as_ref().map_or(0, |at| at.span.start);
        let is_twice = matches!(located.error, DocumentError::Duplicate { .. });
        if is_twice && block.contains(&start) {
            return false;
        }
        let line = ends
            .get(line_of(located).wrapping_sub(1))
            .map_or(0, |end| end + 1);
        if is_twice && text[line..].trim_start().starts_with('[') {
            let next = text[start..]
                .find("\n[")
                .map_or(text.len(), |at| start + at);
            block = start + 1..next;
        }
        true
    });
    syntax.extend(kept);
    syntax.sort_by_key(order);
    syntax.dedup_by(|one, other| is_same(one, other));
    syntax
}

/// Whether both are one error: a value that others inherit is wrong in all of them.
fn is_same(one: &LocatedError, other: &LocatedError) -> bool {
    one.at.is_some() && one.at == other.at && one.error.to_string() == other.error.to_string()
}

/// By place; errors of the file as a whole come last.
fn order(located: &LocatedError) -> (usize, usize) {
    located
        .at
        .as_ref()
        .map_or((usize::MAX, 0), |at| (at.source, at.span.start))
}

/// The one error of a text that begins as JSON does, and as TOML never does.
fn is_json(text: &str, source: usize) -> Option<LocatedError> {
    let start = text.len() - text.trim_start().len();
    text[start..].starts_with('{').then(|| LocatedError {
        error: DocumentError::Syntax {
            message: "this is JSON, and such files are written in TOML".to_owned(),
            help: Some(
                "write `{ \"film\": { \"rgb\": { \"spp\": 16 } } }` as the line `[film.rgb]` with `spp = 16` below it"
                    .to_owned(),
            ),
        },
        at: Some(Place {
            source,
            span: start..start + 1,
        }),
    })
}

fn syntax_error(
    text: &str,
    source: usize,
    message: &str,
    span: Option<Range<usize>>,
) -> LocatedError {
    let span = span.unwrap_or(text.len()..text.len());
    let error = if message == "duplicate key" {
        let key = text.get(span.clone()).unwrap_or("");
        DocumentError::Duplicate {
            key: escaped(key, QUOTED),
        }
    } else {
        let before = text.get(..span.start).unwrap_or_default();
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        let line = text[start..].lines().next().unwrap_or_default();
        DocumentError::Syntax {
            message: escaped(message, 4 * QUOTED),
            help: with_equals(line).map(|meant| format!("write `{meant}`")),
        }
    };
    let at = Some(Place { source, span });
    LocatedError { error, at }
}

fn read_text(path: &Path, shown: &str) -> Result<String, DocumentError> {
    let shown = shown.to_owned();
    let unreadable = |error: std::io::Error| {
        if error.kind() == std::io::ErrorKind::NotFound {
            DocumentError::FileMissing {
                path: shown.clone(),
                nearest: None,
            }
        } else {
            DocumentError::BadFile {
                path: shown.clone(),
                problem: format!("cannot be read: {error}"),
                help: "name a scene file that is readable".to_owned(),
            }
        }
    };
    // Before it is opened: opening a pipe would wait for its other end.
    let metadata = fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_file() {
        return Err(DocumentError::NotARegularFile { path: shown });
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(MOST_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(too_large(&shown, metadata.len()));
    }
    String::from_utf8(bytes).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        let line = line_of_byte(error.as_bytes(), byte);
        DocumentError::NotUtf8 {
            path: shown.clone(),
            byte,
            line,
        }
    })
}

fn too_large(shown: &str, bytes: u64) -> DocumentError {
    DocumentError::BadFile {
        path: shown.to_owned(),
        problem: format!("has {bytes} bytes, more than the {MOST_BYTES} that are read"),
        help: "put tables and meshes into files of their own".to_owned(),
    }
}
