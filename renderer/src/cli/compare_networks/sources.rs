//! Which leaves are compared, in which groups, and how each is read.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use leafmodel::document::rows::{Ragged, Rows};
use leafmodel::document::source::quoted;

use crate::cli::arguments::{CompareNetworksArguments, ReadingArguments, file_and_leaf};
use crate::cli::grow::is_word;
use crate::cli::places::has_ending;
use crate::cli::terminal::{Failure, did_you_mean};
use crate::cli::texts::text_of;

/// The columns of a table of leaves, besides those that say how a file is read.
const COLUMNS: [&str; 3] = ["file", "group", "name"];

/// A leaf that is to be compared.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Source {
    /// What it is called in the report.
    pub(super) name: String,
    /// Its group, by number.
    pub(super) group: usize,
    /// As it was named.
    pub(super) given: String,
    pub(super) from: From,
}

/// Where a leaf comes from.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum From {
    /// A file with a network or a picture.
    File {
        path: PathBuf,
        reading: ReadingArguments,
    },
    /// It is grown, with this seed or its own.
    Growth { seed: Option<u64> },
}

/// All leaves and the names of their groups.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sources {
    pub(super) groups: Vec<String>,
    pub(super) leaves: Vec<Source>,
}

impl Sources {
    /// As the command line says.
    pub(super) fn new(arguments: &CompareNetworksArguments) -> Result<Self, Failure> {
        let mut sources = Self {
            groups: Vec::new(),
            leaves: Vec::new(),
        };
        let seeds = arguments.seeds;
        if let Some(table) = &arguments.table {
            if let Some(column) = arguments.reading.first() {
                bail!(
                    "flags that say how a file is read do not go with --table: give it a column \
                     `{column}`"
                );
            }
            sources.add_table(table, &arguments.reading, seeds)?;
        } else if arguments.groups.0.is_empty() {
            let stems: Vec<String> = arguments.networks.iter().map(|given| stem(given)).collect();
            for (given, own) in arguments.networks.iter().zip(&stems) {
                let is_alone = stems.iter().filter(|other| *other == own).count() == 1;
                let group = sources.group(if is_alone { own } else { given });
                sources.add(group, given, given, None, &arguments.reading, seeds);
            }
        } else {
            for group in &arguments.groups.0 {
                if group.name.trim().is_empty() {
                    bail!("--group: its name is empty: write --group NAME FILE…");
                }
                if looks_like_a_file(&group.name) {
                    bail!(
                        "--group {0}: its first word is the name of the group, and `{0}` is a \
                         network: write --group NAME {0} …",
                        group.name.escape_debug()
                    );
                }
                if sources.groups.contains(&group.name) {
                    let name = group.name.escape_debug();
                    bail!("--group {name} is given twice: name all of its leaves behind the first");
                }
                let number = sources.group(&group.name);
                for given in &group.leaves {
                    sources.add(number, given, given, None, &arguments.reading, seeds);
                }
            }
        }
        sources.check(arguments)?;
        sources.name_apart();
        Ok(sources)
    }

