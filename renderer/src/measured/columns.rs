//! What the columns of a table of leaves hold, by their names.

use csv::StringRecord;

/// What was measured of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    /// Reflectance of the adaxial face.
    Reflectance,
    /// Reflectance of the abaxial face.
    Abaxial,
    /// Transmittance.
    Transmittance,
}

/// What a column holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Column {
    /// Wavelengths.
    Wavelength,
    /// The name of each line's leaf.
    Name,
    /// A measure of the leaf of that name.
    Of(Measure, String),
    /// Something else, which is passed over.
    Other,
}

/// The columns of a line of names, or why they cannot be read.
pub(super) fn columns(names: &StringRecord) -> Result<Vec<Column>, String> {
    let columns: Vec<Column> = names.iter().map(column).collect();
    let count = |wanted: Column| columns.iter().filter(|column| **column == wanted).count();
    if count(Column::Wavelength) != 1 {
        return Err(format!(
            "one column must hold the wavelengths, named wavelength_nm, nm or um; it has {}",
            names.iter().take(8).collect::<Vec<_>>().join(", ")
        ));
    }
    if count(Column::Name) > 1 {
        return Err("only one column may name the leaf of each line".to_owned());
    }
    let has_value = |column: &Column| matches!(column, Column::Of(..));
    if !columns.iter().any(has_value) {
        return Err("no column is named R, T, reflectance or transmittance, or ends so".to_owned());
    }
    for (i, column) in columns.iter().enumerate() {
        if has_value(column) && columns[..i].contains(column) {
            return Err(format!("the column {} is there twice", &names[i]));
        }
    }
    Ok(columns)
}

/// What a column's name says of it.
fn column(name: &str) -> Column {
    // Only ASCII changes its case, so that places in both are the same.
    let lower = name.to_ascii_lowercase();
    let words = words(&lower);
    let says = |of: &[&str]| words.iter().any(|(_, word)| of.contains(word));
    if says(&["wavelength", "wavelengths", "wl", "lambda"])
        || matches!(words[..], [(_, "nm" | "um" | "µm")])
    {
        return Column::Wavelength;
    }
    if matches!(words[..], [(_, "leaf" | "case" | "sample" | "name" | "id")]) {
        return Column::Name;
    }
    let is_unit = |word: &str| ["percent", "pct"].contains(&word);
    // Faces stand behind or before what was measured: `R_abaxial`, `abaxial R`.
    let is_upper = |word: &str| ["adaxial", "upper"].contains(&word);
    let is_lower = |word: &str| ["abaxial", "lower"].contains(&word);
    let mut is_abaxial = false;
    let mut rest = words.as_slice();
    let mut measure = None;
    let mut place = name.len();
    while let [before @ .., (at, word)] = rest {
        let is_measure = match *word {
            "r" | "refl" | "reflectance" if measure.is_none() => {
                measure = Some(Measure::Reflectance);
                true
            }
            "t" | "trans" | "transmittance" if measure.is_none() => {
                measure = Some(Measure::Transmittance);
                true
            }
            _ => false,
        };
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
fn words(name: &str) -> Vec<(usize, &str)> {
    let parts = name.split(|c: char| !c.is_alphanumeric() && c != 'µ');
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
        ] {
            assert_eq!(column(name), Column::Of(measure, leaf.to_owned()), "{name}");
        }
        assert_eq!(column("T_abaxial"), Column::Other);
        assert_eq!(column("remark"), Column::Other);
        assert_eq!(column("abaxial"), Column::Other);
        assert_eq!(column("Wavelength (nm)"), Column::Wavelength);
        assert_eq!(column("leaf"), Column::Name);
    }
}
