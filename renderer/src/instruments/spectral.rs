//! From figures at single wavelengths to rows: wavelengths, bands, indices and photon fluxes.
//!
//! Means over a band, indices and photon fluxes are made of the same batches as the figures that
//! they are made of, so their errors count how those move together.

use super::batches::Estimate;
use super::row::Row;
use crate::scene::description::{Amount, Incident, Instrument};
use crate::spectrum::{Curve, Share};

/// A figure at all wavelengths at which an instrument measures.
pub(super) struct Series {
    /// Its rows but for wavelength, band and value.
    pub(super) row: Row,
    /// The word for its photon flux, and what a share of the incident flux is multiplied with; `None`
    /// if it is no share of a flux.
    pub(super) photons: Option<(&'static str, f64)>,
    /// By [`Instrument::measured_nm`].
    pub(super) figures: Vec<Estimate>,
}

impl Series {
    /// The figures of rows that are no fractions of a flux.
    pub(super) fn new(row: Row, figures: Vec<Estimate>) -> Self {
        let photons = None;
        Self {
            row,
            photons,
            figures,
        }
    }
}

/// Whether a quantity is one of which indices are made.
fn is_reflectance(quantity: &str) -> bool {
    ["reflectance", "brf", "hdrf", "reflected"].contains(&quantity)
}

/// All rows of one light's figures.
pub(super) fn rows(instrument: &Instrument, series: &[Series]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (i, &nm) in instrument.wavelengths_nm.iter().enumerate() {
        rows.extend(series.iter().map(|one| Row {
            wavelength_nm: Some(nm),
            value: one.figures[i].value,
            error: one.figures[i].error,
            ..one.row.clone()
        }));
    }
    let light = instrument
        .incident
        .as_ref()
        .map(|incident| Curve::from_description(&incident.spectrum));
    let mut first = instrument.wavelengths_nm.len();
    let mut of_bands: Vec<Vec<Estimate>> = Vec::new();
    for band in &instrument.bands {
        let weights = band_weights(&band.nodes, light.as_ref());
        let means: Vec<Estimate> = series
            .iter()
            .map(|one| Estimate::weighted(one.figures[first..].iter().zip(weights.iter().copied())))
            .collect();
        rows.extend(series.iter().zip(&means).map(|(one, mean)| Row {
            band: Some(band.name.clone()),
            wavelength_nm: Some(band.centre_nm),
            value: mean.value,
            error: mean.error,
            ..one.row.clone()
        }));
        of_bands.push(means);
        first += band.nodes.len();
    }
    for index in &instrument.indices {
        let reflecting = series.iter().enumerate();
        for (number, one) in reflecting.filter(|(_, one)| is_reflectance(one.row.quantity)) {
            let [counted, taken] = index.bands.map(|band| &of_bands[band][number]);
            if counted.value + taken.value == 0.0 {
                // Of a black surface there is no index.
                continue;
            }
            let found = normalised_difference(counted, taken);
            rows.push(Row {
                quantity: index.name,
                part: Some(one.row.quantity.to_owned()),
                value: found.value,
                error: found.error,
                unit: "1",
                ..one.row.clone()
            });
        }
    }
    if let (Some(incident), Some(curve)) = (&instrument.incident, &light) {
        rows.extend(photons(incident, curve, series, first));
    }
    rows
}

/// Weights of a band's wavelengths by its response and the light, of sum 1.
fn band_weights(nodes: &[(f64, f64)], light: Option<&Curve>) -> Vec<f64> {
    let lit = |(i, &(nm, weight)): (usize, &(f64, f64))| {
        // A node represents what is nearest to it.
        let to = |other: usize| f64::midpoint(nm, nodes.get(other).map_or(nm, |node| node.0));
        let share = Share {
            nm: nm as f32,
            edges_nm: [to(i.wrapping_sub(1)), to(i + 1)],
        };
        weight * light.map_or(1.0, |curve| f64::from(curve.over(&share)))
    };
    let lit: Vec<f64> = nodes.iter().enumerate().map(lit).collect();
    let sum: f64 = lit.iter().sum();
    if sum > 0.0 {
        lit.into_iter().map(|lit| lit / sum).collect()
    } else {
        // No light in this band: by the response alone.
        nodes.iter().map(|(_, weight)| *weight).collect()
    }
}

/// (a − b) / (a + b).
fn normalised_difference(a: &Estimate, b: &Estimate) -> Estimate {
    let sum = a.value + b.value;
    let by = [2.0 * b.value, -2.0 * a.value].map(|by| by / (sum * sum));
    let parts = [(a, by[0]), (b, by[1])];
    Estimate::derived((a.value - b.value) / sum, parts.into_iter())
}

/// Planck's constant times the speed of light times Avogadro's number, J m mol⁻¹.
const MOLE_OF_PHOTONS: f64 = 6.626_070_15e-34 * 299_792_458.0 * 6.022_140_76e23;

/// Photons of a share of the incident flux at each of [`Incident::nodes_nm`], µmol m⁻² s⁻¹: their
/// sum is the incident photon flux, and a share that is linear between the wavelengths is exact.
fn photon_weights(incident: &Incident, curve: &Curve) -> Vec<f64> {
    let nodes: Vec<f64> = Incident::nodes_nm().collect();
    let step = Incident::STEP_NM;
    let mut weights = vec![0.0; nodes.len()];
    let mut irradiance = 0.0;
    // Midpoints of tenths of a nanometre.
    let parts = ((Incident::PAR_NM[1] - Incident::PAR_NM[0]) * 10.0).round() as u32;
    for part in 0..parts {
        let nm = Incident::PAR_NM[0] + (f64::from(part) + 0.5) * 0.1;
        let power = 0.1 * f64::from(curve.over(&Share::around(nm, 0.1)));
        irradiance += power;
        let micromoles = power * nm * 1e-9 / MOLE_OF_PHOTONS * 1e6;
        let place = (nm - nodes[0]) / step;
        let below = (place.floor() as usize).min(nodes.len() - 2);
        let share = place - below as f64;
        weights[below] += micromoles * (1.0 - share);
        weights[below + 1] += micromoles * share;
    }
    let scale = match incident.amount {
        Amount::Irradiance(wanted) => wanted / irradiance,
        Amount::Photons(wanted) => wanted / weights.iter().sum::<f64>(),
    };
    weights.iter().map(|weight| scale * weight).collect()
}

/// Photon fluxes of all shares, and the incident one; their figures begin with number `first`.
fn photons(incident: &Incident, curve: &Curve, series: &[Series], first: usize) -> Vec<Row> {
    let weights = photon_weights(incident, curve);
    let of = |row: &Row| Row {
        band: Some("PAR".to_owned()),
        unit: "umol m-2 s-1",
        ..row.clone()
    };
    let mut rows = Vec::new();
    if let Some(one) = series.iter().find(|one| one.photons.is_some()) {
        rows.push(Row {
            quantity: "incident_photon_flux",
            part: None,
            value: weights.iter().sum(),
            error: 0.0,
            ..of(&one.row)
        });
    }
    for one in series {
        let Some((quantity, times)) = one.photons else {
            continue;
        };
        let weights = weights.iter().map(|weight| times * weight);
        let found = Estimate::weighted(one.figures[first..].iter().zip(weights));
        rows.push(Row {
            quantity,
            value: found.value,
            error: found.error,
            ..of(&one.row)
        });
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::description::Spectrum;

    #[test]
    fn photons_of_one_wavelength_and_of_an_even_spectrum_are_those_of_planck() {
        let even = Incident {
            spectrum: Spectrum::Constant(1.0),
            light: None,
            amount: Amount::Irradiance(300.0),
        };
        let weights = photon_weights(&even, &Curve::from_description(&even.spectrum));
        // 1 W m⁻² nm⁻¹ over 300 nm: ∫ λ dλ / (h c N) = 300 nm · 550 nm / 0.119 626 6 J m mol⁻¹.
        let expected = 300.0 * 550e-9 / 0.119_626_6 * 1e6;
        let sum: f64 = weights.iter().sum();
        assert!((sum / expected - 1.0).abs() < 1e-6, "{sum} {expected}");
        // What is absorbed in proportion to the wavelength.
        let nodes: Vec<f64> = Incident::nodes_nm().collect();
        let linear: f64 = weights
            .iter()
            .zip(&nodes)
            .map(|(w, nm)| w * nm / 700.0)
            .sum();
        let squares = (700_f64.powi(3) - 400_f64.powi(3)) / 3.0 / 700.0;
        let expected = squares * 1e-9 / 0.119_626_6 * 1e6;
        assert!(
            (linear / expected - 1.0).abs() < 1e-6,
            "{linear} {expected}"
        );
    }

    #[test]
    fn daylight_has_4_6_micromoles_a_joule() {
        // McCree (1972): 4.57 µmol J⁻¹ of sun and sky from 400 to 700 nm.
        let day = Incident {
            spectrum: Spectrum::D65 { scale: 1.0 },
            light: None,
            amount: Amount::Irradiance(1.0),
        };
        let sum: f64 = photon_weights(&day, &Curve::from_description(&day.spectrum))
            .iter()
            .sum();
        assert!((sum - 4.57).abs() < 0.05, "{sum}");
    }
}
