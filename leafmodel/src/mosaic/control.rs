//! Controls of a mosaic: cylinders with an image wrapped around their axis.

mod image;
#[cfg(test)]
mod tests;

use std::f64::consts::TAU;

use glam::DVec3;
use thiserror::Error;

pub use self::image::ControlImage;
use crate::document::ranges::RangeError;

/// A cylinder around the surface or a part of it, the image wrapped around it, and what the image
/// controls. It has no effect outside the cylinder.
///
/// A point's place in the image is given by its angle about the axis (over `2π`, from 0 to 1
/// anticlockwise seen against the axis) and its height (0 at `from`, 1 at `to`). Angle 0 lies
/// towards +x; if the axis runs along x, towards +y. If the surface grows, a point's place on the
/// full-grown surface is used.
#[derive(Clone, Debug, PartialEq)]
pub struct CylinderControl {
    /// Where the axis starts, mm.
    pub from: DVec3,
    /// Where the axis ends, mm.
    pub to: DVec3,
    /// Radius, mm; `None` means unlimited between the two ends.
    pub radius_mm: Option<f64>,
    /// The image.
    pub image: ControlImage,
    /// What it controls.
    pub steers: Steered,
}

/// What the grey values of an image (0 to 1) control. Cell types are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steered {
    /// The value is the probability that an initial cell is of a type; the other types share the
    /// rest in their old proportions.
    InitialType(u16),
    /// Factor on the division rate of the type: `low` at value 0, `high` at value 1.
    DivisionRate {
        /// The type; `None` means all.
        kind: Option<u16>,
        /// Factor for black, 0 to 1000.
        low: f64,
        /// Factor for white, 0 to 1000.
        high: f64,
    },
    /// Factor on the adhesion of two types: `low` at value 0, `high` at value 1. The product is at
    /// most 1.
    Adhesion {
        /// The two types, which may be the same.
        pair: [u16; 2],
        /// Factor for black, 0 to 1000.
        low: f64,
        /// Factor for white, 0 to 1000.
        high: f64,
    },
    /// Where the value is ½ or more, no cell is created and none enters.
    Blocked,
}

/// Why a control is refused.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ControlError {
    /// The axis has no direction.
    #[error("the axis runs from {from} mm to {to} mm; it needs two places, finite and apart")]
    Axis {
        /// Its start.
        from: DVec3,
        /// Its end.
        to: DVec3,
    },
    /// A cell type does not exist.
    #[error("it steers type {kind}, but there are {types} types (from 0)")]
    NoSuchType {
        /// Which one.
        kind: u16,
        /// How many there are.
        types: usize,
    },
    /// A number is out of its range.
    #[error("its {0}")]
    Range(#[from] RangeError),
    /// A picture does not have one value per pixel.
    #[error("its picture of {width} × {height} pixels has {values} values")]
    PictureSize {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// How many values there are.
        values: usize,
    },
}

impl CylinderControl {
    /// Checks the axis, the image and the types named.
    ///
    /// # Errors
    ///
    /// [`ControlError`] for the first error found.
    pub fn validate(&self, types: usize) -> Result<(), ControlError> {
        let length = self.from.distance(self.to);
        if !length.is_finite() || length <= 0.0 {
            return Err(ControlError::Axis {
                from: self.from,
                to: self.to,
            });
        }
        if let Some(radius) = self.radius_mm {
            let good = radius > 0.0 && radius.is_finite();
            check("radius_mm", radius, good, "the positive numbers")?;
        }
        let known = |kind: u16| {
            let missing = ControlError::NoSuchType { kind, types };
            if usize::from(kind) < types {
                Ok(())
            } else {
                Err(missing)
            }
        };
        let factors = |low: f64, high: f64| {
            let range = 0.0..=1000.0;
            check("factor for black", low, range.contains(&low), "0 to 1000")?;
            check("factor for white", high, range.contains(&high), "0 to 1000")
        };
        match self.steers {
            Steered::InitialType(kind) => known(kind)?,
            Steered::DivisionRate { kind, low, high } => {
                kind.map_or(Ok(()), known)?;
                factors(low, high)?;
            }
            Steered::Adhesion { pair, low, high } => {
                known(pair[0])?;
                known(pair[1])?;
                factors(low, high)?;
            }
            Steered::Blocked => {}
        }
        self.image.validate()
    }

