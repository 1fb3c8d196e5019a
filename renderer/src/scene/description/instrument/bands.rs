//! Bands of sensors, their response functions, and indices.

use leafmodel::document::keys::Keys;
use leafmodel::document::limits::Limits;
use leafmodel::document::value_kind::{ListOf, MapOf, Numbers, Word};

use crate::scene::description::film::WAVELENGTHS_NM;

/// A sensor whose bands are known.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sensor {
    /// Name, middle and full width at half of the maximum, nm.
    bands: &'static [(&'static str, f64, f64)],
    /// Names of the red and the near infrared band of the NDVI.
    red_and_nir: [&'static str; 2],
}

/// Sentinel-2A: centres and widths of ESA's response functions, S2-SRF 3.0
/// (COPE-GSEG-EOPG-TN-15-0007).
const SENTINEL_2A_MSI: Sensor = Sensor {
    bands: &[
        ("B1", 442.7, 21.0),
        ("B2", 492.4, 66.0),
        ("B3", 559.8, 36.0),
        ("B4", 664.6, 31.0),
        ("B5", 704.1, 15.0),
        ("B6", 740.5, 15.0),
        ("B7", 782.8, 20.0),
        ("B8", 832.8, 106.0),
        ("B8A", 864.7, 21.0),
        ("B9", 945.1, 20.0),
        ("B10", 1373.5, 31.0),
        ("B11", 1613.7, 91.0),
        ("B12", 2202.4, 175.0),
    ],
    red_and_nir: ["B4", "B8"],
};

/// Landsat 8: the middles and widths of the ranges at half of the maximum that USGS gives, from
/// \[barsi2014\]: 435 to 451, 452 to 512, 533 to 590, 636 to 673, 851 to 879, 1566 to 1651, 2107 to
/// 2294, 503 to 676 and 1363 to 1384 nm.
const LANDSAT_8_OLI: Sensor = Sensor {
    bands: &[
        ("B1", 443.0, 16.0),
        ("B2", 482.0, 60.0),
        ("B3", 561.5, 57.0),
        ("B4", 654.5, 37.0),
        ("B5", 865.0, 28.0),
        ("B6", 1608.5, 85.0),
        ("B7", 2200.5, 187.0),
        ("B8", 589.5, 173.0),
        ("B9", 1373.5, 21.0),
    ],
    red_and_nir: ["B4", "B5"],
};

const SENSORS: [(&str, Sensor); 2] = [
    ("sentinel-2a-msi", SENTINEL_2A_MSI),
    ("landsat-8-oli", LANDSAT_8_OLI),
];

/// The form of a band's response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ResponseShape {
    Box,
    Gaussian,
}

const SHAPES: [(&str, ResponseShape); 2] = [
    ("box", ResponseShape::Box),
    ("gaussian", ResponseShape::Gaussian),
];

/// Indices that can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    Ndvi,
    Pri,
}

const INDICES: [(&str, Asked); 2] = [("ndvi", Asked::Ndvi), ("pri", Asked::Pri)];

/// Wavelengths of the PRI and their names as bands, nm \[gamon1992\].
const PRI: [(&str, f64); 2] = [("531 nm", 531.0), ("570 nm", 570.0)];

/// Nodes and weights of Gauss' rule of eight points on [-1, 1], positive half.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// The response of a sensor's band.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Its name.
    pub name: String,
    /// Its middle, nm.
    pub centre_nm: f64,
    /// Wavelengths, nm, and weights of sum 1 by which a mean over the response is taken.
    pub nodes: Vec<(f64, f64)>,
}

/// An index of two bands, their difference over their sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Index {
    /// Its name.
    pub name: &'static str,
    /// Numbers of the band that counts and of the one that is taken off.
    pub bands: [usize; 2],
}

impl Response {
    /// A band of eight wavelengths by its middle and its full width at half of the maximum, nm.
    ///
    /// In a box they are Gauss' of an even response, exact for polynomials of degree 15. In a bell
    /// curve they are a standard deviation apart, and the sum is the integral to about 1e-4.
    fn of_shape(name: &str, centre_nm: f64, fwhm_nm: f64, shape: ResponseShape) -> Self {
        let offsets: Vec<(f64, f64)> = match shape {
            ResponseShape::Box => GAUSS
                .iter()
                .flat_map(|&(x, weight)| [(-x, weight), (x, weight)])
                .map(|(x, weight)| (0.5 * fwhm_nm * x, 0.5 * weight))
                .collect(),
            ResponseShape::Gaussian => {
                let sigma = fwhm_nm / (8.0 * std::f64::consts::LN_2).sqrt();
                let nodes = (0..8).map(|i| f64::from(i) - 3.5);
                let bell = nodes.map(|x| (sigma * x, libm::exp(-0.5 * x * x)));
                let bell: Vec<(f64, f64)> = bell.collect();
                let sum: f64 = bell.iter().map(|(_, weight)| weight).sum();
                bell.into_iter()
                    .map(|(x, weight)| (x, weight / sum))
                    .collect()
            }
        };
        let mut nodes: Vec<(f64, f64)> = offsets
            .into_iter()
            .map(|(offset, weight)| (centre_nm + offset, weight))
            .collect();
        nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self {
            name: name.to_owned(),
            centre_nm,
            nodes,
        }
    }

