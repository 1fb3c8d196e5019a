//! What a leaf holds.

use thiserror::Error;

/// What a leaf holds per leaf area, and its structure: PROSPECT-D's inputs, and betalains.
///
/// [`Contents::new`] and [`Contents::checked`] refuse values outside the ranges given here; the
/// optics trust them. (The same fields also carry dimensionless factors, where ranges differ.)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contents {
    /// `N`, number of plates, real, ≥ 1.
    pub structure: f64,
    /// Chlorophyll a + b, µg cm⁻², ≥ 0.
    pub chlorophyll: f64,
    /// Carotenoids, µg cm⁻², ≥ 0.
    pub carotenoids: f64,
    /// Anthocyanins, µg cm⁻², ≥ 0.
    pub anthocyanins: f64,
    /// Betacyanins, µg cm⁻², ≥ 0; not in PROSPECT-D.
    pub betacyanins: f64,
    /// Betaxanthins, µg cm⁻², ≥ 0; not in PROSPECT-D.
    pub betaxanthins: f64,
    /// Brown pigments, PROSPECT's arbitrary unit, ≥ 0.
    pub brown: f64,
    /// Water, cm (= g cm⁻²), ≥ 0.
    pub water: f64,
    /// Dry matter, g cm⁻², ≥ 0.
    pub dry_matter: f64,
}

/// A content outside the range in which the model holds.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{field} is {value}, it must be {range}")]
pub struct ContentsError {
    /// Which of the contents.
    pub field: &'static str,
    /// What it was.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}

impl Contents {
    /// PROSPECT-D's inputs in the order of the fields; no betalains.
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
        Self::from_array([
            structure,
            chlorophyll,
            carotenoids,
            anthocyanins,
            0.0,
            0.0,
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
        if !(self.structure.is_finite() && self.structure >= 1.0) {
            return Err(ContentsError {
                field: "structure",
                value: self.structure,
                range: "finite and at least 1",
            });
        }
        for (field, value) in Self::NAMES.into_iter().zip(self.to_array()).skip(1) {
            if !(value.is_finite() && value >= 0.0) {
                return Err(ContentsError {
                    field,
                    value,
                    range: "finite and at least 0",
                });
            }
        }
        Ok(self)
    }

    /// Where betalains occur, and what to do where they are beside anthocyanins.
    ///
    /// # Source
    ///
    /// \[strack2003\], abstract.
    pub const NEVER_TOGETHER: &'static str = "betalains occur in the Caryophyllales (beet, amaranths, cacti) and some mushrooms only, in place of anthocyanins: leave one out";

    /// Whether there are betalains and anthocyanins in one leaf, which no plant has ([`Contents::NEVER_TOGETHER`]). Optics
    /// computes such a leaf all the same.
    ///
    /// For a map the greatest value of each content answers for all its points: the rule holds for plants, not for points.
    pub fn mixes_betalains_and_anthocyanins(&self) -> bool {
        self.anthocyanins > 0.0 && (self.betacyanins > 0.0 || self.betaxanthins > 0.0)
    }

    /// How many fields there are.
    pub const COUNT: usize = 9;

    /// Names of the fields, in the order of [`Contents::to_array`].
    pub const NAMES: [&'static str; Self::COUNT] = [
        "structure",
        "chlorophyll",
        "carotenoids",
        "anthocyanins",
        "betacyanins",
        "betaxanthins",
        "brown",
        "water",
        "dry_matter",
    ];

    /// Their units, in the same order; numbers without one have an empty one.
    pub const UNITS: [&'static str; Self::COUNT] = [
        "", "µg/cm²", "µg/cm²", "µg/cm²", "µg/cm²", "µg/cm²", "", "cm", "g/cm²",
    ];

    /// The values, in the order of the fields.
    pub fn to_array(self) -> [f64; Self::COUNT] {
        [
            self.structure,
            self.chlorophyll,
            self.carotenoids,
            self.anthocyanins,
            self.betacyanins,
            self.betaxanthins,
            self.brown,
            self.water,
            self.dry_matter,
        ]
    }

    /// From the values in the order of the fields; nothing is checked.
    pub fn from_array(values: [f64; Self::COUNT]) -> Self {
        let [
            structure,
            chlorophyll,
            carotenoids,
            anthocyanins,
            betacyanins,
            betaxanthins,
            brown,
            water,
            dry_matter,
        ] = values;
        Self {
            structure,
            chlorophyll,
            carotenoids,
            anthocyanins,
            betacyanins,
            betaxanthins,
            brown,
            water,
            dry_matter,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GREEN: [f64; Contents::COUNT] = [1.5, 40.0, 8.0, 1.0, 0.2, 0.3, 0.1, 0.01, 0.009];

    #[test]
    fn each_content_out_of_range_is_refused_by_name() {
        assert!(Contents::from_array(GREEN).checked().is_ok());
        for (index, name) in Contents::NAMES.into_iter().enumerate() {
            for bad in [-0.001, f64::NAN, f64::INFINITY] {
                let mut values = GREEN;
                values[index] = bad;
                let error = Contents::from_array(values)
                    .checked()
                    .expect_err("the value is out of range");
                assert_eq!(error.field, name);
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
        let mut values = GREEN;
        assert!(Contents::from_array(values).mixes_betalains_and_anthocyanins());
        values[3] = 0.0;
        assert!(!Contents::from_array(values).mixes_betalains_and_anthocyanins());
        values[3] = 1.0;
        values[4] = 0.0;
        assert!(Contents::from_array(values).mixes_betalains_and_anthocyanins());
        values[5] = 0.0;
        assert!(!Contents::from_array(values).mixes_betalains_and_anthocyanins());
    }

    #[test]
    fn an_array_and_back_is_the_same() {
        assert_eq!(Contents::from_array(GREEN).to_array(), GREEN);
    }
}
