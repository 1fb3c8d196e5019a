//! Where a layer of contents lies: weights from 0 to 1 over the lamina.

#[cfg(test)]
mod tests;

use std::sync::Arc;

use glam::DVec2;

use super::ageing::{Along, Place};
use super::frame::UvFrame;
use super::mottle::Mottle;
use crate::document::assets::Raster;
use crate::document::named_asset::decoded;
use crate::document::{Declared, Integer, Keys, Limits, Number, RangeError, Text};
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

impl<const N: usize> Default for Picture<N> {
    fn default() -> Self {
        Self::of_raster(String::new(), None, None)
    }
}

impl<const N: usize> Picture<N> {
    /// The picture of a file, once it is decoded.
    pub(super) fn of_raster(file: String, channel: Option<String>, read: Option<Raster>) -> Self {
        let (width, values) = read.map_or((1, Vec::new()), |read| (read.width, read.values));
        let texels = values.chunks_exact(N);
        Self {
            file,
            channel,
            width,
            texels: texels
                .map(|texel| std::array::from_fn(|index| texel[index]))
                .collect(),
        }
    }

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

/// Where a layer of contents lies.
#[derive(Clone, Debug, Declared, PartialEq)]
pub enum Mask {
    /// Everywhere alike.
    #[key(skip)]
    Everywhere,
    /// Within some distance of the margin.
    Margin {
        /// Width of the rim.
        #[key(flat, with = rim_width, default = RimWidth::Mm(0.0))]
        width: RimWidth,
        /// Width of the edge.
        #[key("softness_mm", 0.001..=1000.0, default = SOFTNESS_MM)]
        softness_mm: f64,
        /// Share by which its width varies along the margin.
        #[key("wander", 0.0..=1.0)]
        wander: f64,
        /// Size of those variations.
        #[key("wander_scale_mm", 0.01..=1000.0, default = SCALE_MM)]
        wander_scale_mm: f64,
    },
    /// Within some distance of the axes of veins.
    Veins {
        /// Lowest and highest order that count.
        #[key(flat, with = vein_orders, default = [1, 20])]
        orders: [u8; 2],
        /// Distance from the axis.
        #[key("width_mm", required, 0.0..=1000.0)]
        width_mm: f64,
        /// Width of the edge.
        #[key("softness_mm", 0.001..=1000.0, default = SOFTNESS_MM)]
        softness_mm: f64,
        /// Whether it lies between veins instead.
        #[key("outside")]
        outside: bool,
    },
    /// Within some distance of the line from base to apex.
    Midrib {
        /// Width of the edge.
        #[key("softness_mm", 0.001..=1000.0, default = SOFTNESS_MM)]
        softness_mm: f64,
        /// Distance from the line.
        #[key("width_mm", required, 0.0..=1000.0)]
        width_mm: f64,
    },
    /// More and more of it along the midrib.
    ///
    /// Either end may come first.
    #[key(last = ends)]
    BaseToTip {
        /// Where there is nothing of it: 0 the base, 1 the apex.
        #[key("from", 0.0..=1.0)]
        from: f64,
        /// Where there is all of it.
        #[key("to", 0.0..=1.0, default = 1.0)]
        to: f64,
    },
    /// In patches.
    ///
    /// Where gradient noise in [−1, 1] is above a threshold.
    Noise {
        /// Size of patches.
        #[key("scale_mm", 0.01..=1000.0, default = SCALE_MM)]
        scale_mm: f64,
        /// Noise above which there is some of it; higher is less.
        #[key("threshold", -1.0..=1.0)]
        threshold: f64,
        /// Width of the edge, in noise.
        #[key("softness", 0.001..=2.0, default = 0.3)]
        softness: f64,
        /// Patches after which the pattern repeats; left out, never.
        #[key("repeat_cells", 1..=65536)]
        repeat_cells: Option<u32>,
    },
    /// As a picture over the leaf's box says.
    ///
    /// The value is clamped to 0 to 1.
    #[key("image", with = picture)]
    Picture(Arc<Picture<1>>),
}

/// Width of a rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RimWidth {
    /// In millimetres, 0 to 1000.
    Mm(f64),
    /// In half-widths of the leaf, 0 to 2.
    HalfWidths(f64),
}

/// Width of edges where nothing is said, mm.
const SOFTNESS_MM: f64 = 0.5;
/// Size of patches where nothing is said, mm.
const SCALE_MM: f64 = 5.0;

fn rim_width(width: &mut RimWidth, keys: &mut Keys<'_>) {
    let current = match width {
        RimWidth::Mm(_) => "width_mm",
        RimWidth::HalfWidths(_) => "width_share",
    };
    for name in keys.one_of(&["width_mm", "width_share"], Some(current)) {
        let (RimWidth::Mm(mut value) | RimWidth::HalfWidths(mut value)) = *width;
        *width = if name == "width_mm" {
            let limits = Number(Limits::closed(0.0, 1000.0));
            keys.required("width_mm", &mut value, limits, "Width of the rim.");
            RimWidth::Mm(value)
        } else {
            let limits = Number(Limits::closed(0.0, 2.0));
            let about = "Width of the rim, in half-widths of the leaf.";
            keys.required("width_share", &mut value, limits, about);
            RimWidth::HalfWidths(value)
        };
    }
}

fn vein_orders([lowest, highest]: &mut [u8; 2], keys: &mut Keys<'_>) {
    let about = "Lowest order of veins that count.";
    keys.key("lowest_order", lowest, Integer::within(1, 20), about);
    let orders = Integer::within(u64::from(*lowest).max(1), 20);
    let about = "Highest order of veins that count.";
    keys.key("highest_order", highest, orders, about);
}

fn ends(mask: &mut Mask, keys: &mut Keys<'_>) {
    if keys.is_sound() && mask.validate().is_err() {
        let problem = "the layer begins where it is whole";
        let help = "let `from` and `to` differ";
        keys.refuse(&["to"], problem.to_owned(), help);
    }
}

fn picture(picture: &mut Arc<Picture<1>>, keys: &mut Keys<'_>) {
    let (mut file, mut channel) = (picture.file.clone(), picture.channel.clone());
    let path = Text("the path of a PNG or EXR");
    keys.required("file", &mut file, path, "The picture.");
    let name = Text("the name of a channel");
    let about = "Which channel of an EXR; left out, its grey.";
    keys.optional("channel", &mut channel, name, about);
    if file == picture.file && channel == picture.channel {
        return;
    }
    let decoded = decoded(keys, "file", &["png", "exr"], |assets, file| {
        let read = assets.grey(file, channel.as_deref());
        read.map_err(|problem| (problem, MEND_PICTURE))
    });
    *picture = Arc::new(Picture::of_raster(file, channel, decoded));
}

/// What to change in pictures of layers.
pub(super) const MEND_PICTURE: &str =
    "see docs/src/format/leaf.md for what pictures of layers hold";

impl Mask {
    /// Checks what the numbers are together.
    pub(super) fn validate(&self) -> Result<(), RangeError> {
        match self {
            Self::BaseToTip { from, to } => {
                RangeError::unless(from != to, "to", *to, "other than `from`")
            }
            Self::Picture(picture) => picture.validate(),
            Self::Everywhere
            | Self::Margin { .. }
            | Self::Veins { .. }
            | Self::Midrib { .. }
            | Self::Noise { .. } => Ok(()),
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
