//! Specific absorption of each constituent, and the tissue's refractive index: PROSPECT-D's table.
//!
//! 400 to 2500 nm by 1 nm, published with Féret et al. (2017), Remote Sens. Environ. 193:204. The
//! head of `prospect_d.csv` says where each column comes from and under which licence; the brown
//! column is Frédéric Baret's, used with his authorisation.

use std::sync::OnceLock;

use thiserror::Error;

use super::constituent::Constituent;
use super::interface::Interface;
use super::per_constituent::PerConstituent;
use super::pigments::Pigments;

/// First wavelength of the table, nm.
pub const FIRST_NM: f64 = 400.0;
/// Last wavelength of the table, nm.
pub const LAST_NM: f64 = 2500.0;

const TABLE: &str = include_str!("prospect_d.csv");
const ROWS: usize = 2101;

/// PROSPECT-D's constants at one wavelength, and what betalains absorb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// The faces of a plate.
    pub interface: Interface,
    /// What one unit of each constituent adds to the absorption of the whole leaf, in the inverse
    /// of the constituent's unit: chlorophyll up to 780 nm, carotenoids up to 560 nm, anthocyanins
    /// up to 689 nm, brown pigments up to 1099 nm. The structure adds nothing.
    pub absorption: PerConstituent<f64>,
}

/// A wavelength for which PROSPECT-D has no data.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("PROSPECT-D has data from 400 to 2500 nm, not at {wavelength_nm} nm")]
pub struct OutsideTable {
    /// The wavelength asked for, nm.
    pub wavelength_nm: f64,
}

/// The PROSPECT-D table.
#[derive(Clone, Copy, Debug)]
pub struct ProspectD;

impl ProspectD {
    /// The constants at a wavelength in nm: index and specific absorptions linear between whole
    /// nanometres, then the faces from that index.
    ///
    /// # Errors
    ///
    /// [`OutsideTable`] unless the wavelength is in 400 to 2500 nm.
    pub fn coefficients(wavelength_nm: f64) -> Result<Coefficients, OutsideTable> {
        if (FIRST_NM..=LAST_NM).contains(&wavelength_nm) {
            Ok(Self::coefficients_extrapolated(wavelength_nm))
        } else {
            Err(OutsideTable { wavelength_nm })
        }
    }

    /// As [`ProspectD::coefficients`], with the table's end values outside 400 to 2500 nm. Nothing
    /// is published there; chlorophyll goes on absorbing below 400 nm, so the end value is a fair
    /// stand-in.
    pub fn coefficients_extrapolated(wavelength_nm: f64) -> Coefficients {
        Self::coefficients_of(&Pigments::default(), wavelength_nm)
    }

    /// As [`ProspectD::coefficients_extrapolated`], with pigment columns that consist of these
    /// substances. Columns other than PROSPECT's own
    /// are linear between whole nanometres too.
    pub fn coefficients_of(pigments: &Pigments, wavelength_nm: f64) -> Coefficients {
        let place = wavelength_nm.clamp(FIRST_NM, LAST_NM) - FIRST_NM;
        let row = (place.floor() as usize).min(ROWS - 2);
        let fraction = place - row as f64;
        let (low, high) = (table()[row], table()[row + 1]);
        let between = |column: usize| low[column] + fraction * (high[column] - low[column]);
        // As a column of the table would be: linear between whole nanometres, with end values
        // outside.
        let band = |absorption: &dyn Fn(f64) -> f64| {
            let below = FIRST_NM + row as f64;
            let (low, high) = (absorption(below), absorption(below + 1.0));
            low + fraction * (high - low)
        };
        let betalains = &pigments.betalains;
        Coefficients {
            interface: Interface::of_index(between(0)),
            absorption: PerConstituent::from_fn(|constituent| match constituent {
                Constituent::Structure => 0.0,
                Constituent::Chlorophyll => match pigments.chlorophyll {
                    Some(mix) => band(&|nm| mix.specific(nm, |nm| column(1, nm))),
                    None => between(1),
                },
                Constituent::Carotenoids => match pigments.carotenoids {
                    Some(mix) => band(&|nm| mix.specific(nm)),
                    None => between(2),
                },
                Constituent::Anthocyanins => match pigments.anthocyanins {
                    Some(mix) => band(&|nm| mix.specific(nm, |nm| column(3, nm))),
                    None => between(3),
                },
                Constituent::Betacyanins => {
                    band(&|nm| betalains.betacyanin.specific(nm, betalains.packaging))
                }
                Constituent::Betaxanthins => {
                    band(&|nm| betalains.betaxanthin.specific(nm, betalains.packaging))
                }
                Constituent::Brown => between(4),
                Constituent::Water => between(5),
                Constituent::DryMatter => between(6),
            }),
        }
    }

