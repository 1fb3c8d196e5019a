//! Why no leaf grows.

use thiserror::Error;

use crate::blade::mesh::BladeError;
use crate::document::RangeError;
use crate::not_grown::NotGrown;

/// Why a plan cannot be carried out.
#[derive(Debug, Error)]
pub enum LeafError {
    /// The outline.
    #[error("outline: {0}")]
    Outline(#[source] NotGrown),
    /// The veins.
    #[error("venation: {0}")]
    Venation(#[source] NotGrown),
    /// Stages of a leaf that has none.
    #[error("there are no stages of growth: {0}")]
    NoStages(&'static str),
    /// Ageing by revenue where no cell earns any.
    #[error(
        "senescence: revenue_share needs the cells of a transport leaf: outline.transport or venation.transport"
    )]
    NoRevenue,
    /// Damage.
    #[error("damage: {0}")]
    Damage(#[source] RangeError),
    /// The blade.
    #[error("blade: {0}")]
    Blade(#[from] BladeError),
    /// The mosaic of its cells.
    #[error("mosaic: {0}")]
    Mosaic(#[source] NotGrown),
    /// The tissue.
    #[error("tissue: {0}")]
    Tissue(#[from] RangeError),
}

impl LeafError {
    /// Whether nothing is wrong with the plan: the caller has stopped its growth.
    pub fn is_stop(&self) -> bool {
        matches!(self, Self::Venation(error) | Self::Mosaic(error) if error.is_stop())
    }
}
