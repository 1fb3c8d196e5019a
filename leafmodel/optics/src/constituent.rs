//! What a leaf is made of, as far as it decides its optics.
//!
//! A [`Constituent`] is one of the numbers that a version of PROSPECT takes, a betalain, or what a
//! table of the user's absorbs. One row of [`Constituent`]'s table defines each: names, keys, unit,
//! range, and the value if a file leaves it out. Reading, writing and reports use that row.

/// The structure of a leaf, or a substance in it.
///
/// The structure comes first; all others absorb ([`Constituent::ABSORBING`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Constituent {
    /// `N`, number of plates, real, ≥ 1.
    Structure,
    /// Chlorophyll a + b, µg cm⁻².
    Chlorophyll,
    /// Carotenoids, µg cm⁻².
    Carotenoids,
    /// Anthocyanins, µg cm⁻².
    Anthocyanins,
    /// Betacyanins, µg cm⁻²; not in PROSPECT-D.
    Betacyanins,
    /// Betaxanthins, µg cm⁻²; not in PROSPECT-D.
    Betaxanthins,
    /// Brown pigments, PROSPECT's arbitrary unit.
    Brown,
    /// Water, cm (= g cm⁻²).
    Water,
    /// Dry matter, g cm⁻².
    DryMatter,
    /// Proteins, g cm⁻²; PROSPECT-PRO's part of dry matter.
    Proteins,
    /// Carbon-based constituents (cellulose, lignin, starch, sugars, …), g cm⁻²; PROSPECT-PRO's
    /// other part of dry matter.
    CarbonBased,
    /// What a table of specific absorption describes
    /// ([`Pigments::extra`](super::Pigments::extra)), µg cm⁻².
    Extra,
}

/// What is known of a constituent.
struct Facts {
    name: &'static str,
    key: &'static str,
    words: &'static str,
    meaning: &'static str,
    symbol: &'static str,
    unit: &'static str,
    /// What a table shows as the unit of a number without a unit.
    counted_in: &'static str,
    range: [f64; 2],
    if_left_out: Option<f64>,
    /// Whether there is more of it where a leaf is thicker; pigments keep to their cells.
    is_bulk: bool,
}

/// A pigment in µg cm⁻² that PROSPECT-D does not have. A leaf holds none unless a file says so.
const PIGMENT: Facts = Facts {
    name: "",
    key: "",
    words: "",
    meaning: "",
    symbol: "",
    unit: "µg/cm²",
    counted_in: "µg/cm²",
    range: [0.0, 1000.0],
    if_left_out: Some(0.0),
    is_bulk: false,
};

/// Number of plates.
const STRUCTURE: Facts = Facts {
    name: "structure",
    key: "structure",
    words: "structure N",
    meaning: "Number of plates that scatter as the mesophyll does, PROSPECT's N.",
    symbol: "N",
    unit: "",
    counted_in: "plates",
    range: [1.0, 10.0],
    if_left_out: None,
    is_bulk: true,
};

/// Water.
const WATER: Facts = Facts {
    name: "water",
    key: "water_cm",
    words: "water",
    meaning: "Thickness of the water in the leaf.",
    symbol: "Cw",
    unit: "cm",
    counted_in: "cm",
    range: [0.0, 1.0],
    if_left_out: None,
    is_bulk: true,
};

/// Dry matter; a file may give its parts instead.
const DRY_MATTER: Facts = Facts {
    name: "dry_matter",
    key: "dry_matter_g_per_cm2",
    words: "dry matter",
    meaning: "Cell walls, proteins and all else that is left when a leaf has dried; required, \
        or its parts.",
    symbol: "Cm",
    unit: "g/cm²",
    counted_in: "g/cm²",
    range: [0.0, 1.0],
    if_left_out: None,
    is_bulk: true,
};

impl Constituent {
    /// How many there are.
    pub const COUNT: usize = Self::ALL.len();

    /// All of them, in the order of the enum, of columns and of channels.
    pub const ALL: [Self; 12] = [
        Self::Structure,
        Self::Chlorophyll,
        Self::Carotenoids,
        Self::Anthocyanins,
        Self::Betacyanins,
        Self::Betaxanthins,
        Self::Brown,
        Self::Water,
        Self::DryMatter,
        Self::Proteins,
        Self::CarbonBased,
        Self::Extra,
    ];

    /// The parts into which PROSPECT-PRO divides dry matter; a leaf has the whole or its parts.
    pub const DRY_MATTER_PARTS: [Self; 2] = [Self::Proteins, Self::CarbonBased];

    /// Those that absorb: all but the structure.
    pub const ABSORBING: [Self; Self::COUNT - 1] = {
        let [Self::Structure, absorbing @ ..] = Self::ALL else {
            panic!("the structure comes first")
        };
        absorbing
    };

