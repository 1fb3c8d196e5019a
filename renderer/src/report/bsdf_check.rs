//! What of a measured BRDF or BTDF is reciprocal, and how much light it has: CSV, JSON and words.

use serde_json::{Value as Json, json};

use super::table::{Table, cell, in_columns};
use crate::checkpoint::PROGRAM;
use crate::measured::bsdf::Check;

/// The rows with their reciprocal part and its error.
pub(crate) fn rows(check: &Check) -> String {
    let mut table = Table::new([
        "theta_i",
        "phi_i",
        "theta_o",
        "phi_o",
        "wavelength",
        "value",
        "reciprocal",
        "error",
    ]);
    for row in &check.rows {
        let (i, o) = (row.sample.incident, row.sample.scattered);
        let angles = [i.theta, i.phi, o.theta, o.phi];
        let values = [row.sample.nm, row.sample.value, row.reciprocal];
        let known = angles.into_iter().chain(values).map(Some);
        table.row(known.chain([row.error]).map(cell));
    }
    table.text()
}

/// Figures of each wavelength and direction as JSON.
pub(crate) fn report(check: &Check) -> String {
    let bands = check.bands.iter().map(|band| {
        json!({
            "wavelength_nm": band.nm,
            "rows": band.rows,
            "rows_with_partner": band.paired,
            "rms_per_sr": band.rms,
            "error_rms_per_sr": band.error_rms,
            "error_most_per_sr": band.worst.map(|(error, _)| error),
            "line_of_most": band.worst.map(|(_, line)| line),
        })
    });
    let energy = check.energy.iter().map(|energy| {
        json!({
            "wavelength_nm": energy.nm,
            "theta_i_deg": energy.incident.theta,
            "phi_i_deg": energy.incident.phi,
            "reflectance": energy.reflected,
            "transmittance": energy.transmitted,
        })
    });
    let report = json!({
        "program": PROGRAM,
        "isotropic": check.is_isotropic,
        "reciprocity": bands.collect::<Vec<Json>>(),
        "energy": energy.collect::<Vec<Json>>(),
    });
    format!("{report:#}\n")
}

/// What a reader of the terminal sees.
pub(crate) fn human(check: &Check) -> String {
    let head = [
        "nm",
        "rows",
        "paired",
        "rms /sr",
        "error rms",
        "most",
        "line",
    ];
    let mut bands = vec![head.map(str::to_owned)];
    for band in &check.bands {
        let (most, line) = band.worst.map_or_else(
            || ("–".to_owned(), "–".to_owned()),
            |(error, line)| (format!("{error:.2e}"), line.to_string()),
        );
        bands.push([
            band.nm.to_string(),
            band.rows.to_string(),
            band.paired.to_string(),
            format!("{:.4}", band.rms),
            format!("{:.2e}", band.error_rms),
            most,
            line,
        ]);
    }
    let head = ["nm", "theta_i", "phi_i", "reflected", "transmitted"];
    let mut energy = vec![head.map(str::to_owned)];
    for of in &check.energy {
        let share =
            |share: Option<f64>| share.map_or("–".to_owned(), |share| format!("{share:.4}"));
        energy.push([
            of.nm.to_string(),
            of.incident.theta.to_string(),
            of.incident.phi.to_string(),
            share(of.reflected),
            share(of.transmitted),
        ]);
    }
    format!("{}\n\n{}", in_columns(&bands), in_columns(&energy))
}
