//! The share of veins in the tissue at a point.

/// The share of veins in the tissue at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinCover {
    /// 0 between veins to 1 over a fully developed one; finer veins reach less.
    pub weight: f64,
    /// `r / r_full − 1` on the axis of a vein of radius `r > r_full`, falling to 0 at its edge; 0
    /// elsewhere. With a [`VeinBody`](super::vein_body::VeinBody): layers as thick as the blade by
    /// which the vein is thicker.
    pub excess: f64,
}

impl VeinCover {
    pub(super) const NONE: Self = Self {
        weight: 0.0,
        excess: 0.0,
    };

    pub(super) fn strongest(self, other: Self) -> Self {
        Self {
            weight: self.weight.max(other.weight),
            excess: self.excess.max(other.excess),
        }
    }
}
