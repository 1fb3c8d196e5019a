//! Spectra to fit, from a table of leaves or from files of one spectrum each.

use std::path::{Path, PathBuf};

use crate::cli::Failure;
use crate::cli::arguments::FitArguments;
use crate::measured::Slack;
use crate::measured::series::{self, Series};
use crate::measured::spectra::{self, Leaf};
use crate::measured::units;

/// The files that are read, at least one.
pub(super) fn files(arguments: &FitArguments) -> Vec<PathBuf> {
    let single = [
        &arguments.adaxial,
        &arguments.abaxial,
        &arguments.transmittance,
    ];
    let all = std::iter::once(&arguments.spectra).chain(single);
    all.flatten().cloned().collect()
}

/// The leaves, within what noise explains; stderr says what was taken for granted.
pub(super) fn leaves(arguments: &FitArguments) -> Result<Vec<Leaf>, Failure> {
    let leaves = match &arguments.spectra {
        Some(file) => of_table(file)?,
        None => vec![of_single_files(arguments)?],
    };
    for leaf in &leaves {
        if let Some(at) = units::gap(&leaf.nm) {
            let (from, to) = (leaf.nm[at - 1], leaf.nm[at]);
            let name = super::shown(leaf);
            eprintln!("note: {name}: nothing between {from} and {to} nm, which fits do not need");
        }
    }
    Ok(leaves)
}

fn read(file: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(file).map_err(|error| Failure::bad(format!("{}: {error}", file.display())))
}

fn of_table(file: &Path) -> Result<Vec<Leaf>, Failure> {
    let bytes = read(file)?;
    let text = series::text(&bytes).map_err(|fault| Failure::bad(fault.shown(file, "")))?;
    let refused = |fault: &crate::measured::Fault| Failure::bad(fault.shown(file, text));
    let found = spectra::read(text).map_err(|fault| refused(&fault))?;
    for note in &found.notes {
        eprintln!("note: {note}");
    }
    for leaf in &found.leaves {
        let checked = leaf.check(text, Slack::NOISE);
        checked.map_err(|fault| refused(&fault))?;
    }
    Ok(found.leaves)
}

fn of_single_files(arguments: &FitArguments) -> Result<Leaf, Failure> {
    let single = |file: &Option<PathBuf>| file.as_deref().map(one_spectrum).transpose();
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
fn one_spectrum(file: &Path) -> Result<Series, Failure> {
    let bytes = read(file)?;
    let text = series::text(&bytes).map_err(|fault| Failure::bad(fault.shown(file, "")))?;
    let refused = |fault: &crate::measured::Fault| Failure::bad(fault.shown(file, text));
    let mut series = series::series(text).map_err(|fault| refused(&fault))?;
    series.require_rising().map_err(|fault| refused(&fault))?;
    for note in series.to_nm_and_shares() {
        eprintln!("note: {}: {note}", file.display());
    }
    let checked = series.require_shares(Slack::NOISE);
    checked.map_err(|fault| refused(&fault))?;
    Ok(series)
}
