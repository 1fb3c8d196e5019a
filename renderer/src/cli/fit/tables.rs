//! What is written of a fit: CSV and JSON.

use std::fmt::Write as _;

use leafmodel::optics::Constituent;
use leafmodel::optics::faces::CONTRASTS;
use leafmodel::optics::inversion::{Determined, Found, INTERVAL, Inversion};
use serde_json::{Map, Value as Json, json};

use super::{Fitted, shown};
use crate::checkpoint::PROGRAM;

/// A table with a line for each leaf.
pub(super) fn contents(fitted: &[Fitted<'_>], free: &[Constituent]) -> String {
    let mut text = "leaf".to_owned();
    for of in free {
        let _ = write!(text, ",{0},{0}_standard_error", of.key());
    }
    // Tables of one face keep their columns.
    let has_faces = fitted.iter().any(|fitted| fitted.found.contrast.is_some());
    if has_faces {
        text += ",face_contrast,face_contrast_standard_error";
    }
    text += ",rms,values,reasons\n";
    for Fitted { leaf, found } in fitted {
        text += &quoted(shown(leaf));
        let mut figure = |value: f64, known: Determined| {
            let value = known.has_value().then_some(value);
            for figure in [value, known.error()] {
                match figure {
                    Some(figure) => _ = write!(text, ",{figure}"),
                    None => text.push(','),
                }
            }
        };
        for &of in free {
            figure(found.contents[of], found.known[of]);
        }
        match found.contrast {
            Some(contrast) => figure(contrast.value, contrast.known),
            None if has_faces => text += ",,",
            None => {}
        }
        let (rms, values) = (found.rms(), found.values());
        let _ = writeln!(text, ",{rms},{values},{}", quoted(&reasons(found, free)));
    }
    text
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
pub(super) fn covariances(fitted: &[Fitted<'_>]) -> String {
    let mut text = "leaf,first,second,covariance,correlation\n".to_owned();
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
                let (leaf, of, other) = (quoted(shown(leaf)), key(*of), key(*other));
                let _ = writeln!(text, "{leaf},{of},{other},{value},{correlation}");
            }
        }
    }
    text
}

/// A name as a field of a table. A line that begins with `#` would be a comment.
pub(in crate::cli) fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '#']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_owned()
    }
}

/// Everything as JSON.
pub(super) fn report(fitted: &[Fitted<'_>], free: &[Constituent]) -> String {
    let leaves = fitted.iter().map(|Fitted { leaf, found }| {
        let mut contents = Map::new();
        for &of in free {
            let figure = figure(found.contents[of], found.known[of], Inversion::bounds(of));
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
    format!("{:#}\n", json!({ "program": PROGRAM, "leaves": leaves }))
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
pub(super) fn fitted_spectra(fitted: &[Fitted<'_>]) -> String {
    let has_faces = fitted.iter().any(|fitted| fitted.found.contrast.is_some());
    let abaxial = if has_faces {
        ",R_abaxial,R_abaxial_fitted"
    } else {
        ""
    };
    let mut text = format!("leaf,wavelength_nm,R,R_fitted{abaxial},T,T_fitted\n");
    for Fitted { leaf, found } in fitted {
        for (i, nm) in leaf.nm.iter().enumerate() {
            let _ = write!(text, "{},{nm}", quoted(shown(leaf)));
            for (measured, left, is_written) in [
                (&leaf.reflectance, &found.reflectance_left, true),
                (&leaf.abaxial, &found.abaxial_left, has_faces),
                (&leaf.transmittance, &found.transmittance_left, true),
            ] {
                if !is_written {
                    continue;
                }
                match measured.get(i) {
                    Some(value) => _ = write!(text, ",{value},{}", value + left[i]),
                    None => text += ",,",
                }
            }
            text.push('\n');
        }
    }
    text
}
