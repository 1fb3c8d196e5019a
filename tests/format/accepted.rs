//! What valid scenes mean: the values that they resolve to.

use glam::{DMat4, DVec3};
use leafmodel::leaf::LeafPlan;
use leafmodel::leaf::outline_plan::{Contour, OutlinePlan};
use leafmodel::shape::growth::RateCurve;
use leafmodel::solid::SolidShape;
use leafmodel::venation::plan::{
    AuxinPlan, FreeEndings, Growth, MarginClearance, Neighbourhood, Pattern,
};
use renderer::scene::description::{
    Band, FilmKind, LeafTissue, Light, Material, Mesh, ObjectShape, SolidTissue, Spectrum, Tone,
};

use leafmodel::compound::{Arrangement, Feather};
use renderer::scene::load::load_leaves;

use super::{accept, codes, folder, load, text_of};

/// The same up to the rounding of some dozen operations.
fn assert_near(value: f64, expected: f64) {
    assert!(
        (value - expected).abs() <= 1e-14 * expected.abs().max(1.0),
        "{value} is not {expected}"
    );
}

/// The plan of veins that grow towards auxin.
fn auxin(plan: &LeafPlan) -> &AuxinPlan {
    plan.venation.auxin().expect("the leaf has such veins")
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
    assert!(matches!(scene.film.kind, FilmKind::Rgb { range_nm } if range_nm == [400.0, 780.0]));
    assert_eq!(
        (scene.picture.exposure_ev, scene.picture.tone),
        (0.0, Tone::Linear)
    );
    assert_eq!(
        (scene.integrator.max_depth, scene.integrator.roulette_below),
        (None, 0.25)
    );
    assert_eq!((scene.camera.up, scene.camera.lens_radius), (DVec3::Z, 0.0));
    assert_near(scene.camera.focus_distance, 1.25_f64.sqrt());
    assert_eq!(scene.objects[0].value.to_world, DMat4::IDENTITY);
}

#[test]
fn film_and_camera_are_in_si_units() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    assert_eq!(scene.name, "whole-scene");
    assert_eq!(scene.film.seed, u64::MAX);
    assert!(matches!(scene.film.kind, FilmKind::Rgb { range_nm } if range_nm == [380.0, 800.0]));
    assert_eq!(
        (scene.picture.exposure_ev, scene.picture.tone),
        (-1.5, Tone::Filmic)
    );
    assert_near(scene.camera.vertical_fov, std::f64::consts::FRAC_PI_2);
    assert_near(scene.camera.lens_radius, 0.01);
    assert_near(scene.camera.focus_distance, 2.0);
    assert_eq!(
        (scene.integrator.max_depth, scene.integrator.roulette_below),
        (Some(12), 0.0)
    );
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
        "paper", "glass", "green", "mapped", "measured", "rind", "flesh",
    ];
    assert_eq!(names, expected);
    let shapes: Vec<ObjectShape> = scene
        .objects
        .iter()
        .map(|object| object.value.shape)
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
        ]
    );
    assert!(matches!(
        scene.lights[4].value,
        Light::Area { object: 0, .. }
    ));
    assert!(
        matches!(&scene.meshes[2].value, Mesh::File { file, scale } if file.is_absolute() && *scale == 0.001)
    );
}

#[test]
fn objects_are_scaled_then_turned_about_x_y_z_then_moved() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let panel = scene.objects[0].value.to_world;
    // Half as large; x = (1, 0, 0) stays under the half turn about x and becomes y about z.
    assert_eq!(panel.transform_point3(DVec3::X), DVec3::new(0.0, 0.5, 2.0));
    assert_eq!(panel.transform_point3(DVec3::Z), DVec3::new(0.0, 0.0, 1.5));
    let bottle = scene.objects[1].value.to_world;
    assert_eq!(
        bottle.transform_point3(DVec3::ZERO),
        DVec3::new(5.0, 6.0, 7.0)
    );
    assert_eq!(bottle.transform_vector3(DVec3::Y), DVec3::Z);
    let turned = accept(
        &text_of("minimal.toml"),
        "minimal.toml",
        &["objects.floor.rotate_deg=[90,90,0]"],
    );
    // About x first: z becomes −y, which a turn about y leaves alone.
    let to_world = turned.description.objects[0].value.to_world;
    assert_eq!(to_world.transform_vector3(DVec3::Z), DVec3::NEG_Y);
}

