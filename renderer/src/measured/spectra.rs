//! Tables of the spectra of leaves: which column is what, in which unit.
//!
//! A table has a line of names. One column holds wavelengths. Either every other column belongs to
//! a leaf and ends in R or T (`birch_R`, `birch_R_abaxial`, `birch.T`, `leaf 3 reflectance`), or a
//! column names the leaf of each line and others are R and T. Micrometres and percent are
//! recognised and told. [`of_files`] joins files of one spectrum each to a leaf.

use csv::StringRecord;
use leafmodel::document::rows::delimiter;

use super::columns::{Column, Measure, columns};
use super::series::Series;
use super::units::{MICROMETRES, PERCENT, are_micrometres, are_percent};
use super::{Fault, Lines, Slack, of_csv, quoted};

/// A leaf's spectra, by rising wavelength.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Leaf {
    /// Its name; empty if the table has but one.
    pub name: String,
    /// Wavelengths, nm.
    pub nm: Vec<f64>,
    /// Of the adaxial face; as long as the wavelengths, or empty.
    pub reflectance: Vec<f64>,
    /// Of the abaxial face; as long as the wavelengths, or empty.
    pub abaxial: Vec<f64>,
    /// As long as the wavelengths, or empty.
    pub transmittance: Vec<f64>,
    /// The line of the file of each wavelength; empty if it is of several files.
    pub lines: Vec<usize>,
}

/// Leaves of a table, and what was taken for granted about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectra {
    /// In the order of the file.
    pub leaves: Vec<Leaf>,
    /// Sentences.
    pub notes: Vec<String>,
}

impl Leaf {
    fn values(&mut self, measure: Measure) -> &mut Vec<f64> {
        match measure {
            Measure::Reflectance => &mut self.reflectance,
            Measure::Abaxial => &mut self.abaxial,
            Measure::Transmittance => &mut self.transmittance,
        }
    }

    fn all(&self) -> [(&'static str, &Vec<f64>); 3] {
        [
            ("R", &self.reflectance),
            ("abaxial R", &self.abaxial),
            ("T", &self.transmittance),
        ]
    }

    /// Refuses what no leaf has: values below 0 or above 1, R + T above 1.
    ///
    /// # Errors
    ///
    /// A [`Fault`] with line, value and wavelength, the first along the file.
    pub fn check(&self, text: &str, Slack(slack): Slack) -> Result<(), Fault> {
        let name = if self.name.is_empty() {
            String::new()
        } else {
            format!("{}: ", quoted(&self.name))
        };
        let fault = |i: usize, problem: String| {
            let problem = format!("{name}{problem}");
            let line = self.lines.get(i);
            line.map_or_else(
                || Fault::of_file(problem.clone(), ""),
                |line| Fault::in_line(text, *line, problem.clone(), ""),
            )
        };
        for (what, values) in self.all() {
            if !values.is_empty() && values.len() != self.nm.len() {
                let (has, all) = (values.len(), self.nm.len());
                let problem = format!("{name}{what} has {has} values at {all} wavelengths");
                return Err(Fault::of_file(problem, ""));
            }
        }
        for (i, nm) in self.nm.iter().enumerate() {
            for (what, values) in self.all() {
                if let Some(value) = values.get(i)
                    && !(-slack..=1.0 + slack).contains(value)
                {
                    let problem = format!("{what} is {value} at {nm} nm, allowed is 0 to 1");
                    return Err(fault(i, problem));
                }
            }
            let Some(through) = self.transmittance.get(i) else {
                continue;
            };
            for (what, values) in &self.all()[..2] {
                let sum = values.get(i).map(|back| back + through);
                if let Some(sum) = sum.filter(|sum| *sum > 1.0 + slack) {
                    let problem = format!("{what} + T is {sum} at {nm} nm, allowed is up to 1");
                    return Err(fault(i, problem));
                }
            }
        }
        Ok(())
    }
}

/// Reads a table.
///
/// # Errors
///
/// The first [`Fault`] of its form; [`Leaf::check`] looks at the values.
pub fn read(text: &str) -> Result<Spectra, Fault> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter(text))
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let names = reader
        .headers()
        .map_err(|error| of_csv(text, &error))?
        .clone();
    let columns = columns(&names).map_err(|what| Fault::of_file(what, ""))?;
    let mut leaves = Leaves::new(&columns);
    let mut lines = Lines::of(text);
    for record in reader.records() {
        let record = record.map_err(|error| of_csv(text, &error))?;
        let line = record.position().map_or(1, |began| lines.at(began));
        leaves
            .add(&record, &names, &columns, line)
            .map_err(|problem| Fault::in_line(text, line, problem, ""))?;
    }
    let mut leaves = leaves.found;
    if leaves.is_empty() {
        return Err(Fault::of_file("there are no lines of numbers", ""));
    }
    let mut notes = Vec::new();
    if are_micrometres(leaves.iter().flat_map(|leaf| leaf.nm.iter().copied())) {
        notes.push(MICROMETRES.to_owned());
        for nm in leaves.iter_mut().flat_map(|leaf| &mut leaf.nm) {
            *nm *= 1000.0;
        }
    }
    let values = leaves
        .iter()
        .flat_map(|leaf| leaf.all().map(|(_, values)| values));
    if are_percent(values.flatten().copied()) {
        notes.push(PERCENT.to_owned());
        for leaf in &mut leaves {
            for measure in [
                Measure::Reflectance,
                Measure::Abaxial,
                Measure::Transmittance,
            ] {
                for value in leaf.values(measure) {
                    *value /= 100.0;
                }
            }
        }
    }
    Ok(Spectra { leaves, notes })
}

