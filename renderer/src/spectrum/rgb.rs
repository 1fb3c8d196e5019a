//! Spectra for RGB pictures. This is the only conversion from colour to spectrum.
//!
//! Linear sRGB `(r, g, b)` becomes `r bᵣ(λ) + g b_g(λ) + b b_b(λ)` with three smooth basis spectra
//! that sum to one and whose colours under D65 are the sRGB primaries (after Mallett and Yuksel
//! 2019, computed for this project by `reference/make_tables.py`). The conversion is linear, so it
//! commutes with filtering, and reflectances in [0, 1] stay there.

use std::sync::OnceLock;

use crate::spectrum::table::parse_shipped;

fn basis_table() -> &'static [(f64, [f64; 3])] {
    static TABLE: OnceLock<Vec<(f64, [f64; 3])>> = OnceLock::new();
    TABLE.get_or_init(|| parse_shipped(include_str!("rgb_basis.csv")))
}

/// The three basis spectra at a wavelength in nm; the end values hold outside the table.
pub fn basis_at(nm: f32) -> [f32; 3] {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::cie;

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
