//! Sweep files.

use std::path::{Path, PathBuf};

use leafmodel::document::context::{Context, QUOTED};
use leafmodel::document::error::DocumentError;
use leafmodel::document::limits::Limits;
use leafmodel::document::opened::Opened;
use leafmodel::document::path::{Wanted, resolve};
use leafmodel::document::reader::Block;
use leafmodel::document::report::DocumentErrors;
use leafmodel::document::rows::{Decimal, Form, Separator};
use leafmodel::document::schema::BlockSchema;
use leafmodel::document::source::{Place, escaped};
use leafmodel::document::tree::{Entry, Node, Table, Value};
use leafmodel::document::value_kind::{Kind, Word};
use leafmodel::document::values::{integer_at, number_at, text_at, wrong_type};
use leafmodel::document::write::value_to_toml;

use super::draft::Draft;
use super::range::{self, Range};
use super::tasks::{Sweep, Target};
use super::values::{Axis, Cell, Key, MOST_TASKS, impossible};
use super::words::Words;
use super::{latin, rows};
use crate::film::MOST_SAMPLES;

/// Sections of scenes and of files of leaves, one of which each of them has.
const SECTIONS: [&str; 6] = ["leaves", "objects", "lights", "film", "camera", "materials"];

/// Whether a file is a sweep, rather than a scene or a file of leaves, and if not, whether it is a
/// scene.
///
/// # Errors
///
/// [`DocumentErrors`] if it cannot be read.
pub fn is_sweep_file(path: &Path) -> Result<(bool, bool), DocumentErrors> {
    let opened = Opened::file(path, &[], BlockSchema::default)?;
    let has = |section: &str| opened.tree.get(section).is_some();
    let is_sweep = !SECTIONS.into_iter().any(has);
    let is_scene = ["film", "camera", "objects"].into_iter().any(has);
    Ok((is_sweep, !is_sweep && is_scene))
}

impl Sweep {
    /// The sweep of the file at `path`, with what the command line adds.
    ///
    /// # Errors
    ///
    /// [`DocumentErrors`] with all errors of the file, of the tables that it names, and of the
    /// words.
    pub fn file(path: &Path, words: &Words<'_>) -> Result<Self, DocumentErrors> {
        let opened = Opened::file(path, &[], BlockSchema::default)?;
        let mut draft = Draft::default();
        draft.read(&opened.cx, &opened.tree);
        draft.add(&opened.cx, words);
        if opened.cx.error_count() == 0 {
            draft.check_target(&opened.cx, &opened.tree);
        }
        // A target that is there cannot stand for a file with errors of syntax.
        let cx = opened.into_whole()?;
        draft.finish(cx)
    }
}

impl Draft {
    fn read(&mut self, cx: &Context, tree: &Table) {
        let top = Place {
            source: 0,
            span: 0..0,
        };
        let root = Block::new(cx, tree, String::new(), top);
        if let Some(node) = root.needed("format", || "`format = 1`".to_owned())
            && integer_at(cx, node, "format", 0, u64::MAX).is_some_and(|format| format != 1)
        {
            let found = cx.quoted(node);
            cx.error(&node.at, DocumentError::UnsupportedFormat { found });
        }
        self.target = target(&root);
        if let Some(node) = root.node("spp") {
            self.spp = integer_at(cx, node, "spp", 1, MOST_SAMPLES.into()).map(|spp| spp as u32);
        }
        if let Some(node) = root.node("noise") {
            self.noise = number_at(cx, node, "noise", Limits::closed(0.0, 1.0));
        }
        if let Some(node) = root.node("seeds") {
            self.seeds = seeds(cx, node);
        }
        for entry in entries_of(&root, "set") {
            self.fixed
                .push(format!("{}={}", entry.path, value_to_toml(entry.node)));
        }
        for entry in entries_of(&root, "grid") {
            self.axes.extend(grid_axis(cx, &entry));
        }
        self.axes.extend(side_by_side(cx, &root));
        if let Some(block) = root.optional_block("latin_hypercube") {
            self.axes.extend(hypercube(&block));
        }
        if let Some(node) = root.node("rows")
            && let Some((written, at)) = text_at(cx, node, "rows")
        {
            let wanted = Wanted {
                endings: &["csv", "tsv", "txt"],
                most_bytes: rows::MOST_BYTES,
            };
            let path = resolve(cx, written, at, wanted);
            let mut form = Form::default();
            if let Some(node) = root.node("separator") {
                form.separator = Word(&Separator::ALL).read(cx, node, "separator");
            }
            if let Some(node) = root.node("decimal") {
                form.decimal = Word(&Decimal::ALL).read(cx, node, "decimal");
            }
            let axis = path.and_then(|path| rows::read(cx, &path, written, at, form));
            self.axes.extend(axis);
        }
        root.finish();
    }

