//! The margin of a blade as veins see it: where a way out meets it, and where teeth and lobes are.

use glam::DVec2;

use crate::plane::{polygon, polyline, segment};
use crate::shape::outline::Outline;

/// Points at which teeth and lobes are looked for.
const SAMPLES: usize = 4096;

/// A tooth or lobe is at least so high over half its width.
const SHARPNESS: f64 = 0.08;

/// A sinus is at least so deep over half its width.
const SINUS: f64 = 0.03;

/// Places between two tips at which their sinus is looked for.
const SINUS_PLACES: u32 = 48;

/// Tips that are so much lower than one nearer than a share of the margin do not count.
const DWARFED: f64 = 0.13;

/// That share.
const BESIDE: f64 = 0.05;

/// A place of the margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    /// Where it is.
    pub(crate) place: DVec2,
    /// Length of the margin up to it from the base, counter-clockwise, over all of it.
    pub(crate) at: f64,
}

/// The end of a tooth or lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tip {
    /// Where it is.
    pub(crate) place: DVec2,
    /// As for a [`Hit`].
    pub(crate) at: f64,
    /// How far it stands out.
    pub(crate) height: f64,
}

/// A margin with its teeth and lobes.
pub(crate) struct Margin {
    /// Evenly spaced, counter-clockwise from the base.
    points: Vec<DVec2>,
    /// Where the apex is, as a share like [`Hit::at`].
    apex_at: f64,
    perimeter: f64,
    tips: Vec<Tip>,
}

impl Margin {
    /// The margin of a blade whose base is the origin.
    pub(crate) fn new(blade: &Outline) -> Self {
        let corners = blade.points();
        let first = polyline::nearest(corners, blade.base());
        let walk: Vec<DVec2> = (0..=corners.len())
            .map(|i| corners[(first + i) % corners.len()])
            .collect();
        let points = evenly(&walk, SAMPLES);
        let apex = polyline::nearest(&points, blade.apex());
        let mut margin = Self {
            apex_at: apex as f64 / SAMPLES as f64,
            perimeter: blade.perimeter(),
            tips: Vec::new(),
            points,
        };
        margin.tips = margin.find_tips();
        margin
    }

    /// Length all around.
    pub(crate) fn perimeter(&self) -> f64 {
        self.perimeter
    }

    /// Where a way out of the blade from `from` first meets the margin.
    pub(crate) fn hit(&self, from: DVec2, way: DVec2) -> Option<Hit> {
        let n = self.points.len();
        let mut best: Option<(f64, f64)> = None;
        for (i, (a, b)) in polygon::sides(&self.points).enumerate() {
            let (along_way, along_edge) = segment::meeting(from, way, a, b);
            // A vein may start on the margin itself, at the base.
            if along_way > 1e-3 * self.perimeter
                && (0.0..1.0).contains(&along_edge)
                && best.is_none_or(|(nearest, _)| along_way < nearest)
            {
                best = Some((along_way, (i as f64 + along_edge) / n as f64));
            }
        }
        best.map(|(along, at)| Hit {
            place: from + way * along,
            at,
        })
    }

    /// The place at a share of the margin.
    pub(crate) fn at(&self, at: f64) -> DVec2 {
        let n = self.points.len();
        let place = at.rem_euclid(1.0) * n as f64;
        let i = (place.floor() as usize).min(n - 1);
        self.points[i].lerp(self.points[(i + 1) % n], place - i as f64)
    }

    /// A place `distance` inside a share of the margin. Teeth do not turn the direction.
    pub(crate) fn inside(&self, at: f64, distance: f64) -> DVec2 {
        self.at(at) + self.direction(at).perp() * distance
    }

    /// The margin's direction, counter-clockwise, without its teeth.
    pub(crate) fn direction(&self, at: f64) -> DVec2 {
        (self.at(at + 0.012) - self.at(at - 0.012)).normalize_or_zero()
    }

    /// Where the apex is.
    pub(crate) fn apex_at(&self) -> f64 {
        self.apex_at
    }

    /// All teeth and lobes, by place.
    pub(crate) fn tips(&self) -> &[Tip] {
        &self.tips
    }

    /// The deepest places between neighbouring tips of one side, the apex one of them, by place;
    /// their height is how far they lie inside the straight way from tip to tip.
    pub(crate) fn sinuses(&self) -> Vec<Tip> {
        let apex = Tip {
            place: self.at(self.apex_at),
            at: self.apex_at,
            height: 0.0,
        };
        let mut all = self.tips.clone();
        all.push(apex);
        all.sort_by(|a, b| a.at.total_cmp(&b.at));
        let deepest = |pair: &[Tip]| {
            let (from, to) = (pair[0].place, pair[1].place);
            let inwards = (to - from).normalize_or_zero().perp();
            (1..SINUS_PLACES)
                .map(|k| {
                    let share = f64::from(k) / f64::from(SINUS_PLACES);
                    let at = pair[0].at + (pair[1].at - pair[0].at) * share;
                    let place = self.at(at);
                    let height = (place - from).dot(inwards);
                    Tip { place, at, height }
                })
                .max_by(|a, b| a.height.total_cmp(&b.height))
                .filter(|sinus| sinus.height > SINUS * (to - from).length())
        };
        all.windows(2).filter_map(deepest).collect()
    }

