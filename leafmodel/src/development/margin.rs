//! The growing margin: points of tissue, convergence points among them.

use glam::DVec2;

use super::plan::{Primordium, Sequence, Wave};
use super::skeleton::NO_NODE;
use crate::plane::segment::cross;

/// A point of tissue at the margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MarginPoint {
    /// Where it is; the base is the origin.
    pub(super) place: DVec2,
    /// How much of the blade's growth is held back here, 0 to 1.
    pub(super) restraint: f64,
    /// How far between the ends of its interval it lies, 0 to 1, when the later of them came.
    pub(super) share: f64,
    /// The node that a vein ends at, if this is a convergence point.
    pub(super) tip: u32,
}

/// The margin from the base along the right side to the tip and back along the left.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Margin {
    pub(super) points: Vec<MarginPoint>,
}

/// A part of the margin between neighbouring convergence points, or between one and the base.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interval {
    /// Numbers of its first and last point.
    pub(super) ends: [usize; 2],
    /// Whether it belongs to the right side.
    pub(super) is_right: bool,
}

impl Interval {
    /// Numbers of the ends: the one nearer to the base along the margin first.
    pub(super) fn lower_and_upper(&self) -> [usize; 2] {
        let [a, b] = self.ends;
        if self.is_right { [a, b] } else { [b, a] }
    }

    /// Whether a wave goes on here, if `is_its` tells its convergence points.
    pub(super) fn continues(self, sequence: Sequence, is_its: impl Fn(usize) -> bool) -> bool {
        let [lower, upper] = self.lower_and_upper();
        match sequence {
            Sequence::Basipetal => !is_its(lower),
            Sequence::Acropetal => !is_its(upper),
            Sequence::Intercalary => true,
        }
    }
}

impl Margin {
    /// The margin of a primordium whose midrib is 1 and ends at the node `tip`.
    pub(super) fn new(primordium: &Primordium, resolution: u32, tip: u32) -> Self {
        let pieces = (resolution as usize).max(40);
        // Dense at base and tip, where the margin turns.
        let share = |i: usize| {
            let angle = std::f64::consts::PI * i as f64 / pieces as f64;
            0.5 - 0.5 * libm::cos(angle)
        };
        let tissue = |place| MarginPoint {
            place,
            restraint: 0.0,
            share: 0.5,
            tip: NO_NODE,
        };
        let side: Vec<DVec2> = (1..pieces)
            .map(|i| DVec2::new(primordium.half_width(share(i)), share(i)))
            .collect();
        let mut points = vec![tissue(DVec2::ZERO)];
        points.extend(side.iter().map(|&p| tissue(p)));
        points.push(MarginPoint {
            tip,
            ..tissue(DVec2::Y)
        });
        let mirrored = side.iter().rev().map(|p| DVec2::new(-p.x, p.y));
        points.extend(mirrored.map(tissue));
        points.push(tissue(DVec2::ZERO));
        Self { points }
    }

    /// Length along the margin from the base to each point.
    pub(super) fn distances(&self) -> Vec<f64> {
        let mut sum = 0.0;
        let mut distances = vec![0.0];
        for pair in self.points.windows(2) {
            sum += (pair[1].place - pair[0].place).length();
            distances.push(sum);
        }
        distances
    }

    /// Number of the point at the leaf's tip, where the midrib ends at `tip`.
    pub(super) fn apex(&self, tip: u32) -> usize {
        let found = self.points.iter().position(|point| point.tip == tip);
        found.expect("the midrib ends at the margin")
    }

    /// Parts between neighbouring convergence points and the base.
    pub(super) fn intervals(&self, midrib_tip: u32) -> Vec<Interval> {
        let apex = self.apex(midrib_tip);
        let last = self.points.len() - 1;
        let is_end = |&i: &usize| i == 0 || i == last || self.points[i].tip != NO_NODE;
        let ends: Vec<usize> = (0..=last).filter(is_end).collect();
        let between = |pair: &[usize]| Interval {
            ends: [pair[0], pair[1]],
            is_right: pair[1] <= apex,
        };
        ends.windows(2).map(between).collect()
    }

    /// Puts a point at a distance from the base along the margin; gives its number.
    pub(super) fn split(&mut self, distances: &[f64], at: f64, tip: u32) -> usize {
        let next = distances.partition_point(|&d| d <= at);
        let next = next.clamp(1, self.points.len() - 1);
        let [a, b] = [self.points[next - 1], self.points[next]];
        let piece = distances[next] - distances[next - 1];
        let share = if piece > 0.0 {
            ((at - distances[next - 1]) / piece).clamp(0.0, 1.0)
        } else {
            0.5
        };
        let point = MarginPoint {
            place: a.place.lerp(b.place, share),
            restraint: a.restraint + (b.restraint - a.restraint) * share,
            share: 0.5,
            tip,
        };
        // A tissue point in the very place would leave a piece without length.
        for (number, near) in [(next - 1, share < 0.2), (next, share > 0.8)] {
            let is_plain = self.points[number].tip == NO_NODE;
            if near && is_plain && number != 0 && number + 1 != self.points.len() {
                self.points[number] = MarginPoint {
                    place: point.place,
                    ..point
                };
                return number;
            }
        }
        self.points.insert(next, point);
        next
    }

