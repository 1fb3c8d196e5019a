//! Contents that were found from spectra: CSV, JSON, a drawing, and words.

mod plot;

use std::fmt;

use leafmodel::optics::faces::CONTRASTS;
use leafmodel::optics::inversion::{Determined, Found, INTERVAL};
use leafmodel::optics::{Constituent, Model};
use serde_json::{Map, Value as Json, json};

pub(crate) use self::plot::{Fitted, shown, svg};
use super::table::{Table, aligned, cell};
use crate::checkpoint::PROGRAM;
use crate::provenance::Provenance;

fn have_faces(fitted: &[Fitted<'_>]) -> bool {
    fitted.iter().any(|fitted| fitted.found.contrast.is_some())
}

/// A table with a line for each leaf.
pub(crate) fn contents(fitted: &[Fitted<'_>], free: &[Constituent]) -> String {
    // Tables of one face keep their columns.
    let has_faces = have_faces(fitted);
    let keys = free.iter().map(|of| of.key());
    let keys = keys.chain(has_faces.then_some("face_contrast"));
    let keys = keys.flat_map(|key| [key.to_owned(), format!("{key}_standard_error")]);
    let rest = ["rms", "values", "reasons"].map(str::to_owned);
    let mut table = Table::commented(["leaf".to_owned()].into_iter().chain(keys).chain(rest));
    for Fitted { leaf, found } in fitted {
        let figure = |value: f64, known: Determined| {
            [known.has_value().then_some(value), known.error()].map(cell)
        };
        let figures = free
            .iter()
            .map(|&of| figure(found.contents[of], found.known[of]));
        let contrast = found.contrast.map_or_else(Default::default, |contrast| {
            figure(contrast.value, contrast.known)
        });
        let figures = figures.chain(has_faces.then_some(contrast)).flatten();
        let rest = [
            found.rms().to_string(),
            found.values().to_string(),
            reasons(found, free),
        ];
        table.row(
            [shown(leaf).to_owned()]
                .into_iter()
                .chain(figures)
                .chain(rest),
        );
    }
    table.text()
}

/// Why contents have no value, or no error.
fn reasons(found: &Found, free: &[Constituent]) -> String {
    let contents = free.iter().map(|&of| (of.name(), found.known[of]));
    let contrast = found
        .contrast
        .map(|contrast| ("face_contrast", contrast.known));
    let reasons = contents
        .chain(contrast)
        .filter_map(|(name, known)| Some(format!("{name}: {}", known.reason()?)));
    reasons.collect::<Vec<String>>().join("; ")
}

/// The key of a content, or of the contrast of the faces.
fn key(of: Option<Constituent>) -> &'static str {
    of.map_or("face_contrast", Constituent::key)
}

/// A line for each pair of what was found of each leaf.
pub(crate) fn covariances(fitted: &[Fitted<'_>]) -> String {
    let mut table = Table::commented(["leaf", "first", "second", "covariance", "correlation"]);
    for Fitted { leaf, found } in fitted {
        let all = &found.covariance;
        for (i, (of, row)) in all.of.iter().zip(&all.rows).enumerate() {
            for (j, (other, value)) in all.of.iter().zip(row).enumerate() {
                // Without any residual there is no correlation.
                let size = (row[i] * all.rows[j][j]).sqrt();
                let correlation = if size > 0.0 {
                    value / size
                } else {
                    f64::from(u8::from(i == j))
                };
                let [value, correlation] = [*value, correlation].map(|number| number.to_string());
                table.row([shown(leaf), key(*of), key(*other), &value, &correlation]);
            }
        }
    }
    table.text()
}

/// Everything as JSON.
pub(crate) fn report(
    provenance: &Provenance,
    fitted: &[Fitted<'_>],
    free: &[Constituent],
    model: Model,
) -> String {
    let leaves = fitted.iter().map(|Fitted { leaf, found }| {
        let mut contents = Map::new();
        for &of in free {
            let figure = figure(found.contents[of], found.known[of], found.bounds[of]);
            contents.insert(of.key().to_owned(), figure);
        }
        let contrast = found.contrast;
        json!({
            "leaf": shown(leaf),
            "contents": contents,
            "face_contrast": contrast.map(|found| figure(found.value, found.known, CONTRASTS)),
            "covariance": {
                "of": found.covariance.of.iter().map(|of| key(*of)).collect::<Vec<_>>(),
                "rows": found.covariance.rows,
            },
            "correlation": found.correlation.map(|found| json!({
                "fraction": found.fraction,
                "length_nm": found.length_nm,
            })),
            "rms": found.rms(),
            "values": found.values(),
            "wavelength_nm": leaf.nm,
            "reflectance_left": found.reflectance_left,
            "abaxial_reflectance_left": found.abaxial_left,
            "transmittance_left": found.transmittance_left,
        })
    });
    let leaves: Vec<Json> = leaves.collect();
    let report = json!({ "program": PROGRAM, "model": model.name(), "leaves": leaves });
    format!("{:#}\n", provenance.within(report))
}

/// A value with its errors, or why there is none.
fn figure(value: f64, known: Determined, [low, high]: [f64; 2]) -> Json {
    let error = known.error();
    let interval = error.map(|error| {
        [value - INTERVAL * error, value + INTERVAL * error].map(|end| end.clamp(low, high))
    });
    json!({
        "value": known.has_value().then_some(value),
        "standard_error": error,
        "interval_95": interval,
        "reason": known.reason(),
    })
}

/// Measured and fitted values, a line for each wavelength of each leaf.
pub(crate) fn fitted_spectra(fitted: &[Fitted<'_>]) -> String {
    let has_faces = have_faces(fitted);
    let mut header = vec!["leaf", "wavelength_nm", "R", "R_fitted", "T", "T_fitted"];
    if has_faces {
        header.splice(4..4, ["R_abaxial", "R_abaxial_fitted"]);
    }
    let mut table = Table::commented(header);
    for Fitted { leaf, found } in fitted {
        for (i, nm) in leaf.nm.iter().enumerate() {
            let mut row = vec![shown(leaf).to_owned(), nm.to_string()];
            for (measured, left, is_written) in [
                (&leaf.reflectance, &found.reflectance_left, true),
                (&leaf.abaxial, &found.abaxial_left, has_faces),
                (&leaf.transmittance, &found.transmittance_left, true),
            ] {
                if is_written {
                    let value = measured.get(i).copied();
                    row.extend([value, value.map(|value| value + left[i])].map(cell));
                }
            }
            table.row(row);
        }
    }
    table.text()
}

/// What a reader of the terminal sees.
pub(crate) fn human(fitted: &[Fitted<'_>], free: &[Constituent]) -> String {
    let mut lines = Vec::new();
    for Fitted { leaf, found } in fitted {
        let rms = found.rms();
        lines.push(format!(
            "{}: {} values, rms {rms:.2e}",
            shown(leaf),
            found.values()
        ));
        let told = |words: &str, value: f64, unit: &str, known: Determined| {
            let error = match known {
                Determined::Within(error) => format!("± {:.2}", Rounded(INTERVAL * error)),
                Determined::Given | Determined::AtEnd | Determined::Not(_) => {
                    known.reason().unwrap_or_default().to_owned()
                }
            };
            let value = if known.has_value() {
                format!("{:.4} {unit}", Rounded(value))
                    .trim_end()
                    .to_owned()
            } else {
                "not determined".to_owned()
            };
            [words.to_owned(), value, error]
        };
        let contents = free
            .iter()
            .map(|&of| told(of.words(), found.contents[of], of.unit(), found.known[of]));
        let contrast = found
            .contrast
            .map(|contrast| told("contrast of the faces", contrast.value, "", contrast.known));
        let rows: Vec<[String; 3]> = contents.chain(contrast).collect();
        lines.push(aligned(&rows));
    }
    lines.push("± is half of the interval of 95 %".to_owned());
    lines.join("\n")
}

/// A number with so many digits that count.
pub(crate) struct Rounded(pub(crate) f64);

impl fmt::Display for Rounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = f.precision().unwrap_or(3) as i32;
        if self.0 == 0.0 {
            return f.write_str("0");
        }
        let before = libm::floor(libm::log10(self.0.abs())) as i32 + 1;
        let places = (digits - before).clamp(0, 12) as usize;
        write!(f, "{:.places$}", self.0)
    }
}
