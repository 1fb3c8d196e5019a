//! Specific absorption of each constituent, and the tissue's refractive index: PROSPECT's tables.
//!
//! 400 to 2500 nm by 1 nm. `prospect_d.csv` is PROSPECT-D's, published with Féret et al. (2017),
//! Remote Sens. Environ. 193:204; `prospect_others.csv` has the columns by which the other
//! [`Model`]s differ. The heads of both files say where each column comes from and under which
//! licence; the brown column is Frédéric Baret's, used with his authorisation.

use std::sync::OnceLock;

use thiserror::Error;

use super::constituent::Constituent;
use super::interface::Interface;
use super::model::Model;
pub use super::model::{FIRST_NM, LAST_NM};
use super::per_constituent::PerConstituent;
use super::pigments::Pigments;

const PROSPECT_D: &str = include_str!("prospect_d.csv");
const OTHERS: &str = include_str!("prospect_others.csv");
const ROWS: usize = 2101;
/// Columns of each table, beside the wavelength.
const COLUMNS: usize = 7;

/// PROSPECT's constants at one wavelength, and what betalains absorb.
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
        let between = |Column(table, column): Column| {
            let (low, high) = (table[row][column], table[row + 1][column]);
            low + fraction * (high - low)
        };
        let model = pigments.model;
        // As a column of the table would be: linear between whole nanometres, with end values
        // outside.
        let band = |absorption: &dyn Fn(f64) -> f64| {
            let below = FIRST_NM + row as f64;
            let (low, high) = (absorption(below), absorption(below + 1.0));
            low + fraction * (high - low)
        };
        let betalains = &pigments.betalains;
        let own = |constituent| between(Column::of(model, constituent));
        let along = |constituent| move |nm| Column::of(model, constituent).at(nm);
        Coefficients {
            interface: Interface::of_index(between(Column::of_index(model))),
            absorption: PerConstituent::from_fn(|constituent| match constituent {
                Constituent::Structure => 0.0,
                Constituent::Chlorophyll => match pigments.chlorophyll {
                    Some(mix) => band(&|nm| mix.specific(nm, along(constituent))),
                    None => own(constituent),
                },
                Constituent::Carotenoids => match pigments.carotenoids {
                    Some(mix) => band(&|nm| mix.specific(nm)),
                    None => own(constituent),
                },
                Constituent::Anthocyanins => match pigments.anthocyanins {
                    Some(mix) => band(&|nm| mix.specific(nm, along(constituent))),
                    None => own(constituent),
                },
                Constituent::Betacyanins => {
                    band(&|nm| betalains.betacyanin.specific(nm, betalains.packaging))
                }
                Constituent::Betaxanthins => {
                    band(&|nm| betalains.betaxanthin.specific(nm, betalains.packaging))
                }
                Constituent::Brown
                | Constituent::Water
                | Constituent::DryMatter
                | Constituent::Proteins
                | Constituent::CarbonBased => own(constituent),
                Constituent::Extra => match &pigments.extra {
                    Some(table) => table.at(wavelength_nm),
                    None => 0.0,
                },
            }),
        }
    }

    /// The notices that come with the tables: origin, licence, and remarks, one a line.
    pub fn notice() -> impl Iterator<Item = &'static str> {
        PROSPECT_D
            .lines()
            .chain(OTHERS.lines())
            .filter_map(|line| line.strip_prefix('#'))
            .map(str::trim)
    }
}