    /// The notice that comes with the table: origin, licence, and remarks, one a line.
    pub fn notice() -> impl Iterator<Item = &'static str> {
        TABLE
            .lines()
            .filter_map(|line| line.strip_prefix('#'))
            .map(str::trim)
    }
}

/// A column of the table at a wavelength in nm, with the table's end values outside.
fn column(column: usize, wavelength_nm: f64) -> f64 {
    let place = wavelength_nm.clamp(FIRST_NM, LAST_NM) - FIRST_NM;
    let row = (place.floor() as usize).min(ROWS - 2);
    let (low, high) = (table()[row][column], table()[row + 1][column]);
    low + (place - row as f64) * (high - low)
}

/// Rows by whole nanometre: n, then the six specific absorptions.
fn table() -> &'static [[f64; 7]] {
    static PARSED: OnceLock<Vec<[f64; 7]>> = OnceLock::new();
    PARSED.get_or_init(|| {
        let rows: Vec<[f64; 7]> = TABLE
            .lines()
            .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
            .map(parse_row)
            .collect();
        assert_eq!(rows.len(), ROWS, "the table that is built in is whole");
        rows
    })
}

fn parse_row(line: &str) -> [f64; 7] {
    let mut columns = line.split(',').skip(1).map(|figure| {
        figure
            .trim()
            .parse::<f64>()
            .expect("the table that is built in holds numbers only")
    });
    std::array::from_fn(|_| {
        columns
            .next()
            .expect("each row of the table that is built in has eight columns")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_nanometres_give_the_figures_of_the_table() {
        let at = ProspectD::coefficients(400.0).expect("in range");
        assert_eq!(at.interface.refractive_index, 1.5115);
        assert_eq!(at.absorption[Constituent::Chlorophyll], 0.0648815);
        assert_eq!(at.absorption[Constituent::DryMatter], 109.7);
        let last = TABLE.trim_end().lines().next_back().expect("has lines");
        let at = ProspectD::coefficients(2500.0).expect("in range");
        let figures: Vec<f64> = last
            .split(',')
            .map(|s| s.parse().expect("number"))
            .collect();
        assert_eq!(figures[0], 2500.0);
        assert_eq!(at.interface.refractive_index, figures[1]);
        assert_eq!(at.absorption[Constituent::Water], figures[6]);
    }

    #[test]
    fn the_rows_are_the_whole_nanometres_in_order() {
        for (index, line) in TABLE
            .lines()
            .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
            .enumerate()
        {
            assert!(line.starts_with(&format!("{},", 400 + index)), "{line}");
        }
    }

    #[test]
    fn half_way_between_two_rows_is_their_mean() {
        let low = ProspectD::coefficients(550.0).expect("in range").absorption;
        let high = ProspectD::coefficients(551.0).expect("in range").absorption;
        let mid = ProspectD::coefficients(550.5).expect("in range").absorption;
        let mean = f64::midpoint(
            low[Constituent::Chlorophyll],
            high[Constituent::Chlorophyll],
        );
        assert!((mid[Constituent::Chlorophyll] - mean).abs() < 1e-17);
    }

    #[test]
    fn outside_the_table_is_an_error_unless_extrapolation_is_asked_for() {
        for nm in [399.999, 2500.001, f64::NAN, f64::INFINITY, -1.0] {
            assert!(ProspectD::coefficients(nm).is_err(), "{nm}");
        }
        let end = ProspectD::coefficients(400.0).expect("in range");
        assert_eq!(ProspectD::coefficients_extrapolated(360.0), end);
    }

    #[test]
    fn the_notice_names_the_licence() {
        assert!(ProspectD::notice().any(|line| line.contains("MIT License")));
    }
}
