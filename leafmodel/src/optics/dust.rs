//! The optics of mineral dust: what a grain of it scatters.
//!
//! Dust is soil in small grains. A grain sends half of what it scatters to either side; a thick
//! layer of such grains then reflects `R = (1 − γ) / (1 + γ)` with `γ = √(1 − ω)` (two streams,
//! \[hapke1981\]), so that the albedo of one grain is `ω = 4 R / (1 + R)²` of the soil's
//! reflectance R.
//!
//! - **In**: a wavelength, a factor on the soil's reflectance.
//! - **Out**: the single-scattering albedo, in [0, 1).
//! - **Left out**: size of grains; forward peaks; layers so thick that light meets several grains.

/// Reflectance of a dry soil from 400 to 2500 nm in steps of 50 nm: the dry soil of PROSAIL
/// (\[jacquemoud2009\]), whose table has whole nanometres, taken at these.
const DRY_SOIL: [f64; 43] = [
    0.238, 0.222, 0.233, 0.259, 0.283, 0.308, 0.336, 0.363, 0.386, 0.408, 0.425, 0.442, 0.456,
    0.463, 0.472, 0.479, 0.486, 0.493, 0.499, 0.500, 0.493, 0.500, 0.504, 0.508, 0.510, 0.510,
    0.510, 0.510, 0.510, 0.511, 0.509, 0.490, 0.498, 0.508, 0.506, 0.501, 0.482, 0.490, 0.487,
    0.477, 0.472, 0.457, 0.446,
];
/// First wavelength of the table, nm.
const FIRST_NM: f64 = 400.0;
/// Step of the table, nm.
const STEP_NM: f64 = 50.0;
/// Greatest reflectance of a soil, however bright.
const MOST: f64 = 0.95;

/// Reflectance of a thick layer of dust at a wavelength, nm, for soil so many times as bright;
/// beyond the table that of its ends.
pub fn soil_reflectance(nm: f64, brightness: f64) -> f64 {
    let place = ((nm - FIRST_NM) / STEP_NM).clamp(0.0, (DRY_SOIL.len() - 1) as f64);
    let low = (place as usize).min(DRY_SOIL.len() - 2);
    let share = place - low as f64;
    let soil = DRY_SOIL[low] + share * (DRY_SOIL[low + 1] - DRY_SOIL[low]);
    (brightness * soil).min(MOST)
}

/// Single-scattering albedo of a grain at a wavelength, nm, of soil so many times as bright.
pub fn grain_albedo(nm: f64, brightness: f64) -> f64 {
    let thick = soil_reflectance(nm, brightness);
    4.0 * thick / ((1.0 + thick) * (1.0 + thick))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_layers_of_grains_reflect_what_their_soil_does() {
        // Layers so thin that no light meets two grains in one of them, added up by the equations
        // of Stokes.
        for nm in [450.0, 550.0, 680.0, 850.0, 1650.0] {
            let albedo = grain_albedo(nm, 1.0);
            let met = 1e-3;
            let (mut r, mut t) = (0.5 * albedo * met, 1.0 - met + 0.5 * albedo * met);
            for _ in 0..24 {
                let again = 1.0 - r * r;
                (r, t) = (r + t * t * r / again, t * t / again);
            }
            let soil = soil_reflectance(nm, 1.0);
            assert!((r - soil).abs() < 5e-4, "{r} {soil} at {nm} nm");
        }
    }

    #[test]
    fn soil_is_redder_than_grey_and_no_brightness_makes_grains_gain() {
        assert!(soil_reflectance(700.0, 1.0) > 1.3 * soil_reflectance(450.0, 1.0));
        for nm in [300.0, 400.0, 1234.0, 2500.0, 3000.0] {
            for brightness in [0.1, 1.0, 1.5] {
                let albedo = grain_albedo(nm, brightness);
                assert!((0.0..1.0).contains(&albedo), "{albedo}");
            }
        }
    }
}
