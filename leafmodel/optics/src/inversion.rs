//! What a leaf holds, from what it reflects and transmits: PROSPECT inverted.
//!
//! - **In**: R of one face or of both, T, or any of them, at wavelengths within PROSPECT's tables,
//!   which contents are free, and what is known of them beforehand.
//! - **Out**: the contents of the least sum of squares, their standard errors, and what is left.
//! - **Always true**: contents are in range; the same spectra give the same bits.
//! - **Left out**: shifts by the model's own error. Errors are wider where residuals are correlated
//!   along a spectrum, as smooth noise and the model's own error are ([`correlated`]).
//!
//! PROSPECT has one face. Where the abaxial one was measured too, its reflectance is that of the
//! adaxial face times `abaxial_ratio`, whose contrast is one more unknown: a rule, not a model of
//! the tissue.
//!
//! A normal prior of a content is one more residual: its distance from the mean in deviations, times
//! the noise of an independent value, which is that of the residuals without priors.
//!
//! [`least_squares`] finds a local minimum; it starts from leaves of several kinds on few
//! wavelengths, and the best goes on with all of them.
//!
//! ```
//! use optics::inversion::{Inversion, Spectra};
//! use optics::{Constituent, Contents, Model, Pigments, ProspectD};
//!
//! let leaf = Contents::new(1.6, 42.0, 9.0, 1.0, 0.1, 0.012, 0.006)?;
//! let nm: Vec<f64> = (0..211).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
//! let mut reflectance = Vec::new();
//! for &nm in &nm {
//!     reflectance.push(ProspectD::coefficients(nm)?.reflectance_transmittance(&leaf).reflectance);
//! }
//! let free = Model::ProspectD.inputs();
//! let inversion = Inversion::new(&Pigments::default(), &nm, free, Contents::NOTHING)?;
//! let found = inversion.of(Spectra { reflectance: Some(&reflectance), ..Spectra::default() });
//! assert!((found.contents[Constituent::Chlorophyll] - 42.0).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod correlated;
pub mod least_squares;

use super::faces::{CONTRASTS, USUAL_CONTRAST, weight_of_contrast};
use super::pile::Slopes;
use super::prospect_d::OutsideTable;
use super::prospect_d::{FIRST_NM, LAST_NM};
use super::{Coefficients, Constituent, Contents, PerConstituent, Pigments, ProspectD};
use correlated::{Correlation, Fitted};
use least_squares::{EXACT, Fit, Minimum, Parameter, ROUGH, State, minimise};

/// Greatest number of wavelengths on which starts compete.
const FEW: usize = 64;

/// Half of the width of an interval of 95 % in standard errors, by the normal distribution.
pub const INTERVAL: f64 = 1.96;

/// Greatest structure that is looked for; measured leaves have 1 to 3.
const MOST_STRUCTURE: f64 = 5.0;

/// Least noise by which priors are weighed, where spectra are fitted exactly.
const LEAST_NOISE: f64 = 1e-9;

/// Leaves of which one is near any other: green, pale, red, dry; structure, chlorophyll,
/// carotenoids, anthocyanins, brown, water, dry matter.
const STARTS: [[f64; 7]; 4] = [
    [1.6, 40.0, 9.0, 1.0, 0.05, 0.012, 0.006],
    [1.3, 5.0, 2.0, 0.5, 0.05, 0.008, 0.003],
    [1.8, 20.0, 6.0, 15.0, 0.2, 0.015, 0.008],
    [2.2, 2.0, 3.0, 1.0, 1.0, 0.001, 0.01],
];

/// Spectra at the wavelengths of an [`Inversion`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Spectra<'a> {
    /// Reflectance of the adaxial face, or of the only one that was measured.
    pub reflectance: Option<&'a [f64]>,
    /// Reflectance of the abaxial face.
    pub abaxial: Option<&'a [f64]>,
    /// Transmittance.
    pub transmittance: Option<&'a [f64]>,
}

/// What is looked for, at which wavelengths.
#[derive(Clone, Debug)]
pub struct Inversion {
    nm: Vec<f64>,
    coefficients: Vec<Coefficients>,
    free: Vec<Constituent>,
    fixed: Contents,
    priors: PerConstituent<Option<Prior>>,
}

