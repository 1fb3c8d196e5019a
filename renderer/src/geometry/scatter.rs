//! Places for many shapes on a surface: drawn at random, standing or at rest.
//!
//! - **In**: the surface as triangles in the world, what else lies on it, and the shapes as rigid
//!   bodies; metres.
//! - **Out**: for each thing its shape and its place in the world.
//! - **Always true**: the same plan gives the same places on every machine. A body at rest touches
//!   nothing with its inside: over each cell of a grid it lies above all that came before. It does
//!   not hang in the air: it is lowered and turned until its centre of mass is as low as its
//!   contacts let it be.
//! - **Left out**: forces, friction, bending. Bodies fall straight down, one after the other.
//!
//! A body comes to rest where its centre of mass is lowest; for small turns that is a linear
//! programme in three unknowns (`rest.rs`), which is solved again after each turn.

mod body;
mod pile;
mod points;
mod rest;
#[cfg(test)]
mod tests;

use glam::{DAffine3, DMat3, DVec2, DVec3};
use thiserror::Error;

use self::pile::Pile;
use self::points::Spaced;
use super::scramble::scramble;

pub use self::body::Body;
pub use self::points::Ground;

/// How many things lie on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// So many.
    Count(u32),
    /// So many for each m² of the surface (where things come to rest, of its plan).
    PerSquareMetre(f64),
}

/// How things lie on a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// How many.
    pub amount: Amount,
    /// The rectangle in the ground plan to which they keep: its least and greatest x and y, m.
    pub within: Option<[DVec2; 2]>,
    /// Least distance between the points where they stand, m.
    pub least_distance: f64,
    /// Least and greatest factor on their size, > 0.
    pub scale: [f64; 2],
    /// Greatest angle between a thing's own upright axis and the surface's normal (or the vertical)
    /// before it comes to rest, rad.
    pub tilt: f64,
    /// Greatest turn about that axis to either side, rad.
    pub turn: f64,
    /// Share that lies upside down.
    pub flipped: f64,
    /// Whether things stand upright instead of along the surface's normal.
    pub upright: bool,
    /// How a thing lies once it is there.
    pub rest: Rest,
    /// Same plan and seed, same places.
    pub seed: u64,
}

/// How a thing lies once it is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rest {
    /// Its origin lies on the surface, or below it.
    Fixed {
        /// How deep the origin lies below the surface, m.
        sink: f64,
    },
    /// It falls, and turns until it lies on the surface and on what has come before.
    Settled {
        /// Distance that is kept from what it lies on, m.
        gap: f64,
    },
}

/// Greatest number of things on one surface.
pub const MOST_THINGS: usize = 1 << 24;
/// Greatest number of things that come to rest on one surface.
pub const MOST_AT_REST: usize = 100_000;
/// Points that are tried for each thing before a surface counts as full.
const TRIES: usize = 30;

/// Why things have no places.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ScatterError {
    /// The surface has no area in the rectangle, or nowhere faces up.
    #[error("the surface has no area there{}", if *.rests { " that faces up" } else { "" })]
    NoSurface {
        /// Whether only what faces up counts.
        rests: bool,
    },
    /// The least distance or the edges leave too little room.
    #[error("there is room for {found} of {wanted}: use fewer, or let them be nearer")]
    NoRoom {
        /// How many have a place.
        found: usize,
        /// How many are asked for.
        wanted: usize,
    },
    /// More than there may be.
    #[error("{wanted} are more than the {most} that there may be")]
    TooMany {
        /// How many are asked for.
        wanted: f64,
        /// How many there may be.
        most: usize,
    },
}

/// A thing's shape and place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strewn {
    /// Index of its body.
    pub body: u32,
    /// From the frame of the body's shape to the world, m.
    pub to_world: DAffine3,
}

/// What a random number of a thing is for.
#[derive(Clone, Copy, Debug)]
enum Use {
    Triangle,
    Across,
    Along,
    Shape,
    Scale,
    Tilt,
    TiltTowards,
    Turn,
    Flip,
}

