//! `lamina compare-networks`: measures of networks, or of groups of leaves, side by side.

mod cells;
mod compared;
mod figures;
mod leaves;
mod methods;
mod numbers;
mod overlay;
mod page;
mod report;
mod sources;
mod spreads;
mod tables;
#[cfg(test)]
mod tests;
mod words;

use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

use leafmodel::document::nearest::nearest;
use leafmodel::measure::keys;

use self::compared::{Compared, SpreadContrast, Tested, limit};
use self::leaves::{Leaf, measure_all, same};
use self::sources::Sources;
use crate::cli::arguments::CompareNetworksArguments;
use crate::cli::measure::{has_ending, is_json};
use crate::cli::places::check_outputs;
use crate::cli::progress::Patience;
use crate::cli::{Failure, say};
use crate::image::atomic;

/// Groups whose names are a title.
const MOST_NAMES: usize = 5;

/// All that the report tells.
#[derive(Clone, Debug)]
struct Findings {
    title: String,
    /// Names of the groups; each network is one of its own where none were given.
    groups: Vec<String>,
    leaves: Vec<Leaf>,
    /// Whether each group is one leaf.
    is_single: bool,
    compared: Compared,
    /// Pairs of leaves that are drawn over each other.
    overlays: Vec<[usize; 2]>,
    /// What a person should know.
    notes: Vec<String>,
}

impl Findings {
    /// The test of a distribution that counts: with leaves as the unit, or, where networks are
    /// compared one by one, with single values.
    fn headline(&self, contrast: &SpreadContrast) -> Option<Tested> {
        if self.is_single {
            contrast.steps
        } else {
            contrast.permuted
        }
    }

    /// The distance that goes with it.
    fn distance(&self, contrast: &SpreadContrast) -> Option<f64> {
        if self.is_single {
            contrast.pooled.map(|steps| steps.distance)
        } else {
            contrast.leafwise.map(|found| found.distance)
        }
    }

    /// How many leaves a group has.
    fn size(&self, group: usize) -> usize {
        self.leaves
            .iter()
            .filter(|leaf| leaf.group == group)
            .count()
    }
}

pub(super) fn run(arguments: &CompareNetworksArguments) -> Result<(), Failure> {
    let started = Instant::now();
    check_keys(&arguments.only)?;
    let sources = Sources::new(arguments)?;
    let overlays = overlays(arguments, &sources)?;
    check_files(arguments, &sources)?;
    let _patience = Patience::about("growing, measuring and comparing");
    let work = || found(arguments, &sources, overlays);
    let findings = match arguments.threads {
        None => work(),
        Some(threads) => rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build()
            .map_err(Failure::system)?
            .install(work),
    }?;
    // All are made before one is written: an alignment that cannot be is an error.
    let mut files: Vec<(&Path, Vec<u8>)> = Vec::new();
    for path in &arguments.out {
        let bytes = if is_json(path) {
            format!("{:#}\n", numbers::json(&findings)).into_bytes()
        } else if has_ending(path, "csv") {
            tables::csv(&findings)?
        } else {
            report::html(&findings, arguments)?.into_bytes()
        };
        files.push((path, bytes));
    }
    if let Some(path) = &arguments.values {
        files.push((path, tables::values(&findings)?));
    }
    for note in &findings.notes {
        eprintln!("note: {note}");
    }
    say(words::text(&findings));
    for line in words::conclusions(&findings) {
        eprintln!("{line}");
    }
    for (path, bytes) in files {
        atomic::replace(path, |file| file.write_all(&bytes)).map_err(Failure::system)?;
        say(path.display());
    }
    eprintln!(
        "{} leaves in {} groups, {} measures; {:.2} s",
        findings.leaves.len(),
        findings.groups.len(),
        findings.compared.measures.len(),
        started.elapsed().as_secs_f64()
    );
    Ok(())
}

/// Measures all leaves and compares them.
fn found(
    arguments: &CompareNetworksArguments,
    sources: &Sources,
    overlays: Vec<[usize; 2]>,
) -> Result<Findings, Failure> {
    let drawn: Vec<usize> = overlays.iter().flatten().copied().collect();
    let leaves = measure_all(arguments, sources, &drawn)?;
    // A leaf that stands twice in a group would count as two.
    let twice = same(&leaves)
        .into_iter()
        .find(|[one, other]| leaves[*one].group == leaves[*other].group);
    if let Some([one, other]) = twice {
        return Err(Failure::bad(format!(
            "{} and {} of group {} are the same network: each leaf of a group counts as one of its own, \
             so name it once, or grow it by a plan that heeds its seed",
            leaves[one].name, leaves[other].name, sources.groups[leaves[one].group]
        )));
    }
    let groups = sources.groups.clone();
    let compared = Compared::new(
        &leaves,
        groups.len(),
        arguments.all_pairs,
        &arguments.only,
        arguments.seed,
    );
    let title = arguments.title.clone().unwrap_or_else(|| {
        if groups.len() > MOST_NAMES {
            return format!("{} networks", leaves.len());
        }
        let names: Vec<&str> = groups.iter().map(String::as_str).collect();
        names.join(", ")
    });
    let mut findings = Findings {
        title,
        is_single: leaves.len() == groups.len(),
        groups,
        leaves,
        compared,
        overlays,
        notes: Vec::new(),
    };
    findings.notes = notes(&findings);
    Ok(findings)
}

