//! What the columns of a table of leaves hold, by their names.

use leafmodel::document::rows::Field;

use super::known::{Measure, WavelengthUnit};

/// Wavelengths that names of columns may give, nm.
const BANDS_NM: std::ops::RangeInclusive<f64> = 200.0..=30_000.0;
/// The same in µm.
const BANDS_UM: std::ops::Range<f64> = 0.2..30.0;
/// Fewest wavelengths as names of columns that make a table of a leaf in each row.
const LEAST_BANDS: usize = 3;

/// What a word of a name says, in lower case.
pub(super) fn measure(word: &str) -> Option<Measure> {
    match word {
        "r" | "rho" | "refl" | "reflect" | "reflectance" | "reflectances" | "reflectivity"
        | "rfl" => Some(Measure::Reflectance),
        "t" | "tau" | "tran" | "trans" | "transm" | "transmit" | "transmittance"
        | "transmittances" | "transmission" | "transmissivity" => Some(Measure::Transmittance),
        _ => None,
    }
}

/// What a cell says, such as `abaxial reflectance`.
pub(super) fn measure_of_cell(text: &str) -> Option<Measure> {
    match column(text).holds {
        Column::Of(measure, _) => Some(measure),
        Column::Wavelength(_)
        | Column::Name
        | Column::Quantity
        | Column::Band(..)
        | Column::Other => None,
    }
}

/// What a column holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Column {
    /// Wavelengths, in the unit that the name says.
    Wavelength(Option<WavelengthUnit>),
    /// The name of each line's leaf.
    Name,
    /// What each line's values are.
    Quantity,
    /// A measure of the leaf of that name.
    Of(Measure, String),
    /// Values at a wavelength, nm or µm, of the leaf of the line.
    Band(Option<Measure>, f64),
    /// Something else, which is passed over.
    Other,
}

/// A column with its unit.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Named {
    pub(super) holds: Column,
    /// Whether its name says that values are percent.
    pub(super) is_percent: bool,
}

/// The columns of a line of names, or why they cannot be read.
pub(super) fn columns(names: &[Field], whole: Option<Measure>) -> Result<Vec<Named>, String> {
    if let Some(bands) = bands(names) {
        return Ok(bands);
    }
    let mut columns: Vec<Named> = names.iter().map(|name| column(&name.text)).collect();
    let is_wavelength = |column: &&Named| matches!(column.holds, Column::Wavelength(_));
    if columns.iter().filter(is_wavelength).count() != 1 {
        return Err(format!(
            "one column must hold the wavelengths, named wavelength_nm, nm or um, or columns must be \
             named by their wavelengths; it has {}",
            listed(names.iter())
        ));
    }
    let count = |wanted: Column| columns.iter().filter(|own| own.holds == wanted).count();
    if count(Column::Name) > 1 {
        return Err("only one column may name the leaf of each line".to_owned());
    }
    let has_value = |column: &Named| matches!(column.holds, Column::Of(..));
    if !columns.iter().any(has_value) {
        let Some(measure) = whole else {
            return Err(format!(
                "no column is named R, T, reflectance or transmittance, or ends so; if the others are \
                 leaves, --quantity reflectance says what was measured of them; it has {}",
                listed(names.iter())
            ));
        };
        for (column, name) in columns.iter_mut().zip(names) {
            if column.holds == Column::Other && !name.text.is_empty() {
                column.holds = Column::Of(measure, name.text.clone());
            }
        }
    }
    for (i, column) in columns.iter().enumerate() {
        let is_same = |other: &Named| other.holds == column.holds;
        if has_value(column) && columns[..i].iter().any(is_same) {
            return Err(format!("the column {} is there twice", names[i].shown()));
        }
    }
    Ok(columns)
}

/// Names as messages list them.
pub(super) fn listed<'f>(names: impl Iterator<Item = &'f Field> + Clone) -> String {
    const MOST: usize = 8;
    let count = names.clone().count();
    let mut shown: Vec<String> = names.take(MOST).map(Field::shown).collect();
    if count > MOST {
        shown.push(format!("{} more", count - MOST));
    }
    shown.join(", ")
}