#[test]
fn spectra_are_read_in_every_form() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let Material::Diffuse {
        reflectance: Spectrum::Table {
            points,
            extrapolate,
        },
    } = &scene.materials[0].value
    else {
        panic!("paper is {:?}", scene.materials[0].value);
    };
    assert!(*extrapolate && points.len() == 2);
    assert_near(points[0].1, 0.7);
    let Material::Leaf {
        tissue: LeafTissue::Measured { transmittance, .. },
        ..
    } = &scene.materials[4].value
    else {
        panic!("measured is {:?}", scene.materials[4].value);
    };
    assert!(matches!(transmittance, Spectrum::Table { points, .. } if points[1] == (600.0, 0.3)));
    let Light::Distant {
        towards,
        angular_diameter,
        irradiance,
    } = &scene.lights[0].value
    else {
        panic!("the sun is {:?}", scene.lights[0].value);
    };
    assert!(matches!(
        irradiance,
        Spectrum::Blackbody {
            kelvin: 5800.0,
            scale: 1.5
        }
    ));
    assert!(
        (*towards - DVec3::new(0.0, 0.75_f64.sqrt(), 0.5)).length() < 1e-15,
        "{towards}"
    );
    assert_near(*angular_diameter, std::f64::consts::PI / 180.0);
    assert!(matches!(
        &scene.lights[2].value,
        Light::Environment {
            white: Spectrum::D65 { scale: 0.5 },
            ..
        }
    ));
}

#[test]
fn bodies_of_solid_tissue_are_planned_as_written() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let solid = |number: usize| &scene.solids[number].value;
    let melon = solid(0);
    assert_eq!((melon.plan.seed, melon.plan.map_size), (3, 256));
    let optics = melon.optics;
    assert_eq!(
        (
            optics.tissue.depth_mm,
            optics.tissue.scattering_per_mm,
            optics.tissue.eta
        ),
        (2.0, 1.0, 1.36)
    );
    // The coat's index is the tissue's where it says nothing.
    assert_eq!((optics.coat.eta, optics.coat.alpha_along), (1.36, 0.2));
    let held = melon.plan.contents;
    assert_eq!(
        (
            held.structure,
            held.chlorophyll,
            held.carotenoids,
            held.water
        ),
        (1.0, 7.0, 0.0, 0.09)
    );
    let mosaic = melon.plan.mosaic.as_ref().expect("it has a mosaic");
    assert_eq!(
        (mosaic.contents[0].chlorophyll, mosaic.contents[0].water),
        (60.0, 0.09)
    );
    let axes = |x, y, z| SolidShape::Ellipsoid {
        semi_axes_mm: DVec3::new(x, y, z),
    };
    assert_eq!(melon.plan.shape, axes(115.0, 110.0, 100.0));
    assert_eq!(solid(1).plan.shape, axes(20.0, 20.0, 20.0));
    assert_eq!(solid(1).optics.tissue.eta, solid(1).optics.coat.eta);
    let dice = SolidShape::RoundedCube {
        side_mm: 20.0,
        corner_radius_mm: 5.0,
    };
    assert_eq!(solid(2).plan.shape, dice);
    assert!(
        matches!(&solid(3).plan.shape, SolidShape::Lathe { profile_mm } if profile_mm.len() == 4)
    );
    let SolidShape::Mesh(stone) = &solid(4).plan.shape else {
        panic!("the shape is {:?}", solid(4).plan.shape);
    };
    assert_eq!((stone.file.as_str(), stone.scale_mm), ("body.obj", 2.0));
    assert!(stone.shape.positions.contains(&DVec3::new(20.0, 0.0, 0.0)));
    assert!(
        stone
            .shape
            .normals
            .iter()
            .all(|n| (n.length() - 1.0).abs() < 1e-12)
    );
    let Material::Solid { tissue, optics } = &scene.materials[5].value else {
        panic!("rind is {:?}", scene.materials[5].value);
    };
    assert!(
        matches!(tissue, SolidTissue::Contents { contents, extrapolate: true } if contents.betaxanthins == 1.0)
    );
    assert_eq!((optics.tissue.depth_mm, optics.coat.eta), (0.5, 1.33));
}

