//! How the wavelengths of a colour picture are spread over its range.
//!
//! - **In**: the range of wavelengths and the observer.
//! - **Out**: shares of the range, one for each row and lane of the grid, and what the observer sees
//!   of each.
//! - **Always true**: the shares lie side by side and fill the range, so that whatever the density,
//!   what the observer sees of all is what it sees of the range: the density changes noise only.

use super::grid::{ROWS, Share};
use super::observer::Observer;
use super::observer::fit::reflectances;
use crate::spectrum::cie;

/// Wavelengths that a path of a colour picture carries: 4 are noisier; 16 give no improvement.
pub(super) const LANES: usize = 8;

/// The density proportional to sech²(a (λ − λ₀)) over a range of wavelengths, sampled by inversion.
///
/// The form is from \[radziszewski2009\]. Its constants minimise the variance of the colours of
/// leaves with eight wavelengths: R, T, R T and T² of nineteen presets under four lights. A density
/// that follows the observer (x̄ + ȳ + z̄) gives thirty times the variance.
#[derive(Clone, Debug)]
struct WideDistribution {
    /// tanh(a (λ − λ₀)) at both ends of the range.
    ends: [f64; 2],
}

impl WideDistribution {
    /// a, nm⁻¹.
    const SLOPE: f64 = 0.0045;
    /// λ₀, nm.
    const CENTRE: f64 = 520.0;

    /// The distribution over a range in nm, rising.
    fn new(range_nm: [f64; 2]) -> Self {
        Self {
            ends: range_nm.map(|nm| libm::tanh(Self::SLOPE * (nm - Self::CENTRE))),
        }
    }

    /// The wavelength, nm, below which a share `u` of the distribution lies, in [0, 1].
    fn draw(&self, u: f64) -> f64 {
        let [first, last] = self.ends;
        Self::CENTRE + libm::atanh(first + u * (last - first)) / Self::SLOPE
    }

    /// The share of the distribution below a wavelength in nm.
    fn below(&self, nm: f64) -> f64 {
        let [first, last] = self.ends;
        (libm::tanh(Self::SLOPE * (nm - Self::CENTRE)) - first) / (last - first)
    }
}

/// A density of wavelengths.
#[derive(Clone, Debug)]
pub(super) enum Distribution {
    /// Wide, whatever the observer sees.
    Wide(WideOnly),
    /// In part after the observer: wavelengths, nm, and the share below each.
    Mixed(Vec<(f64, f64)>),
}

/// Keeps the wide density to this module.
#[derive(Clone, Debug)]
pub(super) struct WideOnly(WideDistribution);

/// Shares of the density that may follow a camera's channels.
const FOLLOWING: [f64; 2] = [0.25, 0.5];

/// Step at which a mixed density is tabulated, nm.
const STEP_NM: f64 = 0.25;

impl Distribution {
    /// The density for a range in nm and an observer: the wide one for the CIE's, whose constants
    /// are made for it; for a camera, which may see narrow bands, the one of three with the least
    /// scatter.
    pub(super) fn of(range_nm: [f64; 2], observer: &Observer) -> Self {
        let wide = Self::Wide(WideOnly(WideDistribution::new(range_nm)));
        match observer {
            Observer::Cie1931 => wide,
            Observer::Camera(_) => {
                let mixed = FOLLOWING.map(|share| Self::mixed(range_nm, observer, share));
                let mut best = (scatter(&wide, observer), wide);
                for distribution in mixed.into_iter().flatten() {
                    let found = scatter(&distribution, observer);
                    if found < best.0 {
                        best = (found, distribution);
                    }
                }
                best.1
            }
        }
    }

