//! Rows of a table become leaves.

use std::collections::HashMap;

use leafmodel::document::rows::{Field, Guess, Row, Rows};
use leafmodel::document::source::quoted;

use crate::measured::Fault;
use crate::measured::columns::{Column, Named, measure_of_cell};
use crate::measured::known::{Known, Measure};
use crate::measured::leaf::{Leaf, before};
use crate::measured::masks::{is_masked, left_out, masked_ranges};
use crate::measured::units::{falling, guess, note};

/// Leaves while lines are read.
pub(super) struct Leaves<'k> {
    pub(super) found: Vec<Draft>,
    /// The leaves by their names.
    numbers: HashMap<String, usize>,
    known: &'k Known,
    /// Whether what was measured is a guess.
    pub(super) is_guess: bool,
}

/// A leaf while lines are read.
#[derive(Default)]
pub(super) struct Draft {
    name: String,
    pub(super) points: Vec<Point>,
    /// The points by the bits of their wavelengths.
    numbers: HashMap<u64, usize>,
    /// Measures that have a column.
    has: [bool; 3],
    /// The column of each measure whose name says percent.
    percent: [Option<usize>; 3],
}

/// A measure of a leaf.
pub(super) struct Measured {
    /// Which.
    pub(super) of: usize,
    /// As messages name it.
    pub(super) name: String,
    pub(super) values: Vec<f64>,
    /// The column whose name says that the values are percent.
    pub(super) percent: Option<usize>,
    /// Whether the values may be fractions beside percent.
    pub(super) fits_fractions: bool,
}

/// What was measured of a leaf at a wavelength, by measure; nothing where that was masked.
pub(super) struct Point {
    pub(super) nm: f64,
    line: usize,
    pub(super) values: [Option<f64>; 3],
    is_there: [bool; 3],
}

impl<'k> Leaves<'k> {
    pub(super) fn new(known: &'k Known) -> Self {
        Self {
            found: Vec::new(),
            numbers: HashMap::new(),
            known,
            is_guess: false,
        }
    }

    /// Adds the values of a row; what is wrong with it otherwise.
    pub(super) fn add(
        &mut self,
        table: &Rows<'_>,
        row: &Row,
        names: &[Field],
        columns: &[Named],
    ) -> Result<(), String> {
        let place = |wanted: &dyn Fn(&Column) -> bool| {
            columns.iter().position(|column| wanted(&column.holds))
        };
        let fields = &row.fields;
        let nm = place(&|column| matches!(column, Column::Wavelength(_)));
        let nm = nm
            .map(|at| number(table, &names[at], &fields[at]))
            .transpose()?;
        let of_line = place(&|column| *column == Column::Name);
        let of_line = of_line.map(|at| fields[at].text.as_str());
        let quantity = place(&|column| *column == Column::Quantity);
        let quantity = quantity.filter(|_| nm.is_none()).map(|at| {
            measure_of_cell(&fields[at].text).ok_or_else(|| {
                let (name, cell) = (names[at].shown(), fields[at].shown());
                format!("{name} is \"{cell}\", neither reflectance nor transmittance")
            })
        });
        let quantity = quantity.transpose()?;
        // A leaf in each row: of several of one name each is a leaf of its own.
        let before = self.found.len();
        let of_row = |found: &[Draft], measure: Measure| match of_line {
            Some(name) if !name.is_empty() => {
                let is_same = |draft: &Draft| draft.name == name && draft.has[measure as usize];
                let is_second = found[..before].iter().any(is_same);
                is_second.then(|| format!("{name}, line {}", row.line))
            }
            Some(_) | None => Some(format!("line {}", row.line)),
        };
        let mut own_name: Option<Option<String>> = None;
        for (at, column) in columns.iter().enumerate() {
            let (measure, leaf, nm) = match (&column.holds, nm) {
                (Column::Of(measure, leaf), Some(nm)) => {
                    (*measure, of_line.unwrap_or(leaf.as_str()), nm)
                }
                (Column::Band(measure, nm), _) => {
                    let said = measure.or(quantity).or(self.known.quantity);
                    self.is_guess |= said.is_none();
                    let measure = said.unwrap_or(Measure::Reflectance);
                    let own = own_name.get_or_insert_with(|| of_row(&self.found, measure));
                    (measure, own.as_deref().or(of_line).unwrap_or_default(), *nm)
                }
                (
                    Column::Of(..)
                    | Column::Wavelength(_)
                    | Column::Name
                    | Column::Quantity
                    | Column::Other,
                    _,
                ) => continue,
            };
            let value = self.value(table, &names[at], &fields[at])?;
            let known = self.numbers.get(leaf).copied();
            let i = known.unwrap_or_else(|| {
                self.numbers.insert(leaf.to_owned(), self.found.len());
                self.found.push(Draft {
                    name: leaf.to_owned(),
                    ..Draft::default()
                });
                self.found.len() - 1
            });
            self.found[i].put(measure, nm, value, row.line)?;
            if column.is_percent {
                self.found[i].percent[measure as usize].get_or_insert(at);
            }
        }
        Ok(())
    }

    /// A value; nothing where it was masked.
    fn value(&self, table: &Rows<'_>, name: &Field, field: &Field) -> Result<Option<f64>, String> {
        if is_masked(table, field, self.known.masked) {
            return Ok(None);
        }
        number(table, name, field).map(Some)
    }
}

