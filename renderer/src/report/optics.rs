//! What the model says of a leaf of given contents: spectra, layers, directions, colours, figures.

pub(crate) mod angles;
pub(crate) mod colour;
pub(crate) mod figures;
pub(crate) mod layers;
pub(crate) mod spectra;