#[test]
fn a_leaf_is_planned_as_written() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let beech = &scene.leaves[0].value;
    let venation = auxin(&beech.plan);
    assert_eq!(
        (venation.pattern, venation.final_length),
        (Pattern::Closed(Neighbourhood::Relative), 350.0)
    );
    assert_eq!(
        (venation.source_birth_distance, venation.vein_birth_distance),
        (3.0, 4.0)
    );
    let isogonic = Growth::Isogonic {
        initial_length: 11.5,
        length_step: 0.9,
    };
    assert_eq!(venation.growth, isogonic);
    assert_near(beech.plan.form.fold, std::f64::consts::PI / 20.0);
    assert_eq!(beech.plan.tissue.vein_factors.dry_matter, 4.0);
    assert_eq!(beech.plan.tissue.lamina.anthocyanins, 0.0);
    let [adaxial, abaxial] = beech.coats;
    assert_eq!(
        (adaxial.eta, adaxial.alpha_across, adaxial.alpha_along),
        (1.5, 0.2, 0.2)
    );
    assert_eq!((abaxial.alpha_across, abaxial.alpha_along), (0.45, 0.3));
    let simple = &scene.leaves[1].value;
    assert_eq!(auxin(&simple.plan).vein_birth_distance, 4.0);
    let Contour::GrowthAlgorithm(shape) = &simple.plan.outline.contour else {
        panic!("the outline is {:?}", simple.plan.outline);
    };
    let positions: Vec<f64> = shape
        .midrib
        .right
        .veins
        .iter()
        .map(|vein| vein.position)
        .collect();
    assert_eq!(positions, [0.1, 0.3, 0.5, 0.7, 0.9]);
    assert!(
        matches!(&simple.abaxial_ratio, Spectrum::Table { points, extrapolate: true } if points.len() == 4)
    );
}

#[test]
fn an_outline_may_be_drawn_or_traced_and_toothed() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let outline = |leaf: usize| -> &OutlinePlan { &scene.leaves[leaf].value.plan.outline };
    let Contour::Curve(curve) = &outline(2).contour else {
        panic!("the outline is {:?}", outline(2));
    };
    let corners: Vec<bool> = curve.points.iter().map(|point| point.corner).collect();
    assert_eq!(
        (corners, curve.mirrored),
        (vec![false, true, false, true], true)
    );
    assert_eq!(curve.points[1].place, [0.3, -0.1]);
    let [coarse, fine] = outline(2).teeth.as_slice() else {
        panic!("the teeth are {:?}", outline(2).teeth);
    };
    assert_eq!(
        (
            coarse.per_side,
            coarse.lean,
            coarse.fade_base,
            coarse.fade_apex
        ),
        (12, 0.8, 0.1, 0.2)
    );
    assert_eq!(
        (fine.per_side, fine.height, fine.lean, fine.fade_apex),
        (48, 0.005, 0.0, 0.0)
    );
    let Contour::Svg(svg) = &outline(3).contour else {
        panic!("the outline is {:?}", outline(3));
    };
    assert_eq!(
        (svg.file.as_str(), svg.id.as_deref()),
        ("margin.svg", Some("blade"))
    );
    assert_eq!((svg.base, svg.apex), ([50.0, 90.0], [50.0, 10.0]));
}

#[test]
fn veins_are_planned_as_written() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let drawn = auxin(&scene.leaves[2].value.plan);
    assert_eq!(drawn.pattern, Pattern::Closed(Neighbourhood::Urquhart));
    assert_eq!(drawn.origins, [[0.0, 0.0], [0.1, 0.2]]);
    assert_eq!(
        (drawn.unseen_veinlets, drawn.gaussian_curvature),
        (3.0, -0.5)
    );
    let free_endings = FreeEndings {
        birth_distance: 1.5,
        kill_distance: 1.0,
        darts_per_area: 2.0,
    };
    let margin_clearance = MarginClearance {
        distance: 0.05,
        until: 0.6,
        arches: 0,
    };
    assert_eq!(drawn.free_endings, Some(free_endings));
    assert_eq!(drawn.margin_clearance, Some(margin_clearance));
    let curve = |knots: &[[f64; 2]]| RateCurve::new(knots.to_vec()).expect("good knots");
    let anisotropic = Growth::Anisotropic {
        initial_length: 10.0,
        across: curve(&[[0.0, 0.02], [1.0, 0.01]]),
        along: curve(&[[0.0, 0.01], [0.5, 0.03], [1.0, 0.01]]),
    };
    let traced = auxin(&scene.leaves[3].value.plan);
    assert_eq!(
        (&traced.pattern, &traced.growth),
        (&Pattern::Open, &anisotropic)
    );
    assert!(traced.origins.is_empty() && traced.free_endings.is_none());
}

