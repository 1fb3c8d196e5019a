//! Conversion of lights from the description.

use super::WorldError;
use crate::geometry::{Instance, TriangleMesh};
use crate::light::Light;
use crate::light::area::AreaLight;
use crate::light::distant::DistantLight;
use crate::light::environment::EnvironmentLight;
use crate::light::spot::SpotLight;
use crate::scene::assets;
use crate::scene::description;
use crate::spectrum::Curve;

/// The lights of a block of the scene; `instance_of` gives the only instance of an emitting object.
pub(super) fn build_lights<'i>(
    name: &str,
    light: &description::Light,
    meshes: &[TriangleMesh],
    instance_of: impl Fn(usize) -> &'i Instance,
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
            let picture = assets::environment(file).map_err(|source| WorldError::Asset {
                place: format!("lights.{name}"),
                source,
            })?;
            Light::Environment(EnvironmentLight::new(
                picture.texels,
                picture.width,
                Curve::from_description(white).scaled(*scale as f32),
                *rotation as f32,
            ))
        }
        description::Light::Area { object, radiance } => {
            let instance = instance_of(*object);
            let mesh = &meshes[instance.mesh as usize];
            let mirrored = instance.to_world.matrix3.determinant() < 0.0;
            let triangles: Vec<_> = mesh
                .triangles()
                .iter()
                .map(|face| {
                    let [a, b, c] = face.map(|vertex| {
                        instance
                            .to_world
                            .transform_point3(mesh.positions()[vertex as usize])
                    });
                    if mirrored { [a, c, b] } else { [a, b, c] }
                })
                .collect();
            Light::Area(AreaLight::new(
                &triangles,
                Curve::from_description(radiance),
            ))
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
        description::Light::Daylight(day) => {
            let (sun, sky) = day.lights();
            return Ok(vec![Light::Sun(sun), Light::Sky(sky)]);
        }
    }])
}
