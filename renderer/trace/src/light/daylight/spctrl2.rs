//! Irradiance by the sun and by a clear sky at the ground, 300 to 2600 nm.
//!
//! # Source
//!
//! SPCTRL2, \[bird1984\] (equations by their numbers there) as its authors' later program has it:
//! 1.3366 in 2-4, 118.3 in 2-11, the mixed gases instead of ozone in 3-8, and the air mass of
//! \[kasten1989\].

use document::declared::{Declared, Defaults};

use crate::spectrum::table::parse_shipped;

/// What lies between the sun and the ground.
///
/// The default is a clear day in the middle latitudes: the water vapour and ozone of the standard atmosphere
/// of the United States (1976), at the mean distance of the sun.
#[derive(Clone, Copy, Debug, Declared, Defaults, PartialEq)]
pub struct Atmosphere {
    /// Extinction by the hazy air over that by pure air: 2 very clear, 3 clear, 6 warm and moist, 10 hazy.
    ///
    /// Turbidity of \[preetham1999\].
    #[key("turbidity", 2.0..=10.0, default = 3.0)]
    pub turbidity: f64,
    /// Ozone above the place, as the height of the pure gas (100 Dobson units are 0.1).
    ///
    /// Centimetres at standard pressure and temperature.
    #[key("ozone_atm_cm", 0.0..=1.0, default = 0.344)]
    pub ozone_cm: f64,
    /// Water vapour above the place, as the height of the liquid.
    #[key("water_vapour_cm", 0.0..=10.0, default = 1.42)]
    pub water_cm: f64,
    /// Air pressure at the place: 1013 at the sea, 795 at 2000 m.
    #[key("pressure_hpa", 300.0..=1100.0, default = 1013.25)]
    pub pressure_hpa: f64,
    /// Share of light that the ground far around reflects. It brightens the sky, and the directions below the
    /// horizon shine with it.
    #[key("ground_albedo", 0.0..=1.0, default = 0.2)]
    pub ground_albedo: f64,
    /// Irradiance outside of the air over that at the mean distance of the sun.
    #[key(default = 1.0)]
    pub distance_factor: f64,
}

/// Spectral irradiance at one wavelength, W m⁻² nm⁻¹.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irradiance {
    /// Wavelength, nm.
    pub nm: f64,
    /// By the sun alone on a surface that faces it.
    pub direct: f64,
    /// By the sky alone on a horizontal surface.
    pub diffuse: f64,
}

/// Ångström's exponent of rural aerosol.
const ALPHA: f64 = 1.14;
/// Share that aerosol scatters of what it takes at 400 nm, and how that falls.
const SCATTERED_AT_400_NM: f64 = 0.945;
const SCATTERED_FALLS: f64 = 0.095;
/// Mean cosine of scattering by aerosol.
const ASYMMETRY: f64 = 0.65;
/// Pressure to which the air mass refers, Pa.
const STANDARD_PA: f64 = 101_300.0;
/// Air mass that light from the ground meets on its way up.
const MASS_FROM_GROUND: f64 = 1.8;

/// Irradiance outside of the air over that at the mean distance, on a day of the year from 1.
/// Equation 2-2 (Spencer 1971).
pub fn distance_factor(day_of_year: u32) -> f64 {
    let angle = std::f64::consts::TAU * (f64::from(day_of_year) - 1.0) / 365.0;
    let (sin, cos) = libm::sincos(angle);
    let (sin2, cos2) = libm::sincos(2.0 * angle);
    1.00011 + 0.034221 * cos + 0.00128 * sin + 0.000719 * cos2 + 0.000077 * sin2
}

/// The share that passes each part of the air.
struct Transmittances {
    rayleigh: f64,
    aerosol: f64,
    water: f64,
    ozone: f64,
    mixed: f64,
    /// By scattering of aerosol alone, and by absorption of aerosol alone.
    scattering: f64,
    absorption: f64,
}

impl Atmosphere {
    /// Optical depth of aerosol at 500 nm: Ångström's β of \[preetham1999\] with our exponent.
    fn aerosol_depth(&self) -> f64 {
        (0.04608 * self.turbidity - 0.04586) * libm::pow(0.5, -ALPHA)
    }

