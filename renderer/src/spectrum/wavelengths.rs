//! Which wavelengths a path carries, and what its radiance adds to the film.
//!
//! A picture's paths carry one of [`ROWS`] sets of wavelengths: the middles of `ROWS × lanes` equal
//! shares of the distribution, so some 0.2 nm apart in a colour picture. What depends on wavelength
//! alone is tabulated for each of them ([`Table`]) and never worked out along a path.

use crate::scene::description::{Band, FilmKind};
use crate::spectrum::cie;
use crate::spectrum::lanes::Lanes;
use crate::spectrum::tabulated::Table;

/// Sets of wavelengths that paths choose from.
pub const ROWS: usize = 256;

/// Marks wavelengths that are in no row of the picture's grid.
const NO_ROW: u32 = u32::MAX;

/// The wavelengths of one path, nm.
#[derive(Clone, Copy, Debug)]
pub struct Wavelengths<const N: usize> {
    /// A vacuum wavelength for each lane, nm.
    pub nm: [f32; N],
    row: u32,
}

impl<const N: usize> Wavelengths<N> {
    /// Any wavelengths, nm: every spectrum is worked out for them anew.
    pub fn new(nm: [f32; N]) -> Self {
        Self { nm, row: NO_ROW }
    }

    /// Number of the row of the picture's grid that they are; beyond all rows if they are none.
    #[inline]
    pub(super) fn row(&self) -> usize {
        self.row as usize
    }
}

/// The sets of wavelengths of a picture.
#[derive(Clone, Debug)]
pub struct WavelengthGrid {
    lanes: usize,
    /// By row and lane, nm.
    nm: Box<[f32]>,
}

impl WavelengthGrid {
    fn new(lanes: usize, mut nm: impl FnMut(usize, usize) -> f32) -> Self {
        let places = (0..ROWS).flat_map(|row| (0..lanes).map(move |lane| (row, lane)));
        Self {
            lanes,
            nm: places.map(|(row, lane)| nm(row, lane)).collect(),
        }
    }

    /// Wavelengths in a set.
    pub fn lanes(&self) -> usize {
        self.lanes
    }

    /// The wavelengths, row by row, nm.
    pub fn nm(&self) -> &[f32] {
        &self.nm
    }
}

/// Draws wavelengths and turns the radiance found at them into film values.
#[derive(Clone, Debug)]
pub struct WavelengthSampler {
    grid: WavelengthGrid,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Colour: wavelengths drawn in proportion to how much the observer sees there.
    Rgb {
        range_nm: [f64; 2],
        /// Linear sRGB that radiance 1 at each wavelength stands for, times the number of rows.
        weights: Table,
    },
    /// Bands: one lane a band.
    Bands(Vec<Band>),
}

/// Densities over 1 nm steps of a range, for inverse-transform sampling.
#[derive(Clone, Debug)]
struct VisibleDistribution {
    first_nm: f64,
    step_nm: f64,
    /// Cumulative, from 0 to 1, one more than there are steps.
    cumulative: Vec<f64>,
}

/// Linear sRGB of radiance 1 nm wide at a wavelength, divided by the ȳ integral.
pub fn seen_at(nm: f64) -> [f64; 3] {
    cie::srgb_from_xyz(cie::observer(nm).map(|c| c / cie::luminance_integral()))
}

impl VisibleDistribution {
    /// Share of samples spread evenly, so that no wavelength of the range is starved.
    const EVEN_SHARE: f64 = 0.1;

    /// Over a range in nm, rising.
    fn new(range_nm: [f64; 2]) -> Self {
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
        Self {
            first_nm: range_nm[0],
            step_nm,
            cumulative,
        }
    }

    /// The wavelength, nm, below which a share `u` of the distribution lies, in [0, 1].
    fn draw(&self, u: f64) -> f64 {
        let below = self.cumulative.partition_point(|&border| border <= u);
        let step = below.clamp(1, self.cumulative.len() - 1) - 1;
        let mass = self.cumulative[step + 1] - self.cumulative[step];
        let within = ((u - self.cumulative[step]) / mass).clamp(0.0, 1.0);
        self.first_nm + (step as f64 + within) * self.step_nm
    }
}

/// Lanes that a film with this many bands takes.
fn lanes_of(bands: usize) -> usize {
    match bands {
        0..=4 => 4,
        5..=8 => 8,
        9..=16 => 16,
        _ => 32,
    }
}

impl WavelengthSampler {
    /// For what a film records.
    pub fn new(film: &FilmKind) -> Self {
        match film {
            FilmKind::Rgb { range_nm } => Self::rgb(*range_nm),
            FilmKind::Spectral { bands } => Self::bands(bands.clone()),
        }
    }

