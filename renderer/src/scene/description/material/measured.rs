//! `[materials.NAME.leaf.measured]`: spectra of a real leaf, of one face or of both.

use leafmodel::document::context::Context;
use leafmodel::document::coverage::require_coverage;
use leafmodel::document::declared::Declared;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::reader::Block;
use leafmodel::document::rows::{Decimal, Separator};
use leafmodel::document::source::{Place, quoted};
use leafmodel::document::value_kind::{FilePath, NamedFile, Text, Word};
use leafmodel::document::values::listed;

use crate::measured::Slack;
use crate::measured::known::{Known, ValueUnit, WavelengthUnit};
use crate::measured::spectra::{self, Leaf};
use crate::scene::blocks::spectrum::{SpectrumOf, TABLE_WAVELENGTHS_NM};
use crate::scene::blocks::table_file::{TableFile, bad_file, first_gap};
use crate::spectrum::written::Spectrum;

/// Largest table of leaves, bytes.
const MOST_BYTES: u64 = 64 << 20;
/// Guesses about a table that have keys of their names.
const KEYS: [&str; 4] = ["wavelengths", "values", "separator", "decimal"];

/// The spectra of a leaf.
#[derive(Clone, Debug, Default)]
pub(super) struct Measured {
    pub(super) reflectance: Spectrum,
    /// That of the abaxial face, if it was measured.
    pub(super) abaxial: Option<Spectrum>,
    pub(super) transmittance: Spectrum,
}

impl Declared for Measured {
    fn declare(&mut self, keys: &mut Keys<'_>) {
        for way in keys.one_of(&["reflectance", "file"], Some("reflectance")) {
            if way == "reflectance" {
                spectra_by_key(self, keys);
            } else {
                let mut table = LeafTable::default();
                table.declare(keys);
                if let Some(found) = table.spectra(keys) {
                    *self = found;
                }
            }
        }
    }
}

fn spectra_by_key(measured: &mut Measured, keys: &mut Keys<'_>) {
    let share = SpectrumOf::Share;
    let about = "Directional–hemispherical, coat included, of the adaxial face.";
    keys.required("reflectance", &mut measured.reflectance, share, about);
    let about = "The same of the abaxial face. Left out, it follows `abaxial_ratio`.";
    keys.optional("abaxial_reflectance", &mut measured.abaxial, share, about);
    let about = "The same through the leaf. R + T must not exceed 1 at any wavelength.";
    keys.needed("transmittance", &mut measured.transmittance, share, about);
    if keys.is_sound() {
        let faces = [Some(&measured.reflectance), measured.abaxial.as_ref()];
        for reflectance in faces.into_iter().flatten() {
            require_energy(keys, reflectance, &measured.transmittance);
        }
    }
}

/// A table with the columns of a leaf.
#[derive(Declared, Default)]
struct LeafTable {
    #[key(
        "file",
        required,
        PATH,
        about = "A table with columns wavelength, R, T and, if it was measured, R_abaxial, as `lamina fit` reads it."
    )]
    file: NamedFile,
    /// Which of the table's leaves, if it has several.
    #[key("leaf", Text("the name of a leaf of the table"))]
    leaf: Option<String>,
    /// Unit of its wavelengths, instead of a guess.
    #[key("wavelengths", Word(&WavelengthUnit::ALL))]
    wavelengths: Option<WavelengthUnit>,
    /// Unit of its values, instead of a guess.
    #[key("values", Word(&ValueUnit::ALL))]
    values: Option<ValueUnit>,
    /// What separates its fields, instead of a guess.
    #[key("separator", Word(&Separator::ALL))]
    separator: Option<Separator>,
    /// Its decimal mark, instead of a guess.
    #[key("decimal", Word(&Decimal::ALL))]
    decimal: Option<Decimal>,
}

const PATH: FilePath = FilePath::of(
    "the path of a CSV file with R and T",
    &["csv", "tsv", "txt"],
    MOST_BYTES,
);

impl LeafTable {
    fn spectra(&self, keys: &Keys<'_>) -> Option<Measured> {
        let block = keys.reader().filter(|_| keys.is_sound())?;
        let at = &block.node("file")?.at;
        let file = TableFile::read(block.cx, &self.file.file, &self.file.written, at)?;
        let mut known = Known {
            wavelengths: self.wavelengths,
            values: self.values,
            ..Known::default()
        };
        known.form.separator = self.separator;
        known.form.decimal = self.decimal;
        let found = file.sound(spectra::read(&file.text, &known))?;
        for note in &found.notes {
            let is_key = note.otherwise.is_some_and(|(key, _)| KEYS.contains(&key));
            let help = note.key().filter(|_| is_key);
            let help = help.unwrap_or_else(|| "change the file if that is not meant".to_owned());
            file.note(note, &help);
        }
        let leaf = self.chosen(block, &found.leaves)?;
        file.sound(leaf.check(&file.text, Slack::NONE))?;
        self.complete(block.cx, at, &file, leaf)
    }

