//! Spectra to fit, from a table of leaves or from files of one spectrum each.

use std::path::{Path, PathBuf};

use leafmodel::document::source::quoted;

use crate::cli::arguments::FitArguments;
use crate::cli::terminal::{Failure, note};
use crate::cli::texts::text_of;
use crate::measured::known::Known;
use crate::measured::series::{self, Series};
use crate::measured::spectra::{self, Leaf};
use crate::measured::{Slack, units};
use crate::provenance::{Hashes, hash_of};
use crate::report::fit::shown;

/// The files that are read, at least one.
pub(super) fn files(arguments: &FitArguments) -> Vec<PathBuf> {
    named(arguments).map(|(_, file)| file.clone()).collect()
}

/// The files by the arguments that name them.
fn named(arguments: &FitArguments) -> impl Iterator<Item = (&'static str, &PathBuf)> {
    let all = [
        ("spectra", &arguments.spectra),
        ("adaxial", &arguments.adaxial),
        ("abaxial", &arguments.abaxial),
        ("transmittance", &arguments.transmittance),
    ];
    all.into_iter()
        .filter_map(|(name, file)| Some((name, file.as_ref()?)))
}

/// Their hashes.
pub(super) fn hashes(arguments: &FitArguments) -> Hashes {
    let hashed = |(name, file): (&str, &PathBuf)| (name.to_owned(), hash_of(file));
    named(arguments).map(hashed).collect()
}

/// The leaves, within what noise explains; stderr says what was taken for granted.
pub(super) fn leaves(arguments: &FitArguments) -> Result<Vec<Leaf>, Failure> {
    let known = arguments.known();
    let leaves = match &arguments.spectra {
        Some(file) => of_table(file, &known)?,
        None => vec![of_single_files(arguments)?],
    };
    note(leaves.iter().flat_map(gaps));
    Ok(leaves)
}

/// All gaps in a leaf's wavelengths.
fn gaps(leaf: &Leaf) -> Vec<String> {
    let gaps = units::gaps(&leaf.nm, units::GAP).map(|at| {
        let (from, to, name) = (leaf.nm[at - 1], leaf.nm[at], quoted(shown(leaf)));
        format!("{name}: nothing between {from} and {to} nm, which fits do not need")
    });
    gaps.collect()
}

fn of_table(file: &Path, known: &Known) -> Result<Vec<Leaf>, Failure> {
    let text = text_of(file)?;
    let refused = |fault: &crate::measured::Fault| Failure::bad(fault.shown(file, &text));
    let found = spectra::read(&text, known).map_err(|fault| refused(&fault))?;
    note(&found.notes);
    for leaf in &found.leaves {
        let checked = leaf.check(&text, Slack::NOISE);
        checked.map_err(|fault| refused(&fault))?;
    }
    Ok(found.leaves)
}

fn of_single_files(arguments: &FitArguments) -> Result<Leaf, Failure> {
    let known = arguments.known();
    let single = |file: &Option<PathBuf>| {
        file.as_deref()
            .map(|file| one_spectrum(file, &known))
            .transpose()
    };
    let found = [
        single(&arguments.adaxial)?,
        single(&arguments.abaxial)?,
        single(&arguments.transmittance)?,
    ];
    let name = files(arguments)
        .first()
        .and_then(|file| file.file_stem())
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let leaf = spectra::of_files(&name, found.each_ref().map(Option::as_ref));
    leaf.check("", Slack::NOISE)
        .map_err(|fault| Failure::bad(fault.shown(&files(arguments)[0], "")))?;
    Ok(leaf)
}

/// A spectrum in nm and shares, whose wavelengths rise.
fn one_spectrum(file: &Path, known: &Known) -> Result<Series, Failure> {
    let text = text_of(file)?;
    let refused = |fault: &crate::measured::Fault| Failure::bad(fault.shown(file, &text));
    let mut series = series::series(&text, known).map_err(|fault| refused(&fault))?;
    series.require_rising().map_err(|fault| refused(&fault))?;
    let notes = series.to_nm_and_fractions(known);
    for note in notes.map_err(|fault| refused(&fault))? {
        eprintln!("note: {}: {note}", file.display());
    }
    let checked = series.require_shares(Slack::NOISE);
    checked.map_err(|fault| refused(&fault))?;
    Ok(series)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_gap_is_named() {
        let nm = (400..=2498).step_by(4).map(f64::from);
        let nm = nm.filter(|nm| !(1350.0..1450.0).contains(nm) && !(1800.0..1960.0).contains(nm));
        let leaf = Leaf {
            nm: nm.collect(),
            ..Leaf::default()
        };
        let rest = "nm, which fits do not need";
        assert_eq!(
            gaps(&leaf),
            [
                format!("the leaf: nothing between 1348 and 1452 {rest}"),
                format!("the leaf: nothing between 1796 and 1960 {rest}"),
            ]
        );
    }
}
