//! Measured reflectance of grounds and walls, and of soil by its moisture.
//!
//! Sources and licences are told in `NOTICE.md` and in `docs/src/format/spectrum.md`.

use std::sync::OnceLock;

use crate::spectrum::table::parse_shipped;

/// Names of the measured surfaces, in the order of their columns.
pub const SURFACES: [&str; 12] = [
    "brick-red",
    "brick-light-red",
    "brick-grey-red",
    "brick-yellow-grey",
    "cement",
    "concrete",
    "granite",
    "limestone",
    "sandstone",
    "slate",
    "slate-weathered",
    "roof-tile-red",
];

fn surfaces() -> &'static [(f64, [f64; 12])] {
    static TABLE: OnceLock<Vec<(f64, [f64; 12])>> = OnceLock::new();
    TABLE.get_or_init(|| parse_shipped(include_str!("surfaces.csv")))
}

fn soils() -> &'static [(f64, [f64; 2])] {
    static TABLE: OnceLock<Vec<(f64, [f64; 2])>> = OnceLock::new();
    TABLE.get_or_init(|| parse_shipped(include_str!("soil.csv")))
}

/// The reflectance of a measured surface by its number in [`SURFACES`]: pairs of a wavelength in nm,
/// 355 to 2500, and a share.
///
/// # Panics
///
/// If there is no such number.
pub fn surface(number: usize) -> Vec<(f64, f64)> {
    let rows = surfaces().iter();
    rows.map(|(nm, values)| (*nm, values[number])).collect()
}

/// The reflectance of bare soil of a moisture of 0 (dry) to 1 (wet): pairs of a wavelength in nm, 360
/// to 2500, and a fraction.
///
/// `ρ = m ρ_wet + (1 − m) ρ_dry`, where `ρ_dry` and `ρ_wet` are means over the same 100 soils
/// (\[wadoux2021\], \[minasny2011\]).
pub fn soil(moisture: f64) -> Vec<(f64, f64)> {
    let mixed = |[dry, wet]: [f64; 2]| moisture * wet + (1.0 - moisture) * dry;
    soils()
        .iter()
        .map(|(nm, values)| (*nm, mixed(*values)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(points: &[(f64, f64)], nm: f64) -> f64 {
        points
            .iter()
            .find(|point| point.0 == nm)
            .expect("it is in the table")
            .1
    }

    #[test]
    fn every_surface_covers_the_solar_range_with_shares() {
        for number in 0..SURFACES.len() {
            let points = surface(number);
            assert_eq!((points[0].0, points[points.len() - 1].0), (355.0, 2500.0));
            assert!(points.windows(2).all(|pair| pair[0].0 < pair[1].0));
            assert!(points.iter().all(|point| (0.01..0.9).contains(&point.1)));
        }
    }

    #[test]
    fn water_darkens_soil_most_in_its_bands() {
        let [dry, half, wet] = [0.0, 0.5, 1.0].map(soil);
        for ((a, b), c) in dry.iter().zip(&half).zip(&wet) {
            assert!(a.1 > c.1 && (b.1 - 0.5 * (a.1 + c.1)).abs() < 1e-12);
        }
        assert_eq!((dry[0].0, dry[dry.len() - 1].0), (360.0, 2500.0));
        // Water absorbs at 1450 and 1940 nm.
        let ratio = |nm: f64| at(&wet, nm) / at(&dry, nm);
        assert!(ratio(1450.0) < ratio(1250.0) && ratio(1940.0) < ratio(1700.0));
    }

    #[test]
    fn wet_soil_is_darker_than_dry_soil_below_a_film_of_water_by_one_factor() {
        // Ångström (1925): of what the soil sends up, the film lets 1 / n² out and sends the rest
        // back. He leaves out that water also lies between the grains, where it makes them scatter
        // more forwards; so measured soil is darker, and alike at all wavelengths at which water
        // hardly absorbs.
        let below_water = |dry: f64| dry / (1.33 * 1.33 * (1.0 - dry) + dry);
        let [dry, wet] = [0.0, 1.0].map(soil);
        for (dry, wet) in dry.iter().zip(&wet).filter(|(dry, _)| dry.0 <= 1300.0) {
            let factor = wet.1 / below_water(dry.1);
            assert!((0.78..0.90).contains(&factor), "{factor} at {} nm", dry.0);
        }
    }

    #[test]
    fn bricks_are_redder_than_slate_and_cement() {
        let redness = |name: &str| {
            let number = SURFACES.iter().position(|known| *known == name);
            let points = surface(number.expect("a name"));
            at(&points, 650.0) / at(&points, 500.0)
        };
        for brick in ["brick-red", "brick-light-red"] {
            assert!(redness(brick) > 2.0);
        }
        assert!(redness("slate") < 1.1 && redness("cement") < 1.3);
    }
}
