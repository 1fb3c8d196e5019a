//! Colours of leaves as contents, by name.
//!
//! Each is one leaf of its kind, not a mean, and says what its numbers rest on. Leaves of a
//! species: `leafmodel::species`.

use super::constituent::Constituent;
use super::contents::Contents;
use super::per_constituent::PerConstituent;

/// What the contents of a preset rest on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PresetBasis {
    /// Within the range of the leaves of ANGERS (276 leaves of 47 taxa).
    Angers,
    /// Measured on such a leaf.
    Measured,
    /// Fitted to measured reflectance and transmittance of such a leaf.
    Fitted,
    /// Chosen by eye within what leaves of the kind are known to hold.
    Estimate,
    /// Taken to be absent; nobody has measured that it is.
    Absent,
}

impl PresetBasis {
    /// One word for tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Angers => "range of ANGERS",
            Self::Measured => "measured",
            Self::Fitted => "fitted",
            Self::Estimate => "estimate",
            Self::Absent => "taken to be absent",
        }
    }
}

/// A colour of leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Its name, lower case with hyphens.
    pub name: &'static str,
    /// Which leaf it is.
    pub about: &'static str,
    /// What such a leaf holds.
    pub contents: Contents,
    /// What the numbers rest on, taken together.
    pub basis: PresetBasis,
    /// What each rests on.
    each: PerConstituent<PresetBasis>,
}

impl Preset {
    /// What one of the contents rests on.
    ///
    /// Nobody measures a number of plates: it is fitted, with the contents as measured. A content
    /// of 0 is taken to be absent.
    pub fn basis_of(&self, constituent: Constituent) -> PresetBasis {
        self.each[constituent]
    }

    /// The same, whose structure, chlorophyll and carotenoids rest on something else.
    const fn green_part(mut self, basis: PresetBasis) -> Self {
        use Constituent::{Carotenoids, Chlorophyll, Structure};
        self.each = self.each.with(&[
            (Structure, basis),
            (Chlorophyll, basis),
            (Carotenoids, basis),
        ]);
        self
    }
}

/// A row: N, chlorophyll, carotenoids, anthocyanins, brown, water, dry matter.
///
/// Nobody measures a number of plates, so that where the basis is measured it is fitted.
const fn preset(
    name: &'static str,
    about: &'static str,
    values: [f64; 7],
    basis: PresetBasis,
) -> Preset {
    let structure_basis = match basis {
        PresetBasis::Measured => PresetBasis::Fitted,
        PresetBasis::Angers | PresetBasis::Fitted | PresetBasis::Estimate | PresetBasis::Absent => {
            basis
        }
    };
    let contents = Contents::prospect_d(values);
    let mut each = PerConstituent::splat(basis).with(&[(Constituent::Structure, structure_basis)]);
    let mut next = 0;
    while next < Constituent::COUNT {
        let constituent = Constituent::ALL[next];
        if contents.0.of(constituent) == 0.0 {
            each = each.with(&[(constituent, PresetBasis::Absent)]);
        }
        next += 1;
    }
    Preset {
        name,
        about,
        contents,
        basis,
        each,
    }
}