    /// Files that are read.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        let files = self.leaves.iter().flat_map(|leaf| match &leaf.from {
            From::File { path, reading } => {
                let beside = [&reading.nodes, &reading.outline];
                let beside = beside.into_iter().flatten().cloned();
                std::iter::once(path.clone()).chain(beside).collect()
            }
            From::Growth { .. } if is_word(&leaf.given) => Vec::new(),
            From::Growth { .. } => vec![file_and_leaf(&leaf.given).0],
        });
        files.collect()
    }

    /// The number of a group; new ones come last.
    fn group(&mut self, name: &str) -> usize {
        if let Some(known) = self.groups.iter().position(|known| known == name) {
            return known;
        }
        self.groups.push(name.to_owned());
        self.groups.len() - 1
    }

    /// Adds a leaf, or one for each seed of a leaf that is grown.
    fn add(
        &mut self,
        group: usize,
        given: &str,
        place: &str,
        name: Option<&str>,
        reading: &ReadingArguments,
        seeds: Option<u32>,
    ) {
        let own = name.map_or_else(|| stem(given), str::to_owned);
        let mut push = |name: String, from: From| {
            self.leaves.push(Source {
                name,
                group,
                given: place.to_owned(),
                from,
            });
        };
        if !is_grown(place) {
            let (path, reading) = (PathBuf::from(place), reading.clone());
            push(own, From::File { path, reading });
            return;
        }
        let Some(seeds) = seeds else {
            push(own, From::Growth { seed: None });
            return;
        };
        for seed in 1..=u64::from(seeds) {
            let name = format!("{own}, seed {seed}");
            push(name, From::Growth { seed: Some(seed) });
        }
    }

    fn add_table(
        &mut self,
        path: &Path,
        given: &ReadingArguments,
        seeds: Option<u32>,
    ) -> Result<(), Failure> {
        let shown = path.display();
        let text = text_of(path)?;
        let table = Rows::written(&text, given.form.form());
        let refused_at = |line: usize, problem: String| bad!("{shown}:{line}: {problem}");
        let ragged = |ragged: Ragged| refused_at(ragged.line, ragged.to_string());
        let mut rows = table.records();
        let header = rows.next().transpose().map_err(ragged)?;
        let (line, header) = header.map_or((1, Vec::new()), |row| (row.line, row.fields));
        let header: Vec<&str> = header.iter().map(|name| name.text.as_str()).collect();
        check_header(&header).map_err(|problem| refused_at(line, problem))?;
        let column = |name: &str| header.iter().position(|column| *column == name);
        let has_groups = column("group").is_some();
        for row in rows {
            let row = row.map_err(ragged)?;
            let refused = |problem: String| refused_at(row.line, problem);
            let cell = |name: &str| {
                let cell = column(name).and_then(|column| row.fields.get(column));
                cell.map(|cell| cell.text.as_str())
                    .filter(|cell| !cell.is_empty())
            };
            let Some(file) = cell("file") else {
                return Err(refused("`file` is empty: name a network".to_owned()));
            };
            let group = match (has_groups, cell("group")) {
                (true, Some(group)) => group.to_owned(),
                (true, None) => {
                    let file = quoted(file);
                    return Err(refused(format!("`group` of {file} is empty: name one")));
                }
                (false, _) => cell("name").unwrap_or(file).to_owned(),
            };
            let mut reading = ReadingArguments {
                strict: given.strict,
                ..ReadingArguments::default()
            };
            for column in ReadingArguments::COLUMNS {
                if let Some(word) = cell(column) {
                    let set = reading.set(column, word);
                    set.map_err(|problem| {
                        refused(format!("`{column}` is `{}`: {problem}", quoted(word)))
                    })?;
                }
            }
            // Files stand where the table does.
            let beside = |file: &Path| path.parent().unwrap_or(Path::new("")).join(file);
            for file in [&mut reading.nodes, &mut reading.outline] {
                *file = file.take().map(|file| beside(&file));
            }
            let place = if is_grown(file) && is_word(file) {
                file.to_owned()
            } else {
                beside(Path::new(file)).display().to_string()
            };
            let number = self.group(&group);
            self.add(number, file, &place, cell("name"), &reading, seeds);
        }
        for guess in table.guesses() {
            eprintln!("note: {shown}: {guess}");
        }
        Ok(())
    }

    /// Fails if there is nothing to compare, or a leaf is there twice.
    fn check(&self, arguments: &CompareNetworksArguments) -> Result<(), Failure> {
        let mut seen: BTreeMap<(PathBuf, Option<u64>), &Source> = BTreeMap::new();
        for leaf in &self.leaves {
            let key = match &leaf.from {
                From::File { path, .. } => (
                    std::fs::canonicalize(path).unwrap_or_else(|_| path.clone()),
                    None,
                ),
                From::Growth { seed } => (PathBuf::from(&leaf.given), *seed),
            };
            if let Some(other) = seen.insert(key, leaf) {
                let what = if other.group == leaf.group {
                    "name each leaf once".to_owned()
                } else {
                    format!(
                        "in the groups {} and {}",
                        quoted(&self.groups[other.group]),
                        quoted(&self.groups[leaf.group])
                    )
                };
                bail!("{} is named twice: {what}", quoted(&leaf.given));
            }
        }
        match (self.groups.len(), self.leaves.len()) {
            (0 | 1, _) if arguments.groups.0.is_empty() && arguments.table.is_none() => Err(bad!(
                "{} to compare: name two networks or more, or groups of them by --group NAME \
                     FILE… or --table FILE.csv",
                if self.leaves.is_empty() {
                    "nothing"
                } else {
                    "one network has no other"
                }
            )),
            (0 | 1, _) => Err(bad!(
                "there {}: give two or more",
                if self.groups.is_empty() {
                    "are no leaves"
                } else {
                    "is one group"
                }
            )),
            _ => Ok(()),
        }
    }

    /// Gives leaves of one name the names of their files.
    fn name_apart(&mut self) {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for leaf in &self.leaves {
            *counts.entry(leaf.name.clone()).or_default() += 1;
        }
        for leaf in &mut self.leaves {
            if counts[&leaf.name] > 1
                && let From::File { .. } = leaf.from
            {
                leaf.name = leaf.given.clone();
            }
        }
    }
}

fn check_header(header: &[&str]) -> Result<(), String> {
    for (number, &column) in header.iter().enumerate() {
        let known = || COLUMNS.into_iter().chain(ReadingArguments::COLUMNS);
        if !known().any(|known| known == column) {
            let meant = did_you_mean(column, known());
            return Err(format!(
                "there is no column `{}`{meant} ({})",
                quoted(column),
                known().collect::<Vec<_>>().join(", ")
            ));
        }
        if header[..number].contains(&column) {
            return Err(format!("the column `{column}` is there twice"));
        }
    }
    if header.contains(&"file") {
        return Ok(());
    }
    Err("there is no column `file`".to_owned())
}

/// Whether a word names a leaf that is grown, not a file with a network.
fn is_grown(given: &str) -> bool {
    let path = Path::new(given);
    if path.exists() {
        return has_ending(path, "toml");
    }
    is_word(given) || has_ending(&file_and_leaf(given).0, "toml")
}

fn looks_like_a_file(name: &str) -> bool {
    Path::new(name).is_file()
}

/// The name of a file without folder and ending; of a leaf in a file, its own.
fn stem(given: &str) -> String {
    let (path, leaf) = file_and_leaf(given);
    let stem = path.file_stem().map(|stem| stem.to_string_lossy());
    match (leaf, stem) {
        (Some(leaf), _) if is_grown(given) => leaf.to_owned(),
        (_, Some(stem)) => stem.into_owned(),
        (_, None) => given.to_owned(),
    }
}
