//! What valid scenes mean: the values that they resolve to.

use glam::{DMat4, DVec3};
use renderer::camera::thin_lens::ThinLens;
use renderer::camera::view::Projection;
use renderer::scene::description::light::constant::Constant;
use renderer::scene::description::light::environment::Environment;
use renderer::scene::description::light::spot::Spotlight;
use renderer::scene::description::material::diffuse::Diffuse;
use renderer::scene::description::material::leaf::{LeafTissue, PlainLeaf};
use renderer::scene::description::material::model::GltfSurface;
use renderer::scene::description::material::plastic::Plastic;
use renderer::scene::description::{
    Band, Depth, Description, FilmKind, Light, Material, Mesh, ObjectShape, Reflectance, Shape,
    Spectrum, Tone, Wrap,
};

use super::{accept, folder, load, text_of};

/// The same up to the rounding of some dozen operations.
pub(super) fn assert_near(value: f64, expected: f64) {
    assert!(
        (value - expected).abs() <= 1e-14 * expected.abs().max(1.0),
        "{value} is not {expected}"
    );
}

/// The lens of a scene's camera.
fn lens_of(scene: &Description) -> &ThinLens {
    match &scene.camera.view.projection {
        Projection::Perspective(lens) => lens,
        Projection::Orthographic { .. } => panic!("parallel rays"),
    }
}

#[test]
fn a_scene_without_a_name_is_called_after_its_file_or_its_folder() {
    let minimal = text_of("minimal.toml");
    let loaded = accept(&minimal, "minimal.toml", &[]);
    assert_eq!(loaded.description.name, "minimal");
    assert!(loaded.warnings.is_empty());
    let folder = folder();
    let inside = folder.path().join("first leaf");
    std::fs::create_dir(&inside).expect("the folder was just made");
    std::fs::write(inside.join("scene.toml"), &minimal).expect("the folder was just made");
    let loaded = load(&inside.join("scene.toml"), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(loaded.description.name, "first-leaf");
    assert_eq!(loaded.description.source, minimal);
}

#[test]
fn what_is_left_out_has_the_defaults_of_the_book() {
    let scene = accept(&text_of("minimal.toml"), "minimal.toml", &[]).description;
    assert_eq!(
        (
            scene.film.width,
            scene.film.height,
            scene.film.spp,
            scene.film.seed
        ),
        (64, 48, 4, 0)
    );
    assert_near(scene.film.filter_radius, 1.5);
    assert_eq!(scene.film.noise, None);
    assert!(
        matches!(scene.film.kind, FilmKind::Rgb { range_nm, .. } if range_nm == [400.0, 780.0])
    );
    assert_eq!(
        (scene.picture.exposure_ev, scene.picture.tone),
        (0.0, Tone::Standard)
    );
    assert_eq!(
        (scene.integrator.max_depth, scene.integrator.roulette_below),
        (None, None)
    );
    assert_eq!(
        (scene.camera.view.up, lens_of(&scene).radius),
        (DVec3::Z, 0.0)
    );
    assert_near(lens_of(&scene).focus_distance, 1.25_f64.sqrt());
    assert_eq!(scene.objects[0].value.to_world, DMat4::IDENTITY);
}

#[test]
fn film_and_camera_are_in_si_units() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    assert_eq!(scene.name, "whole-scene");
    assert_eq!((scene.film.seed, scene.film.noise), (u64::MAX, Some(0.02)));
    assert!(
        matches!(scene.film.kind, FilmKind::Rgb { range_nm, .. } if range_nm == [380.0, 800.0])
    );
    assert_eq!(
        (scene.picture.exposure_ev, scene.picture.tone),
        (-1.5, Tone::Filmic)
    );
    assert_near(scene.picture.contrast, 1.25);
    assert_near(lens_of(&scene).vertical_fov, std::f64::consts::FRAC_PI_2);
    let iris = lens_of(&scene).iris;
    assert_eq!((iris.blades, iris.cats_eye), (7, 0.4));
    assert_near(iris.rotation, 10_f64.to_radians());
    assert_near(lens_of(&scene).tilt[1], -2_f64.to_radians());
    // Half of 15 mm at half of 90°.
    assert_near(lens_of(&scene).image_distance, 0.0075);
    let picture = &scene.picture;
    assert_eq!(picture.depth, Depth::Sixteen);
    assert!(picture.alpha);
    assert_near(lens_of(&scene).radius, 0.01);
    assert_near(lens_of(&scene).focus_distance, 2.0);
    assert_eq!(
        (scene.integrator.max_depth, scene.integrator.roulette_below),
        (Some(12), Some(0.0))
    );
    assert_eq!(scene.integrator.branches, Some(3));
    assert_eq!(scene.integrator.lit_branches, Some(2));
    assert_eq!(scene.integrator.light_samples, Some(5));
    assert!(scene.integrator.hide_lights);
    assert_eq!(scene.integrator.sample_skies, Some(false));
}