impl Scatter {
    /// Places for things on `ground`; what comes to rest lies on `others` too. `bodies` are the
    /// shapes, of which each is drawn equally often.
    ///
    /// # Errors
    ///
    /// [`ScatterError`] if there is no room.
    ///
    /// # Panics
    ///
    /// If there is no body.
    pub fn places(
        &self,
        ground: &Ground,
        others: &[[DVec3; 3]],
        bodies: &[Body],
    ) -> Result<Vec<Strewn>, ScatterError> {
        assert!(!bodies.is_empty(), "something is strewn");
        let rests = matches!(self.rest, Rest::Settled { .. });
        let measure = ground.measure(self.within, rests);
        if measure.total() <= 0.0 {
            return Err(ScatterError::NoSurface { rests });
        }
        let wanted = match self.amount {
            Amount::Count(count) => f64::from(count),
            Amount::PerSquareMetre(density) => (density * measure.total()).round(),
        };
        let most = if rests { MOST_AT_REST } else { MOST_THINGS };
        if wanted > most as f64 {
            return Err(ScatterError::TooMany { wanted, most });
        }
        let wanted = wanted as usize;
        let reach = bodies.iter().map(Body::radius).fold(0.0, f64::max) * self.scale[1];
        let least = bodies
            .iter()
            .map(Body::radius)
            .fold(f64::INFINITY, f64::min)
            * self.scale[0];
        let mut pile = rests.then(|| {
            let mut pile = Pile::over(measure.bounds(), reach, least);
            pile.add_all(ground.triangles());
            pile.add_all(others);
            pile
        });
        let mut spaced = Spaced::new(self.least_distance);
        let mut found = Vec::with_capacity(wanted);
        for number in 0..(TRIES * wanted) as u64 {
            if found.len() == wanted {
                break;
            }
            let random = |what: Use| self.random(number, what);
            let (point, normal) =
                measure.point([Use::Triangle, Use::Across, Use::Along].map(random));
            if !spaced.has_room(point) {
                continue;
            }
            let shape = (random(Use::Shape) * bodies.len() as f64) as usize;
            let [least, most] = self.scale;
            let scale = least + (most - least) * random(Use::Scale);
            let up = if self.upright || rests {
                DVec3::Z
            } else {
                normal
            };
            let turn = from_z(up) * self.posture(random);
            let body = &bodies[shape];
            let to_world = match (self.rest, &mut pile) {
                (Rest::Settled { gap }, Some(pile)) => {
                    // What would tip over an edge is not put there.
                    let Some((turn, at)) = pile.settle(body, turn * scale, point.truncate(), gap)
                    else {
                        continue;
                    };
                    DAffine3::from_mat3_translation(turn, at - turn * body.middle())
                }
                (Rest::Fixed { sink }, _) => {
                    DAffine3::from_mat3_translation(turn * scale, point - up * sink)
                }
                (Rest::Settled { .. }, None) => unreachable!("what comes to rest has a pile"),
            };
            spaced.take(point);
            found.push(Strewn {
                body: shape as u32,
                to_world,
            });
        }
        if found.len() < wanted {
            let found = found.len();
            return Err(ScatterError::NoRoom { found, wanted });
        }
        Ok(found)
    }

    /// The turn of a thing about its own axes, before the surface turns it.
    fn posture(&self, random: impl Fn(Use) -> f64) -> DMat3 {
        let (sin_tilt, cos_tilt) = libm::sincos(self.tilt * random(Use::Tilt));
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * random(Use::TiltTowards));
        let leaning = from_z(DVec3::new(sin_tilt * cos, sin_tilt * sin, cos_tilt));
        let (sin, cos) = libm::sincos(self.turn * (2.0 * random(Use::Turn) - 1.0));
        let turned = DMat3::from_cols(
            DVec3::new(cos, sin, 0.0),
            DVec3::new(-sin, cos, 0.0),
            DVec3::Z,
        );
        let flip = if random(Use::Flip) < self.flipped {
            // About y, along which a leaf's midrib runs.
            DMat3::from_diagonal(DVec3::new(-1.0, 1.0, -1.0))
        } else {
            DMat3::IDENTITY
        };
        leaning * turned * flip
    }

    /// A number in [0, 1) for each use of each thing.
    fn random(&self, number: u64, what: Use) -> f64 {
        let bits = scramble(scramble(self.seed ^ scramble(number)) ^ what as u64);
        (bits >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The smallest turn that takes +z to `up`, a unit vector.
fn from_z(up: DVec3) -> DMat3 {
    if up.z < -1.0 + 1e-12 {
        return DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0));
    }
    let share = 1.0 / (1.0 + up.z);
    DMat3::from_cols(
        DVec3::new(1.0 - up.x * up.x * share, -up.x * up.y * share, -up.x),
        DVec3::new(-up.x * up.y * share, 1.0 - up.y * up.y * share, -up.y),
        up,
    )
}
