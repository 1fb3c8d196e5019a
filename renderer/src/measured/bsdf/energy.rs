//! Directional–hemispherical reflectance and transmittance of a table over angles.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::sample::{Direction, SAME_DEG, Sample, steps, wavelength_steps};

/// Least number of azimuths around a ring from which its mean is told.
const LEAST_AZIMUTHS: usize = 4;

/// Shares of the light of one direction that are scattered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy {
    /// Wavelength, nm.
    pub nm: f64,
    /// Whence light comes.
    pub incident: Direction,
    /// Share that is sent back to the light's side; `None` if the rows do not cover it.
    pub reflected: Option<f64>,
    /// Share that leaves behind; `None` if the rows do not cover it.
    pub transmitted: Option<f64>,
}

impl Energy {
    /// Share of the light that is scattered, as far as the table tells.
    pub fn total(&self) -> f64 {
        self.reflected.unwrap_or(0.0) + self.transmitted.unwrap_or(0.0)
    }
}

/// The energy of each wavelength and incident direction.
pub(super) fn by_incidence(samples: &[Sample]) -> Vec<Energy> {
    let mut groups: BTreeMap<(i64, [i64; 2]), Vec<&Sample>> = BTreeMap::new();
    for sample in samples {
        let key = (wavelength_steps(sample.nm), steps(sample.incident));
        groups.entry(key).or_default().push(sample);
    }
    let found = groups.into_values().map(|rows| {
        let incident = rows[0].incident;
        // The side of the light, where θ counts from its own normal.
        let is_above = incident.theta <= 90.0;
        let side = |is_back: bool| {
            let of_side = rows.iter().filter_map(|row| {
                let theta = row.scattered.theta;
                let theta = if is_back == is_above {
                    theta
                } else {
                    180.0 - theta
                };
                (theta <= 90.0).then_some((theta, row.scattered.phi, row.value))
            });
            hemisphere(&of_side.collect::<Vec<_>>())
        };
        Energy {
            nm: rows[0].nm,
            incident,
            reflected: side(true),
            transmitted: side(false),
        }
    });
    found.collect()
}

/// `∫ f cos θ dω` over a hemisphere of rows `(θ, φ, f)`, degrees. Each ring of one θ has the mean
/// of its rows, each of which reaches half way to its neighbours around the circle; rings reach
/// half way to one another, the first to the pole and the last to the horizon. The integral of
/// cos θ over a ring is exact, so a Lambertian surface has no error. `None` if a ring but the pole
/// has fewer than four azimuths.
fn hemisphere(rows: &[(f64, f64, f64)]) -> Option<f64> {
    let mut rings: BTreeMap<i64, Vec<(f64, f64)>> = BTreeMap::new();
    for &(theta, phi, value) in rows {
        let step = steps(Direction { theta, phi: 0.0 })[0];
        let ring = rings.entry(step).or_default();
        ring.push((phi.rem_euclid(360.0), value));
    }
    if rings.is_empty() || rings.keys().all(|theta| *theta == 0) {
        return None;
    }
    let thetas: Vec<f64> = rings
        .keys()
        .map(|step| (*step as f64 * SAME_DEG).to_radians())
        .collect();
    let square = |theta: f64| libm::sin(theta).powi(2);
    let mut sum = 0.0;
    for (i, ring) in rings.values().enumerate() {
        let low = if i == 0 {
            0.0
        } else {
            0.5 * (thetas[i - 1] + thetas[i])
        };
        let high = thetas
            .get(i + 1)
            .map_or(0.5 * PI, |next| 0.5 * (thetas[i] + next));
        let mean = if thetas[i] == 0.0 {
            ring.iter().map(|(_, value)| value).sum::<f64>() / ring.len() as f64
        } else {
            around(ring)?
        };
        sum += PI * mean * (square(high) - square(low));
    }
    Some(sum)
}

/// Mean around a circle of values at azimuths in degrees, 0 to 360.
fn around(ring: &[(f64, f64)]) -> Option<f64> {
    let mut ring = ring.to_vec();
    ring.sort_by(|a, b| a.0.total_cmp(&b.0));
    // 0° and 360° may both stand in a table.
    ring.dedup_by(|a, b| (a.0 - b.0).abs() < SAME_DEG);
    let count = ring.len();
    if count < LEAST_AZIMUTHS {
        return None;
    }
    let gap = |i: usize| (ring[(i + 1) % count].0 - ring[i].0).rem_euclid(360.0);
    let sum: f64 = (0..count)
        .map(|i| 0.5 * (gap(i) + gap((i + count - 1) % count)) * ring[i].1)
        .sum();
    Some(sum / 360.0)
}
