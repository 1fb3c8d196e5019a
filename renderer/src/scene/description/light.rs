//! Lights: each kind is a file with its keys and with how the tracer's light is made of it.

pub mod area;
pub mod constant;
mod daylight;
pub mod distant;
pub mod environment;
pub mod overcast;
pub mod spot;
mod surroundings;

use std::path::Path;

use leafmodel::document::context::QUOTED;
use leafmodel::document::declared::Declared;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::source::escaped;

use self::area::Area;
use self::constant::Constant;
use self::distant::Distant;
use self::environment::Environment;
use self::overcast::Overcast;
use self::spot::Spotlight;
pub use self::surroundings::LightError;
pub(in crate::scene) use self::surroundings::{Surface, Surroundings};
use crate::light;
use crate::light::daylight::Daylight;
use crate::plugin::emitter::Emitter;
use crate::plugin::spectra::Spectra;
use crate::spectrum::written::Spectrum;

/// A light.
#[derive(Clone, Debug, Declared)]
pub enum Light {
    /// A disc at infinity, like the sun.
    #[key(last = refuse_darkness)]
    Distant(Distant),
    /// The same radiance from everywhere.
    #[key(last = refuse_darkness)]
    Constant(Constant),
    /// A latitude–longitude picture at infinity, up is +z.
    #[key(last = refuse_darkness)]
    Environment(Environment),
    /// The sun and a clear sky, with the spectra of a day.
    #[key(with = daylight::daylight)]
    Daylight(Daylight),
    /// A sky that is covered with cloud, brightest in the zenith.
    #[key(last = refuse_darkness)]
    Overcast(Overcast),
    /// An object whose surface shines to the side of its normal.
    #[key(last = refuse_darkness)]
    Area(Area),
    /// A point that shines into a cone.
    #[key(last = refuse_darkness)]
    Spot(Spotlight),
}

impl Light {
    /// Number of lights that are built of it: daylight is the sun and the sky.
    pub fn parts(&self) -> usize {
        if let Self::Daylight(_) = self { 2 } else { 1 }
    }

    /// The tracer's lights that it is.
    pub(in crate::scene) fn built(
        &self,
        around: Surroundings<'_>,
    ) -> Result<Vec<light::Light>, LightError> {
        Ok(vec![match self {
            Self::Distant(light) => light::Light::Distant(light.built()),
            Self::Constant(light) => light::Light::Constant(light.built()),
            Self::Environment(light) => light::Light::Environment(light.built(around)?),
            Self::Overcast(light) => light::Light::Sky(light.built()),
            Self::Area(light) => light::Light::Area(light.built(around)?),
            Self::Spot(light) => light::Light::Spot(light.built(around.origin)),
            Self::Daylight(day) => {
                let (sun, sky) = day.lights();
                return Ok(vec![light::Light::Sun(sun), light::Light::Sky(sky)]);
            }
        }])
    }

    /// What Mitsuba gets of it.
    pub(crate) fn emitter(&self, spectra: &mut Spectra) -> Emitter<'_> {
        match self {
            Self::Distant(light) => light.emitter(spectra),
            Self::Constant(light) => Emitter::Around(Some(&light.radiance)),
            Self::Environment(_) | Self::Overcast(_) => Emitter::Around(None),
            Self::Area(_) => Emitter::OnShape,
            Self::Spot(light) => Emitter::Placed(light.emitter(spectra)),
            Self::Daylight(day) => daylight::sun(day, spectra),
        }
    }

    /// Its spectrum, relative: of daylight, of sun and sky on a level plane.
    pub(in crate::scene) fn relative_spectrum(&self) -> Spectrum {
        match self {
            Self::Distant(light) => light.irradiance.clone(),
            Self::Constant(light) => light.radiance.clone(),
            Self::Environment(light) => light.white.clone(),
            Self::Daylight(day) => daylight::on_level_ground(day),
            Self::Overcast(light) => light.irradiance.clone(),
            Self::Area(light) => light.radiance.clone(),
            Self::Spot(light) => light.intensity.clone(),
        }
    }

    /// The area light that it is.
    pub fn area(&self) -> Option<&Area> {
        if let Self::Area(area) = self {
            Some(area)
        } else {
            None
        }
    }

    /// The object whose own materials say what it emits.
    pub fn emitting_object(&self) -> Option<usize> {
        let area = self.area().filter(|area| area.pattern.emission);
        area.map(|area| area.object)
    }

    /// The picture that it shines by, and the layer of it.
    pub fn picture(&self) -> Option<(&Path, Option<&str>)> {
        if let Self::Environment(light) = self {
            return Some((&light.file, light.layer.name()));
        }
        let pattern = &self.area()?.pattern;
        Some((pattern.picture.as_deref()?, pattern.layer.name()))
    }
}

/// Reports a light that is dark at all wavelengths of the film.
fn refuse_darkness(light: &mut Light, keys: &mut Keys<'_>) {
    let Some(block) = keys.reader().filter(|_| keys.is_sound()) else {
        return;
    };
    if light.relative_spectrum().is_dark(block.cx.range_nm.get()) {
        let name = block.path.rsplit('.').nth(1).unwrap_or("");
        let name = escaped(name, QUOTED);
        block.cx.error(&block.at, DocumentError::DarkLight { name });
    }
}