/// What is known of a content beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prior {
    /// It is between these ends.
    Within([f64; 2]),
    /// It is distributed normally.
    Normal {
        /// Around this value,
        mean: f64,
        /// with this standard deviation, > 0.
        deviation: f64,
    },
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The contents; those that were not free as they were given, those that are not determined as
    /// the model took them.
    pub contents: Contents,
    /// What is known of each content.
    pub known: PerConstituent<Determined>,
    /// Least and greatest value of each content that was looked for.
    pub bounds: PerConstituent<[f64; 2]>,
    /// Covariances of what is determined.
    pub covariance: Covariance,
    /// The correlation of residuals along the spectra, if there is one.
    pub correlation: Option<Correlation>,
    /// How much brighter the abaxial face is, if it was measured.
    pub contrast: Option<Contrast>,
    /// Found less measured, at each wavelength: reflectance; empty if there is none.
    pub reflectance_left: Vec<f64>,
    /// Of the abaxial reflectance; empty if there is none.
    pub abaxial_left: Vec<f64>,
    /// Of transmittance; empty if there is none.
    pub transmittance_left: Vec<f64>,
}

/// The contrast of the faces, see `abaxial_ratio`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contrast {
    /// The contrast.
    pub value: f64,
    /// What is known of it.
    pub known: Determined,
}

/// What spectra say of a content.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Determined {
    /// It was not looked for.
    Given,
    /// Its value, with this standard error.
    Within(f64),
    /// It is at the end of its range, beyond which the spectra would fit better.
    AtEnd,
    /// Nothing, for this reason.
    Not(&'static str),
}

impl Determined {
    /// The standard error.
    pub fn error(self) -> Option<f64> {
        match self {
            Self::Within(error) => Some(error),
            Self::Given | Self::AtEnd | Self::Not(_) => None,
        }
    }

    /// Whether there is a value.
    pub fn has_value(self) -> bool {
        !matches!(self, Self::Not(_))
    }

    /// Why there is no value, or no error.
    pub fn reason(self) -> Option<&'static str> {
        match self {
            Self::Given | Self::Within(_) => None,
            Self::AtEnd => Some("at the end of its range"),
            Self::Not(reason) => Some(reason),
        }
    }
}

/// Covariances of what was found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Covariance {
    /// Contents, and `None` for the contrast of the faces.
    pub of: Vec<Option<Constituent>>,
    /// In their order.
    pub rows: Vec<Vec<f64>>,
}

impl<'a> Spectra<'a> {
    /// Those that there are, in their order.
    fn all(&self) -> impl Iterator<Item = &'a [f64]> {
        [self.reflectance, self.abaxial, self.transmittance]
            .into_iter()
            .flatten()
    }
}

impl Found {
    fn all_left(&self) -> impl Iterator<Item = &f64> {
        let reflected = self.reflectance_left.iter().chain(&self.abaxial_left);
        reflected.chain(&self.transmittance_left)
    }

    /// Root of the mean square of what is left.
    pub fn rms(&self) -> f64 {
        let sum: f64 = self.all_left().map(|left| left * left).sum();
        (sum / self.values().max(1) as f64).sqrt()
    }

    /// Number of values that were fitted.
    pub fn values(&self) -> usize {
        self.all_left().count()
    }
}

impl Inversion {
    /// An inversion at wavelengths in nm, with these absorptions. What is not `free` is as in `fixed`.
    ///
    /// # Errors
    ///
    /// [`OutsideTable`] for the first wavelength that is not in 400 to 2500 nm.
    pub fn new(
        pigments: &Pigments,
        nm: &[f64],
        free: &[Constituent],
        fixed: Contents,
    ) -> Result<Self, OutsideTable> {
        let at = |&nm: &f64| {
            let is_inside = (FIRST_NM..=LAST_NM).contains(&nm);
            let coefficients = || ProspectD::coefficients_of(pigments, nm);
            let outside = OutsideTable { wavelength_nm: nm };
            is_inside.then(coefficients).ok_or(outside)
        };
        Ok(Self {
            nm: nm.to_vec(),
            coefficients: nm.iter().map(at).collect::<Result<_, _>>()?,
            free: free.to_vec(),
            fixed,
            priors: PerConstituent::splat(None),
        })
    }