    /// Holds growth back in the interval that has come to be beside a new convergence point.
    pub(super) fn restrain(&mut self, interval: Interval, midrib_tip: u32, wave: &Wave, hold: f64) {
        let [lower, upper] = interval.lower_and_upper();
        let last = self.points.len() - 1;
        let lower_is_base = lower == 0 || lower == last;
        let is_terminal = self.points[upper].tip == midrib_tip;
        let hold = if lower_is_base {
            hold * wave.hold_base
        } else {
            hold
        };
        let distances = self.distances();
        let length = (distances[upper] - distances[lower]).abs();
        if length <= 0.0 {
            return;
        }
        let [from, to] = interval.ends;
        for i in from..=to {
            let share = (distances[i] - distances[lower]).abs() / length;
            self.points[i].share = (distances[i] - distances[from]) / length;
            let depth = if lower_is_base {
                wave.depth_at(1.0 - share)
            } else {
                let sinus = if is_terminal {
                    1.0 - wave.terminal
                } else {
                    0.5 * (1.0 - wave.lean)
                };
                wave.depth_at(if share < sinus {
                    share / sinus
                } else {
                    (1.0 - share) / (1.0 - sinus)
                })
            };
            let point = &mut self.points[i];
            point.restraint = (point.restraint * depth).max(hold * depth);
        }
    }

    /// Keeps the halves apart below the base, where the petiole leaves.
    pub(super) fn clear_petiole(&mut self, apex: usize, length: f64) {
        let last = self.points.len() - 1;
        for (i, point) in self.points.iter_mut().enumerate() {
            if i == 0 || i == last || point.place.y >= 0.0 {
                continue;
            }
            let clear = (0.1 * -point.place.y).min(0.02 * length) + 1e-3 * length;
            let side = if i < apex { 1.0 } else { -1.0 };
            if point.place.x * side < clear {
                point.place.x = side * clear;
            }
        }
    }

    /// Divides pieces that are longer than `longest`, and drops points of pieces that have become
    /// far shorter.
    pub(super) fn resample(&mut self, longest: f64) {
        let old = std::mem::take(&mut self.points);
        let last = old.len() - 1;
        let shortest = 0.25 * longest;
        for (i, &point) in old.iter().enumerate() {
            if let Some(&before) = self.points.last() {
                let piece = (point.place - before.place).length();
                let is_plain = point.tip == NO_NODE && i != last;
                if is_plain
                    && piece < shortest
                    && (old[i + 1].place - point.place).length() < longest - piece
                {
                    continue;
                }
                if piece > longest {
                    let plain = |j: usize| j > 0 && j < last && old[j].tip == NO_NODE;
                    let is_smooth = plain(i - 1) && plain(i) && i >= 2 && i < last;
                    let straight = (before.place + point.place) * 0.5;
                    let place = if is_smooth {
                        // The four-point rule bends the new point outwards.
                        straight + (straight - (old[i - 2].place + old[i + 1].place) * 0.5) * 0.125
                    } else {
                        straight
                    };
                    self.points.push(MarginPoint {
                        place,
                        restraint: 0.5 * (before.restraint + point.restraint),
                        share: share_between(&before, &point),
                        tip: NO_NODE,
                    });
                }
            }
            self.points.push(point);
        }
    }

    /// Whether the segment from `a` to `b` crosses the margin; one that ends on it does not.
    pub(super) fn is_crossed_by(&self, a: DVec2, b: DVec2) -> bool {
        self.points
            .windows(2)
            .any(|piece| cross(a, b, piece[0].place, piece[1].place))
    }
}

/// How far between the ends of its interval the middle of a piece lies.
fn share_between(before: &MarginPoint, point: &MarginPoint) -> f64 {
    let after = if point.tip == NO_NODE {
        point.share
    } else {
        1.0
    };
    let from = if before.tip == NO_NODE {
        before.share
    } else {
        0.0
    };
    0.5 * (from + after)
}

impl Primordium {
    /// Half its width where the share `y` of its length is below.
    fn half_width(&self, y: f64) -> f64 {
        // yᵃ(1 − y)ᵇ has its maximum at a/(a + b); raised to a power it keeps that.
        let at = |y: f64| libm::pow(y, self.widest_at) * libm::pow(1.0 - y, 1.0 - self.widest_at);
        let taper = if y < self.widest_at {
            self.taper_base
        } else {
            self.taper_tip
        };
        0.5 * self.width * libm::pow(at(y) / at(self.widest_at), 2.0 * taper)
    }
}

impl Wave {
    /// The share of `hold` at a place between a point (0) and the sinus (1).
    fn depth_at(&self, y: f64) -> f64 {
        let y = y.clamp(0.0, 1.0);
        libm::pow(1.0 - libm::pow(1.0 - y, self.sinus), self.blunt)
    }
}
