//! BRDF and BTDF of a stack: light from one direction, by the direction in which it leaves.

use std::f64::consts::PI;

use super::monte_carlo::Bins;
use super::ordinates::{Leaving, Ordinates, Resolution};
use super::stack::{Face, Stack, StackError};
use crate::quadrature::gauss;

/// Directions of view within a bin over which its mean is taken.
const NODES: usize = 5;

/// Light that leaves a stack by the direction of incidence, that of view, and the azimuth between
/// them, for both faces.
///
/// It is kept as a cosine series in azimuth, so any azimuth and any mean over azimuth may be asked
/// for. Light that was never scattered is told apart, as a share: it is a mirror's, or goes
/// straight on. The forward peak of the phase function, beyond its last moment, counts as not
/// scattered ([`Ordinates::leaving_by_azimuth`]).
#[derive(Clone, Debug)]
pub struct Bidirectional {
    views: Vec<f64>,
    /// By face, then by incidence.
    lit: [Vec<Lit>; 2],
}

/// Light of one incidence.
#[derive(Clone, Debug, Default)]
pub(super) struct Lit {
    /// Shares of the light that are mirrored and that go straight on.
    pub(super) unscattered: [f64; 2],
    /// Factor on `cos mφ` for each `m`, reflected and transmitted, by direction of view.
    pub(super) waves: Vec<[Vec<f64>; 2]>,
}

/// Means over the bins of a [`super::follow`] by direction, in its order and unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Binned {
    /// Sent back.
    pub reflected: Vec<f64>,
    /// Let through.
    pub transmitted: Vec<f64>,
}

impl Bidirectional {
    /// Solves a stack for light that falls in at these cosines and leaves at those, both in air and
    /// in (0, 1].
    ///
    /// # Errors
    ///
    /// [`StackError::Direction`] for a cosine out of range.
    pub fn new(
        stack: &Stack,
        resolution: Resolution,
        incidences: &[f64],
        views: &[f64],
    ) -> Result<Self, StackError> {
        Self::of_waves(stack, resolution, incidences, views, usize::MAX)
    }

    /// The same with no more waves than so many.
    fn of_waves(
        stack: &Stack,
        resolution: Resolution,
        incidences: &[f64],
        views: &[f64],
        waves: usize,
    ) -> Result<Self, StackError> {
        let all: Vec<f64> = incidences.iter().chain(views).copied().collect();
        let solved = Ordinates::new(stack, resolution, &all)?;
        Ok(Self {
            views: views.to_vec(),
            lit: solved.waves(incidences.len(), waves),
        })
    }

    fn lit(&self, face: Face, incidence: usize) -> &Lit {
        let of_face = match face {
            Face::First => 0,
            Face::Last => 1,
        };
        &self.lit[of_face][incidence]
    }

    /// Light of an incidence (by its place among those that were given) that leaves in a direction
    /// of view (by its place), at an azimuth in rad from the half-plane in which the light goes on:
    /// π times BRDF and BTDF, so 1 for a perfect diffuser.
    ///
    /// # Panics
    ///
    /// If there is no such place.
    pub fn at(&self, face: Face, incidence: usize, view: usize, azimuth: f64) -> Leaving {
        self.summed(face, incidence, view, |mode| {
            libm::cos(mode as f64 * azimuth)
        })
    }

    /// The same, its mean over azimuths.
    ///
    /// # Panics
    ///
    /// If there is no such place.
    pub fn mean(&self, face: Face, incidence: usize, view: usize) -> Leaving {
        self.summed(face, incidence, view, |mode| f64::from(u8::from(mode == 0)))
    }

    /// Shares of the light of an incidence that are mirrored and that go straight on, never
    /// scattered.
    ///
    /// # Panics
    ///
    /// If there is no such incidence.
    pub fn unscattered(&self, face: Face, incidence: usize) -> [f64; 2] {
        self.lit(face, incidence).unscattered
    }

    fn summed(
        &self,
        face: Face,
        incidence: usize,
        view: usize,
        wave: impl Fn(usize) -> f64,
    ) -> Leaving {
        let mut sums = [0.0; 2];
        for (mode, factors) in self.lit(face, incidence).waves.iter().enumerate() {
            let wave = wave(mode);
            for (sum, of_views) in sums.iter_mut().zip(factors) {
                *sum += wave * of_views[view];
            }
        }
        Leaving {
            cosine: self.views[view],
            reflected: sums[0],
            transmitted: sums[1],
        }
    }
}

impl Binned {
    /// What [`super::follow`] estimates, by ordinates: means over its bins for light that falls on
    /// a face at a cosine.
    ///
    /// # Errors
    ///
    /// [`StackError::Direction`] for a cosine out of range.
    pub fn new(
        stack: &Stack,
        resolution: Resolution,
        face: Face,
        cosine: f64,
        bins: Bins,
    ) -> Result<Self, StackError> {
        let [polar, azimuth] = [bins.polar.max(1), bins.azimuth.max(1)];
        let rule = gauss(NODES);
        let views: Vec<f64> = (0..polar)
            .flat_map(|bin| {
                rule.iter()
                    .map(move |(x, _)| (bin as f64 + x) / polar as f64)
            })
            .map(f64::sqrt)
            .collect();
        // Around the whole circle all waves but the first cancel.
        let waves = if azimuth == 1 { 1 } else { usize::MAX };
        let all = Bidirectional::of_waves(stack, resolution, &[cosine], &views, waves)?;
        let mut binned = Self {
            reflected: Vec::new(),
            transmitted: Vec::new(),
        };
        for tilt in 0..polar {
            for turn in 0..azimuth {
                let [from, to] = [turn, turn + 1].map(|end| 2.0 * PI * end as f64 / azimuth as f64);
                // The mean of cos mφ from one azimuth to the other.
                let wave = |mode: usize| {
                    if mode == 0 {
                        return 1.0;
                    }
                    let m = mode as f64;
                    (libm::sin(m * to) - libm::sin(m * from)) / (m * (to - from))
                };
                let mut means = [0.0; 2];
                for (node, (_, weight)) in rule.iter().enumerate() {
                    let leaving = all.summed(face, 0, tilt * NODES + node, wave);
                    means[0] += weight * leaving.reflected;
                    means[1] += weight * leaving.transmitted;
                }
                binned.reflected.push(means[0]);
                binned.transmitted.push(means[1]);
            }
        }
        Ok(binned)
    }
}