    /// A density of which a share follows the mean of the observer's channels, each with the
    /// integral 1; `None` if one sees nothing of the range.
    fn mixed([first, last]: [f64; 2], observer: &Observer, share: f64) -> Option<Self> {
        let wide = WideDistribution::new([first, last]);
        let cells = ((last - first) / STEP_NM).ceil().max(1.0) as usize;
        let width = (last - first) / cells as f64;
        let middles = (0..cells).map(|cell| first + (cell as f64 + 0.5) * width);
        let seen: Vec<[f64; 3]> = middles.map(|nm| observer.channels_at(nm)).collect();
        let totals = [0, 1, 2].map(|i| seen.iter().map(|seen| seen[i]).sum::<f64>());
        if totals.iter().any(|total| *total <= 0.0) {
            return None;
        }
        let mut below = 0.0;
        let mut table = vec![(first, 0.0)];
        for (cell, seen) in seen.iter().enumerate() {
            below += (0..3).map(|i| seen[i] / totals[i] / 3.0).sum::<f64>();
            let nm = first + (cell as f64 + 1.0) * width;
            table.push((nm, (1.0 - share) * wide.below(nm) + share * below));
        }
        // Rounding must not leave a rest of the range out.
        table[cells] = (last, 1.0);
        Some(Self::Mixed(table))
    }

    /// The wavelength, nm, below which a share `u` of the distribution lies, in [0, 1].
    fn draw(&self, u: f64) -> f64 {
        match self {
            Self::Wide(WideOnly(wide)) => wide.draw(u),
            Self::Mixed(table) => {
                let above = table.partition_point(|(_, below)| *below < u);
                let above = above.clamp(1, table.len() - 1);
                let ((low, from), (high, to)) = (table[above - 1], table[above]);
                let share = ((u - from) / (to - from)).clamp(0.0, 1.0);
                low + share * (high - low)
            }
        }
    }
}

/// The shares of a density.
#[derive(Clone, Debug)]
pub(super) struct Shares(pub(super) Distribution);

impl Shares {
    /// The wavelength at a place within a lane, of which each row has 1.
    fn drawn(&self, row: f64, lane: usize) -> f64 {
        self.0
            .draw((lane as f64 + row / ROWS as f64) / LANES as f64)
    }

    /// The wavelength that stands for a share, nm.
    pub(super) fn middle(&self, row: usize, lane: usize) -> f64 {
        self.drawn(row as f64 + 0.5, lane)
    }

    /// A share with its wavelength.
    pub(super) fn share(&self, row: usize, lane: usize) -> Share {
        Share {
            nm: self.middle(row, lane) as f32,
            edges_nm: [row as f64, row as f64 + 1.0].map(|row| self.drawn(row, lane)),
        }
    }

    /// What is seen of a share in all. A wavelength represents its whole share: the observer is
    /// integrated over it. The factor of the number of rows allows for only one row being drawn.
    pub(super) fn integrated(
        &self,
        row: usize,
        lane: usize,
        seen_at: &dyn Fn(f64) -> [f64; 3],
    ) -> [f64; 3] {
        /// Number of places within a share at which the observer is evaluated.
        const STEPS: usize = 8;
        let first = self.drawn(row as f64, lane);
        let width = (self.drawn(row as f64 + 1.0, lane) - first) / STEPS as f64;
        let mut sum = [0.0; 3];
        for step in 0..STEPS {
            let seen = seen_at(first + (step as f64 + 0.5) * width);
            for (sum, seen) in sum.iter_mut().zip(seen) {
                *sum += seen * width;
            }
        }
        sum.map(|seen| seen * ROWS as f64)
    }
}

