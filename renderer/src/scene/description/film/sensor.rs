//! `sensor` of `[film.spectral]`: a sensor by name, or one in a file.

use std::sync::Arc;

use leafmodel::document::limits::Limits;

use super::named::Tabled;
use super::sensitivities::MOST_AT_END;
use crate::measured::responses;
use crate::scene::blocks::table_file::TableFile;
use crate::spectrum::recorded::MOST_BANDS;
use crate::spectrum::sensor::{Response, Sensor};

/// The sensor of a film, whose bands lie within a range of wavelengths, nm.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfFilm(pub(super) Limits);

impl Tabled for OfFilm {
    type Of = Arc<Sensor>;

    const WANTED: &str = "the name of a sensor, or `{ file = \"….csv\" }`";
    const ABOUT_FILE: &str = "A table of wavelength in nm and the responses of the bands.";

    fn names() -> impl Iterator<Item = &'static str> {
        Sensor::shipped().map(|(name, _)| name)
    }

    fn by_name(name: &str) -> Option<Arc<Sensor>> {
        Sensor::by_name(name).map(Arc::new)
    }

    fn name(value: &Arc<Sensor>) -> &str {
        value.name()
    }

    fn of_file(self, file: &TableFile<'_>, path: &str) -> Option<Arc<Sensor>> {
        let responses = file.sound(responses::responses(&file.text, MOST_BANDS))?;
        let sensor = match Sensor::new(path, responses) {
            Ok(sensor) => sensor,
            Err(problem) => {
                let help =
                    "give each band a response above 0 somewhere, and bands different responses";
                file.refuse(problem.to_string(), help);
                return None;
            }
        };
        let beyond = |band: &&Response| !band.range_nm().iter().all(|nm| self.0.contain(*nm));
        if let Some(band) = sensor.bands().iter().find(beyond) {
            let [low, high] = band.range_nm();
            let name = band.name();
            let problem = format!(
                "has a band `{name}` that responds from {low} to {high} nm, beyond 360 to 2500 nm"
            );
            let help = "leave out the band, or set responses to 0 there if they hardly matter";
            file.refuse(problem, help);
            return None;
        }
        for band in sensor.bands() {
            let rows = band.rows();
            let most = rows.iter().fold(0.0_f64, |most, row| most.max(row.1));
            for (nm, value) in [rows[0], rows[rows.len() - 1]] {
                // A table of two rows is a box, which is meant to end.
                if value > MOST_AT_END * most && rows.len() > 2 {
                    let share = 100.0 * value / most;
                    let message = format!(
                        "the band `{}` ends at {nm} nm with {share:.0} % of its greatest response, and \
                         counts as 0 beyond",
                        band.name()
                    );
                    let help = "continue the table to where the band sees nothing";
                    file.warn("scene::range", &message, help);
                }
            }
        }
        Some(Arc::new(sensor))
    }
}
