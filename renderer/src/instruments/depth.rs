//! Light by depth within a leaf, solved by layers.
//!
//! The leaf has the contents of an object's tissue in the layers of
//! [`LayeredLeaf`](leafmodel::optics::layers::LayeredLeaf). Nothing is followed at random here, so
//! figures have no statistical error.

use glam::DVec2;
use leafmodel::optics::Contents;
use leafmodel::optics::layers::{Face, Incidence, LayeredLeaf};
use rayon::prelude::*;

use super::batches::Estimate;
use super::error::{InstrumentError, Problem};
use super::lamp::{FACES, directions};
use super::measurement::Measurement;
use super::row::{CutPaths, Direction, Reading};
use super::spectral::Series;
use crate::material::Tissue;
use crate::scene::description::DepthProfile;
use trace::world::World;

/// Optical depth of absorption of a slice from which on its fluence can be told from what it absorbs.
const LEAST_DEPTH: f64 = 1e-9;

/// One wavelength: the slices with what each absorbs per µm, and the fluence rate in it.
struct Profile {
    slices: Vec<(&'static str, f64)>,
    absorbed_per_um: Vec<f64>,
    fluence: Vec<f64>,
}

/// The tissue of an object, if it has some of known contents.
fn tissue_of(world: &World, object: usize) -> Option<Tissue<'_>> {
    (0..world.objects.len())
        .filter(|&instance| world.objects[instance].object == object)
        .find_map(|instance| {
            let tissue = world.material_of(instance as u32).tissue()?;
            tissue.held.is_some().then_some(tissue)
        })
}

/// Measures.
pub(super) fn read_out(
    measurement: &Measurement<'_>,
    depth: &DepthProfile,
) -> Result<Reading, InstrumentError> {
    let refuse = |problem: String| {
        let object = measurement.object(depth.object);
        measurement.refuse(Problem::NoContents { object, problem })
    };
    let tissue = tissue_of(measurement.world, depth.object);
    let Some((tissue, held)) = tissue.and_then(|tissue| Some((tissue, tissue.held?))) else {
        return Err(refuse("is not tissue of known contents".to_owned()));
    };
    let contents = match depth.uv {
        Some(uv) => Contents::from_texel(held.at(DVec2::from(uv).as_vec2())),
        None => held.mean(),
    };
    let contents = contents
        .checked()
        .map_err(|error| refuse(format!("has contents out of range: {error}")))?;
    let leaf = LayeredLeaf::new(&contents);
    if leaf.thickness_um() == 0.0 {
        let problem = "has neither water nor dry matter, so that its layers have no thickness";
        return Err(refuse(problem.to_owned()));
    }
    let nm = measurement.instrument.value.measured_nm();
    let mut all = Vec::new();
    for (face, lit) in [Face::First, Face::Last].into_iter().enumerate() {
        if !depth.faces[face] {
            continue;
        }
        for light in directions(&depth.incidence) {
            let incidence = match light {
                Direction::Beam(angle) => Incidence::Directional {
                    cosine: libm::cos(angle),
                },
                Direction::Diffuse => Incidence::Lambertian,
            };
            let profiles: Vec<Profile> = nm
                .par_iter()
                .map(|&nm| profile(&leaf, tissue, nm, (lit, incidence), depth.slices))
                .collect::<Result<_, _>>()
                .map_err(&refuse)?;
            let series = series(measurement, &profiles, light, FACES[face]);
            all.extend(measurement.rows(&series));
        }
    }
    Ok(Reading {
        rows: all,
        cut: CutPaths::NONE,
        draws: 1,
    })
}

fn profile(
    leaf: &LayeredLeaf,
    tissue: Tissue<'_>,
    nm: f64,
    (face, incidence): (Face, Incidence),
    count: usize,
) -> Result<Profile, String> {
    let at = tissue.palette.coefficients(nm);
    let slices = leaf
        .profile(&at, face, incidence, count)
        .map_err(|error| error.to_string())?;
    let stack = leaf.stack(&at);
    let absorbing = stack.layers().iter().flat_map(|layer| {
        let depth = layer.depth * (1.0 - layer.albedo) / count as f64;
        std::iter::repeat_n(depth, count)
    });
    // What is absorbed is the coefficient of absorption times the fluence rate.
    let fluence = |absorbed: f64, depth: f64| match depth {
        depth if depth > LEAST_DEPTH => absorbed / depth,
        _ => f64::NAN,
    };
    let all = || slices.iter();
    Ok(Profile {
        slices: all()
            .map(|slice| (slice.tissue.name(), slice.depth_um))
            .collect(),
        absorbed_per_um: all()
            .map(|slice| slice.absorbed / slice.thickness_um)
            .collect(),
        fluence: all()
            .zip(absorbing)
            .map(|(slice, depth)| fluence(slice.absorbed, depth))
            .collect(),
    })
}

/// The figures of one light, by slices from the adaxial face on.
fn series(
    measurement: &Measurement<'_>,
    profiles: &[Profile],
    light: Direction,
    face: &'static str,
) -> Vec<Series> {
    let Some(first) = profiles.first() else {
        return Vec::new();
    };
    let of = |slice: usize, quantity, unit, value: &dyn Fn(&Profile) -> f64| {
        let (layer, depth_um) = first.slices[slice];
        let mut row = measurement.row(quantity, light);
        row.part = Some(layer.to_owned());
        row.face = Some(face);
        row.depth_um = Some(depth_um);
        row.unit = unit;
        let figures = profiles.iter().map(|one| Estimate::exact(value(one)));
        Series::new(row, figures.collect())
    };
    let mut all = Vec::new();
    for slice in 0..first.slices.len() {
        let absorbed = |one: &Profile| one.absorbed_per_um[slice];
        all.push(of(slice, "absorbed_per_depth", "um-1", &absorbed));
        let fluence = |one: &Profile| one.fluence[slice];
        // A layer that absorbs nothing at some wavelength tells no fluence there.
        if profiles.iter().all(|one| one.fluence[slice].is_finite()) {
            all.push(of(slice, "fluence", "1", &fluence));
        }
    }
    all
}
