//! The wavelengths that a path carries, and the conversion of its radiance to film values.
//!
//! A picture's paths carry one of [`ROWS`] sets of wavelengths: the centres of `ROWS × lanes` equal
//! shares of the distribution, so some 0.2 nm apart in a colour picture. Everything that depends on
//! wavelength alone is tabulated for them ([`Table`]) and never computed along a path. Tables of
//! spectra hold means over the shares, so that no line is too narrow to be met.
//!
//! More bands than a path has lanes are carried in groups, each of which has [`ROWS`] sets of its own.

use super::density::{Distribution, LANES, Shares};
use super::recorded::{Band, FilmKind};
pub use crate::spectrum::grid::{ROWS, Share, WavelengthGrid, Wavelengths};
use crate::spectrum::lanes::Lanes;
use crate::spectrum::observer::Observer;
use crate::spectrum::tabulated::Table;

/// Draws wavelengths and turns the radiance found at them into film values.
#[derive(Clone, Debug)]
pub struct WavelengthSampler {
    grid: WavelengthGrid,
    kind: SamplerKind,
}

#[derive(Clone, Debug)]
enum SamplerKind {
    /// Colour: wavelengths drawn from all that the observer sees.
    Rgb {
        range_nm: [f64; 2],
        /// Linear sRGB that radiance 1 at each wavelength contributes, times the number of rows.
        weights: Table,
        /// Shares of each channel of the observer that each wavelength represents, times the number of rows, so
        /// that a throughput of 1 gives 1 on average.
        seen: Table,
    },
    /// Bands, one lane for each, and all that they see.
    Bands {
        bands: Vec<Band>,
        range_nm: [f64; 2],
    },
    /// Sets of given wavelengths, which no film records.
    Sets { range_nm: [f64; 2] },
}

/// Most lanes of a path, and so the number of bands in a group.
const MOST_LANES: usize = 32;

/// Number of lanes for this many bands.
fn lanes_of(bands: usize) -> usize {
    match bands {
        0..=4 => 4,
        5..=8 => 8,
        9..=16 => 16,
        _ => MOST_LANES,
    }
}

impl WavelengthSampler {
    /// The sampler for a kind of film.
    pub fn new(film: &FilmKind) -> Self {
        match film {
            FilmKind::Rgb { range_nm, observer } => Self::rgb(*range_nm, observer),
            FilmKind::Spectral { bands } => Self::bands(bands.clone(), |row, band| {
                let share = (row as f64 + 0.5) / ROWS as f64;
                let middle = bands[band].center_nm + (share - 0.5) * bands[band].width_nm;
                Share::around(middle, bands[band].width_nm / ROWS as f64)
            }),
            FilmKind::Sensor(sensor) => {
                let responses = sensor.bands().iter();
                let shares: Vec<_> = responses.map(|response| response.shares(ROWS)).collect();
                let mut sampler = Self::bands(sensor.boxes(), |row, band| shares[band][row]);
                if let SamplerKind::Bands { range_nm, .. } = &mut sampler.kind {
                    *range_nm = sensor.range_nm();
                }
                sampler
            }
        }
    }

    fn rgb(range_nm: [f64; 2], observer: &Observer) -> Self {
        // The distribution is divided among the lanes, and each lane's share among the rows. So
        // samples of a pixel are stratified over the rows, and the eight wavelengths of each sample
        // over the whole range.
        let shares = Shares(Distribution::of(range_nm, observer));
        let grid = WavelengthGrid::new(LANES, 1, |row, lane| shares.share(row, lane));
        let srgb_at = |nm: f64| observer.srgb_at(nm);
        let channels_at = |nm: f64| observer.channels_at(nm);
        let weights = Table::by_place(&grid, |row, lane| {
            let seen = shares.integrated(row, lane, &srgb_at);
            seen.map(|seen| seen as f32)
        });
        let mut totals = [0.0; 3];
        for place in 0..ROWS * LANES {
            let seen = shares.integrated(place / LANES, place % LANES, &channels_at);
            for (total, seen) in totals.iter_mut().zip(seen) {
                *total += seen / ROWS as f64;
            }
        }
        let seen = Table::by_place(&grid, |row, lane| {
            let seen = shares.integrated(row, lane, &channels_at);
            // The observer sees nothing of a purely infrared range.
            std::array::from_fn::<_, 3, _>(|c| (seen[c] / totals[c].max(1e-30)) as f32)
        });
        Self {
            grid,
            kind: SamplerKind::Rgb {
                range_nm,
                weights,
                seen,
            },
        }
    }

