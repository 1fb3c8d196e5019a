//! Spectra: a number, a table, a file of a table, daylight or a black body.

use std::fs;

use super::context::Context;
use super::limits::Limits;
use super::path::{Wanted, resolve};
use super::reader::Block;
use super::table_file::read_table_file;
use super::tree::{Node, Value};
use super::values::{finite_at, number_at, wrong_length, wrong_type};
use crate::scene::description::Spectrum;
use crate::scene::error::SceneError;
use crate::scene::source::Place;

/// What a spectrum is used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// A share of light, 0 to 1.
    Share,
    /// A ratio of two shares, above 0.
    Ratio,
    /// Radiance or irradiance.
    Emission,
}

impl Role {
    pub(crate) fn limits(self) -> Limits {
        match self {
            Self::Share => Limits::closed(0.0, 1.0),
            Self::Ratio => Limits::closed(1e-3, 1e3),
            Self::Emission => Limits::closed(0.0, 1e12),
        }
    }

    fn forms(self) -> &'static str {
        match self {
            Self::Share | Self::Ratio => {
                "a number, `{ table = [[nm, value], …] }` or `{ file = \"….csv\" }`"
            }
            Self::Emission => {
                "a number, `{ table = [[nm, value], …] }`, `{ file = \"….csv\" }`, `{ d65 = 1 }` or \
                 `{ blackbody_k = 5800 }`"
            }
        }
    }
}

/// Wavelengths that tables may hold, nm; solar spectra start in the far ultraviolet.
pub(crate) const TABLE_WAVELENGTHS_NM: Limits = Limits::closed(1.0, 1e7);
/// Where CIE standard illuminant D65 is defined, nm.
const D65_NM: [f64; 2] = [300.0, 830.0];
/// Where PROSPECT-D's table has figures, nm.
const PROSPECT_NM: [f64; 2] = [400.0, 2500.0];
const FACTORS: Limits = Limits::above(0.0, 1e12);

/// Rows of a table, each with its place.
#[derive(Debug, Default)]
pub(crate) struct Rows {
    pub(crate) points: Vec<(f64, f64)>,
    /// Places of the wavelength and of the value.
    pub(crate) places: Vec<[Place; 2]>,
}

/// Reads a spectrum that must be there.
pub(crate) fn read_spectrum(block: &Block<'_>, key: &'static str, role: Role) -> Option<Spectrum> {
    let node = block.needed(key, || format!("`{key} = …`, {}", role.forms()))?;
    spectrum_at(block, node, key, role)
}

/// Reads a spectrum that has a default; `None` if it is there and wrong.
pub(crate) fn read_spectrum_or(
    block: &Block<'_>,
    key: &'static str,
    role: Role,
    default: impl FnOnce() -> Spectrum,
) -> Option<Spectrum> {
    match block.node(key) {
        Some(node) => spectrum_at(block, node, key, role),
        None => Some(default()),
    }
}

fn spectrum_at(block: &Block<'_>, node: &Node, key: &'static str, role: Role) -> Option<Spectrum> {
    let cx = block.cx;
    match &node.value {
        Value::Integer(_) | Value::Number(_) => {
            number_at(cx, node, key, role.limits()).map(Spectrum::Constant)
        }
        Value::Table(table) => {
            let form = Block::new(cx, table, block.path_of(key), node.at.clone());
            read_form(&form, key, role)
        }
        Value::Text(_) | Value::Flag(_) | Value::Other(..) | Value::List(_) => {
            wrong_type(cx, node, key, role.forms());
            None
        }
    }
}

fn read_form(form: &Block<'_>, key: &'static str, role: Role) -> Option<Spectrum> {
    let forms: &[&'static str] = match role {
        Role::Share | Role::Ratio => &["table", "file"],
        Role::Emission => &["table", "file", "d65", "blackbody_k"],
    };
    let chosen = form.exactly_one(forms);
    let spectrum = match chosen {
        Some("d65") => form.number("d65", FACTORS).and_then(|scale| {
            require_coverage(form.cx, &form.at, "the illuminant D65", D65_NM)
                .then_some(Spectrum::D65 { scale })
        }),
        Some("blackbody_k") => {
            let kelvin = form.number("blackbody_k", Limits::closed(100.0, 1e6));
            let scale = form.number_or("scale", FACTORS, 1.0);
            kelvin.map(|kelvin| Spectrum::Blackbody { kelvin, scale })
        }
        Some("table") => {
            let scale = form.number_or("scale", FACTORS, 1.0);
            form.node("table")
                .and_then(|node| inline_rows(form.cx, node, key))
                .and_then(|rows| checked_table(form, &rows, scale, key, role))
        }
        Some(_) => {
            let scale = form.number_or("scale", FACTORS, 1.0);
            form.text("file", "the path of a CSV file")
                .and_then(|(path, at)| file_rows(form.cx, path, at))
                .and_then(|rows| checked_table(form, &rows, scale, key, role))
        }
        None => {
            // Known beside most forms; what is wrong was said already.
            form.node("scale");
            None
        }
    };
    form.finish();
    spectrum
}

/// The rows `[[nm, value], …]` of a table in the scene file.
fn inline_rows(cx: &Context, node: &Node, key: &str) -> Option<Rows> {
    const WANTED: &str = "a list of [wavelength in nm, value]";
    let Value::List(list) = &node.value else {
        wrong_type(cx, node, key, WANTED);
        return None;
    };
    let mut rows = Rows::default();
    let before_this = cx.error_count();
    for row in list {
        if let Value::List(pair) = &row.value
            && let [wavelength, value] = pair.as_slice()
        {
            let point = (
                finite_at(cx, wavelength, key, "a number"),
                finite_at(cx, value, key, "a number"),
            );
            if let (Some(wavelength_nm), Some(number)) = point {
                rows.points.push((wavelength_nm, number));
                rows.places.push([wavelength.at.clone(), value.at.clone()]);
            }
        } else {
            wrong_type(cx, row, key, WANTED);
            return None;
        }
    }
    (cx.error_count() == before_this).then_some(rows)
}