/// A column of a table: rows by whole nanometre, and its number in them.
#[derive(Clone, Copy)]
struct Column(&'static [[f64; COLUMNS]], usize);

impl Column {
    /// A model's refractive index.
    fn of_index(model: Model) -> Self {
        match model {
            Model::ProspectD | Model::ProspectPro => Self(prospect_d(), 0),
            Model::Prospect5 | Model::Prospect4 => Self(others(), 0),
        }
    }

    /// What a model has for a constituent. Where it does not have the constituent, the column is
    /// that of the model which does.
    fn of(model: Model, constituent: Constituent) -> Self {
        match (constituent, model) {
            (Constituent::Chlorophyll, Model::Prospect5) => Self(others(), 1),
            (Constituent::Carotenoids, Model::Prospect5) => Self(others(), 2),
            (Constituent::Chlorophyll, Model::Prospect4) => Self(others(), 3),
            (Constituent::DryMatter, Model::Prospect5 | Model::Prospect4) => Self(others(), 4),
            (Constituent::Proteins, _) => Self(others(), 5),
            (Constituent::CarbonBased, _) => Self(others(), 6),
            (Constituent::Chlorophyll, _) => Self(prospect_d(), 1),
            (Constituent::Carotenoids, _) => Self(prospect_d(), 2),
            (Constituent::Anthocyanins, _) => Self(prospect_d(), 3),
            (Constituent::Brown, _) => Self(prospect_d(), 4),
            (Constituent::Water, _) => Self(prospect_d(), 5),
            (Constituent::DryMatter, _) => Self(prospect_d(), 6),
            (
                Constituent::Structure
                | Constituent::Betacyanins
                | Constituent::Betaxanthins
                | Constituent::Extra,
                _,
            ) => unreachable!("no version of PROSPECT has a column for {constituent:?}"),
        }
    }

    /// Its value at a wavelength in nm, with the table's end values outside.
    fn at(self, wavelength_nm: f64) -> f64 {
        let Self(table, column) = self;
        let place = wavelength_nm.clamp(FIRST_NM, LAST_NM) - FIRST_NM;
        let row = (place.floor() as usize).min(ROWS - 2);
        let (low, high) = (table[row][column], table[row + 1][column]);
        low + (place - row as f64) * (high - low)
    }
}

/// n, then PROSPECT-D's six specific absorptions.
fn prospect_d() -> &'static [[f64; COLUMNS]] {
    static PARSED: OnceLock<Vec<[f64; COLUMNS]>> = OnceLock::new();
    PARSED.get_or_init(|| parse(PROSPECT_D))
}

/// What the other models have of their own.
fn others() -> &'static [[f64; COLUMNS]] {
    static PARSED: OnceLock<Vec<[f64; COLUMNS]>> = OnceLock::new();
    PARSED.get_or_init(|| parse(OTHERS))
}

fn parse(text: &str) -> Vec<[f64; COLUMNS]> {
    let rows: Vec<_> = text
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(parse_row)
        .collect();
    assert_eq!(rows.len(), ROWS, "a table that is built in is whole");
    rows
}

fn parse_row(line: &str) -> [f64; COLUMNS] {
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
    use crate::presets;

    #[test]
    fn whole_nanometres_give_the_figures_of_the_table() {
        let at = ProspectD::coefficients(400.0).expect("in range");
        assert_eq!(at.interface.refractive_index, 1.5115);
        assert_eq!(at.absorption[Constituent::Chlorophyll], 0.0648815);
        assert_eq!(at.absorption[Constituent::DryMatter], 109.7);
        let last = PROSPECT_D
            .trim_end()
            .lines()
            .next_back()
            .expect("has lines");
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
        for table in [PROSPECT_D, OTHERS] {
            for (index, line) in table
                .lines()
                .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
                .enumerate()
            {
                assert!(line.starts_with(&format!("{},", 400 + index)), "{line}");
            }
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
    fn models_share_what_they_do_not_change() {
        let leaf = presets::ALL[0].contents;
        let of = |model| {
            let pigments = Pigments {
                model,
                ..Pigments::default()
            };
            move |nm| ProspectD::coefficients_of(&pigments, nm)
        };
        let (own, pro, five) = (
            of(Model::ProspectD),
            of(Model::ProspectPro),
            of(Model::Prospect5),
        );
        assert_ne!(own(550.0).interface, five(550.0).interface);
        for nm in [400.0, 550.5, 1000.0, 1700.0, 2500.0] {
            assert_eq!(own(nm), pro(nm));
            let [d, five] = [own(nm), five(nm)].map(|at| at.reflectance_transmittance(&leaf));
            let change = (d.reflectance - five.reflectance).abs();
            assert!(change < 0.05, "{nm} nm: {d:?} {five:?}");
        }
    }

    #[test]
    fn the_notice_names_the_licence() {
        assert!(ProspectD::notice().any(|line| line.contains("MIT License")));
    }
}
