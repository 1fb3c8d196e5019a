//! Tables of the spectra of leaves: which column is what, in which unit.
//!
//! A table has a line of names. One column holds wavelengths. Either every other column belongs to
//! a leaf and ends in R or T (`birch_R`, `birch_R_abaxial`, `birch.T`, `leaf 3 reflectance`), or a
//! column names the leaf of each line and others are R and T. Or each line is a leaf, and columns are
//! named by wavelengths. Wavelengths rise or fall. Micrometres, percent and masked bands are
//! recognised; notes name them, and every column that is not read. [`of_files`] joins files of one
//! spectrum each to a leaf.

mod leaves;

use std::collections::BTreeMap;

use leafmodel::document::rows::{Field, Guess, Rows, without_mark};

use self::leaves::{Draft, Leaves};
use super::columns::{Column, Named, columns, is_wavelength};
use super::known::{Known, ValueUnit, WavelengthUnit};
pub use super::leaf::Leaf;
use super::series::Series;
use super::units::{
    self, are_percent, contradiction, greatest_fraction, guess, ignored, in_micrometres, note,
    percent,
};
use super::{Fault, misnomers, of_ragged};

/// Leaves of a table, and what was taken for granted about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectra {
    /// In the order of the file.
    pub leaves: Vec<Leaf>,
    /// What was guessed, left out or passed over.
    pub notes: Vec<Guess>,
}

/// Reads a table.
///
/// # Errors
///
/// The first [`Fault`] of its form; [`Leaf::check`] looks at the values.
pub fn read(text: &str, known: &Known) -> Result<Spectra, Fault> {
    let start = names_at(text);
    let table = Rows::below(text, start, known.form);
    let mut rows = table.records();
    let names = match rows.next() {
        Some(Ok(row)) => row.fields,
        Some(Err(ragged)) => return Err(of_ragged(&ragged)),
        None => return Err(Fault::of_file("is empty: it has no line of names", "")),
    };
    let columns = misnomers::refuse(&names).and_then(|()| columns(&names, known.quantity));
    let columns = columns.map_err(|what| Fault::of_file(what, ""))?;
    let mut leaves = Leaves::new(known);
    for row in rows {
        let row = row.map_err(|ragged| of_ragged(&ragged))?;
        if row.fields.iter().all(|field| field.text.is_empty()) {
            continue;
        }
        leaves
            .add(&table, &row, &names, &columns)
            .map_err(|problem| Fault::in_line(text, row.line, problem, ""))?;
    }
    let mut notes = table.guesses();
    let above = text[..start].lines().map(str::trim);
    let above = above.filter(|line| !line.is_empty() && !line.starts_with('#'));
    let lines = above.count();
    if lines > 0 {
        notes.push(note(format!(
            "lines above the names of columns that are not read: {lines}"
        )));
    }
    let others = names.iter().zip(&columns);
    let others = others.filter(|(_, column)| column.holds == Column::Other);
    notes.extend(ignored(others.map(|(name, _)| name)));
    if leaves.is_guess {
        let what =
            "values in columns that are named by wavelengths alone are taken for reflectances";
        notes.push(guess(what, "quantity", "transmittance"));
    }
    let mut drafts = leaves.found;
    to_nm_and_fractions(&mut drafts, (&names, &columns), known, &mut notes)?;
    let mut leaves = Vec::with_capacity(drafts.len());
    for draft in drafts {
        leaves.extend(draft.leaf(text, known, &mut notes)?);
    }
    if leaves.is_empty() {
        return Err(Fault::of_file("there are no lines of numbers", ""));
    }
    Ok(Spectra { leaves, notes })
}

/// Where the line of names begins: the first line, or below lines about an instrument the first that
/// begins with a word of wavelengths.
fn names_at(text: &str) -> usize {
    const MOST_LINES: usize = 200;
    let mut at = 0;
    for line in text.split_inclusive('\n').take(MOST_LINES) {
        let first = without_mark(line)
            .split(['\t', ',', ';'])
            .next()
            .unwrap_or_default();
        let first = first.trim_matches(|c: char| c == '"' || c.is_whitespace());
        if is_wavelength(first) {
            return at;
        }
        at += line.len();
    }
    0
}

