//! Rows of numbers: written out, or in a CSV file whose first line names the columns.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::rows::Rows;
use leafmodel::document::value_kind::{FilePath, ListOf, NamedFile, Numbers};

use crate::measured::{Fault, What};
use crate::scene::blocks::table_file::TableFile;

/// What rows are, and how messages and the book say it.
pub(in crate::scene) struct NumberRows<const N: usize> {
    pub(in crate::scene) columns: [&'static str; N],
    pub(in crate::scene) least: usize,
    pub(in crate::scene) limits: Limits,
    /// A list of rows, the two keys, and what a file should have.
    pub(in crate::scene) wanted: &'static str,
    pub(in crate::scene) about: [&'static str; 2],
    pub(in crate::scene) help: &'static str,
}

impl<const N: usize> NumberRows<N> {
    /// Declares the keys `table` and `file`, of which a block has one.
    pub(in crate::scene) fn declare(&self, rows: &mut Vec<[f64; N]>, keys: &mut Keys<'_>) {
        for way in keys.one_of(&["table", "file"], Some("table")) {
            if way == "table" {
                let kind = ListOf {
                    of: Numbers::<N>(self.limits),
                    least: self.least,
                    most: 1000,
                    wanted: self.wanted,
                };
                keys.required("table", rows, kind, self.about[0]);
            } else {
                let mut named = None;
                let path = FilePath::of("the path of a CSV file", &["csv", "tsv", "txt"], 1 << 20);
                keys.optional("file", &mut named, path, self.about[1]);
                rows.extend(self.in_file(named.as_ref(), keys).into_iter().flatten());
            }
        }
    }

    fn in_file(&self, named: Option<&NamedFile>, keys: &Keys<'_>) -> Option<Vec<[f64; N]>> {
        let (form, named) = (keys.reader()?, named?);
        let at = &form.node("file")?.at;
        let file = TableFile::read(form.cx, &named.file, &named.written, at)?;
        file.sound(self.in_text(&file.text))
    }

    fn in_text(&self, text: &str) -> Result<Vec<[f64; N]>, Fault> {
        let rows = Rows::of(text);
        let mut columns = None;
        let mut found = Vec::new();
        for row in rows.records() {
            let words = |span, problem: String| Fault {
                span: Some(span),
                what: What::Words {
                    problem,
                    help: self.help,
                },
            };
            let row = row.map_err(|ragged| words(ragged.span.clone(), ragged.to_string()))?;
            let Some(columns) = columns else {
                let mut places = [0; N];
                for (place, name) in places.iter_mut().zip(self.columns) {
                    let known = row.fields.iter().position(|field| field.text == name);
                    let missing = || words(row.span(), format!("it names no column `{name}`"));
                    *place = known.ok_or_else(missing)?;
                }
                columns = Some(places);
                continue;
            };
            let mut values = [0.0; N];
            for (value, at) in values.iter_mut().zip::<[usize; N]>(columns) {
                let bad = || words(row.span(), "it has something that is no number".to_owned());
                *value = rows.number(&row.fields[at]).ok_or_else(bad)?;
            }
            found.push(values);
        }
        Ok(found)
    }
}
