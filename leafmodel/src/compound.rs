//! Compound leaves: leaflets on a rachis, flat and in space.
//!
//! - **In**: a [`CompoundForm`], the arrangement of leaflets, and the plan of the largest leaflet.
//! - **Out**: a [`CompoundLeaf`]: leaflets with their places in the plane, and stalks as polylines
//!   with radii. It can be drawn flat as one network ([`FlatLeaf`]) or built in space
//!   ([`WholeLeaf`]) as blades, tubes and the place of each blade. Lengths are millimetres; the
//!   petiole starts at the origin and goes along +y.
//! - **Always true**: in the plane no leaflet overlaps another one or a stalk other than its own,
//!   however irregular they stand; stalks taper; the same plan gives the same leaf.
//! - **Left out**: leaves whose leaflets overlap in nature. They are refused.
//!
//! ```
//! use leafmodel::species;
//!
//! // The plan of a compound leaf is that of its largest leaflet, with an arrangement.
//! let ash = species::find("ash").ok_or("the ash is a preset")?.plan();
//! let form = ash.compound.as_ref().ok_or("it is compound")?;
//! let leaf = form.arrange(&ash)?;
//! assert_eq!(leaf.leaflets.len() % 2, 1, "pairs, and one at the end");
//! assert!(leaf.leaflets.iter().all(|leaflet| leaflet.scale <= 1.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arrange;
mod flat;
pub mod form;
mod overlap;
mod stalk_contents;
mod stray;
#[cfg(test)]
mod tests;
mod whole;

use glam::DVec2;
use thiserror::Error;

pub use self::flat::FlatLeaf;
pub use self::form::{Arrangement, CompoundForm, Feather};
pub use self::whole::{Placement, WholeLeaf, joined_stalks, leaflet_plans};
use crate::document::keys::Keys;
use crate::document::ranges::RangeError;
use crate::leaf::outline_plan::Contour;
use crate::leaf::{LeafError, LeafPlan};
use crate::shape::outline::Outline;

/// Greatest number of leaflets of a leaf.
pub const MOST_LEAFLETS: usize = 2000;

/// A leaflet in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedLeaflet {
    /// Which of [`CompoundForm::variants`] it is; their plans are at the size of the largest
    /// leaflet ([`leaflet_plans`]).
    pub variant: u32,
    /// Where its stalk leaves the axis, mm.
    pub foot: DVec2,
    /// Place of its base, mm.
    pub base: DVec2,
    /// Direction of its midrib, radians from +y towards +x (clockwise).
    pub angle: f64,
    /// The same, relative to the direction of the axis that bears it, > 0 to the right.
    pub from_axis: f64,
    /// Scale factor on the plan's leaf, in (0, 1].
    pub scale: f64,
    /// Whether it is mirrored (x is negated first). Leaflets on the left are, so that pairs with
    /// unequal halves match.
    pub mirrored: bool,
}

/// What a stalk is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StalkKind {
    /// The stalk from the stem to the first leaflets.
    Petiole,
    /// The axis that bears leaflets or pinnae.
    Rachis,
    /// The axis of a pinna, with its stalk.
    Pinna,
    /// The stalk of one leaflet.
    Petiolule,
}

/// A stalk as a polyline.
#[derive(Clone, Debug, PartialEq)]
pub struct Stalk {
    /// Its kind.
    pub kind: StalkKind,
    /// Its points, mm, from its base to its tip, at least two.
    pub points: Vec<DVec2>,
    /// Radius at each point, mm, > 0, never growing towards the tip.
    pub radii_mm: Vec<f64>,
}

/// A compound leaf.
#[derive(Clone, Debug, PartialEq)]
pub struct CompoundLeaf {
    /// Leaflets, from the base on, right before left.
    pub leaflets: Vec<PlacedLeaflet>,
    /// Petiole and rachis first.
    pub stalks: Vec<Stalk>,
}

/// Greatest angle by which the curl may turn the end of an axis. The stalks have pieces enough for it.
const MOST_CURL_DEG: f64 = 720.0;

