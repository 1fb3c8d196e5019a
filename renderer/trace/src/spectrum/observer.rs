//! The three sensitivities by which a film of colour sees: the CIE's observer, or those of a camera.
//!
//! - **In**: sensitivities by wavelength, as shipped by name or as a file has them.
//! - **Out**: linear sRGB that light of a wavelength contributes; what each channel sees.
//! - **Always true**: light of CIE illuminant D65 with the luminance Y has the colour Y, Y, Y, by
//!   the CIE's observer as by a camera.
//! - **Left out**: noise, saturation and the angle at which light meets a sensor.
//!
//! A camera's raw channels become linear sRGB by a matrix, [`fit`]ted to the colours of measured
//! surfaces under D65.

pub mod fit;

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::spectrum::cie;
use crate::spectrum::table::parse_shipped;
use fit::Fit;

/// Sensitivities by which a film sees.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub enum Observer {
    /// The CIE 1931 2° standard observer.
    #[default]
    Cie1931,
    /// A camera.
    Camera(Arc<Camera>),
}

/// A camera's relative sensitivities and its matrix.
#[derive(Clone, Deserialize, PartialEq, Serialize)]
#[serde(try_from = "Sensitivities", into = "Sensitivities")]
pub struct Camera {
    /// Its name, or that of its file.
    name: String,
    /// Wavelengths, nm, and relative sensitivities of red, green and blue; linear between, 0
    /// outside.
    rows: Vec<(f64, [f64; 3])>,
    /// Factors that make each channel 1 for light of D65 with Y = 1.
    balance: [f64; 3],
    /// From raw channels, balanced for D65, to linear sRGB.
    fit: Fit,
}

/// The name of a camera and its rows, from which all else of it follows.
type Sensitivities = (String, Vec<(f64, [f64; 3])>);

impl TryFrom<Sensitivities> for Camera {
    type Error = NotACamera;

    fn try_from((name, rows): Sensitivities) -> Result<Self, NotACamera> {
        Self::new(&name, rows)
    }
}

impl From<Camera> for Sensitivities {
    fn from(camera: Camera) -> Self {
        (camera.name, camera.rows)
    }
}

impl fmt::Debug for Camera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The name does not change what is recorded, and the rest follows from the rows.
        f.debug_tuple("Camera").field(&self.rows).finish()
    }
}

/// Why a table cannot be the sensitivities of a camera.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum NotACamera {
    /// Too few rows, or wavelengths that do not rise.
    #[error("has no two rows with rising, finite wavelengths")]
    Disordered,
    /// A value that is no sensitivity.
    #[error("has a value that is no finite number of 0 or more")]
    Negative,
    /// A channel that sees nothing.
    #[error("has a channel `{0}` that is 0 everywhere")]
    Blind(&'static str),
    /// Channels that cannot be told apart.
    #[error(
        "has channels that are proportional to each other, so that no colour follows from them"
    )]
    Dependent,
}

/// Names of the channels.
pub const CHANNELS: [&str; 3] = ["r", "g", "b"];

/// Cameras that are shipped: name, what it is and who measured it, table.
const SHIPPED: [(&str, &str, &str); 4] = [
    (
        "nikon-d5100",
        "Nikon D5100, measured by the National Physical Laboratory (Darrodi et al. 2015)",
        include_str!("cameras/nikon-d5100.csv"),
    ),
    (
        "canon-5d-mark-ii",
        "Canon EOS 5D Mark II, measured by Weta Digital",
        include_str!("cameras/canon-5d-mark-ii.csv"),
    ),
    (
        "sony-a7r-iii",
        "Sony α7R III, measured by Weta Digital",
        include_str!("cameras/sony-a7r-iii.csv"),
    ),
    (
        "sigma-sd1-merrill",
        "Sigma SD1 Merrill, measured by the National Physical Laboratory (Darrodi et al. 2015)",
        include_str!("cameras/sigma-sd1-merrill.csv"),
    ),
];

impl Observer {
    /// What the CIE's observer is called.
    pub const CIE_1931: &'static str = "cie-1931";

    /// Names of all observers that need no file.
    pub fn names() -> impl Iterator<Item = &'static str> {
        std::iter::once(Self::CIE_1931).chain(SHIPPED.iter().map(|(name, ..)| *name))
    }

    /// The observer of a name.
    pub fn by_name(name: &str) -> Option<Self> {
        if name == Self::CIE_1931 {
            return Some(Self::Cie1931);
        }
        let (name, _, text) = SHIPPED.iter().find(|(known, ..)| *known == name)?;
        let camera = Camera::new(name, parse_shipped(text));
        camera.ok().map(|camera| Self::Camera(Arc::new(camera)))
    }

    /// Its name, or that of its file.
    pub fn name(&self) -> &str {
        match self {
            Self::Cie1931 => Self::CIE_1931,
            Self::Camera(camera) => &camera.name,
        }
    }

    /// Linear sRGB of radiance 1, 1 nm wide, at a wavelength in nm.
    pub fn srgb_at(&self, nm: f64) -> [f64; 3] {
        match self {
            Self::Cie1931 => {
                cie::srgb_from_xyz(cie::observer(nm).map(|c| c / cie::luminance_integral()))
            }
            Self::Camera(camera) => {
                let raw = camera.sensitivities(nm);
                let raw = std::array::from_fn(|i| raw[i] * camera.balance[i]);
                camera.fit.srgb(raw)
            }
        }
    }

    /// What each channel sees at a wavelength in nm, relative: x̄, ȳ, z̄, or red, green, blue.
    pub(crate) fn channels_at(&self, nm: f64) -> [f64; 3] {
        match self {
            Self::Cie1931 => cie::observer(nm),
            Self::Camera(camera) => camera.sensitivities(nm),
        }
    }

    /// What it is, its matrix and what is known of its errors, as a picture tells them.
    pub fn told(&self) -> String {
        match self {
            Self::Cie1931 => "CIE 1931 2° standard observer".to_owned(),
            Self::Camera(camera) => camera.told(),
        }
    }
}

