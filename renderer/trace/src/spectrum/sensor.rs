//! Sensors: bands by their spectral responses, as shipped by name or as a file has them.
//!
//! - **In**: a response by wavelength for each band, linear between rows and 0 outside.
//! - **Out**: middles and widths of the bands; shares of a band that the response weighs alike.
//! - **Always true**: bands come in the order of their middles, of which no two are the same.
//! - **Left out**: noise, the spread of light over pixels, and responses that differ over the detector.
//!
//! A band records `∫ R(λ) L(λ) dλ / ∫ R(λ) dλ` of the radiance `L`, by its response `R`.

use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::band::{Band, spectral_channel_name};
use super::grid::Share;

/// A sensor.
#[derive(Clone, Deserialize, PartialEq, Serialize)]
#[serde(try_from = "Table", into = "Table")]
pub struct Sensor {
    /// Its name, or that of its file.
    name: String,
    bands: Vec<Response>,
}

/// The name of a sensor, and the names and rows of its bands, from which all else follows.
type Table = (String, Vec<NamedRows>);

/// The name of a band, with rows of wavelength, nm, and relative response.
pub type NamedRows = (String, Vec<(f64, f64)>);

/// A band of a sensor.
#[derive(Clone, PartialEq)]
pub struct Response {
    /// Its name.
    name: String,
    /// Wavelengths, nm, and relative responses; linear between, 0 outside.
    rows: Vec<(f64, f64)>,
    /// Middle by the response, and full width at half of the maximum.
    outline: Band,
}

/// Why a table cannot be the responses of a sensor.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum NotASensor {
    /// No band.
    #[error("has no band")]
    Empty,
    /// Too few rows, or wavelengths that do not rise.
    #[error("has a band `{0}` without two rows of rising, finite wavelengths")]
    Disordered(String),
    /// A value that is no response.
    #[error("has a band `{0}` with a response that is no finite number of 0 or more")]
    Negative(String),
    /// A band that sees nothing.
    #[error("has a band `{0}` that is 0 everywhere")]
    Blind(String),
    /// Bands that a picture cannot tell apart.
    #[error("has the bands `{0}` and `{1}` with the same middle, by which pictures name bands")]
    Same(String, String),
}

/// How the bands of a shipped sensor are known.
enum Shipped {
    /// By responses: in each line the name of a band, the first wavelength, nm, and a value for each
    /// nanometre, in 10⁻⁴ of the greatest.
    Measured(&'static str),
    /// By names, middles and full widths of boxes, nm.
    Boxes(&'static [(&'static str, f64, f64)]),
    /// By regular grids of bell curves: first and last middle, step and full width at half of the
    /// maximum, nm.
    Bells(&'static [[f64; 4]]),
}

/// Middles and full widths at half of the maximum, computed from published responses (NOTICE).
const SENTINEL_2C: [(&str, f64, f64); 10] = [
    ("B2", 489.0, 65.3),
    ("B3", 560.6, 35.4),
    ("B4", 666.5, 30.4),
    ("B5", 707.1, 15.3),
    ("B6", 741.1, 15.3),
    ("B7", 784.7, 20.3),
    ("B8", 834.6, 95.8),
    ("B8A", 865.6, 20.0),
    ("B11", 1612.0, 90.3),
    ("B12", 2191.3, 183.2),
];

