//! Toothed margins: triangular waves along an outline, added up.
//!
//! - **In**: an [`Outline`] and waves, each with a number of teeth per side.
//! - **Out**: the outline with its margin moved outward by the sum of the waves.
//! - **Always true**: base and apex stay where they are; a mirror symmetric outline stays one.
//!
//! # Source
//!
//! \[runions2005\], section 3.2: a toothed contour is a curve plus triangular waves of several
//! amplitudes and frequencies. Lean and fade of the waves are our additions.

use glam::DVec2;
use thiserror::Error;

use super::outline::{Outline, OutlineError};

/// Greatest number of waves of a margin.
const MOST_WAVES: usize = 20;

/// One triangular wave along each side of a margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothWave {
    /// Teeth on each side, 1 to 1000, of equal length along the margin.
    pub per_side: u32,
    /// Height of a tooth, as a share of the midrib's length, > 0 up to 0.5.
    pub height: f64,
    /// Where the tip of a tooth points, −1 to 1: 0 gives symmetric triangles; 1 gives saw teeth
    /// whose upright side faces the apex, −1 the base.
    pub lean: f64,
    /// Share of the side, from the base, over which teeth rise to their full height, 0 to 1.
    pub fade_base: f64,
    /// Share of the side, up to the apex, over which their height falls to 0 again, 0 to 1.
    pub fade_apex: f64,
}

/// Why a margin cannot be toothed.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TeethError {
    /// A number out of range.
    #[error("teeth {index}: {key} is {value}, outside {range}")]
    OutOfRange {
        /// Which wave, from 0.
        index: usize,
        /// Which parameter.
        key: &'static str,
        /// What it was.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Too many waves.
    #[error("a margin has at most 20 waves of teeth, here are {waves}")]
    TooManyWaves {
        /// How many.
        waves: usize,
    },
    /// One side, from base to apex, has no length.
    #[error(
        "base and apex are nearest to the same place of the margin, so it has no sides to bear teeth"
    )]
    NoSides,
    /// Teeth run into each other.
    #[error("the toothed margin is none: {0}")]
    NoMargin(#[from] OutlineError),
}

impl ToothWave {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`TeethError::OutOfRange`] with the wave's number `index`.
    pub fn validate(&self, index: usize) -> Result<(), TeethError> {
        let checks = [
            (
                "per_side",
                f64::from(self.per_side),
                1.0,
                1000.0,
                "1 to 1000",
            ),
            (
                "height",
                self.height,
                1e-6,
                0.5,
                "0 (excluded) to 0.5 (of the length)",
            ),
            ("lean", self.lean, -1.0, 1.0, "-1 to 1"),
            (
                "fade_base",
                self.fade_base,
                0.0,
                1.0,
                "0 to 1 (of the side)",
            ),
            (
                "fade_apex",
                self.fade_apex,
                0.0,
                1.0,
                "0 to 1 (of the side)",
            ),
        ];
        for (key, value, low, high, range) in checks {
            if !(low..=high).contains(&value) {
                return Err(TeethError::OutOfRange {
                    index,
                    key,
                    value,
                    range,
                });
            }
        }
        Ok(())
    }

    /// Height at a share of the side, in shares of the midrib's length. Where a side of a tooth is
    /// upright, the height just before the place if `before`, else that just after it.
    fn at(&self, share: f64, before: bool) -> f64 {
        let teeth = f64::from(self.per_side);
        let along = share * teeth;
        // Break points from `breaks` are rounded, so a place next to one is snapped to the tooth it
        // belongs to.
        let nearest = along.round();
        let (tooth, within) = if (along - nearest).abs() < 1e-9 {
            if before {
                (nearest - 1.0, 1.0)
            } else {
                (nearest, 0.0)
            }
        } else {
            (along.floor(), along - along.floor())
        };
        if !(0.0..teeth).contains(&tooth) {
            return 0.0;
        }
        let tip = f64::midpoint(1.0, self.lean);
        let rise = if within <= tip && tip > 0.0 {
            within / tip
        } else {
            1.0
        };
        let fall = if within >= tip && tip < 1.0 {
            (1.0 - within) / (1.0 - tip)
        } else {
            1.0
        };
        let fade = |from_end: f64, over: f64| {
            if from_end < over {
                from_end / over
            } else {
                1.0
            }
        };
        self.height
            * rise.min(fall)
            * fade(share, self.fade_base)
            * fade(1.0 - share, self.fade_apex)
    }

    /// Shares of the side at which the wave bends: notches and tips.
    fn breaks(&self) -> impl Iterator<Item = f64> {
        let teeth = f64::from(self.per_side);
        let tip = f64::midpoint(1.0, self.lean);
        (0..self.per_side)
            .flat_map(move |i| [f64::from(i), f64::from(i) + tip])
            .map(move |along| along / teeth)
    }
}

