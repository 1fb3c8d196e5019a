//! Spectra: a number, a table, a file of a table, daylight or a black body.

use leafmodel::document::context::Context;
use leafmodel::document::coverage::require_coverage;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::{Limits, Plain};
use leafmodel::document::reader::Block;
use leafmodel::document::schema::{EntrySchema, Group, Is, Type};
use leafmodel::document::source::Place;
use leafmodel::document::tree::{Entry, Node, Table, Value};
use leafmodel::document::value_kind::{Kind, Number, Word};
use leafmodel::document::values::{finite_at, list, number, number_at, wrong_length, wrong_type};

use super::table_file::{self, Rows};
use crate::measured::units;
use crate::scene::description::Spectrum;
use crate::spectrum::library;

/// A spectrum with its role.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::scene) enum SpectrumOf {
    /// A share of light, 0 to 1.
    Share,
    /// A ratio of two shares, above 0.
    Ratio,
    /// Radiance, irradiance or intensity.
    Emission,
    /// A coefficient of a medium, mm⁻¹.
    PerMillimetre,
    /// A coefficient of a medium, m⁻¹.
    PerMetre,
}

impl SpectrumOf {
    fn limits(self) -> Limits {
        match self {
            Self::Share => Limits::closed(0.0, 1.0),
            Self::Ratio => Limits::closed(1e-3, 1e3),
            Self::Emission => Limits::closed(0.0, 1e12),
            Self::PerMillimetre => Limits::closed(0.0, 1e6),
            Self::PerMetre => Limits::closed(0.0, 1e9),
        }
    }

    fn forms(self) -> &'static str {
        match self {
            Self::Share => {
                "a number, `{ table = [[nm, value], …] }`, `{ file = \"….csv\" }`, `{ measured = \
                 \"slate\" }` or `{ soil_moisture = 0.3 }`"
            }
            Self::Ratio | Self::PerMillimetre | Self::PerMetre => {
                "a number, `{ table = [[nm, value], …] }` or `{ file = \"….csv\" }`"
            }
            Self::Emission => {
                "a number, `{ table = [[nm, value], …] }`, `{ file = \"….csv\" }`, `{ d65 = 1 }` or \
                 `{ blackbody_k = 5800 }`"
            }
        }
    }

    fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Share => &["table", "file", "measured", "soil_moisture"],
            Self::Ratio | Self::PerMillimetre | Self::PerMetre => &["table", "file"],
            Self::Emission => &["table", "file", "d65", "blackbody_k"],
        }
    }
}

impl Kind for SpectrumOf {
    type Of = Spectrum;

    fn read(&self, cx: &Context, node: &Node, key: &str) -> Option<Spectrum> {
        self.form(cx, node, key, key.to_owned())
    }

    fn read_in(&self, block: &Block<'_>, node: &Node, key: &str) -> Option<Spectrum> {
        self.form(block.cx, node, key, block.path_of(key))
    }

    fn write(&self, spectrum: &Spectrum) -> Value {
        let table = |entries: &[(&str, Value)]| {
            let entries = entries.iter().map(|(key, value)| {
                let node = Node::unplaced(value.clone());
                Entry {
                    key: (*key).to_owned(),
                    key_at: node.at.clone(),
                    node,
                }
            });
            Value::Table(Table(entries.collect()))
        };
        match spectrum {
            Spectrum::Constant(value) => number(*value),
            Spectrum::Table { points, .. } => {
                let rows = points
                    .iter()
                    .map(|(nm, value)| list([*nm, *value].map(number)));
                table(&[("table", list(rows))])
            }
            Spectrum::D65 { scale } => table(&[("d65", number(*scale))]),
            Spectrum::Blackbody { kelvin, scale } => {
                table(&[("blackbody_k", number(*kelvin)), ("scale", number(*scale))])
            }
        }
    }