    /// The image's value at a point in space (mm), 0 to 1; `None` outside the cylinder.
    pub fn value(&self, at: DVec3) -> Option<f64> {
        let axis = self.to - self.from;
        let height = (at - self.from).dot(axis) / axis.length_squared();
        if !(0.0..=1.0).contains(&height) {
            return None;
        }
        let out = at - self.from - axis * height;
        if self.radius_mm.is_some_and(|radius| out.length() > radius) {
            return None;
        }
        let axis = axis.normalize();
        let towards = if axis.x.abs() > 1.0 - 1e-9 {
            DVec3::Y
        } else {
            DVec3::X
        };
        let zero = towards.reject_from_normalized(axis).normalize();
        let angle = libm::atan2(out.dot(axis.cross(zero)), out.dot(zero)) / TAU;
        let turn = if angle < 0.0 { angle + 1.0 } else { angle };
        Some(self.image.value(turn.min(1.0), height))
    }
}

pub(super) fn check(
    field: &'static str,
    value: f64,
    good: bool,
    range: &'static str,
) -> Result<(), ControlError> {
    Ok(RangeError::unless(good, field, value, range)?)
}

/// All controls of a plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct Controls<'a>(pub(super) &'a [CylinderControl]);

impl Controls<'_> {
    /// Whether a point is blocked for cells.
    pub(super) fn is_blocked(&self, at: DVec3) -> bool {
        let blocked = |control: &CylinderControl| {
            matches!(control.steers, Steered::Blocked)
                && control.value(at).is_some_and(|value| value >= 0.5)
        };
        self.0.iter().any(blocked)
    }

    pub(super) fn block(&self) -> bool {
        self.0
            .iter()
            .any(|control| matches!(control.steers, Steered::Blocked))
    }

    pub(super) fn steer_adhesion(&self) -> bool {
        self.0
            .iter()
            .any(|control| matches!(control.steers, Steered::Adhesion { .. }))
    }

    /// Applies the controls to the probabilities of an initial cell's types at a point.
    pub(super) fn initial(&self, at: DVec3, probabilities: &mut [f64]) {
        for control in self.0 {
            let Steered::InitialType(kind) = control.steers else {
                continue;
            };
            let Some(value) = control.value(at) else {
                continue;
            };
            let kind = usize::from(kind);
            let rest: f64 = probabilities.iter().sum::<f64>() - probabilities[kind];
            let others = probabilities.len() - 1;
            for (other, probability) in probabilities.iter_mut().enumerate() {
                if other == kind {
                    *probability = if others == 0 { 1.0 } else { value };
                } else if rest > 0.0 {
                    *probability *= (1.0 - value) / rest;
                } else {
                    *probability = (1.0 - value) / others as f64;
                }
            }
        }
    }

    /// Factor on the division rate of a type at a point.
    pub(super) fn rate(&self, at: DVec3, kind: u16) -> f64 {
        let mut factor = 1.0;
        for control in self.0 {
            if let Steered::DivisionRate {
                kind: only,
                low,
                high,
            } = control.steers
                && only.is_none_or(|only| only == kind)
                && let Some(value) = control.value(at)
            {
                factor *= low + value * (high - low);
            }
        }
        factor
    }

    /// Applies the controls to a row of the adhesion matrix: that of type `kind` at a point.
    pub(super) fn adhesion(&self, at: DVec3, kind: u16, row: &mut [f64]) {
        for control in self.0 {
            let Steered::Adhesion { pair, low, high } = control.steers else {
                continue;
            };
            let other = match pair {
                [a, b] if a == kind => b,
                [a, b] if b == kind => a,
                _ => continue,
            };
            if let Some(value) = control.value(at) {
                let adhesion = &mut row[usize::from(other)];
                *adhesion = (*adhesion * (low + value * (high - low))).min(1.0);
            }
        }
    }
}