/// Sensors that are shipped: name, what it is and how its bands are known, the bands.
const SHIPPED: [(&str, &str, Shipped); 8] = [
    (
        "sentinel-2a",
        "Sentinel-2A MSI, responses measured before launch (ESA, S2-SRF 3.0)",
        Shipped::Measured(include_str!("sensors/sentinel-2a.txt")),
    ),
    (
        "sentinel-2b",
        "Sentinel-2B MSI, responses measured before launch (ESA, S2-SRF 3.0)",
        Shipped::Measured(include_str!("sensors/sentinel-2b.txt")),
    ),
    (
        "sentinel-2c",
        "Sentinel-2C MSI, nominal: boxes of the middles and widths of ten bands",
        Shipped::Boxes(&SENTINEL_2C),
    ),
    (
        "landsat-8",
        "Landsat 8 OLI, responses measured before launch (NASA, band averages 1.2)",
        Shipped::Measured(include_str!("sensors/landsat-8.txt")),
    ),
    (
        "landsat-9",
        "Landsat 9 OLI-2, responses measured before launch (NASA, band averages 1.0)",
        Shipped::Measured(include_str!("sensors/landsat-9.txt")),
    ),
    (
        "modis-terra",
        "Terra MODIS, bands 1 to 7, responses measured before launch (NASA)",
        Shipped::Measured(include_str!("sensors/modis-terra.txt")),
    ),
    (
        "prisma-like",
        "like PRISMA, nominal: bell curves 12 nm wide, every 9.2 nm from 420 nm on",
        Shipped::Bells(&[[420.0, 2480.8, 9.2, 12.0]]),
    ),
    (
        "enmap-like",
        "like EnMAP, nominal: bell curves 8.1 nm wide, every 6.5 nm, beyond 1000 nm 12.5 nm and 10 nm",
        Shipped::Bells(&[[420.0, 998.5, 6.5, 8.1], [1010.0, 2450.0, 10.0, 12.5]]),
    ),
];

/// Half the number of steps of a bell curve, which ends at 1.5 full widths, where it is 0.002.
const BELL_STEPS: i32 = 16;

impl TryFrom<Table> for Sensor {
    type Error = NotASensor;

    fn try_from((name, bands): Table) -> Result<Self, NotASensor> {
        Self::new(&name, bands)
    }
}

impl From<Sensor> for Table {
    fn from(sensor: Sensor) -> Self {
        let bands = sensor.bands.into_iter();
        (
            sensor.name,
            bands.map(|band| (band.name, band.rows)).collect(),
        )
    }
}

impl fmt::Debug for Sensor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Sensor {} of {} bands", self.name, self.bands.len())
    }
}

impl Sensor {
    /// A sensor of bands by name, each with rows of wavelength in nm and relative response.
    ///
    /// # Errors
    ///
    /// [`NotASensor`].
    pub fn new(name: &str, bands: Vec<NamedRows>) -> Result<Self, NotASensor> {
        let bands = bands
            .into_iter()
            .map(|(name, rows)| Response::new(name, rows));
        let mut bands = bands.collect::<Result<Vec<_>, _>>()?;
        bands.sort_by(|a, b| a.outline.center_nm.total_cmp(&b.outline.center_nm));
        let channel = |band: &Response| spectral_channel_name(band.outline.center_nm);
        let mut pairs = bands.windows(2);
        if let Some([a, b]) = pairs.find(|pair| channel(&pair[0]) == channel(&pair[1])) {
            return Err(NotASensor::Same(a.name.clone(), b.name.clone()));
        }
        if bands.is_empty() {
            return Err(NotASensor::Empty);
        }
        Ok(Self {
            name: name.to_owned(),
            bands,
        })
    }

    /// Names of all sensors that need no file, with what each is.
    pub fn shipped() -> impl Iterator<Item = (&'static str, &'static str)> {
        SHIPPED.iter().map(|(name, about, _)| (*name, *about))
    }

    /// The sensor of a name.
    pub fn by_name(name: &str) -> Option<Self> {
        let (name, _, shipped) = SHIPPED.iter().find(|(known, ..)| *known == name)?;
        let bands = match shipped {
            Shipped::Measured(text) => text.lines().map(measured).collect(),
            Shipped::Boxes(boxes) => {
                let rows = |middle, width: f64| [-0.5, 0.5].map(|x| (middle + x * width, 1.0));
                let boxes = boxes.iter();
                boxes
                    .map(|&(name, middle, width)| (name.to_owned(), rows(middle, width).to_vec()))
                    .collect()
            }
            Shipped::Bells(grids) => grids.iter().flat_map(|grid| bells(*grid)).collect(),
        };
        Self::new(name, bands).ok()
    }

    /// Its name, or that of its file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it is and how its bands are known, as a picture says it.
    pub fn about(&self) -> &str {
        let known = Self::shipped().find(|(name, _)| *name == self.name);
        known.map_or(&self.name, |(_, about)| about)
    }

