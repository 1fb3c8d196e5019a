//! `lamina optics --table`: a leaf in each row of a table, and the spectra of all of them.

use std::collections::HashSet;
use std::io::Write;
use std::path::Path;

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::limits::Limits;
use leafmodel::document::nearest::nearest;
use leafmodel::document::report::DocumentErrors;
use leafmodel::document::rows::{Field, Form, Rows};
use leafmodel::document::source::{Sources, escaped};
use leafmodel::optics::Constituent;

use super::leaf::{self, Chosen, warn_of_mixtures};
use crate::cli::arguments::OpticsArguments;
use crate::cli::model;
use crate::cli::places::{check_outputs, is_stdout, require_ending};
use crate::cli::terminal::{Failure, note, note_output, say};
use crate::cli::texts::text_of;
use crate::image::atomic;
use crate::provenance::{Provenance, Settings, hash_of};
use crate::report::optics::spectra::{self, Leaves};

/// Names of the column that names leaves.
const IDENTITIES: [&str; 5] = ["leaf", "id", "name", "sample", "case"];
/// Columns of `lamina fit` that are no contents, beside those of standard errors.
const OF_FITS: [&str; 4] = ["face_contrast", "rms", "values", "reasons"];

const EMPTY: &str = "has an empty value";

pub(super) fn run(
    arguments: &OpticsArguments,
    settings: &Settings,
    table: &Path,
    out: &Path,
) -> Result<(), Failure> {
    let is_stdout = is_stdout(out);
    let is_array = out.extension().is_some_and(|ending| ending == "npy");
    if !is_stdout {
        if !is_array {
            require_ending([out], "csv", "--table writes .npy or a table")?;
        }
        check_outputs([out], &[table.to_owned()], "the command")?;
    }
    let text = text_of(table)?;
    let chosen = leaf::choose(arguments)?;
    let leaves = read(&chosen, arguments.form.form(), table, &text)?;
    drop(text);
    warn_of_mixtures(&leaves.contents);
    let wavelengths: Vec<f64> = if arguments.nm.is_empty() {
        (400..=2500).map(f64::from).collect()
    } else {
        arguments.nm.clone()
    };
    let at: Vec<_> = wavelengths.iter().map(|&nm| chosen.at(nm)).collect();
    let provenance = Provenance {
        files: [("table".to_owned(), hash_of(table))].into(),
        ..Provenance::of("optics", "out", settings)
    };
    let table_of = |out: &mut dyn Write| {
        out.write_all(provenance.comment().as_bytes())?;
        spectra::csv(&leaves, &wavelengths, &at, &mut { out })
    };
    if is_stdout {
        let mut stdout = std::io::stdout().lock();
        note_output(table_of(&mut stdout));
    } else {
        let written = atomic::replace(out, |file| {
            if is_array {
                spectra::npy(&leaves, &at, file)
            } else {
                table_of(file)
            }
        });
        written.map_err(Failure::system)?;
        say(out.display());
    }
    eprintln!(
        "{}: {} leaves at {} wavelengths",
        model::source(chosen.pigments.model),
        leaves.contents.len(),
        at.len()
    );
    Ok(())
}

/// What a column holds.
#[derive(Clone, Copy, PartialEq)]
enum Column {
    Name,
    Content(Constituent),
    Other,
}

/// The leaves of the table, or all that is wrong with it.
fn read(chosen: &Chosen, form: Form, file: &Path, text: &str) -> Result<Leaves, DocumentErrors> {
    let shown = escaped(&file.display().to_string(), 4 * QUOTED);
    let cx = Context::new(Sources::default(), ".".into());
    let source = cx.sources.borrow_mut().add(shown.as_str(), text);
    let rows = Rows::written(text, form);
    let mut records = rows.records().filter_map(|row| {
        let ragged = row.map(|row| row.fields);
        ragged
            .map_err(|ragged| cx.error(&ragged.at(source), ragged.error()))
            .ok()
    });
    let names = records.next().unwrap_or_default();
    let columns = columns(&cx, source, &names, chosen);
    let named_by = columns.iter().position(|column| *column == Column::Name);
    let mut leaves = Leaves {
        column: named_by.map_or_else(|| "leaf".to_owned(), |at| names[at].text.clone()),
        names: Vec::new(),
        contents: Vec::new(),
    };
    let mut seen = HashSet::new();
    for fields in records {
        let mut contents = chosen.contents;
        for ((field, column), name) in fields.iter().zip(&columns).zip(&names) {
            match *column {
                Column::Content(of) => {
                    if let Some(value) = number(&cx, source, of, [name, field], &rows) {
                        contents[of] = value;
                    }
                }
                Column::Name if field.text.is_empty() => {
                    let error = impossible(name, EMPTY.to_owned(), "give each leaf a name");
                    cx.error(&field.at(source), error);
                }
                Column::Name if !seen.insert(field.text.clone()) => {
                    let problem = format!("there is another leaf `{}`", field.shown());
                    let error = impossible(name, problem, "give each leaf a name of its own");
                    cx.error(&field.at(source), error);
                }
                Column::Name | Column::Other => {}
            }
        }
        if let Some(problem) = model::refusal(&chosen.pigments, &contents)
            && let (Some(first), true) = (fields.first(), cx.error_count() == 0)
        {
            let help = "give each leaf what the model has";
            cx.error(&first.at(source), impossible(first, problem, help));
        }
        let number = leaves.contents.len() + 1;
        let name = named_by.map_or_else(|| number.to_string(), |at| fields[at].text.clone());
        leaves.names.push(name);
        leaves.contents.push(contents);
    }
    if leaves.contents.is_empty() && cx.error_count() == 0 {
        cx.error_of_the_file(DocumentError::BadFile {
            path: shown,
            problem: "has no leaves".to_owned(),
            help: "write names of columns into its first line, and a line for each leaf".to_owned(),
        });
    }
    note(rows.guesses());
    let (sources, errors, _) = cx.into_parts();
    if errors.is_empty() {
        Ok(leaves)
    } else {
        Err(DocumentErrors::new(sources.into(), errors))
    }
}