    fn transmittances(
        &self,
        row: &[f64; 4],
        nm: f64,
        mass: f64,
        cos_zenith: f64,
    ) -> Transmittances {
        let [_, water, ozone, mixed] = *row;
        let um2 = nm * nm * 1e-6;
        let pressure_mass = mass * (self.pressure_hpa * 100.0) / STANDARD_PA;
        let depth = self.aerosol_depth() * libm::pow(nm / 500.0, -ALPHA);
        let log = libm::log(nm / 400.0);
        let scattered = SCATTERED_AT_400_NM * libm::exp(-SCATTERED_FALLS * log * log);
        let absorbed = |k: f64, a: f64, b: f64| libm::exp(-a * k / libm::pow(1.0 + b * k, 0.45));
        // Ozone lies 22 km high. 2-10.
        let height = 22.0 / 6370.0;
        let ozone_mass = (1.0 + height) / (cos_zenith * cos_zenith + 2.0 * height).sqrt();
        Transmittances {
            rayleigh: libm::exp(-pressure_mass / (um2 * um2 * (115.6406 - 1.3366 / um2))),
            aerosol: libm::exp(-depth * mass),
            water: absorbed(water * self.water_cm * mass, 0.2385, 20.07),
            ozone: libm::exp(-ozone * self.ozone_cm * ozone_mass),
            mixed: absorbed(mixed * pressure_mass, 1.41, 118.3),
            scattering: libm::exp(-scattered * depth * mass),
            absorption: libm::exp(-(1.0 - scattered) * depth * mass),
        }
    }

    /// Irradiance with the sun at an elevation, rad, above the horizon.
    pub fn irradiance(&self, elevation: f64) -> Vec<Irradiance> {
        let table = parse_shipped::<4>(include_str!("spctrl2.csv"));
        let cos_zenith = libm::sin(elevation);
        let degrees = elevation.to_degrees();
        let mass = 1.0 / (cos_zenith + 0.50572 * libm::pow(degrees + 6.07995, -1.6364));
        let log = libm::log(1.0 - ASYMMETRY);
        let a = log * (1.459 + log * (0.1595 + log * 0.4129));
        let b = log * (0.0783 + log * (-0.3824 - log * 0.5874));
        let forward = |cos: f64| 1.0 - 0.5 * libm::exp((a + b * cos) * cos);
        let at = |(nm, row): &(f64, [f64; 4])| {
            let t = self.transmittances(row, *nm, mass, cos_zenith);
            let sent = row[0] * self.distance_factor;
            let direct = sent * t.rayleigh * t.aerosol * t.water * t.ozone * t.mixed;
            // 3-5 and 3-6.
            let common = sent * cos_zenith * t.ozone * t.mixed * t.water * t.absorption;
            let by_air = common * (1.0 - libm::pow(t.rayleigh, 0.95)) * 0.5;
            let by_aerosol =
                common * libm::pow(t.rayleigh, 1.5) * (1.0 - t.scattering) * forward(cos_zenith);
            // What the sky sends back of light from the ground, 3-7 and 3-8.
            let up = self.transmittances(row, *nm, MASS_FROM_GROUND, cos_zenith);
            let back_by_aerosol =
                (1.0 - forward(1.0 / MASS_FROM_GROUND)) * up.rayleigh * (1.0 - up.scattering);
            let sky_albedo =
                up.mixed * up.water * up.absorption * (0.5 * (1.0 - up.rayleigh) + back_by_aerosol);
            let returned = sky_albedo * self.ground_albedo;
            let by_ground =
                (direct * cos_zenith + by_air + by_aerosol) * returned / (1.0 - returned);
            // 3-17.
            let correction = if *nm <= 450.0 {
                libm::pow((nm + 550.0) * 1e-3, 1.8)
            } else {
                1.0
            };
            Irradiance {
                nm: *nm,
                direct,
                diffuse: (by_air + by_aerosol + by_ground) * correction,
            }
        };
        table.iter().map(at).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn irradiance_is_that_of_pvlib_in_every_band() {
        let text = include_str!("../../../fixtures/daylight_reference.csv");
        let cases: Vec<Vec<f64>> = text
            .lines()
            .filter_map(|line| line.strip_prefix("# case "))
            .map(|line| {
                let (_, numbers) = line.split_once(": ").expect("numbers after the colon");
                let numbers = numbers.split("; ").map(|f| f.parse().expect("a number"));
                numbers.collect()
            })
            .collect();
        assert_eq!(cases.len(), 7);
        let ours: Vec<Vec<Irradiance>> = cases
            .iter()
            .map(|case| {
                let atmosphere = Atmosphere {
                    turbidity: case[1],
                    ozone_cm: case[2],
                    water_cm: case[3],
                    pressure_hpa: case[4] / 100.0,
                    ground_albedo: case[5],
                    distance_factor: distance_factor(case[6] as u32),
                };
                atmosphere.irradiance(case[0].to_radians())
            })
            .collect();
        let table = parse_shipped::<3>(text);
        assert!(table.len() > 500, "{}", table.len());
        for (nm, [case, direct, diffuse]) in table {
            let rows = &ours[case as usize];
            let row = rows
                .iter()
                .find(|row| row.nm == nm)
                .expect("the same bands");
            let near = |one: f64, other: f64| (one - other).abs() <= 1e-3 * other + 1e-12;
            assert!(
                near(row.direct, direct),
                "case {case}: {row:?}, not {direct}"
            );
            assert!(
                near(row.diffuse, diffuse),
                "case {case}: {row:?}, not {diffuse}"
            );
        }
    }
}
