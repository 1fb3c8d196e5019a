//! Leaflets and axes of a compound leaf where they lie in the plane.

use glam::DVec2;
use thiserror::Error;

use crate::document::RangeError;
use crate::leaf::LeafError;

/// A leaflet in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedLeaflet {
    /// Which of `CompoundForm::variants` it is; their plans are at the size of the largest
    /// leaflet (`leaflet_plans`).
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

/// The unit vector at an angle from +y towards +x.
pub(super) fn direction(angle: f64) -> DVec2 {
    DVec2::new(libm::sin(angle), libm::cos(angle))
}
