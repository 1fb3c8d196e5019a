//! The spectra of red, green and blue under a white.

use crate::spectrum::{Curve, Lanes, Table, WavelengthGrid, Wavelengths, rgb};

/// Range of curves, nm; it contains every wavelength of a film.
const CURVES_NM: [f64; 2] = [300.0, 2600.0];

/// Spectra of red, green and blue of 1, whose sum is that of a white.
#[derive(Clone, Debug)]
pub struct Primaries {
    white: Curve,
    table: Option<Table>,
}

impl Primaries {
    /// The primaries by [`rgb::basis_at`], times the spectrum of RGB 1 1 1.
    pub fn new(white: Curve) -> Self {
        Self { white, table: None }
    }

    /// Spectrum of RGB 1 1 1.
    pub fn white(&self) -> &Curve {
        &self.white
    }

    /// Evaluates them at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.table = Some(Table::new(grid, |nm| self.at(nm)));
    }

    /// Red, green and blue at a wavelength in nm.
    pub fn at(&self, nm: f32) -> [f32; 3] {
        rgb::basis_at(nm).map(|basis| basis * self.white.at(nm))
    }

    /// Red, green and blue as curves.
    pub fn curves(&self) -> [Curve; 3] {
        let [first, last] = CURVES_NM;
        [0, 1, 2].map(|primary| {
            Curve::uniform(first, 1.0, (last - first) as usize, |nm| {
                f64::from(self.at(nm as f32)[primary])
            })
        })
    }

    /// The spectrum of linear sRGB at a path's wavelengths.
    pub fn lanes<const N: usize>(
        &self,
        colour: [f32; 3],
        wavelengths: &Wavelengths<N>,
    ) -> Lanes<N> {
        let table = self.table.as_ref();
        let [red, green, blue] = table
            .and_then(|table| table.row(wavelengths))
            .unwrap_or_else(|| {
                let values = wavelengths.nm.map(|nm| self.at(nm));
                std::array::from_fn(|primary| Lanes::from_fn(|lane| values[lane][primary]))
            });
        red * colour[0] + green * colour[1] + blue * colour[2]
    }
}