    /// One wavelength.
    fn of_line(name: &str, nm: f64) -> Self {
        Self {
            name: name.to_owned(),
            centre_nm: nm,
            nodes: vec![(nm, 1.0)],
        }
    }
}

/// `sensor`, `bands_nm`, `band_shape` and `indices`.
pub(super) fn declare(bands: &mut Vec<Response>, indices: &mut Vec<Index>, keys: &mut Keys<'_>) {
    let mut sensor = None;
    let about = "A sensor for whose bands figures are told: even responses of the published \
        centres and widths.";
    keys.optional("sensor", &mut sensor, Word(&SENSORS), about);
    let mut own: Vec<(String, [f64; 2])> = Vec::new();
    let about = "More bands by name, each its middle and its full width at half of the maximum: \
        `{ red = [665, 30] }`.";
    let kind = MapOf(Numbers::<2>(Limits::above(0.0, 2500.0)));
    keys.key("bands_nm", &mut own, kind, about);
    let mut shape = ResponseShape::Box;
    let about = "Response of the bands in `bands_nm`: even over the width, or a bell curve.";
    keys.key("band_shape", &mut shape, Word(&SHAPES), about);
    let mut asked = Vec::new();
    let kind = ListOf {
        of: Word(&INDICES),
        least: 0,
        most: INDICES.len(),
        wanted: "a list of the words `ndvi` and `pri`",
    };
    let about = "Indices of reflectances: `ndvi` of the sensor's bands, or of `red` and `nir` in \
        `bands_nm`; `pri` of 531 and 570 nm.";
    keys.key("indices", &mut asked, kind, about);
    if keys.reader().is_none() {
        return;
    }
    let known = sensor.iter().flat_map(|sensor: &Sensor| sensor.bands);
    *bands = known
        .map(|&(name, centre, fwhm)| Response::of_shape(name, centre, fwhm, ResponseShape::Box))
        .collect();
    for (name, [centre, fwhm]) in &own {
        if bands.iter().any(|band| band.name == *name) {
            let problem = format!("the sensor has a band `{name}`");
            keys.refuse(&["bands_nm"], problem, "give the band another name");
        }
        if ["PAR", "531 nm", "570 nm"].contains(&name.as_str()) {
            let problem = format!("`{name}` is the name of a band of figures of its own");
            keys.refuse(&["bands_nm"], problem, "give the band another name");
        }
        let band = Response::of_shape(name, *centre, *fwhm, shape);
        if !band.nodes.iter().all(|(nm, _)| WAVELENGTHS_NM.contain(*nm)) {
            let problem = format!("the band `{name}` reaches beyond 360 to 2500 nm");
            let help = "write its middle and its width in nm, such as `red = [665, 30]`";
            keys.refuse(&["bands_nm"], problem, help);
        }
        bands.push(band);
    }
    *indices = asked
        .into_iter()
        .filter_map(|asked| index(asked, sensor, bands, keys))
        .collect();
}

/// An index, whose bands are added if they are not there; reported if there are none.
fn index(
    asked: Asked,
    sensor: Option<Sensor>,
    bands: &mut Vec<Response>,
    keys: &Keys<'_>,
) -> Option<Index> {
    match asked {
        Asked::Ndvi => {
            let [red, nir] = sensor.map_or(["red", "nir"], |sensor| sensor.red_and_nir);
            let place = |name| bands.iter().position(|band| band.name == name);
            if let (Some(red), Some(nir)) = (place(red), place(nir)) {
                return Some(Index {
                    name: "ndvi",
                    bands: [nir, red],
                });
            }
            let problem = "there is no red and near infrared band for `ndvi`".to_owned();
            let help = "add `sensor = \"sentinel-2a-msi\"`, or \
                `bands_nm = { red = [665, 30], nir = [833, 106] }`";
            keys.refuse(&["indices"], problem, help);
            None
        }
        Asked::Pri => {
            let first = bands.len();
            bands.extend(PRI.map(|(name, nm)| Response::of_line(name, nm)));
            Some(Index {
                name: "pri",
                bands: [first, first + 1],
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_gives_the_mean_of_a_parabola_over_its_response() {
        let of_square = |shape| {
            let band = Response::of_shape("", 700.0, 40.0, shape);
            assert_eq!(band.nodes.len(), 8);
            let sum: f64 = band.nodes.iter().map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() < 1e-12);
            let squares = band.nodes.iter();
            squares
                .map(|(nm, weight)| weight * (nm - 700.0).powi(2))
                .sum::<f64>()
        };
        // The variance of an even response, and of a bell curve that is cut at 4 deviations.
        assert!((of_square(ResponseShape::Box) - 1600.0 / 12.0).abs() < 1e-9);
        let variance = 1600.0 / (8.0 * std::f64::consts::LN_2);
        assert!((of_square(ResponseShape::Gaussian) / variance - 1.0).abs() < 5e-3);
    }
}
