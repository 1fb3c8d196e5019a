//! What a leaf holds.

use std::ops::{Deref, DerefMut};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::constituent::Constituent;
use super::per_constituent::PerConstituent;

/// What a leaf holds per leaf area, and its structure: `contents[Constituent::Water]`, in the units
/// of [`Constituent`].
///
/// [`Contents::new`] and [`Contents::checked`] refuse fewer plates than one, and less than nothing
/// of the rest; the optics trust them.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Contents(pub PerConstituent<f64>);

/// What a leaf holds at a texel of a map.
pub type Texel = PerConstituent<f32>;

/// A content outside the range in which the model holds.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{} is {value}, it must be {range}", .of.name())]
pub struct ContentsError {
    /// Which of the contents.
    pub of: Constituent,
    /// What it was.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}

impl Contents {
    /// A plate that holds nothing.
    pub const NOTHING: Self =
        Self(PerConstituent::splat(0.0).with(&[(Constituent::Structure, 1.0)]));

    /// These contents, and nothing of what is not named; nothing is checked.
    pub const fn of(named: &[(Constituent, f64)]) -> Self {
        Self::NOTHING.with(named)
    }

    /// The same but for these contents.
    #[must_use]
    pub const fn with(self, named: &[(Constituent, f64)]) -> Self {
        Self(self.0.with(named))
    }

    /// PROSPECT-D's inputs: structure, chlorophyll, carotenoids, anthocyanins, brown, water, dry
    /// matter; nothing is checked.
    pub const fn prospect_d(inputs: [f64; 7]) -> Self {
        use Constituent::{
            Anthocyanins, Brown, Carotenoids, Chlorophyll, DryMatter, Structure, Water,
        };
        let [n, cab, car, ant, brown, cw, cm] = inputs;
        Self::of(&[
            (Structure, n),
            (Chlorophyll, cab),
            (Carotenoids, car),
            (Anthocyanins, ant),
            (Brown, brown),
            (Water, cw),
            (DryMatter, cm),
        ])
    }

    /// PROSPECT-D's inputs, and nothing of what it does not have.
    ///
    /// # Errors
    ///
    /// [`ContentsError`] for the first value outside its range.
    pub fn new(
        structure: f64,
        chlorophyll: f64,
        carotenoids: f64,
        anthocyanins: f64,
        brown: f64,
        water: f64,
        dry_matter: f64,
    ) -> Result<Self, ContentsError> {
        Self::prospect_d([
            structure,
            chlorophyll,
            carotenoids,
            anthocyanins,
            brown,
            water,
            dry_matter,
        ])
        .checked()
    }

    /// The contents themselves if every one is in range.
    ///
    /// # Errors
    ///
    /// [`ContentsError`] for the first value outside its range.
    pub fn checked(self) -> Result<Self, ContentsError> {
        for (of, value) in self.0 {
            if !(value.is_finite() && value >= of.least()) {
                let range = if of.least() > 0.0 {
                    "finite and at least 1"
                } else {
                    "finite and at least 0"
                };
                return Err(ContentsError { of, value, range });
            }
        }
        Ok(self)
    }

    /// All dry matter, g cm⁻²: the whole, or its parts.
    pub fn all_dry_matter(&self) -> f64 {
        let parts = Constituent::DRY_MATTER_PARTS.map(|part| self[part]);
        self[Constituent::DryMatter] + parts.iter().sum::<f64>()
    }

    /// Where betalains occur, and what to do where they are beside anthocyanins.
    ///
    /// # Source
    ///
    /// \[strack2003\], abstract.
    pub const NEVER_TOGETHER: &'static str = "betalains occur in the Caryophyllales (beet, amaranths, cacti) and some mushrooms only, in place of anthocyanins: leave one out";

    /// Whether there are betalains and anthocyanins in one leaf, which no plant has
    /// ([`Contents::NEVER_TOGETHER`]). Optics computes such a leaf all the same.
    ///
    /// For a map the greatest value of each content answers for all its points: the rule holds for
    /// plants, not for points.
    pub fn mixes_betalains_and_anthocyanins(&self) -> bool {
        let holds = |constituent| self[constituent] > 0.0;
        holds(Constituent::Anthocyanins)
            && (holds(Constituent::Betacyanins) || holds(Constituent::Betaxanthins))
    }

    /// `C + (C′ − C) w`: these contents where others, `C′`, weigh `w`.
    #[must_use]
    pub fn towards(self, others: Self, weight: f64) -> Self {
        let mixed = |own: f64, other: f64| own + (other - own) * weight;
        Self(self.zip_with(others.0, mixed))
    }

    /// As a texel of a map holds them.
    #[inline]
    pub fn to_texel(self) -> Texel {
        self.0.map(|content| content as f32)
    }

    /// Those of a texel; nothing is checked.
    pub fn from_texel(texel: Texel) -> Self {
        Self(texel.map(f64::from))
    }
}

impl Deref for Contents {
    type Target = PerConstituent<f64>;

    fn deref(&self) -> &PerConstituent<f64> {
        &self.0
    }
}

impl DerefMut for Contents {
    fn deref_mut(&mut self) -> &mut PerConstituent<f64> {
        &mut self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Something of everything.
    const GREEN: Contents = Contents::prospect_d([1.5, 40.0, 8.0, 1.0, 0.1, 0.01, 0.009]).with(&[
        (Constituent::Betacyanins, 0.2),
        (Constituent::Betaxanthins, 0.3),
    ]);

    #[test]
    fn each_content_out_of_range_is_refused_by_name() {
        assert!(GREEN.checked().is_ok());
        for of in Constituent::ALL {
            for bad in [-0.001, f64::NAN, f64::INFINITY] {
                let error = GREEN.with(&[(of, bad)]).checked();
                let error = error.expect_err("the value is out of range");
                assert_eq!(error.of, of);
                assert_eq!(error.value.to_bits(), bad.to_bits());
            }
        }
    }

    #[test]
    fn fewer_plates_than_one_are_refused() {
        let error = Contents::new(0.99, 40.0, 8.0, 0.0, 0.0, 0.01, 0.009);
        let message = error.expect_err("N is below 1").to_string();
        assert_eq!(
            message,
            "structure is 0.99, it must be finite and at least 1"
        );
    }

    #[test]
    fn betalains_go_with_any_pigment_but_anthocyanins() {
        use Constituent::{Anthocyanins, Betacyanins, Betaxanthins};
        let mixes = |without: &[Constituent]| {
            let none: Vec<_> = without.iter().map(|&one| (one, 0.0)).collect();
            GREEN.with(&none).mixes_betalains_and_anthocyanins()
        };
        assert!(mixes(&[]));
        assert!(!mixes(&[Anthocyanins]));
        assert!(mixes(&[Betacyanins]));
        assert!(!mixes(&[Betacyanins, Betaxanthins]));
    }

    #[test]
    fn what_is_not_named_is_not_there() {
        let dry = Contents::of(&[(Constituent::Water, 0.0), (Constituent::DryMatter, 0.004)]);
        assert_eq!(dry[Constituent::Structure], 1.0);
        assert_eq!(dry[Constituent::DryMatter], 0.004);
        assert_eq!(dry[Constituent::Chlorophyll], 0.0);
        assert_eq!(
            Contents::from_texel(dry.to_texel())[Constituent::Water],
            0.0
        );
    }
}
