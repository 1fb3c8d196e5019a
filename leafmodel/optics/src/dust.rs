//! The optics of mineral dust: what a grain of it scatters.
//!
//! Dust is soil in small grains. A grain sends half of what it scatters to either side; a thick
//! layer of such grains then reflects `R = (1 − γ) / (1 + γ)` with `γ = √(1 − ω)` (two streams,
//! \[hapke1981\]), so that the albedo of one grain is `ω = 4 R / (1 + R)²` of the soil's
//! reflectance R.
//!
//! - **In**: the reflectance of the soil.
//! - **Out**: the single-scattering albedo, in [0, 1).
//! - **Left out**: size of grains; forward peaks; layers so thick that light meets several grains.

/// Greatest reflectance of a soil, however bright.
const MOST: f64 = 0.95;

/// Single-scattering albedo of a grain of soil that has this reflectance, 0.95 at most.
pub fn grain_albedo(soil: f64) -> f64 {
    let thick = soil.min(MOST);
    4.0 * thick / ((1.0 + thick) * (1.0 + thick))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_layers_of_grains_reflect_what_their_soil_does() {
        // Layers so thin that no light meets two grains in one of them, added up by the equations
        // of Stokes.
        for soil in [0.1, 0.25, 0.55, MOST] {
            let albedo = grain_albedo(soil);
            let met = 1e-3;
            let (mut r, mut t) = (0.5 * albedo * met, 1.0 - met + 0.5 * albedo * met);
            for _ in 0..24 {
                let again = 1.0 - r * r;
                (r, t) = (r + t * t * r / again, t * t / again);
            }
            assert!((r - soil).abs() < 5e-4, "{r} {soil}");
        }
    }

    #[test]
    fn no_soil_however_bright_makes_grains_gain() {
        for soil in [0.0, 0.3, 0.95, 1.4] {
            let albedo = grain_albedo(soil);
            assert!((0.0..1.0).contains(&albedo), "{albedo}");
        }
    }
}