    /// The same with what is known beforehand of some contents.
    #[must_use]
    pub fn with_priors(self, priors: PerConstituent<Option<Prior>>) -> Self {
        Self { priors, ..self }
    }

    /// Whether it is of these wavelengths.
    pub fn is_at(&self, nm: &[f64]) -> bool {
        self.nm == nm
    }

    /// The contents of a leaf with these spectra.
    pub fn of(&self, spectra: Spectra<'_>) -> Found {
        let mut known: Vec<Parameter> = self.free.iter().map(|&of| self.parameter(of)).collect();
        let contrast = spectra.abaxial.map(|_| USUAL_CONTRAST);
        known.extend(contrast.map(|_| CONTRAST));
        let step = self.coefficients.len().div_ceil(FEW).max(1);
        let tried = STARTS.iter().map(|start| {
            let start = Contents::prospect_d(*start);
            // PROSPECT-PRO's parts of dry matter: a fifth of it are proteins.
            let dry = start[Constituent::DryMatter];
            let start = start.with(&[
                (Constituent::Proteins, 0.2 * dry),
                (Constituent::CarbonBased, 0.8 * dry),
            ]);
            let start = self.free.iter().map(|&of| start[of]).chain(contrast);
            let within = start.zip(&known).map(|(start, known)| {
                let [low, high] = known.bounds;
                start.clamp(low, high)
            });
            let start: Vec<f64> = within.collect();
            minimise(&known, &start, ROUGH, |at| self.fit(at, spectra, step, 0.0))
        });
        let best = tried.min_by(|a, b| a.sum.total_cmp(&b.sum));
        let start = best.map_or_else(Vec::new, |best| best.parameters);
        let mut found = minimise(&known, &start, EXACT, |at| self.fit(at, spectra, 1, 0.0));
        let mut noise = 0.0;
        if self.normal_priors().next().is_some() {
            noise = self.noise_of_independent_values(&found, spectra);
            found = minimise(&known, &found.parameters, EXACT, |at| {
                self.fit(at, spectra, 1, noise)
            });
        }
        let (states, covariance, correlation) = self.determined(&known, &found, spectra, noise);
        let mut of_contents = PerConstituent::splat(Determined::Given);
        for (&of, state) in self.free.iter().zip(&states) {
            of_contents[of] = *state;
        }
        let mut left = found.left.into_iter();
        let mut taken = |is_there: bool| -> Vec<f64> {
            let count = if is_there { self.coefficients.len() } else { 0 };
            left.by_ref().take(count).collect()
        };
        Found {
            contents: self.with(&found.parameters),
            known: of_contents,
            bounds: PerConstituent::from_fn(|of| self.parameter(of).bounds),
            covariance,
            correlation,
            contrast: spectra.abaxial.map(|_| Contrast {
                value: found.parameters[self.free.len()],
                known: states[self.free.len()],
            }),
            reflectance_left: taken(spectra.reflectance.is_some()),
            abaxial_left: taken(spectra.abaxial.is_some()),
            transmittance_left: taken(spectra.transmittance.is_some()),
        }
    }

    /// The number of measured values.
    fn values(&self, spectra: Spectra<'_>) -> usize {
        spectra.all().count() * self.coefficients.len()
    }

    /// Numbers of the unknowns that have normal priors, with mean and deviation.
    fn normal_priors(&self) -> impl Iterator<Item = (usize, [f64; 2])> {
        let free = self.free.iter().enumerate();
        free.filter_map(|(number, &of)| match self.priors[of] {
            Some(Prior::Normal { mean, deviation }) => Some((number, [mean, deviation])),
            Some(Prior::Within(_)) | None => None,
        })
    }

    /// The noise of as many values as count for one.
    fn noise_of_independent_values(&self, found: &Minimum, spectra: Spectra<'_>) -> f64 {
        let values = self.values(spectra);
        let spare = values.saturating_sub(found.unknowns).max(1);
        let correlation = self.correlated(found, spectra);
        let as_one = correlation.map_or(1.0, |(_, correlation)| correlation.values_as_one);
        (found.sum * as_one / spare as f64).sqrt().max(LEAST_NOISE)
    }

