//! Spectra: a number, a table, a file of a table, daylight or a black body.

use leafmodel::document::context::Context;
use leafmodel::document::coverage::require_coverage;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::limits::{Limits, Plain};
use leafmodel::document::reader::Block;
use leafmodel::document::schema::Type;
use leafmodel::document::source::Place;
use leafmodel::document::tree::{Node, Table, Value};
use leafmodel::document::value_kind::{Kind, NamedFile, Number, Word};
use leafmodel::document::values::{finite_at, list, number, number_at, wrong_length, wrong_type};

use super::table_file::{self, Rows, first_gap};
use crate::spectrum::library;
use crate::spectrum::wet_soil::wetted;
use crate::spectrum::written::Spectrum;

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
        let scaled = |key, value, scale| [(key, number(value)), ("scale", number(scale))];
        Value::Table(match spectrum {
            Spectrum::Constant(value) => return number(*value),
            Spectrum::Table { points, .. } => {
                let rows = points.iter();
                let rows = rows.map(|(nm, value)| list([*nm, *value].map(number)));
                Table::of([("table", list(rows))])
            }
            Spectrum::D65 { scale } => Table::of([("d65", number(*scale))]),
            Spectrum::Blackbody { kelvin, scale } => {
                Table::of(scaled("blackbody_k", *kelvin, *scale))
            }
        })
    }

    fn describe(&self) -> Type {
        let form = Keys::describe(|keys| self.declare("", &mut None, keys));
        Type::AnyOf(
            vec![Type::Number(self.limits()), Type::Table(form)],
            self.forms(),
        )
    }
}

/// Range of wavelengths of tables, nm; solar spectra start in the far ultraviolet.
pub(in crate::scene) const TABLE_WAVELENGTHS_NM: Limits = Limits::closed(1.0, 1e7);
/// Where CIE standard illuminant D65 is defined, nm.
pub(in crate::scene) const D65_NM: [f64; 2] = [300.0, 830.0];
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

const FACTORS: Number = Number(Limits::above(0.0, 1e12));

impl SpectrumOf {
    fn form(self, cx: &Context, node: &Node, key: &str, path: String) -> Option<Spectrum> {
        match &node.value {
            Value::Integer(_) | Value::Number(_) => {
                number_at(cx, node, key, self.limits()).map(Spectrum::Constant)
            }
            Value::Table(table) => {
                let form = Block::new(cx, table, path, node.at.clone());
                let mut spectrum = None;
                Keys::read(form, None, |keys| self.declare(key, &mut spectrum, keys));
                spectrum
            }
            Value::Text(_) | Value::Flag(_) | Value::Other(..) | Value::List(_) => {
                wrong_type(cx, node, key, self.forms());
                None
            }
        }
    }

