//! Conversion of lights from the description.

use glam::DVec3;

use super::error::WorldError;
use super::meshes::OwnSurface;
use crate::geometry::{Instance, TriangleMesh};
use crate::light::Light;
use crate::scene::description::Description;
use crate::scene::description::light::area::Area;
use crate::scene::description::light::{Surface, Surroundings};
use trace::world::WorldObjects;

/// The meshes with the surfaces that they bring along, their instances, and the first one of each object.
type Shining<'a> = (
    &'a [TriangleMesh],
    &'a [OwnSurface],
    &'a [Instance],
    &'a [usize],
);

/// The scene's lights, for rays around `origin`; objects that emit light are told so. What was changed of
/// pictures is noted.
pub(super) fn build_lights(
    scene: &Description,
    (meshes, surfaces, instances, first): Shining<'_>,
    origin: DVec3,
    objects: &mut WorldObjects,
    notes: &mut Vec<String>,
) -> Result<Vec<Light>, WorldError> {
    let mut lights = Vec::new();
    for light in &scene.lights {
        let surface = light.value.area().map(|area: &Area| {
            let first = first[area.object];
            objects.shine(first, lights.len());
            let instance = &instances[first];
            let mesh = instance.mesh as usize;
            Surface {
                mesh: &meshes[mesh],
                to_world: instance.around(origin),
                emission: surfaces.get(mesh).and_then(|own| own.emission.as_ref()),
            }
        });
        lights.extend(light.value.built(Surroundings {
            name: &light.name,
            origin,
            surface,
            notes,
        })?);
    }
    Ok(lights)
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