#[test]
fn a_word_in_an_override_needs_no_quotes_and_a_whole_block_may_have_a_name_like_another() {
    let overrides = [
        "picture.tone=filmic",
        "objects.flor.mesh=floor",
        "objects.flor.material=grey",
    ];
    let scene = accept(&text_of("minimal.toml"), "minimal.toml", &overrides).description;
    assert_eq!(scene.picture.tone, Tone::Filmic);
    assert_eq!(scene.objects.len(), 2);
}

#[test]
fn a_spectral_film_has_its_bands_and_no_filter() {
    let film = "film={spectral={size=[2,1],spp=1,bands_nm=[450,650.5],band_width_nm=0}}";
    let scene = accept(&text_of("minimal.toml"), "minimal.toml", &[film]).description;
    let band = |center_nm| Band {
        center_nm,
        width_nm: 0.0,
    };
    assert!(
        matches!(scene.film.kind, FilmKind::Spectral { bands } if bands == [band(450.0), band(650.5)])
    );
    assert_near(scene.film.filter_radius, 0.0);
}

#[test]
fn names_become_indices_in_the_order_of_the_file() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let names: Vec<&str> = scene
        .materials
        .iter()
        .map(|material| material.name.as_str())
        .collect();
    let expected = [
        "paper",
        "glass",
        "green",
        "mapped",
        "measured",
        "rind",
        "flesh",
        "bark",
        "glaze",
        "enamel",
        "studio.cloth",
    ];
    assert_eq!(names, expected);
    let shapes: Vec<ObjectShape> = scene
        .objects
        .iter()
        .map(|object| object.value.shapes[0])
        .collect();
    let mesh = |mesh, material| ObjectShape::Mesh { mesh, material };
    let leaf = |leaf| ObjectShape::Leaf { leaf };
    assert_eq!(
        shapes,
        [
            mesh(0, 0),
            mesh(1, 1),
            leaf(0),
            leaf(1),
            mesh(2, 2),
            mesh(0, 3),
            mesh(0, 4),
            ObjectShape::Solid { solid: 0 },
            ObjectShape::Solid { solid: 4 },
            mesh(0, 0),
            mesh(scene.meshes.len() - 2, 0),
            mesh(5, 0),
            mesh(4, 0),
            mesh(3, 1),
            // At its first day: a plant bears the leaf as well.
            leaf(5),
            mesh(0, 7),
            mesh(6, 8),
            mesh(7, 2),
            mesh(scene.meshes.len() - 1, 0),
            mesh(6, 9),
            // The walls of the rig's tent; behind them stand the axes of both plants.
            mesh(scene.meshes.len() - 5, 10),
            mesh(scene.meshes.len() - 4, 10),
            mesh(scene.meshes.len() - 3, 10),
        ]
    );
    assert_eq!(scene.objects[9].value.shapes, [mesh(0, 0), mesh(1, 1)]);
    assert!(matches!(&scene.lights[4].value, Light::Area(area) if area.object == 0));
    assert!(
        matches!(&scene.meshes[2].value, Shape::Mesh(Mesh::File(mesh)) if mesh.path.file.is_absolute() && mesh.scale == 0.001)
    );
}