    fn rgb(range_nm: [f64; 2]) -> Self {
        /// Places within a share at which the observer is evaluated.
        const STEPS: usize = 8;
        // 4 lanes are noisier, 16 bring nothing more.
        let lanes = 8;
        let distribution = VisibleDistribution::new(range_nm);
        // Lanes share the distribution between them, and rows a lane's share: so samples of a pixel
        // are stratified over the rows, and the eight wavelengths of each over the whole range.
        let drawn = |row: f64, lane: usize| {
            distribution.draw((lane as f64 + row / ROWS as f64) / lanes as f64)
        };
        let grid = WavelengthGrid::new(lanes, |row, lane| drawn(row as f64 + 0.5, lane) as f32);
        // A wavelength stands for all of its share: what the observer sees there is integrated, and
        // counts as often as there are rows, one of which is drawn.
        let weights = Table::by_place(&grid, |row, lane| {
            let first = drawn(row as f64, lane);
            let width = (drawn(row as f64 + 1.0, lane) - first) / STEPS as f64;
            let mut sum = [0.0; 3];
            for step in 0..STEPS {
                let seen = seen_at(first + (step as f64 + 0.5) * width);
                for (sum, seen) in sum.iter_mut().zip(seen) {
                    *sum += seen * width;
                }
            }
            sum.map(|seen| (seen * ROWS as f64) as f32)
        });
        Self {
            grid,
            kind: Kind::Rgb { range_nm, weights },
        }
    }

    fn bands(bands: Vec<Band>) -> Self {
        // Lanes beyond the last band carry that band's wavelength; nobody reads them.
        let grid = WavelengthGrid::new(lanes_of(bands.len()), |row, lane| {
            let band = bands[lane.min(bands.len() - 1)];
            let share = (row as f64 + 0.5) / ROWS as f64;
            (band.center_nm + (share - 0.5) * band.width_nm) as f32
        });
        Self {
            grid,
            kind: Kind::Bands(bands),
        }
    }

    /// The sets of wavelengths that are drawn.
    pub fn grid(&self) -> &WavelengthGrid {
        &self.grid
    }

    /// Whether the film records colour.
    pub fn is_rgb(&self) -> bool {
        matches!(self.kind, Kind::Rgb { .. })
    }

    /// How many values a path adds to the film.
    pub fn channels(&self) -> usize {
        match &self.kind {
            Kind::Rgb { .. } => 3,
            Kind::Bands(bands) => bands.len(),
        }
    }

    /// Wavelengths for one path; `u` in [0, 1) chooses the row.
    ///
    /// # Panics
    ///
    /// If `N` is not the grid's number of lanes.
    #[inline]
    pub fn draw<const N: usize>(&self, u: f32) -> Wavelengths<N> {
        assert_eq!(
            N, self.grid.lanes,
            "paths carry as many wavelengths as the grid has lanes"
        );
        let row = ((u * ROWS as f32) as usize).min(ROWS - 1);
        let mut nm = [0.0; N];
        nm.copy_from_slice(&self.grid.nm[row * N..][..N]);
        Wavelengths {
            nm,
            row: row as u32,
        }
    }

    /// What radiance at drawn wavelengths is to the film: linear sRGB, or radiance per band.
    ///
    /// `values` has [`WavelengthSampler::channels`] entries.
    #[inline]
    pub fn film_values<const N: usize>(
        &self,
        wavelengths: &Wavelengths<N>,
        radiance: &Lanes<N>,
        values: &mut [f32],
    ) {
        match &self.kind {
            Kind::Rgb { weights, .. } => {
                let weights = weights
                    .row::<N, 3>(wavelengths)
                    .expect("a path's wavelengths are drawn from the grid");
                for (value, weight) in values.iter_mut().zip(weights) {
                    *value = (weight * *radiance).sum();
                }
            }
            Kind::Bands(_) => {
                for (value, lane) in values.iter_mut().zip(radiance.0) {
                    *value = lane;
                }
            }
        }
    }

    /// First and last wavelength that can be drawn, nm.
    pub fn range_nm(&self) -> [f64; 2] {
        match &self.kind {
            Kind::Rgb { range_nm, .. } => *range_nm,
            Kind::Bands(bands) => bands.iter().fold([f64::INFINITY, 0.0], |range, band| {
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
        let sampler = WavelengthSampler::rgb([360.0, 830.0]);
        let spectrum = |nm: f32| 0.2 + (nm - 360.0) / 400.0;
        let mut mean = [0.0_f64; 3];
        let draws = ROWS;
        for i in 0..draws {
            let wavelengths = sampler.draw::<8>((i as f32 + 0.5) / draws as f32);
            let radiance = Lanes::from_fn(|lane| spectrum(wavelengths.nm[lane]));
            let mut rgb = [0.0; 3];
            sampler.film_values(&wavelengths, &radiance, &mut rgb);
            for (sum, value) in mean.iter_mut().zip(rgb) {
                *sum += f64::from(value) / draws as f64;
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
        let sampler = WavelengthSampler::bands(bands);
        let wavelengths = sampler.draw::<4>(0.25);
        // The middle of the 65th of 256 shares of the band.
        assert_eq!(wavelengths.nm, [447.519_53, 900.0, 900.0, 900.0]);
        let mut values = [0.0; 2];
        sampler.film_values(
            &wavelengths,
            &Lanes::from_fn(|i| i as f32 + 1.0),
            &mut values,
        );
        assert_eq!(values, [1.0, 2.0]);
    }
}