    /// How many sinuses each side has: right, left.
    pub(crate) fn sinuses_a_side(&self) -> [usize; 2] {
        let all = self.sinuses();
        let right = all.iter().filter(|sinus| sinus.at < self.apex_at).count();
        [right, all.len() - right]
    }

    /// How many teeth and lobes each side has: right, left.
    pub(crate) fn tips_a_side(&self) -> [usize; 2] {
        let right = self.tips.iter().filter(|tip| tip.at < self.apex_at).count();
        [right, self.tips.len() - right]
    }

    /// The tip that stands out most within `reach` along the margin, near ones preferred.
    pub(crate) fn lobe_near(&self, at: f64, reach: f64) -> Option<DVec2> {
        let share = reach / self.perimeter;
        let near = |tip: &&Tip| {
            let away = (tip.at - at).abs();
            away.min(1.0 - away) <= share
        };
        let within = || self.tips.iter().filter(near);
        let highest = within().map(|tip| tip.height).fold(0.0, f64::max);
        // Of teeth that are about alike the nearest; a lobe stands out far more than they do.
        let score = |tip: &Tip| {
            let away = (tip.at - at).abs();
            let away = away.min(1.0 - away) / share;
            tip.height / highest - away * away
        };
        within()
            .max_by(|a, b| score(a).total_cmp(&score(b)))
            .map(|tip| tip.place)
    }

    fn find_tips(&self) -> Vec<Tip> {
        let n = self.points.len();
        let mut found: Vec<(usize, f64)> = Vec::new();
        // From lobes down to fine teeth; what was found at a coarser scale stays.
        let mut window = n / 16;
        while window >= 6 {
            let beside = |i: usize| [n - window, window].map(|off| self.points[(i + off) % n]);
            let height = |i: usize| {
                let [a, b] = beside(i);
                (self.points[i] - (a + b) * 0.5).dot(-(b - a).perp().normalize_or_zero())
            };
            let heights: Vec<f64> = (0..n).map(height).collect();
            let width = |i: usize| {
                let [a, b] = beside(i);
                (b - a).length() * 0.5
            };
            for i in 0..n {
                let around = 1..=window * 3 / 4;
                let is_peak = around
                    .clone()
                    .all(|k| heights[(i + n - k) % n] < heights[i])
                    && around.clone().all(|k| heights[(i + k) % n] <= heights[i]);
                let apart = |&(other, _): &(usize, f64)| {
                    let away = other.abs_diff(i);
                    away.min(n - away) > window
                };
                // An end that is merely round has no sinus.
                let is_sinus = |j: usize| heights[j] < -SINUS * width(j);
                let has_sinus =
                    || (1..=2 * window).any(|k| is_sinus((i + k) % n) || is_sinus((i + n - k) % n));
                if is_peak
                    && heights[i] > SHARPNESS * width(i).max(1e-9)
                    && found.iter().all(apart)
                    && has_sinus()
                {
                    found.push((i, heights[i]));
                }
            }
            window = window * 2 / 3;
        }
        let clear = 0.006 * n as f64;
        let apex = self.apex_at * n as f64;
        let mut tips: Vec<Tip> = found
            .into_iter()
            .filter(|&(i, _)| {
                let i = i as f64;
                i > clear && i < n as f64 - clear && (i - apex).abs() > 2.0 * clear
            })
            .map(|(i, height)| Tip {
                place: self.points[i],
                at: i as f64 / n as f64,
                height,
            })
            .collect();
        tips.sort_by(|a, b| a.at.total_cmp(&b.at));
        // What is small beside a lobe or a greater tooth is none.
        let is_dwarfed = |tip: &Tip| {
            let near = tips
                .iter()
                .filter(|other| (other.at - tip.at).abs() < BESIDE);
            tip.height < DWARFED * near.map(|other| other.height).fold(0.0, f64::max)
        };
        tips.iter()
            .filter(|tip| !is_dwarfed(tip))
            .copied()
            .collect()
    }
}

/// Evenly spaced points along a closed walk, whose last point is its first; the last is left out.
fn evenly(walk: &[DVec2], count: usize) -> Vec<DVec2> {
    let lengths = polyline::lengths(walk);
    let total = lengths[lengths.len() - 1];
    let mut i = 1;
    (0..count)
        .map(|k| {
            let wanted = total * k as f64 / count as f64;
            while i + 1 < lengths.len() && lengths[i] <= wanted {
                i += 1;
            }
            let (before, after) = (lengths[i - 1], lengths[i]);
            walk[i - 1].lerp(walk[i], (wanted - before) / (after - before))
        })
        .collect()
}
