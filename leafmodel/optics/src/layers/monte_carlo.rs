//! Light followed photon by photon: what the fast route is checked against.
//!
//! A random number is a function of seed, photon and its place in the photon's life, and sums are
//! taken over blocks of photons in order, so results have the same bits on any number of threads.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::boundary::reflectance;
use super::stack::{Face, Incidence, Layer, Stack, StackError};
use numerics::random::{Use, uniform};

mod sideways;

pub use sideways::{Spread, spread};

/// Photons that one thread follows at a time.
const BLOCK: u64 = 4096;
/// Below this weight a photon goes on with `SURVIVING` as its chance, and its weight divided by it.
const LEAST: f64 = 0.05;
const SURVIVING: f64 = 0.1;

/// A figure found by chance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The mean.
    pub value: f64,
    /// The standard error of the mean.
    pub standard_error: f64,
}

/// How leaving light is sorted by direction; 0 counts as 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bins {
    /// Steps of the squared cosine, so that a perfect diffuser sends the same into each.
    pub polar: usize,
    /// Steps of azimuth, around from the direction in which the light falls in.
    pub azimuth: usize,
}

impl Bins {
    /// Sums alone.
    pub const NONE: Self = Self {
        polar: 1,
        azimuth: 1,
    };
}

/// What became of the photons, as shares of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Tallies {
    /// Sent back on the lit side, specular reflection included.
    pub reflected: Estimate,
    /// Let through, unscattered light included.
    pub transmitted: Estimate,
    /// Absorbed in each layer, from the first to the last whichever is lit.
    pub absorbed: Vec<Estimate>,
    /// Sent back after scattering, by direction: shares times the number of bins, so that a
    /// perfect diffuser has 1 in each. Azimuth runs fastest; grazing directions come first.
    pub reflected_by_direction: Vec<Estimate>,
    /// Let through after scattering, by direction.
    pub transmitted_by_direction: Vec<Estimate>,
}

/// Sums of weights and of their squares.
#[derive(Clone, Debug)]
struct Sums(Vec<[f64; 2]>);

/// Follows photons, at least one, through a stack lit on one face.
///
/// Absorption takes its share of a photon's weight at each event. When little is left, chance
/// decides whether the photon goes on with ten times as much; the layer pays the difference, so
/// that shares add up to 1 for each photon, and no figure has a bias.
///
/// # Source
///
/// The method of \[wang1995\], but for the bookkeeping of its roulette.
///
/// # Errors
///
/// [`StackError::Direction`] if light falls in from a direction out of range.
pub fn follow(
    stack: &Stack,
    face: Face,
    incidence: Incidence,
    bins: Bins,
    photons: u64,
    seed: u64,
) -> Result<Tallies, StackError> {
    let incidence = incidence.checked()?;
    let photons = photons.max(1);
    let mut layers = stack.layers().to_vec();
    if face == Face::Last {
        layers.reverse();
    }
    let walk = Walk {
        layers: &layers,
        thickness: None,
        incidence,
        bins: Bins {
            polar: bins.polar.max(1),
            azimuth: bins.azimuth.max(1),
        },
    };
    let blocks: Vec<Sums> = (0..photons.div_ceil(BLOCK))
        .into_par_iter()
        .map(|block| {
            let mut sums = Sums(vec![[0.0; 2]; walk.tallies()]);
            let mut photon = vec![0.0; walk.tallies()];
            for number in block * BLOCK..((block + 1) * BLOCK).min(photons) {
                let touched = walk.photon(&mut Chance::new(seed, number), &mut photon);
                sums.add(&mut photon, touched, layers.len());
            }
            sums
        })
        .collect();
    let mut total = Sums(vec![[0.0; 2]; walk.tallies()]);
    for block in blocks {
        for (sum, more) in total.0.iter_mut().zip(block.0) {
            sum[0] += more[0];
            sum[1] += more[1];
        }
    }
    let n = photons as f64;
    let estimate = |[sum, square]: [f64; 2]| {
        let value = sum / n;
        let variance = (square / n - value * value).max(0.0);
        Estimate {
            value,
            standard_error: (variance / (n - 1.0).max(1.0)).sqrt(),
        }
    };
    let all: Vec<Estimate> = total.0.into_iter().map(estimate).collect();
    let mut absorbed = all[2..2 + layers.len()].to_vec();
    if face == Face::Last {
        absorbed.reverse();
    }
    let scale = walk.directions() as f64;
    let by_direction = |from: usize| {
        all[from..from + walk.directions()]
            .iter()
            .map(|one| Estimate {
                value: one.value * scale,
                standard_error: one.standard_error * scale,
            })
            .collect()
    };
    let first = 2 + layers.len();
    Ok(Tallies {
        reflected: all[0],
        transmitted: all[1],
        absorbed,
        reflected_by_direction: by_direction(first),
        transmitted_by_direction: by_direction(first + walk.directions()),
    })
}

