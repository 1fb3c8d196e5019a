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
//! programme in three unknowns ([`numerics::rest`]), which is solved again after each turn.

mod body;
mod cells;
mod drops;
mod inclination;
mod pile;
mod place;
mod points;
#[cfg(test)]
mod tests;
mod volume;

use document::declared::{Declared, Defaults};
use document::keys::Keys;
use document::limits::Limits;
use document::number_lists::Rectangle;
use document::value_kind::{Flag, Integer, Number};
use glam::{DAffine3, DMat3, DVec2, DVec3};

use self::drops::{Nearby, Standing, merged};
use self::pile::Pile;
use self::place::from_z;
use self::points::{Measure, Spaced};

pub use self::body::Body;
pub use self::inclination::{BadInclinations, Inclination, InclinationTable};
pub use self::place::{MOST_AT_REST, MOST_THINGS, Most, NoPlace, ScatterError, Strewn};
pub use self::points::{Ground, triangles};
pub use self::volume::{Arrangement, Centres, Volume, VolumeError};
use super::instance::COORDINATES_M;
use crate::sampling::mixer;

/// How many things lie on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// So many.
    Count(u32),
    /// So many for each m² of the surface (where things come to rest, of its plan).
    PerSquareMetre(f64),
}

/// How things lie on a surface.
#[derive(Clone, Debug, Declared, Defaults, PartialEq)]
pub struct Scatter {
    /// How many.
    #[key(with = Self::declare_amount, default = Amount::Count(1))]
    pub amount: Amount,
    /// The rectangle to which they keep: least x and y, greatest x and y.
    #[key("within_m", Rectangle(COORDINATES_M))]
    pub within: Option<[DVec2; 2]>,
    /// Least distance between the points where they stand.
    #[key("least_distance_mm", milli(0.0..=1e9))]
    pub least_distance: f64,
    /// Least and greatest factor on their size.
    #[key("scale", above(0.0, 1e6), default = [1.0; 2])]
    pub scale: [f64; 2],
    /// Greatest lean from the surface's normal, before they come to rest; all directions within it are equally likely.
    ///
    /// It is the angle between a thing's own upright axis and the normal or the vertical, rad.
    #[key("tilt_deg", degrees(0.0..=180.0))]
    pub tilt: f64,
    /// Greatest turn to either side about their own z.
    #[key("turn_deg", degrees(0.0..=180.0), default = std::f64::consts::PI)]
    pub turn: f64,
    /// Share of them that lies upside down, turned about its y.
    #[key("flipped", 0.0..=1.0)]
    pub flipped: f64,
    /// Whether they stand upright instead of along the surface's normal.
    #[key("upright")]
    pub upright: bool,
    /// How a thing lies once it is there.
    #[key(with = Self::declare_rest, default = Rest::Fixed { sink: 0.0 })]
    pub rest: Rest,
    /// Share of what does not settle that stands in hollows of the surface, such as the furrows above
    /// veins.
    #[key("furrows", 0.0..=1.0)]
    pub furrows: f64,
    /// Whether what touches runs together into one of the summed volume, as drops do; there are fewer
    /// then.
    #[key("merge")]
    pub merge: bool,
    /// Same plan and seed, same places.
    #[key(default = 0)]
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

/// A seed of one of several independent draws; the first has the seed itself.
pub fn seed_of_draw(seed: u64, draw: u32) -> u64 {
    if draw == 0 {
        return seed;
    }
    mixer::scramble(mixer::scramble(seed) ^ u64::from(draw))
}

/// Points that are tried for each thing before a surface counts as full.
const TRIES: usize = 30;

/// Points among which a thing that stands in a hollow has the most hollow one.
const CHOICES: u64 = 24;

/// Failures in a row after which a surface counts as full, for things that settle (each takes long
/// to find out) and for others.
const IN_A_ROW: [usize; 2] = [100, 20_000];

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
    Furrow,
}

