//! Units of measured spectra, guessed where a file does not say them, and gaps.

/// Wavelengths below this are micrometres: 0.4 to 2.5 against 400 to 2500.
const MOST_UM: f64 = 30.0;
/// Where the upper quarter of all values is above this they are percent.
const MOST_SHARE: f64 = 1.5;
/// A step this many times as long as both of its neighbours is a gap.
const GAP: f64 = 10.0;

/// What is told where wavelengths are taken for micrometres.
pub const MICROMETRES: &str = "wavelengths are taken for µm";
/// What is told where values are taken for percent.
pub const PERCENT: &str = "values are taken for percent";

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

/// A gap in wavelengths that rise: the number of the wavelength behind a step that is more than ten
/// times as long as the step before and as the step behind it. Tables that grow coarser, or whose
/// steps are all long, have none.
pub fn gap(nm: &[f64]) -> Option<usize> {
    let step = |i: usize| nm[i] - nm[i - 1];
    (2..nm.len().saturating_sub(1))
        .find(|&i| step(i) > GAP * step(i - 1) && step(i) > GAP * step(i + 1))
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
        let at = gap(&cut).expect("100 nm are missing");
        assert_eq!([cut[at - 1], cut[at]], [1349.0, 1450.0]);
        let coarser = [400.0, 410.0, 420.0, 500.0, 700.0, 1200.0, 2500.0];
        assert_eq!(gap(&coarser), None);
        assert_eq!(gap(&[400.0, 401.0, 2500.0]), None);
        assert_eq!(gap(&[400.0]), None);
    }

    #[test]
    fn units_are_told_by_most_of_the_values() {
        assert!(are_micrometres([0.4, 2.5].into_iter()));
        assert!(!are_micrometres([0.4, 400.0].into_iter()));
        assert!(!are_micrometres(std::iter::empty()));
        assert!(are_percent([2.0, 5.0, 50.0, 45.0].into_iter()));
        assert!(!are_percent([0.1, 0.2, 0.3, 0.2, 50.0].into_iter()));
        assert!(!are_percent(std::iter::empty()));
    }
}