    /// What is known of each unknown, the covariance of those that are determined, and the
    /// correlation of what is left.
    fn determined(
        &self,
        known: &[Parameter],
        found: &Minimum,
        spectra: Spectra<'_>,
        noise: f64,
    ) -> (Vec<Determined>, Covariance, Option<Correlation>) {
        let numbers: Vec<usize> = (0..known.len())
            .filter(|&i| found.states[i] == State::Determined)
            .collect();
        let values = self.values(spectra);
        let mut rows = found.covariance(values);
        let correlated = self.correlated(found, spectra);
        if let Some((wider, _)) = &correlated {
            widen(&mut rows, wider);
        }
        // Priors err as they say: by one deviation, which is the noise of an independent value.
        for (row, a) in rows.iter_mut().zip(&found.influence) {
            for (value, b) in row.iter_mut().zip(&found.influence) {
                let of_priors = a[values..].iter().zip(&b[values..]);
                *value += noise * noise * of_priors.map(|(a, b)| a * b).sum::<f64>();
            }
        }
        let mut states: Vec<Determined> = found
            .states
            .iter()
            .map(|state| match state {
                // Those that are determined follow.
                State::AtBound | State::Determined => Determined::AtEnd,
                State::WithoutInfluence => Determined::Not("these values do not depend on it"),
                State::LikeOthers => Determined::Not("others change these values alike"),
                State::TooFewResiduals => {
                    Determined::Not("there are not more values than unknowns")
                }
            })
            .collect();
        let mut kept = Vec::new();
        for (place, &i) in numbers.iter().enumerate() {
            let error = rows[place][place].sqrt();
            let [low, high] = known[i].bounds;
            let reach = INTERVAL * error;
            let is_all = found.parameters[i] - reach <= low && found.parameters[i] + reach >= high;
            states[i] = if is_all {
                Determined::Not("its interval of 95 % covers its whole range")
            } else {
                kept.push(place);
                Determined::Within(error)
            };
        }
        let covariance = Covariance {
            of: kept
                .iter()
                .map(|&place| self.free.get(numbers[place]).copied())
                .collect(),
            rows: kept
                .iter()
                .map(|&a| kept.iter().map(|&b| rows[a][b]).collect())
                .collect(),
        };
        (states, covariance, correlated.map(|found| found.1))
    }

    /// The covariance of what is determined, if what is left is correlated along the spectra.
    fn correlated(
        &self,
        found: &Minimum,
        spectra: Spectra<'_>,
    ) -> Option<(Vec<Vec<f64>>, Correlation)> {
        if !self.nm.is_sorted() {
            return None;
        }
        let measured: Vec<&[f64]> = spectra.all().collect();
        let count = self.nm.len();
        let left = found.left.chunks_exact(count.max(1));
        let values: Vec<Vec<f64>> = measured
            .iter()
            .zip(left.clone())
            .map(|(measured, left)| measured.iter().zip(left).map(|(a, b)| a + b).collect())
            .collect();
        let fitted: Vec<Fitted<'_>> = values
            .iter()
            .zip(left)
            .map(|(values, left)| Fitted {
                nm: &self.nm,
                values,
                left,
            })
            .collect();
        correlated::covariance(&fitted, &found.influence, found.unknowns)
    }

    fn with(&self, values: &[f64]) -> Contents {
        let mut contents = self.fixed;
        for (&of, &value) in self.free.iter().zip(values) {
            contents[of] = value;
        }
        contents
    }