impl Camera {
    /// A camera of rows of wavelength in nm and sensitivities.
    ///
    /// # Errors
    ///
    /// [`NotACamera`].
    pub fn new(name: &str, rows: Vec<(f64, [f64; 3])>) -> Result<Self, NotACamera> {
        let rises = rows.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let is_finite = rows.iter().all(|(nm, _)| nm.is_finite() && *nm > 0.0);
        if rows.len() < 2 || !rises || !is_finite {
            return Err(NotACamera::Disordered);
        }
        let mut values = rows.iter().flat_map(|(_, values)| values);
        if values.any(|value| !value.is_finite() || *value < 0.0) {
            return Err(NotACamera::Negative);
        }
        let seen = seen_of_d65(&rows);
        if let Some(blind) = (0..3).find(|i| seen[*i].is_nan() || seen[*i] <= 0.0) {
            return Err(NotACamera::Blind(CHANNELS[blind]));
        }
        let balance = seen.map(|seen| 1.0 / seen);
        let fit = Fit::new(|nm| {
            let raw = linear(&rows, nm);
            std::array::from_fn(|i| raw[i] * balance[i])
        });
        Ok(Self {
            name: name.to_owned(),
            fit: fit.ok_or(NotACamera::Dependent)?,
            rows,
            balance,
        })
    }

    /// Its name, or that of its file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Wavelengths, nm, and relative sensitivities of red, green and blue.
    pub fn rows(&self) -> &[(f64, [f64; 3])] {
        &self.rows
    }

    /// Its matrix, and what that leaves of the differences to the CIE's observer.
    pub fn fit(&self) -> &Fit {
        &self.fit
    }

    /// Relative sensitivities at a wavelength in nm; 0 outside the table.
    pub fn sensitivities(&self, nm: f64) -> [f64; 3] {
        linear(&self.rows, nm)
    }

    /// The share of each channel's response to light of equal energy that lies within a range, nm.
    pub fn share_within(&self, [low, high]: [f64; 2]) -> [f64; 3] {
        let (mut all, mut within) = ([0.0; 3], [0.0; 3]);
        for nm in steps(&self.rows) {
            for (i, value) in self.sensitivities(nm).into_iter().enumerate() {
                all[i] += value;
                within[i] += if (low..=high).contains(&nm) {
                    value
                } else {
                    0.0
                };
            }
        }
        std::array::from_fn(|i| within[i] / all[i])
    }

    fn told(&self) -> String {
        let shipped = SHIPPED.iter().find(|(name, ..)| *name == self.name);
        let what = shipped.map_or(self.name.as_str(), |(_, what, _)| what);
        let Fit {
            matrix,
            mean,
            greatest,
        } = &self.fit;
        let rows = matrix.map(|row| row.map(|value| format!("{value:.6}")).join(" "));
        format!(
            "{what}; raw channels, balanced for D65, to linear sRGB by [{}], CIEDE2000 over the training \
             set {mean:.2} in the mean, {greatest:.2} at most",
            rows.join("; ")
        )
    }
}

/// Whole nanometres of a table, the middles of steps of 1 nm.
fn steps(rows: &[(f64, [f64; 3])]) -> impl Iterator<Item = f64> {
    let [first, last] = [rows[0].0, rows[rows.len() - 1].0];
    let count = (last - first).ceil().clamp(1.0, 1e5) as u32;
    let width = (last - first) / f64::from(count);
    (0..count).map(move |step| first + (f64::from(step) + 0.5) * width)
}

/// What each channel sees of D65 with Y = 1, in the table's unit times nm.
fn seen_of_d65(rows: &[(f64, [f64; 3])]) -> [f64; 3] {
    let luminance = cie::xyz_of(cie::d65)[1];
    let width = (rows[rows.len() - 1].0 - rows[0].0) / steps(rows).count() as f64;
    let mut seen = [0.0; 3];
    for nm in steps(rows) {
        for (sum, value) in seen.iter_mut().zip(linear(rows, nm)) {
            *sum += value * width * cie::d65(nm) / luminance;
        }
    }
    seen
}

/// Values of a table at a wavelength, linear between rows, 0 outside.
fn linear(rows: &[(f64, [f64; 3])], nm: f64) -> [f64; 3] {
    let above = rows.partition_point(|row| row.0 <= nm);
    let Some(low) = above.checked_sub(1).map(|below| &rows[below]) else {
        return [0.0; 3];
    };
    let Some(high) = rows.get(above) else {
        return if low.0 == nm { low.1 } else { [0.0; 3] };
    };
    let share = (nm - low.0) / (high.0 - low.0);
    std::array::from_fn(|i| low.1[i] * (1.0 - share) + high.1[i] * share)
}

#[cfg(test)]
mod tests;
