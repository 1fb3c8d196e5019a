//! Tables: as CSV for other programs, in columns for people.

use std::fmt::Display;

use csv::{Writer, WriterBuilder};

/// A table as CSV, of which all rows have as many cells as its header.
#[derive(Debug)]
pub(crate) struct Table(Writer<Vec<u8>>);

impl Table {
    /// A table with the columns that its first line names.
    pub(crate) fn new(first_line: &str) -> Self {
        Self::of(first_line.split(','))
    }

    /// A table with these columns.
    pub(crate) fn of(header: impl IntoIterator<Item = impl Display>) -> Self {
        Self::with(&WriterBuilder::new(), header)
    }

    /// A table whose readers take lines that begin with `#` as comments: cells with it are quoted.
    pub(crate) fn commented(header: impl IntoIterator<Item = impl Display>) -> Self {
        Self::with(WriterBuilder::new().comment(Some(b'#')), header)
    }

    fn with(form: &WriterBuilder, header: impl IntoIterator<Item = impl Display>) -> Self {
        let mut table = Self(form.from_writer(Vec::new()));
        table.row(header);
        table
    }

    /// Adds a row.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = impl Display>) {
        let cells = cells.into_iter().map(|cell| cell.to_string());
        let written = self.0.write_record(cells);
        written.expect("memory takes all bytes, and rows have the cells of the header");
    }

    /// The text of the table.
    pub(crate) fn text(self) -> String {
        let bytes = self.0.into_inner().expect("memory takes all bytes");
        String::from_utf8(bytes).expect("cells are texts")
    }
}

/// A number or a name as a cell; nothing where there is none.
pub(crate) fn cell(value: Option<impl Display>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

/// A cell as it stands in a table of which lines that begin with `#` are comments.
pub(crate) fn quoted(text: &str) -> String {
    let mut line = Table::commented([text]).text();
    line.truncate(line.trim_end_matches('\n').len());
    line
}

/// Rows below their heads, in columns that are two spaces apart.
pub(crate) fn in_columns<const N: usize>(
    heads: [&str; N],
    rows: impl IntoIterator<Item = [String; N]>,
) -> String {
    let heads = [heads.map(str::to_owned)].into_iter();
    aligned(&heads.chain(rows).collect::<Vec<_>>())
}

/// Rows in columns that are two spaces apart.
pub(crate) fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let widths: [usize; N] = std::array::from_fn(|column| width(column).unwrap_or(0));
    let lines = rows.iter().map(|row| {
        let cells = row.iter().zip(widths);
        let cells = cells.map(|(cell, width)| format!("  {cell:<width$}"));
        cells.collect::<String>().trim_end().to_owned()
    });
    lines.collect::<Vec<_>>().join("\n")
}