    /// Its bands, in the order of their middles.
    pub fn bands(&self) -> &[Response] {
        &self.bands
    }

    /// The middle of each band by its response, and its full width at half of the maximum.
    pub fn boxes(&self) -> Vec<Band> {
        self.bands.iter().map(|band| band.outline).collect()
    }

    /// First and last wavelength at which any band responds, nm.
    pub fn range_nm(&self) -> [f64; 2] {
        let ends = self.bands.iter().map(Response::range_nm);
        ends.fold([f64::INFINITY, 0.0], |[low, high], [from, to]| {
            [low.min(from), high.max(to)]
        })
    }
}

/// The band of a line of a shipped table.
fn measured(line: &str) -> NamedRows {
    let mut fields = line.split(' ');
    let name = fields.next().expect("a line has a name").to_owned();
    let mut numbers = fields.map(|field| {
        let number = field.parse::<f64>();
        number.expect("a shipped table holds numbers behind the name")
    });
    let first = numbers.next().expect("a line has a first wavelength");
    let values = std::iter::once(0.0).chain(numbers.map(|value| 1e-4 * value));
    let values = values.chain([0.0]).zip(0_u32..);
    let rows = values.map(|(value, step)| (first - 1.0 + f64::from(step), value));
    (name, rows.collect())
}

/// Bell curves on a regular grid, named by their numbers' middles.
fn bells([first, last, step, fwhm]: [f64; 4]) -> Vec<NamedRows> {
    let count = ((last - first) / step).round() as u32;
    let bell = |middle: f64| {
        let rows = (-BELL_STEPS..=BELL_STEPS).map(|place| {
            let x = 1.5 * f64::from(place) / f64::from(BELL_STEPS);
            let value = libm::exp(-4.0 * std::f64::consts::LN_2 * x * x);
            (middle + x * fwhm, value)
        });
        (format!("{middle:.1}"), rows.collect())
    };
    let middles = (0..=count).map(|number| first + f64::from(number) * step);
    middles.map(bell).collect()
}

impl Response {
    fn new(name: String, rows: Vec<(f64, f64)>) -> Result<Self, NotASensor> {
        let rises = rows.windows(2).all(|pair| pair[0].0 < pair[1].0);
        if rows.len() < 2 || !rises || !rows.iter().all(|(nm, _)| nm.is_finite() && *nm > 0.0) {
            return Err(NotASensor::Disordered(name));
        }
        if rows
            .iter()
            .any(|(_, value)| !value.is_finite() || *value < 0.0)
        {
            return Err(NotASensor::Negative(name));
        }
        let mut all = Moments::from(rows[0].0);
        for pair in rows.windows(2) {
            all.add(pair[0], pair[1]);
        }
        if !(all.sums[0] > 0.0 && all.sums[0].is_finite()) {
            return Err(NotASensor::Blind(name));
        }
        let outline = Band {
            center_nm: all.middle(),
            width_nm: width_at_half(&rows),
        };
        Ok(Self {
            name,
            rows,
            outline,
        })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Wavelengths, nm, and relative responses.
    pub fn rows(&self) -> &[(f64, f64)] {
        &self.rows
    }

    /// Its response at a wavelength in nm.
    pub fn at(&self, nm: f64) -> f64 {
        let above = self.rows.partition_point(|row| row.0 <= nm);
        let around = above
            .checked_sub(1)
            .and_then(|below| self.rows.get(below..=above));
        let Some([low, high]) = around else {
            return 0.0;
        };
        low.1 + (nm - low.0) / (high.0 - low.0) * (high.1 - low.1)
    }

    /// First and last wavelength at which it responds, nm.
    pub fn range_nm(&self) -> [f64; 2] {
        let seen = |row: &(f64, f64)| row.1 > 0.0;
        let first = self.rows.iter().position(seen).unwrap_or(0);
        let last = self.rows.iter().rposition(seen).unwrap_or(0);
        let end = (last + 1).min(self.rows.len() - 1);
        [self.rows[first.saturating_sub(1)].0, self.rows[end].0]
    }

    /// Parts of the band, each with the same integral of the response. A part stands for even light
    /// around its middle with the deviation that the response has within it, or as much of that as
    /// fits. So the mean over parts of a spectrum is that by the response if the spectrum is a line in
    /// each, and mostly if it is a parabola.
    pub fn shares(&self, count: usize) -> Vec<Share> {
        let whole: f64 = self
            .rows
            .windows(2)
            .map(|pair| area(pair[0], pair[1]))
            .sum();
        let each = whole / count as f64;
        let mut shares = Vec::with_capacity(count);
        let mut part = Moments::from(self.rows[0].0);
        for pair in self.rows.windows(2) {
            let (mut low, high) = (pair[0], pair[1]);
            let slope = (high.1 - low.1) / (high.0 - low.0);
            while shares.len() + 1 < count {
                let left = each - part.sums[0];
                if area(low, high) <= left {
                    break;
                }
                // The part ends where the integral of the line from here on is what is left of it.
                let root = (low.1 * low.1 + 2.0 * slope * left).max(0.0).sqrt();
                let reach = 2.0 * left / (low.1 + root);
                let reach = if reach.is_finite() { reach } else { 0.0 };
                let nm = (low.0 + reach).clamp(low.0, high.0);
                let end = (nm, low.1 + slope * (nm - low.0));
                part.add(low, end);
                shares.push(part.share(nm));
                part = Moments::from(nm);
                low = end;
            }
            part.add(low, high);
        }
        shares.push(part.share(self.rows[self.rows.len() - 1].0));
        shares
    }
}

/// The integral of a line between two rows.
fn area(low: (f64, f64), high: (f64, f64)) -> f64 {
    0.5 * (low.1 + high.1) * (high.0 - low.0)
}

/// Integrals of a response, and of its product with the distance from where it begins and with that
/// squared.
struct Moments {
    from_nm: f64,
    sums: [f64; 3],
}

impl Moments {
    fn from(from_nm: f64) -> Self {
        let sums = [0.0; 3];
        Self { from_nm, sums }
    }

