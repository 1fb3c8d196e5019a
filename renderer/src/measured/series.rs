//! One spectrum a file: a plain table of two columns, ASCII export of an ASD, or an SVC's `.sig`.
//!
//! | form | mark | columns |
//! | --- | --- | --- |
//! | table | anything else | wavelength and value; comma, semicolon, tab or blanks; `#` before comments; an optional line of names |
//! | ASD | a line that begins with `Wavelength`, below any lines about the instrument | wavelength and value |
//! | SVC | `/*** Spectra Vista SIG Data ***/` in the first line | behind `data=`: wavelength, radiance of the reference, of the target, and their ratio in percent, which is taken |

use std::ops::Range;

use leafmodel::document::encoding::{Decoded, decoded};
use leafmodel::document::rows::{self, Field, Guess, Rows, Separator};

use super::columns::{Column, column, is_wavelength};
use super::known::{Known, Overlap, ValueUnit, WavelengthUnit};
use super::masks::{is_masked, left_out};
use super::misnomers::{other_axis, other_value};
use super::units::{are_percent, contradiction, falling, guess, in_micrometres, note, percent};
use super::{Fault, Slack, What};

/// How a file of one spectrum is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Two columns.
    Table,
    /// ASCII export of a spectrometer by ASD.
    Asd,
    /// A `.sig` file of a spectrometer by SVC.
    Svc,
}

/// One spectrum, in the order of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// How the file is laid out.
    pub form: Form,
    /// Wavelengths and values.
    pub points: Vec<(f64, f64)>,
    /// Bytes of the text where wavelength and value of each stand.
    pub spans: Vec<[Range<usize>; 2]>,
    /// What was guessed or left out.
    pub notes: Vec<Guess>,
    /// Whether the values are percent because the form says so.
    is_percent: bool,
    /// Whether the name of the wavelengths says that they are µm.
    is_um: bool,
    /// The name of the column of values.
    name: Option<Field>,
}

/// First words of a `.sig` file.
const SVC: &str = "/*** Spectra Vista SIG Data";
/// Most detectors of a spectrometer.
const MOST_DETECTORS: usize = 4;
/// First bytes of binary files of ASD, by version.
const ASD_BINARY: [&[u8]; 4] = [b"ASD", b"as6", b"as7", b"as8"];

impl Series {
    /// Refuses wavelengths that do not rise, and files without any.
    ///
    /// # Errors
    ///
    /// A [`Fault`] with the wavelength's place.
    pub fn require_rising(&self) -> Result<(), Fault> {
        if self.points.is_empty() {
            return Err(Fault::of_file("there are no lines of numbers", ""));
        }
        let falls = (1..self.points.len()).find(|&i| self.points[i].0 <= self.points[i - 1].0);
        falls.map_or(Ok(()), |i| {
            let [before, after] = [self.points[i - 1].0, self.points[i].0];
            let problem = format!("has wavelength {after} behind {before}");
            let help = falling(before, after, &self.notes).unwrap_or("sort the lines");
            Err(Fault::at(self.spans[i][0].clone(), problem, help))
        })
    }

    /// Refuses shares below 0 and above 1.
    ///
    /// # Errors
    ///
    /// A [`Fault`] with the value's place.
    pub fn require_shares(&self, Slack(slack): Slack) -> Result<(), Fault> {
        let is_bad = |(_, value): &(f64, f64)| !(-slack..=1.0 + slack).contains(value);
        self.points.iter().position(is_bad).map_or(Ok(()), |i| {
            let (nm, value) = self.points[i];
            let problem = format!("has {value} at {nm} nm, allowed is 0 to 1");
            Err(Fault::at(self.spans[i][1].clone(), problem, ""))
        })
    }

    /// Brings wavelengths into nm if their column's name says another unit.
    pub fn to_nm(&mut self) {
        if self.is_um {
            self.points.iter_mut().for_each(|point| point.0 *= 1000.0);
        }
    }

