//! Names of columns that hold something else than wavelengths, reflectances and transmittances, but
//! stand where those are wanted.

use leafmodel::document::rows::Field;

use super::columns::{Column, column, is_wavelength, measure, words};

/// Why the columns of a table of leaves cannot be read, if one holds something else than its name
/// is taken for.
pub(super) fn refuse(names: &[Field]) -> Result<(), String> {
    let has_wavelengths = names.iter().any(|name| is_wavelength(&name.text));
    for (i, name) in names.iter().enumerate() {
        let other = match column(&name.text).holds {
            Column::Of(..) => other_value(&name.text),
            Column::Wavelength(_) => other_axis(&name.text),
            Column::Name | Column::Quantity | Column::Band(..) | Column::Other => {
                let is_axis = i == 0 && !has_wavelengths;
                is_axis.then(|| other_axis(&name.text)).flatten()
            }
        };
        if let Some((what, help)) = other {
            return Err(format!("the column {} holds {what}: {help}", name.shown()));
        }
    }
    Ok(())
}

/// What a column of this name holds instead of wavelengths, and how those follow from it.
pub(super) fn other_axis(name: &str) -> Option<Other> {
    let lower = name.to_ascii_lowercase();
    let words = words(&lower);
    let says = |of: &[&str]| words.iter().any(|(_, word)| of.contains(word));
    let pair = |of: [&str; 2]| words.windows(2).any(|pair| [pair[0].1, pair[1].1] == of);
    let is_wavenumber = says(&["wavenumber", "wavenumbers", "kayser"])
        || [["wave", "number"], ["cm", "1"], ["cm", "¹"], ["1", "cm"]]
            .into_iter()
            .any(pair);
    if is_wavenumber {
        let help = "write wavelengths in nm, which are 10000000 divided by wavenumbers in 1/cm";
        Some(("wavenumbers", help))
    } else if says(&["frequency", "frequencies", "freq", "hz", "ghz", "thz"]) {
        let help = "write wavelengths in nm, which are 299792.458 divided by frequencies in THz";
        Some(("frequencies", help))
    } else if says(&["energy", "ev"]) {
        let help = "write wavelengths in nm, which are 1239.842 divided by energies in eV";
        Some(("photon energies", help))
    } else {
        None
    }
}

/// What a column of this name holds instead of reflectances or transmittances, and how those follow
/// from it.
pub(super) fn other_value(name: &str) -> Option<Other> {
    let lower = name.to_ascii_lowercase();
    let words = words(&lower);
    let is_log = |pair: &[(usize, &str)]| {
        ["log", "log10", "lg", "ln"].contains(&pair[0].1)
            && (pair[1].1 == "1" || measure(pair[1].1).is_some())
    };
    let is_other = words.windows(2).any(is_log)
        || words.iter().any(|(_, word)| *word == "absorbance")
        || lower.contains("1/");
    let help = "write reflectances, which are 10 to the power of −log10(1/R)";
    is_other.then_some(("absorbances", help))
}

/// What a column holds instead of what is wanted, and what to write.
pub(super) type Other = (&'static str, &'static str);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_wavenumbers_and_absorbances_are_not_taken_for_something_else() {
        for (name, what) in [
            ("frequency_THz", "frequencies"),
            ("wavenumber (cm-1)", "wavenumbers"),
            ("Wave number", "wavenumbers"),
            ("cm⁻¹", "wavenumbers"),
            ("E [eV]", "photon energies"),
        ] {
            assert_eq!(other_axis(name).map(|other| other.0), Some(what), "{name}");
        }
        for name in ["Wavelength (nm)", "um", "wave", "x"] {
            assert_eq!(other_axis(name), None, "{name}");
        }
        for name in ["log(1/R)", "1/R", "Absorbance", "LOG10 1/R"] {
            assert!(other_value(name).is_some(), "{name}");
        }
        for name in ["R", "birch_R", "Reflectance (%)", "oak.log.asd"] {
            assert_eq!(other_value(name), None, "{name}");
        }
    }
}