    /// Adds a line, by Simpson's rule, which is exact for cubics.
    fn add(&mut self, low: (f64, f64), high: (f64, f64)) {
        let middle = (0.5 * (low.0 + high.0), 0.5 * (low.1 + high.1));
        for ((nm, value), weight) in [(low, 1.0), (middle, 4.0), (high, 1.0)] {
            let mut term = weight / 6.0 * (high.0 - low.0) * value;
            for sum in &mut self.sums {
                *sum += term;
                term *= nm - self.from_nm;
            }
        }
    }

    /// The middle by the response, nm.
    fn middle(&self) -> f64 {
        self.from_nm + self.sums[1] / self.sums[0].max(f64::MIN_POSITIVE)
    }

    /// The part of the band that ends at a wavelength.
    fn share(&self, end_nm: f64) -> Share {
        let middle = self.middle();
        let all = self.sums[0].max(f64::MIN_POSITIVE);
        let variance = self.sums[2] / all - (middle - self.from_nm).powi(2);
        // Two humps deviate more than even light between their ends can; the middle stays.
        let half = (3.0 * variance.max(0.0)).sqrt();
        let half = half.min(middle - self.from_nm).min(end_nm - middle);
        Share::around(middle, 2.0 * half.max(0.0))
    }
}

/// The distance between the outermost wavelengths at which a response is half of its greatest.
fn width_at_half(rows: &[(f64, f64)]) -> f64 {
    let half = 0.5 * rows.iter().fold(0.0_f64, |most, row| most.max(row.1));
    let crossed = |outer: Option<&(f64, f64)>, inner: (f64, f64)| {
        outer.map_or(inner.0, |outer| {
            outer.0 + (half - outer.1) / (inner.1 - outer.1) * (inner.0 - outer.0)
        })
    };
    let is_seen = |row: &(f64, f64)| row.1 >= half;
    let first = rows.iter().position(is_seen).unwrap_or(0);
    let last = rows.iter().rposition(is_seen).unwrap_or(0);
    let outer = first.checked_sub(1).map(|before| &rows[before]);
    crossed(rows.get(last + 1), rows[last]) - crossed(outer, rows[first])
}

#[cfg(test)]
mod tests;
