//! Conversion of lights from the description.

use std::path::Path;

use super::WorldError;
use crate::geometry::{Instance, TriangleMesh};
use crate::light::Light;
use crate::light::area::AreaLight;
use crate::light::daylight::sky::SkyLight;
use crate::light::distant::DistantLight;
use crate::light::environment::EnvironmentLight;
use crate::light::pattern::Pattern;
use crate::light::spot::SpotLight;
use crate::light::texels::Texels;
use crate::scene::assets::{self, RgbPicture};
use crate::scene::description;
use crate::spectrum::Curve;

/// The lights of a block of the scene; `instance_of` gives the only instance of an emitting object.
/// What was changed of its picture is noted.
pub(super) fn build_lights<'i>(
    name: &str,
    light: &description::Light,
    meshes: &[TriangleMesh],
    instance_of: impl Fn(usize) -> &'i Instance,
    notes: &mut Vec<String>,
) -> Result<Vec<Light>, WorldError> {
    Ok(vec![match light {
        description::Light::Distant {
            towards,
            angular_diameter,
            irradiance,
        } => Light::Distant(DistantLight::new(
            towards.as_vec3(),
            *angular_diameter,
            Curve::from_description(irradiance),
        )),
        description::Light::Constant { radiance } => {
            Light::Constant(Curve::from_description(radiance).into())
        }
        description::Light::Environment {
            file,
            scale,
            rotation,
            white,
        } => {
            let picture = picture(name, file, notes)?;
            Light::Environment(EnvironmentLight::new(
                picture.texels,
                picture.width,
                Curve::from_description(white).scaled(*scale as f32),
                *rotation as f32,
            ))
        }
        description::Light::Area {
            object,
            radiance,
            pattern,
        } => {
            let instance = instance_of(*object);
            let mesh = &meshes[instance.mesh as usize];
            let radiance = Curve::from_description(radiance);
            let mirrored = instance.to_world.matrix3.determinant() < 0.0;
            let triangles = corners(mesh, mirrored, |vertex| {
                instance.to_world.transform_point3(mesh.positions()[vertex])
            });
            Light::Area(match pattern {
                None => AreaLight::new(&triangles, radiance),
                Some(pattern) => {
                    let Some(uvs) = mesh.uvs() else {
                        return Err(WorldError::NoTextureCoordinates {
                            name: name.to_owned(),
                        });
                    };
                    let uvs = corners(mesh, mirrored, |vertex| uvs[vertex]);
                    let pattern = build_pattern(name, pattern, notes)?;
                    AreaLight::with_pattern(&triangles, &uvs, radiance, pattern)
                }
            })
        }
        description::Light::Spot {
            position,
            look_at,
            cone_angle,
            penumbra_angle,
            intensity,
        } => Light::Spot(SpotLight::new(
            position.as_vec3(),
            (look_at - position).normalize().as_vec3(),
            *cone_angle,
            *penumbra_angle,
            Curve::from_description(intensity),
        )),
        description::Light::Overcast {
            irradiance,
            ground_albedo,
        } => {
            let irradiance = Curve::from_description(irradiance);
            Light::Sky(SkyLight::overcast(&irradiance, *ground_albedo))
        }
        // Its parts have taken its place.
        description::Light::Rig(_) => return Ok(Vec::new()),
        description::Light::Daylight(day) => {
            let (sun, sky) = day.lights();
            return Ok(vec![Light::Sun(sun), Light::Sky(sky)]);
        }
    }])
}

/// The picture of a light.
fn picture(light: &str, file: &Path, notes: &mut Vec<String>) -> Result<RgbPicture, WorldError> {
    let picture = assets::shining(file).map_err(|source| WorldError::Asset {
        place: format!("lights.{light}"),
        source,
    })?;
    if picture.below > 0.0 {
        notes.push(format!(
            "lights.{light}: {}: {:.2} % of its pixels have a channel below 0, which is taken for 0",
            file.display(),
            100.0 * picture.below
        ));
    }
    Ok(picture)
}

fn build_pattern(
    light: &str,
    pattern: &description::AreaPattern,
    notes: &mut Vec<String>,
) -> Result<Pattern, WorldError> {
    let picture = match &pattern.picture {
        None => None,
        Some(file) => {
            let picture = picture(light, file, notes)?;
            Some(Texels::new(picture.texels, picture.width))
        }
    };
    Ok(Pattern::new(pattern.edge, picture))
}

/// What the three corners of each face have, counter-clockwise in the world.
fn corners<T>(mesh: &TriangleMesh, mirrored: bool, of: impl Fn(usize) -> T) -> Vec<[T; 3]> {
    let faces = mesh.triangles().iter();
    faces
        .map(|&[a, b, c]| {
            let face = if mirrored { [a, c, b] } else { [a, b, c] };
            face.map(|vertex| of(vertex as usize))
        })
        .collect()
}