/// Mean square of the relative scatter of an observer's channels over the rows, for light of D65 that
/// surfaces of the training set have reflected.
fn scatter(distribution: &Distribution, observer: &Observer) -> f64 {
    /// Every tenth surface is looked at.
    const STRIDE: usize = 10;
    let shares = Shares(distribution.clone());
    let channels_at = |nm: f64| observer.channels_at(nm);
    let (mut sums, mut squares) = (Vec::new(), Vec::new());
    for row in 0..ROWS {
        let mut seen: Vec<[f64; 3]> = Vec::new();
        for lane in 0..LANES {
            let weights = shares.integrated(row, lane, &channels_at);
            let nm = shares.middle(row, lane);
            let surfaces = reflectances(nm);
            seen.resize(surfaces.len().div_ceil(STRIDE), [0.0; 3]);
            for (seen, share) in seen.iter_mut().zip(surfaces.iter().step_by(STRIDE)) {
                for (seen, weight) in seen.iter_mut().zip(weights) {
                    *seen += weight * share * cie::d65(nm);
                }
            }
        }
        sums.resize(3 * seen.len(), 0.0);
        squares.resize(3 * seen.len(), 0.0);
        for (i, value) in seen.into_iter().flatten().enumerate() {
            sums[i] += value;
            squares[i] += value * value;
        }
    }
    let relative = sums.iter().zip(&squares).map(|(sum, square)| {
        let mean: f64 = sum / ROWS as f64;
        (square / ROWS as f64 / (mean * mean) - 1.0).max(0.0)
    });
    relative.sum::<f64>() / sums.len() as f64
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::spectrum::observer::Camera;

    /// A camera that sees three bands of this full width at half of the maximum.
    fn of_bands(width_nm: f64) -> Observer {
        let rows = (380..=780).map(f64::from).map(|nm| {
            let bell = |middle: f64| {
                let off = (nm - middle) / (width_nm / 2.355);
                libm::exp(-0.5 * off * off)
            };
            (nm, [620.0, 540.0, 460.0].map(bell))
        });
        let camera = Camera::new("bands", rows.collect()).expect("it is one");
        Observer::Camera(Arc::new(camera))
    }

    fn all() -> impl Iterator<Item = (String, Observer)> {
        let shipped = Observer::names().map(|name| {
            let observer = Observer::by_name(name).expect("it is shipped");
            (name.to_owned(), observer)
        });
        shipped.chain([10.0, 20.0].map(|nm| (format!("{nm} nm"), of_bands(nm))))
    }

    #[test]
    fn shares_fill_the_range_whatever_the_density() {
        for (name, observer) in all() {
            let range = [400.0, 780.0];
            let mut distributions = vec![Distribution::of(range, &observer)];
            distributions.extend(FOLLOWING.map(|share| {
                Distribution::mixed(range, &observer, share).expect("it sees something")
            }));
            for distribution in distributions {
                let shares = Shares(distribution);
                let mut seen = [0.0; 3];
                let mut last = range[0];
                for place in 0..LANES * ROWS {
                    let (row, lane) = (place % ROWS, place / ROWS);
                    let middle = shares.middle(row, lane);
                    assert!(middle > last, "{name}: {middle} behind {last}");
                    last = middle;
                    let of_share = shares.integrated(row, lane, &|nm| observer.channels_at(nm));
                    for (sum, value) in seen.iter_mut().zip(of_share) {
                        *sum += value / ROWS as f64;
                    }
                }
                assert!((shares.drawn(ROWS as f64, LANES - 1) - range[1]).abs() < 1e-9);
                let mut expected = [0.0; 3];
                for step in 0..38_000 {
                    let nm = range[0] + (f64::from(step) + 0.5) * 0.01;
                    for (sum, value) in expected.iter_mut().zip(observer.channels_at(nm)) {
                        *sum += 0.01 * value;
                    }
                }
                for (one, other) in seen.into_iter().zip(expected) {
                    assert!((one / other - 1.0).abs() < 1e-4, "{name}: {one} {other}");
                }
            }
        }
    }

    #[test]
    fn narrow_bands_are_followed_and_scatter_far_less() {
        let range = [400.0, 780.0];
        let wide = Distribution::Wide(WideOnly(WideDistribution::new(range)));
        for (width, least) in [(10.0, 25.0), (20.0, 9.0)] {
            let observer = of_bands(width);
            let chosen = Distribution::of(range, &observer);
            assert!(matches!(chosen, Distribution::Mixed(_)), "{width} nm");
            let ratio = scatter(&wide, &observer) / scatter(&chosen, &observer);
            assert!(ratio > least, "{width} nm: {ratio} of the variance is gone");
        }
        for name in Observer::names() {
            let observer = Observer::by_name(name).expect("it is shipped");
            let chosen = scatter(&Distribution::of(range, &observer), &observer);
            assert!(chosen <= scatter(&wide, &observer), "{name}");
            // Of the order of what the CIE's functions have, 0.02 squared.
            assert!(chosen.sqrt() < 0.08, "{name}: {}", chosen.sqrt());
        }
    }
}