/// What the columns hold. A content may be called as its option, as `lamina fit` calls it, or by
/// PROSPECT's letters.
fn columns(cx: &Context, source: usize, names: &[Field], chosen: &Chosen) -> Vec<Column> {
    let mut columns = Vec::with_capacity(names.len());
    for name in names {
        let is = |known: &str| known.eq_ignore_ascii_case(&name.text);
        let is_content = |of: &Constituent| {
            [chosen.option(*of), of.name(), of.key(), of.symbol()]
                .into_iter()
                .any(is)
        };
        let column = if let Some(of) = Constituent::ALL.into_iter().find(is_content) {
            Column::Content(of)
        } else if IDENTITIES.into_iter().any(is) {
            Column::Name
        } else {
            Column::Other
        };
        let conflict = |second: String| DocumentError::Conflict {
            first: name.shown(),
            second,
        };
        match column {
            Column::Other => {
                if !OF_FITS.into_iter().any(is) && !name.text.ends_with("_standard_error") {
                    cx.error(&name.at(source), unknown(name, chosen));
                }
            }
            Column::Content(of) if chosen.is_given(of) => {
                cx.error(
                    &name.at(source),
                    conflict(format!("--{}", chosen.option(of))),
                );
            }
            Column::Content(_) | Column::Name => {
                if let Some(earlier) = columns.iter().position(|other| *other == column) {
                    cx.error(&name.at(source), conflict(names[earlier].shown()));
                }
            }
        }
        columns.push(column);
    }
    columns
}

fn unknown(name: &Field, chosen: &Chosen) -> DocumentError {
    let options = Constituent::ALL.map(|of| chosen.option(of));
    let known = || {
        ["leaf"]
            .into_iter()
            .chain(options)
            .chain(Constituent::ALL.map(Constituent::name))
    };
    DocumentError::UnknownKey {
        key: name.shown(),
        block: "the table".to_owned(),
        nearest: nearest(&name.text, known()).map(str::to_owned),
        unit: None,
        known: known().collect::<Vec<_>>().join(", "),
    }
}

/// A content as a number in its range; an error otherwise.
fn number(
    cx: &Context,
    source: usize,
    of: Constituent,
    [name, field]: [&Field; 2],
    rows: &Rows<'_>,
) -> Option<f64> {
    let [low, high] = of.range();
    let limits = Limits::closed(low, high);
    let key = name.shown();
    let error = match rows.number(field) {
        Some(value) if limits.contain(value) => return Some(value),
        Some(value) if value.is_finite() => DocumentError::OutOfRange {
            key,
            value: field.shown(),
            range: format!("{limits} {}", of.unit()).trim_end().to_owned(),
            help: limits.advice(value),
        },
        Some(_) => DocumentError::NotFinite {
            key,
            value: field.shown(),
        },
        None => {
            let problem = if field.text.is_empty() {
                EMPTY.to_owned()
            } else {
                format!("`{}` is not a number", field.shown())
            };
            impossible(name, problem, &format!("write a number from {limits}"))
        }
    };
    cx.error(&field.at(source), error);
    None
}

fn impossible(name: &Field, problem: String, help: &str) -> DocumentError {
    DocumentError::Impossible {
        key: name.shown(),
        problem,
        help: help.to_owned(),
    }
}

#[cfg(test)]
mod tests;