/// Why no compound leaf can be made.
#[derive(Debug, Error)]
pub enum CompoundError {
    /// A number out of its range.
    #[error(transparent)]
    Range(#[from] RangeError),
    /// More leaflets than a leaf may have.
    #[error("leaflets in all is {leaflets}, outside 1 to 2000")]
    TooMany {
        /// How many.
        leaflets: usize,
    },
    /// Two leaflets overlap.
    #[error("leaflets {first} and {second} overlap")]
    Overlap {
        /// Number of the first leaflet, from 0.
        first: usize,
        /// Number of the second.
        second: usize,
    },
    /// A leaflet lies over a stalk that is not its own.
    #[error("leaflet {leaflet} lies over a stalk that is not its own")]
    OnStalk {
        /// Number of the leaflet, from 0.
        leaflet: usize,
    },
    /// The curl of the axes continues along the pinnae, and would roll the leaf up.
    #[error("the curl turns the end of an axis by {degrees:.0}°, more than 720°")]
    RolledUp {
        /// By how much, degrees.
        degrees: f64,
    },
    /// The leaflet's outline cannot be grown.
    #[error("leaflet: {0}")]
    Leaflet(#[from] LeafError),
}

impl PlacedLeaflet {
    /// The place in the compound leaf of a point of the plan's leaf (mm, base at the origin, midrib
    /// along +y).
    pub fn place(&self, p: DVec2) -> DVec2 {
        let x = if self.mirrored { -p.x } else { p.x };
        let axis = direction(self.angle);
        self.base + (-axis.perp() * x + axis * p.y) * self.scale
    }
}

impl CompoundForm {
    /// Places the leaflets; `leaflet` is the plan of the largest one.
    ///
    /// # Errors
    ///
    /// [`CompoundError`], naming the parameter and its range, or the leaflets that overlap.
    pub fn arrange(&self, leaflet: &LeafPlan) -> Result<CompoundLeaf, CompoundError> {
        self.validate()?;
        // Only randomly uneven light and development give leaflets different margins.
        let plans = leaflet_plans(leaflet, self);
        let alike = !matches!(
            leaflet.outline.contour,
            Contour::Transport(_) | Contour::Development(_)
        );
        let outlines = plans.iter().take(if alike { 1 } else { plans.len() });
        let outlines: Result<Vec<Outline>, LeafError> =
            outlines.map(LeafPlan::grow_outline).collect();
        self.arrange_within(leaflet, &outlines?)
    }

    /// As [`CompoundForm::arrange`], for leaflets with these margins, one for each variant or one
    /// for all.
    ///
    /// # Errors
    ///
    /// As [`CompoundForm::arrange`].
    ///
    /// # Panics
    ///
    /// If `outlines` is empty.
    pub fn arrange_within(
        &self,
        leaflet: &LeafPlan,
        outlines: &[Outline],
    ) -> Result<CompoundLeaf, CompoundError> {
        self.validate()?;
        let mut stray = stray::Stray::new(self, leaflet.seed);
        loop {
            let leaf = arrange::arrange(self, leaflet.length_mm, &stray);
            let most = if self.irregularity > 0.0 {
                2 * leaf.leaflets.len()
            } else {
                1
            };
            let mut errors = overlap::find(&leaf, outlines, most);
            if errors.is_empty() {
                let places = leaf.stalks.iter().flat_map(|stalk| &stalk.points);
                let reach = places.fold(0.0_f64, |reach, place| reach.max(place.y.abs()));
                let degrees = (self.curvature(leaflet.length_mm) * reach)
                    .abs()
                    .to_degrees();
                if degrees > MOST_CURL_DEG && !leaflet.stance.on_ground {
                    return Err(CompoundError::RolledUp { degrees });
                }
                return Ok(leaf);
            }
            if !stray.calm(&errors) {
                return Err(errors.swap_remove(0));
            }
        }
    }

    /// Curvature of the plane of a leaf whose largest leaflet has this length, 1/mm: the curl over the
    /// length of the main axis.
    fn curvature(&self, unit: f64) -> f64 {
        let rachis = match &self.arrangement {
            Arrangement::Pinnate(feather) => feather.rachis,
            Arrangement::Palmate { .. } => 0.0,
            Arrangement::Bipinnate {
                pinnae, leaflets, ..
            } => pinnae.rachis * leaflets.rachis,
        };
        let length = (self.petiole + rachis) * unit;
        if length > 0.0 {
            self.curl / length
        } else {
            0.0
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`CompoundError::Range`], [`CompoundError::TooMany`].
    pub fn validate(&self) -> Result<(), CompoundError> {
        let mut own = self.clone();
        if let Some(error) = Keys::check(|keys| own.keys(keys)).into_iter().next() {
            return Err(error.into());
        }
        let leaflets = match &self.arrangement {
            Arrangement::Pinnate(feather) => feather.count(),
            Arrangement::Palmate { leaflets, .. } => *leaflets as usize,
            Arrangement::Bipinnate {
                pinnae, leaflets, ..
            } => pinnae.count() * leaflets.count(),
        };
        if leaflets > MOST_LEAFLETS {
            return Err(CompoundError::TooMany { leaflets });
        }
        Ok(())
    }
}

impl Feather {
    fn count(&self) -> usize {
        2 * self.pairs as usize + usize::from(self.terminal)
    }
}

/// The unit vector at an angle from +y towards +x.
fn direction(angle: f64) -> DVec2 {
    DVec2::new(libm::sin(angle), libm::cos(angle))
}
