//! Which wavelengths a path carries, and what its radiance adds to the film.

use crate::sampling::distribution::Guide;
use crate::scene::description::Band;
use crate::spectrum::cie;
use crate::spectrum::lanes::Lanes;

/// The wavelengths of one path, nm.
#[derive(Clone, Copy, Debug)]
pub struct Wavelengths<const N: usize> {
    /// A vacuum wavelength for each lane, nm.
    pub nm: [f32; N],
    /// Density with which each was drawn, nm⁻¹; 1 for the bands of a spectral film.
    pub pdf: [f32; N],
}

/// Draws wavelengths and turns the radiance found at them into film values.
#[derive(Clone, Debug)]
pub enum WavelengthSampler {
    /// Colour: wavelengths drawn in proportion to how much the observer sees there.
    Rgb(VisibleDistribution),
    /// Bands: one lane a band.
    Bands(Vec<Band>),
}

/// Densities over 1 nm steps of a range, for inverse-transform sampling.
#[derive(Clone, Debug)]
pub struct VisibleDistribution {
    first_nm: f64,
    step_nm: f64,
    /// Cumulative, from 0 to 1, one more than there are steps.
    cumulative: Vec<f64>,
    guide: Guide,
    /// Linear sRGB of radiance 1 nm wide at each border of the steps, divided by the ȳ integral.
    rgb: Vec<[f32; 3]>,
}

impl VisibleDistribution {
    /// Share of samples spread evenly, so that no wavelength of the range is starved.
    const EVEN_SHARE: f64 = 0.1;

    /// Over a range in nm, rising.
    pub fn new(range_nm: [f64; 2]) -> Self {
        let steps = ((range_nm[1] - range_nm[0]).ceil() as usize).max(1);
        let step_nm = (range_nm[1] - range_nm[0]) / steps as f64;
        let border = |i: usize| range_nm[0] + i as f64 * step_nm;
        let seen: Vec<f64> = (0..steps)
            .map(|i| cie::observer(border(i) + 0.5 * step_nm).iter().sum())
            .collect();
        let total: f64 = seen.iter().sum();
        let mut cumulative = vec![0.0];
        let mut sum = 0.0;
        for weight in &seen {
            let share = if total > 0.0 {
                weight / total
            } else {
                1.0 / steps as f64
            };
            sum += Self::EVEN_SHARE / steps as f64 + (1.0 - Self::EVEN_SHARE) * share;
            cumulative.push(sum);
        }
        for value in &mut cumulative {
            *value /= sum;
        }
        let rgb = (0..=steps)
            .map(|i| {
                let xyz = cie::observer(border(i)).map(|c| c / cie::luminance_integral());
                cie::srgb_from_xyz(xyz).map(|c| c as f32)
            })
            .collect();
        Self {
            first_nm: range_nm[0],
            step_nm,
            guide: Guide::new(&cumulative),
            cumulative,
            rgb,
        }
    }

    /// A wavelength and its density for `u` in [0, 1).
    fn draw(&self, u: f64) -> (f32, f32) {
        let below = self.guide.count_up_to(&self.cumulative, u);
        let step = below.clamp(1, self.cumulative.len() - 1) - 1;
        let mass = self.cumulative[step + 1] - self.cumulative[step];
        let within = ((u - self.cumulative[step]) / mass).clamp(0.0, 1.0);
        let nm = self.first_nm + (step as f64 + within) * self.step_nm;
        (nm as f32, (mass / self.step_nm) as f32)
    }

    fn rgb_at(&self, nm: f32) -> [f32; 3] {
        let place = ((f64::from(nm) - self.first_nm) / self.step_nm)
            .clamp(0.0, (self.rgb.len() - 1) as f64);
        let below = (place as usize).min(self.rgb.len() - 2);
        let share = (place - below as f64) as f32;
        std::array::from_fn(|i| self.rgb[below][i] * (1.0 - share) + self.rgb[below + 1][i] * share)
    }
}

impl WavelengthSampler {
    /// How many values a path adds to the film.
    pub fn channels(&self) -> usize {
        match self {
            Self::Rgb(_) => 3,
            Self::Bands(bands) => bands.len(),
        }
    }

