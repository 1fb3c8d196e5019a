//! `sensitivities` of `[film.rgb]`: the CIE's observer, a camera by name, or one in a file.

use std::sync::Arc;

use super::named::Tabled;
use crate::measured::responses;
use crate::scene::blocks::table_file::TableFile;
use crate::spectrum::observer::{CHANNELS, Camera, NotACamera, Observer};

/// Least share of a channel's response that a film should record.
pub(super) const LEAST_SHARE: f64 = 0.95;

/// Share of a channel's greatest sensitivity that may be left where a table ends.
pub(super) const MOST_AT_END: f64 = 0.05;

/// Sensitivities of a film that records these wavelengths, nm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sensitivities {
    pub(super) range_nm: [f64; 2],
}

impl Tabled for Sensitivities {
    type Of = Observer;

    const WANTED: &str = "the name of a camera or \"cie-1931\", or `{ file = \"….csv\" }`";
    const ABOUT_FILE: &str =
        "A table of wavelength in nm and the sensitivities of red, green and blue.";

    fn names() -> impl Iterator<Item = &'static str> {
        Observer::names()
    }

    fn by_name(name: &str) -> Option<Observer> {
        Observer::by_name(name)
    }

    fn name(value: &Observer) -> &str {
        value.name()
    }

    fn of_file(self, file: &TableFile<'_>, path: &str) -> Option<Observer> {
        let rows = file.sound(responses::sensitivities(&file.text))?;
        match Camera::new(path, rows) {
            Ok(camera) => {
                self.check(&camera, file)?;
                Some(Observer::Camera(Arc::new(camera)))
            }
            Err(problem) => {
                let help = match problem {
                    NotACamera::Blind(_) => "give each channel a sensitivity above 0 somewhere",
                    NotACamera::Dependent => "give the three channels different sensitivities",
                    NotACamera::Disordered | NotACamera::Negative => "mend the table",
                };
                file.refuse(problem.to_string(), help);
                None
            }
        }
    }
}

impl Sensitivities {
    /// Refuses a camera with a channel that sees nothing on the film, and warns of what is left out.
    fn check(self, camera: &Camera, file: &TableFile<'_>) -> Option<()> {
        const HELP: &str = "widen `range_nm` of the film to what the camera sees";
        let [low, high] = self.range_nm;
        let shares = camera.share_within(self.range_nm);
        let rows = camera.rows();
        for (i, channel) in CHANNELS.into_iter().enumerate() {
            if shares[i] <= 0.0 {
                let problem = format!(
                    "has a channel `{channel}` that sees nothing from {low} to {high} nm, which the film \
                     records"
                );
                file.refuse(problem, HELP);
                return None;
            }
            if shares[i] < LEAST_SHARE {
                let percent = 100.0 * (1.0 - shares[i]);
                let message = format!(
                    "the film leaves out {percent:.0} % of what the channel `{channel}` sees"
                );
                file.warn("scene::range", &message, HELP);
            }
            let most = rows.iter().fold(0.0_f64, |most, row| most.max(row.1[i]));
            for (nm, values) in [&rows[0], &rows[rows.len() - 1]] {
                if values[i] > MOST_AT_END * most && *nm > low && *nm < high {
                    let share = 100.0 * values[i] / most;
                    let message = format!(
                        "the channel `{channel}` ends at {nm} nm with {share:.0} % of its greatest \
                         sensitivity, and counts as 0 beyond"
                    );
                    let help = "continue the table to where the camera sees nothing";
                    file.warn("scene::range", &message, help);
                }
            }
        }
        Some(())
    }
}