    /// Bands, with the part of each that a row of its group represents.
    fn bands(bands: Vec<Band>, share: impl Fn(usize, usize) -> Share) -> Self {
        let groups = bands.len().div_ceil(MOST_LANES);
        // Lanes beyond the last band of a group go through its bands again. Nobody reads them, but they
        // count where a path decides by the mean over its lanes.
        let grid = WavelengthGrid::new(lanes_of(bands.len()), groups, |row, lane| {
            let first = row / ROWS * MOST_LANES;
            let count = MOST_LANES.min(bands.len() - first);
            share(row % ROWS, first + lane % count)
        });
        let range_nm = bands.iter().fold([f64::INFINITY, 0.0], |range, band| {
            [
                range[0].min(band.center_nm - 0.5 * band.width_nm),
                range[1].max(band.center_nm + 0.5 * band.width_nm),
            ]
        });
        Self {
            grid,
            kind: SamplerKind::Bands { bands, range_nm },
        }
    }

    /// The sets of wavelengths of instruments: each list, nm, in packets of `lanes`. The last
    /// packet of a list is filled up with its last wavelength. Also the first packet of each list.
    ///
    /// # Panics
    ///
    /// If there is no list, or an empty one.
    pub fn of_lists(lanes: usize, lists: &[&[f64]]) -> (Self, Vec<usize>) {
        let (mut nm, mut first) = (Vec::new(), Vec::new());
        let mut range_nm = [f64::INFINITY, 0.0];
        for list in lists {
            first.push(nm.len() / lanes);
            let last = *list.last().expect("a list holds a wavelength");
            let padded = list.len().next_multiple_of(lanes);
            let filled = list.iter().copied().chain(std::iter::repeat(last));
            for wavelength in filled.take(padded) {
                nm.push(wavelength as f32);
                range_nm = [range_nm[0].min(wavelength), range_nm[1].max(wavelength)];
            }
        }
        assert!(!nm.is_empty(), "there is a list");
        let sampler = Self {
            grid: WavelengthGrid::of_sets(lanes, nm),
            kind: SamplerKind::Sets { range_nm },
        };
        (sampler, first)
    }

    /// The sets of wavelengths that are drawn.
    pub fn grid(&self) -> &WavelengthGrid {
        &self.grid
    }

    /// Whether the film records colour.
    pub(crate) fn is_rgb(&self) -> bool {
        matches!(self.kind, SamplerKind::Rgb { .. })
    }

    /// How many values a path adds to the film.
    pub fn channels(&self) -> usize {
        match &self.kind {
            SamplerKind::Rgb { .. } => 3,
            SamplerKind::Bands { bands, .. } => bands.len(),
            SamplerKind::Sets { .. } => self.grid.lanes,
        }
    }

    /// Number of groups of channels; each sample of a picture has a path for each.
    pub fn groups(&self) -> usize {
        match &self.kind {
            SamplerKind::Rgb { .. } | SamplerKind::Sets { .. } => 1,
            SamplerKind::Bands { bands, .. } => bands.len().div_ceil(MOST_LANES),
        }
    }

    /// The bands that a path of these wavelengths sees, by number; wavelengths that are not drawn
    /// count as those of the first group.
    #[inline]
    fn seen(bands: &[Band], row: usize) -> std::ops::Range<usize> {
        let first = row / ROWS * MOST_LANES;
        let first = if first < bands.len() { first } else { 0 };
        first..bands.len().min(first + MOST_LANES)
    }

    /// Wavelengths for one path of a group of channels; `u` in [0, 1) chooses the row.
    ///
    /// # Panics
    ///
    /// If `N` is not the grid's number of lanes.
    #[inline]
    pub fn draw<const N: usize>(&self, u: f32, group: usize) -> Wavelengths<N> {
        let rows = self.grid.rows() / self.groups();
        self.grid
            .set(group * rows + ((u * rows as f32) as usize).min(rows - 1))
    }

    /// Sets the film values of radiance at drawn wavelengths: linear sRGB, or radiance per band of
    /// their group.
    ///
    /// `values` has [`WavelengthSampler::channels`] entries.
    #[inline]
    pub(crate) fn film_values<const N: usize>(
        &self,
        wavelengths: &Wavelengths<N>,
        radiance: &Lanes<N>,
        values: &mut [f32],
    ) {
        match &self.kind {
            SamplerKind::Rgb { weights, .. } => {
                let weights = weights
                    .row::<N, 3>(wavelengths)
                    .expect("a path's wavelengths are drawn from the grid");
                for (value, weight) in values.iter_mut().zip(weights) {
                    *value = (weight * *radiance).sum();
                }
            }
            SamplerKind::Bands { bands, .. } => {
                let seen = Self::seen(bands, wavelengths.row());
                for (value, lane) in values[seen].iter_mut().zip(radiance.0) {
                    *value = lane;
                }
            }
            SamplerKind::Sets { .. } => {
                for (value, lane) in values.iter_mut().zip(radiance.0) {
                    *value = lane;
                }
            }
        }
    }

