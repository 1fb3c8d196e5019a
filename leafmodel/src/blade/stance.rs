//! How a blade comes to lie: growth in excess at its margin, drying, wilting, rest on the ground.
//!
//! [`BladeForm`](super::BladeForm) says how the blade of a turgid leaf is bent. A [`Stance`] says
//! what has happened to it since. The blade is then an elastic shell (`crate::shell`) in
//! equilibrium: every undulation, curl and crumple follows from what the tissue wants and from its
//! weight. It keeps clear of itself by its thickness, veins included.
//!
//! - **In**: a [`Stance`], margin and veins, the mass of the tissue, a seed.
//! - **Out**: [`Settled`], which moves each point of the bent blade.
//! - **Always true**: the stance of a leaf of which nothing is said moves nothing; same seed, same
//!   bits.
//! - **Left out**: tears, the time that drying takes.

mod posture;
mod settled;
mod tissue;

pub(super) use posture::Posture;
pub use settled::Settled;

use super::error::BladeError;

/// What has happened to a blade since it was as its form says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stance {
    /// Growth in excess at the margin.
    pub margin_growth: Option<MarginGrowth>,
    /// Loss of water after death.
    pub drying: Option<Drying>,
    /// Loss of turgor.
    pub wilting: Option<Wilting>,
    /// Whether the leaf lies on the ground, the plane z = 0, under its weight.
    pub on_ground: bool,
}

/// Growth that exceeds the rest of the blade's by `excess · exp(−d / width)` at the distance `d`
/// from the margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarginGrowth {
    /// Linear excess at the margin, −0.3 to 1.
    pub excess: f64,
    /// Distance over which it falls to 1/e, as a share of the leaf's length, 0.005 to 1.
    pub width: f64,
}

/// Shrinkage of dead tissue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drying {
    /// How dry: 0 fresh, 1 air-dry.
    pub share: f64,
    /// Linear shrinkage across veins of air-dry tissue, 0 to 0.4.
    pub shrinkage: f64,
    /// Shrinkage along veins over that across, 0 to 1.
    pub along: f64,
    /// Shrinkage of the adaxial face less that of the abaxial one, −0.1 to 0.1; positive curls the
    /// blade upwards.
    pub faces: f64,
    /// How much patches differ, 0 to 1.
    pub unevenness: f64,
    /// Angle through which the midrib bows from end to end, towards the adaxial side, radians, −3
    /// to 3.
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wilting {
    /// Share of the turgor that is lost, 0 to 1.
    pub share: f64,
    /// Angle by which the leaf's axis rises above the horizontal, radians, −1.6 to 1.6.
    pub pitch: f64,
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
    /// [`BladeError::OutOfRange`] for the first field outside its range.
    pub fn validate(&self) -> Result<(), BladeError> {
        let mut fields = Vec::new();
        if let Some(growth) = self.margin_growth {
            fields.push((
                "margin_growth.excess",
                growth.excess,
                -0.3..=1.0,
                "-0.3 to 1",
            ));
            fields.push((
                "margin_growth.width",
                growth.width,
                0.005..=1.0,
                "0.005 to 1",
            ));
        }
        if let Some(drying) = self.drying {
            fields.push(("drying.share", drying.share, 0.0..=1.0, "0 to 1"));
            fields.push(("drying.shrinkage", drying.shrinkage, 0.0..=0.4, "0 to 0.4"));
            fields.push(("drying.along", drying.along, 0.0..=1.0, "0 to 1"));
            fields.push(("drying.faces", drying.faces, -0.1..=0.1, "-0.1 to 0.1"));
            fields.push(("drying.unevenness", drying.unevenness, 0.0..=1.0, "0 to 1"));
            fields.push(("drying.bow", drying.bow, -3.0..=3.0, "-3 to 3 (radians)"));
        }
        if let Some(wilting) = self.wilting {
            fields.push(("wilting.share", wilting.share, 0.0..=1.0, "0 to 1"));
            fields.push((
                "wilting.pitch",
                wilting.pitch,
                -1.6..=1.6,
                "-1.6 to 1.6 (radians)",
            ));
        }
        BladeError::unless_within(fields)
    }
}
