//! `lamina compare-networks`: measures of networks, or of groups of leaves, side by side.

mod leaves;
mod sources;
#[cfg(test)]
mod tests;

use std::path::Path;
use std::time::Instant;

use leafmodel::measure::keys;

use self::leaves::measure_all;
use self::sources::Sources;
use crate::cli::arguments::CompareNetworksArguments;
use crate::cli::needs::on_threads;
use crate::cli::places::{check_outputs, has_ending, require_ending, write_and_say};
use crate::cli::progress::Patience;
use crate::cli::terminal::{Failure, did_you_mean, note, say};
use crate::comparison::leaves::LEFT_OUT;
use crate::comparison::{Findings, Wanted};
use crate::report::comparison::{csv, html, json, overlay, words};

pub(super) fn run(arguments: &CompareNetworksArguments) -> Result<(), Failure> {
    let started = Instant::now();
    check_keys(&arguments.only)?;
    let sources = Sources::new(arguments)?;
    let overlays = overlays(arguments, &sources)?;
    check_files(arguments, &sources)?;
    let _patience = Patience::about("growing, measuring and comparing");
    let findings = on_threads(arguments.threads, || found(arguments, &sources, overlays))?;
    // All are made before one is written: an alignment that cannot be is an error.
    let mut files: Vec<(&Path, String)> = Vec::new();
    for path in &arguments.out {
        let text = if has_ending(path, "json") {
            format!("{:#}\n", json::json(&findings))
        } else if has_ending(path, "csv") {
            csv::csv(&findings)
        } else {
            let has_named = !arguments.overlay.is_empty();
            html::html(&findings, arguments.align, has_named).map_err(Failure::bad)?
        };
        files.push((path, text));
    }
    if let Some(path) = &arguments.values {
        files.push((path, csv::values(&findings)));
    }
    note(&findings.notes);
    say(words::text(&findings));
    for line in words::conclusions(&findings) {
        eprintln!("{line}");
    }
    for (path, text) in files {
        write_and_say(path, text)?;
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
    let wanted = Wanted {
        title: arguments.title.clone(),
        only: arguments.only.clone(),
        all_pairs: arguments.all_pairs,
        seed: arguments.seed,
        overlays,
    };
    let names: Vec<(String, usize)> = leaves
        .iter()
        .map(|leaf| (leaf.name.clone(), leaf.group))
        .collect();
    Findings::new(sources.groups.clone(), leaves, wanted).map_err(|[one, other]| {
        let ((one, group), (other, _)) = (&names[one], &names[other]);
        bad!(
            "{one} and {other} of group {} are the same network: each leaf of a group counts as one of its own, \
             so name it once, or grow it by a plan that heeds its seed",
            sources.groups[*group]
        )
    })
}

/// Fails for a measure that there is not.
fn check_keys(only: &[String]) -> Result<(), Failure> {
    for key in only {
        if !keys().any(|known| known == key) {
            let meant = did_you_mean(key, keys());
            bail!(
                "--only: there is no measure `{}`{meant}",
                key.escape_debug()
            );
        }
        if LEFT_OUT.contains(&key.as_str()) {
            bail!("--only: `{key}` is not compared, because its numbers go together");
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
        bail_at!(
            path,
            "the ending tells what is written: html (the report), csv or json"
        );
    }
    require_ending(&arguments.values, "csv", "a table is written as csv")?;
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
            let meant = did_you_mean(name, names);
            bad!(
                "--overlay: no leaf is called `{}`{meant}",
                name.escape_debug()
            )
        })
    };
    if let [one, other] = arguments.overlay.as_slice() {
        let pair = [named(one)?, named(other)?];
        if pair[0] == pair[1] {
            bail!("--overlay: {one} lies over itself in any case: name another leaf");
        }
        return Ok(vec![pair]);
    }
    let first = |group: usize| sources.leaves.iter().position(|leaf| leaf.group == group);
    let pairs = (1..sources.groups.len()).filter_map(|group| Some([first(0)?, first(group)?]));
    Ok(pairs.take(overlay::MOST).collect())
}
