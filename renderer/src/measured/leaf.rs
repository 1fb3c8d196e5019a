//! The spectra of a leaf.

use leafmodel::document::source::quoted;

use super::known::Measure;
use super::{Fault, Slack};

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

impl Leaf {
    pub(super) fn values(&mut self, measure: Measure) -> &mut Vec<f64> {
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
        let name = before(&self.name);
        let fault = |i: usize, problem: String| {
            let problem = format!("{name}{problem}");
            match self.lines.get(i) {
                Some(line) => Fault::in_line(text, *line, problem, ""),
                None => Fault::of_file(problem, ""),
            }
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

/// The name of a leaf before what is said about it.
pub(super) fn before(name: &str) -> String {
    match name {
        "" => String::new(),
        name => format!("{}: ", quoted(name)),
    }
}
