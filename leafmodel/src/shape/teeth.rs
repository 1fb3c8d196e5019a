//! Toothed margins: waves along an outline, added up.
//!
//! - **In**: an [`Outline`] and waves, each with a number of teeth per side.
//! - **Out**: the outline with its margin moved outward by the sum of the waves, and tips on teeth
//!   and lobes.
//! - **Always true**: base and apex stay where they are; without chance in the waves a mirror
//!   symmetric outline stays one; the margin does not cross itself.
//!
//! # Source
//!
//! \[runions2005\], section 3.2: a toothed contour is a curve plus triangular waves of several
//! amplitudes and frequencies. Forms, lean, fade, chance and tips of the waves are our additions.

mod layout;
mod wave;

use glam::DVec2;

use self::layout::Layout;
pub use self::wave::{ToothForm, ToothWave};
use super::outline::Outline;
use super::tips::{Knob, Tip, lobe_corners, with_tips};
use crate::document::Declared;
use crate::not_grown::{NotGrown, not_grown};
use crate::plane::polygon::{self, Place};
use crate::plane::polyline;

/// Greatest number of waves of a margin.
const MOST_WAVES: usize = 20;

/// The block that says what teeth there are, and what to do where they do not fit.
const KEY: &str = "outline.teeth";
const FEWER: &str = "make the teeth lower, or fewer";

/// Tips that do not stand on teeth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LobeTips {
    /// On the ends of pointed lobes, and on the apex if nothing else is there.
    pub lobes: Option<Tip>,
    /// On the apex.
    pub apex: Option<Tip>,
}

/// The outline with teeth: every place of the margin moved outward by the sum of `waves` there.
///
/// Each side is measured along the margin from base to apex. Outward is perpendicular to the chord
/// between two places of the margin, one before and one behind, each a quarter of the shortest
/// tooth away, or the total height of all waves if that is more. So the direction changes smoothly
/// along a polygonal margin, and slowly enough that neighbouring teeth do not cross in a bay.
/// Notches and tips are corners of the result, as are those of the outline.
///
/// `seed` decides how teeth differ that do; each side has teeth of its own then.
///
/// # Errors
///
/// [`NotGrown`] if a number is out of range, or if the new margin crosses itself.
pub fn toothed(
    outline: &Outline,
    waves: &[ToothWave],
    tips: LobeTips,
    seed: u64,
) -> Result<Outline, NotGrown> {
    check(waves)?;
    let corners = match tips.lobes {
        Some(_) => lobe_corners(outline.points()),
        None => Vec::new(),
    };
    let corners: Vec<DVec2> = corners.into_iter().map(|i| outline.points()[i]).collect();
    let apex_tip = tips.apex.or(tips.lobes);
    let end_tip = |p: DVec2| {
        if p == outline.apex() {
            apex_tip
        } else {
            // A wedge at the petiole is no lobe.
            tips.lobes
                .filter(|_| p != outline.base() && corners.contains(&p))
        }
    };
    let Some(shortest) = waves.iter().map(|wave| wave.per_side).max() else {
        if apex_tip.is_none() {
            return Ok(outline.clone());
        }
        let points = outline.points();
        let found = points.iter().enumerate();
        let found = found.filter_map(|(i, &p)| Some((i, end_tip(p)?)));
        let found: Vec<(usize, Tip)> = found.collect();
        let (margin, knobs) = with_tips(points, &found, outline.length());
        return outline_of(margin, outline, knobs);
    };
    let [right, left] = sides(outline).map(Side::new);
    let (Some(right), Some(left)) = (right, left) else {
        let problem = "base and apex are nearest to the same place of the margin, so it has no sides to bear teeth";
        return Err(NotGrown::because(problem).mend(KEY, FEWER));
    };
    let quarter = 0.25 / f64::from(shortest);
    let highest: f64 = waves
        .iter()
        .map(|wave| wave.height * outline.length())
        .sum();
    let shape = |side: Side, sign: f64| {
        let reach = quarter.max(highest / side.length).min(0.25);
        let mut layouts: Vec<Layout<'_>> = Vec::with_capacity(waves.len());
        for (index, wave) in waves.iter().enumerate() {
            let stream = 2 * index as u64 + u64::from(sign < 0.0);
            let layout = Layout::new(wave, layouts.last(), seed, stream);
            layouts.push(layout);
        }
        side.toothed(&layouts, outline.length(), reach, sign, &end_tip)
    };
    let mut margin = shape(right, 1.0);
    let mut back = shape(left, -1.0);
    // Both sides include base and apex, which must not be repeated.
    back.reverse();
    margin.extend(back);
    margin.dedup_by(|next, kept| next.0 == kept.0);
    if margin.len() > 1 && margin.first().map(|end| end.0) == margin.last().map(|end| end.0) {
        margin.pop();
    }
    let points: Vec<DVec2> = margin.iter().map(|(p, _)| *p).collect();
    let found = margin.iter().enumerate();
    let found: Vec<(usize, Tip)> = found
        .filter_map(|(i, (_, tip))| Some((i, (*tip)?)))
        .collect();
    let (points, knobs) = with_tips(&points, &found, outline.length());
    outline_of(points, outline, knobs)
}