/// Leaves while lines are read.
struct Leaves {
    found: Vec<Leaf>,
    /// The leaf of each column's latest value.
    latest: Vec<Option<usize>>,
}

impl Leaves {
    fn new(columns: &[Column]) -> Self {
        Self {
            found: Vec::new(),
            latest: vec![None; columns.len()],
        }
    }

    fn add(
        &mut self,
        record: &StringRecord,
        names: &StringRecord,
        columns: &[Column],
        line: usize,
    ) -> Result<(), String> {
        let place = |wanted: &Column| columns.iter().position(|column| column == wanted);
        let nm = number(record, names, place(&Column::Wavelength).unwrap_or(0))?;
        let of_line = place(&Column::Name);
        for (column, kind) in columns.iter().enumerate() {
            let (measure, leaf) = match kind {
                Column::Of(measure, leaf) => (*measure, leaf),
                Column::Wavelength | Column::Name | Column::Other => continue,
            };
            let leaf = of_line.map_or(leaf.as_str(), |column| &record[column]);
            let value = number(record, names, column)?;
            let known = self.latest[column].filter(|&i| self.found[i].name == leaf);
            let i = known
                .or_else(|| self.found.iter().position(|known| known.name == leaf))
                .unwrap_or_else(|| {
                    self.found.push(Leaf {
                        name: leaf.to_owned(),
                        ..Leaf::default()
                    });
                    self.found.len() - 1
                });
            self.latest[column] = Some(i);
            let leaf = &mut self.found[i];
            if leaf.nm.last() != Some(&nm) {
                if let Some(last) = leaf.nm.last().filter(|last| nm < **last) {
                    return Err(format!("wavelength {nm} after {last}: sort the lines"));
                }
                leaf.nm.push(nm);
                leaf.lines.push(line);
            }
            let wanted = leaf.nm.len();
            let values = leaf.values(measure);
            values.push(value);
            if values.len() != wanted {
                return Err(format!("wavelength {nm} is there twice for one leaf"));
            }
        }
        Ok(())
    }
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

fn number(record: &StringRecord, names: &StringRecord, column: usize) -> Result<f64, String> {
    let written = &record[column];
    let value = written
        .parse::<f64>()
        .ok()
        .filter(|value| value.is_finite());
    value.ok_or_else(|| {
        let name = quoted(&names[column]);
        if written.is_empty() {
            return format!("{name} is missing: write a number, or leave the line out");
        }
        format!("{name} is \"{}\", not a number", quoted(written))
    })
}

#[cfg(test)]
mod tests;
