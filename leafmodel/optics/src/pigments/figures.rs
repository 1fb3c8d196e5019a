//! Every figure behind the pigments, with its source.

use super::chlorophyll;
use super::{Aglycone, AnthocyaninMix, Carotenoid, CarotenoidMix, ChlorophyllMix, Pigments};
use crate::betalains::{self, Betacyanin, Betaxanthin};
use document::declared::Words;

/// How far a figure can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// Seen in the source.
    Verified,
    /// Fitted for this project to data that were seen.
    Fitted,
    /// Recalled from the literature, not seen in a source.
    Unverified,
    /// An assumption of this project.
    Assumed,
}

impl Basis {
    /// One word for tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Verified => "verified",
            Self::Fitted => "fitted",
            Self::Unverified => "unverified",
            Self::Assumed => "assumed",
        }
    }
}

/// A number behind the pigments.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Of what.
    pub of: String,
    /// The number.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
    /// How far it can be trusted.
    pub basis: Basis,
    /// Where it is from.
    pub source: &'static str,
}

const EPSILON: &str = "L/(mol cm)";
const PER_CM: &str = "1/cm";

impl Pigments {
    /// Every number that a finer class than PROSPECT-D's rests on, with its source.
    pub fn figures() -> Vec<Figure> {
        let mut figures = List::default();
        plastid(&mut figures);
        vacuolar(&mut figures);
        figures.0
    }
}

/// Figures in the making.
#[derive(Default)]
struct List(Vec<Figure>);

impl List {
    fn add(
        &mut self,
        of: impl Into<String>,
        value: f64,
        unit: &'static str,
        basis: Basis,
        source: &'static str,
    ) {
        self.0.push(Figure {
            of: of.into(),
            value,
            unit,
            basis,
            source,
        });
    }
}

/// Of pigments in plastids.
fn plastid(figures: &mut List) {
    for (name, bands) in [("a", chlorophyll::A), ("b", chlorophyll::B)] {
        figures.add(
            format!("chlorophyll {name}, peak in diethyl ether"),
            bands.epsilon,
            EPSILON,
            Basis::Fitted,
            "PhotochemCAD (Du et al. 1998; Dixon et al. 2005), Gaussians fitted to 0.3 and 0.4 % of the peak",
        );
    }
    figures.add(
        "chlorophyll, a over b",
        ChlorophyllMix::A_TO_B,
        "",
        Basis::Verified,
        "medians of the 276 leaves of ANGERS",
    );
    figures.add(
        "chlorophyll, shift",
        ChlorophyllMix::SHIFT_PER_CM,
        PER_CM,
        Basis::Assumed,
        "red peak at 661 nm in ether, 675 to 680 nm in PROSPECT-D",
    );
    figures.add(
        "chlorophyll, packaging",
        ChlorophyllMix::PACKAGING,
        "",
        Basis::Assumed,
        "PROSPECT-D's red peak over that in solution",
    );
    for (name, carotenoid) in Carotenoid::WORDS {
        let bands = carotenoid.in_solution();
        figures.add(
            format!("{name}, peak in methanol"),
            bands.epsilon,
            EPSILON,
            Basis::Unverified,
            "recalled; the shape is fitted to LipidBank's plots to about 1 % of the peak",
        );
    }
    figures.add(
        "carotenoids, shift",
        CarotenoidMix::SHIFT_PER_CM,
        PER_CM,
        Basis::Unverified,
        "20 to 30 nm between methanol and protein; the lower end",
    );
    figures.add(
        "carotenoids, packaging",
        CarotenoidMix::PACKAGING,
        "",
        Basis::Assumed,
        "PROSPECT-D at 444 nm over lutein in solution",
    );
}

/// Of pigments in vacuoles.
fn vacuolar(figures: &mut List) {
    for (name, aglycone) in Aglycone::WORDS {
        figures.add(
            format!("{name}, peak"),
            aglycone.peak_nm(),
            "nm",
            Basis::Verified,
            "Belitz, Grosch and Schieberle, Food Chemistry, table 18.22",
        );
        let (basis, source) = match aglycone {
            Aglycone::Pelargonidin => (
                Basis::Verified,
                "middle of 15 600 to 36 000, by author and solvent",
            ),
            Aglycone::Cyanidin => (Basis::Verified, "aqueous, pH 1; others give 29 600"),
            Aglycone::Peonidin => (Basis::Unverified, "middle of 11 300 to 14 100"),
            Aglycone::Delphinidin => (Basis::Unverified, "at 543 nm"),
            Aglycone::Petunidin => (Basis::Unverified, "middle of 12 900 to 18 900"),
            Aglycone::Malvidin => (Basis::Unverified, "at 520 nm"),
        };
        figures.add(
            format!("{name}-3-glucoside, peak"),
            aglycone.epsilon(),
            EPSILON,
            basis,
            source,
        );
    }
    figures.add(
        "anthocyanins, quinonoidal peak",
        AnthocyaninMix::BLUE_PEAK_NM,
        "nm",
        Basis::Verified,
        "middle of 570 to 600 nm (secondary source); its height is assumed to be the red form's",
    );
    for (name, epsilon, basis, source) in [
        (
            "betanin",
            Betacyanin::Betanin.epsilon(),
            Basis::Verified,
            "in water, middle of 60 000 to 65 000 (vendors' compilation)",
        ),
        (
            "amaranthine",
            Betacyanin::Amaranthine.epsilon(),
            Basis::Unverified,
            "recalled",
        ),
        (
            "indicaxanthin, vulgaxanthin I",
            Betaxanthin::Indicaxanthin.epsilon(),
            Basis::Unverified,
            "recalled",
        ),
    ] {
        figures.add(format!("{name}, peak"), epsilon, EPSILON, basis, source);
    }
    for (name, width_nm, basis, source) in [
        (
            "betanin, deviation towards the blue",
            betalains::BETACYANIN_WIDTHS_NM[0],
            Basis::Unverified,
            "ratios of absorbance of Nilsson's photometry (1970)",
        ),
        (
            "betanin, deviation towards the red",
            betalains::BETACYANIN_WIDTHS_NM[1],
            Basis::Unverified,
            "ratios of absorbance of Nilsson's photometry (1970)",
        ),
        (
            "betaxanthins, deviation",
            betalains::BETAXANTHIN_WIDTH_NM,
            Basis::Unverified,
            "recalled",
        ),
    ] {
        figures.add(name, width_nm, "nm", basis, source);
    }
    figures.add(
        "betalains, packaging",
        betalains::PACKAGING,
        "",
        Basis::Assumed,
        "by analogy with anthocyanin, 0.4 to 0.55",
    );
}