    /// The leaf of that name, or the only one.
    fn chosen<'l>(&self, block: &Block<'_>, leaves: &'l [Leaf]) -> Option<&'l Leaf> {
        let found = match (&self.leaf, leaves) {
            (None, [only]) => return Some(only),
            (None, _) => None,
            (Some(name), _) => leaves.iter().find(|leaf| leaf.name == *name),
        };
        if found.is_none() {
            let names = leaves.iter().take(12).map(|leaf| quoted(&leaf.name));
            let names: Vec<String> = names.collect();
            let names = listed(names.iter().map(String::as_str));
            let (key, problem) = match &self.leaf {
                Some(name) => ("leaf", format!("has no leaf `{}`", quoted(name))),
                None => ("file", format!("has {} leaves", leaves.len())),
            };
            let at = block.node(key).map_or(&block.at, |node| &node.at);
            let help = format!("write `leaf` with one of its names: {names}");
            let error = bad_file(&self.file.written, problem, &help);
            block.cx.error(at, error);
        }
        found
    }

    /// What a scene needs of a leaf: R and T without gaps, over the wavelengths that are needed.
    fn complete(
        &self,
        cx: &Context,
        at: &Place,
        file: &TableFile<'_>,
        leaf: &Leaf,
    ) -> Option<Measured> {
        for (what, values) in [("R", &leaf.reflectance), ("T", &leaf.transmittance)] {
            if values.is_empty() {
                let help = "a leaf needs its reflectance and its transmittance";
                file.refuse(format!("has no column {what}"), help);
                return None;
            }
        }
        let (Some(first), Some(last)) = (leaf.nm.first(), leaf.nm.last()) else {
            return None;
        };
        if leaf.nm.len() < 2 || !TABLE_WAVELENGTHS_NM.contain(*first) {
            let problem = format!("has {} wavelengths from {first} nm on", leaf.nm.len());
            file.refuse(problem, "at least 2 are needed, from 1 nm on");
            return None;
        }
        if let Some((_, error)) = first_gap(cx, &self.file.written, &leaf.nm) {
            cx.error(at, error);
            return None;
        }
        require_coverage(cx, at, "the file", [*first, *last]).then_some(())?;
        let table = |values: &[f64]| {
            // Rounding may leave the range.
            let values = values.iter().map(|value| value.clamp(0.0, 1.0));
            Spectrum::Table {
                points: leaf.nm.iter().copied().zip(values).collect(),
                extrapolate: cx.extrapolate.get(),
            }
        };
        Some(Measured {
            reflectance: table(&leaf.reflectance),
            abaxial: (!leaf.abaxial.is_empty()).then(|| table(&leaf.abaxial)),
            transmittance: table(&leaf.transmittance),
        })
    }
}

/// Reports R + T > 1. The sum is linear between the rows of both tables, so it is greatest at one
/// of them.
fn require_energy(keys: &Keys<'_>, reflectance: &Spectrum, transmittance: &Spectrum) {
    // Sums of decimals may round to slightly above 1.
    const ROUNDING: f64 = 1e-9;
    let mut wavelengths: Vec<f64> = vec![550.0];
    for spectrum in [reflectance, transmittance] {
        if let Spectrum::Table { points, .. } = spectrum {
            wavelengths.extend(points.iter().map(|(nm, _)| *nm));
        }
    }
    let mut greatest = (0.0, 0.0);
    for nm in wavelengths {
        let sum = share_at(reflectance, nm) + share_at(transmittance, nm);
        if sum > greatest.1 {
            greatest = (nm, sum);
        }
    }
    if greatest.1 > 1.0 + ROUNDING {
        let error = DocumentError::EnergyNotConserved {
            wavelength_nm: greatest.0,
            sum: greatest.1,
        };
        keys.report(&[], error);
    }
}

/// Value of a constant or table at a wavelength, with the end values outside.
fn share_at(spectrum: &Spectrum, nm: f64) -> f64 {
    match spectrum {
        Spectrum::Constant(value) => *value,
        Spectrum::Table { points, .. } => {
            let above = points.partition_point(|(other, _)| *other < nm);
            match (
                above.checked_sub(1).and_then(|below| points.get(below)),
                points.get(above),
            ) {
                (Some((x0, y0)), Some((x1, y1))) => y0 + (y1 - y0) * (nm - x0) / (x1 - x0),
                (Some((_, value)), None) | (None, Some((_, value))) => *value,
                (None, None) => 0.0,
            }
        }
        // These forms are not used for shares of light.
        Spectrum::D65 { .. } | Spectrum::Blackbody { .. } => 0.0,
    }
}
