//! The leaf as five layers by direction: BRDF and BTDF of both faces.

use std::f64::consts::{FRAC_1_PI, PI};
use std::fmt::Write as _;

use leafmodel::optics::layers::{
    Bidirectional, Binned, Bins, Face, Incidence, LayeredLeaf, Resolution, follow,
};
use leafmodel::optics::{Contents, ProspectD};
use rayon::prelude::*;

use crate::checkpoint::PROGRAM;

/// Wavelengths, nm, if none are asked for.
const USUAL_NM: [f64; 4] = [450.0, 550.0, 680.0, 800.0];
/// Angles of incidence from the normal.
const INCIDENCES_DEG: [f64; 5] = [0.0, 20.0, 40.0, 60.0, 80.0];
const VIEWS_DEG: [f64; 9] = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0];
/// Azimuths of view from the half-plane in which the light goes on.
const AZIMUTHS_DEG: [f64; 7] = [0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0];
/// Directions in each range of the ordinates: with twice as many, means over azimuth of `sun-green`
/// change by less than 0.2 % up to 80°.
const RESOLUTION: usize = 14;
/// Ranges of directions in which photons are counted.
const BINS: Bins = Bins {
    polar: 9,
    azimuth: 12,
};
/// Seed of the photons.
const SEED: u64 = 17;

const FACES: [(&str, Face); 2] = [("adaxial", Face::First), ("abaxial", Face::Last)];

fn cosines(angles_deg: &[f64]) -> Vec<f64> {
    let cosine = |angle: &f64| libm::cos(angle.to_radians());
    angles_deg.iter().map(cosine).collect()
}

/// A leaf, and wavelengths.
pub(crate) struct Angles {
    leaf: LayeredLeaf,
    wavelengths_nm: Vec<f64>,
}

impl Angles {
    /// A leaf of these contents at these wavelengths, or at the usual ones if there is none.
    pub(crate) fn of(contents: &Contents, wavelengths_nm: &[f64]) -> Self {
        let wavelengths_nm = if wavelengths_nm.is_empty() {
            &USUAL_NM
        } else {
            wavelengths_nm
        };
        Self {
            leaf: LayeredLeaf::new(contents),
            wavelengths_nm: wavelengths_nm.to_vec(),
        }
    }

    /// BRDF and BTDF by ordinates, by incidence, view and azimuth.
    pub(crate) fn table(&self, line: &str) -> String {
        let head = format!(
            "# Lamina {PROGRAM}, leaf of layers by ordinates: {line}\n\
             # The shares mirrored and straight were never scattered and are in neither BRDF nor BTDF\n\
             wavelength_nm,lit,incidence_deg,view_deg,azimuth_deg,brdf_per_sr,btdf_per_sr,mirrored,straight\n"
        );
        let rows: Vec<String> = self
            .wavelengths_nm
            .par_iter()
            .map(|&nm| self.rows(nm))
            .collect();
        head + &rows.concat()
    }

    fn rows(&self, nm: f64) -> String {
        let stack = self.leaf.stack(&ProspectD::coefficients_extrapolated(nm));
        let (incidences, views) = (cosines(&INCIDENCES_DEG), cosines(&VIEWS_DEG));
        let resolution = Resolution::new(RESOLUTION);
        let all = Bidirectional::new(&stack, resolution, &incidences, &views)
            .expect("angles below 90° have cosines in range");
        let mut rows = String::new();
        for (lit, face) in FACES {
            for (incidence, incidence_deg) in INCIDENCES_DEG.iter().enumerate() {
                let [mirrored, straight] = all.unscattered(face, incidence);
                for (view, view_deg) in VIEWS_DEG.iter().enumerate() {
                    for azimuth_deg in AZIMUTHS_DEG {
                        let leaving = all.at(face, incidence, view, f64::to_radians(azimuth_deg));
                        let [brdf, btdf] = [leaving.reflected, leaving.transmitted]
                            .map(|factor| factor * FRAC_1_PI);
                        // Writing to a String cannot fail.
                        let _ = writeln!(
                            rows,
                            "{nm},{lit},{incidence_deg},{view_deg},{azimuth_deg},\
                             {brdf:.6e},{btdf:.6e},{mirrored:.6e},{straight:.6e}"
                        );
                    }
                }
            }
        }
        rows
    }

    /// Means over ranges of directions by ordinates, and by so many photons with standard errors.
    pub(crate) fn compared(&self, photons: u64, line: &str) -> String {
        let mut head = format!(
            "# Lamina {PROGRAM}, leaf of layers by ordinates and by {photons} photons: {line}\n"
        );
        let mut rows = String::new();
        let (mut most, mut count, mut squares) = (0.0_f64, 0_u32, 0.0);
        for (&nm, (lit, face), incidence_deg) in self.cases() {
            let stack = self.leaf.stack(&ProspectD::coefficients_extrapolated(nm));
            let cosine = libm::cos(f64::to_radians(incidence_deg));
            let incidence = Incidence::Directional { cosine };
            let resolution = Resolution::new(RESOLUTION);
            let exact = Binned::new(&stack, resolution, face, cosine, BINS);
            let found = follow(&stack, face, incidence, BINS, photons, SEED);
            let (exact, found) = exact
                .and_then(|exact| Ok((exact, found?)))
                .expect("angles below 90° have cosines in range");
            for bin in 0..BINS.polar * BINS.azimuth {
                let (polar, azimuth) = (bin / BINS.azimuth, bin % BINS.azimuth);
                let view =
                    |edge: usize| libm::acos((edge as f64 / BINS.polar as f64).sqrt()).to_degrees();
                let turn = |edge: usize| 360.0 * edge as f64 / BINS.azimuth as f64;
                let _ = write!(
                    rows,
                    "{nm},{lit},{incidence_deg},{:.2},{:.2},{},{}",
                    view(polar + 1),
                    view(polar),
                    turn(azimuth),
                    turn(azimuth + 1)
                );
                let sides = [
                    (exact.reflected[bin], found.reflected_by_direction[bin]),
                    (exact.transmitted[bin], found.transmitted_by_direction[bin]),
                ];
                for (exact, found) in sides {
                    let (value, error) = (found.value / PI, found.standard_error / PI);
                    let _ = write!(rows, ",{:.6e},{value:.6e},{error:.2e}", exact / PI);
                    if error > 0.0 {
                        let z = (value - exact / PI) / error;
                        most = most.max(z.abs());
                        squares += z * z;
                        count += 1;
                    }
                }
                rows.push('\n');
            }
        }
        let spread = (squares / f64::from(count.max(1))).sqrt();
        let _ = writeln!(
            head,
            "# Photons less ordinates in standard errors: rms {spread:.3}, at most {most:.2}, of {count} figures\n\
             wavelength_nm,lit,incidence_deg,view_from_deg,view_to_deg,azimuth_from_deg,azimuth_to_deg,\
             brdf_per_sr,brdf_photons_per_sr,brdf_standard_error_per_sr,\
             btdf_per_sr,btdf_photons_per_sr,btdf_standard_error_per_sr"
        );
        head + &rows
    }

    /// Wavelengths, faces and angles of incidence, in the order of the table.
    fn cases(&self) -> impl Iterator<Item = (&f64, (&'static str, Face), f64)> {
        self.wavelengths_nm.iter().flat_map(|nm| {
            FACES.into_iter().flat_map(move |face| {
                INCIDENCES_DEG
                    .into_iter()
                    .map(move |incidence| (nm, face, incidence))
            })
        })
    }
}