impl Scatter {
    /// Its keys for how many there are.
    fn declare_amount(&mut self, keys: &mut Keys<'_>) {
        let current = match self.amount {
            Amount::Count(_) => "count",
            Amount::PerSquareMetre(_) => "per_m2",
        };
        for chosen in keys.one_of(&["count", "per_m2"], Some(current)) {
            if chosen == "count" {
                let mut count = match self.amount {
                    Amount::Count(count) => count,
                    Amount::PerSquareMetre(_) => 1,
                };
                let about = "How many.";
                let limits = Integer::within(0, MOST_THINGS as u64);
                keys.needed("count", &mut count, limits, about);
                self.amount = Amount::Count(count);
            } else {
                let mut density = match self.amount {
                    Amount::PerSquareMetre(density) => density,
                    Amount::Count(_) => 1.0,
                };
                let about = "How many for each square metre of the surface; of its ground plan if they \
                come to rest.";
                let limits = Number(Limits::closed(0.0, 1e12));
                keys.needed("per_m2", &mut density, limits, about);
                self.amount = Amount::PerSquareMetre(density);
            }
        }
    }

    /// Its keys for how things come to lie.
    fn declare_rest(&mut self, keys: &mut Keys<'_>) {
        let (mut settles, mut gap_mm, mut sink_mm) = match self.rest {
            Rest::Settled { gap } => (true, 1e3 * gap, 0.0),
            Rest::Fixed { sink } => (false, 0.1, 1e3 * sink),
        };
        let about = "Whether they fall straight down, one after the other, and turn until they lie \
        still on the surface, on `over` and on one another.";
        keys.key("settle", &mut settles, Flag, about);
        let about = "What is kept between things at rest, for their thickness.";
        let limits = Number(Limits::closed(0.0, 1000.0));
        keys.key("gap_mm", &mut gap_mm, limits, about);
        let about = "How deep the origin of what does not settle lies below the surface; above it if \
        negative.";
        let limits = Number(Limits::closed(-1e6, 1e6));
        keys.key("sink_mm", &mut sink_mm, limits, about);
        self.rest = if settles {
            Rest::Settled { gap: 1e-3 * gap_mm }
        } else {
            Rest::Fixed {
                sink: 1e-3 * sink_mm,
            }
        };
    }

