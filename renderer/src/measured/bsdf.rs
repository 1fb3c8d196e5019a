//! A measured BRDF or BTDF over angles: its reciprocal part, its error, its energy.
//!
//! A table has the columns `theta_i`, `phi_i`, `theta_o`, `phi_o`, `wavelength` and `value`, in any
//! order. Angles are degrees, θ from the normal of the face (0 to 90 on its side, 90 to 180 behind
//! it, so that a BTDF has one angle on each side), φ around it; both directions point away from the
//! surface. Wavelengths are nm, values sr⁻¹ without the cosine. Radians and micrometres are
//! recognised, and notes say so.
//!
//! Reciprocity says `f(i → o) = f(o → i)`. A row's partner is the row whose directions are its own,
//! exchanged; where light comes from one azimuth only the surface is taken to be isotropic and
//! azimuths count from there. `f` is the sum of `(f + f′)/2`, its reciprocal part, and
//! `(f − f′)/2`, its error. Nothing is interpolated: a row without a partner keeps its value and
//! has no error.

use std::collections::BTreeMap;

use leafmodel::document::rows::{Field, Guess, Row, Rows};

use super::columns::listed;
use super::known::{AngleUnit, Known};
use super::units::{guess, ignored, in_micrometres};
use super::{Fault, of_ragged};

mod energy;
mod sample;

pub use self::energy::Energy;
pub use self::sample::{Direction, Sample};
use self::sample::{SAME_DEG, Steps, steps, wavelength_steps};

/// The greatest θ in radians, half a turn and what rounding adds to it.
const MOST_RADIANS: f64 = std::f64::consts::PI + 1e-3;
/// Columns, by what they hold.
const COLUMNS: [&str; 6] = [
    "theta_i theta_i_deg theta_in",
    "phi_i phi_i_deg phi_in",
    "theta_o theta_o_deg theta_out theta_r",
    "phi_o phi_o_deg phi_out phi_r",
    "wavelength wavelength_nm wavelength_um nm um wl",
    "value f brdf bsdf btdf",
];

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// In the order of the file.
    pub samples: Vec<Sample>,
    /// What was guessed or passed over.
    pub notes: Vec<Guess>,
}

/// A row with what reciprocity makes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parted {
    /// As it stands.
    pub sample: Sample,
    /// Mean of the row and its partner; its own value if it has none, sr⁻¹.
    pub reciprocal: f64,
    /// Half of their difference, sr⁻¹; `None` without a partner.
    pub error: Option<f64>,
}

/// Reciprocity at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Wavelength, nm.
    pub nm: f64,
    /// Rows.
    pub rows: usize,
    /// Rows with a partner.
    pub paired: usize,
    /// Root mean square of the values of rows with a partner, sr⁻¹.
    pub rms: f64,
    /// Root mean square of their errors, sr⁻¹.
    pub error_rms: f64,
    /// The greatest error in size, sr⁻¹, and the line of its row; `None` without pairs.
    pub worst: Option<(f64, usize)>,
}

/// What a check finds.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// Whether azimuths count from that of the light.
    pub is_isotropic: bool,
    /// The rows.
    pub rows: Vec<Parted>,
    /// By wavelength.
    pub bands: Vec<Band>,
    /// By wavelength and incident direction.
    pub energy: Vec<Energy>,
}

