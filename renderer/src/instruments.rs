//! Instruments: what a scene scatters and absorbs, as figures with standard errors.
//!
//! - **In**: a [`World`] whose materials are tabulated at the instruments' wavelengths
//!   ([`sets_of`]), the instruments of its description, a [`Budget`].
//! - **Out**: [`Row`]s, one figure each.
//! - **Always true**: same scene, budget and seed, same figures, bit for bit, on any number of
//!   threads; of the light of a beam nothing is lost or counted twice.
//! - **Left out**: polarisation; fluorescence that fluorescence excites.
//!
//! Flux is followed from the light on, by the BSDFs that pictures use. Those of smooth surfaces are
//! reciprocal: the share of light that is scattered from `wo` to `wi` is that from `wi` to `wo`. With
//! relief they are so only nearly, and light that relief loses counts as absorbed.
//!
//! ```
//! use std::path::Path;
//!
//! use renderer::instruments::{Budget, read_out, sets_of};
//! use renderer::scene::load::parse_for_instruments;
//! use renderer::scene::world::{BuildOptions, World};
//!
//! let scene = r#"
//!     format = 1
//!     [film.rgb]
//!     size = [8, 8]
//!     spp = 1
//!     [camera.orthographic]
//!     position_m = [0, 0, 1]
//!     look_at_m = [0, 0, 0]
//!     up = [0, 1, 0]
//!     height_m = 1
//!     [meshes.sheet.rectangle]
//!     width_m = 0.1
//!     height_m = 0.1
//!     [materials.paper.diffuse]
//!     reflectance = 0.7
//!     [objects.paper]
//!     mesh = "sheet"
//!     material = "paper"
//!     [instruments.ball.sphere]
//!     object = "paper"
//!     wavelengths_nm = [550]
//!     spot = { at_mm = [0, 0], diameter_mm = 10 }
//! "#;
//! let scene = parse_for_instruments(scene, "paper.toml", Path::new("."), &[])?.description;
//! let (sampler, first) = sets_of(&scene).expect("there is an instrument");
//! let options = BuildOptions { wavelengths: Some(&sampler), ..BuildOptions::default() };
//! let world = World::build_with(&scene, &options)?;
//! let budget = Budget { rays: 1 << 12, error: None, seed: 1 };
//! let rows = read_out(&world, &scene, 0, first[0], &budget)?.rows;
//! let reflectance = rows.iter().find(|row| row.quantity == "reflectance").expect("it is measured");
//! assert!((reflectance.value - 0.7).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod batches;
mod canopy;
mod constituents;
mod depth;
mod detector;
mod fluorescence;
mod flux;
mod gonio;
mod lamp;
mod ledger;
mod period;
mod row;
mod spectral;
mod sphere;
mod spot;
mod stage;

use thiserror::Error;

pub use self::batches::{Budget, Effort, FEWEST_RAYS, Target, Watch};
pub use self::period::MOST_TURNS;
pub use self::row::{Direction, Row, ViewAngles};
pub use self::stage::CutPaths;
use crate::geometry::GeometryError;
use crate::scene::description::{Description, InstrumentKind};
use crate::scene::world::World;
use crate::spectrum::WavelengthSampler;

/// Number of wavelengths that a path carries.
const LANES: usize = 8;