    /// The keys of the forms that have some, at the key of this name.
    fn declare(self, key: &str, spectrum: &mut Option<Spectrum>, keys: &mut Keys<'_>) {
        let chosen = keys.one_of(self.keys(), None);
        let mut scale = 1.0;
        // Whoever writes a factor knows the unit.
        let guess = self == Self::Share && chosen == ["file"] && !keys.has("scale");
        if chosen != ["d65"] {
            keys.key("scale", &mut scale, FACTORS, "Factor on the values.");
        }
        let mut moisture = None;
        if self == Self::Share && chosen != ["soil_moisture"] {
            let limits = Number(Limits::closed(0.0, 60.0));
            let about = "Water by volume in soil whose reflectance when dry the values are, percent; up to 5 is dry.";
            keys.optional("wet_percent", &mut moisture, limits, about);
        }
        for form in chosen {
            let rows = match form {
                "table" => {
                    let mut rows = None;
                    let about = "Linear between rows, whose wavelengths rise.";
                    keys.optional("table", &mut rows, InlineRows(key), about);
                    rows
                }
                "file" => {
                    let mut named = None;
                    let about = "Such a table in a file, ASCII export of an ASD, or a `.sig` file of an SVC.";
                    keys.optional("file", &mut named, table_file::SPECTRUM, about);
                    Self::in_file(named.as_ref(), guess, keys)
                }
                "measured" => {
                    let mut number = None;
                    let about = "A measured surface by its name.";
                    keys.optional("measured", &mut number, Word(&SURFACES), about);
                    number.and_then(|number| shipped(library::surface(number), keys))
                }
                "soil_moisture" => {
                    let mut moisture = None;
                    let about = "Bare soil of this moisture, 0 dry to 1 wet.";
                    let limits = Number(Limits::closed(0.0, 1.0));
                    keys.optional("soil_moisture", &mut moisture, limits, about);
                    moisture.and_then(|moisture| shipped(library::soil(moisture), keys))
                }
                "d65" => {
                    let mut scale = None;
                    let about = "CIE standard illuminant D65, with this value at 560 nm.";
                    keys.optional("d65", &mut scale, FACTORS, about);
                    if let (Some(scale), Some(form)) = (scale, keys.reader())
                        && require_coverage(form.cx, &form.at, "the illuminant D65", D65_NM)
                    {
                        *spectrum = Some(Spectrum::D65 { scale });
                    }
                    None
                }
                _ => {
                    let mut kelvin = None;
                    let about = "A black body of this temperature, 1 at 560 nm.";
                    let limits = Number(Limits::closed(100.0, 1e6));
                    keys.optional("blackbody_k", &mut kelvin, limits, about);
                    *spectrum = kelvin.map(|kelvin| Spectrum::Blackbody { kelvin, scale });
                    None
                }
            };
            if let (Some(rows), Some(form)) = (rows, keys.reader()) {
                *spectrum = checked_table(form, &rows, scale, key, self);
            }
            if let (Some(Spectrum::Table { points, .. }), Some(moisture)) =
                (&mut *spectrum, moisture)
            {
                *points = wetted(points, moisture);
            }
        }
    }

    fn in_file(named: Option<&NamedFile>, guess: bool, keys: &Keys<'_>) -> Option<Rows> {
        let form = keys.reader()?;
        table_file::rows(form.cx, named?, &form.node("file")?.at, guess)
    }
}

/// A spectrum of the library, whose rows have no places of their own.
fn shipped(points: Vec<(f64, f64)>, keys: &Keys<'_>) -> Option<Rows> {
    let at = &keys.reader()?.at;
    Some(Rows {
        places: vec![[at.clone(), at.clone()]; points.len()],
        points,
        file: None,
    })
}

/// The rows `[[nm, value], …]` of a table in the scene file, at the key of this name.
struct InlineRows<'k>(&'k str);

const ROWS: &str = "a list of [wavelength in nm, value]";

impl Kind for InlineRows<'_> {
    type Of = Rows;

    fn read(&self, cx: &Context, node: &Node, _: &str) -> Option<Rows> {
        let Value::List(list) = &node.value else {
            wrong_type(cx, node, self.0, ROWS);
            return None;
        };
        let mut rows = Rows::default();
        let before_this = cx.error_count();
        for row in list {
            if let Value::List(pair) = &row.value
                && let [wavelength, value] = pair.as_slice()
            {
                let point = [wavelength, value].map(|node| finite_at(cx, node, self.0, "a number"));
                if let [Some(wavelength_nm), Some(number)] = point {
                    rows.points.push((wavelength_nm, number));
                    rows.places.push([wavelength.at.clone(), value.at.clone()]);
                }
            } else {
                wrong_type(cx, row, self.0, ROWS);
                return None;
            }
        }
        (cx.error_count() == before_this).then_some(rows)
    }

    fn write(&self, rows: &Rows) -> Value {
        let rows = rows.points.iter();
        list(rows.map(|(nm, value)| list([*nm, *value].map(number))))
    }

    fn describe(&self) -> Type {
        let number = Type::Number(Limits::closed(f64::MIN, f64::MAX));
        Type::List {
            of: Box::new(Type::Tuple(vec![
                Type::Number(TABLE_WAVELENGTHS_NM),
                number,
            ])),
            least: 2,
            most: usize::MAX >> 11,
            wanted: ROWS,
        }
    }
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
        if let Some((at, error)) = first_gap(cx, file, &nm) {
            cx.error(&rows.places[at][0], error);
            return None;
        }
    }
    let limits = role.limits();
    // Percent times 0.01 may round to just above 1.
    let clamped = |value: f64| {
        let is_rounded = role == SpectrumOf::Share && value > 1.0 && value < 1.0 + 1e-9;
        if is_rounded { 1.0 } else { value }
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