    /// Brings the spectrum into nm and fractions of 0 to 1; what was guessed, with the notes.
    ///
    /// # Errors
    ///
    /// A [`Fault`] if the name of the values says that they are something else.
    pub fn to_nm_and_fractions(&mut self, known: &Known) -> Result<Vec<Guess>, Fault> {
        let name = self.name.as_ref();
        if let Some((field, (what, help))) =
            name.and_then(|field| Some((field, other_value(&field.text)?)))
        {
            let problem = format!("has {what} in the column `{}`", field.shown());
            return Err(Fault::at(field.span.clone(), problem, help));
        }
        let mut notes = self.notes.clone();
        let wavelengths = self.points.iter().map(|point| point.0);
        let is_um = in_micrometres(known.wavelengths, self.is_um, wavelengths, &mut notes);
        let percent_name = name.filter(|field| column(&field.text).is_percent);
        let is_percent = known.values.map_or_else(
            || {
                let values: Vec<f64> = self.points.iter().map(|point| point.1).collect();
                let is_guess = are_percent(values.iter().copied());
                if let Some(name) = percent_name {
                    notes.extend(contradiction(&name.text, &values));
                    return true;
                }
                notes.extend(if self.is_percent {
                    let what = "values are percent, as in every .sig file";
                    Some(guess(what, "values", "fraction"))
                } else {
                    is_guess.then(percent)
                });
                is_guess || self.is_percent
            },
            |unit| unit == ValueUnit::Percent,
        );
        for point in &mut self.points {
            if is_um {
                point.0 *= 1000.0;
            }
            if is_percent {
                point.1 /= 100.0;
            }
        }
        Ok(notes)
    }

    /// Takes what a line of names says.
    fn take_names(&mut self, fields: Vec<Field>) -> Result<(), Fault> {
        let mut fields = fields.into_iter();
        let Some(first) = fields.next() else {
            return Ok(());
        };
        self.name = fields.next();
        refuse_other_axis(&first)?;
        if let Column::Wavelength(unit) = column(&first.text).holds {
            self.is_um = unit == Some(WavelengthUnit::Micrometres);
            return Ok(());
        }
        let is_second = self.name.as_ref();
        if is_second.is_some_and(|name| is_wavelength(&name.text)) {
            let problem = format!("has `{}` before the wavelengths", first.shown());
            let help = "put the wavelengths into the first column";
            return Err(Fault::at(first.span, problem, help));
        }
        if !first.text.is_empty() {
            let name = first.shown();
            self.notes.push(note(format!(
                "the column `{name}` is taken for wavelengths"
            )));
        }
        Ok(())
    }

    /// Joins the detectors of a spectrometer, the wavelengths of each of which rise: where two have
    /// measured, one counts.
    fn join_detectors(&mut self, overlap: Option<Overlap>) -> Result<(), Fault> {
        let nm = |i: usize| self.points[i].0;
        let falls = (1..self.points.len()).filter(|&i| nm(i) <= nm(i - 1));
        let ends: Vec<usize> = falls.chain([self.points.len()]).collect();
        if ends.len() > MOST_DETECTORS {
            let at = ends[0];
            let problem = format!("has wavelength {} behind {}", nm(at), nm(at - 1));
            let help = "wavelengths rise, and fall only where the next of a few detectors begins";
            return Err(Fault::at(self.spans[at][0].clone(), problem, help));
        }
        let mut keep = vec![true; self.points.len()];
        let mut start = 0;
        for pair in ends.windows(2) {
            let (middle, end) = (pair[0], pair[1]);
            let [from, to] = [nm(middle), nm(middle - 1)];
            let (last_of_first, cut) = match overlap.unwrap_or(Overlap::Middle) {
                Overlap::Middle => (0.5 * (from + to), 0.5 * (from + to)),
                Overlap::First => (to, to),
                Overlap::Second => (from.next_down(), from.next_down()),
            };
            let of_first = self.points[start..end].iter().zip(&mut keep[start..end]);
            for (number, (point, keep)) in of_first.enumerate() {
                let is_first = start + number < middle;
                *keep &= if is_first {
                    point.0 <= last_of_first
                } else {
                    point.0 > cut
                };
            }
            if overlap.is_none() {
                let what = format!(
                    "two detectors have measured from {from} to {to} nm: values up to {cut} nm are \
                     those of the first, above those of the second"
                );
                self.notes.push(guess(what, "overlap", "first"));
            }
            start = middle;
        }
        retain(&mut self.points, &keep);
        retain(&mut self.spans, &keep);
        Ok(())
    }
}

/// Keeps the elements of a list for which it is said.
pub fn retain<T>(list: &mut Vec<T>, keep: &[bool]) {
    let mut keep = keep.iter();
    list.retain(|_| *keep.next().unwrap_or(&true));
}

/// The text of a file, in any usual encoding.
///
/// # Errors
///
/// A [`Fault`] if it is no text.
pub fn text(bytes: &[u8]) -> Result<Decoded<'_>, Fault> {
    decoded(bytes).map_err(|error| {
        if ASD_BINARY.iter().any(|start| bytes.starts_with(start)) {
            let problem = "is a binary file of an ASD";
            let help = "export it as text: in ViewSpec Pro, Process, ASCII Export";
            return Fault::of_file(problem, help);
        }
        Fault::of_file(error.to_string(), "save it as UTF-8 text")
    })
}

