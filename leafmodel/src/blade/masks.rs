//! Where a layer of contents lies: weights from 0 to 1 over the lamina.

#[cfg(test)]
mod tests;

use std::sync::Arc;

use glam::DVec2;

use super::ageing::{Along, Place};
use super::frame::UvFrame;
use super::mottle::Mottle;
use crate::document::ranges::RangeError;
use crate::numeric::smooth_step;
use crate::plane::distances::Distances;

/// A picture over the box of a leaf, decoded.
///
/// Texel centres are at `((column + ½) / width, (row + ½) / height)` of the leaf's [`UvFrame`], row
/// 0 at the least y; between them values are interpolated linearly, beyond them the outermost value
/// is repeated.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture<const N: usize> {
    /// The file that it came from, as the plan names it.
    pub file: String,
    /// The channel, if the plan names one.
    pub channel: Option<String>,
    /// Texels across, ≥ 1.
    pub width: usize,
    /// The texels row by row, at least one whole row.
    pub texels: Vec<[f32; N]>,
}

impl<const N: usize> Picture<N> {
    /// The values at texture coordinates.
    #[must_use]
    pub fn at(&self, uv: DVec2) -> [f64; N] {
        let height = self.texels.len() / self.width;
        let axis = |t: f64, count: usize| {
            let place = (t * count as f64 - 0.5).clamp(0.0, (count - 1) as f64);
            let first = place as usize;
            (first, (first + 1).min(count - 1), place - first as f64)
        };
        let (left, right, x) = axis(uv.x, self.width);
        let (low, high, y) = axis(uv.y, height);
        let texel = |row: usize, column: usize| self.texels[row * self.width + column];
        let corners = [
            texel(low, left),
            texel(low, right),
            texel(high, left),
            texel(high, right),
        ];
        std::array::from_fn(|i| {
            let [a, b, c, d] = corners.map(|corner| f64::from(corner[i]));
            let (near, far) = (a + (b - a) * x, c + (d - c) * x);
            near + (far - near) * y
        })
    }

    fn validate(&self) -> Result<(), RangeError> {
        let whole = self.width > 0 && !self.texels.is_empty();
        let whole = whole && self.texels.len().is_multiple_of(self.width);
        let texels = self.texels.len() as f64;
        RangeError::unless(
            whole,
            "texels of a picture",
            texels,
            "whole rows, 1 at least",
        )
    }
}

/// The place of a layer, as a weight. Edges are smooth steps of width `softness_mm`, centred on the
/// place that the numbers give.
#[derive(Clone, Debug, PartialEq)]
pub enum Mask {
    /// Everywhere alike.
    Everywhere,
    /// Within some distance of the margin.
    Margin {
        /// Width of the rim.
        width: RimWidth,
        /// Width of its edge, mm, 0.001 to 1000.
        softness_mm: f64,
        /// Share by which its width varies along the margin, 0 to 1.
        wander: f64,
        /// Size of those variations, mm, 0.01 to 1000.
        wander_scale_mm: f64,
    },
    /// Within some distance of the axes of veins, or outside of it.
    Veins {
        /// Lowest and highest order that count, 1 to 20.
        orders: [u8; 2],
        /// Distance, mm, 0 to 1000.
        width_mm: f64,
        /// Width of the edge, mm, 0.001 to 1000.
        softness_mm: f64,
        /// Whether it lies between veins instead.
        outside: bool,
    },
    /// Within some distance of the straight line from base to apex.
    Midrib {
        /// Distance, mm, 0 to 1000.
        width_mm: f64,
        /// Width of the edge, mm, 0.001 to 1000.
        softness_mm: f64,
    },
    /// A ramp along the midrib from weight 0 to weight 1. Places are 0 at the base, 1 at the apex,
    /// and either end may come first.
    BaseToTip {
        /// Place where the weight is 0, 0 to 1.
        from: f64,
        /// Place where the weight is 1, 0 to 1, other than `from`.
        to: f64,
    },
    /// Where gradient noise in [−1, 1] is above a threshold.
    Noise {
        /// Size of patches, mm, 0.01 to 1000.
        scale_mm: f64,
        /// −1 to 1: at −1 nearly all is covered, at 1 nothing.
        threshold: f64,
        /// Width of the edge in the noise's own unit, 0.001 to 2.
        softness: f64,
        /// Number of cells of `scale_mm` after which the noise repeats, 1 to 65536; `None` if it
        /// does not.
        repeat_cells: Option<u32>,
    },
    /// The value of a picture, clamped to 0 to 1.
    Picture(Arc<Picture<1>>),
}

