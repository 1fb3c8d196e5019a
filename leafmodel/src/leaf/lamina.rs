//! The flat leaf: margin and veins, and the cells of a transport leaf.

use glam::DVec2;

use super::damage::Wounds;
use crate::development::DevelopedLeaf;
use crate::shape::outline::Outline;
use crate::transport::{FilledBlade, TransportLeaf};
use crate::venation::network::VenationNetwork;

/// A leaf before it is bent. Lengths are millimetres; the base is the origin, the midrib goes along
/// +y.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamina {
    /// The margin.
    pub outline: Outline,
    /// The veins.
    pub network: VenationNetwork,
    /// The transport leaf whose margin this is, if it is one.
    pub cells: Option<TransportLeaf>,
    /// The leaf that has developed from this margin, if it did.
    pub developed: Option<DevelopedLeaf>,
    /// The cells that its veins supply, if they are the cheapest network that fills the margin.
    pub filled: Option<FilledBlade>,
    /// What damage has left of it, if there is any.
    pub wounds: Option<Wounds>,
}

impl Lamina {
    /// The margin before any damage: what texture coordinates and patterns are measured from.
    pub fn intact(&self) -> &Outline {
        let wounds = self.wounds.as_ref();
        wounds.map_or(&self.outline, |wounds| &wounds.intact)
    }

    /// The margins of its holes, mm.
    pub fn holes(&self) -> &[Vec<DVec2>] {
        self.wounds.as_ref().map_or(&[], |wounds| &wounds.holes)
    }

    /// Whether a vein is wider than the blade.
    pub(super) fn is_narrower_than_its_veins(&self) -> bool {
        let (low, high) = self.outline.bounds();
        let radii = self.network.edges().iter().map(|edge| edge.radius_from);
        2.0 * radii.fold(0.0, f64::max) > (high - low).min_element()
    }

    /// Area of the blade without its holes, mm².
    pub fn area(&self) -> f64 {
        let wounds = self.wounds.as_ref();
        self.outline.area() - wounds.map_or(0.0, Wounds::holes_area)
    }
}