    /// The sum over the channels that a path of these wavelengths sees.
    pub(crate) fn sum_of_seen<const N: usize>(
        &self,
        wavelengths: &Wavelengths<N>,
        values: &Lanes<N>,
    ) -> f32 {
        let count = match &self.kind {
            SamplerKind::Bands { bands, .. } => Self::seen(bands, wavelengths.row()).len(),
            SamplerKind::Rgb { .. } | SamplerKind::Sets { .. } => N,
        };
        values.0.iter().take(count).sum()
    }

    /// The film values of light of this spectrum, a function of the shares of the range, over all
    /// wavelengths that are drawn: what samples of it converge to.
    pub fn recorded(&self, spectrum: &dyn Fn(&Share) -> f64) -> Vec<f64> {
        match self.grid.lanes() {
            4 => self.mean_over_rows::<4>(spectrum),
            8 => self.mean_over_rows::<8>(spectrum),
            16 => self.mean_over_rows::<16>(spectrum),
            _ => self.mean_over_rows::<32>(spectrum),
        }
    }

    fn mean_over_rows<const N: usize>(&self, spectrum: &dyn Fn(&Share) -> f64) -> Vec<f64> {
        let rows = self.grid.rows();
        let mut sums = vec![0.0; self.channels()];
        for row in 0..rows {
            let wavelengths = self.grid.set::<N>(row);
            let radiance: [f64; N] =
                std::array::from_fn(|lane| spectrum(&self.grid.share(row, lane)));
            match &self.kind {
                SamplerKind::Rgb { weights, .. } => {
                    let weights = weights
                        .row::<N, 3>(&wavelengths)
                        .expect("a path's wavelengths are drawn from the grid");
                    for (sum, weights) in sums.iter_mut().zip(weights) {
                        let seen = weights.0.into_iter().zip(radiance);
                        *sum += seen
                            .map(|(weight, value)| f64::from(weight) * value)
                            .sum::<f64>();
                    }
                }
                SamplerKind::Bands { bands, .. } => {
                    let seen = Self::seen(bands, row);
                    for (sum, value) in sums[seen].iter_mut().zip(radiance) {
                        *sum += value;
                    }
                }
                SamplerKind::Sets { .. } => {
                    for (sum, value) in sums.iter_mut().zip(radiance) {
                        *sum += value;
                    }
                }
            }
        }
        let of_each = (rows / self.groups()) as f64;
        sums.into_iter().map(|sum| sum / of_each).collect()
    }

    /// The bands, if the film records them.
    pub fn as_bands(&self) -> Option<&[Band]> {
        match &self.kind {
            SamplerKind::Bands { bands, .. } => Some(bands),
            SamplerKind::Rgb { .. } | SamplerKind::Sets { .. } => None,
        }
    }

    /// The share of light that reaches the film with this throughput at drawn wavelengths; about 1
    /// if all lanes are 1. For a colour film it is the greatest of the shares of the observer's channels, for
    /// bands their mean, but at least a quarter of the brightest: so none of what survives roulette weighs more
    /// than four times its threshold.
    #[inline]
    pub fn brightness<const N: usize>(
        &self,
        wavelengths: &Wavelengths<N>,
        throughput: &Lanes<N>,
    ) -> f32 {
        match &self.kind {
            SamplerKind::Rgb { seen, .. } => {
                let [x, y, z] = seen
                    .row::<N, 3>(wavelengths)
                    .expect("a path's wavelengths are drawn from the grid")
                    .map(|seen| (seen * *throughput).sum());
                x.max(y).max(z)
            }
            // Lanes beyond the bands are no one's. Of a length known to the compiler it is faster.
            SamplerKind::Bands { bands, .. } => {
                let count = Self::seen(bands, wavelengths.row()).len();
                if count < N {
                    seen_by_bands(&throughput.0[..count])
                } else {
                    seen_by_bands(&throughput.0)
                }
            }
            SamplerKind::Sets { .. } => seen_by_bands(&throughput.0),
        }
    }

    /// First and last wavelength that can be drawn, nm.
    pub fn range_nm(&self) -> [f64; 2] {
        match &self.kind {
            SamplerKind::Rgb { range_nm, .. }
            | SamplerKind::Bands { range_nm, .. }
            | SamplerKind::Sets { range_nm } => *range_nm,
        }
    }
}

/// The mean of some numbers ≥ 0, at least a quarter of the greatest.
#[inline(always)]
fn seen_by_bands(numbers: &[f32]) -> f32 {
    // Four side by side: one after the other each would wait for the one before.
    let (mut sums, mut greatest) = ([0.0; 4], [0.0; 4]);
    for four in numbers.chunks(4) {
        for ((sum, greatest), &number) in sums.iter_mut().zip(&mut greatest).zip(four) {
            *sum += number;
            *greatest = if number > *greatest {
                number
            } else {
                *greatest
            };
        }
    }
    let mean = sums.iter().sum::<f32>() / numbers.len() as f32;
    greatest.iter().fold(mean, |seen, g| seen.max(0.25 * g))
}

#[cfg(test)]
mod tests;