    /// Reports a scene that is not there.
    fn check_target(&self, cx: &Context, tree: &Table) {
        if let (Some(Target::Scene(path)), Some(entry)) = (&self.target, tree.get("scene"))
            && !path.is_file()
        {
            let path = escaped(&path.display().to_string(), QUOTED);
            let nearest = None;
            let error = DocumentError::FileMissing { path, nearest };
            cx.error(&entry.node.at, error);
        }
    }
}

/// `scene` or `leaf`; paths start at the file's folder.
fn target(root: &Block<'_>) -> Option<Target> {
    let key = root.exactly_one(&["scene", "leaf"])?;
    let (text, at) = text_at(root.cx, root.node(key)?, key)?;
    if text.is_empty() {
        let help = "name a scene file, or a leaf as `lamina grow` takes it";
        impossible(root.cx, at, key, "is empty", help);
        return None;
    }
    let beside = |text: &str| -> PathBuf { root.cx.folder.join(text) };
    Some(match key {
        "scene" => Target::Scene(beside(text)),
        // A preset's name has no dot, and no folder.
        _ if !text.contains(['.', '/', '\\', '#']) => Target::Leaf(text.to_owned()),
        _ => Target::Leaf(beside(text).display().to_string()),
    })
}

fn seeds(cx: &Context, node: &Node) -> Vec<u64> {
    match &node.value {
        Value::List(list) if !list.is_empty() => list
            .iter()
            .filter_map(|node| integer_at(cx, node, "seeds", 0, u64::MAX))
            .collect(),
        Value::Integer(_) => {
            let count = integer_at(cx, node, "seeds", 1, MOST_TASKS as u64);
            count.map_or_else(Vec::new, |count| (1..=count).collect())
        }
        Value::Text(_)
        | Value::Number(_)
        | Value::Flag(_)
        | Value::Other(..)
        | Value::List(_)
        | Value::Table(_) => {
            wrong_type(cx, node, "seeds", "their number, or a list of integers");
            Vec::new()
        }
    }
}

/// A key of the target with what the sweep says of it.
struct Setting<'t> {
    path: String,
    at: &'t Place,
    node: &'t Node,
}

/// The keys of a block, which may be written whole in quotes, or as TOML nests them.
fn entries_of<'t>(root: &Block<'t>, key: &'static str) -> Vec<Setting<'t>> {
    let mut found = Vec::new();
    if let Some(entry) = root.entry(key)
        && let Some(block) = root.open(entry)
    {
        let leads_on = |node: &Node, inner: &Table| {
            if key == "set" {
                // In braces it is a value, such as that of a spectrum.
                !root.cx.sources.borrow().slice(&node.at).starts_with('{')
            } else {
                // A range holds numbers and words only.
                holds_more(inner)
            }
        };
        flatten(block.table, "", &leads_on, &mut found);
        if found.is_empty() {
            let help = "write keys of the scene or the leaf into it, or leave it out";
            impossible(root.cx, &entry.key_at, key, "is empty", help);
        }
    }
    found
}

fn flatten<'t>(
    table: &'t Table,
    before: &str,
    leads_on: &dyn Fn(&Node, &Table) -> bool,
    found: &mut Vec<Setting<'t>>,
) {
    for Entry { key, key_at, node } in &table.0 {
        let path = if before.is_empty() {
            key.clone()
        } else {
            format!("{before}.{key}")
        };
        match &node.value {
            Value::Table(inner) if leads_on(node, inner) => flatten(inner, &path, leads_on, found),
            Value::Text(_)
            | Value::Integer(_)
            | Value::Number(_)
            | Value::Flag(_)
            | Value::Other(..)
            | Value::List(_)
            | Value::Table(_) => found.push(Setting {
                path,
                at: key_at,
                node,
            }),
        }
    }
}

/// Whether a table leads on to keys, instead of being a range.
fn holds_more(table: &Table) -> bool {
    let mut values = table.0.iter().map(|entry| &entry.node.value);
    values.any(|value| matches!(value, Value::List(_) | Value::Table(_)))
}

/// An axis of the grid: a list of values, or a range.
fn grid_axis(cx: &Context, setting: &Setting<'_>) -> Option<Axis> {
    let rows = if let Value::Table(table) = &setting.node.value {
        let at = setting.at.clone();
        let block = Block::new(cx, table, setting.path.clone(), at.clone());
        let (range, count) = range::read(&block, true)?;
        range::cells(as_written(table, range, count).values(count), &at)
    } else {
        let cells = cells(cx, setting, "a list of values, or { from, to, count }")?;
        cells.into_iter().map(|cell| vec![cell]).collect()
    };
    let keys = vec![key_of(setting)];
    Some(Axis { keys, rows })
}