    /// Model less measurement at every `step`th wavelength: of R, of the abaxial R, then of T; then
    /// what priors lack where there is `noise`. The contrast of the faces follows the contents.
    fn fit(&self, at: &[f64], spectra: Spectra<'_>, step: usize, noise: f64) -> Fit {
        let contents = self.with(at);
        let plates = contents[Constituent::Structure];
        let contrast = at.get(self.free.len()).copied();
        let contrast = contrast.unwrap_or(USUAL_CONTRAST);
        let rows = self.coefficients.len().div_ceil(step);
        let measured = spectra.all().count();
        let priors = if noise > 0.0 {
            self.normal_priors().count()
        } else {
            0
        };
        let mut fit = Fit::of(at.len(), measured * rows + priors);
        for (row, coefficients) in self.coefficients.iter().step_by(step).enumerate() {
            let k = coefficients.absorption_per_plate(&contents);
            let leaf = Slopes::of(&coefficients.interface, k, plates);
            let [r, t] = leaf.values;
            let absorbed = 1.0 - r - t;
            let weight = weight_of_contrast(absorbed);
            let ratio = 1.0 + contrast * weight;
            let by_absorptance = contrast * 6.0 * absorbed * (1.0 - absorbed);
            // Values, and what brings the slopes of R and T to theirs.
            let of_r = (spectra.reflectance, r, [1.0, 0.0]);
            let of_abaxial = (
                spectra.abaxial,
                ratio * r,
                [ratio - by_absorptance * r, -by_absorptance * r],
            );
            let of_t = (spectra.transmittance, t, [0.0, 1.0]);
            let there = [of_r, of_abaxial, of_t].into_iter();
            let there = there.filter_map(|(values, value, by)| Some((values?, value, by)));
            for (number, (values, value, by)) in there.enumerate() {
                let place = number * rows + row;
                let along = |[r, t]: [f64; 2]| by[0] * r + by[1] * t;
                fit.left[place] = value - values[row * step];
                let by_absorption = along(leaf.by_absorption) / plates;
                for (slopes, &of) in fit.slopes.iter_mut().zip(&self.free) {
                    slopes[place] = if of == Constituent::Structure {
                        along(leaf.by_plates) - k * by_absorption
                    } else {
                        by_absorption * coefficients.absorption[of]
                    };
                }
            }
            if let (Some(slopes), Some(_)) = (fit.slopes.get_mut(self.free.len()), spectra.abaxial)
            {
                let number = usize::from(spectra.reflectance.is_some());
                slopes[number * rows + row] = r * weight;
            }
        }
        for (place, (number, [mean, deviation])) in self.normal_priors().take(priors).enumerate() {
            let place = measured * rows + place;
            fit.left[place] = noise * (at[number] - mean) / deviation;
            fit.slopes[number][place] = noise / deviation;
        }
        fit
    }

    /// A content as an unknown.
    fn parameter(&self, of: Constituent) -> Parameter {
        let usual = parameter(of);
        match self.priors[of] {
            Some(Prior::Within(bounds)) => Parameter { bounds, ..usual },
            Some(Prior::Normal { .. }) | None => usual,
        }
    }
}

/// Widens covariances so that no variance is below another one's. Correlations of the parameters are
/// those of the other.
fn widen(rows: &mut [Vec<f64>], wider: &[Vec<f64>]) {
    let factors: Vec<f64> = (0..rows.len())
        .map(|i| (rows[i][i] / wider[i][i]).max(1.0).sqrt())
        .collect();
    for (i, row) in rows.iter_mut().enumerate() {
        for (j, value) in row.iter_mut().enumerate() {
            *value = wider[i][j] * factors[i] * factors[j];
        }
    }
}

/// The contrast of the faces as an unknown.
const CONTRAST: Parameter = Parameter {
    bounds: CONTRASTS,
    scale: 0.2,
};

fn parameter(of: Constituent) -> Parameter {
    let [low, high] = of.range();
    let (high, scale) = match of {
        Constituent::Structure => (MOST_STRUCTURE, 0.5),
        Constituent::Chlorophyll => (high, 20.0),
        Constituent::Carotenoids
        | Constituent::Anthocyanins
        | Constituent::Betacyanins
        | Constituent::Betaxanthins => (high, 5.0),
        Constituent::Brown => (high, 0.5),
        Constituent::Water => (high, 0.01),
        Constituent::DryMatter | Constituent::Proteins | Constituent::CarbonBased => (high, 0.005),
        Constituent::Extra => (high, 10.0),
    };
    Parameter {
        bounds: [low, high],
        scale,
    }
}

#[cfg(test)]
mod tests;
