//! Controls of a mosaic: cylinders with an image wrapped around their axis.

mod image;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::DVec3;

pub use self::image::{ControlImage, Pixels};
use crate::document::sections::Names;
use crate::document::values::text_at;
use crate::document::{Declared, Keys, Limits, Number, RangeError, Text, Word, Words};
use crate::not_grown::{NotGrown, not_grown};

const FACTOR: Number = Number(Limits::closed(0.0, 1000.0));

/// A cylinder around the surface or a part of it, the image wrapped around it, and what the image
/// controls. It has no effect outside the cylinder.
///
/// A point's place in the image is given by its angle about the axis (over `2π`, from 0 to 1
/// anticlockwise seen against the axis) and its height (0 at `from`, 1 at `to`). Angle 0 lies
/// towards +x; if the axis runs along x, towards +y. If the surface grows, a point's place on the
/// full-grown surface is used.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct CylinderControl {
    /// Where the axis starts.
    #[key("from_mm", required, -1e6..=1e6)]
    pub from: DVec3,
    /// Where the axis ends.
    #[key("to_mm", required, -1e6..=1e6)]
    #[key(with = axis)]
    pub to: DVec3,
    /// Radius of the cylinder; left out, all between its ends.
    #[key("radius_mm", above(0.0, 1e6))]
    pub radius_mm: Option<f64>,
    /// The image.
    #[key(flat, with = image::image)]
    pub image: ControlImage,
    /// What it controls.
    pub steers: Steered,
}

impl Default for CylinderControl {
    fn default() -> Self {
        Self {
            from: DVec3::ZERO,
            to: DVec3::ZERO,
            radius_mm: None,
            image: ControlImage::Constant(0.0),
            steers: Steered::Blocked,
        }
    }
}

/// Reports an axis without a length.
fn axis(control: &mut CylinderControl, keys: &mut Keys<'_>) {
    if keys.is_sound() && control.from == control.to {
        let problem = "the axis has no length: it ends where it starts";
        let help = "let the axis run through the body from end to end";
        keys.refuse(&["to_mm"], problem.to_owned(), help);
    }
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
    /// Factor on the probability that a child of the first type is of the second: `low` at value 0,
    /// `high` at value 1. The first type has the rest.
    Switching {
        /// The parent's type and the child's, which differ.
        pair: [u16; 2],
        /// Factor for black, 0 to 1000.
        low: f64,
        /// Factor for white, 0 to 1000.
        high: f64,
    },
    /// Where the value is ½ or more, no cell is created and none enters.
    Blocked,
}

/// What a control steers, as a file says it.
#[derive(Clone, Copy, PartialEq, Words)]
enum What {
    InitialType,
    DivisionRate,
    Adhesion,
    Switching,
    Blocked,
}

fn steered(steers: &mut Steered, keys: &mut Keys<'_>, types: &[String]) {
    let (mut what, [mut kind, mut other], [mut low, mut high]) = match *steers {
        Steered::InitialType(kind) => (What::InitialType, [Some(kind), None], [0.0, 1.0]),
        Steered::DivisionRate { kind, low, high } => {
            (What::DivisionRate, [kind, None], [low, high])
        }
        Steered::Adhesion { pair, low, high } => (What::Adhesion, pair.map(Some), [low, high]),
        Steered::Switching { pair, low, high } => (What::Switching, pair.map(Some), [low, high]),
        Steered::Blocked => (What::Blocked, [None; 2], [0.0, 1.0]),
    };
    let errors = keys.reader().map(|block| block.cx.error_count());
    let about = "What its grey values steer.";
    keys.required("steers", &mut what, Word(Words::WORDS), about);
    if keys.reader().is_some_and(|block| {
        Some(block.cx.error_count()) != errors || block.table.get("steers").is_none()
    }) {
        // Which keys belong here cannot be said.
        keys.leave(&["type", "other_type", "low", "high"]);
        return;
    }
    let all = keys.is_description();
    let is_pair = matches!(what, What::Adhesion | What::Switching);
    let named = is_pair || what == What::InitialType;
    if all || what != What::Blocked {
        let about = "The type of cell; for `division_rate` left out, all.";
        type_of(&mut kind, keys, "type", types, named, about);
    }
    if all || is_pair {
        let about = "The other type of cell for `adhesion`, that of the children for `switching`.";
        type_of(&mut other, keys, "other_type", types, true, about);
    }
    if all || is_pair || what == What::DivisionRate {
        keys.key("low", &mut low, FACTOR, "Factor where the image is black.");
        keys.key("high", &mut high, FACTOR, "Factor where it is white.");
    }
    let kind_or_first = kind.unwrap_or_default();
    let pair = [kind_or_first, other.unwrap_or_default()];
    if what == What::Switching && keys.is_sound() && pair[0] == pair[1] && !all {
        let problem = "cells do not switch to their own type, which has the rest".to_owned();
        keys.refuse(
            &["other_type"],
            problem,
            "name the type that children become",
        );
    }
    *steers = match what {
        What::InitialType => Steered::InitialType(kind_or_first),
        What::DivisionRate => Steered::DivisionRate { kind, low, high },
        What::Adhesion => Steered::Adhesion { pair, low, high },
        What::Switching => Steered::Switching { pair, low, high },
        What::Blocked => Steered::Blocked,
    };
}

