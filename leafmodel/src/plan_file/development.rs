//! How to mend a development that gives no leaf.

use crate::development::DevelopmentError;
use crate::document::keys::Keys;

/// Reports a development that each of its numbers allows and that gives no leaf all the same;
/// `keys` are the leaf's.
pub(super) fn report(keys: &Keys<'_>, error: &DevelopmentError) {
    let block = ["outline", "development"];
    let of_wave = |wave: &usize, key: &'static str, help: &str| {
        let number = wave.to_string();
        let path = ["outline", "development", "waves", &number, key];
        let list = &path[..3];
        let there = if keys.has_path(&path) { &path } else { list };
        keys.refuse(there, error.to_string(), help);
    };
    match error {
        DevelopmentError::NoTime { wave, .. } => {
            of_wave(wave, "until", "let the wave end at a larger length");
        }
        DevelopmentError::TooLate { wave, .. } => {
            of_wave(
                wave,
                "from",
                "let the wave start earlier, or the leaf grow longer",
            );
        }
        DevelopmentError::NoZone { wave, .. } => {
            of_wave(wave, "zone", "give the lower end first");
        }
        DevelopmentError::TooManyVeins { wave, .. } => {
            of_wave(
                wave,
                "spacing",
                "use a larger spacing, or end the wave earlier",
            );
        }
        DevelopmentError::TooLongMargin { .. } => {
            let help = "use larger spacings, a lower resolution, or rates nearer to 1";
            let path = [block[0], block[1], "waves"];
            keys.refuse(&path, error.to_string(), help);
        }
        DevelopmentError::Margin(_) | DevelopmentError::BareVein => {
            let help = "use less splay, rates that differ less, or less hold";
            let path = [block[0], block[1], "waves"];
            keys.refuse(&path, error.to_string(), help);
        }
        DevelopmentError::Range(_) => {
            keys.refuse(&block, error.to_string(), "use a value within the range");
        }
    }
}