impl Sums {
    /// Adds what one photon left, and clears it. Of the directions it touched one at most.
    fn add(&mut self, photon: &mut [f64], touched: Option<usize>, layers: usize) {
        for place in (0..2 + layers).chain(touched) {
            let value = std::mem::take(&mut photon[place]);
            self.0[place][0] += value;
            self.0[place][1] += value * value;
        }
    }
}

/// The random numbers of one photon.
struct Chance {
    seed: u64,
    photon: u64,
    used: u64,
}

impl Chance {
    fn new(seed: u64, photon: u64) -> Self {
        Self {
            seed,
            photon,
            used: 0,
        }
    }

    /// A uniform number in [0, 1).
    fn uniform(&mut self) -> f64 {
        self.used += 1;
        let seed = self.seed ^ self.photon.rotate_left(32);
        uniform(seed, Use::Photon, self.used)
    }

    /// Sine and cosine of an angle that is as likely as any other: a point in the unit disc, its
    /// angle doubled.
    fn turn(&mut self) -> (f64, f64) {
        loop {
            let (x, y) = (2.0 * self.uniform() - 1.0, 2.0 * self.uniform() - 1.0);
            let square = x * x + y * y;
            if square > 0.0 && square <= 1.0 {
                return (2.0 * x * y / square, (x * x - y * y) / square);
            }
        }
    }
}

struct Walk<'a> {
    layers: &'a [Layer],
    /// Of each layer, if places beside the entry are wanted.
    thickness: Option<&'a [f64]>,
    incidence: Incidence,
    bins: Bins,
}

/// A direction; z runs from the lit face to the other.
#[derive(Clone, Copy)]
struct Heading([f64; 3]);