    fn describe(&self) -> Type {
        let mut form = Keys::describe(|keys| {
            keys.key("scale", &mut 1.0, Number(FACTORS), "Factor on the values.");
        });
        for key in self.keys() {
            let (about, of) = match *key {
                "table" => {
                    let row = vec![
                        Type::Number(TABLE_WAVELENGTHS_NM),
                        Type::Number(Limits::closed(f64::MIN, f64::MAX)),
                    ];
                    let rows = Type::List {
                        of: Box::new(Type::Tuple(row)),
                        least: 2,
                        most: usize::MAX >> 11,
                        wanted: "a list of [wavelength in nm, value]",
                    };
                    ("Linear between rows, whose wavelengths rise.", rows)
                }
                "file" => (
                    "Such a table in a file, ASCII export of an ASD, or a `.sig` file of an SVC.",
                    Type::Text("the path of a CSV file"),
                ),
                "measured" => {
                    let about = "A measured surface by its name.";
                    (about, Word(&SURFACES).describe())
                }
                "soil_moisture" => {
                    let about = "Bare soil of this moisture, 0 dry to 1 wet.";
                    (about, Type::Number(MOISTURE))
                }
                "d65" => {
                    let about = "CIE standard illuminant D65, with this value at 560 nm.";
                    (about, Type::Number(FACTORS))
                }
                _ => {
                    let about = "A black body of this temperature, 1 at 560 nm.";
                    (about, Type::Number(KELVIN))
                }
            };
            form.add(EntrySchema {
                key: (*key).to_owned(),
                about,
                required: false,
                is: Is::Value { of, default: None },
            });
        }
        form.groups.push(Group {
            keys: self.keys().to_vec(),
            required: true,
        });
        Type::AnyOf(
            vec![Type::Number(self.limits()), Type::Table(form)],
            self.forms(),
        )
    }
}

/// Range of wavelengths of tables, nm; solar spectra start in the far ultraviolet.
pub(super) const TABLE_WAVELENGTHS_NM: Limits = Limits::closed(1.0, 1e7);
/// Where CIE standard illuminant D65 is defined, nm.
pub(super) const D65_NM: [f64; 2] = [300.0, 830.0];
/// Moisture of soil.
const MOISTURE: Limits = Limits::closed(0.0, 1.0);
/// Names of the measured surfaces, with their numbers.
static SURFACES: [(&str, usize); library::SURFACES.len()] = numbered();