/// Reads a table.
///
/// # Errors
///
/// The first [`Fault`]: a column that is missing, a value that is negative or no number, an angle
/// out of range, a row that is there twice.
pub fn read(text: &str, known: &Known) -> Result<Table, Fault> {
    let table = Rows::written(text, known.form);
    let mut rows = table.records();
    let names = rows.next().transpose();
    let names = names.map_err(|ragged| of_ragged(&ragged))?;
    let names = names.map_or_else(Vec::new, |row| row.fields);
    let mut places = [0; 6];
    // Whether names of angles say radians, or degrees.
    let mut said = [None; 6];
    for ((place, said), words) in places.iter_mut().zip(&mut said).zip(COLUMNS) {
        let found = names.iter().position(|name| {
            let lower = name.text.to_ascii_lowercase();
            let plain = lower.strip_suffix("_rad").unwrap_or(&lower);
            words.split(' ').any(|word| word == plain)
        });
        *place = found.ok_or_else(|| {
            let (wanted, _) = words.split_once(' ').unwrap_or((words, ""));
            let problem = format!("has no column `{wanted}`; it has {}", listed(names.iter()));
            let help = "columns are theta_i, phi_i, theta_o, phi_o, wavelength, value";
            Fault::of_file(problem, help)
        })?;
        let lower = names[*place].text.to_ascii_lowercase();
        let units = [("_rad", AngleUnit::Radians), ("_deg", AngleUnit::Degrees)];
        let mut units = units.into_iter();
        *said = units.find_map(|(end, unit)| lower.ends_with(end).then_some(unit));
    }
    let any = said.into_iter().flatten().next();
    let is_radian = said.map(|own| known.angles.or(own).or(any) == Some(AngleUnit::Radians));
    let mut samples = Vec::new();
    for row in rows {
        let Row { line, fields, .. } = row.map_err(|ragged| of_ragged(&ragged))?;
        let mut numbers = [0.0; 6];
        for (number, place) in numbers.iter_mut().zip(places) {
            let field = &fields[place];
            let value = table.number(field).filter(|value| value.is_finite());
            *number = value.ok_or_else(|| {
                let (name, value) = (names[place].shown(), field.shown());
                let problem = format!("{name} is \"{value}\", not a number");
                Fault::at(field.span.clone(), problem, "")
            })?;
        }
        for at in (0..4).filter(|&at| is_radian[at]) {
            let field = &fields[places[at]];
            let degrees = in_degrees(numbers[at], at % 2 == 0, &names[places[at]], field)?;
            // A unit that a person says holds for all and is applied to all.
            if known.angles.is_none() {
                numbers[at] = degrees;
            }
        }
        let [theta_i, phi_i, theta_o, phi_o, nm, value] = numbers;
        if value < 0.0 {
            let problem = format!("value is {value} sr⁻¹, allowed is 0 and more");
            return Err(Fault::in_line(text, line, problem, ""));
        }
        let direction = |theta, phi| Direction { theta, phi };
        samples.push(Sample {
            incident: direction(theta_i, phi_i),
            scattered: direction(theta_o, phi_o),
            nm,
            value,
            line,
        });
    }
    if samples.is_empty() {
        return Err(Fault::of_file("there are no lines of numbers", ""));
    }
    let mut notes = table.guesses();
    let others = names.iter().enumerate();
    let others = others.filter(|(at, _)| !places.contains(at));
    notes.extend(ignored(others.map(|(_, name)| name)));
    let said = any.map(|_| AngleUnit::Degrees);
    notes.extend(to_degrees_and_nm(&mut samples, known, said));
    let thetas = |sample: &Sample| [sample.incident.theta, sample.scattered.theta];
    let is_out = |theta: f64| !(0.0..=180.0).contains(&theta);
    if let Some(bad) = samples.iter().find(|s| thetas(s).into_iter().any(is_out)) {
        let [i, o] = thetas(bad);
        let problem = format!("theta_i is {i}°, theta_o {o}°, allowed is 0 to 180");
        return Err(Fault::in_line(text, bad.line, problem, ""));
    }
    if let Some(bad) = samples.iter().find(|sample| sample.nm <= 0.0) {
        let problem = format!("wavelength is {} nm, allowed is above 0", bad.nm);
        return Err(Fault::in_line(text, bad.line, problem, ""));
    }
    refuse_twins(text, &samples)?;
    Ok(Table { samples, notes })
}

/// An angle in radians in degrees; θ is at most half a turn.
fn in_degrees(angle: f64, is_theta: bool, name: &Field, field: &Field) -> Result<f64, Fault> {
    let degrees = angle.to_degrees();
    if is_theta && angle > MOST_RADIANS {
        let name = name.shown();
        let problem =
            format!("{name} is {angle} and in radians, so {degrees:.2}°, allowed is up to 180°");
        let help = "if the angles are degrees, say --angles degrees";
        return Err(Fault::at(field.span.clone(), problem, help));
    }
    Ok(if is_theta {
        degrees.min(180.0)
    } else {
        degrees
    })
}

/// Brings angles into degrees and wavelengths into nm; what was guessed.
fn to_degrees_and_nm(samples: &mut [Sample], known: &Known, said: Option<AngleUnit>) -> Vec<Guess> {
    let mut notes = Vec::new();
    let unit = known.angles.or(said).unwrap_or_else(|| {
        let (unit, note) = angles(samples);
        notes.extend(note);
        unit
    });
    if unit == AngleUnit::Radians {
        for sample in &mut *samples {
            for direction in [&mut sample.incident, &mut sample.scattered] {
                direction.theta = direction.theta.to_degrees().min(180.0);
                direction.phi = direction.phi.to_degrees();
            }
        }
    }
    let nm = samples.iter().map(|sample| sample.nm);
    let is_um = in_micrometres(known.wavelengths, false, nm, &mut notes);
    if is_um {
        for sample in samples {
            sample.nm *= 1000.0;
        }
    }
    notes
}

/// The unit of angles by their sizes. Where none is more than half a turn can be in radians, whole
/// numbers are degrees and others radians, and a note says so.
fn angles(samples: &[Sample]) -> (AngleUnit, Option<Guess>) {
    use std::f64::consts::TAU;
    let all = |of: fn(&Direction) -> f64| {
        let both = samples
            .iter()
            .flat_map(|sample| [sample.incident, sample.scattered]);
        both.map(move |direction| of(&direction).abs())
    };
    let theta = all(|direction| direction.theta).fold(0.0, f64::max);
    let phi = all(|direction| direction.phi).fold(0.0, f64::max);
    if theta == 0.0 || theta > MOST_RADIANS || phi > TAU + 1e-3 {
        return (AngleUnit::Degrees, None);
    }
    let is_whole = |angle: f64| angle.fract() == 0.0;
    let (unit, word, other) = if all(|direction| direction.theta)
        .chain(all(|direction| direction.phi))
        .all(is_whole)
    {
        (AngleUnit::Degrees, "degrees", "radians")
    } else {
        (AngleUnit::Radians, "radians", "degrees")
    };
    let what = format!("angles, θ up to {theta}, are taken for {word}");
    (unit, Some(guess(what, "angles", other)))
}

