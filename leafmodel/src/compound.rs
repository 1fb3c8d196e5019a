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
mod arranged;
mod flat;
pub mod form;
mod overlap;
mod stalk_contents;
mod stray;
#[cfg(test)]
mod tests;
mod whole;

use self::arranged::direction;
pub use self::arranged::{CompoundError, CompoundLeaf, PlacedLeaflet, Stalk, StalkKind};
pub use self::flat::FlatLeaf;
pub use self::form::{Arrangement, CompoundForm, Feather};
pub use self::whole::{Placement, WholeLeaf, leaflet_plans};
use crate::document::Keys;
use crate::leaf::outline_plan::Contour;
use crate::leaf::{LeafError, LeafPlan};
use crate::shape::outline::Outline;

/// Greatest number of leaflets of a leaf.
pub const MOST_LEAFLETS: usize = 2000;

/// Greatest angle by which the curl may turn the end of an axis. The stalks have pieces enough for it.
const MOST_CURL_DEG: f64 = 720.0;

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
    pub(crate) fn arrange_within(
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
