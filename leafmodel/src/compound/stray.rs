//! How leaflets and pinnae stray from the plan's rule by chance.
//!
//! Each strays by four random numbers of its own, times its plan's irregularity. Those that come into
//! each other's way stray half as far, again and again, until they do not: [`Stray::calm`].

use super::Arrangement;
use super::arranged::CompoundError;
use super::form::CompoundForm;
use crate::random::{Use, uniform};

/// Random numbers for strays come after those for seeds and tilts; those for pinnae after those for
/// leaflets.
const FIRST_LEAFLET: u64 = 1 << 33;
const FIRST_PINNA: u64 = 1 << 34;
/// Shares below this are 0.
const LEAST_SHARE: f64 = 0.1;
/// Change of size, and of the angle by which a pinna turns (radians), for one unit of chance.
const SIZE: f64 = 0.5;
const TURN: f64 = 0.6;

/// Which of a leaf's parts strays.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    /// The leaflet with this number.
    Leaflet(usize),
    /// The pinna with this number.
    Pinna(usize),
}

/// How far one part strays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strayed {
    /// Along its axis, in gaps between pairs.
    pub along: f64,
    /// Factor of its angle to the axis.
    pub angle: f64,
    /// Factor of its size.
    pub size: f64,
    /// What is added to the angle by which a pinna turns from end to end, radians.
    pub turn: f64,
}

/// How far the parts of a leaf may stray.
#[derive(Clone, Debug)]
pub(super) struct Stray {
    irregularity: f64,
    seed: u64,
    /// Shares of the irregularity that leaflets and pinnae have, 0 to 1.
    leaflets: Vec<f64>,
    pinnae: Vec<f64>,
    /// Leaflets of a pinna; 0 without pinnae.
    on_pinna: usize,
}

impl Stray {
    /// All parts of this leaf stray as far as its plan says.
    pub(super) fn new(form: &CompoundForm, seed: u64) -> Self {
        let (pinnae, leaflets, on_pinna) = match &form.arrangement {
            Arrangement::Pinnate(rows) => (0, rows.count(), 0),
            Arrangement::Palmate { leaflets, .. } => (0, *leaflets as usize, 0),
            Arrangement::Bipinnate {
                pinnae, leaflets, ..
            } => {
                let on_pinna = leaflets.count();
                (pinnae.count(), pinnae.count() * on_pinna, on_pinna)
            }
        };
        Self {
            irregularity: form.irregularity,
            seed,
            leaflets: vec![1.0; leaflets],
            pinnae: vec![1.0; pinnae],
            on_pinna,
        }
    }

    /// How far a part strays; 0 with an irregularity of 0.
    pub(super) fn of(&self, part: Part) -> Strayed {
        let (share, first) = match part {
            Part::Leaflet(number) => (self.leaflets[number], FIRST_LEAFLET + 4 * number as u64),
            Part::Pinna(number) => (self.pinnae[number], FIRST_PINNA + 4 * number as u64),
        };
        // Of mean 0 and standard deviation 1.
        let even = |number| 3.0_f64.sqrt() * (2.0 * uniform(self.seed, Use::Leaflet, number) - 1.0);
        let by = |which| share * self.irregularity * even(first + which);
        Strayed {
            along: by(0),
            angle: 1.0 + by(1),
            size: 1.0 + SIZE * by(2),
            turn: TURN * by(3),
        }
    }

    /// Lets those that are in the way, and the pinnae of two that stand on different ones, stray
    /// half as far; once none of these strays, the pinna on which two stand, which may bend too
    /// much. Returns whether any of them strayed.
    pub(super) fn calm(&mut self, errors: &[CompoundError]) -> bool {
        let (mut leaflets, mut pinnae, mut shared) = (Vec::new(), Vec::new(), Vec::new());
        for error in errors {
            match *error {
                CompoundError::Overlap { first, second } => {
                    leaflets.extend([first, second]);
                    if self.on_pinna > 0 {
                        let own = [first, second].map(|leaflet| leaflet / self.on_pinna);
                        let alike = own[0] == own[1];
                        if alike { &mut shared } else { &mut pinnae }.extend(own);
                    }
                }
                // Which axis it lies over is not known: it may be any.
                CompoundError::OnStalk { leaflet } => {
                    leaflets.push(leaflet);
                    pinnae.extend(0..self.pinnae.len());
                }
                CompoundError::Range(_)
                | CompoundError::TooMany { .. }
                | CompoundError::RolledUp { .. }
                | CompoundError::Leaflet(_) => {}
            }
        }
        // Not `||` for the first two: both are calmed.
        self.irregularity > 0.0
            && (halve(&mut self.leaflets, leaflets) | halve(&mut self.pinnae, pinnae)
                || halve(&mut self.pinnae, shared))
    }
}

/// Halves the shares with these numbers, each once, and returns whether one was above 0.
fn halve(shares: &mut [f64], mut numbers: Vec<usize>) -> bool {
    numbers.sort_unstable();
    numbers.dedup();
    let mut any = false;
    for number in numbers {
        any |= shares[number] > 0.0;
        shares[number] *= 0.5;
        if shares[number] < LEAST_SHARE {
            shares[number] = 0.0;
        }
    }
    any
}