#[test]
fn leaves_can_be_read_from_a_file_that_has_nothing_else() {
    let whole = text_of("whole.toml");
    let start = whole
        .find("[leaves.beech]")
        .expect("the scene has a beech leaf");
    let end = whole.find("[lights.sun").expect("the scene has a sun");
    let folder = folder();
    let path = folder.path().join("leaf.toml");
    let write = |text: &str| std::fs::write(&path, text).expect("the folder was just made");
    write(&format!("format = 1\n{}", &whole[start..end]));
    let overrides = ["leaves.beech.seed=9".to_owned()];
    let leaves = load_leaves(&path, &overrides).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((leaves.len(), leaves[1].name.as_str()), (4, "simple"));
    assert_eq!(leaves[0].value.plan.seed, 9);
    write(&format!(
        "format = 1\n{}",
        whole[start..end].replace("rows = 100", "rows = 1")
    ));
    let errors = load_leaves(&path, &[]).expect_err("one row is no leaf");
    assert_eq!(codes(&errors), ["scene::out_of_range"]);
    write("format = 1\n");
    let errors = load_leaves(&path, &[]).expect_err("there is no leaf");
    assert_eq!(codes(&errors), ["scene::missing_key"]);
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
    assert_near(scene.camera.vertical_fov, 35.0_f64.to_radians());
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
        Light::Constant {
            radiance: Spectrum::D65 { scale: 2.0 }
        }
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
        .map(renderer::scene::report::Warning::message)
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

#[test]
fn betalains_and_anthocyanins_in_one_leaf_are_a_warning() {
    let leaf = "\n[materials.odd.leaf.contents]\nstructure = 1.5\nchlorophyll_ug_per_cm2 = 30\n\
                carotenoids_ug_per_cm2 = 8\nbetacyanins_ug_per_cm2 = 5\nwater_cm = 0.01\n\
                dry_matter_g_per_cm2 = 0.005\n";
    let codes = |text: &str| -> Vec<&'static str> {
        let scene = text_of("minimal.toml") + leaf + text;
        let loaded = accept(&scene, "minimal.toml", &[]);
        let codes = loaded.warnings.iter();
        codes.map(renderer::scene::report::Warning::code).collect()
    };
    assert_eq!(codes(""), ["scene::unused"]);
    let both = codes("anthocyanins_ug_per_cm2 = 2\n");
    assert!(
        both.contains(&"scene::betalains_and_anthocyanins"),
        "{both:?}"
    );
}

#[test]
fn petioles_and_compound_leaves_mean_what_the_book_says() {
    let scene = accept(&text_of("whole.toml"), "whole.toml", &[]).description;
    let petiole = scene.leaves[1].value.plan.petiole;
    let petiole = petiole.expect("the simple leaf has one");
    assert_eq!((petiole.length, petiole.radius_mm), (0.4, Some(0.5)));
    assert_eq!(petiole.curl, 30.0_f64.to_radians());
    let compound = scene.leaves[2].value.plan.compound.as_ref();
    let compound = compound.expect("the drawn leaf is");
    assert_eq!(
        (
            compound.petiole,
            compound.petiolule,
            compound.stalk_radius_mm,
            compound.variants
        ),
        (1.5, 0.2, 0.2, 2)
    );
    let bends = [compound.curl, compound.fold, compound.tilt];
    assert_eq!(bends, [30.0_f64, -10.0, 5.0].map(f64::to_radians));
    let Arrangement::Bipinnate {
        pinnae,
        leaflets,
        stalk,
    } = &compound.arrangement
    else {
        panic!("{:?}", compound.arrangement);
    };
    let expected = Feather {
        pairs: 1,
        terminal: false,
        rachis: 3.0,
        alternation: 0.3,
        angles: [80.0_f64, 70.0].map(f64::to_radians),
        sizes: [0.5; 3],
        turn: 10.0_f64.to_radians(),
    };
    assert_eq!((*stalk, *pinnae), (2.0, expected));
    assert!(leaflets.terminal && leaflets.sizes == [1.0; 3]);
    assert!(scene.leaves[0].value.plan.petiole.is_none());
    assert!(scene.leaves[0].value.plan.compound.is_none());
}
