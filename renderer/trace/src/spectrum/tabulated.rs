//! Functions of wavelength, evaluated in advance at all wavelengths of a picture's paths.

use std::fmt;

use crate::spectrum::curve::Curve;
use crate::spectrum::grid::{WavelengthGrid, Wavelengths};
use crate::spectrum::lanes::Lanes;

/// Several values at each wavelength of a grid, by row of the grid, value and lane.
#[derive(Clone, PartialEq)]
pub struct Table(Box<[f32]>);

impl fmt::Debug for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Table of {} numbers", self.0.len())
    }
}

impl Table {
    /// The table of the values of `f` at each wavelength in nm.
    pub fn new<const C: usize>(grid: &WavelengthGrid, mut f: impl FnMut(f32) -> [f32; C]) -> Self {
        let lanes = grid.lanes();
        Self::by_place(grid, |row, lane| f(grid.nm()[row * lanes + lane]))
    }

    /// The table of the values of `f` for each row and lane.
    pub fn by_place<const C: usize>(
        grid: &WavelengthGrid,
        mut f: impl FnMut(usize, usize) -> [f32; C],
    ) -> Self {
        let lanes = grid.lanes();
        let mut values = vec![0.0; grid.nm().len() * C];
        for (row, values) in values.chunks_exact_mut(lanes * C).enumerate() {
            for lane in 0..lanes {
                for (column, value) in f(row, lane).into_iter().enumerate() {
                    values[column * lanes + lane] = value;
                }
            }
        }
        Self(values.into())
    }

    /// The `C` values at a path's wavelengths; `None` if these are not of the grid.
    #[inline]
    pub fn row<const N: usize, const C: usize>(
        &self,
        wavelengths: &Wavelengths<N>,
    ) -> Option<[Lanes<N>; C]> {
        let start = wavelengths.row() * (N * C);
        let values = self.0.get(start..start + N * C)?;
        let mut row = [Lanes::ZERO; C];
        for (lanes, values) in row.iter_mut().zip(values.chunks_exact(N)) {
            lanes.0.copy_from_slice(values);
        }
        Some(row)
    }
}

/// A spectrum for paths: a curve and, once tabulated, its values at the wavelengths of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    curve: Curve,
    table: Option<Table>,
}

impl From<Curve> for Spectrum {
    fn from(curve: Curve) -> Self {
        Self { curve, table: None }
    }
}

impl Spectrum {
    /// The curve.
    pub fn curve(&self) -> &Curve {
        &self.curve
    }

    /// Evaluates it at every wavelength of a grid, as the mean over what that represents.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.table = match &self.curve {
            Curve::Constant(_) => None,
            Curve::Uniform { .. } | Curve::Points { .. } => {
                Some(Table::by_place(grid, |row, lane| {
                    [self.curve.over(&grid.share(row, lane))]
                }))
            }
        };
    }

    /// Values at a path's wavelengths.
    #[inline]
    pub fn lanes<const N: usize>(&self, wavelengths: &Wavelengths<N>) -> Lanes<N> {
        let row = self.table.as_ref().and_then(|table| table.row(wavelengths));
        row.map_or_else(|| self.curve.lanes(wavelengths), |[lanes]| lanes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::WavelengthSampler;
    use crate::spectrum::grid::ROWS;
    use crate::spectrum::recorded::FilmKind;

    #[test]
    fn a_tabulated_spectrum_has_the_values_of_its_curve_where_that_is_straight() {
        let sampler = WavelengthSampler::new(&FilmKind::Rgb {
            range_nm: [360.0, 830.0],
            observer: crate::spectrum::observer::Observer::Cie1931,
        });
        let curve = Curve::from_points(&[(400.0, 0.0), (500.0, 1.0), (520.0, 0.5)]);
        let mut spectrum = Spectrum::from(curve.clone());
        for tabulated in [false, true] {
            if tabulated {
                spectrum.tabulate(sampler.grid());
            }
            for row in 0..ROWS {
                let drawn = sampler.draw::<8>((row as f32 + 0.5) / ROWS as f32, 0);
                let table = spectrum.lanes(&drawn);
                let straight = |lane: &usize| {
                    let [first, last] = sampler.grid().share(row, *lane).edges_nm;
                    ![400.0, 500.0, 520.0]
                        .iter()
                        .any(|nm| first < *nm && *nm < last)
                };
                for lane in (0..8).filter(straight) {
                    assert_eq!(table.0[lane], curve.lanes(&drawn).0[lane]);
                }
                let free = Wavelengths::new(drawn.nm);
                assert_eq!(spectrum.lanes(&free), curve.lanes(&drawn));
            }
        }
    }

    #[test]
    fn lines_narrower_than_a_share_are_recorded_whole_wherever_they_lie() {
        let rgb = FilmKind::Rgb {
            range_nm: [360.0, 830.0],
            observer: crate::spectrum::observer::Observer::Cie1931,
        };
        let sampler = WavelengthSampler::new(&rgb);
        for step in 0..40 {
            // A triangle of area 10 at one of places that are 0.05 nm apart.
            let nm = 550.0 + 0.05 * f64::from(step);
            for half in [0.1, 0.01, 0.001] {
                let top = 10.0 / half;
                let points = [(nm - half, 0.0), (nm, top), (nm + half, 0.0)];
                let curve = Curve::from_points(&points);
                let found = sampler.recorded(&|share| curve.over(share).into());
                let seen = crate::spectrum::observer::Observer::Cie1931.srgb_at(nm);
                let most = seen.iter().fold(0.0_f64, |most, seen| most.max(seen.abs()));
                for (found, seen) in found.into_iter().zip(seen) {
                    // What the observer sees changes within a share.
                    let off = (found - 10.0 * seen).abs();
                    assert!(off < 4e-3 * 10.0 * most, "{nm} {half}: {found} {seen}");
                }
            }
        }
    }
}
