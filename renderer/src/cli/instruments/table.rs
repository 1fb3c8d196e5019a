//! Figures as tables.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::checkpoint::PROGRAM;
use crate::instruments::{Budget, Direction, Row};
use crate::scene::description::Description;

/// A row for each figure.
pub(super) fn csv(rows: &[Row]) -> String {
    let mut text = String::from(
        "instrument,quantity,part,face,incidence_deg,wavelength_nm,value,standard_error,unit\n",
    );
    for row in rows {
        // Shares of the incident flux are of the order of 1, other figures of any.
        let value = match row.unit {
            "1" => format!("{:.9}", row.value),
            _ => format!("{:.8e}", row.value),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{},{},{},{},{},{},{value},{:.3e},{}",
            row.instrument,
            row.quantity,
            row.part.as_deref().unwrap_or(""),
            row.face.unwrap_or(""),
            row.incidence,
            row.wavelength_nm,
            row.error,
            row.unit,
        );
    }
    text
}

/// The figures, and what they were measured with.
pub(super) fn json(scene: &Description, budget: &Budget, rows: &[Row]) -> String {
    let figures = rows.iter().map(|row| {
        let incidence = match row.incidence {
            Direction::Beam(_) => row.incidence.to_string().parse::<f64>().ok().into(),
            Direction::Diffuse => Value::from("diffuse"),
        };
        json!({
            "instrument": row.instrument,
            "quantity": row.quantity,
            "part": row.part,
            "face": row.face,
            "incidence_deg": incidence,
            "wavelength_nm": row.wavelength_nm,
            "value": row.value,
            "standard_error": row.error,
            "unit": row.unit,
        })
    });
    let report = json!({
        "program": PROGRAM,
        "scene": scene.name,
        "seed": budget.seed,
        "rays": budget.rays,
        "target_error": budget.error,
        "figures": figures.collect::<Vec<_>>(),
    });
    format!("{report:#}\n")
}