/// The columns of a table with a leaf in each row, if some are named by wavelengths of one unit.
fn bands(names: &[Field]) -> Option<Vec<Named>> {
    let numbers: Vec<Option<(Option<Measure>, f64)>> =
        names.iter().map(|name| band(&name.text)).collect();
    let nm: Vec<f64> = numbers.iter().flatten().map(|band| band.1).collect();
    let is_um = nm.iter().all(|nm| BANDS_UM.contains(nm));
    let is_range = is_um || nm.iter().all(|nm| BANDS_NM.contains(nm));
    // Numbers of samples look like wavelengths, unless a column holds those.
    if nm.len() < LEAST_BANDS || !is_range || names.iter().any(|name| is_plain(&name.text)) {
        return None;
    }
    let mut has_name = false;
    let columns = names.iter().zip(numbers).map(|(name, number)| {
        let own = column(&name.text);
        let holds = match (number, own.holds) {
            (Some((measure, nm)), _) => Column::Band(measure, nm),
            (None, Column::Name) if !has_name => {
                has_name = true;
                Column::Name
            }
            (None, Column::Quantity) => Column::Quantity,
            (None, _) => Column::Other,
        };
        let is_percent = own.is_percent;
        Named { holds, is_percent }
    });
    Some(columns.collect())
}

/// The wavelength that a column's name is, as in `450`, `X450`, `R_450.5` or `450 nm`, and what was
/// measured at it.
fn band(name: &str) -> Option<(Option<Measure>, f64)> {
    let lower = name.trim().to_ascii_lowercase();
    let number = lower.find(|c: char| c.is_ascii_digit())?;
    let (before, rest) = lower.split_at(number);
    let before = before.trim_end_matches(|c: char| !c.is_alphanumeric());
    let end = rest
        .find(|c: char| !c.is_ascii_digit() && c != '.')
        .unwrap_or(rest.len());
    let unit = rest[end..].trim_matches(|c: char| !c.is_alphanumeric());
    let is_known =
        before.is_empty() || is_of("x v w b nm wl wvl wave wavelength band lambda", before);
    let measured = measure(before);
    let is_unit = ["", "nm", "um", "µm", "μm"].contains(&unit);
    let is_band = is_unit && (is_known || measured.is_some());
    let nm: f64 = rest[..end].parse().ok()?;
    is_band.then_some((measured, nm))
}

/// What a column's name says of it.
pub(super) fn column(name: &str) -> Named {
    // Only ASCII changes its case, so that places in both are the same.
    let lower = name.to_ascii_lowercase();
    let words = words(&lower);
    let is_percent = lower.contains('%') || words.iter().any(|(_, word)| PERCENT.contains(word));
    let says = |of: &str| words.iter().any(|(_, word)| is_of(of, word));
    let unit = if says(MICROMETRES) {
        Some(WavelengthUnit::Micrometres)
    } else {
        says(NANOMETRES).then_some(WavelengthUnit::Nanometres)
    };
    let is_unit = words.len() == 1 && unit.is_some();
    let holds = if says(WAVELENGTHS) || is_unit {
        Column::Wavelength(unit)
    } else if matches!(
        words[..],
        [(_, "leaf" | "case" | "sample" | "name" | "id" | "spectrum")]
            | [(_, "leaf" | "sample" | "spectrum"), (_, "id" | "name")]
    ) {
        Column::Name
    } else if matches!(words[..], [(_, "measurement" | "quantity" | "measure")])
        || matches!(words[..], [(_, "measurement"), (_, "type")])
    {
        Column::Quantity
    } else {
        measured(name, &words)
    };
    Named { holds, is_percent }
}

/// Whether a name says wavelengths, perhaps with a unit, and nothing else.
fn is_plain(name: &str) -> bool {
    let lower = name.to_lowercase();
    let lists = [WAVELENGTHS, NANOMETRES, MICROMETRES];
    let known = |word: &str| lists.iter().any(|list| is_of(list, word));
    let words = words(&lower);
    !words.is_empty() && words.iter().all(|(_, word)| known(word))
}

/// Whether a column of this name holds wavelengths.
pub(super) fn is_wavelength(name: &str) -> bool {
    matches!(column(name).holds, Column::Wavelength(_))
}

/// Words of wavelengths.
const WAVELENGTHS: &str = "wavelength wavelengths wavelen wl wls wvl wave waves lambda λ";
/// Words of units.
const NANOMETRES: &str = "nm nanometer nanometers nanometre nanometres";
const MICROMETRES: &str = "um µm μm micron microns micrometer micrometers micrometres";

/// Whether a word is one of a list.
fn is_of(list: &str, word: &str) -> bool {
    list.split(' ').any(|known| known == word)
}

