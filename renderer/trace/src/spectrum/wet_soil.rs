//! Soil as it is when wet, from its reflectance when dry: the moisture part of the model of brightness,
//! shape and moisture (BSM).
//!
//! Water lies on parts of the soil as a film, on others as two or more, in number by a Poisson distribution. A film
//! reflects light at its face, holds light from below back, absorbs, and lets more light enter grains of soil.
//!
//! # Source
//!
//! \[verhoef2018\] and \[yang2020\]; `docs/src/theory/soil.md`.

use std::sync::OnceLock;

use optics::constituent::Constituent;
use optics::interface::Interface;
use optics::prospect_d::{FIRST_NM, LAST_NM, ProspectD};

use super::table::parse_shipped;

/// Refractive index of the grains' matter.
const GRAINS: f64 = 2.0;
/// Moisture by volume up to which soil is dry, percent.
const DRY: f64 = 5.0;
/// Moisture above that which adds a film on average, percent.
const CAPACITY: f64 = 25.0;
/// Effective thickness of a film, cm.
const FILM: f64 = 0.015;
/// Films on top of each other that are told apart.
const MOST_FILMS: i32 = 6;

/// Wavelengths in nm with the reflectance of a soil of a moisture by volume, percent, from its reflectance when dry; it
/// is linear between points. The result has a point for each nanometre where water is known, 400 to 2500 nm, and those of the
/// dry soil.
pub fn wetted(dry: &[(f64, f64)], moisture: f64) -> Vec<(f64, f64)> {
    let [Some(first), Some(last)] = [dry.first(), dry.last()].map(|end| end.map(|point| point.0))
    else {
        return Vec::new();
    };
    let whole = FIRST_NM.max(first).ceil() as u32..=LAST_NM.min(last).floor() as u32;
    let mut nm: Vec<f64> = whole
        .map(f64::from)
        .chain(dry.iter().map(|point| point.0))
        .collect();
    nm.sort_by(f64::total_cmp);
    nm.dedup();
    let index: Vec<(f64, f64)> = index_of_water().iter().map(|(nm, [n])| (*nm, *n)).collect();
    let wet = |nm: f64| {
        let absorption = ProspectD::coefficients_extrapolated(nm).absorption;
        let water = Interface::of_index(linear(&index, nm));
        (
            nm,
            reflectance(
                linear(dry, nm),
                water,
                absorption[Constituent::Water],
                moisture,
            ),
        )
    };
    nm.into_iter().map(wet).collect()
}

/// Reflectance of wet soil at one wavelength; the water absorbs so much, cm⁻¹.
fn reflectance(dry: f64, water: Interface, absorption: f64, moisture: f64) -> f64 {
    let films = (moisture - DRY) / CAPACITY;
    if films <= 0.0 {
        return dry;
    }
    // Grains in water lose less light at their faces than in air.
    let entering = |index: f64| Interface::of_index(index).t_av_90;
    let eased = entering(GRAINS / water.refractive_index) / entering(GRAINS);
    let below = 1.0 - (1.0 - dry) * (dry * eased + 1.0 - dry);
    let face = 1.0 - water.t_av_40;
    let held = 1.0 - water.transmissivity_from_inside();
    let mut share = libm::exp(-films);
    let mut sum = share * dry;
    for count in 1..=MOST_FILMS {
        share *= films / f64::from(count);
        let sent = below * libm::exp(-2.0 * absorption * FILM * f64::from(count));
        sum += share * (face + (1.0 - face) * (1.0 - held) * sent / (1.0 - held * sent));
    }
    sum
}

fn index_of_water() -> &'static [(f64, [f64; 1])] {
    static TABLE: OnceLock<Vec<(f64, [f64; 1])>> = OnceLock::new();
    TABLE.get_or_init(|| parse_shipped(include_str!("water.csv")))
}

/// Linear between points, with the end values outside.
fn linear(points: &[(f64, f64)], nm: f64) -> f64 {
    let above = points.partition_point(|point| point.0 <= nm);
    match (
        above.checked_sub(1).map(|below| points[below]),
        points.get(above),
    ) {
        (Some((from, low)), Some((to, high))) => low + (nm - from) / (to - from) * (high - low),
        (Some((_, end)), None) | (None, Some(&(_, end))) => end,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wet_soil_is_what_the_published_model_gives() {
        // Computed by a port of `soilwat` of SCOPE 2 (BSM.m, revision aa527e9) to Python, with 25 % and 0.015 cm.
        let soils = [
            (0.1, 1.337, 0.0),
            (0.3, 1.33, 0.02),
            (0.45, 1.3195, 28.6),
            (0.45, 1.3, 120.0),
            (0.9, 1.33, 0.0),
        ];
        for (moisture, expected) in [
            (4.0, [0.1, 0.3, 0.45, 0.45, 0.9]),
            (
                15.0,
                [
                    0.090_557_406,
                    0.263_666_711,
                    0.338_795_141,
                    0.309_324_69,
                    0.873_122_887,
                ],
            ),
            (
                30.0,
                [
                    0.081_889_084,
                    0.230_292_558,
                    0.225_803_861,
                    0.179_340_315,
                    0.848_398_688,
                ],
            ),
            (
                55.0,
                [
                    0.074_911_051,
                    0.203_739_167,
                    0.121_952_489,
                    0.078_191_269,
                    0.825_798_011,
                ],
            ),
        ] {
            for ((dry, n, absorption), expected) in soils.into_iter().zip(expected) {
                let found = reflectance(dry, Interface::of_index(n), absorption, moisture);
                assert!(
                    (found - expected).abs() < 1e-8,
                    "{moisture} {dry}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn water_shows_its_bands_in_a_soil_that_is_even_when_dry() {
        let even = [(350.0, 0.4), (2600.0, 0.4)];
        assert!(wetted(&even, 5.0).iter().all(|point| point.1 == 0.4));
        let wet = wetted(&even, 25.0);
        assert_eq!(
            (wet.len(), wet[0].0, wet[wet.len() - 1].0),
            (2103, 350.0, 2600.0)
        );
        let at = |nm: f64| {
            wet.iter()
                .find(|point| point.0 == nm)
                .expect("it is there")
                .1
        };
        assert!(at(1450.0) < at(1250.0) && at(1940.0) < at(1450.0) && at(550.0) < 0.4);
        assert!(wet.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert!(wet.iter().all(|point| (0.0..0.4).contains(&point.1)));
    }
}