impl Walk<'_> {
    fn directions(&self) -> usize {
        self.bins.polar * self.bins.azimuth
    }

    fn tallies(&self) -> usize {
        2 + self.layers.len() + 2 * self.directions()
    }

    fn index(&self, layer: usize) -> f64 {
        self.layers.get(layer).map_or(1.0, |layer| layer.index)
    }

    /// One photon's life. Gives the tally of its direction, if it left after scattering.
    fn photon(&self, chance: &mut Chance, tally: &mut [f64]) -> Option<usize> {
        self.photon_beside(chance, tally, &mut [0.0; 2])
    }

    /// The same; `beside` becomes the distance of its place from the entry, across the layers, in the
    /// unit of the thickness.
    fn photon_beside(
        &self,
        chance: &mut Chance,
        tally: &mut [f64],
        beside: &mut [f64; 2],
    ) -> Option<usize> {
        let mut move_by = |layer: usize, share: f64, heading: Heading| {
            if let Some(thickness) = self.thickness {
                let [x, y, z] = heading.0;
                let length = share * thickness[layer] / z.abs();
                beside[0] += length * x;
                beside[1] += length * y;
            }
        };
        let cosine = match self.incidence {
            Incidence::Directional { cosine } => cosine,
            // 1 − u lies in (0, 1].
            Incidence::Lambertian => (1.0 - chance.uniform()).sqrt(),
        };
        let heading = Heading([(1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine]);
        let mut scattered = false;
        let mut weight = 1.0;
        let (entered, mut heading) = heading.crosses(1.0, self.index(0), chance);
        if !entered {
            tally[0] = weight;
            return None;
        }
        let (mut layer, mut place) = (0, 0.0);
        let mut free = -libm::log(1.0 - chance.uniform());
        loop {
            let medium = &self.layers[layer];
            let down = heading.0[2] > 0.0;
            let to_side = if down { medium.depth - place } else { place };
            let path = to_side / heading.0[2].abs();
            if free < path {
                move_by(layer, free * heading.0[2].abs() / medium.depth, heading);
                place += free * heading.0[2];
                let index = 2 + layer;
                let kept = weight * medium.albedo;
                tally[index] += weight - kept;
                weight = kept;
                if weight < LEAST {
                    let goes_on = chance.uniform() < SURVIVING;
                    let after = if goes_on { weight / SURVIVING } else { 0.0 };
                    tally[index] += weight - after;
                    weight = after;
                    if !goes_on {
                        return None;
                    }
                }
                let cosine = medium.phase.sample(chance.uniform(), chance.uniform());
                heading = heading.deflected(cosine, chance.turn());
                scattered = true;
                free = -libm::log(1.0 - chance.uniform());
                continue;
            }
            free -= path;
            // A layer without depth is crossed whole.
            let share = if medium.depth > 0.0 {
                to_side / medium.depth
            } else {
                1.0
            };
            move_by(layer, share, heading);
            // Out of the last layer as out of the first: air has the number of no layer.
            let next = if down {
                layer + 1
            } else {
                layer.wrapping_sub(1)
            };
            let (from, to) = (medium.index, self.index(next));
            let (crossed, after) = heading.crosses(from, to, chance);
            heading = after;
            if !crossed {
                place = if down { medium.depth } else { 0.0 };
            } else if let Some(into) = self.layers.get(next) {
                layer = next;
                place = if down { 0.0 } else { into.depth };
            } else {
                tally[usize::from(down)] = weight;
                if !scattered {
                    return None;
                }
                let side = if down { self.directions() } else { 0 };
                let bin = 2 + self.layers.len() + side + self.bin(heading);
                tally[bin] = weight;
                return Some(bin);
            }
        }
    }

    fn bin(&self, heading: Heading) -> usize {
        let [x, y, z] = heading.0;
        let polar = (z * z * self.bins.polar as f64) as usize;
        let azimuth = if self.bins.azimuth > 1 {
            let turn = libm::atan2(y, x) / (2.0 * PI);
            ((turn + f64::from(u8::from(turn < 0.0))) * self.bins.azimuth as f64) as usize
        } else {
            0
        };
        polar.min(self.bins.polar - 1) * self.bins.azimuth + azimuth.min(self.bins.azimuth - 1)
    }
}

impl Heading {
    /// Whether light crosses a boundary, and where it goes then: refracted or reflected, by chance.
    fn crosses(self, from: f64, to: f64, chance: &mut Chance) -> (bool, Self) {
        if from == to {
            return (true, self);
        }
        let [x, y, z] = self.0;
        let mirrored = Self([x, y, -z]);
        let relative = from / to;
        let left = 1.0 - relative * relative * (1.0 - z * z);
        if left <= 0.0 {
            return (false, mirrored);
        }
        let refracted = left.sqrt();
        if chance.uniform() < reflectance(from, to, z.abs(), refracted) {
            return (false, mirrored);
        }
        (
            true,
            Self([x * relative, y * relative, refracted.copysign(z)]),
        )
    }

    /// The direction at an angle to this one, turned about it.
    fn deflected(self, cosine: f64, (turn_sine, turn_cosine): (f64, f64)) -> Self {
        let [x, y, z] = self.0;
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        // A frame without a pole (Duff et al. 2017).
        let sign = 1.0_f64.copysign(z);
        let a = -1.0 / (sign + z);
        let b = x * y * a;
        let (one, other) = (sine * turn_cosine, sine * turn_sine);
        let turned = [
            one * (1.0 + sign * x * x * a) + other * b + cosine * x,
            one * sign * b + other * (sign + y * y * a) + cosine * y,
            -one * sign * x - other * y + cosine * z,
        ];
        // Rounding would add up over thousands of events.
        let length = turned.iter().map(|part| part * part).sum::<f64>().sqrt();
        Self(turned.map(|part| part / length))
    }
}