/// Why an instrument cannot measure; each begins with where its block stands.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum InstrumentError {
    /// The middle of a spot is not on its object.
    #[error("{at}: the spot is off the object `{object}`: {place} is no point of its surface")]
    OffTheObject {
        /// Where the block stands.
        at: String,
        /// The object.
        object: String,
        /// The key with its value.
        place: String,
    },
    /// A part of a spot is beside its object.
    #[error(
        "{at}: {share:.1} % of the spot is not covered by the object `{object}`: use a smaller \
         `diameter_mm` or another place"
    )]
    NotCovered {
        /// Where the block stands.
        at: String,
        /// The object.
        object: String,
        /// Share of the spot where there is nothing, percent.
        share: f64,
    },
    /// No ray met the object.
    #[error("{at}: no light meets the object `{object}`: is it seen from this side?")]
    NothingLit {
        /// Where the block stands.
        at: String,
        /// The object.
        object: String,
    },
    /// A canopy without anything but soil.
    #[error(
        "{at}: nothing stands in `within_m` besides the soil: move the box, or add leaves to the \
         scene"
    )]
    NoLeaves {
        /// Where the block stands.
        at: String,
    },
    /// What stands in a box that repeats itself is too high for its width.
    #[error(
        "{at}: what stands in `within_m` reaches from z = {:.4e} to {:.4e} m, more than {most} times the \
         smaller side of the box ({side} m); the tallest is of the object `{object}`: widen the box, \
         or leave that object out of the scene", heights[0], heights[1]
    )]
    TooHigh {
        /// Where the block stands.
        at: String,
        /// Least and greatest height, m.
        heights: [f64; 2],
        /// Smaller side of the box, m.
        side: f64,
        /// The most times that.
        most: f64,
        /// The object of the tallest part.
        object: String,
    },
    /// Soil that does not fill the box.
    #[error(
        "{at}: the soil `{object}` does not reach over the whole of `within_m`: widen it or \
         narrow the box"
    )]
    SoilTooSmall {
        /// Where the block stands.
        at: String,
        /// The object.
        object: String,
    },
    /// An object whose inside scatters or absorbs what a figure does not count.
    #[error("{at}: the object `{object}` {problem}")]
    Inside {
        /// Where the block stands.
        at: String,
        /// The object.
        object: String,
        /// What is not counted, and what to write.
        problem: &'static str,
    },
    /// A port that looks at its own object, as one within a closed body does.
    #[error(
        "{at}: the abaxial face of the object `{object}` cannot be lit through a port: the port \
         faces another part of the object, as within a closed body: write `faces = \"adaxial\"`"
    )]
    PortInside {
        /// Where the block stands.
        at: String,
        /// The object.
        object: String,
    },
    /// An object without known contents.
    #[error("{at}: the object `{object}` {problem}")]
    NoContents {
        /// Where the block stands.
        at: String,
        /// The object.
        object: String,
        /// What is wrong.
        problem: String,
    },
    /// More figures than there is memory for.
    #[error(
        "{at}: `instances` asks for {figures} figures of sets of eight wavelengths, more than \
         {most}: use fewer wavelengths, lights or leaves"
    )]
    TooManyInstances {
        /// Where the block stands.
        at: String,
        /// How many there would be.
        figures: usize,
        /// How many there may be.
        most: usize,
    },
    /// Copies of a canopy's parts cannot be placed.
    #[error("{at}: {source}")]
    Geometry {
        /// Where the block stands.
        at: String,
        /// Why.
        source: GeometryError,
    },
}

/// What an instrument reads.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Its figures.
    pub rows: Vec<Row>,
    /// Paths that were cut; what they carried counts as absorbed, or is missing from the figures of a
    /// canopy.
    pub cut: CutPaths,
}

/// The wavelengths of all instruments of a scene, and the first set of each; `None` if there are no
/// instruments.
pub fn sets_of(scene: &Description) -> Option<(WavelengthSampler, Vec<usize>)> {
    let lists = scene.instruments.iter();
    let lists: Vec<Vec<f64>> = lists
        .map(|instrument| instrument.value.measured_nm())
        .collect();
    let lists: Vec<&[f64]> = lists.iter().map(Vec::as_slice).collect();
    (!lists.is_empty()).then(|| WavelengthSampler::of_lists(LANES, &lists))
}

/// What the instrument with this number leaves out of a scene, in sentences for users.
pub fn notes(world: &World, scene: &Description, number: usize) -> Vec<String> {
    match &scene.instruments[number].value.kind {
        InstrumentKind::Sphere(_) | InstrumentKind::Gonio(_) | InstrumentKind::Depth(_) => {
            Vec::new()
        }
        InstrumentKind::Canopy(canopy) => canopy::notes(world, scene, canopy),
    }
}

/// Reads out the instrument with this number, whose wavelengths begin at the set `first_set` of
/// those of the world.
///
/// # Errors
///
/// [`InstrumentError`] if it cannot measure.
pub fn read_out(
    world: &World,
    scene: &Description,
    number: usize,
    first_set: usize,
    budget: &Budget,
) -> Result<Reading, InstrumentError> {
    let effort = Effort {
        budget: *budget,
        watch: None,
    };
    read_out_watched(world, scene, number, first_set, &effort)
}

/// As [`read_out`], but may end early.
///
/// # Errors
///
/// As [`read_out`].
pub fn read_out_watched(
    world: &World,
    scene: &Description,
    number: usize,
    first_set: usize,
    effort: &Effort<'_>,
) -> Result<Reading, InstrumentError> {
    let instrument = &scene.instruments[number];
    match &instrument.value.kind {
        InstrumentKind::Sphere(sample) => {
            sphere::read_out(world, scene, (instrument, sample), first_set, effort)
        }
        InstrumentKind::Gonio(gonio) => {
            gonio::read_out(world, scene, (instrument, gonio), first_set, effort)
        }
        InstrumentKind::Canopy(canopy) => {
            canopy::read_out(world, scene, (instrument, canopy), first_set, effort)
        }
        InstrumentKind::Depth(depth) => depth::read_out(world, scene, (instrument, depth)),
    }
}
