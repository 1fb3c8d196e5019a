//! Which substances the pigment columns of [`Contents`](super::Contents) consist of.
//!
//! By default they are PROSPECT-D's own columns, bit for bit. Each class can instead be a mix of
//! named pigments: bands in solution moved and scaled to what they are in leaves. That step (shift,
//! packaging) is an assumption that the caller can set; [`figures`](Pigments::figures) says of
//! every number where it is from and whether it was seen there.
//!
//! - **In**: shares by mass within a class, sums of 1; shift in cm⁻¹ or nm; packaging, in-leaf over
//!   in-solution absorptivity.
//! - **Out**: specific absorptions, cm² µg⁻¹, ≥ 0, linear in the shares.
//! - **Always true**: beyond the range in which a band was measured it falls smoothly to zero,
//!   within 30 nm.
//! - **Left out**: any change of a band's shape in the leaf, sieve effects that grow with content,
//!   real chemistry of pH.

mod anthocyanin;
mod bands;
mod carotenoid;
mod chlorophyll;
mod figures;

use thiserror::Error;

use super::betalains::{self, Betacyanin, Betaxanthin};

pub use anthocyanin::{Aglycone, AnthocyaninMix};
pub use carotenoid::{Carotenoid, CarotenoidMix};
pub use chlorophyll::ChlorophyllMix;
pub use figures::{Basis, Figure};

/// What each pigment column consists of; the default is PROSPECT-D's columns, betanin and
/// indicaxanthin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pigments {
    /// Chlorophylls.
    pub chlorophyll: ChlorophyllMix,
    /// Carotenoids.
    pub carotenoids: CarotenoidMix,
    /// Anthocyanins.
    pub anthocyanins: AnthocyaninMix,
    /// Betacyanins.
    pub betacyanins: Betacyanin,
    /// Betaxanthins.
    pub betaxanthins: Betaxanthin,
    /// In-leaf over in-solution absorptivity of betalains, in (0, 1]; 0.4 to 0.55 are likely.
    pub betalain_packaging: f64,
}

impl Default for Pigments {
    fn default() -> Self {
        Self {
            chlorophyll: ChlorophyllMix::Prospect,
            carotenoids: CarotenoidMix::Prospect,
            anthocyanins: AnthocyaninMix::Prospect,
            betacyanins: Betacyanin::Betanin,
            betaxanthins: Betaxanthin::Indicaxanthin,
            betalain_packaging: betalains::PACKAGING,
        }
    }
}

/// A parameter of the pigments outside the range in which it means something.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error("{field} is {value}, it must be {range}")]
pub struct PigmentsError {
    /// Which parameter.
    pub field: &'static str,
    /// What it was.
    pub value: f64,
    /// What it may be.
    pub range: &'static str,
}

impl Pigments {
    /// The pigments themselves if every parameter is in range.
    ///
    /// # Errors
    ///
    /// [`PigmentsError`] for the first parameter outside its range.
    pub fn checked(self) -> Result<Self, PigmentsError> {
        self.chlorophyll.check()?;
        self.carotenoids.check()?;
        self.anthocyanins.check()?;
        packaging("betalain_packaging", self.betalain_packaging)?;
        Ok(self)
    }
}

/// Refuses what is not in (0, 1].
fn packaging(field: &'static str, value: f64) -> Result<(), PigmentsError> {
    within(
        field,
        value,
        value > 0.0 && value <= 1.0,
        "above 0 and at most 1",
    )
}

/// Refuses a shift of bands beyond ±3000 cm⁻¹, which is some 60 nm in the blue.
fn shift_per_cm(field: &'static str, value: f64) -> Result<(), PigmentsError> {
    within(
        field,
        value,
        (-3000.0..=3000.0).contains(&value),
        "from -3000 to 3000",
    )
}

/// Refuses shares below 0, and those that do not add up to 1.
fn shares(field: &'static str, values: &[f64]) -> Result<(), PigmentsError> {
    for &value in values {
        within(field, value, value >= 0.0, "shares of at least 0")?;
    }
    let sum: f64 = values.iter().sum();
    within(
        field,
        sum,
        (sum - 1.0).abs() <= 1e-6,
        "shares whose sum is 1",
    )
}

fn within(
    field: &'static str,
    value: f64,
    good: bool,
    range: &'static str,
) -> Result<(), PigmentsError> {
    good.then_some(()).ok_or(PigmentsError {
        field,
        value,
        range,
    })
}

#[cfg(test)]
mod tests;
