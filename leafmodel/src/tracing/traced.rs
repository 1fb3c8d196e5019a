//! What a picture was traced to, and how its places become millimetres.

use glam::DVec2;

use super::findings::Finding;
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// What a picture shows.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The margin, mm: the base is the origin, the apex lies on +y.
    pub outline: Outline,
    /// The veins, mm, in the same frame.
    pub network: VenationNetwork,
    /// What was found on the way.
    pub findings: Vec<Finding>,
    /// How places of the picture become millimetres.
    pub frame: Frame,
}

/// How places of a picture become places of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The base, pixels from the upper left corner.
    pub base_px: DVec2,
    /// The direction from base to apex in the picture, y down; its length is 1.
    pub axis: DVec2,
    /// Side of a pixel, mm.
    pub mm_per_pixel: f64,
}

impl Frame {
    /// A place of the picture as a place of the leaf, mm.
    pub fn to_mm(&self, place_px: DVec2) -> DVec2 {
        let off = place_px - self.base_px;
        // The picture's y points down: to the right of the axis is where the perpendicular leads.
        DVec2::new(off.dot(self.axis.perp()), off.dot(self.axis)) * self.mm_per_pixel
    }

    /// A place of the leaf, mm, as a place of the picture.
    pub fn to_px(&self, place_mm: DVec2) -> DVec2 {
        let off = place_mm / self.mm_per_pixel;
        self.base_px + self.axis.perp() * off.x + self.axis * off.y
    }
}
