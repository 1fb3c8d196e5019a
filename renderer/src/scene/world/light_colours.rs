//! What colours the lights of a scene have on its film.
//!
//! - **In**: the lights as described and as built, the film's wavelengths.
//! - **Out**: the colour of the mean spectrum of each, as the film records it: with the same
//!   wavelengths and the same weights, so that a grey surface that one light illuminates is neutral
//!   when that light is.
//!   Lights that the film cannot record are refused.
//! - **Left out**: from where light comes. The mean of a picture is that over the sphere or the
//!   shining surface, daylight is that on level ground in the open.

use std::collections::BTreeSet;

use leafmodel::optics::fluorescence::EXCITED_NM;
use rayon::prelude::*;

use super::error::WorldError;
use crate::film::MOST_RADIANCE;
use crate::image::display::recorded_colour;
use crate::image::light_colour::LightColour;
use crate::light::Light;
use crate::scene::description::{self, Description};
use crate::scene::expand::rigs::of_part;
use crate::spectrum::{Share, WavelengthSampler};

/// The colours of the scene's lights, in its order. Daylight comes with its parts `NAME.sun` and
/// `NAME.sky`; the lights of a rig, which have one spectrum, are together called as it is.
pub(super) fn light_colours(
    scene: &Description,
    built: &[Light],
    wavelengths: &WavelengthSampler,
) -> Vec<LightColour> {
    let mut colours: Vec<LightColour> = Vec::new();
    let mut add = |name: &str, spectrum: &dyn Fn(&Share) -> f64| {
        let colour = recorded_colour(wavelengths, spectrum);
        colours.push(LightColour::new(name.to_owned(), colour));
    };
    let mut reported_rigs = BTreeSet::new();
    for (named, own) in scene.with_built(built) {
        let rig = of_part(&named.name);
        if rig.is_some_and(|rig| !reported_rigs.insert(rig)) {
            continue;
        }
        let name = rig.unwrap_or(&named.name);
        match (&named.value, own) {
            (description::Light::Daylight(day), [Light::Sun(sun), Light::Sky(sky)]) => {
                let up = libm::sin(day.elevation);
                let direct = |share: &Share| up * f64::from(sun.irradiance().over(share));
                let diffuse = |share: &Share| f64::from(sky.diffuse().over(share));
                add(name, &|share| direct(share) + diffuse(share));
                if rig.is_none() {
                    add(&format!("{name}.sun"), &direct);
                    add(&format!("{name}.sky"), &diffuse);
                }
            }
            // What else there is, is one light.
            (_, own) => {
                for light in own {
                    let mean = light.mean_spectrum();
                    add(name, &|share| mean.over(share));
                }
            }
        }
    }
    colours
}

/// Refuses a picture that is to be balanced by a light that cannot come out white.
pub(super) fn check_white(scene: &Description, colours: &[LightColour]) -> Result<(), WorldError> {
    let Some(name) = &scene.picture.white_light else {
        return Ok(());
    };
    let mut known = colours.iter();
    let light = known.find(|light| light.name == *name);
    let why = light.map_or(Err("is not there"), LightColour::balanceable);
    why.map(|_| ()).map_err(|why| WorldError::WhiteLight {
        name: name.clone(),
        why,
    })
}

/// Refuses lights that are brighter than a film can record.
pub(super) fn check_brightness(
    scene: &Description,
    lights: &[Light],
    wavelengths: &WavelengthSampler,
) -> Result<(), WorldError> {
    for (named, own) in scene.with_built(lights) {
        for share in wavelengths.grid().shares() {
            // What a spotlight shows depends on how far it is.
            let rest = own.iter().filter(|light| !matches!(light, Light::Spot(_)));
            let shown = rest.map(|light| light.shows(&share));
            let radiance = shown.fold(0.0, f32::max);
            if radiance > MOST_RADIANCE {
                return Err(WorldError::TooBright {
                    name: of_part(&named.name).unwrap_or(&named.name).to_owned(),
                    nm: share.nm,
                    // What single precision does not hold is at least its greatest number.
                    radiance: radiance.min(f32::MAX),
                });
            }
        }
    }
    Ok(())
}

/// A radiance that lights exceed nowhere at the wavelengths of paths, W m⁻² sr⁻¹ nm⁻¹; infinite if
/// one has no extent. What excites fluorescence counts too.
pub(super) fn brightest(
    lights: &[Light],
    wavelengths: &WavelengthSampler,
    fluoresces: bool,
) -> f32 {
    let [first, last] = EXCITED_NM.map(|nm| nm as u32);
    let excited = (first..=last).filter(|_| fluoresces);
    let excited = excited.map(|nm| Share::around(f64::from(nm), 1.0));
    let shares: Vec<Share> = wavelengths.grid().shares().chain(excited).collect();
    let of_light = |light: &Light| {
        let all = shares.iter().map(|share| light.at_most(share));
        all.fold(0.0, f32::max)
    };
    lights.par_iter().map(of_light).reduce(|| 0.0, f32::max)
}
