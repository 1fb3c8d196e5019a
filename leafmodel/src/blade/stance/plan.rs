//! What has happened to a blade since it grew.

use crate::blade::error::BladeError;
use crate::document::{Declared, Keys, Word};

/// What has happened to a blade since it was as its form says.
#[derive(Clone, Copy, Debug, Declared, Default, PartialEq)]
#[key(last = held_or_on_ground)]
pub struct Stance {
    /// Whether the leaf is held by its stalk, or lies on the ground, z = 0, under its weight. A
    /// compound leaf lies on three points, its axes straight whatever its own `curl_deg`,
    /// `fold_deg` and `tilt_deg`.
    #[key("rest", Word(&[("held", false), ("ground", true)]))]
    pub on_ground: bool,
    /// Growth in excess at the margin, which then undulates.
    #[key("margin_growth", block, default = MarginGrowth { excess: 0.1, width: 0.05 })]
    pub margin_growth: Option<MarginGrowth>,
    /// Dead tissue that has lost its water: it shrinks, curls and crumples.
    #[key("drying", block, default = Drying::USUAL)]
    pub drying: Option<Drying>,
    /// A leaf without turgor, which its weight bends.
    #[key("wilting", block, default = Wilting { share: 1.0, pitch: 0.0 })]
    pub wilting: Option<Wilting>,
}

/// Growth that exceeds the rest of the blade's by `excess · exp(−d / width)` at the distance `d`
/// from the margin.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct MarginGrowth {
    /// Excess of length at the margin; below 0 the blade becomes a bowl.
    #[key("excess", required, -0.3..=1.0)]
    pub excess: f64,
    /// Distance over which it falls to 1/e, over the leaf's length.
    #[key("width", 0.005..=1.0)]
    pub width: f64,
}

/// Shrinkage of dead tissue.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Drying {
    /// 0 fresh, 1 air-dry.
    #[key("share", required, 0.0..=1.0)]
    pub share: f64,
    /// Linear shrinkage of air-dry tissue across veins.
    #[key("shrinkage", 0.0..=0.4)]
    pub shrinkage: f64,
    /// Shrinkage along veins over that across.
    #[key("along", 0.0..=1.0)]
    pub along: f64,
    /// Shrinkage of the adaxial face less that of the abaxial; above 0 the blade curls upwards.
    #[key("faces", -0.1..=0.1)]
    pub faces: f64,
    /// How much patches differ.
    #[key("unevenness", 0.0..=1.0)]
    pub unevenness: f64,
    /// Angle through which drying bows the midrib, towards the adaxial side.
    ///
    /// Radians.
    #[key("bow_deg", degrees(-170.0..=170.0))]
    pub bow: f64,
}

impl Drying {
    /// Drying of which nothing is said but how far it went.
    ///
    /// Pressed leaves of ten species lost over 18 % of their area (\[juneau2012\]), some 9 % of each
    /// length; those that dry unpressed shrink more. The other numbers are by eye.
    pub const USUAL: Self = Self {
        share: 1.0,
        shrinkage: 0.12,
        along: 0.3,
        faces: 0.007,
        unevenness: 0.75,
        bow: 30_f64.to_radians(),
    };
}

/// Loss of turgor in a leaf that is held by its stalk.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Wilting {
    /// Share of turgor that is lost.
    #[key("share", required, 0.0..=1.0)]
    pub share: f64,
    /// Angle by which the leaf's axis rises above the horizontal.
    ///
    /// Radians.
    #[key("pitch_deg", degrees(-90.0..=90.0))]
    pub pitch: f64,
}

/// Reports what only a leaf that is held by its stalk does.
pub(super) fn held_or_on_ground(stance: &Stance, keys: &Keys<'_>) {
    if keys.is_sound() && stance.on_ground && stance.wilting.is_some_and(|w| w.pitch != 0.0) {
        let problem = "it says how a leaf that is held by its stalk rises, and this one lies on \
            the ground";
        let help = "leave out `pitch_deg`, or `rest`";
        keys.refuse(&["wilting", "pitch_deg"], problem.to_owned(), help);
    }
}

impl Stance {
    /// Whether nothing has happened.
    #[must_use]
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Checks every field.
    ///
    /// # Errors
    ///
    /// [`BladeError::Range`] for the first field outside its range.
    pub fn validate(&self) -> Result<(), BladeError> {
        Ok(self.in_range()?)
    }
}
