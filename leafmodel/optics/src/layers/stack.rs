//! Layers that lie on each other, with air on both sides.

use thiserror::Error;

use super::phase::Phase;

/// A plane-parallel layer of a medium that scatters and absorbs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Refractive index over that of air, 1 to 3.
    pub index: f64,
    /// `a`, share of what meets a scatterer or an absorber that is scattered, in [0, 1].
    pub albedo: f64,
    /// `b`, scattering and absorption coefficient times thickness, ≥ 0; infinite in the last layer
    /// only.
    pub depth: f64,
    /// Directions of what is scattered.
    pub phase: Phase,
}

impl Layer {
    /// Of optical depths of scattering and of absorption.
    pub(crate) fn of_depths(index: f64, scattering: f64, absorption: f64, phase: Phase) -> Self {
        let depth = scattering + absorption;
        let albedo = if depth > 0.0 { scattering / depth } else { 0.0 };
        Self {
            index,
            albedo,
            depth,
            phase,
        }
    }
}

/// Layers from the first face to the last, with smooth boundaries between indices that differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Stack(Vec<Layer>);

/// A parameter of layers outside the range in which the model holds.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum StackError {
    /// No layer.
    #[error("there are no layers, there must be at least one")]
    Empty,
    /// A number is out of range.
    #[error("{field} of layer {layer} is {value}, it must be {range}")]
    OutOfRange {
        /// Which layer, from 1.
        layer: usize,
        /// Which of its numbers.
        field: &'static str,
        /// What it is.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The phase function's parameters are out of range.
    #[error("the phase function of layer {layer} has a mean cosine or a share out of range")]
    Phase {
        /// Which layer, from 1.
        layer: usize,
    },
    /// Light was asked for along a direction that was not solved for.
    #[error("the layers were not solved for a direction of cosine {cosine}")]
    NotSolvedFor {
        /// What was asked for.
        cosine: f64,
    },
    /// The cosine of a direction is out of range.
    #[error("the cosine of a direction is {cosine}, it must be above 0 and at most 1")]
    Direction {
        /// What it is.
        cosine: f64,
    },
}

impl Stack {
    /// The layers if all are in range.
    ///
    /// # Errors
    ///
    /// [`StackError`] for the first number out of range. A layer without end must absorb, since
    /// light would never leave it otherwise.
    pub fn new(layers: Vec<Layer>) -> Result<Self, StackError> {
        let count = layers.len();
        if count == 0 {
            return Err(StackError::Empty);
        }
        for (number, layer) in (1..).zip(&layers) {
            let endless = layer.depth == f64::INFINITY;
            let rules = [
                (
                    "the index",
                    layer.index,
                    (1.0..=3.0).contains(&layer.index),
                    "from 1 to 3",
                ),
                (
                    "the albedo",
                    layer.albedo,
                    (0.0..=1.0).contains(&layer.albedo) && !(endless && layer.albedo == 1.0),
                    "from 0 to 1, and below 1 in a layer of infinite depth",
                ),
                (
                    "the optical depth",
                    layer.depth,
                    layer.depth >= 0.0 && (!endless || number == count),
                    "at least 0, and infinite in the last layer only",
                ),
            ];
            for (field, value, good, range) in rules {
                if !good {
                    return Err(StackError::OutOfRange {
                        layer: number,
                        field,
                        value,
                        range,
                    });
                }
            }
            if !layer.phase.is_valid() {
                return Err(StackError::Phase { layer: number });
            }
        }
        Ok(Self(layers))
    }

    /// The layers, from the first face on.
    pub fn layers(&self) -> &[Layer] {
        &self.0
    }
}

/// Which face of a stack is lit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// That of the first layer.
    First,
    /// That of the last layer.
    Last,
}

/// How light falls on a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Incidence {
    /// From one direction, at this cosine to the normal, in (0, 1].
    Directional {
        /// The cosine.
        cosine: f64,
    },
    /// Evenly from the whole hemisphere.
    Lambertian,
}

impl Incidence {
    /// Along the normal.
    pub const NORMAL: Self = Self::Directional { cosine: 1.0 };

    /// The incidence itself if its direction is in range.
    pub(super) fn checked(self) -> Result<Self, StackError> {
        match self {
            Self::Directional { cosine } if !(cosine > 0.0 && cosine <= 1.0) => {
                Err(StackError::Direction { cosine })
            }
            Self::Directional { .. } | Self::Lambertian => Ok(self),
        }
    }
}
