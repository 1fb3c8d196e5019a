//! Conversion of lights from the description.

use std::path::Path;

use glam::{DVec3, Vec2};

use super::WorldError;
use super::meshes::OwnSurface;
use crate::geometry::{Instance, TriangleMesh};
use crate::light::Light;
use crate::light::area::AreaLight;
use crate::light::daylight::sky::SkyLight;
use crate::light::distant::DistantLight;
use crate::light::environment::EnvironmentLight;
use crate::light::pattern::{Colours, Pattern};
use crate::light::spot::SpotLight;
use crate::light::texels::Texels;
use crate::material::colour_map::ColourMap;
use crate::scene::assets::{self, RgbPicture};
use crate::scene::description;
use crate::spectrum::Curve;

/// The lights of a block of the scene, for rays around `origin`; `instance_of` gives the only instance
/// of an emitting object. What was changed of its picture is noted.
pub(super) fn build_lights<'i>(
    name: &str,
    light: &description::Light,
    (meshes, surfaces): (&[TriangleMesh], &[OwnSurface]),
    instance_of: impl Fn(usize) -> &'i Instance,
    origin: DVec3,
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
            layer,
            scale,
            rotation,
            white,
        } => {
            let picture = picture(name, (file, layer.as_deref()), notes)?;
            let (width, height) = (picture.width, picture.texels.len() / picture.width);
            if width != 2 * height {
                notes.push(format!(
                    "lights.{name}: {}: a picture of {width} × {height} pixels is not twice as wide as high; \
                     it is stretched over the whole sphere",
                    file.display()
                ));
            }
            let mut texels = picture.texels;
            // Seen from within, the azimuth grows to the left.
            for row in texels.chunks_mut(picture.width) {
                row.reverse();
            }
            Light::Environment(EnvironmentLight::new(
                texels,
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
            let to_world = instance.around(origin);
            let mirrored = to_world.matrix3.determinant() < 0.0;
            let triangles = corners(mesh, mirrored, |vertex| {
                to_world.transform_point3(mesh.positions()[vertex])
            });
            Light::Area(match pattern {
                None => AreaLight::new(&triangles, radiance),
                Some(pattern) => {
                    // A model without pictures needs none.
                    let needs_uvs = !pattern.emission || pattern.edge < 1.0;
                    if mesh.uvs().is_none() && needs_uvs {
                        return Err(WorldError::NoTextureCoordinates {
                            name: name.to_owned(),
                        });
                    }
                    let uv_of = |vertex: usize| mesh.uvs().map_or(Vec2::ZERO, |uvs| uvs[vertex]);
                    let uvs = corners(mesh, mirrored, uv_of);
                    let own = surfaces.get(instance.mesh as usize);
                    let emission = own.and_then(|own| own.emission.as_ref());
                    let pattern = build_pattern(name, pattern, emission, notes)?;
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
            (position - origin).as_vec3(),
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
        description::Light::Daylight(day) => {
            let (sun, sky) = day.lights();
            return Ok(vec![Light::Sun(sun), Light::Sky(sky)]);
        }
    }])
}

/// The picture of a light, and the layer of it.
fn picture(
    light: &str,
    (file, layer): (&Path, Option<&str>),
    notes: &mut Vec<String>,
) -> Result<RgbPicture, WorldError> {
    let picture = assets::shining(file, layer).map_err(|source| WorldError::Asset {
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
    if picture.outside > 0.0 {
        notes.push(format!(
            "lights.{light}: {}: {:.2} % of its pixels have colours outside of Rec. 709, whose spectra are \
             below 0 at some wavelengths: as a part of the light of a whole scene they are right",
            file.display(),
            100.0 * picture.outside
        ));
    }
    Ok(picture)
}

fn build_pattern(
    light: &str,
    pattern: &description::AreaPattern,
    emission: Option<&ColourMap>,
    notes: &mut Vec<String>,
) -> Result<Pattern, WorldError> {
    let colours = match (pattern.picture(), emission.filter(|_| pattern.emission)) {
        (Some(file), _) => {
            let picture = picture(light, file, notes)?;
            Some(Colours::Picture(Texels::new(picture.texels, picture.width)))
        }
        (None, Some(map)) => {
            if map.greatest() == [0.0; 3] {
                return Err(WorldError::NoEmission {
                    name: light.to_owned(),
                });
            }
            Some(Colours::Model(map.clone()))
        }
        (None, None) => None,
    };
    Ok(Pattern::new(pattern.edge, colours))
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

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::atomic::AtomicBool;

    use crate::image::{Attribute, Layer, Picture, openexr};
    use crate::integrator::caption::Caption;
    use crate::integrator::develop::develop;
    use crate::integrator::render::{Job, render};
    use crate::scene::load::parse;
    use crate::scene::world::World;

    /// Looks into the middle of the picture.
    const SCENE: &str = "format = 1\n[film.rgb]\nsize = [2, 2]\nspp = 1\n[camera.perspective]\n\
        position_m = [0, 0, 0]\nlook_at_m = [-1, 0, 0]\nvertical_fov_deg = 40\n\
        [lights.sky.environment]\npath = \"sky.exr\"\n\
        [meshes.dot.sphere]\nradius_m = 0.001\n[materials.black.diffuse]\nreflectance = 0\n\
        [objects.behind]\nmesh = \"dot\"\nmaterial = \"black\"\nposition_m = [1, 0, 0]\n";

    /// What is seen of a sky, with the notes on it.
    fn seen(sky: &Picture) -> (Picture, Vec<String>) {
        let folder = tempfile::tempdir().expect("a place for temporary files");
        openexr::write(sky, &folder.path().join("sky.exr")).expect("it can be written");
        let (picture, mut notes) = rendered(SCENE, folder.path());
        // The dot is behind the camera.
        assert!(
            notes
                .remove(0)
                .starts_with("camera: no object is in the picture")
        );
        (picture, notes)
    }

    /// The picture of a scene, with the notes on it.
    fn rendered(scene: &str, folder: &Path) -> (Picture, Vec<String>) {
        let loaded = parse(scene, "scene.toml", folder, &[]);
        let scene = loaded
            .unwrap_or_else(|errors| panic!("{errors}"))
            .description;
        let world = World::build(&scene).unwrap_or_else(|error| panic!("{error}"));
        let job = Job {
            width: 2,
            height: 2,
            spp: 256,
            seed: 1,
        };
        let go = AtomicBool::new(false);
        let rendered = render(&world, &job, &go, &|_| ()).expect("a small film");
        let caption = Caption::of(&scene, &world.view, &world.light_colours);
        (develop(&caption, &job, &rendered), world.notes)
    }

    /// Looks at one half of a square, which glTF has in its xy plane and the scene upright.
    const LAMP: &str = "format = 1\n[film.rgb]\nsize = [2, 2]\nspp = 1\n[camera.perspective]\n\
        position_m = [0.25, -1, 0.25]\nlook_at_m = [0.25, 0, 0.25]\nvertical_fov_deg = 10\n\
        [meshes.lamp.gltf]\npath = \"lamp.gltf\"\n[materials.black.diffuse]\nreflectance = 0\n\
        [objects.lamp]\nmesh = \"lamp\"\nmaterial = \"black\"\n\
        [lights.lamp.area]\nobject = \"lamp\"\nradiance_w_m2_sr_nm = { d65 = 2 }\nemission = true\n";

    /// A triangle whose material emits light of this factor, four times.
    fn lamp(factor: &str) -> String {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":
            {{"POSITION":0}},"material":0}}]}}],"accessors":[{{"bufferView":0,"componentType":5126,"count":3,
            "type":"VEC3","min":[0,0,0],"max":[1,1,0]}}],"bufferViews":[{{"buffer":0,"byteLength":36}}],
            "buffers":[{{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}],
            "materials":[{{"emissiveFactor":{factor},"pbrMetallicRoughness":{{"metallicFactor":0}},
            "extensions":{{"KHR_materials_emissive_strength":{{"emissiveStrength":4}}}}}}],
            "extensionsUsed":["KHR_materials_emissive_strength"]}}"#
        )
    }

    #[test]
    fn a_model_that_is_a_lamp_shines_as_its_materials_say() {
        let folder = tempfile::tempdir().expect("a place for temporary files");
        let file = folder.path().join("lamp.gltf");
        std::fs::write(&file, lamp("[1, 0.5, 0.25]")).expect("it can be written");
        let (picture, notes) = rendered(LAMP, folder.path());
        assert!(notes.is_empty(), "{notes:?}");
        for (name, expected) in [("R", 8.0), ("G", 4.0), ("B", 2.0)] {
            let values = &picture.layer(name).expect("it is there").data;
            let mean = values.iter().sum::<f32>() / values.len() as f32;
            // D65 of 1 at 560 nm has a luminance of 0.9889, and 0.4 % of blue is below 400 nm.
            let expected = 0.9889 * expected;
            assert!((mean / expected - 1.0).abs() < 0.005, "{name}: {mean}");
        }
        // What it emits is left out by name if no light has it.
        let without = LAMP.replace("emission = true\n", "");
        let (_, notes) = rendered(&without, folder.path());
        assert!(
            notes[0].contains("emitted light (`emission = true` of an area light uses it)"),
            "{notes:?}"
        );
        // And a lamp of it that is dark is refused.
        std::fs::write(&file, lamp("[0, 0, 0]")).expect("it can be written");
        let loaded = parse(LAMP, "scene.toml", folder.path(), &[]);
        let scene = loaded.unwrap_or_else(|errors| panic!("{errors}"));
        let error = World::build(&scene.description).expect_err("it is dark");
        assert!(
            error
                .to_string()
                .contains("no material of its object's mesh emits light"),
            "{error}"
        );
    }

    #[test]
    fn what_is_left_and_above_in_a_picture_of_the_surroundings_is_seen_there() {
        let (width, height) = (16, 8);
        // Left is red, right is green, what is above is twice as bright.
        let layers = ["R", "G", "B"].map(|name| {
            let value = |at: usize| {
                let is_lit = match name {
                    "R" => at % width < width / 2,
                    "G" => at % width >= width / 2,
                    _ => false,
                };
                let above = if at / width < height / 2 { 2.0 } else { 1.0 };
                0.1 + if is_lit { above } else { 0.0 }
            };
            Layer {
                name: name.to_owned(),
                data: (0..width * height).map(value).collect(),
            }
        });
        let (seen, notes) = seen(&Picture {
            width: width as u32,
            height: height as u32,
            layers: layers.into(),
            attributes: Vec::new(),
        });
        assert!(notes.is_empty(), "{notes:?}");
        let [red, green] = ["R", "G"].map(|name| &seen.layer(name).expect("it is there").data);
        for row in 0..2 {
            let [left, right] = [2 * row, 2 * row + 1];
            assert!(red[left] > 1.5 * green[left], "{red:?} {green:?}");
            assert!(green[right] > 1.5 * red[right], "{red:?} {green:?}");
        }
        assert!(
            red[0] > 1.2 * red[2] && green[1] > 1.2 * green[3],
            "{red:?} {green:?}"
        );
    }

    #[test]
    fn a_sky_of_other_primaries_is_seen_in_those_of_rec_709() {
        let layers = [("R", 1.0), ("G", 0.0), ("B", 0.0)].map(|(name, value)| Layer {
            name: name.to_owned(),
            data: vec![value; 16 * 8],
        });
        let rec2020 = [
            [0.708, 0.292],
            [0.170, 0.797],
            [0.131, 0.046],
            [0.3127, 0.3290],
        ];
        let (seen, notes) = seen(&Picture {
            width: 16,
            height: 8,
            layers: layers.into(),
            attributes: vec![(
                "chromaticities".to_owned(),
                Attribute::Chromaticities(rec2020),
            )],
        });
        for (name, expected) in [("R", 1.6605), ("G", -0.1246), ("B", -0.0182)] {
            for value in &seen.layer(name).expect("it is there").data {
                // 256 samples of stratified wavelengths, and the colours of the basis.
                assert!(
                    (value - expected).abs() < 0.02,
                    "{name}: {value}, not {expected}"
                );
            }
        }
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert!(
            notes[0].contains("100.00 % of its pixels have colours outside"),
            "{notes:?}"
        );
    }
}