const fn numbered() -> [(&'static str, usize); library::SURFACES.len()] {
    let mut numbered = [("", 0); library::SURFACES.len()];
    let mut number = 0;
    while number < numbered.len() {
        numbered[number] = (library::SURFACES[number], number);
        number += 1;
    }
    numbered
}

const FACTORS: Limits = Limits::above(0.0, 1e12);
/// Range of temperatures of black bodies, K.
const KELVIN: Limits = Limits::closed(100.0, 1e6);

impl SpectrumOf {
    fn form(self, cx: &Context, node: &Node, key: &str, path: String) -> Option<Spectrum> {
        match &node.value {
            Value::Integer(_) | Value::Number(_) => {
                number_at(cx, node, key, self.limits()).map(Spectrum::Constant)
            }
            Value::Table(table) => {
                let form = Block::new(cx, table, path, node.at.clone());
                read_form(&form, key, self)
            }
            Value::Text(_) | Value::Flag(_) | Value::Other(..) | Value::List(_) => {
                wrong_type(cx, node, key, self.forms());
                None
            }
        }
    }
}

fn read_form(form: &Block<'_>, key: &str, role: SpectrumOf) -> Option<Spectrum> {
    let chosen = form.exactly_one(role.keys());
    let spectrum = match chosen {
        Some("d65") => form.number("d65", FACTORS).and_then(|scale| {
            require_coverage(form.cx, &form.at, "the illuminant D65", D65_NM)
                .then_some(Spectrum::D65 { scale })
        }),
        Some("blackbody_k") => {
            let kelvin = form.number("blackbody_k", KELVIN);
            let scale = form.number_or("scale", FACTORS, 1.0);
            kelvin.map(|kelvin| Spectrum::Blackbody { kelvin, scale })
        }
        Some("measured") => {
            let scale = form.number_or("scale", FACTORS, 1.0);
            form.node("measured")
                .and_then(|node| Word(&SURFACES).read(form.cx, node, "measured"))
                .and_then(|number| shipped(form, library::surface(number), scale, key, role))
        }
        Some("soil_moisture") => {
            let scale = form.number_or("scale", FACTORS, 1.0);
            form.number("soil_moisture", MOISTURE)
                .and_then(|moisture| shipped(form, library::soil(moisture), scale, key, role))
        }
        Some("table") => {
            let scale = form.number_or("scale", FACTORS, 1.0);
            form.node("table")
                .and_then(|node| inline_rows(form.cx, node, key))
                .and_then(|rows| checked_table(form, &rows, scale, key, role))
        }
        Some(_) => {
            // Whoever writes a factor knows the unit.
            let guess = role == SpectrumOf::Share && form.node("scale").is_none();
            let scale = form.number_or("scale", FACTORS, 1.0);
            form.text("file", "the path of a CSV file")
                .and_then(|(path, at)| table_file::rows(form.cx, path, at, guess))
                .and_then(|rows| checked_table(form, &rows, scale, key, role))
        }
        None => {
            // `scale` is known in most forms, and the error was already reported.
            form.node("scale");
            None
        }
    };
    form.finish();
    spectrum
}

/// A spectrum of the library.
fn shipped(
    form: &Block<'_>,
    points: Vec<(f64, f64)>,
    scale: f64,
    key: &str,
    role: SpectrumOf,
) -> Option<Spectrum> {
    let places = vec![[form.at.clone(), form.at.clone()]; points.len()];
    let rows = Rows {
        points,
        places,
        ..Rows::default()
    };
    checked_table(form, &rows, scale, key, role)
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

/// A table whose wavelengths rise, whose values are allowed, and which covers the film.
fn checked_table(
    form: &Block<'_>,
    rows: &Rows,
    scale: f64,
    key: &str,
    role: SpectrumOf,
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
        let error = DocumentError::NotRising {
            key: "wavelengths".to_owned(),
            before: points[index - 1].0,
            after: points[index].0,
        };
        cx.error(&rows.places[index][0], error);
        return None;
    }
    if role == SpectrumOf::Share
        && let Some(file) = &rows.file
    {
        let nm: Vec<f64> = points.iter().map(|point| point.0).collect();
        let mut gaps = units::gaps(&nm, units::WIDE_GAP);
        let found = gaps.find_map(|at| {
            let error = table_file::gap(cx, file, [nm[at - 1], nm[at]])?;
            Some((at, error))
        });
        if let Some((at, error)) = found {
            cx.error(&rows.places[at][0], error);
            return None;
        }
    }
    let limits = role.limits();
    // Percent times 0.01 may round to just above 1.
    let clamped = |value: f64| match role {
        SpectrumOf::Share if value > 1.0 && value < 1.0 + 1e-9 => 1.0,
        SpectrumOf::Share
        | SpectrumOf::Ratio
        | SpectrumOf::Emission
        | SpectrumOf::PerMillimetre
        | SpectrumOf::PerMetre => value,
    };
    if let Some(bad) = points
        .iter()
        .position(|(_, value)| !limits.contain(clamped(value * scale)))
    {
        let greatest = points
            .iter()
            .fold(0.0_f64, |most, (_, value)| most.max(value * scale));
        let value = points[bad].1 * scale;
        let help = if role == SpectrumOf::Share && (2.0..=100.0).contains(&greatest) {
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

/// A guess at the unit of wavelengths that cannot be nanometres.
fn unit_of_wavelengths(points: &[(f64, f64)]) -> Option<&'static str> {
    let (first, last) = (points.first()?.0, points.last()?.0);
    (first > 0.1 && last < 100.0)
        .then_some("these look like micrometres: multiply them by 1000 to have nanometres")
}

fn out_of_range(cx: &Context, at: &Place, key: &str, value: f64, limits: Limits, help: String) {
    let error = DocumentError::OutOfRange {
        key: key.to_owned(),
        value: Plain(value).to_string(),
        range: limits.to_string(),
        help,
    };
    cx.error(at, error);
}