const PERCENT: [&str; 2] = ["percent", "pct"];

/// What a column of values holds.
fn measured(name: &str, words: &[(usize, &str)]) -> Column {
    let is_unit = |word: &str| PERCENT.contains(&word);
    // Faces stand behind or before what was measured: `R_abaxial`, `abaxial R`.
    let is_upper = |word: &str| ["adaxial", "upper"].contains(&word);
    let is_lower = |word: &str| ["abaxial", "lower"].contains(&word);
    let mut is_abaxial = false;
    let mut rest = words;
    let mut measure = None;
    let mut place = name.len();
    while let [before @ .., (at, word)] = rest {
        let own = self::measure(word).filter(|_| measure.is_none());
        let is_measure = own.is_some();
        measure = measure.or(own);
        if is_lower(word) {
            is_abaxial = true;
        } else if !(is_measure || is_upper(word) || (measure.is_none() && is_unit(word))) {
            break;
        }
        place = *at;
        rest = before;
    }
    // A leaf has one transmittance; which face is lit does not matter to it.
    let measure = match measure {
        Some(Measure::Reflectance) if is_abaxial => Measure::Abaxial,
        Some(Measure::Transmittance) if is_abaxial => return Column::Other,
        Some(measure) => measure,
        None => return Column::Other,
    };
    // The leaf's name is what stands before, as written.
    let leaf = name[..place].trim_end_matches(|c: char| !c.is_alphanumeric());
    Column::Of(measure, leaf.to_owned())
}

/// The words of a name, each with its place.
pub(super) fn words(name: &str) -> Vec<(usize, &str)> {
    let parts = name.split(|c: char| !c.is_alphanumeric());
    // Each part lies within the name.
    let placed = parts.map(|part| (part.as_ptr().addr() - name.as_ptr().addr(), part));
    placed.filter(|(_, part)| !part.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_leaf_measure_and_face_in_any_order() {
        use Measure::{Abaxial, Reflectance, Transmittance};
        for (name, measure, leaf) in [
            ("R", Reflectance, ""),
            ("birch_R", Reflectance, "birch"),
            ("birch_R_adaxial", Reflectance, "birch"),
            ("birch_R_abaxial", Abaxial, "birch"),
            ("abaxial reflectance (percent)", Abaxial, ""),
            ("leaf 3 lower R", Abaxial, "leaf 3"),
            ("T", Transmittance, ""),
            ("Béla.T [pct]", Transmittance, "Béla"),
            ("refl", Reflectance, ""),
            ("tran", Transmittance, ""),
            ("oak transmission (%)", Transmittance, "oak"),
        ] {
            let found = column(name);
            assert_eq!(found.holds, Column::Of(measure, leaf.to_owned()), "{name}");
            let says = ["percent", "pct", "%"]
                .iter()
                .any(|word| name.contains(word));
            assert_eq!(found.is_percent, says, "{name}");
        }
        for name in ["T_abaxial", "remark", "abaxial", "reference", "radiance"] {
            assert_eq!(column(name).holds, Column::Other, "{name}");
        }
        assert_eq!(column("leaf").holds, Column::Name);
    }

    #[test]
    fn words_of_instruments_name_wavelengths_with_their_units() {
        let nm = Some(WavelengthUnit::Nanometres);
        let um = Some(WavelengthUnit::Micrometres);
        for (name, unit) in [
            ("Wavelength (nm)", nm),
            ("wl", None),
            ("Wvl", None),
            ("Wave", None),
            ("WAVELENGTH_um", um),
            ("Wavelength [μm]", um),
            ("µm", um),
            ("nm", nm),
            ("λ (nm)", nm),
        ] {
            assert_eq!(column(name).holds, Column::Wavelength(unit), "{name}");
        }
    }

    #[test]
    fn columns_may_be_named_by_wavelengths_in_several_ways() {
        for (name, measure, nm) in [
            ("450", None, 450.0),
            ("X450.5", None, 450.5),
            ("R_450", Some(Measure::Reflectance), 450.0),
            ("tran 2500nm", Some(Measure::Transmittance), 2500.0),
            ("Wave_0.45", None, 0.45),
        ] {
            assert_eq!(band(name), Some((measure, nm)), "{name}");
        }
        for name in ["", "leaf 450", "450 x", "1.2.3", "R"] {
            assert_eq!(band(name), None, "{name}");
        }
    }
}
