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
mod draws;
mod error;
mod fluorescence;
mod flux;
mod gonio;
mod lamp;
mod ledger;
mod measurement;
mod period;
mod row;
mod spectral;
mod sphere;
mod spot;
mod stage;

pub use self::batches::{Budget, Effort, FEWEST_RAYS, Target, Watch};
pub use self::error::{InstrumentError, Problem};
use self::flux::LANES;
use self::measurement::Measurement;
pub use self::period::MOST_TURNS;
pub use self::row::{CutPaths, Direction, ErrorParts, Reading, Row, ViewAngles};
use crate::scene::description::{Description, InstrumentKind};
use crate::scene::world::{self as scenes, BuildOptions};
use crate::spectrum::WavelengthSampler;
use trace::world::World;

/// The wavelengths of all instruments of a scene, and the first set of each; `None` if there are no
/// instruments.
pub fn sets_of(scene: &Description) -> Option<(WavelengthSampler, Vec<usize>)> {
    let lists = scene.instruments.iter();
    let lists: Vec<_> = lists.map(|named| named.value.measured_nm()).collect();
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
/// those of the world, for the leaves that stand in it.
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
    read_out_once(world, scene, number, first_set, &effort)
}

/// As [`read_out`], but for the mean over all draws of the leaves that the instrument asks for, and may
/// end early. The world is built with these options and may be drawn again; in the end it is as it was.
///
/// # Errors
///
/// As [`read_out`], and if there is no room for one of the draws.
pub fn read_out_watched(
    world: &mut scenes::World,
    scene: &Description,
    number: usize,
    first_set: usize,
    effort: &Effort<'_>,
    options: &BuildOptions<'_>,
) -> Result<Reading, InstrumentError> {
    draws::read_out_each(world, (scene, number), effort, options, |world, effort| {
        read_out_once(world, scene, number, first_set, effort)
    })
}

fn read_out_once(
    world: &World,
    scene: &Description,
    number: usize,
    first_set: usize,
    effort: &Effort<'_>,
) -> Result<Reading, InstrumentError> {
    let instrument = &scene.instruments[number];
    let measurement = &Measurement {
        world,
        scene,
        instrument,
        first_set,
        effort,
    };
    match &instrument.value.kind {
        InstrumentKind::Sphere(sample) => sphere::read_out(measurement, sample),
        InstrumentKind::Gonio(gonio) => gonio::read_out(measurement, gonio),
        InstrumentKind::Canopy(canopy) => canopy::read_out(measurement, canopy),
        InstrumentKind::Depth(depth) => depth::read_out(measurement, depth),
    }
}