impl Draft {
    /// The measures that were read: the name of each, its values, and the column that says percent.
    pub(super) fn measures(&self) -> impl Iterator<Item = Measured> + '_ {
        let there = (0..3).filter(move |&of| self.has[of]);
        there.map(move |of| Measured {
            of,
            name: match (self.name.as_str(), ["R", "abaxial R", "T"][of]) {
                ("", word) => word.to_owned(),
                (leaf, word) => format!("{}: {word}", quoted(leaf)),
            },
            values: self
                .points
                .iter()
                .filter_map(|point| point.values[of])
                .collect(),
            percent: self.percent[of],
            fits_fractions: self.fits_fractions(of),
        })
    }

    /// Whether a measure may be fractions beside percent: R + T is at most 1 then.
    fn fits_fractions(&self, of: usize) -> bool {
        let other = [2, 2, 0][of];
        self.points.iter().all(|point| {
            let [own, other] = [of, other].map(|of| point.values[of].unwrap_or(0.0));
            own + other / 100.0 <= 1.0
        })
    }

    fn put(
        &mut self,
        measure: Measure,
        nm: f64,
        value: Option<f64>,
        line: usize,
    ) -> Result<(), String> {
        let next = self.points.len();
        let at = *self.numbers.entry(nm.to_bits()).or_insert(next);
        if at == next {
            self.points.push(Point {
                nm,
                line,
                values: [None; 3],
                is_there: [false; 3],
            });
        }
        let measure = measure as usize;
        self.has[measure] = true;
        let point = &mut self.points[at];
        if std::mem::replace(&mut point.is_there[measure], true) {
            return Err(format!("wavelength {nm} is there twice for one leaf"));
        }
        point.values[measure] = value;
        Ok(())
    }

    /// The leaf with the wavelengths at which all of its measures have values, rising; nothing if
    /// there are none.
    pub(super) fn leaf(
        mut self,
        text: &str,
        known: &Known,
        notes: &mut Vec<Guess>,
    ) -> Result<Option<Leaf>, Fault> {
        let falls = |pair: &&[Point]| pair[1].nm < pair[0].nm;
        if 2 * self.points.windows(2).filter(falls).count() + 1 > self.points.len() {
            self.points.reverse();
        }
        let falls = self.points.windows(2).find(|pair| pair[1].nm <= pair[0].nm);
        if let Some([before, after]) = falls {
            let (first, second) = if before.line < after.line {
                (before, after)
            } else {
                (after, before)
            };
            let help = falling(first.nm, second.nm, notes)
                .unwrap_or("sort the lines so that wavelengths rise or fall");
            let problem = format!("wavelength {} after {}: {help}", second.nm, first.nm);
            return Err(Fault::in_line(text, second.line, problem, ""));
        }
        let name = before(&self.name);
        let mut has = self.has;
        for (measure, (word, _)) in Measure::ALL.into_iter().enumerate() {
            let mut values = self.points.iter().map(|point| point.values[measure]);
            if has[measure] && values.all(|value| value.is_none()) {
                has[measure] = false;
                notes.push(note(format!("{name}no band has a {word}")));
            }
        }
        let is_whole = |point: &Point| (0..3).all(|of| !has[of] || point.values[of].is_some());
        let masked: Vec<bool> = self.points.iter().map(|point| !is_whole(point)).collect();
        let is_any = has.contains(&true) && masked.contains(&false);
        let nm: Vec<f64> = self.points.iter().map(|point| point.nm).collect();
        notes.extend(left_out(&name, &nm, &masked).filter(|_| is_any));
        if known.masked.is_none() {
            let zero = |point: &Point| (0..3).any(|of| has[of] && point.values[of] == Some(0.0));
            let zero: Vec<bool> = self.points.iter().map(zero).collect();
            let is_band = zero
                .windows(LEAST_ZEROS)
                .any(|run| run.iter().all(|zero| *zero));
            let bands = masked_ranges(&nm, &zero);
            if is_band && !zero.iter().all(|zero| *zero) {
                let what = format!("{name}values of exactly 0 are taken as measured: {bands}");
                notes.push(guess(what, "masked", "0"));
            }
        }
        if !is_any {
            return Ok(None);
        }
        let mut leaf = Leaf {
            name: self.name,
            ..Leaf::default()
        };
        for (point, _) in self.points.iter().zip(masked).filter(|(_, masked)| !masked) {
            leaf.nm.push(point.nm);
            leaf.lines.push(point.line);
            for (_, measure) in Measure::ALL {
                let value = point.values[measure as usize];
                leaf.values(measure)
                    .extend(value.filter(|_| has[measure as usize]));
            }
        }
        Ok(Some(leaf))
    }
}

/// Neighbouring values of 0 that make a masked band likely.
const LEAST_ZEROS: usize = 3;

fn number(table: &Rows<'_>, name: &Field, field: &Field) -> Result<f64, String> {
    let value = table.number(field).filter(|value| value.is_finite());
    value.ok_or_else(|| {
        let name = name.shown();
        if field.text.is_empty() {
            return format!("{name} is missing: write a number, or leave the line out");
        }
        format!("{name} is \"{}\", not a number", field.shown())
    })
}