    /// Places for at most so many things on `ground`; what comes to rest lies on `others` too. `bodies`
    /// are the shapes, of which each is drawn equally often. `at_rest` is called for each thing that has
    /// come to rest, with the number of those that are wanted.
    ///
    /// # Errors
    ///
    /// [`ScatterError`] if there is no room.
    ///
    /// # Panics
    ///
    /// If there is no body.
    pub fn places_up_to(
        &self,
        ground: &Ground,
        others: impl IntoIterator<Item = [DVec3; 3]>,
        bodies: &[Body],
        most: Most,
        at_rest: &dyn Fn(usize),
    ) -> Result<Vec<Strewn>, ScatterError> {
        assert!(!bodies.is_empty(), "something is strewn");
        let rests = matches!(self.rest, Rest::Settled { .. });
        let measure = ground.measure(self.within, rests);
        if measure.total() <= 0.0 {
            return Err(ScatterError::NoSurface { rests });
        }
        let wanted = self.wanted(measure.total(), rests, most)?;
        let mut pile = None;
        if rests {
            let radii = || bodies.iter().map(Body::radius);
            let reach = radii().fold(0.0, f64::max) * self.scale[1];
            let least = radii().fold(f64::INFINITY, f64::min) * self.scale[0];
            let below = pile.insert(Pile::over(measure.bounds(), reach, least)?);
            ground
                .triangles()
                .chain(others)
                .for_each(|triangle| below.add(triangle));
        }
        let mut spaced = Spaced::new(self.least_distance);
        let widths: Vec<f64> = bodies.iter().map(Body::width).collect();
        // Hollows are looked for as wide as things are.
        let reach = widths.iter().copied().fold(0.0, f64::max) * self.scale[1];
        let prefers = !rests && (self.furrows > 0.0 || self.merge) && reach > 0.0;
        let nearby = prefers.then(|| Nearby::of(measure.triangles(), reach));
        let mut standing = Vec::new();
        let mut found = Vec::with_capacity(wanted);
        let mut failures = [0; NoPlace::ALL.len()];
        let mut in_a_row = 0;
        for number in 0..(TRIES * wanted) as u64 {
            if found.len() == wanted || in_a_row >= IN_A_ROW[usize::from(!rests)] {
                break;
            }
            in_a_row += 1;
            let random = |what: Use| self.random(number, what);
            let (point, normal) = self.point(number, &measure, nearby.as_ref());
            if !spaced.has_room(point) {
                failures[NoPlace::Near as usize] += 1;
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
            let to_world = match (self.rest, &mut pile) {
                (Rest::Settled { gap }, Some(pile)) => {
                    let body = &bodies[shape];
                    match pile.settle(body, turn * scale, point.truncate(), gap) {
                        Ok((turn, at)) => {
                            at_rest(wanted);
                            DAffine3::from_mat3_translation(turn, at - turn * body.middle())
                        }
                        Err(why) => {
                            failures[why as usize] += 1;
                            continue;
                        }
                    }
                }
                (Rest::Fixed { sink }, _) => {
                    DAffine3::from_mat3_translation(turn * scale, point - up * sink)
                }
                (Rest::Settled { .. }, None) => unreachable!("what comes to rest has a pile"),
            };
            in_a_row = 0;
            spaced.take(point);
            standing.push(Standing {
                body: shape as u32,
                point,
                up,
                turn,
                scale,
            });
            found.push(Strewn {
                body: shape as u32,
                to_world,
            });
        }
        if found.len() < wanted {
            let why = NoPlace::ALL
                .into_iter()
                .max_by_key(|why| failures[*why as usize]);
            return Err(ScatterError::NoRoom {
                found: found.len(),
                wanted,
                why: why.unwrap_or(NoPlace::Near),
            });
        }
        match (&nearby, self.rest) {
            (Some(nearby), Rest::Fixed { sink }) if self.merge => {
                Ok(self.run_together(standing, &widths, nearby, sink))
            }
            _ => Ok(found),
        }
    }

    /// How many things are wanted on a surface of this area, m².
    fn wanted(&self, area: f64, rests: bool, most: Most) -> Result<usize, ScatterError> {
        let (wanted, is_none) = match self.amount {
            Amount::Count(count) => (f64::from(count), count == 0),
            Amount::PerSquareMetre(density) => ((density * area).round(), density == 0.0),
        };
        let most = if rests {
            Most::Ever(MOST_AT_REST).and(most)
        } else {
            most
        };
        if wanted > most.things() as f64 {
            return Err(ScatterError::TooMany { wanted, most });
        }
        if wanted < 1.0 && !is_none {
            return Err(ScatterError::None { area });
        }
        Ok(wanted as usize)
    }

    /// Where a thing with this number comes to stand, and the surface's normal there: with the share
    /// `furrows` the deepest hollow of some random places.
    fn point(&self, number: u64, measure: &Measure, nearby: Option<&Nearby>) -> (DVec3, DVec3) {
        let places = [Use::Triangle, Use::Across, Use::Along];
        let (mut point, mut normal) = measure.point(places.map(|what| self.random(number, what)));
        if let Some(nearby) = nearby
            && self.random(number, Use::Furrow) < self.furrows
        {
            let mut most = nearby.hollowness(point, normal);
            for choice in 1..CHOICES {
                let other = |what: Use| self.random(number | (choice << 40), what);
                let (place, up) = measure.point(places.map(other));
                let hollow = nearby.hollowness(place, up);
                if hollow > most {
                    (point, normal, most) = (place, up, hollow);
                }
            }
        }
        (point, normal)
    }

    /// Things of which those that touch have run together, `sink` below the surface.
    fn run_together(
        &self,
        standing: Vec<Standing>,
        widths: &[f64],
        nearby: &Nearby,
        sink: f64,
    ) -> Vec<Strewn> {
        let turned = |from: DVec3, to: DVec3, turn: DMat3| {
            if self.upright {
                turn
            } else {
                from_z(to) * from_z(from).transpose() * turn
            }
        };
        let drops = merged(standing, widths, nearby, turned).into_iter();
        let drops = drops.map(|drop| {
            let up = if self.upright { DVec3::Z } else { drop.up };
            let at = drop.point - up * sink;
            Strewn {
                body: drop.body,
                to_world: DAffine3::from_mat3_translation(drop.turn * drop.scale, at),
            }
        });
        drops.collect()
    }

    /// The turn of a thing about its own axes, before the surface turns it.
    fn posture(&self, random: impl Fn(Use) -> f64) -> DMat3 {
        // Evenly over the cap of directions.
        let cos_tilt = 1.0 - (1.0 - libm::cos(self.tilt)) * random(Use::Tilt);
        let sin_tilt = (1.0 - cos_tilt * cos_tilt).max(0.0).sqrt();
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
        mixer::of_use(self.seed, number, what as u64)
    }
}