/// Brings wavelengths into nm and values into fractions, by what the columns or a person say, or else
/// by their sizes.
fn to_nm_and_fractions(
    drafts: &mut [Draft],
    (names, columns): (&[Field], &[Named]),
    known: &Known,
    notes: &mut Vec<Guess>,
) -> Result<(), Fault> {
    let says_um = columns
        .iter()
        .any(|column| column.holds == Column::Wavelength(Some(WavelengthUnit::Micrometres)));
    let points = drafts.iter().flat_map(|draft| &draft.points);
    let nm = points.map(|point| point.nm);
    let is_um = in_micrometres(known.wavelengths, says_um, nm, notes);
    if is_um {
        for point in drafts.iter_mut().flat_map(|draft| &mut draft.points) {
            point.nm *= 1000.0;
        }
    }
    let percent = which_are_percent(drafts, names, known, notes)?;
    for (draft, percent) in drafts.iter_mut().zip(percent) {
        for values in draft.points.iter_mut().map(|point| &mut point.values) {
            for (value, _) in values.iter_mut().zip(percent).filter(|both| both.1) {
                *value = value.map(|value| value / 100.0);
            }
        }
    }
    Ok(())
}

/// Which measures of each leaf are percent. Columns whose names do not say it are all percent or all
/// fractions, because one of them alone may be either.
fn which_are_percent(
    drafts: &[Draft],
    names: &[Field],
    known: &Known,
    notes: &mut Vec<Guess>,
) -> Result<Vec<[bool; 3]>, Fault> {
    if let Some(unit) = known.values {
        return Ok(vec![[unit == ValueUnit::Percent; 3]; drafts.len()]);
    }
    let mut found = vec![[false; 3]; drafts.len()];
    let mut contradictions: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    let mut unnamed = Vec::new();
    for (draft, found) in drafts.iter().zip(&mut found) {
        for measured in draft.measures() {
            match measured.percent {
                Some(column) => {
                    found[measured.of] = true;
                    let values = contradictions.entry(column).or_default();
                    values.extend(measured.values);
                }
                None => unnamed.push(measured),
            }
        }
    }
    let is_any_named = !contradictions.is_empty();
    for (column, values) in contradictions {
        notes.extend(contradiction(&names[column].text, &values));
    }
    let is_percent = are_percent(unnamed.iter().flat_map(|own| &own.values).copied());
    notes.extend(is_percent.then(percent));
    let large = unnamed
        .iter()
        .find(|own| are_percent(own.values.iter().copied()));
    let small = unnamed
        .iter()
        .filter(|own| own.fits_fractions)
        .find_map(|own| Some((own, greatest_fraction(&own.values)?)));
    if let (Some(large), Some((small, greatest))) = (large, small) {
        let most = units::greatest(&large.values);
        let problem = format!(
            "{} looks like percent, up to {most}, and {} like fractions, up to {greatest}",
            large.name, small.name
        );
        let help = "write all in one unit; if they are all percent, say --values percent, or in a \
                    scene `values = \"percent\"`";
        return Err(Fault::of_file(problem, help));
    }
    if let Some((small, greatest)) = small.filter(|_| is_any_named) {
        let name = &small.name;
        let what = format!(
            "{name} is taken for fractions, up to {greatest}: only other columns are named percent"
        );
        notes.push(guess(what, "values", "percent"));
    }
    for (draft, found) in drafts.iter().zip(&mut found) {
        for measured in draft.measures().filter(|own| own.percent.is_none()) {
            found[measured.of] = is_percent;
        }
    }
    Ok(found)
}

/// A leaf of files of one spectrum each, in nm and shares: R of the adaxial face, R of the abaxial
/// face, T. The wavelengths are those of the first that is there, as far as all have values; the
/// others are linear between theirs.
///
/// # Panics
///
/// If no file is there, or wavelengths do not rise: the caller looked.
pub fn of_files(name: &str, files: [Option<&Series>; 3]) -> Leaf {
    let there = || files.iter().copied().flatten();
    let first = there().next().expect("a file is there");
    let low = there().map(|series| series.points[0].0);
    let low = low.fold(f64::NEG_INFINITY, f64::max);
    let high = there().map(|series| series.points[series.points.len() - 1].0);
    let high = high.fold(f64::INFINITY, f64::min);
    let nm = first.points.iter().map(|point| point.0);
    let nm: Vec<f64> = nm.filter(|nm| (low..=high).contains(nm)).collect();
    let [reflectance, abaxial, transmittance] = files.map(|series| {
        series.map_or_else(Vec::new, |series| {
            nm.iter().map(|&nm| between(&series.points, nm)).collect()
        })
    });
    Leaf {
        name: name.to_owned(),
        nm,
        reflectance,
        abaxial,
        transmittance,
        lines: Vec::new(),
    }
}

/// The value at a wavelength within points that rise, linear between them.
fn between(points: &[(f64, f64)], nm: f64) -> f64 {
    let above = points.partition_point(|point| point.0 < nm);
    let above = above.min(points.len() - 1);
    let (x1, y1) = points[above];
    if x1 <= nm || above == 0 {
        return y1;
    }
    let (x0, y0) = points[above - 1];
    y0 + (y1 - y0) * (nm - x0) / (x1 - x0)
}

#[cfg(test)]
mod tests;
