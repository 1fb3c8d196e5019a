//! The wavelengths at which an instrument measures.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::number_lists::Rising;
use leafmodel::document::value_kind::Number;

use crate::scene::description::film::{Range, WAVELENGTHS_NM};

/// Most wavelengths of an instrument: more than one for each nanometre from 400 to 2500.
pub(super) const MOST_WAVELENGTHS: usize = 4096;
const USUAL_RANGE_NM: [f64; 2] = [400.0, 2500.0];
const USUAL_STEP_NM: f64 = 10.0;

/// The wavelengths of an instrument of which nothing is said.
pub(super) fn usual() -> Vec<f64> {
    every(USUAL_RANGE_NM, USUAL_STEP_NM)
}

/// `wavelengths_nm`, or `range_nm` and `step_nm`, and the keys of `bands`, which says whether there are any:
/// whoever asks for bands alone gets bands alone.
pub(super) fn declare(
    wavelengths_nm: &mut Vec<f64>,
    keys: &mut Keys<'_>,
    bands: impl FnOnce(&mut Keys<'_>) -> bool,
) {
    let mut range = USUAL_RANGE_NM;
    let about = "First and last wavelength.";
    keys.key("range_nm", &mut range, Range, about);
    let mut step = USUAL_STEP_NM;
    let limits = Number(Limits::closed(0.1, 1000.0));
    let about = "From one wavelength to the next.";
    keys.key("step_nm", &mut step, limits, about);
    let mut listed = None;
    let kind = Rising {
        limits: WAVELENGTHS_NM,
        most: MOST_WAVELENGTHS,
        wanted: "a list of 1 to 4096 wavelengths, rising",
    };
    let about = "The wavelengths one by one, instead of the two keys above.";
    keys.optional("wavelengths_nm", &mut listed, kind, about);
    keys.exclude("wavelengths_nm", "range_nm");
    keys.exclude("wavelengths_nm", "step_nm");
    let count = (range[1] - range[0]) / step;
    if count >= MOST_WAVELENGTHS as f64 {
        let problem = format!("gives more than {MOST_WAVELENGTHS} wavelengths");
        keys.refuse(
            &["step_nm"],
            problem,
            "use longer steps or a narrower range",
        );
        return;
    }
    let has_bands = bands(keys);
    let is_asked = keys.reader().is_none_or(|block| {
        let ranged = ["range_nm", "step_nm"];
        ranged.iter().any(|key| block.table.get(key).is_some())
    });
    *wavelengths_nm = listed.unwrap_or_else(|| {
        if is_asked || !has_bands {
            every(range, step)
        } else {
            Vec::new()
        }
    });
}

/// Wavelengths from the first to the last at equal steps, nm.
pub(super) fn every([first, last]: [f64; 2], step: f64) -> Vec<f64> {
    // A range that is a whole number of steps keeps its end despite rounding.
    let steps = ((last - first) / step + 1e-9).floor() as u32;
    (0..=steps)
        .map(|i| (first + step * f64::from(i)).min(last))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_of_wavelengths_has_both_ends_where_steps_fit_and_never_more() {
        assert_eq!(every([400.0, 2500.0], 10.0).len(), 211);
        assert_eq!(every([400.0, 2500.0], 10.0)[210], 2500.0);
        assert_eq!(every([400.0, 401.0], 0.1).len(), 11);
        assert_eq!(every([400.0, 405.0], 2.0), [400.0, 402.0, 404.0]);
        assert_eq!(every([400.0, 405.0], 50.0), [400.0]);
    }
}
