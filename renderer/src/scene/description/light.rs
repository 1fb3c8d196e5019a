//! Lights: each kind is a file with its keys and with how the tracer's light is made of it.

pub mod area;
pub mod constant;
mod daylight;
pub mod distant;
pub mod environment;
pub mod overcast;
pub mod spot;

use std::path::Path;

use glam::DVec3;
use leafmodel::document::context::QUOTED;
use leafmodel::document::declared::Declared;
use leafmodel::document::error::DocumentError;
use leafmodel::document::keys::Keys;
use leafmodel::document::source::escaped;
use leafmodel::document::value_kind::{FileOnly, FilePath};
use thiserror::Error;

use self::area::{Area, Surface};
use self::constant::Constant;
use self::distant::Distant;
use self::environment::Environment;
use self::overcast::Overcast;
use self::spot::Spotlight;
use crate::light;
use crate::light::daylight::Daylight;
use crate::plugin::emitter::Emitter;
use crate::plugin::spectra::Spectra;
use crate::scene::assets::{self, AssetError, RgbPicture};
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

/// Why a light cannot be made.
#[derive(Debug, Error)]
pub enum LightError {
    /// Its picture cannot be read or has other contents.
    #[error("lights.{name}: {source}")]
    Picture {
        /// Name of the light.
        name: String,
        /// What is wrong with it.
        source: AssetError,
    },
    /// An area light varies over texture coordinates that its mesh lacks.
    #[error(
        "lights.{name}.area: the mesh of its object has no texture coordinates, over which `edge` \
         and `picture` are spread: leave them out, or use a mesh with them, such as a rectangle"
    )]
    NoTextureCoordinates {
        /// Name of the light.
        name: String,
    },
    /// An area light takes the emission of a model that emits nothing.
    #[error(
        "lights.{name}.area: no material of its object's mesh emits light: leave `emission` out, so that it \
         shines evenly"
    )]
    NoEmission {
        /// Name of the light.
        name: String,
    },
}

/// What a light is made in.
pub(in crate::scene) struct Surroundings<'w> {
    /// The light's name in the scene.
    pub(in crate::scene) name: &'w str,
    /// The origin of rays.
    pub(in crate::scene) origin: DVec3,
    /// The surface of the object that shines.
    pub(in crate::scene) surface: Option<Surface<'w>>,
    /// What was changed of its picture.
    pub(in crate::scene) notes: &'w mut Vec<String>,
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

/// A picture that shines, up to 4 GiB.
const PICTURE: FileOnly = FileOnly(FilePath::of(
    "the path of an EXR, HDR, PNG or JPEG picture",
    &["exr", "hdr", "png", "jpg", "jpeg"],
    4 << 30,
));

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

/// The picture of a light, and the layer of it.
fn read_picture(
    file: &Path,
    layer: Option<&str>,
    around: &mut Surroundings<'_>,
) -> Result<RgbPicture, LightError> {
    let name = around.name;
    let picture = assets::shining(file, layer).map_err(|source| LightError::Picture {
        name: name.to_owned(),
        source,
    })?;
    let mut note = |fraction: f64, what: &str| {
        if fraction > 0.0 {
            let (file, percent) = (file.display(), 100.0 * fraction);
            let note = format!("lights.{name}: {file}: {percent:.2} % of its pixels have {what}");
            around.notes.push(note);
        }
    };
    note(picture.below, "a channel below 0, which is taken for 0");
    note(
        picture.outside,
        "colours outside of Rec. 709, whose spectra are below 0 at some wavelengths: as a part of the light of \
         a whole scene they are right",
    );
    Ok(picture)
}
