//! Figures of instruments: CSV, JSON and charts.

mod plot;

use serde_json::{Value, json};

pub(crate) use self::plot::svg;
use super::table::{Table, cell};
use crate::checkpoint::PROGRAM;
use crate::instruments::{Budget, CutPaths, Direction, Row, Target, ViewAngles};
use crate::provenance::Provenance;
use crate::scene::description::Description;

/// The columns of a table.
const COLUMNS: &str = "instrument,quantity,part,face,incidence_deg,view_zenith_deg,view_azimuth_deg,\
     depth_um,band,wavelength_nm,value,standard_error,unit";
/// Those of means over several draws of the leaves, which other tables do without.
const OF_DRAWS: [&str; 3] = ["draws", "error_by_rays", "error_by_draws"];

/// A row for each figure.
pub(crate) fn csv(rows: &[Row]) -> String {
    let are_drawn = rows.iter().any(|row| row.parts.is_some());
    let of_draws = OF_DRAWS.into_iter().filter(|_| are_drawn);
    let mut table = Table::commented(COLUMNS.split(',').chain(of_draws));
    for row in rows {
        let [zenith, azimuth] = view_of(row);
        // Shares of the incident flux are of the order of 1, other figures of any.
        let value = match row.unit {
            "1" => format!("{:.9}", row.value),
            _ => format!("{:.8e}", row.value),
        };
        let own = [
            row.instrument.clone(),
            row.quantity.to_owned(),
            cell(row.part.as_ref()),
            cell(row.face),
            row.incidence.to_string(),
            cell(zenith),
            cell(azimuth),
            cell(row.depth_um),
            cell(row.band.as_ref()),
            cell(row.wavelength_nm),
            value,
            format!("{:.3e}", row.error),
            row.unit.to_owned(),
        ];
        let of_draws = [
            cell(row.parts.map(|parts| parts.draws)),
            cell(row.parts.map(|parts| format!("{:.3e}", parts.by_rays))),
            cell(row.parts.map(|parts| format!("{:.3e}", parts.by_draws))),
        ];
        table.row(
            own.into_iter()
                .chain(of_draws.into_iter().filter(|_| are_drawn)),
        );
    }
    table.text()
}

/// Zenith angle and azimuth of the detector, degrees.
fn view_of(row: &Row) -> [Option<f64>; 2] {
    let degrees = row.view.as_ref().map(ViewAngles::degrees);
    [0, 1].map(|axis| degrees.map(|degrees| degrees[axis]))
}

/// The figures, and what they were measured with.
pub(crate) fn json(
    scene: &Description,
    budget: &Budget,
    (rows, cuts): (&[Row], &[(String, CutPaths)]),
    provenance: &Provenance,
) -> String {
    let figures = rows.iter().map(|row| {
        let incidence = match row.incidence {
            Direction::Beam(_) => row.incidence.to_string().parse::<f64>().ok().into(),
            Direction::Diffuse => Value::from("diffuse"),
        };
        let [zenith, azimuth] = view_of(row);
        let mut figure = json!({
            "instrument": row.instrument,
            "quantity": row.quantity,
            "part": row.part,
            "face": row.face,
            "incidence_deg": incidence,
            "view_zenith_deg": zenith,
            "view_azimuth_deg": azimuth,
            "depth_um": row.depth_um,
            "band": row.band,
            "wavelength_nm": row.wavelength_nm,
            "value": row.value,
            "standard_error": row.error,
            "unit": row.unit,
        });
        if let Some(parts) = row.parts {
            let [draws, by_rays, by_draws] = OF_DRAWS;
            figure[draws] = json!(parts.draws);
            figure[by_rays] = json!(parts.by_rays);
            figure[by_draws] = json!(parts.by_draws);
        }
        figure
    });
    let report = json!({
        "program": PROGRAM,
        "scene": scene.name,
        "seed": budget.seed,
        "rays": budget.rays,
        "target_error": budget.error.map(|target| match target {
            Target::Absolute(error) => json!(error),
            Target::Relative(_) => json!(target.to_string()),
        }),
        "complete": provenance.complete,
        // What such paths carried counts as absorbed.
        "cut_paths": cuts.iter().map(|(instrument, cut)| json!({
            "instrument": instrument,
            "paths": cut.paths,
            "light_at_most": cut.at_most,
        })).collect::<Vec<_>>(),
        "figures": figures.collect::<Vec<_>>(),
    });
    format!("{:#}\n", provenance.within(report))
}