/// The number of a type of cell by its name.
fn type_of(
    kind: &mut Option<u16>,
    keys: &mut Keys<'_>,
    key: &'static str,
    types: &[String],
    required: bool,
    about: &'static str,
) {
    const NAME: Text = Text("the name of a type");
    let mut name = kind.and_then(|kind| types.get(usize::from(kind)).cloned());
    if required && !keys.is_description() {
        let mut text = name.take().unwrap_or_default();
        keys.required(key, &mut text, NAME, about);
    } else {
        keys.optional(key, &mut name, NAME, about);
    }
    let Some(block) = keys.reader() else {
        return;
    };
    if let Some(entry) = block.table.get(key) {
        let names = Names::of_list("type of cell", types.iter().map(String::as_str));
        let written = text_at(block.cx, &entry.node, key);
        let found = written.and_then(|written| names.find(block.cx, written));
        *kind = found.map(|index| index as u16);
    }
}

impl CylinderControl {
    /// Its keys; `types` are the names of the cell types.
    pub(super) fn keys(&mut self, keys: &mut Keys<'_>, types: &[String]) {
        self.declare(keys);
        steered(&mut self.steers, keys, types);
    }

    /// Checks the axis, the image and the types named.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for the first error found.
    pub fn validate(&self, types: usize) -> Result<(), NotGrown> {
        self.in_range()?;
        if self.from == self.to {
            let (from, to) = (self.from, self.to);
            return Err(not_grown!(
                "the axis runs from {from} mm to {to} mm; it needs two places, finite and apart"
            ));
        }
        let (kinds, factors) = match self.steers {
            Steered::InitialType(kind) => ([Some(kind), None], [0.0; 2]),
            Steered::DivisionRate { kind, low, high } => ([kind, None], [low, high]),
            Steered::Adhesion { pair, low, high } | Steered::Switching { pair, low, high } => {
                (pair.map(Some), [low, high])
            }
            Steered::Blocked => ([None; 2], [0.0; 2]),
        };
        if let Some(kind) = kinds
            .into_iter()
            .flatten()
            .find(|kind| usize::from(*kind) >= types)
        {
            return Err(not_grown!(
                "it steers type {kind}, but there are {types} types (from 0)"
            ));
        }
        for (path, factor) in ["low", "high"].into_iter().zip(factors) {
            RangeError::unless((0.0..=1000.0).contains(&factor), path, factor, "0 to 1000")?;
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

    /// The probabilities of the types of a child whose parent, of type `kind`, is at a point.
    pub(super) fn switching<'a>(&self, at: DVec3, kind: u16, row: &'a [f64]) -> Cow<'a, [f64]> {
        let mut row = Cow::Borrowed(row);
        for control in self.0 {
            let Steered::Switching {
                pair: [parent, child],
                low,
                high,
            } = control.steers
            else {
                continue;
            };
            if let Some(value) = control.value(at).filter(|_| parent == kind) {
                let [own, other] = [parent, child].map(usize::from);
                let sum = row[own] + row[other];
                let row = row.to_mut();
                row[other] = (row[other] * (low + value * (high - low))).min(sum);
                row[own] = sum - row[other];
            }
        }
        row
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