/// The outline with teeth: every place of the margin moved outward by the sum of `waves` there.
///
/// Each side is measured along the margin from base to apex. Outward is perpendicular to the chord
/// between two places of the margin, one before and one behind, each a quarter of the shortest
/// tooth away, or the total height of all waves if that is more. So the direction changes smoothly
/// along a polygonal margin, and slowly enough that neighbouring teeth do not cross in a bay.
/// Notches and tips are corners of the result, as are those of the outline.
///
/// # Errors
///
/// [`TeethError`] if a number is out of range, or if the new margin crosses itself.
pub fn toothed(outline: &Outline, waves: &[ToothWave]) -> Result<Outline, TeethError> {
    if waves.len() > MOST_WAVES {
        return Err(TeethError::TooManyWaves { waves: waves.len() });
    }
    for (index, wave) in waves.iter().enumerate() {
        wave.validate(index)?;
    }
    let Some(shortest) = waves.iter().map(|wave| wave.per_side).max() else {
        return Ok(outline.clone());
    };
    let [right, left] = sides(outline).map(Side::new);
    let (Some(right), Some(left)) = (right, left) else {
        return Err(TeethError::NoSides);
    };
    let quarter = 0.25 / f64::from(shortest);
    let highest: f64 = waves
        .iter()
        .map(|wave| wave.height * outline.length())
        .sum();
    let shape = |side: Side, sign: f64| {
        let reach = quarter.max(highest / side.length).min(0.25);
        side.toothed(waves, outline.length(), reach, sign)
    };
    let mut margin = shape(right, 1.0);
    let mut back = shape(left, -1.0);
    // Both sides include base and apex, which must not be repeated.
    back.reverse();
    margin.extend(back);
    Ok(Outline::new(margin, outline.base(), outline.apex())?)
}

/// A side of a margin, from base to apex.
struct Side {
    points: Vec<DVec2>,
    /// Distance along the margin to each point, as a share of the side.
    shares: Vec<f64>,
    /// Length of the side.
    length: f64,
}

impl Side {
    /// A side through these points; `None` if all coincide.
    fn new(points: Vec<DVec2>) -> Option<Self> {
        let mut length = 0.0;
        let mut shares = vec![0.0];
        for edge in points.windows(2) {
            length += (edge[1] - edge[0]).length();
            shares.push(length);
        }
        if length <= 0.0 {
            return None;
        }
        for share in &mut shares {
            *share /= length;
        }
        Some(Self {
            points,
            shares,
            length,
        })
    }

    /// The place at a share of the side.
    fn at(&self, share: f64) -> DVec2 {
        let behind = self.shares.partition_point(|&s| s < share);
        let i = behind.clamp(1, self.points.len() - 1);
        let (s0, s1) = (self.shares[i - 1], self.shares[i]);
        let along = ((share - s0) / (s1 - s0)).clamp(0.0, 1.0);
        self.points[i - 1] + (self.points[i] - self.points[i - 1]) * along
    }

    /// The side with teeth; outward is to the right for `sign` 1, to the left for −1.
    fn toothed(&self, waves: &[ToothWave], length: f64, reach: f64, sign: f64) -> Vec<DVec2> {
        let mut stops: Vec<f64> = self.shares.clone();
        stops.extend(waves.iter().flat_map(ToothWave::breaks));
        stops.retain(|share| (0.0..=1.0).contains(share));
        stops.sort_unstable_by(f64::total_cmp);
        // A corner of a tooth at a corner of the margin would give an edge without length.
        stops.dedup_by(|next, kept| *next - *kept < 1e-9);
        let mut margin = Vec::with_capacity(stops.len());
        for share in stops {
            let chord = self.at((share + reach).min(1.0)) - self.at((share - reach).max(0.0));
            let outward = DVec2::new(chord.y * sign, -chord.x * sign).normalize_or_zero();
            let heights = [true, false].map(|before| -> f64 {
                let sum: f64 = waves.iter().map(|wave| wave.at(share, before)).sum();
                sum * length
            });
            let place = self.at(share);
            margin.push(place + outward * heights[0]);
            if heights[1] != heights[0] {
                margin.push(place + outward * heights[1]);
            }
        }
        margin
    }
}

/// Points of the right and the left side of a margin, each from the place nearest to the base to
/// that nearest to the apex.
fn sides(outline: &Outline) -> [Vec<DVec2>; 2] {
    let points = outline.points();
    let n = points.len();
    let [base, apex] = [outline.base(), outline.apex()].map(|p| nearest(points, p));
    // Counter-clockwise from one end to the other.
    let walk = |from: &Place, to: &Place| {
        let corners = if from.edge == to.edge && from.along <= to.along {
            0
        } else {
            (to.edge + n - from.edge - 1) % n + 1
        };
        let mut side = vec![from.at];
        side.extend((1..=corners).map(|k| points[(from.edge + k) % n]));
        side.push(to.at);
        side.dedup();
        side
    };
    let mut left = walk(&apex, &base);
    left.reverse();
    [walk(&base, &apex), left]
}

/// A place on a polygon.
struct Place {
    edge: usize,
    along: f64,
    at: DVec2,
}

/// The place on a polygon that is nearest to `p`; the first of several.
fn nearest(points: &[DVec2], p: DVec2) -> Place {
    let mut best = Place {
        edge: 0,
        along: 0.0,
        at: points[0],
    };
    for (edge, &start) in points.iter().enumerate() {
        let way = points[(edge + 1) % points.len()] - start;
        let along = ((p - start).dot(way) / way.length_squared()).clamp(0.0, 1.0);
        let at = if along == 1.0 {
            start + way
        } else {
            start + way * along
        };
        if (at - p).length_squared() < (best.at - p).length_squared() {
            best = Place { edge, along, at };
        }
    }
    best
}

#[cfg(test)]
mod tests;