    /// Wavelengths for one path: `N` strata of one random number.
    ///
    /// A spectral film with fewer bands than lanes fills up with its last band.
    pub fn draw<const N: usize>(&self, u: f32) -> Wavelengths<N> {
        let mut wavelengths = Wavelengths {
            nm: [0.0; N],
            pdf: [1.0; N],
        };
        for lane in 0..N {
            match self {
                Self::Rgb(distribution) => {
                    let stratum = f64::from(u) + lane as f64 / N as f64;
                    let (nm, pdf) = distribution.draw(stratum - stratum.floor());
                    wavelengths.nm[lane] = nm;
                    wavelengths.pdf[lane] = pdf;
                }
                Self::Bands(bands) => {
                    let band = bands[lane.min(bands.len() - 1)];
                    let offset = (f64::from(u) - 0.5) * band.width_nm;
                    wavelengths.nm[lane] = (band.center_nm + offset) as f32;
                }
            }
        }
        wavelengths
    }

    /// What radiance at the path's wavelengths is to the film: linear sRGB, or radiance per band.
    ///
    /// `values` has [`WavelengthSampler::channels`] entries.
    pub fn film_values<const N: usize>(
        &self,
        wavelengths: &Wavelengths<N>,
        radiance: &Lanes<N>,
        values: &mut [f32],
    ) {
        match self {
            Self::Rgb(distribution) => {
                values.fill(0.0);
                for lane in 0..N {
                    let weight = radiance.0[lane] / (wavelengths.pdf[lane] * N as f32);
                    let rgb = distribution.rgb_at(wavelengths.nm[lane]);
                    for (value, component) in values.iter_mut().zip(rgb) {
                        *value += weight * component;
                    }
                }
            }
            Self::Bands(_) => {
                for (value, lane) in values.iter_mut().zip(radiance.0) {
                    *value = lane;
                }
            }
        }
    }

    /// First and last wavelength that can be drawn, nm.
    pub fn range_nm(&self) -> [f64; 2] {
        match self {
            Self::Rgb(distribution) => {
                let steps = (distribution.cumulative.len() - 1) as f64;
                [
                    distribution.first_nm,
                    distribution.first_nm + steps * distribution.step_nm,
                ]
            }
            Self::Bands(bands) => bands.iter().fold([f64::INFINITY, 0.0], |range, band| {
                [
                    range[0].min(band.center_nm - 0.5 * band.width_nm),
                    range[1].max(band.center_nm + 0.5 * band.width_nm),
                ]
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_over_drawn_wavelengths_is_the_colour_of_the_spectrum() {
        let sampler = WavelengthSampler::Rgb(VisibleDistribution::new([360.0, 830.0]));
        let spectrum = |nm: f32| 0.2 + (nm - 360.0) / 400.0;
        let mut mean = [0.0_f64; 3];
        let draws = 4096;
        for i in 0..draws {
            let wavelengths = sampler.draw::<8>((i as f32 + 0.5) / draws as f32);
            let radiance = Lanes::from_fn(|lane| spectrum(wavelengths.nm[lane]));
            let mut rgb = [0.0; 3];
            sampler.film_values(&wavelengths, &radiance, &mut rgb);
            for (sum, value) in mean.iter_mut().zip(rgb) {
                *sum += f64::from(value) / f64::from(draws);
            }
        }
        let expected = cie::srgb_from_xyz(cie::xyz_of(|nm| f64::from(spectrum(nm as f32))));
        for (value, reference) in mean.iter().zip(expected) {
            assert!(
                (value - reference).abs() < 1e-4,
                "{mean:?} against {expected:?}"
            );
        }
    }

    #[test]
    fn a_band_film_records_the_radiance_itself() {
        let bands = vec![
            Band {
                center_nm: 450.0,
                width_nm: 10.0,
            },
            Band {
                center_nm: 900.0,
                width_nm: 0.0,
            },
        ];
        let sampler = WavelengthSampler::Bands(bands);
        let wavelengths = sampler.draw::<8>(0.25);
        assert_eq!(wavelengths.nm[..2], [447.5, 900.0]);
        let mut values = [0.0; 2];
        sampler.film_values(
            &wavelengths,
            &Lanes::from_fn(|i| i as f32 + 1.0),
            &mut values,
        );
        assert_eq!(values, [1.0, 2.0]);
    }
}