#[test]
fn spectra_are_read_in_every_form() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let Material::Diffuse(Diffuse {
        reflectance:
            Reflectance::Even(Spectrum::Table {
                points,
                extrapolate,
            }),
    }) = &scene.materials[0].value
    else {
        panic!("paper is {:?}", scene.materials[0].value);
    };
    assert!(*extrapolate && points.len() == 2);
    assert_near(points[0].1, 0.7);
    let Material::Leaf(PlainLeaf {
        tissue: LeafTissue::Measured { transmittance, .. },
        ..
    }) = &scene.materials[4].value
    else {
        panic!("measured is {:?}", scene.materials[4].value);
    };
    assert!(matches!(transmittance, Spectrum::Table { points, .. } if points[1] == (600.0, 0.3)));
    let Light::Distant(sun) = &scene.lights[0].value else {
        panic!("the sun is {:?}", scene.lights[0].value);
    };
    assert!(matches!(
        sun.irradiance,
        Spectrum::Blackbody {
            kelvin: 5800.0,
            scale: 1.5
        }
    ));
    assert!(
        (sun.towards - DVec3::new(0.0, 0.75_f64.sqrt(), 0.5)).length() < 1e-15,
        "{}",
        sun.towards
    );
    assert_near(sun.angular_diameter, std::f64::consts::PI / 180.0);
    assert!(matches!(
        &scene.lights[2].value,
        Light::Environment(Environment {
            white: Spectrum::D65 { scale: 0.5 },
            ..
        })
    ));
    let Light::Spot(Spotlight {
        position,
        cone_angle,
        penumbra_angle,
        intensity: Spectrum::D65 { scale: 2.0 },
        ..
    }) = &scene.lights[5].value
    else {
        panic!("the spot is {:?}", scene.lights[5].value);
    };
    assert_eq!(*position, DVec3::new(0.0, 0.0, 3.0));
    assert_near(cone_angle - penumbra_angle, std::f64::consts::PI / 9.0);
}

#[test]
fn reflectances_may_be_a_pictures_or_a_models() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let Some(Reflectance::Picture(bark)) = scene.materials[7].value.reflectance() else {
        panic!("bark is {:?}", scene.materials[7].value);
    };
    assert!(bark.file.ends_with("bark.png") && bark.layer.name().is_none());
    assert_eq!(
        (bark.wrap, bark.repeats, bark.scale),
        (Wrap::Mirror, [2.0, 3.0], 0.5)
    );
    assert!(matches!(
        scene.materials[8].value,
        Material::Plastic(Plastic {
            reflectance: Reflectance::OfMesh(6),
            eta: 1.4,
            roughness: 0.3
        })
    ));
    assert!(matches!(
        scene.materials[9].value,
        Material::Model(GltfSurface { mesh: 6 })
    ));
    assert!(
        matches!(&scene.meshes[6].value, Shape::Mesh(Mesh::Gltf(model)) if model.beside.is_empty() && model.scale == 0.01)
    );
}

#[test]
fn daylight_has_its_sun_by_place_and_time_or_by_two_angles() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let Light::Daylight(noon) = &scene.lights[6].value else {
        panic!("noon is {:?}", scene.lights[6].value);
    };
    // 10:00 UTC in Berlin on the longest day by Spencer's series of 1971: 58.2° high and 149.6°
    // from north over east. North is +x, and azimuths in the scene run the other way.
    let degrees = [noon.elevation, noon.azimuth].map(f64::to_degrees);
    assert!((degrees[0] - 58.2).abs() < 0.3, "{degrees:?}");
    assert!((degrees[1] + 149.6).abs() < 0.5, "{degrees:?}");
    let air = noon.atmosphere;
    assert_near(air.turbidity, 4.0);
    assert_near(air.ozone_cm, 0.3);
    assert_near(air.water_cm, 2.0);
    assert_near(air.pressure_hpa, 1000.0);
    assert_near(air.ground_albedo, 0.5);
    // Farther from the sun in June.
    assert!((0.96..0.97).contains(&air.distance_factor), "{air:?}");
    let Light::Daylight(evening) = &scene.lights[7].value else {
        panic!("the evening is {:?}", scene.lights[7].value);
    };
    assert_near(evening.elevation, std::f64::consts::PI / 18.0);
    assert_near(evening.azimuth, std::f64::consts::PI);
    assert_near(evening.atmosphere.distance_factor, 1.0);
    assert_near(evening.scale, 0.5);
    assert_eq!(evening.forest.map(f64::to_degrees), Some(90.0));
}