fn refuse_twins(text: &str, samples: &[Sample]) -> Result<(), Fault> {
    let mut seen = BTreeMap::new();
    for sample in samples {
        // As written: a grid may have its pole once for each azimuth.
        let raw = |direction: Direction| [direction.theta.to_bits(), direction.phi.to_bits()];
        let key = (
            raw(sample.incident),
            raw(sample.scattered),
            sample.nm.to_bits(),
        );
        if let Some(before) = seen.insert(key, sample.line) {
            let problem = format!("has the directions and wavelength of line {before} again");
            return Err(Fault::in_line(text, sample.line, problem, ""));
        }
    }
    Ok(())
}

/// Both directions and the wavelength of a row, in whole steps.
type PairKey = (Steps, Steps, i64);

/// The key of a row whose light goes from `from` to `to`; azimuths count from that of `from` if the
/// surface is isotropic.
fn key(from: Direction, to: Direction, nm: f64, is_isotropic: bool) -> PairKey {
    let (from, to) = if is_isotropic {
        let is_pole = |direction: Direction| {
            steps(direction)[1] == 0 && {
                let theta = steps(direction)[0];
                theta == 0
                    || theta
                        == steps(Direction {
                            theta: 180.0,
                            phi: 0.0,
                        })[0]
            }
        };
        let turn = if is_pole(from) { to.phi } else { from.phi };
        let turned = |direction: Direction| Direction {
            phi: direction.phi - turn,
            ..direction
        };
        (turned(from), turned(to))
    } else {
        (from, to)
    };
    (steps(from), steps(to), wavelength_steps(nm))
}

impl Table {
    /// Checks reciprocity and energy.
    pub fn check(&self) -> Check {
        // At a pole the azimuth says nothing.
        let mut azimuths = (self.samples.iter().map(|sample| sample.incident))
            .filter(|own| own.theta > SAME_DEG && own.theta < 180.0 - SAME_DEG)
            .map(|own| own.phi);
        let first = azimuths.next();
        let is_isotropic = azimuths.all(|phi| {
            let off = (phi - first.unwrap_or(phi)).rem_euclid(360.0);
            off.min(360.0 - off) < SAME_DEG
        });
        // Sum and number of the rows of each key: a pole may be there once for each azimuth.
        let mut known: BTreeMap<PairKey, (f64, u32)> = BTreeMap::new();
        for sample in &self.samples {
            let key = key(sample.incident, sample.scattered, sample.nm, is_isotropic);
            let (sum, count) = known.entry(key).or_default();
            *sum += sample.value;
            *count += 1;
        }
        let rows = self.samples.iter().map(|&sample| {
            let back = key(sample.scattered, sample.incident, sample.nm, is_isotropic);
            let partner = known.get(&back).map(|(sum, count)| sum / f64::from(*count));
            Parted {
                sample,
                reciprocal: partner.map_or(sample.value, |partner| 0.5 * (sample.value + partner)),
                error: partner.map(|partner| 0.5 * (sample.value - partner)),
            }
        });
        let rows: Vec<Parted> = rows.collect();
        Check {
            is_isotropic,
            bands: bands(&rows),
            energy: energy::by_incidence(&self.samples),
            rows,
        }
    }
}

fn bands(rows: &[Parted]) -> Vec<Band> {
    let mut by_wavelength: BTreeMap<i64, Vec<&Parted>> = BTreeMap::new();
    for row in rows {
        let of = by_wavelength.entry(wavelength_steps(row.sample.nm));
        of.or_default().push(row);
    }
    let bands = by_wavelength.into_values().map(|rows| {
        let paired = || {
            rows.iter()
                .filter_map(|row| row.error.map(|error| (row, error)))
        };
        let count = paired().count();
        let mean = |sum: f64| (sum / count.max(1) as f64).sqrt();
        let worst = paired().fold(None, |worst: Option<(f64, usize)>, (row, error)| {
            let is_worse = worst.is_none_or(|(most, _)| error.abs() > most.abs());
            if is_worse {
                Some((error, row.sample.line))
            } else {
                worst
            }
        });
        Band {
            nm: rows[0].sample.nm,
            rows: rows.len(),
            paired: count,
            rms: mean(paired().map(|(row, _)| row.sample.value.powi(2)).sum()),
            error_rms: mean(paired().map(|(_, error)| error * error).sum()),
            worst,
        }
    });
    bands.collect()
}

#[cfg(test)]
mod tests;