fn outline_of(points: Vec<DVec2>, plain: &Outline, knobs: Vec<Knob>) -> Result<Outline, NotGrown> {
    let outline = Outline::new(points, plain.base(), plain.apex());
    let none = |error| not_grown!("the toothed margin is none: {error}").mend(KEY, FEWER);
    Ok(outline.map_err(none)?.with_knobs(knobs))
}

/// Checks the numbers of all waves, and that nested ones have something to stand on.
fn check(waves: &[ToothWave]) -> Result<(), NotGrown> {
    if waves.len() > MOST_WAVES {
        let waves = waves.len();
        let error = not_grown!("a margin has at most 20 waves of teeth, here are {waves}");
        return Err(error.mend(KEY, FEWER));
    }
    for (index, wave) in waves.iter().enumerate() {
        wave.in_range()
            .map_err(|error| not_grown!("teeth {index}: {error}").mend(KEY, FEWER))?;
        if !wave.nested {
            continue;
        }
        let below = index.checked_sub(1).map(|below| waves[below].per_side);
        if !below.is_some_and(|below| wave.per_side.is_multiple_of(below)) {
            let teeth = wave.per_side;
            let below = below.map_or_else(
                || "a wave before, for there is none".to_owned(),
                |below| format!("the {below} of the wave before"),
            );
            let error = not_grown!(
                "teeth {index}: {teeth} nested teeth a side do not share out evenly over {below}"
            );
            let help =
                "let per_side be a multiple of that of the wave before, or leave `nested` out";
            return Err(error.mend(KEY, help));
        }
    }
    Ok(())
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
        let mut shares = polyline::lengths(&points);
        let length = shares[shares.len() - 1];
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

    /// The side with teeth, each place with the tip that stands on it; outward is to the right for
    /// `sign` 1, to the left for −1.
    fn toothed(
        &self,
        layouts: &[Layout<'_>],
        length: f64,
        reach: f64,
        sign: f64,
        end_tip: &dyn Fn(DVec2) -> Option<Tip>,
    ) -> Vec<(DVec2, Option<Tip>)> {
        let mut stops: Vec<f64> = self.shares.clone();
        stops.extend(layouts.iter().flat_map(Layout::breaks));
        stops.retain(|share| (0.0..=1.0).contains(share));
        stops.sort_unstable_by(f64::total_cmp);
        // A corner of a tooth at a corner of the margin would give an edge without length.
        stops.dedup_by(|next, kept| *next - *kept < 1e-9);
        let mut summits: Vec<(f64, Tip)> = Vec::new();
        for layout in layouts {
            if let Some(tip) = layout.wave.tip {
                // A tooth that has faded away bears none.
                let is_tooth = |share: &f64| {
                    let height = layout.at(*share, true).max(layout.at(*share, false));
                    height > 0.3 * layout.wave.height
                };
                summits.extend(layout.summits().filter(is_tooth).map(|share| (share, tip)));
            }
        }
        let tip_at = |share: f64| {
            let mut found = summits
                .iter()
                .filter(|(summit, _)| (summit - share).abs() < 1e-9);
            found.next().map(|(_, tip)| *tip)
        };
        let mut margin = Vec::with_capacity(stops.len());
        for share in stops {
            let chord = self.at((share + reach).min(1.0)) - self.at((share - reach).max(0.0));
            let outward = DVec2::new(chord.y * sign, -chord.x * sign).normalize_or_zero();
            let heights = [true, false].map(|before| -> f64 {
                let sum: f64 = layouts.iter().map(|wave| wave.at(share, before)).sum();
                sum * length
            });
            let place = self.at(share);
            let tip = tip_at(share).or_else(|| end_tip(place));
            let is_first = heights[0] >= heights[1];
            margin.push((place + outward * heights[0], tip.filter(|_| is_first)));
            if heights[1] != heights[0] {
                margin.push((place + outward * heights[1], tip.filter(|_| !is_first)));
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
    let [base, apex] = [outline.base(), outline.apex()].map(|p| polygon::nearest(points, p));
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

#[cfg(test)]
mod tests;