/// All of them, from green over yellow and red to brown.
#[rustfmt::skip]
pub const ALL: [Preset; 19] = {
    use PresetBasis::{Angers, Estimate, Fitted, Measured};
    [
        preset("sun-green", "a green leaf of the sun", [1.6, 45.0, 10.0, 0.5, 0.0, 0.011, 0.006], Angers),
        preset("shade-thin", "a thin leaf of the shade", [1.3, 35.0, 8.0, 0.0, 0.0, 0.008, 0.003], Angers),
        preset("dark-evergreen", "an evergreen such as cherry laurel or holly", [2.1, 75.0, 15.0, 1.0, 0.0, 0.022, 0.013], Angers),
        preset("chlorotic", "a pale leaf at the low end of chlorophyll", [1.5, 6.0, 3.0, 0.0, 0.0, 0.010, 0.004], Angers),
        preset("golden", "Robinia pseudoacacia 'Frisia'", [1.55, 1.0, 7.1, 0.0, 0.0, 0.0064, 0.0036], Measured),
        preset("white-sector", "white part of Acer negundo 'Variegatum'", [1.2, 1.6, 0.04, 0.0, 0.0, 0.0084, 0.0022], Measured),
        preset("cream-sector", "cream part of a variegated ivy (Hedera)", [1.9, 1.8, 0.7, 0.0, 0.0, 0.0157, 0.0047], Measured),
        preset("young-red-flush", "a young leaf, red before it is green", [1.4, 12.0, 4.0, 15.0, 0.0, 0.010, 0.003], Estimate),
        preset("birch-yellow", "birch in autumn", [1.51, 1.2, 5.2, 0.4, 0.33, 0.0094, 0.0038], Fitted),
        preset("oak-yellow-brown", "oak in autumn", [1.27, 2.0, 4.8, 0.0, 0.27, 0.0078, 0.0034], Fitted),
        preset("ginkgo-yellow", "ginkgo in autumn", [1.7, 0.8, 9.0, 0.0, 0.03, 0.011, 0.006], Estimate),
        preset("poplar-yellow", "poplar in autumn", [1.6, 1.5, 6.0, 0.0, 0.10, 0.009, 0.005], Estimate),
        preset("sugar-maple-orange", "sugar maple in autumn", [1.6, 2.0, 7.0, 4.0, 0.1, 0.008, 0.005], Estimate),
        preset("red-maple-scarlet", "red maple in autumn", [1.7, 3.0, 5.0, 15.0, 0.1, 0.008, 0.005], Estimate),
        preset("sweetgum-purple-red", "sweetgum (Liquidambar) in autumn", [1.7, 8.0, 6.0, 30.0, 0.1, 0.009, 0.006], Estimate),
        // Structure, chlorophyll and carotenoids of purple leaves are in ANGERS.
        preset("smoke-tree-purple", "a purple smoke tree (Cotinus), green beneath its red", [1.7, 35.0, 8.0, 30.0, 0.0, 0.010, 0.006], Estimate)
            .green_part(Angers),
        preset("croton-red", "red part of a croton (Codiaeum)", [2.1, 15.0, 8.0, 25.0, 0.0, 0.02, 0.008], Estimate),
        preset("croton-yellow", "yellow part of a croton (Codiaeum)", [2.1, 3.0, 10.0, 0.0, 0.0, 0.02, 0.008], Estimate),
        preset("brown-litter", "a dead leaf on the ground", [2.2, 0.3, 0.8, 0.0, 1.1, 0.001, 0.007], Estimate),
    ]
};

/// The preset of this name.
pub fn by_name(name: &str) -> Option<Preset> {
    ALL.into_iter().find(|preset| preset.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ProspectD;

    #[test]
    fn names_differ_are_found_and_hold_valid_contents() {
        for preset in ALL {
            assert_eq!(by_name(preset.name), Some(preset));
            assert!(preset.contents.checked().is_ok(), "{}", preset.name);
        }
        assert_eq!(by_name("mauve"), None);
    }

    #[test]
    fn each_number_says_what_it_rests_on() {
        use Constituent::{
            Anthocyanins, Brown, Carotenoids, Chlorophyll, DryMatter, Structure, Water,
        };
        use PresetBasis::{Absent, Angers, Estimate, Fitted, Measured};
        let absent = PerConstituent::splat(Absent);
        let basis = |name: &str| by_name(name).expect("a preset").each;
        let golden = absent.with(&[
            (Structure, Fitted),
            (Chlorophyll, Measured),
            (Carotenoids, Measured),
            (Water, Measured),
            (DryMatter, Measured),
        ]);
        assert_eq!(basis("golden"), golden);
        let purple = absent.with(&[
            (Structure, Angers),
            (Chlorophyll, Angers),
            (Carotenoids, Angers),
            (Anthocyanins, Estimate),
            (Brown, Absent),
            (Water, Estimate),
            (DryMatter, Estimate),
        ]);
        assert_eq!(basis("smoke-tree-purple"), purple);
    }

    #[test]
    fn colours_are_those_of_the_names() {
        let reflectance = |name: &str, nm: f64| {
            let contents = by_name(name).expect("a preset").contents;
            let at = ProspectD::coefficients(nm).expect("in range");
            at.reflectance_transmittance(&contents).reflectance
        };
        let [green, yellow, red] = [545.0, 580.0, 650.0];
        for name in ["sun-green", "shade-thin", "dark-evergreen"] {
            assert!(
                reflectance(name, green) > 1.5 * reflectance(name, 675.0),
                "{name}"
            );
        }
        for name in [
            "golden",
            "birch-yellow",
            "ginkgo-yellow",
            "poplar-yellow",
            "croton-yellow",
        ] {
            assert!(
                reflectance(name, yellow) > 2.0 * reflectance(name, 450.0),
                "{name}"
            );
        }
        for name in ["red-maple-scarlet", "sweetgum-purple-red", "croton-red"] {
            assert!(
                reflectance(name, red) > 1.3 * reflectance(name, green),
                "{name}"
            );
        }
        assert!(reflectance("white-sector", 480.0) > 0.8 * reflectance("white-sector", yellow));
    }
}