    const fn facts(self) -> Facts {
        match self {
            Self::Structure => STRUCTURE,
            Self::Chlorophyll => Facts {
                name: "chlorophyll",
                key: "chlorophyll_ug_per_cm2",
                words: "chlorophyll a + b",
                meaning: "The green pigments, chlorophyll a and b together.",
                symbol: "Cab",
                if_left_out: None,
                ..PIGMENT
            },
            Self::Carotenoids => Facts {
                name: "carotenoids",
                key: "carotenoids_ug_per_cm2",
                words: "carotenoids",
                meaning: "Yellow and orange pigments of the chloroplasts.",
                symbol: "Car",
                if_left_out: None,
                ..PIGMENT
            },
            Self::Anthocyanins => Facts {
                name: "anthocyanins",
                key: "anthocyanins_ug_per_cm2",
                words: "anthocyanins",
                meaning: "Red to blue pigments of vacuoles.",
                symbol: "Ant",
                ..PIGMENT
            },
            Self::Betacyanins => Facts {
                name: "betacyanins",
                key: "betacyanins_ug_per_cm2",
                words: "betacyanins",
                meaning: "Red betalains, in place of anthocyanins.",
                symbol: "betacyanins",
                ..PIGMENT
            },
            Self::Betaxanthins => Facts {
                name: "betaxanthins",
                key: "betaxanthins_ug_per_cm2",
                words: "betaxanthins",
                meaning: "Yellow betalains.",
                symbol: "betaxanthins",
                ..PIGMENT
            },
            Self::Brown => Facts {
                name: "brown",
                key: "brown",
                words: "brown pigments",
                meaning: "What polyphenols of dying tissue become.",
                symbol: "brown",
                unit: "",
                counted_in: "PROSPECT's unit",
                range: [0.0, 100.0],
                ..PIGMENT
            },
            Self::Water => WATER,
            Self::DryMatter => DRY_MATTER,
            Self::Proteins => Facts {
                name: "proteins",
                key: "proteins_g_per_cm2",
                words: "proteins",
                meaning: "Proteins, in place of dry matter; PROSPECT-PRO alone.",
                symbol: "Prot",
                if_left_out: Some(0.0),
                ..DRY_MATTER
            },
            Self::CarbonBased => Facts {
                name: "carbon_based",
                key: "carbon_based_g_per_cm2",
                words: "carbon-based constituents",
                meaning: "All dry matter but proteins: cell walls, starch, sugars; PROSPECT-PRO alone.",
                symbol: "CBC",
                if_left_out: Some(0.0),
                ..DRY_MATTER
            },
            Self::Extra => Facts {
                name: "extra",
                key: "extra_ug_per_cm2",
                words: "extra constituent",
                meaning: "What the table of `pigments.extra` describes.",
                symbol: "extra",
                range: [0.0, 1e6],
                ..PIGMENT
            },
        }
    }

    /// Its name in code, in messages and among the factors of veins.
    pub const fn name(self) -> &'static str {
        self.facts().name
    }

    /// Its key in files: the name with the unit.
    pub const fn key(self) -> &'static str {
        self.facts().key
    }

    /// Its channel in maps of contents, its column in tables of absorption.
    pub const fn channel(self) -> &'static str {
        self.facts().name
    }

    /// Its name as a table for people has it.
    pub const fn words(self) -> &'static str {
        self.facts().words
    }

    /// What it is, in a line.
    pub const fn meaning(self) -> &'static str {
        self.facts().meaning
    }

    /// PROSPECT's letters for it; the name of what PROSPECT-D does not have.
    pub const fn symbol(self) -> &'static str {
        self.facts().symbol
    }

    /// Its unit, empty if it has none.
    pub const fn unit(self) -> &'static str {
        self.facts().unit
    }

    /// What it is counted in: its unit, or words for numbers without one.
    pub const fn counted_in(self) -> &'static str {
        self.facts().counted_in
    }

    /// From the least to the most that a file may ask for.
    pub const fn range(self) -> [f64; 2] {
        self.facts().range
    }

    /// The least that there can be of it.
    pub const fn least(self) -> f64 {
        self.facts().range[0]
    }

    /// How much there is where a file leaves it out of a leaf's contents; `None` if the file must
    /// say it.
    pub const fn if_left_out(self) -> Option<f64> {
        self.facts().if_left_out
    }

    /// Whether it comes with a tissue's thickness, as structure, water and dry matter do. The
    /// others are pigments.
    pub const fn is_bulk(self) -> bool {
        self.facts().is_bulk
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_has_its_place_and_names_of_its_own() {
        for (index, constituent) in Constituent::ALL.into_iter().enumerate() {
            assert_eq!(constituent as usize, index, "{constituent:?}");
            for other in &Constituent::ALL[..index] {
                assert_ne!(constituent.name(), other.name());
                assert_ne!(constituent.key(), other.key());
                assert_ne!(constituent.symbol(), other.symbol());
            }
        }
    }

    #[test]
    fn a_key_is_the_name_with_the_unit() {
        for constituent in Constituent::ALL {
            let unit = constituent.unit().replace('µ', "u");
            let unit = unit.replace('²', "2").replace('/', "_per_");
            let key = format!("{}_{unit}", constituent.name());
            assert_eq!(constituent.key(), key.trim_end_matches('_'));
            if !constituent.unit().is_empty() {
                assert_eq!(constituent.counted_in(), constituent.unit());
            }
        }
    }

    #[test]
    fn what_is_left_out_is_in_range_and_only_pigments_and_parts_are() {
        for constituent in Constituent::ALL {
            let [least, most] = constituent.range();
            assert!(least < most, "{constituent:?}");
            if let Some(value) = constituent.if_left_out() {
                assert!((least..=most).contains(&value), "{constituent:?}");
                let is_part = Constituent::DRY_MATTER_PARTS.contains(&constituent);
                assert_eq!(constituent.is_bulk(), is_part, "{constituent:?}");
            }
            assert!(!constituent.meaning().is_empty() && !constituent.words().is_empty());
        }
    }
}
