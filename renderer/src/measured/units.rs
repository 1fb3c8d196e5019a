//! Units of measured spectra, guessed where a file does not say them, and gaps.

use leafmodel::document::rows::{Field, Guess};
use leafmodel::document::source::quoted;

use super::columns::listed;
use super::known::WavelengthUnit;

/// Wavelengths below this are micrometres: 0.4 to 2.5 against 400 to 2500.
const MOST_UM: f64 = 30.0;
/// Where the upper quarter of all values is above this they are percent.
const MOST_SHARE: f64 = 1.5;
/// The greatest fraction, with the noise of measurements.
const MOST_FRACTION: f64 = 1.05;
/// A step this many times as long as its neighbours is a gap that no spectrum of a scene may have.
pub const WIDE_GAP: f64 = 10.0;
/// A step this many times as long as its neighbours is a gap that is reported.
pub const GAP: f64 = 2.5;

/// Something that a person should know, and that no flag changes.
pub(super) fn note(what: impl Into<String>) -> Guess {
    let (what, otherwise) = (what.into(), None);
    Guess { what, otherwise }
}

/// Something that was guessed, and the flag with its value that says otherwise.
pub(super) fn guess(what: impl Into<String>, flag: &'static str, value: &'static str) -> Guess {
    let otherwise = Some((flag, value));
    Guess {
        otherwise,
        ..note(what)
    }
}

/// The columns that are passed over.
pub(super) fn ignored<'f>(names: impl Iterator<Item = &'f Field> + Clone) -> Option<Guess> {
    let names = names.filter(|name| !name.text.is_empty());
    names.clone().next()?;
    Some(note(format!(
        "columns that are not read: {}",
        listed(names)
    )))
}

/// Whether wavelengths are micrometres: as a person says, as the file says, or by their sizes, with a
/// note.
pub(super) fn in_micrometres(
    known: Option<WavelengthUnit>,
    says_so: bool,
    wavelengths: impl Iterator<Item = f64>,
    notes: &mut Vec<Guess>,
) -> bool {
    if let Some(unit) = known {
        return unit == WavelengthUnit::Micrometres;
    }
    let is_guess = !says_so && are_micrometres(wavelengths);
    notes.extend(is_guess.then(|| guess("wavelengths are taken for µm", "wavelengths", "nm")));
    says_so || is_guess
}

/// What is said where values are taken for percent.
pub(super) fn percent() -> Guess {
    guess("values are taken for percent", "values", "fraction")
}

/// Whether wavelengths must be micrometres.
pub fn are_micrometres(wavelengths: impl Iterator<Item = f64>) -> bool {
    let mut wavelengths = wavelengths.peekable();
    wavelengths.peek().is_some() && wavelengths.all(|wavelength| wavelength < MOST_UM)
}

/// Whether shares must be percent. One value that is wrong does not make them so: a quarter of all
/// are that large.
pub fn are_percent(values: impl Iterator<Item = f64>) -> bool {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let upper = values.get(values.len() * 3 / 4);
    upper.is_some_and(|value| *value > MOST_SHARE)
}

/// The greatest of some values, rounded for a message.
pub(super) fn greatest(values: &[f64]) -> f64 {
    let greatest = values.iter().copied().fold(0.0, f64::max);
    (1e4 * greatest).round() / 1e4
}

/// The greatest of values that can only be fractions; `None` of values that may be percent, and of
/// zeros, which are both.
pub(super) fn greatest_fraction(values: &[f64]) -> Option<f64> {
    let greatest = greatest(values);
    (greatest > 0.0 && greatest <= MOST_FRACTION).then_some(greatest)
}

/// What is said where a column's name says percent and its values are fractions.
pub(super) fn contradiction(name: &str, values: &[f64]) -> Option<Guess> {
    let greatest = greatest_fraction(values)?;
    let what = format!(
        "the column {} says percent, but its values are at most {greatest}; they are divided by 100",
        quoted(name)
    );
    Some(guess(what, "values", "fraction"))
}

/// What to do about a wavelength behind a greater one if it may be a thousand that was written as
/// `1,000`; the notes say whether commas were read as decimal marks.
pub(super) fn falling(before: f64, after: f64, notes: &[Guess]) -> Option<&'static str> {
    let has_commas = notes
        .iter()
        .any(|note| matches!(note.otherwise, Some(("decimal", _))));
    let is_thousand = has_commas && (before..2.0 * before).contains(&(1000.0 * after));
    is_thousand.then_some(
        "a comma within a number is read as its decimal mark, so write 1000 instead of `1,000`",
    )
}

/// Gaps in wavelengths that rise: the numbers of the wavelengths behind steps that are more than so
/// many times as long as most of the three steps before and of the three behind. Tables that grow
/// coarser, or whose steps are all long, have none.
pub fn gaps(nm: &[f64], times: f64) -> impl Iterator<Item = usize> {
    let step = |i: usize| nm[i] - nm[i - 1];
    let median = move |steps: std::ops::Range<usize>| {
        let mut steps: Vec<f64> = steps.map(step).collect();
        steps.sort_by(f64::total_cmp);
        steps.get(steps.len() / 2).copied()
    };
    (1..nm.len()).filter(move |&i| {
        let before = median(i.saturating_sub(3).max(1)..i);
        let behind = median(i + 1..(i + 4).min(nm.len()));
        let is_long = |other: Option<f64>| other.is_some_and(|other| step(i) > times * other);
        is_long(before) && is_long(behind)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_that_was_cut_out_is_a_gap_and_a_table_that_grows_coarser_has_none() {
        let cut: Vec<f64> = (400..=2500)
            .filter(|nm| !(1350..1450).contains(nm))
            .map(f64::from)
            .collect();
        let ends = |nm: &[f64], times: f64| -> Vec<[f64; 2]> {
            gaps(nm, times).map(|at| [nm[at - 1], nm[at]]).collect()
        };
        assert_eq!(ends(&cut, WIDE_GAP), [[1349.0, 1450.0]]);
        let coarser = [400.0, 410.0, 420.0, 500.0, 700.0, 1200.0, 2500.0];
        for times in [GAP, WIDE_GAP] {
            for none in [&coarser[..], &[400.0, 401.0, 2500.0], &[400.0], &[]] {
                assert_eq!(ends(none, times), [[0.0; 2]; 0], "{none:?}");
            }
        }
        // All of several, one with a single wavelength between two, one at the first step but one.
        let cut: Vec<f64> = (400..=2500)
            .filter(|nm| {
                ![401..410, 1350..1400, 1401..1450, 1800..1803]
                    .iter()
                    .any(|cut| cut.contains(nm))
            })
            .map(f64::from)
            .collect();
        let narrow = [1799.0, 1803.0];
        let wide = [[1349.0, 1400.0], [1400.0, 1450.0]];
        assert_eq!(ends(&cut, WIDE_GAP), wide);
        assert_eq!(ends(&cut, GAP), [wide[0], wide[1], narrow]);
    }

    #[test]
    fn most_of_the_values_determine_the_units() {
        assert!(are_micrometres([0.4, 2.5].into_iter()));
        assert!(!are_micrometres([0.4, 400.0].into_iter()));
        assert!(!are_micrometres(std::iter::empty()));
        assert!(are_percent([2.0, 5.0, 50.0, 45.0].into_iter()));
        assert!(!are_percent([0.1, 0.2, 0.3, 0.2, 50.0].into_iter()));
        assert!(!are_percent(std::iter::empty()));
    }
}
