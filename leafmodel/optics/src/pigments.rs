//! Which substances the pigment columns of [`Contents`] consist of.
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

use super::betalains::Betalains;
use super::constituent::Constituent;
use super::contents::Contents;
use super::extra::ExtraTable;
use super::model::Model;
use document::declared::{Declared, Words};
use document::error::DocumentError;
use document::keys::Keys;
use document::limits::Limits;
use document::value_kind::Number;
use document::values::rounded;

pub use anthocyanin::{Aglycone, AnthocyaninMix};
pub use carotenoid::{Carotenoid, CarotenoidMix};
pub use chlorophyll::{ChlorophyllBands, ChlorophyllMix};
pub use figures::{Basis, Figure};

/// What each column of specific absorption consists of; the default is PROSPECT-D's columns, betanin
/// and indicaxanthin.
#[derive(Clone, Debug, Declared, Default, PartialEq)]
pub struct Pigments {
    /// The version of PROSPECT, which determines refractive index and specific absorptions.
    #[key("model", word)]
    pub model: Model,
    /// Chlorophyll a and b apart.
    #[key("chlorophyll", block)]
    pub chlorophyll: Option<ChlorophyllMix>,
    /// Named carotenoids.
    #[key("carotenoids", block)]
    pub carotenoids: Option<CarotenoidMix>,
    /// Named aglycones; cyanidin where none is named.
    #[key("anthocyanins", block)]
    pub anthocyanins: Option<AnthocyaninMix>,
    /// Which betalains there are.
    #[key("betalains", block)]
    pub betalains: Betalains,
    /// A constituent of your own.
    #[key("extra", block)]
    pub extra: Option<ExtraTable>,
}

impl Pigments {
    /// What is wrong if a leaf holds an extra constituent whose absorption nothing states.
    pub fn lacks_extra(&self, contents: &Contents) -> Option<&'static str> {
        let is_missing = self.extra.is_none() && contents[Constituent::Extra] > 0.0;
        is_missing.then_some("nothing says what the extra constituent absorbs: give its table too")
    }
}

/// Rounding that a sum of shares may show.
const ROUNDING: f64 = 1e-6;

/// Shares by mass under the substances' names.
fn shares<T: Words, const N: usize>(shares: &mut [f64; N], class: &str, keys: &mut Keys<'_>) {
    if keys.reader().is_some() {
        // Those of a preset do not add up with others.
        *shares = [0.0; N];
    }
    let names: Vec<&'static str> = T::WORDS.iter().map(|(name, _)| *name).collect();
    for (name, share) in names.iter().zip(shares.iter_mut()) {
        let limits = Number(Limits::closed(0.0, 1.0));
        keys.key(name, share, limits, "Its share, 0 where it is left out.");
    }
    let sum: f64 = shares.iter().sum();
    if keys.has_only(&names) && keys.is_sound() && (sum - 1.0).abs() > ROUNDING {
        let error = DocumentError::Impossible {
            key: "shares".to_owned(),
            problem: format!(
                "the shares of the {class} sum to {}, not to 1",
                rounded(sum)
            ),
            help: "change them so that they sum to 1; what is left out has a share of 0".to_owned(),
        };
        keys.report(&[], error);
    }
}

#[cfg(test)]
mod tests;
