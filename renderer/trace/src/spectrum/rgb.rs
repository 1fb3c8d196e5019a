//! Spectra for RGB pictures. This is the only conversion from colour to spectrum.
//!
//! Linear sRGB `(r, g, b)` becomes `r bᵣ(λ) + g b_g(λ) + b b_b(λ)` with three smooth basis spectra
//! that sum to one and whose colours under D65 are the sRGB primaries (after Mallett and Yuksel
//! 2019, computed for this project by `reference/run tables`). The conversion is linear, so it
//! commutes with filtering, and reflectances in [0, 1] stay there.

use std::sync::OnceLock;

use crate::spectrum::curve::Curve;
use crate::spectrum::grid::{Share, WavelengthGrid, Wavelengths};
use crate::spectrum::lanes::Lanes;
use crate::spectrum::table::parse_shipped;
use crate::spectrum::tabulated::Table;

/// First and last wavelength of the basis, nm; RGB says nothing of light beyond.
pub const RANGE_NM: [f64; 2] = [360.0, 830.0];

/// Range of curves, nm; it contains every wavelength of a film.
const CURVES_NM: [f64; 2] = [300.0, 2600.0];

fn basis_table() -> &'static [(f64, [f64; 3])] {
    static TABLE: OnceLock<Vec<(f64, [f64; 3])>> = OnceLock::new();
    TABLE.get_or_init(|| parse_shipped(include_str!("rgb_basis.csv")))
}

/// The three basis spectra at a wavelength in nm; the end values hold outside the table.
pub(crate) fn basis_at(nm: f32) -> [f32; 3] {
    let table = basis_table();
    let first = table[0].0 as f32;
    let step = (table[1].0 - table[0].0) as f32;
    let place = ((nm - first) / step).clamp(0.0, (table.len() - 1) as f32);
    let below = (place as usize).min(table.len() - 2);
    let share = place - below as f32;
    std::array::from_fn(|i| {
        table[below].1[i] as f32 * (1.0 - share) + table[below + 1].1[i] as f32 * share
    })
}

/// The basis as it ships: `wavelength_nm,red,green,blue`, with comments.
pub fn basis_text() -> &'static str {
    include_str!("rgb_basis.csv")
}

/// The spectra of red, green and blue of 1 under some light.
#[derive(Clone, Debug)]
pub struct Primaries {
    white: Curve,
    table: Option<Table>,
}

impl Primaries {
    /// Primaries of which RGB 1 1 1 has the spectrum `white`.
    pub fn new(white: Curve) -> Self {
        Self { white, table: None }
    }

    /// Spectrum of RGB 1 1 1.
    pub fn white(&self) -> &Curve {
        &self.white
    }

    /// Evaluates them at every wavelength of a grid.
    pub fn tabulate(&mut self, grid: &WavelengthGrid) {
        self.table = Some(Table::by_place(grid, |row, lane| {
            self.over(&grid.share(row, lane))
        }));
    }

    /// Red, green and blue as curves over every wavelength of a film.
    pub fn curves(&self) -> [Curve; 3] {
        let [first, last] = CURVES_NM;
        [0, 1, 2].map(|primary| {
            Curve::uniform(first, 1.0, (last - first) as usize, |nm| {
                f64::from(self.over(&Share::only(nm as f32))[primary])
            })
        })
    }

    /// Means over what a wavelength represents.
    pub fn over(&self, share: &Share) -> [f32; 3] {
        let white = self.white.over(share);
        basis_at(share.nm).map(|basis| basis * white)
    }

    /// The spectrum of a linear colour at a path's wavelengths.
    #[inline]
    pub fn spectrum<const N: usize>(
        &self,
        [r, g, b]: [f32; 3],
        wavelengths: &Wavelengths<N>,
    ) -> Lanes<N> {
        let row = self.table.as_ref().and_then(|table| table.row(wavelengths));
        let [red, green, blue] = row.unwrap_or_else(|| {
            let values = wavelengths.nm.map(|nm| self.over(&Share::only(nm)));
            std::array::from_fn(|primary| Lanes::from_fn(|lane| values[lane][primary]))
        });
        red * r + green * g + blue * b
    }
}

/// Fraction of luminance in each channel of linear sRGB.
pub const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Luminance of linear sRGB.
pub fn luminance(colour: [f64; 3]) -> f64 {
    let channels = colour.into_iter().zip(LUMINANCE);
    channels.map(|(value, weight)| value * weight).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::cie;

    #[test]
    fn the_basis_covers_what_is_said_of_it() {
        let table = basis_table();
        assert_eq!([table[0].0, table[table.len() - 1].0], RANGE_NM);
    }

    #[test]
    fn no_colour_of_a_picture_reflects_more_than_comes_in_or_changes_its_look() {
        let white = cie::xyz_of(cie::d65)[1];
        let mut worst = 0.0_f64;
        let levels = [0.0_f32, 0.02, 0.3, 0.7, 1.0];
        for colour in (0..125).map(|i| [levels[i / 25], levels[i / 5 % 5], levels[i % 5]]) {
            let primaries = Primaries::new(Curve::Constant(1.0));
            let reflectance =
                |nm: f64| primaries.spectrum(colour, &Wavelengths::new([nm as f32])).0[0];
            for nm in (360..=830).map(f64::from) {
                let share = reflectance(nm);
                assert!((0.0..=1.0 + 1e-6).contains(&share), "{colour:?}: {share}");
            }
            let xyz = cie::xyz_of(|nm| cie::d65(nm) / white * f64::from(reflectance(nm)));
            for (back, given) in cie::srgb_from_xyz(xyz).into_iter().zip(colour) {
                worst = worst.max((back - f64::from(given)).abs());
            }
        }
        eprintln!("linear sRGB comes back within {worst:.1e}");
        // White comes back as far off: the white of sRGB is D65 with its chromaticity rounded.
        assert!(worst < 3e-4, "{worst}");
    }

    #[test]
    fn a_colour_survives_the_way_to_a_spectrum_and_back_under_d65() {
        let white = cie::xyz_of(cie::d65)[1];
        for colour in [
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.2, 0.5, 0.8],
        ] {
            let xyz = cie::xyz_of(|nm| {
                let basis = basis_at(nm as f32);
                let reflectance: f64 = (0..3).map(|i| colour[i] * f64::from(basis[i])).sum();
                cie::d65(nm) / white * reflectance
            });
            let back = cie::srgb_from_xyz(xyz);
            for i in 0..3 {
                assert!(
                    (back[i] - colour[i]).abs() < 2e-3,
                    "{colour:?} came back as {back:?}"
                );
            }
        }
    }

    #[test]
    fn the_basis_is_a_partition_of_one_without_negative_parts() {
        for (nm, values) in basis_table() {
            assert!(
                (values.iter().sum::<f64>() - 1.0).abs() < 1e-5,
                "at {nm} nm: {values:?}"
            );
            assert!(
                values.iter().all(|&value| value >= 0.0),
                "at {nm} nm: {values:?}"
            );
        }
    }
}
