//! Directions that all layers of a stack share.
//!
//! Refraction keeps `u = n² sin² θ`, so one set of `u` is one direction in every medium, and a
//! boundary couples no two of them. A medium of index `n` has those with `u < n²`. The range of
//! `u` is split at the squares of all indices, where reflection becomes total.

use crate::quadrature::gauss;

/// What a direction that carries no light of its own weighs, so that light along it can be asked
/// for: little enough to change no flux by more than 1e-8, and much enough for its radiance to keep
/// eight digits.
const PROBE: f64 = 1e-9;

/// One direction, in all media.
#[derive(Clone, Copy, Debug)]
pub(super) struct Direction {
    /// The square of the index above `u` next to it, and its distance from `u`: `n² − u` would lose
    /// the digits of a grazing direction.
    next_square: f64,
    below: f64,
    /// `√W`, with `W = n² µ dµ`, the same in every medium.
    pub(super) root: f64,
    /// Its place among the directions asked for, if it is one of them.
    probe: Option<usize>,
}

impl Direction {
    fn u(&self) -> f64 {
        self.next_square - self.below
    }

    /// Its cosine in a medium, in which it must exist.
    pub(super) fn cosine(&self, index: f64) -> f64 {
        (((index * index - self.next_square) + self.below) / (index * index))
            .max(0.0)
            .sqrt()
    }
}

/// Directions in rising order of `u`.
#[derive(Clone, Debug)]
pub(super) struct Directions(Vec<Direction>);

impl Directions {
    /// For media of these indices, all at least 1, and air: `count` in each range, and those whose
    /// cosines in air are given.
    ///
    /// Inside a range `u` is the upper end less a share `y⁴`, with `y` at Gauss' nodes: denser
    /// towards grazing directions, where radiance behaves as `µ ln µ`, and smooth where Fresnel's
    /// formulae have a root.
    pub(super) fn new(indices: impl Iterator<Item = f64>, count: usize, probes: &[f64]) -> Self {
        let mut squares: Vec<f64> = indices.map(|index| index * index).collect();
        squares.push(1.0);
        squares.sort_by(f64::total_cmp);
        squares.dedup();
        let rule = gauss(count);
        let mut all = Vec::new();
        let mut low = 0.0;
        for high in squares {
            let width = high - low;
            all.extend(rule.iter().map(|(y, weight)| Direction {
                next_square: high,
                below: width * y * y * y * y,
                // W = ½ du.
                root: (2.0 * width * y * y * y * weight).sqrt(),
                probe: None,
            }));
            low = high;
        }
        all.extend(probes.iter().enumerate().map(|(place, cosine)| Direction {
            next_square: 1.0,
            below: cosine * cosine,
            root: PROBE.sqrt(),
            probe: Some(place),
        }));
        all.sort_by(|one, other| one.u().total_cmp(&other.u()));
        Self(all)
    }

    /// Those that exist in a medium, the first ones of all.
    pub(super) fn within(&self, index: f64) -> &[Direction] {
        let square = index * index;
        // The squares of indices are the ends of ranges, and no node lies on one.
        let count = self
            .0
            .partition_point(|direction| direction.next_square <= square);
        &self.0[..count]
    }

    /// Where the direction stands that was asked for at this place.
    pub(super) fn probe(&self, place: usize) -> usize {
        self.0
            .iter()
            .position(|direction| direction.probe == Some(place))
            .expect("every direction that is asked for is among them")
    }
}
