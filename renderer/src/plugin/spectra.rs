//! Spectra in Mitsuba's form.

use crate::plugin::element::Element;
use crate::spectrum::written::Spectrum;
use crate::spectrum::{cie, planck};

/// Range over which all spectra are written, nm; it contains every wavelength of a film. Mitsuba's
/// spectra are zero outside their points, whereas ours keep their end values.
pub(crate) const RANGE_NM: [f64; 2] = [300.0, 2600.0];

/// Greatest number of points of a spectrum that is written inline; longer ones get a separate file.
const MOST_INLINE: usize = 16;

/// Writes spectra, and collects those that go into files.
#[derive(Debug, Default)]
pub(crate) struct Spectra {
    /// Names in the folder `spectra`, and texts.
    pub(crate) files: Vec<(String, String)>,
}

impl Spectra {
    /// The parameter `<spectrum name=…>` of a spectrum times a factor.
    pub(crate) fn element(&mut self, name: &str, spectrum: &Spectrum, factor: f64) -> Element {
        let element = Element::new("spectrum").with("name", name);
        let points = points(spectrum, factor);
        // Mitsuba refuses tables that are zero everywhere.
        if points.iter().all(|point| point.1 == 0.0) {
            return element.with("value", 0);
        }
        if points.len() <= MOST_INLINE {
            let values = points.iter().map(|(nm, value)| format!("{nm}:{value}"));
            return element.with("value", values.collect::<Vec<_>>().join(", "));
        }
        let lines = points.iter().map(|(nm, value)| format!("{nm} {value}\n"));
        let text: String = lines.collect();
        let number = self
            .files
            .iter()
            .position(|file| file.1 == text)
            .unwrap_or_else(|| {
                let file = format!("spectrum-{}.spd", self.files.len());
                self.files.push((file, text));
                self.files.len() - 1
            });
        let file = &self.files[number].0;
        element.with("filename", format!("spectra/{file}"))
    }
}

/// The points between which a spectrum is linear, over the whole range.
fn points(spectrum: &Spectrum, factor: f64) -> Vec<(f64, f64)> {
    let [first, last] = RANGE_NM;
    let mut points: Vec<(f64, f64)> = match spectrum {
        Spectrum::Constant(value) => vec![(first, *value), (last, *value)],
        Spectrum::Table { points, .. } => points.clone(),
        Spectrum::D65 { scale } => (0..=530)
            .map(|i| 300.0 + f64::from(i))
            .map(|nm| (nm, scale * cie::d65(nm) / cie::d65(560.0)))
            .collect(),
        Spectrum::Blackbody { kelvin, scale } => {
            let reference = planck::radiance(560.0, *kelvin);
            (0..=2300)
                .map(|i| 300.0 + f64::from(i))
                .map(|nm| (nm, scale * planck::radiance(nm, *kelvin) / reference))
                .collect()
        }
    };
    if let Some(&(nm, value)) = points.first()
        && nm > first
    {
        points.insert(0, (first, value));
    }
    if let Some(&(nm, value)) = points.last()
        && nm < last
    {
        points.push((last, value));
    }
    for point in &mut points {
        point.1 *= factor;
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spectrum_covers_the_range_with_its_end_values() {
        let table = Spectrum::Table {
            points: vec![(400.0, 0.25), (700.0, 0.5)],
            extrapolate: true,
        };
        let expected = [(300.0, 0.5), (400.0, 0.5), (700.0, 1.0), (2600.0, 1.0)];
        assert_eq!(points(&table, 2.0), expected);
    }

    #[test]
    fn a_long_spectrum_becomes_one_file_however_often_it_is_used() {
        let mut spectra = Spectra::default();
        let sun = Spectrum::Blackbody {
            kelvin: 5800.0,
            scale: 1.0,
        };
        for _ in 0..2 {
            let element = spectra.element("radiance", &sun, 2.0);
            assert_eq!(
                element.to_string(),
                "<spectrum name=\"radiance\" filename=\"spectra/spectrum-0.spd\"/>"
            );
        }
        assert_eq!(spectra.files.len(), 1);
        assert_eq!(spectra.files[0].1.lines().count(), 2301);
        assert!(
            spectra.files[0].1.contains("\n560 2\n"),
            "twice 1 at 560 nm"
        );
    }

    #[test]
    fn black_is_written_as_a_number_since_mitsuba_refuses_empty_tables() {
        let mut spectra = Spectra::default();
        let black = spectra.element("reflectance", &Spectrum::Constant(0.0), 1.0);
        let expected = "<spectrum name=\"reflectance\" value=\"0\"/>";
        assert_eq!(black.to_string(), expected);
    }
}