/// What a person should know of the comparison as a whole.
fn notes(findings: &Findings) -> Vec<String> {
    let mut notes = Vec::new();
    let name = |leaf: usize| findings.leaves[leaf].name.as_str();
    for [one, other] in same(&findings.leaves) {
        notes.push(format!(
            "{} and {} are the same network",
            name(one),
            name(other)
        ));
    }
    if findings.is_single {
        notes.push(
            "each network stands for itself: tests of its areoles and veins tell whether two \
             networks differ, not whether leaves of two kinds do; for that compare groups of leaves \
             (--group)"
                .to_owned(),
        );
    } else {
        for (group, name) in findings.groups.iter().enumerate() {
            if findings.size(group) == 1 {
                notes.push(format!(
                    "{name} is one leaf: nothing tells how leaves of its kind differ; it is tested \
                     as one leaf among those of a group, as if its kind spread as much"
                ));
            }
        }
        for [one, other] in &findings.compared.pairs {
            notes.extend(
                limit(findings.size(*one), findings.size(*other)).map(|text| {
                    format!(
                        "{} and {}: {text}",
                        findings.groups[*one], findings.groups[*other]
                    )
                }),
            );
        }
    }
    if !findings.compared.absent.is_empty() {
        notes.push(format!(
            "no leaf has {}",
            findings.compared.absent.join(", ")
        ));
    }
    notes
}

/// Fails for a measure that there is not.
fn check_keys(only: &[String]) -> Result<(), Failure> {
    for key in only {
        if !keys().any(|known| known == key) {
            let meant = nearest(key, keys())
                .map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
            return Err(Failure::bad(format!(
                "--only: there is no measure `{}`{meant}",
                key.escape_debug()
            )));
        }
        if leaves::LEFT_OUT.contains(&key.as_str()) {
            return Err(Failure::bad(format!(
                "--only: `{key}` is not compared, because its numbers go together"
            )));
        }
    }
    Ok(())
}

/// Fails if files cannot be written, are named twice or read, or end in what is not written.
fn check_files(arguments: &CompareNetworksArguments, sources: &Sources) -> Result<(), Failure> {
    let is_known = |path: &Path| {
        ["html", "csv", "json"]
            .into_iter()
            .any(|end| has_ending(path, end))
    };
    if let Some(path) = arguments.out.iter().find(|path| !is_known(path)) {
        return Err(Failure::bad(format!(
            "{}: the ending tells what is written: html (the report), csv or json",
            path.display()
        )));
    }
    if let Some(path) = arguments
        .values
        .iter()
        .find(|path| !has_ending(path, "csv"))
    {
        return Err(Failure::bad(format!(
            "{}: a table is written as csv: let its name end in .csv",
            path.display()
        )));
    }
    let mut inputs = sources.files();
    inputs.extend(arguments.table.clone());
    let outputs = arguments.out.iter().chain(&arguments.values);
    let outputs: Vec<&Path> = outputs.map(std::path::PathBuf::as_path).collect();
    check_outputs(&outputs, &inputs, "the command")
}

/// The pairs of leaves that are drawn: those named, or the first leaves of each pair of groups.
fn overlays(
    arguments: &CompareNetworksArguments,
    sources: &Sources,
) -> Result<Vec<[usize; 2]>, Failure> {
    let named = |name: &String| {
        let found = sources.leaves.iter().position(|leaf| &leaf.name == name);
        found.ok_or_else(|| {
            let names = sources.leaves.iter().map(|leaf| leaf.name.as_str());
            let meant = nearest(name, names)
                .map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
            Failure::bad(format!(
                "--overlay: no leaf is called `{}`{meant}",
                name.escape_debug()
            ))
        })
    };
    if let [one, other] = arguments.overlay.as_slice() {
        let pair = [named(one)?, named(other)?];
        if pair[0] == pair[1] {
            return Err(Failure::bad(format!(
                "--overlay: {one} lies over itself in any case: name another leaf"
            )));
        }
        return Ok(vec![pair]);
    }
    let first = |group: usize| sources.leaves.iter().position(|leaf| leaf.group == group);
    let pairs = (1..sources.groups.len()).filter_map(|group| Some([first(0)?, first(group)?]));
    Ok(pairs.take(overlay::MOST).collect())
}
