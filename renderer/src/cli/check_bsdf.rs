//! `lamina check-bsdf`: what of a measured BRDF or BTDF is reciprocal, and how much light it has.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use serde_json::{Value as Json, json};

use crate::checkpoint::PROGRAM;
use crate::cli::arguments::CheckBsdfArguments;
use crate::cli::columns::in_columns;
use crate::cli::places::check_outputs;
use crate::cli::texts::text_of;
use crate::cli::{Failure, say};
use crate::image::atomic;
use crate::measured::bsdf::{self, Check};

/// A surface that sends out more than this share of the light is not told from one of 1: sums over
/// rings of a few degrees are that uncertain.
const MOST_ENERGY: f64 = 1.01;

pub(super) fn run(arguments: &CheckBsdfArguments) -> Result<(), Failure> {
    let out = arguments.out.as_deref();
    let is_json = match out.map(|file| file.extension().and_then(|ending| ending.to_str())) {
        None | Some(Some("csv")) => false,
        Some(Some("json")) => true,
        Some(_) => {
            let problem = "--out writes csv or json: the ending says which";
            return Err(Failure::bad(problem));
        }
    };
    let file = &arguments.table;
    let outputs: Vec<&Path> = out.into_iter().collect();
    check_outputs(&outputs, std::slice::from_ref(file), "the command")?;
    let text = text_of(file)?;
    let mut known = arguments.reading.known();
    known.angles = arguments.angles;
    let table =
        bsdf::read(&text, &known).map_err(|fault| Failure::bad(fault.shown(file, &text)))?;
    for note in &table.notes {
        eprintln!("note: {note}");
    }
    let check = table.check();
    if check.is_isotropic {
        eprintln!("note: light comes from one azimuth: the surface is taken to be isotropic");
    }
    for energy in check.energy.iter().filter(|e| e.total() > MOST_ENERGY) {
        eprintln!(
            "warning: {:.3} of the light from {}° is sent out at {} nm, more than comes in",
            energy.total(),
            energy.incident.theta,
            energy.nm
        );
    }
    if check.bands.iter().all(|band| band.paired == 0) {
        eprintln!(
            "warning: no row has a partner with its directions exchanged: reciprocity is not tested"
        );
    }
    if let Some(out) = out {
        let text = if is_json {
            report(&check)
        } else {
            rows(&check)
        };
        atomic::replace(out, |to| to.write_all(text.as_bytes())).map_err(Failure::system)?;
        say(out.display());
    } else {
        say(human(&check));
    }
    Ok(())
}

/// The rows with their reciprocal part and its error.
fn rows(check: &Check) -> String {
    let mut text = "theta_i,phi_i,theta_o,phi_o,wavelength,value,reciprocal,error\n".to_owned();
    for row in &check.rows {
        let (i, o) = (row.sample.incident, row.sample.scattered);
        let _ = write!(
            text,
            "{},{},{},{},{},{},{},",
            i.theta, i.phi, o.theta, o.phi, row.sample.nm, row.sample.value, row.reciprocal
        );
        if let Some(error) = row.error {
            let _ = write!(text, "{error}");
        }
        text.push('\n');
    }
    text
}

/// Figures of each wavelength and direction as JSON.
fn report(check: &Check) -> String {
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
fn human(check: &Check) -> String {
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