#[test]
fn a_rig_becomes_lights_of_its_own_name() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let lights = scene.lights.iter().map(|light| light.name.as_str());
    let of_the_rig: Vec<&str> = lights.filter(|name| name.starts_with("studio")).collect();
    // The camera looks in from the right, where the tent is open.
    let parts = ["left", "back", "roof", "room"];
    assert_eq!(of_the_rig, parts.map(|part| format!("studio.{part}")));
}

#[test]
fn overrides_replace_and_add_values_and_are_recorded() {
    let overrides = [
        "film.rgb.spp=16",
        "camera.perspective.vertical_fov_deg = 35",
        "materials.grey.diffuse.reflectance={ table = [[300, 0.1], [900, 0.2]] }",
        "picture.tone=\"filmic\"",
        "name='other'",
    ];
    let scene = accept(&text_of("minimal.toml"), "minimal.toml", &overrides).description;
    assert_eq!((scene.film.spp, scene.picture.tone), (16, Tone::Filmic));
    assert_near(lens_of(&scene).vertical_fov, 35.0_f64.to_radians());
    // What is recorded is the same scene without any override.
    let again = accept(&scene.source, "other.toml", &[]).description;
    assert_eq!(
        format!("{:?}", again.materials),
        format!("{:?}", scene.materials)
    );
    assert_eq!(
        (again.film.spp, again.name, again.source),
        (16, scene.name, scene.source)
    );
}

#[test]
fn an_override_replaces_a_spectrum_whole() {
    let sky = "lights.sky.constant.radiance_w_m2_sr_nm";
    let overrides = [
        format!("{sky}={{ table = [[300, 1], [900, 2]] }}"),
        format!("{sky} = {{ d65 = 2 }}"),
    ];
    let overrides: Vec<&str> = overrides.iter().map(String::as_str).collect();
    let scene = accept(&text_of("minimal.toml"), "minimal.toml", &overrides).description;
    assert!(matches!(
        &scene.lights[0].value,
        Light::Constant(Constant {
            radiance: Spectrum::D65 { scale: 2.0 }
        })
    ));
}

#[test]
fn a_byte_order_mark_and_line_ends_of_other_systems_change_nothing() {
    let minimal = text_of("minimal.toml");
    let foreign = format!("\u{feff}{}", minimal.replace('\n', "\r\n"));
    let [one, two] = [&minimal, &foreign].map(|text| accept(text, "minimal.toml", &[]).description);
    assert_eq!(format!("{:?}", one.objects), format!("{:?}", two.objects));
    assert_eq!(one.film.spp, two.film.spp);
}

#[test]
fn what_nothing_uses_is_a_warning() {
    let added =
        "\n[meshes.ball.sphere]\nradius_m = 1\n[materials.red.diffuse]\nreflectance = 0.1\n";
    let loaded = accept(&(text_of("minimal.toml") + added), "minimal.toml", &[]);
    let messages: Vec<&str> = loaded
        .warnings
        .iter()
        .map(leafmodel::document::report::Warning::message)
        .collect();
    assert_eq!(
        messages,
        [
            "no object uses the mesh `ball`",
            "no object uses the material `red`"
        ]
    );
    assert!(
        loaded.warnings[0]
            .to_string()
            .contains("warning[scene::unused]")
    );
}
