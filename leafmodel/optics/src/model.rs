//! The versions of PROSPECT.

use document::declared::Words;

use super::constituent::Constituent;
use super::contents::Contents;

/// First wavelength of all models' tables, nm.
pub const FIRST_NM: f64 = 400.0;
/// Last wavelength of all models' tables, nm.
pub const LAST_NM: f64 = 2500.0;

/// A version of PROSPECT: which constituents it separates. All versions have the same pile of plates
/// and differ in refractive index and specific absorptions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Words)]
pub enum Model {
    /// PROSPECT-D: chlorophyll, carotenoids, anthocyanins, brown pigments, water, dry matter
    /// \[feret2017\].
    #[default]
    #[word("prospect-d")]
    ProspectD,
    /// PROSPECT-PRO: PROSPECT-D with proteins and carbon-based constituents in place of dry matter
    /// \[feret2021\].
    #[word("prospect-pro")]
    ProspectPro,
    /// PROSPECT-5: PROSPECT-D's constituents without anthocyanins \[feret2008\].
    #[word("prospect-5")]
    Prospect5,
    /// PROSPECT-4: chlorophyll (with what carotenoids absorb), water and dry matter
    /// \[feret2008\].
    #[word("prospect-4")]
    Prospect4,
}

impl Model {
    /// Its inputs, in the order of [`Constituent::ALL`].
    pub const fn inputs(self) -> &'static [Constituent] {
        use Constituent::{
            Anthocyanins, Brown, CarbonBased, Carotenoids, Chlorophyll, DryMatter, Proteins,
            Structure, Water,
        };
        match self {
            Self::ProspectD => &[
                Structure,
                Chlorophyll,
                Carotenoids,
                Anthocyanins,
                Brown,
                Water,
                DryMatter,
            ],
            Self::ProspectPro => &[
                Structure,
                Chlorophyll,
                Carotenoids,
                Anthocyanins,
                Brown,
                Water,
                Proteins,
                CarbonBased,
            ],
            Self::Prospect5 => &[Structure, Chlorophyll, Carotenoids, Brown, Water, DryMatter],
            Self::Prospect4 => &[Structure, Chlorophyll, Water, DryMatter],
        }
    }

    /// Its name as files and options write it.
    pub fn name(self) -> &'static str {
        let mut words = Self::WORDS.iter();
        let own = words.find(|(_, model)| *model == self);
        own.expect("each variant has a word").0
    }

    /// Its name as sentences write it.
    pub fn title(self) -> String {
        self.name().to_uppercase()
    }

    /// Who published its tables.
    pub const fn source(self) -> &'static str {
        match self {
            Self::ProspectD => "Feret, Gitelson, Noble and Jacquemoud (2017)",
            Self::ProspectPro => "Feret, Berger, de Boissieu and Malenovsky (2021)",
            Self::Prospect5 | Self::Prospect4 => "Feret, Francois, Asner and others (2008)",
        }
    }

    /// Whether it may be given a constituent: one of its own, or one that no version has.
    pub fn takes(self, constituent: Constituent) -> bool {
        let has = |model: Self| model.inputs().contains(&constituent);
        has(self) || !Self::WORDS.iter().any(|(_, model)| has(*model))
    }

    /// What is wrong with a leaf of these contents in this model, and what to do about it.
    pub fn refusal(self, contents: &Contents) -> Option<(Constituent, String, String)> {
        let mut held = contents.iter().filter(|(_, content)| **content > 0.0);
        let (of, content) = held.find(|(constituent, _)| !self.takes(*constituent))?;
        let others = Self::WORDS.iter().filter(|(_, model)| model.takes(of));
        let others: Vec<String> = others.map(|(name, _)| format!("`{name}`")).collect();
        let problem = format!("{} has no {}, here {content}", self.title(), of.words());
        let help = format!("set it to 0, or take the model {}", others.join(" or "));
        Some((of, problem, help))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_model_refuses_what_only_others_have() {
        let proteins = Contents::of(&[(Constituent::Proteins, 0.001)]);
        let dry = Contents::of(&[(Constituent::DryMatter, 0.005)]);
        let red = Contents::of(&[(Constituent::Anthocyanins, 2.0)]);
        let beet = Contents::of(&[(Constituent::Betacyanins, 2.0), (Constituent::Extra, 9.0)]);
        for (_, model) in Model::WORDS {
            let is_refused = |contents: &Contents| model.refusal(contents).is_some();
            let is_pro = *model == Model::ProspectPro;
            let is_old = matches!(model, Model::Prospect5 | Model::Prospect4);
            assert_eq!(is_refused(&proteins), !is_pro, "{model:?}");
            assert_eq!(is_refused(&dry), is_pro, "{model:?}");
            assert_eq!(is_refused(&red), is_old, "{model:?}");
            assert!(!is_refused(&beet), "{model:?}");
        }
    }
}