/// How wide a rim along the margin is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RimWidth {
    /// In millimetres, 0 to 1000.
    Mm(f64),
    /// As a share of half the width of the leaf's box, 0 to 2.
    HalfWidths(f64),
}

impl Mask {
    /// Checks what the ranges of its keys leave open.
    pub(super) fn validate(&self) -> Result<(), RangeError> {
        match self {
            Self::BaseToTip { from, to } => {
                RangeError::unless(from != to, "to", *to, "other than `from`")
            }
            Self::Veins {
                orders: [first, last],
                ..
            } => {
                let limits = "rising, from 1 to 20";
                RangeError::unless(first <= last, "orders", f64::from(*last), limits)
            }
            Self::Picture(picture) => picture.validate(),
            Self::Everywhere | Self::Margin { .. } | Self::Midrib { .. } | Self::Noise { .. } => {
                Ok(())
            }
        }
    }
}

/// A mask prepared for many points of one leaf.
#[derive(Debug)]
pub(super) struct MaskField<'a> {
    frame: &'a UvFrame,
    along: Along,
    mask: &'a Mask,
    distances: Option<Distances>,
    noise: Option<Mottle>,
}

impl<'a> MaskField<'a> {
    pub(super) fn new(mask: &'a Mask, place: &Place<'a>, seed: u64) -> Self {
        let (mut distances, mut noise) = (None, None);
        match mask {
            Mask::Everywhere | Mask::BaseToTip { .. } | Mask::Picture(_) => {}
            Mask::Margin {
                wander,
                wander_scale_mm,
                ..
            } => {
                distances = Some(place.margin_distances());
                noise = (*wander > 0.0).then(|| Mottle::new(seed, *wander_scale_mm));
            }
            Mask::Veins { orders, .. } => distances = Some(place.vein_distances(*orders)),
            Mask::Midrib { .. } => {
                let line = vec![[place.base, place.apex]];
                distances = Some(Distances::new(line));
            }
            Mask::Noise {
                scale_mm,
                repeat_cells,
                ..
            } => {
                let endless = Mottle::new(seed, *scale_mm);
                noise = Some(repeat_cells.map_or(endless, |cells| endless.repeating(cells)));
            }
        }
        Self {
            frame: place.frame,
            along: place.along(),
            mask,
            distances,
            noise,
        }
    }

    /// The weight at a point (mm), 0 to 1.
    pub(super) fn at(&self, p: DVec2) -> f64 {
        let distance = || self.distances.as_ref().map_or(0.0, |field| field.at(p));
        let noise = || self.noise.map_or(0.0, |noise| noise.at(p));
        match *self.mask {
            Mask::Everywhere => 1.0,
            Mask::Margin {
                width,
                softness_mm,
                wander,
                ..
            } => {
                let mm = match width {
                    RimWidth::Mm(mm) => mm,
                    RimWidth::HalfWidths(share) => share * 0.5 * self.frame.size.x,
                };
                let mm = mm * (1.0 + wander * noise());
                step((mm - distance()) / softness_mm)
            }
            Mask::Veins {
                width_mm,
                softness_mm,
                outside,
                ..
            } => {
                let inside = step((width_mm - distance()) / softness_mm);
                if outside { 1.0 - inside } else { inside }
            }
            Mask::Midrib {
                width_mm,
                softness_mm,
            } => step((width_mm - distance()) / softness_mm),
            Mask::BaseToTip { from, to } => {
                step((self.along.at(p) - 0.5 * (from + to)) / (to - from))
            }
            Mask::Noise {
                threshold,
                softness,
                ..
            } => step((noise() - threshold) / softness),
            Mask::Picture(ref picture) => {
                let [value] = picture.at(self.frame.uv(p));
                value.clamp(0.0, 1.0)
            }
        }
    }
}

/// 0 up to −½, 1 from ½ on, smooth between.
fn step(x: f64) -> f64 {
    smooth_step(x + 0.5)
}
