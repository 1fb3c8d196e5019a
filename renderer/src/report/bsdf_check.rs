//! What of a measured BRDF or BTDF is reciprocal, and how much light it has: CSV, JSON and words.

use serde_json::{Value as Json, json};

use super::table::{Table, cell, in_columns};
use crate::checkpoint::PROGRAM;
use crate::measured::bsdf::Check;

/// The rows with their reciprocal part and its error.
pub(crate) fn rows(check: &Check) -> String {
    let mut table = Table::new("theta_i,phi_i,theta_o,phi_o,wavelength,value,reciprocal,error");
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
    let none = || "–".to_owned();
    let bands = check.bands.iter().map(|band| {
        let worst = band.worst;
        [
            band.nm.to_string(),
            band.rows.to_string(),
            band.paired.to_string(),
            format!("{:.4}", band.rms),
            format!("{:.2e}", band.error_rms),
            worst.map_or_else(none, |(error, _)| format!("{error:.2e}")),
            worst.map_or_else(none, |(_, line)| line.to_string()),
        ]
    });
    let heads = [
        "nm",
        "rows",
        "paired",
        "rms /sr",
        "error rms",
        "most",
        "line",
    ];
    let bands = in_columns(heads, bands);
    let share = |share: Option<f64>| share.map_or_else(none, |share| format!("{share:.4}"));
    let energy = check.energy.iter().map(|of| {
        [
            of.nm.to_string(),
            of.incident.theta.to_string(),
            of.incident.phi.to_string(),
            share(of.reflected),
            share(of.transmitted),
        ]
    });
    let heads = ["nm", "theta_i", "phi_i", "reflected", "transmitted"];
    format!("{bands}\n\n{}", in_columns(heads, energy))
}