/// The spectrum of a text.
///
/// # Errors
///
/// The first [`Fault`].
pub fn series(text: &str, known: &Known) -> Result<Series, Fault> {
    let (form, start, columns) = form(text)?;
    let separator = match form {
        Form::Svc => Some(known.form.separator.unwrap_or(Separator::Blanks)),
        Form::Table | Form::Asd => known.form.separator,
    };
    let decimal = known.form.decimal;
    let table = Rows::below(text, start, rows::Form { separator, decimal }).of_numbers();
    let mut found = Series {
        form,
        points: Vec::new(),
        spans: Vec::new(),
        is_percent: form == Form::Svc,
        is_um: false,
        name: None,
        notes: Vec::new(),
    };
    let mut names_allowed = form != Form::Svc;
    let mut masked = Vec::new();
    for mut row in table.of_any_length() {
        row.cut(columns);
        let fields = &row.fields;
        let is_names = std::mem::take(&mut names_allowed)
            && fields
                .first()
                .is_some_and(|first| table.number(first).is_none());
        if is_names {
            found.take_names(row.fields)?;
            continue;
        }
        let ([first, .., last], true) = (fields.as_slice(), fields.len() == columns) else {
            return Err(wrong_columns(row.span(), fields.len(), columns));
        };
        let wavelength = number(&table, first)?;
        let is_masked = is_masked(&table, last, known.masked);
        masked.push((wavelength, is_masked));
        if !is_masked {
            found.points.push((wavelength, number(&table, last)?));
            found.spans.push([first.span.clone(), last.span.clone()]);
        }
    }
    found.notes.extend(table.guesses());
    let (all, is_masked): (Vec<f64>, Vec<bool>) = masked.into_iter().unzip();
    found.notes.extend(left_out("", &all, &is_masked));
    if found.points.windows(2).all(|pair| pair[1].0 < pair[0].0) {
        found.points.reverse();
        found.spans.reverse();
    }
    if form == Form::Svc || known.overlap.is_some() {
        found.join_detectors(known.overlap)?;
    }
    Ok(found)
}

/// The form of a text, where its names or numbers begin, and how many columns they have.
fn form(text: &str) -> Result<(Form, usize, usize), Fault> {
    if text.starts_with(SVC) {
        let mut at = 0;
        for line in text.split_inclusive('\n') {
            at += line.len();
            if line.trim() == "data=" {
                return Ok((Form::Svc, at, 4));
            }
        }
        let help = "behind it stand wavelength, reference, target and percent";
        return Err(Fault::of_file("has no line `data=`", help));
    }
    let mut at = 0;
    for line in text.split_inclusive('\n').take(200) {
        let first = line
            .split(['\t', ',', ';'])
            .next()
            .unwrap_or_default()
            .trim();
        // Plain tables may name their columns so too: then nothing is above.
        if first.eq_ignore_ascii_case("wavelength") && at > 0 {
            return Ok((Form::Asd, at, 2));
        }
        at += line.len();
    }
    let is_export = text
        .lines()
        .next()
        .is_some_and(|line| line.starts_with("Wavelength\t"));
    let form = if is_export { Form::Asd } else { Form::Table };
    Ok((form, 0, 2))
}

fn wrong_columns(span: Range<usize>, found: usize, wanted: usize) -> Fault {
    let problem = format!("has {found} columns in this line, wanted are {wanted}");
    let help = if wanted == 2 {
        "keep the wavelength in nm and the value"
    } else {
        "a .sig file has wavelength, reference, target and percent"
    };
    Fault::at(span, problem, help)
}

/// Refuses a first column whose name says that it holds no wavelengths.
pub(super) fn refuse_other_axis(name: &Field) -> Result<(), Fault> {
    other_axis(&name.text).map_or(Ok(()), |(what, help)| {
        let problem = format!("has {what} in the column `{}`", name.shown());
        Err(Fault::at(name.span.clone(), problem, help))
    })
}

pub(super) fn number(table: &Rows<'_>, field: &Field) -> Result<f64, Fault> {
    match table.number(field) {
        Some(number) if number.is_finite() => Ok(number),
        Some(_) => Err(Fault {
            span: Some(field.span.clone()),
            what: What::NotFinite {
                value: field.shown(),
            },
        }),
        None => {
            let problem = format!("has `{}` where a number is wanted", field.shown());
            let help = "write a number, or `#` before a comment";
            Err(Fault::at(field.span.clone(), problem, help))
        }
    }
}

#[cfg(test)]
mod tests;