fn file_rows(cx: &Context, path: &str, at: &Place) -> Option<Rows> {
    const MOST_BYTES: u64 = 16 << 20;
    let wanted = Wanted {
        endings: &["csv", "tsv", "txt"],
        most_bytes: MOST_BYTES,
    };
    let file = resolve(cx, path, at, wanted)?;
    let bytes = fs::read(file)
        .map_err(|error| {
            let error = SceneError::BadFile {
                path: crate::scene::source::escaped(path, 120),
                problem: format!("cannot be read: {error}"),
                help: "make the file readable".to_owned(),
            };
            cx.error(at, error);
        })
        .ok()?;
    read_table_file(cx, path, at, &bytes)
}

/// A table whose wavelengths rise, whose values are allowed, and which covers the film.
fn checked_table(
    form: &Block<'_>,
    rows: &Rows,
    scale: f64,
    key: &str,
    role: Role,
) -> Option<Spectrum> {
    let cx = form.cx;
    let points = &rows.points;
    if points.len() < 2 {
        let wanted = "a table of at least 2 rows, or a number for the same value everywhere";
        wrong_length(cx, &form.at, key, "a table", points.len(), wanted);
        return None;
    }
    if let Some(bad) = points
        .iter()
        .position(|(nm, _)| !TABLE_WAVELENGTHS_NM.contain(*nm))
    {
        let help = unit_of_wavelengths(points)
            .map_or_else(|| TABLE_WAVELENGTHS_NM.advice(points[bad].0), str::to_owned);
        out_of_range(
            cx,
            &rows.places[bad][0],
            "wavelength",
            points[bad].0,
            TABLE_WAVELENGTHS_NM,
            help,
        );
        return None;
    }
    if let Some(index) = (1..points.len()).find(|index| points[*index].0 <= points[index - 1].0) {
        let error = SceneError::NotRising {
            key: "wavelengths".to_owned(),
            before: points[index - 1].0,
            after: points[index].0,
        };
        cx.error(&rows.places[index][0], error);
        return None;
    }
    let limits = role.limits();
    // Percent times 0.01 may round to just above 1.
    let clamped = |value: f64| match role {
        Role::Share if value > 1.0 && value < 1.0 + 1e-9 => 1.0,
        Role::Share | Role::Ratio | Role::Emission => value,
    };
    if let Some(bad) = points
        .iter()
        .position(|(_, value)| !limits.contain(clamped(value * scale)))
    {
        let greatest = points
            .iter()
            .fold(0.0_f64, |most, (_, value)| most.max(value * scale));
        let value = points[bad].1 * scale;
        let help = if role == Role::Share && (2.0..=100.0).contains(&greatest) {
            "if the table is in percent, write `scale = 0.01` beside it".to_owned()
        } else {
            limits.advice(value)
        };
        out_of_range(cx, &rows.places[bad][1], key, value, limits, help);
        return None;
    }
    let covered = [points[0].0, points[points.len() - 1].0];
    if !require_coverage(cx, &form.at, &format!("`{key}`"), covered) {
        return None;
    }
    Some(Spectrum::Table {
        points: points
            .iter()
            .map(|(nm, value)| (*nm, clamped(value * scale)))
            .collect(),
        extrapolate: cx.extrapolate.get(),
    })
}

/// The unit in which wavelengths that are no nanometres probably are.
fn unit_of_wavelengths(points: &[(f64, f64)]) -> Option<&'static str> {
    let (first, last) = (points.first()?.0, points.last()?.0);
    (first > 0.1 && last < 100.0)
        .then_some("these look like micrometres: multiply them by 1000 to have nanometres")
}

fn out_of_range(cx: &Context, at: &Place, key: &str, value: f64, limits: Limits, help: String) {
    let error = SceneError::OutOfRange {
        key: key.to_owned(),
        value: super::limits::Plain(value).to_string(),
        range: limits.to_string(),
        help,
    };
    cx.error(at, error);
}

/// Makes sure that a leaf's PROSPECT spectra reach over the film's wavelengths.
pub(crate) fn require_prospect(cx: &Context, at: &Place) {
    require_coverage(cx, at, "PROSPECT-D's table", PROSPECT_NM);
}

/// Whether data reach over the film's wavelengths; an error, or a warning with `extrapolate`.
fn require_coverage(cx: &Context, at: &Place, what: &str, covered: [f64; 2]) -> bool {
    let Some(needed) = cx.range_nm.get() else {
        return true;
    };
    if covered[0] <= needed[0] && covered[1] >= needed[1] {
        return true;
    }
    if cx.extrapolate.get() {
        let message = format!(
            "{what} covers {} to {} nm and goes on with its end values over the film's {} to {} nm",
            covered[0], covered[1], needed[0], needed[1]
        );
        cx.warn(
            at,
            "scene::extrapolated",
            message,
            "narrow the film's range if that is not meant",
        );
        return true;
    }
    let error = SceneError::Coverage {
        what: what.to_owned(),
        from_nm: covered[0],
        to_nm: covered[1],
        need_from_nm: needed[0],
        need_to_nm: needed[1],
    };
    cx.error(at, error);
    false
}
