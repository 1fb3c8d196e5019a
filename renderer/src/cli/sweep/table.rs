//! The table of a sweep: a row for each task, its inputs and its outputs.

use std::path::Path;

use super::list::{plain, value};
use super::record::Record;
use crate::checkpoint::PROGRAM;
use crate::cli::places::write_whole;
use crate::cli::terminal::Failure;
use crate::report::table::{Table, cell};
use crate::scene::fingerprint::hexadecimal;
use crate::sweep::{Sweep, Task};

/// Whether a task is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Done,
    Failed,
    Open,
}

/// A task with what it has made.
#[derive(Debug)]
pub(super) struct Row<'s> {
    pub(super) task: Task<'s>,
    pub(super) identity: u64,
    pub(super) state: State,
    pub(super) record: Option<Record>,
}

/// Writes the table: `task`, `id`, `state`, `program` (its version), a column for each key, `seed`, `file` (the picture, from
/// the table's folder), and a column for each number that any task has.
pub(super) fn write(path: &Path, sweep: &Sweep, rows: &[Row<'_>]) -> Result<(), Failure> {
    let mut names: Vec<&str> = Vec::new();
    let numbers = rows.iter().filter_map(|row| row.record.as_ref());
    for (name, _) in numbers.flat_map(|record| &record.outputs) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    let mut header = vec!["task", "id", "state", "program"];
    header.extend(sweep.keys().map(|key| key.path.as_str()));
    if sweep.has_seeds() {
        header.push("seed");
    }
    header.push("file");
    header.extend(&names);
    let mut table = Table::of(header);
    for row in rows {
        let state = match row.state {
            State::Done => "done",
            State::Failed => "failed",
            State::Open => "open",
        };
        let mut cells = vec![
            row.task.number.to_string(),
            hexadecimal(row.identity),
            state.to_owned(),
            PROGRAM.to_owned(),
        ];
        let settings = row.task.settings.iter();
        cells.extend(settings.map(|(_, cell)| plain(&value(&cell.text))));
        cells.extend(row.task.seed.map(|seed| seed.to_string()));
        let record = row.record.as_ref();
        let file = record.and_then(|record| record.files.last());
        cells.push(file.map_or_else(String::new, |file| format!("tasks/{file}")));
        let number = |name: &&str| record.and_then(|record| record.outputs.get(*name));
        cells.extend(names.iter().map(|name| cell(number(name))));
        table.row(cells);
    }
    write_whole(path, table.text())
}