/// A range whose ends are integers at equal steps of integers has integers between them.
fn as_written(table: &Table, range: Range, count: usize) -> Range {
    let is_whole = |key: &str| {
        let entry = table.get(key);
        entry.is_some_and(|entry| matches!(entry.node.value, Value::Integer(_)))
    };
    let step = (range.to - range.from) / (count - 1) as f64;
    let whole = range.whole
        || (is_whole("from") && is_whole("to") && step.fract() == 0.0 && !range.logarithmic);
    Range { whole, ..range }
}

fn key_of(setting: &Setting<'_>) -> Key {
    Key {
        path: setting.path.clone(),
        at: setting.at.clone(),
    }
}

/// The values of a list; reports an empty one, and what is no number.
fn cells(cx: &Context, setting: &Setting<'_>, wanted: &str) -> Option<Vec<Cell>> {
    let Value::List(list) = &setting.node.value else {
        wrong_type(cx, setting.node, &setting.path, wanted);
        return None;
    };
    if list.is_empty() {
        let help = "write at least one value, or leave the key out";
        impossible(cx, &setting.node.at, &setting.path, "has no values", help);
        return None;
    }
    let mut is_good = true;
    for node in list {
        is_good &= is_finite(cx, &setting.path, node);
    }
    let cell = |node: &Node| Cell {
        text: value_to_toml(node),
        at: node.at.clone(),
    };
    is_good.then(|| list.iter().map(cell).collect())
}

/// Whether no number in a value is infinite or none; reports those that are.
fn is_finite(cx: &Context, key: &str, node: &Node) -> bool {
    match &node.value {
        Value::Number(number) if !number.is_finite() => {
            let error = DocumentError::NotFinite {
                key: escaped(key, QUOTED),
                value: cx.quoted(node),
            };
            cx.error(&node.at, error);
            false
        }
        Value::List(list) => list.iter().all(|node| is_finite(cx, key, node)),
        Value::Table(table) => table.0.iter().all(|entry| is_finite(cx, key, &entry.node)),
        Value::Text(_)
        | Value::Integer(_)
        | Value::Number(_)
        | Value::Flag(_)
        | Value::Other(..) => true,
    }
}

/// `[list]`: the first values of all keys, then the second ones, and so on.
fn side_by_side(cx: &Context, root: &Block<'_>) -> Option<Axis> {
    let settings = entries_of(root, "list");
    let columns = settings
        .iter()
        .map(|setting| cells(cx, setting, "a list of values"));
    let columns: Vec<Option<Vec<Cell>>> = columns.collect();
    let columns: Option<Vec<Vec<Cell>>> = columns.into_iter().collect();
    let columns = columns.filter(|columns| !columns.is_empty())?;
    let length = columns[0].len();
    for (setting, column) in settings.iter().zip(&columns) {
        if column.len() != length {
            let problem = format!(
                "has {} values, `{}` has {length}",
                column.len(),
                escaped(&settings[0].path, QUOTED)
            );
            let help = "give all keys of [list] as many; [grid] combines lists of any length";
            impossible(cx, &setting.node.at, &setting.path, problem, help);
            return None;
        }
    }
    let row = |index: usize| columns.iter().map(|column| column[index].clone()).collect();
    Some(Axis {
        keys: settings.iter().map(key_of).collect(),
        rows: (0..length).map(row).collect(),
    })
}

/// `[latin_hypercube]`.
fn hypercube(block: &Block<'_>) -> Option<Axis> {
    let cx = block.cx;
    let count = block.needed("count", || "`count = …`, the number of tasks".to_owned());
    let count = count.and_then(|node| integer_at(cx, node, "count", 1, MOST_TASKS as u64));
    let seed = match block.node("seed") {
        Some(node) => integer_at(cx, node, "seed", 0, u64::MAX),
        None => Some(0),
    };
    let settings = entries_of(block, "ranges");
    block.needed("ranges", || {
        "a block `[latin_hypercube.ranges]` with keys and their ranges, `\"key\" = { from = …, to = … }`"
            .to_owned()
    });
    let ranges: Vec<Option<Range>> = settings
        .iter()
        .map(|setting| {
            let Value::Table(table) = &setting.node.value else {
                wrong_type(cx, setting.node, &setting.path, "a range { from, to }");
                return None;
            };
            let block = Block::new(cx, table, setting.path.clone(), setting.at.clone());
            range::read(&block, false).map(|(range, _)| range)
        })
        .collect();
    block.finish();
    let ranges: Option<Vec<Range>> = ranges.into_iter().collect();
    let (ranges, count, seed) = (ranges?, count?, seed?);
    if ranges.is_empty() {
        return None;
    }
    let rows = latin::hypercube(&ranges, count as usize, seed).into_iter();
    let rows = rows.map(|row| {
        let cells = row.into_iter().zip(&settings);
        let cells = cells.map(|(text, setting)| {
            let at = setting.at.clone();
            Cell { text, at }
        });
        cells.collect()
    });
    Some(Axis {
        keys: settings.iter().map(key_of).collect(),
        rows: rows.collect(),
    })
}
